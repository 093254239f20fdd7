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

/// What of a body's loads is as it is placed; empty: nothing. With `turning` excitation follows the yaw, and leans as
/// little as all others.
std::string as_placed(const scene::Body& body) {
  std::vector<std::string> out;
  const auto& h = body.hydrodynamics;
  if (h && h->excitation && !h->turning) out.push_back("excitation");
  if (h && h->radiation) out.push_back("radiation");
  if (body.second_order) out.push_back("second-order loads");
  return fmt::format("{}", fmt::join(out, " and "));
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
    const scene::Body& body = scene.bodies[i];
    const bool round = body.hydrodynamics && is_of_revolution(*body.hydrodynamics);
    if (std::string what = as_placed(body); !what.empty())
      watched_.push_back({i, &body, std::move(what), !round, {}, {}});
  }
}

void FarFromPlace::look(const dynamics::State& state) {
  for (Watched& w : watched_) {
    const dynamics::Pose& pose = state.pose[w.body];
    w.turn.note(turned(pose.attitude, w.yaw_matters), state.time);
    const auto& h = w.given->hydrodynamics;
    if (wave_length_ == 0 || !h || !h->excitation) continue;
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
      out.push_back(
          fmt::format("the {} of {} as it turns, by {:.3g} deg at {:.5g} s: its coefficients are those of the "
                      "body as placed{}",
                      w.as_placed, w.given->name, w.turn.value * 180 / std::numbers::pi, w.turn.time,
                      w.as_placed.starts_with("excitation") ? " (`turning` lets excitation follow slow yaw)" : ""));
    if (w.way.value > most_of_length * wave_length_)
      out.push_back(fmt::format(
          "the phases of waves at {} as it goes away, by {:.3g} m at {:.5g} s, waves being {:.3g} m long: its "
          "excitation is that of the body as placed",
          w.given->name, w.way.value, w.way.time, wave_length_));
  }
  return out;
}

}  // namespace froude
