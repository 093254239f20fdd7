#include "answers/far_from_place.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace froude {
namespace {

/// sin 15°: a quarter of a load along the body then points elsewhere.
constexpr double most_turned = 15 * std::numbers::pi / 180;
/// Of a wave's length: loads of the place then lag by a quarter of a period.
constexpr double most_of_length = 0.25;

/// 2π over the wavenumber of the components, weighted by their energies.
double mean_length(const std::optional<hydro::waves::Sea>& sea) {
  double energy = 0, weighted = 0;
  if (sea)
    for (const auto& c : sea->components()) {
      energy += c.amplitude * c.amplitude;
      weighted += c.k * c.amplitude * c.amplitude;
    }
  return weighted > 0 ? 2 * std::numbers::pi * energy / weighted : 0;
}

/// One cylinder about the body's own axis.
bool is_of_revolution(const scene::Hydrodynamics& h) {
  return h.cylinders && h.cylinders->all.size() == 1 && h.cylinders->all.front().centre.isZero();
}

/// Between the attitude and that of rest; without its yaw, between both vertical axes.
double turned(const Eigen::Quaterniond& attitude, bool with_yaw) {
  if (with_yaw) return Eigen::AngleAxisd(attitude).angle();
  const Eigen::Vector3d axis = attitude * Eigen::Vector3d::UnitZ();
  return std::atan2(axis.head<2>().norm(), axis.z());
}

}  // namespace

FarFromPlace::FarFromPlace(const scene::Scene& scene, const std::optional<hydro::waves::Sea>& sea)
    : wave_length_(mean_length(sea)) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const auto& h = scene.bodies[i].hydrodynamics;
    if (h && h->makes_waves()) watched_.push_back({i, &scene.bodies[i], !h->turning && !is_of_revolution(*h), {}, {}});
  }
}

void FarFromPlace::look(const dynamics::State& state) {
  for (Watched& w : watched_) {
    const dynamics::Pose& pose = state.pose[w.body];
    w.turn.note(turned(pose.attitude, w.yaws_as_placed), state.time);
    if (wave_length_ == 0 || !w.given->hydrodynamics->excitation) continue;
    const Eigen::Vector3d centre = w.given->position + w.given->centre_of_gravity;
    w.way.note((pose.centre - centre).head<2>().norm(), state.time);
  }
}

void FarFromPlace::keep_state(hydro::StateBytes& bytes) {
  for (Watched& w : watched_) bytes.pass(w.turn.value, w.turn.time, w.way.value, w.way.time);
}

std::vector<std::string> FarFromPlace::told() const {
  std::vector<std::string> out;
  for (const Watched& w : watched_) {
    if (w.turn.value > most_turned)
      out.push_back(fmt::format(
          "the hydrodynamic coefficients of {}, which are those of the body as placed: it has "
          "turned by {:.3g} deg at {:.5g} s{}",
          w.given->name, w.turn.value * 180 / std::numbers::pi, w.turn.time,
          w.yaws_as_placed && w.given->hydrodynamics->excitation ? " (slow yaw can be followed: `turning`)" : ""));
    if (w.way.value > most_of_length * wave_length_)
      out.push_back(
          fmt::format("the phases of the waves' loads on {}, which are those of the body as placed: it is "
                      "{:.3g} m away at {:.5g} s, and waves are {:.3g} m long",
                      w.given->name, w.way.value, w.way.time, wave_length_));
  }
  return out;
}

}  // namespace froude
