#pragma once
/// \file  Private to compile/: radiation of one group of bodies in a run.
#include <mutex>

#include "compile/compile.hpp"
#include "dynamics/force/wave_loads.hpp"
#include "hydro/radiation/rational.hpp"

namespace froude::compile {

/// A and B of some modes, made symmetric.
///
/// A and B of linear theory are symmetric. Panel codes miss that by their discretisation error, which in a run would be
/// energy from nowhere; the frequency domain, which has no ledger to close, takes the data as they are.
struct SymmetricData {
  hydro::radiation::DampingTable damping;
  std::vector<Eigen::MatrixXd> A;
  std::optional<Eigen::MatrixXd> A_inf;
  double asymmetry = 0;  ///< of the largest entry

  SymmetricData(const hydro::potential::Coefficients& c, const std::vector<int>& modes);
  bool operator==(const SymmetricData& other) const;

 private:
  Eigen::MatrixXd of(const Eigen::MatrixXd& whole, const std::vector<int>& modes);
};

/// A fit takes seconds, the run of one regular wave a tenth of one. One thread at a time.
class RadiationFits {
 public:
  const hydro::radiation::RationalFit& of(const SymmetricData& data, double tolerance);

 private:
  struct Known {
    SymmetricData data;
    double tolerance;
    hydro::radiation::RationalFit fit;
  };
  std::mutex mutex_;
  std::vector<std::unique_ptr<const Known>> known_;
};

/// Added mass on the left, the memory that goes with it, and what the plan says: the method that runs, then the
/// alternatives with their errors and costs.
struct RadiationParts {
  dynamics::AddedMass added_mass;
  dynamics::RadiationMemory memory;
  std::vector<PlanLine> lines;
};

/// Radiation of the groups of a scene, at the run's step. Groups with equal coefficients, such as copies that do not
/// feel each other, share one memory method: it is weighed and fitted once.
class Radiation {
 public:
  /// `sea`: null in calm water.
  Radiation(const Prepared& prepared, double step, const hydro::waves::Sea* sea);
  ~Radiation();
  /// What is to be noted of groups with equal coefficients is noted once.
  /// \throws hydro::InputError if constant coefficients are asked for in anything but one regular wave
  RadiationParts of(std::size_t group, std::vector<std::string>& notes);

 private:
  struct Chosen;
  const Chosen& chosen_for(std::size_t group, const std::vector<int>& modes, std::vector<std::string>& notes);

  const Prepared& prepared_;
  double step_;
  const hydro::waves::Sea* sea_;
  std::vector<std::unique_ptr<const Chosen>> chosen_;
};

}  // namespace froude::compile
