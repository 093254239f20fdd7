#pragma once
/// \file  A model in waves of one period as a periodic system of the motions that joints leave. (Q13),
/// docs/theory/frequency.md.
#include <optional>

#include "dynamics/frequency/harmonic_balance.hpp"
#include "dynamics/frequency/small_motions.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/radiation/rational.hpp"

namespace dynamics::frequency {

/// Radiation of some modes: the poles that a run has, whose added mass is the model's.
struct RadiatingModes {
  std::vector<int> modes;  ///< of the model
  hydro::radiation::PoleModel poles;
};

/// Coordinates y, (n), in which rest is 0 and bodies are displaced by N y to first order, N orthonormal in the metric
/// of their own masses, √kg m; further on joints are closed as they are. All loads by the model itself, at the true
/// place of every body; loads vary by their own derivatives, inertia and joints by central differences, relative error
/// some 1e-9.
class PeriodicModel : public PeriodicSystem {
 public:
  /// `model`: of a run without its radiation; added mass at infinite frequency is in it. `about`: rest or an
  /// equilibrium. `omega`: of its waves, rad/s. What is passed must live as long.
  /// \throws hydro::InputError naming what has no periodic answer: friction and contact, which are set-valued, loads
  /// with a memory of their own, prescribed motions, bodies that may turn about two of three axes
  PeriodicModel(const Model& model, const SmallMotions& about, const std::vector<RadiatingModes>& radiation,
                double omega);

  Eigen::Index size() const override { return basis_.cols(); }
  double omega() const override { return omega_; }
  PeriodicSample at(const CoordinateMotion& motion, const Eigen::VectorXd& load) override;
  PeriodicSample roughly_at(const CoordinateMotion& motion, const Eigen::VectorXd& load) override;
  Eigen::VectorXd residual_at(const CoordinateMotion& motion, const Eigen::VectorXd& load) override;
  const PeriodicMemory* memory() const override { return radiating_.empty() ? nullptr : &memory_; }
  Eigen::VectorXd memory_velocity(const CoordinateMotion& motion) override;

  /// N, (6N, n), and the coordinates of small displacements, (6N) or (6N, k).
  const Eigen::MatrixXd& basis() const { return basis_; }
  template <class Displacements>
  Displacements coordinates(const Displacements& small) const {
    return inverse_.cast<typename Displacements::Scalar>() * small;
  }

  /// Bodies as they are with these coordinates, and how they are accelerated, (6N).
  struct Bodies {
    State state;
    Eigen::VectorXd acceleration;
    Eigen::MatrixXd by_coordinate;  ///< displacement of the centres of gravity by y, (6N, n)
  };
  /// \throws hydro::NumericsError where joints cannot be closed
  Bodies bodies(const CoordinateMotion& motion);
  /// λ of the joints that go with a motion, load of the memory included, (m).
  Eigen::VectorXd multipliers(const Bodies& bodies, const Eigen::VectorXd& load);

 private:
  /// Where bodies are, and what their coordinates' rates make of them.
  struct Closed {
    State state;                             ///< without velocities
    Eigen::VectorXd displacement;            ///< (6N)
    Eigen::MatrixXd J, G;                    ///< velocity by the displacement's rate, (6N, 6N); of the joints, (m, 6N)
    std::optional<hydro::dense::Lu> square;  ///< of S, (free, free)
    Eigen::MatrixXd by_y, by_coordinate;     ///< displacement, and that of the centres of gravity, by y, (6N, n)
  };
  /// Where bodies were when they were last asked about at one time of the period.
  struct Asked {
    double time;
    Eigen::VectorXd value;  ///< (n)
    std::unique_ptr<const Closed> place;
  };
  /// Bodies displaced, whether joints are closed or not, without the derivatives by y; and these.
  Closed placed(Eigen::VectorXd displacement) const;
  void find_derivatives(Closed& at) const;
  /// `near`: a displacement to begin with. \throws hydro::NumericsError where joints cannot be closed
  Closed closed(const Eigen::VectorXd& value, Eigen::VectorXd near) const;
  /// The same for a motion, from where it was last at that time: Newton's steps are short. \throws as closed()
  const Closed& place_of(const CoordinateMotion& motion);
  /// A displacement whose free modes are given, and 0 in the others.
  Eigen::VectorXd expanded(const Eigen::VectorXd& free) const;
  Bodies moving(const Closed& at, const CoordinateMotion& motion) const;
  Eigen::VectorXd residual(const Bodies& bodies, const Eigen::VectorXd& load);
  /// −(by_displacement ∂F/∂q + by_velocity ∂F/∂v) of all loads, (6N, 6N).
  Eigen::MatrixXd load_slope(const State& state, double by_displacement, double by_velocity);
  /// Differences to both sides, or to one with an error as their step.
  PeriodicSample sample(const CoordinateMotion& motion, const Eigen::VectorXd& load, bool central);

  const Model& model_;
  State rest_;
  double omega_;
  Eigen::MatrixXd basis_, inverse_;  ///< N, and what brings displacements down to y
  std::vector<int> free_;            ///< modes that are
  std::vector<int> radiating_;       ///< modes of the model, in the order of the memory
  PeriodicMemory memory_;
  Eigen::VectorXd step_;  ///< of differences, one a coordinate
  Workspace workspace_;
  std::vector<Asked> asked_;  ///< rising times; no more than a motion has samples
};

}  // namespace dynamics::frequency
