#include "simulated.hpp"

#include <algorithm>
#include <cmath>

#include "fit/verdict.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"

namespace fit {
namespace {

// Differences: a start moves by so much, a parameter by so much of its scale. Simulations solve to about 1e-9, so the
// quotient of a difference of 1e-5 is good to 1e-4, and its bend adds as little.
constexpr double start_step = 1e-5, parameter_step = 1e-4;

// A start is read from so many samples: within them a motion is a place and a velocity, and hardly more.
constexpr Eigen::Index first_samples = 9;

/// Rows of some first samples of a window, of each channel.
std::vector<Eigen::Index> rows_of_first(Eigen::Index wanted, Eigen::Index samples, Eigen::Index channels) {
  std::vector<Eigen::Index> out;
  for (Eigen::Index c = 0; c < channels; ++c)
    for (Eigen::Index i = 0; i < std::min(wanted, samples); ++i) out.push_back(c * samples + i);
  return out;
}

/// Whether all that counts is there: without whitening everything, else what is not NaN and has matrices of its shape.
bool is_measured(const SimulationProblem& problem, std::size_t w) {
  const auto& m = problem.measured[w];
  if (problem.whitening.empty()) return m.allFinite();
  const auto& all = problem.whitening[w];
  if (std::ssize(all) != m.rows()) return false;
  Eigen::Index told = 0;
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    const auto& one = all[static_cast<std::size_t>(i)];
    if (one.rows() != m.cols() || one.cols() != m.cols() || !one.allFinite()) return false;
    for (Eigen::Index c = 0; c < m.cols(); ++c)
      if (!std::isfinite(m(i, c)) && !one.col(c).isZero(0)) return false;
    told += !one.isZero(0);
  }
  return told >= 8;
}

class Shooting {
 public:
  Shooting(Simulation& simulation, const SimulationProblem& problem) : simulation_(simulation), problem_(problem) {
    check();
    for (std::size_t k = 0; k < problem.parameters.size(); ++k) first_.push_back(problem.parameters[k].first);
  }

  EndOfSearch end();
  std::vector<Eigen::MatrixXd> motions(const Eigen::VectorXd& theta);
  double least_cost();  ///< that of end(), which tells more of it
  double cost_nearby();
  Eigen::VectorXd residuals_of(const SimulationFit& fit);

 private:
  Eigen::Index p() const { return std::ssize(problem_.parameters); }
  Eigen::VectorXd first() const { return Eigen::Map<const Eigen::VectorXd>(first_.data(), p()); }
  Eigen::VectorXd start_of(const Eigen::VectorXd& x, std::size_t w) const {
    const WindowOfSearch& piece = pieces_[w];
    return piece.seen * x.segment(piece.column, piece.seen.cols());
  }
  void check() const;
  Eigen::MatrixXd motion_of(std::size_t w, const Eigen::VectorXd& theta, const Eigen::VectorXd& start);
  Eigen::VectorXd residuals(std::size_t w, const Eigen::VectorXd& theta, const Eigen::VectorXd& start);
  Eigen::MatrixXd start_columns(std::size_t w, const Eigen::VectorXd& theta, const Eigen::VectorXd& start,
                                const Eigen::VectorXd& here, const Eigen::MatrixXd& directions);
  void look_at_start(std::size_t w, Eigen::Index row, Eigen::Index column);
  Eigen::VectorXd from_first_samples(std::size_t w);
  Eigen::VectorXd begin_of(std::size_t w);
  Eigen::VectorXd settle(std::size_t w);
  Eigen::VectorXd find_starts();
  Eigen::VectorXd go_on(const SimulationFit::End& end);
  double cost_of_nothing_fitted();
  SearchReport search(Eigen::VectorXd& x);
  void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian);
  Eigen::MatrixXd differences(const Eigen::VectorXd& x);
  void parameter_column(Eigen::Index k, const Eigen::VectorXd& x, Eigen::MatrixXd& jacobian);
  ResidualModel model();

  Simulation& simulation_;
  const SimulationProblem& problem_;
  std::vector<double> first_;
  std::vector<WindowOfSearch> pieces_;
  Eigen::Index rows_ = 0, unknowns_ = 0, all_starts_ = 0;
  long followed_ = 0;
  struct {
    Eigen::VectorXd x, r;
  } last_;                    // a search asks for the same point several times
  Eigen::MatrixXd jacobian_;  // held while a round of the search goes on
};

