#include "scene/binding.hpp"

#include <fmt/format.h>

namespace froude::scene::detail {

void Steps::add_key(Key key, std::function<void(const Value&, void*)> put) {
  add_step([name = key.name, put = std::move(put)](const Record& record, void* out) {
    if (record.has(name)) put(record[name], out);
  });
  table_.keys.push_back(std::move(key));
}

void Steps::append(const Table& part) {
  table_.keys.insert(table_.keys.end(), part.keys.begin(), part.keys.end());
  table_.groups.insert(table_.groups.end(), part.groups.begin(), part.groups.end());
}

void Steps::add_variant(const std::string& word, const Table& of) {
  table_.chosen_by = "kind";
  table_.variants.push_back({word, of.meaning, of.keys, of.groups});
}

void Steps::refuse_more_than(std::int64_t most) {
  add_step([name = table_.keys.back().name, most](const Record& record, void*) {
    if (record.has(name) && record[name].integer > most) throw record.wrong(name, fmt::format("is more than {}", most));
  });
}

}  // namespace froude::scene::detail
