#pragma once
/// \file  The lines of a scene, ready to be stepped, and the signals that they give.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/force/fastened_line.hpp"
#include "dynamics/line/perturbed_trajectory.hpp"
#include "dynamics/line/statistics.hpp"
#include "dynamics/line/stepper.hpp"
#include "froude/result.hpp"
#include "hydro/waves/kinematics/sea.hpp"
#include "hydro/waves/synthesis/field_choice.hpp"
#include "scene/scene.hpp"

namespace froude::compile {

struct Prepared;
struct RunWater;
struct Signal;

/// One line where a run begins, or several that meet: one system.
struct LineModel {
  /// One `[[line]]` of it.
  struct Part {
    std::string name;
    int first_node, nodes, first_segment, segments;
    bool from_on_body = false, to_on_body = false;  ///< pulls there are signals of the model's
    std::optional<scene::Line::Snaps> snaps = {};
    /// Which coefficients its segments took from a table, for people; empty where they were given.
    std::string coefficients = {};
    /// How far the places of its release were brought to where its links reach, for people; empty if they were not.
    std::string released = {};
  };
  struct Knot {
    std::string name;
    int node;
  };
  std::string name;  ///< of its first line
  std::vector<Part> parts;
  std::vector<Knot> knots = {};
  std::unique_ptr<const dynamics::line::Line> line;
  dynamics::line::State start;  ///< at rest without waves, with the nodes that are to be released still in their places
  dynamics::line::Stepper::Settings settings;
  std::optional<scene::Line::Lyapunov> lyapunov = {};
  std::optional<std::size_t> fastened = {};  ///< its place among the model's FastenedLine; it moves with its bodies
  /// Of the links, where a run goes on from another one's end: angles follow these without jumps.
  std::vector<dynamics::line::LinkAngles> before = {};
};

/// What wet lines ask of the waves of a run, around their places at rest; empty if there are none, or few waves.
/// \throws hydro::InputError, hydro::NumericsError as line_models()
std::optional<hydro::waves::FieldUse> water_of_lines(const scene::Scene& scene, const Prepared& prepared,
                                                     const hydro::waves::Sea& sea, double step);

/// In the order of the scene's networks; those on bodies where `start` has them. \throws hydro::InputError at a line
/// that cannot hang there, hydro::NumericsError if it finds no rest
std::vector<LineModel> line_models(const scene::Scene& scene, const Prepared& prepared, const RunWater& water,
                                   const dynamics::State& start);

/// The same without a run, for what they are and tell: they have no start.
std::vector<LineModel> lines_as_placed(const scene::Scene& scene);

/// Adds the networks of lines of a scene that have ends on bodies, which are there already, as those feel them at rest.
/// \throws hydro::InputError at a line that cannot hang where the scene places its bodies
void add_fastened_lines(const scene::Scene& scene, Prepared& prepared);
/// The same in the water of a run. \throws hydro::InputError if the scene asks for what has no step together with lines
std::unique_ptr<const dynamics::ForceKind> fastened_kind(const scene::Scene& scene, const Prepared& prepared,
                                                         const RunWater& water);

/// "line a", or "lines a, b, c"; the same with each name between quotes.
std::string names_of(const LineModel& model);
std::string quoted_names_of(const LineModel& model);

/// What `froude plan` tells of a line, or of lines that meet.
PlanLine plan_line(const LineModel& model);

/// A line on its way: its stepper, and what its signals are read off.
class LineRun {
 public:
  explicit LineRun(const LineModel& model);
  /// Of a line that moves with its bodies.
  LineRun(const LineModel& model, dynamics::line::DrivenLine& driven);

  /// Nothing to do for a line that moves with its bodies. \throws hydro::NumericsError naming the line
  dynamics::line::StepReport step(double h);
  /// A step of h seconds is done: what is counted over steps.
  void note(double h);
  /// Of one of its lines; null where the scene does not ask for it.
  const dynamics::line::TensionStatistics* snaps(std::size_t part) const {
    return snaps_[part] ? &*snaps_[part] : nullptr;
  }
  /// Empty where the scene does not ask for it, or the run has not lasted long enough.
  std::optional<dynamics::Exponent> exponent() const;
  /// Brings tensions, forces and angles up to the state, if they are not there; before signals are read. Angles follow
  /// one another without jumps from one call to the next.
  void look();
  /// All that the run of the line goes on from, into bytes or out of them; of one that moves with its bodies what is
  /// counted beside its motion.
  void keep_state(hydro::StateBytes& bytes);

  const dynamics::line::State& state() const { return driven_ != nullptr ? driven_->state() : state_; }
  const dynamics::line::Energies& energies() const {
    return driven_ != nullptr ? driven_->energies() : stepper_->energies();
  }
  /// Null where the scene does not ask for it.
  const dynamics::Growth* growth() const { return perturbed_ ? &perturbed_->growth() : nullptr; }
  /// The largest of energy supplied, taken, and moved about: what a residual is small against.
  double turnover() const { return turnover_; }

  struct Angles : dynamics::line::LinkAngles {
    double polar_rate, azimuth_rate;
    void keep_state(hydro::StateBytes& bytes) { bytes.pass(polar, azimuth, polar_rate, azimuth_rate); }
  };
  const std::vector<Angles>& angles() const { return angles_; }
  const dynamics::line::Stepper::Balance& balance() const { return driven_ != nullptr ? driven_->balance() : balance_; }

 private:
  void begin();
  void note_turnover();
  const LineModel& model_;
  dynamics::line::DrivenLine* driven_ = nullptr;
  dynamics::line::State state_;
  std::unique_ptr<dynamics::line::Stepper> stepper_;
  dynamics::line::Stepper::Balance balance_;                             // of one that moves alone
  std::vector<std::optional<dynamics::line::TensionStatistics>> snaps_;  // one a part
  std::unique_ptr<dynamics::line::PerturbedTrajectory> perturbed_;
  std::vector<Angles> angles_;
  double first_height_ = 0, turnover_ = 0;
  bool looked_ = false;  // since the last step
};

/// What lines tell of themselves. \return beside what the model tells of pulls on bodies
void add_line_signals(const std::vector<LineModel>& models, std::vector<Signal>& out);

}  // namespace froude::compile
