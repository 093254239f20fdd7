#pragma once
/// \file  Wave loads from the history of the surface elevation: the impulse response of excitation.
#include <Eigen/Core>

#include <complex>
#include <vector>

namespace hydro::radiation {

/// Excitation per metre of wave amplitude of some loads, in the phase convention Re(X e^{iωt}) of conventions.md.
struct ExcitationTable {
  std::vector<double> omega;        ///< rad/s, positive, strictly increasing
  std::vector<Eigen::VectorXcd> X;  ///< one vector of loads a frequency, N/m
};

/// f(t) with F(t) = ∫ f(τ) η(t−τ) dτ, sampled at t = −m h … m h.
///
///   f(t) = (1/π) Re ∫₀^∞ X(ω) e^{iωt} dω      (R22)
///
/// Not causal: the wave is felt before its crest passes the point where η is measured, so f is not zero at t < 0 and a
/// load needs the elevation of `length` seconds to come. X is cubic between its frequencies (P6), its first value kept
/// down to ω = 0, where an impulse response has no weight to lose, and nothing beyond the last.
class ExcitationKernel {
 public:
  /// \throws InputError if the table is empty, ragged or not increasing, or if step or length are not positive, or
  /// length is beyond π / max Δω, up to which the frequencies tell it
  ExcitationKernel(const ExcitationTable& table, double step, double length);

  std::size_t reach() const { return reach_; }  ///< m: samples to either side
  double step() const { return step_; }
  /// f at (sample − reach) · step, one entry a load.
  Eigen::VectorXd at(std::size_t sample) const { return f_.col(static_cast<Eigen::Index>(sample)); }
  std::size_t samples() const { return 2 * reach_ + 1; }

  /// The load at sample n of a series of the elevation in steps of step(), by the trapezium rule; what lies outside the
  /// series is still water. \throws InputError if n is beyond the series
  Eigen::VectorXd load(const std::vector<double>& elevation, std::size_t n) const;

  /// Bound of what is missing beyond the last frequency, if |X| falls at least as ω⁻² from there, one entry a load,
  /// N/s.
  const Eigen::VectorXd& missing() const { return missing_; }

 private:
  double step_;
  std::size_t reach_;
  Eigen::MatrixXd f_;  // (loads, samples)
  Eigen::VectorXd missing_;
};

}  // namespace hydro::radiation
