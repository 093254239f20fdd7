#include "hydro/base/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace error_test {
namespace {

TEST(InputError, ShowsPlaceTextAndRemedyUnderTheOffendingCharacters) {
  const hydro::InputError e("every = \"0.02 m\" is a length; a time is needed",
                            {.file = "scene.toml", .line = 29, .column = 9, .text = "every = \"0.02 m\"", .width = 8},
                            "write \"0.02 s\"");
  EXPECT_STREQ(e.what(),
               "scene.toml:29:9: error: every = \"0.02 m\" is a length; a time is needed\n"
               "    29 | every = \"0.02 m\"\n"
               "       |         ^^^^^^^^ write \"0.02 s\"");
}

TEST(InputError, KeepsThePlaceThatWasFoundFirst) {
  const hydro::InputError inner("wrong", {.file = "a.csv", .line = 3});
  EXPECT_EQ(inner.at({.file = "scene.toml", .line = 1}).where().file, "a.csv");
  EXPECT_EQ(hydro::InputError("wrong").at({.file = "scene.toml", .line = 1}).where().file, "scene.toml");
}

TEST(Nearest, FindsTheWordThatWasMeantAndNothingFarAway) {
  const std::vector<std::string> known{"stiffness", "damping", "rest_length"};
  EXPECT_EQ(hydro::nearest("stifness", known), "stiffness");
  EXPECT_EQ(hydro::nearest("dampnig", known), "damping");
  EXPECT_EQ(hydro::nearest("colour", known), "");
}

}  // namespace
}  // namespace error_test
