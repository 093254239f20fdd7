#include "dynamics/integrate/start_with_lines.hpp"

#include "dynamics/force/fastened_line.hpp"
#include "hydro/base/dense.hpp"

namespace dynamics {

// Accelerations A of the ends make pulls, which make accelerations G + B A of the bodies' points: linear, so as many
// trials as there are components tell B, and A = (1 − B)⁻¹ G.
void start_with_lines(Integrator& integrator, Workspace& workspace) {
  integrator.start(workspace);
  auto* lines = workspace.find_memory<FastenedLineMemory>();
  if (lines == nullptr) return;
  const auto of_ends = [&] { return lines->accelerations_of_ends(workspace.state, workspace.acceleration); };
  const line::Places free = of_ends();
  constexpr double rest = 1e-9;  // m/s²: what equilibrium leaves
  if (free.cwiseAbs().maxCoeff() < rest) return;
  const Eigen::VectorXd G = free.reshaped();
  Eigen::MatrixXd left = Eigen::MatrixXd::Identity(G.size(), G.size());
  line::Places A = line::Places::Zero(3, free.cols());
  for (Eigen::Index c = 0; c < G.size(); ++c) {
    A.setZero();
    A.reshaped()[c] = 1;
    lines->start(workspace.state, A);
    integrator.start(workspace);
    left.col(c) -= of_ends().reshaped() - G;
  }
  A.reshaped() = hydro::dense::Lu(left).solve(G);
  lines->start(workspace.state, A);
  integrator.start(workspace);
}

}  // namespace dynamics
