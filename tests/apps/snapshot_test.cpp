// `froude snapshot` through the function that main.cpp calls.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "froude/commands.hpp"
#include "froude/result.hpp"
#include "hydro/io/csv.hpp"
#include "support/refused.hpp"
#include "support/scratch.hpp"

namespace snapshot_command_test {
namespace {

using froude::SnapshotArguments;
using support::refused;
using testing::HasSubstr;

/// A result of three nodes of a line, the first of them held by the ground, and of a body with a member: what it keeps
/// is made up, so that each place is known.
class SnapshotCommand : public testing::Test {
 protected:
  SnapshotCommand() {
    folder = support::scratch_folder() / "froude_snapshot";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    provenance.settings = {
        {"line[1].name", "other"},          {"line[2].name", "d"},   {"line[2].from", "(1, 2, 3) m"},
        {"line[2].segments", "2"},          {"body[1].name", "b"},   {"body[1].position", "(0, 0, -1) m (default)"},
        {"body[1].free", "[surge, pitch]"}, {"member[1].on", "[b]"}, {"member[1].from", "(0, 0, 0) m"},
        {"member[1].to", "(0, 0, -2) m"}};
    for (int node = 1; node <= 2; ++node)
      for (int axis = 0; axis < 3; ++axis)
        signals.push_back({"d.node" + std::to_string(node) + "." + "xyz"[axis],
                           "m",
                           "place",
                           {10.0 * node + axis, 10.0 * node + axis + 0.5, 10.0 * node + axis + 1}});
    signals.push_back({"b.surge", "m", "surge", {0, 4, 0}});
    signals.push_back({"b.pitch", "rad", "pitch", {0, std::acos(-1) / 2, 0}});
    arguments = {.file = folder / "run.h5", .lines = {"d"}, .at = {"2 s"}};
  }
  ~SnapshotCommand() override { std::filesystem::remove_all(folder); }
  nlohmann::json json() {
    froude::write_run(arguments.file, {0, 2, 4}, signals, provenance);
    std::ostringstream out, err;
    froude::snapshot(arguments, {out, err, true});
    return nlohmann::json::parse(out.str());
  }
  std::filesystem::path folder;
  froude::Provenance provenance;
  std::vector<froude::Signal> signals;
  SnapshotArguments arguments;
};

TEST_F(SnapshotCommand, ShowsAllNodesWithThoseThatTheGroundHolds) {
  arguments.at = {"2 s", "3.4 s"};
  arguments.planes = {"xz", "xy"};
  arguments.output = folder / "line.csv";
  arguments.picture = folder / "line.svg";
  const auto j = json();
  ASSERT_EQ(j["instants"].size(), 2);
  EXPECT_EQ(j["instants"][1]["time_s"], 4) << "the nearest sample";
  EXPECT_EQ(j["instants"][0]["shown"][0]["places_m"],
            nlohmann::json::parse("[[1, 2, 3], [10.5, 11.5, 12.5], [20.5, 21.5, 22.5]]"));
  const auto table = hydro::io::CsvTable::read(folder / "line.csv");
  EXPECT_EQ(table.rows(), 6);
  EXPECT_EQ(table.column("z").at(5), 23);
  EXPECT_TRUE(std::filesystem::exists(folder / "line.svg"));
}

// Rz Ry Rx: pitched by a quarter turn, what hangs below points to −x.
TEST_F(SnapshotCommand, ShowsMembersWhereTheirBodyIs) {
  arguments.lines = {};
  arguments.bodies = {"b"};
  const auto places = json()["instants"][0]["shown"][0]["places_m"];
  EXPECT_NEAR(places[0][0], 4, 1e-12);
  EXPECT_NEAR(places[0][2], -1, 1e-12);
  EXPECT_NEAR(places[1][0], 4 - 2, 1e-12);
  EXPECT_NEAR(places[1][2], -1, 1e-12);
}

TEST_F(SnapshotCommand, ShowsCopiesInARowAndInAGridByPatterns) {
  arguments.lines = {};
  arguments.bodies = {"b*"};
  provenance.settings.insert(provenance.settings.end(),
                             {{"body[1].copies.count", "2"}, {"body[1].copies.step", "(13, 0, 0) m"}});
  provenance.settings[7].second = "[b*]";  // member[1].on
  const std::vector<froude::Signal> of_one(signals.end() - 2, signals.end());
  const auto keep = [&](const std::string& name, double surge) {
    for (froude::Signal s : of_one) {
      s.name.replace(0, 1, name);
      s.values = s.units == "m" ? std::vector<double>{0, surge, 0} : std::vector<double>{0, 0, 0};
      signals.push_back(s);
    }
  };
  keep("b1", 1), keep("b2", -2);
  const auto shown = json()["instants"][0]["shown"];
  ASSERT_EQ(shown.size(), 2);
  EXPECT_EQ(shown[1]["name"], "b2");
  EXPECT_EQ(shown[0]["places_m"], nlohmann::json::parse("[[1.0, 0.0, -1.0], [1.0, 0.0, -3.0]]"));
  EXPECT_EQ(shown[1]["places_m"], nlohmann::json::parse("[[11.0, 0.0, -1.0], [11.0, 0.0, -3.0]]"));
  provenance.settings.insert(provenance.settings.end(),
                             {{"body[1].copies.rows", "2"}, {"body[1].copies.row_step", "(0, 7, 0) m"}});
  keep("b1_1", 0), keep("b1_2", 0), keep("b2_1", 0), keep("b2_2", 5);
  EXPECT_EQ(json()["instants"][0]["shown"][3]["places_m"],
            nlohmann::json::parse("[[18.0, 7.0, -1.0], [18.0, 7.0, -3.0]]"));
  arguments.bodies = {"c"};
  EXPECT_THAT(refused([&] { json(); }), HasSubstr("bodies are: b1_1, b1_2, b2_1, b2_2"));
}

TEST_F(SnapshotCommand, SaysWhatTheResultDoesNotKeep) {
  arguments.at = {"5 s"};
  EXPECT_THAT(refused([&] { json(); }), HasSubstr("give a time from 0 to 4 s"));
  arguments.at = {"2 s"};
  arguments.lines = {"e"};
  EXPECT_THAT(refused([&] { json(); }), HasSubstr("has no line \"e\""));
  arguments.lines = {"d"};
  signals.erase(signals.begin() + 4);
  EXPECT_THAT(refused([&] { json(); }), HasSubstr("keeps no place of node 2 of \"d\""));
  EXPECT_THAT(refused([&] { json(); }), HasSubstr("of = [\"d.node*\"]"));
  arguments.lines = {};
  EXPECT_THAT(refused([&] { json(); }), HasSubstr("give --line, or --body"));
  arguments.lines = {"d"};
  arguments.file = folder / "run.csv";
  EXPECT_THAT(refused([&] { json(); }), HasSubstr("give the .h5 of `froude run`"));
  arguments.file = folder / "run.h5";
  arguments.lines = {};
  arguments.bodies = {"b"};
  signals.pop_back();
  EXPECT_THAT(refused([&] { json(); }), HasSubstr("keeps no pitch of \"b\""));
}

}  // namespace
}  // namespace snapshot_command_test
