/// \file  What a step of radiation memory costs by each method, with its error beside it. See README.md.
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include "hydro/base/random.hpp"
#include "hydro/radiation/convolution.hpp"
#include "hydro/radiation/partitioned.hpp"
#include "hydro/radiation/pole_memory.hpp"

namespace {

using namespace hydro::radiation;
using Clock = std::chrono::steady_clock;

constexpr double step = 0.05;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Forty states a mode, what the arrays at hand need for a percent; passive term by term (R9).
PoleModel model(int modes) {
  const hydro::RandomStream random(1, 1);
  std::uint64_t next = 0;
  PoleModel m;
  for (int k = 0; k < 20; ++k) {
    const double b = 0.3 + 0.18 * k, a = 0.05 + 0.4 * random.uniform(next++);
    Eigen::MatrixXd V(modes, std::max(1, modes / 3));
    for (auto& v : V.reshaped()) v = random.normal(next++);
    const Eigen::MatrixXd W = V * V.transpose();
    m.poles.push_back({a, b});
    m.C.push_back(W);
    m.S.push_back(-a / b * W);
  }
  return m;
}

Eigen::VectorXd velocity(int modes, std::uint64_t i) {
  Eigen::VectorXd v(modes);
  for (int m = 0; m < modes; ++m)
    v[m] = std::sin(0.9 * step * static_cast<double>(i) + m) +
           std::cos(0.41 * step * static_cast<double>(i) * (1 + 0.1 * m));
  return v;
}

/// The history force in extended precision at step `now`.
Eigen::VectorXd exact(const std::vector<Eigen::MatrixXd>& K, int modes, std::uint64_t now) {
  Eigen::Matrix<long double, Eigen::Dynamic, 1> sum = Eigen::Matrix<long double, Eigen::Dynamic, 1>::Zero(modes);
  for (std::size_t l = 1; l < K.size() && l <= now; ++l) {
    const auto i = now - l;
    const Eigen::Matrix<long double, Eigen::Dynamic, 1> v = velocity(modes, i).cast<long double>();
    sum += (i == 0 ? 0.5L : 1.0L) * (K[l].cast<long double>() * v);
  }
  return (static_cast<long double>(step) * sum).cast<double>();
}

struct Measured {
  double mean_us = 0, worst_us = 0, error = 0;
};

/// Mean and worst cost of a step after `warm` of them, error of the last one relative to the exact sum.
Measured measure(const MemoryMethod& method, const std::vector<Eigen::MatrixXd>& K, std::uint64_t warm,
                 std::uint64_t steps) {
  const int modes = method.modes();
  const auto state = method.start(velocity(modes, 0));
  Measured out;
  double total = 0;
  Eigen::VectorXd last;
  for (std::uint64_t i = 1; i < warm + steps; ++i) {
    const Eigen::VectorXd v = velocity(modes, i);
    const auto start = Clock::now();
    state->accept(v);
    last = state->history_force(1);
    const double took = seconds_since(start);
    if (i < warm) continue;
    total += took;
    out.worst_us = std::max(out.worst_us, 1e6 * took);
  }
  out.mean_us = 1e6 * total / static_cast<double>(steps);
  const Eigen::VectorXd now = velocity(modes, warm + steps);
  const Eigen::VectorXd expected = exact(K, modes, warm + steps) + step / 2 * (K.front() * now);
  out.error = (last + method.instantaneous(1) * now - expected).norm() / expected.norm();
  return out;
}

void row(const char* name, int bodies, std::size_t lags, const Measured& m, double build_s, double megabytes,
         double direct_us) {
  fmt::print("{},{},{},{:.2f},{:.1f},{:.1e},{:.3f},{:.1f},{:.1f}\n", name, bodies, lags, m.mean_us, m.worst_us, m.error,
             build_s, megabytes, direct_us / m.mean_us);
  std::fflush(stdout);
}

void cell(int bodies, std::size_t lags) {
  const int modes = 6 * bodies;
  const PoleModel poles = model(modes);
  std::vector<Eigen::MatrixXd> K;
  for (std::size_t l = 0; l <= lags; ++l) K.push_back(poles.kernel(step * static_cast<double>(l)));
  const auto kernel = RetardationKernel::from_samples(K, step);
  const double numbers = modes * (modes + 1) / 2.0 * static_cast<double>(lags);
  const auto steps = static_cast<std::uint64_t>(std::clamp(2e9 / numbers, 64.0, 4096.0));
  double direct_us = 0;
  {
    const auto start = Clock::now();
    const DirectConvolution direct(kernel);
    const double build = seconds_since(start);
    const Measured m = measure(direct, K, 32, steps);
    direct_us = m.mean_us;
    row("direct", bodies, lags, m, build, 8e-6 * numbers, direct_us);
  }
  const double spectra = 32e-6 * modes * modes * static_cast<double>(lags);
  if (spectra < 4000) {
    const auto start = Clock::now();
    const PartitionedConvolution partitioned(kernel);
    const double build = seconds_since(start);
    // Whole turns of the longest part, so that the mean holds.
    row("partitioned", bodies, lags, measure(partitioned, K, 32, modes > 60 ? 2048 : 8192), build, spectra, direct_us);
  }
  const auto start = Clock::now();
  const PoleMemory memory(poles, step);
  const double build = seconds_since(start);
  row("poles", bodies, lags, measure(memory, K, 32, 4096), build, 8e-6 * modes * modes * poles.order(), direct_us);
}

}  // namespace

int main() {
  fmt::print("method,bodies,lags,mean [us],worst [us],error [-],build [s],memory [MB],direct over this [-]\n");
  for (const int bodies : {1, 3, 5})
    for (const std::size_t lags : {500u, 2000u, 6000u, 10000u}) cell(bodies, lags);
  for (const std::size_t lags : {500u, 2000u}) cell(25, lags);
}
