#include "sweep/table.hpp"

#include <fmt/format.h>

#include "hydro/io/atomic_file.hpp"
#include "sweep/csv_fields.hpp"

namespace froude::sweep {

namespace fs = std::filesystem;

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}
std::string csv_field(const Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return fmt::format("{}", *number);
  const auto* text = std::get_if<std::string>(&cell);
  return text == nullptr ? "" : csv_field(*text);
}
std::string csv_header(const Column& column) {
  return csv_field(column.unit.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit));
}

fs::path write_table(const Store& store) {
  std::string out = "case";
  for (const auto* all : {&store.identity().axes, &store.columns()})
    for (const Column& column : *all) out += "," + csv_header(column);
  out += ",state,reason,warnings\n";
  for (const Row& row : store.rows()) {
    out += fmt::format("{}", row.number);
    for (const Cell& cell : row.axes) out += "," + csv_field(cell);
    for (std::size_t i = 0; i < store.columns().size(); ++i)
      out += "," + (row.numbers.empty() ? std::string() : csv_field(row.numbers[i]));
    out += fmt::format(",{},{},{}\n", name_of(row.state), csv_field(row.reason), csv_field(row.warnings));
  }
  const fs::path file = store.folder() / "table.csv";
  hydro::io::write_atomically(file, out);
  return file;
}

}  // namespace froude::sweep
