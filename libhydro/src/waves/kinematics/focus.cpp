#include "hydro/waves/kinematics/focus.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hydro/waves/dispersion.hpp"

namespace hydro::waves {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

double energy(const Component& w) { return w.amplitude * w.amplitude / 2; }

double total_energy(const Sea& sea, double crest_m) {
  require(std::isfinite(crest_m), "the height of a crest must be finite, got {} m", crest_m);
  double sum = 0;
  for (const Component& w : sea.components()) sum += energy(w);
  require(sum > 0, "a sea without energy has no most probable wave");
  return sum;
}

// e^{i(ωt − k·x)} of a component at the focus.
Complex turn_at(const Component& w, const Focus& focus) {
  return std::polar(1.0, w.omega * focus.t_s) * elevation_transfer(w, focus.x_m, focus.y_m);
}

}  // namespace

Sea new_wave(const Sea& sea, double crest_m, const Focus& focus) {
  const double m0 = total_energy(sea, crest_m);
  std::vector<Complex> amplitudes;
  for (const Component& w : sea.components())
    amplitudes.push_back(crest_m * energy(w) / m0 * std::conj(turn_at(w, focus)));  // (W25)
  return sea.with_amplitudes(amplitudes);
}

Sea constrained_new_wave(const Sea& sea, double crest_m, const Focus& focus) {
  const double m0 = total_energy(sea, crest_m);
  double m2 = 0, elevation = 0, rate = 0;  // what the random sea does at the focus
  for (const Component& w : sea.components()) {
    const Complex there = std::polar(w.amplitude, w.phase) * turn_at(w, focus);
    m2 += energy(w) * w.omega * w.omega;
    elevation += there.real();
    rate -= w.omega * there.imag();
  }
  std::vector<Complex> amplitudes;
  for (const Component& w : sea.components()) {
    // (W26): the missing height times the autocorrelation, and the rate taken away by its derivative.
    const Complex correction((crest_m - elevation) / m0, rate * w.omega / m2);
    amplitudes.push_back(std::polar(w.amplitude, w.phase) + energy(w) * correction * std::conj(turn_at(w, focus)));
  }
  return sea.with_amplitudes(amplitudes);
}

Envelope packet_envelope(double s) {
  constexpr double half = PacketField::waves / 2, flat = half - 1;
  const double distance = std::abs(s);
  if (distance >= half) return {0, 0};
  if (distance <= flat) return {1, 0};
  const double phase = pi * (distance - flat);
  return {0.5 * (1 + std::cos(phase)), std::copysign(0.5 * pi * std::sin(phase), -s)};  // falls away from the middle
}

PacketField::PacketField(std::span<const Packet> packets, const Focus& focus, Angle heading, const Water& water,
                         Stretching stretching)
    : focus_(focus),
      cos_heading_(std::cos(heading.radians())),
      sin_heading_(std::sin(heading.radians())),
      hs_(0),
      water_(water),
      stretching_(stretching) {
  require(!packets.empty(), "a focused group needs at least one packet, got an empty list");
  double energy_sum = 0;
  for (const Packet& p : packets) {
    const double omega = p.omega.rad_per_s(), a = p.amplitude.metres();
    trains_.push_back({omega, wavenumber(omega, water), group_velocity(omega, water), a});
    energy_sum += a * a / 2;
  }
  hs_ = 4 * std::sqrt(energy_sum);
}

double PacketField::along(double x, double y) const {
  return (x - focus_.x_m) * cos_heading_ + (y - focus_.y_m) * sin_heading_;
}

double PacketField::elevation(double t, double x, double y) const {
  const double distance = along(x, y), after = t - focus_.t_s;
  double sum = 0;
  for (const Train& w : trains_) {
    const double s = (after - distance / w.group_velocity) * w.omega / (2 * pi);
    sum += w.amplitude * packet_envelope(s).value * std::cos(w.omega * after - w.k * distance);
  }
  return sum;
}

