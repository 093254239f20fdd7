// Readers of two formats that state no depth: files written here by formulas, and the two files at hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>

#include <numbers>

#include "hdb_text.hpp"
#include "hydro/base/error.hpp"
#include "hydro/potential/formats/responses.hpp"
#include "hydro/waves/dispersion.hpp"
#include "support/reference_data.hpp"
#include "veres_text.hpp"

namespace veres_hdb_test {
namespace {

using froude_test::HdbText;
using froude_test::TemporaryFolder;
using froude_test::VeresText;
using hydro::InputError;
using hydro::WaterDepth;
using namespace hydro::potential;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

constexpr double degree = std::numbers::pi / 180;

// ---- VERES ----

const ReadOptions deep{.depth = WaterDepth::infinite()};

/// +1 for heave and yaw, −1 for what a half turn about the vertical reverses.
double half_turn(int mode) { return mode % 3 == 2 ? 1 : -1; }

TEST(VeresReader, TurnsAxesAndHeadingsByAHalfTurnAndCountsPhasesFromTheOrigin) {
  TemporaryFolder folder;
  for (const bool version2 : {true, false}) {
    VeresText text;
    text.version2 = version2;
    const Coefficients c = read(text.write(folder), deep);
    EXPECT_LT((*c.body[0].reference_point - Eigen::Vector3d(-4, 0, -1)).norm(), 1e-12);
    EXPECT_LT((*c.body[0].centre_of_gravity - Eigen::Vector3d(-3, 0, 1)).norm(), 1e-12);
    EXPECT_EQ(c.omega, text.omega);
    for (std::size_t k = 0; k < 3; ++k)
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) {
          const double sign = half_turn(i) * half_turn(j);
          EXPECT_NEAR(c.A[k](i, j), sign * text.body.A(i, j, c.omega[k]), 1e-9);  // sin π = 1e-16, times 1e4
          EXPECT_NEAR(c.B[k](i, j), sign * text.body.B(i, j, c.omega[k]), 1e-9);
          EXPECT_NEAR((*c.C)(i, j), sign * text.body.C(i, j), 1e-9);
        }
    // Head sea, VERES's 0, goes to −x: our 180 degrees, or −180.
    for (std::size_t h = 0; h < 3; ++h) {
      EXPECT_NEAR(c.heading[h], (text.heading_deg[h] - 180) * degree, 1e-12);
      for (std::size_t k = 0; k < 3; ++k) {
        const double along = -4 * std::cos(c.heading[h]), w = c.omega[k];
        for (int i = 0; i < 6; ++i) {
          const auto expected =
              half_turn(i) * text.body.X(i, w, text.heading_deg[h] * degree) * std::polar(1.0, -w * w / 9.81 * along);
          EXPECT_LT(std::abs(c.X[h](i, Eigen::Index(k)) - expected), 1e-9);
        }
      }
    }
  }
}

TEST(VeresReader, RefusesWhatItCannotMean) {
  TemporaryFolder folder;
  const auto refused = [&](auto change, const char* what) {
    VeresText text;
    change(text);
    EXPECT_THAT([&] { read(text.write(folder), deep); }, ThrowsMessage<InputError>(HasSubstr(what)));
  };
  refused([](VeresText& t) { t.speed = 5; }, "forward speed of 5 m/s");
  refused([](VeresText& t) { t.trim = 1; }, "sinkage or trim");
  refused([](VeresText& t) { t.omega = {0.4, 0.4}; }, "must increase");
  const auto file = VeresText{}.write(folder);
  EXPECT_THAT([&] { read(file); }, ThrowsMessage<InputError>(HasSubstr("depth")));
  EXPECT_THAT([&] { read(file, {.depth = WaterDepth::infinite(), .ulen = 1}); },
              ThrowsMessage<InputError>(HasSubstr("ULEN")));
  VeresText other;
  other.omega = {0.4, 0.9, 1.4};
  folder.write("s.re8", other.transfer("WAVE EXCITATION FORCE TRANSFER FUNCTIONS"));
  EXPECT_THAT([&] { read(file, deep); }, ThrowsMessage<InputError>(AllOf(HasSubstr("s.re8"), HasSubstr("one run"))));
}

TEST(VeresReader, RefusesFilesThatAreCutAnywhere) {
  TemporaryFolder folder;
  const VeresText text;
  const auto file = text.write(folder);
  const std::string whole = text.re7();
  for (std::size_t size = whole.size() - 8; size > 300; size -= size / 7) {
    folder.write("s.re7", whole.substr(0, size));
    EXPECT_THROW(read(file, deep), InputError) << size;
  }
  folder.write("s.re7", whole);
  const std::string forces = text.transfer("WAVE EXCITATION FORCE TRANSFER FUNCTIONS");
  for (std::size_t size = forces.size() - 40; size > 300; size -= size / 7) {
    folder.write("s.re8", forces.substr(0, size));
    EXPECT_THROW(read(file, deep), InputError) << size;
  }
}

TEST(VeresReader, SaysWhatIsLeftOut) {
  TemporaryFolder folder;
  VeresText text;
  text.addition = 3;
  const auto file = text.write(folder);
  EXPECT_THAT(read(file, deep).notes, Contains(HasSubstr("additional")));
  std::filesystem::remove(folder / "s.re8");
  const Coefficients c = read(file, deep);
  EXPECT_TRUE(c.X.empty());
  EXPECT_THAT(c.notes, Contains(HasSubstr("no excitation: there is no s.re8")));
}

/// VERES's supply ship, its mass matrix (lines 12 to 17) turned into our axes.
Eigen::MatrixXd supply_mass() {
  const double m = 6.3622085e6, mz = 8.2708705e6;
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(6, 6);
  M.diagonal() << m, m, m, 2.9805926e8, 2.7368950e9, 2.7261430e9;
  M(0, 4) = M(4, 0) = mz;
  M(1, 3) = M(3, 1) = -mz;
  return M;
}

// Loads of one file and motions of another, both turned and translated, still obey one equation of motion.
TEST(SupplyShip, MovesAsVeresSaysItDoes) {
  FROUDE_REQUIRE_DATA(folder, "mss_supply_shipx");
  const Coefficients c = read(folder / "input.re7", deep);
  const RaoTable rao = read_rao(folder / "input.re1");
  EXPECT_NEAR(c.body[0].centre_of_gravity->z(), 1.3, 1e-6);
  ASSERT_EQ(c.heading.size(), 19u);
  int compared = 0;
  for (std::size_t h = 0; h < 19; ++h)
    for (std::size_t k = 0; k < c.omega.size(); ++k) {
      EXPECT_NEAR(rao.heading[h], c.heading[h], 1e-12);
      const double w = c.omega[k], along = -5.38592 * std::cos(c.heading[h]);
      // Sway, roll and yaw have viscous damping in VERES, which is not read: heave and pitch, coupled to surge alone.
      const std::vector<int> plane{0, 2, 4};
      const Eigen::MatrixXcd Z = (-w * w * (supply_mass() + c.A[k]) + *c.C) + std::complex<double>(0, w) * c.B[k];
      const Eigen::VectorXcd X = c.X[h].col(Eigen::Index(k))(plane);
      const Eigen::VectorXcd xi = Eigen::MatrixXcd(Z(plane, plane)).partialPivLu().solve(X) *
                                  std::polar(1.0, w * w / 9.81 * along);  // motions: phases from the point of motions
      const Eigen::VectorXcd told = rao.motion[h].col(Eigen::Index(k))(plane);
      // VERES computes with seven digits; surge, which nothing holds back, loses most of them, resonance some.
      const Eigen::Vector3d limit(2e-4, 1e-5, 1e-6);
      for (Eigen::Index i = 0; i < 3; ++i) EXPECT_LT(std::abs(xi(i) - told(i)), limit(i)) << h << ' ' << w;
      ++compared;
    }
  EXPECT_EQ(compared, 19 * 36);
}

// (P2), (P21): long waves lift the ship with the surface above its waterplane and push it along β.
TEST(SupplyShip, IsLiftedAndPushedByLongWaves) {
  FROUDE_REQUIRE_DATA(folder, "mss_supply_shipx");
  const Coefficients c = read(folder / "input.re7", deep);
  const double k = c.omega[1] * c.omega[1] / 9.81, C33 = (*c.C)(2, 2);
  const double flotation = c.body[0].reference_point->x() - (*c.C)(2, 4) / C33;
  EXPECT_NEAR(flotation, -5.386 - 5.085, 1e-3);
  for (std::size_t h = 0; h < c.heading.size(); ++h) {
    // The next terms, −ω²A33 and what the draught takes from the pressure, are 6 % and 3 % at 0.21 rad/s.
    EXPECT_NEAR(std::abs(c.X[h](2, 1)) / C33, 1, 0.1);
    // Terms that do not depend on where the waterplane is are the same for waves that go the other way.
    const std::complex<double> there_and_back = c.X[h](2, 1) / c.X[c.heading.size() - 1 - h](2, 1);
    EXPECT_NEAR(std::arg(there_and_back), -2 * k * flotation * std::cos(c.heading[h]), 2e-3);
    EXPECT_GT((c.X[h](0, 1) * std::cos(c.heading[h]) + c.X[h](1, 1) * std::sin(c.heading[h])).imag(), 0);
  }
}

// Short waves are thrown back: ½ρg a² on each metre of a wall across their way.
TEST(SupplyShip, IsPushedByShortBeamWavesAsAWallIs) {
  FROUDE_REQUIRE_DATA(folder, "mss_supply_shipx");
  const DriftForces drift = read_drift(folder / "input.re2");
  EXPECT_THAT(drift.mode, ::testing::ElementsAre(0, 1, 5));
  for (std::size_t h = 0; h < drift.heading.size(); ++h) {
    if (std::abs(drift.heading[h][0] + 90 * degree) > 1e-9) continue;
    const double sway = drift.load[h](1, drift.load[h].cols() - 1).real();
    EXPECT_LT(sway, 0) << "beam waves that go to starboard push there";
    EXPECT_NEAR(-sway / (0.5 * 1025 * 9.81 * 82.8), 1, 0.35);  // an end of the ship is no wall
  }
  const auto last = drift.load.front().cols() - 1;
  EXPECT_LT(drift.load.front()(0, last).real(), 0) << "head waves push aft";
}

// ---- HDB ----

const ReadOptions sea{.density = 1025, .gravity = 9.81, .depth = WaterDepth::from_metres(60)};

TEST(HdbReader, ReadsRowsForLoadsAndTurnsPhasesRound) {
  TemporaryFolder folder;
  const HdbText text;
  const Coefficients c = read(folder.write("b.hdb", text.text()), sea);
  const auto expected = text.body.coefficients(
      {1025, 9.81, WaterDepth::from_metres(60)},
      {2 * std::numbers::pi / 16, 2 * std::numbers::pi / 8, 2 * std::numbers::pi / 4}, {0, 90 * degree});
  EXPECT_EQ(froude_test::largest_relative_error(c.A, expected.A), 0);
  EXPECT_EQ(froude_test::largest_relative_error(c.B, expected.B), 0);
  EXPECT_EQ(froude_test::largest_relative_error(std::vector{*c.C}, std::vector{*expected.C}), 0);
  EXPECT_LT(froude_test::largest_relative_error(c.X, expected.X), 1e-14);  // modulus, phase and back
  EXPECT_EQ(c.body[0].name, "buoy 1");
  EXPECT_EQ(*c.body[0].displaced_volume, 12);
  EXPECT_EQ(*c.body[0].reference_point, Eigen::Vector3d(1, 2, -1));
}

HdbText two_structures() {
  HdbText text;
  text.body.bodies = text.structures = 2;
  return text;
}

TEST(HdbReader, CouplesStructuresByLoadsOnTheOneBehindOn) {
  TemporaryFolder folder;
  HdbText text = two_structures();
  const Coefficients c = read(folder.write("b.hdb", text.text()), sea);
  const auto expected = text.body.coefficients(
      {1025, 9.81, WaterDepth::from_metres(60)},
      {2 * std::numbers::pi / 16, 2 * std::numbers::pi / 8, 2 * std::numbers::pi / 4}, {0, 90 * degree});
  ASSERT_EQ(c.bodies(), 2);
  EXPECT_EQ(froude_test::largest_relative_error(c.A, expected.A), 0);
  EXPECT_EQ(froude_test::largest_relative_error(c.B, expected.B), 0);
  EXPECT_EQ(froude_test::largest_relative_error(std::vector{*c.C}, std::vector{*expected.C}), 0);
  EXPECT_LT(froude_test::largest_relative_error(c.X, expected.X), 1e-14);  // modulus, phase and back
  EXPECT_EQ(*c.body[1].displaced_volume, 13);
  EXPECT_EQ(*c.body[1].reference_point, Eigen::Vector3d(21, 2, -1));

  text.is_coupled = false;
  const Coefficients alone = read(folder.write("b.hdb", text.text()), sea);
  EXPECT_THAT(alone.notes, testing::Contains(HasSubstr("couples no structures")));
  EXPECT_EQ(alone.A[0].topRightCorner(6, 6).norm(), 0);
  EXPECT_EQ(alone.A[0].bottomRightCorner(6, 6), c.A[0].bottomRightCorner(6, 6));
}

TEST(HdbReader, RefusesStructuresOfWhichItCannotTellPlaceOrCoupling) {
  TemporaryFolder folder;
  const auto refused = [&](const std::string& text, const char* what) {
    EXPECT_THAT([&] { read(folder.write("b.hdb", text), sea); }, ThrowsMessage<InputError>(HasSubstr(what)));
  };
  HdbText same = two_structures();
  same.apart = 0;
  refused(same.text(), "does not say where its structures stand");
  const std::string whole = two_structures().text();
  refused(whole.substr(0, whole.rfind("[HYDRODYNAMIC")), "buoy 2 [ON] buoy 1");
  std::string twice = whole;
  refused(twice + whole.substr(whole.rfind("[HYDRODYNAMIC")), "stands twice");
  std::string gap = whole;
  gap.replace(gap.find("[STRUCTURE_02]"), 14, "[STRUCTURE_03]");
  refused(gap, "stands where structure 2 should");
}

/// As AQUA+ writes it: blanks before the names, one structure in the head, parts of the excitation under one name each.
std::string by_aqua(const HdbText& text) {
  std::string all = text.text();
  const auto cut = [&](const std::string& from, const std::string& to) {
    all.erase(all.find(from), all.find(to) - all.find(from));
  };
  cut("[STRUCTURES_NUMBER]", "[Hydrostatic_matrix]");
  cut("[EXCITATION", "[ADDED_MASS_LINE_1]");
  all += "[FROUDE-KRYLOV_FORCES_AND_MOMENTS]\n[INCIDENCE_EFM_MOD_001] 0.0\n[INCIDENCE_EFM_MOD_001] 90.0\n";
  std::string out;
  for (const char character : all) out += character == '[' ? std::string(" [") : std::string(1, character);
  return out;
}

TEST(HdbReader, ReadsTheOneStructureOfAquaPlus) {
  TemporaryFolder folder;
  const HdbText text;
  const Coefficients c = read(folder.write("a.hdb", by_aqua(text)), sea);
  const auto expected =
      text.body.coefficients({1025, 9.81, WaterDepth::from_metres(60)},
                             {2 * std::numbers::pi / 16, 2 * std::numbers::pi / 8, 2 * std::numbers::pi / 4}, {});
  EXPECT_EQ(froude_test::largest_relative_error(c.A, expected.A), 0);
  EXPECT_EQ(froude_test::largest_relative_error(c.B, expected.B), 0);
  EXPECT_EQ(froude_test::largest_relative_error(std::vector{*c.C}, std::vector{*expected.C}), 0);
  EXPECT_TRUE(c.X.empty());
  EXPECT_FALSE(c.body[0].displaced_volume || c.body[0].reference_point);
  EXPECT_THAT(c.notes, testing::Contains(HasSubstr("no excitation: the file has [FROUDE-KRYLOV")));
}

TEST(HdbOutsideData, OfAquaPlusIsReadAsItStands) {
  FROUDE_REQUIRE_DATA(file, "ecn_roll_decay/test_ship.hdb");
  const Coefficients c = read(file, sea);
  ASSERT_EQ(c.omega.size(), 6u);
  EXPECT_NEAR((*c.C)(3, 3), 1.786686e6, 1);
  EXPECT_NEAR(c.A[0](3, 3), 2.611223e5, 0.1);  // line 4 of the added mass at 4 s, its longest period; seven digits
}

TEST(HdbReader, RefusesWhatItDoesNotKnow) {
  TemporaryFolder folder;
  const auto refused = [&](const std::string& text, const ReadOptions& options, const char* what) {
    EXPECT_THAT([&] { read(folder.write("b.hdb", text), options); }, ThrowsMessage<InputError>(HasSubstr(what)));
  };
  refused(HdbText{}.text(), {}, "density, gravity and depth");
  HdbText text;
  text.structures = 2;
  refused(text.text(), sea, "sections of 1 structures, not of 2");
  text = {};
  text.speed = 1;
  refused(text.text(), sea, "forward speed");
  const std::string whole = HdbText{}.text();
  for (std::size_t size = whole.size() - 30; size > 400; size -= size / 9)
    EXPECT_THROW(read(folder.write("b.hdb", whole.substr(0, size)), sea), InputError) << size;
}

// (P2), (P21), and the damping's share of the lift settle sign and origin of the phases: (P27).
TEST(HdbOutsideData, IsLiftedAndPushedByLongWavesAndLeadsByItsDamping) {
  FROUDE_REQUIRE_DATA(file, "bem_formats/bemrosetta_gpl/diodore/Sample.hdb");
  const Coefficients c = read(file, sea);
  ASSERT_EQ(c.heading.size(), 25u);
  ASSERT_EQ(c.omega.size(), 33u);
  const double w = c.omega.front(), C33 = (*c.C)(2, 2);
  for (std::size_t h = 0; h < c.heading.size(); ++h) {
    const auto lift = c.X[h](2, 0);
    // Next term of long waves: C33 − ω²A33 + iωB33, and half a per cent for what comes after it.
    EXPECT_NEAR(lift.real(), C33 - w * w * c.A[0](2, 2), 0.02 * C33);
    EXPECT_NEAR(lift.imag(), w * c.B[0](2, 2), 0.05 * w * c.B[0](2, 2));
    const auto push = c.X[h](0, 0) * std::cos(c.heading[h]) + c.X[h](1, 0) * std::sin(c.heading[h]);
    EXPECT_GT(push.imag(), 0.9 * std::abs(push));
  }
}

}  // namespace
}  // namespace veres_hdb_test
