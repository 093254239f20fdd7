#pragma once
/// \file  Private to apps: how large effects are that a linear response leaves out, by that response. (D144)-(D147)
#include <optional>
#include <string>
#include <vector>

#include "answers/linear_response.hpp"
#include "compile/compile.hpp"
#include "compile/members.hpp"
#include "dynamics/force/contact.hpp"
#include "dynamics/frequency/drag_size.hpp"
#include "dynamics/frequency/friction_size.hpp"
#include "dynamics/frequency/load_departure.hpp"

namespace froude {

/// Height of the waves of a scene, m: of regular waves, or the significant one of a random sea. None of other waves,
/// whose record or list has no single height.
std::optional<double> own_wave_height(const scene::Scene& scene);

/// Drag of members beside the wave loads, motions of bodies that may touch beside the gap between them,
/// friction of joints beside the loads that would hold them, and loads beside their linear part.
class SizeLeftOut {
 public:
  /// All must live as long. `drag_is_kept`: it is linear in these responses.
  SizeLeftOut(const scene::Scene& scene, const compile::Prepared& prepared,
              const dynamics::frequency::SmallMotions& about, bool drag_is_kept);
  SizeLeftOut(const SizeLeftOut&) = delete;
  SizeLeftOut& operator=(const SizeLeftOut&) = delete;

  /// Takes responses into account; several times where frequencies come one after the other.
  void take(const Cells& cells, const dynamics::frequency::Amplitudes& found);

  /// One sentence for each effect: the height of waves, m, in which it counts, and its size in waves as high as those
  /// of the scene.
  std::vector<std::string> told() const;

 private:
  /// Of one contact.
  struct Gap {
    std::string name;
    double at_rest;  ///< m
    dynamics::Variation variation;
    double amplitude = 0, omega = 0;  ///< the largest, m per metre of wave amplitude, and where it is, rad/s
  };

  void find_members(const scene::Scene& scene, const compile::Prepared& prepared, bool drag_is_kept);
  void find_joints(const compile::Prepared& prepared);
  void find_gaps(const compile::Prepared& prepared);
  void take_loads(double omega, double heading, const Eigen::VectorXcd& xi);
  bool own_waves_break(double omega) const;
  void take_departure(double omega, const Eigen::VectorXcd& xi, const Eigen::VectorXcd& X);
  std::string drag_told() const;
  std::string contacts_told() const;
  std::string friction_told() const;
  std::string departure_told() const;
  /// "; in waves as high as those of the scene, 2 m, …", of their amplitude, m; empty where they have no height.
  template <class Tell>
  std::string in_own_waves(Tell tell) const;

  const dynamics::frequency::SmallMotions& about_;
  const std::vector<dynamics::frequency::PotentialGroup>& groups_;
  hydro::Water water_;
  std::optional<double> height_;              ///< of the scene's own waves, m
  std::vector<dynamics::DragPiece> dragged_;  ///< whose drag is left out
  std::optional<dynamics::frequency::DragLeftOut> drag_;
  bool impacts_ = false;
  std::vector<dynamics::Friction> rubbing_;
  bool latches_ = false;
  std::optional<dynamics::frequency::FrictionLeftOut> friction_;
  std::optional<dynamics::frequency::DepartureFromLinear> departure_;
  std::string no_departure_;  ///< why it cannot be told
  std::vector<Gap> gaps_;
};

}  // namespace froude
