// Frequencies that are chosen against laws that are known everywhere. (P36), (P37).
#include "potential/operations/where_needed.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "hydro/potential/operations/operations.hpp"
#include "hydro/waves/dispersion.hpp"
#include "potential/operations/rational_interpolation.hpp"

namespace hydro::potential::where_needed_test {
namespace {

using Complex = std::complex<double>;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const Water tank{.density = 1000, .gravity = 9.81, .depth = WaterDepth::from_metres(14)};

/// What makes waves at one frequency more than at others: B + iω(A − A(∞)) = Σ v vᵀ 2ζω_0 iω/(ω_0² − ω² + 2iζω_0ω).
struct Resonance {
  double omega, damping, size;
};

/// A body 30 m off the origin: broad radiation, and what `narrow` has beside it.
class Law {
 public:
  explicit Law(std::vector<Resonance> narrow) : resonance_(std::move(narrow)) {
    resonance_.push_back({1.6, 0.5, 1});
    resonance_.push_back({3.0, 0.4, 0.5});
  }

  Coefficients at(const std::vector<double>& omega) const {
    Coefficients c;
    c.water = tank;
    c.body.push_back({.name = "body",
                      .reference_point = Eigen::Vector3d(30, -4, 0),
                      .centre_of_gravity = {},
                      .centre_of_buoyancy = {},
                      .displaced_volume = {}});
    c.omega = omega;
    c.heading = {0.4};
    c.source = "a law";
    c.A_inf = 1000 * Eigen::MatrixXd::Identity(6, 6);
    c.X.assign(1, Eigen::MatrixXcd(6, static_cast<Eigen::Index>(omega.size())));
    for (std::size_t w = 0; w < omega.size(); ++w) {
      Eigen::MatrixXcd K = Eigen::MatrixXcd::Zero(6, 6);
      Eigen::VectorXcd X = Eigen::VectorXcd::Zero(6);
      for (std::size_t r = 0; r < resonance_.size(); ++r) {
        const Complex here = response(resonance_[r], omega[w]);
        K += here * (shape(r) * shape(r).transpose()).cast<Complex>();
        X += here * shape(r).cast<Complex>();
      }
      c.B.emplace_back(1e4 * K.real());
      c.A.emplace_back(*c.A_inf + 1e4 * K.imag() / omega[w]);
      const double k = waves::wavenumber(omega[w], tank);
      c.X[0].col(static_cast<Eigen::Index>(w)) =
          1e5 * X * std::polar(1.0, -k * (30 * std::cos(0.4) - 4 * std::sin(0.4)));
    }
    return c;
  }

 private:
  static Complex response(const Resonance& r, double omega) {
    const Complex i(0, 1);
    return r.size * 2.0 * r.damping * r.omega * i * omega /
           (r.omega * r.omega - omega * omega + 2.0 * i * r.damping * r.omega * omega);
  }
  static Eigen::VectorXd shape(std::size_t r) {
    Eigen::VectorXd v(6);
    for (Eigen::Index i = 0; i < 6; ++i) v[i] = std::cos(1.0 + 0.7 * static_cast<double>(i) * (1 + double(r)));
    return v;
  }
  std::vector<Resonance> resonance_;
};

std::vector<double> evenly(double from, double to, int count) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back(from + (to - from) * i / (count - 1));
  return out;
}

struct Made {
  ChosenFrequencies chosen;
  Coefficients table;
  int solved = 0;
};
Made made(const Law& law, const std::vector<double>& first, double tolerance) {
  Made out;
  Coefficients all;
  out.chosen = choose_frequencies(first, tolerance, [&](const std::vector<double>& omega) {
    out.solved += static_cast<int>(omega.size());
    return law.at(omega);
  });
  out.table = with_frequencies_between(law.at(out.chosen.omega), tolerance);
  return out;
}

/// The largest miss at 4000 places as the tolerance measures it, of what users of the table get from it.
double missed(const Coefficients& table, const Law& law) {
  const std::vector<double> omega = evenly(table.omega.front(), table.omega.back(), 4000);
  const Coefficients truth = law.at(omega);
  const FrequencyTable read(table, {*table.body[0].reference_point});
  Eigen::VectorXd B = Eigen::VectorXd::Zero(6), X = B;
  for (const auto& of : truth.B) B = B.cwiseMax(of.diagonal());
  X = truth.X[0].cwiseAbs().rowwise().maxCoeff();
  double out = 0;
  for (std::size_t w = 0; w < omega.size(); ++w) {
    const Eigen::MatrixXd dB = read.damping(omega[w]) - truth.B[w],
                          dA = omega[w] * (read.added_mass(omega[w]) - truth.A[w]);
    const Eigen::VectorXcd dX = read.excitation(omega[w], 0.4) - truth.X[0].col(static_cast<Eigen::Index>(w));
    for (Eigen::Index i = 0; i < 6; ++i) {
      out = std::max(out, std::abs(dX[i]) / X[i]);
      for (Eigen::Index j = 0; j < 6; ++j) out = std::max(out, std::hypot(dB(i, j), dA(i, j)) / std::sqrt(B[i] * B[j]));
    }
  }
  return out;
}

TEST(LeastStretched, IsTheNullVectorWhereThereIsOne) {
  Eigen::MatrixXcd A(5, 3);
  const RandomStream random(3, 1);
  for (Eigen::Index i = 0; i < A.size(); ++i)
    A.data()[i] = {random.normal(static_cast<std::uint64_t>(2 * i)),
                   random.normal(static_cast<std::uint64_t>(2 * i + 1))};
  A.col(2) = A.col(0) * Complex(0.3, -2) + A.col(1) * Complex(1, 1);
  const Eigen::VectorXcd x = least_stretched(A);
  EXPECT_NEAR(x.norm(), 1, 1e-14);
  EXPECT_LT((A * x).norm(), 1e-13);  // rounding of entries about one
}

TEST(RationalInterpolation, OfARationalFunctionIsThatFunction) {
  const auto f = [](double x) {
    Eigen::RowVectorXcd out(3);
    const Complex a = 1.0 / Complex(x - 1, 0.2), b = 1.0 / Complex(x - 2, 0.05);
    out << a + b, 3.0 * a - b + 1.0, Complex(0, 1) * b;
    return out;
  };
  const std::vector<double> place = evenly(0, 3, 12);
  Eigen::MatrixXcd value(12, 3);
  for (Eigen::Index i = 0; i < 12; ++i) value.row(i) = f(place[static_cast<std::size_t>(i)]);
  const RationalInterpolation r(place, value, 1e-10);
  EXPECT_EQ(r.supports().size(), 3u);  // two poles, and a constant
  // 1e-9: entries are up to 20, and weights carry rounding over the distance of poles from the axis.
  for (const double x : {0.1, 0.77, 1.01, 1.98, 2.02, 2.9, 5.0})
    EXPECT_LT((r.shares(x) * value - f(x)).cwiseAbs().maxCoeff(), 1e-9) << x;
  for (const double x : r.supports()) EXPECT_EQ(r.shares(x) * value, f(x));
}

TEST(FrequenciesWhereNeeded, MeetTheirToleranceAtPlacesNotSeen) {
  const Law broad({}), narrow({{2.31, 0.004, 0.7}, {2.52, 0.01, 0.4}});
  for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4}) {
    const Made of_broad = made(broad, evenly(0.4, 4, 7), tolerance),
               of_narrow = made(narrow, evenly(0.4, 4, 7), tolerance);
    EXPECT_LE(missed(of_broad.table, broad), tolerance);
    EXPECT_LE(missed(of_narrow.table, narrow), tolerance);
    EXPECT_LE(of_narrow.chosen.unseen, tolerance);
    // A grid that a cubic needs for a half width of 0.009 rad/s has a thousand frequencies.
    EXPECT_LE(of_broad.solved, 31);
    EXPECT_LE(of_narrow.solved, 61);
    EXPECT_EQ(static_cast<std::size_t>(of_narrow.solved), of_narrow.chosen.omega.size());
  }
}

