// What waves do that are long against the bodies: the water around them moves as one. (P67)-(P69)
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "doctor.hpp"
#include "potential/readers.hpp"

namespace hydro::potential::doctor {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

Index row_of(int body) { return 6 * static_cast<Index>(body); }

/// ρV of a body, if its volume is known.
std::optional<double> displaced_mass(const Patient& p, int body) {
  const auto& V = p.c.body[static_cast<std::size_t>(body)].displaced_volume;
  if (!V) return std::nullopt;
  return p.c.water.density * *V;
}

/// Where the waterplane's centre of a body is, global x and y: C₃₅ = −C₃₃ (x − x_ref), C₃₄ = C₃₃ (y − y_ref). (P69)
std::optional<Eigen::Vector2d> waterplane_centre(const Patient& p, int body) {
  const auto& reference = p.c.body[static_cast<std::size_t>(body)].reference_point;
  if (!reference || !p.c.C) return std::nullopt;
  const Index i = row_of(body) + 2;
  const double C33 = (*p.c.C)(i, i);
  if (!(C33 > 0)) return std::nullopt;
  return Eigen::Vector2d(reference->x() - (*p.c.C)(i, i + 2) / C33, reference->y() + (*p.c.C)(i, i + 1) / C33);
}

/// ζ at a body for a wave of unit amplitude; 1 where its place is not known. (P2)
Complex elevation_at(const Patient& p, int body, std::size_t w, double heading) {
  const auto centre = waterplane_centre(p, body);
  if (!centre) return 1;
  return std::polar(1.0, -p.k[w] * (centre->x() * std::cos(heading) + centre->y() * std::sin(heading)));
}

/// X₃ ≈ C₃₃ ζ − ω² ρV ζ + Σ (iωB₃₃ − ω²A₃₃) ζ over the bodies; without ρV where it is not known. (P67)
Complex expected_heave(const Patient& p, int body, std::size_t w, double heading) {
  const double omega = p.c.omega[w];
  const Index i = row_of(body) + 2;
  Complex sum =
      ((*p.c.C)(i, i) - omega * omega * displaced_mass(p, body).value_or(0)) * elevation_at(p, body, w, heading);
  for (int b = 0; b < p.c.bodies(); ++b) {
    const Index j = row_of(b) + 2;
    sum += Complex(-omega * omega * p.c.A[w](i, j), omega * p.c.B[w](i, j)) * elevation_at(p, b, w, heading);
  }
  return sum;
}

/// How far from its limit C₃₃ the expected load of heave is, relative: the part that a mesh, a moonpool or an unknown
/// volume may get wrong.
double departure(const Patient& p, int body, std::size_t w) {
  const Index i = row_of(body) + 2;
  const double omega = p.c.omega[w];
  const double mass = displaced_mass(p, body).value_or(0) + std::abs(p.c.A[w](i, i));
  return omega * omega * mass / (*p.c.C)(i, i);
}

bool floats(const Patient& p, int body) {
  const Index i = row_of(body) + 2;
  return p.c.C && (*p.c.C)(i, i) > 0;
}

/// Length by which a body is told from a point: of its waterplane, else of the water that goes with it.
double length_of(const Patient& p, int body) {
  const Index i = row_of(body);
  double length =
      std::cbrt(std::max(std::abs(p.c.A.front()(i, i)), std::abs(p.c.A.front()(i + 1, i + 1))) / p.c.water.density);
  if (floats(p, body))
    length = std::max(length, std::sqrt((*p.c.C)(i + 2, i + 2) / (p.c.water.density * p.c.water.gravity)));
  return length;
}

/// Whether the wave of frequency w is long against a body.
bool is_long(const Patient& p, int body, std::size_t w) {
  constexpr double long_against = 0.5;  // kL: the terms left out are of order (kL)²
  return p.k[w] * length_of(p, body) < long_against && (!floats(p, body) || departure(p, body, w) < long_against);
}

std::string place(const Patient& p, int body, std::size_t w, std::size_t h, const char* modes) {
  return fmt::format("X of {} of body {}, heading {:.4g} deg, {}", modes, body + 1,
                     Angle::from_radians(p.c.heading[h]).degrees(), frequency_text(p.c.omega[w]));
}

/// The finding, so far the worst, of one check.
struct Case {
  bool known = false;
  double off = 0;
  Finding finding = {};
};

void keep_worst(Case& worst, double off, Finding finding) {
  if (!worst.known || finding.severity > worst.finding.severity ||
      (finding.severity == worst.finding.severity && off > worst.off))
    worst = {true, off, std::move(finding)};
}

Severity graded(double off, double usual, double impossible) {
  return off > impossible ? Severity::error : off > usual ? Severity::warning : Severity::note;
}

// In good data the loads of long waves are within 3 % of (P67) and (P68); what the next order leaves is allowed on top.
constexpr double usual_off = 0.1, impossible_off = 0.3;

/// |X₃| against (P67).
void look_at_heave(const Patient& p, int body, std::size_t h, Case& worst) {
  const std::size_t w = 0;
  const double allowed = departure(p, body, w) / (displaced_mass(p, body) ? 2 : 1);
  const double given = std::abs(p.c.X[h](row_of(body) + 2, static_cast<Index>(w)));
  const double ratio = given / std::abs(expected_heave(p, body, w, p.c.heading[h]));
  const double off = ratio > 0 ? std::abs(std::log(ratio)) : 1e300;
  Finding f{.severity = graded(off, usual_off + allowed, impossible_off + allowed),
            .check = "heave in long waves",
            .where = place(p, body, w, h, "heave"),
            .message = fmt::format("|X₃| is {:.4g} times what C₃₃ and A₃₃ make it", ratio),
            .body = body + 1,
            .omega = p.c.omega[w]};
  if (f.severity != Severity::note) {
    f.message += likely_cause(ratio, p.c.water);
    f.why = "a long wave lifts the water as far as C₃₃ counts: X₃ tends to C₃₃ (P67)";
    f.remedy = "look at the units of X and C (gravity, density, ULEN), and whether they are of the same body";
  }
  keep_worst(worst, off - allowed, std::move(f));
}

/// X₁, X₂ relative to the phase of heave against (P68). In waves that are long, but not in finite depth infinitely
/// so, the horizontal acceleration is i g k along the heading.
Eigen::Vector2cd expected_push(const Patient& p, int body, std::size_t w, double heading) {
  const double g = p.c.water.gravity, k = p.k[w], omega = p.c.omega[w];
  const Eigen::Vector2d along(std::cos(heading), std::sin(heading));
  const Complex here = elevation_at(p, body, w, heading);
  Eigen::Vector2cd sum = displaced_mass(p, body).value_or(0) * Complex(0, g * k) * along.cast<Complex>();
  for (int b = 0; b < p.c.bodies(); ++b) {
    const Complex there = elevation_at(p, b, w, heading) / here;
    const Eigen::Vector2d A = p.c.A[w].block<2, 2>(row_of(body), row_of(b)) * along;
    const Eigen::Vector2d B = p.c.B[w].block<2, 2>(row_of(body), row_of(b)) * along;
    sum += there * g * k * (Complex(0, 1) * A.cast<Complex>() + (B / omega).cast<Complex>());
  }
  return sum;
}

/// Loads of surge, sway and heave on one body in the longest wave of one heading.
struct Pushed {
  double heading;
  Eigen::Vector3cd X;
};

struct PushMisfit {
  double off;    ///< of what is expected
  double ratio;  ///< of the given load to the expected, along it
};

PushMisfit push_misfit(const Patient& p, int body, const Pushed& given) {
  const Complex lift = given.X(2), here = elevation_at(p, body, 0, given.heading);
  // Heave tells the phase of the wave at the body, wherever that is; a body without waterplane is taken at its place.
  const bool by_heave = floats(p, body) && std::abs(lift) > 0;
  const Complex phase =
      by_heave ? std::polar(1.0, -std::arg(lift / expected_heave(p, body, 0, given.heading) * here)) : std::conj(here);
  const Eigen::Vector2cd push = phase * given.X.head<2>(), expected = expected_push(p, body, 0, given.heading);
  // An unknown volume may add any mass to what A and B make.
  const Eigen::Vector2cd per_mass = Complex(0, p.c.water.gravity * p.k.front()) *
                                    Eigen::Vector2d(std::cos(given.heading), std::sin(given.heading)).cast<Complex>();
  double mass = 0;
  if (!displaced_mass(p, body)) mass = std::max(0.0, per_mass.dot(push - expected).real() / per_mass.squaredNorm());
  const Eigen::Vector2cd best = expected + mass * per_mass;
  return {(push - best).norm() / best.norm(), expected.dot(push).real() / expected.squaredNorm()};
}

constexpr double usual_push = 0.2, impossible_push = 0.5;

/// A mistake that files make, and loads without it.
struct Mistake {
  const char* name;
  Pushed (*undone)(Pushed);
};

constexpr std::array<Mistake, 4> mistakes{{
    {"the phases are of the other time factor",
     [](Pushed x) {
       return Pushed{x.heading, x.X.conjugate()};
     }},
    {"headings are where waves come from",
     [](Pushed x) {
       return Pushed{x.heading + std::numbers::pi, x.X};
     }},
    {"headings are counted the other way round",
     [](Pushed x) {
       return Pushed{-x.heading, x.X};
     }},
    {"surge and sway are exchanged",
     [](Pushed x) {
       return Pushed{x.heading, Eigen::Vector3cd(x.X(1), x.X(0), x.X(2))};
     }},
}};

/// By how much the part of heave that leads the wave is off without a mistake, N/m, largest over the headings; nothing
/// if surge and sway do not fit then either.
std::optional<double> heave_without(const Patient& p, int body, const Mistake& mistake) {
  double off = 0;
  for (std::size_t h = 0; h < p.c.heading.size(); ++h) {
    const Pushed x = mistake.undone({p.c.heading[h], p.c.X[h].block<3, 1>(row_of(body), 0)});
    if (push_misfit(p, body, x).off > usual_push) return std::nullopt;
    const Complex here = elevation_at(p, body, 0, x.heading);
    off = std::max(off, std::abs(((x.X(2) - expected_heave(p, body, 0, x.heading)) / here).imag()));
  }
  return off;
}

/// The mistake without which surge and sway of all headings are right. The time factor and headings where waves come
/// from make the same of them: heave leads the wave by damping, whose sign tells the two apart. (P68)
std::string likely_mistake(const Patient& p, int body) {
  std::vector<std::pair<double, std::string>> fitting;
  for (const Mistake& mistake : mistakes)
    if (const auto off = heave_without(p, body, mistake)) fitting.emplace_back(*off, mistake.name);
  if (fitting.empty()) return {};
  const double best = std::min_element(fitting.begin(), fitting.end())->first;
  std::string out = "probably ";
  constexpr double as_well = 2;  // the sign of damping makes one of them far worse than the other
  for (const auto& [off, name] : fitting)
    if (off <= as_well * best) out += (out.ends_with(' ') ? "" : ", or ") + name;
  return out;
}

void look_at_push(const Patient& p, int body, std::size_t h, Case& worst) {
  const auto [off, ratio] = push_misfit(p, body, {p.c.heading[h], p.c.X[h].block<3, 1>(row_of(body), 0)});
  Finding f{.severity = graded(off, usual_push, impossible_push),
            .check = "surge and sway in long waves",
            .where = place(p, body, 0, h, "surge and sway"),
            .message = fmt::format("X₁, X₂ differ by {:.2g} of {} the water's acceleration makes them{}", off,
                                   displaced_mass(p, body) ? "what ρV and A times" : "what A and some unknown ρV times",
                                   ratio < 0 ? ", and push against it" : ""),
            .body = body + 1,
            .omega = p.c.omega.front()};
  if (f.severity != Severity::note) {
    if (off > impossible_push && ratio > 0)
      f.message += fmt::format(" (ratio {:.3g}{})", ratio, likely_cause(ratio, p.c.water));
    f.why = "long waves push along their heading, a quarter period before the crest (P68)";
    f.remedy = likely_mistake(p, body);
    if (f.remedy.empty())
      f.remedy =
          "look at units of phases (degrees, radians), time factor, order and sense of headings, order of modes, units "
          "of A, volume and density";
  }
  keep_worst(worst, off, std::move(f));
}

/// X₄, X₅ in phase with heave against C₄₃, C₅₃: both are C₃₃ times the way from reference point to waterplane. (P69)
void look_at_moments(const Patient& p, int body, std::size_t h, Case& worst) {
  const Index i = row_of(body);
  const Complex X3 = p.c.X[h](i + 2, 0);
  const double C33 = (*p.c.C)(i + 2, i + 2), length = length_of(p, body);
  if (!(std::abs(X3) > 0)) return;
  const Eigen::Vector2d from_X(-(p.c.X[h](i + 4, 0) / X3).real(), (p.c.X[h](i + 3, 0) / X3).real());
  const Eigen::Vector2d from_C(-(*p.c.C)(i + 4, i + 2) / C33, (*p.c.C)(i + 3, i + 2) / C33);
  const double off = (from_X - from_C).norm() / length;
  Finding f{.severity = graded(off, 0.15, 0.4),
            .check = "moments in long waves",
            .where = place(p, body, 0, h, "roll and pitch"),
            .message = fmt::format("X₄ and X₅ put the waterplane's centre at ({:.3g}, {:.3g}) m from the reference "
                                   "point, C at ({:.3g}, {:.3g}) m",
                                   from_X.x(), from_X.y(), from_C.x(), from_C.y()),
            .body = body + 1,
            .omega = p.c.omega.front()};
  if (f.severity != Severity::note) {
    f.why = "the moment of a long wave is its lift times the way to the waterplane (P69), as that of C is";
    f.remedy = "X and C are about different points, or of different units of length: move one of them";
  }
  keep_worst(worst, off, std::move(f));
}

/// The way from where a body is said to be to where the phase of its heave puts it: least squares over all long waves
/// and headings. One heading tells only the way along it.
void look_at_place(const Patient& p, int body, Case& worst) {
  const auto centre = waterplane_centre(p, body);
  if (!centre) return;
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (std::size_t h = 0; h < p.c.heading.size(); ++h)
    for (std::size_t w = 0; w < p.c.omega.size() && is_long(p, body, w) && departure(p, body, w) < 0.3; ++w) {
      const Complex X3 = p.c.X[h](row_of(body) + 2, static_cast<Index>(w));
      const double phase = std::arg(X3 / expected_heave(p, body, w, p.c.heading[h]));
      const Eigen::Vector2d along = -p.k[w] * Eigen::Vector2d(std::cos(p.c.heading[h]), std::sin(p.c.heading[h]));
      normal += along * along.transpose();
      right += along * phase;
    }
  if (!(normal.trace() > 0)) return;
  normal += 1e-6 * normal.trace() * Eigen::Matrix2d::Identity();  // no way across a single heading
  const Eigen::Vector2d way = normal.inverse() * right;
  const double off = way.norm() / length_of(p, body);
  Finding f{.severity = graded(off, 0.3, 0.6),
            .check = "place of the bodies",
            .where = fmt::format("X of heave of body {}, long waves", body + 1),
            .message = fmt::format("phases put body {} at ({:.3g}, {:.3g}) m; its reference point and C put it at "
                                   "({:.3g}, {:.3g}) m",
                                   body + 1, centre->x() + way.x(), centre->y() + way.y(), centre->x(), centre->y()),
            .body = body + 1};
  if (f.severity != Severity::note) {
    f.why = "the crest of a long wave is felt when it passes the body (P69)";
    f.remedy = "look at the order of the bodies, at the reference points, and at the point that phases are relative to";
  }
  keep_worst(worst, off, std::move(f));
}

void add(const Case& worst, const char* check, const char* reason, Findings& out) {
  out.push_back(worst.known ? worst.finding : not_looked_at(check, reason));
}

}  // namespace

void check_long_waves(const Patient& p, Findings& out) {
  Case heave, push, moments, places;
  for (int body = 0; body < p.c.bodies() && !p.c.X.empty(); ++body) {
    if (!is_long(p, body, 0)) continue;
    for (std::size_t h = 0; h < p.c.heading.size(); ++h) {
      if (floats(p, body)) look_at_heave(p, body, h, heave);
      look_at_push(p, body, h, push);
      if (floats(p, body)) look_at_moments(p, body, h, moments);
    }
    if (floats(p, body)) look_at_place(p, body, places);
  }
  const char* reason =
      p.c.X.empty() ? "there is no excitation" : "no wave is long against the bodies, or there is no C";
  add(heave, "heave in long waves", reason, out);
  add(push, "surge and sway in long waves", reason, out);
  add(moments, "moments in long waves", reason, out);
  add(places, "place of the bodies", p.c.X.empty() ? reason : "no wave is long, or C or reference points are unknown",
      out);
}

}  // namespace hydro::potential::doctor
