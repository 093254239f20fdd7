#pragma once
/// \file  Line plots as SVG: what a reader of a report needs, nothing interactive.
///
/// A figure is one or more panels, stacked, that share a width. The legend stands right of its panel, never on curves.
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace froude::plot {

enum class Scale { linear, logarithmic };

/// One axis: what is drawn along it, in which unit, and optionally its range; an empty range is fitted to the data.
struct Axis {
  std::string label;      ///< "heave RAO"
  std::string unit = {};  ///< "m/m"; "" for a number; shown as "label [unit]"
  Scale scale = Scale::linear;
  std::optional<std::pair<double, double>> range = {};
};

/// One curve, or marks, or both. Points that are not finite, or not positive on a logarithmic axis, break the line.
struct Series {
  std::string name;          ///< in the legend; "" keeps it out of the legend
  std::vector<double> x, y;  ///< of equal length
  bool line = true, marks = false, dashed = false;
  std::string colour = {};  ///< "#d00000"; "" takes the next of those that tell series apart
};

/// A shaded region between two curves, for example a confidence interval.
struct Band {
  std::string name;
  std::vector<double> x, low, high;  ///< of equal length
};

/// Values at the points of a grid, drawn as colours with contours at round values, and a scale left of the legend.
struct Field {
  Axis value;
  std::vector<double> xs, ys;               ///< rising, two and more each
  std::vector<std::vector<double>> values;  ///< [y][x]; what is not finite stays blank
};

struct Panel {
  Axis x, y;  ///< with a field their ranges are its own
  std::vector<Series> series;
  std::vector<Band> bands = {};
  std::optional<Field> field = {};
  bool equal_scales = false;  ///< a metre is as long up as along; the range that has room left becomes wider
};

struct Figure {
  std::string title;
  std::vector<Panel> panels;
  int width = 900;         ///< px
  int panel_height = 300;  ///< px
};

/// The figure as a complete SVG document.
/// \throws std::logic_error in audit builds if the lengths of a series disagree
std::string svg(const Figure& figure);

/// Round values that cover [low, high] from inside, about `wanted` of them; steps are 1, 2 or 5 times a power of ten.
/// On a logarithmic scale: powers of ten, with 2 and 5 between them where there are fewer than three.
std::vector<double> ticks(double low, double high, Scale scale, int wanted = 6);

/// The text beside a tick: shortest form that tells neighbours `step` apart ("0.25", "1e5").
std::string tick_label(double value);

/// A unit as it is printed: "m^2/Hz" becomes "m²/Hz".
std::string with_superscripts(const std::string& unit);

/// Text with the five characters that XML reserves replaced by entities.
std::string escaped(const std::string& text);

}  // namespace froude::plot
