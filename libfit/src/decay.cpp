#include "fit/decay.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "decay_rest.hpp"
#include "fit/differentiate.hpp"
#include "fit/verdict.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"
#include "restored_body.hpp"
#include "swings.hpp"

namespace fit {
namespace {

using std::numbers::pi;

/// Vertex of the parabola through sample j and its neighbours.
Extreme vertex(std::span<const double> time, std::span<const double> x, std::size_t j) {
  if (j == 0 || j + 1 == x.size()) return {time[j], x[j]};
  const double slope = (x[j + 1] - x[j - 1]) / 2, bend = x[j + 1] - 2 * x[j] + x[j - 1];
  const double s = bend == 0 ? 0 : std::clamp(-slope / bend, -1.0, 1.0);
  return {time[j] + s * (time[j + 1] - time[j]), x[j] + s * slope / 2};
}

/// Rest position: extremes on both sides of it, each against the mean of its neighbours.
double offset_of(std::span<const Extreme> e) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < e.size(); ++i) sum += (e[i - 1].value + 2 * e[i].value + e[i + 1].value) / 4;
  return sum / static_cast<double>(e.size() - 2);
}

double mean_period(std::span<const Extreme> e) {
  return 2 * (e.back().time - e.front().time) / static_cast<double>(e.size() - 1);
}

const char* const term_names[] = {"linear", "quadratic", "cubic", "coulomb"};
std::vector<std::size_t> chosen(const DampingTerms& t) {
  std::vector<std::size_t> out;
  const bool on[] = {t.linear, t.quadratic, t.cubic, t.coulomb};
  for (std::size_t k = 0; k < 4; ++k)
    if (on[k]) out.push_back(k);
  return out;
}

/// What each term takes from the amplitude a in half a cycle; (F35).
double half_cycle_loss(std::size_t term, double a, double omega) {
  switch (term) {
    case 0:
      return pi * a / (2 * omega);
    case 1:
      return 4.0 / 3 * a * a;
    case 2:
      return 3 * pi / 8 * omega * a * a * a;
    default:
      return 2 / (omega * omega);
  }
}

}  // namespace

Coefficient judged(Coefficient c) {
  if (c.value && c.interval.low <= 0 && c.interval.high >= 0) {
    c.why_not = fmt::format("the record cannot tell it from zero ({:.3g} to {:.3g})", c.interval.low, c.interval.high);
    c.value.reset();
  }
  return c;
}

namespace {

/// Extremes of swings that go beyond `least` of the largest, or beyond `least_value` where that is more, on either side
/// of the rest position: what noise does about that position is no swing. (F34)
std::vector<Extreme> extremes_beyond(std::span<const double> time, std::span<const double> x, double least,
                                     double least_value) {
  hydro::require(time.size() == x.size() && x.size() >= 16, "extremes need 16 samples at least, got {}", x.size());
  // The rest position, roughly: the mean of the last third, where swings are small.
  const std::size_t tail = x.size() - x.size() / 3;
  const double rest = std::accumulate(x.begin() + static_cast<std::ptrdiff_t>(tail), x.end(), 0.0) /
                      static_cast<double>(x.size() - tail);
  double largest = 0;
  for (const double v : x) largest = std::max(largest, std::abs(v - rest));
  const double beyond = std::max(least * largest, least_value);
  std::vector<Extreme> out;
  std::size_t best = 0;
  bool crossed = false;  // since the best
  const auto close = [&] {
    // A swing that begins with the record and falls from its first sample has no extreme of its own.
    if (best > 0 && std::abs(x[best] - rest) > beyond) out.push_back(vertex(time, x, best));
  };
  for (std::size_t j = 1; j < x.size(); ++j) {
    const bool across = (x[j] - rest) * (x[best] - rest) < 0;
    crossed |= across;
    if (across && std::abs(x[j] - rest) > beyond) {
      close();
      best = j;
      crossed = false;
    } else if (!across && std::abs(x[j] - rest) > std::abs(x[best] - rest)) {
      best = j;
      crossed = false;
    }
  }
  if (crossed) close();
  hydro::require(out.size() >= 2, "the record holds {} extremes; two are needed", out.size());
  return out;
}

}  // namespace

std::vector<Extreme> find_extremes(std::span<const double> time, std::span<const double> x, double least) {
  return extremes_beyond(time, x, least, 0);
}

