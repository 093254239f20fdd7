#pragma once
/// \file  Runs beside a run: the same scene with one approximation varied, to see what it does to the signals. (E1).
///        Private to apps.
#include <functional>
#include <map>
#include <optional>

#include "answers/checkpoint.hpp"
#include "answers/convergence.hpp"
#include "compile/compile.hpp"
#include "compile/defect.hpp"
#include "compile/members.hpp"
#include "scene/scene.hpp"

namespace froude {

/// Runs of one scene with other steps, or other tolerances where the integrator cuts its steps by one. Level 0 is what
/// the scene gives or the program chooses; each level above has twice the step and ten times the tolerance, each
/// level below half of it, and a tenth.
class Companions {
 public:
  /// Scene and progress are referred to and must live as long. `progress`: told the share done of each run, in the
  /// caller's thread. The step of level 0 is chosen here. `threads`: 1 or 2; runs are the same with either.
  /// \throws hydro::InputError as compile::choose_step(); whatever makes a run throws Interrupted once a signal has
  /// come
  Companions(const scene::Scene& scene, compile::Prepared prepared, const std::function<void(double)>& progress,
             int threads, Checkpoints* checkpoints = nullptr, const Interruption* interruption = nullptr);

  /// True if a tolerance is varied, not a step.
  bool by_tolerance() const { return by_tolerance_; }
  /// True if the scene gives what is varied.
  bool given() const { return given_; }
  /// s; that of level 0.
  double first_step() const { return step_; }
  /// By which errors fall from one level to the next at most: that of the method's order.
  double largest_ratio() const;
  /// "runs at 2 and 4 times the step"
  std::string how() const;

  /// The run of a level, made once. \throws hydro::InputError
  const Run& run(int level);
  /// That it and as many `above` it will be asked for: with two threads they are made beside each other.
  void foresee(int level, int above);
  /// The same, of which `fine` is another: how many of its samples lie from one of `level` to the next.
  Beside beside(int level);
  /// One that is made already.
  const Run& at(int level) const { return runs_.at(level).run; }
  /// True if that run came to its end.
  bool completes(int level) { return run(level).stopped.empty(); }
  /// A level that came to its end with the loads put back that approximations of the water keep from it, by its own
  /// motion: those of the memory, and those of the spacing of coefficients; nothing where it misses none.
  struct WithWater {
    std::optional<Run> memory, coefficients;
  };
  WithWater completed_by_water(int level);
  /// What stands for something even by being cut into equal pieces: segments of lines; pieces of members, as many as
  /// the scene says or as the program chooses.
  enum class Cut { segments, given_pieces, chosen_pieces };
  bool has(Cut what) const;
  /// A level with twice as many of them: its signals, each where the level has it. One that did not come to its end, or
  /// could not begin, says why.
  Run cut_finer(Cut what, int level);
  /// By how many times more pieces than the program chose first its members are cut.
  int refined_pieces() const { return refined_pieces_; }
  /// Its members have `times` as many pieces again; all runs are made anew.
  void refine_pieces(int times);
  /// Level 0 with its start moved by `moved_by()`, this way and that.
  const Run& neighbour();
  /// A level and its neighbour over the first quarters of the run, or more of them, 4 at most.
  struct Pair {
    Run run, neighbour;
    int quarters;
  };
  const Pair& pair(int level, int quarters);
  /// The level whose steps are an eighth of what the program itself would begin with, or shorter; 0 where the scene
  /// gives such steps.
  int much_shorter() const;
  /// m, rad, m/s and rad/s: far above what Newton leaves, far below what anybody asks for.
  double moved_by() const;
  /// True if that run came to its end in steps longer than those of the level below: where there are few samples, and a
  /// step for each, there are none.
  bool is_longer(int level) {
    return completes(level) && completes(level - 1) && run(level).step > 1.4 * run(level - 1).step;
  }
  /// All that are made and came to their end.
  std::vector<const Run*> completed() const;
  /// Hands a run over; it is made anew if it is asked for again.
  Run take(int level);
  /// Hands over what there is of a run after a signal, without an estimate of its error.
  Run interrupted(int level);

 private:
  /// A level with the velocities of its bodies at each step.
  struct Followed {
    scene::Scene scene;
    compile::TimeModel model;
    compile::VelocityRecord motion;
  };
  struct Made {
    Run run;
    std::size_t stride = 1;
    std::optional<compile::VelocityRecord> motion = {};  ///< where it may be asked for, and is small
  };
  Made made(int level, const std::function<void(double)>& progress) const;
  Made stepped(int level, const std::function<void(double)>& progress) const;
  Run quarters_of(int level, int quarters, bool disturbed, const std::function<void(double)>& progress) const;
  bool keeps_motion(int level, const compile::TimeModel& model) const;
  std::optional<Run> with_load(int level, const std::optional<compile::LoadRecord>& load, const std::string& name,
                               const std::function<void(double)>& progress);
  scene::Scene scene_of(int level, std::size_t& stride, compile::PieceTimes pieces) const;
  scene::Scene scene_of(int level, std::size_t& stride) const { return scene_of(level, stride, {1, refined_pieces_}); }
  scene::Scene cut_scene(Cut what, int level) const;
  compile::Prepared prepared_for(Cut what, const scene::Scene& scene) const;
  const Followed& followed(int level);
  static const char* name_of(Cut what);
  /// The checkpoints of one of the runs.
  KeptRun kept(const std::string& name, int level) const;
  /// What signals have cut short is compared with nothing. \throws Interrupted
  void require_uninterrupted() const;

  const scene::Scene& scene_;
  compile::Prepared prepared_;
  const std::function<void(double)>& progress_;
  int threads_;
  Checkpoints* checkpoints_;
  const Interruption* interruption_;
  bool by_tolerance_, given_;
  double step_, tolerance_;  // s; of level 0
  int refined_pieces_ = 1;
  std::map<int, Made> runs_;
  std::map<int, Made> foreseen_;  // and not asked for yet
  std::map<int, Followed> followed_;
  std::optional<Run> neighbour_;
  std::map<int, Pair> pairs_;
};

}  // namespace froude
