#include "request.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "hydro/waves/dispersion.hpp"
#include "potential/solver_request.hpp"

namespace hydro::panels {
namespace {

using Eigen::Vector3d;

/// The solid angle that the wet part of a body and its image in the surface subtend: 4π inside, 0 outside.
double angle_of_body(const PanelMesh& mesh, int body, const Vector3d& P) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.hull.size(); ++i)
    for (std::size_t s = 0; s < mesh.images.size(); ++s)
      if (mesh.body_of[i][s] == body) {
        const Vector3d at = mesh.images[s] * P;
        sum += rankine(mesh.hull[i].shape, at).dipole;
        sum += rankine(mesh.hull[i].shape, {at.x(), at.y(), -at.z()}).dipole;
      }
  return std::abs(sum);
}

/// Working memory of one mesh, bytes: Rankine's parts for all, equations a thread.
double bytes_of(double unknowns, double systems, double right, int threads) {
  return systems * unknowns * (16 * unknowns + 16 * right) +
         threads * systems * unknowns * (32 * unknowns + 32 * right);
}

/// Seconds of one frequency: half a microsecond a pair of panels, and the steps of elimination.
double seconds_of(double unknowns, double systems, double right) {
  const double pairs = unknowns * unknowns * systems;
  return 1e-6 * pairs + systems * unknowns * unknowns * (unknowns / 3 + right) * multiplication_seconds;
}

}  // namespace

void check_request(const std::vector<double>& omega, const std::vector<double>& heading, const Options& options) {
  potential::check_solver_request(omega, heading, options.threads);
  require(!options.tolerance || (*options.tolerance > 0 && *options.tolerance < 1),
          "the tolerance must be between 0 and 1, got {}", options.tolerance.value_or(0));
  potential::check_frequency_tolerance(options.frequency_tolerance, omega.size());
  require(options.refined_frequencies >= 0, "the number of frequencies to refine must not be negative, got {}",
          options.refined_frequencies);
}

namespace {

/// Panels that waves reach are short beside the shortest of them: of a hemisphere heave's damping is 4, 9, 15 and 25 %
/// off with 10, 7, 5 and 3 panels a wave length, against nine times as many.
constexpr double a_wave_length = 5, reached = 0.25;  // panels a wave length; wave lengths of depth
/// Of a panel taller than waves are deep the top edge, not the centre, tells that they reach it.
constexpr double reached_edge = reached / 2;

double shortest_wave(const Water& water, double highest) {
  return 2 * std::numbers::pi / waves::wavenumber(highest, water);
}

double top_of(const Panel& panel) {
  double top = -std::numeric_limits<double>::infinity();
  for (const Vector3d& p : panel.shape.corners) top = std::max(top, p.z());
  return top;
}

/// What faces up more than sideways has water over it that may be shallow.
constexpr double faces_up = 0.7;  // cosine

/// Of water over a panel that makes waves as many panels long: √h, by which lengths of long waves go, changes evenly
/// along a slope, from its top to its lowest corner.
double depth_over(const Panel& panel) {
  double low = 0;
  for (const Vector3d& p : panel.shape.corners) low = std::min(low, p.z());
  const double root = (std::sqrt(std::max(0.0, -top_of(panel))) + std::sqrt(-low)) / 2;
  return root * root;
}

/// A panel and the waves at it.
struct AtPanel {
  double size = 0, wave = 1;            ///< m
  std::optional<double> under_shallow;  ///< m, the depth of the water over it that the waves are short in
  double share() const { return size / wave; }
};

AtPanel at_panel(const Panel& panel, const Water& water, double highest, double length) {
  const double depth = depth_over(panel);
  if (panel.shape.normal.z() < faces_up || depth >= water.depth.metres() || depth <= 0)
    return {panel.shape.size, length, {}};
  Water above = water;
  above.depth = WaterDepth::from_metres(depth);
  return {panel.shape.size, shortest_wave(above, highest), depth};
}

/// Where waves reach, the panel that is longest beside them (G34).
AtPanel longest_reached(const PanelMesh& mesh, const Water& water, double highest) {
  const double length = shortest_wave(water, highest);
  AtPanel worst;
  for (const Panel& p : mesh.hull) {
    if (p.shape.centre.z() <= -reached * length && top_of(p) <= -reached_edge * length) continue;
    const AtPanel here = at_panel(p, water, highest, length);
    if (here.share() > worst.share()) worst = here;
  }
  return worst;
}

bool is_too_long(const AtPanel& worst) { return worst.share() * a_wave_length > 1; }

std::string where_of(const AtPanel& worst) {
  return worst.under_shallow ? fmt::format("panels that face up {:.3g} m below the surface", *worst.under_shallow)
                             : "panels near the surface";
}

}  // namespace

