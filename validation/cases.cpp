#include "harness/case.hpp"

// One function a case, in validation/<name>/case.cpp. They are listed by hand: nothing registers itself.
namespace froude::validation {

Outcome dispersion(const Folders& folders);
Outcome fagerbakke_eigen(const Folders& folders);
Outcome hendriksen_calibration(const Folders& folders);
Outcome hendriksen_towing(const Folders& folders);
Outcome fpso_rao(const Folders& folders);
Outcome hulme(const Folders& folders);
Outcome irf_a5(const Folders& folders);
Outcome rm3_regular(const Folders& folders);
Outcome sphere_decay(const Folders& folders);
Outcome two_pole(const Folders& folders);
Outcome zanten_periods(const Folders& folders);

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"fagerbakke-eigen", fagerbakke_eigen},
      {"hendriksen-towing", hendriksen_towing},
      {"hendriksen-calibration", hendriksen_calibration},
      {"zanten-periods", zanten_periods},
      {"dispersion", dispersion},
      {"hulme", hulme},
      {"two-pole", two_pole},
      {"sphere-decay", sphere_decay},
      {"rm3-regular", rm3_regular},
      {"fpso-rao", fpso_rao},
      {"irf-a5", irf_a5},
  };
  return all;
}

}  // namespace froude::validation
