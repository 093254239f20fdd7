#pragma once
/// \file  Results on disk: one HDF5 file that is also a valid netCDF-4 file, so that xarray opens it without us.
///
/// Layout: dimensions and signals are datasets at the root, each with `units` and `long_name`; a complex signal has a
/// last dimension `complex` of size 2 (real, imaginary). How the result came about is in the group `/provenance`.
#include <complex>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

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
};

/// Time series: dimension `time` in s. \throws hydro::InputError if the file cannot be written
void write_run(const std::filesystem::path& path, const std::vector<double>& time, const std::vector<Signal>& signals,
               const Provenance& provenance);

/// Response amplitude operators: dimensions `omega` in rad/s and `complex`. `heading` in rad: a scalar where there is
/// one, the first dimension where there are several. \throws hydro::InputError if the file cannot be written
void write_rao(const std::filesystem::path& path, const std::vector<double>& omega, const std::vector<double>& heading,
               const std::vector<ComplexSignal>& signals, const Provenance& provenance);

/// Free motions. Shapes: one row a mode, one column a motion.
struct ModeTable {
  std::vector<std::string> motions;                ///< "m1.surge", …
  std::vector<double> omega;                       ///< undamped, rad/s
  std::vector<std::complex<double>> s;             ///< 1/s, of the damped motion; NaN where it creeps
  std::vector<double> shape;                       ///< undamped, m and rad
  std::vector<std::complex<double>> damped_shape;  ///< NaN where it creeps
};

/// Dimensions `mode` (counted from 1), `motion` and `complex`. \throws hydro::InputError if the file cannot be written
void write_modes(const std::filesystem::path& path, const ModeTable& modes, const Provenance& provenance);

/// A result of write_run, read back.
struct RunResult {
  std::vector<double> time;     ///< s
  std::vector<Signal> signals;  ///< in alphabetical order
};

/// \throws hydro::InputError if the file is none of ours, or cut short
RunResult read_run(const std::filesystem::path& path);

}  // namespace froude
