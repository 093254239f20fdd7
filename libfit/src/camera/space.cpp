#include "fit/camera/space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "dynamics/spatial/rotation.hpp"
#include "gauss_newton.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"

namespace fit::camera {
namespace {

using dynamics::cross_matrix;
using dynamics::rotation_exp;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// What a film's pictures and its lens must have in common.
void check_pixels(const Track& track, const Eye& eye) {
  hydro::require(!track.in_metres, "the track is in metres, places in space are told by pixels");
  hydro::require(track.size.x() == 0 || track.size == eye.lens.size,
                 "the film's pictures are {} x {} px, the lens was calibrated with {} x {} px", track.size.x(),
                 track.size.y(), eye.lens.size.x(), eye.lens.size.y());
}

Eigen::Matrix2d errors_of(const Sighting& s, const std::string& marker, double deviation) {
  hydro::require(s.has_covariance() || deviation > 0,
                 "the track tells no errors of marker \"{}\": state the deviation of its places", marker);
  if (s.has_covariance()) return s.covariance;
  return deviation * deviation * Eigen::Matrix2d::Identity();
}

/// L⁻¹ of C = L Lᵀ: what it multiplies has independent errors of 1.
Eigen::Matrix2d whitening_of(const Eigen::Matrix2d& covariance) {
  const double a = std::sqrt(covariance(0, 0)), b = covariance(1, 0) / a, c = std::sqrt(covariance(1, 1) - b * b);
  Eigen::Matrix2d out;
  out << 1 / a, 0, -b / (a * c), 1 / c;
  return out;
}

/// A marker of the body in a frame.
struct SeenOnBody {
  Vector3d at;  // on the body
  Vector2d pixel;
  Eigen::Matrix2d whitening;
};

/// (V22) The pose that lies downhill of a first one.
std::optional<SpacePose> downhill(const Eye& eye, const std::vector<SeenOnBody>& seen, SpacePose pose,
                                  double& squares) {
  const FewNumbers sought{[&](Eigen::VectorXd& missed, Eigen::MatrixXd& slope) {
                            const auto rows = 2 * std::ssize(seen);
                            missed.resize(rows);
                            slope.resize(rows, 6);
                            for (std::size_t m = 0; m < seen.size(); ++m) {
                              const auto row = 2 * static_cast<Eigen::Index>(m);
                              const Vector3d arm = pose.attitude * seen[m].at, point = pose.place + arm;
                              if (!((eye.rotation * point + eye.translation).z() > 0)) return false;
                              missed.segment<2>(row) = seen[m].whitening * (seen[m].pixel - pixel_of(eye, point));
                              const Eigen::Matrix<double, 2, 3> by_point = seen[m].whitening * pixel_slope(eye, point);
                              slope.block<2, 3>(row, 0) = by_point;
                              slope.block<2, 3>(row, 3) = -by_point * cross_matrix(arm);
                            }
                            return true;
                          },
                          [&](const Eigen::VectorXd& step) {
                            pose.place += step.head<3>();
                            pose.attitude = (rotation_exp(step.tail<3>()) * pose.attitude).normalized();
                          }};
  const auto solved = least_squares(sought);
  if (!solved) return std::nullopt;
  squares = solved->squares;
  pose.covariance = solved->covariance;
  pose.freedoms = static_cast<double>(2 * seen.size() - 6);
  pose.stray = std::sqrt(squares / pose.freedoms);
  return pose;
}

/// Where markers lie on a body: their mean, and Σ (x − x̄)(x − x̄)ᵀ.
struct Spread {
  Vector3d mean = Vector3d::Zero();
  Matrix3d squares = Matrix3d::Zero();
};
template <class Markers>
Spread spread_of(const Markers& markers) {
  Spread out;
  for (const auto& m : markers) out.mean += m.at / static_cast<double>(markers.size());
  for (const auto& m : markers) out.squares += (m.at - out.mean) * (m.at - out.mean).transpose();
  return out;
}

/// The pose that shows nearly the same of markers in one plane: half a turn about the line of sight, and back within
/// the plane.
SpacePose mirrored(const Eye& eye, const std::vector<SeenOnBody>& seen, const SpacePose& pose) {
  constexpr double half = std::numbers::pi;
  const auto [mean, squares] = spread_of(seen);
  // They lie least apart along the normal.
  const Vector3d normal = hydro::dense::symmetric_eigen(squares).vectors.col(0);
  const Vector3d middle = pose.place + pose.attitude * mean,
                 sight = (middle + eye.rotation.transpose() * eye.translation).normalized();
  SpacePose out = pose;
  out.attitude = rotation_exp(half * sight) * pose.attitude * rotation_exp(half * normal);
  out.place = middle - out.attitude * mean;
  return out;
}

/// Whether two poses are one, by their errors.
bool alike(const SpacePose& a, const SpacePose& b) {
  constexpr double apart = 16;  // four deviations, squared
  Eigen::VectorXd off(6);
  off << b.place - a.place, dynamics::rotation_log(b.attitude * a.attitude.conjugate());
  const hydro::dense::Cholesky errors(a.covariance);
  return errors && off.dot(errors.solve(off).col(0)) < apart;
}

void check_markers(const Track& track, const std::vector<MarkerInSpace>& markers) {
  hydro::require(markers.size() >= 4, "four markers on a body tell its pose in space, got {}", markers.size());
  for (const auto& m : markers) track.marker(m.marker);
  const Eigen::VectorXd across = hydro::dense::symmetric_eigenvalues(spread_of(markers).squares);
  constexpr double thin = 1e-4;  // squared: a hundredth of the length
  hydro::require(across[1] > thin * across[2], "the markers on a body lie on one line, which tells no turn about it");
}

/// (V33) Whether chance makes the pixels of one of so many frames miss their pose by that.
bool by_chance(const SpacePose& pose, std::size_t markers, std::size_t frames) {
  constexpr double clean = 0.99;
  const auto freedoms = static_cast<double>(2 * markers - 6);
  return pose.stray * pose.stray * freedoms <
         hydro::signal::chi_square_quantile(std::pow(clean, 1 / static_cast<double>(frames)), freedoms);
}

}  // namespace

Vector2d pixel_of(const Eye& eye, const Vector3d& point) {
  const Vector3d seen = eye.rotation * point + eye.translation;
  hydro::require(seen.z() > 0, "the point ({:.4g}, {:.4g}, {:.4g}) m is not before the camera", point.x(), point.y(),
                 point.z());
  return pixel_of(eye.lens, Vector2d(seen.head<2>() / seen.z()));
}

Eigen::Matrix<double, 2, 3> pixel_slope(const Eye& eye, const Vector3d& point) {
  const Vector3d seen = eye.rotation * point + eye.translation;
  const Vector2d ray = seen.head<2>() / seen.z();
  Eigen::Matrix<double, 2, 3> by_seen;
  by_seen << 1, 0, -ray.x(), 0, 1, -ray.y();
  return eye.lens.focal.asDiagonal() * distortion_slope(eye.lens, ray) * (by_seen / seen.z()) * eye.rotation;
}

SpacePoses poses_in_space(const Track& track, const Eye& eye, const std::vector<MarkerInSpace>& markers,
                          const Vector3d& place, double deviation) {
  check_pixels(track, eye);
  check_markers(track, markers);
  constexpr double as_likely = 9;  // twice the logarithm of how much likelier a pose is than its mirrored one: e^4.5
  SpacePoses out;
  SpacePose last{place, Eigen::Quaterniond::Identity(), {}, 0};
  for (std::size_t i = 0; i < track.frames(); ++i) {
    out.pose.emplace_back();
    out.stray.push_back(std::numeric_limits<double>::quiet_NaN());
    std::vector<SeenOnBody> seen;
    for (const auto& m : markers)
      if (const auto& s = track.marker(m.marker).seen[i])
        seen.push_back({m.at, s->at, whitening_of(errors_of(*s, m.marker, deviation))});
    if (seen.size() < 4) {
      ++out.too_few;
      continue;
    }
    double squares = 0, other_squares = 0;
    std::optional<SpacePose> best = downhill(eye, seen, last, squares);
    if (!best) {
      ++out.lost;
      continue;
    }
    if (std::optional<SpacePose> other = downhill(eye, seen, mirrored(eye, seen, *best), other_squares);
        other && !alike(*best, *other)) {
      if (other_squares < squares) std::swap(best, other), std::swap(squares, other_squares);
      if (other_squares - squares < as_likely && by_chance(*best, seen.size(), track.frames())) {
        ++out.ambiguous;
        continue;
      }
    }
    out.stray.back() = best->stray;
    if (!by_chance(*best, seen.size(), track.frames())) {
      ++out.lost;
      out.misfits.push_back(i);
      continue;
    }
    last = *best;
    out.pose.back() = best;
  }
  return out;
}

namespace {

/// Where two rays are nearest to each other; none where that is behind a camera.
std::optional<Vector3d> nearest_of_rays(const Eye& first, const Vector2d& a, const Eye& second, const Vector2d& b) {
  const auto direction = [](const Eye& eye, const Vector2d& pixel) -> Vector3d {
    const Vector2d ray = ray_of(eye.lens, pixel);
    return (eye.rotation.transpose() * Vector3d(ray.x(), ray.y(), 1)).normalized();
  };
  const Vector3d from = -first.rotation.transpose() * first.translation,
                 to = -second.rotation.transpose() * second.translation, d = direction(first, a),
                 e = direction(second, b);
  const double cosine = d.dot(e), between = 1 - cosine * cosine;
  if (!(between > 1e-10)) return std::nullopt;  // rays that are parallel to 1e-5
  const Vector3d w = to - from;
  const double along = (d.dot(w) - cosine * e.dot(w)) / between, other = (cosine * d.dot(w) - e.dot(w)) / between;
  if (!(along > 0 && other > 0)) return std::nullopt;
  return (from + along * d + to + other * e) / 2;
}

}  // namespace

std::optional<SpacePoint> triangulated(const Eye& first, const Sighting& at_first, const Eye& second,
                                       const Sighting& at_second) {  // (V23)
  const auto start = nearest_of_rays(first, at_first.at, second, at_second.at);
  if (!start) return std::nullopt;
  Vector3d point = *start;
  const std::array<std::pair<const Eye*, const Sighting*>, 2> both{{{&first, &at_first}, {&second, &at_second}}};
  const auto solved = least_squares({[&](Eigen::VectorXd& missed, Eigen::MatrixXd& slope) {
                                       missed.resize(4);
                                       slope.resize(4, 3);
                                       for (std::size_t k = 0; k < 2; ++k) {
                                         const auto& [eye, seen] = both[k];
                                         if (!((eye->rotation * point + eye->translation).z() > 0)) return false;
                                         const Eigen::Matrix2d whitening = whitening_of(seen->covariance);
                                         const auto row = 2 * static_cast<Eigen::Index>(k);
                                         missed.segment<2>(row) = whitening * (seen->at - pixel_of(*eye, point));
                                         slope.block<2, 3>(row, 0) = whitening * pixel_slope(*eye, point);
                                       }
                                       return true;
                                     },
                                     [&](const Eigen::VectorXd& step) { point += step; }});
  if (!solved) return std::nullopt;
  return SpacePoint{point, solved->covariance, std::sqrt(solved->squares)};
}

namespace {

/// Lagrange's weights at a time of the four frames around it; none beyond the ends or across a gap.
struct FramesAround {
  std::size_t first;
  std::array<double, 4> weight;
};
std::optional<FramesAround> between_frames(const std::vector<double>& times, double time) {
  const auto after = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin());
  if (after < 2 || after + 1 >= times.size()) return std::nullopt;
  FramesAround out{after - 2, {}};
  for (std::size_t j = 0; j < 4; ++j) {
    out.weight[j] = 1;
    for (std::size_t k = 0; k < 4; ++k)
      if (k != j) out.weight[j] *= (time - times[out.first + k]) / (times[out.first + j] - times[out.first + k]);
  }
  return out;
}

/// (V34) Mean square of the fourth divided difference of a marker's path over five frames in a row, without what errors
/// of sightings make of it: what a cubic through four of them misses is that times the distances from all four. None
/// where no five frames are there.
std::optional<Eigen::Matrix2d> bends_of(const Marker& marker, const std::vector<double>& times, double deviation) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero(), noise = Eigen::Matrix2d::Zero();
  int stencils = 0;
  for (std::size_t first = 0; first + 5 <= times.size(); ++first) {
    Vector2d bend = Vector2d::Zero();
    Eigen::Matrix2d errors = Eigen::Matrix2d::Zero();
    bool whole = true;
    for (std::size_t j = 0; j < 5 && whole; ++j) {
      const auto& s = marker.seen[first + j];
      whole = s.has_value();
      if (!whole) break;
      double weight = 1;
      for (std::size_t k = 0; k < 5; ++k)
        if (k != j) weight /= times[first + j] - times[first + k];
      bend += weight * s->at;
      errors += weight * weight * errors_of(*s, marker.name, deviation);
    }
    if (!whole) continue;
    sum += bend * bend.transpose();
    noise += errors;
    ++stencils;
  }
  if (stencils == 0) return std::nullopt;
  const auto all = static_cast<double>(stencils);
  if (sum.trace() <= noise.trace()) return Eigen::Matrix2d::Zero();
  return (sum.trace() - noise.trace()) / sum.trace() / all * sum;
}

