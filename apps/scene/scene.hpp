#pragma once
/// \file  A scene as the user wrote it: typed, in SI, every name resolved, every default filled in, nothing computed
/// yet.
///
/// What a scene does not name is absent here (an empty optional or list) and is never allocated later.
/// Where libdynamics has a struct of what a table says, it stands here; its points are seen from the bodies' origins.
/// Values that can still turn out wrong when data files are opened keep their Place in the scene file.
#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "dynamics/control/dominant_period.hpp"
#include "dynamics/force/connector.hpp"
#include "dynamics/force/contact_law.hpp"
#include "dynamics/force/force_law.hpp"
#include "dynamics/force/morison.hpp"
#include "dynamics/force/restoring.hpp"
#include "dynamics/force/slamming.hpp"
#include "dynamics/joint/joint.hpp"
#include "dynamics/line/catenary.hpp"
#include "dynamics/line/exposure.hpp"
#include "dynamics/line/line.hpp"
#include "hydro/base/types.hpp"
#include "hydro/cylinders/layout.hpp"
#include "hydro/hydrostatics/shapes.hpp"
#include "hydro/panels/solve.hpp"
#include "scene/waves.hpp"

namespace froude::scene {

/// `[[point]]`: a point of a body, and what is told of it.
struct Point {
  std::string name;
  int body;            ///< index into Scene::bodies
  Eigen::Vector3d at;  ///< body axes, m
  bool position = false, velocity = false, acceleration = false, air_gap = false;
};

/// Two points: of a body, and of another or of the ground.
struct PointPair {
  std::string name;                       ///< "connector1" … unless named; repeated ones get a number
  int first;                              ///< index of a body
  std::optional<int> second;              ///< index of a body; empty: the ground
  Eigen::Vector3d first_end, second_end;  ///< body axes; global axes for the ground
};

/// How the memory of radiated waves is to be computed.
struct Memory {
  enum class Method { automatic, direct, partitioned, poles, constant };
  Method method = Method::automatic;
  double tolerance = 1e-3;       ///< relative force
  std::optional<double> length;  ///< s, where the scene fixes it
  double accepted_error = 0;     ///< relative force that the scene takes where no method is within the tolerance
  Place place;                   ///< of the method
};

/// `[body.hydrodynamics] cylinders`: vertical cylinders, of which the program computes the coefficients.
struct Cylinders {
  std::vector<hydro::cylinders::Cylinder> all;  ///< at least one; their centres in body axes
  std::vector<double> omega, headings;          ///< rad/s; rad, empty: those that the scene asks for
  std::optional<double> frequency_tolerance;    ///< more frequencies are chosen between these until it is met
};

/// `[body.hydrodynamics] mesh`: the hull of a body, of which the program computes the coefficients by panels.
struct HullMesh {
  std::filesystem::path file;           ///< absolute; in body axes
  std::optional<double> unit;           ///< of the mesh, m
  bool reverse = false;                 ///< its faces are turned inside out
  std::vector<double> omega, headings;  ///< as of Cylinders
  std::optional<double> frequency_tolerance;
  std::optional<double> tolerance;  ///< largest estimated error by panels; empty: the accuracy asked
  bool lid = true;                  ///< panels on the water inside
  hydro::panels::Interaction interaction = hydro::panels::Interaction::automatic;
};

/// `[body.hydrodynamics.turning]`: excitation for the heading that a slow yaw leaves.
struct Turning {
  double from, to, spacing;  ///< rad, of the yaws that are tabled
  double slower_than;        ///< s
  Place place;
};

/// Whose waves a body feels: those of all bodies that make waves; of those of its own file; its own alone.
enum class Interaction { full, file, self };

/// `[body.hydrodynamics]`: coefficients from a file, of cylinders or of a mesh.
struct Hydrodynamics {
  Located<std::filesystem::path> file;  ///< absolute; empty with cylinders or a mesh, and the place is theirs
  std::optional<Cylinders> cylinders;
  std::optional<HullMesh> mesh;
  std::optional<Located<int>> body;  ///< which body of the file, from 1, as written: copies take the following ones
  std::optional<Eigen::Vector3d>
      reference_point;  ///< global, m: the point the coefficients are about, if the file does not say
  std::optional<double> displaced_volume;             ///< m³, if the file does not say
  std::optional<Eigen::Vector3d> centre_of_buoyancy;  ///< body axes, m, if the file does not say
  std::optional<double> ulen;                         ///< m; WAMIT only
  std::optional<int> iperout;                         ///< WAMIT only
  std::vector<std::string> accept;  ///< names of checks of the doctor whose errors do not stop the scene
  bool excitation = false, radiation = false, hydrostatics = false;  ///< effects named
  std::array<bool, 6> excited{true, true, true, true, true, true};   ///< modes whose excitation acts
  std::optional<Turning> turning;
  Memory memory;
  Interaction interaction = Interaction::full;
  Place interaction_place;  ///< where it is written, else of the file
  bool makes_waves() const { return excitation || radiation; }
};

/// `[body.second_order]`: what waves exert in pairs, in runs.
struct SecondOrder {
  enum class Method {
    mean,    ///< the constant part
    newman,  ///< difference frequencies by what each wave exerts with itself
    full     ///< all pairs
  };
  Located<std::filesystem::path> file;                ///< absolute: of difference frequencies or the mean drift
  std::optional<Located<std::filesystem::path>> sum;  ///< absolute: of sum frequencies
  Method method = Method::full;
  double ulen = 1;  ///< m
  int iperout = 1;
  int body = 1;  ///< of the file, from 1
  Place place;
};

/// `[body.buoyancy]`: what the body shows the water, in body axes.
struct Buoyancy {
  std::optional<Located<std::filesystem::path>> mesh;  ///< absolute
  bool of_hydrodynamics = false;                       ///< the mesh is that of [body.hydrodynamics]
  std::optional<double> unit;                          ///< of the mesh, m
  bool reverse = false;                                ///< its faces are turned inside out
  std::optional<double> freeboard;                     ///< m: walls drawn up from an open rim, with a deck
  std::vector<hydro::hydrostatics::CircularCylinder> cylinders;
  std::vector<hydro::hydrostatics::Sphere> spheres;
  Place place;
};

/// `[[body.section]]`: a plane that cuts the body, and the mass on one side of it.
struct Section {
  std::string name;                                   ///< of its signals, after that of the body
  Eigen::Vector3d at;                                 ///< on the plane, what moments are about; body axes, m
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< into the part that is described, body axes, of unit length
  double mass;                                        ///< of that part, kg, >= 0
  Eigen::Vector3d centre_of_gravity;                  ///< of that part, from the body's origin, body axes, m
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< of that part about its centre of gravity, kg m²
  double accepted_error = 0;                          ///< by panels, of the peak of each of its loads
  Place place;
};

struct Body {
  std::string name;          ///< unique; copies are m1, m2, …
  std::string family;        ///< the name as written; equal to `name` for a single body
  int copy = 0;              ///< 0 for a single body, 1, 2, … for copies
  Eigen::Vector3d position;  ///< of the body's origin at rest, global, m
  double mass;               ///< kg, > 0
  Eigen::Vector3d centre_of_gravity = Eigen::Vector3d::Zero();  ///< from the origin, body axes, m
  Eigen::Matrix3d inertia;   ///< about the centre of gravity, body axes, kg m², positive definite;
                             ///< mass · 1 m² where no rotation is free and none was given: it does not act
  std::array<bool, 6> free;  ///< modes that may move; all by default
  std::map<hydro::Mode, double> initial;           ///< displacement of the origin from rest at t = 0, m or rad
  std::map<hydro::Mode, double> initial_velocity;  ///< m/s or rad/s
  bool weight = false;                             ///< feels gravity; linear hydrostatics hold it already
  bool net_load = false;                           ///< all loads together are signals
  bool energy = false;                             ///< its own energy is a signal
  std::optional<Buoyancy> buoyancy;
  std::optional<Hydrodynamics> hydrodynamics;
  std::optional<SecondOrder> second_order;
  std::vector<Section> sections;
  Place place;
};

/// `[member.ends]`: what acts on flat ends under water, or on plates there.
struct EndLoads {
  bool from = false, to = false;        ///< which ends
  bool pressure = false;                ///< waves press on the member's own section
  double cd = 0, ca = 0;                ///< along the member, of a disc of `diameter`
  std::optional<double> diameter = {};  ///< of its plate, m; none: that of the member
};

/// `[[member]]`: a slender cylinder fixed to a body. What is named acts on it.
struct Member {
  std::string name;
  int body;                  ///< index into Scene::bodies
  Eigen::Vector3d from, to;  ///< body axes, m
  double diameter;
  std::optional<double> cd;  ///< of `[member.drag]`: quadratic drag as it is at rest
  /// What they say but for the place and diameter of their `line`; no `pieces`: as many as the accuracy asked needs.
  std::optional<dynamics::MorisonMember> morison;
  std::optional<dynamics::SlammingMember> slamming;
  std::optional<EndLoads> ends;
  bool loads = false;  ///< told as signals
  Place place;
};

/// True if the water brakes it in some way.
bool has_drag(const Member& member);

/// `[[mooring]]`, kind = "catenary": one line from a body to the ground.
struct CatenaryLine {
  std::string name;
  int body;
  Eigen::Vector3d fairlead, anchor;  ///< body axes; global, m
  dynamics::LineProperties line;
  struct Table {
    double reach;      ///< m, of the fairlead from rest, horizontally and vertically
    double tolerance;  ///< of the largest pull
    Place place;
  };
  std::optional<Table> table;
  Place place;
};

/// `[[junction]]`: a place that nothing holds, at which ends of lines meet; perhaps a float or sinker.
struct Junction {
  std::string name;
  double mass = 0;  ///< kg
  dynamics::line::Bob bob;
  Place place;
};

/// `[[line]]`: a chain of nodes and segments that is stepped by itself. What is named acts on it.
struct Line {
  /// What an end meets that no place or body holds: a junction, or a node of a line.
  struct Meets {
    std::optional<std::size_t> junction;  ///< index into Scene::junctions
    std::size_t line = 0;                 ///< else into Scene::lines,
    int node = 0;                         ///< and there
  };
  /// Its first node or its last.
  struct End {
    std::optional<Eigen::Vector3d> at;  ///< m, in axes of the body that holds it, if one does; empty: it meets
                                        ///< something, or is free
    std::optional<int> body;            ///< index into Scene::bodies
    std::optional<Meets> meets;
    Eigen::Vector3d clamp = Eigen::Vector3d::Zero();  ///< as dynamics::line::Held
  };
  /// C_D and C_A by KC and perhaps Re, from a file.
  struct Coefficients {
    std::vector<dynamics::line::CoefficientTable::Row> rows;
    double viscosity = 1;  ///< m²/s; 1 where the table has no Re
    std::string file;      ///< as the scene names it
    Place place;
  };
  struct HeldNode {
    int node;
    Eigen::Vector3d at;  ///< m
  };
  struct Release : HeldNode {
    std::vector<HeldNode> also = {};
    /// All of them, by their nodes.
    std::vector<HeldNode> in_order() const;
  };
  struct NodeLoad : dynamics::line::TimedForce {
    int node;
  };
  /// Of its nodes in their order, without the ends that are held.
  struct Start {
    std::vector<Eigen::Vector3d> at, velocity;  ///< m, m/s
    Place place;
  };
  struct Snaps {
    double slack_below, snap_above;  ///< N
  };
  struct Lyapunov {
    double from;  ///< s, from which on growth counts
    Place place;
  };
  struct WavesAt {
    Eigen::Vector3d place_m;
    Place place;
  };
  struct PrescribedMotion {
    bool first;                          ///< the end `from`, else `to`
    std::vector<double> time;            ///< s
    std::vector<Eigen::Vector3d> place;  ///< m
  };
  /// An even part, which is cut into equal segments.
  struct EvenPart {
    dynamics::line::Segment whole;
    int segments;
  };
  /// Marine growth on segments whose middle is between two distances along the line.
  struct Growth {
    double thickness, density, from, to;  ///< m, kg/m³, m, m
  };
  std::string name;
  End from, to;
  dynamics::line::Segment common;                 ///< what segments have whose own table says nothing else
  std::vector<EvenPart> parts;                    ///< empty: its links are listed one by one
  std::optional<Growth> growth;                   ///< on parts
  std::vector<dynamics::line::Segment> segments;  ///< each with all it has, marine growth too: cut() of its parts
  dynamics::line::Node node;                      ///< each; at held ends without mass and bob
  dynamics::line::Surroundings water;             ///< without the field of a run
  std::optional<Coefficients> coefficients;       ///< instead of those of the segments
  std::optional<dynamics::line::Bed> bed;
  std::optional<Release> release;
  std::vector<NodeLoad> loads;
  std::optional<Start> start;
  std::optional<PrescribedMotion> prescribed;
  std::optional<WavesAt> waves_at;  ///< of all nodes; empty: where each is
  std::optional<Snaps> snaps;
  std::optional<Lyapunov> lyapunov;
  Place place;

