#pragma once
/// \file  Steps that records of every kind go through, each told in numbers; (F19), (F20), (F22), (F25), (F48).
#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "fit/filter.hpp"
#include "fit/prepare.hpp"

namespace fit {

/// What was done, in order, and what is wrong with the sensors.
struct StepLog {
  std::vector<std::string> steps = {}, cautions = {};

  template <class... Args>
  void tell(fmt::format_string<Args...> text, Args&&... args) {
    steps.push_back(fmt::format(text, std::forward<Args>(args)...));
  }
  template <class... Args>
  void warn(fmt::format_string<Args...> text, Args&&... args) {
    cautions.push_back(fmt::format(text, std::forward<Args>(args)...));
  }
};

/// A measured column with its name.
using NamedColumn = std::pair<std::string, std::vector<double>*>;

/// A record between two steps: its columns have the length of its time.
struct RecordColumns {
  std::vector<double>& time;  // s
  double& step;               // s, once the grid is even
  std::vector<NamedColumn> columns;
  StepLog& log;
};

/// What evened_and_cleaned() replaced.
struct Replaced {
  std::size_t filled = 0;             ///< samples that were missing, of each column
  std::vector<std::size_t> outliers;  ///< of each column
};
/// Even grid, sensors looked at, outliers. `rests`: a column that stays at one value where nothing is wrong.
/// \throws hydro::InputError as even_grid(), find_outliers() and bridge(), and for a window of outliers too short or
/// too long
Replaced evened_and_cleaned(RecordColumns& record, const PrepareOptions& options,
                            const std::vector<double>* rests = nullptr);
/// Another rate, 0: as it is. \throws hydro::InputError as Resampler, and for more than a hundred times the rate
void resample(RecordColumns& record, double hz);

/// \throws hydro::InputError as the filter
ZeroPhaseFilter filter_of(const FilterChoice& choice, double step_s);

/// Samples [from, to) of a window that is a span.
struct SampleSpan {
  std::size_t from, to;
};
/// \throws hydro::InputError if none lies in it
SampleSpan samples_within(const WindowChoice& window, const std::vector<double>& time);

/// Leaves samples [from, from + count).
void keep_part(std::vector<double>& column, std::size_t from, std::size_t count);

}  // namespace fit
