#pragma once
/// \file  Gauss's rule of twenty points, made once. Not installed.
#include "waves/gauss_legendre.hpp"

namespace hydro::panels {

inline const waves::GaussLegendre<20>& gauss_rule() {
  static const waves::GaussLegendre<20> rule;
  return rule;
}

}  // namespace hydro::panels
