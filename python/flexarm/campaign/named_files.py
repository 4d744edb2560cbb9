"""The files that a task reads, found by their names in its first file."""

import pathlib
import tomllib

_LONGEST_NAME = 4096


def _texts_in(value):
    waiting = [value]
    while waiting:
        value = waiting.pop()
        if isinstance(value, dict):
            waiting += value.values()
        elif isinstance(value, list):
            waiting += value
        elif isinstance(value, str):
            yield value


def _is_file(path):
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False  # a text that cannot be a name


def named_files(path):
    """`path`, and each file that a text of it names, relative to its folder; of TOML files among
    them likewise. So a measurement has its arm, its runs and their controllers. Sorted paths."""
    found, waiting = set(), [pathlib.Path(path)]
    while waiting:
        file = waiting.pop()
        if file in found:
            continue
        found.add(file)
        if file.suffix != ".toml":
            continue
        try:
            data = tomllib.loads(file.read_text(encoding="utf-8"))
        except (OSError, ValueError, RecursionError):
            continue  # the task says what is wrong with it
        for text in _texts_in(data):
            if 0 < len(text) <= _LONGEST_NAME and _is_file(file.parent / text):
                waiting.append(file.parent / text)
    return sorted(found)
