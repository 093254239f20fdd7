#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "aqwa_text.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/waves/dispersion.hpp"
#include "support/reference_data.hpp"

namespace aqwa_reader_test {
namespace {

using froude_test::AqwaText;
using froude_test::largest_relative_error;
using froude_test::listed;
using froude_test::SmoothBody;
using froude_test::TemporaryFolder;
using hydro::InputError;
using hydro::potential::Coefficients;
using hydro::potential::read;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// 16 digits in the file; degrees, wavenumbers and sines of both sides add to it.
constexpr double digits = 5e-14;

void expect_same_numbers(const Coefficients& c, const AqwaText& text) {
  const Coefficients expected = text.expected();
  EXPECT_EQ(c.omega, expected.omega);
  ASSERT_EQ(c.heading.size(), expected.heading.size());
  EXPECT_LT(largest_relative_error(c.A, expected.A), digits);
  EXPECT_LT(largest_relative_error(c.B, expected.B), digits);
  EXPECT_LT(largest_relative_error(c.X, expected.X), digits);
  EXPECT_LT(largest_relative_error(listed(c.A_zero), listed(expected.A_zero)), digits);
  EXPECT_LT(largest_relative_error(listed(c.A_inf), listed(expected.A_inf)), digits);
  EXPECT_LT(largest_relative_error(listed(c.C), listed(expected.C)), digits);
  EXPECT_EQ(c.water.depth.metres(), 12);
  EXPECT_EQ(c.water.density, 1025);
  EXPECT_EQ(c.water.gravity, 9.8);
}

TEST(AqwaReader, ReadsSeveralStructuresAboutTheirCentresOfGravity) {
  // (P22): lags, degrees, centres away from the origin; blocks of loads on the first structure by motions of the second
  TemporaryFolder folder;
  const AqwaText text{.body = {.bodies = 2}, .cog = {{7, -3, -2}, {-20, 4, -1}}};
  const Coefficients c = read(folder.write("x.AH1", text.all()));
  expect_same_numbers(c, text);
  EXPECT_EQ(c.body[1].reference_point, text.cog[1]);
  EXPECT_EQ(c.body[1].centre_of_gravity, text.cog[1]);
  EXPECT_EQ(c.body[1].centre_of_buoyancy, Eigen::Vector3d(-20, 4, -0.5));
  EXPECT_EQ(c.body[1].displaced_volume, 200);
  EXPECT_THAT(c.notes, Contains(HasSubstr("FIDD")));
  EXPECT_THAT(c.notes, Contains(HasSubstr("ADDEDMASS_HF")));
}

TEST(AqwaReader, ReadsFilesOfEarlierVersionsByContent) {
  TemporaryFolder folder;
  const AqwaText text{.is_recent = false};
  expect_same_numbers(read(folder.write("any.name", text.all())), text);
}

TEST(AqwaReader, TakesStructuresWithoutCouplingAndFilesWithoutLimits) {
  TemporaryFolder folder;
  const AqwaText text{.body = {.bodies = 2}, .cog = {{0, 0, 0}, {9, 0, 0}}, .has_limits = false, .has_coupling = false};
  const Coefficients c = read(folder.write("x.AH1", text.all()));
  EXPECT_FALSE(c.A_zero.has_value());
  EXPECT_FALSE(c.A_inf.has_value());
  EXPECT_TRUE(c.A[0].topRightCorner(6, 6).isZero(0));
  EXPECT_NEAR(c.A[0](7, 8), text.body.A(7, 8, text.omega[0]), digits * c.A[0](7, 8));
}

TEST(AqwaReader, RefusesAFileThatIsCutAtAnyLine) {
  TemporaryFolder folder;
  AqwaText text;
  text.omega = {0.4, 0.9};
  text.heading_deg = {0, 90};
  const std::string whole = text.all();
  for (std::size_t at = whole.find('\n'); at + 1 < whole.size(); at = whole.find('\n', at + 1))
    EXPECT_THROW(read(folder.write("x.AH1", whole.substr(0, at + 1))), InputError) << "cut after " << at;
}

TEST(AqwaReader, RefusesWhatIsThereTwiceOrNotANumber) {
  TemporaryFolder folder;
  const std::string whole = AqwaText{}.all();
  const auto expect = [&](const std::string& what, const std::string& by, const char* message) {
    std::string text = whole;
    const auto at = text.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    EXPECT_THAT([&] { read(folder.write("x.AH1", text.replace(at, what.size(), by))); },
                ThrowsMessage<InputError>(HasSubstr(message)));
  };
  expect("ADDEDMASS\n  1  1  1 ", "ADDEDMASS\n  1  1  2 ", "is there twice");
  expect("FORCERAO\n  1  1  1 ", "FORCERAO\n  1  1  2 ", "are there twice");
  expect("FORCERAO\n  1  1  1 ", "FORCERAO\n  1  9  1 ", "heading 9 of 7");
  expect("ADDEDMASS\n  1  1  1 ", "ADDEDMASS\n  1  1  1 ********", "is no number");
  expect("ADDEDMASS\n  1  1  1 ", "ADDEDMASS\n  1  1  1 NaN", "not finite");
  expect("COG\n", "CAT\n", "no section COG");
  expect("GENERAL\n  1  12", "GENERAL\n  1  -12", "must be positive");
  expect("COG\n  1", "COG\n  2", "structure 2 of 1");
}

TEST(AqwaOutsideData, ReadsEveryFileAtHand) {
  FROUDE_REQUIRE_DATA(folder, "");
  for (const char* name : {"bem_formats/cylinder_aqwa/cylinder.AH1", "bem_formats/ellipsoid_aqwa/ellipsoid.AH1",
                           "iea_sphere/aqwa/sphere.AH1", "rm3/aqwa/RM3.AH1"})
    if (std::filesystem::exists(folder / name)) {
      EXPECT_EQ(read(folder / name).omega.size(), 50u) << name;
    }
}

TEST(AqwaOutsideData, WritesTheLoadOnTheFirstStructureIntoTheRowsOfABlock) {
  // Float and spar of RM3 act on each other near the waterline, 20 m above the spar's centre and at the float's: the
  // float's surge load by the spar's pitch is about 20 m times that by its surge. Taken the other way round, the
  // float's pitch would have that long arm.
  FROUDE_REQUIRE_DATA(file, "rm3/aqwa/RM3.AH1");
  const Coefficients c = read(file);
  const auto& A = c.A[10];
  EXPECT_NEAR(A(0, 10) / A(0, 6), 20, 2);
  EXPECT_LT(std::abs(A(4, 6) / A(0, 6)), 3);
}

// ---- .LIS ----

TEST(AqwaLis, HoldsTheSameRunAsTheAh1FileToTheDigitsThatItPrints) {
  FROUDE_REQUIRE_DATA(folder, "bem_formats/cylinder_aqwa");
  const Coefficients lis = read(folder / "cylinder.LIS"), ah1 = read(folder / "cylinder.AH1");
  ASSERT_EQ(lis.omega.size(), ah1.omega.size());
  for (std::size_t k = 0; k < lis.omega.size(); ++k) EXPECT_NEAR(lis.omega[k], ah1.omega[k], 5e-6 * 1.1);
  EXPECT_EQ(lis.heading, ah1.heading);
  constexpr double five_digits = 1e-12;  // both files print the same five
  EXPECT_LT(largest_relative_error(lis.A, ah1.A), five_digits);
  EXPECT_LT(largest_relative_error(lis.B, ah1.B), five_digits);
  EXPECT_LT(largest_relative_error(listed(lis.A_zero), listed(ah1.A_zero)), five_digits);
  EXPECT_LT(largest_relative_error(listed(lis.A_inf), listed(ah1.A_inf)), five_digits);
  EXPECT_LT(largest_relative_error(listed(lis.C), listed(ah1.C)), five_digits);
  EXPECT_LT(largest_relative_error(lis.X, ah1.X), 0.0051) << "three digits of the modulus";
  EXPECT_EQ(lis.water.depth.metres(), 3);
  EXPECT_EQ(lis.water.density, 1025);
  EXPECT_EQ(lis.body[0].centre_of_buoyancy, ah1.body[0].centre_of_buoyancy);
  EXPECT_EQ(lis.body[0].reference_point, ah1.body[0].reference_point);
  EXPECT_NEAR(*lis.body[0].displaced_volume, *ah1.body[0].displaced_volume, 1.1e-6) << "one digit more";
}

TEST(AqwaLis, CountsItsPhasesFromTheCentreOfGravity) {
  // (P22): a box whose centre is at y = 2 m; at its own place the box has the phases of one at the origin.
  FROUDE_REQUIRE_DATA(file, "bem_formats/bemrosetta_gpl/aqwa_box1/ANALYSIS.LIS");
  const Coefficients c = read(file);
  ASSERT_EQ(c.heading.size(), 5u);
  EXPECT_EQ(c.body[0].centre_of_gravity, Eigen::Vector3d(0, 2, -1));
  const double k = hydro::waves::wavenumber(c.omega[3], c.water);
  const auto along_y = c.X[3](2, 3), along_x = c.X[2](2, 3);
  EXPECT_NEAR(std::arg(along_x) * 180 / std::numbers::pi, 1.0, 0.005) << "printed: a lag of -1.00 degrees";
  EXPECT_NEAR(std::arg(along_y / along_x), -2 * k, 1e-9) << "the wave reaches y = 2 m later";
  EXPECT_NEAR((*c.C)(2, 2), 1025 * 9.81 * 4, 1) << "a waterplane of 4 m²";
}

TEST(AqwaLis, RefusesAFileThatIsCutAnywhere) {
  FROUDE_REQUIRE_DATA(file, "bem_formats/bemrosetta_gpl/aqwa_box1/ANALYSIS.LIS");
  TemporaryFolder folder;
  const std::string whole = hydro::io::read_text(file);
  for (std::size_t size = 2000; size + 400 < whole.size(); size += 5003)
    EXPECT_THROW(read(folder.write("x.LIS", whole.substr(0, size))), InputError) << "cut after " << size;
  const auto expect = [&](const std::string& what, const std::string& by, const char* message) {
    std::string text = whole;
    const auto at = text.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    EXPECT_THAT([&] { read(folder.write("x.LIS", text.replace(at, what.size(), by))); },
                ThrowsMessage<InputError>(HasSubstr(message)));
  };
  const std::string title = "P A R A M E T E R S   F O R   S T R U C T U R E   ";
  expect(title + "1", title + "2", "several structures");
  expect("WAVE FREQUENCY =  0.4000", "WAVE FREQUENCY =  0.5000", "should be of 0.4 rad/s");
  expect("DIRECTIONS   1       2       3       4       5", "DIRECTIONS   1  2  3  4  5  6", "6 headings are announced");
  expect("\n           RY ", "\n           QY ", "the matrix has");
}

}  // namespace
}  // namespace aqwa_reader_test
