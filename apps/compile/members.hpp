#pragma once
/// \file  Private to compile/: loads on slender members.
#include "compile/compile.hpp"
#include "compile/signals.hpp"
#include "dynamics/force/drag.hpp"
#include "hydro/waves/synthesis/field_choice.hpp"

namespace froude::compile {

/// True if a member names drag at its place at rest.
bool any_drag_at_rest(const scene::Scene& scene);
/// True if a member has drag, there or where it is: both are linear in linear responses.
bool any_drag(const scene::Scene& scene);

/// Pieces of members with drag, in the current, and which of the scene's members each is of.
struct DragAtRest {
  std::vector<dynamics::DragPiece> pieces;
  std::vector<std::size_t> member;
};
/// Of members that name drag at their places at rest. \throws hydro::InputError at one that is dry there
DragAtRest drag_at_rest(const scene::Scene& scene, const std::vector<dynamics::RigidBody>& bodies);
/// Of all members with drag, as far as they are wet at rest: what linear responses have. \throws as drag_at_rest()
DragAtRest drag_of_responses(const scene::Scene& scene, const std::vector<dynamics::RigidBody>& bodies);

/// Morison's inertia of members, as far as they are wet at rest: what linear responses have. (D148)
dynamics::frequency::MemberInertia inertia_of_responses(const scene::Scene& scene,
                                                        const std::vector<dynamics::RigidBody>& bodies);

/// Loads on the ends of members have no law above the water, and the excitation of a hull has the pressure on all of
/// it. \throws hydro::InputError for ends that are above the water at rest, or on which the waves press twice
void check_ends(const scene::Scene& scene);

/// Of each body that floats upright on members with Morison's load and has no other excitation, as a spar: what waves
/// would push on the wet ends of its members, which Morison's equation leaves out.
std::vector<std::string> ends_without_pressure(const scene::Scene& scene);

/// (D44): pieces of a member, so short that neither the shortest relevant wave nor turning about an end is missed by
/// more than the accuracy asked.
int needed_pieces(const scene::Scene& scene, const scene::Member& member, dynamics::Immersion immersion);

/// Who says into how many pieces members with Morison's load or impact are cut.
enum class CutBy { scene, program };
/// True if there are such members.
bool any_member_cut(const scene::Scene& scene, CutBy by);
/// How many times as many pieces such members get.
struct PieceTimes {
  int given = 1, chosen = 1;
};
/// The scene then gives them all.
void cut_members_finer(PieceTimes times, scene::Scene& scene);

/// What members that move ask of the waves of a run, around their places at rest; empty if there are none.
std::optional<hydro::waves::FieldUse> water_of_members(const scene::Scene& scene, double highest_crest, double step);

/// Adds the kinds of load that members name. \throws hydro::InputError at a member that is dry where it must be wet
void add_members(const scene::Scene& scene, const std::vector<dynamics::RigidBody>& bodies, const RunWater& water,
                 const StepGrid& grid, std::vector<std::unique_ptr<const dynamics::ForceKind>>& forces);

}  // namespace froude::compile
