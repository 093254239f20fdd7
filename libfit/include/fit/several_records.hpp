#pragma once
/// \file  Several records as one simulation: parameters that all share, and parameters of one record alone; (F103),
///        docs/theory/fit.md.
#include <Eigen/Core>

#include <cstddef>
#include <vector>

#include "fit/simulated.hpp"

namespace fit {

/// The windows of all records, one record after the other. Each record is followed by a simulation of its own, and
/// begins where that one does: nothing is handed on from one record to the next.
class SeveralRecords final : public Simulation {
 public:
  struct Record {
    Simulation* simulation;           ///< lives as long
    std::size_t windows;              ///< one at least
    std::vector<Eigen::Index> takes;  ///< which of all parameters, in the order in which its simulation has them
  };
  /// \throws hydro::InputError for no record, or one without a window
  explicit SeveralRecords(std::vector<Record> records);

  Eigen::Index coordinates(std::size_t window) override;
  Eigen::MatrixXd follow(std::size_t window, const Eigen::VectorXd& parameters, const Eigen::VectorXd& start) override;
  void hand_on(std::size_t window, const Eigen::VectorXd& parameters, const Eigen::VectorXd& start) override;
  bool moves(std::size_t window, std::size_t parameter) const override;
  bool divide_steps(int by) override;

 private:
  struct Of {
    const Record& record;
    std::size_t window;  ///< among the record's own
  };
  Of of(std::size_t window) const;

  std::vector<Record> records_;
};

}  // namespace fit
