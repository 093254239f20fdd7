#pragma once
/// \file  Amplitude and phase of known frequencies in a series, by least squares; (S2), docs/theory/signal.md.
#include <complex>
#include <span>
#include <vector>

namespace hydro::signal {

/// x(t) ≈ mean + Σ_k Re(amplitude[k] e^{+i omega[k] t}), t counted as in the time column given.
struct Harmonics {
  double mean;                                  ///< unit of the values
  std::vector<std::complex<double>> amplitude;  ///< in the order of the frequencies asked for, unit of the values
  double residual_rms;                          ///< root mean square of values minus fit
};

/// Fits the mean and one complex amplitude for each frequency `omega` (rad/s, > 0, all different).
///
/// Samples may be uneven in time and need not fill whole periods: nothing leaks from one frequency into another, since
/// all are solved for at once (QR, a block of samples at a time). Energy at frequencies not asked for ends in the
/// residual, and leaks into the answer by about its amplitude / (|Δω|·duration). Cost O(n m²) for n samples and m
/// frequencies.
///
/// \throws InputError if arrays differ in length or hold NaN, a frequency is not > 0 or stands twice, there are fewer
/// samples than unknowns (2m + 1), or the record cannot tell the frequencies apart (condition number above 1e8:
/// a record much shorter than the longest period or the beat of two frequencies, or sampling that aliases them).
Harmonics fit_harmonics(std::span<const double> time_s, std::span<const double> values, std::span<const double> omega);

/// The same of several series that were sampled at the same times: the basis is made once. \throws as for one
std::vector<Harmonics> fit_harmonics(std::span<const double> time_s, std::span<const std::span<const double>> series,
                                     std::span<const double> omega);

}  // namespace hydro::signal
