#include "shooting.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/correlated.hpp"
#include "fit/sensor.hpp"
#include "fit/sensor_noise.hpp"
#include "fit/shooting.hpp"
#include "fit/verdict.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"
#include "motion_bands.hpp"
#include "motion_laws.hpp"

namespace fit {
namespace {

/// Calls `use` with the model of a law.
template <class Use>
auto with_model(MotionLaw law, Use use) {
  switch (law) {
    case MotionLaw::oscillator:
      return use(Oscillator<false>{});
    case MotionLaw::pendulum:
      return use(Oscillator<true>{});
    case MotionLaw::fall:
      return use(Fall{});
    case MotionLaw::with_radiation_memory:
      return use(WithRadiationMemory{});
    case MotionLaw::double_pendulum:
      break;
  }
  return use(DoublePendulum{});
}

int states_of(MotionLaw law) {
  return with_model(law, [](const auto& model) { return std::decay_t<decltype(model)>::states; });
}

/// Where things stand in the vector of unknowns: fitted parameters first, then the initial state of each window, but
/// for hidden states that begin at zero.
struct Layout {
  std::vector<Eigen::Index> column;  // of each parameter, −1 where it is not fitted
  Eigen::Index fitted = 0, states, windows;
  Eigen::Index unknowns() const { return fitted + states * windows; }
};

Layout layout_of(const ShootingProblem& p) {
  const auto measured = 2 * static_cast<Eigen::Index>(channels_of(p.law).size());
  Layout l{{}, 0, p.hidden_states_fitted ? states_of(p.law) : measured, std::ssize(p.windows)};
  for (const bool f : p.fitted) l.column.push_back(f ? l.fitted++ : -1);
  return l;
}

/// One window: samples and, if wanted, their derivatives by parameters and initial state. False: the motion ran away.
template <class Model>
bool shoot(const Model& model, const ShootingProblem& p, const Layout& l, std::size_t w, const Eigen::VectorXd& x,
           int substeps, Eigen::MatrixXd& motion, Eigen::MatrixXd* jacobian) {
  constexpr int S = Model::states, P = Model::parameters, C = Model::channels;
  using Jet = ceres::Jet<double, S + P>;
  std::array<Jet, P> theta;
  for (int k = 0; k < P; ++k) {
    const Eigen::Index column = l.column[static_cast<std::size_t>(k)];
    theta[static_cast<std::size_t>(k)] = Jet(column < 0 ? p.start[static_cast<std::size_t>(k)] : x[column], k);
  }
  std::array<Jet, S> y;
  const Eigen::Index first = l.fitted + static_cast<Eigen::Index>(w) * l.states;
  for (int i = 0; i < S; ++i) y[static_cast<std::size_t>(i)] = i < l.states ? Jet(x[first + i], P + i) : Jet(0);
  Follower<Model, Jet> follower(model, y, theta);
  const Eigen::Index n = p.windows[w].values.rows();
  motion.resize(n, C);
  for (Eigen::Index j = 0; j < n; ++j) {
    for (int c = 0; c < C; ++c) {
      const Jet& at = follower.state()[static_cast<std::size_t>(c)];
      if (!std::isfinite(at.a) || std::abs(at.a) > 1e8) return false;
      motion(j, c) = at.a;
      if (jacobian == nullptr) continue;
      auto row = jacobian->row(c * n + j);
      for (int k = 0; k < P; ++k)
        if (l.column[static_cast<std::size_t>(k)] >= 0) row[l.column[static_cast<std::size_t>(k)]] = at.v[k];
      for (int i = 0; i < l.states; ++i) row[first + i] = at.v[P + i];
    }
    for (int k = 0; k < substeps && j + 1 < n; ++k) follower.advance(p.windows[w].step / substeps);
  }
  return true;
}

/// All windows: residuals over deviations; in each window one channel after the other. NaN where a motion ran away.
template <class Model>
void evaluate(const Model& model, const ShootingProblem& p, const Layout& l, const Eigen::VectorXd& x,
              Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
  constexpr int C = Model::channels;
  if (jacobian != nullptr) jacobian->setZero(r.size(), l.unknowns());
  Eigen::Index at = 0;
  for (std::size_t w = 0; w < p.windows.size(); ++w) {
    const Eigen::Index n = p.windows[w].values.rows();
    Eigen::MatrixXd motion, block = Eigen::MatrixXd::Zero(jacobian ? n * C : 0, l.unknowns());
    if (!shoot(model, p, l, w, x, p.substeps, motion, jacobian ? &block : nullptr)) {
      r.setConstant(std::numeric_limits<double>::quiet_NaN());
      return;
    }
    for (Eigen::Index j = 0; j < n; ++j)
      for (int c = 0; c < C; ++c) {
        const double unit = p.deviations[static_cast<std::size_t>(c)];
        r[at + c * n + j] = (motion(j, c) - p.windows[w].values(j, c)) / unit;
        if (jacobian != nullptr) jacobian->row(at + c * n + j) = block.row(c * n + j) / unit;
      }
    at += n * C;
  }
}

/// Value and rate at the first sample, from a cubic through the first samples.
Eigen::Vector2d first_state(const Eigen::VectorXd& values, double step) {
  const Eigen::Index n = std::min<Eigen::Index>(values.size(), 9);
  Eigen::MatrixXd powers(n, 4);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index k = 0; k < 4; ++k) powers(j, k) = std::pow(static_cast<double>(j), k);
  const Eigen::VectorXd c = hydro::dense::HouseholderQr(powers).solve(values.head(n));
  return {c[0], c[1] / step};
}

void check(const ShootingProblem& p) {
  const std::size_t wanted = parameters_of(p.law).size(), channels = channels_of(p.law).size();
  hydro::require(p.start.size() == wanted && p.fitted.size() == wanted, "the law has {} parameters, got {} starts",
                 wanted, p.start.size());
  hydro::require(p.lowest.empty() || p.lowest.size() == wanted, "the law has {} parameters, got {} bounds", wanted,
                 p.lowest.size());
  hydro::require(p.deviations.size() == channels, "the law has {} channels, got {} deviations", channels,
                 p.deviations.size());
  for (const double d : p.deviations) hydro::require(d > 0, "deviations must be positive, got {}", d);
  hydro::require(!p.windows.empty() && p.substeps >= 1, "a fit needs a window and a step");
  for (const Window& w : p.windows) {
    hydro::require(w.values.rows() >= 8 && w.values.cols() == static_cast<Eigen::Index>(channels),
                   "a window needs 8 samples of {} channels at least, got {} of {}", channels, w.values.rows(),
                   w.values.cols());
    hydro::require(w.step > 0 && w.values.allFinite(), "a window holds a value that is not finite, or has no step");
  }
}

Eigen::VectorXd start_of(const ShootingProblem& p, const Layout& l) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(l.unknowns());
  for (std::size_t k = 0; k < p.start.size(); ++k)
    if (l.column[k] >= 0) x[l.column[k]] = p.start[k];
  const auto channels = static_cast<Eigen::Index>(channels_of(p.law).size());
  for (std::size_t w = 0; w < p.windows.size(); ++w)
    for (Eigen::Index c = 0; c < channels; ++c) {
      const Eigen::Vector2d s = first_state(p.windows[w].values.col(c), p.windows[w].step);
      const Eigen::Index first = l.fitted + static_cast<Eigen::Index>(w) * l.states;
      x[first + c] = s[0];
      x[first + channels + c] = s[1];
    }
  return x;
}

