/// \file  The tables of waves: every kind of sea, its directions, how it is cut into components, what is asked of it.
#include "scene/schema_waves.hpp"

#include "hydro/base/types.hpp"
#include "scene/spectra.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
using enum Group::Count;
using Variant = Table::Variant;

std::vector<Variant> spectrum_kinds() {
  std::vector<Variant> out;
  for (const SpectrumKind& kind : spectra()) out.push_back(kind.keys);
  return out;
}

std::vector<Key> joined(std::vector<Key> first, const std::vector<Key>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

const Table& spreading() {
  static const Table table{.title = "[waves.spreading]",
                           .meaning = "how the energy of each frequency is spread about the heading",
                           .keys = {text("kind", "of spreading")},
                           .chosen_by = "kind",
                           .variants = [] {
                             std::vector<Variant> out;
                             for (const SpreadingKind& kind : spreadings()) out.push_back(kind.keys);
                             return out;
                           }()};
  return table;
}

const Table& components() {
  static const Table table{
      .title = "[waves.components]",
      .meaning = "how a spectrum is cut into regular waves",
      .keys = {quantity("repetition", dim::time,
                        "components at the multiples of 2π over this; then the sea repeats; no run may be longer")
                   .positive()
                   .or_default("30 min", "the usual length of a wave record; a shorter run is its beginning"),
               integer("equal_energy", "that many components of the same energy; the sea does not repeat")
                   .within(Limit::at_least_one)
                   .optional(),
               integer("random",
                       "that many components, each at random within its own equal part of the band; the sea does "
                       "not repeat")
                   .within(Limit::at_least_one)
                   .optional(),
               quantity("lowest", dim::angular_velocity, "frequency at which the cut begins; in Hz it is 2π times less")
                   .positive()
                   .optional(),
               quantity("highest", dim::angular_velocity, "frequency at which it ends").positive().optional(),
               text("amplitudes",
                    "\"fixed\": every seed has the variance of the spectrum; \"rayleigh\": it scatters, "
                    "as in records of a Gaussian sea")
                   .one_of({"fixed", "rayleigh"})
                   .or_default("fixed", "runs of different seeds are then of the same severity")},
      .groups = {{at_most_one, {"repetition", "equal_energy", "random"}}}};
  return table;
}

const Table& crest() {
  static const Table table{
      .title = "[waves.crest]",
      .meaning = "a crest of given height at a place and time: the most probable wave that has it (NewWave)",
      .keys = {quantity("height", dim::length, "of the crest above still water").positive(),
               vector("position", dim::length, "where, as (x, y, 0)"), quantity("time", dim::time, "when"),
               text("around", "\"random sea\": put into the random sea; \"nothing\": alone")
                   .one_of({"random sea", "nothing"})
                   .or_default("random sea", "waves before and after it are then those of the sea")}};
  return table;
}

Key seed() {
  return integer("seed", "of the random phases; another number is another sea of the same spectrum")
      .within(Limit::not_negative)
      .or_default("1", "any fixed number, so that a scene gives the same sea twice");
}

/// What every random sea may have besides its spectrum.
std::vector<Key> of_random_seas() {
  return {seed(), inner_table("components", components()).or_default("", "see its keys"),
          inner_table("crest", crest()).optional(),
          effect("second_order",
                 "bound waves: sums and differences of frequencies (Sharma & Dean); for `froude waves` and members")
              .optional()};
}

const Table& part() {
  static const Table table{
      .title = "[[waves.part]]",
      .meaning = "one of several seas that run through each other, like wind sea and swell",
      .keys = {text("kind", "of sea"), quantity("heading", dim::angle, "where these waves go: from +x towards +y"),
               inner_table("spreading", spreading()).optional()},
      .chosen_by = "kind",
      .variants = spectrum_kinds()};
  return table;
}

const Table& focus() {
  static const Table table{
      .title = "[waves.focus]",
      .meaning = "where and when the packets meet",
      .keys = {vector("position", dim::length, "as (x, y, 0)"), quantity("time", dim::time, "when")}};
  return table;
}

const Table& wavemaker() {
  static const Table table{
      .title = "[waves.wavemaker]",
      .meaning = "the paddle at x = 0, and how it moves",
      .keys = {
          text("kind", "\"flap\": turns about a hinge; \"piston\": moves without turning").one_of({"flap", "piston"}),
          quantity("hinge", dim::length, "flap: height of the hinge, z up from still water; may lie below the bed")
              .optional(),
          text("file",
               "CSV beside the scene: columns time [s], evenly spaced, and displacement [m] of the paddle at still "
               "water"),
          quantity("lowest", dim::angular_velocity, "lowest frequency of the motion that is taken").positive(),
          quantity("highest", dim::angular_velocity, "highest frequency of the motion that is taken").positive(),
          effect("active_absorption",
                 "waves that come back to the paddle leave the tank; left out: they are reflected, as by a paddle "
                 "whose motion is prescribed")
              .optional()}};
  return table;
}

/// The kinds that are no random sea.
std::vector<Variant> other_kinds() {
  return {
      {"regular",
       "one wave after the other",
       {quantity("height", dim::length, "from trough to crest").positive().optional(),
        quantity("amplitude", dim::length, "half the height").positive().optional(),
        quantity("period", dim::time, "of the wave").positive(),
        text("theory", "\"linear\", \"stokes2\", \"stokes5\" or \"stream\" (stream function); a run takes linear waves")
            .one_of({"linear", "stokes2", "stokes5", "stream"})
            .or_default("linear", "what potential-flow coefficients belong to")},
       {{exactly_one, {"height", "amplitude"}}}},
      {"components",
       "regular waves from a list",
       {text("file",
             "CSV beside the scene: column period [s], frequency [Hz] or omega [rad/s]; amplitude [m] or height [m]; "
             "phase "
             "[rad]; perhaps heading [deg], which is added to the heading of the scene"),
        text("phase_of", "what a phase is added to: \"omega t - k x\" (ours) or \"k x - omega t\"")
            .one_of({"omega t - k x", "k x - omega t"})
            .or_default("omega t - k x", "the convention of every result"),
        effect("second_order",
               "bound waves: sums and differences of frequencies (Sharma & Dean); for `froude waves` and members")
            .optional()}},
      {"focused_packets",
       "groups 3.5 waves long that meet at one place and time; for `froude waves` and members",
       {text("file", "CSV beside the scene: column period [s] (or frequency, omega), column amplitude [m]"),
        inner_table("focus", focus())}},
      {"tank",
       "a wave tank: what a paddle makes; for `froude waves` and members",
       {quantity("length", dim::length, "from the paddle at x = 0 to the beach").positive(),
        number("reflection", "amplitude that the beach sends back, relative")
            .within(Limit::fraction)
            .or_default("0", "a beach that absorbs everything"),
        inner_table("wavemaker", wavemaker())}}};
}

std::vector<Variant> all_kinds() {
  std::vector<Variant> kinds = other_kinds();
  for (Variant& kind : spectrum_kinds()) {
    kind.keys.push_back(inner_table("spreading", spreading()).optional());
    kind.keys = joined(std::move(kind.keys), of_random_seas());
    kinds.push_back(std::move(kind));
  }
  kinds.push_back({"sum", "several random seas at once", joined({inner_tables("part", part())}, of_random_seas())});
  return kinds;
}

const Table& kinematics() {
  static const Table table{
      .title = "[waves.kinematics]",
      .meaning = "how the water moves between still water and the surface",
      .keys = {text("above_still_water",
                    "\"vertical\": as at still water; \"wheeler\": the whole column stretched; \"linear\": the tangent "
                    "at still "
                    "water; \"delta\": between the last two; \"none\": the exponential goes on")
                   .one_of({"vertical", "wheeler", "linear", "delta", "none"})
                   .or_default("vertical", "never exceeds what linear theory says at still water")}};
  return table;
}

}  // namespace

