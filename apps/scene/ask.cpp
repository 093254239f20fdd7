/// \file  [ask]: what is wanted of a scene.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "scene/binding.hpp"
#include "scene/build.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

Key asked_signals() {
  return texts("of", "signals to give, like \"m*.surge\" or \"connector*.force\"; * stands for any characters")
      .or_default("*", "everything there is");
}
/// Of an answer that names none everything is given: its list stays empty.
template <class A>
void put_signals(const Value& of, A& asked) {
  if (of.defaulted) return;
  for (const auto& pattern : of.texts) {
    asked.of.push_back(pattern.value);
    asked.of_places.push_back(pattern.place);
  }
}

/// `duration` of a series must be a whole multiple of `every`, and not so many times that no memory holds it.
template <class A>
void check_whole(const Record& record, const A& asked) {
  const double steps = asked.duration / asked.every, whole = std::round(steps);
  constexpr double most = 1e8;  // samples of one signal are then 0.8 GB; a day at 100 a second is a tenth of it
  if (steps > most)
    throw record.wrong(
        "every", fmt::format("makes {:.3g} samples of {}; {:g} are the limit", steps, record["duration"].shown, most),
        fmt::format("write every = \"{:.3g} s\" at least", asked.duration / most));
  if (whole < 1 || std::abs(steps - whole) > 1e-9 * steps)  // far above the round-off of the two, far below a sample
    throw record.wrong(
        "duration", fmt::format("is {:.10g} times every = {}; a whole number is needed", steps, record["every"].shown),
        fmt::format("write duration = \"{:.10g} s\"", std::max(1.0, std::ceil(steps)) * asked.every));
}

Binding<About> small_motions() {
  return Binding<About>("", "")
      .words(text("about",
                  "\"as placed\", where everything must be in balance; or \"equilibrium\": where the bodies balance in "
                  "still water, coefficients being those of the bodies as placed")
                 .or_default("as placed", "coefficients of a body hold where it was when they were computed"),
             {{"as placed", false}, {"equilibrium", true}}, &About::equilibrium)
      .place(&About::place);
}

Binding<AskRao::DragIn> rao_drag() {
  return Binding<AskRao::DragIn>("[ask.rao.drag]",
                                 "drag of members at each frequency, linear, losing as much energy as it does in "
                                 "waves this high; left out: without drag")
      .optional(positive("height", dim::length, "of the waves, at every frequency"), &AskRao::DragIn::height)
      .optional(number("steepness", "height over length of the waves, at every frequency").positive(),
                &AskRao::DragIn::steepness)
      .exactly_one_of({"height", "steepness"})
      .place(&AskRao::DragIn::place);
}

/// Frequencies of periods, which increase where those fall.
void put_periods(const Value& periods, AskRao& rao) {
  std::transform(periods.range.rbegin(), periods.range.rend(), std::back_inserter(rao.omega),
                 [](double period) { return 2 * std::numbers::pi / period; });
}

void put_headings(const Value& given, AskRao& rao) {
  rao.headings = given.range.empty() ? std::vector{given.number} : given.range;
  rao.headings_place = given.place;
}

Binding<AskRao> rao() {
  return Binding<AskRao>("[ask.rao]", "response per metre of wave amplitude")
      .optional(range("periods", dim::time, "wave periods").positive(), put_periods)
      .optional(range("omega", dim::angular_velocity, "wave frequencies").positive(), &AskRao::omega)
      .optional(quantity("heading", dim::angle, "where the waves go; left out: the heading of [waves]"), put_headings)
      .optional(
          values("headings", dim::angle,
                 "where the waves go, several at once: \"0 deg .. 180 deg, 13 values\" or [\"0 deg\", \"30 deg\"]; "
                 "results gain a dimension"),
          put_headings)
      .table("drag", rao_drag(), &AskRao::drag)
      .part(small_motions(), &AskRao::about)
      .key(asked_signals(), put_signals<AskRao>)
      .exactly_one_of({"periods", "omega"})
      .at_most_one_of({"heading", "headings"})
      .place(&AskRao::place);
}

Binding<AskRun> run() {
  return Binding<AskRun>("[ask.run]", "time series")
      .key(positive("duration", dim::time, "of the run, a whole multiple of `every`"), &AskRun::duration)
      .key(positive("every", dim::time, "between stored samples"), &AskRun::every)
      .key(text("start",
                "\"as placed\"; in \"equilibrium\": where the bodies balance without waves; or \"steady\", for linear "
                "scenes: as if the sea had always been there, answered by transfer functions without a step")
               .one_of({"as placed", "equilibrium", "steady"})
               .or_default("as placed", "where the scene puts them is where they begin"),
           [](const Value& start, AskRun& run) {
             run.from_equilibrium = start.text == "equilibrium";
             run.steady = start.text == "steady";
           })
      .optional(positive("checkpoint", dim::time,
                         "of the run, from one state that is kept on disk to the next: who ends `froude run` begins "
                         "again from the last; left out: nothing is kept"),
                &AskRun::checkpoint)
      .key(asked_signals(), put_signals<AskRun>)
      .place(&AskRun::place)
      .then([](const Record& record, AskRun& asked) {
        check_whole(record, asked);
        if (asked.steady && asked.checkpoint)
          throw record.wrong("checkpoint", "has no meaning with start = \"steady\", which takes no steps",
                             "leave it out");
      });
}

