#include "scene/edit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "scene/document.hpp"

namespace froude::scene {
namespace {

using hydro::InputError;

/// "body[2]": a key, and which table of a list; 1 where nothing is said.
struct Step {
  std::string key;
  std::size_t index = 1;
};

std::vector<Step> steps_of(const std::string& path) {
  std::vector<Step> out;
  for (std::size_t from = 0; from <= path.size();) {
    const std::size_t to = std::min(path.find('.', from), path.size());
    Step step{path.substr(from, to - from)};
    if (const std::size_t open = step.key.find('['); open != std::string::npos) {
      std::from_chars(step.key.data() + open + 1, step.key.data() + step.key.size(), step.index);
      step.key.resize(open);
    }
    out.push_back(std::move(step));
    from = to + 1;
  }
  return out;
}

/// "integrator.name" of the steps from `first` on.
std::string dotted(const std::vector<Step>& steps, std::size_t first, std::size_t end) {
  std::vector<std::string> keys;
  for (std::size_t i = first; i < end; ++i) keys.push_back(steps[i].key);
  return fmt::format("{}", fmt::join(keys, "."));
}

/// As far as the path leads in a document.
struct Way {
  const Node* table;                   ///< the last table that is there
  const Node::Entry* entry = nullptr;  ///< the key itself, if it is there
  std::size_t walked = 0;              ///< steps to the table
};

Way follow(const Node& root, const std::vector<Step>& steps) {
  Way out{&root};
  while (out.walked < steps.size()) {
    const Step& step = steps[out.walked];
    const Node::Entry* entry = out.table->find(step.key);
    if (entry == nullptr) return out;
    if (out.walked + 1 == steps.size()) return out.entry = entry, out;
    const Node* next = &entry->value;
    if (next->is(Node::Type::list)) {
      if (step.index == 0 || step.index > next->items.size())
        throw InputError(fmt::format("there is no {} {}, of {}", step.key, step.index, next->items.size()), next->place,
                         "count from 1");
      next = &next->items[step.index - 1];
    }
    out.table = next;
    ++out.walked;
  }
  return out;
}

/// A text under change, with places as errors count them: lines and columns from 1, columns in characters.
class Text {
 public:
  Text(std::string& text, const std::string& file) : text_(text), file_(file) {}

  void write(const TextEdit& edit) {
    const Node root = parse_document(text_, file_);
    const std::vector<Step> steps = steps_of(edit.path);
    const Way way = follow(root, steps);
    if (way.entry != nullptr)
      edit.value.empty() ? take_out(*way.entry, *way.table) : replace(way.entry->value, edit.value);
    else if (!edit.value.empty())
      put_in(way, steps, edit.value);
  }

 private:
  std::size_t begin_of_line(int line) const {
    std::size_t at = 0;
    for (int n = 1; n < line; ++n) at = text_.find('\n', at) + 1;
    return at;
  }
  std::size_t end_of_line(int line) const { return std::min(text_.find('\n', begin_of_line(line)), text_.size()); }
  std::size_t begin_of(const hydro::Place& place) const { return byte_at(text_, place); }
  /// Behind a value that stands on one line.
  std::size_t end_of(const Node& value) const { return begin_of(value.place) + value.raw.size(); }

  void replace(const Node& old, const std::string& value) {
    text_.replace(begin_of(old.place), end_of(old) - begin_of(old.place), value);
  }
  void take_out(const Node::Entry& entry, const Node& table) {
    std::size_t from = begin_of(entry.place), to = end_of(entry.value);
    if (!is_inline(table)) {
      from = begin_of_line(entry.place.line);
      to = std::min(end_of_line(entry.place.line) + 1, text_.size());
    } else if (const std::size_t next = text_.find_first_not_of(' ', to); text_[next] == ',') {
      to = text_.find_first_not_of(' ', next + 1);
    } else if (const std::size_t before = text_.find_last_not_of(' ', from - 1); text_[before] == ',') {
      from = before;
    }
    text_.erase(from, to - from);
  }

  static bool is_inline(const Node& table) { return table.raw.starts_with('{'); }
  /// A table may be there because of its inner ones alone, [solve] because of [solve.integrator].
  static bool has_header(const Node& table, const std::string& path) {
    std::string header = table.raw;
    std::erase_if(header, [](char c) { return c == '[' || c == ']' || c == ' '; });
    return table.raw.starts_with('[') && header == path;
  }

  void put_in(const Way& way, const std::vector<Step>& steps, const std::string& value) {
    const std::string last = dotted(steps, way.walked, steps.size()), path = dotted(steps, 0, way.walked);
    if (way.walked > 0 && is_inline(*way.table)) return put_between_braces(*way.table, last + " = " + value);
    if (way.walked > 0 && has_header(*way.table, path)) return put_below(way.table->place.line, last + " = " + value);
    if (way.walked > 1 || (way.walked == 1 && !way.table->raw.starts_with('[')))
      throw InputError(fmt::format("\"{}\" cannot be written here: the table has neither a header nor braces", last),
                       way.table->place, fmt::format("write the table as [{}]", path));
    if (steps.size() == 1) return void(text_.insert(0, last + " = " + value + "\n"));
    append("[" + dotted(steps, 0, steps.size() - 1) + "]\n" + steps.back().key + " = " + value + "\n");
  }
  void put_between_braces(const Node& table, const std::string& line) {
    const std::size_t brace = end_of(table) - 1;
    const std::size_t last = text_.find_last_not_of(' ', brace - 1);
    text_.replace(last + 1, brace - last - 1, (text_[last] == '{' ? " " : ", ") + line + " ");
  }
  void put_below(int line, const std::string& what) {
    const std::size_t end = end_of_line(line);
    const bool carriage_return = end > 0 && text_[end - 1] == '\r';
    text_.insert(carriage_return ? end - 1 : end, (carriage_return ? "\r\n" : "\n") + what);
  }
  void append(const std::string& section) {
    if (!text_.empty() && text_.back() != '\n') text_ += '\n';
    text_ += "\n" + section;
  }

  std::string& text_;
  const std::string& file_;
};

}  // namespace

std::string edited(std::string text, const std::string& file, const std::vector<TextEdit>& edits) {
  for (const TextEdit& edit : edits) Text(text, file).write(edit);
  return text;
}

}  // namespace froude::scene
