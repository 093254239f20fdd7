#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hydro/base/error.hpp"
#include "support/reference_data.hpp"
#include "wamit_text.hpp"

namespace hams_reader_test {
namespace {

namespace fs = std::filesystem;
using froude_test::largest_relative_error;
using froude_test::TemporaryFolder;
using froude_test::WamitText;
using hydro::InputError;
using hydro::potential::Coefficients;
using hydro::potential::read;
using hydro::potential::ReadOptions;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// Files are written with 16 significant digits, and wavenumbers are solved on both sides.
constexpr double digits = 2e-14;

std::string control(int frequency_type, double depth, double length = 1) {
  return fmt::format(
      "   --------------HAMS Control file---------------\n\n   Waterdepth  {}D0\n\n"
      "    Input_frequency_type        3\n    Output_frequency_type       {}\n    Number_of_frequencies      -4\n"
      "    Reference_body_center   1.000   2.000   -3.000\n    Reference_body_length   {}D0\n",
      depth, frequency_type, length);
}

ReadOptions water(const hydro::Water& w) { return {w.density, w.gravity, {}, {}, {}}; }

/// WAMIT's numbers with the phase turned round, as HAMS writes them.
std::string conjugated(const WamitText& text) {
  std::string out;
  for (const double w : text.omega)
    for (const double degrees : text.heading_deg)
      for (int i = 0; i < 6; ++i) {
        const auto X = std::conj(text.body.X(i, w, hydro::Angle::from_degrees(degrees).radians())) /
                       (text.water.density * text.water.gravity * std::pow(text.ulen, i < 3 ? 2 : 3));
        out += fmt::format(" {:.15e} {:.15e} {} {:.15e} {:.15e} {:.15e} {:.15e}\n", text.per(w), degrees, i + 1,
                           std::abs(X), std::arg(X) * 180 / std::numbers::pi, X.real(), X.imag());
      }
  return out;
}

fs::path write_run(const TemporaryFolder& folder, const WamitText& text, int type) {
  fs::create_directories(folder / "Input");
  fs::create_directories(folder / "Output/Wamit_format");
  folder.write("Output/Wamit_format/Buoy.1", text.radiation());
  folder.write("Output/Wamit_format/Buoy.3", conjugated(text));
  folder.write("Output/Wamit_format/Buoy.hst", text.restoring());
  return folder.write("Input/ControlFile.in", control(type, text.water.depth.metres(), text.ulen));
}

TEST(HamsReader, NumbersTheKindsOfItsFirstColumnInItsOwnWay) {
  // (P23): 1 deep-water wavenumber, 2 wavenumber, 3 frequency, 4 period; WAMIT's numbers of the same are 3, 4, 2, 1
  for (const auto& [type, iperout] : {std::pair{1, 3}, std::pair{2, 4}, std::pair{3, 2}, std::pair{4, 1}}) {
    TemporaryFolder folder;
    const WamitText text{.ulen = iperout <= 2 ? 2.5 : 1.0, .iperout = iperout};
    const auto path = write_run(folder, text, type);
    const Coefficients expected = text.expected();
    for (const fs::path& p : {path, folder / "", folder / "Output/Wamit_format/Buoy.1"}) {
      const Coefficients c = read(p, water(text.water));
      EXPECT_LT(largest_relative_error(c.A, expected.A), digits) << type;
      EXPECT_LT(largest_relative_error(c.B, expected.B), digits) << type;
      EXPECT_LT(largest_relative_error(c.X, expected.X), digits) << "conjugated (P7), type " << type;
      EXPECT_EQ(c.water.depth.metres(), text.water.depth.metres());
      EXPECT_EQ(c.body[0].reference_point, Eigen::Vector3d(1, 2, -3));
    }
  }
}

TEST(HamsReader, TakesWavelengths) {
  TemporaryFolder folder;
  WamitText text{.omega = {0.9}};
  const double length = 2 * std::numbers::pi / froude_test::wavenumber_by_bisection(0.9, text.water);
  folder.write("Buoy.1", fmt::format("{:.15e} 1 1 2 3\n", length));
  const auto c = read(folder.write("ControlFile.in", control(5, 12)), water(text.water));
  EXPECT_NEAR(c.omega[0], 0.9, digits);
}

TEST(HamsReader, TakesANegativeDepthForInfinite) {
  TemporaryFolder folder;
  folder.write("Buoy.1", "6 1 1 2 3\n");
  EXPECT_TRUE(read(folder.write("ControlFile.in", control(4, -1)), water({})).water.depth.is_infinite());
}

TEST(HamsReader, RefusesWhatItDoesNotKnow) {
  TemporaryFolder folder;
  folder.write("Buoy.1", "6 1 1 2 3\n");
  const auto expect = [&](const std::string& text, const ReadOptions& options, const char* message) {
    const auto path = folder.write("ControlFile.in", text);
    EXPECT_THAT([&] { read(path, options); }, ThrowsMessage<InputError>(HasSubstr(message)));
  };
  expect(control(6, 12), water({}), "Output_frequency_type is 1 to 5, got 6");
  expect(control(1, 12, 2), water({}), "reference length that is not 1 m");
  expect(control(4, 0), water({}), "the depth is zero");
  expect(control(4, 12, 0), water({}), "reference length must be positive");
  expect(control(4, 12), {}, "do not hold density and gravity");
  expect(control(4, 12).substr(0, 170), water({}), "there is no line");
  ReadOptions options = water({});
  options.iperout = 1;
  expect(control(4, 12), options, "IPEROUT = 1 is given");
  folder.write("Other.1", "6 1 1 2 3\n");
  expect(control(4, 12), water({}), "there are 2 files *.1");
}

TEST(HamsOutsideData, IsRefusedAsWamitAndReadWithItsControlFile) {
  FROUDE_REQUIRE_DATA(data, "bem_formats/cylinder_hams");
  const ReadOptions options{1025, 9.81, hydro::WaterDepth::infinite(), {}, {}};
  // (P21): the phases say that these are not WAMIT's
  EXPECT_THAT([&] { read(data / "Buoy.1", options); }, ThrowsMessage<InputError>(HasSubstr("other time factor")));
  TemporaryFolder folder;
  for (const char* name : {"Buoy.1", "Buoy.3", "Buoy.hst"}) fs::copy_file(data / name, folder / name);
  const Coefficients c = read(folder.write("ControlFile.in", control(4, -1)), options);
  ASSERT_EQ(c.heading.size(), 7u);
  EXPECT_NEAR(std::arg(c.X[0](0, 0)) * 180 / std::numbers::pi, 90.285, 1e-3) << "surge leads the crest";
  EXPECT_NEAR(std::abs(c.X[0](2, 0)), 1025 * 9.81 * 2.737005, 0.1);
}

// ---- WAMIT's .out beside its numeric files ----

std::string out_file(double depth, const Eigen::Vector3d& origin, double phi = 0, double ulen = 1) {
  return fmt::format(
      " Gravity:     9.80000                Length scale:   {:12.5f}\n Water depth: {}\n BODY PARAMETERS:\n"
      " XBODY ={:10.4f} YBODY ={:10.4f} ZBODY ={:10.4f} PHIBODY ={:6.1f}\n"
      " Volumes (VOLX,VOLY,VOLZ):           725.833      725.9      725.834    \n"
      " Center of Buoyancy (Xb,Yb,Zb):     0.000000     0.100000    -0.572734\n"
      " Center of Gravity  (Xg,Yg,Zg):     0.500000     0.000000     0.250000\n",
      ulen, std::isinf(depth) ? "       infinite" : fmt::format("{:12.5f}", depth), origin.x(), origin.y(), origin.z(),
      phi);
}

TEST(WamitOut, GivesGravityDepthAndPointsThatTheNumericFilesLack) {
  TemporaryFolder folder;
  const WamitText text;
  const auto path = text.write(folder);
  folder.write("x.out", out_file(12, {-20, 3, -0.72}));
  const Coefficients c = read(path, {1025, {}, {}, 1, 1});
  EXPECT_LT(largest_relative_error(c.X, text.expected().X), digits);
  EXPECT_EQ(c.water.gravity, 9.8);
  EXPECT_EQ(c.water.depth.metres(), 12);
  EXPECT_EQ(c.body[0].reference_point, Eigen::Vector3d(-20, 3, -0.72));
  EXPECT_TRUE(c.body[0].centre_of_buoyancy->isApprox(Eigen::Vector3d(-20, 3.1, -1.292734), 1e-14));
  EXPECT_TRUE(c.body[0].centre_of_gravity->isApprox(Eigen::Vector3d(-19.5, 3, -0.47), 1e-14));
  EXPECT_EQ(c.body[0].displaced_volume, 725.834) << "the median";
  folder.write("x.out", out_file(std::numeric_limits<double>::infinity(), {0, 0, 0}));
  const Coefficients deep = read(path, {1025, 9.81, hydro::WaterDepth::from_metres(12), 1, 1});
  EXPECT_TRUE(deep.water.depth.is_infinite());
  EXPECT_THAT(deep.notes, Contains(HasSubstr("gravity 9.81 was asked for, but the .out file states 9.8")));
  EXPECT_THAT(deep.notes, Contains(HasSubstr("depth 12 was asked for")));
}

TEST(WamitOut, GivesDensityWhereItStatesIt) {
  TemporaryFolder folder;
  WamitText text;
  const auto path = text.write(folder);
  const auto out = [](const char* density) {
    return fmt::format(
        " Gravity:     9.80000                Length scale:        1.00000\n Water depth:        12.00000    {}\n"
        " XBODY =  0 YBODY = 0 ZBODY = 0 PHIBODY = 0\n Volumes (VOLX,VOLY,VOLZ):  1 1 1\n"
        " Center of Buoyancy (Xb,Yb,Zb): 0 0 -1\n Center of Gravity  (Xg,Yg,Zg): 0 0 -1\n",
        density);
  };
  folder.write("x.out", out(" Water density:      1025.00000"));
  EXPECT_EQ(read(path, {.iperout = 1}).water.density, 1025);
  EXPECT_THAT(read(path, {.density = 1000, .iperout = 1}).notes, Contains(HasSubstr("density 1000 was asked for")));
  folder.write("x.out", out(""));
  EXPECT_THAT([&] { read(path, {.iperout = 1}); }, ThrowsMessage<InputError>(HasSubstr("do not hold the density")));
}

TEST(WamitOut, GivesUlen) {
  TemporaryFolder folder;
  const WamitText text{.ulen = 2.5};
  const auto path = text.write(folder);
  folder.write("x.out", out_file(12, {0, 0, 0}, 0, 2.5));
  const Coefficients c = read(path, {1025, {}, {}, 1, 1});
  EXPECT_LT(largest_relative_error(c.A, text.expected().A), digits);
  EXPECT_THAT(c.notes, Contains(HasSubstr("ULEN is not 1")));
}

TEST(WamitOut, IsRefusedIfItDoesNotFit) {
  TemporaryFolder folder;
  const auto path = WamitText{.body = {.bodies = 2}}.write(folder);
  const auto expect = [&](const std::string& text, const char* message) {
    folder.write("x.out", text);
    EXPECT_THAT([&] { read(path, {1025, {}, {}, 1, 1}); }, ThrowsMessage<InputError>(HasSubstr(message)));
  };
  const std::string whole = out_file(12, {0, 0, 0});
  expect(whole, "mode 12 is one too many for the 1 rigid body that the .out file tells of");
  expect(out_file(12, {0, 0, 0}, 30), "turned by 30 degrees");
  for (const char* label : {"Gravity:", "Water depth:", "XBODY =", "ZBODY =", "Volumes", "Center of Gravity"})
    expect(whole.substr(0, whole.find(label)), label);
  std::string without_scale = whole;
  expect(without_scale.replace(whole.find("Length scale:"), 13, ""), "Length scale:");
}

TEST(WamitExcitation, IsTakenFromHaskindOrFromItsPartsWhereThereIsNoDiffraction) {
  TemporaryFolder folder;
  const WamitText text;
  const auto path = text.write(folder);
  fs::rename(folder / "x.3", folder / "x.2");
  const Coefficients haskind = read(path, text.options());
  EXPECT_LT(largest_relative_error(haskind.X, text.expected().X), digits);
  EXPECT_THAT(haskind.notes, Contains(HasSubstr("Haskind")));
  fs::copy_file(folder / "x.2", folder / "x.3fk");
  fs::rename(folder / "x.2", folder / "x.3sc");
  const Coefficients parts = read(path, text.options());
  EXPECT_LT(largest_relative_error(parts.X,
                                   std::vector<Eigen::MatrixXcd>{2 * text.expected().X[0], 2 * text.expected().X[1]}),
            digits);
  folder.write("x.4", "");
  EXPECT_THAT(read(path, text.options()).notes, Contains(HasSubstr(".4: motions")));
}

TEST(WamitExcitation, OfTheEllipsoidIsTheSumOfItsParts) {
  FROUDE_REQUIRE_DATA(data, "bem_formats/ellipsoid_wamit");
  TemporaryFolder folder;
  for (const char* name : {"ellipsoid.1", "ellipsoid.3fk", "ellipsoid.3sc"}) fs::copy_file(data / name, folder / name);
  const ReadOptions options{1000, 9.81, hydro::WaterDepth::infinite(), 1, {}};
  // Seven digits each, and the parts may be larger than the sum.
  EXPECT_LT(
      froude_test::relative_difference(read(folder / "ellipsoid", options).X, read(data / "ellipsoid.1", options).X),
      2e-6);
}

}  // namespace
}  // namespace hams_reader_test
