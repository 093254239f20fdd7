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
struct Measured {
  Quantities median, thesis;
};

std::map<Condition, Measured> read_results(const Folders& folders) {
  const auto table = hydro::io::CsvTable::read(folders.reference("results.csv"));
  const auto& pendulum = table.text_column("pendulum");
  const auto& quantity = table.text_column("quantity");
  std::map<Condition, Measured> out;
  for (std::size_t i = 0; i < pendulum.size(); ++i) {
    auto& of = out[{pendulum[i], table.column("x_focus_m")[i], table.column("torque_aim_Nm")[i]}];
    of.median[quantity[i]] = table.column("median")[i];
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
  void add(double value, double measured) {
    sum += std::abs(value - measured) / std::abs(measured);
    ++count;
  }
  double percent() const { return 100 * sum / count; }
};

}  // namespace

Outcome outcome(const Folders& folders) {
  const auto results = read_results(folders);
  const auto factors = packet_factors(folders, results);
  Outcome out;
  plot::Figure figure{.title = "Energy that the pendulum takes from the group, focus 1 m ahead", .panels = {}};
  for (const std::string pendulum : {"long", "medium", "short"}) {
    const Quantities p = read_pendulum(folders, pendulum);
    std::map<std::string, Mean> ours, thesis;
    plot::Series computed{.name = "Froude", .x = {}, .y = {}},
        measured{.name = "measured", .x = {}, .y = {}, .dashed = true};
    for (const auto& [condition, reference] : results) {
      if (condition.pendulum != pendulum) continue;
      scene::Scene scene = scene_of(folders, p, condition);
      multiply_packets(scene, factors.at(condition.focus));
      const Quantities here = simulated(p, scene);
      for (const std::string& q : quantities) {
        if (!counts(q, condition.torque)) continue;
        ours[q].add(here.at(q), reference.median.at(q));
        thesis[q].add(reference.thesis.at(q), reference.median.at(q));
      }
      if (condition.focus != 28.88) continue;
      computed.x.push_back(condition.torque), computed.y.push_back(here.at("E_abs_max"));
      measured.x.push_back(condition.torque), measured.y.push_back(reference.median.at("E_abs_max"));
    }
    for (const std::string& q : quantities) {
      out.numbers.push_back({pendulum + ", " + q + ", mean error", ours[q].percent(), "%"});
      out.numbers.push_back({pendulum + ", " + q + ", mean error of the thesis's own model", thesis[q].percent(), "%"});
    }
    figure.panels.push_back({.x = {"torque of the hinge, " + pendulum + " pendulum", "N m"},
                             .y = {"largest absorbed energy", "J"},
                             .series = {computed, measured}});
  }
  out.pictures.push_back({"absorbed", "Median of the measurements and one run each.", figure});
  return out;
}

}  // namespace froude::validation::zanten_waves
