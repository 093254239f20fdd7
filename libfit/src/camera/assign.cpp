#include "fit/camera/assign.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"

namespace fit::camera {

std::vector<std::size_t> least_assignment(const Eigen::MatrixXd& cost) {  // (V9)
  hydro::require(cost.rows() <= cost.cols() && cost.allFinite(),
                 "an assignment needs finite costs and no more rows than columns, got {} x {}", cost.rows(),
                 cost.cols());
  const auto n = static_cast<std::size_t>(cost.rows()), m = static_cast<std::size_t>(cost.cols());
  constexpr double infinity = std::numeric_limits<double>::infinity();
  // Row and column 0 are none. `owner` of a column is the row that has it.
  std::vector<double> of_row(n + 1), of_column(m + 1);
  std::vector<std::size_t> owner(m + 1), before(m + 1);
  for (std::size_t row = 1; row <= n; ++row) {
    owner[0] = row;
    std::size_t column = 0;
    std::vector<double> least(m + 1, infinity);
    std::vector<bool> used(m + 1);
    while (owner[column] != 0) {
      used[column] = true;
      std::size_t next = 0;
      double delta = infinity;
      for (std::size_t j = 1; j <= m; ++j) {
        if (used[j]) continue;
        const std::size_t i = owner[column];
        const double reduced =
            cost(static_cast<Eigen::Index>(i - 1), static_cast<Eigen::Index>(j - 1)) - of_row[i] - of_column[j];
        if (reduced < least[j]) least[j] = reduced, before[j] = column;
        if (least[j] < delta) delta = least[j], next = j;
      }
      for (std::size_t j = 0; j <= m; ++j)
        if (used[j])
          of_row[owner[j]] += delta, of_column[j] -= delta;
        else
          least[j] -= delta;
      column = next;
    }
    for (; column != 0; column = before[column]) owner[column] = owner[before[column]];
  }
  std::vector<std::size_t> out(n);
  for (std::size_t j = 1; j <= m; ++j)
    if (owner[j] != 0) out[owner[j] - 1] = j - 1;
  return out;
}

namespace {

/// A marker on its way: place and velocity, with their covariance. (V8)
struct Prediction {
  Eigen::Vector4d state;
  Eigen::Matrix4d covariance;

  void advance(double h, double acceleration) {
    Eigen::Matrix4d F = Eigen::Matrix4d::Identity();
    F(0, 2) = F(1, 3) = h;
    Eigen::Matrix4d Q = Eigen::Matrix4d::Zero();
    const double a = acceleration * acceleration;
    for (int c = 0; c < 2; ++c) {
      Q(c, c) = a * std::pow(h, 4) / 4;
      Q(c, c + 2) = Q(c + 2, c) = a * std::pow(h, 3) / 2;
      Q(c + 2, c + 2) = a * h * h;
    }
    state = F * state;
    covariance = F * covariance * F.transpose() + Q;
  }
  /// From now on its velocity may be the opposite one, which no acceleration of the others tells.
  void may_turn_back() {
    const Eigen::Vector2d velocity = state.tail<2>();
    covariance.bottomRightCorner<2, 2>() += 4 * velocity * velocity.transpose();
  }
  Eigen::Vector2d place() const { return state.head<2>(); }
  /// Of a sighting: its squared distance over the variance of both, and how much wider that is than its own. (V9)
  struct Missed {
    double distance, spread;
  };
  Missed missed(const Sighting& s) const {
    const Eigen::Matrix2d both = covariance.topLeftCorner<2, 2>() + s.covariance;
    const Eigen::Vector2d d = s.at - place();
    return {d.dot(both.inverse() * d), std::log(both.determinant() / s.covariance.determinant())};
  }
  void take(const Sighting& s) {
    const Eigen::Matrix<double, 4, 2> gain =
        covariance.leftCols<2>() * (covariance.topLeftCorner<2, 2>() + s.covariance).inverse();
    state += gain * (s.at - place());
    covariance -= gain * covariance.topRows<2>();
    covariance = (0.5 * (covariance + covariance.transpose())).eval();
  }
};

struct LengthBetween {
  std::size_t from, to;
  double length, deviation;
};

class Assignment {
 public:
  Assignment(const std::vector<Frame>& frames, const AssignOptions& options) : frames_(frames), options_(options) {
    check();
    first_ = first_places();
    gate_ = hydro::signal::chi_square_quantile(options.gate, 2);
    for (const KnownLength& l : options.lengths) {
      camera::check(l);
      lengths_.push_back({number(l.from), number(l.to), l.length, l.deviation});
    }
  }

