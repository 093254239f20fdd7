#include "fit/calibration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/io/csv.hpp"
#include "support/reference_data.hpp"

namespace calibration_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Calibration, RecoversAnExactLine) {
  const fit::LoadCycle tension{{0, 10, 20, 10, 0}, {0.1, 1.1, 2.1, 1.1, 0.1}},
      compression{{0, -10, 0}, {0.1, -0.9, 0.1}};
  const auto line = fit::calibrate(std::vector{tension, compression});
  EXPECT_NEAR(line.slope, 0.1, 1e-15);
  EXPECT_NEAR(line.offset, 0.1, 1e-15);
  EXPECT_NEAR(line.force(1.1), 10, 1e-13);
  EXPECT_NEAR(line.hysteresis, 0, 1e-15);
  EXPECT_NEAR(line.slope_error, 0, 1e-15);
  EXPECT_EQ(line.pairs, 3u);
  EXPECT_NEAR(line.range, 3.0, 1e-15);
}

TEST(Calibration, ReadsTheWidthOfAHysteresisLoop) {
  const fit::LoadCycle loop{{0, 1, 2, 3, 4, 3, 2, 1, 0}, {0, 1.0, 2.0, 3.0, 4.0, 3.1, 2.2, 1.1, 0.0}};
  const auto line = fit::calibrate(std::vector{loop});
  EXPECT_NEAR(line.hysteresis, 0.2 / 4, 1e-12);
  EXPECT_EQ(line.pairs, 4u);
}

TEST(Calibration, StatesTheTextbookErrorOfASlope) {
  // Five points, residuals +1 −2 +1 −... : V = F + e with e orthogonal to 1 and F: slope exactly 1, RSS = Σe².
  const fit::LoadCycle cycle{{-1, 0, 2, 0, -1}, {-1 + 0.1, 0 - 0.2, 2, 0 + 0.2, -1 - 0.1}};
  const auto line = fit::calibrate(std::vector{fit::LoadCycle{{0, 1, 2, 1, 0}, {0.1, 0.8, 2, 1.2, -0.1}}});
  EXPECT_NEAR(line.slope, 1, 1e-14);
  EXPECT_NEAR(line.residual_deviation, std::sqrt(0.1 / 3), 1e-14);
  EXPECT_NEAR(line.slope_error, std::sqrt(0.1 / 3 / 2.8), 1e-14);                // S_FF = 2·0.64 + 2·0.04 + 1.44
  EXPECT_NEAR(line.slope_interval.high - 1, 3.182446 * line.slope_error, 1e-6);  // t(0.975; 3)
  EXPECT_THROW(fit::calibrate(std::vector{cycle}), hydro::InputError);  // its loads fall and rise: no loading cycle
}

TEST(Calibration, RefusesWhatIsNoLoadingCycle) {
  const auto run = [](const fit::LoadCycle& cycle) { return [cycle] { fit::calibrate(std::vector{cycle}); }; };
  EXPECT_THAT(run({{0, 2, 1, 3, 0}, {0, 2, 1, 3, 0}}),
              ThrowsMessage<hydro::InputError>(HasSubstr("do not go up and then down")));
  EXPECT_THAT(run({{0, 1, 2}, {0, 1, 2}}),
              ThrowsMessage<hydro::InputError>(HasSubstr("on the way up and on the way down")));
  EXPECT_THROW(run({{0, 1, 0}, {0, 1}})(), hydro::InputError);
  EXPECT_THROW(run({{1, 1, 1}, {0, 1, 0}})(), hydro::InputError);
}

TEST(Calibration, OfHendriksensLoadCellsComesOutAsRecomputed) {
  FROUDE_REQUIRE_DATA(folder, "thesis-tables");
  const std::vector<std::pair<std::string, double>> cells{{"hendriksen_figD2_load_cell_1.csv", 0.0933},
                                                          {"hendriksen_figD3_load_cell_2.csv", 0.0935}};
  for (const auto& [file, slope] : cells) {
    const auto table = hydro::io::CsvTable::read(folder / file);
    std::vector<fit::LoadCycle> cycles(2);  // tension, compression
    for (std::size_t i = 0; i < table.rows(); ++i) {
      auto& cycle = cycles[table.column("force_N")[i] < 0];
      cycle.force.push_back(table.column("force_N")[i]);
      cycle.voltage.push_back(table.column("volt_corrected")[i]);
    }
    const auto line = fit::calibrate(cycles);
    EXPECT_NEAR(line.slope, slope, 5e-5) << file;  // the digits stated
    EXPECT_EQ(line.pairs, 14u);
    EXPECT_LT(line.hysteresis, 0.01 / 15.6 * 1.01);  // one step of the printed voltages over the range
    EXPECT_LT(line.slope_error, 1e-4);
  }
}

}  // namespace
}  // namespace calibration_test
