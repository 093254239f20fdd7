/// \file  Writes the price list of coefficients of cylinders: docs/cost/cylinders.md and its picture. See README.md.
///
/// Modules of four cylinders (Fagerbakke 2023, table 3.1) as in the panel data of generated-bem. Error: largest
/// difference of A, B and X from a solution with one more digit than the best on the list, each over its two modes.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "answers/plot.hpp"
#include "cost/price_list.hpp"
#include "hydro/cylinders/solve.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude::cost {
namespace {

using namespace hydro::cylinders;
using Clock = std::chrono::steady_clock;
using hydro::potential::Coefficients;

constexpr int frequencies = 60;
const hydro::Water water{.density = 1000, .gravity = 9.81, .depth = hydro::WaterDepth::from_metres(14)};
const std::vector<double> headings{0, 0.5, 1.0, 1.5};

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// `along` × `across` modules 13 m apart; one cylinder if there is no module.
std::vector<CylinderBody> layout(int along, int across) {
  std::vector<CylinderBody> bodies;
  if (along == 0) return {{"cylinder", {0, 0, 0}, {}, {{{0, 0}, 0.8, 1.13}}}};
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < across; ++j) {
      CylinderBody body{"module", {13.0 * i, 13.0 * j, 0}, {}, {}};
      for (const double dx : {-5.2, 5.2})
        for (const double dy : {-5.2, 5.2}) body.cylinders.push_back({{13.0 * i + dx, 13.0 * j + dy}, 0.8, 1.13});
      bodies.push_back(body);
    }
  return bodies;
}

/// From 0.2 to 4 rad/s, the middles of `count` equal parts.
std::vector<double> omegas(int count) {
  std::vector<double> omega;
  for (int i = 0; i < count; ++i) omega.push_back(0.2 + 3.8 * (i + 0.5) / count);
  return omega;
}

Options options(double tolerance) { return {.tolerance = tolerance, .threads = 1, .doubled_frequencies = 0}; }

/// Largest diagonal entries over all frequencies, at least a hundredth of the largest of the kind (P11).
Eigen::VectorXd sizes(const std::vector<Eigen::MatrixXd>& matrices) {
  Eigen::VectorXd size = Eigen::VectorXd::Zero(matrices.front().rows());
  for (const auto& M : matrices) size = size.cwiseMax(M.diagonal().cwiseAbs());
  Eigen::Vector2d largest = Eigen::Vector2d::Zero();
  for (Eigen::Index i = 0; i < size.size(); ++i) largest(i % 6 / 3) = std::max(largest(i % 6 / 3), size(i));
  for (Eigen::Index i = 0; i < size.size(); ++i) size(i) = std::max(size(i), 0.01 * largest(i % 6 / 3));
  return size;
}

double difference(const std::vector<Eigen::MatrixXd>& M, const std::vector<Eigen::MatrixXd>& exact) {
  const Eigen::VectorXd scale = sizes(exact).cwiseSqrt().cwiseInverse();
  double largest = 0;
  for (std::size_t i = 0; i < M.size(); ++i)
    largest = std::max(largest, (scale.asDiagonal() * (M[i] - exact[i]) * scale.asDiagonal()).cwiseAbs().maxCoeff());
  return largest;
}

double error(const Coefficients& c, const Coefficients& exact) {
  double largest = std::max(difference(c.A, exact.A), difference(c.B, exact.B));
  for (Eigen::Index mode = 0; mode < c.modes(); ++mode) {
    if (mode % 6 == 5) continue;  // yaw of a module is small
    double size = 0, change = 0;
    for (std::size_t h = 0; h < c.X.size(); ++h) {
      size = std::max(size, exact.X[h].row(mode).cwiseAbs().maxCoeff());
      change = std::max(change, (c.X[h] - exact.X[h]).row(mode).cwiseAbs().maxCoeff());
    }
    largest = std::max(largest, change / size);
  }
  return largest;
}

struct Digit {
  int cylinders;
  double tolerance, error, seconds;
};

