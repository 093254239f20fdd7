#include "sweep/cases.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <charconv>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "hydro/base/digest.hpp"
#include "hydro/base/random.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/waves/dispersion.hpp"
#include "hydro/waves/spectra/spectrum.hpp"
#include "scene/placed.hpp"
#include "scene/record.hpp"

namespace froude::sweep {
namespace {

using hydro::InputError;
using Form = scene::WrittenValue::Form;

constexpr const char* steepness = "steepness";
constexpr std::size_t most_cases = 10'000'000;  // far above what anybody runs: a slip of the pen

std::string unquoted(const std::string& toml) {
  const bool quoted = toml.size() >= 2 && (toml.front() == '"' || toml.front() == '\'');
  return quoted ? toml.substr(1, toml.size() - 2) : toml;
}

/// "4.5 s": the number and its unit; no number for a word.
AxisValue value_of(const std::string& toml) {
  AxisValue out{toml, {}, {}};
  const std::string text = unquoted(toml);
  std::string_view number = hydro::trimmed(text);
  if (number.starts_with('+')) number.remove_prefix(1);
  double value = 0;
  const auto [end, failed] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (failed != std::errc{} || !std::isfinite(value)) return out;
  const std::string unit(hydro::trimmed(number.substr(static_cast<std::size_t>(end - number.data()))));
  try {
    hydro::parse_unit(unit);
  } catch (const InputError&) {
    return out;  // "3legs.nc" is a word
  }
  out.number = value;
  out.unit = unit;
  return out;
}

/// The same in another unit. \throws hydro::InputError where that is of another dimension
double number_in(const std::string& unit, const AxisValue& value) {
  if (value.unit == unit) return *value.number;
  const hydro::Unit from = hydro::parse_unit(value.unit), to = hydro::parse_unit(unit);
  if (from.dimension != to.dimension)
    throw InputError(
        fmt::format("\"{} {}\" and the unit \"{}\" are of different dimensions", *value.number, value.unit, unit));
  return *value.number * from.factor / to.factor;
}

/// "4 s .. 12 s, 9 values", taken apart.
struct Range {
  AxisValue from, to;
  std::string rest;  ///< "9 values", "every 1 s"; empty of a sampled axis
};
Range range_of(const Axis& axis) {
  const std::string& text = axis.range.value;
  const std::size_t dots = text.find(".."), comma = text.find(',');
  const auto part = [&](std::size_t begin, std::size_t end) {
    return std::string(hydro::trimmed(std::string_view(text).substr(begin, end - begin)));
  };
  if (dots == std::string::npos || comma < dots)
    throw InputError(fmt::format("[[axis]] range = \"{}\" is no range", text), axis.range.place,
                     "write it like \"4 s .. 12 s, 9 values\"");
  const std::size_t end = std::min(comma, text.size());
  Range out{value_of(part(0, dots)), value_of(part(dots + 2, end)),
            comma == std::string::npos ? std::string() : part(comma + 1, text.size())};
  if (!out.from.number || !out.to.number)
    throw InputError(fmt::format("[[axis]] range = \"{}\" does not go from a number to a number", text),
                     axis.range.place, "write it like \"4 s .. 12 s, 9 values\"");
  out.to.number = scene::placed(axis.range.place, [&] { return number_in(out.from.unit, out.to); });
  if (axis.logarithmic && !(*out.from.number * *out.to.number > 0))
    throw InputError(fmt::format("[[axis]] range = \"{}\" has no equal ratios: it meets 0", text), axis.range.place,
                     "begin above 0, or leave spacing out");
  return out;
}

/// Twelve digits are what a person wants to read, and what the scene then holds.
double rounded(double x) { return std::strtod(fmt::format("{:.12g}", x).c_str(), nullptr); }

/// The value a share of the way from the first end to the last.
AxisValue between(const Range& range, bool logarithmic, double share) {
  const double from = *range.from.number, to = *range.to.number;
  const double value = logarithmic ? from * std::pow(to / from, share) : from + (to - from) * share;
  return {{}, rounded(value), range.from.unit};
}

/// How many values a range stands for.
std::size_t count_of(const Range& range, const Axis& axis) {
  const auto refuse = [&](const std::string& why) {
    throw InputError(fmt::format("[[axis]] range = \"{}\" {}", axis.range.value, why), axis.range.place,
                     "write it like \"4 s .. 12 s, 9 values\" or \"4 s .. 12 s, every 1 s\"");
  };
  const double span = *range.to.number - *range.from.number;
  if (range.rest.starts_with("every ")) {
    if (axis.logarithmic) refuse("has steps, and equal ratios");
    const AxisValue step = value_of(range.rest.substr(6));
    if (!step.number) refuse("has no step");
    const double steps = span / scene::placed(axis.range.place, [&] { return number_in(range.from.unit, step); });
    constexpr double rounding = 1e-9;  // of a step
    if (!(steps >= 0 && steps < most_cases) || std::abs(steps - std::round(steps)) > rounding * std::max(1.0, steps))
      refuse("is no whole number of steps");
    return static_cast<std::size_t>(std::round(steps)) + 1;
  }
  std::size_t count = 0;
  const auto [end, failed] = std::from_chars(range.rest.data(), range.rest.data() + range.rest.size(), count);
  if (failed != std::errc{} || hydro::trimmed(end) != "values" || count == 0 || count > most_cases ||
      (count == 1 && span != 0))
    refuse("does not say how many values");
  return count;
}

/// Points of the unit cube, (number, axes).
using Points = std::vector<std::vector<double>>;

/// In each of `number` equal parts of each axis lies one point (McKay, Beckman & Conover 1979).
Points latin_hypercube(const Sample& sample, std::size_t axes) {
  const auto number = static_cast<std::size_t>(sample.number);
  Points out(number, std::vector<double>(axes));
  for (std::size_t a = 0; a < axes; ++a) {
    const hydro::RandomStream random(static_cast<std::uint64_t>(sample.seed), a);
    std::vector<std::size_t> part(number);
    std::iota(part.begin(), part.end(), 0);
    for (std::size_t i = number; i > 1; --i)
      std::swap(part[i - 1], part[static_cast<std::size_t>(random.uniform(i) * static_cast<double>(i))]);
    for (std::size_t i = 0; i < number; ++i)
      out[i][a] = (static_cast<double>(part[i]) + random.uniform(number + 1 + i)) / static_cast<double>(number);
  }
  return out;
}

/// Sobol's sequence, whose bits are all inverted or not, as the seed says, which keeps how evenly it lies.
Points sobol(const Sample& sample, std::size_t axes) {
  boost::random::sobol sequence(axes);  // begins behind its first point, the origin
  Points out(static_cast<std::size_t>(sample.number), std::vector<double>(axes));
  for (std::size_t n = 0; n < out.size(); ++n)
    for (std::size_t a = 0; a < axes; ++a) {
      const hydro::RandomStream random(static_cast<std::uint64_t>(sample.seed), a);
      constexpr int bits = 53;
      const auto shift = static_cast<std::uint64_t>(std::ldexp(random.uniform(0), bits));
      const std::uint64_t drawn = n == 0 ? 0 : sequence() >> (64 - bits);
      out[n][a] = std::ldexp(static_cast<double>(drawn ^ shift), -bits);
    }
  return out;
}

/// Height over length. \throws hydro::InputError for waves that are not described by one height and one period
double steepness_of(const scene::Scene& scene) {
  const auto of = [&](double height, double period) {
    return height * hydro::waves::wavenumber(2 * std::numbers::pi / period, scene.water) / (2 * std::numbers::pi);
  };
  if (scene.waves) {
    if (const auto* regular = std::get_if<scene::RegularWave>(&scene.waves->kind))
      return of(2 * regular->amplitude, regular->period);
    const auto* sea = std::get_if<scene::RandomSea>(&scene.waves->kind);
    if (sea != nullptr && sea->systems.size() == 1)
      return of(sea->systems.front().spectrum->hs(), sea->systems.front().spectrum->tp());
  }
  throw InputError("the scene has no waves of one height and one period, so no steepness",
                   {.file = scene.file.string()}, "skip cases by the value of an axis");
}

/// \throws hydro::InputError where the limit is of another dimension
double limit_of(const Skip& skip, const std::string& toml, const std::string& unit) {
  const AxisValue limit = value_of(toml);
  if (!limit.number)
    throw InputError(fmt::format("[[skip]] compares with {}, which is no number", toml), skip.place, "give a number");
  return scene::placed(skip.place, [&] { return number_in(unit, limit); });
}

std::string digest_line(const std::filesystem::path& file) {
  return fmt::format("file {} {:016x}\n", file.filename().string(), hydro::digest(hydro::io::read_text(file)));
}
/// A word of an axis, and what is in the file if it is the name of one.
std::string word_line(const std::filesystem::path& scene, const std::string& toml) {
  const std::filesystem::path file = scene::beside(scene, unquoted(toml));
  std::error_code unknown;
  return fmt::format("value {}\n", toml) + (std::filesystem::is_regular_file(file, unknown) ? digest_line(file) : "");
}

}  // namespace

Cases::Cases(const Study& study, std::string scene_text, const std::vector<std::filesystem::path>& files)
    : study_(study), text_(std::move(scene_text)) {
  read_values();
  find_slots();
  group_axes();
  check_skips();
  check_pictures();
  definition_ = defined(files);
}

void Cases::read_values() {
  std::vector<std::size_t> sampled;
  for (const Axis& axis : study_.axes) {
    auto& values = values_.emplace_back();
    for (const std::string& toml : axis.values) values.push_back(value_of(toml));
    if (axis.values.empty()) {
      const Range range = range_of(axis);
      if (range.rest.empty()) {
        sampled.push_back(values_.size() - 1);
        continue;
      }
      const std::size_t count = count_of(range, axis);
      for (std::size_t i = 0; i < count; ++i)
        values.push_back(
            between(range, axis.logarithmic, count == 1 ? 0 : static_cast<double>(i) / static_cast<double>(count - 1)));
    }
  }
  draw_samples(sampled);
  for (std::size_t a = 0; a < values_.size(); ++a) {
    auto& values = values_[a];
    const bool numbers = std::all_of(values.begin(), values.end(), [](const AxisValue& v) { return v.number; });
    columns_.push_back({study_.axes[a].name, numbers ? values.front().unit : "", !numbers});
    if (!numbers) continue;
    for (AxisValue& v : values) {
      v.number = scene::placed(study_.axes[a].place, [&] { return number_in(values.front().unit, v); });
      v.unit = values.front().unit;
    }
  }
}

void Cases::draw_samples(const std::vector<std::size_t>& sampled) {
  if (sampled.empty() != !study_.sample)
    throw sampled.empty() ? InputError("[sample] draws values of no axis", study_.sample->place,
                                       "give an axis a range of its ends alone, \"4 s .. 12 s\", or leave it out")
                          : InputError(fmt::format("[[axis]] range = \"{}\" does not say how many values",
                                                   study_.axes[sampled.front()].range.value),
                                       study_.axes[sampled.front()].range.place,
                                       "add \", 9 values\" to it, or a table [sample] that draws them");
  if (sampled.empty()) return;
  if (study_.sample->number > static_cast<std::int64_t>(most_cases))
    throw InputError("[sample] number is too large", study_.sample->place, fmt::format("at most {}", most_cases));
  const Points points = study_.sample->method == Sample::Method::sobol
                            ? sobol(*study_.sample, sampled.size())
                            : latin_hypercube(*study_.sample, sampled.size());
  for (std::size_t k = 0; k < sampled.size(); ++k) {
    const Axis& axis = study_.axes[sampled[k]];
    if (axis.along)
      throw InputError(fmt::format("axis \"{}\" is drawn by [sample], so it goes along no other", axis.name),
                       axis.place, "leave `along` out");
    const Range range = range_of(axis);
    for (const auto& point : points) values_[sampled[k]].push_back(between(range, axis.logarithmic, point[k]));
  }
}

void Cases::group_axes() {
  std::optional<std::size_t> drawn;
  std::vector<std::size_t> group_of(values_.size());
  for (std::size_t a = 0; a < values_.size(); ++a) {
    const Axis& axis = study_.axes[a];
    if (axis.along) continue;
    const bool sampled = axis.values.empty() && range_of(axis).rest.empty();
    if (sampled && drawn) {
      groups_[group_of[a] = *drawn].axes.push_back(a);
      continue;
    }
    group_of[a] = groups_.size();
    if (sampled) drawn = groups_.size();
    groups_.push_back({{a}, values_[a].size()});
  }
  for (std::size_t a = 0; a < values_.size(); ++a) {
    const Axis& axis = study_.axes[a];
    if (!axis.along) continue;
    const auto leads = std::find_if(study_.axes.begin(), study_.axes.end(),
                                    [&](const Axis& other) { return other.name == axis.along->value; });
    Group& group = groups_[group_of[static_cast<std::size_t>(leads - study_.axes.begin())]];
    if (group.length != values_[a].size())
      throw InputError(fmt::format("axis \"{}\" has {} values, and \"{}\", along which it goes, {}", axis.name,
                                   values_[a].size(), axis.along->value, group.length),
                       axis.place, "give both as many");
    group.axes.push_back(a);
  }
  count_ = 1;
  for (const Group& group : groups_) {
    count_ *= group.length;
    if (count_ > most_cases)
      throw InputError(fmt::format("the study has more than {} cases", most_cases), study_.axes.back().place,
                       "take fewer values, or draw them with [sample]");
  }
}

void Cases::find_slots() {
  for (std::size_t a = 0; a < study_.axes.size(); ++a)
    for (const auto& key : study_.axes[a].keys) {
      slots_.push_back({a, scene::value_at(text_, study_.scene.value, key.value, key.place), key});
      for (const AxisValue& value : values_[a]) written(slots_.back(), value);  // each can be
    }
  std::sort(slots_.begin(), slots_.end(), [](const Slot& a, const Slot& b) { return a.at.begin < b.at.begin; });
  for (std::size_t i = 1; i < slots_.size(); ++i)
    if (slots_[i].at.begin < slots_[i - 1].at.end)
      throw InputError(fmt::format("\"{}\" and \"{}\" change the same value of the scene", slots_[i - 1].key.value,
                                   slots_[i].key.value),
                       slots_[i].key.place, "let one axis change it");
}

/// The value as the text of the scene holds it.
std::string Cases::written(const Slot& slot, const AxisValue& value) const {
  const auto refuse = [&](const std::string& why, const std::string& remedy) {
    throw InputError(fmt::format("\"{}\" {}", slot.key.value, why), slot.key.place, remedy);
  };
  const std::string quantity =
      value.number ? fmt::format("{}{}{}", *value.number, value.unit.empty() ? "" : " ", value.unit) : value.toml;
  if (slot.at.form == Form::component) {
    if (!value.number) refuse(fmt::format("is a component of a vector and cannot be {}", value.toml), "give numbers");
    return scene::placed(slot.key.place, [&] {
      return fmt::format("{}", value.unit.empty() ? *value.number : number_in(slot.at.unit, value));
    });
  }
  if (!value.toml.empty()) return value.toml;
  if (slot.at.form == Form::text) return '"' + quantity + '"';
  if (!value.unit.empty() || slot.at.form == Form::other)
    refuse(fmt::format("is not written as a quantity, so {} cannot stand there", quantity),
           "give its values in a list");
  if (slot.at.form == Form::integer && *value.number != std::round(*value.number))
    refuse(fmt::format("is an integer in the scene, and {} is none", quantity),
           "choose a range of whole numbers, or write a number with a point in the scene");
  return quantity;
}

std::vector<std::size_t> Cases::indices(std::size_t number) const {
  std::vector<std::size_t> out(values_.size());
  std::size_t rest = number - 1;
  for (auto group = groups_.rbegin(); group != groups_.rend(); ++group) {
    for (const std::size_t a : group->axes) out[a] = rest % group->length;
    rest /= group->length;
  }
  return out;
}

std::string Cases::scene(std::size_t number) const {
  const auto at = indices(number);
  std::string out;
  std::size_t copied = 0;
  for (const Slot& slot : slots_) {
    out.append(text_, copied, slot.at.begin - copied);
    out += written(slot, values_[slot.axis][at[slot.axis]]);
    copied = slot.at.end;
  }
  return out.append(text_, copied);
}

std::vector<Cell> Cases::cells(std::size_t number) const {
  const auto at = indices(number);
  std::vector<Cell> out;
  for (std::size_t a = 0; a < values_.size(); ++a) {
    const AxisValue& value = values_[a][at[a]];
    if (!columns_[a].is_text)
      out.emplace_back(*value.number + 0.0);  // no -0, as SQLite
    else
      out.emplace_back(unquoted(value.toml));
  }
  return out;
}

std::size_t Cases::column(const std::string& axis) const {
  const auto at = std::find_if(columns_.begin(), columns_.end(), [&](const Column& c) { return c.name == axis; });
  return static_cast<std::size_t>(at - columns_.begin());
}

/// What the limits of a skip are compared with; nothing where the scene of the case is refused, which its run will
/// tell.
std::optional<double> Cases::measure(const Skip& skip, std::size_t number) const {
  if (skip.of.value != steepness) return std::get<double>(cells(number)[column(skip.of.value)]);
  try {
    return steepness_of(scene::parse(scene(number), study_.scene.value));
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::string Cases::unit_of(const Skip& skip) const {
  return skip.of.value == steepness ? std::string() : columns_[column(skip.of.value)].unit;
}

void Cases::check_skips() const {
  for (const Skip& skip : study_.skips) {
    if (skip.of.value == steepness)
      scene::placed(skip.of.place, [&] { return steepness_of(scene::parse(text_, study_.scene.value)); });
    else if (columns_[column(skip.of.value)].is_text)
      throw InputError(fmt::format("the values of axis \"{}\" are no numbers", skip.of.value), skip.of.place,
                       "leave the values out of its list instead");
    for (const auto* limit : {&skip.above, &skip.below})
      if (*limit) limit_of(skip, **limit, unit_of(skip));
  }
}

void Cases::check_pictures() const {
  for (const Picture& picture : study_.pictures)
    for (const auto* axis : {&picture.x, picture.y ? &*picture.y : nullptr}) {
      if (axis == nullptr || is_over_time(study_, picture)) continue;
      const std::size_t at = column(axis->value);
      if (columns_[at].is_text)
        throw InputError(
            fmt::format("the values of axis \"{}\" are no numbers, so nothing can be drawn along it", axis->value),
            axis->place, "name it with `by`, for a curve each");
      std::set<std::optional<double>> different;
      for (const AxisValue& value : values_[at]) different.insert(value.number);
      if (picture.y && different.size() < 2)
        throw InputError(
            fmt::format("[[picture]] is a map, which needs two values and more on axis \"{}\"", axis->value),
            axis->place, "draw curves instead, with `by` in place of `y`");
    }
}

std::optional<std::string> Cases::skipped(std::size_t number) const {
  for (const Skip& skip : study_.skips) {
    const auto value = measure(skip, number);
    if (!value) continue;
    const std::string unit = unit_of(skip),
                      told = fmt::format("{} {:.4g}{}{}", skip.of.value, *value, unit.empty() ? "" : " ", unit);
    if (skip.above && *value > limit_of(skip, *skip.above, unit)) return told + " is above " + unquoted(*skip.above);
    if (skip.below && *value < limit_of(skip, *skip.below, unit)) return told + " is below " + unquoted(*skip.below);
  }
  return std::nullopt;
}

std::string Cases::defined(const std::vector<std::filesystem::path>& files) const {
  std::string out = fmt::format("froude {}\nscene {:016x}\n", FROUDE_VERSION, hydro::digest(text_));
  for (const auto& file : files) out += digest_line(file);
  for (std::size_t a = 0; a < values_.size(); ++a) {
    const Axis& axis = study_.axes[a];
    out += fmt::format("axis {}{}\n", axis.name, axis.along ? " along " + axis.along->value : "");
    for (const auto& key : axis.keys) out += fmt::format("key {}\n", key.value);
    for (const AxisValue& v : values_[a])
      out += v.number ? fmt::format("value {} {}\n", *v.number, v.unit) : word_line(study_.scene.value, v.toml);
  }
  for (const Skip& skip : study_.skips)
    out +=
        fmt::format("skip {} above {} below {}\n", skip.of.value, skip.above.value_or("-"), skip.below.value_or("-"));
  for (const Output& output : study_.outputs) {
    std::vector<std::string> of;
    for (const auto& name : output.of) of.push_back(name.value);
    out += fmt::format("output {} of {}: {}, from {} s, {}\n", name_of(output.kind), fmt::join(of, ", "),
                       fmt::join(output.statistics, ", "), output.from, output.count);
  }
  if (study_.series) out += "series\n";
  return out;
}

}  // namespace froude::sweep
