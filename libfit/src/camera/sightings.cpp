#include "fit/camera/sightings.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

#include "hydro/base/random.hpp"
#include "hydro/signal/distributions.hpp"

namespace fit::camera {
namespace {

/// A sighting beside the path through all others of its marker.
struct Beside {
  Eigen::Vector2d left;   ///< what the smoothed place, which counts the sighting itself, leaves over
  Eigen::Vector2d whole;  ///< the distance from the path without it
  Eigen::Vector2d units;  ///< independent numbers of variance 1, where path and noise are as the smoother has them
  double place_variance;  ///< of the smoothed place, mean of both coordinates
  double free;            ///< share of the sighting's variance that the smoothed place does not have
  double square() const { return units.squaredNorm(); }
};
using Row = std::vector<std::optional<Beside>>;  // one a frame

Track alone(const Track& track, std::size_t marker) {
  Track out{.time = track.time, .markers = {track.markers[marker]}, .in_metres = track.in_metres, .size = track.size};
  return out;
}

std::size_t seen_in(const Track& one) {
  const auto& seen = one.markers[0].seen;
  return static_cast<std::size_t>(std::count_if(seen.begin(), seen.end(), [](const auto& s) { return s.has_value(); }));
}

/// (V30) Without one sighting of covariance R at z the path would be off from it by R (R − P)⁻¹ (z − x), with the
/// covariance R (R − P)⁻¹ R; none where that sighting alone tells the place.
Row beside_others(const Track& one, double bandwidth_hz) {
  const SmoothTrack path = smooth(one, {.bandwidth_hz = bandwidth_hz});
  constexpr double alone_above = 0.999;  // of the variance: what the others tell is lost in rounding and in the start
  Row out(one.frames());
  for (std::size_t i = 0; i < one.frames(); ++i) {
    const auto& s = one.markers[0].seen[i];
    if (!s) continue;
    Eigen::Matrix2d p;
    const Eigen::MatrixXd& all = path.covariance[i];
    p << all(0, 0), all(0, 3), all(3, 0), all(3, 3);
    const Eigen::Matrix2d rest = s->covariance - p;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> of_rest(rest, Eigen::EigenvaluesOnly);
    if (!(of_rest.eigenvalues()[0] > (1 - alone_above) * s->covariance.trace() / 2)) continue;
    const Eigen::LLT<Eigen::Matrix2d> root(rest);
    const Eigen::Vector2d left = s->at - Eigen::Vector2d(path.state[i][0], path.state[i][3]);
    out[i] = Beside{left, s->covariance * root.solve(left), root.matrixL().solve(left), p.trace() / 2,
                    rest.trace() / s->covariance.trace()};
  }
  return out;
}

/// Hz: half of the frames' rate, less what rounding makes of it.
double widest_of(const Track& one) {
  return 0.49 * static_cast<double>(one.frames() - 1) / (one.time.back() - one.time.front());
}

double median_square(const std::vector<Row>& rows) {
  std::vector<double> squares;
  for (const Row& row : rows)
    for (const auto& b : row)
      if (b) squares.push_back(b->square());
  if (squares.empty()) return 0;
  const auto middle = squares.begin() + std::ssize(squares) / 2;
  std::nth_element(squares.begin(), middle, squares.end());
  return *middle;
}

/// What neighbours in time have in common: of signs, which a single wrong one hardly moves, and of what is left over.
struct Memory {
  double signs = 0, products = 0, variance = 0;  ///< means a coordinate; the last of smoothed places
  std::size_t pairs = 0;
};
Memory memory_of(const std::vector<Row>& rows) {
  Memory out;
  const auto sign = [](double x) { return x < 0 ? -1.0 : 1.0; };
  for (const Row& row : rows)
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      if (!row[i] || !row[i + 1]) continue;
      for (Eigen::Index c = 0; c < 2; ++c) out.signs += sign(row[i]->units[c]) * sign(row[i + 1]->units[c]) / 2;
      out.products += row[i]->left.dot(row[i + 1]->left) / 2;
      out.variance += row[i]->place_variance;
      ++out.pairs;
    }
  const auto n = static_cast<double>(std::max<std::size_t>(out.pairs, 1));
  out.signs /= n, out.products /= n, out.variance /= n;
  return out;
}

/// (V31) Noise alone, as it is stated, at the frames and through the band of the track: what is left over of it has a
/// variance and a memory that depend on both.
std::vector<Row> of_noise(Track one, double bandwidth_hz) {
  constexpr std::size_t enough = 4000, most = 20;  // sightings: their median is known to 2 %
  const std::size_t trials = std::clamp<std::size_t>(enough / std::max<std::size_t>(seen_in(one), 1), 1, most);
  std::vector<Row> out;
  for (std::size_t k = 0; k < trials; ++k) {
    const hydro::RandomStream random(k + 1, 63);  // the same numbers in each call
    std::uint64_t at = 0;
    for (auto& s : one.markers[0].seen) {
      if (!s) continue;
      const Eigen::Vector2d normal(random.normal(at), random.normal(at + 1));
      at += 2;
      s->at = Eigen::LLT<Eigen::Matrix2d>(s->covariance).matrixL() * normal;
    }
    out.push_back(beside_others(one, bandwidth_hz));
  }
  return out;
}

/// (V31) \p noise is what is left over of noise as it is stated.
Scatter scatter_of(const std::string& marker, const Row& row, const std::vector<Row>& noise) {
  Scatter out{marker, 1, 0};
  double freedoms = 0;  // what the path does not follow: so many numbers of each coordinate are left over
  for (const auto& b : row)
    if (b) freedoms += b->free;
  const double expected = median_square(noise);
  if (freedoms < 5 || !(expected > 0)) return out;
  // One marker in a thousand by chance: 3.1 deviations. Those of a median of n squares of two numbers are 1.44/√n.
  constexpr double chance = 3.1, of_median = 1.44;
  const double unsure = std::sqrt(1 + 1 / static_cast<double>(noise.size()));
  const double larger = median_square({row}) / expected;
  if (larger > 1 + chance * of_median * unsure / std::sqrt(freedoms)) out.factor = std::sqrt(larger);
  const Memory seen = memory_of({row}), stated = memory_of(noise);
  if (seen.pairs < 5) return out;
  const double by_chance = chance * unsure / std::sqrt(2 * freedoms);
  const double cut = seen.products - out.factor * out.factor * stated.products;
  if (seen.signs - stated.signs > by_chance && cut > 0) out.lost = std::sqrt(cut / seen.variance) / out.factor;
  return out;
}

/// One marker whose sightings are judged.
class Judged {
 public:
  Judged(Track one, double bandwidth_hz, double level)
      : one_(std::move(one)), hertz_(bandwidth_hz), gate_(hydro::signal::chi_square_quantile(level, 2)) {}

