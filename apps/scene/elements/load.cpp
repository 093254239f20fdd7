/// \file  `[[load]]`: a force and a moment that stay as they are, or rise and fall. (D150)
#include "dynamics/force/constant_load.hpp"
#include "scene/element.hpp"
#include "scene/load_history.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

struct Load {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();      ///< body axes, m
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< global axes, N
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< N m
  dynamics::LoadHistory history = {};
};

/// Steps of bodies do not end where a load jumps, as those of lines do.
void require_ramps(const Record& record, const Load& load) {
  if (load.history.from > 0 && load.history.ramp_up == 0)
    throw record.wrong("from", "begins a load that is there at once, within a step of the body",
                       "give it a ramp_up, of some steps at least");
  if (record.has("until") && load.history.ramp_down == 0)
    throw record.wrong("until", "ends a load at once, within a step of the body",
                       "give it a ramp_down, of some steps at least");
}

const Binding<Load>& binding() {
  static const Binding<Load> load =
      Binding<Load>("[[load]]", "a force and a moment: wind, a tow, a pull that rises and is let go")
          .key(vector("at", dim::length, "where the force acts, body axes")
                   .or_default("(0, 0, 0) m", "the body's origin"),
               &Load::at)
          .key(vector("force", dim::force, "global axes").optional(), &Load::force)
          .key(vector("moment", dim::moment, "global axes").optional(), &Load::moment)
          .part(load_history(), &Load::history)
          .at_least_one_of({"force", "moment"})
          .then(require_ramps);
  return load;
}

}  // namespace

std::unique_ptr<const ElementTable> load_element() {
  return on_bodies<Load>("load", binding(), [](const std::vector<OnBody<Load>>& all, const Site& site) {
    std::vector<dynamics::ConstantLoad> out;
    for (const auto& [name, body, load] : all)
      out.push_back({site.point(body, load.at), load.force, load.moment, load.history});
    return std::make_unique<dynamics::ConstantLoadKind>(std::move(out));
  });
}

}  // namespace froude::scene
