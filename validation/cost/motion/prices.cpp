/// \file  Writes the price list of runs of bodies: docs/cost/motion.md and its picture. See README.md.
#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <filesystem>
#include <functional>
#include <iostream>
#include <limits>
#include <numbers>

#include "answers/linear_response.hpp"
#include "answers/plot.hpp"
#include "answers/simulate.hpp"
#include "compile/compile.hpp"
#include "compile/radiation.hpp"
#include "compile/waves.hpp"
#include "dynamics/force/friction.hpp"
#include "dynamics/force/gravity.hpp"
#include "dynamics/integrate/energy_momentum.hpp"
#include "dynamics/integrate/euler.hpp"
#include "dynamics/integrate/explicit_pair.hpp"
#include "dynamics/integrate/generalized_alpha.hpp"
#include "dynamics/line/catenary_table.hpp"
#include "dynamics/time/alpha_parameters.hpp"
#include "harness/scenes.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/radiation/choice.hpp"
#include "support/double_pendulum.hpp"
#include "support/pontoons.hpp"

namespace froude::cost {
namespace {

namespace fs = std::filesystem;
const fs::path examples = validation::source_folder() / "../examples";

/// Seconds of processor time.
double seconds(const std::function<void()>& work) {
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

#ifdef FROUDE_AUDIT
constexpr bool with_assertions = true;
#else
constexpr bool with_assertions = false;
#endif

/// A run that went to its end, and how long that took: processor time, the better of two.
struct Timed {
  Run record;
  double preparing, stepping;  ///< s
};
Timed timed(const scene::Scene& scene) {
  Timed best{{}, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (int again = 0; again < 2; ++again) {
    std::optional<compile::Prepared> prepared;
    std::optional<compile::TimeModel> model;
    best.preparing = std::min(best.preparing, seconds([&] {
                                prepared = compile::prepare(scene);
                                model.emplace(compile::time_model(scene, *prepared));
                              }));
    best.stepping = std::min(best.stepping, seconds([&] { best.record = run_model(scene, *model); }));
    hydro::require(best.record.stopped.empty(), "{}: {}", scene.file.string(), best.record.stopped);
  }
  return best;
}

/// Root mean square difference over the reference's own, of samples at the same instants.
double off(const std::vector<double>& a, const std::vector<double>& reference) {
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    difference += std::pow(a[i] - reference[i], 2);
    size += std::pow(reference[i], 2);
  }
  return std::sqrt(difference / size);
}

/// With a fixed step.
scene::Scene stepped(scene::Scene scene, double step) {
  scene.solve.step = scene::Located<double>{step, {}};
  return scene;
}

// ---- what others have timed ----

/// A sea instead of the regular wave: what the peer ran for 180 s with 512 components.
scene::Scene in_a_sea(const fs::path& data) {
  const validation::Folders folders(validation::source_folder(), data, "rm3-regular");
  scene::Scene scene = validation::read_scene(
      folders, "rm3/wamit/rm3.1", "kind = \"regular\"\nheight = \"2.5 m\"\nperiod = \"8 s\"",
      "kind = \"pierson-moskowitz\"\nhs = \"2.5 m\"\ntp = \"8 s\"\ncomponents = { equal_energy = 512 }");
  scene.run->duration = 180;
  scene.run->every = 0.1;
  return scene;
}

/// Five boxes that hear each other's waves, let go a decimetre aside.
scene::Scene five_boxes(const fs::path& data) {
  return scene::parse(fmt::format(R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "infinite"
[[body]]
name = "box"
position = "(-5, 0, 0) m"
copies = {{ count = 5, step = "(2.5, 0, 0) m" }}
mass = "1200 kg"
centre_of_gravity = "(0, 0, 0.1) m"
radii_of_gyration = "(0.6, 0.6, 0.8) m"
initial = {{ heave = "0.1 m" }}
[body.hydrodynamics]
file = "{}"
radiation = {{ accept_error = 0.01 }}
hydrostatics = true
[ask]
run = {{ duration = "40 s", every = "0.1 s", of = ["box1.heave"] }}
)",
                                  (data / "generated-bem/box5/box5.nc").string()),
                      examples / "test.toml");
}

std::string peers(const fs::path& data) {
  struct Compared {
    const char* name;
    scene::Scene scene;
    double step, theirs, limit;  ///< s; s; of the error
    const char* signal;
  };
  const auto of_case = [&](const char* name, const char* needs, double duration, double every) {
    scene::Scene scene = validation::read_scene(validation::Folders(validation::source_folder(), data, name), needs);
    scene.run->duration = duration;
    scene.run->every = every;
    return scene;
  };
  const char* rm3 = "rm3/wamit/rm3.1";
  const std::vector<Compared> runs{
      {"sphere, decay of 40 s", of_case("sphere-decay", "iea_sphere/wamit/sphere.1", 40, 0.02), 0.02, 0.63, 2e-3,
       "sphere.heave"},
      {"two-body point absorber, decay of 40 s", of_case("rm3-decay", rm3, 39.96, 0.06), 0.03, 3.4, 2e-3,
       "float.heave"},
      {"the same, regular wave of 8 s, 120 s", of_case("rm3-regular", rm3, 120, 0.1), 0.1, 6.1, 2e-3, "float.heave"},
      {"the same, sea of 512 components, 180 s", in_a_sea(data), 0.1, 15.2, 5e-3, "float.heave"},
      {"five boxes, 30 degrees of freedom, 1600 steps", five_boxes(data), 0.025, 1600 * 8.9e-3, 2e-2, "box1.heave"}};
  std::string text =
      "| run | step [s] | error against a step five times shorter | preparing [s] | stepping [s] | strongest peer [s] "
      "| ratio to stepping, to all |\n| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const Compared& r : runs) {
    const Timed run = timed(stepped(r.scene, r.step));
    const Run fine = simulate(stepped(r.scene, r.step / 5));
    const double error = off(run.record.signal(r.signal), fine.signal(r.signal));
    hydro::require(error < r.limit, "{}: off by {}", r.name, error);
    text += fmt::format("| {} | {} | {:.1g} | {:.2g} | {:.2g} | {:.3g} | {:.0f}, {:.1f} |\n", r.name, r.step, error,
                        run.preparing, run.stepping, r.theirs, r.theirs / run.stepping,
                        r.theirs / (run.stepping + run.preparing));
  }
  return text;
}

// ---- methods by step ----

struct Point {
  std::string method;
  double step, ms, error;
};

std::string rows_of(const std::vector<Point>& points, plot::Panel& panel) {
  std::string text = "| method | step [s] | time [ms/s] | error |\n| --- | --- | --- | --- |\n";
  for (const Point& p : points) {
    text += fmt::format("| {} | {:.4g} | {:.3g} | {:.1g} |\n", p.method, p.step, p.ms, p.error);
    if (panel.series.empty() || panel.series.back().name != p.method)
      panel.series.push_back({.name = p.method, .x = {}, .y = {}, .marks = true});
    panel.series.back().x.push_back(p.ms);
    panel.series.back().y.push_back(p.error);
  }
  return text;
}

/// Scenes by generalised-α and implicit Euler, error of one signal against generalised-α at a short step.
std::string scene_methods(scene::Scene scene, const char* signal, const std::vector<double>& steps,
                          plot::Panel& panel) {
  const Run exact = simulate(stepped(scene, steps.back() / 4));
  std::vector<Point> points;
  for (const char* method : {"generalized_alpha", "implicit_euler"})
    for (const double h : steps) {
      scene.solve.integrator = method;
      const Timed run = timed(stepped(scene, h));
      points.push_back({method == std::string("implicit_euler") ? "implicit Euler" : "generalised-α", h,
                        1e3 * run.stepping / scene.run->duration,
                        off(run.record.signal(signal), exact.signal(signal))});
    }
  return rows_of(points, panel);
}

using dynamics::Integrator, dynamics::Model;
using Make = std::function<std::unique_ptr<Integrator>(const Model&)>;

/// A double pendulum whose hinges rub: heights of both rods over 8 s.
Model rubbing_pendulum() {
  using namespace dynamics;
  std::vector<RigidBody> bodies;
  std::vector<Joint> joints;
  const Model free = support::double_pendulum(0.4);
  for (const RigidBody& b : free.bodies()) bodies.push_back(b);
  for (const Joint& j : free.joints().joints()) joints.push_back(j);
  std::vector<std::unique_ptr<const ForceKind>> forces;
  forces.push_back(std::make_unique<GravityKind>(bodies, 9.81));
  std::vector<Friction> friction;
  for (const Joint& j : joints) friction.push_back({j.name, JointCoordinate(bodies, j), 0.025, 0.02, {}, {}});
  forces.push_back(std::make_unique<FrictionKind>(std::move(friction)));
  return Model(std::move(bodies), {}, std::move(forces), std::move(joints));
}

std::string pendulum_methods(plot::Panel& panel) {
  const Model model = rubbing_pendulum();
  constexpr double duration = 4, every = 0.1;
  const auto heights = [&](const Make& make, double h) {
    dynamics::Workspace w(model, dynamics::rest_state(model.bodies()));
    const auto integrator = make(model);
    integrator->start(w);
    std::vector<double> out;
    for (int i = 1; i <= std::lround(duration / h); ++i) {
      integrator->step(w, h);
      if (i % std::lround(every / h) == 0)
        for (const auto& pose : w.state.pose) out.push_back(pose.centre.z());
    }
    return out;
  };
  const auto pair = [](double tolerance) {
    return [tolerance](const Model& m) {
      return std::make_unique<dynamics::ExplicitPair>(m, dynamics::ExplicitPair::Settings{tolerance});
    };
  };
  const std::vector<double> exact = heights(pair(1e-12), 0.01);
  struct Method {
    const char* name;
    Make make;
    std::vector<double> steps;
  };
  const std::vector<double> coarse{0.02, 0.01, 0.005, 0.0025}, fine{0.005, 0.0025, 0.00125};
  const std::vector<Method> methods{
      {"generalised-α",
       [](const Model& m) {
         return std::make_unique<dynamics::GeneralizedAlpha>(m, dynamics::GeneralizedAlpha::Settings{});
       },
       coarse},
      {"energy–momentum", [](const Model& m) { return std::make_unique<dynamics::EnergyMomentum>(m); }, coarse},
      {"explicit pair, its own steps at 1e-8", pair(1e-8), {0.1, 0.05}},
      {"implicit Euler", [](const Model& m) { return std::make_unique<dynamics::ImplicitEuler>(m); }, fine},
      {"semi-implicit Euler", [](const Model& m) { return std::make_unique<dynamics::SemiImplicitEuler>(m); }, fine}};
  std::vector<Point> points;
  for (const Method& m : methods)
    for (const double h : m.steps) {
      std::vector<double> there;
      const double time = seconds([&] { there = heights(m.make, h); });
      points.push_back({m.name, h, 1e3 * time / duration, off(there, exact)});
    }
  return rows_of(points, panel);
}

// ---- effects one at a time ----

/// The five modules with hydrostatics and springs; `body` goes into [body.hydrodynamics], `rest` behind.
scene::Scene five_modules(const std::string& body, const std::string& rest, bool waves) {
  return scene::parse(
      R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "14 m"
)" +
          std::string(
              waves ? "[waves]\nkind = \"jonswap\"\nhs = \"1 m\"\ntp = \"6 s\"\nheading = \"0 deg\"\nramp = \"30 s\"\n"
                    : "") +
          support::pontoons(5, "(-26, 0, 0) m") + R"(initial = { surge = "0.1 m", heave = "0.1 m" }
[body.hydrodynamics]
file = "data/pontoon5.nc"
hydrostatics = true
)" + body +
          rest + R"([ask]
run = { duration = "60 s", every = "0.1 s", of = ["m1.*"] }
accuracy = 1e-2
[solve]
step = "0.1 s"
)",
      examples / "test.toml");
}

