#include "dynamics/frequency/hill_equation.hpp"

#include <cmath>
#include <numbers>

#include "dynamics/frequency/floquet.hpp"
#include "harmonics.hpp"
#include "hydro/base/error.hpp"

namespace dynamics::frequency {
namespace {

/// k, c, m of the motion along a shape at one time of a motion.
Eigen::Vector3d along(PeriodicSystem& system, const CoordinateMotion& motion, const Eigen::VectorXd& shape,
                      double own) {
  const PeriodicMemory* memory = system.memory();
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(memory != nullptr ? memory->B.cols() : 0);
  const PeriodicSample s = system.at(motion, none);
  const auto form = [&](const Eigen::MatrixXd& m) { return shape.dot(m * shape); };
  Eigen::Vector3d out(form(s.by_value), form(s.by_rate), form(s.by_acceleration));
  if (memory == nullptr) return out;
  // K̂ = B + iω(A − A∞), and −by_load is the transpose of what makes the velocities.
  const std::complex<double> K =
      -((s.by_load.transpose() * shape).transpose() * memory->transform(own) * (s.velocity_by_rate * shape)).value();
  out[1] += K.real(), out[2] += K.imag() / own;
  return out;
}

}  // namespace

double HillEquation::growth(double size) const {
  const auto a = [&](double t) {
    Eigen::Vector3d kcm = at_rest;
    kcm += size * (by_size * harmonics_at(by_size.cols() / 2, omega * t));
    return Eigen::MatrixXd(Eigen::Matrix2d{{0, 1}, {-kcm[0] / kcm[2], -kcm[1] / kcm[2]}});
  };
  return std::abs(floquet_multipliers(a, 2 * std::numbers::pi / omega)[0]);
}

std::optional<double> HillEquation::least_growing(double largest) const {
  constexpr int steps = 16;
  const auto share = [&](int i) { return largest * i / steps; };
  int first = 0;
  while (first <= steps && growth(share(first)) <= 1) ++first;
  if (first > steps) return std::nullopt;
  double low = share(std::max(first - 1, 0)), high = share(first);
  while (high - low > 1e-3 * largest) (growth((low + high) / 2) > 1 ? high : low) = (low + high) / 2;
  return (low + high) / 2;
}

// (Q14)
HillEquation hill_equation(const Family& family, double small, const Eigen::VectorXd& shape, double own) {
  const auto driven = family(small), still = family(1e-6 * small);
  const Balance linear = balance(*driven, at_rest(*driven));
  if (!linear.found)
    throw hydro::NumericsError(fmt::format("there is no linear response at {:.6g} rad/s", driven->omega()));
  const Eigen::Index H = linear.motion.harmonics(), count = 4 * (H + 1);
  HillEquation out{driven->omega(), along(*still, at_rest(*still).at(0), shape, own),
                   Eigen::MatrixXd::Zero(3, 2 * H + 1)};
  for (Eigen::Index j = 0; j < count; ++j) {
    const double t = 2 * std::numbers::pi / out.omega * static_cast<double>(j) / static_cast<double>(count);
    const Eigen::Vector3d varied = (along(*driven, linear.motion.at(t), shape, own) - out.at_rest) / small;
    for (Eigen::Index k = 0; k <= 2 * H; ++k) {
      const double phase = static_cast<double>((k + 1) / 2) * out.omega * t;
      const double weight = k == 0 ? 1.0 : 2 * (k % 2 == 1 ? std::cos(phase) : std::sin(phase));
      out.by_size.col(k) += weight / static_cast<double>(count) * varied;
    }
  }
  return out;
}

}  // namespace dynamics::frequency
