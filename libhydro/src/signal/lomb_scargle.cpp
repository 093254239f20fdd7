#include "hydro/signal/lomb_scargle.hpp"

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "hydro/base/error.hpp"
#include "hydro/signal/zero_crossings.hpp"

namespace hydro::signal {

double usual_nyquist_hz(std::span<const double> time_s) {
  require(time_s.size() > 1, "a record needs two samples");
  std::vector<double> steps;
  for (std::size_t i = 1; i < time_s.size(); ++i) steps.push_back(time_s[i] - time_s[i - 1]);
  std::nth_element(steps.begin(), steps.begin() + std::ssize(steps) / 2, steps.end());
  return 0.5 / steps[steps.size() / 2];
}

namespace {

/// The samples of one segment with Hann's window where they are.
struct Segment {
  std::vector<double> t, x, w;
  double sum = 0, squares = 0;
  double covered = 0, steps = 0;  // s, number: without gaps

  void add(double time, double value, double share, double gap) {
    if (!t.empty() && time - t.back() <= gap) covered += time - t.back(), ++steps;
    const double s = std::sin(std::numbers::pi * share);
    t.push_back(time), x.push_back(value), w.push_back(s * s);
    sum += w.back(), squares += w.back() * w.back();
  }
  /// Hz, of noise, of the window where it is sampled.
  double bandwidth_hz() const { return squares / (sum * sum) * steps / covered; }
  /// |Σ w e^{iωt}|².
  double window_squared(double hz) const {
    double even = 0, odd = 0;
    for (std::size_t i = 0; i < t.size(); ++i) {
      even += w[i] * std::cos(2 * std::numbers::pi * hz * t[i]);
      odd += w[i] * std::sin(2 * std::numbers::pi * hz * t[i]);
    }
    return even * even + odd * odd;
  }
  /// A² of mean + A cos(ωt + φ), least squares with the window as weight.
  double amplitude_squared(double omega) const {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < t.size(); ++i) {
      const Eigen::Vector3d row(1, std::cos(omega * t[i]), std::sin(omega * t[i]));
      normal += w[i] * row * row.transpose();
      right += w[i] * x[i] * row;
    }
    const Eigen::Vector3d found = normal.fullPivLu().solve(right);
    return found.tail<2>().squaredNorm();
  }
};

std::vector<Segment> segments_of(std::span<const double> time, std::span<const double> values, double length) {
  const double whole = time.back() - time.front();
  const double step = whole / static_cast<double>(time.size() - 1);
  const auto count = static_cast<std::size_t>((whole + step - length) / (length / 2) + 1e-9) + 1;
  const double gap = 10 * 0.5 / usual_nyquist_hz(time);  // longer than chance leaves out of every second sample
  std::vector<Segment> all(count), out;
  for (std::size_t i = 0; i < time.size(); ++i) {
    const double at = (time[i] - time.front()) / (length / 2);
    const auto last = static_cast<std::size_t>(at + 1e-9);
    for (std::size_t s = last > 0 ? last - 1 : 0; s <= last && s < count; ++s)
      if (const double share = (at - static_cast<double>(s)) / 2; share < 1 - 1e-9)
        all[s].add(time[i], values[i], share, gap);
  }
  std::size_t fullest = 0;
  for (const Segment& s : all) fullest = std::max(fullest, s.t.size());
  constexpr std::size_t least = 16;
  require(fullest >= least, "a segment of {:.6g} s holds {} samples at most, and {} are needed", length, fullest,
          least);
  for (Segment& s : all)
    if (2 * s.t.size() >= fullest) out.push_back(std::move(s));
  return out;
}

}  // namespace

// (S24)
WelchSpectrum lomb_scargle(std::span<const double> time_s, std::span<const double> values, double segment_s,
                           double highest_hz) {
  trend_of(time_s, values);  // looks the record through
  require(segment_s > 0 && segment_s <= (time_s.back() - time_s.front()) * (1 + 1e-9) *
                                            static_cast<double>(time_s.size()) / static_cast<double>(time_s.size() - 1),
          "a segment of {:.6g} s does not fit into a record of {:.6g} s", segment_s, time_s.back() - time_s.front());
  require(highest_hz > 2 / segment_s, "frequencies up to {:.4g} Hz need longer segments than {:.6g} s", highest_hz,
          segment_s);
  const std::vector<Segment> segments = segments_of(time_s, values, segment_s);
  const auto n = static_cast<double>(values.size());
  WelchSpectrum out{};
  out.segments = segments.size();
  out.dof = welch_dof(out.segments, {.segment = 1024});
  out.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  for (const double v : values) out.variance += (v - out.mean) * (v - out.mean) / n;
  out.resolution_hz = 1.5 / segment_s;
  out.samples_used = values.size();
  for (std::size_t k = 1; static_cast<double>(k) <= highest_hz * segment_s * (1 + 1e-12); ++k) {
    const double f = static_cast<double>(k) / segment_s;
    double density = 0;
    for (const Segment& s : segments) {
      // A line of variance A²/2 is spread over the window's noise bandwidth.
      density +=
          s.amplitude_squared(2 * std::numbers::pi * f) / 2 / s.bandwidth_hz() / static_cast<double>(segments.size());
    }
    out.spectrum.frequency_hz.push_back(f);
    out.spectrum.density.push_back(density);
  }
  return out;
}

// (F124)
std::vector<double> leaked_shares(std::span<const double> time_s, double segment_s, const SpectrumPerHz& spectrum) {
  const std::vector<double> none(time_s.size(), 0);
  const std::size_t lines = spectrum.density.size();
  std::vector<double> window(2 * lines + 1, 0);
  for (const Segment& s : segments_of(time_s, none, segment_s))
    for (std::size_t m = 0; m < window.size(); ++m) window[m] += s.window_squared(static_cast<double>(m) / segment_s);
  // Of both signs, over as many frequencies as the spectrum has: all of what a line is spread over.
  double all = window[0];
  for (std::size_t m = 1; m <= lines; ++m) all += 2 * window[m];
  constexpr std::size_t near = 2;  // lines that Hann's window itself spreads over
  std::vector<double> out;
  for (std::size_t k = 0; k < lines; ++k) {
    double leaked = 0;
    for (std::size_t j = 0; j < lines; ++j) {
      const std::size_t apart = k > j ? k - j : j - k, sum = k + j + 2;  // lines are counted from 1/T
      leaked += spectrum.density[j] * ((apart > near ? window[apart] : 0) + window[sum]) / all;
    }
    out.push_back(spectrum.density[k] > 0 ? std::min(1.0, leaked / spectrum.density[k]) : 0);
  }
  return out;
}

}  // namespace hydro::signal