std::string effects() {
  const std::string springs = R"([[connector]]
between = "neighbours of m"
ends = ["(6, ±5, 0.5) m", "(-6, ±5, 0.5) m"]
kind = "bushing"
stiffness = "(20, 5, 5) kN/m"
)";
  const std::string member =
      "[[member]]\non = \"m*\"\nfrom = \"(±5.2, ±5.2, -1.13) m\"\nto = \"(±5.2, ±5.2, 0) m\"\ndiameter = \"1.6 m\"\n";
  const auto hinges = [](const std::string& more) {
    return "[[joint]]\nname = \"h\"\nbetween = \"neighbours of m\"\nkind = \"hinge\"\nat = \"(-19.5, 0, 0.5) m\"\naxis "
           "= \"y\"\n" +
           more;
  };
  struct Effect {
    const char* name;
    std::string body, rest;
    bool waves;
  };
  const std::vector<Effect> all{
      {"hydrostatics alone", "", "", false},
      {"bushings between them", "", springs, false},
      {"matrix moorings", "",
       "[[mooring]]\non = [\"m1\", \"m5\"]\nkind = \"linear\"\nstiffness = { surge = \"4280 N/m\" }\n", false},
      {"waves: excitation", "excitation = true\n", "", true},
      {"memory of waves, 30 × 30", "radiation = { memory_tolerance = 1e-2, accept_error = 0.05 }\n", "", false},
      {"memory, each module by itself",
       "interaction = \"self\"\nradiation = { memory_tolerance = 1e-2, accept_error = 0.05 }\n", "", false},
      {"drag on 20 members", "", member + "drag = { cd = 1.0 }\n", true},
      {"Morison on 20 members", "", member + "morison = { cd = 1.0, ca = 0.1 }\n", true},
      {"hinges", "", hinges(""), false},
      {"hinges that rub", "", hinges("friction = { dynamic = \"1 kN m\" }\n"), false},
      {"contact between neighbours", "",
       "[[contact]]\nbetween = \"neighbours of m\"\nkind = \"plane\"\npoints = \"(6, ±5, 0.5) m\"\nradius = \"0.1 "
       "m\"\nat = \"(-6, 0, 0) m\"\nnormal = \"(-1, 0, 0)\"\nrestitution = 0.4\nfriction = 0.3\n",
       false}};
  std::string text =
      "| effect | preparing [s] | a step [µs] | more than hydrostatics alone |\n| --- | --- | --- | --- |\n";
  double bare = 0;
  for (const Effect& e : all) {
    const Timed run = timed(five_modules(e.body, e.rest, e.waves));
    const double us = 1e6 * run.stepping / static_cast<double>(run.record.steps);
    if (bare == 0) bare = us;
    text += fmt::format("| {} | {:.2g} | {:.3g} | {:.2f} × |\n", e.name, run.preparing, us, us / bare);
  }
  return text;
}

