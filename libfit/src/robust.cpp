#include "fit/robust.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "fit/least_squares.hpp"
#include "hydro/base/error.hpp"

namespace fit {
namespace {

/// Median distance from zero over that of a Gaussian of deviation 1.
double spread(const Eigen::VectorXd& e, std::vector<double>& scratch) {
  scratch.resize(static_cast<std::size_t>(e.size()));
  for (Eigen::Index j = 0; j < e.size(); ++j) scratch[static_cast<std::size_t>(j)] = std::abs(e[j]);
  const auto middle = scratch.begin() + static_cast<std::ptrdiff_t>(scratch.size() / 2);
  std::nth_element(scratch.begin(), middle, scratch.end());
  return *middle / 0.6745;
}

constexpr double huber_bound = 1.345, bisquare_bound = 4.685;  // deviations

/// ψ, cut off at ±bound; its mean slope is the share of residuals within.
double huber_influence(const Eigen::VectorXd& e, double bound, Eigen::VectorXd& psi) {
  psi = e.cwiseMax(-bound).cwiseMin(bound);
  return static_cast<double>((e.array().abs() < bound).count()) / static_cast<double>(e.size());
}

/// ψ = e (1 − (e/bound)²)² within ±bound, none beyond. \returns its mean slope, (1 − t)(1 − 5t) with t = (e/bound)²
double bisquare_influence(const Eigen::VectorXd& e, double bound, Eigen::VectorXd& psi) {
  const Eigen::ArrayXd t = (e.array() / bound).square().cwiseMin(1);
  psi = e.array() * (1 - t).square();
  return ((1 - t) * (1 - 5 * t)).mean();
}

/// One search for Jᵀψ(e) = 0 after another, by the same factors.
class RobustSearch {
 public:
  RobustSearch(const Eigen::MatrixXd& columns, const Eigen::VectorXd& target)
      : columns_(columns), problem_(compress(columns, target)), e_(target) {
    step(problem_.columns.triangularView<Eigen::Upper>().solve(problem_.target));
  }

  /// Newton's steps; `rounds_of_scale` of them with a deviation of their own, whose median hardly moves afterwards.
  void huber(double bound, int rounds_of_scale) {
    settle(rounds_of_scale, [&](Eigen::VectorXd& psi) { return huber_influence(e_, bound * fit_.deviation, psi); });
    fit_.share_inside = fit_.slope;
  }
  void bisquare() {
    const double bound = bisquare_bound * fit_.deviation;
    settle(0, [&](Eigen::VectorXd& psi) { return bisquare_influence(e_, bound, psi); });
    fit_.share_inside = static_cast<double>((e_.array().abs() < bound).count()) / static_cast<double>(e_.size());
  }
  /// Of any two bounds the wider is the way to the narrower.
  void least_absolute() {
    const double inside = fit_.share_inside, narrow = std::pow(static_cast<double>(e_.size()), -1.0 / 3);
    for (double bound = huber_bound / 2; bound > narrow; bound /= 2) huber(bound, 0);
    huber(narrow, 0);
    fit_.share_inside = inside;
  }
  bool all_but_exact() const { return !(fit_.deviation > 0); }  // more than half of the residuals are zero
  RobustFit done() && { return std::move(fit_); }

 private:
  void step(const Eigen::VectorXd& change) {
    fit_.x = fit_.x.size() == 0 ? change : Eigen::VectorXd(fit_.x + change);
    e_.noalias() -= columns_ * change;
  }
  template <class Influence>
  void settle(int rounds_of_scale, Influence influence);

  const Eigen::MatrixXd& columns_;
  Compressed problem_;
  Eigen::VectorXd e_;
  std::vector<double> scratch_;
  RobustFit fit_{{}, {}, 0, 1, 1, 0};
};

// The gradient Jᵀψ has the derivative JᵀJ times about the mean slope of ψ, so one factorisation serves all rounds.
// Where such a Newton step does not bring the gradient down, the plain step (JᵀJ alone) is sure to: no ψ is steeper
// than 1, so it bounds the curvature from above.
template <class Influence>
void RobustSearch::settle(int rounds_of_scale, Influence influence) {
  constexpr int most = 200;
  const auto factors = std::as_const(problem_.columns).triangularView<Eigen::Upper>();
  double before = std::numeric_limits<double>::infinity();
  for (int round = 1; round <= most; ++round, ++fit_.rounds) {
    if (round <= rounds_of_scale) fit_.deviation = spread(e_, scratch_);
    if (all_but_exact()) {
      fit_.influence = e_;
      return;
    }
    fit_.slope = influence(fit_.influence);
    if (!(fit_.slope > 0)) break;
    const Eigen::VectorXd gradient = columns_.transpose() * fit_.influence;
    const Eigen::VectorXd scaled = factors.transpose().solve(gradient);  // in units of one sample's error
    if (round > rounds_of_scale && scaled.norm() <= 1e-8 * fit_.deviation) return;
    step(factors.solve(scaled) / (scaled.norm() < before ? fit_.slope : 1.0));
    before = scaled.norm();
  }
  throw hydro::NumericsError("the robust fit does not settle: more than half of the samples may be wild");
}

}  // namespace

RobustFit fit_robust(const Eigen::MatrixXd& columns, const Eigen::VectorXd& target, RobustLoss loss) {  // (F39)
  RobustSearch search(columns, target);
  search.huber(huber_bound, 3);
  if (search.all_but_exact()) return std::move(search).done();
  if (loss == RobustLoss::bisquare) search.bisquare();
  if (loss == RobustLoss::least_absolute) search.least_absolute();
  return std::move(search).done();
}

}  // namespace fit