/// The problem as Ceres takes it. `held` is a parameter that keeps its value in x (profile), −1 for none.
ResidualModel model_of(const ShootingProblem& p, const Layout& l) {
  ResidualModel m;
  const auto names = parameters_of(p.law);
  for (std::size_t k = 0; k < names.size(); ++k)
    if (l.column[k] >= 0)
      m.parameters.push_back({.name = names[k],
                              .scale = std::max(1e-3, std::abs(p.start[k])),
                              .lowest = p.lowest.empty() ? -std::numeric_limits<double>::infinity() : p.lowest[k]});
  for (Eigen::Index i = l.fitted; i < l.unknowns(); ++i)
    m.parameters.push_back({"initial state", p.deviations[0] * 100});
  m.residuals = 0;
  for (const Window& w : p.windows) m.residuals += w.values.size();
  m.evaluate = [&p, l](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
    with_model(p.law, [&](const auto& model) { evaluate(model, p, l, x, r, jacobian); });
  };
  return m;
}

/// Draws of what rounding to the steps of a sensor leaves in the residuals r, which are motion less values over
/// deviations; no column where no channel of no window rounds with a memory. (F69)
Eigen::MatrixXd rounding_of(const ShootingProblem& p, const Eigen::VectorXd& r) {
  Eigen::MatrixXd out;
  Eigen::Index at = 0;
  std::uint64_t stream = 0;
  for (const Window& w : p.windows)
    for (Eigen::Index c = 0; c < w.values.cols(); ++c, at += w.values.rows(), ++stream) {
      const Eigen::VectorXd values = w.values.col(c);
      const auto n = static_cast<std::size_t>(values.size());
      const auto steps = find_quantisation({values.data(), n});
      if (!steps) continue;
      const double unit = p.deviations[static_cast<std::size_t>(c)];
      const Eigen::VectorXd left = unit * r.segment(at, values.size()), motion = values + left;
      const SensorNoise noise = sensor_noise(std::sqrt(left.squaredNorm() / static_cast<double>(n)), steps->step);
      if (!noise.rounds_with_memory()) continue;
      if (out.size() == 0) out = Eigen::MatrixXd::Zero(r.size(), noise_draws);
      for (int draw = 0; draw < noise_draws; ++draw) {
        const auto error =
            drawn_error({motion.data(), n}, noise, DrawnError::rounding, stream, static_cast<std::uint64_t>(draw));
        out.col(draw).segment(at, values.size()) =
            Eigen::Map<const Eigen::VectorXd>(error.data(), values.size()) / unit;
      }
    }
  return out;
}

