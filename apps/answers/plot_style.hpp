#pragma once
/// \file  What all figures have alike: colours, letters, the page. Private to apps.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <string>

#include "answers/plot.hpp"

namespace froude::plot {

/// Colours that stay apart for colour-blind readers and in print; after the last one the lines repeat dashed.
inline constexpr std::array<const char*, 7> colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                    "#e69f00", "#56b4e9", "#333333"};
/// Pixels: a row of a legend, its swatch with the gap, and a letter of its text.
inline constexpr double legend_row = 20, legend_swatch = 28, character_width = 7.2;

inline constexpr const char* style_sheet =
    "text{font-family:sans-serif;fill:#222}.title{font-size:17px;font-weight:bold}.label{font-size:14px}"
    ".tick,.legend{font-size:13px}.grid{stroke:#ddd;stroke-width:1}.frame{fill:none;stroke:#666;stroke-width:1}"
    ".curve{fill:none;stroke-width:1.6;stroke-linejoin:round}.contour{fill:none;stroke:#fff;stroke-width:1.2}";

using Buffer = fmt::memory_buffer;

template <class... Args>
void put(Buffer& out, fmt::format_string<Args...> text, Args&&... args) {
  fmt::format_to(std::back_inserter(out), text, std::forward<Args>(args)...);
}

/// "heave RAO [m/m]", as XML.
std::string axis_text(const Axis& axis);

inline std::size_t characters(const std::string& utf8) {
  return static_cast<std::size_t>(std::count_if(utf8.begin(), utf8.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

/// White paper with a title over the middle `title_x`.
inline void begin_page(Buffer& out, int width, double height, double title_x, const std::string& title) {
  put(out, "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1:.0f}\" viewBox=\"0 0 {0} {1:.0f}\">\n",
      width, height);
  put(out, "<style>{}</style>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n", style_sheet);
  put(out, "<text class=\"title\" x=\"{:.1f}\" y=\"26\" text-anchor=\"middle\">{}</text>\n", title_x, escaped(title));
}

}  // namespace froude::plot
