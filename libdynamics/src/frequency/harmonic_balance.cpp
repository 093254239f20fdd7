#include "dynamics/frequency/harmonic_balance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "dynamics/frequency/floquet.hpp"
#include "harmonics.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"

namespace dynamics::frequency {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// 1, cos ωt, sin ωt, cos 2ωt, … at one time, (2H + 1), and derivatives.
struct Harmonics {
  VectorXd value, rate, acceleration;

  Harmonics(Index H, double omega, double t) : value(2 * H + 1), rate(2 * H + 1), acceleration(2 * H + 1) {
    value[0] = 1;
    rate[0] = acceleration[0] = 0;
    for (Index h = 1; h <= H; ++h) {
      const double w = static_cast<double>(h) * omega, c = std::cos(w * t), s = std::sin(w * t);
      value.segment<2>(2 * h - 1) << c, s;
      rate.segment<2>(2 * h - 1) << -w * s, w * c;
      acceleration.segment<2>(2 * h - 1) << -w * w * c, -w * w * s;
    }
  }
  CoordinateMotion times(const MatrixXd& coefficients, double t) const {
    return {t, coefficients * value, coefficients * rate, coefficients * acceleration};
  }
};

/// Harmonics at equal times over a period: four times as many as they are, so that products of three do not alias.
class Samples {
 public:
  Samples(Index H, double omega) : omega_(omega), columns_(2 * H + 1) {
    const Index count = 4 * (H + 1);
    for (Index j = 0; j < count; ++j) at_.emplace_back(H, omega, time_of(j, count));
  }
  std::size_t count() const { return at_.size(); }
  Index columns() const { return columns_; }
  Index harmonics() const { return columns_ / 2; }
  double omega() const { return omega_; }
  const Harmonics& operator[](std::size_t j) const { return at_[j]; }
  double time(std::size_t j) const { return time_of(static_cast<Index>(j), static_cast<Index>(count())); }
  /// What a sample has of each coefficient's integral: coefficients are Σ_j weight(j) x_jᵀ.
  VectorXd weight(std::size_t j) const {
    VectorXd out = at_[j].value * (2.0 / static_cast<double>(count()));
    out[0] /= 2;
    return out;
  }

 private:
  double time_of(Index j, Index count) const {
    return 2 * std::numbers::pi / omega_ * static_cast<double>(j) / static_cast<double>(count);
  }
  double omega_;
  Index columns_;
  std::vector<Harmonics> at_;
};

/// Coefficients of F by those of w, rows (m) of each harmonic one below the other: F = −Re(K̂ (w_c − i w_s) e^{iωt}).
MatrixXd memory_load(const PeriodicMemory& memory, double omega, const MatrixXd& w, Index m) {
  MatrixXd F(w.rows(), w.cols());
  F.topRows(m) = -memory.transform(0).real() * w.topRows(m);
  for (Index row = m, h = 1; row < w.rows(); row += 2 * m, ++h) {
    const Eigen::MatrixXcd K = memory.transform(static_cast<double>(h) * omega);
    const auto c = w.middleRows(row, m), s = w.middleRows(row + m, m);
    F.middleRows(row, m) = -K.real() * c - K.imag() * s;
    F.middleRows(row + m, m) = K.imag() * c - K.real() * s;
  }
  return F;
}

/// Coefficients one below the other, (rows of x · columns), of what is x_j at the samples.
void add_coefficients(const VectorXd& weight, const MatrixXd& x, MatrixXd& out) {
  for (Index k = 0; k < weight.size(); ++k) out.middleRows(k * x.rows(), x.rows()) += weight[k] * x;
}
/// Back: Σ_k e_k(t) of them.
MatrixXd value_of(const VectorXd& harmonics, const MatrixXd& coefficients) {
  const Index rows = coefficients.rows() / harmonics.size();
  MatrixXd out = MatrixXd::Zero(rows, coefficients.cols());
  for (Index k = 0; k < harmonics.size(); ++k) out += harmonics[k] * coefficients.middleRows(k * rows, rows);
  return out;
}
/// Variation of by_value δ + by_rate δ̇ with the coefficients of δ, (rows, n (2H + 1)).
MatrixXd spread(const Harmonics& e, const MatrixXd& by_value, const MatrixXd& by_rate) {
  MatrixXd out(by_value.rows(), by_value.cols() * e.value.size());
  for (Index k = 0; k < e.value.size(); ++k)
    out.middleCols(k * by_value.cols(), by_value.cols()) = e.value[k] * by_value + e.rate[k] * by_rate;
  return out;
}
void add_spread(const VectorXd& e, const MatrixXd& by, MatrixXd& out) {
  for (Index k = 0; k < e.size(); ++k) out.middleCols(k * by.cols(), by.cols()) += e[k] * by;
}

/// Coefficients of the load of the memory, (m, 2H + 1).
MatrixXd load(PeriodicSystem& system, const MatrixXd& Y, const Samples& samples) {
  const PeriodicMemory* memory = system.memory();
  if (memory == nullptr) return MatrixXd(0, samples.columns());
  const Index m = memory->B.cols();
  MatrixXd w = MatrixXd::Zero(m * samples.columns(), 1);
  for (std::size_t j = 0; j < samples.count(); ++j)
    add_coefficients(samples.weight(j), system.memory_velocity(samples[j].times(Y, samples.time(j))), w);
  return memory_load(*memory, samples.omega(), w, m).reshaped(m, samples.columns());
}

/// All samples of a motion, with the load of the memory that belongs to it.
struct Sampled {
  std::vector<PeriodicSample> at;
  Index memory_size = 0;  // m

