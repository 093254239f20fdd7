#include "froude/scene.hpp"

#include <fmt/format.h>

#include <variant>

#include "answers/answers.hpp"
#include "answers/controlled_run.hpp"
#include "answers/cost.hpp"
#include "answers/fit_kind.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "scene/document.hpp"
#include "scene/override.hpp"

namespace froude {
namespace {

/// A scene of motion, and what others that differ in numbers share with it.
struct Motion {
  scene::ChangeableScene source;
  std::vector<scene::OverriddenValue> values;
  scene::Scene read;
  std::shared_ptr<compile::Kept> kept;
};

/// A scene that fits, and what was written over it.
struct Fitting {
  std::vector<scene::OverriddenValue> values;
  scene::FitScene read;
};

std::vector<scene::OverriddenValue> joined(std::vector<scene::OverriddenValue> values, const SceneValues& more) {
  for (const auto& [path, value] : more) values.push_back({path, value});
  return values;
}

template <class Ask>
void require_asked(const std::optional<Ask>& asked, const scene::Scene& scene, const std::string& what,
                   const std::string& example) {
  if (!asked)
    throw hydro::InputError(fmt::format("the scene does not ask for {}", what), {.file = scene.file.string()},
                            "add to [ask]: " + example);
}

}  // namespace

struct Scene::Shared {
  std::variant<Motion, Fitting> kind;

  /// \throws InputError for a scene that fits
  const Motion& motion() const {
    if (const auto* fit = std::get_if<Fitting>(&kind))
      throw hydro::InputError("this scene has a [model]: it asks for a fit, not for motion",
                              {.file = fit->read.file.string()}, "call fit(), or take the table out");
    return std::get<Motion>(kind);
  }
};

const scene::Scene& Scene::read() const { return shared_->motion().read; }

Parameter Scene::parameter(const std::string& path) const {
  const Motion& motion = shared_->motion();
  const auto written = motion.source.number(path, motion.values);
  return {path, written.value, written.unit};
}

Scene Scene::with(const Parameter& parameter, double value) const {
  shared_->motion();  // numbers of a fit are those of its model
  return with(SceneValues{{parameter.path, value}});
}

Scene Scene::with(const SceneValues& values) const {
  if (const auto* fit = std::get_if<Fitting>(&shared_->kind)) {
    auto all = joined(fit->values, values);
    scene::FitScene changed = scene::parse_fit(fit->read.text, fit->read.file, all);
    return Scene(std::make_shared<const Shared>(Shared{Fitting{std::move(all), std::move(changed)}}));
  }
  const Motion& motion = shared_->motion();
  auto all = joined(motion.values, values);
  scene::Scene changed = motion.source.with(all);
  return Scene(
      std::make_shared<const Shared>(Shared{Motion{motion.source, std::move(all), std::move(changed), motion.kept}}));
}

Run Scene::run(const std::function<void(double)>& progress, const std::vector<Control>& controls,
               const std::vector<JointControl>& of_joints) const {
  require_asked(read().run, read(), "a run", "run = { duration = \"600 s\", every = \"0.05 s\" }");
  const auto& kept = shared_->motion().kept;
  return of_joints.empty() ? simulate(read(), progress, controls, kept)
                           : simulate_controlled(read(), progress, controls, of_joints, kept);
}

Responses Scene::rao() const {
  require_asked(read().rao, read(), "RAOs", "rao = { periods = \"2 s .. 8 s, 61 values\" }");
  return respond(read(), compile::prepare(read(), shared_->motion().kept));
}

FreeSurface Scene::field() const {
  require_asked(read().field, read(), "the free surface",
                "field = { period = \"4 s\", x = \"-30 m .. 30 m, 61 values\", y = \"-30 m .. 30 m, 61 values\" }");
  return free_surface(read(), shared_->motion().kept);
}

Modes Scene::modes() const {
  require_asked(read().ask_modes, read(), "modes", "modes = { longest = \"60 s\" }");
  return free_modes(read(), shared_->motion().kept);
}

WaterSeries Scene::waves(const std::function<void(double)>& progress) const {
  require_asked(read().ask_waves, read(), "waves", "waves = { duration = \"600 s\", every = \"0.1 s\" }");
  return water_series(read(), progress);
}

Plan Scene::plan() const { return froude::plan(read(), shared_->motion().kept); }

Cost Scene::cost(const CostOptions& options, const std::function<void(double)>& progress) const {
  if (const auto& values = shared_->motion().values; !values.empty())
    throw hydro::InputError(
        fmt::format("\"{}\" was changed, and what a scene costs is measured of its text", values.front().path),
        {.file = read().file.string()}, "write the value into the text, and parse() that");
  return froude::cost(read(), options, progress);
}

::fit::Report Scene::fit() const {
  if (const auto* asked = std::get_if<Fitting>(&shared_->kind)) return asked->read.of->answer(asked->read).report;
  throw hydro::InputError("the scene has no [model]: it asks for motion, not for a fit", {.file = read().file.string()},
                          "call run() or rao()");
}

Scene parse(std::string_view text, const std::filesystem::path& file) {
  if (scene::parse_document(text, file.string()).find("model") != nullptr)
    return Scene(std::make_shared<const Scene::Shared>(Scene::Shared{Fitting{{}, scene::parse_fit(text, file)}}));
  const scene::ChangeableScene source(text, file);
  return Scene(std::make_shared<const Scene::Shared>(
      Scene::Shared{Motion{source, {}, source.with({}), std::make_shared<compile::Kept>()}}));
}

Scene read(const std::filesystem::path& file) { return parse(hydro::io::read_text(file), file); }

}  // namespace froude
