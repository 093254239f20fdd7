#include "controlled.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>

#include "extrapolate.hpp"
#include "parts.hpp"
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

/// A mesh whose own values are missed by more of their size between nodes bends there too much for what is added to it
/// at the nodes to tell what is added between them: the two boxes' resonance came out 50 % off where 22 % were told.
constexpr double most_rough = 0.1;

/// One mesh, and what it has been asked: of each frequency, and the two limits.
struct Level {
  std::unique_ptr<const Discretisation> mesh;
  std::unique_ptr<const Solver> solver;
  std::vector<std::optional<Extrapolated>> at;
  std::optional<Extrapolated> inf, zero;
};

using Limit = std::optional<Extrapolated> Level::*;
constexpr double infinite = std::numeric_limits<double>::infinity();

class Ladder {
 public:
  Ladder(std::unique_ptr<const Discretisation> first, const std::vector<double>& omega,
         const std::vector<double>& heading, const Options& options)
      : omega_(omega), heading_(heading), options_(options) {
    const std::size_t n = omega.size();
    samples_ = potential::spread(n, first->varies_smoothly() ? first_samples(options) : static_cast<int>(n), 0);
    add(first->refined());
    more_ = first->with_more_partial_waves();
    more_waves_.resize(frequencies_of_more_waves().size());
    levels_.insert(levels_.begin(), level(std::move(first)));
  }

  /// Everything that is wanted and not known yet.
  void solve();
  /// The answers, extrapolated, and their error in `estimate`.
  Work work(Estimate& estimate) const;

  bool samples_all() const { return samples_.size() == omega_.size(); }
  /// Refines at more frequencies where the first mesh, which is known everywhere, bends most between them, until it is
  /// missed nowhere by more than `most` of its size or there are `count` of them. Returns whether there are more.
  bool add_samples_where_rough(double most, std::size_t count);
  /// Twice as many, where the first mesh bends, or if it does so nowhere, evenly.
  void double_samples();
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
  Extrapolated step(std::size_t frequency) const;
  Extrapolated step(Limit limit) const;
  /// Divided by the scales at their frequencies; `of_step`: how much of the step to the limit is taken.
  std::vector<Extrapolated> corrections(double of_step = 1) const;
  /// Results with these corrections between all samples, or with a share of those between every second one.
  std::vector<OneFrequency> results(const std::vector<Extrapolated>& corrections, double share_of_second = 0) const;
  /// The value of the first mesh with the correction that these weights make of those.
  Extrapolated corrected(std::size_t frequency, const std::vector<Extrapolated>& corrections,
                         const std::vector<double>& weights) const;
  /// Work::doubted, of hulls with sections.
  std::vector<std::vector<OneFrequency>> doubted(const Work& w, const std::vector<Extrapolated>& correction) const;
  void find_scales();
  std::vector<double> sample_omega() const;
  const Level& first() const { return levels_.front(); }
  const Solver& solver() const { return *first().solver; }
  OneFrequency answer(std::size_t frequency, const Extrapolated& from) const {
    return solver().answer(omega_[frequency], heading_, from);
  }
  std::vector<OneFrequency> answers(const std::vector<Extrapolated>& of_each) const;
  std::optional<MatrixXd> limit(Limit which, double omega, const Sizes& size, double& doubtful) const;
  Eigen::VectorXd own_errors(const Work& w) const;
  Estimate estimate(const Work& w, const std::vector<Extrapolated>& correction, const Sizes& size) const;
  double interpolation_error(const Work& w, const std::vector<Extrapolated>& correction, const Sizes& size) const;
  std::vector<double> roughness() const;
  void find_known();
  bool add_sample(std::size_t frequency);  // false if it is one

  const std::vector<double>&omega_, &heading_;
  const Options& options_;
  std::vector<Level> levels_;
  std::vector<Extrapolated> scale_;               // at each frequency; empty: 1
  std::vector<std::vector<OneFrequency>> known_;  // by the first mesh: [hull that stands alone][frequency]
  std::unique_ptr<const Solver> more_;
  std::vector<std::optional<OneFrequency>> more_waves_;
  std::vector<std::size_t> samples_;  // where meshes are refined, rising
  int done_ = 0;
};

