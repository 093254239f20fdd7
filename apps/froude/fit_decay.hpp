#pragma once
/// \file  A fit of one decay, or of several together, and how it is told. Private to apps/froude.
#include <optional>
#include <string>
#include <vector>

#include "fit/decay_memory.hpp"
#include "fit/diagnose.hpp"
#include "fit/runs.hpp"
#include "froude/fit_summary.hpp"

namespace froude {

struct DecayRecord {
  std::string name;  ///< of the file
  std::vector<double> time, values;
  std::vector<std::string> steps, cautions;  ///< of its preparation
};

/// A fit of part of a record: what changes, in standard errors of the whole.
struct DecayVariant {
  std::string what;             ///< "the first half of the record"
  std::vector<double> changes;  ///< period, then the terms; empty where it cannot be fitted
  std::string why_not;
};

/// One file, or several fitted together.
struct DecayRun {
  std::string name;  ///< of the file, or "together"
  RunLabels labels = {};
  std::vector<DecayRecord> records;
  ::fit::Decrement decrement;  ///< of the first record
  ::fit::DecayFit fit;
  std::optional<::fit::ResidualReport> left = {};    ///< in the residuals of one record of 64 samples and more
  std::vector<DecayVariant> variants = {};           ///< where asked for
  std::vector<::fit::Interval> profiles = {};        ///< of the terms, where asked for
  std::optional<::fit::AddedMass> water = {};        ///< where the body is known
  std::optional<::fit::DecayMemoryFit> memory = {};  ///< where asked for
  std::optional<::fit::DecayRadiation> swing = {};   ///< of the memory, at the frequency of the swing
  std::optional<::fit::DecayRadiation> limit = {};   ///< at infinite frequency
  std::vector<::fit::DecayRadiation> curve = {};     ///< about the swing
};

FitSummary summary_of(const scene::FitScene& scene, const DecayRun& run);
const char* unit_of_decay(const std::string& term, bool angle);  ///< of what a decay fits: "period", "quadratic"
/// One row for each run, as CSV; cells of what is not identifiable are empty.
std::string decay_table(const scene::FitScene& scene, const std::vector<DecayRun>& runs);
/// Records and what is left of them, and of a memory added mass and damping over frequency.
plot::Figure decay_figure(const scene::FitScene& scene, const std::vector<DecayRun>& runs);

}  // namespace froude
