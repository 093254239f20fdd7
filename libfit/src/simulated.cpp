#include "fit/simulated.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>

#include "fit/correlated.hpp"
#include "fit/verdict.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"

namespace fit {
namespace {

// Differences: a start moves by so much, a parameter by so much of its scale. Simulations solve to about 1e-9, so the
// quotient of a difference of 1e-5 is good to 1e-4, and its bend adds as little.
constexpr double start_step = 1e-5, parameter_step = 1e-4;
// A direction counts as not seen below this singular value relative to the largest: central differences are off by
// about the square of their step, 1e-8.
constexpr double not_seen = 1e-6;

/// One window of the problem with the directions of its start that the data see.
struct Piece {
  Eigen::MatrixXd seen;  // shape (coordinates, directions): orthonormal columns
  Eigen::Index row, column;
};

class Shooting {
 public:
  Shooting(Simulation& simulation, const SimulationProblem& problem) : simulation_(simulation), problem_(problem) {
    check();
    for (std::size_t k = 0; k < problem.parameters.size(); ++k) first_.push_back(problem.parameters[k].first);
  }

  SimulationFit solve();
  double least_cost();  ///< that of solve(), which tells more of it

 private:
  Eigen::Index p() const { return std::ssize(problem_.parameters); }
  Eigen::Index channels() const { return std::ssize(problem_.deviations); }
  Eigen::VectorXd first() const { return Eigen::Map<const Eigen::VectorXd>(first_.data(), p()); }
  Eigen::VectorXd start_of(const Eigen::VectorXd& x, std::size_t w) const {
    const Piece& piece = pieces_[w];
    return piece.seen * x.segment(piece.column, piece.seen.cols());
  }
  void check() const;
  Eigen::VectorXd residuals(std::size_t w, const Eigen::VectorXd& theta, const Eigen::VectorXd& start);
  Eigen::MatrixXd start_columns(std::size_t w, const Eigen::VectorXd& theta, const Eigen::VectorXd& start,
                                const Eigen::VectorXd& here, const Eigen::MatrixXd& directions);
  void look_at_start(std::size_t w, Eigen::Index row, Eigen::Index column);
  Eigen::VectorXd settle(std::size_t w);
  Eigen::VectorXd find_starts();
  Eigen::VectorXd go_on(const SimulationFit::End& end);
  FitReport search(Eigen::VectorXd& x);
  void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian);
  Eigen::MatrixXd differences(const Eigen::VectorXd& x);
  void parameter_column(Eigen::Index k, const Eigen::VectorXd& x, Eigen::MatrixXd& jacobian);
  ResidualModel model();
  CoefficientCovariance covariance(const Eigen::VectorXd& r, const std::vector<bool>& identifiable) const;
  void tell(const Eigen::VectorXd& x, SimulationFit& fit);
  void tell_parameters(const Eigen::VectorXd& x, const CoefficientCovariance& u, SimulationFit& fit) const;
  void tell_motion(const Eigen::VectorXd& x, const Eigen::VectorXd& r, SimulationFit& fit) const;
  void tell_bands(const CoefficientCovariance& u, SimulationFit& fit) const;
  void tell_identifiability(const Eigen::MatrixXd& jacobian, double unit, SimulationFit& fit);
  void judge(const Eigen::VectorXd& x, SimulationFit& fit) const;
  void compare_with_stated(const Eigen::VectorXd& r, SimulationFit& fit) const;
  void refuse(SimulationFit& fit) const;

