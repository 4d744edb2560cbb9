"""Blind trials of `flexarm diagnose`, a task each, with a scorecard of all.

The program `trials` of flexarm's tests makes them (scripts/trials). It computes and scores; this
kind lists the trials, and collects their lines in `trials.csv` for `scorecard.md`.
"""

import csv
import io
import os
import shlex
import subprocess
import tempfile
from pathlib import Path

from ..errors import CampaignError
from ..task_files import write_whole

# Of the line of a trial, without the durations, which differ from run to run.
_SHOWN = (
    "id", "kind", "arm", "noise", "strength", "hidden", "outside", "outcome", "verdict", "named",
    "parameters", "recovered", "covered", "before", "after", "dirt",
)
FLAGGED = ("verdict", ["unexplained", "partly_explained"])
TALLY = "outcome"


class Trials:
    def __init__(self, common, trials):
        self.common = common
        self.trials = trials

    def __len__(self):
        return len(self.trials)

    def __iter__(self):
        for options, name in self.trials:
            yield {**self.common, "options": options, "id": name}


def _said(ended):
    text = (ended.stderr or ended.stdout).strip()
    return text.split("\n")[-1] or f"exit status {ended.returncode}"


def _listed(table, program, options):
    try:
        ended = subprocess.run([program, *options, "--list"], capture_output=True, text=True)
    except OSError as error:
        table.fail("program", f"cannot be run: {error.strerror}")
    if ended.returncode != 0:
        table.fail("set", f"{' '.join(options)}: {_said(ended)}")
    return [line.rpartition(" ")[0] for line in ended.stdout.splitlines()]


def expand(table, folder):
    program = folder / table.text("program")
    if not os.access(program, os.X_OK):
        table.fail("program", "must be the program trials of scripts/trials")
    common = {
        "program": table.text("program"),
        "built_from": table.text("built_from"),
        "flexarm": table.text("flexarm"),
    }
    if not os.access(folder / common["flexarm"], os.X_OK):
        table.fail("flexarm", "must be the program flexarm")
    trials, known = [], set()
    for one in table.tables("set"):
        try:
            options = shlex.split(one.text("options"))
        except ValueError as error:
            one.fail("options", f"must be options of the program ({error})")
        one.end()
        for name in _listed(table, program, options):
            if name not in known:
                known.add(name)
                trials.append((options, name))
    if not trials:
        table.fail("set", "has no trial")
    return Trials(common, trials)


def files(task, folder):
    return [folder / task["program"], folder / task["flexarm"]]


def _command(task, folder, results):
    return [
        str(folder / task["program"]), *task["options"], "--only", task["id"],
        "--program", str(folder / task["flexarm"]), "--built-from", task["built_from"],
        "--results", str(results),
    ]


def run(task, folder):
    with tempfile.TemporaryDirectory() as place:
        results = Path(place) / "trial.csv"
        ended = subprocess.run(_command(task, folder, results), capture_output=True, text=True)
        if ended.returncode != 0 or not results.exists():
            raise RuntimeError(_said(ended))
        with open(results, newline="", encoding="utf-8") as stream:
            head, line = list(csv.reader(stream))
    return {"columns": head, "cells": line}


def columns(tasks):
    return list(_SHOWN)


def row(task, result):
    if result is None:
        return {"id": task["id"]}
    cells = dict(zip(result["columns"], result["cells"], strict=True))
    return {name: cells[name] for name in _SHOWN}


def finish(pairs, folder, out):
    """`trials.csv`, a line for each trial with a result, and the program's scorecard of them."""
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    last = None
    for task, result in pairs:
        if result is None:
            continue
        if last is None:
            rows.writerow(result["columns"])
        rows.writerow(result["cells"])
        last = task
    if last is None:
        return
    write_whole(out / "trials.csv", text.getvalue().encode())
    # All trials are in the file: none is made, the scorecard is of all.
    command = _command(last, folder, out / "trials.csv")
    command += ["--scorecard", str(out / "scorecard.md")]
    ended = subprocess.run(command, capture_output=True, text=True)
    if ended.returncode != 0:
        raise CampaignError(f"scorecard: {_said(ended)}")
