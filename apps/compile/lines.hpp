#pragma once
/// \file  The lines of a scene, ready to be stepped, and the signals that they give.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/line/stepper.hpp"
#include "scene/scene.hpp"

namespace froude::compile {

struct RunWater;
struct PlanLine;

/// One line where a run begins.
struct LineModel {
  std::string name;
  std::unique_ptr<const dynamics::line::Line> line;
  dynamics::line::State start;  ///< at rest without waves, with the node that is to be released still in its place
  dynamics::line::Stepper::Settings settings;
  /// Of the links, where a run goes on from another one's end: angles follow these without jumps.
  std::vector<dynamics::line::LinkAngles> before = {};
};

/// In the order of the scene. \throws hydro::InputError at a line that cannot hang there, hydro::NumericsError if it
/// finds no rest
std::vector<LineModel> line_models(const scene::Scene& scene, const RunWater& water);

/// What `froude plan` tells of a line.
PlanLine plan_line(const LineModel& model);

/// A line on its way: its stepper, and what its signals are read off.
class LineRun {
 public:
  explicit LineRun(const LineModel& model);

  /// \throws hydro::NumericsError naming the line
  dynamics::line::StepReport step(double h);
  /// Brings tensions, forces and angles up to the state; before signals are read. Angles follow one another without
  /// jumps from one call to the next.
  void look();

  const dynamics::line::State& state() const { return state_; }
  const dynamics::line::Energies& energies() const { return stepper_.energies(); }
  /// The largest of energy supplied, taken, and moved about: what a residual is small against.
  double turnover() const { return turnover_; }

  struct Angles : dynamics::line::LinkAngles {
    double polar_rate, azimuth_rate;
  };
  const std::vector<Angles>& angles() const { return angles_; }
  const dynamics::line::Stepper::Balance& balance() const { return balance_; }

 private:
  const LineModel& model_;
  dynamics::line::State state_;
  dynamics::line::Stepper stepper_;
  dynamics::line::Stepper::Balance balance_;
  std::vector<Angles> angles_;
  double first_height_ = 0, turnover_ = 0;
};

/// A number that can be read off a line after look().
struct LineProbe {
  std::size_t line;
  std::string name, unit, long_name;
  std::function<double(const LineRun&)> read;
};
std::vector<LineProbe> line_probes(const std::vector<LineModel>& models);

}  // namespace froude::compile
