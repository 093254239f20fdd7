/// \file  Writes how often intervals of 95 % held the truth, by kinds of noise: docs/cost/coverage.md. See README.md.
#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <future>
#include <iostream>
#include <mutex>
#include <string>
#include <vector>

#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "support/noisy_runs.hpp"

namespace froude::cost {
namespace {

/// Of one made record: whether each interval held its truth, and whether all values were told.
struct Held {
  std::vector<bool> by_coefficient;
  bool told;
};

struct Kind {
  std::string what, noise;
  std::vector<std::string> coefficients;
  std::function<Held(std::uint64_t)> fit;
  std::uint64_t share = 1;  // one set for so many of the other kinds, since a fit takes long
};

bool holds(const fit::Coefficient& c, double truth) { return c.interval.low <= truth && truth <= c.interval.high; }

Kind force(const std::string& noise, const froude_test::Noise& made) {
  return {"Morison", noise, {"cd", "ca"}, [made](std::uint64_t set) {
            const auto solution = solve(froude_test::moved_run(made, set));
            const fit::MorisonFit& f = solution.runs.at(0).fit;
            return Held{{holds(f.cd, froude_test::moved_cd), holds(f.inertia, froude_test::moved_ca)},
                        f.cd.value && f.inertia.value};
          }};
}

Kind decay(const std::string& noise, double step, double step_s, double memory, std::uint64_t share = 1) {
  return {"decay",
          noise,
          {"period", "linear", "quadratic"},
          [=](std::uint64_t set) {
            const auto [problem, omega] = froude_test::decay_in_steps(step, step_s, set, memory);
            const auto solution = solve(problem);
            if (solution.runs.empty()) return Held{{false, false, false}, false};
            const auto& f = solution.runs[0].fit;
            const auto &b = f.damping.at(0), &q = f.damping.at(1);
            return Held{{holds(f.period, 2 * std::numbers::pi / omega), holds(b, froude_test::decay_linear),
                         holds(q, froude_test::decay_quadratic)},
                        f.period.value && b.value && q.value};
          },
          share};
}

std::vector<Kind> kinds() {
  constexpr double at_20_hz = 0.05, at_50_hz = 0.02, at_100_hz = 0.01;
  return {
      force("white, 6 % of the force", {.force = 1}),
      force("with a memory of 6 samples (φ = 0.85)", {.force = 1, .memory = 0.85}),
      force("steps of 2 %, noise of a twentieth of one", {.force = 0.015, .force_step = 0.3}),
      force("steps of 2 %, no noise", {.force_step = 0.3}),
      force("steps of 2 %, no noise, 100 Hz", {.force_step = 0.3, .step_s = at_100_hz}),
      force("steps of 2 %, noise of four tenths of one, 100 Hz",
            {.force = 0.12, .force_step = 0.3, .step_s = at_100_hz}),
      force("position alone, white, 0.5 mm, 20 Hz", {.position = 0.5e-3, .force = 1}),
      force("position alone, white, 0.5 mm, 50 Hz", {.position = 0.5e-3, .force = 1, .step_s = at_50_hz}),
      force("position in steps of 2 %, 100 Hz", {.force = 0.5, .position_step = 0.008, .step_s = at_100_hz}),
      decay("white, 1.3 % of the first swing", 0, at_20_hz, 0),
      decay("with a memory of 6 samples (φ = 0.85)", 0, at_20_hz, 0.85),
      decay("steps of 2 %", 0.003, at_20_hz, 0),
      decay("steps of 2 %, 100 Hz", 0.003, at_100_hz, 0, 4),
  };
}

/// Shares of sets in which each interval held the truth, and in which all values were told.
std::string row_of(const Kind& kind, std::uint64_t sets) {
  std::vector<double> share(kind.coefficients.size(), 0.0);
  double told = 0;
  const auto begin = std::chrono::steady_clock::now();
  for (std::uint64_t set = 0; set < sets; ++set) {
    const Held held = kind.fit(set);
    for (std::size_t k = 0; k < share.size(); ++k) share[k] += held.by_coefficient[k];
    told += held.told;
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const auto n = static_cast<double>(sets);
  std::string covered;
  for (std::size_t k = 0; k < share.size(); ++k)
    covered += fmt::format("{}{} {:.1f}", k > 0 ? ", " : "", kind.coefficients[k], 100 * share[k] / n);
  return fmt::format("| {} | {} | {} | {} | {:.1f} | {:.3g} |\n", kind.what, kind.noise, sets, covered, 100 * told / n,
                     1e3 * seconds / n);
}

std::string page(const std::vector<std::string>& rows) {
  std::string text =
      "# Do intervals hold the truth?\n\nWritten by `price_coverage` (validation/cost/coverage), which says how. "
      "Intervals of 95 %, of which 2000 sets tell the share to 0.5 %, and 500 to 1 %.\n\n"
      "| fit | noise | sets | covered [%] | values told [%] | time of a fit [ms] |\n"
      "| --- | --- | --- | --- | --- | --- |\n";
  for (const std::string& row : rows) text += row;
  return text;
}

/// The row of a kind that the page in `folder` has; "" if it has none.
std::string row_before(const std::filesystem::path& folder, const Kind& kind) {
  std::ifstream page(folder / "coverage.md");
  const std::string begin = fmt::format("| {} | {} |", kind.what, kind.noise);
  for (std::string line; std::getline(page, line);)
    if (line.starts_with(begin)) return line + "\n";
  return {};
}

/// Kinds on two threads, the page after each, as far as it is. `fit`: the fits that are asked for, "" for all; the
/// others keep their rows.
void write(const std::filesystem::path& folder, std::uint64_t sets, const std::string& fit) {
  const auto all = kinds();
  std::vector<std::string> rows(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) rows[i] = row_before(folder, all[i]);
  std::atomic<std::size_t> next = 0;
  std::mutex writing;
  const auto work = [&] {
    for (std::size_t i = next++; i < all.size(); i = next++) {
      if (!fit.empty() && all[i].what != fit) continue;
      std::string row = row_of(all[i], sets / all[i].share);
      const std::lock_guard lock(writing);
      rows[i] = std::move(row);
      hydro::io::write_atomically(folder / "coverage.md", page(rows));
    }
  };
  auto beside = std::async(std::launch::async, work);
  work();
  beside.get();
}

}  // namespace
}  // namespace froude::cost

int main(int count, char** argument) {
  if (count != 3 && count != 4) {
    std::cerr << "usage: price_coverage FOLDER SETS [FIT]\n";
    return 2;
  }
  try {
    froude::cost::write(argument[1], std::stoul(argument[2]), count == 4 ? argument[3] : "");
  } catch (const std::exception& e) {
    std::cerr << "price_coverage: " << e.what() << "\n";
    return 1;
  }
  return 0;
}