Binding<AskModes> free_motions() {
  return Binding<AskModes>("[ask.modes]", "free motions about rest: periods, damping, shapes")
      .optional(positive("shortest", dim::time, "no mode of a shorter period"), &AskModes::shortest)
      .optional(positive("longest", dim::time, "no mode of a longer period"), &AskModes::longest)
      .part(small_motions(), &AskModes::about)
      .then([](const Record& record, AskModes& asked) {
        if (!(asked.shortest < asked.longest))
          throw record.wrong("longest", "must be longer than the shortest period",
                             "exchange the two, or leave one out");
      });
}

Binding<AskStability::Branch> branch() {
  using Branch = AskStability::Branch;
  return Binding<Branch>("[[ask.stability.branch]]",
                         "periodic motions that go over into each other, also where they turn back")
      .optional(positive("height", dim::length, "of the waves; followed over the periods"), &Branch::height)
      .optional(positive("period", dim::time, "of the waves; followed over the heights"), &Branch::period)
      .exactly_one_of({"height", "period"})
      .place(&Branch::place);
}

/// A branch goes from one end of the map to the other.
void check_branches(const AskStability& asked) {
  for (const AskStability::Branch& b : asked.branches)
    if ((b.height ? asked.periods : asked.heights).size() < 2)
      throw hydro::InputError(fmt::format("a branch over the {0} of the map, which has one {1}",
                                          b.height ? "periods" : "heights", b.height ? "period" : "height"),
                              b.place, "ask for more of them");
}

Binding<AskStability> stability() {
  return Binding<AskStability>("[ask.stability]",
                               "whether periodic motions in regular waves last, over periods and heights of the waves")
      .key(range("periods", dim::time, "wave periods").positive(), &AskStability::periods)
      .key(range("heights", dim::length, "wave heights").positive(), &AskStability::heights)
      .tables("branch", branch(), &AskStability::branches)
      .optional()
      .part(small_motions(), &AskStability::about)
      .key(asked_signals(), put_signals<AskStability>)
      .place(&AskStability::place)
      .then([](const Record&, AskStability& asked) { check_branches(asked); });
}

/// Two at least and rising, as a grid needs them.
void check_grid(const Record& record, AskField& asked) {
  for (const auto& [key, along] : {std::pair("x", &asked.x), std::pair("y", &asked.y)})
    if (along->size() < 2)
      throw record.wrong(key, "has one value; a grid needs two at least",
                         "write for example \"-30 m .. 30 m, 61 values\"");
  constexpr double most = 4e6;  // points: the result is then 0.3 GB
  if (static_cast<double>(asked.x.size()) * static_cast<double>(asked.y.size()) > most)
    throw record.wrong(
        "x", fmt::format("and y make {} times {} points; {:g} are the limit", asked.x.size(), asked.y.size(), most),
        "ask for fewer values");
}

Binding<AskField> field() {
  return Binding<AskField>("[ask.field]",
                           "the free surface about bodies of cylinders or meshes in one regular wave, on a grid, per "
                           "metre of wave amplitude")
      .optional(positive("period", dim::time, "of the wave"),
                [](const Value& period, AskField& asked) { asked.omega = 2 * std::numbers::pi / period.number; })
      .optional(positive("omega", dim::angular_velocity, "frequency of the wave"), &AskField::omega)
      .exactly_one_of({"period", "omega"})
      .key(quantity("heading", dim::angle, "where the wave goes").or_default("0 deg", "along x"), &AskField::heading)
      .key(range("x", dim::length, "of the grid, global"), &AskField::x)
      .key(range("y", dim::length, "of the grid, global"), &AskField::y)
      .key(text("bodies", "\"free\", moving as they respond; or \"held\" still")
               .one_of({"free", "held"})
               .or_default("free", "what a float does to waves is most of it its motion"),
           [](const Value& bodies, AskField& asked) { asked.held = bodies.text == "held"; })
      .optional(number("accepted_error",
                       "of the elevation over its largest, that is taken where the [ask] accuracy is missed, as it is "
                       "within a panel of a hull; left out: none is")
                    .within(Limit::open_fraction),
                &AskField::accepted_error)
      .optional(effect("pressure",
                       "the pressure of the water on hulls, at the centres of their panels, for bodies of meshes whose "
                       "panels are solved together"),
                [](const Value& pressure, AskField& asked) {
                  asked.pressure = true;
                  asked.pressure_place = pressure.place;
                })
      .optional(number("accepted_pressure_error",
                       "of the pressure over its largest, that is taken where the [ask] accuracy is missed; left out: "
                       "none is")
                    .within(Limit::open_fraction)
                    .only_beside("pressure"),
                &AskField::accepted_pressure_error)
      .optional(effect("body_drift",
                       "mean drift of each body by itself: force along the water and moment about the vertical through "
                       "its origin, to second order"),
                [](const Value&, AskField& asked) { asked.body_drift = true; })
      .optional(number("accepted_drift_error",
                       "of the mean drift, of all bodies and of each, over the largest, that is taken where the [ask] "
                       "accuracy is missed; left out: none is")
                    .within(Limit::positive),
                &AskField::accepted_drift_error)
      .place(&AskField::place)
      .then(check_grid);
}

