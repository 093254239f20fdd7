#include "answers/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "answers/plot_field.hpp"
#include "answers/plot_style.hpp"
#include "hydro/base/error.hpp"

namespace froude::plot {
namespace {

constexpr double left_margin = 84, right_margin = 24, title_height = 44, panel_bottom = 62, panel_gap = 10;
constexpr double scale_width = 110;

using Range = std::pair<double, double>;
bool drawable(double value, Scale scale) { return std::isfinite(value) && (scale == Scale::linear || value > 0); }

double transformed(double value, Scale scale) { return scale == Scale::linear ? value : std::log10(value); }

void widen(Range& range, const std::vector<double>& values, Scale scale) {
  for (const double value : values)
    if (drawable(value, scale)) range = {std::min(range.first, value), std::max(range.second, value)};
}

/// The range of an axis: as asked, or that of the data, with a margin of 5 % if `padded`.
Range fitted(const Axis& axis, Range data, bool padded) {
  if (axis.range) return *axis.range;
  if (data.first > data.second) return axis.scale == Scale::linear ? Range{0, 1} : Range{1, 10};  // nothing to draw
  double low = transformed(data.first, axis.scale), high = transformed(data.second, axis.scale);
  if (low == high) {
    const double half = axis.scale == Scale::linear && low != 0 ? 0.1 * std::abs(low) : 0.5;
    low -= half, high += half;
  } else if (padded) {
    const double margin = 0.05 * (high - low);
    low -= margin, high += margin;
  }
  return axis.scale == Scale::linear ? Range{low, high} : Range{std::pow(10, low), std::pow(10, high)};
}

/// One panel's rectangle on the page and the map from data to pixels.
struct Frame {
  double left, top, width, height;
  Range x, y;
  Scale x_scale, y_scale;

