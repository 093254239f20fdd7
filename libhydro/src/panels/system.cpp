#include "system.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hydro/base/dense.hpp"

namespace hydro::panels {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using std::numbers::pi;

/// The centres at which the equations are written: of the hull's panels, then of the lid's.
std::vector<Vector3d> centres(const PanelMesh& mesh) {
  std::vector<Vector3d> out;
  for (const Panel& p : mesh.hull) out.push_back(p.shape.centre);
  for (const Panel& p : mesh.lid) out.push_back(p.shape.centre);
  return out;
}

/// Part of `full` (rows s · n + i) that has the signs of a class, on the part of the mesh that is kept.
template <class Matrix>
Matrix projected(const Matrix& full, const Signs& signs) {
  const Index n = full.rows() / static_cast<Index>(signs.size());
  Matrix out = Matrix::Zero(n, full.cols());
  for (std::size_t s = 0; s < signs.size(); ++s)
    out += signs[s] / static_cast<double>(signs.size()) * full.middleRows(static_cast<Index>(s) * n, n);
  return out;
}

Vector3d mirrored_in_surface(const Vector3d& p) { return {p.x(), p.y(), -p.z()}; }
Vector3d mirrored_in_bed(const Vector3d& p, double depth) { return {p.x(), p.y(), -2 * depth - p.z()}; }

/// Columns of the class that are not zero by symmetry.
std::vector<Index> columns_of(const MatrixXd& projected) {
  std::vector<Index> out;
  for (Index c = 0; c < projected.cols(); ++c)
    if (projected.col(c).cwiseAbs().maxCoeff() > 0) out.push_back(c);
  return out;
}

/// Rounding is no velocity: entries far below the largest of a mode are set to zero.
void drop_rounding(MatrixXd& projected, const MatrixXd& full) {
  for (Index c = 0; c < full.cols(); ++c)
    if (projected.col(c).cwiseAbs().maxCoeff() < 1e-5 * full.col(c).cwiseAbs().maxCoeff()) projected.col(c).setZero();
}

struct WaveIntegrals {
  Complex source = 0, dipole = 0;
};

/// More points the nearer P is to the panel's image in the surface, where the wave part is singular (G12).
std::size_t level_of(const Polygon& q, const Vector3d& P, double K) {
  const Vector3d from = P - mirrored_in_surface(q.centre);
  const double distance = from.norm() / q.size;
  const std::size_t level = distance > 4 ? 0 : distance > 1.5 ? 1 : distance > 0.6 ? 2 : 3;
  return std::isfinite(K) && K * q.size > 1 ? std::max<std::size_t>(level, 1) : level;
}

/// What waves have at the points of a panel's rules, by level.
using HeightsOfPanel = std::array<std::vector<WaveHeight>, 4>;

HeightsOfPanel heights_of(const WaveGreen& green, const Panel& panel) {
  HeightsOfPanel out;
  for (std::size_t level = 0; level < out.size(); ++level)
    for (const RulePoint& point : panel.rule[level]) out[level].push_back(green.height(point.at.z()));
  return out;
}

/// `height(level, i)`: what waves have at point i of a rule.
template <class Height>
WaveIntegrals wave_integrals(const WaveGreen& green, const Panel& panel, std::size_t level, const Height& height,
                             const Vector3d& P, const WaveHeight& of_P) {
  WaveIntegrals sum;
  const Vector3d& n = panel.shape.normal;
  for (std::size_t i = 0; i < panel.rule[level].size(); ++i) {
    const auto& [Q, weight] = panel.rule[level][i];
    const double dx = Q.x() - P.x(), dy = Q.y() - P.y(), R = std::sqrt(dx * dx + dy * dy);
    const WavePart w = green(R, of_P, height(level, i));
    sum.source += weight * w.G;
    const double along = R > 0 ? (dx * n.x() + dy * n.y()) / R : 0;
    sum.dipole += weight * (along * w.G_R + n.z() * w.G_zeta);
  }
  return sum;
}

/// The equations of one class: matrix and right-hand sides.
struct Equations {
  MatrixXcd matrix, right;
  MatrixXd velocity;          ///< (hull panels, columns)
  std::vector<Index> motion;  ///< modes that have a column
};

/// What does not depend on waves (G12).
void set_rankine(const RankineParts::OfClass& part, const WaveGreen& green, Index hull, Equations& e) {
  const double sign = green.image_sign();
  const Index rows = part.dipole.rows(), lid = rows - hull;
  e.matrix.resize(rows, rows);
  e.matrix.leftCols(hull) = -(part.dipole + sign * part.image_dipole).cast<Complex>();
  e.matrix.topLeftCorner(hull, hull).diagonal().array() += 2 * pi;
  if (lid > 0) {
    e.matrix.rightCols(lid) = -green.K() * part.lid.cast<Complex>();
    e.matrix.bottomRightCorner(lid, lid).diagonal().array() -= 4 * pi;
  }
  for (std::size_t c = 0; c < e.motion.size(); ++c)
    e.right.col(static_cast<Index>(c)) = -(part.source + sign * part.image_source).col(e.motion[c]).cast<Complex>();
}

/// Adds the waves that one panel makes at all points, (rows, images), to column j of the equations of a class.
void add_waves_of(const MatrixXcd& source, const MatrixXcd& dipole, const Signs& signs, double K, Index j,
                  Equations& e) {
  const Eigen::Map<const Eigen::VectorXd> sign(signs.data(), static_cast<Index>(signs.size()));
  const Eigen::VectorXcd of_source = source * sign.cast<Complex>();
  if (j >= e.velocity.rows()) {  // on the lid
    e.matrix.col(j) -= K * of_source;
    return;
  }
  e.matrix.col(j) -= dipole * sign.cast<Complex>();
  for (Index m = 0; m < e.velocity.cols(); ++m)
    if (e.velocity(j, m) != 0) e.right.col(m) -= e.velocity(j, m) * of_source;
}

/// Adds the waves of every pair to the equations of all classes.
void add_waves(const PanelMesh& mesh, const WaveGreen& green, const std::vector<Signs>& classes,
               std::vector<Equations>& all) {
  const std::vector<Vector3d> points = centres(mesh);
  const auto rows = static_cast<Index>(points.size()), images = static_cast<Index>(mesh.images.size());
  std::vector<WaveHeight> of_points;
  for (const Vector3d& P : points) of_points.push_back(green.height(P.z()));
  MatrixXcd source(rows, images), dipole(rows, images);
  const auto panels_of_hull = static_cast<Index>(mesh.hull.size());
  for (Index j = 0; j < rows; ++j) {
    const Panel& panel = j < panels_of_hull ? mesh.hull[static_cast<std::size_t>(j)]
                                            : mesh.lid[static_cast<std::size_t>(j - panels_of_hull)];
    const auto height = [of_panel = heights_of(green, panel)](std::size_t level, std::size_t i) {
      return of_panel[level][i];
    };
    for (Index s = 0; s < images; ++s)
      for (Index i = 0; i < rows; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const Vector3d P = mesh.images[static_cast<std::size_t>(s)] * points[at];
        const WaveIntegrals w =
            wave_integrals(green, panel, level_of(panel.shape, P, green.K()), height, P, of_points[at]);
        source(i, s) = w.source;
        dipole(i, s) = w.dipole;
      }
    for (std::size_t c = 0; c < classes.size(); ++c) add_waves_of(source, dipole, classes[c], green.K(), j, all[c]);
  }
}

/// \throws NumericsError if the matrix is singular to working precision
MatrixXcd solved(const Equations& e) {
  const dense::ComplexLu lu(e.matrix);
  MatrixXcd x = lu.solve(e.right);
  if (!x.allFinite()) throw NumericsError("the equations of the panels are singular");
  return x;
}

void add_incident(const MatrixXcd& incident, const PanelMesh& mesh, const Signs& signs, Equations& e) {
  const auto all_hull = static_cast<Index>(mesh.hull_panels()), hull = static_cast<Index>(mesh.hull.size());
  const Index waves = incident.cols();
  if (waves == 0) return;
  e.right.topRightCorner(hull, waves) = 4 * pi * projected(MatrixXcd(incident.topRows(all_hull)), signs);
  if (!mesh.lid.empty())
    e.right.bottomRightCorner(e.right.rows() - hull, waves) =
        4 * pi * projected(MatrixXcd(incident.bottomRows(incident.rows() - all_hull)), signs);
}

}  // namespace

