#include "harness/case.hpp"

// One function a case, in validation/<name>/case.cpp. They are listed by hand: nothing registers itself.
namespace froude::validation {

Outcome ball_drops(const Folders& folders);
Outcome cylinder(const Folders& folders);
Outcome dispersion(const Folders& folders);
Outcome fagerbakke_arrays(const Folders& folders);
Outcome fagerbakke_bem(const Folders& folders);
Outcome fagerbakke_eigen(const Folders& folders);
Outcome fagerbakke_switching(const Folders& folders);
Outcome hendriksen_calibration(const Folders& folders);
Outcome hendriksen_oscillation(const Folders& folders);
Outcome hendriksen_towing(const Folders& folders);
Outcome f3of(const Folders& folders);
Outcome formats(const Folders& folders);
Outcome fpso_rao(const Folders& folders);
Outcome hendriksen_waves(const Folders& folders);
Outcome huijgen_cone(const Folders& folders);
Outcome huijgen_double(const Folders& folders);
Outcome huijgen_string(const Folders& folders);
Outcome huijgen_dropper_static(const Folders& folders);
Outcome huijgen_dropper_a(const Folders& folders);
Outcome huijgen_dropper_b(const Folders& folders);
Outcome huijgen_dropper_c(const Folders& folders);
Outcome huijgen_damping(const Folders& folders);
Outcome huijgen_gamma(const Folders& folders);
Outcome huijgen_sea(const Folders& folders);
Outcome hulme(const Folders& folders);
Outcome interval_coverage(const Folders& folders);
Outcome moorings(const Folders& folders);
Outcome oc3_line_case(const Folders& folders);
Outcome irf_a5(const Folders& folders);
Outcome kramers_kronig(const Folders& folders);
Outcome morison(const Folders& folders);
Outcome order(const Folders& folders);
Outcome orszaghova_expansion(const Folders& folders);
Outcome orszaghova_map(const Folders& folders);
Outcome pendulums(const Folders& folders);
Outcome rm3_decay(const Folders& folders);
Outcome rm3_regular(const Folders& folders);
Outcome roll_decay(const Folders& folders);
Outcome spectra(const Folders& folders);
Outcome sea_dat(const Folders& folders);
Outcome sphere_decay(const Folders& folders);
Outcome stick(const Folders& folders);
Outcome two_pole(const Folders& folders);
Outcome zanten_periods(const Folders& folders);
Outcome zanten_stick_slip(const Folders& folders);
Outcome zanten_waves(const Folders& folders);
Outcome zanten_wave_table(const Folders& folders);

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"fagerbakke-arrays", fagerbakke_arrays},
      {"fagerbakke-eigen", fagerbakke_eigen},
      {"fagerbakke-bem", fagerbakke_bem},
      {"fagerbakke-switching", fagerbakke_switching},
      {"hendriksen-towing", hendriksen_towing},
      {"hendriksen-calibration", hendriksen_calibration},
      {"zanten-periods", zanten_periods},
      {"zanten-stick-slip", zanten_stick_slip},
      {"zanten-wave-table", zanten_wave_table},
      {"zanten-waves", zanten_waves},
      {"huijgen-cone", huijgen_cone},
      {"huijgen-double", huijgen_double},
      {"huijgen-string", huijgen_string},
      {"huijgen-dropper-static", huijgen_dropper_static},
      {"huijgen-dropper-A", huijgen_dropper_a},
      {"huijgen-dropper-B", huijgen_dropper_b},
      {"huijgen-dropper-C", huijgen_dropper_c},
      {"huijgen-damping", huijgen_damping},
      {"huijgen-gamma", huijgen_gamma},
      {"huijgen-sea", huijgen_sea},
      {"hendriksen-oscillation", hendriksen_oscillation},
      {"hendriksen-waves", hendriksen_waves},
      {"morison", morison},
      {"interval-coverage", interval_coverage},
      {"sea-dat", sea_dat},
      {"dispersion", dispersion},
      {"spectra", spectra},
      {"hulme", hulme},
      {"cylinder", cylinder},
      {"two-pole", two_pole},
      {"orszaghova-expansion", orszaghova_expansion},
      {"orszaghova-map", orszaghova_map},
      {"order", order},
      {"stick", stick},
      {"kramers-kronig", kramers_kronig},
      {"sphere-decay", sphere_decay},
      {"rm3-regular", rm3_regular},
      {"rm3-decay", rm3_decay},
      {"f3of", f3of},
      {"formats", formats},
      {"fpso-rao", fpso_rao},
      {"irf-a5", irf_a5},
      {"ball-drops", ball_drops},
      {"moorings", moorings},
      {"oc3-line", oc3_line_case},
      {"pendulums", pendulums},
      {"roll-decay", roll_decay},
  };
  return all;
}

}  // namespace froude::validation
