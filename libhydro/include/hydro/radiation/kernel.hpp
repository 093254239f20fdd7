#pragma once
/// \file  Radiation memory: the load on hulls now from the waves they made earlier.
/// Equations (R1) to (R8) are derived and sourced in docs/theory/radiation.md.
#include <Eigen/Core>

#include <vector>

namespace hydro::radiation {

/// Radiation damping of n modes over frequency.
struct DampingTable {
  std::vector<double> omega;       ///< rad/s, positive, strictly increasing
  std::vector<Eigen::MatrixXd> B;  ///< one (n, n) matrix a frequency
};

/// How long a memory to keep and how finely to sample it.
struct MemoryGrid {
  double step;    ///< s, > 0
  double length;  ///< s, a whole number of steps is kept

  std::size_t samples() const;  ///< of a kernel on it: one step at least, and the sample at 0
  double kept() const { return step * static_cast<double>(samples() - 1); }  ///< s
};

/// How much of the memory is left after a time, looked at once for the whole of it. (R5)
class MemorySurvey {
 public:
  /// \throws InputError as RetardationKernel::from_damping on a table that is not one
  explicit MemorySurvey(const DampingTable& damping);
  /// See RetardationKernel::truncation().
  double remaining_after(double time_s) const;
  /// The shortest memory that leaves no more than `tolerance`; RetardationKernel::longest_time() if none does.
  double length(double tolerance) const;
  /// K̂(iω) = ∫₀^L K e^{−iωt} dt of the memory cut at L = `length`, (n, n), at each ω in rad/s. Error below 1e-5 of its
  /// largest damping up to the end of the table, whatever step a run takes. O(n² L) each.
  std::vector<Eigen::MatrixXcd> transforms(const std::vector<double>& omega, double length_s) const;

 private:
  double step_, longest_;
  Eigen::Index modes_;
  Eigen::MatrixXd K_;  // (samples at 0, step, 2 step …, pairs of modes)
  std::vector<double> remaining_;
};

/// The retardation function K(t), sampled at t = 0, h, 2h, …, for n coupled modes.
///
///   F(t) = −A∞ a(t) − ∫₀ᵗ K(t−τ) v(τ) dτ       (R1)
///   K(t) =  2/π ∫₀^∞ B(ω) cos ωt dω            (R2)
///
/// SI; K is N/m between translations. B is taken as cubic between the given frequencies (P6) and zero at ω = 0, cut
/// into four straight pieces an interval on which the cosine is integrated exactly (R3), so late times are as good as
/// early ones up to longest_time(). What lies beyond the last frequency is left out and bounded, not guessed. Cost of
/// building: O(n² N_ω N_t).
class RetardationKernel {
 public:
  /// \throws InputError if the table is empty or not increasing, if a diagonal entry is more negative than five per
  /// cent of its largest value (naming mode and frequency: a hull in calm water cannot be a source of power), or if
  /// `grid` asks for more than longest_time().
  static RetardationKernel from_damping(const DampingTable& damping, const MemoryGrid& grid);
  /// The same where the survey of this table has been made.
  static RetardationKernel from_damping(const DampingTable& damping, const MemoryGrid& grid,
                                        const MemorySurvey& survey);

  /// What a sum over steps needs in place of samples (R24): (1/h) ∫ K(jh + s)(1 − |s|/h) ds over −h … h, K even. With
  /// it the sum is the memory integral of a velocity that is straight from step to step, exactly, however long the
  /// step: what is faster than steps can show acts at once, as damping, and nothing of it folds onto slow motions.
  /// `survey`: of the same table. Error: about 1e-5 of K, since B sinc² is taken as straight between places 0.025/h
  /// apart.
  static RetardationKernel averaged(const DampingTable& damping, const MemoryGrid& grid, const MemorySurvey& survey);

  /// A kernel sampled elsewhere at 0, h, 2h, …; its errors are not known here, and told as zero.
  /// \throws InputError unless step > 0 and there are two samples or more, square and of one size
  static RetardationKernel from_samples(std::vector<Eigen::MatrixXd> K, double step);

  /// The longest time at which K can be told from a table with this spacing: π / max Δω between its frequencies. Later,
  /// the straight pieces show an echo of the beginning.
  static double longest_time(const DampingTable& damping);

  int modes() const { return static_cast<int>(K_.front().rows()); }
  std::size_t samples() const { return K_.size(); }
  double step() const { return step_; }
  double length() const { return step_ * static_cast<double>(K_.size() - 1); }
  const Eigen::MatrixXd& at(std::size_t sample) const { return K_[sample]; }  ///< K(sample · h) or its average, (n, n)

  /// Estimated largest error of each entry of K from the finite table, (n, n): what is missing beyond the last
  /// frequency plus the bend of B between frequencies as if it were straight there (R4). An estimate, since B between
  /// and beyond its samples is not known.
  const Eigen::MatrixXd& error_bound() const { return error_; }

  /// Share of the memory beyond `length`, as a bound on the relative error of the damping force at any frequency (R5):
  /// max over pairs of ∫_length^∞ |K_ij| dt / √(max B_ii · max B_jj), where what follows longest_time() is taken to be
  /// no more than the last quarter before it.
  double truncation() const { return truncation_; }

  /// Most negative diagonal damping relative to its mode's largest, 0 if none is: power that the data give to the hull.
  double negative_share() const { return negative_share_; }

 private:
  template <class Transform>
  static RetardationKernel sampled(const Transform& K, const DampingTable& damping, const MemoryGrid& grid,
                                   const MemorySurvey& survey);

  double step_ = 0;
  std::vector<Eigen::MatrixXd> K_;
  Eigen::MatrixXd error_;
  double truncation_ = 0, negative_share_ = 0;
};

/// Most negative diagonal damping relative to its mode's largest, 0 if none is. \throws InputError as
/// RetardationKernel::from_damping on a table that is not one
double negative_share(const DampingTable& damping);

/// K at one time from the table, (n, n), by (R3).
Eigen::MatrixXd retardation(const DampingTable& damping, double t_s);

/// A(ω) = A∞ − (1/ω) ∫₀^∞ K(t) sin ωt dt, solved for A∞ at every frequency (Ogilvie 1964; (R6)) and averaged with
/// weights ω², which damp the error of K at late times. For tables that reach as far as the damping does; else see
/// tail.hpp.
struct InfiniteAddedMass {
  Eigen::MatrixXd value;   ///< (n, n)
  Eigen::MatrixXd spread;  ///< weighted standard deviation over the frequencies, (n, n): its error as the data show it
};
InfiniteAddedMass infinite_added_mass(const DampingTable& damping, const std::vector<Eigen::MatrixXd>& A);

}  // namespace hydro::radiation
