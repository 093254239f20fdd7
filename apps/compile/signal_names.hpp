#pragma once
/// \file  Private: words and units of signals, which runs and linear responses share.
#include <string>

#include "compile/compile.hpp"
#include "hydro/base/types.hpp"

namespace froude::compile {

inline const char* motion_unit(int mode) { return mode < 3 ? "m" : "rad"; }
inline const char* load_unit(int mode) { return mode < 3 ? "N" : "N m"; }
inline std::string mode_name(int mode) { return std::string(hydro::mode_names[static_cast<std::size_t>(mode)]); }
inline const char* joint_load(int component) {
  constexpr const char* names[] = {"force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z"};
  return names[component];
}

/// Calls f(joint, end, "hinge.top") for each body of each joint.
template <class Do>
void for_each_end(const Prepared& p, Do act) {
  for (std::size_t j = 0; j < p.joints.size(); ++j)
    for (const auto end : {dynamics::End::first, dynamics::End::second}) {
      const std::optional<int> body = end == dynamics::End::first ? p.joints[j].first : p.joints[j].second;
      if (body)
        act(static_cast<int>(j), end, p.joints[j].name + "." + p.bodies[static_cast<std::size_t>(*body)].name());
    }
}

}  // namespace froude::compile
