#include "compile/cylinders.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "compile/computed.hpp"
#include "compile/kept_coefficients.hpp"
#include "compile/kept_files.hpp"
#include "fit_sources.hpp"
#include "scene/placed.hpp"

namespace froude::compile {
namespace {

using hydro::InputError;
using scene::Scene;

const scene::Body& body_of(const Scene& scene, int body) { return scene.bodies[static_cast<std::size_t>(body)]; }

hydro::cylinders::CylinderBody as_cylinders(const scene::Body& body) {
  hydro::cylinders::CylinderBody out{body.name, body.position, body.position + body.centre_of_gravity,
                                     body.hydrodynamics->cylinders->all};
  for (hydro::cylinders::Cylinder& c : out.cylinders) c.centre += body.position.head<2>();
  return out;
}

/// What hydro::cylinders is asked.
struct Request {
  std::vector<hydro::cylinders::CylinderBody> layout;
  std::vector<double> omega, headings;
  hydro::cylinders::Options options;
  hydro::Place place;
};

Request request(const Scene& scene, const std::vector<int>& bodies) {
  const scene::Hydrodynamics& first = *body_of(scene, bodies.front()).hydrodynamics;
  Request r{{}, first.cylinders->omega, first.cylinders->headings, {}, first.file.place};
  for (const int b : bodies) {
    const scene::Hydrodynamics& h = *body_of(scene, b).hydrodynamics;
    require_same_table("cylinders", *first.cylinders, *h.cylinders, h.file.place);
    r.layout.push_back(as_cylinders(body_of(scene, b)));
  }
  if (r.headings.empty()) r.headings = headings_asked(scene);
  // A tenth of the accuracy asked of the motions, so that their error is not made here.
  r.options.tolerance = std::clamp(0.1 * scene.accuracy, 1e-6, 1e-3);
  r.options.doubled_frequencies = 1;
  r.options.frequency_tolerance = first.cylinders->frequency_tolerance;
  if (r.options.frequency_tolerance)  // what is foreseen has to stand out from the error of what is seen
    r.options.tolerance = std::min(r.options.tolerance, 0.1 * *r.options.frequency_tolerance);
  return r;
}

/// What decides on every bit of the coefficients: the program that solves, and all that it is asked.
std::string key_of_cylinders(const Scene& scene, const std::vector<int>& bodies) {
  return maker("solution by cylinders", FROUDE_CYLINDER_SOURCES) + what_is_solved(scene, bodies);
}

}  // namespace

std::vector<int> bodies_of_cylinders(const Scene& scene) {
  return bodies_where(scene, [](const scene::Hydrodynamics& h) { return h.cylinders.has_value(); });
}

hydro::cylinders::Solution solve_cylinders(const Scene& scene, const std::vector<int>& bodies,
                                           std::function<void(int, int)> progress) {
  const Request r = request(scene, bodies);
  hydro::cylinders::Options options = r.options;
  options.progress = std::move(progress);
  auto s = scene::placed(r.place,
                         [&] { return hydro::cylinders::solve(r.layout, scene.water, r.omega, r.headings, options); });
  keep_coefficients(key_of_cylinders(scene, bodies), s.coefficients);
  return s;
}

hydro::potential::Coefficients coefficients_of_cylinders(const Scene& scene, const std::vector<int>& bodies) {
  auto kept = kept_coefficients(key_of_cylinders(scene, bodies), scene.water);
  return kept ? std::move(*kept) : solve_cylinders(scene, bodies).coefficients;
}

hydro::potential::WaveField field_of_cylinders(const Scene& scene, const std::vector<int>& bodies,
                                               const hydro::potential::FieldQuestion& question) {
  Request r = request(scene, bodies);
  r.options.frequency_tolerance.reset();  // there is one frequency
  return scene::placed(r.place,
                       [&] { return hydro::cylinders::wave_field(r.layout, scene.water, question, r.options); });
}

std::string what_is_solved(const Scene& scene, const std::vector<int>& bodies) {
  const Request r = request(scene, bodies);
  std::string out =
      fmt::format("cylinders {} {} {} {} {} | {} | {}", scene.water.density, scene.water.gravity,
                  scene.water.depth.metres(), r.options.tolerance, r.options.frequency_tolerance.value_or(0),
                  fmt::join(r.omega, " "), fmt::join(r.headings, " "));
  for (const auto& body : r.layout) {
    out += fmt::format(" | {} {} {}", body.name, fmt::join(body.reference_point, " "),
                       fmt::join(body.centre_of_gravity.value_or(body.reference_point), " "));
    for (const auto& c : body.cylinders)
      out +=
          fmt::format(" ; {} {} {} {}", fmt::join(c.centre, " "), c.radius, c.draught.value_or(-1), c.top.value_or(-1));
  }
  return out;
}

std::string CylinderPlan::method() const {
  if (kept_in) return fmt::format("exact, solved before and kept in {}", kept_in->string());
  return fmt::format("exact, the equations between groups {}", cost.iterative ? "by iteration" : "by elimination");
}

std::string CylinderPlan::size() const {
  return left_to_do(
      fmt::format("{} cylinders in {} {}, {}, {} headings; {} unknowns at most, {:.3g} MB, about {:.2g} s", cylinders,
                  bodies, bodies == 1 ? "body" : "bodies", frequencies_in_words(frequencies, cost.frequencies),
                  headings, cost.unknowns, std::ceil(cost.bytes / 1e6), std::max(0.1, cost.seconds)),
      kept_in.has_value());
}

CylinderPlan plan_cylinders(const Scene& scene, const std::vector<int>& bodies) {
  const Request r = request(scene, bodies);
  CylinderPlan plan{
      {}, 0, bodies.size(), r.omega.size(), r.headings.size(), folder_of_kept(key_of_cylinders(scene, bodies))};
  for (const auto& body : r.layout) plan.cylinders += body.cylinders.size();
  scene::placed(r.place,
                [&] { plan.cost = hydro::cylinders::cost(r.layout, scene.water, r.omega, r.headings, r.options); });
  return plan;
}

}  // namespace froude::compile
