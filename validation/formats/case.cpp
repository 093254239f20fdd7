#include <array>
#include <cmath>
#include <numbers>

#include "harness/case.hpp"
#include "hydro/base/random.hpp"
#include "hydro/potential/operations/operations.hpp"

namespace froude::validation::formats {
namespace {

using hydro::potential::FrequencyTable;

constexpr std::array<Eigen::Index, 3> modes{0, 2, 4};  // surge, heave, pitch
constexpr int frequencies = 71;                        // 0.6 to 2.0 rad/s
double omega_of(int n) { return 0.6 + 0.02 * n; }

/// Per density (and gravity), so that codes with different water can be compared.
struct Body {
  std::string name;
  FrequencyTable table;
  double A(int n, Eigen::Index mode) const {
    return table.added_mass(omega_of(n))(mode, mode) / table.coefficients().water.density;
  }
  double B(int n, Eigen::Index mode) const {
    return table.damping(omega_of(n))(mode, mode) / table.coefficients().water.density;
  }
  std::complex<double> X(int n, Eigen::Index mode) const {
    const hydro::Water& water = table.coefficients().water;
    return table.excitation(omega_of(n), 0)(mode) / (water.density * water.gravity);
  }
};

Body read(const std::string& name, const std::filesystem::path& path,
          const hydro::potential::ReadOptions& options = {}) {
  return {name, FrequencyTable(hydro::potential::read(path, options), {Eigen::Vector3d::Zero()})};
}

/// Largest difference over the frequencies, of the largest value, in the worst mode.
template <class Quantity>
double largest_difference(const Quantity& of_a, const Quantity& of_b) {
  double worst = 0;
  for (const Eigen::Index mode : modes) {
    double difference = 0, size = 0;
    for (int n = 0; n < frequencies; ++n) {
      difference = std::max(difference, std::abs(of_a(n, mode) - of_b(n, mode)));
      size = std::max(size, std::abs(of_b(n, mode)));
    }
    worst = std::max(worst, difference / size);
  }
  return worst;
}

/// Force per density and gravity on a body that is moved in waves, both made of all frequencies with fixed phases.
std::vector<double> force_history(const Body& body, Eigen::Index mode, const std::vector<double>& time) {
  constexpr double g = 9.81, wave = 0.1, motion = 0.05;  // m/s², m, m
  const hydro::RandomStream phases(1, 1);
  std::vector<double> force(time.size(), 0.0);
  for (int n = 0; n < frequencies; ++n) {
    const double omega = omega_of(n);
    const auto phase = [&](int which) {
      return 2 * std::numbers::pi * phases.uniform(static_cast<std::uint64_t>(2 * n + which));
    };
    const std::complex<double> impedance(omega * omega * body.A(n, mode), -omega * body.B(n, mode));
    const std::complex<double> F =
        body.X(n, mode) * std::polar(wave, phase(0)) + impedance / g * std::polar(motion, phase(1));
    for (std::size_t i = 0; i < time.size(); ++i) force[i] += (F * std::polar(1.0, omega * time[i])).real();
  }
  return force;
}

double rms_difference(const Body& a, const Body& b, const std::vector<double>& time) {
  double worst = 0;
  for (const Eigen::Index mode : modes) {
    const auto x = force_history(a, mode, time), y = force_history(b, mode, time);
    double difference = 0, size = 0;
    for (std::size_t i = 0; i < time.size(); ++i) {
      difference += (x[i] - y[i]) * (x[i] - y[i]);
      size += y[i] * y[i];
    }
    worst = std::max(worst, std::sqrt(difference / size));
  }
  return worst;
}

plot::Figure histories(const std::vector<Body>& bodies, const std::vector<double>& time) {
  plot::Figure figure{.title = "Ellipsoid, heave",
                      .panels = {{.x = {"time", "s"}, .y = {"force / (rho g)", "m^3"}, .series = {}}}};
  const std::vector<double> first(time.begin(), time.begin() + 400);
  for (const Body& body : bodies)
    figure.panels[0].series.push_back({.name = body.name, .x = first, .y = force_history(body, 2, first)});
  return figure;
}

}  // namespace

Outcome outcome(const Folders& folders) {
  const auto file = [&](const char* name) { return folders.shared(std::string("bem_formats/ellipsoid_") + name); };
  const hydro::potential::ReadOptions water{
      .density = 1000, .gravity = 9.81, .depth = hydro::WaterDepth::infinite(), .iperout = {}};
  std::vector<Body> bodies;
  bodies.push_back(read("WAMIT", file("wamit/ellipsoid.1"), water));
  bodies.push_back(read("NEMOH 2", file("nemoh_v2")));
  bodies.push_back(read("NEMOH 3", file("nemoh_v3")));
  bodies.push_back(read("Capytaine", file("capytaine/ellipsoid_hydrodynamics.nc")));
  bodies.push_back(read("AQWA", file("aqwa/ellipsoid.AH1")));
  std::vector<double> time;
  for (int i = 0; i < 2000; ++i) time.push_back(0.1 * i);
  Outcome out;
  const auto of = [](const Body& body, auto member) {
    return [&body, member](int n, Eigen::Index mode) { return (body.*member)(n, mode); };
  };
  for (std::size_t b = 1; b < bodies.size(); ++b) {
    const auto add = [&](const char* what, double value) {
      out.numbers.push_back({bodies[b].name + ": " + what, value, ""});
    };
    add("added mass", largest_difference(of(bodies[b], &Body::A), of(bodies[0], &Body::A)));
    add("damping", largest_difference(of(bodies[b], &Body::B), of(bodies[0], &Body::B)));
    add("excitation", largest_difference(of(bodies[b], &Body::X), of(bodies[0], &Body::X)));
    add("force history", rms_difference(bodies[b], bodies[0], time));
  }
  out.pictures.push_back(
      {"force", "Heave force on the body as each code has it, 40 s of 200 s.", histories(bodies, time), true});
  return out;
}

}  // namespace froude::validation::formats
