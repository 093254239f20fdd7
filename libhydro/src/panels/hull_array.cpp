#include "hull_array.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "controlled.hpp"
#include "cylinders/deep.hpp"
#include "cylinders/model.hpp"
#include "cylinders/surface.hpp"
#include "potential/solver_request.hpp"
#include "refine.hpp"
#include "regular_waves.hpp"
#include "request.hpp"

namespace hydro::panels {
namespace {

using cylinders::Channels, cylinders::Compound, cylinders::VerticalModes;
using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using hydrostatics::Hull;
using std::numbers::pi;

/// −1/(2πh W_n) of (G19), by channel.
Eigen::VectorXcd outgoing_factors(const VerticalModes& modes, const Channels& channels) {
  const cylinders::WaveIndex at(channels);
  Eigen::VectorXcd out(channels.count());
  for (int n = 0; n < channels.vertical(); ++n) {
    const Complex wronskian = n == 0 ? Complex(0, -2 / pi) : Complex(-1);
    const int M = channels.order[static_cast<std::size_t>(n)];
    out.segment(at(0, n, -M), 2 * M + 1).setConstant(-1.0 / (2 * pi * modes.depth * wronskian));
  }
  return out;
}

/// Corners of what is under water, cut at z = 0.
std::vector<Vector3d> wet_corners(const Hull& hull) {
  std::vector<Vector3d> out;
  for (const auto& t : hull.triangles())
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d &a = hull.vertices()[static_cast<std::size_t>(t[i])],
                     &b = hull.vertices()[static_cast<std::size_t>(t[(i + 1) % 3])];
      if (a.z() <= 0) out.push_back(a);
      if (a.z() * b.z() < 0) out.emplace_back(a + a.z() / (a.z() - b.z()) * (b - a));
    }
  return out;
}

/// True if one is the other moved along the water.
bool are_copies(const Hull& a, const Hull& b) {
  constexpr double rounding = 1e-9;
  if (a.triangles() != b.triangles() || a.vertices().size() != b.vertices().size()) return false;
  const Vector3d way = b.vertices()[0] - a.vertices()[0];
  double size = 0;
  for (const Vector3d& v : a.vertices()) size = std::max(size, (v - a.vertices()[0]).norm());
  if (std::abs(way.z()) > rounding * size) return false;
  for (std::size_t i = 0; i < a.vertices().size(); ++i)
    if ((b.vertices()[i] - a.vertices()[i] - way).norm() > rounding * (size + way.norm())) return false;
  return true;
}

Hull moved(const Hull& hull, const Vector3d& way) {
  hydrostatics::TriangleMesh mesh{hull.source(), hull.vertices(), hull.triangles()};
  for (Vector3d& v : mesh.vertices) v += way;
  return Hull(std::move(mesh));
}

/// The circle about the middle of what is under water.
cylinders::Cylinder circle_about(const std::string& body, const Hull& hull) {
  const std::vector<Vector3d> wet = wet_corners(hull);
  require(!wet.empty(), "{}: nothing of \"{}\" is under water (z < 0)", hull.source(), body);
  Vector3d low = wet.front(), high = low;
  for (const Vector3d& v : wet) low = low.cwiseMin(v), high = high.cwiseMax(v);
  cylinders::Cylinder out{((low + high) / 2).head<2>(), 0, -low.z()};
  for (const Vector3d& v : wet) out.radius = std::max(out.radius, (v.head<2>() - out.centre).norm());
  return out;
}

/// A hull alone in water of this depth: what panels make of it.
std::vector<std::unique_ptr<const Model>> models_in(const Water& water, const HullPlaces& places,
                                                    const std::vector<PanelMesh>& mesh) {
  std::vector<std::unique_ptr<const Model>> out;
  for (std::size_t k = 0; k < mesh.size(); ++k)
    out.push_back(std::make_unique<Model>(mesh[k], std::vector{places.kind[k]}, water));
  return out;
}

/// A hull has the planes of symmetry that its mesh has.
cylinders::SolvedMotions solved_motions(const HullPlaces& places, const std::vector<PanelMesh>& mesh) {
  return {places.circle, places.kind_of, places.motion, [&](std::size_t kind, const Eigen::Matrix2d& turn) {
            const auto& images = mesh[kind].images;
            return std::any_of(images.begin(), images.end(), [&](const Image& image) {
              return turn == Eigen::Vector2d(image.x, image.y).asDiagonal().toDenseMatrix();
            });
          }};
}

/// What is extrapolated are T, R, E and L of each kind, one after the other.
class ArraySolver : public Solver {
 public:
  ArraySolver(std::shared_ptr<const HullPlaces> places, std::vector<PanelMesh> mesh, const Water& water,
              const std::vector<double>& omega, double threshold)
      : places_(std::move(places)),
        mesh_(std::move(mesh)),
        solved_(solved_motions(*places_, mesh_)),
        water_(water),
        threshold_(threshold) {
    if (water_.depth.is_infinite()) return;
    shared_ = models_in(water_, *places_, mesh_);
    channels_ = channels_of_all(*places_, water_, omega, threshold);
  }