namespace {

/// rankine(), by the centre alone where `decided_at`, at P or near it, is so far that a few 1e-4 are lost by it.
Rankine rankine_far_or_near(const Polygon& q, const Vector3d& P, const Vector3d& decided_at) {
  constexpr double by_centre = 10;  // sizes of the panel
  if ((decided_at - q.centre).norm() < by_centre * q.size) return rankine(q, P);
  const Vector3d way = P - q.centre;
  const double r = way.norm();
  return {q.area / r, q.area * q.normal.dot(way) / (r * r * r)};
}

WaveIntegrals waves_of(const WaveGreen& green, const Panel& panel, const Vector3d& P, const Vector3d& decided_at) {
  if (green.none()) return {};
  const auto height = [&](std::size_t level, std::size_t i) { return green.height(panel.rule[level][i].at.z()); };
  return wave_integrals(green, panel, level_of(panel.shape, decided_at, green.K()), height, P, green.height(P.z()));
}

}  // namespace

Influence influence(const WaveGreen& green, const WaterDepth& depth, const Panel& panel, const Vector3d& P,
                    const Vector3d& decided_at) {
  const auto of_image = [&](const auto& mirrored) {
    return rankine_far_or_near(panel.shape, mirrored(P), mirrored(decided_at));
  };
  const Rankine direct = rankine_far_or_near(panel.shape, P, decided_at), image = of_image(mirrored_in_surface);
  const Rankine bed =
      depth.is_infinite() ? Rankine{} : of_image([&](const Vector3d& p) { return mirrored_in_bed(p, depth.metres()); });
  const WaveIntegrals wave = waves_of(green, panel, P, decided_at);
  const double sign = green.image_sign();
  return {direct.source + sign * image.source + bed.source + wave.source,
          direct.dipole + sign * image.dipole + bed.dipole + wave.dipole};
}