const Table& waves_table() {
  static const Table table{
      .title = "[waves]",
      .meaning = "the waves",
      .keys = {text("kind", "of sea"),
               quantity("heading", dim::angle, "where the waves go: from +x towards +y; 0 deg goes towards +x"),
               quantity("ramp", dim::time, "wave loads grow from nothing over this time, by half a cosine")
                   .within(Limit::not_negative)
                   .or_default("0 s", "loads act from the start unless the scene says otherwise"),
               inner_table("kinematics", kinematics()).or_default("", "see its keys")},
      .chosen_by = "kind",
      .variants = all_kinds()};
  return table;
}

const Table& current_table() {
  static const Table table{
      .title = "[current]",
      .meaning = "steady flow of the water; waves run on it",
      .keys =
          {vector("velocity", dim::velocity, "the same at every depth, as (x, y, 0)").optional(),
           text("file", "CSV beside the scene: columns z [m] (up, from the bed to 0), u [m/s] and v [m/s]").optional()},
      .groups = {{exactly_one, {"velocity", "file"}}}};
  return table;
}

const Table& ask_waves_table() {
  static const Table table{
      .title = "[ask.waves]",
      .meaning = "time series of the water at the probes, for `froude waves make`",
      .keys = {quantity("from", dim::time, "first sample").or_default("0 s", "the time that phases refer to"),
               quantity("duration", dim::time, "of the series, a whole multiple of `every`").positive(),
               quantity("every", dim::time, "between samples").positive()}};
  return table;
}

}  // namespace froude::scene