// ---- the linear shortcut ----

std::string shortcut() {
  scene::Scene scene = scene::read(examples / "steady.toml");
  const double steady = seconds([&] { steady_run(scene); });
  scene.run->steady = false;
  const Timed run = timed(scene);
  return fmt::format(
      "| {:.0f} s of `examples/steady.toml` | time [s] |\n| --- | --- |\n| transfer functions × sea | {:.2g} |\n| "
      "stepped, "
      "{} steps | {:.2g} |\n| ratio | {:.0f} |\n",
      scene.run->duration, steady, run.record.steps, run.stepping + run.preparing,
      (run.stepping + run.preparing) / steady);
}

// ---- how it grows ----

std::string modules(int columns, int rows, const std::string& joined) {
  std::string text = R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "14 m"
[waves]
kind = "regular"
height = "0.5 m"
period = "6 s"
heading = "20 deg"
ramp = "10 s"
)";
  for (int r = 0; r < rows; ++r)
    text += support::pontoons(columns, fmt::format("(0, {}, 0) m", 13 * r), fmt::format("r{}m", r)) +
            R"([body.hydrodynamics]
file = "data/pontoon1.nc"
interaction = "self"
excitation = true
radiation = { memory_tolerance = 1e-2 }
hydrostatics = true
)";
  const auto bushing = [](const std::string& between, const char* ends) {
    return fmt::format(
        "[[connector]]\nbetween = {}\nends = [{}]\nkind = \"bushing\"\nstiffness = \"(20, 5, 5) kN/m\"\n", between,
        ends);
  };
  for (int r = 0; r < rows && columns > 1; ++r)
    text += joined == "hinged"
                ? fmt::format(
                      "[[joint]]\nname = \"h{0}\"\nbetween = \"neighbours of r{0}m\"\nkind = \"hinge\"\nat = "
                      "\"(6.5, {1}, 0.5) m\"\naxis = \"y\"\n",
                      r, 13 * r)
                : bushing(fmt::format("\"neighbours of r{}m\"", r), "\"(6, 0, 0.5) m\", \"(-6, 0, 0.5) m\"");
  for (int r = 0; r + 1 < rows; ++r)
    for (int c = 1; c <= columns; ++c)
      text += bushing(fmt::format("[\"r{}m{}\", \"r{}m{}\"]", r, c, r + 1, c), "\"(0, 6, 0.5) m\", \"(0, -6, 0.5) m\"");
  return text +
         "[ask]\nrun = { duration = \"10 s\", every = \"0.1 s\", of = [\"r0m1.heave\"] }\naccuracy = "
         "1e-2\n[solve]\nstep "
         "= \"0.1 s\"\n";
}

