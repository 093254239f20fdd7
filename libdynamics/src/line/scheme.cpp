/// \file  The names of how lines are stepped.
#include <array>

#include "dynamics/line/stepper.hpp"
#include "hydro/base/error.hpp"

namespace dynamics::line {
namespace {

constexpr std::array<std::string_view, 6> scheme_names{"energy_momentum", "generalized_alpha",   "rosenbrock",
                                                       "gamma",           "semi_implicit_euler", "explicit_euler"};

}  // namespace

Scheme parse_scheme(std::string_view name) {
  for (std::size_t i = 0; i < scheme_names.size(); ++i)
    if (scheme_names[i] == name) return static_cast<Scheme>(i);
  const std::string near = hydro::nearest(name, scheme_names);
  throw hydro::InputError(fmt::format("there is no scheme \"{}\" for lines", name), {},
                          near.empty() ? "" : fmt::format("did you mean \"{}\"?", near));
}

std::string_view name_of(Scheme scheme) { return scheme_names[static_cast<std::size_t>(scheme)]; }

}  // namespace dynamics::line
