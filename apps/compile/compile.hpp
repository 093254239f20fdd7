#pragma once
/// \file  A scene compiled to the smallest model that answers what it asks. What the scene does not name is not made.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "compile/depth.hpp"
#include "compile/lines.hpp"
#include "dynamics/force/buoyancy.hpp"
#include "dynamics/force/catenary_mooring.hpp"
#include "dynamics/force/connector.hpp"
#include "dynamics/force/contact.hpp"
#include "dynamics/force/fastened_line.hpp"
#include "dynamics/force/friction.hpp"
#include "dynamics/force/hydrostatics.hpp"
#include "dynamics/force/pto.hpp"
#include "dynamics/force/recorded_load.hpp"
#include "dynamics/force/restoring.hpp"
#include "dynamics/force/switched_connector.hpp"
#include "dynamics/frequency/rao.hpp"
#include "dynamics/model/model.hpp"
#include "froude/control.hpp"
#include "froude/result.hpp"
#include "hydro/radiation/pole_memory.hpp"
#include "hydro/waves/kinematics/field.hpp"
#include "hydro/waves/kinematics/sea.hpp"
#include "hydro/waves/synthesis/boxed_field.hpp"
#include "scene/element.hpp"
#include "scene/scene.hpp"

namespace froude::compile {

/// Coefficients and what was fitted to them, compile/kept.hpp.
class Kept;
/// A and B that a memory stands for, compile/kept.hpp.
struct SymmetricData;

using dynamics::LoadRecord;

/// What sets the stiffness of connectors between steps: [connector.switch], or a controller of the caller's.
using Rule = std::variant<scene::StiffnessSwitch, Control>;
struct RuledConnectors {
  dynamics::SwitchedConnectors connectors;
  Rule rule;
  scene::Place place;  ///< of the [[connector]], if it is the scene's rule
};

/// A section of a body, and where its loads are in a table of loads on parts (hydro::panels::Solution::parts), about
/// the centres of gravity of bodies.
struct PreparedSection {
  int body;
  std::size_t section;  ///< of scene::Body::sections
  std::shared_ptr<const hydro::potential::FrequencyTable> table;
  Eigen::Index row;                           ///< the first of six
  std::vector<int> bodies;                    ///< of the scene, whose motions make waves that reach it
  std::vector<Eigen::Index> columns;          ///< the first of six of each of these
  bool radiation, excitation;                 ///< effects that act
  std::vector<Eigen::Vector3d> origins = {};  ///< of the table
};

/// What both domains share: bodies, coefficients placed about the centres of gravity, springs. In the order of the
/// scene.
struct Prepared {
  std::vector<dynamics::RigidBody> bodies;
  std::vector<dynamics::frequency::PotentialGroup> groups;
  std::vector<scene::Memory> memory;            ///< one a group
  std::vector<std::vector<int>> sharing_waves;  ///< bodies that make waves, in sets within which they reach each other
  std::shared_ptr<Kept> kept;
  std::vector<dynamics::Hydrostatics> hydrostatics;
  std::vector<dynamics::Restoring> moorings;
  std::vector<int> with_gravity;  ///< bodies that feel gravity by themselves
  std::vector<dynamics::Buoyancy> buoyancy;
  hydro::Water water;
  std::vector<dynamics::AxialConnector> axial;
  std::vector<RuledConnectors> switched;  ///< one for each [[connector]] with a switch
  std::vector<dynamics::BushingConnector> bushing;
  std::vector<dynamics::Pto> ptos;
  std::vector<std::shared_ptr<const scene::Elements>> elements;
  std::vector<dynamics::CatenaryMooring> catenaries;
  std::vector<dynamics::FastenedLine> fastened;          ///< [[line]] with ends on bodies, in water without waves
  std::vector<dynamics::line::Places> fastened_at_rest;  ///< places of their nodes, with bodies as the scene has them
  std::vector<dynamics::Joint> joints;
  std::vector<dynamics::Friction> friction;
  std::vector<dynamics::Contact> contacts;
  std::vector<PreparedSection> sections;
  std::vector<OtherDepth> other_depths;  ///< of coefficients that are not for the scene's
  std::vector<std::string> notes;        ///< what had to be decided, for the result and the plan
};

/// Opens the data files and places everything. What an earlier scene has `kept` serves again where it is the same.
/// \throws hydro::InputError, placed in the scene
Prepared prepare(const scene::Scene& scene, std::shared_ptr<Kept> kept = nullptr);

/// The waves of [ask.rao] must go where every file has excitation, and be short enough for coefficients of another
/// depth, whose error `notes` are told. \throws hydro::InputError at its headings with those of the file, or at the
/// file
void check_waves_of_rao(const scene::Scene& scene, const Prepared& prepared, std::vector<std::string>& notes);

/// Model without radiation and excitation, which the frequency domain takes from `prepared.groups`. About: small
/// motions. \throws hydro::InputError if they are about the bodies as placed and these are not in equilibrium there
dynamics::Model frequency_model(const Prepared& prepared, const scene::About& about = {});
/// A current carries waves, drags on members and is not in coefficients of hulls; small motions and what is found from
/// them, balance at rest among it, have no part for that. \throws hydro::InputError at [current] if one reaches bodies;
/// `what` has none of it, as "responses"
void require_still_water(const scene::Scene& scene, std::string_view what);
/// The small motions of that model, with the inertia of the scene's members; where they are about an equilibrium,
/// `notes` is told where that is. \throws hydro::InputError if there is none
dynamics::frequency::SmallMotions small_motions(const scene::Scene& scene, const dynamics::Model& model,
                                                const scene::About& about, std::vector<std::string>& notes);

/// The water of a run.
struct RunWater {
  std::optional<hydro::waves::Sea> sea;                     ///< where the waves are a sum of linear ones
  std::shared_ptr<const hydro::waves::WaveField> field;     ///< with the ramp; still water is a field without waves
  std::shared_ptr<const hydro::waves::WaveField> of_lines;  ///< the same at lines
  std::shared_ptr<const hydro::waves::BoxedField> around_members;  ///< the field before its ramp; null without members
  std::shared_ptr<const hydro::waves::BoxedField> around_lines;    ///< the same; null without wet lines in a sea
};

/// \throws hydro::InputError naming the motion in which rest is no stable equilibrium: it does not come back there, so
/// that nothing lasts about it
void require_stable(const dynamics::frequency::SmallMotions& about, const scene::Place& place, const char* remedy);

/// The sea of a run whose answer is linear in it; `notes` are told what coefficients of another depth leave wrong in
/// it. \throws hydro::InputError where the waves are no sum of linear ones
hydro::waves::Sea sea_of_run(const scene::Scene& scene, const Prepared& prepared, std::vector<std::string>& notes);

/// The memory of a group as it runs, and the data that it stands for: its error is their difference.
struct MemoryInRun {
  std::vector<int> modes;  ///< of the model, increasing
  std::shared_ptr<const SymmetricData> data;
  Eigen::MatrixXd A;                                          ///< on the left beside the memory, (n, n)
  std::function<Eigen::MatrixXcd(double)> transform;          ///< K̂(iω) of the memory, (n, n)
  std::shared_ptr<const hydro::radiation::PoleMemory> poles;  ///< null for other methods
};

/// Everything that a run needs.
struct TimeModel {
  dynamics::Model model;
  dynamics::State start;
  RunWater water;
  std::vector<LineModel> lines;       ///< stepped beside the bodies
  std::vector<MemoryInRun> memories;  ///< one a group that radiates
  std::vector<Rule> rules;            ///< one for each group of SwitchMemory
  double step;                        ///< s; scene.run->every is a whole multiple of it
  std::size_t steps;
  std::size_t steps_per_sample;
  std::vector<PlanLine> plan;
  std::vector<std::string> notes;
};
/// `put_back`: loads that act beside all that the scene names, from t = 0 on (compile/defect.hpp).
/// `memory_apart`: the model has the added mass that goes with TimeModel::memories, and not these.
TimeModel time_model(const scene::Scene& scene, const Prepared& prepared, const std::vector<LoadRecord>& put_back = {},
                     bool memory_apart = false);

}  // namespace froude::compile
