#pragma once
/// \file  A layout in water of one finite depth, solved frequency by frequency. Not installed.
#include <Eigen/Core>

#include <deque>
#include <limits>
#include <vector>

#include "answers.hpp"
#include "hydro/cylinders/layout.hpp"
#include "submerged.hpp"
#include "truncated.hpp"

namespace hydro::cylinders {

/// The frequency at which added mass has its other limit.
inline constexpr double infinite = std::numeric_limits<double>::infinity();

/// How much of each infinite set is kept.
struct Resolution {
  int gap_functions;  ///< per family (C5)
  double threshold;   ///< coupling below which partial waves are left out (C11)
  Equations equations = Equations::automatic;
  int orders = 2;  ///< azimuthal orders that single cylinders can be asked for, at least: as many as couple, or more
  Resolution doubled() const;
};

/// What one frequency takes, told beforehand.
struct ModelCost {
  int unknowns;    ///< complex, of the largest set of equations
  double work;     ///< complex multiplications
  double bytes;    ///< of working memory
  bool iterative;  ///< the equations between groups
};

/// Enough modes of one frequency (+∞ allowed) to find which of them couple.
/// \throws InputError for more terms of the sums over the depth than are taken
VerticalModes modes_that_may_couple(const std::vector<Cylinder>& cylinders, const Water& water, double omega);

/// \throws InputError if so much is left out by the partial waves that can be had that no digit is certain;
/// `scatterers` is what they pass between
void require_coupling(const Channels& channels, const char* scatterers, double omega);

/// Waves that cylinders send out, near them too.
struct SentOut {
  VerticalModes modes;
  Channels channels;     ///< more than pass between cylinders: enough to tell φ at the nearest point
  Amplitudes amplitude;  ///< b of (C4), by WaveIndex; of the wave that arrives, then of the velocities
  std::vector<double> angle;
  Eigen::MatrixXcd far;  ///< f of (C13) at these, columns as of `amplitude`
};

/// The fewest gap functions with which doubling changes the single cylinders by less than the tolerance at both ends of
/// `omega` and in the limit. \throws InputError with the digits that can be had
int choose_gap_functions(const std::vector<CylinderBody>& bodies, const Water& water, const std::vector<double>& omega,
                         double tolerance);

class Model {
 public:
  enum class Asked { answers, cost };  ///< for the cost alone nothing is built

  /// `water` is of finite depth; `omega`: all frequencies that will be asked for, +∞ apart.
  Model(const std::vector<CylinderBody>& bodies, const Water& water, const Resolution& resolution,
        const std::vector<double>& omega, Asked asked = Asked::answers);

  OneFrequency at(double omega, const std::vector<double>& heading) const;
  Eigen::MatrixXd added_mass_at_infinity() const;
  /// Waves that the cylinders send out at one frequency: of a unit plane wave Z_0 and of velocities of the bodies.
  SentOut sent_out(double omega, double heading, const Eigen::MatrixXd& velocity, double nearest) const;
  /// Largest relative difference of the single cylinders' loads and diffraction from those of another resolution.
  double difference(const Model& other, double omega) const;
  /// What at() will take.
  ModelCost cost(double omega, double headings) const;
  /// What the model itself takes to be built, complex multiplications; one in water of finite depth serves all
  /// frequencies.
  double building_work() const;
  const std::vector<Cylinder>& cylinders() const { return cylinders_; }

 private:
  struct Type {
    double radius;
    std::optional<double> draught;
    std::optional<double> top;
    std::optional<TruncatedCylinder> truncated;  ///< if it has a draught and no top under water
    std::optional<SubmergedCylinder> submerged;  ///< if it has a top under water; neither: bottom-mounted
  };
  int exterior_terms(const Type& type, double K) const;
  Scatterer scatterer(const Type& type, const VerticalModes& modes, const Channels& channels) const;
  void sort_into_types(const std::vector<CylinderBody>& bodies);
  void build_types();
  VerticalModes modes(double omega) const;
  Grouping grouping(const VerticalModes& modes) const;
  std::vector<Scatterer> scatterers(const VerticalModes& modes, const Channels& channels) const;
  Groups groups(const std::vector<Scatterer>& of_type, const VerticalModes& modes, const Grouping& grouping) const;

  Water water_;
  Resolution resolution_;
  const Lattice* lattice() const { return lattice_ ? &*lattice_ : nullptr; }

  std::vector<Cylinder> cylinders_;
  std::optional<Lattice> lattice_;
  Eigen::MatrixXd motion_;  // (6 cylinders, 6 bodies): velocities of the cylinders when the bodies move
  SolvedMotions solved_{0};
  std::vector<Type> types_;
  std::vector<std::size_t> type_of_;
  int orders_;
};

}  // namespace hydro::cylinders
