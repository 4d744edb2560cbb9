"""Tasks that do what a test asks for: nothing, sleep, compute, fail, end their worker."""

import os
import pathlib
import signal
import time


class Tasks:
    def __init__(self, count, what):
        self.count = count
        self.what = what

    def __len__(self):
        return self.count

    def __iter__(self):
        for number in range(self.count):
            yield {"number": number, **self.what.get(str(number), {})}


def expand(table, folder):
    """`count` tasks. [probe.NUMBER] has what task NUMBER does; each sleeps `each_s`, and computes
    `each_turns` turns of a loop."""
    count = table.whole("count", 1, 10_000_000)
    each_s = table.number("each_s", 0.0)
    turns = table.whole("each_turns", 0, 10**12, 0)
    what = {}
    for number in range(min(count, 1000)):
        if table.has(str(number)) or each_s or turns:
            own = table.table(str(number), {})
            what[str(number)] = {
                "sleep_s": float(own.number("sleep_s", each_s)),
                "fails": own.flag("fails", False),
                "kills": own.whole("kills", 0, 100, 0),
            }
            if turns:
                what[str(number)]["turns"] = turns
            own.end()
    return Tasks(count, what)


def run(task, folder):
    with open(pathlib.Path(folder) / "begun", "a") as stream:
        stream.write(f"{task['number']}\n")
    if task.get("kills"):
        # So many workers end, then it goes through.
        deaths = pathlib.Path(folder) / f"deaths-{task['number']}"
        had = deaths.stat().st_size if deaths.exists() else 0
        if had < task["kills"]:
            with open(deaths, "ab") as stream:
                stream.write(b".")
            os.kill(os.getpid(), signal.SIGKILL)
    if task.get("sleep_s"):
        time.sleep(task["sleep_s"])
    for _ in range(task.get("turns", 0)):
        pass
    if task.get("fails"):
        raise ValueError(f"task {task['number']} is to fail")
    return {"square": task["number"] ** 2}


def columns(tasks):
    return ["number", "square"]


def row(task, result):
    return {"number": task["number"], "square": result["square"] if result else None}
