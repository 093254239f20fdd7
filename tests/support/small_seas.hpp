#pragma once
/// \file  Waters in which members are tried.
#include <memory>
#include <numbers>

#include "hydro/waves/kinematics/field.hpp"
#include "hydro/waves/kinematics/sea.hpp"
#include "hydro/waves/synthesis/summed_field.hpp"

namespace support {

inline const hydro::Water fresh_water{.density = 1000, .gravity = 9.81, .depth = hydro::WaterDepth::from_metres(20)};

inline std::shared_ptr<const hydro::waves::WaveField> still_water(
    const hydro::waves::Current& current = hydro::waves::Current::none()) {
  return std::make_shared<hydro::waves::HarmonicField>(std::vector<hydro::waves::Harmonic>{}, fresh_water,
                                                       hydro::waves::HarmonicField::Options{}, current);
}

/// A regular wave towards 20 degrees with vertical stretching, as the plain sum.
inline hydro::waves::HarmonicField regular_harmonic(
    double amplitude, double period, hydro::waves::Stretching stretching = hydro::waves::Stretching::vertical,
    const hydro::waves::Current& current = hydro::waves::Current::none()) {
  const auto sea = hydro::waves::Sea::regular(
      hydro::WaveAmplitude::from_metres(amplitude), hydro::AngularFrequency::from_period_s(period),
      hydro::Angle::from_radians(20 * std::numbers::pi / 180), fresh_water, 0.3, current);
  hydro::waves::HarmonicField::Options options;
  options.stretching = stretching;
  return hydro::waves::linear_field(sea, options);
}

/// 0.6 m of amplitude, 4 s, towards 20 degrees: k = 0.25 rad/m.
inline std::shared_ptr<const hydro::waves::WaveField> steep_wave(
    hydro::waves::Stretching stretching, const hydro::waves::Current& current = hydro::waves::Current::none(),
    double amplitude = 0.6) {
  return std::make_shared<hydro::waves::SummedField>(regular_harmonic(amplitude, 4, stretching, current));
}

}  // namespace support
