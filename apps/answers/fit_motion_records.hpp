#pragma once
/// \file  Records of a fit of kind "motion": their keys, and the numbers of a scene that are fitted to all of them or
///        to one. Private to apps.
#include <vector>

#include "answers/fit_kind.hpp"
#include "answers/fit_models.hpp"
#include "scene/record.hpp"

namespace froude::scene {

/// [[model.parameter]]
const Table& model_parameter();
/// Those of a table. \throws hydro::InputError, placed, for a number that the scene does not write, or one that stands
/// twice
std::vector<MotionModel::Parameter> read_parameters(const Record& of, const std::filesystem::path& scene);

/// [[data.record]]
const Binding<MotionModel::Record>& motion_record();
/// Its names, numbers and parameters, which need the scene; where there is no such table, each file is a record.
/// \throws hydro::InputError, placed
void read_records(const FitTables& tables, const FitScene& scene, MotionModel& motion);

}  // namespace froude::scene
