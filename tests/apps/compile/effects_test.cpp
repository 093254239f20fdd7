// What a scene does not name is not made, not evaluated and not stepped; what it names is, and that alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "answers/linear_response.hpp"
#include "answers/simulate.hpp"
#include "compile/compile.hpp"
#include "effect_examples.hpp"
#include "scene/document.hpp"
#include "scene/schema.hpp"
#include "scenes.hpp"
#include "support/allocations.hpp"

namespace effects_test {
namespace {

using namespace froude;
using effects::Example;
using scene::Holds;
using scene::Key;
using scene::Node;
using scene::Table;
using testing::IsEmpty;
using testing::UnorderedElementsAreArray;

scene::Scene read(const Example& example) {
  static const effects::Files files;
  return scene::parse(example.text, files.scene());
}

// ---- every table, kind and effect of the grammar has an example ----

/// Tables by their titles, kinds as "[waves] regular", effects as "[[body]] weight".
using Paths = std::set<std::string>;

void add_paths(const Table& table, Paths& out) {
  const auto add = [&](const std::string& title, const std::vector<Key>& keys) {
    out.insert(title);
    for (const Key& key : keys) {
      if (key.holds == Holds::effect) out.insert(title + " " + key.name);
      if (key.inner != nullptr) add_paths(*key.inner, out);
    }
  };
  add(table.title, table.keys);
  for (const Table::Variant& kind : table.variants) add(table.title + " " + kind.word, kind.keys);
}

/// What of the grammar stands in a file.
void add_named(const Node& node, const Table& table, Paths& out) {
  const auto add = [&](const std::string& title, const std::vector<Key>& keys) {
    out.insert(title);
    for (const Key& key : keys) {
      const Node::Entry* entry = node.find(key.name);
      if (entry == nullptr) continue;
      if (key.holds == Holds::effect) out.insert(title + " " + key.name);
      if (key.inner == nullptr) continue;
      if (entry->value.is(Node::Type::table)) add_named(entry->value, *key.inner, out);
      for (const Node& item : entry->value.items) add_named(item, *key.inner, out);
    }
  };
  add(table.title, table.keys);
  for (const Table::Variant& kind : table.variants)
    if (const Node::Entry* chosen = node.find(table.chosen_by); chosen != nullptr && chosen->value.text == kind.word)
      add(table.title + " " + kind.word, kind.keys);
}

// The grammar itself is walked: what is added to it has no example yet, and is listed here as missing.
TEST(Effects, OfTheGrammarAllHaveAnExample) {
  Paths grammar, shown;
  add_paths(scene::motion_schema(), grammar);
  for (const Example& example : effects::examples())
    add_named(scene::parse_document(example.text, example.name), scene::motion_schema(), shown);
  add_named(scene::parse_document(effects::of_responses_alone().text, "responses"), scene::motion_schema(), shown);
  Paths missing;
  std::set_difference(grammar.begin(), grammar.end(), shown.begin(), shown.end(),
                      std::inserter(missing, missing.end()));
  EXPECT_GT(grammar.size(), 100u) << "the walk went nowhere";
  EXPECT_THAT(missing, IsEmpty()) << "add a scene to tests/apps/compile/effect_examples.cpp";
}

// ---- what is named acts, and nothing else does ----

std::vector<std::string> kinds_of(const dynamics::Model& model) {
  std::vector<std::string> out;
  for (const auto& kind : model.forces()) out.push_back(kind->effect());
  return out;
}

TEST(Effects, OfASceneThatNamesNoneAreNone) {
  const auto scene = read(effects::without_effects());
  const auto model = compile::time_model(scene, compile::prepare(scene));
  EXPECT_THAT(kinds_of(model.model), IsEmpty());
  EXPECT_THAT(model.lines, IsEmpty());
  EXPECT_FALSE(model.water.sea);
  EXPECT_EQ(model.model.joints().count(), 0);
  dynamics::Workspace workspace(model.model, model.start);
  EXPECT_THAT(workspace.memory, IsEmpty());
  EXPECT_THAT(simulate(scene).evaluations, IsEmpty());
}

TEST(Effects, AreThoseThatTheSceneNamesAndNoOther) {
  for (const Example& example : effects::examples()) {
    SCOPED_TRACE(example.name);
    const froude::Run run = simulate(read(example));
    EXPECT_TRUE(run.stopped.empty()) << run.stopped;
    std::vector<std::string> evaluated;
    for (const auto& [kind, count] : run.evaluations) {
      evaluated.push_back(kind);
      EXPECT_GE(count, run.steps) << kind << ": once a step at least";
    }
    EXPECT_THAT(evaluated, UnorderedElementsAreArray(example.kinds));
  }
}

// As many elements as the scene has, and as many systems of lines; a member counts its pieces where these are what is
// summed.
TEST(Effects, HaveAsManyElementsAsTheSceneNames) {
  for (const Example& example : effects::examples()) {
    SCOPED_TRACE(example.name);
    const auto scene = read(example);
    const auto model = compile::time_model(scene, compile::prepare(scene));
    EXPECT_THAT(kinds_of(model.model), UnorderedElementsAreArray(example.kinds));
    EXPECT_EQ(model.lines.size(), example.lines);
    for (const auto& kind : model.model.forces())
      if (kind->effect() != "drag") {
        EXPECT_EQ(kind->elements(), 1u) << kind->effect();
      }
  }
}

// ---- what the step loop asks of the allocator ----

/// Allocations from one sample to the next once the run is under way: the middle one of all. Single ones have more,
/// where factors are made anew or friction changes.
std::size_t allocations_of_a_sample(const scene::Scene& scene) {
  const auto prepared = compile::prepare(scene);
  const auto model = compile::time_model(scene, prepared);
  std::vector<std::size_t> at;
  at.reserve(model.steps);
  const froude::Run run = run_model(scene, model, [&](double) { at.push_back(support::allocations()); });
  EXPECT_EQ(at.size() + 1, run.time.size()) << run.stopped;
  std::vector<std::size_t> each;
  for (std::size_t i = 3; i < at.size(); ++i) each.push_back(at[i] - at[i - 1]);
  const auto middle = each.begin() + static_cast<std::ptrdiff_t>(each.size() / 2);
  std::nth_element(each.begin(), middle, each.end());
  return *middle;
}

struct Asked {
  double step, sample;
};

/// Of a step, and of telling a sample: from samples after one step and after four.
Asked allocations(const Example& example) {
  scene::Scene scene = read(example);
  const double step = scene.solve.step->value;
  const auto one = static_cast<double>(allocations_of_a_sample(scene));
  scene.solve.step = scene::Located<double>{step / 4, {}};
  const auto four = static_cast<double>(allocations_of_a_sample(scene));
  return {(four - one) / 3, one - (four - one) / 3};
}

TEST(Effects, AskForNoMemoryInAStepNorToTellASample) {
  for (const Example& example : effects::examples()) {
    const Asked asked = allocations(example);
    EXPECT_EQ(asked.step, 0) << example.name;
    EXPECT_EQ(asked.sample, 0) << example.name;
  }
}

TEST(Effects, AskForNoMemoryInAStepWhileLawsHoldOrSlip) {
  for (const Example& example : effects::held_by_laws()) {
    const Asked asked = allocations(example);
    EXPECT_EQ(asked.step, 0) << example.name;
    EXPECT_EQ(asked.sample, 0) << example.name;
  }
}

// A module that is alike on both sides answers a push in heave with heave alone, and as much as it ever does.
TEST(Excitation, ActsOnTheModesThatTheSceneNames) {
  const auto responses = [](const std::string& modes) {
    return respond(froude_test::parse(froude_test::water + R"([[body]]
name = "m"
mass = "9088 kg"
centre_of_gravity = "(0, 0, 1.31) m"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
free = ["surge", "heave", "pitch"]
[body.hydrodynamics]
file = "pontoon1.nc"
excitation = true
)" + modes + R"(radiation = {}
hydrostatics = true
[ask]
rao = { periods = "3 s .. 6 s, 4 values", heading = "0 deg" }
)"));
  };
  const Responses all = responses(""), heave = responses("excitation_modes = \"heave\"\n");
  for (std::size_t i = 0; i < all.omega.size(); ++i) {
    EXPECT_GT(std::abs(all.signal("m.surge").values[i]), 0.1);
    // The data are symmetric to 1e-4 of their largest entries.
    EXPECT_LT(std::abs(heave.signal("m.surge").values[i]), 1e-3);
    EXPECT_LT(std::abs(heave.signal("m.heave").values[i] - all.signal("m.heave").values[i]), 1e-3);
  }
}

}  // namespace
}  // namespace effects_test
