#include "hydro/potential/formats/responses.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>

#include <numbers>

#include "hydro/base/error.hpp"
#include "support/reference_data.hpp"
#include "wamit_text.hpp"

namespace responses_test {
namespace {

using froude_test::TemporaryFolder;
using hydro::InputError;
using namespace hydro::potential;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double degree = std::numbers::pi / 180;

std::string row(std::initializer_list<double> keys, std::complex<double> value) {
  std::string text;
  for (const double key : keys) text += fmt::format("{:.15g} ", key);
  return text + fmt::format("{:.15g} {:.15g} {:.15g} {:.15g}\n", std::abs(value), std::arg(value) / degree,
                            value.real(), value.imag());
}

// (P24): rotations are per A/L, so a number in the file is L times what we hold.
TEST(WamitMotions, ArePerMetreOfAmplitude) {
  TemporaryFolder folder;
  const std::complex<double> heave(0.9, 0.1), pitch(0.02, -0.03);
  const auto file = folder.write("x.4", row({10, 45, 3}, heave) + row({10, 45, 5}, 7.0 * pitch) +
                                            row({5, 45, 3}, heave / 2.0) + row({5, 45, 5}, 3.5 * pitch));
  const RaoTable rao = read_rao(file, {.ulen = 7});
  EXPECT_THAT(rao.mode, ElementsAre(2, 4));
  EXPECT_NEAR(rao.omega[0], 2 * std::numbers::pi / 10, 1e-15);
  EXPECT_NEAR(rao.heading[0], 45 * degree, 1e-15);
  EXPECT_LT(std::abs(rao.motion[0](0, 0) - heave), 1e-14);
  EXPECT_LT(std::abs(rao.motion[0](1, 1) - pitch / 2.0), 1e-15);
}

TEST(WamitMotions, NeedNoWaterForPeriodsAndFrequencies) {
  TemporaryFolder folder;
  const auto file = folder.write("x.4", row({2, 0, 3}, 0.1));
  EXPECT_DOUBLE_EQ(read_rao(file, {.iperout = 2}).omega[0], 2);
  EXPECT_THAT([&] { read_rao(file, {.iperout = 3}); }, ThrowsMessage<InputError>(HasSubstr("gravity")));
  EXPECT_NEAR(read_rao(file, {.gravity = 9.0, .ulen = 2, .iperout = 3}).omega[0], 3, 1e-15);  // sqrt(2·9/2)
}

TEST(WamitMotions, AreRefusedIfAPlaceIsEmptyOrFilledTwice) {
  TemporaryFolder folder;
  const auto hole = folder.write("h.4", row({10, 0, 3}, 1) + row({10, 90, 3}, 1) + row({5, 0, 3}, 1));
  EXPECT_THAT([&] { read_rao(hole); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("h.4"), HasSubstr("heading 90"), HasSubstr("mode 3"))));
  const auto twice = folder.write("t.4", row({10, 0, 3}, 1) + row({10, 0, 3}, 1));
  EXPECT_THAT([&] { read_rao(twice); }, ThrowsMessage<InputError>(AllOf(HasSubstr("t.4:2"), HasSubstr("line 1"))));
  const auto cut = folder.write("c.4", row({10, 0, 3}, 1) + "5 0 3 1\n");
  EXPECT_THAT([&] { read_rao(cut); }, ThrowsMessage<InputError>(AllOf(HasSubstr("c.4:2"), HasSubstr("has 4 numbers"))));
}

// (P25): a body that follows long waves moves along β a quarter of a period after it rises.
TEST(WamitMotions, AreRefusedIfLongWavesMoveBodiesTheWrongWay) {
  TemporaryFolder folder;
  const std::complex<double> lag(0, -1);
  const auto ours = folder.write("a.4", row({30, 0, 1}, lag) + row({30, 0, 3}, 0.99));
  const auto others = folder.write("b.4", row({30, 0, 1}, -lag) + row({30, 0, 3}, 0.99));
  const auto away = folder.write("c.4", row({30, 180, 1}, -lag) + row({30, 180, 3}, 0.99));
  EXPECT_NO_THROW(read_rao(ours));
  EXPECT_THAT([&] { read_rao(others); }, ThrowsMessage<InputError>(HasSubstr("other time factor")));
  EXPECT_NO_THROW(read_rao(away));
}

TEST(WamitDrift, IsScaledByPowersOfUlenWorkedByHand) {
  TemporaryFolder folder;
  const hydro::potential::ReadOptions options{.density = 1000, .gravity = 10, .ulen = 2};
  const auto text =
      row({10, 0, 0, 1}, 0.5) + row({10, 0, 0, 6}, 0.25) + row({10, 0, 90, 1}, {0.5, 1}) + row({10, 0, 90, 6}, {0, -1});
  for (const char* extension : {".7", ".8", ".9"}) {
    const DriftForces drift = read_drift(folder.write(std::string("x") + extension, text), options);
    ASSERT_EQ(drift.heading.size(), 2u);
    EXPECT_NEAR(drift.load[0](0, 0).real(), 0.5 * 1000 * 10 * 2, 1e-9);
    EXPECT_NEAR(drift.load[0](1, 0).real(), 0.25 * 1000 * 10 * 4, 1e-9);
    EXPECT_NEAR(drift.heading[1][1], 90 * degree, 1e-15);
    EXPECT_NEAR(drift.load[1](0, 0).imag(), 1 * 1000 * 10 * 2, 1e-9);
  }
  EXPECT_EQ(read_drift(folder / "x.8", options).method, "momentum");
  EXPECT_THAT([&] { read_drift(folder / "x.8"); }, ThrowsMessage<InputError>(HasSubstr("density, gravity")));
}

// (P24): the half that a file leaves out follows from the half it has.
TEST(WamitQuadraticLoads, CompleteTheOtherHalfOfTheTable) {
  TemporaryFolder folder;
  const hydro::potential::ReadOptions options{.density = 1, .gravity = 1};
  const std::complex<double> F(3, 4), D(5, 0);
  const std::string text = row({10, 5, 0, 90, 2}, F) + row({10, 10, 0, 0, 2}, D) + row({5, 5, 0, 0, 2}, D);
  const QuadraticLoads difference = read_quadratic(folder.write("x.12d", text), options),
                       sum = read_quadratic(folder.write("x.12s", text), options);
  EXPECT_FALSE(difference.is_sum);
  EXPECT_TRUE(sum.is_sum);
  // Pairs of headings: (0, 0), (0, 90), (90, 0); frequencies: periods 10 and 5.
  ASSERT_EQ(difference.heading.size(), 3u);
  EXPECT_EQ(difference.load[1][0](0, 1), F);
  EXPECT_EQ(difference.load[2][0](1, 0), std::conj(F));
  EXPECT_EQ(sum.load[2][0](1, 0), F);
  EXPECT_TRUE(difference.known[2][0](1, 0));
  EXPECT_FALSE(difference.known[2][0](0, 1));
  EXPECT_EQ(difference.load[0][0](0, 0), D);
  EXPECT_THAT(
      [&] {
        read_quadratic(folder.write("y.12d", text + row({10, 5, 0, 90, 2}, F)), options);
      },
      ThrowsMessage<InputError>(AllOf(HasSubstr("y.12d:4"), HasSubstr("line 1"))));
  // A file that has both halves is believed in both.
  const auto whole = read_quadratic(folder.write("z.12d", text + row({5, 10, 90, 0, 2}, F)), options);
  EXPECT_EQ(whole.load[2][0](1, 0), F);
}

// ---- outside data ----

TEST(FpsoMotions, AreThoseOfItsCoefficients) {
  FROUDE_REQUIRE_DATA(folder, "mss_fpso");
  const Coefficients c = read(folder / "fpso.1", {1025, 9.81, hydro::WaterDepth::infinite()});
  const RaoTable rao = read_rao(folder / "fpso.4");
  ASSERT_EQ(rao.heading.size(), 19u);
  const double m = 1025 * 97960.9, zg = -1;  // of the data's README
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(6, 6);
  M.diagonal() << m, m, m, m * 16.3 * 16.3, m * 54 * 54, m * 54 * 54;
  M(0, 4) = M(4, 0) = m * zg;
  M(1, 3) = M(3, 1) = -m * zg;
  // What the README found for an independent solution between 5 and 25 s.
  const Eigen::VectorXd limit = (Eigen::VectorXd(6) << 0.0052, 0.0037, 0.033, 3.8e-4, 8.3e-4, 1.7e-4).finished();
  int compared = 0;
  for (std::size_t k = 0; k < rao.omega.size(); ++k) {
    const double w = rao.omega[k], period = 2 * std::numbers::pi / w;
    const auto at = std::find_if(c.omega.begin(), c.omega.end(), [&](double v) { return std::abs(v - w) < 1e-5 * w; });
    if (period < 5 || period > 25 || at == c.omega.end()) continue;
    const auto j = static_cast<std::size_t>(at - c.omega.begin());
    const Eigen::MatrixXcd Z = (-w * w * (M + c.A[j]) + *c.C) + std::complex<double>(0, w) * c.B[j];
    for (std::size_t h = 0; h < rao.heading.size(); ++h) {
      const Eigen::VectorXcd xi = Z.partialPivLu().solve(c.X[h].col(static_cast<Eigen::Index>(j)));
      const Eigen::VectorXd off = (xi - rao.motion[h].col(static_cast<Eigen::Index>(k))).cwiseAbs();
      for (Eigen::Index i = 0; i < 6; ++i) EXPECT_LE(off(i), 1.05 * limit(i)) << period << " s, mode " << i + 1;
      ++compared;
    }
  }
  EXPECT_GT(compared, 300);
}

TEST(OddMotions, OfOneModeOfTheSecondBodyAreThatMode) {
  FROUDE_REQUIRE_DATA(file, "bem_formats/bemrosetta_gpl/wamit_odd/only_RAO.4");
  const RaoTable rao = read_rao(file);
  EXPECT_THAT(rao.mode, ElementsAre(8));
  EXPECT_NEAR(rao.omega.front(), 2 * std::numbers::pi / 20, 1e-6);
}

}  // namespace
}  // namespace responses_test
