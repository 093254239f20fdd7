#include "scene/spectra.hpp"

#include <algorithm>
#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/signal/welch.hpp"
#include "hydro/waves/spectra/spectra.hpp"
#include "hydro/waves/spectra/spectrum_tabulated.hpp"
#include "scene/build.hpp"

namespace froude::scene {
namespace {

using hydro::Angle;
using hydro::io::CsvTable;
using enum Group::Count;
namespace dim = hydro::dim;
namespace hw = hydro::waves;
using Spectrum = std::shared_ptr<const hw::Spectrum>;
using Spreading = std::shared_ptr<const hw::Spreading>;

template <class S>
std::shared_ptr<const S> shared(S made) {
  return std::make_shared<const S>(std::move(made));
}

Key hs() { return quantity("hs", dim::length, "significant wave height, 4 √m₀").positive(); }
Key tp() { return quantity("tp", dim::time, "peak period").positive(); }
Key gamma() {
  return number("gamma", "peak enhancement factor")
      .within(Limit::at_least_one)
      .or_default("3.3", "the mean over the JONSWAP records (Hasselmann et al., 1973)");
}

// Where `tp` may be given by another period instead.
Key tp_or() { return quantity("tp", dim::time, "peak period").positive().optional(); }
Key tz_or() { return quantity("tz", dim::time, "mean period of up-crossings, 2π √(m₀/m₂)").positive().optional(); }
Group one_period() { return {exactly_one, {"tp", "tz"}}; }
hw::SeaPeriod period_of(const Record& sea) {
  if (sea.has("tz")) return hw::ZeroCrossingPeriod{sea.si("tz")};
  return hw::PeakPeriod{sea.si("tp")};
}

/// The spectrum of a measured elevation, from its lowest positive frequency to four fifths of the Nyquist frequency,
/// beyond which recorders filter.
Spectrum of_record(const Record& sea, const Scene& scene) {
  const CsvTable table = CsvTable::read(beside(scene.file, sea.text("file")));
  const double step = hydro::signal::even_step(table.column("time", dim::time));
  const auto half = std::llround(sea.si("segment") / step / 2);
  hydro::require(half >= 2, "a segment of {} s holds fewer than 4 samples of {} s", sea.si("segment"), step);
  const double lowest = 1 / (2 * static_cast<double>(half) * step);
  return shared(hw::TabulatedSpectrum::of_record(table.column(sea.text("column"), dim::length), step,
                                                 {.segment = 2 * static_cast<std::size_t>(half)},
                                                 {.from_hz = lowest, .to_hz = 0.4 / step}));
}

/// That of a word; the schema has refused all others.
template <class Kind>
const Kind& of_word(const std::vector<Kind>& kinds, const std::string& word) {
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.keys.word == word; });
  hydro::ensure(found != kinds.end(), "the schema lets through only kinds that are declared");
  return *found;
}

}  // namespace

