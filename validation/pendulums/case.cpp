#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "fit/decay.hpp"
#include "harness/case.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv.hpp"

namespace froude::validation::pendulums {
namespace {

using fit::MotionLaw;

/// Windows of `seconds` from the start of a record, every `keep`-th sample of the columns named.
std::vector<fit::Window> windows(const hydro::io::CsvTable& table, const std::vector<std::string>& columns, double step,
                                 int keep, double seconds, int count) {
  std::vector<fit::Window> out;
  const auto n = static_cast<Eigen::Index>(std::lround(seconds / (step * keep))) + 1;
  for (int w = 0; w < count; ++w) {
    fit::Window window{step * keep, Eigen::MatrixXd(n, std::ssize(columns))};
    for (Eigen::Index c = 0; c < std::ssize(columns); ++c)
      for (Eigen::Index j = 0; j < n; ++j)
        window.values(j, c) =
            table.column(columns[static_cast<std::size_t>(c)])[static_cast<std::size_t>((w * (n - 1) + j) * keep)];
    out.push_back(std::move(window));
  }
  return out;
}

void append(std::vector<fit::Window>& all, std::vector<fit::Window> more) {
  for (auto& w : more) all.push_back(std::move(w));
}

const std::vector<std::string> swings{"id_1", "id_2", "id_3", "id_4", "vad_1", "vad_2"};

/// The record of one file of the single arm.
hydro::io::CsvTable swing(const Folders& folders, const std::string& name) {
  return hydro::io::CsvTable::read(folders.shared("pendulum_encoder/single/" + name + ".csv"));
}

std::vector<fit::Window> swing_windows(const Folders& folders, const std::string& name) {
  return windows(swing(folders, name), {"theta_rad"}, 0.002, 5, 2, 4);
}

/// The law of the single arm, which hangs at π, to windows of 2 s of these files.
fit::ShootingProblem single_problem(const Folders& folders, const std::vector<std::string>& names) {
  fit::ShootingProblem p{.law = MotionLaw::pendulum,
                         .windows = {},
                         .deviations = {0.002},
                         .start = {8, 0.06, 0.01, 0, 0.1, std::numbers::pi},
                         .fitted = {true, true, true, false, true, true}};
  for (const std::string& name : names) append(p.windows, swing_windows(folders, name));
  return p;
}

/// The same law with the parameters of a fit, to other windows; initial states are fitted, and the parameters named.
fit::ShootingProblem held(const fit::ShootingProblem& of, const fit::ShootingFit& at, std::vector<fit::Window> windows,
                          const std::vector<std::size_t>& free = {}) {
  fit::ShootingProblem out = of;
  out.windows = std::move(windows);
  out.fitted.assign(at.parameters.size(), false);
  for (const std::size_t k : free) out.fitted[k] = true;
  for (std::size_t k = 0; k < at.parameters.size(); ++k) out.start[k] = *at.parameters[k].value;
  return out;
}

double held_residual(const Folders& folders, const std::vector<std::string>& fitted,
                     const std::vector<std::string>& others) {
  const auto p = single_problem(folders, fitted);
  const auto f = fit::fit_motion(p);
  return fit::fit_motion(held(p, f, single_problem(folders, others).windows)).rms[0] / f.rms[0];
}

/// How far each file begins from where the one before ended, rad: they are pieces of one decay.
double largest_gap(const Folders& folders) {
  double out = 0, last = 0;
  for (const std::string& name : swings) {
    const hydro::io::CsvTable table = swing(folders, name);
    const auto& angle = table.column("theta_rad");
    if (name != swings.front()) out = std::max(out, std::abs(angle.front() - last));
    last = angle.back();
  }
  return out;
}

/// Each window of 2 s with a frequency and a Coulomb friction of its own: how they go with the size of the swing.
void single_by_size(const Folders& folders, const fit::ShootingProblem& p, const fit::ShootingFit& f,
                    Outcome& outcome) {
  plot::Series frequency{.name = "", .x = {}, .y = {}, .marks = true};
  plot::Series fitted{.name = "of the four files fitted", .x = {}, .y = {}, .dashed = true};
  double worst = 0;
  for (const std::string& name : swings)
    for (fit::Window& window : swing_windows(folders, name)) {
      const double size = (window.values.array() - std::numbers::pi).abs().maxCoeff();
      const auto own = fit::fit_motion(held(p, f, {std::move(window)}, {0, 4}));
      frequency.x.push_back(size), frequency.y.push_back(*own.parameters[0].value);
      fitted.x.push_back(size), fitted.y.push_back(*f.parameters[0].value);
      if (name.starts_with("vad")) worst = std::max(worst, own.rms[0] / f.rms[0]);
    }
  const double smallest = frequency.y.back() / *f.parameters[0].value - 1;
  outcome.numbers.push_back({"single: smallest swing of the files fitted", frequency.x[15], "rad"});
  outcome.numbers.push_back({"single: smallest swing of the others", frequency.x.back(), "rad"});
  outcome.numbers.push_back({"single: frequency of the smallest swings over that, less one", smallest, ""});
  outcome.numbers.push_back({"single: others, each window with its own frequency and Coulomb friction", worst, ""});
  outcome.pictures.push_back({"frequency",
                              "Frequency of the single arm over the size of its swings, each of 2 s.",
                              {.title = "A swing that dies away",
                               .panels = {{.x = {"largest angle from rest", "rad"},
                                           .y = {"frequency of a small swing", "rad/s"},
                                           .series = {frequency, fitted}}}}});
}

/// The single arm: windows of 2 s from the first four files, and the law so fitted held against the rest.
void single(const Folders& folders, Outcome& outcome) {
  const auto p = single_problem(folders, {"id_1", "id_2", "id_3", "id_4"});
  const auto f = fit::fit_motion(p);
  const auto& omega = f.parameters[0];
  outcome.numbers.push_back({"single: natural frequency", *omega.value, "rad/s"});
  outcome.numbers.push_back(
      {"single: half width of its interval", (omega.interval.high - omega.interval.low) / 2, "rad/s"});
  outcome.numbers.push_back({"single: residual over windows of 2 s", f.rms[0], "rad"});
  const auto others = held(p, f, single_problem(folders, {"vad_1", "vad_2"}).windows);
  outcome.numbers.push_back(
      {"single: residual of other runs over that", fit::fit_motion(others).rms[0] / f.rms[0], ""});
  outcome.numbers.push_back({"single: residual of a file among those fitted that was held back",
                             held_residual(folders, {"id_1", "id_2", "id_4"}, {"id_3"}), ""});
  outcome.numbers.push_back(
      {"single: largest step from a file's end to the next one's begin", largest_gap(folders), "rad"});
  single_by_size(folders, p, f, outcome);
}

/// The double arm: windows of half a second, angles from the upright.
void twice(const Folders& folders, Outcome& outcome) {
  const std::vector<std::string> angles{"theta1_rad", "theta2_rad"};
  const auto read = [&](const std::string& name) {
    return hydro::io::CsvTable::read(folders.shared("pendulum_encoder/double/" + name + ".csv"));
  };
  fit::ShootingProblem p{.law = MotionLaw::double_pendulum,
                         .windows = {},
                         .deviations = {0.002, 0.002},
                         .start = {0.49, 0.56, 61, 28, 0.04, 0.002},
                         .fitted = std::vector<bool>(6, true)};
  for (const char* name : {"id_1", "id_5", "id_9", "id_13", "id_17", "id_21", "id_25"})
    append(p.windows, windows(read(name), angles, 0.001, 5, 0.5, 2));
  const auto f = fit::fit_motion(p);
  outcome.numbers.push_back({"double: residual of the first angle over 0.5 s", f.rms[0], "rad"});
  outcome.numbers.push_back({"double: residual of the second angle over 0.5 s", f.rms[1], "rad"});
  double wide = 0;
  for (std::size_t k = 0; k < 4; ++k)
    wide = std::max(wide, f.parameters[k].standard_error / std::abs(*f.parameters[k].value));
  outcome.numbers.push_back({"double: largest relative standard error of inertia and gravity", wide, ""});
  outcome.numbers.push_back({"double: coupling over the first inertia", *f.parameters[0].value, ""});
  outcome.numbers.push_back({"double: gravity of the first arm over its inertia", *f.parameters[2].value, "1/s^2"});
  fit::ShootingProblem check = p;
  check.windows.clear();
  check.fitted.assign(6, false);
  for (std::size_t k = 0; k < 6; ++k) check.start[k] = *f.parameters[k].value;
  for (const char* name : {"vad_1", "vad_2", "vad_3", "vad_4"})
    append(check.windows, windows(read(name), angles, 0.001, 5, 0.5, 2));
  const auto other = fit::fit_motion(check);
  outcome.numbers.push_back(
      {"double: residual of other runs over that", std::max(other.rms[0] / f.rms[0], other.rms[1] / f.rms[1]), ""});
}

/// A mass on springs, tracked by camera (Schmidt & Lipson 2009): pixels, 30 frames a second.
void spring(const Folders& folders, Outcome& outcome) {
  std::istringstream text(hydro::io::read_text(folders.shared("pendulum_camera/schmidt_lipson/real_linear_h_1.txt")));
  std::string line;
  std::vector<double> x;
  while (std::getline(text, line)) {
    std::istringstream row(line);
    double trial = 0, time = 0, at = 0;
    if (row >> trial >> time >> at) x.push_back(at);
  }
  const std::vector<fit::Window> record{{1.0 / 30, Eigen::Map<const Eigen::VectorXd>(x.data(), std::ssize(x))}};
  const auto f = fit::fit_decay(record, {.terms = {.linear = true, .coulomb = true}});
  outcome.numbers.push_back({"camera: residual of linear and Coulomb damping over the first amplitude",
                             f.motion.rms[0] / std::abs(x[0] - *f.motion.parameters[5].value), ""});
}

}  // namespace

Outcome outcome(const Folders& folders) {
  Outcome outcome;
  single(folders, outcome);
  twice(folders, outcome);
  spring(folders, outcome);
  return outcome;
}

}  // namespace froude::validation::pendulums
