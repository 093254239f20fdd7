#include "compile/compile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compile/hydrodynamics.hpp"
#include "dynamics/force/wave_loads.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "hydro/radiation/kernel.hpp"
#include "hydro/radiation/tail.hpp"
#include "hydro/waves/kinematics.hpp"

namespace froude::compile {
namespace {

using dynamics::Matrix6;
using dynamics::Vec3;
using hydro::InputError;
using scene::Scene;

dynamics::RigidBody rigid_body(const scene::Body& b) {
  try {
    return dynamics::RigidBody({.name = b.name,
                                .mass = b.mass,
                                .inertia = b.inertia,
                                .rest_position = {b.position},
                                .centre_of_gravity = {b.centre_of_gravity},
                                .free = b.free});
  } catch (const InputError& e) {
    throw e.at(b.place);
  }
}

/// The arm from a body's centre of gravity, or the point itself for the ground.
Eigen::Vector3d arm(const Scene& scene, std::optional<int> body, const Eigen::Vector3d& end) {
  return body ? Eigen::Vector3d(end - scene.bodies[static_cast<std::size_t>(*body)].centre_of_gravity) : end;
}

Eigen::Vector3d placed(const Scene& scene, std::optional<int> body, const Eigen::Vector3d& end) {
  return body ? Eigen::Vector3d(scene.bodies[static_cast<std::size_t>(*body)].position + end) : end;
}

void add_connector(const Scene& scene, const scene::Connector& c, Prepared& out) {
  const dynamics::Ends ends{c.first, c.second, arm(scene, c.first, c.first_end), arm(scene, c.second, c.second_end)};
  const Eigen::Vector3d offset = placed(scene, c.second, c.second_end) - placed(scene, c.first, c.first_end);
  if (const auto* axial = std::get_if<scene::AxialConnector>(&c.kind)) {
    if (offset.norm() < 1e-9)
      throw InputError(fmt::format("the ends of \"{}\" coincide, so it has no direction to act along", c.name), c.place,
                       "move an end, or use kind = \"bushing\"");
    out.axial.push_back({ends, axial->stiffness, axial->damping, axial->rest_length.value_or(offset.norm())});
    out.axial_names.push_back(c.name);
    return;
  }
  const auto& b = std::get<scene::BushingConnector>(c.kind);
  out.bushing.push_back({ends, b.stiffness, b.damping, b.rotational_stiffness, b.rotational_damping, offset});
  out.bushing_names.push_back(c.name);
}

void add_mooring(const Scene& scene, const scene::Mooring& m, Prepared& out) {
  // Given about the body's origin; the origin seen from the centre of gravity is −c.
  const Matrix6 T = dynamics::shift_from_centre(-scene.bodies[static_cast<std::size_t>(m.body)].centre_of_gravity);
  out.moorings.push_back(
      {.body = m.body, .stiffness = T.transpose() * m.stiffness * T, .damping = T.transpose() * m.damping * T});
  out.mooring_names.push_back(m.name);
}

/// Springs and dampers, in the order in which a plan lists them.
void add_springs(const Prepared& p, std::vector<std::unique_ptr<const dynamics::ForceKind>>& forces) {
  if (!p.hydrostatics.empty())
    forces.push_back(std::make_unique<dynamics::RestoringKind>("hydrostatics", p.bodies, p.hydrostatics));
  if (!p.moorings.empty()) forces.push_back(std::make_unique<dynamics::RestoringKind>("mooring", p.bodies, p.moorings));
  if (!p.axial.empty()) forces.push_back(std::make_unique<dynamics::AxialConnectorKind>(p.axial));
  if (!p.bushing.empty()) forces.push_back(std::make_unique<dynamics::BushingConnectorKind>(p.bushing));
}

}  // namespace

Prepared prepare(const Scene& scene) {
  Prepared out;
  for (const auto& b : scene.bodies) out.bodies.push_back(rigid_body(b));
  add_hydrodynamics(scene, out);
  for (const auto& m : scene.moorings) add_mooring(scene, m, out);
  for (const auto& c : scene.connectors) add_connector(scene, c, out);
  return out;
}

dynamics::Model frequency_model(const Prepared& prepared) {
  std::vector<std::unique_ptr<const dynamics::ForceKind>> forces;
  add_springs(prepared, forces);
  dynamics::Model model(prepared.bodies, {}, std::move(forces));
  const Eigen::VectorXd load = model.load_at_rest();
  double weight = 0;
  for (const auto& b : prepared.bodies) weight += b.mass() * 9.81;
  Eigen::Index worst = 0;
  // Pretension that does not cancel would shift the rest position about which everything is linearised.
  if (load.size() > 0 && load.cwiseAbs().maxCoeff(&worst) > 1e-6 * weight)
    throw InputError(fmt::format("the scene is not in equilibrium as placed: {} feels {:.4g} {}",
                                 model.mode_name(static_cast<int>(worst)), load[worst], worst % 6 < 3 ? "N" : "N m"),
                     {}, "give connectors rest_length = \"as placed\", or place the bodies where they balance");
  return model;
}

namespace {

/// Radiation of one group: its added mass at infinite frequency and its memory.
struct RadiationParts {
  dynamics::AddedMass added_mass;
  dynamics::RadiationMemory memory;
  PlanLine line;
};

/// The free modes of a group: their numbers in the model, and in the group's matrices.
struct FreeModes {
  std::vector<int> in_model, in_group;
};

FreeModes free_modes(const Prepared& p, const std::vector<int>& bodies) {
  FreeModes out;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (int mode = 0; mode < 6; ++mode)
      if (p.bodies[static_cast<std::size_t>(bodies[b])].is_free(mode)) {
        out.in_model.push_back(6 * bodies[b] + mode);
        out.in_group.push_back(6 * static_cast<int>(b) + mode);
      }
  return out;
}

RadiationParts radiation(const Prepared& prepared, const dynamics::frequency::PotentialGroup& g, double tolerance,
                         std::optional<double> fixed_length, double step, std::vector<std::string>& notes) {
  const auto& c = g.table.coefficients();
  const FreeModes modes = free_modes(prepared, g.bodies);
  // A and B of linear theory are symmetric. Panel codes miss that by their discretisation error, which in a run would
  // be energy from nowhere; the frequency domain, which has no ledger to close, takes the data as they are.
  double asymmetry = 0;
  const auto symmetric = [&](const Eigen::MatrixXd& m) {
    const double largest = m.cwiseAbs().maxCoeff();
    if (largest > 0) asymmetry = std::max(asymmetry, (m - m.transpose()).cwiseAbs().maxCoeff() / largest);
    return Eigen::MatrixXd((m + m.transpose()) / 2);
  };
  hydro::radiation::DampingTable damping{c.omega, {}};
  for (const auto& B : c.B) damping.B.push_back(symmetric(B(modes.in_group, modes.in_group)));
  std::vector<Eigen::MatrixXd> A;
  for (const auto& a : c.A) A.push_back(symmetric(a(modes.in_group, modes.in_group)));
  std::optional<Eigen::MatrixXd> A_inf_in_file;
  if (c.A_inf) A_inf_in_file = symmetric((*c.A_inf)(modes.in_group, modes.in_group));
  // Waves beyond the table act as added mass on slower motions; without them a run differs from the frequency domain
  // (R10), (R11).
  const auto complete = hydro::radiation::continued(damping, A, A_inf_in_file);
  notes.push_back(
      fmt::format("{}: damping continued beyond {:.4g} rad/s so that it belongs to the added mass, which is left off "
                  "by {:.2g} (rms, worst pair); A(inf) moved by {:.2g}{}",
                  c.source, c.omega.back(), complete.misfit, complete.shift,
                  c.A_inf ? "" : "; added mass at infinite frequency, which the data lack, found with it"));
  Eigen::MatrixXd A_inf = Eigen::MatrixXd::Zero(c.modes(), c.modes());
  A_inf(modes.in_group, modes.in_group) = complete.A_inf;
  const double longest = hydro::radiation::RetardationKernel::longest_time(complete.table);
  const double length = std::min(fixed_length.value_or(hydro::radiation::memory_length(complete.table, tolerance)),
                                 fixed_length ? *fixed_length : longest);
  auto kernel = hydro::radiation::RetardationKernel::from_damping(complete.table, {step, std::max(length, 2 * step)});
  if (kernel.truncation() > tolerance)
    notes.push_back(
        fmt::format("{}: the memory of {:.4g} s leaves out up to {:.2g} of the radiation damping (tolerance {:.2g}){}",
                    c.source, kernel.length(), kernel.truncation(), tolerance,
                    fixed_length ? "" : "; the frequencies of the data are too far apart to tell more"));
  if (asymmetry > 1e-9)
    notes.push_back(fmt::format(
        "{}: added mass and damping made symmetric for the run; they were off by up to {:.2g} of the largest entry",
        c.source, asymmetry));
  if (kernel.negative_share() > 1e-3)
    notes.push_back(fmt::format(
        "{}: radiation damping is negative somewhere, by up to {:.2g} of its mode's largest; taken as it is", c.source,
        kernel.negative_share()));
  PlanLine line{"radiation", "",
                fmt::format("{} modes, {} lags, left out up to {:.2g} of the damping", kernel.modes(), kernel.samples(),
                            kernel.truncation()),
                true};
  dynamics::RadiationMemory memory{modes.in_model, hydro::radiation::DirectConvolution(kernel)};
  return {{g.bodies, A_inf}, std::move(memory), std::move(line)};
}

/// Complex amplitudes, one row a signal, and their table on the step grid.
dynamics::WaveSignals signals(const hydro::waves::Sea& sea, const Eigen::MatrixXcd& amplitudes, double step,
                              std::size_t samples, double ramp) {
  Eigen::MatrixXd table(amplitudes.rows(), static_cast<Eigen::Index>(samples));
  std::vector<std::complex<double>> row(static_cast<std::size_t>(amplitudes.cols()));
  for (Eigen::Index r = 0; r < amplitudes.rows(); ++r) {
    for (std::size_t c = 0; c < row.size(); ++c) row[c] = amplitudes(r, static_cast<Eigen::Index>(c));
    const auto series = hydro::waves::synthesise(sea, {step, samples}, row);
    table.row(r) = Eigen::Map<const Eigen::RowVectorXd>(series.data(), static_cast<Eigen::Index>(series.size()));
  }
  std::vector<double> omega;
  for (const auto& c : sea.components()) omega.push_back(c.omega);
  return {std::move(omega), amplitudes, std::move(table), step, ramp};
}

std::complex<double> elevation_at_origin(const hydro::waves::Component& c) { return std::polar(c.amplitude, c.phase); }

std::unique_ptr<const dynamics::ForceKind> excitation(const Prepared& p, const hydro::waves::Sea& sea, double step,
                                                      std::size_t samples, double ramp) {
  std::vector<dynamics::Excitation> elements;
  for (const auto& g : p.groups) {
    if (!g.excitation) continue;
    Eigen::MatrixXcd amplitudes(6 * static_cast<Eigen::Index>(g.bodies.size()),
                                static_cast<Eigen::Index>(sea.components().size()));
    Eigen::Index column = 0;
    for (const auto& c : sea.components())
      amplitudes.col(column++) = elevation_at_origin(c) * g.table.excitation(c.omega, c.heading);
    elements.push_back({g.bodies, signals(sea, amplitudes, step, samples, ramp)});
  }
  if (elements.empty()) return nullptr;
  return std::make_unique<dynamics::ExcitationKind>(std::move(elements));
}

std::unique_ptr<const dynamics::ForceKind> drag(const Scene& scene, const Prepared& p, const hydro::waves::Sea* sea,
                                                double step, std::size_t samples) {
  std::vector<dynamics::DragPiece> pieces;
  for (const auto& m : scene.members) {
    const auto wet = dynamics::drag_pieces(p.bodies, m.body, m.from, m.to, m.diameter, m.cd, scene.water.density);
    if (wet.empty())
      throw InputError(fmt::format("member \"{}\" is above the water at rest and feels no drag", m.name), m.place,
                       "put it under water, or leave it out");
    pieces.insert(pieces.end(), wet.begin(), wet.end());
  }
  if (pieces.empty()) return nullptr;
  std::optional<dynamics::WaveSignals> water;
  if (sea) {
    Eigen::MatrixXcd amplitudes(3 * static_cast<Eigen::Index>(pieces.size()),
                                static_cast<Eigen::Index>(sea->components().size()));
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const Eigen::Vector3d at = dynamics::rest_position(pieces[i], p.bodies);
      Eigen::Index column = 0;
      for (const auto& c : sea->components())
        amplitudes.block<3, 1>(3 * static_cast<Eigen::Index>(i), column++) =
            elevation_at_origin(c) * hydro::waves::velocity_transfer(c, sea->water(), at);
    }
    water = signals(*sea, amplitudes, step, samples, scene.waves->ramp);
  }
  return std::make_unique<dynamics::DragKind>(std::move(pieces), std::move(water));
}

/// The step that keeps the period error of generalised-α, (ωh)²/12, a sixteenth of the accuracy asked at the highest
/// relevant frequency, and divides the distance of samples.
double chosen_step(const Scene& scene) {
  const double every = scene.run->every;
  if (scene.solve.step) {
    const double ratio = every / scene.solve.step->value;
    if (std::abs(ratio - std::round(ratio)) > 1e-9 * ratio || ratio < 1 - 1e-9)
      throw InputError(
          fmt::format("a step of {} s does not divide the distance of samples, {} s", scene.solve.step->value, every),
          scene.solve.step->place, fmt::format("use \"{:.6g} s\"", every / std::max(1.0, std::ceil(ratio))));
    return every / std::round(ratio);
  }
  const double omega = scene.waves ? highest_relevant_frequency(*scene.waves) : 0;
  const double largest = omega > 0 ? std::sqrt(12 * scene.accuracy) / 4 / omega : every;
  return every / std::max(1.0, std::ceil(every / largest - 1e-9));
}

dynamics::State start_state(const Scene& scene, const Prepared& p) {
  dynamics::State state = dynamics::rest_state(p.bodies);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const auto& b = scene.bodies[i];
    Eigen::Matrix<double, 6, 1> moved = Eigen::Matrix<double, 6, 1>::Zero(), velocity = moved;
    for (const auto& [mode, value] : b.initial) moved[static_cast<int>(mode)] = value;
    for (const auto& [mode, value] : b.initial_velocity) velocity[static_cast<int>(mode)] = value;
    auto& pose = state.pose[i];
    pose.attitude = dynamics::rotation_exp(moved.tail<3>());
    const Eigen::Vector3d to_centre = pose.attitude * b.centre_of_gravity;
    pose.centre = b.position + moved.head<3>() + to_centre;
    velocity.head<3>() += velocity.tail<3>().cross(to_centre);
    state.velocity.segment<6>(6 * static_cast<Eigen::Index>(i)) = velocity;
  }
  return state;
}

}  // namespace