  Assigned whole() {
    const double step = (frames_.back().time - frames_.front().time) / static_cast<double>(frames_.size() - 1);
    const double most = 2 * least_distance() / 4 / (step * step);
    const Assigned rough = pass(most);
    check_motion(rough.track);
    return pass(3 * least_acceleration(rough, most), Names::certain);
  }

 private:
  /// Names that change to and fro make accelerations which no marker has: fewer are allowed for as long as every place
  /// is given to a marker still.
  double least_acceleration(const Assigned& rough, double allowed) const {
    double out = acceleration_of(rough.track);
    for (int times = 0; times < 3; ++times) {
      const Assigned finer = pass(allowed /= 4);
      if (finer.sightings < rough.sightings) break;
      out = std::min(out, acceleration_of(finer.track));
    }
    return out;
  }

  std::size_t count() const { return options_.names.size(); }
  std::size_t number(const std::string& name) const {
    const auto at = std::find(options_.names.begin(), options_.names.end(), name);
    hydro::require(at != options_.names.end(),
                   "there is no marker \"{}\" whose distance could be known; markers are {}", name,
                   fmt::join(options_.names, ", "));
    return static_cast<std::size_t>(at - options_.names.begin());
  }

  void check() const {
    hydro::require(count() > 0, "a track needs a marker at least");
    hydro::require(options_.first.empty() || options_.first.size() == count(), "{} first places for {} markers",
                   options_.first.size(), count());
    hydro::require(frames_.size() >= 2, "a track needs two frames at least, the film has {}", frames_.size());
    for (std::size_t i = 1; i < frames_.size(); ++i)
      if (!(frames_[i].time > frames_[i - 1].time))
        throw hydro::InputError(fmt::format("the time of frame {} is {:.6g} s, after {:.6g} s of the one before", i + 1,
                                            frames_[i].time, frames_[i - 1].time),
                                {}, "the film's times go back: give its frame rate, --frame-rate, if frames are even");
    const std::size_t found = frames_[0].found.size();
    if (found < count())
      throw hydro::InputError(
          fmt::format("the first frame has {} marker{} that can be told from its surroundings, {} are named", found,
                      found == 1 ? "" : "s", count()),
          {}, "begin where all are seen, name fewer, or let other radii and contrasts pass (--radius, --contrast)");
    if (found > count() && options_.first.empty())
      throw hydro::InputError(fmt::format("the first frame has {} bright places, {} markers are named", found, count()),
                              {},
                              "say where the markers are in the first frame (--first), or narrow the radii (--radius)");
  }

  /// Which place of the first frame is whose.
  std::vector<std::size_t> first_places() const {
    const auto& found = frames_[0].found;
    std::vector<std::size_t> out;
    if (options_.first.empty()) {
      out.resize(found.size());
      std::iota(out.begin(), out.end(), 0);
      const int along = options_.order == AssignOptions::Order::left_to_right ? 0 : 1;
      std::sort(out.begin(), out.end(),
                [&](std::size_t a, std::size_t b) { return found[a].at[along] < found[b].at[along]; });
      return out;
    }
    for (std::size_t k = 0; k < count(); ++k) {
      const Eigen::Vector2d& at = options_.first[k];
      const auto distance = [&](const Sighting& s) { return (s.at - at).norm(); };
      const auto nearer = [&](const Sighting& a, const Sighting& b) { return distance(a) < distance(b); };
      const auto nearest = std::min_element(found.begin(), found.end(), nearer);
      const auto index = static_cast<std::size_t>(nearest - found.begin());
      check_nearest(k, *nearest, distance);
      hydro::require(std::find(out.begin(), out.end(), index) == out.end(),
                     "two markers, \"{}\" one of them, are nearest to one place of the first frame, ({:.5g}, {:.5g})",
                     options_.names[k], nearest->at.x(), nearest->at.y());
      out.push_back(index);
    }
    return out;
  }