Binding<AskWaves> waves() {
  return Binding<AskWaves>("[ask.waves]", "time series of the water at the probes, for `froude waves make`")
      .key(quantity("from", dim::time, "first sample").or_default("0 s", "the time that phases refer to"),
           &AskWaves::from)
      .key(positive("duration", dim::time, "of the series, a whole multiple of `every`"), &AskWaves::duration)
      .key(positive("every", dim::time, "between samples"), &AskWaves::every)
      .place(&AskWaves::place)
      .then(check_whole<AskWaves>);
}

/// Motions need something that moves.
void check_bodies(const Record& ask, const Scene& scene) {
  if (!scene.bodies.empty()) return;
  for (const char* what : {"rao", "stability", "field", "run"}) {
    if (!ask.has(what) || (what == std::string_view("run") && !scene.lines.empty())) continue;
    throw ask.table(what).refused("asks for motion, but the scene has no body", "add a [[body]]");
  }
}

/// The heading that an RAO takes over from [waves] is echoed like any other value that was filled in.
void take_heading(const Record& record, Scene& scene) {
  if (!scene.waves)
    throw record.refused("needs a heading, as there is no [waves] to take it from",
                         "add heading = \"0 deg\" to [ask.rao]");
  scene.rao->headings = {scene.waves->heading.radians()};
  scene.rao->headings_place = scene.waves->place;
  const auto echo_of = [&](std::string_view key) {
    return std::find_if(scene.echo.begin(), scene.echo.end(), [&](const Echo& e) { return e.key == key; });
  };
  const std::string value = echo_of("waves.heading")->value;
  scene.echo.insert(echo_of("ask.rao.of"), {"ask.rao.heading", value, true});
}

/// What the scene must have beside the question.
void check_scene(const Record& ask, Scene& scene) {
  constexpr double digits = 1e-9;  // runs are stepped in double precision, and differ by their rounding
  if (scene.accuracy < digits)
    throw ask.wrong("accuracy", "is finer than runs in double precision can be compared", "ask for 1e-9 or more");
  if (scene.rao && scene.rao->drag && std::none_of(scene.members.begin(), scene.members.end(), has_drag))
    throw ask.table("rao").table("drag").refused("makes drag linear, but no member names drag",
                                                 "leave it out, or add a [[member]] with drag");
  if (scene.rao && scene.rao->headings.empty()) take_heading(ask.table("rao"), scene);
  if (scene.stability && (!scene.waves || !std::holds_alternative<RegularWave>(scene.waves->kind)))
    throw ask.table("stability")
        .refused("is of regular waves, and the scene has none",
                 "add [waves] with kind = \"regular\": its heading is taken");
  if (!scene.ask_waves) return;
  if (!scene.waves) throw ask.table("waves").refused("asks for waves, but there are none", "add a [waves] table");
  if (scene.probes.empty())
    throw ask.table("waves").refused("needs a point at which the water is told",
                                     "add a [[probe]] with at = \"(0, 0, 0) m\"");
}

}  // namespace

const Binding<Scene>& ask_binding() {
  static const auto table = Binding<Scene>("[ask]", "what is wanted")
                                .then(check_bodies)
                                .table("rao", rao(), &Scene::rao)
                                .table("modes", free_motions(), &Scene::ask_modes)
                                .table("stability", stability(), &Scene::stability)
                                .table("field", field(), &Scene::field)
                                .table("run", run(), &Scene::run)
                                .table("waves", waves(), &Scene::ask_waves)
                                .key(number("accuracy",
                                            "the largest error of each signal that a run is asked for, of its rms, its "
                                            "standard deviation and its extremes; a run that misses it is refused")
                                         .within(Limit::open_fraction)
                                         .or_default("1e-2", "about what coefficients and measurements are good for"),
                                     &Scene::accuracy)
                                .key(effect("uncompressed",
                                            "numbers stand in the result file as they are, which is written sooner and "
                                            "is larger; left out: they are packed, without loss"),
                                     &Scene::uncompressed)
                                .at_least_one_of({"rao", "modes", "stability", "field", "run", "waves"})
                                .then(check_scene);
  return table;
}

}  // namespace froude::scene
