#pragma once
/// \file  What comes of a scene, as values that write themselves to disk.
///
/// A result on disk is one HDF5 file that is also a valid netCDF-4 file, so that xarray opens it without us.
/// Layout: dimensions and signals are datasets at the root, each with `units` and `long_name`; a complex signal has a
/// last dimension `complex` of size 2 (real, imaginary). How the result came about is in the group `/provenance`.
#include <array>
#include <complex>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/frequency/harmonic_balance.hpp"
#include "dynamics/time/growth.hpp"
#include "hydro/io/hdf5.hpp"

namespace froude {

/// A named series in the SI unit that `units` states.
struct Signal {
  std::string name;       ///< dataset name, e.g. "m1.heave"
  std::string units;      ///< SI, readable by hydro::parse_unit, e.g. "m", "N"
  std::string long_name;  ///< for people: "heave of m1 from its position at rest"
  std::vector<double> values = {};
};

/// A complex amplitude per frequency, of one heading after the other, phase as (P1) and (P2).
struct ComplexSignal {
  std::string name;
  std::string units;  ///< "m/m", "rad/m", "N/m": per metre of wave amplitude
  std::string long_name;
  std::vector<std::complex<double>> values = {};
};

/// How a result came about. Empty entries are left out of the file.
struct Provenance {
  std::string scene_file;  ///< name only: results do not tell where they were made
  std::string scene_text;
  std::vector<std::pair<std::string, std::string>> settings;  ///< every key that acts and its value, defaults included
  std::vector<std::pair<std::string, double>> seeds;          ///< of random numbers
  std::vector<std::pair<std::string, double>> wall_time;      ///< s, by effect
  std::vector<std::pair<std::string, double>> energy;         ///< J: supplied, dissipated, stored, residual, …
  std::vector<std::pair<std::string, std::string>> notes;     ///< anything else worth keeping
  hydro::io::Packing packing = hydro::io::Packing::deflate;   ///< of the numbers in the file
};

/// Slack and snaps of a line over a run.
struct Snaps {
  std::string line;
  double slack_share;  ///< of the time, in which a link is slack
  int snaps;
  double largest_tension, at;  ///< N; s
  int link;                    ///< counted from 1
};
/// The same in words.
std::string sentence(const Snaps& snaps);

/// The largest Lyapunov exponent of a line over a run.
struct LineExponent {
  std::string line;
  dynamics::Exponent exponent;
};
std::string sentence(const LineExponent& exponent);

/// How far the signals of a run are off by what is approximated: the largest of rms of the error over rms of the
/// signal, of its standard deviation's error over that, and of its lowest or highest value's over the one farther from
/// 0; over the whole run, or for as long as the signal can be predicted. (E1)-(E4), docs/theory/accuracy.md.
struct ErrorEstimate {
  struct Source {
    std::string name;               ///< "step", "memory", …
    std::string how;                ///< it was estimated
    std::vector<double> of_signal;  ///< one a signal; 0 for energy residuals, which are errors themselves
    bool given = false;             ///< the scene gives what makes it, and the run stands by that
  };
  /// A signal that no step can predict: what parts neighbours grows until they have nothing in common.
  struct Unpredictable {
    std::size_t signal;
    double until;               ///< s; from there on only its statistics can be told:
    double deviation, scatter;  ///< its standard deviation, and by how much that differs between runs, rms
  };
  double asked = 0;
  bool accepted = false;  ///< the scene takes whatever error there is
  std::vector<Source> sources;
  std::vector<Unpredictable> unpredictable;
  std::vector<std::string> unseen;  ///< sources of which nothing is known, each with the reason
  std::string missing;              ///< why nothing is estimated; empty where it is

