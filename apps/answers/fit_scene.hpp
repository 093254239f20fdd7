#pragma once
/// \file  A scene that fits coefficients to measurements, as the user wrote it: typed, in SI, every default filled in;
///        nothing of libfit is called to read it.
#include <any>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "answers/overlay.hpp"
#include "scene/override.hpp"
#include "scene/scene.hpp"
#include "scene/schema.hpp"

namespace froude::scene {

class FitKind;

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
  struct Line {
    std::string column;                   ///< of the data files: the readings of a channel
    Located<std::filesystem::path> file;  ///< of its calibration
    std::string reading, reference;       ///< columns of that file
    Place place;
  };
  std::vector<Line> lines;  ///< channels that stand in the files as readings

  std::vector<Overlay> overlays;  ///< tables upon its picture

  const FitKind* of = nullptr;  ///< its kind, which lives as long as the program
  std::any settings;            ///< what the tables say of that kind
  Place model_place;
  double confidence = 0.95;
  std::vector<Echo> echo;

  /// As [model] writes it: "morison", "friction ramp".
  const std::string& kind() const;
  /// Of fit_models.hpp, for a scene of its kind; another is a mistake of ours.
  template <class Model>
  const Model& model() const {
    return std::any_cast<const Model&>(settings);
  }
  /// What moved is an angle, or what was measured a torque.
  bool turns() const { return channels.count("angle") + channels.count("torque") > 0; }
};

/// True if the file has a [model] table, that is, asks for a fit.
bool is_fit(const std::filesystem::path& file);
/// Reads a scene of kind "fit"; the data files must be there. \throws hydro::InputError
FitScene read_fit(const std::filesystem::path& file);
/// The same of a text, with other values in these places.
FitScene parse_fit(std::string_view text, const std::filesystem::path& file,
                   const std::vector<OverriddenValue>& values = {});

const Table& fit_schema();  ///< root of a scene that fits coefficients to measurements

/// The reference of all keys, of motions and of fits, generated from the very tables that the reader uses (Markdown).
std::string key_reference();

}  // namespace froude::scene
