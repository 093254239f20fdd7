#pragma once
/// \file  A scene of motion run with other numbers in it, whole or in windows: what a fit of kind "motion" and its
///        validation follow. Private to apps/froude.
#include <Eigen/Core>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "answers/fit_models.hpp"
#include "answers/fit_scene.hpp"
#include "answers/simulate.hpp"
#include "compile/restart.hpp"
#include "fit/simulated.hpp"
#include "scene/override.hpp"

namespace froude {

/// What was measured, in windows.
struct MeasuredRun {
  std::vector<double> time;         ///< s, from the run's start
  Eigen::MatrixXd values;           ///< one column a signal, SI; NaN where a film did not show it
  double step;                      ///< s, of the run
  Eigen::Index before;              ///< samples of the run that come before the first one measured
  std::vector<Eigen::Index> first;  ///< sample of each window
  /// Of uneven samples: where each lies among the run's samples, in steps from the run's start, and the run's sample at
  /// which each window begins; empty: they are the run's samples.
  std::vector<double> at = {};
  std::vector<Eigen::Index> begin = {};
  std::vector<Eigen::MatrixXd> whitening = {};  ///< of a film: one a frame, as fit::SimulationProblem's
  std::vector<double> deviations = {};          ///< of a film: one a signal, SI

  Eigen::Index rows(std::size_t window) const;
  /// Samples of the run that it takes to tell a window's, and from one window's start to the next.
  Eigen::Index run_samples(std::size_t window) const;
  Eigen::Index run_length(std::size_t window) const;
  /// The values of a window from the run's samples, of which the first is the window's start (or the run's, where there
  /// is one window).
  Eigen::VectorXd told(std::size_t window, const std::vector<double>& run) const;
  /// Cuts the record into windows of this length; what is left over makes the last one longer. 0: one window.
  /// \throws hydro::InputError for fewer than 8 samples in a window, or a start between samples of the run
  static MeasuredRun of(std::vector<double> time, Eigen::MatrixXd values, double window_s);
  /// Samples at their own times, counted from the run's start: with gaps, and uneven. Between samples the run is a
  /// polynomial of degree 5 (F102). \throws hydro::InputError as of(), and for a window in which fewer than 8 samples
  /// lie
  static MeasuredRun of_uneven(std::vector<double> time, Eigen::MatrixXd values, double window_s);
  /// A record of a fit scene, the signals of its model, as of() where its samples are even and begin at one of the
  /// run's, else as of_uneven(). \throws hydro::InputError as these, naming the file
  static MeasuredRun read(const scene::FitScene& fit, const scene::MotionModel& model,
                          const scene::MotionModel::Record& record);
};

/// Gives films of one fit the same deviations, rms over the frames of all, and whitening that goes with them: weights
/// stay what they are.
void share_deviations(const std::vector<MeasuredRun*>& films);

/// The runs. \throws hydro::InputError, in all it does, for scenes that cannot be run, or not in windows
class SceneRuns final : public ::fit::Simulation {
 public:
  /// Of the numbers that all records share, then those of this record. All are referred to and must live as long.
  /// `kept`: what other records have read.
  SceneRuns(const scene::MotionModel& model, const MeasuredRun& measured,
            const scene::MotionModel::Record& record = as_the_model_says(),
            std::shared_ptr<compile::Kept> kept = nullptr);

  Eigen::Index coordinates(std::size_t window) override;
  Eigen::MatrixXd follow(std::size_t window, const Eigen::VectorXd& parameters, const Eigen::VectorXd& start) override;
  void hand_on(std::size_t window, const Eigen::VectorXd& parameters, const Eigen::VectorXd& start) override;
  bool divide_steps(int by) override;

  /// True if the scene gives no step, nor a tolerance where that makes the steps.
  bool own_steps() const;
  /// Units of the signals, in their order. \throws hydro::InputError at a signal that there is not
  std::vector<std::string> units();
  /// What all trials share: coefficients as they were read, and their poles.
  const std::shared_ptr<compile::Kept>& kept() const { return prepared_.kept; }

 private:
  static const scene::MotionModel::Record& as_the_model_says();
  const scene::Located<std::filesystem::path>& scene_file() const;
  std::vector<scene::OverriddenValue> numbers(const Eigen::VectorXd& parameters) const;
  void compiled(const Eigen::VectorXd& parameters);
  void divide(scene::Solve& solve) const;
  Run run(Eigen::Index samples, compile::MovingState* end);
  void begin_windows();

  const scene::MotionModel& asked_;
  const MeasuredRun& measured_;
  const scene::MotionModel::Record& record_;
  scene::ChangeableScene source_;
  scene::Scene scene_;
  compile::Prepared prepared_;
  std::optional<compile::TimeModel> model_;
  Eigen::VectorXd numbers_;
  std::vector<compile::StateChart> charts_;
  /// s, where the scene gives none: that of the numbers as it has them. It is held while they are searched for, since
  /// motions jump by the error of a step where that changes.
  std::optional<double> chosen_step_;
  int divided_ = 1;
  /// Method of each memory, held once steps are divided.
  std::vector<scene::Memory::Method> memory_methods_;
};

}  // namespace froude