  double total(std::size_t signal) const;  ///< of all sources
  std::size_t worst() const;               ///< the signal whose total is largest
  const Source& largest_source(std::size_t signal) const;
};

/// A run in time, whole or up to where it stopped.
struct Run {
  std::vector<double> time;     ///< s
  std::vector<Signal> signals;  ///< those that the scene asks for
  double step = 0;              ///< s
  std::size_t steps = 0;        ///< completed
  std::size_t parts = 0;        ///< into which a tolerance has cut them
  int newton_iterations = 0, halvings = 0, events = 0;
  int leaps = 0;  ///< through what smooth steps cannot follow: bodies on rough points coming to rest (D149)
  double preparation_s = 0, stepping_s = 0, estimating_s = 0;    ///< wall time; the last of the runs beside this one
  std::vector<std::pair<std::string, std::size_t>> evaluations;  ///< of the load, by effect
  std::vector<std::pair<std::string, double>> energy;            ///< J, by effect, at the end; residual and turnover
  struct Unexplained {
    double energy = 0, time = 0;  ///< J, s
  };
  Unexplained worst_residual;           ///< the energy residual when it was largest
  std::vector<Snaps> snaps;             ///< of lines whose scene asks for them
  std::vector<LineExponent> exponents;  ///< likewise
  std::vector<std::string> notes;       ///< what had to be decided, and what is left out
  std::string stopped;                  ///< why it ended before its time; empty if it did not
  ErrorEstimate error;
  Provenance provenance = {};  ///< without what the members above tell

  /// \throws hydro::InputError if there is no such signal
  const std::vector<double>& signal(const std::string& name) const;
  double turnover() const;  ///< J, of energy
  /// The energy residual when it was largest, of the energy turned over; 0 where nothing was.
  double relative_residual() const;
  /// "accuracy asked 0.01, estimated 0.006 (m3.pitch), most of it from the step"
  std::string accuracy() const;
  /// What of the run is not to be trusted, in words.
  std::vector<std::string> warnings() const;
  /// As write_run(). \throws hydro::InputError if the file cannot be written
  void write(const std::filesystem::path& path) const;
};

/// A section of a hull whose loads are among the signals of responses, and what it carries where the bodies are still.
struct SectionAtRest {
  std::string name;  ///< "barge.midship", whose signals are called barge.midship.force_x … moment_z
  std::array<double, 3> at,
      normal;  ///< a point of the plane and its normal, from the origin of the body along its axes
  /// By weight, still water and what is fastened to the part, on the part that is described: N and, about `at`, N m,
  /// along axes of the body.
  std::array<double, 6> load;
};

/// Signals per metre of wave amplitude, at the frequencies and headings that the scene asks for.
struct Responses {
  std::vector<double> omega;           ///< rad/s
  std::vector<double> heading;         ///< rad, where the waves go; in the order asked
  std::vector<ComplexSignal> signals;  ///< heading by heading: value of heading h, frequency w at h Nω + w
  std::vector<std::string> notes;      ///< what had to be decided, and what is left out
  ErrorEstimate error = {};            ///< of each value, over the largest of its signal
  Provenance provenance = {};          ///< without the notes
  std::vector<SectionAtRest> sections = {};

  /// "accuracy asked 0.01, estimated 0.006 of the peak (m3.pitch), by the coefficients"; empty where they have no error
  std::string accuracy() const;
  /// What of the responses is not to be trusted, in words.
  std::vector<std::string> warnings() const;
  /// \throws hydro::InputError if there is no such signal
  const ComplexSignal& signal(const std::string& name) const;
  /// As write_rao(). \throws hydro::InputError if the file cannot be written
  void write(const std::filesystem::path& path) const;
};

/// The water at the probes of a scene.
struct WaterSeries {
  std::vector<double> time;  ///< s
  std::vector<Signal> signals;
  std::string method;              ///< "inverse FFT", …
  std::vector<std::string> notes;  ///< what had to be decided
  Provenance provenance = {};      ///< without method and notes

