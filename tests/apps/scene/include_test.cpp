// include = "fit.toml": a scene takes numbers that a fit has written.
#include <filesystem>
#include <fstream>

#include "apps/scene/scenes.hpp"
#include "hydro/base/error.hpp"
#include "support/scratch.hpp"

namespace froude::scene::include_test {
namespace {

namespace fs = std::filesystem;

class Includes : public testing::Test {
 protected:
  Includes() {
    fs::create_directories(folder_);
    std::ofstream(folder_ / "fit.toml") << "kind = \"morison\"\n[coefficients]\ncd = 1.19\nca = 1\nspan = \"120 cm\"\n";
    std::ofstream(folder_ / "empty.toml") << "kind = \"morison\"\n";
  }
  ~Includes() override { fs::remove_all(folder_); }
  Includes(const Includes&) = delete;
  Includes& operator=(const Includes&) = delete;

  Scene read(const std::string& text) const { return parse(text, folder_ / "scene.toml"); }
  std::string refused(const std::string& text) const {
    try {
      read(text);
    } catch (const hydro::InputError& error) {
      return error.what();
    }
    ADD_FAILURE() << "was accepted:\n" << text;
    return {};
  }

  fs::path folder_ = support::scratch_folder() /
                     (std::string("includes_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

std::string with_include(const std::string& file, const std::string& cd) {
  return with(with(pontoons, "schema = 1\n", "schema = 1\ninclude = \"" + file + "\"\n"), "cd = 1.0",
              "cd = \"" + cd + "\"");
}

TEST_F(Includes, PutTheFittedNumberWhereItsNameStands) {
  const Scene scene = read(with_include("fit.toml", "fit.cd"));
  ASSERT_FALSE(scene.members.empty());
  EXPECT_EQ(scene.members[0].cd, 1.19);
  EXPECT_THAT(scene.echo, testing::Contains(testing::Field(&Echo::value, "1.19")));
}

TEST_F(Includes, PutAQuantityThereWithItsUnit) {
  const Scene scene = read(with(with_include("fit.toml", "fit.cd"), "diameter = \"1.6 m\"", "diameter = \"fit.span\""));
  EXPECT_DOUBLE_EQ(scene.members[0].diameter, 1.2);
}

TEST_F(Includes, NameWhatIsMissing) {
  EXPECT_THAT(refused(with_include("fit.toml", "fit.cb")), testing::HasSubstr("did you mean \"fit.c"));
  EXPECT_THAT(refused(with_include("fist.toml", "fit.cd")), testing::HasSubstr("is no file"));
  EXPECT_THAT(refused(with_include("empty.toml", "fit.cd")), testing::HasSubstr("no table [coefficients]"));
  EXPECT_THAT(refused(with(pontoons, "cd = 1.0", "cd = \"fit.cd\"")), testing::HasSubstr("a number is needed"));
}

}  // namespace
}  // namespace froude::scene::include_test
