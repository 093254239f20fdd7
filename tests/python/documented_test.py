"""Everything public has a docstring, and a stub that agrees with it."""
import ast
import inspect
import pathlib
import re

import pytest

import froude
from froude import _froude

stub = ast.parse((pathlib.Path(froude.__file__).parent / "_froude.pyi").read_text())
FUNCTIONS = {node.name: node for node in stub.body if isinstance(node, ast.FunctionDef)}
CLASSES = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}


def names_of(function):
    return [one.arg for one in function.args.args if one.arg != "self"]


def arguments_of(documented):
    """Names in the first line that pybind11 writes of a function."""
    line = documented.__doc__.splitlines()[0]
    inside = line[line.index("(") + 1:line.rindex(") ->")]
    return [name for name in re.findall(r"(\w+): ", re.sub(r"\[[^][]*\]", "", re.sub(r"\[[^][]*\]", "", inside)))
            if name != "self"]


@pytest.mark.parametrize("name", froude.__all__)
def test_public_names_have_docstrings(name):
    one = getattr(froude, name)
    if name == "__version__":
        return
    assert inspect.getdoc(one) and len(inspect.getdoc(one)) > 20
    if inspect.isfunction(one):
        for parameter in inspect.signature(one).parameters:
            assert re.search(rf"\b{parameter}\b", one.__doc__), parameter
        assert "Raises" in one.__doc__ and "Returns" in one.__doc__
    if inspect.isclass(one) and not issubclass(one, Exception):
        for member, value in vars(one).items():
            if not member.startswith("_"):
                assert value.__doc__, f"{name}.{member}"


def test_the_stub_has_what_the_module_has():
    public = {name for name in vars(_froude) if not name.startswith("_")}
    assert public == FUNCTIONS.keys() | CLASSES.keys()


@pytest.mark.parametrize("name", sorted(CLASSES))
def test_stubs_of_classes_agree(name):
    written = {node.name: node for node in CLASSES[name].body if isinstance(node, ast.FunctionDef)}
    there = {member: value for member, value in vars(getattr(_froude, name)).items()
             if not member.startswith("_") or member in ("__getitem__", "__contains__", "__call__")}
    if issubclass(getattr(_froude, name), Exception):
        return
    assert there.keys() == written.keys()
    for member, node in written.items():
        is_property = any(getattr(one, "id", "") == "property" for one in node.decorator_list)
        assert isinstance(there[member], property) == is_property, member


@pytest.mark.parametrize("name", sorted(FUNCTIONS))
def test_stubs_of_functions_agree(name):
    assert arguments_of(getattr(_froude, name)) == names_of(FUNCTIONS[name])
