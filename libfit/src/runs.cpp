#include "fit/runs.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"

namespace fit {
namespace {

struct Regressor {
  const char* name;
  double RunEstimate::*number;
};
std::vector<Regressor> regressors(Law law) {
  switch (law) {
    case Law::constant:
      return {};
    case Law::kc:
      return {{"KC", &RunEstimate::kc}};
    case Law::re:
      return {{"Re", &RunEstimate::re}};
    case Law::beta:
      return {{"beta", &RunEstimate::beta}};
    case Law::kc_and_re:
      break;
  }
  return {{"KC", &RunEstimate::kc}, {"Re", &RunEstimate::re}};
}

struct Design {
  Eigen::MatrixXd x;       // (n, p)
  Eigen::VectorXd y, own;  // values, own variances
  std::vector<std::string> terms;
};

hydro::InputError error_of(const RunEstimate& run, Eigen::Index number, const std::string& rule,
                           const std::string& remedy) {
  if (run.file.empty()) return hydro::InputError(fmt::format("run {}: {}", number + 1, rule), {}, remedy);
  return hydro::InputError("of runs that are put together: " + rule, {.file = run.file}, remedy);
}

hydro::InputError too_few(const std::string& what, std::size_t needed, std::size_t got) {
  return hydro::InputError(fmt::format("{} needs {} runs at least, got {}", what, needed, got), {},
                           "take more runs, or leave out what asks for them");
}

Design design(std::span<const RunEstimate> runs, Law law) {  // (F31)
  const auto n = static_cast<Eigen::Index>(runs.size());
  const auto wanted = regressors(law);
  Design d{Eigen::MatrixXd::Ones(n, 1 + std::ssize(wanted)), Eigen::VectorXd(n), Eigen::VectorXd(n), {"constant"}};
  for (Eigen::Index i = 0; i < n; ++i) {
    const RunEstimate& r = runs[static_cast<std::size_t>(i)];
    if (!std::isfinite(r.value) || !(r.standard_error > 0) || !std::isfinite(r.standard_error))
      throw error_of(r, i, fmt::format("its value is {:g} with the standard error {:g}", r.value, r.standard_error),
                     "leave the run out: runs are put together by what each is known to");
    d.y[i] = r.value;
    d.own[i] = r.standard_error * r.standard_error;
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      if (!(r.*wanted[k].number > 0))
        throw error_of(r, i, fmt::format("{} must be positive, got {:g}", wanted[k].name, r.*wanted[k].number),
                       "state the viscosity, or ask for a law without it");
      d.x(i, static_cast<Eigen::Index>(k) + 1) = std::log(r.*wanted[k].number);
    }
  }
  for (Eigen::Index k = 1; k < d.x.cols(); ++k) {
    const double middle = d.x.col(k).mean();
    d.x.col(k).array() -= middle;
    hydro::require(d.x.col(k).norm() > 1e-6, "the runs do not differ in {}",
                   wanted[static_cast<std::size_t>(k) - 1].name);
    d.terms.push_back(fmt::format("ln({}/{:.4g})", wanted[static_cast<std::size_t>(k) - 1].name, std::exp(middle)));
  }
  const hydro::dense::PivotedQr qr(d.x);
  hydro::require(qr.rank() == d.x.cols(), "the runs cannot tell the terms of this law apart");
  return d;
}

struct Weighted {
  Eigen::VectorXd weights, coefficients, residuals;
  Eigen::MatrixXd inverse;  // (XᵀWX)⁻¹
};
Weighted solve(const Design& d, double between_squared) {
  Weighted w;
  w.weights = (d.own.array() + between_squared).inverse();
  w.inverse = hydro::dense::inverse(d.x.transpose() * w.weights.asDiagonal() * d.x);
  w.coefficients = w.inverse * d.x.transpose() * w.weights.cwiseProduct(d.y);
  w.residuals = d.y - d.x * w.coefficients;
  return w;
}

/// The slope of the likelihood over τ², of which it is twice, and the information. (F31)
struct SlopeOfLikelihood {
  double slope, information;
};
SlopeOfLikelihood slope_of_likelihood(const Design& d, double squared, bool restricted) {
  const Weighted w = solve(d, squared);
  const Eigen::MatrixXd wx = w.weights.asDiagonal() * d.x;
  Eigen::MatrixXd p = w.weights.asDiagonal();
  if (restricted) p -= wx * w.inverse * wx.transpose();
  return {w.weights.cwiseProduct(w.residuals).squaredNorm() - p.trace(), p.squaredNorm()};
}

/// Where the likelihood rises no more, by halving: of three runs whose errors are very different Fisher's steps may go
/// to and fro for ever.
double between_runs_by_halving(const Design& d, bool restricted) {
  const auto rises = [&](double squared) { return slope_of_likelihood(d, squared, restricted).slope > 0; };
  if (!rises(0)) return 0;
  double low = 0, high = d.own.maxCoeff();
  while (rises(high)) low = high, high *= 2;
  for (int round = 0; round < 200 && high - low > 1e-12 * (high + d.own.minCoeff()); ++round)
    (rises((low + high) / 2) ? low : high) = (low + high) / 2;
  return (low + high) / 2;
}

/// τ² by Fisher scoring; `restricted`: the degrees of freedom of the coefficients are counted (REML). (F31)
double between_runs(const Design& d, bool restricted) {
  double squared = std::max(0.0, solve(d, 0).residuals.squaredNorm() / static_cast<double>(d.y.size()) - d.own.mean());
  for (int round = 0; round < 200; ++round) {
    const auto [slope, information] = slope_of_likelihood(d, squared, restricted);
    const double next = std::max(0.0, squared + slope / information);
    if (std::abs(next - squared) <= 1e-12 * (next + d.own.minCoeff())) return next;
    squared = next;
  }
  return between_runs_by_halving(d, restricted);
}

/// Each run from the others: rms of what is missed.
double cross_validate(const Design& d, double between_squared) {  // (F33)
  const Weighted w = solve(d, between_squared);
  double sum = 0;
  for (Eigen::Index i = 0; i < d.y.size(); ++i) {
    const double leverage = w.weights[i] * (d.x.row(i) * w.inverse * d.x.row(i).transpose())(0, 0);
    sum += std::pow(w.residuals[i] / (1 - leverage), 2);
  }
  return std::sqrt(sum / static_cast<double>(d.y.size()));
}

void judge(const Design& d, RandomEffects& r) {  // (F33)
  const auto n = static_cast<double>(d.y.size()), k = static_cast<double>(d.x.cols()) + 1;
  const Weighted ml = solve(d, between_runs(d, false));
  r.log_likelihood =
      -0.5 * (2 * std::numbers::pi / ml.weights.array()).log().sum() - 0.5 * ml.weights.dot(ml.residuals.cwiseAbs2());
  r.bic = -2 * r.log_likelihood + k * std::log(n);
  r.aicc = n > k + 1 ? -2 * r.log_likelihood + 2 * k + 2 * k * (k + 1) / (n - k - 1)
                     : std::numeric_limits<double>::infinity();
  r.cross_validation = cross_validate(d, r.between * r.between);
}

}  // namespace

