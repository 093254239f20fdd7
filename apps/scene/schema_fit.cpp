/// \file  The tables of a scene that fits coefficients to measurements.
#include "scene/schema.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

const Table& channels() {
  static const Table table{
      .title = "[data.channels]",
      .meaning = "which column of the files plays which part",
      .keys = {
          text("time", "all but towing: time").optional(),
          texts("force",
                "morison, towing, radiation with a position, friction ramp of a slider: measured force, positive along "
                "positive velocity: of the water on a fixed body, or what load cells carry; several columns are added "
                "up, and \"-F2\" is F2 turned round")
              .optional(),
          text("velocity", "morison: of the water, or of the body, whichever moves; where both move, of the body")
              .optional(),
          text("acceleration", "morison: as velocity; left out: from the velocity or position").optional(),
          text("position", "morison: as velocity, instead of it; decay, radiation: the motion").optional(),
          text(
              "cross_velocity",
              "morison, where water moves: velocity across both the force and the axis: drag is then sqrt(u^2 + w^2) u")
              .optional(),
          text("elevation",
               "morison, where water moves: surface at a probe, in place of the water's velocity; needs [model] wave")
              .optional(),
          text("water_velocity", "morison, both move: of the water where the body is").optional(),
          text("water_acceleration", "morison, both move: as water_velocity; left out: from it").optional(),
          text("angle", "decay, radiation: the motion, in place of a position").optional(),
          text("torque", "friction ramp of a hinge, and radiation with an angle: the measured torque").optional(),
          text("speed", "towing: speed of the carriage").optional(),
          text("speed_sd", "towing: standard deviation of the speed").optional(),
          text("force_sd", "towing: standard deviation of the force").optional()}};
  return table;
}

const Table& data_signal() {
  static const Table table{
      .title = "[[data.signal]]",
      .meaning = "motion: a column of the files, and what of a run it should be",
      .keys = {text("column", "of the files, with its unit"),
               text("of", "signal of the run: \"buoy.heave\", \"dropper.link2.polar\""),
               text("deviation", "standard deviation of the noise, \"0.5 deg\": weighs the columns")}};
  return table;
}

const Table& data() {
  static const Table table{
      .title = "[data]",
      .meaning = "the measurements",
      .keys =
          {texts("files", "CSV, relative to the scene; * stands for any characters of a file's name").optional(),
           text("runs",
                "morison, decay: CSV with one row for each run: the column file, and of morison any of zero, delay, "
                "diameter, length, density, viscosity and mass_beyond_load_cells, which then hold for that run; other "
                "columns are carried into the results")
               .optional(),
           inner_table("channels", channels()), inner_tables("signal", data_signal()).optional(),
           texts("calibration",
                 "morison: one CSV for each force channel, with columns force and voltage (and cycle, where there "
                 "are several): the channel is then in volts")
               .optional(),
           text("zero", "morison: CSV of a run at rest, with the same force channels: its mean is taken off")
               .optional()},
      .groups = {{Group::Count::exactly_one, {"files", "runs"}}}};
  return table;
}

const Table& outliers() {
  static const Table table{
      .title = "[prepare.outliers]",
      .meaning = "single samples far off their neighbours, which are bridged",
      .keys = {quantity("window", dim::time, "neighbours asked, half before and half after").positive(),
               number("deviations", "how far off, in deviations of the neighbours (from their medians), 3 at least")
                   .positive()
                   .or_default("8", "noise alone comes so far once in 1e15 samples")}};
  return table;
}

const Table& model_line() {
  static const Table table{
      .title = "[[model.line]]",
      .meaning =
          "morison: a force of one frequency beside drag and inertia (lift, vortices, a vibration), fitted with "
          "them so that it widens no interval",
      .keys = {quantity("frequency", dim::angular_velocity, "of the line").positive().optional(),
               number("multiple", "of the main frequency of the motion: 2 for lift").positive().optional()},
      .groups = {{Group::Count::exactly_one, {"frequency", "multiple"}}}};
  return table;
}

const Table& low_pass() {
  static const Table table{
      .title = "[prepare.low_pass]",
      .meaning = "low pass without delay, over force and model alike",
      .keys = {text("kind", "of filter"),
               quantity("cutoff", dim::angular_velocity, "frequency of half the amplitude").positive()},
      .chosen_by = "kind",
      .variants = {{.word = "butterworth",
                    .meaning = "recursive, forward and backward",
                    .keys = {integer("order", "of one pass, 1 to 10").or_default("4", "as steep as most need")}},
                   {.word = "symmetric weights",
                    .meaning = "finite: sinc under a Kaiser window of 60 dB, from half the cutoff to one and a half",
                    .keys = {}}}};
  return table;
}

