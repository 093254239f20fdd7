// How long is a wave of a given period in water of a given depth?  consumer "8 s" "14 m"
#include <fmt/core.h>

#include <hydro/base/units.hpp>
#include <hydro/waves/dispersion.hpp>

int main(int argc, char** argv) try {
  const auto period =
      hydro::AngularFrequency::from_period_s(hydro::parse_si(argc > 1 ? argv[1] : "8 s", hydro::dim::time));
  const double depth_m = hydro::parse_si(argc > 2 ? argv[2] : "14 m", hydro::dim::length);
  const hydro::Water water{.depth = hydro::WaterDepth::from_metres(depth_m)};
  fmt::print("wavelength {:.2f} m\n", 6.283185307179586 / hydro::waves::wavenumber(period.rad_per_s(), water));
} catch (const hydro::InputError& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 2;
}
