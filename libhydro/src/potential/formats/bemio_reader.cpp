#include <algorithm>
#include <charconv>
#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/io/hdf5.hpp"
#include "potential/readers.hpp"

namespace hydro::potential {
namespace {

namespace fs = std::filesystem;

/// The file and its axes.
struct BemioFile {
  explicit BemioFile(const fs::path& p) : path(p), file(p) {}
  [[noreturn]] void refuse(const std::string& object, const std::string& why, const std::string& remedy = {}) const {
    throw InputError(fmt::format("{} {}", object, why), {.file = path.string()}, remedy);
  }

  fs::path path;
  io::Hdf5Reader file;
  int bodies = 0;
  std::vector<double> omega, heading;  ///< in the order of the file; rad/s, rad
  FrequencyOrder order;
  std::vector<std::size_t> heading_order;
};

std::string body_group(int body) { return fmt::format("/body{}", body); }

int count_bodies(const BemioFile& in) {
  int highest = 0, found = 0;
  for (const std::string& name : in.file.children("/")) {
    int number = 0;
    const auto [end, error] =
        std::from_chars(name.data() + std::min<std::size_t>(4, name.size()), name.data() + name.size(), number);
    if (name.rfind("body", 0) != 0 || error != std::errc() || end != name.data() + name.size()) continue;
    highest = std::max(highest, number);
    ++found;
  }
  if (found == 0) in.refuse("the file", "has no group body1");
  if (found != highest) in.refuse("the file", fmt::format("has {} bodies, but the last is body{}", found, highest));
  return found;
}

Water read_water(const BemioFile& in) {
  const std::string group = "/simulation_parameters/", depth = group + "water_depth";
  if (in.file.has(group + "scaled") && in.file.scalar(group + "scaled") != 0)
    in.refuse(group + "scaled", "is not zero: the data are not in BEMIO's normal form",
              "write the file again with scaling switched off");
  Water water{in.file.scalar(group + "rho"), in.file.scalar(group + "g"), WaterDepth::infinite()};
  if (in.file.is_text(depth)) {
    if (in.file.text(depth) != "infinite")
      in.refuse(depth, fmt::format("is \"{}\"; a number or \"infinite\" is needed", in.file.text(depth)));
  } else if (const double h = in.file.scalar(depth); !std::isinf(h) || h < 0) {
    water.depth = WaterDepth::from_metres(h);
  }
  return water;
}

void read_axes(BemioFile& in) {
  in.omega = in.file.numbers("/simulation_parameters/w").values;
  in.order = order_frequencies(in.omega, in.path);
  if (in.file.has("/simulation_parameters/wave_dir"))
    for (const double degrees : in.file.numbers("/simulation_parameters/wave_dir").values)
      in.heading.push_back(Angle::from_degrees(degrees).radians());
  in.heading_order = order_headings(in.heading, in.path);
}

/// Numbers of a known number, whatever their exact shape (a single heading may be dropped).
std::vector<double> numbers_of(const BemioFile& in, const std::string& dataset, std::size_t count,
                               const std::string& shape) {
  auto values = in.file.numbers(dataset).values;
  if (values.size() != count)
    in.refuse(dataset, fmt::format("holds {} numbers; {} = {} are needed", values.size(), shape, count));
  return values;
}

/// Dataset `all` of shape (rows, columns, Nω), or, in files without it, `components`/i_j with rows (period, value).
std::vector<double> table_of(const BemioFile& in, const std::string& all, const std::string& components,
                             std::size_t rows, std::size_t columns) {
  const std::size_t n = in.omega.size();
  if (in.file.has(all)) return numbers_of(in, all, rows * columns * n, fmt::format("({}, {}, {})", rows, columns, n));
  std::vector<double> out;
  for (std::size_t i = 1; i <= rows; ++i)
    for (std::size_t j = 1; j <= columns; ++j) {
      const std::string name = fmt::format("{}/{}_{}", components, i, j);
      if (!in.file.has(name)) in.refuse(all, fmt::format("is missing, and so is {}", name));
      const auto pairs = numbers_of(in, name, 2 * n, fmt::format("({}, 2)", n));
      for (std::size_t k = 0; k < n; ++k) out.push_back(pairs[2 * k + 1]);
    }
  return out;
}

void require_rigid(const BemioFile& in, int body) {
  const std::string dof = body_group(body) + "/properties/dof";
  if (in.file.has(dof) && in.file.scalar(dof) != 6)
    in.refuse(dof, fmt::format("is {}: body {} has generalised modes", in.file.scalar(dof), body),
              "Froude reads rigid bodies only: compute with six modes for each body");
}

/// Rows of body b in A = ρ Ã and B = ρ ω B̃  (P10).
void fill_radiation(Coefficients& c, const BemioFile& in, int b) {
  const std::size_t columns = static_cast<std::size_t>(c.modes()), n = in.omega.size();
  const std::string group = body_group(b + 1) + "/hydro_coeffs/";
  const auto A = table_of(in, group + "added_mass/all", group + "added_mass/components", 6, columns);
  const auto B = table_of(in, group + "radiation_damping/all", group + "radiation_damping/components", 6, columns);
  const double rho = c.water.density;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < columns; ++j) {
      const Eigen::Index row = 6 * b + static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
      const auto value = [&](const std::vector<double>& table, std::size_t k, const char* what) {
        const double v = table[(i * columns + j) * n + k];
        require_finite(
            v, in.path,
            fmt::format("{} ({}, {}) of body {} at w = {:.6g} rad/s", what, i + 1, j + 1, b + 1, in.omega[k]));
        return v;
      };
      for (std::size_t f = 0; f < in.order.finite.size(); ++f) {
        const std::size_t k = in.order.finite[f];
        c.A[f](row, column) = rho * value(A, k, "added mass");
        c.B[f](row, column) = rho * in.omega[k] * value(B, k, "radiation damping");
      }
      if (in.order.zero) (*c.A_zero)(row, column) = rho * value(A, *in.order.zero, "added mass");
      if (in.order.infinite) (*c.A_inf)(row, column) = rho * value(A, *in.order.infinite, "added mass");
    }
}

/// Real and imaginary part (6, Nβ, Nω), or modulus and phase where those are missing.
std::vector<std::complex<double>> excitation_of(const BemioFile& in, const std::string& group) {
  const auto part = [&](const char* name) {
    return table_of(in, group + name, group + "components/" + name, 6, in.heading.size());
  };
  std::vector<std::complex<double>> out;
  if (in.file.has(group + "re") || in.file.has(group + "components/re") || !in.file.has(group + "mag")) {
    const auto re = part("re"), im = part("im");
    for (std::size_t k = 0; k < re.size(); ++k) out.emplace_back(re[k], im[k]);
  } else {
    const auto mag = part("mag"), phase = part("phase");
    for (std::size_t k = 0; k < mag.size(); ++k) out.push_back(mag[k] * std::polar(1.0, phase[k]));
  }
  return out;
}

/// Rows of body b in X = ρ g X̃  (P10).
void fill_excitation(Coefficients& c, const BemioFile& in, int b) {
  const auto X = excitation_of(in, body_group(b + 1) + "/hydro_coeffs/excitation/");
  const double rho_g = c.water.density * c.water.gravity;
  const std::size_t headings = in.heading.size(), n = in.omega.size();
  for (std::size_t h = 0; h < headings; ++h)
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t f = 0; f < in.order.finite.size(); ++f) {
        const std::size_t k = in.order.finite[f];
        const auto value = X[(i * headings + in.heading_order[h]) * n + k];
        require_finite(std::abs(value), in.path,
                       fmt::format("excitation {} of body {} at w = {:.6g} rad/s", i + 1, b + 1, in.omega[k]));
        c.X[h](6 * b + static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(f)) = rho_g * value;
      }
}

