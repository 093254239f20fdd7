#pragma once
/// \file  Quantiles behind confidence intervals: normal, chi-square, Student's t; (S3), docs/theory/signal.md.
///
/// Degrees of freedom need not be whole numbers: those of overlapping windows and correlated residuals are not.
/// Relative error below 1e-10 for 1e-6 <= p <= 1 − 1e-6 and 0.5 <= ν <= 1e6 (tests hold published tables).

namespace hydro::signal {

/// Regularised lower incomplete gamma function P(a, x) = ∫₀ˣ t^{a−1} e^{−t} dt / Γ(a), a > 0, x >= 0. \throws
/// InputError
double incomplete_gamma(double a, double x);

/// Regularised incomplete beta function I_x(a, b), a, b > 0, 0 <= x <= 1. \throws InputError
double incomplete_beta(double a, double b, double x);

/// z with P(Z < z) = p, 0 < p < 1. \throws InputError; so do the others
double normal_quantile(double p);

/// x with P(χ²_ν < x) = p, ν > 0.
double chi_square_quantile(double p, double dof);

/// t with P(T_ν < t) = p, ν > 0.
double student_t_quantile(double p, double dof);

}  // namespace hydro::signal
