#include "hydro/potential/operations/transformations.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/potential/operations/operations.hpp"
#include "potential/modes.hpp"
#include "potential/readers.hpp"

namespace hydro::potential {

Eigen::VectorXd with_floor(Eigen::VectorXd size) {
  double largest[2] = {0, 0};
  for (Eigen::Index i = 0; i < size.size(); ++i)
    largest[is_translation(i)] = std::max(largest[is_translation(i)], size(i));
  constexpr double floor = 0.01;
  for (Eigen::Index i = 0; i < size.size(); ++i) size(i) = std::max(size(i), floor * largest[is_translation(i)]);
  return size;
}

Eigen::VectorXd mode_sizes(const std::vector<Eigen::MatrixXd>& matrices) {
  Eigen::VectorXd size = Eigen::VectorXd::Zero(matrices.front().rows());
  for (const auto& m : matrices) size = size.cwiseMax(m.diagonal().cwiseAbs());
  return with_floor(std::move(size));
}

double relative_size(const Eigen::MatrixXd& difference, const Eigen::VectorXd& size) {
  double worst = 0;
  for (Eigen::Index i = 0; i < size.size(); ++i)
    for (Eigen::Index j = 0; j < size.size(); ++j)
      if (size(i) > 0 && size(j) > 0)
        worst = std::max(worst, std::abs(difference(i, j)) / std::sqrt(size(i) * size(j)));
  return worst;
}

Eigen::MatrixXd nearest_passive(const Eigen::MatrixXd& B, const Eigen::VectorXd& size) {
  const Eigen::VectorXd scale = size.cwiseSqrt();
  const Eigen::MatrixXd scaled = scale.cwiseInverse().asDiagonal() * B * scale.cwiseInverse().asDiagonal();
  return scale.asDiagonal() * dense::positive_part(scaled) * scale.asDiagonal();
}

Eigen::MatrixXd for_every_body(const Matrix6& one, int bodies) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(6 * bodies, 6 * bodies);
  for (int b = 0; b < bodies; ++b) out.block<6, 6>(6 * b, 6 * b) = one;
  return out;
}

namespace {

constexpr double same_direction = 1e-9;  // rad: headings differ by round-off of degrees only
constexpr double circle = 2 * std::numbers::pi;

/// Applies `change` to the three points of each body.
template <class Change>
void for_each_point(Coefficients& c, Change change) {
  for (BodyData& body : c.body)
    for (auto* point : {&body.reference_point, &body.centre_of_gravity, &body.centre_of_buoyancy})
      if (*point) *point = change(**point);
}

/// Headings in increasing order, loads with them.
void sort_headings(Coefficients& c) {
  std::vector<std::size_t> order(c.heading.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return c.heading[a] < c.heading[b]; });
  Coefficients sorted = c;
  for (std::size_t i = 0; i < order.size(); ++i) {
    sorted.heading[i] = c.heading[order[i]];
    sorted.X[i] = c.X[order[i]];
  }
  c = std::move(sorted);
}

/// Headings + angle; a table over a full circle begins anew at the first heading that is not below its old beginning.
void turn_headings(Coefficients& c, double angle) {
  if (c.heading.empty()) return;
  const double first = c.heading.front();
  const bool is_circle = std::abs(c.heading.back() - first - circle) < same_direction;
  if (is_circle) {
    c.heading.pop_back();
    c.X.pop_back();
  }
  for (double& beta : c.heading) beta += angle;
  if (is_circle) {
    for (double& beta : c.heading) beta -= circle * std::floor((beta - first + same_direction) / circle);
    sort_headings(c);
    c.heading.push_back(c.heading.front() + circle);
    c.X.push_back(c.X.front());
  } else {
    const double whole = circle * std::floor((c.heading.front() + std::numbers::pi + same_direction) / circle);
    for (double& beta : c.heading) beta -= whole;
  }
}

}  // namespace

Coefficients turned(Coefficients c, double angle) {
  require(std::isfinite(angle), "{}: the angle of the turn must be finite, got {} rad", c.source, angle);
  // Quarter and half turns are exact: they only exchange axes, and π in a double is not π.
  const auto exact = [](double value) { return std::abs(value) < 1e-15 ? 0.0 : value; };
  const double cosine = exact(std::cos(angle)), sine = exact(std::sin(angle));
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << cosine, -sine, sine, cosine;
  Matrix6 of_modes = Matrix6::Zero();
  of_modes.topLeftCorner<3, 3>() = of_modes.bottomRightCorner<3, 3>() = turn;
  const Eigen::MatrixXd R = for_every_body(of_modes, c.bodies());
  const auto change = [&](Eigen::MatrixXd& m) { m = (R * m * R.transpose()).eval(); };  // (P28)
  for_each_radiation_matrix(c, change);
  if (c.C) change(*c.C);
  for (auto& X : c.X) X = (R.cast<std::complex<double>>() * X).eval();
  for_each_point(c, [&](const Eigen::Vector3d& p) { return Eigen::Vector3d(turn * p); });
  turn_headings(c, angle);
  if (angle != 0) c.notes.push_back(fmt::format("turned by {:.6g} degrees", Angle::from_radians(angle).degrees()));
  return c;
}

