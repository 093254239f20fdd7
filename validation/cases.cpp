#include "harness/case.hpp"

// One namespace a case, in validation/<name>/case.cpp, so that its names are its own. They are listed by hand: nothing
// registers itself.
namespace froude::validation {

// clang-format off
namespace ball_drops { Outcome outcome(const Folders& folders); }
namespace chosen_frequencies { Outcome outcome(const Folders& folders); }
namespace clock_offset { Outcome outcome(const Folders& folders); }
namespace cylinder { Outcome outcome(const Folders& folders); }
namespace dispersion { Outcome outcome(const Folders& folders); }
namespace fagerbakke_arrays { Outcome outcome(const Folders& folders); }
namespace fagerbakke_bem { Outcome outcome(const Folders& folders); }
namespace fagerbakke_eigen { Outcome outcome(const Folders& folders); }
namespace fagerbakke_switching { Outcome outcome(const Folders& folders); }
namespace hendriksen_calibration { Outcome outcome(const Folders& folders); }
namespace hendriksen_oscillation { Outcome outcome(const Folders& folders); }
namespace hendriksen_towing { Outcome outcome(const Folders& folders); }
namespace flume_box { Outcome outcome(const Folders& folders); }
namespace f3of { Outcome outcome(const Folders& folders); }
namespace floquet { Outcome outcome(const Folders& folders); }
namespace formats { Outcome outcome(const Folders& folders); }
namespace fpso_rao { Outcome outcome(const Folders& folders); }
namespace hendriksen_waves { Outcome outcome(const Folders& folders); }
namespace hull_array { Outcome outcome(const Folders& folders); }
namespace hull_cylinder { Outcome outcome(const Folders& folders); }
namespace hull_generated { Outcome outcome(const Folders& folders); }
namespace hull_hulme { Outcome outcome(const Folders& folders); }
namespace huijgen_cone { Outcome outcome(const Folders& folders); }
namespace huijgen_damping { Outcome outcome(const Folders& folders); }
namespace huijgen_double { Outcome outcome(const Folders& folders); }
namespace huijgen_damping_id { Outcome outcome(const Folders& folders); }
namespace huijgen_string { Outcome outcome(const Folders& folders); }
namespace huijgen_dropper_static { Outcome outcome(const Folders& folders); }
namespace huijgen_dropper { Outcome of_a(const Folders& folders); Outcome of_b(const Folders& folders); Outcome of_c(const Folders& folders); }
namespace huijgen_gamma { Outcome outcome(const Folders& folders); }
namespace huijgen_sea { Outcome outcome(const Folders& folders); }
namespace hulme { Outcome outcome(const Folders& folders); }
namespace interval_coverage { Outcome outcome(const Folders& folders); }
namespace moorings { Outcome outcome(const Folders& folders); }
namespace oc3_line_case { Outcome outcome(const Folders& folders); }
namespace irf_a5 { Outcome outcome(const Folders& folders); }
namespace kramers_kronig { Outcome outcome(const Folders& folders); }
namespace morison { Outcome outcome(const Folders& folders); }
namespace order { Outcome outcome(const Folders& folders); }
namespace orszaghova_expansion { Outcome outcome(const Folders& folders); }
namespace orszaghova_map { Outcome outcome(const Folders& folders); }
namespace pendulum_camera { Outcome outcome(const Folders& folders); }
namespace pendulums { Outcome outcome(const Folders& folders); }
namespace rm3_decay { Outcome outcome(const Folders& folders); }
namespace rm3_regular { Outcome outcome(const Folders& folders); }
namespace roll_decay { Outcome outcome(const Folders& folders); }
namespace spectra { Outcome outcome(const Folders& folders); }
namespace sea_dat { Outcome outcome(const Folders& folders); }
namespace spoilt_fits { Outcome outcome(const Folders& folders); }
namespace sphere_decay { Outcome outcome(const Folders& folders); }
namespace sphere_rao { Outcome outcome(const Folders& folders); }
namespace stick { Outcome outcome(const Folders& folders); }
namespace two_pole { Outcome outcome(const Folders& folders); }
namespace zanten_periods { Outcome outcome(const Folders& folders); }
namespace zanten_stick_slip { Outcome outcome(const Folders& folders); }
namespace zanten_waves { Outcome outcome(const Folders& folders); }
namespace zanten_wave_table { Outcome outcome(const Folders& folders); }
// clang-format on

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"fagerbakke-arrays", fagerbakke_arrays::outcome},
      {"fagerbakke-eigen", fagerbakke_eigen::outcome},
      {"fagerbakke-bem", fagerbakke_bem::outcome, {"generated-bem"}},
      {"fagerbakke-switching", fagerbakke_switching::outcome},
      {"hendriksen-towing", hendriksen_towing::outcome},
      {"hendriksen-calibration", hendriksen_calibration::outcome},
      {"zanten-periods", zanten_periods::outcome},
      {"zanten-stick-slip", zanten_stick_slip::outcome},
      {"zanten-wave-table", zanten_wave_table::outcome},
      {"zanten-waves", zanten_waves::outcome},
      {"huijgen-cone", huijgen_cone::outcome},
      {"huijgen-damping", huijgen_damping::outcome},
      {"huijgen-damping-id", huijgen_damping_id::outcome},
      {"huijgen-double", huijgen_double::outcome},
      {"huijgen-string", huijgen_string::outcome},
      {"huijgen-dropper-static", huijgen_dropper_static::outcome},
      {"huijgen-dropper-A", huijgen_dropper::of_a},
      {"huijgen-dropper-B", huijgen_dropper::of_b},
      {"huijgen-dropper-C", huijgen_dropper::of_c},
      {"huijgen-gamma", huijgen_gamma::outcome},
      {"huijgen-sea", huijgen_sea::outcome},
      {"hendriksen-oscillation", hendriksen_oscillation::outcome},
      {"hendriksen-waves", hendriksen_waves::outcome},
      {"morison", morison::outcome},
      {"interval-coverage", interval_coverage::outcome},
      {"clock-offset", clock_offset::outcome},
      {"sea-dat", sea_dat::outcome, {"waves_measured"}},
      {"dispersion", dispersion::outcome},
      {"spectra", spectra::outcome},
      {"hulme", hulme::outcome, {"hulme_hemisphere"}},
      {"hull-hulme", hull_hulme::outcome, {"hulme_hemisphere"}},
      {"cylinder", cylinder::outcome},
      {"chosen-frequencies", chosen_frequencies::outcome},
      {"hull-array", hull_array::outcome},
      {"hull-cylinder", hull_cylinder::outcome},
      {"hull-generated", hull_generated::outcome, {"generated-bem"}},
      {"two-pole", two_pole::outcome},
      {"orszaghova-expansion", orszaghova_expansion::outcome},
      {"floquet", floquet::outcome},
      {"orszaghova-map", orszaghova_map::outcome},
      {"order", order::outcome},
      {"stick", stick::outcome},
      {"kramers-kronig", kramers_kronig::outcome},
      {"sphere-decay", sphere_decay::outcome, {"iea_sphere"}},
      {"sphere-rao", sphere_rao::outcome, {"iea_sphere"}},
      {"spoilt-fits", spoilt_fits::outcome},
      {"rm3-regular", rm3_regular::outcome, {"rm3"}},
      {"rm3-decay", rm3_decay::outcome, {"rm3"}},
      {"f3of", f3of::outcome, {"f3of"}},
      {"formats", formats::outcome, {"bem_formats"}},
      {"fpso-rao", fpso_rao::outcome, {"mss_fpso"}},
      {"irf-a5", irf_a5::outcome, {"irf_buoy_a5"}},
      {"ball-drops", ball_drops::outcome, {"drag_ball_drops"}},
      {"moorings", moorings::outcome, {"mooring_lines"}},
      {"oc3-line", oc3_line_case::outcome},
      {"pendulum-camera", pendulum_camera::outcome, {"pendulum_camera"}},
      {"pendulums", pendulums::outcome, {"pendulum_encoder", "pendulum_camera"}},
      {"flume-box", flume_box::outcome, {"wave_flume_box"}},
      {"roll-decay", roll_decay::outcome, {"ecn_roll_decay"}},
  };
  return all;
}

}  // namespace froude::validation
