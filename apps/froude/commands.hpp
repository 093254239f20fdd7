#pragma once
/// \file  The subcommands of `froude` as plain functions; main.cpp turns the command line into these arguments.
/// Errors are thrown (hydro::InputError, hydro::NumericsError); main.cpp prints them and sets the exit status.
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "hydro/potential/coefficients.hpp"

namespace froude {

using Path = std::filesystem::path;

/// How results are told: to a person on a terminal, or to a program.
struct Console {
  std::ostream& out;           ///< results
  std::ostream& err;           ///< progress and warnings
  bool json = false;           ///< one JSON document on `out`, nothing else
  bool show_progress = false;  ///< `err` is a terminal and nobody asked for quiet
};

struct BemArguments {
  std::vector<Path> files;
  hydro::potential::ReadOptions options;
};
void bem_info(const BemArguments& arguments, const Console& console);
/// Returns the exit status: 0 nothing worse than a note or warning, 1 an error finding.
int bem_check(const BemArguments& arguments, const Console& console);
/// The format follows from the name of `output`: .h5 (ours), .bemio.h5 or --format bemio, .1 (WAMIT set).
void bem_convert(const BemArguments& arguments, const Path& output, const std::string& format, const Console& console);

struct PsdArguments {
  Path file;                                ///< CSV, or a result of `froude run`
  std::vector<std::string> signals = {};    ///< empty: all (with a time column), `*` allowed
  std::optional<std::string> segment = {};  ///< length of a Welch segment, e.g. "100 s"
  std::optional<std::string> from = {};     ///< leave out what comes before, e.g. "60 s"
  double confidence = 0.95;
  std::optional<std::string> input = {};  ///< signal to take as input: H1, H2 and coherence of the others against it
  std::optional<Path> output = {};        ///< .csv or .h5
  std::optional<Path> picture = {};       ///< .svg
};
void psd(const PsdArguments& arguments, const Console& console);

struct FitArguments {
  Path scene;
  std::optional<Path> output = {};  ///< .toml of the estimates
  std::optional<Path> picture = {};
};
void fit(const FitArguments& arguments, const Console& console);

struct SceneArguments {
  Path scene;
  std::optional<Path> output;  ///< .h5; default: the scene's name with .rao.h5 or .run.h5, in the current folder
  std::optional<Path> csv;
  std::optional<Path> picture;
};
void rao(const SceneArguments& arguments, const Console& console);
void run(const SceneArguments& arguments, const Console& console);
void plan(const SceneArguments& arguments, const Console& console);

/// Writes a commented starter scene. With `keys`, prints the reference of all scene keys instead.
void new_scene(const std::string& kind, const std::optional<Path>& output, bool keys, const Console& console);

struct ValidateArguments {
  std::vector<std::string> cases;  ///< empty: all
  std::optional<Path> folder;      ///< of the cases; default: installed or source
  std::optional<Path> data;        ///< reference data; default FROUDE_REFERENCE_DATA, then ../shared/data
  std::optional<Path> page;        ///< writes the page with pictures here
};
/// Returns 0 if every case that could run is within its limits, else 1.
int validate(const ValidateArguments& arguments, const Console& console);

}  // namespace froude
