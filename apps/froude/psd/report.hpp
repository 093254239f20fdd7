#pragma once
/// \file  Private to the command psd: what was computed, and its telling, writing and drawing.
#include <optional>
#include <string>
#include <vector>

#include "answers/plot.hpp"
#include "froude/commands.hpp"
#include "froude/record_steps.hpp"
#include "froude/report.hpp"
#include "froude/result.hpp"
#include "hydro/signal/welch.hpp"
#include "hydro/signal/zero_crossings.hpp"

namespace froude::spectra {

namespace hs = hydro::signal;

/// Everything the output says about one signal; empty where a signal that never changes has no answer.
struct Estimate {
  Signal signal;
  hs::WelchSpectrum welch;
  std::optional<hs::Moments> moments;
  std::optional<hs::Peak> peak;
  std::size_t waves = 0;
  std::optional<hs::WaveStatistics> statistics;
  std::string drift;                             ///< a sentence where the record drifts; else empty
  std::optional<hs::TransferEstimate> transfer;  ///< from the input to this signal
  std::vector<double> leaked = {};               ///< of a record with gaps: shares of the density from afar (F124)
  std::vector<double> resolution = {};  ///< by what endless segments would move its |H₁|; may be empty (F118)
};

struct Analysis {
  std::size_t samples;
  double step;                           ///< s
  hs::WelchOptions options;              ///< where there are segments
  std::optional<std::size_t> tapers;     ///< in their place
  std::optional<double> uneven_segment;  ///< s: of a record with gaps; its step is the most usual
  hs::BandFactors band;
  double confidence;
  std::optional<StepsDone> prepared;  ///< where steps before the spectrum were asked for
  std::string input;                  ///< empty: none
  std::vector<std::string> cautions;  ///< of the record itself, where no steps told them
  std::vector<Estimate> estimates;
};

/// Spectra of a record, which errors call by the name of `arguments.file`. \throws hydro::InputError
Analysis analyse(RunResult record, const PsdArguments& arguments);

/// What of the spectra is not to be trusted, one sentence each.
std::vector<std::string> notes_of(const Analysis& analysis);

/// Tables for people, everything for programs.
Report report_of(const Analysis& analysis);
/// Densities with their bands, and responses, along frequency. \throws hydro::InputError unless path ends in .csv or
/// .h5
void write_table(const Path& path, const Analysis& analysis);
plot::Figure figure(const Analysis& analysis, const std::string& file_name);

}  // namespace froude::spectra
