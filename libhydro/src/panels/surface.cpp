#include "surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "drift.hpp"
#include "hydro/base/parallel.hpp"
#include "hydro/waves/dispersion.hpp"
#include "pressure.hpp"

namespace hydro::panels {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::Vector3d;
using std::numbers::pi;

/// Half of what a hull adds is in it at its side, so that Green's theorem tells neither side there.
bool is_on(const std::vector<std::array<Eigen::Vector2d, 2>>& waterline, const Eigen::Vector2d& p) {
  constexpr double rounding = 1e-6;  // of a piece of the waterline
  return std::any_of(waterline.begin(), waterline.end(), [&](const auto& piece) {
    const Eigen::Vector2d way = piece[1] - piece[0];
    const double along = std::clamp((p - piece[0]).dot(way) / way.squaredNorm(), 0.0, 1.0);
    return (p - piece[0] - along * way).norm() <= rounding * way.norm();
  });
}

}  // namespace

std::vector<bool> outside(const PanelMesh& mesh, const Eigen::MatrixX2d& point) {
  std::vector<std::array<Eigen::Vector2d, 2>> waterline;
  for (const Image& image : mesh.images)
    for (const Panel& panel : mesh.hull)
      for (std::size_t i = 0; i < panel.shape.corners.size(); ++i) {
        const Vector3d a = image * panel.shape.corners[i],
                       b = image * panel.shape.corners[(i + 1) % panel.shape.corners.size()];
        if (a.z() == 0 && b.z() == 0) waterline.push_back({a.head<2>(), b.head<2>()});
      }
  std::vector<bool> out;
  for (Index p = 0; p < point.rows(); ++p)
    out.push_back(!is_inside(waterline, point.row(p)) && !is_on(waterline, point.row(p)));
  return out;
}

// Of the waves that a hull held still adds, the whole potential with no velocity serves as well as its own part: the
// incident wave is regular inside the hull, so that its own integral is nothing outside.
potential::WaveField field_of(const Model& model, const Water& water, const potential::FieldQuestion& question,
                              int threads) {
  const double k = waves::wavenumber(question.omega, water), K = question.omega * question.omega / water.gravity;
  const PanelMesh& mesh = model.mesh();
  const Potentials phi = model.in_wave(question.omega, question.heading);
  const Eigen::VectorXcd velocity = Complex(0, question.omega) * question.motion;
  const std::array<OnPanels, 2> scattered_and_radiated{
      OnPanels{phi.wave.col(0), Eigen::VectorXcd::Zero(phi.wave.rows())},
      OnPanels{phi.motion * velocity, model.all().normal * velocity}};
  double reach = 0;
  for (Index p = 0; p < question.point.rows(); ++p)
    reach = std::max(reach,
                     (model.all().point.leftCols<2>().rowwise() - question.point.row(p)).rowwise().norm().maxCoeff());
  const WaveGreen green(K, water.depth, model.reach() + reach);
  const auto points = question.point.rows();
  potential::WaveField out{.incident = potential::incident_elevation(question.point, k, question.heading),
                           .scattered = Eigen::VectorXcd::Zero(points),
                           .radiated = Eigen::VectorXcd::Zero(points),
                           .known = outside(mesh, question.point)};
  out.far = model.far_field(phi, question.omega, question.heading, velocity);
  if (question.pressure) out.on_hulls = pressure_of(model, water, question, phi);
  if (question.drift) out.on_bodies = drift_of(model, water, question, phi, threads);
  const Complex elevation = Complex(0, -question.omega / water.gravity) / (4 * pi);
  in_parallel(out.known.size(), threads, [&](std::size_t i) {
    if (!out.known[i]) return;
    const auto p = static_cast<Index>(i);
    const Vector3d P(question.point(p, 0), question.point(p, 1), 0);
    const auto four_pi_phi = by_greens_theorem(mesh, water.depth, green, scattered_and_radiated, P, P);
    out.scattered(p) = elevation * four_pi_phi[0];
    out.radiated(p) = elevation * four_pi_phi[1];
  });
  return out;
}

}  // namespace hydro::panels
