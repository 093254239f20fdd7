#include "scene/record.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "scene/read_value.hpp"

namespace froude::scene {
namespace {

using hydro::InputError;

/// One table being read: the keys it may hold, its own and those of the chosen kind.
class TableReader {
 public:
  TableReader(const Node& node, const Table& table, std::string path, std::vector<Echo>& echo)
      : node_(node), table_(table), path_(std::move(path)), echo_(echo), record_(table, node.place) {}

  Record read() {
    for (const Key& key : table_.keys) add(key);
    groups_ = table_.groups;
    if (!table_.chosen_by.empty()) choose_kind();
    for (const auto& entry : node_.entries) check_known(entry);
    for (const Group& group : groups_) check_group(group);
    for (const Key* key : keys_) read_key(*key);
    return std::move(record_);
  }

 private:
  void add(const Key& key) {
    keys_.push_back(&key);
    if (key.name != table_.chosen_by || table_.variants.empty()) return;
    kind_key_ = key;
    for (const auto& variant : table_.variants) kind_key_.words.push_back(variant.word);
    keys_.back() = &kind_key_;
  }

  /// "[waves]", or "[waves] of kind "regular"" once that is known.
  std::string title() const {
    return kind_.empty() ? table_.title : fmt::format("{} of kind \"{}\"", table_.title, kind_);
  }

  void choose_kind() {
    const auto* entry = node_.find(table_.chosen_by);
    if (entry == nullptr) throw missing(kind_key_);
    const std::string word = read_value(entry->value, kind_key_, table_.title).text;
    for (const auto& variant : table_.variants) {
      if (variant.word != word) continue;
      kind_ = word;
      for (const Key& key : variant.keys) add(key);
      groups_.insert(groups_.end(), variant.groups.begin(), variant.groups.end());
    }
  }

  void check_known(const Node::Entry& entry) const {
    std::vector<std::string> known;
    for (const Key* key : keys_) known.push_back(key->name);
    if (std::find(known.begin(), known.end(), entry.key) != known.end()) return;
    throw InputError(fmt::format("unknown key \"{}\" in {}", entry.key, title()), entry.place, meant(entry.key, known));
  }

  /// What to do about an unknown key: the other kind it belongs to, the key that was meant, or all keys there are.
  std::string meant(const std::string& word, const std::vector<std::string>& known) const {
    for (const auto& variant : table_.variants)
      for (const Key& key : variant.keys)
        if (key.name == word)
          return fmt::format("\"{}\" belongs to kind \"{}\"; leave it out here", word, variant.word);
    for (const auto& key : known)
      if (parts(key) == parts(word)) return fmt::format("did you mean \"{}\"?", key);
    const std::string near = hydro::nearest(word, known);
    if (!near.empty()) return fmt::format("did you mean \"{}\"?", near);
    return fmt::format("the keys here are {}", fmt::join(known, ", "));
  }

  /// pitch_surge and surge_pitch have the same parts.
  static std::multiset<std::string> parts(const std::string& word) {
    std::multiset<std::string> out;
    for (std::size_t from = 0; from <= word.size();) {
      const std::size_t to = std::min(word.find('_', from), word.size());
      out.insert(word.substr(from, to - from));
      from = to + 1;
    }
    return out;
  }

  void check_group(const Group& group) const {
    std::vector<const Node::Entry*> given;
    for (const auto& entry : node_.entries)
      if (std::find(group.keys.begin(), group.keys.end(), entry.key) != group.keys.end()) given.push_back(&entry);
    if (given.empty() && group.count != Group::Count::at_most_one) {
      const bool exactly = group.count == Group::Count::exactly_one;
      throw InputError(
          fmt::format("{} needs {} of {}", title(), exactly ? "one" : "at least one", fmt::join(group.keys, ", ")),
          node_.place, exactly ? "give one of them" : "name what shall act");
    }
    if (given.size() > 1 && group.count != Group::Count::at_least_one)
      throw InputError(fmt::format("{} may hold only one of {}; {} stands at line {}", title(),
                                   fmt::join(group.keys, ", "), given[0]->key, given[0]->place.line),
                       given[1]->place, "keep one of them");
  }

