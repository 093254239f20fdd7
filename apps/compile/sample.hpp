#pragma once
/// \file  Private to compile/: one instant of a run, as controllers of the caller's see it.
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "compile/signal_list.hpp"
#include "froude/control.hpp"
#include "hydro/base/error.hpp"

namespace froude::compile {

using SignalsByName = std::map<std::string, Signal>;

inline std::shared_ptr<const SignalsByName> by_name(const std::vector<Signal>& signals) {
  auto out = std::make_shared<SignalsByName>();
  for (const Signal& s : signals) out->emplace(s.name, s);
  return out;
}

/// \throws hydro::InputError at the place if there is none of this name, with the nearest
inline const Signal& named(const SignalsByName& signals, const scene::Located<std::string>& name) {
  if (const auto found = signals.find(name.value); found != signals.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [other, signal] : signals) known.push_back(other);
  throw scene::no_signal(name.value, name.place, known);
}

class SampleOfRun final : public Sample {
 public:
  SampleOfRun(const SignalsByName& signals, const Moment& now) : signals_(signals), now_(now) {}
  double time() const override { return now_.workspace.state.time; }
  double operator[](const std::string& signal) const override { return named(signals_, {signal, {}}).value(now_); }
  dynamics::Vector6 velocity(const std::string& body) const override {
    std::vector<std::string> names;
    for (const dynamics::RigidBody& b : now_.model.bodies()) names.push_back(b.name());
    const auto found = std::find(names.begin(), names.end(), body);
    if (found == names.end())
      throw hydro::InputError(fmt::format("the scene has no body \"{}\"", body), {},
                              fmt::format("bodies are: {}", fmt::join(names, ", ")));
    return now_.workspace.state.twist(static_cast<int>(found - names.begin()));
  }

 private:
  const SignalsByName& signals_;
  const Moment& now_;
};

}  // namespace froude::compile
