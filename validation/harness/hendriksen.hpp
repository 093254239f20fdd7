#pragma once
/// \file  The steps of Hendriksen (2023) from a raw run to a fit, for the cases made from her tables.
#include "fit/prepare.hpp"

namespace froude::validation {

/// The source's own, but for the delay of its moving average: zero run, 3.33 Hz, last five full oscillations.
inline ::fit::MorisonFit fitted_as_the_source(const ::fit::Cylinder& cylinder, const ::fit::RawRun& run) {
  ::fit::PrepareOptions options;
  options.filters = {{.kind = ::fit::FilterChoice::Kind::butterworth, .order = 4, .hz = 3.33}};
  options.window = {.kind = ::fit::WindowChoice::Kind::full_cycles, .cycles = 5};
  return ::fit::fit_morison(cylinder, ::fit::prepare(run, options).record);
}

}  // namespace froude::validation
