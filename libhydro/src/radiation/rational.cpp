#include "hydro/radiation/rational.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/interpolation.hpp"
#include "hydro/radiation/tail.hpp"
#include "mode_groups.hpp"
#include "passivity.hpp"
#include "pole_basis.hpp"
#include "vector_fit.hpp"

namespace hydro::radiation {

int PoleModel::order() const { return static_cast<int>(detail::columns(poles)); }

namespace {

/// Σ of the model's matrices, weighted by a row over its functions.
template <class Row>
auto weighted_sum(const PoleModel& m, const Row& row) {
  using Scalar = typename Row::Scalar;
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> sum =
      Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>::Zero(m.modes(), m.modes());
  Eigen::Index column = 0;
  for (std::size_t k = 0; k < m.poles.size(); ++k) {
    sum += row[column++] * m.C[k];
    if (m.poles[k].omega > 0) sum += row[column++] * m.S[k];
  }
  return sum;
}

}  // namespace

Eigen::MatrixXd PoleModel::kernel(double t_s) const { return weighted_sum(*this, detail::kernels_at(poles, t_s)); }

Eigen::MatrixXcd PoleModel::transform(double omega) const {
  return weighted_sum(*this, detail::basis_at(poles, omega));
}

namespace {

/// The data of a fit: modes that make waves, scaled to a largest damping of one, and the extrapolated damping beyond.
struct Data {
  std::vector<int> modes;   // of the caller that make waves
  Eigen::VectorXd scale;    // of those, √max B_ii
  std::size_t inside;       // frequencies of the table; the rest are of the tail
  detail::Samples samples;  // damping as the nearest that gives no energy
  Eigen::MatrixXd taken;    // what the table's damping lost by that, (inside, pairs)
  Eigen::MatrixXd A_inf;
  double centre;                                  // rad/s, where the scaled damping is largest
  std::vector<std::vector<Eigen::Index>> groups;  // of the modes above that feel each other, through others or not
};

Eigen::MatrixXd scaled(const Data& d, const Eigen::MatrixXd& m) {
  return d.scale.cwiseInverse().asDiagonal() * m(d.modes, d.modes) * d.scale.cwiseInverse().asDiagonal();
}

/// Frequencies at which the tail is followed, in units of the table's last one.
std::vector<double> tail_frequencies(double last) {
  std::vector<double> out;
  for (double factor = 1.1; factor < 5; factor *= 1.12) out.push_back(last * factor);
  return out;
}

/// What places beyond the table weigh beside those inside, at 1.
double weight_of_tail(double last, double omega) { return 0.1 * last / omega; }

/// What damping weighs at slow motions, as of moored bodies: they feel little of it, of which an error that is small
/// beside the largest may be a multiple.
double weight_of_damping(double omega, double centre) {
  constexpr double most = 10;  // more costs data between resonances, and gains little
  return std::clamp(std::pow(centre / omega, 2), 1.0, most);
}

/// Modes that move each other by more than `least` of their damping anywhere: a hull with a plane of symmetry has two
/// such groups.
std::vector<std::vector<Eigen::Index>> groups(const Data& d, double least) {
  const auto n = static_cast<Eigen::Index>(d.modes.size());
  const auto inside = static_cast<Eigen::Index>(d.inside);
  const Eigen::MatrixXd together =
      detail::unpacked(d.samples.values.topRows(inside).cwiseAbs().colwise().maxCoeff(), n);
  return detail::groups_of_modes(n, [&](Eigen::Index i, Eigen::Index j) { return together(i, j) > least; });
}

/// Places of a group's pairs among all that are packed.
std::vector<Eigen::Index> pairs_of(const std::vector<Eigen::Index>& group) {
  std::vector<Eigen::Index> out;
  for (std::size_t j = 0; j < group.size(); ++j)
    for (std::size_t i = 0; i <= j; ++i) out.push_back(detail::packed_place(group[i], group[j]));
  return out;
}

Data prepared(const DampingTable& given, const std::vector<Eigen::MatrixXd>& A,
              const std::optional<Eigen::MatrixXd>& A_inf, const FitOptions& options) {
  const ExtrapolatedDamping whole = extrapolated(given, A, A_inf);
  Data d;
  d.A_inf = whole.A_inf;
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(given.B.front().rows());
  for (const auto& B : given.B) largest = largest.cwiseMax(B.diagonal().cwiseAbs());
  for (Eigen::Index i = 0; i < largest.size(); ++i)
    if (largest[i] > 1e-6 * largest.maxCoeff()) d.modes.push_back(static_cast<int>(i));  // as (R5)
  d.scale = largest(d.modes).cwiseSqrt();
  d.inside = given.omega.size();
  d.samples.omega = given.omega;
  for (const double omega : tail_frequencies(given.omega.back())) d.samples.omega.push_back(omega);
  const auto n = static_cast<Eigen::Index>(d.modes.size());
  const auto rows = static_cast<Eigen::Index>(d.samples.omega.size());
  d.samples.weight.resize(2 * rows);
  d.samples.values.resize(rows, n * (n + 1) / 2);
  d.taken.resize(static_cast<Eigen::Index>(d.inside), d.samples.values.cols());
  double most = -1;
  for (Eigen::Index r = 0; r < rows; ++r) {
    const auto i = static_cast<std::size_t>(r);
    const double omega = d.samples.omega[i];
    const bool inside = i < d.inside;
    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(n, n), above = B;
    if (inside) {
      B = scaled(d, given.B[i]);
      above = scaled(d, A[i] - whole.A_inf);
    } else {
      if (omega < whole.table.omega.back())
        B = scaled(d, combined(cubic_stencil(whole.table.omega, omega), whole.table.B.size(),
                               [&](std::size_t k) { return whole.table.B[k]; }));
      above = scaled(d, added_mass_above_limit(whole.table, omega));
    }
    // The tail is a guess and only steers what the data leave open.
    const double weight = inside ? 1 : weight_of_tail(given.omega.back(), omega);
    d.samples.weight[r] = d.samples.weight[rows + r] = weight;
    const Eigen::MatrixXd symmetric = dense::symmetric_part(B);
    const Eigen::MatrixXd positive = options.enforce_passivity ? dense::positive_part(symmetric) : symmetric;
    if (inside) d.taken.row(r) = detail::packed(symmetric - positive);
    d.samples.values.row(r).real() = detail::packed(positive);
    d.samples.values.row(r).imag() = omega * detail::packed(dense::symmetric_part(above));
    if (B.trace() > most) {
      most = B.trace();
      d.centre = omega;
    }
  }
  d.groups =
      groups(d, options.tolerance / 1000);  // what is left out between them is of no account beside the tolerance
  return d;
}

/// Frequencies too few to weigh, or to leave poles of one order where those of the order before were: each of them
/// draws the whole of a model.
constexpr std::size_t few_frequencies = 16;

/// Frequencies of which a search takes mixtures and looks ahead: there it takes long, and orders are far from so high
/// that a model goes through single data, where errors jump from one order to the next.
constexpr std::size_t many_frequencies = 64;

/// The same with damping weighted where motions are slow.
Data weighted(Data d) {
  if (d.inside < few_frequencies) return d;
  for (std::size_t i = 0; i < d.samples.omega.size(); ++i)
    d.samples.weight[static_cast<Eigen::Index>(i)] *= weight_of_damping(d.samples.omega[i], d.centre);
  return d;
}

detail::Fitting fitting(const Data& d, const std::vector<Pole>& poles, const Eigen::MatrixXd& null) {
  const auto rows = static_cast<Eigen::Index>(d.samples.omega.size());
  Eigen::MatrixXcd phi(rows, null.cols() + 1);
  for (Eigen::Index r = 0; r < rows; ++r) {
    const double omega = d.samples.omega[static_cast<std::size_t>(r)];
    phi.row(r).head(null.cols()) = detail::basis_at(poles, omega) * null;
    phi(r, null.cols()) = {0, omega};  // a shift of A∞
  }
  return {d.samples.weighted(phi), d.samples.weighted(d.samples.values), 1};
}

/// Largest |error| over the table's own frequencies of each pair, relative by the scaling, (1, pairs).
Eigen::RowVectorXd errors(const Data& d, const detail::Fitting& f, const Eigen::MatrixXd& x) {
  Eigen::MatrixXd off = d.samples.weight.cwiseInverse().asDiagonal() * (f.design * x - f.right);
  const auto inside = static_cast<Eigen::Index>(d.inside), rows = off.rows() / 2;
  off.topRows(inside) -= d.taken;
  const Eigen::MatrixXd size =
      (off.topRows(inside).array().square() + off.middleRows(rows, inside).array().square()).sqrt();
  return size.colwise().maxCoeff();
}

/// Of packed pairs: the √2 off the diagonal is taken out again.
Eigen::MatrixXd per_pair(const Data& d, const Eigen::RowVectorXd& e) {
  return detail::unpacked(e, static_cast<Eigen::Index>(d.modes.size()));
}

/// Sum of squares at each frequency, of real parts above imaginary parts.
Eigen::VectorXd squares_at(const Eigen::MatrixXd& stacked) {
  const Eigen::VectorXd both = stacked.rowwise().squaredNorm();
  return both.head(both.size() / 2) + both.tail(both.size() / 2);
}

struct Attempt {
  std::vector<Pole> poles;
  Eigen::MatrixXd coefficients, shift;  // (columns, pairs), (1, pairs), scaled
  Eigen::VectorXd missed;               // sum of squares over the pairs at each sample, weighted
  FitReport report;
};

/// The coefficients that data ask for; none between modes of different groups.
Eigen::MatrixXd solution(const Data& d, const detail::Fitting& f) {
  const Eigen::MatrixXd all = detail::least_squares(f.design, f.right);
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(all.rows(), all.cols());
  for (const auto& group : d.groups) {
    const auto pairs = pairs_of(group);
    x(Eigen::all, pairs) = all(Eigen::all, pairs);
  }
  return x;
}

Attempt attempt(const Data& d, std::vector<Pole> poles) {
  Attempt a;
  a.poles = std::move(poles);
  const Eigen::MatrixXd null = detail::vanishing_at_rest(a.poles);
  const detail::Fitting f = fitting(d, a.poles, null);
  const Eigen::MatrixXd x = solution(d, f);
  a.coefficients = null * x.topRows(null.cols());
  a.shift = x.bottomRows(1);
  a.missed = squares_at(f.design * x - f.right);
  a.report.order = static_cast<int>(detail::columns(a.poles));
  a.report.error_per_pair = per_pair(d, errors(d, f, x));
  a.report.error = a.report.error_before = a.report.error_per_pair.maxCoeff();
  return a;
}

/// Made passive with margins, unless the fit that this begins with misses more than `worth` already: what is left to
/// do adds to that, and is most of the work. Tells whether the fit came near by the margins.
bool make_passive(const Data& d, const detail::Margins& margins, double worth, Attempt& a) {
  const Eigen::MatrixXd null = detail::vanishing_at_rest(a.poles);
  const detail::Fitting f = fitting(d, a.poles, null);
  const detail::WeightedDamping weighted(a.poles, d.centre);
  const auto of = [&](const std::vector<Eigen::Index>& pairs) {
    return detail::Fitting{f.design, f.right(Eigen::all, pairs), f.extra};
  };
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(f.design.cols(), f.right.cols());
  bool near = true;
  a.report.most_negative = a.report.lift = 0;
  for (const auto& group : d.groups) {
    const auto pairs = pairs_of(group);
    auto approached = detail::approach(weighted, null, of(pairs), static_cast<Eigen::Index>(group.size()), margins);
    x(Eigen::all, pairs) = approached.x;
    near = near && approached.near;
    a.report.most_negative = std::min(a.report.most_negative, approached.most_negative);
  }
  a.report.passive = errors(d, f, x).maxCoeff() <= worth;
  if (a.report.passive)
    for (const auto& group : d.groups) {
      const auto pairs = pairs_of(group);
      const auto covered = detail::cover(weighted, null, of(pairs), static_cast<Eigen::Index>(group.size()),
                                         margins.kept, x(Eigen::all, pairs));
      x(Eigen::all, pairs) = covered.x;
      a.report.passive = a.report.passive && covered.passive;
      a.report.lift = std::max(a.report.lift, covered.lift);
    }
  a.coefficients = null * x.topRows(null.cols());
  a.shift = x.bottomRows(1);
  a.report.error_per_pair = per_pair(d, errors(d, f, x));
  a.report.error = a.report.error_per_pair.maxCoeff();
  a.report.margin = a.report.passive ? margins.kept : 0;
  return near;
}

/// By which Q is kept positive: a small part of the tolerance, yet not so small that a certificate, which must tell it
/// from zero everywhere, takes more intervals than it has.
double margin_for(double tolerance) { return std::min(std::max(tolerance / 50, 2e-5), tolerance / 4); }

/// By a lift as soon as that is small, which is quick; where that costs the tolerance, by what needs hardly any.
void make_passive(const Data& d, double tolerance, Attempt& a) {
  const double margin = margin_for(tolerance), worth = 2 * tolerance;
  Attempt quick = a;
  const bool near = make_passive(d, {.kept = margin, .lifted = tolerance / 20}, worth, quick);
  if (near && (!quick.report.passive || quick.report.error > tolerance)) {
    make_passive(d, {.kept = margin, .lifted = 0}, worth, a);
    if (a.report.passive || !quick.report.passive) return;
  }
  a = std::move(quick);
}

/// How poles of one order after the other are found: from those of the order before, which is quick, or each anew from
/// poles spread over all frequencies.
enum class Search { onward, anew };

/// What keeps passive models from the data, as shares of the largest damping.
struct Floor {
  double error = 0;     ///< what any of them misses by, at least
  double nearest = 0;   ///< what the damping changes by where it becomes the nearest that gives no energy
  double at_omega = 0;  ///< rad/s, where the first is largest, or else the second
  /// Fits by least squares go to that nearest damping, so that they do not come much nearer.
  bool is_above(double tolerance) const { return error > tolerance || nearest > 2 * tolerance; }
};

/// By how much a mode's and two modes' damping [a c; c b] has to be changed at least, entry by entry, for them to take
/// energy from no motion; (R27).
double short_of_passive(double a, double b, double c) {
  const double trace = a + b + 2 * std::abs(c);
  return std::max({-a, -b, trace > 0 ? (c * c - a * b) / trace : 0});
}

/// The same of all modes in the motion that is given most energy.
double short_of_passive(const Eigen::MatrixXd& B) {
  const auto n = B.rows();
  double most = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j)
      most = std::max(most, short_of_passive(B(i, i), B(j, j), i == j ? 0 : B(i, j)));
  const auto [values, vectors] = dense::symmetric_eigen(B);
  return std::max(most, -values[0] / std::pow(vectors.col(0).lpNorm<1>(), 2));
}

Floor floor_of_passive(const Data& d) {
  const auto n = static_cast<Eigen::Index>(d.modes.size());
  Floor out;
  double nearest_at = 0;
  for (std::size_t k = 0; k < d.inside; ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    const double changed = detail::unpacked(d.taken.row(row), n).cwiseAbs().maxCoeff();
    if (changed == 0) continue;
    if (changed > out.nearest) {
      out.nearest = changed;
      nearest_at = d.samples.omega[k];
    }
    if (const double e = short_of_passive(detail::unpacked(d.samples.values.row(row).real() + d.taken.row(row), n));
        e > out.error) {
      out.error = e;
      out.at_omega = d.samples.omega[k];
    }
  }
  if (out.error == 0) out.at_omega = nearest_at;
  return out;
}

/// True if no attempt has come nearer by a fifth while the order doubled, where one is as near as passive data let it,
/// or else while it grew fourfold: errors may rest for a while before they reach a floor.
bool stands_still(const std::vector<Attempt>& all, const Floor& floor) {
  const auto least = [&](int from, int to) {
    double best = std::numeric_limits<double>::infinity();
    for (const Attempt& a : all)
      if (a.report.order > from && a.report.order <= to) best = std::min(best, a.report.error);
    return best;
  };
  const int last = all.back().report.order;
  const bool reached = least(0, last) < 2 * std::max(floor.error, floor.nearest);
  const int before = last / (reached ? 2 : 4);
  return least(before, last) > 0.8 * least(0, before);
}

/// Orders to try, up to `most`.
std::vector<int> orders(int most) {
  std::vector<int> out;
  for (int order = 2; order <= most; order += order < 12 ? 2 : order < 32 ? 4 : order < 64 ? 8 : 16)
    out.push_back(order);
  return out;
}

/// Finds poles of one order.
class PoleSearch {
 public:
  PoleSearch(const Data& d, double tolerance) : d_(d) {
    // Columns of the search: with as many as there are, poles are no better where data are many.
    const Eigen::Index enough = d.inside < many_frequencies ? d.samples.values.cols() : 16;
    searched_ = detail::mixed(detail::compressed(d.samples, 1e-2 * tolerance), enough);
    double widest = 0;
    for (std::size_t i = 1; i < d.inside; ++i) widest = std::max(widest, d.samples.omega[i] - d.samples.omega[i - 1]);
    slowest_ = widest / 10;  // a resonance much narrower than the spacing cannot be told from the data
  }

