#include "dynamics/frequency/load_departure.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace dynamics::frequency {

using Eigen::Index, Eigen::VectorXcd, Eigen::VectorXd;

DepartureFromLinear::DepartureFromLinear(const SmallMotions& about, double amplitude)
    : about_(about), amplitude_(amplitude) {
  const VectorXd none = VectorXd::Zero(about.model.modes());
  load_ = work_ = none;
  for (const auto& kind : about.model.forces()) {
    const bool linear = kind->linear_at_rest();
    if (!linear && (kind->friction() || kind->contact() || kind->make_memory(about.still))) continue;
    Kind& k = kinds_.emplace_back(Kind{kind.get(), none, BlockMatrix(about.model.pattern()),
                                       BlockMatrix(about.model.pattern()), none, none, none});
    LoadSink load(k.at_rest);
    kind->add_load({about.still, nullptr}, load);
    if (!linear) continue;  // a response has nothing of it
    JacobianSink stiffness(k.stiffness, 1, 0), damping(k.damping, 0, 1);
    kind->add_jacobian({about.still, nullptr}, stiffness);
    kind->add_jacobian({about.still, nullptr}, damping);
  }
}

namespace {

/// (K + iωD) ξ: the linear part of a load is minus its real part, turned.
VectorXcd linear_part(const BlockMatrix& stiffness, const BlockMatrix& damping, double omega, const VectorXcd& xi) {
  const VectorXd real = xi.real(), imaginary = xi.imag();
  VectorXcd out(xi.size());
  out.real() = stiffness * real - omega * (damping * imaginary);
  out.imag() = stiffness * imaginary + omega * (damping * real);
  return out;
}

}  // namespace

void DepartureFromLinear::take(double omega, const VectorXcd& xi, const VectorXcd& X) {
  constexpr int phases = 8;  // of a cycle: the largest of a cubic is missed by at most 1 − cos³(π/8), a fifth
  for (Index m = 0; m < X.size(); ++m) {
    load_[m] = std::max(load_[m], amplitude_ * std::abs(X[m]));
    work_[m] = std::max(work_[m], std::abs(X[m] * xi[m]));
  }
  std::vector<VectorXcd> linear;
  for (const Kind& kind : kinds_) linear.push_back(linear_part(kind.stiffness, kind.damping, omega, xi));
  for (int i = 0; i < phases; ++i) {
    const std::complex<double> turn = std::polar(amplitude_, 2 * std::numbers::pi * i / phases);
    State now = moved(about_.still, (turn * xi).real());
    now.velocity = (std::complex<double>(0, omega) * turn * xi).real();
    for (std::size_t n = 0; n < kinds_.size(); ++n) {
      Kind& kind = kinds_[n];
      VectorXd departure = (turn * linear[n]).real() - kind.at_rest;
      LoadSink sink(departure);
      kind.of->add_load({now, nullptr}, sink);
      for (Index m = 0; m < departure.size(); ++m) {
        const double size =
            std::isfinite(departure[m]) ? std::abs(departure[m]) : std::numeric_limits<double>::infinity();
        if (!(size > kind.departure[m])) continue;
        kind.departure[m] = size;
        kind.omega[m] = omega;
        kind.motion[m] = amplitude_ * std::abs(xi[m]);
      }
    }
  }
}

std::optional<LoadDeparture> DepartureFromLinear::largest() const {
  constexpr double moves = 1e-3;  // of the work in the foremost mode, as (D144)
  std::optional<LoadDeparture> out;
  for (const Kind& kind : kinds_)
    for (Index m = 0; m < load_.size(); ++m) {
      if (work_[m] == 0 || work_[m] < moves * work_.maxCoeff() || !about_.model.is_free(static_cast<int>(m))) continue;
      const double share = kind.departure[m] / load_[m];
      if (!out || share > out->share)
        out = {kind.of->effect(), static_cast<int>(m), kind.omega[m], kind.motion[m], share};
    }
  return out;
}

}  // namespace dynamics::frequency
