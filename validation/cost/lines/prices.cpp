/// \file  Writes the price list of lines: docs/cost/lines.md and its picture. See README.md.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "dynamics/line/equilibrium.hpp"
#include "dynamics/line/stepper.hpp"
#ifdef FROUDE_SUNDIALS
#include "dynamics/line/sundials_reference.hpp"
#endif
#include "answers/plot.hpp"
#include "harness/oc3_line.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/waves/kinematics/sea.hpp"
#include "hydro/waves/synthesis/summed_field.hpp"
#include "support/line_models.hpp"

namespace froude::cost {
namespace {

namespace dl = dynamics::line;
constexpr double pi = std::numbers::pi;

/// Milliseconds of processor time.
class Watch {
 public:
  double ms() const { return 1e3 * static_cast<double>(std::clock() - begin_) / CLOCKS_PER_SEC; }

 private:
  std::clock_t begin_ = std::clock();
};

// ---- the mooring line ----

struct Moored {
  std::vector<double> tension;  ///< at the fairlead every 0.1 s from 20 s on, N
  double ms_per_s;
};

Moored moored(int segments, double h, double duration, const dl::Stepper::Settings& settings) {
  const validation::MooringLine m = validation::oc3_line();
  const dl::Line line(m.description(segments, std::make_shared<validation::Oc3Moved>(m.fairlead)));
  dl::State s = m.at_rest(segments);
  dl::Stepper stepper(line, settings);
  stepper.start(s);
  Moored out;
  double working = 0;
  const auto per_sample = static_cast<int>(std::lround(0.1 / h));
  for (int i = 1; i <= static_cast<int>(std::lround(10 * duration)); ++i) {
    const Watch watch;
    for (int k = 0; k < per_sample; ++k) stepper.step(s, h);
    working += watch.ms();
    if (i > 200) out.tension.push_back(stepper.balance(s)->holding.rightCols<1>().norm());
  }
  out.ms_per_s = working / duration;
  return out;
}

dl::Stepper::Settings alpha(double tolerance) {
  return {.scheme = dl::Scheme::generalised_alpha, .tolerance = tolerance};
}
dl::Stepper::Settings rosenbrock(double local_error) {
  return {.scheme = dl::Scheme::rosenbrock, .local_error = local_error};
}

// ---- the explicit peer ----

/// What another program takes for the same line, asked of a driver that this program is given; see README.md.
class Peer {
 public:
  /// The longest step at which it is stable, s, and its time when it was last asked, ms/s.
  struct Known {
    double step, ms_per_s;
  };
  explicit Peer(std::string driver) : driver_(std::move(driver)) {}
  bool is_here() const { return !driver_.empty(); }

  static Known known(int segments) {
    const std::map<int, Known> all{
        {20, {0.00625, 0.72}}, {50, {0.00625, 1.7}}, {100, {0.00417, 4.5}}, {200, {0.0021, 19}}};
    return all.at(segments);
  }
  Moored run(int segments, double step) const {
    const std::unique_ptr<FILE, int (*)(FILE*)> answer(
        popen(fmt::format("'{}' {} {}", driver_, segments, step).c_str(), "r"), pclose);
    Moored out;
    double value = 0;
    hydro::require(answer && std::fscanf(answer.get(), "%lf", &out.ms_per_s) == 1, "{} tells no time", driver_);
    while (std::fscanf(answer.get(), "%lf", &value) == 1) out.tension.push_back(value);
    hydro::require(out.tension.size() == 100, "{} tells {} tensions, not 100", driver_, out.tension.size());
    return out;
  }