/// The finest first: its pieces take longest.
std::vector<Ladder::Piece> Ladder::missing() {
  std::vector<Piece> out;
  for (std::size_t i = 0; i < more_waves_.size(); ++i)
    if (!more_waves_[i]) out.push_back({nullptr, i});
  const std::size_t n = omega_.size();
  for (std::size_t l = levels_.size(); l-- > 0;) {
    Level& level = levels_[l];
    for (const std::size_t i : l == 0 ? potential::spread(n, static_cast<int>(n), 0) : samples_)
      if (!level.at[i]) out.push_back({&level, i});
    if (!level.inf) out.push_back({&level, n});
    if (!level.zero && level.mesh->has_zero()) out.push_back({&level, n + 1});
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
    piece.level->at[piece.at] = solver.solved(omega_[piece.at], heading_);
  else if (piece.at == n)
    piece.level->inf = solver.solved(infinite, {});
  else
    piece.level->zero = solver.solved(0, {});
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
  if (scale_.empty()) find_scales();  // of the first mesh, which finer ones leave as it is
  if (known_.empty() && !samples_all()) find_known();
}

Extrapolated Ladder::step(std::size_t frequency) const {
  std::vector<const Extrapolated*> all;
  for (const Level& level : levels_) all.push_back(&*level.at[frequency]);
  return step_to_the_limit(all);
}

Extrapolated Ladder::step(Limit limit) const {
  std::vector<const Extrapolated*> all;
  for (const Level& level : levels_) all.push_back(&*(level.*limit));
  return step_to_the_limit(all);
}

/// What is added to the first mesh, at the samples.
std::vector<Extrapolated> Ladder::corrections(double of_step) const {
  std::vector<Extrapolated> out;
  for (const std::size_t i : samples_) {
    out.push_back(sum(sum(*levels_.back().at[i], -1, *first().at[i]), of_step, step(i)));
    for (std::size_t m = 0; !scale_.empty() && m < out.back().size(); ++m)
      out.back()[m] = out.back()[m].cwiseQuotient(scale_[i][m]).eval();
  }
  return out;
}

void Ladder::find_scales() {
  std::vector<const Extrapolated*> all;
  for (const auto& one : first().at) all.push_back(&*one);
  scale_ = solver().scales(all);
}

std::vector<double> Ladder::sample_omega() const {
  std::vector<double> out;
  for (const std::size_t i : samples_) out.push_back(omega_[i]);
  return out;
}

Extrapolated weighted(const std::vector<Extrapolated>& values, const std::vector<double>& weights) {
  Extrapolated out = sum(values.front(), weights.front() - 1, values.front());
  for (std::size_t i = 1; i < values.size(); ++i)
    if (weights[i] != 0) out = sum(out, weights[i], values[i]);
  return out;
}

Extrapolated Ladder::corrected(std::size_t frequency, const std::vector<Extrapolated>& corrections,
                               const std::vector<double>& weights) const {
  Extrapolated added = weighted(corrections, weights);
  for (std::size_t m = 0; !scale_.empty() && m < added.size(); ++m)
    added[m] = added[m].cwiseProduct(scale_[frequency][m]).eval();
  return sum(*first().at[frequency], 1, added);
}

/// The weights of a cubic through every second of the nodes and the last.
std::vector<double> weights_of_every_second(const std::vector<double>& nodes, double x) {
  std::vector<double> kept, out(nodes.size());
  std::vector<std::size_t> place;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (i % 2 != 0 && i + 1 != nodes.size()) continue;
    kept.push_back(nodes[i]);
    place.push_back(i);
  }
  const std::vector<double> weights = cubic_weights(kept, x);
  for (std::size_t i = 0; i < kept.size(); ++i) out[place[i]] = weights[i];
  return out;
}