std::string growth(plot::Panel& panel) {
  std::string text =
      "| modules | how | preparing [s] | a step [ms] | a step and module [µs] |\n| --- | --- | --- | --- | --- |\n";
  struct Shape {
    const char* name;
    bool grid;
    const char* joined;
  };
  for (const Shape& s : {Shape{"chain, sprung", false, "sprung"}, Shape{"chain, hinged", false, "hinged"},
                         Shape{"grid, sprung", true, "sprung"}}) {
    panel.series.push_back({.name = s.name, .x = {}, .y = {}, .marks = true});
    for (const int n : {1, 4, 16, 25, 100, 400}) {
      const int rows = s.grid ? static_cast<int>(std::lround(std::sqrt(n))) : 1;
      if (n == 1 && s.joined == std::string("hinged")) continue;
      const std::string text_of_scene = modules(n / rows, rows, s.joined);
      const Timed run = timed(scene::parse(text_of_scene, examples / "test.toml"));
      const double ms = 1e3 * run.stepping / static_cast<double>(run.record.steps);
      text += fmt::format("| {} | {} | {:.2g} | {:.3g} | {:.3g} |\n", n, s.name, run.preparing, ms, 1e3 * ms / n);
      panel.series.back().x.push_back(n);
      panel.series.back().y.push_back(ms);
    }
  }
  return text;
}

