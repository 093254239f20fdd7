#include "answers/periodic_scene.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <variant>

#include "compile/sections.hpp"

namespace froude {
namespace {

using dynamics::frequency::RadiatingModes;

PeriodicParts parts(const scene::Scene& scene, const compile::Prepared& prepared) {
  auto time = std::make_unique<const compile::TimeModel>(compile::time_model(scene, prepared, {}, true));
  std::vector<std::string> told_with_the_map;
  auto small = compile::small_motions(scene, time->model, scene.stability->about, told_with_the_map);
  return {std::move(time), std::move(small)};
}

std::vector<RadiatingModes> radiating(const compile::TimeModel& model) {
  std::vector<RadiatingModes> out;
  for (const compile::MemoryInRun& m : model.memories) out.push_back({m.modes, m.poles->model()});
  return out;
}

}  // namespace

scene::Scene with_waves(scene::Scene scene, double period, double height) {
  auto& wave = std::get<scene::RegularWave>(scene.waves->kind);
  wave.amplitude = height / 2, wave.period = period;
  scene.solve.step.reset();
  return scene;
}

scene::Scene in_waves(scene::Scene scene, double period, double height) {
  scene = with_waves(std::move(scene), period, height);
  scene.waves->ramp = 0;
  // One period is enough: the model is asked within it, and its samples are not looked at.
  scene.run = {.duration = period, .every = period / 32, .of = {}, .of_places = {}, .place = scene.stability->place};
  return scene;
}

compile::Prepared prepare_periodic(const scene::Scene& scene, const std::shared_ptr<compile::Kept>& kept) {
  compile::require_no_sections(scene);
  compile::Prepared out = compile::prepare(scene, kept);
  using Method = scene::Memory::Method;
  for (scene::Memory& memory : out.memory) {
    if (memory.method != Method::automatic && memory.method != Method::poles)
      out.notes.push_back(
          "radiation is by poles in periodic motions, whose multipliers need its states; the scene names another "
          "method");
    memory.method = Method::poles;
  }
  return out;
}

PeriodicScene::PeriodicScene(const scene::Scene& scene, const compile::Prepared& prepared, double period)
    : PeriodicParts(parts(scene, prepared)),
      PeriodicModel(time->model, small, radiating(*time), 2 * std::numbers::pi / period) {}

Eigen::MatrixXd PeriodicScene::values(const std::vector<dynamics::Signal>& signals,
                                      const dynamics::frequency::PeriodicMotion& motion,
                                      const std::vector<double>& times) {
  Eigen::MatrixXd out(static_cast<Eigen::Index>(times.size()), static_cast<Eigen::Index>(signals.size()));
  const dynamics::frequency::PeriodicMotion load = load_of_memory(*this, motion);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Bodies now = bodies(motion.at(times[i]));
    const Eigen::VectorXd lambda = multipliers(now, load.at(times[i]).value);
    const dynamics::Reading reading{now.state, now.acceleration, lambda, model().joints().count(), nullptr};
    for (std::size_t s = 0; s < signals.size(); ++s)
      out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(s)) = signals[s].value(reading);
  }
  return out;
}

}  // namespace froude