std::vector<OneFrequency> Ladder::results(const std::vector<Extrapolated>& corrections, double share_of_second) const {
  const std::vector<double> nodes = sample_omega();
  std::vector<Extrapolated> value;
  for (std::size_t i = 0; i < omega_.size(); ++i) {
    std::vector<double> weights = cubic_weights(nodes, omega_[i]);
    const std::vector<double> second = weights_of_every_second(nodes, omega_[i]);
    for (std::size_t n = 0; n < weights.size(); ++n) weights[n] += share_of_second * (second[n] - weights[n]);
    value.push_back(corrected(i, corrections, weights));
  }
  return answers(value);
}

/// Of all frequencies, several at a time.
std::vector<OneFrequency> Ladder::answers(const std::vector<Extrapolated>& of_each) const {
  std::vector<OneFrequency> out(of_each.size());
  in_parallel(out.size(), potential::thread_count(options_.threads, out.size()),
              [&](std::size_t i) { out[i] = answer(i, of_each[i]); });
  return out;
}

/// A in a limit, and by how much its last step changed it.
std::optional<MatrixXd> Ladder::limit(Limit which, double omega, const Sizes& size, double& doubtful) const {
  if (!(first().*which)) return {};
  const Extrapolated& finest = *(levels_.back().*which);
  const MatrixXd A = solver().added_mass(omega, sum(finest, 1, step(which)));
  doubtful = std::max(doubtful, potential::relative_size(A - solver().added_mass(omega, finest), size.A));
  return A;
}

Work Ladder::work(Estimate& e) const {
  Work w;
  const std::vector<Extrapolated> correction = corrections();
  const std::vector<double> nodes = sample_omega();
  w.results = results(correction);
  w.check = self_check(w.results, first().mesh->length());
  const Sizes size = sizes(w.results, w.check.length);
  e = estimate(w, correction, size);
  w.own_error = own_errors(w);
  double doubtful = 0;
  w.A_inf = *limit(&Level::inf, infinite, size, doubtful);
  w.A_zero = limit(&Level::zero, 0, size, doubtful);
  e.panels = std::max(e.panels, doubtful * doubtful_share(levels_.size()));
  w.check.estimate = e.total();
  w.check.interpolation = e.interpolation;
  w.check.truncation = e.truncation;
  w.check.refined_omega = nodes;
  for (const Level& level : levels_) w.check.extrapolated_from.push_back(panels_of(level));
  if (w.results.front().A_parts.rows() > 0) w.doubted = doubted(w, correction);
  first().mesh->describe(w.check);
  return w;
}

std::vector<std::vector<OneFrequency>> Ladder::doubted(const Work& w,
                                                       const std::vector<Extrapolated>& correction) const {
  std::vector<OneFrequency> divided;
  for (std::size_t i = 0; i < omega_.size(); ++i)
    divided.push_back(with_division_doubted(w.results[i], answer(i, *first().at[i])));
  return {results(corrections(1 - doubtful_share_of_parts(levels_.size()))),
          results(correction, samples_all() ? 0 : of_omitted), std::move(divided)};
}

Eigen::VectorXd Ladder::own_errors(const Work& w) const {
  OwnErrors own(w.results, w.check.length);
  for (const std::size_t i : samples_)
    own.take(sum(w.results[i], -1, answer(i, *levels_.back().at[i])), doubtful_share(levels_.size()));
  return own.of_mode;
}

Estimate Ladder::estimate(const Work& w, const std::vector<Extrapolated>& correction, const Sizes& size) const {
  Estimate e;
  for (const std::size_t i : samples_) {
    const OneFrequency finest = answer(i, *levels_.back().at[i]);
    e.panels = std::max(e.panels, doubtful_share(levels_.size()) * largest(sum(w.results[i], -1, finest), size));
  }
  if (!samples_all()) e.interpolation = interpolation_error(w, correction, size);
  const auto looks = frequencies_of_more_waves();
  for (std::size_t k = 0; k < looks.size(); ++k) {
    const OneFrequency fewer = answer(looks[k], *first().at[looks[k]]);
    e.truncation = std::max(e.truncation, truncation_of(fewer, *more_waves_[k], size));
  }
  return e;
}

