#include "froude/record_file.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/base/units.hpp"
#include "hydro/io/csv.hpp"
#include "scene/scene.hpp"
#include "scene/schema.hpp"

namespace froude {
namespace {

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string ending_of(const Path& path) { return lower_case(path.extension().string()); }

bool is_table(const std::string& ending) { return ending == ".csv" || ending == ".txt" || ending == ".dat"; }

/// "time" or "t", in capitals or not; of several the first that is a time, since T may be a temperature. "" for none.
std::string time_column(const hydro::io::CsvTable& table) {
  std::string out;
  for (const std::string& name : table.names()) {
    const std::string lower = lower_case(name);
    if (lower != "time" && lower != "t") continue;
    if (table.has_known_unit(name) && hydro::compatible(table.dimension(name), hydro::dim::time)) return name;
    if (out.empty()) out = name;
  }
  return out;
}

/// The columns of numbers whose units are known; others are told only if they are asked for.
RunResult read_csv(const Path& path) {
  const auto table = hydro::io::CsvTable::read(path);
  RunResult record;
  const std::string time = time_column(table);
  if (time.empty())
    throw hydro::InputError("the table has no column \"time\" or \"t\"", {.file = path.string()},
                            fmt::format("its columns are: {}", fmt::join(table.names(), ", ")));
  record.time = table.column(time, hydro::dim::time);
  for (const std::string& name : table.names()) {
    if (name == time || table.is_text(name) || !table.has_known_unit(name)) continue;
    const std::string unit = table.unit_text(name);
    // Values are in SI; a header in other units is told in SI too.
    const bool is_si = unit.empty() || hydro::parse_unit(unit).factor == 1;
    record.signals.push_back({name, is_si ? unit : scene::si_unit(table.dimension(name)), name, table.column(name)});
  }
  return record;
}

/// What comes before is told before what comes after: cycles, extremes and spectra are of that order.
RunResult rising(RunResult record, const Path& path) {
  const auto& t = record.time;
  const auto back = std::adjacent_find(t.begin(), t.end(), [](double a, double b) { return !(a < b); });
  if (back != t.end())
    throw hydro::InputError(fmt::format("time does not rise from sample {} to the next: {:.9g} s, then {:.9g} s",
                                        back - t.begin() + 1, *back, *std::next(back)),
                            {.file = path.string()}, "sort the record by time, and keep one sample of each instant");
  return record;
}

}  // namespace

RunResult read_record(const Path& path) {
  const std::string ending = ending_of(path);
  if (ending == ".h5" || ending == ".nc") return read_run(path);
  if (is_table(ending)) return rising(read_csv(path), path);
  throw hydro::InputError(fmt::format("\"{}\" is no kind of file with time series that is known here", ending),
                          {.file = path.string()}, "give a .csv with a header, or the .h5 of `froude run`");
}

std::vector<std::string> cautions_of_samples(double missed, const std::string& consequence) {
  constexpr double told = 0.01;  // thirteen samples a wave
  if (missed <= told) return {};
  return {
      fmt::format("samples miss {:.2g} % of the crests' height on average{}: sample twenty times a wave, or put a "
                  "curve through the samples first, `froude prepare` with resample",
                  100 * missed, consequence)};
}

void drop_before(RunResult& record, double from, const Path& file) {
  const auto first =
      std::lower_bound(record.time.begin(), record.time.end(), from - 1e-9 * std::abs(from)) - record.time.begin();
  if (first == static_cast<std::ptrdiff_t>(record.time.size()))
    throw hydro::InputError(
        fmt::format("the record ends at {:.6g} s, before --from {:.6g} s", record.time.back(), from),
        {.file = file.string()}, "give a time within the record, or leave --from out");
  record.time.erase(record.time.begin(), record.time.begin() + first);
  for (Signal& s : record.signals) s.values.erase(s.values.begin(), s.values.begin() + first);
}

void drop_after(RunResult& record, double to, const Path& file) {
  const double slack = 1e-9 * std::abs(to);
  if (record.time.back() < to - slack)
    throw hydro::InputError(fmt::format("the record ends at {:.6g} s, before --to {:.6g} s", record.time.back(), to),
                            {.file = file.string()}, "give a time within the record, or leave --to out");
  const auto end = std::upper_bound(record.time.begin(), record.time.end(), to + slack) - record.time.begin();
  if (end == 0)
    throw hydro::InputError(
        fmt::format("no sample is left: the first is at {:.6g} s, after --to {:.6g} s", record.time.front(), to),
        {.file = file.string()}, "give a later end, or leave --to out");
  record.time.resize(static_cast<std::size_t>(end));
  for (Signal& s : record.signals) s.values.resize(static_cast<std::size_t>(end));
}

namespace {

[[noreturn]] void refuse_unknown(const std::string& name, const std::vector<std::string>& known, const Path& file) {
  // A column that is no signal says why: text, or a unit that is not known.
  if (const std::string ending = ending_of(file); is_table(ending))
    if (const auto table = hydro::io::CsvTable::read(file); table.has(name)) table.column(name);
  const std::string near = hydro::nearest(name, known);
  throw hydro::InputError(fmt::format("no signal is called \"{}\"", name), {.file = file.string()},
                          near.empty() ? fmt::format("signals are: {}", fmt::join(known, ", "))
                                       : fmt::format("did you mean \"{}\"?", near));
}

}  // namespace

std::vector<Signal> signals_like(const RunResult& record, const std::vector<std::string>& patterns, const Path& file) {
  std::vector<std::string> known;
  for (const Signal& s : record.signals) known.push_back(s.name);
  for (const std::string& pattern : patterns)
    if (std::none_of(known.begin(), known.end(), [&](const auto& name) { return scene::matches(pattern, name); }))
      refuse_unknown(pattern, known, file);
  std::vector<Signal> out;
  for (const Signal& s : record.signals)
    if (std::any_of(patterns.begin(), patterns.end(),
                    [&](const auto& pattern) { return scene::matches(pattern, s.name); }))
      out.push_back(s);
  return out;
}

const Signal& signal_of(const RunResult& record, const std::string& name, const Path& file) {
  std::vector<std::string> known;
  for (const Signal& s : record.signals) {
    if (s.name == name) return s;
    known.push_back(s.name);
  }
  refuse_unknown(name, known, file);
}

}  // namespace froude
