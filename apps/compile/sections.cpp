#include "compile/sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "compile/hulls.hpp"
#include "compile/kept.hpp"
#include "dynamics/joint/joint.hpp"
#include "hydro/potential/operations/operations.hpp"

namespace froude::compile {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using hydro::InputError;
using hydro::potential::Coefficients;
using scene::Scene;
using scene::Section;

const scene::Body& body_of(const Scene& scene, int body) { return scene.bodies[static_cast<std::size_t>(body)]; }

/// Motions and loads of all bodies, and loads on parts, about the bodies' centres of gravity.
Coefficients about_centres(const Scene& scene, const std::vector<int>& bodies, const Coefficients& parts) {
  std::vector<Vector3d> from, to;
  const auto add = [&](int b) {
    from.push_back(body_of(scene, b).position);
    to.push_back(body_of(scene, b).position + body_of(scene, b).centre_of_gravity);
  };
  for (const int b : bodies) add(b);
  for (const int b : bodies)
    for (std::size_t s = 0; s < body_of(scene, b).sections.size(); ++s) add(b);
  return hydro::potential::about(parts, from, to);
}

/// Where the phase of the wave's way is taken out: at the bodies, for their parts too.
std::vector<Vector3d> origins(const Scene& scene, const std::vector<int>& bodies) {
  std::vector<Vector3d> out;
  for (const int b : bodies) out.push_back(body_of(scene, b).position);
  for (const int b : bodies) out.insert(out.end(), body_of(scene, b).sections.size(), body_of(scene, b).position);
  return out;
}

// ---- what acts on the part

/// What is fixed to a body at a point, body axes.
struct Attached {
  int body;
  Vector3d at;
  std::string name;
};

void add_pair(const scene::PointPair& pair, std::vector<Attached>& out) {
  out.push_back({pair.first, pair.first_end, pair.name});
  if (pair.second) out.push_back({*pair.second, pair.second_end, pair.name});
}

/// All that loads bodies at points. Matrices of moorings and elements of one body act at its origin.
std::vector<Attached> attached(const Scene& scene) {
  std::vector<Attached> out;
  for (const scene::Connector& c : scene.connectors) add_pair(c, out);
  for (const scene::Joint& j : scene.joints)
    for (const std::optional<int>& body : {j.first, j.second})
      if (body) out.push_back({*body, j.at - body_of(scene, *body).position, j.name});
  for (const scene::CatenaryLine& line : scene.catenaries) out.push_back({line.body, line.fairlead, line.name});
  for (const dynamics::Restoring& mooring : scene.moorings)
    out.push_back({mooring.body, Vector3d::Zero(), "[[mooring]]"});
  for (const scene::Line& line : scene.lines)
    for (const scene::Line::End* end : {&line.from, &line.to})
      if (end->body && end->at) out.push_back({*end->body, *end->at, line.name});
  for (const scene::Member& member : scene.members)
    for (const Vector3d& at : {member.from, member.to}) out.push_back({member.body, at, member.name});
  for (const auto& elements : scene.elements)
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
      out.push_back({static_cast<int>(b), Vector3d::Zero(), "[[" + elements->table() + "]]"});
  return out;
}

/// The loads of what acts on the other part are not asked for: what holds the part carries them.
void require_on_other_part(const Scene& scene, int body, const Section& section) {
  for (const Attached& a : attached(scene)) {
    if (a.body != body || section.normal.dot(a.at - section.at) < 0) continue;
    throw InputError(
        fmt::format("{} acts on the part of \"{}\" that section \"{}\" describes, at ({:.4g}, {:.4g}, {:.4g}) m; its "
                    "load there has no share in sectional loads",
                    a.name, body_of(scene, body).name, section.name, a.at.x(), a.at.y(), a.at.z()),
        section.place, "describe the other part: turn `normal` round, and give mass and centre_of_gravity of that one");
  }
}

/// Still water must be that of the mesh.
void require_hydrostatics_of_mesh(const Scene& scene, int body, const Section& section) {
  const auto& buoyancy = body_of(scene, body).buoyancy;
  if (!buoyancy || buoyancy->of_hydrodynamics) return;
  throw InputError(fmt::format("section \"{}\" is of the mesh of [body.hydrodynamics], and \"{}\" has another hull in "
                               "still water",
                               section.name, body_of(scene, body).name),
                   section.place, "take mesh_of_hydrodynamics = true in [body.buoyancy]");
}

// ---- loads, (D160)

/// Moments about the section's point of loads about the centre of gravity of the body.
dynamics::Matrix6 to_section(const scene::Body& body, const Section& section) {
  return hydro::potential::rigid_shift(section.at - body.centre_of_gravity).transpose().inverse();
}

/// Loads that the acceleration of the body's centre of gravity asks for on the part, about the section's point.
dynamics::Matrix6 inertia_of(const scene::Body& body, const Section& section) {
  dynamics::Matrix6 own = dynamics::Matrix6::Zero();
  own.topLeftCorner<3, 3>().diagonal().setConstant(section.mass);
  own.bottomRightCorner<3, 3>() = section.inertia;
  const auto seen_from = [&](const Vector3d& point) {
    return hydro::potential::rigid_shift(section.centre_of_gravity - point);
  };
  return seen_from(section.at).transpose() * own * seen_from(body.centre_of_gravity);
}

/// By displacement: the weight of the part along axes that turn with the body, about the section's point.
dynamics::Matrix6 weight_of(const Section& section, double gravity) {
  dynamics::Matrix6 own = dynamics::Matrix6::Zero();
  own(0, 4) = section.mass * gravity;
  own(1, 3) = -section.mass * gravity;
  return hydro::potential::rigid_shift(section.centre_of_gravity - section.at).transpose() * own;
}

/// What one section's signals share.
struct SectionalLoad {
  PreparedSection at;
  dynamics::Matrix6 shift, by_acceleration, by_motion;
};

SectionalLoad sectional_load(const Scene& scene, const PreparedSection& at) {
  const scene::Body& body = body_of(scene, at.body);
  const Section& section = body.sections[at.section];
  SectionalLoad out{at, to_section(body, section), inertia_of(body, section), dynamics::Matrix6::Zero()};
  const auto own = static_cast<std::size_t>(std::find(at.bodies.begin(), at.bodies.end(), at.body) - at.bodies.begin());
  const bool floats = body.hydrodynamics->hydrostatics || body.buoyancy;
  if (floats) out.by_motion += out.shift * at.table->coefficients().C->block<6, 6>(at.row, at.columns[own]);
  if (body.hydrodynamics->hydrostatics || body.weight) out.by_motion -= weight_of(section, scene.water.gravity);
  return out;
}

dynamics::Variation variation_of(const SectionalLoad& load, Index component) {
  dynamics::Variation out;
  out.parts.push_back({.body = load.at.body,
                       .by_motion = load.by_motion.row(component),
                       .by_acceleration = load.by_acceleration.row(component)});
  if (load.at.excitation)
    out.by_wave = [load, component](double omega, double heading) -> std::complex<double> {
      const Eigen::VectorXcd X = load.at.table->excitation(omega, heading);
      return -(load.shift.row(component) * X.segment<6>(load.at.row))(0);
    };
  if (!load.at.radiation) return out;
  out.by_radiation = {load.at.bodies, [load, component](double omega) -> Eigen::RowVectorXcd {
                        const Eigen::MatrixXd A = load.at.table->added_mass(omega), B = load.at.table->damping(omega);
                        Eigen::RowVectorXcd row(6 * static_cast<Index>(load.at.columns.size()));
                        for (std::size_t b = 0; b < load.at.columns.size(); ++b) {
                          const auto of = [&](const Eigen::MatrixXd& M) -> Eigen::RowVectorXd {
                            return load.shift.row(component) * M.block<6, 6>(load.at.row, load.at.columns[b]);
                          };
                          row.segment<6>(6 * static_cast<Index>(b)).real() = -omega * omega * of(A);
                          row.segment<6>(6 * static_cast<Index>(b)).imag() = omega * of(B);
                        }
                        return row;
                      }};
  return out;
}

void add_one_section(const Scene& scene, const SectionalLoad& load, std::vector<Signal>& out) {
  constexpr std::array<const char*, 6> component{"force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z"};
  const scene::Body& body = body_of(scene, load.at.body);
  const std::string name = body.name + "." + body.sections[load.at.section].name;
  for (Index i = 0; i < 6; ++i) {
    const char* what = component[static_cast<std::size_t>(i)];
    out.push_back({fmt::format("{}.{}", name, what),
                   dynamics::load_unit(static_cast<int>(i)),
                   fmt::format("{} of section {} on the part that it describes, along axes of {}{}", what, name,
                               body.name, i < 3 ? "" : ", about its point"),
                   {},
                   [load, i](const dynamics::Still&) { return variation_of(load, i); }});
  }
}

/// The group that a body's waves act in.
const dynamics::frequency::PotentialGroup& group_of(const Prepared& prepared, int body) {
  return *std::find_if(prepared.groups.begin(), prepared.groups.end(), [&](const auto& group) {
    return std::find(group.bodies.begin(), group.bodies.end(), body) != group.bodies.end();
  });
}

}  // namespace

