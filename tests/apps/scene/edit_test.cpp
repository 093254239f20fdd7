// Values written into the text of a scene.
#include <gtest/gtest.h>

#include <string>

#include "hydro/base/error.hpp"
#include "scene/edit.hpp"

namespace froude_test::edit {
namespace {

using froude::scene::edited;

std::string after(const std::string& text, const std::string& path, const std::string& value) {
  return edited(text, "scene.toml", {{path, value}});
}

TEST(Edit, ReplacesAValueAndKeepsTheRest) {
  EXPECT_EQ(after("[solve]\nstep = \"0.1 s\"   # why\n", "solve.step", "\"1 s\""), "[solve]\nstep = \"1 s\"   # why\n");
  EXPECT_EQ(after("a = { x = \"µ\", y = 2, z = 3 } # µ\n", "a.y", "20"), "a = { x = \"µ\", y = 20, z = 3 } # µ\n");
}

TEST(Edit, CountsTablesOfAListFromOne) {
  const std::string text = "[[body]]\nr = { m = 1 }\n[[body]]\nr = {}\n";
  EXPECT_EQ(after(text, "body[2].r.m", "2"), "[[body]]\nr = { m = 1 }\n[[body]]\nr = { m = 2 }\n");
  EXPECT_EQ(after(text, "body[1].r.n", "2"), "[[body]]\nr = { m = 1, n = 2 }\n[[body]]\nr = {}\n");
  EXPECT_THROW(after(text, "body[3].r.m", "2"), hydro::InputError);
}

TEST(Edit, PutsInWhatWasNotThere) {
  EXPECT_EQ(after("a = 1", "solve.step", "2"), "a = 1\n\n[solve]\nstep = 2\n");
  EXPECT_EQ(after("[solve]  # c\nb = 1\n", "solve.step", "2"), "[solve]  # c\nstep = 2\nb = 1\n");
  EXPECT_EQ(after("[solve]\r\nb = 1\r\n", "solve.step", "2"), "[solve]\r\nstep = 2\r\nb = 1\r\n");
  EXPECT_EQ(after("[solve.integrator]\nname = 1\n", "solve.step", "2"),
            "[solve.integrator]\nname = 1\n\n[solve]\nstep = 2\n");
  EXPECT_EQ(after("a = 1\n", "b", "2"), "b = 2\na = 1\n");
}

TEST(Edit, TakesOutAKey) {
  EXPECT_EQ(after("a = { x = 1, y = 2 }\n", "a.x", ""), "a = { y = 2 }\n");
  EXPECT_EQ(after("a = { x = 1, y = 2 }\n", "a.y", ""), "a = { x = 1 }\n");
  EXPECT_EQ(after("[a]\nx = 1  # gone\ny = 2\n", "a.x", ""), "[a]\ny = 2\n");
  EXPECT_EQ(after("[a]\ny = 2\n", "a.x", ""), "[a]\ny = 2\n");
}

TEST(Edit, RefusesFurtherKeysOfDottedTables) {
  EXPECT_THROW(after("[solve]\nintegrator.name = \"x\"\n", "solve.integrator.tolerance", "1"), hydro::InputError);
  EXPECT_EQ(after("[solve]\nintegrator.name = \"x\"\n", "solve.integrator.name", "\"y\""),
            "[solve]\nintegrator.name = \"y\"\n");
}

}  // namespace
}  // namespace froude_test::edit
