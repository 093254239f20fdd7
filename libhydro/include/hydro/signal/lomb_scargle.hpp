#pragma once
/// \file  Spectra of records with gaps or uneven sampling: sinusoids by least squares, segment by segment; (S24),
/// docs/theory/signal.md.
#include <span>
#include <vector>

#include "hydro/signal/welch.hpp"

namespace hydro::signal {

/// One-sided variance density at 1/T, 2/T … `highest_hz`, T the segment, half overlapping. Of an even record it is that
/// of welch() with a Hann window, but for what negative frequencies leak: none at 2/T and above, to the rounding of
/// least squares. Segments with fewer than half of the samples of the fullest take no part. Where sampling is uneven
/// at random, every line adds a floor of about its variance over the samples of a segment to all frequencies.
/// Cost O(samples · frequencies).
/// \throws InputError if lengths differ, time does not increase or a value is not finite; for a segment that is longer
/// than the record, or holds fewer than 16 samples; for `highest_hz` not above 2/T
WelchSpectrum lomb_scargle(std::span<const double> time_s, std::span<const double> values, double segment_s,
                           double highest_hz);

/// What of each density of such a spectrum has come from frequencies more than two lines away, by the window of Hann
/// where the samples are, 0 to 1: next to nothing of an even record, a large share of a steep tail where blocks are
/// missing. \throws InputError as lomb_scargle() with the same record and segment
std::vector<double> leaked_shares(std::span<const double> time_s, double segment_s, const SpectrumPerHz& spectrum);

/// Half of the most usual rate of samples, 1/(2 median step): above it an even record has nothing.
double usual_nyquist_hz(std::span<const double> time_s);

}  // namespace hydro::signal
