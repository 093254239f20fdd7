#pragma once
/// \file  From records to the types of scene.hpp: what a table alone cannot know. Private to apps/scene.
#include <map>
#include <string>
#include <vector>

#include "scene/record.hpp"

namespace hydro::io {
class CsvTable;
}

namespace froude::scene {

template <class T>
class Binding;

/// Names of bodies, members, moorings and connectors: one word, one thing, because signals are called after them.
class Names {
 public:
  /// \throws hydro::InputError naming both places if the name is taken
  void add(const std::string& name, const Place& place);

  /// The names of `count` things from one table: "connector1" … counted over the file where `record` has no name of its
  /// own; "hinge" or "hinge1", "hinge2" … where it has.
  std::vector<std::string> of(const Record& record, std::size_t count);

 private:
  std::map<std::string, Place> taken_;
  std::map<std::string, int> unnamed_;
};

// The tables that are declared beside their readers.
const Table& probe_table();
const Table& point_table();
const Table& relative_motion_table();
const Table& mooring_table();
const Table& connector_table();
const Table& contact_table();
const Table& joint_table();

/// An end of a line that is on what is no body.
struct UnresolvedEnd {
  std::size_t line;
  bool first;  ///< of its ends
  Located<std::string> name;
};

template <class T>
class Binding;

// The tables of the subjects, for motion_schema().
const Table& water_table();
const Table& body_table();
const Table& member_table();
const Table& line_table();
const Table& junction_table();
/// `[body.hydrodynamics]`, which stands apart from the rest of a body.
Binding<Hydrodynamics> hydrodynamics_binding();
Binding<SecondOrder> second_order_binding();

hydro::Water build_water(const Record& record);
std::vector<Body> build_bodies(const Record& root, Names& names);

// Each refers to scene.bodies, which must be there already.
void build_signals(const Record& root, Names& names, Scene& scene);  ///< points and relative motions
void build_members(const Record& root, Names& names, Scene& scene);
void build_lines(const Record& root, Names& names, Scene& scene);
/// The junctions of a scene, and what the ends of its lines meet that `unresolved` names; then which lines form
/// networks.
void build_networks(const Record& root, Names& names, const std::vector<UnresolvedEnd>& unresolved, Scene& scene);
void build_moorings(const Record& root, Names& names, Scene& scene);
void build_contacts(const Record& root, Names& names, Scene& scene);
void build_connectors(const Record& root, Names& names, Scene& scene);
void build_joints(const Record& root, Names& names, Scene& scene);
void build_elements(const Record& root, Names& names, Scene& scene);

Waves build_waves(const Record& waves, const Scene& scene);
hydro::waves::Current build_current(const Record& current, const std::filesystem::path& file);
void build_probes(const Record& root, Names& names, Scene& scene);
void build_solve(const Record& solve, Scene& scene);

// Tables that are declared beside their readers.
const Binding<Waves>& waves_binding();
const Table& current_table();
const Binding<Scene>& ask_binding();
const Binding<Solve>& solve_binding();

/// "m2_1": the first body of the second row of the grid m.
std::string grid_name(const std::string& family, int row, int in_row);
/// False of bodies that stand in no grid.
bool begins_a_row(const Body& body);

/// What `between` joins; an empty one is the ground. Of neighbours both are bodies.
struct Between {
  std::optional<int> first, second;
};
enum class GroundFirst { allowed, refused };
/// All pairs of the key `between`. \throws hydro::InputError at names that do not fit
std::vector<Between> read_between(const Record& record, const std::vector<Body>& bodies, GroundFirst ground_first);

/// The key that read_between() reads, where the ground cannot be first.
Key between_key();
/// All points of all pairs, by the keys `between`, with the ground second if at all, `ends` and `name`.
std::vector<PointPair> read_point_pairs(const Record& record, Names& names, const std::vector<Body>& bodies);

/// Indices of the bodies that fit the patterns of `record`'s key, in the order of the scene, each once.
/// \throws hydro::InputError at a pattern that fits none, with the nearest name
std::vector<int> bodies_on(const Record& record, std::string_view key, const std::vector<Body>& bodies);
/// \throws hydro::InputError if there is no body of this name, with the nearest
int body_named(const Record& record, const Located<std::string>& name, const std::vector<Body>& bodies);

/// Adds a copy of `thing` for each body of the key `on`, named by the key `name`.
template <class Thing>
void on_each_body(const Record& record, Names& names, const std::vector<Body>& bodies, Thing thing,
                  std::vector<Thing>& out) {
  const auto on = bodies_on(record, "on", bodies);
  const auto name = names.of(record, on.size());
  for (std::size_t b = 0; b < on.size(); ++b) {
    thing.name = name[b];
    thing.body = on[b];
    out.push_back(thing);
  }
}

/// Times of a recorded motion, the file of the key `file`: two or more, rising, from t = 0 or before.
/// \throws hydro::InputError for others
std::vector<double> rising_times(const Record& record, const hydro::io::CsvTable& table);

/// Puts the numbers of included files, [coefficients] cd = 1.19 of fit.toml, in place of texts "fit.cd".
/// \throws hydro::InputError for a file that is not there or has no such table, or a name that is not in it
void resolve_includes(Node& root, const std::filesystem::path& scene);

/// What both kinds of scene begin with: `schema = 1`. \throws hydro::InputError if it is another version
void check_version(const Node& root);

}  // namespace froude::scene
