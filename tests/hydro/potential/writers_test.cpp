#include "hydro/potential/formats/writers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "hydro/base/error.hpp"
#include "hydro/io/hdf5.hpp"
#include "hydro/io/netcdf.hpp"
#include "hydro/potential/operations/operations.hpp"
#include "smooth_body.hpp"

namespace writers_test {
namespace {

using froude_test::largest_relative_error;
using froude_test::listed;
using froude_test::random_coefficients;
using froude_test::TemporaryFolder;
using hydro::InputError;
using namespace hydro::potential;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

constexpr std::uint64_t trials = 40;

template <class Matrices>
void expect_same_bits(const Matrices& a, const Matrices& b, const char* what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t k = 0; k < a.size(); ++k) {
    ASSERT_EQ(a[k].rows(), b[k].rows()) << what;
    ASSERT_EQ(a[k].cols(), b[k].cols()) << what;
    EXPECT_EQ(std::memcmp(a[k].data(), b[k].data(), sizeof(*a[k].data()) * std::size_t(a[k].size())), 0) << what;
  }
}

void expect_same_body(const BodyData& a, const BodyData& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.reference_point, b.reference_point);
  EXPECT_EQ(a.centre_of_gravity, b.centre_of_gravity);
  EXPECT_EQ(a.centre_of_buoyancy, b.centre_of_buoyancy);
  EXPECT_EQ(a.displaced_volume, b.displaced_volume);
}

TEST(FroudeFormat, GivesBackEveryBitOfAnyCoefficients) {
  TemporaryFolder folder;
  for (std::uint64_t seed = 1; seed <= trials; ++seed) {
    const Coefficients c = random_coefficients(seed);
    EXPECT_THAT(write_froude(c, folder / "c.h5"), ElementsAre());
    const Coefficients r = read(folder / "c.h5");
    EXPECT_EQ(r.source, c.source);
    EXPECT_EQ(r.notes, c.notes);
    EXPECT_EQ(r.water.density, c.water.density);
    EXPECT_EQ(r.water.gravity, c.water.gravity);
    EXPECT_EQ(r.water.depth.metres(), c.water.depth.metres());
    EXPECT_EQ(r.omega, c.omega);
    EXPECT_EQ(r.heading, c.heading);
    expect_same_bits(r.A, c.A, "A");
    expect_same_bits(r.B, c.B, "B");
    expect_same_bits(r.X, c.X, "X");
    expect_same_bits(listed(r.A_zero), listed(c.A_zero), "A_zero");
    expect_same_bits(listed(r.A_inf), listed(c.A_inf), "A_inf");
    expect_same_bits(listed(r.C), listed(c.C), "C");
    ASSERT_EQ(r.body.size(), c.body.size());
    for (std::size_t b = 0; b < c.body.size(); ++b) expect_same_body(r.body[b], c.body[b]);
  }
}

TEST(FroudeFormat, IsReadByANetcdfLibraryWithAxesByName) {
  TemporaryFolder folder;
  const auto c = froude_test::SmoothBody{.bodies = 2}.coefficients({}, {0.5, 1.0, 2.0}, {0.0, 1.0});
  write_froude(c, folder / "c.h5");
  const hydro::io::NetcdfReader file(folder / "c.h5");
  EXPECT_THAT(file.axes("added_mass"), ElementsAre("omega", "load_mode", "motion_mode"));
  EXPECT_THAT(file.axes("excitation_re"), ElementsAre("heading", "load_mode", "omega"));
  EXPECT_THAT(file.axes("body_name"), ElementsAre("body"));
  EXPECT_EQ(file.numbers("omega").values, c.omega);
  const auto A = file.arranged("added_mass", {{"motion_mode", 12}, {"omega", 3}, {"load_mode", 12}});
  EXPECT_EQ(A[(7 * 3 + 1) * 12 + 2], c.A[1](2, 7));
}

TEST(FroudeFormat, RefusesALaterVersion) {
  TemporaryFolder folder;
  hydro::io::Hdf5Writer file;
  file.attribute("/", "format", "Froude coefficients");
  file.attribute("/", "format_version", 2.0);
  file.save(folder / "later.h5");
  EXPECT_THAT([&] { read(folder / "later.h5"); }, ThrowsMessage<InputError>(HasSubstr("use a newer Froude")));
}

