#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/io/hdf5.hpp"
#include "potential/readers.hpp"

namespace hydro::potential {
namespace {

/// A dataset of exactly this shape.
std::vector<double> table(const io::Hdf5Reader& file, const std::filesystem::path& path, const std::string& name,
                          const std::vector<std::size_t>& shape) {
  io::Array a = file.numbers(name);
  if (a.shape != shape)
    throw InputError(
        fmt::format("{} has shape ({}); ({}) is needed", name, fmt::join(a.shape, ", "), fmt::join(shape, ", ")),
        {.file = path.string()}, "convert the original data again");
  return std::move(a.values);
}

Eigen::MatrixXd matrix_at(const std::vector<double>& values, std::size_t index, Eigen::Index rows,
                          Eigen::Index columns) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(values.data() + index * static_cast<std::size_t>(rows * columns), rows, columns);
}

std::vector<BodyData> read_bodies(const io::Hdf5Reader& file, const std::filesystem::path& path) {
  std::vector<BodyData> body;
  for (const std::string& name : file.texts("/body_name")) {
    body.emplace_back();
    body.back().name = name;
  }
  const std::size_t n = body.size();
  const auto volume = table(file, path, "/displaced_volume", {n});
  for (std::size_t b = 0; b < n; ++b)
    if (!std::isnan(volume[b])) body[b].displaced_volume = volume[b];
  const auto points = [&](const char* name, std::optional<Eigen::Vector3d> BodyData::*member) {
    const auto values = table(file, path, name, {n, 3});
    for (std::size_t b = 0; b < n; ++b)
      if (const Eigen::Vector3d p(values.data() + 3 * b); !p.hasNaN()) body[b].*member = p;
  };
  points("/reference_point", &BodyData::reference_point);
  points("/centre_of_gravity", &BodyData::centre_of_gravity);
  points("/centre_of_buoyancy", &BodyData::centre_of_buoyancy);
  return body;
}

void read_matrices(Coefficients& c, const io::Hdf5Reader& file, const std::filesystem::path& path) {
  const Eigen::Index n = c.modes();
  const std::size_t modes = static_cast<std::size_t>(n), frequencies = c.omega.size();
  const auto A = table(file, path, "/added_mass", {frequencies, modes, modes});
  const auto B = table(file, path, "/radiation_damping", {frequencies, modes, modes});
  for (std::size_t k = 0; k < frequencies; ++k) {
    c.A.push_back(matrix_at(A, k, n, n));
    c.B.push_back(matrix_at(B, k, n, n));
  }
  const auto optional_matrix = [&](const char* name, std::optional<Eigen::MatrixXd>& m) {
    if (file.has(name)) m = matrix_at(table(file, path, name, {modes, modes}), 0, n, n);
  };
  optional_matrix("/added_mass_zero", c.A_zero);
  optional_matrix("/added_mass_infinite", c.A_inf);
  optional_matrix("/restoring", c.C);
}

void read_excitation(Coefficients& c, const io::Hdf5Reader& file, const std::filesystem::path& path) {
  if (!file.has("/heading")) return;
  c.heading = file.numbers("/heading").values;
  const std::vector<std::size_t> shape{c.heading.size(), static_cast<std::size_t>(c.modes()), c.omega.size()};
  const auto re = table(file, path, "/excitation_re", shape), im = table(file, path, "/excitation_im", shape);
  const Eigen::Index n = c.modes(), frequencies = static_cast<Eigen::Index>(c.omega.size());
  for (std::size_t b = 0; b < c.heading.size(); ++b) {
    Eigen::MatrixXcd X(n, frequencies);
    X.real() = matrix_at(re, b, n, frequencies);
    X.imag() = matrix_at(im, b, n, frequencies);
    c.X.push_back(X);
  }
}

Coefficients read_froude(const std::filesystem::path& path) {
  const io::Hdf5Reader file(path);
  constexpr double known = 1;
  if (const double version = file.number_attribute("/", "format_version"); version != known)
    throw InputError(fmt::format("format_version is {}; this Froude reads {}", version, known), {.file = path.string()},
                     "use a newer Froude");
  Coefficients c;
  c.source = file.text("/source");
  const double depth = file.scalar("/water_depth");
  c.water = {file.scalar("/density"), file.scalar("/gravity"),
             std::isinf(depth) ? WaterDepth::infinite() : WaterDepth::from_metres(depth)};
  c.body = read_bodies(file, path);
  c.omega = file.numbers("/omega").values;
  read_matrices(c, file, path);
  read_excitation(c, file, path);
  if (file.has("/note_text")) c.notes = file.texts("/note_text");
  return c;
}

}  // namespace

const Format froude_files{[](const Candidate& c) {
                            return c.hdf5 && c.hdf5->has_attribute("/", "format") &&
                                   c.hdf5->text_attribute("/", "format") == froude_format;
                          },
                          [](const std::filesystem::path& path, const ReadOptions&) { return read_froude(path); }};

}  // namespace hydro::potential
