// Paths in space, drawn in perspective, and `froude trajectory`.
#include "answers/plot_space.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>
#include <sstream>

#include "froude/commands.hpp"
#include "hydro/io/csv.hpp"
#include "support/refused.hpp"
#include "support/scratch.hpp"

namespace plot_space_test {
namespace {

using froude::TrajectoryArguments;
using froude::plot::Eye;
using froude::plot::seen;
using support::refused;
using testing::HasSubstr;
constexpr double pi = std::numbers::pi;

// An eye on +x looks along −x: +y is to its right, +z up, and what is nearer is larger.
TEST(Perspective, HasRightUpAndDepth) {
  const Eye ahead{0, 0};
  EXPECT_GT(seen({0, 0.5, 0}, ahead).x(), 0);
  EXPECT_NEAR(seen({0, 0.5, 0}, ahead).y(), 0, 1e-15);
  EXPECT_GT(seen({0, 0, 0.5}, ahead).y(), 0);
  EXPECT_GT(seen({0.5, 0.5, 0}, ahead).x(), seen({-0.5, 0.5, 0}, ahead).x());
  // Similar triangles: at eye_distance half diagonals, d/(d − depth) of the size.
  const double d = froude::plot::eye_distance * std::sqrt(0.75);
  EXPECT_NEAR(seen({0.5, 0.5, 0}, ahead).x(), 0.5 * d / (d - 0.5), 1e-14);
}

TEST(Perspective, GoesAroundAndAboveTheBox) {
  const Eye left{pi / 2, 0}, above{0, pi / 2 - 1e-9};
  EXPECT_LT(seen({0.5, 0, 0}, left).x(), 0) << "from +y, +x is to the left";
  EXPECT_NEAR(seen({0.5, 0, 0}, above).y(), -0.5, 1e-6) << "from above with +x behind, +x is down";
  EXPECT_NEAR(seen({0, 0, 0.5}, above).norm(), 0, 1e-6);
}

/// Coordinates of the only path of an SVG.
std::vector<std::pair<double, double>> path_of(const std::string& svg) {
  std::smatch found;
  const std::regex whole(R"re(<path class="curve"[^>]* d="([^"]*)")re"), one("[ML]([-0-9.]+) ([-0-9.]+)");
  if (!std::regex_search(svg, found, whole)) return {};
  const std::string d = found[1];
  std::vector<std::pair<double, double>> out;
  for (auto it = std::sregex_iterator(d.begin(), d.end(), one); it != std::sregex_iterator(); ++it)
    out.emplace_back(std::stod((*it)[1]), std::stod((*it)[2]));
  return out;
}

// With one unit along all axes a metre is as long along each: a square in the plane that faces the eye stays one.
TEST(SpaceFigure, HasEqualScalesForOneUnitAndNamesAxes) {
  const froude::plot::Space space{.title = "a square <of> 2 m",
                                  .x = {"x", "m"},
                                  .y = {"y", "m"},
                                  .z = {"z", "m"},
                                  .paths = {{"edge", {0, 0, 0, 0}, {-1, 1, 1, -1}, {-1, -1, 1, 1}}},
                                  .eye = {0, 0}};
  const std::string drawn = froude::plot::svg(space);
  const auto p = path_of(drawn);
  ASSERT_EQ(p.size(), 4u);
  EXPECT_NEAR(p[1].first - p[0].first, p[1].second - p[2].second, 0.2);  // tenths of a pixel
  EXPECT_GT(p[1].first - p[0].first, 200);
  for (const char* text : {"x [m]", "y [m]", "z [m]", "edge", "a square &lt;of&gt; 2 m"})
    EXPECT_THAT(drawn, HasSubstr(text));
}

TEST(SpaceFigure, BreaksPathsAtWhatIsNoNumber) {
  const double none = std::nan("");
  const froude::plot::Space space{.title = "",
                                  .x = {"x"},
                                  .y = {"y"},
                                  .z = {"z"},
                                  .paths = {{"", {0, 1, none, 3, 4}, {0, 1, 2, 3, 1}, {0, 1, 2, 3, 0}}}};
  const std::string drawn = froude::plot::svg(space);
  EXPECT_EQ(path_of(drawn).size(), 4u);
  const std::size_t d = drawn.find(" d=\"");
  EXPECT_EQ(std::count(drawn.begin() + static_cast<std::ptrdiff_t>(d),
                       drawn.begin() + static_cast<std::ptrdiff_t>(drawn.find("\"/>", d)), 'M'),
            2);
}

/// A helix, as a record.
class TrajectoryCommand : public testing::Test {
 protected:
  TrajectoryCommand() {
    folder = support::scratch_folder() / "froude_trajectory";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    std::vector<double> time, x, y, z, pitch;
    for (int i = 0; i < 200; ++i) {
      time.push_back(0.1 * i);
      x.push_back(2 * std::cos(0.5 * i)), y.push_back(2 * std::sin(0.5 * i)), z.push_back(-0.01 * i);
      pitch.push_back(0.1 * std::sin(0.2 * i));
    }
    hydro::io::write_csv(
        folder / "r.csv",
        {{"time", "s", &time}, {"p.x", "m", &x}, {"p.y", "m", &y}, {"p.z", "m", &z}, {"pitch", "rad", &pitch}});
    arguments = {.file = folder / "r.csv", .points = {"p"}, .picture = folder / "r.svg"};
  }
  nlohmann::json json() {
    std::ostringstream out, err;
    froude::trajectory(arguments, {out, err, true});
    return nlohmann::json::parse(out.str());
  }
  std::filesystem::path folder;
  TrajectoryArguments arguments;
};

TEST_F(TrajectoryCommand, DrawsAPointAndTellsWhereItGoes) {
  arguments.from = "5 s";
  const auto j = json();
  EXPECT_EQ(j["samples"], 150);
  EXPECT_EQ(j["paths"][0]["name"], "p");
  EXPECT_NEAR(j["paths"][0]["axes"][2]["lowest"], -1.99, 1e-12);
  EXPECT_NEAR(j["paths"][0]["axes"][2]["highest"], -0.5, 1e-12);
  std::stringstream text;
  text << std::ifstream(folder / "r.svg").rdbuf();
  EXPECT_GE(path_of(text.str()).size(), 140u);
}

TEST_F(TrajectoryCommand, DrawsThreeSignalsOfTheirOwnUnits) {
  arguments.points = {};
  arguments.x = "p.x", arguments.y = "p.z", arguments.z = "pitch";
  EXPECT_EQ(json()["paths"][0]["axes"][2]["unit"], "rad");
  std::stringstream text;
  text << std::ifstream(folder / "r.svg").rdbuf();
  EXPECT_THAT(text.str(), HasSubstr("pitch [rad]"));
}

TEST_F(TrajectoryCommand, SaysWhatIsMissing) {
  arguments.points = {"q"};
  EXPECT_THAT(refused([&] { json(); }), HasSubstr("no signal is called \"q.x\""));
  arguments.points = {};
  EXPECT_THAT(refused([&] { json(); }), HasSubstr("give --point, or --x, --y and --z"));
  arguments.x = "p.x";
  EXPECT_THAT(refused([&] { json(); }), HasSubstr("one along each axis"));
  arguments = {.file = folder / "r.csv", .points = {"p"}, .elevation = "90 deg", .picture = folder / "r.svg"};
  EXPECT_THAT(refused([&] { json(); }), HasSubstr("straight above"));
}

}  // namespace
}  // namespace plot_space_test
