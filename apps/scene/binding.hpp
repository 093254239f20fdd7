#pragma once
/// \file  A table of the grammar bound to the members of a struct.
///
/// One line a key says what may be written (schema.hpp) and where it goes:
///
///   static const Binding<Load> binding =
///       Binding<Load>("[[load]]", "a force that stays as it is")
///           .key(vector("force", dim::force, "global axes"), &Load::force)
///           .key(quantity("from", dim::time, "when it begins").optional(), &Load::from);
///
/// From it come the schema, its documentation, errors and echo (table()), and the reader (read()). A binding keeps
/// those within it; the outermost is a static of a function.
#include <array>
#include <concepts>
#include <filesystem>
#include <functional>
#include <memory>
#include <type_traits>
#include <utility>

#include "scene/record.hpp"

namespace froude::scene {
namespace detail {

template <class M>
struct IsOptional : std::false_type {};
template <class M>
struct IsOptional<std::optional<M>> : std::true_type {};
template <class M>
struct IsLocated : std::false_type {};
template <class M>
struct IsLocated<Located<M>> : std::true_type {};

/// A value that was read, as a member of this type holds it. A word that stands instead of a quantity leaves an
/// optional empty.
template <class M>
void put(const Value& from, M& to) {
  if constexpr (IsOptional<M>::value) {
    using Held = typename M::value_type;
    constexpr bool quantity = std::floating_point<Held> || std::same_as<Held, Located<double>>;
    if (quantity && !from.text.empty()) return to.reset();
    to.emplace();
    put(from, *to);
  } else if constexpr (IsLocated<M>::value) {
    put(from, to.value);
    to.place = from.place;
  } else if constexpr (std::same_as<M, bool>) {
    to = true;  // an effect: there is no false
  } else if constexpr (std::floating_point<M>) {
    to = from.number;
  } else if constexpr (std::integral<M>) {
    to = static_cast<M>(from.integer);
  } else if constexpr (std::same_as<M, std::string>) {
    to = from.text;
  } else if constexpr (std::same_as<M, Eigen::Vector3d>) {
    to = from.points.front().front();
  } else if constexpr (std::same_as<M, std::vector<Eigen::Vector3d>>) {
    to = from.points.front();
  } else if constexpr (std::same_as<M, std::vector<double>>) {
    to = from.range;
  } else if constexpr (std::same_as<M, hydro::Angle>) {
    to = hydro::Angle::from_radians(from.number);
  } else if constexpr (std::same_as<M, hydro::WaterDepth>) {
    to = from.text.empty() ? hydro::WaterDepth::from_metres(from.number) : hydro::WaterDepth::infinite();
  } else if constexpr (std::same_as<M, std::filesystem::path>) {
    to = beside(from.place.file, from.text);
  } else if constexpr (std::same_as<M, std::array<bool, 6>>) {
    to.fill(false);  // of the six modes, those that are named
    for (const auto& mode : from.texts) to[static_cast<std::size_t>(hydro::parse_mode(mode.value))] = true;
  } else {
    static_assert(std::same_as<M, std::vector<std::string>>, "no value of a scene is held by this type");
    to.assign(from.texts.begin(), from.texts.end());
  }
}

}  // namespace detail

/// Words of a scene and what each stands for.
template <class M>
using Words = std::vector<std::pair<std::string, M>>;

template <class M>
std::vector<std::string> words_of(const Words<M>& words) {
  std::vector<std::string> out;
  for (const auto& [word, meant] : words) out.push_back(word);
  return out;
}
/// What a word stands for; the grammar lets no other pass.
template <class M>
const M& value_for(const Words<M>& words, const std::string& text) {
  for (const auto& [word, meant] : words)
    if (word == text) return meant;
  throw std::logic_error("the grammar lets a word pass that its reader does not know: " + text);
}
/// The word for a value that has one.
template <class M>
const std::string& word_for(const Words<M>& words, const M& value) {
  for (const auto& [word, meant] : words)
    if (meant == value) return word;
  throw std::logic_error("there is a value for which the grammar has no word");
}

namespace detail {

/// What bindings of all structs have alike, compiled once; the struct itself is only pointed to.
class Steps {
 public:
  explicit Steps(Table table) : table_(std::move(table)) {}
  const Table& table() const { return table_; }

