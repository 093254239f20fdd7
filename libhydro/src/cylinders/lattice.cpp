#include "lattice.hpp"

#include <fftw3.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>

#include "signal/planner.hpp"

namespace hydro::cylinders {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::Vector2d;

constexpr double same_place = 1e-9;          // of a radius: what rounding leaves of places that are computed
constexpr double typical_order = 3;          // of the waves between cylinders that stand apart, to compare lattices by
constexpr std::size_t most_candidates = 12;  // for the sides of a cell

double smallest_radius(const std::vector<Cylinder>& cylinders) {
  const auto less = [](const Cylinder& a, const Cylinder& b) { return a.radius < b.radius; };
  return std::min_element(cylinders.begin(), cylinders.end(), less)->radius;
}

/// The ways from the first cylinder to others that lead most cylinders to an equal one, the best first.
std::vector<Vector2d> likely_steps(const std::vector<Cylinder>& cylinders) {
  const double grain = 1e-3 * smallest_radius(cylinders);
  const Vector2d origin = cylinders.front().centre;
  const auto key = [&](const Vector2d& p, double radius) {
    return std::tuple(std::llround((p - origin).x() / grain), std::llround((p - origin).y() / grain), radius);
  };
  std::map<std::tuple<long long, long long, double>, int> at;
  for (const Cylinder& c : cylinders) ++at[key(c.centre, c.radius)];
  std::vector<std::pair<std::size_t, Vector2d>> found;
  for (std::size_t j = 1; j < cylinders.size(); ++j) {
    const Vector2d way = cylinders[j].centre - origin;
    std::size_t led = 0;
    for (const Cylinder& c : cylinders) led += at.count(key(c.centre + way, c.radius));
    found.emplace_back(led, way);
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second.squaredNorm() < b.second.squaredNorm();
  });
  std::vector<Vector2d> steps;
  for (const auto& [led, way] : found)
    if (steps.size() < most_candidates) steps.push_back(way);
  return steps;
}

/// Cells with these sides, if few kinds of cylinders fill them.
std::optional<Lattice> with_sides(const std::vector<Cylinder>& cylinders, const Eigen::Matrix2d& sides) {
  const Eigen::Matrix2d inverse = sides.inverse();
  const double off = same_place * smallest_radius(cylinders);
  std::vector<const Cylinder*> kinds;
  Lattice out;
  Eigen::Array2i first = Eigen::Array2i::Zero(), last = first;
  for (const Cylinder& c : cylinders) {
    std::size_t kind = 0;
    Vector2d cell = Vector2d::Zero();
    for (; kind < kinds.size(); ++kind) {
      const Vector2d way = c.centre - kinds[kind]->centre;
      cell = (inverse * way).array().round();
      if (c.radius == kinds[kind]->radius && (sides * cell - way).norm() <= off) break;
    }
    if (kind == kinds.size()) {
      if (4 * kinds.size() > cylinders.size()) return {};
      kinds.push_back(&c);
      cell.setZero();
    }
    const Eigen::Array2i at = cell.array().cast<int>();
    first = first.min(at), last = last.max(at);
    out.site.push_back({kind, at.x(), at.y()});
  }
  for (Lattice::Site& site : out.site) site.row -= first.x(), site.column -= first.y();
  out.kinds = kinds.size();
  out.rows = last.x() - first.x() + 1;
  out.columns = last.y() - first.y() + 1;
  return out;
}

/// At least so many that a circular convolution does not reach around; a product of 2, 3 and 5.
Index padded(Index cells) {
  const auto is_smooth = [](Index n) {
    for (const Index factor : {2, 3, 5})
      while (n % factor == 0) n /= factor;
    return n == 1;
  };
  Index n = 2 * cells - 1;
  while (!is_smooth(n)) ++n;
  return n;
}

}  // namespace

double Lattice::work(double order) const {
  constexpr double transform = 2.5;  // there and back, multiplications a number and doubling
  const double cells = static_cast<double>(padded(rows) * padded(columns));
  const double channels = static_cast<double>(kinds) * (2 * order + 1);
  return cells * channels * (channels + transform * std::log2(cells));
}

