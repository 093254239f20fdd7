#include "scene/spectra.hpp"

#include <algorithm>
#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/signal/welch.hpp"
#include "hydro/waves/spectra/donelan.hpp"
#include "hydro/waves/spectra/spectra.hpp"
#include "hydro/waves/spectra/spectrum_tabulated.hpp"
#include "scene/binding.hpp"
#include "scene/build.hpp"

namespace froude::scene {
namespace {

using hydro::Angle;
using hydro::io::CsvTable;
namespace dim = hydro::dim;
namespace hw = hydro::waves;
using Spectrum = std::shared_ptr<const hw::Spectrum>;
using Spreading = std::shared_ptr<const hw::Spreading>;

template <class S>
std::shared_ptr<const S> shared(S made) {
  return std::make_shared<const S>(std::move(made));
}

Table::Variant as_variant(const std::string& word, const Table& table) {
  return {word, table.meaning, table.keys, table.groups};
}

/// The parameters of all kinds of spectra; a kind has some of them.
struct Sea {
  double hs = 0, gamma = 0, wind = 0, width = 0;  ///< m, 1, m/s, rad/s
  hw::SeaPeriod period;
  hw::OchiHubblePart low = {}, high = {};
  std::filesystem::path file;
  std::string column;
  double segment = 0;  ///< s

