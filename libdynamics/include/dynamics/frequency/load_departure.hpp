#pragma once
/// \file  How far loads of springs, connectors and lines are from their linear part in a linear response. (D147)
#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "dynamics/frequency/small_motions.hpp"

namespace dynamics::frequency {

/// Where a kind of force departs furthest from stiffness and damping.
struct LoadDeparture {
  std::string effect;  ///< of the kind
  int mode;            ///< 6 body + 0 … 5
  double omega;        ///< rad/s
  double motion;       ///< amplitude of that mode there, m or rad
  double share;        ///< largest departure over the amplitude of the largest wave load, both in this mode
};

/// (D147): loads where waves of one amplitude move the bodies by a linear response, less the stiffness and damping that
/// this response has of them; of kinds that are not linear at rest all that changes. Kinds that need memory, friction
/// and contacts are left out. Cost: eight loads a response.
class DepartureFromLinear {
 public:
  /// `amplitude`: of the waves, m. `about` must live as long.
  DepartureFromLinear(const SmallMotions& about, double amplitude);

  /// Takes responses `xi`, (6N), per metre of wave, to the wave loads `X`, (6N), N and N m per metre, of one frequency,
  /// rad/s. \throws hydro::InputError or hydro::NumericsError where a kind has no load so far from rest
  void take(double omega, const Eigen::VectorXcd& xi, const Eigen::VectorXcd& X);

  /// Of all that was taken; none where waves move nothing. A load without a number has an infinite departure.
  std::optional<LoadDeparture> largest() const;

 private:
  /// One kind of force about where the bodies are still.
  struct Kind {
    const ForceKind* of;
    Eigen::VectorXd at_rest;  // load, (6N)
    BlockMatrix stiffness, damping;
    Eigen::VectorXd departure, omega, motion;  // largest of each mode, N and N m, where, and how far that moves
  };
  const SmallMotions& about_;
  double amplitude_;
  std::vector<Kind> kinds_;
  Eigen::VectorXd load_, work_;  // largest of each mode
};

}  // namespace dynamics::frequency
