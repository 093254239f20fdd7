#include <algorithm>
#include <cmath>
#include <map>

#include "potential/readers.hpp"
#include "responses.hpp"
#include "wamit.hpp"

namespace hydro::potential {
namespace {

namespace fs = std::filesystem;
using Row = WamitTable::Row;

/// Where a kind of file has its columns: `PER … BETA … I Mod Pha Re Im`.
struct Layout {
  std::size_t frequencies, headings;
  std::size_t mode() const { return frequencies + headings; }
  std::size_t modulus() const { return mode() + 1; }
  std::size_t columns() const { return mode() + 5; }
  std::string words() const {
    return std::string(frequencies == 2 ? "PER1 PER2 " : "PER ") + (headings == 2 ? "BETA1 BETA2 " : "BETA ") +
           "I Mod Pha Re Im";
  }
};

/// A file, what its run is known to be, and its axes.
struct ResponseFile {
  WamitTable table;
  Layout layout;
  WamitRun run;
  std::map<double, Eigen::Index> column_of_per;         ///< the place of each PER in `omega`
  std::vector<double> omega;                            ///< rad/s, increasing
  std::vector<std::array<double, 2>> heading_deg = {};  ///< increasing; one heading is there twice
  std::vector<int> mode = {};                           ///< from 0, increasing
  std::vector<std::string> notes = {};

