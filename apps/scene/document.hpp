#pragma once
/// \file  A TOML file as a tree in which every key and value knows its place. The only door to the TOML library.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "hydro/base/error.hpp"

namespace froude::scene {

/// A value of the file. Only the field that belongs to `type` is filled.
struct Node {
  enum class Type { table, list, text, integer, number, boolean, date };
  struct Entry;

  Type type = Type::table;
  hydro::Place place;          ///< of the value; of a table written as [header]: the header
  std::string raw;             ///< as it stands in the file, its first line only
  std::string text;            ///< Type::text
  std::int64_t integer = 0;    ///< Type::integer
  double number = 0;           ///< Type::number, and Type::integer as a double
  bool boolean = false;        ///< Type::boolean
  std::vector<Node> items;     ///< Type::list
  std::vector<Entry> entries;  ///< Type::table, in the order of the file

  const Entry* find(std::string_view key) const;
  bool is(Type wanted) const { return type == wanted; }
};

struct Node::Entry {
  std::string key;
  hydro::Place place;  ///< of the key
  Node value;
};

/// "text", "an integer" … as a person would call the type.
std::string_view type_name(Node::Type type);

/// Parses TOML 1.0. `file` only names the text in errors.
/// \throws hydro::InputError at line and column if the text is not TOML, or a key or table stands twice
Node parse_document(std::string_view text, const std::string& file);

/// The byte of a text at which a place of it begins.
std::size_t byte_at(std::string_view text, const hydro::Place& place);

}  // namespace froude::scene
