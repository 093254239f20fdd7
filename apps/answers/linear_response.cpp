#include "answers/linear_response.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "answers/convergence.hpp"
#include "answers/provenance.hpp"
#include "answers/refined.hpp"
#include "answers/section_error.hpp"
#include "answers/size_left_out.hpp"
#include "answers/spacing.hpp"
#include "compile/members.hpp"
#include "compile/sections.hpp"
#include "compile/waves.hpp"
#include "dynamics/frequency/linear_drag.hpp"
#include "dynamics/frequency/sea_drag.hpp"
#include "hydro/base/error.hpp"
#include "hydro/waves/dispersion.hpp"
#include "hydro/waves/synthesis/synthesis.hpp"

namespace froude {
namespace {

constexpr const char* per_metre = " per metre of wave amplitude";

using dynamics::frequency::LinearDrag, dynamics::frequency::SignalAmplitudes, dynamics::frequency::SmallMotions;

/// All signals, which vary so.
std::vector<ComplexSignal> responses_of(const std::vector<compile::Signal>& signals,
                                        const std::vector<dynamics::Variation>& variations,
                                        const SignalAmplitudes& amplitudes) {
  std::vector<ComplexSignal> out;
  for (std::size_t i = 0; i < signals.size(); ++i)
    out.push_back(
        {signals[i].name, signals[i].unit + "/m", signals[i].meaning + per_metre, amplitudes.of(variations[i])});
  return out;
}

/// Transfer functions of all signals at the components of a sea, one row a signal.
Eigen::MatrixXcd transfer(const compile::Prepared& prepared, const SmallMotions& about,
                          const std::vector<compile::Signal>& signals, const hydro::waves::Sea& sea, int threads) {
  Eigen::MatrixXcd out(static_cast<Eigen::Index>(signals.size()), static_cast<Eigen::Index>(sea.components().size()));
  std::map<double, std::vector<std::size_t>> by_heading;
  for (std::size_t c = 0; c < sea.components().size(); ++c) by_heading[sea.components()[c].heading].push_back(c);
  for (const auto& [heading, components] : by_heading) {
    Cells at{{}, {heading}};
    for (const std::size_t c : components) at.omega.push_back(sea.components()[c].omega);
    const auto found = response_amplitudes(about, prepared.groups, at.omega, at.headings, {.threads = threads});
    const auto responses = linear_responses(signals, about, found, at);
    for (std::size_t s = 0; s < responses.size(); ++s)
      for (std::size_t k = 0; k < components.size(); ++k)
        out(static_cast<Eigen::Index>(s), static_cast<Eigen::Index>(components[k])) = responses[s].values[k];
  }
  return out;
}

void require_linear(const scene::Scene& scene, const compile::Prepared& prepared) {
  const auto effects = left_out_of_linear_responses(scene, prepared);
  if (!effects.empty())
    throw hydro::InputError(fmt::format("[ask.run] start = \"steady\" is for linear scenes: {}", effects.front()),
                            scene.run->place, "step it from \"as placed\" with a ramp, or leave the effect out");
}

void require_no_beginning(const scene::Scene& scene) {
  if (!scene.waves)
    throw hydro::InputError("[ask.run] start = \"steady\" needs waves: without them nothing moves", scene.run->place,
                            "add [waves]");
  if (scene.waves->ramp > 0)
    throw hydro::InputError("[ask.run] start = \"steady\" has no beginning for waves to grow from", scene.waves->place,
                            "leave `ramp` out of [waves]");
  for (const auto& body : scene.bodies)
    if (!body.initial.empty() || !body.initial_velocity.empty())
      throw hydro::InputError(
          fmt::format("body \"{}\" has a place to start from, which a steady motion has not", body.name),
          scene.run->place, "leave `initial` out, or step the run");
}

}  // namespace

double height_of(const scene::AskRao::DragIn& waves, double omega, const hydro::Water& water) {
  return waves.height ? *waves.height
                      : *waves.steepness * 2 * std::numbers::pi / hydro::waves::wavenumber(omega, water);
}

namespace {

/// What `notes` tell of linear drag.
std::string note_on(const std::vector<LinearDrag>& drags, const scene::AskRao::DragIn& waves) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const LinearDrag& drag : drags) {
    const Eigen::RowVectorXd all = drag.coefficient.colwise().sum();
    least = std::min(least, all.minCoeff());
    most = std::max(most, all.maxCoeff());
  }
  return fmt::format(
      "drag on members is linear, the equivalent linearisation of quadratic drag in waves of {}: {:.4g} to {:.4g} N "
      "s/m in all{}",
      waves.height ? fmt::format("{:.4g} m height", *waves.height) : fmt::format("steepness {:.4g}", *waves.steepness),
      least, most,
      drags.size() == 1 ? ""
                        : fmt::format("; it depends on the heading, so each of the {} was found by iteration with "
                                      "factors of its own",
                                      drags.size()));
}

