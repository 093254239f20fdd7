// The doctor of coefficients: sound data pass without a word, and each of many ways to spoil them is named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>

#include "example.hpp"
#include "hydro/base/error.hpp"
#include "hydro/cylinders/solve.hpp"
#include "hydro/potential/doctor/check.hpp"
#include "hydro/potential/operations/operations.hpp"
#include "hydro/potential/operations/transformations.hpp"
#include "support/reference_data.hpp"

namespace doctor_test {
namespace {

using froude_test::example;
using hydro::potential::check;
using hydro::potential::Coefficients;
using hydro::potential::Finding;
using hydro::potential::Severity;
using ::testing::HasSubstr;

/// Two boxes in a row along x, four headings from 0 to 90 degrees, deep water.
const Coefficients& boxes() {
  static const Coefficients c = example("box2.nc");
  return c;
}
/// A pontoon, headings of 0, 45 and 90 degrees, 14 m of water.
const Coefficients& pontoon() {
  static const Coefficients c = example("pontoon1.nc");
  return c;
}
/// The same for headings all round.
const Coefficients& pontoon_all_round() {
  using hydro::potential::completed_by_symmetry, hydro::potential::MirrorPlane;
  static const Coefficients c =
      completed_by_symmetry(completed_by_symmetry(pontoon(), MirrorPlane::y0), MirrorPlane::x0);
  return c;
}
/// A hemisphere, one heading, deep water.
const Coefficients& hemisphere() {
  static const Coefficients c = example("hemisphere_r5.nc");
  return c;
}

// --- ways to spoil ---------------------------------------------------------------------------------------------

void for_each(Coefficients& c, const std::function<void(Eigen::MatrixXd&)>& change) {
  for (auto* list : {&c.A, &c.B})
    for (auto& m : *list) change(m);
  if (c.A_zero) change(*c.A_zero);
  if (c.A_inf) change(*c.A_inf);
}

void keep_frequencies(Coefficients& c, std::size_t from, std::size_t to) {
  const auto cut = [&](auto& list) {
    list = {list.begin() + static_cast<long>(from), list.begin() + static_cast<long>(to)};
  };
  cut(c.omega);
  cut(c.A);
  cut(c.B);
  for (auto& X : c.X)
    X = Eigen::MatrixXcd(X.middleCols(static_cast<Eigen::Index>(from), static_cast<Eigen::Index>(to - from)));
}

/// As if lengths had been made dimensional with f times the right ULEN (P8).
void scale_lengths(Coefficients& c, double f) {
  const auto rotations = [](Eigen::Index i) { return i % 6 < 3 ? 0 : 1; };
  const auto scale = [&](Eigen::MatrixXd& m, int power) {
    for (Eigen::Index i = 0; i < m.rows(); ++i)
      for (Eigen::Index j = 0; j < m.cols(); ++j) m(i, j) *= std::pow(f, power + rotations(i) + rotations(j));
  };
  for_each(c, [&](Eigen::MatrixXd& m) { scale(m, 3); });
  scale(*c.C, 2);
  for (auto& X : c.X)
    for (Eigen::Index i = 0; i < X.rows(); ++i) X.row(i) *= std::pow(f, 2 + rotations(i));
}

void exchange_bodies_of_X(Coefficients& c) {
  for (auto& X : c.X)
    X = Eigen::MatrixXcd((Eigen::MatrixXcd(12, X.cols()) << X.bottomRows(6), X.topRows(6)).finished());
}

/// Everything of body 1 under the name of body 2, at its place, and the other way round.
void exchange_bodies(Coefficients& c) {
  const auto exchange = [](Eigen::MatrixXd& m) {
    m = Eigen::MatrixXd((Eigen::MatrixXd(12, 12) << m.bottomRightCorner(6, 6), m.bottomLeftCorner(6, 6),
                         m.topRightCorner(6, 6), m.topLeftCorner(6, 6))
                            .finished());
  };
  for_each(c, exchange);
  exchange(*c.C);
  exchange_bodies_of_X(c);
}

void phases_in_degrees_as_radians(Coefficients& c) {
  for (auto& X : c.X)
    X = X.unaryExpr(
        [](const std::complex<double>& x) { return std::polar(std::abs(x), std::arg(x) * 180 / std::numbers::pi); });
}

void move_restoring_matrix(Coefficients& c, const Eigen::Vector3d& way) {
  const hydro::potential::Matrix6 T = hydro::potential::rigid_shift(way);
  const Eigen::MatrixXd C = c.C->topLeftCorner(6, 6);
  c.C->topLeftCorner(6, 6) = T.transpose() * C * T;
}

struct Corruption {
  const char* name;   ///< what was done, CamelCase
  const char* check;  ///< the check that must find it
  Severity at_least;  ///< and how grave it must be
  const Coefficients& (*sound)();
  std::function<void(Coefficients&)> spoil;
};

void PrintTo(const Corruption& c, std::ostream* out) { *out << c.name << " -> " << c.check; }

constexpr Severity error = Severity::error, warning = Severity::warning;

const std::vector<Corruption>& corruptions() {
  static const std::vector<Corruption> list{
      {"OneEntryOfAHasTheOtherSign", "symmetry of A", error, boxes,
       [](Coefficients& c) {
         for (auto& A : c.A) A(0, 4) *= -1;
       }},
      {"OneEntryOfBHasTheOtherSign", "symmetry of B", error, boxes,
       [](Coefficients& c) {
         for (auto& B : c.B) B(1, 3) *= -1;
       }},
      {"OneBlockBetweenBodiesIsTransposed", "reciprocity of A", error, boxes,
       [](Coefficients& c) {
         for (auto& A : c.A) A.topRightCorner(6, 6).transposeInPlace();
       }},
      {"OneBlockOfDampingBetweenBodiesIsZero", "reciprocity of B", error, boxes,
       [](Coefficients& c) {
         for (auto& B : c.B) B.topRightCorner(6, 6).setZero();
       }},
      {"PhasesAreOfTheOtherTimeFactor", "surge and sway in long waves", error, hemisphere,
       [](Coefficients& c) {
         for (auto& X : c.X) X = X.conjugate().eval();
       }},
      {"PhasesOfTwoBodiesAreOfTheOtherTimeFactor", "surge and sway in long waves", error, boxes,
       [](Coefficients& c) {
         for (auto& X : c.X) X = X.conjugate().eval();
       }},
      {"PhasesInDegreesAreTakenAsRadians", "surge and sway in long waves", error, boxes, phases_in_degrees_as_radians},
      {"ABAreForFreshWaterOfDensityOne", "Haskind relation", error, hemisphere,
       [](Coefficients& c) { for_each(c, [](Eigen::MatrixXd& m) { m /= 1000; }); }},
      {"AIsInTonnesAndBInKilogrammes", "Kramers-Kronig", error, hemisphere,
       [](Coefficients& c) {
         for (auto& A : c.A) A /= 1000;
         *c.A_zero /= 1000;
         *c.A_inf /= 1000;
       }},
      {"AIsInTonnesForAKnownVolume", "added mass and volume", error, boxes,
       [](Coefficients& c) {
         for (auto& A : c.A) A /= 1000;
         *c.A_zero /= 1000;
         *c.A_inf /= 1000;
       }},
      {"DensityIsInTonnes", "waterplane and volume", error, boxes, [](Coefficients& c) { c.water.density /= 1000; }},
      {"LengthScaleIsTwiceTooLarge", "Haskind relation", error, hemisphere,
       [](Coefficients& c) { scale_lengths(c, 2); }},
      {"LengthScaleIsTwiceTooLargeForTwoBodies", "Haskind relation", error, boxes,
       [](Coefficients& c) { scale_lengths(c, 2); }},
      {"ExcitationOfTheBodiesIsExchanged", "place of the bodies", error, boxes, exchange_bodies_of_X},
      {"BodiesAreExchangedAltogether", "place of the bodies", error, boxes, exchange_bodies},
      {"OneValueIsASpike", "spikes", warning, boxes,
       [](Coefficients& c) {
         c.A[20](2, 2) *= 1.4;
         c.B[20](2, 2) *= 1.4;
       }},
      {"OneValueOfBIsWrong", "spikes", error, hemisphere, [](Coefficients& c) { c.B[12](2, 2) *= 2; }},
      {"OneLoadIsWrong", "spikes", error, pontoon, [](Coefficients& c) { c.X[0](2, 8) *= 3; }},
      {"OneLoadOfOneHeadingIsWrong", "spikes", error, hemisphere, [](Coefficients& c) { c.X[0](2, 12) *= 2; }},
      {"TheLoadsOfOneFrequencyAreWrong", "spikes", warning, pontoon,
       [](Coefficients& c) {
         for (auto& X : c.X) X(2, 8) *= 0.6;
       }},
      {"TheTableEndsAtThePeakOfDamping", "high-frequency tail", warning, hemisphere,
       [](Coefficients& c) { keep_frequencies(c, 0, 14); }},
      {"TheTableBeginsLate", "low-frequency tail", warning, hemisphere,
       [](Coefficients& c) { keep_frequencies(c, 8, c.omega.size()); }},
      {"FirstAndLastHeadingAreExchanged", "surge and sway in long waves", error, boxes,
       [](Coefficients& c) { std::swap(c.X.front(), c.X.back()); }},
      {"HeadingsAreWhereWavesComeFrom", "surge and sway in long waves", error, hemisphere,
       [](Coefficients& c) { c.heading.front() = std::numbers::pi; }},
      {"RestoringLacksGravity", "heave in long waves", error, boxes, [](Coefficients& c) { *c.C /= c.water.gravity; }},
      {"RestoringIsZeroInHeave", "restoring matrix", error, boxes, [](Coefficients& c) { (*c.C)(8, 8) = 0; }},
      {"RestoringHasOneWrongSign", "restoring matrix", error, boxes,
       [](Coefficients& c) {
         move_restoring_matrix(c, {1, 0, 0});
         (*c.C)(2, 4) *= -1;
       }},
      {"RestoringIsAboutAnotherPoint", "moments in long waves", error, boxes,
       [](Coefficients& c) {
         move_restoring_matrix(c, {1, 0, 0});
       }},
      {"RestoringKnowsNoWeight", "waterplane and volume", warning, boxes,
       [](Coefficients& c) {  // without −W z_G, and with the centre of gravity four draughts down
         for (auto& b : c.body) b.centre_of_gravity->z() = -1.2;
       }},
      {"ReferencePointIsElsewhere", "place of the bodies", error, hemisphere,
       [](Coefficients& c) { c.body[0].reference_point->x() += 10; }},
      {"AAndBAreExchanged", "Kramers-Kronig", error, hemisphere, [](Coefficients& c) { std::swap(c.A, c.B); }},
      {"FrequenciesAreInReverse", "Kramers-Kronig", error, hemisphere,
       [](Coefficients& c) {
         std::reverse(c.A.begin(), c.A.end());
         std::reverse(c.B.begin(), c.B.end());
       }},
      {"OneFrequencyIsThereUnderAnotherName", "repeated frequency", error, boxes,
       [](Coefficients& c) {
         c.A[31] = c.A[30];
         c.B[31] = c.B[30];
       }},
      {"DampingBetweenBodiesHasTheOtherSign", "Haskind relation", error, boxes,
       [](Coefficients& c) {
         for (auto& B : c.B) {
           B.topRightCorner(6, 6) *= -1;
           B.bottomLeftCorner(6, 6) *= -1;
         }
       }},
      {"DampingOfTranslationsHasTheOtherSign", "passivity of B", error, boxes,
       [](Coefficients& c) {
         for (auto& B : c.B) B.topLeftCorner(3, 3) *= -1;
       }},
      {"DampingOfOneModeHasTheOtherSign", "sign of B", error, hemisphere,
       [](Coefficients& c) {
         for (auto& B : c.B) B(2, 2) *= -1;
       }},
      {"DampingIsDividedByFrequency", "Haskind relation", error, hemisphere,
       [](Coefficients& c) {
         for (std::size_t w = 0; w < c.omega.size(); ++w) c.B[w] /= c.omega[w];
       }},
      {"ExcitationOfOneBodyIsMissing", "heave in long waves", error, boxes,
       [](Coefficients& c) {
         for (auto& X : c.X) X.bottomRows(6).setZero();
       }},
      {"ExcitationIsPerWaveHeight", "heave in long waves", error, boxes,
       [](Coefficients& c) {
         for (auto& X : c.X) X /= 2;
       }},
      {"RollAndPitchOfXAreExchanged", "Haskind relation", error, boxes,
       [](Coefficients& c) {
         for (auto& X : c.X) X.row(3).swap(X.row(4));
       }},
      {"RollAndPitchOfXAreExchangedInSymmetricData", "Haskind relation", error, pontoon,
       [](Coefficients& c) {
         for (auto& X : c.X) X.row(3).swap(X.row(4));
       }},
      {"RollAndPitchOfXAreExchangedAllRound", "Haskind relation", error, pontoon_all_round,
       [](Coefficients& c) {
         for (auto& X : c.X) X.row(3).swap(X.row(4));
       }},
      {"TheLimitIsThatOfSlowMotion", "A(inf) by Ogilvie", error, boxes, [](Coefficients& c) { c.A_inf = c.A_zero; }},
      {"TheLimitHasTheOtherSign", "positivity of A(inf)", error, boxes, [](Coefficients& c) { *c.A_inf *= -1; }},
      {"TheLimitIsMissing", "limit at infinity", warning, boxes, [](Coefficients& c) { c.A_inf.reset(); }},
      {"VolumeIsInLitres", "waterplane and volume", error, boxes, [](Coefficients& c) {
         for (auto& b : c.body) *b.displaced_volume *= 1000;
       }}};
  return list;
}

std::string told(const std::vector<Finding>& findings) {
  std::string out;
  for (const Finding& f : findings)
    if (f.severity != Severity::note)
      out += fmt::format("{} {}: {} ({})\n", to_string(f.severity), f.check, f.message, f.where);
  return out.empty() ? "nothing" : out;
}

class Corrupted : public ::testing::TestWithParam<Corruption> {};

TEST_P(Corrupted, IsFoundByItsCheck) {
  Coefficients c = GetParam().sound();
  GetParam().spoil(c);
  const auto findings = check(c);
  const bool found = std::any_of(findings.begin(), findings.end(), [](const Finding& f) {
    return f.check == GetParam().check && f.severity >= GetParam().at_least && !f.why.empty() && !f.remedy.empty() &&
           !f.where.empty();
  });
  EXPECT_TRUE(found) << "the doctor says:\n" << told(findings);
}

INSTANTIATE_TEST_SUITE_P(Doctor, Corrupted, ::testing::ValuesIn(corruptions()),
                         [](const auto& each) { return std::string(each.param.name); });

// --- sound data ------------------------------------------------------------------------------------------------

TEST(Doctor, SaysNothingAgainstTheConvergedMeshesOfTheExamples) {
  for (const char* name : {"box2.nc", "hemisphere_r5.nc", "pontoon1.nc", "pontoon5.nc"})
    EXPECT_EQ(told(check(example(name))), "nothing") << name;
}

TEST(Doctor, GivesEachCheckAFindingAndNoOther) {
  std::vector<std::string> names;
  for (const Finding& f : check(boxes()))
    if (names.empty() || names.back() != f.check) names.push_back(f.check);
  EXPECT_EQ(names, hydro::potential::check_names());
}

/// (P4), (P5): the same bodies told about other points, and elsewhere on the water, are as sound as before.
TEST(Doctor, DoesNotDependOnReferencePointAndPlace) {
  const Coefficients& c = boxes();
  std::vector<Eigen::Vector3d> from, to;
  for (const auto& b : c.body) {
    from.push_back(*b.reference_point);
    to.push_back(*b.reference_point + Eigen::Vector3d(1.2, -0.8, 0.3));
  }
  EXPECT_EQ(told(check(hydro::potential::about(c, from, to))), "nothing");
  EXPECT_EQ(told(check(hydro::potential::translated(c, {25, -40}))), "nothing");
}

double number_after(const std::vector<Finding>& findings, const std::string& name, const std::string& words) {
  for (const Finding& f : findings)
    if (f.check == name && f.message.find(words) != std::string::npos)
      return std::stod(f.message.substr(f.message.find(words) + words.size()));
  ADD_FAILURE() << "no finding " << name << " says \"" << words << '"';
  return std::nan("");
}

/// (P67), (P68) where ω²(ρV + A) is a third of C33: their second terms count, and what they leave out, (kL)² = 0.02, is
/// as small as a thirtieth.
TEST(Doctor, KnowsTheSecondTermOfLongWaves) {
  Coefficients c = hemisphere();
  keep_frequencies(c, 5, c.omega.size());
  const auto findings = check(c);
  EXPECT_NEAR(number_after(findings, "heave in long waves", "|X₃| is "), 1, 0.03);
  EXPECT_LT(number_after(findings, "surge and sway in long waves", "differ by "), 0.15);  // a longer way: (kL)² of 2R
}

/// (P64) on data without a mesh: what remains is the solver's tolerance, at any depth.
// A spike makes heave huge, and yaw small beside it: that a body is round has to be seen in the usual frequencies.
TEST(Doctor, DoesNotTakeASquareBodyForARoundOneAtASpike) {
  Coefficients c = example("pontoon1.nc");
  c.heading.resize(1);
  c.X.resize(1);
  const auto told = [&] {
    for (const Finding& f : check(c))
      if (f.check == "Haskind relation") return f.message;
    return std::string();
  };
  ASSERT_THAT(told(), HasSubstr("do not cover the circle"));
  c.A[20](2, 2) *= 1000;
  EXPECT_THAT(told(), testing::Not(HasSubstr("8 headings")));
}

TEST(Doctor, FindsHaskindsRelationInExactData) {
  const hydro::cylinders::CylinderBody body{"buoy", {0, 0, -0.5}, Eigen::Vector3d(0, 0, -1), {{{0, 0}, 1.0, 1.5}}};
  const hydro::Water water{.depth = hydro::WaterDepth::from_metres(3)};
  const std::vector<double> omega{0.5, 1, 1.5, 2, 2.5, 3}, heading{0.3};
  const auto findings = check(hydro::cylinders::solve({body}, water, omega, heading, {.tolerance = 1e-5}).coefficients);
  EXPECT_LT(number_after(findings, "Haskind relation", "farthest entry "), 1e-3);
}

/// Cylinders of the exact solver, which has no mesh: deep and shallow water, one body and two.
TEST(Doctor, SaysNothingAgainstExactCylinders) {
  const auto cylinder = [](const char* name, double x) {
    return hydro::cylinders::CylinderBody{name, {x, 0, 0}, Eigen::Vector3d(x, 0, -1), {{{x, 0}, 1.0, 1.5}}};
  };
  std::vector<double> omega, heading;
  for (int i = 1; i <= 30; ++i) omega.push_back(0.2 * i);
  for (int i = 0; i < 12; ++i) heading.push_back(i * std::numbers::pi / 6);
  for (const double depth : {4.0, 30.0}) {
    const hydro::Water water{.depth = hydro::WaterDepth::from_metres(depth)};
    for (const auto& bodies : {std::vector{cylinder("one", 0)}, std::vector{cylinder("one", -2), cylinder("two", 2)}}) {
      const auto solved = hydro::cylinders::solve(bodies, water, omega, heading, {.tolerance = 1e-4});
      EXPECT_EQ(told(check(solved.coefficients)), "nothing") << depth << " m deep, " << bodies.size() << " bodies";
    }
  }
}

/// Adds to heave the memory α e^{−γt} cos ω₀t of water that sloshes in the body: causal by itself, and without A(∞).
Coefficients with_resonance(Coefficients c, double omega_0, double gamma, double alpha) {
  for (std::size_t w = 0; w < c.omega.size(); ++w) {
    const std::complex<double> s(gamma, c.omega[w]), Z = alpha * s / (s * s + omega_0 * omega_0);
    c.B[w](2, 2) += Z.real();
    c.A[w](2, 2) += Z.imag() / c.omega[w];
  }
  const double square = omega_0 * omega_0, damping = gamma * gamma;
  (*c.A_zero)(2, 2) += alpha * (square - damping) / ((square + damping) * (square + damping));
  return c;
}

Finding found(const Coefficients& c, const std::string& name) {
  for (const Finding& f : check(c))
    if (f.check == name) return f;
  ADD_FAILURE() << "no finding " << name;
  return {};
}

/// (P45): the same A(∞) is right in all three; in the second the spacing misses a narrow resonance.
TEST(Doctor, TellsATableThatIsTooCoarseFromAWrongLimit) {
  const std::size_t at = 12;
  const double omega_0 = hemisphere().omega[at], spacing = hemisphere().omega[at + 1] - omega_0;
  // At slow motions the resonance adds α/ω₀² to the added mass: half of what the hemisphere has.
  const double alpha = 0.5 * hemisphere().A[0](2, 2) * omega_0 * omega_0;
  const Finding wide = found(with_resonance(hemisphere(), omega_0, 2 * spacing, alpha), "A(inf) by Ogilvie");
  EXPECT_EQ(wide.severity, Severity::note) << wide.message;
  const Finding narrow = found(with_resonance(hemisphere(), omega_0, 0.1 * spacing, alpha), "A(inf) by Ogilvie");
  EXPECT_GE(narrow.severity, Severity::warning);
  EXPECT_THAT(narrow.message, HasSubstr("the table is too coarse"));
  EXPECT_THAT(narrow.remedy, HasSubstr(fmt::format("{:.4g}", omega_0)));
  Coefficients wrong = boxes();
  wrong.A_inf = wrong.A_zero;
  EXPECT_THAT(found(wrong, "A(inf) by Ogilvie").remedy, HasSubstr("compute A(∞) again"));
}

TEST(Doctor, KnowsABodyWhollyUnderWater) {
  const hydro::cylinders::CylinderBody disc{"disc", {0, 0, -2}, Eigen::Vector3d(0, 0, -2.2), {{{0, 0}, 1.0, 2.5, 1.5}}};
  const hydro::Water water{.depth = hydro::WaterDepth::from_metres(6)};
  const auto c = hydro::cylinders::solve({disc}, water, {0.5, 1, 1.5, 2}, {0.0}, {.tolerance = 1e-4}).coefficients;
  ASSERT_EQ((*c.C)(2, 2), 0);
  for (const Finding& f : check(c))
    if (f.check == "restoring matrix") {
      EXPECT_EQ(f.severity, Severity::note) << f.message;
    }
}

}  // namespace
}  // namespace doctor_test