TEST(FrequenciesWhereNeeded, LieWhereResponsesBend) {
  const Made m = made(Law({{2.31, 0.004, 0.7}}), evenly(0.4, 4, 7), 1e-3);
  const auto near = [](double omega) { return std::abs(omega - 2.31) < 0.1; };
  // A uniform choice has an eighteenth of them there; twice as many at least.
  EXPECT_GE(9 * std::count_if(m.chosen.omega.begin(), m.chosen.omega.end(), near),
            static_cast<std::ptrdiff_t>(m.chosen.omega.size()));
}

TEST(FrequenciesWhereNeeded, KeepWhatIsSolvedAndDampingThatTakesEnergy) {
  const Law law({{2.31, 0.004, 0.7}});
  const Made m = made(law, evenly(0.4, 4, 7), 1e-2);
  const Coefficients solved = law.at(m.chosen.omega);
  for (std::size_t k = 0; k < solved.omega.size(); ++k) {
    const auto at = std::find(m.table.omega.begin(), m.table.omega.end(), solved.omega[k]);
    ASSERT_NE(at, m.table.omega.end());
    const auto i = static_cast<std::size_t>(at - m.table.omega.begin());
    EXPECT_EQ(m.table.A[i], solved.A[k]);
    EXPECT_EQ(m.table.B[i], solved.B[k]);
  }
  // Two vectors span what makes waves: eigenvalues that are zero come out as rounding of the largest, 1e4.
  for (const auto& B : m.table.B) EXPECT_GE(dense::symmetric_eigenvalues(B)[0], -1e-9);
}

TEST(FrequenciesWhereNeeded, OfNoiseAreRefusedWithTheNumber) {
  const Law law({});
  const auto noisy = [&](const std::vector<double>& omega) {
    Coefficients c = law.at(omega);
    for (std::size_t w = 0; w < omega.size(); ++w)
      c.B[w] *= 1 + 0.02 * RandomStream(7, static_cast<std::uint64_t>(1e9 * omega[w])).normal(0);
    return c;
  };
  EXPECT_THAT([&] { choose_frequencies(evenly(0.4, 4, 7), 1e-3, noisy); },
              ThrowsMessage<InputError>(testing::AnyOf(HasSubstr("still misses"), HasSubstr("is uncertain by"))));
}

TEST(FrequenciesWhereNeeded, RefuseToForeseeFromFourAndToNothing) {
  const Law law({});
  const auto solve = [&](const std::vector<double>& omega) { return law.at(omega); };
  EXPECT_THAT([&] { choose_frequencies(evenly(0.4, 4, 4), 1e-2, solve); },
              ThrowsMessage<InputError>(HasSubstr("got 4")));
  EXPECT_THAT([&] { choose_frequencies(evenly(0.4, 4, 9), 0, solve); }, ThrowsMessage<InputError>(HasSubstr("got 0")));
}

}  // namespace
}  // namespace hydro::potential::where_needed_test
