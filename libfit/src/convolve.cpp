#include "convolve.hpp"

#include <algorithm>
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
  const std::size_t part = std::max<std::size_t>(16 * weights.size(), 1 << 16);
  if (values.size() > part) {
    for (std::size_t first = 0; first < out.size(); first += part - weights.size() + 1) {
      const auto some = sliding_sum(values.subspan(first, std::min(part, values.size() - first)), weights);
      std::copy(some.begin(), some.end(), out.begin() + static_cast<std::ptrdiff_t>(first));
    }
    return out;
  }
  // Circular, of at least the record's length: whole sums never wrap round.
  const std::size_t n = good_length(values.size());
  std::vector<double> x(n), w(n);
  std::copy(values.begin(), values.end(), x.begin());
  std::copy(weights.begin(), weights.end(), w.begin());
  auto spectrum = hydro::signal::real_fft(x);
  const auto other = hydro::signal::real_fft(w);
  for (std::size_t k = 0; k < spectrum.size(); ++k) spectrum[k] *= std::conj(other[k]) / static_cast<double>(n);
  const auto sum = hydro::signal::inverse_real_fft(spectrum, n);
  std::copy_n(sum.begin(), out.size(), out.begin());
  return out;
}

}  // namespace fit
