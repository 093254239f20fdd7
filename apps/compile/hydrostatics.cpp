#include "compile/hydrostatics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compile/computed.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"

namespace froude::compile {

using hydro::InputError;
using hydro::potential::Coefficients;
using scene::Hydrodynamics;
using scene::Scene;

namespace {

/// Moment of buoyancy about the centre of gravity at rest, of a body on joints; one that floats by itself has none.
Eigen::Vector3d moment_of_buoyancy(const Scene& scene, int body, const hydro::potential::BodyData& facts) {
  if (!is_jointed(scene, body) || !facts.displaced_volume || !facts.centre_of_buoyancy) return Eigen::Vector3d::Zero();
  const scene::Body& b = scene.bodies[static_cast<std::size_t>(body)];
  const double buoyancy = scene.water.density * scene.water.gravity * *facts.displaced_volume;
  return (*facts.centre_of_buoyancy - b.position - b.centre_of_gravity).cross(buoyancy * Eigen::Vector3d::UnitZ());
}

/// Still water holds heave, roll and pitch; of what a body that is out of balance feels as it yaws, entries 4,6 and 5,6
/// of C, moment_of_buoyancy() or what balances it takes care. \throws InputError for stiffness of other modes
void require_hydrostatic(const Scene& scene, int body, const dynamics::Matrix6& C) {
  constexpr double rounding = 1e-4;  // of what a program's panels leave
  const double heave = std::abs(C(2, 2)), tilt = std::max(std::abs(C(3, 3)), std::abs(C(4, 4)));
  const double scale[6] = {heave, heave, heave, tilt, tilt, tilt};
  for (const Eigen::Index mode : {0, 1, 5})
    for (Eigen::Index other = 0; other < 6; ++other) {
      const bool of_yaw = mode == 5 && (other == 3 || other == 4);
      const double largest = std::max(std::abs(C(mode, other)), std::abs(C(other, mode)));
      if (of_yaw || largest <= rounding * std::sqrt(scale[mode] * scale[other])) continue;
      throw InputError(
          fmt::format("the restoring matrix of \"{}\" has {:.4g} between {} and {}, where still water has no stiffness",
                      scene.bodies[static_cast<std::size_t>(body)].name, largest,
                      hydro::mode_names[static_cast<std::size_t>(mode)],
                      hydro::mode_names[static_cast<std::size_t>(other)]),
          hydrodynamics_of(scene, body).file.place,
          "take the moorings out of that matrix, and give them as a [[mooring]]");
    }
}

/// How far gravity acts beside buoyancy, which a linear matrix takes to be in balance.
void note_out_of_balance(const Scene& scene, int body, const hydro::potential::BodyData& facts,
                         std::vector<std::string>& notes) {
  if (is_jointed(scene, body) || !facts.centre_of_buoyancy || !facts.displaced_volume) return;
  const scene::Body& b = scene.bodies[static_cast<std::size_t>(body)];
  const Eigen::Vector2d beside = (b.position + b.centre_of_gravity - *facts.centre_of_buoyancy).head<2>();
  constexpr double seen = 1e-3;  // of the cube root of the volume
  if (beside.norm() <= seen * std::cbrt(*facts.displaced_volume)) return;
  notes.push_back(fmt::format(
      "{}: its centre of gravity is {:.4g} m beside the vertical through its centre of buoyancy, a moment of "
      "{:.4g} N m: a linear restoring matrix takes them to be in balance",
      b.name, beside.norm(), beside.norm() * b.mass * scene.water.gravity));
}

}  // namespace

hydro::potential::Matrix6 gravity_restoring(double weight, const Eigen::Vector3d& c) {
  hydro::potential::Matrix6 G = hydro::potential::Matrix6::Zero();
  G(3, 3) = G(4, 4) = -weight * c.z();
  G(3, 5) = weight * c.x();
  G(4, 5) = weight * c.y();
  return G;
}

bool is_jointed(const Scene& scene, int body) {
  return std::any_of(scene.joints.begin(), scene.joints.end(),
                     [&](const scene::Joint& j) { return j.first == body || j.second == body; });
}

double lift(const Scene& scene, int body, const hydro::potential::BodyData& facts) {
  if (!is_jointed(scene, body)) return 0;
  const scene::Body& b = scene.bodies[static_cast<std::size_t>(body)];
  if (!facts.displaced_volume)
    throw InputError(
        fmt::format("body \"{}\" is on joints, which carry what its buoyancy and weight differ by, and the "
                    "data do not say what it displaces",
                    b.name),
        b.hydrodynamics->file.place,
        "add displaced_volume = \"28 m^3\" and centre_of_buoyancy = \"(0, 0, -1) m\" to "
        "[body.hydrodynamics]");
  return scene.water.gravity * (scene.water.density * *facts.displaced_volume - b.mass);
}

void add_hydrostatics(const Scene& scene, const Coefficients& about_centres, const std::vector<int>& bodies,
                      Prepared& prepared) {
  const Hydrodynamics& h = hydrodynamics_of(scene, bodies.front());
  if (!h.hydrostatics) return;
  if (!about_centres.C)
    throw InputError("hydrostatics are asked for, but the data have no restoring matrix", h.file.place,
                     "put the .hst file beside the .1 file, or leave out `hydrostatics`");
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto row = 6 * static_cast<Eigen::Index>(i);
    const dynamics::Matrix6 C = about_centres.C->block<6, 6>(row, row);
    require_hydrostatic(scene, bodies[i], C);
    note_out_of_balance(scene, bodies[i], about_centres.body[i], prepared.notes);
    prepared.hydrostatics.push_back({.body = bodies[i],
                                     .stiffness = hydro::dense::symmetric_part(C.block<3, 3>(2, 2).eval()),
                                     .lift = lift(scene, bodies[i], about_centres.body[i]),
                                     .moment = moment_of_buoyancy(scene, bodies[i], about_centres.body[i]).head<2>()});
  }
}

}  // namespace froude::compile