  /// `sample`: how the system is asked, PeriodicSystem::at or roughly_at.
  Sampled(PeriodicSystem& system, const MatrixXd& Y, const Samples& samples,
          PeriodicSample (PeriodicSystem::*sample)(const CoordinateMotion&, const VectorXd&)) {
    const MatrixXd F = load(system, Y, samples);
    memory_size = F.rows();
    for (std::size_t j = 0; j < samples.count(); ++j)
      at.push_back((system.*sample)(samples[j].times(Y, samples.time(j)), F * samples[j].value));
  }
};

/// (Q10) and its derivative by the coefficients, column after column of Y.
struct BalanceEquations {
  VectorXd residual;
  MatrixXd jacobian;
};

BalanceEquations equations(PeriodicSystem& system, const MatrixXd& Y, const Samples& samples) {
  const Sampled sampled(system, Y, samples, &PeriodicSystem::roughly_at);
  const Index n = Y.rows(), all = n * samples.columns(), m = sampled.memory_size;
  MatrixXd load_by_Y;
  if (m > 0) {
    MatrixXd w = MatrixXd::Zero(m * samples.columns(), all);
    for (std::size_t j = 0; j < samples.count(); ++j) {
      const PeriodicSample& s = sampled.at[j];
      add_coefficients(samples.weight(j), spread(samples[j], s.velocity_by_value, s.velocity_by_rate), w);
    }
    load_by_Y = memory_load(*system.memory(), samples.omega(), w, m);
  }
  MatrixXd R = MatrixXd::Zero(all, 1), J = MatrixXd::Zero(all, all);
  for (std::size_t j = 0; j < samples.count(); ++j) {
    const PeriodicSample& s = sampled.at[j];
    MatrixXd by_Y = spread(samples[j], s.by_value, s.by_rate);
    add_spread(samples[j].acceleration, s.by_acceleration, by_Y);
    if (m > 0) by_Y += s.by_load * value_of(samples[j].value, load_by_Y);
    add_coefficients(samples.weight(j), s.residual, R);
    add_coefficients(samples.weight(j), by_Y, J);
  }
  return {R, J};
}

/// The residual alone.
VectorXd residual(PeriodicSystem& system, const MatrixXd& Y, const Samples& samples) {
  const MatrixXd F = load(system, Y, samples);
  MatrixXd R = MatrixXd::Zero(Y.size(), 1);
  for (std::size_t j = 0; j < samples.count(); ++j)
    add_coefficients(samples.weight(j), system.residual_at(samples[j].times(Y, samples.time(j)), F * samples[j].value),
                     R);
  return R;
}

/// What `of` gives of a system and a motion, empty where there is none, as of bodies whose joints cannot be closed.
template <class Of>
auto tried(Of of, PeriodicSystem& system, const MatrixXd& Y, const Samples& samples)
    -> std::optional<decltype(of(system, Y, samples))> {
  try {
    return of(system, Y, samples);
  } catch (const hydro::NumericsError&) {
    return std::nullopt;
  }
}

/// Steps with the derivatives that a step of the length `last` was taken with: each is shorter than the one before by
/// much the same share q, and what is left after one of length s is s q/(1 − q). True once that is `enough` of the
/// motion; false where q tells that the derivatives are to be taken anew. Y and r go on as far as steps are good.
bool by_chords(PeriodicSystem& system, const hydro::dense::Lu& derivatives, double last, double enough,
               const Samples& samples, MatrixXd& Y, VectorXd& r) {
  constexpr double slowest = 0.3;
  for (;;) {
    const VectorXd step = derivatives.solve(-r);
    const double length = step.norm(), q = length / last, goal = enough * Y.norm();
    if (!(q < slowest) && !(length <= goal)) return false;
    const MatrixXd next = Y + Eigen::Map<const MatrixXd>(step.data(), Y.rows(), Y.cols());
    if (length <= goal || length * q / (1 - q) <= goal) {
      Y = next;
      return true;
    }
    auto left = tried(residual, system, next, samples);
    if (!left) return false;
    Y = next;
    r = std::move(*left);
    last = length;
  }
}

/// One solution at a number of harmonics: damped Newton, whose derivatives serve as long as steps shrink by them.
/// Empty: none, and `why`.
std::optional<MatrixXd> solve(PeriodicSystem& system, MatrixXd Y, const Samples& samples, const BalanceOptions& options,
                              Balance& report) {
  // Differences within the system leave 1e-9 of the motion, below which Newton only stirs.
  constexpr double stirred = 1e-9;
  for (int i = 0; i < options.iterations; ++i) {
    ++report.iterations;
    const std::optional<BalanceEquations> e = tried(equations, system, Y, samples);
    if (!e) break;
    const hydro::dense::Lu derivatives(e->jacobian);
    const VectorXd step = derivatives.solve(-e->residual);
    if (!step.allFinite()) break;
    const MatrixXd change = Eigen::Map<const MatrixXd>(step.data(), Y.rows(), Y.cols());
    // Newton's error is about the square of its last step, as shares of the motion.
    if (change.norm() <= std::max(stirred, 0.01 * options.accuracy) * Y.norm() || step.norm() == 0)
      return MatrixXd(Y + change);
    double share = 1;
    std::optional<VectorXd> left;
    for (const double before = e->residual.norm();; share /= 2) {
      left = tried(residual, system, Y + share * change, samples);
      if ((left && left->norm() < before) || share < 1e-3) break;
    }
    Y += share * change;
    if (left && share == 1 &&
        by_chords(system, derivatives, step.norm(), std::max(stirred, 1e-3 * options.accuracy), samples, Y, *left))
      return Y;
  }
  report.why = fmt::format("Newton finds no motion of {:.6g} s with {} harmonics",
                           2 * std::numbers::pi / samples.omega(), samples.harmonics());
  return std::nullopt;
}

}  // namespace

