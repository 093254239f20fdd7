// Spectra: of seas by name, of records, of responses.
#include <algorithm>
#include <cmath>
#include <limits>

#include "answers/response_spectra.hpp"
#include "answers/second_order_spectra.hpp"
#include "bindings.hpp"
#include "computing.hpp"
#include "froude/density_unit.hpp"
#include "froude/psd/report.hpp"
#include "froude/record_file.hpp"
#include "hydro/base/error.hpp"
#include "hydro/waves/spectra/spectra.hpp"
#include "scene/scene.hpp"
#include "scene/schema.hpp"

namespace froude::python {
namespace {

namespace hs = hydro::signal;
namespace hw = hydro::waves;

// ---- of a sea ----

using SeaSpectrum = std::shared_ptr<const hw::Spectrum>;

/// That of the waves of a scene. \throws hydro::InputError where they have none
SeaSpectrum spectrum_of(const HeldScene& held) {
  const scene::Scene& read = held.scene.read();
  const auto* random = read.waves ? std::get_if<scene::RandomSea>(&read.waves->kind) : nullptr;
  if (random == nullptr)
    throw hydro::InputError("the waves of the scene are no random sea", {.file = read.file.string()},
                            "[waves] kind = \"jonswap\" is one");
  if (random->systems.size() == 1) return random->systems.front().spectrum;
  std::vector<SeaSpectrum> parts;
  for (const auto& system : random->systems) parts.push_back(system.spectrum);
  return std::make_shared<hw::SumSpectrum>(parts);
}

const scene::Key* find(const std::vector<scene::Key>& keys, const std::string& name) {
  const auto at = std::find_if(keys.begin(), keys.end(), [&](const scene::Key& key) { return key.name == name; });
  return at == keys.end() ? nullptr : &*at;
}

/// The SI unit in which a key of [waves] is written for this kind of sea; none for what is no quantity, or no key.
std::optional<std::string> unit_of(const std::string& kind, const std::string& key) {
  const scene::Table& waves = *find(scene::motion_schema().keys, "waves")->inner;
  const scene::Key* found = find(waves.keys, key);
  for (const auto& variant : waves.variants)
    if (found == nullptr && variant.word == kind) found = find(variant.keys, key);
  if (found == nullptr || found->holds != scene::Holds::quantity) return std::nullopt;
  return scene::si_unit(found->dimension);
}

void add_sea_spectrum(py::module_& m) {
  py::class_<hw::Spectrum, std::shared_ptr<hw::Spectrum>>(
      m, "Spectrum",
      "One-sided variance spectrum S(omega) of the elevation of a sea, m^2 s/rad.\n\n"
      "The integral of S over omega is the variance, and Hs = 4 sqrt(m0). Made by `froude.spectrum`.")
      .def("__call__", py::vectorize([](const hw::Spectrum* s, double omega) { return s->density(omega); }),
           py::arg("omega"), "S, m^2 s/rad, at frequencies omega, rad/s, of any shape.")
      .def("moment", &hw::Spectrum::moment, py::arg("n"),
           "m_n, the integral of omega^n S, m^2 (rad/s)^n; n from -1. Raises InputError where it diverges.")
      .def("band_moment", &hw::Spectrum::band_moment, py::arg("n"), py::arg("low"), py::arg("high"),
           "The same between two frequencies, rad/s; `high` may be math.inf where the integral exists.")
      .def_property_readonly("hs", &hw::Spectrum::hs, "Significant height 4 sqrt(m0), m.")
      .def_property_readonly("tp", &hw::Spectrum::tp, "Peak period, s.")
      .def_property_readonly("tm01", &hw::Spectrum::mean_period, "Mean period 2 pi m0/m1, s.")
      .def_property_readonly("tz", &hw::Spectrum::tz, "Mean period of up-crossings 2 pi sqrt(m0/m2), s.")
      .def_property_readonly("te", &hw::Spectrum::energy_period, "Energy period 2 pi m-1/m0, s.")
      .def_property_readonly("peak_omega", &hw::Spectrum::peak_omega, "Frequency of the highest density, rad/s.");
  m.def(
      "spectrum_of", [](const HeldScene& scene) { return std::const_pointer_cast<hw::Spectrum>(spectrum_of(scene)); },
      py::arg("scene"), "Spectrum of the waves of a scene.");
  m.def("unit_of", &unit_of, py::arg("kind"), py::arg("key"), "SI unit of a key of [waves]; None for no quantity.");
}

// ---- of a record and of responses ----

/// A spectrum with its moments; none where nothing moves.
struct Density {
  std::string name, units;  ///< of the signal
  hs::SpectrumPerHz spectrum;
  std::optional<hs::Moments> moments;
  std::optional<hs::Peak> peak;
};

Density density_of(std::string name, std::string units, const hs::SpectrumPerHz& spectrum) {
  Density out{std::move(name), std::move(units), spectrum, {}, {}};
  if (std::all_of(spectrum.density.begin(), spectrum.density.end(), [](double d) { return d == 0; })) return out;
  out.moments = hs::moments(spectrum, hs::whole(spectrum));
  out.peak = hs::peak(spectrum, hs::whole(spectrum));
  return out;
}

/// A number of the moments, NaN where there are none.
template <class Number>
double number_of(const Density& d, Number number) {
  return d.moments ? std::invoke(number, *d.moments) : std::numeric_limits<double>::quiet_NaN();
}

struct Densities {
  std::vector<Density> all;
  std::vector<std::string> notes, warnings;
  std::optional<hs::BandFactors> band;  ///< of an estimate
  double confidence = 0;
  std::string input;
  std::map<std::string, hs::TransferEstimate> transfers;  ///< from the input
};

const Density& named(const Densities& of, const std::string& name) {
  std::vector<std::string> names;
  for (const Density& d : of.all) {
    if (d.name == name) return d;
    names.push_back(d.name);
  }
  throw py::key_error(fmt::format("no signal \"{}\"; signals are: {}", name, fmt::join(names, ", ")));
}

const hs::TransferEstimate& transfer_of(const Densities& of, const std::string& name) {
  const auto found = of.transfers.find(name);
  if (found == of.transfers.end())
    throw py::key_error(of.input.empty() ? "no input was named" : fmt::format("no response of \"{}\"", name));
  return found->second;
}

Densities psd(const py::object& record, const PsdArguments& arguments) {
  Computing computing("psd", py::none());
  spectra::Analysis found;
  if (py::isinstance<Run>(record)) {
    const auto& run = record.cast<const Run&>();
    found = computing.of([&] { return spectra::analyse({run.time, run.signals}, arguments); });
  } else if (py::isinstance<WaterSeries>(record)) {
    const auto& water = record.cast<const WaterSeries&>();
    found = computing.of([&] { return spectra::analyse({water.time, water.signals}, arguments); });
  } else if (py::isinstance<py::dict>(record)) {
    RunResult made;
    for (const auto& [name, values] : record.cast<std::map<std::string, std::vector<double>>>()) {
      if (name == "time")
        made.time = values;
      else
        made.signals.push_back({name, "", name, values});
    }
    for (const Signal& s : made.signals)
      if (s.values.size() != made.time.size())
        throw hydro::InputError(
            fmt::format("\"{}\" has {} values, \"time\" {}", s.name, s.values.size(), made.time.size()), {},
            "give {\"time\": seconds, NAME: values, ...} of one length");
    found = computing.of([&] { return spectra::analyse(std::move(made), arguments); });
  } else {
    found = computing.of([&] { return spectra::analyse(read_record(arguments.file), arguments); });
  }
  Densities out{{}, spectra::notes_of(found), {}, found.band, found.confidence, found.input, {}};
  for (const auto& e : found.estimates) {
    out.all.push_back({e.signal.name, e.signal.units, e.welch.spectrum, e.moments, e.peak});
    if (e.transfer) out.transfers.emplace(e.signal.name, *e.transfer);
  }
  return out;
}

Densities response(const HeldScene& held, const py::object& progress) {
  Computing computing("response", progress);
  return computing.of(held, [&](const Scene& scene) {
    const scene::Scene& read = scene.read();
    if (!read.rao)
      throw hydro::InputError("the scene does not ask for RAOs, of which spectra are made",
                              {.file = read.file.string()},
                              "add to [ask]: rao = { periods = \"3 s .. 25 s, 45 values\" }");
    const auto kept = std::make_shared<compile::Kept>();
    const ResponseSpectra found = response_spectra({&read}, kept).front();
    Densities out{{density_of("sea", "m", found.sea)}, found.notes, found.warnings, {}, 0, {}, {}};
    for (const auto& s : found.signals) out.all.push_back(density_of(s.name, s.units, s.spectrum));
    if (const auto second = second_order_responses(read, kept)) {
      for (const auto& s : second->signals) {
        if (!s.slow.frequency_hz.empty()) out.all.push_back(density_of(s.name + " slow", s.units, s.slow));
        if (!s.sum.frequency_hz.empty()) out.all.push_back(density_of(s.name + " sums", s.units, s.sum));
      }
      out.notes.insert(out.notes.end(), second->notes.begin(), second->notes.end());
    }
    return out;
  });
}

void add_density(py::module_& m) {
  py::class_<Density>(m, "Density", "One-sided variance density of a signal, per hertz.")
      .def_readonly("name", &Density::name, "Of the signal.")
      .def_readonly("unit", &Density::units, "Of the signal.")
      .def_property_readonly(
          "density_unit", [](const Density& d) { return density_unit(d.units); }, "\"m^2/Hz\", ...")
      .def_property_readonly(
          "frequency",
          [](const py::object& self) { return view(self.cast<const Density&>().spectrum.frequency_hz, self); },
          "Hz, shape (frequency,).")
      .def_property_readonly(
          "density", [](const py::object& self) { return view(self.cast<const Density&>().spectrum.density, self); },
          "Unit of the signal squared per hertz, shape (frequency,).")
      .def_property_readonly(
          "moments",
          [](const Density& d) {
            using hs::Moments;
            py::dict out;
            for (const auto& [name, member] :
                 {std::pair{"m-1", &Moments::m_minus1}, std::pair{"m0", &Moments::m0}, std::pair{"m1", &Moments::m1},
                  std::pair{"m2", &Moments::m2}, std::pair{"m4", &Moments::m4}})
              out[name] = number_of(d, member);
            return out;
          },
          "Integrals of f^n times the density, n = -1, 0, 1, 2, 4; NaN where nothing moves.")
      .def_property_readonly(
          "standard_deviation", [](const Density& d) { return std::sqrt(number_of(d, &hs::Moments::m0)); },
          "sqrt(m0), unit of the signal.")
      .def_property_readonly(
          "hs", [](const Density& d) { return number_of(d, &hs::Moments::hs); },
          "4 sqrt(m0): of an elevation the significant height.")
      .def_property_readonly(
          "te", [](const Density& d) { return number_of(d, &hs::Moments::te); }, "Energy period m-1/m0, s.")
      .def_property_readonly(
          "tm01", [](const Density& d) { return number_of(d, &hs::Moments::tm01); }, "Mean period m0/m1, s.")
      .def_property_readonly(
          "tm02", [](const Density& d) { return number_of(d, &hs::Moments::tm02); },
          "Mean period of up-crossings sqrt(m0/m2), s.")
      .def_property_readonly(
          "tp", [](const Density& d) { return d.peak ? d.peak->period_s() : std::nan(""); },
          "Period of the highest density, s.");
  py::class_<Densities> type(m, "Densities", "Spectra of several signals, by name: spectra[\"m1.heave\"].");
  type.def_property_readonly(
          "signals",
          [](const Densities& of) {
            std::vector<std::string> out;
            for (const Density& d : of.all) out.push_back(d.name);
            return out;
          },
          "Names of the signals.")
      .def("__getitem__", &named, py::arg("signal"), py::return_value_policy::reference_internal,
           "Density of a signal. Raises KeyError if there is none.")
      .def_readonly("notes", &Densities::notes, "What had to be decided, and what is left out; a sentence each.")
      .def_readonly("warnings", &Densities::warnings, "What is not to be trusted; a sentence each.")
      .def_property_readonly(
          "band",
          [](const Densities& of) -> std::optional<std::pair<double, double>> {
            return of.band ? std::optional(std::pair(of.band->lower, of.band->upper)) : std::nullopt;
          },
          "Of an estimate: the density in truth is between these two times it, at `confidence`; else None.")
      .def_readonly("confidence", &Densities::confidence, "Probability of `band`; 0 without one.")
      .def(
          "transfer",
          [](const py::object& self, const std::string& name) {
            return view(transfer_of(self.cast<const Densities&>(), name).h1, self);
          },
          py::arg("signal"),
          "Transfer function H1 from the input to a signal, complex, at its frequencies; noise of the output "
          "averages out. Raises KeyError without an input.")
      .def(
          "coherence",
          [](const py::object& self, const std::string& name) {
            return view(transfer_of(self.cast<const Densities&>(), name).coherence, self);
          },
          py::arg("signal"), "Squared coherence with the input, 0 to 1, at its frequencies.");
  add_dataset(type, "of_densities", "xarray.Dataset along `frequency`, Hz; bands of an estimate beside densities.");
}

}  // namespace

void add_spectra(py::module_& m) {
  add_sea_spectrum(m);
  add_density(m);
  m.def(
      "psd",
      [](const py::object& record, const std::filesystem::path& file, const std::vector<std::string>& signals,
         std::optional<std::string> segment, std::optional<std::size_t> tapers, bool uneven,
         std::optional<std::string> input, std::optional<std::string> from, std::optional<std::string> to,
         double confidence) {
        return psd(record, {.file = file,
                            .signals = signals,
                            .segment = std::move(segment),
                            .tapers = tapers,
                            .uneven = uneven,
                            .steps = {},
                            .from = std::move(from),
                            .to = std::move(to),
                            .confidence = confidence,
                            .input = std::move(input)});
      },
      py::arg("record"), py::arg("file"), py::arg("signals"), py::arg("segment"), py::arg("tapers"), py::arg("uneven"),
      py::arg("input"), py::arg("start"), py::arg("end"), py::arg("confidence"), "froude.psd");
  m.def("response", &response, py::arg("scene"), py::arg("progress"), "froude.response");
}

}  // namespace froude::python