Kinematics PacketField::at(double t, const Eigen::Vector3d& point) const {
  const double h = water_.depth.metres();
  require(point.z() >= -h, "a point at z = {} m lies below the bed at z = {} m", point.z(), -h);
  Kinematics out{};
  out.elevation = elevation(t, point.x(), point.y());
  const StretchedHeight height = stretched_height(stretching_, point.z(), out.elevation, h, hs_);
  const double distance = along(point.x(), point.y()), after = t - focus_.t_s;
  // Along the heading and up; afterwards turned into global axes.
  double u = 0, w = 0, u_t = 0, w_t = 0, u_s = 0, w_s = 0, u_z = 0, w_z = 0, p = 0;
  for (const Train& train : trains_) {
    const double rate = train.omega / (2 * pi);  // of s per second
    const Envelope e = packet_envelope((after - distance / train.group_velocity) * rate);
    DepthProfile profile = depth_profile(train.k, h, height.z);
    if (height.tangent > 0)
      profile = {profile.cosh + height.tangent * train.k * profile.sinh,
                 profile.sinh + height.tangent * train.k * profile.cosh};
    const double g_over_c = water_.gravity * train.k / train.omega * train.amplitude;
    const double angle = train.omega * after - train.k * distance, c = std::cos(angle), s = std::sin(angle);
    const double along_u = g_over_c * profile.cosh, up_w = -g_over_c * profile.sinh;
    u += e.value * along_u * c;
    w += e.value * up_w * s;
    u_t += along_u * (e.slope * rate * c - e.value * train.omega * s);
    w_t += up_w * (e.slope * rate * s + e.value * train.omega * c);
    const double slope_along = -e.slope * rate / train.group_velocity;
    u_s += along_u * (slope_along * c + e.value * train.k * s);
    w_s += up_w * (slope_along * s - e.value * train.k * c);
    u_z += e.value * g_over_c * train.k * profile.sinh * c;
    w_z -= e.value * g_over_c * train.k * profile.cosh * s;
    p += water_.density * water_.gravity * train.amplitude * e.value * profile.cosh * c;
  }
  const Eigen::Vector3d ahead(cos_heading_, sin_heading_, 0), up(0, 0, 1);
  out.velocity = u * ahead + w * up;
  out.acceleration = u_t * ahead + w_t * up;
  out.gradient = (u_s * ahead + w_s * up) * ahead.transpose() + (u_z * ahead + w_z * up) * up.transpose();
  out.dynamic_pressure = p;
  return out;
}

std::vector<double> PacketField::group_velocities() const {
  std::vector<double> out;
  for (const Train& w : trains_) out.push_back(w.group_velocity);
  return out;
}

PacketField::Stay PacketField::stay(double distance_m) const {
  Stay out{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Train& w : trains_) {
    const double middle = focus_.t_s + distance_m / w.group_velocity, half = waves / 2 * 2 * pi / w.omega;
    out = {std::min(out.from_s, middle - half), std::max(out.to_s, middle + half)};
  }
  return out;
}

double chance_of_crest(const Sea& sea, double crest_m, double duration_s) {
  double m0 = 0, m2 = 0;
  for (const Component& w : sea.components()) {
    m0 += energy(w);
    m2 += energy(w) * w.omega * w.omega;
  }
  if (m0 == 0) return crest_m > 0 ? 0 : 1;
  // Rayleigh crests, one a mean up-crossing period.
  const double waves = std::max(1.0, duration_s * std::sqrt(m2 / m0) / (2 * pi)), crest = std::max(0.0, crest_m);
  return -std::expm1(waves * std::log1p(-std::exp(-crest * crest / (2 * m0))));
}

FocusFound find_focus(const Sea& sea, double x_m, double y_m, double from_s, double to_s) {
  require(std::isfinite(from_s) && std::isfinite(to_s) && from_s < to_s,
          "a focus is searched between two times, the first before the second; got {} s and {} s", from_s, to_s);
  double highest = 0, all = 0;
  std::vector<Complex> at_place;
  for (const Component& w : sea.components()) {
    at_place.push_back(std::polar(w.amplitude, w.phase) * elevation_transfer(w, x_m, y_m));
    highest = std::max(highest, w.omega);
    all += w.amplitude;
  }
  const auto sum_at_time = [&](double t) {
    Complex sum = 0;
    for (std::size_t j = 0; j < at_place.size(); ++j)
      sum += at_place[j] * std::polar(1.0, sea.components()[j].omega * t);
    return sum;
  };
  FocusFound out{from_s, -1, 0, from_s, -std::numeric_limits<double>::infinity(), 1};
  // Forty samples in the shortest period: a crest is missed by 1 − cos(π/40) = 0.3 % at most.
  const double intervals = std::ceil((to_s - from_s) * highest / (2 * pi) * 40);
  constexpr double most = 3e8;  // sines: some seconds
  if (!(intervals * static_cast<double>(at_place.size()) <= most))
    throw InputError(
        fmt::format("a focus between {:.4g} s and {:.4g} s of {} waves, the shortest of {:.4g} s, would be "
                    "searched at {:.3g} instants",
                    from_s, to_s, at_place.size(), 2 * pi / highest, intervals),
        {}, "look at the longest and the shortest period, or search in a shorter time");
  const auto samples = static_cast<std::size_t>(intervals) + 1;
  for (std::size_t n = 0; n < samples; ++n) {
    const double t = from_s + (to_s - from_s) * static_cast<double>(n) / static_cast<double>(samples - 1);
    const Complex sum = sum_at_time(t);
    if (std::abs(sum) > out.envelope_m) out.t_s = t, out.envelope_m = std::abs(sum);
    if (sum.real() > out.crest_m) out.crest_t_s = t, out.crest_m = sum.real();
  }
  if (all == 0) return out;
  out.share = out.envelope_m / all;
  out.probability = chance_of_crest(sea, out.crest_m, to_s - from_s);
  return out;
}

}  // namespace hydro::waves