/// Drag on members as [ask.rao.drag] asks, one a heading, told in `notes`; none if it does not.
std::vector<LinearDrag> drag_of_rao(const scene::Scene& scene, const compile::Prepared& prepared,
                                    const SmallMotions& about, const std::vector<double>& frequencies,
                                    std::vector<std::string>& notes) {
  if (!scene.rao->drag) return {};
  const scene::AskRao& ask = *scene.rao;
  const compile::DragAtRest at_rest = compile::drag_of_responses(scene, prepared.bodies);
  dynamics::frequency::DragWaves waves{.water = scene.water, .heading = 0, .amplitude = {}};
  for (const double omega : frequencies) waves.amplitude.push_back(height_of(*ask.drag, omega, scene.water) / 2);
  std::vector<LinearDrag> drags;
  for (const double heading : ask.headings) {
    waves.heading = heading;
    drags.push_back(dynamics::frequency::linearised_drag(about, prepared.groups, frequencies, at_rest.pieces, waves));
  }
  notes.push_back(note_on(drags, *ask.drag));
  return drags;
}

/// The drag of a sea, (D143), one a heading.
std::vector<LinearDrag> drag_of_sea(const Eigen::VectorXd& coefficient, const scene::Scene& scene,
                                    const compile::Prepared& prepared, const SmallMotions& about,
                                    const std::vector<double>& frequencies) {
  const auto pieces = compile::drag_of_responses(scene, prepared.bodies).pieces;
  std::vector<LinearDrag> drags;
  for (const double heading : scene.rao->headings)
    drags.push_back(dynamics::frequency::drag_with(coefficient, about, frequencies, pieces, scene.water, heading));
  return drags;
}

}  // namespace

std::vector<dynamics::Variation> variations_of(const std::vector<compile::Signal>& signals, const SmallMotions& about) {
  const dynamics::Still still(about.still, about.linear.multipliers);
  std::vector<dynamics::Variation> out;
  for (const auto& signal : signals) out.push_back(signal.variation(still));
  return out;
}

std::vector<ComplexSignal> linear_responses(const std::vector<compile::Signal>& signals, const SmallMotions& about,
                                            const dynamics::frequency::Amplitudes& found, const Cells& cells) {
  return responses_of(signals, variations_of(signals, about), {found, cells.omega, cells.headings});
}

