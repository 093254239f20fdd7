#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "answers/simulate.hpp"
#include "harness/scenes.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/csv.hpp"

namespace froude::validation::zanten_waves {
namespace {

constexpr double gravity = 9.81, degree = std::numbers::pi / 180;
constexpr double pendulum_at = 29.88;  // m from the paddle
constexpr double dynamic_of_static = 0.81;
/// How hard the crest strikes at each stage of its breaking, over Goda's impact, by where it was to meet, m from the
/// paddle; set on the long pendulum.
const std::map<double, double> impact_at{{28.38, 1.1}, {28.88, 1.7}, {29.38, 1.8}};
const std::vector<std::string> quantities{"theta_top_max", "theta_rel_end", "E_el_max", "E_diss_max", "E_abs_max"};

using Quantities = std::map<std::string, double>;
struct Condition {
  std::string pendulum;
  double focus, torque;
  auto operator<=>(const Condition&) const = default;
};
/// Of five or six runs, and what the thesis's own model gives.
struct Measured {
  Quantities least, first_quartile, median, third_quartile, largest, thesis;
};

std::map<Condition, Measured> read_results(const Folders& folders) {
  const auto table = hydro::io::CsvTable::read(folders.reference("results.csv"));
  const auto& pendulum = table.text_column("pendulum");
  const auto& quantity = table.text_column("quantity");
  std::map<Condition, Measured> out;
  for (std::size_t i = 0; i < pendulum.size(); ++i) {
    auto& of = out[{pendulum[i], table.column("x_focus_m")[i], table.column("torque_aim_Nm")[i]}];
    of.least[quantity[i]] = table.column("minimum")[i];
    of.first_quartile[quantity[i]] = table.column("q1")[i];
    of.median[quantity[i]] = table.column("median")[i];
    of.third_quartile[quantity[i]] = table.column("q3")[i];
    of.largest[quantity[i]] = table.column("maximum")[i];
    of.thesis[quantity[i]] = table.column("model")[i];
  }
  return out;
}

/// One column of table 3.3.
Quantities read_pendulum(const Folders& folders, const std::string& name) {
  const auto table = hydro::io::CsvTable::read(folders.reference("pendulums.csv"));
  const auto& property = table.text_column("property");
  Quantities out;
  for (std::size_t i = 0; i < property.size(); ++i) out[property[i]] = table.column(name)[i];
  return out;
}

/// Highest water at the pendulum in metres, for each focus: the mean over the torques of the long pendulum's medians.
std::map<double, double> measured_crests(const std::map<Condition, Measured>& results) {
  std::map<double, double> sum, count;
  for (const auto& [condition, reference] : results)
    if (condition.pendulum == "long") {
      sum[condition.focus] += reference.median.at("eta_max") / 1000;
      ++count[condition.focus];
    }
  for (auto& [focus, crest] : sum) crest /= count.at(focus);
  return sum;
}

/// Highest water at the pendulum that the packets of a scene make, m.
double crest_of(scene::Scene scene) {
  scene.run->of.push_back("wave.elevation");
  const Run run = simulate(scene);
  const auto& elevation = run.signal("wave.elevation");
  return *std::max_element(elevation.begin(), elevation.end());
}

/// The scene of one condition. Bodies: top, bottom; joints: upper, lower.
scene::Scene scene_of(const Folders& folders, const Quantities& p, const Condition& c) {
  const auto file = folders.own() / "scene.toml";
  scene::Scene scene = scene::read(file);
  const double lower = 0.485, upper = lower + p.at("length_1");
  auto& top = scene.bodies.at(0);
  top.position.z() = upper;
  top.mass = p.at("mass_1");
  top.centre_of_gravity.z() = -p.at("cog_1");
  top.inertia = p.at("inertia_1_about_cog") * Eigen::Matrix3d::Identity();
  scene.joints.at(0).at.z() = upper;
  scene.joints.at(0).pto->line.damping = p.at("damping_1");
  scene.joints.at(1).friction.reset();
  // The torque aimed for is the dynamic one, by which the spring was adjusted (3.3.3).
  if (c.torque > 0) scene.joints.at(1).friction = scene::JointFriction{c.torque / dynamic_of_static, c.torque};
  scene.members.at(0).slamming->factor = impact_at.at(c.focus);
  std::get<scene::FocusedPackets>(scene.waves->kind).focus.x_m = c.focus - pendulum_at;
  return scene;
}

/// For each focus, the factor on all packets that makes them as high at the pendulum as the gauge there told.
std::map<double, double> packet_factors(const Folders& folders, const std::map<Condition, Measured>& results) {
  const Quantities p = read_pendulum(folders, "long");
  std::map<double, double> out = measured_crests(results);
  for (auto& [focus, factor] : out) factor /= crest_of(scene_of(folders, p, {"long", focus, 0}));
  return out;
}

void multiply_packets(scene::Scene& scene, double factor) {
  for (hydro::waves::Packet& packet : std::get<scene::FocusedPackets>(scene.waves->kind).packets)
    packet.amplitude = hydro::WaveAmplitude::from_metres(factor * packet.amplitude.metres());
}

/// Kinetic and potential energy of both parts, Van Zanten (2020) eqs. 4.1 and 4.2 with the misprints put right.
double elastic_energy(const Quantities& p, double top, double bottom, double top_rate, double bottom_rate) {
  const double L = p.at("length_1"), h1 = p.at("cog_1"), h2 = p.at("cog_2"), m1 = p.at("mass_1"), m2 = p.at("mass_2");
  const double kinetic =
      0.5 * (m1 * h1 * h1 + p.at("inertia_1_about_cog")) * top_rate * top_rate +
      0.5 * m2 * (L * L * top_rate * top_rate + 2 * top_rate * bottom_rate * L * h2 * std::cos(bottom - top)) +
      0.5 * (m2 * h2 * h2 + p.at("inertia_2_about_cog")) * bottom_rate * bottom_rate;
  return kinetic + m1 * gravity * h1 * (1 - std::cos(top)) +
         m2 * gravity * (L * (1 - std::cos(top)) + h2 * (1 - std::cos(bottom)));
}

Quantities simulated(const Quantities& p, const scene::Scene& scene) {
  const Run run = simulate(scene);
  hydro::require(run.stopped.empty(), "zanten-waves: {}", run.stopped);
  const auto& top = run.signal("upper.angle");
  const auto& relative = run.signal("lower.angle");
  const bool has_friction = scene.joints.at(1).friction.has_value();
  Quantities out;
  for (std::size_t i = 1; i + 1 < top.size(); ++i) {
    const double span = run.time[i + 1] - run.time[i - 1], rate = (top[i + 1] - top[i - 1]) / span,
                 relative_rate = (relative[i + 1] - relative[i - 1]) / span;
    const double elastic = elastic_energy(p, top[i], top[i] + relative[i], rate, rate + relative_rate);
    const double dissipated = has_friction ? run.signal("energy.friction.dissipated")[i] : 0;
    const auto largest = [&](const char* name, double value) { out[name] = std::max(out[name], value); };
    largest("theta_top_max", std::abs(top[i]) / degree);
    // Without friction nothing keeps the angle: the largest one is meant.
    if (!has_friction) largest("theta_rel_end", std::abs(relative[i]) / degree);
    largest("E_el_max", elastic);
    largest("E_diss_max", dissipated);
    largest("E_abs_max", elastic + dissipated);
  }
  if (has_friction) out["theta_rel_end"] = std::abs(relative.back()) / degree;
  return out;
}

/// Rows in which nothing is expected have no relative error.
bool counts(const std::string& quantity, double torque) {
  if (quantity == "theta_rel_end") return torque < 11;
  return quantity != "E_diss_max" || (torque > 0 && torque < 11);
}

struct Mean {
  double sum = 0;
  int count = 0;
  void add(double value, double measured) { add(std::abs(value - measured) / std::abs(measured)); }
  void add(double value) {
    sum += value;
    ++count;
  }
  double percent() const { return 100 * sum / count; }
};

/// Both energies over what is absorbed, figures 4.7 and 4.9: each at its own largest.
double elastic_share(const Quantities& of) { return of.at("E_el_max") / of.at("E_abs_max"); }
double dissipated_share(const Quantities& of) { return of.at("E_diss_max") / of.at("E_abs_max"); }

/// What is left where both parts hang still and the hinge holds its relative angle: the least of eq. 4.2 over the top
/// angle.
double stored_at_rest(const Quantities& p, double relative) {
  const double lower = p.at("mass_2") * gravity * p.at("cog_2");
  const double upper = gravity * (p.at("mass_1") * p.at("cog_1") + p.at("mass_2") * p.at("length_1"));
  return upper + lower - std::sqrt(upper * upper + lower * lower + 2 * upper * lower * std::cos(relative));
}

double dissipated_over_stored(const Quantities& p, const Quantities& of) {
  return of.at("E_diss_max") / stored_at_rest(p, of.at("theta_rel_end") * degree);
}

/// How results of one model stand to the measured ones of one pendulum.
struct Standing {
  std::map<std::string, Mean> errors;
  Mean in_range, in_quartiles, elastic, dissipated;
};

void judge(Standing& standing, const Quantities& of, const Measured& measured, double torque) {
  for (const std::string& q : quantities) {
    if (!counts(q, torque)) continue;
    const double value = of.at(q);
    standing.errors[q].add(value, measured.median.at(q));
    standing.in_range.add(value >= measured.least.at(q) && value <= measured.largest.at(q) ? 1 : 0);
    standing.in_quartiles.add(value >= measured.first_quartile.at(q) && value <= measured.third_quartile.at(q) ? 1 : 0);
  }
  standing.elastic.add(std::abs(elastic_share(of) - elastic_share(measured.median)));
  if (counts("E_diss_max", torque))
    standing.dissipated.add(std::abs(dissipated_share(of) - dissipated_share(measured.median)));
}

void tell(std::vector<Number>& numbers, const std::string& pendulum, const std::string& whose, Standing& standing) {
  for (const std::string& q : quantities)
    numbers.push_back({pendulum + ", " + q + ", mean error" + whose, standing.errors[q].percent(), "%"});
  numbers.push_back({pendulum + ", share of elastic energy, mean error" + whose, standing.elastic.percent(), "%"});
  numbers.push_back(
      {pendulum + ", share of dissipated energy, mean error" + whose, standing.dissipated.percent(), "%"});
  numbers.push_back({pendulum + ", within the least and largest run" + whose, standing.in_range.percent(), "%"});
  numbers.push_back({pendulum + ", within the quartiles" + whose, standing.in_quartiles.percent(), "%"});
}

/// Curves over the torque of the hinge, at the middle place of the three.
struct Curves {
  plot::Series absorbed{.name = "Froude", .x = {}, .y = {}}, elastic{.name = "elastic, Froude", .x = {}, .y = {}},
      dissipated{.name = "dissipated, Froude", .x = {}, .y = {}},
      median{.name = "median", .x = {}, .y = {}, .dashed = true},
      elastic_median{.name = "elastic, medians", .x = {}, .y = {}, .dashed = true},
      dissipated_median{.name = "dissipated, medians", .x = {}, .y = {}, .dashed = true};
  plot::Band runs{.name = "least to largest", .x = {}, .low = {}, .high = {}};
  plot::Band quartiles{.name = "quartiles", .x = {}, .low = {}, .high = {}};
};

void append(plot::Series& series, double x, double y) {
  series.x.push_back(x);
  series.y.push_back(y);
}
void append(plot::Band& band, double x, double low, double high) {
  band.x.push_back(x);
  band.low.push_back(low);
  band.high.push_back(high);
}

void append(Curves& curves, double torque, const Quantities& here, const Measured& measured) {
  const std::string q = "E_abs_max";
  append(curves.absorbed, torque, here.at(q));
  append(curves.median, torque, measured.median.at(q));
  append(curves.runs, torque, measured.least.at(q), measured.largest.at(q));
  append(curves.quartiles, torque, measured.first_quartile.at(q), measured.third_quartile.at(q));
  append(curves.elastic, torque, elastic_share(here));
  append(curves.elastic_median, torque, elastic_share(measured.median));
  append(curves.dissipated, torque, dissipated_share(here));
  append(curves.dissipated_median, torque, dissipated_share(measured.median));
}

struct Pictures {
  plot::Figure absorbed{.title = "Energy that the pendulum takes from the group, focus 1 m ahead", .panels = {}};
  plot::Figure shares{.title = "Shares of the energy taken, focus 1 m ahead", .panels = {}};
};

void draw(Pictures& pictures, const std::string& pendulum, const Curves& c) {
  const plot::Axis torque{"torque of the hinge, " + pendulum + " pendulum", "N m"};
  pictures.absorbed.panels.push_back({.x = torque,
                                      .y = {"largest absorbed energy", "J"},
                                      .series = {c.absorbed, c.median},
                                      .bands = {c.runs, c.quartiles}});
  pictures.shares.panels.push_back({.x = torque,
                                    .y = {"share of the absorbed energy", ""},
                                    .series = {c.elastic, c.elastic_median, c.dissipated, c.dissipated_median}});
}

double median(std::vector<double> of) {
  std::sort(of.begin(), of.end());
  const std::size_t half = of.size() / 2;
  return of.size() % 2 == 1 ? of[half] : 0.5 * (of[half - 1] + of[half]);
}

/// Dissipated energy over what is stored at rest, of conditions with a torque of at most 2 N m and with more: what is
/// stored grows with the square of the angle, what is dissipated with the angle times the torque.
struct OverStored {
  std::vector<double> gentle, firm;
  void add(double torque, double ratio) { (torque < 2.5 ? gentle : firm).push_back(ratio); }
};

void tell(std::vector<Number>& numbers, const std::string& whose, const OverStored& of) {
  numbers.push_back({"dissipated over stored energy, up to 2 N m, median" + whose, median(of.gentle), ""});
  numbers.push_back({"dissipated over stored energy, above 2 N m, median" + whose, median(of.firm), ""});
}

}  // namespace

Outcome outcome(const Folders& folders) {
  const auto results = read_results(folders);
  const auto factors = packet_factors(folders, results);
  Outcome out;
  Pictures pictures;
  OverStored ours_over_stored, measured_over_stored;
  for (const std::string pendulum : {"long", "medium", "short"}) {
    const Quantities p = read_pendulum(folders, pendulum);
    Standing ours, thesis;
    Curves curves;
    for (const auto& [condition, measured] : results) {
      if (condition.pendulum != pendulum) continue;
      scene::Scene scene = scene_of(folders, p, condition);
      multiply_packets(scene, factors.at(condition.focus));
      const Quantities here = simulated(p, scene);
      judge(ours, here, measured, condition.torque);
      judge(thesis, measured.thesis, measured, condition.torque);
      if (condition.focus == 28.88) append(curves, condition.torque, here, measured);
      if (!counts("E_diss_max", condition.torque)) continue;
      ours_over_stored.add(condition.torque, dissipated_over_stored(p, here));
      measured_over_stored.add(condition.torque, dissipated_over_stored(p, measured.median));
    }
    tell(out.numbers, pendulum, "", ours);
    tell(out.numbers, pendulum, " of the thesis's own model", thesis);
    draw(pictures, pendulum, curves);
  }
  tell(out.numbers, "", ours_over_stored);
  tell(out.numbers, " of the measured medians", measured_over_stored);
  out.pictures.push_back({"absorbed", "What five or six runs measured, and one run each.", pictures.absorbed});
  out.pictures.push_back(
      {"shares", "Largest elastic and largest dissipated energy over the largest absorbed.", pictures.shares});
  return out;
}

}  // namespace froude::validation::zanten_waves
