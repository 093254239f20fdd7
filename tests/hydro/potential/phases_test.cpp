// Loads of wrong phases, headings or modes: what is refused when a file is read, and which cause the doctor names.
// (P21), (P68)
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numbers>
#include <string>

#include "example.hpp"
#include "hydro/base/error.hpp"
#include "hydro/potential/doctor/check.hpp"
#include "hydro/potential/formats/writers.hpp"
#include "smooth_body.hpp"

namespace phases_test {
namespace {

using hydro::potential::Coefficients;
using hydro::potential::Finding;
using hydro::potential::Severity;
using testing::HasSubstr;

/// The pontoon, headings of 0, 45 and 90 degrees, spoilt, written as WAMIT does, and read.
Coefficients through_wamit(const std::function<void(Coefficients&)>& spoil) {
  const froude_test::TemporaryFolder folder;
  Coefficients c = froude_test::example("pontoon1.nc");
  spoil(c);
  hydro::potential::write_wamit(c, folder / "w");
  return hydro::potential::read(folder / "w.1", {c.water.density, c.water.gravity, c.water.depth, {}, {}});
}

std::string remedy_of_push(const Coefficients& c) {
  for (const Finding& f : hydro::potential::check(c))
    if (f.check == "surge and sway in long waves") {
      EXPECT_EQ(f.severity, Severity::error) << f.message;
      return f.remedy;
    }
  return "no such finding";
}

void reverse_headings(Coefficients& c, const std::function<double(double)>& change) {
  for (double& heading : c.heading) heading = change(heading);
  if (c.heading.front() < c.heading.back()) return;
  std::reverse(c.heading.begin(), c.heading.end());
  std::reverse(c.X.begin(), c.X.end());
}

TEST(Phases, OfTheOtherTimeFactorAreRefused) {
  try {
    through_wamit([](Coefficients& c) {
      for (auto& X : c.X) X = X.conjugate().eval();
    });
    FAIL() << "phases of the other time factor were read";
  } catch (const hydro::InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("the phases are of the other time factor: "));
    EXPECT_THAT(e.remedy(), HasSubstr("ControlFile.in"));
  }
}

TEST(Phases, OfHeadingsWhereWavesComeFromAreNotTakenForThem) {
  const Coefficients c = through_wamit(
      [](Coefficients& wrong) { reverse_headings(wrong, [](double heading) { return heading + std::numbers::pi; }); });
  EXPECT_EQ(remedy_of_push(c), "probably headings are where waves come from");
}

TEST(Phases, OfMirroredHeadingsAreNotTakenForThem) {
  const Coefficients c =
      through_wamit([](Coefficients& wrong) { reverse_headings(wrong, [](double heading) { return -heading; }); });
  EXPECT_EQ(remedy_of_push(c), "probably headings are counted the other way round");
}

TEST(Phases, OfExchangedModesAreNotTakenForThem) {
  const Coefficients c = through_wamit([](Coefficients& wrong) {
    for (auto& X : wrong.X) X.row(0).swap(X.row(1));
  });
  EXPECT_EQ(remedy_of_push(c), "probably surge and sway are exchanged");
}

}  // namespace
}  // namespace phases_test
