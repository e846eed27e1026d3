"""The stub says what the module has: names, arguments, defaults."""

import ast
import inspect
import pathlib
import re

import fam
from conftest import project

STUB = ast.parse((project / "python/fam.pyi").read_text())


def public(name):
    return not name.startswith("_") or name == "__version__"


def names_of(body):
    names = {node.name: node for node in body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
    names.update({node.target.id: node for node in body if isinstance(node, ast.AnnAssign)})
    return {name: node for name, node in names.items() if public(name)}


def signature_of(function):
    arguments = function.args.args
    shown = [argument.arg for argument in arguments if argument.arg != "self"]
    for place, default in enumerate(reversed(function.args.defaults), 1):
        shown[-place] += "=" + ast.unparse(default)
    return ", ".join(shown)


def test_stands_beside_the_module():
    beside = pathlib.Path(fam.__file__).with_name("fam.pyi")
    assert beside.read_text() == (project / "python/fam.pyi").read_text()


def test_names_of_the_module():
    assert set(names_of(STUB.body)) == {name for name in dir(fam) if public(name)}


def test_names_of_the_classes():
    classes = [node for node in STUB.body if isinstance(node, ast.ClassDef) and node.name != "SceneError"]
    assert len(classes) == 6
    for stub in classes:
        here = getattr(fam, stub.name)
        names = names_of(stub.body)
        assert set(names) == {name for name in dir(here) if public(name)}, stub.name
        for name, node in names.items():
            is_property = any(ast.unparse(decorator) == "property" for decorator in node.decorator_list)
            assert isinstance(getattr(here, name), property) == is_property, name


def test_arguments_are_those_of_the_docstrings():
    """The docstring of each function begins with its call; methods without defaults take their arguments by name."""
    functions = [(fam, node) for node in STUB.body if isinstance(node, ast.FunctionDef)]
    for stub in STUB.body:
        if isinstance(stub, ast.ClassDef) and stub.name != "SceneError":
            functions += [(getattr(fam, stub.name), node) for node in stub.body
                          if isinstance(node, ast.FunctionDef) and not node.decorator_list and public(node.name)]
    assert len(functions) > 25
    for owner, node in functions:
        first = inspect.getdoc(getattr(owner, node.name)).split("\n")[0]
        assert re.match(r"(\w+)\((.*?)\)", first).groups() == (node.name, signature_of(node).replace('"', "'")), first


def test_everything_has_words():
    assert inspect.getdoc(fam)
    for name in dir(fam):
        if public(name) and name != "__version__":
            thing = getattr(fam, name)
            assert inspect.getdoc(thing), name
            for member in vars(thing) if inspect.isclass(thing) else ():
                if public(member):
                    assert inspect.getdoc(getattr(thing, member)), member


def test_version_is_the_projects():
    version = re.search(r"project\(\S+ VERSION (\S+)", (project / "CMakeLists.txt").read_text()).group(1)
    assert fam.__version__ == version
