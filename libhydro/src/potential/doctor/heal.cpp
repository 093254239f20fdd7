#include "hydro/potential/doctor/heal.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "doctor.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/radiation/kernel.hpp"
#include "hydro/radiation/tail.hpp"
#include "hydro/waves/dispersion.hpp"
#include "potential/readers.hpp"
#include "spikes.hpp"

namespace hydro::potential {
namespace {

using doctor::size_of_entry;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Replaces a matrix and gives the largest change of an entry in the sense of (P11).
double replace(MatrixXd& old, const MatrixXd& by, const VectorXd& s) {
  double largest = 0;
  for (Index i = 0; i < old.rows(); ++i)
    for (Index j = 0; j < old.cols(); ++j)
      largest = std::max(largest, std::abs(by(i, j) - old(i, j)) / size_of_entry(s, i, j));
  old = by;
  return largest;
}

struct Sizes {
  VectorXd A, B;
};

Sizes sizes_of(const Coefficients& c) {
  const doctor::Patient p(c);
  return {p.size_of_A, p.size_of_B};
}

/// M → (M + Mᵀ)/2: of all symmetric matrices the nearest. (P74)
HealStep symmetrise(Coefficients& c, const Sizes& s) {
  double largest = 0;
  const auto change = [&](MatrixXd& m, const VectorXd& size) {
    largest = std::max(largest, replace(m, dense::symmetric_part(m), size));
  };
  for (auto& A : c.A) change(A, s.A);
  for (auto& B : c.B) change(B, s.B);
  if (c.A_zero) change(*c.A_zero, s.A);
  if (c.A_inf) change(*c.A_inf, s.A);
  return {"symmetry", "A and B are the means of themselves and their transposes", largest};
}

/// The frequencies of what is no resonance of the water.
std::vector<std::size_t> bad_frequencies(const Coefficients& c) {
  std::vector<std::size_t> bad;
  for (const Spike& s : find_spikes(c))
    if (s.kind != SpikeKind::resonance && std::find(bad.begin(), bad.end(), s.at) == bad.end()) bad.push_back(s.at);
  std::sort(bad.begin(), bad.end());
  return bad;
}

/// The two nearest frequencies on each side that are not bad; fewer near the ends.
std::vector<std::size_t> good_neighbours(const std::vector<std::size_t>& bad, std::size_t at, std::size_t count) {
  const auto is_good = [&](std::size_t k) { return !std::binary_search(bad.begin(), bad.end(), k); };
  std::vector<std::size_t> out;
  for (std::size_t k = at, found = 0; k-- > 0 && found < 2;)
    if (is_good(k)) {
      out.push_back(k);
      ++found;
    }
  for (std::size_t k = at + 1, found = 0; k < count && found < 2; ++k)
    if (is_good(k)) {
      out.push_back(k);
      ++found;
    }
  return out;
}

/// Whole matrices are replaced, so that what is symmetric and passive stays nearly so; a spike of several frequencies
/// is uncovered from its top, round by round. (P75)
HealStep remove_spikes(Coefficients& c, const Sizes& s) {
  std::vector<std::size_t> all;
  double largest = 0;
  constexpr int rounds = 5;
  for (int round = 0; round < rounds && c.omega.size() >= 5; ++round) {
    for (const std::size_t k : bad_frequencies(c))
      if (!std::binary_search(all.begin(), all.end(), k)) all.insert(std::upper_bound(all.begin(), all.end(), k), k);
    const Coefficients before = c;
    for (const std::size_t k : all) {
      const auto near = good_neighbours(all, k, c.omega.size());
      const auto put = [&](std::vector<MatrixXd>& list, const std::vector<MatrixXd>& old, const VectorXd& size) {
        const MatrixXd between = through(c.omega, near, c.omega[k], [&](std::size_t i) { return old[i]; });
        largest = std::max(largest, replace(list[k], between, size));
      };
      put(c.A, before.A, s.A);
      put(c.B, before.B, s.B);
    }
    if (bad_frequencies(c).empty()) break;
  }
  std::vector<std::string> told;
  for (const std::size_t k : all) told.push_back(fmt::format("{:.4g}", c.omega[k]));
  return {"spikes",
          all.empty() ? std::string("no value stands out")
                      : fmt::format("A and B are put between their neighbours at {} rad/s; X is left as it is",
                                    fmt::join(told, ", ")),
          largest};
}

/// |X_i|² goes as B_ii c_g/k: what (P64) leaves if the shape over the headings does not change. (P76)
void append_excitation(Coefficients& c, const MatrixXd& B, double omega, const MatrixXd& last_B, double last) {
  const auto share = [&](const MatrixXd& m, double at, Index i) {
    return std::max(0.0, m(i, i)) * waves::group_velocity(at, c.water) / waves::wavenumber(at, c.water);
  };
  for (auto& X : c.X) {
    const Index columns = static_cast<Index>(c.omega.size());  // the new frequency is not in the list yet
    Eigen::MatrixXcd longer(X.rows(), columns + 1);
    longer.leftCols(columns) = X;
    for (Index i = 0; i < X.rows(); ++i) {
      const double before = share(last_B, last, i);
      longer(i, columns) = before > 0 ? X(i, columns - 1) * std::sqrt(share(B, omega, i) / before) : 0;
    }
    X = std::move(longer);
  }
}

/// Beyond the end: B as the added mass tells it (R11), A as that B tells it (R10). (P76)
HealStep extend(Coefficients& c) {
  require(c.omega.size() >= 10, "{}: a tail is told by ten frequencies or more, and there are {}", c.source,
          c.omega.size());
  const std::size_t given = c.omega.size();
  const bool had_limit = c.A_inf.has_value();
  const auto found = radiation::extrapolated({c.omega, c.B}, c.A, c.A_inf);
  if (!had_limit) c.A_inf = found.A_inf;
  // At the end of the table the kink of B spoils A from B; what it misses there is let go as A − A(∞) does, as ω⁻².
  const double last = c.omega.back();
  const MatrixXd missed = c.A.back() - found.A_inf - radiation::added_mass_above_limit(found.table, last);
  // No wider apart than the frequencies of the table: the widest gap limits how long a memory the damping tells.
  const double widest = std::numbers::pi / radiation::RetardationKernel::longest_time({c.omega, c.B});
  const double added = found.table.omega[given] - last;
  const auto stride = static_cast<std::size_t>(std::max(1.0, std::floor(widest / added * (1 + 1e-9))));
  for (std::size_t w = given + stride - 1; w < found.table.omega.size(); w += stride) {
    const double omega = found.table.omega[w];
    append_excitation(c, found.table.B[w], omega, c.B.back(), c.omega.back());
    c.A.push_back(found.A_inf + radiation::added_mass_above_limit(found.table, omega) +
                  std::pow(last / omega, 2) * missed);
    c.B.push_back(found.table.B[w]);
    c.omega.push_back(omega);
  }
  return {"tail",
          fmt::format("{} frequencies up to {:.4g} rad/s are added, with the B that A tells (misfit {:.2g}){}; A(∞) {}",
                      c.omega.size() - given, c.omega.back(), found.misfit,
                      c.X.empty() ? "" : ", and an X that is estimated from B", had_limit ? "stays" : "is added"),
          0};
}

/// Negative eigenvalues of B, scaled by sqrt(s_i s_j), become zero: of all passive matrices the nearest. (P74)
HealStep make_passive(Coefficients& c, const VectorXd& s) {
  double largest = 0;
  std::size_t changed = 0;
  const VectorXd scale = s.cwiseSqrt().unaryExpr([](double x) { return x > 0 ? x : 1.0; });
  for (auto& B : c.B) {
    const MatrixXd scaled =
        scale.cwiseInverse().asDiagonal() * dense::symmetric_part(B) * scale.cwiseInverse().asDiagonal();
    if (dense::symmetric_eigenvalues(scaled)[0] >= 0) continue;
    const MatrixXd skew = (B - B.transpose()) / 2;  // does no work, and is another step's business
    const MatrixXd passive = scale.asDiagonal() * dense::positive_part(scaled) * scale.asDiagonal();
    largest = std::max(largest, replace(B, passive + skew, s));
    ++changed;
  }
  return {"passivity",
          fmt::format("B has no negative eigenvalue any more; {} of {} frequencies had one", changed, c.B.size()),
          largest};
}

}  // namespace

Healed heal(Coefficients c, const HealOptions& options) {
  c.validate();
  const Sizes s = sizes_of(c);
  Healed out;
  if (options.symmetry) out.steps.push_back(symmetrise(c, s));
  if (options.spikes) out.steps.push_back(remove_spikes(c, s));
  if (options.tail) out.steps.push_back(extend(c));
  if (options.passivity) out.steps.push_back(make_passive(c, s.B));
  for (const HealStep& step : out.steps)
    if (step.largest_change > 0 || step.name == "tail")
      c.notes.push_back(
          fmt::format("healed, {}: {} (largest change {:.2g})", step.name, step.what, step.largest_change));
  out.coefficients = std::move(c);
  out.coefficients.validate();
  return out;
}

}  // namespace hydro::potential
