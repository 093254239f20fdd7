#include "compile/control.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "compile/sample.hpp"
#include "dynamics/control/dominant_period.hpp"
#include "hydro/base/error.hpp"

namespace froude::compile {
namespace {

/// Takes the connectors whose names match out of a list.
void take(const std::string& pattern, std::vector<dynamics::AxialConnector>& connectors,
          dynamics::SwitchedConnectors& group) {
  const auto left = std::stable_partition(connectors.begin(), connectors.end(),
                                          [&](const auto& c) { return !scene::matches(pattern, c.name); });
  group.insert(group.end(), left, connectors.end());
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
  const auto& first = group.front().law;
  for (const auto& c : group) {
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

}  // namespace

void set_controllers(const std::vector<Control>& controls, Prepared& p) {
  std::vector<RuledConnectors> ruled;
  for (const Control& control : controls) {
    RuledConnectors group{{}, control, {}};
    take(control.connectors, p.axial, group.connectors);
    for (auto& other : p.switched) take(control.connectors, other.connectors, group.connectors);
    if (group.connectors.empty()) throw no_such(control.connectors, p);
    check(control.connectors, group.connectors);
    ruled.push_back(std::move(group));
  }
  for (auto& group : p.switched)
    if (!group.connectors.empty()) ruled.push_back(std::move(group));
  p.switched = std::move(ruled);
}

/// What sets the stiffness of one group.
class Controllers::Ruler {
 public:
  virtual ~Ruler() = default;
  virtual std::optional<double> decide(const Moment& now) = 0;
  virtual bool can_be_kept() const { return false; }
  virtual void keep_state(hydro::StateBytes&) {}
};

namespace {

class RuledByPeriod final : public Controllers::Ruler {
 public:
  RuledByPeriod(const scene::StiffnessSwitch& rule, const SignalsByName& signals)
      : watched_(named(signals, rule.watch)), controller_(rule) {}
  std::optional<double> decide(const Moment& now) override {
    return controller_.sample(now.workspace.state.time, watched_.value(now));
  }
  bool can_be_kept() const override { return true; }
  void keep_state(hydro::StateBytes& bytes) override { controller_.keep_state(bytes); }

 private:
  Signal watched_;
  dynamics::DominantPeriodController controller_;
};

class RuledByCaller final : public Controllers::Ruler {
 public:
  RuledByCaller(const Control& control, std::shared_ptr<const SignalsByName> signals)
      : control_(control), signals_(std::move(signals)) {}
  std::optional<double> decide(const Moment& now) override {
    const auto stiffness = control_.decide(SampleOfRun(*signals_, now));
    if (stiffness && !std::isfinite(*stiffness))
      throw hydro::NumericsError(
          fmt::format("the controller of \"{}\" asks for a stiffness of {} N/m at t = {:.6g} s; it must return a "
                      "number, or nothing to leave the stiffness as it is",
                      control_.connectors, *stiffness, now.workspace.state.time));
    return stiffness;
  }

 private:
  Control control_;
  std::shared_ptr<const SignalsByName> signals_;
};

std::unique_ptr<Controllers::Ruler> ruled_by(const scene::StiffnessSwitch& rule,
                                             const std::shared_ptr<const SignalsByName>& signals) {
  return std::make_unique<RuledByPeriod>(rule, *signals);
}
std::unique_ptr<Controllers::Ruler> ruled_by(const Control& control,
                                             const std::shared_ptr<const SignalsByName>& signals) {
  return std::make_unique<RuledByCaller>(control, signals);
}

}  // namespace

Controllers::~Controllers() = default;
Controllers::Controllers(Controllers&&) noexcept = default;

Controllers::Controllers(const std::vector<Rule>& rules, const std::vector<Signal>& signals) {
  if (rules.empty()) return;
  const auto all = by_name(signals);
  for (const Rule& rule : rules)
    rules_.push_back(std::visit([&](const auto& one) { return ruled_by(one, all); }, rule));
}

bool Controllers::can_be_kept() const {
  return std::all_of(rules_.begin(), rules_.end(), [](const auto& rule) { return rule->can_be_kept(); });
}

void Controllers::keep_state(hydro::StateBytes& bytes) {
  for (const auto& rule : rules_) rule->keep_state(bytes);
}

bool Controllers::decide(const Moment& now) {
  bool changed = false;
  for (std::size_t group = 0; group < rules_.size(); ++group)
    if (const auto stiffness = rules_[group]->decide(now))
      changed |= now.workspace.find_memory<dynamics::SwitchMemory>()->set(group, *stiffness, now.workspace.state);
  return changed;
}

}  // namespace froude::compile
