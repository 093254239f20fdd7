#include "hydro/cylinders/solve.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "deep.hpp"
#include "hydro/base/parallel.hpp"
#include "model.hpp"
#include "potential/operations/where_needed.hpp"
#include "potential/solver_request.hpp"
#include "request.hpp"
#include "self_check.hpp"

namespace hydro::cylinders {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using potential::Coefficients;

/// The layout in the water of each frequency: one model for all if the depth is finite, else one a frequency.
class Models {
 public:
  Models(const std::vector<CylinderBody>& bodies, const Water& water, const std::vector<double>& omega,
         const Resolution& resolution)
      : bodies_(bodies), water_(water), resolution_(resolution) {
    if (!water.depth.is_infinite()) shared_ = std::make_shared<Model>(bodies, water, resolution, omega);
  }
  std::shared_ptr<const Model> at(double omega) const {
    if (shared_) return shared_;
    return std::make_shared<Model>(bodies_, effective_water(bodies_, water_, omega), resolution_, finite(omega));
  }

 private:
  static std::vector<double> finite(double omega) {
    return std::isinf(omega) ? std::vector<double>{} : std::vector<double>{omega};
  }
  const std::vector<CylinderBody>& bodies_;
  Water water_;
  Resolution resolution_;
  std::shared_ptr<const Model> shared_;
};

void fill_bodies(const std::vector<CylinderBody>& bodies, const Water& water, Coefficients& c) {
  bool restoring_known = true;
  for (const CylinderBody& body : bodies) {
    const Displacement d = displacement(body, water.depth);
    c.body.push_back({.name = body.name,
                      .reference_point = body.reference_point,
                      .centre_of_gravity = body.centre_of_gravity,
                      .centre_of_buoyancy = d.centre_of_buoyancy,
                      .displaced_volume = d.volume});
    restoring_known = restoring_known && body.centre_of_gravity;
    for (const Cylinder& cylinder : body.cylinders) restoring_known = restoring_known && cylinder.draught;
  }
  if (!restoring_known) {
    c.notes.push_back("no restoring matrix: a body has no centre of gravity or stands on the sea bed");
    return;
  }
  c.C = MatrixXd::Zero(c.modes(), c.modes());
  for (std::size_t b = 0; b < bodies.size(); ++b)
    c.C->block<6, 6>(6 * static_cast<Index>(b), 6 * static_cast<Index>(b)) = restoring(bodies[b], water);
}

std::string source_text(const std::vector<CylinderBody>& bodies) {
  std::size_t cylinders = 0;
  for (const CylinderBody& body : bodies) cylinders += body.cylinders.size();
  return fmt::format("truncated vertical cylinders, exact: {} in {} {}", cylinders, bodies.size(),
                     bodies.size() == 1 ? "body" : "bodies");
}

void add_notes(const Solution& s, const Water& water, double tolerance, Coefficients& c) {
  c.notes.push_back(fmt::format(
      "self-check, relative: energy {:.1e}, Haskind {:.1e}, reciprocity {:.1e}, change with doubled resolution {}",
      s.check.energy, s.check.haskind, s.check.reciprocity,
      std::isnan(s.check.doubling) ? "not asked for" : fmt::format("{:.1e}", s.check.doubling)));
  if (s.check.left_out > 0)
    c.notes.push_back(
        fmt::format("warning: gaps between cylinders are so small, or waves so short, that partial waves "
                    "had to be left out: about {:.1f} digits are left",
                    -std::log10(s.check.left_out)));
  if (s.check.doubling > tolerance)
    c.notes.push_back(
        fmt::format("warning: {:.1e} was asked for, but doubled resolution changes the result by {:.1e}: "
                    "about {:.1f} digits are left",
                    tolerance, s.check.doubling, std::max(0.0, -std::log10(s.check.doubling))));
  if (s.check.steps > 0)
    c.notes.push_back(
        fmt::format("the equations between groups of cylinders were solved by iteration, in {} steps at most{}",
                    s.check.steps, s.check.lattice ? ", waves passed over a lattice" : ""));
  if (water.depth.is_infinite())
    c.notes.push_back(
        fmt::format("infinite depth is taken as {:.4g} m or more: an error below 1e-4", s.check.effective_depth));
}

/// What is asked of every frequency.
struct Asked {
  const std::vector<CylinderBody>& bodies;
  const Water& water;
  const std::vector<double>& heading;
  const Options& options;
  Resolution resolution;
};

/// Everything that is solved, in one pool of work.
struct Work {
  std::vector<double> omega;
  std::vector<OneFrequency> results;  ///< of each
  std::vector<std::size_t> doubled;   ///< frequencies that are repeated with doubled resolution
  std::vector<OneFrequency> finer;    ///< those
  MatrixXd A_inf;
};

/// `before`: pieces that are done already. Where there are any, nothing is doubled and A(∞) is not asked again.
Work do_work(const Asked& asked, const std::vector<double>& omega, int before = 0) {
  Work w;
  w.omega = omega;
  if (before == 0) w.doubled = frequencies_to_double(omega.size(), asked.options.doubled_frequencies);
  w.results.resize(omega.size());
  w.finer.resize(w.doubled.size());
  const Models models(asked.bodies, asked.water, omega, asked.resolution);
  std::unique_ptr<Models> finer_models;
  if (!w.doubled.empty())
    finer_models = std::make_unique<Models>(asked.bodies, asked.water, omega, asked.resolution.doubled());

  // The dearest first: doubled frequencies, then the rest and the limit.
  const std::size_t all = w.finer.size() + omega.size() + (before == 0 ? 1 : 0);
  std::mutex told;
  int done = before;
  in_parallel(all, potential::thread_count(asked.options.threads, all), [&](std::size_t i) {
    if (i < w.finer.size()) {
      const double at = omega[w.doubled[i]];
      w.finer[i] = finer_models->at(at)->at(at, asked.heading);
    } else if (i < w.finer.size() + omega.size()) {
      const std::size_t n = i - w.finer.size();
      w.results[n] = models.at(omega[n])->at(omega[n], asked.heading);
    } else {
      w.A_inf = models.at(infinite)->added_mass_at_infinity();
    }
    const std::lock_guard<std::mutex> lock(told);
    ++done;
    if (asked.options.progress) asked.options.progress(done, before + static_cast<int>(all));
  });
  return w;
}

/// Everything but the loads.
Coefficients without_loads(const Asked& asked) {
  Coefficients c;
  c.water = asked.water;
  c.source = source_text(asked.bodies);
  fill_bodies(asked.bodies, asked.water, c);
  return c;
}

Coefficients with_loads(const Work& w, const std::vector<double>& heading, Coefficients c) {
  c.omega = w.omega;
  c.heading = heading;
  c.A_inf = w.A_inf;
  c.X.assign(heading.size(), MatrixXcd(c.modes(), static_cast<Index>(w.omega.size())));
  for (std::size_t i = 0; i < w.omega.size(); ++i) {
    c.A.push_back(w.results[i].A);
    c.B.push_back(w.results[i].B);
    for (std::size_t h = 0; h < heading.size(); ++h)
      c.X[h].col(static_cast<Index>(i)) = w.results[i].X.col(static_cast<Index>(h));
  }
  return c;
}

void add(Work more, Work& all) {
  for (std::size_t i = 0; i < more.omega.size(); ++i) {
    const auto at = std::upper_bound(all.omega.begin(), all.omega.end(), more.omega[i]) - all.omega.begin();
    all.omega.insert(all.omega.begin() + at, more.omega[i]);
    all.results.insert(all.results.begin() + at, std::move(more.results[i]));
    for (std::size_t& d : all.doubled)
      if (static_cast<std::ptrdiff_t>(d) >= at) ++d;
  }
}

/// `first`, and as many frequencies between them as are needed; what was foreseen of them is in `chosen`.
Work work_where_needed(const Asked& asked, const std::vector<double>& first, const Coefficients& bodies,
                       potential::ChosenFrequencies& chosen) {
  Work all;
  chosen = potential::choose_frequencies(first, *asked.options.frequency_tolerance,
                                         [&](const std::vector<double>& omega) -> Coefficients {
                                           const int before = static_cast<int>(all.results.size() + all.finer.size());
                                           Work w = do_work(asked, omega, before);
                                           if (before > 0) w.A_inf = all.A_inf;
                                           Coefficients c = with_loads(w, asked.heading, bodies);
                                           if (before > 0)
                                             add(std::move(w), all);
                                           else
                                             all = std::move(w);
                                           return c;
                                         });
  return all;
}

}  // namespace

