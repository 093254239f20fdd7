#pragma once
/// \file  How long a wave of a given frequency is, and how fast it and its energy travel, at any depth.
///
///   ω² = g k tanh kh      (W1), derived in docs/theory/waves.md
///
/// Plain doubles in SI: these are kernels. Frequencies at a border are AngularFrequency. No current, no surface
/// tension.
#include <string_view>

#include "hydro/base/types.hpp"

namespace hydro::waves {

/// k(ω), rad/m, from ω in rad/s. Explicit start (W2) within 0.8 %, then three Newton steps (W3): (W1) holds to 1e-15
/// relative for 1e-100 < kh and in infinitely deep water, where k = ω²/g.
/// \throws InputError unless omega is finite and > 0 and gravity is finite and > 0
double wavenumber(double omega, const Water& water);

/// ω(k), rad/s, from k in rad/m; 4e-16 relative. \throws InputError unless k is finite and > 0, and as wavenumber()
double angular_frequency(double k, const Water& water);

/// ω/k, m/s: how fast crests travel. \throws InputError as wavenumber()
double phase_velocity(double omega, const Water& water);

/// dω/dk, m/s: how fast energy travels (W4); 1e-15 relative. \throws InputError as wavenumber()
double group_velocity(double omega, const Water& water);

/// How much of the depth a wave feels (W47): deep from kh = π on (h >= λ/2, tanh kh > 0.996), shallow up to π/10
/// (h <= λ/20).
enum class DepthRegime { shallow, intermediate, deep };
DepthRegime depth_regime(double kh);  ///< \throws InputError unless kh > 0; +∞ is deep
std::string_view name(DepthRegime regime);

}  // namespace hydro::waves
