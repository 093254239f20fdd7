// Loads of waves that do not fit between their neighbours, where A and B have nothing to show for it. (P43)
#include <algorithm>
#include <cmath>
#include <complex>

#include "doctor.hpp"
#include "potential/modes.hpp"
#include "potential/readers.hpp"
#include "spikes.hpp"

namespace hydro::potential::doctor {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

/// How far each value of a curve is from what its two neighbours on each side tell, relative to its mode's size.
using Departures = std::vector<double>;

/// Beyond this a departure is looked at, if it is this many times the median of its own curve (as (P72)).
constexpr double seen_from = 0.05, times_the_usual = 8;

/// Of A and B less is enough to take it for the same event.
constexpr double times_the_usual_of_motion = 4;

/// What departs by less than this share of another does not show the same.
constexpr double same_event = 0.1;

template <class Value>
Departures departures(const std::vector<double>& omega, double size, const Value& value) {
  Departures out(omega.size(), 0.0);
  if (!(size > 0)) return out;
  for (std::size_t k = 2; k + 2 < omega.size(); ++k)
    out[k] = std::abs(value(k) - through(omega, {k - 2, k - 1, k + 1, k + 2}, omega[k], value)) / size;
  return out;
}

/// Frequencies beside a spike depart too: their neighbours have it.
double largest_about(const Departures& d, std::size_t k) {
  const auto at = d.begin() + static_cast<std::ptrdiff_t>(k);
  return *std::max_element(at - 2, at + 3);
}

/// The loads without the phase of the wave's way to the bodies, by mode: one curve a heading, and their size.
struct Loads {
  std::vector<Eigen::MatrixXcd> X;
  Eigen::VectorXd size;

  explicit Loads(const Patient& p) {
    std::vector<Eigen::Vector3d> places;
    for (const BodyData& body : p.c.body) places.push_back(body.reference_point.value_or(Eigen::Vector3d::Zero()));
    X = turned_by_way(p.c, places, -1);
    size = Eigen::VectorXd::Zero(p.c.modes());
    for (const auto& of_heading : X) size = size.cwiseMax(of_heading.cwiseAbs().rowwise().maxCoeff());
    size = with_floor(size);
  }
};

/// The departures of one mode: of X heading by heading, of A and of B.
struct CurvesOfMode {
  Index mode;
  std::vector<Departures> X;
  Departures A, B;

