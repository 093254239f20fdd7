#include "answers.hpp"

#include <numbers>

#include "hydro/potential/far_field.hpp"

namespace hydro::cylinders {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using std::numbers::pi;

// (C13)
void add_far_field(const Groups& groups, const Question& q, const MatrixXcd& sent_out, OneFrequency& result) {
  const double h = q.modes.depth;
  const std::vector<double> angle = potential::angles_around(0, q.modes.k, q.across / 2, q.orders);
  const MatrixXcd f = groups.far_field(sent_out, angle);
  result.B_far = 4 * q.omega * q.water.density * h / static_cast<double>(angle.size()) * (f.adjoint() * f).real();
  std::vector<double> against;
  for (const double beta : q.heading) against.push_back(beta + pi);
  const Complex factor = Complex(0, 4 * q.water.density * q.water.gravity * h) / q.modes.wave_at_surface();
  result.X_far = factor * groups.far_field(sent_out, against).transpose();
}

}  // namespace

// (C3): a force is iωρ ∬φ n dS; of a motion of unit velocity it is −(iωA + B).
OneFrequency answers(const Groups& groups, const Question& q) {
  const Response response = groups.respond(q.heading, q.motion, q.equations);
  const MatrixXcd loads = q.motion.transpose() * response.loads;
  const Complex potential = Complex(0, q.water.gravity / q.omega) / q.modes.wave_at_surface();  // of a unit amplitude
  OneFrequency result;
  result.partial_waves = groups.partial_waves();
  result.steps = response.steps;
  result.lattice = response.lattice;
  const auto waves = static_cast<Index>(q.heading.size());
  result.X = Complex(0, q.omega * q.water.density) * potential * loads.leftCols(waves);
  result.A = -q.water.density * loads.rightCols(q.motion.cols()).real();
  result.B = q.omega * q.water.density * loads.rightCols(q.motion.cols()).imag();
  add_far_field(groups, q, response.sent_out.rightCols(q.motion.cols()), result);
  return result;
}

MatrixXd added_mass_at_infinity(const Groups& groups, const Water& water, const MatrixXd& motion, Equations equations) {
  return -water.density * (motion.transpose() * groups.respond({}, motion, equations).loads).real();
}

}  // namespace hydro::cylinders
