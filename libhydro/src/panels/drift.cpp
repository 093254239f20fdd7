#include "panels/drift.hpp"

// Boost's geometry includes a header that Boost itself calls deprecated, and would say so at each build.
#define BOOST_ALLOW_DEPRECATED_HEADERS

#include <algorithm>
#include <boost/geometry/algorithms/convex_hull.hpp>
#include <boost/geometry/algorithms/distance.hpp>
#include <boost/geometry/geometries/multi_point.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/base/parallel.hpp"
#include "hydro/waves/dispersion.hpp"
#include "potential/control_surface.hpp"
#include "surface.hpp"
#include "waves/gauss_legendre.hpp"

namespace hydro::panels {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::Vector2d;
using Eigen::Vector3d;
using potential::ControlPoint;

using PlanPoint = boost::geometry::model::d2::point_xy<double>;
using Outline = boost::geometry::model::polygon<PlanPoint, false>;  // anticlockwise

/// A hull seen from above, made convex, and how deep it goes.
struct Plan {
  Outline outline;
  double extent = 0;   ///< of the outline, m
  double draught = 0;  ///< m
};

std::vector<Plan> plans_of(const PanelMesh& mesh, std::size_t bodies) {
  std::vector<boost::geometry::model::multi_point<PlanPoint>> corners(bodies);
  std::vector<Plan> out(bodies);
  for (std::size_t s = 0; s < mesh.images.size(); ++s)
    for (std::size_t i = 0; i < mesh.hull.size(); ++i)
      for (const Vector3d& corner : mesh.hull[i].shape.corners) {
        const auto body = static_cast<std::size_t>(mesh.body_of[i][s]);
        const Vector3d at = mesh.images[s] * corner;
        corners[body].emplace_back(at.x(), at.y());
        out[body].draught = std::max(out[body].draught, -at.z());
      }
  for (std::size_t b = 0; b < bodies; ++b) {
    boost::geometry::convex_hull(corners[b], out[b].outline);
    for (const PlanPoint& p : out[b].outline.outer())
      for (const PlanPoint& q : out[b].outline.outer())
        out[b].extent = std::max(out[b].extent, boost::geometry::distance(p, q));
  }
  return out;
}

/// Half way to the next hull, but not farther than a quarter of this one's extent. \throws InputError as drift_of()
double distance_counted(const std::vector<Plan>& plans, std::size_t of) {
  double distance = plans[of].extent / 4;
  for (std::size_t b = 0; b < plans.size(); ++b) {
    if (b == of) continue;
    const double way = boost::geometry::distance(plans[of].outline, plans[b].outline);
    require(way > 0,
            "bodies {} and {} overlap when seen from above with their outlines made convex: no upright surface parts "
            "them, and their mean drift is not told",
            std::min(of, b) + 1, std::max(of, b) + 1);
    distance = std::min(distance, way / 2);
  }
  return distance;
}

std::vector<Vector2d> corners_of(const Outline& outline) {
  std::vector<Vector2d> out;
  for (const PlanPoint& p : outline.outer()) out.emplace_back(p.x(), p.y());
  out.pop_back();  // the first once more
  return out;
}

struct Height {
  double z, weight;  ///< m
};

/// From the surface down to `end`: in pieces of `fine` as far as `draught`, then each twice the one before.
std::vector<Height> heights(double fine, double draught, double end) {
  static const waves::GaussLegendre<6> rule;
  std::vector<Height> out;
  double piece = fine;
  for (double top = 0; top < end; top += piece) {
    if (top > draught) piece *= 2;
    const double half = std::min(piece, end - top) / 2;
    for (std::size_t i = 0; i < rule.point.size(); ++i)
      out.push_back({-(top + half * (1 + rule.point[i])), half * rule.weight[i]});
  }
  return out;
}

/// The water about the hulls in one wave, as they move.
class Around {
 public:
  Around(const Model& model, const Water& water, const potential::FieldQuestion& question, const Potentials& phi,
         double reach)
      : model_(model),
        depth_(water.depth),
        omega_(question.omega),
        k_(waves::wavenumber(question.omega, water)),
        heading_(question.heading),
        green_(question.omega * question.omega / water.gravity, water.depth, reach) {
    const Eigen::VectorXcd velocity = Complex(0, question.omega) * question.motion;
    on_panels_[0] = {phi.wave.col(0) + phi.motion * velocity, model.all().normal * velocity};
  }