  Simulation& simulation_;
  const SimulationProblem& problem_;
  std::vector<double> first_;
  std::vector<Piece> pieces_;
  std::vector<bool> unseen_ = std::vector<bool>(problem_.parameters.size(), false);
  Eigen::Index rows_ = 0, unknowns_ = 0, all_starts_ = 0;
  long followed_ = 0;
  struct {
    Eigen::VectorXd x, r;
  } last_;                    // a search asks for the same point several times
  Eigen::MatrixXd jacobian_;  // held while a round of the search goes on
};

void Shooting::check() const {
  hydro::require(!problem_.measured.empty(), "a fit needs a record at least");
  for (const auto& q : problem_.parameters)
    hydro::require(q.lowest < q.highest && q.first >= q.lowest && q.first <= q.highest && std::isfinite(q.first),
                   "{} begins at {}, which must lie between {} and {}", q.name, q.first, q.lowest, q.highest);
  for (const auto& m : problem_.measured)
    hydro::require(m.rows() >= 8 && m.cols() == std::ssize(problem_.deviations) && m.allFinite(),
                   "a window needs 8 samples at least of {} channels, all finite; got {} of {}",
                   problem_.deviations.size(), m.rows(), m.cols());
  for (const double d : problem_.deviations) hydro::require(d > 0, "a channel's deviation must be positive, got {}", d);
}

/// Of one window over the deviations, one channel after the other.
Eigen::VectorXd Shooting::residuals(std::size_t w, const Eigen::VectorXd& theta, const Eigen::VectorXd& start) {
  ++followed_;
  Eigen::MatrixXd motion = simulation_.follow(w, theta, start);
  const Eigen::MatrixXd& measured = problem_.measured[w];
  hydro::require(motion.rows() == measured.rows() && motion.cols() == measured.cols(),
                 "the simulation gave {} samples of {} channels, {} of {} were measured", motion.rows(), motion.cols(),
                 measured.rows(), measured.cols());
  motion -= measured;
  for (Eigen::Index c = 0; c < motion.cols(); ++c) motion.col(c) /= problem_.deviations[static_cast<std::size_t>(c)];
  return motion.reshaped();
}

Eigen::MatrixXd Shooting::start_columns(std::size_t w, const Eigen::VectorXd& theta, const Eigen::VectorXd& start,
                                        const Eigen::VectorXd& here, const Eigen::MatrixXd& directions) {
  Eigen::MatrixXd out(here.size(), directions.cols());
  for (Eigen::Index j = 0; j < directions.cols(); ++j)
    out.col(j) = (residuals(w, theta, start + start_step * directions.col(j)) - here) / start_step;
  return out;
}

/// Which directions of a window's start the data see: central differences, in which a motion across the plane that is
/// measured cancels, and singular values above 1e-6 of the largest, a hundred times their error (F42).
void Shooting::look_at_start(std::size_t w, Eigen::Index row, Eigen::Index column) {
  const Eigen::Index d = simulation_.coordinates(w);
  Piece piece{Eigen::MatrixXd::Identity(d, d), row, column};
  all_starts_ += d;
  if (d > 0) {
    Eigen::MatrixXd columns(problem_.measured[w].size(), d);
    for (Eigen::Index j = 0; j < d; ++j) {
      const Eigen::VectorXd step = start_step * Eigen::VectorXd::Unit(d, j);
      columns.col(j) = (residuals(w, first(), step) - residuals(w, first(), -step)) / (2 * start_step);
    }
    const auto svd = hydro::dense::svd(columns);
    Eigen::Index seen = 0;
    while (seen < d && svd.values[seen] > not_seen * svd.values[0]) ++seen;
    piece.seen = svd.V.leftCols(seen);
  }
  pieces_.push_back(std::move(piece));
}

/// The start of one window fitted alone, with the parameters at their first values: to its first quarter, to its first
/// half, and to all of it, since what lies far ahead pulls a wrong start to a wrong minimum (F41).
Eigen::VectorXd Shooting::settle(std::size_t w) {
  const Piece& piece = pieces_[w];
  const Eigen::Index samples = problem_.measured[w].rows();
  Eigen::VectorXd z = Eigen::VectorXd::Zero(piece.seen.cols());
  if (z.size() == 0) return z;
  ResidualModel alone;
  alone.parameters.assign(static_cast<std::size_t>(z.size()), {"start"});
  alone.residuals = problem_.measured[w].size();
  for (const Eigen::Index part : {4, 2, 1}) {
    const auto later = Eigen::seq(samples / part, samples - 1);
    alone.evaluate = [&](const Eigen::VectorXd& at, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
      try {
        r = residuals(w, first(), piece.seen * at);
        if (jacobian) *jacobian = start_columns(w, first(), piece.seen * at, r, piece.seen);
      } catch (const hydro::NumericsError&) {
        r.setConstant(std::numeric_limits<double>::quiet_NaN());  // Ceres then tries a shorter step
        return;
      }
      if (part == 1) return;
      r.reshaped(samples, r.size() / samples)(later, Eigen::all).setZero();
      if (jacobian)
        for (auto column : jacobian->colwise())
          column.reshaped(samples, r.size() / samples)(later, Eigen::all).setZero();
    };
    minimise(alone, z, {.cost_change_below = 1e-3, .gradient_below = 1e-9, .step_below = 1e-6, .iterations_reach = 6});
  }
  return z;
}

/// Each window begins where the one before ended, and settles on its own samples before it is handed on.
Eigen::VectorXd Shooting::find_starts() {
  std::vector<Eigen::VectorXd> found;
  unknowns_ = p();
  for (std::size_t w = 0; w < problem_.measured.size(); ++w) {
    look_at_start(w, rows_, unknowns_);
    found.push_back(settle(w));
    rows_ += problem_.measured[w].size();
    unknowns_ += found.back().size();
    if (w + 1 < problem_.measured.size()) simulation_.hand_on(w, first(), pieces_[w].seen * found.back());
  }
  Eigen::VectorXd x(unknowns_);
  x.head(p()) = first();
  for (std::size_t w = 0; w < found.size(); ++w) x.segment(pieces_[w].column, found[w].size()) = found[w];
  return x;
}

/// Unknowns and directions of the fit of another record.
Eigen::VectorXd Shooting::go_on(const SimulationFit::End& end) {
  hydro::require(end.seen.size() == problem_.measured.size() && end.unknowns.size() >= p(),
                 "the fit to begin at has {} windows, this record {}", end.seen.size(), problem_.measured.size());
  unknowns_ = p();
  for (std::size_t w = 0; w < end.seen.size(); ++w) {
    pieces_.push_back({end.seen[w], rows_, unknowns_});
    all_starts_ += end.seen[w].rows();
    rows_ += problem_.measured[w].size();
    unknowns_ += end.seen[w].cols();
  }
  hydro::require(end.jacobian.rows() == rows_ && end.jacobian.cols() == unknowns_ && end.unknowns.size() == unknowns_,
                 "the fit to begin at has {} samples and {} unknowns, this one {} and {}", end.jacobian.rows(),
                 end.unknowns.size(), rows_, unknowns_);
  jacobian_ = end.jacobian;
  return end.unknowns;
}

/// By a central difference, one-sided at a bound.
void Shooting::parameter_column(Eigen::Index k, const Eigen::VectorXd& x, Eigen::MatrixXd& jacobian) {
  const auto& q = problem_.parameters[static_cast<std::size_t>(k)];
  const double step = parameter_step * q.scale();
  Eigen::VectorXd low = x.head(p()), high = low;
  low[k] = std::max(q.lowest, x[k] - step);
  high[k] = std::min(q.highest, x[k] + step);
  for (const auto* side : {&high, &low})
    for (std::size_t w = 0; w < pieces_.size(); ++w) {
      auto part = jacobian.block(pieces_[w].row, k, problem_.measured[w].size(), 1);
      if (side == &high)
        part = residuals(w, high, start_of(x, w));
      else
        part = (part - residuals(w, low, start_of(x, w))).eval() / (high[k] - low[k]);
    }
}

void Shooting::evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
  if (last_.x.size() != x.size() || x != last_.x) {
    last_ = {{}, Eigen::VectorXd(rows_)};
    for (std::size_t w = 0; w < pieces_.size(); ++w)
      last_.r.segment(pieces_[w].row, problem_.measured[w].size()) = residuals(w, x.head(p()), start_of(x, w));
    last_.x = x;
  }
  r = last_.r;
  if (jacobian) *jacobian = jacobian_;
}

