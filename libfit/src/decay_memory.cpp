#include "fit/decay_memory.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <optional>

#include "fit/verdict.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"
#include "restored_body.hpp"

namespace fit {
namespace {

// θ of MotionLaw::with_radiation_memory.
enum Theta { omega0, linear, quadratic, cubic, offset, strength, decay, frequency, thetas };
using Parameters = Eigen::Matrix<double, thetas, 1>;

struct PolePair {
  double strength, decay, frequency;
};

/// κ that gives the damping b at the frequency ω: Re k̂(iω) = 2ακω²/((ω_p² − ω²)² + 4α²ω²).
PolePair with_damping(double b, double decay, double frequency, double omega) {
  const double gap = frequency * frequency - omega * omega, d = gap * gap + std::pow(2 * decay * omega, 2);
  return {b * d / (2 * decay * omega * omega), decay, frequency};
}

ShootingProblem problem_of(std::span<const Window> records, const DecayMemoryOptions& options, const DecayFit& plain,
                           const PolePair& start) {
  // (1 + Im k̂/ω) (M + A∞) is what swings: it tells ω₀ from the frequency of the swing.
  const double omega = *plain.motion.parameters[0].value, gap = std::pow(start.frequency, 2) - omega * omega,
               d = gap * gap + std::pow(2 * start.decay * omega, 2);
  ShootingProblem p{.law = MotionLaw::with_radiation_memory,
                    .windows = {records.begin(), records.end()},
                    .deviations = plain.problem.deviations,
                    .start = std::vector<double>(thetas, 0.0),
                    .fitted = std::vector<bool>(thetas, true),
                    .substeps = options.substeps,
                    .confidence = options.confidence,
                    .lowest = std::vector<double>(thetas, -std::numeric_limits<double>::infinity()),
                    .hidden_states_fitted = !options.starts_empty};
  p.start[omega0] = omega * std::sqrt(std::max(0.1, 1 + start.strength * gap / d));
  p.start[strength] = start.strength;
  p.start[decay] = start.decay;
  p.start[frequency] = start.frequency;
  p.fitted[linear] = options.terms.linear;
  p.fitted[quadratic] = options.terms.quadratic;
  p.fitted[cubic] = options.terms.cubic;
  p.fitted[offset] = options.fit_offset;
  p.start[quadratic] = options.terms.quadratic ? plain.motion.parameters[2].value.value_or(0) : 0;
  p.start[cubic] = options.terms.cubic ? plain.motion.parameters[3].value.value_or(0) : 0;
  p.start[offset] = plain.motion.parameters[5].value.value_or(0);
  // A pair of poles that feeds the motion, or grows, is no water.
  for (const Theta k : {strength, decay, frequency}) p.lowest[k] = 0;
  return p;
}

/// Of starts below, at and above the frequency of the swing, the end of least cost.
void search(std::span<const Window> records, const DecayMemoryOptions& options, const DecayFit& plain,
            DecayMemoryFit& fit) {
  const double omega = *plain.motion.parameters[0].value,
               b = std::max(plain.motion.parameters[1].value.value_or(0), 1e-3 * omega);
  bool found = false;
  std::optional<SearchFailed> unended;                  // the lowest of them
  const double share = options.terms.linear ? 0.5 : 1;  // of the damping that is the memory's at first
  for (const double factor : {0.6, 1.0, 1.8}) {
    ShootingProblem p =
        problem_of(records, options, plain, with_damping(share * b, 0.5 * factor * omega, factor * omega, omega));
    p.start[linear] = (1 - share) * b;
    try {
      ShootingFit motion = fit_motion(p);
      if (found && !(motion.search.cost_last < fit.motion.search.cost_last)) continue;
      fit.motion = std::move(motion);
      fit.problem = p;
      found = true;
    } catch (const SearchFailed& e) {
      if (!unended || e.cost() < unended->cost()) unended = e;
    } catch (const hydro::NumericsError&) {  // this start's motion runs away; the others may not
    }
  }
  // What came to an end above the place where another was still under way is not the least.
  if (unended && !(found && fit.motion.search.cost_last <= unended->cost())) throw SearchFailed(*unended);
  if (!found) throw hydro::NumericsError("a decay with a memory runs away from all its starts");
}

Parameters theta_of(const DecayMemoryFit& fit) { return Eigen::Map<const Parameters>(fit.motion.ended.data()); }

/// The eigenvalue of the linear part that is next to iω.
std::complex<double> swing_of(const Parameters& q, double omega) {
  Eigen::Matrix4d a;
  a << 0, 1, 0, 0, -q[omega0] * q[omega0], -q[linear], 0, -q[strength], 0, 0, 0, 1, 0, 1, -q[frequency] * q[frequency],
      -2 * q[decay];
  const Eigen::Vector4cd values = hydro::dense::eigenvalues(a);
  std::complex<double> best = values[0];
  for (const auto& v : values)
    if (std::abs(v - std::complex<double>(0, omega)) < std::abs(best - std::complex<double>(0, omega))) best = v;
  return best;
}

/// Errors of the fitted parameters, shape (8, 8), zero where one is not fitted.
Eigen::Matrix<double, thetas, thetas> covariance_of(const DecayMemoryFit& fit) {
  Eigen::Matrix<double, thetas, thetas> c = Eigen::Matrix<double, thetas, thetas>::Zero();
  std::vector<Eigen::Index> own;
  for (std::size_t k = 0; k < thetas; ++k)
    if (fit.problem.fitted[k]) own.push_back(static_cast<Eigen::Index>(k));
  const auto error = [&](Eigen::Index k) { return fit.motion.parameters[static_cast<std::size_t>(k)].standard_error; };
  for (std::size_t i = 0; i < own.size(); ++i)
    for (std::size_t j = 0; j < own.size(); ++j)
      c(own[i], own[j]) = error(own[i]) * error(own[j]) *
                          fit.motion.correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  return c;
}

/// (F60) What is known of each direction of the parameters over their values; the rest position is a place and no size.
void tell_directions(DecayMemoryFit& fit) {
  const Parameters theta = theta_of(fit);
  const auto all = covariance_of(fit);
  const auto names = parameters_of(MotionLaw::with_radiation_memory);
  std::vector<Eigen::Index> own;
  for (Eigen::Index k = 0; k < thetas; ++k)
    if (fit.problem.fitted[static_cast<std::size_t>(k)] && k != offset && theta[k] != 0) own.push_back(k);
  const auto p = static_cast<Eigen::Index>(own.size());
  Eigen::MatrixXd relative(p, p);
  for (Eigen::Index i = 0; i < p; ++i)
    for (Eigen::Index j = 0; j < p; ++j) {
      const Eigen::Index a = own[static_cast<std::size_t>(i)], b = own[static_cast<std::size_t>(j)];
      relative(i, j) = all(a, b) / (theta[a] * theta[b]);
    }
  if (p == 0 || !relative.allFinite() || relative.isZero(0)) return;
  const auto [values, vectors] = hydro::dense::symmetric_eigen(relative);
  // Rounding may make the smallest of them negative: that direction is known to rounding.
  fit.singular_values = values.cwiseMax(std::numeric_limits<double>::min()).cwiseSqrt().cwiseInverse();
  std::vector<std::string> parts;
  for (Eigen::Index k = 0; k < p; ++k)
    if (const double share = vectors(k, p - 1); std::abs(share) >= 0.05)
      parts.push_back(
          fmt::format("{:.2g} {}", share, names[static_cast<std::size_t>(own[static_cast<std::size_t>(k)])]));
  fit.weakest = fmt::format("the record tells {} least, over their values: one standard deviation along it is {:.2g}",
                            fmt::join(parts, " + "), std::sqrt(values[p - 1]));
}

DecayOptions options_of(const DampingTerms& terms, const DecayMemoryOptions& options) {
  return {
      .terms = terms, .fit_offset = options.fit_offset, .confidence = options.confidence, .substeps = options.substeps};
}

double penalty(double k, double n) { return 2 * k + 2 * k * (k + 1) / (n - k - 1); }

/// AICc that the memory gains over the plain fit, both with the number of independent samples that the fuller one has.
double gain_of(const DecayFit& plain, const DecayMemoryFit& fit) {
  const auto unknowns = [](const ShootingProblem& p, std::size_t states) {
    return static_cast<double>(static_cast<std::size_t>(std::count(p.fitted.begin(), p.fitted.end(), true)) +
                               states * p.windows.size() + 1);
  };
  const double k0 = unknowns(plain.problem, 2), k1 = unknowns(fit.problem, fit.problem.hidden_states_fitted ? 4 : 2);
  std::vector<double> worth;
  for (std::size_t k = 0; k < thetas; ++k)
    if (fit.problem.fitted[k]) worth.push_back(fit.motion.parameters[k].effective_samples);
  std::nth_element(worth.begin(), worth.begin() + std::ssize(worth) / 2, worth.end());
  const double n = std::max(worth[worth.size() / 2], k1 + 3);
  return 2 * n * std::log(plain.motion.rms[0] / fit.motion.rms[0]) + penalty(k0, n) - penalty(k1, n);
}

void judge(DecayMemoryFit& fit) {
  for (const Theta k : {strength, decay, frequency}) {
    Coefficient c = judged(fit.motion.parameters[k]);
    if (c.value && fit.gain < 2) {
      c.value.reset();
      c.why_not = fmt::format(
          "a damping without a memory, linear or quadratic too, does as well: the memory lowers AICc by {:.2g}, and by "
          "2 "
          "where it is told",
          fit.gain);
    }
    fit.memory.push_back(c);
  }
  // One of the three alone says nothing of the water.
  const auto missing = std::find_if(fit.memory.begin(), fit.memory.end(), [](const auto& c) { return !c.value; });
  if (missing == fit.memory.end()) return;
  const std::string name = missing->name, why = missing->why_not;
  for (Coefficient& c : fit.memory)
    if (c.value) {
      c.value.reset();
      c.why_not = fmt::format("{} is not known: {}", name, why);
    }
}

}  // namespace

DecayMemoryFit fit_decay_memory(std::span<const Window> records, const DecayMemoryOptions& options) {  // (F59)
  hydro::require(!options.terms.coulomb, "a decay with a memory knows no Coulomb friction");
  DampingTerms with_linear = options.terms;
  with_linear.linear = true;
  const DecayFit plain = fit_decay(records, options_of(with_linear, options));
  DecayMemoryFit fit{};
  search(records, options, plain, fit);
  const bool on[] = {options.terms.linear, options.terms.quadratic, options.terms.cubic};
  for (std::size_t k = 0; k < 3; ++k)
    if (on[k]) fit.damping.push_back(judged(fit.motion.parameters[linear + k]));
  const auto swing = swing_of(theta_of(fit), *plain.motion.parameters[0].value);
  fit.omega = swing.imag();
  fit.rate = -swing.real();
  tell_directions(fit);
  fit.gain = gain_of(plain, fit);
  if (!with_linear.quadratic) {  // what a quadratic damping does to a decay must not be taken for a memory
    with_linear.quadratic = true;
    fit.gain = std::min(fit.gain, gain_of(fit_decay(records, options_of(with_linear, options)), fit));
  }
  judge(fit);
  return fit;
}

DecayRadiation radiation_of(const DecayMemoryFit& fit, const RestoredBody& body, double omega,
                            double confidence) {  // (F61)
  check(body);
  hydro::require(body.stiffness > 0 && omega > 0, "a stiffness and a frequency are needed, got {} and {}",
                 body.stiffness, omega);
  using Pair = Eigen::Vector2d;
  const auto values = [&](const Parameters& q) -> Pair {
    const double swings = body.stiffness / (q[omega0] * q[omega0]);
    if (std::isinf(omega)) return {swings - body.mass, swings * q[linear]};
    const double gap = q[frequency] * q[frequency] - omega * omega, d = gap * gap + std::pow(2 * q[decay] * omega, 2);
    return {swings * (1 + q[strength] * gap / d) - body.mass,
            swings * (q[linear] + 2 * q[decay] * q[strength] * omega * omega / d)};
  };
  const Parameters theta = theta_of(fit);
  Eigen::Matrix<double, 2, thetas> slope = Eigen::Matrix<double, 2, thetas>::Zero();
  for (Eigen::Index k = 0; k < thetas; ++k) {
    if (!fit.problem.fitted[static_cast<std::size_t>(k)] || k == offset) continue;
    // Central difference of a smooth closed form: a step of 1e-6 costs 1e-10 of it.
    const double step = 1e-6 * std::max(1e-3, std::abs(theta[k]));
    Parameters up = theta, down = theta;
    up[k] += step;
    down[k] -= step;
    slope.col(k) = (values(up) - values(down)) / (2 * step);
  }
  const Pair at = values(theta);
  const Eigen::Matrix2d scatter = slope * covariance_of(fit) * slope.transpose();
  const double t = hydro::signal::student_t_quantile((1 + confidence) / 2, fit.motion.dof);
  const double stiff = (at[0] + body.mass) * body.stiffness_error, heavy = body.mass * body.mass_error;
  DecayRadiation out{
      omega,
      with_parts("added_mass", at[0], std::sqrt(std::max(0.0, scatter(0, 0))), t, std::hypot(stiff, heavy), confidence),
      with_parts("damping", at[1], std::sqrt(std::max(0.0, scatter(1, 1))), t, std::abs(at[1]) * body.stiffness_error,
                 confidence)};
  for (Coefficient* c : {&out.added_mass, &out.damping}) {
    if (fit.memory[0].value) continue;
    c->value.reset();
    c->why_not = fit.memory[0].why_not;
  }
  return out;
}

}  // namespace fit