TimeModel time_model(const Scene& scene, const Prepared& prepared) {
  const double step = chosen_step(scene);
  const auto per_sample = static_cast<std::size_t>(std::llround(scene.run->every / step));
  const auto steps = static_cast<std::size_t>(std::llround(scene.run->duration / scene.run->every)) * per_sample;
  std::vector<std::string> notes = prepared.notes;
  std::vector<PlanLine> plan;
  std::optional<hydro::waves::Sea> sea;
  const bool wants_sea = scene.waves.has_value();
  // An even number of steps, so that the sea repeats after the run and its inverse FFT is a plain one.
  const std::size_t repetition_steps = steps + steps % 2;
  if (wants_sea) {
    sea = make_sea(scene, prepared, static_cast<double>(repetition_steps) * step);
    plan.push_back({"waves",
                    sea->components().size() == 1 ? "one regular wave" : "random phases, fixed amplitudes, inverse FFT",
                    fmt::format("{} components, {:.2g} of the energy left out", sea->components().size(),
                                sea->fraction_left_out()),
                    true});
  }

  std::vector<std::unique_ptr<const dynamics::ForceKind>> forces;
  std::vector<dynamics::AddedMass> added_mass;
  add_springs(prepared, forces);
  std::vector<dynamics::RadiationMemory> memories;
  std::vector<PlanLine> memory_lines;
  for (std::size_t i = 0; i < prepared.groups.size(); ++i) {
    if (!prepared.groups[i].radiation) continue;
    auto parts =
        radiation(prepared, prepared.groups[i], prepared.memory_tolerance[i], prepared.memory_length[i], step, notes);
    added_mass.push_back(std::move(parts.added_mass));
    memories.push_back(std::move(parts.memory));
    memory_lines.push_back(std::move(parts.line));
  }
  if (!memories.empty()) forces.push_back(std::make_unique<dynamics::RadiationKind>(std::move(memories)));
  if (sea)
    if (auto kind = excitation(prepared, *sea, step, steps + 1, scene.waves->ramp)) forces.push_back(std::move(kind));
  if (auto kind = drag(scene, prepared, sea ? &*sea : nullptr, step, steps + 1)) forces.push_back(std::move(kind));

  for (const auto& kind : forces) {
    if (kind->effect() != "radiation") {
      plan.push_back({kind->effect(), kind->method(),
                      fmt::format("{} element{}", kind->elements(), kind->elements() == 1 ? "" : "s"), true});
      continue;
    }
    for (PlanLine line : memory_lines) {
      line.method = kind->method();
      plan.push_back(std::move(line));
    }
  }
  dynamics::Model model(prepared.bodies, std::move(added_mass), std::move(forces));
  return {std::move(model), start_state(scene, prepared), std::move(sea), step, steps, per_sample, std::move(plan),
          std::move(notes)};
}

}  // namespace froude::compile
