#include "froude/bem_options.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>

#include "hydro/base/error.hpp"
#include "hydro/base/units.hpp"
#include "scene/placed.hpp"

namespace froude {
namespace {

/// Units are read when the command runs, so that a wrong one is told like any other wrong input.
struct BemOptionTexts {
  std::string density, gravity, depth, ulen;
  int iperout = 0;
};

hydro::potential::ReadOptions read_options(const BemOptionTexts& texts) {
  hydro::potential::ReadOptions options;
  options.density = parsed("--density", texts.density, hydro::dim::density);
  options.gravity = parsed("--gravity", texts.gravity, hydro::dim::acceleration);
  if (texts.depth == "infinite") {
    options.depth = hydro::WaterDepth::infinite();
  } else if (const auto depth = parsed("--depth", texts.depth, hydro::dim::length)) {
    options.depth = hydro::WaterDepth::from_metres(*depth);
  }
  if (const auto ulen = parsed("--ulen", texts.ulen, hydro::dim::length)) {
    hydro::require(*ulen > 0, "--ulen must be positive, got {} m", *ulen);
    options.ulen = *ulen;
  }
  if (texts.iperout > 0) options.iperout = texts.iperout;
  return options;
}

/// The options shared by all `froude bem …`; the values live as long as the returned pointer is held by a callback.
std::shared_ptr<BemOptionTexts> add_bem_options(CLI::App& command, const std::shared_ptr<BemArguments>& arguments) {
  auto texts = std::make_shared<BemOptionTexts>();
  command
      .add_option(
          "files", arguments->files,
          "data files: WAMIT .1 or stem, Capytaine .nc, NEMOH folder, AQWA .AH1, HAMS ControlFile.in, VERES .re7, "
          ".hdb, BEMIO .h5, Froude .h5")
      ->required();
  command.add_option("--density", texts->density, "of the water, where the file does not say: \"1025 kg/m^3\"");
  command.add_option("--gravity", texts->gravity, "where the file does not say: \"9.81 m/s^2\"");
  command.add_option("--depth", texts->depth, "of the water, where the file does not say: \"14 m\" or infinite");
  command.add_option("--ulen", texts->ulen, "WAMIT's length scale ULEN: \"1 m\"");
  command.add_option("--iperout", texts->iperout, "WAMIT's IPEROUT: 1 period, 2 omega, 3 KL, 4 nu L")
      ->check(CLI::Range(1, 4));
  return texts;
}

void add_bem_info(CLI::App& bem, Request& request) {
  auto* info = bem.add_subcommand("info", "what a file of coefficients holds, after conversion to one convention");
  info->footer("Example:\n  froude bem info examples/data/pontoon1.nc");
  auto arguments = std::make_shared<BemArguments>();
  auto texts = add_bem_options(*info, arguments);
  info->callback([=, &request] {
    request.call = [=](const Console& console) {
      arguments->options = read_options(*texts);
      bem_info(*arguments, console);
      return done;
    };
  });
}

void add_bem_check(CLI::App& bem, Request& request) {
  auto* check = bem.add_subcommand("check", "symmetry, damping sign, causality and more; status 1 if a check fails");
  check->footer(
      "Example:\n  froude bem check buoy.1 --density \"1025 kg/m^3\" --gravity \"9.81 m/s^2\" --depth infinite");
  auto arguments = std::make_shared<BemArguments>();
  auto texts = add_bem_options(*check, arguments);
  auto strict = std::make_shared<bool>(false);
  check->add_flag("--strict", *strict, "status 1 for a warning too");
  check->callback([=, &request] {
    request.call = [=](const Console& console) {
      arguments->options = read_options(*texts);
      return bem_check(*arguments, console, *strict);
    };
  });
}

void add_bem_heal(CLI::App& bem, Request& request) {
  auto* heal = bem.add_subcommand("heal", "puts right what theory demands: symmetry, spikes, tail, passivity");
  heal->footer(
      "Examples:\n  froude bem heal examples/data/pontoon1.nc -o pontoon1.healed.h5\n"
      "  froude bem heal buoy.nc --symmetry --passivity -o buoy.healed.h5");
  auto arguments = std::make_shared<BemArguments>();
  auto all = std::make_shared<BemHealArguments>();
  auto chosen = std::make_shared<hydro::potential::HealOptions>(
      hydro::potential::HealOptions{.symmetry = false, .spikes = false, .tail = false, .passivity = false});
  auto texts = add_bem_options(*heal, arguments);
  heal->add_option("-o,--output", all->output, "file to write, not the one that is read; its name tells the format")
      ->required();
  heal->add_option("--format", all->format, "of the output, where its name does not tell")
      ->check(CLI::IsMember({"froude", "bemio", "wamit", "capytaine"}));
  heal->add_flag("--symmetry", chosen->symmetry, "A and B become the means of themselves and their transposes");
  heal->add_flag("--spikes", chosen->spikes,
                 "irregular frequencies and wrong numbers are put between their neighbours");
  heal->add_flag("--tail", chosen->tail, "frequencies beyond the end are added, with the damping that A tells");
  heal->add_flag("--passivity", chosen->passivity, "B becomes the nearest matrix without negative eigenvalues");
  heal->callback([=, &request] {
    request.call = [=](const Console& console) {
      all->bem = *arguments;
      all->bem.options = read_options(*texts);
      // Named steps are taken and no others; none named means all.
      if (chosen->symmetry || chosen->spikes || chosen->tail || chosen->passivity) all->steps = *chosen;
      bem_heal(*all, console);
      return done;
    };
  });
}

/// The options of changes; the order of the guide, in which they are made.
void add_changes(CLI::App& convert, BemConvertArguments& a) {
  convert.add_flag("--merge", a.merge, "the files are runs of the same bodies at different frequencies");
  convert
      .add_option("--symmetric", a.symmetric,
                  "complete the headings: y if port and starboard are alike, x fore and aft")
      ->check(CLI::IsMember({"y", "x"}));
  convert.add_option("--about", a.about, "other reference points: cog, or \"(0, 0, -1.5) m\" for each body");
  convert.add_option("--translate", a.translate, "all bodies along the water: \"(30, 0, 0) m\"");
  convert.add_option("--turn", a.turn, "all bodies about the vertical through the origin: \"30 deg\"");
  convert.add_option("--array", a.array, "copies of one body without interaction: \"(±20, ±20, 0) m\"");
  convert.add_option("--scale", a.scale, "ratio of lengths, by Froude's law");
  convert.add_option("--density-ratio", a.density_ratio, "ratio of densities, by Froude's law");
  convert.add_option("--frequencies", a.frequencies, "interpolated: \"0.2 rad/s .. 3 rad/s, 57 values\"");
}

void add_bem_convert(CLI::App& bem, Request& request) {
  auto* convert = bem.add_subcommand(
      "convert",
      "from any format that froude reads to Froude .h5, BEMIO .h5, Capytaine .nc or WAMIT; turned, scaled, …");
  convert->footer(
      "Examples:\n  froude bem convert examples/data/pontoon1.nc -o pontoon1.bemio.h5\n"
      "  froude bem convert examples/data/pontoon1.nc --scale 25 --density-ratio 1.025 -o full_scale.h5");
  auto arguments = std::make_shared<BemArguments>();
  auto all = std::make_shared<BemConvertArguments>();
  auto texts = add_bem_options(*convert, arguments);
  convert->add_option("-o,--output", all->output, "file to write; its name tells the format")->required();
  convert->add_option("--format", all->format, "of the output, where its name does not tell")
      ->check(CLI::IsMember({"froude", "bemio", "wamit", "capytaine"}));
  add_changes(*convert, *all);
  convert->callback([=, &request] {
    request.call = [=](const Console& console) {
      all->bem = *arguments;
      all->bem.options = read_options(*texts);
      bem_convert(*all, console);
      return done;
    };
  });
}

/// Options of hulls as they were written.
struct HullTexts {
  std::string density, gravity = "9.81 m/s^2", depth, unit, frequencies, headings;
  std::vector<std::string> reference, cog;
  std::string interaction = "automatic";
  double tolerance = 0, frequency_tolerance = 0;
  bool no_lid = false;
};

std::vector<Eigen::Vector3d> hull_points(const char* option, const std::vector<std::string>& texts,
                                         std::size_t bodies) {
  std::vector<Eigen::Vector3d> out;
  for (const std::string& text : texts)
    out.push_back(scene::placed({.file = option}, [&] { return hydro::parse_vector(text, hydro::dim::length); }));
  hydro::require(out.empty() || out.size() == bodies, "{} gives {} points for {} hulls; state one for each", option,
                 out.size(), bodies);
  return out;
}

std::vector<double> hull_range(const char* option, const std::string& text, const hydro::Dimension& needed) {
  return scene::placed({.file = option}, [&] { return hydro::parse_range(text, needed); });
}

void require_hull_option(const char* option, const std::string& text, const char* example) {
  if (text.empty())
    throw hydro::InputError(fmt::format("{} is needed to solve a hull", option), {},
                            fmt::format("state it: {} \"{}\"", option, example));
}

void read_hulls(const HullTexts& texts, BemHullArguments& a) {
  namespace dim = hydro::dim;
  require_hull_option("--density", texts.density, "1025 kg/m^3");
  require_hull_option("--depth", texts.depth, "14 m");
  require_hull_option("--frequencies", texts.frequencies, "0.2 rad/s .. 3 rad/s, 57 values");
  a.water.density = *parsed("--density", texts.density, dim::density);
  a.water.gravity = *parsed("--gravity", texts.gravity, dim::acceleration);
  hydro::require(a.water.density > 0 && a.water.gravity > 0, "--density and --gravity must be positive");
  if (texts.depth != "infinite")
    a.water.depth = hydro::WaterDepth::from_metres(*parsed("--depth", texts.depth, dim::length));
  if (!texts.unit.empty()) a.mesh.unit = parsed("--unit", "1 " + texts.unit, dim::length);
  a.omega = hull_range("--frequencies", texts.frequencies, dim::angular_velocity);
  if (!texts.headings.empty()) a.heading = hull_range("--headings", texts.headings, dim::angle);
  a.reference = hull_points("--reference", texts.reference, a.meshes.size());
  a.centre_of_gravity = hull_points("--cog", texts.cog, a.meshes.size());
  using hydro::panels::Interaction;
  a.options.interaction = texts.interaction == "panels"          ? Interaction::panels
                          : texts.interaction == "partial-waves" ? Interaction::partial_waves
                                                                 : Interaction::automatic;
  a.options.lid = !texts.no_lid;
  if (texts.tolerance > 0) a.options.tolerance = texts.tolerance;
  if (texts.frequency_tolerance > 0) a.options.frequency_tolerance = texts.frequency_tolerance;
}

void add_hull_options(CLI::App& solve, HullTexts& texts, BemHullArguments& a) {
  solve.add_option("--density", texts.density, "of the water, for hulls: \"1025 kg/m^3\"");
  solve.add_option("--gravity", texts.gravity, "of the place, for hulls")->capture_default_str();
  solve.add_option("--depth", texts.depth, "of the water, for hulls: \"14 m\" or infinite");
  solve.add_option("--frequencies", texts.frequencies, "for hulls: \"0.2 rad/s .. 3 rad/s, 57 values\"");
  solve.add_option("--headings", texts.headings, "of waves, for hulls: \"0 deg .. 90 deg, 7 values\"; none: no X");
  solve.add_option("--reference", texts.reference, "point of motions and moments, one a hull; the origin if left out");
  solve.add_option("--cog", texts.cog, "centre of gravity, one a hull: \"(0, 0, -1) m\"; none: no C");
  solve.add_option("--unit", texts.unit, "of the numbers of the meshes: mm, cm, in, ft; metres if left out");
  solve.add_flag("--reverse", a.mesh.reverse, "turn the faces of the meshes inside out");
  solve
      .add_option(
          "--tolerance", texts.tolerance,
          "of the error by panels, relative: 0.02; they are refined, and the result extrapolated, until it is met")
      ->check(CLI::Range(1e-6, 0.5));
  solve.add_option(
      "--refine", a.options.refined_frequencies,
      "at how many frequencies panels are cut in four: to tell the error, or with --tolerance to begin with");
  solve
      .add_option("--frequency-tolerance", texts.frequency_tolerance,
                  "more frequencies are solved between --frequencies where responses bend, until what lies between is "
                  "foreseen to this, relative: 0.01; the table is as fine as that takes")
      ->check(CLI::Range(1e-6, 0.1));
  solve
      .add_option(
          "--interaction", texts.interaction,
          "of several hulls: panels, all in one set of equations; partial-waves, each kind of hull once, for many "
          "that stand apart; automatic, the quicker of those that serve")
      ->capture_default_str()
      ->check(CLI::IsMember({"automatic", "panels", "partial-waves"}));
  solve.add_flag("--no-lid", texts.no_lid, "without panels on the water inside: irregular frequencies stay");
  solve.add_option("--threads", a.options.threads, "frequencies solved at a time; default: all processors");
}

/// A scene states all of it; an option that did nothing would mislead.
void refuse_hull_options(const CLI::App& solve) {
  for (const CLI::Option* option : solve.get_options()) {
    const std::string name = option->get_name();
    const bool of_both = name == "files" || name == "--output" || name == "--format" || name == "--help";
    if (of_both || option->count() == 0) continue;
    throw hydro::InputError(fmt::format("{} is for meshes; bodies of a scene are solved as it says", name), {},
                            "leave the option out, or state it in the scene");
  }
}

void add_bem_solve(CLI::App& bem, Request& request) {
  auto* solve = bem.add_subcommand(
      "solve", "compute coefficients: of a scene's cylinders, exactly, or of hulls given as meshes, by panels");
  solve->footer(
      "Examples:\n  froude bem solve examples/cylinders.toml -o module.h5\n"
      "  froude bem solve hull.stl --density \"1025 kg/m^3\" --depth infinite -o hull.h5\n"
      "    --frequencies \"0.2 rad/s .. 3 rad/s, 57 values\" --headings \"0 deg .. 180 deg, 7 values\" --cog \"(0, 0, "
      "-1) m\"");
  auto arguments = std::make_shared<BemHullArguments>();
  auto texts = std::make_shared<HullTexts>();
  solve
      ->add_option("files", arguments->meshes,
                   "a scene with cylinders or meshes in [body.hydrodynamics], or hulls: .stl, .obj, .gdf")
      ->required();
  solve->add_option("-o,--output", arguments->output, "file to write; its name tells the format")->required();
  solve->add_option("--format", arguments->format, "of the output, where its name does not tell")
      ->check(CLI::IsMember({"froude", "bemio", "wamit", "capytaine"}));
  add_hull_options(*solve, *texts, *arguments);
  solve->callback([=, &request] {
    request.call = [=](const Console& console) {
      if (arguments->meshes.size() == 1 && arguments->meshes.front().extension() == ".toml") {
        refuse_hull_options(*solve);
        bem_solve(arguments->meshes.front(), arguments->output, arguments->format, console);
        return done;
      }
      read_hulls(*texts, *arguments);
      bem_solve_hulls(*arguments, console);
      return done;
    };
  });
}

void add_bem_irf(CLI::App& bem, Request& request) {
  auto* irf = bem.add_subcommand("irf", "radiation in time: kernels as sums of exponentials, certified passive");
  irf->footer("Example:\n  froude bem irf examples/data/hemisphere_r5.nc -o hemisphere.ss --picture irf.svg");
  auto arguments = std::make_shared<BemArguments>();
  auto irf_arguments = std::make_shared<BemIrfArguments>();
  auto texts = add_bem_options(*irf, arguments);
  irf->add_option("--tolerance", irf_arguments->tolerance, "of the fit: error of the force, relative")
      ->capture_default_str();
  irf->add_option("-o,--output", irf_arguments->output, "state space: .ss (OpenFAST) or .h5 (BEMIO groups)");
  irf->add_option("--picture", irf_arguments->picture, "SVG of kernels and damping of the first body");
  irf->callback([=, &request] {
    request.call = [=](const Console& console) {
      irf_arguments->bem = *arguments;
      irf_arguments->bem.options = read_options(*texts);
      bem_irf(*irf_arguments, console);
      return done;
    };
  });
}

}  // namespace

void add_bem(CLI::App& app, Request& request) {
  auto* bem = app.add_subcommand(
      "bem", "hydrodynamic coefficients: info, check, heal, convert, irf; solve for cylinders and hulls");
  bem->require_subcommand(1);
  add_bem_info(*bem, request);
  add_bem_check(*bem, request);
  add_bem_heal(*bem, request);
  add_bem_convert(*bem, request);
  add_bem_irf(*bem, request);
  add_bem_solve(*bem, request);
}

}  // namespace froude
