/// \file  What fits cost, on the very problems of scipy_fits.py. See README.md.
///
///   cost_fits            times
///   cost_fits rows 1e7   one raw record of so many rows, from position and force to intervals: time and memory
#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <numbers>
#include <string>

#include "fit/decay.hpp"
#include "fit/morison.hpp"
#include "fit/prepare.hpp"
#include "fit/robust.hpp"
#include "fit/runs.hpp"
#include "support/morison_records.hpp"

namespace {

constexpr int samples = 20000, fits = 100;

/// Of this process, s: other work on the machine disturbs it little.
double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Least of five runs, s.
double best_of(const std::function<void()>& work) {
  double best = 1e9;
  for (int i = 0; i < 5; ++i) {
    const double start = processor_time();
    work();
    best = std::min(best, processor_time() - start);
  }
  return best;
}

const fit::Cylinder& cylinder = froude_test::held_cylinder;

/// Twenty periods of 4 s, C_D = 1.2, C_M = 1.8, noise of 3 N with a memory.
fit::ForceRecord record() { return froude_test::swinging_water(samples, 0.004, 0.9, 1); }

/// The linear problem of a record, as the fit sees it.
struct Problem {
  Eigen::MatrixXd columns;
  Eigen::VectorXd force;
};
Problem problem_of(const fit::ForceRecord& r, double cd = 1.2) {
  const auto n = static_cast<Eigen::Index>(r.time.size());
  Problem p{Eigen::MatrixXd(n, 2), Eigen::VectorXd(n)};
  for (Eigen::Index j = 0; j < n; ++j) {
    const auto i = static_cast<std::size_t>(j);
    p.columns(j, 0) = 0.5 * 997 * 0.06 * std::abs(r.velocity[i]) * r.velocity[i];
    p.columns(j, 1) = 997 * cylinder.volume() * r.acceleration[i];
    p.force[j] = r.force[i] + (cd - 1.2) * p.columns(j, 0);
  }
  return p;
}

void forces() {
  const auto r = record();
  const Problem problem = problem_of(r);
  const Eigen::MatrixXd& columns = problem.columns;
  const Eigen::VectorXd& force = problem.force;
  const Eigen::Vector2d exact = columns.colPivHouseholderQr().solve(force);
  Eigen::VectorXd x(2);
  double wrong = 0;
  const double linear = best_of([&] {
    for (int k = 0; k < fits; ++k) {
      const auto small = fit::compress(columns, force);
      x = small.columns.triangularView<Eigen::Upper>().solve(small.target);
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
    for (int k = 0; k < fits; ++k) x = fit::fit_robust(columns, force, fit::RobustLoss::huber).x;
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

/// C_D and C_M of one record, with the plain standard error of C_D.
fit::RunEstimate searched(const Problem& p, double kc) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2);
  const auto small = fit::compress(p.columns, p.force);
  const auto report = fit::minimise(fit::linear_model(small, {{"cd", 1}, {"cm", 1}}, 1), x);
  const double variance = small.rest * small.rest / static_cast<double>(p.force.size() - 2);
  return {x[0], std::sqrt(report.covariance(0, 0) * variance), kc, 1, 1};
}

/// 33 runs of 90 000 samples, each its own fit.
void campaign() {
  std::vector<Problem> runs;
  for (std::uint64_t k = 0; k < 33; ++k)
    runs.push_back(problem_of(froude_test::swinging_water(90000, 0.001, 0.9, 10 + k)));
  double sum = 0;
  const double time = best_of([&] {
    for (const Problem& p : runs) sum += searched(p, 1).value;
  });
  fmt::print("33 runs of 90000 samples            {:.4f} (mean C_D {:.3f})\n", time, sum / (5 * 33));
}

/// 100 runs of 2000 samples whose drag falls with ln KC and differs from run to run: each is fitted, then the law.
void global_fit() {
  std::vector<Problem> runs;
  const auto own = froude_test::ar1_noise(100, 0, 0.05, 77);
  for (std::uint64_t k = 0; k < 100; ++k)
    runs.push_back(problem_of(froude_test::swinging_water(2000, 0.04, 0.9, 100 + k),
                              1.2 - 0.3 * (std::log(5.0 + static_cast<double>(k)) - 4) + own[k]));
  fit::RandomEffects law;
  const double time = best_of([&] {
    std::vector<fit::RunEstimate> estimates;
    for (std::size_t k = 0; k < runs.size(); ++k) estimates.push_back(searched(runs[k], 5.0 + static_cast<double>(k)));
    law = fit::fit_runs(estimates, fit::Law::kc);
  });
  fmt::print("global fit over 100 runs            {:.4f} (slope {:.3f}, between runs {:.3f})\n", time,
             law.coefficients[1], law.between);
}

/// Four swings of a dropper of two links, six parameters and a start each.
void dropper() {
  const std::vector<double> truth{0.5, 0.7, 60, 33, 0.05, 0.02};
  fit::ShootingProblem p{.law = fit::MotionLaw::double_pendulum,
                         .windows = {},
                         .deviations = {0.001, 0.001},
                         .start = {0.45, 0.6, 58, 30, 0.06, 0.01},
                         .fitted = std::vector<bool>(6, true),
                         .substeps = 1};
  for (int w = 0; w < 4; ++w) {
    const Eigen::Vector4d start(2.6 - 0.4 * w, 3.5 - 0.3 * w, 1.0 * w, -1.0);
    fit::Window window{0.002, fit::follow(p.law, truth, start, 0.002, 250, 4)};
    const auto noise = froude_test::ar1_noise(500, 0, 0.001, static_cast<std::uint64_t>(20 + w));
    for (Eigen::Index j = 0; j < 500; ++j) window.values.data()[j] += noise[static_cast<std::size_t>(j)];
    p.windows.push_back(window);
  }
  fit::ShootingFit f;
  const double time = best_of([&] { f = fit::fit_motion(p); });
  fmt::print("dropper by shooting                 {:.5f} (coupling {:.4f})\n", time, f.parameters[0].value.value_or(0));
}

double peak_gigabytes() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return static_cast<double>(used.ru_maxrss) * 1024 / 1e9;
}

/// One long raw record, all the way: derivatives, a low pass, cycles of full amplitude, intervals.
void rows(std::size_t n) {
  fit::Cylinder moved = froude_test::moved_cylinder;
  fit::RawRun run;
  run.force = {{"F", {}, {}}};
  const double omega = 2 * std::numbers::pi / 4;
  auto noise = froude_test::ar1_noise(n, 0.9, 3, 1);
  for (std::size_t j = 0; j < n; ++j) {
    const double t = 0.001 * static_cast<double>(j), x = 0.36 * std::sin(omega * t);
    run.time.push_back(t);
    run.position.push_back(x);
    run.force[0].values.push_back(
        fit::morison_force(moved, 1.2, 1, 0.36 * omega * std::cos(omega * t), -omega * omega * x) + noise[j]);
  }
  noise = {};
  const double data = 3 * 8e-9 * static_cast<double>(n), before = peak_gigabytes();
  const double start = processor_time();
  const auto prepared =
      fit::prepare(std::move(run), {.filters = {{.kind = fit::FilterChoice::Kind::butterworth, .order = 4, .hz = 3.3}},
                                    .window = {.kind = fit::WindowChoice::Kind::full_cycles}});
  const double between = peak_gigabytes(), half = processor_time() - start;
  const auto f = fit::fit_morison(moved, prepared.record);
  const double time = processor_time() - start;
  fmt::print(
      "{} rows, {:.2f} GB of data: {:.2f} s, of which {:.2f} s to prepare; memory at most {:.2f} GB while made, {:.2f} "
      "GB "
      "prepared, {:.2f} GB fitted\ncd {:.4f} ({:.4f} to {:.4f}), worth {:.0f} samples of {}\n",
      n, data, time, half, before, between, peak_gigabytes(), *f.cd.value, f.cd.interval.low, f.cd.interval.high,
      f.cd.effective_samples, f.samples);
}

}  // namespace

int main(int count, char** words) {
  mallopt(M_MMAP_MAX, 0);  // as the program does
  mallopt(M_TRIM_THRESHOLD, -1);
  if (count == 3 && std::string(words[1]) == "rows") {
    rows(static_cast<std::size_t>(std::strtod(words[2], nullptr)));
    return 0;
  }
  forces();
  campaign();
  global_fit();
  motions();
  dropper();
}