  double tp() const { return std::get<hw::PeakPeriod>(period).s; }
};

/// A kind and its own keys, which `make` gets the values of.
SpectrumKind spectrum(const std::string& word, const Binding<Sea>& keys, Spectrum (*make)(const Sea&, const Scene&)) {
  return {as_variant(word, keys.table()),
          [keys, make](const Record& record, const Scene& scene) { return make(keys.read(record), scene); }};
}

Binding<Sea> hs(const std::string& meaning) {
  return Binding<Sea>("", meaning).key(positive("hs", dim::length, "significant wave height, 4 √m₀"), &Sea::hs);
}

void put_peak_period(const Value& v, Sea& sea) { sea.period = hw::PeakPeriod{v.number}; }
Key tp() { return positive("tp", dim::time, "peak period"); }

/// Where `tp` may be given by another period instead.
Binding<Sea> one_period() {
  return Binding<Sea>("", "")
      .optional(tp(), &put_peak_period)
      .optional(positive("tz", dim::time, "mean period of up-crossings, 2π √(m₀/m₂)"),
                [](const Value& v, Sea& sea) { sea.period = hw::ZeroCrossingPeriod{v.number}; })
      .exactly_one_of({"tp", "tz"});
}

Binding<Sea> gamma() {
  return Binding<Sea>("", "").key(number("gamma", "peak enhancement factor")
                                      .within(Limit::at_least_one)
                                      .or_default("3.3", "the mean over the JONSWAP records (Hasselmann et al., 1973)"),
                                  &Sea::gamma);
}

/// One of the two peaks of Ochi and Hubble's spectrum.
Binding<Sea> peak(const std::string& at, const std::string& part, const std::string& shape,
                  hw::OchiHubblePart Sea::*member) {
  using Part = hw::OchiHubblePart;
  return Binding<Sea>("", "")
      .key(positive("hs_" + at, dim::length, "significant height of the part at " + part), member, &Part::hs_m)
      .key(positive("tp_" + at, dim::time, "peak period of that part"), member, &Part::tp_s)
      .key(number("lambda_" + at, "shape of that part" + shape).positive(), member, &Part::lambda);
}

/// The spectrum of a measured elevation, from its lowest positive frequency to four fifths of the Nyquist frequency,
/// beyond which recorders filter.
Spectrum of_record(const Sea& sea, const Scene&) {
  const CsvTable table = CsvTable::read(sea.file);
  const double step = hydro::signal::even_step(table.column("time", dim::time));
  const auto half = std::llround(sea.segment / step / 2);
  hydro::require(half >= 2, "a segment of {} s holds fewer than 4 samples of {} s", sea.segment, step);
  const double lowest = 1 / (2 * static_cast<double>(half) * step);
  return shared(hw::TabulatedSpectrum::of_record(table.column(sea.column, dim::length), step,
                                                 {.segment = 2 * static_cast<std::size_t>(half)},
                                                 {.from_hz = lowest, .to_hz = 0.4 / step}));
}

/// The parameters of all kinds of spreading, and the file of one that is a table.
struct Spread {
  double parameter = 0;
  std::filesystem::path file;
};

SpreadingKind spreading(const std::string& word, const Binding<Spread>& keys,
                        Spreading (*make)(const Spread&, const hw::Spectrum&)) {
  return {as_variant(word, keys.table()), [keys, make](const Record& record, const hw::Spectrum& spectrum) {
            return make(keys.read(record), spectrum);
          }};
}
/// One that has one parameter.
SpreadingKind spreading(const std::string& word, const std::string& meaning, Key parameter,
                        Spreading (*make)(const Spread&, const hw::Spectrum&)) {
  return spreading(word, Binding<Spread>("", meaning).key(parameter.positive(), &Spread::parameter), make);
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
      spectrum("jonswap", hs("random sea, JONSWAP spectrum").part(gamma()).part(one_period()),
               [](const Sea& s, const Scene&) -> Spectrum { return shared(hw::jonswap(s.hs, s.period, s.gamma)); }),
      spectrum("jonswap-dnv",
               hs("random sea, JONSWAP spectrum with the peak enhancement that DNV-RP-C205 gives for Hs and Tp")
                   .part(one_period()),
               [](const Sea& s, const Scene&) -> Spectrum { return shared(hw::jonswap_dnv(s.hs, s.period)); }),
      spectrum("fully-developed",
               Binding<Sea>("",
                            "random sea after a steady wind of long fetch and duration, Pierson and Moskowitz's own "
                            "relation")
                   .key(positive("wind", dim::velocity, "19.5 m above the sea"), &Sea::wind),
               [](const Sea& s, const Scene& scene) -> Spectrum {
                 return shared(hw::pierson_moskowitz_of_wind(s.wind, scene.water.gravity));
               }),
      spectrum(
          "pierson-moskowitz",
          hs("random sea, Pierson–Moskowitz spectrum: Bretschneider's, or ITTC's of two parameters").part(one_period()),
          [](const Sea& s, const Scene&) -> Spectrum { return shared(hw::bretschneider(s.hs, s.period)); }),
      spectrum("tma",
               hs("random sea in water of this depth: JONSWAP times the factor of Kitaigorodskii")
                   .key(tp(), &put_peak_period)
                   .part(gamma()),
               [](const Sea& s, const Scene& scene) -> Spectrum {
                 return shared(hw::Tma(s.hs, s.tp(), s.gamma, scene.water));
               }),
      spectrum("ochi-hubble",
               Binding<Sea>("", "random sea with two peaks, six parameters")
                   .part(peak("low", "low frequency", "; 1 is Pierson–Moskowitz, more is narrower", &Sea::low))
                   .part(peak("high", "high frequency", "", &Sea::high)),
               [](const Sea& s, const Scene&) -> Spectrum { return shared(hw::ochi_hubble(s.low, s.high)); }),
      spectrum(
          "torsethaugen",
          hs("random sea with two peaks, for the North Sea, from one height and period").key(tp(), &put_peak_period),
          [](const Sea& s, const Scene& scene) -> Spectrum {
            return shared(hw::torsethaugen(s.hs, s.tp(), scene.water.gravity));
          }),
      spectrum("wallops",
               hs("random sea, Wallops spectrum: the steeper the sea, the slower its tail falls")
                   .key(tp(), &put_peak_period),
               [](const Sea& s, const Scene& scene) -> Spectrum {
                 return shared(hw::wallops(s.hs, s.tp(), scene.water.gravity));
               }),
      spectrum("donelan",
               Binding<Sea>("", "random sea that a wind raises, whose tail falls as omega^-4: the height follows")
                   .key(positive("wind", dim::velocity, "10 m above the sea"), &Sea::wind)
                   .key(tp(), &put_peak_period),
               [](const Sea& s, const Scene& scene) -> Spectrum {
                 return shared(hw::donelan(s.wind, s.tp(), scene.water.gravity));
               }),
      spectrum("swell",
               hs("random swell, Gaussian in frequency")
                   .key(tp(), &put_peak_period)
                   .key(positive("width", dim::angular_velocity,
                                 "standard deviation of the frequency; in Hz it is 2π times less"),
                        &Sea::width),
               [](const Sea& s, const Scene&) -> Spectrum { return shared(hw::GaussianSwell(s.hs, s.tp(), s.width)); }),
      spectrum(
          "measured",
          Binding<Sea>("", "random sea with the spectrum of a record, by Welch's method")
              .key(text("file", "CSV beside the scene: columns time [s], evenly spaced, and elevation [m]"), &Sea::file)
              .key(text("column", "of the elevation").or_default("elevation", "its usual name"), &Sea::column)
              .key(positive("segment", dim::time, "length of a Welch segment"), &Sea::segment),
          &of_record),
      spectrum("tabulated",
               Binding<Sea>("", "random sea, spectrum from a table")
                   .key(text("file",
                             "CSV beside the scene: column omega [rad/s] or frequency [Hz], column density "
                             "[m^2 s/rad] or [m^2/Hz]"),
                        &Sea::file),
               [](const Sea& s, const Scene&) -> Spectrum { return shared(hw::TabulatedSpectrum::read(s.file)); }),
  };
  return kinds;
}

const std::vector<SpreadingKind>& spreadings() {
  static const std::vector<SpreadingKind> kinds{
      spreading("cos2s", "cos^2s of half the angle, the same at every frequency",
                number("s", "power; 10 is a wind sea"),
                [](const Spread& d, const hw::Spectrum&) -> Spreading {
                  return shared(hw::Cos2sSpreading(hw::SpreadingExponent::constant(d.parameter)));
                }),
      spreading("mitsuyasu", "cos^2s of half the angle, s greatest at the peak of the spectrum",
                number("s_max", "s at the peak; 10 is a wind sea, 75 a swell of long decay"),
                [](const Spread& d, const hw::Spectrum& spectrum) -> Spreading {
                  return shared(hw::Cos2sSpreading(hw::SpreadingExponent::goda(d.parameter, spectrum.peak_omega())));
                }),
      spreading(
          "cosn", "cos^n of the angle, nothing beyond 90 degrees", number("n", "power; 2 is common"),
          [](const Spread& d, const hw::Spectrum&) -> Spreading { return shared(hw::CosNSpreading(d.parameter)); }),
      spreading("wrapped-normal", "normal distribution of the angle",
                quantity("deviation", dim::angle, "standard deviation"),
                [](const Spread& d, const hw::Spectrum&) -> Spreading {
                  return shared(hw::WrappedNormalSpreading(Angle::from_radians(d.parameter)));
                }),
      spreading(
          "von-mises", "von Mises distribution of the angle", number("kappa", "concentration"),
          [](const Spread& d, const hw::Spectrum&) -> Spreading { return shared(hw::VonMisesSpreading(d.parameter)); }),
      spreading("tabulated",
                Binding<Spread>("", "from a table")
                    .key(text("file",
                              "CSV beside the scene: column direction [deg] from the heading, column density [1/rad]"),
                         &Spread::file),
                [](const Spread& d, const hw::Spectrum&) -> Spreading {
                  const CsvTable table = CsvTable::read(d.file);
                  return shared(hw::TabulatedSpreading(table.column("direction", dim::angle),
                                                       table.column("density", dim::none / dim::angle)));
                })};
  return kinds;
}

const SpectrumKind& spectrum_kind(const std::string& word) { return of_word(spectra(), word); }
const SpreadingKind& spreading_kind(const std::string& word) { return of_word(spreadings(), word); }

}  // namespace froude::scene