std::vector<Signs> classes_of(const PanelMesh& mesh) {
  const auto& images = mesh.images;
  const bool x = std::any_of(images.begin(), images.end(), [](const Image& i) { return i.x < 0; });
  const bool y = std::any_of(images.begin(), images.end(), [](const Image& i) { return i.y < 0; });
  std::vector<Signs> classes;
  for (const double odd_x : x ? std::vector<double>{1, -1} : std::vector<double>{1})
    for (const double odd_y : y ? std::vector<double>{1, -1} : std::vector<double>{1}) {
      Signs signs;
      for (const Image& i : images) signs.push_back((i.x < 0 ? odd_x : 1) * (i.y < 0 ? odd_y : 1));
      classes.push_back(signs);
    }
  return classes;
}

AllPanels all_panels(const PanelMesh& mesh, const std::vector<HullBody>& bodies) {
  const Index n = mesh.hull_panels();
  AllPanels all{MatrixXd::Zero(n, 6 * static_cast<Index>(bodies.size())), MatrixXd(n, 3), MatrixXd(n, 3),
                Eigen::VectorXd(n)};
  Index row = 0;
  for (std::size_t s = 0; s < mesh.images.size(); ++s)
    for (std::size_t i = 0; i < mesh.hull.size(); ++i, ++row) {
      const Polygon& p = mesh.hull[i].shape;
      const auto body = static_cast<std::size_t>(mesh.body_of[i][s]);
      const Vector3d at = mesh.images[s] * p.centre, normal = mesh.images[s] * p.normal;
      all.point.row(row) = at;
      all.n.row(row) = normal;
      all.area(row) = p.area;
      const Vector3d moment = (at - bodies[body].reference_point).cross(normal);
      all.normal.block<1, 3>(row, 6 * static_cast<Index>(body)) = normal;
      all.normal.block<1, 3>(row, 6 * static_cast<Index>(body) + 3) = moment;
    }
  return all;
}