  static double fraction(double value, const Range& range, Scale scale) {
    const double low = transformed(range.first, scale), high = transformed(range.second, scale);
    return (transformed(value, scale) - low) / (high - low);
  }
  double px(double value) const { return left + width * fraction(value, x, x_scale); }
  double py(double value) const { return top + height * (1 - fraction(value, y, y_scale)); }
  bool shows(double a, double b) const { return drawable(a, x_scale) && drawable(b, y_scale); }
};

/// Widens one of the ranges, about its middle, until a pixel is as much of both.
void equalise(Frame& f) {
  const double per_pixel = std::max((f.x.second - f.x.first) / f.width, (f.y.second - f.y.first) / f.height);
  const auto widened = [&](const Range& range, double pixels) {
    const double middle = (range.first + range.second) / 2, half = per_pixel * pixels / 2;
    return Range{middle - half, middle + half};
  };
  f.x = widened(f.x, f.width);
  f.y = widened(f.y, f.height);
}

Frame frame_of(const Panel& panel, double top, double width, double height) {
  if (panel.field)
    return {left_margin,   top,          width, height, extent(panel.field->xs), extent(panel.field->ys),
            panel.x.scale, panel.y.scale};
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Range x{infinity, -infinity}, y{infinity, -infinity};
  for (const Series& s : panel.series) {
    hydro::ensure(s.x.size() == s.y.size(), "plot: a series has x and y of unequal length");
    widen(x, s.x, panel.x.scale);
    widen(y, s.y, panel.y.scale);
  }
  for (const Band& b : panel.bands) {
    hydro::ensure(b.x.size() == b.low.size() && b.x.size() == b.high.size(), "plot: a band has unequal lengths");
    widen(x, b.x, panel.x.scale);
    widen(y, b.low, panel.y.scale);
    widen(y, b.high, panel.y.scale);
  }
  Frame out{
      left_margin,   top,          width, height, fitted(panel.x, x, panel.equal_scales), fitted(panel.y, y, true),
      panel.x.scale, panel.y.scale};
  if (panel.equal_scales) equalise(out);
  return out;
}

void draw_axes(Buffer& out, const Panel& panel, const Frame& f) {
  const double bottom = f.top + f.height, right = f.left + f.width;
  for (const double t : ticks(f.x.first, f.x.second, f.x_scale, 8)) {
    put(out, "<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\"/>\n", f.px(t), f.top,
        bottom);
    put(out, "<text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n", f.px(t), bottom + 18,
        tick_label(t));
  }
  for (const double t : ticks(f.y.first, f.y.second, f.y_scale, 6)) {
    put(out, "<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{1:.1f}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/>\n", f.left, right,
        f.py(t));
    put(out, "<text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", f.left - 8,
        f.py(t) + 4.5, tick_label(t));
  }
  put(out, "<rect class=\"frame\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n", f.left, f.top,
      f.width, f.height);
  put(out, "<text class=\"label\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n", f.left + f.width / 2,
      bottom + 42, axis_text(panel.x));
  put(out,
      "<text class=\"label\" x=\"0\" y=\"0\" text-anchor=\"middle\" transform=\"translate(20 {:.1f}) "
      "rotate(-90)\">{}</text>\n",
      f.top + f.height / 2, axis_text(panel.y));
}

/// Indices to draw: of points that share a column of pixels, only the first, lowest, highest and last.
/// A long record then makes a small file that looks the same.
std::vector<std::size_t> thinned(const Series& s, const Frame& f) {
  std::vector<std::size_t> kept;
  const auto keep = [&](std::size_t i) {
    if (kept.empty() || kept.back() < i) kept.push_back(i);
  };
  const bool dense = static_cast<double>(s.x.size()) > 4 * f.width && std::is_sorted(s.x.begin(), s.x.end());
  for (std::size_t i = 0; i < s.x.size();) {
    std::size_t end = i + 1, low = i, high = i;
    if (dense && f.shows(s.x[i], s.y[i])) {
      const double column = std::floor(f.px(s.x[i]));
      for (; end < s.x.size() && f.shows(s.x[end], s.y[end]) && std::floor(f.px(s.x[end])) == column; ++end) {
        if (s.y[end] < s.y[low]) low = end;
        if (s.y[end] > s.y[high]) high = end;
      }
    }
    for (const std::size_t k : {i, std::min(low, high), std::max(low, high), end - 1}) keep(k);
    i = end;
  }
  return kept;
}

std::string path_of(const Series& s, const Frame& f) {
  Buffer path;
  bool pen_down = false;
  for (const std::size_t i : thinned(s, f)) {
    if (!f.shows(s.x[i], s.y[i])) {
      pen_down = false;
      continue;
    }
    put(path, "{}{:.1f} {:.1f}", pen_down ? "L" : "M", f.px(s.x[i]), f.py(s.y[i]));
    pen_down = true;
  }
  return fmt::to_string(path);
}

struct Style {
  const char* colour;
  bool dashed;
};
Style style_of(std::size_t index, const Series& series) {
  if (!series.colour.empty()) return {series.colour.c_str(), series.dashed};
  return {colours[index % colours.size()], series.dashed || index >= colours.size()};
}

void draw_series(Buffer& out, const Series& s, const Frame& f, Style style) {
  if (s.line)
    put(out, "<path class=\"curve\" stroke=\"{}\"{} d=\"{}\"/>\n", style.colour,
        style.dashed ? " stroke-dasharray=\"6 4\"" : "", path_of(s, f));
  if (!s.marks) return;
  for (std::size_t i = 0; i < s.x.size(); ++i)
    if (f.shows(s.x[i], s.y[i]))
      put(out, "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>\n", f.px(s.x[i]), f.py(s.y[i]), style.colour);
}

void draw_band(Buffer& out, const Band& b, const Frame& f, const char* colour) {
  Buffer path;
  std::vector<std::pair<double, double>> edge;
  for (std::size_t i = 0; i < b.x.size(); ++i)
    if (f.shows(b.x[i], b.high[i]) && f.shows(b.x[i], b.low[i])) edge.emplace_back(f.px(b.x[i]), f.py(b.high[i]));
  for (std::size_t i = b.x.size(); i-- > 0;)
    if (f.shows(b.x[i], b.high[i]) && f.shows(b.x[i], b.low[i])) edge.emplace_back(f.px(b.x[i]), f.py(b.low[i]));
  for (std::size_t i = 0; i < edge.size(); ++i)
    put(path, "{}{:.1f} {:.1f}", i ? "L" : "M", edge[i].first, edge[i].second);
  if (!edge.empty())
    put(out, "<path fill=\"{}\" fill-opacity=\"0.2\" stroke=\"none\" d=\"{}Z\"/>\n", colour, fmt::to_string(path));
}

Range range_of(const Field& field) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Range out{infinity, -infinity};
  for (const auto& row : field.values) widen(out, row, Scale::linear);
  return fitted(field.value, out, false);
}

void draw_field(Buffer& out, const Field& field, const Frame& f) {
  const Range range = range_of(field);
  constexpr double overlap = 0.3;  // px, so that no seams show between tiles
  for (const Tile& t : tiles_of(field))
    put(out, "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>\n", f.px(t.x0),
        f.py(t.y1), f.px(t.x1) - f.px(t.x0) + overlap, f.py(t.y0) - f.py(t.y1) + overlap,
        colour_at(Frame::fraction(t.value, range, Scale::linear)));
  for (const double level : ticks(range.first, range.second, Scale::linear)) {
    Buffer path;
    for (const auto& p : contour(field, level))
      put(path, "M{:.1f} {:.1f}L{:.1f} {:.1f}", f.px(p.x1), f.py(p.y1), f.px(p.x2), f.py(p.y2));
    put(out, "<path class=\"contour\" d=\"{}\"/>\n", fmt::to_string(path));
  }
}

/// Colours and what they stand for, with a line where a contour is.
void draw_scale(Buffer& out, const Field& field, const Frame& f, double left) {
  const Range range = range_of(field);
  constexpr int steps = 64;
  constexpr double bar = 18;
  const auto at = [&](double share) { return f.top + f.height * (1 - share); };
  for (int i = 0; i < steps; ++i)
    put(out, "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{:.1f}\" fill=\"{}\"/>\n", left,
        at((i + 1.0) / steps), bar, f.height / steps + 0.3, colour_at((i + 0.5) / steps));
  for (const double t : ticks(range.first, range.second, Scale::linear)) {
    const double y = at(Frame::fraction(t, range, Scale::linear));
    put(out, "<path class=\"contour\" d=\"M{:.1f} {:.1f}h{}\"/>\n", left, y, bar);
    put(out, "<text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", left + bar + 6, y + 4.5, tick_label(t));
  }
  put(out,
      "<text class=\"label\" x=\"0\" y=\"0\" text-anchor=\"middle\" transform=\"translate({:.1f} {:.1f}) "
      "rotate(-90)\">{}</text>\n",
      left + scale_width - 16, f.top + f.height / 2, axis_text(field.value));
}

void draw_legend(Buffer& out, const Panel& panel, double left, double top) {
  double y = top + 12;
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    const Series& s = panel.series[i];
    if (s.name.empty()) continue;
    const Style style = style_of(i, s);
    if (s.line)
      put(out,
          "<line x1=\"{0:.1f}\" x2=\"{1:.1f}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"{3}\" stroke-width=\"2\"{4}/>\n",
          left, left + legend_swatch - 6, y - 4, style.colour, style.dashed ? " stroke-dasharray=\"6 4\"" : "");
    if (s.marks)
      put(out, "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>\n", left + (legend_swatch - 6) / 2, y - 4,
          style.colour);
    put(out, "<text class=\"legend\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", left + legend_swatch, y, escaped(s.name));
    y += legend_row;
  }
  for (std::size_t i = 0; i < panel.bands.size(); ++i) {
    if (panel.bands[i].name.empty()) continue;
    put(out, "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"10\" fill=\"{}\" fill-opacity=\"0.2\"/>\n",
        left, y - 9, legend_swatch - 6, colours[i % colours.size()]);
    put(out, "<text class=\"legend\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", left + legend_swatch, y,
        escaped(panel.bands[i].name));
    y += legend_row;
  }
}

