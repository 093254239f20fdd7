#pragma once
/// \file  Numbers of a scene written over by others: what a fit moves.
///
/// A path names a key as the echo of a result does: "water.density", "line[1].damping.linear", "joint.pto.damping",
/// "load.at.x". Of several tables with one heading the number counts from 1, or a name stands in its place:
/// "body.buoy.initial.heave". A single one needs neither.
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.hpp"

namespace froude::scene {

struct OverriddenNumber {
  std::string path;
  double value;  ///< in the unit that the scene writes there
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
  WrittenNumber number(const std::string& path, const std::vector<OverriddenNumber>& numbers) const;
  /// With other numbers in these places. \throws hydro::InputError as parse() and number_at()
  Scene with(const std::vector<OverriddenNumber>& numbers) const;

 private:
  std::string text_;
  std::filesystem::path file_;
  std::shared_ptr<const struct Node> document_;
};

/// As parse(), with other numbers in these places. \throws hydro::InputError as parse() and number_at()
Scene parse_with(std::string_view text, const std::filesystem::path& file,
                 const std::vector<OverriddenNumber>& numbers);

/// Writes the numbers into a document. \throws hydro::InputError as number_at(), at the document
void override_numbers(struct Node& root, const std::vector<OverriddenNumber>& numbers);

}  // namespace froude::scene