Coefficients scaled(Coefficients c, double length_ratio, double density_ratio) {
  require(std::isfinite(length_ratio) && length_ratio > 0, "the ratio of lengths must be positive, got {}",
          length_ratio);
  require(std::isfinite(density_ratio) && density_ratio > 0, "the ratio of densities must be positive, got {}",
          density_ratio);
  // (P29): one power of the length for each rotation, and time as its root.
  const auto power = [&](double exponent, Eigen::Index rotations) {
    return density_ratio * std::pow(length_ratio, exponent + static_cast<double>(rotations));
  };
  const auto change = [&](Eigen::MatrixXd& m, double exponent) {
    for (Eigen::Index i = 0; i < m.rows(); ++i)
      for (Eigen::Index j = 0; j < m.cols(); ++j) m(i, j) *= power(exponent, !is_translation(i) + !is_translation(j));
  };
  for (auto& A : c.A) change(A, 3);
  for (auto& B : c.B) change(B, 2.5);
  if (c.A_zero) change(*c.A_zero, 3);
  if (c.A_inf) change(*c.A_inf, 3);
  if (c.C) change(*c.C, 2);
  for (auto& X : c.X)
    for (Eigen::Index i = 0; i < X.rows(); ++i) X.row(i) *= power(2, !is_translation(i));
  for (double& omega : c.omega) omega /= std::sqrt(length_ratio);
  for_each_point(c, [&](const Eigen::Vector3d& p) { return Eigen::Vector3d(length_ratio * p); });
  for (BodyData& body : c.body)
    if (body.displaced_volume) *body.displaced_volume *= std::pow(length_ratio, 3);
  c.water.density *= density_ratio;
  if (!c.water.depth.is_infinite()) c.water.depth = WaterDepth::from_metres(length_ratio * c.water.depth.metres());
  c.notes.push_back(
      fmt::format("scaled by Froude's law: lengths by {:.10g}, density by {:.10g}", length_ratio, density_ratio));
  return c;
}

Coefficients repeated(const Coefficients& one, std::span<const Eigen::Vector2d> place) {
  require(one.bodies() == 1, "{}: one body can be repeated; the data have {}", one.source, one.bodies());
  require(!place.empty(), "{}: no place is given for the copies", one.source);
  for (std::size_t i = 0; i < place.size(); ++i) {
    require(place[i].allFinite(), "place {} of the copies is not finite", i + 1);
    for (std::size_t j = 0; j < i; ++j)
      require(place[i] != place[j], "places {} and {} of the copies are the same: ({:.6g}, {:.6g}) m", j + 1, i + 1,
              place[i].x(), place[i].y());
  }
  const int n = static_cast<int>(place.size());
  Coefficients out = one;
  for_each_radiation_matrix(out, [&](Eigen::MatrixXd& m) { m = for_every_body(m, n); });
  if (out.C) out.C = for_every_body(*out.C, n);
  for (auto& X : out.X) X = Eigen::MatrixXcd(6 * n, X.cols());
  out.body.clear();
  for (int b = 0; b < n; ++b) {
    const Coefficients there = translated(one, place[static_cast<std::size_t>(b)]);  // (P31)
    for (std::size_t h = 0; h < out.X.size(); ++h) out.X[h].middleRows<6>(6 * b) = there.X[h];
    out.body.push_back(there.body.front());
    out.body.back().name += fmt::format("{}", b + 1);
  }
  out.notes.push_back(fmt::format("{} copies of one body: each radiates and meets the waves as if alone", n));
  return out;
}

