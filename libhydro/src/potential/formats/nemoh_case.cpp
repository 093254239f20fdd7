#include <array>

#include "nemoh.hpp"
#include "potential/readers.hpp"
#include "text_lines.hpp"

namespace hydro::potential {
namespace {

namespace fs = std::filesystem;

/// Reads a list of degrees of freedom or of loads, `type axis(3) point(3)` a line: the point of its rotations.
Eigen::Vector3d read_modes(const TextLines& text, int& line, const char* what) {
  const int count_line = line++;
  const int count = text.whole(count_line, 0, fmt::format("the number of {}", what), 0);
  constexpr const char* remedy =
      "Froude reads rigid bodies: surge, sway, heave, roll, pitch, yaw in this order, rotations about one point";
  if (count > 6)
    text.refuse(count_line, fmt::format("there are {} {}: generalised (flexible) modes beside the six", count, what),
                remedy);
  if (count < 6) text.refuse(count_line, fmt::format("there are {} {}; six are needed", count, what), remedy);
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (int mode = 0; mode < 6; ++mode, ++line) {
    const auto v = text.numbers(line, 7, what);
    Eigen::Vector3d axis = Eigen::Vector3d::Zero();
    axis(mode % 3) = 1;
    const Eigen::Vector3d here(v[4], v[5], v[6]);
    if (v[0] != (mode < 3 ? 1 : 2) || Eigen::Vector3d(v[1], v[2], v[3]) != axis)
      text.refuse(line, fmt::format("this is not {}", mode_names[static_cast<std::size_t>(mode)]), remedy);
    if (mode > 3 && here != point) text.refuse(line, "the rotations are about different points", remedy);
    if (mode >= 3) point = here;
  }
  return point;
}

Eigen::Vector3d read_body(const TextLines& text, int& line) {
  line += 3;  // dashes, mesh file, points and panels
  const Eigen::Vector3d motions = read_modes(text, line, "degrees of freedom");
  const int loads_line = line;
  const Eigen::Vector3d loads = read_modes(text, line, "resulting forces");
  if (motions != loads)
    text.refuse(loads_line, "moments are about another point than rotations", "give both the same point in Nemoh.cal");
  const int more = text.whole(line, 0, "the number of lines of additional information", 0);
  if (more > text.count())
    text.refuse(line, fmt::format("{} lines of additional information are announced; the file has {} lines", more,
                                  text.count()));
  line += 1 + more;
  return motions;
}

Water read_water(const TextLines& text) {
  const double density = text.number(2, 0, "the density of the water"), gravity = text.number(3, 0, "gravity"),
               depth = text.number(4, 0, "the depth of the water");
  if (!(density > 0)) text.refuse(2, fmt::format("density must be positive, got {} kg/m³", density));
  if (!(gravity > 0)) text.refuse(3, fmt::format("gravity must be positive, got {} m/s²", gravity));
  if (!(depth >= 0)) text.refuse(4, fmt::format("depth must be positive, or 0 for infinite depth, got {} m", depth));
  return {density, gravity, depth == 0 ? WaterDepth::infinite() : WaterDepth::from_metres(depth)};
}

}  // namespace

NemohCase read_nemoh_case(const fs::path& cal) {
  const TextLines text = TextLines::read(cal);
  NemohCase out{cal.parent_path(), read_water(text), {}, {}, 0};
  const auto origin = text.numbers(5, 2, "the wave measurement point");
  out.wave_origin = {origin[0], origin[1]};
  const int bodies = text.whole(7, 0, "the number of bodies", 1);
  int line = 8;
  for (int b = 0; b < bodies; ++b) out.reference_point.push_back(read_body(text, line));
  line += 2;  // dashes, frequencies
  out.headings = text.whole(line, 0, "the number of wave directions", 0);
  return out;
}

fs::path find_nemoh_file(const NemohCase& nemoh, const std::vector<const char*>& folders, const std::string& name) {
  for (const char* folder : folders) {
    const fs::path there = *folder == '\0' ? nemoh.folder : entry_of(nemoh.folder, folder);
    if (const fs::path path = there.empty() ? fs::path() : entry_of(there, name); !path.empty()) return path;
  }
  return {};
}

namespace {

/// The numbers behind the labels `XF =` and `XG =` of one line.
std::array<double, 2> read_centres(const TextLines& text, int line, const char* centre) {
  return {text.number(line, 2, fmt::format("the {} coordinate of the centre of buoyancy", centre)),
          text.number(line, 6, fmt::format("the {} coordinate of the centre of gravity", centre))};
}

void fill_centres(BodyData& body, const fs::path& path) {
  const TextLines text = TextLines::read(path);
  const auto x = read_centres(text, 1, "x"), y = read_centres(text, 2, "y"), z = read_centres(text, 3, "z");
  body.centre_of_buoyancy = Eigen::Vector3d(x[0], y[0], z[0]);
  body.centre_of_gravity = Eigen::Vector3d(x[1], y[1], z[1]);
  const int line = text.find("Displacement");
  if (line == 0) text.refuse_end("the displacement");
  body.displaced_volume = text.number(line, 2, "the displacement");
}

Matrix6 read_restoring(const fs::path& path) {
  const TextLines text = TextLines::read(path);
  Matrix6 C;
  NumberStream numbers(text, 1);
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = 0; j < 6; ++j) C(i, j) = numbers.next(fmt::format("entry ({}, {}) of C", i + 1, j + 1));
  return C;
}

}  // namespace

void fill_nemoh_hydrostatics(Coefficients& c, const NemohCase& nemoh) {
  const auto file = [&](const char* kind, int b) {
    const fs::path numbered = find_nemoh_file(nemoh, {"Mesh", ""}, fmt::format("{}_{}.dat", kind, b));
    return numbered.empty() && c.bodies() == 1 ? find_nemoh_file(nemoh, {"Mesh", ""}, fmt::format("{}.dat", kind))
                                               : numbered;
  };
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(c.modes(), c.modes());
  bool is_complete = true;
  for (int b = 0; b < c.bodies(); ++b) {
    BodyData& body = c.body[static_cast<std::size_t>(b)];
    if (const fs::path path = file("Hydrostatics", b); !path.empty())
      fill_centres(body, path);
    else
      c.notes.push_back(
          fmt::format("no volume and centres of {}: there is no Mesh/Hydrostatics.dat for it", body.name));
    const fs::path path = file("KH", b);
    is_complete = is_complete && !path.empty();
    if (!is_complete) continue;
    // NEMOH's mesh program takes moments about the centre of gravity: (P4) to the point of the rotations.
    const Eigen::Vector3d r = body.centre_of_gravity ? *body.centre_of_gravity - *body.reference_point
                                                     : Eigen::Vector3d(Eigen::Vector3d::Zero());
    const Matrix6 T = rigid_shift(r);
    C.block<6, 6>(6 * b, 6 * b) = T.transpose() * read_restoring(path) * T;
  }
  if (is_complete) {
    c.C = C;
  } else {
    c.notes.push_back("no restoring matrix: there is no Mesh/KH.dat, or not one for each body");
  }
}

}  // namespace hydro::potential