  Extrapolated solved(double omega, const std::vector<double>&) const override {
    const PartialWaves waves = waves_at(omega);
    cylinders::require_coupling(waves.channels, "hulls", omega);
    const auto own = water_.depth.is_infinite() ? models_in(waves.water, *places_, mesh_)
                                                : std::vector<std::unique_ptr<const Model>>{};
    const auto& models = own.empty() ? shared_ : own;
    Extrapolated out;
    for (std::size_t k = 0; k < models.size(); ++k) {
      Compound c = compound_of_hull(*models[k], waves.modes, places_->circle_of_kind[k].radius, waves.channels);
      for (MatrixXcd* part : {&c.T, &c.R, &c.E, &c.L}) out.push_back(std::move(*part));
    }
    return out;
  }
  OneFrequency answer(double omega, const std::vector<double>& heading, const Extrapolated& from) const override {
    return answer_of(places_->circle, places_->kind_of, places_->lattice, places_->motion, solved_, omega, heading,
                     from);
  }
  MatrixXd added_mass(double limit, const Extrapolated& from) const override {
    ensure(std::isinf(limit), "arrays have no limit of long waves");
    const PartialWaves waves = waves_at(limit);
    return cylinders::added_mass_at_infinity(groups(places_->circle, places_->kind_of, places_->lattice, waves, from),
                                             water_, places_->motion, solved_, cylinders::Equations::automatic);
  }
  std::vector<OneFrequency> alone(double omega, const std::vector<double>& heading,
                                  const Extrapolated& from) const override {
    std::vector<OneFrequency> out;
    for (std::size_t k = 0; k < places_->kind.size(); ++k)
      out.push_back(answer_of({places_->circle_of_kind[k]}, {k}, {}, MatrixXd::Identity(6, 6),
                              cylinders::SolvedMotions(1), omega, heading, from));
    return out;
  }
  potential::WaveField field(const potential::FieldQuestion& question, int threads) const override {
    if (question.pressure)
      throw InputError("pressures on hulls are not told where hulls are joined by partial waves", {},
                       "solve all panels together: mesh_interaction = \"panels\" in a scene");
    const PartialWaves waves = waves_at(question.omega);
    const cylinders::Groups all =
        groups(places_->circle, places_->kind_of, places_->lattice, waves, solved(question.omega, {question.heading}));
    const MatrixXd velocity = places_->motion * cylinders::velocities_of(question);
    const auto there = all.arrived({question.heading}, velocity, cylinders::Equations::automatic);
    const std::vector<bool> known = cylinders::outside(places_->circle, question.point);
    const cylinders::Amplitudes sent = all.sent_out(there.a, velocity);
    const std::vector<double> angle =
        cylinders::angles_around(places_->circle, question.heading, waves.modes.k, waves.channels.highest_order());
    potential::WaveField out = cylinders::field_of(
        cylinders::potentials_at_surface(places_->circle, waves.modes, waves.channels, sent, question.point, known, 0,
                                         waves.channels.vertical(), threads),
        waves.modes, water_, question, known);
    out.far = cylinders::far_field_of(angle, all.far_field(sent, angle), waves.modes, water_, question.omega);
    if (question.drift)
      out.on_bodies = cylinders::body_drift(places_->circle, places_->owner, waves.modes, waves.channels, sent,
                                            question, waves.water, threads);
    return out;
  }

