#include "hydro/signal/fft.hpp"

#include <fftw3.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <new>

#include "hydro/base/error.hpp"
#include "planner.hpp"

namespace hydro::signal {
namespace {

struct FreeBuffer {
  void operator()(void* p) const { fftw_free(p); }
};
template <class T>
using Buffer = std::unique_ptr<T[], FreeBuffer>;

// Aligned alike on every call, so the plan and therefore the last bit of the result are the same on every call.
template <class T>
Buffer<T> allocate(std::size_t n) {
  Buffer<T> buffer(static_cast<T*>(fftw_malloc(n * sizeof(T))));
  if (!buffer) throw std::bad_alloc();
  return buffer;
}

// ESTIMATE plans do not time candidates: the choice depends on n alone, not on how busy the machine was.
Plan plan_forward(int n, double* in, fftw_complex* out) {
  const std::lock_guard lock(planner());
  return Plan(fftw_plan_dft_r2c_1d(n, in, out, FFTW_ESTIMATE));
}
Plan plan_inverse(int n, fftw_complex* in, double* out) {
  const std::lock_guard lock(planner());
  return Plan(fftw_plan_dft_c2r_1d(n, in, out, FFTW_ESTIMATE));
}

}  // namespace

std::vector<std::complex<double>> real_fft(std::span<const double> x) {
  require(!x.empty(), "a series of no samples has no Fourier transform");
  const auto in = allocate<double>(x.size());
  const auto out = allocate<fftw_complex>(x.size() / 2 + 1);
  const Plan plan = plan_forward(static_cast<int>(x.size()), in.get(), out.get());
  std::copy(x.begin(), x.end(), in.get());
  fftw_execute(plan.get());
  std::vector<std::complex<double>> half(x.size() / 2 + 1);
  for (std::size_t k = 0; k < half.size(); ++k) half[k] = {out[k][0], out[k][1]};
  return half;
}

std::vector<double> inverse_real_fft(std::span<const std::complex<double>> half, std::size_t n) {
  require(n > 0, "a series of no samples has no Fourier transform");
  require(half.size() == n / 2 + 1, "a real series of {} samples has {} Fourier coefficients, not {}", n, n / 2 + 1,
          half.size());
  const auto in = allocate<fftw_complex>(half.size());
  const auto out = allocate<double>(n);
  const Plan plan = plan_inverse(static_cast<int>(n), in.get(), out.get());
  for (std::size_t k = 0; k < half.size(); ++k) {
    in[k][0] = half[k].real();
    in[k][1] = half[k].imag();
  }
  fftw_execute(plan.get());
  return {out.get(), out.get() + n};
}

}  // namespace hydro::signal
