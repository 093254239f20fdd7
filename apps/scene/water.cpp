/// \file  `[water]`.
#include "scene/binding.hpp"
#include "scene/build.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

const Binding<hydro::Water>& water() {
  static const Binding<hydro::Water> binding =
      Binding<hydro::Water>("[water]", "the water, still")
          .key(quantity("density", dim::density, "of the water").positive(), &hydro::Water::density)
          .key(quantity("gravity", dim::acceleration, "acceleration of free fall")
                   .positive()
                   .or_default("9.81 m/s^2", "what hydrodynamic data are mostly computed with"),
               &hydro::Water::gravity)
          .key(quantity("depth", dim::length, "from still water to the bottom, or \"infinite\"")
                   .positive()
                   .one_of({"infinite"}),
               &hydro::Water::depth);
  return binding;
}

}  // namespace

const Table& water_table() { return water().table(); }

hydro::Water build_water(const Record& record) { return water().read(record); }

}  // namespace froude::scene