void Shooting::check() const {
  hydro::require(!problem_.measured.empty(), "a fit needs a record at least");
  hydro::require(problem_.whitening.empty() || problem_.whitening.size() == problem_.measured.size(),
                 "{} windows have {} lists of whitening matrices", problem_.measured.size(), problem_.whitening.size());
  for (const auto& q : problem_.parameters)
    hydro::require(q.lowest < q.highest && q.first >= q.lowest && q.first <= q.highest && std::isfinite(q.first),
                   "{} begins at {}, which must lie between {} and {}", q.name, q.first, q.lowest, q.highest);
  for (std::size_t w = 0; w < problem_.measured.size(); ++w) {
    const auto& m = problem_.measured[w];
    hydro::require(m.rows() >= 8 && m.cols() == std::ssize(problem_.deviations) && is_measured(problem_, w),
                   "a window needs 8 samples at least of {} channels, all finite; got {} of {}",
                   problem_.deviations.size(), m.rows(), m.cols());
  }
  for (const double d : problem_.deviations) hydro::require(d > 0, "a channel's deviation must be positive, got {}", d);
  hydro::require(problem_.periods.empty() || problem_.periods.size() == problem_.deviations.size(),
                 "{} channels have {} periods", problem_.deviations.size(), problem_.periods.size());
  for (const double period : problem_.periods)
    hydro::require(period >= 0, "a channel's period must not be negative, got {}", period);
}

/// A column moved by whole periods, sample by sample, to where it is nearest to what was measured; where nothing was,
/// by as many as before.
void to_nearest_period(double period, const Eigen::Ref<const Eigen::VectorXd>& measured,
                       Eigen::Ref<Eigen::VectorXd> motion) {
  double moved = 0;
  for (Eigen::Index i = 0; i < motion.size(); ++i) {
    if (std::isfinite(measured[i])) moved = period * std::round((measured[i] - motion[i]) / period);
    motion[i] += moved;
  }
}

/// Of one window, as measured.
Eigen::MatrixXd Shooting::motion_of(std::size_t w, const Eigen::VectorXd& theta, const Eigen::VectorXd& start) {
  ++followed_;
  Eigen::MatrixXd motion = simulation_.follow(w, theta, start);
  const Eigen::MatrixXd& measured = problem_.measured[w];
  hydro::require(motion.rows() == measured.rows() && motion.cols() == measured.cols(),
                 "the simulation gave {} samples of {} channels, {} of {} were measured", motion.rows(), motion.cols(),
                 measured.rows(), measured.cols());
  for (std::size_t c = 0; c < problem_.periods.size(); ++c)
    if (const auto column = static_cast<Eigen::Index>(c); problem_.periods[c] > 0)
      to_nearest_period(problem_.periods[c], measured.col(column), motion.col(column));
  return motion;
}

/// Of one window over the deviations, one channel after the other.
Eigen::VectorXd Shooting::residuals(std::size_t w, const Eigen::VectorXd& theta, const Eigen::VectorXd& start) {
  Eigen::MatrixXd motion = motion_of(w, theta, start) - problem_.measured[w];
  for (Eigen::Index c = 0; c < motion.cols(); ++c) motion.col(c) /= problem_.deviations[static_cast<std::size_t>(c)];
  whiten(problem_, w, motion);
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
  WindowOfSearch piece{Eigen::MatrixXd::Identity(d, d), row, column};
  all_starts_ += d;
  if (d > 0) {
    Eigen::MatrixXd columns(problem_.measured[w].size(), d);
    for (Eigen::Index j = 0; j < d; ++j) {
      const Eigen::VectorXd step = start_step * Eigen::VectorXd::Unit(d, j);
      columns.col(j) = (residuals(w, first(), step) - residuals(w, first(), -step)) / (2 * start_step);
    }
    const auto svd = hydro::dense::svd(columns);
    Eigen::Index seen = 0;
    while (seen < d && svd.values[seen] > not_seen_by_differences * svd.values[0]) ++seen;
    piece.seen = svd.V.leftCols(seen);
  }
  pieces_.push_back(std::move(piece));
}

