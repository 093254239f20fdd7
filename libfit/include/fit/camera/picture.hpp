#pragma once
/// \file  A grey picture: the only form in which films reach the mathematics, whatever read them.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace fit::camera {

struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> grey;  ///< 0 black to 255 white, row after row from the top

  Picture() = default;
  Picture(int w, int h) : width(w), height(h), grey(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  const std::uint8_t* row(int y) const {
    return grey.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  }
  std::uint8_t* row(int y) { return grey.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width); }
  std::uint8_t at(int x, int y) const { return row(y)[x]; }
};

}  // namespace fit::camera
