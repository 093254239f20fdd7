#pragma once
/// \file  Waves that meet: groups focused at a place and time, and how to find one in a list of components.
/// Equations (W25)-(W28), docs/theory/waves.md.
#include <complex>
#include <span>
#include <vector>

#include "hydro/waves/kinematics/sea.hpp"

namespace hydro::waves {

/// A place and a time, global axes.
struct Focus {
  double x_m = 0, y_m = 0, t_s = 0;
};

/// NewWave: the most probable shape of the sea around a crest of height `crest_m` at the focus (W25), which is the
/// crest times the autocorrelation of the sea (Lindgren 1970; Tromans, Anaturk & Hagemeijer 1991). Same frequencies and
/// headings as `sea`; its phases play no part.
/// \throws InputError unless crest_m is finite and the sea has energy
Sea new_wave(const Sea& sea, double crest_m, const Focus& focus);

/// The random sea with a crest of exactly this height put in at the focus: ζ = crest_m and ∂ζ/∂t = 0 there, and far
/// from it the sea as it was (W26), after Taylor, Jonathan & Harland (1997). \throws as new_wave
Sea constrained_new_wave(const Sea& sea, double crest_m, const Focus& focus);

/// A group of regular waves that a paddle makes: 3.5 waves long, growing over the first and dying over the last of
/// them, whose middle comes to the focus with a crest (W27), after Van Zanten (2020), section 3.2.
struct Packet {
  WaveAmplitude amplitude;
  AngularFrequency omega;
};

/// Packets that meet at a focus, each with its own group velocity. Within a packet crests run at the phase velocity.
///
/// Linear waves under an envelope: velocity and pressure are those of a regular wave times the envelope, and the
/// acceleration is the exact derivative of that velocity. The flow keeps its volume only as far as the envelope is long
/// compared to the wave: ∇·u is up to 1/3.5 of its gradients in the ramps.
class PacketField final : public WaveField {
 public:
  static constexpr double waves = 3.5;  ///< length of a packet, from first to last motion

  /// \throws InputError for an empty list
  PacketField(std::span<const Packet> packets, const Focus& focus, Angle heading, const Water& water,
              Stretching stretching = Stretching::vertical);

  const Water& water() const noexcept override { return water_; }
  using WaveField::at;
  double elevation(double t_s, double x_m, double y_m) const override;
  Kinematics at(double t_s, const Eigen::Vector3d& point) const override;

  /// Group velocity of each packet, m/s.
  std::vector<double> group_velocities() const;
  /// When the first packet reaches a distance of the focus, and when the last has left it, along the heading, s.
  struct Stay {
    double from_s, to_s;
  };
  Stay stay(double distance_m) const;

 private:
  struct Train {
    double omega, k, group_velocity, amplitude;
  };
  double along(double x_m, double y_m) const;
  std::vector<Train> trains_;
  Focus focus_;
  double cos_heading_, sin_heading_, hs_;
  Water water_;
  Stretching stretching_;
};

/// The envelope of a packet and its derivative: `s` in periods from the middle; 1 for |s| <= 3/4, a half cosine to zero
/// at |s| = 7/4 (W27).
struct Envelope {
  double value, slope;
};
Envelope packet_envelope(double s);

/// The chance that a Gaussian sea with these components has a crest as high at one place within this time (W28).
double chance_of_crest(const Sea& sea, double crest_m, double duration_s);

/// How far the waves of a sea come together at one place (W28).
struct FocusFound {
  double t_s;         ///< when the envelope is greatest
  double envelope_m;  ///< |Σ a_j e^{i(ω_j t + φ_j − k_j·x)}| then
  double share;       ///< of Σ a_j: 1 where all are in phase
  double crest_t_s, crest_m;
  double probability;  ///< that a Gaussian sea with these components has a crest as high within the time searched
};
/// Searches the time from `from_s` to `to_s` at a place. Below a probability of one in a thousand the components have
/// been put in phase, or chance has done it. \throws InputError unless from_s < to_s
FocusFound find_focus(const Sea& sea, double x_m, double y_m, double from_s, double to_s);

}  // namespace hydro::waves
