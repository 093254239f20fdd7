#include "fit/morison.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "fit/correlated.hpp"
#include "fit/resampling.hpp"
#include "fit/robust.hpp"
#include "fit/verdict.hpp"
#include "hydro/base/dense.hpp"
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
  hydro::require(c.experiment != Experiment::water_moves || c.mass_beyond_load_cells == 0,
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
  hydro::require(r.linear_flow.empty() || r.linear_flow.size() == n, "{} times but {} filtered velocities", n,
                 r.linear_flow.size());
  for (const ForceError& e : options.force_errors)
    hydro::require(e.force.size() == n, "the force error of {} has {} values for {} samples", e.source, e.force.size(),
                   n);
  const bool both = c.experiment == Experiment::both_move;
  hydro::require(r.water_acceleration.size() == (both ? n : 0),
                 "{} times and {} accelerations of the water itself: as many are needed where both move, else none", n,
                 r.water_acceleration.size());
  for (const auto* column : {&r.force, &r.velocity, &r.acceleration, &r.drag_flow, &r.water_acceleration})
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
  return hydro::dense::PivotedQr(columns).solve(later);
}

struct Uncertainty {
  CoefficientCovariance covariance;
  Eigen::VectorXd shift;
  Eigen::VectorXd systematic;  ///< standard errors that do not average out
  double t, white_t, z;        ///< quantiles
};