// Each number is divided and multiplied by the same two or three factors: half a dozen roundings of 1.1e-16 at most.
constexpr double roundings = 1e-15;

TEST(BemioWriter, LosesNothingThatItDoesNotTell) {
  TemporaryFolder folder;
  for (std::uint64_t seed = 1; seed <= trials; ++seed) {
    Coefficients c = random_coefficients(seed);
    for (auto& body : c.body) body.reference_point = body.centre_of_gravity;  // about which BEMIO's coefficients are
    if (c.C) {
      Eigen::MatrixXd blocks = Eigen::MatrixXd::Zero(c.modes(), c.modes());
      for (int b = 0; b < c.bodies(); ++b) blocks.block<6, 6>(6 * b, 6 * b) = c.C->block<6, 6>(6 * b, 6 * b);
      c.C = blocks;
    }
    const auto told = write_bemio(c, folder / "c.h5");
    const Coefficients r = read(folder / "c.h5");
    EXPECT_EQ(r.omega, c.omega);
    EXPECT_EQ(r.water.depth.metres(), c.water.depth.metres());
    EXPECT_LT(largest_relative_error(r.A, c.A), roundings);
    EXPECT_LT(largest_relative_error(r.B, c.B), roundings);
    EXPECT_LT(froude_test::relative_difference(r.X, c.X), roundings);
    EXPECT_LT(largest_relative_error(listed(r.A_inf), listed(c.A_inf)), roundings);
    EXPECT_LT(largest_relative_error(listed(r.C), listed(c.C)), roundings);
    for (std::size_t b = 0; b < c.body.size(); ++b) expect_same_body(r.body[b], c.body[b]);
    for (std::size_t h = 0; h < c.heading.size(); ++h) EXPECT_NEAR(r.heading[h], c.heading[h], 1e-15 * 4);
    EXPECT_EQ(c.A_zero.has_value(), testing::Value(told, Contains(HasSubstr("zero frequency"))));
    EXPECT_EQ(!c.A_inf, testing::Value(told, Contains(HasSubstr("inf_freq is not written"))));
    EXPECT_EQ(!c.C, testing::Value(told, Contains(HasSubstr("linear_restoring_stiffness is not written"))));
    EXPECT_EQ(c.X.empty(), testing::Value(told, Contains(HasSubstr("excitation is not written"))));
    EXPECT_EQ(!c.notes.empty(), testing::Value(told, Contains(HasSubstr("notes"))));
  }
}

TEST(BemioWriter, WritesModulusAndPhaseOfTheVeryPartsItWrites) {
  TemporaryFolder folder;
  write_bemio(froude_test::SmoothBody{}.coefficients({}, {0.5, 1.0}, {0.3, 1.0}), folder / "c.h5");
  const hydro::io::Hdf5Reader file(folder / "c.h5");
  const auto part = [&](const std::string& name) {
    return file.numbers("/body1/hydro_coeffs/excitation/" + name).values;
  };
  const auto re = part("re"), im = part("im"), mag = part("mag"), phase = part("phase");
  for (std::size_t k = 0; k < re.size(); ++k)
    EXPECT_LT(std::abs(std::polar(mag[k], phase[k]) - std::complex<double>(re[k], im[k])), roundings * mag[k]);
}

TEST(BemioWriter, TellsOfRestoringBetweenBodies) {
  TemporaryFolder folder;
  auto c = froude_test::SmoothBody{.bodies = 2}.coefficients({}, {0.5, 1.0}, {0.0});
  EXPECT_THAT(write_bemio(c, folder / "c.h5"), Not(Contains(HasSubstr("between different bodies"))));
  (*c.C)(2, 8) = -5;
  EXPECT_THAT(write_bemio(c, folder / "c.h5"), Contains(HasSubstr("between different bodies")));
}