const Table& notch() {
  static const Table table{
      .title = "[[prepare.notch]]",
      .meaning = "takes one line out: hum of the mains, a vibration of the structure",
      .keys = {quantity("centre", dim::angular_velocity, "frequency of the line").positive(),
               quantity("width", dim::angular_velocity, "between the frequencies of half the amplitude").positive()}};
  return table;
}

const Table& window() {
  static const Table table{
      .title = "[prepare.window]",
      .meaning = "the part of the record that is fitted",
      .keys = {text("kind", "of window")},
      .chosen_by = "kind",
      .variants = {
          {.word = "full cycles",
           .meaning = "cycles of full amplitude, found in the motion; build-up and run-down fall out",
           .keys = {integer("last", "so many of them; left out: all").optional(),
                    number("tolerance", "of amplitude and period, relative")
                        .within(Limit::open_fraction)
                        .or_default("0.03", "a build-up over three cycles takes a quarter each")}},
          {.word = "span",
           .meaning = "from one time to another",
           .keys = {quantity("from", dim::time, "first instant"), quantity("to", dim::time, "last instant")}}}};
  return table;
}

const Table& prepare() {
  static const Table table{
      .title = "[prepare]",
      .meaning =
          "steps between the measurement and a fit of kind \"morison\"; each is told in the report. A decay has "
          "longest_gap, outliers and a window of kind \"span\"",
      .keys = {
          quantity("longest_gap", dim::time, "rows missing no longer than this are bridged").positive().optional(),
          inner_table("outliers", outliers()).optional(),
          quantity("resample", dim::angular_velocity,
                   "\"50 Hz\": all channels are brought to this sampling rate, without delay; kept is what lies below "
                   "0.3 of the lower rate")
              .positive()
              .optional(),
          quantity("delay", dim::time, "of the force behind the motion: taken off, or estimated with the fit")
              .one_of({"estimate"})
              .optional(),
          quantity("delay_error", dim::time, "standard uncertainty of a delay that is given")
              .positive()
              .only_beside("delay")
              .optional(),
          quantity("longest_delay", dim::time, "where it is estimated: searched so far either way")
              .positive()
              .only_beside("delay")
              .optional(),
          quantity("derivative_bandwidth", dim::angular_velocity,
                   "of velocity and acceleration where they are derived; left out: five times the main frequency")
              .positive()
              .optional(),
          text("derivative_method",
               "how they are derived: a spline has less noise for the same bandwidth and gives up more at the ends; "
               "a Fourier series is for a motion that repeats from one end of the record to the other")
              .one_of({"local polynomial", "smoothing spline", "fourier series"})
              .or_default("local polynomial", "gives up the least where a motion does not repeat"),
          inner_table("low_pass", low_pass()).optional(), inner_tables("notch", notch()).optional(),
          quantity("moving_average", dim::time, "length of a mean over neighbours; a low pass does it better")
              .positive()
              .optional(),
          inner_table("window", window()).optional(),
          effect("mean_cycle",
                 "the window's cycles are laid over each other: the mean force is fitted to the mean motion; needs "
                 "window = full cycles")
              .optional()}};
  return table;
}

const Table& model_wave() {
  static const Table table{
      .title = "[model.wave]",
      .meaning = "from the surface at a probe to the water at the body, by linear waves of one direction",
      .keys = {
          quantity("depth", dim::length, "of the tank").one_of({"infinite"}).positive(),
          quantity("level", dim::length, "of the body's axis below still water").positive(),
          quantity("ahead", dim::length, "of the body in front of the probe, the way waves go")
              .or_default("0 m", "beside each other"),
          quantity("gravity", dim::acceleration, "acceleration of free fall")
              .positive()
              .or_default("9.81 m/s^2", "what hydrodynamic data are mostly computed with"),
          effect("regular", "the surface is one sinusoid, fitted to the probe: noise averages out, no ends are lost")
              .optional(),
          effect("follow",
                 "both move: the water is taken where the body is; its position counts along the waves from where "
                 "\"ahead\" puts it; needs the channel position")
              .optional()}};
  return table;
}