  /// As write_run(). \throws hydro::InputError if the file cannot be written
  void write(const std::filesystem::path& path) const;
};

/// Free motions about rest, by rising frequency. Shapes are of the centres of gravity, m and rad, one row a mode, one
/// column a motion.
struct Modes {
  std::vector<std::string> motions;                ///< "m1.surge", …
  std::vector<double> omega;                       ///< undamped, rad/s
  std::vector<std::complex<double>> s;             ///< 1/s, of the damped motion; NaN where it creeps
  std::vector<double> shape;                       ///< undamped
  std::vector<std::complex<double>> damped_shape;  ///< NaN where it creeps
  std::vector<std::array<double, 6>> energy;       ///< shares of the kinetic energy in surge … yaw of all bodies
  std::vector<bool> outside_data;                  ///< the frequency is outside those of the coefficients
  std::vector<std::string> notes;                  ///< what had to be decided, and what is left out
  Provenance provenance = {};                      ///< without the notes

  std::size_t count() const { return omega.size(); }
  double period(std::size_t mode) const;                        ///< s, undamped
  std::optional<double> damped_period(std::size_t mode) const;  ///< s, 2π/Im s: of a decay; empty where it creeps
  std::optional<double> damping_ratio(std::size_t mode) const;  ///< −Re s/|s|; empty where it creeps
  std::span<const double> shape_of(std::size_t mode) const;
  /// As write_modes(). \throws hydro::InputError if the file cannot be written
  void write(const std::filesystem::path& path) const;
};

/// Whether the periodic motions of a scene in regular waves last, over periods and heights of the waves.
struct StabilityMap {
  /// A periodic motion with the period of the waves.
  struct Motion {
    std::optional<dynamics::frequency::Fate> fate = {};            ///< empty: no motion was found
    double multiplier = std::numeric_limits<double>::quiet_NaN();  ///< the largest |Floquet multiplier| of a period
    int harmonics = 0;
    dynamics::frequency::PeriodicMotion motion = {};  ///< of the coordinates of (Q13); empty where none was found

    /// As files have it: 0 stable, 1 period-doubled, 2 quasi-periodic, 3 fold; NaN: no motion was found.
    double fate_number() const;
  };
  /// How the motion of a cell was come to from that of the height below, at the lowest height from rest.
  enum class Reached {
    grown,            ///< as the waves grow
    round_folds,      ///< along a branch that turns back on its way
    jumped,           ///< by a jump of Newton's method: no branch was found that joins it to the motion below
    not_found,        ///< no periodic motion was
    beyond_breaking,  ///< there are no such waves
  };
  /// One that grows out of rest as waves do.
  struct Cell : Motion {
    Reached reached = Reached::not_found;
  };
  /// Motions that go over into each other along periods at one height, or along heights at one period, also where they
  /// turn back, (Q11).
  struct Branch {
    struct Point : Motion {
      double period, height;  ///< s, m
      bool forwards;          ///< what varies grows along the branch here; it turns at a fold
    };
    bool over_periods;
    double held;  ///< the height, m, or the period, s, that all of them have
    std::vector<Point> points;
    std::vector<Signal> signals;         ///< standard deviations, point by point
    Reached begin = Reached::not_found;  ///< how its first motion was come to from rest
    std::string end;                     ///< why it ends where it does; empty: it is at the other end of the map

    double varied(const Point& point) const { return over_periods ? point.period : point.height; }
  };
  std::vector<double> period, height;  ///< s, m
  std::vector<Cell> cells;             ///< height by height: height h, period p at h Np + p
  std::vector<double> mathieu;         ///< m, of each period: from where one motion grows by (Q14); NaN: none does
  std::vector<std::string> motion;     ///< which
  std::vector<Signal> signals;         ///< standard deviations of the periodic motions, cell by cell; NaN: none found
  std::vector<Branch> branches;        ///< that are asked for, in their order
  double processor_s = 0;              ///< that the cells took
  std::vector<std::string> notes;      ///< what had to be decided, and what is left out
  Provenance provenance = {};          ///< without the notes

