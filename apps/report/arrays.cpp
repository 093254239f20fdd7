#include "report/arrays.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "hydro/base/base64.hpp"

namespace froude::html {
namespace {

static_assert(std::endian::native == std::endian::little, "a report holds little-endian numbers");

template <class Number>
Json array_as(const char* type, std::span<const double> values) {
  const std::vector<Number> numbers(values.begin(), values.end());
  return {{"n", values.size()}, {type, hydro::base64(std::as_bytes(std::span(numbers)))}};
}

}  // namespace

Json single_array(std::span<const double> values) { return array_as<float>("f32", values); }
Json double_array(std::span<const double> values) { return array_as<double>("f64", values); }

Json complex_array(std::span<const double> pairs) {
  std::vector<double> re, im;
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) {
    re.push_back(pairs[i]);
    im.push_back(pairs[i + 1]);
  }
  return {{"re", single_array(re)}, {"im", single_array(im)}};
}

Thinning::Thinning(std::size_t samples, std::size_t most)
    : samples_(samples), piece_(samples <= most ? 1 : (2 * samples + most - 1) / most) {}

std::size_t Thinning::shown() const { return thins() ? 2 * ((samples_ + piece_ - 1) / piece_) : samples_; }

std::vector<double> Thinning::values(std::span<const double> of) const {
  if (!thins()) return {of.begin(), of.end()};
  std::vector<double> out;
  out.reserve(shown());
  for (std::size_t begin = 0; begin < samples_; begin += piece_) {
    const std::size_t end = std::min(begin + piece_, samples_);
    std::size_t low = begin, high = begin;
    for (std::size_t i = begin; i < end; ++i) {
      if (!std::isfinite(of[low]) || of[i] < of[low]) low = i;
      if (!std::isfinite(of[high]) || of[i] > of[high]) high = i;
    }
    out.push_back(of[std::min(low, high)]);
    out.push_back(of[std::max(low, high)]);
  }
  return out;
}

std::vector<double> Thinning::times(std::span<const double> of) const {
  if (!thins()) return {of.begin(), of.end()};
  std::vector<double> out;
  out.reserve(shown());
  for (std::size_t begin = 0; begin < samples_; begin += piece_) {
    const std::size_t last = std::min(begin + piece_, samples_) - 1, middle = begin + piece_ / 2;
    out.push_back(of[begin]);
    // A last piece may be shorter than half of the others: its second point then stands half a step on.
    out.push_back(middle <= last ? of[middle] : last > begin ? of[last] : of[begin] + (of[begin] - of[begin - 1]) / 2);
  }
  return out;
}

}  // namespace froude::html