/// (F75) Where the first samples contradict what was handed on, by more than chance, the start is theirs; along
/// directions that they do not tell it stays as it was handed on.
Eigen::VectorXd Shooting::from_first_samples(std::size_t w) {
  constexpr double told = 0.01, beyond_chance = 3;  // of the strongest direction; in deviations
  const WindowOfSearch& piece = pieces_[w];
  const auto& measured = problem_.measured[w];
  const auto rows = rows_of_first(first_samples, measured.rows(), measured.cols());
  Eigen::VectorXd z = Eigen::VectorXd::Zero(piece.seen.cols()), r = residuals(w, first(), piece.seen * z);
  const auto svd = hydro::dense::svd(start_columns(w, first(), piece.seen * z, r, piece.seen)(rows, Eigen::all));
  for (int round = 0; round < 4; ++round) {
    const Eigen::VectorXd against = svd.U.transpose() * r(rows);
    Eigen::VectorXd step = Eigen::VectorXd::Zero(z.size());
    for (Eigen::Index i = 0; i < against.size(); ++i)
      if (svd.values[i] > told * svd.values[0] && std::abs(against[i]) > beyond_chance)
        step -= against[i] / svd.values[i] * svd.V.col(i);
    if (step.isZero(0)) break;
    z += step;
    r = residuals(w, first(), piece.seen * z);
  }
  return z;
}

/// Of what was handed on and what the first samples tell, the one that follows the first quarter of the window better.
Eigen::VectorXd Shooting::begin_of(std::size_t w) {
  const WindowOfSearch& piece = pieces_[w];
  const auto& measured = problem_.measured[w];
  const Eigen::VectorXd handed_on = Eigen::VectorXd::Zero(piece.seen.cols());
  if (handed_on.size() == 0) return handed_on;
  const auto quarter = rows_of_first(std::max(first_samples, measured.rows() / 4), measured.rows(), measured.cols());
  const auto missed = [&](const Eigen::VectorXd& z) { return residuals(w, first(), piece.seen * z)(quarter).norm(); };
  try {
    const Eigen::VectorXd told = from_first_samples(w);
    return missed(told) < missed(handed_on) ? told : handed_on;
  } catch (const hydro::NumericsError&) {
    return handed_on;  // from what the first samples tell there is no motion
  }
}

