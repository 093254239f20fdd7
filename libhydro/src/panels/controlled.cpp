#include "controlled.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>

#include "extrapolate.hpp"
#include "potential/modes.hpp"
#include "potential/solver_request.hpp"
#include "refine.hpp"
#include "request.hpp"
#include "self_check.hpp"

namespace hydro::panels {
namespace {

using Eigen::MatrixXd;

constexpr std::size_t most_levels = 3;    // two differences, from which an order is seen
constexpr int most_unknowns = 4000;       // a system: half a minute of elimination
constexpr std::size_t least_samples = 5;  // a cubic, and one to test it by
/// A cubic that misses a node spans twice the distance: its error is seven times that of the cubic through all nodes.
/// Less is trusted, since few nodes may not be many enough for the law of small distances.
constexpr double of_omitted = 0.25;

/// What is added is the slope of the values times a shift in frequency, thus rougher than they are: three times at the
/// resonance of the water between two boxes.
constexpr double of_roughness = 4;

/// One mesh, and what it has been asked: of each frequency, and the two limits.
struct Level {
  std::unique_ptr<const Discretisation> mesh;
  std::unique_ptr<const Solver> solver;
  std::vector<std::optional<OneFrequency>> at;
  std::optional<MatrixXd> A_inf, A_zero;
};

/// What is lost by panels' size, by refining at some frequencies only, and by the partial waves that are left out
/// between hulls, relative (P11).
struct Estimate {
  double panels = 0, interpolation = 0, truncation = 0;
  double total() const { return panels + interpolation + truncation; }
};

class Ladder {
 public:
  Ladder(std::unique_ptr<const Discretisation> first, const std::vector<double>& omega,
         const std::vector<double>& heading, const Options& options)
      : omega_(omega), heading_(heading), options_(options) {
    wanted_ = first_samples(options);
    add(first->refined());
    more_ = first->with_more_partial_waves();
    more_waves_.resize(frequencies_of_more_waves().size());
    levels_.insert(levels_.begin(), level(std::move(first)));
  }

  /// Everything that is wanted and not known yet.
  void solve();
  Work work() const;
  Estimate estimate(const Work& w) const;
  /// Of what is added to the first mesh, interpolated.
  double interpolation_error(const Sizes& size) const;

  bool samples_all() const { return samples().size() == omega_.size(); }
  void double_samples() { wanted_ = 2 * wanted_ - 1; }
  bool can_refine() const { return levels_.size() < most_levels && unknowns_of_next() <= most_unknowns; }
  void refine() { add(levels_.back().mesh->refined()); }
  std::string why_not_finer() const;
  int finest_panels() const { return panels_of(levels_.back()); }

 private:
  struct Piece {
    Level* level;    ///< null: more partial waves, at look `at`
    std::size_t at;  ///< a frequency, or behind them ∞ and 0
  };

  Level level(std::unique_ptr<const Discretisation> mesh) const {
    auto solver = mesh->solver();
    Level out{std::move(mesh), std::move(solver), {}, {}, {}};
    out.at.resize(omega_.size());
    return out;
  }
  void add(std::unique_ptr<const Discretisation> mesh) {
    require_memory(mesh->cost(sample_omega(), heading_.size(), options_.threads, 0));
    levels_.push_back(level(std::move(mesh)));
  }
  static int panels_of(const Level& level) {
    SelfCheck check;
    level.mesh->describe(check);
    return check.panels;
  }
  std::vector<std::size_t> samples() const { return potential::spread(omega_.size(), wanted_, 0); }
  int unknowns_of_next() const {
    return levels_.back().mesh->cost({omega_.back()}, heading_.size(), 1, 1).refined_unknowns;
  }
  std::vector<Piece> missing();
  void do_piece(const Piece& piece);
  /// Where the first mesh is solved with more partial waves between hulls: none where there are none.
  std::vector<std::size_t> frequencies_of_more_waves() const {
    constexpr int looks = 3;
    return more_ ? potential::spread(omega_.size(), looks, omega_.size() - 1) : std::vector<std::size_t>{};
  }
  OneFrequency step(std::size_t frequency) const;
  std::vector<OneFrequency> corrections() const;
  std::vector<double> sample_omega() const;