  /// φ; panels are summed by rules that suit `decided_at`.
  Complex potential(const Vector3d& P, const Vector3d& decided_at) const {
    return model_.incident(omega_, k_, heading_, P) +
           by_greens_theorem(model_.mesh(), depth_, green_, on_panels_, P, decided_at)[0] / (4 * std::numbers::pi);
  }
  /// Differences over `step` both ways: φ is smooth, and off by step² of its third derivative.
  Eigen::Vector3cd slopes(const Vector3d& P, double step) const {
    Eigen::Vector3cd out;
    for (int k = 0; k < 3; ++k) {
      const Vector3d way = step * Vector3d::Unit(k);
      out(k) = (potential(P + way, P) - potential(P - way, P)) / (2 * step);
    }
    return out;
  }

 private:
  const Model& model_;
  WaterDepth depth_;
  double omega_, k_, heading_;
  WaveGreen green_;
  std::array<OnPanels, 1> on_panels_;
};

/// The upright surface about one hull.
struct Surface {
  std::vector<ControlPoint> line;
  std::vector<Height> down;
  double step;  ///< of differences, m
};

Surface surface_about(const std::vector<Plan>& plans, std::size_t of, double k, const WaterDepth& depth) {
  const Plan& plan = plans[of];
  const double distance = distance_counted(plans, of), fine = std::min(distance, 1 / k);
  const double far_below = std::max(10 / k, 10 * plan.extent);  // where nothing is left of waves and of the hull
  const double end = depth.is_infinite() ? far_below : std::min(depth.metres(), far_below);
  return {potential::line_about(corners_of(plan.outline), distance, fine), heights(fine, plan.draught, end),
          1e-3 * fine};
}

/// What goes through the surface below a point of its line; −¼ρg|η|² at the still water is −¼ρ(ω²/g)|φ|².
Vector3d through(const Surface& surface, const ControlPoint& point, const Around& around, const Vector2d& about,
                 double density, double K) {
  const Vector3d top(point.at.x(), point.at.y(), 0);
  Vector3d sum = load_through(point, about, density, Eigen::Vector2cd::Zero(),
                              -density / 4 * K * std::norm(around.potential(top, top)));
  for (const Height& h : surface.down) {
    const Eigen::Vector3cd slope = around.slopes({point.at.x(), point.at.y(), h.z}, std::min(surface.step, -h.z / 2));
    sum += h.weight * load_through(point, about, density, slope.head<2>(), density / 4 * slope.squaredNorm());
  }
  return sum;
}

}  // namespace

potential::BodyDrift drift_of(const Model& model, const Water& water, const potential::FieldQuestion& question,
                              const Potentials& phi, int threads) {
  const std::size_t bodies = model.reference_points().size();
  const std::vector<Plan> plans = plans_of(model.mesh(), bodies);
  const double k = waves::wavenumber(question.omega, water), K = question.omega * question.omega / water.gravity;
  double widest = 0;
  for (const Plan& plan : plans) widest = std::max(widest, plan.extent);
  const Around around(model, water, question, phi, model.reach() + widest);
  potential::BodyDrift out{.load = Eigen::MatrixX3d::Zero(static_cast<Index>(bodies), 3)};
  for (std::size_t b = 0; b < bodies; ++b) {
    const Surface surface = surface_about(plans, b, k, water.depth);
    const Vector2d about = model.reference_points()[b].head<2>();
    Eigen::MatrixX3d at_points(static_cast<Index>(surface.line.size()), 3);
    in_parallel(surface.line.size(), threads, [&](std::size_t i) {
      at_points.row(static_cast<Index>(i)) =
          through(surface, surface.line[i], around, about, water.density, K).transpose();
    });
    out.load.row(static_cast<Index>(b)) = at_points.colwise().sum();
    for (const ControlPoint& point : surface.line) out.length = std::max(out.length, (point.at - about).norm());
  }
  return out;
}

}  // namespace hydro::panels
