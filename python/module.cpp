// The module `froude`: scenes, their runs and responses as numpy arrays, and controllers written in Python.
#include <pybind11/complex.h>
#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "answers/linear_response.hpp"
#include "answers/simulate.hpp"
#include "compile/control.hpp"
#include "hydro/base/error.hpp"
#include "scene/override.hpp"

namespace py = pybind11;

namespace froude::python {
namespace {

/// Lets Ctrl-C through.
void look_up(double) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// A sample as Python holds it, which may keep it: it can be read while its controller decides.
class HeldSample {
 public:
  explicit HeldSample(const Sample& now) : now_(&now) {}
  void end() { now_ = nullptr; }
  const Sample& now() const {
    if (now_ == nullptr)
      throw hydro::InputError("a sample was read after its controller had decided", {},
                              "keep the numbers that are read, not the sample");
    return *now_;
  }

 private:
  const Sample* now_;
};

std::optional<double> ask(const py::function& decide, const Sample& sample) {
  const auto held = std::make_shared<HeldSample>(sample);
  struct End {
    HeldSample& sample;
    ~End() { sample.end(); }
  } const at_the_end{*held};
  return decide(held).cast<std::optional<double>>();
}

Run run(const scene::Scene& scene, const std::map<std::string, py::function>& controllers) {
  if (!scene.run)
    throw hydro::InputError(fmt::format("\"{}\" does not ask for a run", scene.file.filename().string()), {},
                            "[ask] run = { duration = \"600 s\", every = \"0.05 s\" }");
  std::vector<Control> controls;
  for (const auto& [connectors, decide] : controllers)
    controls.push_back({connectors, [decide = decide](const Sample& sample) { return ask(decide, sample); }});
  return simulate(scene, look_up, controls);
}

Responses rao(const scene::Scene& scene) {
  if (!scene.rao)
    throw hydro::InputError(fmt::format("\"{}\" does not ask for RAOs", scene.file.filename().string()), {},
                            "[ask] rao = { periods = \"2 s .. 8 s, 61 values\" }");
  return respond(scene);
}

scene::Scene read(const std::filesystem::path& file, const std::map<std::string, double>& numbers) {
  if (numbers.empty()) return scene::read(file);
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) return scene::read(file);  // says what is wrong with the file
  std::vector<scene::OverriddenNumber> others;
  for (const auto& [path, value] : numbers) others.push_back({path, value});
  return scene::parse_with(text.str(), std::filesystem::absolute(file), others);
}

/// The numbers of `owner` as an array of one length, or of rows of one length, that cannot be written and keeps it
/// alive.
template <class T>
py::array_t<T> view(const std::vector<T>& values, const py::handle& owner, std::vector<std::size_t> shape = {}) {
  if (shape.empty()) shape = {values.size()};
  py::array_t<T> out(std::vector<py::ssize_t>(shape.begin(), shape.end()), values.data(), owner);
  out.attr("flags").attr("writeable") = false;
  return out;
}

/// A signal is a series in a run, and in responses to several headings one row for each of them.
std::vector<std::size_t> shape_of(const Run& run) { return {run.time.size()}; }
std::vector<std::size_t> shape_of(const Responses& r) {
  if (r.heading.size() == 1) return {r.omega.size()};
  return {r.heading.size(), r.omega.size()};
}

template <class Result>
std::vector<std::string> names_of(const Result& result) {
  std::vector<std::string> out;
  for (const auto& s : result.signals) out.push_back(s.name);
  return out;
}

template <class Result>
const auto& signal_of(const Result& result, const std::string& name) {
  for (const auto& s : result.signals)
    if (s.name == name) return s;
  throw py::key_error(fmt::format("no signal \"{}\"; signals are: {}", name, fmt::join(names_of(result), ", ")));
}

/// What runs and responses have alike: signals by name, their units and meanings.
template <class Result>
void add_signals(py::class_<Result>& type) {
  type.def_property_readonly("signals", names_of<Result>, "Names of the signals.")
      .def("__contains__",
           [](const Result& r, const std::string& name) {
             const auto names = names_of(r);
             return std::find(names.begin(), names.end(), name) != names.end();
           })
      .def(
          "__getitem__",
          [](const py::object& self, const std::string& name) {
            const auto& result = self.cast<const Result&>();
            return view(signal_of(result, name).values, self, shape_of(result));
          },
          "Values of one signal, SI.")
      .def(
          "unit", [](const Result& r, const std::string& name) { return signal_of(r, name).units; },
          "Unit of a signal.")
      .def(
          "meaning", [](const Result& r, const std::string& name) { return signal_of(r, name).long_name; },
          "What a signal is.")
      .def_readonly("notes", &Result::notes, "What had to be decided, and what is left out.");
}

void add_run(py::module_& m) {
  py::class_<Run> type(m, "Run", "A run in time. run[\"m1.heave\"] is a signal as a numpy array, SI.");
  add_signals(type);
  type.def_property_readonly(
          "time", [](const py::object& self) { return view(self.cast<const Run&>().time, self); }, "s")
      .def_readonly("step", &Run::step, "s")
      .def_readonly("steps", &Run::steps, "Steps completed.")
      .def_readonly("stopped", &Run::stopped, "Why it ended before its time; empty if it did not.")
      .def_property_readonly(
          "energy", [](const Run& r) { return std::map<std::string, double>(r.energy.begin(), r.energy.end()); },
          "J, by effect, at the end; `residual` is what does not balance, of `turnover`; `largest_residual` when it "
          "was most.")
      .def_property_readonly(
          "evaluations",
          [](const Run& r) { return std::map<std::string, std::size_t>(r.evaluations.begin(), r.evaluations.end()); },
          "How often each effect was evaluated.");
}

void add_rao(py::module_& m) {
  py::class_<Responses> type(
      m, "Rao",
      "Responses per metre of wave amplitude, complex: |rao[\"m1.heave\"]| in m/m, phases against the crest at "
      "the global origin, e^{i omega t}. Of several headings a signal has one row each.");
  add_signals(type);
  type.def_property_readonly(
          "omega", [](const py::object& self) { return view(self.cast<const Responses&>().omega, self); }, "rad/s")
      .def_property_readonly(
          "heading", [](const py::object& self) { return view(self.cast<const Responses&>().heading, self); },
          "rad, where the waves go; an array, also of one.");
}

}  // namespace
}  // namespace froude::python

