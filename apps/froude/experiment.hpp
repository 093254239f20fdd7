#pragma once
/// \file  `froude experiment`: numbers of experiments that belong together, times in a tank, lengths of records.
#include <optional>

#include "fit/experiment.hpp"
#include "fit/problem/planned_tow.hpp"
#include "fit/regular_waves.hpp"
#include "froude/commands.hpp"

namespace froude {

/// A swing of a cylinder: what is known of it, and how well its coefficients are to be told.
struct OscillationPlanArguments {
  ::fit::OscillationNumbers known = {};
  double viscosity = 0;
  std::optional<double> width = {};  ///< half of the interval that is wanted; none: only the numbers are told
  bool loads = false;                ///< the largest force is told: length and density of the record are known
  ::fit::Wanted wanted = ::fit::Wanted::cd;
  ::fit::PlannedOscillation record = {};  ///< but amplitude, period and diameter, which follow
};
struct TowPlanArguments {
  std::optional<double> diameter = {}, speed = {}, re = {};  ///< two of them
  double viscosity = 0, length = 0, acceleration = 1;        ///< of the tank
  std::optional<double> strouhal = {};
  std::optional<double> width = {};  ///< half of the interval that is wanted; none: only numbers and time are told
  bool loads = false;                ///< the force is told: length and density of the record are known
  ::fit::PlannedTow record = {};     ///< but speed, acceleration and diameter, which follow
};
struct WavePlanArguments {
  double period = 0, height = 0;
  ::fit::WaveTank tank = {};
  double ramp = 0, settle_periods = 5;
  std::optional<double> diameter = {}, level = {};  ///< of a cylinder across the waves; m below still water
  double cd = 1.2, cm = 2;                          ///< that are expected of it
  std::optional<Path> picture = {};                 ///< of which load leads, for other waves too
};
void plan_oscillation(const OscillationPlanArguments& arguments, const Console& console);
void plan_tow(const TowPlanArguments& arguments, const Console& console);
void plan_waves(const WavePlanArguments& arguments, const Console& console);

}  // namespace froude
