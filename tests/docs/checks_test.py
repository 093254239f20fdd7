#!/usr/bin/python3
"""The checks of the documents, tried on small trees with one planted fault each: a check that cannot fail is no check."""
import tempfile
import unittest
from pathlib import Path

import checks


def tree(files):
    """A folder with these files, given as {path: text}; it lives as long as the returned object."""
    folder = tempfile.TemporaryDirectory()
    for name, text in files.items():
        path = Path(folder.name) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return folder


class ChecksCase(unittest.TestCase):
    def complaints(self, check, files):
        with tree(files) as folder:
            return checks.CHECKS[check](Path(folder))

    def accepts(self, check, files):
        self.assertEqual(self.complaints(check, files), [])

    def refuses(self, check, files, *words):
        complaints = "\n".join(self.complaints(check, files))
        for word in words:
            self.assertIn(word, complaints)


class Tags(ChecksCase):
    PAGE = {"docs/theory/w.md": "### (W1) Dispersion\n### (W2)-(W4) Speeds\n"}
    CODE = {"libhydro/src/w.cpp": "// (W1), then (W2)-(W4)\nint x;\n"}

    def test_accepts_tags_that_are_defined_and_used(self):
        self.accepts("tags", self.PAGE | self.CODE)

    def test_refuses_a_tag_that_is_used_but_not_defined(self):
        self.refuses("tags", self.PAGE | self.CODE | {"tests/a_test.cpp": "int a;  // see (R7)\n"}, "tests/a_test.cpp:1", "(R7)")

    def test_refuses_a_tag_that_is_defined_but_not_used(self):
        self.refuses("tags", self.PAGE | {"libhydro/src/w.cpp": "// (W1)-(W3)\n"}, "docs/theory/w.md:2", "(W4)")

    def test_refuses_a_tag_that_is_defined_twice(self):
        self.refuses("tags", self.PAGE | self.CODE | {"docs/theory/x.md": "### (W3) Again\n"}, "already defined at")

    def test_refuses_a_file_that_moved_away(self):
        page = {"docs/theory/w.md": "### (W1) D\nCode: libhydro/src/gone.cpp\n"}
        self.refuses("tags", page | {"libhydro/src/w.cpp": "// (W1)\n"}, "no file libhydro/src/gone.cpp")

    def test_takes_no_call_or_other_letter_for_a_tag(self):
        self.accepts("tags", {"apps/a.cpp": "f(F1);  // f(F1) and (A1), v[0](S2), (W1a)\nauto y = (F1);\n"})


class Includes(ChecksCase):
    HYDRO = {"libhydro/include/hydro/base/a.hpp": "\n", "libhydro/src/base/private.hpp": "\n"}

    def test_accepts_includes_that_point_down(self):
        self.accepts("includes", self.HYDRO | {"libdynamics/src/b.cpp": '#include "hydro/base/a.hpp"\n#include "local.hpp"\n'})

    def test_refuses_an_include_that_points_up(self):
        self.refuses("includes", {"libhydro/src/a.cpp": '#include <vector>\n#include "dynamics/m.hpp"\n'},
                     "libhydro/src/a.cpp:2", "may not include dynamics/m.hpp")
        self.refuses("includes", {"libfit/src/a.cpp": '#include "froude/commands.hpp"\n'}, "may not include")

    def test_refuses_a_product_that_holds_what_judges_it(self):
        for part in ("libhydro/src", "libdynamics/include/dynamics", "libfit/src", "apps/froude", "apps/scene", "python"):
            for name in ("harness/report.hpp", "support/plain.hpp", "laws/kinds.hpp", "validation/hulme/case.hpp"):
                self.refuses("includes", {f"{part}/a.cpp": f'#include "{name}"\n'}, f"{part}/a.cpp:1", f"may not include {name}")

    def test_accepts_reference_solutions_in_tests_and_validation(self):
        text = '#include "answers/plot.hpp"\n#include "harness/case.hpp"\n#include "support/plain.hpp"\n'
        self.accepts("includes", {"validation/hulme/case.cpp": text, "tests/apps/a_test.cpp": text})

    def test_refuses_laws_of_tests_in_a_case(self):
        self.refuses("includes", {"validation/hulme/case.cpp": '#include "laws/kinds.hpp"\n'}, "validation may not include laws/kinds.hpp")

    def test_refuses_a_public_header_that_needs_a_private_one(self):
        self.refuses("includes", self.HYDRO | {"libhydro/include/hydro/base/b.hpp": '#include "base/private.hpp"\n'},
                     "not a public header")

    def test_refuses_a_way_around_by_path(self):
        self.refuses("includes", self.HYDRO | {"libfit/src/a.cpp": '#include "../../libhydro/src/base/private.hpp"\n'}, "by path")

    def test_refuses_a_way_around_by_brackets(self):
        self.refuses("includes", {"libhydro/src/base/a.cpp": "#include <dynamics/state/body.hpp>\n"}, "may not include dynamics/state/body.hpp")


