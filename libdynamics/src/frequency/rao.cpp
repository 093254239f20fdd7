#include "dynamics/frequency/rao.hpp"

#include "hydro/base/dense.hpp"
#include "linear_model.hpp"
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

Eigen::VectorXcd excitation(const Model& model, const std::vector<PotentialGroup>& groups, double omega,
                            double heading) {
  Eigen::VectorXcd F = Eigen::VectorXcd::Zero(model.modes());
  for (const PotentialGroup& g : groups) {
    if (!g.excitation) continue;
    const Eigen::VectorXcd X = g.table.excitation(omega, heading);
    for (std::size_t i = 0; i < g.bodies.size(); ++i)
      F.segment<6>(6 * g.bodies[i]) += X.segment<6>(6 * static_cast<Eigen::Index>(i));
  }
  return F;
}

namespace {

/// Both sides of (Q1).
struct Equations {
  Eigen::MatrixXcd Z;
  Eigen::VectorXcd X;
};
Equations equations(const SmallMotions& about, const std::vector<PotentialGroup>& groups, double omega, double heading,
                    const LinearDrag* drag, Eigen::Index w) {
  Equations e{impedance(about, groups, omega), excitation(about.model, groups, omega, heading)};
  if (drag != nullptr) e = {drag->added_to(std::move(e.Z), w, omega), e.X + drag->excitation(w, e.X.size())};
  return e;
}

/// The right-hand sides of (Q1), one column a heading, (6N, Nβ).
Eigen::MatrixXcd excitations(const Model& model, const std::vector<PotentialGroup>& groups, double omega,
                             const std::vector<double>& headings) {
  Eigen::MatrixXcd X(model.modes(), static_cast<Eigen::Index>(headings.size()));
  for (Eigen::Index h = 0; h < X.cols(); ++h)
    X.col(h) = excitation(model, groups, omega, headings[static_cast<std::size_t>(h)]);
  return X;
}

/// The multipliers of joints, from what motions leave open of the equations of motion.
class OpenEquations {
 public:
  explicit OpenEquations(const SmallMotions& about)
      : scale_(scale_of(about)), qr_(scale_.asDiagonal() * about.linear.constraints.transpose()) {}

  /// λ by X − Z ξ, of a vector or of each column.
  template <class Loads>
  Loads multipliers(const Loads& rest) const {
    const auto real = qr_.solve(scale_.asDiagonal() * rest.real()),
               imaginary = qr_.solve(scale_.asDiagonal() * rest.imag());
    Loads lambda(real.rows(), rest.cols());
    lambda.real() = real;
    lambda.imag() = imaginary;
    return lambda;
  }

 private:
  /// Only free modes have an equation, and rows are scaled so that newtons and newton metres compare.
  static Eigen::VectorXd scale_of(const SmallMotions& about) {
    Eigen::VectorXd scale = about.mass.diagonal().cwiseSqrt().cwiseInverse();
    for (int m = 0; m < about.model.modes(); ++m)
      if (!about.model.is_free(m)) scale[m] = 0;
    return scale;
  }

  Eigen::VectorXd scale_;
  hydro::dense::PivotedQr qr_;
};

/// Column w of the matrix of each heading, side by side; and back.
Eigen::MatrixXcd columns_at(const std::vector<Eigen::MatrixXcd>& by_heading, Eigen::Index w) {
  Eigen::MatrixXcd out(by_heading.front().rows(), static_cast<Eigen::Index>(by_heading.size()));
  for (Eigen::Index h = 0; h < out.cols(); ++h) out.col(h) = by_heading[static_cast<std::size_t>(h)].col(w);
  return out;
}
void set_columns(const Eigen::MatrixXcd& columns, Eigen::Index w, std::vector<Eigen::MatrixXcd>& by_heading) {
  for (Eigen::Index h = 0; h < columns.cols(); ++h) by_heading[static_cast<std::size_t>(h)].col(w) = columns.col(h);
}

}  // namespace

Eigen::MatrixXcd response_amplitudes(const SmallMotions& about, const std::vector<PotentialGroup>& groups,
                                     const std::vector<double>& omega, double heading, const LinearDrag* drag) {
  LinearModel of(about);
  Eigen::MatrixXcd xi = Eigen::MatrixXcd::Zero(about.model.modes(), static_cast<Eigen::Index>(omega.size()));
  if (of.left.count() == 0) return xi;
  for (Eigen::Index w = 0; w < xi.cols(); ++w) {
    const double at = omega[static_cast<std::size_t>(w)];
    const auto [Z, X] = equations(about, groups, at, heading, drag, w);
    xi.col(w) = of.response(Z, X, at);  // (Q1)
  }
  return xi;
}

HeadingAmplitudes response_amplitudes(const SmallMotions& about, const std::vector<PotentialGroup>& groups,
                                      const std::vector<double>& omega, const std::vector<double>& headings) {
  LinearModel of(about);
  const auto frequencies = static_cast<Eigen::Index>(omega.size());
  HeadingAmplitudes out;
  out.xi.assign(headings.size(), Eigen::MatrixXcd::Zero(about.model.modes(), frequencies));
  if (of.left.count() == 0) return out;
  for (Eigen::Index w = 0; w < frequencies; ++w) {
    const double at = omega[static_cast<std::size_t>(w)];
    const Eigen::MatrixXcd X = excitations(about.model, groups, at, headings);
    set_columns(of.response(impedance(about, groups, at), X, at), w, out.xi);  // (Q1), all headings
  }
  out.factorisations = of.factorisations;
  return out;
}

Eigen::MatrixXcd multiplier_amplitudes(const SmallMotions& about, const std::vector<PotentialGroup>& groups,
                                       const std::vector<double>& omega, double heading, const Eigen::MatrixXcd& xi,
                                       const LinearDrag* drag) {
  Eigen::MatrixXcd lambda(about.linear.constraints.rows(), xi.cols());
  if (lambda.rows() == 0) return lambda;
  const OpenEquations open(about);
  for (Eigen::Index w = 0; w < xi.cols(); ++w) {
    const auto [Z, X] = equations(about, groups, omega[static_cast<std::size_t>(w)], heading, drag, w);
    lambda.col(w) = open.multipliers(Eigen::VectorXcd(X - Z * xi.col(w)));
  }
  return lambda;
}

std::vector<Eigen::MatrixXcd> multiplier_amplitudes(const SmallMotions& about,
                                                    const std::vector<PotentialGroup>& groups,
                                                    const std::vector<double>& omega,
                                                    const std::vector<double>& headings,
                                                    const std::vector<Eigen::MatrixXcd>& xi) {
  const auto frequencies = static_cast<Eigen::Index>(omega.size());
  std::vector<Eigen::MatrixXcd> lambda(headings.size(), Eigen::MatrixXcd(about.linear.constraints.rows(), frequencies));
  if (about.linear.constraints.rows() == 0 || headings.empty()) return lambda;
  const OpenEquations open(about);
  for (Eigen::Index w = 0; w < frequencies; ++w) {
    const double at = omega[static_cast<std::size_t>(w)];
    const Eigen::MatrixXcd X = excitations(about.model, groups, at, headings);
    set_columns(open.multipliers(Eigen::MatrixXcd(X - impedance(about, groups, at) * columns_at(xi, w))), w, lambda);
  }
  return lambda;
}

}  // namespace dynamics::frequency
