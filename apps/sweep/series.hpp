#pragma once
/// \file  Private to sweep: time series that a sweep keeps beside its database.
#include <filesystem>
#include <string>

#include "froude/result.hpp"
#include "sweep/store.hpp"

namespace froude::sweep {

/// Writes the run of a case, and names it in the row with the digest of its bytes. \throws hydro::InputError where the
/// file cannot be written
void keep_series(const Run& run, const std::filesystem::path& folder, Row& row);

/// True if a row names a file that is in the folder as it was written.
bool has_series(const std::filesystem::path& folder, const Row& row);

}  // namespace froude::sweep
