#pragma once
/// \file  What [model] says of each kind of fit. What libfit takes as an option stands here as libfit's own type, so
///        that no option and no default is written twice.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "answers/camera.hpp"
#include "fit/forced_radiation.hpp"
#include "fit/friction_ramp.hpp"
#include "fit/problem/decay.hpp"
#include "fit/problem/morison.hpp"
#include "fit/problem/towing.hpp"
#include "fit/simulated.hpp"
#include "scene/scene.hpp"

namespace froude::scene {

template <class T>
class Binding;
class Record;
struct FitTables;

/// Drag and inertia of a cylinder.
struct MorisonModel : ::fit::morison::Options {
  ::fit::Cylinder cylinder;
  std::optional<::fit::ProbeToBody> probe;  ///< with the channel elevation
  std::optional<Located<std::filesystem::path>> zero_run;
  std::optional<Place> law_asked;  ///< where [ask] law stands
};

/// Drag of a cylinder at steady speed.
struct TowingModel : ::fit::towing::Options {
  ::fit::Cylinder cylinder;
  bool recorded = false;  ///< files hold records over time, not means
  std::optional<Located<std::filesystem::path>> zero_run;
};

/// Period and damping of a body let go.
struct DecayModel : ::fit::decay::Options {
  std::optional<::fit::RestoredBody> body;  ///< where it is to tell added mass
};

/// Added mass and damping from forced oscillations.
struct RadiationModel {
  ::fit::RestoredBody body;
};

/// Numbers of a scene of motion, and what its run should tell.
struct MotionModel {
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
  /// One of several, with what its scene has otherwise.
  struct Record {
    std::string name = {};
    Located<std::filesystem::path> file = {};
    std::optional<double> start =
        {};                  ///< s, in the file's time: when the run begins; none: 0, of a track as [camera] says
    Place start_place = {};  ///< where the scene says it, or names the file
    std::optional<double> end = {};                            ///< s, in the file's time
    std::optional<Located<std::filesystem::path>> scene = {};  ///< empty: that of the model
    std::vector<Parameter> set = {};                           ///< held at their first values
    std::vector<Parameter> parameters = {};                    ///< fitted to this record alone
    std::optional<CameraTable> camera = {};                    ///< of a track, in place of that of the scene
    Place place = {};
  };
  Located<std::filesystem::path> scene = {};
  double window = 0;               ///< s; 0: the record is one run from the scene's start
  std::optional<int> starts = {};  ///< of the search; none: one, and others where it is refused
  int iterations = 60;
  std::vector<Parameter> parameters = {};  ///< which all records share
  std::vector<Record> records = {};        ///< one at least
  std::vector<Signal> signals = {};
  bool profile = false, accept_residuals = false;
  std::optional<CameraTable> camera = {};          ///< files are tracks
  std::vector<Located<std::string>> columns = {};  ///< names of a track's columns, where the file has none
  std::string time_unit = {}, position_unit = {};  ///< of a track, where the file has none
  Place place = {}, data_place = {};               ///< of [model] and [data]

  /// Of a track.
  const CameraTable& camera_of(const Record& record) const { return record.camera ? *record.camera : *camera; }
};

// What two kinds have alike.

/// Keys of [model] that describe a cylinder and its water: in fit_towing.cpp.
Binding<::fit::Cylinder> cylinder_keys();
/// [model.uncertainty] without the mass: in fit_towing.cpp.
Binding<::fit::CylinderErrors> cylinder_errors();
/// A standard uncertainty, SI, that is as large as what it is of. A mass of zero is one that was taken off already, and
/// may well have one.
struct TooUncertain {
  const char* name;  ///< "diameter", in [model.uncertainty]
  const char* key;   ///< of what it is of: the same, or "mass_beyond_load_cells"
  double error, size;
};
/// In fit_towing.cpp.
std::optional<TooUncertain> too_uncertain(const ::fit::Cylinder& cylinder, const ::fit::CylinderErrors& errors);
/// \throws hydro::InputError at the key of [model.uncertainty]
void check_errors(const Record& model, const ::fit::Cylinder& cylinder, const ::fit::CylinderErrors& errors);
/// [model.body]: in fit_radiation.cpp.
Binding<::fit::RestoredBody> restored_body();
/// \throws hydro::InputError for a mass beside an angle, an inertia beside a position
void check_restored(const FitTables& tables);

}  // namespace froude::scene
