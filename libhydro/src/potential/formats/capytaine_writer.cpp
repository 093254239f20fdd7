#include <limits>
#include <set>

#include "hydro/base/error.hpp"
#include "hydro/base/types.hpp"
#include "hydro/potential/formats/writers.hpp"
#include "netcdf_output.hpp"

namespace hydro::potential {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Names by which modes of different bodies can be told apart.
std::vector<std::string> distinct_names(const Coefficients& c, std::vector<std::string>& told) {
  std::vector<std::string> names;
  std::set<std::string> used;
  for (std::size_t b = 0; b < c.body.size(); ++b) {
    std::string name = c.body[b].name.empty() ? fmt::format("body{}", b + 1) : c.body[b].name;
    while (!used.insert(name).second) name += fmt::format("_{}", b + 1);
    if (name != c.body[b].name)
      told.push_back(
          fmt::format("body {}: its name \"{}\" cannot be used and is written as \"{}\"", b + 1, c.body[b].name, name));
    names.push_back(name);
  }
  return names;
}

/// `Heave`, or `<body>__Heave` for several bodies.
std::vector<std::string> mode_labels(const std::vector<std::string>& names) {
  std::vector<std::string> labels;
  for (const std::string& name : names)
    for (const std::string_view mode : mode_names) {
      std::string label(mode);
      label[0] = static_cast<char>(label[0] - 'a' + 'A');
      labels.push_back(names.size() == 1 ? label : name + "__" + label);
    }
  return labels;
}

/// The table's frequencies with the limits at its ends, and the matrix at each.
struct Rows {
  std::vector<double> omega, A, B;
};

Rows rows_with_limits(const Coefficients& c) {
  Rows rows;
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(c.modes(), c.modes());
  const auto add = [&](double omega, const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
    rows.omega.push_back(omega);
    append(rows.A, A);
    append(rows.B, B);
  };
  if (c.A_zero) add(0, *c.A_zero, none);
  for (std::size_t k = 0; k < c.omega.size(); ++k) add(c.omega[k], c.A[k], c.B[k]);
  if (c.A_inf) add(infinity, *c.A_inf, none);
  return rows;
}

/// Axes complex, omega, wave_direction, influenced_dof; the conjugate of ours (P7). Nothing is known at the limits.
std::vector<double> forces(const Coefficients& c, const std::vector<double>& omega) {
  std::vector<double> values;
  for (const bool is_imaginary : {false, true}) {
    Eigen::Index k = 0;
    for (const double w : omega) {
      const bool is_limit = w == 0 || w == infinity;
      for (const auto& X : c.X)
        for (Eigen::Index i = 0; i < X.rows(); ++i)
          values.push_back(is_limit ? unknown : is_imaginary ? -X(i, k).imag() : X(i, k).real());
      if (!is_limit) ++k;
    }
  }
  return values;
}

void write_water(NetcdfOutput& out, const Water& water) {
  out.scalar("/rho", water.density, "kg/m^3", "water density");
  out.scalar("/g", water.gravity, "m/s^2", "gravity");
  out.scalar("/water_depth", water.depth.metres(), "m", "water depth");
  out.scalar("/forward_speed", 0, "m/s", "forward speed");
}

void write_bodies(NetcdfOutput& out, const Coefficients& c, const std::vector<std::string>& names) {
  out.names("/body", names);
  out.names("/space_coordinate", {"x", "y", "z"});
  const auto points = [&](const char* name, std::optional<Eigen::Vector3d> BodyData::*member, const char* what) {
    std::vector<double> values;
    for (const BodyData& body : c.body)
      for (Eigen::Index i = 0; i < 3; ++i) values.push_back(body.*member ? (*(body.*member))(i) : unknown);
    out.table(name, values, {"/body", "/space_coordinate"}, {c.body.size(), 3}, "m", what);
  };
  points("/rotation_center", &BodyData::reference_point, "point of rotations and moments");
  points("/center_of_mass", &BodyData::centre_of_gravity, "centre of mass");
  points("/center_of_buoyancy", &BodyData::centre_of_buoyancy, "centre of buoyancy");
  std::vector<double> volume, mass;
  for (const BodyData& body : c.body) {
    volume.push_back(body.displaced_volume.value_or(unknown));
    mass.push_back(volume.back() * c.water.density);
  }
  out.table("/disp_volume", volume, {"/body"}, {volume.size()}, "m^3", "displaced volume");
  out.table("/disp_mass", mass, {"/body"}, {mass.size()}, "kg", "mass of the displaced water");
}

}  // namespace

std::vector<std::string> write_capytaine(const Coefficients& c, const std::filesystem::path& path) {
  c.validate();
  std::vector<std::string> told;
  const std::vector<std::string> names = distinct_names(c, told), labels = mode_labels(names);
  const Rows rows = rows_with_limits(c);
  const std::size_t n = labels.size();
  io::Hdf5Writer file;
  NetcdfOutput out(file);
  file.attribute("/", "source", c.source);
  out.axis("/omega", rows.omega, "rad/s", "angular frequency");
  out.names("/influenced_dof", labels);
  out.names("/radiating_dof", labels);
  write_water(out, c.water);
  const std::vector<std::string> axes{"/omega", "/influenced_dof", "/radiating_dof"};
  out.table("/added_mass", rows.A, axes, {rows.omega.size(), n, n}, "kg, kg m, kg m^2", "added mass");
  out.table("/radiation_damping", rows.B, axes, {rows.omega.size(), n, n}, "kg/s, kg m/s, kg m^2/s",
            "radiation damping");
  if (!c.X.empty()) {
    out.names("/complex", {"re", "im"});
    out.axis("/wave_direction", c.heading, "rad", "wave direction");
    out.table("/excitation_force", forces(c, rows.omega), {"/complex", "/omega", "/wave_direction", "/influenced_dof"},
              {2, rows.omega.size(), c.heading.size(), n}, "N/m, N", "excitation force");
  }
  if (c.C) {
    std::vector<double> C;
    append(C, *c.C);
    out.table("/hydrostatic_stiffness", C, {"/influenced_dof", "/radiating_dof"}, {n, n}, "N/m, N, N m",
              "hydrostatic stiffness");
  }
  write_bodies(out, c, names);
  if (!c.notes.empty()) told.push_back("notes on where the data come from: Capytaine's layout has no place for them");
  file.save(path);
  return told;
}

}  // namespace hydro::potential
