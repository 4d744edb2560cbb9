"""The identity of what computes: version, extension module and the sources of a kind."""

import functools
import hashlib
import pathlib

import flexarm
from flexarm import _flexarm


@functools.cache
def program_digest(kind):
    """SHA-256 over version, bytes of the extension and of the module of `kind`."""
    whole = hashlib.sha256(flexarm.__version__.encode())
    for file in (_flexarm.__file__, kind.__file__):
        with open(file, "rb") as stream:
            whole.update(hashlib.file_digest(stream, "sha256").digest())
    return whole.hexdigest()


def shown_program(digest):
    return f"{flexarm.__version__}, {digest[:12]}"


def sources_of(path):
    """The files that the TOML file `path` names, with itself, in order: each text that is the name
    of a file relative to its folder, and what those of TOML name."""
    import tomllib

    found, waiting = [], [pathlib.Path(path)]
    while waiting:
        file = waiting.pop(0)
        if file in found:
            continue
        found.append(file)
        if file.suffix != ".toml":
            continue
        try:
            values = [tomllib.loads(file.read_text(encoding="utf-8"))]
        except (OSError, ValueError):
            continue  # the task itself says what is wrong with the file
        while values:
            value = values.pop(0)
            if isinstance(value, dict):
                values += value.values()
            elif isinstance(value, list):
                values += value
            elif isinstance(value, str) and 0 < len(value) < 4096 and "\0" not in value:
                named = file.parent / value
                try:
                    if named.is_file():
                        waiting.append(named)
                except OSError:
                    pass  # too long a name is no name of a file
    return found
