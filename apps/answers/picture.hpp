#pragma once
/// \file  Figures as files: SVG, and PNG or PDF made of it by librsvg's program, by the ending of the name.
#include <filesystem>

#include "answers/plot.hpp"

namespace froude::plot {

/// A name that ends in .svg, .png or .pdf, or has no ending, which stands for SVG (`/dev/stdout`). \throws
/// hydro::InputError for another ending, and for .png and .pdf where `rsvg-convert` is not installed
void require_picture(const std::filesystem::path& file);

/// Writes the figure, whole or not at all; PNG with twice as many pixels as the figure has, on white. \throws
/// hydro::InputError as require_picture(), if `rsvg-convert` fails, and if the file cannot be written
void write_picture(const std::filesystem::path& file, const Figure& figure);

/// The same of what is an SVG document already.
void write_svg(const std::filesystem::path& file, const std::string& drawn);

}  // namespace froude::plot
