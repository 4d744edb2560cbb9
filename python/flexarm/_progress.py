"""The line that long calls show of their progress."""

import os
import sys
import time

_QUIET_FOR_S = 1.0
_INTERVAL_S = 0.1


def _in_notebook():
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    return shell is not None and hasattr(shell, "kernel")


def _is_watched():
    stream = sys.stderr
    if stream is None:
        return False
    # A terminal of the kind "dumb", or of none, cannot rewrite a line.
    is_rewritable = stream.isatty() and os.environ.get("TERM", "") not in ("", "dumb")
    return is_rewritable or _in_notebook()


class ProgressLine:
    """A line on standard error, rewritten while work goes on and wiped when it ends."""

    def __init__(self, what):
        self._what = what
        self._next = time.monotonic() + _QUIET_FOR_S
        self._width = 0

    def __call__(self, fraction, left):
        """`left` is a text, "8 s left", or empty."""
        now = time.monotonic()
        if now < self._next:
            return
        self._next = now + _INTERVAL_S
        self._write(f"{self._what}  {100.0 * fraction:.0f} %" + (f", {left}" if left else ""))

    def close(self):
        if self._width:
            self._write("")
            self._width = 0
            self._write("")

    def _write(self, text):
        try:
            sys.stderr.write("\r" + text.ljust(self._width))
            sys.stderr.flush()
        except (OSError, ValueError):
            pass  # a terminal that has gone away is no reason to stop the work
        self._width = len(text)


def line_of(what):
    """A ProgressLine where somebody sees it: on a terminal or in a notebook; else None."""
    return ProgressLine(what) if _is_watched() else None
