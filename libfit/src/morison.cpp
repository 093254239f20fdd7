#include "fit/morison.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "fit/correlated.hpp"
#include "fit/resampling.hpp"
#include "fit/robust.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"
#include "hydro/signal/welch.hpp"
#include "morison_columns.hpp"

namespace fit {
namespace {

// A drag or inertia coefficient is of order one: told to ±1 or worse it is not told at all.
constexpr double telling = 1.0;

void check(const Cylinder& c, const ForceRecord& r, const MorisonOptions& options) {
  hydro::require(c.diameter > 0 && c.length > 0 && c.density > 0 && std::isfinite(c.diameter * c.length * c.density),
                 "diameter, length and density must be positive, got {} m, {} m, {} kg/m³", c.diameter, c.length,
                 c.density);
  hydro::require(!c.viscosity || *c.viscosity > 0, "the viscosity must be positive, got {} m²/s",
                 c.viscosity.value_or(0));
  hydro::require(std::isfinite(c.mass_beyond_load_cells) && c.mass_beyond_load_cells >= 0,
                 "the mass beyond the load cells must not be negative, got {} kg", c.mass_beyond_load_cells);
  hydro::require(c.experiment == Experiment::body_moves || c.mass_beyond_load_cells == 0,
                 "a body at rest in moving water has no inertia force: leave out the mass beyond the load cells");
  hydro::require(options.confidence > 0 && options.confidence < 1,
                 "a confidence level must lie between 0 and 1, got {}", options.confidence);
  const std::size_t n = r.time.size();
  hydro::require(r.force.size() == n && r.velocity.size() == n && r.acceleration.size() == n,
                 "{} times, {} forces, {} velocities, {} accelerations: they must be as many", n, r.force.size(),
                 r.velocity.size(), r.acceleration.size());
  hydro::require(n >= 32, "a fit needs at least 32 samples, got {}", n);
  hydro::require(r.drag_flow.empty() || r.drag_flow.size() == n, "{} times but {} values of |u|u", n,
                 r.drag_flow.size());
  for (const ForceError& e : options.force_errors)
    hydro::require(e.force.size() == n, "the force error of {} has {} values for {} samples", e.source, e.force.size(),
                   n);
  for (const auto* column : {&r.force, &r.velocity, &r.acceleration, &r.drag_flow})
    for (std::size_t j = 0; j < column->size(); ++j)
      hydro::require(std::isfinite((*column)[j]), "sample {} holds a value that is not finite", j + 1);
}

// Weights that fade towards both ends: a record of ten periods and a half is then no worse than one of ten.
Eigen::ArrayXd hann(Eigen::Index n) {
  const auto step = std::numbers::pi / static_cast<double>(n);
  return (Eigen::ArrayXd::LinSpaced(n, 0.5 * step, (static_cast<double>(n) - 0.5) * step)).sin().square();
}

/// (F11): the change of each coefficient if the force came later by 1/360 of the period.
Eigen::VectorXd shift_per_degree(const Eigen::MatrixXd& columns, const std::vector<double>& force, double step,
                                 double period) {
  const Eigen::Index n = columns.rows();
  Eigen::VectorXd later = Eigen::VectorXd::Zero(n);  // −Ḟ · T/360 by central differences; ends left at zero
  for (Eigen::Index j = 1; j + 1 < n; ++j)
    later[j] =
        -(force[static_cast<std::size_t>(j) + 1] - force[static_cast<std::size_t>(j) - 1]) / (2 * step) * period / 360;
  return columns.colPivHouseholderQr().solve(later);
}

struct Uncertainty {
  CoefficientCovariance covariance;
  Eigen::VectorXd shift;
  Eigen::VectorXd systematic;  ///< standard errors that do not average out
  double t, white_t, z;        ///< quantiles
};

/// Known no better than to `enough` it is not known.
Coefficient coefficient(const FitReport& search, const std::string& name, Eigen::Index j, double value,
                        const Uncertainty& u, double enough = telling) {
  Coefficient c;
  c.name = name;
  const double scatter = std::sqrt(u.covariance.covariance(j, j)),
               white = u.white_t * std::sqrt(u.covariance.white_covariance(j, j));
  c.systematic_error = u.systematic[j];
  c.standard_error = std::hypot(scatter, c.systematic_error);
  const double half = std::hypot(u.t * scatter, u.z * c.systematic_error);  // (F26)
  c.interval = {value - half, value + half};
  c.white_interval = {value - white, value + white};
  c.effective_samples = u.covariance.effective_samples[j];
  c.shift_per_degree = u.shift[j];
  if (!search.identifiable[static_cast<std::size_t>(j)])
    c.why_not = search.identifiability;
  else if (half > enough)
    c.why_not = fmt::format("the record tells {} to ±{:.2g} only", name, half);
  else if (std::abs(c.shift_per_degree) > enough)
    c.why_not = fmt::format("the force depends on {} so little that 1° of phase error would shift it by {:.2g}", name,
                            std::abs(c.shift_per_degree));
  if (c.why_not.empty()) c.value = value;
  return c;
}

CoefficientCovariance covariance_by(IntervalMethod method, const Eigen::MatrixXd& columns,
                                    const Eigen::VectorXd& residuals, int block, double period_samples) {
  if (method == IntervalMethod::cycle_clusters) return cluster_covariance(columns, residuals, period_samples, block);
  if (method == IntervalMethod::block_bootstrap) return bootstrap_covariance(columns, residuals, {.block = block});
  return correlated_covariance(columns, residuals, block);
}

// Stands where no scatter can be estimated: 0 for a force made by the model itself, which leaves rounding only, NaN
// where the coefficients cannot be told apart.
Uncertainty known_scatter(Eigen::Index n, Eigen::Index p, double scatter) {
  Uncertainty u;
  u.covariance.covariance = u.covariance.white_covariance = Eigen::MatrixXd::Constant(p, p, scatter);
  u.covariance.effective_samples = Eigen::VectorXd::Constant(p, static_cast<double>(n));
  u.covariance.dof = u.covariance.white_dof = static_cast<double>(n - p);
  u.covariance.dof_raised = false;
  u.t = u.white_t = 0;
  return u;
}

Uncertainty uncertainty_of(const FitReport& search, const Eigen::MatrixXd& columns, const Eigen::VectorXd& residuals,
                           double unit, double period_samples, const MorisonOptions& options) {
  if (!search.all_identifiable())
    return known_scatter(columns.rows(), columns.cols(), std::numeric_limits<double>::quiet_NaN());
  const bool perfect = residuals.squaredNorm() <= 1e-24 * unit * unit * static_cast<double>(columns.rows());
  if (perfect) return known_scatter(columns.rows(), columns.cols(), 0);
  // A fortieth of the period: the columns hardly change within, see correlated_covariance().
  const int block = std::max(1, static_cast<int>(period_samples / 40));
  Uncertainty u{covariance_by(options.method, columns, residuals, block, period_samples), {}, {}, 0, 0, 0};
  u.t = hydro::signal::student_t_quantile((1 + options.confidence) / 2, u.covariance.dof);
  u.white_t = hydro::signal::student_t_quantile((1 + options.confidence) / 2, u.covariance.white_dof);
  return u;
}

/// Period, amplitude, KC and Re of the motion.
void describe_flow(const Cylinder& cylinder, const ForceRecord& record, double step, MorisonFit& result) {
  const auto force = as_vector(record.force), velocity = as_vector(record.velocity),
             acceleration = as_vector(record.acceleration);
  hydro::require(velocity.norm() > 0 && acceleration.norm() > 0 && force.norm() > 0,
                 "force, velocity and acceleration must not be zero throughout");
  const Eigen::ArrayXd window = hann(velocity.size());
  const double u2 = (window * velocity.array().square()).sum(), a2 = (window * acceleration.array().square()).sum();
  result.period = 2 * std::numbers::pi * std::sqrt(u2 / a2);  // (F9)
  const double duration = step * static_cast<double>(velocity.size());
  hydro::require(result.period <= duration, "the record of {:.4g} s is shorter than its main period of {:.4g} s",
                 duration, result.period);
  result.velocity_amplitude = std::sqrt(2 * u2 / window.sum());
  result.kc = result.velocity_amplitude * result.period / cylinder.diameter;  // (F10)
  if (cylinder.viscosity) result.re = result.velocity_amplitude * cylinder.diameter / *cylinder.viscosity;
  result.samples = static_cast<std::size_t>(velocity.size());
}

const char* inertia_name(const Cylinder& c) { return c.experiment == Experiment::water_moves ? "cm" : "ca"; }

/// cd, inertia, then an offset and a delay where they are asked for.
Eigen::MatrixXd all_columns(const Cylinder& c, const ForceRecord& r, const MorisonOptions& options,
                            const Eigen::VectorXd* delay_column) {
  Eigen::MatrixXd columns = morison_columns(c, r);
  const auto append = [&](const Eigen::VectorXd& column) {
    columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
    columns.rightCols(1) = column;
  };
  if (options.force_offset) append(Eigen::VectorXd::Ones(columns.rows()));
  if (delay_column != nullptr) append(*delay_column);
  return columns;
}

std::vector<ResidualModel::Parameter> parameters(const Cylinder& c, const MorisonOptions& options, bool delay,
                                                 double unit, double period) {
  std::vector<ResidualModel::Parameter> out{{"cd", telling}, {inertia_name(c), telling}};
  if (options.force_offset) out.push_back({"offset", unit});
  if (delay) out.push_back({"delay", period / 360});
  return out;
}

/// Changes of the coefficients for one standard deviation of each source; (F26).
std::vector<SystematicError> budget(const Cylinder& c, const Eigen::MatrixXd& columns, const Eigen::VectorXd& x,
                                    const Eigen::VectorXd& shift, const MorisonFit& fit,
                                    const MorisonOptions& options) {
  std::vector<SystematicError> out;
  const auto add = [&](const std::string& source, double cd, double inertia) {
    if (cd != 0 || inertia != 0) out.push_back({source, cd, inertia});
  };
  if (!fit.search.all_identifiable()) return out;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
  for (const ForceError& e : options.force_errors) {
    const Eigen::VectorXd change = qr.solve(as_vector(e.force));
    add(e.source, change[0], change[1]);
  }
  const double degrees = 360 * options.delay_error_s / fit.period;
  add("delay of the force", shift[0] * degrees, shift[1] * degrees);
  const CylinderErrors& s = options.cylinder_errors;
  // C_D ~ 1/(ρDL), C ~ 1/(ρD²L) of the force that water takes; the mass goes into C_A alone.
  add("diameter", -x[0] * s.diameter / c.diameter, -2 * x[1] * s.diameter / c.diameter);
  add("length", -x[0] * s.length / c.length, -x[1] * s.length / c.length);
  add("density", -x[0] * s.density / c.density, -x[1] * s.density / c.density);
  add("mass beyond the load cells", 0, -s.mass / (c.density * c.volume()));
  return out;
}

Eigen::VectorXd total(const std::vector<SystematicError>& budget, Eigen::Index p) {
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(p);
  for (const SystematicError& e : budget) squares.head(2) += Eigen::Vector2d(e.cd * e.cd, e.inertia * e.inertia);
  return squares.cwiseSqrt();
}

void tell_coefficients(const Cylinder& cylinder, const MorisonOptions& options, bool delay, const Eigen::VectorXd& x,
                       const Uncertainty& u, MorisonFit& result) {
  result.cd = coefficient(result.search, "cd", 0, x[0], u);
  result.inertia = coefficient(result.search, inertia_name(cylinder), 1, x[1], u);
  if (options.force_offset) result.offset = x[2];
  if (delay) {
    const Eigen::Index last = x.size() - 1;
    result.delay = coefficient(result.search, "delay", last, x[last], u, result.period / 36);
  }
  const auto& covariance = u.covariance.covariance;
  const double variances = covariance(0, 0) * covariance(1, 1);
  result.correlation = variances > 0 ? covariance(0, 1) / std::sqrt(variances) : 0;
  result.confidence = options.confidence;
  result.dof = u.covariance.dof;
  if (u.covariance.dof_raised)
    result.caution =
        "the residuals are much the same in every cycle: they are an error of the model more than noise, and "
        "no interval made from scatter covers that";
}

}  // namespace

double Cylinder::volume() const { return std::numbers::pi / 4 * diameter * diameter * length; }

double morison_force(const Cylinder& c, double cd, double inertia, double velocity, double acceleration) {
  const double drag = 0.5 * c.density * c.diameter * c.length * cd * std::abs(velocity) * velocity;
  if (c.experiment == Experiment::water_moves) return c.density * c.volume() * inertia * acceleration + drag;  // (F7)
  return -(inertia * c.density * c.volume() + c.mass_beyond_load_cells) * acceleration - drag;                 // (F8)
}

Eigen::MatrixXd morison_columns(const Cylinder& c, const ForceRecord& r) {  // (F7), (F8), (F25)
  const double sign = c.experiment == Experiment::water_moves ? 1.0 : -1.0;
  const auto u = as_vector(r.velocity).array();
  Eigen::MatrixXd columns(u.size(), 2);
  if (r.drag_flow.empty())
    columns.col(0) = u.abs() * u;
  else
    columns.col(0) = as_vector(r.drag_flow);
  columns.col(0) *= sign * 0.5 * c.density * c.diameter * c.length;
  columns.col(1) = sign * c.density * c.volume() * as_vector(r.acceleration);
  return columns;
}

MorisonFit fit_columns(const Cylinder& cylinder, const ForceRecord& record, const MorisonOptions& options,
                       const Eigen::VectorXd* delay_column) {
  check(cylinder, record, options);
  MorisonFit result;
  const double step = hydro::signal::even_step(record.time);
  describe_flow(cylinder, record, step, result);
  const Eigen::MatrixXd columns = all_columns(cylinder, record, options, delay_column);
  const auto force = as_vector(record.force);
  Eigen::VectorXd target = force;
  if (cylinder.experiment == Experiment::body_moves)
    target += cylinder.mass_beyond_load_cells * as_vector(record.acceleration);
  const double rows = static_cast<double>(target.size()), unit = std::sqrt(force.squaredNorm() / rows);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(columns.cols());
  result.search =
      minimise(linear_model(compress(columns, target),
                            parameters(cylinder, options, delay_column != nullptr, unit, result.period), unit),
               x);

  Eigen::VectorXd scatter;
  if (options.robust && result.search.all_identifiable()) {
    RobustFit robust = fit_huber(columns, target);
    x = robust.x;
    result.share_inside = robust.share_inside;
    scatter = robust.influence / robust.share_inside;  // (F39)
  }
  const Eigen::VectorXd residuals = target - columns * x;
  if (scatter.size() == 0) scatter = residuals;
  result.residual_rms = std::sqrt(residuals.squaredNorm() / rows);
  result.explained = 1 - residuals.squaredNorm() / (force.array() - force.mean()).matrix().squaredNorm();
  Uncertainty u = uncertainty_of(result.search, columns, scatter, unit, result.period / step, options);
  u.shift = shift_per_degree(columns, record.force, step, result.period);
  result.budget = budget(cylinder, columns, x, u.shift, result, options);
  u.systematic = total(result.budget, columns.cols());
  u.z = hydro::signal::normal_quantile((1 + options.confidence) / 2);
  tell_coefficients(cylinder, options, delay_column != nullptr, x, u, result);
  const Eigen::VectorXd fitted = force - residuals;
  result.fitted.assign(fitted.data(), fitted.data() + fitted.size());
  return result;
}

MorisonFit fit_morison(const Cylinder& cylinder, const ForceRecord& record, const MorisonOptions& options) {
  return fit_columns(cylinder, record, options, nullptr);
}

Coefficient inertia_as(const MorisonFit& fit, const std::string& name) {
  hydro::require(name == "cm" || name == "ca", "an inertia coefficient is called cm or ca, not {}", name);
  Coefficient c = fit.inertia;
  if (c.name == name) return c;
  const double shift = name == "cm" ? 1.0 : -1.0;
  c.name = name;
  if (c.value) *c.value += shift;
  for (Interval* i : {&c.interval, &c.white_interval}) *i = {i->low + shift, i->high + shift};
  return c;
}

}  // namespace fit
