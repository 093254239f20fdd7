#include "froude/series.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "answers/statistics.hpp"
#include "hydro/io/csv.hpp"

namespace froude {
namespace {

bool is_energy(const Signal& s) { return s.name.starts_with("energy."); }

}  // namespace

void add_series(Report& report, std::span<const Signal> signals) {
  Report all;
  report.say("{:<24} {:>12} {:>12} {:>12} {:>12} {}", "signal", "mean", "std", "lowest", "highest", "unit");
  for (const Signal& s : signals) {
    const Statistics st = statistics(s.values);
    Report one;
    one.say("{:<24} {:>12.4g} {:>12.4g} {:>12.4g} {:>12.4g} {}", s.name, fact("mean", st.mean),
            fact("standard_deviation", st.deviation), fact("lowest", st.lowest), fact("highest", st.highest),
            fact("unit", s.units));
    all.part(s.name, is_energy(s) ? one.untold() : one);
  }
  report.part("signals", all);
}

plot::Figure series_figure(const std::string& title, const std::vector<double>& time, std::span<const Signal> signals,
                           const std::map<std::string, std::string>& labels) {
  plot::Figure f{.title = title, .panels = {}};
  std::vector<std::string> units;
  for (const Signal& s : signals) {
    if (is_energy(s)) continue;
    auto at = std::find(units.begin(), units.end(), s.units);
    if (at == units.end()) {
      units.push_back(s.units);
      const auto label = labels.find(s.units);
      f.panels.push_back(
          {.x = {"time", "s"}, .y = {label == labels.end() ? "signal" : label->second, s.units}, .series = {}});
      at = units.end() - 1;
    }
    f.panels[static_cast<std::size_t>(at - units.begin())].series.push_back({s.name, time, s.values});
  }
  return f;
}

void write_series_csv(const Path& path, const std::vector<double>& time, std::span<const Signal> signals) {
  std::vector<hydro::io::CsvColumn> columns{{"time", "s", &time}};
  for (const Signal& s : signals) columns.push_back({s.name, s.units, &s.values});
  hydro::io::write_csv(path, columns);
}

}  // namespace froude
