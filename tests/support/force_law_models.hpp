#pragma once
/// \file  Bodies and random states on which the laws of forces are tried.
#include <complex>

#include "dynamics/force/wave_signals.hpp"
#include "dynamics/model/model.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/random.hpp"

namespace support {

inline std::vector<dynamics::RigidBody> two_bodies() {
  const auto body = [](const char* name, double x) {
    return dynamics::RigidBody({.name = name,
                                .mass = 900,
                                .inertia = Eigen::Vector3d(400, 500, 600).asDiagonal(),
                                .rest_position = {Eigen::Vector3d(x, 0, 0)},
                                .centre_of_gravity = {Eigen::Vector3d(0.1, -0.2, 0.3)}});
  };
  return {body("a", 0), body("b", 4)};
}

/// Every body somewhere near rest, turned by up to about `angle`, moving at about 1 m/s and 1 rad/s.
inline dynamics::State random_state(const std::vector<dynamics::RigidBody>& bodies, std::uint64_t seed,
                                    double angle = 0.5) {
  dynamics::State s = dynamics::rest_state(bodies);
  const hydro::RandomStream random(seed, 17);
  std::uint64_t n = 0;
  const auto vector = [&](double size) {
    Eigen::Vector3d v;
    for (int i = 0; i < 3; ++i) v[i] = size * random.normal(n++);
    return v;
  };
  for (auto& pose : s.pose) {
    pose.centre += vector(0.2);
    pose.attitude = dynamics::rotation_exp(vector(angle));
  }
  for (Eigen::Index i = 0; i < s.velocity.size(); ++i) s.velocity[i] = random.normal(n++);
  return s;
}

/// Signals of a sea of two components.
struct TwoWaves {
  std::vector<double> omega{0.7, 1.3};
  Eigen::MatrixXcd amplitudes;  ///< (rows, 2)

  explicit TwoWaves(Eigen::Index rows) {
    const hydro::RandomStream random(2, 6);
    std::uint64_t n = 0;
    amplitudes = Eigen::MatrixXcd::NullaryExpr(rows, 2, [&] {
      const double re = random.normal(n++), im = random.normal(n++);
      return std::complex<double>(re, im);
    });
  }
  /// With a table of three steps of 0.1 s.
  dynamics::WaveSignals signals(double ramp_s = 0) const {
    Eigen::MatrixXd table(amplitudes.rows(), 3);
    for (int i = 0; i < 3; ++i)
      table.col(i) =
          (amplitudes * Eigen::Vector2cd(std::polar(1.0, omega[0] * 0.1 * i), std::polar(1.0, omega[1] * 0.1 * i)))
              .real();
    return {omega, amplitudes, table, 0.1, ramp_s};
  }
};

}  // namespace support
