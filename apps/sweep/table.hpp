#pragma once
/// \file  What a sweep comes to, for people: a table, curves and maps.
#include <filesystem>
#include <string>
#include <vector>

#include "sweep/store.hpp"

namespace froude::sweep {

/// One row a case, in the folder of the sweep: table.csv. \throws hydro::InputError if it cannot be written
std::filesystem::path write_table(const Store& store);

struct Pictures {
  std::vector<std::filesystem::path> written;
  std::vector<std::string> waiting;  ///< names of maps for which the cases that are done make no grid yet
};

/// The pictures of the study, each with its numbers in a .csv beside it. \throws hydro::InputError at a picture of a
/// column that there is not
Pictures write_pictures(const Study& study, const Store& store);

}  // namespace froude::sweep
