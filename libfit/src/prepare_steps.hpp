#pragma once
/// \file  Steps that records of every kind go through, each told in numbers; (F19), (F20), (F22), (F25), (F48),
///        (F108).
#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "fit/band_pass.hpp"
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

/// The line of least squares through the window where that is a span, else through all of the record. (F108)
class Trend {
 public:
  /// \throws hydro::InputError as samples_within()
  Trend(const WindowChoice& window, const std::vector<double>& time, const std::vector<double>& values);
  /// Its slope, about the middle of the window: the mean stays.
  void take_off(const std::vector<double>& time, std::vector<double>& values) const;
  std::string told(const std::string& name) const;

 private:
  double slope_, middle_s_, from_s_, to_s_, share_;
};

/// What of a record a filter with the name `name` keeps: "… 1 % to 3.3 Hz, no delay, 0.4 s given up at each end".
std::string told(const ZeroPhaseFilter& filter, const std::string& name, double step_s);
std::string told(const BandPass& band, const std::string& name, double step_s);

/// Share of an amplitude of frequency ω that all filters and the band-pass leave.
double gain_of(const PrepareOptions& options, double step_s, double omega);

/// Samples [from, to) of a window that is a span.
struct SampleSpan {
  std::size_t from, to;
};
/// \throws hydro::InputError if none lies in it
SampleSpan samples_within(const WindowChoice& window, const std::vector<double>& time);

/// Leaves samples [from, from + count).
void keep_part(std::vector<double>& column, std::size_t from, std::size_t count);

}  // namespace fit
