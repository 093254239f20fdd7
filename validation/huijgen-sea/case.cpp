#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "answers/simulate.hpp"
#include "harness/case.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/signal/fft.hpp"
#include "hydro/waves/kinematics/focus.hpp"

namespace froude::validation::huijgen_sea {
namespace {

namespace hw = hydro::waves;
constexpr double g = 9.81, depth = 30, two_pi = 2 * std::numbers::pi;

struct Row {
  double omega, amplitude, epsilon, k;
};

/// k of ω² = gk tanh kh by bisection: slow, plain and nobody else's.
double wavenumber_by_bisection(double omega) {
  double low = 0, high = omega * omega / g + omega / std::sqrt(g * depth);
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (g * middle * std::tanh(middle * depth) < omega * omega ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// Equations 6.2, 6.5, 6.6, 6.8 and 6.9 of the source for μ = π/2 at x = 0: ζ, u_y, u_z, and their rates.
std::array<double, 5> by_the_source(const std::vector<Row>& rows, double t, double y, double z) {
  std::array<double, 5> sum{};
  for (const Row& r : rows) {
    const double angle = r.k * y - r.omega * t + r.epsilon, up = r.k * (depth + z);
    const double along = r.amplitude * r.omega * std::cosh(up) / std::sinh(r.k * depth);
    const double across = r.amplitude * r.omega * std::sinh(up) / std::sinh(r.k * depth);
    sum[0] += r.amplitude * std::cos(angle);
    sum[1] += along * std::cos(angle);
    sum[2] += across * std::sin(angle);
    sum[3] += along * r.omega * std::sin(angle);
    sum[4] -= across * r.omega * std::cos(angle);
  }
  return sum;
}

/// One run of the dropper and what is told of it.
struct DropperRun {
  Run record;
  double residual = 0;  ///< of the energy supplied

  DropperRun(const Folders& folders, const char* file) : record(simulate(scene::read(folders.own() / file))) {
    const double supplied = record.signal("energy.dropper.supplied").back();
    for (const double r : record.signal("energy.dropper.residual"))
      residual = std::max(residual, std::abs(r / supplied));
  }
  plot::Series against_time(const std::string& signal, const std::string& name) const {
    return {.name = name, .x = record.time, .y = record.signal(signal)};
  }
  /// Amplitudes of the harmonics of the whole record, without the mean.
  plot::Series spectrum(const std::string& signal, const std::string& name) const {
    const auto& values = record.signal(signal);
    const auto half = hydro::signal::real_fft(values);
    plot::Series s{.name = name, .x = {}, .y = {}};
    for (std::size_t k = 1; k < half.size() && static_cast<double>(k) / record.time.back() < 2; ++k) {
      s.x.push_back(static_cast<double>(k) / record.time.back());
      s.y.push_back(2 * std::abs(half[k]) / static_cast<double>(values.size()));
    }
    return s;
  }
  plot::Series phase(const std::string& angle) const {
    return {.name = {}, .x = record.signal(angle), .y = record.signal(angle + "_rate")};
  }
};

std::vector<Picture> pictures_of(const DropperRun& run) {
  const std::string polar = "dropper.link10.polar", azimuth = "dropper.link10.azimuth";
  const plot::Axis time{.label = "time", .unit = "s"}, frequency{.label = "frequency", .unit = "Hz"};
  const auto angle = [](const char* label) { return plot::Axis{.label = label, .unit = "rad"}; };
  const auto rate = [](const char* label) { return plot::Axis{.label = label, .unit = "rad/s"}; };
  return {{"link10",
           "Tenth link of the dropper in the group of appendix G.",
           {.title = "Angles of link 10",
            .panels = {{.x = time, .y = angle("polar"), .series = {run.against_time(polar, {})}},
                       {.x = time, .y = angle("azimuth"), .series = {run.against_time(azimuth, {})}}},
            .panel_height = 240}},
          {"spectrum10",
           "Amplitudes of the harmonics of both angles over the 30 s, without their means.",
           {.title = "Response of link 10",
            .panels = {{.x = frequency,
                        .y = angle("amplitude"),
                        .series = {run.spectrum(polar, "polar"), run.spectrum(azimuth, "azimuth")}}}}},
          {"phase10",
           "Rate against angle of the tenth link.",
           {.title = "Phase plots of link 10",
            .panels = {{.x = angle("polar"), .y = rate("polar rate"), .series = {run.phase(polar)}},
                       {.x = angle("azimuth"), .y = rate("azimuth rate"), .series = {run.phase(azimuth)}}},
            .width = 700}}};
}

/// Runs of the dropper in both seas, added to what the sea alone tells.
void add_dropper(const Folders& folders, Outcome& out) {
  const DropperRun group(folders, "group.toml"), storm(folders, "storm.toml");
  const auto largest = [](const DropperRun& run) {
    const auto& tension = run.record.signal("dropper.largest_tension");
    return *std::max_element(tension.begin(), tension.end());
  };
  const std::vector<Number> numbers{
      {"runs of the dropper that stopped early, step 0.03 s",
       static_cast<double>(!group.record.stopped.empty()) + static_cast<double>(!storm.record.stopped.empty()), ""},
      {"dropper in the group: energy residual, of the energy supplied", group.residual, ""},
      {"dropper in the storm: energy residual, of the energy supplied", storm.residual, ""},
      {"dropper in the group: largest tension", largest(group), "N"},
      {"dropper in the storm: largest tension", largest(storm), "N"},
      {"dropper in the storm: steps halved", static_cast<double>(storm.record.halvings), ""}};
  out.numbers.insert(out.numbers.end(), numbers.begin(), numbers.end());
  for (auto& picture : pictures_of(group)) out.pictures.push_back(std::move(picture));
}

}  // namespace

Outcome outcome(const Folders& folders) {
  const auto table = hydro::io::CsvTable::read(folders.reference("huijgen_appendixG_wave_components.csv"));
  const auto &period = table.column("period_s"), &amplitude = table.column("amplitude_m"),
             &phase = table.column("phase_rad");
  std::vector<Row> rows;
  std::vector<hw::GivenWave> list;
  double all = 0;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double omega = two_pi / period[i];
    rows.push_back({omega, amplitude[i], phase[i], wavenumber_by_bisection(omega)});
    // φ of ours is −ε of the source: cos(kx − ωt + ε) = cos(ωt − kx − ε).
    list.push_back({hydro::AngularFrequency::from_period_s(period[i]), hydro::WaveAmplitude::from_metres(amplitude[i]),
                    -phase[i], hydro::Angle::from_degrees(90)});
    all += amplitude[i];
  }
  const hw::Sea sea =
      hw::Sea::of(list, {.density = 1000, .gravity = g, .depth = hydro::WaterDepth::from_metres(depth)});
  hw::HarmonicField::Options options;
  options.stretching = hw::Stretching::vertical;
  const hw::HarmonicField field = hw::linear_field(sea, options);
  std::array<double, 5> worst{}, largest{};
  plot::Series series{.name = "elevation at the origin", .x = {}, .y = {}};
  for (int n = 0; n <= 600; ++n) {
    const double t = 0.05 * n;
    const hw::Kinematics k = field.at(t, {0, 3, -5});
    const std::array<double, 5> ours{k.elevation, k.velocity.y(), k.velocity.z(), k.acceleration.y(),
                                     k.acceleration.z()},
        theirs = by_the_source(rows, t, 3, -5);
    for (std::size_t i = 0; i < 5; ++i) {
      worst[i] = std::max(worst[i], std::abs(ours[i] - theirs[i]));
      largest[i] = std::max(largest[i], std::abs(theirs[i]));
    }
    series.x.push_back(t);
    series.y.push_back(sea.elevation(t, 0, 0));
  }
  double difference = 0;
  for (std::size_t i = 0; i < 5; ++i) difference = std::max(difference, worst[i] / largest[i]);
  const hw::FocusFound focus = hw::find_focus(sea, 0, 0, -120, 120);
  Outcome out{
      .numbers = {{"components", static_cast<double>(sea.components().size()), ""},
                  {"significant wave height", sea.hs(), "m"},
                  {"sum of amplitudes", all, "m"},
                  {"largest difference of elevation and kinematics from the source's equations, relative", difference,
                   ""},
                  {"envelope at the focus, share of the sum of amplitudes", focus.share, ""},
                  {"chance of the highest crest in a random sea", focus.probability, ""},
                  {"time of the focus", focus.t_s, "s"},
                  {"highest crest", focus.crest_m, "m"},
                  {"time of the highest crest", focus.crest_t_s, "s"}},
      .pictures = {{"elevation",
                    "Elevation at the origin over the 30 s of the source's run: the group passes at its beginning.",
                    {.title = "Sea of the looped dropper",
                     .panels = {{.x = {.label = "time", .unit = "s"},
                                 .y = {.label = "elevation", .unit = "m"},
                                 .series = {series}}}}}}};
  add_dropper(folders, out);
  return out;
}

}  // namespace froude::validation::huijgen_sea
