#include "dynamics/line/equilibrium.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <optional>
#include <random>

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

/// Largest force that acts on a node or in a segment, over the shortest length, N/m: of what resists a step first.
double hardest_of(const Line& line, const State& guess) {
  double hardest = 0, shortest = std::numeric_limits<double>::infinity();
  for (int j = 0; j < line.segments(); ++j) shortest = std::min(shortest, line.segment(j).length);
  for (int i = 0; i < line.nodes(); ++i) hardest = std::max(hardest, line.constant_load().col(i).norm());
  hardest = std::max(hardest, guess.tension.cwiseAbs().maxCoeff()) / shortest;
  hardest = std::max(hardest, line.hardest_bending());
  return hardest > 0 ? hardest : 1;
}

}  // namespace

Response pulls_at_rest(const Line& line, const State& rest, const std::vector<int>& prescribed) {
  // What turns or slides without any resistance, as a loop does whose ends are above one another, does not change the
  // pulls; this much of one keeps its rounding out of them.
  constexpr double resistance = 1e-9;
  Equations equations(line);
  Stage stage = resting(rest);
  stage.relax = resistance * hardest_of(line, rest);
  Places u = Places::Zero(3, line.nodes());
  VectorXd T = rest.tension;
  equations.solve(stage, rest, 1e-10, 30, u, T);  // sets the scale; what is left over is rounding
  return equations.response(stage, rest, Places::Zero(3, line.nodes()), rest.tension, prescribed, 0);
}

namespace {

/// Moves free nodes by up to `size` along and up, always the same ways: what stands on its head does not fall by
/// itself. `across`: out of the plane y = 0 too.
void disturb(const Line& line, double size, bool across, Places& x) {
  std::minstd_rand random(1);
  for (int i = 0; i < line.nodes(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double share = 2.0 * static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max()) - 1;
      if (line.held(i) == nullptr && (c != 1 || across)) x(c, i) += size * share;
    }
  for (int i = 0; i < line.nodes(); ++i) x.col(i) = x.col(line.same_as(i));
}

/// What is between nodes `a` and `b`, turned about the way between them until it is level.
void lay_between(int a, int b, Places& x) {
  const Vector3d way = x.col(b) - x.col(a);
  const double level = way.head<2>().norm();
  const Vector3d axis = level > 1e-9 * way.norm() ? Vector3d(way.normalized()) : Vector3d::UnitX();
  for (int i = a + 1; i < b; ++i) {
    const Vector3d from = x.col(i) - x.col(a), along = axis * axis.dot(from);
    x.col(i) = x.col(a) + along + axis.cross(from - along);
  }
}

/// What is between node `a` and an end that is free, turned until it is level.
void lay_end(int a, int end, Places& x) {
  const int side = end > a ? 1 : -1;
  const Places old = x;
  for (int i = a; i != end; i += side) {
    const Vector3d link = old.col(i + side) - old.col(i);
    const double level = link.head<2>().norm();
    const Vector3d towards =
        level > 1e-9 * link.norm() ? Vector3d(link.x() / level, link.y() / level, 0) : Vector3d::UnitX();
    x.col(i + side) = x.col(i) + link.norm() * towards;
  }
}

/// Turns each stretch of free nodes that are `beyond` the bed or the surface until it is level, its links as long as
/// they are: pushed back where they stand they would fold up.
template <class Beyond>
void lay(const Line& line, const Beyond& beyond, Places& x) {
  const auto turns = [&](int i) { return line.held(i) == nullptr && line.tie(i) < 0 && beyond(i); };
  for (int c = 0; c < line.chains(); ++c) {
    const int first = line.first_of_chain(c), last = line.last_of_chain(c);
    for (int i = first; i <= last; ++i) {
      if (!turns(i)) continue;
      const int a = i - 1;
      while (i <= last && turns(i)) ++i;
      if (a >= first && i <= last)
        lay_between(a, i, x);
      else if (a >= first)
        lay_end(a, last, x);
      else if (i <= last)
        lay_end(i, first, x);
    }
  }
}

/// Where a line is near to a shape that stays: what hangs through the bed lies on it, and what water lifts in part
/// hangs up from where it is held, as far as the surface, and lies there.
State laid(const Line& line, const State& guess) {
  State out = guess;
  const Surroundings& water = line.description().water;
  if (water.buoyancy && water.wet == Wet::below_surface && !line.bends()) {
    Description lifted = line.description();
    lifted.water.wet = Wet::all;
    out = hanging_shape(Line(std::move(lifted)), guess);
  }
  Places& x = out.position;
  if (!line.description().bed.empty()) {
    const double bed = line.description().bed.front().z;
    lay(
        line, [&](int i) { return line.bed_area(i) > 0 && x(2, i) < bed; }, x);
  }
  if (water.wet == Wet::below_surface || line.has_bobs())
    lay(
        line, [&](int i) { return x(2, i) > 0; }, x);
  return out;
}

/// The same with segments that are straight.
Line straightened(const Line& line) {
  Description d = line.description();
  for (Segment& s : d.segments) s.catenary = false;
  return Line(std::move(d));
}

/// Steps towards rest, each to where the line's energy with what resists the step is least. (D86), (D157)
class Descent {
 public:
  Descent(const Line& line, const State& guess, RestReport& took)
      : line_(line),
        equations_(line),
        took_(took),
        state_(guess),
        stage_(resting(guess)),
        nothing_(Places::Zero(3, line.nodes())),
        hardest_(hardest_of(line, guess)),
        relax_(hardest_) {
    state_.velocity = nothing_;
  }

