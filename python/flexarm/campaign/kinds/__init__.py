"""Kinds of campaigns, a module each. A further kind is a further module.

A kind has four functions:

    expand(table, folder)   the tasks of its table of the campaign file (`tables.Table`): an object
                            with a length, whose iteration gives JSON-able inputs, each time the
                            same
    run(task, folder)       the JSON-able result of one input. It runs in a worker. An exception
                            makes the task a failed one, with the text of the exception
    columns(tasks)          names of the columns of the merged table, in order
    row(task, result)       a dict from such names to texts, numbers or None. `result` is None where
                            the task has none: then what follows from the input

Optional:

    files(task, folder)     paths of the files that `run` reads; their bytes are part of the hash
    finish(pairs, folder, out)   called when the tables are written, with (input, result or None) of
                            each task; it may write further files to the folder `out`
    WORST                   a column: the summary page lists the tasks with its largest numbers
    FLAGGED                 (column, texts): the page lists the tasks that have one of these texts
    TALLY                   a column: the page counts its texts

Relative paths are relative to `folder`, that of the campaign file. A kind of one's own is a module
that Python finds, named with its points: `kind = "my_lab.my_kind"`, with the table `[my_kind]`.
"""

import importlib
import importlib.util
import pkgutil


def names():
    """The kinds that flexarm has."""
    return sorted(one.name for one in pkgutil.iter_modules(__path__))


def find(name):
    """The module of a kind, or None."""
    if "." not in name:
        return importlib.import_module(f"{__name__}.{name}") if name in names() else None
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name and (name == error.name or name.startswith(error.name + ".")):
            return None
        raise