const Table& model_errors() {
  static const Table table{
      .title = "[model.uncertainty]",
      .meaning = "standard uncertainties of what the cylinder is taken for",
      .keys = {quantity("diameter", dim::length, "of the diameter").positive().optional(),
               quantity("length", dim::length, "of the length").positive().optional(),
               quantity("density", dim::density, "of the water's density").positive().optional(),
               quantity("mass", dim::mass, "of the mass beyond the load cells").positive().optional()}};
  return table;
}

const Table& model_water() {
  static const Table table{
      .title = "[model.water]",
      .meaning = "the water of the experiment",
      .keys = {quantity("density", dim::density, "of the water").positive(),
               quantity("viscosity", dim::kinematic_viscosity, "kinematic; gives the Reynolds number")
                   .positive()
                   .optional()}};
  return table;
}

const Table& model_parameter() {
  static const Table table{
      .title = "[[model.parameter]]",
      .meaning = "motion: a number of the scene that is fitted",
      .keys = {text("key", "its path: \"line.damping.linear\", \"body[1].initial.heave\", \"load.at.x\""),
               text("first", "where the search begins, \"0.001 kg/s\"; left out: what the scene writes").optional(),
               text("lowest", "bound, with its unit").optional(), text("highest", "bound, with its unit").optional()}};
  return table;
}

const Table& restored_body() {
  static const Table table{
      .title = "[model.body]",
      .meaning = "decay, radiation: what is known of the body, so that the water's part can be told",
      .keys = {quantity("mass", dim::mass, "of the body, for a position").within(Limit::not_negative).optional(),
               quantity("inertia", dim::inertia, "of the body about its axis, for an angle")
                   .within(Limit::not_negative)
                   .optional(),
               quantity("stiffness", dim::stiffness, "of water and springs, for a position")
                   .within(Limit::not_negative)
                   .optional(),
               quantity("rotational_stiffness", dim::rotational_stiffness, "of water and springs, for an angle")
                   .within(Limit::not_negative)
                   .optional(),
               number("mass_error", "standard uncertainty of mass or inertia, relative").positive().optional(),
               number("stiffness_error", "standard uncertainty of the stiffness, relative").positive().optional()},
      .groups = {{Group::Count::exactly_one, {"mass", "inertia"}},
                 {Group::Count::exactly_one, {"stiffness", "rotational_stiffness"}}}};
  return table;
}

std::vector<Key> with_cylinder(std::vector<Key> own) {
  std::vector<Key> keys{quantity("diameter", dim::length, "of the cylinder").positive(),
                        quantity("length", dim::length, "of the cylinder in the water").positive(),
                        inner_table("water", model_water())};
  keys.insert(keys.end(), own.begin(), own.end());
  return keys;
}

