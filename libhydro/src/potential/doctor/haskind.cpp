// Damping from excitation: the waves that a motion makes are those that push it. (P64)-(P66)
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include <Eigen/SparseCore>

#include "doctor.hpp"
#include "hydro/waves/dispersion.hpp"
#include "potential/modes.hpp"
#include "potential/readers.hpp"

namespace hydro::potential::doctor {
namespace {

using Eigen::Index;

using Complex = std::complex<double>;
using std::numbers::pi;
constexpr double same_angle = 1e-4;  // rad: degrees written with two decimals

/// What a mirror or a turn of the array makes of modes: a few entries a row, however many bodies there are.
using MapOfModes = Eigen::SparseMatrix<double>;

/// Excitation at one heading, from the data or by a mirror.
struct Heading {
  double angle;        // 0 … 2π
  std::size_t source;  // index in the data
  MapOfModes by;       // X(angle) = by · X(source); empty: as it is
};

double wrapped(double angle) {
  const double a = std::remainder(angle, 2 * pi);
  return a < -same_angle / 2 ? a + 2 * pi : std::max(0.0, a);
}

bool holds(const std::vector<Heading>& list, double angle) {
  return std::any_of(list.begin(), list.end(),
                     [&](const Heading& h) { return std::abs(std::remainder(h.angle - angle, 2 * pi)) < same_angle; });
}

/// What a mirror of the array makes of modes: body b goes to its image, modes keep or change sign. Empty if the bodies
/// are not at mirrored places. (P65)
std::optional<MapOfModes> mirror(const Coefficients& c, bool across_x) {
  // x → −x turns surge, pitch and yaw; y → −y turns sway, roll and yaw.
  const std::array<double, 6> sign =
      across_x ? std::array<double, 6>{-1, 1, 1, 1, -1, -1} : std::array<double, 6>{1, -1, 1, -1, 1, -1};
  MapOfModes P(c.modes(), c.modes());
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const auto& b : c.body) {
    if (!b.reference_point && c.bodies() > 1) return std::nullopt;
    centre += b.reference_point.value_or(Eigen::Vector3d::Zero()) / c.bodies();
  }
  for (int b = 0; b < c.bodies(); ++b) {
    Eigen::Vector3d image = c.body[static_cast<std::size_t>(b)].reference_point.value_or(Eigen::Vector3d::Zero());
    const int axis = across_x ? 0 : 1;
    image[axis] = 2 * centre[axis] - image[axis];
    int partner = -1;
    for (int q = 0; q < c.bodies(); ++q)
      if ((c.body[static_cast<std::size_t>(q)].reference_point.value_or(Eigen::Vector3d::Zero()) - image).norm() < 1e-3)
        partner = q;
    if (partner < 0) return std::nullopt;
    for (int m = 0; m < 6; ++m) P.insert(6 * partner + m, 6 * b + m) = sign[static_cast<std::size_t>(m)];
  }
  return P;
}

/// Whether the data are unchanged by the mirror, within what a mesh leaves. Kernels of a symmetric array must be; that
/// the array is symmetric does not follow strictly, but nothing else in the data could show that it is not. (P65)
bool is_symmetric_under(const MapOfModes& P, const Patient& p) {
  const MapOfModes back = P.transpose();
  const auto unchanged = [&](const std::vector<Eigen::MatrixXd>& matrices, const Eigen::VectorXd& s) {
    for (const auto& M : matrices) {
      const Eigen::MatrixXd half = P * M, d = M - half * back;
      for (Index i = 0; i < d.rows(); ++i)
        for (Index j = 0; j < d.cols(); ++j)
          if (std::abs(d(i, j)) > usual_asymmetry * size_of_entry(s, i, j)) return false;
    }
    return true;
  };
  return unchanged(p.c.A, p.size_of_A) && unchanged(p.c.B, p.size_of_B);
}

/// How a load is off from the image of one, of the largest of its mode.
struct OffImage {
  double off = 0;
  Index mode = 0;
  std::size_t heading = 0, source = 0;
};

/// By how much X at one heading is, mode by mode, not the image of X at another, relative to the largest of all
/// headings at that frequency: in the upper quartile over the frequencies, so that one number does not count. The phase
/// that the place of the plane brings is common to all modes. (P44)
OffImage off_image(const Patient& p, const MapOfModes& P, std::size_t h, std::size_t source) {
  constexpr double dying = 0.1;  // of the mode's largest: below, short waves leave what a mesh makes of them
  const auto modes = static_cast<std::size_t>(p.c.modes());
  Eigen::VectorXd size = Eigen::VectorXd::Zero(p.c.modes());
  for (const auto& X : p.c.X) size = size.cwiseMax(X.cwiseAbs().rowwise().maxCoeff());
  size = with_floor(size);
  std::vector<std::vector<double>> off(modes);
  for (Index w = 0; w < static_cast<Index>(p.c.omega.size()); ++w) {
    Eigen::VectorXd largest = dying * size;
    for (const auto& X : p.c.X) largest = largest.cwiseMax(X.col(w).cwiseAbs());
    largest = (largest.array() > 0).select(largest, 1);
    const Eigen::VectorXcd image = P.cast<Complex>() * p.c.X[source].col(w), here = p.c.X[h].col(w);
    const Complex common =
        image.cwiseQuotient(largest.cast<Complex>()).dot(here.cwiseQuotient(largest.cast<Complex>()));
    const Complex phase = std::abs(common) > 0 ? common / std::abs(common) : Complex(1);
    // What a load of its own image lacks to be that is half of what parts the two.
    const Eigen::VectorXd apart = (here - phase * image).cwiseAbs().cwiseQuotient((h == source ? 2.0 : 1.0) * largest);
    for (std::size_t i = 0; i < modes; ++i) off[i].push_back(apart(static_cast<Index>(i)));
  }
  OffImage worst{0, 0, h, source};
  for (std::size_t i = 0; i < modes; ++i)
    if (const double here = quantile(off[i], 0.75); here > worst.off) worst = {here, static_cast<Index>(i), h, source};
  return worst;
}

/// A plane in which A and B are symmetric: x = 0 or y = 0 of the array.
struct Plane {
  bool across_x;
  MapOfModes map;

