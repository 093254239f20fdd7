// Scenes, and controllers written in Python.
#include <pybind11/eigen.h>
#include <pybind11/functional.h>

#include <algorithm>
#include <exception>

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

/// The same for a controller of a joint.
class HeldJointSample : public HeldSample {
 public:
  explicit HeldJointSample(const JointSample& now) : HeldSample(now.run), joint_(now) {}
  /// Of a sample that can still be read.
  const JointSample& of_joint() const {
    now();
    return joint_;
  }

 private:
  JointSample joint_;
};

[[noreturn]] void raise_type_error(const std::string& text) {
  PyErr_SetString(PyExc_TypeError, text.c_str());
  throw py::error_already_set();
}

/// What a controller returns of a sample, which it can read until then.
template <class Held, class Now>
py::object returned(const py::function& decide, const Now& now) {
  const auto held = std::make_shared<Held>(now);
  struct End {
    HeldSample& sample;
    ~End() { sample.end(); }
  } const at_the_end{*held};
  return decide(held);
}

double number_in(const py::handle& value, const std::string& name, const char* wanted) {
  try {
    return value.cast<double>();
  } catch (const py::cast_error&) {
    raise_type_error(
        fmt::format("the controller of \"{}\" returned {}; {}", name, py::repr(value).cast<std::string>(), wanted));
  }
}

std::optional<double> stiffness_in(const py::object& answer, const std::string& name) {
  if (answer.is_none()) return std::nullopt;
  return number_in(answer, name, "return a stiffness, N/m, or None");
}

std::optional<dynamics::Command> command_in(const py::object& answer, const std::string& name) {
  constexpr const char* wanted = "return a force, or force, stiffness and damping, or None";
  if (answer.is_none()) return std::nullopt;
  if (!py::isinstance<py::tuple>(answer)) return dynamics::Command{.force = number_in(answer, name, wanted)};
  const auto all = answer.cast<py::tuple>();
  if (all.size() != 3) number_in(answer, name, wanted);
  return dynamics::Command{number_in(all[0], name, wanted), number_in(all[1], name, wanted),
                           number_in(all[2], name, wanted)};
}

/// Functions that rule one run. Where one raises, the run ends there, and what was raised comes out with what the run
/// has as its attribute `run`; at Ctrl-C nothing is kept.
class Asking {
 public:
  explicit Asking(Computing& computing) : computing_(computing) {}

  /// What `answer` makes of what the controller returns.
  template <class Answer>
  auto of(const std::string& name, double time, const Answer& answer) {
    std::string why;
    auto out = computing_.call([&]() -> decltype(answer()) {
      try {
        return answer();
      } catch (py::error_already_set& error) {
        if (error.matches(PyExc_KeyboardInterrupt)) throw;
        why = fmt::format("{}: {}", error.type().attr("__name__").cast<std::string>(),
                          py::str(error.value()).cast<std::string>());
        raised_ = std::current_exception();
      }
      return {};
    });
    if (!why.empty())
      throw hydro::NumericsError(fmt::format("the controller of \"{}\" raised {}, at t = {:.6g} s", name, why, time));
    return out;
  }
  Run told(Run run) const {
    if (!raised_) return run;
    try {
      std::rethrow_exception(raised_);
    } catch (py::error_already_set& error) {
      error.value().attr("run") = py::cast(std::move(run));
      throw;
    }
  }

 private:
  Computing& computing_;
  std::exception_ptr raised_;  // touched with the lock of the interpreter only
};

HeldScene parse(const std::string& text, const std::filesystem::path& file, const SceneValues& values) {
  const Scene scene = froude::parse(text, std::filesystem::absolute(file));
  return {values.empty() ? scene : scene.with(values)};
}

HeldScene read(const std::filesystem::path& file, const SceneValues& values) {
  if (values.empty()) return {froude::read(file)};
  return parse(hydro::io::read_text(file), file, values);
}

template <class Named>
bool any_matches(const std::string& pattern, const std::vector<Named>& all) {
  return std::any_of(all.begin(), all.end(), [&](const Named& one) { return scene::matches(pattern, one.name); });
}

using Functions = std::map<std::string, py::function>;

struct Controls {
  std::vector<Control> connectors;
  std::vector<JointControl> joints;
};

/// Connectors and joints are told apart by their names. \throws hydro::InputError where a name stands for both or none
Controls controls_of(const scene::Scene& scene, const Functions& controllers, Asking& asking) {
  Controls out;
  for (const auto& [name, decide] : controllers) {
    const bool of_joints = any_matches(name, scene.joints), of_connectors = any_matches(name, scene.connectors);
    if (of_joints && of_connectors)
      throw hydro::InputError(fmt::format("\"{}\" stands for connectors and for joints", name), {},
                              "give a controller to each, by names that only one of them has");
    if (!of_joints && !of_connectors)
      throw hydro::InputError(fmt::format("no axial connector, slider or hinge is called \"{}\"", name), {},
                              "names are those of signals: \"spring1\" of \"spring1.force\"; * stands for anything");
    if (of_joints)
      out.joints.push_back({name, [&asking, &decide = decide](const JointSample& now) {
                              return asking.of(now.joint, now.run.time(), [&] {
                                return command_in(returned<HeldJointSample>(decide, now), now.joint);
                              });
                            }});
    else
      out.connectors.push_back(
          {name, [&asking, &name = name, &decide = decide](const Sample& now) {
             return asking.of(name, now.time(), [&] { return stiffness_in(returned<HeldSample>(decide, now), name); });
           }});
  }
  return out;
}

Run run(const HeldScene& held, const Functions& controllers, const py::object& progress) {
  Computing computing("run", progress);
  Asking asking(computing);
  const Controls controls = controls_of(held.scene.read(), controllers, asking);
  return asking.told(computing.of(held, [&](const Scene& scene) {
    return scene.run([&](double share) { computing.done(share); }, controls.connectors, controls.joints);
  }));
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
  py::class_<HeldJointSample, HeldSample, std::shared_ptr<HeldJointSample>>(
      m, "JointSample", "A `Sample` with the place and the rate of the joint whose force is asked for.")
      .def_property_readonly(
          "joint", [](const HeldJointSample& s) { return s.of_joint().joint; }, "Its name.")
      .def_property_readonly(
          "coordinate", [](const HeldJointSample& s) { return s.of_joint().coordinate; },
          "Stroke of a slider, m, or angle of a hinge, rad; zero at rest.")
      .def_property_readonly(
          "rate", [](const HeldJointSample& s) { return s.of_joint().rate; }, "m/s or rad/s");

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
