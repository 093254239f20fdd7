#pragma once
/// \file  Coefficients of the hulls whose meshes a scene names.
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hydro/panels/field.hpp"
#include "hydro/panels/solve.hpp"
#include "scene/scene.hpp"

namespace froude::compile {

class Kept;

/// Bodies of the scene that say `mesh`, in its order.
std::vector<int> bodies_of_meshes(const scene::Scene& scene);

/// Called after each system of equations that is solved for a mesh of a scene: how many are done, of how many. One call
/// at a time, from any thread; what it throws ends the work. This process has one; none until it is set.
void watch_hulls(std::function<void(int done, int all)> watcher);

/// All these bodies together, each about its origin with the scene's centre of gravity, their meshes put where the
/// bodies are at rest and cut at z = 0; at the frequencies and headings that they state, or the headings that the scene
/// asks for. The answer is kept in the folder of this process, fit_folder().
/// \throws hydro::InputError, placed in the scene, if bodies state different ones, or what hydro::panels refuses
hydro::panels::Solution solve_hulls(const scene::Scene& scene, const std::vector<int>& bodies);

/// The surface about all these bodies, `question` being about their origins. \throws hydro::InputError as solve_hulls()
hydro::potential::WaveField field_of_hulls(const scene::Scene& scene, const std::vector<int>& bodies,
                                           const hydro::potential::FieldQuestion& question);

/// The coefficients of solve_hulls(): those that an earlier process kept where it did, which a note then says.
hydro::potential::Coefficients coefficients_of_hulls(const scene::Scene& scene, const std::vector<int>& bodies);

/// The hull of a body with a mesh where the scene places it, about its centre of gravity, with its sections.
/// \throws hydro::InputError as solve_hulls()
hydro::panels::HullBody hull_of(const scene::Scene& scene, int body);

/// Loads on the parts that sections cut off, hydro::panels::Solution::parts, of all bodies of meshes; kept by this
/// process beside the coefficients, which are solved with them once.
const hydro::potential::Coefficients& parts_of_hulls(const scene::Scene& scene, Kept& kept);
/// What knows hydro::panels::Solution::doubted in the place of the coefficients of all bodies of meshes.
std::vector<std::shared_ptr<Kept>> kept_doubted(const scene::Scene& scene, Kept& kept);
/// coefficients_of_hulls() of all bodies of meshes, likewise.
const hydro::potential::Coefficients& kept_coefficients_of_hulls(const scene::Scene& scene, Kept& kept);

/// All that they depend on but what the files of meshes hold, as one text.
std::string what_hulls_are_solved(const scene::Scene& scene, const std::vector<int>& bodies);

/// "320 panels, …; 2 x 196 unknowns, 12 MB, about 3 s"
std::string size_of_hulls(const hydro::panels::Cost& cost, std::size_t frequencies, std::size_t headings);

/// What coefficients_of_hulls() will take, told before it is done.
struct HullPlan {
  hydro::panels::Cost cost;  ///< of solving
  std::size_t frequencies, headings;
  std::optional<std::filesystem::path> kept_in;  ///< solved before, so that nothing is to be done
  double seconds() const { return kept_in ? 0 : cost.seconds; }
  std::string method() const;  ///< "panels, …"
  std::string size() const;    ///< numbers, memory and time in words
};

/// \throws hydro::InputError as solve_hulls()
HullPlan plan_hulls(const scene::Scene& scene, const std::vector<int>& bodies);

}  // namespace froude::compile
