#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/line/stepper.hpp"
#include "harness/case.hpp"
#include "support/line_models.hpp"
#include "support/plain_spherical.hpp"

namespace froude::validation::huijgen_double {
namespace {

namespace dl = dynamics::line;
using Eigen::Vector3d;
constexpr double g = 9.81, pi = std::numbers::pi, duration = 50;

/// One row of table 3.1 or 3.2: both links start alike, θ from the vertical, φ = 0.
struct Start {
  double second_mass, polar, polar_rate, azimuth_rate;
};
constexpr Start periodic{1, pi / 4, 0, 0.3}, chaotic{0.2, pi / 2, -pi / 2, pi / 6};

using Places = Eigen::Matrix3Xd;

Places directions(const Start& s, double turned_by) {
  const double polar = s.polar + turned_by;
  Places d(3, 2);
  d.colwise() = Vector3d(std::sin(polar), 0, -std::cos(polar));
  d.col(1) += d.col(0).eval();
  return d;
}

/// θ̇ and φ̇ at φ = 0 turn a link's end along (cos θ, 0, sin θ) and (0, sin θ, 0).
Places velocities(const Start& s, double turned_by) {
  const double polar = s.polar + turned_by;
  Places v(3, 2);
  v.colwise() =
      Vector3d(s.polar_rate * std::cos(polar), s.azimuth_rate * std::sin(polar), s.polar_rate * std::sin(polar));
  v.col(1) += v.col(0).eval();
  return v;
}

struct Run {
  std::vector<Places> at;           ///< every 10 ms
  double energy = 0, momentum = 0;  ///< largest relative changes
};

Run ours(const Start& start, double h, double turned_by = 0, double until = duration) {
  dl::Description d = support::pendulums(2);
  d.nodes[2].mass = start.second_mass;
  const dl::Line line(d);
  dl::State s = support::in_plane(line, {0, 0});
  s.position.rightCols(2) = directions(start, turned_by);
  s.velocity.rightCols(2) = velocities(start, turned_by);
  const auto momentum = [&] {
    return s.position.col(1).cross(s.velocity.col(1)).z() +
           start.second_mass * s.position.col(2).cross(s.velocity.col(2)).z();
  };
  dl::Stepper stepper(line, {});
  stepper.start(s);
  const double before = momentum();
  Run out;
  double liveliest = stepper.energies().kinetic;
  const auto every = static_cast<int>(std::lround(0.01 / h));
  for (int i = 1; i <= static_cast<int>(std::lround(until / h)); ++i) {
    stepper.step(s, h);
    liveliest = std::max(liveliest, stepper.energies().kinetic);
    out.energy = std::max(out.energy, std::abs(stepper.energies().residual()));
    out.momentum = std::max(out.momentum, std::abs(momentum() / before - 1));
    if (i % every == 0) out.at.push_back(s.position.rightCols(2));
  }
  out.energy /= liveliest;
  return out;
}

Run reference(const Start& start, double h, double turned_by = 0, double until = duration) {
  const support::PlainSpherical plain{.mass = {1, start.second_mass}};
  Places x = directions(start, turned_by), v = velocities(start, turned_by);
  Run out;
  const auto every = static_cast<int>(std::lround(0.01 / h));
  for (int i = 1; i <= static_cast<int>(std::lround(until / h)); ++i) {
    plain.step(x, v, h);
    if (i % every == 0) out.at.push_back(x);
  }
  return out;
}

/// ln(10⁻³/10⁻⁹)/(time from one distance to the other): how fast neighbours part.
double exponent(const Run& a, const Run& b) {
  double from = 0;
  for (std::size_t i = 0; i < a.at.size(); ++i) {
    const double apart = (a.at[i] - b.at[i]).norm(), t = 0.01 * static_cast<double>(i + 1);
    if (from == 0 && apart > 1e-9) from = t;
    if (apart > 1e-3) return std::log(1e6) / (t - from);
  }
  return 0;
}

struct Mean {
  double value, standard_error;
};

/// Of pairs of neighbours 1e-11 rad apart, the pairs a milliradian.
template <class Integrate>
Mean mean_exponent(Integrate integrate) {
  constexpr int pairs = 16;
  double sum = 0, squares = 0;
  for (int k = 0; k < pairs; ++k) {
    const double start = 1e-3 * k, e = exponent(integrate(start), integrate(start + 1e-11));
    sum += e;
    squares += e * e;
  }
  const double mean = sum / pairs;
  return {mean, std::sqrt((squares / pairs - mean * mean) / (pairs - 1))};
}

plot::Series seen_from_above(const std::string& name, const Run& r) {
  plot::Series s{.name = name, .x = {}, .y = {}};
  for (std::size_t i = 0; i < r.at.size() && i < 2000; i += 2) {
    s.x.push_back(r.at[i](0, 1));
    s.y.push_back(r.at[i](1, 1));
  }
  return s;
}

}  // namespace

Outcome outcome(const Folders&) {
  const Run coarse = ours(periodic, 1e-3), fine = ours(periodic, 5e-4), exact = reference(periodic, 2e-4);
  double worst = 0, single = 0;
  for (std::size_t i = 0; i < exact.at.size(); ++i) {
    worst = std::max(worst, ((4 * fine.at[i] - coarse.at[i]) / 3 - exact.at[i]).cwiseAbs().maxCoeff());
    single = std::max(single, (coarse.at[i] - exact.at[i]).cwiseAbs().maxCoeff());
  }
  const Run wild = ours(chaotic, 1e-3);
  const Mean our = mean_exponent([](double turned) { return ours(chaotic, 2e-3, turned, 40); });
  const Mean plain = mean_exponent([](double turned) { return reference(chaotic, 2e-3, turned, 40); });
  return {
      .numbers =
          {{"periodic: largest change of energy in 50 s, step 1 ms, relative", coarse.energy, ""},
           {"chaotic: largest change of energy in 50 s, step 1 ms, relative", wild.energy, ""},
           {"chaotic: largest change of angular momentum about the vertical, relative", wild.momentum, ""},
           {"periodic: places over 50 s against the reference, steps of 1 and 0.5 ms extrapolated, largest difference",
            worst, "m"},
           {"periodic: the same of the step of 1 ms alone", single, "m"},
           {"chaotic: mean exponent of 16 pairs of neighbours, ours less the reference's, in standard errors",
            (our.value - plain.value) / std::hypot(our.standard_error, plain.standard_error), ""},
           {"chaotic: mean exponent", our.value, "1/s"},
           {"chaotic: its standard error", our.standard_error, "1/s"}},
      .pictures = {{"paths",
                    "The lower bob seen from above over the first 20 s.",
                    {.title = "Double pendulum in space",
                     .panels = {{.x = {.label = "x", .unit = "m"},
                                 .y = {.label = "y", .unit = "m"},
                                 .series = {seen_from_above("table 3.1, periodic", coarse)}},
                                {.x = {.label = "x", .unit = "m"},
                                 .y = {.label = "y", .unit = "m"},
                                 .series = {seen_from_above("table 3.2, chaotic", wild)}}},
                     .width = 760,
                     .panel_height = 420}}}};
}

}  // namespace froude::validation::huijgen_double
