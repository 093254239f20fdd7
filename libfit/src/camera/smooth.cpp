#include "fit/camera/smooth.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"

namespace fit::camera {
namespace {

constexpr Eigen::Index place_y = 3;

/// (V5) 1/(1 + (f/f_c)⁶) is 0.99 at the bandwidth.
double cutoff_of(double bandwidth_hz) { return bandwidth_hz * std::pow(0.99 / 0.01, 1.0 / 6); }

struct LengthOf {
  Eigen::Index from, to;  // numbers of the places along x
  double length, deviation;
};

/// The filter and smoother over one trajectory about which lengths are straight.
class Smoother {
 public:
  Smoother(const Track& track, const SmoothOptions& options) : track_(track) {
    hydro::require(options.bandwidth_hz > 0, "the bandwidth of a smoother must be positive, got {} Hz",
                   options.bandwidth_hz);
    hydro::require(track.frames() >= 3, "a track to be smoothed needs three frames, got {}", track.frames());
    check_rate(options.bandwidth_hz);
    omega_ = 2 * std::numbers::pi * cutoff_of(options.bandwidth_hz);
    for (const Marker& m : track.markers) add(m);
    for (const KnownLength& l : options.lengths) add(l);
  }

  SmoothTrack smoothed() {
    SmoothTrack out{.time = track_.time,
                    .markers = {},
                    .state = {},
                    .covariance = {},
                    .cutoff_hz = omega_ / (2 * std::numbers::pi),
                    .rounds = 0};
    for (const Marker& m : track_.markers) out.markers.push_back(m.name);
    pass({}, out);
    constexpr int most = 20;
    constexpr double settled = 0.01;  // of a standard deviation
    for (bool moves = !lengths_.empty(); moves; ++out.rounds) {
      if (out.rounds == most)
        throw hydro::NumericsError(
            "known lengths and sightings contradict each other: the smoother finds no trajectory");
      const std::vector<Eigen::VectorXd> about = out.state;
      pass(about, out);
      moves = false;
      for (std::size_t i = 0; i < about.size(); ++i)
        moves = moves || ((out.state[i] - about[i]).array().abs() >
                          settled * out.covariance[i].diagonal().array().cwiseMax(0).sqrt())
                             .any();
    }
    return out;
  }

 private:
  Eigen::Index size() const { return numbers_of_marker * std::ssize(track_.markers); }

  /// (V5) Places tell no motion that is faster than half of the rate at which they were seen.
  void check_rate(double bandwidth_hz) const {
    const double rate = static_cast<double>(track_.frames() - 1) / (track_.time.back() - track_.time.front());
    if (2 * bandwidth_hz > rate)
      throw hydro::InputError(
          fmt::format("{:.4g} frames a second tell no motion up to {:g} Hz", rate, bandwidth_hz), {},
          fmt::format("take a bandwidth below half of that, and of what the motion needs: \"{:.2g} Hz\"", rate / 6));
  }

  void add(const Marker& m) {
    double variance = 0;
    int seen = 0;
    Eigen::Vector2d low, high;
    for (const auto& s : m.seen) {
      if (!s) continue;
      hydro::require(s->has_covariance(), "marker \"{}\" has sightings without covariance", m.name);
      variance += s->covariance.trace() / 2;
      if (seen++ == 0) low = high = s->at;
      low = low.cwiseMin(s->at);
      high = high.cwiseMax(s->at);
    }
    hydro::require(seen > 0, "marker \"{}\" is in no frame", m.name);
    const double step = (track_.time.back() - track_.time.front()) / static_cast<double>(track_.frames() - 1);
    jerk_.push_back(variance / seen * step * std::pow(omega_, 6));  // (V5)
    middle_.push_back((low + high) / 2);
    range_.push_back(std::max((high - low).norm(), 10 * std::sqrt(variance / seen)));
  }

  void add(const KnownLength& l) {
    check(l);
    const auto number = [&](const std::string& name) {
      return numbers_of_marker * (&track_.marker(name) - track_.markers.data());
    };
    lengths_.push_back({number(l.from), number(l.to), l.length, l.deviation});
    check_seen(l);
  }

  /// A known length that the sightings contradict is another, or the scale is.
  void check_seen(const KnownLength& l) const {
    const Marker &from = track_.marker(l.from), &to = track_.marker(l.to);
    double sum = 0, variance = 0, frames = 0;
    for (std::size_t i = 0; i < track_.frames(); ++i) {
      if (!from.seen[i] || !to.seen[i]) continue;
      sum += (to.seen[i]->at - from.seen[i]->at).norm();
      variance += (from.seen[i]->covariance + to.seen[i]->covariance).trace() / 2;
      ++frames;
    }
    if (frames == 0) return;
    constexpr double chance = 5;  // deviations of what is stated and of one sighting: noise makes no mean of them
    const double seen = sum / frames, error = std::sqrt(l.deviation * l.deviation + variance / frames);
    if (std::abs(seen - l.length) < chance * error) return;
    throw hydro::InputError(
        fmt::format("\"{}\" and \"{}\" are {:.4g} apart in the track, and {:.4g} with a deviation of {:.2g} is said to "
                    "be known",
                    l.from, l.to, seen, l.length, l.deviation),
        {}, "is it this length, or is the scale wrong? A length that is known less well has a larger deviation");
  }

