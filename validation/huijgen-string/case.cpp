#include <array>
#include <cmath>

#include "dynamics/line/stepper.hpp"
#include "harness/case.hpp"
#include "support/line_models.hpp"

namespace froude::validation::huijgen_string {
namespace {

namespace dl = dynamics::line;
constexpr double g = 9.81, length = 1, mass = 1;
constexpr std::array bessel_zeros{2.404825557695773, 5.520078110286311, 8.653727912911012};

/// Sideways places of N bobs that swing at ω together, from the lowest (1) up to the support, which must come out as 0.
/// Also counts changes of sign: the mode's number.
std::vector<double> shape(int n, double omega2, int& crossings) {
  const double m = mass / n, l = length / n;
  std::vector<double> y(static_cast<std::size_t>(n) + 1);
  y[static_cast<std::size_t>(n)] = 1;
  double pull = 0;  // the sideways force of the link above on what hangs below it
  crossings = 0;
  for (int i = n; i > 0; --i) {
    const auto k = static_cast<std::size_t>(i);
    pull += m * omega2 * y[k];
    y[k - 1] = y[k] - pull * l / (m * g * (n - i + 1));
    if ((y[k - 1] < 0) != (y[k] < 0)) ++crossings;
  }
  return y;
}

/// ω of mode 1, 2, … of N bobs by bisection on the number of crossings.
double frequency(int n, int mode) {
  double low = 0, high = 4.0 * g * n * n / length;
  for (int i = 0; i < 200; ++i) {
    int crossings = 0;
    const double middle = (low + high) / 2;
    shape(n, middle, crossings);
    (crossings < mode ? low : high) = middle;
  }
  return std::sqrt(low);
}

/// ω of a run that starts in that shape, from the time at which the lowest bob has passed the middle five times.
double run(int n, double omega) {
  constexpr double small = 1e-4;
  const double h = 2 * 3.141592653589793 / omega / 400;
  int unused = 0;
  const std::vector<double> y = shape(n, omega * omega, unused);
  const dl::Line line(support::pendulums(n, length / n, mass / n));
  dl::State s{.position = dl::Places::Zero(3, n + 1), .velocity = dl::Places::Zero(3, n + 1), .tension = {}};
  for (int i = 1; i <= n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double across = small * (y[k] - y[k - 1]), l = length / n;
    s.position.col(i) = s.position.col(i - 1) + Eigen::Vector3d(across, 0, -std::sqrt(l * l - across * across));
  }
  dl::Stepper stepper(line, {});
  stepper.start(s);
  double before = s.position(0, n);
  for (int passes = 0, i = 1;; ++i) {
    stepper.step(s, h);
    const double now = s.position(0, n);
    if (before * now < 0 && ++passes == 5) {
      const double measured = 4.5 * 3.141592653589793 / ((i - now / (now - before)) * h);
      return 2 / h * std::tan(measured * h / 2);  // without the midpoint rule's lateness
    }
    before = now;
  }
}

}  // namespace

Outcome outcome(const Folders&) {
  double worst = 0;
  std::array<double, 3> longest{};
  plot::Figure figure{.title = "Frequencies of N pendulums hung one on the other",
                      .panels = {{.x = {.label = "N", .scale = plot::Scale::logarithmic},
                                  .y = {.label = "frequency over sqrt(g/L)"},
                                  .series = {}}}};
  for (int mode = 1; mode <= 3; ++mode) {
    plot::Series exact{.name = "linear chain, mode " + std::to_string(mode), .x = {}, .y = {}};
    plot::Series measured{.name = "runs", .x = {}, .y = {}, .line = false, .marks = true};
    for (const int n : {1, 2, 3, 5, 10, 30, 100, 300, 1000}) {
      if (n < mode) continue;
      const double omega = frequency(n, mode), ours = run(n, omega);
      worst = std::max(worst, std::abs(ours / omega - 1));
      longest[static_cast<std::size_t>(mode) - 1] = ours;
      exact.x.push_back(n);
      measured.x.push_back(n);
      exact.y.push_back(omega / std::sqrt(g / length));
      measured.y.push_back(ours / std::sqrt(g / length));
    }
    if (mode > 1) measured.name.clear();
    figure.panels[0].series.push_back(exact);
    figure.panels[0].series.push_back(measured);
  }
  const auto against_bessel = [&](std::size_t k) {
    return longest[k] / (bessel_zeros[k] / 2 * std::sqrt(g / length)) - 1;
  };
  return {
      .numbers = {{"frequencies of N = 1 … 1000, modes 1 … 3, against the linear chain, worst, relative", worst, ""},
                  {"lowest frequency of N = 1000 against Bessel's zero, relative", against_bessel(0), ""},
                  {"third frequency of N = 1000 against Bessel's zero, relative", against_bessel(2), ""}},
      .pictures = {{"frequencies", "From one pendulum to the hanging chain.", figure}}};
}

}  // namespace froude::validation::huijgen_string
