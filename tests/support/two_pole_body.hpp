#pragma once
/// \file  A radiating body whose memory is known exactly, (R9) in docs/theory/radiation.md.
#include <cmath>

#include "hydro/radiation/kernel.hpp"
#include "hydro/radiation/rational.hpp"

namespace support {

/// K(t) = e^{−at}(cos bt − (a/b) sin bt), B(ω) = 2aω²/D, A(ω) − A∞ = (w² − ω²)/D, w² = a² + b², D = (w² − ω²)² + 4a²ω².
struct TwoPoleBody {
  double decay = 0.3, frequency = 1.1;  // a, b

  double K(double t) const {
    return std::exp(-decay * t) * (std::cos(frequency * t) - decay / frequency * std::sin(frequency * t));
  }
  double D(double omega) const {
    const double d = w2() - omega * omega;
    return d * d + 4 * decay * decay * omega * omega;
  }
  double B(double omega) const { return 2 * decay * omega * omega / D(omega); }
  double A_minus_A_inf(double omega) const { return (w2() - omega * omega) / D(omega); }
  double w2() const { return decay * decay + frequency * frequency; }

  /// The body itself: its memory is one pair of poles.
  hydro::radiation::PoleModel model(int modes = 1) const {
    const Eigen::MatrixXd C = Eigen::MatrixXd::Identity(modes, modes);
    return {{{decay, frequency}}, {C}, {-decay / frequency * C}};
  }
  /// A(ω) of the modes of damping_table(), with the limit `A_inf`.
  std::vector<Eigen::MatrixXd> added_mass(const hydro::radiation::DampingTable& table, double A_inf) const {
    std::vector<Eigen::MatrixXd> A;
    const auto n = table.B.front().rows();
    for (const double omega : table.omega)
      A.push_back((A_inf + A_minus_A_inf(omega)) * Eigen::MatrixXd::Identity(n, n));
    return A;
  }

  /// `modes` equal uncoupled modes at `count` even frequencies up to `end`.
  hydro::radiation::DampingTable damping_table(double end, int count, int modes = 1) const {
    hydro::radiation::DampingTable table;
    for (int i = 1; i <= count; ++i) {
      table.omega.push_back(end * i / count);
      table.B.push_back(B(table.omega.back()) * Eigen::MatrixXd::Identity(modes, modes));
    }
    return table;
  }
};

}  // namespace support
