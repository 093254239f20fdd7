// Scenes, and controllers written in Python.
#include <pybind11/eigen.h>
#include <pybind11/functional.h>

#include "bindings.hpp"
#include "computing.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "scene/scene.hpp"

namespace froude::python {
namespace {

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

HeldScene parse(const std::string& text, const std::filesystem::path& file, const SceneValues& values) {
  const Scene scene = froude::parse(text, std::filesystem::absolute(file));
  return {values.empty() ? scene : scene.with(values)};
}

HeldScene read(const std::filesystem::path& file, const SceneValues& values) {
  if (values.empty()) return {froude::read(file)};
  return parse(hydro::io::read_text(file), file, values);
}

Run run(const HeldScene& held, const std::map<std::string, py::function>& controllers, const py::object& progress) {
  Computing computing("run", progress);
  std::vector<Control> controls;
  for (const auto& [connectors, decide] : controllers)
    controls.push_back({connectors, [&, &decide = decide](const Sample& sample) {
                          return computing.call([&] { return ask(decide, sample); });
                        }});
  return computing.of(
      held, [&](const Scene& scene) { return scene.run([&](double share) { computing.done(share); }, controls); });
}

}  // namespace

void add_scene(py::module_& m) {
  py::class_<HeldScene>(m, "Scene",
                        "A scene as written: checked, in SI, nothing computed yet.\n\n"
                        "Made by `froude.read` and `froude.read_text`. Coefficients that are read and poles that are "
                        "fitted for one call serve the next.")
      .def_property_readonly(
          "title", [](const HeldScene& s) { return s.scene.read().title; }, "As the scene has it; \"\" without one.")
      .def_property_readonly(
          "file", [](const HeldScene& s) { return s.scene.read().file; }, "pathlib.Path of the scene.")
      .def_property_readonly(
          "text", [](const HeldScene& s) { return s.scene.read().text; },
          "As it stands in the file, without what was set.")
      .def_property_readonly(
          "bodies",
          [](const HeldScene& s) {
            std::vector<std::string> names;
            for (const auto& b : s.scene.read().bodies) names.push_back(b.name);
            return names;
          },
          "Names of the bodies.")
      .def(
          "with_values",
          [](const HeldScene& s, const std::map<std::string, SceneValue>& set) {
            return HeldScene{s.scene.with(SceneValues(set.begin(), set.end())), s.busy};
          },
          py::arg("set"),
          "The same scene with other values, which shares what was read for this one.\n\n"
          "Parameters\n----------\nset : dict\n    As of `froude.read`.\n\n"
          "Raises\n------\nInputError\n    For a key that the grammar does not know, or a value that it refuses.")
      .def("__repr__",
           [](const HeldScene& s) { return "<froude.Scene " + s.scene.read().file.filename().string() + ">"; });
  py::class_<HeldSample, std::shared_ptr<HeldSample>>(
      m, "Sample",
      "What a controller may read at the end of each step, while it decides.\n\n"
      "sample[\"m1.heave\"], sample[\"spring1.force\"]: any signal of the run, SI, computed when it is asked for.")
      .def_property_readonly(
          "time", [](const HeldSample& s) { return s.now().time(); }, "s")
      .def(
          "__getitem__", [](const HeldSample& s, const std::string& signal) { return s.now()[signal]; },
          py::arg("signal"), "Value of a signal, SI. Raises InputError, with the nearest name, if there is none.")
      .def(
          "velocity", [](const HeldSample& s, const std::string& body) { return s.now().velocity(body); },
          py::arg("body"),
          "Velocity of the centre of gravity, m/s, and angular velocity, rad/s.\n\n"
          "Returns\n-------\nnumpy.ndarray, shape (6,)\n    Global axes.");

  using Values = std::map<std::string, SceneValue>;
  m.def(
      "read",
      [](const std::filesystem::path& file, const Values& set) {
        return read(file, SceneValues(set.begin(), set.end()));
      },
      py::arg("file"), py::arg("set"), "froude.read");
  m.def(
      "read_text",
      [](const std::string& text, const std::filesystem::path& file, const Values& set) {
        return parse(text, file, SceneValues(set.begin(), set.end()));
      },
      py::arg("text"), py::arg("file"), py::arg("set"), "froude.read_text");
  m.def("run", &run, py::arg("scene"), py::arg("controllers"), py::arg("progress"), "froude.run");
}

}  // namespace froude::python
