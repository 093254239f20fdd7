#include "potential/operations/where_needed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/interpolation.hpp"
#include "hydro/potential/operations/transformations.hpp"
#include "hydro/waves/dispersion.hpp"
#include "potential/modes.hpp"
#include "potential/operations/rational_interpolation.hpp"
#include "potential/solver_request.hpp"

namespace hydro::potential {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t most_frequencies = 300;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// What an entry may be off is measured by these.
struct LoadSizes {
  VectorXd B, X;
  MatrixXd A_inf;
};

std::vector<Eigen::Vector3d> places_of(const Coefficients& c) {
  std::vector<Eigen::Vector3d> out;
  for (const BodyData& body : c.body) out.push_back(body.reference_point.value_or(Eigen::Vector3d::Zero()));
  return out;
}
std::vector<MatrixXcd> without_way(const Coefficients& c) { return turned_by_way(c, places_of(c), -1); }

VectorXd one_where_nothing(const VectorXd& size) { return (size.array() > 0).select(size, 1); }

LoadSizes load_sizes(const Coefficients& c) {
  VectorXd X = VectorXd::Zero(c.modes());
  for (const MatrixXcd& of_heading : c.X) X = X.cwiseMax(of_heading.cwiseAbs().rowwise().maxCoeff());
  return {one_where_nothing(mode_sizes(c.B)).cwiseSqrt(), one_where_nothing(with_floor(X)), *c.A_inf};
}

/// One row a frequency: the upper triangle of B + iω(A − A(∞)), and X without the phase of the waves' way to each
/// body, all relative.
MatrixXcd relative_loads(const Coefficients& c, const LoadSizes& size) {
  const std::vector<MatrixXcd> X_alone = without_way(c);
  const Index n = c.modes();
  MatrixXcd out(static_cast<Index>(c.omega.size()), n * (n + 1) / 2 + n * static_cast<Index>(c.X.size()));
  for (std::size_t w = 0; w < c.omega.size(); ++w) {
    const auto row = static_cast<Index>(w);
    Index at = 0;
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i <= j; ++i) {
        const auto both = [&](const MatrixXd& m) { return (m(i, j) + m(j, i)) / 2; };
        out(row, at++) =
            Complex(both(c.B[w]), c.omega[w] * (both(c.A[w]) - both(size.A_inf))) / (size.B[i] * size.B[j]);
      }
    for (const MatrixXcd& X : X_alone) {
      out.row(row).segment(at, n) = X.col(row).cwiseQuotient(size.X.cast<Complex>()).transpose();
      at += n;
    }
  }
  return out;
}

/// Data are followed closer than the tolerance, so that what is left is that of places not seen.
constexpr double share_of_fit = 0.1, share_of_lower_fit = 0.5;

double largest_entry(const Eigen::RowVectorXcd& row) { return row.cwiseAbs().maxCoeff(); }

/// What an interpolation foresees, and where it may err most.
struct DoubtfulPlace {
  std::size_t gap;
  double at, doubt;
};

/// In each gap the place where the largest entry of doubt(ω) is largest.
template <class Doubt>
std::vector<DoubtfulPlace> most_doubtful(const std::vector<double>& omega, const Doubt& doubt) {
  std::vector<DoubtfulPlace> out;
  constexpr int looks = 9;
  for (std::size_t g = 0; g + 1 < omega.size(); ++g) {
    DoubtfulPlace best{g, 0, -1};
    for (int i = 1; i < looks; ++i) {
      const double at = omega[g] + (omega[g + 1] - omega[g]) * i / looks;
      const double here = doubt(at);
      if (!(here <= best.doubt)) best = {g, at, std::isnan(here) ? infinity : here};  // a pole may lie there
    }
    out.push_back(best);
  }
  std::sort(out.begin(), out.end(), [](const DoubtfulPlace& a, const DoubtfulPlace& b) { return a.doubt > b.doubt; });
  return out;
}

/// The most doubtful places, and the middles of the widest gaps where none of these lies: of a narrow resonance between
/// two places nothing that is foreseen may tell.
std::vector<double> places_to_look_at(const std::vector<double>& omega, std::vector<DoubtfulPlace> all) {
  constexpr std::size_t doubtful = 4, widest = 2;
  const std::size_t chosen = std::min(doubtful, all.size());
  std::vector<double> out;
  for (std::size_t i = 0; i < chosen; ++i) out.push_back(all[i].at);
  all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(chosen));
  const auto width = [&](const DoubtfulPlace& c) { return omega[c.gap + 1] - omega[c.gap]; };
  std::sort(all.begin(), all.end(),
            [&](const DoubtfulPlace& a, const DoubtfulPlace& b) { return width(a) > width(b); });
  for (std::size_t i = 0; i < std::min(widest, all.size()); ++i)
    out.push_back((omega[all[i].gap] + omega[all[i].gap + 1]) / 2);
  std::sort(out.begin(), out.end());
  return out;
}

