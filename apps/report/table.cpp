// Tables of other commands as they stand in a CSV file.
#include <algorithm>
#include <sstream>

#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv.hpp"
#include "report/contents.hpp"

namespace froude::html {

namespace {

constexpr std::size_t most_numbers_of_table = 800'000;

/// Comments above the header: what the table is.
Json comments_of(const std::string& text) {
  Json out = Json::array();
  std::istringstream in(text);
  for (std::string line; std::getline(in, line) && line.starts_with('#');)
    out.push_back(line.substr(std::min(line.find_first_not_of("# "), line.size())));
  return out;
}

}  // namespace

Json table_contents(const std::filesystem::path& path) {
  const std::string text = hydro::io::read_text(path);
  const auto table = hydro::io::CsvTable::parse(text, path.string());
  Json out{{"kind", "table"}, {"name", path.filename().string()}, {"title", ""}, {"facts", Json::array()}};
  out["notes"] = comments_of(text);
  Json columns = Json::array();
  std::vector<std::string> names;
  for (const std::string& name : table.names())
    if (!table.is_text(name)) names.push_back(name);
  if (names.size() < 2 || table.rows() < 2 || table.is_text(table.names().front()))
    throw hydro::InputError(
        "a table to be drawn has two columns of numbers and two rows, and the first is the abscissa",
        {.file = path.string()}, "give a table that `froude psd` or `froude response` wrote");
  const Thinning thinning(table.rows(), std::max<std::size_t>(200, most_numbers_of_table / names.size()));
  for (const std::string& name : names) {
    const auto& values = table.values(name);
    const bool abscissa = columns.empty();
    columns.push_back({{"name", name},
                       {"unit", table.has_known_unit(name) ? table.dimension(name).si() : table.unit_text(name)},
                       {"values", double_array(abscissa ? thinning.times(values) : thinning.values(values))}});
  }
  out["columns"] = columns;
  out["piece"] = thinning.piece();
  return out;
}

}  // namespace froude::html
