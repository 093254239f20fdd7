#include <cmath>
#include <map>
#include <numbers>

#include "readers.hpp"
#include "text_lines.hpp"

namespace hydro::potential {
namespace {

namespace fs = std::filesystem;

/// The file and where its sections stand: `[NAME] values` in a line, tables in the lines below.
struct HdbFile {
  TextLines text;
  std::map<std::string, int, std::less<>> section;  ///< line of the first of each name
  std::vector<double> period;                       ///< s, in the order of the file
  FrequencyOrder order;

  int line_of(const std::string& name) const {
    const auto found = section.find(name);
    if (found == section.end())
      throw InputError(fmt::format("there is no section [{}]", name), {.file = text.path().string()},
                       "the file may be cut short, or be no HDB file");
    return found->second;
  }
  /// Words behind the name in its own line count from 1.
  double number(const std::string& name, std::size_t word, const char* what) const {
    return text.number(line_of(name), word, what);
  }
};

HdbFile read_sections(const fs::path& path) {
  HdbFile file{.text = TextLines::read(path), .section = {}, .period = {}, .order = {}};
  for (int line = 1; line <= file.text.count(); ++line) {
    const std::string& text = file.text.line(line);
    const auto end = text.find(']');
    if (!text.empty() && text.front() == '[' && end != std::string::npos)
      file.section.try_emplace(text.substr(1, end - 1), line);
  }
  return file;
}

/// A list of numbers, one a line, below `[list]`; as many as `[count]` says.
std::vector<double> read_list(const HdbFile& file, const std::string& list, const std::string& count) {
  const int n = file.text.whole(file.line_of(count), 1, count, 1), first = file.line_of(list) + 1;
  std::vector<double> out;
  for (int i = 0; i < n; ++i) out.push_back(file.text.number(first + i, 0, list));
  return out;
}

/// Rows `period v1 … v6` of a section, one for each period in the order of the list.
Eigen::MatrixXd read_rows(const HdbFile& file, const std::string& name) {
  const int first = file.line_of(name) + 1;
  Eigen::MatrixXd out(6, static_cast<Eigen::Index>(file.period.size()));
  for (std::size_t k = 0; k < file.period.size(); ++k) {
    const int line = first + static_cast<int>(k);
    const auto row = file.text.numbers(line, 7, "a row of " + name);
    constexpr double printed = 0.0051;  // two decimals in the rows, three in the list
    if (std::abs(row[0] - file.period[k]) > printed)
      file.text.refuse(line, fmt::format("[{}] has period {} s where the list has {} s", name, row[0], file.period[k]),
                       "the file may be cut short or mixed from two runs");
    for (Eigen::Index i = 0; i < 6; ++i) out(i, static_cast<Eigen::Index>(k)) = row[static_cast<std::size_t>(i) + 1];
  }
  return out;
}

Eigen::Vector3d read_point(const HdbFile& file, const std::string& name) {
  return {file.number(name, 1, "x"), file.number(name, 2, "y"), file.number(name, 3, "z")};
}

void read_body(Coefficients& c, const HdbFile& file) {
  if (const int n = file.text.whole(file.line_of("STRUCTURES_NUMBER"), 1, "the number of structures", 1); n != 1)
    file.text.refuse(file.line_of("STRUCTURES_NUMBER"), fmt::format("the file has {} structures", n),
                     "Froude reads HDB files of one structure; how such files couple several is not known to it");
  BodyData& body = c.body.emplace_back();
  const auto words = file.text.words(file.line_of("STRUCTURE_01"));
  body.name = words.size() > 1 ? std::string(words[1]) : "body1";
  body.displaced_volume = file.number("UNDERWATER_VOLUME", 1, "the volume");
  body.centre_of_buoyancy = read_point(file, "CENTER_OF_BUOYANCY");
  body.centre_of_gravity = read_point(file, "CENTER_OF_GRAVITY");
  body.reference_point = body.centre_of_gravity;  // (P27)
}

void fill_radiation(Coefficients& c, const HdbFile& file) {
  std::vector<Eigen::MatrixXd> A, B;  // one for each row of the matrices
  for (int i = 1; i <= 6; ++i) {
    A.push_back(read_rows(file, fmt::format("ADDED_MASS_LINE_{}", i)));
    B.push_back(read_rows(file, fmt::format("DAMPING_TERM_{}", i)));
  }
  for (const std::size_t k : file.order.finite) {
    Matrix6 a, b;
    for (std::size_t i = 0; i < 6; ++i) {
      a.row(static_cast<Eigen::Index>(i)) = A[i].col(static_cast<Eigen::Index>(k));
      b.row(static_cast<Eigen::Index>(i)) = B[i].col(static_cast<Eigen::Index>(k));
    }
    c.A.emplace_back(a);
    c.B.emplace_back(b);
    c.omega.push_back(2 * std::numbers::pi / file.period[k]);
  }
}

/// X = |F| e^{−i(φ + π/2)}: the file has e^{−iωt}, with sin in the place of cos (P27).
void fill_excitation(Coefficients& c, const HdbFile& file) {
  std::vector<double> heading;
  for (const double degrees : read_list(file, "List_calculated_headings", "HEADINGS_NUMBER"))
    heading.push_back(Angle::from_degrees(degrees).radians());
  const auto headings = order_headings(heading, file.text.path());
  c.heading = picked(heading, headings);
  for (const std::size_t h : headings) {
    const Eigen::MatrixXd modulus = read_rows(file, fmt::format("INCIDENCE_EFM_MOD_{:03}", h + 1)),
                          phase = read_rows(file, fmt::format("INCIDENCE_EFM_PH_{:03}", h + 1));
    Eigen::MatrixXcd& X = c.X.emplace_back(6, static_cast<Eigen::Index>(c.omega.size()));
    for (std::size_t f = 0; f < file.order.finite.size(); ++f)
      for (Eigen::Index i = 0; i < 6; ++i) {
        const auto k = static_cast<Eigen::Index>(file.order.finite[f]);
        X(i, static_cast<Eigen::Index>(f)) = modulus(i, k) * std::polar(1.0, -phase(i, k) - std::numbers::pi / 2);
      }
  }
}

void fill_restoring(Coefficients& c, const HdbFile& file) {
  const int first = file.line_of("Hydrostatic_matrix") + 1;
  Matrix6 C;
  for (int i = 0; i < 6; ++i) {
    const auto row = file.text.numbers(first + i, 6, "the hydrostatic matrix");
    for (Eigen::Index j = 0; j < 6; ++j) C(i, j) = row[static_cast<std::size_t>(j)];
  }
  c.C = C;
}

}  // namespace

Coefficients read_hdb(const fs::path& path, const ReadOptions& options) {
  if (!options.density || !options.gravity || !options.depth)
    throw InputError("HDB files do not hold density, gravity and depth", {.file = path.string()},
                     "state them: in the [water] table of a scene, or as options of `froude bem`");
  HdbFile file = read_sections(path);
  if (const double speed = file.number("FORWARD_SPEED", 1, "the forward speed"); speed != 0)
    file.text.refuse(file.line_of("FORWARD_SPEED"), fmt::format("the data are for a forward speed of {} m/s", speed),
                     "Froude's bodies keep their place: compute with speed zero");
  file.period = read_list(file, "List_calculated_periods", "PERIODS_NUMBER");
  std::vector<double> omega;
  for (const double period : file.period) omega.push_back(2 * std::numbers::pi / period);
  file.order = order_frequencies(omega, path);
  if (file.order.zero || file.order.infinite) throw InputError("a period of zero", {.file = path.string()});
  Coefficients c;
  c.water = {*options.density, *options.gravity, *options.depth};
  c.source = fmt::format("HDB {}", path.string());
  read_body(c, file);
  fill_radiation(c, file);
  fill_restoring(c, file);
  fill_excitation(c, file);
  return c;
}

}  // namespace hydro::potential