/// Rounds of a search that holds its Jacobian, which takes one run of the record a step; each begins with a new one,
/// which takes 1 + 2p + d, unless it is where the last one was. The round that gains next to nothing from a new one,
/// and is promised no more, is the last: where steps are promised and none is found, the next round takes shorter ones.
/// (F41), (F65)
FitReport Shooting::search(Eigen::VectorXd& x) {
  // Shares of the cost. A standard error of one unknown lowers it by one n-th: no step of a thirtieth of it is taken,
  // and what gains less than half of one leaves a small part of that.
  const double nothing = 1e-3 / static_cast<double>(rows_), little = 0.2 / static_cast<double>(rows_);
  using Outcome = FitReport::Outcome;
  FitReport all{};
  Eigen::VectorXd at;  // of the Jacobian
  double radius = StopWhen{}.trust_radius;
  for (bool held = jacobian_.size() > 0;; held = false) {
    if (!held && (at.size() == 0 || at != x)) jacobian_ = differences(at = x);
    const int left = problem_.iterations_reach - all.iterations;
    FitReport round = minimise(model(), x,
                               {.cost_change_below = nothing,
                                .gradient_below = 1e-9,
                                .step_below = 1e-8,
                                .iterations_reach = std::min(6, left),
                                .trust_radius = radius});
    const bool gained = round.cost_first - round.cost_last > little * round.cost_first,
               promised = round.promised * static_cast<double>(rows_) > 1,
               // Less than a ten-thousandth of the noise stated: there is nothing left to find.
        perfect = 2 * round.cost_last <= 1e-8 * static_cast<double>(rows_),
               last = !held && (perfect || (!gained && (!promised || round.outcome == Outcome::stuck)));
    // After a step of full length that failed, one of half that length and less.
    if (!held) radius = gained ? round.trust_radius : std::min(1.0, round.trust_radius);
    if (all.iterations > 0) round.cost_first = all.cost_first;
    round.iterations += all.iterations;
    all = std::move(round);
    if (last && (perfect || !promised)) {
      all.outcome = Outcome::converged;
      all.why = perfect ? "residuals of a ten-thousandth of the deviations stated"
                        : fmt::format("a new Jacobian lowered the cost by less than {:.2g} of it", little);
    }
    if (last || all.outcome == Outcome::not_finite) return all;
    if (all.iterations < problem_.iterations_reach) continue;
    all.outcome = Outcome::out_of_iterations;  // whatever the last round ended by
    return all;
  }
}

