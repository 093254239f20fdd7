#pragma once
/// \file  Constraints of joints and contacts written a second time from their formulas, as values alone: gradient and
/// curvature are taken by machine, from numbers that carry two derivatives.
#include <Eigen/Core>

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <type_traits>
#include <variant>
#include <vector>

#include "dynamics/joint/constraints.hpp"

namespace laws {

using dynamics::AxesConstraint;
using dynamics::Ball;
using dynamics::Box;
using dynamics::GapConstraint;
using dynamics::HalfSpace;
using dynamics::JointSet;
using dynamics::PointConstraint;
using dynamics::Rod;
using dynamics::State;
using dynamics::StickConstraint;

/// A number with its derivatives by the displacements of two bodies, each of which has its own by displacements that
/// went before: of a constraint's value the gradient, and how it varies (D15).
using Once = ceres::Jet<double, 12>;
using Twice = ceres::Jet<Once, 12>;
inline Twice number(double x) { return Twice(Once(x)); }

/// In place of Eigen's, whose products ask for a zero made of an integer.
struct TwiceVector {
  std::array<Twice, 3> at;
};
inline TwiceVector operator+(const TwiceVector& a, const TwiceVector& b) {
  return {a.at[0] + b.at[0], a.at[1] + b.at[1], a.at[2] + b.at[2]};
}
inline TwiceVector operator*(const Twice& s, const TwiceVector& v) { return {s * v.at[0], s * v.at[1], s * v.at[2]}; }
inline TwiceVector operator-(const TwiceVector& a, const TwiceVector& b) { return a + number(-1) * b; }
inline Twice dot(const TwiceVector& a, const TwiceVector& b) {
  return a.at[0] * b.at[0] + a.at[1] * b.at[1] + a.at[2] * b.at[2];
}
inline Twice length(const TwiceVector& v) { return sqrt(dot(v, v)); }
inline TwiceVector twice(const Eigen::Vector3d& v) { return {number(v[0]), number(v[1]), number(v[2])}; }
/// As it is once it has been displaced the first time.
inline Eigen::Matrix<Once, 3, 1> once(const TwiceVector& v) { return {v.at[0].a, v.at[1].a, v.at[2].a}; }

/// A body, or the ground.
struct TwiceBody {
  bool moves = false;
  TwiceVector centre = twice(Eigen::Vector3d::Zero());
  std::array<TwiceVector, 3> axes{twice(Eigen::Vector3d::UnitX()), twice(Eigen::Vector3d::UnitY()),
                                  twice(Eigen::Vector3d::UnitZ())};

  TwiceVector arm(const Eigen::Vector3d& in_body) const {
    return number(in_body[0]) * axes[0] + number(in_body[1]) * axes[1] + number(in_body[2]) * axes[2];
  }
  TwiceVector point(const Eigen::Vector3d& in_body) const { return centre + arm(in_body); }
};

/// (1 + [θ′]×)(1 + [θ]×)R: small global rotations one after the other, θ the one that went before.
inline TwiceBody twice_body(const State& state, std::optional<int> b) {
  TwiceBody out;
  if (!b) return out;
  out.moves = true;
  const int row = 6 * *b;
  const auto& pose = state.pose[static_cast<std::size_t>(*b)];
  const Eigen::Matrix3d R = pose.attitude.toRotationMatrix();
  for (int i = 0; i < 3; ++i)
    out.centre.at[static_cast<std::size_t>(i)] = Twice(Once(pose.centre[i], row + i), row + i);
  const Eigen::Matrix<Once, 3, 1> theta(Once(0, row + 3), Once(0, row + 4), Once(0, row + 5));
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Matrix<Once, 3, 1> axis = R.col(static_cast<int>(k)).cast<Once>(), turned = axis + theta.cross(axis);
    for (std::size_t i = 0; i < 3; ++i) {
      out.axes[k].at[i] = Twice(turned[static_cast<int>(i)]);
      for (int m = 0; m < 3; ++m)
        out.axes[k].at[i].v[row + 3 + m] =
            Eigen::Matrix<Once, 3, 1>(Eigen::Vector3d::Unit(m).cast<Once>().cross(turned))[static_cast<int>(i)];
    }
  }
  return out;
}

