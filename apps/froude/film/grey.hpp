#pragma once
/// \file  Pictures as OpenCV takes them. Private to those files that include it.
#include <opencv2/core.hpp>

#include "fit/camera/picture.hpp"

namespace froude::film {

/// The same pixels, not copied.
inline cv::Mat grey_of(const ::fit::camera::Picture& picture) {
  return {picture.height, picture.width, CV_8UC1, const_cast<std::uint8_t*>(picture.grey.data())};
}

}  // namespace froude::film