class Floors(ChecksCase):
    UP = '#include "dynamics/force/kind.hpp"\n'
    FORCE = {"libdynamics/include/dynamics/force/kind.hpp": '#include "dynamics/state/body.hpp"\n',
             "libdynamics/include/dynamics/state/body.hpp": "\n"}

    def test_accepts_folders_that_use_what_is_below(self):
        self.accepts("includes", self.FORCE | {"libdynamics/src/force/kind.cpp": '#include "dynamics/force/kind.hpp"\n#include "state/own.hpp"\n',
                                               "libdynamics/src/state/own.hpp": "\n"})

    def test_refuses_a_folder_that_uses_one_above(self):
        for file in ("libdynamics/include/dynamics/state/a.hpp", "libdynamics/src/joint/a.cpp"):
            self.refuses("includes", self.FORCE | {file: self.UP}, f"{file}:1", "may not include libdynamics/force, which is above it")
        self.refuses("includes", {"apps/scene/a.cpp": '#include "compile/compile.hpp"\n'}, "apps/scene may not include apps/compile")
        self.refuses("includes", {"apps/compile/a.cpp": '#include "froude/run.hpp"\n'}, "apps/compile may not include apps/froude")
        self.refuses("includes", {"tests/support/a.hpp": '#include "laws/b.hpp"\n'}, "tests/support may not include tests/laws")

    def test_refuses_a_private_header_of_a_folder_above(self):
        self.refuses("includes", {"libdynamics/src/line/a.cpp": '#include "integrate/cvode.hpp"\n', "libdynamics/src/integrate/cvode.hpp": "\n"},
                     "libdynamics/line may not include libdynamics/integrate")

    def test_refuses_a_harness_that_knows_a_case_and_cases_that_know_each_other(self):
        case = {"validation/hulme/case.hpp": "\n"}
        text = '#include "hulme/case.hpp"\n'
        self.refuses("includes", case | {"validation/harness/a.cpp": text}, "validation/harness may not include validation/hulme, which is above")
        self.refuses("includes", case | {"validation/stick/a.cpp": text}, "validation/stick may not include validation/hulme, which is beside it")
        self.accepts("includes", case | {"validation/cases.cpp": text})

    def test_refuses_a_room_that_uses_one_above(self):
        rooms = {"libhydro/src/potential/formats/a.hpp": "\n", "libhydro/src/potential/b.hpp": "\n"}
        self.accepts("includes", rooms | {"libhydro/src/potential/doctor/c.cpp": '#include "potential/formats/a.hpp"\n#include "potential/b.hpp"\n'})
        for room in ("potential", "potential/operations"):
            self.refuses("includes", rooms | {f"libhydro/src/{room}/c.cpp": '#include "potential/formats/a.hpp"\n'},
                         "may not include libhydro/potential/formats, which is above it")

    def test_refuses_a_folder_without_a_floor(self):
        self.refuses("includes", self.FORCE | {"libdynamics/src/new/a.cpp": self.UP}, "libdynamics/new has no floor")

    def test_names_the_shortest_circle(self):
        circle = {"libhydro/src/waves/a.cpp": '#include "hydro/potential/b.hpp"\n#include "hydro/signal/c.hpp"\n',
                  "libhydro/include/hydro/potential/b.hpp": '#include "hydro/signal/c.hpp"\n',
                  "libhydro/include/hydro/signal/c.hpp": '\n#include "hydro/waves/d.hpp"\n', "libhydro/include/hydro/waves/d.hpp": "\n"}
        self.refuses("includes", circle, "a circle: libhydro/signal → libhydro/waves at libhydro/include/hydro/signal/c.hpp:2, "
                                         "libhydro/waves → libhydro/signal at libhydro/src/waves/a.cpp:2")

    def test_refuses_libraries_that_use_each_other(self):
        self.refuses("includes", {"libhydro/src/waves/a.cpp": '#include "dynamics/state/b.hpp"\n',
                                  "libdynamics/include/dynamics/state/b.hpp": '#include "hydro/waves/c.hpp"\n',
                                  "libhydro/include/hydro/waves/c.hpp": "\n"}, "a circle: libdynamics/state → libhydro/waves")

    def test_refuses_targets_that_link_each_other(self):
        self.refuses("includes", {"apps/CMakeLists.txt": "add_library(commands STATIC)\ntarget_link_libraries(commands PRIVATE cases)\n",
                                  "validation/CMakeLists.txt": "add_library(cases STATIC) # a(b\ntarget_link_libraries(cases PUBLIC commands)\n"},
                     "apps/CMakeLists.txt:2: apps may not link cases of validation", "a circle: cases → commands at validation/CMakeLists.txt:2")

    def test_accepts_test_programs_that_link_the_product(self):
        self.accepts("includes", {"libhydro/CMakeLists.txt": "froude_library(hydro)\n",
                                  "tests/CMakeLists.txt": "froude_test(hydro SOURCES hydro_test.cpp LIBRARIES froude::hydro)\n"})
        self.refuses("includes", {"libhydro/CMakeLists.txt": "froude_library(hydro)\ntarget_link_libraries(froude_hydro PUBLIC support)\n",
                                  "tests/CMakeLists.txt": "add_library(support)\n"}, "libhydro may not link support of tests")

    def test_refuses_a_drawing_of_another_house(self):
        drawn = "".join(f"{part}  {' < '.join(floors)}\n" for part, floors in checks.FLOORS.items())
        self.accepts("includes", {"docs/design.md": drawn})
        self.refuses("includes", {"docs/design.md": drawn.replace("scene < include", "include < scene")}, "the floors of apps are not drawn")