/// Rows of body b of a (6, columns) dataset into `to`, multiplied by `factor`.
void fill_block(Eigen::MatrixXd& to, const BemioFile& in, const std::string& dataset, int b, Eigen::Index first_column,
                Eigen::Index columns, double factor) {
  const auto values = numbers_of(in, dataset, 6 * static_cast<std::size_t>(columns), fmt::format("(6, {})", columns));
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = 0; j < columns; ++j) {
      const double v = values[static_cast<std::size_t>(i * columns + j)];
      require_finite(v, in.path, fmt::format("{} ({}, {})", dataset, i + 1, j + 1));
      to(6 * b + i, first_column + j) = factor * v;
    }
}

std::optional<Eigen::Vector3d> point_of(const BemioFile& in, const std::string& dataset) {
  if (!in.file.has(dataset)) return std::nullopt;
  const auto v = numbers_of(in, dataset, 3, "3");
  const Eigen::Vector3d p(v[0], v[1], v[2]);
  return p.allFinite() ? std::optional(p) : std::nullopt;  // NaN is how "unknown" is written
}

BodyData read_body(const BemioFile& in, int b) {
  require_rigid(in, b + 1);
  const std::string group = body_group(b + 1) + "/properties/";
  BodyData body;
  body.name = in.file.has(group + "name") ? in.file.text(group + "name") : fmt::format("body{}", b + 1);
  body.centre_of_gravity = point_of(in, group + "cg");
  body.centre_of_buoyancy = point_of(in, group + "cb");
  body.reference_point = body.centre_of_gravity;
  if (in.file.has(group + "disp_vol"))
    if (const double volume = in.file.scalar(group + "disp_vol"); std::isfinite(volume)) body.displaced_volume = volume;
  return body;
}

