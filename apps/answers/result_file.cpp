
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "answers/provenance.hpp"
#include "froude/hull_pressures.hpp"
#include "froude/result.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/units.hpp"
#include "hydro/io/hdf5.hpp"
#include "hydro/io/trial.hpp"

namespace froude {
namespace {

using hydro::io::Hdf5Reader;
using hydro::io::Hdf5Writer;

constexpr const char* run_kind = "froude run";
constexpr const char* rao_kind = "froude rao";
constexpr const char* modes_kind = "froude modes";
constexpr const char* meaning_of_heading = "direction the wave propagates towards, from +x towards +y";
constexpr const char* phase_of_amplitudes =
    "Re(amplitude exp(+i omega t)), of a wave with its crest at the origin at t = 0";
constexpr const char* field_kind = "froude field";
constexpr const char* stability_kind = "froude stability";

void describe(Hdf5Writer& file, const std::string& dataset, const std::string& units, const std::string& long_name) {
  file.attribute(dataset, "units", units.empty() ? "1" : units);
  file.attribute(dataset, "long_name", long_name);
}

/// Real and imaginary part of each, one after the other.
template <class Values>
std::vector<double> real_and_imaginary(const Values& values) {
  std::vector<double> out;
  out.reserve(2 * static_cast<std::size_t>(values.size()));
  for (const std::complex<double>& value : values) out.insert(out.end(), {value.real(), value.imag()});
  return out;
}

void write_dimension(Hdf5Writer& file, const std::string& dataset, const std::vector<double>& values,
                     const std::string& units, const std::string& long_name) {
  file.write(dataset, values, {values.size()});
  file.make_dimension(dataset);
  describe(file, dataset, units, long_name);
}

template <class Value>
void write_attributes(Hdf5Writer& file, const std::string& group, const std::string& meaning,
                      const std::vector<std::pair<std::string, Value>>& entries) {
  if (entries.empty()) return;
  file.write_text(group, meaning);
  for (const auto& [key, value] : entries) file.attribute(group, key, value);
}

/// Entries are attributes of one text each, which says what they are: netCDF readers show them without a group walk.
void write_provenance(Hdf5Writer& file, const char* kind, const Provenance& p) {
  file.attribute("/", "Conventions", "CF-1.8");
  file.attribute("/", "kind", kind);
  file.attribute("/", "froude_version", FROUDE_VERSION);
  file.attribute("/", "build_type", FROUDE_BUILD_TYPE);
  if (!p.scene_file.empty()) file.attribute("/", "scene_file", p.scene_file);
  if (!p.scene_text.empty()) file.write_text("/provenance/scene", p.scene_text);
  write_attributes(file, "/provenance/settings", "every key that acts, defaults included", p.settings);
  write_attributes(file, "/provenance/seeds", "seeds of random numbers", p.seeds);
  write_attributes(file, "/provenance/wall_time", "wall time by effect, s", p.wall_time);
  write_attributes(file, "/provenance/energy", "energy ledger, J", p.energy);
  write_attributes(file, "/provenance/notes", "notes", p.notes);
}

std::string root_path(const std::string& name) {
  hydro::ensure(!name.empty() && name.find('/') == std::string::npos,
                "result file: a signal's name is no dataset name");
  return "/" + name;
}

}  // namespace

namespace {

/// One attribute each, as text like all numbers about a result.
void write_error(Hdf5Writer& file, const std::string& dataset, const ErrorEstimate& error, std::size_t signal) {
  if (error.sources.empty()) return;
  file.attribute(dataset, "error", error.total(signal));
  for (const auto& source : error.sources) file.attribute(dataset, "error_" + source.name, source.of_signal[signal]);
  for (const auto& lost : error.unpredictable)
    if (lost.signal == signal) file.attribute(dataset, "predictable_until_s", lost.until);
}

}  // namespace

void write_run(const std::filesystem::path& path, const std::vector<double>& time, const std::vector<Signal>& signals,
               const Provenance& provenance, const ErrorEstimate& error) {
  Hdf5Writer file(provenance.packing);
  write_provenance(file, run_kind, provenance);
  write_dimension(file, "/time", time, "s", "time from the start of the run");
  for (std::size_t i = 0; i < signals.size(); ++i) {
    const std::string dataset = root_path(signals[i].name);
    file.write(dataset, signals[i].values, {time.size()});
    file.attach_dimension(dataset, 0, "/time");
    describe(file, dataset, signals[i].units, signals[i].long_name);
    write_error(file, dataset, error, i);
  }
  file.save(path);
}

namespace {

/// In a group of their own, whose arrays all stand along its sections.
void write_sections(Hdf5Writer& file, const std::vector<SectionAtRest>& sections) {
  if (sections.empty()) return;
  constexpr std::array<const char*, 6> component{"force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z"};
  const std::string group = "/section_at_rest", along = group + "/section";
  std::vector<std::string> names;
  for (const SectionAtRest& s : sections) names.push_back(s.name);
  file.write_texts(along, names);
  file.make_dimension(along);
  const auto write = [&](const std::string& name, const char* unit, const std::string& meaning, auto value_of) {
    std::vector<double> values;
    for (const SectionAtRest& s : sections) values.push_back(value_of(s));
    const std::string dataset = group + "/" + name;
    file.write(dataset, values, {values.size()});
    file.attach_dimension(dataset, 0, along);
    describe(file, dataset, unit, meaning);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const char axis = "xyz"[i];
    write(std::string("at_") + axis, "m", "a point of the section, from the body's origin, body axes",
          [i](const SectionAtRest& s) { return s.at[i]; });
    write(std::string("normal_") + axis, "1", "of the section, into the part that is described, body axes",
          [i](const SectionAtRest& s) { return s.normal[i]; });
  }
  for (std::size_t i = 0; i < component.size(); ++i)
    write(component[i], i < 3 ? "N" : "N m", fmt::format("{} at rest, on the part that is described", component[i]),
          [i](const SectionAtRest& s) { return s.load[i]; });
}

}  // namespace

void write_rao(const std::filesystem::path& path, const std::vector<double>& omega, const std::vector<double>& heading,
               const std::vector<ComplexSignal>& signals, const Provenance& provenance, const ErrorEstimate& error,
               const std::vector<SectionAtRest>& sections) {
  const bool several = heading.size() != 1;
  Hdf5Writer file(provenance.packing);
  write_provenance(file, rao_kind, provenance);
  file.attribute("/", "phase", phase_of_amplitudes);
  write_dimension(file, "/omega", omega, "rad/s", "angular frequency");
  const std::array<std::string, 2> parts{"re", "im"};
  file.write_texts("/complex", parts);
  file.make_dimension("/complex");
  if (several) {
    write_dimension(file, "/heading", heading, "rad", meaning_of_heading);
  } else {
    file.write_scalar("/heading", heading.front());
    describe(file, "/heading", "rad", meaning_of_heading);
  }
  std::vector<std::string> dimensions{"/omega", "/complex"};
  std::vector<std::size_t> shape{omega.size(), parts.size()};
  if (several) {
    dimensions.insert(dimensions.begin(), "/heading");
    shape.insert(shape.begin(), heading.size());
  }
  for (std::size_t i = 0; i < signals.size(); ++i) {
    const ComplexSignal& signal = signals[i];
    const std::string dataset = root_path(signal.name);
    file.write(dataset, real_and_imaginary(signal.values), shape);
    for (std::size_t d = 0; d < dimensions.size(); ++d) file.attach_dimension(dataset, d, dimensions[d]);
    describe(file, dataset, signal.units, signal.long_name);
    write_error(file, dataset, error, i);
  }
  write_sections(file, sections);
  file.save(path);
}

void write_modes(const std::filesystem::path& path, const Modes& modes, const Provenance& provenance) {
  Hdf5Writer file(provenance.packing);
  write_provenance(file, modes_kind, provenance);
  file.attribute("/", "phase", "Re(damped_shape exp(s t))");
  std::vector<double> number, period;
  for (std::size_t i = 0; i < modes.omega.size(); ++i) {
    number.push_back(static_cast<double>(i + 1));
    period.push_back(2 * std::numbers::pi / modes.omega[i]);
  }
  write_dimension(file, "/mode", number, "1", "number, by rising frequency");
  file.write_texts("/motion", modes.motions);
  file.make_dimension("/motion");
  const std::array<std::string, 2> parts{"re", "im"};
  file.write_texts("/complex", parts);
  file.make_dimension("/complex");
  const std::size_t count = modes.omega.size(), motions = modes.motions.size();
  const auto write = [&](const std::string& name, const std::vector<double>& values, std::vector<std::size_t> shape,
                         std::vector<std::string> dimensions, const std::string& units, const std::string& what) {
    file.write(name, values, shape);
    for (std::size_t d = 0; d < dimensions.size(); ++d) file.attach_dimension(name, d, dimensions[d]);
    describe(file, name, units, what);
  };
  write("/omega", modes.omega, {count}, {"/mode"}, "rad/s", "undamped angular frequency");
  write("/period", period, {count}, {"/mode"}, "s", "undamped period");
  write("/s", real_and_imaginary(modes.s), {count, 2}, {"/mode", "/complex"}, "1/s", "eigenvalue of the damped motion");
  write("/shape", modes.shape, {count, motions}, {"/mode", "/motion"}, "1",
        "undamped displacements about the centres of gravity, m and rad");
  write("/damped_shape", real_and_imaginary(modes.damped_shape), {count, motions, 2}, {"/mode", "/motion", "/complex"},
        "1", "damped displacements about the centres of gravity, m and rad");
  file.save(path);
}

double StabilityMap::Motion::fate_number() const { return fate ? static_cast<double>(*fate) : std::nan(""); }

constexpr const char* what_multipliers_are = "largest absolute Floquet multiplier of the periodic motion";
constexpr const char* what_fates_are = "0 stable, 1 period-doubled, 2 quasi-periodic, 3 fold";
constexpr const char* what_reached_is =
    "0 grown as the waves grow, 1 round folds, 2 jumped onto another branch, 3 none found, 4 beyond breaking";

std::string name_of(StabilityMap::Reached reached) {
  switch (reached) {
    case StabilityMap::Reached::grown:
      return "grown";
    case StabilityMap::Reached::round_folds:
      return "round folds";
    case StabilityMap::Reached::jumped:
      return "jumped";
    case StabilityMap::Reached::not_found:
      return "none found";
    case StabilityMap::Reached::beyond_breaking:
      return "beyond breaking";
  }
  return {};
}

/// A group of its own, point by point.
void write_branch(Hdf5Writer& file, const std::string& group, const StabilityMap::Branch& branch) {
  std::vector<double> number, period, height, multiplier, fate, forwards;
  for (const auto& p : branch.points) {
    number.push_back(static_cast<double>(number.size() + 1));
    period.push_back(p.period);
    height.push_back(p.height);
    multiplier.push_back(p.multiplier);
    fate.push_back(p.fate_number());
    forwards.push_back(p.forwards ? 1 : 0);
  }
  write_dimension(file, group + "/point", number, "1", "along the branch");
  const auto point_by_point = [&](const std::string& name, const std::vector<double>& values, const std::string& units,
                                  const std::string& what) {
    file.write(group + name, values, {values.size()});
    file.attach_dimension(group + name, 0, group + "/point");
    describe(file, group + name, units, what);
  };
  point_by_point("/period", period, "s", "of the waves");
  point_by_point("/height", height, "m", "of the waves");
  point_by_point("/multiplier", multiplier, "1", what_multipliers_are);
  point_by_point("/fate", fate, "1", what_fates_are);
  point_by_point("/forwards", forwards, "1", "0 where what varies falls along the branch: it has turned at a fold");
  for (const Signal& s : branch.signals) point_by_point(root_path(s.name), s.values, s.units, s.long_name);
  file.attribute(group, branch.over_periods ? "height_m" : "period_s", branch.held);
  file.attribute(group, "begin", name_of(branch.begin));
  file.attribute(group, "end", branch.end.empty() ? "at the other end of the map" : branch.end);
}

void StabilityMap::write(const std::filesystem::path& path) const {
  Hdf5Writer file(provenance.packing);
  Provenance with_notes = provenance;
  add_notes(notes, with_notes);
  write_provenance(file, stability_kind, with_notes);
  write_dimension(file, "/height", height, "m", "of the waves");
  write_dimension(file, "/period", period, "s", "of the waves");
  const auto cell_by_cell = [&](const std::string& name, const std::vector<double>& values, const std::string& units,
                                const std::string& what) {
    file.write(name, values, {height.size(), period.size()});
    file.attach_dimension(name, 0, "/height");
    file.attach_dimension(name, 1, "/period");
    describe(file, name, units, what);
  };
  std::vector<double> multiplier, fate, reached;
  for (const Cell& c : cells) {
    reached.push_back(static_cast<double>(c.reached));
    multiplier.push_back(c.multiplier);
    fate.push_back(c.fate_number());
  }
  cell_by_cell("/multiplier", multiplier, "1", what_multipliers_are);
  cell_by_cell("/fate", fate, "1", what_fates_are);
  cell_by_cell("/reached", reached, "1", what_reached_is);
  file.write("/mathieu", mathieu, {period.size()});
  file.attach_dimension("/mathieu", 0, "/period");
  describe(file, "/mathieu", "m", "height from which one motion grows, by Hill's equation of that motion");
  for (const Signal& s : signals) cell_by_cell(root_path(s.name), s.values, s.units, s.long_name);
  for (std::size_t i = 0; i < branches.size(); ++i) write_branch(file, fmt::format("/branch{}", i + 1), branches[i]);
  file.save(path);
}

namespace {

/// Three numbers a panel, along `panel` and `space`.
template <class Of>
void write_in_space(Hdf5Writer& file, const std::string& name, const HullPressures& hulls, const Of& of,
                    const std::string& units, const std::string& meaning) {
  std::vector<double> flat;
  for (const auto& panel : hulls.on.panel) {
    const Eigen::Vector3d& at = of(panel);
    flat.insert(flat.end(), at.data(), at.data() + 3);
  }
  file.write(name, flat, {hulls.on.panel.size(), 3});
  file.attach_dimension(name, 0, "/panel");
  file.attach_dimension(name, 1, "/space");
  describe(file, name, units, meaning);
}

/// NaN after the last corner of panels that have fewer than others.
void write_corners(Hdf5Writer& file, const HullPressures& hulls) {
  std::size_t most = 0;
  for (const auto& panel : hulls.on.panel) most = std::max(most, panel.corners.size());
  std::vector<double> flat, number;
  for (std::size_t c = 1; c <= most; ++c) number.push_back(static_cast<double>(c));
  for (const auto& panel : hulls.on.panel) {
    for (const Eigen::Vector3d& corner : panel.corners) flat.insert(flat.end(), corner.data(), corner.data() + 3);
    flat.insert(flat.end(), 3 * (most - panel.corners.size()), std::numeric_limits<double>::quiet_NaN());
  }
  write_dimension(file, "/corner", number, "1", "of a panel, anticlockwise seen from the water");
  file.write("/panel_corner", flat, {hulls.on.panel.size(), most, 3});
  for (const auto& [axis, dimension] : {std::pair(0, "/panel"), std::pair(1, "/corner"), std::pair(2, "/space")})
    file.attach_dimension("/panel_corner", static_cast<std::size_t>(axis), dimension);
  describe(file, "/panel_corner", "m", "corners of the panel, global; not a number after its last");
}

/// Complex values along one dimension.
template <class Values>
void write_along(Hdf5Writer& file, const std::string& name, const Values& values, const std::string& dimension,
                 const std::string& units, const std::string& meaning) {
  file.write(name, real_and_imaginary(values), {static_cast<std::size_t>(values.size()), 2});
  file.attach_dimension(name, 0, dimension);
  file.attach_dimension(name, 1, "/complex");
  describe(file, name, units, meaning);
}

void write_pressures(Hdf5Writer& file, const HullPressures& hulls) {
  using hydro::potential::WetPanel;
  std::vector<double> number, body, area;
  for (const WetPanel& panel : hulls.on.panel) {
    number.push_back(static_cast<double>(number.size() + 1));
    body.push_back(panel.body + 1.0);
    area.push_back(panel.area);
  }
  file.attribute("/", "pressure_error", hulls.on.estimate);
  write_dimension(file, "/panel", number, "1", "of the hulls under still water");
  file.write_texts("/space", std::array<std::string, 3>{"x", "y", "z"});
  file.make_dimension("/space");
  file.write_texts("/hull", hulls.bodies);
  file.make_dimension("/hull");
  const auto write_of_panels = [&](const std::string& name, const std::vector<double>& values, const std::string& unit,
                                   const std::string& meaning) {
    file.write(name, values, {values.size()});
    file.attach_dimension(name, 0, "/panel");
    describe(file, name, unit, meaning);
  };
  write_of_panels("/panel_body", body, "1", "whose hull it is, as `hull` counts them from 1");
  write_of_panels("/panel_area", area, "m^2", "area of the panel");
  write_in_space(
      file, "/panel_centre", hulls, [](const WetPanel& p) -> const auto& { return p.centre; }, "m",
      "centre of the panel, global");
  write_in_space(
      file, "/panel_normal", hulls, [](const WetPanel& p) -> const auto& { return p.normal; }, "1",
      "out of the body, of unit length");
  write_corners(file, hulls);
  write_along(file, "/pressure", hulls.on.dynamic, "/panel", "Pa/m",
              "dynamic pressure at the centre of the panel per metre of wave amplitude");
  write_along(file, "/hydrostatic_pressure", hulls.on.hydrostatic, "/panel", "Pa/m",
              "change of the hydrostatic pressure that the moving panel meets per metre of wave amplitude");
}

void write_far_field(Hdf5Writer& file, const FreeSurface& surface) {
  write_dimension(file, "/angle", surface.angle, "rad", "direction seen from the global origin, from +x towards +y");
  const std::string law = ": A of A sqrt(2/(pi k r)) exp(-i (k r - pi/4)) per metre of wave amplitude";
  write_along(file, "/far_scattered", surface.far_scattered, "/angle", "m/m", "far away, of bodies held still" + law);
  write_along(file, "/far_radiated", surface.far_radiated, "/angle", "m/m", "far away, of the motion of bodies" + law);
}

void write_body_drift(Hdf5Writer& file, const FreeSurface& surface) {
  std::vector<std::string> names;
  for (const FreeSurface::BodyDrift& one : surface.body_drift) names.push_back(one.body);
  file.write_texts("/body", names);
  file.make_dimension("/body");
  file.attribute("/", "body_drift_error", surface.body_drift_error);
  const auto write = [&](const std::string& name, double FreeSurface::BodyDrift::*of, const std::string& unit,
                         const std::string& meaning) {
    std::vector<double> values;
    for (const FreeSurface::BodyDrift& one : surface.body_drift) values.push_back(one.*of);
    file.write(name, values, {values.size()});
    file.attach_dimension(name, 0, "/body");
    describe(file, name, unit, meaning);
  };
  write("/body_drift_x", &FreeSurface::BodyDrift::x, "N/m^2", "mean drift force, per wave amplitude squared");
  write("/body_drift_y", &FreeSurface::BodyDrift::y, "N/m^2", "mean drift force, per wave amplitude squared");
  write("/body_drift_moment", &FreeSurface::BodyDrift::moment, "N m/m^2",
        "mean drift moment about the vertical through the origin of the body, per wave amplitude squared");
}

}  // namespace

void FreeSurface::write(const std::filesystem::path& path) const {
  Hdf5Writer file(provenance.packing);
  Provenance with_notes = provenance;
  add_notes(notes, with_notes);
  write_provenance(file, field_kind, with_notes);
  file.attribute("/", "phase", phase_of_amplitudes);
  file.attribute("/", "bodies", held ? "held still" : "free");
  file.attribute("/", "error", estimate);
  write_dimension(file, "/y", y, "m", "of the grid, global");
  write_dimension(file, "/x", x, "m", "of the grid, global");
  file.write_texts("/complex", std::array<std::string, 2>{"re", "im"});
  file.make_dimension("/complex");
  file.write_scalar("/omega", omega);
  describe(file, "/omega", "rad/s", "angular frequency of the wave");
  file.write_scalar("/heading", heading);
  describe(file, "/heading", "rad", meaning_of_heading);
  const auto write_mean = [&](const char* name, double value, const char* unit, const char* meaning) {
    file.write_scalar(name, value);
    describe(file, name, unit, meaning);
  };
  write_mean("/drift_x", drift_x, "N/m^2", "mean drift force on all bodies, per wave amplitude squared");
  write_mean("/drift_y", drift_y, "N/m^2", "mean drift force on all bodies, per wave amplitude squared");
  write_mean("/power_taken", power_taken, "W/m^2", "mean power that the bodies take from the waves");
  write_mean("/power_sent_out", power_sent_out, "W/m^2", "mean power of scattered and radiated waves");
  for (const ComplexSignal& part : signals) {
    const std::string dataset = root_path(part.name);
    file.write(dataset, real_and_imaginary(part.values), {y.size(), x.size(), 2});
    file.attach_dimension(dataset, 0, "/y");
    file.attach_dimension(dataset, 1, "/x");
    file.attach_dimension(dataset, 2, "/complex");
    describe(file, dataset, part.units, part.long_name);
  }
  write_far_field(file, *this);
  if (pressure) write_pressures(file, *pressure);
  if (!body_drift.empty()) write_body_drift(file, *this);
  file.save(path);
}

namespace {
RunResult run_in(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  if (!file.has_attribute("/", "kind") || file.text_attribute("/", "kind") != run_kind)
    throw hydro::InputError("not a result of `froude run`", {.file = path.string()},
                            "give the .h5 file that `froude run` wrote");
  RunResult result;
  result.time = file.numbers("/time").values;
  for (const std::string& name : file.children("/")) {
    if (name == "time" || name == "provenance") continue;
    const std::string dataset = "/" + name;
    Signal signal{name, file.text_attribute(dataset, "units"), file.text_attribute(dataset, "long_name"),
                  file.numbers(dataset).values};
    if (signal.values.size() != result.time.size())
      throw hydro::InputError(name + " and time differ in length", {.file = path.string()}, "run the scene again");
    if (signal.units == "1") signal.units.clear();
    result.signals.push_back(std::move(signal));
  }
  return result;
}
}  // namespace

RunResult read_run(const std::filesystem::path& path) {
  return hydro::io::read_tried(path, [&] { return run_in(path); });
}

}  // namespace froude
