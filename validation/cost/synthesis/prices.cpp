// Writes the price list of sea synthesis: docs/cost/synthesis.md and its picture. See ../README.md on how to run it.
#include <fmt/format.h>

#include <ctime>
#include <filesystem>
#include <iostream>

#include "answers/plot.hpp"
#include "cost/price_list.hpp"
#include "hydro/io/atomic_file.hpp"
#include "subject.hpp"

namespace froude::cost {
namespace {

struct Price {
  std::string method;
  std::size_t points;
  double seconds, error, stated;
};

/// Processor time of this program, s: what the machine's other work takes is left out.
double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The least of several times, as long as they do not take too long together.
template <class Work>
double least_time(Work work) {
  double least = 1e300, all = 0;
  for (int i = 0; i < 7 && (i == 0 || all < 2); ++i) {
    const double start = processor_s();
    work();
    const double took = processor_s() - start;
    least = std::min(least, took);
    all += took;
  }
  return least;
}

// A slow method is run over a part of the record that takes about 0.2 s, found by doubling.
std::size_t part_to_time(const Method& method, std::size_t points) {
  std::size_t part = 2;
  while (part < steps_at_most(points)) {
    const double start = processor_s();
    method.run(0, part);
    if (processor_s() - start > 0.1) break;
    part = std::min(2 * part, steps_at_most(points));
  }
  return part;
}

Price price_of(const Method& method, Wanted wanted, std::size_t points) {
  method.build();
  const std::size_t part = method.at_once ? steps : part_to_time(method, points);
  const double built = least_time(method.build);
  const double run = least_time([&] { method.run(0, part); });
  const double error = guarded_error(method, wanted, points, part);
  const Price price{method.name, points, built + run * static_cast<double>(steps) / static_cast<double>(part), error,
                    method.stated_error()};
  std::cout << fmt::format("{:32} {:20} {:5} points: {:10.4g} s, error {:.1e}\n", title_of(wanted), price.method,
                           points, price.seconds, price.error)
            << std::flush;
  return price;
}

std::vector<Price> prices(Wanted wanted) {
  std::vector<Price> out;
  for (const std::size_t points : {1, 10, 1000})
    for (const Method& method : methods(wanted, points)) out.push_back(price_of(method, wanted, points));
  return out;
}

std::string table(const std::vector<Price>& list, const std::string& unit) {
  std::string out = fmt::format(
      "| points | method | time [s] | times faster than std::cos | largest error / rms | stated bound [{}] |\n"
      "| --- | --- | --- | --- | --- | --- |\n",
      unit);
  double plain = 0;
  for (const Price& p : list) {
    if (p.method.starts_with("std::cos")) plain = p.seconds;
    out += fmt::format("| {} | {} | {:.3g} | {:.3g} | {:.1e} | {} |\n", p.points, p.method, p.seconds,
                       plain / p.seconds, p.error, std::isnan(p.stated) ? "" : fmt::format("{:.1e}", p.stated));
  }
  return out;
}

plot::Panel panel(const std::string& title, const std::vector<Price>& list) {
  plot::Panel out{.x = {.label = title + ": time for the record",
                        .unit = "s",
                        .scale = plot::Scale::logarithmic,
                        .range = {{1e-4, 1e4}}},
                  .y = {.label = "error / rms", .scale = plot::Scale::logarithmic, .range = {{1e-17, 1e-9}}},
                  .series = {}};
  for (const Price& p : list) {
    auto found = std::find_if(out.series.begin(), out.series.end(), [&](const auto& s) { return s.name == p.method; });
    if (found == out.series.end()) {
      out.series.push_back({.name = p.method, .x = {}, .y = {}, .line = true, .marks = true});
      found = out.series.end() - 1;
    }
    found->x.push_back(p.seconds);
    found->y.push_back(p.error);
  }
  return out;
}

std::string heading() {
  return fmt::format(
      "# What a sea costs\n\n"
      "Written by `price_synthesis` (validation/cost/synthesis). {} components, {} steps of {} s; JONSWAP, Hs 3 m, Tp "
      "9 s,\n"
      "long-crested, deep water, Wheeler stretching. Processor time of one core, the table's building included; "
      "methods that\n"
      "are slow were run over a part of the record and scaled. Every number is guarded: a method that misses its "
      "stated error\n"
      "is not printed. The error is the largest of 60 scattered samples against sums in extended precision, over the "
      "standard\n"
      "deviation of the elevation (or of the vertical velocity at the surface, for kinematics); the bound is one for "
      "all samples.\n"
      "A slow method seems more exact with many points because only the early part of the record was run. What\n"
      "these times cannot tell: see validation/cost/README.md.\n\n"
      "![error against time](synthesis.svg)\n\n"
      "In the picture the marks of one method are, from left to right, 1, 10 and 1000 points.\n",
      components, steps, dt_s);
}

void write_all(const std::filesystem::path& folder) {
  std::string page = heading();
  plot::Figure figure{.title = "Sea synthesis: error against time, 1, 10 and 1000 points", .panels = {}};
  for (const auto wanted : {Wanted::fixed_elevation, Wanted::moving_elevation, Wanted::moving_kinematics}) {
    const auto list = prices(wanted);
    page +=
        fmt::format("\n## {}\n\n{}", title_of(wanted), table(list, wanted == Wanted::moving_kinematics ? "m/s" : "m"));
    figure.panels.push_back(panel(title_of(wanted), list));
  }
  hydro::io::write_atomically(folder / "synthesis.md", page);
  hydro::io::write_atomically(folder / "synthesis.svg", plot::svg(figure));
}

}  // namespace
}  // namespace froude::cost

int main(int argc, char** argv) {
  return froude::cost::write_price_list(argc, argv, 1,
                                        "price_synthesis FOLDER   writes FOLDER/synthesis.md and FOLDER/synthesis.svg",
                                        [&] { froude::cost::write_all(argv[1]); });
}
