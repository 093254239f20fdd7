#include "compile/control.hpp"

#include <fmt/ranges.h>

#include <cmath>

#include "dynamics/control/controller.hpp"
#include "hydro/base/error.hpp"

namespace froude::compile {
namespace {

/// Takes the connectors whose names match out of two lists that run beside each other.
void take(const std::string& pattern, std::vector<dynamics::AxialConnector>& connectors,
          std::vector<std::string>& names, dynamics::SwitchedConnectors& group, std::vector<std::string>& group_names) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < connectors.size(); ++i) {
    const bool taken = scene::matches(pattern, names[i]);
    if (taken) {
      group.connectors.push_back(connectors[i]);
      group_names.push_back(names[i]);
    } else {
      connectors[kept] = connectors[i];
      names[kept++] = names[i];
    }
  }
  connectors.resize(kept);
  names.resize(kept);
}

hydro::InputError no_such(const std::string& pattern, const Prepared& p) {
  std::vector<std::string> names = p.axial_names;
  for (const auto& group : p.switched_names) names.insert(names.end(), group.begin(), group.end());
  return hydro::InputError(
      fmt::format("no axial connector \"{}\" is left for a controller", pattern), {},
      names.empty() ? "the scene has none" : fmt::format("connectors are: {}", fmt::join(names, ", ")));
}

void check(const std::string& pattern, const dynamics::SwitchedConnectors& group) {
  const auto& first = group.connectors.front().law;
  for (const auto& c : group.connectors) {
    if (!c.law.table_x.empty())
      throw hydro::InputError(fmt::format("\"{}\" has a table of tensions, not a stiffness to set", pattern), {},
                              "kind = \"axial\" with a stiffness");
    if (c.law.stiffness != first.stiffness)
      throw hydro::InputError(fmt::format("connectors \"{}\" begin with {:.6g} N/m and with {:.6g} N/m; one controller "
                                          "sets one stiffness",
                                          pattern, first.stiffness, c.law.stiffness),
                              {}, "a controller for each");
  }
}

dynamics::MakeController controller(std::shared_ptr<const std::vector<dynamics::RigidBody>> bodies,
                                    const Control& control) {
  return [bodies, control] {
    return std::make_unique<dynamics::FunctionController>([bodies, control](const dynamics::State& state) {
      const auto stiffness = control.decide(Sample(bodies, state));
      if (stiffness && !std::isfinite(*stiffness))
        throw hydro::InputError(fmt::format("the controller of \"{}\" asks for a stiffness of {} N/m at {:.6g} s",
                                            control.connectors, *stiffness, state.time),
                                {}, "return a number, or nothing to leave the stiffness as it is");
      return stiffness;
    });
  };
}

}  // namespace

int Sample::index(const std::string& body) const {
  std::vector<std::string> names;
  for (std::size_t b = 0; b < bodies_->size(); ++b) {
    if ((*bodies_)[b].name() == body) return static_cast<int>(b);
    names.push_back((*bodies_)[b].name());
  }
  throw hydro::InputError(fmt::format("the scene has no body \"{}\"", body), {},
                          fmt::format("bodies are: {}", fmt::join(names, ", ")));
}

double Sample::motion(const std::string& name) const {
  const auto dot = name.rfind('.');
  if (dot == std::string::npos)
    throw hydro::InputError(fmt::format("\"{}\" is no motion", name), {}, "motions are called like \"m1.heave\"");
  const auto b = static_cast<std::size_t>(index(name.substr(0, dot)));
  return motion_from_rest((*bodies_)[b], state_.pose[b], static_cast<int>(hydro::parse_mode(name.substr(dot + 1))));
}

dynamics::Vector6 Sample::velocity(const std::string& body) const { return state_.twist(index(body)); }

void set_controllers(const std::vector<Control>& controls, Prepared& p) {
  const auto bodies = std::make_shared<const std::vector<dynamics::RigidBody>>(p.bodies);
  std::vector<dynamics::SwitchedConnectors> ruled;
  std::vector<std::vector<std::string>> ruled_names;
  for (const Control& control : controls) {
    dynamics::SwitchedConnectors group{{}, controller(bodies, control)};
    std::vector<std::string> names;
    take(control.connectors, p.axial, p.axial_names, group, names);
    for (std::size_t g = 0; g < p.switched.size(); ++g)
      take(control.connectors, p.switched[g].connectors, p.switched_names[g], group, names);
    if (group.connectors.empty()) throw no_such(control.connectors, p);
    check(control.connectors, group);
    ruled.push_back(std::move(group));
    ruled_names.push_back(std::move(names));
  }
  for (std::size_t g = 0; g < p.switched.size(); ++g) {
    if (p.switched[g].connectors.empty()) continue;
    ruled.push_back(std::move(p.switched[g]));
    ruled_names.push_back(std::move(p.switched_names[g]));
  }
  p.switched = std::move(ruled);
  p.switched_names = std::move(ruled_names);
}

}  // namespace froude::compile
