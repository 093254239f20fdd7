#include "froude/scene.hpp"

#include <fmt/format.h>

#include "answers/answers.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "scene/override.hpp"

namespace froude {

struct Scene::Shared {
  scene::ChangeableScene source;
  std::vector<scene::OverriddenNumber> numbers;
  scene::Scene read;
  std::shared_ptr<compile::Kept> kept;
};

namespace {

/// \throws InputError unless the scene asks for this
template <class Ask>
void require_asked(const std::optional<Ask>& asked, const scene::Scene& scene, const std::string& what,
                   const std::string& example) {
  if (!asked)
    throw hydro::InputError(fmt::format("the scene does not ask for {}", what), {.file = scene.file.string()},
                            "add to [ask]: " + example);
}

}  // namespace

const scene::Scene& Scene::read() const { return shared_->read; }

Parameter Scene::parameter(const std::string& path) const {
  const auto written = shared_->source.number(path, shared_->numbers);
  return {path, written.value, written.unit};
}

Scene Scene::with(const Parameter& parameter, double value) const {
  auto numbers = shared_->numbers;
  numbers.push_back({parameter.path, value});
  scene::Scene changed = shared_->source.with(numbers);
  return Scene(
      std::make_shared<const Shared>(Shared{shared_->source, std::move(numbers), std::move(changed), shared_->kept}));
}

Run Scene::run(const std::function<void(double)>& progress, const std::vector<Control>& controls) const {
  require_asked(read().run, read(), "a run", "run = { duration = \"600 s\", every = \"0.05 s\" }");
  return simulate(read(), progress, controls, shared_->kept);
}

Responses Scene::rao() const {
  require_asked(read().rao, read(), "RAOs", "rao = { periods = \"2 s .. 8 s, 61 values\" }");
  return respond(read(), compile::prepare(read(), shared_->kept));
}

Modes Scene::modes() const {
  require_asked(read().ask_modes, read(), "modes", "modes = { longest = \"60 s\" }");
  return free_modes(read(), shared_->kept);
}

WaterSeries Scene::waves(const std::function<void(double)>& progress) const {
  require_asked(read().ask_waves, read(), "waves", "waves = { duration = \"600 s\", every = \"0.1 s\" }");
  return water_series(read(), progress);
}

Plan Scene::plan() const { return froude::plan(read(), shared_->kept); }

Scene parse(std::string_view text, const std::filesystem::path& file) {
  const scene::ChangeableScene source(text, file);
  return Scene(std::make_shared<const Scene::Shared>(
      Scene::Shared{source, {}, source.with({}), std::make_shared<compile::Kept>()}));
}

Scene read(const std::filesystem::path& file) { return parse(hydro::io::read_text(file), file); }

}  // namespace froude
