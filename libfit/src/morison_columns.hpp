#pragma once
/// \file  The linear problem behind a Morison fit.
#include <Eigen/Core>

#include "fit/morison.hpp"

namespace fit {

inline Eigen::Map<const Eigen::VectorXd> as_vector(const std::vector<double>& v) {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}

/// Columns dF/dC_D and dF/dC_M or dF/dC_A, (F7), (F8), with the drag flow as it is given; shape (n, 2).
Eigen::MatrixXd morison_columns(const Cylinder& cylinder, const ForceRecord& record);

/// fit_morison() with one more column −dF/dt, N/s, of which the coefficient is a delay in s; null: none.
MorisonFit fit_columns(const Cylinder& cylinder, const ForceRecord& record, const MorisonOptions& options,
                       const Eigen::VectorXd* delay_column);

}  // namespace fit