 private:
  std::string driver_;
};

/// Root mean square difference over the range of the reference.
double difference(const Moored& a, const Moored& reference) {
  double sum = 0, low = 1e12, high = 0;
  for (std::size_t i = 0; i < a.tension.size(); ++i) {
    sum += std::pow(a.tension[i] - reference.tension[i], 2);
    low = std::min(low, reference.tension[i]);
    high = std::max(high, reference.tension[i]);
  }
  return std::sqrt(sum / static_cast<double>(a.tension.size())) / (high - low);
}

/// The error of so many segments is not asked: the reference has fewer.
constexpr int longest = 1000;

std::string mooring_list(const Peer& peer) {
  constexpr double exact = 911.09;  // kN, closed form
  const Moored reference = moored(200, 0.0125, 30, alpha(1e-9));
  std::string text =
      "| segments | rest [ms] | static tension off by | step [s] | time [ms/s] | error | explicit peer [ms/s] |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const int n : {20, 50, 100, 200, longest}) {
    const validation::MooringLine m = validation::oc3_line();
    const Watch watch;
    const dl::State rest = m.at_rest(n);
    const double rest_ms = watch.ms();
    const double off = validation::end_pulls(m, rest).fairlead.norm() / 1e3 / exact - 1;
    hydro::require(std::abs(off) < 1e-4, "{} segments: the static tension is off by {}", n, off);
    const auto theirs = [&] {
      const Peer::Known known = Peer::known(n);
      return fmt::format("{:.3g}", peer.is_here() ? peer.run(n, known.step).ms_per_s : known.ms_per_s);
    };
    for (const double h : {0.1, 0.05}) {
      const Moored run = moored(n, h, 30, alpha(1e-6));
      const double error = n == longest ? 0 : difference(run, reference);
      hydro::require(error < 0.1, "{} segments, step {} s: off by {}", n, h, error);
      text += fmt::format("| {} | {:.2g} | {:.1g} % | {} | {:.3g} | {} | {} |\n", n, rest_ms, 100 * off, h,
                          run.ms_per_s, n == longest ? "–" : fmt::format("{:.1g} %", 100 * error),
                          h == 0.1 && n != longest ? theirs() : "");
    }
  }
  return text;
}

/// One method at ever finer settings: its rows, and its curve.
class StepRows {
 public:
  StepRows(int segments, std::string method, const Moored& limit)
      : segments_(segments), method_(std::move(method)), limit_(limit) {
    curve_ = {.name = fmt::format("{}, {}", method_, segments_), .x = {}, .y = {}, .marks = true};
  }
  /// \throws where an error does not fall
  std::string finer(const std::string& setting, const Moored& run) {
    const double before = curve_.y.empty() ? 1 : curve_.y.back();
    std::string out = row(setting, run);
    hydro::require(curve_.y.back() < before, "{} segments, {} of {}: off by {}, more than before", segments_, method_,
                   setting, curve_.y.back());
    return out;
  }
  /// The same, whatever the error.
  std::string row(const std::string& setting, const Moored& run) {
    const double error = difference(run, limit_);
    curve_.x.push_back(run.ms_per_s);
    curve_.y.push_back(error);
    return fmt::format("| {} | {} | {} | {:.3g} | {:.2g} |\n", segments_, method_, setting, run.ms_per_s, error);
  }
  const plot::Series& curve() const { return curve_; }