RankineParts rankine_parts(const PanelMesh& mesh, const AllPanels& all, const WaterDepth& depth) {
  const std::vector<Vector3d> points = centres(mesh);
  const std::vector<Signs> classes = classes_of(mesh);
  const auto rows = static_cast<Index>(points.size()), hull = static_cast<Index>(mesh.hull.size());
  RankineParts out;
  std::vector<std::array<MatrixXd, 2>> sources;  // of unit strength, and of their images in the surface
  for (std::size_t c = 0; c < classes.size(); ++c) {
    const MatrixXd none = MatrixXd::Zero(rows, hull);
    out.of_class.push_back({none, none, {}, {}, MatrixXd::Zero(rows, rows - hull)});
    sources.push_back({none, none});
  }
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < rows; ++i)
      for (std::size_t s = 0; s < mesh.images.size(); ++s) {
        const Vector3d P = mesh.images[s] * points[static_cast<std::size_t>(i)];
        const bool on_hull = j < hull;
        const Polygon& q =
            on_hull ? mesh.hull[static_cast<std::size_t>(j)].shape : mesh.lid[static_cast<std::size_t>(j - hull)].shape;
        Rankine direct = rankine(q, P);
        if (i == j && s == 0) direct.dipole = 0;  // the jump is on the diagonal
        const Rankine image = rankine(q, mirrored_in_surface(P));
        const Rankine bed = depth.is_infinite() ? Rankine{} : rankine(q, mirrored_in_bed(P, depth.metres()));
        for (std::size_t c = 0; c < classes.size(); ++c) {
          RankineParts::OfClass& o = out.of_class[c];
          const double sign = classes[c][s];
          if (!on_hull) {
            o.lid(i, j - hull) += sign * (direct.source + image.source + bed.source);
            continue;
          }
          o.dipole(i, j) += sign * (direct.dipole + bed.dipole);
          o.image_dipole(i, j) += sign * image.dipole;
          sources[c][0](i, j) += sign * (direct.source + bed.source);
          sources[c][1](i, j) += sign * image.source;
        }
      }
  for (std::size_t c = 0; c < classes.size(); ++c) {
    MatrixXd velocity = projected(all.normal, classes[c]);
    drop_rounding(velocity, all.normal);
    out.of_class[c].source = sources[c][0] * velocity;
    out.of_class[c].image_source = sources[c][1] * velocity;
  }
  return out;
}

Potentials solve_system(const PanelMesh& mesh, const AllPanels& all, const RankineParts& parts, const WaveGreen& green,
                        const MatrixXcd& incident) {
  const std::vector<Signs> classes = classes_of(mesh);
  const auto hull = static_cast<Index>(mesh.hull.size());
  std::vector<Equations> equations(classes.size());
  for (std::size_t c = 0; c < classes.size(); ++c) {
    Equations& e = equations[c];
    MatrixXd velocity = projected(all.normal, classes[c]);
    drop_rounding(velocity, all.normal);
    e.motion = columns_of(velocity);
    e.velocity = velocity(Eigen::all, e.motion);
    e.right = MatrixXcd::Zero(parts.of_class[c].dipole.rows(), static_cast<Index>(e.motion.size()) + incident.cols());
    set_rankine(parts.of_class[c], green, hull, e);
    add_incident(incident, mesh, classes[c], e);
  }
  if (!green.none()) add_waves(mesh, green, classes, equations);
  Potentials out{MatrixXcd::Zero(all.normal.rows(), all.normal.cols()),
                 MatrixXcd::Zero(all.normal.rows(), incident.cols())};
  for (std::size_t c = 0; c < classes.size(); ++c) {
    const MatrixXcd x = solved(equations[c]).topRows(hull);
    const auto motions = static_cast<Index>(equations[c].motion.size());
    for (std::size_t s = 0; s < classes[c].size(); ++s) {
      const Index row = static_cast<Index>(s) * hull;
      for (Index m = 0; m < motions; ++m)
        out.motion.col(equations[c].motion[static_cast<std::size_t>(m)]).segment(row, hull) += classes[c][s] * x.col(m);
      out.wave.middleRows(row, hull) += classes[c][s] * x.rightCols(incident.cols());
    }
  }
  return out;
}

}  // namespace hydro::panels
