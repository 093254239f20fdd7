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
struct Forward {
  int n;
  Buffer<double> in;
  Buffer<fftw_complex> out;
  Plan plan;

  explicit Forward(int length)
      : n(length),
        in(allocate<double>(static_cast<std::size_t>(n))),
        out(allocate<fftw_complex>(static_cast<std::size_t>(n) / 2 + 1)) {
    const std::lock_guard lock(planner());
    plan.reset(fftw_plan_dft_r2c_1d(n, in.get(), out.get(), FFTW_ESTIMATE));
  }
};
struct Inverse {
  int n;
  Buffer<fftw_complex> in;
  Buffer<double> out;
  Plan plan;

  explicit Inverse(int length)
      : n(length),
        in(allocate<fftw_complex>(static_cast<std::size_t>(n) / 2 + 1)),
        out(allocate<double>(static_cast<std::size_t>(n))) {
    const std::lock_guard lock(planner());
    plan.reset(fftw_plan_dft_c2r_1d(n, in.get(), out.get(), FFTW_ESTIMATE));
  }
};

/// That of the last length, if it is not too large to be kept: long records are transformed in parts, and a plan costs
/// as much as its transform.
template <class Transform>
std::shared_ptr<Transform> transform_of(std::size_t n) {
  constexpr int most = 1 << 18;  // 4 MB
  thread_local std::shared_ptr<Transform> last;
  const int length = static_cast<int>(n);
  if (last && last->n == length) return last;
  auto made = std::make_shared<Transform>(length);
  if (length <= most) last = made;
  return made;
}

}  // namespace

std::vector<std::complex<double>> real_fft(std::span<const double> x) {
  require(!x.empty(), "a series of no samples has no Fourier transform");
  const auto transform = transform_of<Forward>(x.size());
  std::copy(x.begin(), x.end(), transform->in.get());
  fftw_execute(transform->plan.get());
  std::vector<std::complex<double>> half(x.size() / 2 + 1);
  for (std::size_t k = 0; k < half.size(); ++k) half[k] = {transform->out[k][0], transform->out[k][1]};
  return half;
}

std::vector<double> inverse_real_fft(std::span<const std::complex<double>> half, std::size_t n) {
  require(n > 0, "a series of no samples has no Fourier transform");
  require(half.size() == n / 2 + 1, "a real series of {} samples has {} Fourier coefficients, not {}", n, n / 2 + 1,
          half.size());
  const auto transform = transform_of<Inverse>(n);
  for (std::size_t k = 0; k < half.size(); ++k) {
    transform->in[k][0] = half[k].real();
    transform->in[k][1] = half[k].imag();
  }
  fftw_execute(transform->plan.get());
  const double* out = transform->out.get();
  return {out, out + n};
}

}  // namespace hydro::signal
