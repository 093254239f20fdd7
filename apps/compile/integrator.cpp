#include "compile/integrator.hpp"

#include <fmt/format.h>

#include "dynamics/integrate/energy_momentum.hpp"
#include "dynamics/integrate/euler.hpp"
#include "dynamics/integrate/explicit_pair.hpp"
#include "dynamics/integrate/generalized_alpha.hpp"
#include "hydro/base/error.hpp"

namespace froude::compile {
namespace {

/// Memory of the water is kept at the ends of steps: methods that look between them would miss its newest part.
void refuse_memory(const scene::Solve& solve, const dynamics::Model& model) {
  for (const auto& kind : model.forces())
    if (kind->effect() == "radiation")
      throw hydro::InputError(fmt::format("[solve.integrator] name = \"{}\" cannot step radiation", solve.integrator),
                              solve.integrator_place,
                              "take generalized_alpha or implicit_euler, or leave radiation out");
}

}  // namespace

std::unique_ptr<dynamics::Integrator> make_integrator(const scene::Solve& solve, const dynamics::Model& model) {
  if (solve.integrator == "generalized_alpha")
    return std::make_unique<dynamics::GeneralizedAlpha>(model,
                                                        dynamics::GeneralizedAlpha::Settings{solve.rho_infinity});
  if (solve.integrator == "implicit_euler") return std::make_unique<dynamics::ImplicitEuler>(model);
  refuse_memory(solve, model);
  try {
    if (solve.integrator == "energy_momentum") return std::make_unique<dynamics::EnergyMomentum>(model);
    if (solve.integrator == "semi_implicit_euler") return std::make_unique<dynamics::SemiImplicitEuler>(model);
    return std::make_unique<dynamics::ExplicitPair>(model, dynamics::ExplicitPair::Settings{solve.tolerance});
  } catch (const hydro::InputError& e) {
    throw e.at(solve.integrator_place);
  }
}

}  // namespace froude::compile
