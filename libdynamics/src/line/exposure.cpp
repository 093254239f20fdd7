#include "dynamics/line/exposure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/interpolation.hpp"

namespace dynamics::line {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using hydro::require;

/// Sums of squares of velocity and acceleration across an axis.
struct Squares {
  Vector3d axis;
  Matrix3d velocity = Matrix3d::Zero(), acceleration = Matrix3d::Zero();

  void add(const hydro::waves::Kinematics& k) {
    const Vector3d u = k.velocity - axis * axis.dot(k.velocity), a = k.acceleration - axis * axis.dot(k.acceleration);
    velocity += u * u.transpose();
    acceleration += a * a.transpose();
  }
};

// (D104)
Exposure exposure_of(const Squares& s, int instants) {
  const auto [squares, axes] = hydro::dense::symmetric_eigen(s.velocity / instants);
  const Vector3d most = axes.col(2);
  const double velocity = std::sqrt(std::max(squares[2], 0.0)),
               acceleration = std::sqrt(most.dot(s.acceleration * most) / instants);
  return {std::numbers::sqrt2 * velocity, 2 * std::numbers::pi * velocity / acceleration};
}

/// The values of one column that occur, in order.
template <class Column>
std::vector<double> values_of(const std::vector<CoefficientTable::Row>& rows, Column column) {
  std::vector<double> out;
  for (const auto& row : rows) out.push_back(column(row));
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::size_t place_in(const std::vector<double>& sorted, double value) {
  return static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
}

hydro::Stencil logarithmic(const std::vector<double>& x, double at, const char* name) {
  require(at >= x.front() && at <= x.back(), "{} is {:.4g}, and the table goes from {:.4g} to {:.4g}", name, at,
          x.front(), x.back());
  std::vector<double> log_x;
  for (const double v : x) log_x.push_back(std::log(v));
  return hydro::straight_stencil(log_x, std::log(at));
}

}  // namespace

std::vector<Exposure> exposure(const hydro::waves::WaveField& field, const Places& places, double from_s, double to_s,
                               int instants) {
  require(to_s > from_s && instants > 0, "water is looked at over a time above 0, got {} to {} s", from_s, to_s);
  const auto segments = static_cast<std::size_t>(places.cols() - 1);
  std::vector<Vector3d> middle(segments);
  std::vector<Squares> squares(segments);
  for (std::size_t j = 0; j < segments; ++j) {
    const Vector3d first = places.col(static_cast<Eigen::Index>(j)),
                   second = places.col(static_cast<Eigen::Index>(j) + 1);
    middle[j] = (first + second) / 2;
    // A node that lies in the bed by its weight feels the water above it, as in (D74).
    middle[j].z() = std::max(middle[j].z(), -field.water().depth.metres());
    squares[j].axis = (second - first).normalized();
  }
  std::vector<hydro::waves::Kinematics> water(segments);
  for (int i = 0; i < instants; ++i) {
    const double t = from_s + (to_s - from_s) * (i + 0.5) / instants;
    field.at(t, middle, water);
    for (std::size_t j = 0; j < segments; ++j) {
      require(middle[j].z() <= water[j].elevation,
              "segment {} is above the water at t = {:.4g} s, where coefficients by KC are not known", j + 1, t);
      squares[j].add(water[j]);
    }
  }
  std::vector<Exposure> out;
  for (std::size_t j = 0; j < segments; ++j) {
    out.push_back(exposure_of(squares[j], instants));
    require(out.back().velocity > 0 && std::isfinite(out.back().period), "no water goes to and fro past segment {}",
            j + 1);
  }
  return out;
}

CoefficientTable::CoefficientTable(std::vector<Row> rows)
    : kc_(values_of(rows, [](const Row& r) { return r.kc; })), re_(values_of(rows, [](const Row& r) { return r.re; })) {
  require(kc_.size() >= 2, "a table of coefficients needs two values of KC or more, got {}", kc_.size());
  for (const Row& r : rows) {
    require(r.kc > 0 && r.re > 0, "KC and Re must be above 0, got {} and {}", r.kc, r.re);
    require(r.cd >= 0 && r.ca >= 0, "coefficients must not be negative, got {} and {} at KC = {}", r.cd, r.ca, r.kc);
  }
  std::vector<int> seen(kc_.size() * re_.size(), 0);
  grid_.resize(seen.size());
  for (const Row& r : rows) {
    const std::size_t at = place_in(kc_, r.kc) * re_.size() + place_in(re_, r.re);
    grid_[at] = {r.cd, r.ca};
    ++seen[at];
  }
  for (std::size_t at = 0; at < seen.size(); ++at)
    require(seen[at] == 1, "a table needs each pair of KC and Re once: KC = {:g}{} is there {} times",
            kc_[at / re_.size()], knows_reynolds() ? fmt::format(", Re = {:g}", re_[at % re_.size()]) : "", seen[at]);
}

// (D105)
CoefficientTable::Pair CoefficientTable::at(double kc, double re) const {
  const hydro::Stencil along = logarithmic(kc_, kc, "KC");
  const hydro::Stencil across = knows_reynolds() ? logarithmic(re_, re, "Re") : hydro::Stencil{0, {1}};
  Pair out{0, 0};
  for (std::size_t i = 0; i < along.weight.size(); ++i)
    for (std::size_t k = 0; k < across.weight.size(); ++k) {
      const double weight = along.weight[i] * across.weight[k];
      if (weight == 0) continue;
      const Pair& p = grid_[(along.first + i) * re_.size() + across.first + k];
      out.cd += weight * p.cd;
      out.ca += weight * p.ca;
    }
  return out;
}

}  // namespace dynamics::line
