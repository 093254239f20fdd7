// `froude fatigue`: cycles of records, and what they do.
#include "hydro/signal/fatigue.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "answers/picture.hpp"
#include "froude/commands.hpp"
#include "froude/option.hpp"
#include "froude/outputs.hpp"
#include "froude/record_file.hpp"
#include "froude/record_looks.hpp"
#include "froude/report.hpp"
#include "froude/sn_curve.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/units.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/signal/zero_crossings.hpp"
#include "scene/placed.hpp"

namespace froude {
namespace {

namespace hs = hydro::signal;

/// What was counted of the signal.
struct Counted {
  Signal signal;
  std::vector<hs::Cycle> cycles;
  double duration;                    ///< s, of what was measured
  double missed;                      ///< share of crests that lies between samples
  std::vector<std::string> cautions;  ///< of the record itself

  double count() const {
    return std::accumulate(cycles.begin(), cycles.end(), 0.0, [](double sum, const auto& c) { return sum + c.count; });
  }
  double largest() const {
    double out = 0;
    for (const auto& c : cycles) out = std::max(out, c.range);
    return out;
  }
  /// The one range that, as often as cycles were counted, does what they do on a curve of one slope.
  double equivalent(double slope) const {
    double sum = 0;
    for (const auto& c : cycles) sum += c.count * std::pow(c.range, slope);
    return std::pow(sum / count(), 1 / slope);
  }
};

Counted count(const FatigueArguments& a) {
  RunResult record = read_record(a.file);
  hydro::require(!record.time.empty(), "the record has no samples");
  if (a.from) drop_before(record, option_si("--from", *a.from, hydro::dim::time), a.file);
  const Signal& signal = signal_of(record, a.signal, a.file);
  require_known(a.accept, {"stop"});
  if (!accepts(a.accept, "stop")) require_free_of_stops(signal, Ends::both, a.file);
  const MeasuredTime measured = measured_time(record.time);
  Counted out{signal, hs::rainflow(signal.values), measured.time.back() - measured.time.front(),
              hs::missed_of_crests(measured.time, signal.values), measured.cautions()};
  const auto stops = cautions_of_stops({&signal, 1});
  out.cautions.insert(out.cautions.end(), stops.begin(), stops.end());
  hydro::require(!out.cycles.empty(), "{} never changes: it has no cycles", a.signal);
  return out;
}

/// Ranges that are too short because crests lie between samples, and what that does to damage.
std::vector<std::string> cautions_of(const Counted& c, const std::optional<SnOfUnit>& sn) {
  return cautions_of_samples(c.missed, sn ? fmt::format(", so that damage is about {:.2g} % too small",
                                                        100 * (1 - std::pow(1 - c.missed, sn->curve.slope)))
                                          : "");
}

Report report_of(const Counted& c, const std::optional<SnOfUnit>& sn) {
  Report out;
  out.say("{}: {} cycles in {:.6g} s, the largest range {:.5g} {}", fact("signal", c.signal.name),
          fact("cycles", c.count()), fact("duration_s", c.duration), fact("largest_range", c.largest()),
          fact("unit", c.signal.units));
  out.sentences("cautions", "caution: {}", c.cautions);
  out.sentences("cautions", "caution: {}", cautions_of(c, sn));
  if (!sn) return out.say("no damage without an S-N curve: --sn-range, --sn-cycles, --sn-slope");
  const hs::SnCurve& curve = sn->curve;
  const double damage = hs::damage(c.cycles, curve), hour = 3600;
  out.say("damage {:.4g} (Miner's sum, 1 is failure), {:.4g} an hour; life {:.4g} h", fact("damage", damage),
          fact("damage_per_hour", damage / c.duration * hour), fact("life_h", c.duration / damage / hour));
  if (!curve.slope_below)
    out.say("equivalent range {:.5g} {}: as many cycles of it do the same",
            fact("equivalent_range", c.equivalent(curve.slope)), c.signal.units);
  return out;
}

/// How many cycles are larger than a range, over the range.
plot::Figure figure(const Counted& c, const std::string& file_name) {
  std::vector<hs::Cycle> sorted = c.cycles;
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.range > b.range; });
  plot::Series series{c.signal.name, {}, {}};
  double above = 0;
  for (const auto& cycle : sorted) {
    series.x.push_back(above += cycle.count);
    series.y.push_back(cycle.range);
  }
  return {.title = "Rainflow ranges of " + file_name,
          .panels = {{.x = {.label = "cycles at least as large", .unit = "", .scale = plot::Scale::logarithmic},
                      .y = {.label = "range", .unit = c.signal.units},
                      .series = {series}}}};
}

void write_cycles(const Path& path, const Counted& c) {
  std::vector<double> range, mean, times;
  for (const auto& cycle : c.cycles) {
    range.push_back(cycle.range);
    mean.push_back(cycle.mean);
    times.push_back(cycle.count);
  }
  hydro::io::write_csv(path,
                       {{"range", c.signal.units, &range}, {"mean", c.signal.units, &mean}, {"count", "", &times}},
                       {fmt::format("rainflow cycles of {} in the order in which they close", c.signal.name)});
}

}  // namespace

void fatigue(const FatigueArguments& arguments, const Console& console) {
  require_outputs(named({{"-o", arguments.output}, {"--picture", arguments.picture}}),
                  {{"the record", arguments.file}});
  require_picture(arguments.picture);
  require_csv(arguments.output);
  const std::optional<SnOfUnit> sn = sn_curve(arguments.sn);
  const Counted counted = scene::placed({.file = arguments.file.string()}, [&] { return count(arguments); });
  if (sn) require_one_fits(*sn, {counted.signal.units});
  if (arguments.output) write_cycles(*arguments.output, counted);
  if (arguments.picture) plot::write_picture(*arguments.picture, figure(counted, arguments.file.filename().string()));
  tell(report_of(counted, sn).wrote(arguments.output).wrote(arguments.picture), console);
}

}  // namespace froude
