#include "hydro/waves/kinematics/trains.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "hydro/base/error.hpp"

namespace hydro::waves {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

/// Of an envelope: it changes by half a cosine about its middle.
struct TrainFade {
  double middle, width;  ///< s
};
struct TrainEnvelope {
  TrainFade rise, fall;
};

std::vector<TrainEnvelope> train_envelopes(std::span<const WaveTrain> trains, const TrainCut& cut) {
  double longest = 0;
  for (const WaveTrain& train : trains) {
    require(train.fade_s > 0, "a train needs a fade that is longer than nothing");
    longest = std::max(longest, train.fade_s);
  }
  std::vector<TrainFade> fades;
  for (const WaveTrain& train : trains) fades.push_back({train.from_s + train.fade_s / 2, train.fade_s});
  fades.push_back({cut.end_s - longest / 2, longest});
  require(fades.front().middle - fades.front().width / 2 >= cut.begin_s,
          "the first train begins before the span in which trains are cut");
  std::vector<TrainEnvelope> out;
  for (std::size_t i = 0; i + 1 < fades.size(); ++i) {
    const double whole = fades[i].middle + fades[i].width / 2, goes = fades[i + 1].middle - fades[i + 1].width / 2;
    require(whole <= goes, "train {} goes at {:.6g} s, before it is whole at {:.6g} s", i + 1, goes, whole);
    out.push_back({fades[i], fades[i + 1]});
  }
  return out;
}

/// ∫ of the rate of a fade times e^{−iδt}, t from its middle.
double rate_transform(double delta, double width) {
  const double x = delta * width / pi, below = 1 - x * x;
  return std::abs(below) < 1e-7 ? pi / 4 : std::cos(delta * width / 2) / below;
}

/// E(δ) = ∫ e(t) e^{−iδt} dt, s.
Complex transform_of(const TrainEnvelope& e, double delta) {
  const double length = e.fall.middle - e.rise.middle;
  if (std::abs(delta) * (std::abs(e.fall.middle) + std::abs(e.rise.middle)) < 1e-7) return length;
  const auto edge = [&](const TrainFade& f) { return std::polar(rate_transform(delta, f.width), -delta * f.middle); };
  return (edge(e.rise) - edge(e.fall)) / Complex(0, delta);
}

/// Bound of what components farther from a train than δ are together, of its amplitude: |E| ≤ Σ 1/(δ((δw/π)² − 1)).
double tail_of(const TrainEnvelope& e, double delta) {
  double out = 0;
  for (const double width : {e.rise.width, e.fall.width}) {
    const double x = pi / (delta * width);
    out -= std::log1p(-x * x) / (4 * pi);
  }
  return out;
}

}  // namespace

double half_band(double shortest_fade_s, double tolerance) {
  return pi / (shortest_fade_s * std::sqrt(-std::expm1(-2 * pi * tolerance)));
}

TrainComponents components_of(std::span<const WaveTrain> trains, const TrainCut& cut) {
  require(!trains.empty(), "there is no train of waves");
  const std::vector<TrainEnvelope> envelope = train_envelopes(trains, cut);
  const double span = cut.end_s - cut.begin_s, apart = 2 * pi / span;
  TrainComponents out{{}, 0};
  for (std::size_t i = 0; i < trains.size(); ++i) {
    const WaveTrain& train = trains[i];
    const TrainEnvelope& e = envelope[i];
    const double own = train.omega.rad_per_s(), half = half_band(std::min(e.rise.width, e.fall.width), cut.tolerance),
                 last = std::floor((own + half) / apart);
    // (W102); n = 0 is the mean of what is cut.
    double left_out = tail_of(e, last * apart - own) + tail_of(e, last * apart + own);
    for (double n = 0; n <= last; ++n) {
      const double omega = n * apart;
      const Complex c = (std::polar(1.0, train.phase) * transform_of(e, omega - own) +
                         std::polar(1.0, -train.phase) * transform_of(e, omega + own)) /
                        span;
      const bool kept = n > 0 && omega >= own - half && omega >= cut.lowest && omega <= cut.highest;
      if (!kept) {
        left_out += std::abs(c);
        continue;
      }
      out.waves.push_back({AngularFrequency::from_rad_per_s(omega),
                           WaveAmplitude::from_metres(std::abs(c) * train.amplitude.metres()), std::arg(c),
                           train.heading});
    }
    out.left_out = std::max(out.left_out, left_out);
  }
  return out;
}

}  // namespace hydro::waves
