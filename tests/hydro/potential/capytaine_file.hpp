#pragma once
/// \file  A writer of datasets as Capytaine has them, for tests: either container, any order of axes, any names.
#include <netcdf.h>

#include <limits>
#include <map>
#include <numbers>

#include "smooth_body.hpp"

namespace froude_test {

/// A netCDF file being written. Sizes are small, so nothing is chunked; a failing call ends the test by an exception.
class NetcdfFile {
 public:
  NetcdfFile(const std::filesystem::path& path, int mode) { check(nc_create(path.c_str(), NC_CLOBBER | mode, &file_)); }
  ~NetcdfFile() { nc_close(file_); }
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;

  void numbers(const std::string& name, const std::vector<std::string>& axes, const std::vector<double>& values,
               const std::map<std::string, std::size_t>& length) {
    define();
    std::vector<int> ids;
    for (const auto& axis : axes) ids.push_back(dimension(axis, length.at(axis)));
    int v = 0;
    check(nc_def_var(file_, name.c_str(), NC_DOUBLE, int(ids.size()), ids.data(), &v));
    nc_enddef(file_);
    check(nc_put_var_double(file_, v, values.data()));
  }
  /// Padded characters in classic files and strings in HDF5, as xarray does.
  void texts(const std::string& name, const std::string& axis, const std::vector<std::string>& values, bool classic) {
    define();
    std::size_t width = 1;
    for (const auto& text : values) width = std::max(width, text.size());
    std::vector<int> ids;
    if (!axis.empty()) ids.push_back(dimension(axis, values.size()));
    int v = 0;
    if (classic) {
      ids.push_back(dimension("string" + std::to_string(width), width));
      std::string padded;
      for (std::string text : values) {
        text.resize(width, '\0');
        padded += text;
      }
      check(nc_def_var(file_, name.c_str(), NC_CHAR, int(ids.size()), ids.data(), &v));
      nc_enddef(file_);
      check(nc_put_var_text(file_, v, padded.data()));
    } else {
      std::vector<const char*> raw;
      for (const auto& text : values) raw.push_back(text.c_str());
      check(nc_def_var(file_, name.c_str(), NC_STRING, int(ids.size()), ids.data(), &v));
      check(nc_put_var_string(file_, v, raw.data()));
    }
  }

 private:
  static void check(int status) {
    if (status != NC_NOERR) throw std::runtime_error(nc_strerror(status));
  }
  void define() { nc_redef(file_); }
  int dimension(const std::string& name, std::size_t length) {
    int id = 0;
    if (nc_inq_dimid(file_, name.c_str(), &id) != NC_NOERR) check(nc_def_dim(file_, name.c_str(), length, &id));
    return id;
  }
  int file_ = -1;
};

/// How to write the dataset.
struct CapytaineFile {
  SmoothBody body = {};
  hydro::Water water = {1000, 9.81, hydro::WaterDepth::from_metres(20)};
  bool classic = true;
  bool version2 = true;  ///< radiating before influenced, body_name instead of body
  bool im_first = false;
  bool in_parts = false;          ///< Froude–Krylov and diffraction instead of their sum
  std::string measure = "omega";  ///< name of the frequency axis
  bool says_omega = true;         ///< coordinate omega beside another measure
  std::vector<double> omega = {0, 1.2, 0.3, 0.7, std::numeric_limits<double>::infinity()};
  std::vector<double> heading = {0.5, 0.0};                                           ///< rad
  std::vector<std::string> dof = {"Heave", "Surge", "YAW", "sway", "Pitch", "Roll"};  ///< of one body
  std::vector<std::string> name = {""};                                               ///< before "__"; "" for none
  double forward_speed = 0;
  double unsolved = -1;     ///< frequency at which all of A and B is NaN
  std::string nan_in = {};  ///< variable of which one number at a finite frequency is spoilt

  std::vector<std::string> labels() const {
    std::vector<std::string> out;
    for (const auto& n : name)
      for (const auto& d : dof) out.push_back(n.empty() ? d : n + "__" + d);
    return out;
  }
  /// The mode, from 0 through all bodies, of label k.
  int mode(std::size_t k) const {
    static const std::map<char, int> first_two{{'u', 0}, {'w', 1}, {'e', 2}, {'o', 3}, {'i', 4}, {'a', 5}};
    const std::string& d = dof[k % dof.size()];
    return int(k / dof.size()) * 6 + first_two.at(char(std::tolower(d[1])));  // sUrge sWay hEave rOll pItch yAw
  }
  double measured(double w) const {
    constexpr double two_pi = 2 * std::numbers::pi;
    const double k = w == 0 || std::isinf(w) ? w : wavenumber(w);
    if (measure == "freq") return w / two_pi;
    if (measure == "period") return two_pi / w;
    if (measure == "wavenumber") return k;
    if (measure == "wavelength") return two_pi / k;
    return w;
  }
  double wavenumber(double w) const {
    double low = 0, high = 1e3;
    for (int i = 0; i < 200; ++i) {
      const double nu = (low + high) / 2;
      (water.gravity * nu * std::tanh(nu * water.depth.metres()) < w * w ? low : high) = nu;
    }
    return low;
  }

