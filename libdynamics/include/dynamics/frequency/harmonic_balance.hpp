#pragma once
/// \file  Periodic motions of nonlinear systems that something periodic drives, by harmonic balance, and whether they
/// last. (Q10)-(Q12), docs/theory/frequency.md.
#include <Eigen/Core>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dynamics::frequency {

/// Where n coordinates are at one time, and how they move.
struct CoordinateMotion {
  double time = 0;                            ///< s
  Eigen::VectorXd value, rate, acceleration;  ///< (n)
};

/// The equations of motion at one time of a period, and how they vary: n coordinates, m velocities with radiation
/// memory.
struct PeriodicSample {
  Eigen::VectorXd residual;                                       ///< (n); zero for a motion
  Eigen::MatrixXd by_value, by_rate, by_acceleration;             ///< ∂residual, (n, n)
  Eigen::MatrixXd by_load = {};                                   ///< ∂residual by the load of the memory, (n, m)
  Eigen::MatrixXd velocity_by_value = {}, velocity_by_rate = {};  ///< of those with memory, (m, n)
};

/// A load F = −∫K(t−τ) w(τ) dτ of m velocities w: by its transform K̂(iω), and by states ẋ = A x + B w, F = −C x.
struct PeriodicMemory {
  std::function<Eigen::MatrixXcd(double omega)> transform;
  Eigen::MatrixXd A, B, C;
};

/// Equations of motion with a period in time.
class PeriodicSystem {
 public:
  virtual ~PeriodicSystem() = default;
  virtual Eigen::Index size() const = 0;  ///< n
  virtual double omega() const = 0;       ///< rad/s: 2π over the period
  /// `load`: of the memory, (m).
  virtual PeriodicSample at(const CoordinateMotion& motion, const Eigen::VectorXd& load) = 0;
  /// The same with derivatives that are good for a step of Newton alone, where these cost less.
  virtual PeriodicSample roughly_at(const CoordinateMotion& motion, const Eigen::VectorXd& load) {
    return at(motion, load);
  }
  /// The residual alone, where it costs less.
  virtual Eigen::VectorXd residual_at(const CoordinateMotion& motion, const Eigen::VectorXd& load) {
    return at(motion, load).residual;
  }
  virtual const PeriodicMemory* memory() const { return nullptr; }
  /// w, (m).
  virtual Eigen::VectorXd memory_velocity(const CoordinateMotion&) { return {}; }
};

/// y(t) = Σ of a mean, cosines and sines of multiples of a frequency.
struct PeriodicMotion {
  double omega = 0;              ///< rad/s, of the first harmonic
  Eigen::MatrixXd coefficients;  ///< (n, 2H + 1): mean, then cosine and sine of each harmonic

  Eigen::Index harmonics() const { return coefficients.cols() / 2; }
  CoordinateMotion at(double time_s) const;
  /// The two highest harmonics over the whole, rms: what is left out is as large where harmonics fall.
  double tail() const;
  /// The same motion with more harmonics, which are zero, or with its highest left out.
  PeriodicMotion with_harmonics(Eigen::Index harmonics) const;
  /// The same motion as one of as many periods: coefficients stand at multiples of omega / periods.
  PeriodicMotion over(int periods) const;
};

struct BalanceOptions {
  double accuracy = 1e-6;            ///< of the motion, by its tail()
  Eigen::Index harmonics = 4;        ///< to begin with; half as many again until the tail is within the accuracy
  Eigen::Index most_harmonics = 96;  ///< of a smooth system far below; a motion with corners has no fewer
  int iterations = 40;               ///< of Newton
};

/// What harmonic balance came to.
struct Balance {
  PeriodicMotion motion;
  bool found = false;
  int iterations = 0;  ///< of Newton, all together
  std::string why;     ///< not found: one sentence
};

/// A motion with the period of the system, or with as many of it as omega() / start.omega, near `start`: Newton on the
/// coefficients of the residual, which is taken at 4 (H + 1) times of the period, (Q10). Cost of an iteration: as many
/// calls of at(), and a dense factorisation of n (2H + 1) equations.
Balance balance(PeriodicSystem& system, PeriodicMotion start, const BalanceOptions& options = {});

/// Rest, for balance() to begin with.
PeriodicMotion at_rest(const PeriodicSystem& system, Eigen::Index harmonics = 4);

/// The load of the memory in a motion, as coefficients, (m, 2H + 1); without rows without memory.
PeriodicMotion load_of_memory(PeriodicSystem& system, const PeriodicMotion& motion);

/// Systems along a parameter, such as the height of waves or their period.
using Family = std::function<std::shared_ptr<PeriodicSystem>(double parameter)>;

/// A motion of one of them.
struct MotionAt {
  double parameter;
  PeriodicMotion motion;
};

/// Where Newton alone takes a motion along a parameter.
struct Carried {
  Balance end;  ///< at the parameter asked for
  bool joined;  ///< to where it began; else none was found, or Newton jumped onto another branch
};

/// The motion at `to` by Newton, from the straight line through two motions before it. The way is halved, at most into
/// 64 parts, where Newton finds none or ends a tenth of the motion away from that line: motions of one branch draw near
/// to it, those of another do not. So jumps by less than a tenth of the motion are not seen.
Carried carry(const Family& family, const MotionAt& before, const MotionAt& from, double to,
              const BalanceOptions& options = {});

/// A point of a branch of periodic motions.
struct BranchPoint {
  double parameter;
  PeriodicMotion motion;
  bool forwards;  ///< the parameter grows along the branch here; it turns at a fold
};

struct FollowOptions {
  double step = 0.02;  ///< of arc, to begin with: of the range of the parameter and of the size of the motion
  double largest_step = 0.1;
  int points = 400;
  double before = 0;  ///< how far the parameter may go back beyond where the branch begins
  BalanceOptions balance = {};
};

struct FollowedBranch {
  std::vector<BranchPoint> points;
  std::string end;  ///< why it does not go on to where it was to go; empty: it came there
};

/// The branch through `start`, a motion at the parameter `from`, by pseudo-arclength, (Q11): round folds, until the
/// parameter is `to`, which the last point has. Steps after which Newton is farther from the tangent than half of them
/// are halved: beyond may be another branch. It ends where it comes farther before `from` than is allowed, where there
/// are as many points or harmonics as are allowed, and where it cannot be followed any further.
FollowedBranch follow(const Family& family, double from, double to, PeriodicMotion start,
                      const FollowOptions& options = {});

/// Floquet multipliers of a motion, the largest first, (Q12): of its small disturbances, memory included, over its own
/// period. They know A(t) by its Fourier series at the motion's sampling times, and are right to some 1e-8. \throws as
/// monodromy()
Eigen::VectorXcd floquet_multipliers(PeriodicSystem& system, const PeriodicMotion& motion);

/// What becomes of a periodic motion that is disturbed.
enum class Fate {
  stable,
  doubled,        ///< a multiplier below −1: motions of two periods take its place
  quasiperiodic,  ///< a pair beyond the circle
  fold            ///< a multiplier above 1: another motion of one period, or none near
};
std::string name_of(Fate fate);
Fate fate_of(const Eigen::VectorXcd& multipliers);

}  // namespace dynamics::frequency
