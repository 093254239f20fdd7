#include "froude/film/markers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#ifdef FROUDE_TAGS
#include <opencv2/aruco.hpp>
#endif
#include <utility>

#include "froude/film/grey.hpp"
#include "hydro/base/error.hpp"

namespace froude::film {

using fit::camera::Picture;

#ifdef FROUDE_TAGS

namespace {

const std::vector<std::pair<std::string, cv::aruco::PREDEFINED_DICTIONARY_NAME>>& families() {
  static const std::vector<std::pair<std::string, cv::aruco::PREDEFINED_DICTIONARY_NAME>> all{
      {"apriltag 36h11", cv::aruco::DICT_APRILTAG_36h11}, {"apriltag 36h10", cv::aruco::DICT_APRILTAG_36h10},
      {"apriltag 25h9", cv::aruco::DICT_APRILTAG_25h9},   {"apriltag 16h5", cv::aruco::DICT_APRILTAG_16h5},
      {"aruco 4x4 50", cv::aruco::DICT_4X4_50},           {"aruco 4x4 100", cv::aruco::DICT_4X4_100},
      {"aruco 5x5 50", cv::aruco::DICT_5X5_50},           {"aruco 5x5 100", cv::aruco::DICT_5X5_100},
      {"aruco 6x6 50", cv::aruco::DICT_6X6_50},           {"aruco 6x6 250", cv::aruco::DICT_6X6_250},
      {"aruco original", cv::aruco::DICT_ARUCO_ORIGINAL}};
  return all;
}

}  // namespace

struct TagReader::Family {
  cv::Ptr<cv::aruco::Dictionary> tags;
};

std::vector<std::string> tag_families() {
  std::vector<std::string> out;
  for (const auto& [name, of] : families()) out.push_back(name);
  return out;
}

TagReader::TagReader(const std::string& family) : family_(std::make_unique<Family>()) {
  for (const auto& [name, of] : families())
    if (name == family) family_->tags = cv::aruco::getPredefinedDictionary(of);
  if (family_->tags) return;
  const auto known = tag_families();
  throw hydro::InputError(fmt::format("there is no family of tags \"{}\"", family), {},
                          fmt::format("families are {}", fmt::join(known, ", ")));
}

std::vector<Tag> TagReader::read(const Picture& picture) const {
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> numbers;
  cv::aruco::detectMarkers(grey_of(picture), family_->tags, corners, numbers);
  std::vector<Tag> out;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    Tag tag{numbers[i], {}};
    for (std::size_t k = 0; k < 4; ++k) tag.corners[k] = {double(corners[i][k].x), double(corners[i][k].y)};
    out.push_back(tag);
  }
  return out;
}

int TagReader::count() const { return family_->tags->bytesList.rows; }

Picture TagReader::drawn(int number, int cell_px) const {
  const int cells = family_->tags->markerSize + 2;
  cv::Mat tag;
  cv::aruco::drawMarker(family_->tags, number, cells * cell_px, tag);
  Picture out(tag.cols + 2 * cell_px, tag.rows + 2 * cell_px);
  std::fill(out.grey.begin(), out.grey.end(), std::uint8_t{255});
  cv::Mat whole = grey_of(out);
  tag.copyTo(whole(cv::Rect(cell_px, cell_px, tag.cols, tag.rows)));
  return out;
}

#else

struct TagReader::Family {};

std::vector<std::string> tag_families() { return {}; }
TagReader::TagReader(const std::string&) {
  throw hydro::InputError("this build reads no tags: OpenCV's aruco module is not there", {},
                          "install libopencv-contrib-dev (`scripts/setup camera` does) and build again");
}
std::vector<Tag> TagReader::read(const Picture&) const { return {}; }
int TagReader::count() const { return 0; }
Picture TagReader::drawn(int, int) const { return {}; }

#endif

TagReader::~TagReader() = default;
TagReader::TagReader(TagReader&&) noexcept = default;

std::vector<Eigen::Vector2d> places_like(const Picture& picture, const Picture& pattern, double least) {
  if (picture.width < pattern.width || picture.height < pattern.height) return {};
  cv::Mat likeness;
  cv::matchTemplate(grey_of(picture), grey_of(pattern), likeness, cv::TM_CCOEFF_NORMED);
  std::vector<Eigen::Vector2d> out;
  const Eigen::Vector2d half((pattern.width - 1) / 2.0, (pattern.height - 1) / 2.0);
  for (;;) {
    double best = 0;
    cv::Point at;
    cv::minMaxLoc(likeness, nullptr, &best, nullptr, &at);
    if (!(best >= least)) return out;
    out.push_back(half + Eigen::Vector2d(at.x, at.y));
    const cv::Rect around(at.x - pattern.width / 2, at.y - pattern.height / 2, pattern.width, pattern.height);
    likeness(around & cv::Rect(0, 0, likeness.cols, likeness.rows)) = -1.0;
  }
}

}  // namespace froude::film