 private:
  using Circles = std::vector<cylinders::Cylinder>;
  using Kinds = std::vector<std::size_t>;
  using OnLattice = std::optional<cylinders::Lattice>;

  PartialWaves waves_at(double omega) const {
    PartialWaves waves = partial_waves(*places_, water_, omega, threshold_);
    if (channels_ && std::isfinite(omega)) waves.channels = *channels_;
    return waves;
  }
  cylinders::Groups groups(const Circles& circle, const Kinds& kind, const OnLattice& lattice,
                           const PartialWaves& waves, const Extrapolated& from) const {
    constexpr double precision = 10;  // of what passes, times the threshold: as between cylinders
    std::vector<std::shared_ptr<const Compound>> compound;
    for (std::size_t k = 0; k < places_->kind.size(); ++k)
      compound.push_back(
          std::make_shared<const Compound>(Compound{from[4 * k], from[4 * k + 1], from[4 * k + 2], from[4 * k + 3]}));
    return {circle,
            kind,
            lattice ? &*lattice : nullptr,
            compound,
            waves.modes,
            cylinders::each_alone(waves.channels, waves.modes, circle),
            precision * threshold_};
  }
  OneFrequency answer_of(const Circles& circle, const Kinds& kind, const OnLattice& lattice, const MatrixXd& motion,
                         const cylinders::SolvedMotions& solved, double omega, const std::vector<double>& heading,
                         const Extrapolated& from) const {
    const PartialWaves waves = waves_at(omega);
    const cylinders::OneFrequency found =
        cylinders::answers(groups(circle, kind, lattice, waves, from),
                           {omega, water_, waves.modes, heading, motion, solved, cylinders::distance_across(circle),
                            waves.channels.highest_order() + 1});
    return {found.A, found.B, found.B_far, found.X, found.X_far, waves.channels.count()};
  }

  std::shared_ptr<const HullPlaces> places_;
  std::vector<PanelMesh> mesh_;
  cylinders::SolvedMotions solved_;
  Water water_;
  double threshold_;
  std::vector<std::unique_ptr<const Model>> shared_;  // in water of finite depth
  std::optional<Channels> channels_;                  // at all frequencies, in water of finite depth
};

}  // namespace

// (G19)
Compound compound_of_hull(const Model& model, const VerticalModes& modes, double radius, const Channels& channels) {
  const AllPanels& all = model.all();
  const Index hull = all.point.rows();
  const MatrixXd point = model.points(modes.K);
  MatrixXd normal = MatrixXd::Zero(point.rows(), 3);
  normal.topRows(hull) = all.n;
  const RegularWaves waves = regular_waves(point, normal, modes, radius, channels);
  const Potentials phi = model.potentials(modes.K, waves.value);
  const MatrixXcd value = all.area.asDiagonal() * waves.value.topRows(hull),
                  slope = all.area.asDiagonal() * waves.slope.topRows(hull);
  const Eigen::VectorXcd factor = outgoing_factors(modes, channels);
  return {factor.asDiagonal() * (slope.adjoint() * phi.wave),
          factor.asDiagonal() * (slope.adjoint() * phi.motion - value.adjoint() * all.normal), model.loads(phi.wave),
          model.loads(phi.motion)};
}

