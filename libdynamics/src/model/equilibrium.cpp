#include "dynamics/model/equilibrium.hpp"

#include <Eigen/QR>

#include <optional>

#include "dynamics/model/assemble.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {
namespace {

/// Which kinds of force count.
using Linear = Model::Linear (Model::*)(const State&) const;

/// Loads left over, and the displacements that Newton asks for, in motions scaled by the root of the bodies' masses.
class Balance {
 public:
  Balance(const Model& model, Linear of)
      : model_(model), linear_(of), root_(model.dry_mass_at_rest().diagonal().cwiseSqrt()) {}

  Model::Linear linear(const State& state) const { return (model_.*linear_)(state); }
  Eigen::VectorXd unbalanced(const State& state) const {
    return root_.cwiseInverse().cwiseProduct(linear(state).unbalanced);
  }
  /// The smallest solution of [K Gᵀ; G 0] (δ, λ) = (F, 0): along what nothing restores it does not go.
  Eigen::VectorXd correction(const State& state) const {
    const Model::Linear linear = this->linear(state);
    const Eigen::VectorXd scale = root_.cwiseInverse();
    const Eigen::Index n = scale.size(), m = linear.constraints.rows();
    Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(n + m, n + m);
    whole.topLeftCorner(n, n) = scale.asDiagonal() * linear.stiffness * scale.asDiagonal();
    whole.topRightCorner(n, m) = scale.asDiagonal() * linear.constraints.transpose();
    whole.bottomLeftCorner(m, n) = linear.constraints * scale.asDiagonal();
    for (int mode = 0; mode < n; ++mode)
      if (!model_.is_free(mode)) {
        whole.row(mode).setZero();
        whole.col(mode).setZero();
      }
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n + m);
    right.head(n) = scale.cwiseProduct(linear.unbalanced);
    return scale.cwiseProduct(whole.completeOrthogonalDecomposition().solve(right).head(n));
  }
  /// The way that bodies begin to go by themselves; its length means nothing.
  Eigen::VectorXd along_load(const State& state) const { return root_.cwiseInverse().cwiseProduct(unbalanced(state)); }
  /// What loads that are left over, scaled, do over a move.
  double work(const Eigen::VectorXd& left, const Eigen::VectorXd& move) const {
    return left.dot(root_.cwiseProduct(move));
  }
  double weight() const {  // scaled as the loads
    return 9.81 * root_.norm();
  }

 private:
  const Model& model_;
  Linear linear_;
  Eigen::VectorXd root_;
};

/// `move` made so long that some body turns by 0.3 rad or moves by 10 m, and none by more.
Eigen::VectorXd longest(const Eigen::VectorXd& move) {
  double most = 0;
  for (Eigen::Index mode = 0; mode < move.size(); ++mode)
    most = std::max(most, std::abs(move[mode]) / (mode % 6 < 3 ? 10.0 : 0.3));
  return most > 0 ? Eigen::VectorXd(move / most) : move;
}
/// The share of `move` that is no longer than that.
double allowed(const Eigen::VectorXd& move) { return std::min(1.0, longest(move).norm() / move.norm()); }

State displaced(const Model& model, const State& from, const Eigen::VectorXd& move) {
  State out = moved(from, move);
  close_joints(model, std::vector<bool>(out.pose.size(), false), out);
  model.joints().count_turns(out);
  return out;
}

[[noreturn]] void give_up(const Model& model, const Balance& balance, const State& state) {
  const Eigen::VectorXd left = balance.linear(state).unbalanced;
  const Eigen::VectorXd per_mass = left.cwiseQuotient(model.dry_mass_at_rest().diagonal());
  Eigen::Index worst = 0;
  per_mass.cwiseAbs().maxCoeff(&worst);
  throw hydro::InputError(
      fmt::format("no equilibrium is found: nothing holds {} against {:.4g} {}",
                  model.mode_name(static_cast<int>(worst)), left[worst], worst % 6 < 3 ? "N" : "N m"),
      {}, "name what holds it (hydrostatics, buoyancy, a mooring), or place the bodies nearer to where they balance");
}

/// The search for rest from one state on.
class Search {
 public:
  Search(const Model& model, const Balance& balance, const State& start)
      : model_(model),
        balance_(balance),
        now_(displaced(model, start, Eigen::VectorXd::Zero(model.modes()))),
        left_(balance.unbalanced(now_)) {}

  const State& now() const { return now_; }
  bool at_rest() const { return left_.norm() <= 1e-9 * balance_.weight(); }

  /// Takes as much of a move as leaves less unbalanced; false if no part of it does.
  bool leaves_less(const Eigen::VectorXd& move) {
    if (!move.allFinite() || move.norm() == 0) return false;
    bool flat = false;  // what twice this move leaves does not differ from what there is
    for (double share = allowed(move); share > 1e-6; share /= 2) {
      const auto there = moved_by(share * move);
      if (!there) continue;
      if (there->left.norm() < (1 - 1e-4 * share) * left_.norm()) return take(*there);
      const bool same = (there->left - left_).norm() <= 1e-9 * left_.norm();
      if (flat && same) return false;
      flat = same;
    }
    return false;
  }
  /// Takes as much of a move as the loads still drive at its end, so that it goes down in energy: across what is as
  /// flat as the way of a body between two slack lines, and over what leaves more unbalanced before it leaves less.
  bool goes_down(const Eigen::VectorXd& move) {
    if (!move.allFinite() || move.norm() == 0) return false;
    for (double share = 1; share > 1e-3; share /= 2) {
      const auto there = moved_by(share * move);
      if (there && balance_.work(there->left, move) > 0) return take(*there);
    }
    return false;
  }

 private:
  struct Trial {
    State state;
    Eigen::VectorXd left;
  };
  /// Nothing where the loads cannot be told: where a line does not reach.
  std::optional<Trial> moved_by(const Eigen::VectorXd& move) const {
    try {
      State state = displaced(model_, now_, move);
      Eigen::VectorXd left = balance_.unbalanced(state);
      if (left.allFinite()) return Trial{std::move(state), std::move(left)};
    } catch (const hydro::InputError&) {
    } catch (const hydro::NumericsError&) {
    }
    return std::nullopt;
  }
  bool take(const Trial& trial) {
    now_ = trial.state;
    left_ = trial.left;
    return true;
  }

  const Model& model_;
  const Balance& balance_;
  State now_;
  Eigen::VectorXd left_;  // unbalanced, scaled
};

// (D21)
State at_rest(const Model& model, Linear linear, State start) {
  constexpr int most = 200, most_downhill = 50;  // of 10 m at most: no slack of a mooring is longer than 500 m
  const Balance balance(model, linear);
  start.velocity.setZero();
  Search search(model, balance, start);
  int downhill = 0;
  for (int i = 0; i < most; ++i) {
    if (search.at_rest()) return search.now();
    if (search.leaves_less(balance.correction(search.now()))) continue;
    // Where Newton leads nowhere, as for a pendulum held out level, the bodies follow their loads for a while.
    const Eigen::VectorXd along = longest(balance.along_load(search.now()));
    if (search.leaves_less(along)) continue;
    if (++downhill > most_downhill || !search.goes_down(along)) break;
  }
  give_up(model, balance, search.now());
}

}  // namespace

State equilibrium(const Model& model, State start) { return at_rest(model, &Model::linear_at, std::move(start)); }

State equilibrium_before_run(const Model& model, State start) {
  return at_rest(model, &Model::linear_before_runs, std::move(start));
}

}  // namespace dynamics
