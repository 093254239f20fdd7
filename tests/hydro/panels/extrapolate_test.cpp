// Steps to panels of no size, and weights between frequencies, on sequences whose limit is known.
#include "panels/extrapolate.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hydro::panels::extrapolate_test {
namespace {

using Eigen::MatrixXd;

MatrixXd one(double value) { return MatrixXd::Constant(1, 1, value); }

/// 3 + error of mesh n = 0, 1, 2, which falls by `ratio` from each to the next.
double of_mesh(int n, double ratio) { return 3 + 0.7 * std::pow(ratio, -n); }

TEST(PanelExtrapolation, TwoMeshesComeToTheLimitOfErrorsThatFallByRootEight) {
  const double ratio = std::sqrt(8.0);
  const MatrixXd step = step_to_the_limit({one(of_mesh(0, ratio)), one(of_mesh(1, ratio))});
  EXPECT_NEAR(of_mesh(1, ratio) + step(0, 0), 3, 1e-14);  // rounding
}

TEST(PanelExtrapolation, ThreeMeshesSeeByWhatTheErrorFalls) {
  for (const double ratio : {2.1, 2.5, 3.9}) {
    const MatrixXd step = step_to_the_limit({one(of_mesh(0, ratio)), one(of_mesh(1, ratio)), one(of_mesh(2, ratio))});
    EXPECT_NEAR(of_mesh(2, ratio) + step(0, 0), 3, 1e-13) << ratio;  // rounding
  }
}

TEST(PanelExtrapolation, WhatIsNoSequenceIsNotTrusted) {
  // Differences of unlike sign, or that grow: a step of at most the last difference.
  EXPECT_LE(std::abs(step_to_the_limit({one(1), one(2), one(1.5)})(0, 0)), 0.5);
  EXPECT_LE(std::abs(step_to_the_limit({one(1), one(1.1), one(2.1)})(0, 0)), 1.0 + 1e-12);
}

TEST(PanelExtrapolation, TheDoubtCoversErrorsThatFallByTwoAndAFifthToFour) {
  for (const double ratio : {2.2, 2.5, 3.4, 4.0}) {
    const double step = step_to_the_limit({one(of_mesh(0, ratio)), one(of_mesh(1, ratio))})(0, 0);
    EXPECT_LT(std::abs(of_mesh(1, ratio) + step - 3), doubtful_share(2) * std::abs(step)) << ratio;
  }
}

TEST(PanelExtrapolation, BetweenFrequenciesACubicIsExact) {
  const auto cubic = [](double x) { return 1 - 2 * x + 0.5 * x * x * x; };
  const std::vector<double> nodes{0.2, 0.7, 1.1, 1.9, 2.5};
  for (const int without : {-1, 0, 2})
    for (const double x : {0.2, 0.9, 2.2}) {
      const std::vector<double> weights = cubic_weights(nodes, x, without);
      double sum = 0;
      for (std::size_t i = 0; i < nodes.size(); ++i) sum += weights[i] * cubic(nodes[i]);
      EXPECT_NEAR(sum, cubic(x), 1e-13) << without << ' ' << x;
      if (without >= 0) {
        EXPECT_EQ(weights[static_cast<std::size_t>(without)], 0);
      }
    }
  EXPECT_EQ(cubic_weights({1.0}, 1.0), std::vector<double>{1});
}

// A resonance is refined by nodes that crowd about it; the cubic beside it must not be made of them alone.
TEST(PanelExtrapolation, CubicsHaveTwoNodesOnEachSide) {
  const std::vector<double> nodes{0, 0.5, 1, 1.05, 1.1, 1.15, 2, 2.5};
  const auto used = [&](double x) {
    std::vector<double> out;
    const std::vector<double> weights = cubic_weights(nodes, x);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (weights[i] != 0) out.push_back(nodes[i]);
    return out;
  };
  EXPECT_EQ(used(0.9), (std::vector<double>{0, 0.5, 1, 1.05}));
  EXPECT_EQ(used(1.3), (std::vector<double>{1.1, 1.15, 2, 2.5}));
  EXPECT_EQ(used(0.1), (std::vector<double>{0, 0.5, 1, 1.05}));
  EXPECT_EQ(used(2.4), (std::vector<double>{1.1, 1.15, 2, 2.5}));
}

}  // namespace
}  // namespace hydro::panels::extrapolate_test