HullPlaces places_of(const std::vector<HullBody>& bodies) {
  HullPlaces out;
  std::vector<const Hull*> first;       // of each kind, as it stands
  std::vector<Eigen::Vector2d> centre;  // of the circle about it
  for (const HullBody& body : bodies) {
    const auto known =
        std::find_if(first.begin(), first.end(), [&](const Hull* h) { return are_copies(*h, body.hull); });
    const auto kind = static_cast<std::size_t>(known - first.begin());
    if (known == first.end()) {
      first.push_back(&body.hull);
      cylinders::Cylinder circle = circle_about(body.name, body.hull);
      centre.push_back(circle.centre);
      const Vector3d axis(circle.centre.x(), circle.centre.y(), 0);
      circle.centre.setZero();
      out.circle_of_kind.push_back(circle);
      out.kind.push_back({body.name, Vector3d::Zero(), {}, moved(body.hull, -axis)});
    }
    out.kind_of.push_back(kind);
    out.circle.push_back(out.circle_of_kind[kind]);
    out.circle.back().centre = centre[kind] + (body.hull.vertices()[0] - first[kind]->vertices()[0]).head<2>();
  }
  const auto modes = 6 * static_cast<Index>(bodies.size());
  out.motion = MatrixXd::Zero(modes, modes);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Vector3d axis(out.circle[b].centre.x(), out.circle[b].centre.y(), 0);
    const auto at = 6 * static_cast<Index>(b);
    out.motion.block<6, 6>(at, at) = potential::rigid_shift(axis - bodies[b].reference_point);
    out.owner.push_back({b, bodies[b].reference_point.head<2>()});
  }
  out.lattice = cylinders::find_lattice(out.circle);
  return out;
}

std::optional<TooNear> too_near(const HullPlaces& places) {
  for (std::size_t i = 0; i < places.circle.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const cylinders::Cylinder &a = places.circle[j], &b = places.circle[i];
      const double distance = (a.centre - b.centre).norm(), radii = a.radius + b.radius;
      if (!(distance > radii)) return TooNear{j, i, distance, radii};
    }
  return {};
}

PartialWaves partial_waves(const HullPlaces& places, const Water& water, double omega, double threshold) {
  constexpr double deep = 15;  // sizes: the bed is felt by 3e-4
  const Water here = cylinders::effective_water(places.circle, water, omega, deep);
  VerticalModes modes = cylinders::modes_that_may_couple(places.circle, here, omega);
  // In deep water many weak modes add up: a threshold of 1e-3 left out 1e-4 in four radii of depth, 0.016 in ninety.
  constexpr double shallow = 10;  // radii
  double largest = 0;
  for (const cylinders::Cylinder& c : places.circle_of_kind) largest = std::max(largest, c.radius);
  const double weakest = threshold * std::min(1.0, shallow * largest / here.depth.metres());
  Channels channels =
      cylinders::coupled_channels(places.circle, modes, weakest, [](std::size_t, std::size_t) { return true; });
  return {here, std::move(modes), std::move(channels)};
}

Channels channels_of_all(const HullPlaces& places, const Water& water, const std::vector<double>& omega,
                         double threshold) {
  Channels all{{1}};
  for (const double w : omega) all = all.united_with(partial_waves(places, water, w, threshold).channels);
  return all;
}

HullArray::HullArray(const std::vector<HullBody>& bodies, const Water& water, const std::vector<double>& omega,
                     double threshold, bool lid)
    : places_(std::make_shared<const HullPlaces>(places_of(bodies))),
      water_(water),
      omega_(omega),
      threshold_(threshold) {
  if (const auto near = too_near(*places_))
    throw InputError(
        fmt::format("\"{}\" and \"{}\" are too near to each other for partial waves: their axes are {:.4g} m apart, "
                    "the circles about what is under water have radii of {:.4g} m together",
                    bodies[near->first].name, bodies[near->second].name, near->distance, near->radii),
        {},
        "move them apart, or solve all panels together: mesh_interaction = \"panels\" in a scene, --interaction panels "
        "of "
        "froude bem solve");
  for (const HullBody& kind : places_->kind) mesh_.push_back(panel_mesh({kind}, water.depth, lid));
}

HullArray::HullArray(const HullArray& other, std::vector<PanelMesh> mesh)
    : places_(other.places_),
      water_(other.water_),
      omega_(other.omega_),
      threshold_(other.threshold_),
      mesh_(std::move(mesh)) {}

std::unique_ptr<const Solver> HullArray::solver() const {
  return std::make_unique<ArraySolver>(places_, mesh_, water_, omega_, threshold_);
}

std::unique_ptr<const Solver> HullArray::with_more_partial_waves() const {
  return std::make_unique<ArraySolver>(places_, mesh_, water_, omega_, threshold_ / more_partial_waves);
}

