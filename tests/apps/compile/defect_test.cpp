// What a memory leaves out, put back as a load, tells how far off it makes the motion.
#include "compile/defect.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "compile/integrator.hpp"
#include "dynamics/integrate/integrator.hpp"
#include "dynamics/integrate/start_with_lines.hpp"
#include "hydro/base/random.hpp"
#include "hydro/potential/formats/writers.hpp"
#include "scenes.hpp"
#include "support/scratch.hpp"
#include "support/two_pole_body.hpp"

namespace defect_test {
namespace {

using namespace froude;

/// A buoy that heaves in water whose memory is a sum of exactly known ones (R9).
struct Buoy {
  struct Part {
    double strength;  // N/m
    support::TwoPoleBody water;
  };
  std::vector<Part> parts;
  double spacing = 0.05, last = 8;                                  // rad/s, of the table
  static constexpr double mass = 1000, added = 500, natural = 1.2;  // kg, kg, rad/s

  double stiffness() const { return (mass + added) * natural * natural; }
  static double X(double omega) { return 800 * std::exp(-std::pow(omega / 1.5, 2)); }  // N/m
  double A(double omega) const {
    double sum = added;
    for (const Part& p : parts) sum += p.strength * p.water.A_minus_A_inf(omega);
    return sum;
  }
  double B(double omega) const {
    double sum = 0;
    for (const Part& p : parts) sum += p.strength * p.water.B(omega);
    return sum;
  }

  std::filesystem::path write(const std::string& name) const {
    hydro::potential::Coefficients c;
    c.water = {.density = 1000, .gravity = 9.80665, .depth = hydro::WaterDepth::from_metres(10)};
    c.body.push_back({.name = "buoy",
                      .reference_point = Eigen::Vector3d(0, 0, 0),
                      .centre_of_gravity = {},
                      .centre_of_buoyancy = {},
                      .displaced_volume = {}});
    const auto heave = [](double value) {
      Eigen::MatrixXd out = Eigen::MatrixXd::Zero(6, 6);
      out(2, 2) = value;
      return out;
    };
    for (int i = 1; i <= std::lround(last / spacing); ++i) {
      c.omega.push_back(spacing * i);
      c.A.push_back(heave(A(c.omega.back())));
      c.B.push_back(heave(B(c.omega.back())));
    }
    c.A_inf = heave(added);
    c.C = heave(stiffness());
    c.heading = {0};
    c.X.push_back(Eigen::MatrixXcd::Zero(6, static_cast<Eigen::Index>(c.omega.size())));
    for (std::size_t i = 0; i < c.omega.size(); ++i) c.X.front()(2, static_cast<Eigen::Index>(i)) = X(c.omega[i]);
    c.source = "a buoy made for a test";
    const auto path = support::scratch_folder() / (name + ".h5");
    hydro::potential::write_froude(c, path);
    return path;
  }

  /// Heave at multiples of `every`: the memory as two states a part, by a fine Runge–Kutta.
  std::vector<double> exact(double start, const std::function<double(double)>& force, double every,
                            std::size_t samples) const {
    const auto n = static_cast<Eigen::Index>(parts.size());
    Eigen::VectorXd x = Eigen::VectorXd::Zero(2 + 2 * n);
    x[0] = start;
    const auto rate = [&](double t, const Eigen::VectorXd& s) {
      Eigen::VectorXd out(s.size());
      double load = force(t) - stiffness() * s[0];
      for (Eigen::Index k = 0; k < n; ++k) {
        const Part& p = parts[static_cast<std::size_t>(k)];
        load -= p.strength * s[3 + 2 * k];
        out[2 + 2 * k] = s[3 + 2 * k];
        out[3 + 2 * k] = s[1] - 2 * p.water.decay * s[3 + 2 * k] - p.water.w2() * s[2 + 2 * k];
      }
      out[0] = s[1];
      out[1] = load / (mass + added);
      return out;
    };
    constexpr int fine = 20;
    const double h = every / fine;
    std::vector<double> out{start};
    for (double t = 0; out.size() < samples;) {
      for (int i = 0; i < fine; ++i, t += h) {
        const Eigen::VectorXd k1 = rate(t, x), k2 = rate(t + h / 2, x + h / 2 * k1),
                              k3 = rate(t + h / 2, x + h / 2 * k2), k4 = rate(t + h, x + h * k3);
        x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      }
      out.push_back(x[0]);
    }
    return out;
  }

