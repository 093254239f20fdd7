// froude bem info of motions, mean drift and quadratic loads: what a file holds, not the numbers themselves.
#include "froude/bem/responses.hpp"

#include <numbers>

#include "froude/report.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/types.hpp"

namespace froude {
namespace {

using namespace hydro::potential;

std::string name_of(int mode) {
  return fmt::format("{} of body {}", hydro::mode_names[static_cast<std::size_t>(mode % 6)], mode / 6 + 1);
}

/// The largest value of one mode and where it is.
struct Peak {
  int mode;
  double value, omega, heading_deg;
};

std::vector<Peak> peaks(const std::vector<Eigen::MatrixXcd>& table, const std::vector<int>& mode,
                        const std::vector<double>& omega, const std::vector<double>& heading) {
  std::vector<Peak> out;
  for (std::size_t i = 0; i < mode.size(); ++i) {
    Peak peak{mode[i], -1, 0, 0};
    for (std::size_t h = 0; h < table.size(); ++h) {
      Eigen::Index k = 0;
      const double value = table[h].row(static_cast<Eigen::Index>(i)).cwiseAbs().maxCoeff(&k);
      if (value > peak.value) peak = {mode[i], value, omega[static_cast<std::size_t>(k)], heading[h] / degree};
    }
    out.push_back(peak);
  }
  return out;
}

/// What is told of any of the three kinds.
struct Told {
  std::string kind, source;
  std::vector<double> omega;
  std::size_t headings;
  std::vector<Peak> peak;
  const char *force_unit, *moment_unit;
  std::vector<std::string> notes;
};

std::vector<double> first_of(const std::vector<std::array<double, 2>>& pairs) {
  std::vector<double> first;
  for (const auto& pair : pairs) first.push_back(pair[0]);
  return first;
}

Told told_of(const Path& file, const ReadOptions& options) {
  if (response_kind(file) == ResponseKind::rao) {
    const RaoTable r = read_rao(file, options);
    return {"motions", r.source, r.omega, r.heading.size(), peaks(r.motion, r.mode, r.omega, r.heading),
            "m/m",     "rad/m",  r.notes};
  }
  if (response_kind(file) == ResponseKind::drift) {
    const DriftForces d = read_drift(file, options);
    return {"mean drift (" + d.method + ")",
            d.source,
            d.omega,
            d.heading.size(),
            peaks(d.load, d.mode, d.omega, first_of(d.heading)),
            "N/m^2",
            "N/m",
            d.notes};
  }
  const QuadraticLoads q = read_quadratic(file, options);
  std::vector<Eigen::MatrixXcd> largest;  // of each first frequency
  for (const auto& by_mode : q.load) {
    auto& rows =
        largest.emplace_back(static_cast<Eigen::Index>(q.mode.size()), static_cast<Eigen::Index>(q.omega.size()));
    for (std::size_t i = 0; i < q.mode.size(); ++i)
      rows.row(static_cast<Eigen::Index>(i)) = by_mode[i].cwiseAbs().rowwise().maxCoeff().cast<std::complex<double>>();
  }
  return {q.is_sum ? "quadratic loads, sums" : "quadratic loads, differences",
          q.source,
          q.omega,
          q.heading.size(),
          peaks(largest, q.mode, q.omega, first_of(q.heading)),
          "N/m^2",
          "N/m",
          q.notes};
}

const char* unit_of(const Told& t, int mode) { return mode % 6 < 3 ? t.force_unit : t.moment_unit; }

}  // namespace

Report response_report(const Path& file, const ReadOptions& options) {
  const Told t = told_of(file, options);
  Report out;
  out.say("{}", fact("file", file.string()));
  out.say("  format      {}", fact("source", t.source));
  out.say("  holds       {}", fact("kind", t.kind));
  out.say("  frequencies {} from {:.4g} to {:.4g} rad/s, {} headings", fact("omega_rad_per_s", t.omega, t.omega.size()),
          t.omega.front(), t.omega.back(), fact("headings", t.headings));
  out.keep("largest", Json::array());
  for (const Peak& p : t.peak)
    out.row("largest", "  largest {:<20} {:>12.5g} {:<6} at {:.4g} rad/s, {:.4g} deg", fact("mode", name_of(p.mode)),
            fact("value", p.value), fact("unit", unit_of(t, p.mode)), fact("omega_rad_per_s", p.omega),
            fact("heading_deg", p.heading_deg));
  return out.sentences("notes", "  note        {}", t.notes);
}

}  // namespace froude
