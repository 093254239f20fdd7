#pragma once
/// \file  What the kinds of fit share. Each kind is declared in a file of its own, fit_morison.cpp to fit_motion.cpp:
/// its
///        keys of [model], the roles of its columns, and what it asks of the other tables. Private to apps/scene.
#include <fmt/format.h>

#include <numbers>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "scene/binding.hpp"
#include "scene/fit_scene.hpp"

namespace froude::scene {

/// The tables of a fit scene as they were read.
struct FitTables {
  const Record& root;

  const Record& data() const { return root.table("data"); }
  const Record& channels() const { return data().table("channels"); }
  const Record& model() const { return root.table("model"); }
  const Record& ask() const { return root.table("ask"); }
};

// Of each kind: its keys of [model], and what is left once all tables are read: the columns it takes, what the tables
// must keep together, what follows from several of them. \throws hydro::InputError, placed in the scene
Binding<MorisonModel> morison_keys();
Binding<TowingModel> towing_keys();
Binding<MotionModel> motion_keys();
Binding<DecayModel> decay_keys();
Binding<RadiationModel> radiation_keys();
Binding<FrictionRampModel> friction_ramp_keys();
void finish(const FitTables& tables, FitScene& scene, MorisonModel& model);
void finish(const FitTables& tables, FitScene& scene, TowingModel& model);
void finish(const FitTables& tables, FitScene& scene, MotionModel& model);
void finish(const FitTables& tables, FitScene& scene, DecayModel& model);
void finish(const FitTables& tables, FitScene& scene, RadiationModel& model);
void finish(const FitTables& tables, FitScene& scene, FrictionRampModel& model);

/// Reads which columns play these roles. \throws hydro::InputError for a role that is not among them, or that is needed
/// and not there
void read_channels(const FitTables& tables, const std::vector<std::string>& roles,
                   const std::vector<std::string>& needed, FitScene& scene);

inline std::string not_of_kind(std::string_view kind) {
  return fmt::format("does not apply to a fit of kind \"{}\"", kind);
}

/// The model of the scene, if it is of this kind or has these options of libfit; else null.
template <class M>
M* model_of(FitScene& scene) {
  return std::visit(
      [](auto& model) -> M* {
        if constexpr (std::is_base_of_v<M, std::remove_reference_t<decltype(model)>>) return &model;
        return nullptr;
      },
      scene.model);
}
/// \throws hydro::InputError for a value that the scene gives though its kind of fit is none of these
template <class... Models>
void check_kind(FitScene& scene, const Value& value, const std::string& remedy = "leave it out") {
  if (!value.defaulted && !(model_of<Models>(scene) || ...)) throw value.wrong(not_of_kind(scene.kind()), remedy);
}
/// The model of a value that acts in this kind of fit only. \throws as check_kind()
template <class M>
M& only_in_fits_of(FitScene& scene, const Value& value, const std::string& remedy = "leave it out") {
  check_kind<M>(scene, value, remedy);
  return std::get<M>(scene.model);
}

/// Takes a value into the member of whichever of these models, or options of libfit, the scene has; others refuse it,
/// with this remedy.
template <class M, class... Models>
auto to_models(std::string remedy, M Models::*... members) {
  return [=](const Value& value, FitScene& scene) {
    check_kind<Models...>(scene, value, remedy);
    const auto take = [&]<class Model>(M Model::*member) {
      if (auto* model = model_of<Model>(scene)) detail::put(value, model->*member);
    };
    (take(members), ...);
  };
}

/// Takes an angular frequency into a member that is in Hz.
template <class T>
auto in_hertz(double T::*member) {
  return [member](const Value& value, T& out) { out.*member = value.number / (2 * std::numbers::pi); };
}

/// [prepare].
const Binding<::fit::PrepareOptions>& prepare_binding();

/// Keys of [model] that describe a cylinder and its water: in fit_towing.cpp.
Binding<::fit::Cylinder> cylinder_keys();
/// [model.body]: in fit_radiation.cpp.
Binding<::fit::RestoredBody> restored_body();
/// \throws hydro::InputError for a mass beside an angle, an inertia beside a position
void check_restored(const FitTables& tables);

/// The coefficients that are asked for. \throws hydro::InputError where none are, with an `example`, or one is not
/// among those `known`
const std::vector<Located<std::string>>& wanted(const FitTables& tables, const std::vector<std::string>& known,
                                                const char* example, const char* remedy);

}  // namespace froude::scene