  std::array<double, 2> degrees(const Row& row) const {
    return {row.value[layout.frequencies], row.value[layout.frequencies + layout.headings - 1]};
  }
  int mode_of(const Row& row) const { return table.mode(row, layout.mode()) - 1; }
  std::complex<double> value(const Row& row) const {
    return {row.value[layout.modulus() + 2], row.value[layout.modulus() + 3]};
  }
  bool is_limit(const Row& row) const { return row.value[0] <= 0 || (layout.frequencies == 2 && row.value[1] <= 0); }
  template <class T>
  static std::size_t place(const std::vector<T>& sorted, const T& value) {
    return static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
  }
};

template <class T>
void sort_and_thin(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

void find_axes(ResponseFile& file) {
  std::vector<std::pair<double, double>> frequency;  // ω and PER
  bool left_out = false;
  for (const Row& row : file.table.rows()) {
    const int mode = file.mode_of(row);
    if (file.is_limit(row)) {
      left_out = true;
      continue;
    }
    for (std::size_t i = 0; i < file.layout.frequencies; ++i)
      frequency.emplace_back(frequency_of_per(row.value[i], file.run.column, file.run.water, file.run.ulen),
                             row.value[i]);
    file.heading_deg.push_back(file.degrees(row));
    file.mode.push_back(mode);
  }
  if (frequency.empty())
    throw InputError("there is no finite, positive frequency", {.file = file.table.path().string()});
  sort_and_thin(frequency);
  sort_and_thin(file.heading_deg);
  sort_and_thin(file.mode);
  for (const auto& [omega, per] : frequency) {
    file.column_of_per[per] = static_cast<Eigen::Index>(file.omega.size());
    file.omega.push_back(omega);
  }
  if (left_out) file.notes.push_back("rows at the limits of zero and infinite frequency are left out");
}

ResponseFile open_file(const fs::path& path, const Layout& layout, const ReadOptions& options, bool is_load) {
  if (hams_run_around(path))
    throw InputError("motions and drift of HAMS are not read", {.file = path.string()},
                     "Froude reads its coefficients: give the ControlFile.in");
  const fs::path out_file = fs::path(path).replace_extension(".out");
  std::optional<WamitOut> out;
  if (fs::exists(out_file)) out = read_wamit_out(out_file);
  const int iperout = options.iperout.value_or(1);
  std::vector<std::string> notes;
  const WamitNeeds needs{.density = is_load, .gravity = is_load || iperout >= 3, .depth = iperout == 4};
  const WamitRun run = run_of(options, out, needs, path, notes);
  ResponseFile file{.table = WamitTable::read(path, {layout.columns()}, layout.words()),
                    .layout = layout,
                    .run = run,
                    .column_of_per = {},
                    .omega = {},
                    .notes = std::move(notes)};
  count_bodies(file.table, {layout.mode()}, run.bodies);
  find_axes(file);
  if (!options.iperout)
    file.notes.push_back("IPEROUT is not stated: the first column is taken for periods in seconds (IPEROUT = 1)");
  if (auto note = note_on_phases(file.table, layout.modulus())) file.notes.push_back(*note);
  return file;
}

/// One number for each heading, mode and frequency, times the factor of its mode; every place filled exactly once.
template <class Factor>
std::vector<Eigen::MatrixXcd> complete_table(const ResponseFile& file, Factor factor) {
  const auto modes = static_cast<Eigen::Index>(file.mode.size()), n = static_cast<Eigen::Index>(file.omega.size());
  std::vector<Eigen::MatrixXcd> out(file.heading_deg.size(), Eigen::MatrixXcd::Zero(modes, n));
  std::vector<Eigen::MatrixXi> line(file.heading_deg.size(), Eigen::MatrixXi::Zero(modes, n));
  for (const Row& row : file.table.rows()) {
    if (file.is_limit(row)) continue;
    const int mode = file.mode_of(row);
    const std::size_t h = file.place(file.heading_deg, file.degrees(row));
    const auto i = static_cast<Eigen::Index>(file.place(file.mode, mode));
    const Eigen::Index k = file.column_of_per.at(row.value[0]);
    if (line[h](i, k) != 0)
      throw InputError(fmt::format("the same PER, heading and mode are in line {} already", line[h](i, k)),
                       file.table.place(row), "keep one of the two rows");
    line[h](i, k) = row.line;
    out[h](i, k) = factor(mode) * file.value(row);
  }
  for (std::size_t h = 0; h < line.size(); ++h)
    for (Eigen::Index i = 0; i < modes; ++i)
      for (Eigen::Index k = 0; k < n; ++k)
        if (line[h](i, k) == 0)
          throw InputError(fmt::format("there is no row for {:.6g} rad/s, heading {} deg, mode {}",
                                       file.omega[static_cast<std::size_t>(k)], file.heading_deg[h][0],
                                       file.mode[static_cast<std::size_t>(i)] + 1),
                           {.file = file.table.path().string()}, "the file may be cut short");
  return out;
}

double radians(double degrees) { return Angle::from_degrees(degrees).radians(); }

std::vector<std::array<double, 2>> pairs_of_radians(const std::vector<std::array<double, 2>>& degrees) {
  std::vector<std::array<double, 2>> out;
  for (const auto& pair : degrees) out.push_back({radians(pair[0]), radians(pair[1])});
  return out;
}

/// ρ g L for forces and ρ g L² for moments (P24).
auto load_factor(const WamitRun& run) {
  return [run](int mode) {
    return run.water.density * run.water.gravity * std::pow(run.ulen, is_translation(mode) ? 1 : 2);
  };
}

/// Places of a second-order table: its values, and the line where each was found.
struct Quadrant {
  Eigen::MatrixXcd value;
  Eigen::MatrixXi line;
};
using Quadrants = std::vector<std::vector<Quadrant>>;  ///< [pair of headings][mode]

/// F(ω₂, ω₁; β₂, β₁) is F(ω₁, ω₂; β₁, β₂) for sums and its conjugate for differences (P24).
void put(Quadrants& quadrants, const ResponseFile& file, const Row& row, bool is_sum, std::complex<double> F) {
  const auto [beta1, beta2] = file.degrees(row);
  const std::size_t m = file.place(file.mode, file.mode_of(row));
  const Eigen::Index i = file.column_of_per.at(row.value[0]), j = file.column_of_per.at(row.value[1]);
  Quadrant& own = quadrants[file.place(file.heading_deg, {beta1, beta2})][m];
  if (own.line(i, j) == row.line) return;
  if (own.line(i, j) > 0)
    throw InputError(fmt::format("the same PER, headings and mode are in line {} already", own.line(i, j)),
                     file.table.place(row), "keep one of the two rows");
  own.value(i, j) = F;
  own.line(i, j) = row.line;
  Quadrant& mirror = quadrants[file.place(file.heading_deg, {beta2, beta1})][m];
  if (mirror.line(j, i) > 0) return;
  mirror.value(j, i) = is_sum ? F : std::conj(F);
  mirror.line(j, i) = -row.line;  // may still be stated itself
}

}  // namespace

RaoTable read_wamit_rao(const fs::path& path, const ReadOptions& options) {
  ResponseFile file = open_file(path, {.frequencies = 1, .headings = 1}, options, false);
  RaoTable rao;
  // ξ = ξ̄ A / L^r, r = 1 for rotations (P24).
  rao.motion = complete_table(file, [&](int mode) { return is_translation(mode) ? 1.0 : 1 / file.run.ulen; });
  rao.omega = file.omega;
  for (const auto& pair : file.heading_deg) rao.heading.push_back(radians(pair[0]));
  rao.mode = file.mode;
  rao.source = "WAMIT " + path.string();
  rao.notes = std::move(file.notes);
  return rao;
}

DriftForces read_wamit_drift(const fs::path& path, const ReadOptions& options) {
  ResponseFile file = open_file(path, {.frequencies = 1, .headings = 2}, options, true);
  DriftForces drift;
  drift.load = complete_table(file, load_factor(file.run));
  drift.omega = file.omega;
  drift.heading = pairs_of_radians(file.heading_deg);
  drift.mode = file.mode;
  const std::string extension = path.extension().string();
  drift.method = extension == ".8" ? "momentum" : extension == ".9" ? "pressure" : "control surface";
  drift.source = "WAMIT " + path.string();
  drift.notes = std::move(file.notes);
  return drift;
}

QuadraticLoads read_quadratic(const fs::path& path, const ReadOptions& options) {
  if (response_kind(path) != ResponseKind::quadratic)
    throw InputError("not a file of quadratic loads", {.file = path.string()},
                     "give a .10d, .10s, .11d, .11s, .12d or .12s file of WAMIT");
  ResponseFile file = open_file(path, {.frequencies = 2, .headings = 2}, options, true);
  QuadraticLoads out;
  out.is_sum = path.extension().string().back() == 's';
  auto with_mirrors = file.heading_deg;
  for (const auto& [first, second] : file.heading_deg) with_mirrors.push_back({second, first});
  file.heading_deg = with_mirrors;
  sort_and_thin(file.heading_deg);
  const auto n = static_cast<Eigen::Index>(file.omega.size());
  Quadrants quadrants(file.heading_deg.size(), std::vector<Quadrant>(file.mode.size(), {Eigen::MatrixXcd::Zero(n, n),
                                                                                        Eigen::MatrixXi::Zero(n, n)}));
  const auto factor = load_factor(file.run);
  for (const Row& row : file.table.rows())
    if (!file.is_limit(row)) put(quadrants, file, row, out.is_sum, factor(file.mode_of(row)) * file.value(row));
  for (const auto& by_mode : quadrants) {
    auto& loads = out.load.emplace_back();
    auto& known = out.known.emplace_back();
    for (const Quadrant& q : by_mode) {
      loads.push_back(q.value);
      known.push_back(q.line.array() != 0);
    }
  }
  out.omega = file.omega;
  out.heading = pairs_of_radians(file.heading_deg);
  out.mode = file.mode;
  out.source = "WAMIT " + path.string();
  out.notes = std::move(file.notes);
  return out;
}

}  // namespace hydro::potential
