#pragma once
/// \file  The signals that a result can hold: motions of bodies' origins, forces of connectors and moorings, waves,
/// energies.
#include <algorithm>
#include <complex>
#include <functional>
#include <string>
#include <vector>

#include "compile/compile.hpp"
#include "dynamics/integrate/ledger.hpp"

namespace froude::compile {

/// A number that can be read off a run at any instant.
struct Probe {
  std::string name, unit, long_name;
  std::function<double(const dynamics::Workspace&, const dynamics::EnergyLedger&)> read;
};

/// What one [[probe]] of a scene tells: names, units, and how each is read off the water's kinematics.
struct ProbeSignal {
  std::string name, unit, long_name;
  std::function<double(const hydro::waves::Kinematics&)> take;
};
std::vector<ProbeSignal> probe_signals(const scene::Probe& probe);

/// All signals of a run of this model. Motions are of the body's origin from its place at rest; rotations are the
/// yaw–pitch–roll angles of the attitude (about z, then the new y, then the new x).
std::vector<Probe> run_probes(const scene::Scene& scene, const Prepared& prepared, const TimeModel& model);

/// A linear signal of the frequency domain: (stiffness + iω damping) · ξ + joints · λ, ξ the displacements about the
/// centres of gravity, λ the multipliers of joints. Rows that are empty have no part.
struct LinearProbe {
  std::string name, unit, long_name;
  Eigen::RowVectorXd stiffness, damping, joints = {};
};
std::vector<LinearProbe> rao_probes(const scene::Scene& scene, const Prepared& prepared,
                                    const dynamics::frequency::SmallMotions& about);

/// True if one of the patterns matches, or there are none.
inline bool is_chosen(const std::string& name, const std::vector<std::string>& patterns) {
  return patterns.empty() || std::any_of(patterns.begin(), patterns.end(),
                                         [&](const auto& pattern) { return scene::matches(pattern, name); });
}

/// Those whose names match one of the patterns (`*` stands for anything); all if there are no patterns. Keeps their
/// order.
template <class P>
std::vector<P> chosen(const std::vector<P>& all, const std::vector<std::string>& patterns) {
  std::vector<P> out;
  for (const P& p : all)
    if (is_chosen(p.name, patterns)) out.push_back(p);
  return out;
}

}  // namespace froude::compile
