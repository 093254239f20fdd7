#pragma once
/// \file  What a record holds beside a part of known law; (F69), docs/theory/fit.md. Private to libfit.
#include <Eigen/Core>

namespace fit {

/// The rest has the autocovariance level · ratio.
struct RestMemory {
  double level;           ///< of the rest's spectrum were it white, as a variance of one sample
  Eigen::VectorXd ratio;  ///< autocovariance of the record made white by what is known and that level; lags 0, 1 …
};
/// `known`: draws of the known part, shape (n, draws). Spectra are those under a Hann window, so that what is strong at
/// high frequencies does not leak to low ones.
RestMemory rest_memory(const Eigen::VectorXd& record, const Eigen::MatrixXd& known, Eigen::Index lags);

}  // namespace fit
