#pragma once
/// \file  Markers that are no discs, through OpenCV: squares with numbers in them (its aruco module, an optional one),
///        and places that look like a picture of one.
#include <Eigen/Core>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "fit/camera/picture.hpp"

namespace froude::film {

/// Names of the families of tags that are known, as `--tags` takes them: "apriltag 36h11", "aruco 4x4 50".
std::vector<std::string> tag_families();

struct Tag {
  int number;
  std::array<Eigen::Vector2d, 4> corners;  ///< px, good to about one
};

class TagReader {
 public:
  /// \throws hydro::InputError for a family that is not known, or a build without that module
  explicit TagReader(const std::string& family);
  ~TagReader();
  TagReader(TagReader&&) noexcept;
  /// Those that are seen, each with the number that its pattern says.
  std::vector<Tag> read(const ::fit::camera::Picture& picture) const;
  int count() const;  ///< of the family's tags, numbered from 0
  /// To be printed, with a rim of one cell: cells of so many pixels.
  ::fit::camera::Picture drawn(int number, int cell_px) const;

 private:
  struct Family;
  std::unique_ptr<Family> family_;
};

/// Where the picture looks like the pattern: whole pixels of its middle, at which the normalised correlation is at
/// least `least` and larger than at all places that the pattern would overlap by half. Best first.
std::vector<Eigen::Vector2d> places_like(const ::fit::camera::Picture& picture, const ::fit::camera::Picture& pattern,
                                         double least);

}  // namespace froude::film
