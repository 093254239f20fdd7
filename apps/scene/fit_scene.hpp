#pragma once
/// \file  A scene that fits coefficients to measurements, as the user wrote it: typed, in SI, every default filled in.
#include "scene/scene.hpp"

namespace froude::scene {

struct FitScene {
  std::filesystem::path file;
  std::string text;
  std::string title;
  std::vector<Located<std::filesystem::path>> files;  ///< data, absolute, in alphabetical order; `files` may hold `*`
  std::optional<Located<std::filesystem::path>> run_table;  ///< in place of files
  std::map<std::string, std::string> channels;  ///< role (time, velocity, acceleration, position, …) → column
  struct ForceChannel {
    std::string column;
    bool turned = false;  ///< written "-F2": positive the other way
    std::optional<Located<std::filesystem::path>> calibration;
  };
  std::vector<ForceChannel> force;  ///< their sum is the force
  std::optional<Located<std::filesystem::path>> zero_run;
  struct Model {
    std::string kind;                      ///< "morison", "towing", "decay", "radiation", "friction ramp" or "motion"
    double diameter = 0, length = 0;       ///< m; as what follows up to `wave`, of morison and towing
    double density = 0;                    ///< kg/m³
    std::optional<double> viscosity = {};  ///< m²/s, for Re
    std::string motion =
        {};  ///< morison only: "water moves" (waves on a fixed body), "body moves" (forced oscillation), "both move"
    double mass_beyond_load_cells = 0;         ///< kg, where the body moves
    bool linear_drag = false, offset = false;  ///< morison: fitted beside the rest
    struct Line {
      double hz, multiple;  ///< one of them; the other is 0
    };
    std::vector<Line> lines = {};  ///< morison: forces of one frequency, fitted beside the rest
    /// Standard uncertainties, SI; 0 where none is stated.
    double diameter_error = 0, length_error = 0, density_error = 0, mass_error = 0;
    struct Wave {
      hydro::WaterDepth depth = hydro::WaterDepth::infinite();
      double level, ahead, gravity;  ///< z of the axis, m, negative; m; m/s²
      bool regular = false;          ///< one sinusoid, fitted to the probe
      bool follow = false;           ///< the water is taken where the body is
    };
    std::optional<Wave> wave = {};  ///< with the channel elevation
    bool sine = false;              ///< decay: restored by sin x
    bool starts_empty = false;      ///< decay with a memory: let go from rest in calm water
    struct Body {
      double mass, stiffness;              ///< kg and N/m, or kg m² and N m/rad
      double mass_error, stiffness_error;  ///< standard uncertainties, relative
    };
    std::optional<Body> body = {};         ///< radiation, and a decay that is to tell added mass
    double ramp = 0, slide = 0, drop = 0;  ///< friction ramp: lengths of its pieces, s
    Place place = {};
  } model;
  /// Steps between the measurement and the fit; frequencies in Hz, times in s.
  struct Filter {
    std::string kind;  ///< "butterworth", "symmetric weights", "notch", "moving average"
    int order = 0;
    double hz = 0, width_hz = 0, seconds = 0;
  };
  struct Prepare {
    double longest_gap = 0;
    double outlier_window = 0, outlier_deviations = 0;  ///< 0: not looked for
    double resample_hz = 0;                             ///< 0: left as it is
    double delay = 0, delay_error = 0;
    std::optional<double> longest_delay;  ///< the delay is to be estimated, within this
    double derivative_bandwidth = 0;
    std::string derivative_method = "local polynomial";  ///< or "smoothing spline", "fourier series"
    std::vector<Filter> filters;
    std::string window = "all";  ///< "all", "span", "full cycles"
    double from = 0, to = 0;
    int cycles = 0;  ///< 0: as many as there are
    double tolerance = 0.03;
    bool mean_cycle = false;
  } prepare;
  std::vector<std::string> coefficients;  ///< among "cd", "cm", "ca"; of a decay its terms, and "memory"
  double confidence = 0.95;
  std::string interval_method = "effective samples";
  bool profile = false, robust = false, cycles = false, sensitivity = false;
  bool accept_residuals = false;  ///< accept = ["residuals"]: values are told though residuals are too large
  bool together = false;          ///< decay: one set of coefficients for all files beside those of each
  std::string law;                ///< "" for none
  std::vector<Echo> echo;
  /// kind "motion": the scene that is run, its numbers that are fitted, and what its run should tell.
  struct Motion {
    struct Parameter {
      std::string key;   ///< as number_at() reads it
      std::string unit;  ///< as the scene writes it; the values are in it
      double first;
      std::optional<double> lowest, highest;
      Place place;
    };
    struct Signal {
      std::string column, of;          ///< of the file; of the run
      Located<std::string> deviation;  ///< of the noise, with its unit
    };
    Located<std::filesystem::path> scene = {};
    double window = 0;  ///< s; 0: the record is one run from the scene's start
    int starts = 1;     ///< of the search
    int iterations = 60;
    std::vector<Parameter> parameters = {};
    std::vector<Signal> signals = {};
  } motion;
};

/// True if the file has a [model] table, that is, asks for a fit.
bool is_fit(const std::filesystem::path& file);
/// Reads a scene of kind "fit"; the data files must be there. \throws hydro::InputError
FitScene read_fit(const std::filesystem::path& file);
FitScene parse_fit(std::string_view text, const std::filesystem::path& file);

}  // namespace froude::scene
