/// \file  The free surface about bodies in one regular wave: what they scatter, and what their motion radiates.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "answers/answers.hpp"
#include "answers/provenance.hpp"
#include "compile/compile.hpp"
#include "compile/cylinders.hpp"
#include "compile/hulls.hpp"
#include "froude/hull_pressures.hpp"
#include "hydro/base/error.hpp"
#include "hydro/waves/dispersion.hpp"

namespace froude {
namespace {

using Eigen::Index;
using hydro::InputError;
using hydro::potential::FieldQuestion, hydro::potential::WaveField;

/// Bodies whose waves are told. \throws InputError where those of others would be missing
struct WaveMakers {
  std::vector<int> cylinders, meshes;
  std::size_t count() const { return cylinders.size() + meshes.size(); }
};

WaveMakers wave_makers(const scene::Scene& scene) {
  for (const scene::Body& body : scene.bodies) {
    if (!body.hydrodynamics || !body.hydrodynamics->makes_waves()) continue;
    if (!body.hydrodynamics->cylinders && !body.hydrodynamics->mesh)
      throw InputError(
          fmt::format("[ask.field]: the waves of \"{}\" are not known, as its coefficients come from a file",
                      body.name),
          body.hydrodynamics->file.place, "give the shape that they are of: `cylinders`, or a `mesh`");
    if (scene.bodies.size() > 1 && body.hydrodynamics->interaction != scene::Interaction::full)
      throw InputError(
          fmt::format("[ask.field]: \"{}\" does not feel the waves of the other bodies, which a field has", body.name),
          body.hydrodynamics->interaction_place, "leave `interaction` out");
  }
  compile::require_still_water(scene, "fields");
  const WaveMakers out{compile::bodies_of_cylinders(scene), compile::bodies_of_meshes(scene)};
  if (out.count() == 0)
    throw InputError("[ask.field] asks for the waves about bodies, but no body has [body.hydrodynamics] of its shape",
                     scene.field->place, "add [body.hydrodynamics] with `cylinders` or a `mesh`");
  if (!out.cylinders.empty() && !out.meshes.empty())
    throw InputError("[ask.field]: bodies of cylinders and of meshes do not feel each other's waves, which a field has",
                     scene.field->place, "give all of them as meshes");
  return out;
}

Eigen::MatrixX2d grid_of(const scene::AskField& asked) {
  Eigen::MatrixX2d out(static_cast<Index>(asked.x.size() * asked.y.size()), 2);
  Index row = 0;
  for (const double y : asked.y)
    for (const double x : asked.x) out.row(row++) = Eigen::RowVector2d(x, y);
  return out;
}

/// Motions of these bodies about their origins, from those about the centres of gravity of all.
Eigen::VectorXcd about_origins(const scene::Scene& scene, const std::vector<int>& bodies, const Eigen::VectorXcd& xi) {
  Eigen::VectorXcd out(6 * static_cast<Index>(bodies.size()));
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Eigen::Vector3d& centre = scene.bodies[static_cast<std::size_t>(bodies[i])].centre_of_gravity;
    out.segment<6>(6 * static_cast<Index>(i)) =
        hydro::potential::rigid_shift(-centre).cast<std::complex<double>>() * xi.segment<6>(6 * bodies[i]);
  }
  return out;
}

/// Coefficients are solved at the very frequency of the wave, whatever table the scene has them in: what interpolation
/// misses near a resonance would be waves and power that are not there.
scene::Scene at_its_frequency(scene::Scene scene) {
  constexpr double beside = 1e-3;  // a table has more than one frequency
  const double omega = scene.field->omega;
  const auto solve_there = [&](auto& table) {
    if (!table) return;
    table->omega = {(1 - beside) * omega, omega, (1 + beside) * omega};
    table->headings.clear();
    table->frequency_tolerance.reset();
  };
  for (scene::Body& body : scene.bodies) {
    if (!body.hydrodynamics) continue;
    solve_there(body.hydrodynamics->cylinders);
    solve_there(body.hydrodynamics->mesh);
  }
  scene.waves.reset();
  scene.run.reset();
  if (scene.rao) {
    scene.rao->omega = {omega};
    scene.rao->headings = {scene.field->heading};
  }
  return scene;
}

/// Complex values of the grid; NaN where nothing is told.
ComplexSignal part(const std::string& name, const std::string& meaning, const Eigen::VectorXcd& eta,
                   const std::vector<bool>& known) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  ComplexSignal out{name, "m/m", meaning + " per metre of wave amplitude", {}};
  for (std::size_t p = 0; p < known.size(); ++p)
    out.values.push_back(known[p] ? eta(static_cast<Index>(p)) : std::complex<double>(none, none));
  return out;
}

/// What is estimated, and the key that takes more than the accuracy asked.
struct Estimated {
  const char* what;
  double estimate, accepted;
  const char *key, *remedy;
};
void require_accuracy(const scene::Scene& scene, const Estimated& of) {
  const double accepted = std::max(scene.accuracy.value, of.accepted);
  if (of.estimate <= accepted) return;
  throw InputError(fmt::format("[ask.field]: the {} is known to {:.2g} of its largest, and {:.2g} is asked for",
                               of.what, of.estimate, accepted),
                   scene.field->place, fmt::format("{}, or write {} = {:.2g}", of.remedy, of.key, 1.1 * of.estimate));
}

constexpr const char* drift_remedy = "give finer meshes, or cylinders a smaller `tolerance`";

