#include "apps/scene/scenes.hpp"

namespace froude::scene::damaged_text_test {
namespace {

/// Reads and expects either a scene or an InputError that shows its line; anything else fails the test by escaping.
int refused(const std::string& text) {
  try {
    parse(text, "scene.toml");
    return 0;
  } catch (const hydro::InputError& error) {
    EXPECT_GT(error.where().line, 0) << error.what();
    EXPECT_GT(error.where().column, 0) << error.what();
    EXPECT_EQ(error.where().file, "scene.toml");
    return 1;
  }
}

TEST(DamagedScene, WithOneCharacterMissingIsReadOrRefusedWithItsPlace) {
  int count = 0;
  for (const std::string* scene : {&pontoons, &sphere})
    for (std::size_t i = 0; i < scene->size(); ++i) count += refused(scene->substr(0, i) + scene->substr(i + 1));
  EXPECT_GT(count, 500);  // of some 2000: most characters matter
}

TEST(DamagedScene, WithOneCharacterReplacedIsReadOrRefusedWithItsPlace) {
  for (const char c : std::string("]}\"=*-\n\xff\0", 9))
    for (std::size_t i = 0; i < sphere.size(); ++i) refused(sphere.substr(0, i) + c + sphere.substr(i + 1));
}

TEST(DamagedScene, CutShortIsReadOrRefusedWithItsPlace) {
  for (std::size_t i = 0; i < pontoons.size(); ++i) refused(pontoons.substr(0, i));
}

}  // namespace
}  // namespace froude::scene::damaged_text_test
