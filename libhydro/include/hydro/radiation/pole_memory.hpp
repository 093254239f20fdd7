#pragma once
/// \file  The memory integral with a sum of decaying oscillations: a few states a mode in place of a long history.
#include <Eigen/Core>

#include <vector>

#include "hydro/radiation/memory.hpp"
#include "hydro/radiation/rational.hpp"

namespace hydro::radiation {

/// Each oscillation is carried on exactly for a velocity that is straight over a step, (R14): the step may be as large
/// as the motion allows, and a passive model stays passive at any step. Cost a step: n² · order products, n modes that
/// move each other, summed over the groups of modes that do: a hull with a plane of symmetry has two.
class PoleMemory final : public MemoryMethod {
 public:
  /// \throws InputError unless step > 0 and every pole decays
  PoleMemory(PoleModel model, double step);

  int modes() const override { return model_.modes(); }
  double step() const override { return step_; }
  std::string describe() const override;
  std::unique_ptr<MemoryState> start(const Eigen::VectorXd& velocity) const override;
  Eigen::MatrixXd instantaneous(double fraction) const override;
  const PoleModel& model() const { return model_; }

  /// How one pole is carried over `h` seconds: z ← growth z + before v_old + after v_new.
  struct Carry {
    std::complex<double> growth, before, after;
  };
  std::vector<Carry> carried_over(double h) const;
  const std::vector<Carry>& carried_over_a_step() const { return full_; }
  /// The modes, those that move each other one after the other: the order of the states of a run.
  const std::vector<Eigen::Index>& sequence() const { return sequence_; }
  /// Σ over oscillations of the matrices times the states in `z`, one column an oscillation, (n, order), rows in
  /// sequence(); the load as modes are numbered.
  void find_load(const Eigen::MatrixXd& z, Eigen::VectorXd& out) const;

 private:
  PoleModel model_;
  double step_;
  std::vector<Carry> full_;
  /// Modes that move each other, through others or not, and no others.
  struct Group {
    Eigen::Index first, count;  // in sequence()
    Eigen::MatrixXd output;  // [C₁ S₁ C₂ …] without the S of real poles, rows of zeros up to a multiple of eight
  };
  void group_modes();
  std::vector<Eigen::Index> sequence_;
  std::vector<Group> groups_;
  Eigen::MatrixXd instantaneous_;  // over a full step
};

}  // namespace hydro::radiation
