#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <numbers>

#include "potential/readers.hpp"
#include "text_lines.hpp"
#include "wamit.hpp"

// WAMIT's .out file by itself: the tables that it prints for people, normalised as the numeric files are (P8), (P34).

namespace hydro::potential {
namespace {

namespace fs = std::filesystem;

/// From one "Wave period" to the next: lines [begin, end).
struct Section {
  int begin, end;
  double omega;  ///< rad/s; 0 and ∞ of the limits
};

/// "Wave period (sec) = 5.0", or "= infinite", or "= zero".
double omega_of(const TextLines& text, int line) {
  const auto words = words_of(std::string_view(text.line(line)).substr(text.line(line).find('=') + 1));
  if (words.empty()) text.refuse(line, "there is no period");
  if (words.front() == "infinite") return 0;
  if (words.front() == "zero") return std::numeric_limits<double>::infinity();
  const auto period = fortran_number(words.front());
  if (!period || !(*period > 0)) text.refuse(line, "the period must be positive");
  return 2 * std::numbers::pi / *period;
}

std::vector<Section> sections_of(const TextLines& text) {
  std::vector<Section> out;
  for (int line = text.find("Wave period"); line != 0; line = text.find("Wave period", line + 1)) {
    if (text.line(line).find('=') == std::string::npos) continue;
    if (!out.empty()) out.back().end = line;
    out.push_back({line, text.count() + 1, omega_of(text, line)});
  }
  if (out.empty())
    throw InputError("there are no results: no \"Wave period =\"", {.file = text.path().string()},
                     "give the .out file of WAMIT's second program, FORCE");
  return out;
}

/// The line within the section, or 0.
int find_in(const TextLines& text, const Section& section, std::string_view label) {
  const int line = text.find(label, section.begin);
  return line < section.end ? line : 0;
}

/// The first line of the table whose head contains `head`, at `line` or behind.
int rows_behind(const TextLines& text, int line, int end, std::string_view head) {
  line = text.find(head, line) + 1;
  while (line > 1 && line < end && text.words(line).empty()) ++line;
  if (line <= 1 || line >= end) text.refuse_end(fmt::format("a table of {}", head));
  return line;
}

struct Radiation {
  Eigen::MatrixXd A, B;
};

/// A and B of a section, dimensionless; limits have no B.
Radiation read_radiation(const TextLines& text, const Section& section, Eigen::Index modes) {
  const int head = find_in(text, section, "ADDED-MASS");
  if (head == 0) text.refuse(section.begin, "there is no added mass at this period", "run FORCE with IOPTN(1) = 1");
  const bool limit = section.omega == 0 || std::isinf(section.omega);
  Radiation out{Eigen::MatrixXd::Zero(modes, modes), Eigen::MatrixXd::Zero(modes, modes)};
  for (int line = rows_behind(text, head, section.end, "A(I,J)"); line < section.end && !text.words(line).empty();
       ++line) {
    const int i = text.whole(line, 0, "the mode I", 1), j = text.whole(line, 1, "the mode J", 1);
    if (std::max(i, j) > modes)
      text.refuse(line, fmt::format("mode {} is one too many for {} bodies", std::max(i, j), modes / 6),
                  "Froude reads rigid bodies, six modes each: run WAMIT without generalised modes (NEWMDS = 0)");
    out.A(i - 1, j - 1) = text.number(line, 2, "A(I,J)");
    if (!limit) out.B(i - 1, j - 1) = text.number(line, 3, "B(I,J)");
  }
  return out;
}

/// Loads of a section by heading in degrees, dimensionless, from diffraction or else by Haskind's relation.
std::map<double, Eigen::VectorXcd> read_loads(const TextLines& text, const Section& section, Eigen::Index modes,
                                              bool& by_haskind) {
  std::map<double, Eigen::VectorXcd> out;
  int head = find_in(text, section, "DIFFRACTION EXCITING");
  if (head == 0) by_haskind = (head = find_in(text, section, "HASKIND EXCITING")) != 0;
  if (head == 0) return out;
  int end = section.end;
  for (const char* next : {"EXCITING", "RESPONSE", "DRIFT", "PRESSURE", "VELOCITY"})
    if (const int other = text.find(next, head + 1); other != 0) end = std::min(end, other);
  for (int line = text.find("Wave Heading", head); line != 0 && line < end;
       line = text.find("Wave Heading", line + 1)) {
    const std::size_t last = text.words(line).size() - 1;
    Eigen::VectorXcd& X = out[text.number(line, last, "the heading in degrees")];
    X = Eigen::VectorXcd::Zero(modes);
    for (int row = rows_behind(text, line, end, "Mod["); row < end && !text.words(row).empty(); ++row) {
      const int i = text.whole(row, 0, "the mode I", 1);
      if (i > modes) text.refuse(row, fmt::format("mode {} is one too many for {} bodies", i, modes / 6));
      X[i - 1] = std::polar(text.number(row, 1, "the modulus"),
                            Angle::from_degrees(text.number(row, 2, "the phase in degrees")).radians());
    }
  }
  return out;
}

/// C of each body, dimensionless: C(3,3) to C(5,6) behind its XBODY.
Eigen::MatrixXd printed_restoring(const TextLines& text, Eigen::Index modes) {
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(modes, modes);
  int line = 1;
  for (Eigen::Index b = 0; b < modes; b += 6) {
    line = text.find("XBODY =", line + 1);
    const auto take = [&](std::string_view label, std::initializer_list<std::array<Eigen::Index, 2>> entries) {
      const int at = text.find(label, line);
      if (at == 0) text.refuse(line, fmt::format("the body has no \"{}\"", label));
      std::size_t word = text.words(at).size() - entries.size();
      for (const auto& [i, j] : entries) {
        C(b + i, b + j) = text.number(at, word++, "a restoring coefficient");
        if (j < 5) C(b + j, b + i) = C(b + i, b + j);  // the sixth row is zero: nothing restores yaw
      }
    };
    take("C(3,3)", {{2, 2}, {2, 3}, {2, 4}});
    take("C(4,4)", {{3, 3}, {3, 4}, {3, 5}});
    take("C(5,5)", {{4, 4}, {4, 5}});
  }
  return C;
}

Eigen::MatrixXd with_units(Eigen::MatrixXd m, double factor, double ulen,
                           double (*scale)(Eigen::Index, Eigen::Index, double)) {
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j < m.cols(); ++j) m(i, j) *= factor * scale(i, j, ulen);
  return m;
}

/// Loads of all finite periods, which must have the same headings.
void fill_loads(Coefficients& c, const TextLines& text, const std::vector<Section>& finite, double ulen) {
  const double unit = c.water.density * c.water.gravity;
  bool by_haskind = false;
  std::vector<double> degrees;
  for (std::size_t k = 0; k < finite.size(); ++k) {
    const auto loads = read_loads(text, finite[k], c.modes(), by_haskind);
    std::vector<double> headings;
    for (const auto& [heading, X] : loads) headings.push_back(heading);
    if (k == 0) degrees = headings;
    if (headings != degrees) text.refuse(finite[k].begin, "the headings are not those of the first period");
    if (k == 0) c.X.assign(degrees.size(), Eigen::MatrixXcd::Zero(c.modes(), std::ssize(finite)));
    for (std::size_t b = 0; b < degrees.size(); ++b)
      for (Eigen::Index i = 0; i < c.modes(); ++i)
        c.X[b](i, static_cast<Eigen::Index>(k)) = loads.at(degrees[b])[i] * unit * excitation_scale(i, ulen);
  }
  for (const double d : degrees) c.heading.push_back(Angle::from_degrees(d).radians());
  if (degrees.empty()) return c.notes.push_back("no excitation: the .out file prints none");
  c.notes.push_back("the .out file prints phases of excitation in whole degrees, half of which is 0.9 % of a load");
  if (by_haskind) c.notes.push_back("excitation is from Haskind's relation: the .out file has none by diffraction");
}

Coefficients read_wamit_out_alone(const fs::path& path, const ReadOptions& options) {
  const WamitOut out = read_wamit_out(path);
  const TextLines text = TextLines::read(path);
  Coefficients c;
  std::vector<std::string> told_by_read;
  const WamitRun run = run_of(options, out, {}, path, told_by_read);
  c.water = run.water;
  c.source = "WAMIT's printed output " + path.string();
  c.body = out.body;
  c.notes.insert(c.notes.end(), out.notes.begin(), out.notes.end());
  const Eigen::Index modes = 6 * std::ssize(out.body);
  std::vector<Section> all = sections_of(text);
  std::sort(all.begin(), all.end(), [](const Section& a, const Section& b) { return a.omega < b.omega; });
  std::vector<Section> finite;
  for (const Section& section : all) {
    const Radiation radiation = read_radiation(text, section, modes);
    Eigen::MatrixXd A = with_units(radiation.A, c.water.density, run.ulen, added_mass_scale);
    if (section.omega == 0) {
      c.A_zero = std::move(A);
    } else if (std::isinf(section.omega)) {
      c.A_inf = std::move(A);
    } else {
      finite.push_back(section);
      c.omega.push_back(section.omega);
      c.A.push_back(std::move(A));
      c.B.push_back(with_units(radiation.B, c.water.density * section.omega, run.ulen, added_mass_scale));
    }
  }
  if (finite.empty()) text.refuse(all.front().begin, "there is no finite, positive period");
  c.C = with_units(printed_restoring(text, modes), c.water.density * c.water.gravity, run.ulen, restoring_scale);
  fill_loads(c, text, finite, run.ulen);
  return c;
}

}  // namespace

// With the numeric files beside it, which have more digits, it only tells of the run.
const Format wamit_printed_files{[](const Candidate& c) {
                                   return c.path.extension() == ".out" && c.has("WAMIT") &&
                                          !fs::exists(fs::path(c.path).replace_extension(".1"));
                                 },
                                 read_wamit_out_alone};

}  // namespace hydro::potential