  SightingCheck result() {
    const std::string& name = one_.markers[0].name;
    const std::vector<Row> noise = of_noise(one_, hertz_);
    Row row = beside_others(one_, hertz_);
    const Scatter first = scatter_of(name, row, noise);
    gate_ *= first.factor * first.factor;
    SightingCheck out;
    const Row wider = beside_others(one_, std::min(2 * hertz_, widest_of(one_)));
    // More of them are no single faults: all are named as they are.
    const std::size_t most = 1 + seen_in(one_) / 20;
    if (beyond(row) > 2 * most) out.misfits = runs_beyond(row);
    while (out.misfits.size() <= most && beyond(row) > 0) {
      out.misfits.push_back(take_worst(row));
      if (!out.misfits.back().settles) break;
      row = beside_others(one_, hertz_);
    }
    for (Misfit& m : out.misfits) {
      m.errors /= first.factor;
      m.faster = fits(wider, m);
    }
    out.markers.push_back(scatter_of(name, row, noise));
    return out;
  }

 private:
  std::size_t beyond(const Row& row) const {
    return static_cast<std::size_t>(
        std::count_if(row.begin(), row.end(), [&](const auto& b) { return b && b->square() > gate_; }));
  }

  bool fits(const Row& row, const Misfit& m) const {
    for (std::size_t i = m.first - std::min<std::size_t>(m.first, 1); i <= std::min(m.last + 1, row.size() - 1); ++i)
      if (row[i] && row[i]->square() > gate_) return false;
    return true;
  }

  /// Neighbours in time that do not fit, each run of them as one.
  std::vector<Misfit> runs_beyond(const Row& row) const {
    std::vector<Misfit> out;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (!row[i] || row[i]->square() <= gate_) continue;
      if (out.empty() || out.back().last + 1 != i) out.push_back({one_.markers[0].name, i, i, 0, 0, true, false});
      out.back().last = i;
      out.back().away = std::max(out.back().away, row[i]->whole.norm());
      out.back().errors = std::max(out.back().errors, std::sqrt(row[i]->square()));
    }
    return out;
  }