  /// A start that says nothing: ten times the range of the motion, at the cutoff.
  void begin(Eigen::VectorXd& x, Eigen::MatrixXd& p) const {
    x.setZero(size());
    p.setZero(size(), size());
    for (Eigen::Index m = 0; m < std::ssize(track_.markers); ++m)
      for (Eigen::Index c = 0; c < 2; ++c)
        for (Eigen::Index d = 0; d < 3; ++d) {
          const Eigen::Index at = numbers_of_marker * m + place_y * c + d;
          const auto k = static_cast<std::size_t>(m);
          if (d == 0) x[at] = middle_[k][c];
          p(at, at) = std::pow(10 * range_[k] * std::pow(omega_, static_cast<double>(d)), 2);
        }
  }

  Eigen::MatrixXd transition(double h) const {
    Eigen::Matrix3d one;
    one << 1, h, h * h / 2, 0, 1, h, 0, 0, 1;
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(size(), size());
    for (Eigen::Index at = 0; at < size(); at += 3) out.block<3, 3>(at, at) = one;
    return out;
  }

  Eigen::MatrixXd jerk_noise(double h) const {
    Eigen::Matrix3d one;
    one << std::pow(h, 5) / 20, std::pow(h, 4) / 8, std::pow(h, 3) / 6, std::pow(h, 4) / 8, std::pow(h, 3) / 3,
        h * h / 2, std::pow(h, 3) / 6, h * h / 2, h;
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(size(), size());
    for (Eigen::Index at = 0; at < size(); at += 3)
      out.block<3, 3>(at, at) = jerk_[static_cast<std::size_t>(at / numbers_of_marker)] * one;
    return out;
  }

  /// Takes one observation z = H x + noise of covariance R into the state, in Joseph's form.
  void take(const Eigen::MatrixXd& H, const Eigen::VectorXd& missed, const Eigen::MatrixXd& R, Eigen::VectorXd& x,
            Eigen::MatrixXd& p) const {
    const Eigen::MatrixXd ph = p * H.transpose();
    const hydro::dense::Cholesky s(H * ph + R);
    if (!s) throw hydro::NumericsError("the covariance of a sighting against its prediction is singular");
    const Eigen::MatrixXd gain = s.solve(ph.transpose()).transpose();
    x += gain * missed;
    const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(size(), size()) - gain * H;
    p = hydro::dense::symmetric_part(rest * p * rest.transpose() + gain * R * gain.transpose());
  }

  void take_sightings(std::size_t frame, Eigen::VectorXd& x, Eigen::MatrixXd& p) const {
    for (std::size_t m = 0; m < track_.markers.size(); ++m) {
      const auto& s = track_.markers[m].seen[frame];
      if (!s) continue;
      const Eigen::Index at = numbers_of_marker * static_cast<Eigen::Index>(m);
      Eigen::MatrixXd H = Eigen::MatrixXd::Zero(2, size());
      H(0, at) = H(1, at + place_y) = 1;
      take(H, s->at - H * x, s->covariance, x, p);
    }
  }

  /// (V6) Each length, straight about the last trajectory.
  void take_lengths(const Eigen::VectorXd& about, Eigen::VectorXd& x, Eigen::MatrixXd& p) const {
    for (const LengthOf& l : lengths_) {
      const Eigen::Vector2d between(about[l.to] - about[l.from], about[l.to + place_y] - about[l.from + place_y]);
      const double now = between.norm();
      if (!(now > 0)) continue;  // no direction: the sightings alone tell
      Eigen::MatrixXd H = Eigen::MatrixXd::Zero(1, size());
      for (Eigen::Index c = 0; c < 2; ++c) {
        H(0, l.to + place_y * c) = between[c] / now;
        H(0, l.from + place_y * c) = -between[c] / now;
      }
      const double missed = l.length - now - (H * (x - about))[0];
      take(H, Eigen::VectorXd::Constant(1, missed), Eigen::MatrixXd::Constant(1, 1, l.deviation * l.deviation), x, p);
    }
  }

