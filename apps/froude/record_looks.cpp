#include "froude/record_looks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "fit/sensor.hpp"
#include "hydro/base/error.hpp"

namespace froude {
namespace {

/// Of fewer samples in a row a smooth crest may have that many alike: two, one on each side of its top.
constexpr std::size_t least_in_a_row = 3;

struct SignalStop {
  double level;
  std::size_t samples;
};

std::vector<SignalStop> stops_of(const std::vector<double>& values, Ends ends) {
  std::vector<SignalStop> out;
  const auto found = fit::find_clipping(values);
  if (!found) return out;
  if (ends != Ends::high && found->at_low > 0 && found->low_in_a_row >= least_in_a_row)
    out.push_back({found->low, found->at_low});
  if (ends != Ends::low && found->at_high > 0 && found->high_in_a_row >= least_in_a_row)
    out.push_back({found->high, found->at_high});
  return out;
}

std::string told(const Signal& signal, const SignalStop& stop) {
  return fmt::format("{} stands at {:.5g}{} in {:.2g} % of its samples, as a sensor does at its stop", signal.name,
                     stop.level, signal.units.empty() ? "" : " " + signal.units,
                     100 * static_cast<double>(stop.samples) / static_cast<double>(signal.values.size()));
}

double median_of_steps(const std::vector<double>& time, std::size_t step) {
  constexpr std::size_t around = 15;  // on each side
  const std::size_t from = step > around ? step - around : 1, to = std::min(time.size(), step + around + 1);
  std::vector<double> steps;
  for (std::size_t j = from; j < to; ++j) steps.push_back(time[j] - time[j - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

}  // namespace

void require_known(const std::vector<std::string>& accepted, const std::vector<std::string>& known) {
  for (const std::string& name : accepted)
    if (!accepts(known, name))
      throw hydro::InputError(fmt::format("\"{}\" is nothing that can be accepted here", name), {.file = "--accept"},
                              fmt::format("what can be accepted: {}", fmt::join(known, ", ")));
}

bool accepts(const std::vector<std::string>& accepted, const std::string& name) {
  return std::find(accepted.begin(), accepted.end(), name) != accepted.end();
}

std::vector<std::string> cautions_of_stops(std::span<const Signal> signals) {
  std::vector<std::string> out;
  for (const Signal& s : signals)
    for (const SignalStop& stop : stops_of(s.values, Ends::both))
      out.push_back(told(s, stop) + ": what lies beyond is lost, or the signal itself is limited there");
  return out;
}

void require_free_of_stops(const Signal& signal, Ends ends, const Path& file) {
  const bool is_run = file.extension() == ".h5" || file.extension() == ".nc";
  if (is_run) return;
  for (const SignalStop& stop : stops_of(signal.values, ends))
    if (stop.level < 0 || stop.level > 0)
      throw hydro::InputError(
          told(signal, stop) + ": larger values are not in the record, and no law can be drawn from it",
          {.file = file.string()},
          "measure with a wider range, leave that part out with --from, or, where the signal itself is limited there, "
          "add --accept stop");
}

std::vector<std::string> MeasuredTime::cautions() const {
  if (gaps == 0) return {};
  return {
      fmt::format("{} gap{} in the record, {:.6g} s in all, the longest of {:.6g} s after {:.6g} s: no time is "
                  "counted there",
                  gaps, gaps == 1 ? "" : "s", missing, longest, after)};
}

MeasuredTime measured_time(const std::vector<double>& time) {
  constexpr double longer = 3;
  MeasuredTime out{.time = time};
  double taken = 0;
  for (std::size_t j = 1; j < time.size(); ++j) {
    const double step = time[j] - time[j - 1], usual = median_of_steps(time, j);
    if (step > longer * usual) {
      ++out.gaps;
      taken += step - usual;
      if (step > out.longest) {
        out.longest = step;
        out.after = time[j - 1];
      }
    }
    out.time[j] = time[j] - taken;
  }
  out.missing = taken;
  return out;
}

}  // namespace froude
