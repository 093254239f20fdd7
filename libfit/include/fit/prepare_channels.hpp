#pragma once
/// \file  Channels prepared by themselves, for whoever looks at a record without a model: spectra, extremes; (F22),
///        (F48), (F25), (F108), docs/theory/fit.md.
///
/// Order of the steps: even grid, outliers, levels, another rate, trend, filters, band-pass, window. Those that a fit
/// has are the same functions in the same order.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "fit/prepare.hpp"

namespace fit {

struct PreparedChannel {
  std::string name;
  std::vector<double> values;
  std::size_t outliers = 0;  ///< samples that were bridged
};

struct PreparedChannels {
  double step = 0;           ///< s
  std::vector<double> time;  ///< s
  std::vector<PreparedChannel> channels;
  std::size_t filled = 0;  ///< samples that were missing and are bridged, of each channel
  /// What filters leave of the record, s: within, no value leans on what lies beyond its ends. A window is cut of it.
  double steady_from_s = 0, steady_to_s = 0;
  std::vector<std::string> steps, cautions;  ///< as Prepared
};

/// All channels go through the same filters, so that ratios of their spectra stay as they are. The window is a span or
/// all; what is for forces is refused.
/// \throws hydro::InputError: no channel, lengths that differ, a value that is not finite, a window outside what the
/// filters leave, options for forces, and as the steps themselves
PreparedChannels prepare_channels(std::vector<double> time_s, std::vector<PreparedChannel> channels,
                                  const PrepareOptions& options);

}  // namespace fit