std::optional<Sighting> sighting_at(const Marker& marker, const std::vector<double>& times, double time,
                                    const FramesAround& at, const std::optional<Eigen::Matrix2d>& bends,
                                    double deviation) {
  Sighting out{Vector2d::Zero(), Eigen::Matrix2d::Zero()};
  double distances = 1;
  for (std::size_t k = 0; k < 4; ++k) {
    distances *= time - times[at.first + k];
    if (at.weight[k] == 0) continue;  // a frame of its own
    const auto& s = marker.seen[at.first + k];
    if (!s) return std::nullopt;
    out.at += at.weight[k] * s->at;
    out.covariance += at.weight[k] * at.weight[k] * errors_of(*s, marker.name, deviation);
  }
  if (distances == 0) return out;
  if (!bends) return std::nullopt;  // nothing tells what the cubic misses
  out.covariance += distances * distances * *bends;
  return out;
}

}  // namespace

SpaceTrack joined(const SeenByEye& first_camera, const SeenByEye& second_camera) {
  const Track &first = first_camera.track, &second = second_camera.track;
  check_pixels(first, first_camera.eye);
  check_pixels(second, second_camera.eye);
  SpaceTrack out;
  out.time = first.time;
  out.spacing =
      second.frames() < 2 ? 0 : (second.time.back() - second.time.front()) / static_cast<double>(second.frames() - 1);
  for (const Marker& a : first.markers) {
    const auto b =
        std::find_if(second.markers.begin(), second.markers.end(), [&](const Marker& m) { return m.name == a.name; });
    if (b == second.markers.end()) continue;
    out.markers.push_back(a.name);
    auto& points = out.point.emplace_back(first.frames());
    const auto bends = bends_of(*b, second.time, second_camera.deviation);
    for (std::size_t i = 0; i < first.frames(); ++i) {
      const auto at = between_frames(second.time, first.time[i]);
      const auto other =
          at ? sighting_at(*b, second.time, first.time[i], *at, bends, second_camera.deviation) : std::nullopt;
      if (!a.seen[i] || !other) continue;
      const Sighting own{a.seen[i]->at, errors_of(*a.seen[i], a.name, first_camera.deviation)};
      points[i] = triangulated(first_camera.eye, own, second_camera.eye, *other);
      if (points[i])
        ++out.points;
      else
        ++out.behind;
    }
  }
  hydro::require(!out.markers.empty(), "the two tracks have no marker in common");
  hydro::require(
      out.points + out.behind > 0,
      "the two tracks have no time in common: one runs from {:.6g} s to {:.6g} s, the other from {:.6g} s to "
      "{:.6g} s",
      first.time.front(), first.time.back(), second.time.front(), second.time.back());
  return out;
}

}  // namespace fit::camera
