// Coefficients of potential theory, as numpy arrays.
#include <pybind11/eigen.h>

#include <array>
#include <cmath>

#include "bindings.hpp"
#include "hydro/base/error.hpp"
#include "hydro/potential/coefficients.hpp"

namespace froude::python {
namespace {

namespace hp = hydro::potential;
using hp::Coefficients;

constexpr std::array<const char*, 6> motions{"surge", "sway", "heave", "roll", "pitch", "yaw"};

std::vector<std::string> modes_of(const Coefficients& c) {
  std::vector<std::string> out;
  for (const hp::BodyData& body : c.body)
    for (const char* motion : motions) out.push_back(body.name + "." + motion);
  return out;
}

/// Matrices of one size one after the other, rows before columns: shape (list, rows, columns).
template <class Matrix>
py::array stacked(const std::vector<Matrix>& all, Eigen::Index rows, Eigen::Index columns) {
  using Number = typename Matrix::Scalar;
  py::array_t<Number> out(std::vector<py::ssize_t>{static_cast<py::ssize_t>(all.size()), rows, columns});
  auto to = out.template mutable_unchecked<3>();
  for (std::size_t i = 0; i < all.size(); ++i)
    for (Eigen::Index r = 0; r < rows; ++r)
      for (Eigen::Index k = 0; k < columns; ++k) to(static_cast<py::ssize_t>(i), r, k) = all[i](r, k);
  return out;
}

/// X as the file has it for each heading is (mode, omega); frequencies go before modes, as those of A and B do.
py::array excitation_of(const Coefficients& c) {
  std::vector<Eigen::MatrixXcd> turned;
  for (const Eigen::MatrixXcd& one : c.X) turned.emplace_back(one.transpose());
  return stacked(turned, static_cast<Eigen::Index>(c.omega.size()), c.modes());
}

hydro::WaterDepth depth_from(double metres) {
  return std::isinf(metres) ? hydro::WaterDepth::infinite() : hydro::WaterDepth::from_metres(metres);
}

}  // namespace

void add_coefficients(py::module_& m) {
  py::class_<Coefficients> type(
      m, "Coefficients",
      "Added mass, damping, excitation and restoring of N bodies, whatever code computed them.\n\n"
      "SI; x forward, y port, z up, origin in the still waterplane; motion, load and wave are Re(amplitude "
      "e^{+i omega t}). Loads and motions are in the order of `modes`, moments and rotations about the reference "
      "points of the bodies. Made by `froude.coefficients`.");
  type.def_property_readonly("modes", &modes_of, "\"body1.surge\", ...: 6N names.")
      .def_property_readonly("omega", view_of(&Coefficients::omega), "rad/s, shape (omega,), rising.")
      .def_property_readonly("heading", view_of(&Coefficients::heading),
                             "Where the waves go, rad, from +x towards +y, shape (heading,), rising; empty without "
                             "excitation.")
      .def_property_readonly(
          "added_mass", [](const Coefficients& c) { return stacked(c.A, c.modes(), c.modes()); },
          "A, kg, kg m, kg m^2, shape (omega, 6N, 6N): load on the second index, motion of the third.")
      .def_property_readonly(
          "damping", [](const Coefficients& c) { return stacked(c.B, c.modes(), c.modes()); },
          "B of radiated waves, kg/s, kg m/s, kg m^2/s, shape (omega, 6N, 6N); indices as of `added_mass`.")
      .def_property_readonly("excitation", &excitation_of,
                             "X per metre of wave amplitude, complex, N/m and N, shape (heading, omega, 6N); its phase "
                             "is against the crest at the global origin.")
      .def_readonly("restoring", &Coefficients::C,
                    "C of buoyancy and weight, N/m, N, N m, shape (6N, 6N); None where the file has none.")
      .def_readonly("added_mass_zero", &Coefficients::A_zero, "A at omega = 0, shape (6N, 6N); None where unknown.")
      .def_readonly("added_mass_infinite", &Coefficients::A_inf,
                    "A at omega = infinity, shape (6N, 6N); None where unknown.")
      .def_property_readonly(
          "bodies",
          [](const Coefficients& c) {
            py::list out;
            for (const hp::BodyData& b : c.body) {
              py::dict one;
              one["name"] = b.name;
              one["reference_point"] = b.reference_point;
              one["centre_of_gravity"] = b.centre_of_gravity;
              one["centre_of_buoyancy"] = b.centre_of_buoyancy;
              one["displaced_volume"] = b.displaced_volume;
              out.append(one);
            }
            return out;
          },
          "A dict each: name; reference_point, centre_of_gravity, centre_of_buoyancy, m, global; displaced_volume, "
          "m^3. What the file does not say is None.")
      .def_property_readonly(
          "density", [](const Coefficients& c) { return c.water.density; }, "Of the water, kg/m^3.")
      .def_property_readonly(
          "gravity", [](const Coefficients& c) { return c.water.gravity; }, "m/s^2")
      .def_property_readonly(
          "depth", [](const Coefficients& c) { return c.water.depth.metres(); }, "Of the water, m; may be infinite.")
      .def_readonly("source", &Coefficients::source, "Format and files, for people.")
      .def_readonly("notes", &Coefficients::notes, "What the reader had to decide; a sentence each.");
  add_dataset(type, "of_coefficients",
              "xarray.Dataset with the dimensions of Capytaine: omega, wave_direction, radiating_dof, influenced_dof.");
  m.def(
      "coefficients",
      [](const std::filesystem::path& file, std::optional<double> density, std::optional<double> gravity,
         std::optional<double> depth, std::optional<double> ulen, std::optional<int> iperout) {
        const py::gil_scoped_release others_may_work;
        hp::ReadOptions options{.density = density, .gravity = gravity, .ulen = ulen, .iperout = iperout};
        if (depth) options.depth = depth_from(*depth);
        return hp::read(file, options);
      },
      py::arg("file"), py::arg("density"), py::arg("gravity"), py::arg("depth"), py::arg("ulen"), py::arg("iperout"),
      "froude.coefficients");
}

}  // namespace froude::python
