#include "fit/camera/channels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"

namespace fit::camera {
namespace {

constexpr double turn = 2 * std::numbers::pi;

/// The value of a channel in one frame and its slopes along the places of its markers.
struct Reading {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::pair<std::size_t, Eigen::Vector2d>> slopes = {};
};

class ChannelReader {
 public:
  ChannelReader(const Track& track, const Channel& channel)
      : track_(track), channel_(channel), from_(number(channel.marker)), to_(is_angle() ? number(channel.to) : from_) {
    hydro::require(!is_angle() || from_ != to_, "a line from marker \"{}\" to itself has no angle", channel.marker);
  }

  Reading at(std::size_t frame) const {
    const auto &a = track_.markers[from_].seen[frame], &b = track_.markers[to_].seen[frame];
    if (!a || !b) return {};
    switch (channel_.kind) {
      case Channel::Kind::along:
        return {a->at.x(), {{from_, Eigen::Vector2d::UnitX()}}};
      case Channel::Kind::up:
        return {a->at.y(), {{from_, Eigen::Vector2d::UnitY()}}};
      case Channel::Kind::angle:
        break;
    }
    const Eigen::Vector2d d = b->at - a->at;
    hydro::require(d.squaredNorm() > 0, "markers \"{}\" and \"{}\" are at one place at {:.6g} s", channel_.marker,
                   channel_.to, track_.time[frame]);
    const double sign = channel_.downwards ? -1 : 1;
    const Eigen::Vector2d slope = sign * Eigen::Vector2d(-d.y(), d.x()) / d.squaredNorm();  // (V11)
    return {std::remainder(sign * std::atan2(d.y(), d.x()) - channel_.zero, turn), {{from_, -slope}, {to_, slope}}};
  }
  bool is_angle() const { return channel_.kind == Channel::Kind::angle; }
  std::string name() const {
    return is_angle() ? fmt::format("the line from \"{}\" to \"{}\"", channel_.marker, channel_.to)
                      : fmt::format("marker \"{}\"", channel_.marker);
  }

 private:
  std::size_t number(const std::string& name) const {
    return static_cast<std::size_t>(&track_.marker(name) - track_.markers.data());
  }
  const Track& track_;
  const Channel& channel_;
  std::size_t from_, to_;
};

/// Takes whole turns off, so that an angle is where the two frames before let it be expected. The largest difference
/// from there is given back.
double make_continuous(const std::vector<double>& time, const std::string& name, Eigen::Ref<Eigen::VectorXd> angle) {
  double last = 0, rate = 0, at = 0, largest = 0;
  int seen = 0;
  for (Eigen::Index i = 0; i < angle.size(); ++i) {
    if (std::isnan(angle[i])) continue;
    const double now = time[static_cast<std::size_t>(i)];
    if (seen > 0) {
      const double expected = last + rate * (now - at), off = std::remainder(angle[i] - expected, turn);
      if (seen > 1 && std::abs(off) > 0.9 * std::numbers::pi)
        throw hydro::InputError(
            fmt::format(
                "{} is {:.3g} deg from where it was expected at {:.6g} s: which way round it turned is not known", name,
                off * 180 / std::numbers::pi, now),
            {}, "film with more frames a second, or cut the record there");
      if (seen > 1) largest = std::max(largest, std::abs(off));
      angle[i] = expected + off;
      rate = (angle[i] - last) / (now - at);
    }
    last = angle[i];
    at = now;
    ++seen;
  }
  return largest;
}

/// Covariance of what is read in one frame, of the channels that are.
Eigen::MatrixXd covariance_of(const Track& track, std::size_t frame, const std::vector<Reading>& readings,
                              const std::vector<Eigen::Index>& read) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(std::ssize(read), std::ssize(read));
  for (Eigen::Index i = 0; i < out.rows(); ++i)
    for (Eigen::Index j = 0; j < out.cols(); ++j)
      for (const auto& [a, slope_a] : readings[static_cast<std::size_t>(read[static_cast<std::size_t>(i)])].slopes)
        for (const auto& [b, slope_b] : readings[static_cast<std::size_t>(read[static_cast<std::size_t>(j)])].slopes)
          if (a == b) out(i, j) += slope_a.dot(track.markers[a].seen[frame]->covariance * slope_b);
  return out;
}

}  // namespace

Channels channels_of(const Track& track, const std::vector<Channel>& channels) {
  hydro::require(track.in_metres, "a fit needs a track in metres, this one is in pixels");
  std::vector<ChannelReader> readers;
  for (const Channel& c : channels) readers.emplace_back(track, c);
  const auto n = static_cast<Eigen::Index>(track.frames()), k = std::ssize(channels);
  Channels out{.values = Eigen::MatrixXd(n, k), .deviations = {}, .whitening = {}, .largest_turn = 0};
  std::vector<std::vector<Eigen::Index>> read(track.frames());
  std::vector<Eigen::MatrixXd> covariance;
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(k), seen = squares;
  for (std::size_t i = 0; i < track.frames(); ++i) {
    std::vector<Reading> readings;
    for (Eigen::Index c = 0; c < k; ++c) {
      readings.push_back(readers[static_cast<std::size_t>(c)].at(i));
      out.values(static_cast<Eigen::Index>(i), c) = readings.back().value;
      if (!readings.back().slopes.empty()) read[i].push_back(c);
    }
    covariance.push_back(covariance_of(track, i, readings, read[i]));
    for (std::size_t j = 0; j < read[i].size(); ++j) {
      squares[read[i][j]] += covariance[i](static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(j));
      seen[read[i][j]] += 1;
    }
  }
  for (Eigen::Index c = 0; c < k; ++c) {
    const ChannelReader& reader = readers[static_cast<std::size_t>(c)];
    hydro::require(seen[c] > 0, "{} is in no frame", reader.name());
    out.deviations.push_back(std::sqrt(squares[c] / seen[c]));
    if (reader.is_angle())
      out.largest_turn = std::max(out.largest_turn, make_continuous(track.time, reader.name(), out.values.col(c)));
  }
  for (std::size_t i = 0; i < track.frames(); ++i) {  // (V12)
    Eigen::MatrixXd& whitening = out.whitening.emplace_back(Eigen::MatrixXd::Zero(k, k));
    if (read[i].empty()) continue;
    const Eigen::Map<const Eigen::VectorXd> all(out.deviations.data(), k);
    const Eigen::VectorXd own = all(read[i]);
    const hydro::dense::Cholesky factors(covariance[i]);
    const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(own.size(), own.size());
    const Eigen::MatrixXd L = factors ? factors.L() : unit;
    if (!factors || (L.diagonal().array() < 1e-6 * own.array()).any())
      throw hydro::InputError("two of the signals tell the same of the markers, so their errors are not independent",
                              {}, "leave one of them out: a line's angle follows from the places of its ends");
    whitening(read[i], read[i]) = hydro::dense::inverse(L) * own.asDiagonal();
  }
  return out;
}

}  // namespace fit::camera
