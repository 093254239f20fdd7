// `froude bem info`, `check` and `convert` through the functions that main.cpp calls.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "froude/commands.hpp"
#include "hydro/base/error.hpp"
#include "hydro/potential/formats/writers.hpp"
#include "support/source_dir.hpp"

namespace bem_test {
namespace {

using froude::BemArguments;
using froude::Console;
using froude::Path;
using hydro::InputError;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const Path examples = froude_test::source_dir() / "examples/data";

/// What a command wrote, and a folder for its files.
class Bem : public ::testing::Test {
 protected:
  Bem() {
    std::string name = (std::filesystem::temp_directory_path() / "froude-test-XXXXXX").string();
    folder = ::mkdtemp(name.data());
  }
  ~Bem() override { std::filesystem::remove_all(folder); }

  Console text{out, err};
  Console as_json{out, err, true};
  json document() const { return json::parse(out.str()); }

  std::ostringstream out, err;
  Path folder;
};

BemArguments file(const Path& path) { return {{path}, {}}; }

TEST_F(Bem, InfoTellsAPersonWhatTheFileHolds) {
  froude::bem_info(file(examples / "pontoon1.nc"), text);
  EXPECT_THAT(out.str(), AllOf(HasSubstr("Capytaine 3.0.0 netCDF"), HasSubstr("density 1000 kg/m^3"),
                               HasSubstr("depth 14 m"), HasSubstr("39 from 0.2 to 4 rad/s"), HasSubstr("0, 45, 90 deg"),
                               HasSubstr("A(0) absent, A(inf) present"), HasSubstr("78896.7")));
  EXPECT_EQ(err.str(), "");
}

TEST_F(Bem, InfoTellsAProgramTheSame) {
  BemArguments both{{examples / "pontoon1.nc", examples / "box2.nc"}, {}};
  froude::bem_info(both, as_json);
  const json files = document().at("files");
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].at("depth_m"), 14.0);
  EXPECT_EQ(files[1].at("depth_m"), "infinite");
  EXPECT_EQ(files[1].at("bodies").size(), 2u);
  EXPECT_EQ(files[1].at("bodies")[1].at("reference_point_m")[0], 1.25);
  EXPECT_EQ(files[0].at("has_A_zero"), false);
  EXPECT_EQ(files[0].at("omega_rad_per_s").size(), 39u);
  EXPECT_NEAR(files[0].at("bodies")[0].at("C33_N_per_m").get<double>(), 78896.7, 0.1);
}

TEST_F(Bem, CheckIsContentWithGoodData) {
  EXPECT_EQ(froude::bem_check(file(examples / "hemisphere_r5.nc"), text), 0);
  EXPECT_THAT(out.str(), AllOf(HasSubstr("symmetry of A"), HasSubstr("0 errors, 0 warnings, 21 notes")));
}

TEST_F(Bem, CheckEndsWithStatusOneOnAnErrorAndNamesIt) {
  auto c = hydro::potential::read(examples / "pontoon1.nc");
  for (auto& B : c.B) B *= -1;
  hydro::potential::write_froude(c, folder / "wrong.h5");
  EXPECT_EQ(froude::bem_check(file(folder / "wrong.h5"), as_json), 1);
  const json told = document();
  EXPECT_EQ(told.at("status"), 1);
  bool named = false;
  for (const json& f : told.at("files")[0].at("findings"))
    if (f.at("check") == "sign of B") {
      named = true;
      EXPECT_EQ(f.at("severity"), "error");
      EXPECT_NE(f.at("remedy"), "");
    }
  EXPECT_TRUE(named);
}

