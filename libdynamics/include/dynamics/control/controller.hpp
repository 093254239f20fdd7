#pragma once
/// \file  Controllers: sampled at the ends of steps, they set what the elements they rule do until the next.
#include <functional>
#include <memory>
#include <optional>

#include "dynamics/state/body.hpp"

namespace dynamics {

/// What it rules is one number, such as a stiffness. It may keep what it has seen: one controller belongs to one run.
class Controller {
 public:
  virtual ~Controller() = default;
  /// Called once at the end of each full step, in order. \returns the new setting, or nothing to leave it
  virtual std::optional<double> sample(const State& state) = 0;
};

/// Makes the controller of a new run.
using MakeController = std::function<std::unique_ptr<Controller>()>;

/// A controller that is one function.
class FunctionController final : public Controller {
 public:
  explicit FunctionController(std::function<std::optional<double>(const State&)> decide) : decide_(std::move(decide)) {}
  std::optional<double> sample(const State& state) override { return decide_(state); }

 private:
  std::function<std::optional<double>(const State&)> decide_;
};

}  // namespace dynamics