class Links(ChecksCase):
    def test_accepts_links_to_files_of_the_repository(self):
        text = "[a](docs/a.md#part) [w](https://example.org) [h](#here) `[c](d)`\n```\n[x](y)\n```\n"
        self.accepts("links", {"README.md": text, "docs/a.md": "[up](../README.md)\n"})

    def test_refuses_a_link_to_nothing(self):
        self.refuses("links", {"README.md": "\n[a](docs/b.md)\n"}, "README.md:2", "docs/b.md")

    STABILITY = {"tests/stability/a_test.cpp": "TEST(Hard, Case) {}\nTEST_P(Hard, Kinds) {}\n"}

    def test_accepts_tests_that_are_there_and_all_named(self):
        rows = "[`Hard.Case`](../tests/stability/a_test.cpp)\n[`Hard.Kinds`](../tests/stability/a_test.cpp)\n"
        self.accepts("links", {"docs/stability.md": rows, **self.STABILITY})

    def test_refuses_a_test_that_is_not_there(self):
        rows = "[`Hard.Case`](../tests/stability/a_test.cpp)\n[`Hard.Kind`](../tests/stability/a_test.cpp)\n"
        self.refuses("links", {"docs/stability.md": rows, **self.STABILITY}, "docs/stability.md:2", "Hard.Kind")

    def test_refuses_a_hard_case_that_no_row_names(self):
        rows = "[`Hard.Case`](../tests/stability/a_test.cpp)\n"
        self.refuses("links", {"docs/stability.md": rows, **self.STABILITY}, "docs/stability.md:1", "Hard.Kinds")

    def test_refuses_a_link_out_of_the_repository(self):
        self.refuses("links", {"README.md": "[a](../../etc)\n"}, "../../etc")


