#pragma once
/// \file  Scenes in a program: read, changed and answered.
///
///   const froude::Scene scene = froude::read("pontoon.toml");
///   const froude::Run run = scene.run();
///   run.write("pontoon.run.h5");
///
/// Errors are hydro::InputError, which says file, line, column, rule and remedy, and hydro::NumericsError.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "fit/report.hpp"
#include "froude/control.hpp"
#include "froude/cost.hpp"
#include "froude/joint_control.hpp"
#include "froude/result.hpp"

namespace froude {

namespace scene {
struct Scene;
}

/// A number that a scene writes: "body.m2.mass", "waves.height", "load.at.x". Of several tables with one heading the
/// number counts from 1, "line[1].damping.linear", or a name stands in its place.
struct Parameter {
  std::string path;
  double value;      ///< as written
  std::string unit;  ///< as written; empty for a number without one
};

/// A value to stand in a scene: a number is in the unit that the scene writes there, a text is the whole value, "30
/// cm".
using SceneValue = std::variant<bool, std::int64_t, double, std::string>;
/// Values by their paths, which are those of Parameter.
using SceneValues = std::vector<std::pair<std::string, SceneValue>>;

/// A scene of motion, or one that fits: checked, nothing computed. Copies share what they were read from, and with()
/// shares the coefficients that were read and the poles that were fitted to them, as long as the change leaves them
/// alone. Of one scene and its copies one thread at a time may ask.
class Scene {
 public:
  /// A number that may be changed. \throws hydro::InputError if the scene writes no number there, with the nearest key
  Parameter parameter(const std::string& path) const;
  /// The same scene with another number there, in the unit of the parameter. \throws hydro::InputError where the number
  /// breaks a rule of the grammar
  Scene with(const Parameter& parameter, double value) const;
  /// The same scene, of either kind, with other values. A key that its table does not write is written there.
  /// \throws hydro::InputError where the grammar knows no such key or refuses the value
  Scene with(const SceneValues& values) const;

  /// [ask] run. `progress` is told the share of the steps that are done; `controls` rule connectors, `of_joints`
  /// sliders and hinges. Numerics that give up end the run early: Run::stopped. \throws hydro::InputError
  Run run(const std::function<void(double)>& progress = {}, const std::vector<Control>& controls = {},
          const std::vector<JointControl>& of_joints = {}) const;
  /// [ask] rao. \throws hydro::InputError, hydro::NumericsError
  Responses rao() const;
  /// [ask] field: the free surface about the bodies in one wave. \throws hydro::InputError, hydro::NumericsError
  FreeSurface field() const;
  /// [ask] modes. \throws hydro::InputError, hydro::NumericsError
  Modes modes() const;
  /// [ask] waves: the water at the probes. \throws hydro::InputError
  WaterSeries waves(const std::function<void(double)>& progress = {}) const;
  /// What the measurements say, of a scene with a [model]; where values may not be told, Report::refused says why.
  /// \throws hydro::InputError, hydro::NumericsError
  ::fit::Report fit() const;
  /// What each answer will take, and what the scene leaves out. \throws hydro::InputError
  Plan plan() const;

  /// Error and time of every setting of the scene's approximations. `progress` is told the share that is done.
  /// \throws hydro::InputError, also for a scene whose numbers were changed by with(): settings are written into its
  /// text; hydro::NumericsError
  Cost cost(const CostOptions& options = {}, const std::function<void(double)>& progress = {}) const;

  /// What was read, for programs that look inside. \throws hydro::InputError for a scene that fits
  const scene::Scene& read() const;

 private:
  struct Shared;
  friend Scene parse(std::string_view text, const std::filesystem::path& file);
  explicit Scene(std::shared_ptr<const Shared> shared) : shared_(std::move(shared)) {}
  std::shared_ptr<const Shared> shared_;
};

/// Reads a scene. \throws hydro::InputError with file, line, column, rule and remedy
Scene read(const std::filesystem::path& file);
/// The same of a text; files that it names are looked for beside `file`.
Scene parse(std::string_view text, const std::filesystem::path& file = "scene.toml");

}  // namespace froude
