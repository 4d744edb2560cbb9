#!/usr/bin/python3
"""What a campaign costs beside its tasks: overhead of a task, efficiency, memory.

Usage: campaign_overhead.py [--tasks N] [--long N] [--computing N]
(PYTHONPATH has the module flexarm)

The overhead is (wall time of N tasks that do nothing - that of one)/N, with one worker. The
efficiency is T1/(2 T2) for tasks that sleep a second, T with and without the start of the
processes. With --computing also for tasks that compute a second: that tells of the machine too,
whose cores may share a clock and caches. Memory is the largest resident set of the scheduler and of
this process.
"""

import argparse
import contextlib
import io
import multiprocessing
import pathlib
import resource
import sys
import tempfile
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tests" / "python"))

from campaign_kinds import probe  # noqa: E402  its folder is known only now
from flexarm.campaign import command  # noqa: E402


class _SchedulerMemory(threading.Thread):
    """The largest resident set of the scheduler while it lives [kB]."""

    def __init__(self):
        super().__init__(daemon=True)
        self.highest_kB = 0
        self._over = threading.Event()

    def run(self):
        while not self._over.wait(0.2):
            for process in multiprocessing.active_children():
                if process.name != "campaign-scheduler":
                    continue
                with contextlib.suppress(OSError, StopIteration):
                    lines = pathlib.Path(f"/proc/{process.pid}/status").read_text().splitlines()
                    value = next(one for one in lines if one.startswith("VmHWM"))
                    self.highest_kB = max(self.highest_kB, int(value.split()[1]))

    def end(self):
        self._over.set()
        self.join()


def _turns_in(wanted_s):
    """Turns of the probe's loop that take so long on this machine, when it is quiet."""
    turns = 1_000_000
    fastest_s = float("inf")
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(10):
            begun = time.process_time()
            probe.run({"number": 0, "turns": turns}, folder)
            fastest_s = min(fastest_s, time.process_time() - begun)
    return round(turns * wanted_s / fastest_s)


def seconds(count, workers, each_s=0.0, each_turns=0):
    """Wall time of a campaign of `count` tasks, and the scheduler's memory in kB."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "campaign.toml"
        path.write_text(
            f'kind = "campaign_kinds.probe"\n[probe]\ncount = {count}\neach_s = {each_s}\n'
            f"each_turns = {each_turns}\n"
        )
        memory = _SchedulerMemory()
        memory.start()
        begun = time.monotonic()
        with contextlib.redirect_stdout(io.StringIO()):
            status = command.main([str(path), "--workers", str(workers)])
        elapsed_s = time.monotonic() - begun
        memory.end()
        if status != 0:
            sys.exit(f"the campaign ended with status {status}")
    return elapsed_s, memory.highest_kB


def _print_efficiency(count, what, start_s, **each):
    one_s, two_s = (seconds(count, workers, **each)[0] for workers in (1, 2))
    without = (one_s - start_s[1]) / (2.0 * (two_s - start_s[2]))
    print(f"{count} tasks that {what} 1 s: {one_s:.2f} s and {two_s:.2f} s; efficiency"
          f" {one_s / (2.0 * two_s):.3f}, without the start {without:.3f}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--tasks", type=int, default=2000, help="tasks that do nothing")
    parser.add_argument("--long", type=int, default=20, help="tasks of a second")
    parser.add_argument("--computing", type=int, default=0, help="tasks that compute a second")
    arguments = parser.parse_args()
    seconds(1, 1)  # the modules are loaded
    start_s = {workers: seconds(1, workers)[0] for workers in (1, 2)}
    for workers in (1, 2):
        elapsed_s, scheduler_kB = seconds(arguments.tasks, workers)
        each_ms = 1e3 * (elapsed_s - start_s[workers]) / arguments.tasks
        print(f"{arguments.tasks} empty tasks, {workers} workers: {elapsed_s:.2f} s,"
              f" {each_ms:.2f} ms a task; scheduler {scheduler_kB / 1024:.0f} MiB", flush=True)
    own_kB = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    print(f"memory of the command: {own_kB / 1024:.0f} MiB")
    _print_efficiency(arguments.long, "sleep", start_s, each_s=1.0)
    if arguments.computing:
        turns = _turns_in(1.0)
        _print_efficiency(arguments.computing, "compute", start_s, each_turns=turns)


if __name__ == "__main__":
    main()
