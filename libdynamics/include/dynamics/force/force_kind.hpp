#pragma once
/// \file  A kind of load with all its elements: every axial connector of a scene is one ForceKind.
///
/// Elements of one kind lie together and are evaluated in a plain loop; the kinds of a model are dispatched once an
/// evaluation. Laws, run against every kind by tests/laws/force_kind_laws.hpp:
///   L1  the same (t, state) gives the same load, however often and in whatever order it is asked
///   L2  loads and Jacobians are added, never assigned
///   L3  memory is declared by make_memory() and moves on only in Memory::accept()
///   L4  power given to the bodies = supplied − dissipated − d(stored)/dt, with ½ vᵀ(dM/dt)v of its own mass, if it has
///       any, on the left (D40)
///   L5  the Jacobians are the derivatives of the load
#include <Eigen/Core>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/spatial/rotation.hpp"
#include "dynamics/state/block_matrix.hpp"
#include "dynamics/state/body.hpp"
#include "dynamics/state/signal.hpp"
#include "hydro/base/state_bytes.hpp"

namespace dynamics {

/// State that outlives a step: the velocities behind a radiating hull, a controller. One per kind and workspace.
class Memory {
 public:
  virtual ~Memory() = default;
  /// A full step has been completed in `state`.
  virtual void accept(const State& state) = 0;
  /// True if loads are what they are without it, to a tolerance that the kind tells: it is there to be quicker.
  virtual bool spares_work_only() const { return false; }
  /// True if keep_state() knows the whole of it.
  virtual bool can_be_kept() const { return false; }
  /// Takes it up, or gives it back to the memory that the kind has made for the same state.
  virtual void keep_state(hydro::StateBytes&) {}
};

/// The arguments of every evaluation. `memory` is what the kind itself made, or null.
struct Instant {
  const State& state;
  Memory* memory;
};

/// Collects loads: force and moment about the centre of gravity, global axes, N and N m.
class LoadSink {
 public:
  explicit LoadSink(Eigen::VectorXd& load) : load_(load) {}
  void add(int body, const Vector6& load) { load_.segment<6>(6 * body) += load; }
  void add_mode(int mode, double load) { load_[mode] += load; }

 private:
  Eigen::VectorXd& load_;
};

/// Collects the derivatives of loads with respect to displacement (translation and small global rotation) and velocity.
class JacobianSink {
 public:
  /// Adds −(velocity_factor · ∂F/∂v + displacement_factor · ∂F/∂q) to `matrix`.
  JacobianSink(BlockMatrix& matrix, double displacement_factor, double velocity_factor)
      : matrix_(matrix), displacement_factor_(displacement_factor), velocity_factor_(velocity_factor) {}
  /// Derivatives of the load on body `on` by displacement and velocity of body `by`.
  void add(int on, int by, const Matrix6& by_displacement, const Matrix6& by_velocity) {
    matrix_.block(on, by) -= displacement_factor_ * by_displacement + velocity_factor_ * by_velocity;
  }
  /// Derivatives of the loads on two bodies by displacements and velocities of both, (first, second); without a second
  /// only those of the first.
  void add_pair(int first, const std::optional<int>& second, const Matrix12& by_displacement,
                const Matrix12& by_velocity) {
    const int count = second ? 2 : 1;
    const int body[2] = {first, second.value_or(-1)};
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j)
        add(body[i], body[j], by_displacement.block<6, 6>(6 * i, 6 * j), by_velocity.block<6, 6>(6 * i, 6 * j));
  }
  /// Derivatives by velocity between single modes, (modes, modes).
  void add_velocity_modes(const std::vector<int>& modes, const Eigen::MatrixXd& by_velocity) {
    for (std::size_t j = 0; j < modes.size(); ++j)
      for (std::size_t i = 0; i < modes.size(); ++i)
        matrix_.block(modes[i] / 6, modes[j] / 6)(modes[i] % 6, modes[j] % 6) -=
            velocity_factor_ * by_velocity(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }

 private:
  BlockMatrix& matrix_;
  double displacement_factor_, velocity_factor_;
};

/// Collects mass that depends on where bodies are: into a matrix, or as its product with a vector.
class MassSink {
 public:
  /// Adds factor · M to `matrix`.
  MassSink(BlockMatrix& matrix, double factor) : matrix_(&matrix), factor_(factor) {}
  /// Adds M x to `product`.
  MassSink(const Eigen::VectorXd& x, Eigen::VectorXd& product) : x_(&x), product_(&product) {}
  void add(int body, const Matrix6& mass) {
    if (matrix_ != nullptr)
      matrix_->block(body, body) += factor_ * mass;
    else
      product_->segment<6>(6 * body) += mass * x_->segment<6>(6 * body);
  }
  /// A mass that is given along axes that R turns into the global ones.
  void add_along(const Eigen::Matrix3d& R, int body, const Matrix6& mass) {
    if (matrix_ != nullptr) return add(body, turned(mass, R));
    const Vector6 x = x_->segment<6>(6 * body);
    Vector6 along;
    along << R.transpose() * x.head<3>(), R.transpose() * x.tail<3>();
    const Vector6 y = mass * along;
    product_->segment<3>(6 * body) += R * y.head<3>();
    product_->segment<3>(6 * body + 3) += R * y.tail<3>();
  }

