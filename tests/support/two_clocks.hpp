#pragma once
/// \file  A film and a record of one motion by two clocks, with noise: what the offset between clocks is tried on.
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "fit/offset.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"

namespace froude_test {

/// Ten waves between 0.2 and 1.1 Hz, or one swing of 0.6 Hz that begins and dies away; rms 0.6.
enum class Shown { waves, swing };

/// 12 s of film and 14 s of record at these rates, with noise of these deviations and of the memory φ^k from one sample
/// to the next.
struct TwoClocks {
  const char* name;
  Shown shown;
  double film_noise, record_noise, memory;
  int film_hz, record_hz;
};
inline constexpr std::array<TwoClocks, 9> two_clocks{{
    {"waves, noise on the film", Shown::waves, 0.2, 0, 0, 20, 40},
    {"waves, noise on the record", Shown::waves, 0, 0.2, 0, 20, 40},
    {"a swing, noise on the film", Shown::swing, 0.2, 0, 0, 20, 40},
    {"a swing, noise on the record", Shown::swing, 0, 0.2, 0, 20, 40},
    {"waves, noise on both", Shown::waves, 0.2, 0.2, 0, 20, 40},
    {"waves, noise on both, the film denser", Shown::waves, 0.2, 0.2, 0, 30, 20},
    {"a swing, noise on both", Shown::swing, 0.2, 0.2, 0, 20, 40},
    {"waves, noise that lasts on both", Shown::waves, 0.2, 0.2, 0.8, 20, 40},
    {"a swing, noise that lasts on both", Shown::swing, 0.2, 0.2, 0.8, 20, 40},
}};

inline double shown_at(Shown shown, const hydro::RandomStream& random, double t) {
  if (shown == Shown::swing) return t < 2 ? 0 : 1.4 * std::exp(-0.15 * (t - 2)) * std::sin(3.8 * (t - 2));
  double sum = 0;
  for (std::uint64_t k = 0; k < 10; ++k) {
    const double frequency = 0.2 + 0.1 * static_cast<double>(k) + 0.02 * random.normal(10'000 + k);
    sum += 0.27 * std::sin(2 * std::numbers::pi * (frequency * t + random.normal(20'000 + k)));
  }
  return sum;
}

/// What offsets of so many sets are, against the truth.
struct OffsetErrors {
  int sets = 0, refused = 0,
      within = 0;                     ///< told, refused since another swing may be theirs, within the interval of 95 %
  double squares = 0, quantiles = 0;  ///< Σ (error/deviation)², Σ half width/deviation
};

/// The sign is known, unless said otherwise.
inline OffsetErrors errors_of_offsets(const TwoClocks& of, std::uint64_t sets,
                                      const fit::OffsetOptions& known = {.sign = fit::OffsetOptions::Sign::same}) {
  OffsetErrors out;
  for (std::uint64_t set = 1; set <= sets; ++set) {
    const hydro::RandomStream random(set, 5);
    const double lag = 0.6 + 0.0001 * static_cast<double>(set);
    const auto measured = [&](int hz, double seconds, double late, double deviation, std::uint64_t stream) {
      const hydro::RandomStream noise(set, stream);
      std::pair<std::vector<double>, std::vector<double>> record;
      double error = noise.normal(100'000);
      for (int i = 0; i < seconds * hz; ++i) {
        error = of.memory * error + std::sqrt(1 - of.memory * of.memory) * noise.normal(static_cast<std::uint64_t>(i));
        record.first.push_back(static_cast<double>(i) / hz);
        record.second.push_back(shown_at(of.shown, random, record.first.back() - late) + deviation * error);
      }
      return record;
    };
    const auto [time, value] = measured(of.film_hz, 12, 0, of.film_noise, 6);
    const auto [record_time, record] = measured(of.record_hz, 14, lag, of.record_noise, 7);
    try {
      const auto found = fit::offset_between(time, value, record_time, record, known);
      ++out.sets;
      out.within += std::abs(found.lag - lag) <= found.half_width;
      out.squares += std::pow((found.lag - lag) / found.deviation, 2);
      out.quantiles += found.half_width / found.deviation;
    } catch (const hydro::InputError&) {
      ++out.refused;
    }
  }
  return out;
}

}  // namespace froude_test
