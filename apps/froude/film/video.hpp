#pragma once
/// \file  Films and pictures in files, through OpenCV, of which nothing is seen outside video.cpp and calibrate.cpp.
#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fit/camera/picture.hpp"

namespace froude::film {

using Path = std::filesystem::path;
using Colour = std::array<std::uint8_t, 3>;  ///< red, green, blue

/// What to do with a film that cannot be decoded.
std::string how_to_convert(const Path& file);

/// The frames of a film, one after the other.
class FilmReader {
 public:
  /// \throws hydro::InputError for a file that is not there, or that OpenCV cannot decode
  explicit FilmReader(const Path& file);
  ~FilmReader();
  FilmReader(const FilmReader&) = delete;
  FilmReader& operator=(const FilmReader&) = delete;

  Eigen::Vector2i size() const;  ///< px, width and height
  double frame_rate() const;     ///< Hz, as the file states it; 0 where it does not
  std::size_t frames() const;    ///< as the file states it; 0 where it does not
  /// The name of the codec where it loses what is fine, "avc1"; empty where it keeps every pixel, or is not known.
  std::string lossy_codec() const;
  /// The next frame and its time in the file, s. Grey is the brightness, or, with a colour, how near to it a pixel is:
  /// 255 at that colour, 0 from a distance of 170 levels in all three together on. False after the last one.
  bool next(fit::camera::Picture& picture, double& time_s, const std::optional<Colour>& colour = {});

 private:
  struct Video;
  std::unique_ptr<Video> video_;
};

/// A film that is written frame by frame: FFV1 without loss for .avi and .mkv, MPEG-4 for .mp4.
class FilmWriter {
 public:
  /// \throws hydro::InputError for another ending, or where the file cannot be written
  FilmWriter(const Path& file, const Eigen::Vector2i& size, double frame_rate);
  ~FilmWriter();
  FilmWriter(const FilmWriter&) = delete;
  FilmWriter& operator=(const FilmWriter&) = delete;
  void add(const fit::camera::Picture& picture);

 private:
  friend class Annotation;
  struct Video;
  std::unique_ptr<Video> video_;
};

/// A picture on which places are marked, in colour.
class Annotation {
 public:
  explicit Annotation(const fit::camera::Picture& picture);
  ~Annotation();
  Annotation(Annotation&&) noexcept;
  void circle(const Eigen::Vector2d& centre, double radius, const Colour& colour);
  void cross(const Eigen::Vector2d& centre, double size, const Colour& colour);
  void path(const std::vector<Eigen::Vector2d>& points, const Colour& colour);
  void label(const Eigen::Vector2d& at, const std::string& text, const Colour& colour);
  void add_to(FilmWriter& film) const;
  void write(const Path& file) const;  ///< .png or .jpg. \throws hydro::InputError

 private:
  struct Canvas;
  std::unique_ptr<Canvas> canvas_;
};

/// \throws hydro::InputError for a file that is no picture
fit::camera::Picture read_picture(const Path& file);
void write_picture(const Path& file, const fit::camera::Picture& picture);

/// One colour a marker, the same in every picture.
Colour colour_of(std::size_t marker);

}  // namespace froude::film
