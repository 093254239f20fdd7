#include "fit/camera/pose.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gauss_newton.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"

namespace fit::camera {
namespace {

using Eigen::Index;
using Eigen::Vector2d;

Vector2d turned_left(const Vector2d& v) { return {-v.y(), v.x()}; }
double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The markers of one body in the numbers of a frame.
class Body {
 public:
  Body(const SmoothTrack& track, const std::vector<MarkerOnBody>& markers) : track_(track), markers_(markers) {
    hydro::require(markers.size() >= 2, "two markers on a body tell its pose, got {}", markers.size());
    for (const MarkerOnBody& m : markers) {
      const auto found = std::find(track.markers.begin(), track.markers.end(), m.marker);
      hydro::require(found != track.markers.end(), "the track has no marker \"{}\"", m.marker);
      first_.push_back(numbers_of_marker * (found - track.markers.begin()));
      mean_ += m.at / static_cast<double>(markers.size());
    }
    double spread = 0;
    for (const MarkerOnBody& m : markers) spread = std::max(spread, (m.at - mean_).norm());
    hydro::require(spread > 0, "all markers sit at one place of the body, which tells no angle");
  }

  /// (V20) Angles grow upwards.
  PlanarMotion at(std::size_t frame) const {
    const hydro::dense::Cholesky errors(covariance(frame));
    if (!errors) throw hydro::NumericsError("the covariance of markers on a body is singular");
    const Eigen::MatrixXd whitening = hydro::dense::inverse(errors.L());
    const Eigen::VectorXd seen = observed(frame);
    Eigen::VectorXd q = first_guess(frame);
    const auto solved = least_squares({[&](Eigen::VectorXd& missed, Eigen::MatrixXd& slope) {
                                         missed = seen;
                                         slope = whitening * model(q, missed);
                                         missed = (whitening * missed).eval();
                                         return true;
                                       },
                                       [&](const Eigen::VectorXd& step) { q += step; }});
    if (!solved)
      throw hydro::NumericsError(fmt::format(
          "at {:.6g} s no pose of the body fits its markers: they are not where it has them", track_.time[frame]));
    PlanarMotion out;
    out.place = q.segment<3>(0), out.velocity = q.segment<3>(3), out.acceleration = q.segment<3>(6);
    out.covariance = solved->covariance;
    out.stray = std::sqrt(solved->squares / static_cast<double>(seen.size() - 9));
    return out;
  }

 private:
  Index size() const { return numbers_of_marker * std::ssize(markers_); }

  Eigen::VectorXd observed(std::size_t frame) const {
    Eigen::VectorXd out(size());
    for (std::size_t m = 0; m < first_.size(); ++m)
      out.segment<6>(6 * static_cast<Index>(m)) = track_.state[frame].segment<6>(first_[m]);
    return out;
  }

  Eigen::MatrixXd covariance(std::size_t frame) const {
    Eigen::MatrixXd out(size(), size());
    for (std::size_t m = 0; m < first_.size(); ++m)
      for (std::size_t n = 0; n < first_.size(); ++n)
        out.block<6, 6>(6 * static_cast<Index>(m), 6 * static_cast<Index>(n)) =
            track_.covariance[frame].block<6, 6>(first_[m], first_[n]);
    return out;
  }

  /// The angle that turns the body's shape into that of the places best, and the mean place; at rest.
  Eigen::VectorXd first_guess(std::size_t frame) const {
    const Eigen::VectorXd& x = track_.state[frame];
    Vector2d mean = Vector2d::Zero();
    for (const Index k : first_) mean += Vector2d(x[k], x[k + 3]) / static_cast<double>(first_.size());
    double sine = 0, cosine = 0;
    for (std::size_t m = 0; m < first_.size(); ++m) {
      const Vector2d on = markers_[m].at - mean_, seen = Vector2d(x[first_[m]], x[first_[m] + 3]) - mean;
      sine += cross(on, seen);
      cosine += on.dot(seen);
    }
    Eigen::VectorXd out = Eigen::VectorXd::Zero(9);
    out[2] = std::atan2(sine, cosine);
    out.head<2>() = mean - std::cos(out[2]) * mean_ - std::sin(out[2]) * turned_left(mean_);
    return out;
  }

  /// Takes what the body with these nine numbers would show off `missed`, and gives its slopes.
  Eigen::MatrixXd model(const Eigen::VectorXd& q, Eigen::VectorXd& missed) const {
    Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(size(), 9);
    const double rate = q[5], more = q[8];
    for (std::size_t m = 0; m < markers_.size(); ++m) {
      const Vector2d arm = std::cos(q[2]) * markers_[m].at + std::sin(q[2]) * turned_left(markers_[m].at),
                     across = turned_left(arm);
      const Vector2d shown[3] = {q.segment<2>(0) + arm, q.segment<2>(3) + rate * across,
                                 q.segment<2>(6) + more * across - rate * rate * arm};
      const Vector2d by_angle[3] = {across, -rate * arm, -more * arm - rate * rate * across};
      for (Index c = 0; c < 2; ++c)
        for (Index d = 0; d < 3; ++d) {
          const Index row = 6 * static_cast<Index>(m) + 3 * c + d;
          missed[row] -= shown[d][c];
          slope(row, 3 * d + c) = 1;
          slope(row, 3 * d + 2) = across[c];
          if (d > 0) slope(row, 2) = by_angle[d][c];
          if (d == 2) slope(row, 5) = -2 * rate * arm[c];
        }
    }
    return slope;
  }

  const SmoothTrack& track_;
  const std::vector<MarkerOnBody>& markers_;
  std::vector<Index> first_;          // of each marker's numbers
  Vector2d mean_ = Vector2d::Zero();  // of their places on the body
};

}  // namespace

std::vector<PlanarMotion> planar_motion(const SmoothTrack& track, const std::vector<MarkerOnBody>& markers,
                                        bool downwards) {
  const Body body(track, markers);
  std::vector<PlanarMotion> out;
  double last = 0;
  for (std::size_t i = 0; i < track.time.size(); ++i) {
    PlanarMotion now = body.at(i);
    if (downwards) {
      for (Eigen::Vector3d* part : {&now.place, &now.velocity, &now.acceleration}) (*part)[2] *= -1;
      for (const Index k : {2, 5, 8}) {
        now.covariance.row(k) *= -1;
        now.covariance.col(k) *= -1;
      }
    }
    last = now.place[2] = last + std::remainder(now.place[2] - last, 2 * std::numbers::pi);
    out.push_back(now);
  }
  return out;
}

}  // namespace fit::camera
