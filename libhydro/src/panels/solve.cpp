#include "hydro/panels/solve.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <mutex>

#include "controlled.hpp"
#include "hydro/base/parallel.hpp"
#include "hydro/hydrostatics/immersion.hpp"
#include "panel_mesh.hpp"
#include "parts.hpp"
#include "potential/modes.hpp"
#include "potential/operations/where_needed.hpp"
#include "potential/solver_request.hpp"
#include "refine.hpp"
#include "request.hpp"
#include "self_check.hpp"

namespace hydro::panels {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using potential::Coefficients;

void fill_bodies(const std::vector<HullBody>& bodies, const Water& water, Coefficients& c) {
  bool known = true, floating = true;
  for (const HullBody& body : bodies) {
    const hydrostatics::Immersion im = hydrostatics::immersion(body.hull, {});
    c.body.push_back({.name = body.name,
                      .reference_point = body.reference_point,
                      .centre_of_gravity = body.centre_of_gravity,
                      .centre_of_buoyancy = im.centre_of_buoyancy,
                      .displaced_volume = im.volume});
    known = known && body.centre_of_gravity;
    if (!stands_on_bed(body, water.depth)) continue;
    floating = false;
    c.notes.push_back(fmt::format(
        "\"{}\" stands on the sea bed: its faces there meet no water, and loads are without them", body.name));
  }
  if (!known || !floating) {
    c.notes.push_back("no restoring matrix: a body has no centre of gravity or stands on the sea bed");
    return;
  }
  c.C = MatrixXd::Zero(c.modes(), c.modes());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const HullBody& body = bodies[b];
    const hydrostatics::Immersion im = hydrostatics::immersion(body.hull, {});
    const double weight = water.density * water.gravity * im.volume;  // in balance, as (P12) has it
    const Eigen::Matrix<double, 6, 6> C =
        hydrostatics::buoyancy_stiffness(im, water, body.reference_point) +
        hydrostatics::gravity_stiffness(weight, *body.centre_of_gravity, body.reference_point);
    // Symmetric if the centre of gravity is above that of buoyancy; what is not is a moment at rest.
    c.C->block<6, 6>(6 * static_cast<Index>(b), 6 * static_cast<Index>(b)) = (C + C.transpose()) / 2;
  }
}

void add_notes(const SelfCheck& k, Coefficients& c) {
  c.notes.push_back(fmt::format("{} panels, {} on the water inside; {} {} of symmetry", k.panels, k.lid_panels,
                                k.planes_of_symmetry, k.planes_of_symmetry == 1 ? "plane" : "planes"));
  c.notes.push_back(fmt::format(
      "self-check, relative: energy {:.1e}, Haskind {:.1e}, reciprocity {:.1e} before A and B were made symmetric",
      k.energy, k.haskind, k.reciprocity));
  if (k.kinds > 0)
    c.notes.push_back(
        fmt::format("{} {} of hulls, each solved once; between them pass up to {} partial waves a hull{}", k.kinds,
                    k.kinds == 1 ? "kind" : "kinds", k.partial_waves,
                    k.truncation > 0 ? fmt::format(", what is left out changes {:.1e}", k.truncation) : ""));
  if (k.passivity > 0)
    c.notes.push_back(
        fmt::format("B was made free of negative eigenvalues: changed by {:.1e} of its modes at most", k.passivity));
  if (!k.extrapolated_from.empty())
    c.notes.push_back(fmt::format(
        "extrapolated to panels of no size on the same flat faces from meshes of {} panels, at {} of {} "
        "frequencies; between them what refinement changes is interpolated; estimated error {:.1e}, {:.1e} "
        "of it by that interpolation",
        fmt::join(k.extrapolated_from, ", "), k.refined_omega.size(), c.omega.size(), k.estimate, k.interpolation));
  else if (std::isnan(k.estimate))
    c.notes.push_back("the error by panels is not estimated: that takes panels cut in four, at a frequency at least");
  else
    c.notes.push_back(fmt::format("error by panels, estimated from four times as many at {} of {} frequencies: {:.1e}",
                                  k.refined_omega.size(), c.omega.size(), k.estimate));
}

/// What an estimate by smaller panels on the same faces cannot see.
void note_flat_faces(const std::vector<HullBody>& bodies, Coefficients& c) {
  double lacking = 0, all = 0;
  for (const HullBody& body : bodies) {
    lacking += hydrostatics::chord_volume(body.hull);
    all += body.hull.volume();
  }
  constexpr double told = 1e-4;
  if (std::abs(lacking) > told * all)
    c.notes.push_back(
        fmt::format("flat faces lack {:.2g} % of the volume of a smooth hull through the same corners; what "
                    "that does to A, B and X is not part of the estimate",
                    100 * lacking / all));
}

/// Answers that are known already, by frequency.
using Known = std::map<double, OneFrequency>;

