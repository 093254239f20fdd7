#pragma once
/// \file  Fresh water of any depth.
#include "hydro/base/types.hpp"

namespace support {

inline hydro::Water water_of(double depth) {
  return {.density = 1000, .gravity = 9.81, .depth = hydro::WaterDepth::from_metres(depth)};
}
inline const hydro::Water deep{.density = 1000, .gravity = 9.81, .depth = hydro::WaterDepth::infinite()};

}  // namespace support