  /// Where data are few, poles of a high order never settle: the nearest to the data of the last rounds.
  Attempt anew(int order) const {
    constexpr int rounds = 15;  // by which they settle
    const int looked_at = d_.inside < many_frequencies ? 4 : 0;
    auto poles = detail::settled(searched_, detail::spread(d_.samples.omega, order), rounds - looked_at, slowest_);
    Attempt best = attempt(d_, poles);
    for (int i = 0; i < looked_at; ++i) {
      poles = detail::settled(searched_, std::move(poles), 1, slowest_);
      if (Attempt a = attempt(d_, poles); a.report.error < best.report.error) best = std::move(a);
    }
    return best;
  }
  /// From poles of a lower order, and what they missed.
  Attempt onward(const std::vector<Pole>& poles, int order, const Eigen::VectorXd& missed) const {
    constexpr int rounds = 5;  // where all but a few were settled
    return attempt(d_,
                   detail::settled(searched_, detail::grown(poles, order, d_.samples.omega, missed), rounds, slowest_));
  }

 private:
  const Data& d_;
  detail::Samples searched_;
  double slowest_;
};

/// Attempts of rising order, until one meets the tolerance; that is then the last. Where none can, until they stand
/// still.
struct Attempts {
  std::vector<Attempt> all;
  bool met = false;
};

Attempts attempts(const Data& d, const FitOptions& options, int most, Search search, const Floor& floor) {
  const PoleSearch finder(d, options.tolerance);
  Attempts out;
  std::vector<Pole> poles;
  Eigen::VectorXd missed = squares_at(d.samples.weighted(d.samples.values));
  for (const int order : orders(most)) {
    Attempt a = search == Search::anew ? finder.anew(order) : finder.onward(poles, order, missed);
    poles = a.poles;
    missed = a.missed;
    if (a.report.error <= options.tolerance && options.enforce_passivity) make_passive(d, options.tolerance, a);
    out.met = a.report.error <= options.tolerance && (a.report.passive || !options.enforce_passivity);
    out.all.push_back(std::move(a));
    if (out.met || (floor.is_above(options.tolerance) && stands_still(out.all, floor))) break;
  }
  return out;
}

/// What another attempt has to come below to stand in place of `best`, since the weights with which that was found
/// serve slow motions better.
double worth_it(const FitOptions& options, const FitReport& best) {
  constexpr double much_nearer = 0.8;
  return std::max(options.tolerance, much_nearer * best.error);
}

/// Whether poles searched anew come near enough to that at the largest order or at that of `best`: from order to order
/// errors scatter by less than a half, and passivity seldom lowers them, and by little. A search at all orders costs
/// three times the one before.
bool is_promising(const Data& d, const FitOptions& options, int most, const FitReport& best) {
  if (d.inside < many_frequencies) return true;
  constexpr double between_orders = 1.5;
  const PoleSearch finder(d, options.tolerance);
  const int largest = orders(most).back();
  const auto promises = [&](int order) {
    return finder.anew(order).report.error < between_orders * worth_it(options, best);
  };
  return promises(largest) || (best.order != largest && promises(best.order));
}

/// Of those that all miss the tolerance: the nearest to the data, made passive, which is most of the work. It may be
/// far from passive; then a few more are made so, the nearest first, until none that is left was nearer before.
Attempt nearest(const Data& d, const FitOptions& options, std::vector<Attempt> tried) {
  std::sort(tried.begin(), tried.end(),
            [](const Attempt& a, const Attempt& b) { return a.report.error < b.report.error; });
  if (!options.enforce_passivity) return std::move(tried.front());
  constexpr std::size_t few = 3;  // beyond, orders are so low that they miss more than passivity takes
  const auto better = [](const FitReport& a, const FitReport& b) {
    return a.passive != b.passive ? a.passive : a.error < b.error;
  };
  // What others may gain where passivity took little is no more than orders differ by, a tenth or two.
  const auto is_near_passive = [](const FitReport& r) { return r.error < 3 * r.error_before; };
  const double margin = margin_for(options.tolerance);
  std::size_t best = 0;
  for (std::size_t i = 0; i < std::min(few, tried.size()); ++i) {
    const FitReport& so_far = tried[best].report;
    if (i > 0 && so_far.passive && (is_near_passive(so_far) || so_far.error <= tried[i].report.error)) break;
    if (!tried[i].report.passive)
      make_passive(d, {.kept = margin, .lifted = 0}, std::numeric_limits<double>::infinity(), tried[i]);
    if (better(tried[i].report, so_far)) best = i;
  }
  return std::move(tried[best]);
}

RationalFit unscaled(const Data& d, const Attempt& a) {
  const Eigen::Index n = d.A_inf.rows(), inner = static_cast<Eigen::Index>(d.modes.size());
  const auto whole = [&](const Eigen::RowVectorXd& row) {
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(n, n);
    m(d.modes, d.modes) = d.scale.asDiagonal() * detail::unpacked(row, inner) * d.scale.asDiagonal();
    return m;
  };
  RationalFit out;
  out.report = a.report;
  out.report.error_per_pair = Eigen::MatrixXd::Zero(n, n);
  out.report.error_per_pair(d.modes, d.modes) = a.report.error_per_pair;
  out.model.poles = a.poles;
  Eigen::Index column = 0;
  for (const Pole& p : a.poles) {
    out.model.C.push_back(whole(a.coefficients.row(column++)));
    out.model.S.push_back(p.omega > 0 ? whole(a.coefficients.row(column++)) : Eigen::MatrixXd::Zero(n, n));
  }
  const Eigen::MatrixXd shift = whole(a.shift);
  const Eigen::VectorXd size =
      d.A_inf.diagonal().cwiseAbs().cwiseMax(1e-12 * d.A_inf.cwiseAbs().maxCoeff()).cwiseSqrt().cwiseInverse();
  out.report.shift = (size.asDiagonal() * shift.cwiseAbs() * size.asDiagonal()).maxCoeff();
  out.A_inf = d.A_inf + shift;
  return out;
}

}  // namespace

