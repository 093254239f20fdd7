#include "hydro/base/units.hpp"

#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

#include "hydro/base/error.hpp"
#include "hydro/base/measurable.hpp"

namespace hydro {
namespace {

struct Symbol {
  std::string_view name;
  double factor;
  Dimension dimension;
  bool takes_prefix;
};

using std::numbers::pi;
// Knot, nautical mile, bar and the conventional standard gravity are exact by definition (BIPM, SI Brochure, 9th ed.,
// table 8 and notes).
constexpr double standard_gravity = 9.80665;
// The pound is exact by the agreement of 1959 (NIST Special Publication 811, 2008, appendix B.8), and so are the pound
// of force, the slug, the pound per square inch and the long ton of 2240 pounds that follow from it.
constexpr double foot = 0.3048, inch = 0.0254, pound = 0.45359237, pound_force = pound * standard_gravity;
constexpr Symbol symbols[] = {
    {"m", 1, dim::length, true},
    {"g", 1e-3, dim::mass, true},
    {"s", 1, dim::time, true},
    {"rad", 1, dim::angle, true},
    {"V", 1, dim::voltage, true},
    {"N", 1, dim::force, true},
    {"Pa", 1, dim::pressure, true},
    {"J", 1, dim::moment, true},
    {"W", 1, dim::moment / dim::time, true},
    {"Hz", 2 * pi, dim::angular_velocity, true},
    {"t", 1e3, dim::mass, true},
    {"L", 1e-3, dim::volume, true},
    {"bar", 1e5, dim::pressure, true},
    {"deg", pi / 180, dim::angle, false},
    {"°", pi / 180, dim::angle, false},
    {"rev", 2 * pi, dim::angle, false},
    {"rpm", 2 * pi / 60, dim::angular_velocity, false},
    {"min", 60, dim::time, false},
    {"h", 3600, dim::time, false},
    {"kn", 1852.0 / 3600, dim::velocity, false},
    {"kt", 1852.0 / 3600, dim::velocity, false},
    {"knot", 1852.0 / 3600, dim::velocity, false},
    {"knots", 1852.0 / 3600, dim::velocity, false},
    {"nmi", 1852, dim::length, false},
    {"ft", foot, dim::length, false},
    {"in", inch, dim::length, false},
    {"lb", pound, dim::mass, false},
    {"slug", pound_force / foot, dim::mass, false},
    {"LT", 2240 * pound, dim::mass, false},
    {"lbf", pound_force, dim::force, false},
    {"kip", 1e3 * pound_force, dim::force, false},
    {"psi", pound_force / (inch * inch), dim::pressure, false},
    {"gn", standard_gravity, dim::acceleration, false},  // "g" is the gram
    {"kgf", standard_gravity, dim::force, false},
    {"tf", 1e3 * standard_gravity, dim::force, false},
    {"tonne", 1e3, dim::mass, false},
    {"St", 1e-4, dim::kinematic_viscosity, true},
    {"%", 1e-2, dim::none, false},
    {"1", 1, dim::none, false},
    {"-", 1, dim::none, false},
};

struct Prefix {
  std::string_view name;
  double factor;
};
constexpr Prefix prefixes[] = {{"G", 1e9},  {"M", 1e6},  {"k", 1e3},  {"c", 1e-2},
                               {"d", 1e-1}, {"m", 1e-3}, {"µ", 1e-6}, {"u", 1e-6}};

std::optional<Unit> find_symbol(std::string_view text) {
  for (const Symbol& s : symbols)
    if (text == s.name) return Unit{s.factor, s.dimension};
  for (const Prefix& p : prefixes)
    if (text.size() > p.name.size() && text.starts_with(p.name))
      for (const Symbol& s : symbols)
        if (s.takes_prefix && text.substr(p.name.size()) == s.name) return Unit{p.factor * s.factor, s.dimension};
  return std::nullopt;
}

Unit power(const Unit& unit, int exponent) {
  const auto& d = unit.dimension;
  return {std::pow(unit.factor, exponent),
          {d.length * exponent, d.mass * exponent, d.time * exponent, d.angle * exponent, d.voltage * exponent}};
}

/// "m^2", "m2" or "m²": symbol and exponent.
Unit parse_factor(std::string_view text) {
  const auto fail = [&](std::string_view why) {
    std::vector<std::string> known;
    for (const Symbol& s : symbols) known.emplace_back(s.name);
    const std::string near = nearest(text, known);
    throw InputError(fmt::format("\"{}\" is not a unit: {}", text, why), {},
                     near.empty()
                         ? "known are SI units with prefixes, deg, Hz, rpm, t, bar, knot, min, h, ft, lb, lbf, kgf"
                         : fmt::format("did you mean \"{}\"?", near));
  };
  if (text.empty()) fail("a symbol is missing");
  if (const auto unit = find_symbol(text)) return *unit;
  int exponent = 1;
  std::string_view symbol = text;
  if (const auto caret = text.find('^'); caret != std::string_view::npos) {
    symbol = text.substr(0, caret);
    const std::string_view digits = text.substr(caret + 1);
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (code != std::errc{} || end != digits.data() + digits.size()) fail("the exponent is not an integer");
  } else if (text.ends_with("²")) {
    symbol = text.substr(0, text.size() - std::string_view("²").size());
    exponent = 2;
  } else if (text.ends_with("³")) {
    symbol = text.substr(0, text.size() - std::string_view("³").size());
    exponent = 3;
  } else if (text.back() >= '2' && text.back() <= '9') {
    symbol = text.substr(0, text.size() - 1);
    exponent = text.back() - '0';
  }
  const auto unit = find_symbol(symbol);
  if (!unit) fail("unknown symbol");
  return power(*unit, exponent);
}

/// Reads the number at the front of `text` and leaves what follows in `rest`.
double leading_number(std::string_view text, std::string_view& rest) {
  std::string_view body = trimmed(text);
  if (body.starts_with('+')) body.remove_prefix(1);
  double value = 0;
  const auto [end, code] = std::from_chars(body.data(), body.data() + body.size(), value);
  if (code != std::errc{})
    throw InputError(fmt::format("\"{}\" does not begin with a number", text), {}, "write a number and its unit");
  if (!std::isfinite(value)) throw InputError(fmt::format("\"{}\" is not a finite number", text));
  rest = body.substr(static_cast<std::size_t>(end - body.data()));
  return value;
}

struct Named {
  Dimension dimension;
  const char* name;
  const char* example;
};
const Named known_dimensions[] = {
    {dim::none, "a number", "0.7"},
    {dim::length, "a length", "1.6 m"},
    {dim::area, "an area", "2 m^2"},
    {dim::volume, "a volume", "28 m^3"},
    {dim::mass, "a mass", "1.2 t"},
    {dim::time, "a time", "0.02 s"},
    {dim::angle, "an angle", "22.5 deg"},
    {dim::voltage, "a voltage", "5 V"},
    {dim::velocity, "a velocity", "1.5 m/s"},
    {dim::acceleration, "an acceleration", "9.81 m/s^2"},
    {dim::angular_velocity, "a frequency", "0.8 rad/s"},
    {dim::force, "a force", "12 kN"},
    {dim::moment, "a moment", "3.7 N m"},
    {dim::pressure, "a pressure", "2 bar"},
    {dim::density, "a density", "1025 kg/m^3"},
    {dim::inertia, "a moment of inertia", "3.07 kg m^2"},
    {dim::stiffness, "a stiffness", "29.3 kN/m"},
    {dim::rotational_stiffness, "a rotational stiffness", "15.8 kN m/rad"},
    {dim::damping, "a damping", "60 kN s/m"},
    {dim::rotational_damping, "a rotational damping", "0.376 N m s/rad"},
    {dim::force / dim::angle, "a stiffness between translation and rotation", "1.2 kN/rad"},
    {dim::force / dim::angular_velocity, "a damping between translation and rotation", "0.3 kN s/rad"},
    {dim::kinematic_viscosity, "a kinematic viscosity", "1.05e-6 m^2/s"},
};

}  // namespace

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::string Dimension::si() const {
  std::string above, below;
  const auto add = [&](const char* symbol, int exponent) {
    if (exponent == 0) return;
    std::string& side = exponent > 0 ? above : below;
    side += exponent > 0 ? (above.empty() ? "" : " ") : "/";
    side += symbol;
    if (std::abs(exponent) > 1) side += fmt::format("^{}", std::abs(exponent));
  };
  add("kg", mass);
  add("m", length);
  add("s", time);
  add("rad", angle);
  add("V", voltage);
  return (above.empty() && !below.empty() ? "1" : above) + below;
}

std::string Dimension::name() const {
  for (const Named& n : known_dimensions)
    if (n.dimension == *this) return n.name;
  return "a quantity in " + si();
}

std::string Dimension::example() const {
  for (const Named& n : known_dimensions)
    if (n.dimension == *this) return n.example;
  return "1 " + si();
}

Unit parse_unit(std::string_view text) {
  Unit unit;
  bool divide = false;
  std::string_view rest = trimmed(text);
  while (!rest.empty()) {
    const auto end = rest.find_first_of(" */");
    const auto dot = rest.find("·");
    const auto stop = std::min(end, dot);
    const Unit factor = power(parse_factor(rest.substr(0, stop)), divide ? -1 : 1);
    unit = {unit.factor * factor.factor, unit.dimension * factor.dimension};
    if (stop == std::string_view::npos) return unit;
    divide = false;
    const std::size_t width = stop == dot && dot < end ? std::string_view("·").size() : 1;
    divide = rest[stop] == '/';
    rest = rest.substr(stop + width);
    // Blanks around an operator belong to it: "kN / m".
    while (!rest.empty() && (rest.front() == ' ' || (rest.front() == '/' && !divide))) {
      divide = divide || rest.front() == '/';
      rest.remove_prefix(1);
    }
    if (rest.empty()) throw InputError(fmt::format("the unit \"{}\" ends with an operator", text));
  }
  return unit;
}

namespace {
/// `si`, if it is a size that is computed with. \throws InputError naming the text it comes from
double measurable(std::string_view text, double si) {
  if (!is_measurable(si))
    throw InputError(
        fmt::format("\"{}\" is beyond what is computed with: sizes lie between 1e-30 and 1e30 in SI", text), {},
        "look at the exponent and at the unit");
  return si;
}
}  // namespace

Quantity parse_quantity(std::string_view text) {
  std::string_view rest;
  const double value = leading_number(text, rest);
  const Unit unit = parse_unit(rest);
  return {measurable(text, value * unit.factor), unit.dimension};
}

bool compatible(const Dimension& given, const Dimension& needed) {
  if (given == needed) return true;
  if (given.mass == 0 || needed.mass == 0) return false;
  Dimension a = given, b = needed;
  a.angle = b.angle = 0;
  return a == b;
}

namespace {
void check_dimension(std::string_view text, const Dimension& given, const Dimension& needed) {
  if (compatible(given, needed)) return;
  const std::string found = given == dim::none && needed != dim::none ? fmt::format("\"{}\" has no unit", text)
                                                                      : fmt::format("\"{}\" is {}", text, given.name());
  throw InputError(fmt::format("{}; {} is needed", found, needed.name()), {},
                   fmt::format("write it like \"{}\"{}", needed.example(),
                               needed == dim::angular_velocity ? " or \"0.13 Hz\"" : ""));
}
}  // namespace

double parse_si(std::string_view text, const Dimension& needed) {
  const Quantity q = parse_quantity(text);
  check_dimension(text, q.dimension, needed);
  return q.si;
}

std::vector<Eigen::Vector3d> parse_vectors(std::string_view text, const Dimension& needed) {
  const std::string_view body = trimmed(text);
  const auto close = body.find(')');
  if (!body.starts_with('(') || close == std::string_view::npos)
    throw InputError(fmt::format("\"{}\" is not a vector", text), {}, "write it like \"(0, 0, 1.31) m\"");
  const Unit unit = parse_unit(body.substr(close + 1));
  check_dimension(text, unit.dimension, needed);
  std::vector<Eigen::Vector3d> out(1, Eigen::Vector3d::Zero());
  std::string_view inner = body.substr(1, close - 1);
  for (int component = 0; component < 3; ++component) {
    const auto comma = inner.find(',');
    if ((comma == std::string_view::npos) != (component == 2))
      throw InputError(fmt::format("\"{}\" has not three components", text), {}, "write it like \"(0, 0, 1.31) m\"");
    std::string_view item = trimmed(inner.substr(0, comma));
    inner = comma == std::string_view::npos ? std::string_view{} : inner.substr(comma + 1);
    const bool both_signs = item.starts_with("±");
    if (both_signs) item.remove_prefix(std::string_view("±").size());
    const double value = measurable(text, parse_number(item) * unit.factor);
    for (auto& v : out) v[component] = value;
    if (both_signs) {
      const auto positive = out;
      for (auto v : positive) {
        v[component] = -value;
        out.push_back(v);
      }
    }
  }
  return out;
}

Eigen::Vector3d parse_vector(std::string_view text, const Dimension& needed) {
  const auto all = parse_vectors(text, needed);
  if (all.size() != 1) throw InputError(fmt::format("\"{}\" stands for several vectors; one is needed here", text));
  return all.front();
}

std::vector<double> parse_range(std::string_view text, const Dimension& needed) {
  const auto dots = text.find(".."), comma = text.rfind(',');
  const auto fail = [&] {
    throw InputError(fmt::format("\"{}\" is not a range of values", text), {},
                     "write it like \"2 s .. 8 s, 61 values\"");
  };
  if (dots == std::string_view::npos || comma == std::string_view::npos || comma < dots) fail();
  const double from = parse_si(trimmed(text.substr(0, dots)), needed);
  const double to = parse_si(trimmed(text.substr(dots + 2, comma - dots - 2)), needed);
  std::string_view count_text = trimmed(text.substr(comma + 1));
  int count = 0;
  const auto [end, code] = std::from_chars(count_text.data(), count_text.data() + count_text.size(), count);
  const std::string_view word = trimmed(count_text.substr(static_cast<std::size_t>(end - count_text.data())));
  if (code != std::errc{} || (word != "values" && word != "value")) fail();
  require(count >= 1, "\"{}\" asks for {} values; at least one is needed", text, count);
  require(count <= 1'000'000, "\"{}\" asks for {} values; at most a million are possible", text, count);
  require(count == 1 || to > from, "\"{}\" does not increase", text);
  std::vector<double> out(static_cast<std::size_t>(count), from);
  for (int i = 1; i < count; ++i) out[static_cast<std::size_t>(i)] = from + (to - from) * i / (count - 1);
  return out;
}

double parse_number(std::string_view text) {
  std::string_view rest;
  const double value = leading_number(text, rest);
  if (!trimmed(rest).empty()) throw InputError(fmt::format("\"{}\" is not a number", text));
  return value;
}

}  // namespace hydro
