#pragma once
// Water from a table beside the sum that it stands for.
#include <gtest/gtest.h>

#include "hydro/waves/kinematics/field.hpp"

namespace froude_test {

/// At places within a table's box and beyond it.
inline void expect_same_water(const hydro::waves::WaveField& summed, const hydro::waves::WaveField& tabled) {
  for (const double x : {0.0, 2.0, 30.0})
    for (const double t : {1.0, 7.0}) {
      const auto a = summed.at(t, {x, 0.5, -3}), b = tabled.at(t, {x, 0.5, -3});
      EXPECT_LT((a.velocity - b.velocity).norm(), 1e-5)
          << "1e-6 of each of some thousand components, which are some 3 m/s in all";
      EXPECT_LT((a.acceleration - b.acceleration).norm(), 1e-4);
    }
}

}  // namespace froude_test
