#include "hydro/potential/hull_pressure.hpp"

#include <Eigen/Geometry>

#include <algorithm>

#include "hydro/base/error.hpp"

namespace hydro::potential {

Eigen::VectorXcd dynamic_load(const HullPressure& hulls, int body, const Eigen::Vector3d& about) {
  Eigen::VectorXcd out = Eigen::VectorXcd::Zero(6);
  for (std::size_t i = 0; i < hulls.panel.size(); ++i) {
    const WetPanel& panel = hulls.panel[i];
    if (panel.body != body) continue;
    const std::complex<double> inward = -panel.area * hulls.dynamic(static_cast<Eigen::Index>(i));
    out.head<3>() += inward * panel.normal;
    out.tail<3>() += inward * (panel.centre - about).cross(panel.normal);
  }
  return out;
}

double difference(const HullPressure& coarser, const HullPressure& finer, std::size_t (*pieces)(std::size_t corners)) {
  double change = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < coarser.panel.size(); ++i) {
    const std::size_t end = next + pieces(coarser.panel[i].corners.size());
    ensure(end <= finer.panel.size(), "the finer panels are the coarser ones cut");
    std::complex<double> sum = 0;
    double area = 0;
    for (; next < end; ++next) {
      sum += finer.panel[next].area * finer.dynamic(static_cast<Eigen::Index>(next));
      area += finer.panel[next].area;
    }
    change = std::max(change, std::abs(sum / area - coarser.dynamic(static_cast<Eigen::Index>(i))));
  }
  ensure(next == finer.panel.size(), "the finer panels are the coarser ones cut");
  return change / finer.dynamic.cwiseAbs().maxCoeff();
}

}  // namespace hydro::potential
