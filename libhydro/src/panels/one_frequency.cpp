#include "one_frequency.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hydro/waves/dispersion.hpp"
#include "parts.hpp"

namespace hydro::panels {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr Complex i_unit(0, 1);

/// The greatest distance along the water between panels, with room for their corners.
double reach_of(const AllPanels& all, const PanelMesh& mesh) {
  double size = 0;
  for (const Panel& p : mesh.hull) size = std::max(size, p.shape.size);
  for (const Panel& p : mesh.lid) size = std::max(size, p.shape.size);
  const Eigen::RowVector2d low = all.point.leftCols<2>().colwise().minCoeff(),
                           high = all.point.leftCols<2>().colwise().maxCoeff();
  return (high - low).norm() + 4 * size;
}

}  // namespace

Model::Model(PanelMesh mesh, const std::vector<HullBody>& bodies, const Water& water)
    : mesh_(std::move(mesh)),
      water_(water),
      all_(all_panels(mesh_, bodies)),
      load_rows_(load_rows_of_parts(mesh_, bodies)),
      parts_(rankine_parts(mesh_, all_, water.depth)) {
  reach_ = reach_of(all_, mesh_);
  for (const HullBody& body : bodies) reference_point_.push_back(body.reference_point);
}

/// cosh k(z+h)/cosh kh.
double Model::profile(double k, double z) const {
  if (water_.depth.is_infinite()) return std::exp(k * z);
  const double h = water_.depth.metres();
  return std::exp(k * z) * (1 + std::exp(-2 * k * (z + h))) / (1 + std::exp(-2 * k * h));
}

MatrixXd Model::points(double K) const {
  const bool lid = std::isfinite(K);
  MatrixXd out(all_.point.rows() + (lid ? mesh_.lid_panels() : 0), 3);
  out.topRows(all_.point.rows()) = all_.point;
  Index row = all_.point.rows();
  for (const Image& image : mesh_.images)
    for (std::size_t j = 0; lid && j < mesh_.lid.size(); ++j) out.row(row++) = image * mesh_.lid[j].shape.centre;
  return out;
}

Complex Model::incident(double omega, double k, double heading, const Vector3d& at) const {
  const double along = at.x() * std::cos(heading) + at.y() * std::sin(heading);
  return i_unit * (water_.gravity / omega * profile(k, at.z())) * std::polar(1.0, -k * along);
}

MatrixXcd Model::incident(double omega, double k, const std::vector<double>& heading) const {
  const MatrixXd point = points(0);
  MatrixXcd out(point.rows(), static_cast<Index>(heading.size()));
  for (Index b = 0; b < out.cols(); ++b)
    for (Index i = 0; i < out.rows(); ++i)
      out(i, b) = incident(omega, k, heading[static_cast<std::size_t>(b)], point.row(i).transpose());
  return out;
}

MatrixXcd Model::loads(const MatrixXcd& potential) const {
  return (all_.area.asDiagonal() * all_.normal).transpose().cast<Complex>() * potential;
}

/// iωρ ∬ (φ_I v_n − φ ∂φ_I/∂n) dS of each potential φ with its velocity v_n along the normals, one row each.
MatrixXcd Model::haskind(double omega, double k, const MatrixXcd& potential, const MatrixXd& velocity,
                         const std::vector<double>& heading) const {
  const MatrixXcd wave = incident(omega, k, heading).topRows(all_.point.rows());
  MatrixXcd out = (all_.area.asDiagonal() * velocity).transpose().cast<Complex>() * wave;
  for (Index b = 0; b < wave.cols(); ++b) {
    const double c = std::cos(heading[static_cast<std::size_t>(b)]), s = std::sin(heading[static_cast<std::size_t>(b)]);
    for (Index i = 0; i < wave.rows(); ++i) {
      const double z = all_.point(i, 2), K = omega * omega / water_.gravity;
      const double rise = water_.depth.is_infinite() ? K : k * std::tanh(k * (z + water_.depth.metres()));
      const Complex slope = -i_unit * k * (c * all_.n(i, 0) + s * all_.n(i, 1)) + rise * all_.n(i, 2);
      out.col(b) -= (all_.area(i) * slope * wave(i, b)) * potential.row(i).transpose();
    }
  }
  return i_unit * omega * water_.density * out;
}

