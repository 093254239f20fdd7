#pragma once
/// \file  Poincaré sections of sampled motions: where they are each time that one signal crosses a level, or once in
///        each period. (D103)
#include <cstddef>
#include <span>
#include <vector>

namespace hydro::signal {

/// Points of a Poincaré section, each with its error by interpolation.
struct PoincareSection {
  std::vector<double> time_s;
  std::vector<std::vector<double>> values,
      errors;                ///< one list a signal, in its unit; errors are absolute and not negative
  std::size_t left_out = 0;  ///< crossings with fewer than three samples on a side
};

/// Signals sampled at start_s, start_s + step_s, …: one list each, all of one length.
struct Samples {
  double start_s, step_s;
  std::vector<std::span<const double>> of;
};

enum class Through { up, down, both };

/// Where the signals are when `across` passes `level`. Sampled so coarsely that `across` crosses twice between two
/// samples, both crossings are missed. \throws InputError for fewer than six samples, lists of unequal length, or a
/// value that is not finite
PoincareSection poincare_section_at(std::span<const double> across, double level, Through through,
                                    const Samples& samples);

/// Where the signals are at first_s, first_s + period_s, … \throws InputError likewise, and unless period_s is above 0
/// and first_s inside the record
PoincareSection poincare_section_every(double first_s, double period_s, const Samples& samples);

}  // namespace hydro::signal
