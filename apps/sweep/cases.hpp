#pragma once
/// \file  The cases of a study: which value each axis has in each of them, and the text of the scene that says so.
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scene/override.hpp"
#include "sweep/study.hpp"

namespace froude::sweep {

/// What stands in a field of the table; nothing where the case has none.
using Cell = std::variant<std::monostate, double, std::string>;

struct Column {
  std::string name;
  std::string unit;      ///< as the axis writes it; of outputs SI; empty for a number or text
  bool is_text = false;  ///< an axis of words or files
};

/// A value of an axis.
struct AxisValue {
  std::string toml;              ///< as the study writes it; empty where it comes of a range
  std::optional<double> number;  ///< in `unit`; empty for a word
  std::string unit;
};

class Cases {
 public:
  /// The study, the text of its scene, and the files that this names. \throws hydro::InputError at a key that the scene
  /// does not write, a value that cannot stand there, axes that go along each other and differ in length, a picture
  /// that its axes do not make
  Cases(const Study& study, std::string scene_text, const std::vector<std::filesystem::path>& files);

  /// Cases count from 1; the last axis changes first.
  std::size_t count() const { return count_; }
  /// The scene of a case: its text with other values, comments and all.
  std::string scene(std::size_t number) const;
  const std::vector<Column>& columns() const { return columns_; }  ///< one an axis
  std::vector<Cell> cells(std::size_t number) const;
  /// Why a case is not to be run; empty where it is.
  std::optional<std::string> skipped(std::size_t number) const;
  /// All that a result depends on, a line each: program, scene and its files, axes, outputs. Equal studies have equal
  /// ones.
  const std::string& definition() const { return definition_; }

 private:
  /// Values that change together.
  struct Group {
    std::vector<std::size_t> axes;
    std::size_t length;
  };
  /// Where the text of the scene holds what an axis changes.
  struct Slot {
    std::size_t axis;
    scene::WrittenValue at;
    Located<std::string> key;
  };

  void read_values();
  void draw_samples(const std::vector<std::size_t>& sampled);
  void group_axes();
  void find_slots();
  void check_skips() const;
  void check_pictures() const;
  std::vector<std::size_t> indices(std::size_t number) const;
  std::string written(const Slot& slot, const AxisValue& value) const;
  std::size_t column(const std::string& axis) const;
  std::optional<double> measure(const Skip& skip, std::size_t number) const;
  std::string unit_of(const Skip& skip) const;
  std::string defined(const std::vector<std::filesystem::path>& files) const;

  const Study& study_;
  std::string text_;
  std::vector<std::vector<AxisValue>> values_;  // by axis
  std::vector<Group> groups_;
  std::vector<Slot> slots_;  // by rising place in the text
  std::vector<Column> columns_;
  std::size_t count_ = 0;
  std::string definition_;
};

}  // namespace froude::sweep
