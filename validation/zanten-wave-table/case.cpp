#include <algorithm>
#include <cmath>

#include "harness/case.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/waves/kinematics/focus.hpp"

namespace froude::validation::zanten_wave_table {
namespace {

namespace hw = hydro::waves;

std::vector<hw::Packet> packets_of(const hydro::io::CsvTable& table) {
  std::vector<hw::Packet> out;
  const auto &amplitude = table.column("amplitude_m"), &period = table.column("period_s");
  for (std::size_t i = 0; i < table.rows(); ++i)
    out.push_back({hydro::WaveAmplitude::from_metres(amplitude[i]), hydro::AngularFrequency::from_period_s(period[i])});
  return out;
}

/// How long the water at x moves because of one packet, from its elevation alone.
double stay_of(const hw::PacketField& field, double x, double around, double reach) {
  const auto edge = [&](double inside, double outside) {
    for (int i = 0; i < 80; ++i) {
      const double middle = (inside + outside) / 2;
      // The envelope starts as s²: what is exactly zero is outside.
      (field.elevation(middle, x, 0) != 0 ? inside : outside) = middle;
    }
    return inside;
  };
  return edge(around, around + reach) - edge(around, around - reach);
}

}  // namespace

Outcome outcome(const Folders& folders) {
  const auto table = hydro::io::CsvTable::read(folders.reference("zanten_table3_1_wave_components.csv"));
  const hydro::Water water{.density = 1000, .gravity = 9.81, .depth = hydro::WaterDepth::from_metres(0.994)};
  const auto packets = packets_of(table);
  const hw::PacketField field(packets, {.x_m = -1}, hydro::Angle::from_radians(0), water);
  Outcome out;
  const auto velocity = field.group_velocities();
  double worst = 0;
  for (std::size_t i = 0; i < packets.size(); ++i) {
    const double T = table.column("period_s")[i];
    out.numbers.push_back({fmt::format("group velocity at {} s", T), velocity[i], "m/s"});
    const hw::PacketField alone({&packets[i], 1}, {.x_m = -1}, hydro::Angle::from_radians(0), water);
    const double around = 1 / velocity[i] + 0.01 * T;  // near the middle, off the zeros of the cosine
    worst = std::max(worst, std::abs(stay_of(alone, 0, around, 3 * T) / (3.5 * T) - 1));
  }
  out.numbers.push_back({"elevation at the focus", field.elevation(0, -1, 0), "m"});
  out.numbers.push_back({"greatest relative difference of a packet's stay at a place from 3.5 periods", worst, ""});
  plot::Panel panel{.x = {.label = "time from focus", .unit = "s"},
                    .y = {.label = "elevation at the pendulum", .unit = "m"},
                    .series = {}};
  for (const double ahead : {1.5, 1.0, 0.5}) {
    const hw::PacketField f(packets, {.x_m = -ahead}, hydro::Angle::from_radians(0), water);
    plot::Series s{.name = fmt::format("focus {} m ahead", ahead), .x = {}, .y = {}};
    for (int n = -200; n <= 200; ++n) {
      s.x.push_back(0.02 * n);
      s.y.push_back(f.elevation(0.02 * n, 0, 0));
    }
    panel.series.push_back(std::move(s));
  }
  out.pictures = {{"packets",
                   "The focused group at the pendulum for the three foci of the experiment, by linear packets.",
                   {.title = "Ten packets that meet", .panels = {panel}}}};
  return out;
}

}  // namespace froude::validation::zanten_wave_table
