#include "hydro/radiation/excitation_kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"

namespace excitation_kernel_test {
namespace {

using hydro::radiation::ExcitationKernel;
using hydro::radiation::ExcitationTable;

constexpr double force = 3, width = 0.8, delay = 1.7;  // N/m, s, s

/// X = F e^{−(ωs)²/2} e^{−iωd}: felt as a bell of width s, d seconds after the wave passes the origin.
std::complex<double> X(double omega) {
  return std::polar(force * std::exp(-std::pow(omega * width, 2) / 2), -omega * delay);
}
double f(double t) {
  return force / (width * std::sqrt(2 * std::numbers::pi)) * std::exp(-std::pow((t - delay) / width, 2) / 2);
}

ExcitationTable table(double last, int count) {
  ExcitationTable out;
  for (int i = 1; i <= count; ++i) {
    out.omega.push_back(last * i / count);
    out.X.push_back(Eigen::VectorXcd::Constant(1, X(out.omega.back())));
  }
  return out;
}

// (R22)
TEST(ExcitationKernel, IsTheBellOfABellShapedExcitation) {
  const ExcitationKernel kernel(table(8, 160), 0.1, 20);
  // Cubic in 0.05 rad/s cut into pieces of 0.0125: X″h²/12 = 6e-5 over 3 rad/s; beyond 8 rad/s lies e^{−20}.
  for (std::size_t s = 0; s < kernel.samples(); ++s) {
    const double t = 0.1 * (static_cast<double>(s) - static_cast<double>(kernel.reach()));
    EXPECT_NEAR(kernel.at(s)[0], f(t), 1e-3) << t;
  }
  EXPECT_LT(kernel.missing()[0], 1e-7);
}

// A regular wave must give back X: amplitude and phase.
TEST(ExcitationKernel, GivesTheLoadOfARegularWave) {
  const ExcitationKernel kernel(table(8, 160), 0.1, 20);
  for (const double omega : {0.4, 1.1, 2.0}) {
    std::vector<double> elevation;
    for (int i = 0; i < 600; ++i) elevation.push_back(std::cos(omega * 0.1 * i));
    const auto expected = (X(omega) * std::polar(1.0, omega * 0.1 * 300)).real();
    EXPECT_NEAR(kernel.load(elevation, 300)[0], expected, 3e-3) << omega;
  }
}

TEST(ExcitationKernel, FeelsTheWaveBeforeItsCrestIsThere) {
  ExcitationTable early = table(8, 160);
  for (std::size_t i = 0; i < early.omega.size(); ++i) early.X[i] *= std::polar(1.0, 2 * delay * early.omega[i]);
  const ExcitationKernel kernel(early, 0.1, 20);
  const auto at = [&](double t) { return kernel.at(static_cast<std::size_t>(std::lround(t / 0.1) + 200))[0]; };
  EXPECT_NEAR(at(-delay), f(delay), 1e-3);
  EXPECT_NEAR(at(delay), f(3 * delay), 1e-3);
}

TEST(ExcitationKernel, RefusesMoreThanTheFrequenciesTell) {
  EXPECT_THROW(ExcitationKernel(table(8, 80), 0.1, 40), hydro::InputError);
  EXPECT_THROW(ExcitationKernel({}, 0.1, 4), hydro::InputError);
  EXPECT_THROW(ExcitationKernel(table(8, 80), 0.1, 20).load({1, 2}, 2), hydro::InputError);
}

}  // namespace
}  // namespace excitation_kernel_test
