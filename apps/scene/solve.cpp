/// \file  [solve]: how a scene is solved where that is not left to the program.
#include <fmt/format.h>

#include <algorithm>

#include "scene/binding.hpp"
#include "scene/build.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

/// What acts with one method only.
void check_methods(const Record& integrator, const Solve& solve) {
  const bool lines_alike = solve.line_scheme_place && solve.line_scheme == "generalized_alpha";
  if (integrator.has("rho_infinity") && solve.integrator != "generalized_alpha" && !lines_alike)
    throw integrator.wrong("rho_infinity", "acts only with name = \"generalized_alpha\"", "leave it out");
  if (integrator.has("line_tolerance") && solve.line_scheme != "rosenbrock")
    throw integrator.wrong("line_tolerance", "acts only with lines = \"rosenbrock\"",
                           "leave it out, or add lines = \"rosenbrock\"");
  if (!integrator.has("gamma")) return;
  if (solve.line_scheme != "gamma")
    throw integrator.wrong("gamma", "acts only with lines = \"gamma\"", "leave it out, or add lines = \"gamma\"");
  if (solve.gamma > 1) throw integrator.wrong("gamma", "is above 1", "0.5 is the trapezium rule, 1 implicit Euler");
}

Binding<Solve> integrator() {
  return Binding<Solve>("[solve.integrator]", "how time is stepped")
      .key(text("name",
                "of the method: generalized_alpha; energy_momentum keeps momentum, and energy of joints and weights, "
                "and damps nothing; explicit_pair, of orders 5 and 4, cuts steps by its own error; implicit_euler and "
                "semi_implicit_euler, of order 1, show what they cost; sundials_bdf is CVODE, in builds that have "
                "SUNDIALS")
               .one_of({"generalized_alpha", "energy_momentum", "explicit_pair", "implicit_euler",
                        "semi_implicit_euler", "sundials_bdf"})
               .or_default("generalized_alpha", "second order, damps only what the step cannot resolve"),
           [](const Value& name, Solve& solve) {
             solve.integrator = name.text;
             solve.integrator_place = name.place;
           })
      .optional(
          number("rho_infinity",
                 "of generalized_alpha: spectral radius at infinite frequency: 1 damps nothing, 0 all at once; left "
                 "out: 0.8, which kills what is not resolved within some steps and leaves the rest alone, and 0 where "
                 "something acts one way only: cables, tables, end stops, lines with `tension_only` that it steps")
              .within(Limit::fraction),
          &Solve::rho_infinity)
      .optional(
          number("tolerance",
                 "of the local error of a step of bodies, relative to their speeds: steps are cut to meet it; left "
                 "out: 1e-8 for explicit_pair and sundials_bdf, whole steps for the others")
              .positive(),
          &Solve::tolerance)
      .optional(text("lines",
                     "how each [[line]] is stepped; rosenbrock, of order 4, cuts steps by its own error; left out: "
                     "energy_momentum, which keeps energy and lengths at any step")
                    .one_of({"energy_momentum", "generalized_alpha", "rosenbrock", "gamma", "semi_implicit_euler",
                             "explicit_euler"}),
                [](const Value& scheme, Solve& solve) {
                  solve.line_scheme = scheme.text;
                  solve.line_scheme_place = scheme.place;
                })
      .optional(number("line_tolerance",
                       "of the local error of a sub-step of lines = \"rosenbrock\", of forces relative to the largest "
                       "tension or the weight, of places to a segment; left out: a hundredth of the accuracy")
                    .positive(),
                &Solve::line_tolerance)
      .optional(number("gamma", "share of the new state in a step of lines = \"gamma\"; left out: 0.51").positive(),
                &Solve::gamma)
      .then(check_methods);
}

}  // namespace

// (D132)
bool acts_one_way(const Scene& scene) {
  const auto axial = [](const Connector& c) {
    const auto* law = std::get_if<AxialConnector>(&c.kind);
    return law != nullptr && (law->tension_only || !law->table_x.empty());
  };
  const auto line = [&](const Line& l) {
    return l.common.tension_only && (l.fastened() || scene.solve.line_scheme == "generalized_alpha");
  };
  return std::any_of(scene.connectors.begin(), scene.connectors.end(), axial) ||
         std::any_of(scene.joints.begin(), scene.joints.end(),
                     [](const Joint& j) { return j.pto && j.pto->has_stops(); }) ||
         std::any_of(scene.lines.begin(), scene.lines.end(), line);
}

double line_tolerance(const Scene& scene) {
  constexpr double share = 1e-2;  // of many sub-steps, whose errors add up
  return scene.solve.line_tolerance.value_or(share * scene.accuracy.value);
}

double newton_tolerance(const Scene& scene) {
  constexpr double share = 1e-6, least = 1e-12, most = 1e-9;
  const double chosen = scene.solve.tolerance ? least : std::clamp(share * scene.accuracy.value, least, most);
  return scene.solve.newton_tolerance.value_or(chosen);
}

const Binding<Solve>& solve_binding() {
  static const auto table = Binding<Solve>("[solve]", "overrides what the program would choose; rarely needed")
                                .key(positive("step", dim::time, "time step, or \"automatic\"")
                                         .one_of({"automatic"})
                                         .or_default("automatic", "chosen from the accuracy asked"),
                                     &Solve::step)
                                .key(effect("accept_error",
                                            "a run stands whatever its error is estimated to be, with the step that is "
                                            "chosen first; without it what misses the accuracy asked is refused"),
                                     &Solve::accept_error)
                                .table("integrator", integrator())
                                .or_default();
  return table;
}

void build_solve(const Record& solve, Scene& scene) {
  scene.solve = solve_binding().read(solve);
  if (!solve.table("integrator").has("rho_infinity") && acts_one_way(scene)) scene.solve.rho_infinity = 0;
}

}  // namespace froude::scene
