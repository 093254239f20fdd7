#include "answers/overlay.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fit_fixture.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"

namespace overlay_test {
namespace {

using namespace froude;
using testing::AllOf, testing::ElementsAre, testing::HasSubstr, testing::ThrowsMessage;

/// Two panels of a fit, the second with a range along it.
class Upon : public fit_test::FitFolder {
 protected:
  Overlay table(const std::string& text, const std::string& panel = "force over time") {
    hydro::io::write_atomically(folder / "points.csv", text);
    return {.file = {folder / "points.csv", {}}, .x = "t", .y = "F", .by = "of", .line = true, .panel = {panel, {}}};
  }
  std::vector<plot::Panel> panels{{.x = {"time", "s"}, .y = {"speed", "m/s"}, .series = {}},
                                  {.x = {.label = "time", .unit = "s", .range = {{0.0, 10.0}}},
                                   .y = {"force", "N"},
                                   .series = {{"measured", {0, 10}, {1, 2}}}}};
};

TEST_F(Upon, DrawsEachNameOfATableInTheUnitsOfThePanel) {
  draw_upon({table("t [min], F [kN], of\n0.1, 0.001, a\n0.2, 0.002, a\n0.3, 0.003, b\n")}, panels);
  EXPECT_TRUE(panels[0].series.empty());
  ASSERT_EQ(panels[1].series.size(), 3u);
  EXPECT_EQ(panels[1].series[1].name, "a");
  EXPECT_THAT(panels[1].series[1].x, ElementsAre(testing::DoubleEq(6), testing::DoubleEq(12)));
  EXPECT_THAT(panels[1].series[1].y, ElementsAre(testing::DoubleEq(1), testing::DoubleEq(2)));
  EXPECT_EQ(panels[1].series[2].name, "b");
  EXPECT_EQ(panels[1].x.range->first, 0);       // what lies within moves no end
  EXPECT_GT(panels[1].x.range->second, 18);     // what lies beyond does
  EXPECT_FALSE(panels[1].y.range.has_value());  // as it fitted the data it fits them now
}

TEST_F(Upon, RefusesAPanelAndAUnitThatAreNotThere) {
  EXPECT_THAT([&] { draw_upon({table("t [s], F [N], of\n1, 1, a\n", "cd over KC")}, panels); },
              ThrowsMessage<hydro::InputError>(
                  AllOf(HasSubstr("no panel \"cd over KC\""), HasSubstr("\"speed over time\", \"force over time\""))));
  EXPECT_THAT([&] { draw_upon({table("t [s], F [m], of\n1, 1, a\n")}, panels); },
              ThrowsMessage<hydro::InputError>(HasSubstr("F")));
  EXPECT_THAT([&] { check_overlay(table("t [s], G [N], of\n1, 1, a\n")); },
              ThrowsMessage<hydro::InputError>(HasSubstr("there is no column \"F\"")));
}

TEST_F(Upon, DrawsUponTheFitsThatTheExamplesName) {
  const auto drawn = [&](const char* scene) {
    told({.scene = fit_test::examples / scene, .picture = folder / "p.svg"});
    return hydro::io::read_text(folder / "p.svg");
  };
  EXPECT_THAT(drawn("beside.toml"), AllOf(HasSubstr("Hendriksen 2023 in waves"), HasSubstr("Landmann et al. 2021")));
  EXPECT_THAT(drawn("droppers.toml"), AllOf(HasSubstr("Re"), HasSubstr("Gagnon and Bergeron 2011 (live dropper)")));
}

}  // namespace
}  // namespace overlay_test
