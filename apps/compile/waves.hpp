#pragma once
/// \file  From the waves of a scene to a sea, or to a field that tells the water's motion anywhere.
#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hydro/waves/kinematics/field.hpp"
#include "hydro/waves/kinematics/sea.hpp"
#include "hydro/waves/synthesis/field_choice.hpp"
#include "scene/scene.hpp"

namespace froude::compile {

/// Frequencies, rad/s.
struct Band {
  double low, high;
};

/// The waves of a scene as a sum of linear waves: regular waves of linear theory, random seas, lists.
/// `data`: where coefficients are known, if any act; no component is outside.
/// \throws hydro::InputError for waves that are no such sum; if more of the energy than the accuracy asked lies outside
/// `data`; for a crest beyond breaking
hydro::waves::Sea make_sea(const scene::Scene& scene, const std::optional<Band>& data = {});

/// True if make_sea() can serve: the kinematics are those of linear waves, and no bound waves are asked for.
bool is_linear_sum(const scene::Waves& waves);

/// True if the scene asks for second-order waves.
bool has_bound_waves(const scene::Waves& waves);

/// As make_sea(), without regard to bound waves that the scene asks for beside them.
hydro::waves::Sea free_waves(const scene::Scene& scene, const std::optional<Band>& data = {});

/// The field of any kind of waves. \throws hydro::InputError where waves and current do not go together
std::unique_ptr<const hydro::waves::WaveField> make_field(const scene::Scene& scene);

/// What is doubtful about the waves, one sentence with its numbers each: regular waves outside the limits of
/// hydro::waves::wave_limits(), seas steeper than are measured. Empty for lists, packets and tanks.
std::vector<std::string> wave_warnings(const scene::Scene& scene);

/// Of a wave of this frequency in the water and the current of the scene, by linear theory, rad/m.
/// \throws hydro::InputError if the current stops such waves
double wavenumber_in(const scene::Scene& scene, double omega, hydro::Angle heading);

/// The length that a regular wave has by its theory, in the current of the scene, m. \throws hydro::InputError
double wavelength_of(const scene::Scene& scene, const scene::RegularWave& wave);

/// No water can have a regular wave of this height at the length of its theory, for which make_sea() and make_field()
/// refuse it. \throws hydro::InputError as wavelength_of(), of waves that are low enough
bool is_beyond_breaking(const scene::Scene& scene, const scene::RegularWave& wave);

/// a e^{iφ}
std::complex<double> elevation_at_origin(const hydro::waves::Component& component);

/// Rad/s above which the sea has 5 % of its energy: what a step must resolve. The frequency of a regular wave.
double highest_relevant_frequency(const scene::Waves& waves);

/// What a run with this step asks of its waves in a box around `places`, m, where the scene has what moves at rest:
/// with room for the orbits of the highest waves and for some metres of drift. `points`: how many are asked for at each
/// instant, the runs that tell the error counted in.
hydro::waves::FieldUse water_around(const scene::Scene& scene, const Eigen::AlignedBox3d& places, double highest_crest,
                                    double step, double points);

}  // namespace froude::compile
