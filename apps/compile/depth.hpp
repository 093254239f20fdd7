#pragma once
/// \file  Coefficients for water of another depth than the scene's, of deep water above all: allowed where the waves
/// that
///        are used hardly feel either bed, with the error stated (P33), else refused.
#include <optional>
#include <string>
#include <vector>

#include "dynamics/frequency/modes.hpp"
#include "hydro/potential/coefficients.hpp"
#include "scene/scene.hpp"

namespace froude::compile {

struct Prepared;

/// Coefficients of another depth.
struct OtherDepth {
  std::string source;         ///< of the coefficients
  hydro::WaterDepth of_data;  ///< which they are for
  double depth;               ///< m, the smaller of theirs and the scene's
  double extent;              ///< m, between the farthest of their bodies
  double near_field;          ///< (P33): the share of its added mass in heave that a body gets wrong at any frequency
  scene::Place place;         ///< of the file
};

/// Depths that differ by more than their digits, 1e-3.
bool are_apart(const hydro::WaterDepth& a, const hydro::WaterDepth& b);

/// What another depth does to these coefficients. `volumes`: displaced by each of their bodies, m³; `places`: of them,
/// m. \throws InputError if the bed alone, beneath the hulls, makes more than a hundredth of their added mass
OtherDepth other_depth(const scene::Scene& scene, const hydro::potential::Coefficients& c,
                       const std::vector<double>& volumes, const std::vector<Eigen::Vector3d>& places,
                       const scene::Place& place);

/// (P33): the share of radiation and excitation that is wrong at ω where the bed at `depth` counts or does not, for
/// bodies within `extent` of each other.
double depth_error(double omega, double gravity, double depth, double extent);

/// A frequency at which a scene uses its coefficients.
struct UsedFrequency {
  double omega;      ///< rad/s
  double weight;     ///< ≤ 1: how much of what is asked for depends on them there
  std::string what;  ///< for people: "the longest waves asked for"
};
/// The free motions of a model, each with the share of its energy that it gives away in a period, 1 at most: what slow
/// motions in a mooring radiate does not matter to them.
std::vector<UsedFrequency> used_by(const dynamics::frequency::ModeList& motions);
/// The waves of a run, prescribed motions of joints, and the free motions of its bodies. `lowest`: of the waves, rad/s.
std::vector<UsedFrequency> used_by_run(const scene::Scene& scene, const Prepared& prepared,
                                       std::optional<double> lowest);

/// Tells in `notes` what coefficients of another depth leave wrong at these frequencies; nothing where there are none.
/// \throws InputError at the file if it is more than a hundredth
void note_other_depths(const scene::Scene& scene, const Prepared& prepared, const std::vector<UsedFrequency>& used,
                       std::vector<std::string>& notes);

}  // namespace froude::compile