  /// Nothing if links are pressed on the way that could give way, or it leads nowhere.
  std::optional<State> rest_at_once() {
    for (int i = 0; i < most; ++i) {
      const Step step = this->step();
      if (step == Step::done) return state_;
      if (step == Step::unstable || step == Step::lost) break;
    }
    return std::nullopt;
  }

  State rest() {
    for (int i = 0; i < most; ++i) {
      const Step step = this->step();
      if (step == Step::done) return state_;
      if (step == Step::lost) break;
    }
    if (why_.empty()) why_ = fmt::format("it still moves after {} steps towards rest", most);
    throw hydro::NumericsError(fmt::format("the line finds no rest: {}; node {} is worst", why_, outcome_.worst));
  }

 private:
  enum class Step { taken, shorter, unstable, done, lost };
  static constexpr int most = 1000;

  Step step() {
    constexpr int iterations = 30;
    ++took_.steps;
    stage_.relax = relax_ > 1e-9 * hardest_ ? relax_ : 0;
    Places u = nothing_;
    VectorXd T = state_.tension;
    outcome_ = equations_.solve(stage_, state_, 1e-10, iterations, u, T);
    took_.newton_iterations += outcome_.iterations;
    // Where nothing resists at all (slack line on a bed), it is enough that nothing moves any more.
    const bool stays = u.cwiseAbs().maxCoeff() <= 1e-12 * line_.length();
    if (!outcome_.converged) {
      why_ = outcome_.why;
      return harder(stage_.relax == 0 ? 100 : 8, Step::shorter);
    }
    if (!equations_.is_least(stage_, state_, u, T, 1e-6 * hardest_)) {
      why_ = "its links are pressed where they would give way";
      if (u.cwiseAbs().maxCoeff() <= 1e-6 * line_.length())
        disturb(line_, 1e-4 * line_.length() / line_.segments(), ++disturbed_ > 2, state_.position);
      return harder(2, Step::unstable);
    }
    why_.clear();
    state_.position += u;
    state_.tension = T;
    if (stage_.relax == 0 || (stays && relax_ < 1e-6 * hardest_)) return Step::done;
    relax_ /= outcome_.iterations < 8 ? eager_ : std::min(eager_, 3.0);
    eager_ = std::min(10.0, 1.5 * eager_);
    return Step::taken;
  }

  /// The next step is shorter, and those after it grow more slowly for a while.
  Step harder(double by, Step step) {
    if (stage_.relax == 0 && relax_ < 1e-12 * hardest_) return Step::lost;
    relax_ *= by;
    eager_ = 1.5;
    return relax_ > 1e12 * hardest_ ? Step::lost : step;
  }

  const Line& line_;
  Equations equations_;
  RestReport& took_;
  State state_;
  Stage stage_;
  const Places nothing_;
  const double hardest_;
  double relax_, eager_ = 10;
  int disturbed_ = 0;
  Equations::Outcome outcome_;
  std::string why_;
};

}  // namespace

State equilibrium(const Line& line, const State& guess, RestReport* report) {
  RestReport sink;
  RestReport& took = report != nullptr ? *report : sink;
  took = {};
  if (const auto found = Descent(line, guess, took).rest_at_once()) return *found;
  State near = laid(line, guess);
  // Slack segments that hang through are too soft to be led anywhere.
  bool catenary = false;
  for (int j = 0; j < line.segments(); ++j) catenary = catenary || line.segment(j).catenary;
  if (catenary) {
    const Line straight = straightened(line);
    near = Descent(straight, near, took).rest();
  }
  return Descent(line, near, took).rest();
}

}  // namespace dynamics::line
