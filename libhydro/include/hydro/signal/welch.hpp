#pragma once
/// \file  Spectra from records by Welch's method, with the confidence they deserve; (S5)-(S7), docs/theory/signal.md.
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "hydro/signal/spectrum.hpp"

namespace hydro::signal {

/// The step of an evenly sampled record, s: (last − first)/(n − 1).
/// A time stamp may be off the even grid by at most 2 % of the step, which rounding in a text file can do; at half the
/// sampling rate that is a phase error of 0.02π. \throws InputError naming the first sample that is further off
double even_step(std::span<const double> time_s);

enum class Window { hann, rectangular };
enum class Detrend {
  segment_mean,  ///< each segment loses its own mean: variance slower than a segment is left out
  record_mean    ///< the mean of the whole record: slow variance stays, in the lowest two frequencies
};

struct WelchOptions {
  std::size_t segment;   ///< samples per segment, even: resolution is 1/(segment·Δt), times 1.5 for Hann
  double overlap = 0.5;  ///< 0 <= overlap < 1; a half loses little information under a Hann window
  Window window = Window::hann;
  Detrend detrend = Detrend::segment_mean;
};

/// Segments of an even length such that a record of n samples holds 15 of them, half overlapping (8 side by side).
/// \throws InputError for n < 32
WelchOptions fifteen_segments(std::size_t n);

struct WelchSpectrum {
  SpectrumPerHz spectrum;  ///< 0, 1/T … 1/(2Δt) with T = segment·Δt; ∫ S df by trapezium is the mean weighted variance
  double dof;              ///< ν: each density (but the first and last) is distributed like S χ²_ν/ν; (S6)
  std::size_t segments;      ///< averaged
  std::size_t samples_used;  ///< what is left over at the end of the record takes no part
  double mean;               ///< of the whole record
  double variance;           ///< of the whole record about its mean (divided by n), to compare with ∫ S df
  double resolution_hz;      ///< equivalent noise bandwidth: 1/T (rectangular), 1.5/T (Hann)
};

/// One-sided variance density of an evenly sampled record, variance kept (S5).
/// A line of amplitude a at a bin's frequency adds a²/2 to ∫ S df, spread over the window's width.
/// \throws InputError: fewer samples than one segment, an odd segment or one below 4, overlap outside [0, 1), a value
/// that is not finite, a step that is not positive
WelchSpectrum welch(std::span<const double> values, double step_s, const WelchOptions& options);

/// Degrees of freedom of an average of `segments` periodograms of windows that overlap (S6).
double welch_dof(std::size_t segments, const WelchOptions& options);

/// The density in truth lies between lower·S and upper·S with probability `level` (S7), frequency by frequency; for a
/// Gaussian record and a spectrum that is flat over resolution_hz. The first and last frequency have half the dof.
struct BandFactors {
  double lower, upper;
};
BandFactors confidence_band(double dof, double level);  ///< \throws InputError unless 0 < level < 1

/// γ² that unrelated signals stay below at a share `level` of the frequencies, of so many averages; (S10).
/// \throws InputError unless 0 < level < 1 and averages > 1
double coherence_threshold(double averages, double level);

/// What one signal does to another, frequency by frequency; kernel e^{−iωt}, so phases are those of Re(a e^{+iωt}).
struct TransferEstimate {
  std::vector<double> frequency_hz;
  std::vector<std::complex<double>> h1;     ///< S_xy/S_xx: right where only the output is noisy; (S8)
  std::vector<std::complex<double>> h2;     ///< S_yy/S_yx: right where only the input is noisy; (S8)
  std::vector<double> coherence;            ///< γ², 0 … 1
  std::vector<double> gain_relative_error;  ///< one standard error of |H1| / |H1|, and of its phase in rad; (S9)
  double averages;                          ///< ν/2, as if that many independent segments had been averaged
  double coherence_threshold;  ///< γ² that unrelated signals stay below at 95 % of the frequencies; (S10)
};

/// |H_v| = √(S_yy/S_xx) = √(|H1| |H2|), between H1 and H2: right where both signals are noisy in the same proportion;
/// (S8). NaN as h1. Its phase is that of both.
double total_gain(const TransferEstimate& estimate, std::size_t frequency);

/// Both records sampled at the same instants. Where the input has no energy, h1, h2 and the error are NaN and the
/// coherence is 0. The window must resolve the response: a peak narrower than resolution_hz is biased low.
/// \throws InputError as welch(), for records of different length, and for fewer than two segments (the coherence
/// of a single one is 1, whatever the signals)
TransferEstimate transfer(std::span<const double> input, std::span<const double> output, double step_s,
                          const WelchOptions& options);

/// Input and output of one run, sampled at the same instants.
struct InputOutput {
  std::span<const double> input, output;
};
/// Of the segments of all runs together, each as heavy as any other; (S8), (S21). Runs of one segment count too.
/// \throws InputError as above, for fewer than two segments in all, and for no run
TransferEstimate transfer(std::span<const InputOutput> runs, double step_s, const WelchOptions& options);

/// Degrees of freedom of the mean of so many segments of several records; (S21).
double welch_dof(std::span<const std::size_t> segments, const WelchOptions& options);

}  // namespace hydro::signal