/// Known no better than to `enough` it is not known.
Coefficient coefficient(const SearchReport& search, const std::string& name, Eigen::Index j, double value,
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

/// What noise of the motion takes off the coefficients; (F68).
struct Attenuation {
  Eigen::MatrixXd gain;     ///< (AᵀA − N)⁻¹AᵀA: what least squares gives, times that
  Eigen::VectorXd change;   ///< of the coefficients, to be added
  Eigen::VectorXd scatter;  ///< of that change from one draw of the noise to another
};

void require_motion(const Eigen::MatrixXd& noise, const Eigen::MatrixXd& normal) {
  for (const Eigen::Index j : {0, 1})
    if (noise(j, j) > 0.5 * normal(j, j))
      throw hydro::InputError(
          fmt::format("noise of the motion is {:.2g} % of the variance of its {}: nothing can be fitted to that",
                      100 * noise(j, j) / normal(j, j), j == 0 ? "|u|u" : "acceleration"),
          {},
          "narrow derivative_bandwidth, take noise out with a low pass, or take derivative_method = "
          "\"fourier_series\"");
}

/// Errors of all columns for one draw of the motion's noise.
Eigen::MatrixXd errors_of_draw(const Cylinder& c, const ForceRecord& r, const MorisonColumns& at,
                               const DelayColumn* delay, std::size_t draw) {
  Eigen::MatrixXd out = column_errors(c, r.motion_errors[draw], at);
  if (delay != nullptr) out.col(at.delay) = delay->errors[draw];
  return out;
}

Attenuation attenuation(const Cylinder& c, const ForceRecord& r, const MorisonColumns& at,
                        const Eigen::MatrixXd& columns, const DelayColumn* delay, const Eigen::VectorXd& x) {
  const Eigen::Index p = columns.cols();
  const auto draws = std::ssize(r.motion_errors);
  if (draws == 0) return {Eigen::MatrixXd::Identity(p, p), Eigen::VectorXd::Zero(p), Eigen::VectorXd::Zero(p)};
  Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(p, p), slopes(p, draws);  // E δAᵀδA; −δAᵀ(δy − δA x) of each draw
  for (Eigen::Index d = 0; d < draws; ++d) {
    const MotionError& e = r.motion_errors[static_cast<std::size_t>(d)];
    const Eigen::MatrixXd errors = errors_of_draw(c, r, at, delay, static_cast<std::size_t>(d));
    noise += errors.transpose() * errors / static_cast<double>(draws);
    slopes.col(d) = errors.transpose() * (errors * x + carried_error(c, e));
  }
  const Eigen::MatrixXd normal = columns.transpose() * columns;
  require_motion(noise, normal);
  const Eigen::MatrixXd without = hydro::dense::inverse(normal - noise), changes = without * slopes;
  const Eigen::VectorXd change = changes.rowwise().mean();
  return {without * normal, change,
          (changes.colwise() - change).rowwise().norm() / std::sqrt(static_cast<double>(draws - 1))};
}

/// Draws of what is known of the residuals, shape (n, draws): noise of the motion, and rounding of the force. (F69)
Eigen::MatrixXd known_errors(const Cylinder& c, const ForceRecord& r, const MorisonColumns& at,
                             const DelayColumn* delay, const Eigen::VectorXd& x) {
  const std::size_t draws = std::max(r.motion_errors.size(), r.rounding.size());
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(std::ssize(r.force), static_cast<Eigen::Index>(draws));
  for (std::size_t d = 0; d < draws; ++d) {
    auto column = out.col(static_cast<Eigen::Index>(d));
    if (!r.motion_errors.empty())
      column -= carried_error(c, r.motion_errors[d]) + errors_of_draw(c, r, at, delay, d) * x;
    if (!r.rounding.empty()) column += as_vector(r.rounding[d]);
  }
  return out;
}

CoefficientCovariance covariance_by(IntervalMethod method, const Eigen::MatrixXd& columns,
                                    const Eigen::VectorXd& residuals, int block, double period_samples,
                                    const Eigen::MatrixXd& known) {
  if (method == IntervalMethod::cycle_clusters) return cluster_covariance(columns, residuals, period_samples, block);
  if (method == IntervalMethod::block_bootstrap) return bootstrap_covariance(columns, residuals, {.block = block});
  // Beside what is known the rest may be next to nothing, and its memory with it.
  return correlated_covariance(columns, residuals, block, known.size() > 0 ? LongMemory::widen : LongMemory::refuse,
                               known);
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

/// `period_samples` of the motion, `shortest_samples` of all that the columns hold; `known` as in
/// correlated_covariance(), `gain` of the attenuation.
Uncertainty uncertainty_of(const SearchReport& search, const Eigen::MatrixXd& columns, const Eigen::VectorXd& residuals,
                           double unit, double period_samples, double shortest_samples, const Eigen::MatrixXd& known,
                           const Eigen::MatrixXd& gain, const MorisonOptions& options) {
  if (!search.all_identifiable())
    return known_scatter(columns.rows(), columns.cols(), std::numeric_limits<double>::quiet_NaN());
  const bool perfect = residuals.squaredNorm() <= 1e-24 * unit * unit * static_cast<double>(columns.rows());
  if (perfect) return known_scatter(columns.rows(), columns.cols(), 0);
  // A fortieth of the period: the columns hardly change within, see correlated_covariance().
  const int block = std::max(1, static_cast<int>(shortest_samples / 40));
  Uncertainty u{covariance_by(options.method, columns, residuals, block, period_samples, known), {}, {}, 0, 0, 0};
  u.covariance.covariance = gain * u.covariance.covariance * gain.transpose();
  // Residuals that are quiet where the columns are make an error smaller than white ones would; the record has no more
  // samples for that.
  u.covariance.effective_samples = u.covariance.effective_samples.cwiseMin(static_cast<double>(columns.rows()));
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
  const auto [u2, a2] = flow_squares(record, window);
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

/// Frequencies of the lines, Hz.
std::vector<double> line_frequencies(const ForceRecord& r, const MorisonOptions& options, double step, double period) {
  std::vector<double> out;
  double main_hz = 0;
  for (const ForceLine& line : options.lines) {
    hydro::require((line.hz > 0) != (line.multiple > 0), "a line has either a frequency or a multiple of the motion's");
    if (line.multiple > 0 && main_hz == 0) main_hz = peak_frequency(r.velocity, step, period);
    out.push_back(line.hz > 0 ? line.hz : line.multiple * main_hz);
    hydro::require(out.back() < 0.5 / step, "a line of {:.4g} Hz lies above half the sampling rate, {:.4g} Hz",
                   out.back(), 0.5 / step);
  }
  return out;
}

std::vector<ResidualModel::Parameter> parameters(const Cylinder& c, const MorisonOptions& options,
                                                 const MorisonColumns& at, double unit, const MorisonFit& flow) {
  std::vector<ResidualModel::Parameter> out{{"cd", telling}, {inertia_name(c), telling}};
  if (at.linear >= 0) out.push_back({"linear drag", unit / flow.velocity_amplitude});
  if (at.offset >= 0) out.push_back({"offset", unit});
  for (std::size_t k = 0; k < options.lines.size(); ++k)
    for (const char* part : {"cosine", "sine"}) out.push_back({fmt::format("{} of line {}", part, k + 1), unit});
  if (at.delay >= 0) out.push_back({"delay", flow.period / 360});
  return out;
}

/// Changes of the coefficients for one standard deviation of each source; (F26).
std::vector<SystematicError> budget(const Cylinder& c, const ForceRecord& r, const Eigen::MatrixXd& columns,
                                    const Eigen::VectorXd& x, const Eigen::VectorXd& shift, const MorisonFit& fit,
                                    const MorisonOptions& options) {
  std::vector<SystematicError> out;
  const auto add = [&](const std::string& source, double cd, double inertia) {
    if (cd != 0 || inertia != 0) out.push_back({source, cd, inertia});
  };
  if (!fit.search.all_identifiable()) return out;
  const hydro::dense::HouseholderQr qr(columns);
  for (const ForceError& e : options.force_errors) {
    const Eigen::VectorXd change = qr.solve(as_vector(e.force));
    add(e.source, change[0], change[1]);
  }
  const double degrees = 360 * options.delay_error_s / fit.period;
  add("delay of the force", shift[0] * degrees, shift[1] * degrees);
  const CylinderErrors& s = options.cylinder_errors;
  // The force of the undisturbed water, ρV u̇, where it is carried beside the coefficients: one deviation takes a share
  // of it off what they explain.
  const bool both = c.experiment == Experiment::both_move;
  Eigen::VectorXd carried = Eigen::VectorXd::Zero(x.size());
  if (both) carried = qr.solve(-c.density * c.volume() * as_vector(r.water_acceleration));
  // C_D ~ 1/(ρDL), C ~ 1/(ρD²L) of the force that water takes; the mass goes with the body's own acceleration.
  const double d = s.diameter / c.diameter, l = s.length / c.length, rho = s.density / c.density;
  add("diameter", d * (2 * carried[0] - x[0]), 2 * d * (carried[1] - x[1]));
  add("length", l * (carried[0] - x[0]), l * (carried[1] - x[1]));
  add("density", rho * (carried[0] - x[0]), rho * (carried[1] - x[1]));
  // A motion larger by ε makes drag smaller by 2ε, and what goes with the acceleration, M among it, by ε. (F105)
  const double drag = -2 * options.velocity_slope * x[0],
               inertia = -options.acceleration_slope * (x[1] + c.mass_beyond_load_cells / (c.density * c.volume()));
  if (options.one_motion) {
    add("slope of the motion", drag, inertia);
  } else {
    add("slope of the velocity", drag, 0);
    add("slope of the acceleration", 0, inertia);
  }
  if (s.mass == 0) return out;
  Eigen::VectorXd own = as_vector(r.acceleration);
  if (both) own = as_vector(r.water_acceleration) - own;
  const Eigen::VectorXd change = qr.solve(own) * s.mass;
  add("mass beyond the load cells", both ? change[0] : 0.0, change[1]);
  return out;
}

Eigen::VectorXd total(const std::vector<SystematicError>& budget, Eigen::Index p) {
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(p);
  for (const SystematicError& e : budget) squares.head(2) += Eigen::Vector2d(e.cd * e.cd, e.inertia * e.inertia);
  return squares.cwiseSqrt();
}

/// Amplitude of a line from its two parts, by propagation; told where the ellipse of both leaves zero out.
FittedLine fitted_line(const SearchReport& search, double hz, Eigen::Index j, const Eigen::VectorXd& x,
                       const Uncertainty& u, double confidence) {  // (F50)
  FittedLine line{hz, {}, std::atan2(x[j + 1], x[j])};
  Coefficient& c = line.amplitude;
  const Eigen::Vector2d parts = x.segment<2>(j);
  const Eigen::Matrix2d own = u.covariance.covariance.block<2, 2>(j, j),
                        white = u.covariance.white_covariance.block<2, 2>(j, j);
  const double amplitude = parts.norm();
  const Eigen::Vector2d along = amplitude > 0 ? Eigen::Vector2d(parts / amplitude) : Eigen::Vector2d::UnitX();
  c.name = fmt::format("line of {:.4g} Hz", hz);
  c.standard_error = std::sqrt(along.dot(own * along));
  const double half = u.t * c.standard_error, white_half = u.white_t * std::sqrt(along.dot(white * along));
  c.interval = {amplitude - half, amplitude + half};
  c.white_interval = {amplitude - white_half, amplitude + white_half};
  c.effective_samples = std::min(u.covariance.effective_samples[j], u.covariance.effective_samples[j + 1]);
  // P(F_{2,ν} > f) = (1 + 2f/ν)^{−ν/2}.
  const double nu = u.covariance.dof, limit = nu / 2 * (std::pow(1 - confidence, -2 / nu) - 1);
  if (!search.identifiable[static_cast<std::size_t>(j)] || !search.identifiable[static_cast<std::size_t>(j) + 1])
    c.why_not = search.identifiability;
  else if (u.t > 0 && parts.dot(own.inverse() * parts) / 2 < limit)
    c.why_not = fmt::format("the record cannot tell it from zero ({:.2g} N with an error of {:.2g} N)", amplitude,
                            c.standard_error);
  else
    c.value = amplitude;
  return line;
}

void tell_coefficients(const Cylinder& cylinder, const MorisonOptions& options, const MorisonColumns& at,
                       const std::vector<double>& line_hz, const Eigen::VectorXd& x, const Uncertainty& u,
                       MorisonFit& result) {
  constexpr double any = std::numeric_limits<double>::infinity();
  result.cd = coefficient(result.search, "cd", 0, x[0], u);
  result.inertia = coefficient(result.search, inertia_name(cylinder), 1, x[1], u);
  if (at.linear >= 0) result.linear_drag = coefficient(result.search, "linear_drag", at.linear, x[at.linear], u, any);
  if (at.offset >= 0) result.offset = coefficient(result.search, "offset", at.offset, x[at.offset], u, any);
  for (std::size_t k = 0; k < line_hz.size(); ++k)
    result.lines.push_back(
        fitted_line(result.search, line_hz[k], at.lines + 2 * static_cast<Eigen::Index>(k), x, u, options.confidence));
  if (at.delay >= 0) result.delay = coefficient(result.search, "delay", at.delay, x[at.delay], u, result.period / 36);
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

/// Half widths about the fitted force, and about it for a new sample; (F53).
void tell_bands(const Eigen::MatrixXd& columns, const Eigen::VectorXd& residuals, const Uncertainty& u,
                MorisonFit& result) {
  const Eigen::Index n = columns.rows();
  Eigen::VectorXd squares = u.t * u.t * (columns * u.covariance.covariance).cwiseProduct(columns).rowwise().sum();
  for (const SystematicError& e : result.budget)
    squares += u.z * u.z * (columns.leftCols<2>() * Eigen::Vector2d(e.cd, e.inertia)).cwiseAbs2();
  const double scatter =
      u.t * u.t * residuals.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, n - columns.cols()));
  const Eigen::VectorXd fit = squares.cwiseMax(0).cwiseSqrt(), sample = (squares.array() + scatter).cwiseMax(0).sqrt();
  result.fit_band.assign(fit.begin(), fit.end());
  result.sample_band.assign(sample.begin(), sample.end());
  result.inside =
      static_cast<double>((residuals.cwiseAbs().array() <= sample.array()).count()) / static_cast<double>(n);
}

}  // namespace

MorisonFit fit_columns(const Cylinder& cylinder, const ForceRecord& record, const MorisonOptions& options,
                       const DelayColumn* delay) {
  check(cylinder, record, options);
  MorisonFit result;
  const double step = hydro::signal::even_step(record.time);
  describe_flow(cylinder, record, step, result);
  const std::vector<double> line_hz = line_frequencies(record, options, step, result.period);
  const MorisonColumns at(options, delay != nullptr);
  const Eigen::MatrixXd columns =
      all_columns(cylinder, record, options, line_hz, delay != nullptr ? &delay->rate : nullptr);
  const auto force = as_vector(record.force);
  const Eigen::VectorXd target = force - carried_force(cylinder, record);
  const double rows = static_cast<double>(target.size()), unit = std::sqrt(force.squaredNorm() / rows);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(columns.cols());
  result.search =
      minimise(linear_model(compress(columns, target), parameters(cylinder, options, at, unit, result), unit), x);

  if (result.search.all_identifiable()) require_ended(result.search, "the coefficients");
  if (at.count > (at.delay < 0 ? 2 : 3) && !result.search.all_identifiable())
    throw hydro::InputError(result.search.identifiability, {}, "leave out the line, offset or linear drag among them");

  Eigen::VectorXd scatter;
  if (options.robust && result.search.all_identifiable()) {
    RobustFit robust = fit_robust(columns, target, *options.robust);
    x = robust.x;
    result.share_inside = robust.share_inside;
    scatter = robust.influence / robust.slope;  // (F39)
  }
  const Attenuation put_back = result.search.all_identifiable()
                                   ? attenuation(cylinder, record, at, columns, delay, x)
                                   : Attenuation{{}, Eigen::VectorXd::Zero(columns.cols()), {}};
  x += put_back.change;
  const Eigen::VectorXd residuals = target - columns * x;
  if (scatter.size() == 0) scatter = residuals;
  result.residual_rms = std::sqrt(residuals.squaredNorm() / rows);
  result.squared_error = residuals.squaredNorm();
  result.explained = 1 - result.squared_error / (force.array() - force.mean()).matrix().squaredNorm();
  result.explained_adjusted = 1 - (1 - result.explained) * (rows - 1) / (rows - static_cast<double>(columns.cols()));
  double shortest = result.period;
  for (const double hz : line_hz) shortest = std::min(shortest, 1 / hz);
  Uncertainty u = uncertainty_of(result.search, columns, scatter, unit, result.period / step, shortest / step,
                                 known_errors(cylinder, record, at, delay, x), put_back.gain, options);
  u.shift = shift_per_degree(columns, record.force, step, result.period);
  result.budget = budget(cylinder, record, columns, x, u.shift, result, options);
  if (!put_back.change.isZero(0))
    result.budget.push_back({"noise of the motion", put_back.scatter[0], put_back.scatter[1]});
  u.systematic = total(result.budget, columns.cols());
  u.z = hydro::signal::normal_quantile((1 + options.confidence) / 2);
  tell_coefficients(cylinder, options, at, line_hz, x, u, result);
  if (options.bands && result.search.all_identifiable()) tell_bands(columns, residuals, u, result);
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

std::string sign_trouble(const Cylinder& cylinder, const MorisonFit& fit) {  // (F26)
  const double mass = cylinder.mass_beyond_load_cells / (cylinder.density * cylinder.volume());
  const Interval &drag = fit.cd.interval, &inertia = fit.inertia.interval;
  const bool drag_back = drag.high < 0 && !(inertia.low + mass > 0),
             inertia_back = inertia.high + mass < 0 && !(drag.low > 0);
  if (!drag_back && !inertia_back) return {};
  return fmt::format("{} (cd {:.3g} at most, inertia {:.3g} at most): the force or the motion has the wrong sign",
                     drag.high < 0 && inertia.high + mass < 0 ? "drag and inertia both come out negative"
                     : drag_back ? "drag comes out negative, and inertia no larger than zero for certain"
                                 : "inertia comes out negative, and drag no larger than zero for certain",
                     drag.high, inertia.high);
}

}  // namespace fit
