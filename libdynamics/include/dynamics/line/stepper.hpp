#pragma once
/// \file  Time stepping of lines, and their energy ledger. (D77), (D79)-(D82), (D84), (D139), (D140)
#include <memory>
#include <optional>
#include <string_view>

#include "dynamics/line/line.hpp"

namespace dynamics::line {

/// How a line is stepped. The last three are those of Huijgen 2024, on the same chain without angles.
enum class Scheme {
  energy_momentum,    ///< midpoint with the means of pulls over the step: keeps energy and lengths, second order (D79)
  generalised_alpha,  ///< second order, damps what is faster than the step by ρ∞ (D80)
  rosenbrock,         ///< fourth order without iterations, in sub-steps cut by their own error (D139)
  gamma,              ///< γ new + (1 − γ) old: 1 implicit Euler, ½ trapezium; of first order but at ½ (D81)
  semi_implicit_euler,  ///< velocity by the loads at the start, then place by the new velocity (D82)
  explicit_euler        ///< both by what is known at the start (D82)
};
/// "energy_momentum", …; \throws hydro::InputError naming the nearest
Scheme parse_scheme(std::string_view name);
std::string_view name_of(Scheme scheme);
/// True if steps go on from more than places and velocities, so that two motions near each other have no distance.
constexpr bool keeps_accelerations(Scheme scheme) {
  return scheme == Scheme::generalised_alpha || scheme == Scheme::rosenbrock;
}

/// Where energy is and where it went since the start, J. (D84)
struct Energies {
  double kinetic = 0, height = 0, axial = 0, bed = 0;    ///< held; height: of weight, buoyancy, constant loads
  double shear = 0;                                      ///< held by the bed along itself
  double bending = 0;                                    ///< held
  double held = 0, drag = 0, inertia = 0, buoyancy = 0;  ///< supplied by what moves nodes, and by the water
  double loads = 0;                                      ///< supplied by loads over time
  double lost_damping = 0, lost_drag = 0, lost_axial = 0, lost_bed = 0, lost_friction = 0;  ///< dissipated
  double at_start = 0;

  double stored() const { return height + axial + bed + shear + bending; }
  double total() const { return kinetic + stored(); }
  double supplied() const { return held + drag + inertia + buoyancy + loads; }
  double dissipated() const { return lost_damping + lost_drag + lost_axial + lost_bed + lost_friction; }
  double residual() const { return total() - at_start - supplied() + dissipated(); }
  void keep_state(hydro::StateBytes& bytes) {
    bytes.pass(kinetic, height, axial, bed, shear, bending, held, drag, inertia, buoyancy, loads, lost_damping,
               lost_drag, lost_axial, lost_bed, lost_friction, at_start);
  }
};

/// What one full step took; of Scheme::rosenbrock its sub-steps, and how many of them were taken anew, shorter.
struct StepReport {
  int newton_iterations = 0, halvings = 0;
};

/// Steps one line. Every implicit step is Newton's with line search; a step that fails is halved; lengths that are kept
/// are exact at the end of every step. Cost O(nodes) an iteration.
class Stepper {
 public:
  struct Settings {
    Scheme scheme = Scheme::energy_momentum;
    double rho_infinity = 0.8;  ///< of generalised-α
    double gamma = 0.51;        ///< of the γ-method
    double tolerance = 1e-9;    ///< of Newton's last correction, relative to displacement of the step and tension
    int iterations = 25;
    double local_error = 1e-4;  ///< of a sub-step of Scheme::rosenbrock: of tensions by the largest one or the line's
                                ///< weight, of places by a segment (D140)
    int deepest_halving = 10;   ///< a step is cut into 2¹⁰ pieces at most
  };

  /// \throws hydro::InputError for settings that cannot be, for massless free nodes where the scheme needs mass, and
  /// for lines that Scheme::rosenbrock cannot step: inextensible, stiff in bending, in networks, on beds with friction
  Stepper(const Line& line, const Settings& settings);
  ~Stepper();
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  /// Begins at `state`: nodes on paths are put there, tensions found. \throws hydro::InputError naming the segment if a
  /// length is not kept, or velocities change it; hydro::NumericsError if there are no accelerations
  void start(State& state);

  /// Goes on from another state of the line, which is not checked; its tensions are found. \throws
  /// hydro::NumericsError if there are no accelerations
  void go_on(State& state);

  /// One step of h seconds, which is cut where the history of a load on a node has a corner (D150). \throws
  /// hydro::NumericsError naming time, node and reason when halving is of no use; `state` is then the last good one
  StepReport step(State& state, double h);

  /// Of the state after the last step.
  const Energies& energies() const;
  /// Powers in that state, W: what the water supplies, and all that is lost.
  struct Flow {
    double supplied = 0, dissipated = 0;
  };
  Flow flow() const;

  /// A step that is only tried, from where keep() was last: energies() and flow() wait for keep(). \throws as step()
  StepReport try_step(State& state, double h);
  /// `state`, where the last step led that was tried, or that it started from, is where the next ones begin.
  void keep(State& state);

  /// What steps go on from at `state`, where the last one led that was made or kept, beside the state itself: into
  /// bytes or out of them, of a stepper of the same line and settings.
  void keep_state(State& state, hydro::StateBytes& bytes);

  /// The force that each held node needed at the end of the last step, (3, nodes). Of generalised-α alone.
  const Places& needed() const;
  /// The same of the nodes `prescribed`, and how it follows them, while the rest of the line moves with the step; their
  /// accelerations follow their velocities by `a_by_v`. (D90) It stands until the next.
  const Response& response(const std::vector<int>& prescribed, double a_by_v);

  /// What balances a state, whatever the step did (D77); nothing if masses leave it open.
  struct Balance {
    Places acceleration;
    Eigen::VectorXd tension;
    Places holding;  ///< the force on each held node by what holds it, N; zero for free ones
  };
  std::optional<Balance> balance(const State& state);
  /// The same, into matrices that have room. \returns false if masses leave it open
  bool find_balance(const State& state, Balance& out);

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace dynamics::line