  void write(const std::filesystem::path& path) const {
    NetcdfFile file(path, classic ? NC_64BIT_OFFSET : NC_NETCDF4);
    const std::vector<std::string> dofs = labels();
    const std::map<std::string, std::size_t> length{
        {measure, omega.size()}, {"influenced_dof", dofs.size()},    {"radiating_dof", dofs.size()},
        {"complex", 2},          {"wave_direction", heading.size()}, {"body", name.size()},
        {"space_coordinate", 3}};
    const auto put = [&](const std::string& v, const std::vector<std::string>& axes, std::vector<double> values) {
      if (v == nan_in) values[values.size() / 2] = std::numeric_limits<double>::quiet_NaN();
      file.numbers(v, axes, values, length);
    };
    std::vector<double> coordinate, A, B;
    for (const double w : omega) coordinate.push_back(measured(w));
    put(measure, {measure}, coordinate);
    if (measure != "omega" && says_omega) put("omega", {measure}, omega);
    file.texts("influenced_dof", "influenced_dof", dofs, classic);
    file.texts("radiating_dof", "radiating_dof", dofs, classic);
    file.texts("complex", "complex",
               im_first ? std::vector<std::string>{"im", "re"} : std::vector<std::string>{"re", "im"}, classic);
    for (const double w : omega)
      for (std::size_t a = 0; a < dofs.size(); ++a)
        for (std::size_t b = 0; b < dofs.size(); ++b) {
          const int i = mode(version2 ? b : a), j = mode(version2 ? a : b);
          const bool failed = w == unsolved;
          A.push_back(failed          ? std::numeric_limits<double>::quiet_NaN()
                      : w == 0        ? body.A_zero(i, j)
                      : std::isinf(w) ? body.A_inf(i, j)
                                      : body.A(i, j, w));
          B.push_back(failed                    ? std::numeric_limits<double>::quiet_NaN()
                      : w == 0 || std::isinf(w) ? 0.0
                                                : body.B(i, j, w));
        }
    const std::vector<std::string> matrix = version2
                                                ? std::vector<std::string>{measure, "radiating_dof", "influenced_dof"}
                                                : std::vector<std::string>{measure, "influenced_dof", "radiating_dof"};
    put("added_mass", matrix, A);
    put("radiation_damping", matrix, B);
    write_forces(put, dofs.size());
    std::vector<double> C;
    for (std::size_t a = 0; a < dofs.size(); ++a)
      for (std::size_t b = 0; b < dofs.size(); ++b) C.push_back(body.C(mode(a), mode(b)));
    put("hydrostatic_stiffness", {"influenced_dof", "radiating_dof"}, C);
    put("wave_direction", {"wave_direction"}, heading);
    put("rho", {}, {water.density});
    put("g", {}, {water.gravity});
    put("water_depth", {}, {water.depth.metres()});
    put("forward_speed", {}, {forward_speed});
    write_bodies(file, put);
  }

 private:
  template <class Put>
  void write_forces(const Put& put, std::size_t dofs) const {
    std::vector<double> whole, part, rest;
    for (const bool imaginary : {im_first, !im_first})
      for (const double w : omega)
        for (const double beta : heading)
          for (std::size_t k = 0; k < dofs; ++k) {
            const auto X = std::conj(body.X(mode(k), w, beta));  // e^{−iωt}
            const bool limit = w == 0 || std::isinf(w);
            const double value = limit ? std::numeric_limits<double>::quiet_NaN() : imaginary ? X.imag() : X.real();
            whole.push_back(value);
            part.push_back(0.25 * value + 1000);
            rest.push_back(0.75 * value - 1000);
          }
    const std::vector<std::string> axes{"complex", measure, "wave_direction", "influenced_dof"};
    if (in_parts) {
      put("Froude_Krylov_force", axes, part);
      put("diffraction_force", axes, rest);
    } else {
      put("excitation_force", axes, whole);
    }
  }
  template <class Put>
  void write_bodies(NetcdfFile& file, const Put& put) const {
    if (version2) {
      file.texts("body_name", "", {"old buoy"}, classic);
      return;
    }
    // The table of bodies need not have the order of the modes: here it is the other way round.
    std::vector<std::string> reversed(name.rbegin(), name.rend());
    if (name.size() == 1) reversed = {"new buoy"};
    file.texts("body", name.size() == 1 ? "" : "body", reversed, classic);
    std::vector<double> centre, mass;
    for (std::size_t b = name.size(); b-- > 0;) {
      for (const double v : {10.0 * double(b + 1), 0.5, -0.25}) centre.push_back(v);
      mass.push_back(5000.0 * double(b + 1));
    }
    const bool one = name.size() == 1;
    const auto axes =
        one ? std::vector<std::string>{"space_coordinate"} : std::vector<std::string>{"body", "space_coordinate"};
    put("rotation_center", axes, centre);
    put("center_of_mass", axes, centre);
    put("disp_mass", one ? std::vector<std::string>{} : std::vector<std::string>{"body"}, mass);
  }

 public:
  hydro::potential::Coefficients expected() const {
    std::vector<double> w, beta = heading;
    for (const double v : omega)
      if (v > 0 && !std::isinf(v) && v != unsolved) w.push_back(v);
    std::sort(w.begin(), w.end());
    std::sort(beta.begin(), beta.end());
    return body.coefficients(water, w, beta);
  }
};

}  // namespace froude_test