std::vector<Digit> digits(int modules, const std::vector<double>& tolerances, double finest) {
  const auto bodies = layout(modules, 1);
  const auto exact = solve(bodies, water, omegas(frequencies), headings, options(finest)).coefficients;
  std::vector<Digit> list;
  for (const double tolerance : tolerances) {
    const auto start = Clock::now();
    const auto c = solve(bodies, water, omegas(frequencies), headings, options(tolerance)).coefficients;
    const double seconds = seconds_since(start);
    list.push_back({4 * modules, tolerance, error(c, exact), seconds});
    std::cout << fmt::format("{} cylinders, {:.0e}: error {:.2g}, {:.3g} s\n", 4 * modules, tolerance,
                             list.back().error, list.back().seconds)
              << std::flush;
  }
  return list;
}

struct Size {
  int cylinders;
  double tolerance;
  int solved;      ///< frequencies
  Cost predicted;  ///< for all frequencies
  double seconds;  ///< for all frequencies, scaled by the prediction if fewer are solved
};

/// As many frequencies as can be expected within `patience_s`, at least one.
Size size_of(int along, int across, double tolerance, double patience_s) {
  const auto bodies = layout(along, across);
  const Cost all = hydro::cylinders::cost(bodies, water, omegas(frequencies), headings, options(tolerance));
  int solved = frequencies;
  Cost some = all;
  while (some.seconds > patience_s && solved > 1) {
    solved = (solved + 1) / 2;
    some = hydro::cylinders::cost(bodies, water, omegas(solved), headings, options(tolerance));
  }
  const auto start = Clock::now();
  const auto c = solve(bodies, water, omegas(solved), headings, options(tolerance)).coefficients;
  const double seconds = seconds_since(start);
  hydro::ensure(c.A.front().allFinite(), "coefficients are finite");
  const int cylinders = along == 0 ? 1 : 4 * along * across;
  std::cout << fmt::format("{} cylinders: {} frequencies in {:.3g} s\n", cylinders, solved, seconds) << std::flush;
  return {cylinders, tolerance, solved, all, solved == frequencies ? seconds : seconds * all.seconds / some.seconds};
}

struct Panels {
  int cylinders;
  double seconds;  ///< of as many frequencies as here
};

std::vector<Panels> panels(const std::filesystem::path& data) {
  std::vector<Panels> list;
  for (const int modules : {1, 5}) {
    const auto path = data / fmt::format("generated-bem/pontoon{}/info.json", modules);
    std::ifstream file(path);
    if (!file) throw std::runtime_error(fmt::format("cannot open {}", path.string()));
    const auto info = nlohmann::json::parse(file);
    list.push_back({4 * modules, frequencies * info.at("s_per_omega").get<double>()});
  }
  return list;
}

constexpr double panel_error = 0.055;  // of A, from two meshes: validation/fagerbakke-bem

std::string page(const std::vector<Digit>& digit, const std::vector<Size>& size, const std::vector<Panels>& panel) {
  std::string out = fmt::format(
      "# What coefficients of cylinders cost\n\n"
      "Written by `price_cylinders` (validation/cost/cylinders), one core. Modules of four cylinders, D = 1.6 m, "
      "draught "
      "1.13 m, 13 m apart, depth 14 m;\n{} frequencies from 0.2 to 4 rad/s and {} headings. The error is the largest "
      "difference of A, B and X from a solution with a digit\nmore, each over its two modes (P11). Panels: the runs of "
      "generated-bem, 560 panels a module, {:.1f} % in A, their time for as many\nfrequencies, one thread too.\n\n"
      "![digits against time](cylinders.svg)\n\n"
      "| cylinders | asked | error | time [s] | panels take longer by |\n| --- | --- | --- | --- | --- |\n",
      frequencies, headings.size(), 100 * panel_error);
  for (const Digit& d : digit)
    for (const Panels& p : panel)
      if (p.cylinders == d.cylinders)
        out += fmt::format("| {} | {:.0e} | {:.1e} | {:.3g} | {:.3g} |\n", d.cylinders, d.tolerance, d.error, d.seconds,
                           p.seconds / d.seconds);
  out +=
      "\nBy number of cylinders. Where fewer than all frequencies were solved, time "
      "is "
      "scaled by the predictions.\n\n"
      "| cylinders | asked | unknowns | equations between groups | memory, predicted [MB] | predicted [s] | measured "
      "[s] | "
      "frequencies solved |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const Size& s : size)
    out +=
        fmt::format("| {} | {:.0e} | {} | {} | {:.3g} | {:.3g} | {:.3g}{} | {} |\n", s.cylinders, s.tolerance,
                    s.predicted.unknowns, s.predicted.iterative ? "iteration" : "elimination", s.predicted.bytes / 1e6,
                    s.predicted.seconds, s.seconds, s.solved == frequencies ? "" : " (scaled)", s.solved);
  return out;
}