Solution solve(const std::vector<CylinderBody>& bodies, const Water& water, const std::vector<double>& omega,
               const std::vector<double>& heading, const Options& options) {
  check(bodies, water.depth);
  check_request(omega, heading, options);
  const Asked asked{bodies,
                    water,
                    heading,
                    options,
                    {choose_gap_functions(bodies, water, omega, options.tolerance),
                     share_of_tolerance * options.tolerance, options.equations}};
  const Coefficients known = without_loads(asked);
  potential::ChosenFrequencies chosen;
  const Work w = options.frequency_tolerance ? work_where_needed(asked, omega, known, chosen) : do_work(asked, omega);
  Solution s;
  Coefficients& c = s.coefficients;
  c = with_loads(w, heading, known);
  s.check = self_check(w.results, w.finer, w.doubled);
  s.check.gap_functions = asked.resolution.gap_functions;
  s.check.effective_depth = effective_water(bodies, water, omega.back()).depth.metres();
  for (const std::size_t i : w.doubled) s.check.doubling_omega.push_back(w.omega[i]);
  add_notes(s, water, options.tolerance, c);
  if (options.frequency_tolerance) {
    s.check.solved_omega = w.omega;
    s.check.unseen = chosen.unseen;
    c = potential::with_frequencies_between(c, *options.frequency_tolerance);
    c.notes.push_back(potential::note_of(chosen, c));
  }
  c.validate();
  return s;
}

}  // namespace hydro::cylinders
