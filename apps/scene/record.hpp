#pragma once
/// \file  The one reader of all tables: walks a TOML tree with its declaration and gives back checked values in SI.
#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scene/document.hpp"
#include "scene/scene.hpp"
#include "scene/schema.hpp"

namespace froude::scene {

class Record;

/// One value that was read or filled in. Only the fields that belong to Key::holds are filled.
struct Value {
  std::string name;  ///< "[water] density"; keys of the root stand alone
  Place place;       ///< of the value; of the table where the value was filled in
  bool defaulted = false;
  std::string shown;  ///< as the file holds it: `"0.02 m"`, `3.3`
  std::string text;   ///< text and name; the word that stands instead of a quantity, else empty
  double number = 0;  ///< number and quantity, SI
  std::int64_t integer = 0;
  std::vector<std::vector<Eigen::Vector3d>> points;  ///< vector: [0][0]; points: [0]; ends: [0] and [1]
  std::vector<double> range;                         ///< range and values, SI
  std::vector<Located<std::string>> texts;
  std::vector<Record> records;  ///< table: one; tables: as many as there are

  /// The error "[title] key = value rule" at the value.
  [[nodiscard]] hydro::InputError wrong(const std::string& rule, const std::string& remedy = {}) const;
};

/// A table that was read: every needed key is there, every value is of its type, dimension and bound.
class Record {
 public:
  Record(const Table& table, Place place) : table_(&table), place_(std::move(place)) {}

  /// Given in the file or filled in.
  bool has(std::string_view key) const { return values_.find(key) != values_.end(); }
  /// Of a key that is there; asking for another is a mistake of ours.
  const Value& operator[](std::string_view key) const;
  double si(std::string_view key) const { return (*this)[key].number; }
  const std::string& text(std::string_view key) const { return (*this)[key].text; }
  Eigen::Vector3d vector(std::string_view key) const { return (*this)[key].points.front().front(); }
  const Record& table(std::string_view key) const { return (*this)[key].records.front(); }
  /// As many as there are; none where the key is not there.
  const std::vector<Record>& tables(std::string_view key) const;

  const Place& place() const { return place_; }
  const std::string& title() const { return table_->title; }

  [[nodiscard]] hydro::InputError wrong(std::string_view key, const std::string& rule,
                                        const std::string& remedy = {}) const {
    return (*this)[key].wrong(rule, remedy);
  }
  /// The error "[title] rule" at the table.
  [[nodiscard]] hydro::InputError refused(const std::string& rule, const std::string& remedy = {}) const;

  void set(const std::string& key, Value value) { values_.insert_or_assign(key, std::move(value)); }

 private:
  const Table* table_;
  Place place_;
  std::map<std::string, Value, std::less<>> values_;
};

/// A file beside the scene.
std::filesystem::path beside(const std::filesystem::path& scene, const std::string& relative);

/// Reads `root` as the table `schema`, appends to `echo` one line for each key that acts.
/// \throws hydro::InputError on an unknown key, a missing one, a wrong type, unit, dimension or bound
Record read_record(const Node& root, const Table& schema, std::vector<Echo>& echo);

}  // namespace froude::scene
