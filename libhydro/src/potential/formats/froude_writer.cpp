#include <limits>

#include "hydro/io/hdf5.hpp"
#include "hydro/potential/formats/writers.hpp"
#include "netcdf_output.hpp"
#include "potential/readers.hpp"

namespace hydro::potential {
namespace {

constexpr double not_stated = std::numeric_limits<double>::quiet_NaN();

constexpr const char* mass_units = "kg, kg m, kg m2";
constexpr const char* damping_units = "kg/s, kg m/s, kg m2/s";
constexpr const char* stiffness_units = "N/m, N, N m";
constexpr const char* load_units = "N/m, N";

const std::vector<std::string> square{"/load_mode", "/motion_mode"};

void write_axes(NetcdfOutput& out, const Coefficients& c) {
  const std::size_t n = static_cast<std::size_t>(c.modes());
  out.axis("/omega", c.omega, "rad/s", "angular frequency");
  if (!c.heading.empty()) out.axis("/heading", c.heading, "rad", "where the wave goes, from +x towards +y");
  out.axis("/load_mode", n, "mode of the load: surge ... yaw of body 1, of body 2, ...");
  out.axis("/motion_mode", n, "mode of the motion: surge ... yaw of body 1, of body 2, ...");
  out.axis("/body", c.body.size(), "number of the body");
  out.axis("/axis", 3, "x, y, z");
}

void write_matrices(NetcdfOutput& out, const Coefficients& c) {
  const std::size_t n = static_cast<std::size_t>(c.modes());
  std::vector<double> A, B;
  for (const auto& m : c.A) append(A, m);
  for (const auto& m : c.B) append(B, m);
  out.table("/added_mass", A, {"/omega", "/load_mode", "/motion_mode"}, {c.omega.size(), n, n}, mass_units,
            "added mass A");
  out.table("/radiation_damping", B, {"/omega", "/load_mode", "/motion_mode"}, {c.omega.size(), n, n}, damping_units,
            "radiation damping B");
  const auto matrix = [&](const char* name, const std::optional<Eigen::MatrixXd>& m, const char* units,
                          const char* what) {
    if (!m) return;
    std::vector<double> values;
    append(values, *m);
    out.table(name, values, square, {n, n}, units, what);
  };
  matrix("/added_mass_zero", c.A_zero, mass_units, "added mass at zero frequency");
  matrix("/added_mass_infinite", c.A_inf, mass_units, "added mass at infinite frequency");
  matrix("/restoring", c.C, stiffness_units, "hydrostatic and gravitational restoring C");
}

void write_excitation(NetcdfOutput& out, const Coefficients& c) {
  if (c.X.empty()) return;
  std::vector<double> re, im;
  for (const auto& X : c.X) {
    append(re, X.real());
    append(im, X.imag());
  }
  const std::vector<std::size_t> shape{c.heading.size(), static_cast<std::size_t>(c.modes()), c.omega.size()};
  const std::vector<std::string> axes{"/heading", "/load_mode", "/omega"};
  out.table("/excitation_re", re, axes, shape, load_units, "real part of the excitation X per metre of amplitude");
  out.table("/excitation_im", im, axes, shape, load_units, "imaginary part of the excitation X per metre of amplitude");
}

void write_bodies(NetcdfOutput& out, const Coefficients& c) {
  const std::size_t n = c.body.size();
  std::vector<std::string> names;
  std::vector<double> volume;
  for (const BodyData& body : c.body) {
    names.push_back(body.name);
    volume.push_back(body.displaced_volume.value_or(not_stated));
  }
  out.texts("/body_name", names, "/body");
  out.table("/displaced_volume", volume, {"/body"}, {n}, "m3", "displaced volume; NaN: unknown");
  const auto points = [&](const char* name, std::optional<Eigen::Vector3d> BodyData::*member, const char* what) {
    std::vector<double> values;
    for (const BodyData& body : c.body)
      for (Eigen::Index i = 0; i < 3; ++i) values.push_back(body.*member ? (*(body.*member))(i) : not_stated);
    out.table(name, values, {"/body", "/axis"}, {n, 3}, "m", what);
  };
  points("/reference_point", &BodyData::reference_point, "reference point, global frame; NaN: unknown");
  points("/centre_of_gravity", &BodyData::centre_of_gravity, "centre of gravity, global frame; NaN: unknown");
  points("/centre_of_buoyancy", &BodyData::centre_of_buoyancy, "centre of buoyancy, global frame; NaN: unknown");
}

}  // namespace

std::vector<std::string> write_froude(const Coefficients& c, const std::filesystem::path& path) {
  c.validate();
  io::Hdf5Writer file;
  NetcdfOutput out(file);
  file.attribute("/", "format", froude_format);
  file.attribute("/", "format_version", 1.0);
  file.attribute(
      "/", "convention",
      "Re(X exp(+i omega t)); x forward, y port, z up, origin in the still waterplane; phases at the origin");
  file.write_text("/source", c.source);
  write_axes(out, c);
  out.scalar("/density", c.water.density, "kg/m3", "density of water");
  out.scalar("/gravity", c.water.gravity, "m/s2", "acceleration of gravity");
  out.scalar("/water_depth", c.water.depth.metres(), "m", "depth of still water; inf: deep");
  write_matrices(out, c);
  write_excitation(out, c);
  write_bodies(out, c);
  if (!c.notes.empty()) {
    out.axis("/note", c.notes.size(), "number of the note");
    out.texts("/note_text", c.notes, "/note");
  }
  file.save(path);
  return {};
}

}  // namespace hydro::potential
