#include <algorithm>
#include <cmath>
#include <numbers>

#include "potential/readers.hpp"
#include "wamit.hpp"

namespace hydro::potential {
namespace {

Eigen::Index index_of_per(const WamitTable& table, const WamitTable::Row& row, const std::vector<double>& per) {
  const double wanted = row.value[0];
  for (std::size_t k = 0; k < per.size(); ++k)
    if (std::abs(per[k] - wanted) <= per_tolerance * wanted) return static_cast<Eigen::Index>(k);
  const auto is_inverse = [&](double p) {
    return std::abs(2 * std::numbers::pi / p - wanted) <= per_tolerance * wanted;
  };
  if (std::any_of(per.begin(), per.end(), is_inverse))
    throw InputError(
        fmt::format("PER = {} is 2π divided by one of the .1 file: one of the two files has periods in its "
                    "first column and the other frequencies",
                    wanted),
        table.place(row, 0), "write both files with one IPEROUT");
  throw InputError(fmt::format("PER = {} is not among those of the .1 file", wanted), table.place(row, 0),
                   "the two files must come from one run");
}

/// Ascending headings of rows with a finite, positive PER.
std::vector<double> headings_deg(const WamitTable& table) {
  std::vector<double> degrees;
  for (const auto& row : table.rows())
    if (row.value[0] > 0) degrees.push_back(row.value[1]);
  std::sort(degrees.begin(), degrees.end());
  degrees.erase(std::unique(degrees.begin(), degrees.end()), degrees.end());
  return degrees;
}

using Lines = std::vector<Eigen::MatrixXi>;  ///< where each value stands, 0: nowhere; shaped as Coefficients::X

void take_row(Coefficients& c, Lines& line, const WamitTable& table, const WamitTable::Row& row, std::size_t heading,
              Eigen::Index k, double ulen) {
  const Eigen::Index i = table.mode(row, 2) - 1;
  if (i >= c.modes())
    throw InputError(fmt::format("mode {} belongs to body {}, but the .1 file has {}", i + 1, i / 6 + 1, c.bodies()),
                     table.place(row, 2), "the two files must come from one run");
  int& seen = line[heading](i, k);
  if (seen != 0)
    throw InputError(fmt::format("the same PER, heading and mode are in line {} already", seen), table.place(row),
                     "keep one of the two rows");
  seen = row.line;
  // X = ρ g X̄ L^m  (P8)
  c.X[heading](i, k) =
      c.water.density * c.water.gravity * excitation_scale(i, ulen) * std::complex<double>(row.value[5], row.value[6]);
}

/// A body whose waves are in the .1 file meets waves too: without any row it was not in this run.
void require_every_body(const Coefficients& c, const Lines& line, const WamitTable& table) {
  for (Eigen::Index b = 0; b < c.bodies(); ++b) {
    const bool radiates = !c.A.front().middleRows(6 * b, 6).isZero(0);
    const bool is_there =
        std::any_of(line.begin(), line.end(), [&](const auto& l) { return !l.middleRows(6 * b, 6).isZero(); });
    if (radiates && !is_there)
      throw InputError(
          fmt::format("there is no row for any mode of body {}; the .1 file has {} bodies", b + 1, c.bodies()),
          {.file = table.path().string()}, "the two files must come from one run");
  }
}

/// A mode may be absent, being zero, but then at every frequency and heading.
void require_complete(const Lines& line, const WamitTable& table, const std::vector<double>& per,
                      const std::vector<double>& degrees) {
  for (Eigen::Index i = 0; i < line.front().rows(); ++i) {
    const bool is_used = std::any_of(line.begin(), line.end(), [&](const auto& l) { return !l.row(i).isZero(); });
    for (std::size_t b = 0; is_used && b < degrees.size(); ++b)
      for (std::size_t k = 0; k < per.size(); ++k)
        if (line[b](i, static_cast<Eigen::Index>(k)) == 0)
          throw InputError(
              fmt::format("there is no row for PER = {}, heading {} deg, mode {}", per[k], degrees[b], i + 1),
              {.file = table.path().string()},
              "every period of the .1 file needs every heading; the file may be cut short or of another run");
  }
}

}  // namespace

std::optional<std::string> note_on_phases(const WamitTable& table, std::size_t modulus) {
  int wrong = 0, first = 0;
  double largest = 0;
  for (const auto& row : table.rows()) largest = std::max(largest, std::abs(row.value[modulus]));
  constexpr double round_off = 1e-9;  // loads that symmetry forbids are printed as noise with any phase
  for (const auto& row : table.rows()) {
    const double phase = Angle::from_degrees(row.value[modulus + 1]).radians();
    const std::complex<double> told = row.value[modulus] * std::complex<double>(std::cos(phase), std::sin(phase));
    const std::complex<double> used(row.value[modulus + 2], row.value[modulus + 3]);
    constexpr double printed = 1e-3;  // generous to files with few digits; a wrong sign or unit is far beyond it
    if (std::abs(told - used) <= round_off * largest ||
        std::abs(told - used) <= printed * (std::abs(told) + std::abs(used)))
      continue;
    if (wrong++ == 0) first = row.line;
  }
  if (wrong == 0) return std::nullopt;
  return fmt::format(
      "{}: in {} rows, the first in line {}, modulus and phase disagree with the real and imaginary parts, "
      "which are used",
      table.path().filename().string(), wrong, first);
}

void fill_excitation(Coefficients& c, const WamitTable& table, const std::vector<double>& per, double ulen) {
  const std::vector<double> degrees = headings_deg(table);
  for (const double beta : degrees) c.heading.push_back(Angle::from_degrees(beta).radians());
  const Eigen::Index frequencies = static_cast<Eigen::Index>(per.size());
  c.X.assign(degrees.size(), Eigen::MatrixXcd::Zero(c.modes(), frequencies));
  Lines line(degrees.size(), Eigen::MatrixXi::Zero(c.modes(), frequencies));
  bool left_out = false;
  for (const auto& row : table.rows()) {
    if (row.value[0] <= 0) {
      left_out = true;
      continue;
    }
    const auto at = std::lower_bound(degrees.begin(), degrees.end(), row.value[1]);
    take_row(c, line, table, row, static_cast<std::size_t>(at - degrees.begin()), index_of_per(table, row, per), ulen);
  }
  if (!degrees.empty()) {
    require_every_body(c, line, table);
    require_complete(line, table, per, degrees);
  }
  if (left_out) c.notes.push_back("excitation at the limits of zero and infinite frequency is left out");
  if (auto note = note_on_phases(table, 3)) c.notes.push_back(*note);
}

}  // namespace hydro::potential
