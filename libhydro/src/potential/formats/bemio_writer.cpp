#include <cmath>
#include <limits>
#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/io/hdf5.hpp"
#include "hydro/potential/formats/writers.hpp"
#include "hydro/potential/operations/operations.hpp"
#include "potential/readers.hpp"

namespace hydro::potential {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// The same data about the centres of gravity  (P4); a body of which one of the two points is unknown stays.
Coefficients about_centres_of_gravity(const Coefficients& c) {
  std::vector<Eigen::Vector3d> from, to;
  for (const BodyData& body : c.body) {
    const bool knows_both = body.reference_point && body.centre_of_gravity;
    from.push_back(knows_both ? *body.reference_point : Eigen::Vector3d::Zero().eval());
    to.push_back(knows_both ? *body.centre_of_gravity : Eigen::Vector3d::Zero().eval());
  }
  return from == to ? c : about(c, from, to);  // where nothing moves every bit is kept
}

std::string shown(const Eigen::Vector3d& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", p.x(), p.y(), p.z()); }

/// What becomes of the points of one body, in a sentence; empty if nothing is lost.
void explain_points(const BodyData& body, std::vector<std::string>& left_out) {
  const auto& R = body.reference_point;
  const auto& G = body.centre_of_gravity;
  if (R && G && *R != *G)
    left_out.push_back(
        fmt::format("body \"{}\": coefficients are moved from the reference point {} to the centre of "
                    "gravity {}, about which BEMIO's are",
                    body.name, shown(*R), shown(*G)));
  if (R && !G)
    left_out.push_back(
        fmt::format("body \"{}\": the centre of gravity is unknown; the reference point {} stands in its "
                    "place, about which the coefficients are",
                    body.name, shown(*R)));
  if (!R && G)
    left_out.push_back(
        fmt::format("body \"{}\": the reference point is unknown, and BEMIO's readers will take the centre "
                    "of gravity {} for it",
                    body.name, shown(*G)));
  if (!R && !G)
    left_out.push_back(
        fmt::format("body \"{}\": neither centre of gravity nor reference point is known; cg is NaN and "
                    "must be filled in before WEC-Sim reads the file",
                    body.name));
  if (!body.centre_of_buoyancy)
    left_out.push_back(fmt::format("body \"{}\": cb is unknown and written as NaN", body.name));
  if (!body.displaced_volume)
    left_out.push_back(fmt::format("body \"{}\": disp_vol is unknown and written as NaN", body.name));
}

bool couples_bodies(const Eigen::MatrixXd& C) {
  for (Eigen::Index i = 0; i < C.rows(); ++i)
    for (Eigen::Index j = 0; j < C.cols(); ++j)
      if (i / 6 != j / 6 && C(i, j) != 0) return true;
  return false;
}

std::vector<std::string> explain(const Coefficients& c) {
  std::vector<std::string> left_out;
  if (c.A_zero) left_out.push_back("added mass at zero frequency: BEMIO has no place for it");
  if (!c.A_inf) left_out.push_back("inf_freq is not written: added mass at infinite frequency is unknown");
  if (!c.C) left_out.push_back("linear_restoring_stiffness is not written: there is no restoring matrix");
  if (c.X.empty()) left_out.push_back("excitation is not written: there is none");
  if (c.C && couples_bodies(*c.C))
    left_out.push_back("restoring between different bodies: BEMIO stores one 6 by 6 block a body");
  if (!c.notes.empty()) left_out.push_back("notes on where the data come from: BEMIO has no place for them");
  for (const BodyData& body : c.body) explain_points(body, left_out);
  return left_out;
}

/// Thin words around the writer: shapes and attributes as BEMIO has them.
struct BemioOutput {
  io::Hdf5Writer file;

  void number(const std::string& name, double value) { file.write(name, {&value, 1}, {1, 1}); }
  void column(const std::string& name, const std::vector<double>& values) {
    file.write(name, values, {values.size(), 1});
  }
  void point(const std::string& name, const std::optional<Eigen::Vector3d>& p) {
    column(name, p ? std::vector<double>{p->x(), p->y(), p->z()} : std::vector<double>(3, unknown));
  }
  void describe(const std::string& name, const char* description, const char* units) {
    file.attribute(name, "description", description);
    file.attribute(name, "units", units);
  }
};

void write_parameters(BemioOutput& out, const Coefficients& c) {
  const std::string group = "/simulation_parameters/";
  std::vector<double> periods, degrees;
  for (const double omega : c.omega) periods.push_back(2 * std::numbers::pi / omega);
  for (const double beta : c.heading) degrees.push_back(Angle::from_radians(beta).degrees());
  out.number(group + "rho", c.water.density);
  out.number(group + "g", c.water.gravity);
  out.number(group + "scaled", 0);
  out.column(group + "w", c.omega);
  out.column(group + "T", periods);
  if (!degrees.empty()) out.column(group + "wave_dir", degrees);
  if (c.water.depth.is_infinite()) {
    out.file.write_text(group + "water_depth", "infinite");
  } else {
    out.number(group + "water_depth", c.water.depth.metres());
  }
  out.describe(group + "rho", "Water density", "kg/m^3");
  out.describe(group + "g", "Gravitational acceleration", "m/s^2");
  out.describe(group + "w", "Wave frequencies", "rad/s");
  out.describe(group + "T", "Wave periods", "s");
  if (!degrees.empty()) out.describe(group + "wave_dir", "Wave direction", "deg");
}

void write_properties(BemioOutput& out, const BodyData& body, int number) {
  const std::string group = fmt::format("/body{}/properties/", number);
  out.file.write_text(group + "name", body.name);
  out.point(group + "cg", body.centre_of_gravity ? body.centre_of_gravity : body.reference_point);
  out.point(group + "cb", body.centre_of_buoyancy);
  out.number(group + "disp_vol", body.displaced_volume.value_or(unknown));
  out.number(group + "dof", 6);
  out.number(group + "dof_start", 6 * number - 5);
  out.number(group + "dof_end", 6 * number);
  out.number(group + "body_number", number);
}

/// Ã = A/ρ and B̃ = B/(ρω), shape (6, 6N, Nω)  (P10).
void write_radiation(BemioOutput& out, const Coefficients& c, int b) {
  const std::string group = fmt::format("/body{}/hydro_coeffs/", b + 1);
  const double rho = c.water.density;
  std::vector<double> A, B, A_inf;
  for (Eigen::Index i = 6 * b; i < 6 * b + 6; ++i)
    for (Eigen::Index j = 0; j < c.modes(); ++j) {
      for (std::size_t k = 0; k < c.omega.size(); ++k) {
        A.push_back(c.A[k](i, j) / rho);
        B.push_back(c.B[k](i, j) / (rho * c.omega[k]));
      }
      if (c.A_inf) A_inf.push_back((*c.A_inf)(i, j) / rho);
    }
  const std::size_t columns = static_cast<std::size_t>(c.modes());
  out.file.write(group + "added_mass/all", A, {6, columns, c.omega.size()});
  out.file.write(group + "radiation_damping/all", B, {6, columns, c.omega.size()});
  out.describe(group + "added_mass/all", "Added mass divided by density", "m^3, m^4, m^5");
  out.describe(group + "radiation_damping/all", "Radiation damping divided by density and frequency", "m^3, m^4, m^5");
  if (c.A_inf) out.file.write(group + "added_mass/inf_freq", A_inf, {6, columns});
}

/// X̃ = X/(ρg), shape (6, Nβ, Nω), as parts and as modulus and phase; C̃ = C/(ρg)  (P10).
void write_loads(BemioOutput& out, const Coefficients& c, int b) {
  const std::string group = fmt::format("/body{}/hydro_coeffs/", b + 1);
  const double rho_g = c.water.density * c.water.gravity;
  std::vector<double> re, im, mag, phase, C;
  for (Eigen::Index i = 6 * b; i < 6 * b + 6; ++i) {
    for (const auto& X : c.X)
      for (Eigen::Index k = 0; k < X.cols(); ++k) {
        const std::complex<double> value = X(i, k) / rho_g;
        re.push_back(value.real());
        im.push_back(value.imag());
        mag.push_back(std::abs(value));
        phase.push_back(std::arg(value));
      }
    for (Eigen::Index j = 6 * b; c.C && j < 6 * b + 6; ++j) C.push_back((*c.C)(i, j) / rho_g);
  }
  const std::vector<std::size_t> shape{6, c.heading.size(), c.omega.size()};
  if (!c.X.empty()) {
    out.file.write(group + "excitation/re", re, shape);
    out.file.write(group + "excitation/im", im, shape);
    out.file.write(group + "excitation/mag", mag, shape);
    out.file.write(group + "excitation/phase", phase, shape);
    out.describe(group + "excitation/phase", "Phase of the excitation, positive when it leads the wave", "rad");
  }
  if (c.C) out.file.write(group + "linear_restoring_stiffness", C, {6, 6});
}

}  // namespace

std::vector<std::string> write_bemio(const Coefficients& coefficients, const std::filesystem::path& path) {
  coefficients.validate();
  const Coefficients c = about_centres_of_gravity(coefficients);
  BemioOutput out;
  out.file.write_text("/bem_data/code", c.source);
  write_parameters(out, c);
  for (int b = 0; b < c.bodies(); ++b) {
    write_properties(out, coefficients.body[static_cast<std::size_t>(b)], b + 1);
    write_radiation(out, c, b);
    write_loads(out, c, b);
  }
  out.file.save(path);
  return explain(coefficients);
}

}  // namespace hydro::potential
