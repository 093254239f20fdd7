#include "sweep/series.hpp"

#include <fmt/format.h>

#include "hydro/base/digest.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude::sweep {
namespace {

namespace fs = std::filesystem;

/// "series/case-000017.run.h5"
fs::path series_of(std::size_t number) { return fs::path("series") / fmt::format("case-{:06}.run.h5", number); }

std::string digest_of(const fs::path& file) {
  return fmt::format("{:016x}", hydro::digest(hydro::io::read_text(file)));
}

}  // namespace

void keep_series(const Run& run, const fs::path& folder, Row& row) {
  row.series = series_of(row.number).string();
  run.write(folder / row.series);
  row.digest = digest_of(folder / row.series);
}

bool has_series(const fs::path& folder, const Row& row) {
  std::error_code unknown;
  return !row.series.empty() && fs::is_regular_file(folder / row.series, unknown) &&
         digest_of(folder / row.series) == row.digest;
}

}  // namespace froude::sweep
