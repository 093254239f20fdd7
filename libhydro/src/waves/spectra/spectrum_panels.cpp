#include <algorithm>
#include <cmath>
#include <limits>

#include "hydro/waves/spectra/spectrum.hpp"
#include "spectrum_shapes.hpp"
#include "waves/gauss_legendre.hpp"

namespace hydro::waves {
namespace {

const GaussLegendre<16>& rule() {
  static const GaussLegendre<16> points;
  return points;
}

double integer_power(double u, int n) {
  double power = 1;
  for (int i = 0; i < std::abs(n); ++i) power *= u;
  return n < 0 ? 1 / power : power;
}

// ∫ u^m du for any real m; `to` may be infinite for m < −1. As a ratio, so that a narrow band keeps its digits.
double power_integral(double m, double from, double to) {
  if (std::isinf(to)) return -std::pow(from, m + 1) / (m + 1);
  const double log_ratio = std::log1p((to - from) / from);
  return m == -1 ? log_ratio : std::pow(from, m + 1) * std::expm1((m + 1) * log_ratio) / (m + 1);
}

}  // namespace

void PanelSpectrum::tabulate(std::vector<double> edges, std::optional<Tail> tail) {
  ensure(edges.size() >= 2 && std::is_sorted(edges.begin(), edges.end()), "panel edges of a spectrum increase");
  edges_ = std::move(edges);
  tail_ = tail;
  for (int n = -1; n <= 4; ++n) {
    auto& values = panels_[static_cast<std::size_t>(n + 1)];
    values.clear();
    for (std::size_t i = 0; i + 1 < edges_.size(); ++i) values.push_back(piece(n, edges_[i], edges_[i + 1]));
  }
}

void PanelSpectrum::set_variance(double m0) {
  scale_ = 1;
  scale_ = m0 / band_moment(0, 0, std::numeric_limits<double>::infinity());
}

double PanelSpectrum::tail_power() const { return tail_ ? tail_->p : std::numeric_limits<double>::infinity(); }

double PanelSpectrum::density(double omega) const {
  require(std::isfinite(omega) && omega >= 0, "a one-sided spectrum needs a frequency >= 0, got {} rad/s", omega);
  if (omega == 0 || omega < edges_.front()) return 0;
  const double u = omega / unit_;
  if (omega <= edges_.back()) return scale_ / unit_ * shape(u);
  if (!tail_) return 0;
  return scale_ / unit_ * tail_->coefficient * std::pow(u, -tail_->p) * std::exp(-tail_->w * std::pow(u, -tail_->q));
}

// ∫ u^n shape du within one panel. The points are placed in ω: from − to is then exact for neighbouring frequencies,
// which it would not be after two divisions by the unit.
double PanelSpectrum::piece(int n, double from, double to) const {
  return rule().integrate(
             [&](double omega) {
               const double u = omega / unit_;
               return integer_power(u, n) * shape(u);
             },
             from, to) /
         unit_;
}

// (W31): two broken panels and the whole ones between them.
double PanelSpectrum::on_panels(int n, double from, double to) const {
  const double low = std::max(from, edges_.front()), high = std::min(to, edges_.back());
  if (!(low < high)) return 0;
  const auto panel_of = [&](double omega) {  // edges_[i] <= omega < edges_[i + 1]
    return static_cast<std::size_t>(std::upper_bound(edges_.begin(), edges_.end(), omega) - edges_.begin()) - 1;
  };
  const std::size_t first = panel_of(low);
  const std::size_t last = std::min(panel_of(high), edges_.size() - 2);
  if (first == last) return piece(n, low, high);
  double sum = piece(n, low, edges_[first + 1]);
  for (std::size_t i = first + 1; i < last; ++i)
    sum += n < tabulated_orders - 1 ? panels_[static_cast<std::size_t>(n + 1)][i] : piece(n, edges_[i], edges_[i + 1]);
  return sum + piece(n, edges_[last], high);
}

// (W31): the exponential's series, integrated term by term; after seven terms the next is below 1e-3^7/7! = 2e-25.
double PanelSpectrum::in_tail(int n, double from, double to) const {
  const double low = std::max(from, edges_.back());
  if (!tail_ || !(low < to)) return 0;
  double sum = 0, factor = tail_->coefficient;
  for (int term = 0; term < 7; factor *= -tail_->w / ++term) {
    if (factor == 0) break;
    sum += factor * power_integral(n - tail_->p - tail_->q * term, low / unit_, to / unit_);
  }
  return sum;
}

double PanelSpectrum::band_moment(int n, double from, double to) const {
  require(n >= -1, "moments of a spectrum are taken for n >= -1, got {}", n);
  require(from >= 0 && from <= to && std::isfinite(from), "a band needs 0 <= from <= to, got {} and {} rad/s", from,
          to);
  require(std::isfinite(to) || n < tail_power() - 1, "moment m_{} of a spectrum with an omega^-{} tail is infinite", n,
          tail_power());
  if (n < 0 && from == 0 && edges_.front() == 0)
    require(shape(0) == 0, "moment m_-1 is infinite: the spectrum has a density of {} m^2 s/rad down to zero frequency",
            scale_ / unit_ * shape(0));
  return scale_ * integer_power(unit_, n) * (on_panels(n, from, to) + in_tail(n, from, to));
}

}  // namespace hydro::waves
