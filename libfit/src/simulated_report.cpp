#include <algorithm>
#include <cmath>

#include "fit/correlated.hpp"
#include "fit/verdict.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"
#include "motion_bands.hpp"
#include "simulated.hpp"

namespace fit {
namespace {

/// What can be told of the end of a search.
class Told {
 public:
  Told(const SimulationProblem& problem, EndOfSearch end)
      : problem_(problem), end_(std::move(end)), told_(measured_rows(problem)) {}
  SimulationFit all();

 private:
  Eigen::Index p() const { return std::ssize(problem_.parameters); }
  Eigen::Index channels() const { return std::ssize(problem_.deviations); }
  Eigen::Index rows() const { return std::ssize(told_); }
  Eigen::Index unknowns() const { return end_.x.size(); }
  void find_covariance();
  void tell_parameters();
  void tell_motion();
  void tell_bands();
  void tell_identifiability();
  void judge();
  Eigen::MatrixXd jacobian_of_channels() const;
  void compare_with_stated();

  const SimulationProblem& problem_;
  EndOfSearch end_;
  std::vector<Eigen::Index> told_;  // rows that were measured
  CoefficientCovariance covariance_;
  std::vector<bool> unseen_ = std::vector<bool>(problem_.parameters.size(), false);
  SimulationFit fit_{};
};

// (F43)
void Told::tell_identifiability() {
  const Eigen::MatrixXd& jacobian = end_.jacobian;
  const double unit = end_.r.norm() / std::sqrt(static_cast<double>(std::max<Eigen::Index>(1, rows() - unknowns())));
  Eigen::MatrixXd columns = jacobian.leftCols(p());
  for (std::size_t w = 0; w < end_.windows.size(); ++w) {
    const WindowOfSearch& piece = end_.windows[w];
    if (piece.seen.cols() == 0) continue;
    const Eigen::Index n = problem_.measured[w].size();
    const hydro::dense::PivotedQr starts(jacobian.block(piece.row, piece.column, n, piece.seen.cols()));
    Eigen::MatrixXd own = columns.middleRows(piece.row, n);
    own -= jacobian.block(piece.row, piece.column, n, piece.seen.cols()) * starts.solve(own);
    columns.middleRows(piece.row, n) = own;
  }
  for (Eigen::Index k = 0; k < p(); ++k) columns.col(k) *= problem_.parameters[static_cast<std::size_t>(k)].scale();
  const auto svd = hydro::dense::svd(columns);
  fit_.singular_values = svd.values;
  for (Eigen::Index i = 0; i < p(); ++i)
    for (Eigen::Index k = 0; k < p(); ++k)
      if (svd.values[i] < not_seen_by_differences * svd.values[0] && std::abs(svd.V(k, i)) >= 0.05)
        unseen_[static_cast<std::size_t>(k)] = true;
  std::vector<std::string> parts;
  for (Eigen::Index k = 0; k < p(); ++k)
    if (const double share = svd.V(k, p() - 1); std::abs(share) >= 0.05)
      parts.push_back(fmt::format("{:.2g} {}", share, problem_.parameters[static_cast<std::size_t>(k)].name));
  fit_.weakest = fmt::format(
      "the record tells {} least: were the residuals independent, one standard deviation along it would be {:.2g} of "
      "the scale",
      fmt::join(parts, " + "), unit / svd.values[p() - 1]);
}

/// Values that the record does not tell.
void Told::judge() {
  for (Eigen::Index k = 0; k < p(); ++k) {
    const auto& q = problem_.parameters[static_cast<std::size_t>(k)];
    Coefficient& c = fit_.parameters[static_cast<std::size_t>(k)];
    const double near = 1e-6 * q.scale();
    if (end_.x[k] - q.lowest < near || q.highest - end_.x[k] < near) {
      c.value.reset();
      c.why_not = fmt::format("the search ended at its bound {:.6g}", end_.x[k]);
    } else if (unseen_[static_cast<std::size_t>(k)] || !fit_.search.identifiable[static_cast<std::size_t>(k)]) {
      c.value.reset();
      c.why_not = fit_.weakest;
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

void Told::find_covariance() {
  CoefficientCovariance& u = covariance_;
  const Eigen::VectorXd r = end_.r(told_);
  u.covariance = u.white_covariance = Eigen::MatrixXd::Zero(unknowns(), unknowns());
  u.effective_samples = Eigen::VectorXd::Zero(unknowns());
  u.dof = u.white_dof = static_cast<double>(std::max<Eigen::Index>(1, rows() - unknowns()));
  u.dof_raised = false;
  const bool perfect = r.norm() < 1e-9 * std::sqrt(static_cast<double>(rows()));
  if (!perfect) count_memory(end_.jacobian(told_, Eigen::all), r, end_.search.identifiable, u);
}

void Told::tell_parameters() {
  const CoefficientCovariance& u = covariance_;
  for (Eigen::Index k = 0; k < p(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    Coefficient c = with_interval(problem_.parameters[at].name, end_.x[k], u, k, problem_.confidence);
    if (!fit_.search.identifiable[at]) {
      c.standard_error = std::numeric_limits<double>::infinity();
      c.interval = c.white_interval = {-c.standard_error, c.standard_error};
    }
    fit_.parameters.push_back(std::move(c));
  }
  const Eigen::MatrixXd own = u.covariance.topLeftCorner(p(), p());
  const Eigen::VectorXd over = own.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  fit_.correlation = over.asDiagonal() * own * over.asDiagonal();
  fit_.dof = u.dof;
  if (u.dof_raised)
    fit_.caution =
        "what is left hardly forgets within the record: it is an error of the model more than noise, and the intervals "
        "are as wide as two independent residuals make them";
}

void Told::tell_motion() {
  const auto deviations = Eigen::Map<const Eigen::RowVectorXd>(problem_.deviations.data(), channels());
  Eigen::RowVectorXd squares = Eigen::RowVectorXd::Zero(channels()), samples = squares;
  for (std::size_t w = 0; w < end_.windows.size(); ++w) {
    const auto& measured = problem_.measured[w];
    if (end_.motion.empty())
      fit_.motion.emplace_back(
          measured + end_.r.segment(end_.windows[w].row, measured.size()).reshaped(measured.rows(), channels()) *
                         deviations.asDiagonal());
    else
      fit_.motion.push_back(std::move(end_.motion[w]));
    const Eigen::ArrayXXd left = (fit_.motion.back() - measured).array();
    squares += left.isNaN().select(0, left).square().colwise().sum().matrix();
    samples += (!left.isNaN()).cast<double>().colwise().sum().matrix();
    fit_.starts.push_back(end_.start(w));
  }
  for (Eigen::Index c = 0; c < channels(); ++c) fit_.rms.push_back(std::sqrt(squares[c] / std::max(1.0, samples[c])));
}

/// Of the channels themselves over their deviations: zero where nothing was measured. (F101)
Eigen::MatrixXd Told::jacobian_of_channels() const {
  if (problem_.whitening.empty()) return end_.jacobian;
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(end_.jacobian.rows(), end_.jacobian.cols());
  for (std::size_t w = 0; w < end_.windows.size(); ++w) {
    const Eigen::Index n = problem_.measured[w].rows();
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::MatrixXd& whitening = problem_.whitening[w][static_cast<std::size_t>(i)];
      std::vector<Eigen::Index> read, row;
      for (Eigen::Index c = 0; c < channels(); ++c)
        if (!whitening.row(c).isZero(0)) {
          read.push_back(c);
          row.push_back(end_.windows[w].row + c * n + i);
        }
      if (!read.empty())
        out(row, Eigen::all) = hydro::dense::inverse(whitening(read, read)) * end_.jacobian(row, Eigen::all);
    }
  }
  return out;
}

void Told::tell_bands() {  // (F46)
  std::vector<Eigen::MatrixXd> left;
  for (std::size_t w = 0; w < fit_.motion.size(); ++w) left.emplace_back(fit_.motion[w] - problem_.measured[w]);
  const double quantile = hydro::signal::student_t_quantile((1 + problem_.confidence) / 2, covariance_.dof);
  auto bands =
      motion_bands(left, jacobian_of_channels(), covariance_.covariance, problem_.deviations, fit_.rms, quantile);
  fit_.fit_band = std::move(bands.of_fit);
  fit_.sample_band = std::move(bands.of_sample);
  fit_.inside = bands.inside;
}

/// (F65), (F66)
void Told::compare_with_stated() {
  const double taken = static_cast<double>(unknowns()) / static_cast<double>(rows());
  for (Eigen::Index c = 0; c < channels(); ++c) {
    std::vector<Eigen::Index> own_rows;
    for (std::size_t w = 0; w < end_.windows.size(); ++w) {
      const Eigen::Index n = problem_.measured[w].rows(), begin = end_.windows[w].row + c * n;
      const auto from = std::lower_bound(told_.begin(), told_.end(), begin);
      own_rows.insert(own_rows.end(), from, std::lower_bound(from, told_.end(), begin + n));
    }
    const Eigen::VectorXd own = end_.r(own_rows);
    const double deviation = problem_.deviations[static_cast<std::size_t>(c)];
    fit_.stated.push_back(against_stated(own * deviation, deviation, taken));
  }
  fit_.refused = why_unended(fit_.search);
  if (!fit_.refused.empty() || problem_.accept_residuals) return;
  for (std::size_t c = 0; c < fit_.stated.size(); ++c)
    if (const auto& s = fit_.stated[c]; fit_.refused.empty() && !s.hold())
      fit_.refused =
          fmt::format("channel {} differs by {:.3g} rms; its deviation is stated as {:.3g}, which allows {:.3g}", c + 1,
                      s.rms, s.stated, s.allowed);
}

SimulationFit Told::all() {
  fit_.search = end_.search;
  fit_.starts_seen = unknowns() - p();
  fit_.starts_all = end_.starts_all;
  fit_.windows_followed = end_.followed;
  find_covariance();
  tell_parameters();
  tell_identifiability();
  judge();
  tell_motion();
  compare_with_stated();
  if (fit_.refused.empty())
    tell_bands();
  else
    for (Coefficient& c : fit_.parameters) withhold(c, fit_.refused);
  for (const WindowOfSearch& w : end_.windows) fit_.end.seen.push_back(w.seen);
  fit_.end.unknowns = std::move(end_.x);
  fit_.end.jacobian = std::move(end_.jacobian);
  return std::move(fit_);
}

}  // namespace

SimulationFit told(const SimulationProblem& problem, EndOfSearch end) { return Told(problem, std::move(end)).all(); }

}  // namespace fit