Eigen::MatrixXd Shooting::differences(const Eigen::VectorXd& x) {
  Eigen::VectorXd r(rows_);
  evaluate(x, r, nullptr);
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(rows_, unknowns_);
  for (std::size_t w = 0; w < pieces_.size(); ++w) {
    const auto& piece = pieces_[w];
    const Eigen::Index n = problem_.measured[w].size();
    jacobian.block(piece.row, piece.column, n, piece.seen.cols()) =
        start_columns(w, x.head(p()), start_of(x, w), r.segment(piece.row, n), piece.seen);
  }
  for (Eigen::Index k = 0; k < p(); ++k) parameter_column(k, x, jacobian);
  return jacobian;
}

ResidualModel Shooting::model() {
  ResidualModel m;
  for (const auto& q : problem_.parameters) m.parameters.push_back({q.name, q.scale(), q.lowest, q.highest});
  m.parameters.resize(static_cast<std::size_t>(unknowns_), {"start of a window"});
  m.residuals = rows_;
  m.evaluate = [this](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
    try {
      evaluate(x, r, jacobian);
    } catch (const std::runtime_error&) {  // a motion that there is not: Ceres then tries a shorter step
      r.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  };
  return m;
}

// (F43)
void Shooting::tell_identifiability(const Eigen::MatrixXd& jacobian, double unit, SimulationFit& fit) {
  Eigen::MatrixXd columns = jacobian.leftCols(p());
  for (std::size_t w = 0; w < pieces_.size(); ++w) {
    const Piece& piece = pieces_[w];
    if (piece.seen.cols() == 0) continue;
    const Eigen::Index n = problem_.measured[w].size();
    const hydro::dense::PivotedQr starts(jacobian.block(piece.row, piece.column, n, piece.seen.cols()));
    Eigen::MatrixXd own = columns.middleRows(piece.row, n);
    own -= jacobian.block(piece.row, piece.column, n, piece.seen.cols()) * starts.solve(own);
    columns.middleRows(piece.row, n) = own;
  }
  for (Eigen::Index k = 0; k < p(); ++k) columns.col(k) *= problem_.parameters[static_cast<std::size_t>(k)].scale();
  const auto svd = hydro::dense::svd(columns);
  fit.singular_values = svd.values;
  for (Eigen::Index i = 0; i < p(); ++i)
    for (Eigen::Index k = 0; k < p(); ++k)
      if (svd.values[i] < not_seen * svd.values[0] && std::abs(svd.V(k, i)) >= 0.05)
        unseen_[static_cast<std::size_t>(k)] = true;
  std::vector<std::string> parts;
  for (Eigen::Index k = 0; k < p(); ++k)
    if (const double share = svd.V(k, p() - 1); std::abs(share) >= 0.05)
      parts.push_back(fmt::format("{:.2g} {}", share, problem_.parameters[static_cast<std::size_t>(k)].name));
  fit.weakest = fmt::format(
      "the record tells {} least: were the residuals independent, one standard deviation along it would be {:.2g} of "
      "the scale",
      fmt::join(parts, " + "), unit / svd.values[p() - 1]);
}

/// Values that the record does not tell.
void Shooting::judge(const Eigen::VectorXd& x, SimulationFit& fit) const {
  for (Eigen::Index k = 0; k < p(); ++k) {
    const auto& q = problem_.parameters[static_cast<std::size_t>(k)];
    Coefficient& c = fit.parameters[static_cast<std::size_t>(k)];
    const double near = 1e-6 * q.scale();
    if (x[k] - q.lowest < near || q.highest - x[k] < near) {
      c.value.reset();
      c.why_not = fmt::format("the search ended at its bound {:.6g}", x[k]);
    } else if (unseen_[static_cast<std::size_t>(k)] || !fit.search.identifiable[static_cast<std::size_t>(k)]) {
      c.value.reset();
      c.why_not = fit.weakest;
    } else if ((c.interval.high - c.interval.low) > 20 * q.scale()) {
      c.value.reset();
      c.why_not = "its interval is wider than ten times its scale to either side";
    }
  }
}

/// Covariance of all unknowns that the data see; the others' stays zero.
void count_memory(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& r, const std::vector<bool>& seen,
                  CoefficientCovariance& out) {
  std::vector<Eigen::Index> kept;
  for (std::size_t j = 0; j < seen.size(); ++j)
    if (seen[j]) kept.push_back(static_cast<Eigen::Index>(j));
  if (kept.empty()) return;
  const auto own = correlated_covariance(jacobian(Eigen::all, kept), r, 1, LongMemory::widen);
  out.covariance(kept, kept) = own.covariance;
  out.white_covariance(kept, kept) = own.white_covariance;
  out.effective_samples(kept) = own.effective_samples;
  out.dof = own.dof;
  out.white_dof = own.white_dof;
  out.dof_raised = own.dof_raised;
}

CoefficientCovariance Shooting::covariance(const Eigen::VectorXd& r, const std::vector<bool>& identifiable) const {
  CoefficientCovariance u;
  u.covariance = u.white_covariance = Eigen::MatrixXd::Zero(unknowns_, unknowns_);
  u.effective_samples = Eigen::VectorXd::Zero(unknowns_);
  u.dof = u.white_dof = static_cast<double>(std::max<Eigen::Index>(1, rows_ - unknowns_));
  u.dof_raised = false;
  const bool perfect = r.norm() < 1e-9 * std::sqrt(static_cast<double>(rows_));
  if (!perfect) count_memory(jacobian_, r, identifiable, u);
  return u;
}

void Shooting::tell_parameters(const Eigen::VectorXd& x, const CoefficientCovariance& u, SimulationFit& fit) const {
  for (Eigen::Index k = 0; k < p(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    Coefficient c = with_interval(problem_.parameters[at].name, x[k], u, k, problem_.confidence);
    if (!fit.search.identifiable[at]) {
      c.standard_error = std::numeric_limits<double>::infinity();
      c.interval = c.white_interval = {-c.standard_error, c.standard_error};
    }
    fit.parameters.push_back(std::move(c));
  }
  const Eigen::MatrixXd own = u.covariance.topLeftCorner(p(), p());
  const Eigen::VectorXd over = own.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  fit.correlation = over.asDiagonal() * own * over.asDiagonal();
  fit.dof = u.dof;
  if (u.dof_raised)
    fit.caution =
        "what is left hardly forgets within the record: it is an error of the model more than noise, and the intervals "
        "are as wide as two independent residuals make them";
}

void Shooting::tell_motion(const Eigen::VectorXd& x, const Eigen::VectorXd& r, SimulationFit& fit) const {
  const auto deviations = Eigen::Map<const Eigen::RowVectorXd>(problem_.deviations.data(), channels());
  Eigen::RowVectorXd squares = Eigen::RowVectorXd::Zero(channels());
  for (std::size_t w = 0; w < pieces_.size(); ++w) {
    const auto& measured = problem_.measured[w];
    const Eigen::MatrixXd left =
        r.segment(pieces_[w].row, measured.size()).reshaped(measured.rows(), channels()) * deviations.asDiagonal();
    squares += left.cwiseAbs2().colwise().sum();
    fit.motion.emplace_back(measured + left);
    fit.starts.push_back(start_of(x, w));
  }
  for (const double s : squares)
    fit.rms.push_back(std::sqrt(s * static_cast<double>(channels()) / static_cast<double>(rows_)));
}

/// What the fit is uncertain by at each sample, and what a new sample would scatter by beside it. (F46)
void Shooting::tell_bands(const CoefficientCovariance& u, SimulationFit& fit) const {
  const double quantile = hydro::signal::student_t_quantile((1 + problem_.confidence) / 2, u.dof);
  double inside = 0;
  for (std::size_t w = 0; w < pieces_.size(); ++w) {
    const auto& measured = problem_.measured[w];
    const auto rows = jacobian_.middleRows(pieces_[w].row, measured.size());
    const Eigen::VectorXd variance = (rows * u.covariance).cwiseProduct(rows).rowwise().sum().cwiseMax(0);
    Eigen::MatrixXd of_fit = variance.reshaped(measured.rows(), channels()), of_sample = of_fit;
    for (Eigen::Index c = 0; c < channels(); ++c) {
      const auto at = static_cast<std::size_t>(c);
      of_fit.col(c) *= std::pow(problem_.deviations[at], 2);
      of_sample.col(c) = of_fit.col(c).array() + std::pow(fit.rms[at], 2);
    }
    fit.fit_band.emplace_back(quantile * of_fit.cwiseSqrt());
    fit.sample_band.emplace_back(quantile * of_sample.cwiseSqrt());
    inside +=
        static_cast<double>(((fit.motion[w] - measured).cwiseAbs().array() <= fit.sample_band[w].array()).count());
  }
  fit.inside = inside / static_cast<double>(rows_);
}

void Shooting::tell(const Eigen::VectorXd& x, SimulationFit& fit) {
  Eigen::VectorXd r(rows_);
  evaluate(x, r, nullptr);
  const CoefficientCovariance u = covariance(r, fit.search.identifiable);
  tell_parameters(x, u, fit);
  const double unit = r.norm() / std::sqrt(static_cast<double>(std::max<Eigen::Index>(1, rows_ - unknowns_)));
  tell_identifiability(jacobian_, unit, fit);
  judge(x, fit);
  tell_motion(x, r, fit);
  compare_with_stated(r, fit);
  if (fit.refused.empty())
    tell_bands(u, fit);
  else
    refuse(fit);
}

/// (F65), (F66)
void Shooting::compare_with_stated(const Eigen::VectorXd& r, SimulationFit& fit) const {
  const double taken = static_cast<double>(unknowns_) / static_cast<double>(rows_);
  for (Eigen::Index c = 0; c < channels(); ++c) {
    Eigen::VectorXd own(rows_ / channels());
    Eigen::Index filled = 0;
    for (std::size_t w = 0; w < pieces_.size(); ++w) {
      const Eigen::Index n = problem_.measured[w].rows();
      own.segment(filled, n) = r.segment(pieces_[w].row + c * n, n);
      filled += n;
    }
    const double deviation = problem_.deviations[static_cast<std::size_t>(c)];
    fit.stated.push_back(against_stated(own * deviation, deviation, taken));
  }
  fit.refused = why_unended(fit.search);
  if (!fit.refused.empty() || problem_.accept_residuals) return;
  for (std::size_t c = 0; c < fit.stated.size(); ++c)
    if (const auto& s = fit.stated[c]; fit.refused.empty() && !s.hold())
      fit.refused =
          fmt::format("channel {} differs by {:.3g} rms; its deviation is stated as {:.3g}, which allows {:.3g}", c + 1,
                      s.rms, s.stated, s.allowed);
}

void Shooting::refuse(SimulationFit& fit) const {
  for (Coefficient& c : fit.parameters) withhold(c, fit.refused);
}

SimulationFit Shooting::solve() {  // (F41)
  SimulationFit fit{};
  Eigen::VectorXd x = problem_.begin ? go_on(problem_.begin->end) : find_starts();
  hydro::require(rows_ > unknowns_,
                 "{} samples cannot give {} parameters and {} numbers of starts: take longer windows", rows_, p(),
                 unknowns_ - p());
  Eigen::VectorXd r(rows_);
  evaluate(x, r, nullptr);  // what the first values cannot do is told as it is
  fit.search = search(x);
  fit.starts_seen = unknowns_ - p();
  fit.starts_all = all_starts_;
  tell(x, fit);
  fit.windows_followed = followed_;
  fit.end = {std::move(x), {}, jacobian_};
  for (const Piece& piece : pieces_) fit.end.seen.push_back(piece.seen);
  return fit;
}

double Shooting::least_cost() {
  Eigen::VectorXd x = problem_.begin ? go_on(problem_.begin->end) : find_starts();
  if (unknowns_ > 0) {
    const FitReport report = search(x);
    if (report.outcome != FitReport::Outcome::not_finite) require_ended(report, "all else at a value of the profile");
    return report.cost_last;
  }
  double squares = 0;
  for (std::size_t w = 0; w < pieces_.size(); ++w) squares += residuals(w, x, start_of(x, w)).squaredNorm();
  return squares / 2;
}

/// A simulation of which one parameter is held.
class Held final : public Simulation {
 public:
  Held(Simulation& whole, std::size_t parameter, double value)
      : whole_(whole), parameter_(static_cast<Eigen::Index>(parameter)), value_(value) {}
  Eigen::Index coordinates(std::size_t window) override { return whole_.coordinates(window); }
  Eigen::MatrixXd follow(std::size_t window, const Eigen::VectorXd& others, const Eigen::VectorXd& start) override {
    return whole_.follow(window, with(others), start);
  }
  void hand_on(std::size_t window, const Eigen::VectorXd& others, const Eigen::VectorXd& start) override {
    whole_.hand_on(window, with(others), start);
  }

 private:
  Eigen::VectorXd with(const Eigen::VectorXd& others) const {
    Eigen::VectorXd all(others.size() + 1);
    all << others.head(parameter_), value_, others.tail(others.size() - parameter_);
    return all;
  }
  Simulation& whole_;
  Eigen::Index parameter_;
  double value_;
};

/// Where the search for the others begins: at the end of `fit`, without the parameter that is held.
SimulationFit without(const SimulationFit& fit, std::size_t parameter) {
  SimulationFit out{};
  out.end.seen = fit.end.seen;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index j = 0; j < fit.end.unknowns.size(); ++j)
    if (j != static_cast<Eigen::Index>(parameter)) kept.push_back(j);
  out.end.unknowns = fit.end.unknowns(kept);
  out.end.jacobian = fit.end.jacobian(Eigen::all, kept);
  return out;
}

// Of the prime number of its dimension: 1/2, 1/4, 3/4 …; 1/3, 2/3, 1/9 …
double halton(int index, std::size_t dimension) {
  constexpr int primes[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};
  hydro::require(dimension < std::size(primes), "several starts are for {} parameters at most", std::size(primes));
  const int base = primes[dimension];
  double out = 0, digit = 1;
  for (int rest = index; rest > 0; rest /= base) out += (digit /= base) * (rest % base);
  return out;
}

}  // namespace

