#pragma once
/// \file  Lines of nodes with ends on bodies, stepped together with them. (D90)-(D92)
#include "dynamics/force/force_kind.hpp"
#include "dynamics/line/driven.hpp"
#include "dynamics/state/point.hpp"

namespace dynamics {

/// A line, or a network of lines, with ends on bodies.
struct FastenedLine {
  struct End {
    int node;
    PointOnBody at;
    std::string name = {};  ///< "a.to" of line a
  };
  std::string name;
  line::Description run;      ///< in the water of a run
  line::Description still;    ///< without waves: what is at rest, and stiffness about rest
  line::Places places;        ///< of held nodes that are on no body; other columns are not looked at
  std::vector<End> ends;      ///< each a held node
  double rho_infinity = 0.8;  ///< of the generalised-α that steps bodies and lines
};

/// The line at rest with its ends where bodies have them. \throws hydro::InputError if it cannot reach,
/// hydro::NumericsError if it finds no rest
line::State line_at_rest(const FastenedLine& fastened, const State& bodies);

/// Lines between two accepted states of a run.
class FastenedLineMemory final : public Memory {
 public:
  FastenedLineMemory(const std::vector<FastenedLine>& elements, const State& state);
  void accept(const State& state) override;
  bool can_be_kept() const override { return true; }
  void keep_state(hydro::StateBytes& bytes) override {
    for (const auto& line : lines_) line->keep_state(bytes);
  }
  /// Begins again at `state`, its lines at rest, with accelerations (3, all ends) of the points that hold them.
  void start(const State& state, const line::Places& accelerations);
  /// Accelerations (3, all ends) of the points that hold them, where bodies have `acceleration`, (6N).
  line::Places accelerations_of_ends(const State& state, const Eigen::VectorXd& acceleration) const;
  /// Of line i if bodies are there, alone and with their derivatives; they stand until the next are asked of it.
  const line::Places& force(std::size_t i, const State& state);
  const line::DrivenLine::Pulls& pulls(std::size_t i, const State& state);
  line::DrivenLine& line(std::size_t i) { return *lines_[i]; }
  const line::DrivenLine& line(std::size_t i) const { return *lines_[i]; }

 private:
  struct AtRest {
    std::vector<line::DrivenLine::End> ends = {};
    line::State state = {};
  };
  const line::State& at_rest(std::size_t i, const State& state);

  const std::vector<FastenedLine>& elements_;
  std::vector<std::unique_ptr<line::DrivenLine>> lines_;
  std::vector<AtRest> at_rest_;              // where each line began last
  std::vector<line::DrivenLine::End> ends_;  // of the line that is asked; kept, so that a step asks for no memory
};

/// With memory, a load is the pull of a line at the end of a step that leads its ends to where the state has the
/// bodies: exact where bodies are stepped by the same generalised-α (D91). Without memory, lines are in their static
/// shape, with their static stiffness: that is what equilibrium and linear analyses see (D92). What a line holds, its
/// kinetic energy too, counts as stored.
class FastenedLineKind final : public ForceKind {
 public:
  explicit FastenedLineKind(std::vector<FastenedLine> elements) : elements_(std::move(elements)) {}
  std::string effect() const override { return "lines"; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override {
    return "chains stepped together with their bodies: one step, one Newton iteration around both";
  }
  void couple(BlockPattern& pattern) const override;
  std::unique_ptr<Memory> make_memory(const State& state) const override;
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant& now, JacobianSink& out) const override;
  EnergyFlow energy(const Instant& now) const override;
  bool linear_at_rest() const override { return true; }
  std::vector<Signal> signals() const override;
  const char* steps_stay_whole() const override { return "lines on bodies step whole"; }

 private:
  std::vector<FastenedLine> elements_;
};

}  // namespace dynamics
