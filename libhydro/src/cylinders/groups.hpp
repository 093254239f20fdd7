#pragma once
/// \file  All cylinders at one frequency: groups of close ones solved first, then the groups together (C11). Not
/// installed.
#include <Eigen/Core>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "array.hpp"

namespace hydro::cylinders {

/// How cylinders are grouped, and what passes within and between groups.
struct Grouping {
  std::vector<std::vector<std::size_t>> members;
  Channels within, between;  ///< `within` holds all of `between`
  double work;               ///< estimate, complex multiplications
};

/// The grouping that costs least among those that join all pairs closer than some distance. `kind[i]`: equal cylinders
/// have equal numbers.
Grouping choose_grouping(const std::vector<Cylinder>& cylinders, const std::vector<std::size_t>& kind,
                         const VerticalModes& modes, double threshold);

/// A group's shape: equal for groups that are copies of each other.
std::string shape_of(const std::vector<std::size_t>& members, const std::vector<Cylinder>& cylinders,
                     const std::vector<std::size_t>& kind);

/// Answers for waves that arrive (columns first) and for motions (columns after).
struct Response {
  Eigen::MatrixXcd sent_out;  ///< amplitudes b in the partial waves between groups
  Eigen::MatrixXcd loads;     ///< ∬ φ n dS, 6 a cylinder
};

class Groups {
 public:
  /// `scatterer[i]` belongs to cylinder i.
  Groups(std::vector<Cylinder> cylinders, const std::vector<std::size_t>& kind,
         const std::vector<const Scatterer*>& scatterer, const VerticalModes& modes, const Grouping& grouping,
         double precision);

  int partial_waves() const { return between_.count(); }
  /// Potentials Z_0(z) e^{−ik(x cos β + y sin β)}, one a heading, and velocities (6 a cylinder, columns).
  Response respond(const std::vector<double>& heading, const Eigen::MatrixXd& motion) const;
  /// f(θ) of the waves sent out, φ → f(θ) √(2/(πkr)) e^{−i(kr − π/4)} Z_0(z) (C13): one row an angle.
  Eigen::MatrixXcd far_field(const Eigen::MatrixXcd& sent_out, const std::vector<double>& angle) const;

 private:
  Eigen::MatrixXcd plane_waves(const std::vector<double>& heading) const;
  Eigen::MatrixXcd translated(const Eigen::MatrixXcd& b) const;
  /// Σ over groups of one of the four matrices of each, applied to rows of x; `rows`, `columns` a cylinder.
  Eigen::MatrixXcd apply(Eigen::MatrixXcd Compound::*part, const Eigen::MatrixXcd& x, Eigen::Index rows,
                         Eigen::Index columns) const;
  std::size_t group_of(std::size_t cylinder) const { return group_of_[cylinder]; }

  std::vector<Cylinder> cylinders_;
  const VerticalModes& modes_;
  std::vector<std::vector<std::size_t>> members_;
  std::vector<std::size_t> group_of_;
  Channels between_;
  WaveIndex index_;
  std::vector<RadialScales> scale_;
  std::vector<std::shared_ptr<const Compound>> compound_;  // of each group
  std::vector<Translation> G_;                             // [to * cylinders + from], empty within a group
};

}  // namespace hydro::cylinders