 protected:
  /// A key and what is done with its value, where it is there.
  void add_key(Key key, std::function<void(const Value&, void*)> put);
  void add_step(std::function<void(const Record&, void*)> step) { steps_.push_back(std::move(step)); }
  /// Keys of another table, and rules between them.
  void append(const Table& part);
  void add_variant(const std::string& word, const Table& of);
  void refuse_more_than(std::int64_t most);
  void take(const Record& record, void* out) const {
    for (const auto& step : steps_) step(record, out);
  }

  Table table_;

 private:
  std::vector<std::function<void(const Record&, void*)>> steps_;
};

}  // namespace detail

template <class T>
class Binding : private detail::Steps {
 public:
  Binding(std::string title, std::string meaning)
      : Steps({.title = std::move(title), .meaning = std::move(meaning), .keys = {}}) {}
  /// Of keys that no member holds.
  explicit Binding(Table table) : Steps(std::move(table)) {}
  using Steps::table;

  /// A key and the member, of T or of a base, that takes its value, in SI. The member keeps what it was made with where
  /// the key is not there.
  template <class M, class B>
  Binding& key(Key key, M B::*member) {
    return put(std::move(key), [member](const Value& value, T& out) { detail::put(value, out.*member); });
  }
  /// The same of a member's member.
  template <class I, class M>
  Binding& key(Key key, I T::*outer, M I::*member) {
    return put(std::move(key), [=](const Value& value, T& out) { detail::put(value, out.*outer.*member); });
  }
  /// A key and what is done with its value, where it is there.
  template <std::invocable<const Value&, T&> Put>
  Binding& key(Key key, Put given) {
    return put(std::move(key), std::move(given));
  }
  /// A key that a reader or check of the caller's own looks up in the record.
  Binding& key(Key key) {
    table_.keys.push_back(std::move(key));
    return *this;
  }
  /// A key that may be left out.
  template <class... Member>
  Binding& optional(Key key, Member... member) {
    return this->key(std::move(key.optional()), member...);
  }
  Binding& keys(std::vector<Key> keys) {
    for (Key& one : keys) key(std::move(one));
    return *this;
  }
  /// A text that is one of these words, each of which stands for a value.
  template <class M>
  Binding& words(Key key, const Words<M>& words, M T::*member) {
    return put(std::move(key.one_of(words_of(words))),
               [words, member](const Value& value, T& out) { out.*member = value_for(words, value.text); });
  }
  /// A list of words, each of which sets a member.
  Binding& flags(Key key, const std::vector<std::pair<std::string, bool T::*>>& words) {
    for (const auto& [word, member] : words) key.words.push_back(word);
    return put(std::move(key), [words](const Value& value, T& out) {
      for (const auto& [word, member] : words)
        for (const auto& given : value.texts)
          if (given.value == word) out.*member = true;
    });
  }
  /// A table within this one, which may be left out where the member is a std::optional. A member that other keys fill
  /// too keeps what they gave.
  template <class I, class M>
  Binding& table(const std::string& name, const Binding<I>& inner, M T::*member) {
    Key key = inner_table(name, inner.table());
    if (detail::IsOptional<M>::value) key.optional();
    return nested(key, inner, [member](const Binding<I>& of, const Record& record, T& out) {
      of.read_member(record, out.*member);
    });
  }
  /// One that may be left out, whose keys are read into this very struct, or into a base of it.
  template <class B>
  Binding& table(const std::string& name, const Binding<B>& inner) {
    return nested(inner_table(name, inner.table()).optional(), inner,
                  [](const Binding<B>& of, const Record& record, T& out) { of.read_into(record, out); });
  }
  /// As many tables as there are; one at least unless the key is optional().
  template <class I, class B>
  Binding& tables(const std::string& name, const Binding<I>& inner, std::vector<I> B::*member) {
    return nested(
        inner_tables(name, inner.table()), inner,
        [member](const Binding<I>& of, const Record& record, T& out) { (out.*member).push_back(of.read(record)); });
  }
  /// Keys of this table, and rules between them, that a member is read from.
  template <class I, class M, class B>
  Binding& part(const Binding<I>& of, M B::*member) {
    append(of.table());
    return then([of, member](const Record& record, T& out) { of.read_member(record, out.*member); });
  }
  /// The same, read into this very struct.
  Binding& part(const Binding<T>& of) {
    append(of.table());
    return then([of](const Record& record, T& out) { of.read_into(record, out); });
  }
  /// A member that every such table sets to the same.
  template <class M>
  Binding& sets(M T::*member, M value) {
    return then([member, value](const Record&, T& out) { out.*member = value; });
  }
  /// Where the table stands.
  Binding& place(Place T::*member) {
    return then([member](const Record& record, T& out) { out.*member = record.place(); });
  }

