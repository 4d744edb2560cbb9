"""What a worker does: tasks, a file of each, and a line of what became of it."""

import dataclasses
import functools
import os
import pathlib
import socket
import time

import distributed

from . import kinds
from .program import program_digest, shown_program
from .task_files import Attempts, is_run, result_path, write_result

MOST_DEATHS = 3


@dataclasses.dataclass(frozen=True)
class Shared:
    """What all orders of a campaign share. It is sent with each and is small."""

    kind: str
    folder: str  # of the campaign file
    out: str
    run: str
    generation: int
    program: str


@functools.cache
def _kind(name):
    return kinds.find(name)


def why_unfit(shared):
    """Why this process cannot run tasks of the campaign; None where it can.

    A worker that cannot is quicker than those that can: it would fail most of the tasks.
    """
    host = socket.gethostname()
    kind = _kind(shared.kind)
    if kind is None:
        return f"{host}: has no kind of campaign {shared.kind}"
    own = program_digest(kind)
    if own != shared.program:
        return (
            f"{host}: another flexarm ({shown_program(own)};"
            f" the campaign has {shown_program(shared.program)})"
        )
    for folder in (shared.folder, shared.out):
        if not os.path.isdir(folder):
            return f"{host}: {folder}: no such folder"
    if not is_run(shared.out, shared.run):
        return f"{host}: {shared.out}: is another folder than the campaign's of this name"
    if not os.access(os.path.join(shared.out, "tasks"), os.W_OK):
        return f"{host}: {shared.out}: cannot be written"
    return None


def run_order(shared, tasks):
    """Runs tasks, (digest, input) each, one after the other; what `run_task` returns of each.

    A worker that is not fit returns (its address, why), and runs none.
    """
    unfit = why_unfit(shared)
    if unfit is not None:
        return distributed.get_worker().address, unfit
    return [run_task(shared, digest, task) for digest, task in tasks]


def run_task(shared, digest, task):
    """Runs a task and writes its file.

    Returns (state, seconds, message). The state is `done`, `failed`: the task raised, or
    `gave up`: it has ended three workers.
    """
    begun = time.monotonic()

    def ended(state, message=""):
        return state, time.monotonic() - begun, message

    if os.path.exists(result_path(shared.out, digest)):
        # A worker ended between its file and its answer, or under a scheduler that died.
        return ended("done")
    attempts = Attempts(shared.out, digest, shared.run, shared.generation)
    try:
        deaths = attempts.begin()
        if deaths >= MOST_DEATHS:
            attempts.end()
            return ended("gave up", f"{deaths} workers died while they ran it")
        kind = _kind(shared.kind)
        write_result(shared.out, digest, task, kind.run(task, pathlib.Path(shared.folder)))
    except Exception as error:
        attempts.end()
        text = str(error).split("\n")[0] or type(error).__name__
        return ended("failed", text)
    attempts.end()
    return ended("done")
