#include "fit/band_pass.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"

namespace fit {
namespace {

constexpr int band_order = 4;
constexpr double flat_within = 0.01;

/// Where a gain that is flat at `inside` and is not at `outside` leaves the last per cent, Hz.
double edge_of_flatness(const BandPass& band, double inside, double outside) {
  for (int halving = 0; halving < 50; ++halving) {
    const double middle = (inside + outside) / 2;
    (std::abs(band.gain(2 * std::numbers::pi * middle) - 1) > flat_within ? outside : inside) = middle;
  }
  return inside;
}

}  // namespace

BandEdges band_about_waves(double hz) { return {0.2 * hz, 4 * hz}; }

BandPass::BandPass(double low_hz, std::optional<double> high_hz, double step_s)  // (F108)
    : low_hz_(low_hz),
      step_(step_s),
      high_hz_(high_hz),
      slow_(ZeroPhaseFilter::butterworth(band_order, low_hz, step_s)) {
  if (!high_hz) return;
  if (!(low_hz < *high_hz))
    throw hydro::InputError(
        fmt::format("a band-pass goes from a lower frequency to a higher one, got {:.4g} Hz and {:.4g} Hz", low_hz,
                    *high_hz),
        {}, "write the lower edge first");
  fast_ = ZeroPhaseFilter::butterworth(band_order, *high_hz, step_s);
}

double BandPass::gain(double omega) const { return (fast_ ? fast_->gain(omega) : 1) - slow_.gain(omega); }

std::optional<std::pair<double, double>> BandPass::flat_hz() const {
  const double nyquist = 0.5 / step_, high = high_hz_.value_or(nyquist), middle = std::sqrt(low_hz_ * high);
  if (std::abs(gain(2 * std::numbers::pi * middle) - 1) > flat_within) return std::nullopt;
  return std::pair{edge_of_flatness(*this, middle, low_hz_),
                   high_hz_ ? edge_of_flatness(*this, middle, *high_hz_) : nyquist};
}

std::size_t BandPass::settling() const { return std::max(slow_.settling(), fast_ ? fast_->settling() : 0); }

std::string BandPass::name() const {
  return high_hz_ ? fmt::format("band-pass from {:.4g} Hz to {:.4g} Hz", low_hz_, *high_hz_)
                  : fmt::format("band-pass from {:.4g} Hz on", low_hz_);
}

std::vector<double> BandPass::apply(std::span<const double> values) const {
  const std::size_t lost = settling();
  if (values.size() <= 2 * lost)
    throw hydro::InputError(
        fmt::format("the {} gives up {:.4g} s at each end, and the record is {:.4g} s long: nothing would be left",
                    name(), static_cast<double>(lost) * step_, static_cast<double>(values.size() - 1) * step_),
        {}, "raise the lower edge, or take a longer record");
  const std::vector<double> below = slow_.apply(values);
  const std::vector<double> fast = fast_ ? fast_->apply(values) : std::vector<double>(values.begin(), values.end());
  const std::size_t skip_below = lost - slow_.settling(), skip_fast = lost - (fast_ ? fast_->settling() : 0);
  std::vector<double> out(values.size() - 2 * lost);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = fast[i + skip_fast] - below[i + skip_below];
  return out;
}

}  // namespace fit
