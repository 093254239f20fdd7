/// \file  [waves] and [current]: every kind of sea, its directions and how it is cut into components. What is wrong
/// with
///        a spectrum or spreading is told at the line that holds it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "hydro/io/csv.hpp"
#include "hydro/signal/welch.hpp"
#include "hydro/waves/dispersion.hpp"
#include "hydro/waves/kinematics/current.hpp"
#include "hydro/waves/kinematics/tank.hpp"
#include "scene/binding.hpp"
#include "scene/build.hpp"
#include "scene/placed.hpp"
#include "scene/spectra.hpp"

namespace froude::scene {
namespace {

using hydro::Angle;
using hydro::AngularFrequency;
using hydro::InputError;
using hydro::io::CsvTable;
namespace dim = hydro::dim;
namespace hw = hydro::waves;
using enum Group::Count;

// Random seas

/// The kinds of spectra or spreadings as variants of a table.
template <class Kind>
std::vector<Table::Variant> variants_of(const std::vector<Kind>& kinds) {
  std::vector<Table::Variant> out;
  for (const Kind& kind : kinds) out.push_back(kind.keys);
  return out;
}

const Table& spreading() {
  static const Table table{.title = "[waves.spreading]",
                           .meaning = "how the energy of each frequency is spread about the heading",
                           .keys = {text("kind", "of spreading")},
                           .chosen_by = "kind",
                           .variants = variants_of(spreadings())};
  return table;
}

const Table& part() {
  static const Table table{
      .title = "[[waves.part]]",
      .meaning = "one of several seas that run through each other, like wind sea and swell",
      .keys = {text("kind", "of sea"), quantity("heading", dim::angle, "where these waves go: from +x towards +y"),
               inner_table("spreading", spreading()).optional()},
      .chosen_by = "kind",
      .variants = variants_of(spectra())};
  return table;
}

WaveSystem read_system(const Record& sea, Angle heading, const Scene& scene) {
  WaveSystem out{.kind = sea.text("kind"), .spectrum = {}, .spreading = {}, .heading = heading};
  out.spectrum = placed(sea["kind"].place, [&] { return spectrum_kind(out.kind).build(sea, scene); });
  if (sea.has("spreading")) {
    const Record& record = sea.table("spreading");
    out.spreading =
        placed(record["kind"].place, [&] { return spreading_kind(record.text("kind")).build(record, *out.spectrum); });
  }
  return out;
}

/// One sea, or those of a sum.
std::vector<WaveSystem> read_systems(const Record& waves, Angle heading, const Scene& scene) {
  if (waves.text("kind") != "sum") return {read_system(waves, heading, scene)};
  std::vector<WaveSystem> out;
  for (const Record& one : waves.tables("part"))
    out.push_back(read_system(one, Angle::from_radians(one.si("heading")), scene));
  if (out.empty()) throw waves.refused("has no part", "add [[waves.part]]");
  return out;
}

Binding<RandomSea> components() {
  return Binding<RandomSea>("[waves.components]", "how a spectrum is cut into regular waves")
      .key(positive("repetition", dim::time,
                    "components at the multiples of 2π over this; then the sea repeats; no run may be longer")
               .or_default("30 min", "the usual length of a wave record; a shorter run is its beginning"),
           [](const Value& v, RandomSea& sea) { sea.bins = hw::FftGrid{v.number}; })
      .optional(integer("equal_energy", "that many components of the same energy; the sea does not repeat")
                    .within(Limit::at_least_one),
                [](const Value& v, RandomSea& sea) { sea.bins = hw::EqualEnergy{static_cast<std::size_t>(v.integer)}; })
      .optional(
          integer("random",
                  "that many components, each at random within its own equal part of the band; the sea does not repeat")
              .within(Limit::at_least_one),
          [](const Value& v, RandomSea& sea) { sea.bins = hw::RandomInBin{static_cast<std::size_t>(v.integer)}; })
      .optional(
          positive("lowest", dim::angular_velocity, "frequency at which the cut begins; in Hz it is 2π times less"),
          &RandomSea::lowest)
      .optional(positive("highest", dim::angular_velocity, "frequency at which it ends"), &RandomSea::highest)
      .words(text("amplitudes",
                  "\"fixed\": every seed has the variance of the spectrum; \"rayleigh\": it scatters, as in records of "
                  "a Gaussian sea")
                 .or_default("fixed", "runs of different seeds are then of the same severity"),
             {{"fixed", hw::Amplitudes::fixed}, {"rayleigh", hw::Amplitudes::rayleigh}}, &RandomSea::amplitudes)
      .at_most_one_of({"repetition", "equal_energy", "random"})
      .place(&RandomSea::bins_place);
}

void read_position(const Record& record, hw::Focus& focus) {
  const Eigen::Vector3d position = record.vector("position");
  if (position.z() != 0) throw record.wrong("position", "lies above or below still water", "write (x, y, 0)");
  focus.x_m = position.x();
  focus.y_m = position.y();
}

/// A place and time; `where` is what the place is for.
Binding<hw::Focus> place_and_time(const std::string& title, const std::string& meaning, const std::string& where) {
  return Binding<hw::Focus>(title, meaning)
      .key(vector("position", dim::length, where))
      .key(quantity("time", dim::time, "when"), &hw::Focus::t_s)
      .then(read_position);
}

Binding<Crest> crest() {
  return Binding<Crest>("[waves.crest]",
                        "a crest of given height at a place and time: the most probable wave that has it (NewWave)")
      .key(positive("height", dim::length, "of the crest above still water, bound waves included where there are some"),
           &Crest::height)
      .part(place_and_time("", "", "where, as (x, y, 0)"), &Crest::focus)
      .words(text("around", "\"random sea\": put into the random sea; \"nothing\": alone")
                 .or_default("random sea", "waves before and after it are then those of the sea"),
             {{"random sea", false}, {"nothing", true}}, &Crest::alone);
}

Key second_order() {
  return effect("second_order",
                "bound waves: sums and differences of frequencies (Sharma & Dean); for `froude waves` and members");
}

/// A random sea: its own keys, and what every one may have beside them. What systems it has is read where water is
/// known.
Binding<RandomSea> random_sea(Table own) {
  return Binding<RandomSea>(std::move(own))
      .key(integer("seed", "of the random phases; another number is another sea of the same spectrum")
               .within(Limit::not_negative)
               .or_default("1", "any fixed number, so that a scene gives the same sea twice"),
           &RandomSea::seed)
      .table("components", components())
      .or_default()
      .table("crest", crest(), &RandomSea::crest)
      .key(second_order(), &RandomSea::second_order);
}

// Other seas

Binding<RegularWave> height_and_period() {
  return Binding<RegularWave>("", "")
      .optional(positive("height", dim::length, "from trough to crest"),
                [](const Value& v, RegularWave& wave) { wave.amplitude = v.number / 2; })
      .optional(positive("amplitude", dim::length, "half the height"), &RegularWave::amplitude)
      .key(positive("period", dim::time, "of the wave"), &RegularWave::period)
      .exactly_one_of({"height", "amplitude"});
}

Binding<RegularWave> regular() {
  return Binding<RegularWave>("", "one wave after the other")
      .part(height_and_period())
      .words(text("theory",
                  "\"linear\", \"stokes2\", \"stokes5\" or \"stream\" (stream function); a run takes linear waves")
                 .or_default("linear", "what potential-flow coefficients belong to"),
             {{"linear", RegularTheory::linear},
              {"stokes2", RegularTheory::stokes_second},
              {"stokes5", RegularTheory::stokes_fifth},
              {"stream", RegularTheory::stream_function}},
             &RegularWave::theory)
      .optional(quantity("phase", dim::angle,
                         "of a linear wave, added to omega t - k x: the surface at the origin is amplitude times the "
                         "cosine of it at t = 0; left out: 0, a crest"),
                &RegularWave::phase)
      .then([](const Record& waves, RegularWave& wave) {
        if (wave.theory != RegularTheory::linear && waves.has("phase"))
          throw waves.wrong("phase", "belongs to linear waves",
                            "leave it out: a crest of this theory is at the origin at t = 0");
      });
}

Binding<WaveTrains::Train> train() {
  using Train = WaveTrains::Train;
  return Binding<Train>("[[waves.train]]", "a train of regular waves, in the order in which they come")
      .part(height_and_period(), &Train::wave)
      .optional(quantity("phase", dim::angle, "added to omega t; left out: 0, a crest at t = 0 where trains are given"),
                [](const Value& v, Train& out) { out.wave.phase = v.number; })
      .optional(quantity("heading", dim::angle, "where this train goes; left out: where [waves] goes"),
                [](const Value& v, Train& out) { out.heading = Angle::from_radians(v.number); })
      .optional(positive("from", dim::time, "when it begins to come; left out: the first, which has always been there"),
                &Train::from)
      .optional(positive("fade", dim::time,
                         "over which it comes and the one before goes, each by half a cosine; one is the rest of the "
                         "other"),
                &Train::fade)
      .place(&Train::place);
}

/// Each comes when the one before it is there.
void check_trains(const Record& waves, const WaveTrains& out) {
  if (out.at.z() != 0) throw waves.wrong("at", "lies above or below still water", "write (x, y, 0)");
  const std::vector<Record>& records = waves.tables("train");
  if (records.size() < 2)
    throw waves.refused("has fewer than two trains", "add [[waves.train]], or take kind = \"regular\"");
  for (std::size_t i = 0; i < records.size(); ++i)
    for (const char* key : {"from", "fade"}) {
      if (i == 0 && records[i].has(key))
        throw records[i].wrong(key, "belongs to trains after the first, which has always been there", "leave it out");
      if (i > 0 && !records[i].has(key))
        throw records[i].refused(fmt::format("needs the key \"{}\": it comes after another", key));
    }
  for (std::size_t i = 1; i < records.size(); ++i) {
    const WaveTrains::Train& before = out.trains[i - 1];
    if (out.trains[i].from < before.from + before.fade)
      throw records[i].wrong(
          "from", fmt::format("is before the train before it is whole, at {:.6g} s", before.from + before.fade),
          "let it come later, or shorten that fade");
  }
}

Binding<WaveTrains> trains_in_turn() {
  return Binding<WaveTrains>("", "regular waves that take turns: each train fades into the next")
      .key(vector("at", dim::length,
                  "where trains come at their instants, as (x, y, 0); from there a change goes on as waves do")
               .or_default("(0, 0, 0) m", "the origin, where phases of waves are told"),
           &WaveTrains::at)
      .tables("train", train(), &WaveTrains::trains)
      .then(check_trains);
}

/// A column `name` with a unit in the header, or a column "name_s" whose name ends in one of `units`; SI. Empty if
/// there is neither.
struct ListColumn {
  std::string name;  ///< as the file has it
  std::vector<double> values;
};
std::optional<ListColumn> list_column(const CsvTable& table, const std::string& name, const hydro::Dimension& dimension,
                                      std::initializer_list<const char*> units) {
  if (table.has(name)) return ListColumn{name, table.column(name, dimension)};
  for (const char* unit : units) {
    ListColumn column{name + "_" + unit, {}};
    if (!table.has(column.name)) continue;
    column.values = table.column(column.name);
    for (double& value : column.values) value *= hydro::parse_unit(unit).factor;
    return column;
  }
  return {};
}

/// The first of several columns that a list has. \throws InputError naming all of them
ListColumn needed(std::initializer_list<std::optional<ListColumn>> candidates, const CsvTable& table,
                  const std::string& what) {
  for (const auto& column : candidates)
    if (column) return *column;
  throw InputError("a list of waves needs " + what, table.place_of(table.names().front(), 0),
                   fmt::format("its columns are {}", fmt::join(table.names(), ", ")));
}

/// Frequencies and amplitudes of a list, which all lists have.
struct ListColumns {
  std::vector<double> omega, amplitude;
};
ListColumns list_columns(const CsvTable& table) {
  if (table.rows() == 0) throw InputError("the list of waves has no rows", {.file = table.file()});
  const auto period = list_column(table, "period", dim::time, {"s"});
  ListColumn rate = needed({period, list_column(table, "frequency", dim::angular_velocity, {"Hz"}),
                            list_column(table, "omega", dim::angular_velocity, {"rad/s"})},
                           table, "a column period [s], frequency [Hz] or omega [rad/s]");
  for (std::size_t i = 0; i < rate.values.size(); ++i) {
    if (!(rate.values[i] > 0))
      throw InputError("a wave needs a positive " + rate.name, table.place_of(rate.name, i),
                       "take the row out, or mend it");
    if (period) rate.values[i] = 2 * std::numbers::pi / rate.values[i];
  }
  const auto amplitude = list_column(table, "amplitude", dim::length, {"m"});
  ListColumn size = needed({amplitude, list_column(table, "height", dim::length, {"m"})}, table,
                           "a column amplitude [m] or height [m]");
  for (std::size_t i = 0; i < size.values.size(); ++i) {
    if (size.values[i] < 0)
      throw InputError("an amplitude cannot be negative", table.place_of(size.name, i),
                       "make it positive and add pi to the phase");
    if (!amplitude) size.values[i] /= 2;
  }
  return {std::move(rate.values), std::move(size.values)};
}

Binding<WaveList> listed() {
  return Binding<WaveList>("", "regular waves from a list")
      .key(text("file",
                "CSV beside the scene: column period [s], frequency [Hz] or omega [rad/s]; amplitude [m] or height "
                "[m]; phase [rad]; perhaps heading [deg], which is added to the heading of the scene"),
           &WaveList::file)
      .key(text("phase_of", "what a phase is added to: \"omega t - k x\" (ours) or \"k x - omega t\"")
               .one_of({"omega t - k x", "k x - omega t"})
               .or_default("omega t - k x", "the convention of every result"))
      .key(second_order(), &WaveList::second_order)
      .then([](const Record& waves, WaveList& out) {
        out.waves = read_wave_list(out.file, Angle::from_radians(waves.si("heading")),
                                   waves.text("phase_of") == "k x - omega t");
      });
}

/// Keys of a record at a gauge; its waves need the water, and are read by recorded_waves().
Binding<WaveList> recorded() {
  return Binding<WaveList>("", "the waves that a gauge recorded, component by component")
      .key(text("file", "CSV beside the scene: time, even, and the surface at the gauge; its time is that of a run"),
           &WaveList::file)
      .key(text("column", "of the surface, with its unit").or_default("elevation", "the usual name"))
      .key(text("time", "column of the time").or_default("time", "the usual name"))
      .key(vector("gauge", dim::length, "where it stood, as (x, y, 0): waves go on from there by linear dispersion"))
      .key(positive("lowest", dim::angular_velocity,
                    "frequency of a component that is taken; in Hz it is 2π times less"))
      .key(positive("highest", dim::angular_velocity, "frequency of a component that is taken"))
      .key(quantity("taper", dim::time,
                    "over so long the record, less its mean, grows from nothing at its beginning and falls to nothing "
                    "at its end, by half a cosine; there the waves are not those that were measured")
               .within(Limit::not_negative));
}

/// 0 … 1 at t of a record from begin to end.
double tapered(double t, double begin, double end, double taper) {
  const double inside = std::min(t - begin, end - t);
  return inside >= taper ? 1 : (1 - std::cos(std::numbers::pi * inside / taper)) / 2;
}

/// The record's surface, less its mean, tapered.
std::vector<double> surface_of(const Record& waves, const CsvTable& table, const std::vector<double>& time) {
  std::vector<double> out = table.column(waves.text("column"), dim::length);
  const double mean = std::accumulate(out.begin(), out.end(), 0.0) / static_cast<double>(out.size());
  const double taper = waves.si("taper");
  if (2 * taper > time.back() - time.front())
    throw waves.wrong("taper", fmt::format("is more than half the record of {:.4g} s", time.back() - time.front()),
                      "take a shorter one");
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = (out[i] - mean) * tapered(time[i], time.front(), time.back(), taper);
  return out;
}

double wavenumber_of(double omega, Angle heading, const Scene& scene) {
  return scene.current.is_none() ? hw::wavenumber(omega, scene.water)
                                 : hw::doppler(omega, heading, scene.current, scene.water).k;
}

/// The Fourier components of a record at a gauge, each with the phase that it has at the origin. (W101)
void read_recorded(const Record& waves, Angle heading, const Scene& scene, WaveList& out) {
  const Eigen::Vector3d gauge = waves.vector("gauge");
  if (gauge.z() != 0) throw waves.wrong("gauge", "lies above or below still water", "write (x, y, 0)");
  const CsvTable table = CsvTable::read(out.file);
  const auto& time = table.column(waves.text("time"), dim::time);
  const double step = placed({.file = out.file.string()}, [&] { return hydro::signal::even_step(time); });
  const std::vector<double> surface = surface_of(waves, table, time);
  const auto record = placed(waves.place(), [&] {
    return hw::record_spectrum(surface, step, 0, {waves.si("lowest"), waves.si("highest")});
  });
  const double ahead = gauge.x() * std::cos(heading.radians()) + gauge.y() * std::sin(heading.radians());
  for (const auto& [omega, amplitude] : record.harmonics) {
    const double phase = std::arg(amplitude) - omega * time.front() + wavenumber_of(omega, heading, scene) * ahead;
    out.waves.push_back({AngularFrequency::from_rad_per_s(omega),
                         hydro::WaveAmplitude::from_metres(std::abs(amplitude)), phase, heading});
  }
  out.recorded = {time.front(), time.back(), record.fraction_left_out};
}

void read_packets(const Value& file, FocusedPackets& out) {
  const ListColumns list = list_columns(CsvTable::read(beside(file.place.file, file.text)));
  for (std::size_t i = 0; i < list.omega.size(); ++i)
    out.packets.push_back(
        {hydro::WaveAmplitude::from_metres(list.amplitude[i]), AngularFrequency::from_rad_per_s(list.omega[i])});
}

const Binding<FocusedPackets>& focused_packets() {
  static const auto focus = place_and_time("[waves.focus]", "where and when the packets meet", "as (x, y, 0)");
  static const auto table =
      Binding<FocusedPackets>("",
                              "groups 3.5 waves long that meet at one place and time; for `froude waves` and members")
          .key(text("file", "CSV beside the scene: column period [s] (or frequency, omega), column amplitude [m]"),
               read_packets)
          .table("focus", focus, &FocusedPackets::focus);
  return table;
}

void read_wavemaker(const Record& maker, WaveTank& out) {
  if (maker.text("kind") == "flap" && !out.hinge)
    throw maker.refused("of kind flap needs the height of its hinge", "add hinge = \"-1 m\"");
  if (maker.text("kind") != "flap" && out.hinge)
    throw maker.wrong("hinge", "belongs to a flap; a piston does not turn", "leave it out");
  const Value& file = maker["file"];
  const CsvTable motion = CsvTable::read(beside(file.place.file, file.text));
  out.step = placed(file.place, [&] { return hydro::signal::even_step(motion.column("time", dim::time)); });
  out.displacement = motion.column("displacement", dim::length);
}

Binding<WaveTank> wavemaker() {
  return Binding<WaveTank>("[waves.wavemaker]", "the paddle at x = 0, and how it moves")
      .key(text("kind", "\"flap\": turns about a hinge; \"piston\": moves without turning").one_of({"flap", "piston"}))
      .optional(
          quantity("hinge", dim::length, "flap: height of the hinge, z up from still water; may lie below the bed"),
          &WaveTank::hinge)
      .key(text(
          "file",
          "CSV beside the scene: columns time [s], evenly spaced, and displacement [m] of the paddle at still water"))
      .key(positive("lowest", dim::angular_velocity, "lowest frequency of the motion that is taken"), &WaveTank::lowest)
      .key(positive("highest", dim::angular_velocity, "highest frequency of the motion that is taken"),
           &WaveTank::highest)
      .key(effect("active_absorption",
                  "waves that come back to the paddle leave the tank; left out: they are reflected, as by a paddle "
                  "whose motion is prescribed"),
           &WaveTank::active_absorption)
      .then(read_wavemaker);
}

Binding<WaveTank> tank() {
  return Binding<WaveTank>("", "a wave tank: what a paddle makes; for `froude waves` and members")
      .then([](const Record& waves, WaveTank&) {
        if (waves.si("heading") != 0)
          throw waves.wrong("heading", "is not possible in a tank, whose waves go towards +x",
                            "write heading = \"0 deg\"");
      })
      .key(positive("length", dim::length, "from the paddle at x = 0 to the beach"), &WaveTank::length)
      .key(number("reflection", "amplitude that the beach sends back, relative")
               .within(Limit::fraction)
               .or_default("0", "a beach that absorbs everything"),
           &WaveTank::reflection)
      .table("wavemaker", wavemaker())
      .needed();
}

Binding<Waves> kinematics() {
  using enum hw::Stretching;
  return Binding<Waves>("[waves.kinematics]", "how the water moves between still water and the surface")
      .words(text("above_still_water",
                  "\"vertical\": as at still water; \"wheeler\": the whole column stretched; \"linear\": the tangent "
                  "at still water; \"delta\": between the last two; \"none\": the exponential goes on")
                 .or_default("vertical", "never exceeds what linear theory says at still water"),
             {{"vertical", vertical}, {"wheeler", wheeler}, {"linear", linear}, {"delta", delta}, {"none", none}},
             &Waves::stretching);
}

Binding<Waves> all_waves() {
  auto table =
      Binding<Waves>("[waves]", "the waves")
          .key(text("kind", "of sea"))
          .key(quantity("heading", dim::angle, "where the waves go: from +x towards +y; 0 deg goes towards +x"),
               &Waves::heading)
          .key(quantity("ramp", dim::time, "wave loads grow from nothing over this time, by half a cosine")
                   .within(Limit::not_negative)
                   .or_default("0 s", "loads act from the start unless the scene says otherwise"),
               &Waves::ramp)
          .table("kinematics", kinematics())
          .or_default()
          .place(&Waves::place)
          .variant("regular", regular(), &Waves::kind)
          .variant("components", listed(), &Waves::kind)
          .variant("record", recorded(), &Waves::kind)
          .variant("trains", trains_in_turn(), &Waves::kind)
          .variant("focused_packets", focused_packets(), &Waves::kind)
          .variant("tank", tank(), &Waves::kind);
  for (const auto& [keys, build] : spectra()) {
    Table own{.title = "", .meaning = keys.meaning, .keys = keys.keys, .groups = keys.groups};
    own.keys.push_back(inner_table("spreading", spreading()).optional());
    table.variant(keys.word, random_sea(own), &Waves::kind);
  }
  const Table sum{.title = "", .meaning = "several random seas at once", .keys = {inner_tables("part", part())}};
  return table.variant("sum", random_sea(sum), &Waves::kind);
}

}  // namespace

std::vector<hw::GivenWave> read_wave_list(const std::filesystem::path& file, Angle heading, bool phase_of_kx) {
  const CsvTable table = CsvTable::read(file);
  const ListColumns list = list_columns(table);
  const std::vector<double> phase =
      needed({list_column(table, "phase", dim::angle, {"rad", "deg"})}, table, "a column phase [rad]").values;
  const auto directions = list_column(table, "heading", dim::angle, {"rad", "deg"});
  const std::vector<double> direction = directions ? directions->values : std::vector<double>(phase.size(), 0.0);
  std::vector<hw::GivenWave> out;
  for (std::size_t i = 0; i < phase.size(); ++i)
    out.push_back({AngularFrequency::from_rad_per_s(list.omega[i]),
                   hydro::WaveAmplitude::from_metres(list.amplitude[i]), phase_of_kx ? -phase[i] : phase[i],
                   Angle::from_radians(heading.radians() + direction[i])});
  return out;
}

const Binding<Waves>& waves_binding() {
  static const auto table = all_waves();
  return table;
}

Waves build_waves(const Record& waves, const Scene& scene) {
  Waves out = waves_binding().read(waves);
  if (auto* sea = std::get_if<RandomSea>(&out.kind)) sea->systems = read_systems(waves, out.heading, scene);
  if (waves.text("kind") == "record") read_recorded(waves, out.heading, scene, std::get<WaveList>(out.kind));
  if (std::holds_alternative<WaveTank>(out.kind) && scene.water.depth.is_infinite())
    throw waves.refused("of kind tank needs a bed", "give [water] a depth in metres");
  return out;
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

hw::Current build_current(const Record& current, const std::filesystem::path& file) {
  if (current.has("velocity")) {
    const Eigen::Vector3d v = current.vector("velocity");
    if (v.z() != 0) throw current.wrong("velocity", "has a vertical part; a current is level", "write (u, v, 0) m/s");
    return hw::Current::uniform(v.head<2>());
  }
  const CsvTable table = CsvTable::read(beside(file, current.text("file")));
  const auto &u = table.column("u", dim::velocity), &v = table.column("v", dim::velocity);
  std::vector<Eigen::Vector2d> velocity;
  for (std::size_t i = 0; i < u.size(); ++i) velocity.emplace_back(u[i], v[i]);
  return placed(current["file"].place, [&] { return hw::Current::profile(table.column("z", dim::length), velocity); });
}

}  // namespace froude::scene
