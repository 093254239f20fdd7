// What rules connectors reads signals of the run: a switch by name, a controller of the caller's by asking.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answers/simulate.hpp"
#include "apps/compile/scenes.hpp"
#include "compile/control.hpp"
#include "hydro/base/error.hpp"

namespace control_test {
namespace {

using namespace froude;
using froude_test::parse;
using froude_test::water;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// 2 kg on a spring of 0.5 N/m, which swings in 4π s, in waves of 4 s that it does not feel. By the period of what is
/// watched the spring becomes 0.7 N/m, 0.6 N/m for waves.
std::string swinging(const std::string& watch) {
  return water +
         "[waves]\nkind = \"regular\"\ntheory = \"linear\"\nheight = \"0.2 m\"\nperiod = \"4 s\"\nheading = \"0 deg\"\n"
         "[[body]]\nname = \"m\"\nmass = \"2 kg\"\nfree = [\"surge\"]\ninitial.surge = \"0.1 m\"\n"
         "[[connector]]\nname = \"spring\"\nkind = \"axial\"\nbetween = [\"m\", \"ground\"]\n"
         "ends = [\"(0, 0, 0) m\", \"(10, 0, 0) m\"]\nstiffness = \"0.5 N/m\"\nrest_length = \"as placed\"\n"
         "[connector.switch]\nwatch = \"" +
         watch +
         "\"\nevery = \"10 s\"\nwindow = \"60 s\"\nhysteresis = \"0.001 Hz\"\n"
         "settings = [{ from = \"0 s\", stiffness = \"0.6 N/m\" }, { from = \"8 s\", stiffness = \"0.7 N/m\" }]\n"
         "[ask]\nrun = { duration = \"90 s\", every = \"0.1 s\" }\n";
}

/// When the spring was first switched, and to what.
std::pair<double, double> first_switch(const Run& run) {
  const auto& k = run.signal("spring.stiffness");
  for (std::size_t i = 1; i < k.size(); ++i)
    if (k[i] != k[0]) return {run.time[i], k[i]};
  return {0, k[0]};
}

// The window is full at the check at 60 s (its first sample stands for the step before it), the next one agrees; a sum
// of steps may miss an instant by one.
TEST(Switch, WatchesAnySignal) {
  const std::pair<const char*, double> expected[] = {{"m.surge", 0.7}, {"spring.force", 0.7}, {"wave.elevation", 0.6}};
  for (const auto& [watch, stiffness] : expected) {
    const auto [time, set] = first_switch(simulate(parse(swinging(watch))));
    EXPECT_NEAR(time, 70, 0.11) << watch;
    EXPECT_EQ(set, stiffness) << watch;
  }
}

TEST(Switch, NamesASignalThatThereIsNot) {
  EXPECT_THAT(
      [] { simulate(parse(swinging("m.surg"))); },
      ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("test.toml:24:9"), HasSubstr("no signal is called \"m.surg\""),
                                             HasSubstr("did you mean \"m.surge\"?"))));
  EXPECT_THAT([] { simulate(parse(swinging("m.*"))); }, ThrowsMessage<hydro::InputError>(HasSubstr("\"m.*\"")))
      << "one signal is watched, not a pattern";
}

/// A bob on a hinge with a rope to the bed, held aside by a spring, in waves.
const std::string tied =
    water +
    "[waves]\nkind = \"regular\"\ntheory = \"linear\"\nheight = \"0.2 m\"\nperiod = \"4 s\"\nheading = \"0 deg\"\n"
    "[[body]]\nname = \"bob\"\nposition = \"(0, 0, -1) m\"\ncentre_of_gravity = \"(0, 0, 0) m\"\nmass = \"2 kg\"\n"
    "radii_of_gyration = \"(0.2, 0.2, 0.2) m\"\nweight = true\ninitial_velocity = { surge = \"0.5 m/s\", pitch = "
    "\"-0.5 rad/s\" }\n"
    "[[joint]]\nname = \"pivot\"\nkind = \"hinge\"\nbetween = [\"bob\", \"ground\"]\nat = \"(0, 0, 0) m\"\naxis = "
    "\"y\"\n"
    "[[connector]]\nname = \"spring\"\nkind = \"axial\"\nbetween = [\"bob\", \"ground\"]\n"
    "ends = [\"(0, 0, 0) m\", \"(5, 0, -1) m\"]\nstiffness = \"5 N/m\"\nrest_length = \"as placed\"\n"
    "[[line]]\nname = \"rope\"\nfrom = \"(0, 0, 0) m\"\nto = \"(1.5, 0, -2) m\"\nlength = \"2.5 m\"\nsegments = 5\n"
    "on = { from = \"bob\" }\nmass_per_length = \"0.1 kg/m\"\naxial_stiffness = \"2 kN\"\ndiameter = \"10 mm\"\n"
    "[line.morison]\ncd = 1.2\nca = 1.0\n"
    "[[line]]\nname = \"stray\"\nfrom = \"(9, 0, -1) m\"\nto = \"(9, 2, -1) m\"\nlength = \"3 m\"\nsegments = 5\n"
    "mass_per_length = \"0.1 kg/m\"\ndiameter = \"10 mm\"\n"
    "[line.morison]\ncd = 1.2\nca = 1.0\n"
    "[ask]\nrun = { duration = \"0.5 s\", every = \"0.01 s\" }\n[solve]\nstep = \"0.01 s\"\n";

