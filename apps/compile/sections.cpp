#include "compile/sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "compile/fastened.hpp"
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

constexpr std::array<const char*, 6> components_of_load{"force_x",  "force_y",  "force_z",
                                                        "moment_x", "moment_y", "moment_z"};

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
  FastenedToPart fastened;
};

SectionalLoad sectional_load(const Scene& scene, const Prepared& prepared, const dynamics::Model& model,
                             const PreparedSection& at) {
  const scene::Body& body = body_of(scene, at.body);
  const Section& section = body.sections[at.section];
  SectionalLoad out{at, to_section(body, section), inertia_of(body, section), dynamics::Matrix6::Zero(),
                    FastenedToPart(scene, prepared, model, at.body, section)};
  const auto own = static_cast<std::size_t>(std::find(at.bodies.begin(), at.bodies.end(), at.body) - at.bodies.begin());
  const bool floats = body.hydrodynamics->hydrostatics || body.buoyancy;
  if (floats) out.by_motion += out.shift * at.table->coefficients().C->block<6, 6>(at.row, at.columns[own]);
  if (body.hydrodynamics->hydrostatics || body.weight) out.by_motion -= weight_of(section, scene.water.gravity);
  return out;
}

/// By what is fastened to the part; all six, which the first of the signals that asks makes.
const std::vector<dynamics::Variation>& less_fastened(const SectionalLoad& load, const dynamics::Still& still) {
  return still.once(&load, [&] { return product(-load.shift, load.fastened.variations(still)); });
}

using SharedLoad = std::shared_ptr<const SectionalLoad>;

dynamics::Variation variation_of(const SharedLoad& shared, Index component, const dynamics::Still& still) {
  const SectionalLoad& load = *shared;
  dynamics::Variation out = less_fastened(load, still)[static_cast<std::size_t>(component)];
  out.parts.push_back({.body = load.at.body,
                       .by_motion = load.by_motion.row(component),
                       .by_acceleration = load.by_acceleration.row(component)});
  if (load.at.excitation)
    out.by_wave = [shared, component](double omega, double heading) -> std::complex<double> {
      const Eigen::VectorXcd X = shared->at.table->excitation(omega, heading);
      return -(shared->shift.row(component) * X.segment<6>(shared->at.row))(0);
    };
  if (!load.at.radiation) return out;
  out.by_radiation = {load.at.bodies, [shared, component](double omega) -> Eigen::RowVectorXcd {
                        const PreparedSection& at = shared->at;
                        const Eigen::MatrixXd A = at.table->added_mass(omega), B = at.table->damping(omega);
                        Eigen::RowVectorXcd row(6 * static_cast<Index>(at.columns.size()));
                        for (std::size_t b = 0; b < at.columns.size(); ++b) {
                          const auto of = [&](const Eigen::MatrixXd& M) -> Eigen::RowVectorXd {
                            return shared->shift.row(component) * M.block<6, 6>(at.row, at.columns[b]);
                          };
                          row.segment<6>(6 * static_cast<Index>(b)).real() = -omega * omega * of(A);
                          row.segment<6>(6 * static_cast<Index>(b)).imag() = omega * of(B);
                        }
                        return row;
                      }};
  return out;
}

std::string name_of(const Scene& scene, const PreparedSection& at) {
  const scene::Body& body = body_of(scene, at.body);
  return body.name + "." + body.sections[at.section].name;
}

void add_one_section(const Scene& scene, const SharedLoad& load, std::vector<Signal>& out) {
  const scene::Body& body = body_of(scene, load->at.body);
  const std::string name = name_of(scene, load->at);
  for (Index i = 0; i < 6; ++i) {
    const char* what = components_of_load[static_cast<std::size_t>(i)];
    out.push_back({fmt::format("{}.{}", name, what),
                   dynamics::load_unit(static_cast<int>(i)),
                   fmt::format("{} of section {} on the part that it describes, along axes of {}{}", what, name,
                               body.name, i < 3 ? "" : ", about its point"),
                   {},
                   [load, i](const dynamics::Still& still) { return variation_of(load, i, still); }});
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
      require_hydrostatics_of_mesh(scene, b, body_of(scene, b).sections[s]);
      const auto& group = group_of(prepared, b);
      PreparedSection one{
          b, s, table, row, group.bodies, {}, group.radiation, group.excitation, origins(scene, meshes)};
      for (const int other : group.bodies)
        one.columns.push_back(6 * (std::find(meshes.begin(), meshes.end(), other) - meshes.begin()));
      prepared.sections.push_back(std::move(one));
    }
}