RationalFit fit(const DampingTable& damping, const std::vector<Eigen::MatrixXd>& A,
                const std::optional<Eigen::MatrixXd>& A_inf, const FitOptions& options) {
  require(damping.omega.size() >= 4, "a rational fit needs four frequencies at least, got {}", damping.omega.size());
  require(options.tolerance > 0 && options.largest_order >= 2,
          "a fit needs a positive tolerance and an order of 2 at least");
  const double negative = negative_share(damping);  // refuses a source of power
  const Data even = prepared(damping, A, A_inf, options), d = weighted(even);
  require(!d.modes.empty(), "there is no damping to fit: no mode makes waves");
  const int most = std::min(options.largest_order, static_cast<int>(3 * damping.omega.size() / 2));
  const auto told = [&](const Data& of, Attempt a, std::string why) {
    a.report.why = std::move(why);
    a.report.negative_share = negative;
    return unscaled(of, a);
  };
  const auto lowest = [&](const Data& of, Attempts found) {
    return told(of, found.all.back(),
                fmt::format("order {} is the lowest that meets the tolerance of {:.2g}", found.all.back().report.order,
                            options.tolerance));
  };
  const bool few = damping.omega.size() < few_frequencies;
  const Floor floor = options.enforce_passivity ? floor_of_passive(even) : Floor{};
  const bool hopeless = floor.is_above(options.tolerance);
  Attempts found = attempts(d, options, most, few ? Search::anew : Search::onward, floor);
  if (found.met) return lowest(d, std::move(found));
  Attempt best = nearest(d, options, std::move(found.all));
  // Weights and quick ways may stand in the way of a tolerance that could just be met, or of one much nearer to it.
  if (!few && !hopeless && is_promising(even, options, most, best.report)) {
    Attempts others = attempts(even, options, most, Search::anew, floor);
    if (others.met) return lowest(even, std::move(others));
    const double below = worth_it(options, best.report);
    std::erase_if(others.all, [&](const Attempt& a) { return a.report.error >= below; });
    if (!others.all.empty()) {
      Attempt other = nearest(even, options, std::move(others.all));
      if (other.report.passive >= best.report.passive && other.report.error < below) best = std::move(other);
    }
  }
  const FitReport& report = best.report;
  std::string why = fmt::format("no order up to {} meets the tolerance of {:.2g}", most, options.tolerance);
  if (hopeless)
    why = fmt::format(
        "the damping of the data would give energy at {:.3g} rad/s, so that no passive model comes nearer than {:.2g} "
        "to them; the nearest damping that gives none is {:.2g} from them, beyond the tolerance of {:.2g}",
        floor.at_omega, floor.error, floor.nearest, options.tolerance);
  return told(d, best,
              fmt::format("{}; order {} comes nearest with {:.2g}{}", why, report.order, report.error,
                          report.passive || !options.enforce_passivity ? "" : ", and is not certified passive"));
}