const Table& model() {
  static const Table table{
      .title = "[model]",
      .meaning = "what the measurement is taken for",
      .keys = {text("kind", "of experiment")},
      .chosen_by = "kind",
      .variants = {
          {.word = "morison",
           .meaning = "drag and inertia in unsteady flow (Morison et al., 1950)",
           .keys = with_cylinder(
               {text("motion",
                     "\"water moves\": waves on a fixed body; \"body moves\": forced oscillation in still water; "
                     "\"both move\": a body that moves in waves")
                    .one_of({"water moves", "body moves", "both move"}),
                quantity("mass_beyond_load_cells", dim::mass,
                         "where the body moves: all that the load cells accelerate, contained water included")
                    .within(Limit::not_negative)
                    .optional(),
                effect("linear_drag", "a drag that goes with the velocity is fitted as well").optional(),
                effect("offset", "a constant force is fitted as well").optional(),
                inner_tables("line", model_line()).optional(), inner_table("wave", model_wave()).optional(),
                inner_table("uncertainty", model_errors()).optional()})},
          {.word = "towing", .meaning = "drag at steady speed", .keys = with_cylinder({})},
          {.word = "motion",
           .meaning = "numbers of a scene of motion, by running it: what its run tells against what was measured",
           .keys = {text("scene", "the scene of motion, relative to this one"),
                    inner_tables("parameter", model_parameter()),
                    quantity("window", dim::time,
                             "the record is cut into pieces so long, each with a start of its own that is fitted too: "
                             "for long and for chaotic records; left out: one run from the scene's start")
                        .positive()
                        .optional(),
                    integer("starts",
                            "the search begins at so many points between the bounds, and the best end is kept; "
                            "left out: once")
                        .optional(),
                    integer("iterations", "steps of a search; one that has used them up tells no value")
                        .within(Limit::at_least_one)
                        .or_default("60", "most need five to twenty")}},
          {.word = "decay",
           .meaning = "period and damping of a body let go: x'' + b1 x' + b2 |x'| x' + b3 x'^3 + c sgn x' + w0^2 x = 0",
           .keys =
               {text("restoring", "by x, or by sin x for a pendulum")
                    .one_of({"linear", "sine"})
                    .or_default("linear", "small angles, and all that floats"),
                text("start",
                     "with memory among the coefficients: the record begins where the body was let go from rest in "
                     "calm water, with an empty radiation memory; or in motion, and what that memory holds is fitted")
                    .one_of({"let go from rest", "in motion"})
                    .optional(),
                inner_table("body", restored_body()).optional()}},
          {.word = "radiation",
           .meaning =
               "added mass and damping from forced oscillations in still water, one file each, and the poles of the "
               "memory that belongs to them",
           .keys = {inner_table("body", restored_body())}},
          {.word = "friction ramp",
           .meaning =
               "static and dynamic friction from a torque, or a force on a slider, that grows until the joint slips, "
               "one test each file",
           .keys = {
               quantity("ramp", dim::time, "before the slip: there the torque is taken as a straight line").positive(),
               quantity("slide", dim::time, "after it: there the torque is taken as constant").positive(),
               quantity("drop", dim::time, "that the fall between them may take, filters counted")
                   .within(Limit::not_negative)
                   .or_default("0 s", "a record that was not filtered")}}}};
  return table;
}

const Table& intervals() {
  static const Table table{.title = "[ask.intervals]",
                           .meaning = "how sure to be",
                           .keys = {number("level", "probability that the interval covers the truth")
                                        .within(Limit::open_fraction)
                                        .or_default("0.95", "the usual level"),
                                    text("method", "morison: how the residuals' memory is counted")
                                        .one_of({"effective samples", "cycle clusters", "block bootstrap"})
                                        .or_default("effective samples", "sharpest where residuals are stationary")}};
  return table;
}

const Table& ask() {
  static const Table table{
      .title = "[ask]",
      .meaning = "what is wanted of a fit",
      .keys = {
          texts("coefficients",
                "all but motion, where they are the parameters: drag cd, inertia cm, added mass ca; towing knows cd "
                "alone; decay: the damping terms that act, linear, "
                "quadratic, cubic, coulomb, and memory: a pair of poles of the water's")
              .one_of({"cd", "cm", "ca", "linear", "quadratic", "cubic", "coulomb", "memory"})
              .optional(),
          inner_table("intervals", intervals()).or_default("", "see its keys"),
          texts(
              "accept",
              "motion, towing, decay: checks whose failure shall not keep values back. \"residuals\": larger than the "
              "stated deviations allow, or of a decay than half of its variance; intervals are then as wide as the "
              "residuals make them, and the report says by how much")
              .one_of({"residuals"})
              .optional(),
          effect("robust", "morison: wild samples of the force pull less (Huber)").optional(),
          effect("profile",
                 "decay, motion: intervals of damping or parameters from the likelihood itself, which need not be "
                 "symmetric")
              .optional(),
          effect(
              "together",
              "decay: one set of coefficients for all runs, with a start and a rest position for each, beside the fit "
              "of each run alone")
              .optional(),
          effect("cycles", "morison: coefficients of each cycle too; needs [prepare] window in full cycles").optional(),
          text("law",
               "morison: coefficients of all runs against KC, Re or beta = Re/KC, with runs that differ by chance")
              .one_of({"constant", "kc", "re", "beta", "kc and re", "best"})
              .optional(),
          effect("sensitivity",
                 "morison: the fit repeated with other cutoffs, bandwidths and halves of the window; decay: with each "
                 "half of the record")
              .optional()}};
  return table;
}

}  // namespace

const Table& fit_schema() {
  static const Table table{
      .title = "a fit",
      .meaning = "coefficients from measurements",
      .keys = {integer("schema", "version of this grammar, 1"), text("title", "for people").optional(),
               inner_table("data", data()), inner_table("prepare", prepare()).optional(), inner_table("model", model()),
               inner_table("ask", ask())}};
  return table;
}

}  // namespace froude::scene