  /// (V30) The fewest frames about the worst one without which its surroundings fit; they leave the track.
  Misfit take_worst(const Row& row) {
    std::size_t worst = 0;
    double largest = 0;
    for (std::size_t i = 0; i < row.size(); ++i)
      if (row[i] && row[i]->square() > largest) largest = row[i]->square(), worst = i;
    constexpr std::size_t longest = 12;
    for (std::size_t frames = 1; frames <= longest; ++frames)
      if (const auto begin = block_of(frames, worst)) return without(*begin, *begin + frames - 1);
    return {one_.markers[0].name, worst, worst, row[worst]->whole.norm(), std::sqrt(largest), false, false};
  }

  /// Where a block of so many frames begins without which all about it fits best; none if none does.
  std::optional<std::size_t> block_of(std::size_t frames, std::size_t worst) const {
    std::optional<std::size_t> out;
    double least = gate_;
    for (std::size_t begin = worst - std::min(worst, frames); begin <= worst + 1; ++begin) {
      const std::size_t last = begin + frames - 1;
      if (last >= one_.frames() || !one_.markers[0].seen[begin] || !one_.markers[0].seen[last]) continue;
      if (const auto left = largest_without(begin, last); left && *left <= least) least = *left, out = begin;
    }
    return out;
  }

  /// The largest square near these frames when they are left out; none where too little is left.
  std::optional<double> largest_without(std::size_t first, std::size_t last) const {
    constexpr std::size_t around = 40, near = 5;  // frames: the first fills the smoother's memory many times
    const std::size_t from = first - std::min(first, around), to = std::min(one_.frames(), last + 1 + around);
    Track part{.time = {}, .markers = {{one_.markers[0].name, {}}}, .in_metres = one_.in_metres, .size = one_.size};
    for (std::size_t i = from; i < to; ++i) {
      part.time.push_back(one_.time[i]);
      part.markers[0].seen.push_back(i < first || i > last ? one_.markers[0].seen[i] : std::nullopt);
    }
    if (seen_in(part) < 5) return std::nullopt;
    const Row row = beside_others(part, hertz_);
    double out = 0;
    for (std::size_t i = 0; i < row.size(); ++i)
      if (row[i] && i + from + near >= first && i + from <= last + near) out = std::max(out, row[i]->square());
    return out;
  }

  Misfit without(std::size_t first, std::size_t last) {
    const Track whole = one_;
    for (std::size_t i = first; i <= last; ++i) one_.markers[0].seen[i].reset();
    const SmoothTrack path = smooth(one_, {.bandwidth_hz = hertz_});
    Misfit out{one_.markers[0].name, first, last, 0, 0, true, false};
    for (std::size_t i = first; i <= last; ++i) {
      const auto& s = whole.markers[0].seen[i];
      if (!s) continue;
      const MarkerMotion there = path.marker(0, i);
      const double away = (s->at - there.place).norm();
      out.away = std::max(out.away, away);
      out.errors = std::max(out.errors, away / std::sqrt((s->covariance.trace() + there.place_sd.squaredNorm()) / 2));
    }
    return out;
  }

  Track one_;
  double hertz_, gate_;
};

}  // namespace

SightingCheck check_sightings(const Track& track, double bandwidth_hz) {
  std::size_t sightings = 0;
  for (std::size_t m = 0; m < track.markers.size(); ++m) sightings += seen_in(alone(track, m));
  constexpr double clean = 0.99;
  const double level = std::pow(clean, 1 / static_cast<double>(std::max<std::size_t>(sightings, 1)));
  SightingCheck out;
  for (std::size_t m = 0; m < track.markers.size(); ++m) {
    SightingCheck one = Judged(alone(track, m), bandwidth_hz, level).result();
    std::move(one.misfits.begin(), one.misfits.end(), std::back_inserter(out.misfits));
    std::move(one.markers.begin(), one.markers.end(), std::back_inserter(out.markers));
  }
  return out;
}

Track widened(const Track& track, const SightingCheck& check) {
  Track out = track;
  for (std::size_t m = 0; m < out.markers.size(); ++m)
    for (auto& s : out.markers[m].seen)
      if (s) s->covariance *= check.markers[m].factor * check.markers[m].factor;
  return out;
}

}  // namespace fit::camera
