#include "froude/density_unit.hpp"

#include <algorithm>
#include <cctype>

#include "hydro/base/units.hpp"

namespace froude {
namespace {

/// A unit that hydro::parse_unit reads: "1/m/s" is written "m^-1 s^-1".
std::string unit_of(const hydro::Dimension& dimension) {
  const std::string si = dimension.si();
  if (!si.starts_with("1/")) return si;
  std::string out;
  for (std::size_t at = 1; at < si.size();) {
    const auto end = std::min(si.find('/', at + 1), si.size());
    const std::string factor = si.substr(at + 1, end - at - 1);
    const auto caret = factor.find('^');
    out += (out.empty() ? "" : " ") + factor.substr(0, caret) + "^-" +
           (caret == std::string::npos ? "1" : factor.substr(caret + 1));
    at = end;
  }
  return out;
}

bool is_one_symbol(const std::string& unit) {
  return !unit.empty() && std::all_of(unit.begin(), unit.end(), [](unsigned char c) { return std::isalpha(c) != 0; });
}

}  // namespace

std::string density_unit(const std::string& unit) {
  if (unit.empty()) return "Hz^-1";
  if (is_one_symbol(unit)) return unit + "^2/Hz";
  const auto dimension = hydro::parse_unit(unit).dimension;
  return unit_of(dimension * dimension) + "/Hz";
}

std::string gain_unit(const std::string& output, const std::string& input) {
  if (output == input) return "";
  if (is_one_symbol(output) && is_one_symbol(input)) return output + "/" + input;
  return unit_of(hydro::parse_unit(output).dimension / hydro::parse_unit(input).dimension);
}

}  // namespace froude
