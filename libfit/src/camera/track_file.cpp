#include "fit/camera/track_file.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <map>

#include "hydro/base/error.hpp"
#include "hydro/base/units.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv_cells.hpp"
#include "hydro/io/hdf5.hpp"
#include "hydro/io/trial.hpp"

namespace fit::camera {
namespace {

using hydro::InputError;
using hydro::Place;
using hydro::io::NumberNotation;
using hydro::io::TableCell;
using hydro::io::TableLine;
constexpr double unseen = std::numeric_limits<double>::quiet_NaN();

/// "1280 x 720 px", which write_track() leaves in the file, CSV after "# picture: ".
Eigen::Vector2i size_in(std::string_view text, std::string_view before) {
  const auto at = text.find(before);
  int width = 0, height = 0;
  if (at == std::string_view::npos ||
      std::sscanf(std::string(text.substr(at + before.size(), 60)).c_str(), "%d x %d px", &width, &height) != 2)
    return {0, 0};
  return {width, height};
}

/// What stands between the cells: whatever of these the last line has, which is a row.
char separator_of(const std::vector<TableLine>& lines) {
  const char found = hydro::io::separator_in(lines.back().text);
  return found == '\0' ? ' ' : found;
}

/// Whether a marker was not seen in this cell.
bool is_unseen(std::string_view cell) {
  std::string lower(cell);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower.empty() || lower == "nan" || lower == "na" || lower == "-";
}

/// NaN for a cell without a place; nothing for text.
std::optional<double> number_in(const TableCell& cell, const NumberNotation& notation) {
  if (is_unseen(cell.text)) return unseen;
  const auto value = notation.number(cell);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

bool is_row(const std::vector<TableCell>& cells, const NumberNotation& notation) {
  bool any = false;
  for (const auto& cell : cells) {
    const auto value = number_in(cell, notation);
    if (!value) return false;
    any = any || !std::isnan(*value);
  }
  return any;
}

/// The numbers of a file under the names of their columns.
struct RawTrack {
  std::string file;
  Place header;
  std::vector<std::string> names, units;
  std::vector<std::vector<double>> columns;
  std::vector<int> line_of_row;

  std::optional<std::size_t> find(std::string_view name) const {
    const auto at = std::find(names.begin(), names.end(), name);
    return at == names.end() ? std::nullopt : std::optional<std::size_t>(at - names.begin());
  }
  std::size_t need(const std::string& name) const {
    if (const auto at = find(name)) return *at;
    const std::string near = hydro::nearest(name, names);
    throw InputError(fmt::format("the track has no column \"{}\"", name), header,
                     near.empty() ? fmt::format("its columns are {}", fmt::join(names, ", "))
                                  : fmt::format("did you mean \"{}\"?", near));
  }
};

/// "bob_x [px]" as a name and a unit.
void add_name(std::string_view cell, RawTrack& out) {
  const auto open = cell.find_first_of("[("), close = cell.find_first_of("])");
  const bool has_unit = open != std::string_view::npos && close != std::string_view::npos && close > open;
  out.names.emplace_back(hydro::trimmed(cell.substr(0, has_unit ? open : cell.size())));
  out.units.emplace_back(has_unit ? hydro::trimmed(cell.substr(open + 1, close - open - 1)) : std::string_view());
}

/// Units in a line of their own.
void take_units(const std::vector<TableCell>& cells, RawTrack& out) {
  for (std::size_t c = 0; c < cells.size(); ++c) {
    std::string_view unit = cells[c].text;
    if (unit.starts_with('[') || unit.starts_with('(')) unit = hydro::trimmed(unit.substr(1, unit.size() - 2));
    if (out.units[c].empty() && unit != "-") out.units[c] = unit;
  }
}

void take_names(const std::vector<TableLine>& lines, std::size_t first_row, std::size_t count, char separator,
                const TrackColumns& asked, RawTrack& out) {
  if (!asked.names.empty()) {
    if (asked.names.size() != count)
      throw InputError(fmt::format("the rows have {} columns, {} names are given", count, asked.names.size()),
                       {out.file, lines[first_row].number, 0, std::string(lines[first_row].text), 0},
                       "name each column, in the order of the file");
    for (const std::string& name : asked.names) add_name(name, out);
    return;
  }
  std::vector<TableCell> units;
  for (std::size_t i = first_row; i-- > 0;) {
    const auto cells = hydro::io::table_cells(lines[i], separator, out.file);
    if (cells.size() != count) continue;
    if (i > 0 && units.empty() && hydro::io::is_units_row(cells) &&
        hydro::io::table_cells(lines[i - 1], separator, out.file).size() == count) {
      units = cells;
      continue;
    }
    out.header = {out.file, lines[i].number, 0, std::string(lines[i].text), 0};
    for (const auto& cell : cells) add_name(cell.plain(), out);
    take_units(units, out);
    return;
  }
  throw InputError("no line names the columns of this track",
                   {out.file, lines[first_row].number, 0, std::string(lines[first_row].text), 0},
                   fmt::format("name its {} columns in the scene: [data] columns = [\"x\", \"y\", ...]", count));
}

/// \throws hydro::InputError for text, and for a number that may be another one than it seems
double place_in(const TableCell& cell, const std::string& column, const TableLine& line, NumberNotation& notation,
                const std::string& file) {
  const auto place = [&] {
    return Place{file, line.number, cell.column, std::string(line.text), static_cast<int>(cell.text.size())};
  };
  const auto value = number_in(cell, notation);
  if (!value && hydro::io::has_thousands_marks(cell.text))
    throw hydro::io::thousands_marks_refused(cell.text, column).at(place());
  if (!value)
    throw InputError(fmt::format("\"{}\" is no number", cell.text), place(),
                     "leave the cell of a marker that was not seen empty; a second track needs a file of its own");
  if (!std::isnan(*value))
    if (const auto wrong = notation.objection(cell, column, line.number)) throw wrong->at(place());
  return *value;
}

/// How many cells there are up to the last that holds something.
std::size_t filled(const std::vector<TableCell>& cells) {
  std::size_t n = cells.size();
  while (n > 0 && cells[n - 1].text.empty()) --n;
  return n;
}

void take_rows(const std::vector<TableLine>& lines, std::size_t first, char separator, NumberNotation& notation,
               RawTrack& out) {
  const std::size_t count = out.columns.size();
  for (std::size_t i = first; i < lines.size(); ++i) {
    const auto cells = hydro::io::table_cells(lines[i], separator, out.file);
    if (cells.size() < count || filled(cells) > count)
      throw InputError(fmt::format("the row has {} cells, {} columns are named", cells.size(), count),
                       {out.file, lines[i].number, 0, std::string(lines[i].text), 0},
                       "leave the cell of a marker that was not seen empty");
    for (std::size_t c = 0; c < count; ++c)
      out.columns[c].push_back(place_in(cells[c], out.names[c], lines[i], notation, out.file));
    out.line_of_row.push_back(lines[i].number);
  }
}

RawTrack raw_track(std::string_view text, const std::string& file_name, const TrackColumns& asked) {
  RawTrack out{
      .file = file_name, .header = {.file = file_name}, .names = {}, .units = {}, .columns = {}, .line_of_row = {}};
  const auto lines = hydro::io::table_lines(hydro::io::table_text(text, file_name), "#%");
  if (lines.empty()) throw InputError("the track is empty", {.file = file_name}, "write rows of time and places");
  const char separator = separator_of(lines);
  NumberNotation notation(separator);
  const auto cells = [&](std::size_t i) { return hydro::io::table_cells(lines[i], separator, file_name); };
  std::size_t first = 0;
  while (first < lines.size() && !is_row(cells(first), notation)) ++first;
  if (first == lines.size())
    throw InputError("the track has no row of numbers", {.file = file_name}, "write rows of time and places");
  std::size_t count = cells(first).size();
  const auto has_names = [&] {
    for (std::size_t i = 0; i < first; ++i)
      if (cells(i).size() == count) return true;
    return asked.names.size() == count;
  };
  // A separator at the end of each row, and none after the names.
  while (count > 1 && !has_names() && cells(first)[count - 1].text.empty()) --count;
  take_names(lines, first, count, separator, asked, out);
  out.columns.resize(count);
  take_rows(lines, first, separator, notation, out);
  return out;
}

/// Columns are the one-dimensional datasets of the root.
RawTrack raw_track_of_hdf5(const std::filesystem::path& path, const TrackColumns& asked) {
  const hydro::io::Hdf5Reader file(path);
  RawTrack out{.file = path.string(),
               .header = {.file = path.string()},
               .names = {},
               .units = {},
               .columns = {},
               .line_of_row = {}};
  if (!asked.names.empty())
    throw InputError("an HDF5 file names its columns itself", out.header, "leave out [data] columns");
  for (const std::string& name : file.children("/")) {
    if (!file.has("/" + name) || file.is_text("/" + name)) continue;
    hydro::io::Array column = file.numbers("/" + name);
    if (column.shape.size() != 1) continue;
    if (!out.columns.empty() && column.values.size() != out.columns[0].size())
      throw InputError(fmt::format("the dataset /{} has {} rows, /{} has {}", name, column.values.size(), out.names[0],
                                   out.columns[0].size()),
                       out.header, "each frame is a row of every column");
    out.names.push_back(name);
    out.units.push_back(file.has_attribute("/" + name, "units") ? file.text_attribute("/" + name, "units") : "");
    out.columns.push_back(std::move(column.values));
  }
  if (out.columns.empty() || out.columns[0].empty())
    throw InputError("the track has no one-dimensional dataset with numbers", out.header,
                     "write time and places as datasets of the root, one a column");
  for (std::size_t i = 0; i < out.columns[0].size(); ++i) out.line_of_row.push_back(static_cast<int>(i + 1));
  return out;
}

bool is_pixel(const std::string& unit) { return unit == "px" || unit == "pixel" || unit == "pixels"; }

/// The marker that a column belongs to, and which of its numbers it is ("x", "y", "xx", "xy", "yy"); nothing for
/// others.
std::optional<std::pair<std::string, std::string>> role_of(const std::string& name) {
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const char* role : {"xx", "xy", "yy", "x", "y"}) {
    const std::string word = role;
    if (lower == word) return {{"marker", word}};
    const std::size_t n = lower.size(), m = word.size();
    if (n < m + 2) continue;
    const auto parts = [](char c) { return c == '_' || c == '.' || c == ' '; };
    if (lower.ends_with(word) && parts(lower[n - m - 1])) return {{name.substr(0, n - m - 1), word}};
    if (lower.starts_with(word) && parts(lower[m])) return {{name.substr(m + 1), word}};
  }
  return std::nullopt;
}

/// Columns of x, y and covariances of each marker, in the order in which they stand.
struct MarkerColumns {
  std::string name;
  std::map<std::string, std::size_t> at;  // role → column
};

std::vector<MarkerColumns> markers_of(const RawTrack& raw, const TrackColumns& asked) {
  std::vector<MarkerColumns> out;
  for (const auto& m : asked.markers) out.push_back({m.marker, {{"x", raw.need(m.x)}, {"y", raw.need(m.y)}}});
  if (!out.empty()) return out;
  for (std::size_t c = 0; c < raw.names.size(); ++c) {
    const auto role = role_of(raw.names[c]);
    if (!role) continue;
    auto at = std::find_if(out.begin(), out.end(), [&](const auto& m) { return m.name == role->first; });
    if (at == out.end()) at = out.insert(out.end(), {role->first, {}});
    at->at[role->second] = c;
  }
  std::erase_if(out, [](const auto& m) { return !m.at.contains("x") || !m.at.contains("y"); });
  if (out.empty())
    throw InputError(fmt::format("the track has no marker: its columns are {}", fmt::join(raw.names, ", ")), raw.header,
                     "name pairs of columns NAME_x, NAME_y, or say which they are: [[camera.marker]]");
  return out;
}

/// One question for all that has no unit.
void ask_for_units(const RawTrack& raw, const std::vector<MarkerColumns>& markers, const TrackColumns& asked) {
  std::vector<std::string> without;
  const bool no_time =
      asked.frames_per_second == 0 && raw.units[raw.need(asked.time)].empty() && asked.time_unit.empty();
  if (no_time) without.push_back(asked.time);
  bool no_place = false;
  for (const auto& m : markers)
    for (const char* role : {"x", "y"})
      if (const std::size_t c = m.at.at(role); raw.units[c].empty() && asked.position_unit.empty()) {
        no_place = true;
        without.push_back(raw.names[c]);
      }
  if (without.empty()) return;
  throw InputError(
      fmt::format("in which units are the columns {}? The file does not say", fmt::join(without, ", ")), raw.header,
      fmt::format("say it in the scene: [data] units = {{ {}{}{} }}, or \"mm\" in place of \"px\"",
                  no_time ? "time = \"s\"" : "", no_time && no_place ? ", " : "", no_place ? "position = \"px\"" : ""));
}

std::vector<double> times_of(const RawTrack& raw, const TrackColumns& asked) {
  std::vector<double> out;
  if (asked.frames_per_second > 0) {
    for (std::size_t i = 0; i < raw.line_of_row.size(); ++i)
      out.push_back(static_cast<double>(i) / asked.frames_per_second);
    return out;
  }
  const std::size_t c = raw.need(asked.time);
  const std::string& unit = raw.units[c].empty() ? asked.time_unit : raw.units[c];
  const double factor = [&] {
    try {
      return hydro::parse_si("1 " + unit, hydro::dim::time);
    } catch (const InputError& e) {
      throw InputError(fmt::format("column \"{}\": {}", raw.names[c], e.rule()), raw.header, "write s or ms");
    }
  }();
  for (std::size_t i = 0; i < raw.columns[c].size(); ++i) {
    const double t = factor * raw.columns[c][i];
    const Place place{raw.file, raw.line_of_row[i], 0, {}, 0};
    if (std::isnan(t)) throw InputError("the row has no time", place, "each frame needs its time");
    if (!out.empty() && !(t > out.back()))
      throw InputError(
          fmt::format("time goes from {:.9g} s to {:.9g} s", out.back(), t), place,
          "times must increase: give a second run a file of its own, and leave out frames that stand twice");
    out.push_back(t);
  }
  return out;
}

/// What one of a column's numbers is in px or m; px² or m² of a covariance.
double factor_of(const RawTrack& raw, std::size_t c, const TrackColumns& asked, bool squared, bool& in_metres) {
  std::string unit = raw.units[c];
  if (unit.empty()) unit = asked.position_unit + (squared ? "^2" : "");
  const bool pixels = is_pixel(squared && unit.ends_with("^2") ? unit.substr(0, unit.size() - 2) : unit);
  in_metres = !pixels;
  if (pixels) return 1;
  try {
    return hydro::parse_si("1 " + unit, squared ? hydro::dim::area : hydro::dim::length);
  } catch (const InputError& e) {
    throw InputError(fmt::format("column \"{}\": {}", raw.names[c], e.rule()), raw.header,
                     "write px, or a length: mm, m");
  }
}

Marker marker_of(const RawTrack& raw, const MarkerColumns& columns, const TrackColumns& asked, Track& track) {
  Marker out{columns.name, {}};
  bool metres[2];
  double factor[2];
  const std::size_t x = columns.at.at("x"), y = columns.at.at("y");
  factor[0] = factor_of(raw, x, asked, false, metres[0]);
  factor[1] = factor_of(raw, y, asked, false, metres[1]);
  if (metres[0] != metres[1] || (!track.markers.empty() && metres[0] != track.in_metres))
    throw InputError(fmt::format("marker \"{}\" mixes pixels and metres", columns.name), raw.header,
                     "all places of a track are in one unit");
  track.in_metres = metres[0];
  const bool errors = columns.at.contains("xx") && columns.at.contains("xy") && columns.at.contains("yy");
  for (std::size_t i = 0; i < raw.line_of_row.size(); ++i) {
    out.seen.emplace_back();
    const Eigen::Vector2d at(factor[0] * raw.columns[x][i], factor[1] * raw.columns[y][i]);
    if (!at.allFinite()) continue;
    Sighting s{.at = at};
    if (errors) {
      const auto entry = [&](const char* role) {
        bool unused = false;
        const std::size_t c = columns.at.at(role);
        return factor_of(raw, c, asked, true, unused) * raw.columns[c][i];
      };
      Eigen::Matrix2d told;
      told << entry("xx"), entry("xy"), entry("xy"), entry("yy");
      if (told.array().isNaN().all()) {
        out.seen.back() = s;
        continue;
      }
      s.covariance = told;
      if (!(s.covariance(0, 0) > 0 && s.covariance.determinant() > 0))
        throw InputError(fmt::format("the covariance of marker \"{}\" is none", columns.name),
                         {raw.file, raw.line_of_row[i], 0, {}, 0}, "xx, yy and xx yy - xy^2 must be positive");
    }
    out.seen.back() = s;
  }
  return out;
}

}  // namespace

namespace {

Track track_of(const RawTrack& raw, const TrackColumns& asked) {
  const auto markers = markers_of(raw, asked);
  ask_for_units(raw, markers, asked);
  Track out;
  out.time = times_of(raw, asked);
  for (const auto& m : markers) out.markers.push_back(marker_of(raw, m, asked, out));
  return out;
}

/// A column as it is written; NaN is an empty cell.
struct WrittenColumn {
  std::string name, unit;
  int digits;
  std::vector<double> values = {};
};

std::vector<WrittenColumn> columns_of(const Track& track) {
  const std::string unit = track.in_metres ? "m" : "px", squared = unit + "^2";
  std::vector<WrittenColumn> out{{"t", "s", 9, track.time}};
  for (const Marker& m : track.markers) {
    std::array<WrittenColumn, 5> own{{{m.name + "_x", unit, 8},
                                      {m.name + "_y", unit, 8},
                                      {m.name + "_xx", squared, 6},
                                      {m.name + "_xy", squared, 6},
                                      {m.name + "_yy", squared, 6}}};
    for (const auto& s : m.seen) {
      const bool errors = s && s->has_covariance();
      const double all[] = {s ? s->at.x() : unseen, s ? s->at.y() : unseen, errors ? s->covariance(0, 0) : unseen,
                            errors ? s->covariance(0, 1) : unseen, errors ? s->covariance(1, 1) : unseen};
      for (std::size_t c = 0; c < own.size(); ++c) own[c].values.push_back(all[c]);
    }
    out.insert(out.end(), std::make_move_iterator(own.begin()), std::make_move_iterator(own.end()));
  }
  return out;
}

std::string size_of(const Track& track) { return fmt::format("{} x {} px", track.size.x(), track.size.y()); }

void write_hdf5(const std::filesystem::path& path, const Track& track, const std::vector<std::string>& comments) {
  hydro::io::Hdf5Writer file;
  for (const WrittenColumn& c : columns_of(track)) {
    const std::string dataset = "/" + c.name;
    file.write(dataset, c.values, {c.values.size()});
    file.attribute(dataset, "units", c.unit);
    if (c.name == "t")
      file.make_dimension(dataset);
    else
      file.attach_dimension(dataset, 0, "/t");
  }
  file.attribute("/", "comment", fmt::format("{}", fmt::join(comments, "\n")));
  if (track.size.x() > 0) file.attribute("/", "picture", size_of(track));
  file.save(path);
}

void write_csv(const std::filesystem::path& path, const Track& track, const std::vector<std::string>& comments) {
  fmt::memory_buffer out;
  const auto add = [&]<class... Args>(fmt::format_string<Args...> text, Args&&... args) {
    fmt::format_to(std::back_inserter(out), text, std::forward<Args>(args)...);
  };
  for (const std::string& comment : comments) add("# {}\n", comment);
  if (track.size.x() > 0) add("# picture: {}\n", size_of(track));
  const auto columns = columns_of(track);
  const auto add_row = [&](const auto& cell) {
    for (std::size_t c = 0; c < columns.size(); ++c) add("{}{}", c > 0 ? "," : "", cell(columns[c]));
    add("\n");
  };
  add_row([](const WrittenColumn& c) { return fmt::format("{} [{}]", c.name, c.unit); });
  for (std::size_t i = 0; i < track.frames(); ++i)
    add_row([&](const WrittenColumn& c) {
      return std::isnan(c.values[i]) ? std::string() : fmt::format("{:.{}g}", c.values[i], c.digits);
    });
  hydro::io::write_atomically(path, std::string_view(out.data(), out.size()));
}

}  // namespace

Track parse_track(std::string_view text, const std::string& file_name, const TrackColumns& asked) {
  Track out = track_of(raw_track(text, file_name, asked), asked);
  out.size = size_in(text, "# picture: ");
  return out;
}

Track read_track(const std::filesystem::path& path, const TrackColumns& columns) {
  if (!hydro::io::is_hdf5(path)) return parse_track(hydro::io::read_text(path), path.string(), columns);
  Track out = track_of(hydro::io::read_tried(path, [&] { return raw_track_of_hdf5(path, columns); }), columns);
  const hydro::io::Hdf5Reader file(path);
  if (file.has_attribute("/", "picture")) out.size = size_in(file.text_attribute("/", "picture"), "");
  return out;
}

void write_track(const std::filesystem::path& path, const Track& track, const std::vector<std::string>& comments) {
  const auto ending = path.extension();
  if (ending == ".h5" || ending == ".nc")
    write_hdf5(path, track, comments);
  else
    write_csv(path, track, comments);
}

}  // namespace fit::camera
