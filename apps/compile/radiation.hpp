#pragma once
/// \file  Private to apps: radiation of one group of bodies in a run.
#include "compile/compile.hpp"
#include "compile/kept.hpp"
#include "dynamics/force/wave_loads.hpp"

namespace froude::compile {

/// Added mass on the left, the memory that goes with it, and what the plan says: the method that runs, then the
/// alternatives with their errors and costs.
struct RadiationParts {
  dynamics::AddedMass added_mass;
  dynamics::RadiationMemory memory;
  MemoryInRun in_run;
  std::vector<PlanLine> lines;
};

/// Radiation of the groups of a scene, at the run's step. Groups with equal coefficients, such as copies that do not
/// feel each other, share one memory method: it is weighed and fitted once,
/// also for all runs at this step that share what is kept.
class Radiation {
 public:
  /// `sea`: null in calm water.
  Radiation(const Prepared& prepared, double step, const hydro::waves::Sea* sea);
  /// What is to be noted of groups with equal coefficients is noted once.
  /// \throws hydro::InputError if constant coefficients are asked for in anything but one regular wave
  RadiationParts of(std::size_t group, std::vector<std::string>& notes);

 private:
  WeighedMemories::Weighed weighed_for(std::size_t group, const std::vector<int>& modes) const;

  const Prepared& prepared_;
  double step_;
  const hydro::waves::Sea* sea_;
  std::vector<WeighedMemories::Weighed> told_;
};

/// Where the program chooses the method of a memory, it stays what it is at this step: which is cheapest depends on the
/// step, and what methods differ by is no error of the step.
void hold_memories(Prepared& prepared, double step);

}  // namespace froude::compile
