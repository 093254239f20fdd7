/// \file  Many random radiating bodies: does any method break the bound that it reports?   draws [how many] [first
/// seed]
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdlib>
#include <string>

#include "hydro/base/random.hpp"
#include "hydro/radiation/choice.hpp"
#include "hydro/radiation/convolution.hpp"
#include "hydro/radiation/partitioned.hpp"
#include "hydro/radiation/pole_memory.hpp"
#include "support/random_passive.hpp"

namespace {

using namespace hydro::radiation;

struct Tally {
  int draws = 0, not_certified = 0, negative_damping = 0, energy_given = 0, error_understated = 0, sums_differ = 0;
  double worst_error = 0;
};

/// A table of a random body, in every third draw with noise of up to a percent on its damping.
support::RadiationData draw(std::uint64_t seed) {
  const int modes = 1 + static_cast<int>(seed % 6), pairs = 2 + static_cast<int>(seed / 6 % 5);
  auto data = support::data_of(support::random_passive(seed, modes, pairs), 5 + static_cast<double>(seed % 4), 50);
  if (seed % 3 != 0) return data;
  const hydro::RandomStream random(seed, 9);
  std::uint64_t next = 0;
  for (auto& B : data.damping.B) B.diagonal() *= 1 + 0.003 * random.normal(next++);
  return data;
}

bool gives_energy(const PoleModel& model, std::uint64_t seed) {
  const double h = 0.1 + 0.5 * static_cast<double>(seed % 7);
  const PoleMemory memory(model, h);
  const auto state = memory.start(Eigen::VectorXd::Zero(model.modes()));
  const hydro::RandomStream random(seed, 5);
  std::uint64_t next = 0;
  double energy = 0, scale = 0;
  for (int i = 0; i < 200; ++i) {
    Eigen::VectorXd v(model.modes());
    for (auto& x : v) x = random.normal(next++);
    const Eigen::VectorXd load = state->history_force(1) + memory.instantaneous(1) * v;
    energy += load.dot(v);
    scale += load.norm() * v.norm();
    if (energy < -1e-12 * scale) return true;
    state->accept(v);
  }
  return false;
}

bool has_negative_damping(const PoleModel& model) {
  for (double omega = 1e-2; omega < 1e2; omega *= 1.01) {
    const Eigen::MatrixXd B = model.transform(omega).real();
    const auto eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(B, Eigen::EigenvaluesOnly).eigenvalues();
    if (eigenvalues[0] < -1e-13 * model.transform(1).cwiseAbs().maxCoeff()) return true;
  }
  return false;
}

bool sums_differ(const support::RadiationData& data, std::uint64_t seed) {
  const auto kernel = RetardationKernel::from_damping(data.damping, {0.2, 15});
  const DirectConvolution direct(kernel);
  const PartitionedConvolution partitioned(kernel, 8);
  const hydro::RandomStream random(seed, 6);
  const auto zero = Eigen::VectorXd::Zero(kernel.modes());
  const auto slow = direct.start(zero), fast = partitioned.start(zero);
  std::uint64_t next = 0;
  double size = 0;
  for (int i = 0; i < 150; ++i) {
    Eigen::VectorXd v(kernel.modes());
    for (auto& x : v) x = random.normal(next++);
    slow->accept(v);
    fast->accept(v);
    const Eigen::VectorXd expected = slow->history_force(1);
    size = std::max(size, expected.norm());
    if ((fast->history_force(1) - expected).norm() > 1e-12 * size) return true;
  }
  return false;
}

void look_at(std::uint64_t seed, Tally& t) {
  const auto data = draw(seed);
  const auto fitted = fit(data.damping, data.A, data.A_inf, {.tolerance = 1e-2, .largest_order = 32});
  std::vector<Eigen::MatrixXcd> transforms;
  for (const double omega : data.damping.omega) transforms.push_back(fitted.model.transform(omega));
  const double error = error_against(data.damping, data.A, fitted.A_inf, transforms).value;
  ++t.draws;
  t.worst_error = std::max(t.worst_error, error);
  t.error_understated += error > fitted.report.error * (1 + 1e-6) + 1e-12;
  t.not_certified += !fitted.report.passive;
  if (fitted.report.passive) {
    t.negative_damping += has_negative_damping(fitted.model);
    t.energy_given += gives_energy(fitted.model, seed);
  }
  t.sums_differ += sums_differ(data, seed);
}

}  // namespace

int main(int count, char** words) {
  const long draws = count > 1 ? std::atol(words[1]) : 10000, first = count > 2 ? std::atol(words[2]) : 0;
  Tally t;
  for (long i = 0; i < draws; ++i) look_at(static_cast<std::uint64_t>(first + i), t);
  fmt::print(
      "{} draws: {} not certified; of the certified {} with damping below zero, {} that gave energy; {} with an "
      "error larger than reported (largest error {:.2g}); {} partitioned sums unlike the direct one\n",
      t.draws, t.not_certified, t.negative_damping, t.energy_given, t.error_understated, t.worst_error, t.sums_differ);
  return t.negative_damping + t.energy_given + t.error_understated + t.sums_differ == 0 ? 0 : 1;
}
