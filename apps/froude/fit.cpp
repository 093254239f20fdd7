#include "froude/fit_summary.hpp"
#include "froude/outputs.hpp"
#include "hydro/base/error.hpp"

namespace froude {

void fit(const FitArguments& arguments, const Console& console) {
  const scene::FitScene scene = scene::read_fit(arguments.scene);
  require_outputs(named({{"-o", arguments.output}, {"--table", arguments.table}, {"--picture", arguments.picture}}),
                  files_of_scene(arguments.scene));
  const bool has_table = std::holds_alternative<scene::MorisonModel>(scene.model) ||
                         std::holds_alternative<scene::RadiationModel>(scene.model) ||
                         std::holds_alternative<scene::DecayModel>(scene.model);
  if (arguments.table && !has_table)
    throw hydro::InputError(fmt::format("a fit of kind \"{}\" has no table of runs", scene.kind()), {},
                            "leave out --table");
  const FitOutcome outcome = std::visit([&](const auto& model) { return fit_model(scene, model); }, scene.model);
  deliver(outcome, scene.confidence, arguments, console);
}

}  // namespace froude
