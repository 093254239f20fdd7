#include "hydro/waves/synthesis/summed_field.hpp"

#include <array>
#include <numbers>
#include <vector>

#include "field_number.hpp"
#include "synth_flow.hpp"
#include "synth_phase.hpp"
#include "synth_simd.hpp"

namespace hydro::waves {
namespace {

using simd::lanes;
using simd::Pack;

/// Rows of a table of harmonics: one number each, padded with waves of no size.
enum Row : std::size_t {
  turns_a,  // ω/2π as three parts, the first of 26 bits (W90)
  turns_b,
  turns_low,
  turns_x,  // k_x/2π
  turns_y,
  elevation_re,
  elevation_im,
  potential_re,
  potential_im,
  omega,
  k_x,
  k_y,
  kappa,
  inverse_depth_factor,  // 1/(1 + e^{−2κh})
  rows
};

FROUDE_INLINE void without_turns(Pack& x) { x = x - ((x + simd::whole_only) - simd::whole_only); }

// ω_j t/2π modulo one. Products of the parts are exact, so late times lose nothing.
FROUDE_KERNEL void turn_in_time(const double* table, std::size_t count, double t, double* turns) {
  const double ta = phase::leading(t), tb = t - ta;
  for (std::size_t j = 0; j < count; j += lanes) {
    Pack a, b, low;
    simd::load(table + turns_a * count + j, a);
    simd::load(table + turns_b * count + j, b);
    simd::load(table + turns_low * count + j, low);
    Pack sum = a * ta, second = a * tb, third = b * ta;
    without_turns(sum);
    without_turns(second);
    without_turns(third);
    sum = sum + second + third + (b * tb + low * t);
    simd::store(sum, turns + j);
  }
}

// cos and sin of ωt − k·x for all harmonics, kept for the flow; returns ζ.
FROUDE_KERNEL double turn_in_place(const double* table, std::size_t count, const double* turns, double x, double y,
                                   double* cosine, double* sine) {
  Pack zeta{};
  for (std::size_t j = 0; j < count; j += lanes) {
    Pack p, kx, ky, re, im, s, c;
    simd::load(turns + j, p);
    simd::load(table + turns_x * count + j, kx);
    simd::load(table + turns_y * count + j, ky);
    simd::load(table + elevation_re * count + j, re);
    simd::load(table + elevation_im * count + j, im);
    p = p - kx * x - ky * y;
    simd::sincos_turns(p, s, c);
    zeta += re * c - im * s;
    if (cosine != nullptr) {
      simd::store(c, cosine + j);
      simd::store(s, sine + j);
    }
  }
  return simd::sum(zeta);
}

// (W12) at height z: cosh κ(z+h)/cosh κh and sinh κ(z+h)/cosh κh; in deep water both are e^{κz}.
FROUDE_INLINE void depth_profiles(const Pack& k, const Pack& factor, double z, double depth, Pack& ch, Pack& sh) {
  Pack growth;
  simd::exponential(k * z, growth);
  ch = sh = growth * factor;
  if (depth > 1e300) return;
  Pack mirrored;
  simd::exponential(k * (-2 * (z + depth)), mirrored);
  sh = ch - ch * mirrored;
  ch = ch + ch * mirrored;
}

// (W17) summed at the height z, beyond which the tangent goes on.
FROUDE_KERNEL void sum_flow(const double* table, std::size_t count, const double* cosine, const double* sine, double z,
                            double tangent, double depth, Flow& flow) {
  Pack ux{}, uy{}, uz{}, ax{}, ay{}, az{}, rate{}, xx{}, yy{}, xy{}, xz{}, yz{};
  for (std::size_t j = 0; j < count; j += lanes) {
    Pack c, s, re, im, w, kx, ky, k, factor, ch, sh;
    simd::load(cosine + j, c);
    simd::load(sine + j, s);
    simd::load(table + potential_re * count + j, re);
    simd::load(table + potential_im * count + j, im);
    simd::load(table + omega * count + j, w);
    simd::load(table + k_x * count + j, kx);
    simd::load(table + k_y * count + j, ky);
    simd::load(table + kappa * count + j, k);
    simd::load(table + inverse_depth_factor * count + j, factor);
    depth_profiles(k, factor, z, depth, ch, sh);
    const Pack cosh_part = ch + tangent * k * sh;
    sh = (sh + tangent * k * ch) * k;
    const Pack real = re * c - im * s, imaginary = re * s + im * c;
    const Pack even_re = real * cosh_part, even_im = imaginary * cosh_part, odd_re = real * sh, odd_im = imaginary * sh;
    ux += kx * even_im;
    uy += ky * even_im;
    uz += odd_re;
    ax += w * kx * even_re;
    ay += w * ky * even_re;
    az -= w * odd_im;
    rate -= w * even_im;
    xx -= kx * kx * even_re;
    yy -= ky * ky * even_re;
    xy -= kx * ky * even_re;
    xz += kx * odd_im;
    yz += ky * odd_im;
  }
  flow = {simd::sum(ux),   simd::sum(uy), simd::sum(uz), simd::sum(ax), simd::sum(ay), simd::sum(az),
          simd::sum(rate), simd::sum(xx), simd::sum(yy), simd::sum(xy), simd::sum(xz), simd::sum(yz)};
}

}  // namespace

struct SummedField::Content {
  Surroundings around;
  std::size_t count;          // harmonics, padded to whole packs
  std::vector<double> table;  // (rows, count)
  std::uint64_t number;       // of all that there were in this program
};

namespace {

std::vector<double> table_of(const HarmonicField& field, std::size_t count) {
  const double h = field.water().depth.metres();
  std::vector<double> table(rows * count, 0.0);
  for (std::size_t j = 0; j < field.harmonics().size(); ++j) {
    const Harmonic& w = field.harmonics()[j];
    const phase::Turns time = phase::per_second(w.omega);
    const double k = std::hypot(w.kx, w.ky);
    // Without a wave vector the profile is one at every height.
    const double depth_factor = k > 0 ? 1 / (1 + std::exp(-2 * k * h)) : std::isinf(h) ? 1 : 0.5;
    const double a = phase::leading(time.high);
    const std::array<double, rows> row{a,
                                       time.high - a,
                                       time.low,
                                       phase::per_second(w.kx).high,
                                       phase::per_second(w.ky).high,
                                       w.elevation.real(),
                                       w.elevation.imag(),
                                       w.potential.real(),
                                       w.potential.imag(),
                                       w.omega,
                                       w.kx,
                                       w.ky,
                                       k,
                                       depth_factor};
    for (std::size_t r = 0; r < rows; ++r) table[r * count + j] = row[r];
  }
  return table;
}

/// Turns at one instant, cosines and sines at one place. Each thread keeps one, so that the steps of a run ask for no
/// memory, and turns only when another instant is asked for.
class Scratch {
 public:
  static Scratch& of_thread() {
    thread_local Scratch scratch;
    return scratch;
  }
  void turn(std::uint64_t field, const double* table, std::size_t count, double t) {
    if (field == field_ && t == t_) return;
    if (values_.size() < 3 * count) values_.resize(3 * count);
    count_ = count;
    turn_in_time(table, count, t, values_.data());
    field_ = field;
    t_ = t;
  }
  const double* turns() const { return values_.data(); }
  double* cosine() { return values_.data() + count_; }
  double* sine() { return cosine() + count_; }

