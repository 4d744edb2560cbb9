"""The tables of all tasks, in the order of the campaign: the same bytes however they were computed.

    results.csv     a row a task
    results.json    the same, with names of columns and the campaign
    failures.json   input and message of each task without result
"""

import contextlib
import csv
import json

import flexarm

from .program import program_digest
from .task_files import read_result, whole_files

_FIRST_COLUMNS = ["index", "task", "state"]
_LAST_COLUMN = "message"


def columns_of(campaign):
    return [*_FIRST_COLUMNS, *campaign.kind.columns(campaign.tasks), _LAST_COLUMN]


def results_of(campaign, outcome, out):
    """For each task its input and its result or None; one at a time."""
    for digest, task in zip(outcome.digests, campaign.tasks):
        yield task, read_result(out, digest.hex())


def rows_of(campaign, outcome, out):
    """For each task its input and its row, a list as `columns_of` has it; one at a time."""
    own = campaign.kind.columns(campaign.tasks)
    for index, (task, result) in enumerate(results_of(campaign, outcome, out)):
        state, message = "done", ""
        if result is None:
            state, message = outcome.failures.get(
                outcome.digests[index], ("missing", "no whole file of this task")
            )
        cells = campaign.kind.row(task, result)
        first = [index, outcome.digests[index].hex(), state]
        yield task, [*first, *(cells.get(name) for name in own), message]


def _text(value):
    return json.dumps(value, ensure_ascii=False, allow_nan=False)


def merge(campaign, outcome, out, see=lambda columns, row: None):
    """Writes the files; returns the rows without result, as dicts of failures.json. `see` is called
    with each row."""
    columns = columns_of(campaign)
    names = ("results.csv", "results.json", "failures.json")
    failures = []
    with (
        whole_files(*(out / name for name in names)) as temporary,
        contextlib.ExitStack() as stack,
    ):
        table, document, failed = (
            stack.enter_context(open(one, "x", newline="", encoding="utf-8")) for one in temporary
        )
        rows = csv.writer(table, lineterminator="\n")
        rows.writerow(columns)
        head = {
            "schema": "flexarm.campaign/1",
            "name": campaign.name,
            "kind": campaign.kind_name,
            "version": flexarm.__version__,
            "program": program_digest(campaign.kind),
            "tasks": len(outcome.digests),
            "columns": columns,
        }
        document.write(_text(head)[:-1] + ',\n"rows": [')
        for task, row in rows_of(campaign, outcome, out):
            rows.writerow(row)
            see(columns, row)
            document.write(("," if row[0] else "") + "\n" + _text(row))
            if row[2] != "done":
                failure = {
                    "index": row[0], "task": row[1], "state": row[2], "message": row[-1],
                    "input": task,
                }
                failures.append(failure)
        document.write("\n]}\n")
        text = {"schema": "flexarm.campaign_failures/1", "failures": failures}
        failed.write(json.dumps(text, ensure_ascii=False, indent=1, allow_nan=False) + "\n")
    return failures
