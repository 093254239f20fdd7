#pragma once
/// \file  Fits of radiation memory and solved hulls that a program keeps from one start to the next.
#include <filesystem>
#include <optional>

namespace froude {

/// From now on this process looks for fits of radiation memory (1.3 MB each for five bodies), and for coefficients of
/// meshes, in a folder, before it makes them, and keeps there those that it made; at first it does not, nor after an
/// empty `folder`. What is kept is known by all numbers of its data, its tolerance and the program that made it, so
/// that results are the same to the bit with the folder and without; a note tells that something was kept. A folder
/// that cannot be written serves as far as it can be read. At most 256 MiB are kept, what was longest unused goes.
void keep_fits_in(const std::optional<std::filesystem::path>& folder);

/// Where the program `froude` keeps them: $XDG_CACHE_HOME/froude, or ~/.cache/froude. None if the environment has
/// FROUDE_CACHE=off, or no such folder.
/// \throws hydro::InputError where FROUDE_CACHE says anything but "on" or "off"
std::optional<std::filesystem::path> users_folder_of_fits();

}  // namespace froude
