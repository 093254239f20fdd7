/// \file  The tables of a scene that fits coefficients to measurements.
#include "scene/schema.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

const Table& channels() {
  static const Table table{
      .title = "[data.channels]",
      .meaning = "which column of the files plays which part",
      .keys = {text("time", "morison: time").optional(),
               text("force",
                    "measured force, positive along positive velocity: of the water on a fixed body, or what load "
                    "cells carry")
                   .optional(),
               text("velocity", "morison: of the water, or of the body, whichever moves").optional(),
               text("acceleration", "morison: as velocity; left out: from the velocity or position").optional(),
               text("position", "morison: as velocity, instead of it").optional(),
               text("speed", "towing: speed of the carriage").optional(),
               text("speed_sd", "towing: standard deviation of the speed").optional(),
               text("force_sd", "towing: standard deviation of the force").optional()}};
  return table;
}

const Table& data() {
  static const Table table{
      .title = "[data]",
      .meaning = "the measurements",
      .keys = {texts("files", "CSV, relative to the scene; * stands for any characters of a file's name"),
               inner_table("channels", channels())}};
  return table;
}

const Table& model_water() {
  static const Table table{
      .title = "[model.water]",
      .meaning = "the water of the experiment",
      .keys = {quantity("density", dim::density, "of the water").positive(),
               quantity("viscosity", dim::kinematic_viscosity, "kinematic; gives the Reynolds number")
                   .positive()
                   .optional()}};
  return table;
}

const Table& model() {
  static const Table table{
      .title = "[model]",
      .meaning = "what the force is taken for",
      .keys = {text("kind", "of experiment"), quantity("diameter", dim::length, "of the cylinder").positive(),
               quantity("length", dim::length, "of the cylinder in the water").positive(),
               inner_table("water", model_water())},
      .chosen_by = "kind",
      .variants = {
          {.word = "morison",
           .meaning = "drag and inertia in unsteady flow (Morison et al., 1950)",
           .keys = {text("motion",
                         "\"water moves\": waves on a fixed body; \"body moves\": forced oscillation in still water")
                        .one_of({"water moves", "body moves"}),
                    quantity("mass_beyond_load_cells", dim::mass,
                             "body moves: all that the load cells accelerate, contained water included")
                        .within(Limit::not_negative)
                        .optional()}},
          {.word = "towing", .meaning = "drag at steady speed", .keys = {}}}};
  return table;
}

const Table& intervals() {
  static const Table table{.title = "[ask.intervals]",
                           .meaning = "how sure to be",
                           .keys = {number("level", "probability that the interval covers the truth")
                                        .within(Limit::open_fraction)
                                        .or_default("0.95", "the usual level")}};
  return table;
}

const Table& ask() {
  static const Table table{
      .title = "[ask]",
      .meaning = "what is wanted of a fit",
      .keys = {
          texts("coefficients", "drag cd, inertia cm, added mass ca; towing knows cd alone").one_of({"cd", "cm", "ca"}),
          inner_table("intervals", intervals()).or_default("", "see its keys")}};
  return table;
}

}  // namespace

const Table& fit_schema() {
  static const Table table{
      .title = "a fit",
      .meaning = "coefficients from measurements",
      .keys = {integer("schema", "version of this grammar, 1"), text("title", "for people").optional(),
               inner_table("data", data()), inner_table("model", model()), inner_table("ask", ask())}};
  return table;
}

}  // namespace froude::scene
