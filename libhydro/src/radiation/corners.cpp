#include "corners.hpp"

#include <limits>

namespace hydro::radiation::detail {

// From the last place that was kept, each place seen since leaves a range of slopes that pass it by no more than is
// allowed; where the next place lies outside, the one before it is needed.
Corners Corners::needed(double share) const {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const Eigen::ArrayXd allowed = share * value.cwiseAbs().colwise().maxCoeff().transpose().array();
  std::vector<Eigen::Index> kept{0};
  Eigen::ArrayXd low = Eigen::ArrayXd::Constant(value.cols(), -infinite), high = -low;
  const auto slope = [&](Eigen::Index from, Eigen::Index to) {
    return Eigen::ArrayXd((value.row(to) - value.row(from)).transpose().array() / (at[to] - at[from]));
  };
  for (Eigen::Index i = 1; i < at.size(); ++i) {
    Eigen::ArrayXd towards = slope(kept.back(), i);
    if ((towards < low).any() || (towards > high).any()) {
      kept.push_back(i - 1);
      towards = slope(i - 1, i);
      low.setConstant(-infinite);
      high.setConstant(infinite);
    }
    const double way = at[i] - at[kept.back()];
    low = low.max(towards - allowed / way);
    high = high.min(towards + allowed / way);
  }
  kept.push_back(at.size() - 1);
  return {at(kept), value(kept, Eigen::all)};
}

Eigen::MatrixXd Corners::jumps() const {
  const Eigen::Index pieces = at.size() - 1;
  const Eigen::MatrixXd slope = (at.tail(pieces) - at.head(pieces)).inverse().matrix().asDiagonal() *
                                (value.bottomRows(pieces) - value.topRows(pieces));
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(at.size(), value.cols());
  out.topRows(pieces) += slope;
  out.bottomRows(pieces) -= slope;
  return out;
}

}  // namespace hydro::radiation::detail
