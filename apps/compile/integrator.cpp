#include "compile/integrator.hpp"

#include <fmt/format.h>

#include "dynamics/integrate/energy_momentum.hpp"
#include "dynamics/integrate/euler.hpp"
#include "dynamics/integrate/explicit_pair.hpp"
#include "dynamics/integrate/generalized_alpha.hpp"
#ifdef FROUDE_SUNDIALS
#include "dynamics/integrate/sundials_bdf.hpp"
#endif
#include "hydro/base/error.hpp"
#include "scene/placed.hpp"

namespace froude::compile {
namespace {

/// Memory of the water is kept at the ends of steps: methods that look between them would miss its newest part.
void refuse_memory(const scene::Solve& solve, const dynamics::Model& model) {
  for (const auto& kind : model.forces())
    if (kind->remembers_whole_steps())
      throw hydro::InputError(
          fmt::format("[solve.integrator] name = \"{}\" cannot step {}", solve.integrator, kind->effect()),
          solve.integrator_place,
          fmt::format("take generalized_alpha or implicit_euler, or leave {} out", kind->effect()));
}

/// What cannot step in parts says so.
void refuse_tolerance(const scene::Solve& solve, const dynamics::Model& model) {
  const auto refuse = [&](const char* why, const char* remedy) {
    throw hydro::InputError(fmt::format("[solve.integrator] tolerance cuts the steps of bodies: {}", why),
                            solve.integrator_place, remedy);
  };
  if (model.bodies().empty()) refuse("the scene has none", "leave it out; lines have steps of their own");
  for (const auto& kind : model.forces())
    if (const char* why = kind->steps_stay_whole()) refuse(why, "leave it out, and choose [solve] step");
}

std::unique_ptr<dynamics::Integrator> sundials([[maybe_unused]] const scene::Solve& solve,
                                               [[maybe_unused]] const dynamics::Model& model) {
#ifdef FROUDE_SUNDIALS
  return std::make_unique<dynamics::SundialsBdf>(
      model, dynamics::SundialsBdf::Settings{solve.tolerance.value_or(tolerance_of_pair)});
#else
  throw hydro::InputError("[solve.integrator] name = \"sundials_bdf\": this froude was built without SUNDIALS", {},
                          "install Debian's libsundials-dev and configure with -DFROUDE_SUNDIALS=ON");
#endif
}

std::unique_ptr<dynamics::Integrator> by_name(const scene::Scene& scene, const dynamics::Model& model) {
  const scene::Solve& solve = scene.solve;
  if (solve.integrator == "generalized_alpha")
    return std::make_unique<dynamics::GeneralizedAlpha>(
        model, dynamics::GeneralizedAlpha::Settings{solve.rho_infinity, scene::newton_tolerance(scene)});
  if (solve.integrator == "implicit_euler") return std::make_unique<dynamics::ImplicitEuler>(model);
  refuse_memory(solve, model);
  if (solve.integrator == "energy_momentum") return std::make_unique<dynamics::EnergyMomentum>(model);
  if (solve.integrator == "semi_implicit_euler") return std::make_unique<dynamics::SemiImplicitEuler>(model);
  if (solve.integrator == "sundials_bdf") return sundials(solve, model);
  return std::make_unique<dynamics::ExplicitPair>(
      model, dynamics::ExplicitPair::Settings{solve.tolerance.value_or(tolerance_of_pair)});
}

}  // namespace

bool has_own_tolerance(const std::string& integrator) {
  return integrator == "explicit_pair" || integrator == "sundials_bdf";
}

bool has_steps_by_tolerance(const scene::Solve& solve) {
  return solve.tolerance || has_own_tolerance(solve.integrator);
}

std::unique_ptr<dynamics::Integrator> make_integrator(const scene::Scene& scene, const dynamics::Model& model) {
  const scene::Solve& solve = scene.solve;
  if (solve.tolerance) refuse_tolerance(solve, model);
  return scene::placed(solve.integrator_place, [&] {
    auto out = by_name(scene, model);
    if (solve.tolerance && !has_own_tolerance(solve.integrator)) out->cut_steps(*solve.tolerance);
    return out;
  });
}

}  // namespace froude::compile
