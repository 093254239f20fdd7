#pragma once
/// \file  What second-order wave loads add to responses in a random sea: offset, slow drift, sums. (D142)
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compile/kept.hpp"
#include "hydro/signal/spectrum.hpp"
#include "scene/scene.hpp"

namespace froude {

/// Of one signal.
struct SecondOrderResponse {
  std::string name, units;
  double offset;                           ///< by the mean load through the static stiffness about rest
  hydro::signal::SpectrumPerHz slow, sum;  ///< of difference and sum frequencies; without points: no such load
};

struct SecondOrderResponses {
  std::vector<SecondOrderResponse> signals;  ///< those of [ask.rao], in its order
  double error = 0;                          ///< estimated, of the moments, relative
  std::vector<std::string> notes;            ///< what is supposed, and what is left out
};

/// Of the bodies with `[body.second_order]`; none where no body has it. Linear in these loads: through the stiffness
/// about rest and, at their frequencies, through (Q1); first- and second-order parts of a Gaussian sea are
/// uncorrelated, so that variances add. Frequencies are put until moments are within the scene's `accuracy`. Drag on
/// members is linear for the velocities of waves, slow drift and sums together (D151); `first_order`: frequencies,
/// rad/s, at which those of waves are resolved, none: those of [ask.rao]. \throws hydro::InputError as
/// SecondOrderLoads; where more of the pairs' energy than `accuracy` has sums or differences above the coefficients;
/// hydro::NumericsError naming the motion that nothing holds against a constant load, for a motion without damping, and
/// where drag does not settle
std::optional<SecondOrderResponses> second_order_responses(
    const scene::Scene& scene, const std::shared_ptr<compile::Kept>& kept = std::make_shared<compile::Kept>(),
    const std::vector<double>& first_order = {});

}  // namespace froude
