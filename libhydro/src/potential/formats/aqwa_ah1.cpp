#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "aqwa.hpp"
#include "hydro/waves/dispersion.hpp"
#include "potential/readers.hpp"
#include "text_lines.hpp"

namespace hydro::potential {

std::complex<double> aqwa_load(double modulus, double lag_deg, double omega, double heading,
                               const Eigen::Vector3d& centre_of_gravity, const Water& water) {
  const double along = std::cos(heading) * centre_of_gravity.x() + std::sin(heading) * centre_of_gravity.y();
  const double way = along == 0 ? 0 : waves::wavenumber(omega, water) * along;
  return modulus * std::polar(1.0, -Angle::from_degrees(lag_deg).radians() - way);
}

namespace {

namespace fs = std::filesystem;

/// Blocks of one kind of matrix: at(structure, structure, frequency), each counted from 0; frequency 0 for limits.
struct Blocks {
  std::map<std::array<int, 3>, Matrix6> at;
  int line = 0;  ///< of the section's name; 0: there is no such section
};

/// The sections of an .AH1 file.
struct Ah1 {
  TextLines text;
  bool has_structure_in_general = false;  ///< from version 18.2 on, told by the word LHFR in the comments
  std::vector<double> heading_deg, omega;
  int structures = 0;
  std::map<std::string, int, std::less<>> section;  ///< line of the name

