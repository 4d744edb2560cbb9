"""What a worker does: one task, its file, and a line of what became of it."""

import dataclasses
import functools
import os
import pathlib
import socket
import time

from . import kinds
from .program import program_digest, shown_program
from .task_files import Attempts, result_path, write_result

MOST_DEATHS = 3


@dataclasses.dataclass(frozen=True)
class Order:
    """What all tasks of a campaign share. It is sent with each task and is small."""

    kind: str
    folder: str  # of the campaign file
    out: str
    run: str
    generation: int
    program: str


@functools.cache
def _kind(name):
    return kinds.find(name)


def run_task(order, digest, task):
    """Runs a task and writes its file.

    Returns (state, seconds, message). The state is `done`, `failed`: the task raised, or
    `gave up`: it has ended three workers.
    """
    begun = time.monotonic()

    def ended(state, message=""):
        return state, time.monotonic() - begun, message

    kind = _kind(order.kind)
    if kind is None:
        return ended("failed", f"{socket.gethostname()}: has no kind of campaign {order.kind}")
    own = program_digest(kind)
    if own != order.program:
        return ended(
            "failed",
            f"{socket.gethostname()}: another flexarm ({shown_program(own)};"
            f" the campaign has {shown_program(order.program)})",
        )
    if not pathlib.Path(order.out).is_dir():
        return ended("failed", f"{socket.gethostname()}: {order.out}: no such folder")
    if os.path.exists(result_path(order.out, digest)):
        # A worker ended between its file and its answer, or under a scheduler that died.
        return ended("done")
    attempts = Attempts(order.out, digest, order.run, order.generation)
    deaths = attempts.begin()
    if deaths >= MOST_DEATHS:
        attempts.end()
        return ended("gave up", f"{deaths} workers died while they ran it")
    try:
        write_result(order.out, digest, task, kind.run(task, pathlib.Path(order.folder)))
    except Exception as error:
        attempts.end()
        text = str(error).split("\n")[0] or type(error).__name__
        return ended("failed", text)
    attempts.end()
    return ended("done")
