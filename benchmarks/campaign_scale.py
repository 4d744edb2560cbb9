#!/usr/bin/python3
"""What grows with a campaign, for docs/scale.md: hashing of recordings, result files, merge, orders,
connections of the scheduler.

Usage: campaign_scale.py [hashing | results | orders | connections]...   (PYTHONPATH has flexarm)

Counts are printed with each rate. Files are in the folder of temporary files (TMPDIR).
"""

import contextlib
import io
import json
import multiprocessing
import os
import pathlib
import sys
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "python"))

from flexarm.campaign import cluster, command, runner  # noqa: E402  their folder is known only now
from flexarm.campaign.campaign_file import read_campaign  # noqa: E402
from flexarm.campaign.hdf5 import ColumnTypes, write_hdf5  # noqa: E402
from flexarm.campaign.merge import merge  # noqa: E402
from flexarm.campaign.task_files import canonical, finished, result_path  # noqa: E402

RECORDINGS = 1000
RECORD_BYTES = 300_000
RUNS = 3
RESULT_COUNTS = (1_000, 10_000, 100_000)
ORDERS = 2000
WORKER_COUNTS = (2, 6, 10)


@contextlib.contextmanager
def timed(what, count, unit):
    """Wall time, and processor time of this process: that does not depend on other work."""
    begun, used = time.monotonic(), time.process_time()
    yield
    seconds, own_s = time.monotonic() - begun, time.process_time() - used
    print(f"{what}: {seconds:.2f} s, {count / seconds:.0f} {unit}/s;"
          f" processor {1e6 * own_s / count:.0f} us each", flush=True)


class SchedulerTime(threading.Thread):
    """Processor time of the scheduler while it lives [s]."""

    def __init__(self):
        super().__init__(daemon=True)
        self.used_s = 0.0
        self._over = threading.Event()

    def run(self):
        while not self._over.wait(0.1):
            for process in multiprocessing.active_children():
                if process.name == "campaign-scheduler":
                    with contextlib.suppress(OSError, IndexError):
                        cells = pathlib.Path(f"/proc/{process.pid}/stat").read_text().split()
                        self.used_s = (int(cells[13]) + int(cells[14])) / os.sysconf("SC_CLK_TCK")

    def end(self):
        self._over.set()
        self.join()


def resident_MiB(pid="self"):
    lines = pathlib.Path(f"/proc/{pid}/status").read_text().splitlines()
    return int(next(one for one in lines if one.startswith("VmRSS")).split()[1]) / 1024


def make_recordings(folder):
    arm = (ROOT / "data" / "ruler" / "ruler.toml").read_bytes()
    line = b"0.001,0.00123456,-0.12345678,1.23456789\n"
    for number in range(RECORDINGS):
        place = folder / "recordings" / f"{number:07}"
        place.mkdir(parents=True)
        (place / "arm.toml").write_bytes(arm)
        text = 'arm = "arm.toml"\n'
        for run in range(RUNS):
            (place / f"{run}.csv").write_bytes(
                f"{number},{run}\n".encode() + line * (RECORD_BYTES // len(line))
            )
            text += f'[[run]]\nid = "r{run}"\nkind = "time"\nfile = "{run}.csv"\n'
        (place / "measurement.toml").write_text(text)


def known(campaign, out):
    (out / "tasks").mkdir(parents=True, exist_ok=True)
    one = runner.Runner(campaign, out)
    one._known()
    return one


def hashing():
    """Each start of a campaign of diagnoses: the folder is listed, the files are hashed."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        make_recordings(folder)
        time.sleep(2.5)  # what has just changed is not kept
        path = folder / "campaign.toml"
        path.write_text('kind = "diagnose"\n[diagnose]\nfolder = "recordings"\n')
        files = RECORDINGS * (RUNS + 2)
        print(f"{RECORDINGS} recordings of {RUNS} runs of {RECORD_BYTES / 1e6:.1f} MB, {files} files")
        with timed("folder listed", RECORDINGS, "recordings"):
            campaign = read_campaign(path)
        out = folder / "out"
        with timed("files hashed", RECORDINGS, "recordings"):
            known(campaign, out)
        with timed("the same, with kept hashes", RECORDINGS, "recordings"):
            known(campaign, out)
        kept = (out / "file-digests.sqlite").stat().st_size
        print(f"kept hashes: {kept / files:.0f} bytes a file")


def results():
    """From results that are there to the tables."""
    for count in RESULT_COUNTS:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            path = folder / "campaign.toml"
            path.write_text(f'kind = "campaign_kinds.probe"\n[probe]\ncount = {count}\n')
            campaign = read_campaign(path)
            out = folder / "out"
            one = known(campaign, out)
            for part in range(256):
                (out / "tasks" / f"{part:02x}").mkdir()
            with timed(f"{count} result files written, without synchronisation", count, "files"):
                for digest, task in zip(one.outcome.digests, campaign.tasks):
                    result = {"square": task["number"] ** 2}
                    with open(result_path(out, digest.hex()), "x") as stream:
                        stream.write(canonical({"input": task, "result": result}))
            with timed(f"{count} result files listed", count, "files"):
                finished(out)
            before_MiB = resident_MiB()
            with timed(f"{count} inputs hashed", count, "tasks"):
                one = known(campaign, out)
            print(f"memory of {count} tasks: {resident_MiB() - before_MiB:.1f} MiB more")
            types = ColumnTypes()
            with timed(f"{count} results merged", count, "rows"):
                merge(campaign, one.outcome, out, types.see)
            with timed(f"{count} rows of HDF5", count, "rows"):
                write_hdf5(campaign, one.outcome, out, types)


def orders():
    """Orders of one task that does nothing: what command and scheduler handle."""
    runner._MOST_IN_AN_ORDER = 1
    for workers in (1, 2):
        with tempfile.TemporaryDirectory() as name:
            path = pathlib.Path(name) / "campaign.toml"
            path.write_text(f'kind = "campaign_kinds.probe"\n[probe]\ncount = {ORDERS}\n')
            scheduler = SchedulerTime()
            scheduler.start()
            with timed(f"{ORDERS} orders of one empty task, {workers} workers", ORDERS, "orders"):
                with contextlib.redirect_stdout(io.StringIO()):
                    command.main([str(path), "--workers", str(workers)])
            scheduler.end()
            print(f"of the scheduler: {1e6 * scheduler.used_s / ORDERS:.0f} us each", flush=True)


def connections():
    """What a worker more costs the scheduler."""
    for workers in WORKER_COUNTS:
        local = cluster.LocalCluster(workers)
        try:
            while local.workers() < workers:
                local.tend()
                time.sleep(0.1)
            time.sleep(1.0)
            scheduler = next(
                one for one in multiprocessing.active_children() if one.name == "campaign-scheduler"
            )
            files = len(os.listdir(f"/proc/{scheduler.pid}/fd"))
            print(f"{workers} workers: scheduler has {files} open files,"
                  f" {resident_MiB(scheduler.pid):.1f} MiB", flush=True)
        finally:
            local.close()


def main():
    parts = {one.__name__: one for one in (hashing, results, orders, connections)}
    chosen = sys.argv[1:] or list(parts)
    if any(one not in parts for one in chosen):
        sys.exit(__doc__)
    print(json.dumps({"cores": os.cpu_count(), "load": os.getloadavg()}))
    for one in chosen:
        parts[one]()


if __name__ == "__main__":
    main()
