/// What nodes with prescribed motion need, and how it follows them: the rest of the line eliminated. (D90)
#include <limits>

#include "equations.hpp"

namespace dynamics::line {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// First and last index that shares an equation with this one.
std::pair<int, int> band(int index, const BandMatrix& matrix, Eigen::Index size) {
  return {std::max(0, index - matrix.half()), std::min(static_cast<int>(size) - 1, index + matrix.half())};
}

}  // namespace

/// Columns of the assembled matrix that belong to the places of nodes with prescribed motion, (all unknowns, 3k).
BandMatrix::Columns Equations::columns_of(const std::vector<int>& prescribed) {
  BandMatrix::Columns out = BandMatrix::Columns::Zero(rhs_.size(), 3 * static_cast<Eigen::Index>(prescribed.size()));
  for (Eigen::Index k = 0; k < out.cols(); ++k) {
    const int column = place_index(prescribed[static_cast<std::size_t>(k / 3)]) + static_cast<int>(k % 3);
    const auto [first, last] = band(column, matrix_, rhs_.size());
    for (int row = first; row <= last; ++row) out(row, k) = matrix_(row, column);
  }
  return out;
}

/// Rows of the balance of nodes with prescribed motion times y, (3k, columns of y).
MatrixXd Equations::rows_times(const std::vector<int>& prescribed, const BandMatrix::Columns& y) {
  MatrixXd out = MatrixXd::Zero(3 * static_cast<Eigen::Index>(prescribed.size()), y.cols());
  for (Eigen::Index k = 0; k < out.rows(); ++k) {
    const int row = place_index(prescribed[static_cast<std::size_t>(k / 3)]) + static_cast<int>(k % 3);
    const auto [first, last] = band(row, matrix_, rhs_.size());
    for (int column = first; column <= last; ++column) out.row(k) += matrix_(row, column) * y.row(column);
  }
  return out;
}

Response Equations::response(const Stage& stage, const State& before, const Places& u, const VectorXd& T,
                             const std::vector<int>& prescribed, double a_by_v) {
  scale_for(stage, T);
  // The end of the step as a place from which displacements count: the nodes that are prescribed by place and by
  // velocity apart, the others as the step has it.
  State end = before;
  end.position += stage.x_by * u;
  Stage here = stage;
  here.v_from += stage.v_by * u;
  here.a_from += stage.a_by * u;
  const Places none = Places::Zero(3, line_.nodes());
  const auto follow = [&](double v_by, double a_by) {
    here.v_by = v_by;
    here.a_by = a_by;
    assemble(here, end, none, T, true);
  };
  const auto count = 3 * static_cast<Eigen::Index>(prescribed.size());
  BandMatrix::Columns by(rhs_.size(), 2 * count);
  follow(0, 0);
  by.leftCols(count) = columns_of(prescribed);
  if (stage.still) {
    by.rightCols(count).setZero();
  } else {
    follow(1, a_by_v);
    by.rightCols(count) = columns_of(prescribed) - by.leftCols(count);
  }
  follow(stage.v_by, stage.a_by);
  Response out;
  out.force = Places(3, static_cast<Eigen::Index>(prescribed.size()));
  MatrixXd direct(count, 2 * count);
  for (std::size_t k = 0; k < prescribed.size(); ++k) {
    out.force.col(static_cast<Eigen::Index>(k)) = residual_.col(prescribed[k]);
    direct.middleRows<3>(3 * static_cast<Eigen::Index>(k)) = by.middleRows<3>(place_index(prescribed[k]));
  }
  BandMatrix::Columns y = -by;
  for (const Held& h : line_.description().held) y.middleRows<3>(place_index(h.node)).setZero();
  for (int c = 0; c < line_.chains(); ++c) y.row(4 * line_.first_of_chain(c)).setZero();
  const BandMatrix whole = matrix_;
  keep_held();
  const bool solved = network_ ? network_->solve(matrix_, y) : matrix_.solve(y);
  matrix_ = whole;
  const MatrixXd total = direct + rows_times(prescribed, y);
  out.by_place = total.leftCols(count);
  out.by_velocity = total.rightCols(count);
  if (!solved) out.force.setConstant(std::numeric_limits<double>::quiet_NaN());
  return out;
}

}  // namespace dynamics::line
