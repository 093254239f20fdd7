/// \file  `froude waves info`: what a sea is, whether it comes as a scene, a list of components, a table of a spectrum
/// or a record of the surface.
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <sstream>

#include "compile/waves.hpp"
#include "froude/commands.hpp"
#include "froude/report.hpp"
#include "froude/result.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/signal/welch.hpp"
#include "hydro/signal/zero_crossings.hpp"
#include "hydro/waves/dispersion.hpp"
#include "hydro/waves/kinematics/focus.hpp"
#include "hydro/waves/kinematics/limits.hpp"
#include "hydro/waves/spectra/spectrum_tabulated.hpp"
#include "hydro/waves/spectra/statistics.hpp"
#include "scene/placed.hpp"
#include "scene/scene.hpp"

namespace froude {
namespace {

namespace hw = hydro::waves;
namespace hs = hydro::signal;
constexpr double two_pi = 2 * std::numbers::pi;

struct Info {
  std::string what;  ///< "231 regular waves from a list"
  Report facts = {};
  std::vector<std::string> remarks = {};  ///< sentences with their numbers
};

/// One number of a sea, with what it means.
void add(Info& info, const std::string& key, double value, const char* unit, const std::string& meaning) {
  const bool counted = key == "components" || key == "waves";
  Report one;
  one.say("  {:<20} {:>10} {:<4} {}", key,
          fact("value", value, counted ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value)),
          fact("unit", unit), fact("meaning", meaning));
  info.facts.part(key, one);
}

// ---- what all kinds have in common ----

/// How long a wave of a period is, and by what.
struct Length {
  double metres;
  std::string by = {};  ///< " on the current"
};

Length in_still_water(double period, const hydro::Water& water) {
  return {two_pi / hw::wavenumber(two_pi / period, water)};
}

Length in_scene(double period, const scene::Scene& scene, hydro::Angle heading) {
  return {two_pi / compile::wavenumber_in(scene, two_pi / period, heading),
          scene.current.is_none() ? "" : " on the current"};
}

constexpr const char* what_flux_is = "energy that passes a metre of crest, ρ g ∫ S c_g, in still water";

/// ρ g m₀ c_g of waves of this variance and frequency, W/m.
double energy_flux(double variance, double omega, const hydro::Water& water) {
  return water.density * water.gravity * variance * hw::group_velocity(omega, water);
}

double energy_flux(const hw::Spectrum& s, const hydro::Water& water) {
  constexpr int slices = 400;
  constexpr double lowest = 0.2, highest = 50;  // times the peak: beyond is less than 1e-3, of a tail of ω⁻⁴ 1e-4
  const auto at = [&](int i) {
    return s.peak_omega() * lowest * std::pow(highest / lowest, static_cast<double>(i) / slices);
  };
  double out = 0;
  for (int i = 0; i < slices; ++i) out += energy_flux(s.energy(at(i), at(i + 1)), std::sqrt(at(i) * at(i + 1)), water);
  return out;
}

double energy_flux(const hs::SpectrumPerHz& s, const hydro::Water& water) {
  const double df = s.frequency_hz[1] - s.frequency_hz[0];
  double out = 0;
  for (std::size_t k = 1; k < s.density.size(); ++k)
    out += energy_flux(s.density[k] * df * (k + 1 == s.density.size() ? 0.5 : 1), two_pi * s.frequency_hz[k], water);
  return out;
}

/// Steepness, depth and breaking of a sea of this height and period.
void add_shape(Info& info, double height, double period, const hydro::Water& water, const Length& of_period) {
  const double length = of_period.metres, k = two_pi / length;
  const double highest = hw::highest_wave(length, water.depth);
  add(info, "wavelength", length, "m", fmt::format("length of a wave of {:.4g} s{}", period, of_period.by));
  add(info, "steepness", height / length, "", "height over that length");
  if (!water.depth.is_infinite()) {
    const double h = water.depth.metres();
    add(info, "relative_depth", h / length, "", "depth over that length");
    add(info, "ursell_number", hw::ursell_number(height, length, water.depth), "",
        "H λ²/h³; linear and Stokes waves end near 26");
  }
  const double kh = k * water.depth.metres();
  info.remarks.push_back(
      fmt::format("the water is {} for these waves (kh = {:.4g})", hw::name(hw::depth_regime(kh)), kh));
  if (height > highest)
    info.remarks.push_back(
        fmt::format("breaking: {:.4g} m is higher than the highest wave of that length, {:.4g} m", height, highest));
  else
    info.remarks.push_back(fmt::format("breaking: {:.3g} of the height of the highest wave of that length, {:.4g} m",
                                       height / highest, highest));
}

void add_spectrum(Info& info, const hw::Spectrum& s, const hydro::Water& water, const Length& of_peak) {
  add(info, "hs", s.hs(), "m", "significant height 4 √m0");
  add(info, "tp", s.tp(), "s", "peak period");
  add(info, "tz", s.tz(), "s", "mean period of up-crossings 2π √(m0/m2)");
  add(info, "tm01", s.mean_period(), "s", "mean period 2π m0/m1");
  add(info, "te", s.energy_period(), "s", "energy period 2π m-1/m0");
  add(info, "narrowness", hw::narrowness(s), "", "√(m0 m2/m1² − 1)");
  add(info, "energy_flux", energy_flux(s, water), "W/m", what_flux_is);
  if (std::isfinite(s.tail_power()))
    info.remarks.push_back(fmt::format("at high frequency the spectrum falls as omega^-{:.3g}{}", s.tail_power(),
                                       s.tail_power() <= 5 ? ", so its m4 is infinite" : ""));
  add_shape(info, s.hs(), s.tp(), water, of_peak);
}

// ---- components ----

double sum_of(const hw::Sea& sea, int n) {
  double sum = 0;
  for (const auto& w : sea.components()) sum += std::pow(w.omega, n) * w.amplitude * w.amplitude / 2;
  return sum;
}

/// A tenth of a per cent: what chance does in one record of a thousand is called a focus.
constexpr double chance = 1e-3;

/// A crest that was put into a sea, and the sea that it was put into, by whose energy its chance goes.
struct PutIn {
  hw::Sea before;
  hw::Focus focus;
};

/// Looks at the place of a crest that was put in, else at x = y = 0.
void add_focus(Info& info, const hw::Sea& sea, double reach, const std::optional<PutIn>& put_in = {}) {
  const hw::Focus at = put_in ? put_in->focus : hw::Focus{};
  hw::FocusFound f = hw::find_focus(sea, at.x_m, at.y_m, -reach, reach);
  if (put_in) f.probability = hw::chance_of_crest(put_in->before, f.crest_m, 2 * reach);
  const double hs = put_in ? put_in->before.hs() : sea.hs();
  const std::string place =
      at.x_m == 0 && at.y_m == 0 ? "x = y = 0" : fmt::format("x = {:.4g} m, y = {:.4g} m", at.x_m, at.y_m);
  double all = 0;
  for (const auto& w : sea.components()) all += w.amplitude;
  add(info, "sum_of_amplitudes", all, "m", "height if all were in phase");
  add(info, "focus_time", f.t_s, "s", fmt::format("greatest envelope at {} within ±{:.4g} s", place, reach));
  add(info, "focus_envelope", f.envelope_m, "m", "envelope then");
  add(info, "focus_share", f.share, "", "of the sum of amplitudes");
  add(info, "highest_crest", f.crest_m, "m", "in the same time");
  add(info, "highest_crest_time", f.crest_t_s, "s", "when");
  add(info, "chance_of_crest", f.probability, "",
      put_in ? "of such a crest in the sea without it" : "of such a crest in a Gaussian sea of the same energy");
  if (put_in) {
    info.remarks.push_back(fmt::format(
        "a crest is put in at {}; in the sea without it one of {:.3g} Hs has a chance of {:.2g} in that time", place,
        f.crest_m / hs, f.probability));
    return;
  }
  info.remarks.push_back(
      f.probability < chance
          ? fmt::format("focused: the waves meet at x = y = 0 at {:.4g} s, {:.4g} m high at {:.4g} s, {:.3g} Hs; in a "
                        "random sea that has a chance of {:.2g}",
                        f.t_s, f.crest_m, f.crest_t_s, f.crest_m / sea.hs(), f.probability)
          : fmt::format(
                "not focused: the highest crest, {:.3g} Hs, is one that a random sea has with a chance of {:.2g}",
                f.crest_m / sea.hs(), f.probability));
}

/// s around t = 0 that are searched for a crest that was put in.
double reach_of(const hw::Focus& focus) { return std::max(100.0, 1.5 * std::abs(focus.t_s)); }

Info of_components(const hw::Sea& sea, const std::string& what, const std::function<Length(double)>& length_of,
                   const std::optional<PutIn>& put_in = {}) {
  Info info{.what = what};
  const auto [shortest, longest] = std::minmax_element(sea.components().begin(), sea.components().end(),
                                                       [](const auto& a, const auto& b) { return a.omega > b.omega; });
  const double m0 = sum_of(sea, 0), tz = two_pi * std::sqrt(m0 / sum_of(sea, 2));
  hydro::require(m0 > 0, "all amplitudes are zero");
  add(info, "components", static_cast<double>(sea.components().size()), "", "regular waves");
  add(info, "shortest_period", two_pi / shortest->omega, "s", "of a component");
  add(info, "longest_period", two_pi / longest->omega, "s", "of a component");
  add(info, "hs", sea.hs(), "m", "significant height 4 √(Σ a²/2)");
  add(info, "tz", tz, "s", "mean period of up-crossings 2π √(m0/m2)");
  add(info, "tm01", two_pi * m0 / sum_of(sea, 1), "s", "mean period 2π m0/m1");
  add(info, "te", two_pi * sum_of(sea, -1) / m0, "s", "energy period 2π m-1/m0");
  const double te = two_pi * sum_of(sea, -1) / m0, usual_reach = 10 * two_pi / longest->omega;
  add_shape(info, sea.hs(), te, sea.water(), length_of(te));
  add_focus(info, sea, put_in ? reach_of(put_in->focus) : usual_reach, put_in);
  return info;
}

// ---- records ----

Info of_record(const std::vector<double>& time, const std::vector<double>& elevation, const hydro::Water& water) {
  Info info{.what = fmt::format("a record of {} samples", time.size())};
  const double step = hs::even_step(time);
  double mean = 0, m0 = 0;
  for (const double v : elevation) mean += v / static_cast<double>(elevation.size());
  for (const double v : elevation) m0 += (v - mean) * (v - mean) / static_cast<double>(elevation.size());
  hydro::require(m0 > 0, "the elevation never changes");
  add(info, "duration", step * static_cast<double>(time.size() - 1), "s", fmt::format("sampled every {:.6g} s", step));
  add(info, "mean", mean, "m", "of the elevation, taken off below");
  add(info, "hs", 4 * std::sqrt(m0), "m", "significant height 4 √m0, m0 the variance");
  const hs::WelchSpectrum welch = hs::welch(elevation, step, hs::fifteen_segments(elevation.size()));
  const hs::Moments m = hs::moments(welch.spectrum, hs::whole(welch.spectrum));
  const hs::Peak peak = hs::peak(welch.spectrum, hs::whole(welch.spectrum));
  add(info, "tp", peak.period_s(), "s", "period of the spectrum's highest point, which scatters");
  add(info, "te", m.te(), "s", "energy period m-1/m0");
  add(info, "tm01", m.tm01(), "s", "mean period m0/m1");
  add(info, "tm02", m.tm02(), "s", "√(m0/m2)");
  add(info, "energy_flux", energy_flux(welch.spectrum, water), "W/m", what_flux_is);
  const auto waves = hs::single_waves(time, elevation);
  if (waves.size() >= 3) {
    const hs::WaveStatistics w = hs::wave_statistics(waves);
    double crest = 0, steepest = 0;
    for (const auto& wave : waves) {
      crest = std::max(crest, wave.crest);
      steepest = std::max(steepest, wave.height() * hw::wavenumber(two_pi / wave.period, water) / two_pi);
    }
    add(info, "waves", static_cast<double>(w.count), "", "from one up-crossing of the mean to the next");
    add(info, "tz", w.mean_period, "s", "mean period of those");
    add(info, "h13", w.h13, "m", "mean height of the highest third");
    add(info, "highest_wave", w.highest, "m", "of those, from trough to crest");
    add(info, "highest_crest", crest, "m", "above the mean");
    add(info, "steepest_wave", steepest, "", "height over the linear length of its period; breaking begins near 0.142");
    const double n = static_cast<double>(w.count), exceeded = std::exp(-8 * crest * crest / (16 * m0));
    const double probability = -std::expm1(n * std::log1p(-exceeded));
    info.remarks.push_back(
        fmt::format("{}: the highest crest is {:.3g} Hs; a Gaussian sea has one as high in as many waves "
                    "with a chance of {:.2g}",
                    probability < chance ? "focused" : "not focused", crest / (4 * std::sqrt(m0)), probability));
  }
  add_shape(info, 4 * std::sqrt(m0), m.te(), water, in_still_water(m.te(), water));
  return info;
}

// ---- files ----

Info of_regular(const scene::Scene& scene, const scene::RegularWave& wave) {
  Info info{.what = "a regular wave"};
  add(info, "height", 2 * wave.amplitude, "m", "from trough to crest");
  add(info, "period", wave.period, "s", "at a fixed point");
  add(info, "energy_flux", energy_flux(wave.amplitude * wave.amplitude / 2, two_pi / wave.period, scene.water), "W/m",
      what_flux_is);
  // Region and warnings by the length that the period has in linear theory: that is how the chart is read.
  const Length linear = in_scene(wave.period, scene, scene.waves->heading);
  const hw::WaveLimits limits = hw::wave_limits(
      {.height_m = 2 * wave.amplitude, .length = hw::Wavelength::from_metres(linear.metres), .water = scene.water});
  const bool is_linear = wave.theory == scene::RegularTheory::linear;
  if (!is_linear) add(info, "linear_wavelength", linear.metres, "m", "by linear theory" + linear.by);
  add_shape(info, 2 * wave.amplitude, wave.period, scene.water,
            is_linear ? linear : Length{compile::wavelength_of(scene, wave), " by its theory" + linear.by});
  info.remarks.push_back(fmt::format("the theory for it is {}", hw::name(limits.region)));
  for (const auto& warning : limits.warnings) info.remarks.push_back(warning);
  return info;
}

/// The sea of the scene as it was before a crest was put in, if one is.
std::optional<PutIn> put_in_of(const scene::Scene& scene, const scene::RandomSea& random) {
  if (!random.crest) return {};
  scene::Scene before = scene;
  std::get<scene::RandomSea>(before.waves->kind).crest.reset();
  return PutIn{compile::free_waves(before), random.crest->focus};
}

Info of_random(const scene::Scene& scene, const scene::RandomSea& random) {
  const hw::Sea sea = compile::free_waves(scene);
  const auto put_in = put_in_of(scene, random);
  const auto length_of = [&](double period) { return in_scene(period, scene, random.systems.front().heading); };
  Info info{.what = fmt::format("a random sea of kind {}, {} components", random.systems.front().kind,
                                sea.components().size())};
  if (random.systems.size() > 1) {
    info = of_components(
        sea, fmt::format("{} random seas at once, {} components", random.systems.size(), sea.components().size()),
        length_of, put_in);
  } else {
    const hw::Spectrum& spectrum = *random.systems.front().spectrum;
    add_spectrum(info, spectrum, scene.water, length_of(spectrum.tp()));
    if (put_in) {
      add_focus(info, sea, reach_of(put_in->focus), put_in);
    } else {
      const auto [low, high] = std::minmax_element(sea.components().begin(), sea.components().end(),
                                                   [](const auto& a, const auto& b) { return a.omega < b.omega; });
      const hw::DiscretisationError error = hw::discretisation_error(sea, spectrum, low->omega, high->omega);
      info.remarks.push_back(
          fmt::format("cutting the spectrum into components changed m0, m1, m2, m4 of its band by "
                      "{:.2g}, {:.2g}, {:.2g}, {:.2g}",
                      error.m0, error.m1, error.m2, error.m4));
    }
  }
  info.remarks.push_back(fmt::format("{:.2g} of the energy is in no component", sea.fraction_left_out()));
  info.remarks.push_back(std::isinf(sea.repetition_s())
                             ? "the sea never repeats"
                             : fmt::format("the sea repeats after {:.6g} s", sea.repetition_s()));
  return info;
}

Info of_packets(const scene::Scene& scene, const scene::FocusedPackets& packets) {
  Info info{.what = fmt::format("{} packets that meet", packets.packets.size())};
  double all = 0, shortest = std::numeric_limits<double>::infinity(), longest = 0;
  for (const auto& p : packets.packets) {
    all += p.amplitude.metres();
    shortest = std::min(shortest, p.omega.period_s());
    longest = std::max(longest, p.omega.period_s());
  }
  add(info, "sum_of_amplitudes", all, "m", "height of the crest at the focus");
  add(info, "focus_time", packets.focus.t_s, "s", "when they meet");
  add(info, "shortest_period", shortest, "s", "of a packet");
  add(info, "longest_period", longest, "s", "of a packet");
  add_shape(info, 2 * all, longest, scene.water, in_still_water(longest, scene.water));
  return info;
}

Info of_trains(const scene::Scene& scene, const scene::WaveTrains& trains) {
  Info info{.what = fmt::format("{} trains of regular waves that take turns", trains.trains.size())};
  const hw::Sea sea = compile::free_waves(scene);
  add(info, "components", static_cast<double>(sea.components().size()), "", "into which they are cut");
  for (std::size_t i = 0; i < trains.trains.size(); ++i) {
    const auto& [wave, heading, from, fade, place] = trains.trains[i];
    const std::string n = std::to_string(i + 1);
    add(info, "height_" + n, 2 * wave.amplitude, "m", "of train " + n + ", from trough to crest");
    add(info, "period_" + n, wave.period, "s", "of train " + n);
    if (i > 0) add(info, "from_" + n, from, "s", fmt::format("when it begins to come, over {:.4g} s", fade));
  }
  const scene::RegularWave& steepest =
      std::max_element(trains.trains.begin(), trains.trains.end(), [](const auto& a, const auto& b) {
        return a.wave.amplitude / (a.wave.period * a.wave.period) < b.wave.amplitude / (b.wave.period * b.wave.period);
      })->wave;
  add_shape(info, 2 * steepest.amplitude, steepest.period, scene.water, in_still_water(steepest.period, scene.water));
  return info;
}

Info of_scene(const Path& file) {
  const scene::Scene scene = scene::read(file);
  if (!scene.waves) throw hydro::InputError("the scene has no [waves]", {.file = file.string()}, "add a [waves] table");
  const auto& kind = scene.waves->kind;
  if (const auto* regular = std::get_if<scene::RegularWave>(&kind)) return of_regular(scene, *regular);
  if (const auto* random = std::get_if<scene::RandomSea>(&kind)) return of_random(scene, *random);
  if (const auto* packets = std::get_if<scene::FocusedPackets>(&kind)) return of_packets(scene, *packets);
  if (const auto* trains = std::get_if<scene::WaveTrains>(&kind)) return of_trains(scene, *trains);
  if (std::holds_alternative<scene::WaveList>(kind)) {
    const hw::Sea sea = compile::free_waves(scene);
    return of_components(sea, fmt::format("{} regular waves from a list", sea.components().size()),
                         [&](double period) { return in_scene(period, scene, scene.waves->heading); });
  }
  throw hydro::InputError("what a tank's waves are is told by its series", scene.waves->place,
                          "use `froude waves make`, then `froude waves info` of a record it writes");
}

bool any_of(const hydro::io::CsvTable& table, std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(), [&](const char* n) { return table.has(n); });
}

