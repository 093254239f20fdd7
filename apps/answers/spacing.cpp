#include "answers/spacing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "answers/convergence.hpp"
#include "answers/estimate.hpp"

namespace froude {
namespace {

using hydro::potential::Coefficients;

/// Every n-th frequency, and the last.
Coefficients every(std::size_t n, const Coefficients& c) {
  std::vector<Eigen::Index> kept;
  for (std::size_t k = 0; k < c.omega.size(); ++k)
    if (k % n == 0 || k + 1 == c.omega.size()) kept.push_back(static_cast<Eigen::Index>(k));
  Coefficients out = c;
  out.omega.clear();
  out.A.clear();
  out.B.clear();
  for (const Eigen::Index k : kept) {
    const auto at = static_cast<std::size_t>(k);
    out.omega.push_back(c.omega[at]);
    out.A.push_back(c.A[at]);
    out.B.push_back(c.B[at]);
  }
  for (auto& X : out.X) X = X(Eigen::all, kept).eval();
  return out;
}

compile::Prepared thinned(std::size_t n, const scene::Scene& scene, const compile::Prepared& prepared) {
  compile::Prepared out = prepared;
  for (auto& group : out.groups) {
    std::vector<Eigen::Vector3d> origins;
    for (const int b : group.bodies) origins.push_back(scene.bodies[static_cast<std::size_t>(b)].position);
    group.table = hydro::potential::FrequencyTable(every(n, group.table.coefficients()), std::move(origins));
  }
  using hydro::potential::FrequencyTable;
  std::map<std::shared_ptr<const FrequencyTable>, std::shared_ptr<const FrequencyTable>> of_parts;
  for (auto& section : out.sections) {
    auto& table = of_parts[section.table];
    if (!table)
      table = std::make_shared<const FrequencyTable>(every(n, section.table->coefficients()), section.origins);
    section.table = table;
  }
  return out;
}

/// True if the coefficients of some group are interpolated there.
bool is_between(const compile::Prepared& prepared, double omega) {
  return std::any_of(prepared.groups.begin(), prepared.groups.end(), [&](const auto& group) {
    const auto& all = group.table.coefficients().omega;
    return std::none_of(all.begin(), all.end(), [&](double w) { return std::abs(w - omega) <= 1e-9 * omega; });
  });
}

/// What rounding leaves of motions where symmetry leaves none, m or rad for a metre of wave.
double rounding_of(const std::string& unit) {
  constexpr double motion = 1e-9;
  return unit.find_first_of("NJW") == std::string::npos ? motion : 0;
}

/// (E3): the error of the whole by what half and a quarter of the frequencies change, in any unit.
double extrapolated(double gap, double before) {
  constexpr double order_of_cubic = 16, least = 2;
  return gap > 0 ? gap / (std::clamp(before / gap, least, order_of_cubic) - 1) : 0;
}

using Values = std::vector<std::complex<double>>;

/// The largest difference of two answers, heading by heading, at the frequencies that count.
double largest_gap(const Values& a, const Values& b, const std::vector<bool>& counts) {
  double square = 0;
  for (std::size_t first = 0; first < a.size(); first += counts.size())
    for (std::size_t w = 0; w < counts.size(); ++w)
      if (counts[w]) square = std::max(square, std::norm(a[first + w] - b[first + w]));
  return std::sqrt(square);
}

/// The largest error of a signal, of its peak.
double worst(const Values& whole, const Values& half, const Values& quarter, double peak,
             const std::vector<bool>& counts) {
  if (peak == 0) return 0;
  return extrapolated(largest_gap(whole, half, counts) / peak, largest_gap(half, quarter, counts) / peak);
}

/// Why the coefficients cannot be thinned twice; empty if they can.
std::string too_few(const compile::Prepared& prepared) {
  constexpr std::size_t enough = 9;  // three are left of them where every fourth is taken
  for (const auto& group : prepared.groups)
    if (const auto& c = group.table.coefficients(); c.omega.size() < enough)
      return fmt::format("{} has too few frequencies", c.source);
  return "";
}

ErrorEstimate::Source spacing_source() {
  return {.name = "coefficients",
          .how = "answers from every second and every fourth of their frequencies",
          .of_signal = {},
          .given = true};
}

}  // namespace

std::vector<double> peaks_of(const std::vector<ComplexSignal>& signals) {
  std::vector<double> out;
  for (const auto& s : signals) {
    double square = 0;
    for (const auto& v : s.values) square = std::max(square, std::norm(v));
    out.push_back(std::max(std::sqrt(square), rounding_of(s.units)));
  }
  return at_least_a_thousandth(std::move(out), signals, &ComplexSignal::units);
}

ErrorEstimate error_of_spacing(const scene::Scene& scene, const compile::Prepared& prepared,
                               const std::vector<double>& omega, const std::vector<ComplexSignal>& whole,
                               const LinearAnswer& answer) {
  ErrorEstimate out = unknown_error(scene);
  std::vector<bool> counts;
  for (const double w : omega) counts.push_back(is_between(prepared, w));
  if (std::none_of(counts.begin(), counts.end(), [](bool c) { return c; })) return out;
  if (out.missing = too_few(prepared); !out.missing.empty()) return out;
  const auto half = answer(thinned(2, scene, prepared)), quarter = answer(thinned(4, scene, prepared));
  const auto peak = peaks_of(whole);
  out.sources.push_back(spacing_source());
  for (std::size_t i = 0; i < whole.size(); ++i)
    out.sources.front().of_signal.push_back(worst(whole[i].values, half(i), quarter(i), peak[i], counts));
  return out;
}

ErrorEstimate error_of_spacing(const scene::Scene& scene, const compile::Prepared& prepared,
                               const std::vector<compile::Signal>& signals, const Eigen::MatrixXcd& whole,
                               const std::function<Eigen::MatrixXcd(const compile::Prepared&)>& answer) {
  ErrorEstimate out = unknown_error(scene);
  if (prepared.groups.empty()) return out;
  if (out.missing = too_few(prepared); !out.missing.empty()) return out;
  const Eigen::MatrixXcd half = answer(thinned(2, scene, prepared)), quarter = answer(thinned(4, scene, prepared));
  const Eigen::VectorXd size = whole.rowwise().norm(), gap = (whole - half).rowwise().norm(),
                        before = (half - quarter).rowwise().norm();
  const auto scale = at_least_a_thousandth({size.begin(), size.end()}, signals, &compile::Signal::unit);
  out.sources.push_back(spacing_source());
  for (std::size_t i = 0; i < signals.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double of = std::max(scale[i], rounding_of(signals[i].unit));
    out.sources.front().of_signal.push_back(of > 0 ? extrapolated(gap[row], before[row]) / of : 0);
  }
  return out;
}

}  // namespace froude