PYBIND11_MODULE(froude, m) {
  using namespace froude;
  using namespace froude::python;
  m.doc() = "Floating and submerged structures in waves: scenes, their runs and responses, controllers.";
  m.attr("__version__") = FROUDE_VERSION;
  py::register_exception<hydro::InputError>(m, "InputError", PyExc_ValueError);
  py::register_exception<hydro::NumericsError>(m, "NumericsError", PyExc_RuntimeError);

  py::class_<scene::Scene>(m, "Scene", "A scene as written: checked, in SI, nothing computed yet.")
      .def_readonly("title", &scene::Scene::title)
      .def_property_readonly("file", [](const scene::Scene& s) { return s.file; })
      .def_property_readonly(
          "bodies",
          [](const scene::Scene& s) {
            std::vector<std::string> names;
            for (const auto& b : s.bodies) names.push_back(b.name);
            return names;
          },
          "Names of the bodies.");
  py::class_<HeldSample, std::shared_ptr<HeldSample>>(
      m, "Sample", "What a controller may read at the end of each step, while it decides.")
      .def_property_readonly(
          "time", [](const HeldSample& s) { return s.now().time(); }, "s")
      .def(
          "__getitem__", [](const HeldSample& s, const std::string& signal) { return s.now()[signal]; },
          "Any signal of the run, SI: sample[\"m1.heave\"], sample[\"spring1.force\"]. Computed when it is asked for.")
      .def(
          "velocity", [](const HeldSample& s, const std::string& body) { return s.now().velocity(body); },
          py::arg("body"),
          "Velocity of the centre of gravity, m/s, and angular velocity, rad/s: six numbers, global axes.");
  add_run(m);
  add_rao(m);

  m.def("read", python::read, py::arg("file"), py::arg("numbers") = std::map<std::string, double>(),
        "Reads a scene. `numbers` writes other numbers over those of the file, in the units written there: "
        "{\"waves.height\": 2.0}. Raises InputError with file, line, column, rule and remedy.");
  m.def("run", python::run, py::arg("scene"), py::arg("controllers") = std::map<std::string, py::function>(),
        "Runs a scene in time. `controllers` sets the stiffness of axial connectors: {\"spring*\": decide}, where "
        "decide(sample) is called at the end of each step and returns N/m, or None to leave it.");
  m.def("rao", python::rao, py::arg("scene"), "Response amplitude operators of a scene.");
}
