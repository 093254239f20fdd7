#include "answers.hpp"

#include <cmath>
#include <numbers>

#include "hydro/potential/far_field.hpp"

namespace hydro::cylinders {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using std::numbers::pi;

/// Of angles that are multiples of a whole turn over `count`.
std::vector<Index> places_on_circle(const std::vector<double>& angle, Index count) {
  std::vector<Index> out;
  for (const double a : angle) out.push_back((std::lround(a / (2 * pi) * static_cast<double>(count)) + count) % count);
  return out;
}

// (C13)
void add_far_field(const Groups& groups, const Question& q, const MatrixXcd& sent_out, OneFrequency& result) {
  const double h = q.modes.depth;
  const std::vector<double> angle = potential::angles_around(0, q.modes.k, q.across / 2, q.orders);
  const MatrixXcd around = groups.far_field(sent_out, angle);
  const MatrixXcd f = q.solved.far_field(angle, q.modes.k, [&](const std::vector<double>& from) -> MatrixXcd {
    return around(places_on_circle(from, around.rows()), Eigen::all);
  });
  result.B_far = 4 * q.omega * q.water.density * h / static_cast<double>(angle.size()) * (f.adjoint() * f).real();
  std::vector<double> against;
  for (const double beta : q.heading) against.push_back(beta + pi);
  const Complex factor = Complex(0, 4 * q.water.density * q.water.gravity * h) / q.modes.wave_at_surface();
  const auto there = [&](const std::vector<double>& from) { return groups.far_field(sent_out, from); };
  result.X_far = factor * q.solved.far_field(against, q.modes.k, there).transpose();
}

}  // namespace

// (C3): a force is iωρ ∬φ n dS; of a motion of unit velocity it is −(iωA + B).
OneFrequency answers(const Groups& groups, const Question& q) {
  const MatrixXd moved = q.motion(Eigen::all, q.solved.columns());
  const Response response = groups.respond(q.heading, moved, q.equations);
  const MatrixXcd loads = q.motion.transpose() * response.loads;
  const MatrixXcd radiated = q.solved.loads(loads.rightCols(moved.cols()));
  const Complex potential = Complex(0, q.water.gravity / q.omega) / q.modes.wave_at_surface();  // of a unit amplitude
  OneFrequency result;
  result.partial_waves = groups.partial_waves();
  result.steps = response.steps;
  result.lattice = response.lattice;
  const auto waves = static_cast<Index>(q.heading.size());
  result.X = Complex(0, q.omega * q.water.density) * potential * loads.leftCols(waves);
  result.A = -q.water.density * radiated.real();
  result.B = q.omega * q.water.density * radiated.imag();
  add_far_field(groups, q, response.sent_out.rightCols(moved.cols()), result);
  return result;
}

MatrixXd added_mass_at_infinity(const Groups& groups, const Water& water, const MatrixXd& motion,
                                const SolvedMotions& solved, Equations equations) {
  const MatrixXd moved = motion(Eigen::all, solved.columns());
  return -water.density * solved.loads(motion.transpose() * groups.respond({}, moved, equations).loads).real();
}

}  // namespace hydro::cylinders