bool any_sections(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const auto& b) { return !b.sections.empty(); });
}

void add_sections(const Scene& scene, Prepared& prepared) {
  if (!any_sections(scene)) return;
  const std::vector<int> meshes = bodies_of_meshes(scene);
  const auto table = std::make_shared<const hydro::potential::FrequencyTable>(
      about_centres(scene, meshes, parts_of_hulls(scene, *prepared.kept)), origins(scene, meshes));
  auto row = 6 * static_cast<Index>(meshes.size());
  for (const int b : meshes)
    for (std::size_t s = 0; s < body_of(scene, b).sections.size(); ++s, row += 6) {
      require_on_other_part(scene, b, body_of(scene, b).sections[s]);
      require_hydrostatics_of_mesh(scene, b, body_of(scene, b).sections[s]);
      const auto& group = group_of(prepared, b);
      PreparedSection one{b, s, table, row, group.bodies, {}, group.radiation, group.excitation};
      for (const int other : group.bodies)
        one.columns.push_back(6 * (std::find(meshes.begin(), meshes.end(), other) - meshes.begin()));
      prepared.sections.push_back(std::move(one));
    }
}

void add_section_signals(const Scene& scene, const Prepared& prepared, std::vector<Signal>& out) {
  for (const PreparedSection& section : prepared.sections) add_one_section(scene, sectional_load(scene, section), out);
}

void require_no_sections(const Scene& scene) {
  for (const scene::Body& body : scene.bodies)
    if (!body.sections.empty())
      throw InputError(
          "sectional loads are told by `froude rao` and `froude response`, and not in runs that are stepped",
          body.sections.front().place,
          "take [[body.section]] out of the scene that is run, or give [ask.run] start = \"steady\"");
}

}  // namespace froude::compile
