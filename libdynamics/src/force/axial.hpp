#pragma once
/// \file  Private: one axial connector (D3), for the kinds that hold them.
#include "dynamics/force/connector.hpp"

namespace dynamics::detail {

void add_axial_load(const AxialConnector& connector, const State& state, LoadSink& out);
void add_axial_jacobian(const AxialConnector& connector, const State& state, JacobianSink& out);
/// Adds what it stores and dissipates.
void add_axial_energy(const AxialConnector& connector, const State& state, EnergyFlow& flow);

}  // namespace dynamics::detail