double SimulationParameter::scale() const {
  const double range = std::isfinite(highest - lowest) ? (highest - lowest) / 10 : 0;
  const double out = std::max(std::abs(first), range);
  return out > 0 ? out : 1;
}

SimulationFit fit_simulation(Simulation& simulation, const SimulationProblem& problem) {
  hydro::require(!problem.parameters.empty(), "a fit needs a parameter at least");
  return Shooting(simulation, problem).solve();
}

Interval profile_interval(Simulation& simulation, const SimulationProblem& problem, const SimulationFit& fit,
                          std::size_t parameter) {  // (F64)
  hydro::require(parameter < fit.parameters.size() && fit.parameters[parameter].value &&
                     fit.parameters[parameter].standard_error > 0,
                 "a profile needs a parameter with a value and an error");
  const Coefficient& c = fit.parameters[parameter];
  const SimulationParameter& q = problem.parameters[parameter];
  const double value = *c.value, t = hydro::signal::student_t_quantile((1 + problem.confidence) / 2, fit.dof);
  // t² s² (n/n_eff)/2, s² = 2 C/n
  const double rise = t * t * fit.search.cost_last / std::max(1.0, c.effective_samples);
  const SimulationFit begin = without(fit, parameter);
  SimulationProblem others = problem;
  others.parameters.erase(others.parameters.begin() + static_cast<std::ptrdiff_t>(parameter));
  others.begin = &begin;
  // Of a parabola this is straight in the distance, so that false position needs few searches.
  const auto risen = [&](double at) {
    Held held(simulation, parameter, at);
    try {
      const double cost = Shooting(held, others).least_cost() - fit.search.cost_last;
      return std::isfinite(cost) ? std::sqrt(std::max(0.0, cost) / rise) : std::numeric_limits<double>::infinity();
    } catch (const SearchFailed&) {
      throw;
    } catch (const hydro::NumericsError&) {
      return std::numeric_limits<double>::infinity();  // no motion there: the end lies before
    }
  };
  const auto end = [&](double sign) {
    const double bound = sign < 0 ? q.lowest : q.highest, farthest = value + sign * 30 * t * c.standard_error;
    double inside = value, at_inside = 0, outside = 0, at_outside = 0, at = value + sign * t * c.standard_error;
    for (int i = 0; i < 20; ++i) {
      if (sign * (at - bound) > 0) at = bound;
      const double g = risen(at);
      if (std::abs(g - 1) < 0.03 || (at == bound && g < 1)) return at;
      if (g < 1) {
        inside = at, at_inside = g;
        if (sign * (at - farthest) > 0) break;
      } else {
        outside = at, at_outside = g;
      }
      if (at_outside == 0)  // nothing outside yet
        at = value + (at - value) * std::clamp(1.02 / std::max(g, 0.1), 1.05, 3.0);
      else if (std::isinf(at_outside) || i % 4 == 3)
        at = (inside + outside) / 2;
      else
        at = inside + (outside - inside) * (1 - at_inside) / (at_outside - at_inside);
    }
    throw hydro::NumericsError(
        fmt::format("the likelihood of {} has no end within 30 standard errors of {:.6g}", q.name, value));
  };
  return {end(-1), end(1)};
}

