#pragma once
/// \file  Responses to waves of several headings, at many frequencies, of few bodies or of a thousand.
#include "dynamics/frequency/rao.hpp"

namespace dynamics::frequency {

/// Responses to waves of several headings, per metre of wave amplitude, Re(… e^{iωt}) against a wave of zero phase at
/// the global origin.
struct Amplitudes {
  /// One a heading, in the order asked: every body's displacement about its centre of gravity, (6N, Nω), m/m and rad/m.
  std::vector<Eigen::MatrixXcd> xi;
  /// Likewise: multipliers λ of the joints beyond what they are while still, (m, Nω).
  std::vector<Eigen::MatrixXcd> lambda;
  int factorisations = 0;  ///< of the matrix of (Q1): one a frequency, however many headings, unless their drag differs
  bool sparse = false;     ///< they were sparse
};

/// How response_amplitudes() goes about it.
struct RaoOptions {
  int threads = 1;  ///< which share the frequencies; the numbers do not depend on how many there are
  /// One a heading, made for the same frequencies; or none. Where their coefficients differ each heading has
  /// factors of its own (Q5); those of a sea are the same for all (D143).
  std::vector<LinearDrag> drag = {};
};

/// Solves (Q1) at each frequency: [−ω²(M + A(ω)) + iω(B(ω) + D) + K] ξ + Gᵀλ = X(ω, β), K and D from every force of the
/// model that is linear at rest, about where the bodies are still, with G ξ = 0 of the joints (D17). `headings` in rad.
/// Modes that are not free stay zero. Cost: one factorisation a frequency, dense, O((6N)³), where bodies are few or
/// feel each other's waves, else sparse, O(N) for a chain; a heading is one more column. Error: round-off, plus what
/// FrequencyTable::interpolation_error() says of the data. \throws hydro::InputError outside the data,
/// hydro::NumericsError naming frequency and motion if the matrix is singular
Amplitudes response_amplitudes(const SmallMotions& about, const std::vector<PotentialGroup>& groups,
                               const std::vector<double>& omega, const std::vector<double>& headings,
                               const RaoOptions& options);

/// Answers to loads Re(e^{iωt}) of one newton or newton metre about the centres of gravity, in place of waves:
/// [−ω²(M + A(ω)) + iω(B(ω) + D) + K] ξ + Gᵀλ = e_m, for each of these modes m where response_amplitudes() has a
/// heading. From ω = 0 on, where K alone holds a constant load: below the tables A is straight to A(0) or constant, B
/// straight to none. \throws hydro::InputError above the data, hydro::NumericsError naming frequency and motion if the
/// matrix is singular, as at ω = 0 where nothing holds a motion (D142). `drag`: of still_water_drag(), or none
Amplitudes answers_to_loads(const SmallMotions& about, const std::vector<PotentialGroup>& groups,
                            const std::vector<double>& omega, const std::vector<int>& modes,
                            const LinearDrag* drag = nullptr, int threads = 1);

}  // namespace dynamics::frequency
