#pragma once
/// \file  A study as the user wrote it: a scene, axes over its keys, what of each case is told, what is drawn.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "answers/overlay.hpp"
#include "scene/scene.hpp"
#include "scene/schema.hpp"

namespace froude::sweep {

using scene::Located, scene::Place;

/// Keys of the scene that take one value after the other.
struct Axis {
  std::string name;  ///< of its column; that of the first key if the study gives none
  std::vector<Located<std::string>> keys;
  std::vector<std::string> values;  ///< as TOML writes them, `"2 m"`, 3; empty where there is a range
  Located<std::string> range;       ///< "2 s .. 8 s, 61 values"; ", every 0.5 s"; of a sampled axis its ends alone
  bool logarithmic = false;         ///< equal ratios from value to value
  std::optional<Located<std::string>> along;  ///< the axis that it changes with; else every value meets every other
  Place place;
};

/// Axes whose range gives no values take those of points that fill their space.
struct Sample {
  enum class Method { latin_hypercube, sobol } method = Method::latin_hypercube;
  std::int64_t number = 1;
  std::int64_t seed = 1;
  Place place;
};

/// Cases that are not to be run: where what is named lies above or below a limit, or outside of two.
struct Skip {
  Located<std::string> of;                  ///< an axis, or "steepness"
  std::optional<std::string> above, below;  ///< as TOML writes them
  Place place;
};

/// Numbers of an answer.
struct Output {
  enum class Kind { run, rao, modes, fit } kind = Kind::run;
  std::vector<Located<std::string>> of;  ///< signals or coefficients; * stands for any characters
  std::vector<std::string> statistics;
  double from = 0;         ///< s, of a run: what comes before is left out
  std::int64_t count = 1;  ///< of modes
  Place place;
};

/// Curves or a map of outputs, and their table beside it; or series of the runs over time.
struct Picture {
  Located<std::string> file;             ///< a name in the folder of the sweep
  std::vector<Located<std::string>> of;  ///< a panel each
  Located<std::string> x;
  std::optional<Located<std::string>> y, by;  ///< of a map its second axis; of curves what tells them apart
  std::optional<Located<std::string>> panel;  ///< an axis, each value of which has panels of its own
  std::vector<Overlay> overlays;
};

struct Study {
  std::filesystem::path file;
  std::string text, title;
  Located<std::filesystem::path> scene;
  std::vector<Axis> axes;
  std::optional<Sample> sample;
  std::vector<Skip> skips;
  std::vector<Output> outputs;
  std::vector<Picture> pictures;
  bool series = false;                                     ///< of runs, kept in files
  std::optional<double> time_limit_s, memory_limit_bytes;  ///< of a case
};

/// Whether a picture draws series over the time of runs: it does unless an axis is called "time".
bool is_over_time(const Study& study, const Picture& picture);

/// "run", "rao", …
const std::string& name_of(Output::Kind kind);

/// \throws hydro::InputError with file, line, column, rule and remedy
Study read_study(const std::filesystem::path& file);
Study parse_study(std::string_view text, const std::filesystem::path& file);

const scene::Table& study_schema();

/// The reference of all keys, of scenes and of studies (Markdown).
std::string key_reference();

}  // namespace froude::sweep
