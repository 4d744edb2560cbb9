"""Methods of the extension's classes that are written in Python."""

import importlib
import json

from . import _flexarm


def method(name, *kinds):
    """Makes a function the method `name` of the classes, with its docstring."""

    def add(function):
        function.__name__ = function.__qualname__ = name
        for kind in kinds:
            setattr(kind, name, function)
        return function

    return add


def imported(module, method, package):
    """An optional package, imported when a method that needs it is called."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError(f"{method} needs {package}, which is not installed") from error


@method("to_dict", _flexarm.Identification, _flexarm.Diagnosis, _flexarm.Plan)
def to_dict(self):
    """What to_json() has, as a dict (docs/json.md)."""
    return json.loads(self.to_json())
