#pragma once
/// \file  One case answered: the numbers that the outputs of a study take from it.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compile/kept.hpp"
#include "froude/result.hpp"
#include "sweep/study.hpp"

namespace froude::sweep {

struct Number {
  std::string column;    ///< "buoy.heave.maximum"
  std::string unit;      ///< SI
  double value;          ///< NaN where the answer has none, such as the significant value of a still signal
  std::string why = {};  ///< why there is none
};

struct Answered {
  std::vector<Number> numbers;
  std::vector<std::string> warnings;  ///< what of the answers is not to be trusted
  std::optional<Run> run;             ///< where the study keeps series
};

/// Words that `statistic` may hold.
std::vector<std::string> statistics_of(Output::Kind kind);

/// Answers a scene. `kept`: coefficients and poles that cases share; `progress` may throw, which ends a run.
/// \throws hydro::InputError at an output that the scene does not have, or where the scene is refused;
/// hydro::NumericsError where there is no answer
Answered answer(const Study& study, std::string_view scene_text, const std::shared_ptr<compile::Kept>& kept,
                const std::function<void(double)>& progress);

}  // namespace froude::sweep
