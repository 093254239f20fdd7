// C and the displaced volume: what still water allows. (P70), (P71)
#include <algorithm>
#include <cmath>
#include <numbers>

#include "doctor.hpp"
#include "potential/readers.hpp"

namespace hydro::potential::doctor {
namespace {

using Eigen::Index;

/// Size of an entry of C of one body, from C₃₃ and a length: N/m, N or N m.
double size_of_C(Index i, Index j, double C33, double length) {
  const int rotations = static_cast<int>(!is_translation(i)) + static_cast<int>(!is_translation(j));
  return C33 * std::pow(length, rotations);
}

struct Fault {
  double value = 0;
  Index i = 0, j = 0;
  std::string message;
};

/// Entries of a floating body's C that have to vanish, or to equal another. Rows and columns of surge and sway, and the
/// row of yaw, are zero; only the weight's moment about a point off its vertical makes C₄₆, C₅₆. (P70)
Fault worst_fault(const Eigen::MatrixXd& C, double length) {
  Fault worst;
  const double C33 = C(2, 2);
  const auto look = [&](double value, Index i, Index j, const std::string& message) {
    const double size = std::abs(value) / size_of_C(i, j, C33, length);
    if (size > worst.value) worst = {size, i, j, message};
  };
  for (Index i = 0; i < 6; ++i)
    for (Index j = 0; j < 6; ++j) {
      const bool horizontal = i < 2 || j < 2 || i == 5;
      if (horizontal) look(C(i, j), i, j, "has to be zero: still water does not resist surge, sway and yaw");
      if (!horizontal && j < 5 && i < j) look(C(i, j) - C(j, i), i, j, "has to equal its mirror image");
    }
  look(C(2, 5), 2, 5, "has to be zero: yaw does not change buoyancy");
  return worst;
}

/// Without a waterplane only weight and buoyancy restore, alike in roll and pitch, by the way between their centres.
bool is_of_submerged(const Patient& p, int body, const Eigen::MatrixXd& C) {
  const BodyData& b = p.c.body[static_cast<std::size_t>(body)];
  if (!b.displaced_volume || !b.centre_of_buoyancy || !b.centre_of_gravity || !C.block<1, 3>(2, 2).isZero(0))
    return false;
  constexpr double same = 1e-2;  // of a body whose centres are as far apart as it is large
  const double weight = p.c.water.density * p.c.water.gravity * *b.displaced_volume;
  const double restoring = weight * (b.centre_of_buoyancy->z() - b.centre_of_gravity->z());
  const double slack = same * weight * std::cbrt(*b.displaced_volume);
  return std::abs(C(3, 3) - restoring) <= slack && std::abs(C(4, 4) - restoring) <= slack;
}

Finding restoring_finding(const Patient& p, int body) {
  const Index at = 6 * static_cast<Index>(body);
  const Eigen::MatrixXd C = p.c.C->block<6, 6>(at, at);
  const double C33 = C(2, 2);
  Finding f{.check = "restoring matrix", .where = fmt::format("C of body {}", body + 1), .body = body + 1};
  if (is_of_submerged(p, body, C)) {
    f.message = "C₃₃ is 0 and C₄₄ and C₅₅ are those of its weight and buoyancy: the body is wholly under water";
    return f;
  }
  if (!(C33 > 0)) {
    f.severity = C33 < 0 || C.norm() > 0 ? Severity::error : Severity::warning;
    f.entry = {{static_cast<int>(at) + 3, static_cast<int>(at) + 3}};
    f.message =
        fmt::format("C₃₃ is {:.4g} N/m; a body that pierces the surface has C₃₃ = ρ g times its waterplane", C33);
    f.why = "without C₃₃ a floating body sinks or flies (P70)";
    f.remedy = "state the hydrostatics of this body; accept this finding if it is wholly submerged";
    return f;
  }
  const double area = C33 / (p.c.water.density * p.c.water.gravity);
  const Fault fault = worst_fault(C, std::sqrt(area));
  f.message = fmt::format("C₃₃ means a waterplane of {:.4g} m²; the largest entry out of place is {:.2g} of its size",
                          area, fault.value);
  constexpr double usual = 0.02, impossible = 0.2;
  if (fault.value > usual) {
    f.severity = fault.value > impossible ? Severity::error : Severity::warning;
    f.where = entry_text("C", at + fault.i, at + fault.j, "rest");
    f.entry = {{static_cast<int>(at + fault.i) + 1, static_cast<int>(at + fault.j) + 1}};
    f.message += ": it " + fault.message;
    f.why = "hydrostatic loads of a body in balance have a potential (P70)";
    f.remedy = "leave moorings to the scene; look at signs, and at whether C was moved to another point";
  }
  return f;
}

/// Coupling through still water does not exist.
void check_blocks_between_bodies(const Patient& p, Findings& out) {
  for (int a = 0; a < p.c.bodies(); ++a)
    for (int b = 0; b < p.c.bodies(); ++b) {
      const Eigen::MatrixXd block = p.c.C->block<6, 6>(6 * a, 6 * b);
      if (a == b || block.isZero(0)) continue;
      out.push_back({.severity = Severity::warning,
                     .check = "restoring matrix",
                     .where = fmt::format("C of body {} and body {}", a + 1, b + 1),
                     .message = fmt::format("entries up to {:.4g} couple the bodies", block.cwiseAbs().maxCoeff()),
                     .why = "still water does not couple bodies (P70)",
                     .remedy = "put connectors into the scene, not into C",
                     .body = a + 1});
      return;
    }
}

/// C₄₄ + C₅₅ about the reference point less what volume and weight make of it, over ρg: Ixx + Iyy of the waterplane.
std::optional<double> polar_moment(const Patient& p, int body) {
  const auto& b = p.c.body[static_cast<std::size_t>(body)];
  if (!b.displaced_volume || !b.centre_of_buoyancy || !b.centre_of_gravity) return std::nullopt;
  const Index at = 6 * static_cast<Index>(body);
  const auto& C = *p.c.C;
  return (C(at + 3, at + 3) + C(at + 4, at + 4)) / (p.c.water.density * p.c.water.gravity) -
         2 * *b.displaced_volume * (b.centre_of_buoyancy->z() - b.centre_of_gravity->z());
}

void require_room_for_volume(const Patient& p, int body, double area, Finding& f) {
  const double V = *p.c.body[static_cast<std::size_t>(body)].displaced_volume;
  const double draught = V / area, width = std::sqrt(area);
  f.message = fmt::format("V/A_wp is {:.4g} m, {:.3g} of the waterplane's width", draught, draught / width);
  // From a raft of a hand's breadth to a spar (40); semi-submersibles of slim columns may reach more.
  constexpr double least = 1e-4, most = 100;
  if (draught > least * width && draught < most * width) return;
  f.severity = V > 0 ? Severity::error : Severity::warning;
  f.message += "; from a raft to a spar it is 0.001 to 50" + likely_cause(draught / width, p.c.water);
  f.why = "C₃₃ = ρ g A_wp, and a body of that waterplane would not displace this volume (P71)";
  f.remedy = "look at gravity, density and length scale of C, and at the volume";
}

/// Of all waterplanes of one area the disc has the smallest Ixx + Iyy, A²/2π, about its centre. (P71)
void require_possible_moment(const Patient& p, int body, double area, Finding& f) {
  const auto moment = polar_moment(p, body);
  if (!moment || f.severity != Severity::note) return;
  const double least = area * area / (2 * std::numbers::pi), ratio = *moment / least;
  f.message += fmt::format("; Ixx + Iyy from C₄₄ + C₅₅ is {:.4g} times that of a disc", ratio);
  const double volume = *p.c.body[static_cast<std::size_t>(body)].displaced_volume;
  // A spar's moment is a small difference of large numbers: five thousandths of those are forgiven.
  const auto& b = p.c.body[static_cast<std::size_t>(body)];
  const double arm = std::abs(b.centre_of_buoyancy->z() - b.centre_of_gravity->z());
  const double slack = 0.02 + 0.02 * volume * arm / least;
  if (ratio > 1 - slack) return;
  f.severity = ratio < 0.7 - 5 * slack ? Severity::error : Severity::warning;
  f.why = "no waterplane of this area has so small a moment of inertia (P71)";
  f.remedy = "C₄₄, C₅₅ may be without weight, or for another centre of gravity; look at centres and units of length";
}

}  // namespace

void check_restoring(const Patient& p, Findings& out) {
  if (!p.c.C) {
    out.push_back(not_looked_at("restoring matrix", "there is none"));
    return;
  }
  Finding worst = restoring_finding(p, 0);
  for (int b = 1; b < p.c.bodies(); ++b)
    if (Finding f = restoring_finding(p, b); f.severity > worst.severity) worst = std::move(f);
  out.push_back(std::move(worst));
  check_blocks_between_bodies(p, out);
}

void check_waterplane(const Patient& p, Findings& out) {
  std::optional<Finding> worst;
  for (int b = 0; b < p.c.bodies() && p.c.C; ++b) {
    const Index i = 6 * static_cast<Index>(b) + 2;
    const double C33 = (*p.c.C)(i, i);
    if (!(C33 > 0) || !p.c.body[static_cast<std::size_t>(b)].displaced_volume) continue;
    const double area = C33 / (p.c.water.density * p.c.water.gravity);
    Finding f{.check = "waterplane and volume", .where = fmt::format("C of body {}", b + 1), .body = b + 1};
    require_room_for_volume(p, b, area, f);
    require_possible_moment(p, b, area, f);
    if (!worst || f.severity > worst->severity) worst = std::move(f);
  }
  out.push_back(worst ? *worst : not_looked_at("waterplane and volume", "C or the displaced volume is unknown"));
}

/// The mean of A₁₁, A₂₂ (slow) and A₃₃ (fast) is at least ρV/2 for a sphere, and hardly less for any hull. (P71)
void check_added_mass_and_volume(const Patient& p, Findings& out) {
  std::optional<Finding> worst;
  const Eigen::MatrixXd& slow = p.c.A_zero ? *p.c.A_zero : p.c.A.front();
  const Eigen::MatrixXd& fast = p.c.A_inf ? *p.c.A_inf : p.c.A.back();
  for (int b = 0; b < p.c.bodies(); ++b) {
    const auto& V = p.c.body[static_cast<std::size_t>(b)].displaced_volume;
    if (!V || !(*V > 0)) continue;
    const Index i = 6 * static_cast<Index>(b);
    const double mean = (slow(i, i) + slow(i + 1, i + 1) + fast(i + 2, i + 2)) / 3;
    const double ratio = mean / (p.c.water.density * *V);
    Finding f{.check = "added mass and volume",
              .where = fmt::format("A of body {}", b + 1),
              .message = fmt::format("mean added mass is {:.4g} of the displaced mass; a hemisphere's is 0.5", ratio),
              .body = b + 1};
    // A hemisphere's is 0.5 and next to nothing is below; heave plates of point absorbers reach 5, rafts 20.
    if (ratio < 0.3 || ratio > 100) f.severity = Severity::warning;
    if (ratio < 0.1 || ratio > 300) f.severity = Severity::error;
    if (f.severity != Severity::note) {
      f.message += likely_cause(ratio / 0.7, p.c.water);
      f.why = "a body must push aside about as much water as it displaces (P71)";
      f.remedy = "look at density, units of mass and length scale of A, and at the volume";
    }
    if (!worst || f.severity > worst->severity) worst = std::move(f);
  }
  out.push_back(worst ? *worst : not_looked_at("added mass and volume", "the displaced volume is unknown"));
}

}  // namespace hydro::potential::doctor