  /// A first place that is not twice as far from all other bright places as from the nearest means none of them.
  template <class Distance>
  void check_nearest(std::size_t k, const Sighting& nearest, Distance distance) const {
    for (const Sighting& other : frames_[0].found)
      if (&other != &nearest && distance(other) < 2 * distance(nearest))
        throw hydro::InputError(
            fmt::format("the first place of \"{}\", ({:.5g}, {:.5g}), is {:.3g} px from the bright place at ({:.5g}, "
                        "{:.5g}) and {:.3g} px from another at ({:.5g}, {:.5g})",
                        options_.names[k], options_.first[k].x(), options_.first[k].y(), distance(nearest),
                        nearest.at.x(), nearest.at.y(), distance(other), other.at.x(), other.at.y()),
            {}, "read the marker's pixel from the first frame: froude track --picture shows it");
  }

  double least_distance() const {
    double out = std::numeric_limits<double>::infinity();
    for (const std::size_t a : first_)
      for (const std::size_t b : first_)
        if (a != b) out = std::min(out, (frames_[0].found[a].at - frames_[0].found[b].at).norm());
    return std::isfinite(out) ? out : 100;  // px: one marker has no neighbours to be taken for
  }

  std::vector<Prediction> begin(double acceleration) const {
    std::vector<Prediction> out;
    const double h = frames_[1].time - frames_[0].time;
    for (const std::size_t index : first_) {
      const Sighting& s = frames_[0].found[index];
      Prediction p{.state = Eigen::Vector4d::Zero(), .covariance = Eigen::Matrix4d::Zero()};
      p.state.head<2>() = s.at;
      p.covariance.topLeftCorner<2, 2>() = s.covariance;
      // A film may begin in full swing: its speed is not known better than by the least distance in a frame.
      const double speed = std::max(acceleration * h, least_distance() / 4 / h);
      p.covariance(2, 2) = p.covariance(3, 3) = speed * speed;
      out.push_back(p);
    }
    return out;
  }

  /// What is given to each marker, found.size() where nothing is.
  std::vector<std::size_t> given(const std::vector<Prediction>& all, const std::vector<Sighting>& found) const {
    const auto n = static_cast<Eigen::Index>(count()), m = std::ssize(found);
    Eigen::MatrixXd cost = Eigen::MatrixXd::Constant(n, m + n, std::numeric_limits<double>::infinity());
    double widest = 0;
    for (Eigen::Index k = 0; k < n; ++k)
      for (Eigen::Index j = 0; j < m; ++j) {
        const auto [distance, spread] = all[static_cast<std::size_t>(k)].missed(found[static_cast<std::size_t>(j)]);
        if (distance >= gate_) continue;
        cost(k, j) = distance + spread;
        widest = std::max(widest, spread);
      }
    // The last n columns are gaps, each dearer than any sighting that a gate lets pass.
    cost.rightCols(n).setConstant(gate_ + widest);
    const double never = 1e6 * (gate_ + widest);
    cost = cost.cwiseMin(never);
    for (Eigen::Index round = 0;; ++round) {
      std::vector<std::size_t> out = least_assignment(cost);
      for (auto& j : out) j = std::min(j, found.size());
      const auto worst = broken(all, out, found, cost);
      if (worst.first == count() || round > n * m) return out;
      cost(static_cast<Eigen::Index>(worst.first), static_cast<Eigen::Index>(worst.second)) = never;
    }
  }

  /// Where a marker is: what it was given, or where it is expected.
  static Sighting place_of(const Prediction& expected, std::size_t given, const std::vector<Sighting>& found) {
    return given < found.size() ? found[given] : Sighting{expected.place(), expected.covariance.topLeftCorner<2, 2>()};
  }

