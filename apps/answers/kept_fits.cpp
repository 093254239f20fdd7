#include "froude/kept_fits.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "compile/fit_folder.hpp"
#include "hydro/base/error.hpp"

namespace froude {
namespace {

/// Empty where the environment does not have it.
std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

}  // namespace

void keep_fits_in(const std::optional<std::filesystem::path>& folder) {
  compile::set_fit_folder(folder ? std::optional(compile::FitFolder(*folder)) : std::nullopt);
}

std::optional<std::filesystem::path> users_folder_of_fits() {
  const std::string asked = variable("FROUDE_CACHE");
  if (!asked.empty() && asked != "on" && asked != "off")
    throw hydro::InputError(
        fmt::format("the environment has FROUDE_CACHE={}, which is neither \"on\" nor \"off\"", asked), {},
        "FROUDE_CACHE=off keeps no fits from one start of the program to the next");
  if (asked == "off") return std::nullopt;
  // The specification of base directories of freedesktop.org: paths that are not absolute count as none.
  const std::filesystem::path cache = variable("XDG_CACHE_HOME"), home = variable("HOME");
  if (cache.is_absolute()) return cache / "froude";
  if (home.is_absolute()) return home / ".cache" / "froude";
  return std::nullopt;
}

}  // namespace froude
