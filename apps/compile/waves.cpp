#include "compile/waves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hydro/waves/dispersion.hpp"
#include "hydro/waves/kinematics/current.hpp"
#include "hydro/waves/kinematics/focus.hpp"
#include "hydro/waves/kinematics/limits.hpp"
#include "hydro/waves/kinematics/steady.hpp"
#include "hydro/waves/kinematics/tank.hpp"
#include "hydro/waves/kinematics/trains.hpp"
#include "hydro/waves/synthesis/second_order.hpp"
#include "hydro/waves/synthesis/summed_field.hpp"
#include "scene/placed.hpp"

namespace froude::compile {
namespace {

namespace hw = hydro::waves;
using hydro::Angle;
using hydro::InputError;
using hydro::Place;

constexpr double two_pi = 2 * std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The frequency with the given share of the energy above it, between a thousandth and a thousand times the peak's.
double frequency_with_share_above(const hw::Spectrum& spectrum, double share) {
  double low = 1e-3 * spectrum.peak_omega(), high = 1e6 * low;
  const double wanted = share * spectrum.moment(0);
  for (int i = 0; i < 60; ++i) {
    const double middle = std::sqrt(low * high);
    (spectrum.energy(middle, infinity) > wanted ? low : high) = middle;
  }
  return high;
}

/// The highest frequency of a list with at most this share of the energy above it; pairs of frequency and energy.
double frequency_with_energy_above(std::vector<std::pair<double, double>> waves, double share) {
  double all = 0, above = 0;
  for (const auto& [omega, e] : waves) all += e;
  std::sort(waves.rbegin(), waves.rend());
  for (const auto& [omega, e] : waves)
    if ((above += e) > share * all) return omega;
  return 0;
}

// ---- seas that break before they are made ----

/// A height that no wave of this length can have.
void check_height(double height, double period, double length, const hydro::Water& water, const Place& place,
                  const char* what) {
  const double highest = hw::highest_wave(length, water.depth);
  if (height > highest)
    throw InputError(
        fmt::format("{} of {:.4g} m with a period of {:.4g} s is beyond breaking: the highest wave of that "
                    "length, {:.4g} m, is {:.4g} m (steepness {:.3g}, limit {:.3g})",
                    what, height, period, length, highest, height / length, highest / length),
        place, "make the waves lower, or longer");
}

/// As check_height(), with the length of linear theory on the current: against it waves are shorter.
void check_breaking(double height, double omega, const scene::Scene& scene, Angle heading, const char* what) {
  check_height(height, two_pi / omega, two_pi / wavenumber_in(scene, omega, heading), scene.water, scene.waves->place,
               what);
}

// ---- random seas ----

struct Cut {
  Band band;
  bool low_is_data = false, high_is_data = false;
};

/// The band that is cut up: given by the scene, else all but a hundredth of the accuracy asked on either side.
Band band_of(const scene::RandomSea& sea, const hw::Spectrum& spectrum, const std::optional<Band>& data,
             double accuracy) {
  const double negligible = 0.01 * accuracy;
  Band band{sea.lowest.value_or(frequency_with_share_above(spectrum, 1 - negligible)),
            sea.highest.value_or(frequency_with_share_above(spectrum, negligible))};
  if (data) band = {std::max(band.low, data->low), std::min(band.high, data->high)};
  return band;
}

void check_left_out(const scene::RandomSea& sea, const hw::Spectrum& spectrum, const Band& band,
                    const std::optional<Band>& data, double accuracy, const Place& place) {
  if (sea.lowest || sea.highest || !data) return;  // the scene has said so itself, and the result repeats it
  const double outside = 1 - spectrum.energy(std::min(band.low, band.high), band.high) / spectrum.moment(0);
  if (outside > accuracy)
    throw InputError(fmt::format("{:.2g} % of the sea's energy lies outside the frequencies of the data, {:.4g} "
                                 "to {:.4g} rad/s; the accuracy asked is {:.2g} %",
                                 100 * outside, data->low, data->high, 100 * accuracy),
                     place, "compute the coefficients for a wider band, choose another sea, or ask for less accuracy");
}

/// Systems of one scene draw from seeds of their own: the same phases twice would make them one sea.
std::uint64_t seed_of(const scene::RandomSea& sea, std::size_t system) {
  constexpr std::uint64_t apart = 0x9e3779b97f4a7c15;  // 2⁶⁴ over the golden ratio: far from any seed people write
  return sea.seed + apart * system;
}

/// Elevation of free and bound waves together at a place and time, m; on a grid without a list of all pairs.
double with_bound_waves(const hw::Sea& sea, const hw::Focus& f) {
  if (!std::isfinite(sea.repetition_s())) return hw::second_order_field(sea).elevation(f.t_s, f.x_m, f.y_m);
  const hw::BoundAtPoint bound = hw::bound_at_point(sea, {f.x_m, f.y_m, 0});
  double out = sea.elevation(f.t_s, f.x_m, f.y_m);
  for (std::size_t j = 0; j < bound.elevation.size(); ++j)
    out += (bound.elevation[j] * std::polar(1.0, two_pi * static_cast<double>(j) / bound.repetition_s * f.t_s)).real();
  return out;
}

/// With the crest at its place and time; where there are bound waves, the crest is that of the free ones which has the
/// height together with theirs. By secants: bound waves go with the square of the height.
hw::Sea with_crest(const hw::Sea& all, const scene::Crest& crest, bool bound, const Place& place) {
  const auto put_in = [&](double height) {
    return crest.alone ? hw::new_wave(all, height, crest.focus) : hw::constrained_new_wave(all, height, crest.focus);
  };
  if (!bound) return put_in(crest.height);
  const auto excess = [&](double free) { return with_bound_waves(put_in(free), crest.focus) - crest.height; };
  constexpr int most = 20;
  constexpr double tolerance = 1e-7;
  double before = 0, of_before = excess(before), free = crest.height;
  for (int i = 0; i < most; ++i) {
    const double of_free = excess(free);
    if (std::abs(of_free) <= tolerance * crest.height) return put_in(free);
    const double next = free - of_free * (free - before) / (of_free - of_before);
    before = free;
    of_before = of_free;
    free = next;
    if (!(free > 0 && free < 2 * crest.height)) break;
  }
  throw InputError(fmt::format("no crest of free waves is {:.4g} m high together with its bound waves", crest.height),
                   place, "ask for a lower crest: waves so steep have no second order");
}

hw::Sea random_sea(const scene::Scene& scene, const scene::RandomSea& sea, const std::optional<Band>& data) {
  const Place& place = scene.waves->place;
  std::vector<hw::Sea> systems;
  for (std::size_t i = 0; i < sea.systems.size(); ++i) {
    const auto& system = sea.systems[i];
    check_breaking(system.spectrum->hs(), system.spectrum->peak_omega(), scene, system.heading,
                   "a significant wave height");
    const Band band = band_of(sea, *system.spectrum, data, scene.accuracy);
    check_left_out(sea, *system.spectrum, band, data, scene.accuracy, place);
    scene::placed(sea.bins_place, [&] {
      systems.push_back(hw::Sea::irregular(*system.spectrum,
                                           {sea.bins, band.low, band.high, seed_of(sea, i), sea.amplitudes},
                                           {system.heading, system.spreading.get()}, scene.water, scene.current));
    });
  }
  hw::Sea all = hw::Sea::together(systems);
  if (!sea.crest) return all;
  return with_crest(all, *sea.crest, sea.second_order, place);
}

// ---- fields ----

/// The part of a uniform current along the waves; a steady nonlinear wave knows no other.
double current_along(const scene::Scene& scene) {
  if (scene.current.is_none()) return 0;
  const double heading = scene.waves->heading.radians();
  const Eigen::Vector2d U = scene.current.at(0), ahead(std::cos(heading), std::sin(heading));
  if (!scene.current.is_uniform() || std::abs(U.x() * ahead.y() - U.y() * ahead.x()) > 1e-12 * U.norm())
    throw InputError("a nonlinear regular wave takes a current that is uniform and along its heading only",
                     *scene.current_place, "use theory = \"linear\", or turn the current into the heading");
  return U.dot(ahead);
}

hw::SteadyWave steady_wave(const scene::Scene& scene, const scene::RegularWave& wave) {
  const hw::SteadyWaveInput input{.height_m = 2 * wave.amplitude,
                                  .length = hydro::AngularFrequency::from_period_s(wave.period),
                                  .water = scene.water,
                                  .mean_flow = hw::EulerianCurrent{current_along(scene)}};
  return scene::placed(scene.waves->place, [&] {
    const hw::SteadyWave steady = wave.theory == scene::RegularTheory::stokes_second  ? hw::stokes_second(input)
                                  : wave.theory == scene::RegularTheory::stokes_fifth ? hw::stokes_fifth(input)
                                                                                      : hw::stream_function(input);
    check_height(steady.height, wave.period, two_pi / steady.k, scene.water, scene.waves->place, "a wave height");
    return steady;
  });
}

void require_no_current(const scene::Scene& scene, const char* what) {
  if (!scene.current.is_none())
    throw InputError(fmt::format("{} are for water without a current", what), *scene.current_place,
                     "take [current] out, or use another kind of waves");
}

/// Until when a scene asks for its waves, s; 0: it does not.
double asked_until(const scene::Scene& scene) {
  const double series = scene.ask_waves ? scene.ask_waves->from + scene.ask_waves->duration : 0;
  return std::max(series, scene.run ? scene.run->duration : 0);
}

/// What the paddle's record makes of the tank: followed until the last sample asked, with enough rest after the record
/// that no wave of its repetition has arrived by then.
std::unique_ptr<const hw::WaveField> tank_field(const scene::Scene& scene, const scene::WaveTank& t) {
  require_no_current(scene, "waves of a tank");
  const hw::Band band{t.lowest, t.highest};
  const double until = asked_until(scene);
  const double fastest = std::sqrt(scene.water.gravity * scene.water.depth.metres());
  const bool come_back = t.reflection > 0 && !t.active_absorption;
  const int trips = come_back ? static_cast<int>(std::ceil(until * fastest / (2 * t.length))) : 0;
  const hw::Tank tank{
      .length_m = t.length,
      .water = scene.water,
      .paddle = t.hinge ? hw::Paddle::flap(*t.hinge) : hw::Paddle::piston(),
      .reflections = {.far_end = t.reflection,
                      .paddle = t.active_absorption ? hw::PaddleMode::absorbing : hw::PaddleMode::reflecting,
                      .round_trips = trips},
      .stretching = scene.waves->stretching};
  return scene::placed(scene.waves->place, [&] {
    const double slow = hw::arrival_time(scene.water, band, t.length * (2 * trips + 2));
    const double length = t.step * static_cast<double>(t.displacement.size());
    const auto motion = hw::record_spectrum(t.displacement, t.step, std::max(slow, until - length), band);
    return std::make_unique<hw::WaveTank>(tank, motion.harmonics);
  });
}

// ---- trains that take turns ----

/// How far anything in the scene is from a place, m, with room for hulls and lines about where they are placed.
double farthest_from(const scene::Scene& scene, const Eigen::Vector3d& at) {
  constexpr double room = 100;
  double out = 0;
  const auto look = [&](const Eigen::Vector3d& place) { out = std::max(out, (place - at).head<2>().norm()); };
  for (const auto& body : scene.bodies) look(body.position);
  for (const auto& probe : scene.probes) look(probe.at);
  for (const auto& line : scene.lines)
    for (const auto* end : {&line.from, &line.to})
      if (end->at && !end->body) look(*end->at);
  return out + room;
}

/// The trains as they are at their place; the first comes before anything of it is seen.
std::vector<hw::WaveTrain> given_trains(const scene::Scene& scene, const scene::WaveTrains& trains, double delay) {
  std::vector<hw::WaveTrain> out;
  double longest = 0;
  for (const auto& train : trains.trains) longest = std::max(longest, train.fade);
  for (const auto& train : trains.trains) {
    const bool first = out.empty();
    out.push_back({hydro::WaveAmplitude::from_metres(train.wave.amplitude),
                   hydro::AngularFrequency::from_period_s(train.wave.period), train.wave.phase,
                   train.heading.value_or(scene.waves->heading), first ? -delay - longest : train.from,
                   first ? longest : train.fade});
  }
  return out;
}

/// (W102). Around the run there is as much time as the slowest component needs to the farthest place.
hw::Sea trains_sea(const scene::Scene& scene, const scene::WaveTrains& trains, const std::optional<Band>& data) {
  require_no_current(scene, "trains of waves");
  const auto& last = trains.trains.back();
  const double asked = asked_until(scene), until = asked > 0 ? asked : last.from + last.fade + 20 * last.wave.period;
  double highest = 0, shortest = infinity;
  for (const auto& train : trains.trains) {
    const Angle heading = train.heading.value_or(scene.waves->heading);
    check_breaking(2 * train.wave.amplitude, two_pi / train.wave.period, scene, heading, "a wave height");
    if (train.from + train.fade > until)
      throw InputError(fmt::format("the train is whole at {:.6g} s, after the end of what is asked for at {:.6g} s",
                                   train.from + train.fade, until),
                       train.place, "ask for a longer run, or leave the train out");
    highest = std::max(highest, two_pi / train.wave.period);
    if (train.fade > 0) shortest = std::min(shortest, train.fade);
  }
  const double share = 0.1 * scene.accuracy;  // so small that it needs no estimate of its own
  const double delay =
      farthest_from(scene, trains.at) / hw::group_velocity(highest + hw::half_band(shortest, share), scene.water);
  const auto given = given_trains(scene, trains, delay);
  hw::TrainCut cut{given.front().from_s, until + delay + given.front().fade_s, share};
  if (data) cut.lowest = data->low, cut.highest = data->high;
  hw::TrainComponents found = hw::components_of(given, cut);
  if (data && found.left_out > scene.accuracy)
    throw InputError(
        fmt::format(
            "a train is off by up to {:.2g} % of its amplitude while it comes or goes, without what lies outside "
            "the frequencies of the data, {:.4g} to {:.4g} rad/s; the accuracy asked is {:.2g} %",
            100 * found.left_out, data->low, data->high, 100 * scene.accuracy),
        scene.waves->place,
        "let trains fade over a longer time, compute the coefficients for a wider band, or ask for less accuracy");
  for (hw::GivenWave& wave : found.waves) {
    const double ahead =
        trains.at.x() * std::cos(wave.heading.radians()) + trains.at.y() * std::sin(wave.heading.radians());
    wave.phase += hw::wavenumber(wave.omega.rad_per_s(), scene.water) * ahead;
  }
  return hw::Sea::of(found.waves, scene.water);
}

}  // namespace

bool is_linear_sum(const scene::Waves& waves) {
  if (const auto* regular = std::get_if<scene::RegularWave>(&waves.kind))
    return regular->theory == scene::RegularTheory::linear;
  const bool sum = std::holds_alternative<scene::RandomSea>(waves.kind) ||
                   std::holds_alternative<scene::WaveList>(waves.kind) ||
                   std::holds_alternative<scene::WaveTrains>(waves.kind);
  return sum && !has_bound_waves(waves);
}

double highest_relevant_frequency(const scene::Waves& waves) {
  constexpr double share = 0.05;  // what is above is followed less exactly, and weighs little
  if (const auto* regular = std::get_if<scene::RegularWave>(&waves.kind)) return two_pi / regular->period;
  double highest = 0;
  if (const auto* random = std::get_if<scene::RandomSea>(&waves.kind)) {
    for (const auto& system : random->systems)
      highest = std::max(highest, frequency_with_share_above(*system.spectrum, share));
    return highest;
  }
  if (const auto* tank = std::get_if<scene::WaveTank>(&waves.kind)) return tank->highest;
  if (const auto* trains = std::get_if<scene::WaveTrains>(&waves.kind)) {
    for (const auto& train : trains->trains) highest = std::max(highest, two_pi / train.wave.period);
    return highest;
  }
  std::vector<std::pair<double, double>> energy;  // falling frequency
  const auto note = [&](const auto& w) {
    energy.emplace_back(w.omega.rad_per_s(), w.amplitude.metres() * w.amplitude.metres());
  };
  if (const auto* list = std::get_if<scene::WaveList>(&waves.kind))
    for (const auto& w : list->waves) note(w);
  else
    for (const auto& w : std::get<scene::FocusedPackets>(waves.kind).packets) note(w);
  return frequency_with_energy_above(std::move(energy), share);
}

bool has_bound_waves(const scene::Waves& waves) {
  if (const auto* random = std::get_if<scene::RandomSea>(&waves.kind)) return random->second_order;
  if (const auto* list = std::get_if<scene::WaveList>(&waves.kind)) return list->second_order;
  return false;
}

hw::Sea make_sea(const scene::Scene& scene, const std::optional<Band>& data) {
  const scene::Waves& waves = *scene.waves;
  if (!is_linear_sum(waves))
    throw InputError("waves of this kind are not a sum of linear waves, which this needs", waves.place,
                     "use `froude waves make` for them, or linear waves here");
  return free_waves(scene, data);
}

hw::Sea free_waves(const scene::Scene& scene, const std::optional<Band>& data) {
  const scene::Waves& waves = *scene.waves;
  if (const auto* random = std::get_if<scene::RandomSea>(&waves.kind)) return random_sea(scene, *random, data);
  return scene::placed(waves.place, [&] {
    if (const auto* list = std::get_if<scene::WaveList>(&waves.kind))
      return hw::Sea::of(list->waves, scene.water, scene.current);
    if (const auto* trains = std::get_if<scene::WaveTrains>(&waves.kind)) return trains_sea(scene, *trains, data);
    const auto& regular = std::get<scene::RegularWave>(waves.kind);
    check_breaking(2 * regular.amplitude, two_pi / regular.period, scene, waves.heading, "a wave height");
    return hw::Sea::regular(hydro::WaveAmplitude::from_metres(regular.amplitude),
                            hydro::AngularFrequency::from_period_s(regular.period), waves.heading, scene.water,
                            regular.phase, scene.current);
  });
}

std::unique_ptr<const hw::WaveField> make_field(const scene::Scene& scene) {
  const scene::Waves& waves = *scene.waves;
  if (const auto* regular = std::get_if<scene::RegularWave>(&waves.kind);
      regular != nullptr && regular->theory != scene::RegularTheory::linear)
    return std::make_unique<hw::HarmonicField>(steady_wave(scene, *regular).field(waves.heading));
  if (const auto* packets = std::get_if<scene::FocusedPackets>(&waves.kind)) {
    require_no_current(scene, "focused packets");
    return std::make_unique<hw::PacketField>(packets->packets, packets->focus, waves.heading, scene.water,
                                             waves.stretching);
  }
  if (const auto* tank = std::get_if<scene::WaveTank>(&waves.kind)) return tank_field(scene, *tank);
  hw::HarmonicField::Options options;
  options.stretching = waves.stretching;
  if (!has_bound_waves(waves)) return std::make_unique<hw::SummedField>(hw::linear_field(make_sea(scene), options));
  return std::make_unique<hw::SummedField>(hw::second_order_field(free_waves(scene), {}, options));
}

namespace {

/// The steepest seas that are measured: 2πHs/(g Tp²) of 1/15 up to Tp = 8 s, 1/25 from 15 s, linear between
/// (DNV-RP-C205, limits for sea states in deep water).
double limiting_steepness(double tp) { return 1.0 / 15 + (1.0 / 25 - 1.0 / 15) * std::clamp((tp - 8) / 7, 0.0, 1.0); }

}  // namespace

namespace {

/// What the scene itself leaves out of a sea.
void note_cut(const scene::RandomSea& sea, double accuracy, std::vector<std::string>& out) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const double low = sea.lowest.value_or(0), high = sea.highest.value_or(none);
  // No cut; or no sea, which is refused where it is made.
  if ((low == 0 && high == none) || !(low < high)) return;
  double all = 0, inside = 0;  // m²
  for (const auto& system : sea.systems) {
    all += system.spectrum->moment(0);
    inside += system.spectrum->energy(low, high);
  }
  if (const double outside = 1 - inside / all; outside > accuracy)
    out.push_back(
        fmt::format("`lowest` and `highest` of the components leave {:.2g} % of the sea's energy "
                    "out: its significant height is {:.4g} m, and would be {:.4g} m",
                    100 * outside, 4 * std::sqrt(inside), 4 * std::sqrt(all)));
}

}  // namespace

