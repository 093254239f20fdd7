#pragma once
/// \file  Which partial waves are kept. Not installed.
#include <functional>
#include <vector>

#include "hydro/cylinders/layout.hpp"
#include "hydro/cylinders/vertical_modes.hpp"

namespace hydro::cylinders {

/// Which partial waves carry the interaction: azimuthal orders −order[n] … order[n] of the vertical mode n.
struct Channels {
  std::vector<int> order;  ///< by vertical mode, the wave first; does not increase
  double left_out = 0;  ///< coupling beyond the highest order and vertical mode that can be had, if above the threshold
  int vertical() const { return static_cast<int>(order.size()); }
  int highest_order() const { return order.front(); }
  int count() const;                     ///< partial waves of one cylinder
  int vertical_of(int azimuthal) const;  ///< vertical modes of one azimuthal order
  Channels united_with(const Channels& other) const;
};

using WantedPair = std::function<bool(std::size_t, std::size_t)>;

/// The partial waves whose coupling between the closest of the wanted pairs exceeds `threshold`, estimated before
/// anything is solved (C11). At least the orders −1 … 1 of the wave.
Channels coupled_channels(const std::vector<Cylinder>& cylinders, const VerticalModes& modes, double threshold,
                          const WantedPair& wanted);

}  // namespace hydro::cylinders
