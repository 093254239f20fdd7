#include "discretisation.hpp"

#include <algorithm>
#include <cmath>

#include "controlled.hpp"
#include "extrapolate.hpp"
#include "hull_array.hpp"
#include "parts.hpp"
#include "refine.hpp"
#include "request.hpp"
#include "surface.hpp"

namespace hydro::panels {
namespace {

/// Answers are extrapolated as they are.
class AnswersOfModel : public Solver {
 public:
  AnswersOfModel(PanelMesh mesh, const std::vector<HullBody>& bodies, const Water& water)
      : model_(std::move(mesh), bodies, water), water_(water) {}

  Extrapolated solved(double omega, const std::vector<double>& heading) const override {
    if (omega == 0 || std::isinf(omega)) return {model_.added_mass_limit(omega)};
    const OneFrequency a = model_.at(omega, heading);
    if (a.A_parts.size() == 0) return {a.A, a.B, a.B_far, a.X, a.X_far};
    return {a.A, a.B, a.B_far, a.X, a.X_far, a.A_parts, a.B_parts, a.X_parts};
  }
  OneFrequency answer(double, const std::vector<double>&, const Extrapolated& from) const override {
    OneFrequency out{from[0].real(), from[1].real(), from[2].real(), from[3], from[4]};
    if (from.size() == 5) return out;
    out.A_parts = from[5].real();
    out.B_parts = from[6].real();
    out.X_parts = from[7];
    return out;
  }
  Eigen::MatrixXd added_mass(double, const Extrapolated& from) const override { return from[0].real(); }
  std::vector<Extrapolated> scales(const std::vector<const Extrapolated*>& solved) const override {
    return scales_of_waves(solved);
  }
  std::vector<OneFrequency> alone(double omega, const std::vector<double>& heading,
                                  const Extrapolated& from) const override {
    return {answer(omega, heading, from)};
  }
  potential::WaveField field(const potential::FieldQuestion& question, int threads) const override {
    return field_of(model_, water_, question, threads);
  }

 private:
  Model model_;
  Water water_;
};

/// All panels in one set of equations.
class Together : public Discretisation {
 public:
  Together(PanelMesh mesh, const std::vector<HullBody>& bodies, const Water& water)
      : mesh_(std::move(mesh)), bodies_(bodies), water_(water) {}

  std::unique_ptr<const Solver> solver() const override {
    return std::make_unique<AnswersOfModel>(mesh_, bodies_, water_);
  }
  std::unique_ptr<const Discretisation> refined() const override { return with(panels::refined(mesh_)); }
  std::unique_ptr<const Discretisation> graded(double highest, int gradings) const override {
    return with(first_mesh(mesh_, water_, highest, gradings));
  }
  void require_short_panels(double highest) const override { panels::require_short_panels(mesh_, water_, highest); }
  Cost cost(const std::vector<double>& omega, std::size_t headings, int threads, int refined) const override {
    return cost_of(mesh_, bodies_.size(), omega.size(), headings, threads, refined);
  }
  bool has_zero() const override { return water_.depth.is_infinite(); }
  double length() const override { return std::sqrt(wet_area(mesh_) / static_cast<double>(bodies_.size())); }
  void describe(SelfCheck& check) const override {
    check.panels = mesh_.hull_panels();
    check.lid_panels = mesh_.lid_panels();
    check.planes_of_symmetry = static_cast<int>(mesh_.images.size()) / 2;
  }

 private:
  std::unique_ptr<const Discretisation> with(PanelMesh mesh) const {
    return std::make_unique<Together>(std::move(mesh), bodies_, water_);
  }
  PanelMesh mesh_;
  const std::vector<HullBody>& bodies_;
  Water water_;
};

std::unique_ptr<const Discretisation> together(const std::vector<HullBody>& bodies, const Water& water,
                                               const Options& options, bool are_apart) {
  PanelMesh mesh = panel_mesh(bodies, water.depth, options.lid);
  if (!are_apart) require_apart(mesh, bodies);
  return std::make_unique<Together>(std::move(mesh), bodies, water);
}

std::unique_ptr<const Discretisation> apart(const std::vector<HullBody>& bodies, const Water& water,
                                            const std::vector<double>& omega, const Options& options) {
  // Of the tolerance, as between cylinders; without one what panels leave is a percent or so.
  constexpr double share = 0.2, usual = 1e-3;
  return std::make_unique<HullArray>(bodies, water, omega, options.tolerance ? share * *options.tolerance : usual,
                                     options.lid);
}

}  // namespace

Cost cost_as_asked(const Discretisation& given, const std::vector<double>& omega, std::size_t headings,
                   const Options& options) {
  if (!options.tolerance) return given.cost(omega, headings, options.threads, options.refined_frequencies);
  const auto first = given.graded(omega.back(), usual_gradings);
  Cost c = first->cost(omega, headings, options.threads, first_samples(options));
  if (options.frequency_tolerance) c.seconds += first->cost(omega, headings, options.threads, 0).seconds;  // to choose
  return c;
}

PanelMesh first_mesh(const PanelMesh& given, const Water& water, double highest, int gradings) {
  constexpr int most_panels = 5000;  // of the part that is kept: more than can be solved when they are cut again
  PanelMesh mesh = graded(given, gradings);
  while (static_cast<int>(mesh.hull.size()) < most_panels && too_long(mesh, water, highest)) mesh = refined(mesh);
  require_short_panels(mesh, water, highest);
  return mesh;
}

// Partial waves have an error of their own and need circles that are apart: where all panels together take about as
// long, or no time to speak of, these are taken. So many that nobody would solve them together are not even looked at.
std::unique_ptr<const Discretisation> discretised(const std::vector<HullBody>& bodies, const Water& water,
                                                  const std::vector<double>& omega, std::size_t headings,
                                                  const Options& options) {
  constexpr double worth = 2, noticed = 5;  // times; s
  constexpr int far_too_many = 20000;       // panels
  require(!bodies.empty(), "there is no body");
  require_parts_can_be_told(bodies, water, options);
  const bool parts = std::any_of(bodies.begin(), bodies.end(), [](const HullBody& b) { return !b.sections.empty(); });
  if (options.interaction == Interaction::partial_waves) return apart(bodies, water, omega, options);
  const bool are_apart = bodies.size() == 1 || !too_near(places_of(bodies));
  if (parts || options.interaction == Interaction::panels || bodies.size() == 1 || !are_apart)
    return together(bodies, water, options, are_apart);
  auto each = apart(bodies, water, omega, options);
  const Cost of_each = cost_as_asked(*each, omega, headings, options);
  if (of_each.panels > far_too_many) return each;
  auto all = together(bodies, water, options, are_apart);
  const double of_all = cost_as_asked(*all, omega, headings, options).seconds;
  return of_all > noticed && of_each.seconds * worth < of_all ? std::move(each) : std::move(all);
}

}  // namespace hydro::panels
