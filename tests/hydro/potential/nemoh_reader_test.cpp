#include "nemoh_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "support/reference_data.hpp"

namespace nemoh_reader_test {
namespace {

using froude_test::largest_relative_error;
using froude_test::NemohText;
using froude_test::relative_difference;
using froude_test::SmoothBody;
using froude_test::TemporaryFolder;
using hydro::InputError;
using hydro::potential::Coefficients;
using hydro::potential::read;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// Files are written with 16 significant digits: 5e-16 each; sines, cosines and wavenumbers of both sides add to it.
constexpr double digits = 5e-14;

void expect_same_numbers(const Coefficients& c, const NemohText& text) {
  const Coefficients expected = text.expected();
  ASSERT_EQ(c.omega.size(), expected.omega.size());
  for (std::size_t k = 0; k < c.omega.size(); ++k)
    EXPECT_NEAR(c.omega[k], expected.omega[k], digits * expected.omega[k]);
  ASSERT_EQ(c.heading.size(), expected.heading.size());
  for (std::size_t k = 0; k < c.heading.size(); ++k) EXPECT_NEAR(c.heading[k], expected.heading[k], 1e-10);
  EXPECT_LT(largest_relative_error(c.A, expected.A), digits);
  EXPECT_LT(largest_relative_error(c.B, expected.B), digits);
  EXPECT_LT(largest_relative_error(c.X, expected.X), digits);
  EXPECT_EQ(c.water.density, text.water.density);
  EXPECT_EQ(c.water.gravity, text.water.gravity);
  EXPECT_EQ(c.water.depth.metres(), text.water.depth.metres());
  for (std::size_t b = 0; b < c.body.size(); ++b) EXPECT_EQ(c.body[b].reference_point, text.point[b]);
}

TEST(NemohReader, TakesZonesForMotionsAndColumnsForLoadsOfSeveralBodies) {
  TemporaryFolder folder;
  const NemohText text{.body = {.bodies = 2}, .point = {{0, 0, -2}, {3, -4, -1}}};
  expect_same_numbers(read(text.write(folder)), text);
}

TEST(NemohReader, UnderstandsAnyColumnOfFrequencies) {
  // NEMOH 3 lets its user choose; periods come in falling order of ω.
  for (const char* column : {"w (rad/s)", "f (Hz)", "T (s)"}) {
    TemporaryFolder folder;
    expect_same_numbers(read(NemohText{.column = column}.write(folder)), NemohText{.column = column});
  }
}

TEST(NemohReader, CarriesThePhaseFromTheWaveMeasurementPointToTheOrigin) {
  // (P20), in finite and in infinite depth
  for (const auto depth : {hydro::WaterDepth::from_metres(12), hydro::WaterDepth::infinite()}) {
    TemporaryFolder folder;
    const NemohText text{.water = {1000, 9.81, depth}, .wave_origin = {7, -3}};
    expect_same_numbers(read(text.write(folder)), text);
  }
}

TEST(NemohReader, TakesTheShorterHeadersOfCapytainesWriter) {
  TemporaryFolder folder;
  const NemohText text{.body = {.bodies = 2}, .point = {{0, 0, 0}, {1, 2, 3}}, .by_capytaine = true};
  expect_same_numbers(read(text.write(folder)), text);
}

TEST(NemohReader, TakesTheFolderTheCaseFileOrAResult) {
  TemporaryFolder folder;
  const NemohText text;
  text.write(folder);
  for (const char* path : {"Nemoh.cal", "Results/RadiationCoefficients.tec", "Results/ExcitationForce.tec"})
    expect_same_numbers(read(folder / path), text);
}

TEST(NemohReader, AddsDiffractionAndFroudeKrylovWhereTheirSumIsNotThere) {
  TemporaryFolder folder;
  const NemohText text;
  text.write(folder);
  std::filesystem::remove(folder / "Results/ExcitationForce.tec");
  EXPECT_THAT(read(folder / "").notes, Contains(HasSubstr("no excitation")));
  folder.write("Results/DiffractionForce.tec", text.force(0.25));
  folder.write("Results/FKForce.tec", text.force(0.75));
  expect_same_numbers(read(folder / ""), text);
}

TEST(NemohReader, ReadsCentresVolumeAndRestoringAndMovesTheLatterToThePointOfTheRotations) {
  TemporaryFolder folder;
  const NemohText text{.point = {{1, 0, -2}}};
  text.write(folder);
  std::filesystem::create_directory(folder / "Mesh");
  folder.write("Mesh/Hydrostatics.dat",
               " XF =   0.000 - XG =   0.500\n YF =   0.100 - YG =   0.000\n ZF =  -1.500 - ZG =  -1.000\n"
               " Displacement =  0.2500000E+03\n Waterplane area =  0.5E+02\n");
  folder.write("Mesh/KH.dat", "0 0 0 0 0 0\n0 0 0 0 0 0\n0 0 500 0 0 0\n0 0 0 40 0 0\n0 0 0 0 60 0\n0 0 0 0 0 0\n");
  const Coefficients c = read(folder / "");
  EXPECT_EQ(c.body[0].centre_of_buoyancy, Eigen::Vector3d(0, 0.1, -1.5));
  EXPECT_EQ(c.body[0].centre_of_gravity, Eigen::Vector3d(0.5, 0, -1));
  EXPECT_EQ(c.body[0].displaced_volume, 250);
  // (P4) by hand: turning the bow down by θ about x = 1 lifts the point x = 0.5 by θ/2.
  ASSERT_TRUE(c.C.has_value());
  EXPECT_NEAR((*c.C)(2, 4), 500 * 0.5, 1e-9);
  EXPECT_NEAR((*c.C)(4, 4), 60 + 500 * 0.25, 1e-9);
  EXPECT_NEAR((*c.C)(3, 3), 40, 1e-9);
}

// ---- refusals ----

void expect_refusal(const TemporaryFolder& folder, const char* message) {
  EXPECT_THAT([&] { read(folder / ""); }, ThrowsMessage<InputError>(HasSubstr(message))) << message;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST(NemohReader, RefusesResultsThatAreCutAtAnyLineOrInTheMiddleOfOne) {
  const NemohText text;
  for (const char* name : {"RadiationCoefficients.tec", "ExcitationForce.tec"}) {
    TemporaryFolder folder;
    text.write(folder);
    const std::string whole = hydro::io::read_text(folder / (std::string("Results/") + name));
    // Numbers have 22 characters: a cut within the last of a line leaves a number, and one digit is no loss to see.
    for (std::size_t size = 0; size + 30 < whole.size(); size += 501) {
      folder.write(std::string("Results/") + name, whole.substr(0, size));
      EXPECT_THROW(read(folder / ""), InputError) << name << " cut after " << size;
    }
    for (std::size_t at = whole.find('\n'); at + 1 < whole.size(); at = whole.find('\n', at + 1)) {
      folder.write(std::string("Results/") + name, whole.substr(0, at + 1));
      EXPECT_THROW(read(folder / ""), InputError) << name << " cut at the line that ends at " << at;
    }
  }
}

TEST(NemohReader, RefusesWhatDoesNotBelongTogether) {
  TemporaryFolder folder;
  const NemohText text;
  text.write(folder);
  NemohText other = text;
  other.omega = {0.4, 0.9, 1.3, 2.3};
  folder.write("Results/ExcitationForce.tec", other.force());
  expect_refusal(folder, "not that of RadiationCoefficients.tec");
  folder.write("Results/ExcitationForce.tec", text.force());
  folder.write("Results/RadiationCoefficients.tec",
               replaced(text.radiation(), "body    1 in DoF   2", "body    1 in DoF   1"));
  expect_refusal(folder, "surge of body 1 is there twice");
  folder.write("Results/RadiationCoefficients.tec",
               replaced(text.radiation(), "body    1 in DoF   2", "body    2 in DoF   2"));
  expect_refusal(folder, "does not name a motion");
  NemohText two = text;
  two.body.bodies = 2;
  folder.write("Results/RadiationCoefficients.tec", two.radiation());
  expect_refusal(folder, "12 values are needed");
  std::filesystem::remove(folder / "Results/RadiationCoefficients.tec");
  expect_refusal(folder, "there is no RadiationCoefficients.tec");
  std::filesystem::remove(folder / "Nemoh.cal");
  EXPECT_THAT([&] { read(folder / "Results/ExcitationForce.tec"); },
              ThrowsMessage<InputError>(HasSubstr("no Nemoh.cal")));
}

TEST(NemohReader, RefusesACaseThatIsNotOfRigidBodies) {
  TemporaryFolder folder;
  const NemohText text;
  text.write(folder);
  const auto with = [&](const char* what, const char* by) {
    folder.write("Nemoh.cal", replaced(text.cal(), what, by));
  };
  with("6\t! Number of degrees", "8\t! Number of degrees");
  expect_refusal(folder, "8 degrees of freedom: generalised (flexible) modes");
  with("6\t! Number of degrees", "5\t! Number of degrees");
  expect_refusal(folder, "there are 5 degrees of freedom");
  with("1 0. 1. 0.", "1 0. 2. 0.");
  expect_refusal(folder, "this is not sway");
  with("2 0. 1. 0. 0 0 -2", "2 0. 1. 0. 0 0 -3");
  expect_refusal(folder, "about different points");
  with("1025\t! RHO", "-1025\t! RHO");
  expect_refusal(folder, "density must be positive");
  with("12\t! DEPTH", "-12\t! DEPTH");
  expect_refusal(folder, "0 for infinite depth");
  folder.write("Nemoh.cal", text.cal().substr(0, 300));
  EXPECT_THROW(read(folder / ""), InputError);
}

TEST(NemohReader, FindsFilesInWhateverCaseTheirNamesAre) {
  TemporaryFolder folder;
  const NemohText text;
  const auto write = [&](const char* cal, const char* mesh, const char* results, const char* hydrostatics) {
    for (const auto& entry : std::filesystem::directory_iterator(folder / "")) std::filesystem::remove_all(entry);
    for (const char* name : {mesh, results}) std::filesystem::create_directory(folder / name);
    folder.write(cal, text.cal());
    folder.write(std::string(results) + "/RadiationCoefficients.tec", text.radiation());
    folder.write(std::string(mesh) + "/" + hydrostatics,
                 "XF = 0.1 - XG = 0.2\nYF = 0 - YG = 0\nZF = -1 - ZG = -0.5\nDisplacement = 12.5\n");
  };
  for (const char* name : {"Hydrostatics.dat", "hydrostatics_0.dat", "HYDROSTATICS_0.DAT"}) {
    write("Nemoh.cal", "Mesh", "Results", name);
    EXPECT_EQ(read(folder / "").body[0].displaced_volume, 12.5) << name;
  }
  write("nemoh.cal", "MESH", "RESULTS", "Hydrostatics_0.dat");
  EXPECT_EQ(read(folder / "").body[0].displaced_volume, 12.5);
  write("Nemoh.cal", "Mesh", "Results", "else.dat");
  EXPECT_THAT(read(folder / "").notes, ::testing::Contains(HasSubstr("no volume and centres of body1")));
}

TEST(NemohReader, RefusesNumbersThatAreNone) {
  TemporaryFolder folder;
  const NemohText text;
  text.write(folder);
  const std::string value = fmt::format("{:.15e}", text.body.A(0, 0, 0.4));
  for (const char* bad : {"NaN", "Infinity", "*************"}) {
    folder.write("Results/RadiationCoefficients.tec", replaced(text.radiation(), value, bad));
    EXPECT_THAT([&] { read(folder / ""); },
                ThrowsMessage<InputError>(AllOf(HasSubstr("RadiationCoefficients.tec:3:"), HasSubstr(bad))));
  }
}

TEST(NemohReader, RefusesWamitsOptions) {
  TemporaryFolder folder;
  const auto path = NemohText{}.write(folder);
  hydro::potential::ReadOptions options;
  options.ulen = 2;
  EXPECT_THAT([&] { read(path, options); }, ThrowsMessage<InputError>(HasSubstr("ULEN = 2 m is given")));
  options.ulen.reset();
  options.iperout = 1;
  EXPECT_THAT([&] { read(path, options); }, ThrowsMessage<InputError>(HasSubstr("IPEROUT = 1 is given")));
}

// ---- outside data ----

/// CM.dat and CA.dat of NEMOH 3: `frequency` and then six rows of six, motions in rows and loads in columns.
TEST(NemohOutsideData, IsTheSameInTheTwoWaysInWhichNemohThreeWritesIt) {
  FROUDE_REQUIRE_DATA(folder, "bem_formats/ellipsoid_nemoh_v3");
  const Coefficients c = read(folder);
  ASSERT_EQ(c.omega.size(), 308u);
  for (const bool mass : {true, false}) {
    std::istringstream in(hydro::io::read_text(folder / (mass ? "Results/CM.dat" : "Results/CA.dat")));
    std::string words;
    std::getline(in, words);
    for (std::size_t k = 0; k < c.omega.size(); ++k) {
      double omega = 0;
      Eigen::MatrixXd m(6, 6);
      in >> omega;
      for (Eigen::Index motion = 0; motion < 6; ++motion)
        for (Eigen::Index load = 0; load < 6; ++load) in >> m(load, motion);
      // Six digits there, half of the last of which is 5e-6 at most; seven here.
      EXPECT_LT(relative_difference(std::vector{mass ? c.A[k] : c.B[k]}, std::vector{m}), 5.5e-6) << omega;
    }
  }
}

TEST(NemohOutsideData, ReadsEveryFolderAtHand) {
  FROUDE_REQUIRE_DATA(folder, "bem_formats");
  for (const char* name : {"ellipsoid_nemoh_v2", "cylinder_nemoh_v3", "capytaine_pytest/Cylinder",
                           "capytaine_pytest/NonSymmetrical", "bemrosetta_gpl/capytaine_multibody"})
    EXPECT_FALSE(read(folder / name).X.empty()) << name;
}

TEST(NemohOutsideData, IsTheSameAsTheNetcdfOfTheSameRun) {
  FROUDE_REQUIRE_DATA(folder, "bem_formats/bemrosetta_gpl/capytaine_multibody");
  const Coefficients tec = read(folder), nc = read(folder / "results.nc");
  ASSERT_EQ(tec.bodies(), 2);
  constexpr double seven_digits = 1e-6;
  ASSERT_EQ(tec.omega.size(), nc.omega.size());
  EXPECT_LT(relative_difference(tec.A, nc.A), seven_digits);
  EXPECT_LT(relative_difference(tec.B, nc.B), seven_digits);
  EXPECT_LT(relative_difference(tec.X, nc.X), seven_digits);
}

TEST(NemohReader, RefusesACaseThatIsCutAtAnyLineOrAnnouncesMoreThanItHas) {
  TemporaryFolder folder;
  const NemohText text;
  const auto path = text.write(folder);
  const std::string whole = text.cal();
  for (std::size_t at = whole.find('\n'); at + 1 < whole.size(); at = whole.find('\n', at + 1)) {
    folder.write("Nemoh.cal", whole.substr(0, at + 1));
    EXPECT_THROW(read(path), InputError) << "cut after " << at;
  }
  std::string endless = whole;
  const std::string none = "0\t! Number of lines";
  folder.write("Nemoh.cal", endless.replace(endless.find(none), 1, "2147483647"));
  EXPECT_THROW(read(path), InputError);
}

}  // namespace
}  // namespace nemoh_reader_test
