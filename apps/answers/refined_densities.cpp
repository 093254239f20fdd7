#include "answers/refined_densities.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hydro/base/error.hpp"

namespace froude {

RefinedDensities::RefinedDensities(const std::vector<double>& omega, double tolerance, const At& at)
    : tolerance_(tolerance), columns_(at(omega)) {
  std::vector<double> lower_ends(omega.begin(), omega.end() - 1);
  constexpr int most = 24;  // halvings: a peak a millionth as wide as the spacing asked for is found
  for (int round = 0; !lower_ends.empty(); ++round) {
    if (round == most)
      throw hydro::NumericsError(fmt::format(
          "a response near {:.6g} rad/s is too sharp: its spectrum changes by more than the accuracy asked, {:g}, "
          "however closely frequencies stand; a motion without damping has no spectrum",
          lower_ends.front(), tolerance_));
    lower_ends = halve(lower_ends, at);
  }
}

std::vector<double> RefinedDensities::omega() const {
  std::vector<double> out;
  for (const Column& c : columns_) out.push_back(c.omega);
  return out;
}

hydro::signal::SpectrumPerHz RefinedDensities::spectrum(Eigen::Index row) const {
  hydro::signal::SpectrumPerRadS out;
  for (const Column& c : columns_) {
    out.omega.push_back(c.omega);
    out.density.push_back(c.density(row));
  }
  return hydro::signal::per_hz(out);
}

Eigen::VectorXd RefinedDensities::moment(int order) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(columns_.front().density.size());
  const auto integrand = [&](const Column& c) { return Eigen::VectorXd(std::pow(c.omega, order) * c.density); };
  for (std::size_t i = 0; i + 1 < columns_.size(); ++i)
    sum += (integrand(columns_[i]) + integrand(columns_[i + 1])) / 2 * (columns_[i + 1].omega - columns_[i].omega);
  return sum;
}

/// Puts a frequency into the middle of each of these intervals. \return the lower ends of those halves that have to
/// be halved again: by Simpson's rule their share of the error is above that of their width
std::vector<double> RefinedDensities::halve(const std::vector<double>& lower_ends, const At& at) {
  std::vector<std::size_t> intervals;
  std::vector<double> middles;
  for (std::size_t i = 0, next = 0; i + 1 < columns_.size() && next < lower_ends.size(); ++i)
    if (columns_[i].omega == lower_ends[next]) {
      intervals.push_back(i);
      middles.push_back((columns_[i].omega + columns_[i + 1].omega) / 2);
      ++next;
    }
  const std::vector<Column> found = at(middles);
  const double range = columns_.back().omega - columns_.front().omega;
  const std::array orders{0, 2, 4};
  std::array<Eigen::VectorXd, 3> moments;
  for (std::size_t n = 0; n < orders.size(); ++n) moments[n] = moment(orders[n]);
  std::vector<double> again;
  for (std::size_t k = 0; k < intervals.size(); ++k) {
    const Column &low = columns_[intervals[k]], &high = columns_[intervals[k] + 1], &middle = found[k];
    const double width = high.omega - low.omega;
    double worst = 0;
    for (std::size_t n = 0; n < orders.size(); ++n) {
      const auto power = [&](double omega) { return std::pow(omega, orders[n]); };
      const Eigen::VectorXd bend = power(middle.omega) * middle.density -
                                   (power(low.omega) * low.density + power(high.omega) * high.density) / 2;
      for (Eigen::Index row = 0; row < bend.size(); ++row)
        if (moments[n](row) > 0) worst = std::max(worst, std::abs(bend(row)) * width * (2.0 / 3) / moments[n](row));
    }
    // A middle that is put in leaves a quarter of the error of a smooth density.
    if (worst > tolerance_ * width / range) {
      again.push_back(low.omega);
      again.push_back(middle.omega);
    } else {
      error_ += worst / 4;
    }
  }
  for (const Column& c : found) columns_.push_back(c);
  std::sort(columns_.begin(), columns_.end(), [](const Column& a, const Column& b) { return a.omega < b.omega; });
  return again;
}

double largest_change(const Eigen::VectorXd& before, const Eigen::VectorXd& now) {
  double out = 0;
  for (Eigen::Index i = 0; i < now.size(); ++i)
    if (now(i) > 0) out = std::max(out, std::abs(now(i) - before(i)) / now(i));
  return out;
}

}  // namespace froude
