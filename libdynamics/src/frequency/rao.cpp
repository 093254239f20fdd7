#include "dynamics/frequency/rao.hpp"

#include <algorithm>

#include "equations.hpp"
#include "hydro/base/parallel.hpp"
#include "scatter.hpp"

namespace dynamics::frequency {

Eigen::MatrixXcd impedance(const SmallMotions& about, const std::vector<PotentialGroup>& groups, double omega) {
  const std::complex<double> i_omega(0, omega);
  Eigen::MatrixXcd Z =
      about.linear.stiffness + i_omega * about.linear.damping - omega * omega * about.mass.cast<std::complex<double>>();
  for (const PotentialGroup& g : groups)
    if (g.radiation)
      scatter_add(g.bodies,
                  Eigen::MatrixXcd(i_omega * g.table.damping(omega) -
                                   omega * omega * g.table.added_mass(omega).cast<std::complex<double>>()),
                  Z);
  return Z;
}

Eigen::VectorXcd excitation(const SmallMotions& about, const std::vector<PotentialGroup>& groups, double omega,
                            double heading) {
  Eigen::VectorXcd F = about.members.excitation(about.model.bodies(), about.still, omega, heading);
  for (const PotentialGroup& g : groups) {
    if (!g.excitation) continue;
    const Eigen::VectorXcd X = g.table.excitation(omega, heading);
    for (std::size_t i = 0; i < g.bodies.size(); ++i)
      F.segment<6>(6 * g.bodies[i]) += X.segment<6>(6 * static_cast<Eigen::Index>(i));
  }
  return F;
}

namespace {

/// The right-hand sides of (Q1), one column a heading, (6N, Nβ).
Eigen::MatrixXcd excitations(const SmallMotions& about, const std::vector<PotentialGroup>& groups, double omega,
                             const std::vector<double>& headings) {
  Eigen::MatrixXcd X(about.model.modes(), static_cast<Eigen::Index>(headings.size()));
  for (Eigen::Index h = 0; h < X.cols(); ++h)
    X.col(h) = excitation(about, groups, omega, headings[static_cast<std::size_t>(h)]);
  return X;
}

/// All headings of frequency number w by the same factors.
Motions motions_at(const Equations& equations, double omega, const Eigen::MatrixXcd& X) {
  return equations.solve(equations.impedance(omega), X, omega);
}

/// Drag of the same coefficients for all headings, as that of a sea has: they share factors.
bool is_common(const std::vector<LinearDrag>& drag) {
  return std::all_of(drag.begin(), drag.end(),
                     [&](const LinearDrag& d) { return d.coefficient == drag.front().coefficient; });
}

/// By factors of each heading's own, unless their drag is common.
Motions motions_with_drag(const Equations& equations, double omega, const Eigen::MatrixXcd& X, Eigen::Index w,
                          const std::vector<LinearDrag>& drag) {
  const Impedance without = equations.impedance(omega);
  const auto solved = [&](std::size_t h, const Eigen::MatrixXcd& load) {
    Impedance Z = without;
    add_drag(drag[h], w, omega, Z);
    return equations.solve(Z, load, omega);
  };
  Eigen::MatrixXcd load = X;
  for (Eigen::Index h = 0; h < X.cols(); ++h) load.col(h) += drag[static_cast<std::size_t>(h)].excitation(w, X.rows());
  if (is_common(drag)) return solved(0, load);
  Motions out;
  for (Eigen::Index h = 0; h < X.cols(); ++h) {
    const Motions one = solved(static_cast<std::size_t>(h), load.col(h));
    if (h == 0) out = {Eigen::MatrixXcd(X.rows(), X.cols()), Eigen::MatrixXcd(one.lambda.rows(), X.cols())};
    out.xi.col(h) = one.xi;
    out.lambda.col(h) = one.lambda;
  }
  return out;
}

/// Room for answers to this many right-hand sides.
Amplitudes no_motion(const SmallMotions& about, std::size_t columns, std::size_t frequencies) {
  const auto n = static_cast<Eigen::Index>(frequencies);
  Amplitudes out;
  out.xi.assign(columns, Eigen::MatrixXcd::Zero(about.model.modes(), n));
  out.lambda.assign(columns, Eigen::MatrixXcd::Zero(about.linear.constraints.rows(), n));
  return out;
}

/// Motions of frequency number w to their places.
void put(const Motions& found, std::size_t w, Amplitudes& out) {
  for (std::size_t h = 0; h < out.xi.size(); ++h) {
    out.xi[h].col(static_cast<Eigen::Index>(w)) = found.xi.col(static_cast<Eigen::Index>(h));
    out.lambda[h].col(static_cast<Eigen::Index>(w)) = found.lambda.col(static_cast<Eigen::Index>(h));
  }
}

}  // namespace

Amplitudes response_amplitudes(const SmallMotions& about, const std::vector<PotentialGroup>& groups,
                               const std::vector<double>& omega, const std::vector<double>& headings,
                               const RaoOptions& options) {
  const Equations equations(about, groups);
  Amplitudes out = no_motion(about, headings.size(), omega.size());
  if (equations.are_empty() || headings.empty()) return out;
  hydro::in_parallel(omega.size(), options.threads, [&](std::size_t i) {
    const auto w = static_cast<Eigen::Index>(i);
    const Eigen::MatrixXcd X = excitations(about, groups, omega[i], headings);
    put(options.drag.empty() ? motions_at(equations, omega[i], X)
                             : motions_with_drag(equations, omega[i], X, w, options.drag),
        i, out);
  });
  out.sparse = equations.are_sparse();
  out.factorisations = static_cast<int>(omega.size() * (is_common(options.drag) ? 1 : headings.size()));
  return out;
}

// (D142)
Amplitudes answers_to_loads(const SmallMotions& about, const std::vector<PotentialGroup>& groups,
                            const std::vector<double>& omega, const std::vector<int>& modes, const LinearDrag* drag,
                            int threads) {
  const Equations equations(about, groups, BelowData::straight_to_zero);
  const auto columns = static_cast<Eigen::Index>(modes.size());
  Eigen::MatrixXcd unit = Eigen::MatrixXcd::Zero(about.model.modes(), columns);
  for (Eigen::Index m = 0; m < columns; ++m) unit(modes[static_cast<std::size_t>(m)], m) = 1;
  Amplitudes out = no_motion(about, modes.size(), omega.size());
  if (equations.are_empty() || modes.empty()) return out;
  hydro::in_parallel(omega.size(), threads, [&](std::size_t w) {
    Impedance Z = equations.impedance(omega[w]);
    if (drag != nullptr) add_drag(*drag, 0, omega[w], Z);
    put(equations.solve(Z, unit, omega[w]), w, out);
  });
  out.sparse = equations.are_sparse();
  out.factorisations = static_cast<int>(omega.size());
  return out;
}

Eigen::MatrixXcd response_amplitudes(const SmallMotions& about, const std::vector<PotentialGroup>& groups,
                                     const std::vector<double>& omega, double heading, const LinearDrag* drag) {
  RaoOptions options;
  if (drag != nullptr) options.drag = {*drag};
  return response_amplitudes(about, groups, omega, std::vector{heading}, options).xi.front();
}

}  // namespace dynamics::frequency
