#pragma once
/// \file  What a command tells, as one tree: lines of text for people, JSON and TOML for programs. Each fact is told
/// once.
#include <fmt/format.h>

#include <Eigen/Core>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace froude {

inline constexpr double degree = std::numbers::pi / 180;  ///< rad

struct Console;

using Json = nlohmann::ordered_json;  ///< results keep the order in which they are told

template <class T>
constexpr bool is_optional = false;
template <class T>
constexpr bool is_optional<std::optional<T>> = true;

/// What is absent is null, a vector is a list and a matrix a list of rows.
template <class T>
Json json_of(const T& value) {
  if constexpr (is_optional<T>) {
    return value ? json_of(*value) : Json();
  } else if constexpr (std::is_base_of_v<Eigen::DenseBase<T>, T>) {
    Json out = Json::array();
    for (Eigen::Index i = 0; i < value.rows(); ++i)
      if constexpr (T::ColsAtCompileTime == 1)
        out.push_back(value[i]);
      else
        out.push_back(json_of(value.row(i).transpose().eval()));
    return out;
  } else {
    return Json(value);
  }
}

/// A value in a sentence that programs find too, unless it is absent. A slash in its key goes down a level:
/// "metacentre/gm_least_m".
template <class Shown>
struct Fact {
  std::string key;
  Json value;
  Shown shown;  ///< formatted in the sentence
};
template <class T>
Fact<std::decay_t<T>> fact(std::string key, T&& value) {
  return {std::move(key), json_of(value), value};
}
/// `shown` stands in the sentence in the value's place: an angle in degrees, a word for what is absent.
template <class T, class Shown>
Fact<std::decay_t<Shown>> fact(std::string key, const T& value, Shown&& shown) {
  return {std::move(key), json_of(value), std::forward<Shown>(shown)};
}

/// Text and tree grow together, in the order in which things are told. Keys of parts and rows are taken as they are,
/// so names of signals and bodies may be keys.
class Report {
 public:
  /// A line for people; the facts among the arguments are kept for programs.
  template <class... Args>
  Report& say(fmt::format_string<Args...> line, Args&&... args) {
    (keep_if_fact(args), ...);
    lines_.push_back(fmt::format(line, std::forward<Args>(args)...));
    return *this;
  }
  /// A fact for programs alone; what is absent is null.
  template <class T>
  Report& keep(const std::string& key, const T& value) {
    place_of(key) = json_of(value);
    return *this;
  }
  /// One line for each sentence, such as "note: {}"; a list in the tree, which is there though it be empty.
  Report& sentences(const std::string& key, fmt::format_string<const std::string&> line,
                    const std::vector<std::string>& all);
  /// A report within this one: its lines follow, its tree stands under `key` or, if that is empty, in this one's.
  Report& part(const std::string& key, Report inner);
  /// The same as the next entry of the list `key`.
  Report& one_of(const std::string& key, Report inner);
  /// A line whose facts are the next entry of the list `key`.
  template <class... Args>
  Report& row(const std::string& key, fmt::format_string<Args...> line, Args&&... args) {
    return one_of(key, Report().say(line, std::forward<Args>(args)...));
  }
  /// That a file was written, if it was asked for; in the tree one of the list `written`.
  Report& wrote(const std::optional<std::filesystem::path>& file);

  /// The same facts for programs alone.
  Report untold() const;
  const std::vector<std::string>& lines() const { return lines_; }
  std::string text() const;  ///< the lines, each with its end
  const Json& tree() const { return tree_; }

 private:
  template <class T>
  void keep_if_fact(const Fact<T>& f) {
    if (!f.value.is_null()) place_of(f.key) = f.value;
  }
  template <class T>
  void keep_if_fact(const T&) {}
  Json& place_of(const std::string& key);

  std::vector<std::string> lines_;
  Json tree_ = Json::object();
};

/// The tree as TOML under a line of comment; what is null is left out.
std::string toml_of(const Json& tree, const std::string& comment);

/// As the console wants it: the text, or the tree as one JSON document.
void tell(const Report& report, const Console& console);
/// Its text now, if the console is a person's, who need not wait for the whole; programs are told that by tell().
const Report& tell_people(const Report& part, const Console& console);

}  // namespace froude

template <class Shown>
struct fmt::formatter<froude::Fact<Shown>> : fmt::formatter<Shown> {
  template <class Context>
  auto format(const froude::Fact<Shown>& fact, Context& out) const {
    return fmt::formatter<Shown>::format(fact.shown, out);
  }
};