 private:
  int segments_;
  std::string method_;
  const Moored& limit_;
  plot::Series curve_;
};

/// What the step alone makes of the error, against the same segments by steps of which no error is left; the peer's
/// against its own at an eighth of the step.
std::string step_list(const Peer& peer, std::vector<plot::Panel>& panels) {
  std::string text =
      "| segments | method | step or tolerance | time [ms/s] | error of the step |\n"
      "| --- | --- | --- | --- | --- |\n";
  for (const int n : {20, 50, 100, 200}) {
    const Moored limit = moored(n, 0.1, 30, rosenbrock(1e-7));
    StepRows implicit(n, "generalised-α", limit), own(n, "rosenbrock", limit);
    for (const double h : {0.1, 0.05, 0.025, 0.0125, 0.00625})
      text += implicit.finer(fmt::format("{} s", h), moored(n, h, 30, alpha(1e-6)));
    for (const double tolerance : {1e-3, 3e-4, 1e-4, 1e-5})
      text += own.finer(fmt::format("{:.0e}", tolerance), moored(n, 0.1, 30, rosenbrock(tolerance)));
    std::vector<plot::Series> curves{implicit.curve(), own.curve()};
    if (peer.is_here()) {
      const double h = Peer::known(n).step;
      const Moored finest = peer.run(n, h / 8);
      StepRows theirs(n, "explicit peer", finest);
      for (const double step : {h, h / 2}) text += theirs.row(fmt::format("{:.3g} s", step), peer.run(n, step));
      curves.push_back(theirs.curve());
    }
    if (n == 50 || n == 100) continue;  // they lie between
    plot::Panel panel;
    panel.series = std::move(curves);
    panel.x = {.label = "time per simulated second", .unit = "ms", .scale = plot::Scale::logarithmic};
    panel.y = {.label = "rms error of the step over the range", .scale = plot::Scale::logarithmic};
    panels.push_back(std::move(panel));
  }
  return text;
}

// ---- loops of links ----

/// One second of a loop of n links swung across, undamped: microseconds a node and step, and the energy lost.
std::string loop_row(int n, const dl::Stepper::Settings& settings) {
  const dl::Line line(support::loop(n));
  dl::State s = dl::hanging_shape(line, support::ends_at(line, {2.5, 0, 0}));
  for (int i = 1; i < n; ++i) s.velocity(1, i) = std::sin(pi * i / n);
  dl::Stepper stepper(line, settings);
  stepper.start(s);
  const double lively = stepper.energies().kinetic, h = 0.01;
  int iterations = 0;
  const Watch watch;
  try {
    for (int i = 0; i < 100; ++i) iterations += stepper.step(s, h).newton_iterations;
  } catch (const hydro::NumericsError&) {
    return " – | – | – |";
  }
  return fmt::format(" {:.3g} | {:.2f} | {:.1g} |", watch.ms() * 10 / (n + 1), iterations / 100.0,
                     std::abs(stepper.energies().residual()) / lively);
}

#ifdef FROUDE_SUNDIALS
/// Places after one second by each scheme, against CVODE's at 1e-9.
std::string against_sundials() {
  std::string text = "| links | method | time of 1 s [ms] | places off, rms [m] |\n| --- | --- | --- | --- |\n";
  for (const int n : {7, 20, 100}) {
    const dl::Line line(support::loop(n));
    dl::State begin = dl::hanging_shape(line, support::ends_at(line, {2.5, 0, 0}));
    for (int i = 1; i < n; ++i) begin.velocity(1, i) = std::sin(pi * i / n);
    dl::State exact = begin;
    dl::run_by_sundials(line, exact, 1, 1e-9);
    const auto row = [&](const std::string& name, double ms, const dl::State& end) {
      const double off = (end.position - exact.position).norm() / std::sqrt(n + 1.0);
      text += fmt::format("| {} | {} | {:.3g} | {:.1g} |\n", n, name, ms, off);
    };
    for (const double tolerance : {1e-4, 1e-6}) {
      dl::State s = begin;
      const Watch watch;
      dl::run_by_sundials(line, s, 1, tolerance);
      row(fmt::format("CVODE, {:.0e}", tolerance), watch.ms(), s);
    }
    for (const auto scheme :
         {dl::Scheme::energy_momentum, dl::Scheme::generalised_alpha, dl::Scheme::semi_implicit_euler})
      for (const double h : {0.01, 0.0025}) {
        dl::State s = begin;
        dl::Stepper stepper(line, {.scheme = scheme});
        stepper.start(s);
        const Watch watch;
        for (int i = 0; i < static_cast<int>(std::lround(1 / h)); ++i) stepper.step(s, h);
        row(fmt::format("{}, {} s", dl::name_of(scheme), h), watch.ms(), s);
      }
  }
  return "\n## Against SUNDIALS\n\nThe same loops after 1 s, by CVODE's backward differences with dense matrices as "
         "the reference.\n\n" +
         text;
}
#else
std::string against_sundials() { return ""; }
#endif

std::string loop_list() {
  std::string text =
      "| scheme | links | µs a node and step | Newton iterations a step | energy not accounted for, of the kinetic "
      "|\n| --- | --- | --- | --- | --- |\n";
  struct Named {
    const char* name;
    dl::Stepper::Settings settings;
  };
  for (const Named& s :
       {Named{"energy-momentum", {}}, Named{"generalised-α, 0.8", {.scheme = dl::Scheme::generalised_alpha}},
        Named{"γ = 0.51", {.scheme = dl::Scheme::gamma}},
        Named{"implicit Euler", {.scheme = dl::Scheme::gamma, .gamma = 1}},
        Named{"semi-implicit Euler", {.scheme = dl::Scheme::semi_implicit_euler}},
        Named{"explicit Euler", {.scheme = dl::Scheme::explicit_euler}}})
    for (const int n : {7, 20, 100, 1000, 10000}) {
      // What must be halved a thousand times over would take hours to say that it cannot go on.
      if (s.settings.scheme >= dl::Scheme::semi_implicit_euler && n > 100) continue;
      text += fmt::format("| {} | {} |{}\n", s.name, n, loop_row(n, s.settings));
    }
  return text;
}

// ---- the water by itself ----

std::string water_list() {
  std::string text =
      "| waves | nodes | of the waves at all nodes once [µs] | whole step with them [µs] | without [µs] |\n| --- | --- "
      "| --- | --- | --- |\n";
  const hydro::Water water{.density = 1000, .gravity = 9.81, .depth = hydro::WaterDepth::from_metres(30)};
  for (const int waves : {1, 100, 231}) {
    std::vector<hydro::waves::GivenWave> list;
    for (int i = 0; i < waves; ++i)
      list.push_back({hydro::AngularFrequency::from_period_s(4 + 8.0 * i / waves),
                      hydro::WaveAmplitude::from_metres(0.05), 0.1 * i * i, hydro::Angle::from_degrees(90)});
    const auto field = std::make_shared<hydro::waves::SummedField>(hydro::waves::linear_field(
        hydro::waves::Sea::of(list, water), {.stretching = hydro::waves::Stretching::vertical}));
    dl::Description d = support::loop(18);
    for (dl::Segment& s : d.segments) s.diameter = 0.05, s.cd = 2;
    const auto step_us = [](const dl::Description& of) {
      const dl::Line line(of);
      dl::State s = dl::hanging_shape(line, support::ends_at(line, {2.5, 0, 0}));
      dl::Stepper stepper(line, {});
      stepper.start(s);
      const Watch watch;
      for (int i = 0; i < 500; ++i) stepper.step(s, 0.03);
      return watch.ms() * 1e3 / 500;
    };
    const double dry = step_us(d);
    d.water = {.field = field, .wet = dl::Wet::all};
    std::vector<Eigen::Vector3d> points(19, Eigen::Vector3d(1, 1, -3));
    std::vector<hydro::waves::Kinematics> out(19);
    const Watch watch;
    for (int i = 0; i < 2000; ++i) field->at(0.01 * i, points, out);
    const double alone = watch.ms() * 1e3 / 2000;
    text += fmt::format("| {} | 19 | {:.3g} | {:.3g} | {:.3g} |\n", waves, alone, step_us(d), dry);
  }
  return text;
}

}  // namespace
}  // namespace froude::cost