  Binding& exactly_one_of(std::vector<std::string> keys) { return group(Group::Count::exactly_one, std::move(keys)); }
  Binding& at_most_one_of(std::vector<std::string> keys) { return group(Group::Count::at_most_one, std::move(keys)); }
  Binding& at_least_one_of(std::vector<std::string> keys) { return group(Group::Count::at_least_one, std::move(keys)); }
  /// The last key may be left out; its member then stays as it was made.
  Binding& optional() {
    table_.keys.back().optional();
    return *this;
  }
  /// The last key, a table, may not be left out;
  Binding& needed() {
    table_.keys.back().need = Need::required;
    return *this;
  }
  /// or where it is left out, it is read as if it were there and empty.
  Binding& or_default() {
    table_.keys.back().or_default("", "see its keys");
    return *this;
  }
  /// The last key only where one of these others is given.
  Binding& only_beside(std::vector<std::string> others) {
    table_.keys.back().only_beside_one_of(std::move(others));
    return *this;
  }
  /// The last key, an integer, up to this.
  Binding& at_most(std::int64_t most) {
    refuse_more_than(most);
    return *this;
  }

  /// What the keys one by one cannot know: called with the record and what was read of it. \throws hydro::InputError
  template <std::invocable<const Record&, T&> Step>
  Binding& then(Step step) {
    add_step([step = std::move(step)](const Record& record, void* out) { step(record, *static_cast<T*>(out)); });
    return *this;
  }

  /// Further keys for one word of `kind`, the key that must have been added, read into the same struct.
  Binding& variant(const std::string& word, const Binding<T>& of) {
    add_variant(word, of.table());
    return then([word, of](const Record& record, T& out) {
      if (record.text("kind") == word) of.read_into(record, out);
    });
  }
  /// The same, read into one alternative of a member.
  template <class V, class... All>
  Binding& variant(const std::string& word, const Binding<V>& of, std::variant<All...> T::*member) {
    add_variant(word, of.table());
    return then([word, of, member](const Record& record, T& out) {
      if (record.text("kind") == word) out.*member = of.read(record);
    });
  }

  T read(const Record& record) const {
    T out{};
    read_into(record, out);
    return out;
  }
  void read_into(const Record& record, T& out) const { take(record, &out); }
  /// Into a member that is such a struct, or is to hold one.
  template <class M>
  void read_member(const Record& record, M& member) const {
    if constexpr (std::same_as<M, T>)
      read_into(record, member);
    else
      member = read(record);
  }

 private:
  template <class Put>
  Binding& put(Key key, Put given) {
    add_key(std::move(key),
            [given = std::move(given)](const Value& value, void* out) { given(value, *static_cast<T*>(out)); });
    return *this;
  }
  /// A key of one table or several, each of which `read_one` reads with a copy of their binding.
  template <class I, class Read>
  Binding& nested(Key key, const Binding<I>& inner, Read read_one) {
    const auto own = std::make_shared<const Binding<I>>(inner);
    key.inner = &own->table();
    return this->put(std::move(key), [own, read_one](const Value& value, T& out) {
      for (const Record& record : value.records) read_one(*own, record, out);
    });
  }
  Binding& group(Group::Count count, std::vector<std::string> keys) {
    table_.groups.push_back({count, std::move(keys)});
    return *this;
  }
};

}  // namespace froude::scene
