#include "hydro/base/error.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace hydro {

std::string Place::str() const {
  std::string out = file;
  if (line > 0) out += fmt::format(":{}", line);
  if (line > 0 && column > 0) out += fmt::format(":{}", column);
  return out;
}

namespace {

std::string composed(const std::string& rule, const Place& where, const std::string& remedy) {
  const std::string place = where.str();
  std::string out = place.empty() ? rule : place + ": error: " + rule;
  if (where.text.empty()) {
    if (!remedy.empty()) out += "\n  remedy: " + remedy;
    return out;
  }
  out += fmt::format("\n{:>6} | {}", where.line > 0 ? std::to_string(where.line) : "", where.text);
  if (where.column > 0) {
    out += fmt::format("\n       | {}{} {}", std::string(static_cast<std::size_t>(where.column - 1), ' '),
                       std::string(static_cast<std::size_t>(std::max(1, where.width)), '^'), remedy);
  } else if (!remedy.empty()) {
    out += "\n  remedy: " + remedy;
  }
  return out;
}

}  // namespace

InputError::InputError(std::string rule, Place where, std::string remedy)
    : std::runtime_error(composed(rule, where, remedy)),
      rule_(std::move(rule)),
      remedy_(std::move(remedy)),
      where_(std::move(where)) {}

InputError InputError::at(const Place& where) const {
  return where_.str().empty() ? InputError(rule_, where, remedy_) : *this;
}

void throw_input_error(fmt::string_view rule, fmt::format_args args) { throw InputError(fmt::vformat(rule, args)); }

void throw_broken_assumption(std::string_view what) {
  throw std::logic_error("broken assumption inside Froude (please report it): " + std::string(what));
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
}

}  // namespace hydro
