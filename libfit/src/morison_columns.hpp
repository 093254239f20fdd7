#pragma once
/// \file  The linear problem behind a Morison fit.
#include <Eigen/Core>

#include <span>

#include "fit/morison.hpp"

namespace fit {

inline Eigen::Map<const Eigen::VectorXd> as_vector(const std::vector<double>& v) {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}

/// Columns dF/dC_D and dF/dC_M or dF/dC_A, (F7), (F8), (F49), with the drag flow as it is given; shape (n, 2).
Eigen::MatrixXd morison_columns(const Cylinder& cylinder, const ForceRecord& record);

/// What the load cells carry whatever the coefficients are, N: −m a of a body that moves, with ρV u̇ where the water
/// does too; zero for a body at rest.
Eigen::VectorXd carried_force(const Cylinder& cylinder, const ForceRecord& record);

/// Weighted squares of velocity and acceleration of the motion itself: less the mean of what its noise adds, of which
/// more than half is not believed (F116).
struct FlowSquares {
  double velocity, acceleration;
};
FlowSquares flow_squares(const ForceRecord& record, const Eigen::ArrayXd& weights);

/// Where a coefficient stands among the columns; −1 where it is not fitted.
struct MorisonColumns {
  Eigen::Index linear = -1, offset = -1, lines = -1, delay = -1, count = 2;
  MorisonColumns(const MorisonOptions& options, bool with_delay);
};

/// All columns: those of morison_columns(), then a linear drag, an offset, a cosine and a sine for each line, and the
/// delay, as they are asked for.
Eigen::MatrixXd all_columns(const Cylinder& cylinder, const ForceRecord& record, const MorisonOptions& options,
                            const std::vector<double>& line_hz, const Eigen::VectorXd* delay_column);

/// Errors of all columns for one draw of the motion's noise, shape (n, at.count), and of what is carried, N; (F68).
Eigen::MatrixXd column_errors(const Cylinder& cylinder, const MotionError& error, const MorisonColumns& at);
Eigen::VectorXd carried_error(const Cylinder& cylinder, const MotionError& error);

/// The frequency of a motion near 1/`period_s`, where its Fourier transform under a Hann window has its peak, Hz;
/// (F50).
double peak_frequency(std::span<const double> motion, double step_s, double period_s);

/// −dF/dt of the force that coefficients give, N/s, and its error for each draw of the motion's noise.
struct DelayColumn {
  Eigen::VectorXd rate;
  std::vector<Eigen::VectorXd> errors;  ///< as many as motion_errors of the record
};

/// fit_morison() with one more column, of which the coefficient is a delay in s; null: none.
MorisonFit fit_columns(const Cylinder& cylinder, const ForceRecord& record, const MorisonOptions& options,
                       const DelayColumn* delay);

}  // namespace fit
