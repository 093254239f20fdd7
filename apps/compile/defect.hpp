#pragma once
/// \file  Private to apps: loads that approximations of the water keep from a run, told by the motion of that run.
///        Put back into a run beside it, they tell what the approximation does to each signal. (R25), (R26)
#include "compile/compile.hpp"

namespace froude::compile {

/// How a run has moved.
struct VelocityRecord {
  double spacing;  ///< s
  Eigen::MatrixXd
      of_modes;  ///< (modes of the model, samples), as State::velocity is ordered, from the start of the run
};

/// What the memory of each group leaves out of B + iω(A − A∞) of its data, as a load. Poles are compared at the
/// frequencies of the data and straight on between; the kernel of a convolution is cut in time, which is felt between
/// them too, and is compared there with the cubic from which it is made. Below the first frequency B falls as ω² and A
/// stays; beyond the last see hydro::radiation::missing_load(). Empty where nothing radiates.
std::optional<LoadRecord> memory_defect(const TimeModel& model, const VelocityRecord& motion);

/// What A, B and X may be off between the frequencies of their data and beyond them, as a load (R26). Where cubics go
/// between them, for excitation and convolutions: what the cubic through every other frequency misses at those left
/// out, divided by what halving the spacing gains. Where poles do: what they would miss of each frequency, were it left
/// out of their fit. Beyond the last frequency: all that the memory has there, and no less than what it had at the end,
/// falling as ω⁻¹. Bodies whose excitation turns with them are taken as placed. Empty where no body has coefficients.
std::optional<LoadRecord> data_defect(const scene::Scene& scene, const Prepared& prepared, const TimeModel& model,
                                      const VelocityRecord& motion);

}  // namespace froude::compile