TEST(BemioWriter, MovesCoefficientsToTheCentreOfGravity) {
  // The power of a motion and the load in a wave do not depend on the point they are written about (P4).
  TemporaryFolder folder;
  auto c = froude_test::SmoothBody{.bodies = 2}.coefficients({}, {0.5, 1.0}, {0.0, 1.0});
  const Eigen::Vector3d R1(1, 2, 3), G1(-2, 0.5, 1), G2(4, 4, -4);
  c.body[0].reference_point = R1;
  c.body[0].centre_of_gravity = G1;
  c.body[1].reference_point = c.body[1].centre_of_gravity = G2;
  EXPECT_THAT(write_bemio(c, folder / "c.h5"), Contains(HasSubstr("moved from the reference point (1, 2, 3) m")));
  const Coefficients r = read(folder / "c.h5");
  Eigen::VectorXd v_at_G(12), v_at_R(12);
  v_at_G << 0.1, -0.2, 0.3, 0.4, -0.5, 0.6, 1, 2, 3, 0.1, 0.2, 0.3;
  v_at_R = v_at_G;
  v_at_R.head<6>() = rigid_shift(R1 - G1) * v_at_G.head<6>();
  for (std::size_t k = 0; k < 2; ++k) {
    const double power = v_at_R.dot(c.B[k] * v_at_R), energy = v_at_R.dot(c.A[k] * v_at_R);
    EXPECT_NEAR(v_at_G.dot(r.B[k] * v_at_G), power, 1e-12 * std::abs(power));
    EXPECT_NEAR(v_at_G.dot(r.A[k] * v_at_G), energy, 1e-12 * std::abs(energy));
    const auto work = (v_at_R.transpose().cast<std::complex<double>>() * c.X[1]).eval();
    EXPECT_LT(((v_at_G.transpose().cast<std::complex<double>>() * r.X[1]).eval() - work).norm(), 1e-12 * work.norm());
  }
  EXPECT_EQ(r.body[0].reference_point, G1);
}

TEST(BemioWriter, WritesNanForWhatItDoesNotKnowAndSaysSo) {
  TemporaryFolder folder;
  const auto c = froude_test::SmoothBody{}.coefficients({}, {0.5}, {0.0});
  EXPECT_THAT(write_bemio(c, folder / "c.h5"), Contains(HasSubstr("cg is NaN")));
  EXPECT_TRUE(std::isnan(hydro::io::Hdf5Reader(folder / "c.h5").numbers("/body1/properties/cg").values[0]));
}

// Capytaine's layout is dimensional: every bit passes, but for volumes nobody computes anything.
TEST(CapytaineWriter, LosesNothingThatItDoesNotTell) {
  TemporaryFolder folder;
  for (std::uint64_t seed = 1; seed <= trials; ++seed) {
    const Coefficients c = random_coefficients(seed);
    const auto told = write_capytaine(c, folder / "c.nc");
    const Coefficients r = read(folder / "c.nc");
    EXPECT_EQ(r.omega, c.omega);
    EXPECT_EQ(r.heading, c.heading);
    EXPECT_EQ(r.water.density, c.water.density);
    EXPECT_EQ(r.water.gravity, c.water.gravity);
    EXPECT_EQ(r.water.depth.metres(), c.water.depth.metres());
    expect_same_bits(r.A, c.A, "A");
    expect_same_bits(r.B, c.B, "B");
    EXPECT_EQ(r.X, c.X);
    expect_same_bits(listed(r.A_zero), listed(c.A_zero), "A_zero");
    expect_same_bits(listed(r.A_inf), listed(c.A_inf), "A_inf");
    expect_same_bits(listed(r.C), listed(c.C), "C");
    ASSERT_EQ(r.body.size(), c.body.size());
    for (std::size_t b = 0; b < c.body.size(); ++b) expect_same_body(r.body[b], c.body[b]);
    EXPECT_EQ(!c.notes.empty(), testing::Value(told, Contains(HasSubstr("notes"))));
  }
}

TEST(CapytaineWriter, GivesBodiesNamesThatTellThemApart) {
  TemporaryFolder folder;
  auto c = froude_test::SmoothBody{.bodies = 3}.coefficients({}, {0.5}, {0.0});
  c.body[0].name = c.body[1].name = "buoy";
  const auto told = write_capytaine(c, folder / "c.nc");
  EXPECT_THAT(told, ElementsAre(HasSubstr("body 2"), HasSubstr("body 3")));
  const Coefficients r = read(folder / "c.nc");
  EXPECT_EQ(r.body[0].name, "buoy");
  EXPECT_EQ(r.body[1].name, "buoy_2");
  EXPECT_EQ(r.body[2].name, "body3");
  expect_same_bits(r.A, c.A, "A");
}

