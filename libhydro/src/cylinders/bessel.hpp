#pragma once
/// \file  Bessel functions as the cylinder solver needs them: whole sequences of orders, scaled so that nothing
/// overflows. Values of single orders come from Boost.Math; sequences by recurrence in the stable direction. Not
/// installed.
#include <complex>
#include <span>
#include <vector>

namespace hydro::cylinders {

/// J_ν(x) for ν = first, first + 1, …, x > 0, 0 <= first < 1. Relative to the largest of |J_ν|, |J_{ν+1}| near an
/// order: 1e-13.
void bessel_j_sequence(double first, double x, std::span<double> out);

/// e^{−x} I_ν(x) for ν = first, first + 1, …, x > 0, 0 <= first < 1; 1e-13 relative.
void bessel_i_scaled_sequence(double first, double x, std::span<double> out);

/// H⁽²⁾_m(x) for m = 0 … size − 1, x > 0: waves that go out where time goes as e^{+iωt}.
void hankel_2_sequence(double x, std::span<std::complex<double>> out);

/// e^{x} K_m(x) for m = 0 … size − 1, x > 0.
void bessel_k_scaled_sequence(double x, std::span<double> out);

/// K_m(x)/K_m′(x) for m = 0 … size − 1, x > 0; all negative.
void bessel_k_over_slope(double x, std::span<double> out);

/// I_m(x)/I_m′(x) for m = 0 … size − 1, x > 0; all positive.
void bessel_i_over_slope(double x, std::span<double> out);

/// The factor P + iQ of Hankel's expansion J_ν(x) = √(2/(πx)) Re[(P + iQ) e^{i(x − νπ/2 − π/4)}] (Abramowitz & Stegun
/// 1964, 9.2.5), summed to its smallest term. Meant for x > ν².
std::complex<double> hankel_amplitude(double order, double x);

}  // namespace hydro::cylinders
