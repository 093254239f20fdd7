#include "dynamics/frequency/periodic_model.hpp"

#include <algorithm>

#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/radiation/state_space.hpp"
#include "reduction.hpp"

namespace dynamics::frequency {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// \throws hydro::InputError naming what has no place in a periodic answer
void require_smooth(const Model& model, const Workspace& workspace) {
  for (std::size_t k = 0; k < model.forces().size(); ++k) {
    const ForceKind& kind = *model.forces()[k];
    if (kind.friction() != nullptr || kind.contact() != nullptr)
      throw hydro::InputError(
          fmt::format("periodic motions take loads that are functions of motion: {} is set-valued", kind.effect()), {},
          "leave it out, or step the scene with `froude run`");
    if (workspace.needs_memory(k))
      throw hydro::InputError(
          fmt::format("periodic motions take loads that are functions of motion: {} has a memory of its own",
                      kind.effect()),
          {}, "leave it out, or step the scene with `froude run`");
  }
  if (model.joints().are_prescribed())
    throw hydro::InputError("periodic motions have no place for prescribed motions of joints", {},
                            "leave them out, or step the scene with `froude run`");
  for (const RigidBody& body : model.bodies())
    if (body.is_free(3) + body.is_free(4) + body.is_free(5) == 2)
      throw hydro::InputError(
          fmt::format("body \"{}\" may turn about two axes of three: what is held then depends on the way there",
                      body.name()),
          {}, "free or hold the third rotation too");
}

/// ω = J φ̇ and what of the acceleration φ̇ makes alone, J̇ φ̇ (D1).
MatrixXd velocity_by_displacement(const VectorXd& displacement) {
  MatrixXd J = MatrixXd::Identity(displacement.size(), displacement.size());
  for (Index row = 3; row < displacement.size(); row += 6)
    J.block<3, 3>(row, row) = left_jacobian(displacement.segment<3>(row));
  return J;
}
VectorXd acceleration_of_rates(const VectorXd& displacement, const VectorXd& rate, const MatrixXd& J) {
  VectorXd out = VectorXd::Zero(rate.size());
  for (Index row = 3; row < rate.size(); row += 6) {
    const Eigen::Vector3d phi = displacement.segment<3>(row), phi_rate = rate.segment<3>(row);
    const Eigen::Matrix3d block = J.block<3, 3>(row, row);
    // d/dt of J⁻¹(φ) ω = J⁻ᵀ(−φ) ω, ω held, is minus the derivative below times φ̇.
    out.segment<3>(row) = block * left_jacobian_inverse_transpose_derivative(-phi, block * phi_rate) * phi_rate;
  }
  return out;
}

/// M a + gyro of the model's equations (D8).
VectorXd inertial_forces(const Model& model, const State& state, const VectorXd& acceleration) {
  VectorXd out = model.mass_times(state, acceleration);
  const VectorXd momentum = model.dry_mass(state) * state.velocity;
  for (Index row = 3; row < out.size(); row += 6)
    out.segment<3>(row) += state.velocity.segment<3>(row).cross(momentum.segment<3>(row));
  return out;
}

/// A, B, C of all groups side by side.
void append(MatrixXd& whole, const MatrixXd& part) {
  const Index rows = whole.rows(), columns = whole.cols();
  whole.conservativeResize(rows + part.rows(), columns + part.cols());
  whole.rightCols(part.cols()).setZero();
  whole.bottomRows(part.rows()).setZero();
  whole.bottomRightCorner(part.rows(), part.cols()) = part;
}

PeriodicMemory memory_of(const std::vector<RadiatingModes>& groups) {
  PeriodicMemory out;
  for (const RadiatingModes& g : groups) {
    const auto [A, B, C] = hydro::radiation::state_space(g.poles);
    append(out.A, A), append(out.B, B), append(out.C, C);
  }
  out.transform = [groups](double omega) {
    Eigen::MatrixXcd K(0, 0);
    for (const RadiatingModes& g : groups) {
      const Eigen::MatrixXcd part = g.poles.transform(omega);
      const Index at = K.rows();
      K.conservativeResize(at + part.rows(), at + part.rows());
      K.rightCols(part.cols()).setZero();
      K.bottomRows(part.rows()).setZero();
      K.bottomRightCorner(part.rows(), part.cols()) = part;
    }
    return K;
  };
  return out;
}

}  // namespace