TEST_F(Bem, ConvertWritesEachFormatByTheNameOfItsFile) {
  const Path nc = examples / "pontoon1.nc";
  froude::bem_convert({.bem = file(nc), .output = folder / "p.h5"}, text);
  froude::bem_convert({.bem = file(nc), .output = folder / "p.bemio.h5"}, text);
  froude::bem_convert({.bem = file(nc), .output = folder / "p.1"}, text);
  froude::bem_convert({.bem = file(nc), .output = folder / "anything", .format = "bemio"}, text);
  const auto original = hydro::potential::read(nc);
  const auto ours = hydro::potential::read(folder / "p.h5");
  EXPECT_EQ(ours.A[7], original.A[7]);
  EXPECT_EQ(ours.source, original.source);
  EXPECT_THAT(hydro::potential::read(folder / "p.bemio.h5").source, HasSubstr("BEMIO"));
  EXPECT_THAT(hydro::potential::read(folder / "anything").source, HasSubstr("BEMIO"));
  const auto wamit = hydro::potential::read(folder / "p.1", {1000, 9.81, hydro::WaterDepth::from_metres(14), 1, 1});
  EXPECT_LT((wamit.A[7] - original.A[7]).norm(), 1e-14 * original.A[7].norm());
  EXPECT_THAT(out.str(), HasSubstr("p.1, " + (folder / "p.3").string()));
}

TEST_F(Bem, ConvertTellsWhatTheFormatCannotHold) {
  froude::bem_convert({.bem = file(examples / "pontoon1.nc"), .output = folder / "p.1"}, text);
  EXPECT_THAT(out.str(), AllOf(HasSubstr("left out or changed: density 1000 kg/m³"), HasSubstr("centre of gravity")));
  out.str("");
  froude::bem_convert({.bem = file(examples / "pontoon1.nc"), .output = folder / "p.h5"}, as_json);
  EXPECT_EQ(document().at("left_out").size(), 0u);
  EXPECT_THAT(document().at("files").get<std::vector<std::string>>(), ElementsAre((folder / "p.h5").string()));
}

TEST_F(Bem, IrfTellsPolesAndCertificateAndWritesThem) {
  froude::BemIrfArguments arguments{file(examples / "hemisphere_r5.nc"), 1e-2, folder / "h.ss", folder / "h.svg"};
  froude::bem_irf(arguments, as_json);
  const json told = document();
  EXPECT_TRUE(told.at("passive").get<bool>());
  EXPECT_LE(told.at("error").get<double>(), 1e-2);
  EXPECT_EQ(told.at("modes").size(), 6u);
  EXPECT_EQ(told.at("modes")[2].at("mode"), "heave");
  for (const json& pole : told.at("poles")) EXPECT_GT(pole.at("decay_rad_per_s").get<double>(), 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "h.ss"));
  EXPECT_TRUE(std::filesystem::exists(folder / "h.svg"));
  arguments.output = folder / "h.txt";
  EXPECT_THAT([&] { froude::bem_irf(arguments, as_json); },
              ThrowsMessage<InputError>(HasSubstr("does not tell a format")));
}

TEST_F(Bem, RefusesWhatItCannotDo) {
  const Path nc = examples / "pontoon1.nc";
  EXPECT_THAT([&] { froude::bem_convert({.bem = file(nc), .output = folder / "p.xls"}, text); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("\"p.xls\" does not tell a format"), HasSubstr(".bemio.h5"))));
  EXPECT_THAT([&] { froude::bem_convert({.bem = file(nc), .output = folder / "p.h5", .format = "nemoh"}, text); },
              ThrowsMessage<InputError>(HasSubstr("no format \"nemoh\"")));
  EXPECT_THAT(
      [&] {
        froude::bem_convert({.bem = {{nc, nc}, {}}, .output = folder / "p.h5"}, text);
      },
      ThrowsMessage<InputError>(HasSubstr("one file can be converted at a time")));
  EXPECT_THAT([&] { froude::bem_info({}, text); }, ThrowsMessage<InputError>(HasSubstr("no file is given")));
  EXPECT_THAT([&] { froude::bem_info(file(examples / "pontoon1.1"), text); },
              ThrowsMessage<InputError>(HasSubstr("density, gravity, water depth")));
}

}  // namespace
}  // namespace bem_test
