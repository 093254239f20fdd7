#pragma once
/// \file  The two ways in which Froude may refuse, and the one style in which it says so.
///
/// InputError     what the user gave is wrong; the program ends with exit status 2.
/// NumericsError  the input is right, the numerics gave up; exit status 3.
/// A broken assumption of our own is std::logic_error, thrown by ensure() in builds with FROUDE_AUDIT.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>

namespace hydro {

/// A place in a file that a person can open. Line and column count from 1; 0 means unknown.
struct Place {
  std::string file = {};
  int line = 0;
  int column = 0;
  std::string text = {};  ///< the offending line as it stands in the file, without its newline
  int width = 0;          ///< how many characters from `column` on are at fault; 0: mark the column only

  /// "file:line:column", leaving out what is not known.
  std::string str() const;
};

/// The user's mistake: says where, what rule was broken, and what to do.
///
///   scene.toml:29:20: error: output.every = "0.02 m" is a length; a time is needed
///      29 | every = "0.02 m"
///         |         ^^^^^^^^ write a time with its unit, for example "0.02 s"
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::string rule, Place where = {}, std::string remedy = {});

  const std::string& rule() const noexcept { return rule_; }
  const Place& where() const noexcept { return where_; }
  const std::string& remedy() const noexcept { return remedy_; }

  /// The same error, placed where the caller knows it to be; a place already known is kept.
  InputError at(const Place& where) const;

 private:
  std::string rule_, remedy_;
  Place where_;
};

/// The numerics stopped for a stated reason: a step that could not be halved further, a singular matrix, a NaN.
class NumericsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// InputError with the rule that the arguments fill in: the part of require() that does not depend on their types.
[[noreturn]] void throw_input_error(fmt::string_view rule, fmt::format_args args);

/// Throws InputError unless `condition` holds: for the user's mistakes, always on.
template <class... Args>
void require(bool condition, fmt::format_string<Args...> rule, Args&&... args) {
  if (!condition) throw_input_error(rule, fmt::make_format_args(args...));
}

[[noreturn]] void throw_broken_assumption(std::string_view what);

/// Checks an assumption of our own; compiled in with FROUDE_AUDIT only.
inline void ensure([[maybe_unused]] bool condition, [[maybe_unused]] std::string_view what) {
#ifdef FROUDE_AUDIT
  if (!condition) throw_broken_assumption(what);
#endif
}

/// Levenshtein distance: the least number of characters inserted, dropped or replaced.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `word` by edit distance, or "" when none is near enough to be meant.
template <class Range>
std::string nearest(std::string_view word, const Range& candidates) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, word.size() / 2) + 1;
  for (const auto& candidate : candidates) {
    const std::size_t d = edit_distance(word, candidate);
    if (d < best_distance) {
      best_distance = d;
      best = candidate;
    }
  }
  return best;
}

}  // namespace hydro
