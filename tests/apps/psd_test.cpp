// `froude psd` through the function that main.cpp calls.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "fit/prepare.hpp"
#include "froude/commands.hpp"
#include "froude/record_file.hpp"
#include "froude/result.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/io/hdf5.hpp"
#include "support/scratch.hpp"

namespace psd_test {
namespace {

using froude::PsdArguments;
using hydro::InputError;
using testing::HasSubstr;
using testing::ThrowsMessage;

// "did you mean °?" stopped a file whose temperature nobody asked for.
TEST(RecordsOfCsv, LeaveOutTextAndUnitsThatAreNotKnownUntilTheyAreAskedFor) {
  const auto file = support::scratch_folder() / "record_with_temperature.csv";
  hydro::io::write_atomically(file,
                              "t [s];F [N];T [\xC2\xB0"
                              "C];note\n0;1,5;20,1;ok\n1;2,5;20,2;ok\n");
  const froude::RunResult record = froude::read_record(file);
  ASSERT_EQ(record.signals.size(), 1u);
  EXPECT_EQ(froude::signal_of(record, "F", file).values, (std::vector<double>{1.5, 2.5}));
  EXPECT_THAT([&] { froude::signal_of(record, "T", file); },
              testing::ThrowsMessage<hydro::InputError>(testing::HasSubstr("is not a unit")));
  EXPECT_THAT([&] { froude::signal_of(record, "note", file); },
              testing::ThrowsMessage<hydro::InputError>(testing::HasSubstr("holds text")));
}

class Psd : public testing::Test {
 protected:
  Psd() {
    std::string name = (std::filesystem::temp_directory_path() / "froude-test-XXXXXX").string();
    folder = ::mkdtemp(name.data());
    // Ten minutes at 5 Hz: a wave of amplitude 1.5 m and period 8 s, and a heave of half of it, 30 degrees behind.
    for (std::size_t j = 0; j < 3000; ++j) {
      const double t = 0.2 * static_cast<double>(j), phase = 2 * std::numbers::pi / 8 * t;
      time.push_back(t);
      wave.push_back(1.5 * std::cos(phase));
      heave.push_back(2 + 0.75 * std::cos(phase - std::numbers::pi / 6));
    }
  }
  ~Psd() override { std::filesystem::remove_all(folder); }

  std::filesystem::path csv() {
    const std::vector<double> still(time.size(), 3.0);
    hydro::io::write_csv(
        folder / "r.csv",
        {{"time", "s", &time}, {"wave", "m", &wave}, {"heave", "cm", &heave}, {"still", "N m", &still}});
    return folder / "r.csv";
  }
  nlohmann::json json(const PsdArguments& arguments) {
    std::ostringstream out, err;
    froude::psd(arguments, {out, err, true});
    return nlohmann::json::parse(out.str());
  }
  std::string text(const PsdArguments& arguments) {
    std::ostringstream out, err;
    froude::psd(arguments, {out, err});
    return out.str();
  }

