#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "wamit_text.hpp"

namespace wamit_reader_test {
namespace {

using froude_test::largest_relative_error;
using froude_test::listed;
using froude_test::SmoothBody;
using froude_test::TemporaryFolder;
using froude_test::WamitText;
using hydro::InputError;
using hydro::potential::Coefficients;
using hydro::potential::read;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// Files are written with 16 significant digits: 5e-16 each, times the few operations of both sides.
constexpr double digits = 2e-14;

void expect_same_numbers(const Coefficients& c, const Coefficients& expected) {
  ASSERT_EQ(c.omega.size(), expected.omega.size());
  for (std::size_t k = 0; k < c.omega.size(); ++k)
    EXPECT_NEAR(c.omega[k], expected.omega[k], digits * expected.omega[k]);
  ASSERT_EQ(c.heading.size(), expected.heading.size());
  for (std::size_t k = 0; k < c.heading.size(); ++k) EXPECT_NEAR(c.heading[k], expected.heading[k], digits);
  EXPECT_LT(largest_relative_error(c.A, expected.A), digits);
  EXPECT_LT(largest_relative_error(c.B, expected.B), digits);
  EXPECT_LT(largest_relative_error(c.X, expected.X), digits);
  EXPECT_LT(largest_relative_error(listed(c.A_zero), listed(expected.A_zero)), digits);
  EXPECT_LT(largest_relative_error(listed(c.A_inf), listed(expected.A_inf)), digits);
  EXPECT_LT(largest_relative_error(listed(c.C), listed(expected.C)), digits);
}

class WamitFirstColumn : public ::testing::TestWithParam<int> {};

TEST_P(WamitFirstColumn, IsUnderstoodInFiniteDepthAtAnyUlen) {
  // (P9), four meanings; frequencies in no order; (P8), powers of ULEN
  for (const double ulen : {1.0, 2.5}) {
    TemporaryFolder folder;
    const WamitText text{.body = {.bodies = 2}, .ulen = ulen, .iperout = GetParam()};
    expect_same_numbers(read(text.write(folder), text.options()), text.expected());
  }
}
INSTANTIATE_TEST_SUITE_P(Iperout, WamitFirstColumn, ::testing::Values(1, 2, 3, 4));

TEST(WamitReader, TakesFinitelyDeepWavenumbersInDeepWater) {
  TemporaryFolder folder;
  WamitText text{.iperout = 4};
  text.water.depth = hydro::WaterDepth::infinite();
  expect_same_numbers(read(text.write(folder), text.options()), text.expected());
}

TEST(WamitReader, SkipsAHeaderLineAndTakesFiveColumnsAtTheLimits) {
  for (const bool header : {false, true})
    for (const bool five : {false, true}) {
      TemporaryFolder folder;
      const WamitText text{.header = header, .five_columns_at_limits = five};
      expect_same_numbers(read(text.write(folder), text.options()), text.expected());
    }
}

TEST(WamitReader, TakesAnyFileOfTheSetOrItsStem) {
  TemporaryFolder folder;
  const WamitText text;
  text.write(folder);
  for (const char* name : {"x", "x.1", "x.3", "x.hst"})
    expect_same_numbers(read(folder / name, text.options()), text.expected());
}

TEST(WamitReader, ScalesByPowersOfUlenWorkedByHand) {
  TemporaryFolder folder;
  folder.write("h.1",
               "6.0 1 1 1.0 3.0\n6.0 1 4 1.0 3.0\n6.0 4 1 1.0 3.0\n6.0 4 4 1.0 3.0\n"
               "6.0 8 8 1.0 3.0\n6.0 11 11 1.0 3.0\n6.0 8 11 1.0 3.0\n");
  folder.write("h.3", "6.0 0 3 1.0 90.0 0.0 1.0\n6.0 0 5 2.0 180.0 -2.0 0.0\n6.0 0 10 1 0 1 0\n");
  folder.write("h.hst", "3 3 1.0\n3 5 1.0\n5 5 1.0\n9 10 1\n");
  const double rho = 1000, g = 10, omega = 2 * 3.14159265358979323846 / 6;
  const auto c = read(folder / "h", {rho, g, hydro::WaterDepth::infinite(), /*ulen=*/2, 1});
  ASSERT_EQ(c.bodies(), 2);
  const auto near = [](double value, double expected) { EXPECT_NEAR(value, expected, 1e-12 * std::abs(expected)); };
  near(c.A[0](0, 0), 8 * rho);
  near(c.A[0](0, 3), 16 * rho);
  near(c.A[0](3, 3), 32 * rho);
  near(c.A[0](7, 7), 8 * rho);
  near(c.A[0](7, 10), 16 * rho);
  near(c.A[0](10, 10), 32 * rho);
  near(c.B[0](0, 0), 3 * 8 * rho * omega);
  near(c.B[0](3, 3), 3 * 32 * rho * omega);
  near(c.X[0](2, 0).imag(), 4 * rho * g);
  near(c.X[0](4, 0).real(), -2 * 8 * rho * g);
  near(c.X[0](9, 0).real(), 8 * rho * g);
  near((*c.C)(2, 2), 4 * rho * g);
  near((*c.C)(2, 4), 8 * rho * g);
  near((*c.C)(4, 4), 16 * rho * g);
  near((*c.C)(8, 9), 8 * rho * g);
  EXPECT_EQ(c.A[0](1, 1), 0) << "entries that the file leaves out are zero";
}

TEST(WamitReader, ReadsNumbersAsFortranWritesThem) {
  TemporaryFolder folder;
  folder.write("f.1", "  0.600000D+01     1     1  +0.125000D+01  1.0E-400\r\n");
  const auto c = read(folder / "f.1", {1000, 9.81, hydro::WaterDepth::infinite(), 1, 1});
  EXPECT_EQ(c.A[0](0, 0), 1250);
  EXPECT_EQ(c.B[0](0, 0), 0);
}

TEST(WamitReader, LeavesOutWhatHasNoFileAndSaysSo) {
  TemporaryFolder folder;
  const WamitText text;
  folder.write("x.1", text.radiation());
  const auto c = read(folder / "x.1", text.options());
  EXPECT_TRUE(c.heading.empty());
  EXPECT_FALSE(c.C.has_value());
  EXPECT_THAT(c.notes, Contains(HasSubstr("no excitation")));
  EXPECT_THAT(c.notes, Contains(HasSubstr("no restoring matrix")));
}

TEST(WamitReader, NotesThatPeriodsAreAssumed) {
  TemporaryFolder folder;
  const WamitText text;
  auto options = text.options();
  options.iperout.reset();
  EXPECT_THAT(read(text.write(folder), options).notes, Contains(HasSubstr("IPEROUT is not stated")));
}

// ---- a first column that is not what was assumed ----

TEST(WamitReader, RefusesFrequenciesTakenForPeriodsByTheirLimits) {
  TemporaryFolder folder;
  const WamitText text{.iperout = 2};
  folder.write("x.1", text.radiation());
  auto options = text.options();
  options.iperout.reset();
  EXPECT_THAT([&] { read(folder / "x.1", options); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("does not look like periods"), HasSubstr("state IPEROUT"))));
}

TEST(WamitReader, RefusesFrequenciesTakenForPeriodsByTheirHeaveExcitation) {
  TemporaryFolder folder;
  // The limits are written in the other way too, so that only X33 → C33 in long waves tells.
  const WamitText text{.iperout = 2, .limits_as_frequencies = true};
  auto options = text.options();
  options.iperout.reset();
  EXPECT_THAT([&] { read(text.write(folder), options); }, ThrowsMessage<InputError>(HasSubstr("heave")));
  options.iperout = 1;  // who insists is obeyed, with a note
  EXPECT_THAT(read(folder / "x.1", options).notes, Contains(HasSubstr("IPEROUT = 1 is doubtful")));
}

TEST(WamitReader, TellsTheTwoWaysOfWritingLimitsOfFrequenciesApartByContinuity) {
  for (const bool as_frequencies : {false, true}) {
    TemporaryFolder folder;
    const WamitText text{.iperout = 2, .limits_as_frequencies = as_frequencies};
    const auto c = read(text.write(folder), text.options());
    expect_same_numbers(c, text.expected());
    EXPECT_THAT(c.notes, Contains(HasSubstr("so they join the neighbouring frequencies")));
  }
}

TEST(WamitReader, RefusesALimitThatMayBeEither) {
  TemporaryFolder folder;
  folder.write("x.1", "0 1 1 15\n1.0 1 1 20 1\n2.0 1 1 10 1\n");
  EXPECT_THAT(
      [&] {
        read(folder / "x.1", {1000, 9.81, hydro::WaterDepth::infinite(), 1, 2});
      },
      ThrowsMessage<InputError>(AllOf(HasSubstr("x.1:1:1"), HasSubstr("do not tell which"), HasSubstr("IPEROUT = 1"))));
}

// ---- bad input ----

struct BadSet {
  const char* name;
  const char *radiation, *excitation, *restoring;  ///< "" for no such file
  std::vector<const char*> says;
};
// Without it GoogleTest prints the addresses inside, and the names of the tests differ from build to build.
void PrintTo(const BadSet& set, std::ostream* out) { *out << set.name; }

class WamitBadInput : public ::testing::TestWithParam<BadSet> {};

TEST_P(WamitBadInput, IsRefusedWithItsPlaceAndTheRule) {
  TemporaryFolder folder;
  const BadSet& set = GetParam();
  folder.write("b.1", set.radiation);
  if (*set.excitation) folder.write("b.3", set.excitation);
  if (*set.restoring) folder.write("b.hst", set.restoring);
  try {
    read(folder / "b.1", {1000, 9.81, hydro::WaterDepth::infinite(), 1, 1});
    FAIL() << "was accepted";
  } catch (const InputError& e) {
    for (const char* text : set.says) EXPECT_THAT(e.what(), HasSubstr(text));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Cases, WamitBadInput,
    ::testing::Values(
        BadSet{"NanInATable", "6 1 1 1 1\n5 1 1 NaN 1\n", "", "", {"b.1:2:7", "not finite"}},
        BadSet{"InfinityInATable", "6 1 1 1 Infinity\n", "", "", {"b.1:1:9", "not finite"}},
        BadSet{"AWord", "6 1 1 1 1\n5 1 one 1 1\n", "", "", {"b.1:2:5", "\"one\" is no number", "PER I J A B"}},
        BadSet{"AnOverflowedFortranField", "6 1 1 1 1\n5 1 1 ****** 1\n", "", "", {"b.1:2:7", "no number"}},
        BadSet{"ARaggedRow", "6 1 1 1 1\n5 1 1 1 1 1\n", "", "", {"b.1:2", "has 6 numbers", "4 or 5"}},
        BadSet{"NoDampingAtAFinitePeriod", "6 1 1 1 1\n5 1 1 1\n", "", "", {"b.1:2", "no damping"}},
        BadSet{"ADuplicateRow", "6 1 1 1 1\n6 1 1 1 1\n", "", "", {"b.1:2", "twice"}},
        BadSet{
            "AnEntryMissingAtOnePeriod", "6 1 1 1 1\n6 2 2 1 1\n5 1 1 1 1\n", "", "", {"b.1:3", "PER = 5", "(2, 2)"}},
        BadSet{"ModeZero", "6 0 1 1 1\n", "", "", {"b.1:1:3", "no mode number"}},
        BadSet{"ModeOneAndAHalf", "6 1.5 1 1 1\n", "", "", {"b.1:1:3", "no mode number"}},
        BadSet{"NoFinitePeriod", "0 1 1 1\n-1 1 1 1\n", "", "", {"no finite, positive period"}},
        BadSet{"TwoNegativePeriods", "-1 1 1 1\n-2 1 1 1\n5 1 1 1 1\n", "", "", {"b.1:2:1", "second negative PER"}},
        BadSet{"AnEmptyFile", "\n", "", "", {"no rows"}},
        BadSet{"APeriodOnlyInTheExcitation", "6 1 1 1 1\n", "7 0 1 1 0 1 0\n", "", {"b.3:1:1", "PER = 7", "one run"}},
        BadSet{"APeriodMissingFromTheExcitation", "6 1 1 1 1\n5 1 1 1 1\n", "6 0 1 1 0 1 0\n", "", {"b.3", "PER = 5"}},
        BadSet{"AHeadingMissingAtOnePeriod",
               "6 1 1 1 1\n5 1 1 1 1\n",
               "6 0 1 1 0 1 0\n6 90 1 1 0 1 0\n5 0 1 1 0 1 0\n",
               "",
               {"b.3", "PER = 5", "90 deg"}},
        BadSet{"ABodyOnlyInTheExcitation", "6 1 1 1 1\n", "6 0 7 1 0 1 0\n", "", {"b.3:1:5", "body 2", "has 1"}},
        BadSet{
            "ADuplicateExcitation", "6 1 1 1 1\n", "6 0 1 1 0 1 0\n6 0 1 1 0 1 0\n", "", {"b.3:2", "line 1 already"}},
        BadSet{"TwoKindsOfFirstColumn",
               "6.283185307 1 1 1 1\n2 1 1 1 1\n",
               "3.141592654 0 1 1 0 1 0\n",
               "",
               {"b.3:1:1", "2π divided by", "one IPEROUT"}},
        BadSet{"ABodyMissingFromTheExcitation",
               "6 1 1 1 1\n6 7 7 1 1\n",
               "6 0 1 1 0 1 0\n",
               "",
               {"b.3", "no row for any mode of body 2", "2 bodies"}},
        BadSet{"ABodyMissingFromTheRestoring",
               "6 1 1 1 1\n6 7 7 1 1\n",
               "",
               "3 3 1\n",
               {"b.hst", "no row of body 2", "one run"}},
        BadSet{"ABodyOnlyInTheRestoring", "6 1 1 1 1\n", "", "9 9 1\n", {"b.hst:1:1", "body 2"}},
        BadSet{"ADuplicateRestoring", "6 1 1 1 1\n", "", "3 3 1\n3 3 1\n", {"b.hst:2", "line 1 already"}}),
    [](const auto& test) { return test.param.name; });

/// Diagonal rows of `modes` modes of one body, as a run with generalised modes writes them.
std::string rows_of_modes(int modes) {
  std::string text;
  for (const double per : {6.0, 5.0})
    for (int i = 1; i <= modes; ++i) text += fmt::format("{} {} {} 1 1\n", per, i, i);
  return text;
}

/// The part of a .out file that tells of water and bodies.
std::string out_file(int bodies, const std::string& centre_of_gravity) {
  std::string text =
      " Gravity:     9.81000                Length scale:        1.00000\n Water depth:        infinite\n";
  for (int b = 1; b <= bodies; ++b)
    text += fmt::format(
        " Body number: N= {}\n XBODY =   {}.0000 YBODY =    0.0000 ZBODY =   0.0000 PHIBODY =   0.0\n"
        " Volumes (VOLX,VOLY,VOLZ):           725.0      725.0      725.0\n"
        " Center of Buoyancy (Xb,Yb,Zb):     0.250000     0.000000    -1.500000\n"
        " Center of Gravity  (Xg,Yg,Zg):     {}\n",
        b, 10 * b, centre_of_gravity);
  return text;
}

const hydro::potential::ReadOptions deep{1000, 9.81, hydro::WaterDepth::infinite(), 1, 1};

TEST(WamitReader, RefusesGeneralisedModesByName) {
  TemporaryFolder folder;
  const auto refused = [&](const std::string& place) {
    EXPECT_THAT([&] { read(folder / "g.1", deep); },
                ThrowsMessage<InputError>(AllOf(HasSubstr(place), HasSubstr("generalised"))));
  };
  folder.write("g.1", rows_of_modes(10));
  refused("g.1:10");
  // Twelve modes may be those of two bodies; the restoring matrix, or the .out file, tells that they are not.
  folder.write("g.1", rows_of_modes(12));
  EXPECT_EQ(read(folder / "g.1", deep).bodies(), 2);
  folder.write("g.hst", "3 3 1\n3 9 0.5\n9 9 1\n");
  refused("g.hst:2");
  folder.write("g.hst", "3 3 1\n7 7 0.5\n9 9 1\n");
  refused("g.hst:2");
  std::filesystem::remove(folder / "g.hst");
  folder.write("g.out", out_file(1, "0 0 -1"));
  refused("g.1:12");
}

TEST(WamitReader, TakesBodiesThatLackModesBySymmetry) {
  TemporaryFolder folder;
  folder.write("g.1", "6 3 3 1 1\n6 9 9 1 1\n");  // heave alone of two bodies
  EXPECT_EQ(read(folder / "g.1", deep).bodies(), 2);
  folder.write("g.1", rows_of_modes(11));  // the second is round, so that its yaw makes no waves
  folder.write("g.out", out_file(2, "0 0 -1"));
  EXPECT_EQ(read(folder / "g.1", deep).bodies(), 2);
}

TEST(WamitReader, TakesTheHeightAloneOfACentreOfGravity) {
  TemporaryFolder folder;
  folder.write("g.1", rows_of_modes(6));
  folder.write("g.out", out_file(1, "-0.750000"));
  const auto c = read(folder / "g.1", deep);
  EXPECT_EQ(*c.body[0].centre_of_gravity, Eigen::Vector3d(10.25, 0, -0.75)) << "above the centre of buoyancy";
  EXPECT_THAT(c.notes, Contains(HasSubstr("the height alone")));
  folder.write("g.out", out_file(1, "0.100000 0.200000 -0.750000"));
  EXPECT_EQ(*read(folder / "g.1", deep).body[0].centre_of_gravity, Eigen::Vector3d(10.1, 0.2, -0.75));
}

/// The whole of a .out file, with 16 digits of what WAMIT prints seven of; phases as it is asked to print them.
std::string printed(const WamitText& text, const char* method = "DIFFRACTION") {
  const int n = 6 * text.body.bodies;
  const double rho = text.water.density, g = text.water.gravity;
  const auto scale = [&](int i, int j) { return std::pow(text.ulen, WamitText::power(i, j)); };
  std::string out = fmt::format("  WAMIT  Version 7.2\n Gravity: {}  Length scale: {}\n Water depth: {}\n", g,
                                text.ulen, text.water.depth.metres());
  for (int b = 0; b < text.body.bodies; ++b) {
    const auto C = [&](int i, int j) {
      return fmt::format(" {:.15e}", text.body.C(6 * b + i, 6 * b + j) / (rho * g * scale(i, j) / text.ulen));
    };
    out += fmt::format(
        " XBODY = {} YBODY = 0 ZBODY = 0 PHIBODY = 0.0\n Hydrostatic and gravitational restoring coefficients:\n"
        " C(3,3),C(3,4),C(3,5):{}{}{}\n C(4,4),C(4,5),C(4,6):{}{}{}\n        C(5,5),C(5,6):{}{}\n",
        10 * b, C(2, 2), C(2, 3), C(2, 4), C(3, 3), C(3, 4), C(3, 5), C(4, 4), C(4, 5));
  }
  const auto radiation = [&](const std::string& per, const std::string& title, auto A, auto B, bool limit) {
    out += fmt::format("\n Wave period {}   Wavenumber (kL) = 1\n\n    {} COEFFICIENTS\n     I     J    A(I,J)\n\n",
                       per, title);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        out += fmt::format(" {:5d} {:5d} {:.15e}{}\n", i + 1, j + 1, A(i, j) / (rho * scale(i, j)),
                           limit ? "" : fmt::format(" {:.15e}", B(i, j) / (rho * scale(i, j))));
    out += "\n\n";
  };
  const SmoothBody& body = text.body;
  const auto none = [](int, int) { return 0.0; };
  radiation(
      "= infinite", "ADDED-MASS", [&](int i, int j) { return body.A_zero(i, j); }, none, true);
  radiation(
      "= zero", "ADDED-MASS", [&](int i, int j) { return body.A_inf(i, j); }, none, true);
  for (const double w : text.omega) {
    radiation(
        fmt::format("(sec) = {:.15e}", 2 * std::numbers::pi / w), "ADDED-MASS AND DAMPING",
        [&](int i, int j) { return body.A(i, j, w); }, [&](int i, int j) { return body.B(i, j, w) / w; }, false);
    out += fmt::format("    {} EXCITING FORCES AND MOMENTS\n", method);
    for (const double degrees : text.heading_deg) {
      out += fmt::format("\n  Wave Heading (deg) : {}\n\n     I     Mod[Xh(I)]     Pha[Xh(I)]\n\n", degrees);
      for (int i = 0; i < n; ++i) {
        const auto X = body.X(i, w, hydro::Angle::from_degrees(degrees).radians()) /
                       (rho * g * std::pow(text.ulen, i % 6 < 3 ? 2 : 3));
        out += fmt::format(" {:5d} {:.15e} {:.15e}\n", i + 1, std::abs(X),
                           hydro::Angle::from_radians(std::arg(X)).degrees());
      }
    }
    out +=
        "\n    RESPONSE AMPLITUDE OPERATORS\n\n  Wave Heading (deg) : 77\n\n     I     Mod[RAO(I)]\n\n     1  9  9\n";
  }
  return out;
}

// (P34)
TEST(WamitPrinted, IsReadByItself) {
  for (const double ulen : {1.0, 2.0}) {
    const WamitText text{.body = {.bodies = 2}, .ulen = ulen};
    TemporaryFolder folder;
    // Volumes and centres are printed for ULEN 1 alone, where the reader asks for them.
    std::string file = printed(text);
    if (ulen == 1)
      for (auto at = file.find("PHIBODY = 0.0\n"); at != std::string::npos; at = file.find("PHIBODY = 0.0\n", at + 1))
        file.insert(at + 14,
                    " Volumes (VOLX,VOLY,VOLZ): 7 7 7\n Center of Buoyancy (Xb,Yb,Zb): 0 0 -1\n Center of Gravity  "
                    "(Xg,Yg,Zg): 0 0 -2\n");
    const Coefficients c = read(folder.write("x.out", file), {text.water.density, {}, {}, {}, {}});
    Coefficients expected = text.expected();
    for (Eigen::Index i = 0; i < c.modes(); ++i)
      for (Eigen::Index j = i + 1; j < c.modes(); ++j)
        if (j % 6 < 5) (*expected.C)(j, i) = (*expected.C)(i, j);                     // the file has one triangle
    for (Eigen::Index b = 0; b < c.modes(); b += 6) (*expected.C)(b + 2, b + 5) = 0;  // C(3,6) is zero, and not printed
    expect_same_numbers(c, expected);
    EXPECT_EQ(c.body[1].reference_point->x(), 10);
    EXPECT_EQ(c.water.depth.metres(), text.water.depth.metres());
    EXPECT_THAT(c.notes, Contains(HasSubstr("whole degrees")));
  }
}

TEST(WamitPrinted, TellsWhatItLacks) {
  const WamitText text{.ulen = 2};
  TemporaryFolder folder;
  const auto options = hydro::potential::ReadOptions{text.water.density, {}, {}, {}, {}};
  EXPECT_THAT(read(folder.write("x.out", printed(text, "HASKIND")), options).notes,
              Contains(HasSubstr("from Haskind's relation")));
  EXPECT_THAT(read(folder.write("x.out", printed(text, "NO")), options).notes, Contains(HasSubstr("no excitation")));
  const std::string whole = printed(text), head = whole.substr(0, whole.find(" Wave period"));
  const auto refused = [&](const std::string& file, const char* why) {
    EXPECT_THAT([&] { read(folder.write("y.out", file), options); }, ThrowsMessage<InputError>(HasSubstr(why)));
  };
  refused(head, "no results");
  refused(head + " Wave period (sec) = 5\n nothing\n", "no added mass at this period");
  refused(head + " Wave period (sec) = 5\n ADDED-MASS\n I J A(I,J)\n\n 7 7 1 1\n", "mode 7 is one too many");
  EXPECT_THAT([&] { read(folder / "x.out"); }, ThrowsMessage<InputError>(HasSubstr("density")));
}

TEST(WamitReader, AsksForWaterThatTheFilesDoNotHold) {
  TemporaryFolder folder;
  const auto path = WamitText{}.write(folder);
  EXPECT_THAT([&] { read(path); }, ThrowsMessage<InputError>(HasSubstr("density, gravity, water depth")));
  EXPECT_THAT(
      [&] {
        read(path, {{}, 9.81, hydro::WaterDepth::infinite(), 1, {}});
      },
      ThrowsMessage<InputError>(AllOf(HasSubstr("do not hold the density\n"), HasSubstr("[water]"))));
  EXPECT_THAT(
      [&] {
        read(path, {1000, 9.81, hydro::WaterDepth::infinite(), 0.0, {}});
      },
      ThrowsMessage<InputError>(HasSubstr("ULEN must be positive")));
  EXPECT_THAT(
      [&] {
        read(path, {1000, 9.81, hydro::WaterDepth::infinite(), 1, 5});
      },
      ThrowsMessage<InputError>(HasSubstr("IPEROUT must be")));
}

TEST(WamitReader, SaysWhichFileIsMissing) {
  TemporaryFolder folder;
  const WamitText text;
  EXPECT_THAT([&] { read(folder / "nothing", text.options()); }, ThrowsMessage<InputError>(HasSubstr("no such file")));
  folder.write("only.3", text.excitation());
  EXPECT_THAT([&] { read(folder / "only.3", text.options()); }, ThrowsMessage<InputError>(HasSubstr("\"only.1\"")));
  folder.write("readme.txt", "nothing of ours");
  EXPECT_THAT([&] { read(folder / "readme.txt", text.options()); },
              ThrowsMessage<InputError>(HasSubstr("not a file of coefficients")));
  EXPECT_THAT([&] { read(folder / "", text.options()); }, ThrowsMessage<InputError>(HasSubstr("is a folder")));
}

TEST(WamitReader, NotesAPhaseThatContradictsTheParts) {
  TemporaryFolder folder;
  folder.write("p.1", "6 1 1 1 1\n");
  folder.write("p.3", "6 0 1 1.0 90.0 0.0 -1.0\n");  // the phase of e^{−iωt}
  const auto c = read(folder / "p.1", {1000, 9.81, hydro::WaterDepth::infinite(), 1, 1});
  EXPECT_LT(c.X[0](0, 0).imag(), 0);
  EXPECT_THAT(c.notes, Contains(AllOf(HasSubstr("p.3"), HasSubstr("line 1"), HasSubstr("disagree"))));
}

}  // namespace
}  // namespace wamit_reader_test
