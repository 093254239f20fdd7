#pragma once
/// \file  Coefficients written in the format that the name of the file tells.
#include <string>
#include <vector>

#include "froude/commands.hpp"
#include "froude/outputs.hpp"

namespace froude {

enum class CoefficientFormat { froude, bemio, wamit, capytaine };

/// From `format` if it is not empty, else from the end of the name. \throws InputError
CoefficientFormat format_of(const Path& output, const std::string& format);

/// The files that write_as() may write, each to be told as `use`.
std::vector<NamedFile> files_to_write(CoefficientFormat format, const Path& output, const std::string& use = "-o");

/// The files that were written, and a sentence for each thing that the format cannot hold.
struct WrittenCoefficients {
  std::vector<std::string> files, left_out;
};
WrittenCoefficients write_as(CoefficientFormat format, const hydro::potential::Coefficients& c, const Path& output);

}  // namespace froude