int main(int argc, char** argv) {
  using namespace froude::cost;
  if (argc != 2 && argc != 3) {
    std::cerr << "usage: price_lines FOLDER [DRIVER]\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const Peer peer(argc == 3 ? argv[2] : "");
  std::vector<froude::plot::Panel> panels;
  std::string text =
      "# What lines cost\n\nWritten by `price_lines` (validation/cost/lines), one core, processor time, other work "
      "beside it.\n\n"
      "## The OC3 mooring line\n\n902 m of chain on a bed, catenary segments, generalised-α; the fairlead moved by 2 m "
      "and 1 m at 10 s (case oc3-line). "
      "The error is the root mean square over the range of the tension from 20 to 30 s, against 200 segments "
      "and a step of 12.5 ms. " +
      std::string(peer.is_here() ? "The explicit peer ran beside, at the longest step at which it is stable.\n\n"
                                 : "Times of the explicit peer are those of 26 November 2026, at the longest step at "
                                   "which it is stable.\n\n");
  text += mooring_list(peer);
  text +=
      "\nUp to 200 segments the time is linear in their number, half a microsecond a node and iteration. At 1 000 a "
      "node "
      "costs half as much again, and almost half of the time goes into the first second, in which the fairlead is set "
      "off at "
      "once at its\nfull speed: segments of 0.9 m touch down several at a time, Newton halves steps and takes up to a "
      "hundred iterations and more. From 1 s on it takes four or five a step. Fewer catenary segments have the same "
      "tension. The error hardly\ndepends on the number of segments: 20 catenary segments have a static tension nearer "
      "to the "
      "catenary than 200 straight ones of the peer (0.1 % off), at a twentieth of the time.\n"
      "\n### What the step alone costs\n\nThe same over the same range, against the same segments by `rosenbrock` at a "
      "tolerance of 1e-7; the explicit peer against itself at an eighth of the step.\n\n![error of the step against "
      "time](lines.svg)\n\n";
  text += step_list(peer, panels);
  text +=
      "\nAt 50 ms and more axial waves along the chain, which the fairlead sets off at once, are not resolved by "
      "generalised-α, and its error hardly falls. `rosenbrock` has the step of the run, 0.1 s, as its longest, and "
      "cuts "
      "it by its own error; a step costs about 0.9 µs a node. The explicit peer is unstable at twice its longest step. "
      "On 26 November 2026, with the peer in the same run, `rosenbrock` was faster than it at the same error of the "
      "step with every number of segments: 2.8, 1.3, 1.8 and 2.5 times with 20, 50, 100 and 200, straight between "
      "the rows of that day. Where 2 % will do, generalised-α with 0.1 s is as cheap. Over a run of a minute as a "
      "whole both are ahead of the peer, which needs 0.07 s with 20 segments and 10 s with 200 to come to rest.\n"
      "\n## Loops of links\n\n17 m in n links, swung across at 1 m/s, nothing damps, step 10 ms. A dash: the scheme "
      "could not go on.\n\n";
  text += loop_list();
  text += against_sundials();
  text +=
      "\n## Waves at the nodes\n\nThe dropper of 18 links, step 30 ms; the waves are asked once an iteration and once "
      "more for the ledger.\n\n";
  text += water_list();
  hydro::io::write_atomically(folder / "lines.md", text);
  hydro::io::write_atomically(
      folder / "lines.svg",
      froude::plot::svg({.title = "OC3 line: error of the step against time, 20 and 200 segments", .panels = panels}));
  return 0;
}