CoordinateMotion PeriodicMotion::at(double t) const { return Harmonics(harmonics(), omega, t).times(coefficients, t); }

double PeriodicMotion::tail() const {
  const double all = coefficients.norm();
  return all > 0 ? coefficients.rightCols(std::min<Index>(4, 2 * harmonics())).norm() / all : 0;
}

PeriodicMotion PeriodicMotion::with_harmonics(Index wanted) const {
  PeriodicMotion out{omega, MatrixXd::Zero(coefficients.rows(), 2 * wanted + 1)};
  const Index kept = std::min(coefficients.cols(), out.coefficients.cols());
  out.coefficients.leftCols(kept) = coefficients.leftCols(kept);
  return out;
}

PeriodicMotion PeriodicMotion::over(int periods) const {
  PeriodicMotion out{omega / periods, MatrixXd::Zero(coefficients.rows(), 2 * harmonics() * periods + 1)};
  out.coefficients.col(0) = coefficients.col(0);
  for (Index h = 1; h <= harmonics(); ++h)
    out.coefficients.middleCols(2 * h * periods - 1, 2) = coefficients.middleCols(2 * h - 1, 2);
  return out;
}

PeriodicMotion load_of_memory(PeriodicSystem& system, const PeriodicMotion& motion) {
  return {motion.omega, load(system, motion.coefficients, Samples(motion.harmonics(), motion.omega))};
}

PeriodicMotion at_rest(const PeriodicSystem& system, Index harmonics) {
  return {system.omega(), MatrixXd::Zero(system.size(), 2 * harmonics + 1)};
}