void add_section_signals(const Scene& scene, const Prepared& prepared, const dynamics::Model& model,
                         std::vector<Signal>& out) {
  for (const PreparedSection& at : prepared.sections)
    add_one_section(scene, std::make_shared<const SectionalLoad>(sectional_load(scene, prepared, model, at)), out);
}

namespace {

/// The hull, and a section of it, where the body has them. Loads are about its centre of gravity.
hydro::panels::HullBody hull_at(const Scene& scene, int body, const dynamics::Pose& pose) {
  hydro::panels::HullBody out = hull_of(scene, body);
  const Vector3d centre = out.reference_point;
  // As it is placed it is as it is drawn, to the last digit: corners at the waterline stay there.
  if (pose.centre == centre && pose.attitude.coeffs() == Eigen::Quaterniond::Identity().coeffs()) return out;
  const Eigen::Matrix3d turn = pose.attitude.toRotationMatrix();
  const auto moved = [&](const Vector3d& p) { return Vector3d(pose.centre + turn * (p - centre)); };
  hydro::hydrostatics::TriangleMesh mesh{out.hull.source(), out.hull.vertices(), out.hull.triangles()};
  for (Vector3d& v : mesh.vertices) v = moved(v);
  out.hull = hydro::hydrostatics::Hull(std::move(mesh));
  out.reference_point = pose.centre;
  for (hydro::panels::HullSection& section : out.sections) {
    section.at = moved(section.at);
    section.normal = turn * section.normal;
  }
  return out;
}

/// Still water, weight and what is fastened, on the part, about the centre of gravity of the body along its axes.
/// (D173)
dynamics::Vector6 load_at_rest(const Scene& scene, const SectionalLoad& load, const dynamics::Still& still) {
  const scene::Body& body = body_of(scene, load.at.body);
  const Section& section = body.sections[load.at.section];
  const dynamics::Pose& pose = still.state.pose[static_cast<std::size_t>(load.at.body)];
  const Eigen::Matrix3d to_body = pose.attitude.toRotationMatrix().transpose();
  dynamics::Vector6 out = load.fastened.at_rest(still);
  if (body.hydrodynamics->hydrostatics || body.buoyancy) {
    const hydro::panels::HullBody hull = hull_at(scene, load.at.body, pose);
    const auto water = hydro::panels::still_water_load(hull, hull.sections[load.at.section], scene.water);
    out.head<3>() += to_body * water.head<3>();
    out.tail<3>() += to_body * water.tail<3>();
  }
  if (body.hydrodynamics->hydrostatics || body.weight) {
    const Vector3d weight = -section.mass * scene.water.gravity * to_body.col(2);
    out.head<3>() += weight;
    out.tail<3>() += (section.centre_of_gravity - body.centre_of_gravity).cross(weight);
  }
  return out;
}

/// Weight and water cancel: of what is left the digits that are rounding of them say nothing.
dynamics::Vector6 without_rounding(dynamics::Vector6 load, const Section& section, double gravity) {
  const double force = 1e-12 * section.mass * gravity;
  const double moment = force * (section.centre_of_gravity - section.at).norm();
  for (Eigen::Index i = 0; i < 6; ++i)
    if (const double last = i < 3 ? force : moment; last > 0) load[i] = std::round(load[i] / last) * last + 0.0;
  return load;
}

std::array<double, 3> three(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

std::vector<SectionAtRest> sections_at_rest(const Scene& scene, const Prepared& prepared,
                                            const dynamics::frequency::SmallMotions& about) {
  const dynamics::Still still(about.still, about.linear.multipliers);
  std::vector<SectionAtRest> out;
  for (const PreparedSection& at : prepared.sections) {
    const Section& section = body_of(scene, at.body).sections[at.section];
    const SectionalLoad load = sectional_load(scene, prepared, about.model, at);
    const dynamics::Vector6 held =
        without_rounding(-load.shift * load_at_rest(scene, load, still), section, scene.water.gravity);
    out.push_back({name_of(scene, at), three(section.at), three(section.normal), {}});
    std::copy(held.begin(), held.end(), out.back().load.begin());
  }
  return out;
}

const Section* section_of_signal(const Scene& scene, const std::string& signal) {
  for (const scene::Body& body : scene.bodies)
    for (const Section& section : body.sections)
      for (const char* component : components_of_load)
        if (signal == fmt::format("{}.{}.{}", body.name, section.name, component)) return &section;
  return nullptr;
}

std::vector<Prepared> doubted(const Scene& scene, const Prepared& prepared) {
  std::vector<Prepared> out;
  if (prepared.sections.empty()) return out;
  for (const std::shared_ptr<Kept>& kept : kept_doubted(scene, *prepared.kept)) out.push_back(prepare(scene, kept));
  return out;
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