plot::Figure figure(const std::vector<Digit>& digit, const std::vector<Size>& size, const std::vector<Panels>& panel) {
  plot::Panel errors{.x = {.label = "time", .unit = "s", .scale = plot::Scale::logarithmic},
                     .y = {.label = "error", .scale = plot::Scale::logarithmic},
                     .series = {}};
  plot::Panel times{.x = {.label = "cylinders", .scale = plot::Scale::logarithmic},
                    .y = {.label = "time", .unit = "s", .scale = plot::Scale::logarithmic},
                    .series = {}};
  for (const int cylinders : {4, 20}) {
    plot::Series s{.name = fmt::format("{} cylinders", cylinders), .x = {}, .y = {}, .line = true, .marks = true};
    for (const Digit& d : digit)
      if (d.cylinders == cylinders) s.x.push_back(d.seconds), s.y.push_back(d.error);
    errors.series.push_back(std::move(s));
  }
  plot::Series measured{.name = "measured", .x = {}, .y = {}, .line = true, .marks = true};
  plot::Series predicted{.name = "predicted", .x = {}, .y = {}, .line = true, .marks = false};
  for (const Size& s : size) {
    measured.x.push_back(s.cylinders), measured.y.push_back(s.seconds);
    predicted.x.push_back(s.cylinders), predicted.y.push_back(s.predicted.seconds);
  }
  plot::Series by_panels{.name = "panels", .x = {}, .y = {}, .line = false, .marks = true};
  for (const Panels& p : panel) {
    by_panels.x.push_back(p.cylinders), by_panels.y.push_back(p.seconds);
    errors.series.push_back({.name = fmt::format("panels, {}", p.cylinders),
                             .x = {p.seconds},
                             .y = {panel_error},
                             .line = false,
                             .marks = true});
  }
  times.series = {measured, predicted, by_panels};
  return {.title = "Coefficients of cylinders: 60 frequencies, 4 headings", .panels = {errors, times}};
}

void write_all(const std::filesystem::path& data, const std::filesystem::path& folder) {
  const auto panel = panels(data);
  std::vector<Digit> digit = digits(1, {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}, 1e-7);
  for (const Digit& d : digits(5, {1e-2, 1e-3, 1e-4, 1e-5}, 1e-6)) digit.push_back(d);
  std::vector<Size> size;
  for (const auto& [along, across] : {std::pair{0, 0}, {1, 1}, {5, 1}, {5, 5}})
    size.push_back(size_of(along, across, 1e-3, 25));
  size.push_back(size_of(10, 10, 1e-2, 25));
  hydro::io::write_atomically(folder / "cylinders.md", page(digit, size, panel));
  hydro::io::write_atomically(folder / "cylinders.svg", plot::svg(figure(digit, size, panel)));
}

}  // namespace
}  // namespace froude::cost

int main(int argc, char** argv) {
  return froude::cost::write_price_list(
      argc, argv, 2, "price_cylinders REFERENCE_DATA FOLDER   writes FOLDER/cylinders.md and FOLDER/cylinders.svg",
      [&] { froude::cost::write_all(argv[1], argv[2]); });
}
