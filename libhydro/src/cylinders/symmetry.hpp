#pragma once
/// \file  Mirrors and quarter turns that leave an arrangement as it is: most of its motions are images of others, and
/// need no solution of their own. (C23) in docs/theory/cylinders.md. Not installed.
#include <Eigen/Core>

#include <functional>
#include <vector>

#include "hydro/cylinders/layout.hpp"
#include "hydro/potential/coefficients.hpp"

namespace hydro::cylinders {

/// Of an arrangement about its middle: every body comes to where an equal one stood.
struct Symmetry {
  Eigen::Matrix2d turn;            ///< of directions: orthogonal, its entries 0, 1 and −1
  std::vector<std::size_t> image;  ///< of each body

  /// What it makes of the six modes of a body.
  potential::Matrix6 modes() const;
};

/// Which motions are solved, and how the others follow.
class SolvedMotions {
 public:
  /// Of bodies whose circles are `circle`, equal ones having equal `kind`, moved by `motion` (6 circles, 6 bodies).
  /// `has_symmetry(kind, turn)`: whether what stands in a circle is unchanged by it; circles are. Where all motions are
  /// solved side by side anyway, none is left out.
  SolvedMotions(const std::vector<Cylinder>& circle, const std::vector<std::size_t>& kind,
                const Eigen::MatrixXd& motion,
                const std::function<bool(std::size_t kind, const Eigen::Matrix2d& turn)>& has_symmetry);
  /// All, of so many bodies.
  explicit SolvedMotions(std::size_t bodies);

  const std::vector<Eigen::Index>& columns() const { return column_; }  ///< of the motions that are solved
  /// Loads on all bodies (6N, columns()) of the solved motions → of all motions, (6N, 6N).
  Eigen::MatrixXcd loads(const Eigen::MatrixXcd& solved) const;
  /// Waves far away in the directions `angle`, (angles, 6N), of the wavenumber k; `of_solved` gives those of the solved
  /// motions in other directions.
  Eigen::MatrixXcd far_field(const std::vector<double>& angle, double k,
                             const std::function<Eigen::MatrixXcd(const std::vector<double>&)>& of_solved) const;

 private:
  struct From {
    std::size_t symmetry, solved;  // by which, of which of the solved bodies
  };
  void choose();

  Eigen::Vector2d middle_ = Eigen::Vector2d::Zero();
  std::vector<Symmetry> symmetry_;  // the first changes nothing
  std::vector<From> from_;          // of each body
  std::vector<Eigen::Index> column_;
};

}  // namespace hydro::cylinders