Balance balance(PeriodicSystem& system, PeriodicMotion start, const BalanceOptions& options) {
  Balance out;
  out.motion = start.with_harmonics(std::max(start.harmonics(), options.harmonics));
  for (;;) {
    const Index H = out.motion.harmonics();
    const auto found = solve(system, out.motion.coefficients, Samples(H, out.motion.omega), options, out);
    if (!found) return out;
    out.motion.coefficients = *found;
    out.found = out.motion.tail() <= options.accuracy;
    if (out.found) return out;
    if (H >= options.most_harmonics) {
      out.why = fmt::format("{} harmonics leave {:.2g} of the motion, {:.2g} are allowed", H, out.motion.tail(),
                            options.accuracy);
      return out;
    }
    out.motion = out.motion.with_harmonics(std::min(options.most_harmonics, H + H / 2));
  }
}

namespace {

double distance(const PeriodicMotion& a, const PeriodicMotion& b) {
  const Index H = std::max(a.harmonics(), b.harmonics());
  return (a.with_harmonics(H).coefficients - b.with_harmonics(H).coefficients).norm();
}

/// On the straight line through two motions.
PeriodicMotion expected(const MotionAt& before, const MotionAt& at, double parameter) {
  const Index H = std::max(before.motion.harmonics(), at.motion.harmonics());
  PeriodicMotion out = at.motion.with_harmonics(H);
  out.coefficients += (parameter - at.parameter) / (at.parameter - before.parameter) *
                      (out.coefficients - before.motion.with_harmonics(H).coefficients);
  return out;
}

}  // namespace

Carried carry(const Family& family, const MotionAt& before, const MotionAt& from, double to,
              const BalanceOptions& options) {
  constexpr double far = 0.1, shortest = 1.0 / 64;
  MotionAt last = before, at = from;
  std::optional<Balance> direct;  // by the whole way at once: what a jump comes to
  for (double left = 1, share = 1;; share = std::min(share, left)) {
    const double parameter = share == left ? to : at.parameter + share * (to - from.parameter);
    const auto system = family(parameter);
    PeriodicMotion near = expected(last, at, parameter);
    near.omega = system->omega();
    Balance found = balance(*system, near, options);
    if (found.found && distance(found.motion, near) <= far * found.motion.coefficients.norm()) {
      if (share == left) return {std::move(found), true};
      left -= share;
      last = std::exchange(at, {parameter, std::move(found.motion)});
      share *= 2;
      continue;
    }
    if (!direct) direct = std::move(found);
    if ((share /= 2) < shortest) return {std::move(*direct), false};
  }
}

namespace {

/// A branch in unknowns of order one: coefficients over their size, the parameter over its range.
class Branch {
 public:
  struct Place {
    MatrixXd Y;
    double parameter;
  };
  Branch(const Family& family, double from, double to, const FollowOptions& options)
      : family_(family), from_(from), to_(to), options_(options) {}

  /// The direction of the branch at a place, (n (2H + 1) + 1), unit; on from `before`.
  VectorXd tangent(const Place& at, const VectorXd& before) {
    const Bordered b = bordered(at, before);
    VectorXd one = VectorXd::Zero(before.size());
    one[one.size() - 1] = 1;
    return hydro::dense::Lu(b.matrix).solve(one).normalized();
  }
  Place moved(const Place& at, const VectorXd& way) const {
    Place out = at;
    out.Y += size_ * Eigen::Map<const MatrixXd>(way.data(), at.Y.rows(), at.Y.cols());
    out.parameter += range() * way[way.size() - 1];
    return out;
  }
  /// Onto the branch, across the tangent: Newton. Empty if that does not settle within `reach` of where it begins.
  std::optional<Place> corrected(Place at, const VectorXd& tangent, double reach) try {
    constexpr int most = 8;  // a step that needs more is too long
    VectorXd whole = VectorXd::Zero(tangent.size());
    for (int i = 0; i < most; ++i) {
      const Bordered b = bordered(at, tangent);
      const VectorXd step = hydro::dense::Lu(b.matrix).solve(-b.right);
      whole += step;
      if (!(whole.norm() <= reach)) return std::nullopt;
      at = moved(at, step);
      if (step.norm() < 1e-9) return at;
    }
    return std::nullopt;
  } catch (const hydro::NumericsError&) {  // bodies whose joints cannot be closed
    return std::nullopt;
  }
  void set_size(double size) { size_ = std::max(size, 1e-12); }
  PeriodicMotion motion(const Place& at) const { return {system(at.parameter)->omega(), at.Y}; }
  Balance exactly(double parameter, PeriodicMotion near) const {
    const auto s = system(parameter);
    near.omega = s->omega();
    return balance(*s, std::move(near), options_.balance);
  }

