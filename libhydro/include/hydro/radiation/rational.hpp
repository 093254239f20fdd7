#pragma once
/// \file  Radiation memory as a sum of decaying oscillations that all pairs of modes share.
/// Equations (R12) to (R17) are derived and sourced in docs/theory/radiation.md.
#include <Eigen/Core>

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "hydro/radiation/kernel.hpp"

namespace hydro::radiation {

/// −decay ± i·omega, rad/s; omega = 0 is one real pole, else a pair.
struct Pole {
  double decay;  ///< > 0
  double omega;  ///< >= 0
};

/// K(t) = Σ_k e^{−a_k t} (C_k cos b_k t + S_k sin b_k t), with a, b of pole k; (R12). All matrices (n, n), symmetric;
/// S_k = 0 for a real pole. Its transform vanishes at ω = 0 and falls as K(0)/iω.
struct PoleModel {
  std::vector<Pole> poles;
  std::vector<Eigen::MatrixXd> C, S;  ///< N/m between translations

  int modes() const { return C.empty() ? 0 : static_cast<int>(C.front().rows()); }
  int order() const;  ///< real states a mode: one a real pole, two a pair
  Eigen::MatrixXd kernel(double t_s) const;
  /// K̂(iω) = B + iω(A − A∞) of the model.
  Eigen::MatrixXcd transform(double omega) const;
};

struct FitOptions {
  double tolerance = 1e-3;  ///< of the force at each frequency of the data, relative to √(max B_ii max B_jj)
  int largest_order = 160;  ///< real states a mode
  bool enforce_passivity = true;
};

/// What a fit came to. Errors are relative to √(max B_ii max B_jj) and compare B + iω(A − A∞) with the data at the
/// data's own frequencies; modes without waves are left out.
struct FitReport {
  int order = 0;
  double error = 0;                ///< the largest of error_per_pair
  Eigen::MatrixXd error_per_pair;  ///< (n, n)
  double error_before = 0;         ///< of the fit as it was before passivity was enforced: what that cost
  bool passive = false;            ///< certified: B(ω) >= margin · weight(ω) at every frequency, (R15)
  double margin = 0;               ///< certified, relative to √(max B_ii max B_jj); 0 where nothing is certified
  double most_negative = 0;        ///< eigenvalue of the scaled B before enforcement, 0 if none was below zero
  double lift = 0;                 ///< largest damping added to every mode alike, relative to its max B_ii
  double shift = 0;                ///< of A∞ from the limit given, relative to √(A_ii A_jj), largest
  double negative_share = 0;       ///< of the data: most negative B_ii relative to its mode's largest
  std::string why;                 ///< why the order is what it is: one sentence, fit for a log
};

struct RationalFit {
  PoleModel model;
  Eigen::MatrixXd A_inf;  ///< (n, n), the constant that belongs to the model
  FitReport report;
};

/// Fits added mass and damping together, by vector fitting with common poles (Gustavsen & Semlyen 1999; relaxed as
/// Gustavsen 2006; (R13)), the order raised until the tolerance is met. Stability, K̂(0) = 0, a finite K(0) and symmetry
/// are built in; passivity is enforced and certified (R15)–(R16). Between and beyond the frequencies of the data the
/// model is the least that belongs to them: beyond, the damping of extrapolated() is followed loosely.
///
/// `A`: one matrix a frequency of the table. Cost: a tenth of a second for six modes, seconds for thirty,
/// minutes for a hundred and fifty.
/// \throws InputError as RetardationKernel::from_damping, or if the sizes disagree, or with fewer than four frequencies
RationalFit fit(const DampingTable& damping, const std::vector<Eigen::MatrixXd>& A,
                const std::optional<Eigen::MatrixXd>& A_inf, const FitOptions& options = {});

/// By how much more than its `residual` each frequency would be missed, were it left out when the coefficients of these
/// poles are fitted: (1 − h)⁻¹h times the residual, h how far a datum draws the fit to itself (Allen 1974, (R26)). Next
/// to nothing where there are many data for a pole, large where the data leave the model free between them.
///
/// `residual`: data less model at `omega`, (n, n) each. Cost: one QR of 2 Nω rows and as many columns as there are
/// states.
std::vector<Eigen::MatrixXcd> missed_if_left_out(const PoleModel& model, const std::vector<double>& omega,
                                                 const std::vector<Eigen::MatrixXcd>& residual);

}  // namespace hydro::radiation
