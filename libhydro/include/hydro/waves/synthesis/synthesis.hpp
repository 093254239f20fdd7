#pragma once
/// \file  Any linear response to a sea as a time series at fixed points, with a stated error.
///
/// Five methods, one interface; the cheapest is taken unless one is asked for, and the answer says which and how exact
/// it is. For points that move see summed_field.hpp and tabulated_field.hpp. Equations (W10), (W90)-(W95), (W99),
/// docs/theory/waves-synthesis.md; times of each method: docs/cost/synthesis.md.
#include <Eigen/Core>

#include <complex>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "hydro/waves/kinematics/sea.hpp"

namespace hydro::waves {

/// H(ω, β) of a linear response to a wave of unit amplitude, (P1): response = Re(H e^{iωt}); any unit per metre.
using Transfer = std::function<std::complex<double>(const Component&)>;

/// c_j = a_j e^{iφ_j} H_j, in the order of components(): the complex amplitudes of a response to this very sea.
std::vector<std::complex<double>> response_amplitudes(const Sea& sea, const Transfer& transfer);

/// Σ_j Re(c_j e^{iω_j t}): a response at one instant. Cost O(components). Shape of `amplitudes`: one per component.
double sum_at(const Sea& sea, std::span<const std::complex<double>> amplitudes, double t_s);

/// Samples at t = start_s + n dt_s, n = 0 … samples − 1.
struct TimeGrid {
  double dt_s;
  std::size_t samples;
  double start_s = 0;
};

enum class SeriesMethod {
  inverse_fft,      ///< one transform over the repetition; needs a sea on an FFT grid whose repetition is a whole
                    ///< number of steps, and start_s = 0; O(m log m) a signal (W10)
  blocked_phasors,  ///< any components and step; one rounding per term, no recurrence; O(components · samples) (W93)
  nonuniform_fft,   ///< any components and step; a transform of 1.5 × the samples a signal (W95)
  decimated,  ///< any components; for steps so short that only one sample in 2, 4, … 64 need be summed, by one of
              ///< the two above, and the others are interpolated (W99)
  plain_sum   ///< std::cos and std::sin for each term; the reference
};
std::string_view name_of(SeriesMethod method);

/// How a synthesis was done. A sample of a signal with amplitudes c is off by at most relative_error · Σ_j |c_j|,
/// against the exact sum for the doubles ω_j, start_s and dt_s.
struct SynthesisReport {
  SeriesMethod method;
  double relative_error;
  double expected_s;  ///< by the cost model, for one core of about 2022
};

struct Synthesis {
  Eigen::MatrixXd series;  ///< shape (samples, signals)
  SynthesisReport report;
};

/// Responses at all times of a grid: s_r(t_n) = Σ_j Re(c_rj e^{iω_j t_n}) (W10). `amplitudes`: (signals, components).
/// All signals are made in one pass, which shares the phasors. The phase at a late sample is that of the exact product
/// ω_j t_n but for the method's error; after 24 h at 10 Hz within 1e-9 rad for every method and component.
/// \throws InputError if dt_s is not finite and > 0, start_s or an amplitude is not finite, the sizes disagree, a
/// component is at or above the grid's Nyquist frequency π/dt_s, or the method asked for does not fit the sea
Synthesis synthesise(const Sea& sea, const TimeGrid& grid, const Eigen::MatrixXcd& amplitudes,
                     std::optional<SeriesMethod> method = {});

/// The same for harmonics of any frequencies, shape (components); negative ones and zero are allowed.
Synthesis synthesise(std::span<const double> omega, const TimeGrid& grid, const Eigen::MatrixXcd& amplitudes,
                     std::optional<SeriesMethod> method = {});

/// One signal, shape (samples).
std::vector<double> synthesise(const Sea& sea, const TimeGrid& grid, std::span<const std::complex<double>> amplitudes);
std::vector<double> synthesise(const Sea& sea, const TimeGrid& grid, const Transfer& transfer);

}  // namespace hydro::waves