class Quotes(ChecksCase):
    FILE = {"a.cpp": "int a;\nint b;\nint c;\n"}

    def test_accepts_a_quote_of_whole_lines(self):
        self.accepts("quotes", self.FILE | {"README.md": "<!-- file: a.cpp -->\n```cpp\nint b;\nint c;\n```\n"})

    def test_refuses_a_quote_that_went_stale(self):
        self.refuses("quotes", self.FILE | {"README.md": "x\n<!-- file: a.cpp -->\n```cpp\nint a;\nint c;\n```\n"}, "README.md:2", "differs")
        self.refuses("quotes", self.FILE | {"README.md": "<!-- file: b.cpp -->\n```cpp\nint a;\n```\n"}, "no file b.cpp")


class Extending(ChecksCase):
    def page(self, **changed):
        steps = {"Interface": "[`Kind`](../../a.hpp)", "Files (1)": "[the law](../../a.hpp)", "Listed in": "-", "Links": "-", "Tests": "-", "Entry": "-"}
        steps.update(changed)
        table = "".join(f"| {step} | {what} |\n" for step, what in steps.items())
        return "".join(f"## {point}\n| | |\n|---|---|\n{table}" for point in checks.EXTENSION_POINTS)

    def test_accepts_names_that_stand_where_they_are_said_to(self):
        self.accepts("extending", {"docs/guide/extending.md": self.page(), "a.hpp": "class Kind {};\n"})

    def test_refuses_a_name_that_is_not_there(self):
        self.refuses("extending", {"docs/guide/extending.md": self.page(), "a.hpp": "class Kinds {};\n"}, "docs/guide/extending.md:4", "no Kind")

    def test_refuses_a_file_that_is_not_there(self):
        self.refuses("extending", {"docs/guide/extending.md": self.page()}, "../../a.hpp is not there")

    def test_refuses_another_number_of_files_than_is_said(self):
        page = self.page().replace("Files (1)", "Files (2)")
        self.refuses("extending", {"docs/guide/extending.md": page, "a.hpp": "class Kind {};\n"}, "1 files are named where 2 are told of")

    def test_refuses_a_point_without_its_steps(self):
        page = self.page().replace("| Tests | - |\n", "", 1)
        self.refuses("extending", {"docs/guide/extending.md": page, "a.hpp": "class Kind {};\n"}, "A force element", "does not have the steps")


class Examples(ChecksCase):
    SECTION = ("# Examples\n\n### [a.toml](../examples/a.toml)\n\nWhat?\n\n    froude run examples/a.toml --picture a.svg\n\nTakes 3 s.\n\n"
               "![a](pictures/examples/a.png)\n")
    FILES = {"docs/examples.md": SECTION, "examples/a.toml": "schema = 1\n", "examples/fit/make_a.py": "pass\n"}

    def test_accept_an_index_that_has_all(self):
        self.accepts("examples", self.FILES)

    def test_refuse_one_that_lacks_an_example(self):
        for name in ("examples/sweep/b.toml", "examples/c.py", "examples/library/d.cpp"):
            with self.subTest(name=name):
                self.refuses("examples", self.FILES | {name: "\n"}, "docs/examples.md:1", f"{name} is missing")

    def test_refuse_a_section_that_lacks_something(self):
        for old, new, word in (("examples/a.toml --", "examples/ab.toml --", "a command"), ("Takes 3 s.", "Takes ? s.", "its time"),
                               ("![a](pictures/examples/", "[a](pictures/examples/", "a picture"), ("### [a.toml]", "### [b.toml]", "leads to a.toml")):
            with self.subTest(word=word):
                self.refuses("examples", self.FILES | {"docs/examples.md": self.SECTION.replace(old, new)}, "docs/examples.md:3", word)

    def test_refuse_help_that_names_none(self):
        written = '"froude cost examples/a.toml -o examples/b.toml"\n'
        self.accepts("examples", self.FILES | {"apps/help.cpp": written})
        self.refuses("examples", self.FILES | {"apps/help.cpp": written + '"froude run examples/c.toml"\n'}, "apps/help.cpp:2", "no example")