  int line_of(std::string_view name) const {
    const auto found = section.find(name);
    if (found == section.end())
      throw InputError(fmt::format("there is no section {}", name), {.file = text.path().string()},
                       "the file may be cut short, or be no AQWA-LINE .AH1 file");
    return found->second;
  }
  NumberStream numbers(std::string_view name) const { return NumberStream(text, line_of(name) + 1); }
  /// A structure number from 0. \throws InputError
  std::size_t structure(NumberStream& in) const {
    const int number = in.next_whole("a structure number", 1);
    if (number > structures)
      throw InputError(fmt::format("structure {} of {}", number, structures), in.place_of_last());
    return static_cast<std::size_t>(number - 1);
  }
};

/// Headings and frequencies, said once for each structure; they must agree, as the results have one table.
void read_axes(Ah1& file, int first_line) {
  NumberStream in(file.text, first_line);
  while (!in.at_end_of_numbers()) {
    const int line = in.line();
    if (in.next_whole("a structure number", 1) != ++file.structures)
      file.text.refuse(line, "structures are not numbered one after another");
    const int headings = in.next_whole("the number of headings", 1),
              frequencies = in.next_whole("the number of frequencies", 1);
    std::vector<double> heading, omega;
    for (int i = 0; i < headings; ++i) heading.push_back(in.next("a heading"));
    for (int i = 0; i < frequencies; ++i) omega.push_back(in.next("a frequency"));
    if (file.structures > 1 && (heading != file.heading_deg || omega != file.omega))
      file.text.refuse(line, "this structure has other headings or frequencies than the first one",
                       "run all structures with one set of headings and frequencies");
    file.heading_deg = heading;
    file.omega = omega;
  }
  if (file.structures == 0) file.text.refuse_end("headings and frequencies");
}

Ah1 read_sections(const fs::path& path) {
  Ah1 file{.text = TextLines::read(path), .heading_deg = {}, .omega = {}, .section = {}};
  int line = 1;
  for (; line <= file.text.count() && file.text.line(line).starts_with("*"); ++line)
    file.has_structure_in_general = file.has_structure_in_general || file.text.contains(line, "LHFR");
  read_axes(file, line);
  for (; line <= file.text.count(); ++line) {
    const auto words = file.text.words(line);
    if (words.empty() || fortran_number(words.front())) continue;
    if (!file.section.try_emplace(std::string(words.front()), line).second)
      file.text.refuse(line, fmt::format("the section {} is there twice", words.front()));
  }
  return file;
}

Water read_water(const Ah1& file) {
  std::optional<Water> water;
  for (int s = 0; s < file.structures; ++s) {
    const int line = file.line_of("GENERAL") + 1 + s;
    const std::size_t first = file.has_structure_in_general ? 1 : 0;
    const double depth = file.text.number(line, first, "the depth of the water"),
                 density = file.text.number(line, first + 1, "the density of the water"),
                 gravity = file.text.number(line, first + 2, "gravity");
    if (!(depth > 0 && density > 0 && gravity > 0))
      file.text.refuse(line, "depth, density and gravity must be positive");
    if (water && (water->density != density || water->gravity != gravity || water->depth.metres() != depth))
      file.text.refuse(line, "this structure is in other water than the first one");
    water = Water{density, gravity, WaterDepth::from_metres(depth)};
  }
  return *water;
}

/// One line `structure x y z` for each structure.
void read_points(Coefficients& c, const Ah1& file, std::string_view section,
                 std::optional<Eigen::Vector3d> BodyData::*member) {
  NumberStream in = file.numbers(section);
  for (int s = 0; s < file.structures; ++s) {
    BodyData& body = c.body[file.structure(in)];
    Eigen::Vector3d p;
    for (Eigen::Index i = 0; i < 3; ++i) p(i) = in.next(fmt::format("a coordinate of {}", section));
    body.*member = p;
  }
}

void read_bodies(Coefficients& c, const Ah1& file) {
  for (int s = 0; s < file.structures; ++s) {
    c.body.emplace_back();
    c.body.back().name = fmt::format("structure{}", s + 1);
  }
  read_points(c, file, "COG", &BodyData::centre_of_gravity);
  read_points(c, file, "COB", &BodyData::centre_of_buoyancy);
  NumberStream in = file.numbers("DISPLACEMENT");
  for (int s = 0; s < file.structures; ++s) {
    const std::size_t structure = file.structure(in);
    c.body[structure].displaced_volume = in.next("the displaced volume");
  }
  for (const BodyData& body : c.body)
    if (!body.centre_of_gravity) throw InputError("COG lacks a structure", {.file = file.text.path().string()});
  for (BodyData& body : c.body) body.reference_point = body.centre_of_gravity;  // (P22)
}

Matrix6 read_matrix(NumberStream& in, const std::string& what) {
  Matrix6 m;
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = 0; j < 6; ++j) m(i, j) = in.next(what);
  return m;
}

Blocks read_blocks(const Ah1& file, const std::string& section, bool has_frequency) {
  Blocks blocks;
  if (!has_frequency && !file.section.contains(section)) return blocks;  // limits are optional
  blocks.line = file.line_of(section);
  NumberStream in = file.numbers(section);
  while (!in.at_end_of_numbers()) {
    const int line = in.line();
    std::array<int, 3> index{static_cast<int>(file.structure(in)), static_cast<int>(file.structure(in)), 0};
    if (has_frequency) index[2] = in.next_whole("a frequency number", 1) - 1;
    if (index[2] >= static_cast<int>(file.omega.size()))
      file.text.refuse(line, fmt::format("frequency {} of {}", index[2] + 1, file.omega.size()));
    if (!blocks.at.emplace(index, read_matrix(in, section)).second)
      file.text.refuse(line, fmt::format("this block of {} is there twice", section), "keep one of the two");
  }
  return blocks;
}

/// Block (i, j): rows are loads on structure i, columns motions of structure j (P22).
Eigen::MatrixXd assembled(const Ah1& file, const Blocks& blocks, const std::string& section, int frequency) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(6 * file.structures, 6 * file.structures);
  for (int i = 0; i < file.structures; ++i)
    for (int j = 0; j < file.structures; ++j) {
      const auto found = blocks.at.find({i, j, frequency});
      if (found != blocks.at.end()) {
        m.block<6, 6>(6 * i, 6 * j) = found->second;
      } else if (i == j || blocks.at.contains({i, j, 0})) {
        // Structures of different interaction groups have no blocks at all; anything else is a gap.
        file.text.refuse(blocks.line,
                         fmt::format("{} has no block for structures {} and {} at frequency {}", section, i + 1, j + 1,
                                     frequency + 1),
                         "the file may be cut short");
      }
    }
  return m;
}

void fill_radiation(Coefficients& c, const Ah1& file, const FrequencyOrder& order) {
  const Blocks A = read_blocks(file, "ADDEDMASS", true), B = read_blocks(file, "DAMPING", true);
  for (const std::size_t k : order.finite) {
    c.omega.push_back(file.omega[k]);
    c.A.push_back(assembled(file, A, "ADDEDMASS", static_cast<int>(k)));
    c.B.push_back(assembled(file, B, "DAMPING", static_cast<int>(k)));
  }
  const auto limit = [&](const char* section, std::optional<Eigen::MatrixXd>& target, const char* note) {
    const Blocks blocks = read_blocks(file, section, false);
    if (blocks.line == 0) return;
    target = assembled(file, blocks, section, 0);
    c.notes.emplace_back(note);
  };
  limit("ADDEDMASS_LF", c.A_zero, "A(0) is AQWA's ADDEDMASS_LF, computed at a low frequency, not at zero");
  limit("ADDEDMASS_HF", c.A_inf, "A(∞) is AQWA's ADDEDMASS_HF, computed at a high frequency, not at infinity");
}