/// The mesh as it is given; its error is told if frequencies are to be refined.
Work plain_work(const Discretisation& given, const std::vector<double>& omega, const std::vector<double>& heading,
                const Options& options, const Known& known) {
  const auto solver = given.solver();
  std::unique_ptr<const Solver> fine, more;
  std::vector<std::size_t> again;  // frequencies that are repeated: finer, and with more partial waves
  if (options.refined_frequencies > 0) {
    fine = given.refined()->solver();
    more = given.with_more_partial_waves();
    again = frequencies_to_refine(omega.size(), options.refined_frequencies);
  }
  Work w;
  std::vector<OneFrequency> finer(again.size()), with_more(more ? again.size() : 0);
  w.results.resize(omega.size());
  std::vector<std::function<void()>> pieces;  // the dearest first
  for (std::size_t i = 0; i < finer.size(); ++i)
    pieces.emplace_back([&, i] { finer[i] = fine->at(omega[again[i]], heading); });
  for (std::size_t i = 0; i < with_more.size(); ++i)
    pieces.emplace_back([&, i] { with_more[i] = more->at(omega[again[i]], heading); });
  for (std::size_t i = 0; i < omega.size(); ++i) {
    if (const auto before = known.find(omega[i]); before != known.end())
      w.results[i] = before->second;
    else
      pieces.emplace_back([&, i] { w.results[i] = solver->at(omega[i], heading); });
  }
  pieces.emplace_back([&] { w.A_inf = solver->added_mass_limit(std::numeric_limits<double>::infinity()); });
  if (given.has_zero()) pieces.emplace_back([&] { w.A_zero = solver->added_mass_limit(0); });
  std::mutex told;
  int done = 0;
  in_parallel(pieces.size(), potential::thread_count(options.threads, pieces.size()), [&](std::size_t i) {
    pieces[i]();
    const std::lock_guard<std::mutex> lock(told);
    ++done;
    if (options.progress) options.progress(done, static_cast<int>(pieces.size()));
  });
  w.check = self_check(w.results, given.length());
  given.describe(w.check);
  if (fine) w.check.estimate = estimate_of(w.results, finer, again, given.length(), w.own_error);
  const Sizes size = sizes(w.results, given.length());
  for (std::size_t i = 0; i < with_more.size(); ++i)
    w.check.truncation = std::max(w.check.truncation, truncation_of(w.results[again[i]], with_more[i], size));
  w.check.estimate += w.check.truncation;
  for (const std::size_t i : again) w.check.refined_omega.push_back(omega[i]);
  return w;
}

/// Fills A, B and X, and returns the largest change of B that passivity needed, (P11).
double fill(const Work& w, const std::vector<double>& omega, const std::vector<double>& heading, Coefficients& c) {
  const auto symmetric = [](const MatrixXd& M) { return MatrixXd((M + M.transpose()) / 2); };
  const Eigen::VectorXd size = sizes(w.results, w.check.length).B, scale = size.cwiseSqrt().cwiseInverse();
  double changed = 0;
  c.omega = omega;
  c.heading = heading;
  c.X.assign(heading.size(), MatrixXcd(c.modes(), static_cast<Index>(omega.size())));
  for (std::size_t i = 0; i < omega.size(); ++i) {
    c.A.push_back(symmetric(w.results[i].A));
    const MatrixXd B = symmetric(w.results[i].B);
    c.B.push_back(symmetric(potential::nearest_passive(B, size)));
    changed = std::max(changed, (scale.asDiagonal() * (c.B.back() - B) * scale.asDiagonal()).cwiseAbs().maxCoeff());
    for (std::size_t h = 0; h < heading.size(); ++h)
      c.X[h].col(static_cast<Index>(i)) = w.results[i].X.col(static_cast<Index>(h));
  }
  c.A_inf = symmetric(w.A_inf);
  if (w.A_zero) c.A_zero = symmetric(*w.A_zero);
  return changed;
}

/// What is as far off as the estimate has it, (G28); `whole` is what comes out.
std::vector<Solution::Doubted> doubted_values(const PanelMesh& mesh, const std::vector<HullBody>& bodies,
                                              const Work& work, const Coefficients& whole) {
  std::vector<Solution::Doubted> out;
  for (const std::vector<OneFrequency>& results : work.doubted) {
    Work of = work;
    of.results = results;
    Coefficients c = whole;
    c.A.clear();
    c.B.clear();
    fill(of, whole.omega, whole.heading, c);
    Coefficients parts = loads_on_parts(mesh, bodies, results, c);
    out.push_back({std::move(c), std::move(parts)});
  }
  return out;
}