std::vector<std::string> left_out_of_linear_responses(const scene::Scene& scene, const compile::Prepared& prepared,
                                                      bool with_drag) {
  std::vector<std::string> out;
  const auto one_member = [&](auto has) { return std::any_of(scene.members.begin(), scene.members.end(), has); };
  if (!with_drag && compile::any_drag(scene))
    out.emplace_back(
        "drag on members is left out: it has no response per metre of wave ([ask.rao.drag] makes it linear for waves "
        "of "
        "one height)");
  if (one_member([](const scene::Member& m) {
        return m.morison && m.morison->line.immersion == dynamics::Immersion::surface;
      }))
    out.emplace_back("members have Morison's loads on what is wet at rest, whatever waves wet beside it");
  if (one_member([](const scene::Member& m) { return m.slamming.has_value(); }))
    out.emplace_back("impacts on members are left out: a run has them where the members are");
  const auto one_joint = [&](auto has) { return std::any_of(scene.joints.begin(), scene.joints.end(), has); };
  if (one_joint([](const scene::Joint& j) { return j.friction || (j.pto && j.pto->latch); }))
    out.emplace_back("friction and latches are left out: their joints move freely in a linear response");
  if (one_joint([](const scene::Joint& j) { return j.prescribed.has_value(); }))
    out.emplace_back("prescribed motions of joints are left out: they are held where they are placed");
  if (std::any_of(scene.bodies.begin(), scene.bodies.end(),
                  [](const scene::Body& b) { return b.hydrodynamics && b.hydrodynamics->turning; }))
    out.emplace_back("excitation is that of bodies as placed: their slow yaw acts in runs only");
  if (std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const scene::Body& b) { return b.second_order; }))
    out.emplace_back(
        "wave loads of second order are left out: they go with the square of the waves, in runs and in `froude "
        "response`");
  if (!scene.contacts.empty()) out.emplace_back("contacts are left out: bodies are taken not to touch");
  for (const auto& elements : prepared.elements)
    if (const auto force = elements->force({prepared.bodies, prepared.water, prepared.joints});
        !force->linear_at_rest())
      out.push_back(
          fmt::format("[[{}]] is left out, {}: it is not linear about rest", elements->table(), force->method()));
  const auto on_body = [&](const std::vector<std::size_t>& network) {
    return std::any_of(network.begin(), network.end(), [&](std::size_t i) { return scene.lines[i].fastened(); });
  };
  const auto count = std::count_if(scene.networks.begin(), scene.networks.end(), on_body);
  if (count > 0) out.emplace_back("lines on bodies pull as they do at rest, with their static stiffness");
  if (count < std::ssize(scene.networks)) out.emplace_back("lines of nodes that are on no body are left out");
  return out;
}

namespace {

constexpr const char* hold_what_topples =
    "name what restores that motion, or hold it: `free` of the body names those that are left";

void require_two_frequencies(const scene::AskRao& ask) {
  if (ask.omega.size() < 2)
    throw hydro::InputError("frequencies are put between those of [ask.rao], which names one alone", ask.place,
                            "give a range, for example periods = \"3 s .. 25 s, 45 values\"");
}

}  // namespace

namespace {

template <class S>
std::vector<std::string> names_of_signals(const std::vector<S>& signals) {
  std::vector<std::string> out;
  for (const S& s : signals) out.push_back(s.name);
  return out;
}

/// Of each signal, over its peak.
std::vector<double> largest_changes(const std::vector<ComplexSignal>& signals, const SignalValues& others) {
  std::vector<double> out = peaks_of(signals);
  for (std::size_t i = 0; i < signals.size(); ++i) {
    const auto other = others(i);
    double largest = 0;
    for (std::size_t c = 0; c < other.size(); ++c)
      largest = std::max(largest, std::abs(other[c] - signals[i].values[c]));
    out[i] = out[i] > 0 ? largest / out[i] : 0;
  }
  return out;
}

/// Those of which a load is among the signals.
std::vector<SectionAtRest> chosen_sections(std::vector<SectionAtRest> all, const std::vector<std::string>& signals) {
  std::erase_if(all, [&](const SectionAtRest& section) {
    return std::none_of(signals.begin(), signals.end(),
                        [&](const std::string& name) { return name.starts_with(section.name + "."); });
  });
  return all;
}

}  // namespace

Responses respond(const scene::Scene& scene) { return respond(scene, compile::prepare(scene)); }