const std::vector<SpectrumKind>& spectra() {
  static const std::vector<SpectrumKind> kinds{
      {{"jonswap", "random sea, JONSWAP spectrum", {hs(), gamma(), tp_or(), tz_or()}, {one_period()}},
       [](const Record& s, const Scene&) -> Spectrum {
         return shared(hw::jonswap(s.si("hs"), period_of(s), s.si("gamma")));
       }},
      {{"jonswap-dnv",
        "random sea, JONSWAP spectrum with the peak enhancement that DNV-RP-C205 gives for Hs and Tp",
        {hs(), tp_or(), tz_or()},
        {one_period()}},
       [](const Record& s, const Scene&) -> Spectrum { return shared(hw::jonswap_dnv(s.si("hs"), period_of(s))); }},
      {{"fully-developed",
        "random sea after a steady wind of long fetch and duration, Pierson and Moskowitz's own relation",
        {quantity("wind", dim::velocity, "19.5 m above the sea").positive()}},
       [](const Record& s, const Scene& scene) -> Spectrum {
         return shared(hw::pierson_moskowitz_of_wind(s.si("wind"), scene.water.gravity));
       }},
      {{"pierson-moskowitz",
        "random sea, Pierson–Moskowitz spectrum: Bretschneider's, or ITTC's of two parameters",
        {hs(), tp_or(), tz_or()},
        {one_period()}},
       [](const Record& s, const Scene&) -> Spectrum { return shared(hw::bretschneider(s.si("hs"), period_of(s))); }},
      {{"tma", "random sea in water of this depth: JONSWAP times the factor of Kitaigorodskii", {hs(), tp(), gamma()}},
       [](const Record& s, const Scene& scene) -> Spectrum {
         return shared(hw::Tma(s.si("hs"), s.si("tp"), s.si("gamma"), scene.water));
       }},
      {{"ochi-hubble",
        "random sea with two peaks, six parameters",
        {quantity("hs_low", dim::length, "significant height of the part at low frequency").positive(),
         quantity("tp_low", dim::time, "peak period of that part").positive(),
         number("lambda_low", "shape of that part; 1 is Pierson–Moskowitz, more is narrower").positive(),
         quantity("hs_high", dim::length, "significant height of the part at high frequency").positive(),
         quantity("tp_high", dim::time, "peak period of that part").positive(),
         number("lambda_high", "shape of that part").positive()}},
       [](const Record& s, const Scene&) -> Spectrum {
         return shared(hw::ochi_hubble({s.si("hs_low"), s.si("tp_low"), s.si("lambda_low")},
                                       {s.si("hs_high"), s.si("tp_high"), s.si("lambda_high")}));
       }},
      {{"torsethaugen", "random sea with two peaks, for the North Sea, from one height and period", {hs(), tp()}},
       [](const Record& s, const Scene& scene) -> Spectrum {
         return shared(hw::torsethaugen(s.si("hs"), s.si("tp"), scene.water.gravity));
       }},
      {{"wallops", "random sea, Wallops spectrum: the steeper the sea, the slower its tail falls", {hs(), tp()}},
       [](const Record& s, const Scene& scene) -> Spectrum {
         return shared(hw::wallops(s.si("hs"), s.si("tp"), scene.water.gravity));
       }},
      {{"swell",
        "random swell, Gaussian in frequency",
        {hs(), tp(),
         quantity("width", dim::angular_velocity, "standard deviation of the frequency; in Hz it is 2π times less")
             .positive()}},
       [](const Record& s, const Scene&) -> Spectrum {
         return shared(hw::GaussianSwell(s.si("hs"), s.si("tp"), s.si("width")));
       }},
      {{"measured",
        "random sea with the spectrum of a record, by Welch's method",
        {text("file", "CSV beside the scene: columns time [s], evenly spaced, and elevation [m]"),
         text("column", "of the elevation").or_default("elevation", "its usual name"),
         quantity("segment", dim::time, "length of a Welch segment").positive()}},
       &of_record},
      {{"tabulated",
        "random sea, spectrum from a table",
        {text("file",
              "CSV beside the scene: column omega [rad/s] or frequency [Hz], column density [m^2 s/rad] or "
              "[m^2/Hz]")}},
       [](const Record& s, const Scene& scene) -> Spectrum {
         return shared(hw::TabulatedSpectrum::read(beside(scene.file, s.text("file"))));
       }},
  };
  return kinds;
}

const std::vector<SpreadingKind>& spreadings() {
  static const std::vector<SpreadingKind> kinds{
      {{"cos2s",
        "cos^2s of half the angle, the same at every frequency",
        {number("s", "power; 10 is a wind sea").positive()}},
       [](const Record& r, const hw::Spectrum&, const Scene&) -> Spreading {
         return shared(hw::Cos2sSpreading(hw::SpreadingExponent::constant(r.si("s"))));
       }},
      {{"mitsuyasu",
        "cos^2s of half the angle, s greatest at the peak of the spectrum",
        {number("s_max", "s at the peak; 10 is a wind sea, 75 a swell of long decay").positive()}},
       [](const Record& r, const hw::Spectrum& spectrum, const Scene&) -> Spreading {
         return shared(hw::Cos2sSpreading(hw::SpreadingExponent::goda(r.si("s_max"), spectrum.peak_omega())));
       }},
      {{"cosn", "cos^n of the angle, nothing beyond 90 degrees", {number("n", "power; 2 is common").positive()}},
       [](const Record& r, const hw::Spectrum&, const Scene&) -> Spreading {
         return shared(hw::CosNSpreading(r.si("n")));
       }},
      {{"wrapped-normal",
        "normal distribution of the angle",
        {quantity("deviation", dim::angle, "standard deviation").positive()}},
       [](const Record& r, const hw::Spectrum&, const Scene&) -> Spreading {
         return shared(hw::WrappedNormalSpreading(Angle::from_radians(r.si("deviation"))));
       }},
      {{"von-mises", "von Mises distribution of the angle", {number("kappa", "concentration").positive()}},
       [](const Record& r, const hw::Spectrum&, const Scene&) -> Spreading {
         return shared(hw::VonMisesSpreading(r.si("kappa")));
       }},
      {{"tabulated",
        "from a table",
        {text("file", "CSV beside the scene: column direction [deg] from the heading, column density [1/rad]")}},
       [](const Record& r, const hw::Spectrum&, const Scene& scene) -> Spreading {
         const CsvTable table = CsvTable::read(beside(scene.file, r.text("file")));
         return shared(hw::TabulatedSpreading(table.column("direction", dim::angle),
                                              table.column("density", dim::none / dim::angle)));
       }}};
  return kinds;
}

const SpectrumKind& spectrum_kind(const std::string& word) { return of_word(spectra(), word); }
const SpreadingKind& spreading_kind(const std::string& word) { return of_word(spreadings(), word); }

}  // namespace froude::scene
