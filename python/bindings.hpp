#pragma once
/// \file  Private to the module: what its files have in common. They convert and call; what is computed is computed by
///        the libraries.
#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "froude/scene.hpp"

namespace froude::python {

namespace py = pybind11;

/// A scene, and the lock of all that share what was read for it: one thread at a time may ask.
struct HeldScene {
  Scene scene;
  std::shared_ptr<std::mutex> busy = std::make_shared<std::mutex>();
};

/// A part of the module each.
void add_scene(py::module_& m);
void add_results(py::module_& m);
void add_spectra(py::module_& m);
void add_coefficients(py::module_& m);
void add_answers(py::module_& m);
void add_sweep(py::module_& m);

/// Numbers of `owner` as an array of one dimension, or of this shape, that cannot be written and keeps it alive.
template <class T>
py::array_t<T> view(const T* values, const py::handle& owner, const std::vector<std::size_t>& shape) {
  py::array_t<T> out(std::vector<py::ssize_t>(shape.begin(), shape.end()), values, owner);
  out.attr("flags").attr("writeable") = false;
  return out;
}
template <class T>
py::array_t<T> view(const std::vector<T>& values, const py::handle& owner, const std::vector<std::size_t>& shape = {}) {
  return view(values.data(), owner, shape.empty() ? std::vector{values.size()} : shape);
}

/// A property of T that is a view of one of its lists.
template <class T, class Number>
py::cpp_function view_of(std::vector<Number> T::*member) {
  return py::cpp_function([member](const py::object& self) { return view(self.cast<const T&>().*member, self); });
}

/// The method to_xarray() of a class, or one of another name: the dataset that a function of froude.datasets makes of
/// it.
inline void add_dataset(const py::object& type, const char* maker, const char* doc, const char* method = "to_xarray") {
  type.attr(method) = py::cpp_function(
      [maker](const py::object& self) { return py::module_::import("froude.datasets").attr(maker)(self); },
      py::name(method), py::is_method(type), doc);
}

/// Pairs in their order.
template <class Value>
py::dict dict_of(const std::vector<std::pair<std::string, Value>>& pairs) {
  py::dict out;
  for (const auto& [name, value] : pairs) out[py::str(name)] = value;
  return out;
}

}  // namespace froude::python