Responses respond(const scene::Scene& scene, const compile::Prepared& prepared, const HowToRespond& how) {
  if (!scene.rao || scene.rao->headings.empty())
    throw std::logic_error("a response is asked for without a heading: a scene that no reader has made must state one");
  Responses out{scene.rao->omega, scene.rao->headings, {}, prepared.notes, {}, provenance_of(scene)};
  compile::check_waves_of_rao(scene, prepared, out.notes);
  const dynamics::Model model = compile::frequency_model(prepared, scene.rao->about);
  const SmallMotions about = compile::small_motions(scene, model, scene.rao->about, out.notes);
  compile::require_stable(about, scene.rao->place, hold_what_topples);
  for (const std::string& effect : left_out_of_linear_responses(scene, prepared, scene.rao->drag || how.drag_of_sea))
    out.notes.push_back(effect);
  const auto signals = compile::chosen_responses(compile::signal_list(scene, prepared, model), scene.rao->of,
                                                 scene.rao->of_places, out.notes);
  SizeLeftOut size(scene, prepared, about, scene.rao->drag || how.drag_of_sea);
  // The lines that compute a RAO: (Q1) in libdynamics/src/frequency/equations.cpp.
  const auto answer = [&](const compile::Prepared& from, const std::vector<double>& omega,
                          std::vector<std::string>& notes) -> SignalAmplitudes {
    const Cells cells{omega, scene.rao->headings};
    const dynamics::frequency::RaoOptions options{
        how.threads, how.drag_of_sea ? drag_of_sea(*how.drag_of_sea, scene, from, about, omega)
                                     : drag_of_rao(scene, from, about, omega, notes)};
    const auto found = response_amplitudes(about, from.groups, cells.omega, cells.headings, options);
    if (&from == &prepared) size.take(cells, found);
    return {found, cells.omega, cells.headings};
  };
  const std::vector<dynamics::Variation> variations = variations_of(signals, about);
  std::vector<std::string> told_already;
  std::optional<Refined> between;
  if (how.refine) {
    require_two_frequencies(*scene.rao);
    const auto more = [&](const std::vector<double>& omega) {
      return responses_of(signals, variations, answer(prepared, omega, told_already));
    };
    between = refined(out.omega, out.heading.size(), scene.accuracy, more);
    if (!told_already.empty()) out.notes.push_back(told_already.front());  // of drag, at the frequencies asked for
    out.omega = between->omega;
    out.signals = std::move(between->signals);
  } else {
    out.signals = responses_of(signals, variations, answer(prepared, out.omega, out.notes));
  }
  for (const std::string& told : size.told()) out.notes.push_back(told);
  const LinearAnswer values_from = [&](const compile::Prepared& other) -> SignalValues {
    auto found = answer(other, out.omega, told_already);
    // Sectional loads have tables of their own, which other coefficients change too.
    if (prepared.sections.empty())
      return [&variations, found = std::move(found)](std::size_t i) { return found.of(variations[i]); };
    std::vector<std::string> told_of_signals;
    const auto its_own = variations_of(compile::chosen_responses(compile::signal_list(scene, other, model),
                                                                 scene.rao->of, scene.rao->of_places, told_of_signals),
                                       about);
    return [its_own, found = std::move(found)](std::size_t i) { return found.of(its_own[i]); };
  };
  out.error = error_of_spacing(scene, prepared, out.omega, out.signals, values_from);
  if (how.judge_sections)
    add_error_of_sections(
        scene, prepared, names_of_signals(out.signals),
        [&](const compile::Prepared& other) { return largest_changes(out.signals, values_from(other)); }, out.error);
  out.sections = chosen_sections(compile::sections_at_rest(scene, prepared, about), names_of_signals(out.signals));
  if (between)
    out.error.sources.push_back({.name = "frequencies",
                                 .how = "straight lines between them, by the bend in the middle of each interval",
                                 .of_signal = std::move(between->error)});
  return out;
}

namespace {

/// Half the real part of what velocities and the loads that they meet make: dampers, and stiffness that is not
/// symmetric.
double power_of_loads(const SmallMotions& about, const Eigen::VectorXcd& xi, double omega) {
  const Eigen::VectorXcd v = std::complex<double>(0, omega) * xi;
  return v.dot(about.linear.stiffness * xi + about.linear.damping * v).real() / 2;
}

bool is_balanced_by_dampers(const scene::Scene& scene, const compile::Prepared& prepared) {
  return scene.members.empty() &&
         std::all_of(prepared.groups.begin(), prepared.groups.end(), [](const auto& group) { return group.radiation; });
}

}  // namespace

MotionInWave motions_in_wave(const scene::Scene& scene, const compile::Prepared& prepared, double omega, double heading,
                             const scene::Place& place, std::vector<std::string>& notes) {
  scene::Scene one = scene;
  if (!one.rao) one.rao.emplace();
  one.rao->omega = {omega};
  one.rao->headings = {heading};
  one.rao->headings_place = one.rao->place = place;
  compile::check_waves_of_rao(one, prepared, notes);
  const dynamics::Model model = compile::frequency_model(prepared, one.rao->about);
  const SmallMotions about = compile::small_motions(one, model, one.rao->about, notes);
  compile::require_stable(about, place, hold_what_topples);
  for (const std::string& effect : left_out_of_linear_responses(one, prepared, one.rao->drag.has_value()))
    notes.push_back(effect);
  const dynamics::frequency::RaoOptions options{.threads = 1,
                                                .drag = drag_of_rao(one, prepared, about, one.rao->omega, notes)};
  MotionInWave out{
      response_amplitudes(about, prepared.groups, one.rao->omega, one.rao->headings, options).xi.front().col(0), {}};
  if (is_balanced_by_dampers(scene, prepared)) out.damped = power_of_loads(about, out.xi, omega);
  return out;
}

