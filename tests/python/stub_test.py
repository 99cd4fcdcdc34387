"""restlab.pyi says what the module has, no less and no more."""

import ast
import pathlib
import re

import restlab

STUB = pathlib.Path(restlab.__file__).with_name("restlab.pyi")
TREE = ast.parse(STUB.read_text())


def declared(body):
    """Functions, classes and annotated names of a module or class."""
    names = {}
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            names[node.name] = node
        elif isinstance(node, ast.AnnAssign):
            names[node.target.id] = node
    return names


def public(of):
    return {name for name in dir(of) if not name.startswith("_")}


def arguments(node):
    """Names of arguments with fixed names; whether there are others."""
    args = [arg.arg for arg in node.args.args + node.args.kwonlyargs if arg.arg != "self"]
    return args, node.args.kwarg is not None


def said(function):
    """The same of a function of the module, from the signature that pybind11 writes."""
    signature = function.__doc__.splitlines()[0]
    names = re.findall(r"[(,] ?(\w+): ", re.sub(r"\[[^][]*\]", "", signature))
    return [name for name in names if name != "self"], "**kwargs" in signature


def test_every_name_is_in_the_stub():
    names = declared(TREE.body)
    assert public(restlab) == {name for name in names if not name.startswith("_")}
    assert {"__version__"} <= set(names)
    for name, node in names.items():
        if isinstance(node, ast.ClassDef) and name != "Error":
            members = {m for m in declared(node.body) if not m.startswith("_")}
            assert public(getattr(restlab, name)) == members, name


def test_arguments_are_those_of_the_module():
    names = declared(TREE.body)
    pairs = [(name, getattr(restlab, name), node) for name, node in names.items()]
    for owner in ("Session", "Reference"):
        for name, node in declared(names[owner].body).items():
            pairs.append((name, getattr(getattr(restlab, owner), name), node))
    compared = 0
    for name, function, node in pairs:
        if not isinstance(node, ast.FunctionDef) or isinstance(function, property):
            continue
        own, more = said(function)
        args, keywords = arguments(node)
        assert more or not keywords, name
        if more:
            args = args[: len(own)]  # others are keywords that the function looks up itself
        assert own == args, name
        compared += 1
    assert compared > 25


def test_every_keyword_of_a_session_is_a_setting():
    keywords, _ = arguments(declared(declared(TREE.body)["Session"].body)["__init__"])
    session = restlab.Session("furnace", width=4, height=4, threads=1)
    others = {"scene", "camera", "environment", "environment_rotation", "environment_scale", "device",
              "ray_tracing", "validate"}  # fmt: skip
    assert set(keywords) == set(session.settings) | others
