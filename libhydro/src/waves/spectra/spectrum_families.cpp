// The named members of the peaked family and the periods that they are asked for.
#include <cmath>
#include <numbers>

#include "hydro/waves/spectra/spectra.hpp"
#include "spectrum_shapes.hpp"

namespace hydro::waves {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;  // clang 14 does not deduce for aggregates

void require_gravity(double gravity) {
  require(std::isfinite(gravity) && gravity > 0, "gravity must be finite and positive, got {} m/s^2", gravity);
}

double seconds(const SeaPeriod& period) {
  const double s = std::visit([](const auto& which) { return which.s; }, period);
  require(std::isfinite(s) && s > 0, "a period of a sea must be finite and positive, got {} s", s);
  return s;
}

// (W32): the period of a sea of this shape whose Tp is 1.
double period_for_unit_peak(const SeaPeriod& period, const PeakShape& shape) {
  if (std::holds_alternative<PeakPeriod>(period)) return 1;
  const PeakedSpectrum unit_sea(4, 1, shape);
  return std::visit(
      Overloaded{[](const PeakPeriod&) { return 1.0; }, [&](const ZeroCrossingPeriod&) { return unit_sea.tz(); },
                 [&](const MeanPeriod&) { return unit_sea.mean_period(); },
                 [&](const EnergyPeriod&) { return unit_sea.energy_period(); }},
      period);
}

}  // namespace

double peak_period_s(const SeaPeriod& period, const PeakShape& shape) {
  return seconds(period) / period_for_unit_peak(period, shape);
}

PeakedSpectrum bretschneider(double hs_m, const SeaPeriod& period) {
  const PeakShape shape{.p = 5, .q = 4, .gamma = 1};
  return {hs_m, peak_period_s(period, shape), shape};
}

Jonswap jonswap(double hs_m, const SeaPeriod& period, double gamma) {
  return {hs_m, peak_period_s(period, {.p = 5, .q = 4, .gamma = gamma}), gamma};
}

double dnv_gamma(double hs_m, double tp_s) {
  require_sea(hs_m, tp_s);
  const double steepness = tp_s / std::sqrt(hs_m);
  if (steepness >= 5) return 1;  // the formula gives e^0 there
  // The formula gives 5.003 at 3.6, where the rule changes to 5: the lesser of the two does not jump.
  return std::min(5.0, std::exp(5.75 - 1.15 * steepness));
}

// (W34): T(Tp) = Tp · ratio(γ(Hs, Tp)) rises with Tp, since the ratio falls by 15 % while Tp grows by 40 %. The ratios
// of all periods to Tp lie between 0.7 and 1.
Jonswap jonswap_dnv(double hs_m, const SeaPeriod& period) {
  const double wanted = seconds(period);
  const auto of_sea = [&](double tp) {
    return tp * period_for_unit_peak(period, {.p = 5, .q = 4, .gamma = dnv_gamma(hs_m, tp)});
  };
  double low = wanted, high = wanted / 0.7;
  while (high - low > 4e-16 * high) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (of_sea(middle) < wanted ? low : high) = middle;
  }
  const double tp = std::holds_alternative<PeakPeriod>(period) ? wanted : 0.5 * (low + high);
  return {hs_m, tp, dnv_gamma(hs_m, tp)};
}

double jonswap_gamma(PeakPeriod peak, ZeroCrossingPeriod crossing) {
  require(std::isfinite(peak.s) && peak.s > 0 && std::isfinite(crossing.s) && crossing.s > 0,
          "periods of a sea must be finite and positive, got Tp = {} s and Tz = {} s", peak.s, crossing.s);
  const auto ratio = [&](double gamma) { return period_for_unit_peak(crossing, {.p = 5, .q = 4, .gamma = gamma}); };
  const double wanted = crossing.s / peak.s;
  double low = 1, high = 20;
  require(wanted >= ratio(low) && wanted <= ratio(high),
          "Tz/Tp of JONSWAP lies between {:.5f} (gamma = 1) and {:.5f} (gamma = 20), got {:.5f} s / {:.5f} s = {:.5f}",
          ratio(low), ratio(high), crossing.s, peak.s, wanted);
  while (high - low > 4e-16 * high) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (ratio(middle) < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// (W33): e^{−0.74 (g/Uω)^4} = e^{−5/4 (ω_p/ω)^4} and m_0 = α g²/(4 · 0.74 (g/U)^4).
Jonswap pierson_moskowitz_of_wind(double u_19_5, double gravity) {
  require(std::isfinite(u_19_5) && u_19_5 > 0, "wind speed must be finite and positive, got {} m/s", u_19_5);
  require_gravity(gravity);
  const double omega_p = std::pow(0.74 / 1.25, 0.25) * gravity / u_19_5;
  const double hs = 2 * std::sqrt(8.1e-3 / 0.74) * u_19_5 * u_19_5 / gravity;
  return pierson_moskowitz(hs, two_pi / omega_p);
}

double wind_of_pierson_moskowitz(double hs_m, double gravity) {
  require_sea(hs_m, 1);
  require_gravity(gravity);
  return std::sqrt(hs_m * gravity / (2 * std::sqrt(8.1e-3 / 0.74)));
}

double wallops_exponent(double hs_m, double tp_s, double gravity) {
  require_sea(hs_m, tp_s);
  require_gravity(gravity);
  const double steepness = hs_m / 4 / (gravity * tp_s * tp_s / two_pi);
  return std::abs(std::log(2 * std::numbers::pi * std::numbers::pi * steepness * steepness)) / std::numbers::ln2;
}

// (W37)
PeakedSpectrum wallops(double hs_m, double tp_s, double gravity) {
  const double n = wallops_exponent(hs_m, tp_s, gravity);
  require(n >= 3.05 && n <= 60,
          "a Wallops spectrum needs an exponent between 3.05 and 60, got {:.3f} from Hs = {} m and Tp = {} s", n, hs_m,
          tp_s);
  return {hs_m, tp_s, {.p = n, .q = 4, .gamma = 1}};
}

}  // namespace hydro::waves