Responses over_wave_slope(Responses responses, const hydro::Water& water) {
  std::vector<double> k;
  for (const double omega : responses.omega) k.push_back(hydro::waves::wavenumber(omega, water));
  for (ComplexSignal& s : responses.signals) {
    if (s.units != "rad/m" && s.units != "m/m") continue;
    const bool turns = s.units == "rad/m";
    for (std::size_t i = 0; turns && i < s.values.size(); ++i) s.values[i] /= k[i % k.size()];
    s.long_name.resize(s.long_name.find(per_metre));
    s.long_name += turns ? " over the slope of the wave" : " over the amplitude of the wave";
    s.units = "1";
  }
  return responses;
}

Run steady_run(const scene::Scene& scene, const std::shared_ptr<compile::Kept>& kept, int threads) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  require_no_beginning(scene);
  const compile::Prepared prepared = compile::prepare(scene, kept);
  require_linear(scene, prepared);
  const dynamics::Model model = compile::frequency_model(prepared);
  Run record;
  record.notes = prepared.notes;
  const SmallMotions about = compile::small_motions(scene, model, {}, record.notes);
  compile::require_stable(about, scene.run->place, hold_what_topples);
  record.provenance = provenance_of(scene);
  const hydro::waves::Sea sea = compile::sea_of_run(scene, prepared, record.notes);
  const auto signals = compile::chosen_responses(compile::signal_list(scene, prepared, model), scene.run->of,
                                                 scene.run->of_places, record.notes);
  const auto answer = [&](const compile::Prepared& from) {
    std::vector<std::string> told_already;
    const auto its_own = compile::chosen_responses(compile::signal_list(scene, from, model), scene.run->of,
                                                   scene.run->of_places, told_already);
    Eigen::MatrixXcd out = transfer(from, about, its_own, sea, threads);
    for (Eigen::Index c = 0; c < out.cols(); ++c)
      out.col(c) *= compile::elevation_at_origin(sea.components()[static_cast<std::size_t>(c)]);
    return out;
  };
  const Eigen::MatrixXcd amplitudes = answer(prepared);
  record.error = error_of_spacing(scene, prepared, signals, amplitudes, answer);
  const Eigen::VectorXd size = amplitudes.rowwise().norm();
  const auto scale = at_least_a_thousandth({size.begin(), size.end()}, signals, &compile::Signal::unit);
  add_error_of_sections(
      scene, prepared, names_of_signals(signals),
      [&](const compile::Prepared& other) {
        const Eigen::VectorXd off = (answer(other) - amplitudes).rowwise().norm();
        std::vector<double> out(off.begin(), off.end());
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = scale[i] > 0 ? out[i] / scale[i] : 0;
        return out;
      },
      record.error);
  const auto samples = static_cast<std::size_t>(std::llround(scene.run->duration / scene.run->every)) + 1;
  const auto series = hydro::waves::synthesise(sea, {scene.run->every, samples}, amplitudes).series;
  for (std::size_t i = 0; i < samples; ++i) record.time.push_back(static_cast<double>(i) * scene.run->every);
  for (std::size_t s = 0; s < signals.size(); ++s) {
    const auto values = series.col(static_cast<Eigen::Index>(s));
    record.signals.push_back({signals[s].name, signals[s].unit, signals[s].meaning, {values.begin(), values.end()}});
  }
  record.notes.push_back(fmt::format("answered without stepping: {} transfer functions at the {} components of the sea",
                                     signals.size(), sea.components().size()));
  record.step = scene.run->every;
  record.preparation_s = std::chrono::duration<double>(Clock::now() - begin).count();
  return record;
}

}  // namespace froude
