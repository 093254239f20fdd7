#include "patches.hpp"

#include "hydro/base/machine.hpp"

namespace hydro::panels {
namespace {

// Half of the time of a panel method is spent here.
template <std::size_t row>
inline __attribute__((always_inline)) void horner(const double* at, double v, double* in_u) {
  constexpr std::size_t fours = row / 4;
  Four sum[fours];
  double rest[2] = {at[patch_nodes * row - 2], at[patch_nodes * row - 1]};
#pragma GCC unroll 8
  for (std::size_t k = 0; k < fours; ++k) sum[k] = *reinterpret_cast<const Four*>(at + (patch_nodes - 1) * row + 4 * k);
  for (std::size_t j = patch_nodes - 1; j-- > 0;) {
    const double* from = at + j * row;
#pragma GCC unroll 8
    for (std::size_t k = 0; k < fours; ++k) sum[k] = sum[k] * v + *reinterpret_cast<const Four*>(from + 4 * k);
    rest[0] = rest[0] * v + from[row - 2];
    rest[1] = rest[1] * v + from[row - 1];
  }
#pragma GCC unroll 8
  for (std::size_t k = 0; k < fours; ++k) *reinterpret_cast<Four*>(in_u + 4 * k) = sum[k];
  in_u[row - 2] = rest[0];
  in_u[row - 1] = rest[1];
}

}  // namespace

FROUDE_EVERY_MACHINE void sum_rows(const double* at, double v, std::array<double, 2 * patch_nodes>& in_u) {
  horner<2 * patch_nodes>(at, v, in_u.data());
}
FROUDE_EVERY_MACHINE void sum_rows(const double* at, double v, std::array<double, 3 * patch_nodes>& in_u) {
  horner<3 * patch_nodes>(at, v, in_u.data());
}

}  // namespace hydro::panels