// ---- against a loop by hand ----

/// One module in a regular wave, stepped by nothing but its 6 × 6 matrices.
class ByHand {
 public:
  ByHand(const compile::Prepared& p, const compile::TimeModel& m, double ramp) : h_(m.step), ramp_(ramp) {
    const auto& group = p.groups.front();
    const compile::SymmetricData data(group.table.coefficients(), {0, 1, 2, 3, 4, 5});
    auto chosen = hydro::radiation::choose(data.damping, data.A, data.A_inf,
                                           {.step = h_, .tolerance = 1e-2, .length = {}, .method = {}});
    memory_ = chosen.memory;
    const auto& wave = m.water.sea->components().front();
    omega_ = wave.omega;
    X_ = compile::elevation_at_origin(wave) * group.table.excitation(omega_, wave.heading);
    M_ = chosen.A_inf;
    M_.topLeftCorner<3, 3>() += p.bodies.front().mass() * Eigen::Matrix3d::Identity();
    M_.bottomRightCorner<3, 3>() += p.bodies.front().inertia();
    C_.setZero();
    C_.block<3, 3>(2, 2) = p.hydrostatics.front().stiffness;
    now_ = memory_->instantaneous(1 - of_.alpha_f);
    lu_.compute((1 - of_.alpha_m) * M_ + (1 - of_.alpha_f) * (of_.beta * h_ * h_ * C_ + of_.gamma * h_ * now_));
  }

