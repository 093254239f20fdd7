#pragma once
/// \file  The subcommands of `froude` as plain functions; main.cpp turns the command line into these arguments.
/// Errors are thrown (hydro::InputError, hydro::NumericsError, CheckFailed); main.cpp prints them and sets the exit
/// status.
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "hydro/base/error.hpp"
#include "hydro/hydrostatics/mesh.hpp"
#include "hydro/panels/solve.hpp"
#include "hydro/potential/coefficients.hpp"
#include "hydro/potential/doctor/heal.hpp"

namespace froude {

namespace sweep {
class Ranks;
}

using Path = std::filesystem::path;

/// How results are told: to a person on a terminal, or to a program.
struct Console {
  std::ostream& out;           ///< results
  std::ostream& err;           ///< progress and warnings
  bool json = false;           ///< one JSON document on `out`, nothing else
  bool show_progress = false;  ///< `err` is a terminal and nobody asked for quiet
};

/// Input and numerics are right, and what came of them may not be told: a check of the result failed; exit status 1. It
/// is no InputError, whose handlers would make it one of the input.
class CheckFailed : public std::runtime_error {
 public:
  explicit CheckFailed(hydro::InputError told) : std::runtime_error(told.what()), told_(std::move(told)) {}
  const hydro::InputError& told() const noexcept { return told_; }  ///< rule, place and remedy

