// A and B are two sides of one causal memory: each tells the other, A(∞), and what the ends of the table cost. (P62),
// (P63)
#include <algorithm>
#include <cmath>
#include <numbers>

#include "doctor.hpp"
#include "hydro/radiation/tail.hpp"
#include "potential/readers.hpp"
#include "spikes.hpp"

namespace hydro::potential::doctor {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// What the comparison is made with: A∞ and the tail of B fitted to A, so that it does not hang on the stated A∞. Modes
/// are compared each with itself, so the tables hold a column of diagonal entries a frequency.
struct Causal {
  const Patient& p;
  std::vector<Eigen::MatrixXd> A;
  radiation::DampingTable given, fitted;
  Eigen::MatrixXd A_inf;
  std::vector<std::size_t> samples;  // where A and B are compared
};

/// A fit with fewer frequencies would follow anything.
constexpr std::size_t fewest_frequencies = 10;

std::vector<Eigen::MatrixXd> diagonals(const std::vector<Eigen::MatrixXd>& matrices) {
  std::vector<Eigen::MatrixXd> out;
  for (const auto& m : matrices) out.emplace_back(m.diagonal());
  return out;
}

/// Diagonal block of body b at every frequency.
std::vector<Eigen::MatrixXd> of_body(const std::vector<Eigen::MatrixXd>& matrices, Index b) {
  std::vector<Eigen::MatrixXd> out;
  for (const auto& m : matrices) out.emplace_back(m.block<6, 6>(6 * b, 6 * b));
  return out;
}

/// Tails are those of each body by itself: what other bodies do to it is no part of its diagonal entries.
void extrapolate(Causal& f) {
  f.A_inf.resize(f.p.c.modes(), 1);
  for (Index b = 0; b < f.p.c.bodies(); ++b) {
    const auto one = radiation::extrapolated({f.p.c.omega, of_body(f.p.c.B, b)}, of_body(f.p.c.A, b), std::nullopt);
    if (b == 0) f.fitted = {one.table.omega, std::vector(one.table.omega.size(), f.A_inf)};
    for (std::size_t w = 0; w < one.table.B.size(); ++w) f.fitted.B[w].middleRows<6>(6 * b) = one.table.B[w].diagonal();
    f.A_inf.middleRows<6>(6 * b) = one.A_inf.diagonal();
  }
}

Causal causal(const Patient& p) {
  Causal f{p, diagonals(p.c.A), {p.c.omega, diagonals(p.c.B)}, {}, {}, {}};
  extrapolate(f);
  // Forty places tell as much as four hundred; near the end of the table what is beyond it decides.
  const std::size_t stride = std::max<std::size_t>(1, p.c.omega.size() / 40);
  for (std::size_t w = 1; w < p.c.omega.size() && p.c.omega[w] < 0.6 * p.c.omega.back(); w += stride)
    f.samples.push_back(w);
  return f;
}

/// Largest less smallest A_ii(ω): what causality explains. A twentieth of A itself is added, which no mesh resolves.
VectorXd variation_of_A(const Patient& p) {
  VectorXd low = p.c.A.front().diagonal(), high = low;
  for (const auto& A : p.c.A) {
    low = low.cwiseMin(A.diagonal());
    high = high.cwiseMax(A.diagonal());
  }
  return high - low + 0.05 * p.size_of_A;
}

struct Misfit {
  double value = 0;
  Index mode = 0;
};

/// rms over the samples of error(w), one number a mode, largest over the modes that act.
template <class Error>
Misfit largest_rms(const Causal& f, Error error) {
  VectorXd squares = VectorXd::Zero(f.p.c.modes());
  for (const std::size_t w : f.samples) squares += error(w).cwiseAbs2();
  Misfit worst;
  for (Index i = 0; i < squares.size(); ++i) {
    if (!acts(f.p.c.A, f.p.size_of_A, i) || !acts(f.p.c.B, f.p.size_of_B, i)) continue;
    const double rms = std::sqrt(squares(i) / static_cast<double>(f.samples.size()));
    if (rms > worst.value) worst = {rms, i};
  }
  return worst;
}

/// A(ω) − A∞ from B, by (R10) and the fitted tail.
Misfit added_mass_from_damping(const Causal& f) {
  const VectorXd size = variation_of_A(f.p);
  return largest_rms(f, [&](std::size_t w) {
    const VectorXd A = radiation::added_mass_above_limit(f.fitted, f.p.c.omega[w]) + f.A_inf;
    return VectorXd((A - f.A[w]).cwiseQuotient(size.cwiseMax(1e-300)));
  });
}

/// B(ω) from A, by (R21). An error of A of a tenth makes one of ω A/10 in B, which is allowed for.
Misfit damping_from_added_mass(const Causal& f) {
  return largest_rms(f, [&](std::size_t w) {
    const double omega = f.p.c.omega[w];
    const VectorXd B = radiation::damping_from_added_mass(f.p.c.omega, f.A, f.A_inf, omega);
    const VectorXd size = f.p.size_of_B + 0.1 * omega * f.p.size_of_A;
    return VectorXd((B - f.given.B[w]).cwiseQuotient(size.cwiseMax(1e-300)));
  });
}

void look_at_kramers_kronig(const Causal& f, Findings& out) {
  const Misfit A = added_mass_from_damping(f), B = damping_from_added_mass(f);
  Finding finding{.check = "Kramers-Kronig",
                  .where = fmt::format("A of {}, B of {}", mode_label(A.mode), mode_label(B.mode)),
                  .message = fmt::format("A from B misses A by {:.2g} of its variation (rms, {}); B from A misses B by "
                                         "{:.2g} of its size ({})",
                                         A.value, mode_label(A.mode), B.value, mode_label(B.mode))};
  // Good data reach 0.01 and 0.05 (their tables end); meshes with irregular frequencies 0.1 and 0.2.
  constexpr double usual_A = 0.05, usual_B = 0.12, impossible_A = 0.3, impossible_B = 0.35;
  if (A.value > usual_A || B.value > usual_B) {
    finding.severity = A.value > impossible_A || B.value > impossible_B ? Severity::error : Severity::warning;
    const Index mode = A.value / usual_A > B.value / usual_B ? A.mode : B.mode;
    finding.body = static_cast<int>(mode / 6) + 1;
    finding.entry = {{static_cast<int>(mode) + 1, static_cast<int>(mode) + 1}};
    finding.why = "a hull radiates no wave before it moves: A(ω) and B(ω) determine each other (P62)";
    finding.remedy = "A and B may be exchanged, of different units, bodies or runs, or spoilt by irregular frequencies";
  }
  out.push_back(std::move(finding));
}

/// Every second value, from the first or the second on.
template <class List>
List every_second(const List& all, std::size_t from) {
  List out;
  for (std::size_t w = from; w < all.size(); w += 2) out.push_back(all[w]);
  return out;
}

/// By how much the A(∞) that A and B tell of one mode changes where every second frequency is left out, relative as its
/// error: the odd or the even ones, whichever changes it more.
double change_with_half_the_frequencies(const Causal& f, Index mode) {
  double most = 0;
  const Index body = mode / 6;
  const auto A = of_body(f.p.c.A, body), B = of_body(f.p.c.B, body);
  for (const std::size_t from : {0, 1}) {
    const auto half = radiation::extrapolated({every_second(f.p.c.omega, from), every_second(B, from)},
                                              every_second(A, from), std::nullopt);
    most = std::max(most, std::abs(half.A_inf(mode % 6, mode % 6) - f.A_inf(mode)) / f.p.size_of_A(mode));
  }
  return most;
}

/// The resonance of a mode that departs most from what its neighbours tell; nothing if all fit.
std::optional<Spike> largest_resonance(const Patient& p, Index mode) {
  std::optional<Spike> out;
  for (const Spike& s : find_spikes(p.c))
    if (s.mode == mode && s.kind == SpikeKind::resonance && (!out || s.size > out->size)) out = s;
  return out;
}

/// Between which neighbours A of a mode changes most.
std::string steepest_place(const Patient& p, Index mode) {
  std::size_t at = 0;
  const auto change = [&](std::size_t w) { return std::abs(p.c.A[w + 1](mode, mode) - p.c.A[w](mode, mode)); };
  for (std::size_t w = 0; w + 1 < p.c.omega.size(); ++w)
    if (change(w) > change(at)) at = w;
  return fmt::format("{:.4g} and {:.4g} rad/s", p.c.omega[at], p.c.omega[at + 1]);
}

/// What shows that a table is too coarse to tell A(∞) of a mode within `off`; empty if nothing does. (P45)
std::string signs_of_spacing(const Causal& f, double off, Index mode) {
  constexpr double as_much = 0.5;  // halved spacing leaves an eighth to a half of what the wider one misses
  std::string out;
  if (const double change = change_with_half_the_frequencies(f, mode); change >= as_much * off)
    out = fmt::format("without every second frequency that one changes by {:.2g}", change);
  if (const auto resonance = largest_resonance(f.p, mode); resonance && resonance->size >= as_much * off)
    out += fmt::format("{}the resonance at {} departs by {:.2g} of the mode's size from what its neighbours tell",
                       out.empty() ? "" : ", and ", frequency_text(f.p.c.omega[resonance->at]), resonance->size);
  return out;
}

/// Why A(∞) and the table disagree, and what to do: it may be the table that is too coarse to tell A(∞).
void explain_limit(const Causal& f, double off, Index mode, Finding& finding) {
  const std::string spacing = signs_of_spacing(f, off, mode);
  if (spacing.empty()) {
    finding.why = "A(∞) is the mass of a blow: a run with another one has other natural periods (P62)";
    finding.remedy = "compute A(∞) again, or leave it out: then it is told by A and B";
    return;
  }
  finding.message += "; the table is too coarse to tell: " + spacing;
  finding.why = "a resonance that falls between frequencies is missed in the memory of a run as it is here (P45)";
  finding.remedy =
      fmt::format("compute more frequencies about {}, between which A changes most", steepest_place(f.p, mode));
}

void look_at_limit(const Causal& f, Findings& out) {
  if (!f.p.c.A_inf) {
    out.push_back(not_looked_at("A(inf) by Ogilvie", "A(∞) is absent; runs take the one that A and B tell"));
    return;
  }
  Misfit worst;
  for (Index i = 0; i < f.p.c.modes(); ++i)
    if (const double off = std::abs((*f.p.c.A_inf)(i, i) - f.A_inf(i)) / f.p.size_of_A(i); off > worst.value)
      worst = {off, i};
  Finding finding{.check = "A(inf) by Ogilvie",
                  .where = entry_text("A", worst.mode, worst.mode, "infinite frequency"),
                  .message = fmt::format("A(∞) differs by {:.2g} of the largest A from the one that A(ω) and B(ω) tell",
                                         worst.value),
                  .body = static_cast<int>(worst.mode / 6) + 1,
                  .entry = {{static_cast<int>(worst.mode) + 1, static_cast<int>(worst.mode) + 1}}};
  constexpr double usual = 0.12, impossible = 0.35;  // tables that end early are off by 0.07
  if (worst.value > usual) {
    finding.severity = worst.value > impossible ? Severity::error : Severity::warning;
    explain_limit(f, worst.value, worst.mode, finding);
  }
  out.push_back(std::move(finding));
}

/// ∫ |B_ii| dω inside the given table, beyond its end as the added mass tells it, and what the first interval leaves
/// open.
struct Areas {
  VectorXd inside, beyond, before;
};

Areas areas(const Causal& f) {
  const auto& t = f.fitted;
  Areas a{VectorXd::Zero(f.p.c.modes()), VectorXd::Zero(f.p.c.modes()), {}};
  VectorXd last = VectorXd::Zero(f.p.c.modes());
  double omega = 0;
  for (std::size_t w = 0; w < t.omega.size(); ++w) {
    const VectorXd here = t.B[w].cwiseAbs();
    (w < f.given.omega.size() ? a.inside : a.beyond) += (t.omega[w] - omega) * (last + here) / 2;
    last = here;
    omega = t.omega[w];
  }
  // Between a straight line from nothing and the first value all the way down.
  a.before = f.given.omega.front() * f.given.B.front().cwiseAbs() / 2;
  return a;
}

/// The translation whose damping has died away least at the end of the table, of the body where that is worst; of a
/// body's translations the one that has died away most counts, since the others need a longer table by nature. (P63)
Misfit left_at_the_end(const Patient& p) {
  Misfit worst;
  for (int b = 0; b < p.c.bodies(); ++b) {
    Misfit best{1e300, 0};
    for (Index i = 6 * b; i < 6 * b + 3; ++i)
      if (acts(p.c.B, p.size_of_B, i) && std::abs(p.c.B.back()(i, i)) / p.size_of_B(i) < best.value)
        best = {std::abs(p.c.B.back()(i, i)) / p.size_of_B(i), i};
    if (best.value < 1e300 && best.value > worst.value) worst = best;
  }
  return worst;
}

void look_at_high_tail(const Causal& f, const Areas& a, Findings& out) {
  Misfit cost;
  for (Index i = 0; i < f.p.c.modes(); ++i)
    if (acts(f.p.c.B, f.p.size_of_B, i) && is_translation(i))
      if (const double share = a.beyond(i) / std::max(a.inside(i) + a.beyond(i), 1e-300); share > cost.value)
        cost = {share, i};
  const Misfit left = left_at_the_end(f.p);
  Finding finding{
      .check = "high-frequency tail",
      .where = fmt::format("beyond {}", frequency_text(f.p.c.omega.back())),
      .message = fmt::format("B of {} ends at {:.2g} of its largest value; cutting the table there costs {:.2g} % of "
                             "K's largest value ({}), before the tail is restored from A",
                             mode_label(left.mode), left.value, 100 * cost.value, mode_label(cost.mode)),
      .body = static_cast<int>(left.mode / 6) + 1,
      .omega = f.p.c.omega.back()};
  constexpr double usual = 0.25, impossible = 0.9;  // the boxes of examples/data reach 0.21 in heave
  if (left.value > usual) {
    finding.severity = left.value > impossible ? Severity::error : Severity::warning;
    finding.why = "K(t) is the integral of B: what is cut is missing at early times and rings at late ones (P63)";
    finding.remedy = "compute higher frequencies; `froude bem heal` writes the tail that the added mass tells";
  }
  out.push_back(std::move(finding));
}

void look_at_low_tail(const Causal& f, const Areas& a, Findings& out) {
  Misfit cost;
  for (Index i = 0; i < f.p.c.modes(); ++i)
    if (acts(f.p.c.B, f.p.size_of_B, i))
      if (const double share = a.before(i) / std::max(a.inside(i) + a.beyond(i), 1e-300); share > cost.value)
        cost = {share, i};
  Finding finding{.check = "low-frequency tail",
                  .where = fmt::format("below {}", frequency_text(f.p.c.omega.front())),
                  .message = fmt::format("what B does below the first frequency leaves {:.2g} % of K's largest value "
                                         "open ({})",
                                         100 * cost.value, mode_label(cost.mode)),
                  .body = static_cast<int>(cost.mode / 6) + 1,
                  .omega = f.p.c.omega.front()};
  constexpr double usual = 0.03, impossible = 0.2;  // tables that begin at a tenth of their peak leave 0.005
  if (cost.value > usual) {
    finding.severity = cost.value > impossible ? Severity::error : Severity::warning;
    finding.why = "slow waves make the late part of the memory, and B must vanish with ω (P63)";
    finding.remedy = "compute lower frequencies; a B that does not vanish there may be another quantity";
  }
  out.push_back(std::move(finding));
}

}  // namespace

void check_causality(const Patient& p, Findings& out) {
  const Causal f = p.c.omega.size() >= fewest_frequencies ? causal(p) : Causal{p, {}, {}, {}, {}, {}};
  if (f.samples.empty() || p.size_of_B.isZero(0)) {
    for (const char* check : {"Kramers-Kronig", "A(inf) by Ogilvie", "low-frequency tail", "high-frequency tail"})
      out.push_back(not_looked_at(check, p.size_of_B.isZero(0) ? "there is no damping" : "too few frequencies"));
    return;
  }
  look_at_kramers_kronig(f, out);
  look_at_limit(f, out);
  const Areas a = areas(f);
  look_at_low_tail(f, a, out);
  look_at_high_tail(f, a, out);
}

}  // namespace hydro::potential::doctor
