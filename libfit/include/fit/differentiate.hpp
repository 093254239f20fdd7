#pragma once
/// \file  Velocity and acceleration from a measured position (or velocity): zero phase, stated bandwidth and error;
///        (F5)-(F6), (F44)-(F45), docs/theory/fit.md.
#include <span>
#include <vector>

namespace fit {

/// Value or derivative at the middle of 2m + 1 even samples by fixed weights, which are symmetric (order 0, 2) or
/// antisymmetric (order 1) about the middle, so that no frequency is delayed.
class DerivativeWeights {
 public:
  /// What comes out for an input e^{iωt}, over the true (iω)^order: real, 1 at ω = 0. (F6)
  double gain(double omega) const;
  /// Standard deviation of the output for white noise of standard deviation 1 in the input.
  double noise_gain() const;
  /// At every sample that has m neighbours on both sides: shape (n − 2m), the first belonging to sample m.
  std::vector<double> apply(std::span<const double> values) const;
  int half_width() const { return half_width_; }
  double middle() const { return weights_[static_cast<std::size_t>(half_width_)]; }

 protected:
  /// \throws hydro::InputError unless step > 0 and order is 0, 1 or 2
  DerivativeWeights(int order, int half_width, double step_s);

  int order_, half_width_;
  double step_;
  std::vector<double> weights_;  // 2m + 1
};

/// Of a moving least-squares polynomial of degree 4 (Savitzky & Golay 1964). Its gain falls like 1 − c(ωmΔt)^q with
/// q = 6 for order 0, 4 for orders 1 and 2. (F5)
class LocalPolynomial : public DerivativeWeights {
 public:
  /// \throws hydro::InputError unless half_width >= 3, step > 0, order is 0, 1 or 2
  LocalPolynomial(int order, int half_width, double step_s);
};

/// Of the smoothing spline of degree 5 with a knot at every sample, Σ(x − s)² + λ Δt⁵ ∫ (s‴)² dt at its least, far
/// from the ends: the gain falls like 1 − λ(ωΔt)⁶, for all orders alike. (F44)
class SmoothingSpline : public DerivativeWeights {
 public:
  /// \throws hydro::InputError unless 0 < stiffness < 1e15, step > 0, order is 0, 1 or 2
  SmoothingSpline(int order, double stiffness, double step_s);
  /// λ with which the gain of this order is 1 − error at ω. \throws hydro::InputError where splines of this sampling
  /// are not as good without any smoothing
  static double stiffness(int order, double omega, double error, double step_s);
};

/// Standard deviation of white noise in even samples, from what smoothing takes off them: weights of order 0.
double noise_in(std::span<const double> values, const DerivativeWeights& smooth);

/// Weights of order 0 that keep 99 % at five times the main frequency of the samples, or the shortest where they have
/// no main frequency.
LocalPolynomial smoother_of(std::span<const double> values, double step_s);

/// A motion and its derivatives on the samples where both could be had.
struct Motion {
  std::size_t first;                 ///< index of the input sample that the first output sample belongs to
  std::vector<double> velocity;      ///< m/s
  std::vector<double> acceleration;  ///< m/s²
  double main_period_s;              ///< of the highest peak of the input's spectrum
  int half_width;                    ///< m samples at each end are given up
  double bandwidth_hz;               ///< below it the gain of the last derivative taken is within 1 % of 1
  double gain_error_main;            ///< |gain − 1| of the acceleration at the main frequency
  double gain_error_fifth;           ///< … at five times the main frequency
  double noise_velocity;             ///< standard deviation of the velocity from noise in the input, m/s
  double noise_acceleration;         ///< m/s²
  double noise = 0;                  ///< of the input itself, m or m/s
  /// What gave value, velocity and acceleration; of a velocity that was passed through, value and acceleration. Empty
  /// for a Fourier series.
  std::vector<DerivativeWeights> weights = {};
  double left = 0;  ///< Fourier series: rms of what is not in it, over that of the motion
};

enum class Derivative {
  local_polynomial,  ///< (F5)
  smoothing_spline,  ///< (F44): gives up more at the ends, and has less noise for the same bandwidth
  fourier_series     ///< (F45): of a motion that repeats; least noise, and nothing given up
};

/// Both derivatives of a position sampled evenly. The window is the longest, or the spline the stiffest, that keeps the
/// error of the acceleration below 1 % at `bandwidth_hz`, or, where that is 0, at five times the main frequency; a
/// series has the harmonics up to there. Noise in the input is taken from what is smoothed away (white noise assumed).
/// \throws hydro::InputError for a record with fewer than two main periods or 64 samples, a bandwidth that needs more
/// than the sampling rate gives, a record too short for the spline, a motion that does not repeat for a series
Motion from_position(std::span<const double> position_m, double step_s, double bandwidth_hz = 0,
                     Derivative method = Derivative::local_polynomial);

/// The acceleration of a velocity sampled evenly; the velocity itself is passed through unchanged, but for a series,
/// which gives both. Else as above.
Motion from_velocity(std::span<const double> velocity_m_s, double step_s, double bandwidth_hz = 0,
                     Derivative method = Derivative::local_polynomial);

}  // namespace fit