  const End& end(bool first) const { return first ? from : to; }
  int last_node() const { return static_cast<int>(segments.size()); }
  bool fastened() const { return from.body || to.body; }
  bool meets_water() const { return water.wet != dynamics::line::Wet::nothing || node.bob.diameter > 0; }
};

/// `[connector.switch]`: the stiffness by the period that dominates a signal.
struct StiffnessSwitch : dynamics::PeriodSwitching {
  Located<std::string> watch;  ///< its name
};

/// The law of a connector along the line between its ends.
struct AxialConnector : dynamics::LineLaw {
  std::optional<double> rest_length = {};  ///< m; empty: as placed
  std::optional<StiffnessSwitch> switching = {};
};

/// `[[connector]]`: joins two points. A bushing keeps stiffness and damping only: ends, offset and name are the pair's.
struct Connector : PointPair {
  std::variant<AxialConnector, dynamics::BushingConnector> kind;
  Place place;
};

/// Friction of a hinge, N m, or of a slider, N.
struct JointFriction {
  double breakaway, sliding;
  std::optional<double> stribeck = {};  ///< rad/s or m/s
};

/// `[joint.prescribed]`: what the stroke of a slider or the angle of a hinge is: a sine, or a record.
struct JointPrescribedMotion {
  double amplitude = 0, omega = 0, ramp = 0;  ///< m or rad, rad/s, s
  std::vector<double> time, coordinate;       ///< of a record: s, m or rad
};

/// `[joint.pto]`: against the stroke of a slider (m, N) or the angle of a hinge (rad, N m), zero at rest.
struct Pto : dynamics::PtoLaw {
  std::optional<double> latch = {};  ///< s: holds that long wherever it comes to rest
  /// False if there is nothing but a latch.
  bool has_force() const {
    return line.stiffness != 0 || line.cubic != 0 || line.damping != 0 || line.quadratic_damping != 0 || preload != 0 ||
           has_stops();
  }
  bool has_stops() const { return lower || upper; }
};

/// `[[joint]]`: described where the bodies are at rest.
struct Joint {
  std::string name;  ///< "joint1" … unless named; repeated ones get a number
  dynamics::JointKind kind;
  std::optional<int> first, second;  ///< indices of bodies; one may be empty: the ground
  Eigen::Vector3d at;                ///< global, m
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX(), second_axis = Eigen::Vector3d::UnitY();  ///< global, any length
  std::optional<JointFriction> friction = {};
  std::optional<Pto> pto = {};                           ///< of sliders and hinges
  std::optional<JointPrescribedMotion> prescribed = {};  ///< of sliders and hinges
  Place place;
};

/// Where the small motions of a linear answer are about.
struct About {
  bool equilibrium = false;  ///< where the bodies balance, not where they are placed
  Place place = {};
};
struct AskRao {
  /// Waves for which drag on members is made linear: of one height, or of one steepness H/λ.
  struct DragIn {
    std::optional<double> height;     ///< m
    std::optional<double> steepness;  ///< of waves at each frequency
    Place place;
  };
  std::vector<double> omega;     ///< rad/s, increasing
  std::vector<double> headings;  ///< rad, of the waves, as asked, one at least; of [waves] unless the scene says more
  Place headings_place;          ///< of what names them
  std::vector<std::string> of;   ///< patterns such as "m*.surge", "connector*.force"; empty: everything
  std::vector<Place> of_places;  ///< one for each pattern
  std::optional<DragIn> drag;
  About about;
  Place place;
};
/// Free motions with periods between two.
struct AskModes {
  double shortest = 0, longest = std::numeric_limits<double>::infinity();  ///< s
  About about;
};
/// Whether periodic motions in regular waves of many periods and heights last.
struct AskStability {
  /// Motions of one height followed over the periods, or of one period over the heights.
  struct Branch {
    std::optional<double> height, period;  ///< m, s; one of them
    Place place;
  };
  std::vector<double> periods, heights;  ///< s, m
  std::vector<Branch> branches;
  std::vector<std::string> of;
  std::vector<Place> of_places;
  About about;
  Place place;
};
/// The free surface about bodies in one regular wave, on a grid.
struct AskField {
  double omega;               ///< rad/s
  double heading = 0;         ///< rad, where the wave goes
  std::vector<double> x, y;   ///< global, m, increasing, two each at least
  bool held = false;          ///< bodies are held still; else they move as their responses are
  double accepted_error = 0;  ///< of the elevation over its largest, taken where `accuracy` is missed
  bool pressure = false;      ///< on hulls is told too
  Place pressure_place = {};
  double accepted_pressure_error = 0;  ///< of the pressure over its largest, as accepted_error
  bool body_drift = false;             ///< mean drift of each body by itself is told too
  double accepted_drift_error = 0;     ///< of it, over the largest, as accepted_error
  Place place;
};
struct AskRun {
  double duration;                                 ///< s
  double every;                                    ///< s; distance of stored samples; duration is a multiple of it
  bool from_equilibrium = false;                   ///< bodies begin where they balance, not where they are placed
  bool steady = false;                             ///< motions as if the sea had always been there: no start, no step
  std::optional<Located<double>> checkpoint = {};  ///< s, of the run, from one to the next; empty: there are none
  std::vector<std::string> of;
  std::vector<Place> of_places;
  Place place;
};

struct Solve {
  std::optional<Located<double>> step;  ///< s; empty: chosen from the accuracy asked
  std::string integrator = "generalized_alpha";
  Place integrator_place = {};
  std::optional<double> newton_tolerance;       ///< no key of scenes; empty: newton_tolerance()
  double rho_infinity = 0.8;                    ///< spectral radius of generalised-α at infinite frequency, 0 … 1;
                                                ///< 0 if the scene gives none and acts_one_way()
  std::optional<double> tolerance;              ///< of the local error of steps, which are cut to meet it
  std::string line_scheme = "energy_momentum";  ///< of lines, as dynamics::line::parse_scheme() reads it
  std::optional<Place> line_scheme_place = {};  ///< where the scene names it
  double gamma = 0.51;                          ///< of the γ-method of lines
  std::optional<double> line_tolerance;         ///< of sub-steps of lines by rosenbrock; empty: line_tolerance()
  bool accept_error = false;                    ///< a run stands whatever its error is estimated to be
};

/// One line of the echo: every key that acts, whether written or filled in.
struct Echo {
  std::string key;    ///< "body[1].mass"
  std::string value;  ///< as text, in the unit written or in SI
  bool defaulted;
};

struct Scene {
  std::filesystem::path file;
  std::string text;  ///< the file itself, kept in every result
  std::string title;
  hydro::Water water;
  std::optional<Waves> waves;
  hydro::waves::Current current = hydro::waves::Current::none();
  std::optional<Place> current_place;  ///< where the scene names a current
  std::vector<Probe> probes;
  std::vector<Body> bodies;
  std::vector<Point> points;
  std::vector<PointPair> relative_motions;
  std::vector<Member> members;
  std::vector<dynamics::Restoring> moorings;  ///< about the bodies' origins
  std::vector<CatenaryLine> catenaries;       ///< [[mooring]] of kind "catenary"
  std::vector<dynamics::Contact> contacts;    ///< shapes from the bodies' origins
  std::vector<Junction> junctions;
  std::vector<Line> lines;                         ///< [[line]]
  std::vector<std::vector<std::size_t>> networks;  ///< of `lines`: those that meet; most are of one
  std::vector<Connector> connectors;
  std::vector<std::shared_ptr<const class Elements>> elements;  ///< force elements, scene/element.hpp
  std::vector<Joint> joints;
  std::optional<AskRao> rao;
  std::optional<AskModes> ask_modes;
  std::optional<AskStability> stability;
  std::optional<AskField> field;
  std::optional<AskRun> run;
  std::optional<AskWaves> ask_waves;
  Located<double> accuracy{1e-2, {}};  ///< largest error of each signal asked for
  bool uncompressed = false;           ///< numbers of result files
  Solve solve;
  std::vector<Echo> echo;
};

/// Reads a scene of motion. \throws hydro::InputError with file, line, column, the offending text, the rule, the
/// remedy.
Scene read(const std::filesystem::path& file);
Scene parse(std::string_view text, const std::filesystem::path& file);

/// True if `name` fits `pattern`, in which each `*` stands for any characters, also none.
bool matches(std::string_view pattern, std::string_view name);

/// Waves of a CSV list: a period, frequency or omega column, an amplitude or height column, a phase column and perhaps
/// a heading column, which is added to `heading`. `phase_of_kx`: phases belong to cos(kx − ωt + ε), so φ = −ε. \throws
/// hydro::InputError with the place in the list
std::vector<hydro::waves::GivenWave> read_wave_list(const std::filesystem::path& file, hydro::Angle heading,
                                                    bool phase_of_kx);

/// What to throw where no signal has a name that is asked for: with the nearest of those `known`.
hydro::InputError no_signal(const std::string& name, const Place& place, const std::vector<std::string>& known);
/// Checks that every pattern of `of` fits one of the signals that exist.
/// \throws hydro::InputError at the pattern, with the nearest signal
void check_patterns(const std::vector<std::string>& of, const std::vector<Place>& places,
                    const std::vector<std::string>& known);
/// The same for all that the scene asks.
void check_patterns(const Scene& scene, const std::vector<std::string>& known);

/// True if a force of the scene jumps in stiffness where it begins to act, and generalised-α steps it: cables, tables,
/// end stops, lines whose segments go slack (D132).
bool acts_one_way(const Scene& scene);
/// Of sub-steps of lines by "rosenbrock": a hundredth of the accuracy where the scene gives none.
double line_tolerance(const Scene& scene);
/// At which Newton ends a step of generalised-α (D98): a millionth of the accuracy, 1e-9 at most and 1e-12 at least.
/// What it leaves is a push of that share in each step, so that ten thousand steps that push the same way come to a
/// hundredth of the accuracy. Steps that a tolerance cuts are judged by less than that: 1e-12.
double newton_tolerance(const Scene& scene);

}  // namespace froude::scene