/// (D13)
inline Twice law_of(const PointConstraint& c, const TwiceBody& a, const TwiceBody& b) {
  return dot(c.turns ? a.arm(c.direction) : twice(c.direction), b.point(c.second_arm) - a.point(c.first_arm));
}
/// (D14)
inline Twice law_of(const AxesConstraint& c, const TwiceBody& a, const TwiceBody& b) {
  return dot(a.arm(c.first_axis), b.arm(c.second_axis));
}

/// (D22): the shortest way between two shapes, with its ends.
struct TwiceWay {
  Twice gap;
  TwiceVector normal, on_first, on_second;
};
inline TwiceWay way_between(const TwiceVector& p, double radius_p, const TwiceVector& q, double radius_q) {
  const TwiceVector d = q - p;
  const Twice L = length(d);
  const TwiceVector n = number(1) / L * d;
  return {L - number(radius_p + radius_q), n, p + number(radius_p) * n, q - number(radius_q) * n};
}
/// The point of a segment that is closest to p.
inline TwiceVector closest_to(const TwiceVector& p, const TwiceVector& from, const TwiceVector& to) {
  const TwiceVector along = to - from;
  if (dot(along, along).a.a == 0) return from;
  const Twice s = dot(p - from, along) / dot(along, along);
  return s.a.a <= 0 ? from : s.a.a >= 1 ? to : from + s * along;
}
/// The least of the ways from each end to the other segment, and across where the lines are closest within both.
inline TwiceWay way_between(const Rod& first, const TwiceBody& a, const Rod& second, const TwiceBody& b) {
  const TwiceVector p = a.point(first.from), q = a.point(first.to), r = b.point(second.from), s = b.point(second.to);
  std::vector<TwiceWay> ways;
  const auto add = [&](const TwiceVector& on_first, const TwiceVector& on_second) {
    ways.push_back(way_between(on_first, first.radius, on_second, second.radius));
  };
  for (const TwiceVector& end : {p, q}) add(end, closest_to(end, r, s));
  for (const TwiceVector& end : {r, s}) add(closest_to(end, p, q), end);
  const TwiceVector u = q - p, v = s - r, w = r - p;
  const Twice cross = dot(u, u) * dot(v, v) - dot(u, v) * dot(u, v);
  if (cross.a.a > 1e-6) {
    const Twice x = (dot(v, v) * dot(u, w) - dot(u, v) * dot(v, w)) / cross,
                y = (dot(u, v) * dot(u, w) - dot(u, u) * dot(v, w)) / cross;
    if (x.a.a > 0 && x.a.a < 1 && y.a.a > 0 && y.a.a < 1) add(p + x * u, r + y * v);
  }
  return *std::min_element(ways.begin(), ways.end(),
                           [](const TwiceWay& l, const TwiceWay& m) { return l.gap.a.a < m.gap.a.a; });
}
inline TwiceWay way_between(const HalfSpace& plane, const TwiceBody& a, const Ball& ball, const TwiceBody& b) {
  const TwiceVector n = a.arm(plane.outward), c = b.point(ball.centre);
  const Twice height = dot(n, c - a.point(plane.point));
  return {height - number(ball.radius), n, c - height * n, c - number(ball.radius) * n};
}
inline TwiceWay way_between(const Box& box, const TwiceBody& a, const Ball& ball, const TwiceBody& b) {
  const TwiceVector c = b.point(ball.centre), from_middle = c - a.point(box.centre);
  TwiceVector nearest = a.point(box.centre);
  double depth = 1e9;
  std::array<TwiceVector, 3> outward;
  std::size_t face = 0;
  bool inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<int>(i);
    const Twice local = dot(from_middle, a.arm(box.axes.col(k)));
    const double side = local.a.a < 0 ? -1 : 1, beyond = std::abs(local.a.a) - box.half[k];
    outward[i] = a.arm(side * box.axes.col(k));
    inside = inside && beyond < 0;
    nearest = nearest + (beyond > 0 ? number(box.half[k]) : number(side) * local) * outward[i];
    if (-beyond < depth) depth = -beyond, face = i;
  }
  if (!inside) return way_between(nearest, 0, c, ball.radius);
  const Twice out = number(box.half[static_cast<int>(face)]) - dot(from_middle, outward[face]);
  return {number(-ball.radius) - out, outward[face], c + out * outward[face], c - number(ball.radius) * outward[face]};
}
inline TwiceWay way_between(const GapConstraint& c, const TwiceBody& a, const TwiceBody& b) {
  const auto reversed = [](const TwiceWay& w) {
    return TwiceWay{w.gap, number(-1) * w.normal, w.on_second, w.on_first};
  };
  const auto rod = [](const dynamics::Shape& s) {
    const auto* ball = std::get_if<Ball>(&s);
    return ball != nullptr ? Rod{ball->centre, ball->centre, ball->radius} : std::get<Rod>(s);
  };
  if (const auto* plane = std::get_if<HalfSpace>(&c.first)) return way_between(*plane, a, std::get<Ball>(c.second), b);
  if (const auto* box = std::get_if<Box>(&c.first)) return way_between(*box, a, std::get<Ball>(c.second), b);
  if (std::holds_alternative<HalfSpace>(c.second) || std::holds_alternative<Box>(c.second))
    return reversed(way_between(GapConstraint{c.second, c.first}, b, a));
  return way_between(rod(c.first), a, rod(c.second), b);
}

