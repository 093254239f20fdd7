#include "dynamics/force/member_signals.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

namespace dynamics {

std::vector<Signal> member_load_signals(const ToldLoad& member, const std::string& effect, int body,
                                        const std::function<Vector6(const Reading&)>& load) {
  const auto about_origin = [load, body, centre = member.centre_of_gravity](const Reading& r) {
    Vector6 out = load(r);
    const Eigen::Vector3d arm = r.state.pose[static_cast<std::size_t>(body)].attitude * centre;
    out.tail<3>() += arm.cross(Eigen::Vector3d(out.head<3>()));
    return out;
  };
  std::vector<Signal> out;
  for (int i = 0; i < 6; ++i) {
    const char* what = i < 3 ? "force" : "moment";
    out.push_back({.name = fmt::format("{}.{}_{}_{}", member.name, effect, what, "xyz"[i % 3]),
                   .unit = load_unit(i),
                   .meaning = fmt::format("{} of {} on {}, about its body's origin, along global {}", what, effect,
                                          member.name, "xyz"[i % 3]),
                   .value = [about_origin, i](const Reading& r) { return about_origin(r)[i]; },
                   .no_variation = "loads of single members are those of a run"});
  }
  return out;
}

}  // namespace dynamics
