#include "froude/experiment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "answers/picture.hpp"
#include "froude/outputs.hpp"
#include "froude/report.hpp"
#include "hydro/base/error.hpp"
#include "hydro/waves/dispersion.hpp"
#include "hydro/waves/kinematics/limits.hpp"
#include "scene/placed.hpp"

namespace froude {
namespace {

namespace hw = hydro::waves;

void tell_lengths(const OscillationPlanArguments& a, const ::fit::OscillationNumbers& n, Report& out) {
  ::fit::PlannedOscillation plan = a.record;
  plan.cylinder.diameter = *n.diameter;
  plan.amplitude = *n.amplitude;
  plan.period = *n.period;
  const auto tried = ::fit::lengths_for(plan, a.wanted, *a.width);
  out.say("lengths, each fitted {} times to made records:", fact("made_records", ::fit::made_records));
  out.say("{:>8} {:>10} {:>12} {:>8} {:>12} {:>8}", "cycles", "time [s]", "cd +-", "held", "ca +-", "held");
  for (const auto& l : tried)
    out.row("length", "{:>8} {:>10} {:>12} {:>8} {:>12} {:>8}", fact("cycles", l.cycles),
            fact("time_s", l.cycles * plan.period, fmt::format("{:.4g}", l.cycles * plan.period)),
            fact("cd_half_width", l.cd_half_width, fmt::format("{:.3g}", l.cd_half_width)),
            fact("cd_held", l.cd_held, fmt::format("{:.2g}", l.cd_held)),
            fact("ca_half_width", l.inertia_half_width, fmt::format("{:.3g}", l.inertia_half_width)),
            fact("ca_held", l.inertia_held, fmt::format("{:.2g}", l.inertia_held)));
  const auto& last = tried.back();
  const bool cd = a.wanted == ::fit::Wanted::cd;
  const double reached = cd ? last.cd_half_width : last.inertia_half_width;
  if (reached > *a.width)
    throw hydro::InputError(fmt::format("{} cycles have a half width of {:.3g} still, and {:.3g} is wanted",
                                        last.cycles, reached, *a.width),
                            {.file = "--width"}, "less noise, a larger motion, or a wider interval");
  out.say("{} cycles, {:.4g} s, tell {} to ±{:.3g}", fact("cycles", last.cycles),
          fact("time_s", last.cycles * plan.period), fact("of", cd ? "cd" : "ca"), fact("half_width", reached));
}

/// How long the carriage must tow at one speed, against how long the tank lets it.
void tell_times(const TowPlanArguments& a, double diameter, double speed, double steady_s, Report& out) {
  ::fit::PlannedTow plan = a.record;
  plan.cylinder.diameter = diameter;
  plan.speed = speed;
  plan.acceleration = a.acceleration;
  const auto tried = ::fit::times_for(plan, *a.width);
  out.say("times at one speed, each fitted {} times to made records:", fact("made_records", ::fit::made_records));
  out.say("{:>8} {:>10} {:>12} {:>8} {:>8}", "time [s]", "diameters", "cd +-", "held", "refused");
  for (const auto& t : tried)
    out.row("time", "{:>8} {:>10} {:>12} {:>8} {:>8}", fact("time_s", t.seconds),
            fact("diameters", t.seconds * speed / diameter, fmt::format("{:.3g}", t.seconds * speed / diameter)),
            fact("cd_half_width", t.half_width, fmt::format("{:.3g}", t.half_width)),
            fact("cd_held", t.held, fmt::format("{:.2g}", t.held)),
            fact("refused", t.refused, fmt::format("{:.2g}", t.refused)));
  const auto& last = tried.back();
  if (!last.holds || last.half_width > *a.width)
    throw hydro::InputError(fmt::format("{} s have a half width of {:.3g} still, of intervals that hold in {:.2g} of "
                                        "cases, and {:.3g} is wanted",
                                        last.seconds, last.half_width, last.held, *a.width),
                            {.file = "--width"}, "less noise, a higher speed, or a wider interval");
  out.say("{} s tell cd to ±{:.3g}", fact("needed_s", last.seconds), fact("half_width", last.half_width));
  if (last.seconds > steady_s)
    out.sentences(
        "warnings", "caution: {}",
        std::vector<std::string>{fmt::format(
            "the tank leaves {:.4g} s: about {:.0f} tows together tell as much, if they differ by their noise "
            "alone",
            steady_s, std::max(3.0, std::ceil(last.seconds / steady_s)))});
}

/// Which of the two loads a fit can tell, by C_D KC/(π² C). (F109)
void tell_leading_load(double cd, double kc, double inertia, const char* symbol, Report& out) {
  const double ratio = ::fit::drag_over_inertia(cd, kc, inertia);
  const char* leads = kc < 3 ? "inertia alone is told well below KC 3"
                             : (kc > 40 ? "drag alone is told well above KC 40" : "both count between KC 3 and 40");
  out.say("drag is {:.3g} times inertia with C_D {:g} and {} {:g}: {}", fact("drag_over_inertia", ratio),
          fact("expected_cd", cd), symbol, fact("expected_inertia", inertia), leads);
}

/// The largest speed along the waves at the axis of the cylinder, in waves of this height and frequency, by linear
/// theory.
double speed_at_axis(const WavePlanArguments& a, double height, double omega) {
  const auto& depth = a.tank.water.depth;
  const double k = hw::wavenumber(omega, a.tank.water), z = -*a.level;
  const double fall = depth.is_infinite() ? std::exp(k * z)
                                          : std::exp(k * z) * (1 + std::exp(-2 * k * (z + depth.metres()))) /
                                                -std::expm1(-2 * k * depth.metres());
  return height / 2 * omega * fall;
}

/// What the water does at the axis of a cylinder across the waves.
void tell_cylinder(const WavePlanArguments& a, double omega, Report& out) {
  if (a.diameter.has_value() != a.level.has_value())
    throw hydro::InputError("--diameter and --level belong together", {.file = "command line"}, "give both, or none");
  if (!a.diameter) return;
  const auto& depth = a.tank.water.depth;
  hydro::require(*a.level >= 0 && (depth.is_infinite() || *a.level < depth.metres()),
                 "--level must lie between the surface and the bottom, got {} m", *a.level);
  const double speed = speed_at_axis(a, a.height, omega);
  out.say("at the axis the water goes at {:.4g} m/s at most along the waves: KC {:.4g}", fact("speed", speed),
          fact("kc", speed * a.period / *a.diameter));
  tell_leading_load(a.cd, speed * a.period / *a.diameter, a.cm, "C_M", out);
}

constexpr double slender = 0.05;  // of a wavelength: Huijgen 2024, equation 6.11

/// Which load leads on the cylinder in waves of other lengths and heights: KC over thickness, with where waves break.
plot::Figure regimes(const WavePlanArguments& a, double omega) {
  constexpr double thinnest = 3e-3, thickest = 1, lowest = 0.1, highest = 100;
  plot::Panel panel{.x = {"diameter over wavelength", "", plot::Scale::logarithmic, {{thinnest, thickest}}},
                    .y = {"KC at the axis", "", plot::Scale::logarithmic, {{lowest, highest}}},
                    .series = {}};
  plot::Series breaking{.name = "highest waves", .x = {}, .y = {}};
  constexpr int points = 81;
  for (int i = 0; i < points; ++i) {
    const double ratio = thinnest * std::pow(thickest / thinnest, i / (points - 1.0));
    const double w = hw::angular_frequency(2 * std::numbers::pi * ratio / *a.diameter, a.tank.water);
    const auto limits = hw::wave_limits(
        {.height_m = a.height, .length = hydro::AngularFrequency::from_rad_per_s(w), .water = a.tank.water});
    breaking.x.push_back(ratio);
    breaking.y.push_back(speed_at_axis(a, limits.highest, w) * 2 * std::numbers::pi / w / *a.diameter);
  }
  panel.series.push_back(std::move(breaking));
  for (const double ratio : {10.0, 1.0, 0.1}) {
    const double kc = ratio / ::fit::drag_over_inertia(a.cd, 1, a.cm);
    panel.series.push_back({.name = fmt::format("drag {:g} times inertia", ratio),
                            .x = {thinnest, thickest},
                            .y = {kc, kc},
                            .dashed = true});
  }
  panel.series.push_back(
      {.name = "slender left of it", .x = {slender, slender}, .y = {lowest, highest}, .dashed = true});
  panel.series.push_back({.name = "these waves",
                          .x = {*a.diameter * hw::wavenumber(omega, a.tank.water) / (2 * std::numbers::pi)},
                          .y = {speed_at_axis(a, a.height, omega) * a.period / *a.diameter},
                          .line = false,
                          .marks = true});
  return {.title = fmt::format("Loads on a cylinder of {:.4g} m whose axis lies {:.4g} m below still water",
                               *a.diameter, *a.level),
          .panels = {std::move(panel)}};
}

/// Whether the waves pass the cylinder as if it were not there, as Morison's equation has it.
void tell_slenderness(const WavePlanArguments& a, double wavelength, std::vector<std::string>& warnings, Report& out) {
  if (!a.diameter) return;
  const double ratio = *a.diameter / wavelength;
  out.say("the cylinder is {:.3g} of a wavelength thick", fact("diameter_over_wavelength", ratio));
  if (ratio >= slender)
    warnings.push_back(fmt::format(
        "a cylinder of {:.3g} wavelengths is not slender: Morison's equation is for less than {:g}", ratio, slender));
}

}  // namespace

void plan_oscillation(const OscillationPlanArguments& a, const Console& console) {
  const auto n = scene::placed({.file = "command line"}, [&] { return ::fit::complete(a.known, a.viscosity); });
  Report out;
  out.say("diameter {:.5g} m, amplitude {:.5g} m, period {:.5g} s, largest speed {:.5g} m/s",
          fact("diameter", *n.diameter), fact("amplitude", *n.amplitude), fact("period_s", *n.period),
          fact("speed", *n.speed));
  out.say("KC {:.4g}, Re {:.4g}, beta {:.4g}", fact("kc", *n.kc), fact("re", *n.re), fact("beta", *n.beta));
  tell_leading_load(a.record.cd, *n.kc, a.record.inertia, "C_A", out);
  if (a.loads) {
    ::fit::Cylinder cylinder = a.record.cylinder;
    cylinder.diameter = *n.diameter;
    const auto loads = ::fit::load_sizes(cylinder, *n.speed, *n.period, a.record.cd, a.record.inertia);
    out.say("largest force {:.4g} N, of drag {:.4g} N and inertia {:.4g} N", fact("largest_force", loads.largest),
            fact("drag_force", loads.drag), fact("inertia_force", loads.inertia));
  }
  if (a.width) tell_lengths(a, n, out);
  tell(out, console);
}

void plan_tow(const TowPlanArguments& a, const Console& console) {
  if (a.diameter.has_value() + a.speed.has_value() + a.re.has_value() != 2)
    throw hydro::InputError("of diameter, speed and Re two are needed", {.file = "command line"},
                            "give two of --diameter, --speed and --re");
  hydro::require(!a.re || *a.re > 0, "--re must be positive, got {}", a.re.value_or(0));
  const double speed = a.speed ? *a.speed : *a.re * a.viscosity / *a.diameter,
               diameter = a.diameter ? *a.diameter : *a.re * a.viscosity / speed;
  const double steady = ::fit::steady_tow_s(a.length, speed, a.acceleration);
  hydro::require(steady > 0, "with {} m/s² the carriage does not reach {:.4g} m/s in {} m", a.acceleration, speed,
                 a.length);
  Report out;
  out.say("diameter {:.5g} m, speed {:.5g} m/s, Re {:.4g}", fact("diameter", diameter), fact("speed", speed),
          fact("re", speed * diameter / a.viscosity));
  out.say("at one speed for {:.4g} s, after {:.3g} s of acceleration: {:.4g} m, {:.4g} diameters",
          fact("steady_s", steady), fact("ramp_s", speed / a.acceleration), fact("steady_m", steady * speed),
          fact("diameters", steady * speed / diameter));
  if (a.loads) {
    const double force =
        a.record.cylinder.density / 2 * a.record.cd * diameter * a.record.cylinder.length * speed * speed;
    out.say("force {:.4g} N with C_D {:g}", fact("force", force), fact("expected_cd", a.record.cd));
  }
  if (a.strouhal) {
    const double frequency = ::fit::shedding_frequency_hz(*a.strouhal, speed, diameter);
    out.say("vortices leave it {:.4g} times a second, Strouhal number {:g}", fact("shedding_hz", frequency),
            fact("strouhal", *a.strouhal));
  }
  if (a.width) tell_times(a, diameter, speed, steady, out);
  tell(out, console);
}

void plan_waves(const WavePlanArguments& a, const Console& console) {
  require_picture(a.picture);
  const double omega = 2 * std::numbers::pi / a.period;
  const auto limits = hw::wave_limits(
      {.height_m = a.height, .length = hydro::AngularFrequency::from_period_s(a.period), .water = a.tank.water});
  const auto times = scene::placed({.file = "command line"}, [&] { return ::fit::wave_times(omega, a.tank); });
  const double k = hw::wavenumber(omega, a.tank.water), from = times.front + a.ramp + a.settle_periods * a.period;
  const hydro::WaterDepth& depth = a.tank.water.depth;
  Report out;
  out.say("wave: length {:.4g} m, steepness H/λ {:.4g}, {} water (kh {}), region {}",
          fact("wavelength", limits.wavelength), fact("steepness", limits.steepness),
          fact("depth_regime", std::string(hw::name(limits.depth_regime))),
          depth.is_infinite() ? std::string("infinite") : fmt::format("{:.4g}", k * depth.metres()),
          fact("region", std::string(hw::name(limits.region))));
  if (!depth.is_infinite()) out.keep("kh", k * depth.metres());
  out.say("highest wave of that length {:.4g} m, of which this is {:.3g}", fact("highest", limits.highest),
          fact("share_of_highest", a.height / limits.highest));
  std::vector<std::string> warnings = limits.warnings;
  tell_cylinder(a, omega, out);
  tell_slenderness(a, limits.wavelength, warnings, out);
  out.say("energy goes at {:.4g} m/s: the waves are at gauge and body after {:.4g} s, and steady from {:.4g} s on",
          fact("group_velocity", times.group_velocity), fact("front_s", times.front), fact("steady_from_s", from));
  if (std::isfinite(times.back_from_end)) {
    const double periods = (times.back_from_end - from) / a.period;
    out.say("they come back from the end after {:.4g} s, and from the wavemaker after {:.4g} s",
            fact("back_from_end_s", times.back_from_end), fact("back_from_maker_s", times.back_from_maker));
    out.say("{}", periods >= 1 ? fmt::format("{:.0f} whole periods are steady and without them", std::floor(periods))
                               : std::string("no period is steady and without them"));
    out.keep("steady_periods", std::max(0.0, std::floor(periods)));
  }
  if (a.picture) {
    if (!a.diameter)
      throw hydro::InputError("--picture draws the loads on a cylinder, and there is none", {.file = "command line"},
                              "give --diameter and --level");
    plot::write_picture(*a.picture, regimes(a, omega));
    out.say("wrote {}", fact("picture", a.picture->string()));
  }
  out.sentences("warnings", "caution: {}", warnings);
  tell(out, console);
}

}  // namespace froude
