#include "dynamics/line/equilibrium.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

#include "equations.hpp"
#include "hydro/base/error.hpp"
#include "network_shape.hpp"

namespace dynamics::line {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// One span: what (D85) needs.
struct Span {
  int first, last;   // nodes
  Vector3d between;  // from first to last
};

/// φ of (D85) with |F| rounded off by `soft`, its gradient and curvature.
struct Potential {
  double value;
  Vector3d gradient;
  Matrix3d curvature;
};

Potential potential(const Line& line, const Span& span, const Vector3d& first_pull, double soft) {
  Potential p{-first_pull.dot(span.between), -span.between, Matrix3d::Zero()};
  Vector3d F = first_pull;
  for (int j = span.first; j < span.last; ++j) {
    if (j > span.first) F -= line.constant_load().col(j);
    const Segment& s = line.segment(j);
    const double size = std::sqrt(F.squaredNorm() + soft * soft);
    const Vector3d t = size > 0 ? Vector3d(F / size) : Vector3d::Zero();
    const double compliance = s.is_inextensible() ? 0 : 1 / s.axial_stiffness;
    p.value += s.length * (size + compliance / 2 * F.squaredNorm());
    p.gradient += s.length * (t + compliance * F);
    if (size > 0) p.curvature += s.length * ((Matrix3d::Identity() - t * t.transpose()) / size);
    p.curvature += s.length * compliance * Matrix3d::Identity();
  }
  return p;
}

/// Newton on the convex φ, with as much of each correction as brings it down.
void descend(const Line& line, const Span& span, double soft, double length, Vector3d& pull) {
  constexpr int most = 60;
  for (int i = 0; i < most; ++i) {
    const Potential now = potential(line, span, pull, soft);
    if (now.gradient.norm() <= 4e-16 * length) return;
    Matrix3d curvature = now.curvature;
    curvature.diagonal().array() += 1e-13 * curvature.trace();
    const Vector3d step = -curvature.ldlt().solve(now.gradient);
    double share = 1;
    for (int cut = 0; cut < 40; ++cut, share /= 2)
      if (potential(line, span, pull + share * step, soft).value <= now.value + 0.25 * share * now.gradient.dot(step))
        break;
    // Near the bottom the value no longer tells; the gradient does.
    if (share < 1 && potential(line, span, pull + step, soft).gradient.norm() < now.gradient.norm()) share = 1;
    pull += share * step;
    if (share * step.norm() <= 1e-15 * pull.norm()) return;
  }
}

/// Where some segment must be pressed, both legs stand apart: a way out of the straight line that no correction leaves.
void spread(const Span& span, const Vector3d& load, double length, State& state) {
  const Vector3d down = load.normalized();
  Vector3d aside = span.between - down * down.dot(span.between);
  if (aside.norm() < 1e-6 * length) aside = down.unitOrthogonal();
  aside.normalize();
  const double way = 2 * std::numbers::pi / (span.last - span.first);
  for (int i = span.first + 1; i < span.last; ++i)
    state.position.col(i) -= 0.02 * length * std::sin(way * (i - span.first)) * aside;
}

void hang(const Line& line, const Span& span, State& state) {
  double length = 0, load = 0, longest = 0;
  for (int j = span.first; j < span.last; ++j) {
    const Segment& s = line.segment(j);
    length += s.length;
    longest += s.is_inextensible() ? s.length : std::numeric_limits<double>::infinity();
    if (j > span.first) load += line.constant_load().col(j).norm();
  }
  const double way = span.between.norm();
  constexpr double rounding = 1e-12;  // of places: as much as a balance closes
  const double extent = state.position.col(span.first).cwiseAbs().maxCoeff() + way;
  if (way > longest + rounding * extent)
    throw hydro::InputError(
        fmt::format("nodes {} and {} of the line are held {:.6g} m apart, {:.6g} m more than the {:.6g} m between them",
                    span.first, span.last, way, way - longest, longest),
        {}, "bring them together, lengthen the line, or give it an axial stiffness");
  if (load == 0) load = 1;  // N: a line without weight has no scale of its own
  Vector3d sum = Vector3d::Zero();
  for (int i = span.first + 1; i < span.last; ++i) sum += line.constant_load().col(i);
  Vector3d pull = sum / 2 + load * span.between / length;
  for (double soft = load; soft > 1e-14 * load; soft /= 8) descend(line, span, soft, length, pull);
  const Vector3d soft_pull = pull;
  descend(line, span, 0, length, pull);
  if (!pull.allFinite() || potential(line, span, pull, 0).gradient.norm() > 1e-9 * length) pull = soft_pull;
  Vector3d F = pull, open = Vector3d::Zero();
  for (int j = span.first; j < span.last; ++j) {
    if (j > span.first) F -= line.constant_load().col(j);
    const Segment& s = line.segment(j);
    const double compliance = s.is_inextensible() ? 0 : 1 / s.axial_stiffness;
    const Vector3d t = F.norm() > 0 ? F.normalized() : Vector3d::UnitX();
    state.tension[j] = F.norm();
    if (j + 1 < span.last)
      state.position.col(j + 1) = state.position.col(j) + s.length * (t + compliance * F);
    else
      open = state.position.col(j) + s.length * (t + compliance * F) - state.position.col(span.last);
  }
  if (open.norm() > 1e-9 * length) spread(span, sum, length, state);
}

/// What is beyond the outermost held node pulls with all that hangs on it.
void hang_free(const Line& line, int from, int towards, State& state) {
  const int side = towards > from ? 1 : -1;
  Vector3d F = Vector3d::Zero();
  for (int i = towards; i != from; i -= side) F += line.constant_load().col(i);
  for (int i = from; i != towards; i += side) {
    const int j = side > 0 ? i : i - 1;
    const Segment& s = line.segment(j);
    const double compliance = s.is_inextensible() ? 0 : 1 / s.axial_stiffness;
    const Vector3d t = F.norm() > 0 ? F.normalized() : Vector3d(-Vector3d::UnitZ());
    state.position.col(i + side) = state.position.col(i) + s.length * (t + compliance * F);
    state.tension[j] = F.norm();
    F -= line.constant_load().col(i + side);
  }
}

}  // namespace

