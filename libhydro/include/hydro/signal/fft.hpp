#pragma once
/// \file  The discrete Fourier transform of real series, one convention for all of Froude; equation (S1),
/// docs/theory/signal.md.
///
/// Both directions are unnormalised: inverse_real_fft(real_fft(x), n) is n·x. The kernel of real_fft is e^{-iωt}, so a
/// series Re(a e^{+iωt}) that fits the window gives n·a/2 in its bin: amplitudes have the phase convention of all of
/// ours. Any length; cost O(n log n). Error: relative rms below 1e-15·log2 n. Safe to call from several threads.
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace hydro::signal {

/// X_k = Σ_j x_j e^{-i2πjk/n} for k = 0 … n/2, shape (n/2 + 1). \throws InputError if x is empty
std::vector<std::complex<double>> real_fft(std::span<const double> x);

/// x_j = Σ_{k=0}^{n-1} c_k e^{+i2πjk/n}, shape (n), where `half` holds c_0 … c_{n/2} and the rest follows from
/// c_{n-k} = conj(c_k). Imaginary parts of c_0 and, for even n, of c_{n/2} have no such series and are ignored.
/// \throws InputError unless half has n/2 + 1 values and n > 0
std::vector<double> inverse_real_fft(std::span<const std::complex<double>> half, std::size_t n);

}  // namespace hydro::signal
