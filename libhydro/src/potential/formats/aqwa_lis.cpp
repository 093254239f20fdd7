#include <algorithm>
#include <array>
#include <cmath>

#include "aqwa.hpp"
#include "potential/readers.hpp"
#include "text_lines.hpp"

namespace hydro::potential {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view parameters_title = "P A R A M E T E R S   F O R   S T R U C T U R E";
constexpr std::string_view limits_title = "A T   L O W   &   H I G H   F R E Q U E N C I E S";
constexpr std::string_view forces_title = "FROUDE KRYLOV + DIFFRACTION FORCES-VARIATION WITH WAVE PERIOD/FREQUENCY";

int line_of(const TextLines& text, std::string_view label, int from = 1) {
  const int line = text.find(label, from);
  if (line == 0)
    throw InputError(fmt::format("there is no \"{}\"", label), {.file = text.path().string()},
                     "the file may be cut short, or be of another stage of AQWA than LINE 1 to 3");
  return line;
}

/// The number behind `label` and an equals sign, as in `DENSITY  OF  WATER  . . . =    1025.000`.
double value_of(const TextLines& text, int line, std::string_view label) {
  const std::string& all = text.line(line);
  const auto equals = all.find('=', all.find(label));
  std::string rest = equals == std::string::npos ? "" : all.substr(equals + 1);
  rest.resize(std::min(rest.size(), rest.find('(')));  // "0.0010(RAD/S)"
  const auto words = words_of(rest);
  const auto value = words.empty() ? std::nullopt : fortran_number(words.front());
  if (!value || !std::isfinite(*value)) text.refuse(line, fmt::format("there is no number for \"{}\"", label));
  return *value;
}

Water read_water(const TextLines& text) {
  const int depth = line_of(text, "WATER  DEPTH"), density = line_of(text, "DENSITY  OF  WATER"),
            gravity = line_of(text, "ACCELERATION  DUE  TO GRAVITY");
  const Water water{value_of(text, density, "DENSITY  OF  WATER"), value_of(text, gravity, "ACCELERATION"),
                    WaterDepth::from_metres(value_of(text, depth, "WATER  DEPTH"))};
  if (!(water.density > 0)) text.refuse(density, "the density must be positive");
  if (!(water.gravity > 0)) text.refuse(gravity, "gravity must be positive");
  return water;
}

/// Rows X, Y, Z, RX, RY, RZ below a title, with blank lines between them.
Matrix6 read_matrix(const TextLines& text, std::string_view title, int from) {
  constexpr std::array<std::string_view, 6> rows{"X", "Y", "Z", "RX", "RY", "RZ"};
  constexpr int farthest = 30;  // a page never has more lines between a title and the end of its matrix
  const int start = line_of(text, title, from);
  Matrix6 m;
  std::size_t row = 0;
  for (int line = start + 1; row < 6; ++line) {
    if (line > text.count() || line > start + farthest)
      text.refuse(start, fmt::format("the matrix has {} rows; six are needed", row), "the file may be cut short");
    const auto words = text.words(line);
    if (words.empty() || words.front() != rows[row] || (words.size() > 1 && !fortran_number(words[1]))) continue;
    for (std::size_t j = 0; j < 6; ++j)
      m(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(j)) = text.number(line, j + 1, "an entry");
    ++row;
  }
  return m;
}

/// Frequencies of the table `WAVE FREQUENCIES/PERIODS AND DIRECTIONS`, which has more digits than the results.
std::vector<double> read_frequencies(const TextLines& text) {
  std::vector<double> omega;
  int line = line_of(text, "STRUCTURE    FREQUENCY FREQUENCY") + 3;
  for (; line <= text.count(); ++line) {
    const auto words = text.words(line);
    const std::size_t first = omega.empty() ? 1 : 0;  // the first row begins with the structure
    if (words.empty() || !fortran_number(words.front())) break;
    if (text.whole(line, first, "the number of a frequency", 1) != static_cast<int>(omega.size()) + 1)
      text.refuse(line, "the frequencies are not numbered one after another");
    omega.push_back(text.number(line, first + 1, "a frequency"));
  }
  if (omega.empty()) text.refuse(std::min(line, text.count()), "there is no frequency", "the file may be cut short");
  return omega;
}

void read_body(Coefficients& c, const TextLines& text) {
  const auto coordinates = [&](int line, const std::array<const char*, 3>& labels, int step) {
    Eigen::Vector3d p;
    for (int i = 0; i < 3; ++i) {
      if (line + i * step > text.count()) text.refuse_end(labels[static_cast<std::size_t>(i)]);
      const std::string& all = text.line(line + i * step);
      const auto at = all.find(labels[static_cast<std::size_t>(i)]);
      if (at == std::string::npos)
        text.refuse(line + i * step, fmt::format("\"{}\" is missing", labels[static_cast<std::size_t>(i)]));
      p(i) = value_of(text, line + i * step, labels[static_cast<std::size_t>(i)]);
    }
    return p;
  };
  BodyData& body = c.body.emplace_back();
  body.name = "structure1";
  const int gravity = line_of(text, "STRUCTURE C.O.G.");
  body.centre_of_gravity = coordinates(gravity, {"GX=", "GY=", "GZ="}, 0);
  body.reference_point = body.centre_of_gravity;  // (P22)
  const int displacement = line_of(text, "MESH BASED DISPLACEMENT", gravity);
  body.displaced_volume = value_of(text, displacement, "MESH BASED DISPLACEMENT");
  body.centre_of_buoyancy =
      coordinates(line_of(text, "POSITION OF THE CENTRE OF BUOYANCY", gravity), {"BX =", "BY =", "BZ ="}, 1);
}

/// The k-th matrices belong to the k-th frequency; the four decimals printed above them must agree.
void fill_radiation(Coefficients& c, const TextLines& text) {
  int line = 1;
  for (const double omega : c.omega) {
    line = line_of(text, "WAVE PERIOD =", line + 1);
    constexpr double printed = 1.1e-4;
    if (std::abs(value_of(text, line, "WAVE FREQUENCY") - omega) > printed)
      text.refuse(line, fmt::format("these results should be of {} rad/s", omega), "the file may be cut or mixed");
    c.A.push_back(read_matrix(text, "ADDED  MASS", line));
    c.B.push_back(read_matrix(text, " DAMPING", line));
  }
  if (const int limits = text.find(limits_title); limits != 0) {
    const int low = line_of(text, "WAVE FREQUENCY =", limits), high = line_of(text, "WAVE FREQUENCY =", low + 1);
    if (!(value_of(text, low, "WAVE FREQUENCY") < c.omega.front() &&
          value_of(text, high, "WAVE FREQUENCY") > c.omega.back()))
      text.refuse(low, "these two frequencies should be below and above all others");
    c.A_zero = read_matrix(text, "ADDED MASS", low);
    c.A_inf = read_matrix(text, "ADDED MASS", high);
    c.notes.emplace_back("A(0) and A(∞) are AQWA's added mass at a low and a high frequency, not at the limits");
  }
}

struct ForceRows {
  std::vector<double> heading_deg;
  std::vector<std::vector<std::array<double, 12>>> row;  ///< [heading][frequency]: amplitude and lag of six modes
};

/// Rows `period ω [heading] amplitude lag …` of all pages; a heading stands in the first of its rows only.
ForceRows read_forces(const TextLines& text, const std::vector<double>& omega) {
  ForceRows out;
  for (int title = line_of(text, forces_title); title != 0; title = text.find(forces_title, title + 1))
    for (int line = title + 1; line <= text.count(); ++line) {
      const auto words = text.words(line);
      if (words.size() == 1 && words.front() == "1") break;  // the next page
      if (words.empty() || !fortran_number(words.front())) continue;
      if (words.size() != 14 && words.size() != 15)
        text.refuse(line, fmt::format("the row has {} numbers; 14 or 15 are needed", words.size()));
      const auto v = text.numbers(line, words.size(), "a load");
      if (words.size() == 15) {
        out.heading_deg.push_back(v[2]);
        out.row.emplace_back();
      }
      constexpr double printed = 1.1e-3;
      if (out.row.empty() || out.row.back().size() >= omega.size() ||
          std::abs(v[1] - omega[out.row.back().size()]) > printed)
        text.refuse(line, "this frequency is not the next one of the file", "the file may be cut or mixed");
      std::copy(v.end() - 12, v.end(), out.row.back().emplace_back().begin());
    }
  for (std::size_t h = 0; h < out.row.size(); ++h)
    if (out.row[h].size() != omega.size())
      throw InputError(
          fmt::format("heading {} deg has {} rows of {}", out.heading_deg[h], out.row[h].size(), omega.size()),
          {.file = text.path().string()}, "the file may be cut short");
  return out;
}

/// The line `DIRECTIONS   1   2   3` counts the headings; loads must be there for all of them.
void require_announced_headings(const TextLines& text, const ForceRows& forces) {
  const int line = line_of(text, "DIRECTIONS   1");
  const double announced = fortran_number(text.words(line).back()).value_or(0);
  if (static_cast<double>(forces.heading_deg.size()) < announced)
    text.refuse(
        line,
        fmt::format("{} headings are announced, but there are loads for {}", announced, forces.heading_deg.size()),
        "the file may be cut short");
}

void fill_excitation(Coefficients& c, const TextLines& text) {
  const ForceRows forces = read_forces(text, c.omega);
  require_announced_headings(text, forces);
  std::vector<double> heading;
  for (const double degrees : forces.heading_deg) heading.push_back(Angle::from_degrees(degrees).radians());
  const auto order = order_headings(heading, text.path());
  c.heading = picked(heading, order);
  c.X.assign(order.size(), Eigen::MatrixXcd(6, static_cast<Eigen::Index>(c.omega.size())));
  for (std::size_t b = 0; b < order.size(); ++b)
    for (std::size_t k = 0; k < c.omega.size(); ++k)
      for (std::size_t i = 0; i < 6; ++i) {
        const auto& row = forces.row[order[b]][k];
        c.X[b](static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
            aqwa_load(row[2 * i], row[2 * i + 1], c.omega[k], c.heading[b], *c.body[0].centre_of_gravity, c.water);
      }
}

Coefficients read_aqwa_lis(const fs::path& path) {
  const TextLines text = TextLines::read(path);
  for (int line = text.find(parameters_title); line != 0; line = text.find(parameters_title, line + 1))
    if (text.words(line).size() < 5 || !text.contains(line, "S T R U C T U R E   1 "))
      text.refuse(line, "there are several structures", "give the .AH1 file of the run, which holds their coupling");
  line_of(text, "FINISH DATE");  // the last page: without it any part may be missing
  Coefficients c;
  c.water = read_water(text);
  c.source = fmt::format("AQWA .LIS file {}", path.string());
  c.omega = read_frequencies(text);
  read_body(c, text);
  fill_radiation(c, text);
  c.C = read_matrix(text, "STIFFNESS MATRIX", line_of(text, parameters_title));
  fill_excitation(c, text);
  c.notes.emplace_back("a .LIS file has three digits of the loads: the .AH1 file of the same run has more");
  return c;
}

}  // namespace

const Format aqwa_lis_files{[](const Candidate& c) { return c.has("JOB AQWA"); },
                            [](const fs::path& path, const ReadOptions&) { return read_aqwa_lis(path); }};

}  // namespace hydro::potential