 private:
  hydro::InputError told_;
};

struct BemArguments {
  std::vector<Path> files;
  hydro::potential::ReadOptions options;
};
void bem_info(const BemArguments& arguments, const Console& console);
/// Returns the exit status: 0 nothing worse than a note or warning, 1 an error finding, or a warning if `strict`.
int bem_check(const BemArguments& arguments, const Console& console, bool strict = false);

struct BemHealArguments {
  BemArguments bem = {};
  Path output = {};
  std::string format = {};  ///< "": told by the name of `output`
  hydro::potential::HealOptions steps = {};
};
/// Writes healed coefficients to another file, and tells what was changed by how much.
void bem_heal(const BemHealArguments& arguments, const Console& console);

/// Changes are made in the order of the members (docs/guide/coefficients.md).
struct BemConvertArguments {
  BemArguments bem = {};
  Path output = {};
  std::string format = {};                      ///< "": told by the name of `output`
  bool merge = false;                           ///< the files are runs of the same bodies at different frequencies
  std::vector<std::string> symmetric = {};      ///< planes in which bodies are their own images: "y", "x"
  std::vector<std::string> about = {};          ///< new reference points, "cog" or one a body, e.g. "(0, 0, -2) m"
  std::optional<std::string> translate = {};    ///< e.g. "(30, 0, 0) m"
  std::optional<std::string> turn = {};         ///< e.g. "30 deg"
  std::vector<std::string> array = {};          ///< places of copies, e.g. "(±20, ±20, 0) m"
  std::optional<double> scale = {};             ///< ratio of lengths
  std::optional<double> density_ratio = {};     ///< ratio of densities
  std::optional<std::string> frequencies = {};  ///< e.g. "0.2 rad/s .. 3 rad/s, 57 values"
};
void bem_convert(const BemConvertArguments& arguments, const Console& console);

/// Coefficients of the cylinders or the meshes that a scene describes, written as bem_convert() does.
void bem_solve(const Path& scene, const Path& output, const std::string& format, const Console& console);

struct BemHullArguments {
  std::vector<Path> meshes;  ///< .stl, .obj or .gdf, one a body
  Path output;
  std::string format;
  hydro::hydrostatics::MeshOptions mesh = {};
  hydro::Water water = {};
  std::vector<double> omega, heading;                         ///< rad/s, rad
  std::vector<Eigen::Vector3d> reference, centre_of_gravity;  ///< one a body, m; none: waterplane's origin, no C
  hydro::panels::Options options = {};
};
/// Coefficients of hulls given as meshes, by panels, written as bem_convert() does.
void bem_solve_hulls(const BemHullArguments& arguments, const Console& console);

struct BemIrfArguments {
  BemArguments bem;
  double tolerance = 1e-3;           ///< of the fit, relative force
  std::optional<Path> output = {};   ///< .ss (OpenFAST) or .h5 (BEMIO state-space groups)
  std::optional<Path> picture = {};  ///< SVG
};
/// Radiation in the time domain: poles, certificate of passivity, errors, A(∞) by fit and by Ogilvie's relation.
void bem_irf(const BemIrfArguments& arguments, const Console& console);

/// Steps before a record is looked at, as [prepare] of a fit has them; what is empty is not done.
struct StepArguments {
  std::optional<std::string> longest_gap = {};     ///< rows missing no longer are bridged, e.g. "0.5 s"
  std::optional<std::string> outliers = {};        ///< window about a sample that is asked, e.g. "1 s"
  std::optional<double> outlier_deviations = {};   ///< how far off an outlier is; 8 unless given
  bool through_levels = false;                     ///< coarse channels become the curve through their levels
  std::optional<std::string> resample = {};        ///< another sampling rate, e.g. "20 Hz"
  bool detrend = false;                            ///< the straight line of least squares is taken off
  std::vector<std::string> notch = {};             ///< centre and width, e.g. "50 Hz, 2 Hz"
  std::optional<std::string> moving_average = {};  ///< length, e.g. "0.05 s"
  std::optional<std::string> low_pass = {};        ///< cutoff, e.g. "2 Hz"
  std::optional<std::string> low_pass_kind = {};   ///< as [prepare.low_pass] kind; "butterworth" unless given
  std::optional<int> low_pass_order = {};          ///< of one pass; 4 unless given
  std::optional<double> low_pass_ripple = {};      ///< of "chebyshev"; 0.005 unless given
  std::optional<std::string> band_pass = {};       ///< both edges, e.g. "0.05 Hz, 0.5 Hz"
  std::optional<std::string> wave_frequency = {};  ///< instead: a band from 0.2 to 4 times it
};

struct PsdArguments {
  Path file;                                ///< CSV, or a result of `froude run`
  std::vector<std::string> signals = {};    ///< empty: all (with a time column), `*` allowed
  std::optional<std::string> segment = {};  ///< length of a Welch segment, e.g. "100 s"
  std::optional<std::size_t> tapers = {};   ///< instead of segments: so many over the whole record
  bool uneven = false;                      ///< the record has gaps, or samples at uneven times
  StepArguments steps = {};
  std::optional<std::string> from = {};  ///< leave out what comes before, e.g. "60 s"
  std::optional<std::string> to = {};    ///< leave out what comes after, e.g. "360 s"
  double confidence = 0.95;
  std::optional<std::string> input = {};  ///< signal to take as input: H1, H2 and coherence of the others against it
  std::optional<Path> output = {};        ///< .csv or .h5
  std::optional<Path> picture = {};       ///< .svg, .png or .pdf
};
void psd(const PsdArguments& arguments, const Console& console);

struct PrepareArguments {
  Path file;                              ///< CSV, or a result of `froude run`
  std::vector<std::string> signals = {};  ///< empty: all, `*` allowed
  StepArguments steps = {};
  std::vector<std::string> rates = {};        ///< signals whose rate is added, `*` allowed
  std::optional<std::string> bandwidth = {};  ///< of the rates, e.g. "5 Hz"; five times the main frequency unless given
  std::optional<std::string> from = {}, to = {};  ///< leave out what comes before, or after, e.g. "60 s"
  Path output;                                    ///< .csv
  std::optional<Path> picture = {};               ///< .svg, .png or .pdf
};
/// A record after the steps of [prepare], with rates of its signals.
void prepare(const PrepareArguments& arguments, const Console& console);

struct PoincareArguments {
  Path file;                              ///< CSV, or a result of `froude run`
  std::string x, y;                       ///< signals of the plane
  std::optional<std::string> at = {};     ///< signal that crosses the level
  std::optional<std::string> level = {};  ///< e.g. "0 rad"
  std::string through = "up";             ///< up, down or both
  std::optional<std::string> every = {};  ///< instead: once in this period, e.g. "8 s"
  bool wrap = false;                      ///< angles into −180° … 180°
  std::optional<std::string> from = {};   ///< leave out what comes before; with `every` the first point
  std::optional<Path> output = {};        ///< .csv
  std::optional<Path> picture = {};       ///< .svg, .png or .pdf
};
/// A Poincaré section of a record, with the error of each point by interpolation.
void poincare(const PoincareArguments& arguments, const Console& console);

struct TrajectoryArguments {
  Path file;                                              ///< CSV, or a result of `froude run`
  std::vector<std::string> points = {};                   ///< of which there are signals .x, .y and .z
  std::optional<std::string> x = {}, y = {}, z = {};      ///< instead, signals of one path
  std::optional<std::string> from = {}, to = {};          ///< leave out what comes before, or after, e.g. "60 s"
  std::string azimuth = "-60 deg", elevation = "20 deg";  ///< from where the paths are seen
  Path picture;                                           ///< .svg, .png or .pdf
};
/// Paths in space by three signals each, drawn in perspective.
void trajectory(const TrajectoryArguments& arguments, const Console& console);

struct SnapshotArguments {
  Path file;                                 ///< a result of `froude run`
  std::vector<std::string> lines = {};       ///< names
  std::vector<std::string> bodies = {};      ///< names; their members are drawn
  std::vector<std::string> at;               ///< instants, e.g. "4 s"; each takes the nearest sample
  std::vector<std::string> planes = {"xz"};  ///< two of x, y and z: along and up the picture
  std::optional<Path> output = {};           ///< .csv
  std::optional<Path> picture = {};          ///< .svg, .png or .pdf
};
/// Where lines and members of bodies are at chosen instants of a run.
void snapshot(const SnapshotArguments& arguments, const Console& console);

/// An S–N curve on the command line.
struct SnArguments {
  std::optional<std::string> range = {};                            ///< e.g. "50 MPa"
  std::optional<double> cycles = {}, slope = {}, slope_below = {};  ///< that the range may come; below it the last
};

struct FatigueArguments {
  Path file;           ///< CSV, or a result of `froude run`
  std::string signal;  ///< whose cycles are counted
  SnArguments sn = {};
  std::optional<std::string> from = {};  ///< leave out what comes before
  std::vector<std::string> accept = {};  ///< "stop": a sensor at its stop
  std::optional<Path> output = {};       ///< .csv of the cycles
  std::optional<Path> picture = {};      ///< .svg, .png or .pdf
};
/// Rainflow cycles of a record and their damage.
void fatigue(const FatigueArguments& arguments, const Console& console);

struct ExtremesArguments {
  Path file;                                  ///< CSV, or a result of `froude run`
  std::string signal;                         ///< whose largest values are told
  bool lowest = false;                        ///< lowest values in their place
  std::string duration = "3 h";               ///< over which they are told
  std::optional<std::string> threshold = {};  ///< e.g. "2 m"; a tenth of the peaks, or twenty, are above it
  std::optional<std::string> block = {};      ///< e.g. "10 min"; a twentieth of the record
  std::vector<double> quantiles = {};         ///< probabilities of staying below; 0.5, 0.9 and 0.99
  double confidence = 0.95;
  StepArguments steps = {};
  std::optional<std::string> from = {};  ///< leave out what comes before
  std::vector<std::string> accept = {};  ///< "stop", "drift", "tail": what is refused otherwise
  std::optional<Path> output = {};       ///< .csv of the peaks
  std::optional<Path> picture = {};      ///< .svg, .png or .pdf
};
/// Peaks over a threshold and maxima of blocks of a record, and the largest values that they let one expect.
void extremes(const ExtremesArguments& arguments, const Console& console);

struct ResponseArguments {
  Path scene;
  std::string duration = "3 h";                      ///< over which largest values are told
  std::vector<double> quantiles = {0.5, 0.9, 0.99};  ///< of the largest values
  SnArguments sn = {};
  std::optional<Path> scatter = {};  ///< .csv of seas and how often they come
  std::optional<Path> output = {};   ///< .csv of spectra; of a scatter diagram levels and how often they are exceeded
  std::optional<Path> picture = {};  ///< .svg, .png or .pdf of the same
  std::string check = {};            ///< "time": against runs of the sea with other seeds
  int check_runs = 8;
};
/// Spectra of responses in the sea of a scene, their statistics, largest values and damage.
void response(const ResponseArguments& arguments, const Console& console);

struct FitArguments {
  Path scene;
  std::optional<Path> output = {};  ///< .toml of the estimates
  std::optional<Path> table = {};   ///< .csv with one row for each run
  std::optional<Path> picture = {};
  bool predict = false;         ///< nothing is fitted
  std::optional<Path> at = {};  ///< .toml of an earlier fit, whose values are taken; beside `predict`
};
void fit(const FitArguments& arguments, const Console& console);

struct SceneArguments {
  Path scene;
  std::optional<Path> output;  ///< .h5; default: the scene's name with .rao.h5 or .run.h5, in the current folder
  std::optional<Path> csv;
  std::optional<Path> picture;
};
struct RaoArguments : SceneArguments {
  std::optional<int> threads = {};  ///< default: all processors
  bool refine = false;              ///< frequencies are put where responses bend
  bool nondimensional = false;      ///< rotations over the slope of the wave
  std::string check = {};           ///< "time": some cells by runs; empty: none
  /// Height over length of their waves; left out: as [ask.rao.drag] has it, or 0.002.
  std::optional<double> check_steepness = {};
};
void rao(const RaoArguments& arguments, const Console& console);
void modes(const SceneArguments& arguments, const Console& console);
struct FieldArguments : SceneArguments {
  std::optional<Path> pressure_csv = {};  ///< one row for each panel
};
void field(const FieldArguments& arguments, const Console& console);
struct StabilityArguments : SceneArguments {
  std::string check = {};        ///< "time": some cells by runs; empty: none
  int check_cells = 6;           ///< spread over the map
  double check_duration = 2400;  ///< s, of each: what grows by a per cent a period shows after some hundred periods
  std::optional<Path> boundaries = {};  ///< .csv
};
void stability(const StabilityArguments& arguments, const Console& console);
void run(const SceneArguments& arguments, const Console& console);
void plan(const SceneArguments& arguments, const Console& console);

struct CostArguments {
  Path scene;
  std::optional<double> tolerance = {};  ///< of the error, relative
  std::string by = "rms";                ///< errors of runs: rms, deviation, extreme or range
  std::optional<Path> output = {};       ///< .toml: the scene with the cheapest settings within the tolerance
  std::optional<Path> picture = {};      ///< .svg, .png or .pdf
};
/// Error and time of every setting of a scene's approximations, and the cheapest within a tolerance.
void cost(const CostArguments& arguments, const Console& console);

struct SweepArguments {
  std::optional<Path> study = {};
  std::optional<Path> output = {};           ///< a folder; default: the study's name with .sweep, in the current folder
  std::optional<int> threads = {};           ///< default: one a core
  std::string part = "1/1";                  ///< which of how many shares of the cases
  bool plan = false;                         ///< one case is answered, and nothing is kept
  bool retry = false;                        ///< cases that have failed are answered again
  std::optional<std::size_t> scene_of = {};  ///< prints the scene of this case, and nothing else
  std::vector<Path> merge = {};              ///< folders of sweeps of one study, in place of a study
};
/// Answers a scene with many values of its keys. Returns the exit status: 0, 3 where a case has failed, 130 where it
/// was interrupted.
int sweep_scenes(const SweepArguments& arguments, const Console& console);
/// The same shared with other processes, which each call it. What is told, and the exit status, is that of rank 0.
int sweep_scenes_together(const SweepArguments& arguments, sweep::Ranks& ranks, const Console& console);

struct KinematicsArguments {
  Path scene;                             ///< of a fit of kind "motion" with [camera]
  std::optional<std::string> film = {};   ///< which of its records, by name; none: the one that there is
  std::string bandwidth;                  ///< "5 Hz"; empty in space
  std::vector<std::string> lengths = {};  ///< "pivot joint 0.5 m 0.5 mm": markers, their distance, its deviation
  std::optional<Path> record = {};        ///< .csv, of another clock
  std::string record_time = "t";          ///< its column of time
  std::string match = {};  ///< "chain.link1.polar = angle": a signal of the scene and a column of the record
  std::string around = {}, longest = {};  ///< "1.2 s", "0.4 s": the offset lies so far about that; empty: 0, anywhere
  std::string sign = {};                  ///< of the column against the signal: "same", "opposite"; empty: either
  std::optional<Path> start = {};  ///< .toml: the scene of motion with its bodies' starts, or a table [line.start]
  std::string start_at = {};       ///< "1.2 s" of the track
  std::string nodes = {};          ///< markers at the line's nodes, in their order; empty: the start is that of bodies
  std::optional<std::string> release = {};  ///< a marker: when is it let go?
  bool space = false;                       ///< six motions of bodies, from the lens and markers on them
  std::optional<std::string> second = {};   ///< another camera that saw the same markers, which then have places in
                                            ///< space: a record of the scene, by name, or a scene of its own
  Path output;                              ///< .csv
  std::optional<Path> picture = {};         ///< .svg, .png or .pdf
};
/// Places, velocities and accelerations of a track's markers, and angles of lines, by a smoother.
void kinematics(const KinematicsArguments& arguments, const Console& console);

struct HydrostaticsArguments {
  Path mesh;  ///< .stl, .obj or .gdf
  hydro::hydrostatics::MeshOptions options;
  std::optional<double> freeboard;  ///< m, walls and deck drawn above the edge of the openings
  hydro::Water water;
  std::optional<double> mass;                        ///< kg; the hull then floats where it wants to
  std::optional<Eigen::Vector3d> centre_of_gravity;  ///< as drawn, m
  std::optional<Eigen::Vector3d> reference;          ///< of C, global, m; the origin if left out
  std::optional<double> heave;                       ///< m; without a mass only
  hydro::Angle heel = hydro::Angle::from_radians(0), trim = hydro::Angle::from_radians(0);  ///< with a mass: the start
  std::vector<double> heels;  ///< of the righting arms, rad
  bool free_trim = false;     ///< along them
  std::optional<Path> picture;
};
/// Volume, centres, waterplane, C, GM and righting arms of a hull.
void hydrostatics(const HydrostaticsArguments& arguments, const Console& console);

struct ReportArguments {
  std::vector<Path> results;         ///< files and folders of any command that answers, and fit scenes
  Path output;                       ///< .html
  std::optional<std::string> from;   ///< "60 s": statistics and spectra of runs leave out what comes before
  std::optional<Path> scene_folder;  ///< where the scenes of results stood, for meshes; none: beside the results
};
/// One HTML file that shows the results and needs no other. \throws hydro::InputError, also in a build without npm
void report_results(const ReportArguments& arguments, const Console& console);

struct ExportArguments {
  std::vector<Path> results;              ///< of any command that answers (.h5, .nc, .csv)
  Path output;                            ///< .csv, .mat or .pvd; with `format` a folder
  std::string format = {};                ///< "csv", "matlab" or "vtk"; "": told by the name of `output`
  std::vector<std::string> signals = {};  ///< empty: all; `*` allowed
  std::optional<std::string> from = {}, to = {}, every = {};  ///< of results in time, e.g. "60 s"
  std::optional<Path> scene_folder = {};  ///< where the scenes of results stood; none: beside the results
};
/// Results as tables, for MATLAB, and in space for ParaView.
void export_results(const ExportArguments& arguments, const Console& console);

struct WavesInfoArguments {
  Path file;                                                ///< scene, list of components, spectrum or record
  hydro::WaterDepth depth = hydro::WaterDepth::infinite();  ///< of the water, where the file does not say
  double gravity = 9.81;
  std::optional<std::string> column = {};  ///< of a record; "elevation" if left out
  bool phase_of_kx = false;                ///< phases of a list belong to cos(kx − ωt + ε)
};
void waves_info(const WavesInfoArguments& arguments, const Console& console);
void waves_make(const SceneArguments& arguments, const Console& console);

/// Writes a commented starter scene. With `keys`, prints the reference of all scene keys instead.
void new_scene(const std::string& kind, const std::optional<Path>& output, bool keys, const Console& console);

/// Becomes the program froude-validate, which stands beside the one that is running, with these arguments.
/// \throws hydro::InputError if it is not there
[[noreturn]] void validate(std::vector<std::string> arguments);
/// The same with froude-film; the first argument is the command: track, calibrate or film. \throws as validate()
[[noreturn]] void about_films(std::vector<std::string> arguments);
/// Hands over to froude-ranks. \throws hydro::InputError if that is not there
[[noreturn]] void sweep_among_ranks(std::vector<std::string> arguments);

}  // namespace froude
