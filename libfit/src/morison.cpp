#include "fit/morison.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "fit/correlated.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"
#include "hydro/signal/welch.hpp"

namespace fit {
namespace {

// A drag or inertia coefficient is of order one: told to ±1 or worse it is not told at all.
constexpr double telling = 1.0;

Eigen::Map<const Eigen::VectorXd> as_vector(const std::vector<double>& v) {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}

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
  for (const auto* column : {&r.force, &r.velocity, &r.acceleration})
    for (std::size_t j = 0; j < n; ++j)
      hydro::require(std::isfinite((*column)[j]), "sample {} holds a value that is not finite", j + 1);
}

// Columns: dF/dC_D, dF/dC_inertia and, if asked, dF/d(offset). (F7), (F8)
Eigen::MatrixXd sensitivities(const Cylinder& c, const ForceRecord& r, bool offset) {
  const double sign = c.experiment == Experiment::water_moves ? 1.0 : -1.0;
  const auto u = as_vector(r.velocity).array();
  Eigen::MatrixXd columns(u.size(), offset ? 3 : 2);
  columns.col(0) = sign * 0.5 * c.density * c.diameter * c.length * u.abs() * u;
  columns.col(1) = sign * c.density * c.volume() * as_vector(r.acceleration);
  if (offset) columns.col(2).setOnes();
  return columns;
}

// Residuals over the force's rms: cost and gradient are then numbers of order one, and stop rules mean something.
ResidualModel residual_model(const Cylinder& c, const Eigen::MatrixXd& columns, const Eigen::VectorXd& target,
                             double unit) {
  ResidualModel model;
  model.parameters = {{"cd", telling}, {c.experiment == Experiment::water_moves ? "cm" : "ca", telling}};
  if (columns.cols() == 3) model.parameters.push_back({"offset", unit});
  model.residuals = target.size();
  model.evaluate = [&columns, &target, unit](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
    r = (columns * x - target) / unit;
    if (jacobian != nullptr) *jacobian = columns / unit;
  };
  return model;
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
  double t, white_t;
};

Coefficient coefficient(const FitReport& search, const std::string& name, Eigen::Index j, double value,
                        const Uncertainty& u) {
  Coefficient c;
  c.name = name;
  c.standard_error = std::sqrt(u.covariance.covariance(j, j));
  const double half = u.t * c.standard_error, white = u.white_t * std::sqrt(u.covariance.white_covariance(j, j));
  c.interval = {value - half, value + half};
  c.white_interval = {value - white, value + white};
  c.effective_samples = u.covariance.effective_samples[j];
  c.shift_per_degree = u.shift[j];
  if (!search.identifiable[static_cast<std::size_t>(j)])
    c.why_not = search.identifiability;
  else if (half > telling)
    c.why_not = fmt::format("the record tells {} to ±{:.2g} only", name, half);
  else if (std::abs(c.shift_per_degree) > telling)
    c.why_not = fmt::format("the force depends on {} so little that 1° of phase error would shift it by {:.2g}", name,
                            std::abs(c.shift_per_degree));
  if (c.why_not.empty()) c.value = value;
  return c;
}

Uncertainty uncertainty(const Eigen::MatrixXd& columns, const Eigen::VectorXd& residuals, int block,
                        double confidence) {
  Uncertainty u{correlated_covariance(columns, residuals, block), {}, 0, 0};
  u.t = hydro::signal::student_t_quantile((1 + confidence) / 2, u.covariance.dof);
  u.white_t = hydro::signal::student_t_quantile((1 + confidence) / 2, u.covariance.white_dof);
  return u;
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
                           int block, double confidence) {
  const bool apart =
      std::find(search.identifiable.begin(), search.identifiable.end(), false) == search.identifiable.end();
  if (!apart) return known_scatter(columns.rows(), columns.cols(), std::numeric_limits<double>::quiet_NaN());
  // Cost is ½‖r‖² with residuals over the force's rms.
  const bool perfect = 2 * search.cost_last <= 1e-24 * static_cast<double>(columns.rows());
  if (perfect) return known_scatter(columns.rows(), columns.cols(), 0);
  return uncertainty(columns, residuals, block, confidence);
}

}  // namespace

