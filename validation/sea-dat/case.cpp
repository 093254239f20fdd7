#include <cmath>
#include <fstream>

#include "harness/case.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/welch.hpp"
#include "hydro/signal/zero_crossings.hpp"

namespace froude::validation::sea_dat {

namespace hs = hydro::signal;

Outcome outcome(const Folders& folders) {
  std::ifstream file(folders.shared("waves_measured/wafo/sea.dat"));
  std::vector<double> time, elevation;
  for (double t = 0, z = 0; file >> t >> z;) {
    time.push_back(t);
    elevation.push_back(z);
  }
  hydro::require(time.size() == 9524, "sea.dat has 9524 samples, {} were read", time.size());
  double mean = 0, variance = 0;
  for (const double z : elevation) mean += z / 9524;
  for (const double z : elevation) variance += (z - mean) * (z - mean) / 9523;  // as the outside number: n − 1
  Outcome out{.numbers = {{"4 standard deviations", 4 * std::sqrt(variance), "m"}}};
  const double step = hs::even_step(time);
  plot::Panel panel{.x = {.label = "frequency", .unit = "Hz", .range = {{0, 0.6}}},
                    .y = {.label = "density", .unit = "m^2/Hz"},
                    .series = {}};
  for (const std::size_t segment : {512u, 1024u}) {
    const hs::WelchSpectrum w = hs::welch(elevation, step, {.segment = segment});
    // From the first positive frequency, as the outside numbers.
    const hs::Moments m =
        hs::moments(w.spectrum, {.from_hz = w.spectrum.frequency_hz[1], .to_hz = w.spectrum.frequency_hz.back()});
    out.numbers.push_back({fmt::format("Hm0, segments of {}", segment), m.hs(), "m"});
    out.numbers.push_back({fmt::format("Tm02, segments of {}", segment), m.tm02(), "s"});
    if (segment == 1024) out.numbers.push_back({"Te, segments of 1024", m.te(), "s"});
    panel.series.push_back({fmt::format("segments of {}", segment), w.spectrum.frequency_hz, w.spectrum.density});
  }
  const auto waves = hs::single_waves(time, elevation);
  const hs::WaveStatistics s = hs::wave_statistics(waves);
  out.numbers.push_back({"up-crossings", static_cast<double>(s.count + 1), ""});
  out.numbers.push_back({"mean period of single waves", s.mean_period, "s"});
  out.numbers.push_back({"H1/3", s.h13, "m"});
  out.numbers.push_back({"highest wave", s.highest, "m"});
  out.pictures = {{"spectrum",
                   "Spectrum of the record with two lengths of segment.",
                   {.title = "Forty minutes of measured sea", .panels = {panel}},
                   true}};
  return out;
}

}  // namespace froude::validation::sea_dat
