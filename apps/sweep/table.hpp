#pragma once
/// \file  What a sweep comes to, for people: a table, curves and maps.
#include <filesystem>
#include <vector>

#include "sweep/store.hpp"

namespace froude::sweep {

/// One row a case, in the folder of the sweep: table.csv. \throws hydro::InputError if it cannot be written
std::filesystem::path write_table(const Store& store);

/// The pictures of the study, each with its numbers in a .csv beside it. \throws hydro::InputError at a picture of a
/// column that there is not, or a map over axes that are no grid
std::vector<std::filesystem::path> write_pictures(const Study& study, const Store& store);

}  // namespace froude::sweep
