/// \file  From the tables of waves to seas; what is wrong with a spectrum or spreading is told at the line that holds
/// it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>

#include "hydro/io/csv.hpp"
#include "hydro/signal/welch.hpp"
#include "scene/build.hpp"
#include "scene/spectra.hpp"

namespace froude::scene {
namespace {

using hydro::Angle;
using hydro::AngularFrequency;
using hydro::InputError;
using hydro::io::CsvTable;
namespace dim = hydro::dim;
namespace hw = hydro::waves;

/// Runs `make`; what it throws without a place of its own gets that of a value of the scene.
template <class F>
auto placed(const Place& place, F make) {
  try {
    return make();
  } catch (const InputError& e) {
    throw e.at(place);
  }
}

WaveSystem build_system(const Record& sea, Angle heading, const Scene& scene) {
  WaveSystem out{.kind = sea.text("kind"), .spectrum = {}, .spreading = {}, .heading = heading};
  out.spectrum = placed(sea["kind"].place, [&] { return spectrum_kind(sea.text("kind")).build(sea, scene); });
  if (sea.has("spreading")) {
    const Record& spreading = sea.table("spreading");
    out.spreading = placed(spreading["kind"].place, [&] {
      return spreading_kind(spreading.text("kind")).build(spreading, *out.spectrum, scene);
    });
  }
  return out;
}

hw::Focus build_focus(const Record& focus) {
  const Eigen::Vector3d position = focus.vector("position");
  if (position.z() != 0) throw focus.wrong("position", "lies above or below still water", "write (x, y, 0)");
  return {.x_m = position.x(), .y_m = position.y(), .t_s = focus.si("time")};
}

RandomSea build_random(const Record& waves, Angle heading, const Scene& scene) {
  RandomSea out;
  if (waves.text("kind") == "sum") {
    for (const Record& part : waves.tables("part"))
      out.systems.push_back(build_system(part, Angle::from_radians(part.si("heading")), scene));
    if (out.systems.empty()) throw waves.refused("has no part", "add [[waves.part]]");
  } else {
    out.systems.push_back(build_system(waves, heading, scene));
  }
  out.seed = static_cast<std::uint64_t>(waves["seed"].integer);
  const Record& cut = waves.table("components");
  out.bins_place = cut.place();
  if (cut.has("equal_energy"))
    out.bins = hw::EqualEnergy{static_cast<std::size_t>(cut["equal_energy"].integer)};
  else if (cut.has("random"))
    out.bins = hw::RandomInBin{static_cast<std::size_t>(cut["random"].integer)};
  else
    out.bins = hw::FftGrid{cut.si("repetition")};
  if (cut.has("lowest")) out.lowest = cut.si("lowest");
  if (cut.has("highest")) out.highest = cut.si("highest");
  if (cut.text("amplitudes") == "rayleigh") out.amplitudes = hw::Amplitudes::rayleigh;
  if (waves.has("crest")) {
    const Record& crest = waves.table("crest");
    out.crest = Crest{crest.si("height"), build_focus(crest), crest.text("around") == "nothing"};
  }
  out.second_order = waves.has("second_order");
  return out;
}

RegularWave build_regular(const Record& waves) {
  static const std::map<std::string, RegularTheory> theories{{"linear", RegularTheory::linear},
                                                             {"stokes2", RegularTheory::stokes_second},
                                                             {"stokes5", RegularTheory::stokes_fifth},
                                                             {"stream", RegularTheory::stream_function}};
  return {waves.has("amplitude") ? waves.si("amplitude") : waves.si("height") / 2, waves.si("period"),
          theories.at(waves.text("theory"))};
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

FocusedPackets build_packets(const Record& waves, const Scene& scene) {
  FocusedPackets out{.packets = {}, .focus = build_focus(waves.table("focus"))};
  const ListColumns list = list_columns(CsvTable::read(beside(scene.file, waves.text("file"))));
  for (std::size_t i = 0; i < list.omega.size(); ++i)
    out.packets.push_back(
        {hydro::WaveAmplitude::from_metres(list.amplitude[i]), AngularFrequency::from_rad_per_s(list.omega[i])});
  return out;
}

WaveTank build_tank(const Record& waves, const Scene& scene) {
  const Record& maker = waves.table("wavemaker");
  WaveTank out{.length = waves.si("length"),
               .reflection = waves.si("reflection"),
               .hinge = {},
               .lowest = maker.si("lowest"),
               .highest = maker.si("highest"),
               .active_absorption = maker.has("active_absorption"),
               .step = 0,
               .displacement = {}};
  if (scene.water.depth.is_infinite())
    throw waves.refused("of kind tank needs a bed", "give [water] a depth in metres");
  if (waves.si("heading") != 0)
    throw waves.wrong("heading", "is not possible in a tank, whose waves go towards +x", "write heading = \"0 deg\"");
  if (maker.text("kind") == "flap") {
    if (!maker.has("hinge")) throw maker.refused("of kind flap needs the height of its hinge", "add hinge = \"-1 m\"");
    out.hinge = maker.si("hinge");
  } else if (maker.has("hinge")) {
    throw maker.wrong("hinge", "belongs to a flap; a piston does not turn", "leave it out");
  }
  const CsvTable motion = CsvTable::read(beside(scene.file, maker.text("file")));
  out.step = placed(maker["file"].place, [&] { return hydro::signal::even_step(motion.column("time", dim::time)); });
  out.displacement = motion.column("displacement", dim::length);
  return out;
}

hw::Stretching stretching_of(const std::string& word) {
  if (word == "wheeler") return hw::Stretching::wheeler;
  if (word == "linear") return hw::Stretching::linear;
  if (word == "delta") return hw::Stretching::delta;
  if (word == "none") return hw::Stretching::none;
  return hw::Stretching::vertical;
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

Waves build_waves(const Record& waves, const Scene& scene) {
  Waves out{.kind = RegularWave{},
            .heading = Angle::from_radians(waves.si("heading")),
            .ramp = waves.si("ramp"),
            .stretching = stretching_of(waves.table("kinematics").text("above_still_water")),
            .place = waves.place()};
  const std::string& kind = waves.text("kind");
  if (kind == "regular") {
    out.kind = build_regular(waves);
  } else if (kind == "components") {
    const auto file = beside(scene.file, waves.text("file"));
    out.kind = WaveList{read_wave_list(file, out.heading, waves.text("phase_of") == "k x - omega t"), file,
                        waves.has("second_order")};
  } else if (kind == "focused_packets") {
    out.kind = build_packets(waves, scene);
  } else if (kind == "tank") {
    out.kind = build_tank(waves, scene);
  } else {
    out.kind = build_random(waves, out.heading, scene);
  }
  return out;
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
