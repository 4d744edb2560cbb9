"""The line that long calls show of their progress."""

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
    return stream.isatty() or _in_notebook()


class ProgressLine:
    """A line on standard error, rewritten while work goes on and wiped when it ends."""

    def __init__(self, what):
        self._what = what
        self._began = time.monotonic()
        self._next = self._began + _QUIET_FOR_S
        self._width = 0

    def __call__(self, fraction):
        now = time.monotonic()
        if now < self._next:
            return
        self._next = now + _INTERVAL_S
        text = f"{self._what}  {100.0 * fraction:.0f} %"
        if fraction > 0.05:
            left_s = (now - self._began) * (1.0 - fraction) / fraction
            text += f", {left_s:.0f} s left"
        self._write(text)

    def close(self):
        if self._width:
            self._write("")
            sys.stderr.write("\r")
            sys.stderr.flush()

    def _write(self, text):
        sys.stderr.write("\r" + text.ljust(self._width))
        sys.stderr.flush()
        self._width = len(text)


def line_of(what):
    """A ProgressLine where somebody sees it: on a terminal or in a notebook; else None."""
    return ProgressLine(what) if _is_watched() else None