  std::size_t index(std::size_t p, std::size_t h) const { return h * period.size() + p; }
  double period_of(std::size_t cell) const { return period[cell % period.size()]; }
  double height_of(std::size_t cell) const { return height[cell / period.size()]; }
  /// Dimensions `height`, `period`; branches are groups `branch1`, … with the dimension `point`.
  /// \throws hydro::InputError if the file cannot be written
  void write(const std::filesystem::path& path) const;
};
std::string name_of(StabilityMap::Reached reached);

/// The free surface about the bodies of a scene in one regular wave, on a grid.
struct HullPressures;  // hull_pressures.hpp
struct FreeSurface {
  double omega, heading;     ///< rad/s; rad, where the wave goes
  bool held;                 ///< bodies are held still
  std::vector<double> x, y;  ///< m
  /// "elevation", "incident", "scattered" and "radiated", m/m: value of x i, y j at j Nx + i. NaN where nothing is
  /// told: in bodies, and within the circle about a hull whose waves are told by partial waves.
  std::vector<ComplexSignal> signals;
  double estimate = 0;  ///< of the elevation's error, over its largest
  /// To second order, per m² of wave amplitude, by the momentum of waves far away, on all bodies together: N/m² along x
  /// and y; W/m², what the bodies take from the waves, and what they scatter and radiate.
  double drift_x = 0, drift_y = 0, power_taken = 0, power_sent_out = 0;
  std::vector<std::string> notes;                      ///< what had to be decided, and what is left out
  Provenance provenance = {};                          ///< without the notes
  std::shared_ptr<const HullPressures> pressure = {};  ///< on hulls, where the scene asks for it
  /// Mean drift of each body by itself where the scene asks for it, per m² of wave amplitude: N/m² along x and y, and
  /// N m/m² about the vertical through its origin.
  struct BodyDrift {
    std::string body;
    double x, y, moment;
  };
  std::vector<BodyDrift> body_drift = {};
  /// Waves far away: at the distance r along the direction `angle`, rad, the elevation that bodies add goes to
  /// A √(2/(πkr)) e^{−i(kr − π/4)} per metre of wave amplitude; A of bodies held still and of their motion.
  std::vector<double> angle = {};
  std::vector<std::complex<double>> far_scattered = {}, far_radiated = {};
  double body_drift_error = 0;  ///< estimated, over the largest

  const std::vector<std::complex<double>>& elevation() const { return signals.front().values; }
  /// Dimensions `y`, `x` and `complex`; of pressures `panel`, `corner`, `space` and `complex`.
  /// \throws hydro::InputError if the file cannot be written
  void write(const std::filesystem::path& path) const;
};

/// One line of a plan: an effect, how it is computed, how large it is; or why it is left out.
struct PlanLine {
  std::string effect, method, size;
  bool runs = true;
};
/// What the answers to a scene will take.
struct Plan {
  struct Section {
    std::string title;
    std::vector<PlanLine> lines;
  };
  std::vector<Section> sections;
  std::vector<std::string> notes;
};

/// Time series: dimension `time` in s. Where an `error` is known, signals have the attributes `error`, `error_<source>`
/// and, where they cannot be predicted to the end, `predictable_until_s`.
/// \throws hydro::InputError if the file cannot be written
void write_run(const std::filesystem::path& path, const std::vector<double>& time, const std::vector<Signal>& signals,
               const Provenance& provenance, const ErrorEstimate& error = {});

/// Response amplitude operators: dimensions `omega` in rad/s and `complex`. `heading` in rad: a scalar where there is
/// one, the first dimension where there are several. Errors as write_run() has them. Sections are the group
/// `section_at_rest` with the dimension `section`, where there are any.
/// \throws hydro::InputError if the file cannot be written
void write_rao(const std::filesystem::path& path, const std::vector<double>& omega, const std::vector<double>& heading,
               const std::vector<ComplexSignal>& signals, const Provenance& provenance, const ErrorEstimate& error = {},
               const std::vector<SectionAtRest>& sections = {});

/// Dimensions `mode` (counted from 1), `motion` and `complex`. \throws hydro::InputError if the file cannot be written
void write_modes(const std::filesystem::path& path, const Modes& modes, const Provenance& provenance);

/// A result of write_run, read back.
struct RunResult {
  std::vector<double> time;     ///< s
  std::vector<Signal> signals;  ///< in alphabetical order
};

/// \throws hydro::InputError if the file is none of ours, or cut short
RunResult read_run(const std::filesystem::path& path);

}  // namespace froude
