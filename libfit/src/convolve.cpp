#include "convolve.hpp"

#include <algorithm>
#include <complex>
#include <numeric>

#include "hydro/base/error.hpp"
#include "hydro/signal/fft.hpp"

namespace fit {
namespace {

constexpr std::size_t few = 64;  // below, the transform is the slower way

// The next length that the transform likes: 2^a, 3·2^a or 5·2^a.
std::size_t good_length(std::size_t n) {
  std::size_t best = 0;
  for (const std::size_t odd : {1u, 3u, 5u}) {
    std::size_t length = odd;
    while (length < n) length *= 2;
    if (best == 0 || length < best) best = length;
  }
  return best;
}

/// The same sum by a circular one of n samples, as many as there are values at least: whole sums never wrap round.
class CircularSum {
 public:
  CircularSum(std::span<const double> weights, std::size_t n) : n_(n), count_(weights.size()), padded_(n) {
    std::copy(weights.begin(), weights.end(), padded_.begin());
    conjugate_ = hydro::signal::real_fft(padded_);
    for (auto& w : conjugate_) w = std::conj(w) / static_cast<double>(n);
  }
  /// Into as many places as there are whole sums.
  void sum(std::span<const double> values, double* out) {
    std::fill(std::copy(values.begin(), values.end(), padded_.begin()), padded_.end(), 0.0);
    auto spectrum = hydro::signal::real_fft(padded_);
    for (std::size_t k = 0; k < spectrum.size(); ++k) spectrum[k] *= conjugate_[k];
    std::copy_n(hydro::signal::inverse_real_fft(spectrum, n_).begin(), values.size() - count_ + 1, out);
  }

 private:
  std::size_t n_, count_;
  std::vector<double> padded_;
  std::vector<std::complex<double>> conjugate_;
};

}  // namespace

std::vector<double> sliding_sum(std::span<const double> values, std::span<const double> weights) {
  hydro::require(!weights.empty() && values.size() >= weights.size(), "{} samples are fewer than the window's {}",
                 values.size(), weights.size());
  std::vector<double> out(values.size() - weights.size() + 1);
  if (weights.size() <= few) {
    for (std::size_t j = 0; j < out.size(); ++j)
      out[j] = std::inner_product(weights.begin(), weights.end(), values.begin() + static_cast<std::ptrdiff_t>(j), 0.0);
    return out;
  }
  // By parts that the processor's cache holds, where the record is many times longer than the window.
  const std::size_t part = std::min(values.size(), std::max<std::size_t>(16 * weights.size(), 1 << 16));
  CircularSum circular(weights, good_length(part));
  for (std::size_t first = 0; first < out.size(); first += part - weights.size() + 1)
    circular.sum(values.subspan(first, std::min(part, values.size() - first)), out.data() + first);
  return out;
}

}  // namespace fit