/// What is solved is not so certain as it is to be foreseen if it leaps between frequencies next to each other.
void require_smooth(const std::vector<double>& omega, const std::vector<DoubtfulPlace>& all, double tolerance) {
  constexpr double next_to = 1e-5;  // of the frequency
  for (const DoubtfulPlace& place : all)
    if (place.doubt > tolerance && omega[place.gap + 1] - omega[place.gap] < next_to * omega[place.gap])
      throw InputError(fmt::format("what is solved at {:.8g} and {:.8g} rad/s is uncertain by {:.2g}; {:.2g} is asked "
                                   "for between frequencies",
                                   omega[place.gap], omega[place.gap + 1], place.doubt, tolerance),
                       {}, "take a larger frequency_tolerance, or solve more accurately");
}

/// Rows of `loads` at frequencies that are some of `omega`.
MatrixXcd rows_at(const MatrixXcd& loads, const std::vector<double>& omega, const std::vector<double>& some) {
  MatrixXcd out(static_cast<Index>(some.size()), loads.cols());
  for (std::size_t i = 0; i < some.size(); ++i)
    out.row(static_cast<Index>(i)) = loads.row(std::find(omega.begin(), omega.end(), some[i]) - omega.begin());
  return out;
}

/// What a table is foreseen with, and the same that follows the data less closely: where they part, neither is certain.
struct TwoOrders {
  RationalInterpolation known, lower;

  TwoOrders(const std::vector<double>& omega, const MatrixXcd& loads, double tolerance)
      : known(omega, loads, share_of_fit * tolerance), lower(omega, loads, share_of_lower_fit * tolerance) {}
  double apart(double omega, const MatrixXcd& loads) const {
    return largest_entry((known.shares(omega) - lower.shares(omega)) * loads);
  }
};

}  // namespace

// An interpolation that has foreseen what it had not seen may still be led astray by what it then learns, so that the
// next one has to agree with it everywhere, and with one of a lower order.
ChosenFrequencies choose_frequencies(const std::vector<double>& first, double tolerance, const SolveAt& solve) {
  check_frequency_tolerance(tolerance, first.size());
  Coefficients solved = solve(first);
  ensure(solved.A_inf.has_value(), "coefficients are chosen with A at infinite frequency");
  std::vector<double> before = first, looked_at;  // what was known when places were last looked at, and those
  std::optional<RationalInterpolation> then;      // of what was known
  double missed = infinity;
  while (true) {
    const LoadSizes size = load_sizes(solved);
    const MatrixXcd loads = relative_loads(solved, size), earlier = rows_at(loads, solved.omega, before);
    const TwoOrders now(solved.omega, loads, tolerance);
    const auto doubt = [&](double omega) {
      const double apart = now.apart(omega, loads);
      if (!then) return apart;
      return std::max(apart, largest_entry(now.known.shares(omega) * loads - then->shares(omega) * earlier));
    };
    const std::vector<DoubtfulPlace> candidate = most_doubtful(solved.omega, doubt);
    const double unseen = std::max(missed, candidate.front().doubt);
    if (unseen <= tolerance) return {solved.omega, unseen, looked_at};
    if (solved.omega.size() > most_frequencies)
      throw InputError(
          fmt::format("between {} solved frequencies interpolation still misses {:.2g}; {:.2g} is asked for",
                      solved.omega.size(), unseen, tolerance),
          {}, "take a larger frequency_tolerance, or end the table at longer waves");
    require_smooth(solved.omega, candidate, tolerance);
    looked_at = places_to_look_at(solved.omega, candidate);
    const Coefficients seen = solve(looked_at);
    const MatrixXcd there = relative_loads(seen, size);
    missed = 0;
    for (std::size_t i = 0; i < looked_at.size(); ++i)
      missed =
          std::max(missed, largest_entry(there.row(static_cast<Index>(i)) - now.known.shares(looked_at[i]) * loads));
    before = solved.omega;
    then = now.known;
    solved = merged(std::array{std::move(solved), seen});
  }
}