bool too_long(const PanelMesh& mesh, const Water& water, double highest) {
  return is_too_long(longest_reached(mesh, water, highest));
}

void require_short_panels(const PanelMesh& mesh, const Water& water, double highest) {
  const AtPanel worst = longest_reached(mesh, water, highest);
  if (!is_too_long(worst)) return;
  throw InputError(
      fmt::format("{} are up to {:.3g} m across, and waves of {:.4g} rad/s are {:.3g} m long there: fewer than {:g} "
                  "panels a wave length",
                  where_of(worst), worst.size, highest, worst.wave, a_wave_length),
      {},
      worst.under_shallow
          ? "make the mesh finer where it faces up below shallow water, leave out the shortest waves, or "
            "put a top that is meant to be at the surface there (z = 0)"
          : "make the mesh finer at the waterline, or leave out the shortest waves");
}

void require_apart(const PanelMesh& mesh, const std::vector<HullBody>& bodies) {
  for (std::size_t i = 0; bodies.size() > 1 && i < mesh.hull.size(); ++i)
    for (int other = 0; other < static_cast<int>(bodies.size()); ++other) {
      const Vector3d& P = mesh.hull[i].shape.centre;
      if (other == mesh.hull[i].body || angle_of_body(mesh, other, P) < 2 * std::numbers::pi) continue;
      throw InputError(fmt::format("\"{}\" is inside \"{}\" at ({:.4g}, {:.4g}, {:.4g}) m",
                                   bodies[static_cast<std::size_t>(mesh.hull[i].body)].name,
                                   bodies[static_cast<std::size_t>(other)].name, P.x(), P.y(), P.z()),
                       {}, "move the bodies apart, or unite them (a union of solids) in one mesh");
    }
}

std::vector<std::size_t> frequencies_to_refine(std::size_t all, int wanted) {
  return potential::spread(all, wanted, all - 1);  // the shortest wave is the hardest
}

Cost cost_of(const PanelMesh& mesh, std::size_t bodies, std::size_t frequencies, std::size_t headings,
             int asked_threads, int refined_frequencies) {
  const auto systems = static_cast<double>(mesh.images.size());
  const double right = 6.0 * static_cast<double>(bodies) + static_cast<double>(headings);
  const auto hull = static_cast<double>(mesh.hull.size()), lid = static_cast<double>(mesh.lid.size());
  const std::size_t fine = frequencies_to_refine(frequencies, refined_frequencies).size();
  const int threads = potential::thread_count(asked_threads, frequencies + fine);
  Cost c{.panels = mesh.hull_panels(),
         .frequencies = static_cast<int>(frequencies),
         .unknowns = static_cast<int>(hull + lid),
         .systems = static_cast<int>(systems),
         .refined_unknowns = fine > 0 ? static_cast<int>(4 * hull + lid) : 0,
         .bytes = bytes_of(hull + lid, systems, right, threads),
         .seconds = static_cast<double>(frequencies + 2) * seconds_of(hull + lid, systems, right) / threads,
         .partial_waves = 0};
  if (fine > 0) {
    c.bytes += bytes_of(4 * hull + lid, systems, right,
                        static_cast<int>(std::min<std::size_t>(fine, static_cast<std::size_t>(threads))));
    c.seconds += static_cast<double>(fine) * seconds_of(4 * hull + lid, systems, right) /
                 std::min(static_cast<double>(fine), static_cast<double>(threads));
  }
  return c;
}

void require_memory(const Cost& cost) {
  const double have = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (cost.bytes <= have) return;
  throw InputError(fmt::format("{} panels need about {:.3g} GB of memory; this machine has {:.3g} GB", cost.panels,
                               cost.bytes / 1e9, have / 1e9),
                   {}, "take a coarser mesh, fewer threads or no refined frequencies");
}

}  // namespace hydro::panels
