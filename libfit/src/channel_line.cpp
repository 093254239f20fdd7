#include "fit/channel_line.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

#include "fit/parts.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"

namespace fit {
namespace {

double spread_of(const std::vector<double>& v) {
  const auto [low, high] = std::minmax_element(v.begin(), v.end());
  return *high - *low;
}

void check(const LinePoints& p) {
  const std::size_t n = p.reference.size(), least = p.time.empty() ? 3 : 4;
  hydro::require(p.reading.size() == n && (p.time.empty() || p.time.size() == n),
                 "there are {} references, {} readings and {} times", n, p.reading.size(), p.time.size());
  hydro::require(n >= least, "a line{} needs {} points at least, got {}", p.time.empty() ? "" : " with a drift", least,
                 n);
  for (std::size_t i = 0; i < n; ++i) {
    hydro::require(std::isfinite(p.reference[i]) && std::isfinite(p.reading[i]), "point {} is not finite", i + 1);
    hydro::require(p.time.empty() || i == 0 || p.time[i] > p.time[i - 1], "time does not increase at point {}", i + 1);
  }
  hydro::require(spread_of(p.reference) > 0, "all references are {}: a line needs two at least", p.reference[0]);
  hydro::require(spread_of(p.reading) > 0, "the reading is {} throughout: the channel gave no signal", p.reading[0]);
}

Eigen::MatrixXd columns_of(const LinePoints& p) {
  const auto n = std::ssize(p.reference);
  Eigen::MatrixXd out(n, p.time.empty() ? 2 : 3);
  out.col(0).setOnes();
  out.col(1) = Eigen::Map<const Eigen::VectorXd>(p.reference.data(), n);
  if (p.time.empty()) return out;
  const Eigen::VectorXd t = Eigen::Map<const Eigen::VectorXd>(p.time.data(), n);
  out.col(2) = t.array() - t.mean();
  return out;
}

/// Readings at one reference on the way up and down; their difference is looked at, residuals so that a drift is not
/// taken for it.
void add_hysteresis(const LinePoints& p, ChannelLine& out) {
  const double equal = 1e-6 * spread_of(p.reference);
  std::vector<std::size_t> up, down;
  for (std::size_t i = 0; i < p.reference.size(); ++i) {
    // The first point belongs to the branch that begins there.
    const double step = i == 0 ? p.reference[1] - p.reference[0] : p.reference[i] - p.reference[i - 1];
    if (std::abs(step) <= equal) continue;
    (step > 0 ? up : down).push_back(i);
  }
  double largest = 0;
  for (const std::size_t a : up)
    for (const std::size_t b : down)
      if (std::abs(p.reference[a] - p.reference[b]) <= equal) {
        ++out.pairs;
        largest = std::max(largest, std::abs(out.residuals[a] - out.residuals[b]));
      }
  if (out.pairs > 0) out.hysteresis = largest / out.range;
}

}  // namespace

double ChannelLine::reference(double reading) const { return (reading - *offset.value) / *slope.value; }

ChannelLine fit_channel_line(const LinePoints& p, double confidence) {  // (F100)
  check(p);
  const Eigen::MatrixXd columns = columns_of(p);
  const Eigen::VectorXd scale = columns.colwise().norm().transpose();
  hydro::require((scale.array() > 0).all(), "all times are the same");
  const Eigen::MatrixXd scaled = columns * scale.cwiseInverse().asDiagonal();
  const hydro::dense::PivotedQr qr(scaled);
  hydro::require(qr.rank() == columns.cols(),
                 "references and times go together: a drift cannot be told from the slope, take points up and down");
  const Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(p.reading.data(), std::ssize(p.reading)),
                        x = qr.solve(y).cwiseQuotient(scale), left = y - columns * x;
  const auto dof = static_cast<double>(columns.rows() - columns.cols());
  const double deviation = std::sqrt(left.squaredNorm() / dof),
               t = hydro::signal::student_t_quantile((1 + confidence) / 2, dof);
  const Eigen::VectorXd error =
      deviation * hydro::dense::inverse(scaled.transpose() * scaled).diagonal().cwiseSqrt().cwiseQuotient(scale);
  ChannelLine out{.slope = with_parts("slope", x[1], error[1], t, 0, confidence),
                  .offset = with_parts("offset", x[0], error[0], t, 0, confidence),
                  .drift = {},
                  .residual_deviation = deviation,
                  .nonlinearity = 0,
                  .hysteresis = {},
                  .pairs = 0,
                  .steps = find_quantisation(p.reading),
                  .range = spread_of(p.reading),
                  .residuals = {left.begin(), left.end()}};
  if (out.slope.interval.low <= 0 && out.slope.interval.high >= 0)
    throw hydro::InputError(
        fmt::format("the readings do not tell the references: the slope is {:.4g}, and its {:g} % interval, {:.4g} to "
                    "{:.4g}, holds zero",
                    x[1], 100 * confidence, out.slope.interval.low, out.slope.interval.high),
        {}, "look whether the columns belong together, or take more points");
  out.nonlinearity = left.cwiseAbs().maxCoeff() / out.range;
  add_hysteresis(p, out);
  if (columns.cols() < 3) return out;
  out.drift = with_parts("drift", x[2], error[2], t, 0, confidence);
  if (out.drift->interval.low <= 0 && out.drift->interval.high >= 0) {
    out.drift->value.reset();
    out.drift->why_not = "it cannot be told from none";
  }
  return out;
}

}  // namespace fit