  /// Another key of an "only one" group is given, so no default is due.
  bool replaced(const Key& key) const {
    for (const Group& group : groups_) {
      if (group.count == Group::Count::at_least_one) continue;
      const auto has = [&](const std::string& name) { return name != key.name && node_.find(name) != nullptr; };
      if (std::find(group.keys.begin(), group.keys.end(), key.name) != group.keys.end() &&
          std::any_of(group.keys.begin(), group.keys.end(), has))
        return true;
    }
    return false;
  }

  InputError missing(const Key& key) const {
    return InputError(fmt::format("{} needs the key \"{}\"", title(), key.name), node_.place,
                      fmt::format("add {}", example(key)));
  }

  void read_key(const Key& key) {
    const auto* entry = node_.find(key.name);
    const bool acts =
        key.beside.empty() || std::any_of(key.beside.begin(), key.beside.end(),
                                          [&](const std::string& other) { return node_.find(other) != nullptr; });
    if (entry != nullptr && !acts) {
      const std::string others = fmt::format("\"{}\"", fmt::join(key.beside, "\" or \""));
      throw InputError(fmt::format("{} {} acts only beside {}", title(), key.name, others), entry->place,
                       fmt::format("leave it out, or add {}", others));
    }
    if (entry != nullptr) {
      store(key, entry->value, false);
    } else if (key.need == Need::required) {
      throw missing(key);
    } else if (key.need == Need::defaulted && acts && !replaced(key)) {
      store(key, default_node(key, node_.place), true);
    }
  }

  void store(const Key& key, const Node& node, bool defaulted) {
    const std::string path = path_.empty() ? key.name : path_ + "." + key.name;
    Value value;
    if (key.holds == Holds::table || key.holds == Holds::tables) {
      value = read_tables(key, node, path);
    } else {
      value = read_value(node, key, table_.title);
      echo_.push_back({path, echo_text(node), defaulted});
    }
    value.name = table_.title.starts_with('[') ? table_.title + " " + key.name : key.name;
    value.defaulted = defaulted;
    record_.set(key.name, std::move(value));
  }

  Value read_tables(const Key& key, const Node& node, const std::string& path) {
    Value value;
    value.place = node.place;
    if (key.holds == Holds::table) {
      check_table(node, key, table_.title);
      value.records.push_back(TableReader(node, *key.inner, path, echo_).read());
      return value;
    }
    check_list_of_tables(node, key);
    for (std::size_t i = 0; i < node.items.size(); ++i)
      value.records.push_back(TableReader(node.items[i], *key.inner, fmt::format("{}[{}]", path, i + 1), echo_).read());
    return value;
  }

  const Node& node_;
  const Table& table_;
  std::string path_;
  std::vector<Echo>& echo_;
  Record record_;
  std::string kind_;
  Key kind_key_;
  std::vector<const Key*> keys_;
  std::vector<Group> groups_;
};

}  // namespace

const Value& Record::operator[](std::string_view key) const {
  const auto found = values_.find(key);
  if (found == values_.end()) throw std::logic_error(fmt::format("{} has no value {}", title(), key));
  return found->second;
}

const std::vector<Record>& Record::tables(std::string_view key) const {
  static const std::vector<Record> none;
  return has(key) ? (*this)[key].records : none;
}

InputError Value::wrong(const std::string& rule, const std::string& remedy) const {
  return InputError(fmt::format("{}{} {}", name, shown.empty() ? "" : " = " + shown, rule), place, remedy);
}

InputError Record::refused(const std::string& rule, const std::string& remedy) const {
  return InputError(fmt::format("{} {}", title(), rule), place_, remedy);
}

Record read_record(const Node& root, const Table& schema, std::vector<Echo>& echo) {
  return TableReader(root, schema, "", echo).read();
}

}  // namespace froude::scene
