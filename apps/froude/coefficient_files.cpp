#include "froude/coefficient_files.hpp"

#include <algorithm>

#include "hydro/base/error.hpp"
#include "hydro/potential/formats/writers.hpp"

namespace froude {
namespace {

std::string wamit_stem(const Path& output) {
  std::string stem = output.string();
  if (stem.ends_with(".1")) stem.resize(stem.size() - 2);
  return stem;
}

}  // namespace

CoefficientFormat format_of(const Path& output, const std::string& format) {
  const std::vector<std::string> known{"froude", "bemio", "wamit", "capytaine"};
  if (!format.empty()) {
    const auto at = std::find(known.begin(), known.end(), format);
    if (at == known.end())
      throw hydro::InputError(fmt::format("there is no format \"{}\"", format), {},
                              fmt::format("the formats are {}", fmt::join(known, ", ")));
    return static_cast<CoefficientFormat>(at - known.begin());
  }
  const std::string name = output.filename().string();
  if (name.ends_with(".bemio.h5")) return CoefficientFormat::bemio;
  if (name.ends_with(".h5")) return CoefficientFormat::froude;
  if (name.ends_with(".nc")) return CoefficientFormat::capytaine;
  if (name.ends_with(".1")) return CoefficientFormat::wamit;
  throw hydro::InputError(
      fmt::format("the name \"{}\" does not tell a format", name), {},
      "end it with .h5 (Froude), .bemio.h5 (BEMIO), .nc (Capytaine) or .1 (WAMIT set), or state --format");
}

std::vector<NamedFile> files_to_write(CoefficientFormat format, const Path& output, const std::string& use) {
  if (format != CoefficientFormat::wamit) return {{use, output}};
  std::vector<NamedFile> out;
  for (const char* ending : {".1", ".3", ".hst"}) out.push_back({use, wamit_stem(output) + ending});
  return out;
}

WrittenCoefficients write_as(CoefficientFormat format, const hydro::potential::Coefficients& c, const Path& output) {
  if (format == CoefficientFormat::froude) return {{output.string()}, hydro::potential::write_froude(c, output)};
  if (format == CoefficientFormat::bemio) return {{output.string()}, hydro::potential::write_bemio(c, output)};
  if (format == CoefficientFormat::capytaine) return {{output.string()}, hydro::potential::write_capytaine(c, output)};
  const std::string stem = wamit_stem(output);
  WrittenCoefficients w{{stem + ".1"}, hydro::potential::write_wamit(c, stem)};
  if (!c.X.empty()) w.files.push_back(stem + ".3");
  if (c.C) w.files.push_back(stem + ".hst");
  return w;
}

}  // namespace froude