/// Pressures of the field under the names of these bodies.
std::shared_ptr<const HullPressures> pressures(const scene::Scene& scene, const std::vector<int>& bodies,
                                               const WaveField& field) {
  if (!scene.field->pressure) return nullptr;
  require_accuracy(scene, {"pressure", field.on_hulls->estimate, scene.field->accepted_pressure_error,
                           "accepted_pressure_error", "give a finer mesh"});
  auto out = std::make_shared<HullPressures>(HullPressures{{}, *field.on_hulls});
  for (const int b : bodies) out->bodies.push_back(scene.bodies[static_cast<std::size_t>(b)].name);
  return out;
}

/// What bodies take from the waves is what damps them (P51): by how much it is missed, as a force, over the mean drift
/// or, where that is less, the momentum of the waves that they send out.
double error_by_power(const scene::Scene& scene, const hydro::potential::MeanDrift& drift, double damped) {
  const double omega = scene.field->omega;
  const double phase_velocity = omega / hydro::waves::wavenumber(omega, scene.water);
  const double size = std::max(drift.force.norm() * phase_velocity, drift.scattered);
  return size > 0 ? std::abs(drift.taken - damped) / size : 0;
}

void add_drift(const scene::Scene& scene, const WaveField& field, const std::optional<double>& damped,
               FreeSurface& out) {
  const hydro::potential::MeanDrift drift = mean_drift(field.far, scene.field->omega, scene.water);
  out.drift_x = drift.force.x();
  out.drift_y = drift.force.y();
  out.power_taken = drift.taken;
  out.power_sent_out = drift.scattered;
  if (!damped) {
    out.notes.emplace_back(
        "the error of the mean drift is not estimated: what bodies take from the waves is not known");
    return;
  }
  out.body_drift_error = error_by_power(scene, drift, *damped);
  require_accuracy(scene, {"mean drift", out.body_drift_error, scene.field->accepted_drift_error,
                           "accepted_drift_error", drift_remedy});
  out.notes.push_back(
      fmt::format("mean drift and power are known to {:.2g} of the drift: what damps the bodies takes "
                  "{:.3g} W/m^2, and they take {:.3g} from the waves",
                  out.body_drift_error, *damped, drift.taken));
}

/// Of the field under the names of these bodies; the error is added to that of all together.
void add_body_drift(const scene::Scene& scene, const std::vector<int>& bodies, const WaveField& field,
                    FreeSurface& out) {
  if (!scene.field->body_drift) return;
  out.body_drift_error += field.on_bodies->estimate;
  require_accuracy(scene, {"mean drift of bodies", out.body_drift_error, scene.field->accepted_drift_error,
                           "accepted_drift_error", drift_remedy});
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto load = field.on_bodies->load.row(static_cast<Index>(b));
    out.body_drift.push_back({scene.bodies[static_cast<std::size_t>(bodies[b])].name, load.x(), load.y(), load.z()});
  }
}

}  // namespace

FreeSurface free_surface(const scene::Scene& scene, const std::shared_ptr<compile::Kept>& kept) {
  const scene::AskField& asked = *scene.field;
  const WaveMakers makers = wave_makers(scene);
  if (asked.pressure && makers.meshes.empty())
    throw InputError("[ask.field]: the pressure on bodies of cylinders is not told", asked.pressure_place,
                     "give them as meshes, or leave `pressure` out");
  const std::vector<int>& bodies = makers.meshes.empty() ? makers.cylinders : makers.meshes;
  FreeSurface out{.omega = asked.omega,
                  .heading = asked.heading,
                  .held = asked.held,
                  .x = asked.x,
                  .y = asked.y,
                  .signals = {},
                  .notes = {},
                  .provenance = provenance_of(scene)};
  FieldQuestion question{asked.omega,    asked.heading,  Eigen::VectorXcd::Zero(6 * static_cast<Index>(bodies.size())),
                         grid_of(asked), asked.pressure, asked.body_drift};
  std::optional<double> damped = 0.0;
  if (!asked.held) {
    const compile::Prepared prepared = compile::prepare(at_its_frequency(scene), kept);
    out.notes = prepared.notes;
    const MotionInWave moved = motions_in_wave(scene, prepared, asked.omega, asked.heading, asked.place, out.notes);
    question.motion = about_origins(scene, bodies, moved.xi);
    damped = moved.damped;
  }
  const WaveField field = makers.meshes.empty() ? compile::field_of_cylinders(scene, bodies, question)
                                                : compile::field_of_hulls(scene, bodies, question);
  require_accuracy(scene, {"elevation", field.estimate, asked.accepted_error, "accepted_error",
                           "keep the grid off the sides of bodies, where it is worst"});
  out.pressure = pressures(scene, bodies, field);
  add_drift(scene, field, damped, out);
  add_body_drift(scene, bodies, field, out);
  out.estimate = field.estimate;
  out.angle = field.far.angle;
  out.far_scattered.assign(field.far.scattered.begin(), field.far.scattered.end());
  out.far_radiated.assign(field.far.radiated.begin(), field.far.radiated.end());
  out.signals = {part("elevation", "free surface", field.total(), field.known),
                 part("incident", "free surface without bodies", field.incident, field.known),
                 part("scattered", "what bodies held still add to the free surface", field.scattered, field.known),
                 part("radiated", "what the motion of bodies adds to the free surface", field.radiated, field.known)};
  return out;
}

}  // namespace froude
