#pragma once
/// \file  Private: what solvers of coefficients are asked for, alike for all of them.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "hydro/base/error.hpp"
#include "hydro/base/parallel.hpp"

namespace hydro::potential {

inline void require_increasing(const std::vector<double>& values, const char* what, const char* unit) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    require(std::isfinite(values[i]), "{} must be finite, got {} {}", what, values[i], unit);
    require(i == 0 || values[i] > values[i - 1], "{} must increase, but {} {} follows {}", what, values[i], unit,
            values[i == 0 ? 0 : i - 1]);
  }
}

/// \throws InputError unless frequencies are finite, positive and rising, of which there is one at least, headings
/// likewise finite and rising, and threads between 0, which stands for all, and 1024
inline void check_solver_request(const std::vector<double>& omega, const std::vector<double>& heading, int threads) {
  require(!omega.empty(), "no frequency is asked for");
  require_increasing(omega, "frequencies", "rad/s");
  require(omega.front() > 0, "a frequency must be positive, got {} rad/s", omega.front());
  require_increasing(heading, "headings", "rad");
  require(threads >= 0 && threads <= 1024, "the number of threads must be between 0 and 1024, got {}", threads);
}

/// Frequencies that are solved before others are chosen between them; fewer foresee nothing.
inline constexpr std::size_t least_first_frequencies = 5;

/// \throws InputError where frequencies are to be chosen from too few, or to a tolerance out of range
inline void check_frequency_tolerance(const std::optional<double>& tolerance, std::size_t frequencies) {
  if (!tolerance) return;
  require(*tolerance >= 1e-6 && *tolerance <= 0.1,
          "the tolerance between frequencies must be between 1e-6 and 0.1, got {}", *tolerance);
  require(frequencies >= least_first_frequencies,
          "where frequencies are chosen, {} at least are stated to begin with, got {}", least_first_frequencies,
          frequencies);
}

/// Threads for so many pieces of work.
inline int thread_count(int asked, std::size_t work) {
  return std::min(asked > 0 ? asked : all_processors(), static_cast<int>(work));
}

/// So many of `all` indices, both ends and evenly between; a single one is `alone`.
inline std::vector<std::size_t> spread(std::size_t all, int wanted, std::size_t alone) {
  std::vector<std::size_t> chosen;
  const std::size_t count = std::min(all, static_cast<std::size_t>(wanted));
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(count == 1 ? alone : i * (all - 1) / (count - 1));
  return chosen;
}

}  // namespace hydro::potential
