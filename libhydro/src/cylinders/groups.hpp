#pragma once
/// \file  All cylinders at one frequency: groups of close ones solved first, then the groups together (C11). Not
/// installed.
#include <Eigen/Core>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "array.hpp"
#include "between.hpp"
#include "hydro/cylinders/solve.hpp"
#include "iterate.hpp"

namespace hydro::cylinders {

/// How cylinders are grouped, and what passes within and between groups.
struct Grouping {
  std::vector<std::vector<std::size_t>> members;
  Channels within, between;  ///< `within` holds all of `between`
  double steps;              ///< expected of an iteration between the groups
  double work;               ///< estimate, complex multiplications
};

/// Of an iteration between groups: as seen, up to 100 cylinders.
double expected_steps(const VerticalModes& modes, const std::vector<Cylinder>& cylinders);
/// Between the axes of the farthest two.
double distance_across(const std::vector<Cylinder>& cylinders);

/// Every cylinder, or circle about a hull, a group by itself, between which waves of these channels pass.
Grouping each_alone(const Channels& channels, const VerticalModes& modes, const std::vector<Cylinder>& cylinders);

/// A group's shape: equal for groups that are copies of each other.
std::string shape_of(const std::vector<std::size_t>& members, const std::vector<Cylinder>& cylinders,
                     const std::vector<std::size_t>& kind);

/// The work of solving the groups together, in complex multiplications and bytes, as far as it is known beforehand.
struct EquationsCost {
  bool iterative;
  double work, bytes;
};

/// By elimination or by iteration: the one that needs fewer multiplications, unless `wanted` says which (C15).
/// `columns`: motions and headings; `lattice` may be null.
EquationsCost equations_cost(const Grouping& grouping, std::size_t cylinders, const Lattice* lattice, double columns,
                             Equations wanted);

/// The same of solving the groups by themselves, which is direct.
EquationsCost compounds_cost(const Grouping& grouping, const std::vector<Cylinder>& cylinders,
                             const std::vector<std::size_t>& kind);

/// The grouping that costs least among those that join all pairs closer than some distance. `kind[i]`: equal cylinders
/// have equal numbers; `columns`: motions; `steps`: expected of an iteration.
Grouping choose_grouping(const std::vector<Cylinder>& cylinders, const std::vector<std::size_t>& kind,
                         const Lattice* lattice, const VerticalModes& modes, double threshold, double columns,
                         double steps, Equations wanted);

/// Motions and headings that an iteration takes side by side.
inline constexpr Eigen::Index columns_at_a_time = 48;

/// What arrives at the cylinders, of waves (columns first) and of motions (columns after).
struct Arrived {
  Amplitudes a;  ///< in the partial waves between groups
  int steps;     ///< of the iteration; 0: solved by elimination
  bool lattice;  ///< waves passed over a lattice
};

/// Answers for waves that arrive (columns first) and for motions (columns after).
struct Response {
  Eigen::MatrixXcd sent_out;  ///< amplitudes b in the partial waves between groups
  Eigen::MatrixXcd loads;     ///< ∬ φ n dS, 6 a cylinder
  int steps;                  ///< of the iteration; 0: solved by elimination
  bool lattice;               ///< waves passed over a lattice
};

class Groups {
 public:
  /// `scatterer[i]` belongs to cylinder i; `lattice` may be null.
  Groups(std::vector<Cylinder> cylinders, const std::vector<std::size_t>& kind, const Lattice* lattice,
         const std::vector<const Scatterer*>& scatterer, const VerticalModes& modes, Grouping grouping,
         double precision);
  /// Scatterers that are known as compounds, every one a group by itself: `compound[kind[i]]` belongs to cylinder i,
  /// which is the circle outside of which its waves are.
  Groups(std::vector<Cylinder> cylinders, const std::vector<std::size_t>& kind, const Lattice* lattice,
         const std::vector<std::shared_ptr<const Compound>>& compound, const VerticalModes& modes, Grouping grouping,
         double precision);

  int partial_waves() const { return grouping_.between.count(); }
  /// Potentials Z_0(z) e^{−ik(x cos β + y sin β)}, one a heading, and velocities (6 a cylinder, columns).
  /// \throws InputError if iteration is wanted and does not converge; where it was chosen here, elimination follows
  Response respond(const std::vector<double>& heading, const Eigen::MatrixXd& motion, Equations wanted) const;
  /// The part of respond() that solves. \throws InputError as respond()
  Arrived arrived(const std::vector<double>& heading, const Eigen::MatrixXd& motion, Equations wanted) const;
  /// Amplitudes b of the waves that are sent out where `a` arrives, columns as arrived() has them.
  Amplitudes sent_out(const Amplitudes& a, const Eigen::MatrixXd& motion) const;
  /// f(θ) of the waves sent out, φ → f(θ) √(2/(πkr)) e^{−i(kr − π/4)} Z_0(z) (C13): one row an angle.
  Eigen::MatrixXcd far_field(const Eigen::MatrixXcd& sent_out, const std::vector<double>& angle) const;

 private:
  /// Without compounds.
  Groups(std::vector<Cylinder> cylinders, const Lattice* lattice, const VerticalModes& modes, Grouping grouping,
         double precision);
  Eigen::MatrixXcd plane_waves(const std::vector<double>& heading) const;
  Between between(const Lattice* lattice) const;
  std::optional<Iterated> iterated(const Between& between, const Amplitudes& arriving) const;
  /// Σ over groups of one of the four matrices of each, applied to rows of x; `rows`, `columns` a cylinder.
  Amplitudes apply(Eigen::MatrixXcd Compound::*part, const Amplitudes& x, Eigen::Index rows,
                   Eigen::Index columns) const;

  std::vector<Cylinder> cylinders_;
  const Lattice* lattice_;
  const VerticalModes& modes_;
  Grouping grouping_;
  WaveIndex index_;
  double precision_;
  std::vector<RadialScales> scale_;
  GroupedCylinders groups_;
};

}  // namespace hydro::cylinders
