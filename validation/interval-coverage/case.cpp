#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "fit/morison.hpp"
#include "harness/case.hpp"
#include "support/morison_records.hpp"

namespace froude::validation::interval_coverage {
namespace {

const ::fit::Cylinder& cylinder = froude_test::held_cylinder;

/// Fourteen cycles of 4 s at 20 Hz, C_D = 1.2, C_M = 1.8, noise of 3 N with e_t = φ e_{t−1} + white.
::fit::ForceRecord record(double phi, std::uint64_t stream) {
  return froude_test::swinging_water(1120, 0.05, phi, stream);
}

bool holds(const ::fit::Interval& interval, double truth) { return interval.low <= truth && truth <= interval.high; }

}  // namespace

Outcome outcome(const Folders&) {
  using Method = ::fit::IntervalMethod;
  const std::pair<Method, const char*> methods[] = {{Method::effective_samples, "effective samples"},
                                                    {Method::cycle_clusters, "cycle clusters"},
                                                    {Method::block_bootstrap, "block bootstrap"}};
  Outcome outcome;
  double taken_as_white = 0;
  for (const auto& [method, name] : methods)
    for (const double phi : {0.0, 0.85}) {
      const std::uint64_t sets = method == Method::block_bootstrap ? 1000 : 2000;  // five hundred fits each
      double cd = 0, cm = 0;
      for (std::uint64_t i = 0; i < sets; ++i) {
        const auto f = ::fit::fit_morison(cylinder, record(phi, 5000 + i), {.method = method});
        cd += holds(f.cd.interval, 1.2) / static_cast<double>(sets);
        cm += holds(f.inertia.interval, 1.8) / static_cast<double>(sets);
        if (phi > 0 && method == Method::effective_samples)
          taken_as_white += holds(f.cd.white_interval, 1.2) / static_cast<double>(sets);
      }
      const char* noise = phi > 0 ? "correlated" : "white";
      outcome.numbers.push_back({fmt::format("coverage of cd by {}, {} noise", name, noise), cd, ""});
      outcome.numbers.push_back({fmt::format("coverage of cm by {}, {} noise", name, noise), cm, ""});
    }
  outcome.numbers.push_back({"coverage of cd where correlated noise is taken as white", taken_as_white, ""});
  return outcome;
}

}  // namespace froude::validation::interval_coverage
