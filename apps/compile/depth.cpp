#include "compile/depth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compile/compile.hpp"
#include "hydro/base/error.hpp"
#include "hydro/waves/dispersion.hpp"

namespace froude::compile {
namespace {

using hydro::InputError;

constexpr double most = 1e-2;  // of what is wrong: about what panel codes leave themselves

std::string text_of(const hydro::WaterDepth& depth) {
  return depth.is_infinite() ? "infinitely deep water" : fmt::format("{:.4g} m of water", depth.metres());
}

/// The frequency from which on the error is small enough.
double least_omega(double gravity, const OtherDepth& d) {
  double low = 1e-3 * std::sqrt(gravity / d.depth), high = 1e3 * low;
  while (depth_error(high, gravity, d.depth, d.extent) > most) high *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = std::sqrt(low * high);
    (depth_error(middle, gravity, d.depth, d.extent) > most ? low : high) = middle;
  }
  return high;
}

/// (P33): images of a body's dipole in bed and surface, all at once.
double near_field(const hydro::potential::Coefficients& c, double depth, const std::vector<double>& volumes,
                  const std::vector<Eigen::Vector3d>& places) {
  constexpr double alternating = 0.9015427;  // 1 − 1/2³ + 1/3³ − …
  const auto heave = [&](std::size_t b) {
    const auto at = static_cast<Eigen::Index>(6 * b + 2);
    double largest = c.A_inf ? (*c.A_inf)(at, at) : 0;
    for (const auto& A : c.A) largest = std::max(largest, A(at, at));
    return largest;
  };
  double worst = 0;
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    if (!(heave(i) > 0)) continue;
    const double own = heave(i) + c.water.density * volumes[i];
    double share = 0;
    for (std::size_t j = 0; j < volumes.size(); ++j) {
      const double aside = (places[i] - places[j]).head<2>().norm() / (2 * depth);
      share += alternating * own * (heave(j) + c.water.density * volumes[j]) /
               (8 * std::numbers::pi * c.water.density * std::pow(depth, 3) * heave(i)) /
               std::pow(1 + aside * aside, 1.5);
    }
    worst = std::max(worst, share);
  }
  return worst;
}

std::string compute_them(const scene::Scene& scene) {
  return scene.water.depth.is_infinite()
             ? "compute the coefficients for deep water, or give the scene the depth of the data"
             : fmt::format("compute the coefficients for {:.4g} m of water, or give the scene the depth of the data",
                           scene.water.depth.metres());
}

}  // namespace

bool are_apart(const hydro::WaterDepth& a, const hydro::WaterDepth& b) {
  constexpr double digits = 1e-3;
  return a.metres() != b.metres() && !(std::abs(a.metres() - b.metres()) <= digits * b.metres());
}

// (P33)
double depth_error(double omega, double gravity, double depth, double extent) {
  const double k =
      hydro::waves::wavenumber(omega, {.gravity = gravity, .depth = hydro::WaterDepth::from_metres(depth)});
  const double kd = k * depth, energy = 2 * kd / std::sinh(2 * kd), length = 1 - std::tanh(kd);
  return energy + (1 + k * extent) * length;
}

OtherDepth other_depth(const scene::Scene& scene, const hydro::potential::Coefficients& c,
                       const std::vector<double>& volumes, const std::vector<Eigen::Vector3d>& places,
                       const scene::Place& place) {
  OtherDepth out{.source = c.source,
                 .of_data = c.water.depth,
                 .depth = std::min(c.water.depth.metres(), scene.water.depth.metres()),
                 .extent = 0,
                 .near_field = 0,
                 .place = place};
  for (const auto& a : places)
    for (const auto& b : places) out.extent = std::max(out.extent, (a - b).head<2>().norm());
  out.near_field = near_field(c, out.depth, volumes, places);
  if (out.near_field > most)
    throw InputError(fmt::format("the coefficients are for {}, the scene has {}: the bed so near to the hull changes "
                                 "the added mass in heave by some {:.2g} of itself at any frequency, and {:.2g} is "
                                 "allowed",
                                 text_of(out.of_data), text_of(scene.water.depth), out.near_field, most),
                     place, compute_them(scene));
  return out;
}

std::vector<UsedFrequency> used_by(const dynamics::frequency::ModeList& motions) {
  std::vector<UsedFrequency> out;
  for (const auto& mode : motions.modes) {
    // A swing of damping ratio ζ gives away 4πζ of its energy in a period; one that creeps back all of it.
    const double given = mode.damped ? 4 * std::numbers::pi * std::abs(mode.damped->damping_ratio()) : 1;
    out.push_back({mode.omega, std::min(1.0, given),
                   fmt::format("a free motion with a period of {:.4g} s", 2 * std::numbers::pi / mode.omega)});
  }
  return out;
}

std::vector<UsedFrequency> used_by_run(const scene::Scene& scene, const Prepared& prepared,
                                       std::optional<double> lowest) {
  if (prepared.other_depths.empty()) return {};
  const dynamics::Model model = frequency_model(prepared, {.equilibrium = true});  // as placed, in balance or not
  auto out = used_by(dynamics::frequency::free_motions(model, prepared.groups));
  if (lowest) out.push_back({*lowest, 1, "the longest waves"});
  for (const auto& joint : scene.joints)
    if (joint.prescribed && joint.prescribed->omega > 0)
      out.push_back({joint.prescribed->omega, 1, "the prescribed motion of joint " + joint.name});
  return out;
}

void note_other_depths(const scene::Scene& scene, const Prepared& prepared, const std::vector<UsedFrequency>& used,
                       std::vector<std::string>& notes) {
  for (const OtherDepth& d : prepared.other_depths) {
    const UsedFrequency* worst = nullptr;
    double largest = 0;
    for (const UsedFrequency& u : used) {
      const double error = u.weight * depth_error(u.omega, scene.water.gravity, d.depth, d.extent);
      if (error > largest) largest = error, worst = &u;
    }
    const std::string which = fmt::format("coefficients for {} in {}", text_of(d.of_data), text_of(scene.water.depth));
    const std::string where = worst ? fmt::format(" at {:.4g} rad/s, {}", worst->omega, worst->what) : "";
    if (largest > most)
      throw InputError(fmt::format("{} would be off by some {:.2g}{}; {:.2g} is allowed", which, largest, where, most),
                       d.place,
                       fmt::format("{}; waves from {:.4g} rad/s on are short enough", compute_them(scene),
                                   least_omega(scene.water.gravity, d)));
    notes.push_back(
        fmt::format("{}: {}: radiation and excitation are off by some {:.1g}{}; the bed near the hull by {:.1g} "
                    "of the added mass in heave at any frequency",
                    d.source, which, largest, where, d.near_field));
  }
}

}  // namespace froude::compile
