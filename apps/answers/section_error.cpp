#include "answers/section_error.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "compile/sections.hpp"
#include "hydro/base/error.hpp"

namespace froude {
namespace {

/// \throws hydro::InputError at the section of the load that misses what is asked by most
void require_section_accuracy(const scene::Scene& scene, const std::vector<std::string>& names,
                              const std::vector<const scene::Section*>& section, const std::vector<double>& of_signal) {
  if (scene.solve.accept_error) return;
  const double asked = scene.accuracy;
  std::size_t worst = names.size();
  for (std::size_t i = 0; i < names.size(); ++i)
    if (section[i] && of_signal[i] > std::max(asked, section[i]->accepted_error) &&
        (worst == names.size() || of_signal[i] > of_signal[worst]))
      worst = i;
  if (worst == names.size()) return;
  throw hydro::InputError(
      fmt::format("{} is off by an estimated {:.2g} of its peak by the size of panels, and {:.2g} is asked",
                  names[worst], of_signal[worst], std::max(asked, section[worst]->accepted_error)),
      section[worst]->place,
      fmt::format("take a smaller mesh_tolerance in [body.hydrodynamics] or a finer mesh, ask for shorter waves too "
                  "where all that are asked for are long, leave that signal out of `of`, or take the error by name: "
                  "accept_error = {:.1g} in [[body.section]]",
                  1.2 * of_signal[worst]));
}

}  // namespace

void add_error_of_sections(const scene::Scene& scene, const compile::Prepared& prepared,
                           const std::vector<std::string>& names, const RelativeChanges& changes,
                           ErrorEstimate& error) {
  std::vector<const scene::Section*> section;
  for (const std::string& name : names) section.push_back(compile::section_of_signal(scene, name));
  if (std::none_of(section.begin(), section.end(), [](const auto* s) { return s != nullptr; })) return;
  std::vector<double> of_signal(names.size(), 0.0);
  for (const compile::Prepared& other : compile::doubted(scene, prepared)) {
    const std::vector<double> change = changes(other);
    for (std::size_t i = 0; i < names.size(); ++i)
      if (section[i]) of_signal[i] += change[i];
  }
  if (!error.missing.empty())
    error.unseen.push_back("the spacing of the coefficients' frequencies: " + std::exchange(error.missing, ""));
  require_section_accuracy(scene, names, section, of_signal);
  error.sources.push_back({.name = "panels",
                           .how = "sectional loads from coefficients that are as far off as their meshes differ",
                           .of_signal = std::move(of_signal),
                           .given = true});
}

}  // namespace froude
