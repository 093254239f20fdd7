#include <cmath>
#include <numbers>
#include <vector>

#include "harness/case.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/signal/harmonics.hpp"

namespace froude::validation::flume_box {
namespace {

/// Amplitude of the wave's period in five periods from 32 s on.
double amplitude(const hydro::io::CsvTable& table, const char* column, double period) {
  const auto& time = table.column("Time");
  const auto& values = table.column(column);
  std::vector<double> t, x;
  for (std::size_t i = 0; i < time.size(); ++i)
    if (time[i] >= 32 && time[i] <= 32 + 5 * period) {
      t.push_back(time[i]);
      x.push_back(values[i]);
    }
  const std::vector<double> omega{2 * std::numbers::pi / period};
  return std::abs(hydro::signal::fit_harmonics(t, x, omega).amplitude[0]);
}

/// What the probes on both sides of the model's place tell of the waves without it.
double wave(const Folders& folders, const std::string& run, double period) {
  const auto table = hydro::io::CsvTable::read(folders.shared("wave_flume_box/1PPH/" + run + ".csv"));
  return (amplitude(table, "WP_3", period) + amplitude(table, "WP_4", period)) / 2;
}

}  // namespace

Outcome outcome(const Folders& folders) {
  struct Condition {
    double period;
    const char *waves, *model;
  };
  Outcome out;
  for (const auto& [period, waves, model] :
       {Condition{1.238, "1031_1", "3031_2"}, Condition{1.158, "1061_1", "3061_1"},
        Condition{0.897, "1101_1", "3101_3"}, Condition{0.802, "1111_1", "3111_2"}}) {
    const auto track = hydro::io::CsvTable::read(folders.shared(fmt::format("wave_flume_box/3PPH/{}.csv", model)));
    out.numbers.push_back({fmt::format("heave per wave amplitude at {:.3f} s", period),
                           amplitude(track, "Heave", period) / wave(folders, waves, period), ""});
    if (period != 1.158) continue;
    out.numbers.push_back({"sway at 1.158 s", amplitude(track, "Sway", period), "m"});
    out.numbers.push_back({"roll at 1.158 s", amplitude(track, "Roll", period), "rad"});
  }
  return out;
}

}  // namespace froude::validation::flume_box