  CurvesOfMode(const Patient& p, const Loads& loads, Index i) : mode(i) {
    const auto of = [&](double size, const auto& value) { return departures(p.c.omega, size, value); };
    for (const auto& of_heading : loads.X)
      X.push_back(of(loads.size(i), [&](std::size_t k) { return of_heading(i, static_cast<Index>(k)); }));
    A = of(p.size_of_A(i), [&](std::size_t k) { return p.c.A[k](i, i); });
    B = of(p.size_of_B(i), [&](std::size_t k) { return p.c.B[k](i, i); });
  }
};

bool is_outstanding(const Departures& d, std::size_t k) {
  return d[k] >= std::max(seen_from, times_the_usual * quantile(d, 0.5)) && largest_about(d, k) <= d[k];
}

/// A resonance of the water, or an irregular frequency, is in the radiated waves too; as |X|² goes with B, a load that
/// leaps by `size` makes B leap by some size².
bool motion_shows_it(const CurvesOfMode& of, std::size_t k, double size) {
  const auto shows = [&](const Departures& d) {
    return largest_about(d, k) > std::max(times_the_usual_of_motion * quantile(d, 0.5), same_event * size * size);
  };
  return shows(of.A) || shows(of.B);
}

/// Headings that show it too, of those from which the mode is pushed at all.
struct OtherHeadings {
  int pushed = 0, showing = 0;
};

OtherHeadings other_headings(const CurvesOfMode& of, const Loads& loads, std::size_t h, std::size_t k) {
  constexpr double by_symmetry = 1e-3;  // what symmetry leaves of a load, and meshes make of it
  OtherHeadings out;
  for (std::size_t g = 0; g < of.X.size(); ++g) {
    const double load = loads.X[g].row(of.mode).middleCols(static_cast<Index>(k) - 1, 3).cwiseAbs().maxCoeff();
    if (g == h || load < by_symmetry * loads.size(of.mode)) continue;
    ++out.pushed;
    if (largest_about(of.X[g], k) > same_event * of.X[h][k]) ++out.showing;
  }
  return out;
}

/// Whether the curve is smooth once this value is taken out, as about one wrong number, and not about a resonance,
/// whose flanks stay.
bool is_one_value(const Patient& p, const Loads& loads, const CurvesOfMode& of, std::size_t h, std::size_t k) {
  constexpr double flanks = 0.15;  // of the departure
  std::vector<Complex> curve(p.c.omega.size());
  for (std::size_t w = 0; w < curve.size(); ++w) curve[w] = loads.X[h](of.mode, static_cast<Index>(w));
  curve[k] = through(p.c.omega, {k - 2, k - 1, k + 1, k + 2}, p.c.omega[k], [&](std::size_t w) { return curve[w]; });
  const Departures left = departures(p.c.omega, loads.size(of.mode), [&](std::size_t w) { return curve[w]; });
  return largest_about(left, k) <= flanks * of.X[h][k];
}

/// In arrays the water between bodies resonates with the waves of one heading and not of others, and hardly where one
/// body moves alone: then loads of other modes leap too, at that heading.
bool another_mode_shows_it(const std::vector<CurvesOfMode>& all, Index mode, std::size_t h, std::size_t k) {
  const double leap = all[static_cast<std::size_t>(mode)].X[h][k];
  return std::any_of(all.begin(), all.end(), [&](const CurvesOfMode& other) {
    return other.mode != mode && largest_about(other.X[h], k) > same_event * leap;
  });
}

Finding excitation_finding(const Patient& p, Index mode, std::size_t h, std::size_t k, double size, bool only_here) {
  constexpr double impossible = 0.3;  // as of A and B
  return {.severity = size > impossible ? Severity::error : Severity::warning,
          .check = "spikes",
          .where = fmt::format("X of {}, heading {:.4g} deg, at {}", mode_label(mode),
                               Angle::from_radians(p.c.heading[h]).degrees(), frequency_text(p.c.omega[k])),
          .message = fmt::format("{}: {:.2g} of the mode's size beside what its neighbours tell",
                                 only_here ? "a single wrong number" : "wrong loads, which A and B do not show", size),
          .why = "what makes a load leap makes damping leap, and loads of other headings (P43)",
          .remedy = "look at this number in the file, and compute the excitation of this frequency again",
          .body = static_cast<int>(mode / 6) + 1,
          .entry = std::nullopt,
          .omega = p.c.omega[k]};
}

}  // namespace

void look_at_excitation_spikes(const Patient& p, Findings& out) {
  if (p.c.X.empty()) return;
  const Loads loads(p);
  std::vector<CurvesOfMode> all;
  for (Index i = 0; i < p.c.modes(); ++i) all.emplace_back(p, loads, i);
  for (const CurvesOfMode& of : all)
    for (std::size_t k = 2; k + 2 < p.c.omega.size(); ++k) {
      const auto worst = std::max_element(of.X.begin(), of.X.end(),
                                          [&](const Departures& a, const Departures& b) { return a[k] < b[k]; });
      const auto h = static_cast<std::size_t>(worst - of.X.begin());
      if (!is_outstanding(*worst, k) || !is_one_value(p, loads, of, h, k)) continue;
      if (p.c.bodies() > 1 && another_mode_shows_it(all, of.mode, h, k)) continue;
      const OtherHeadings others = other_headings(of, loads, h, k);
      const bool only_here = others.pushed > 0 && others.showing == 0;
      if (!only_here && motion_shows_it(of, k, (*worst)[k])) continue;
      out.push_back(excitation_finding(p, of.mode, h, k, (*worst)[k], only_here || others.pushed == 0));
    }
}

}  // namespace hydro::potential::doctor
