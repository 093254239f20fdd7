#include "harness/hulme.hpp"

namespace froude::validation::hulme {

Outcome outcome(const Folders& folders) {
  const hydro::potential::FrequencyTable ours(hydro::potential::read(folders.example("hemisphere_r5.nc")),
                                              {Eigen::Vector3d::Zero()});
  return against(tables(folders), ours);
}

}  // namespace froude::validation::hulme