/// Covariance of all unknowns and the inflation of each variance by the memory of the residuals.
CoefficientCovariance uncertainty_of(const ShootingProblem& p, const Eigen::MatrixXd& jacobian,
                                     const Eigen::VectorXd& r) {
  // Columns hardly change within 1/400 of a window that holds ten swings at most.
  Eigen::Index shortest = p.windows[0].values.rows();
  for (const Window& w : p.windows) shortest = std::min(shortest, w.values.rows());
  return correlated_covariance(jacobian, r, std::max(1, static_cast<int>(shortest / 400)), LongMemory::widen,
                               rounding_of(p, r));
}

void tell_parameters(const ShootingProblem& p, const Layout& l, const Eigen::VectorXd& x,
                     const CoefficientCovariance& u, ShootingFit& fit) {
  const auto names = parameters_of(p.law);
  fit.ended = p.start;
  for (std::size_t k = 0; k < names.size(); ++k) {
    Coefficient c;
    if (l.column[k] < 0) {
      c.name = names[k];
      c.value = p.start[k];
      c.interval = c.white_interval = {p.start[k], p.start[k]};
    } else {
      const Eigen::Index j = l.column[k];
      fit.ended[k] = x[j];
      c = with_interval(names[k], x[j], u, j, p.confidence);
      if (!fit.search.identifiable[static_cast<std::size_t>(j)]) {
        c.value.reset();
        c.why_not = fit.search.identifiability;
      }
    }
    fit.parameters.push_back(c);
  }
  const Eigen::MatrixXd own = u.covariance.topLeftCorner(l.fitted, l.fitted);
  const Eigen::VectorXd scale = own.diagonal().cwiseSqrt().cwiseInverse();
  fit.correlation = scale.asDiagonal() * own * scale.asDiagonal();
  fit.dof = u.dof;
  if (u.dof_raised)
    fit.caution =
        "what is left hardly forgets within the record, or repeats: it is an error of the model more than noise, and "
        "the "
        "intervals are as wide as two independent residuals make them";
}