  /// (V10) Of the pairs that break a known length, the marker whose sighting is less likely, and what it was given.
  std::pair<std::size_t, std::size_t> broken(const std::vector<Prediction>& all, const std::vector<std::size_t>& given,
                                             const std::vector<Sighting>& found, const Eigen::MatrixXd& cost) const {
    std::pair<std::size_t, std::size_t> out{count(), 0};
    double worst = 0;
    for (const LengthBetween& l : lengths_) {
      const std::size_t seen = (given[l.from] < found.size()) + (given[l.to] < found.size());
      if (seen == 0) continue;
      const Sighting a = place_of(all[l.from], given[l.from], found), b = place_of(all[l.to], given[l.to], found);
      const Eigen::Vector2d d = b.at - a.at;
      const double now = d.norm();
      const double own = now > 0 ? d.dot((a.covariance + b.covariance) * d) / (now * now) : 0;
      // Whips are stronger than what predictions allow for.
      const double deviations = seen == 2 ? 5 : 8;
      if (std::abs(now - l.length) < deviations * std::sqrt(own + l.deviation * l.deviation)) continue;
      for (const std::size_t k : {l.from, l.to}) {
        if (given[k] == found.size()) continue;
        if (const double c = cost(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(given[k])); c >= worst)
          worst = c, out = {k, given[k]};
      }
    }
    return out;
  }

  /// (V35) What exchanged names of two markers would miss beyond what the names given do.
  struct Exchange {
    double missed;  ///< squared, of both as they are named
    double beyond;  ///< ∞ where the exchange breaks a gate or a known length
  };
  Exchange exchange_of(const std::vector<Prediction>& all, std::vector<std::size_t> now,
                       const std::vector<Sighting>& found, std::size_t k, std::size_t l) const {
    const auto missed = [&](std::size_t marker, std::size_t place) {
      return all[marker].missed(found[place]).distance;
    };
    const double k_there = missed(k, now[l]), l_there = missed(l, now[k]), here = missed(k, now[k]) + missed(l, now[l]);
    const Exchange none{here, std::numeric_limits<double>::infinity()};
    if (k_there >= gate_ || l_there >= gate_) return none;
    std::swap(now[k], now[l]);
    const auto zero = Eigen::MatrixXd::Zero(std::ssize(all), std::ssize(found));
    return broken(all, now, found, zero).first == count() ? Exchange{here, k_there + l_there - here} : none;
  }

  /// Whether two markers were both given nothing, though there are two places that nobody has: where a motion that no
  /// prediction knew may have brought either of them.
  bool were_thrown(const std::vector<std::size_t>& now, std::size_t places, std::size_t k, std::size_t l) const {
    const auto given = static_cast<std::size_t>(
        std::count_if(now.begin(), now.end(), [&](std::size_t place) { return place < places; }));
    return now[k] == places && now[l] == places && places >= given + 2;
  }

  /// Takes from these markers what they were given. `open`: pairs that are not told apart yet, as numbered k · n + l.
  void leave_out_alike(std::vector<Prediction>& all, const Frame& frame, std::vector<std::size_t>& now,
                       std::vector<bool>& open, std::vector<Exchangeable>& told) const {
    constexpr double thousand = 13.8, million = 27.6;  // 2 ln 1000, 2 ln 10⁶: to be told apart again
    // Predictions allow for three times the accelerations that were found: of these, one smooth pair in a thousand is
    // missed by more.
    constexpr double surprise = 18.5 / 9;
    const std::vector<std::size_t> before = now;
    const std::size_t none = frame.found.size();
    for (std::size_t k = 0; k < count(); ++k)
      for (std::size_t l = k + 1; l < count(); ++l) {
        const std::size_t pair = k * count() + l;
        const bool was_open = open[pair];
        if (were_thrown(before, none, k, l)) open[pair] = true;
        if (before[k] != none && before[l] != none) {
          const Exchange other = exchange_of(all, before, frame.found, k, l);
          open[pair] = open[pair] ? other.beyond < million : other.beyond < thousand && other.missed > surprise;
        }
        if (open[pair] && !was_open)
          for (const std::size_t m : {k, l}) all[m].may_turn_back();
        if (!open[pair]) continue;  // of a pair that is open one alone may be either
        now[k] = now[l] = none;
        const auto same = [&](const Exchangeable& e) { return e.first == k && e.second == l; };
        const auto at = std::find_if(told.begin(), told.end(), same);
        if (at == told.end())
          told.push_back({k, l, frame.time, 1});
        else
          ++at->frames;
      }
  }