/// (D23): the length of the way, less radii.
inline Twice law_of(const GapConstraint& c, const TwiceBody& a, const TwiceBody& b) { return way_between(c, a, b).gap; }

/// (D24): no value, and in place of the gradient the rates at which the points that touch, of either body, slip along
/// the direction when one velocity is 1.
inline Twice law_of(const StickConstraint& c, const TwiceBody& a, const TwiceBody& b) {
  const TwiceWay way = way_between(c.shapes, a, b);
  using OnceVector = Eigen::Matrix<Once, 3, 1>;
  const OnceVector t = c.direction.cast<Once>(), first = once(way.on_first - a.centre),
                   second = once(way.on_second - b.centre);
  Twice out = number(0);
  for (int k = 0; k < (b.moves ? 12 : 6); ++k) {
    const Eigen::Matrix<double, 12, 1> v = Eigen::Matrix<double, 12, 1>::Unit(k);
    const OnceVector of_first = v.head<3>().cast<Once>() + OnceVector(v.segment<3>(3).cast<Once>()).cross(first),
                     of_second = v.segment<3>(6).cast<Once>() + OnceVector(v.tail<3>().cast<Once>()).cross(second);
    out.v[k] = t.dot(OnceVector(of_second - of_first));
  }
  return out;
}

/// (D53)
inline Twice coordinate_of(const std::vector<dynamics::RigidBody>& bodies, const dynamics::Joint& j, const TwiceBody& a,
                           const TwiceBody& b) {
  const Eigen::Matrix3d frame = dynamics::frame_of(j);
  if (j.kind == dynamics::JointKind::hinge) {
    const TwiceVector y2 = b.arm(frame.col(1));
    return atan2(dot(a.arm(frame.col(2)), y2), dot(a.arm(frame.col(1)), y2));
  }
  const Eigen::Vector3d second =
      j.second ? Eigen::Vector3d(j.place - bodies[static_cast<std::size_t>(*j.second)].rest_centre()) : j.place;
  return dot(a.arm(frame.col(0)),
             b.point(second) - a.point(j.place - bodies[static_cast<std::size_t>(j.first)].rest_centre()));
}