/// Width that the widest legend of the figure needs, 0 without legends.
double legend_width(const Figure& figure) {
  std::size_t longest = 0;
  for (const Panel& panel : figure.panels) {
    for (const Series& s : panel.series) longest = std::max(longest, characters(s.name));
    for (const Band& b : panel.bands) longest = std::max(longest, characters(b.name));
  }
  const bool scale =
      std::any_of(figure.panels.begin(), figure.panels.end(), [](const Panel& p) { return p.field.has_value(); });
  return (scale ? scale_width : 0) +
         (longest == 0 ? 0 : 14 + legend_swatch + character_width * static_cast<double>(longest));
}

double legend_height(const Panel& panel) {
  const auto named = [](const auto& entry) { return !entry.name.empty(); };
  return legend_row * static_cast<double>(std::count_if(panel.series.begin(), panel.series.end(), named) +
                                          std::count_if(panel.bands.begin(), panel.bands.end(), named));
}

/// A panel is as high as asked, and higher where its legend needs it.
double panel_height(const Figure& figure, const Panel& panel) {
  return std::max(static_cast<double>(figure.panel_height), legend_height(panel) + panel_bottom);
}

void draw_panel(Buffer& out, const Panel& panel, const Frame& f, std::size_t number) {
  draw_axes(out, panel, f);
  put(out, "<clipPath id=\"panel{}\"><rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/></clipPath>\n",
      number, f.left, f.top, f.width, f.height);
  put(out, "<g clip-path=\"url(#panel{})\">\n", number);
  if (panel.field) draw_field(out, *panel.field, f);
  for (std::size_t i = 0; i < panel.bands.size(); ++i) draw_band(out, panel.bands[i], f, colours[i % colours.size()]);
  for (std::size_t i = 0; i < panel.series.size(); ++i)
    draw_series(out, panel.series[i], f, style_of(i, panel.series[i]));
  put(out, "</g>\n");
  const double right = f.left + f.width + 14;
  if (panel.field) draw_scale(out, *panel.field, f, right);
  draw_legend(out, panel, right + (panel.field ? scale_width : 0), f.top);
}

