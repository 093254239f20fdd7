#include "fit/towing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/signal/distributions.hpp"
#include "support/reference_data.hpp"

namespace towing_test {
namespace {

fit::Cylinder cylinder() {
  return {
      .diameter = 0.12, .length = 0.5, .density = 997, .viscosity = 1.05e-6, .experiment = fit::Experiment::body_moves};
}

TEST(Towing, GivesTheDragCoefficientOfItsDefinition) {
  const std::vector<fit::TowingRun> runs{{2.0, 0, 0.5 * 997 * 4 * 0.06 * 1.3, 1.0}};
  const auto fit = fit::fit_towing(cylinder(), runs);
  EXPECT_NEAR(fit.points[0].cd, 1.3, 1e-14);
  EXPECT_NEAR(fit.points[0].cd_deviation, 1 / (0.5 * 997 * 4 * 0.06), 1e-14);
  EXPECT_NEAR(*fit.points[0].re, 2 * 0.12 / 1.05e-6, 1e-6);
  EXPECT_NEAR(fit.cd.interval.high - 1.3, 1.959964 * fit.points[0].cd_deviation, 1e-6);
}

TEST(Towing, CountsTheSpeedTwice) {
  const std::vector<fit::TowingRun> runs{{1.0, 0.01, 30.0, 1e-9}};
  EXPECT_NEAR(fit::fit_towing(cylinder(), runs).points[0].cd_deviation, 30 / (0.5 * 997 * 0.06) * 0.02, 1e-8);
}

TEST(Towing, WeighsRunsByTheirVarianceAndWidensWhereTheyScatter) {
  const double unit = 0.5 * 997 * 0.06;
  const std::vector<fit::TowingRun> agree{{1, 0, unit * 1.2, unit * 0.1}, {1, 0, unit * 1.2, unit * 0.2}};
  const auto a = fit::fit_towing(cylinder(), agree);
  EXPECT_NEAR(*a.cd.value, 1.2, 1e-14);
  EXPECT_NEAR(a.cd.standard_error, 1 / std::sqrt(125.0), 1e-14);  // weights 100 + 25
  EXPECT_NEAR(a.scatter, 0, 1e-12);
  const std::vector<fit::TowingRun> differ{{1, 0, unit * 1.0, unit * 0.1}, {1, 0, unit * 1.4, unit * 0.1}};
  const auto d = fit::fit_towing(cylinder(), differ);
  EXPECT_NEAR(d.chi_square, 8, 1e-12);  // twice (0.2/0.1)²
  EXPECT_NEAR(d.cd.standard_error, 0.1 / std::sqrt(2.0) * std::sqrt(8.0), 1e-12);
  EXPECT_NEAR(d.cd.interval.high - 1.2, d.cd.standard_error * hydro::signal::student_t_quantile(0.975, 1), 1e-12);
}

TEST(Towing, TakesTheErrorFromTheScatterWhereNoDeviationsAreStated) {
  const double unit = 0.5 * 997 * 0.06;
  const std::vector<fit::TowingRun> runs{{1, 0, unit * 1.0, 0}, {1, 0, unit * 1.2, 0}, {1, 0, unit * 1.4, 0}};
  const auto fit = fit::fit_towing(cylinder(), runs);
  EXPECT_NEAR(*fit.cd.value, 1.2, 1e-14);
  EXPECT_NEAR(fit.cd.standard_error, 0.2 / std::sqrt(3.0), 1e-14);                  // s/√n
  EXPECT_NEAR(fit.cd.interval.high - 1.2, 4.302653 * fit.cd.standard_error, 1e-6);  // t(0.975; 2)
  EXPECT_TRUE(std::isnan(fit.scatter));
}

TEST(Towing, RefusesRunsWithoutSpeedOrDeviation) {
  const auto fit = [](fit::TowingRun run) { return [run] { fit::fit_towing(cylinder(), std::vector{run}); }; };
  EXPECT_THAT(fit({0, 0, 1, 1}), testing::ThrowsMessage<hydro::InputError>(testing::HasSubstr("run 1: the speed")));
  EXPECT_THAT(fit({1, 0, 1, 0}), testing::ThrowsMessage<hydro::InputError>(testing::HasSubstr("no uncertainty")));
  EXPECT_THROW(fit({1, 0, 1, -1})(), hydro::InputError);
  EXPECT_THROW(fit::fit_towing(cylinder(), std::vector<fit::TowingRun>{{1, 0, 1, 1}, {1, 0, 1, 0}}), hydro::InputError);
  EXPECT_THROW(fit({1, 0, std::nan(""), 1})(), hydro::InputError);
  EXPECT_THROW(fit::fit_towing(cylinder(), {}), hydro::InputError);
}

TEST(Towing, OfHendriksensDropperLineComesOutAsRecomputed) {
  FROUDE_REQUIRE_DATA(path, "thesis-tables/hendriksen_table6_1_towing.csv");
  const auto table = hydro::io::CsvTable::read(path);
  const auto& speed = table.column("velocity_mean_m_s");
  const auto& speed_sd = table.column("velocity_sd");
  const auto& force = table.column("force_mean_N");
  const auto& force_sd = table.column("force_sd");
  std::vector<fit::TowingRun> runs;
  for (std::size_t i = 0; i < table.rows(); ++i) runs.push_back({speed[i], speed_sd[i], force[i], force_sd[i]});
  const auto fit = fit::fit_towing(cylinder(), runs);
  const std::vector<double> expected{1.191, 1.200, 1.175, 1.173, 1.163};
  ASSERT_EQ(fit.points.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(fit.points[i].cd, expected[i], 5e-4);  // the digits stated
    // The source's deviation leaves the speed's share out or is rounded to two digits: within 15 %.
    EXPECT_NEAR(fit.points[i].cd_deviation, table.column("cd_sd")[i], 0.15 * fit.points[i].cd_deviation);
  }
  EXPECT_LT(fit.scatter, 1.0);  // one C_D describes all five speeds within their deviations
}

}  // namespace
}  // namespace towing_test
