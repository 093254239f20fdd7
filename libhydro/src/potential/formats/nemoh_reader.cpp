#include <cmath>
#include <numbers>

#include "capytaine.hpp"
#include "hydro/waves/dispersion.hpp"
#include "nemoh.hpp"
#include "potential/readers.hpp"
#include "text_lines.hpp"

namespace hydro::potential {
namespace {

namespace fs = std::filesystem;
constexpr double two_pi = 2 * std::numbers::pi;

enum class FrequencyColumn { rad_per_s, hertz, period };

FrequencyColumn frequency_column(const TextLines& text) {
  for (int line = 1; line <= text.count(); ++line) {
    if (text.contains(line, "(Hz)")) return FrequencyColumn::hertz;
    if (text.contains(line, "(s)")) return FrequencyColumn::period;
    if (text.contains(line, "(rad/s)")) break;
  }
  return FrequencyColumn::rad_per_s;
}

double to_omega(double value, FrequencyColumn column) {
  switch (column) {
    case FrequencyColumn::hertz:
      return two_pi * value;
    case FrequencyColumn::period:
      return two_pi / value;
    case FrequencyColumn::rad_per_s:
      break;
  }
  return value;
}

/// The number of rows that a zone announces by "I= 308", if it does.
std::optional<double> announced_rows(const std::string& title) {
  const auto at = title.find(",I=");
  if (at == std::string::npos) return std::nullopt;
  std::string rest = title.substr(at + 3);
  rest.resize(std::min(rest.size(), rest.find(',')));
  const auto words = words_of(rest);
  return words.empty() ? std::nullopt : fortran_number(words.front());
}

void require_whole_zone(const NemohTable& table) {
  const TextLines& text = table.text;
  const NemohZone& zone = table.zone.back();
  if (const auto rows = announced_rows(zone.title); rows && *rows != static_cast<double>(zone.line.size()))
    text.refuse(zone.title_line, fmt::format("the zone announces {} rows, but has {}", *rows, zone.line.size()),
                "the file may be cut short");
  if (zone.line.size() != table.omega.size())
    text.refuse(zone.title_line,
                fmt::format("the zone has {} frequencies; the first one of the file has {}", zone.line.size(),
                            table.omega.size()),
                "the file may be cut short");
}

void add_row(NemohTable& table, int line, FrequencyColumn column, std::size_t values) {
  const TextLines& text = table.text;
  if (text.words(line).size() != values + 1)
    text.refuse(
        line,
        fmt::format("the row has {} numbers; a frequency and {} values are needed", text.words(line).size(), values),
        "the file may be cut short, or be of another number of bodies than Nemoh.cal");
  auto row = text.numbers(line, values + 1, "a frequency or a value");
  const double omega = to_omega(row.front(), column);
  NemohZone& zone = table.zone.back();
  const std::size_t k = zone.line.size();
  if (table.zone.size() == 1) {
    table.omega.push_back(omega);
  } else if (k >= table.omega.size() || std::abs(omega - table.omega[k]) > 1e-6 * std::abs(omega)) {
    throw InputError("the frequencies of this zone are not those of the first one", text.place(line, 0),
                     "the file may be mixed from two runs");
  }
  row.erase(row.begin());
  zone.line.push_back(line);
  zone.value.push_back(std::move(row));
}

}  // namespace

NemohTable read_nemoh_table(const fs::path& path, std::size_t values_in_row) {
  NemohTable table{.text = TextLines::read(path), .omega = {}, .zone = {}};
  const TextLines& text = table.text;
  const FrequencyColumn column = frequency_column(text);
  int title = 0;  // the last line that is no row of numbers; the zone's title once a row follows
  for (int line = 1; line <= text.count(); ++line) {
    const auto words = text.words(line);
    if (words.empty()) continue;
    if (!fortran_number(words.front())) {
      title = line;
      continue;
    }
    if (title == 0) text.refuse(line, "a row of numbers before any title of a zone", "give a file that NEMOH wrote");
    if (table.zone.empty() || table.zone.back().title_line != title) {
      if (!table.zone.empty()) require_whole_zone(table);
      table.zone.push_back({text.line(title), title, {}, {}});
    }
    add_row(table, line, column, values_in_row);
  }
  if (table.zone.empty()) text.refuse_end("the first zone");
  require_whole_zone(table);
  if (title > table.zone.back().line.back()) text.refuse(title, "the zone has no rows", "the file may be cut short");
  return table;
}

namespace {

/// The mode of motion that each zone of RadiationCoefficients.tec belongs to, from 0 through all bodies.
std::vector<Eigen::Index> motions_of_zones(const NemohTable& table, Eigen::Index modes) {
  const TextLines& text = table.text;
  if (static_cast<Eigen::Index>(table.zone.size()) != modes)
    throw InputError(fmt::format("there are {} zones; one for each of {} motions is needed", table.zone.size(), modes),
                     {.file = text.path().string()}, "the file may be cut short, or be of another run than Nemoh.cal");
  std::vector<std::string> labels;  // Capytaine's writer names motions by its own labels
  std::vector<Eigen::Index> motion;
  for (const NemohZone& zone : table.zone) {
    if (zone.title.find("Motion of body") == std::string::npos) {
      labels.push_back(zone.title);
      continue;
    }
    std::string title = zone.title;  // Zone t="Motion of body    1 in DoF   2",I=  308,F=POINT
    for (char& character : title)
      if (character == '"' || character == ',') character = ' ';
    const auto words = words_of(title);
    const auto body = words.size() > 7 ? fortran_number(words[5]) : std::nullopt,
               dof = words.size() > 8 ? fortran_number(words[8]) : std::nullopt;
    if (!body || !dof || !(*dof >= 1 && *dof <= 6) || !(*body >= 1 && 6 * *body <= static_cast<double>(modes)))
      text.refuse(zone.title_line, "the title does not name a motion of the bodies in Nemoh.cal");
    motion.push_back(6 * (static_cast<Eigen::Index>(*body) - 1) + static_cast<Eigen::Index>(*dof) - 1);
  }
  if (labels.size() == table.zone.size()) {
    const auto order = order_dofs(labels, text.path(), "zones").index_in_file;
    motion.resize(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) motion[order[i]] = static_cast<Eigen::Index>(i);
  }
  std::vector<int> seen(static_cast<std::size_t>(modes), 0);
  for (std::size_t z = 0; z < motion.size(); ++z)
    if (seen[static_cast<std::size_t>(motion[z])]++ > 0)
      text.refuse(table.zone[z].title_line, fmt::format("{} is there twice", mode_label(motion[z])));
  return motion;
}

/// Zones are motions, columns are loads: `ω A B A B …` (P20). Returns the order of the frequencies in the file.
FrequencyOrder fill_radiation(Coefficients& c, const fs::path& path) {
  const Eigen::Index n = c.modes();
  const NemohTable table = read_nemoh_table(path, static_cast<std::size_t>(2 * n));
  const auto motion = motions_of_zones(table, n);
  const FrequencyOrder order = order_frequencies(table.omega, path);
  if (order.zero || order.infinite)
    throw InputError("a frequency of zero or a period of zero in NEMOH's results", {.file = path.string()},
                     "NEMOH computes no limits: take these rows out");
  c.omega = picked(table.omega, order.finite);
  c.A.assign(c.omega.size(), Eigen::MatrixXd::Zero(n, n));
  c.B = c.A;
  for (std::size_t z = 0; z < table.zone.size(); ++z)
    for (std::size_t k = 0; k < order.finite.size(); ++k)
      for (Eigen::Index load = 0; load < n; ++load) {
        const auto& row = table.zone[z].value[order.finite[k]];
        c.A[k](load, motion[z]) = row[static_cast<std::size_t>(2 * load)];
        c.B[k](load, motion[z]) = row[static_cast<std::size_t>(2 * load + 1)];
      }
  return order;
}

/// The heading that a zone names: degrees behind "beta =", radians behind "angle=" (Capytaine's writer).
double heading_of(const NemohZone& zone, const TextLines& text) {
  const auto behind = [&](const std::string& label) -> std::optional<double> {
    const auto at = zone.title.find(label);
    if (at == std::string::npos) return std::nullopt;
    std::string rest = zone.title.substr(at + label.size());
    rest.resize(std::min(rest.size(), rest.find_first_of(",\"")));
    const auto words = words_of(rest);
    return words.empty() ? std::nullopt : fortran_number(words.front());
  };
  if (const auto degrees = behind("beta =")) return Angle::from_degrees(*degrees).radians();
  if (const auto radians = behind("angle=")) return *radians;
  text.refuse(zone.title_line, "the title of the zone names no heading", "it should hold \"beta = … deg\"");
}

/// Adds |F| e^{−iφ} e^{−ik·r} to c.X: the file is written for e^{−iωt} (P7), with the wave's phase zero at r (P20).
void add_force(Coefficients& c, const NemohCase& nemoh, const fs::path& path, const FrequencyOrder& order) {
  const Eigen::Index n = c.modes();
  const NemohTable table = read_nemoh_table(path, static_cast<std::size_t>(2 * n));
  if (static_cast<int>(table.zone.size()) != nemoh.headings)
    throw InputError(
        fmt::format("there are {} zones, but Nemoh.cal has {} wave directions", table.zone.size(), nemoh.headings),
        {.file = path.string()}, "the file may be cut short, or be of another run than Nemoh.cal");
  std::vector<double> heading;
  for (const NemohZone& zone : table.zone) heading.push_back(heading_of(zone, table.text));
  const auto by_heading = order_headings(heading, path);
  if (c.heading.empty()) {
    c.heading = picked(heading, by_heading);
    c.X.assign(heading.size(), Eigen::MatrixXcd::Zero(n, static_cast<Eigen::Index>(c.omega.size())));
  }
  if (table.omega.size() != c.omega.size() || picked(heading, by_heading) != c.heading)
    throw InputError("the frequencies or headings are not those of the other files", {.file = path.string()},
                     "the files must come from one run");
  for (std::size_t b = 0; b < by_heading.size(); ++b)
    for (std::size_t k = 0; k < c.omega.size(); ++k) {
      const std::size_t row = order.finite[k];
      if (std::abs(table.omega[row] - c.omega[k]) > 1e-6 * c.omega[k])
        throw InputError("the frequency is not that of RadiationCoefficients.tec",
                         table.text.place(table.zone[by_heading[b]].line[row], 0), "the files must come from one run");
      const double along =
          std::cos(c.heading[b]) * nemoh.wave_origin.x() + std::sin(c.heading[b]) * nemoh.wave_origin.y();
      const double turn = along == 0 ? 0 : waves::wavenumber(c.omega[k], c.water) * along;
      const auto& value = table.zone[by_heading[b]].value[row];
      for (Eigen::Index i = 0; i < n; ++i)
        c.X[b](i, static_cast<Eigen::Index>(k)) += std::polar(1.0, -value[static_cast<std::size_t>(2 * i + 1)] - turn) *
                                                   value[static_cast<std::size_t>(2 * i)];
    }
}

void fill_excitation(Coefficients& c, const NemohCase& nemoh, const FrequencyOrder& order) {
  const auto result = [&](const char* name) { return find_nemoh_file(nemoh, {"Results", ""}, name); };
  if (const fs::path path = result("ExcitationForce.tec"); !path.empty()) return add_force(c, nemoh, path, order);
  const fs::path diffraction = result("DiffractionForce.tec"), krylov = result("FKForce.tec");
  if (diffraction.empty() || krylov.empty()) {
    c.notes.push_back("no excitation: there is neither ExcitationForce.tec nor both of its parts");
    return;
  }
  add_force(c, nemoh, diffraction, order);
  add_force(c, nemoh, krylov, order);
  c.notes.push_back("excitation is the sum of DiffractionForce.tec and FKForce.tec");
}

/// Nemoh.cal, from itself, from a file of results or from the folder.
fs::path find_cal(const fs::path& path) {
  if (!fs::is_directory(path) && path.extension() == ".cal") return path;
  const fs::path start = fs::is_directory(path) ? path : fs::absolute(path).parent_path();
  for (const fs::path& folder : {start, start.parent_path()})
    if (const fs::path cal = entry_of(folder, "Nemoh.cal"); !cal.empty()) return cal;
  throw InputError(fmt::format("there is no Nemoh.cal for \"{}\"", path.string()), {},
                   "the water and the points of the bodies are in it: put it into the folder above the results");
}

Coefficients read_nemoh(const fs::path& path) {
  const fs::path cal = find_cal(path);
  const NemohCase nemoh = read_nemoh_case(cal);
  Coefficients c;
  c.water = nemoh.water;
  c.source = fmt::format("NEMOH case {}", cal.string());
  for (std::size_t b = 0; b < nemoh.reference_point.size(); ++b) {
    c.body.emplace_back();
    c.body.back().name = fmt::format("body{}", b + 1);
    c.body.back().reference_point = nemoh.reference_point[b];
  }
  const fs::path radiation = find_nemoh_file(nemoh, {"Results", ""}, "RadiationCoefficients.tec");
  if (radiation.empty())
    throw InputError("there is no RadiationCoefficients.tec in the folder \"Results\" beside Nemoh.cal",
                     {.file = cal.string()}, "run NEMOH's postprocessor, or put the file there");
  fill_excitation(c, nemoh, fill_radiation(c, radiation));
  fill_nemoh_hydrostatics(c, nemoh);
  return c;
}

}  // namespace

const Format nemoh_files{[](const Candidate& c) {
                           const std::string_view first = c.first_line();
                           if (c.is_folder) return !entry_of(c.path, "Nemoh.cal").empty();
                           return (first.starts_with("---") && first.find("Environment") != std::string_view::npos) ||
                                  first.find("VARIABLES=") != std::string_view::npos || first.starts_with("...");
                         },
                         [](const fs::path& path, const ReadOptions&) { return read_nemoh(path); }};

}  // namespace hydro::potential
