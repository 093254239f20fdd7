#include "symmetry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>

#include "groups.hpp"

namespace hydro::cylinders {
namespace {

using Eigen::Index;
using Eigen::Matrix2d;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using potential::Matrix6;

constexpr double same_stand = 1e-9;  // of a radius: what rounding leaves of places that are computed

/// Nothing, the mirrors in the axes and in the diagonals, and the turns by 90, 180 and 270 degrees.
std::array<Matrix2d, 8> turns_of_a_square() {
  std::array<Matrix2d, 8> out;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double x = (i & 1U) != 0 ? -1 : 1, y = (i & 2U) != 0 ? -1 : 1;
    if (i < 4)
      out[i] << x, 0, 0, y;
    else
      out[i] << 0, x, y, 0;
  }
  return out;
}

Vector2d middle_of(const std::vector<Cylinder>& circle) {
  Vector2d sum = Vector2d::Zero();
  for (const Cylinder& c : circle) sum += c.centre;
  return sum / static_cast<double>(circle.size());
}

/// Where each circle comes to; none if one comes to where no equal one stands.
std::optional<std::vector<std::size_t>> images(const std::vector<Cylinder>& circle,
                                               const std::vector<std::size_t>& kind, const Vector2d& middle,
                                               const Matrix2d& turn) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < circle.size(); ++i) {
    const Vector2d there = middle + turn * (circle[i].centre - middle);
    std::size_t j = 0;
    while (j < circle.size() &&
           (kind[j] != kind[i] || (circle[j].centre - there).norm() > same_stand * circle[i].radius))
      ++j;
    if (j == circle.size()) return {};
    out.push_back(j);
  }
  return out;
}

std::vector<std::size_t> bodies_of(const MatrixXd& motion) {
  std::vector<std::size_t> out;
  for (Index row = 0; row < motion.rows(); row += 6) {
    Index column = 0;
    while (motion.block<6, 6>(row, column).isZero(0)) column += 6;
    out.push_back(static_cast<std::size_t>(column / 6));
  }
  return out;
}

Matrix6 modes_of(const Matrix2d& turn) {
  // A rotation is an axial vector: mirrors turn it the other way round.
  Matrix6 out = Matrix6::Zero();
  const double handed = turn.determinant();
  out.topLeftCorner<2, 2>() = turn;
  out(2, 2) = 1;
  out.block<2, 2>(3, 3) = handed * turn;
  out(5, 5) = handed;
  return out;
}

/// Where each body comes to; none if its circles come to several, or its point of reference to another place of it.
std::optional<std::vector<std::size_t>> images_of_bodies(const std::vector<std::size_t>& of_circles,
                                                         const MatrixXd& motion, const Matrix2d& turn) {
  const std::vector<std::size_t> body = bodies_of(motion);
  std::vector<std::optional<std::size_t>> out(static_cast<std::size_t>(motion.cols() / 6));
  const Matrix6 modes = modes_of(turn);
  for (std::size_t i = 0; i < of_circles.size(); ++i) {
    const std::size_t j = of_circles[i];
    auto& image = out[body[i]];
    if (!image) image = body[j];
    const auto block = [&](std::size_t c) -> Matrix6 {
      return motion.block<6, 6>(6 * static_cast<Index>(c), 6 * static_cast<Index>(body[c]));
    };
    const Matrix6 off = block(j) * modes - modes * block(i);
    if (*image != body[j] || off.cwiseAbs().maxCoeff() > same_stand * block(i).cwiseAbs().maxCoeff()) return {};
  }
  std::vector<std::size_t> all;
  for (const auto& image : out) all.push_back(image.value());
  return all;
}

double turned_back(const Matrix2d& turn, double angle) {
  const Vector2d from = turn.transpose() * Vector2d(std::cos(angle), std::sin(angle));
  return std::atan2(from.y(), from.x());
}

}  // namespace

Matrix6 Symmetry::modes() const { return modes_of(turn); }

