// Distributions made for the circle, and tables.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydro/waves/spectra/spreading.hpp"
#include "spreading_checks.hpp"
#include "waves/gauss_legendre.hpp"

namespace hydro::waves {
namespace {

using std::numbers::pi;

// Φ(b) − Φ(a) for a <= b, taken on the side where both are small.
double normal_between(double a, double b) {
  if (a > 0) return 0.5 * (std::erfc(a / std::numbers::sqrt2) - std::erfc(b / std::numbers::sqrt2));
  return 0.5 * (std::erfc(-b / std::numbers::sqrt2) - std::erfc(-a / std::numbers::sqrt2));
}

// ∫_0^end f in panels of one standard deviation.
template <class F>
double on_panels(double end, double panel, const F& f) {
  static const GaussLegendre<16> rule;
  const int panels = std::max(1, static_cast<int>(std::ceil(end / panel)));
  double sum = 0;
  for (int i = 0; i < panels; ++i) sum += rule.integrate(f, end * i / panels, end * (i + 1) / panels);
  return sum;
}

}  // namespace

WrappedNormalSpreading::WrappedNormalSpreading(Angle sigma) : sigma_(sigma.radians()) {
  require(sigma_ >= 1e-4 && sigma_ <= 10,
          "the width of a wrapped normal spreading must be between 1e-4 and 10 rad, got {} rad", sigma_);
  turns_ = static_cast<int>(std::ceil((8.5 * sigma_ + pi) / (2 * pi)));  // Φ(−8.5) = 1e-17
}

// (W43)
double WrappedNormalSpreading::density(Angle from_mean, double omega) const {
  require_frequency(omega);
  const double theta = wrapped(from_mean);
  double sum = 0;
  for (int k = -turns_; k <= turns_; ++k) {
    const double x = (theta + 2 * pi * k) / sigma_;
    sum += std::exp(-x * x / 2);
  }
  return sum / (sigma_ * std::sqrt(2 * pi));
}

double WrappedNormalSpreading::share_below(Angle from_mean, double omega) const {
  require_frequency(omega);
  const double theta = angle_in_turn(from_mean);
  double sum = 0;
  for (int k = -turns_; k <= turns_; ++k)
    sum += normal_between((-pi + 2 * pi * k) / sigma_, (theta + 2 * pi * k) / sigma_);
  return std::clamp(sum, 0.0, 1.0);  // rounding
}

double WrappedNormalSpreading::first_harmonic(double omega) const {
  require_frequency(omega);
  return std::exp(-sigma_ * sigma_ / 2);
}

VonMisesSpreading::VonMisesSpreading(double kappa) : kappa_(kappa) {
  require(kappa >= 0 && kappa <= 1e8,
          "the concentration kappa of von Mises spreading must be between 0 and 1e8, got {}", kappa);
  panel_ = std::min(0.5, 1 / std::sqrt(kappa));
  reach_ = kappa > 22.5 ? 2 * std::asin(std::sqrt(22.5 / kappa)) : pi;  // beyond, e^{κ (cos θ − 1)} < e^{−45} = 3e-20
  whole_ = 2 * from_zero(pi);
}

// (W44): cos t − 1 = −2 sin²(t/2) keeps its digits for small t.
double VonMisesSpreading::from_zero(double theta) const {
  return on_panels(std::min(theta, reach_), panel_, [&](double t) {
    const double s = std::sin(t / 2);
    return std::exp(-2 * kappa_ * s * s);
  });
}

// 1 − r_1 = ∫ D (1 − cos θ), so that a narrow distribution's width keeps its digits.
double VonMisesSpreading::first_harmonic(double omega) const {
  require_frequency(omega);
  const double missing = on_panels(reach_, panel_, [&](double t) {
    const double s = std::sin(t / 2);
    return 2 * s * s * std::exp(-2 * kappa_ * s * s);
  });
  return 1 - 2 * missing / whole_;
}

double VonMisesSpreading::density(Angle from_mean, double omega) const {
  require_frequency(omega);
  const double s = std::sin(wrapped(from_mean) / 2);
  return std::exp(-2 * kappa_ * s * s) / whole_;
}

double VonMisesSpreading::share_below(Angle from_mean, double omega) const {
  require_frequency(omega);
  const double theta = angle_in_turn(from_mean);
  const double side = from_zero(std::abs(theta)) / whole_;
  return theta < 0 ? 0.5 - side : 0.5 + side;
}

// (W45)
TabulatedSpreading::TabulatedSpreading(std::vector<double> theta, std::vector<double> density)
    : theta_(std::move(theta)), density_(std::move(density)) {
  require(theta_.size() == density_.size(),
          "a table of a spreading function needs a density for each angle, got {} and {}", density_.size(),
          theta_.size());
  require(theta_.size() >= 2, "a table of a spreading function needs two points at least, got {}", theta_.size());
  share_.push_back(0);
  for (std::size_t i = 0; i < theta_.size(); ++i) {
    require(std::abs(theta_[i]) <= pi * (1 + 1e-15), "angle {} of a spreading function must lie within ±π, got {} rad",
            i + 1, theta_[i]);
    require(i == 0 || theta_[i] > theta_[i - 1],
            "angles of a spreading function must increase, got {} rad (point {}) after {} rad", theta_[i], i + 1,
            i == 0 ? 0.0 : theta_[i - 1]);
    require(std::isfinite(density_[i]) && density_[i] >= 0,
            "density {} of a spreading function must be finite and >= 0, got {} 1/rad", i + 1, density_[i]);
    if (i > 0) share_.push_back(share_.back() + 0.5 * (theta_[i] - theta_[i - 1]) * (density_[i] + density_[i - 1]));
  }
  raw_integral_ = share_.back();
  if (!(std::abs(raw_integral_ - 1) <= 1e-3))
    throw InputError(
        fmt::format("a spreading function must integrate to 1 over all directions, this table gives {:.6g} ({:+.3g} "
                    "off, 0.001 is allowed)",
                    raw_integral_, raw_integral_ - 1),
        {}, "check that densities are per radian, and that the table covers all directions that have energy");
  for (double& d : density_) d /= raw_integral_;
  for (double& s : share_) s /= raw_integral_;
}

double TabulatedSpreading::density(Angle from_mean, double omega) const {
  require_frequency(omega);
  const double theta = wrapped(from_mean);
  if (theta < theta_.front() || theta > theta_.back()) return 0;
  const auto above = std::upper_bound(theta_.begin() + 1, theta_.end() - 1, theta) - theta_.begin();
  const auto i = static_cast<std::size_t>(above);
  const double t = (theta - theta_[i - 1]) / (theta_[i] - theta_[i - 1]);
  return density_[i - 1] * (1 - t) + density_[i] * t;
}

double TabulatedSpreading::share_below(Angle from_mean, double omega) const {
  require_frequency(omega);
  const double theta = std::clamp(angle_in_turn(from_mean), theta_.front(), theta_.back());
  const auto above = std::upper_bound(theta_.begin() + 1, theta_.end() - 1, theta) - theta_.begin();
  const auto i = static_cast<std::size_t>(above);
  const double width = theta_[i] - theta_[i - 1], t = (theta - theta_[i - 1]) / width;
  return share_[i - 1] + width * t * (density_[i - 1] * (1 - t / 2) + density_[i] * t / 2);
}

// ∫ (d_0 + slope (θ − θ_0)) e^{iθ} dθ, line by line; 16 points are exact to rounding for lines up to 2π long.
double TabulatedSpreading::first_harmonic(double omega) const {
  require_frequency(omega);
  static const GaussLegendre<16> rule;
  double x = 0, y = 0;
  for (std::size_t i = 1; i < theta_.size(); ++i) {
    const double from = theta_[i - 1], to = theta_[i], slope = (density_[i] - density_[i - 1]) / (to - from);
    const auto line = [&](double theta) { return density_[i - 1] + slope * (theta - from); };
    x += rule.integrate([&](double t) { return line(t) * std::cos(t); }, from, to);
    y += rule.integrate([&](double t) { return line(t) * std::sin(t); }, from, to);
  }
  return std::hypot(x, y);
}

}  // namespace hydro::waves
