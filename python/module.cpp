// The compiled part of the package `froude`: scenes, their answers, spectra, coefficients, controllers.
#include "bindings.hpp"
#include "hydro/base/error.hpp"

PYBIND11_MODULE(_froude, m) {
  using namespace froude::python;
  m.doc() = "The compiled part of froude. Its functions are called through the package, which describes them.";
  m.attr("__version__") = FROUDE_VERSION;
  const auto input = py::register_exception<hydro::InputError>(m, "InputError", PyExc_ValueError);
  input.doc() = "Input that cannot be: with file, line, column, the rule and the remedy, as the program tells it.";
  const auto numerics = py::register_exception<hydro::NumericsError>(m, "NumericsError", PyExc_RuntimeError);
  numerics.doc() = "A computation that gives up, or a fit whose values may not be told, with the reason.";
  add_scene(m);
  add_results(m);
  add_spectra(m);
  add_coefficients(m);
  add_answers(m);
  add_sweep(m);
}
