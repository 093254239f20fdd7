#pragma once
/// \file  A sea as a sum of regular waves.
///
///   ζ(x, y, t) = Σ_j a_j cos(ω_j t − k_j (x cos β_j + y sin β_j) + φ_j)      (W8), in the convention (P1), (P2)
#include <complex>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "hydro/base/types.hpp"
#include "hydro/waves/kinematics/current.hpp"
#include "hydro/waves/kinematics/field.hpp"
#include "hydro/waves/spectra/spectrum.hpp"
#include "hydro/waves/spectra/spreading.hpp"

namespace hydro::waves {

/// One regular wave. Plain numbers: it lives in kernels.
struct Component {
  double omega;      ///< as seen at a fixed point, rad/s, > 0
  double k;          ///< rad/m, of omega by (W1); on a current by (W20)
  double sigma;      ///< as seen by somebody drifting with the current, rad/s; equal to omega in still water
  double amplitude;  ///< m, >= 0
  double phase;      ///< φ, rad
  double heading;    ///< β, where it goes, from +x towards +y, rad
};

/// A wave as lists of components give it.
struct GivenWave {
  AngularFrequency omega;
  WaveAmplitude amplitude;
  double phase;  ///< φ of (W8), rad
  Angle heading;
};

/// How a spectrum is cut into components. All three keep the energy of each piece, (W9), (W23).
struct FftGrid {
  double repetition_s;  ///< T_r: components at the multiples of Δω = 2π/T_r; the sea repeats after T_r
};
struct EqualEnergy {
  std::size_t count;  ///< bins of the same energy, each with a component at its mean frequency; never repeats
};
struct RandomInBin {
  std::size_t count;  ///< bins of the same width, each with a component anywhere in it; never repeats
};

enum class Amplitudes {
  fixed,    ///< a_j²/2 is the energy of the bin: the variance is that of the spectrum for every seed
  rayleigh  ///< a_j²/2 scatters about it as in a Gaussian sea: the variance scatters as in a record of that length
};

struct Discretisation {
  std::variant<FftGrid, EqualEnergy, RandomInBin> bins;
  double omega_min, omega_max;  ///< rad/s, the band that is cut up
  std::uint64_t seed;           ///< of phases, and of frequencies, headings and amplitudes where they are random
  Amplitudes amplitudes = Amplitudes::fixed;
};

/// Where the waves go: all one way, or spread about a mean. With spreading each component gets one heading, drawn from
/// D(θ; ω): no two waves of one frequency interfere, so the sea has the same variance everywhere (W24).
struct Directions {
  Angle mean = Angle::from_radians(0);
  const Spreading* spreading = nullptr;  ///< null: long-crested; looked at during the call only
};

/// Streams of hydro::RandomStream for phases, and for what else may be random; component number j takes number j.
inline constexpr std::uint64_t phase_stream = 0x7068617365;    // "phase"
inline constexpr std::uint64_t heading_stream = 0x68656164;    // "head"
inline constexpr std::uint64_t amplitude_stream = 0x616d70;    // "amp"
inline constexpr std::uint64_t frequency_stream = 0x66726571;  // "freq"

/// Regular waves and the water they run on. Immutable.
class Sea {
 public:
  /// One wave of any period; repetition_s() is its period.
  static Sea regular(WaveAmplitude amplitude, AngularFrequency omega, Angle heading, const Water& water,
                     double phase_rad = 0, const Current& current = Current::none());

  /// The waves of a list, in its order; never repeats, as far as this class knows.
  /// \throws InputError for an empty list
  static Sea of(std::span<const GivenWave> waves, const Water& water, const Current& current = Current::none());

  /// Random sea (W9), (W23). With fixed amplitudes Σ a_j²/2 is m_0 less the energy outside the band, whose fraction is
  /// fraction_left_out(). Every random number depends on (seed, component number) alone: the same on every machine, in
  /// every order, and on an FFT grid a wider band keeps the waves of the narrower one. The sea does not know how long
  /// a record will be taken of it, so a longer record keeps its beginning.
  /// \throws InputError if the band is empty or holds no multiple of Δω, or a repetition or count is not positive
  static Sea irregular(const Spectrum& spectrum, const Discretisation& cut, const Directions& directions,
                       const Water& water, const Current& current = Current::none());

  /// Several seas on the same water and current at once. They repeat together if all have the same repetition.
  /// \throws InputError for none
  static Sea together(std::span<const Sea> seas);

  /// The same waves with other complex amplitudes a e^{iφ}, one a component. \throws InputError if the number differs
  Sea with_amplitudes(std::span<const std::complex<double>> amplitudes) const;

  const std::vector<Component>& components() const noexcept { return components_; }
  const Water& water() const noexcept { return water_; }
  const Current& current() const noexcept { return current_; }
  /// After which the sea repeats, s; +∞ if it does not.
  double repetition_s() const noexcept { return repetition_s_; }
  /// The j of components()[i] in ω = 2πj/repetition_s(); empty if the sea does not repeat.
  std::span<const std::size_t> grid_index() const noexcept { return index_; }
  /// Share of the spectrum's m_0 that no component carries, 0 … 1; 0 for given waves.
  double fraction_left_out() const noexcept { return fraction_left_out_; }
  /// 4 √(Σ a²/2), m.
  double hs() const;

  /// ζ at a place and time, m, by the plain sum (W8); cost O(components). Rounding: about 1e-16 ω t per component.
  double elevation(double t_s, double x_m, double y_m) const;

 private:
  Sea(const Water& water, const Current& current, double repetition_s)
      : water_(water), current_(current), repetition_s_(repetition_s) {}
  void add(const GivenWave& wave);
  Water water_;
  Current current_;
  double repetition_s_;
  double fraction_left_out_ = 0;
  std::vector<Component> components_;
  std::vector<std::size_t> index_;
};

/// H of the elevation at a point: e^{−ik(x cos β + y sin β)}.
std::complex<double> elevation_transfer(const Component& wave, double x_m, double y_m);

/// What cutting a spectrum into components did to its moments (W5) within the band: Σ ω^n a²/2 against ∫ ω^n S dω,
/// relative; and the sea's own repetition. m_4 is finite since the band is.
struct DiscretisationError {
  double m0, m1, m2, m4;
};
DiscretisationError discretisation_error(const Sea& sea, const Spectrum& spectrum, double omega_min, double omega_max);

/// The harmonics (W16) of a sea, Φ = i (g/σ) a e^{iφ}, ready for a HarmonicField.
std::vector<Harmonic> harmonics(const Sea& sea);

/// The field of a sea by linear theory, with its current. Hs of `options` is filled in from the sea if it is not given.
HarmonicField linear_field(const Sea& sea, HarmonicField::Options options = {});

}  // namespace hydro::waves
