#pragma once
/// \file  Private to the doctor: what all checks need to know of the coefficients, and the checks, one function each.
/// Each adds its findings to a list. Equations (P60)-(P76) are in docs/theory/doctor.md.
#include <Eigen/Core>

#include <string>
#include <vector>

#include "hydro/potential/doctor/check.hpp"

namespace hydro::potential::doctor {

/// One matrix of a series with the frequency that it belongs to.
struct Sample {
  std::string at;
  std::optional<double> omega;
  const Eigen::MatrixXd* matrix;
};
using Series = std::vector<Sample>;

/// sqrt(s_i s_j) of (P11), or 1 where there is nothing to compare with.
double size_of_entry(const Eigen::VectorXd& s, Eigen::Index i, Eigen::Index j);

/// Whether mode i has numbers of its own, or is one whose size is only the floor of (P11), such as yaw of a body of
/// revolution, where a code leaves noise.
bool acts(const std::vector<Eigen::MatrixXd>& matrices, const Eigen::VectorXd& s, Eigen::Index i);

/// The coefficients with what several checks derive from them.
struct Patient {
  explicit Patient(const Coefficients& coefficients);

  const Coefficients& c;
  Series A, B;                           ///< A with its limits
  Eigen::VectorXd size_of_A, size_of_B;  ///< s_i of (P11)
  std::vector<double> k;                 ///< wavenumber at each frequency, rad/m
};

/// The value below which a share of the values lies; 0 for none.
double quantile(std::vector<double> values, double share);

using Findings = std::vector<Finding>;

/// "1.23 rad/s"
std::string frequency_text(double omega);
/// "A(1, 5) at 1 rad/s: surge of body 1 and pitch of body 1"
std::string entry_text(const char* name, Eigen::Index i, Eigen::Index j, const std::string& at);
/// A note that a check could not be made, and for want of what.
Finding not_looked_at(const char* check, const std::string& reason);
/// "; 9.81 is g: …" if a ratio is near a number that mistakes produce, else "". `inverse` ratios are recognised too.
std::string likely_cause(double ratio, const Water& water);

// doctor_matrices.cpp
void check_symmetry(const Patient& p, Findings& out);
void check_reciprocity(const Patient& p, Findings& out);
void check_sign_of_damping(const Patient& p, Findings& out);
void check_passivity(const Patient& p, Findings& out);
void check_positivity_of_limit(const Patient& p, Findings& out);
void check_limits(const Patient& p, Findings& out);
// doctor_spikes.cpp
void check_repeated_frequencies(const Patient& p, Findings& out);
void check_spikes(const Patient& p, Findings& out);
/// Adds a finding of "spikes" for each load that departs from its neighbours by itself; none where all fit. (P43)
void look_at_excitation_spikes(const Patient& p, Findings& out);
// doctor_causality.cpp: Kramers-Kronig, A(inf) by Ogilvie and both tails share one fit
void check_causality(const Patient& p, Findings& out);
// doctor_haskind.cpp
void check_haskind(const Patient& p, Findings& out);
// doctor_long_waves.cpp
void check_long_waves(const Patient& p, Findings& out);
// doctor_hydrostatics.cpp
void check_restoring(const Patient& p, Findings& out);
void check_waterplane(const Patient& p, Findings& out);
void check_added_mass_and_volume(const Patient& p, Findings& out);

}  // namespace hydro::potential::doctor
