#include "hydro/potential/far_field.hpp"

#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/waves/dispersion.hpp"

namespace hydro::potential {

using std::numbers::pi;

// Energy goes with the group velocity, and momentum is energy over the phase velocity. What the incident wave loses, it
// loses ahead of the bodies, where what they add interferes with it.
MeanDrift mean_drift(const FarField& far, double omega, const Water& water, bool held) {
  require(std::isfinite(omega) && omega > 0, "a frequency must be finite and positive, got {} rad/s", omega);
  ensure(!far.angle.empty(), "a far field has angles");
  const double k = waves::wavenumber(omega, water), phase_velocity = omega / k;
  const double flux = water.density * water.gravity * waves::group_velocity(omega, water) / k;
  const Eigen::VectorXcd A = held ? far.scattered : Eigen::VectorXcd(far.scattered + far.radiated);
  const double lost = -2 * flux * A[0].real();
  const double each = 2 * flux / static_cast<double>(far.angle.size());
  const auto towards = [](double angle) { return Eigen::Vector2d(std::cos(angle), std::sin(angle)); };
  MeanDrift out{.force = lost * towards(far.angle.front()) / phase_velocity, .taken = lost, .scattered = 0};
  for (Eigen::Index t = 0; t < A.size(); ++t) {
    const double carried = each * std::norm(A[t]);
    out.force -= carried * towards(far.angle[static_cast<std::size_t>(t)]) / phase_velocity;
    out.scattered += carried;
  }
  out.taken -= out.scattered;
  return out;
}

// A holds harmonics up to about k times the extent, its square and a turn by one twice as many.
std::vector<double> angles_around(double heading, double k, double extent, int orders) {
  const double reach = k * extent;
  const int count = 4 * static_cast<int>(reach + 10 * std::cbrt(reach) + orders + 11);
  std::vector<double> out;
  for (int t = 0; t < count; ++t) out.push_back(heading + 2 * pi * t / count);
  return out;
}

}  // namespace hydro::potential
