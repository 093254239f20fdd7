#pragma once
/// \file  Values of a scene written over by others: numbers that a fit moves, and whatever a program sets.
///
/// A path names a key as the echo of a result does: "water.density", "line[1].damping.linear", "joint.pto.damping",
/// "load.at.x". Of several tables with one heading the number counts from 1, or a name stands in its place:
/// "body.buoy.initial.heave". A single one needs neither.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "scene/scene.hpp"

namespace froude::scene {

/// A number is in the unit that the scene writes there, and stays an integer where it is one and the scene has one; a
/// text stands for the whole value, its unit included. A key that its table does not write is written there, as TOML
/// would have the value.
struct OverriddenValue {
  std::string path;
  std::variant<bool, std::int64_t, double, std::string> value;
};

/// What a scene writes at a path.
struct WrittenNumber {
  double value;
  std::string unit;  ///< as written; empty for a number without one
};
/// \throws hydro::InputError at `asked` if the scene writes no number there, with the nearest key
WrittenNumber number_at(std::string_view text, const std::filesystem::path& file, const std::string& path,
                        const Place& asked);

/// Where a text writes a value: its bytes [begin, end).
struct WrittenValue {
  enum class Form { text, integer, number, other, component };
  std::size_t begin, end;
  Form form;         ///< `component`: one of a vector, a bare number
  std::string unit;  ///< of a component: its vector's
};
/// Of a scene of any kind. \throws hydro::InputError at `asked` if nothing is written at the path, with the nearest
/// key, or what is goes over several lines
WrittenValue value_at(std::string_view text, const std::filesystem::path& file, const std::string& path,
                      const Place& asked);

/// A scene of motion that was read once, its includes too, of which scenes with other numbers are built.
class ChangeableScene {
 public:
  /// \throws hydro::InputError as parse()
  ChangeableScene(std::string_view text, std::filesystem::path file);
  /// What the scene writes at a path, these numbers in it. \throws hydro::InputError as number_at(), at the scene
  WrittenNumber number(const std::string& path, const std::vector<OverriddenValue>& values) const;
  /// With other values in these places. \throws hydro::InputError as parse() and number_at(), and where a table or list
  /// stands
  Scene with(const std::vector<OverriddenValue>& values) const;

 private:
  std::string text_;
  std::filesystem::path file_;
  std::shared_ptr<const struct Node> document_;
};

/// As parse(), with other values in these places. \throws hydro::InputError as ChangeableScene::with()
Scene parse_with(std::string_view text, const std::filesystem::path& file, const std::vector<OverriddenValue>& values);

/// Writes the values into a document. \throws hydro::InputError as ChangeableScene::with(), at the document
void override_values(struct Node& root, const std::vector<OverriddenValue>& values);

}  // namespace froude::scene
