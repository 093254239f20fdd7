#include "spectrum_shapes.hpp"

namespace hydro::waves {
namespace {

constexpr double peak_reach = 10;  // in σ: beyond, r < 2e-22

// Edges are `step` apart in ln u at most, and the exponent (p/q) u^−q changes by 10 at most from one to the next.
double next_edge(double u, double w, double q, double step) {
  const double v = w * std::pow(u, -q);
  const double by_exponent = v > 11 ? std::pow(w / (v - 10), 1 / q) : u * std::exp(step);
  return std::min(by_exponent, u * std::exp(step));
}

}  // namespace

void require_sea(double hs_m, double tp_s) {
  require(std::isfinite(hs_m) && hs_m > 0, "significant wave height must be finite and positive, got {} m", hs_m);
  require(std::isfinite(tp_s) && tp_s > 0, "peak period must be finite and positive, got {} s", tp_s);
}

void require_shape(const PeakShape& shape) {
  require(shape.p >= 1.5 && shape.p <= 60, "the tail power p of a spectrum must be between 1.5 and 60, got {}",
          shape.p);
  require(shape.q >= 1 && shape.q <= 20, "the cut-off power q of a spectrum must be between 1 and 20, got {}", shape.q);
  require(shape.gamma >= 1 && shape.gamma <= 20, "peak enhancement gamma of JONSWAP must be between 1 and 20, got {}",
          shape.gamma);
  for (const double sigma : {shape.sigma_below, shape.sigma_above})
    require(sigma >= 0.01 && sigma <= 1,
            "the width sigma of a peak must be between 0.01 and 1 of its frequency, got {}", sigma);
}

// (W30). One exponential for both factors, or u^-p would overflow where e^… underflows.
double peaked_value(const PeakShape& shape, double u) {
  double exponent = -shape.p * std::log(u) - shape.p / shape.q * std::pow(u, -shape.q);
  if (shape.gamma > 1) {
    const double x = (u - 1) / (u <= 1 ? shape.sigma_below : shape.sigma_above);
    exponent += std::log(shape.gamma) * std::exp(-x * x / 2);
  }
  return std::exp(exponent);
}

std::vector<double> peaked_edges(const PeakShape& shape, double omega_p) {
  const double w = shape.p / shape.q, step = std::min(0.2, 4 / shape.p);
  const double peak_from = 1 - peak_reach * shape.sigma_below, peak_to = 1 + peak_reach * shape.sigma_above;
  const double last = std::max(peak_to, std::pow(1e3 * w, 1 / shape.q));
  std::vector<double> edges;
  double u = std::pow((300 + w) / w, -1 / shape.q);  // e^{−300} of the peak's e^{−w}
  while (u < last) {
    edges.push_back(omega_p * u);
    double next = std::min(next_edge(u, w, shape.q, step), last);
    if (shape.gamma > 1 && u < peak_to) {
      // σ wide where γ^r counts; both ends of that stretch are edges.
      const double sigma = u < 1 ? shape.sigma_below : shape.sigma_above;
      next = std::min(next, u < peak_from ? peak_from : u + sigma);
    }
    if (u < 1 && next > 1 - 1e-9) next = 1;  // the kink of r
    u = next;
  }
  edges.push_back(omega_p * last);
  return edges;
}

}  // namespace hydro::waves