/// Motions, rms and what halving the steps changes.
void tell_motion(const ShootingProblem& p, const Layout& l, const Eigen::VectorXd& x, ShootingFit& fit) {
  const auto channels = p.windows[0].values.cols();
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(channels);
  Eigen::RowVectorXd about_mean = Eigen::RowVectorXd::Zero(channels);
  double samples = 0;
  for (std::size_t w = 0; w < p.windows.size(); ++w) {
    Eigen::MatrixXd motion, finer;
    with_model(p.law, [&](const auto& model) {
      shoot(model, p, l, w, x, p.substeps, motion, nullptr);
      shoot(model, p, l, w, x, 2 * p.substeps, finer, nullptr);
    });
    for (Eigen::Index c = 0; c < channels; ++c)
      fit.integration_error = std::max(fit.integration_error, (motion - finer).col(c).cwiseAbs().maxCoeff() /
                                                                  p.deviations[static_cast<std::size_t>(c)]);
    squares += (motion - p.windows[w].values).cwiseAbs2().colwise().sum().transpose();
    about_mean += (p.windows[w].values.rowwise() - p.windows[w].values.colwise().mean()).cwiseAbs2().colwise().sum();
    samples += static_cast<double>(motion.rows());
    fit.initial.push_back(x.segment(l.fitted + static_cast<Eigen::Index>(w) * l.states, l.states));
    fit.motion.push_back(std::move(motion));
  }
  for (Eigen::Index c = 0; c < channels; ++c) {
    fit.rms.push_back(std::sqrt(squares[c] / samples));
    fit.explained.push_back(about_mean[c] > 0 ? 1 - squares[c] / about_mean[c] : 1.0);
  }
}

void tell_motion_bands(const ShootingProblem& p, const Eigen::MatrixXd& jacobian, const CoefficientCovariance& u,
                       ShootingFit& fit) {  // (F46)
  if (!fit.search.all_identifiable()) return;
  std::vector<Eigen::MatrixXd> left;
  for (std::size_t w = 0; w < p.windows.size(); ++w) left.emplace_back(fit.motion[w] - p.windows[w].values);
  const double quantile = hydro::signal::student_t_quantile((1 + p.confidence) / 2, u.dof);
  auto bands = motion_bands(left, jacobian, u.covariance, p.deviations, fit.rms, quantile);
  fit.fit_band = std::move(bands.of_fit);
  fit.sample_band = std::move(bands.of_sample);
  fit.inside = bands.inside;
}

}  // namespace

std::vector<std::string> parameters_of(MotionLaw law) {
  if (law == MotionLaw::fall) return {"drag", "gravity"};
  if (law == MotionLaw::with_radiation_memory)
    return {"omega0", "linear", "quadratic", "cubic", "offset", "memory_strength", "memory_decay", "memory_frequency"};
  if (law == MotionLaw::double_pendulum)
    return {"coupling", "inertia", "gravity1", "gravity2", "friction1", "friction2"};
  return {"omega0", "linear", "quadratic", "cubic", "coulomb", "offset"};
}

std::vector<std::string> channels_of(MotionLaw law) {
  if (law == MotionLaw::fall) return {"h"};
  if (law == MotionLaw::double_pendulum) return {"theta1", "theta2"};
  return {"x"};
}

ShootingFit fit_motion(const ShootingProblem& p) {  // (F36)
  check(p);
  const Layout l = layout_of(p);
  const ResidualModel model = model_of(p, l);
  Eigen::VectorXd x = start_of(p, l);
  ShootingFit fit{};
  fit.search = minimise(model, x, {.cost_change_below = 1e-12, .gradient_below = 1e-12, .step_below = 1e-12});
  if (fit.search.outcome == SearchReport::Outcome::not_finite)
    throw hydro::NumericsError(fmt::format("the motion runs away from its start: {}", fit.search.why));
  require_ended(fit.search, "the motion");
  Eigen::VectorXd r(model.residuals);
  Eigen::MatrixXd jacobian;
  model.evaluate(x, r, &jacobian);
  CoefficientCovariance u;
  if (fit.search.all_identifiable() && r.norm() > 1e-9 * std::sqrt(static_cast<double>(r.size()))) {
    u = uncertainty_of(p, jacobian, r);
  } else {
    u.covariance = u.white_covariance = fit.search.all_identifiable()
                                            ? Eigen::MatrixXd(Eigen::MatrixXd::Zero(x.size(), x.size()))
                                            : fit.search.covariance;
    u.effective_samples = Eigen::VectorXd::Zero(x.size());
    u.dof_raised = false;
    u.dof = u.white_dof = static_cast<double>(std::max<Eigen::Index>(1, r.size() - x.size()));
  }
  tell_parameters(p, l, x, u, fit);
  tell_motion(p, l, x, fit);
  tell_motion_bands(p, jacobian, u, fit);
  return fit;
}

