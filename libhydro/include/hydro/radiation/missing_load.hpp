#pragma once
/// \file  The load that a radiation memory leaves out of a run, told by the motion of that run. (R25),
/// docs/theory/radiation.md
#include <Eigen/Core>

#include <vector>

namespace hydro::radiation {

/// What is missing of the water's answer to harmonic motion: the load −Z(ω) v that nobody has put on the bodies.
struct MissingImpedance {
  std::vector<double> omega;        ///< rad/s, increasing, the first may be 0
  std::vector<Eigen::MatrixXcd> Z;  ///< one (n, n) a frequency: B + iωA of what is missing, N s/m between translations
};

/// The load on n modes at the samples of a motion that begins from rest, (n, samples), N: −(Z * v)(t), by Fourier
/// transforms of velocities padded so that nothing comes round.
///
/// Between its frequencies Z is cubic, below the first it is held; beyond the last the missing added mass stays as it
/// is there and the missing damping falls as ω⁻², since nothing is known of either. That added mass, which is no
/// memory, acts on the derivative of the velocity and gives no blow where a motion begins at speed.
///
/// `velocity`: (n, samples), `spacing` seconds apart from the start on. Error: of second order in the spacing, as the
/// motion's own. Cost: n transforms and n² products a sample. \throws InputError if sizes do not agree
Eigen::MatrixXd missing_load(const MissingImpedance& missing, const Eigen::MatrixXd& velocity, double spacing);

}  // namespace hydro::radiation