std::unique_ptr<const Discretisation> HullArray::refined() const {
  std::vector<PanelMesh> finer;
  for (const PanelMesh& mesh : mesh_) finer.push_back(panels::refined(mesh));
  return std::unique_ptr<const Discretisation>(new HullArray(*this, std::move(finer)));
}

std::unique_ptr<const Discretisation> HullArray::graded(double highest, int gradings) const {
  std::vector<PanelMesh> first;
  for (const PanelMesh& mesh : mesh_) first.push_back(first_mesh(mesh, water_, highest, gradings));
  return std::unique_ptr<const Discretisation>(new HullArray(*this, std::move(first)));
}

void HullArray::require_short_panels(double highest) const {
  for (const PanelMesh& mesh : mesh_) panels::require_short_panels(mesh, water_, highest);
}

double HullArray::length() const {
  double area = 0;
  for (const std::size_t kind : places_->kind_of) area += wet_area(mesh_[kind]);
  return std::sqrt(area / static_cast<double>(places_->kind_of.size()));
}

void HullArray::describe(SelfCheck& check) const {
  check.panels = check.lid_panels = 0;
  check.planes_of_symmetry = 2;
  for (const std::size_t kind : places_->kind_of) {
    check.panels += mesh_[kind].hull_panels();
    check.lid_panels += mesh_[kind].lid_panels();
    check.planes_of_symmetry = std::min(check.planes_of_symmetry, static_cast<int>(mesh_[kind].images.size()) / 2);
  }
  check.kinds = static_cast<int>(mesh_.size());
}

namespace {

/// What panels take of one frequency: each kind once, its partial waves in place of headings.
Cost cost_of_kinds(const std::vector<PanelMesh>& mesh, std::size_t channels, bool deep) {
  Cost sum{};
  for (const PanelMesh& m : mesh) {
    const Cost one = cost_of(m, 1, 1, channels, 1, 0);  // one frequency and two limits
    sum.unknowns = std::max(sum.unknowns, one.unknowns);
    sum.systems = std::max(sum.systems, one.systems);
    sum.bytes += one.bytes;
    sum.seconds += one.seconds / 3 * (deep ? 2 : 1);  // Rankine's parts again in each depth, about as much as waves
  }
  return sum;
}

}  // namespace

Cost HullArray::cost(const std::vector<double>& omega, std::size_t headings, int threads, int refined) const {
  Cost out{};
  out.frequencies = static_cast<int>(omega.size());
  const auto fine = frequencies_to_refine(omega.size(), refined);
  std::vector<PanelMesh> cut;
  for (const PanelMesh& m : mesh_)
    if (!fine.empty()) cut.push_back(panels::refined(m));
  const auto columns = static_cast<double>(solved_motions(*places_, mesh_).columns().size() + headings);
  for (std::size_t i = 0; i < omega.size(); ++i) {
    const PartialWaves waves = partial_waves(*places_, water_, omega[i], threshold_);
    const auto between = cylinders::equations_cost(
        cylinders::each_alone(waves.channels, waves.modes, places_->circle), places_->circle.size(),
        places_->lattice ? &*places_->lattice : nullptr, columns, cylinders::Equations::automatic);
    const auto channels = static_cast<std::size_t>(waves.channels.count());
    const auto add = [&](const std::vector<PanelMesh>& mesh) {
      const Cost kinds = cost_of_kinds(mesh, channels, water_.depth.is_infinite());
      out.seconds += kinds.seconds + between.work * multiplication_seconds;
      out.bytes = std::max(out.bytes, kinds.bytes + between.bytes);
      return kinds;
    };
    const Cost kinds = add(mesh_);
    out.unknowns = kinds.unknowns;
    out.systems = kinds.systems;
    out.partial_waves = std::max(out.partial_waves, waves.channels.count());
    if (std::find(fine.begin(), fine.end(), i) != fine.end()) out.refined_unknowns = add(cut).unknowns;
  }
  const int at_a_time = potential::thread_count(threads, omega.size() + fine.size());
  out.bytes *= at_a_time;
  out.seconds /= at_a_time;
  for (const std::size_t kind : places_->kind_of) out.panels += mesh_[kind].hull_panels();
  return out;
}

}  // namespace hydro::panels