  static scene::Scene scene(const std::filesystem::path& file, const std::string& radiation, const std::string& more,
                            double step) {
    return scene::parse(
        "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"10 m\"\n"
        "[[body]]\nname = \"buoy\"\nmass = \"1000 kg\"\ninertia = \"(900, 900, 900) kg m^2\"\n"
        "free = [\"heave\"]\n[body.hydrodynamics]\nfile = \"" +
            file.string() + "\"\nhydrostatics = true\nradiation = { " + radiation + " }\n" + more +
            fmt::format("[ask]\nrun = {{ duration = \"40 s\", every = \"{0} s\" }}\n[solve]\nstep = \"{0} s\"\n", step),
        file);
  }
};

const std::string decay = "[body.initial]\nheave = \"0.5 m\"\n";
const std::string waves =
    "excitation = true\naccept = [\"Haskind relation\", \"heave in long waves\", \"place of the "
    "bodies\"]\n[waves]\nkind = \"regular\"\namplitude = \"0.5 m\"\nperiod = \"5 s\"\nheading = \"0 deg\"\n";
constexpr double step = 0.01;

struct Motion {
  std::vector<double> heave;
  compile::VelocityRecord velocity;
};

Motion run(const scene::Scene& scene, const compile::TimeModel& model) {
  dynamics::Workspace workspace(model.model, model.start);
  const auto integrator = compile::make_integrator(scene, model.model);
  dynamics::start_with_lines(*integrator, workspace);
  Motion out{{}, {model.step, Eigen::MatrixXd(6, static_cast<Eigen::Index>(model.steps) + 1)}};
  const auto sample = [&] {
    out.velocity.of_modes.col(static_cast<Eigen::Index>(out.heave.size())) = workspace.state.velocity;
    out.heave.push_back(workspace.state.pose[0].centre.z());
  };
  for (sample(); out.heave.size() <= model.steps; sample()) integrator->step(workspace, model.step);
  return out;
}

double rms_between(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(a[i] - b[i], 2);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// rms over the rms of the motion
struct Errors {
  double memory, data;  ///< as the loads tell that are put back
  double real;          ///< against the closed form
  double left;          ///< of the run with what the memory leaves out put back
};

/// Of the memory that `radiation` asks for.
Errors errors(const Buoy& buoy, const std::string& radiation, const std::string& more) {
  const auto file = buoy.write("defect");
  const scene::Scene scene = Buoy::scene(file, radiation, more, step);
  const compile::Prepared prepared = compile::prepare(scene);
  const compile::TimeModel model = compile::time_model(scene, prepared);
  const Motion as_is = run(scene, model);
  const auto with = [&](const compile::LoadRecord& missing) {
    return run(scene, compile::time_model(scene, prepared, {missing})).heave;
  };
  const auto memory = with(*compile::memory_defect(model, as_is.velocity));
  const auto data = with(*compile::data_defect(scene, prepared, model, as_is.velocity));
  const double omega = 2 * std::numbers::pi / 5, load = more.ends_with(decay) ? 0 : 0.5 * Buoy::X(omega);
  const auto exact = buoy.exact(
      as_is.heave.front(), [&](double t) { return load * std::cos(omega * t); }, step, as_is.heave.size());
  const double size = rms_between(exact, std::vector<double>(exact.size(), 0.0));
  return {rms_between(as_is.heave, memory) / size, rms_between(as_is.heave, data) / size,
          rms_between(as_is.heave, exact) / size, rms_between(memory, exact) / size};
}

const Buoy two_poles{{{400, {.decay = 0.3, .frequency = 1.1}}}};
const Buoy eight_poles{{{200, {.decay = 0.3, .frequency = 1.1}},
                        {100, {.decay = 0.2, .frequency = 1.7}},
                        {100, {.decay = 0.5, .frequency = 2.6}},
                        {50, {.decay = 0.15, .frequency = 0.8}}}};

// A step of 0.01 s turns the phase of 1.2 rad/s by (ωh)²/12 of itself: 6e-4 after 40 s, 6e-4/√3 as rms of what grows
// straight to that.
constexpr double floor_of_the_step = 3.5e-4;

TEST(MemoryDefect, PredictsTheErrorOfTheMotion) {
  for (const auto& [buoy, method] : {std::pair{two_poles, "direct"}, {eight_poles, "direct"}, {eight_poles, "poles"}})
    for (const std::string& more : {decay, waves})
      for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4}) {
        const Errors e = errors(
            buoy, fmt::format("memory_tolerance = {}, accept_error = 1, method = \"{}\"", tolerance, method), more);
        const std::string which = fmt::format("{}, {}, {}", method, more, tolerance);
        EXPECT_LT(e.real, 3 * e.memory + floor_of_the_step) << which;
        EXPECT_LT(e.memory, 3 * e.real) << which;
        // Put back, it takes the error away but for its square and the error of the data.
        EXPECT_LT(e.left, 0.06 * e.real + floor_of_the_step) << which;
      }
}

/// Water of two to five resonances, from a tenth to the half of critical and more.
Buoy random_buoy(std::uint64_t seed) {
  const hydro::RandomStream random(seed, 0);
  const auto between = [&](std::uint64_t index, double low, double high) {
    return low + (high - low) * random.uniform(index);
  };
  Buoy out{{}};
  const auto count = 2 + seed % 4;
  for (std::uint64_t k = 0; k < count; ++k)
    out.parts.push_back(
        {between(3 * k, 40, 250), {.decay = between(3 * k + 1, 0.15, 0.8), .frequency = between(3 * k + 2, 0.6, 3)}});
  return out;
}

TEST(MemoryDefect, PredictsTheErrorOfTheMotionInTwentyScenesDrawnAtRandom) {
  const std::string methods[] = {"direct", "poles", "partitioned"};
  const double ladder[] = {1e-1, 3e-2, 1e-2, 1e-3};
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::string which =
        fmt::format("memory_tolerance = {}, accept_error = 1, method = \"{}\"", ladder[seed / 5], methods[seed % 3]);
    const Errors e = errors(random_buoy(seed), which, seed % 2 == 0 ? decay : waves);
    EXPECT_LT(e.real, 3 * (e.memory + e.data) + floor_of_the_step) << "seed " << seed << ", " << which;
    EXPECT_LT(e.memory, 3 * e.real + floor_of_the_step) << "seed " << seed << ", " << which;
  }
}

