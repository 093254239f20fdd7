#pragma once
/// \file  Velocity and acceleration from a measured position (or velocity): zero phase, stated bandwidth and error;
///        (F5)-(F6), docs/theory/fit.md.
#include <span>
#include <vector>

namespace fit {

/// Derivative of a moving least-squares polynomial of degree 4 at the middle of 2m + 1 even samples (Savitzky & Golay
/// 1964). The weights are symmetric or antisymmetric about the middle, so no frequency is delayed.
class LocalPolynomial {
 public:
  /// \throws hydro::InputError unless half_width >= 3, step > 0, order is 0, 1 or 2
  LocalPolynomial(int order, int half_width, double step_s);

  /// What comes out for an input e^{iωt}, over the true (iω)^order: real, 1 at ω = 0; falls like 1 − c(ωmΔt)^q with
  /// q = 6 for order 0, 4 for orders 1 and 2.
  double gain(double omega) const;
  /// Standard deviation of the output for white noise of standard deviation 1 in the input.
  double noise_gain() const;
  /// At every sample that has m neighbours on both sides: shape (n − 2m), the first belonging to sample m.
  std::vector<double> apply(std::span<const double> values) const;
  int half_width() const { return half_width_; }

 private:
  int order_, half_width_;
  double step_;
  std::vector<double> weights_;  // 2m + 1
};

/// A motion and its derivatives on the samples where both could be had.
struct Motion {
  std::size_t first;                 ///< index of the input sample that the first output sample belongs to
  std::vector<double> velocity;      ///< m/s
  std::vector<double> acceleration;  ///< m/s²
  double main_period_s;              ///< of the highest peak of the input's spectrum
  int half_width;                    ///< m of the local polynomial; m samples at each end are given up
  double bandwidth_hz;               ///< below it the gain of the last derivative taken is within 1 % of 1
  double gain_error_main;            ///< |gain − 1| of the acceleration at the main frequency
  double gain_error_fifth;           ///< … at five times the main frequency
  double noise_velocity;             ///< standard deviation of the velocity from noise in the input, m/s
  double noise_acceleration;         ///< m/s²
};

/// Both derivatives of a position sampled evenly. The window is the longest that keeps the error of the acceleration
/// below 1 % at `bandwidth_hz`, or, where that is 0, at five times the main frequency.
/// Noise in the input is taken from what the window smooths away (white noise assumed).
/// \throws hydro::InputError for a record with fewer than two main periods or 64 samples, or a bandwidth that needs
/// more than the sampling rate gives
Motion from_position(std::span<const double> position_m, double step_s, double bandwidth_hz = 0);

/// The acceleration of a velocity sampled evenly; the velocity itself is passed through unchanged. Else as above.
Motion from_velocity(std::span<const double> velocity_m_s, double step_s, double bandwidth_hz = 0);

}  // namespace fit
