#include "hydro/radiation/excitation_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "polygon.hpp"

namespace hydro::radiation {
namespace {

using std::numbers::pi;

void check(const ExcitationTable& table, double step, double length) {
  require(!table.omega.empty() && table.omega.size() == table.X.size(), "the excitation table is empty or ragged");
  require(table.omega.front() > 0, "excitation is given at {} rad/s; frequencies must be positive",
          table.omega.front());
  double widest = table.omega.front();
  for (std::size_t i = 1; i < table.omega.size(); ++i) {
    require(table.omega[i] > table.omega[i - 1], "excitation frequencies do not increase at {} rad/s", table.omega[i]);
    require(table.X[i].size() == table.X.front().size(), "excitation has {} loads at {} rad/s and {} at the first",
            table.X[i].size(), table.omega[i], table.X.front().size());
    widest = std::max(widest, table.omega[i] - table.omega[i - 1]);
  }
  require(step > 0 && length >= step, "an impulse response needs a positive step and a length, got {} s and {} s", step,
          length);
  require(length <= pi / widest * (1 + 1e-9),
          "{} s to either side are asked for, but frequencies {} rad/s apart tell {} s", length, widest, pi / widest);
}

}  // namespace

ExcitationKernel::ExcitationKernel(const ExcitationTable& table, double step, double length) : step_(step), reach_(0) {
  check(table, step, length);
  reach_ = static_cast<std::size_t>(std::floor(length / step + 1e-9));
  const detail::Polygon polygon(table.omega);
  const Eigen::VectorXcd& first = table.X.front();
  f_.resize(first.size(), static_cast<Eigen::Index>(samples()));
  const double last = table.omega.back();
  for (std::size_t s = 0; s < samples(); ++s) {
    const double t = (static_cast<double>(s) - static_cast<double>(reach_)) * step;
    // The polygon begins at nothing, so the first value is taken off, and its integral to the end added by hand.
    const auto even = polygon.gather([t](double a, double b) { return detail::oscillating_weights(a, b, t, 0); });
    const auto odd = polygon.gather([t](double a, double b) { return detail::oscillating_weights(a, b, t, pi / 2); });
    const auto flat_even = detail::oscillating_weights(0, last, t, 0),
               flat_odd = detail::oscillating_weights(0, last, t, pi / 2);
    Eigen::VectorXd sum = (flat_even.a + flat_even.b) * first.real() - (flat_odd.a + flat_odd.b) * first.imag();
    for (std::size_t j = 0; j < even.size(); ++j)
      sum += even[j] * (table.X[j] - first).real() - odd[j] * (table.X[j] - first).imag();
    f_.col(static_cast<Eigen::Index>(s)) = sum / pi;
  }
  missing_ = table.X.back().cwiseAbs() * last / pi;
}

Eigen::VectorXd ExcitationKernel::load(const std::vector<double>& elevation, std::size_t n) const {
  require(n < elevation.size(), "a load is asked for at sample {}, the elevation has {}", n, elevation.size());
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(f_.rows());
  for (std::size_t s = 0; s < samples(); ++s) {
    // τ = (s − reach) h, η(t − τ): sample n + reach − s.
    if (n + reach_ < s || n + reach_ - s >= elevation.size()) continue;
    const double end = s == 0 || s + 1 == samples() ? 0.5 : 1;
    sum += end * elevation[n + reach_ - s] * f_.col(static_cast<Eigen::Index>(s));
  }
  return step_ * sum;
}

}  // namespace hydro::radiation
