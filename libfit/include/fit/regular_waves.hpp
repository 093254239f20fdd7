#pragma once
/// \file  Regular waves in a tank: when they are steady where a body is, and what it answers; (F94)-(F96),
///        docs/theory/fit.md.
#include <complex>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fit/coefficient.hpp"
#include "hydro/base/types.hpp"

namespace fit {

/// A tank with a wavemaker at one end. Distances along the tank from the wavemaker, m.
struct WaveTank {
  hydro::Water water = {};
  double gauge = 0;                                      ///< where the surface was measured
  double body = 0;                                       ///< where the body is
  double end = std::numeric_limits<double>::infinity();  ///< beach or wall; infinite: nothing comes back from it
};

/// When a wave group that the wavemaker sends out passes, s after it started. Energy goes at c_g; longer waves that
/// the start sends out are faster, up to √(gh), and small.
struct WaveTimes {
  double group_velocity;   ///< c_g, m/s
  double front;            ///< at the gauge and at the body, whichever is later
  double back_from_end;    ///< at whichever of them is earlier; infinite without an end
  double back_from_maker;  ///< the same wave again, sent back by the wavemaker
};
/// (F94). \throws hydro::InputError as hydro::waves::group_velocity(), for a distance that is negative or not finite,
/// and unless gauge and body stand before the end
WaveTimes wave_times(double omega, const WaveTank& tank);

struct RegularWaveOptions {
  WaveTank tank = {};
  double started = 0;         ///< s, on the clock of the record: the wavemaker
  double ramp = 0;            ///< s, until it moves fully
  double settle_periods = 5;  ///< given to the body's own motion to die out
  int harmonics = 3;
  double band_low = 0.5, band_high = 3.5;  ///< of the band-pass before peaks are taken, times the frequency
  double confidence = 0.95;
};

/// One channel of a run.
struct WaveChannel {
  std::string name;
  std::vector<double> values;
};

/// How large an oscillation is.
struct Oscillation {
  double mean;
  std::vector<std::complex<double>> harmonics;  ///< Re a_k e^{ikωt}, t of the record, by least squares over the window
  double error;                                 ///< standard error of one part of the first
  double dof;                                   ///< of Student's t with it
  std::vector<double> half_heights;             ///< half of crest minus trough of each whole cycle, after the band-pass
  double by_peaks, by_peaks_error;              ///< their mean, and its standard error s/√n
  double residual_rms;                          ///< of what is in no harmonic
  double change;          ///< of the first amplitude among parts of the window, largest less smallest over the whole's
  double change_allowed;  ///< by the noise of the steadiest part, and 0.02 at least: beyond it the waves are not steady
  std::vector<double> fitted;  ///< at the samples of the window
};

/// What a channel does for each metre of wave amplitude.
struct WaveResponse {
  std::string name;
  Oscillation motion;
  Coefficient rao;      ///< |a_1|/|ζ_1|; no value where the motion cannot be told from none
  double phase;         ///< rad, before the wave at the body, in (−π, π]
  double phase_error;   ///< rad
  double rao_by_peaks;  ///< ratio of the mean half heights
};

struct RegularWaveFit {
  double omega;          ///< rad/s, of the surface
  std::size_t from, to;  ///< the window: samples [from, to), a whole number of periods within a sample
  std::size_t cycles;
  std::optional<WaveTimes> times;  ///< where the window was found by them
  Oscillation wave;                ///< at the gauge
  std::vector<WaveResponse> responses;
  std::vector<std::string> cautions;
};

/// Frequency of the surface; window from when the front, the ramp and the settling have passed until waves come back
/// from the end, or all of [from, to) where a span is given; amplitudes there by harmonics and by peaks.
/// \throws hydro::InputError for uneven time, lengths that differ, fewer than 64 samples, a value that is not finite, a
/// surface that does not move, fewer than 3 periods of 8 samples in the window, told with the times that leave so few,
/// and options out of range
RegularWaveFit fit_regular_waves(std::span<const double> time_s, std::span<const double> elevation,
                                 std::span<const WaveChannel> responses, const RegularWaveOptions& options,
                                 std::optional<std::pair<double, double>> span = {});

}  // namespace fit