 private:
  std::vector<double> values_;
  std::size_t count_ = 0;
  std::uint64_t field_ = 0;  // whose turns they are; 0: none
  double t_ = 0;
};

}  // namespace

SummedField::SummedField(const HarmonicField& field) {
  const std::size_t count = simd::padded(field.harmonics().size());
  content_ = std::make_unique<const Content>(
      Content{{field.water(), field.options(), field.current()}, count, table_of(field, count), next_field_number()});
}
SummedField::~SummedField() = default;
SummedField::SummedField(SummedField&&) noexcept = default;
SummedField& SummedField::operator=(SummedField&&) noexcept = default;

const Water& SummedField::water() const noexcept { return content_->around.water; }

double SummedField::elevation(double t, double x, double y) const {
  const Eigen::Vector2d place(x, y);
  double out;
  elevations(t, {&place, 1}, {&out, 1});
  return out;
}

void SummedField::elevations(double t, std::span<const Eigen::Vector2d> at, std::span<double> out) const {
  require(at.size() == out.size(), "{} places need as many for the answer, got {}", at.size(), out.size());
  const Content& c = *content_;
  Scratch& s = Scratch::of_thread();
  s.turn(c.number, c.table.data(), c.count, t);
  for (std::size_t i = 0; i < at.size(); ++i)
    out[i] = turn_in_place(c.table.data(), c.count, s.turns(), at[i].x(), at[i].y(), nullptr, nullptr);
}

Kinematics SummedField::at(double t, const Eigen::Vector3d& point) const {
  Kinematics out;
  at(t, {&point, 1}, {&out, 1});
  return out;
}

void SummedField::at(double t, std::span<const Eigen::Vector3d> points, std::span<Kinematics> out) const {
  require(points.size() == out.size(), "{} points need as many places for the answer, got {}", points.size(),
          out.size());
  const Content& c = *content_;
  const double h = c.around.water.depth.metres();
  Scratch& s = Scratch::of_thread();
  s.turn(c.number, c.table.data(), c.count, t);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d& p = points[i];
    const double zeta = turn_in_place(c.table.data(), c.count, s.turns(), p.x(), p.y(), s.cosine(), s.sine());
    const StretchedHeight height = c.around.stretched(p.z(), zeta);
    Flow flow;
    sum_flow(c.table.data(), c.count, s.cosine(), s.sine(), height.z, height.tangent, h, flow);
    out[i] = c.around.kinematics(flow, p.z(), zeta);
  }
}

}  // namespace hydro::waves
