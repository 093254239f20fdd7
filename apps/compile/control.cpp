#include "compile/control.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "dynamics/control/controller.hpp"
#include "hydro/base/error.hpp"

namespace froude {

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
  return dynamics::motion_from_rest((*bodies_)[b], state_.pose[b],
                                    static_cast<int>(hydro::parse_mode(name.substr(dot + 1))));
}

dynamics::Vector6 Sample::velocity(const std::string& body) const { return state_.twist(index(body)); }

namespace compile {
namespace {

/// Takes the connectors whose names match out of a list.
void take(const std::string& pattern, std::vector<dynamics::AxialConnector>& connectors,
          dynamics::SwitchedConnectors& group) {
  const auto left = std::stable_partition(connectors.begin(), connectors.end(),
                                          [&](const auto& c) { return !scene::matches(pattern, c.name); });
  group.connectors.insert(group.connectors.end(), left, connectors.end());
  connectors.erase(left, connectors.end());
}

hydro::InputError no_such(const std::string& pattern, const Prepared& p) {
  std::vector<std::string> names;
  for (const auto& c : p.axial) names.push_back(c.name);
  for (const auto& group : p.switched)
    for (const auto& c : group.connectors) names.push_back(c.name);
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

void set_controllers(const std::vector<Control>& controls, Prepared& p) {
  const auto bodies = std::make_shared<const std::vector<dynamics::RigidBody>>(p.bodies);
  std::vector<dynamics::SwitchedConnectors> ruled;
  for (const Control& control : controls) {
    dynamics::SwitchedConnectors group{{}, controller(bodies, control)};
    take(control.connectors, p.axial, group);
    for (auto& other : p.switched) take(control.connectors, other.connectors, group);
    if (group.connectors.empty()) throw no_such(control.connectors, p);
    check(control.connectors, group);
    ruled.push_back(std::move(group));
  }
  for (auto& group : p.switched)
    if (!group.connectors.empty()) ruled.push_back(std::move(group));
  p.switched = std::move(ruled);
}

}  // namespace compile
}  // namespace froude
