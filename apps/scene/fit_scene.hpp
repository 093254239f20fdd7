#pragma once
/// \file  A scene that fits coefficients to measurements, as the user wrote it: typed, in SI, every default filled in.
///        What libfit takes as an option stands here as libfit's own type, so that no option and no default is written
///        twice; nothing of libfit is called from here.
#include <variant>

#include "fit/forced_radiation.hpp"
#include "fit/friction_ramp.hpp"
#include "fit/problem/decay.hpp"
#include "fit/problem/morison.hpp"
#include "fit/problem/towing.hpp"
#include "fit/simulated.hpp"
#include "scene/camera.hpp"
#include "scene/scene.hpp"

namespace froude::scene {

/// Drag and inertia of a cylinder.
struct MorisonModel : ::fit::morison::Options {
  static constexpr const char* kind = "morison";
  ::fit::Cylinder cylinder;
  std::optional<::fit::ProbeToBody> probe;  ///< with the channel elevation
  std::optional<Located<std::filesystem::path>> zero_run;
};

/// Drag of a cylinder at steady speed.
struct TowingModel : ::fit::towing::Options {
  static constexpr const char* kind = "towing";
  ::fit::Cylinder cylinder;
};

/// Period and damping of a body let go.
struct DecayModel : ::fit::decay::Options {
  static constexpr const char* kind = "decay";
  std::optional<::fit::RestoredBody> body;  ///< where it is to tell added mass
};

/// Added mass and damping from forced oscillations.
struct RadiationModel {
  static constexpr const char* kind = "radiation";
  ::fit::RestoredBody body;
};

/// Friction of a joint whose load grows until it slips.
struct FrictionRampModel {
  static constexpr const char* kind = "friction ramp";
  ::fit::FrictionRampOptions options;
};

/// Numbers of a scene of motion, and what its run should tell.
struct MotionModel {
  static constexpr const char* kind = "motion";
  struct Parameter {
    ::fit::SimulationParameter number;  ///< named by its key, as number_at() reads it
    std::string unit;                   ///< as the scene writes it; the values are in it
    Place place;
  };
  struct Signal {
    std::string column = {}, of = {};     ///< of the file; of the run
    Located<std::string> deviation = {};  ///< of the noise, with its unit; of a track, where its place is the signal's
    std::vector<std::string> between = {};  ///< two markers of a track: the angle of the line through them
    std::string marker = {}, along = {};    ///< one marker: its coordinate x, y or z
    double zero = 0;                        ///< rad, direction of the line where the signal is zero
  };
  Located<std::filesystem::path> scene = {};
  double window = 0;               ///< s; 0: the record is one run from the scene's start
  std::optional<int> starts = {};  ///< of the search; none: one, and others where it is refused
  int iterations = 60;
  std::vector<Parameter> parameters = {};
  std::vector<Signal> signals = {};
  bool profile = false, accept_residuals = false;
  std::optional<CameraTable> camera = {};          ///< files are tracks
  std::vector<Located<std::string>> columns = {};  ///< names of a track's columns, where the file has none
  std::string time_unit = {}, position_unit = {};  ///< of a track, where the file has none
  Place place = {};                                ///< of [model]
};

using FitModel = std::variant<MorisonModel, TowingModel, DecayModel, RadiationModel, FrictionRampModel, MotionModel>;

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

  FitModel model;
  Place model_place;
  double confidence = 0.95;
  std::vector<Echo> echo;

  /// As [model] writes it: "morison", "friction ramp".
  std::string kind() const {
    return std::visit([](const auto& m) { return std::string(m.kind); }, model);
  }
  /// What moved is an angle, or what was measured a torque.
  bool turns() const { return channels.count("angle") + channels.count("torque") > 0; }
};

/// The words of a scene for these: "water moves", "cycle clusters".
std::string word_of(::fit::Experiment experiment);
std::string word_of(::fit::IntervalMethod method);

/// True if the file has a [model] table, that is, asks for a fit.
bool is_fit(const std::filesystem::path& file);
/// Reads a scene of kind "fit"; the data files must be there. \throws hydro::InputError
FitScene read_fit(const std::filesystem::path& file);
FitScene parse_fit(std::string_view text, const std::filesystem::path& file);

}  // namespace froude::scene
