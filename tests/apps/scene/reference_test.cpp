#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "answers/fit_models.hpp"
#include "answers/fit_scene.hpp"
#include "apps/scene/scenes.hpp"
#include "froude/commands.hpp"
#include "hydro/io/atomic_file.hpp"
#include "scene/read_value.hpp"
#include "scene/schema.hpp"
#include "support/scratch.hpp"
#include "support/source_dir.hpp"
#include "sweep/study.hpp"

namespace froude::scene::reference_test {
namespace {

namespace fs = std::filesystem;

/// Calls `look` with each key of a root and of all tables below it.
void each_key(const Table& table, const std::function<void(const Table&, const Key&)>& look) {
  const auto over = [&](const std::vector<Key>& keys) {
    for (const Key& key : keys) {
      look(table, key);
      if (key.inner != nullptr) each_key(*key.inner, look);
    }
  };
  over(table.keys);
  for (const auto& variant : table.variants) over(variant.keys);
}

void each_key(const std::function<void(const Table&, const Key&)>& look) {
  each_key(motion_schema(), look);
  each_key(fit_schema(), look);
}

/// A folder of the test's own, gone after it.
struct Folder {
  Folder() { fs::create_directories(path / "runs"); }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path path = support::scratch_folder() /
                  (std::string("starter_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST(KeyReference, MentionsEveryKeyWithItsMeaning) {
  std::string reference = key_reference();
  for (auto at = reference.find("\\*"); at != std::string::npos; at = reference.find("\\*")) reference.erase(at, 1);
  each_key([&](const Table& table, const Key& key) {
    EXPECT_THAT(reference, HasSubstr("| `" + key.name + "` | ")) << table.title;
    EXPECT_THAT(reference, HasSubstr(key.meaning)) << table.title << ' ' << key.name;
    if (table.title.starts_with('[')) {
      EXPECT_THAT(reference, HasSubstr("### `" + table.title + "`\n"));
    }
  });
}

// The spreading of a sea was told anew for each of twelve spectra.
TEST(KeyReference, TellsATableThatSeveralHoldOnce) {
  const std::string reference = key_reference();
  for (const char* title : {"### `[waves.spreading]`\n", "### `[waves.components]`\n", "### `[waves.crest]`\n"}) {
    const auto first = reference.find(title);
    ASSERT_NE(first, std::string::npos) << title;
    EXPECT_EQ(reference.find(title, first + 1), std::string::npos) << title;
  }
}

TEST(KeyReference, IsWhatTheGuideHolds) {
  EXPECT_EQ(hydro::io::read_text(froude_test::source_dir() / "docs/guide/scene-keys.md"),
            froude::sweep::key_reference())
      << "write it anew: froude new --keys > docs/guide/scene-keys.md";
}

/// The ```toml blocks of a page that are whole scenes.
std::vector<std::string> scenes_of(const std::string& page) {
  const std::string begin = "```toml\nschema = 1\n", end = "```\n";
  std::vector<std::string> out;
  for (auto at = page.find(begin); at != std::string::npos; at = page.find(begin, at + 1))
    out.push_back(page.substr(at + 8, page.find(end, at + 8) - at - 8));
  return out;
}

TEST(SceneGuide, HoldsScenesThatCanBeRead) {
  const Folder folder;
  std::ofstream(folder.path / "runs" / "a.csv") << "t,F,u\n";
  const auto scenes = scenes_of(hydro::io::read_text(froude_test::source_dir() / "docs/guide/scenes.md"));
  ASSERT_EQ(scenes.size(), 2u);
  EXPECT_EQ(parse(scenes[0], folder.path / "scene.toml").connectors.size(), 8u);
  EXPECT_EQ(parse_fit(scenes[1], folder.path / "fit.toml").files.size(), 1u);
}

TEST(Schema, ReadsEveryDefaultItDeclares) {
  each_key([](const Table& table, const Key& key) {
    EXPECT_FALSE(key.meaning.empty()) << table.title << ' ' << key.name;
    if (key.need != Need::defaulted) return;
    EXPECT_FALSE(key.because.empty()) << table.title << ' ' << key.name << " has a default without a reason";
    if (key.inner == nullptr) {
      EXPECT_NO_THROW(read_value(default_node(key, {}), key, table.title)) << table.title << ' ' << key.name;
    }
  });
}

TEST(Schema, GroupsNameKeysThatExist) {
  each_key([](const Table& table, const Key& key) {
    const auto known = [&](const std::string& name) {
      const auto in = [&](const std::vector<Key>& keys) {
        return std::any_of(keys.begin(), keys.end(), [&](const Key& k) { return k.name == name; });
      };
      return in(table.keys) ||
             std::any_of(table.variants.begin(), table.variants.end(), [&](const auto& v) { return in(v.keys); });
    };
    for (const auto& group : table.groups)
      for (const auto& name : group.keys) EXPECT_TRUE(known(name)) << table.title << ' ' << name;
    for (const std::string& other : key.beside) EXPECT_TRUE(known(other)) << table.title << ' ' << key.name;
  });
}

TEST(NewScene, WritesAStarterThatCanBeRead) {
  const Folder folder;
  std::ostringstream out, err;
  const Console console{.out = out, .err = err};
  new_scene("motion", folder.path / "scene.toml", false, console);
  const Scene scene = scene::read(folder.path / "scene.toml");
  EXPECT_EQ(scene.members.size(), 4u);
  EXPECT_TRUE(scene.rao && scene.run);
  new_scene("fit", folder.path / "fit.toml", false, console);
  std::ofstream(folder.path / "runs" / "a.csv") << "t,F,u\n";
  EXPECT_EQ(read_fit(folder.path / "fit.toml").model<MorisonModel>().coefficients.size(), 2u);
  EXPECT_THAT(out.str(), HasSubstr("wrote "));
}

TEST(NewScene, DoesNotOverwrite) {
  const Folder folder;
  std::ostringstream out, err;
  const Console console{.out = out, .err = err};
  std::ofstream(folder.path / "scene.toml") << "mine";
  EXPECT_THAT([&] { new_scene("motion", folder.path / "scene.toml", false, console); },
              testing::ThrowsMessage<hydro::InputError>(HasSubstr("is there already")));
  EXPECT_EQ(hydro::io::read_text(folder.path / "scene.toml"), "mine");
}

TEST(NewScene, PrintsTheReferenceAndKnowsItsKinds) {
  std::ostringstream out, err;
  const Console console{.out = out, .err = err};
  new_scene("", std::nullopt, true, console);
  EXPECT_EQ(out.str(), froude::sweep::key_reference());
  EXPECT_THAT([&] { new_scene("motoin", std::nullopt, false, console); },
              testing::ThrowsMessage<hydro::InputError>(HasSubstr("did you mean \"motion\"?")));
}

}  // namespace
}  // namespace froude::scene::reference_test