std::vector<std::string> wave_warnings(const scene::Scene& scene) {
  const scene::Waves& waves = *scene.waves;
  std::vector<std::string> out;
  const auto note_limits = [&](const scene::RegularWave& wave) {
    for (std::string& one : hw::wave_limits({.height_m = 2 * wave.amplitude,
                            .length = hw::Wavelength::from_metres(wavelength_of(scene, wave)),
                            .water = scene.water})
                                .warnings)
      out.push_back(std::move(one));
  };
  if (const auto* regular = std::get_if<scene::RegularWave>(&waves.kind)) note_limits(*regular);
  if (const auto* trains = std::get_if<scene::WaveTrains>(&waves.kind))
    for (const auto& train : trains->trains) note_limits(train.wave);
  constexpr double much = 0.01;  // of the variance: 0.5 % of the height, which gauges tell no better
  if (const auto* list = std::get_if<scene::WaveList>(&waves.kind);
      list != nullptr && list->recorded && list->recorded->left_out > much)
    out.push_back(fmt::format("{:.2g} % of the variance of the recorded waves lies outside the band that is taken",
                              100 * list->recorded->left_out));
  if (const auto* random = std::get_if<scene::RandomSea>(&waves.kind)) {
    note_cut(*random, scene.accuracy, out);
    for (const auto& system : random->systems) {
      const double hs = system.spectrum->hs(), tp = two_pi / system.spectrum->peak_omega();
      const double steepness = two_pi * hs / (scene.water.gravity * tp * tp), limit = limiting_steepness(tp);
      if (steepness > limit)
        out.push_back(fmt::format(
            "2π Hs/(g Tp²) = {:.3g} is above {:.3g}: seas of Hs {:.3g} m with Tp {:.3g} s are not measured, they break",
            steepness, limit, hs, tp));
    }
  }
  return out;
}

