#include "hydro/potential/operations/operations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hydro/base/interpolation.hpp"
#include "hydro/potential/operations/headings.hpp"
#include "hydro/waves/dispersion.hpp"
#include "potential/modes.hpp"

namespace hydro::potential {
std::complex<double> way(double k, double heading, double x, double y) {
  return std::polar(1.0, -k * (x * std::cos(heading) + y * std::sin(heading)));
}

std::vector<Eigen::MatrixXcd> turned_by_way(const Coefficients& c, const std::vector<Eigen::Vector3d>& place,
                                            double sign) {
  std::vector<Eigen::MatrixXcd> X = c.X;
  for (std::size_t w = 0; w < c.omega.size(); ++w) {
    const double k = waves::wavenumber(c.omega[w], c.water);
    for (std::size_t h = 0; h < X.size(); ++h)
      for (std::size_t b = 0; b < place.size(); ++b)
        X[h].col(static_cast<Eigen::Index>(w)).segment<6>(6 * static_cast<Eigen::Index>(b)) *=
            way(sign * k, c.heading[h], place[b].x(), place[b].y());
  }
  return X;
}

Coefficients select(const Coefficients& all, std::span<const int> which) {
  Coefficients out = all;
  out.body.clear();
  std::vector<int> modes;
  for (const int b : which) {
    if (b < 0 || b >= all.bodies())
      throw InputError(fmt::format("{}: body {} is asked for, but there {} {}", all.source, b + 1,
                                   all.bodies() == 1 ? "is only" : "are only", all.bodies()));
    out.body.push_back(all.body[static_cast<std::size_t>(b)]);
    for (int m = 0; m < 6; ++m) modes.push_back(6 * b + m);
  }
  const auto cut = [&](Eigen::MatrixXd& m) { m = Eigen::MatrixXd(m(modes, modes)); };
  for_each_radiation_matrix(out, cut);
  if (out.C) cut(*out.C);
  for (auto& X : out.X) X = Eigen::MatrixXcd(X(modes, Eigen::all));
  return out;
}

Coefficients without_interaction(Coefficients c) {
  for_each_radiation_matrix(c, [&](Eigen::MatrixXd& m) {
    for (int i = 0; i < c.bodies(); ++i)
      for (int j = 0; j < c.bodies(); ++j)
        if (i != j) m.block<6, 6>(6 * i, 6 * j).setZero();
  });
  return c;
}

Coefficients about(Coefficients c, std::span<const Eigen::Vector3d> from, std::span<const Eigen::Vector3d> to) {
  require(from.size() == c.body.size() && to.size() == c.body.size(), "{}: {} reference points are given for {} bodies",
          c.source, std::min(from.size(), to.size()), c.bodies());
  // ξ(from) = T ξ(to), hence loads by Tᵀ and matrices by Tᵀ · T, a block of T a body. (P4)
  for (std::size_t i = 0; i < c.body.size(); ++i) {
    const auto at = 6 * static_cast<Eigen::Index>(i);
    const Matrix6 T = rigid_shift(from[i] - to[i]);
    const auto move = [&](Eigen::MatrixXd& m) {
      m.middleRows<6>(at) = (T.transpose() * m.middleRows<6>(at)).eval();
      m.middleCols<6>(at) = (m.middleCols<6>(at) * T).eval();
    };
    for_each_radiation_matrix(c, move);
    if (c.C) move(*c.C);
    for (auto& X : c.X) X.middleRows<6>(at) = (T.transpose().cast<std::complex<double>>() * X.middleRows<6>(at)).eval();
    c.body[i].reference_point = to[i];
  }
  return c;
}

Coefficients translated(Coefficients c, const Eigen::Vector2d& shift) {
  for (std::size_t w = 0; w < c.omega.size(); ++w) {
    const double k = waves::wavenumber(c.omega[w], c.water);
    for (std::size_t h = 0; h < c.heading.size(); ++h)
      c.X[h].col(static_cast<Eigen::Index>(w)) *= way(k, c.heading[h], shift.x(), shift.y());
  }
  const Eigen::Vector3d d(shift.x(), shift.y(), 0);
  for (auto& b : c.body) {
    if (b.reference_point) *b.reference_point += d;
    if (b.centre_of_gravity) *b.centre_of_gravity += d;
    if (b.centre_of_buoyancy) *b.centre_of_buoyancy += d;
  }
  return c;
}

FrequencyTable::FrequencyTable(Coefficients c, std::vector<Eigen::Vector3d> origin)
    : c_(std::move(c)), origin_(std::move(origin)) {
  c_.validate();
  require(origin_.size() == c_.body.size(), "{}: {} places are given for {} bodies", c_.source, origin_.size(),
          c_.bodies());
  X_ = turned_by_way(c_, origin_, -1);
}

namespace {
void require_inside(const Coefficients& c, double omega) {
  // A frequency computed from a period may miss the table's end by round-off.
  constexpr double slack = 1e-9;
  if (omega >= c.omega.front() * (1 - slack) && omega <= c.omega.back() * (1 + slack)) return;
  throw InputError(
      fmt::format(
          "{}: coefficients are asked for at {:.6g} rad/s (period {:.6g} s), but given from {:.6g} to {:.6g} rad/s "
          "(periods {:.6g} to {:.6g} s)",
          c.source, omega, 2 * std::numbers::pi / omega, c.omega.front(), c.omega.back(),
          2 * std::numbers::pi / c.omega.back(), 2 * std::numbers::pi / c.omega.front()),
      {}, "ask for periods inside the data, or compute the coefficients at more frequencies");
}

[[noreturn]] void refuse_heading(const Coefficients& c, double heading) {
  const auto degrees = [](double angle) { return angle * 180 / std::numbers::pi; };
  throw InputError(
      fmt::format("{}: heading {:.6g} deg is asked for, but excitation is given from {:.6g} to {:.6g} deg", c.source,
                  degrees(heading), degrees(c.heading.front()), degrees(c.heading.back())),
      {},
      "choose headings inside the data; or compute the excitation for this one too: `headings` in "
      "[body.hydrodynamics.cylinders] or beside `mesh`, --headings of `froude bem solve`; or mirror that of symmetric "
      "bodies: `froude bem convert --symmetric`");
}
}  // namespace

Eigen::MatrixXd FrequencyTable::added_mass(double omega) const {
  require_inside(c_, omega);
  return combined(cubic_stencil(c_.omega, omega), c_.omega.size(),
                  [&](std::size_t i) -> const Eigen::MatrixXd& { return c_.A[i]; });
}

Eigen::MatrixXd FrequencyTable::damping(double omega) const {
  require_inside(c_, omega);
  return combined(cubic_stencil(c_.omega, omega), c_.omega.size(),
                  [&](std::size_t i) -> const Eigen::MatrixXd& { return c_.B[i]; });
}

Eigen::MatrixXd FrequencyTable::added_mass_from_zero(double omega) const {
  if (omega >= lowest()) return added_mass(omega);
  if (!c_.A_zero) return c_.A.front();
  const double share = omega / lowest();
  return (1 - share) * *c_.A_zero + share * c_.A.front();
}

Eigen::MatrixXd FrequencyTable::damping_from_zero(double omega) const {
  return omega >= lowest() ? damping(omega) : Eigen::MatrixXd(omega / lowest() * c_.B.front());
}

Eigen::VectorXcd FrequencyTable::excitation(double omega, double heading) const {
  require_inside(c_, omega);
  if (c_.heading.empty())
    throw InputError(fmt::format("{}: there is no excitation in the data", c_.source), {},
                     "put the .3 file beside the .1 file, or leave out `excitation`");
  const auto between = between_headings(c_.heading, heading);
  if (!between) refuse_heading(c_, heading);
  const Stencil by_omega = cubic_stencil(c_.omega, omega);
  const auto at = [&](std::size_t h) {
    return Eigen::VectorXcd(
        combined(by_omega, c_.omega.size(), [&](std::size_t w) { return X_[h].col(static_cast<Eigen::Index>(w)); }));
  };
  Eigen::VectorXcd X = at(between->first);
  if (between->share != 0) X += between->share * (at(between->second) - X);
  const double k = waves::wavenumber(omega, c_.water);
  for (std::size_t b = 0; b < origin_.size(); ++b)
    X.segment<6>(6 * static_cast<Eigen::Index>(b)) *= way(k, heading, origin_[b].x(), origin_[b].y());
  return X;
}

namespace {

/// True where a mode has a part, of all that have its unit: what is a millionth of the largest is rounding of solvers
/// and of files with seven digits, where symmetry leaves nothing.
std::vector<bool> modes_with_a_part(const Eigen::VectorXd& size) {
  constexpr double rounding = 1e-6;
  std::array<double, 2> largest{};  // of forces and of moments
  const auto unit = [](Eigen::Index r) { return static_cast<std::size_t>(r % 6 / 3); };
  for (Eigen::Index r = 0; r < size.size(); ++r) largest[unit(r)] = std::max(largest[unit(r)], size[r]);
  std::vector<bool> out;
  for (Eigen::Index r = 0; r < size.size(); ++r) out.push_back(size[r] > rounding * largest[unit(r)]);
  return out;
}

}  // namespace

/// `gap(i, value)` is a matrix of differences near frequency i, for i = 0 … Nω − 1, or an empty one.
template <class Gap>
FrequencyTable::InterpolationError FrequencyTable::largest(Gap gap) const {
  const auto worst = [&](auto value) {
    double largest_gap = 0;
    Eigen::VectorXd size = value(0).cwiseAbs().rowwise().maxCoeff();
    for (std::size_t i = 1; i < c_.omega.size(); ++i)
      size = size.cwiseMax(Eigen::VectorXd(value(i).cwiseAbs().rowwise().maxCoeff()));
    const std::vector<bool> has_part = modes_with_a_part(size);
    for (std::size_t i = 0; i < c_.omega.size(); ++i) {
      const Eigen::MatrixXd difference = gap(i, value);
      for (Eigen::Index r = 0; r < difference.rows(); ++r)
        if (has_part[static_cast<std::size_t>(r)])
          largest_gap = std::max(largest_gap, difference.row(r).maxCoeff() / size[r]);
    }
    return largest_gap;
  };
  InterpolationError out{};
  out.added_mass = worst([&](std::size_t i) -> const Eigen::MatrixXd& { return c_.A[i]; });
  out.damping = worst([&](std::size_t i) -> const Eigen::MatrixXd& { return c_.B[i]; });
  for (const auto& X : X_)
    out.excitation = std::max(
        out.excitation, worst([&](std::size_t i) { return Eigen::MatrixXcd(X.col(static_cast<Eigen::Index>(i))); }));
  return out;
}

FrequencyTable::InterpolationError FrequencyTable::interpolation_error() const {
  return largest([&](std::size_t i, auto value) -> Eigen::MatrixXd {
    if (i + 1 >= c_.omega.size()) return {};
    const double middle = (c_.omega[i] + c_.omega[i + 1]) / 2;
    return (combined(cubic_stencil(c_.omega, middle), c_.omega.size(), value) -
            combined(straight_stencil(c_.omega, middle), c_.omega.size(), value))
        .cwiseAbs();
  });
}

FrequencyTable::InterpolationError FrequencyTable::error_with_twice_the_spacing() const {
  return largest([&](std::size_t i, auto value) -> Eigen::MatrixXd {
    if (i == 0 || i + 1 >= c_.omega.size()) return {};
    // Two neighbours on either side, as far as there are any, make the cubic where `i` is missing.
    std::vector<std::size_t> neighbour;
    for (std::size_t j = i >= 2 ? i - 2 : 0; j <= std::min(i + 2, c_.omega.size() - 1); ++j)
      if (j != i) neighbour.push_back(j);
    const std::vector<double> omega = [&] {
      std::vector<double> at;
      for (const std::size_t j : neighbour) at.push_back(c_.omega[j]);
      return at;
    }();
    const auto without =
        combined(cubic_stencil(omega, c_.omega[i]), omega.size(), [&](std::size_t j) { return value(neighbour[j]); });
    return (without - value(i)).cwiseAbs();
  });
}

Resampled resampled(const Coefficients& c, std::span<const double> omega) {
  std::vector<Eigen::Vector3d> origin;
  for (const BodyData& body : c.body) origin.push_back(body.reference_point.value_or(Eigen::Vector3d::Zero()));
  const FrequencyTable table(c, origin);
  Resampled out{c, table.error_with_twice_the_spacing()};
  for (double* error : {&out.error.added_mass, &out.error.damping, &out.error.excitation}) *error /= 2;  // (P32)
  Coefficients& r = out.coefficients;
  r.omega.assign(omega.begin(), omega.end());
  r.A.clear();
  r.B.clear();
  for (auto& X : r.X) X = Eigen::MatrixXcd(X.rows(), static_cast<Eigen::Index>(omega.size()));
  for (std::size_t k = 0; k < omega.size(); ++k) {
    r.A.push_back(table.added_mass(omega[k]));
    r.B.push_back(table.damping(omega[k]));
    for (std::size_t h = 0; h < r.X.size(); ++h)
      r.X[h].col(static_cast<Eigen::Index>(k)) = table.excitation(omega[k], r.heading[h]);
  }
  r.notes.push_back(
      fmt::format("interpolated to {} frequencies from {}; estimated error, relative to the largest of each mode: "
                  "A {:.2g}, B {:.2g}, X {:.2g}",
                  omega.size(), c.omega.size(), out.error.added_mass, out.error.damping, out.error.excitation));
  r.validate();
  return out;
}

}  // namespace hydro::potential
