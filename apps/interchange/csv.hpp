#pragma once
/// \file  Results as tables, in the form that hydro/io/csv.hpp reads.
#include <filesystem>
#include <string>
#include <vector>

#include "interchange/content.hpp"

namespace froude::interchange {

/// One row for each value of the axes of the largest array, the last axis fastest; one column an array. Of complex
/// responses amplitude and phase, deg; of other complex numbers real and imaginary part. An array along an axis of
/// texts has a column for each. Frequencies have their periods beside them, headings are in degrees.
/// \return names of arrays along other axes, which the table leaves out
/// \throws hydro::InputError if there is no array with an axis, or the file cannot be written
std::vector<std::string> write_csv(const std::filesystem::path& path, const Content& content);

}  // namespace froude::interchange