double Ladder::interpolation_error(const Work& w, const std::vector<Extrapolated>& correction,
                                   const Sizes& size) const {
  const std::vector<std::size_t>& at = samples_;
  const std::vector<double> nodes = sample_omega();
  double missed = 0, added = 0;
  for (std::size_t s = 0; s < nodes.size(); ++s) {
    const Extrapolated& before = *first().at[at[s]];
    added = std::max(added, largest(sum(w.results[at[s]], -1, answer(at[s], before)), size));
    if (s == 0 || s + 1 == nodes.size()) continue;
    const std::vector<double> others = cubic_weights(nodes, nodes[s], static_cast<int>(s));
    const OneFrequency without = answer(at[s], corrected(at[s], correction, others));
    missed = std::max(missed, largest(sum(w.results[at[s]], -1, without), size));
  }
  const std::vector<double> rough = roughness();
  return std::max(of_omitted * missed, of_roughness * added * *std::max_element(rough.begin(), rough.end()));
}

/// A resonance between nodes is seen in the values of the first mesh, which are known everywhere: by how much their own
/// interpolation misses them at each frequency. What is added to them is taken to be a multiple as rough.
std::vector<double> Ladder::roughness() const {
  std::vector<Extrapolated> at_nodes;
  for (const std::size_t i : samples_) at_nodes.push_back(*first().at[i]);
  const std::vector<double> nodes = sample_omega();
  std::vector<Sizes> size;
  for (const auto& of_hull : known_) size.push_back(sizes(of_hull, first().mesh->length()));
  std::vector<double> rough(omega_.size(), 0);
  for (std::size_t i = 0; i < omega_.size(); ++i) {
    const auto by_nodes = solver().alone(omega_[i], heading_, weighted(at_nodes, cubic_weights(nodes, omega_[i])));
    for (std::size_t k = 0; k < known_.size(); ++k)
      rough[i] = std::max(rough[i], largest(sum(known_[k][i], -1, by_nodes[k]), size[k]));
  }
  return rough;
}

void Ladder::find_known() {
  for (std::size_t i = 0; i < omega_.size(); ++i) {
    const auto here = solver().alone(omega_[i], heading_, *first().at[i]);
    known_.resize(here.size());
    for (std::size_t k = 0; k < here.size(); ++k) known_[k].push_back(here[k]);
  }
}

bool Ladder::add_sample(std::size_t frequency) {
  const auto place = std::lower_bound(samples_.begin(), samples_.end(), frequency);
  if (place != samples_.end() && *place == frequency) return false;
  samples_.insert(place, frequency);
  return true;
}

bool Ladder::add_samples_where_rough(double most, std::size_t count) {
  const std::size_t before = samples_.size();
  while (samples_.size() < std::min(count, omega_.size())) {
    const std::vector<double> rough = roughness();
    const auto worst = std::max_element(rough.begin(), rough.end());
    const auto at = static_cast<std::size_t>(worst - rough.begin());
    if (*worst <= most || !add_sample(at)) break;  // at a node nothing but rounding is missed
  }
  return samples_.size() > before;
}

void Ladder::double_samples() {
  const std::size_t count = 2 * samples_.size() - 1;
  add_samples_where_rough(most_rough, count);
  for (const std::size_t i : potential::spread(omega_.size(), static_cast<int>(count), 0)) {
    if (samples_.size() >= count) break;
    add_sample(i);
  }
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
  Ladder ladder(given.graded(omega.back(), usual_gradings), omega, heading, options);
  const std::size_t most_samples = 3 * static_cast<std::size_t>(first_samples(options));
  while (true) {
    ladder.solve();
    if (ladder.add_samples_where_rough(most_rough, most_samples)) ladder.solve();
    Estimate e;
    Work w = ladder.work(e);
    const double tolerance = *options.tolerance;
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