std::vector<double> linear_ticks(double low, double high, int wanted) {
  const double raw = (high - low) / wanted;
  const double power = std::pow(10, std::floor(std::log10(raw)));
  const double step = power * (raw / power < 1.5 ? 1 : raw / power < 3.5 ? 2 : raw / power < 7.5 ? 5 : 10);
  std::vector<double> out;
  constexpr double slack = 1e-9;  // of a step: an end that is a tick but for round-off counts
  for (double n = std::ceil(low / step - slack); n <= high / step + slack; ++n) out.push_back(n == 0 ? 0 : n * step);
  return out;
}

std::vector<double> logarithmic_ticks(double low, double high, int wanted) {
  constexpr double slack = 1e-9;
  const double first = std::floor(std::log10(low)), last = std::ceil(std::log10(high));
  const double decades = std::log10(high) - std::log10(low);
  const double stride = std::max(1.0, std::ceil(decades / wanted));
  const auto by = [&](const std::vector<double>& factors) {
    std::vector<double> out;
    for (double n = std::ceil(first / stride) * stride; n <= last; n += stride)
      for (const double factor : factors)
        if (const double value = factor * std::pow(10, n); value >= low * (1 - slack) && value <= high * (1 + slack))
          out.push_back(value);
    return out;
  };
  constexpr std::size_t few = 3;
  std::vector<double> out = by({1});
  if (out.size() < few) out = by({1, 2, 5});
  // Within a fraction of a decade, round steps tell more than powers of ten.
  return out.size() >= few ? out : linear_ticks(low, high, wanted);
}

}  // namespace

std::vector<double> ticks(double low, double high, Scale scale, int wanted) {
  if (!(high > low)) return {low};
  return scale == Scale::linear ? linear_ticks(low, high, wanted) : logarithmic_ticks(low, high, wanted);
}

std::string tick_label(double value) {
  const double size = std::abs(value);
  std::string text;
  if (size != 0 && (size >= 1e5 || size < 1e-3)) {
    // "{:.6e}" has the digits; trailing zeros and the exponent's padding go.
    const std::string raw = fmt::format("{:.6e}", value);
    std::string mantissa = raw.substr(0, raw.find('e'));
    mantissa.erase(mantissa.find_last_not_of('0') + 1);
    if (mantissa.back() == '.') mantissa.pop_back();
    text = fmt::format("{}e{}", mantissa, std::stoi(raw.substr(raw.find('e') + 1)));
  } else {
    text = fmt::format("{:.8g}", value);
  }
  for (std::size_t at = text.find('-'); at != std::string::npos; at = text.find('-', at)) text.replace(at, 1, "\u2212");
  return text;
}

std::string with_superscripts(const std::string& unit) {
  static constexpr std::array<const char*, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out;
  bool raised = false;
  for (const char c : unit) {
    const bool digit = c >= '0' && c <= '9';
    if (c == '^') {
      raised = true;
    } else if (raised && (digit || c == '-')) {
      out += digit ? digits[static_cast<std::size_t>(c - '0')] : "⁻";
    } else {
      raised = false;
      out += c;
    }
  }
  return out;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&apos;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string axis_text(const Axis& axis) {
  return escaped(axis.unit.empty() ? axis.label : fmt::format("{} [{}]", axis.label, with_superscripts(axis.unit)));
}

std::string svg(const Figure& figure) {
  const double legend = legend_width(figure);
  const double width = figure.width - left_margin - right_margin - legend;
  double height = title_height;
  for (const Panel& panel : figure.panels) height += panel_height(figure, panel) + panel_gap;
  Buffer out;
  begin_page(out, figure.width, height, left_margin + width / 2, figure.title);
  double top = title_height;
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const double whole = panel_height(figure, figure.panels[i]);
    draw_panel(out, figure.panels[i], frame_of(figure.panels[i], top, width, whole - panel_bottom), i);
    top += whole + panel_gap;
  }
  put(out, "</svg>\n");
  return fmt::to_string(out);
}

}  // namespace froude::plot
