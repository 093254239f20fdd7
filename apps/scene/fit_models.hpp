#pragma once
/// \file  From the tables of a fit scene to the model of each kind. Private to apps/scene.
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>

#include "scene/fit_scene.hpp"
#include "scene/record.hpp"

namespace froude::scene {

/// A word of a scene and what it stands for.
template <class T>
struct FitWord {
  std::string_view word;
  T value;
};

template <class T, std::size_t n>
T value_of_word(const FitWord<T> (&words)[n], const std::string& word) {
  for (const auto& known : words)
    if (known.word == word) return known.value;
  throw std::logic_error("the grammar lets a word pass that its reader does not know: " + word);
}

template <class T, std::size_t n>
std::string word_of_value(const FitWord<T> (&words)[n], T value) {
  for (const auto& known : words)
    if (known.value == value) return std::string(known.word);
  throw std::logic_error("there is a value for which the grammar has no word");
}

inline double hertz(const Record& record, const char* key) { return record.si(key) / (2 * std::numbers::pi); }
inline double given(const Record& record, const char* key) { return record.has(key) ? record.si(key) : 0.0; }

/// The tables that every kind of fit has.
struct FitTables {
  const Record& root;
  const std::filesystem::path& file;  ///< the scene

  const Record& data() const { return root.table("data"); }
  const Record& channels() const { return data().table("channels"); }
  const Record& model() const { return root.table("model"); }
  const Record& ask() const { return root.table("ask"); }
  double confidence() const { return ask().table("intervals").si("level"); }
};

// Each reads [model] of its kind with what [prepare] and [ask] have of it, and the channels that only it knows the
// rules of. \throws hydro::InputError, placed in the scene
FitModel read_morison(const FitTables& tables);
FitModel read_towing(const FitTables& tables);
FitModel read_decay(const FitTables& tables);
FitModel read_radiation(const FitTables& tables);
FitModel read_friction_ramp(const FitTables& tables);
FitModel read_motion(const FitTables& tables);

/// The steps of [prepare] but for the delay, which a force alone has.
::fit::PrepareOptions read_steps(const Record& root);

}  // namespace froude::scene
