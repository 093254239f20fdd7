#pragma once
/// \file  Private to apps: drag on members in responses to a random sea, linear for that sea. (D143)
#include <string>
#include <vector>

#include "answers/sea_directions.hpp"
#include "compile/compile.hpp"
#include "dynamics/frequency/sea_drag.hpp"

namespace froude {

/// What linear drag of one member is, over its pieces.
struct MemberDrag {
  std::string member;
  double sigma_major, sigma_minor;  ///< of relative velocity across it, m/s, the root of the mean square of its pieces
  double coefficient;               ///< of all pieces, N s/m
};

/// How drag was made linear for a sea.
struct DragInSea {
  int iterations;
  double residual;  ///< relative, of the largest coefficient
  std::vector<MemberDrag> members;
};

/// Of wave systems whose directions are headings of the scene's [ask.rao], by the trapezium rule over `omega`, rad/s.
/// `start`: coefficients of a neighbouring question, or none. `slow`: covariances of further velocities, one a piece,
/// or none. \throws hydro::NumericsError where drag does not settle
dynamics::frequency::SeaDrag sea_drag(const scene::Scene& scene, const compile::Prepared& prepared,
                                      const std::vector<System>& systems, const std::vector<double>& omega,
                                      const Eigen::VectorXd& start, const std::vector<Eigen::Matrix3d>& slow = {});

DragInSea by_member(const scene::Scene& scene, const compile::Prepared& prepared,
                    const dynamics::frequency::SeaDrag& found);

}  // namespace froude
