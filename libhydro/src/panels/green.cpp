#include "green.hpp"

#include <cmath>
#include <numbers>

#include "deep_wave.hpp"
#include "wave_bessel.hpp"

namespace hydro::panels {

using std::numbers::pi;

WaveGreen::WaveGreen(double K, const WaterDepth& depth, double reach) : K_(K), h_(depth.metres()) {
  if (!depth.is_infinite()) bed_.emplace(K, h_, reach);
}

double WaveGreen::image_sign() const { return std::isinf(K_) ? -1 : 1; }

WaveHeight WaveGreen::height(double z) const {
  if (std::isinf(K_)) return {z, 0, 0, 0};
  return {z, std::exp(K_ * z), bed_ ? bed_->profile(-z) : 0, bed_ ? std::tanh(bed_->k() * (z + h_)) : 1};
}

WavePart WaveGreen::operator()(double R, const WaveHeight& P, const WaveHeight& Q) const {
  return bed_ ? over_bed(R, P, Q) : deep(R, P, Q);
}

/// 2K(F − iπe^{−KY}J₀(KR)).
WavePart WaveGreen::deep(double R, const WaveHeight& P, const WaveHeight& Q) const {
  const BesselPair J = bessel_j(K_ * R);
  const double decay = P.decay * Q.decay;
  const DeepWave w = deep_wave(K_ * R, -K_ * (P.z + Q.z), decay, J);
  const double e = pi * decay, twice = 2 * K_;
  return {.G = {twice * w.F, -twice * e * J.order0},
          .G_R = {twice * K_ * w.F_X, twice * K_ * e * J.order1},
          .G_zeta = {-twice * K_ * w.F_Y, -twice * K_ * e * J.order0}};
}

WavePart WaveGreen::over_bed(double R, const WaveHeight& P, const WaveHeight& Q) const {
  const double z = P.z, zeta = Q.z;
  const bool waves = !std::isinf(K_);
  double G = 0, G_R = 0, G_zeta = 0;
  std::optional<BesselPair> of_deep;  // the same for both images
  // V₁ = z + ζ + 2h grows with ζ, V₂ = |z − ζ| with the sign of ζ − z.
  for (const bool second : {false, true}) {
    const double V = second ? std::abs(z - zeta) : z + zeta + 2 * h_, Y = 2 * h_ - V;
    const double grows = second && z > zeta ? -1 : 1;
    const BedWave d = (*bed_)(R, V);
    G += d.d;
    G_R += d.d_R;
    G_zeta += grows * d.d_V;
    if (waves && !d.whole) {
      if (!of_deep) of_deep = bessel_j(K_ * R);
      const DeepWave w = deep_wave(K_ * R, K_ * Y, second ? std::exp(-K_ * Y) : P.decay * Q.decay, *of_deep);
      G += 2 * K_ * w.F;
      G_R += 2 * K_ * K_ * w.F_X;
      G_zeta -= grows * 2 * K_ * K_ * w.F_Y;
    }
    // Of V₁ this is the image in the surface, which is left out; of V₂ an image of an image, at least a depth away.
    const double image = image_sign() * ((second ? 1 : 0) - (d.whole ? 1 : 0));
    if (image == 0) continue;
    const double r = std::hypot(R, Y), over_cube = image / (r * r * r);
    G += image / r;
    G_R -= over_cube * R;
    G_zeta += grows * over_cube * Y;
  }
  if (!waves) return {G, G_R, G_zeta};
  const double k = bed_->k(), wave = 2 * pi * P.profile * Q.profile;
  const BesselPair J = bessel_j(k * R);
  return {
      .G = {G, -wave * J.order0}, .G_R = {G_R, wave * k * J.order1}, .G_zeta = {G_zeta, -wave * k * Q.rise * J.order0}};
}

}  // namespace hydro::panels
