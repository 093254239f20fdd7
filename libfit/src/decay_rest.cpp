#include "decay_rest.hpp"

#include <algorithm>
#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"
#include "swings.hpp"

namespace fit {
namespace {

constexpr std::size_t omega_at = 0, friction_at = 4, offset_at = 5;  // among the parameters of an oscillator

/// What a record goes on as: the mean of its last tenth, and the largest distance from it.
struct Tail {
  double mean, farthest;
};
Tail tail_of(const Window& record) {
  const Eigen::Index n = record.values.rows();
  const Eigen::ArrayXd tail = record.values.col(0).tail(std::max<Eigen::Index>(1, n / 10)).array();
  return {tail.mean(), (tail - tail.mean()).abs().maxCoeff()};
}

/// The samples up to the last that is half as far again from the mean of the tail as anything in it: noise of a record
/// that has come to rest is no swing, whatever its memory.
Window swinging(const Window& record) {
  const Tail tail = tail_of(record);
  Eigen::Index n = record.values.rows();
  while (n > 0 && std::abs(record.values(n - 1, 0) - tail.mean) <= 1.5 * tail.farthest) --n;
  constexpr Eigen::Index least = 32;  // fewer tell no damping
  return n < least ? record : Window{record.step, Eigen::MatrixXd(record.values.topRows(n))};
}

/// Frequency, damping and place of rest that the swings of a record give by energy, (F34), (F35), which extremes of its
/// noise at rest would spoil; those of the problem where they are too few.
std::vector<double> start_by_energy(const ShootingProblem& swings) {
  const Window& w = swings.windows[0];
  std::vector<double> time(static_cast<std::size_t>(w.values.rows()));
  for (std::size_t j = 0; j < time.size(); ++j) time[j] = w.step * static_cast<double>(j);
  std::vector<double> out = swings.start;
  try {
    const auto extremes = find_swings(time, {w.values.data(), time.size()});
    const auto& on = swings.fitted;
    const EnergyFit energy =
        fit_energy(extremes, {.linear = on[1], .quadratic = on[2], .cubic = on[3], .coulomb = on[friction_at]});
    out[omega_at] = energy.omega;
    if (on[offset_at]) out[offset_at] = logarithmic_decrement(extremes).offset;
    auto told = energy.damping.begin();
    for (std::size_t k = 1; k <= friction_at; ++k)
      if (on[k]) out[k] = std::max(0.0, *(told++)->value);
  } catch (const hydro::InputError&) {
    return swings.start;
  }
  return out;
}

/// The fit of what swings alone, which no rest bends.
std::optional<ShootingFit> fit_of_swings(const ShootingProblem& decay) {
  ShootingProblem swings = decay;
  for (Window& w : swings.windows) w = swinging(w);
  swings.start = start_by_energy(swings);
  auto fit = fit_from(swings);
  return fit && fit->search.all_identifiable() ? fit : std::nullopt;
}

/// The parameters of a fit with so many standard errors more friction, and all else where it follows.
std::vector<double> with_more_friction(const ShootingProblem& decay, const ShootingFit& fit, double errors) {
  std::vector<double> out = fit.ended;
  const auto at = std::count(decay.fitted.begin(), decay.fitted.begin() + friction_at, true);
  Eigen::Index column = 0;
  for (std::size_t k = 0; k < out.size(); ++k)
    if (decay.fitted[k]) out[k] += errors * fit.correlation(column++, at) * fit.parameters[k].standard_error;
  return out;
}

/// Whether the likelihood of the best end cannot exclude another one, in which a parameter differs by more than a tenth
/// of its error: the same end, come to from elsewhere, differs by less.
bool rivals(const ShootingFit& other, const ShootingFit& best, double confidence) {
  const Coefficient& friction = best.parameters[friction_at];
  if (!(friction.standard_error > 0)) return false;  // a motion without noise has one end, but for rounding
  const double t = hydro::signal::student_t_quantile((1 + confidence) / 2, best.dof);
  // As in (F37): the scatter is 2C/n and residuals with a memory are worth so many independent ones.
  const double rise = t * t * best.search.cost_last / std::max(1.0, friction.effective_samples);
  if (other.search.cost_last - best.search.cost_last > rise) return false;
  for (std::size_t k = 0; k < best.parameters.size(); ++k)
    if (std::abs(other.ended[k] - best.ended[k]) > 0.1 * best.parameters[k].standard_error) return true;
  return false;
}

/// Makes an interval hold that of another end, and the standard error that of the wider interval.
void hold(const Coefficient& other, Coefficient& c) {
  const double before = c.interval.high - c.interval.low;
  c.interval = {std::min(c.interval.low, other.interval.low), std::max(c.interval.high, other.interval.high)};
  if (before > 0) c.standard_error *= (c.interval.high - c.interval.low) / before;
}

}  // namespace

std::optional<ShootingFit> fit_from(const ShootingProblem& start) {
  try {
    return fit_motion(start);
  } catch (const hydro::NumericsError&) {
    return {};
  }
}

std::vector<ShootingProblem> starts_of_rests(const ShootingProblem& decay) {  // (F114)
  const auto swings = fit_of_swings(decay);
  const double rest = tail_of(decay.windows[0]).mean;
  std::vector<ShootingProblem> out;
  for (const double errors : {0.0, -1.0, 1.0, -2.0, 2.0}) {
    ShootingProblem next = decay;
    if (swings)
      next.start = with_more_friction(decay, *swings, errors);
    else
      next.start[friction_at] *= std::pow(1.2, errors);  // a fifth apart, for want of an error
    if (!(next.start[friction_at] > 0)) continue;
    out.push_back(next);
    if (!decay.fitted[offset_at]) continue;
    // It rests where the spring is weaker than the friction, within c/ω² of the place to which the spring pulls; five
    // errors from where the swings have that place it is not.
    const double reach = next.start[friction_at] / (next.start[omega_at] * next.start[omega_at]),
                 middle = next.start[offset_at],
                 far = swings ? 5 * swings->parameters[offset_at].standard_error : reach;
    for (const double of_reach : {-0.9, -0.5, -0.1, 0.1, 0.5, 0.9}) {
      next.start[offset_at] = rest + of_reach * reach;
      if (std::abs(next.start[offset_at] - middle) < std::max(far, 0.2 * reach)) out.push_back(next);
    }
  }
  return out;
}

Window before_rest(const Window& record, const Eigen::MatrixXd& motion) {
  const Eigen::Index last = motion.rows() - 1;
  Eigen::Index n = last;
  while (n > 0 && motion(n - 1, 0) == motion(last, 0)) --n;
  return {record.step, Eigen::MatrixXd(record.values.topRows(n + 1))};
}

BestEnd best_of(std::vector<ShootingFit> ends, double confidence) {
  const auto by_cost = [](const ShootingFit& a, const ShootingFit& b) {
    return a.search.cost_last < b.search.cost_last;
  };
  const auto which = static_cast<std::size_t>(std::min_element(ends.begin(), ends.end(), by_cost) - ends.begin());
  BestEnd out{which, ends[which], false};
  for (const ShootingFit& other : ends) {
    if (!rivals(other, ends[which], confidence)) continue;
    out.has_rivals = true;
    for (std::size_t k = 0; k < out.fit.parameters.size(); ++k) hold(other.parameters[k], out.fit.parameters[k]);
  }
  if (out.has_rivals)
    out.fit.caution =
        "the motion comes to rest, and other numbers of half cycles before that fit as well: the intervals hold those "
        "of all of them";
  return out;
}

}  // namespace fit
