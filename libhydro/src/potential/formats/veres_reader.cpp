#include <cmath>
#include <numbers>

#include "hydro/potential/operations/operations.hpp"
#include "hydro/potential/operations/transformations.hpp"
#include "hydro/waves/dispersion.hpp"
#include "potential/readers.hpp"
#include "responses.hpp"
#include "text_lines.hpp"

// VERES's axes: x aft, y to starboard, z up, origin at Lpp/2, centreline and baseline; headings are where the wave
// goes, from +x (0: head sea) towards +y. Everything is read in these axes with z from still water, then turned by 180°
// (P26).

namespace hydro::potential {
namespace {

namespace fs = std::filesystem;

/// Lines 7 to 9 of every file.
struct VeresHeader {
  double density, gravity, length, breadth, draught;
  Eigen::Vector2d gravity_centre;  ///< x from Lpp/2, aft; z from the baseline
};

VeresHeader read_header(const TextLines& text, bool has_centre) {
  VeresHeader h{};
  const auto number = [&](int line, std::size_t word, const char* what) {
    const double value = text.number(line, word, what);
    if (!(value > 0)) text.refuse(line, fmt::format("{} must be positive", what));
    return value;
  };
  h.density = number(7, 0, "the density of the water");
  h.gravity = number(7, 1, "gravity");
  h.length = number(8, 0, "the length Lpp");
  h.breadth = number(8, 1, "the breadth");
  h.draught = number(8, 2, "the draught");
  if (has_centre) h.gravity_centre = {text.number(9, 0, "LCG"), text.number(9, 1, "VCG")};
  return h;
}

struct Counts {
  int headings, frequencies;
};

/// `nvel nhead nfreq (ndof)`; only one speed, the six rigid modes.
Counts read_counts(const TextLines& text, int line, bool has_modes) {
  if (const int speeds = text.whole(line, 0, "the number of speeds", 1); speeds != 1)
    text.refuse(line, fmt::format("the run has {} speeds", speeds), "run VERES for speed zero alone");
  if (has_modes)
    if (const int modes = text.whole(line, 3, "the number of modes", 1); modes != 6)
      text.refuse(line, fmt::format("the run has {} modes", modes), "Froude reads rigid bodies with six modes");
  return {text.whole(line, 1, "the number of headings", 1), text.whole(line, 2, "the number of frequencies", 1)};
}

/// The point of motions and loads, from `speed sinkage trim x z`, with z from still water.
Eigen::Vector3d read_motion_point(NumberStream& in, const TextLines& text, const VeresHeader& header) {
  const int line = in.line();
  if (const double speed = in.next("the speed"); speed != 0)
    text.refuse(line, fmt::format("the data are for a forward speed of {} m/s", speed),
                "Froude's bodies keep their place: run VERES for speed zero");
  if (in.next("the sinkage") != 0 || in.next("the trim") != 0)
    text.refuse(line, "the ship has sinkage or trim", "Froude needs the data of the ship afloat without them");
  const double x = in.next("the x of the motions' point"), z = in.next("the z of the motions' point");
  return {x, 0, z - header.draught};
}

Matrix6 read_matrix(NumberStream& in, const char* what) {
  Matrix6 m;
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = 0; j < 6; ++j) m(i, j) = in.next(what);
  return m;
}

/// What the .re7 file holds at one frequency.
struct VeresPoint {
  Matrix6 A, B, C;
  bool has_additions;  ///< further A, B, C of tanks, foils, viscous roll
};

VeresPoint read_point(NumberStream& in, bool version2) {
  VeresPoint p{};
  const auto matrix = [&](const char* what) {
    const Matrix6 m = read_matrix(in, what);
    if (version2) p.has_additions = !read_matrix(in, what).isZero(0) || p.has_additions;
    return m;
  };
  p.A = matrix("added mass");
  p.B = matrix("damping");
  p.C = matrix("restoring");
  for (int i = 0; i < 3; ++i) p.has_additions = in.next("roll damping") != 0 || p.has_additions;
  return p;
}

bool is_version2(const TextLines& text) { return text.words(10).size() == 2; }

void require_same(bool is_same, const TextLines& text, int line, const char* what) {
  if (!is_same)
    text.refuse(line, fmt::format("{} differ from those of the first heading", what),
                "without forward speed they cannot depend on the heading");
}

void fill_radiation(Coefficients& c, const TextLines& text, NumberStream& in, const Counts& n, bool version2) {
  bool has_additions = false;
  for (int h = 0; h < n.headings; ++h) {
    in.next("a heading");
    for (int k = 0; k < n.frequencies; ++k) {
      const int line = in.line();
      const double omega = in.next("a frequency");
      const VeresPoint p = read_point(in, version2);
      has_additions = has_additions || p.has_additions;
      const auto at = static_cast<std::size_t>(k);
      if (h == 0) {
        c.omega.push_back(omega);
        c.A.emplace_back(p.A);
        c.B.emplace_back(p.B);
        if (k == 0) c.C = p.C;
      }
      require_same(omega == c.omega[at], text, line, "frequencies");
      require_same(p.A == c.A[at] && p.B == c.B[at] && p.C == *c.C, text, line, "coefficients");
    }
  }
  if (has_additions)
    c.notes.push_back(
        "additional added mass, damping (viscous roll) and restoring are left out: they are no potential theory");
}

/// `mode Re Im` for six modes at each heading and frequency, as a table per heading.
struct TransferFunctions {
  VeresHeader header;
  Eigen::Vector3d point;
  std::vector<double> omega, heading;  ///< rad/s; rad, VERES's
  std::vector<Eigen::MatrixXcd> value;
};

TransferFunctions read_transfer_functions(const fs::path& path) {
  const TextLines text = TextLines::read(path);
  TransferFunctions out;
  out.header = read_header(text, true);
  const Counts n = read_counts(text, 10, true);
  NumberStream in(text, 11);
  out.point = read_motion_point(in, text, out.header);
  for (int h = 0; h < n.headings; ++h) {
    out.heading.push_back(Angle::from_degrees(in.next("a heading")).radians());
    Eigen::MatrixXcd& value = out.value.emplace_back(6, n.frequencies);
    for (Eigen::Index k = 0; k < n.frequencies; ++k) {
      const int line = in.line();
      const double omega = in.next("a frequency");
      if (h == 0) out.omega.push_back(omega);
      require_same(omega == out.omega[static_cast<std::size_t>(k)], text, line, "frequencies");
      for (int i = 0; i < 6; ++i) {
        if (const int mode = in.next_whole("a mode", 1); mode != i + 1)
          text.refuse(in.line(), fmt::format("mode {} stands where mode {} is needed", mode, i + 1));
        const double re = in.next("a real part"), im = in.next("an imaginary part");
        value(i, k) = {re, im};
      }
    }
  }
  if (!in.at_end_of_numbers()) text.refuse(in.line(), "there are more numbers than headings and frequencies");
  return out;
}

/// Where the phases of the file begin: the motions' point, so the wave has a way to go from the origin (P26).
void count_phases_from_origin(std::vector<Eigen::MatrixXcd>& value, const std::vector<double>& omega,
                              const std::vector<double>& heading, const Eigen::Vector3d& point, const Water& water) {
  for (std::size_t h = 0; h < heading.size(); ++h)
    for (std::size_t k = 0; k < omega.size(); ++k)
      value[h].col(static_cast<Eigen::Index>(k)) *=
          std::polar(1.0, -waves::wavenumber(omega[k], water) * point.x() * std::cos(heading[h]));
}

void fill_excitation(Coefficients& c, const fs::path& path) {
  TransferFunctions f = read_transfer_functions(path);
  const auto refuse = [&](const char* what) {
    throw InputError(fmt::format("{} not those of the .re7 file", what), {.file = path.string()},
                     "the files must come from one run");
  };
  if (f.omega != c.omega) refuse("frequencies are");
  if (f.point != *c.body.front().reference_point) refuse("the point of the loads is");
  if (f.header.density != c.water.density || f.header.gravity != c.water.gravity) refuse("density and gravity are");
  count_phases_from_origin(f.value, f.omega, f.heading, f.point, c.water);
  const auto order = order_headings(f.heading, path);
  c.heading = picked(f.heading, order);
  for (const std::size_t h : order) c.X.push_back(f.value[h]);
}

Coefficients read_veres(const fs::path& path, const ReadOptions& options) {
  fs::path radiation = path, excitation = path;
  radiation.replace_extension(".re7");
  excitation.replace_extension(".re8");
  if (path.extension() != ".re7" && !fs::exists(radiation))
    throw InputError("a file of VERES, but not that of the coefficients", {.file = path.string()},
                     "give the .re7 file; the .re8 file beside it holds the excitation");
  if (!options.depth)
    throw InputError("VERES's files do not hold the depth of the water", {.file = radiation.string()},
                     "state it: in the [water] table of a scene, or as an option of `froude bem`");
  const TextLines text = TextLines::read(radiation);
  const VeresHeader header = read_header(text, true);
  const bool version2 = is_version2(text);
  const int counts = version2 ? 11 : 10;
  const Counts n = read_counts(text, counts, true);
  NumberStream in(text, counts + 1);
  read_matrix(in, "the mass matrix");
  Coefficients c;
  c.water = {header.density, header.gravity, *options.depth};
  c.source = fmt::format("VERES {}", radiation.string());
  BodyData& body = c.body.emplace_back();
  body.name = "ship";
  body.reference_point = read_motion_point(in, text, header);
  body.centre_of_gravity = Eigen::Vector3d(header.gravity_centre.x(), 0, header.gravity_centre.y() - header.draught);
  fill_radiation(c, text, in, n, version2);
  if (fs::exists(excitation)) {
    fill_excitation(c, excitation);
    c.source += ", .re8";
  } else {
    c.notes.push_back(fmt::format("no excitation: there is no {}", excitation.filename().string()));
  }
  if (c.A.front()(0, 0) == 0) c.notes.push_back("surge has no added mass and damping: this is strip theory");
  c = turned(std::move(c), std::numbers::pi);
  c.notes.back() = "axes are turned by 180 degrees: x forward, y to port, origin at Lpp/2 in still water";
  return c;
}

}  // namespace