PeriodicModel::PeriodicModel(const Model& model, const SmallMotions& about,
                             const std::vector<RadiatingModes>& radiation, double omega)
    : model_(model), rest_(about.still), omega_(omega), workspace_(model, about.still) {
  require_smooth(model, workspace_);
  for (auto& memory : workspace_.memory) memory.reset();  // motions that are tried follow from no step before
  const Reduction left(about);
  basis_ = left.expanded(MatrixXd(MatrixXd::Identity(left.count(), left.count())));
  const MatrixXd metric = about.mass.diagonal().asDiagonal() * basis_;
  basis_ *= (basis_.transpose() * metric).diagonal().cwiseSqrt().cwiseInverse().asDiagonal();
  inverse_ = basis_.transpose() * about.mass.diagonal().asDiagonal();
  for (int m = 0; m < model.modes(); ++m)
    if (model.is_free(m)) free_.push_back(m);
  for (const RadiatingModes& g : radiation) radiating_.insert(radiating_.end(), g.modes.begin(), g.modes.end());
  memory_ = memory_of(radiation);
  step_ = 1e-5 * basis_.cwiseAbs().colwise().maxCoeff().cwiseInverse().transpose();  // 10 µm or 10 µrad
}

VectorXd PeriodicModel::expanded(const VectorXd& free) const {
  VectorXd out = VectorXd::Zero(basis_.rows());
  out(free_) = free;
  return out;
}

PeriodicModel::Closed PeriodicModel::placed(VectorXd displacement) const {
  const JointSet& joints = model_.joints();
  const Index n = size(), m = joints.count();
  Closed out;
  move(rest_, displacement, out.state);
  out.J = velocity_by_displacement(displacement);
  out.G = joints.dense(joints.gradients(out.state));
  MatrixXd S(n + m, static_cast<Index>(free_.size()));
  S.topRows(n) = inverse_(Eigen::all, free_);
  S.bottomRows(m) = (out.G * out.J)(Eigen::all, free_);
  out.square.emplace(S);
  out.displacement = std::move(displacement);
  return out;
}

void PeriodicModel::find_derivatives(Closed& at) const {
  const Index n = size(), m = model_.joints().count();
  at.by_y.resize(basis_.rows(), n);
  for (Index k = 0; k < n; ++k) at.by_y.col(k) = expanded(at.square->solve(VectorXd::Unit(n + m, k)));
  at.by_coordinate = at.J * at.by_y;
}

// (Q13)
PeriodicModel::Closed PeriodicModel::closed(const VectorXd& value, VectorXd displacement) const {
  const JointSet& joints = model_.joints();
  VectorXd right(size() + joints.count());
  // J, G and S are those before the last change (m, rad), and what is left is its square.
  constexpr double rounding = 1e-10;
  constexpr int most = 20;
  for (int i = 0;; ++i) {
    Closed here = placed(std::move(displacement));
    right << value - inverse_ * here.displacement, -joints.values(here.state);
    const VectorXd change = here.square->solve(right);
    if (!change.allFinite() || i == most)
      throw hydro::NumericsError("joints cannot be closed in a periodic motion that is tried");
    displacement = here.displacement + expanded(change);
    if (change.cwiseAbs().maxCoeff() > rounding) continue;
    move(rest_, displacement, here.state);
    here.displacement = std::move(displacement);
    find_derivatives(here);
    return here;
  }
}

const PeriodicModel::Closed& PeriodicModel::place_of(const CoordinateMotion& motion) {
  constexpr std::size_t most = 1024;
  auto at = std::lower_bound(asked_.begin(), asked_.end(), motion.time,
                             [](const Asked& a, double time) { return a.time < time; });
  if (at != asked_.end() && at->time == motion.time) {
    if (at->value != motion.value) {
      const VectorXd near = at->place->displacement + at->place->by_y * (motion.value - at->value);
      at->place = std::make_unique<const Closed>(closed(motion.value, near));
      at->value = motion.value;
    }
    return *at->place;
  }
  auto place = std::make_unique<const Closed>(closed(motion.value, basis_ * motion.value));
  if (asked_.size() >= most) asked_.clear(), at = asked_.end();
  return *asked_.insert(at, {motion.time, motion.value, std::move(place)})->place;
}

PeriodicModel::Bodies PeriodicModel::moving(const Closed& at, const CoordinateMotion& motion) const {
  const JointSet& joints = model_.joints();
  const Index n = size(), m = joints.count();
  Bodies out{at.state, {}, at.by_coordinate};
  const VectorXd rate = at.by_y * motion.rate, bent = acceleration_of_rates(at.displacement, rate, at.J);
  out.state.velocity = at.J * rate;
  out.state.time = motion.time;
  VectorXd right(n + m);
  right << motion.acceleration, -joints.convective(out.state) - at.G * bent;
  out.acceleration = at.J * expanded(at.square->solve(right)) + bent;
  return out;
}

