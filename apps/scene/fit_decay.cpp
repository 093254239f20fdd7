/// \file  Fits of kind "decay": period and damping of a body let go.
#include <algorithm>

#include "scene/fit_tables.hpp"

namespace froude::scene {
namespace {

void check_channels(const FitTables& t, const DecayModel& decay) {
  const Record& channels = t.channels();
  if (decay.motion.pendulum && channels.has("position"))
    throw t.model().wrong("restoring", "is by the sine of an angle, and the channel position is a length",
                          "name the channel angle, or take restoring = \"linear\"");
  if (channels.has("angle") == channels.has("position"))
    throw channels.refused("needs either position or angle for a fit of kind \"decay\"",
                           "name the column of the motion");
}

/// A motion is fitted as it was recorded: few steps come before.
void check_steps(const FitTables& t, const DecayModel& decay) {
  if (!t.root.has("prepare")) return;
  const Record& prepare = t.root.table("prepare");
  for (const Key& key : prepare_binding().table().keys) {
    if (key.name == "longest_gap" || key.name == "outliers" || key.name == "window") continue;
    if (prepare.has(key.name) && !prepare[key.name].defaulted)
      throw prepare.wrong(key.name, not_of_kind(DecayModel::kind),
                          "leave it out: what is fitted is the motion as it was recorded");
  }
  if (decay.prepare.window.kind == ::fit::WindowChoice::Kind::full_cycles)
    throw prepare.table("window").wrong("kind", "must be \"span\" for a decay, which has no cycles of full amplitude");
}

/// The terms that are asked for; true if a memory is among them.
bool read_terms(const FitTables& t, ::fit::DampingTerms& terms) {
  terms = {.linear = false};
  bool memory = false;
  const std::pair<std::string_view, bool*> known[] = {{"linear", &terms.linear},
                                                      {"quadratic", &terms.quadratic},
                                                      {"cubic", &terms.cubic},
                                                      {"coulomb", &terms.coulomb},
                                                      {"memory", &memory}};
  for (const auto& c : wanted(t, {"linear", "quadratic", "cubic", "coulomb", "memory"}, "[\"linear\", \"quadratic\"]",
                              "a decay knows linear, quadratic, cubic, coulomb and memory"))
    for (const auto& [name, asked] : known)
      if (c.value == name) *asked = true;
  return memory;
}

::fit::DecayMemoryOptions memory_of(const FitTables& t, const ::fit::DecayOptions& options) {
  const Record& model = t.model();
  if (!model.has("start"))
    throw model.refused("needs \"start\" for a memory: what does the radiation memory hold at the first sample?",
                        "add start = \"let go from rest\" if the record begins there, or start = \"in motion\"");
  if (options.terms.coulomb)
    throw t.ask().wrong("coefficients",
                        "may not hold coulomb beside memory: a body at rest would not be at rest for good",
                        "leave one of them out");
  if (options.pendulum)
    throw model.wrong("restoring", "must be linear with a memory: radiation is known for small motions",
                      "leave it out");
  return {.terms = options.terms,
          .starts_empty = model.text("start") == "let go from rest",
          .confidence = options.confidence};
}

}  // namespace

Binding<DecayModel> decay_keys() {
  return Binding<DecayModel>(
             "", "period and damping of a body let go: x'' + b1 x' + b2 |x'| x' + b3 x'^3 + c sgn x' + w0^2 x = 0")
      .key(text("restoring", "by x, or by sin x for a pendulum")
               .one_of({"linear", "sine"})
               .or_default("linear", "small angles, and all that floats"),
           [](const Value& v, DecayModel& decay) { decay.motion.pendulum = v.text == "sine"; })
      .optional(
          text("start",
               "with memory among the coefficients: the record begins where the body was let go from rest in calm "
               "water, with an empty radiation memory; or in motion, and what that memory holds is fitted")
              .one_of({"let go from rest", "in motion"}))
      .table("body", restored_body(), &DecayModel::body);
}

void finish(const FitTables& t, FitScene& scene, DecayModel& decay) {
  read_channels(t, {"time", "position", "angle"}, {"time"}, scene);
  check_steps(t, decay);
  check_channels(t, decay);
  if (decay.body) check_restored(t);
  if (decay.body && !(decay.body->stiffness > 0))
    throw t.model().table("body").refused("needs a stiffness: without one there is no natural period",
                                          "give what brings the body back");
  decay.motion.confidence = scene.confidence;
  if (read_terms(t, decay.motion.terms))
    decay.memory = memory_of(t, decay.motion);
  else if (t.model().has("start"))
    throw t.model().wrong("start", "does not act without a memory",
                          "add \"memory\" to [ask] coefficients, or leave it out");
  if (decay.together && t.data().has("files") && scene.files.size() < 2)
    throw t.ask().wrong("together", "needs two files at least", "name more files, or leave it out");
}

}  // namespace froude::scene