RaoTable read_veres_rao(const fs::path& path) {
  const TransferFunctions f = read_transfer_functions(path);
  // The same turn as that of the loads: motions are vectors too.
  Coefficients as_loads;
  as_loads.body.emplace_back();
  as_loads.omega = f.omega;
  const auto order = order_headings(f.heading, path);
  as_loads.heading = picked(f.heading, order);
  for (const std::size_t h : order) as_loads.X.push_back(f.value[h]);
  as_loads = turned(std::move(as_loads), std::numbers::pi);
  RaoTable rao;
  rao.omega = f.omega;
  rao.heading = as_loads.heading;
  rao.mode = {0, 1, 2, 3, 4, 5};
  rao.motion = as_loads.X;
  rao.source = "VERES " + path.string();
  rao.notes = {fmt::format("motions of, and phases relative to the wave at, the point ({:.6g}, 0, {:.6g}) m",
                           -f.point.x(), f.point.z())};
  return rao;
}

DriftForces read_veres_drift(const fs::path& path) {
  const TextLines text = TextLines::read(path);
  const VeresHeader header = read_header(text, false);
  const Counts n = read_counts(text, 9, false);
  NumberStream in(text, 10);
  Coefficients as_loads;
  as_loads.body.emplace_back();
  const double rho_g_b2 = header.density * header.gravity * header.breadth * header.breadth;
  std::vector<Eigen::MatrixXcd> load;
  std::vector<double> heading;
  for (int h = 0; h < n.headings; ++h) {
    if (in.next("the speed") != 0) text.refuse(in.line(), "the data are for a ship under way");
    heading.push_back(Angle::from_degrees(in.next("a heading")).radians());
    load.emplace_back(Eigen::MatrixXcd::Zero(6, n.frequencies));
    for (Eigen::Index k = 0; k < n.frequencies; ++k) {
      const int line = in.line();
      const double omega = in.next("a frequency");
      if (h == 0) as_loads.omega.push_back(omega);
      require_same(omega == as_loads.omega[static_cast<std::size_t>(k)], text, line, "frequencies");
      // ρ g B²/Lpp for forces, ρ g B² for the moment (P26).
      load.back()(0, k) = in.next("the surge drift") * rho_g_b2 / header.length;
      load.back()(1, k) = in.next("the sway drift") * rho_g_b2 / header.length;
      load.back()(5, k) = in.next("the yaw drift") * rho_g_b2;
    }
  }
  const auto order = order_headings(heading, path);
  as_loads.heading = picked(heading, order);
  for (const std::size_t h : order) as_loads.X.push_back(load[h]);
  as_loads = turned(std::move(as_loads), std::numbers::pi);
  DriftForces drift;
  drift.omega = as_loads.omega;
  drift.mode = {0, 1, 5};
  for (std::size_t h = 0; h < order.size(); ++h) {
    drift.heading.push_back({as_loads.heading[h], as_loads.heading[h]});
    drift.load.emplace_back(as_loads.X[h](drift.mode, Eigen::all));
  }
  drift.method = "as VERES was asked to";
  drift.source = "VERES " + path.string();
  drift.notes = {"the file does not say about which point the yaw moment is"};
  return drift;
}

const Format veres_files{[](const Candidate& c) { return c.first_line().find("VERES") != std::string_view::npos; },
                         read_veres};

}  // namespace hydro::potential
