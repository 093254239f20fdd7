/// \file  What the water does at the probes of a scene, as time series.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "answers/answers.hpp"
#include "answers/provenance.hpp"
#include "compile/signal_list.hpp"
#include "compile/waves.hpp"
#include "hydro/base/error.hpp"
#include "hydro/waves/kinematics/kinematics.hpp"
#include "hydro/waves/synthesis/second_order.hpp"
#include "hydro/waves/synthesis/synthesis.hpp"

namespace froude {
namespace {

namespace hw = hydro::waves;
constexpr std::array<char, 3> axes{'x', 'y', 'z'};

std::vector<Signal> empty_signals(const scene::Probe& probe) {
  std::vector<Signal> out;
  for (const auto& s : compile::probe_signals(probe)) out.push_back({s.name, s.unit, s.long_name});
  return out;
}

bool tells_of_flow(const scene::Probe& probe) { return probe.velocity || probe.acceleration || probe.pressure; }

/// What each signal of a probe is to a wave of unit amplitude, in the same order.
std::vector<hw::Transfer> transfers(const scene::Probe& probe, const hydro::Water& water) {
  constexpr std::complex<double> i(0, 1);
  const Eigen::Vector3d at = probe.at;
  std::vector<hw::Transfer> out;
  if (probe.elevation)
    out.emplace_back([at](const hw::Component& w) { return hw::elevation_transfer(w, at.x(), at.y()); });
  for (int axis = 0; axis < 3 && probe.velocity; ++axis)
    out.emplace_back([=](const hw::Component& w) { return hw::velocity_transfer(w, water, at)[axis]; });
  for (int axis = 0; axis < 3 && probe.acceleration; ++axis)
    out.emplace_back([=](const hw::Component& w) { return i * w.omega * hw::velocity_transfer(w, water, at)[axis]; });
  if (probe.pressure)
    out.emplace_back([=](const hw::Component& w) {
      return water.density * water.gravity * hw::elevation_transfer(w, at.x(), at.y()) *
             hw::depth_profile(w.k, water.depth.metres(), std::min(at.z(), 0.0)).cosh;
    });
  return out;
}

/// Linear waves at a fixed point are a linear response: one synthesis for each signal, whole.
void add_linear(const scene::Scene& scene, const hw::Sea& sea, const scene::Probe& probe, WaterSeries& out) {
  const scene::AskWaves& ask = *scene.ask_waves;
  std::vector<Signal> signals = empty_signals(probe);
  const auto responses = transfers(probe, scene.water);
  const Eigen::Vector2d current = scene.current.at(probe.at.z());
  for (std::size_t s = 0; s < signals.size(); ++s) {
    const hw::Transfer from_start = [&](const hw::Component& w) {
      return responses[s](w) * std::polar(1.0, w.omega * ask.from);
    };
    signals[s].values = hw::synthesise(sea, {ask.every, out.time.size()}, from_start);
    for (int axis = 0; axis < 2; ++axis)
      if (signals[s].name == fmt::format("{}.velocity_{}", probe.name, axes[static_cast<std::size_t>(axis)]))
        for (double& value : signals[s].values) value += current[axis];
  }
  std::move(signals.begin(), signals.end(), std::back_inserter(out.signals));
}

/// Of linear waves at a probe.
std::vector<double> elevation_at(const scene::Scene& scene, const hw::Sea& sea, const scene::Probe& probe,
                                 std::size_t samples) {
  const scene::AskWaves& ask = *scene.ask_waves;
  return hw::synthesise(sea, {ask.every, samples}, [&](const hw::Component& w) {
    return hw::elevation_transfer(w, probe.at.x(), probe.at.y()) * std::polar(1.0, w.omega * ask.from);
  });
}

/// The bound waves of a sea on a grid, added to the signals of one probe that add_linear() has just made.
void add_bound(const scene::Scene& scene, const hw::Sea& sea, const scene::Probe& probe, WaterSeries& out) {
  const scene::AskWaves& ask = *scene.ask_waves;
  const hw::BoundAtPoint bound = hw::bound_at_point(sea, probe.at);
  const auto series = [&](const std::vector<std::complex<double>>& bins, int time_derivatives) {
    std::vector<std::complex<double>> turned = bins;
    for (std::size_t j = 0; j < turned.size(); ++j) {
      const double omega = 2 * std::numbers::pi * static_cast<double>(j) / bound.repetition_s;
      turned[j] *= std::polar(1.0, omega * ask.from) * (time_derivatives ? std::complex<double>(0, omega) : 1.0);
    }
    return bound.series(turned, {ask.every, out.time.size()});
  };
  const std::array bins{&bound.u, &bound.v, &bound.w};
  for (Signal& s : out.signals) {
    std::vector<double> extra;
    if (s.name == probe.name + ".elevation") extra = series(bound.elevation, 0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (s.name == fmt::format("{}.velocity_{}", probe.name, axes[axis])) extra = series(*bins[axis], 0);
      if (s.name == fmt::format("{}.acceleration_{}", probe.name, axes[axis])) extra = series(*bins[axis], 1);
    }
    for (std::size_t n = 0; n < extra.size(); ++n) s.values[n] += extra[n];
  }
}

/// Of a probe that tells more than the elevation, where that passes below it at some samples.
void tell_dry(const scene::Probe& probe, const std::vector<double>& elevation, WaterSeries& out) {
  if (!tells_of_flow(probe)) return;
  const auto dry = std::count_if(elevation.begin(), elevation.end(), [&](double z) { return z < probe.at.z(); });
  const double share = static_cast<double>(dry) / static_cast<double>(elevation.size());
  if (share == 1)
    throw hydro::InputError(
        fmt::format("probe \"{}\" at z = {:.4g} m is above the water all the time, where nothing has "
                    "a velocity or a pressure of the waves",
                    probe.name, probe.at.z()),
        probe.place, "move it down, or let it give its elevation alone");
  if (share > 0)
    out.notes.push_back(
        fmt::format("probe {} is above the water at {:.3g} % of the samples: velocity and pressure there "
                    "are the waves' laws continued, and no water's",
                    probe.name, 100 * share));
}

void add_from_field(const hw::WaveField& field, const scene::Probe& probe, WaterSeries& out,
                    const std::function<void(double)>& progress) {
  std::vector<Signal> signals = empty_signals(probe);
  const auto told = compile::probe_signals(probe);
  std::vector<double> elevation;
  for (std::size_t n = 0; n < out.time.size(); ++n) {
    const hw::Kinematics k = field.at(out.time[n], probe.at);
    for (std::size_t i = 0; i < told.size(); ++i) signals[i].values.push_back(told[i].take(k));
    elevation.push_back(k.elevation);
    if (n % 256 == 0) progress(static_cast<double>(n) / static_cast<double>(out.time.size()));
  }
  tell_dry(probe, elevation, out);
  std::move(signals.begin(), signals.end(), std::back_inserter(out.signals));
}

/// True if no point is where stretching matters.
bool profiles_are_linear(const scene::Scene& scene) {
  if (scene.waves->stretching == hw::Stretching::vertical) return true;
  return scene.waves->stretching == hw::Stretching::none &&
         std::all_of(scene.probes.begin(), scene.probes.end(), [](const scene::Probe& p) { return p.at.z() <= 0; });
}

/// Bound waves of a sea on a grid are one inverse transform a signal, where nobody asks for their pressure.
bool bins_suffice(const scene::Scene& scene) {
  const auto* random = std::get_if<scene::RandomSea>(&scene.waves->kind);
  return random != nullptr && std::holds_alternative<hw::FftGrid>(random->bins) &&
         std::all_of(scene.probes.begin(), scene.probes.end(),
                     [](const scene::Probe& p) { return !p.pressure && p.at.z() <= 0; });
}

void require_above_bed(const scene::Scene& scene) {
  for (const auto& p : scene.probes)
    if (p.at.z() < -scene.water.depth.metres())
      throw hydro::InputError(fmt::format("probe \"{}\" at z = {} m lies below the bed at z = {} m", p.name, p.at.z(),
                                          -scene.water.depth.metres()),
                              p.place, "move it up");
}

}  // namespace

bool is_synthesised(const scene::Scene& scene) {
  const bool bound = compile::has_bound_waves(*scene.waves);
  return (compile::is_linear_sum(*scene.waves) || (bound && bins_suffice(scene))) && profiles_are_linear(scene);
}

WaterSeries water_series(const scene::Scene& scene, const std::function<void(double)>& progress) {
  const scene::AskWaves& ask = *scene.ask_waves;
  require_above_bed(scene);
  WaterSeries out;
  out.provenance = provenance_of(scene);
  out.notes = compile::wave_warnings(scene);
  const auto samples = static_cast<std::size_t>(std::llround(ask.duration / ask.every)) + 1;
  for (std::size_t n = 0; n < samples; ++n) out.time.push_back(ask.from + ask.every * static_cast<double>(n));
  const double probes = static_cast<double>(scene.probes.size());
  const bool bound = compile::has_bound_waves(*scene.waves);
  if (is_synthesised(scene)) {
    const hw::Sea sea = compile::free_waves(scene);
    out.method = std::isinf(sea.repetition_s()) ? "turning phasors" : "inverse FFT";
    out.notes.push_back(fmt::format("{} linear waves, Hs {:.6g} m; {:.2g} of the spectrum's energy is in none of them",
                                    sea.components().size(), sea.hs(), sea.fraction_left_out()));
    if (sea.components().size() > 1 && sea.repetition_s() < ask.duration)
      out.notes.push_back(fmt::format("the sea repeats after {:.6g} s", sea.repetition_s()));
    for (std::size_t p = 0; p < scene.probes.size(); ++p) {
      add_linear(scene, sea, scene.probes[p], out);
      if (bound) add_bound(scene, sea, scene.probes[p], out);
      // Twice Hs below still water none of a day's waves comes.
      if (tells_of_flow(scene.probes[p]) && scene.probes[p].at.z() > -2 * sea.hs())
        tell_dry(scene.probes[p], elevation_at(scene, sea, scene.probes[p], samples), out);
      if (progress) progress(static_cast<double>(p + 1) / probes);
    }
    return out;
  }
  const auto field = compile::make_field(scene);
  out.method = "the field at each instant";
  for (std::size_t p = 0; p < scene.probes.size(); ++p)
    add_from_field(*field, scene.probes[p], out, [&](double done) {
      if (progress) progress((static_cast<double>(p) + done) / probes);
    });
  return out;
}

}  // namespace froude