std::vector<Extreme> find_swings(std::span<const double> time, std::span<const double> x) {  // (F34)
  constexpr double least = 0.03, stands_out = 5, allowed_off = 1e-3;
  std::vector<Extreme> raw = find_extremes(time, x, least);
  if (x.size() < 64) return raw;
  const LocalPolynomial smooth = smoother_of(x, time[1] - time[0]);
  const auto m = static_cast<std::size_t>(smooth.half_width());
  std::vector<Extreme> out = extremes_beyond(time.subspan(m, time.size() - 2 * m), smooth.apply(x), least,
                                             stands_out * noise_in(x, smooth) * smooth.noise_gain());
  return std::abs(smooth.gain(2 * pi / mean_period(out)) - 1) < allowed_off ? out : raw;
}

Decrement logarithmic_decrement(std::span<const Extreme> e) {  // (F34)
  hydro::require(e.size() >= 3, "a decrement needs three extremes, got {}", e.size());
  Decrement d{{}, {}, offset_of(e), mean_period(e)};
  for (std::size_t i = 0; i + 1 < e.size(); ++i) {
    const double a = std::abs(e[i].value - d.offset), b = std::abs(e[i + 1].value - d.offset), delta = std::log(a / b);
    d.amplitude.push_back((a + b) / 2);
    d.ratio.push_back(delta / std::hypot(pi, delta));
  }
  return d;
}

EnergyFit fit_energy(std::span<const Extreme> e, const DampingTerms& terms, double confidence) {  // (F35)
  const auto wanted = chosen(terms);
  hydro::require(!wanted.empty(), "there is no damping to fit");
  hydro::require(e.size() >= wanted.size() + 3, "{} extremes cannot give {} damping terms with an error", e.size(),
                 wanted.size());
  const double omega = 2 * pi / mean_period(e), offset = offset_of(e);
  const auto n = static_cast<Eigen::Index>(e.size()) - 1, p = static_cast<Eigen::Index>(wanted.size());
  Eigen::MatrixXd a(n, p);
  Eigen::VectorXd lost(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double before = std::abs(e[k].value - offset), after = std::abs(e[k + 1].value - offset);
    lost[i] = before - after;
    for (Eigen::Index j = 0; j < p; ++j)
      a(i, j) = half_cycle_loss(wanted[static_cast<std::size_t>(j)], (before + after) / 2, omega);
  }
  const Eigen::VectorXd x = hydro::dense::PivotedQr(a).solve(lost), r = lost - a * x;
  EnergyFit fit{{}, omega, std::sqrt(r.squaredNorm() / static_cast<double>(n))};
  const Eigen::MatrixXd covariance =
      r.squaredNorm() / static_cast<double>(n - p) * hydro::dense::inverse(a.transpose() * a);
  const double t = hydro::signal::student_t_quantile((1 + confidence) / 2, static_cast<double>(n - p));
  for (Eigen::Index j = 0; j < p; ++j) {
    Coefficient c;
    c.name = term_names[wanted[static_cast<std::size_t>(j)]];
    c.value = x[j];
    c.standard_error = std::sqrt(covariance(j, j));
    c.interval = {x[j] - t * c.standard_error, x[j] + t * c.standard_error};
    c.white_interval = c.interval;
    c.effective_samples = static_cast<double>(n);
    fit.damping.push_back(c);
  }
  return fit;
}

