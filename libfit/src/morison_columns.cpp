#include "morison_columns.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "dynamics/force/morison.hpp"
#include "golden_section.hpp"

namespace fit {
namespace {

/// |Σ w u e^{−iωjΔt}|² with the Hann weights w, by turning a phasor.
double power_at(std::span<const double> motion, double step, double omega) {
  const auto n = motion.size();
  const std::complex<double> turn = std::polar(1.0, -omega * step),
                             fade = std::polar(1.0, 2 * std::numbers::pi / static_cast<double>(n));
  std::complex<double> phasor = 1, window = std::sqrt(fade), sum = 0;
  for (std::size_t j = 0; j < n; ++j) {
    sum += (1 - window.real()) / 2 * motion[j] * phasor;
    phasor *= turn;
    window *= fade;
  }
  return std::norm(sum);
}

/// Velocity of the water past the body, and the accelerations of both.
struct Flow {
  double past, water, own;
};
Flow flow_of(Experiment experiment, double velocity, double acceleration, double water_acceleration) {
  switch (experiment) {
    case Experiment::water_moves:
      return {velocity, acceleration, 0};
    case Experiment::body_moves:
      return {-velocity, 0, acceleration};
    case Experiment::both_move:
      break;
  }
  return {velocity, water_acceleration, water_acceleration - acceleration};
}

}  // namespace

double Cylinder::volume() const { return std::numbers::pi / 4 * diameter * diameter * length; }

double morison_force(const Cylinder& c, double cd, double inertia, double velocity, double acceleration,
                     double water_acceleration) {  // (F7), (F8), (F49)
  const Flow f = flow_of(c.experiment, velocity, acceleration, water_acceleration);
  const double ca = c.experiment == Experiment::water_moves ? inertia - 1 : inertia;
  const dynamics::MorisonPerLength load(c.diameter, c.density, cd, ca);
  return c.length * (load.drag(f.past, std::abs(f.past)) + load.inertia(f.water, f.own)) -
         c.mass_beyond_load_cells * f.own;
}

Eigen::MatrixXd morison_columns(const Cylinder& c, const ForceRecord& r) {  // (F7), (F8), (F25), (F49)
  Cylinder alone = c;  // what else the load cells carry has no coefficient
  alone.mass_beyond_load_cells = 0;
  const Eigen::Index n = std::ssize(r.velocity);
  Eigen::MatrixXd columns(n, 2);
  const double of_unit_flow = morison_force(alone, 1, 0, 1, 0);
  const auto u = as_vector(r.velocity), a = as_vector(r.acceleration);
  for (Eigen::Index j = 0; j < n; ++j) {
    columns(j, 0) = r.drag_flow.empty() ? morison_force(alone, 1, 0, u[j], 0)
                                        : of_unit_flow * r.drag_flow[static_cast<std::size_t>(j)];
    columns(j, 1) = morison_force(alone, 0, 1, 0, a[j]);
  }
  return columns;
}

namespace {

Eigen::VectorXd linear_column(const Cylinder& c, const ForceRecord& r) {  // (F51)
  return (c.experiment == Experiment::body_moves ? -1 : 1) *
         as_vector(r.linear_flow.empty() ? r.velocity : r.linear_flow);
}

}  // namespace

Eigen::VectorXd carried_force(const Cylinder& c, const ForceRecord& r) {
  const bool both = c.experiment == Experiment::both_move;
  Eigen::VectorXd out(std::ssize(r.acceleration));
  for (std::size_t j = 0; j < r.acceleration.size(); ++j)
    out[static_cast<Eigen::Index>(j)] =
        morison_force(c, 0, 0, 0, r.acceleration[j], both ? r.water_acceleration[j] : 0);
  return out;
}

MorisonColumns::MorisonColumns(const MorisonOptions& options, bool with_delay) {
  if (options.linear_drag) linear = count++;
  if (options.force_offset) offset = count++;
  if (!options.lines.empty()) lines = count;
  count += 2 * std::ssize(options.lines);
  if (with_delay) delay = count++;
}

Eigen::MatrixXd all_columns(const Cylinder& c, const ForceRecord& r, const MorisonOptions& options,
                            const std::vector<double>& line_hz, const Eigen::VectorXd* delay_column) {
  const MorisonColumns at(options, delay_column != nullptr);
  Eigen::MatrixXd columns = morison_columns(c, r);
  if (at.count == 2) return columns;
  columns.conservativeResize(Eigen::NoChange, at.count);
  if (at.linear >= 0) columns.col(at.linear) = linear_column(c, r);
  if (at.offset >= 0) columns.col(at.offset).setOnes();
  for (std::size_t k = 0; k < line_hz.size(); ++k) {  // (F50)
    const Eigen::ArrayXd angle = 2 * std::numbers::pi * line_hz[k] * as_vector(r.time).array();
    columns.col(at.lines + 2 * static_cast<Eigen::Index>(k)) = angle.cos();
    columns.col(at.lines + 2 * static_cast<Eigen::Index>(k) + 1) = -angle.sin();
  }
  if (at.delay >= 0) columns.col(at.delay) = *delay_column;
  return columns;
}

namespace {

/// The columns are linear in the flows of a record: errors go through them as flows do.
ForceRecord as_record(const MotionError& e) {
  return {.time = {},
          .force = {},
          .velocity = e.velocity,
          .acceleration = e.acceleration,
          .drag_flow = e.drag_flow,
          .water_acceleration = e.water_acceleration,
          .linear_flow = e.linear_flow};
}

}  // namespace

Eigen::MatrixXd column_errors(const Cylinder& c, const MotionError& e, const MorisonColumns& at) {
  const ForceRecord flows = as_record(e);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(std::ssize(e.velocity), at.count);
  out.leftCols<2>() = morison_columns(c, flows);
  if (at.linear >= 0) out.col(at.linear) = linear_column(c, flows);
  return out;
}

Eigen::VectorXd carried_error(const Cylinder& c, const MotionError& e) { return carried_force(c, as_record(e)); }

FlowSquares flow_squares(const ForceRecord& record, const Eigen::ArrayXd& weights) {  // (F116)
  const auto squares = [&](const std::vector<double>& v) { return (weights * as_vector(v).array().square()).sum(); };
  const FlowSquares all{squares(record.velocity), squares(record.acceleration)};
  FlowSquares out = all;
  for (const MotionError& e : record.motion_errors) {
    out.velocity -= squares(e.velocity) / static_cast<double>(record.motion_errors.size());
    out.acceleration -= squares(e.acceleration) / static_cast<double>(record.motion_errors.size());
  }
  return {std::max(out.velocity, all.velocity / 2), std::max(out.acceleration, all.acceleration / 2)};
}

double peak_frequency(std::span<const double> r, double step, double period) {  // (F50)
  const double omega = 2 * std::numbers::pi / period,
               bin = 2 * std::numbers::pi / (step * static_cast<double>(r.size()));
  const double at = least_by_golden_section([&](double w) { return -power_at(r, step, w); },
                                            std::max(omega - bin, 0.1 * omega), omega + bin, 1e-6 * bin);
  return at / (2 * std::numbers::pi);
}

}  // namespace fit
