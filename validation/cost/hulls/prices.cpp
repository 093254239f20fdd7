/// \file  Writes the price list of hulls by panels: docs/cost/hulls.md and its picture. See README.md.
#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <filesystem>
#include <iostream>

#include "answers/plot.hpp"
#include "cost/price_list.hpp"
#include "hydro/cylinders/solve.hpp"
#include "hydro/hydrostatics/shape_meshes.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/panels/solve.hpp"

namespace froude::cost {
namespace {

using namespace hydro::panels;
using Eigen::Vector3d;
using hydro::hydrostatics::Hull;
using hydro::hydrostatics::TriangleMesh;

constexpr double draught = 0.8, depth = 3;  // m, of a cylinder of 1 m radius
const std::vector<double> headings{0, 0.5, 1.0};
const std::vector<double> omega{0.4, 0.7, 1.0, 1.3, 1.6, 1.9, 2.2, 2.5};

hydro::Water water_of(double metres) {
  return {.density = 1000, .gravity = 9.81, .depth = hydro::WaterDepth::from_metres(metres)};
}

struct Timed {
  Solution solution;
  double seconds;
};

Timed timed(const std::vector<HullBody>& bodies, const hydro::Water& water, const std::vector<double>& at,
            const std::vector<double>& heading, std::optional<double> tolerance,
            Interaction interaction = Interaction::panels) {
  const std::clock_t start = std::clock();  // processor time: other work disturbs it little
  Solution s = solve(bodies, water, at, heading, {.tolerance = tolerance, .interaction = interaction, .threads = 1});
  return {std::move(s), static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC};
}

// ---- error against time

struct Price {
  int rows, columns;                ///< of side and bottom each; around
  std::optional<double> tolerance;  ///< empty: the mesh as it is
};

struct Paid {
  Price price;
  double error, estimate, seconds;
  int panels, finest;
};

Paid paid(const Price& price, const hydro::potential::Coefficients& exact) {
  const Vector3d G(0, 0, -draught / 2);
  const HullBody body{"cylinder",
                      {0, 0, 0},
                      G,
                      Hull(hydro::hydrostatics::cylinder_mesh(1, draught, price.rows, price.rows, price.columns))};
  const Timed t = timed({body}, water_of(depth), omega, headings, price.tolerance);
  const SelfCheck& check = t.solution.check;
  const int given = 2 * price.rows * price.columns;
  const Paid p{price,          difference(t.solution.coefficients, exact, check.length),
               check.estimate, t.seconds,
               given,          check.extrapolated_from.empty() ? given : check.extrapolated_from.back()};
  std::cout << fmt::format("{} panels, finest {}: error {:.2g}, {:.3g} s\n", p.panels, p.finest, p.error, p.seconds)
            << std::flush;
  return p;
}

// ---- the meshes of generated-bem

struct Peer {
  std::string name;
  int panels, of_peer;  ///< of all bodies, here and there
  int frequencies;
  std::size_t headings;
  double seconds, peer_seconds;
};

std::vector<double> evenly(double low, double high, int count) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back(low + (high - low) * i / (count - 1));
  return out;
}

TriangleMesh pontoon(double x) {
  TriangleMesh all{.source = "pontoon", .vertices = {}, .triangles = {}};
  for (const double dx : {-5.2, 5.2})
    for (const double y : {-5.2, 5.2}) {
      const TriangleMesh one = hydro::hydrostatics::cylinder_mesh(0.8, 1.13, 3, 2, 32, {x + dx, y});
      const int first = static_cast<int>(all.vertices.size());
      all.vertices.insert(all.vertices.end(), one.vertices.begin(), one.vertices.end());
      for (const auto& t : one.triangles) all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
  return all;
}

Peer peer(const std::string& name, const std::vector<HullBody>& bodies, const hydro::Water& water,
          const std::vector<double>& at, std::size_t heading_count, int peer_panels, double peer_seconds) {
  std::vector<double> heading;
  for (std::size_t i = 0; i < heading_count; ++i) heading.push_back(0.5 * static_cast<double>(i));
  const Timed t = timed(bodies, water, at, heading, {});
  const int frequencies = static_cast<int>(at.size());
  std::cout << fmt::format("{}: {} frequencies in {:.3g} s\n", name, frequencies, t.seconds) << std::flush;
  return {name, t.solution.check.panels, peer_panels, frequencies, heading_count, t.seconds, peer_seconds};
}

std::vector<Peer> peers() {
  std::vector<HullBody> one, two, boxes;
  one.push_back({"module", {0, 0, 0}, {}, Hull(pontoon(0))});
  for (const double x : {-6.5, 6.5}) two.push_back({fmt::format("at {}", x), {x, 0, 0}, {}, Hull(pontoon(x))});
  for (const double x : {-5.0, -2.5, 0.0, 2.5, 5.0})
    boxes.push_back({fmt::format("at {}", x),
                     {x, 0, 0},
                     {},
                     Hull(hydro::hydrostatics::box_mesh({x - 1, -1, -0.3}, {x + 1, 1, 0}, {14, 14, 6}))});
  const hydro::Water deep{.density = 1000, .gravity = 9.81}, bed = water_of(14);
  return {peer("one module", one, bed, evenly(0.2, 4, 39), 3, 560, 39),
          peer("two modules", two, bed, evenly(0.2, 4, 39), 3, 1120, 199),
          peer("five boxes", boxes, deep, evenly(0.2, 6, 59), 4, 2660, 351)};
}

// ---- arrays

struct OfArray {
  int hulls, panels, partial_waves;
  double each;                       ///< s a frequency, by partial waves
  std::optional<double> together;    ///< s a frequency, all panels in one set of equations
  std::optional<double> difference;  ///< of the two
};

/// A square of boxes of 2 x 2 x 0.3 m, as they are meshed in generated-bem, 4 m apart in 14 m of water.
OfArray of_array(int side) {
  std::vector<HullBody> boxes;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const double middle = (side - 1) / 2.0;  // symmetric about both axes, which all panels together use
      const Vector3d at(4 * (i - middle), 4 * (j - middle), 0);
      boxes.push_back(
          {fmt::format("box {} {}", i, j),
           at,
           {},
           Hull(hydro::hydrostatics::box_mesh(at - Vector3d(1, 1, 0.3), at + Vector3d(1, 1, 0), {14, 14, 6}))});
    }
  constexpr int limits = 1;  // A at infinite frequency is of the price of a frequency
  const std::vector<double> one{2.0}, two{2.0, 2.5};
  const Timed each = timed(boxes, water_of(14), side > 5 ? one : two, headings, {}, Interaction::partial_waves);
  OfArray out{side * side,
              each.solution.check.panels,
              each.solution.check.partial_waves,
              each.seconds / (limits + (side > 5 ? 1 : 2)),
              {},
              {}};
  if (side <= 2) {
    const Timed all = timed(boxes, water_of(14), two, headings, {}, Interaction::panels);
    out.together = all.seconds / (limits + 2);
    out.difference = difference(each.solution.coefficients, all.solution.coefficients, all.solution.check.length);
  }
  std::cout << fmt::format("{} boxes: {:.3g} s a frequency\n", out.hulls, out.each) << std::flush;
  return out;
}

// ---- the page

std::string page(const std::vector<Paid>& list, const std::vector<Peer>& peers, const std::vector<OfArray>& arrays) {
  std::string out = fmt::format(
      "# What coefficients of hulls cost\n\n"
      "Written by `price_hulls` (validation/cost/hulls), one core. A truncated cylinder of 1 m radius and {} m draught "
      "in "
      "{} m of water, {} frequencies\nfrom {} to {} rad/s and {} headings; its mesh has two planes of symmetry. The "
      "error "
      "is the largest of A, B and X against eigenfunctions, each over its two modes (P11).\n\n"
      "![error against time](hulls.svg)\n\n"
      "| faces given | tolerance | finest mesh | estimate | error | time [s] |\n| --- | --- | --- | --- | --- | --- "
      "|\n",
      draught, depth, omega.size(), omega.front(), omega.back(), headings.size());
  for (const Paid& p : list)
    out += fmt::format("| {} | {} | {} | {} | {:.1e} | {:.3g} |\n", p.panels,
                       p.price.tolerance ? fmt::format("{:g}", *p.price.tolerance) : "as given", p.finest,
                       p.price.tolerance ? fmt::format("{:.1e}", p.estimate) : "", p.error, p.seconds);
  out +=
      "\nThe meshes of generated-bem, as given, without a tolerance, all frequencies, and the added mass at an "
      "infinite one. The peer's times are of another day and were not measured beside these; one thread too.\n\n"
      "| hulls | panels | panels there | frequencies | headings | time [s] | a panel code, another day [s] | ratio |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const Peer& p : peers)
    out += fmt::format("| {} | {} | {} | {} | {} | {:.3g} | {:g} | {:.2g} |\n", p.name, p.panels, p.of_peer,
                       p.frequencies, p.headings, p.seconds, p.peer_seconds, p.peer_seconds / p.seconds);
  out +=
      "\nBoxes of 2 x 2 x 0.3 m and 532 panels each, in a square 4 m apart in 14 m of water, 3 headings, six motions "
      "of each; seconds a frequency. By partial waves one box is solved, with as many right-hand sides as waves "
      "pass.\n\n"
      "| boxes | panels | partial waves a box | by partial waves [s] | all panels together [s] | they differ by |\n"
      "| --- | --- | --- | --- | --- | --- |\n";
  for (const OfArray& a : arrays)
    out += fmt::format("| {} | {} | {} | {:.3g} | {} | {} |\n", a.hulls, a.panels, a.partial_waves, a.each,
                       a.together ? fmt::format("{:.3g}", *a.together) : "-",
                       a.difference ? fmt::format("{:.1e}", *a.difference) : "-");
  return out;
}

plot::Figure figure(const std::vector<Paid>& list) {
  plot::Series plain{.name = "as given", .x = {}, .y = {}, .line = true, .marks = true},
      extrapolated{.name = "extrapolated", .x = {}, .y = {}, .line = true, .marks = true};
  for (const Paid& p : list) {
    plot::Series& s = p.price.tolerance ? extrapolated : plain;
    s.x.push_back(p.seconds);
    s.y.push_back(p.error);
  }
  return {.title = "Panels of a cylinder: 8 frequencies, 3 headings",
          .panels = {{.x = {.label = "time", .unit = "s", .scale = plot::Scale::logarithmic},
                      .y = {.label = "error", .scale = plot::Scale::logarithmic},
                      .series = {plain, extrapolated}}}};
}

void write_all(const std::filesystem::path& folder) {
  const Vector3d G(0, 0, -draught / 2);
  const auto exact =
      hydro::cylinders::solve({{"cylinder", {0, 0, 0}, G, {{{0, 0}, 1, draught}}}}, water_of(depth), omega, headings,
                              {.tolerance = 1e-5, .threads = 1, .doubled_frequencies = 0})
          .coefficients;
  std::vector<Paid> list;
  for (const Price& price : {Price{2, 16, {}},
                             {4, 32, {}},
                             {6, 48, {}},
                             {8, 64, {}},
                             {12, 96, {}},
                             {16, 128, {}},
                             {2, 16, 0.03},
                             {2, 24, 0.03},
                             {3, 32, 0.03},
                             {4, 40, 0.03}})
    list.push_back(paid(price, exact));
  const std::vector<Peer> others = peers();
  std::vector<OfArray> arrays;
  for (const int side : {1, 2, 5, 10}) arrays.push_back(of_array(side));
  hydro::io::write_atomically(folder / "hulls.md", page(list, others, arrays));
  hydro::io::write_atomically(folder / "hulls.svg", plot::svg(figure(list)));
}

}  // namespace
}  // namespace froude::cost

int main(int argc, char** argv) {
  return froude::cost::write_price_list(argc, argv, 1,
                                        "price_hulls FOLDER   writes FOLDER/hulls.md and FOLDER/hulls.svg",
                                        [&] { froude::cost::write_all(argv[1]); });
}