/// The start of one window fitted alone, with the parameters at their first values: to its first quarter, to its first
/// half, and to all of it, since what lies far ahead pulls a wrong start to a wrong minimum (F41).
Eigen::VectorXd Shooting::settle(std::size_t w) {
  const WindowOfSearch& piece = pieces_[w];
  const Eigen::Index samples = problem_.measured[w].rows();
  Eigen::VectorXd z = begin_of(w);
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

/// Each window begins where the one before ended, or where its first samples are, and settles on its own samples before
/// it is handed on.
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
      if (!simulation_.moves(w, static_cast<std::size_t>(k))) continue;
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
SearchReport Shooting::search(Eigen::VectorXd& x) {
  // Shares of the cost. A standard error of one unknown lowers it by one n-th: no step of a thirtieth of it is taken,
  // and what gains less than half of one leaves a small part of that.
  const double nothing = 1e-3 / static_cast<double>(rows_), little = 0.2 / static_cast<double>(rows_);
  using Outcome = SearchReport::Outcome;
  SearchReport all{};
  Eigen::VectorXd at;  // of the Jacobian
  double radius = StopWhen{}.trust_radius;
  for (bool held = jacobian_.size() > 0;; held = false) {
    if (!held && (at.size() == 0 || at != x)) jacobian_ = differences(at = x);
    const int left = problem_.iterations_reach - all.iterations;
    SearchReport round = minimise(model(), x,
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

EndOfSearch Shooting::end() {  // (F41)
  Eigen::VectorXd x = problem_.begin ? go_on(problem_.begin->end) : find_starts();
  hydro::require(rows_ > unknowns_,
                 "{} samples cannot give {} parameters and {} numbers of starts: take longer windows", rows_, p(),
                 unknowns_ - p());
  Eigen::VectorXd r(rows_);
  evaluate(x, r, nullptr);  // what the first values cannot do is told as it is
  SearchReport report = search(x);
  evaluate(x, r, nullptr);
  std::vector<Eigen::MatrixXd> motion;
  if (!problem_.whitening.empty())
    for (std::size_t w = 0; w < pieces_.size(); ++w) motion.push_back(motion_of(w, x.head(p()), start_of(x, w)));
  return {std::move(report), std::move(x), std::move(r), jacobian_, pieces_, all_starts_, followed_, std::move(motion)};
}

std::vector<Eigen::MatrixXd> Shooting::motions(const Eigen::VectorXd& theta) {
  hydro::require(theta.size() == p(), "{} parameters have {} values", p(), theta.size());
  std::vector<Eigen::MatrixXd> out;
  for (std::size_t w = 0; w < problem_.measured.size(); ++w) {
    hydro::require(simulation_.coordinates(w) == 0, "a window with a start of its own cannot be followed unfitted");
    out.push_back(motion_of(w, theta, Eigen::VectorXd(0)));
  }
  return out;
}

double Shooting::least_cost() {
  Eigen::VectorXd x = problem_.begin ? go_on(problem_.begin->end) : find_starts();
  if (unknowns_ > 0) {
    const SearchReport report = search(x);
    if (report.outcome != SearchReport::Outcome::not_finite)
      require_ended(report, "all else at a value of the profile");
    return report.cost_last;
  }
  return cost_of_nothing_fitted();
}

double Shooting::cost_of_nothing_fitted() {
  double squares = 0;
  for (std::size_t w = 0; w < pieces_.size(); ++w)
    squares += residuals(w, Eigen::VectorXd(0), Eigen::VectorXd::Zero(pieces_[w].seen.rows())).squaredNorm();
  return squares / 2;
}

double Shooting::cost_nearby() {
  Eigen::VectorXd x = go_on(problem_.begin->end);
  if (unknowns_ == 0) return cost_of_nothing_fitted();
  return minimise(model(), x, {.gradient_below = 1e-9, .step_below = 1e-8, .iterations_reach = 2}).cost_last;
}

Eigen::VectorXd Shooting::residuals_of(const SimulationFit& fit) {
  Eigen::VectorXd r(fit.end.jacobian.rows());
  Eigen::Index row = 0;
  for (std::size_t w = 0; w < problem_.measured.size(); ++w) {
    const Eigen::VectorXd own = residuals(w, fit.end.unknowns.head(p()), fit.starts.at(w));
    r.segment(row, own.size()) = own;
    row += own.size();
  }
  return r;
}

}  // namespace

void whiten(const SimulationProblem& problem, std::size_t window, Eigen::MatrixXd& residuals) {  // (F101)
  if (problem.whitening.empty()) return;
  for (Eigen::Index i = 0; i < residuals.rows(); ++i) {
    const Eigen::VectorXd own = residuals.row(i).array().isNaN().select(0, residuals.row(i)).transpose();
    residuals.row(i) = (problem.whitening[window][static_cast<std::size_t>(i)] * own).transpose();
  }
}

std::vector<Eigen::Index> measured_rows(const SimulationProblem& problem) {
  std::vector<Eigen::Index> out;
  Eigen::Index row = 0;
  for (std::size_t w = 0; w < problem.measured.size(); ++w)
    for (Eigen::Index c = 0; c < problem.measured[w].cols(); ++c)
      for (Eigen::Index i = 0; i < problem.measured[w].rows(); ++i, ++row)
        if (problem.whitening.empty() || !problem.whitening[w][static_cast<std::size_t>(i)].row(c).isZero(0))
          out.push_back(row);
  return out;
}

EndOfSearch search_simulation(Simulation& simulation, const SimulationProblem& problem) {
  return Shooting(simulation, problem).end();
}

std::vector<Eigen::MatrixXd> follow_all(Simulation& simulation, const SimulationProblem& problem,
                                        const Eigen::VectorXd& parameters) {
  return Shooting(simulation, problem).motions(parameters);
}

Eigen::VectorXd residuals_at_end(Simulation& simulation, const SimulationProblem& problem, const SimulationFit& fit) {
  return Shooting(simulation, problem).residuals_of(fit);
}

double least_cost(Simulation& simulation, const SimulationProblem& problem) {
  return Shooting(simulation, problem).least_cost();
}

double cost_nearby(Simulation& simulation, const SimulationProblem& problem) {
  return Shooting(simulation, problem).cost_nearby();
}

}  // namespace fit
