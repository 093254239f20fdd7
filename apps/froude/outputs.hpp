#pragma once
/// \file  What a command writes must not be what it reads. Each command says once, before any work, which files it will
/// write and which it reads, under the names that its user knows.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "froude/commands.hpp"

namespace froude {

/// A file and what it is to the command: "-o", "--csv"; "the scene", "[waves] file".
struct NamedFile {
  std::string use;
  Path path;
};

/// The files of options that were given.
std::vector<NamedFile> named(const std::vector<std::pair<std::string, std::optional<Path>>>& options);

/// Every output can be written, is none of the inputs and none of the other outputs. Links are followed, so another
/// name of a file is that file (hydro::io::same_file). \throws hydro::InputError naming the file and both of its uses
void require_outputs(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs);

/// \throws hydro::InputError if a table that was asked for has another ending than .csv
void require_csv(const std::optional<Path>& table);

/// \throws hydro::InputError if the name of a result ends in anything but .h5 or .nc; `tables` says how to have tables
void require_result(const Path& file, const std::string& tables);

/// \throws hydro::InputError as plot::require_picture(), if one was asked for
void require_picture(const std::optional<Path>& picture);

/// A scene of motion or a fit, and every file that it names: each text in it that leads to a file counts, so no key can
/// be forgotten; of records all that match a `*`; of coefficients the whole set; of a scene and of a table of runs the
/// files that they name in turn. \throws hydro::InputError if the scene is no TOML
std::vector<NamedFile> files_of_scene(const Path& scene);

/// The files of coefficients that are given to a command, and what belongs to them.
std::vector<NamedFile> files_of_coefficients(const std::vector<Path>& files);

/// All files of a folder and the folders in it.
std::vector<NamedFile> files_below(const std::string& use, const Path& folder);

}  // namespace froude