  void pass(const std::vector<Eigen::VectorXd>& about, SmoothTrack& out) const {
    const std::size_t n = track_.frames();
    out.state.resize(n);
    out.covariance.resize(n);
    std::vector<Eigen::VectorXd> foretold(n);
    std::vector<Eigen::MatrixXd> foretold_p(n);
    Eigen::VectorXd x;
    Eigen::MatrixXd p;
    begin(x, p);
    for (std::size_t i = 0; i < n; ++i) {
      if (i > 0) {
        const Eigen::MatrixXd F = transition(track_.time[i] - track_.time[i - 1]);
        x = F * x;
        p = hydro::dense::symmetric_part(F * p * F.transpose() + jerk_noise(track_.time[i] - track_.time[i - 1]));
      }
      foretold[i] = x;
      foretold_p[i] = p;
      take_sightings(i, x, p);
      if (!about.empty()) take_lengths(about[i], x, p);
      out.state[i] = x;
      out.covariance[i] = p;
    }
    for (std::size_t i = n - 1; i-- > 0;) {
      const Eigen::MatrixXd F = transition(track_.time[i + 1] - track_.time[i]);
      const hydro::dense::Cholesky next(foretold_p[i + 1]);
      if (!next) throw hydro::NumericsError("the covariance of a predicted place is singular");
      const Eigen::MatrixXd back = next.solve(F * out.covariance[i]).transpose();
      out.state[i] += back * (out.state[i + 1] - foretold[i + 1]);
      out.covariance[i] = hydro::dense::symmetric_part(
          out.covariance[i] + back * (out.covariance[i + 1] - foretold_p[i + 1]) * back.transpose());
    }
  }

  const Track& track_;
  double omega_;  // rad/s, of the cutoff
  std::vector<double> jerk_, range_;
  std::vector<Eigen::Vector2d> middle_;
  std::vector<LengthOf> lengths_;
};

Eigen::Vector2d pair_at(const Eigen::VectorXd& x, Eigen::Index at) { return {x[at], x[at + place_y]}; }

}  // namespace

void check(const KnownLength& l) {
  hydro::require(l.length > 0 && l.deviation > 0, "a known length and its deviation must be positive, got {} and {}",
                 l.length, l.deviation);
  if (l.deviation >= l.length)
    throw hydro::InputError(fmt::format("the deviation of a known length, {}, is no smaller than the length itself, {}",
                                        l.deviation, l.length),
                            {}, "write first the length, then how far off it may be, each with its unit");
}

MarkerMotion SmoothTrack::marker(std::size_t marker, std::size_t frame) const {
  const Eigen::Index at = numbers_of_marker * static_cast<Eigen::Index>(marker);
  const Eigen::VectorXd sd = covariance[frame].diagonal().cwiseMax(0).cwiseSqrt();
  return {pair_at(state[frame], at), pair_at(state[frame], at + 1), pair_at(state[frame], at + 2),
          pair_at(sd, at),           pair_at(sd, at + 1),           pair_at(sd, at + 2)};
}

AngleMotion SmoothTrack::angle(std::size_t from, std::size_t to, std::size_t frame) const {  // (V7)
  const Eigen::VectorXd& x = state[frame];
  const Eigen::Index a = numbers_of_marker * static_cast<Eigen::Index>(from),
                     b = numbers_of_marker * static_cast<Eigen::Index>(to);
  const Eigen::Vector2d d = pair_at(x, b) - pair_at(x, a), v = pair_at(x, b + 1) - pair_at(x, a + 1),
                        w = pair_at(x, b + 2) - pair_at(x, a + 2);
  const double s = d.squaredNorm();
  hydro::require(s > 0, "markers \"{}\" and \"{}\" are at one place at {:.6g} s: the line between them has no angle",
                 markers[from], markers[to], time[frame]);
  const auto cross = [](const Eigen::Vector2d& p, const Eigen::Vector2d& q) { return p.x() * q.y() - p.y() * q.x(); };
  AngleMotion out{};
  out.angle = std::atan2(d.y(), d.x());
  out.rate = cross(d, v) / s;
  out.acceleration = (cross(d, w) - 2 * d.dot(v) * out.rate) / s;
  // Slopes along d, v and w, each with its sign at either marker.
  const Eigen::Vector2d normal(-d.y() / s, d.x() / s), turned_v(v.y() / s, -v.x() / s), turned_w(w.y() / s, -w.x() / s);
  const Eigen::Vector2d rate_d = turned_v - 2 * out.rate / s * d;
  const Eigen::Vector2d acceleration_d =
      turned_w - 2 / s * (out.rate * v + d.dot(v) * rate_d) - 2 * out.acceleration / s * d;
  const Eigen::Vector2d acceleration_v = -2 / s * (out.rate * d + d.dot(v) * normal);
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(3, x.size());
  for (const auto& [at, sign] : {std::pair{b, 1.0}, std::pair{a, -1.0}})
    for (Eigen::Index c = 0; c < 2; ++c) {
      const Eigen::Index k = at + place_y * c;
      slope(0, k) = sign * normal[c];
      slope(1, k) = sign * rate_d[c];
      slope(1, k + 1) = sign * normal[c];
      slope(2, k) = sign * acceleration_d[c];
      slope(2, k + 1) = sign * acceleration_v[c];
      slope(2, k + 2) = sign * normal[c];
    }
  const Eigen::Vector3d sd = (slope * covariance[frame] * slope.transpose()).diagonal().cwiseMax(0).cwiseSqrt();
  out.angle_sd = sd[0], out.rate_sd = sd[1], out.acceleration_sd = sd[2];
  return out;
}

SmoothTrack smooth(const Track& track, const SmoothOptions& options) { return Smoother(track, options).smoothed(); }

}  // namespace fit::camera
