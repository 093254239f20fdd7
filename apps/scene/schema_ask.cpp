/// \file  What is wanted of a scene, and how it is solved.
#include "scene/schema_ask.hpp"

#include "scene/schema_waves.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
using enum Group::Count;

Key asked_signals() {
  return texts("of", "signals to give, like \"m*.surge\" or \"connector*.force\"; * stands for any characters")
      .or_default("*", "everything there is");
}

Key small_motions_about() {
  return text("about",
              "\"as placed\", where everything must be in balance; or \"equilibrium\": where the bodies balance in "
              "still "
              "water, coefficients being those of the bodies as placed")
      .one_of({"as placed", "equilibrium"})
      .or_default("as placed", "coefficients of a body hold where it was when they were computed");
}

const Table& ask_rao_drag() {
  static const Table table{
      .title = "[ask.rao.drag]",
      .meaning =
          "drag of [member.drag] at each frequency, linear, losing as much energy as it does in waves this high; "
          "left out: without drag",
      .keys = {quantity("height", dim::length, "of the waves, at every frequency").positive().optional(),
               number("steepness", "height over length of the waves, at every frequency").positive().optional()},
      .groups = {{exactly_one, {"height", "steepness"}}}};
  return table;
}

const Table& ask_rao() {
  static const Table table{
      .title = "[ask.rao]",
      .meaning = "response per metre of wave amplitude",
      .keys = {range("periods", dim::time, "wave periods").positive().optional(),
               range("omega", dim::angular_velocity, "wave frequencies").positive().optional(),
               quantity("heading", dim::angle, "where the waves go; left out: the heading of [waves]").optional(),
               values(
                   "headings", dim::angle,
                   "where the waves go, several at once: \"0 deg .. 180 deg, 13 values\" or [\"0 deg\", \"30 deg\"]; "
                   "results gain a dimension")
                   .optional(),
               inner_table("drag", ask_rao_drag()).optional(), small_motions_about(), asked_signals()},
      .groups = {{exactly_one, {"periods", "omega"}}, {at_most_one, {"heading", "headings"}}}};
  return table;
}

const Table& ask_run() {
  static const Table table{
      .title = "[ask.run]",
      .meaning = "time series",
      .keys = {
          quantity("duration", dim::time, "of the run, a whole multiple of `every`").positive(),
          quantity("every", dim::time, "between stored samples").positive(),
          text("start",
               "\"as placed\"; in \"equilibrium\": where the bodies balance without waves; or \"steady\", for linear "
               "scenes: as if the sea had always been there, answered by transfer functions without a step")
              .one_of({"as placed", "equilibrium", "steady"})
              .or_default("as placed", "where the scene puts them is where they begin"),
          asked_signals()}};
  return table;
}

const Table& ask_modes() {
  static const Table table{
      .title = "[ask.modes]",
      .meaning = "free motions about rest: periods, damping, shapes",
      .keys = {quantity("shortest", dim::time, "no mode of a shorter period").positive().optional(),
               quantity("longest", dim::time, "no mode of a longer period").positive().optional(),
               small_motions_about()}};
  return table;
}

const Table& integrator() {
  static const Table table{
      .title = "[solve.integrator]",
      .meaning = "how time is stepped",
      .keys = {
          text("name",
               "of the method: generalized_alpha; energy_momentum keeps momentum, and energy of joints and weights, "
               "and damps "
               "nothing; explicit_pair, of orders 5 and 4, cuts steps by its own error; implicit_euler and "
               "semi_implicit_euler, of order 1, show what they cost; sundials_bdf is CVODE, in builds that have "
               "SUNDIALS")
              .one_of({"generalized_alpha", "energy_momentum", "explicit_pair", "implicit_euler", "semi_implicit_euler",
                       "sundials_bdf"})
              .or_default("generalized_alpha", "second order, damps only what the step cannot resolve"),
          number(
              "rho_infinity",
              "of generalized_alpha: spectral radius at infinite frequency: 1 damps nothing, 0 all at once; left out: "
              "0.8, which kills what is not resolved within some steps and leaves the rest alone, and 0 where "
              "something acts one way only: cables, tables, end stops, lines with `tension_only` that it steps")
              .within(Limit::fraction)
              .optional(),
          number(
              "tolerance",
              "of the local error of a step of bodies, relative to their speeds: steps are cut to meet it; left out: "
              "1e-8 for explicit_pair and sundials_bdf, whole steps for the others")
              .positive()
              .optional(),
          text("lines",
               "how each [[line]] is stepped; left out: energy_momentum, which keeps energy and lengths at any step")
              .one_of({"energy_momentum", "generalized_alpha", "gamma", "semi_implicit_euler", "explicit_euler"})
              .optional(),
          number("gamma", "share of the new state in a step of lines = \"gamma\"; left out: 0.51")
              .positive()
              .optional()}};
  return table;
}

}  // namespace

const Table& ask_table() {
  static const Table table{
      .title = "[ask]",
      .meaning = "what is wanted",
      .keys = {inner_table("rao", ask_rao()).optional(), inner_table("modes", ask_modes()).optional(),
               inner_table("run", ask_run()).optional(), inner_table("waves", ask_waves_table()).optional(),
               number("accuracy", "relative, of what is asked")
                   .within(Limit::open_fraction)
                   .or_default("1e-2", "about what coefficients and measurements are good for")},
      .groups = {{at_least_one, {"rao", "modes", "run", "waves"}}}};
  return table;
}

const Table& solve_table() {
  static const Table table{.title = "[solve]",
                           .meaning = "overrides what the program would choose; rarely needed",
                           .keys = {quantity("step", dim::time, "time step, or \"automatic\"")
                                        .positive()
                                        .one_of({"automatic"})
                                        .or_default("automatic", "chosen from the accuracy asked"),
                                    inner_table("integrator", integrator()).or_default("", "see its keys")}};
  return table;
}

}  // namespace froude::scene
