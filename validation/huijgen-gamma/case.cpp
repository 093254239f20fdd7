#include <algorithm>
#include <cmath>
#include <complex>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "dynamics/line/equilibrium.hpp"
#include "dynamics/line/stepper.hpp"
#include "harness/case.hpp"
#include "support/line_models.hpp"

namespace froude::validation::huijgen_gamma {
namespace {

namespace dl = dynamics::line;
constexpr double duration = 30, small = 1e-4;

/// The dropper at rest and its lowest motion out of the plane.
struct Dropper {
  dl::Line line{support::dropper()};
  dl::State rest;
  Eigen::VectorXd shape;
  double omega = 0;

  Dropper() {
    rest = dl::hanging_shape(line, support::ends_at(line, {0.4, 0, 0}));
    const int n = line.nodes() - 2;
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n + 2, n + 2), M = K;
    for (int j = 0; j <= n; ++j) {
      const double k = rest.tension[j] / line.segment(j).length;
      K(j, j) += k, K(j + 1, j + 1) += k, K(j, j + 1) -= k, K(j + 1, j) -= k;
      M(j, j + 1) = M(j + 1, j) = line.mass_between(j);
    }
    for (int i = 0; i < n + 2; ++i) M(i, i) = line.mass(i);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(K.block(1, 1, n, n), M.block(1, 1, n, n));
    omega = std::sqrt(modes.eigenvalues()[0]);
    shape = modes.eigenvectors().col(0) / modes.eigenvectors().col(0).cwiseAbs().maxCoeff();
    if (shape[n / 2] < 0) shape = -shape;
  }
};

/// Share of the amplitude at the end, started at full speed through the middle so that lengths are kept.
double swing(const Dropper& d, const dl::Stepper::Settings& settings, double h) {
  dl::State s = d.rest;
  for (int i = 0; i < d.shape.size(); ++i) s.velocity(1, i + 1) = small * d.omega * d.shape[i];
  dl::Stepper stepper(d.line, settings);
  stepper.start(s);
  for (int i = 0; i < static_cast<int>(std::lround(duration / h)); ++i) stepper.step(s, h);
  // Place and speed together are the amplitude at any time.
  return std::hypot(s.position(1, 3), s.velocity(1, 3) / d.omega) / (small * d.shape[2]);
}

double closed_form(double gamma, double omega, double h) {
  const std::complex<double> z(0, omega * h);
  return std::pow(std::abs((1.0 + (1 - gamma) * z) / (1.0 - gamma * z)), std::lround(duration / h));
}

/// Energy left of a release from scenario A, of what it can give.
double large_release(const dl::Stepper::Settings& settings, double h) {
  const dl::Line line(support::dropper());
  dl::State s = support::in_plane(line, support::dropper_angles);
  dl::State ends = s;
  dl::Stepper stepper(line, settings);
  stepper.start(s);
  const dl::State rest = dl::hanging_shape(line, ends);
  const double lowest = -line.constant_load().cwiseProduct(rest.position).sum();
  for (int i = 0; i < static_cast<int>(std::lround(duration / h)); ++i) stepper.step(s, h);
  return (stepper.energies().total() - lowest) / (stepper.energies().at_start - lowest);
}

}  // namespace

Outcome outcome(const Folders&) {
  const Dropper dropper;
  const std::vector<double> all_steps{0.05, 0.02, 0.01, 0.005, 0.002};
  double worst = 0, lost = 0, implicit_at_10ms = 0;
  plot::Panel left{.x = {.label = "step", .unit = "s", .scale = plot::Scale::logarithmic},
                   .y = {.label = "amplitude left after 30 s", .range = std::pair{0.0, 1.1}},
                   .series = {}};
  std::vector<Number> told;
  for (const double gamma : {1.0, 0.75, 0.51, 0.5}) {
    plot::Series ours{.name = fmt::format("gamma = {}", gamma), .x = all_steps, .y = {}, .marks = true};
    for (const double h : all_steps) {
      const double amplitude = swing(dropper, {.scheme = dl::Scheme::gamma, .gamma = gamma}, h);
      worst = std::max(worst, std::abs(amplitude - closed_form(gamma, dropper.omega, h)));
      if (gamma == 1 && h == 0.01) implicit_at_10ms = amplitude;
      ours.y.push_back(amplitude);
    }
    left.series.push_back(ours);
  }
  plot::Series kept{.name = "energy-momentum", .x = all_steps, .y = {}, .marks = true};
  for (const double h : all_steps) {
    kept.y.push_back(swing(dropper, {}, h));
    lost = std::max(lost, std::abs(1 - kept.y.back()));
  }
  left.series.push_back(kept);
  for (const double gamma : {1.0, 0.51, 0.5})
    told.push_back({fmt::format("large release, gamma = {}, step 0.0065 s: energy left after 30 s", gamma),
                    large_release({.scheme = dl::Scheme::gamma, .gamma = gamma}, 0.0065), ""});
  told.push_back(
      {"large release, energy-momentum, step 0.0065 s: energy left after 30 s", large_release({}, 0.0065), ""});
  Outcome out{.numbers = {{"amplitude left after 30 s, gamma = 1, 0.75, 0.51, 1/2, steps 0.002 to 0.05 s, against the "
                           "closed form, worst",
                           worst, ""},
                          {"energy-momentum, same steps: amplitude lost, worst", lost, ""},
                          {"gamma = 1, step 0.01 s: amplitude left", implicit_at_10ms, ""},
                          {"frequency of the swing out of the plane", dropper.omega, "rad/s"}},
              .pictures = {{"price",
                            "What is left of a swing that nothing damps.",
                            {.title = "Numerical damping of the model dropper", .panels = {left}}}}};
  out.numbers.insert(out.numbers.end(), told.begin(), told.end());
  return out;
}

}  // namespace froude::validation::huijgen_gamma
