#pragma once
/// \file  Linearly implicit Runge-Kutta steps of a line, of order 4 with an estimate of their error. (D139), (D140)
#include <Eigen/Core>

#include "chain_balance.hpp"

namespace dynamics::line {

/// RODAS (Hairer & Wanner 1996, section VI.4): six stages, stiffly accurate, L-stable. A step takes one linearisation,
/// one factorisation and six solutions; no iteration.
class Rosenbrock {
 public:
  explicit Rosenbrock(const Line& line);

  /// Begins at a state in balance, with its accelerations a. \returns its powers
  const Powers& begin(const State& state, const Places& a);

  /// Which piece of the loads over time acts; begin() has to follow. (D150)
  void stay_in_piece_of(double t) { balance_.stay_in_piece_of(t); }

  /// Whether it is at this state already, but for what rounding did to its time.
  bool is_at(const State& state);

  /// A step of h seconds from where it is. \returns its error: of tensions as a share of the largest one or of the
  /// line's weight, and of places as a share of a segment, whichever is larger; NaN where there is no step
  double try_step(double h);
  /// Goes on from where try_step() led, to which `state` and `a` are set. \returns the powers there
  const Powers& accept(State& state, Places& a);

 private:
  static constexpr int stages = 6;
  Eigen::Map<Places> places(double* of) { return {of, 3, nodes_}; }
  Instant instant(double t, double* y, const Places* water_at = nullptr);
  void find_right_side(int i, double h);
  void add_stage(int i, double h);
  double error() const;

  const Line& line_;
  ChainBalance balance_;
  Eigen::Index nodes_, places_;  // and numbers of places
  double t_ = 0, h_ = 0, weight_ = 0;
  // x, v, a and T one after the other: where it is, at a stage, and what the stages add.
  Eigen::VectorXd from_, at_;
  Eigen::MatrixXd add_;
  Eigen::VectorXd rates_;  // ρ, σ and ρ/(γh) + σ of (D139)
  Places water_at_;
  Balance here_, by_time_, right_;
  Powers powers_;
};

}  // namespace dynamics::line