// Frequencies so far apart that the resonances of this water, some 0.3 rad/s wide, lie between three of them or none.
TEST(DataDefect, PredictsWhatCoarseFrequenciesLeaveOpen) {
  for (const double spacing : {0.8, 0.4, 0.2, 0.1})
    for (const std::string method : {"direct", "poles"})
      for (const std::string& more : {decay, waves}) {
        Buoy coarse = eight_poles;
        coarse.spacing = spacing;
        const Errors e = errors(coarse, "accept_error = 5, method = \"" + method + "\"", more);
        const double told = e.memory + e.data;
        const std::string which = fmt::format("{} rad/s apart, {}, {}", spacing, method, more);
        EXPECT_LT(e.real, 3 * told + floor_of_the_step) << which;
        EXPECT_LT(told, 3 * e.real) << which;
      }
}

// The buoy swings with 1.1 rad/s or so, beyond a table that ends at 0.7 to 0.95 rad/s, where much is still to come.
TEST(DataDefect, CountsWhatMovesBeyondTheLastFrequency) {
  const std::string accepted =
      "accept = [\"high-frequency tail\", \"Kramers-Kronig\", \"A(inf) by Ogilvie\", \"spikes\"]\n";
  int beyond = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Buoy cut = random_buoy(seed);
    cut.last = 0.7 + 0.05 * static_cast<double>(seed % 6);
    const Errors e = errors(cut, "accept_error = 5, method = \"poles\"", accepted + decay);
    beyond += e.real > e.memory + e.data ? 1 : 0;
  }
  EXPECT_LE(beyond, 1) << "of 20";
}

}  // namespace
}  // namespace defect_test