/// By panels of one size: the mesh's own, whose answers are then `known`, or the coarsest by which an error is
/// controlled.
potential::ChosenFrequencies where_needed(const Discretisation& given, const std::vector<double>& first,
                                          const std::vector<double>& heading, const Options& options,
                                          const Coefficients& bodies, Known& known) {
  const auto coarsest = options.tolerance ? given.graded(first.back(), usual_gradings) : nullptr;
  const Discretisation& mesh = coarsest ? *coarsest : given;
  const auto solver = mesh.solver();
  Work w;
  w.A_inf = solver->added_mass_limit(std::numeric_limits<double>::infinity());
  w.check.length = mesh.length();
  std::mutex told;
  int done = 0, all = 0;
  return potential::choose_frequencies(
      first, *options.frequency_tolerance, [&](const std::vector<double>& omega) -> Coefficients {
        w.results.assign(omega.size(), {});
        all += static_cast<int>(omega.size());
        in_parallel(omega.size(), potential::thread_count(options.threads, omega.size()), [&](std::size_t i) {
          w.results[i] = solver->at(omega[i], heading);
          const std::lock_guard<std::mutex> lock(told);
          if (options.progress) options.progress(++done, all);
        });
        if (!coarsest)
          for (std::size_t i = 0; i < omega.size(); ++i) known[omega[i]] = w.results[i];
        Coefficients c = bodies;
        fill(w, omega, heading, c);
        return c;
      });
}

/// Frequencies by which cost is told: as asked, or about as many as will be chosen.
std::vector<double> expected(const std::vector<HullBody>& bodies, const Water& water, const std::vector<double>& omega,
                             const Options& options) {
  if (!options.frequency_tolerance) return omega;
  Eigen::AlignedBox2d box;
  for (const HullBody& body : bodies)
    for (const Eigen::Vector3d& v : body.hull.vertices()) box.extend(v.head<2>().eval());
  return potential::expected_frequencies(omega, *options.frequency_tolerance, box.diagonal().norm(), water);
}

/// Waves far away and pressures are two ways to the same numbers, and A and B are symmetric; panels that are too coarse
/// for a gap or a wave miss it. A mode is measured against a tenth of the largest of its kind at least.
void require_credible(const SelfCheck& k) {
  constexpr double most = 0.3;
  if (k.energy <= most && k.haskind <= most && k.reciprocity <= most) return;
  throw InputError(
      fmt::format(
          "the mesh is too coarse, and what it gives is no answer: power of waves far away differs from damping "
          "by {:.2g} of its modes, excitation from Haskind's by {:.2g}, A and B from symmetric ones by {:.2g}; "
          "{:g} is the most that is taken",
          k.energy, k.haskind, k.reciprocity, most),
      {},
      "make panels finer, above all in narrow gaps and at the waterline, leave out the shortest waves, or let a "
      "tolerance refine them: mesh_tolerance in a scene, --tolerance of froude bem solve");
}

}  // namespace

Solution solve(const std::vector<HullBody>& bodies, const Water& water, const std::vector<double>& omega,
               const std::vector<double>& heading, const Options& options) {
  check_request(omega, heading, options);
  const std::vector<double> at_about = expected(bodies, water, omega, options);
  const auto given = discretised(bodies, water, at_about, heading.size(), options);
  const bool controlled = options.tolerance.has_value();
  if (!controlled) given->require_short_panels(omega.back());
  require_memory(cost_as_asked(*given, at_about, heading.size(), options));
  Solution s;
  Coefficients& c = s.coefficients;
  c.water = water;
  fill_bodies(bodies, water, c);
  potential::ChosenFrequencies chosen{.omega = omega, .unseen_omega = {}};
  Known by_choosing;
  if (options.frequency_tolerance) chosen = where_needed(*given, omega, heading, options, c, by_choosing);
  const Work w = controlled ? controlled_work(*given, chosen.omega, heading, options)
                            : plain_work(*given, chosen.omega, heading, options, by_choosing);
  s.check = w.check;
  if (!controlled) require_credible(s.check);
  c.source = fmt::format("panels: {} on {} {}", s.check.panels, bodies.size(), bodies.size() == 1 ? "hull" : "hulls");
  s.check.passivity = fill(w, chosen.omega, heading, c);
  if (std::any_of(bodies.begin(), bodies.end(), [](const HullBody& body) { return !body.sections.empty(); })) {
    const PanelMesh mesh = panel_mesh(bodies, water.depth, false);
    s.parts = loads_on_parts(mesh, bodies, w.results, c);
    s.doubted = doubted_values(mesh, bodies, w, c);
  }
  add_notes(s.check, c);
  if (std::string own = in_words(w.own_error, s.check.estimate); !own.empty()) c.notes.push_back(std::move(own));
  if (!std::isnan(s.check.estimate)) note_flat_faces(bodies, c);
  if (options.frequency_tolerance) {
    s.check.solved_omega = chosen.omega;
    s.check.unseen = chosen.unseen;
    c = potential::with_frequencies_between(c, *options.frequency_tolerance);
    c.notes.push_back(potential::note_of(chosen, c));
  }
  c.validate();
  return s;
}

Cost cost(const std::vector<HullBody>& bodies, const Water& water, const std::vector<double>& omega,
          const std::vector<double>& heading, const Options& options) {
  check_request(omega, heading, options);
  const std::vector<double> at_about = expected(bodies, water, omega, options);
  return cost_as_asked(*discretised(bodies, water, at_about, heading.size(), options), at_about, heading.size(),
                       options);
}

}  // namespace hydro::panels