Info of_csv(const WavesInfoArguments& arguments, const hydro::Water& water) {
  const auto table = hydro::io::CsvTable::read(arguments.file);
  if (any_of(table, {"phase", "phase_rad", "phase_deg"})) {
    const auto list = scene::read_wave_list(arguments.file, hydro::Angle::from_radians(0), arguments.phase_of_kx);
    return of_components(hw::Sea::of(list, water), fmt::format("{} regular waves from a list", list.size()),
                         [&](double period) { return in_still_water(period, water); });
  }
  if (table.has("density")) {
    Info info{.what = "a table of a spectrum"};
    const hw::TabulatedSpectrum spectrum = hw::TabulatedSpectrum::read(arguments.file);
    add_spectrum(info, spectrum, water, in_still_water(spectrum.tp(), water));
    return info;
  }
  const std::string column = arguments.column.value_or("elevation");
  if (!table.has("time") || !table.has(column))
    throw hydro::InputError("neither a list of waves, nor a spectrum, nor a record", {.file = arguments.file.string()},
                            fmt::format("a list needs period, amplitude and phase; a spectrum frequency and density; a "
                                        "record time and {} (or name its column with --column)",
                                        column));
  return of_record(table.column("time", hydro::dim::time), table.column(column, hydro::dim::length), water);
}

