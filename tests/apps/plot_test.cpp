#include "answers/plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <regex>
#include <stack>

#include "hydro/base/error.hpp"

namespace plot_test {
namespace {

using froude::plot::escaped;
using froude::plot::Figure;
using froude::plot::Panel;
using froude::plot::Scale;
using froude::plot::svg;
using froude::plot::tick_label;
using froude::plot::ticks;
using testing::DoubleNear;
using testing::HasSubstr;
using testing::Not;
using testing::Pointwise;

Figure sine_figure(std::size_t points) {
  Panel panel{.x = {"time", "s"}, .y = {"heave", "m"}, .series = {{.name = "m1", .x = {}, .y = {}}}};
  for (std::size_t i = 0; i < points; ++i) {
    panel.series[0].x.push_back(0.01 * static_cast<double>(i));
    panel.series[0].y.push_back(std::sin(0.01 * static_cast<double>(i)));
  }
  return {.title = "a sine", .panels = {panel}};
}

/// Every element opened is closed in order; attribute values hold no bare angle bracket.
bool well_nested(const std::string& xml) {
  std::stack<std::string> open;
  const std::regex tag("<(/?)([A-Za-z]+)[^<>]*?(/?)>");
  for (auto it = std::sregex_iterator(xml.begin(), xml.end(), tag); it != std::sregex_iterator(); ++it) {
    const std::smatch& m = *it;
    if (m[1].length() > 0) {
      if (open.empty() || open.top() != m[2]) return false;
      open.pop();
    } else if (m[3].length() == 0) {
      open.push(m[2]);
    }
  }
  return open.empty();
}

TEST(PlotTicks, AreRoundNumbersInsideTheRange) {
  // 1e-12: steps are products of an integer and a decimal step, rounded once.
  EXPECT_THAT(ticks(0, 1, Scale::linear, 5),
              Pointwise(DoubleNear(1e-12), std::vector<double>{0, 0.2, 0.4, 0.6, 0.8, 1}));
  EXPECT_THAT(ticks(-3.3, 7.1, Scale::linear, 5), Pointwise(DoubleNear(1e-12), std::vector<double>{-2, 0, 2, 4, 6}));
  EXPECT_THAT(ticks(1234, 1239, Scale::linear, 5),
              Pointwise(DoubleNear(1e-9), std::vector<double>{1234, 1235, 1236, 1237, 1238, 1239}));
}

TEST(PlotTicks, OnALogarithmicAxisArePowersOfTenAndThinOutOverManyDecades) {
  EXPECT_THAT(ticks(1, 1000, Scale::logarithmic), Pointwise(DoubleNear(1e-9), std::vector<double>{1, 10, 100, 1000}));
  EXPECT_THAT(ticks(1, 20, Scale::logarithmic), Pointwise(DoubleNear(1e-9), std::vector<double>{1, 2, 5, 10, 20}));
  EXPECT_THAT(ticks(0.006, 0.8, Scale::logarithmic),
              Pointwise(DoubleNear(1e-9), std::vector<double>{0.01, 0.02, 0.05, 0.1, 0.2, 0.5}))
      << "two decades with two powers of ten between";
  EXPECT_LE(ticks(1e-20, 1e20, Scale::logarithmic, 6).size(), 7u);
}

TEST(PlotTicks, LabelsAreShortAndExact) {
  EXPECT_EQ(tick_label(3 * 0.1), "0.3");
  EXPECT_EQ(tick_label(0), "0");
  EXPECT_EQ(tick_label(250000), "2.5e5");
  EXPECT_EQ(tick_label(1e-5), "1e\u22125");
  EXPECT_EQ(tick_label(-2), "\u22122");
}

TEST(PlotSvg, IsWellFormedAndNamesAxesWithUnits) {
  const std::string text = svg(sine_figure(50));
  EXPECT_TRUE(well_nested(text));
  EXPECT_THAT(text, HasSubstr("time [s]"));
  EXPECT_THAT(text, HasSubstr("heave [m]"));
  EXPECT_THAT(text, HasSubstr(">m1</text>"));
}

TEST(PlotSvg, PrintsPowersOfUnitsAsSuperscripts) {
  EXPECT_EQ(froude::plot::with_superscripts("kg m^2/s^-12 x2"), "kg m²/s⁻¹² x2");
  Figure figure = sine_figure(5);
  figure.panels[0].y.unit = "m^2/Hz";
  EXPECT_THAT(svg(figure), HasSubstr("heave [m²/Hz]"));
}

TEST(PlotSvg, EscapesWhatXmlReserves) {
  EXPECT_EQ(escaped("a<b & \"c\">'"), "a&lt;b &amp; &quot;c&quot;&gt;&apos;");
  Figure figure = sine_figure(5);
  figure.title = "H < 2 & T > 3";
  figure.panels[0].series[0].name = "<m1>";
  figure.panels[0].y.label = "A & B";
  EXPECT_TRUE(well_nested(svg(figure)));
  EXPECT_THAT(svg(figure), Not(HasSubstr("<m1>")));
}

TEST(PlotSvg, BreaksALineAtAMissingValue) {
  Figure figure = sine_figure(5);
  figure.panels[0].series[0].y[2] = std::numeric_limits<double>::quiet_NaN();
  const std::string text = svg(figure);
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  const std::string curve = text.substr(text.find("class=\"curve\""), 300);
  EXPECT_EQ(std::count(curve.begin(), curve.end(), 'M'), 2) << curve;
}

TEST(PlotSvg, ShowsAMetreAsLongUpAsAlongWhereItIsAsked) {
  Panel square{.x = {.label = "x", .unit = "m"},
               .y = {.label = "z", .unit = "m"},
               .series = {{.name = "", .x = {0, 2}, .y = {5, 7}}},
               .equal_scales = true};
  const std::string drawn = svg({.title = "", .panels = {square}, .width = 900, .panel_height = 300});
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  const std::size_t path = drawn.find(" d=\"M", drawn.find("class=\"curve\""));
  ASSERT_EQ(std::sscanf(drawn.c_str() + path, " d=\"M%lf %lfL%lf %lf", &x0, &y0, &x1, &y1), 4);
  EXPECT_NEAR(x1 - x0, y0 - y1, 0.2);  // px: two of the tenths that are written
  EXPECT_GT(x1 - x0, 150) << "as large as the lower side allows";
}

TEST(PlotSvg, LeavesOutValuesThatALogarithmicAxisCannotShow) {
  Figure figure = sine_figure(5);
  figure.panels[0].y.scale = Scale::logarithmic;
  figure.panels[0].series[0].y = {0, -1, 1, 10, 100};
  EXPECT_THAT(svg(figure), Not(HasSubstr("nan")));
  EXPECT_THAT(svg(figure), Not(HasSubstr("inf")));
}

TEST(PlotSvg, ThinsALongRecordButKeepsItsExtremes) {
  Figure figure = sine_figure(200000);
  figure.panels[0].series[0].y[77777] = 5;  // a single spike
  figure.panels[0].y.range = {{-1, 5}};
  const std::string text = svg(figure);
  EXPECT_LT(text.size(), 100000u);  // four points of about 12 characters in each of 800 columns, and the axes
  // The spike reaches the top edge of the panel, which is at y = 44 px.
  EXPECT_THAT(text.substr(text.find("class=\"curve\"")), HasSubstr(" 44.0L"));
}

TEST(PlotSvg, ShowsAConstantOrNothingWithoutFailing) {
  Figure figure = sine_figure(3);
  figure.panels[0].series[0].y = {2, 2, 2};
  EXPECT_THAT(svg(figure), Not(HasSubstr("nan")));
  figure.panels[0].series.clear();
  EXPECT_TRUE(well_nested(svg(figure)));
}

TEST(PlotSvg, DrawsABandBetweenItsEdges) {
  Figure figure = sine_figure(2);
  figure.panels[0].bands = {{.name = "95 %", .x = {0, 0.01}, .low = {-1, -1}, .high = {1, 1}}};
  figure.panels[0].y.range = {{-1, 1}};
  // Up the upper edge (44 px), back along the lower one: 44 + 300 − 62 = 282 px.
  EXPECT_THAT(svg(figure),
              testing::ContainsRegex(
                  "fill-opacity=\"0.2\" stroke=\"none\" d=\"M84.0 44.0L[0-9.]+ 44.0L[0-9.]+ 282.0L84.0 282.0Z\""));
}

#ifdef FROUDE_AUDIT
TEST(PlotSvg, RefusesASeriesOfUnequalLengths) {
  Figure figure = sine_figure(3);
  figure.panels[0].series[0].y.pop_back();
  EXPECT_THROW(svg(figure), std::logic_error);
}
#endif

}  // namespace
}  // namespace plot_test