 private:
  BlockMatrix* matrix_ = nullptr;
  double factor_ = 1;
  const Eigen::VectorXd* x_ = nullptr;
  Eigen::VectorXd* product_ = nullptr;
};

/// Energy of a kind at one instant.
struct EnergyFlow {
  double stored = 0;      ///< J
  double supplied = 0;    ///< W, from outside: the waves
  double dissipated = 0;  ///< W; radiation counts here and may be negative for a moment, when waves come back
  std::optional<double> dissipated_so_far = {};  ///< J since the start, of kinds that know it exactly

  void keep_state(hydro::StateBytes& bytes) { bytes.pass(stored, supplied, dissipated, dissipated_so_far); }
};

class FrictionLaw;
class ContactLaw;

class ForceKind {
 public:
  virtual ~ForceKind() = default;

  virtual std::string effect() const = 0;  ///< the word for it in a scene: "connector", "excitation"
  virtual std::size_t elements() const = 0;
  virtual std::string method() const = 0;      ///< how it is computed, for `froude plan`
  virtual void couple(BlockPattern&) const {}  ///< pairs of different bodies that its Jacobian touches
  virtual std::unique_ptr<Memory> make_memory(const State&) const { return nullptr; }

  virtual void add_load(const Instant& now, LoadSink& out) const = 0;
  virtual void add_jacobian(const Instant& now, JacobianSink& out) const = 0;
  virtual EnergyFlow energy(const Instant& now) const = 0;

  /// Mass M(t, q) of its own, symmetric, that belongs on the left of the equations of motion. What the load needs
  /// besides −M a, the part of the acceleration that velocities make, is in add_load().
  virtual void add_mass(const State&, MassSink&) const {}

  /// True if the load is, for small motions about rest, stiffness and damping that a frequency-domain analysis takes
  /// from add_jacobian(). Excitation and radiation have their own place there; quadratic drag has none.
  virtual bool linear_at_rest() const { return false; }
  /// True if it is counted, as it is at the time of the state, where bodies come to rest before a run.
  virtual bool acts_before_runs() const { return linear_at_rest(); }

  /// What its elements tell of themselves, called after them: forces, strokes, powers. Energies belong to the ledger.
  virtual std::vector<Signal> signals() const { return {}; }

  /// What its springs may still gain in stiffness over what they have in `at`, with no load there, for the choice of a
  /// step; null: nothing.
  virtual std::unique_ptr<const ForceKind> stiffer_than_at(const State& /*at*/) const { return nullptr; }

  /// Why this kind has no load for what happened between two states that follow each other; empty if it has.
  virtual std::string breaks_off(const State& /*before*/, const State& /*after*/) const { return {}; }

  /// True if the memory takes up states at the ends of steps only: a method that looks between them misses the newest.
  virtual bool remembers_whole_steps() const { return false; }
  /// Why a step cannot be cut in parts to a tolerance; null if it can.
  virtual const char* steps_stay_whole() const { return nullptr; }

  /// The set-valued laws of this kind, which an integrator must see; null if it has none.
  virtual const FrictionLaw* friction() const { return nullptr; }
  virtual const ContactLaw* contact() const { return nullptr; }
};

/// ½ vᵀ (dM/dt) v of a kind's own mass along the motion, W (D40): by central differences over ± 10 µs, error of about
/// 1e-9 relative. For energies, once a step.
double power_of_changing_mass(const ForceKind& kind, const State& state);

}  // namespace dynamics
