#include "hydro/waves/kinematics/sea.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydro/base/random.hpp"

namespace hydro::waves {
namespace {

/// A piece of the band, the number that its random numbers go by, and where its component stands.
struct Bin {
  double from, to, omega;
  std::size_t number;
};

void require_band(const Discretisation& cut) {
  require(std::isfinite(cut.omega_max) && cut.omega_min >= 0 && cut.omega_min < cut.omega_max,
          "a frequency band needs 0 <= omega_min < omega_max, got {} and {} rad/s", cut.omega_min, cut.omega_max);
}

void require_bins(std::size_t count) { require(count > 0, "a sea needs at least one component, got a count of 0"); }

// (W9): the multiples j ≥ 1 of Δω inside the band. A band edge that is a multiple but for rounding counts as inside.
std::vector<Bin> cut_up(const FftGrid& grid, const Spectrum&, const Discretisation& cut) {
  require(std::isfinite(grid.repetition_s) && grid.repetition_s > 0,
          "the repetition period must be finite and positive, got {} s", grid.repetition_s);
  const double d_omega = 2 * std::numbers::pi / grid.repetition_s;
  constexpr double rounding = 1e-9;
  const double first = std::max(1.0, std::ceil(cut.omega_min / d_omega - rounding));
  const double last = std::floor(cut.omega_max / d_omega + rounding);
  if (first > last)
    throw InputError(
        fmt::format("no multiple of {} rad/s (2π over the repetition period of {} s) lies between {} and {} rad/s",
                    d_omega, grid.repetition_s, cut.omega_min, cut.omega_max),
        {}, "give a longer repetition period or a wider band");
  std::vector<Bin> bins;
  for (double j = first; j <= last; ++j)
    bins.push_back({(j - 0.5) * d_omega, (j + 0.5) * d_omega, j * d_omega, static_cast<std::size_t>(j)});
  return bins;
}

// (W23): each component stands at the mean frequency m_1/m_0 of its bin, so that m_1 is kept as well.
std::vector<Bin> cut_up(const EqualEnergy& equal, const Spectrum& spectrum, const Discretisation& cut) {
  require_bins(equal.count);
  const double all = spectrum.energy(cut.omega_min, cut.omega_max);
  require(all > 0, "the spectrum has no energy between {} and {} rad/s", cut.omega_min, cut.omega_max);
  std::vector<Bin> bins;
  double from = cut.omega_min;
  for (std::size_t i = 0; i < equal.count; ++i) {
    const double share = static_cast<double>(i + 1) / static_cast<double>(equal.count);
    const double to =
        i + 1 == equal.count ? cut.omega_max : spectrum.omega_at_energy(share * all, cut.omega_min, cut.omega_max);
    bins.push_back({from, to, spectrum.band_moment(1, from, to) / spectrum.energy(from, to), i});
    from = to;
  }
  return bins;
}

std::vector<Bin> cut_up(const RandomInBin& random, const Spectrum&, const Discretisation& cut) {
  require_bins(random.count);
  const RandomStream places(cut.seed, frequency_stream);
  const double width = (cut.omega_max - cut.omega_min) / static_cast<double>(random.count);
  std::vector<Bin> bins;
  for (std::size_t i = 0; i < random.count; ++i) {
    const double from = cut.omega_min + width * static_cast<double>(i);
    bins.push_back({from, from + width, from + width * places.uniform(i), i});
  }
  return bins;
}

}  // namespace

void Sea::add(const GivenWave& wave) {
  const double omega = wave.omega.rad_per_s();
  require(std::isfinite(wave.phase), "the phase of a wave must be finite, got {} rad", wave.phase);
  const DopplerWave on_current = doppler(omega, wave.heading, current_, water_);
  components_.push_back({.omega = omega,
                         .k = on_current.k,
                         .sigma = on_current.sigma,
                         .amplitude = wave.amplitude.metres(),
                         .phase = wave.phase,
                         .heading = wave.heading.radians()});
}

Sea Sea::regular(WaveAmplitude amplitude, AngularFrequency omega, Angle heading, const Water& water, double phase_rad,
                 const Current& current) {
  Sea sea(water, current, omega.period_s());
  sea.add({omega, amplitude, phase_rad, heading});
  sea.index_ = {1};
  return sea;
}

Sea Sea::of(std::span<const GivenWave> waves, const Water& water, const Current& current) {
  require(!waves.empty(), "a sea needs at least one wave, got an empty list");
  Sea sea(water, current, std::numeric_limits<double>::infinity());
  for (const GivenWave& wave : waves) sea.add(wave);
  return sea;
}

Sea Sea::irregular(const Spectrum& spectrum, const Discretisation& cut, const Directions& directions,
                   const Water& water, const Current& current) {
  require_band(cut);
  const auto bins = std::visit([&](const auto& how) { return cut_up(how, spectrum, cut); }, cut.bins);
  const auto* grid = std::get_if<FftGrid>(&cut.bins);
  Sea sea(water, current, grid ? grid->repetition_s : std::numeric_limits<double>::infinity());
  const RandomStream phases(cut.seed, phase_stream), headings(cut.seed, heading_stream),
      amplitudes(cut.seed, amplitude_stream);
  double carried = 0;
  for (const Bin& bin : bins) {
    const double energy = spectrum.energy(bin.from, bin.to);
    carried += energy;
    // −ln(1 − u) has mean one: the energy of a Rayleigh amplitude.
    const double scatter = cut.amplitudes == Amplitudes::rayleigh ? -std::log1p(-amplitudes.uniform(bin.number)) : 1.0;
    double heading = directions.mean.radians();
    if (directions.spreading != nullptr)
      heading += directions.spreading->quantile(headings.uniform(bin.number), bin.omega).radians();
    sea.add({AngularFrequency::from_rad_per_s(bin.omega), WaveAmplitude::from_metres(std::sqrt(2 * energy * scatter)),
             2 * std::numbers::pi * phases.uniform(bin.number), Angle::from_radians(heading)});
    if (grid != nullptr) sea.index_.push_back(bin.number);
  }
  sea.fraction_left_out_ = 1 - carried / spectrum.moment(0);
  return sea;
}

Sea Sea::together(std::span<const Sea> seas) {
  require(!seas.empty(), "a sea of several needs at least one");
  Sea out = seas.front();
  double carried = std::pow(out.hs() / 4, 2), all = carried / (1 - out.fraction_left_out_);
  for (const Sea& sea : seas.subspan(1)) {
    out.components_.insert(out.components_.end(), sea.components_.begin(), sea.components_.end());
    out.index_.insert(out.index_.end(), sea.index_.begin(), sea.index_.end());
    if (sea.repetition_s_ != out.repetition_s_) out.repetition_s_ = std::numeric_limits<double>::infinity();
    const double energy = std::pow(sea.hs() / 4, 2);
    carried += energy;
    all += energy / (1 - sea.fraction_left_out_);
  }
  if (std::isinf(out.repetition_s_)) out.index_.clear();
  out.fraction_left_out_ = all > 0 ? 1 - carried / all : 0;
  return out;
}

Sea Sea::with_amplitudes(std::span<const std::complex<double>> amplitudes) const {
  require(amplitudes.size() == components_.size(), "{} complex amplitudes given for a sea of {} components",
          amplitudes.size(), components_.size());
  Sea out = *this;
  for (std::size_t i = 0; i < amplitudes.size(); ++i) {
    require(std::isfinite(std::abs(amplitudes[i])), "complex amplitude {} is not finite", i + 1);
    out.components_[i].amplitude = std::abs(amplitudes[i]);
    out.components_[i].phase = std::arg(amplitudes[i]);
  }
  return out;
}

double Sea::hs() const {
  double energy = 0;
  for (const Component& w : components_) energy += w.amplitude * w.amplitude / 2;
  return 4 * std::sqrt(energy);
}

double Sea::elevation(double t_s, double x_m, double y_m) const {
  double sum = 0;
  for (const Component& w : components_)
    sum +=
        w.amplitude * std::cos(w.omega * t_s - w.k * (x_m * std::cos(w.heading) + y_m * std::sin(w.heading)) + w.phase);
  return sum;
}

DiscretisationError discretisation_error(const Sea& sea, const Spectrum& spectrum, double omega_min, double omega_max) {
  const auto error = [&](int n) {
    double sum = 0;
    for (const Component& w : sea.components()) sum += std::pow(w.omega, n) * w.amplitude * w.amplitude / 2;
    return sum / spectrum.band_moment(n, omega_min, omega_max) - 1;
  };
  return {.m0 = error(0), .m1 = error(1), .m2 = error(2), .m4 = error(4)};
}

std::vector<Harmonic> harmonics(const Sea& sea) {
  std::vector<Harmonic> out;
  out.reserve(sea.components().size());
  for (const Component& w : sea.components()) {
    const std::complex<double> elevation = std::polar(w.amplitude, w.phase);
    out.push_back({.omega = w.omega,
                   .kx = w.k * std::cos(w.heading),
                   .ky = w.k * std::sin(w.heading),
                   .elevation = elevation,
                   .potential = std::complex<double>(0, sea.water().gravity / w.sigma) * elevation});
  }
  return out;
}

HarmonicField linear_field(const Sea& sea, HarmonicField::Options options) {
  if (std::isnan(options.hs_m)) options.hs_m = sea.hs();
  return HarmonicField(harmonics(sea), sea.water(), options, sea.current());
}

}  // namespace hydro::waves