/// Two columns of numbers without a header, as records of elevation are often kept: time in s, elevation in m.
Info of_plain_columns(const Path& file, const hydro::Water& water) {
  const std::string text = hydro::io::read_text(file);
  std::vector<double> time, elevation;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos || line[line.find_first_not_of(" \t")] == '#') continue;
    std::istringstream cells(line);
    double t = 0, z = 0;
    std::string rest;
    if (!(cells >> t >> z) || cells >> rest || !std::isfinite(t) || !std::isfinite(z))
      throw hydro::InputError("a row of a record without header is two numbers, time in s and elevation in m",
                              {.file = file.string(), .line = number, .text = line},
                              "mend the row, or give the file a header: time [s], elevation [m]");
    time.push_back(t);
    elevation.push_back(z);
  }
  return of_record(time, elevation, water);
}

Info of_result(const WavesInfoArguments& arguments, const hydro::Water& water) {
  const RunResult result = read_run(arguments.file);
  const std::string wanted = arguments.column.value_or("");
  std::vector<std::string> names;
  for (const Signal& s : result.signals) {
    if (s.units != "m") continue;
    names.push_back(s.name);
    if (s.name == wanted || (wanted.empty() && s.name.ends_with(".elevation")))
      return of_record(result.time, s.values, water);
  }
  throw hydro::InputError(
      wanted.empty() ? "the result holds no elevation" : fmt::format("the result holds no \"{}\"", wanted),
      {.file = arguments.file.string()}, fmt::format("--column may be {}", fmt::join(names, ", ")));
}

Info of_file(const WavesInfoArguments& arguments) {
  const std::string ending = arguments.file.extension().string();
  if (ending == ".toml") return of_scene(arguments.file);
  const hydro::Water water{.gravity = arguments.gravity, .depth = arguments.depth};
  if (ending == ".h5" || ending == ".nc") return of_result(arguments, water);
  if (ending == ".csv") return of_csv(arguments, water);
  return of_plain_columns(arguments.file, water);
}

}  // namespace

void waves_info(const WavesInfoArguments& arguments, const Console& console) {
  const Info info = scene::placed({.file = arguments.file.string()}, [&] { return of_file(arguments); });
  Report out;
  out.say("{}: {}", fact("file", arguments.file.string(), arguments.file.filename().string()), fact("what", info.what));
  tell(out.part("facts", info.facts).sentences("remarks", "  {}", info.remarks), console);
}

}  // namespace froude
