#pragma once
/// \file  Which way of computing the memory to take: the cheapest one whose error is within the tolerance.
#include <Eigen/Core>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hydro/radiation/memory.hpp"
#include "hydro/radiation/rational.hpp"

namespace hydro::radiation {

enum class Method { direct, partitioned, poles };
std::string name_of(Method method);

/// What one method would come to. The error compares the force of a harmonic motion with the data, B + iω(A − A∞), at
/// the data's own frequencies, relative to √(max B_ii max B_jj), the largest over pairs and frequencies: (R19). It
/// counts all that a method leaves out, replaces or adds.
struct Alternative {
  Method method;
  double error;
  double at_omega;      ///< rad/s, where the error is largest
  double microseconds;  ///< predicted cost of a step on one thread, (R20)
  bool within = false;  ///< error <= tolerance
};

struct MemoryDemand {
  double step;                   ///< s
  double tolerance = 1e-3;       ///< relative force
  std::optional<double> length;  ///< s, where the caller fixes it: then a convolution, which has one
  std::optional<Method> method;  ///< where the caller fixes it
};

/// A method ready to run, and why it was taken.
struct ChosenMemory {
  std::shared_ptr<const MemoryMethod> memory;
  Eigen::MatrixXd A_inf;  ///< the added mass on the left that belongs to it, (n, n)
  Method method;
  /// K̂(iω) of the memory, (n, n), whatever the step: of the kernel cut at its length, or of the poles.
  std::function<Eigen::MatrixXcd(double omega)> transform;
  std::vector<Alternative> alternatives;  ///< all that were weighed, the chosen one among them
  std::string why;                        ///< one sentence
  std::optional<FitReport> fit;           ///< of the poles, where they were weighed
  std::size_t lags = 0;                   ///< of the convolutions, where they were weighed
  double truncation = 0;                  ///< of the convolutions, (R5)
  double misfit = 0, shift = 0;           ///< of the extrapolated damping, as ExtrapolatedDamping
  double negative_share = 0;              ///< of the data, as RetardationKernel
};

/// How choose() comes by a fit() of its data to its tolerance; a caller that has it already hands it on.
using Fitting = std::function<RationalFit()>;

/// Weighs the methods that are allowed and takes the cheapest within the tolerance; where none is, the one with the
/// smallest error, and of equals the cheapest. `fitting`: asked only if poles are weighed; left out: fit().
/// \throws InputError as fit() and RetardationKernel::from_damping
ChosenMemory choose(const DampingTable& damping, const std::vector<Eigen::MatrixXd>& A,
                    const std::optional<Eigen::MatrixXd>& A_inf, const MemoryDemand& demand,
                    const Fitting& fitting = {});

/// The same yardstick for any transform K̂(iω) that goes with `A_inf`: largest error and its frequency.
struct DataError {
  double value, at_omega;
};
DataError error_against(const DampingTable& damping, const std::vector<Eigen::MatrixXd>& A,
                        const Eigen::MatrixXd& A_inf, const std::vector<Eigen::MatrixXcd>& transforms);

}  // namespace hydro::radiation