void fill_restoring(Coefficients& c, const Ah1& file) {
  NumberStream in = file.numbers("HYDSTIFFNESS");
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(c.modes(), c.modes());
  for (int s = 0; s < file.structures; ++s) {
    const auto at = static_cast<Eigen::Index>(6 * file.structure(in));
    C.block<6, 6>(at, at) = read_matrix(in, "HYDSTIFFNESS");
  }
  c.C = C;
}

/// Damping that does not depend on frequency is the user's addition to AQWA's potential theory.
void note_added_damping(Coefficients& c, const Ah1& file) {
  if (!file.section.contains("FIDD")) return;
  NumberStream in = file.numbers("FIDD");
  for (int s = 0; s < file.structures; ++s) {
    const std::size_t structure = file.structure(in);
    bool is_zero = true;
    for (int i = 0; i < 6; ++i) is_zero = in.next("FIDD") == 0 && is_zero;
    if (!is_zero)
      c.notes.push_back(fmt::format(
          "the frequency-independent damping (FIDD) of structure {} is left out: it is no radiation", structure + 1));
  }
}

void fill_excitation(Coefficients& c, const Ah1& file, const FrequencyOrder& order) {
  std::vector<double> heading;
  for (const double degrees : file.heading_deg) heading.push_back(Angle::from_degrees(degrees).radians());
  const auto by_heading = order_headings(heading, file.text.path());
  c.heading = picked(heading, by_heading);
  std::map<std::array<std::size_t, 3>, std::array<double, 12>> rows;  // structure, heading, frequency of the file
  NumberStream in = file.numbers("FORCERAO");
  while (!in.at_end_of_numbers()) {
    const int line = in.line();
    const std::size_t s = file.structure(in), h = static_cast<std::size_t>(in.next_whole("a heading number", 1)) - 1,
                      k = static_cast<std::size_t>(in.next_whole("a frequency number", 1)) - 1;
    std::array<double, 12> row;
    for (double& value : row) value = in.next("FORCERAO");
    if (h >= heading.size() || k >= file.omega.size())
      file.text.refuse(
          line, fmt::format("heading {} of {}, frequency {} of {}", h + 1, heading.size(), k + 1, file.omega.size()));
    if (!rows.emplace(std::array{s, h, k}, row).second)
      file.text.refuse(line, "this structure, heading and frequency are there twice", "keep one of them");
  }
  c.X.assign(heading.size(), Eigen::MatrixXcd::Zero(c.modes(), static_cast<Eigen::Index>(c.omega.size())));
  for (std::size_t s = 0; s < c.body.size(); ++s)
    for (std::size_t b = 0; b < by_heading.size(); ++b)
      for (std::size_t k = 0; k < order.finite.size(); ++k) {
        const auto found = rows.find({s, by_heading[b], order.finite[k]});
        if (found == rows.end())
          file.text.refuse(file.line_of("FORCERAO"),
                           fmt::format("FORCERAO lacks structure {}, heading {}, frequency {}", s + 1,
                                       by_heading[b] + 1, order.finite[k] + 1),
                           "the file may be cut short");
        for (std::size_t i = 0; i < 6; ++i)
          c.X[b](static_cast<Eigen::Index>(6 * s + i), static_cast<Eigen::Index>(k)) = aqwa_load(
              found->second[i], found->second[6 + i], c.omega[k], c.heading[b], *c.body[s].centre_of_gravity, c.water);
      }
}

Coefficients read_aqwa_ah1(const fs::path& path) {
  const Ah1 file = read_sections(path);
  Coefficients c;
  c.water = read_water(file);
  c.source = fmt::format("AQWA .AH1 file {}", path.string());
  const FrequencyOrder order = order_frequencies(file.omega, path);
  if (order.zero || order.infinite) throw InputError("a frequency of zero", {.file = path.string()});
  read_bodies(c, file);
  fill_radiation(c, file, order);
  fill_restoring(c, file);
  fill_excitation(c, file, order);
  note_added_damping(c, file);
  return c;
}

}  // namespace

const Format aqwa_ah1_files{[](const Candidate& c) { return c.first_line().starts_with("*") && c.has("AQWA"); },
                            [](const fs::path& path, const ReadOptions&) { return read_aqwa_ah1(path); }};

}  // namespace hydro::potential