PeriodicModel::Bodies PeriodicModel::bodies(const CoordinateMotion& motion) { return moving(place_of(motion), motion); }

VectorXd PeriodicModel::residual(const Bodies& b, const VectorXd& load) {
  VectorXd out = model_.residual(b.state, b.acceleration, workspace_);
  for (std::size_t i = 0; i < radiating_.size(); ++i) out[radiating_[i]] -= load[static_cast<Index>(i)];
  return out;
}

VectorXd PeriodicModel::memory_velocity(const CoordinateMotion& motion) {
  const Closed& at = place_of(motion);
  return (at.J * (at.by_y * motion.rate))(radiating_);
}

VectorXd PeriodicModel::multipliers(const Bodies& b, const VectorXd& load) {
  const JointSet& joints = model_.joints();
  if (joints.count() == 0) return VectorXd(0);
  const MatrixXd G = joints.dense(joints.gradients(b.state));
  return hydro::dense::PivotedQr(G.transpose()).solve(-residual(b, load));
}

VectorXd PeriodicModel::residual_at(const CoordinateMotion& motion, const VectorXd& load) {
  const Bodies here = moving(place_of(motion), motion);
  return here.by_coordinate.transpose() * residual(here, load);
}

PeriodicSample PeriodicModel::at(const CoordinateMotion& motion, const VectorXd& load) {
  return sample(motion, load, true);
}

PeriodicSample PeriodicModel::roughly_at(const CoordinateMotion& motion, const VectorXd& load) {
  return sample(motion, load, false);
}

MatrixXd PeriodicModel::load_slope(const State& state, double by_displacement, double by_velocity) {
  BlockMatrix out(model_.pattern());
  JacobianSink sink(out, by_displacement, by_velocity);
  for (std::size_t k = 0; k < model_.forces().size(); ++k)
    model_.forces()[k]->add_jacobian(workspace_.instant(state, k), sink);
  return out.dense();
}

PeriodicSample PeriodicModel::sample(const CoordinateMotion& motion, const VectorXd& load, bool central) {
  const Index n = size(), m = static_cast<Index>(radiating_.size());
  const Closed& place = place_of(motion);
  const Bodies here = moving(place, motion);
  const MatrixXd& N = here.by_coordinate;
  PeriodicSample out{.residual = N.transpose() * residual(here, load),
                     .by_value = MatrixXd(n, n),
                     .by_rate = MatrixXd(n, n),
                     .by_acceleration = MatrixXd(n, n),
                     .by_load = -N(radiating_, Eigen::all).transpose(),
                     .velocity_by_value = MatrixXd(m, n),
                     .velocity_by_rate = N(radiating_, Eigen::all)};
  VectorXd loads = workspace_.load;
  for (Index i = 0; i < m; ++i) loads[radiating_[static_cast<std::size_t>(i)]] += load[i];
  // Loads vary by their own derivatives, all else, which costs little, by differences: inertia, and what joints make of
  // coordinates.
  const MatrixXd by_displacement = load_slope(here.state, 1, 0) * N, slope = load_slope(here.state, 0, 1);
  const auto unloaded = [&](const Bodies& b) {
    return VectorXd(b.by_coordinate.transpose() * (inertial_forces(model_, b.state, b.acceleration) - loads));
  };
  const VectorXd still = central ? VectorXd() : unloaded(here);
  for (Index k = 0; k < n; ++k) {
    out.by_acceleration.col(k) = N.transpose() * model_.mass_times(here.state, N.col(k));
    // Beside it joints are open by the square of the step, to both sides alike.
    const auto beside = [&](double h) {
      Closed moved = placed(place.displacement + h * place.by_y.col(k));
      find_derivatives(moved);
      return moving(moved, motion);
    };
    const auto faster = [&](double h) {
      CoordinateMotion moved = motion;
      moved.rate[k] += h;
      return unloaded(moving(place, moved));
    };
    // By rates it is a square: no step is too long.
    const double h = step_[k], rate = 1e3 * h * omega_, width = central ? 2 * h : h;
    const Bodies above = beside(h), below = central ? beside(-h) : here;
    const VectorXd velocity = (above.state.velocity - below.state.velocity) / width;
    out.velocity_by_value.col(k) = velocity(radiating_);
    out.by_value.col(k) = (unloaded(above) - (central ? unloaded(below) : still)) / width +
                          N.transpose() * (by_displacement.col(k) + slope * velocity);
    out.by_rate.col(k) = (faster(rate) - faster(-rate)) / (2 * rate);
  }
  out.by_rate += N.transpose() * slope * N;
  return out;
}

}  // namespace dynamics::frequency
