#include "hydro/panels/solve.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>

#include "controlled.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/parallel.hpp"
#include "hydro/hydrostatics/immersion.hpp"
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
  bool known = true;
  for (const HullBody& body : bodies) {
    const hydrostatics::Immersion im = hydrostatics::immersion(body.hull, {});
    c.body.push_back({.name = body.name,
                      .reference_point = body.reference_point,
                      .centre_of_gravity = body.centre_of_gravity,
                      .centre_of_buoyancy = im.centre_of_buoyancy,
                      .displaced_volume = im.volume});
    known = known && body.centre_of_gravity;
  }
  if (!known) {
    c.notes.push_back("no restoring matrix: a body has no centre of gravity");
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

/// The mesh as it is given; its error is told if frequencies are to be refined.
Work plain_work(const Discretisation& given, const std::vector<double>& omega, const std::vector<double>& heading,
                const Options& options) {
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
  for (std::size_t i = 0; i < omega.size(); ++i)
    pieces.emplace_back([&, i] { w.results[i] = solver->at(omega[i], heading); });
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
  if (fine) w.check.estimate = estimate_of(w.results, finer, again, given.length());
  const Sizes size = sizes(w.results, given.length());
  for (std::size_t i = 0; i < with_more.size(); ++i)
    w.check.truncation = std::max(w.check.truncation, truncation_of(w.results[again[i]], with_more[i], size));
  w.check.estimate += w.check.truncation;
  for (const std::size_t i : again) w.check.refined_omega.push_back(omega[i]);
  return w;
}

/// The nearest matrix without negative eigenvalues, entries being measured against the largest of their modes (P11):
/// a small damping is a difference of large pressures, and panels leave it below zero now and then. Were a small mode
/// measured against itself alone, its error would be put on the large ones that it is coupled with.
MatrixXd passive(const MatrixXd& B, const Eigen::VectorXd& size) {
  const Eigen::VectorXd scale = size.cwiseSqrt();
  const MatrixXd scaled = scale.cwiseInverse().asDiagonal() * B * scale.cwiseInverse().asDiagonal();
  return scale.asDiagonal() * dense::positive_part(scaled) * scale.asDiagonal();
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
    c.B.push_back(symmetric(passive(B, size)));
    changed = std::max(changed, (scale.asDiagonal() * (c.B.back() - B) * scale.asDiagonal()).cwiseAbs().maxCoeff());
    for (std::size_t h = 0; h < heading.size(); ++h)
      c.X[h].col(static_cast<Index>(i)) = w.results[i].X.col(static_cast<Index>(h));
  }
  c.A_inf = symmetric(w.A_inf);
  if (w.A_zero) c.A_zero = symmetric(*w.A_zero);
  return changed;
}

}  // namespace

Solution solve(const std::vector<HullBody>& bodies, const Water& water, const std::vector<double>& omega,
               const std::vector<double>& heading, const Options& options) {
  check_request(omega, heading, options);
  const auto given = discretised(bodies, water, omega, heading.size(), options);
  const bool controlled = options.tolerance.has_value();
  if (!controlled) given->require_short_panels(omega.back());
  require_memory(cost_as_asked(*given, omega, heading.size(), options));
  const Work w =
      controlled ? controlled_work(*given, omega, heading, options) : plain_work(*given, omega, heading, options);
  Solution s;
  s.check = w.check;
  Coefficients& c = s.coefficients;
  c.water = water;
  c.source = fmt::format("panels: {} on {} {}", s.check.panels, bodies.size(), bodies.size() == 1 ? "hull" : "hulls");
  fill_bodies(bodies, water, c);
  s.check.passivity = fill(w, omega, heading, c);
  add_notes(s.check, c);
  if (!std::isnan(s.check.estimate)) note_flat_faces(bodies, c);
  c.validate();
  return s;
}

Cost cost(const std::vector<HullBody>& bodies, const Water& water, const std::vector<double>& omega,
          const std::vector<double>& heading, const Options& options) {
  check_request(omega, heading, options);
  return cost_as_asked(*discretised(bodies, water, omega, heading.size(), options), omega, heading.size(), options);
}

}  // namespace hydro::panels