  const std::vector<double>&omega_, &heading_;
  const Options& options_;
  std::vector<Level> levels_;
  std::unique_ptr<const Solver> more_;
  std::vector<std::optional<OneFrequency>> more_waves_;
  int wanted_ = 0, done_ = 0;
};

/// The finest first: its pieces take longest.
std::vector<Ladder::Piece> Ladder::missing() {
  std::vector<Piece> out;
  for (std::size_t i = 0; i < more_waves_.size(); ++i)
    if (!more_waves_[i]) out.push_back({nullptr, i});
  const std::size_t n = omega_.size();
  for (std::size_t l = levels_.size(); l-- > 0;) {
    Level& level = levels_[l];
    for (const std::size_t i : l == 0 ? potential::spread(n, static_cast<int>(n), 0) : samples())
      if (!level.at[i]) out.push_back({&level, i});
    if (!level.A_inf) out.push_back({&level, n});
    if (!level.A_zero && level.mesh->has_zero()) out.push_back({&level, n + 1});
  }
  return out;
}

void Ladder::do_piece(const Piece& piece) {
  if (piece.level == nullptr) {
    more_waves_[piece.at] = more_->at(omega_[frequencies_of_more_waves()[piece.at]], heading_);
    return;
  }
  const std::size_t n = omega_.size();
  const Solver& solver = *piece.level->solver;
  if (piece.at < n)
    piece.level->at[piece.at] = solver.at(omega_[piece.at], heading_);
  else if (piece.at == n)
    piece.level->A_inf = solver.added_mass_limit(std::numeric_limits<double>::infinity());
  else
    piece.level->A_zero = solver.added_mass_limit(0);
}

void Ladder::solve() {
  const std::vector<Piece> pieces = missing();
  const int all = done_ + static_cast<int>(pieces.size());
  std::mutex told;
  in_parallel(pieces.size(), potential::thread_count(options_.threads, pieces.size()), [&](std::size_t i) {
    do_piece(pieces[i]);
    const std::lock_guard<std::mutex> lock(told);
    ++done_;
    if (options_.progress) options_.progress(done_, all);
  });
}

OneFrequency Ladder::step(std::size_t frequency) const {
  std::vector<const OneFrequency*> all;
  for (const Level& level : levels_) all.push_back(&*level.at[frequency]);
  return step_to_the_limit(all);
}

/// What is added to the first mesh, at the samples.
std::vector<OneFrequency> Ladder::corrections() const {
  std::vector<OneFrequency> out;
  for (const std::size_t i : samples())
    out.push_back(sum(sum(*levels_.back().at[i], -1, *levels_.front().at[i]), 1, step(i)));
  return out;
}

std::vector<double> Ladder::sample_omega() const {
  std::vector<double> out;
  for (const std::size_t i : samples()) out.push_back(omega_[i]);
  return out;
}

OneFrequency weighted(const std::vector<OneFrequency>& values, const std::vector<double>& weights) {
  OneFrequency out = sum(values.front(), weights.front() - 1, values.front());
  for (std::size_t i = 1; i < values.size(); ++i)
    if (weights[i] != 0) out = sum(out, weights[i], values[i]);
  return out;
}

Work Ladder::work() const {
  Work w;
  const std::vector<OneFrequency> correction = corrections();
  const std::vector<double> nodes = sample_omega();
  for (std::size_t i = 0; i < omega_.size(); ++i)
    w.results.push_back(sum(*levels_.front().at[i], 1, weighted(correction, cubic_weights(nodes, omega_[i]))));
  std::vector<MatrixXd> inf, zero;
  for (const Level& level : levels_) {
    inf.push_back(*level.A_inf);
    if (level.A_zero) zero.push_back(*level.A_zero);
  }
  w.A_inf = inf.back() + step_to_the_limit(inf);
  if (!zero.empty()) w.A_zero = zero.back() + step_to_the_limit(zero);
  const Discretisation& first = *levels_.front().mesh;
  w.check = self_check(w.results, first.length());
  const Estimate e = estimate(w);
  w.check.estimate = e.total();
  w.check.interpolation = e.interpolation;
  w.check.truncation = e.truncation;
  w.check.refined_omega = nodes;
  for (const Level& level : levels_) w.check.extrapolated_from.push_back(panels_of(level));
  first.describe(w.check);
  return w;
}

Estimate Ladder::estimate(const Work& w) const {
  const Sizes size = sizes(w.results, w.check.length);
  Estimate e;
  for (const std::size_t i : samples()) e.panels = std::max(e.panels, largest(step(i), size));
  const auto limit = [&](std::optional<MatrixXd> Level::*which) {
    std::vector<MatrixXd> values;
    for (const Level& level : levels_) values.push_back(*(level.*which));
    e.panels = std::max(e.panels, potential::relative_size(step_to_the_limit(values), size.A));
  };
  limit(&Level::A_inf);
  if (w.A_zero) limit(&Level::A_zero);
  e.panels *= doubtful_share(levels_.size());
  if (!samples_all()) e.interpolation = interpolation_error(size);
  for (std::size_t i = 0; i < more_waves_.size(); ++i)
    e.truncation = std::max(
        e.truncation, largest(sum(*more_waves_[i], -1, *levels_.front().at[frequencies_of_more_waves()[i]]), size));
  return e;
}

double Ladder::interpolation_error(const Sizes& size) const {
  const std::vector<OneFrequency> correction = corrections();
  const std::vector<double> nodes = sample_omega();
  double missed = 0, added = 0, rough = 0;
  for (std::size_t s = 0; s < nodes.size(); ++s) {
    added = std::max(added, largest(correction[s], size));
    if (s == 0 || s + 1 == nodes.size()) continue;
    const std::vector<double> others = cubic_weights(nodes, nodes[s], static_cast<int>(s));
    missed = std::max(missed, largest(sum(correction[s], -1, weighted(correction, others)), size));
  }
  // A resonance between nodes is seen in the values of the first mesh, which are known everywhere: what is added is
  // taken to be a multiple as rough as they are.
  std::vector<OneFrequency> at_nodes;
  for (const std::size_t i : samples()) at_nodes.push_back(*levels_.front().at[i]);
  for (std::size_t i = 0; i < omega_.size(); ++i)
    rough = std::max(
        rough, largest(sum(*levels_.front().at[i], -1, weighted(at_nodes, cubic_weights(nodes, omega_[i]))), size));
  return std::max(of_omitted * missed, of_roughness * added * rough);
}

std::string by_truncation(double truncation) {
  return truncation > 0 ? fmt::format(" and {:.2g} by partial waves that are left out", truncation) : "";
}

std::string Ladder::why_not_finer() const {
  if (levels_.size() == most_levels) return fmt::format("{} panels are the finest of three meshes", finest_panels());
  return fmt::format("the next mesh would have {} unknowns a system, more than {}", unknowns_of_next(), most_unknowns);
}

}  // namespace

int first_samples(const Options& options) {
  return std::max(static_cast<int>(least_samples), options.refined_frequencies);
}

Work controlled_work(const Discretisation& given, const std::vector<double>& omega, const std::vector<double>& heading,
                     const Options& options) {
  Ladder ladder(given.graded(omega.back()), omega, heading, options);
  while (true) {
    ladder.solve();
    Work w = ladder.work();
    const double tolerance = *options.tolerance;
    const Estimate e = ladder.estimate(w);
    if (e.total() <= tolerance) return w;
    const bool more_samples = !ladder.samples_all() && (e.interpolation >= e.panels || e.panels < tolerance / 2);
    if (more_samples)
      ladder.double_samples();
    else if (ladder.can_refine())
      ladder.refine();
    else if (e.panels < tolerance && !ladder.samples_all())
      ladder.double_samples();
    else
      throw InputError(
          fmt::format("the error by panels is estimated at {:.2g}, {:.2g} of it by interpolation between {} refined "
                      "frequencies{}; {:.2g} is asked for, and {}",
                      e.total(), e.interpolation, w.check.refined_omega.size(), by_truncation(e.truncation), tolerance,
                      ladder.why_not_finer()),
          {},
          "make the mesh finer, above all at edges and at the waterline, leave out the shortest waves, or take a "
          "larger "
          "error by name: mesh_tolerance in a scene, --tolerance of froude bem solve");
  }
}

}  // namespace hydro::panels
