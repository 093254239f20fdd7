#include "hydro/potential/wave_field.hpp"

#include <algorithm>
#include <cmath>

#include "hydro/base/error.hpp"

namespace hydro::potential {

Eigen::VectorXcd incident_elevation(const Eigen::MatrixX2d& point, double wavenumber, double heading) {
  const Eigen::Vector2d towards(std::cos(heading), std::sin(heading));
  Eigen::VectorXcd out(point.rows());
  for (Eigen::Index p = 0; p < point.rows(); ++p) out(p) = std::polar(1.0, -wavenumber * point.row(p).dot(towards));
  return out;
}

double difference(const WaveField& coarser, const WaveField& finer) {
  ensure(coarser.known.size() == finer.known.size(), "fields of the same points are compared");
  const Eigen::VectorXcd a = coarser.total(), b = finer.total();
  double change = 0, largest = 0;
  for (Eigen::Index p = 0; p < a.size(); ++p) {
    if (!coarser.known[static_cast<std::size_t>(p)] || !finer.known[static_cast<std::size_t>(p)]) continue;
    change = std::max(change, std::abs(a(p) - b(p)));
    largest = std::max(largest, std::abs(b(p)));
  }
  return largest > 0 ? change / largest : 0;
}

void check(const FieldQuestion& question, std::size_t bodies) {
  require(std::isfinite(question.omega) && question.omega > 0, "a frequency must be finite and positive, got {} rad/s",
          question.omega);
  require(std::isfinite(question.heading), "a heading must be finite, got {} rad", question.heading);
  require(question.point.rows() > 0 && question.point.allFinite(),
          "a field needs points, and their places must be finite");
  require(question.motion.size() == 6 * static_cast<Eigen::Index>(bodies) && question.motion.allFinite(),
          "a field needs six finite motions for each of {} bodies, got {} numbers", bodies, question.motion.size());
}

}  // namespace hydro::potential
