// The waves that a gauge recorded, component by component, and the phase of a regular wave. (W101)
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "answers/simulate.hpp"
#include "compile/waves.hpp"
#include "hydro/base/error.hpp"
#include "scenes.hpp"
#include "support/scratch.hpp"

namespace recorded_waves_test {
namespace {

using namespace froude;
using hydro::InputError;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double gravity = 9.81, length = 60, step = 0.05, gauge = -12, pi = std::numbers::pi;

/// A wave of amplitude a and phase φ at multiple n of 2π/T, deep water: k = ω²/g.
struct Wave {
  int n;
  double a, phase;
  double omega() const { return 2 * pi * n / length; }
  double k() const { return omega() * omega() / gravity; }
  double at(double t, double x) const { return a * std::cos(omega() * t - k() * x + phase); }
};
const std::vector<Wave> waves{{7, 0.3, 0.4}, {10, 0.5, -2.1}, {13, 0.2, 1.7}, {21, 0.06, 3}};

double surface(double t, double x) {
  double out = 0;
  for (const Wave& w : waves) out += w.at(t, x);
  return out;
}

/// The record of the gauge over one period, begun at `begin`, with an offset that a gauge may have.
std::filesystem::path record(double begin = 0) {
  const auto path = support::scratch_folder() / fmt::format("gauge_{}.csv", begin);
  std::ofstream file(path);
  file << "time [s],elevation [m]\n";
  for (int i = 0; i < std::lround(length / step); ++i) {
    const double t = begin + step * i;
    file << fmt::format("{:.10g},{:.17g}\n", t, 0.02 + surface(t, gauge));
  }
  return path;
}

std::string recorded(const std::filesystem::path& file, const std::string& taper = "0 s", double highest = 3) {
  return fmt::format(
      "[waves]\nkind = \"record\"\nheading = \"0 deg\"\nfile = \"{}\"\ngauge = \"({}, 0, 0) m\"\nlowest = \"0.3 "
      "rad/s\"\nhighest = \"{} rad/s\"\ntaper = \"{}\"\n",
      file.string(), gauge, highest, taper);
}

std::string scene(const std::string& waves_table, const std::string& more = {}) {
  return "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ngravity = \"9.81 m/s^2\"\ndepth = \"infinite\"\n" +
         waves_table + more;
}
const std::string ask_waves =
    "[[probe]]\nat = \"(0, 0, 0) m\"\n[ask]\nwaves = { duration = \"10 s\", every = \"0.5 s\" }\n";

// Components at multiples of 2π/T are exact: at the gauge as recorded, elsewhere by k = ω²/g (W1).
TEST(RecordedWaves, AreTheRecordAtTheGaugeAndGoOnByDispersion) {
  for (const double begin : {0.0, -4.0}) {
    const auto sea = compile::make_sea(froude_test::parse(scene(recorded(record(begin)), ask_waves)));
    for (const double t : {0.0, 3.7, 21.05, 44.4})
      for (const double x : {gauge, 0.0, 17.0})
        EXPECT_NEAR(sea.elevation(t, x, 5), surface(t, x), 1e-9) << t << " " << x;
  }
}

// Half of the record's waves go across: the phase at a place is that of the distance along the heading.
TEST(RecordedWaves, GoAlongTheirHeading) {
  std::string text = scene(recorded(record()), ask_waves);
  text.replace(text.find("0 deg"), 5, "90 deg");
  text.replace(text.find("(-12, 0, 0)"), 11, "(3, -12, 0)");
  const auto sea = compile::make_sea(froude_test::parse(text));
  for (const double y : {gauge, 8.0}) EXPECT_NEAR(sea.elevation(5.3, -30, y), surface(5.3, y), 1e-9);
}

TEST(RecordedWaves, AreTaperedAtTheEndsAndWithinTheirBand) {
  const auto sea = compile::make_sea(froude_test::parse(scene(recorded(record(), "10 s"), ask_waves)));
  EXPECT_NEAR(sea.elevation(30, gauge, 0), surface(30, gauge), 2e-3);  // ends that are cut leave little in the middle
  const double quarter = (1 - std::cos(pi / 2)) / 2;
  EXPECT_NEAR(sea.elevation(5, gauge, 0), quarter * surface(5, gauge), 2e-2);
  EXPECT_NEAR(sea.elevation(0, gauge, 0), 0, 2e-2);
  const auto low = compile::make_sea(froude_test::parse(scene(recorded(record(), "0 s", 2), ask_waves)));
  EXPECT_NEAR(low.elevation(3, 0, 0), surface(3, 0) - waves[3].at(3, 0), 1e-9);
  // Σ a²/2 of what is left out over that of all.
  const scene::Scene narrow = froude_test::parse(scene(recorded(record(), "0 s", 1.2), ask_waves));
  double all = 0, out = 0;
  for (const Wave& w : waves) all += w.a * w.a, out += w.omega() > 1.2 ? w.a * w.a : 0;
  EXPECT_NEAR(std::get<scene::WaveList>(narrow.waves->kind).recorded->left_out, out / all, 1e-9);
  EXPECT_THAT(compile::wave_warnings(narrow), testing::ElementsAre(HasSubstr("of the variance of the recorded waves")));
}

// A floating body moves in the record of a gauge as in the sea that made the record.
TEST(RecordedWaves, MoveABodyAsTheSeaThatMadeThem) {
  const auto list = support::scratch_folder() / "made_of.csv";
  {
    std::ofstream file(list);
    file << "omega [rad/s],amplitude [m],phase [rad]\n";
    for (const Wave& w : waves) file << fmt::format("{:.17g},{},{}\n", w.omega(), w.a, w.phase);
  }
  const std::string body = froude_test::floating_cylinder("0.2 rad/s .. 3 rad/s, 29 values") +
                           "[ask]\nrun = { duration = \"40 s\", every = \"0.5 s\" }\n";
  const auto made = simulate(froude_test::parse(
      scene("[waves]\nkind = \"components\"\nheading = \"0 deg\"\nfile = \"" + list.string() + "\"\n", body)));
  const auto measured = simulate(froude_test::parse(scene(recorded(record()), body)));
  EXPECT_EQ(made.stopped, "");
  for (const char* mode : {"b.surge", "b.heave", "b.pitch"}) {
    double largest = 0;
    for (const double x : made.signal(mode)) largest = std::max(largest, std::abs(x));
    ASSERT_GT(largest, 1e-3) << mode;
    for (std::size_t i = 0; i < made.time.size(); ++i)
      ASSERT_NEAR(measured.signal(mode)[i], made.signal(mode)[i], 1e-6 * largest) << mode << " at " << made.time[i];
  }
}

TEST(RecordedWaves, SayWhatIsWrongWithThem) {
  const auto refuses = [](const std::string& text, const char* with) {
    EXPECT_THAT([&] { compile::make_sea(froude_test::parse(text)); }, ThrowsMessage<InputError>(HasSubstr(with)));
  };
  const std::string good = scene(recorded(record()), ask_waves);
  const auto changed = [&](const char* from, const char* to) {
    std::string text = good;
    return text.replace(text.find(from), std::string(from).size(), to);
  };
  refuses(changed("taper = \"0 s\"", "taper = \"40 s\""), "more than half the record");
  refuses(changed("(-12, 0, 0)", "(-12, 0, 1)"), "above or below still water");
  refuses(changed("highest = \"3 rad/s\"", "highest = \"100 rad/s\""), "pi/dt");
  refuses(changed("taper = \"0 s\"", "column = \"surface\"\ntaper = \"0 s\""), "surface");
  EXPECT_THAT(
      [&] {
        simulate(froude_test::parse(
            scene(recorded(record()),
                  "[[body]]\nname = \"m\"\ncentre_of_gravity = \"(0, 0, 0) m\"\nmass = \"1 t\"\nradii_of_gyration = "
                  "\"(1, 1, 1) m\"\n[[member]]\non = \"m\"\nfrom = \"(0, 0, -2) m\"\nto = \"(0, 0, -1) m\"\ndiameter = "
                  "\"0.5 m\"\ndrag = { cd = 1 }\n[ask]\nrun = { duration = \"90 s\", every = \"0.5 s\" }\n")));
      },
      ThrowsMessage<InputError>(AllOf(HasSubstr("were recorded from 0 s to 59.95 s"), HasSubstr("0 s to 90 s"))));
}

// φ of (W8): the surface at the origin is a cos φ at t = 0.
TEST(RegularWave, HasThePhaseThatItIsGiven) {
  const std::string regular =
      "[waves]\nkind = \"regular\"\nheading = \"0 deg\"\namplitude = \"0.4 m\"\nperiod = \"5 s\"\n";
  const double omega = 2 * pi / 5, k = omega * omega / gravity;
  const auto sea = compile::make_sea(froude_test::parse(scene(regular + "phase = \"60 deg\"\n", ask_waves)));
  for (const double t : {0.0, 1.3})
    for (const double x : {0.0, 4.0})
      EXPECT_NEAR(sea.elevation(t, x, 0), 0.4 * std::cos(omega * t - k * x + pi / 3), 1e-12);
  EXPECT_NEAR(compile::make_sea(froude_test::parse(scene(regular, ask_waves))).elevation(0, 0, 0), 0.4, 1e-12);
  EXPECT_THAT([&] { froude_test::parse(scene(regular + "theory = \"stokes2\"\nphase = \"60 deg\"\n", ask_waves)); },
              ThrowsMessage<InputError>(HasSubstr("belongs to linear waves")));
}

}  // namespace
}  // namespace recorded_waves_test
