#pragma once
/// \file  The parameters of generalised-α, for all that steps by it. (D11)

namespace dynamics {

/// Second order and the least damping of what is slow, for the spectral radius ρ∞ at infinite frequency, 0 … 1 (Chung &
/// Hulbert 1993).
struct AlphaParameters {
  double alpha_m, alpha_f, gamma, beta;

  explicit constexpr AlphaParameters(double rho_infinity)
      : alpha_m((2 * rho_infinity - 1) / (rho_infinity + 1)),
        alpha_f(rho_infinity / (rho_infinity + 1)),
        gamma(0.5 + alpha_f - alpha_m),
        beta(0.25 * (gamma + 0.5) * (gamma + 0.5)) {}
};

}  // namespace dynamics