double Cylinder::volume() const { return std::numbers::pi / 4 * diameter * diameter * length; }

double morison_force(const Cylinder& c, double cd, double inertia, double velocity, double acceleration) {
  const double drag = 0.5 * c.density * c.diameter * c.length * cd * std::abs(velocity) * velocity;
  if (c.experiment == Experiment::water_moves) return c.density * c.volume() * inertia * acceleration + drag;  // (F7)
  return -(inertia * c.density * c.volume() + c.mass_beyond_load_cells) * acceleration - drag;                 // (F8)
}

MorisonFit fit_morison(const Cylinder& cylinder, const ForceRecord& record, const MorisonOptions& options) {
  check(cylinder, record, options);
  const double step = hydro::signal::even_step(record.time);
  const auto n = static_cast<Eigen::Index>(record.time.size());
  const auto force = as_vector(record.force), velocity = as_vector(record.velocity),
             acceleration = as_vector(record.acceleration);
  hydro::require(velocity.norm() > 0 && acceleration.norm() > 0 && force.norm() > 0,
                 "force, velocity and acceleration must not be zero throughout");

  MorisonFit result;
  const Eigen::ArrayXd window = hann(n);
  const double u2 = (window * velocity.array().square()).sum(), a2 = (window * acceleration.array().square()).sum();
  result.period = 2 * std::numbers::pi * std::sqrt(u2 / a2);  // (F9)
  hydro::require(result.period <= step * static_cast<double>(n),
                 "the record of {:.4g} s is shorter than its main period of {:.4g} s", step * static_cast<double>(n),
                 result.period);
  result.velocity_amplitude = std::sqrt(2 * u2 / window.sum());
  result.kc = result.velocity_amplitude * result.period / cylinder.diameter;  // (F10)
  if (cylinder.viscosity) result.re = result.velocity_amplitude * cylinder.diameter / *cylinder.viscosity;

  const Eigen::MatrixXd columns = sensitivities(cylinder, record, options.force_offset);
  Eigen::VectorXd target = force;
  if (cylinder.experiment == Experiment::body_moves) target += cylinder.mass_beyond_load_cells * acceleration;
  const double unit = std::sqrt(force.squaredNorm() / static_cast<double>(n));
  Eigen::VectorXd x = Eigen::VectorXd::Zero(columns.cols());
  result.search = minimise(residual_model(cylinder, columns, target, unit), x);

  const Eigen::VectorXd residuals = target - columns * x;
  result.residual_rms = std::sqrt(residuals.squaredNorm() / static_cast<double>(n));
  result.explained = 1 - residuals.squaredNorm() / (force.array() - force.mean()).matrix().squaredNorm();
  // A fortieth of the period: the columns hardly change within, see correlated_covariance().
  const int block = std::max(1, static_cast<int>(result.period / 40 / step));
  Uncertainty u = uncertainty_of(result.search, columns, residuals, block, options.confidence);
  u.shift = shift_per_degree(columns, record.force, step, result.period);
  result.cd = coefficient(result.search, "cd", 0, x[0], u);
  result.inertia = coefficient(result.search, cylinder.experiment == Experiment::water_moves ? "cm" : "ca", 1, x[1], u);
  if (options.force_offset) result.offset = x[2];
  result.confidence = options.confidence;
  result.dof = u.covariance.dof;
  if (u.covariance.dof_raised)
    result.caution =
        "the residuals are much the same in every cycle: they are an error of the model more than noise, and "
        "no interval made from scatter covers that";
  result.samples = static_cast<std::size_t>(n);
  const Eigen::VectorXd fitted = force - residuals;
  result.fitted.assign(fitted.data(), fitted.data() + fitted.size());
  return result;
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