namespace {

/// Where the damping of all modes, each over its largest, is largest, rad/s.
double centre_of(const PoleModel& model, const std::vector<double>& omega) {
  Eigen::MatrixXd diagonals(model.modes(), static_cast<Eigen::Index>(omega.size()));
  for (std::size_t k = 0; k < omega.size(); ++k)
    diagonals.col(static_cast<Eigen::Index>(k)) = model.transform(omega[k]).real().diagonal();
  const Eigen::VectorXd largest = diagonals.rowwise().maxCoeff();
  const double least = 1e-6 * largest.maxCoeff();  // as prepared()
  Eigen::Index at = 0;
  const Eigen::RowVectorXd share = (largest.array() > least).select(largest.array().inverse(), 0).transpose();
  (share * diagonals).maxCoeff(&at);
  return omega[static_cast<std::size_t>(at)];
}

}  // namespace

std::vector<Eigen::MatrixXcd> missed_if_left_out(const PoleModel& model, const std::vector<double>& omega,
                                                 const std::vector<Eigen::MatrixXcd>& residual) {
  std::vector<double> places = omega;
  for (const double beyond : tail_frequencies(omega.back())) places.push_back(beyond);
  const Eigen::MatrixXd null = detail::vanishing_at_rest(model.poles);
  const auto rows = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXcd phi(rows, null.cols() + 1);
  for (Eigen::Index r = 0; r < rows; ++r) {
    const double at = places[static_cast<std::size_t>(r)];
    phi.row(r).head(null.cols()) = detail::basis_at(model.poles, at) * null;
    phi(r, null.cols()) = {0, at};
    if (at > omega.back()) phi.row(r) *= weight_of_tail(omega.back(), at);
  }
  Eigen::MatrixXd design = detail::stacked(phi);
  const double centre = centre_of(model, omega);
  Eigen::VectorXd weight(rows);  // of damping, as fit() weighs it
  for (Eigen::Index r = 0; r < rows; ++r) {
    weight[r] = omega.size() < few_frequencies ? 1 : weight_of_damping(places[static_cast<std::size_t>(r)], centre);
    design.row(r) *= weight[r];
  }
  for (auto column : design.colwise()) column /= column.norm();
  const Eigen::MatrixXd Q = dense::HouseholderQr(design).thin_Q();
  constexpr double least = 1e-6;  // of what a datum leaves free; a model that goes through all data leaves nothing
  std::vector<Eigen::MatrixXcd> out;
  for (std::size_t k = 0; k < omega.size(); ++k) {
    const auto r = static_cast<Eigen::Index>(k);
    Eigen::Matrix<double, 2, Eigen::Dynamic> both(2, Q.cols());
    both << Q.row(r), Q.row(r + rows);
    const Eigen::Matrix2d h = both * both.transpose();
    const Eigen::DiagonalMatrix<double, 2> weights(weight[r], 1);
    const Eigen::Matrix2d more =
        weights.inverse() * (((1 + least) * Eigen::Matrix2d::Identity() - h).inverse() * h) * weights;
    Eigen::MatrixXcd missed(residual[k].rows(), residual[k].cols());
    missed.real() = more(0, 0) * residual[k].real() + more(0, 1) * residual[k].imag();
    missed.imag() = more(1, 0) * residual[k].real() + more(1, 1) * residual[k].imag();
    out.push_back(std::move(missed));
  }
  return out;
}

}  // namespace hydro::radiation