// Where nothing is switched, what a controller reads at the ends of steps is what the record has there, to the bit.
TEST(Controllers, ReadWhatTheRecordHas) {
  const std::vector<std::string> names{
      "bob.pitch",         "pivot.bob.force_z", "pivot.angle",    "spring.force",   "rope.link1.tension",
      "stray.link2.polar", "stray.from.force",  "wave.elevation", "energy.kinetic", "energy.stray.kinetic"};
  std::vector<std::vector<double>> read(names.size());
  const auto run = simulate(parse(tied), {}, {{"spring", [&](const Sample& sample) -> std::optional<double> {
                                                 for (std::size_t i = 0; i < names.size(); ++i)
                                                   read[i].push_back(sample[names[i]]);
                                                 return {};
                                               }}});
  ASSERT_EQ(run.stopped, "");
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto& recorded = run.signal(names[i]);
    ASSERT_EQ(read[i].size() + 1, recorded.size()) << names[i];
    for (std::size_t n = 0; n < read[i].size(); ++n) ASSERT_EQ(read[i][n], recorded[n + 1]) << names[i] << " " << n;
    EXPECT_NE(read[i].front(), read[i].back()) << names[i] << " does change";
  }
}

TEST(Controllers, SetTheStiffnessByATension) {
  const auto alone = simulate(parse(tied));
  const auto& before = alone.signal("rope.link1.tension");
  const auto [least, most] = std::minmax_element(before.begin(), before.end());
  const auto stiffness_at = [between = (*least + *most) / 2](double tension) { return tension > between ? 8.0 : 5.0; };
  const auto run = simulate(parse(tied), {}, {{"spring", [&](const Sample& sample) -> std::optional<double> {
                                                 return stiffness_at(sample["rope.link1.tension"]);
                                               }}});
  const auto &tension = run.signal("rope.link1.tension"), &stiffness = run.signal("spring.stiffness");
  for (std::size_t i = 1; i < tension.size(); ++i) EXPECT_EQ(stiffness[i], stiffness_at(tension[i])) << i;
  EXPECT_THAT(stiffness, AllOf(Contains(8.0), Contains(5.0)));
}

TEST(Controllers, NameWhatThereIsNot) {
  const auto run_asking = [](const std::function<double(const Sample&)>& what) {
    return simulate(parse(tied), {}, {{"spring", what}});
  };
  EXPECT_THAT([&] { run_asking([](const Sample& s) { return s["rope.link1.tensin"]; }); },
              ThrowsMessage<hydro::InputError>(HasSubstr("did you mean \"rope.link1.tension\"?")));
  EXPECT_THAT([&] { run_asking([](const Sample& s) { return s.velocity("rob")[0]; }); },
              ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("no body \"rob\""), HasSubstr("bob"))));
  const auto ended = run_asking([](const Sample& s) { return s["bob.pitch"] / 0.0; });
  EXPECT_THAT(ended.stopped, HasSubstr("N/m at t = 0.01 s"));
  EXPECT_EQ(ended.time.size(), 1u) << "what was computed before is kept";
}

// One signal is watched: the others cost nothing.
TEST(Controllers, ComputeWhatIsWatchedOnly) {
  const scene::Scene scene = parse(swinging("m.surge"));
  const compile::TimeModel model = compile::time_model(scene, compile::prepare(scene));
  std::vector<compile::Signal> signals = compile::signal_list(scene, model);
  std::map<std::string, int> computed;
  for (compile::Signal& s : signals)
    s.value = [&computed, name = s.name, value = s.value](const compile::Moment& now) {
      ++computed[name];
      return value(now);
    };
  compile::Controllers controllers(model.rules, signals);
  dynamics::Workspace workspace(model.model, model.start);
  const dynamics::EnergyLedger ledger(model.model, workspace);
  for (int i = 0; i < 3; ++i) controllers.decide({model.model, workspace, ledger, {}});
  EXPECT_EQ(computed, (std::map<std::string, int>{{"m.surge", 3}}));
}

}  // namespace
}  // namespace control_test
