// Runs, responses, the water and free motions, as numpy arrays.
#include <algorithm>

#include "bindings.hpp"
#include "froude/outputs.hpp"

namespace froude::python {
namespace {

/// A signal is a series in a run, and in responses to several headings one row for each of them.
std::vector<std::size_t> shape_of(const Run& run) { return {run.time.size()}; }
std::vector<std::size_t> shape_of(const WaterSeries& water) { return {water.time.size()}; }
std::vector<std::size_t> shape_of(const Responses& r) {
  if (r.heading.size() == 1) return {r.omega.size()};
  return {r.heading.size(), r.omega.size()};
}
std::vector<std::size_t> shape_of(const FreeSurface& surface) { return {surface.y.size(), surface.x.size()}; }

/// Writes what is HDF5 under a name that says so. \throws hydro::InputError
template <class Result>
void write_result(const Result& result, const std::filesystem::path& file) {
  require_result(file, "froude.export makes tables of it");
  result.write(file);
}

template <class Result>
std::vector<std::string> names_of(const Result& result) {
  std::vector<std::string> out;
  for (const auto& s : result.signals) out.push_back(s.name);
  return out;
}

template <class Result>
std::size_t place_of(const Result& result, const std::string& name) {
  const auto names = names_of(result);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw py::key_error(fmt::format("no signal \"{}\"; signals are: {}", name, fmt::join(names, ", ")));
  return static_cast<std::size_t>(found - names.begin());
}

/// What all results of signals have alike: signals by name, their units and meanings, notes, a file.
template <class Result>
void add_signals(py::class_<Result>& type) {
  type.def_property_readonly("signals", names_of<Result>, "Names of the signals, in the order of the scene.")
      .def(
          "__contains__",
          [](const Result& r, const std::string& name) {
            const auto names = names_of(r);
            return std::find(names.begin(), names.end(), name) != names.end();
          },
          py::arg("signal"), "True if there is a signal of this name.")
      .def(
          "__getitem__",
          [](const py::object& self, const std::string& name) {
            const auto& result = self.cast<const Result&>();
            return view(result.signals[place_of(result, name)].values, self, shape_of(result));
          },
          py::arg("signal"), "Values of a signal, SI; they cannot be written. Raises KeyError if there is none.")
      .def(
          "unit", [](const Result& r, const std::string& name) { return r.signals[place_of(r, name)].units; },
          py::arg("signal"), "Unit of a signal; \"\" for a number.")
      .def(
          "meaning", [](const Result& r, const std::string& name) { return r.signals[place_of(r, name)].long_name; },
          py::arg("signal"), "What a signal is, in words.")
      .def_readonly("notes", &Result::notes, "What had to be decided, and what is left out; a sentence each.")
      .def_property_readonly(
          "settings", [](const Result& r) { return dict_of(r.provenance.settings); },
          "Every key of the scene that acts and its value, defaults included.")
      .def("write", write_result<Result>, py::arg("file"),
           "Writes the file that the program writes: HDF5, which is netCDF-4 too.\n\n"
           "It is there as a whole or not at all. Raises InputError if it cannot be written.");
}

/// What runs and responses tell of their accuracy.
template <class Result>
void add_error(py::class_<Result>& type, const char* of) {
  type.def(
          "error",
          [](const Result& r, const std::string& name) -> std::optional<double> {
            const std::size_t at = place_of(r, name);
            if (!r.error.missing.empty() || r.error.sources.empty()) return std::nullopt;
            return r.error.total(at);
          },
          py::arg("signal"), of)
      .def_property_readonly(
          "accuracy", [](const Result& r) { return r.accuracy(); },
          "What accuracy was asked and is estimated, in words; \"\" where nothing is estimated.")
      .def_property_readonly(
          "warnings", [](const Result& r) { return r.warnings(); }, "What is not to be trusted; a sentence each.");
}

void add_run(py::module_& m) {
  py::class_<Run> type(m, "Run",
                       "A run in time. run[\"m1.heave\"] is a signal as a numpy array, shape (time,), SI.\n\n"
                       "Motions are about rest, of the centre of gravity, global axes; rotations in radians.");
  add_signals(type);
  add_error(type,
            "Estimated error of a signal, over its size; None where there is no estimate.\n\n"
            "The largest of rms, standard deviation and extremes (docs/theory/accuracy.md).");
  type.def_property_readonly("time", view_of(&Run::time), "s, shape (time,).")
      .def_readonly("step", &Run::step, "s")
      .def_readonly("steps", &Run::steps, "Steps completed.")
      .def_readonly("stopped", &Run::stopped, "Why it ended before its time; empty if it did not.")
      .def_property_readonly(
          "energy", [](const Run& r) { return dict_of(r.energy); },
          "J, by effect, at the end; `residual` is what does not balance, of `turnover`; `largest_residual` when it "
          "was most.")
      .def_property_readonly(
          "evaluations", [](const Run& r) { return dict_of(r.evaluations); }, "How often each effect was evaluated.");
  add_dataset(type, "of_run", "xarray.Dataset along `time`; each signal has `units`, `long_name` and `error`.");
}

py::list sections_of(const Responses& r) {
  py::list out;
  for (const SectionAtRest& s : r.sections) {
    py::dict one;
    one["name"] = s.name;
    one["at"] = py::array_t<double>(3, s.at.data());
    one["normal"] = py::array_t<double>(3, s.normal.data());
    one["at_rest"] = py::array_t<double>(6, s.load.data());
    out.append(one);
  }
  return out;
}

void add_rao(py::module_& m) {
  py::class_<Responses> type(
      m, "Rao",
      "Response amplitude operators: responses per metre of wave amplitude, complex.\n\n"
      "abs(rao[\"m1.heave\"]) is in m/m; phases are against the crest at the global origin, e^{+i omega t}: a positive "
      "phase comes before the crest. Shape (omega,); of several headings (heading, omega).");
  add_signals(type);
  add_error(type, "Estimated error of a signal, over its peak; None where there is no estimate.");
  type.def_property_readonly("omega", view_of(&Responses::omega), "Frequency of the waves, rad/s, shape (omega,).")
      .def_property_readonly("heading", view_of(&Responses::heading),
                             "Where the waves go, rad, from +x towards +y, shape (heading,), also of one.");
  type.def_property_readonly(
      "sections", sections_of,
      "Sections of hulls of which a load is among the signals: for each a dict of its `name`, "
      "the point `at` and the `normal` of its plane, shape (3,), m, and `at_rest`, shape (6,), N "
      "and N m: force and moment where the bodies are still, on the part that is described.");
  add_dataset(type, "of_rao", "xarray.Dataset along `heading` and `omega`, complex; `units` and `long_name` of each.");
  add_dataset(type, "of_section_loads",
              "xarray.Dataset of the loads at sections, complex, along `section`, `heading` and `omega`; those at rest "
              "along `section`, as `force_x_at_rest`; `units` and `long_name` of each.",
              "section_loads");
}

void add_field(py::module_& m) {
  py::class_<FreeSurface> type(
      m, "FreeSurface",
      "The free surface about bodies in one regular wave, per metre of wave amplitude, complex.\n\n"
      "field[\"elevation\"] is the sum of \"incident\", \"scattered\" and \"radiated\", shape (y, x); NaN in bodies "
      "and "
      "where nothing is told. Phases are against the crest at the global origin, e^{+i omega t}.");
  add_signals(type);
  type.def_property_readonly("x", view_of(&FreeSurface::x), "Of the grid, global, m, shape (x,).")
      .def_property_readonly("y", view_of(&FreeSurface::y), "Of the grid, global, m, shape (y,).")
      .def_readonly("omega", &FreeSurface::omega, "Frequency of the wave, rad/s.")
      .def_readonly("heading", &FreeSurface::heading, "Where the wave goes, rad, from +x towards +y.")
      .def_readonly("held", &FreeSurface::held, "True if the bodies are held still.")
      .def_readonly("estimate", &FreeSurface::estimate, "Estimated error of the elevation, over its largest.")
      .def_property_readonly(
          "mean_drift", [](const FreeSurface& f) { return py::make_tuple(f.drift_x, f.drift_y); },
          "Mean drift force on all bodies along x and y, N per m^2 of wave amplitude.")
      .def_property_readonly("angle", view_of(&FreeSurface::angle),
                             "Directions of far_scattered and far_radiated, rad, shape (angle,).")
      .def_property_readonly(
          "far_scattered", view_of(&FreeSurface::far_scattered),
          "A of what bodies held still add far away, A sqrt(2/(pi k r)) e^{-i(k r - pi/4)} per metre "
          "of wave amplitude at the distance r from the origin, complex, shape (angle,).")
      .def_property_readonly("far_radiated", view_of(&FreeSurface::far_radiated),
                             "The same of the motion of the bodies.")
      .def_property_readonly(
          "body_drift",
          [](const FreeSurface& f) {
            py::dict out;
            for (const FreeSurface::BodyDrift& one : f.body_drift)
              out[py::str(one.body)] = py::make_tuple(one.x, one.y, one.moment);
            return out;
          },
          "Mean drift of each body by itself, where `body_drift` asks for it: force along x and y, N, and moment about "
          "the vertical through its origin, N m, per m^2 of wave amplitude.")
      .def_readonly("body_drift_error", &FreeSurface::body_drift_error,
                    "Estimated error of body_drift, over the largest.")
      .def_readonly("power_taken", &FreeSurface::power_taken,
                    "Mean power that the bodies take, W per m^2 of amplitude.")
      .def_readonly("power_sent_out", &FreeSurface::power_sent_out,
                    "Mean power of scattered and radiated waves, W per m^2 of amplitude.");
  add_dataset(type, "of_field", "xarray.Dataset along `y` and `x`, complex; `units` and `long_name` of each.");
}

void add_water(py::module_& m) {
  py::class_<WaterSeries> type(m, "Water",
                               "What the water does at the probes of a scene. water[\"probe.elevation\"] is a numpy "
                               "array, shape (time,), SI.");
  add_signals(type);
  type.def_property_readonly("time", view_of(&WaterSeries::time), "s, shape (time,).")
      .def_readonly("method", &WaterSeries::method, "How it was computed: \"inverse FFT\", ...");
  add_dataset(type, "of_run", "xarray.Dataset along `time`; each signal has `units` and `long_name`.");
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <class Of>
py::array_t<double> of_each_mode(const Modes& modes, const Of& of) {
  std::vector<double> out;
  for (std::size_t i = 0; i < modes.count(); ++i) out.push_back(of(i));
  return py::array_t<double>(static_cast<py::ssize_t>(out.size()), out.data());
}

void add_modes(py::module_& m) {
  py::class_<Modes> type(m, "Modes", "Free motions about rest, by rising frequency.");
  type.def_readonly("motions", &Modes::motions, "\"m1.surge\", ...: what the columns of `shape` are.")
      .def_property_readonly("omega", view_of(&Modes::omega), "Undamped, rad/s, shape (mode,).")
      .def_property_readonly(
          "period", [](const Modes& modes) { return of_each_mode(modes, [&](auto i) { return modes.period(i); }); },
          "Undamped, s, shape (mode,).")
      .def_property_readonly(
          "damped_period",
          [](const Modes& modes) {
            return of_each_mode(modes, [&](auto i) { return modes.damped_period(i).value_or(not_a_number); });
          },
          "Of a decay, s, shape (mode,); NaN where the motion creeps back without swinging.")
      .def_property_readonly(
          "damping_ratio",
          [](const Modes& modes) {
            return of_each_mode(modes, [&](auto i) { return modes.damping_ratio(i).value_or(not_a_number); });
          },
          "Of the critical damping, shape (mode,); NaN where the motion creeps back without swinging.")
      .def_property_readonly(
          "shape",
          [](const py::object& self) {
            const auto& modes = self.cast<const Modes&>();
            return view(modes.shape, self, {modes.count(), modes.motions.size()});
          },
          "Undamped, of the centres of gravity, m and rad, shape (mode, motion).")
      .def_property_readonly(
          "outside_data",
          [](const Modes& modes) {
            return py::array(py::cast(std::vector<bool>(modes.outside_data))).attr("astype")("bool");
          },
          "True where the frequency is outside those of the coefficients, shape (mode,).")
      .def_readonly("notes", &Modes::notes, "What had to be decided, and what is left out; a sentence each.")
      .def("write", write_result<Modes>, py::arg("file"),
           "Writes the file that the program writes: HDF5, which is netCDF-4 too.");
  add_dataset(type, "of_modes", "xarray.Dataset along `mode` and `motion`.");
}

}  // namespace

void add_results(py::module_& m) {
  add_run(m);
  add_rao(m);
  add_field(m);
  add_water(m);
  add_modes(m);
}

}  // namespace froude::python
