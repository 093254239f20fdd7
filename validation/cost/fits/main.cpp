/// \file  What fits cost, on the very problems of scipy_fits.py. See README.md.
#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>

#include "fit/decay.hpp"
#include "fit/morison.hpp"
#include "fit/robust.hpp"
#include "support/morison_records.hpp"

namespace {

using Clock = std::chrono::steady_clock;
constexpr int samples = 20000, fits = 100;

/// Least of five runs, s.
double best_of(const std::function<void()>& work) {
  double best = 1e9;
  for (int i = 0; i < 5; ++i) {
    const auto start = Clock::now();
    work();
    best = std::min(best, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return best;
}

const fit::Cylinder& cylinder = froude_test::held_cylinder;

/// Twenty periods of 4 s, C_D = 1.2, C_M = 1.8, noise of 3 N with a memory.
fit::ForceRecord record() { return froude_test::swinging_water(samples, 0.004, 0.9, 1); }

void forces() {
  const auto r = record();
  Eigen::MatrixXd columns(samples, 2);
  Eigen::VectorXd force(samples);
  for (Eigen::Index j = 0; j < samples; ++j) {
    const auto i = static_cast<std::size_t>(j);
    columns(j, 0) = 0.5 * 997 * 0.06 * std::abs(r.velocity[i]) * r.velocity[i];
    columns(j, 1) = 997 * cylinder.volume() * r.acceleration[i];
    force[j] = r.force[i];
  }
  const Eigen::Vector2d exact = columns.colPivHouseholderQr().solve(force);
  Eigen::VectorXd x(2);
  double wrong = 0;
  const double linear = best_of([&] {
    for (int k = 0; k < fits; ++k) {
      const auto problem = fit::compress(columns, force);
      x = problem.columns.triangularView<Eigen::Upper>().solve(problem.target);
    }
  });
  wrong = std::max(wrong, (x - exact).norm());
  const double searched = best_of([&] {
    for (int k = 0; k < fits; ++k) {
      x.setZero();
      fit::minimise(fit::linear_model(fit::compress(columns, force), {{"cd", 1}, {"cm", 1}}, 1), x);
    }
  });
  wrong = std::max(wrong, (x - exact).norm());
  const double robust = best_of([&] {
    for (int k = 0; k < fits; ++k) x = fit::fit_huber(columns, force).x;
  });
  const double whole = best_of([&] {
    for (int k = 0; k < fits; ++k) x[0] = *fit::fit_morison(cylinder, r).cd.value;
  });
  fmt::print("{} fits of {} samples, s; largest difference from Householder {:.1e}\n", fits, samples, wrong);
  fmt::print("linear least squares               {:.4f}\n", linear);
  fmt::print("the same by Levenberg-Marquardt    {:.4f}\n", searched);
  fmt::print("robust (Huber)                     {:.4f}\n", robust);
  fmt::print("whole fit with honest intervals    {:.4f}\n", whole);
}

void motions() {
  fit::Window w{0.1, fit::follow(fit::MotionLaw::oscillator, std::vector{0.98, 0.02, 0.6, 0.0, 0.0, 0.0},
                                 Eigen::Vector2d(0.15, 0), 0.1, 900, 8)};
  const auto noise = froude_test::ar1_noise(900, 0.7, 0.001, 2);
  for (Eigen::Index j = 0; j < 900; ++j) w.values(j, 0) += noise[static_cast<std::size_t>(j)];
  const std::vector<fit::Window> records{w};
  double b2 = 0;
  const double time = best_of([&] { b2 = *fit::fit_decay(records, {.substeps = 1}).damping[1].value; });
  fmt::print("one decay of 900 samples by shooting {:.5f} (quadratic damping {:.4f})\n", time, b2);
}

}  // namespace

int main() {
  forces();
  motions();
}
