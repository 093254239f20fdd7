#include "harness/case.hpp"

// One function a case, in validation/<name>/case.cpp. They are listed by hand: nothing registers itself.
namespace froude::validation {

Outcome cylinder(const Folders& folders);
Outcome dispersion(const Folders& folders);
Outcome fagerbakke_bem(const Folders& folders);
Outcome fagerbakke_eigen(const Folders& folders);
Outcome hendriksen_calibration(const Folders& folders);
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
Outcome huijgen_gamma(const Folders& folders);
Outcome huijgen_sea(const Folders& folders);
Outcome hulme(const Folders& folders);
Outcome moorings(const Folders& folders);
Outcome oc3_line_case(const Folders& folders);
Outcome irf_a5(const Folders& folders);
Outcome kramers_kronig(const Folders& folders);
Outcome rm3_decay(const Folders& folders);
Outcome rm3_regular(const Folders& folders);
Outcome spectra(const Folders& folders);
Outcome sea_dat(const Folders& folders);
Outcome sphere_decay(const Folders& folders);
Outcome two_pole(const Folders& folders);
Outcome zanten_periods(const Folders& folders);
Outcome zanten_stick_slip(const Folders& folders);
Outcome zanten_waves(const Folders& folders);
Outcome zanten_wave_table(const Folders& folders);

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"fagerbakke-eigen", fagerbakke_eigen},
      {"fagerbakke-bem", fagerbakke_bem},
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
      {"huijgen-gamma", huijgen_gamma},
      {"huijgen-sea", huijgen_sea},
      {"hendriksen-waves", hendriksen_waves},
      {"sea-dat", sea_dat},
      {"dispersion", dispersion},
      {"spectra", spectra},
      {"hulme", hulme},
      {"cylinder", cylinder},
      {"two-pole", two_pole},
      {"kramers-kronig", kramers_kronig},
      {"sphere-decay", sphere_decay},
      {"rm3-regular", rm3_regular},
      {"rm3-decay", rm3_decay},
      {"f3of", f3of},
      {"formats", formats},
      {"fpso-rao", fpso_rao},
      {"irf-a5", irf_a5},
      {"oc3-line", oc3_line_case},
      {"moorings", moorings},
  };
  return all;
}

}  // namespace froude::validation
