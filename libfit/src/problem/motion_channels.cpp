#include "motion_channels.hpp"

#include <fmt/format.h>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "hydro/base/error.hpp"
#include "hydro/signal/welch.hpp"

namespace fit::motion {
namespace {

/// Something that may be wrong with a record, and the record with that put right.
struct Suspicion {
  std::string what;
  std::vector<Eigen::MatrixXd> corrected;
  double likely;  ///< correlation with the fitted motion that it gains
};

double correlation(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const Eigen::VectorXd x = a.array() - a.mean(), y = b.array() - b.mean();
  const double both = x.norm() * y.norm();
  return both > 0 ? x.dot(y) / both : 0;
}

Eigen::VectorXd joined(const std::vector<Eigen::MatrixXd>& windows, Eigen::Index column) {
  Eigen::Index rows = 0;
  for (const auto& w : windows) rows += w.rows();
  Eigen::VectorXd out(rows);
  Eigen::Index at = 0;
  for (const auto& w : windows) {
    out.segment(at, w.rows()) = w.col(column);
    at += w.rows();
  }
  return out;
}

void put_back(const Eigen::VectorXd& values, Eigen::Index column, std::vector<Eigen::MatrixXd>& windows) {
  Eigen::Index at = 0;
  for (auto& w : windows) {
    w.col(column) = values.segment(at, w.rows());
    at += w.rows();
  }
}

/// x(t + τ) of samples, straight between them and beyond the ends; τ in samples.
Eigen::VectorXd earlier(const Eigen::VectorXd& x, double samples) {
  Eigen::VectorXd out(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double at = static_cast<double>(i) + samples;
    const auto left = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(std::floor(at)), 0, x.size() - 2);
    out[i] = x[left] + (at - static_cast<double>(left)) * (x[left + 1] - x[left]);
  }
  return out;
}

/// By how many samples a record follows a motion: where they correlate most, of all delays up to a tenth of the record.
double delay_of(const Eigen::VectorXd& record, const Eigen::VectorXd& motion) {
  const Eigen::Index n = record.size(), longest = n / 10;
  double best = -1, out = 0;
  for (Eigen::Index lag = -longest; lag <= longest; ++lag) {
    const Eigen::Index behind = std::max<Eigen::Index>(0, lag), ahead = std::max<Eigen::Index>(0, -lag);
    const double r = correlation(record.segment(behind, n - behind - ahead), motion.segment(ahead, n - behind - ahead));
    if (r > best) best = r, out = static_cast<double>(lag);
  }
  return out;
}

/// What remains of a delay, by the slope of the fitted motion: r ≈ −τẋ.
double delay_left(const Eigen::VectorXd& record, const Eigen::VectorXd& motion) {
  const Eigen::Index n = motion.size();
  const Eigen::VectorXd slope = (motion.tail(n - 2) - motion.head(n - 2)) / 2;
  const double squares = slope.squaredNorm();
  return squares > 0 ? (motion - record).segment(1, n - 2).dot(slope) / squares : 0;
}

/// Channels of one unit that stand in each other's place.
void suspect_exchanges(const Problem& problem, const SimulationFit& failed, std::vector<Suspicion>& out) {
  for (std::size_t a = 0; a < problem.signals.size(); ++a)
    for (std::size_t b = a + 1; b < problem.signals.size(); ++b) {
      if (problem.signals[a].unit != problem.signals[b].unit) continue;
      const auto i = static_cast<Eigen::Index>(a), j = static_cast<Eigen::Index>(b);
      Suspicion s{fmt::format("{} and {} are exchanged", problem.signals[a].name, problem.signals[b].name),
                  problem.measured, 0};
      for (auto& w : s.corrected) w.col(i).swap(w.col(j));
      for (const auto c : {i, j})
        s.likely += correlation(joined(s.corrected, c), joined(failed.motion, c)) -
                    correlation(joined(problem.measured, c), joined(failed.motion, c));
      out.push_back(std::move(s));
    }
}

void suspect_signs(const Problem& problem, const SimulationFit& failed, std::vector<Suspicion>& out) {
  for (std::size_t c = 0; c < problem.signals.size(); ++c) {
    const auto i = static_cast<Eigen::Index>(c);
    Suspicion s{fmt::format("{} has the wrong sign", problem.signals[c].name), problem.measured, 0};
    for (auto& w : s.corrected) w.col(i) *= -1;
    s.likely = -2 * correlation(joined(problem.measured, i), joined(failed.motion, i));
    out.push_back(std::move(s));
  }
}

/// The fit of a record; none where there is no motion.
std::optional<SimulationFit> fitted(const Problem& problem, SimulationProblem search,
                                    const std::vector<Eigen::MatrixXd>& record) {
  search.measured = record;
  try {
    return fit_simulation(*problem.simulation, search);
  } catch (const hydro::NumericsError&) {
    return {};
  }
}

std::string explained(const Problem& problem, const std::string& what, const SimulationFit& fit) {
  std::string left;
  for (std::size_t c = 0; c < problem.signals.size(); ++c)
    left += fmt::format("{}{} differs by {:.3g} {} rms", c == 0 ? "" : ", ", problem.signals[c].name, fit.rms[c],
                        problem.signals[c].unit);
  return fmt::format("{}: with that put right the fit ends where {}, which the deviations allow", what, left);
}

bool is_even(const std::vector<double>& time) {
  if (time.size() < 2) return false;
  try {
    hydro::signal::even_step(time);
    return true;
  } catch (const hydro::InputError&) {
    return false;
  }
}

/// A channel that is recorded later or earlier than the others, or than the run's start. Its delay is found with a fit
/// at each round, since a fit leans towards what is wrong.
std::string trouble_of_delay(const Problem& problem, const SimulationProblem& search, const SimulationFit& failed,
                             std::size_t channel) {
  constexpr int rounds = 8;
  constexpr double settled = 0.05;  // of a sample
  const std::vector<double>& time = problem.records.front().time;
  // Records of several have seams, over which a delay cannot be moved; uneven samples have no step.
  if (problem.records.size() > 1 || !is_even(time)) return {};
  const double step = time[1] - time[0];
  const auto c = static_cast<Eigen::Index>(channel);
  const Eigen::VectorXd record = joined(problem.measured, c);
  double samples = delay_of(record, joined(failed.motion, c));
  if (samples == 0) samples = delay_left(record, joined(failed.motion, c));
  std::string out;
  for (int round = 0; round < rounds; ++round) {
    std::vector<Eigen::MatrixXd> corrected = problem.measured;
    put_back(earlier(record, samples), c, corrected);
    const auto fit = fitted(problem, search, corrected);
    if (!fit) break;
    if (fit->refused.empty())
      out = explained(problem,
                      fmt::format("{} is recorded {:.2g} s {}", problem.signals[channel].name, step * std::abs(samples),
                                  samples > 0 ? "late" : "early"),
                      *fit);
    const double left = delay_left(joined(corrected, c), joined(fit->motion, c));
    if (std::abs(left) < settled) break;
    samples += left;
  }
  return out;
}

}  // namespace

std::string trouble_of_channels(const Problem& problem, const SimulationProblem& search,
                                const SimulationFit& failed) {  // (F77)
  constexpr std::size_t searches = 6;                           // each costs as much as the fit that failed
  std::vector<Suspicion> all;
  suspect_exchanges(problem, failed, all);
  suspect_signs(problem, failed, all);
  std::stable_sort(all.begin(), all.end(), [](const Suspicion& a, const Suspicion& b) { return a.likely > b.likely; });
  if (all.size() > searches) all.erase(all.begin() + searches, all.end());
  for (const Suspicion& s : all)
    if (const auto fit = fitted(problem, search, s.corrected); fit && fit->refused.empty())
      return explained(problem, s.what, *fit);
  for (std::size_t c = 0; c < std::min<std::size_t>(2, problem.signals.size()); ++c)
    if (std::string late = trouble_of_delay(problem, search, failed, c); !late.empty()) return late;
  return {};
}

}  // namespace fit::motion