double wavenumber_in(const scene::Scene& scene, double omega, Angle heading) {
  if (scene.current.is_none()) return hw::wavenumber(omega, scene.water);
  return scene::placed(scene.waves->place, [&] { return hw::doppler(omega, heading, scene.current, scene.water).k; });
}

double wavelength_of(const scene::Scene& scene, const scene::RegularWave& wave) {
  return two_pi / (wave.theory == scene::RegularTheory::linear
                       ? wavenumber_in(scene, two_pi / wave.period, scene.waves->heading)
                       : steady_wave(scene, wave).k);
}

bool is_beyond_breaking(const scene::Scene& scene, const scene::RegularWave& wave) {
  const double linear = two_pi / wavenumber_in(scene, two_pi / wave.period, scene.waves->heading);
  const bool too_high = 2 * wave.amplitude > hw::highest_wave(linear, scene.water.depth);
  if (wave.theory == scene::RegularTheory::linear) return too_high;
  try {  // the length of a high wave is its theory's, which may have none
    steady_wave(scene, wave);
    return false;
  } catch (const InputError&) {
    if (too_high) return true;
    throw;
  }
}

std::complex<double> elevation_at_origin(const hydro::waves::Component& c) { return std::polar(c.amplitude, c.phase); }

hw::FieldUse water_around(const scene::Scene& scene, const Eigen::AlignedBox3d& places, double highest_crest,
                          double step, double points) {
  // Room to move: the orbits of high waves, and some metres of drift.
  const Eigen::Vector3d room(2 * highest_crest + 2, 2 * highest_crest + 2, highest_crest);
  constexpr double beyond = 1e-3;  // s: rates of added mass are differences, which look past the end of the run
  hw::FieldUse use{.box = {0, scene.run->duration + beyond, places.min() - room, places.max() + room},
                   .instants = scene.run->duration / step,
                   .points = points};
  use.box.low.z() = std::max(use.box.low.z(), -scene.water.depth.metres());
  use.box.high.z() = std::min(use.box.high.z(), highest_crest);
  // Of each wave, so small a share of the accuracy that it needs no estimate of its own. From 1e-5 on the window's own
  // ends would be steps that Newton sees.
  constexpr double share = 1e-4;
  use.tolerance = std::clamp(share * scene.accuracy, 1e-11, 1e-5);
  return use;
}

}  // namespace froude::compile