SeveralStarts fit_simulation_from(Simulation& simulation, const SimulationProblem& problem, int starts) {  // (F58)
  hydro::require(starts >= 2 && problem.begin == nullptr, "several starts are two at least, got {}", starts);
  for (const auto& q : problem.parameters)
    hydro::require(std::isfinite(q.lowest) && std::isfinite(q.highest),
                   "{} has no bounds on both sides, between which a search could start", q.name);
  SeveralStarts out{{}, starts, 0, 0, 0};
  std::vector<double> costs;
  std::exception_ptr failure;
  for (int k = 0; k < starts; ++k) {
    SimulationProblem other = problem;
    for (std::size_t i = 0; k > 0 && i < other.parameters.size(); ++i) {
      auto& q = other.parameters[i];
      q.first = q.lowest + halton(k, i) * (q.highest - q.lowest);
    }
    try {
      SimulationFit fit = fit_simulation(simulation, other);
      costs.push_back(fit.search.cost_last);
      out.unended += !fit.search.ended();
      if (costs.back() <= *std::min_element(costs.begin(), costs.end())) out.best = std::move(fit);
    } catch (const hydro::NumericsError&) {
      failure = std::current_exception();
      ++out.failed;
    } catch (const hydro::InputError&) {
      if (k == 0) throw;  // of the problem itself; later it is a point at which there is no motion
      ++out.failed;
    }
  }
  if (costs.empty()) std::rethrow_exception(failure);
  double rows = 0;
  for (const auto& m : problem.measured) rows += static_cast<double>(m.size());
  // One standard error of one unknown raises the cost by itself over n (F41).
  const double least = *std::min_element(costs.begin(), costs.end());
  out.agree = static_cast<int>(
      std::count_if(costs.begin(), costs.end(), [&](double cost) { return cost - least <= least / rows; }));
  return out;
}

}  // namespace fit
