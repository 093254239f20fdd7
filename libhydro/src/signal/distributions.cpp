#include "hydro/signal/distributions.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "hydro/base/error.hpp"

namespace hydro::signal {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double tiny = 1e-300;  // stands for a zero denominator in Lentz's method
constexpr int max_terms = 100000;

[[noreturn]] void did_not_converge(const char* what) {
  throw NumericsError(fmt::format("{} did not converge in {} terms", what, max_terms));
}

// P by its power series, quick for x < a + 1 (Abramowitz & Stegun 6.5.29).
double gamma_series(double a, double x) {
  double term = 1 / a, sum = term;
  for (int n = 1; n < max_terms; ++n) {
    term *= x / (a + n);
    sum += term;
    if (term < sum * epsilon / 4) return sum * std::exp(-x + a * std::log(x) - std::lgamma(a));
  }
  did_not_converge("the series of the incomplete gamma function");
}

// 1 − P by its continued fraction, even part, quick for x > a + 1 (Abramowitz & Stegun 6.5.31), modified Lentz.
double gamma_fraction(double a, double x) {
  double b = x + 1 - a, c = 1 / tiny, d = 1 / b, value = d;
  for (int n = 1; n < max_terms; ++n) {
    const double numerator = -n * (n - a);
    b += 2;
    d = numerator * d + b;
    if (std::abs(d) < tiny) d = tiny;
    c = b + numerator / c;
    if (std::abs(c) < tiny) c = tiny;
    d = 1 / d;
    value *= d * c;
    if (std::abs(d * c - 1) < epsilon) return value * std::exp(-x + a * std::log(x) - std::lgamma(a));
  }
  did_not_converge("the continued fraction of the incomplete gamma function");
}

// The continued fraction of I_x(a, b) without its leading factor (Abramowitz & Stegun 26.5.8), modified Lentz.
double beta_fraction(double a, double b, double x) {
  double c = 1, d = 1 - (a + b) * x / (a + 1);
  if (std::abs(d) < tiny) d = tiny;
  d = 1 / d;
  double value = d;
  const auto step = [&](double numerator) {
    d = 1 + numerator * d;
    if (std::abs(d) < tiny) d = tiny;
    c = 1 + numerator / c;
    if (std::abs(c) < tiny) c = tiny;
    d = 1 / d;
    value *= d * c;
    return std::abs(d * c - 1);
  };
  for (int m = 1; m < max_terms; ++m) {
    step(m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)));
    if (step(-(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))) < epsilon) return value;
  }
  did_not_converge("the continued fraction of the incomplete beta function");
}

// The root of an increasing function between two bounds: Newton, and bisection wherever Newton leaves the bracket.
template <class Function, class Slope>
double increasing_root(Function f, Slope slope, double low, double high, double start) {
  double x = start;
  for (int i = 0; i < 300; ++i) {
    const double value = f(x);
    (value < 0 ? low : high) = x;
    double next = x - value / slope(x);
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (std::abs(next - x) <= 4 * epsilon * std::abs(next) || high - low <= 4 * epsilon * std::abs(high)) return next;
    x = next;
  }
  return x;
}

void require_probability(double p) { require(p > 0 && p < 1, "a probability must lie between 0 and 1, got {}", p); }
void require_dof(double dof) {
  require(std::isfinite(dof) && dof > 0, "degrees of freedom must be positive, got {}", dof);
}

}  // namespace

double incomplete_gamma(double a, double x) {
  require(std::isfinite(a) && a > 0 && std::isfinite(x) && x >= 0,
          "the incomplete gamma function needs a > 0 and x >= 0, got a = {}, x = {}", a, x);
  if (x == 0) return 0;
  return x < a + 1 ? gamma_series(a, x) : 1 - gamma_fraction(a, x);
}

double incomplete_beta(double a, double b, double x) {
  require(a > 0 && b > 0 && x >= 0 && x <= 1,
          "the incomplete beta function needs a, b > 0 and 0 <= x <= 1, got a = {}, b = {}, x = {}", a, b, x);
  if (x == 0 || x == 1) return x;
  const double factor =
      std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
  // The fraction converges fast on the side of the mean only; I_x(a, b) = 1 − I_{1−x}(b, a) leads there.
  if (x < (a + 1) / (a + b + 2)) return factor * beta_fraction(a, b, x) / a;
  return 1 - factor * beta_fraction(b, a, 1 - x) / b;
}

double normal_quantile(double p) {
  require_probability(p);
  const auto cdf = [&](double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2) - p; };
  const auto density = [](double z) { return std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi); };
  return p == 0.5 ? 0.0 : increasing_root(cdf, density, -40.0, 40.0, 0.0);
}

double chi_square_quantile(double p, double dof) {
  require_probability(p);
  require_dof(dof);
  const double a = dof / 2;
  // Wilson & Hilferty's cube (1931) as the start only; its own error would be some per cent at small ν.
  const double h = 2 / (9 * dof);
  const double root = 1 - h + normal_quantile(p) * std::sqrt(h);
  double high = dof + 10;
  while (incomplete_gamma(a, high / 2) < p) high *= 2;
  const double start = root > 0 ? dof * root * root * root : high / 4;
  const auto cdf = [&](double x) { return incomplete_gamma(a, x / 2) - p; };
  const auto density = [&](double x) { return 0.5 * std::exp((a - 1) * std::log(x / 2) - x / 2 - std::lgamma(a)); };
  return increasing_root(cdf, density, 0.0, high, std::min(start, high / 2));
}

double student_t_quantile(double p, double dof) {
  require_probability(p);
  require_dof(dof);
  if (p == 0.5) return 0;
  if (p < 0.5) return -student_t_quantile(1 - p, dof);
  // P(T < t) = 1 − ½ I_{ν/(ν+t²)}(ν/2, ½) for t > 0 (Abramowitz & Stegun 26.7.1).
  const auto cdf = [&](double t) { return 1 - 0.5 * incomplete_beta(dof / 2, 0.5, dof / (dof + t * t)) - p; };
  const double scale = std::exp(std::lgamma((dof + 1) / 2) - std::lgamma(dof / 2)) / std::sqrt(dof * std::numbers::pi);
  const auto density = [&](double t) { return scale * std::exp(-(dof + 1) / 2 * std::log1p(t * t / dof)); };
  double high = 10;
  while (cdf(high) < 0) high *= 2;
  return increasing_root(cdf, density, 0.0, high, std::min(normal_quantile(p), high / 2));
}

}  // namespace hydro::signal