bool every_body_has(const BemioFile& in, const std::string& dataset) {
  for (int b = 1; b <= in.bodies; ++b)
    if (!in.file.has(body_group(b) + dataset)) return false;
  return true;
}

void allocate(Coefficients& c, const BemioFile& in) {
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(c.modes(), c.modes());
  c.omega = picked(in.omega, in.order.finite);
  c.A.assign(c.omega.size(), none);
  c.B.assign(c.omega.size(), none);
  if (in.order.zero) c.A_zero = none;
  if (in.order.infinite || every_body_has(in, "/hydro_coeffs/added_mass/inf_freq")) c.A_inf = none;
  if (every_body_has(in, "/hydro_coeffs/linear_restoring_stiffness")) c.C = none;
  if (every_body_has(in, "/hydro_coeffs/excitation") && !in.heading.empty()) {
    c.heading = picked(in.heading, in.heading_order);
    c.X.assign(c.heading.size(), Eigen::MatrixXcd::Zero(c.modes(), static_cast<Eigen::Index>(c.omega.size())));
  }
}

void note_what_is_absent(Coefficients& c) {
  if (!c.A_inf) c.notes.push_back("no added mass at infinite frequency: the file has no inf_freq for every body");
  if (!c.C) c.notes.push_back("no restoring matrix: the file has no linear_restoring_stiffness for every body");
  if (c.X.empty()) c.notes.push_back("no excitation: the file has no excitation group for every body");
  c.notes.push_back(
      "the reference point of each body is its centre of gravity, as WEC-Sim takes it; the file states none");
}

Coefficients read_bemio(const fs::path& path) {
  BemioFile in(path);
  in.bodies = count_bodies(in);
  Coefficients c;
  c.water = read_water(in);
  read_axes(in);
  for (int b = 0; b < in.bodies; ++b) c.body.push_back(read_body(in, b));
  const std::string code = in.file.has("/bem_data/code") ? in.file.text("/bem_data/code") : "";
  c.source = fmt::format("BEMIO HDF5 {}{}", path.string(), code.empty() ? "" : " (computed by " + code + ")");
  allocate(c, in);
  for (int b = 0; b < in.bodies; ++b) {
    fill_radiation(c, in, b);
    if (!c.X.empty()) fill_excitation(c, in, b);
    const std::string group = body_group(b + 1) + "/hydro_coeffs/";
    if (c.A_inf && !in.order.infinite)
      fill_block(*c.A_inf, in, group + "added_mass/inf_freq", b, 0, c.modes(), c.water.density);
    if (c.C) fill_block(*c.C, in, group + "linear_restoring_stiffness", b, 6 * b, 6, c.water.density * c.water.gravity);
  }
  note_what_is_absent(c);
  return c;
}

}  // namespace

const Format bemio_files{[](const Candidate& c) {
                           return c.hdf5 && c.hdf5->has("/simulation_parameters") &&
                                  (c.hdf5->has("/bem_data") || c.hdf5->has("/body1/hydro_coeffs"));
                         },
                         [](const fs::path& path, const ReadOptions&) { return read_bemio(path); }};

}  // namespace hydro::potential