/// All constraints of a set, in its order. Prescribed motions belong to its one joint. (D31)
inline std::vector<Twice> laws_of(const std::vector<dynamics::RigidBody>& bodies, const JointSet& set, const State& s) {
  std::vector<Twice> out;
  for (const dynamics::Constraint& c : set.constraints()) {
    const TwiceBody a = twice_body(s, c.first), b = twice_body(s, c.second);
    out.push_back(std::visit(
        [&]<class Law>(const Law& what) {
          if constexpr (std::is_same_v<Law, dynamics::PrescribedConstraint>) {
            const dynamics::Joint& j = set.joints().front();
            const Twice off = coordinate_of(bodies, j, a, b) - number(j.prescribed(s.time).coordinate);
            return j.kind == dynamics::JointKind::hinge
                       ? off - number(2 * std::numbers::pi * std::round(off.a.a / (2 * std::numbers::pi)))
                       : off;
          } else {
            return law_of(what, a, b);
          }
        },
        c.what));
  }
  return out;
}

inline dynamics::Matrix12 curvature_of(const Twice& law) {
  dynamics::Matrix12 H;
  for (int k = 0; k < 12; ++k) H.row(k) = law.v[k].v.transpose();
  return H;
}

/// Multipliers of no order.
inline Eigen::VectorXd multipliers(const JointSet& set) {
  return Eigen::VectorXd::NullaryExpr(set.count(), [](Eigen::Index i) { return std::cos(1 + 2.3 * double(i)); });
}

/// Of sums of a few products of numbers of order 1 and of arms of some metres: 2e-15 is seen.
constexpr double constraint_round_off = 1e-13;

/// Values, G, ∂(Gᵀλ)/∂q and Ġv − s̈ of a set on two bodies; modes that are held do not take part in them.
inline void expect_automatic_derivatives(const std::vector<dynamics::RigidBody>& bodies, const JointSet& set,
                                         const State& s, double curvature_tolerance = constraint_round_off) {
  Eigen::VectorXd free(12);
  for (int i = 0; i < 12; ++i) free[i] = bodies[static_cast<std::size_t>(i / 6)].is_free(i % 6) ? 1 : 0;
  const auto all = laws_of(bodies, set, s);
  const Eigen::Index n = set.count();
  const Eigen::VectorXd lambda = multipliers(set), v = free.cwiseProduct(s.velocity);
  Eigen::VectorXd g(n), convective(n);
  Eigen::MatrixXd G(n, 12), H = Eigen::MatrixXd::Zero(12, 12);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Twice& law = all[static_cast<std::size_t>(i)];
    const dynamics::Matrix12 bend = curvature_of(law);
    g[i] = law.a.a;
    for (int k = 0; k < 12; ++k) G(i, k) = law.v[k].a;
    H += lambda[i] * bend;
    convective[i] = v.dot(bend * v);
    if (const auto* prescribed =
            std::get_if<dynamics::PrescribedConstraint>(&set.constraints()[static_cast<std::size_t>(i)].what))
      convective[i] -= prescribed->motion(s.time).acceleration;
  }
  ASSERT_TRUE(g.allFinite() && G.allFinite() && H.allFinite());
  const auto apart = [](const Eigen::MatrixXd& x, const Eigen::MatrixXd& y) { return (x - y).cwiseAbs().maxCoeff(); };
  EXPECT_LE(apart(set.values(s), g), constraint_round_off * (1 + g.cwiseAbs().maxCoeff())) << "value";
  EXPECT_LE(apart(set.dense(set.gradients(s)), G * free.asDiagonal()),
            constraint_round_off * (1 + G.cwiseAbs().maxCoeff()))
      << "gradient";
  dynamics::BlockPattern pattern(2);
  set.couple(pattern);
  pattern.freeze();
  dynamics::BlockMatrix curvature(pattern);
  set.add_curvature(s, lambda, 1, curvature);
  const double size = 1 + H.cwiseAbs().maxCoeff();
  EXPECT_LE(apart(curvature.dense(), free.asDiagonal() * H * free.asDiagonal()), curvature_tolerance * size)
      << "curvature";
  State moving = s;
  moving.velocity = v;
  EXPECT_LE(apart(set.convective(moving), convective), curvature_tolerance * size * (1 + v.squaredNorm()))
      << "of the velocities";
}

}  // namespace laws
