"""Tables of a campaign file, read strictly: each key has a rule, an unknown key is refused."""

import difflib
import math

from .errors import CampaignError

_MISSING = object()


def _shown(value):
    """A value as it stands in the file, short."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        text = '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    elif isinstance(value, dict):
        text = "{ " + ", ".join(f"{key} = {_shown(one)}" for key, one in value.items()) + " }"
    elif isinstance(value, list):
        text = "[" + ", ".join(_shown(one) for one in value) + "]"
    else:
        text = str(value)
    return text if len(text) <= 60 else text[:57] + "..."


def printable(text):
    """Without what a terminal would obey."""
    return "".join(letter if letter.isprintable() else "?" for letter in text)


def suggestion(word, allowed):
    """` (did you mean X?)`, or nothing."""
    near = difflib.get_close_matches(word, allowed, n=1, cutoff=0.6)
    return f" (did you mean {near[0]}?)" if near else ""


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


class Table:
    """A table of `file`; `prefix` is its name and a point, empty for the file itself.

    Each method takes a key out by its rule. `end` refuses what no rule has taken.
    """

    def __init__(self, file, data, prefix=""):
        self.file = file
        self._data = data
        self._prefix = prefix
        self._known = []

    def fail(self, key, what):
        """Raises the line `FILE: KEY = VALUE: what is allowed`."""
        name = self._prefix + key
        value = self._data.get(key, _MISSING)
        stands = "" if value is _MISSING else f" = {_shown(value)}"
        raise CampaignError(printable(f"{self.file}: {name}{stands}: {what}"))

    def _take(self, key, default, is_allowed, allowed):
        self._known.append(key)
        value = self._data.get(key, _MISSING)
        if value is _MISSING:
            if default is _MISSING:
                self.fail(key, f"missing; {allowed}")
            return default
        if not is_allowed(value):
            self.fail(key, allowed)
        return value

    def text(self, key, default=_MISSING):
        return self._take(
            key, default, lambda value: isinstance(value, str) and value != "", "must be a text"
        )

    def choice(self, key, allowed, default=_MISSING):
        value = self.text(key, default)
        if value not in allowed:
            self.fail(key, f"must be one of {', '.join(allowed)}{suggestion(value, allowed)}")
        return value

    def flag(self, key, default=_MISSING):
        return self._take(
            key, default, lambda value: isinstance(value, bool), "must be true or false"
        )

    def whole(self, key, lowest, highest, default=_MISSING):
        return self._take(
            key,
            default,
            lambda value: isinstance(value, int)
            and not isinstance(value, bool)
            and lowest <= value <= highest,
            f"must be a whole number from {lowest} to {highest}",
        )

    def number(self, key, default=_MISSING, above=-math.inf):
        allowed = "must be a finite number" + (f" above {above:g}" if above > -math.inf else "")
        return self._take(
            key, default, lambda value: is_number(value) and value > above, allowed
        )

    def numbers(self, key, default=_MISSING):
        return self._take(
            key,
            default,
            lambda value: isinstance(value, list) and value and all(map(is_number, value)),
            "must be a list of finite numbers",
        )

    def texts(self, key, default=_MISSING):
        return self._take(
            key,
            default,
            lambda value: isinstance(value, list)
            and value
            and all(isinstance(one, str) and one for one in value)
            and len(set(value)) == len(value),
            "must be a list of texts, none twice",
        )

    def counts(self, key, highest, default=_MISSING):
        """A table of whole numbers from 1 to `highest`."""
        return self._take(
            key,
            default,
            lambda value: isinstance(value, dict)
            and all(type(one) is int and 1 <= one <= highest for one in value.values()),
            f"must be a table of whole numbers from 1 to {highest}, {{ hub_angle = 2 }}",
        )

    def has(self, key):
        return key in self._data

    def table(self, key, default=_MISSING):
        data = self._take(
            key, default, lambda value: isinstance(value, dict), "must be a table"
        )
        return Table(self.file, data, f"{self._prefix}{key}.")

    def tables(self, key):
        """An array of tables, one at least."""
        data = self._take(
            key,
            _MISSING,
            lambda value: isinstance(value, list)
            and value
            and all(isinstance(one, dict) for one in value),
            f"must be tables, [[{self._prefix}{key}]]",
        )
        return [
            Table(self.file, one, f"{self._prefix}{key}[{number}].")
            for number, one in enumerate(data, 1)
        ]

    def end(self):
        for key in self._data:
            if key not in self._known:
                table = f"[{self._prefix[:-1]}]" if self._prefix else "the file"
                self.fail(
                    key,
                    f"unknown key{suggestion(key, self._known)};"
                    f" allowed in {table}: {', '.join(self._known)}",
                )
