#pragma once
/// \file  The grammar of scenes as data. Each table is declared once, beside what reads it (binding.hpp); from that one
///        declaration come the reader (record.hpp), its error messages, the echo, and key_reference().
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hydro/base/units.hpp"

namespace froude::scene {

struct Table;

/// What a key holds.
enum class Holds {
  text,    ///< "…"; one of Key::words if there are any
  name,    ///< text that begins with a letter, then letters, digits, _ and -
  texts,   ///< "…" or ["…", "…"]; each one of Key::words if there are any
  number,  ///< without dimension
  integer,
  effect,     ///< true; there is no false, because what is not named does not act
  quantity,   ///< "29.3 kN/m", or one of Key::words
  vector,     ///< "(0, 0, 1.31) m"
  points,     ///< "(±6, ±5, 0) m": a vector, or several by ±
  ends,       ///< a list of two `points`
  direction,  ///< "x", "y", "z", or "(1, 0, 1)" of any length but zero
  range,      ///< "2 s .. 8 s, 61 values"
  values,     ///< a range, or ["0 deg", "45 deg"]
  scalars,    ///< texts, numbers and booleans, one or a list: what another key may hold
  table,      ///< [header] or { … }
  tables      ///< [[header]], any number
};

/// The bound that a number or each component of a vector must keep; in the unit of the key, SI.
enum class Limit { none, positive, not_negative, at_least_one, fraction, open_fraction };

/// Is the key needed? Sources of defaults are in Key::fallback and Key::because.
enum class Need { required, optional, defaulted };

struct Key {
  std::string name;
  Holds holds = Holds::text;
  hydro::Dimension dimension = {};
  std::string meaning = {};  ///< one line, with the unit
  Need need = Need::required;
  std::string fallback = {};  ///< the default as the file would hold it, without quotes
  std::string because = {};   ///< why it is the default
  Limit limit = Limit::none;
  std::vector<std::string> words = {};   ///< texts allowed; for a quantity: texts that may stand instead
  const Table* inner = nullptr;          ///< of Holds::table and Holds::tables
  std::vector<std::string> beside = {};  ///< acts, and is accepted, only where one of these other keys is given

  // The declarations read as sentences: quantity("mass", dim::mass, "…").positive()
  Key& optional() { return need = Need::optional, *this; }
  Key& or_default(std::string value, std::string reason) {
    return need = Need::defaulted, fallback = std::move(value), because = std::move(reason), *this;
  }
  Key& within(Limit bound) { return limit = bound, *this; }
  Key& positive() { return within(Limit::positive); }
  Key& one_of(std::vector<std::string> texts) { return words = std::move(texts), *this; }
  Key& only_beside(std::string other) { return beside = {std::move(other)}, *this; }
  Key& only_beside_one_of(std::vector<std::string> others) { return beside = std::move(others), *this; }
};

/// Keys of which a certain number must be given.
struct Group {
  enum class Count { exactly_one, at_most_one, at_least_one } count;
  std::vector<std::string> keys;
};

struct Table {
  std::string title;  ///< as written: "[water]", "[[body]]", "[ask.rao]"
  std::string meaning;
  std::vector<Key> keys;
  std::vector<Group> groups = {};

  /// Further keys that come with one word of the key `chosen_by` (always "kind").
  struct Variant {
    std::string word, meaning;
    std::vector<Key> keys;
    std::vector<Group> groups = {};
  };
  std::string chosen_by = {};
  std::vector<Variant> variants = {};
};

Key text(std::string name, std::string meaning);
Key name_key(std::string fallback, std::string meaning);  ///< "" as fallback: required
Key texts(std::string name, std::string meaning);
Key modes(std::string name, std::string meaning);  ///< texts that name motions of a body
Key number(std::string name, std::string meaning);
Key integer(std::string name, std::string meaning);
Key effect(std::string name, std::string meaning);
Key quantity(std::string name, const hydro::Dimension& dimension, std::string meaning);
Key positive(std::string name, const hydro::Dimension& dimension, std::string meaning);  ///< a quantity above zero
Key vector(std::string name, const hydro::Dimension& dimension, std::string meaning);
Key points(std::string name, std::string meaning);
Key ends(std::string name, std::string meaning);
Key direction(std::string name, std::string meaning);
Key range(std::string name, const hydro::Dimension& dimension, std::string meaning);
Key values(std::string name, const hydro::Dimension& dimension, std::string meaning);
Key scalars(std::string name, std::string meaning);  ///< Value::texts hold them as TOML writes them
Key inner_table(std::string name, const Table& inner);
Key inner_tables(std::string name, const Table& inner);

/// The unit that the reference, the errors and the echo speak in: "N/m" rather than "kg/s^2".
std::string si_unit(const hydro::Dimension& dimension);

/// "must be positive" …; "" for Limit::none.
std::string_view rule_of(Limit limit);
bool keeps(Limit limit, double value);

const Table& motion_schema();  ///< root of a scene of motion

/// Markdown of one root and of all tables below it.
std::string reference_of(const Table& root);

}  // namespace froude::scene
