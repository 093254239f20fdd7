#pragma once
/// \file  Tracks in files: those of `froude track`, and those of other programs as they are.
///
///   mass A                                  title lines before the line that names the columns
///   t [s]; bob_x [px]; bob_y [px]           ";", tabs, "," or blanks between; units here or from who reads
///   0,00; 512,31; 388,02                    decimal comma where a comma does not separate
///   0,04; ; NaN                             a marker that was not seen: empty, NaN, NA or -
///
///        or HDF5 (netCDF-4), whose columns are the one-dimensional datasets of the root, with attributes `units`.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "fit/camera/track.hpp"

namespace fit::camera {

/// What the file does not say of itself.
struct TrackColumns {
  struct Of {
    std::string marker, x, y;  ///< names of columns
  };
  std::vector<std::string> names = {};  ///< of all columns, where no line names them
  std::string time = {};                ///< a column; "" where `frames_per_second` counts
  double frames_per_second = 0;         ///< rows are frames, the first at 0 s; 0: there is a column of time
  std::vector<Of> markers = {};  ///< empty: all pairs NAME_x, NAME_y (or x_NAME, NAME.x; x and y alone: "marker")
  std::string time_unit = {}, position_unit = {};  ///< where the file has none: "s", "ms"; "px", "mm"
};

/// Times in s, places in px or m. Columns NAME_xx, NAME_xy, NAME_yy are covariances.
/// \throws hydro::InputError with line and column: an unreadable file, no row of numbers, a ragged row, text among
/// numbers, a missing or unknown unit, a missing column, no marker, time that does not increase
Track read_track(const std::filesystem::path& path, const TrackColumns& columns);
Track parse_track(std::string_view text, const std::string& file_name, const TrackColumns& columns);

/// As read_track() takes it without being told anything but `time = "t"`: HDF5 for the endings .h5 and .nc, else CSV,
/// which rounds places to eight digits. \throws hydro::InputError
void write_track(const std::filesystem::path& path, const Track& track, const std::vector<std::string>& comments);

}  // namespace fit::camera
