// What other sweeps of the same study have, and ranks of the same sweep, taken over.
#include <fmt/format.h>

#include <algorithm>

#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "sweep/series.hpp"
#include "sweep/sweep.hpp"

namespace froude::sweep {
namespace {

namespace fs = std::filesystem;
using hydro::InputError;

/// The same case of two sweeps. What takes time, and how often it was tried, may differ.
bool agree(const Row& a, const Row& b) {
  return a.state == b.state && a.reason == b.reason && a.warnings == b.warnings && a.axes == b.axes &&
         a.numbers == b.numbers;
}

enum class Series { copied, moved };

void take_series(const fs::path& from, const Row& row, const fs::path& into, Series how) {
  if (row.series.empty() || has_series(into, row)) return;
  if (!has_series(from, row))
    throw InputError(fmt::format("\"{}\" is torn or missing", (from / row.series).string()), {},
                     "run that sweep again, which redoes the case");
  fs::create_directories((into / row.series).parent_path());
  if (how == Series::moved)
    fs::rename(from / row.series, into / row.series);
  else
    hydro::io::write_atomically(into / row.series, hydro::io::read_text(from / row.series));
}

/// True if a row adds to what is known of its case. \throws hydro::InputError where the two contradict each other
bool adds(const Store& from, const Row& row, const Store& into, const Row& known) {
  if (known.state == State::failed || row.state == State::failed)
    return known.state != row.state && row.state == State::done;
  if (!agree(known, row))
    throw InputError(fmt::format("case {} of \"{}\" has other numbers than that of \"{}\"", row.number,
                                 from.folder().string(), into.folder().string()),
                     {}, "run it again with the same program: `froude sweep -o` another folder");
  return !row.series.empty() && !has_series(into.folder(), known);
}

void take_over(const Store& from, Store& into, Series how) {
  if (into.columns().empty() && !from.columns().empty()) into.set_columns(from.columns());
  std::map<std::size_t, Row> known;
  for (Row& row : into.rows()) known.emplace(row.number, std::move(row));
  std::vector<Row> taken;
  for (Row& row : from.rows()) {
    const auto at = known.find(row.number);
    if (at != known.end() && !adds(from, row, into, at->second)) continue;
    take_series(from.folder(), row, into.folder(), how);
    taken.push_back(std::move(row));
  }
  into.put(taken);
}

}  // namespace

void merge(const std::vector<fs::path>& folders, Store& into) {
  for (const fs::path& folder : folders) {
    const Store from(folder);
    from.require_same(into.identity());
    take_over(from, into, Series::copied);
  }
  into.close(tally_of(into).over() == into.identity().cases);
}

fs::path folder_of_rank(const fs::path& sweep, int rank) { return sweep / fmt::format("rank-{:05}", rank); }

std::size_t take_over_ranks(Store& into) {
  std::vector<fs::path> folders;
  std::error_code unknown;
  for (const auto& entry : fs::directory_iterator(into.folder()))
    if (entry.path().filename().string().starts_with("rank-") && entry.is_directory(unknown))
      folders.push_back(entry.path());
  std::sort(folders.begin(), folders.end());
  for (const fs::path& folder : folders) {
    // A rank that was killed as it began has no tables yet, which this makes.
    take_over(Store(folder, into.identity()), into, Series::moved);
    fs::remove_all(folder);
  }
  return folders.size();
}

}  // namespace froude::sweep
