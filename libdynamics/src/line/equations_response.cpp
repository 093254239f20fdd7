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
void Equations::find_columns(const std::vector<int>& prescribed, Eigen::Ref<BandMatrix::Columns> out) {
  out.setZero();
  for (Eigen::Index k = 0; k < out.cols(); ++k) {
    const int column = place_index(prescribed[static_cast<std::size_t>(k / 3)]) + static_cast<int>(k % 3);
    const auto [first, last] = band(column, matrix_, rhs_.size());
    for (int row = first; row <= last; ++row) out(row, k) = matrix_(row, column);
  }
}

/// Adds to (3k, columns of y) the rows of the balance of nodes with prescribed motion times y.
void Equations::add_rows_times(const std::vector<int>& prescribed, const BandMatrix::Columns& y, MatrixXd& out) {
  for (Eigen::Index k = 0; k < out.rows(); ++k) {
    const int row = place_index(prescribed[static_cast<std::size_t>(k / 3)]) + static_cast<int>(k % 3);
    const auto [first, last] = band(row, matrix_, rhs_.size());
    for (int column = first; column <= last; ++column) out.row(k) += matrix_(row, column) * y.row(column);
  }
}

/// Assembles the end of the step where all nodes follow their displacements so.
void Equations::follow(double v_by, double a_by, const VectorXd& T) {
  follow_.here.v_by = v_by;
  follow_.here.a_by = a_by;
  assemble(follow_.here, follow_.end, none_, T, true);
}

/// What prescribed places and velocities do by themselves, the former in the first half of the columns.
void Equations::find_columns_of_motion(const Stage& stage, const VectorXd& T, const std::vector<int>& prescribed,
                                       double a_by_v) {
  const auto count = 3 * static_cast<Eigen::Index>(prescribed.size());
  BandMatrix::Columns& by = follow_.by;
  by.resize(rhs_.size(), 2 * count);
  follow(0, 0, T);
  find_columns(prescribed, by.leftCols(count));
  if (stage.still) {
    by.rightCols(count).setZero();
    return;
  }
  follow(1, a_by_v, T);
  find_columns(prescribed, by.rightCols(count));
  by.rightCols(count) -= by.leftCols(count);
}

/// What the rest of the line does then, with the assembled matrix, which stays.
bool Equations::solve_columns() {
  BandMatrix::Columns& y = follow_.y;
  y = -follow_.by;
  for (const Held& h : line_.description().held) y.middleRows<3>(place_index(h.node)).setZero();
  for (int c = 0; c < line_.chains(); ++c) y.row(4 * line_.first_of_chain(c)).setZero();
  follow_.matrix = matrix_;
  keep_held();
  const bool solved = network_ ? network_->solve(matrix_, y) : matrix_.solve(y);
  std::swap(matrix_, follow_.matrix);
  return solved;
}

const Response& Equations::response(const Stage& stage, const State& before, const Places& u, const VectorXd& T,
                                    const std::vector<int>& prescribed, double a_by_v) {
  scale_for(stage, T);
  // The end of the step as a place from which displacements count: the nodes that are prescribed by place and by
  // velocity apart, the others as the step has it.
  follow_.end = before;
  follow_.end.position += stage.x_by * u;
  follow_.here = stage;
  follow_.here.v_from += stage.v_by * u;
  follow_.here.a_from += stage.a_by * u;
  find_columns_of_motion(stage, T, prescribed, a_by_v);
  follow(stage.v_by, stage.a_by, T);
  const auto count = 3 * static_cast<Eigen::Index>(prescribed.size());
  Response& out = follow_.found;
  out.force.resize(3, static_cast<Eigen::Index>(prescribed.size()));
  follow_.of_rest.setZero(count, 2 * count);
  MatrixXd& total = follow_.total;
  total.resize(count, 2 * count);
  for (std::size_t k = 0; k < prescribed.size(); ++k) {
    out.force.col(static_cast<Eigen::Index>(k)) = residual_.col(prescribed[k]);
    total.middleRows<3>(3 * static_cast<Eigen::Index>(k)) = follow_.by.middleRows<3>(place_index(prescribed[k]));
  }
  const bool solved = solve_columns();
  add_rows_times(prescribed, follow_.y, follow_.of_rest);
  total += follow_.of_rest;
  out.by_place = total.leftCols(count);
  out.by_velocity = total.rightCols(count);
  if (!solved) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    out.force.setConstant(unknown);
    out.by_place.setConstant(unknown);
    out.by_velocity.setConstant(unknown);
  }
  return out;
}

}  // namespace dynamics::line