namespace {

/// +1 for modes that the mirror leaves, −1 for those that it turns round (P30).
Matrix6 mirror_of_modes(MirrorPlane plane) {
  Eigen::Matrix<double, 6, 1> signs;
  if (plane == MirrorPlane::y0) {
    signs << 1, -1, 1, -1, 1, -1;
  } else {
    signs << -1, 1, 1, 1, -1, -1;
  }
  return Matrix6(signs.asDiagonal());
}

double image_of(double heading, MirrorPlane plane) {
  return plane == MirrorPlane::y0 ? -heading : std::numbers::pi - heading;
}

void require_on_plane(const Coefficients& c, MirrorPlane plane) {
  const Eigen::Index axis = plane == MirrorPlane::y0 ? 1 : 0;
  constexpr double off = 1e-3;  // m: centres of meshes are off by less
  for (const BodyData& body : c.body)
    for (const auto* point : {&body.reference_point, &body.centre_of_gravity})
      if (*point && std::abs((**point)(axis)) > off)
        throw InputError(fmt::format("{}: a point of body \"{}\" is at {} = {:.6g} m, off the plane of symmetry",
                                     c.source, body.name, axis == 0 ? 'x' : 'y', (**point)(axis)),
                         {}, "translate the bodies onto the plane first, or state the reference points");
}

void require_symmetric(const Coefficients& c, const Eigen::MatrixXd& S, double tolerance) {
  const auto examine = [&](const std::vector<Eigen::MatrixXd>& matrices, const char* what) {
    if (matrices.empty()) return;
    const Eigen::VectorXd size = mode_sizes(matrices);
    for (const auto& m : matrices)
      if (const double off = relative_size(m - S * m * S, size); off > tolerance)
        throw InputError(
            fmt::format("{}: {} couples modes that symmetry separates, by {:.3g} of their size; {} is allowed",
                        c.source, what, off, tolerance),
            {}, "the bodies are not symmetric about this plane: compute the other headings");
  };
  examine(c.A, "A");
  examine(c.B, "B");
  if (c.C) examine({*c.C}, "C");
}

/// Loads of headings whose image is given too, or that are their own image, must be images of each other.
void require_symmetric_loads(const Coefficients& c, const Eigen::MatrixXd& S, MirrorPlane plane, double tolerance) {
  double largest[2] = {0, 0};  // of moments and of forces
  for (const auto& X : c.X)
    for (Eigen::Index i = 0; i < X.rows(); ++i)
      largest[is_translation(i)] = std::max(largest[is_translation(i)], X.row(i).cwiseAbs().maxCoeff());
  for (std::size_t h = 0; h < c.X.size(); ++h)
    for (std::size_t g = 0; g < c.X.size(); ++g) {
      if (std::abs(std::remainder(c.heading[g] - image_of(c.heading[h], plane), circle)) > same_direction) continue;
      const Eigen::MatrixXd off = (c.X[g] - S.cast<std::complex<double>>() * c.X[h]).cwiseAbs();
      for (Eigen::Index i = 0; i < off.rows(); ++i)
        if (off.row(i).maxCoeff() > tolerance * largest[is_translation(i)])
          throw InputError(
              fmt::format(
                  "{}: {} at headings {:.6g} and {:.6g} deg differs from its image by {:.3g} of the largest load; "
                  "{} is allowed",
                  c.source, mode_label(i), Angle::from_radians(c.heading[h]).degrees(),
                  Angle::from_radians(c.heading[g]).degrees(), off.row(i).maxCoeff() / largest[is_translation(i)],
                  tolerance),
              {}, "the bodies are not symmetric about this plane, or do not stand on it: compute the other headings");
    }
}

/// The mirror image of a heading, or nothing if the table has that direction.
std::optional<double> new_heading(const std::vector<double>& heading, double mirrored) {
  double lowest = mirrored, highest = mirrored;
  bool is_there = false;
  for (const double beta : heading) {
    lowest = std::min(lowest, beta);
    highest = std::max(highest, beta);
    if (std::abs(beta - mirrored) < same_direction) return std::nullopt;
    is_there = is_there || std::abs(std::remainder(beta - mirrored, circle)) < same_direction;
  }
  // The same direction again is wanted only to close the circle.
  if (is_there && highest - lowest > circle + same_direction) return std::nullopt;
  return mirrored;
}

}  // namespace

Coefficients completed_by_symmetry(Coefficients c, MirrorPlane plane, double tolerance) {
  require(!c.heading.empty(), "{}: there is no excitation to complete", c.source);
  require_on_plane(c, plane);
  const Eigen::MatrixXd S = for_every_body(mirror_of_modes(plane), c.bodies());
  require_symmetric(c, S, tolerance);
  require_symmetric_loads(c, S, plane, tolerance);
  const std::size_t given = c.heading.size();
  for (std::size_t h = 0; h < given; ++h) {
    if (const auto beta = new_heading(c.heading, image_of(c.heading[h], plane))) {
      c.heading.push_back(*beta);
      c.X.push_back(S.cast<std::complex<double>>() * c.X[h]);  // (P30)
    }
  }
  sort_headings(c);
  c.notes.push_back(fmt::format("excitation for {} of {} headings is by symmetry about the plane {} = 0",
                                c.heading.size() - given, c.heading.size(), plane == MirrorPlane::y0 ? 'y' : 'x'));
  return c;
}

}  // namespace hydro::potential