namespace {

/// What the records are worth to the frequency, by the residuals of the fullest damping that is smooth: those of a
/// damping that lacks a term have a longer memory, which is an error of the model. 0 where that fit has no end.
double independent_samples(const ShootingProblem& asked, const ShootingFit& motion) {
  ShootingProblem fullest = asked;
  for (const std::size_t k : {1, 2, 3}) fullest.fitted[k] = true;
  fullest.fitted[4] = false;
  fullest.start[4] = 0;
  if (fullest.fitted == asked.fitted) return std::max(motion.parameters[0].effective_samples, 10.0);
  for (const std::size_t k : {0, 1, 2, 3, 5}) fullest.start[k] = motion.ended[k];
  try {
    return std::max(fit_motion(fullest).parameters[0].effective_samples, 10.0);
  } catch (const hydro::NumericsError&) {
    return 0;
  }
}

/// Independent samples stand for the likelihood; the variance of one is that of the residuals. (F33)
void judge(double unknowns, DecayFit& fit) {
  const double n = fit.independent, k = unknowns;
  fit.aicc = fit.bic = std::numeric_limits<double>::infinity();
  if (n == 0) return;
  const double minus2 = n * std::log(fit.motion.rms[0] * fit.motion.rms[0]);
  fit.bic = minus2 + k * std::log(n);
  if (n > k + 1) fit.aicc = minus2 + 2 * k + 2 * k * (k + 1) / (n - k - 1);
}

/// The swings of a record, or all of its extremes where so few stand out that they tell no damping.
struct Swings {
  std::vector<Extreme> extremes;
  bool stand_out;
};
Swings swings_of(const Window& record, std::size_t least) {
  std::vector<double> time(static_cast<std::size_t>(record.values.rows()));
  for (std::size_t j = 0; j < time.size(); ++j) time[j] = record.step * static_cast<double>(j);
  const std::span<const double> values(record.values.data(), time.size());
  try {
    if (auto swings = find_swings(time, values); swings.size() >= least) return {std::move(swings), true};
  } catch (const hydro::InputError&) {  // fewer than two stand out
  }
  return {find_extremes(time, values), false};
}

/// Where the search begins besides what energy gives, if that ends nowhere or explains too little: no damping, and the
/// linear one that halves a swing in five.
std::vector<ShootingProblem> plain_starts(const ShootingProblem& first) {
  std::vector<ShootingProblem> out;
  for (const double share : {0.0, std::numbers::ln2 / (5 * pi)}) {
    ShootingProblem other = first;
    std::fill(other.start.begin() + 1, other.start.begin() + 5, 0.0);
    if (other.fitted[1]) other.start[1] = share * 2 * other.start[0];
    out.push_back(std::move(other));
  }
  return out;
}

/// The end with the least cost; with Coulomb friction, of all numbers of half cycles that may come before a rest.
/// `problem` becomes the one that it was found from.
BestEnd best_fit(ShootingProblem& problem) {
  std::vector<ShootingProblem> from;
  std::vector<ShootingFit> ends;
  const auto try_from = [&](const ShootingProblem& start) {
    auto end = fit_from(start);
    if (!end) return;
    from.push_back(start);
    ends.push_back(std::move(*end));
  };
  const ShootingProblem first = problem;
  try_from(first);
  if (ends.empty() || ends[0].explained[0] < least_explained)
    for (const ShootingProblem& start : plain_starts(first)) try_from(start);
  if (first.fitted[4])
    for (const ShootingProblem& start : starts_of_rests(first)) try_from(start);
  if (ends.empty()) return {0, fit_motion(first), false};  // which says why it fails
  BestEnd best = best_of(std::move(ends), first.confidence);
  problem = from[best.which];
  return best;
}

}  // namespace

DecayFit fit_decay(std::span<const Window> records, const DecayOptions& options) {
  hydro::require(!records.empty() && records[0].values.cols() == 1, "a decay needs records of one channel");
  const auto [extremes, stand_out] =
      swings_of(records[0], static_cast<std::size_t>(options.terms.count()) + 3);  // as many as fit_energy() needs
  DecayFit fit{};
  fit.energy = fit_energy(extremes, options.terms, options.confidence);
  const auto terms = chosen(options.terms);

  ShootingProblem problem{.law = options.pendulum ? MotionLaw::pendulum : MotionLaw::oscillator,
                          .windows = {records.begin(), records.end()},
                          .deviations = {1.0},
                          .start = {fit.energy.omega, 0, 0, 0, 0, offset_of(extremes)},
                          .fitted = {true, false, false, false, false, options.fit_offset},
                          .substeps = options.substeps,
                          .confidence = options.confidence};
  double largest = 0;
  for (const Extreme& e : extremes) largest = std::max(largest, std::abs(e.value - problem.start[5]));
  problem.deviations[0] = 0.01 * largest;  // a common scale of residuals: one channel, so no weight
  for (std::size_t k = 0; k < terms.size(); ++k) {
    problem.fitted[1 + terms[k]] = true;
    // What energy takes for negative would feed the motion, and the search with it.
    problem.start[1 + terms[k]] = std::max(0.0, *fit.energy.damping[k].value);
  }
  if (!stand_out) fit.energy.damping.clear();  // it served for a start, and tells nothing
  BestEnd best = best_fit(problem);
  fit.motion = std::move(best.fit);
  fit.several_ends = best.has_rivals;
  fit.problem = problem;
  for (const std::size_t k : terms) fit.damping.push_back(judged(fit.motion.parameters[1 + k]));
  const Coefficient& omega = fit.motion.parameters[0];
  fit.period = omega;
  fit.period.name = "period";
  fit.period.value = 2 * pi / *omega.value;
  fit.period.standard_error = *fit.period.value * omega.standard_error / *omega.value;
  fit.period.interval = {2 * pi / omega.interval.high, 2 * pi / omega.interval.low};
  fit.period.white_interval = {2 * pi / omega.white_interval.high, 2 * pi / omega.white_interval.low};
  for (const Window& w : records) fit.samples += static_cast<double>(w.values.rows());
  fit.independent = independent_samples(problem, fit.motion);
  judge(static_cast<double>(terms.size()) + 4, fit);
  return fit;
}

}  // namespace fit
