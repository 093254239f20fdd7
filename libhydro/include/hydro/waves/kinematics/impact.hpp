#pragma once
/// \file  A horizontal cylinder that water runs into: how much of it is wet, and the force of the impact.
///        Equations (W80)-(W86), docs/theory/impact.md.

namespace hydro::waves {

/// The wetness of Van Zanten (2020, eq. 2.16): the height of the surface above the lowest point of a circle as a share
/// of its diameter, 0 … 1 (W80). \throws InputError unless diameter_m is finite and > 0 and heights are finite
double wetness_by_height(double elevation_m, double centre_z_m, double diameter_m);

/// The part of a circle below a plane surface, exactly (W81). Errors as above.
struct WetCircle {
  double area_share;  ///< of πD²/4, 0 … 1
  double arc_share;   ///< of πD, 0 … 1
  double chord;       ///< width of the circle at the surface, m
};
WetCircle wet_circle(double elevation_m, double centre_z_m, double diameter_m);

enum class ImpactTheory {
  von_karman,       ///< added mass of the plate below the undisturbed surface (von Kármán 1929), (W82)
  goda,             ///< the same force on each metre of length (Goda et al. 1966; Van Zanten 2.19), (W83)
  wienke_oumeraci,  ///< water piled up beside the body, and Bernoulli's quadratic term (2005), (W84), (W85)
};

/// Impact of water on a cylinder, broadside, per metre of its length. The speed is that at the instant of contact and
/// stays so. A pure function of the time since contact.
class CylinderImpact {
 public:
  /// \throws InputError unless all are finite, radius and density > 0 and speed >= 0 (water that runs away from the
  /// cylinder does not strike it)
  CylinderImpact(ImpactTheory theory, double radius_m, double speed_m_per_s, double density);

  /// N/m along the speed; zero before contact and from duration() on. At contact it jumps to πρRV², or to 2πρRV² for
  /// Wienke and Oumeraci: the limit of their formula, which is itself 0·∞ there.
  double force(double since_contact_s) const;
  /// ∫ force from contact, N s/m, closed but for the second branch of Wienke and Oumeraci; error 1e-13 relative (W86).
  double impulse(double since_contact_s) const;
  /// Half the width that is wet, m; grows to the radius at duration().
  double half_width(double since_contact_s) const;
  /// R/V, or 13R/32V for Wienke and Oumeraci, s; +∞ at no speed.
  double duration() const;

 private:
  double scaled_time(double since_contact_s) const;
  ImpactTheory theory_;
  double radius_, speed_, density_;
};

}  // namespace hydro::waves
