#pragma once
/// \file  Radiating bodies that exist by construction, at random: sums of two-pole bodies with positive weights.
#include <Eigen/Core>

#include <cmath>

#include "hydro/base/random.hpp"
#include "hydro/radiation/rational.hpp"

namespace support {

/// K̂(s) = Σ_k W_k s/((s + a_k)² + b_k²), W_k = V Vᵀ: passive term by term (R9), symmetric, zero at rest.
inline hydro::radiation::PoleModel random_passive(std::uint64_t seed, int modes, int pairs) {
  const hydro::RandomStream random(seed, 7);
  std::uint64_t next = 0;
  hydro::radiation::PoleModel m;
  for (int k = 0; k < pairs; ++k) {
    const double b = 0.4 + 2.2 * random.uniform(next++), a = b * (0.08 + 0.5 * random.uniform(next++));
    Eigen::MatrixXd V(modes, std::max(1, modes / 2));
    for (auto& v : V.reshaped()) v = random.normal(next++);
    const Eigen::MatrixXd W = V * V.transpose() * (1e3 + 1e5 * random.uniform(next++));
    m.poles.push_back({a, b});
    m.C.push_back(W);
    m.S.push_back(-a / b * W);
  }
  return m;
}

/// What a panel code would give of it.
struct RadiationData {
  hydro::radiation::DampingTable damping;
  std::vector<Eigen::MatrixXd> A;
  Eigen::MatrixXd A_inf;
};
inline RadiationData data_of(const hydro::radiation::PoleModel& m, double last, int count) {
  RadiationData d;
  d.A_inf = 1e5 * Eigen::MatrixXd::Identity(m.modes(), m.modes());
  for (int i = 1; i <= count; ++i) {
    const double omega = last * i / count;
    const Eigen::MatrixXcd K = m.transform(omega);
    d.damping.omega.push_back(omega);
    d.damping.B.push_back(K.real());
    d.A.push_back(d.A_inf + K.imag() / omega);
  }
  return d;
}

}  // namespace support
