#include <fmt/format.h>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answers/answers.hpp"
#include "answers/cost_interview.hpp"
#include "answers/periodic_answers.hpp"
#include "answers/provenance.hpp"
#include "answers/stability_check.hpp"
#include "dynamics/frequency/hill_equation.hpp"
#include "dynamics/frequency/modes.hpp"
#include "hydro/base/error.hpp"
#include "scene/placed.hpp"

namespace froude {
namespace {

using namespace dynamics::frequency;

/// The map as it is made, period by period.
class Mapping {
 public:
  explicit Mapping(const scene::Scene& scene, const std::shared_ptr<compile::Kept>& kept)
      : scene_(scene), ask_(*scene.stability), prepared_(prepare_periodic(scene, kept)), answers_(scene, prepared_) {
    map_.period = ask_.periods, map_.height = ask_.heights;
    map_.cells.resize(map_.period.size() * map_.height.size());
    map_.notes = prepared_.notes;
    map_.provenance = provenance_of(scene);
    const dynamics::Model model = compile::frequency_model(prepared_, ask_.about);
    const SmallMotions about = compile::small_motions(scene, model, ask_.about, map_.notes);
    for (Mode& m : free_motions(about, prepared_.groups).modes) modes_.push_back(std::move(m));
    for (int m = 0; m < model.modes(); ++m) motions_.push_back(model.mode_name(m));
    map_.signals = answers_.signals();
    for (Signal& signal : map_.signals) signal.values.assign(map_.cells.size(), std::nan(""));
  }

  StabilityMap made(const std::function<void(double)>& done) {
    const double begin = processor_s();
    const double parts = static_cast<double>(map_.period.size() + ask_.branches.size());
    for (std::size_t p = 0; p < map_.period.size(); ++p) {
      climb(p);
      reduce(p);
      if (done) done(static_cast<double>(p + 1) / parts);
    }
    map_.processor_s = processor_s() - begin;
    refuse_if_all_break();
    for (const auto& branch : ask_.branches) {
      map_.branches.push_back(scene::placed(branch.place, [&] { return followed(answers_, ask_, branch); }));
      if (done) done(static_cast<double>(map_.period.size() + map_.branches.size()) / parts);
    }
    return std::move(map_);
  }

 private:
  /// From rest up through the heights of a period, each from the motion before it.
  void climb(std::size_t p) {
    const double period = map_.period[p];
    std::optional<MotionAt> from;
    MotionAt before = answers_.still(period);
    for (std::size_t h = 0; h < map_.height.size(); ++h) {
      const double height = map_.height[h];
      StabilityMap::Cell& cell = map_.cells[map_.index(p, h)];
      if (answers_.beyond_breaking(period, height)) {
        cell.reached = StabilityMap::Reached::beyond_breaking;
        continue;
      }
      const auto system = answers_.at(period, height);
      note(system->notes());
      auto [end, reached] = from ? answers_.reached(period, before, *from, height) : answers_.from_rest(period, height);
      cell.reached = reached;
      if (!end.found) {
        map_.notes.push_back(
            fmt::format("{:.4g} s, {:.4g} m: no periodic motion is found: {}", period, height, end.why));
        continue;
      }
      tell(*system, end.motion, map_.index(p, h));
      // Beyond a fold or a jump the way before says nothing of the way to come.
      before = from && reached == StabilityMap::Reached::grown ? std::move(*from) : answers_.still(period);
      from = {height, std::move(end.motion)};
    }
  }

  void refuse_if_all_break() const {
    if (std::any_of(map_.cells.begin(), map_.cells.end(),
                    [](const auto& c) { return c.reached != StabilityMap::Reached::beyond_breaking; }))
      return;
    throw hydro::InputError(fmt::format("all waves of the map are beyond breaking, from {:.4g} m at {:.4g} s on",
                                        map_.height.front(), map_.period.back()),
                            ask_.place, "make the waves lower, or longer");
  }

  void note(const std::vector<std::string>& notes) {
    for (const std::string& one : notes)
      if (std::find(map_.notes.begin(), map_.notes.end(), one) == map_.notes.end()) map_.notes.push_back(one);
  }

  void tell(PeriodicScene& system, const PeriodicMotion& motion, std::size_t c) {
    static_cast<StabilityMap::Motion&>(map_.cells[c]) = answers_.told(system, motion);
    const std::vector<double> deviations = answers_.deviations(system, motion);
    for (std::size_t s = 0; s < map_.signals.size(); ++s) map_.signals[s].values[c] = deviations[s];
  }

  /// The least height from which any one motion grows by its own equation.
  void reduce(std::size_t p) {
    map_.mathieu.push_back(std::nan(""));
    map_.motion.emplace_back();
    double highest = 0;
    for (const double height : map_.height)
      if (!answers_.beyond_breaking(map_.period[p], height)) highest = std::max(highest, height);
    if (highest == 0) return;
    const Family family = answers_.by_height(map_.period[p]);
    const auto system = answers_.at(map_.period[p], 1e-2 * highest);
    for (const Mode& mode : modes_) {
      const HillEquation equation = hill_equation(family, 1e-2 * highest, system->coordinates(mode.shape), mode.omega);
      const auto least = equation.least_growing(highest);
      if (!least || *least >= map_.mathieu.back()) continue;
      map_.mathieu.back() = *least;
      map_.motion.back() = largest_motions(motions_, {mode.shape.data(), static_cast<std::size_t>(mode.shape.size())});
    }
  }

  const scene::Scene& scene_;
  const scene::AskStability& ask_;
  compile::Prepared prepared_;
  PeriodicAnswers answers_;
  std::vector<Mode> modes_;
  std::vector<std::string> motions_;  ///< names of the model's modes
  StabilityMap map_;
};

}  // namespace

std::vector<dynamics::Signal> signals_of_map(const scene::AskStability& ask, const dynamics::Model& model) {
  std::vector<dynamics::Signal> out = model.signals();
  std::vector<std::string> names;
  for (const auto& s : out) names.push_back(s.name);
  scene::check_patterns(ask.of, ask.of_places, names);
  std::erase_if(out, [&](const auto& s) { return !compile::is_chosen(s.name, ask.of); });
  return out;
}

double standard_deviation(const Eigen::Ref<const Eigen::VectorXd>& x) {
  return std::sqrt((x.array() - x.mean()).square().mean());
}

StabilityMap stability(const scene::Scene& scene, const std::function<void(double)>& done,
                       const std::shared_ptr<compile::Kept>& kept) {
  if (!scene.lines.empty())
    throw hydro::InputError("periodic motions have no place for lines of nodes", scene.lines.front().place,
                            "leave them out, or step the scene with `froude run`");
  return scene::placed(scene.stability->place, [&] { return Mapping(scene, kept).made(done); });
}

}  // namespace froude
