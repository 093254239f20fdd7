#pragma once
/// \file  Private: the equations of motion (Q1) at one frequency after another, assembled by blocks and solved.
#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <optional>
#include <vector>

#include "dynamics/frequency/amplitudes.hpp"
#include "hydro/base/dense.hpp"
#include "reduction.hpp"

namespace dynamics::frequency {

/// The matrix Z of (Q1): a dense one, or entries of a sparse one, which are summed.
struct Impedance {
  using Block = Eigen::Matrix<std::complex<double>, 6, 6>;
  using Entry = Eigen::Triplet<std::complex<double>, int>;

  std::optional<Eigen::MatrixXcd> dense;
  std::vector<Entry> entries;

  /// Adds a block of the loads on one body by motions of another.
  void add(int on, int by, const Block& block);
};

/// What a solution consists of: displacements (6N, columns) and multipliers of joints (m, columns).
struct Motions {
  Eigen::MatrixXcd xi, lambda;
};

/// Where frequencies below those of the coefficients come from.
enum class BelowData {
  refused,
  straight_to_zero  ///< FrequencyTable::added_mass_from_zero(), damping_from_zero()
};

/// (Q1) with the constraints of joints. Const, shared between threads.
///
/// Where bodies are few or most feel each other, in the motions that joints leave, by dense factors: O(n³). Else
/// [Z Gᵀ; G 0] (ξ, λ) = (X, 0) by sparse ones, which for a chain of N bodies cost O(N).
class Equations {
 public:
  /// Both must live as long.
  Equations(const SmallMotions& about, const std::vector<PotentialGroup>& groups, BelowData below = BelowData::refused);

  bool are_empty() const { return free_.empty(); }
  bool are_sparse() const { return sparse_; }
  Impedance impedance(double omega) const;
  /// Z ξ + Gᵀ λ = X and G ξ = 0, all columns by the same factors. \throws hydro::NumericsError naming the motion if Z
  /// is singular
  Motions solve(const Impedance& Z, const Eigen::MatrixXcd& X, double omega) const;

 private:
  std::optional<Motions> solve_dense(const Eigen::MatrixXcd& Z, const Eigen::MatrixXcd& X) const;
  std::optional<Motions> solve_sparse(const std::vector<Impedance::Entry>& Z, const Eigen::MatrixXcd& X) const;
  std::optional<Motions> solve_any(const Impedance& Z, const Eigen::MatrixXcd& X) const;
  void prepare_dense();
  void prepare_sparse();
  Eigen::MatrixXcd multipliers(const Eigen::MatrixXcd& rest) const;
  bool is_rounding(const Eigen::MatrixXcd& xi, const Eigen::MatrixXcd& X, double omega) const;
  [[noreturn]] void refuse(Impedance Z, double omega) const;

  const SmallMotions& about_;
  const std::vector<PotentialGroup>& groups_;
  BelowData below_;
  bool sparse_;
  std::vector<int> free_;  // modes
  Eigen::VectorXd mass_;   // of each mode by itself, dry
  // Of sparse factors:
  std::vector<int> place_;                       // of each mode among the unknowns; −1 where it is held
  std::vector<Impedance::Entry> joint_entries_;  // G and Gᵀ
  // Of dense factors:
  std::optional<Reduction> left_;
  Eigen::VectorXd scale_;                        // of the equations that joints leave open
  std::optional<hydro::dense::PivotedQr> open_;  // Gᵀ in them
};

/// Adds the drag's part of the matrix of (Q1), frequency number w.
void add_drag(const LinearDrag& drag, Eigen::Index w, double omega, Impedance& Z);

}  // namespace dynamics::frequency