TEST(CapytaineWriter, TiesVariablesToNamedAxes) {
  TemporaryFolder folder;
  write_capytaine(froude_test::SmoothBody{.bodies = 2}.coefficients({}, {0.5, 1.0, 2.0}, {0.0, 1.0}), folder / "c.nc");
  const hydro::io::NetcdfReader file(folder / "c.nc");
  EXPECT_THAT(file.axes("added_mass"), ElementsAre("omega", "influenced_dof", "radiating_dof"));
  EXPECT_THAT(file.axes("excitation_force"), ElementsAre("complex", "omega", "wave_direction", "influenced_dof"));
  EXPECT_THAT(file.axes("influenced_dof"), ElementsAre("influenced_dof"));
}

TEST(WamitWriter, KeepsAllItsDigitsAtAnyUlen) {
  TemporaryFolder folder;
  for (std::uint64_t seed = 1; seed <= trials; ++seed) {
    const Coefficients c = random_coefficients(seed);
    const double ulen = seed % 2 == 0 ? 1.0 : 7.5;
    const auto stem = folder / ("w" + std::to_string(seed));
    const auto told = write_wamit(c, stem, ulen);
    const Coefficients r = read(stem, {c.water.density, c.water.gravity, c.water.depth, ulen, 1});
    ASSERT_EQ(r.bodies(), c.bodies());
    ASSERT_EQ(r.omega.size(), c.omega.size());
    for (std::size_t k = 0; k < c.omega.size(); ++k) EXPECT_NEAR(r.omega[k], c.omega[k], roundings * c.omega[k]);
    ASSERT_EQ(r.heading.size(), c.heading.size());
    for (std::size_t h = 0; h < c.heading.size(); ++h) EXPECT_NEAR(r.heading[h], c.heading[h], 1e-15 * 4);
    EXPECT_LT(largest_relative_error(r.A, c.A), roundings);
    EXPECT_LT(largest_relative_error(r.B, c.B), 2 * roundings);  // ω of the file is off by a rounding or two
    EXPECT_LT(largest_relative_error(r.X, c.X), roundings);
    EXPECT_LT(largest_relative_error(listed(r.A_zero), listed(c.A_zero)), roundings);
    EXPECT_LT(largest_relative_error(listed(r.A_inf), listed(c.A_inf)), roundings);
    EXPECT_LT(largest_relative_error(listed(r.C), listed(c.C)), roundings);
    EXPECT_THAT(r.notes, Not(Contains(HasSubstr("disagree")))) << "modulus and phase are those of the parts";
    EXPECT_THAT(told, Contains(HasSubstr("density")));
    for (const BodyData& body : c.body) {
      EXPECT_EQ(body.reference_point.has_value(),
                testing::Value(told, Contains(HasSubstr("reference point (XBODY) of body \"" + body.name))));
      EXPECT_EQ(body.displaced_volume.has_value(),
                testing::Value(told, Contains(HasSubstr("displaced volume of body \"" + body.name))));
    }
  }
}

TEST(WamitWriter, RefusesToLeaveAnOldFileInTheSet) {
  TemporaryFolder folder;
  auto c = froude_test::SmoothBody{}.coefficients({}, {0.5, 1.0}, {0.0});
  write_wamit(c, folder / "w");
  c.heading.clear();
  c.X.clear();
  EXPECT_THAT([&] { write_wamit(c, folder / "w"); }, ThrowsMessage<InputError>(HasSubstr("w.3")));
  EXPECT_THAT([&] { write_wamit(c, folder / "v", -1); }, ThrowsMessage<InputError>(HasSubstr("ULEN must be positive")));
}

TEST(Writers, RefuseCoefficientsThatAreNotSound) {
  TemporaryFolder folder;
  auto c = froude_test::SmoothBody{}.coefficients({}, {0.5, 1.0}, {0.0});
  c.A[1](0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(write_froude(c, folder / "c.h5"), InputError);
  EXPECT_THROW(write_bemio(c, folder / "c.h5"), InputError);
  EXPECT_THROW(write_wamit(c, folder / "c"), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "c.h5"));
}

}  // namespace
}  // namespace writers_test
