#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include "harness/case.hpp"
#include "hydro/signal/fft.hpp"
#include "hydro/waves/dispersion.hpp"
#include "hydro/waves/kinematics/sea.hpp"
#include "hydro/waves/spectra/spectra.hpp"
#include "hydro/waves/spectra/spectrum_tabulated.hpp"
#include "hydro/waves/spectra/spreading.hpp"

namespace froude::validation::spectra {
namespace {

using namespace hydro::waves;
using hydro::Angle;

constexpr double two_pi = 2 * std::numbers::pi;
constexpr double top = 4;  // m_4 is taken up to this multiple of the peak frequency

/// m_n up to infinity for n < 3, up to a frequency for n = 4; NaN where the spectrum has no closed form for it.
using ClosedForm = std::function<double(int n)>;

struct Given {
  std::string name;
  std::shared_ptr<const Spectrum> spectrum;
  double tp = 0;           ///< s, where it is a parameter of the spectrum
  ClosedForm moment = {};  ///< empty: quadrature
};

template <class S>
std::shared_ptr<const Spectrum> shared(S spectrum) {
  return std::make_shared<const S>(std::move(spectrum));
}

// m_0 ω_p^n (p/4)^{n/4} Γ((p−1−n)/4)/Γ((p−1)/4): the shape u^−p e^{−(p/4) u^−4}.
double gamma_moment(double hs, double tp, double p, int n) {
  return hs * hs / 16 * std::pow(two_pi / tp, n) * std::pow(p / 4, n / 4.0) *
         std::exp(std::lgamma((p - 1 - n) / 4) - std::lgamma((p - 1) / 4));
}

ClosedForm gamma_form(double hs, double tp, double p) {
  return [=](int n) { return n < 4 ? gamma_moment(hs, tp, p, n) : std::nan(""); };
}

std::vector<Given> all_spectra() {
  const double hs = 3, tp = 9, sigma = 0.05, omega = two_pi / tp;
  const OchiHubblePart low{.hs_m = 2.4, .tp_s = 13, .lambda = 2.7}, high{.hs_m = 1.8, .tp_s = 6.5, .lambda = 1.3};
  const hydro::Water shelf{.depth = hydro::WaterDepth::from_metres(12)};
  const double developed = pierson_moskowitz_of_wind(15).tp();
  std::vector<Given> all{
      {"Pierson-Moskowitz", shared(pierson_moskowitz_of_wind(15)), developed,
       gamma_form(2 * std::sqrt(8.1e-3 / 0.74) * 225 / 9.81, developed, 5)},
      {"Bretschneider", shared(bretschneider(hs, PeakPeriod{tp})), tp, gamma_form(hs, tp, 5)},
      {"JONSWAP 3.3", shared(Jonswap(hs, tp, 3.3)), tp},
      {"JONSWAP 7", shared(Jonswap(hs, tp, 7)), tp},
      {"TMA, 12 m", shared(Tma(hs, tp, 3.3, shelf))},
      {"Ochi-Hubble", shared(ochi_hubble(low, high)), 0,
       [=](int n) {
         return n < 4 ? gamma_moment(low.hs_m, low.tp_s, 4 * low.lambda + 1, n) +
                            gamma_moment(high.hs_m, high.tp_s, 4 * high.lambda + 1, n)
                      : std::nan("");
       }},
      {"Torsethaugen, wind", shared(torsethaugen(hs, 7))},
      {"Torsethaugen, swell", shared(torsethaugen(hs, 13))},
      {"Wallops", shared(wallops(hs, tp)), tp, gamma_form(hs, tp, wallops_exponent(hs, tp))},
      {"Gaussian swell", shared(GaussianSwell(hs, tp, sigma)), tp,
       [=](int n) {
         const double m0 = hs * hs / 16, o2 = omega * omega, s2 = sigma * sigma;
         return m0 * (n == 0 ? 1 : n == 1 ? omega : n == 2 ? o2 + s2 : o2 * o2 + 6 * o2 * s2 + 3 * s2 * s2);
       }},
      {"wind sea and swell", shared(sum(Jonswap(2.5, 7, 2), GaussianSwell(1.66, 13, 0.03)))},
      // A triangle 0 → 1 → 0 over 0.4, 0.6, 1.2 rad/s: ∫ ω^n over each side.
      {"table", shared(TabulatedSpectrum({0.4, 0.6, 1.2}, {0, 1, 0})), two_pi / 0.6, [](int n) {
         const auto side = [n](double foot, double summit) {  // ∫ ω^n (ω − foot)/(summit − foot) from foot to summit
           const auto power = [](double x, int m) { return std::pow(x, m) / m; };
           return (power(summit, n + 2) - power(foot, n + 2) - foot * (power(summit, n + 1) - power(foot, n + 1))) /
                  (summit - foot);
         };
         return side(0.4, 0.6) - side(1.2, 0.6);
       }}};
  return all;
}

// ∫ ω^n S dω by Simpson's rule in x = ln ω, steps of 2e-4.
double plain_moment(const Spectrum& spectrum, int n, double from, double to) {
  const int intervals = 2 * static_cast<int>(std::ceil(std::log(to / from) / 4e-4));
  double sum = 0;
  for (int i = 0; i <= intervals; ++i) {
    const double omega = from * std::exp(std::log(to / from) * i / intervals);
    sum += (i == 0 || i == intervals ? 1 : i % 2 == 1 ? 4 : 2) * std::pow(omega, n + 1) * spectrum.density(omega);
  }
  return sum * std::log(to / from) / (3.0 * intervals);
}

// A part of a tail ω^−4 in m_2 falls as 1/ω only: e^24 leaves 1e-10.
double expected_moment(const Given& given, int n) {
  const double peak = given.spectrum->peak_omega();
  if (given.moment && std::isfinite(given.moment(n))) return given.moment(n);
  const double below = plain_moment(*given.spectrum, n, peak * std::exp(-4.0), top * peak);
  return n == 4 ? below : below + plain_moment(*given.spectrum, n, top * peak, peak * std::exp(24.0));
}

// Where the slope of ln S changes sign, near the peak that the spectrum names.
double expected_tp(const Given& given) {
  if (given.tp > 0) return given.tp;
  const auto slope = [&](double omega) {
    return given.spectrum->density(omega * (1 + 1e-5)) - given.spectrum->density(omega * (1 - 1e-5));
  };
  double low = 0.98 * given.spectrum->peak_omega(), high = 1.02 * given.spectrum->peak_omega();
  for (int step = 0; step < 60; ++step) (slope(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
  return two_pi / (0.5 * (low + high));
}

struct Worst {
  double moments = 0, heights = 0, tp = 0;
};

void compare(const Given& given, Worst& worst) {
  const Spectrum& s = *given.spectrum;
  const double m0 = expected_moment(given, 0), m1 = expected_moment(given, 1), m2 = expected_moment(given, 2);
  const double peak = s.peak_omega();
  const bool whole = std::isinf(s.tail_power());  // m_4 exists without a limit
  const double m4 = whole ? s.moment(4) : s.band_moment(4, 0, top * peak);
  for (const auto& [found, expected] : {std::pair{s.moment(0), m0}, std::pair{s.moment(1), m1},
                                        std::pair{s.moment(2), m2}, std::pair{m4, expected_moment(given, 4)}})
    worst.moments = std::max(worst.moments, std::abs(found / expected - 1));
  for (const auto& [found, expected] :
       {std::pair{s.hs(), 4 * std::sqrt(m0)}, std::pair{s.tz(), two_pi * std::sqrt(m0 / m2)}})
    worst.heights = std::max(worst.heights, std::abs(found / expected - 1));
  worst.tp = std::max(worst.tp, std::abs(s.tp() / expected_tp(given) - 1));
}

// A sea whose Δω is 2π/3600 s, up to 3000 waves.
Sea drawn_sea(const Spectrum& spectrum, std::uint64_t seed, Amplitudes amplitudes) {
  const Discretisation cut{FftGrid{3600}, 0.1, 5, seed, amplitudes};
  return Sea::irregular(spectrum, cut, {}, {});
}

// Mean square over one repetition of the sum of cosines, by an inverse FFT.
double variance_in_time(const Sea& sea) {
  constexpr std::size_t n = 7200;
  std::vector<std::complex<double>> half(n / 2 + 1);
  for (std::size_t i = 0; i < sea.components().size(); ++i)
    half[sea.grid_index()[i]] = std::polar(sea.components()[i].amplitude / 2, sea.components()[i].phase);
  double sum = 0;
  for (const double z : hydro::signal::inverse_real_fft(half, n)) sum += z * z;
  return sum / static_cast<double>(n);
}

double error_with_fixed_amplitudes(const std::vector<Given>& all) {
  double worst = 0;
  for (const Given& given : all)
    for (const std::uint64_t seed : {1, 2, 3}) {
      const Sea sea = drawn_sea(*given.spectrum, seed, Amplitudes::fixed);
      const double d = two_pi / 3600;
      const auto index = sea.grid_index();
      const double m0 = given.spectrum->energy((static_cast<double>(index.front()) - 0.5) * d,
                                               (static_cast<double>(index.back()) + 0.5) * d);
      worst = std::max(worst, std::abs(variance_in_time(sea) / m0 - 1));
    }
  return worst;
}

struct Scatter {
  double mean_off;  ///< in standard errors
  double ratio;     ///< standard deviation found over expected
};

// The energy of a bin is exponentially distributed: its variance is its mean squared.
Scatter scatter_of_200_seeds(const Spectrum& spectrum) {
  constexpr int seeds = 200;
  double m0 = 0, expected = 0;
  const Sea fixed = drawn_sea(spectrum, 1, Amplitudes::fixed);
  for (const Component& w : fixed.components()) {
    const double energy = w.amplitude * w.amplitude / 2;
    m0 += energy, expected += energy * energy;
  }
  double mean = 0, square = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const double v = variance_in_time(drawn_sea(spectrum, static_cast<std::uint64_t>(seed), Amplitudes::rayleigh));
    mean += v / seeds, square += (v - m0) * (v - m0) / seeds;
  }
  return {std::abs(mean - m0) / std::sqrt(expected / seeds), std::sqrt(square / expected)};
}

double error_of_spreading() {
  std::vector<std::shared_ptr<const Spreading>> all;
  for (const double s : {1.0, 10.0, 75.0})
    all.push_back(std::make_shared<Cos2sSpreading>(SpreadingExponent::constant(s)));
  all.push_back(std::make_shared<Cos2sSpreading>(SpreadingExponent::mitsuyasu(12, 0.8)));
  for (const double n : {2.0, 6.0}) all.push_back(std::make_shared<CosNSpreading>(n));
  all.push_back(std::make_shared<WrappedNormalSpreading>(Angle::from_degrees(25)));
  all.push_back(std::make_shared<VonMisesSpreading>(6));
  double worst = 0;
  for (const auto& spreading : all) {
    constexpr int n = 40'000;
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += spreading->density(Angle::from_radians(two_pi * (i + 0.5) / n), 0.8) / n;
    const double share = spreading->share_below(Angle::from_radians(std::numbers::pi), 0.8);
    worst = std::max({worst, std::abs(two_pi * sum - 1), std::abs(share - 1)});
  }
  return worst;
}

plot::Panel picture_of(const std::vector<Given>& all, plot::Scale scale) {
  plot::Panel panel{.x = {.label = "ω", .unit = "rad/s", .scale = scale},
                    .y = {.label = "S", .unit = "m^2 s/rad", .scale = scale},
                    .series = {}};
  if (scale == plot::Scale::logarithmic) panel.y.range = {{1e-6, 10}};
  for (const Given& given : all) {
    plot::Series line{.name = given.name, .x = {}, .y = {}};
    for (int i = 0; i <= 400; ++i) {
      const double omega = scale == plot::Scale::linear ? 0.2 + 1.6 * i / 400 : 0.2 * std::pow(50.0, i / 400.0);
      const double density = given.spectrum->density(omega);
      line.x.push_back(omega);
      line.y.push_back(scale == plot::Scale::logarithmic && density < 1e-6 ? std::nan("") : density);
    }
    panel.series.push_back(std::move(line));
  }
  return panel;
}

}  // namespace

Outcome outcome(const Folders&) {
  const std::vector<Given> all = all_spectra();
  Worst worst;
  for (const Given& given : all) compare(given, worst);
  const Scatter scatter = scatter_of_200_seeds(Jonswap(3, 9, 3.3));
  return {
      .numbers = {{"worst error of m0, m1, m2 and m4", worst.moments, ""},
                  {"worst error of Hs and Tz", worst.heights, ""},
                  {"worst error of Tp", worst.tp, ""},
                  {"fixed amplitudes: worst error of the variance over one repetition",
                   error_with_fixed_amplitudes(all), ""},
                  {"Rayleigh amplitudes: mean variance of 200 seeds off m0, in standard errors", scatter.mean_off, ""},
                  {"Rayleigh amplitudes: scatter of the variance over its expectation", scatter.ratio, ""},
                  {"spreading: worst error of the integral over all directions", error_of_spreading(), ""}},
      .pictures = {{"densities",
                    "All spectra of the library; most with Hs = 3 m and Tp = 9 s.",
                    {.title = "Wave spectra",
                     .panels = {picture_of(all, plot::Scale::linear), picture_of(all, plot::Scale::logarithmic)}}}}};
}

}  // namespace froude::validation::spectra
