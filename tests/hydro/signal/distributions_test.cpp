#include "hydro/signal/distributions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hydro/base/error.hpp"

namespace distributions_test {
namespace {

using namespace hydro::signal;

// Published tables, e.g. Abramowitz & Stegun, tables 26.8 and 26.10; digits beyond them follow from closed forms below.
TEST(ChiSquareQuantile, AgreesWithPrintedTables) {
  EXPECT_NEAR(chi_square_quantile(0.95, 1), 3.84146, 1e-5);  // printed digits, here and below
  EXPECT_NEAR(chi_square_quantile(0.975, 10), 20.4832, 1e-4);
  EXPECT_NEAR(chi_square_quantile(0.025, 10), 3.24697, 1e-5);
  EXPECT_NEAR(chi_square_quantile(0.005, 5), 0.41174, 1e-5);
  EXPECT_NEAR(chi_square_quantile(0.975, 100), 129.561, 1e-3);
}

TEST(StudentTQuantile, AgreesWithPrintedTables) {
  EXPECT_NEAR(student_t_quantile(0.975, 1), 12.7062, 1e-4);
  EXPECT_NEAR(student_t_quantile(0.975, 5), 2.57058, 1e-5);
  EXPECT_NEAR(student_t_quantile(0.95, 30), 1.69726, 1e-5);
  EXPECT_NEAR(student_t_quantile(0.995, 120), 2.61742, 1e-5);
}

TEST(Quantiles, MatchTheirClosedForms) {
  for (const double p : {1e-6, 0.01, 0.3, 0.5, 0.9, 0.999, 1 - 1e-6}) {
    const double chi2 = -2 * std::log1p(-p);                         // χ² with ν = 2 is exponential
    EXPECT_NEAR(chi_square_quantile(p, 2), chi2, 1e-10 * chi2);      // the promise of the header
    const double t1 = std::tan(3.14159265358979323846 * (p - 0.5));  // ν = 1: Cauchy
    EXPECT_NEAR(student_t_quantile(p, 1), t1,
                1e-9 * std::abs(t1) + 1e-15);                    // 1 − p itself has lost six digits at the ends
    const double t2 = (2 * p - 1) / std::sqrt(2 * p * (1 - p));  // ν = 2
    EXPECT_NEAR(student_t_quantile(p, 2), t2, 1e-9 * std::abs(t2) + 1e-15);
    const double z = normal_quantile(p);
    const double chi1 = std::pow(normal_quantile((1 + p) / 2), 2);  // ν = 1: the square of a normal
    EXPECT_NEAR(chi_square_quantile(p, 1), chi1, 1e-9 * chi1 + 1e-24);
    EXPECT_NEAR(0.5 * std::erfc(-z / std::sqrt(2.0)), p, 1e-14);
  }
}

TEST(Quantiles, TendToTheNormalForManyDegreesOfFreedom) {
  const double z = normal_quantile(0.975);
  EXPECT_NEAR(z, 1.959963984540054, 1e-13);
  EXPECT_NEAR(student_t_quantile(0.975, 1e6), z, z * (1 + z * z) / 4e6 * 1.1);  // first term of the expansion in 1/ν
  EXPECT_NEAR((chi_square_quantile(0.975, 1e6) - 1e6) / std::sqrt(2e6), z, 2e-3);  // next term: (2/3)(z² − 1)/√(2ν)
}

TEST(Quantiles, InvertTheirDistributionsForFractionalDegreesOfFreedom) {
  for (const double dof : {0.5, 1.3, 7.7, 33.3, 250.5, 4321.0})
    for (const double p : {1e-4, 0.025, 0.4, 0.975, 0.9999}) {
      EXPECT_NEAR(incomplete_gamma(dof / 2, chi_square_quantile(p, dof) / 2), p, 1e-11 * p + 1e-13);
      const double t = student_t_quantile(p, dof);
      const double tail = 0.5 * incomplete_beta(dof / 2, 0.5, dof / (dof + t * t));
      EXPECT_NEAR(t < 0 ? tail : 1 - tail, p, 1e-10 * p + 1e-13);
    }
}

TEST(Quantiles, RefuseWhatIsNoProbability) {
  EXPECT_THROW(chi_square_quantile(0, 3), hydro::InputError);
  EXPECT_THROW(chi_square_quantile(0.5, 0), hydro::InputError);
  EXPECT_THROW(student_t_quantile(1, 3), hydro::InputError);
  EXPECT_THROW(normal_quantile(std::nan("")), hydro::InputError);
}

}  // namespace
}  // namespace distributions_test
