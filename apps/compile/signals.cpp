#include "compile/signals.hpp"

#include "hydro/waves/synthesis/synthesis.hpp"

namespace froude::compile {

dynamics::WaveSignals signals(const hydro::waves::Sea& sea, const Eigen::MatrixXcd& amplitudes, const StepGrid& grid,
                              double ramp) {
  // All signals in one pass: they share the phasors of the sea.
  Eigen::MatrixXd table = hydro::waves::synthesise(sea, {grid.step, grid.samples}, amplitudes).series.transpose();
  std::vector<double> omega;
  for (const auto& c : sea.components()) omega.push_back(c.omega);
  return {std::move(omega), amplitudes, std::move(table), grid.step, ramp};
}

}  // namespace froude::compile
