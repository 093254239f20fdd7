#pragma once
/// \file  What one wants to know of a sea before anything moves in it: how steep, how shallow, how broad, how high.
/// Definitions and sources: docs/theory/waves-spectra.md, (W47)-(W49).
#include "hydro/base/types.hpp"
#include "hydro/waves/dispersion.hpp"
#include "hydro/waves/spectra/spectrum.hpp"

namespace hydro::waves {

/// Numbers of a sea over a flat bed (W47). λ_p and k_p belong to the spectrum's peak, by the dispersion relation.
struct SeaNumbers {
  double peak_wavelength_m;   ///< λ_p
  double peak_steepness;      ///< Hs/λ_p
  double crossing_steepness;  ///< 2π Hs/(g Tz²): Hs over the deep-water length of Tz
  double relative_depth;      ///< k_p h; +∞ in deep water
  double ursell;              ///< Hs λ_p²/h³; 0 in deep water
};
/// \throws InputError as wavenumber(), and where m_2 diverges
SeaNumbers sea_numbers(const Spectrum& spectrum, const Water& water);

/// H λ²/h³ (W47), 0 in infinitely deep water. Linear theory wants it small against 1/kh corrections: Stokes' expansion
/// breaks down above about 26 (8π²/3), where cnoidal theory takes over. \throws InputError unless height and length
/// are finite and > 0
double ursell_number(double height_m, double wavelength_m, const WaterDepth& depth);

/// √(m_0 m_2/m_1² − 1), 0 for a single frequency (W48; Longuet-Higgins 1975). \throws InputError where m_2 diverges
double narrowness(const Spectrum& spectrum);
/// √(1 − m_2²/(m_0 m_4)), 0 … 1 (W48; Cartwright & Longuet-Higgins 1956), of the part of the spectrum below omega_max:
/// m_4 of most spectra exists with such a limit only. \throws InputError unless omega_max > 0, or if the band is empty
double broadness(const Spectrum& spectrum, double omega_max);

/// Waves in a duration: duration/Tz. \throws InputError unless duration_s is finite and > 0
double number_of_waves(const Spectrum& spectrum, double duration_s);

/// Heights of the highest of n independent waves whose heights follow Rayleigh's distribution,
/// P(H > h) = e^{−2h²/Hs²} (W49), m. In seas as broad as real ones they are some 5 to 10 % lower.
/// \throws InputError unless hs_m is finite and > 0 and waves is finite and >= 1
double most_probable_highest(double hs_m, double waves);
double expected_highest(double hs_m, double waves);
/// Not exceeded with this probability, 0 < p < 1.
double highest_not_exceeded(double hs_m, double waves, double probability);

}  // namespace hydro::waves
