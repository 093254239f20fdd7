// The command line of froude: words in, calls of commands.hpp out.
#include "froude/program.hpp"

#include <algorithm>
#include <memory>

#include "froude/bem_options.hpp"
#include "froude/command_line.hpp"
#include "froude/described.hpp"
#include "froude/experiment_options.hpp"
#include "froude/export_options.hpp"
#include "froude/film_options.hpp"
#include "froude/kept_fits.hpp"
#include "froude/path_options.hpp"
#include "froude/sweep_options.hpp"
#include "froude/validate_options.hpp"
#include "froude/watched_hulls.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/units.hpp"
#include "scene/placed.hpp"

namespace froude {
namespace {

void add_new(CLI::App& app, Request& request) {
  auto* command = app.add_subcommand("new", "writes a commented starter scene, or prints the reference of all keys");
  command->footer("Examples:\n  froude new motion -o scene.toml\n  froude new --keys");
  auto kind = std::make_shared<std::string>();
  auto output = std::make_shared<std::optional<Path>>();
  auto keys = std::make_shared<bool>(false);
  command->add_option("kind", *kind, "of scene: motion, waves or fit; motion if left out");
  command->add_option("-o,--output", *output, "file to write; standard output if left out");
  command->add_flag("--keys", *keys, "print every key that a scene may hold, as Markdown");
  command->callback([=, &request] {
    request.call = [=](const Console& console) {
      new_scene(*kind, *output, *keys, console);
      return done;
    };
  });
}

/// What commands that answer scenes share.
void add_scene_outputs(CLI::App& command, const std::string& name, SceneArguments& arguments) {
  command.add_option("-o,--output", arguments.output, "result, HDF5 and netCDF-4; default: SCENE." + name + ".h5 here");
  command.add_option("--csv", arguments.csv, "the same numbers as a CSV table");
  command.add_option("--picture", arguments.picture, "plot (.svg, .png, .pdf)");
}

/// `modes`, `run` and `plan` take the same words.
CLI::App* add_scene_command(CLI::App& app, Request& request, const std::string& name, const std::string& what,
                            void (*function)(const SceneArguments&, const Console&), bool has_outputs) {
  auto* command = app.add_subcommand(name, what);
  command->footer("Example:\n  froude " + name + " examples/pontoon5.toml" +
                  (has_outputs ? " -o " + name + ".h5 --picture " + name + ".svg" : ""));
  auto arguments = std::make_shared<SceneArguments>();
  command->add_option("scene", arguments->scene, "scene file (.toml)")->required();
  if (has_outputs) add_scene_outputs(*command, name, *arguments);
  calls(*command, request, arguments, function);
  return command;
}

void add_rao(CLI::App& app, Request& request) {
  auto* command = app.add_subcommand("rao", "response amplitude operators of a scene, in the frequency domain");
  command->footer(
      "Examples:\n  froude rao examples/pontoon5.toml -o rao.h5 --picture rao.svg\n"
      "  froude rao examples/headings.toml --refine --nondimensional\n  froude rao examples/hinged.toml --check time");
  auto arguments = std::make_shared<RaoArguments>();
  command->add_option("scene", arguments->scene, "scene file (.toml)")->required();
  add_scene_outputs(*command, "rao", *arguments);
  command
      ->add_option("--threads", arguments->threads,
                   "which share the frequencies; the numbers are the same with any; default: all processors")
      ->check(CLI::PositiveNumber);
  command->add_flag(
      "--refine", arguments->refine,
      "put frequencies between those asked for until straight lines between them are within [ask] accuracy");
  command->add_flag("--nondimensional", arguments->nondimensional,
                    "rotations over the slope of the wave, theta/(k zeta); translations over its amplitude");
  command
      ->add_option("--check", arguments->check,
                   "time: hold responses at three frequencies against runs in regular waves, and tell what they ignore")
      ->check(CLI::IsMember({"time"}));
  command
      ->add_option("--check-steepness", arguments->check_steepness,
                   "height over length of the waves of --check; left out: those of [ask.rao.drag], else 0.002")
      ->check(CLI::Range(1e-6, 0.1));
  calls(*command, request, arguments, rao);
}

void add_stability(CLI::App& app, Request& request) {
  auto* command =
      app.add_subcommand("stability", "periodic motions in regular waves, a map over period and height: do they last");
  command->footer("Example:\n  froude stability examples/buoy.toml -o map.h5 --picture map.svg --check time");
  auto arguments = std::make_shared<StabilityArguments>();
  auto duration = std::make_shared<std::string>("2400 s");
  command->add_option("scene", arguments->scene, "scene file (.toml)")->required();
  add_scene_outputs(*command, "stability", *arguments);
  command->add_option("--boundaries", arguments->boundaries,
                      "both boundaries as a CSV table of points, to be drawn upon other pictures");
  command
      ->add_option("--check", arguments->check,
                   "time: step some cells from rest, and tell whether the map has them right")
      ->check(CLI::IsMember({"time"}));
  command->add_option("--check-cells", arguments->check_cells, "how many, spread over periods and heights")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--check-duration", *duration, "of each run, whose last fifth is compared")
      ->capture_default_str();
  command->callback([=, &request] {
    request.call = [=](const Console& console) {
      arguments->check_duration = *parsed("--check-duration", *duration, hydro::dim::time);
      hydro::require(arguments->check_duration > 0, "--check-duration must be positive, got {} s",
                     arguments->check_duration);
      stability(*arguments, console);
      return done;
    };
  });
}

void add_field(CLI::App& app, Request& request) {
  auto* command = app.add_subcommand(
      "field", "the free surface about bodies of cylinders or meshes in one regular wave, on a grid");
  command->footer("Example:\n  froude field examples/farm.toml -o field.h5 --picture field.png");
  auto arguments = std::make_shared<FieldArguments>();
  command->add_option("scene", arguments->scene, "scene file (.toml)")->required();
  add_scene_outputs(*command, "field", *arguments);
  command->add_option("--pressure-csv", arguments->pressure_csv,
                      "pressures on hulls as a CSV table, one row for each panel; the scene asks for them");
  calls(*command, request, arguments, field);
}

void add_waves(CLI::App& app, Request& request) {
  auto* waves = app.add_subcommand("waves", "seas: what they are, and series of the water's motion");
  waves->require_subcommand(1);
  auto* info = waves->add_subcommand("info", "heights, periods, steepness, breaking and focus of a sea");
  info->footer(
      "Examples:\n  froude waves info examples/waves/storm.toml\n  froude waves info components.csv --depth \"30 m\"\n"
      "  froude waves info record.csv --column gauge1");
  auto arguments = std::make_shared<WavesInfoArguments>();
  auto depth = std::make_shared<std::string>("infinite"), gravity = std::make_shared<std::string>("9.81 m/s^2");
  auto phase_of = std::make_shared<std::string>("omega t - k x");
  info->add_option("file", arguments->file,
                   "scene (.toml); CSV of components, of a spectrum or of a record; result of `froude waves make`")
      ->required();
  info->add_option("--depth", *depth, "of the water, where the file is no scene: \"30 m\" or infinite")
      ->capture_default_str();
  info->add_option("--gravity", *gravity, "where the file is no scene")->capture_default_str();
  info->add_option("--column", arguments->column, "of a record; default: elevation");
  info->add_option("--phase-of", *phase_of, "what the phases of a list are added to")
      ->check(CLI::IsMember({"omega t - k x", "k x - omega t"}))
      ->capture_default_str();
  info->callback([=, &request] {
    request.call = [=](const Console& console) {
      if (*depth != "infinite")
        arguments->depth = hydro::WaterDepth::from_metres(*parsed("--depth", *depth, hydro::dim::length));
      arguments->gravity = *parsed("--gravity", *gravity, hydro::dim::acceleration);
      arguments->phase_of_kx = *phase_of == "k x - omega t";
      waves_info(*arguments, console);
      return done;
    };
  });
  add_scene_command(*waves, request, "make", "time series of the water at the probes of a scene", &waves_make, true)
      ->footer(
          "Example:\n  froude waves make examples/waves/storm.toml -o storm.h5 --csv storm.csv --picture storm.svg");
}

/// Options of `froude hydrostatics` as they were written.
struct HydrostaticsTexts {
  std::string density, gravity = "9.81 m/s^2", unit, freeboard, mass, cog, reference, heave, heel = "0 deg",
                       trim = "0 deg", heels = "0 deg .. 80 deg, 17 values";
};

void read_hydrostatics(const HydrostaticsTexts& texts, HydrostaticsArguments& arguments) {
  namespace dim = hydro::dim;
  const auto vector = [](const std::string& option, const std::string& text) -> std::optional<Eigen::Vector3d> {
    if (text.empty()) return std::nullopt;
    return scene::placed({.file = option}, [&] { return hydro::parse_vector(text, dim::length); });
  };
  arguments.water.density = *parsed("--density", texts.density, dim::density);
  arguments.water.gravity = *parsed("--gravity", texts.gravity, dim::acceleration);
  hydro::require(arguments.water.density > 0 && arguments.water.gravity > 0,
                 "--density and --gravity must be positive");
  if (!texts.unit.empty()) arguments.options.unit = parsed("--unit", "1 " + texts.unit, dim::length);
  arguments.freeboard = parsed("--freeboard", texts.freeboard, dim::length);
  arguments.mass = parsed("--mass", texts.mass, dim::mass);
  arguments.centre_of_gravity = vector("--cog", texts.cog);
  arguments.reference = vector("--reference", texts.reference);
  arguments.heave = parsed("--heave", texts.heave, dim::length);
  arguments.heel = hydro::Angle::from_radians(*parsed("--heel", texts.heel, dim::angle));
  arguments.trim = hydro::Angle::from_radians(*parsed("--trim", texts.trim, dim::angle));
  scene::placed({.file = "--gz"}, [&] { arguments.heels = hydro::parse_range(texts.heels, dim::angle); });
}

void add_hydrostatics(CLI::App& app, Request& request) {
  auto* command = app.add_subcommand(
      "hydrostatics", "volume, centres, waterplane, restoring matrix, GM and righting arms of a hull given as a mesh");
  command->footer(
      "Example:\n  froude hydrostatics examples/data/workboat.obj --density \"1025 kg/m^3\" --mass \"50 t\"\n"
      "    --cog \"(-0.75, 0, 0.2) m\" --free-trim --picture gz.svg");
  auto arguments = std::make_shared<HydrostaticsArguments>();
  auto texts = std::make_shared<HydrostaticsTexts>();
  command->add_option("mesh", arguments->mesh, "the hull: .stl, .obj or .gdf; z up, z = 0 the water as it is drawn")
      ->required();
  command->add_option("--density", texts->density, "of the water: \"1025 kg/m^3\"")->required();
  command->add_option("--gravity", texts->gravity, "of the place")->capture_default_str();
  command->add_option("--mass", texts->mass, "\"50 t\": the hull floats where it wants to; left out: it is as drawn");
  command->add_option("--cog", texts->cog, "centre of gravity as drawn: \"(-0.75, 0, 0.2) m\"; for GM and GZ");
  command->add_option("--unit", texts->unit, "of the numbers of the mesh: mm, cm, in, ft; metres if left out");
  command->add_flag("--reverse", arguments->options.reverse, "turn the faces of the mesh inside out");
  command->add_option("--freeboard", texts->freeboard,
                      "draw walls and a deck above a hull that ends at the water: \"2 m\"");
  command->add_option("--reference", texts->reference, "point of C, global; the origin if left out");
  command->add_option("--heave", texts->heave, "lift of the drawn hull, without --mass");
  command->add_option("--heel", texts->heel, "starboard down; with --mass where the search begins")
      ->capture_default_str();
  command->add_option("--trim", texts->trim, "bow down; with --mass where the search begins")->capture_default_str();
  command->add_option("--gz", texts->heels, "heels of the righting arms")->capture_default_str();
  command->add_flag("--free-trim", arguments->free_trim, "let the hull trim as it heels");
  command->add_option("--picture", arguments->picture, "plot of the righting arms (.svg, .png, .pdf)");
  command->callback([=, &request] {
    request.call = [=](const Console& console) {
      read_hydrostatics(*texts, *arguments);
      hydrostatics(*arguments, console);
      return done;
    };
  });
}

/// Named and ordered as in [prepare] of a fit.
void add_steps(CLI::App& command, StepArguments& steps) {
  const char* group = "Steps before, as a fit has them";
  const auto add = [&](const char* name, auto& value, const char* meaning) {
    return command.add_option(name, value, meaning)->group(group);
  };
  add("--longest-gap,--gaps", steps.longest_gap, "rows missing no longer than this are bridged: \"0.5 s\"");
  add("--outliers", steps.outliers,
      "single samples far off their neighbours are bridged; window that is asked: \"1 s\"");
  add("--outlier-deviations", steps.outlier_deviations, "how far off, in deviations of the neighbours, 3 at least [8]");
  command.add_flag("--levels", steps.through_levels, "coarse channels become the curve through their levels")
      ->group(group);
  add("--resample", steps.resample, "another sampling rate, without delay: \"20 Hz\"");
  command.add_flag("--detrend", steps.detrend, "the slope of the straight line of least squares is taken off")
      ->group(group);
  add("--notch", steps.notch, "takes a line out; centre and width between half amplitudes: \"50 Hz, 2 Hz\"")
      ->allow_extra_args(false);
  add("--moving-average", steps.moving_average, "mean over neighbours; a low pass does it better: \"0.05 s\"");
  add("--low-pass", steps.low_pass, "without delay; frequency of half the amplitude: \"2 Hz\"");
  add("--low-pass-kind", steps.low_pass_kind,
      "butterworth, chebyshev, gaussian or \"symmetric weights\" [butterworth]");
  add("--low-pass-order", steps.low_pass_order, "of one pass, to 10, of the first two kinds [4]");
  add("--low-pass-ripple", steps.low_pass_ripple, "share of the amplitude by which chebyshev wavers [0.005]");
  add("--band-pass", steps.band_pass, "without delay; frequencies of half the amplitude: \"0.05 Hz, 0.5 Hz\"");
  add("--wave-frequency", steps.wave_frequency, "instead: a band-pass from 0.2 to 4 times it: \"0.125 Hz\"");
}

void add_prepare(CLI::App& app, Request& request) {
  auto* command = app.add_subcommand("prepare", "a record after the steps that a fit has, with rates of its signals");
  command->footer(
      "Example:\n  froude prepare swing.csv --levels --rate angle --bandwidth \"4 Hz\" -o prepared.csv --picture "
      "prepared.svg");
  auto arguments = std::make_shared<PrepareArguments>();
  command->add_option("file", arguments->file, "CSV with units in its header, or a result of `froude run`")->required();
  command->add_option("-s,--signal", arguments->signals, "signals to take; * stands for any text; default: all");
  command->add_option("--from", arguments->from, "leave out what comes before: \"60 s\"");
  command->add_option("--to", arguments->to, "leave out what comes after: \"360 s\"");
  add_steps(*command, arguments->steps);
  command->add_option("--rate", arguments->rates, "signals whose rate is added; * stands for any text");
  command->add_option("--bandwidth", arguments->bandwidth,
                      "to which rates are right within 1 %; left out: five times the main frequency");
  command->add_option("-o,--output", arguments->output, "table (.csv)")->required();
  command->add_option("--picture", arguments->picture, "plot (.svg, .png, .pdf)");
  calls(*command, request, arguments, prepare);
}

void add_psd(CLI::App& app, Request& request) {
  auto* command = app.add_subcommand("psd", "power spectra with confidence intervals, transfer functions, coherence");
  command->footer(
      "Example:\n  froude psd run.h5 --signal m3.heave --segment \"100 s\" --from \"60 s\" --picture psd.svg");
  auto arguments = std::make_shared<PsdArguments>();
  command->add_option("file", arguments->file, "CSV with units in its header, or a result of `froude run`")->required();
  command->add_option("-s,--signal", arguments->signals, "signals to take; * stands for any text; default: all");
  command->add_option("--segment", arguments->segment, "length of a Welch segment: \"100 s\"");
  command->add_flag("--uneven", arguments->uneven, "the record has gaps, or samples at uneven times (Lomb-Scargle)");
  command->add_option("--tapers", arguments->tapers, "instead of segments: so many sine tapers over the whole record");
  command->add_option("--from", arguments->from, "leave out what comes before: \"60 s\"");
  command->add_option("--to", arguments->to, "leave out what comes after: \"360 s\"");
  add_steps(*command, arguments->steps);
  command->add_option("--confidence", arguments->confidence, "level of the interval")->capture_default_str();
  command->add_option("--input", arguments->input,
                      "signal that drives the others: adds transfer function and coherence");
  command->add_option("-o,--output", arguments->output, "table (.csv) or result (.h5)");
  command->add_option("--picture", arguments->picture, "plot (.svg, .png, .pdf)");
  calls(*command, request, arguments, psd);
}

void add_sn_curve(CLI::App& command, SnArguments& sn) {
  command.add_option("--sn-range", sn.range, "S-N curve: a range, in the unit of the signal: \"50 MPa\"");
  command.add_option("--sn-cycles", sn.cycles, "how often it comes until failure: 1e7");
  command.add_option("--sn-slope", sn.slope, "m of N = cycles (S/range)^-m: 3");
  command.add_option("--sn-slope-below", sn.slope_below, "m of smaller ranges, if it is another: 5");
}

void add_fatigue(CLI::App& app, Request& request) {
  auto* command = app.add_subcommand("fatigue", "rainflow cycles of a record and their damage by an S-N curve");
  command->footer(
      "Example:\n  froude fatigue run.h5 --signal connector1.force --sn-range \"80 kN\" --sn-cycles 1e6 --sn-slope 3 "
      "--picture cycles.svg");
  auto arguments = std::make_shared<FatigueArguments>();
  command->add_option("file", arguments->file, "CSV with units in its header, or a result of `froude run`")->required();
  command->add_option("-s,--signal", arguments->signal, "whose cycles are counted")->required();
  command->add_option("--from", arguments->from, "leave out what comes before: \"60 s\"");
  add_sn_curve(*command, arguments->sn);
  command->add_option("--accept", arguments->accept, "what is refused otherwise: stop (a sensor at its stop)")
      ->allow_extra_args(false);
  command->add_option("-o,--output", arguments->output, "range, mean and count of each cycle (.csv)");
  command->add_option("--picture", arguments->picture, "plot (.svg, .png, .pdf)");
  calls(*command, request, arguments, fatigue);
}

void add_extremes(CLI::App& app, Request& request) {
  auto* command = app.add_subcommand(
      "extremes", "largest values that a record lets one expect: peaks over a threshold, maxima of blocks");
  command->footer("Example:\n  froude extremes run.h5 --signal chain1.tension --duration \"3 h\" --picture peaks.svg");
  auto arguments = std::make_shared<ExtremesArguments>();
  command->add_option("file", arguments->file, "CSV with units in its header, or a result of `froude run`")->required();
  command->add_option("-s,--signal", arguments->signal, "whose largest values are told")->required();
  command->add_flag("--lowest", arguments->lowest, "lowest values in their place");
  command->add_option("--duration", arguments->duration, "over which they are told")->capture_default_str();
  command->add_option("--threshold", arguments->threshold, "peaks above it make the tail: \"2 m\"");
  command->add_option("--block", arguments->block, "length of the blocks: \"10 min\"");
  command->add_option("--quantile", arguments->quantiles, "probability of staying below; several times for several");
  command->add_option("--confidence", arguments->confidence, "level of the interval")->capture_default_str();
  add_steps(*command, arguments->steps);
  command->add_option("--from", arguments->from, "leave out what comes before: \"60 s\"");
  command
      ->add_option("--accept", arguments->accept,
                   "what is refused otherwise: stop (a sensor at its stop), drift (of the record), tail (a law that "
                   "ends below the record's own largest value)")
      ->allow_extra_args(false);
  command->add_option("-o,--output", arguments->output, "the peaks (.csv)");
  command->add_option("--picture", arguments->picture, "plot (.svg, .png, .pdf)");
  calls(*command, request, arguments, extremes);
}

void add_response(CLI::App& app, Request& request) {
  auto* command = app.add_subcommand(
      "response",
      "spectra of responses in the sea of a scene: statistics, largest values, fatigue, a lifetime of seas");
  command->footer(
      "Examples:\n  froude response examples/seastate.toml --duration \"3 h\" --picture response.svg\n"
      "  froude response examples/seastate.toml --scatter examples/data/scatter.csv --duration \"219150 h\"");
  auto arguments = std::make_shared<ResponseArguments>();
  command->add_option("scene", arguments->scene, "scene file (.toml) with [waves] of a spectrum and [ask] rao")
      ->required();
  command->add_option("--duration", arguments->duration, "for which largest values are told")->capture_default_str();
  command->add_option("--quantile", arguments->quantiles, "of the largest value; several by repeating it")
      ->capture_default_str();
  add_sn_curve(*command, arguments->sn);
  command->add_option("--scatter", arguments->scatter,
                      "seas of a lifetime (.csv): columns hs, tp and share, how often each comes");
  command->add_option("-o,--output", arguments->output, "spectra; of a scatter diagram exceedances (.csv)");
  command->add_option("--picture", arguments->picture, "plot of the same (.svg, .png, .pdf)");
  command
      ->add_option("--check", arguments->check,
                   "time: hold deviations, periods and largest values against runs of the sea, one a seed")
      ->check(CLI::IsMember({"time"}));
  command->add_option("--check-runs", arguments->check_runs, "how many, each of --duration")
      ->check(CLI::Range(2, 10000))
      ->capture_default_str();
  calls(*command, request, arguments, response);
}

void add_fit(CLI::App& app, Request& request) {
  auto* command = app.add_subcommand("fit", "force coefficients from measurements, with intervals that hold");
  command->footer("Example:\n  froude fit examples/fit/oscillation.toml -o coefficients.toml --picture fit.svg");
  auto arguments = std::make_shared<FitArguments>();
  command->add_option("scene", arguments->scene, "fit scene (.toml)")->required();
  command->add_option("-o,--output", arguments->output, "the estimates (.toml)");
  command->add_option("--table", arguments->table,
                      "one row for each run: KC, Re, beta, coefficients, intervals (.csv)");
  command->add_option("--picture", arguments->picture, "plot (.svg, .png, .pdf)");
  auto* predict = command->add_flag("--predict", arguments->predict,
                                    "fit nothing: compare the records with a run of the scene, kind \"motion\"");
  command->add_option("--at", arguments->at, "values of an earlier fit (.toml), of its -o; left out: the scene's")
      ->needs(predict);
  calls(*command, request, arguments, fit);
}

void add_report(CLI::App& app, Request& request) {
  auto* command = app.add_subcommand("report", "results as one HTML file: figures, tables, an animation in space");
  command->footer(
      "Examples:\n  froude report run.h5 rao.h5 -o report.html\n"
      "  froude report before.h5 after.h5 --from \"60 s\" -o compared.html\n"
      "  froude report examples/fit/oscillation.toml -o fit.html");
  auto arguments = std::make_shared<ReportArguments>();
  command
      ->add_option("results", arguments->results,
                   "of run, rao, modes, field, waves make or psd (.h5), of psd or response (.csv), folders of sweeps, "
                   "estimates of fit (.toml), or a fit scene, which is then fitted")
      ->required();
  command->add_option("-o,--output", arguments->output, "the report (.html)")->required();
  command->add_option("--from", arguments->from,
                      "statistics and spectra of runs leave out what comes before: \"60 s\"");
  command->add_option("--scene-folder", arguments->scene_folder,
                      "where the scenes stood, whose meshes and data the animation and the plan need; left out: beside "
                      "each result");
  calls(*command, request, arguments, report_results);
}

void add_cost(CLI::App& app, Request& request) {
  auto* command = app.add_subcommand("cost", "what accuracy costs: error and time of a scene's approximations");
  command->footer(
      "Example:\n  froude cost examples/pontoon5.toml --tolerance 1e-2 --picture cost.svg -o examples/cheaper.toml");
  auto arguments = std::make_shared<CostArguments>();
  command->add_option("scene", arguments->scene, "scene file (.toml)")->required();
  command->add_option("--tolerance", arguments->tolerance, "names the cheapest settings with at most this error: 1e-2");
  command
      ->add_option("--by", arguments->by,
                   "what the error of a run is: rms of the difference, or difference of deviation, extreme or range")
      ->check(CLI::IsMember({"rms", "deviation", "extreme", "range"}))
      ->capture_default_str();
  command->add_option("-o,--output", arguments->output, "the scene with these settings, beside the scene (.toml)");
  command->add_option("--picture", arguments->picture, "plot (.svg, .png, .pdf)");
  calls(*command, request, arguments, cost);
}

void add_kinematics(CLI::App& app, Request& request) {
  auto* command = app.add_subcommand(
      "kinematics", "places, velocities and accelerations of a track's markers and angles of lines, by a smoother");
  command->footer(
      "Example:\n  froude kinematics examples/fit/film_track.toml --bandwidth \"4 Hz\" -o motion.csv --picture "
      "motion.svg");
  auto arguments = std::make_shared<KinematicsArguments>();
  command->add_option("scene", arguments->scene, "fit scene (.toml) of kind \"motion\" with [camera]")->required();
  command->add_option("--film", arguments->film,
                      "which track of a scene with several: the name of its [[data.record]], or of its file without "
                      "the ending");
  command->add_option("--bandwidth", arguments->bandwidth,
                      "what moves slower keeps 99 % and more: \"4 Hz\"; needed but for --space and --second");
  command->add_option(
      "--length", arguments->lengths,
      "a distance that stays, and its deviation: \"pivot joint 0.5 m 0.5 mm\"; several by repeating it");
  auto* record = command->add_option("--record", arguments->record,
                                     "CSV of another clock that shows a signal of the scene, too: how late is it?");
  command->add_option("--record-time", arguments->record_time, "its column of time")->capture_default_str();
  record->needs(command->add_option("--match", arguments->match,
                                    "a signal of the scene and a column of the record: \"chain.link1.polar = angle\""));
  command
      ->add_option("--longest", arguments->longest,
                   "the offset is known to lie so far about --around: another swing is then not looked for")
      ->needs(record);
  command->add_option("--around", arguments->around, "[camera] offset that is known nearly; left out: 0 s")
      ->needs("--longest");
  command->add_option("--sign", arguments->sign, "the column is known to go as the signal, or against it")
      ->check(CLI::IsMember({"same", "opposite"}))
      ->needs(record);
  auto* start = command->add_option("--start", arguments->start,
                                    "the scene of motion whose bodies begin as filmed, or, with --nodes, a table "
                                    "[line.start] for it (.toml)");
  start->needs(command->add_option("--start-at", arguments->start_at, "the time of it: \"1.2 s\" of the track"));
  command->add_option("--nodes", arguments->nodes, "markers at the line's free nodes, in their order: \"joint, bob\"")
      ->needs(start);
  command->add_option("--release", arguments->release, "a marker that is let go: when?");
  command->add_option("-o,--output", arguments->output, "table with standard deviations (.csv)")->required();
  command->add_option("--picture", arguments->picture, "plot (.svg, .png, .pdf)");
  auto* space = command->add_flag("--space", arguments->space,
                                  "six motions of bodies frame by frame, by the lens and four markers on each");
  auto* second = command->add_option("--second", arguments->second,
                                     "another camera: a film of the scene, by its name, or a fit scene of its own: "
                                     "places in space of the markers that both saw");
  for (const char* of_smoothing : {"--bandwidth", "--length", "--record", "--start", "--release", "--picture"}) {
    space->excludes(of_smoothing);
    second->excludes(of_smoothing);
  }
  space->excludes(second);
  calls(*command, request, arguments, kinematics);
}

/// Words of the command line without that of the command; only flags stand before it.
std::vector<std::string> without(const std::string& command, std::vector<std::string> words) {
  words.erase(std::find(words.begin(), words.end(), command));
  return words;
}

/// Commands that are programs of their own: they get the words as they stand, once these are read without an error.
void add_other_programs(CLI::App& app, Request& request, const std::vector<std::string>& words) {
  const auto films = [words](const char* command) {
    return [=](const auto&, const Console&) {
      std::vector<std::string> arguments = without(command, words);
      arguments.insert(arguments.begin(), command);
      about_films(std::move(arguments));
    };
  };
  add_films(app, request, {.track = films("track"), .calibrate = films("calibrate"), .film = films("film")});
  describe_validate(*app.add_subcommand("validate"), request,
                    [words](const ValidateArguments&, const Console&) -> int { validate(without("validate", words)); });
}

void describe(CLI::App& app, Request& request, const std::vector<std::string>& words) {
  app.description("Floating and submerged structures in waves: RAOs, time series, spectra, fitted coefficients.");
  app.footer(
      "Examples:\n  froude new -o scene.toml\n  froude rao scene.toml --picture rao.svg\n  froude run scene.toml -o "
      "run.h5\n"
      "Exit status: 0 done, 1 a check failed, 2 the input is wrong, 3 the numerics gave up, 4 a fault of froude, "
      "130 and 143 ended by SIGINT and SIGTERM.");
  app.fallthrough();
  app.require_subcommand(1);
  add_common_flags(app, request);
  add_new(app, request);
  add_bem(app, request);
  add_rao(app, request);
  add_scene_command(app, request, "modes", "free motions of a scene about rest: periods, damping, shapes", &modes,
                    true);
  add_stability(app, request);
  add_field(app, request);
  add_scene_command(app, request, "run", "time series of a scene", &run, true);
  add_waves(app, request);
  add_hydrostatics(app, request);
  add_psd(app, request);
  add_prepare(app, request);
  add_poincare(app, request);
  add_trajectory(app, request);
  add_snapshot(app, request);
  add_response(app, request);
  add_fatigue(app, request);
  add_extremes(app, request);
  add_fit(app, request);
  add_kinematics(app, request);
  add_scene_command(app, request, "plan", "what a scene will run, by which method, and why the rest will not", &plan,
                    false);
  add_experiment(app, request);
  add_report(app, request);
  add_export(app, request);
  add_cost(app, request);
  add_sweep(app, request, sweep_scenes);
  add_other_programs(app, request, words);
  add_described(app, request);
}

/// True if this process shares a sweep with others: froude-ranks takes it, before its options are read.
bool is_one_of_several(const std::vector<std::string>& words) {
  const auto command =
      std::find_if_not(words.begin(), words.end(), [](const std::string& word) { return word.starts_with('-'); });
  return command != words.end() && *command == "sweep" && is_shared_among_ranks(words);
}

}  // namespace

int run_program(int argc, char** argv) {
  Request request;
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (is_one_of_several(words)) {
    request.json = std::find(words.begin(), words.end(), "--json") != words.end();
    request.call = [&](const Console&) -> int { sweep_among_ranks(words); };
    return carry_out(request);
  }
  CLI::App app;
  app.name("froude");
  describe(app, request, words);
  app.final_callback([&request] {
    request.call = [call = std::move(request.call)](const Console& console) {
      keep_fits_in(users_folder_of_fits());
      const WatchedHulls watched(console);
      return call(console);
    };
  });
  return carry_out(app, request, argc, argv);
}

}  // namespace froude
