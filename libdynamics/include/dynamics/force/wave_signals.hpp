#pragma once
/// \file  Signals that one sea drives at fixed points: a table on the step grid, the sum itself between its samples.
#include <Eigen/Core>

#include <complex>
#include <optional>
#include <vector>

namespace dynamics {

/// m signals s(t) = ramp(t) · Re Σ_c a_c e^{iω_c t}, c over the components of a sea (D6).
///
/// At whole steps from the table, elsewhere by the sum over components: the same value to round-off, so a load is a
/// pure function of time. ramp(t) grows from 0 to 1 by a half cosine over `ramp_s`.
class WaveSignals {
 public:
  /// `amplitudes`: (m, components). `table`: (m, samples) at t = 0, h, 2h, …, without the ramp.
  WaveSignals(std::vector<double> omega, Eigen::MatrixXcd amplitudes, Eigen::MatrixXd table, double step,
              double ramp_s);

  Eigen::Index count() const { return amplitudes_.rows(); }
  std::size_t components() const { return omega_.size(); }
  double step() const { return step_; }
  Eigen::VectorXd at(double t) const;
  /// Calls use(s) with the m signals; at whole steps s stands in the table, and no memory is asked for.
  template <class Use>
  void use_at(double t, const Use& use) const {
    if (const auto sample = whole_step(t))
      use(ramp_at(t) * table_.col(*sample));
    else
      use(ramp_at(t) * sum_at(t));
  }

 private:
  std::optional<Eigen::Index> whole_step(double t) const;
  double ramp_at(double t) const;
  Eigen::VectorXd sum_at(double t) const;
  std::vector<double> omega_;
  Eigen::MatrixXcd amplitudes_;
  Eigen::MatrixXd table_;
  double step_, ramp_;
};

}  // namespace dynamics
