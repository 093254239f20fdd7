#pragma once
/// \file  Linear radiation and diffraction of waves by hulls of any shape, by panels.
///
/// Green's theorem for the potential on flat panels, with the Green function of a free surface over water of any depth.
/// Panels are those of the mesh: two triangles in one plane make one of four corners, what is above z = 0 is cut off.
/// Equations (G1)-(G20) are derived and sourced in docs/theory/panels.md.
#include <Eigen/Core>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hydro/hydrostatics/mesh.hpp"
#include "hydro/potential/coefficients.hpp"

namespace hydro::panels {

/// A plane that cuts a hull in two parts, of which the loads on one are told: that into which the normal points.
struct HullSection {
  std::string name;
  Eigen::Vector3d at;      ///< a point of the plane, global, m
  Eigen::Vector3d normal;  ///< of unit length
};

/// A rigid body, its hull as it floats: z = 0 is the still water. It may be wholly under water.
struct HullBody {
  std::string name;
  Eigen::Vector3d reference_point;                   ///< of motions and moments, global, m
  std::optional<Eigen::Vector3d> centre_of_gravity;  ///< global, m; without it there is no restoring matrix
  hydrostatics::Hull hull;
  std::vector<HullSection> sections = {};  ///< where loads on a part of it are asked for
};

/// How hulls feel each other.
enum class Interaction {
  automatic,      ///< whichever takes less time, where hulls stand apart
  panels,         ///< all panels in one set of equations: hulls may be as near as their panels are small
  partial_waves,  ///< each kind of hull alone, and the partial waves that it sends out and receives: for many hulls,
                  ///< the circles about which must be apart (G18)
};

struct Options {
  /// Largest error of A, B and X by the size of panels that is accepted, an entry being measured against its two modes
  /// (P11). Panels are then refined until the estimate is below it, and the values are those of panels of no size,
  /// extrapolated (G16), (G17). Empty: the values are those of the mesh as it is given.
  std::optional<double> tolerance = {};
  /// Frequencies are first those that are asked for, and then more between them where responses bend, until what
  /// interpolation foresees at places not yet seen is met to this, 1e-6 … 0.1 (P36). They are sought with panels of one
  /// size, the mesh's own or the coarsest that a tolerance takes; the table is made so fine that cubics between its
  /// frequencies serve (P37). Empty: just those asked for.
  std::optional<double> frequency_tolerance = {};
  /// At how many frequencies the work is repeated with every panel cut in four; 0: none. One costs as much as 16 to 64.
  /// With a tolerance: to begin with, and five at least.
  int refined_frequencies = 0;
  Interaction interaction = Interaction::automatic;
  /// Panels on the water inside the hull, which remove irregular frequencies.
  bool lid = true;
  /// Frequencies that are solved at a time; the result does not depend on it. 0: as many as the machine has cores.
  int threads = 0;
  /// Called after each frequency, one call at a time, from any thread: how many are done, of how many; with a tolerance
  /// there may be more later.
  std::function<void(int done, int all)> progress = {};
};

/// What was used, and what theory says about the result. Relative numbers are measured as in (P11).
struct SelfCheck {
  double energy = 0;       ///< largest |B − power carried away by waves|, (G14)
  double haskind = 0;      ///< largest |X − X from the waves made by motion|, (G14)
  double reciprocity = 0;  ///< largest asymmetry of A and B, before their symmetric parts were taken
  double passivity = 0;    ///< largest change of B that took its negative eigenvalues away
  /// Estimated largest error of A, B, X against panels of no size on the same flat faces (G15), (G16); NaN if not asked
  /// for.
  double estimate = 0;
  double interpolation = 0;            ///< part of the estimate: by refining at some frequencies only
  std::vector<double> refined_omega;   ///< where it was measured, rad/s
  std::vector<int> extrapolated_from;  ///< panels of the meshes, coarse to fine; empty: not extrapolated
  /// m, the side of a square of the mean wet area of a hull: by which rotations are measured beside translations.
  double length = 0;
  int panels = 0;  ///< under water
  int lid_panels = 0;
  int planes_of_symmetry = 0;        ///< 0, 1 or 2: found in the mesh, and used
  int kinds = 0;                     ///< of hulls, each solved once; 0: all panels together
  int partial_waves = 0;             ///< between hulls, a hull at most; 0: all panels together
  std::vector<double> solved_omega;  ///< rad/s, where frequencies were chosen; the others of the table lie between
  double unseen = 0;                 ///< the largest miss at the last of those before they were solved (P36)
  double truncation = 0;             ///< part of the estimate: by the partial waves that are left out, measured by more
};

struct Solution {
  potential::Coefficients coefficients;
  SelfCheck check;
  /// Loads on the parts of hulls that sections cut off, (G24): the bodies again, then one more a section, whose rows of
  /// A, B, C and X are loads on the part by motions of the bodies, about the body's reference point; all other entries
  /// are zero. C: the hydrostatic pressure alone, along axes that turn with the body (G25). Empty without sections.
  std::optional<potential::Coefficients> parts = {};
  /// Values that are as far off as may be (G28), (G30), of bodies and of their parts.
  struct Doubted {
    potential::Coefficients coefficients, parts;
  };
  /// With sections and a tolerance, three: by the size of panels, by refining at some frequencies only, and by the
  /// division of panels at sections. What an answer that is made of both `coefficients` and `parts` changes with each,
  /// added up, estimates its error.
  std::vector<Doubted> doubted = {};
};

/// What a solution will need, told before it is computed; with a tolerance, its first two meshes.
struct Cost {
  int panels;            ///< under water
  int frequencies;       ///< as asked, or about as many as will be chosen
  int unknowns;          ///< of each of `systems` sets of complex equations
  int systems;           ///< 1, 2 or 4 a frequency, by planes of symmetry
  int refined_unknowns;  ///< of the refined mesh; 0: none
  double bytes;          ///< of working memory, all threads together, estimated
  double seconds;        ///< estimated; good to a factor of three
  int partial_waves;     ///< between hulls, a hull at most; 0: all panels together
};

/// A, B and X of `bodies` at the frequencies `omega` (rad/s, increasing) for waves going towards `heading` (rad,
/// increasing; may be empty), with A(∞), in deep water A(0), centres of buoyancy, volumes and, where every body has a
/// centre of gravity, C. A and B are symmetric parts and B has no negative eigenvalues; SelfCheck tells what that
/// changed. \throws InputError naming the body: nothing of a hull under water, a hull below the bed, hulls inside one
/// another, an opening under water; if a frequency is not finite and positive or the lists do not increase; more memory
/// than the machine has; without a tolerance, panels longer than a fifth of the shortest wave where waves reach them,
/// and energy, haskind or reciprocity of SelfCheck above 0.3; fewer than five frequencies where more are to be chosen,
/// or 300 that do not do; with sections: as check_section(), a body on the sea bed, partial waves asked for,
/// frequencies to be chosen; a tolerance that cannot be met with three meshes of at most 4000 unknowns a system
Solution solve(const std::vector<HullBody>& bodies, const Water& water, const std::vector<double>& omega,
               const std::vector<double>& heading, const Options& options = {});

/// The largest difference of A, B and X at the same frequencies, measured as the estimate is: each entry against its
/// two modes in `reference` (P11), but against a tenth of the largest mode of the kind at least. `length` is
/// SelfCheck::length. \throws InputError if frequencies or headings differ
double difference(const potential::Coefficients& c, const potential::Coefficients& reference, double length);

/// \throws InputError unless the plane cuts or touches the hull, and its normal is of unit length
void check_section(const HullBody& body, const HullSection& section);

/// Force and moment of still water on the part into which the section's normal points, N and N m, global axes, the
/// moment about the body's reference point: exact over flat faces. (G29) \throws InputError as solve()
Eigen::Matrix<double, 6, 1> still_water_load(const HullBody& body, const HullSection& section, const Water& water);

/// \throws InputError as solve()
Cost cost(const std::vector<HullBody>& bodies, const Water& water, const std::vector<double>& omega,
          const std::vector<double>& heading, const Options& options = {});

}  // namespace hydro::panels
