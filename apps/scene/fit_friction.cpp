/// \file  Fits of kind "friction ramp": friction of a joint whose load grows until it slips.
#include "scene/fit_tables.hpp"

namespace froude::scene {

Binding<FrictionRampModel> friction_ramp_keys() {
  namespace dim = hydro::dim;
  using Options = ::fit::FrictionRampOptions;
  return Binding<FrictionRampModel>("",
                                    "static and dynamic friction from a torque, or a force on a slider, that grows "
                                    "until the joint slips, one test each file")
      .part(Binding<Options>("", "")
                .key(positive("ramp", dim::time, "before the slip: there the torque is taken as a straight line"),
                     &Options::ramp_s)
                .key(positive("slide", dim::time, "after it: there the torque is taken as constant"), &Options::slide_s)
                .key(quantity("drop", dim::time, "that the fall between them may take, filters counted")
                         .within(Limit::not_negative)
                         .or_default("0 s", "a record that was not filtered"),
                     &Options::drop_s),
            &FrictionRampModel::options);
}

void finish(const FitTables& t, FitScene& scene, FrictionRampModel& model) {
  read_channels(t, {"time", "torque", "force"}, {"time"}, scene);
  const Record& channels = t.channels();
  if (channels.has("torque") == channels.has("force"))
    throw channels.refused("needs either torque or force for a fit of kind \"friction ramp\"",
                           "name the torque on a hinge, or the force on a slider");
  model.options.confidence = scene.confidence;
}

}  // namespace froude::scene