 private:
  struct Bordered {
    MatrixXd matrix;
    VectorXd right;
  };
  std::shared_ptr<PeriodicSystem> system(double parameter) const { return family_(parameter); }
  BalanceEquations at(const Place& p) const {
    const auto s = system(p.parameter);
    return equations(*s, p.Y, Samples(p.Y.cols() / 2, s->omega()));
  }
  VectorXd residual_at(const Place& p) const {
    const auto s = system(p.parameter);
    return residual(*s, p.Y, Samples(p.Y.cols() / 2, s->omega()));
  }
  Bordered bordered(const Place& p, const VectorXd& last_row) const {
    const BalanceEquations here = at(p);
    // Inwards, so that a family need not reach beyond its range.
    const double h = (std::abs(p.parameter - from_) < std::abs(p.parameter - to_) ? 1e-6 : -1e-6) * range();
    const VectorXd by_parameter = (residual_at({p.Y, p.parameter + h}) - here.residual) / h;
    const Index all = here.residual.size();
    Bordered out{MatrixXd(all + 1, all + 1), VectorXd::Zero(all + 1)};
    out.matrix.topLeftCorner(all, all) = size_ * here.jacobian;
    out.matrix.topRightCorner(all, 1) = range() * by_parameter;
    out.matrix.bottomRows(1) = last_row.transpose();
    out.right.head(all) = here.residual;
    return out;
  }

  /// With what it may go back, and the sign of the way.
  double range() const { return to_ - from_ + (to_ > from_ ? options_.before : -options_.before); }

  const Family& family_;
  double from_, to_, size_ = 1;
  const FollowOptions& options_;
};

VectorXd with_rows(const VectorXd& tangent, Index rows) {
  VectorXd out = VectorXd::Zero(rows);
  const Index kept = std::min(rows, tangent.size()) - 1;
  out.head(kept) = tangent.head(kept);
  out[rows - 1] = tangent[tangent.size() - 1];
  return out;
}

}  // namespace

namespace {

/// Adds points until the branch is where it is to go; else why it is not.
std::string go_on(Branch& branch, Branch::Place at, double from, double to, const FollowOptions& options,
                  std::vector<BranchPoint>& points) {
  constexpr double shortest = 1e-7;
  const auto ended = [&](const std::string& why) {
    return fmt::format("the branch {} near {:.6g}", why, at.parameter);
  };
  VectorXd tangent = VectorXd::Unit(at.Y.size() + 1, at.Y.size());
  for (double step = options.step; static_cast<int>(points.size()) < options.points;) {
    branch.set_size(at.Y.norm());
    tangent = branch.tangent(at, tangent);
    auto next = branch.corrected(branch.moved(at, step * tangent), tangent, step / 2);
    while (next && branch.motion(*next).tail() > options.balance.accuracy) {
      const Index H = next->Y.cols() / 2;
      if (H >= options.balance.most_harmonics) return ended(fmt::format("needs more than {} harmonics", H));
      next->Y = branch.motion(*next).with_harmonics(H + H / 2).coefficients;
      tangent = with_rows(tangent, next->Y.size() + 1);
      next = branch.corrected(*next, tangent, options.largest_step);
    }
    if (!next) {
      tangent = with_rows(tangent, at.Y.size() + 1);
      if ((step /= 2) < shortest) return ended("cannot be followed by the smallest step");
      continue;
    }
    if ((next->parameter - to) * (to - from) >= 0) {  // past the end: the motion that has it
      Balance last = branch.exactly(to, branch.motion(*next));
      if (last.found && distance(last.motion, branch.motion(*next)) <= 2 * step * at.Y.norm()) {
        points.push_back({to, std::move(last.motion), true});
        return {};
      }
      if ((step /= 2) < shortest) return ended("has no motion at its end" + (last.found ? "" : ", " + last.why));
      tangent = with_rows(tangent, at.Y.size() + 1);
      continue;
    }
    if ((next->parameter - from) * (to > from ? 1 : -1) < -options.before)
      return ended("turns back from where it began");
    at = *next;
    points.push_back({at.parameter, branch.motion(at), tangent[tangent.size() - 1] > 0});
    step = std::min(1.3 * step, options.largest_step);
  }
  return ended(fmt::format("has {} points, as many as are allowed,", options.points));
}

}  // namespace