  std::filesystem::path folder;
  std::vector<double> time, wave, heave;
};

// A minute is missing: the line is where it was, with its variance. Where samples are missing all over, a seventh of
// them here, they alias a sixth of it, and a note says so.
TEST_F(Psd, TakesARecordWithGaps) {
  const auto record = [&](const char* name, std::size_t every) {
    std::vector<double> t, w;
    for (std::size_t j = 0; j < time.size(); ++j)
      if ((time[j] < 200 || time[j] > 260) && j % every != 3) t.push_back(time[j]), w.push_back(wave[j]);
    hydro::io::write_csv(folder / name, {{"time", "s", &t}, {"wave", "m", &w}});
    return folder / name;
  };
  record("g.csv", time.size());
  const auto j = json({.file = folder / "g.csv", .segment = "80 s", .uneven = true});
  EXPECT_NEAR(j["signals"]["wave"]["hs"].get<double>(), 2 * std::numbers::sqrt2 * 1.5, 0.05);  // what gaps leak
  EXPECT_NEAR(j["signals"]["wave"]["tp_s"].get<double>(), 8, 0.05);
  EXPECT_THAT(text({.file = folder / "g.csv", .segment = "80 s", .uneven = true}), testing::Not(HasSubstr("alias")));
  EXPECT_THAT(text({.file = record("s.csv", 7), .segment = "80 s", .uneven = true}), HasSubstr("alias"));
  // A line has nothing beside it but what the gap leaks.
  EXPECT_THAT(text({.file = folder / "g.csv", .segment = "80 s", .uneven = true}),
              HasSubstr("gaps let other frequencies leak into the density of wave"));
  EXPECT_THAT([&] { json({.file = folder / "g.csv", .segment = "80 s"}); },
              ThrowsMessage<InputError>(HasSubstr("even")));
  EXPECT_THAT([&] { json({.file = folder / "g.csv", .tapers = 3, .uneven = true}); },
              ThrowsMessage<InputError>(HasSubstr("--uneven")));
}

// A hundred heaps of ten waves: their peaks are 1 + 0.01 i, evenly spread, so that nine in ten are below 1.9.
TEST_F(Psd, ExtremesAreThoseOfThePeaksAndOfTheirMirror) {
  std::vector<double> t, x;
  for (int i = 0; i < 100 * 20; ++i) {
    t.push_back(i);
    x.push_back(std::sin(2 * std::numbers::pi * i / 20) * (1 + 0.01 * (i / 20 * 37 % 100)));
  }
  std::vector<double> mirror = x;
  for (double& v : mirror) v = -v;
  hydro::io::write_csv(folder / "e.csv", {{"time", "s", &t}, {"x", "m", &x}, {"mirror", "m", &mirror}});
  const auto told = [&](const froude::ExtremesArguments& arguments) {
    std::ostringstream out, err;
    froude::extremes(arguments, {out, err, true});
    return nlohmann::json::parse(out.str());
  };
  const auto highest = told({.file = folder / "e.csv", .signal = "x", .duration = "2000 s", .threshold = "1.5 m"}),
             lowest = told({.file = folder / "e.csv",
                            .signal = "mirror",
                            .lowest = true,
                            .duration = "2000 s",
                            .threshold = "-1.5 m"});
  EXPECT_NEAR(highest["tail_shape"].get<double>(), -1, 0.1);  // a uniform tail ends at its bound
  EXPECT_NEAR(highest["estimates"][0]["level"].get<double>(), 1.99, 0.02);
  EXPECT_NEAR(highest["extreme"].get<double>(), 1.99, 1e-9);
  EXPECT_NEAR(lowest["extreme"].get<double>(), -1.99, 1e-9);
  // Up-crossings of the mirror are half a wave later: one wave of the hundred is another.
  EXPECT_NEAR(lowest["estimates"][0]["level"].get<double>(), -highest["estimates"][0]["level"].get<double>(), 0.02);
  for (const auto& e : highest["estimates"]) {
    EXPECT_LE(e["low"].get<double>(), e["level"].get<double>());
    EXPECT_GE(e["high"].get<double>(), e["level"].get<double>());
  }
  EXPECT_THAT([&] { told({.file = folder / "e.csv", .signal = "x", .threshold = "1.5 s"}); },
              ThrowsMessage<InputError>(HasSubstr("length")));
  EXPECT_THAT([&] { told({.file = folder / "e.csv", .signal = "x", .threshold = "1.95 m"}); },
              ThrowsMessage<InputError>(HasSubstr("a tail needs 10")));
  // 50 of 100 peaks in 1999 s: one is expected in 40 s, and with a probability of a tenth 2.3 must be.
  const auto in = [&](const char* duration, std::vector<double> quantiles) {
    return told(
        {.file = folder / "e.csv", .signal = "x", .duration = duration, .threshold = "1.5 m", .quantiles = quantiles});
  };
  EXPECT_THAT([&] { in("30 s", {}); },
              ThrowsMessage<InputError>(testing::AllOf(HasSubstr("--duration"), HasSubstr("holds 0.7"))));
  EXPECT_THAT([&] { in("60 s", {0.1}); }, ThrowsMessage<InputError>(HasSubstr("for the quantile 0.1")));
  const nlohmann::json short_time = in("60 s", {0.5});
  for (const auto& e : short_time["estimates"]) EXPECT_TRUE(e["level"].is_number());  // and no null for −∞
}

// A spike of the sensor would be the largest value of all, 6 m above waves of 1.5 m.
TEST_F(Psd, ExtremesAreThoseOfTheRecordWithoutItsSpikes) {
  const auto told = [&](const froude::ExtremesArguments& arguments) {
    std::ostringstream out, err;
    froude::extremes(arguments, {out, err, true});
    return nlohmann::json::parse(out.str());
  };
  for (std::size_t j = 0; j < wave.size(); ++j) wave[j] *= 1 - 0.3 * std::cos(0.01 * time[j]);
  const double largest = *std::max_element(wave.begin(), wave.end());
  wave[1234] += 7;
  EXPECT_THAT([&] { told({.file = csv(), .signal = "wave", .threshold = "1 m"}); },
              ThrowsMessage<InputError>(HasSubstr("--outliers bridges a spike")));
  const auto as_it_is = told({.file = csv(), .signal = "wave", .threshold = "1 m", .accept = {"tail"}}),
             cleaned = told({.file = csv(), .signal = "wave", .threshold = "1 m", .steps = {.outliers = "2.1 s"}});
  EXPECT_GT(as_it_is["extreme"].get<double>(), 5);
  EXPECT_NEAR(cleaned["extreme"].get<double>(), largest, 1e-6);  // digits of the file; the spike is on no crest
  EXPECT_EQ(cleaned["prepared"]["outliers"][0]["bridged"], 1);
}

TEST_F(Psd, TellsHeightAndPeriodOfARegularWave) {
  const auto j = json({.file = csv(), .segment = "80 s"});
  const auto& w = j["signals"]["wave"];
  // 4σ of a sinusoid is 2√2 times its amplitude; ten periods per segment, so the line sits on its bin and Hann is
  // exact.
  EXPECT_NEAR(w["hs"].get<double>(), 2 * std::numbers::sqrt2 * 1.5, 1e-6);
  EXPECT_NEAR(w["tp_s"].get<double>(), 8, 1e-6);
  EXPECT_NEAR(w["tz_s"].get<double>(), 8, 1e-3);
  EXPECT_NEAR(w["h13"].get<double>(), 3.0, 0.005);  // 40 samples per wave: at most 2·1.5·(1 − cos(π/40))
  EXPECT_NEAR(j["signals"]["heave"]["mean"].get<double>(), 2.0, 1e-3);  // SI, though the header says cm
  EXPECT_EQ(j["segment_samples"], 400);
  EXPECT_FALSE(j["signals"]["still"].contains("hs"));
}

TEST_F(Psd, TakesTapersInThePlaceOfSegments) {
  const auto j = json({.file = csv(), .signals = {"wave"}, .tapers = 5});
  EXPECT_EQ(j["tapers"], 5);
  EXPECT_EQ(j["degrees_of_freedom"], 10);
  // 75 whole waves, weighed smoothly: what the tapers make of their ends is 3e-7.
  EXPECT_NEAR(j["signals"]["wave"]["hs"].get<double>(), 2 * std::numbers::sqrt2 * 1.5, 1e-5);
  EXPECT_THAT([&] { json({.file = csv(), .segment = "80 s", .tapers = 5}); },
              ThrowsMessage<InputError>(HasSubstr("--tapers takes the whole record")));
}

TEST_F(Psd, FindsTheResponseToTheInput) {
  const auto j = json({.file = csv(), .signals = {"h*"}, .segment = "80 s", .input = "wave"});
  const auto& t = j["signals"]["heave"]["transfer"];
  EXPECT_NEAR(t["gain"][10].get<double>(), 0.5, 1e-9);
  EXPECT_NEAR(t["phase_rad"][10].get<double>(), -std::numbers::pi / 6, 1e-9);
  EXPECT_FALSE(j["signals"].contains("still"));
  EXPECT_THAT(text({.file = csv(), .signals = {"heave"}, .segment = "80 s", .input = "wave"}),
              testing::AllOf(HasSubstr("|H1| 0.5"), HasSubstr("phase -30.0 deg")));
}

TEST_F(Psd, ReadsAResultOfARunAndWritesTablesAndAPicture) {
  froude::write_run(folder / "run.h5", time, {{"m1.heave", "m", "heave", heave}}, {});
  const auto told = text({.file = folder / "run.h5",
                          .segment = "80 s",
                          .from = "40 s",
                          .output = folder / "p.csv",
                          .picture = folder / "p.svg"});
  EXPECT_THAT(told, testing::AllOf(HasSubstr("2800 samples"), HasSubstr("m1.heave")));
  const auto table = hydro::io::CsvTable::read(folder / "p.csv");
  // Per hertz as the header says; in SI, which the reader gives, per rad/s.
  EXPECT_EQ(table.unit_text("m1.heave.density"), "m^2/Hz");
  const auto& omega = table.column("frequency", hydro::dim::angular_velocity);
  const auto& density = table.column("m1.heave.density");
  double variance = 0;
  for (std::size_t k = 1; k < omega.size(); ++k) variance += density[k] * (omega[k] - omega[k - 1]);
  EXPECT_NEAR(variance, 0.75 * 0.75 / 2, 1e-6);
  EXPECT_THAT(hydro::io::read_text(folder / "p.svg"), HasSubstr("m²/Hz"));
  text({.file = folder / "run.h5", .segment = "80 s", .output = folder / "p.h5"});
  EXPECT_EQ(hydro::io::Hdf5Reader(folder / "p.h5").text_attribute("/m1.heave.density", "units"), "m^2/Hz");
}

// The same numbers as of a file that holds no more than the part.
TEST_F(Psd, AnalysesAPartOfTheRecordAsIfThereWereNoMore) {
  const auto part = json({.file = csv(), .signals = {"wave"}, .segment = "80 s", .from = "40 s", .to = "400 s"});
  EXPECT_EQ(part["samples"], 1801);  // both ends count
  for (auto* values : {&time, &wave, &heave}) *values = {values->begin() + 200, values->begin() + 2001};
  const auto alone = json({.file = csv(), .signals = {"wave"}, .segment = "80 s"});
  EXPECT_EQ(part["signals"]["wave"], alone["signals"]["wave"]);
  EXPECT_EQ(json({.file = csv(), .segment = "80 s", .to = "400 s"})["samples"], 1801) << "up to the very end";
}

TEST_F(Psd, RefusesAnEndThatIsNone) {
  const auto run = [&](const PsdArguments& arguments) { return [this, arguments] { text(arguments); }; };
  using testing::AllOf;
  EXPECT_THAT(run({.file = csv(), .from = "60 s", .to = "60 s"}),
              ThrowsMessage<InputError>(AllOf(HasSubstr("command line: error: --to 60 s is not after --from 60 s"),
                                              HasSubstr("exchange the two"))));
  EXPECT_THAT(run({.file = csv(), .to = "10.1 min"}),
              ThrowsMessage<InputError>(AllOf(HasSubstr("r.csv: error: the record ends at 599.8 s, before --to 606 s"),
                                              HasSubstr("leave --to out"))));
  EXPECT_THAT(run({.file = csv(), .to = "-1 s"}),
              ThrowsMessage<InputError>(AllOf(HasSubstr("the first is at 0 s, after --to -1 s"), HasSubstr("later"))));
  EXPECT_THAT(run({.file = csv(), .from = "1.05 s", .to = "1.15 s"}), ThrowsMessage<InputError>(HasSubstr("at 1.2 s")));
  EXPECT_THAT(run({.file = csv(), .to = "400"}),
              ThrowsMessage<InputError>(AllOf(HasSubstr("--to: error: "), HasSubstr("has no unit"))));
  EXPECT_THAT(run({.file = csv(), .from = "60 m"}),
              ThrowsMessage<InputError>(AllOf(HasSubstr("--from: error: "), HasSubstr("is a length"))));
}

TEST_F(Psd, SaysWhatIsWrong) {
  const auto run = [&](const PsdArguments& arguments) { return [this, arguments] { text(arguments); }; };
  EXPECT_THAT(run({.file = csv(), .signals = {"heeve"}}), ThrowsMessage<InputError>(HasSubstr("heeve")));
  EXPECT_THAT(run({.file = csv(), .segment = "1000 s"}), ThrowsMessage<InputError>(HasSubstr("a segment needs")));
  EXPECT_THAT(run({.file = csv(), .segment = "80 m"}), ThrowsMessage<InputError>(HasSubstr("length")));
  EXPECT_THAT(run({.file = csv(), .from = "700 s"}), ThrowsMessage<InputError>(HasSubstr("ends at 599.8 s")));
  EXPECT_THAT(run({.file = csv(), .confidence = 95}), ThrowsMessage<InputError>(HasSubstr("between 0 and 1")));
  EXPECT_THAT(run({.file = folder / "r.xyz"}), ThrowsMessage<InputError>(HasSubstr("no kind of file")));
  EXPECT_THAT(run({.file = csv(), .output = folder / "p.txt"}), ThrowsMessage<InputError>(HasSubstr(".csv or .h5")));
  hydro::io::write_csv(folder / "n.csv", {{"x", "m", &wave}});
  EXPECT_THAT(run({.file = folder / "n.csv"}), ThrowsMessage<InputError>(HasSubstr("no column \"time\"")));
  time[1500] += 0.1;
  EXPECT_THAT(run({.file = csv()}),
              ThrowsMessage<InputError>(testing::AllOf(HasSubstr("r.csv"), HasSubstr("sample 1500"))));
}

// A line and a wave that is even about the middle of the record, so that its own line is level.
TEST_F(Psd, OfARecordWhoseTrendIsTakenOffIsThatOfTheWave) {
  std::vector<double> even, drifting;
  for (const double t : time) {
    even.push_back(2 + 1.5 * std::cos(2 * std::numbers::pi / 8 * (t - 299.9)));
    drifting.push_back(even.back() + 0.01 * (t - 299.9));
  }
  hydro::io::write_csv(folder / "even.csv", {{"time", "s", &time}, {"x", "m", &even}});
  hydro::io::write_csv(folder / "drifting.csv", {{"time", "s", &time}, {"x", "m", &drifting}});
  const auto wanted = json({.file = folder / "even.csv", .segment = "80 s"})["signals"]["x"],
             of_rest = json({.file = folder / "drifting.csv", .segment = "80 s"})["signals"]["x"],
             got =
                 json({.file = folder / "drifting.csv", .segment = "80 s", .steps = {.detrend = true}})["signals"]["x"];
  const auto density = [](const nlohmann::json& x) { return x["density_per_hz"].get<std::vector<double>>(); };
  const auto peak = density(wanted)[10];
  for (std::size_t k = 0; k < density(wanted).size(); ++k)
    ASSERT_NEAR(density(got)[k], density(wanted)[k], 1e-10 * peak) << k;  // digits of the file
  EXPECT_GT(density(of_rest)[0], 1e-7 * peak) << "what the line puts into the lowest frequencies";
  EXPECT_NEAR(got["mean"].get<double>(), 2, 1e-9);
  EXPECT_EQ(got["waves"], wanted["waves"]);
}

// The record that a fit sees, written and analysed as it is.
TEST_F(Psd, OfAPreparedRecordIsThatOfTheRecordAFitSees) {
  std::vector<double> t, x;
  for (std::size_t j = 0; j < time.size(); ++j) {
    if (j % 701 == 40) continue;
    t.push_back(time[j]);
    x.push_back(wave[j] + 0.3 * std::sin(2.9 * time[j]) + (j % 997 == 500 ? 9 : 0));
  }
  hydro::io::write_csv(folder / "raw.csv", {{"time", "s", &t}, {"x", "m", &x}});
  const auto fitted = fit::prepare_motion("x", t, x,
                                          {.longest_gap_s = 0.5,
                                           .outlier_window_s = 2.1,
                                           .window = {.kind = fit::WindowChoice::Kind::span, .from = 60, .to = 500}});
  hydro::io::write_csv(folder / "fitted.csv", {{"time", "s", &fitted.time}, {"x", "m", &fitted.values}});
  const auto as_fit = json({.file = folder / "fitted.csv", .segment = "80 s"}),
             prepared = json({.file = folder / "raw.csv",
                              .segment = "80 s",
                              .steps = {.longest_gap = "0.5 s", .outliers = "2.1 s"},
                              .from = "60 s",
                              .to = "500 s"});
  EXPECT_EQ(prepared["samples"], as_fit["samples"]);
  EXPECT_EQ(prepared["frequency_hz"], as_fit["frequency_hz"]);
  EXPECT_EQ(prepared["signals"], as_fit["signals"]);
  EXPECT_EQ(prepared["prepared"]["steps"], nlohmann::json(fitted.steps));
  EXPECT_EQ(prepared["prepared"]["filled"], 5);
  EXPECT_EQ(prepared["prepared"]["outliers"][0]["bridged"], 3);
}

// Waves of 8 s stay within the 1 % that the band states, and drift of 100 s goes: 0.0002 of it is left by the closed
// form (F108), below 1 % of the waves.
TEST_F(Psd, OfABandAboutTheWavesIsThatOfTheWaves) {
  std::vector<double> drifting;
  for (std::size_t j = 0; j < time.size(); ++j)
    drifting.push_back(wave[j] + 4 * std::sin(2 * std::numbers::pi / 100 * time[j]));
  hydro::io::write_csv(folder / "d.csv", {{"time", "s", &time}, {"x", "m", &drifting}});
  const auto j = json({.file = folder / "d.csv", .segment = "80 s", .steps = {.wave_frequency = "0.125 Hz"}});
  EXPECT_NEAR(j["signals"]["x"]["hs"].get<double>(), 2 * std::numbers::sqrt2 * 1.5,
              0.01 * 2 * std::numbers::sqrt2 * 1.5);
  EXPECT_NEAR(j["signals"]["x"]["tz_s"].get<double>(), 8, 0.02);
  // Four periods of the lower edge, 0.025 Hz, at each end: (F16) with the slowest pole of (F17), sin(π/8) 2π 0.025
  // rad/s fast, whose memory falls to 1e-4 within ln 1e4 of its times; bent by the bilinear transform by less than
  // 1e-4.
  const double lost = std::log(1e4) / (std::sin(std::numbers::pi / 8) * 2 * std::numbers::pi * 0.025);
  EXPECT_NEAR(j["prepared"]["steady_from_s"].get<double>(), lost, 0.3);
  EXPECT_NEAR(j["prepared"]["steady_to_s"].get<double>(), 599.8 - lost, 0.3);
  EXPECT_EQ(
      j["signals"]["x"],
      json({.file = folder / "d.csv", .segment = "80 s", .steps = {.band_pass = "0.025 Hz, 0.5 Hz"}})["signals"]["x"]);
}

TEST_F(Psd, LeavesTheResponseToTheInputAsItIsWhereBothArePrepared) {
  const auto j = json({.file = csv(),
                       .signals = {"heave"},
                       .segment = "80 s",
                       .steps = {.detrend = true, .low_pass = "1 Hz"},
                       .input = "wave"});
  const auto& t = j["signals"]["heave"]["transfer"];
  EXPECT_NEAR(t["gain"][10].get<double>(), 0.5, 1e-3);  // lines of unlike slope through waves that end unlike
  EXPECT_NEAR(t["phase_rad"][10].get<double>(), -std::numbers::pi / 6, 1e-3);
}

// Waves of 0.125 Hz through each kind: its gain squared goes into the density, and Hs has the gain.
TEST_F(Psd, HasTheLowPassesOfAFit) {
  const auto hs = [&](const froude::StepArguments& steps) {
    return json({.file = csv(), .signals = {"wave"}, .segment = "80 s", .steps = steps})["signals"]["wave"]["hs"]
        .get<double>();
  };
  const double whole = hs({.detrend = true}), omega = 2 * std::numbers::pi / 8, step = 0.2;
  using fit::ZeroPhaseFilter;
  const std::pair<froude::StepArguments, double> kinds[] = {
      {{.low_pass = "0.16 Hz", .low_pass_order = 2}, ZeroPhaseFilter::butterworth(2, 0.16, step).gain(omega)},
      {{.low_pass = "0.16 Hz", .low_pass_kind = "chebyshev", .low_pass_order = 5, .low_pass_ripple = 0.05},
       ZeroPhaseFilter::chebyshev(5, 0.05, 0.16, step).gain(omega)},
      {{.low_pass = "0.16 Hz", .low_pass_kind = "gaussian"}, ZeroPhaseFilter::gaussian(0.16, step).gain(omega)},
      {{.low_pass = "0.16 Hz", .low_pass_kind = "symmetric weights"}, ZeroPhaseFilter::finite(0.16, step).gain(omega)},
      {{.moving_average = "3 s"}, ZeroPhaseFilter::moving_average(15, step).gain(omega)}};
  for (const auto& [steps, gain] : kinds) {
    EXPECT_LT(gain, 0.98) << "the test would not see the filter";
    // Ends that are given up end the record at another phase: Hann leaks 1e-3 of a line elsewhere.
    EXPECT_NEAR(hs(steps), gain * whole, 2e-3 * whole) << steps.low_pass_kind.value_or("");
  }
}

TEST_F(Psd, RefusesWhatSaysMoreOfAStepThatIsNotThere) {
  const auto run = [&](const froude::StepArguments& steps) {
    return [this, steps] { text({.file = csv(), .steps = steps}); };
  };
  EXPECT_THAT(run({.low_pass_order = 3}),
              ThrowsMessage<InputError>(HasSubstr("--low-pass-order does not act without")));
  EXPECT_THAT(run({.low_pass = "1 Hz", .low_pass_kind = "bessel"}),
              ThrowsMessage<InputError>(testing::AllOf(HasSubstr("--low-pass-kind: error: \"bessel\" is no kind"),
                                                       HasSubstr("\"symmetric weights\""))));
  EXPECT_THAT(run({.low_pass = "1 Hz", .low_pass_kind = "gaussian", .low_pass_order = 3}),
              ThrowsMessage<InputError>(HasSubstr("which this kind has not")));
  EXPECT_THAT(run({.low_pass = "1 Hz", .low_pass_ripple = 0.01}),
              ThrowsMessage<InputError>(HasSubstr("--low-pass-kind chebyshev")));
  EXPECT_THAT(
      run({.low_pass = "1 Hz", .low_pass_order = 11}),
      ThrowsMessage<InputError>(HasSubstr("--low-pass: error: a Butterworth filter has an order from 1 to 10")));
  EXPECT_THAT(run({.moving_average = "0 s"}), ThrowsMessage<InputError>(HasSubstr("must be positive")));
}

TEST_F(Psd, KeepsWhatTheStepsDidInTheResult) {
  const PsdArguments arguments{.file = csv(),
                               .segment = "80 s",
                               .steps = {.outliers = "4.1 s", .wave_frequency = "0.125 Hz"},
                               .output = folder / "p.h5"};
  const auto told = text(arguments);
  EXPECT_THAT(told, testing::AllOf(HasSubstr("prepared: outliers: 0 of 3000 samples of wave"),
                                   HasSubstr("prepared: band-pass from 0.025 Hz to 0.5 Hz"),
                                   HasSubstr("prepared: steady from 15"), HasSubstr("still never changes")));
  const hydro::io::Hdf5Reader file(folder / "p.h5");
  EXPECT_THAT(file.text_attribute("/", "prepared"), HasSubstr("band-pass from 0.025 Hz to 0.5 Hz"));
  EXPECT_EQ(file.number_attribute("/", "outliers_of_wave"), 0);
  EXPECT_EQ(file.number_attribute("/", "samples_filled"), 0);
  EXPECT_LT(file.number_attribute("/", "steady_from_s"), file.number_attribute("/", "steady_to_s"));
  text({.file = csv(), .segment = "80 s", .steps = {.detrend = true}, .output = folder / "p.csv"});
  EXPECT_THAT(hydro::io::read_text(folder / "p.csv"), HasSubstr("# prepared: trend: wave changes by"));
}

// White waves, twice as much heave and noise of its own: the gain is 2 at all frequencies.
TEST_F(Psd, HoldsTheGainInItsBandAsOftenAsItSays) {
  const hydro::RandomStream input(5, 1), noise(5, 2);
  for (std::size_t j = 0; j < time.size(); ++j) {
    wave[j] = input.normal(j);
    heave[j] = 2 * wave[j] + noise.normal(j);
  }
  hydro::io::write_csv(folder / "w.csv", {{"time", "s", &time}, {"wave", "m", &wave}, {"heave", "m", &heave}});
  text({.file = folder / "w.csv",
        .signals = {"heave"},
        .segment = "20 s",
        .input = "wave",
        .output = folder / "out.csv"});
  const auto table = hydro::io::CsvTable::read(folder / "out.csv");
  const auto &low = table.column("heave.gain_h1_low"), &high = table.column("heave.gain_h1_high");
  double held = 0;
  for (std::size_t k = 2; k + 2 < low.size(); ++k) held += low[k] < 2 && 2 < high[k] ? 1 : 0;
  const double share = held / static_cast<double>(low.size() - 4);
  EXPECT_GT(share, 0.85);  // 47 frequencies, neighbours not independent: a deviation of 0.04
}

}  // namespace
}  // namespace psd_test