MatrixXd Model::damping_far(double omega, double k, const MatrixXcd& motion) const {
  const int count = 32 + 2 * static_cast<int>(k * reach_);  // of a periodic function: exact once it holds its harmonics
  std::vector<double> around;
  for (int i = 0; i < count; ++i) around.push_back(2 * pi * i / count);
  const MatrixXcd X = haskind(omega, k, motion, all_.normal, around);
  const double speed = waves::group_velocity(omega, water_);
  return (k / (8 * pi * water_.density * water_.gravity * speed) * 2 * pi / count) * (X * X.adjoint()).real();
}

// What goes to θ is what a wave that comes from there meets (Haskind); that bodies are held still leaves their total
// potential without velocity, as field_of() has it.
potential::FarField Model::far_field(const Potentials& phi, double omega, double heading,
                                     const Eigen::VectorXcd& velocity) const {
  const double k = waves::wavenumber(omega, water_), speed = waves::group_velocity(omega, water_);
  potential::FarField out;
  out.angle = potential::angles_around(heading, k, all_.point.leftCols<2>().rowwise().norm().maxCoeff(), 6);
  std::vector<double> against;
  for (const double angle : out.angle) against.push_back(angle + pi);
  const double factor = -k / (4 * water_.density * water_.gravity * speed);
  const MatrixXd held = MatrixXd::Zero(phi.wave.rows(), 1);
  out.scattered = factor * haskind(omega, k, phi.wave, held, against).transpose();
  out.radiated = factor * haskind(omega, k, phi.motion, all_.normal, against).transpose() * velocity;
  return out;
}

// As K → ∞ there are no waves, and so no irregular frequencies for a lid to take away.
Potentials Model::potentials(double K, const MatrixXcd& incident) const {
  const WaveGreen green(K, water_.depth, reach_);
  if (std::isfinite(K) && K > 0) return solve_system(mesh_, all_, parts_, green, incident);
  PanelMesh open{.hull = mesh_.hull, .lid = {}, .images = mesh_.images, .body_of = mesh_.body_of};
  const auto hull = static_cast<Index>(mesh_.hull.size());
  RankineParts parts;
  for (const RankineParts::OfClass& p : parts_.of_class)
    parts.of_class.push_back({p.dipole.topRows(hull), p.image_dipole.topRows(hull), p.source.topRows(hull),
                              p.image_source.topRows(hull), MatrixXd(hull, 0)});
  return solve_system(open, all_, parts, green, incident);
}

Potentials Model::in_wave(double omega, double heading) const {
  return potentials(omega * omega / water_.gravity, incident(omega, waves::wavenumber(omega, water_), {heading}));
}

OneFrequency Model::at(double omega, const std::vector<double>& heading) const {
  const double K = omega * omega / water_.gravity, k = waves::wavenumber(omega, water_);
  const Potentials phi = potentials(K, incident(omega, k, heading));
  const MatrixXcd L = loads(phi.motion);
  OneFrequency out;
  out.A = -water_.density * L.real();
  out.B = omega * water_.density * L.imag();
  out.X = i_unit * omega * water_.density * loads(phi.wave);
  out.X_far = haskind(omega, k, phi.motion, all_.normal, heading);
  out.B_far = damping_far(omega, k, phi.motion);
  if (load_rows_.rows() == 0) return out;
  const MatrixXcd on_parts = load_rows_.cast<Complex>() * phi.motion;
  out.A_parts = -water_.density * on_parts.real();
  out.B_parts = omega * water_.density * on_parts.imag();
  out.X_parts = i_unit * omega * water_.density * (load_rows_.cast<Complex>() * phi.wave);
  return out;
}

MatrixXd Model::added_mass_limit(double K) const {
  const MatrixXcd none(all_.point.rows(), 0);
  return -water_.density * loads(potentials(K, none).motion).real();
}

}  // namespace hydro::panels