State hanging_shape(const Line& line, const State& places) {
  if (line.chains() > 1 || line.is_network() || line.has_bobs()) return network_shape(line, places);
  State state = places;
  state.velocity = Places::Zero(3, line.nodes());
  state.tension = VectorXd::Zero(line.segments());
  int before = -1, last = -1;
  for (int i = 0; i < line.nodes(); ++i) {
    if (line.held(i) == nullptr) continue;
    if (before < 0)
      hang_free(line, i, 0, state);
    else
      hang(line, {before, i, state.position.col(i) - state.position.col(before)}, state);
    before = last = i;
  }
  hydro::require(last >= 0, "nothing holds the line, so it has no shape to hang in");
  hang_free(line, last, line.nodes() - 1, state);
  return state;
}

namespace {

/// Balance without velocities, by places alone.
Stage resting(const State& at) {
  const Places nothing = Places::Zero(3, at.position.cols());
  return {.t = at.time,
          .end = at.time,
          .h = 0,
          .x_by = 1,
          .v_by = 0,
          .a_by = 0,
          .v_from = nothing,
          .a_from = nothing,
          .still = true,
          .rounding = 1e-12};
}

}  // namespace

Response pulls_at_rest(const Line& line, const State& rest, const std::vector<int>& prescribed) {
  Equations equations(line);
  Stage stage = resting(rest);
  Places u = Places::Zero(3, line.nodes());
  VectorXd T = rest.tension;
  equations.solve(stage, rest, 1e-10, 30, u, T);  // sets the scale; what is left over is rounding
  return equations.response(stage, rest, Places::Zero(3, line.nodes()), rest.tension, prescribed, 0);
}

State equilibrium(const Line& line, const State& guess, RestReport* report) {
  Equations equations(line);
  RestReport sink;
  RestReport& took = report != nullptr ? *report : sink;
  const Places nothing = Places::Zero(3, line.nodes());
  State state = guess;
  state.velocity = nothing;
  Stage stage = resting(guess);
  double hardest = 0, shortest = std::numeric_limits<double>::infinity();
  for (int j = 0; j < line.segments(); ++j) shortest = std::min(shortest, line.segment(j).length);
  for (int i = 0; i < line.nodes(); ++i) hardest = std::max(hardest, line.constant_load().col(i).norm());
  hardest = std::max(hardest, state.tension.cwiseAbs().maxCoeff()) / shortest;
  hardest = std::max(hardest, line.hardest_bending());
  if (hardest == 0) hardest = 1;
  constexpr int most = 400, iterations = 30;
  Equations::Outcome outcome;
  double relax = hardest;
  for (took.steps = 1; took.steps <= most; ++took.steps) {
    stage.relax = relax > 1e-9 * hardest ? relax : 0;
    Places u = nothing;
    VectorXd T = state.tension;
    outcome = equations.solve(stage, state, 1e-10, iterations, u, T);
    took.newton_iterations += outcome.iterations;
    // Where nothing resists at all (slack line on a bed), it is enough that nothing moves any more.
    const bool stays = u.cwiseAbs().maxCoeff() <= 1e-12 * line.length();
    if (!outcome.converged && stage.relax == 0 && relax < 1e-12 * hardest) break;
    if (!outcome.converged) {
      relax *= stage.relax == 0 ? 100 : 8;
      if (relax > 1e12 * hardest) break;
      continue;
    }
    state.position += u;
    state.tension = T;
    if (stage.relax == 0 || (stays && relax < 1e-6 * hardest)) return state;
    relax /= outcome.iterations < 8 ? 10 : 3;
  }
  throw hydro::NumericsError(fmt::format("the line finds no rest: {}; node {} is worst", outcome.why, outcome.worst));
}

}  // namespace dynamics::line
