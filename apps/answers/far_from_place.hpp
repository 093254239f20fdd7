#pragma once
/// \file  How far bodies go from where their hydrodynamic coefficients are told: at rest, as placed.
#include <optional>
#include <string>
#include <vector>

#include "dynamics/state/body.hpp"
#include "hydro/base/state_bytes.hpp"
#include "hydro/waves/kinematics/sea.hpp"
#include "scene/scene.hpp"

namespace froude {

/// Watches the bodies of a run whose loads are by coefficients; others cost nothing.
class FarFromPlace {
 public:
  FarFromPlace(const scene::Scene& scene, const std::optional<hydro::waves::Sea>& sea);

  void look(const dynamics::State& state);
  void keep_state(hydro::StateBytes& bytes);
  /// What coefficients no longer hold, and by how much each body has left the place for which they do.
  std::vector<std::string> told() const;

 private:
  /// The most that a body has come off, and when.
  struct Farthest {
    double value = 0, time = 0;  // rad or m, s
    void note(double now, double at) {
      if (now > value) *this = {now, at};
    }
  };
  struct Watched {
    std::size_t body;
    const scene::Body* given;
    std::string as_placed;  ///< "excitation, radiation": what knows no other place
    bool yaw_matters;       ///< to these: it is no body of revolution
    Farthest turn, way;
  };
  std::vector<Watched> watched_;
  double wave_length_ = 0;  // m, mean over the energy; 0: no waves
};

}  // namespace froude