FollowedBranch follow(const Family& family, double from, double to, PeriodicMotion start,
                      const FollowOptions& options) {
  Branch branch(family, from, to, options);
  const Branch::Place at{std::move(start.coefficients), from};
  FollowedBranch out{{{from, branch.motion(at), true}}, {}};
  try {
    out.end = go_on(branch, at, from, to, options, out.points);
  } catch (const hydro::NumericsError& error) {  // bodies whose joints cannot be closed
    out.end = error.what();
  }
  return out;
}

namespace {

/// The harmonics up to the last that is more than rounding.
MatrixXd audible(const MatrixXd& series) {
  constexpr double rounding = 1e-14;
  Index kept = series.cols();
  const double least = rounding * series.norm();
  while (kept > 1 && series.middleCols(kept - 2, 2).norm() <= least) kept -= 2;
  return series.leftCols(kept);
}

}  // namespace

// (Q12)
Eigen::VectorXcd floquet_multipliers(PeriodicSystem& system, const PeriodicMotion& motion) {
  const Samples samples(motion.harmonics(), motion.omega);
  const Sampled sampled(system, motion.coefficients, samples, &PeriodicSystem::at);
  const PeriodicMemory* memory = system.memory();
  const Index n = system.size(), z = memory != nullptr ? memory->A.rows() : 0, m = z > 0 ? memory->B.cols() : 0,
              H = 2 * samples.harmonics() + 1;
  // What varies: δ̈ by (δ, δ̇, z), and below it w by (δ, δ̇). How the states z go on from w is the same at all times.
  // Column k of the series: harmonic k of it, entry after entry.
  MatrixXd series = MatrixXd::Zero((n + m) * (2 * n + z), 2 * H + 1);
  for (std::size_t j = 0; j < samples.count(); ++j) {
    const PeriodicSample& s = sampled.at[j];
    MatrixXd right(n, 2 * n + z), varying = MatrixXd::Zero(n + m, 2 * n + z);
    right.leftCols(n) = s.by_value;
    right.middleCols(n, n) = s.by_rate;
    if (z > 0) {
      right.rightCols(z) = -s.by_load * memory->C;
      varying.bottomLeftCorner(m, 2 * n) << s.velocity_by_value, s.velocity_by_rate;
    }
    varying.topRows(n) = -hydro::dense::PivotedQr(s.by_acceleration).solve(right);
    VectorXd weight = harmonics_at(H, samples.omega() * samples.time(j)) * (2.0 / static_cast<double>(samples.count()));
    weight[0] /= 2;
    series += varying.reshaped() * weight.transpose();
  }
  const MatrixXd heard = audible(series);
  PeriodicWithMemory disturbed{.at = {}, .A = MatrixXd(0, 0), .B = MatrixXd(0, 0)};
  if (z > 0) disturbed.A = memory->A, disturbed.B = memory->B;
  disturbed.at = [&](double t) {
    const VectorXd entries = heard * harmonics_at(heard.cols() / 2, motion.omega * t);
    const Eigen::Map<const MatrixXd> now(entries.data(), n + m, 2 * n + z);
    PeriodicWithMemory::Varying out{MatrixXd::Zero(2 * n, 2 * n), MatrixXd::Zero(2 * n, z),
                                    now.bottomLeftCorner(m, 2 * n)};
    out.P.topRightCorner(n, n).setIdentity();
    out.P.bottomRows(n) = now.topLeftCorner(n, 2 * n);
    out.Q.bottomRows(n) = now.topRightCorner(n, z);
    return out;
  };
  constexpr double tolerance = 1e-9;  // as derivatives by differences leave
  return floquet_multipliers(disturbed, 2 * std::numbers::pi / motion.omega, tolerance);
}

std::string name_of(Fate fate) {
  switch (fate) {
    case Fate::stable:
      return "stable";
    case Fate::doubled:
      return "period-doubled";
    case Fate::quasiperiodic:
      return "quasi-periodic";
    case Fate::fold:
      return "fold";
  }
  return {};
}

Fate fate_of(const Eigen::VectorXcd& multipliers) {
  constexpr double rounding = 1e-7;  // of multipliers; a system without damping has all of them on the circle
  const std::complex<double> largest = multipliers[0];
  if (std::abs(largest) <= 1 + rounding) return Fate::stable;
  if (std::abs(largest.imag()) > rounding * std::abs(largest)) return Fate::quasiperiodic;
  return largest.real() < 0 ? Fate::doubled : Fate::fold;
}

}  // namespace dynamics::frequency