  /// Heave of the centre of gravity, m.
  std::vector<double> run(std::size_t steps) const {
    using dynamics::Vector6;
    const double am = of_.alpha_m, af = of_.alpha_f;
    Vector6 u = Vector6::Zero(), v = u, a = u;
    const auto past = memory_->start(v);
    std::vector<double> heave{0};
    for (std::size_t n = 0; n < steps; ++n) {
      const double t = (static_cast<double>(n) + 1 - af) * h_;
      const double grown = t < ramp_ ? 0.5 - 0.5 * std::cos(std::numbers::pi * t / ramp_) : 1;
      const Vector6 push = grown * (X_ * std::polar(1.0, omega_ * t)).real();
      const Vector6 u_next = u + h_ * v + h_ * h_ * (0.5 - of_.beta) * a, v_next = v + h_ * (1 - of_.gamma) * a;
      const Vector6 u_mid = (1 - af) * u_next + af * u, v_mid = (1 - af) * v_next + af * v;
      const Vector6 a_next = lu_.solve(push - am * M_ * a - C_ * u_mid - now_ * v_mid - past->history_force(1 - af));
      u = u_next + h_ * h_ * of_.beta * a_next;
      v = v_next + h_ * of_.gamma * a_next;
      a = a_next;
      past->accept(v);
      heave.push_back(u[2]);
    }
    return heave;
  }

 private:
  dynamics::AlphaParameters of_{0.8};
  double h_, ramp_, omega_ = 0;
  std::shared_ptr<const hydro::radiation::MemoryMethod> memory_;
  Eigen::Matrix<std::complex<double>, 6, 1> X_;
  dynamics::Matrix6 M_, C_, now_;
  Eigen::PartialPivLU<dynamics::Matrix6> lu_;
};

std::string hand_loop() {
  scene::Scene scene = scene::parse(modules(1, 1, "sprung"), examples / "test.toml");
  scene.run->duration = 400;
  const Timed run = timed(scene);
  const compile::Prepared prepared = compile::prepare(scene);
  const compile::TimeModel model = compile::time_model(scene, prepared);
  const ByHand hand(prepared, model, scene.waves->ramp);
  std::vector<double> heave;
  double least = std::numeric_limits<double>::infinity();
  for (int again = 0; again < 3; ++again) least = std::min(least, seconds([&] { heave = hand.run(model.steps); }));
  // The origin moves with pitch, the centre of gravity above it in heave alone, to first order.
  const double error = off(heave, run.record.signal("r0m1.heave"));
  hydro::require(error < 0.01, "by hand and by the program heave is {} apart", error);
  const auto steps = static_cast<double>(run.record.steps);
  return fmt::format(
      "| one module, {} steps of {} s | a step [µs] |\n| --- | --- |\n| `froude run` | {:.3g} |\n| matrices by hand | "
      "{:.3g} |\n| ratio | {:.2f} |\n\nBoth heave alike to {:.1g}.\n",
      run.record.steps, model.step, 1e6 * run.stepping / steps, 1e6 * least / steps, run.stepping / least, error);
}

// ---- catenaries from tables ----

std::string catenaries() {
  using dynamics::CatenaryTable, dynamics::LineProperties;
  const LineProperties chain{902.2, (77.7066 - 1025 * std::numbers::pi / 4 * 0.09 * 0.09) * 9.80665, 384.243e6, true};
  constexpr double x0 = 848.67, z0 = 250, reach = 10;
  constexpr int count = 200'000;
  double sum = 0;
  const auto each = [&](const auto& pull) {
    return 1e6 / count * seconds([&] {
             for (int i = 0; i < count; ++i)
               sum += pull(x0 + 0.99 * reach * std::sin(0.1 * i), z0 + 0.99 * reach * std::sin(0.0731 * i));
           });
  };
  const double solved = each([&](double x, double z) { return catenary(chain, x, z).horizontal; });
  std::string text = fmt::format(
      "| tolerance | cells a side | error, N of {:.3g} N | making it [ms] | a pull [µs] | solved [µs] |\n| --- | --- | "
      "--- | "
      "--- | --- | --- |\n",
      catenary(chain, x0 + reach, z0 + reach).fairlead());
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5}) {
    std::optional<CatenaryTable> table;
    const double making = seconds([&] {
      table.emplace(chain, dynamics::Reach{x0 - reach, x0 + reach, z0 - reach, z0 + reach}, tolerance);
    });
    const double one = each([&](double x, double z) { return table->at(x, z).horizontal; });
    text += fmt::format("| {:.0e} | {} | {:.2g} | {:.2g} | {:.2g} | {:.2g} |\n", tolerance, table->cells(),
                        table->error(), 1e3 * making, one, solved);
  }
  hydro::require(std::isfinite(sum), "a pull is not finite");
  return text;
}

