#include "harness/hulme.hpp"

namespace froude::validation::hulme {

Outcome outcome(const Folders& folders) {
  const auto heave = folders.shared("hulme_hemisphere/heave.csv"), surge = folders.shared("hulme_hemisphere/surge.csv");
  const hydro::potential::FrequencyTable ours(hydro::potential::read(folders.example("hemisphere_r5.nc")),
                                              {Eigen::Vector3d::Zero()});
  return against(tables(heave, surge), ours);
}

}  // namespace froude::validation::hulme
