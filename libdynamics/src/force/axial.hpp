#pragma once
/// \file  Private: one axial connector (D3), for the kinds that hold them. `stiffness` is what its law has for k₁ now.
#include <functional>
#include <vector>

#include "dynamics/force/connector.hpp"

namespace dynamics::detail {

void add_axial_load(const AxialConnector& connector, double stiffness, const State& state, LoadSink& out);
void add_axial_jacobian(const AxialConnector& connector, double stiffness, const State& state, JacobianSink& out);
/// Adds what it stores and dissipates.
void add_axial_energy(const AxialConnector& connector, double stiffness, const State& state, EnergyFlow& flow);

/// The signals of a connector, whose stiffness the memory of its kind may know; of small motions, null.
std::vector<Signal> axial_signals(const AxialConnector& connector, std::function<double(const Memory*)> stiffness);

}  // namespace dynamics::detail