class Words(ChecksCase):
    def test_refuses_strangers_with_file_line_and_term(self):
        for path, line, term in (
                ("libdynamics/src/a.cpp", "PrescribedMotion lead; Lead l;", "prescribed motion"),
                ("examples/a.toml", 'lead = { amplitude = "1 m", period = "2 s" }', "prescribed motion"),
                ("docs/guide/a.md", "Nodes that are led follow a path.", "prescribed motion"),
                ("libdynamics/src/a.cpp", "std::vector<PointCondition> conditions_;", "constraint"),
                ("docs/theory/dynamics.md", "One condition more.", "constraint"),
                ("docs/design.md", "the conditions of joints", "constraint"),
                ("apps/compile/a.cpp", 'signal("rack.travel")', "joint coordinate"),
                ("tests/apps/a.cpp", r'"length = 1\npulls_only = true\n"', "tension-only"),
                ("docs/guide/a.md", "a line that keeps its length", "inextensible"),
                ("examples/a.toml", "sags = true", "catenary segment"),
                ("libdynamics/src/a.cpp", "friction->strain(i, load)", "utilisation"),
                ("libhydro/src/a.cpp", "past->decided(1)", "history force"),
                ("libfit/src/a.cpp", "// the water remembers nothing", "radiation memory"),
                ("docs/guide/a.md", "froude bem convert a.1 --carry", "translated coefficients"),
                ("apps/froude/a.cpp", '"energy that does not add up"', "energy residual"),
                ("README.md", "`froude section run.h5`", "Poincaré section"),
                ("apps/froude/a.cpp", '"friction or contacts change {} times"', "stick–slip events"),
                ("libdynamics/src/a.cpp", "class Companion {", "perturbed trajectory"),
                ("apps/scene/a.cpp", '"has no part in a fit"', "does not apply to")):
            with self.subTest(line=line):
                self.refuses("words", {path: "\n" + line + "\n"}, f"{path}:2", f'"{term}"')

    def test_leaves_the_same_words_alone_in_other_senses(self):
        self.accepts("words", {
            "libhydro/src/waves/a.cpp": "// how fast crests travel, on the condition that the bed is level; sections of a file\n",
            "libdynamics/src/a.cpp": "// 1e-9: condition number of some 1e4; axial strain(connector, state); the step that led to it\n"
                                     "// what leads to rest; the sag of a line; ends that meet; a heavy body; condition below 1e3\n",
            "docs/theory/waves.md": "phase leads the wave; steepness H/λ; a continued fraction; the profile is continued upwards\n",
            "docs/theory/dynamics.md": "rows of internal loads add up to zero\n",
            "tests/dynamics/frequency/a_test.cpp": "Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();\n",
            "validation/a/reference/SOURCE.md": "a heave that does not add up, of a led joint\n",
            "tests/docs/checks.py": "pulls_only\n"})

    def test_refuses_a_glossary_that_lacks_a_term(self):
        self.refuses("words", {"docs/glossary.md": "| **utilisation** | of friction |\n"}, "docs/glossary.md:1", '"constraint" is missing')


if __name__ == "__main__":
    unittest.main()
