#pragma once
/// \file  What a report shows of results: one JSON object for each. The page (report/web) draws them.
///
/// Every object has `kind`, `name` (of the file) and `facts` (pairs of a word and a text). Numbers are in SI; arrays
/// are those of arrays.hpp. What a result does not hold is absent, or stands as a sentence under `missing`.
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answers/fit_kind.hpp"
#include "answers/fit_scene.hpp"
#include "froude/result.hpp"
#include "hydro/io/hdf5.hpp"
#include "report/arrays.hpp"

namespace froude::html {

/// Pairs of a word and a text, in this order; a brace list of pairs would be an object.
using Facts = std::vector<std::pair<std::string, std::string>>;

struct Options {
  double from = 0;                                    ///< s: statistics and spectra leave out what comes before
  std::optional<std::filesystem::path> scene_folder;  ///< where scenes of results stood; none: beside the result
  std::size_t points = 800'000;                       ///< of all series of a result together
};

/// Names of the attributes of a group or dataset, in the order in which they were written where the file keeps that,
/// else sorted. \throws hydro::InputError if the file or the object is not there
std::vector<std::string> attribute_names(const std::filesystem::path& file, const std::string& object);

/// What a result file of any kind tells of how it came about: version, date, scene, settings, notes, energy, times.
Json told_of(const hydro::io::Hdf5Reader& file, const std::filesystem::path& path);

/// A result of `froude run` or `froude waves make`. \throws hydro::InputError if it is none, or `from` leaves nothing
Json run_contents(const std::filesystem::path& path, const Options& options);

/// How two runs differ, signal by signal that both have, over the time that both cover: {"first", "second", "rows"}.
/// The second is interpolated linearly at the samples of the first.
Json run_difference(const std::filesystem::path& first, const std::filesystem::path& second, const Options& options);

/// A result of `froude rao`. \throws hydro::InputError
Json rao_contents(const std::filesystem::path& path);
/// A result of `froude modes`. \throws hydro::InputError
Json modes_contents(const std::filesystem::path& path);
/// A result of `froude field`, with the outlines of the bodies that make waves. \throws hydro::InputError
Json field_contents(const std::filesystem::path& path, const Options& options);
/// Spectra of `froude psd`, .h5. \throws hydro::InputError
Json spectra_contents(const std::filesystem::path& path);
/// Tables of `froude psd`, `froude response` and others, .csv, along their first column. \throws hydro::InputError
Json table_contents(const std::filesystem::path& path);
/// Warnings of a case without the word "warning: " before each, which the page writes itself.
std::string without_the_word(std::string warnings);
/// A folder of `froude sweep`. \throws hydro::InputError
Json sweep_contents(const std::filesystem::path& folder);
/// Estimates that `froude fit -o` has written, .toml. \throws hydro::InputError
Json estimates_contents(const std::filesystem::path& path);
/// A fit that has just been made; `facts`: what the command tells programs of it.
Json fit_contents(const scene::FitScene& scene, const scene::FitAnswer& answer, const Json& facts);

/// What moves in a run, for the animation: bodies with shapes and poses, lines, the surface of the waves; notes say
/// what is not as it is. `scene_text` is read as if it stood in `folder`; where that cannot be, {"missing": why}.
Json view_of(const RunResult& run, const std::string& scene_text, const std::filesystem::path& scene_file);

}  // namespace froude::html