  double image_of(double heading) const { return across_x ? pi - heading : -heading; }
  const char* name() const { return across_x ? "fore and aft" : "port and starboard"; }
};

std::vector<Plane> planes_of_symmetry(const Patient& p) {
  std::vector<Plane> out;
  for (const bool across_x : {true, false})
    if (auto map = mirror(p.c, across_x); map && is_symmetric_under(*map, p)) out.push_back({across_x, *map});
  return out;
}

/// Of headings whose image in the plane is given too, or that are their own, the one that is farthest from it.
OffImage farthest_from_image(const Patient& p, const Plane& plane) {
  OffImage worst;
  for (std::size_t h = 0; h < p.c.heading.size(); ++h)
    for (std::size_t g = 0; g <= h; ++g)
      if (std::abs(std::remainder(p.c.heading[h] - plane.image_of(p.c.heading[g]), 2 * pi)) < same_angle)
        if (const OffImage here = off_image(p, plane.map, h, g); here.off > worst.off) worst = here;
  return worst;
}

// Loads of good meshes keep within 0.02 of their images; what no mesh does is another mode's load.
constexpr double usual_off_image = 0.1, impossible_off_image = 0.3;

Finding image_finding(const Patient& p, const Plane& plane, const OffImage& worst) {
  const auto degrees = [&](std::size_t h) { return Angle::from_radians(p.c.heading[h]).degrees(); };
  return {.severity = worst.off > impossible_off_image ? Severity::error : Severity::warning,
          .check = "Haskind relation",
          .where = fmt::format("X of {}, heading {:.4g} deg", mode_label(worst.mode), degrees(worst.heading)),
          .message = worst.heading == worst.source
                         ? fmt::format("A and B are symmetric {}, which leaves this load nothing: it is off by {:.2g} "
                                       "of the mode's largest (upper quartile over the frequencies)",
                                       plane.name(), worst.off)
                         : fmt::format("A and B are symmetric {}; this load is off by {:.2g} of the mode's largest "
                                       "from the image of that of {:.4g} deg (upper quartile over the frequencies)",
                                       plane.name(), worst.off, degrees(worst.source)),
          .why =
              "waves along the plane of a symmetric array push nothing across it, and mirrored waves make mirrored "
              "loads (P44)",
          .remedy =
              "look at the order of modes and headings of X against that of A and B, and whether they are of one "
              "body",
          .body = static_cast<int>(worst.mode / 6) + 1};
}

/// Planes whose images the loads that are given are; a finding for each other one.
std::vector<Plane> planes_of_loads(const Patient& p, Findings& out) {
  std::vector<Plane> sound;
  for (Plane& plane : planes_of_symmetry(p)) {
    const OffImage worst = farthest_from_image(p, plane);
    if (worst.off > usual_off_image)
      out.push_back(image_finding(p, plane, worst));
    else
      sound.push_back(std::move(plane));
  }
  return sound;
}

/// Whether the only body is one of revolution about the vertical axis through its reference point: turned by an angle
/// it has the same A and B, and turning about its axis moves no water, A₆₆ = 0. (P65)
bool is_of_revolution(const Patient& p) {
  if (p.c.bodies() != 1) return false;
  Eigen::MatrixXd turn = Eigen::MatrixXd::Identity(6, 6);
  const double s = std::sqrt(0.5);
  for (const Index i : {0, 3}) turn.block<2, 2>(i, i) << s, -s, s, s;
  // Medians, since a spike in heave would make the body so large that any yaw is small beside it.
  const auto usual = [&](Index i) {
    std::vector<double> values;
    for (const auto& A : p.c.A) values.push_back(std::abs(A(i, i)));
    return quantile(std::move(values), 0.5);
  };
  const double yaw = usual(5), heave = usual(2);
  const double length = std::cbrt(heave / p.c.water.density);
  return yaw < 1e-3 * heave * length * length && is_symmetric_under(turn.sparseView(), p);
}

/// X at eight headings from that at one, for a body of revolution: no harmonic of X in β is higher than the first.
std::vector<Heading> turned_about(const Patient& p) {
  constexpr std::size_t count = 8;
  std::vector<Heading> list;
  for (std::size_t h = 0; h < count; ++h) {
    const double angle = 2 * pi * static_cast<double>(h) / count, turn = angle - p.c.heading.front();
    Eigen::MatrixXd R = Eigen::MatrixXd::Identity(6, 6);
    for (const Index i : {0, 3}) R.block<2, 2>(i, i) << std::cos(turn), -std::sin(turn), std::sin(turn), std::cos(turn);
    list.push_back({angle, 0, R.sparseView()});
  }
  return list;
}

/// Headings of the data and their images, if they are evenly spread over the circle; else empty.
std::vector<Heading> circle(const Patient& p, const std::vector<Plane>& planes) {
  if (planes.size() == 2 && is_of_revolution(p)) return turned_about(p);
  std::array<std::optional<MapOfModes>, 2> across;
  for (const Plane& plane : planes) across[plane.across_x ? 0 : 1] = plane.map;
  std::vector<Heading> list;
  const auto add = [&](double angle, std::size_t source, const MapOfModes& by) {
    if (!holds(list, angle)) list.push_back({wrapped(angle), source, by});
  };
  const auto& beta = p.c.heading;
  for (std::size_t h = 0; h < beta.size(); ++h) add(beta[h], h, {});
  for (std::size_t h = 0; h < beta.size(); ++h) {
    if (across[1]) add(-beta[h], h, *across[1]);
    if (across[0]) add(pi - beta[h], h, *across[0]);
    if (across[0] && across[1]) add(pi + beta[h], h, *across[0] * *across[1]);
  }
  std::sort(list.begin(), list.end(), [](const Heading& a, const Heading& b) { return a.angle < b.angle; });
  const double step = 2 * pi / static_cast<double>(list.size());
  for (std::size_t h = 0; h < list.size(); ++h)
    if (std::abs(list[h].angle - list.front().angle - static_cast<double>(h) * step) > same_angle) return {};
  // Half of them must be enough for a rougher answer, by which the finer one is judged.
  return list.size() >= 4 && list.size() % 2 == 0 ? list : std::vector<Heading>{};
}

/// k / (8π ρ g c_g), which turns ∮ X X* dβ into B. (P64)
double haskind_factor(const Patient& p, std::size_t w) {
  const Water& water = p.c.water;
  return p.k[w] / (8 * pi * water.density * water.gravity * waves::group_velocity(p.c.omega[w], water));
}

/// B of (P64) at one frequency by the trapezium rule over every `stride`-th heading.
Eigen::MatrixXd damping_from_excitation(const Patient& p, const std::vector<Heading>& list, std::size_t w,
                                        std::size_t stride) {
  // The real part of X X* of one heading is that of the two vectors of its parts.
  Eigen::MatrixXd parts(p.c.modes(), static_cast<Index>(2 * ((list.size() + stride - 1) / stride)));
  Index at = 0;
  for (std::size_t h = 0; h < list.size(); h += stride) {
    const auto X = p.c.X[list[h].source].col(static_cast<Index>(w));
    for (const Eigen::VectorXd& part : {Eigen::VectorXd(X.real()), Eigen::VectorXd(X.imag())})
      parts.col(at++) = list[h].by.size() > 0 ? Eigen::VectorXd(list[h].by * part) : part;
  }
  const double step = 2 * pi * static_cast<double>(stride) / static_cast<double>(list.size());
  return haskind_factor(p, w) * step * parts * parts.transpose();
}

/// One comparison of a damping from excitation with the one in the data.
struct Comparison {
  std::size_t w;
  Eigen::MatrixXd from_excitation;
};

/// At the frequencies where the headings are dense enough: where half of them give the same.
std::vector<Comparison> over_the_circle(const Patient& p, const std::vector<Heading>& list) {
  constexpr double dense_enough = 0.02;
  std::vector<Comparison> out;
  for (std::size_t w = 0; w < p.c.omega.size(); ++w) {
    const Eigen::MatrixXd fine = damping_from_excitation(p, list, w, 1), rough = damping_from_excitation(p, list, w, 2);
    const double trace = fine.diagonal().cwiseQuotient(p.size_of_B.cwiseMax(1e-300)).sum();
    double change = 0;
    for (Index i = 0; i < fine.rows(); ++i)
      for (Index j = 0; j < fine.cols(); ++j)
        change = std::max(change, std::abs(fine(i, j) - rough(i, j)) / size_of_entry(p.size_of_B, i, j));
    if (change <= dense_enough * std::max(trace, 1e-300)) out.push_back({w, fine});
  }
  return out;
}

struct Ratio {
  double value = 1;
  Index mode = 0;
  std::size_t w = 0;
  bool known = false;
};

/// The mode whose B from excitation is, in the median over the frequencies, farthest from B.
Ratio worst_ratio(const Patient& p, const std::vector<Comparison>& list) {
  Ratio worst;
  for (Index i = 0; i < p.c.modes(); ++i) {
    if (!acts(p.c.B, p.size_of_B, i)) continue;
    std::vector<std::pair<double, std::size_t>> ratios;
    for (const auto& one : list) {
      const double given = p.c.B[one.w](i, i);
      // Below this, B is a small difference of large pressures, and its relative error says little.
      if (given > 0.01 * p.size_of_B(i)) ratios.emplace_back(one.from_excitation(i, i) / given, one.w);
    }
    if (ratios.empty()) continue;
    std::nth_element(ratios.begin(), ratios.begin() + static_cast<long>(ratios.size() / 2), ratios.end());
    const auto [value, w] = ratios[ratios.size() / 2];
    const auto distance = [](double r) { return r > 0 ? std::abs(std::log(r)) : 1e300; };
    if (!worst.known || distance(value) > distance(worst.value)) worst = {value, i, w, true};
  }
  return worst;
}

/// The entry that is farthest off in the sense of (P11), in the upper quartile over the frequencies: spikes, which
/// another check finds, do not count.
std::pair<double, std::array<Index, 2>> worst_entry(const Patient& p, const std::vector<Comparison>& list) {
  std::pair<double, std::array<Index, 2>> worst{0, {0, 0}};
  std::vector<double> errors(list.size());
  for (Index i = 0; i < p.c.modes(); ++i)
    for (Index j = 0; j < p.c.modes(); ++j) {
      for (std::size_t n = 0; n < list.size(); ++n)
        errors[n] = std::abs(list[n].from_excitation(i, j) - p.c.B[list[n].w](i, j)) / size_of_entry(p.size_of_B, i, j);
      if (const double error = quantile(errors, 0.75); error > worst.first) worst = {error, {i, j}};
    }
  return worst;
}

constexpr const char* why =
    "damping and excitation are two faces of the same waves (Haskind; (P64)): a wrong unit, density, phase or body "
    "shows here";
constexpr const char* remedy =
    "look at ULEN, density, units and the order of bodies and headings of A, B and X; they may come from two runs";

/// Ratios of good data keep within 3 %; a tenth is what coarse meshes do, a third no mesh.
constexpr double usual_ratio = 1.15, impossible_ratio = 1.35;

void grade(Finding& f, const Ratio& ratio, const Patient& p) {
  f.message += fmt::format("{} of {} is {:.3g} times as large as the B that is given (median over the frequencies)",
                           f.message.empty() ? "B from excitation" : "; that", mode_label(ratio.mode), ratio.value);
  const double off = ratio.value > 0 ? std::max(ratio.value, 1 / ratio.value) : 1e300;
  if (off > usual_ratio) {
    f.severity = off > impossible_ratio ? Severity::error : Severity::warning;
    f.message += likely_cause(ratio.value, p.c.water);
  }
  f.where = fmt::format("B({0}, {0}): {1}", ratio.mode + 1, mode_label(ratio.mode));
  f.body = static_cast<int>(ratio.mode / 6) + 1;
  f.entry = {{static_cast<int>(ratio.mode) + 1, static_cast<int>(ratio.mode) + 1}};
}

Finding circle_finding(const Patient& p, const std::vector<Comparison>& list, std::size_t headings) {
  Finding f{.check = "Haskind relation", .where = "B"};
  if (const Ratio ratio = worst_ratio(p, list); ratio.known) grade(f, ratio, p);
  const auto [error, entry] = worst_entry(p, list);
  f.message += fmt::format("{}{} headings, up to {:.3g} rad/s; farthest entry {:.2g} of sqrt(B_ii B_jj)",
                           f.message.empty() ? "" : "; ", headings, p.c.omega[list.back().w], error);
  constexpr double usual = 0.06, impossible = 0.2;  // good data keep within 0.03
  if (error > usual) {
    f.severity = std::max(f.severity, error > impossible ? Severity::error : Severity::warning);
    f.where = entry_text("B", entry[0], entry[1], "all frequencies");
    f.body = static_cast<int>(entry[0] / 6) + 1;
    f.entry = {{static_cast<int>(entry[0]) + 1, static_cast<int>(entry[1]) + 1}};
  }
  if (f.severity != Severity::note) {
    f.why = why;
    f.remedy = remedy;
  }
  return f;
}

/// In waves long against the body, heave is pushed alike from everywhere: ∮|X₃|² dβ = 2π|X₃|² at any heading. (P66)
std::vector<Comparison> heave_in_long_waves(const Patient& p) {
  std::vector<Comparison> out;
  for (std::size_t w = 0; w < p.c.omega.size(); ++w) {
    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(p.c.modes(), p.c.modes());
    bool long_enough = p.c.C.has_value();
    for (Index i = 2; i < p.c.modes() && long_enough; i += 6) {
      const double C33 = (*p.c.C)(i, i), area = C33 / (p.c.water.density * p.c.water.gravity);
      const double inertia = p.c.omega[w] * p.c.omega[w] * p.c.A[w](i, i);
      long_enough = C33 > 0 && p.k[w] * std::sqrt(area) < 0.3 && inertia < 0.3 * C33;
      B(i, i) = haskind_factor(p, w) * 2 * pi * std::norm(p.c.X.front()(i, static_cast<Index>(w)));
    }
    if (long_enough) out.push_back({w, B});
  }
  return out;
}

/// As worst_ratio, of heave alone and with the small B of long waves.
Ratio worst_heave_ratio(const Patient& p, const std::vector<Comparison>& list) {
  Ratio worst;
  for (Index i = 2; i < p.c.modes(); i += 6) {
    std::vector<double> ratios;
    for (const auto& one : list)
      if (const double given = p.c.B[one.w](i, i); std::abs(given) > 1e-3 * p.size_of_B(i))
        ratios.push_back(one.from_excitation(i, i) / given);
    if (ratios.empty()) continue;
    std::nth_element(ratios.begin(), ratios.begin() + static_cast<long>(ratios.size() / 2), ratios.end());
    const double value = ratios[ratios.size() / 2];
    const auto distance = [](double r) { return r > 0 ? std::abs(std::log(r)) : 1e300; };
    if (!worst.known || distance(value) > distance(worst.value)) worst = {value, i, list.front().w, true};
  }
  return worst;
}

}  // namespace

void check_haskind(const Patient& p, Findings& out) {
  if (p.c.X.empty()) {
    out.push_back(not_looked_at("Haskind relation", "there is no excitation"));
    return;
  }
  if (const auto headings = circle(p, planes_of_loads(p, out)); !headings.empty())
    if (const auto list = over_the_circle(p, headings); !list.empty()) {
      out.push_back(circle_finding(p, list, headings.size()));
      return;
    }
  const auto list = heave_in_long_waves(p);
  const Ratio ratio = list.empty() ? Ratio{} : worst_heave_ratio(p, list);
  if (!ratio.known) {
    out.push_back(not_looked_at("Haskind relation", "the headings do not cover the circle and no wave is long enough"));
    return;
  }
  Finding f{.check = "Haskind relation"};
  grade(f, ratio, p);
  f.message += ", in long waves, since the headings do not cover the circle";
  if (f.severity != Severity::note) {
    f.why = why;
    f.remedy = remedy;
  }
  out.push_back(std::move(f));
}

}  // namespace hydro::potential::doctor
