#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "capytaine.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/netcdf.hpp"
#include "potential/readers.hpp"

namespace hydro::potential {
namespace {

namespace fs = std::filesystem;

using Matrices = std::vector<Eigen::MatrixXd>;

/// The file and what its axes mean.
struct CapytaineFile {
  explicit CapytaineFile(const fs::path& p) : path(p), file(p) {}
  [[noreturn]] void refuse(const std::string& rule, const std::string& remedy = {}) const {
    throw InputError(rule, {.file = path.string()}, remedy);
  }

  fs::path path;
  io::NetcdfReader file;
  Water water;
  std::string frequency_axis;
  std::vector<double> omega;  ///< in the order of the file, limits included
  FrequencyOrder order;
  CapytaineDofs influenced, radiating;
};

Water read_water(const CapytaineFile& in) {
  const double depth = in.file.scalar("water_depth");
  if (!(depth > 0)) in.refuse(fmt::format("water_depth must be positive, got {} m", depth));
  return {in.file.scalar("rho"), in.file.scalar("g"),
          std::isinf(depth) ? WaterDepth::infinite() : WaterDepth::from_metres(depth)};
}

/// ω from whichever of the five measures of frequency the file holds (P9).
std::vector<double> to_omega(const std::string& measure, std::vector<double> values, const Water& water) {
  constexpr double two_pi = 2 * std::numbers::pi;
  for (double& v : values) {
    if (measure == "freq") v = two_pi * v;
    if (measure == "period") v = two_pi / v;
    if (measure == "wavelength") v = two_pi / v;
    if (measure == "wavenumber" || measure == "wavelength") v = frequency_of_wavenumber(v, water);
  }
  return values;
}

constexpr std::array<const char*, 5> frequency_measures{"omega", "freq", "period", "wavenumber", "wavelength"};

void read_frequencies(CapytaineFile& in) {
  const auto axes = in.file.axes("added_mass");
  for (const char* name : frequency_measures)
    if (std::find(axes.begin(), axes.end(), name) != axes.end()) in.frequency_axis = name;
  // A single frequency may have been squeezed away: then any of the measures stands as a scalar.
  for (const char* name : frequency_measures) {
    if (!in.file.has(name) || !in.omega.empty()) continue;
    if (in.file.axes(name) ==
        (in.frequency_axis.empty() ? std::vector<std::string>{} : std::vector<std::string>{in.frequency_axis}))
      in.omega = to_omega(name, in.file.numbers(name).values, in.water);
  }
  if (in.omega.empty())
    in.refuse("there is no frequency", "added_mass needs a coordinate omega, freq, period, wavenumber or wavelength");
  if (in.frequency_axis.empty()) in.frequency_axis = "omega";
  in.order = order_frequencies(in.omega, in.path);
}

void read_dofs(CapytaineFile& in) {
  in.influenced = order_dofs(in.file.texts("influenced_dof"), in.path, "influenced_dof");
  in.radiating = order_dofs(in.file.texts("radiating_dof"), in.path, "radiating_dof");
  if (in.influenced.body != in.radiating.body) in.refuse("influenced_dof and radiating_dof name different bodies");
}

/// One (6N, 6N) matrix for each frequency of the file; rows: influenced, columns: radiating.
Matrices read_matrices(const CapytaineFile& in, const std::string& variable) {
  const std::size_t n = in.influenced.index_in_file.size(), frequencies = in.omega.size();
  const auto values =
      in.file.arranged(variable, {{in.frequency_axis, frequencies}, {"influenced_dof", n}, {"radiating_dof", n}});
  Matrices out(frequencies, Eigen::MatrixXd(n, n));
  for (std::size_t k = 0; k < frequencies; ++k)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        out[k](static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            values[(k * n + in.influenced.index_in_file[i]) * n + in.radiating.index_in_file[j]];
  return out;
}

void require_finite_matrix(const Eigen::MatrixXd& m, const CapytaineFile& in, const std::string& what) {
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j < m.cols(); ++j)
      if (!std::isfinite(m(i, j)))
        require_finite(m(i, j), in.path, fmt::format("{} of {} by motion in {}", what, mode_label(i), mode_label(j)));
}

/// Capytaine fills the results of a case that it could not solve with NaN. A frequency at which nothing was solved is
/// not part of the table; single numbers missing are refused later.
void leave_out_unsolved(Coefficients& c, CapytaineFile& in, const Matrices& A, const Matrices& B) {
  std::vector<std::string> left_out;
  std::erase_if(in.order.finite, [&](std::size_t k) {
    const bool is_unsolved = A[k].array().isNaN().all() && B[k].array().isNaN().all();
    if (is_unsolved) left_out.push_back(fmt::format("{:.6g}", in.omega[k]));
    return is_unsolved;
  });
  if (in.order.finite.empty()) in.refuse("no frequency was solved: all of added_mass and radiation_damping is NaN");
  if (!left_out.empty())
    c.notes.push_back(
        fmt::format("omega = {} rad/s: all of added_mass and radiation_damping is NaN there, which is how "
                    "failed computations are stored; left out",
                    fmt::join(left_out, ", ")));
}

void fill_radiation(Coefficients& c, CapytaineFile& in) {
  const Matrices A = read_matrices(in, "added_mass"), B = read_matrices(in, "radiation_damping");
  leave_out_unsolved(c, in, A, B);
  const auto checked = [&](const Matrices& m, std::size_t k, const char* variable) {
    require_finite_matrix(m[k], in, fmt::format("{} at omega = {:.6g} rad/s", variable, in.omega[k]));
    return m[k];
  };
  for (const std::size_t k : in.order.finite) {
    c.A.push_back(checked(A, k, "added_mass"));
    c.B.push_back(checked(B, k, "radiation_damping"));
  }
  if (in.order.zero) c.A_zero = checked(A, *in.order.zero, "added_mass");
  if (in.order.infinite) c.A_inf = checked(A, *in.order.infinite, "added_mass");
  c.omega = picked(in.omega, in.order.finite);
}

/// Positions of "re" and "im" along the axis `complex`.
std::array<std::size_t, 2> parts(const CapytaineFile& in) {
  const auto labels = in.file.texts("complex");
  const auto at = [&](const char* name) {
    const auto found = std::find(labels.begin(), labels.end(), name);
    if (found == labels.end()) in.refuse(fmt::format("the axis \"complex\" has no \"{}\"", name));
    return static_cast<std::size_t>(found - labels.begin());
  };
  return {at("re"), at("im")};
}

/// Adds one force variable to c.X, conjugated: Capytaine writes amplitudes of e^{−iωt}, ours are of e^{+iωt} (P7).
void add_force(Coefficients& c, const CapytaineFile& in, const std::string& variable,
               const std::vector<std::size_t>& headings) {
  const std::size_t n = in.influenced.index_in_file.size(), frequencies = in.omega.size(), count = headings.size();
  const auto values = in.file.arranged(
      variable, {{"complex", 2}, {in.frequency_axis, frequencies}, {"wave_direction", count}, {"influenced_dof", n}});
  const auto [re, im] = parts(in);
  const auto value = [&](std::size_t part, std::size_t k, std::size_t heading, std::size_t mode) {
    return values[((part * frequencies + k) * count + heading) * n + in.influenced.index_in_file[mode]];
  };
  for (std::size_t b = 0; b < count; ++b)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t f = 0; f < in.order.finite.size(); ++f) {
        const std::size_t k = in.order.finite[f];
        const std::complex<double> X(value(re, k, headings[b], i), value(im, k, headings[b], i));
        if (!std::isfinite(std::abs(X)))
          require_finite(
              std::abs(X), in.path,
              fmt::format("{} at omega = {:.6g} rad/s, heading {:.6g} deg, of {}", variable, in.omega[k],
                          Angle::from_radians(c.heading[b]).degrees(), mode_label(static_cast<Eigen::Index>(i))));
        c.X[b](static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(f)) += std::conj(X);
      }
}

void fill_excitation(Coefficients& c, const CapytaineFile& in) {
  std::vector<std::string> variables{"excitation_force"};
  if (!in.file.has("excitation_force")) variables = {"Froude_Krylov_force", "diffraction_force"};
  for (const auto& name : variables)
    if (!in.file.has(name)) {
      c.notes.push_back("no excitation: the file has neither excitation_force nor both of its parts");
      return;
    }
  const auto directions = in.file.numbers("wave_direction").values;
  const auto order = order_headings(directions, in.path);
  c.heading = picked(directions, order);
  c.X.assign(order.size(), Eigen::MatrixXcd::Zero(c.modes(), static_cast<Eigen::Index>(c.omega.size())));
  for (const auto& name : variables) add_force(c, in, name, order);
  if (variables.size() == 2) c.notes.push_back("excitation is the sum of Froude_Krylov_force and diffraction_force");
}

void fill_restoring(Coefficients& c, const CapytaineFile& in) {
  if (!in.file.has("hydrostatic_stiffness")) {
    c.notes.push_back("no restoring matrix: the file has no hydrostatic_stiffness");
    return;
  }
  const std::size_t n = in.influenced.index_in_file.size();
  const auto values = in.file.arranged("hydrostatic_stiffness", {{"influenced_dof", n}, {"radiating_dof", n}});
  Eigen::MatrixXd C(n, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      C(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          values[in.influenced.index_in_file[i] * n + in.radiating.index_in_file[j]];
  require_finite_matrix(C, in, "hydrostatic_stiffness");
  c.C = C;
}

/// The names along the axis of bodies of the file's own tables, if it has such an axis.
std::vector<std::string> body_labels(const CapytaineFile& in) {
  for (const char* axis : {"body", "rigid_body_component"})
    if (in.file.has(axis) && in.file.is_text(axis)) return in.file.texts(axis);
  return {};
}

/// A property with one row of `width` numbers for each body: where the row of body b begins, in the order of c.body.
std::vector<std::vector<double>> per_body(const Coefficients& c, const CapytaineFile& in, const std::string& variable,
                                          std::size_t width) {
  if (!in.file.has(variable)) return {};
  const auto array = in.file.numbers(variable);
  const std::size_t bodies = c.body.size();
  const bool has_rows = array.shape.empty() || width == 1 || array.shape.back() == width;
  if (array.values.size() != bodies * width || !has_rows)
    in.refuse(fmt::format("{} holds {} numbers; {} for each of {} bodies are needed", variable, array.values.size(),
                          width, bodies));
  const auto labels = body_labels(in);
  std::vector<std::vector<double>> out;
  for (std::size_t b = 0; b < bodies; ++b) {
    std::size_t row = b;
    if (bodies > 1) {
      const auto at = std::find(labels.begin(), labels.end(), c.body[b].name);
      if (at == labels.end())
        in.refuse(fmt::format("{} has no row for body \"{}\"", variable, c.body[b].name),
                  "the axis \"body\" must carry the names that stand before the modes");
      row = static_cast<std::size_t>(at - labels.begin());
    }
    const auto first = array.values.begin() + static_cast<std::ptrdiff_t>(row * width);
    out.emplace_back(first, first + static_cast<std::ptrdiff_t>(width));
  }
  return out;
}

std::string only_name(const CapytaineFile& in) {
  for (const char* variable : {"body", "body_name"})
    if (in.file.has(variable) && in.file.is_text(variable))
      if (const auto names = in.file.texts(variable); names.size() == 1 && !names.front().empty()) return names.front();
  return "body1";
}

void fill_bodies(Coefficients& c, const CapytaineFile& in) {
  for (const std::string& name : in.influenced.body) {
    c.body.emplace_back();
    c.body.back().name = name.empty() ? only_name(in) : name;
  }
  // NaN stands for "not stated" in these tables: Capytaine fills bodies without the property so.
  const auto points = [&](const char* variable, std::optional<Eigen::Vector3d> BodyData::*member) {
    const auto rows = per_body(c, in, variable, 3);
    for (std::size_t b = 0; b < rows.size(); ++b) {
      const Eigen::Vector3d p(rows[b][0], rows[b][1], rows[b][2]);
      if (p.allFinite()) c.body[b].*member = p;
    }
  };
  points("rotation_center", &BodyData::reference_point);
  points("center_of_mass", &BodyData::centre_of_gravity);
  points("center_of_buoyancy", &BodyData::centre_of_buoyancy);
  const auto volumes = per_body(c, in, "disp_volume", 1), masses = per_body(c, in, "disp_mass", 1);
  for (std::size_t b = 0; b < c.body.size(); ++b) {
    if (!volumes.empty() && std::isfinite(volumes[b][0])) c.body[b].displaced_volume = volumes[b][0];
    if (!c.body[b].displaced_volume && !masses.empty() && std::isfinite(masses[b][0]))
      c.body[b].displaced_volume = masses[b][0] / c.water.density;
    if (!c.body[b].reference_point)
      c.notes.push_back(fmt::format("the file does not say about which point body \"{}\" rotates", c.body[b].name));
  }
}

Coefficients read_capytaine(const fs::path& path) {
  CapytaineFile in(path);
  for (const char* needed :
       {"added_mass", "radiation_damping", "influenced_dof", "radiating_dof", "rho", "g", "water_depth"})
    if (!in.file.has(needed))
      in.refuse(fmt::format("the netCDF file has no variable \"{}\"", needed), "give a dataset written by Capytaine");
  if (in.file.has("forward_speed") && in.file.scalar("forward_speed") != 0)
    in.refuse(fmt::format("the data are for a forward speed of {} m/s", in.file.scalar("forward_speed")),
              "Froude's bodies keep their place: compute with forward speed zero");
  in.water = read_water(in);
  read_frequencies(in);
  read_dofs(in);

  Coefficients c;
  c.water = in.water;
  const std::string version = in.file.text_attribute("capytaine_version");
  c.source = fmt::format("Capytaine{} netCDF {}", version.empty() ? "" : " " + version, path.string());
  fill_bodies(c, in);
  fill_radiation(c, in);
  fill_excitation(c, in);
  fill_restoring(c, in);
  return c;
}

}  // namespace

const Format capytaine_files{[](const Candidate& c) {
                               return c.is_classic_netcdf ||
                                      (c.hdf5 && c.hdf5->has("/added_mass") && c.hdf5->has("/radiating_dof"));
                             },
                             [](const fs::path& path, const ReadOptions&) { return read_capytaine(path); }};

}  // namespace hydro::potential
