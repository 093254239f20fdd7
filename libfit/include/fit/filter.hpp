#pragma once
/// \file  Filters without delay, each with a gain that is known and a stretch at both ends that it cannot give;
///        (F16)-(F18), docs/theory/fit.md.
#include <span>
#include <string>
#include <vector>

namespace fit {

/// A linear filter whose output is neither early nor late: its gain is real at every frequency.
///
/// Recursive filters run forward and then backward, so their gain is the square of one pass; the others have symmetric
/// weights. Nothing is extrapolated: samples whose value would lean on what lies beyond the record are given up.
class ZeroPhaseFilter {
 public:
  /// Low pass, gain 1/(1 + (tan(ωΔt/2)/tan(ω_cΔt/2))^{2·order}): 1/2 at the cutoff; (F17).
  /// \throws hydro::InputError unless 1 <= order <= 10 and 0 < cutoff < 1/(2Δt); so do the others for their numbers
  static ZeroPhaseFilter butterworth(int order, double cutoff_hz, double step_s);
  /// Low pass that falls off sooner than a Butterworth filter of that order, and wavers before: gain
  /// N/(1 + ε²T_n²(x x_c)), x = tan(ωΔt/2)/tan(ω_cΔt/2), 1/2 at the cutoff, within `ripple` of 1 below that but for the
  /// way down; (F18). \throws also unless 1e-6 <= ripple <= 0.1
  static ZeroPhaseFilter chebyshev(int order, double ripple, double cutoff_hz, double step_s);
  /// Low pass of weights e^(−t²/2σ²): gain e^(−ln 2 (f/f_c)²), to 1e-4 up to the cutoff, which never wavers and falls
  /// off early; (F18). \throws also unless the cutoff lies below 0.2/Δt, above which samples are too few for the bell
  static ZeroPhaseFilter gaussian(double cutoff_hz, double step_s);
  /// Low pass of symmetric weights, sinc under a Kaiser window of 60 dB: 1/2 at the cutoff, within 2e-3 of 1 below half
  /// the cutoff and of 0 above one and a half of it; (F18).
  static ZeroPhaseFilter finite(double cutoff_hz, double step_s);
  /// Takes out one line: gain 0 at the centre, 1/2 half the width beside it; (F18).
  static ZeroPhaseFilter notch(double centre_hz, double width_hz, double step_s);
  /// Mean of an odd number of samples. Simple and poor: its gain has side lobes of −22 % and falls off early; (F18).
  static ZeroPhaseFilter moving_average(int samples, double step_s);

  /// Output over input for e^{iωt}: real, 1 at ω = 0.
  double gain(double omega) const;
  /// Below this frequency the gain is within 1 % of 1, Hz. For a notch: the lower edge of what it touches.
  double bandwidth_hz() const;
  /// Samples given up at each end: there less than 1e-4 of the filter's memory is left.
  std::size_t settling() const { return settling_; }
  /// "Butterworth low pass of order 4, 3.33 Hz, forward and backward".
  const std::string& name() const { return name_; }

  /// Shape (n − 2 settling()), the first sample belonging to sample settling() of the input.
  /// \throws hydro::InputError if nothing would be left
  std::vector<double> apply(std::span<const double> values) const;

 private:
  /// y_j = b0 x_j + b1 x_{j−1} + b2 x_{j−2} − a1 y_{j−1} − a2 y_{j−2}.
  struct Section {
    double b0, b1, b2, a1, a2;
    void run(std::vector<double>& values) const;
  };
  ZeroPhaseFilter(std::string name, double step_s) : name_(std::move(name)), step_(step_s) {}
  void add_pair(double q, double k);
  void add_first_order(double k);
  void settle_sections();

  std::string name_;
  double step_;
  std::vector<Section> sections_;  // of one pass; empty for symmetric weights
  std::vector<double> weights_;    // 2m + 1
  std::size_t settling_ = 0;
};

}  // namespace fit
