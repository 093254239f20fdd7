#pragma once
/// \file  Coefficients of the cylinders that a scene describes.
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hydro/cylinders/field.hpp"
#include "hydro/cylinders/solve.hpp"
#include "scene/scene.hpp"

namespace froude::compile {

/// Bodies of the scene that say `cylinders`, in its order.
std::vector<int> bodies_of_cylinders(const scene::Scene& scene);

/// All these bodies together, each about its origin with the scene's centre of gravity, at the frequencies and headings
/// that they state, or the headings that the scene asks for.
/// \throws hydro::InputError, placed in the scene, if bodies state different ones, or what hydro::cylinders refuses
hydro::cylinders::Solution solve_cylinders(const scene::Scene& scene, const std::vector<int>& bodies,
                                           std::function<void(int, int)> progress = {});

/// The same without what checks them, and not solved again where an earlier start of the program has kept them.
hydro::potential::Coefficients coefficients_of_cylinders(const scene::Scene& scene, const std::vector<int>& bodies);

/// The surface about all these bodies, `question` being about their origins. \throws hydro::InputError as
/// solve_cylinders()
hydro::potential::WaveField field_of_cylinders(const scene::Scene& scene, const std::vector<int>& bodies,
                                               const hydro::potential::FieldQuestion& question);

/// All that the answer of solve_cylinders() depends on, as one text: equal texts, equal answers.
std::string what_is_solved(const scene::Scene& scene, const std::vector<int>& bodies);

/// What solve_cylinders() will take, told before it is done.
struct CylinderPlan {
  hydro::cylinders::Cost cost;
  std::size_t cylinders, bodies, frequencies, headings;
  std::optional<std::filesystem::path> kept_in;  ///< by an earlier start of the program; nothing is then done again
  double seconds() const { return kept_in ? 0 : cost.seconds; }
  std::string method() const;  ///< "exact, …"
  std::string size() const;    ///< numbers, memory and time in words
};

/// \throws hydro::InputError as solve_cylinders()
CylinderPlan plan_cylinders(const scene::Scene& scene, const std::vector<int>& bodies);

}  // namespace froude::compile