namespace {

/// Loads at frequencies of a table that is being made.
struct TablePlace {
  double omega;
  Eigen::RowVectorXcd loads;
};

/// By how much a cubic through the table misses what is known half way to the next place.
double cubic_misses(const std::vector<double>& omega, const std::vector<TablePlace>& table, const TablePlace& middle) {
  const auto value = [&](std::size_t i) -> const Eigen::RowVectorXcd& { return table[i].loads; };
  return largest_entry(combined(cubic_stencil(omega, middle.omega), table.size(), value) - middle.loads);
}

/// Where a cubic from twice as far misses eight times as much, being of third order, still no more than the tolerance.
constexpr double share_of_table = 1.0 / 8;

/// Frequencies between which cubics serve: gaps are halved until they do.
std::vector<double> fine_table(const std::vector<double>& solved, const RationalInterpolation& known,
                               const MatrixXcd& loads, double tolerance) {
  const auto at = [&](double omega) { return TablePlace{omega, known.shares(omega) * loads}; };
  std::vector<TablePlace> table, middle;  // middle[i] is half way from table[i] to the next
  for (const double omega : solved) table.push_back(at(omega));
  for (std::size_t i = 0; i + 1 < solved.size(); ++i) middle.push_back(at((solved[i] + solved[i + 1]) / 2));
  while (true) {
    std::vector<double> omega;
    for (const TablePlace& p : table) omega.push_back(p.omega);
    constexpr std::size_t most = 10'000;
    require(omega.size() <= most, "a table of more than {} frequencies is needed between {:.4g} and {:.4g} rad/s", most,
            omega.front(), omega.back());
    std::vector<TablePlace> finer, finer_middle;
    for (std::size_t i = 0; i < table.size(); ++i) {
      finer.push_back(table[i]);
      if (i + 1 == table.size()) break;
      if (cubic_misses(omega, table, middle[i]) <= share_of_table * tolerance) {
        finer_middle.push_back(middle[i]);
        continue;
      }
      const double half = middle[i].omega;
      finer_middle.push_back(at((omega[i] + half) / 2));
      finer.push_back(middle[i]);
      finer_middle.push_back(at((half + omega[i + 1]) / 2));
    }
    if (finer.size() == table.size()) return omega;
    table = std::move(finer);
    middle = std::move(finer_middle);
  }
}

/// Σ shares · (B + iω(A − A(∞))), symmetric.
MatrixXcd radiation_between(const Coefficients& solved, const Eigen::RowVectorXcd& shares) {
  MatrixXcd sum = MatrixXcd::Zero(solved.modes(), solved.modes());
  for (std::size_t k = 0; k < solved.omega.size(); ++k) {
    const Complex share = shares[static_cast<Index>(k)];
    if (share == 0.0) continue;
    sum += share * solved.B[k].cast<Complex>();
    sum += share * Complex(0, solved.omega[k]) * (solved.A[k] - *solved.A_inf).cast<Complex>();
  }
  return (sum + sum.transpose()) / 2;
}

}  // namespace

Coefficients with_frequencies_between(const Coefficients& solved, double tolerance) {
  const MatrixXcd loads = relative_loads(solved, load_sizes(solved));
  const TwoOrders two(solved.omega, loads, tolerance);
  const double doubt = most_doubtful(solved.omega, [&](double omega) { return two.apart(omega, loads); }).front().doubt;
  require(doubt <= tolerance,
          "between the {} frequencies interpolation is certain to {:.2g} only; {:.2g} is asked for: take a larger "
          "frequency_tolerance, or coefficients of less error",
          solved.omega.size(), doubt, tolerance);
  const std::vector<MatrixXcd> X_alone = without_way(solved);
  const VectorXd B_size = mode_sizes(solved.B);
  Coefficients out = solved;
  out.omega = fine_table(solved.omega, two.known, loads, tolerance);
  const auto count = static_cast<Index>(out.omega.size());
  out.A.clear();
  out.B.clear();
  for (MatrixXcd& X : out.X) X.resize(out.modes(), count);
  for (Index w = 0; w < count; ++w) {
    const double omega = out.omega[static_cast<std::size_t>(w)];
    const auto same = std::find(solved.omega.begin(), solved.omega.end(), omega);
    const Eigen::RowVectorXcd shares = two.known.shares(omega);
    for (std::size_t h = 0; h < out.X.size(); ++h) out.X[h].col(w) = X_alone[h] * shares.transpose();
    if (same == solved.omega.end()) {
      const MatrixXcd K = radiation_between(solved, shares);
      out.A.push_back(*solved.A_inf + K.imag() / omega);
      out.B.push_back(nearest_passive(K.real(), B_size));
      continue;
    }
    const auto k = same - solved.omega.begin();
    out.A.push_back(solved.A[static_cast<std::size_t>(k)]);
    out.B.push_back(solved.B[static_cast<std::size_t>(k)]);
    for (std::size_t h = 0; h < out.X.size(); ++h) out.X[h].col(w) = X_alone[h].col(k);
  }
  out.X = turned_by_way(out, places_of(out), 1);
  return out;
}

// Half wavelengths that fit between the bodies are what resonates; each takes two frequencies, and each further digit a
// third more.
std::vector<double> expected_frequencies(const std::vector<double>& first, double tolerance, double across,
                                         const Water& water) {
  const double half_waves = waves::wavenumber(first.back(), water) * across / std::numbers::pi;
  const double digits = -std::log10(tolerance);
  const double count = (20 + 2 * half_waves) * (1 + (digits - 2) / 3);
  const auto frequencies = std::max(first.size() + least_first_frequencies, static_cast<std::size_t>(count));
  std::vector<double> out;
  for (std::size_t i = 0; i < frequencies; ++i)
    out.push_back(first.front() +
                  (first.back() - first.front()) * static_cast<double>(i) / static_cast<double>(frequencies - 1));
  return out;
}

std::string note_of(const ChosenFrequencies& chosen, const Coefficients& table) {
  return fmt::format(
      "solved at {} frequencies where they were needed; the last {} were foreseen to {:.1e} before they were solved; "
      "the other {} of the table are by rational interpolation",
      chosen.omega.size(), chosen.unseen_omega.size(), chosen.unseen, table.omega.size() - chosen.omega.size());
}

}  // namespace hydro::potential