std::optional<Lattice> find_lattice(const std::vector<Cylinder>& cylinders) {
  const double pairs = std::pow(static_cast<double>(cylinders.size()) * (2 * typical_order + 1), 2);
  std::optional<Lattice> best;
  const auto consider = [&](const Vector2d& one, const Vector2d& other) {
    const Eigen::Matrix2d sides = (Eigen::Matrix2d() << one, other).finished();
    if (std::abs(sides.determinant()) < 1e-6 * one.norm() * other.norm()) return;
    const auto lattice = with_sides(cylinders, sides);
    if (lattice && lattice->work(typical_order) < (best ? best->work(typical_order) : pairs)) best = lattice;
  };
  double extent = 0;
  for (const Cylinder& c : cylinders) extent = std::max(extent, (c.centre - cylinders.front().centre).norm());
  const auto steps = likely_steps(cylinders);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Vector2d across = 4 * extent * Vector2d(-steps[i].y(), steps[i].x()).normalized();
    consider(steps[i], across);  // a row: nothing lies a step across
    for (std::size_t j = 0; j < i; ++j) consider(steps[i], steps[j]);
  }
  return best;
}

LatticePassage::LatticePassage(const Lattice& lattice, int order)
    : lattice_(lattice),
      order_(order),
      padded_rows_(padded(lattice.rows)),
      padded_columns_(padded(lattice.columns)),
      kernel_(static_cast<std::size_t>(cells() * channels() * channels())) {}

void LatticePassage::set(std::size_t to_kind, std::size_t from_kind, Index row, Index column, const MatrixXcd& G) {
  const Index cell =
      (row + padded_rows_) % padded_rows_ * padded_columns_ + (column + padded_columns_) % padded_columns_;
  Eigen::Map<MatrixXcd> kernel(kernel_.data() + cell * channels() * channels(), channels(), channels());
  const Index middle = order_ - G.rows() / 2;
  kernel.block(static_cast<Index>(to_kind) * orders() + middle, static_cast<Index>(from_kind) * orders() + middle,
               G.rows(), G.cols()) = G;
}

void LatticePassage::transform() { transform(kernel_, channels() * channels(), FFTW_FORWARD); }

void LatticePassage::transform(std::vector<Complex>& grid, Index width, int sign) const {
  const std::array<int, 2> size{static_cast<int>(padded_rows_), static_cast<int>(padded_columns_)};
  auto* data = reinterpret_cast<fftw_complex*>(grid.data());
  signal::Plan plan;
  {
    const std::lock_guard lock(signal::planner());
    plan.reset(fftw_plan_many_dft(2, size.data(), static_cast<int>(width), data, nullptr, static_cast<int>(width), 1,
                                  data, nullptr, static_cast<int>(width), 1, sign, FFTW_ESTIMATE));
  }
  fftw_execute(plan.get());
}

void LatticePassage::add(const WaveIndex& index, const Amplitudes& b, Amplitudes& a) const {
  const Index things = b.cols(), width = channels() * things;
  std::vector<Complex> grid(static_cast<std::size_t>(cells() * width));
  const auto at_site = [&](std::size_t cylinder) {
    const Lattice::Site& site = lattice_.site[cylinder];
    const Index cell = site.row * padded_columns_ + site.column;
    Complex* first = grid.data() + cell * width + static_cast<Index>(site.kind) * orders() * things;
    return Eigen::Map<Amplitudes>(first, orders(), things);
  };
  for (std::size_t c = 0; c < lattice_.site.size(); ++c) at_site(c) = b.middleRows(index(c, 0, -order_), orders());
  transform(grid, width, FFTW_FORWARD);
  Amplitudes passed(channels(), things);
  for (Index cell = 0; cell < cells(); ++cell) {
    const Eigen::Map<const MatrixXcd> kernel(kernel_.data() + cell * channels() * channels(), channels(), channels());
    Eigen::Map<Amplitudes> waves(grid.data() + cell * width, channels(), things);
    passed.noalias() = kernel * waves;
    waves = passed;
  }
  transform(grid, width, FFTW_BACKWARD);
  for (std::size_t c = 0; c < lattice_.site.size(); ++c)
    a.middleRows(index(c, 0, -order_), orders()) += at_site(c) / static_cast<double>(cells());
}

}  // namespace hydro::cylinders
