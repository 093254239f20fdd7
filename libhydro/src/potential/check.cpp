#include "hydro/potential/check.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

#include "readers.hpp"

namespace hydro::potential {
namespace {

/// One matrix of a series with the frequency that it belongs to, as text.
struct Sample {
  std::string at;
  const Eigen::MatrixXd* matrix;
};
using Series = std::vector<Sample>;

Series series_of(const Coefficients& c, const std::vector<Eigen::MatrixXd>& matrices) {
  Series series;
  for (std::size_t k = 0; k < matrices.size(); ++k)
    series.push_back({fmt::format("{:.4g} rad/s", c.omega[k]), &matrices[k]});
  return series;
}

/// s_i of (P11).
Eigen::VectorXd sizes(const Series& series, Eigen::Index n) {
  Eigen::VectorXd s = Eigen::VectorXd::Zero(n);
  for (const Sample& sample : series) s = s.cwiseMax(sample.matrix->diagonal().cwiseAbs());
  // Yaw of a body of revolution has no added mass but the panels' noise; without a floor that noise would be divided
  // by itself.
  constexpr double floor = 0.01;
  for (const bool translations : {true, false}) {
    double most = 0;
    for (Eigen::Index i = 0; i < n; ++i)
      if (is_translation(i) == translations) most = std::max(most, s(i));
    for (Eigen::Index i = 0; i < n; ++i)
      if (is_translation(i) == translations) s(i) = std::max(s(i), floor * most);
  }
  return s;
}

/// sqrt(s_i s_j), or 1 where there is nothing to compare with.
double size_of_entry(const Eigen::VectorXd& s, Eigen::Index i, Eigen::Index j) {
  const double size = std::sqrt(s(i) * s(j));
  return size > 0 ? size : 1;
}

struct Worst {
  double value = 0;
  Eigen::Index i = 0, j = 0;
  std::string at;
};

Worst worst_asymmetry(const Series& series, const Eigen::VectorXd& s) {
  Worst worst;
  for (const Sample& sample : series)
    for (Eigen::Index i = 0; i < s.size(); ++i)
      for (Eigen::Index j = i + 1; j < s.size(); ++j) {
        const auto& M = *sample.matrix;
        const double value = std::abs(M(i, j) - M(j, i)) / size_of_entry(s, i, j);
        if (value > worst.value) worst = {value, i, j, sample.at};
      }
  return worst;
}

std::string place_of(const char* name, const Worst& w) {
  return fmt::format("{}({}, {}) at {}: {} and {}", name, w.i + 1, w.j + 1, w.at, mode_label(w.i), mode_label(w.j));
}

Finding symmetry_finding(const char* name, const Worst& worst) {
  const bool is_large = worst.value > usual_asymmetry;
  Finding f{is_large ? Severity::warning : Severity::note, fmt::format("symmetry of {}", name),
            worst.value > 0 ? place_of(name, worst) : std::string(name),
            fmt::format("largest |{0}_ij − {0}_ji| is {1:.2g} of sqrt({0}_ii {0}_jj); up to {2} is usual", name,
                        worst.value, usual_asymmetry),
            ""};
  if (is_large) f.remedy = "compute on a finer mesh, or check that rows and columns were not mixed up";
  return f;
}

/// B_ii < 0 would make a hull in calm water a source of power.
Finding sign_finding(const Series& B, const Eigen::VectorXd& s, double asymmetry) {
  Worst worst;
  for (const Sample& sample : B)
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      const double value = -(*sample.matrix)(i, i) / size_of_entry(s, i, i);
      if (value > worst.value) worst = {value, i, i, sample.at};
    }
  Finding f{Severity::note, "sign of B", "B", "no diagonal entry of B is negative", ""};
  if (worst.value <= 0) return f;
  // How unsymmetric the data are is how far their own discretisation error reaches; data that are bad in this respect
  // are not forgiven more than usual ones for it.
  constexpr double round_off = 1e-9;
  if (worst.value > std::max(round_off, std::min(asymmetry, usual_negative_damping))) f.severity = Severity::warning;
  if (worst.value > impossible_negative_damping) f.severity = Severity::error;
  f.where = place_of("B", worst);
  f.message =
      fmt::format("B is negative by {:.2g} of its largest value in that mode; the data are unsymmetric by {:.2g}",
                  worst.value, asymmetry);
  if (f.severity != Severity::note)
    f.remedy =
        "irregular frequencies or too coarse a mesh do this: use a lid, a finer mesh, or leave these frequencies out";
  return f;
}

/// Power given to the waves is ½ v* B v: no motion may have it negative.
Finding passivity_finding(const Series& B, const Eigen::VectorXd& s) {
  double smallest = std::numeric_limits<double>::infinity();
  std::string at;
  const Eigen::Index n = s.size();
  for (const Sample& sample : B) {
    const Eigen::MatrixXd scaled = Eigen::MatrixXd::NullaryExpr(n, n, [&](Eigen::Index i, Eigen::Index j) {
      return ((*sample.matrix)(i, j) + (*sample.matrix)(j, i)) / (2 * size_of_entry(s, i, j));
    });
    const double value =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues()(0);
    if (value < smallest) {
      smallest = value;
      at = sample.at;
    }
  }
  Finding f{smallest < -usual_negative_damping ? Severity::warning : Severity::note, "passivity of B", "B at " + at,
            fmt::format(
                "smallest eigenvalue of the symmetric part, scaled by sqrt(B_ii B_jj), is {:.2g}; down to {} is usual",
                smallest, -usual_negative_damping),
            ""};
  if (f.severity == Severity::warning)
    f.remedy = "some motion takes power from calm water: use a finer mesh, or a passive fit of the radiation";
  return f;
}

Finding limit_finding(bool is_there, const char* limit, Severity severity, const char* remedy) {
  return {is_there ? Severity::note : severity, fmt::format("limit at {}", limit),
          fmt::format("A as frequency tends to {}", limit), is_there ? "present" : "absent", is_there ? "" : remedy};
}

}  // namespace

std::string_view to_string(Severity severity) {
  switch (severity) {
    case Severity::note:
      return "note";
    case Severity::warning:
      return "warning";
    case Severity::error:
      break;
  }
  return "error";
}

std::vector<Finding> check(const Coefficients& c) {
  c.validate();
  Series A = series_of(c, c.A);
  const Series B = series_of(c, c.B);
  if (c.A_zero) A.push_back({"zero frequency", &*c.A_zero});
  if (c.A_inf) A.push_back({"infinite frequency", &*c.A_inf});
  const Eigen::VectorXd size_of_A = sizes(A, c.modes()), size_of_B = sizes(B, c.modes());
  const Worst asymmetry_of_B = worst_asymmetry(B, size_of_B);
  return {symmetry_finding("A", worst_asymmetry(A, size_of_A)),
          symmetry_finding("B", asymmetry_of_B),
          sign_finding(B, size_of_B, asymmetry_of_B.value),
          passivity_finding(B, size_of_B),
          limit_finding(c.A_zero.has_value(), "zero", Severity::note,
                        "nothing needs it but extrapolation to long waves; in finite depth heave has no such limit"),
          limit_finding(c.A_inf.has_value(), "infinity", Severity::warning,
                        "time-domain runs need it: compute omega = infinity too, or it is estimated from A and B")};
}

}  // namespace hydro::potential
