#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "potential/readers.hpp"
#include "text_lines.hpp"

namespace hydro::potential {
namespace {

namespace fs = std::filesystem;

/// Sections of one part of the file: the head, one structure, or what one structure does to another.
using Sections = std::map<std::string, int, std::less<>>;  ///< line of the first of each name

/// `[NAME] values` in a line, tables in the lines below.
struct HdbFile {
  TextLines text;
  Sections head = {};
  std::vector<Sections> structure = {};                                   ///< [STRUCTURE_nn], in the order of nn
  std::map<std::pair<std::string, std::string>, Sections> coupling = {};  ///< of the one that moves, on the other (P27)
  std::vector<double> period = {};                                        ///< s, in the order of the file
  FrequencyOrder order = {};

  int line_of(const Sections& part, const std::string& name) const {
    if (const auto found = part.find(name); found != part.end()) return found->second;
    if (const auto found = head.find(name); found != head.end()) return found->second;
    throw InputError(fmt::format("there is no section [{}]", name), {.file = text.path().string()},
                     "the file may be cut short, or be no HDB file");
  }
  /// Words behind the name in its own line count from 1.
  double number(const Sections& part, const std::string& name, std::size_t word, const char* what) const {
    return text.number(line_of(part, name), word, what);
  }
  /// All that stands behind `]` in a line, without blanks at its ends.
  std::string behind(int line) const {
    const std::string& all = text.line(line);
    const auto first = all.find_first_not_of(" \t\r", all.find(']') + 1);
    return first == std::string::npos ? "" : all.substr(first, all.find_last_not_of(" \t\r") + 1 - first);
  }
};

constexpr std::string_view structure_mark = "STRUCTURE_", coupling_mark = "HYDRODYNAMIC_COUPLING_BETWEEN_STRUCTURES";

/// The sections that follow a line which begins a structure or a coupling.
Sections& part_begun(HdbFile& file, int line, const std::string& name) {
  if (name.starts_with(structure_mark)) {
    if (name != fmt::format("STRUCTURE_{:02}", file.structure.size() + 1))
      file.text.refuse(line, fmt::format("[{}] stands where structure {} should", name, file.structure.size() + 1),
                       "structures are numbered from 01 without gaps");
    return file.structure.emplace_back();
  }
  const int on = file.text.find("[ON]", line);
  if (on == 0) file.text.refuse(line, "a coupling needs the structure [ON] which it acts");
  const auto [at, is_new] = file.coupling.try_emplace({file.behind(line), file.behind(on)});
  if (!is_new) file.text.refuse(line, fmt::format("{} on {} stands twice", at->first.first, at->first.second));
  return at->second;
}

HdbFile read_sections(const fs::path& path) {
  HdbFile file{.text = TextLines::read(path)};
  std::optional<std::size_t> structure;
  Sections* coupling = nullptr;  // nodes of a map stay where they are
  for (int line = 1; line <= file.text.count(); ++line) {
    const std::string& text = file.text.line(line);
    const auto begin = text.find_first_not_of(" \t"), end = text.find(']');
    if (begin == std::string::npos || text[begin] != '[' || end == std::string::npos) continue;
    const std::string name = text.substr(begin + 1, end - begin - 1);
    const bool begins_structure = name.starts_with(structure_mark);
    if (begins_structure || name == coupling_mark) {
      Sections& part = part_begun(file, line, name);
      if (begins_structure) structure = file.structure.size() - 1;
      coupling = begins_structure ? nullptr : &part;
    }
    Sections& now = coupling ? *coupling : structure ? file.structure[*structure] : file.head;
    now.try_emplace(name, line);
  }
  return file;
}

/// A list of numbers, one a line, below `[list]`; as many as `[count]` says.
std::vector<double> read_list(const HdbFile& file, const std::string& list, const std::string& count) {
  const int n = file.text.whole(file.line_of(file.head, count), 1, count, 1);
  const int first = file.line_of(file.head, list) + 1;
  std::vector<double> out;
  for (int i = 0; i < n; ++i) out.push_back(file.text.number(first + i, 0, list));
  return out;
}

/// Rows `period v1 … v6` of a section, one for each period in the order of the list.
Eigen::MatrixXd read_rows(const HdbFile& file, const Sections& part, const std::string& name) {
  const int first = file.line_of(part, name) + 1;
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

Eigen::Vector3d read_point(const HdbFile& file, const Sections& part, const std::string& name) {
  return {file.number(part, name, 1, "x"), file.number(part, name, 2, "y"), file.number(part, name, 3, "z")};
}

/// AQUA+ writes one structure, whose sections stand in the head, and says neither where it is nor what it displaces.
void read_only_body(Coefficients& c, HdbFile& file) {
  file.structure.emplace_back();
  c.body.emplace_back().name = "body1";
  c.notes.push_back(
      "the file tells neither volume nor centres of its structure, nor the point that its moments are about: state "
      "reference_point");
}

void read_bodies(Coefficients& c, HdbFile& file) {
  if (!file.head.contains("STRUCTURES_NUMBER") && file.structure.empty()) return read_only_body(c, file);
  const int count = file.line_of(file.head, "STRUCTURES_NUMBER");
  const auto n = static_cast<std::size_t>(file.text.whole(count, 1, "the number of structures", 1));
  if (file.structure.size() != n)
    file.text.refuse(count, fmt::format("the file has sections of {} structures, not of {}", file.structure.size(), n),
                     "the file may be cut short");
  for (std::size_t i = 0; i < n; ++i) {
    const Sections& part = file.structure[i];
    BodyData& body = c.body.emplace_back();
    body.name = file.behind(file.line_of(part, fmt::format("STRUCTURE_{:02}", i + 1)));
    if (body.name.empty()) body.name = fmt::format("body{}", i + 1);
    body.displaced_volume = file.number(part, "UNDERWATER_VOLUME", 1, "the volume");
    body.centre_of_buoyancy = read_point(file, part, "CENTER_OF_BUOYANCY");
    body.centre_of_gravity = read_point(file, part, "CENTER_OF_GRAVITY");
    body.reference_point = body.centre_of_gravity;  // (P27)
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if ((*c.body[i].centre_of_gravity - *c.body[j].centre_of_gravity).head<2>().norm() < 1e-6)
        file.text.refuse(file.line_of(file.structure[i], "CENTER_OF_GRAVITY"),
                         fmt::format("{} is where {} is, so centres are not given in common axes and the file does not "
                                     "say where its structures stand",
                                     c.body[i].name, c.body[j].name),
                         "write the centres of gravity in the axes in which the waves are given");
}

/// Rows of A or B of one part into one block of all periods, in the order of the file.
void read_block(const HdbFile& file, const Sections& part, const char* rows, Eigen::Index on, Eigen::Index by,
                std::vector<Eigen::MatrixXd>& all) {
  for (Eigen::Index i = 0; i < 6; ++i) {
    const Eigen::MatrixXd row = read_rows(file, part, fmt::format("{}_{}", rows, i + 1));
    for (std::size_t k = 0; k < all.size(); ++k)
      all[k].block<1, 6>(6 * on + i, 6 * by) = row.col(static_cast<Eigen::Index>(k)).transpose();
  }
}

/// What the motion of one structure does to another: all pairs, or none.
void read_couplings(Coefficients& c, const HdbFile& file, std::vector<Eigen::MatrixXd>& A,
                    std::vector<Eigen::MatrixXd>& B) {
  const auto n = static_cast<Eigen::Index>(c.body.size());
  if (n == 1) return;
  if (file.coupling.empty()) {
    c.notes.push_back("the file couples no structures: each radiates as if it were alone");
    return;
  }
  for (Eigen::Index by = 0; by < n; ++by)
    for (Eigen::Index on = 0; on < n; ++on) {
      if (on == by) continue;
      const std::string &moves = c.body[static_cast<std::size_t>(by)].name,
                        &feels = c.body[static_cast<std::size_t>(on)].name;
      const auto found = file.coupling.find({moves, feels});
      if (found == file.coupling.end())
        throw InputError(fmt::format("there is no [{}] {} [ON] {}", coupling_mark, moves, feels),
                         {.file = file.text.path().string()}, "the file may be cut short");
      read_block(file, found->second, "ADDED_MASS_LINE", on, by, A);
      read_block(file, found->second, "DAMPING_TERM", on, by, B);
    }
  c.notes.push_back("couplings are taken as rows of loads on the structure behind [ON] by motions of the other");
}

void fill_radiation(Coefficients& c, const HdbFile& file) {
  const auto n = static_cast<Eigen::Index>(c.body.size());
  std::vector<Eigen::MatrixXd> A(file.period.size(), Eigen::MatrixXd::Zero(6 * n, 6 * n)), B = A;
  for (Eigen::Index b = 0; b < n; ++b) {
    read_block(file, file.structure[static_cast<std::size_t>(b)], "ADDED_MASS_LINE", b, b, A);
    read_block(file, file.structure[static_cast<std::size_t>(b)], "DAMPING_TERM", b, b, B);
  }
  read_couplings(c, file, A, B);
  for (const std::size_t k : file.order.finite) {
    c.A.push_back(A[k]);
    c.B.push_back(B[k]);
    c.omega.push_back(2 * std::numbers::pi / file.period[k]);
  }
}

/// X = |F| e^{−i(φ + π/2)}: the file has e^{−iωt}, with sin in the place of cos (P27).
void fill_excitation(Coefficients& c, const HdbFile& file) {
  for (const char* part : {"FROUDE-KRYLOV_FORCES_AND_MOMENTS", "DIFFRACTION_FORCES_AND_MOMENTS"})
    if (file.head.contains(part) && !file.head.contains("EXCITATION_FORCES_AND_MOMENTS")) {
      // AQUA+ writes the parts under one name each heading, with phases whose origin no file at hand tells.
      c.notes.push_back(fmt::format("no excitation: the file has [{}], a part whose phases are not explained", part));
      return;
    }
  std::vector<double> heading;
  for (const double degrees : read_list(file, "List_calculated_headings", "HEADINGS_NUMBER"))
    heading.push_back(Angle::from_degrees(degrees).radians());
  const auto headings = order_headings(heading, file.text.path());
  c.heading = picked(heading, headings);
  for (const std::size_t h : headings) {
    Eigen::MatrixXcd& X = c.X.emplace_back(c.modes(), static_cast<Eigen::Index>(c.omega.size()));
    for (std::size_t b = 0; b < file.structure.size(); ++b) {
      const Sections& part = file.structure[b];
      const Eigen::MatrixXd modulus = read_rows(file, part, fmt::format("INCIDENCE_EFM_MOD_{:03}", h + 1)),
                            phase = read_rows(file, part, fmt::format("INCIDENCE_EFM_PH_{:03}", h + 1));
      for (std::size_t f = 0; f < file.order.finite.size(); ++f)
        for (Eigen::Index i = 0; i < 6; ++i) {
          const auto k = static_cast<Eigen::Index>(file.order.finite[f]);
          X(6 * static_cast<Eigen::Index>(b) + i, static_cast<Eigen::Index>(f)) =
              modulus(i, k) * std::polar(1.0, -phase(i, k) - std::numbers::pi / 2);
        }
    }
  }
}

void fill_restoring(Coefficients& c, const HdbFile& file) {
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(c.modes(), c.modes());
  for (std::size_t b = 0; b < file.structure.size(); ++b) {
    const int first = file.line_of(file.structure[b], "Hydrostatic_matrix") + 1;
    const auto corner = 6 * static_cast<Eigen::Index>(b);
    for (int i = 0; i < 6; ++i) {
      const auto row = file.text.numbers(first + i, 6, "the hydrostatic matrix");
      for (Eigen::Index j = 0; j < 6; ++j) C(corner + i, corner + j) = row[static_cast<std::size_t>(j)];
    }
  }
  c.C = C;
}

Coefficients read_hdb(const fs::path& path, const ReadOptions& options) {
  if (!options.density || !options.gravity || !options.depth)
    throw InputError("HDB files do not hold density, gravity and depth", {.file = path.string()},
                     "state them: in the [water] table of a scene, or as options of `froude bem`");
  HdbFile file = read_sections(path);
  if (const double speed = file.number(file.head, "FORWARD_SPEED", 1, "the forward speed"); speed != 0)
    file.text.refuse(file.line_of(file.head, "FORWARD_SPEED"),
                     fmt::format("the data are for a forward speed of {} m/s", speed),
                     "Froude's bodies keep their place: compute with speed zero");
  file.period = read_list(file, "List_calculated_periods", "PERIODS_NUMBER");
  std::vector<double> omega;
  for (const double period : file.period) omega.push_back(2 * std::numbers::pi / period);
  file.order = order_frequencies(omega, path);
  if (file.order.zero || file.order.infinite) throw InputError("a period of zero", {.file = path.string()});
  Coefficients c;
  c.water = {*options.density, *options.gravity, *options.depth};
  c.source = fmt::format("HDB {}", path.string());
  read_bodies(c, file);
  fill_radiation(c, file);
  fill_restoring(c, file);
  fill_excitation(c, file);
  return c;
}

}  // namespace

const Format hdb_files{[](const Candidate& c) { return c.has("[List_calculated_periods]"); }, read_hdb};

}  // namespace hydro::potential
