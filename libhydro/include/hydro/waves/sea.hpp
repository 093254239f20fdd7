#pragma once
/// \file  A sea as a sum of long-crested regular waves, and any linear response to it as a time series.
///
///   ζ(x, y, t) = Σ_j a_j cos(ω_j t − k_j (x cos β_j + y sin β_j) + φ_j)      (W8), in the convention (P1), (P2)
#include <complex>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "hydro/base/types.hpp"
#include "hydro/waves/spectrum.hpp"

namespace hydro::waves {

/// One regular wave. Plain numbers: it lives in kernels.
struct Component {
  double omega;      ///< rad/s, > 0
  double k;          ///< rad/m, of omega by (W1)
  double amplitude;  ///< m, >= 0
  double phase;      ///< φ, rad
  double heading;    ///< β, where it goes, from +x towards +y, rad
};

/// How a spectrum is turned into components.
struct Discretisation {
  double repetition_s;          ///< T_r: the sea repeats after this; Δω = 2π/T_r
  double omega_min, omega_max;  ///< rad/s: components stand at the multiples of Δω in this band
  std::uint64_t seed;           ///< of the random phases
};

/// The stream of hydro::RandomStream that wave phases are drawn from; component jΔω takes number j of it.
inline constexpr std::uint64_t phase_stream = 0x7068617365;  // "phase"

/// Components on the grid ω = jΔω, Δω = 2π/repetition_s(). Immutable.
class Sea {
 public:
  /// One wave of any period; repetition_s() is its period.
  static Sea regular(WaveAmplitude amplitude, AngularFrequency omega, Angle heading, const Water& water,
                     double phase_rad = 0);

  /// Long-crested random sea with fixed amplitudes and random phases (W9): a_j² / 2 = ∫ S dω over the bin jΔω ± Δω/2.
  /// Σ a_j²/2, and the variance over one repetition, is m_0 less the energy outside the outermost bins, whose
  /// fraction is fraction_left_out(). Phases depend on (seed, j) alone: the same on every machine, and a wider
  /// band keeps the phases of the narrower one. A longer repetition is another grid and so another sea.
  /// \throws InputError if the band is empty or holds no multiple of Δω, or repetition_s is not finite and > 0
  static Sea irregular(const Spectrum& spectrum, const Discretisation& grid, Angle heading, const Water& water);

  const std::vector<Component>& components() const noexcept { return components_; }
  const Water& water() const noexcept { return water_; }
  double repetition_s() const noexcept { return repetition_s_; }
  /// The j of components()[i] in ω = jΔω.
  std::span<const std::size_t> grid_index() const noexcept { return index_; }
  /// Share of the spectrum's m_0 that no component carries, 0 … 1; 0 for a regular wave.
  double fraction_left_out() const noexcept { return fraction_left_out_; }

  /// ζ at a place and time, m, by the plain sum (W8); cost O(components). Rounding: about 1e-16 ω t per component.
  double elevation(double t_s, double x_m, double y_m) const;

 private:
  Sea(const Water& water, double repetition_s) : water_(water), repetition_s_(repetition_s) {}
  Water water_;
  double repetition_s_;
  double fraction_left_out_ = 0;
  std::vector<Component> components_;
  std::vector<std::size_t> index_;
};

/// H(ω, β) of a linear response to a wave of unit amplitude, (P1): response = Re(H e^{iωt}); any unit per metre.
using Transfer = std::function<std::complex<double>(const Component&)>;

/// H of the elevation at a point: e^{−ik(x cos β + y sin β)}.
std::complex<double> elevation_transfer(const Component& wave, double x_m, double y_m);

/// c_j = a_j e^{iφ_j} H_j, in the order of components(): the complex amplitudes of a response to this very sea.
std::vector<std::complex<double>> response_amplitudes(const Sea& sea, const Transfer& transfer);

/// Σ_j Re(c_j e^{iω_j t}): a response at one instant. Cost O(components). Shape of `amplitudes`: one per component.
double sum_at(const Sea& sea, std::span<const std::complex<double>> amplitudes, double t_s);

/// Samples at t = 0, dt_s, 2 dt_s, …
struct TimeGrid {
  double dt_s;
  std::size_t samples;
};

/// A response at all times of a grid, shape (samples): Σ_j Re(c_j e^{iω_j t}) (W10).
///
/// If the repetition is a whole number m of steps (to 4 units in the last place): one inverse FFT of length m, cost
/// O(m log m), and beyond the repetition the series repeats itself. Otherwise phasors turned from sample to
/// sample and set afresh every 64, cost O(components · samples). Error of either: 1e-14 Σ|c_j| plus
/// 2e-16 ω t per component.
/// \throws InputError if dt_s is not finite and > 0, or a component is at or above the grid's Nyquist frequency π/dt_s
std::vector<double> synthesise(const Sea& sea, const TimeGrid& grid, std::span<const std::complex<double>> amplitudes);
std::vector<double> synthesise(const Sea& sea, const TimeGrid& grid, const Transfer& transfer);

}  // namespace hydro::waves