  /// Whether a pass leaves out what may as well have another name: the first one asks how things move alone.
  enum class Names { likely, certain };

  Assigned pass(double acceleration, Names names = Names::likely) const {
    Assigned out{.track = {},
                 .sightings = 0,
                 .left_over = 0,
                 .missing = std::vector<std::size_t>(count(), 0),
                 .acceleration = acceleration};
    for (const std::string& name : options_.names) out.track.markers.push_back({name, {}});
    std::vector<Prediction> all = begin(acceleration);
    std::vector<bool> open(count() * count());
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      const auto& found = frames_[i].found;
      if (i > 0)
        for (Prediction& p : all) p.advance(frames_[i].time - frames_[i - 1].time, acceleration);
      std::vector<std::size_t> now = i == 0 ? first_ : given(all, found);
      if (i > 0 && names == Names::certain) leave_out_alike(all, frames_[i], now, open, out.alike);
      out.track.time.push_back(frames_[i].time);
      std::size_t taken = 0;
      for (std::size_t k = 0; k < count(); ++k) {
        auto& seen = out.track.markers[k].seen.emplace_back();
        if (now[k] == found.size()) {
          ++out.missing[k];
          continue;
        }
        seen = found[now[k]];
        if (i > 0) all[k].take(*seen);
        ++taken;
      }
      out.sightings += taken;
      out.left_over += found.size() - taken;
    }
    return out;
  }

  /// Of the marker that moves most: rms of second differences of frames that follow each other, with what errors of the
  /// places make of them taken off.
  double acceleration_of(const Track& track) const {
    double out = 0;
    for (const Marker& m : track.markers) {
      double sum = 0, errors = 0, n = 0;
      for (std::size_t i = 1; i + 1 < track.frames(); ++i) {
        if (!m.seen[i - 1] || !m.seen[i] || !m.seen[i + 1]) continue;
        const double before = track.time[i] - track.time[i - 1], after = track.time[i + 1] - track.time[i];
        const Eigen::Vector2d a =
            2 * ((m.seen[i + 1]->at - m.seen[i]->at) / after - (m.seen[i]->at - m.seen[i - 1]->at) / before) /
            (before + after);
        sum += a.squaredNorm();
        errors += 6 * m.seen[i]->covariance.trace() / std::pow((before + after) / 2, 4);
        ++n;
      }
      // Where errors are all there is, predictions still allow for them once.
      if (n > 0) out = std::max(out, std::sqrt(std::max(sum - errors, errors) / n));
    }
    hydro::require(out > 0, "no marker is seen in three frames one after the other, so its motion cannot be foretold");
    return out;
  }

  void check_motion(const Track& track) const {
    double farthest = 0;
    for (const Marker& m : track.markers) {
      if (!m.seen[0]) continue;
      for (const auto& s : m.seen)
        if (s) {
          const double error = std::sqrt((s->covariance + m.seen[0]->covariance).trace());
          farthest = std::max(farthest, (s->at - m.seen[0]->at).norm() / error);
        }
    }
    if (farthest > 8) return;  // no chance of white noise in any film
    throw hydro::InputError(
        fmt::format("nothing moves in this film: no marker leaves its first place by more than {:.2g} of its errors",
                    farthest),
        {}, "take the part of the film in which the model moves, --from and --to");
  }

  const std::vector<Frame>& frames_;
  const AssignOptions& options_;
  std::vector<std::size_t> first_;
  double gate_ = 0;
  std::vector<LengthBetween> lengths_;
};

}  // namespace

Assigned assign(const std::vector<Frame>& frames, const AssignOptions& options) {
  return Assignment(frames, options).whole();
}

}  // namespace fit::camera