void write(const fs::path& data, const fs::path& folder) {
  const auto panel = [](const std::string& of) {
    return plot::Panel{.x = {.label = "time per simulated second", .unit = "ms", .scale = plot::Scale::logarithmic},
                       .y = {.label = "error, " + of, .scale = plot::Scale::logarithmic},
                       .series = {}};
  };
  plot::Panel array = panel("five modules"), pendulum = panel("pendulum that rubs"), buoy = panel("buoy");
  plot::Panel grown{.x = {.label = "modules", .scale = plot::Scale::logarithmic},
                    .y = {.label = "a step", .unit = "ms", .scale = plot::Scale::logarithmic},
                    .series = {}};
  scene::Scene five = scene::read(examples / "pontoon5.toml"), one = scene::read(examples / "buoy.toml");
  five.run->duration = 60;  // after some 80 s the row buckles, and motions of any two steps part
  five.run->every = 0.4;
  one.run->duration = 100;
  one.run->every = 0.8;
  std::string text =
      "# What runs of bodies cost\n\nWritten by `price_motion` (validation/cost/motion), one core, processor time, the "
      "better of two runs" +
      std::string(with_assertions ? "; the library with its internal assertions" : "") + ".\n\n";
  text +=
      "## Runs that others have timed\n\nTheirs are those reported for the strongest peer, on a machine of the same "
      "kind, on another day.\n\n" +
      peers(data);
  text +=
      "\n## Methods by step\n\n![error against time](motion.svg)\n\nFive modules of `examples/pontoon5.toml`, 60 s of "
      "sea, "
      "before the row buckles; the heave of the first.\n\n" +
      scene_methods(five, "m1.heave", {0.2, 0.1, 0.05, 0.025}, array);
  text += "\nThe buoy of `examples/buoy.toml`, 100 s; the rack's stroke.\n\n" +
          scene_methods(one, "rack.stroke", {0.2, 0.1, 0.05, 0.025}, buoy);
  text += "\nA double pendulum whose hinges rub, 4 s; heights of both rods.\n\n" + pendulum_methods(pendulum);
  text += "\n## Effects one at a time\n\nFive modules, 30 degrees of freedom, 600 steps of 0.1 s.\n\n" + effects();
  text += "\n## Without stepping\n\n" + shortcut();
  text +=
      "\n## How it grows\n\nModules that do not feel each other's waves, each with its own memory, in regular "
      "waves.\n\n" +
      growth(grown);
  text += "\n## Against a loop by hand\n\n" + hand_loop();
  text +=
      "\n## Catenaries from tables\n\nThe chain of the OC3 spar, its fairlead within 10 m of rest.\n\n" + catenaries();
  hydro::io::write_atomically(folder / "motion.md", text);
  hydro::io::write_atomically(folder / "motion.svg", plot::svg({.title = "What runs of bodies cost",
                                                                .panels = {array, buoy, pendulum, grown}}));
}

}  // namespace
}  // namespace froude::cost

int main(int count, char** argument) {
  if (count != 3) {
    std::cerr << "usage: price_motion REFERENCE_DATA FOLDER\n";
    return 2;
  }
  try {
    froude::cost::write(argument[1], argument[2]);
  } catch (const std::exception& e) {
    std::cerr << "price_motion: " << e.what() << "\n";
    return 1;
  }
  return 0;
}
