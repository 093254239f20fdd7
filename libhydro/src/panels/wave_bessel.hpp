#pragma once
/// \file  Bessel functions of the orders 0 and 1 as a pair of panels needs them: fast, from a table and Hankel's
/// expansion. (G5) in docs/theory/panels.md. Not installed.
namespace hydro::panels {

struct BesselPair {
  double order0, order1;
};
/// J₀(x), J₁(x), x >= 0; absolute error 1e-13.
BesselPair bessel_j(double x);
/// Y₀(x), Y₁(x), x >= 16; absolute error 1e-13.
BesselPair bessel_y_far(double x);

}  // namespace hydro::panels