std::string name_of(Law law) {
  switch (law) {
    case Law::constant:
      return "constant";
    case Law::kc:
      return "ln KC";
    case Law::re:
      return "ln Re";
    case Law::beta:
      return "ln beta";
    case Law::kc_and_re:
      break;
  }
  return "ln KC and ln Re";
}

RandomEffects fit_runs(std::span<const RunEstimate> runs, Law law, double confidence) {  // (F31), (F32)
  hydro::require(confidence > 0 && confidence < 1, "a confidence level must lie between 0 and 1, got {}", confidence);
  if (const std::size_t needed = regressors(law).size() + 3; runs.size() < needed)
    throw too_few(fmt::format("the law \"{}\"", name_of(law)), needed, runs.size());
  const Design d = design(runs, law);
  const auto n = static_cast<double>(d.y.size()), p = static_cast<double>(d.x.cols());
  const double squared = between_runs(d, true);
  const Weighted w = solve(d, squared);
  RandomEffects r{};
  r.law = law;
  r.terms = d.terms;
  r.coefficients = w.coefficients;
  r.residuals = w.residuals;
  r.between = std::sqrt(squared);
  // Knapp & Hartung: the residuals' own scatter scales the errors, but never below what the runs state.
  const double scale = std::max(1.0, w.weights.dot(w.residuals.cwiseAbs2()) / (n - p));
  r.covariance = scale * w.inverse;
  const double t = hydro::signal::student_t_quantile((1 + confidence) / 2, n - p);
  for (Eigen::Index j = 0; j < r.coefficients.size(); ++j) {
    const double half = t * std::sqrt(r.covariance(j, j));
    r.intervals.push_back({r.coefficients[j] - half, r.coefficients[j] + half});
  }
  const double reach = t * std::sqrt(squared + r.covariance(0, 0));
  r.prediction = {r.coefficients[0] - reach, r.coefficients[0] + reach};
  const double typical = 1 / d.own.cwiseInverse().mean();
  r.heterogeneity = squared / (squared + typical);
  judge(d, r);
  return r;
}

std::vector<RandomEffects> compare_laws(std::span<const RunEstimate> runs, double confidence) {
  if (runs.size() < 3) throw too_few("a law over runs", 3, runs.size());
  std::vector<RandomEffects> out;
  for (const Law law : {Law::constant, Law::kc, Law::re, Law::beta, Law::kc_and_re}) try {
      out.push_back(fit_runs(runs, law, confidence));
    } catch (const hydro::InputError&) {
      if (law == Law::constant) throw;  // the others may ask for what the runs do not tell
    }
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.aicc < b.aicc; });
  return out;
}

}  // namespace fit
