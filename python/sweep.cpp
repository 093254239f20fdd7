// Sweeps, and the tables that they come to.
#include <algorithm>

#include "bindings.hpp"
#include "computing.hpp"
#include "froude/sweep_task.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/parallel.hpp"
#include "sweep/sweep.hpp"
#include "sweep/table.hpp"

namespace froude::python {
namespace {

using sweep::Cell, sweep::Column, sweep::Row, sweep::Tally;

/// What a sweep comes to, case by case.
struct Table {
  std::filesystem::path folder;
  Tally tally;
  std::vector<Column> axes, numbers;
  std::vector<Row> rows;
};

std::vector<std::string> names_of(const std::vector<Column>& columns) {
  std::vector<std::string> out;
  for (const Column& c : columns) out.push_back(c.name);
  return out;
}

/// A list of Python's: numbers, NaN where a case has none; texts of an axis of words.
py::object array_of(const std::vector<Row>& rows, const std::vector<Cell> Row::*cells, std::size_t column,
                    bool is_text) {
  py::list out;
  for (const Row& row : rows) {
    const Cell cell = column < (row.*cells).size() ? (row.*cells)[column] : Cell();
    if (is_text)
      out.append(std::holds_alternative<std::string>(cell) ? std::get<std::string>(cell) : std::string());
    else
      out.append(std::holds_alternative<double>(cell) ? std::get<double>(cell)
                                                      : std::numeric_limits<double>::quiet_NaN());
  }
  return py::module_::import("numpy").attr("array")(out);
}

/// The column of a name and its place, among axes or numbers.
struct Place {
  const Column* column;
  bool is_axis;
  std::size_t at;
};
Place place_of(const Table& table, const std::string& name) {
  for (const bool is_axis : {true, false}) {
    const auto& columns = is_axis ? table.axes : table.numbers;
    const auto found = std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
    if (found != columns.end()) return {&*found, is_axis, static_cast<std::size_t>(found - columns.begin())};
  }
  throw py::key_error(fmt::format("no column \"{}\"; columns are: {}, {}", name, fmt::join(names_of(table.axes), ", "),
                                  fmt::join(names_of(table.numbers), ", ")));
}

Table run_sweep(const std::filesystem::path& file, const std::filesystem::path& folder, std::optional<int> threads,
                bool retry, const py::object& progress) {
  if (threads && *threads < 1) throw hydro::InputError("a sweep needs one thread at least", {}, "leave threads out");
  Computing computing("sweep", progress);
  return computing.of([&] {
    const SweepTask task(file);
    task.require_folder(folder);
    sweep::Store store(folder, task.identity());
    const sweep::Options options{.threads = threads.value_or(hydro::all_processors()), .retry = retry};
    // Whoever watches ends the sweep by what it answers: what is done is then kept.
    const sweep::Watch watch{{},
                             [&](double done) {
                               try {
                                 computing.done(done);
                               } catch (const Ended&) {
                               }
                             },
                             [&] { return computing.ended(); }};
    const Tally tally = sweep::carry_out(task.study, task.cases, store, options, watch);
    if (tally.interrupted) throw Ended{};
    sweep::write_table(store);
    sweep::write_pictures(task.study, store);
    return Table{folder, tally, store.identity().axes, store.columns(), store.rows()};
  });
}

}  // namespace

void add_sweep(py::module_& m) {
  py::class_<Table> type(m, "Sweep", "The table that a sweep comes to: sweep[\"m1.heave.amplitude\"], shape (case,).");
  type.def_property_readonly(
          "axes", [](const Table& t) { return names_of(t.axes); }, "Names of the axes of the study.")
      .def_property_readonly(
          "numbers", [](const Table& t) { return names_of(t.numbers); }, "Names of the numbers of its outputs.")
      .def(
          "__getitem__",
          [](const Table& t, const std::string& name) {
            const Place at = place_of(t, name);
            return array_of(t.rows, at.is_axis ? &Row::axes : &Row::numbers, at.at, at.column->is_text);
          },
          py::arg("column"),
          "Values of a column, shape (case,): axes as the study writes them, in `unit`; numbers in SI, NaN where a "
          "case has none. Raises KeyError if there is none.")
      .def(
          "unit", [](const Table& t, const std::string& name) { return place_of(t, name).column->unit; },
          py::arg("column"), "Unit of a column; \"\" for a number or text.")
      .def_property_readonly(
          "case",
          [](const Table& t) {
            std::vector<std::size_t> out;
            for (const Row& row : t.rows) out.push_back(row.number);
            return out;
          },
          "Numbers of the cases, from 1.")
      .def_property_readonly(
          "state",
          [](const Table& t) {
            std::vector<std::string> out;
            for (const Row& row : t.rows) out.push_back(name_of(row.state));
            return out;
          },
          "\"done\", \"failed\" or \"skipped\", case by case.")
      .def_property_readonly(
          "reason",
          [](const Table& t) {
            std::vector<std::string> out;
            for (const Row& row : t.rows) out.push_back(row.reason);
            return out;
          },
          "Why a case failed or was skipped; \"\" where it is done.")
      .def_property_readonly(
          "warnings",
          [](const Table& t) {
            std::vector<std::string> out;
            for (const Row& row : t.rows) out.push_back(row.warnings);
            return out;
          },
          "What of a case is not to be trusted, case by case.")
      .def_readonly("folder", &Table::folder, "pathlib.Path of the folder with the database, table.csv and pictures.");
  add_dataset(type, "of_sweep", "xarray.Dataset along `case`: axes as coordinates, numbers as variables.");
  m.def("sweep", &run_sweep, py::arg("study"), py::arg("folder"), py::arg("threads"), py::arg("retry"),
        py::arg("progress"), "froude.sweep");
}

}  // namespace froude::python
