/// \file  `[[load]]`: a force and a moment that stay as they are.
#include "dynamics/force/constant_load.hpp"
#include "scene/element.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

struct Load {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();      ///< body axes, m
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< global axes, N
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< N m
};

const Binding<Load>& binding() {
  static const Binding<Load> load = Binding<Load>("[[load]]", "a force and a moment that stay as they are: wind, a tow")
                                        .key(vector("at", dim::length, "where the force acts, body axes")
                                                 .or_default("(0, 0, 0) m", "the body's origin"),
                                             &Load::at)
                                        .key(vector("force", dim::force, "global axes").optional(), &Load::force)
                                        .key(vector("moment", dim::moment, "global axes").optional(), &Load::moment)
                                        .at_least_one_of({"force", "moment"});
  return load;
}

}  // namespace

std::unique_ptr<const ElementTable> load_element() {
  return on_bodies<Load>("load", binding(), [](const std::vector<OnBody<Load>>& all, const Site& site) {
    std::vector<dynamics::ConstantLoad> out;
    for (const auto& [name, body, load] : all) out.push_back({site.point(body, load.at), load.force, load.moment});
    return std::make_unique<dynamics::ConstantLoadKind>(std::move(out));
  });
}

}  // namespace froude::scene