Eigen::MatrixXd follow(MotionLaw law, std::span<const double> parameters, const Eigen::VectorXd& initial, double step,
                       Eigen::Index samples, int substeps) {
  return with_model(law, [&](const auto& model) {
    using Model = std::decay_t<decltype(model)>;
    hydro::require(parameters.size() == Model::parameters && initial.size() == Model::states,
                   "the law has {} parameters and {} states, got {} and {}", Model::parameters, Model::states,
                   parameters.size(), initial.size());
    std::array<double, Model::parameters> theta;
    std::copy(parameters.begin(), parameters.end(), theta.begin());
    std::array<double, Model::states> y;
    std::copy(initial.begin(), initial.end(), y.begin());
    Follower<Model, double> follower(model, y, theta);
    Eigen::MatrixXd out(samples, Model::channels);
    for (Eigen::Index j = 0; j < samples; ++j) {
      for (int c = 0; c < Model::channels; ++c) out(j, c) = follower.state()[static_cast<std::size_t>(c)];
      for (int k = 0; k < substeps; ++k) follower.advance(step / substeps);
    }
    return out;
  });
}

Interval profile_interval(const ShootingProblem& problem, const ShootingFit& fit, std::size_t parameter) {  // (F37)
  hydro::require(parameter < problem.fitted.size() && problem.fitted[parameter] && fit.parameters[parameter].value,
                 "the parameter is not among those fitted");
  const Coefficient& c = fit.parameters[parameter];
  const double value = *c.value, t = hydro::signal::student_t_quantile((1 + problem.confidence) / 2, fit.dof);
  double rows = 0;
  for (const Window& w : problem.windows) rows += static_cast<double>(w.values.size());
  const double scatter = 2 * fit.search.cost_last / rows;
  const double inflation = rows / std::max(1.0, c.effective_samples);
  const double rise = t * t * scatter * inflation / 2;
  ShootingProblem held = problem;
  held.fitted[parameter] = false;
  for (std::size_t k = 0; k < held.start.size(); ++k)
    if (fit.parameters[k].value) held.start[k] = *fit.parameters[k].value;
  const auto excess = [&](double at) {
    held.start[parameter] = at;
    const Layout l = layout_of(held);
    Eigen::VectorXd x = start_of(held, l);
    for (std::size_t w = 0; w < held.windows.size(); ++w)
      x.segment(l.fitted + static_cast<Eigen::Index>(w) * l.states, l.states) = fit.initial[w];
    const SearchReport search =
        minimise(model_of(held, l), x, {.cost_change_below = 1e-12, .gradient_below = 1e-12, .step_below = 1e-12});
    // Where a motion runs away the end lies before.
    if (search.outcome == SearchReport::Outcome::not_finite) return std::numeric_limits<double>::infinity();
    require_ended(search, "all else at a value of the profile");
    return search.cost_last - fit.search.cost_last - rise;
  };
  const auto end = [&](double sign) {
    double inside = value, outside = value + sign * t * c.standard_error;
    for (int i = 0; excess(outside) < 0; ++i) {
      if (i > 8) throw hydro::NumericsError("the likelihood does not fall within 30 standard errors");
      inside = outside;
      outside += sign * std::pow(1.5, i) * t * c.standard_error / 2;
    }
    for (int i = 0; i < 30 && std::abs(outside - inside) > 1e-3 * c.standard_error; ++i) {
      const double middle = (inside + outside) / 2;
      (excess(middle) < 0 ? inside : outside) = middle;
    }
    return (inside + outside) / 2;
  };
  return {end(-1), end(1)};
}

}  // namespace fit