SolvedMotions::SolvedMotions(std::size_t bodies) {
  symmetry_.push_back({Matrix2d::Identity(), {}});
  for (std::size_t b = 0; b < bodies; ++b) symmetry_.front().image.push_back(b);
  choose();
}

SolvedMotions::SolvedMotions(const std::vector<Cylinder>& circle, const std::vector<std::size_t>& kind,
                             const MatrixXd& motion,
                             const std::function<bool(std::size_t kind, const Matrix2d& turn)>& has_symmetry)
    : SolvedMotions(static_cast<std::size_t>(motion.cols() / 6)) {
  if (motion.cols() <= columns_at_a_time) return;
  middle_ = middle_of(circle);
  const auto turns = turns_of_a_square();
  for (std::size_t t = 1; t < turns.size(); ++t) {
    if (!std::all_of(kind.begin(), kind.end(), [&](std::size_t k) { return has_symmetry(k, turns[t]); })) continue;
    const auto of_circles = images(circle, kind, middle_, turns[t]);
    if (!of_circles) continue;
    if (auto image = images_of_bodies(*of_circles, motion, turns[t]))
      symmetry_.push_back({turns[t], std::move(*image)});
  }
  choose();
}

// The first body of those that come to each other's places is solved.
void SolvedMotions::choose() {
  const std::size_t bodies = symmetry_.front().image.size();
  constexpr std::size_t none = -1;
  from_.assign(bodies, {none, 0});
  column_.clear();
  std::size_t solved = 0;
  for (std::size_t b = 0; b < bodies; ++b) {
    if (from_[b].symmetry != none) continue;
    for (std::size_t s = symmetry_.size(); s-- > 0;) from_[symmetry_[s].image[b]] = {s, solved};
    ++solved;
    for (Index mode = 0; mode < 6; ++mode) column_.push_back(6 * static_cast<Index>(b) + mode);
  }
}

// Loads of the image of a motion are the images of its loads: L_{g(a), g(b)} = T L_ab Tᵀ.
MatrixXcd SolvedMotions::loads(const MatrixXcd& solved) const {
  MatrixXcd out(solved.rows(), solved.rows());
  for (std::size_t b = 0; b < from_.size(); ++b) {
    const Symmetry& g = symmetry_[from_[b].symmetry];
    const Matrix6 T = g.modes();
    for (std::size_t a = 0; a < from_.size(); ++a)
      out.block<6, 6>(6 * static_cast<Index>(g.image[a]), 6 * static_cast<Index>(b)) =
          T * solved.block<6, 6>(6 * static_cast<Index>(a), 6 * static_cast<Index>(from_[b].solved)) * T.transpose();
  }
  return out;
}

// About the middle f_g(θ) = f(g⁻¹θ) Tᵀ; about the origin both have the phase of the way to the middle.
MatrixXcd SolvedMotions::far_field(const std::vector<double>& angle, double k,
                                   const std::function<MatrixXcd(const std::vector<double>&)>& of_solved) const {
  const auto count = static_cast<Index>(angle.size());
  MatrixXcd out(count, 6 * static_cast<Index>(from_.size()));
  for (std::size_t s = 0; s < symmetry_.size(); ++s) {
    const Symmetry& g = symmetry_[s];
    std::vector<double> from;
    for (const double theta : angle) from.push_back(turned_back(g.turn, theta));
    MatrixXcd f = of_solved(from);
    for (Index t = 0; t < count; ++t) {
      const double theta = angle[static_cast<std::size_t>(t)], back = from[static_cast<std::size_t>(t)];
      const Vector2d change(std::cos(theta) - std::cos(back), std::sin(theta) - std::sin(back));
      f.row(t) *= std::polar(1.0, k * middle_.dot(change));
    }
    for (std::size_t b = 0; b < from_.size(); ++b)
      if (from_[b].symmetry == s)
        out.middleCols<6>(6 * static_cast<Index>(b)) =
            f.middleCols<6>(6 * static_cast<Index>(from_[b].solved)) * g.modes().transpose();
  }
  return out;
}

}  // namespace hydro::cylinders
