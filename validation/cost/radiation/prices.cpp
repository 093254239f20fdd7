/// \file  Writes the price list of radiation memory: docs/cost/radiation.md and its picture. See README.md.
///
/// Tables of one, two and five bodies from examples/data, and one of a made-up body that is known everywhere; every
/// method at a step that gives few lags and at one that gives many. Error: the force of a harmonic motion against the
/// data (R19), which holds all that a method leaves out.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "answers/plot.hpp"
#include "cost/price_list.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/potential/coefficients.hpp"
#include "hydro/radiation/choice.hpp"
#include "support/random_passive.hpp"

namespace froude::cost {
namespace {

using namespace hydro::radiation;
using Clock = std::chrono::steady_clock;

constexpr double tolerance = 1e-2;  // what the tables themselves are good for

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

struct Table {
  std::string name;
  int bodies;
  DampingTable damping;
  std::vector<Eigen::MatrixXd> A;
  std::optional<Eigen::MatrixXd> A_inf;
};

Eigen::MatrixXd symmetric(const Eigen::MatrixXd& m) { return (m + m.transpose()) / 2; }

Table read(const std::filesystem::path& folder, const std::string& name) {
  const auto c = hydro::potential::read(folder / (name + ".nc"));
  Table out{name, c.bodies(), {c.omega, {}}, {}, {}};
  for (const auto& B : c.B) out.damping.B.push_back(symmetric(B));
  for (const auto& A : c.A) out.A.push_back(symmetric(A));
  if (c.A_inf) out.A_inf = symmetric(*c.A_inf);
  return out;
}

/// Three bodies that radiate passively by construction, tabulated far and finely: here a convolution is exact enough.
Table synthetic() {
  const auto data = support::data_of(support::random_passive(1, 18, 6), 12, 240);
  return {"made up", 3, data.damping, data.A, data.A_inf};
}

struct Price {
  std::string method;
  double error, predicted_us, measured_us, build_s;
  bool within, chosen = false;
};

/// The least mean of some runs of 4096 steps, a whole number of turns of the partitioned sum.
double microseconds_a_step(const MemoryMethod& method) {
  constexpr int steps = 4096, runs = 3;
  const Eigen::VectorXd velocity = Eigen::VectorXd::LinSpaced(method.modes(), 0.1, 1);
  double least = 1e300;
  for (int run = 0; run < runs; ++run) {
    const auto state = method.start(velocity);
    const auto start = Clock::now();
    for (int i = 0; i < steps; ++i) {
      state->accept(std::cos(0.05 * i) * velocity);
      if (!state->history_force(1).allFinite()) throw std::runtime_error("a memory is not finite");
    }
    least = std::min(least, 1e6 * seconds_since(start) / steps);
  }
  return least;
}

struct Cell {
  const Table* table;
  double step;
  std::size_t lags;
  std::vector<Price> prices;
};

Cell cell(const Table& table, double step) {
  Cell out{&table, step, 0, {}};
  for (const Method method : {Method::direct, Method::partitioned, Method::poles}) {
    const auto start = Clock::now();
    const ChosenMemory made = choose(table.damping, table.A, table.A_inf,
                                     {.step = step, .tolerance = tolerance, .length = {}, .method = method});
    const double built = seconds_since(start);
    const Alternative& a = made.alternatives.front();
    if (made.fit && !made.fit->passive) continue;  // not on offer
    out.prices.push_back(
        {name_of(method), a.error, a.microseconds, microseconds_a_step(*made.memory), built, a.within});
    if (method == Method::direct) out.lags = made.lags;
  }
  const ChosenMemory taken =
      choose(table.damping, table.A, table.A_inf, {.step = step, .tolerance = tolerance, .length = {}, .method = {}});
  for (Price& p : out.prices) p.chosen = p.method == name_of(taken.method);
  return out;
}

/// No other method is both faster, by more than two runs differ, and at least as exact.
bool on_the_front(const Cell& c) {
  const auto taken = std::find_if(c.prices.begin(), c.prices.end(), [](const Price& p) { return p.chosen; });
  return std::none_of(c.prices.begin(), c.prices.end(), [&](const Price& p) {
    return p.measured_us < taken->measured_us / 1.1 && p.error <= taken->error;
  });
}

std::string rows(const Cell& c) {
  std::string out;
  for (const Price& p : c.prices)
    out += fmt::format("| {} | {} | {} | {} | {:.3g}{} | {:.3g} | {:.3g} | {:.2g} | {} |\n", c.table->bodies, c.step,
                       c.lags, p.method, p.error, p.within ? "" : " (outside)", p.measured_us, p.predicted_us,
                       p.build_s, p.chosen ? "taken" : "");
  return out;
}

plot::Panel panel(const Table& table, const std::vector<Cell>& cells) {
  plot::Panel out{.x = {.label = table.name + ": time of a step",
                        .unit = "µs",
                        .scale = plot::Scale::logarithmic,
                        .range = {{0.3, 1e4}}},
                  .y = {.label = "error of force", .scale = plot::Scale::logarithmic, .range = {{1e-5, 1}}},
                  .series = {}};
  plot::Series taken{.name = "taken by itself", .x = {}, .y = {}, .line = false, .marks = true};
  for (const char* method : {"direct", "partitioned", "poles"}) {
    plot::Series series{.name = method, .x = {}, .y = {}, .line = true, .marks = false};
    for (const Cell& c : cells)
      for (const Price& p : c.prices)
        if (c.table == &table && p.method == method) {
          series.x.push_back(p.measured_us);
          series.y.push_back(p.error);
          if (!p.chosen) continue;
          taken.x.push_back(p.measured_us);
          taken.y.push_back(p.error);
        }
    out.series.push_back(std::move(series));
  }
  out.series.push_back(std::move(taken));
  return out;
}

std::string heading(const std::vector<Cell>& cells) {
  const auto on = std::count_if(cells.begin(), cells.end(), on_the_front);
  return fmt::format(
      "# What radiation memory costs\n\n"
      "Written by `price_radiation` (validation/cost/radiation), one core. Tables of examples/data and a made-up one "
      "of three bodies, tolerance {}. The "
      "error is that of the force\nof a harmonic motion against the table, at its own frequencies, the worst pair, so "
      "it counts what the method leaves out and what the table\nlacks. The step is what makes few lags or many of one "
      "memory. The method that a run would take by itself is no worse than any other in\ntime and error at once in {} "
      "of {} cells; times that differ by less than a tenth count as equal.\n\n"
      "![error against time](radiation.svg)\n\n"
      "| bodies | step [s] | lags | method | error | time of a step [µs] | predicted [µs] | to build [s] | |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
      tolerance, on, cells.size());
}

void write_all(const std::filesystem::path& examples, const std::filesystem::path& folder) {
  std::vector<Table> tables;
  for (const char* name : {"pontoon1", "box2", "pontoon5"}) tables.push_back(read(examples, name));
  tables.push_back(synthetic());
  std::vector<Cell> cells;
  for (const Table& table : tables)
    for (const double step : {0.1, 0.02, 0.005}) {
      cells.push_back(cell(table, step));
      std::cout << rows(cells.back()) << std::flush;
    }
  std::string page = heading(cells);
  plot::Figure figure{.title = "Radiation memory: error against time", .panels = {}};
  for (const Cell& c : cells) page += rows(c);
  for (const Table& table : tables) figure.panels.push_back(panel(table, cells));
  hydro::io::write_atomically(folder / "radiation.md", page);
  hydro::io::write_atomically(folder / "radiation.svg", plot::svg(figure));
}

}  // namespace
}  // namespace froude::cost

int main(int argc, char** argv) {
  return froude::cost::write_price_list(
      argc, argv, 2, "price_radiation EXAMPLES_DATA FOLDER   writes FOLDER/radiation.md and FOLDER/radiation.svg",
      [&] { froude::cost::write_all(argv[1], argv[2]); });
}
