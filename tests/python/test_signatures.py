"""help() and inspect.signature show every argument; the stub has the same arguments and defaults."""

import ast
import inspect
import pathlib
import pydoc
import re
import unittest

import flexarm
from flexarm import _flexarm

STUB = pathlib.Path(flexarm.__file__).parent / "_flexarm.pyi"
TREE = ast.parse(STUB.read_text())


def public(names):
    return {name for name in names if not name.startswith("_")}


def callables():
    """Name and object of every public function, constructor and method."""
    for name in sorted(public(vars(_flexarm))):
        one = getattr(flexarm, name)
        if not inspect.isclass(one):
            yield name, one
            continue
        if issubclass(one, BaseException):
            continue
        if one.__init__ is not object.__init__ and constructs(one):
            yield name, one
        for member in sorted(public(vars(one))):
            if callable(getattr(one, member)):
                yield f"{name}.{member}", getattr(one, member)


def constructs(kind):
    """Whether users make objects of it; results have no constructor."""
    try:
        kind(**{"no such argument": 0})
    except TypeError as error:
        return "No constructor defined" not in str(error)
    except ValueError:
        return True
    return True


def arguments_of(signature):
    return [one for one in signature.parameters.values() if one.name != "self"]


class Signatures(unittest.TestCase):
    def test_every_function_constructor_and_method_has_one(self):
        found = dict(callables())
        self.assertIn("diagnose", found)
        self.assertIn("Measurement", found)
        self.assertIn("StateSpace.zeros", found)
        for name, one in found.items():
            with self.subTest(name):
                inspect.signature(one)

    def test_they_are_those_of_the_calls(self):
        signature = inspect.signature(flexarm.diagnose)
        self.assertEqual(signature.parameters["time_limit_s"].default, None)
        self.assertEqual(signature.parameters["effects"].kind, inspect.Parameter.KEYWORD_ONLY)
        self.assertEqual(inspect.signature(flexarm.simulate).parameters["seed"].default, 1)
        self.assertIn("beam_length_m", inspect.signature(flexarm.Arm).parameters)
        self.assertIn("hub_angle_rad", inspect.signature(flexarm.TimeRun).parameters)
        self.assertIs(inspect.signature(flexarm.FiniteElements).parameters["elements"].default, None)
        self.assertEqual(str(inspect.signature(flexarm.ExactTransferFunction(flexarm.Arm.paper()).poles)),
                         "(count=5)")

    def test_help_has_every_argument_with_what_it_is(self):
        for name, one in callables():
            text = inspect.getdoc(one) or ""
            if inspect.isclass(one):
                text += inspect.getdoc(one.__init__) or ""
            listed = dict(re.findall(r"^ +((?:\w+, )*\**\w+): (.*)$", text, re.MULTILINE))
            described = {word.strip("*"): line for words, line in listed.items()
                         for word in words.split(", ")}
            columns = described.get("columns", "")
            for argument in arguments_of(inspect.signature(one)):
                with self.subTest(f"{name}({argument.name})"):
                    self.assertTrue(argument.name in described or argument.name in columns
                                    or (columns and argument.default is None), text)
                    unit = re.search(r"_(kg_m2|kg|N_m|Hz|m|s|percent|Pa|rad)$", argument.name)
                    if unit and argument.name in described:
                        self.assertRegex(described[argument.name], r"\[[^]]+\]")

    def test_help_shows_the_signature(self):
        text = pydoc.plain(pydoc.render_doc(flexarm.diagnose))
        self.assertIn("diagnose(measurement, *, effects=[], ", text)
        self.assertIn("time_limit_s: time after which the search ends [s]", text)


class Stub(unittest.TestCase):
    """No name, argument or default of the stub is another than that of the extension."""

    def compare(self, name, node, signature):
        theirs = []
        given = node.args
        positional = given.posonlyargs + given.args
        defaults = [None] * (len(positional) - len(given.defaults)) + given.defaults
        for kind, arguments, values in (
            ("positional", positional, defaults), ("keyword", given.kwonlyargs, given.kw_defaults),
        ):
            for argument, value in zip(arguments, values):
                if argument.arg != "self":
                    theirs.append((argument.arg, kind, "" if value is None else ast.unparse(value)))
        if given.kwarg:
            theirs.append((given.kwarg.arg, "rest", ""))
        kinds = {inspect.Parameter.KEYWORD_ONLY: "keyword", inspect.Parameter.VAR_KEYWORD: "rest"}
        ours = [(one.name, kinds.get(one.kind, "positional"),
                 "" if one.default is one.empty else repr(one.default))
                for one in arguments_of(signature)]
        self.assertEqual(theirs, ours, name)

    def test_functions(self):
        stubs = {node.name: node for node in TREE.body if isinstance(node, ast.FunctionDef)}
        functions = {name: one for name, one in callables()
                     if "." not in name and not inspect.isclass(one)}
        self.assertEqual(set(stubs), set(functions))
        for name, node in stubs.items():
            self.compare(name, node, inspect.signature(functions[name]))

    def test_methods_and_constructors(self):
        stubs = {}
        for kind in (node for node in TREE.body if isinstance(node, ast.ClassDef)):
            for node in (one for one in kind.body if isinstance(one, ast.FunctionDef)):
                decorators = [ast.unparse(one) for one in node.decorator_list]
                name = kind.name if node.name == "__init__" else f"{kind.name}.{node.name}"
                is_public = node.name == "__init__" or not node.name.startswith("_")
                if is_public and "property" not in decorators:
                    stubs[name] = node  # of overloads the last one
        found = {name: one for name, one in callables() if "." in name or inspect.isclass(one)}
        self.assertEqual(set(stubs), set(found))
        for name, node in stubs.items():
            self.compare(name, node, inspect.signature(found[name]))


if __name__ == "__main__":
    unittest.main()
