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
