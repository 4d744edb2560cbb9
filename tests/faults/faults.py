#!/usr/bin/python3
"""Puts every command that writes under stress, and checks that each of its files is whole or absent.

- killed: SIGKILL at moments spread over its run. The next run, with --resume where there is a
  checkpoint, writes the same bytes.
- interrupted: SIGINT at such moments. Nothing else is left, and the status is 130.
- full: an output folder on a file system that is full (needs root, for a tmpfs). Status 2, one line.
- closed: standard output is closed, or /dev/full. No file is cut off.
- without gnuplot: what draws says so in one line, status 2, and writes nothing.

Usage: faults.py --program PATH --data FOLDER [--moments N] [--only NAME,...]
"""

import argparse
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

from commands import COMMANDS, Command, bytes_of

_FULL_KB = 4  # room that the full file system has


@dataclass
class Bench:
    """Where commands run, and what they write undisturbed."""

    program: Path
    base: Path  # with what commands read
    folder: Path
    faults: list[str] = field(default_factory=list)

    def fresh(self) -> Path:
        place = Path(tempfile.mkdtemp(dir=self.folder))
        for entry in self.base.iterdir():
            (place / entry.name).symlink_to(entry)
        return place

    def start(self, arguments: tuple[str, ...], place: Path, **streams) -> subprocess.Popen:
        streams = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE} | streams
        return subprocess.Popen([self.program, *arguments], cwd=place, text=True, **streams)

    def run(self, arguments: tuple[str, ...], place: Path, **streams) -> tuple[int, str]:
        process = self.start(arguments, place, **streams)
        _, complaint = process.communicate()
        return process.returncode, complaint

    def fault(self, command: Command, what: str) -> None:
        self.faults.append(f"{command.name}: {what}")
        print(f"FAULT {self.faults[-1]}", flush=True)


@dataclass
class Undisturbed:
    contents: dict[str, dict[str, bytes]]
    seconds: float


def undisturbed(bench: Bench, command: Command) -> Undisturbed | None:
    place = bench.fresh()
    begun = time.monotonic()
    status, complaint = bench.run(command.arguments, place)
    seconds = time.monotonic() - begun
    contents = {output: bytes_of(place / output) for output in command.outputs}
    shutil.rmtree(place)
    if status != 0 or None in contents.values():
        bench.fault(command, f"undisturbed: status {status}, {complaint.strip()}")
        return None
    return Undisturbed(contents, seconds)


def check_whole(bench: Bench, command: Command, place: Path, whole: Undisturbed, when: str) -> int:
    """How many outputs are there."""
    there = 0
    for output, content in whole.contents.items():
        found = bytes_of(place / output)
        if found is not None and command.checkpoint:
            found.pop(command.checkpoint, None)
            found = found or None  # an interrupted run has made its folder, perhaps its checkpoint
        there += found is not None
        if found is not None and found != content:
            bench.fault(command, f"{when}: {output} is neither whole nor absent")
    return there


def leftovers(place: Path) -> list[str]:
    return [name for name in os.listdir(place) if name.startswith(".flexarm-")]


def end_at(bench: Bench, command: Command, whole: Undisturbed, moments: int, how: signal.Signals) -> str:
    """Ends runs at so many moments from their beginning to somewhat after their end."""
    ended = unfinished = 0
    for moment in range(moments):
        place = bench.fresh()
        when = f"{how.name} after {(moment + 0.5) / moments * 1.1 * whole.seconds:.3f} s"
        process = bench.start(command.arguments, place)
        time.sleep((moment + 0.5) / moments * 1.1 * whole.seconds)
        process.send_signal(how)
        _, complaint = process.communicate()
        ended += process.returncode != 0
        there = check_whole(bench, command, place, whole, when)
        unfinished += there < len(command.outputs)
        if how == signal.SIGINT and process.returncode != 0:
            if process.returncode not in (130, -signal.SIGINT):
                bench.fault(command, f"{when}: status {process.returncode}, {complaint.strip()}")
            if leftovers(place):
                bench.fault(command, f"{when}: leaves {leftovers(place)}")
        if there < len(command.outputs):
            go_on(bench, command, place, whole, when)
        shutil.rmtree(place)
    return f"{ended} ended, {unfinished} without all files"


def go_on(bench: Bench, command: Command, place: Path, whole: Undisturbed, when: str) -> None:
    for output in () if command.checkpoint else command.outputs:  # what is there is refused
        target = place / output
        shutil.rmtree(target, ignore_errors=True) if target.is_dir() else target.unlink(missing_ok=True)
    status, complaint = bench.run(command.again(), place)
    if status != 0:
        status, complaint = bench.run((*command.arguments, "--force"), place)  # no checkpoint yet
    if status != 0:
        return bench.fault(command, f"{when}, run again: status {status}, {complaint.strip()}")
    if check_whole(bench, command, place, whole, f"{when}, run again") < len(command.outputs):
        bench.fault(command, f"{when}, run again: an output is missing")
    return None


def on_a_full_disk(bench: Bench, command: Command, whole: Undisturbed) -> str:
    size = sum(len(content) for files in whole.contents.values() for content in files.values())
    if os.geteuid() != 0:
        return "not run: needs root"
    if size < 2 * _FULL_KB * 1024:
        return "not run: its files are small"
    place = Path(tempfile.mkdtemp(dir=bench.folder))
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={_FULL_KB}k", "tmpfs", place], check=True)
    try:
        for entry in bench.base.iterdir():
            (place / entry.name).symlink_to(entry)
        status, complaint = bench.run(command.arguments, place)
        if status != 2 or complaint.count("\n") != 1:
            bench.fault(command, f"full disk: status {status}, {complaint.strip()!r}")
        check_whole(bench, command, place, whole, "full disk")
        if leftovers(place):
            bench.fault(command, f"full disk: leaves {leftovers(place)}")
    finally:
        subprocess.run(["umount", place], check=True)
        place.rmdir()
    return "refused"


def with_a_closed_output(bench: Bench, command: Command, whole: Undisturbed) -> str:
    statuses = []
    for name in ("closed pipe", "/dev/full"):
        place = bench.fresh()
        if name == "/dev/full":
            with open("/dev/full", "w", encoding="utf-8") as full:
                status, complaint = bench.run(command.arguments, place, stdout=full)
        else:
            reader, writer = os.pipe()
            os.close(reader)
            status, complaint = bench.run(command.arguments, place, stdout=writer)
            os.close(writer)
        if status < 0 or complaint.count("\n") > 1:
            bench.fault(command, f"{name}: status {status}, {complaint.strip()!r}")
        check_whole(bench, command, place, whole, name)
        statuses.append(str(status))
        shutil.rmtree(place)
    return "status " + " and ".join(statuses)


def without_gnuplot(bench: Bench, command: Command, whole: Undisturbed) -> str:
    if not command.draws:
        return "draws nothing"
    place = bench.fresh()
    empty = place / "path"
    empty.mkdir()
    status, complaint = bench.run(command.arguments, place, env=os.environ | {"PATH": str(empty)})
    if status != 2 or complaint.count("\n") != 1 or "gnuplot" not in complaint:
        bench.fault(command, f"without gnuplot: status {status}, {complaint.strip()!r}")
    if check_whole(bench, command, place, whole, "without gnuplot") > 0:
        bench.fault(command, "without gnuplot: writes files")
    shutil.rmtree(place)
    return "refused"


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", type=lambda text: Path(text).resolve(), required=True)
    parser.add_argument("--data", type=lambda text: Path(text).resolve(), required=True)
    parser.add_argument("--moments", type=int, default=100)
    parser.add_argument("--only", type=lambda text: text.split(","), default=[])
    arguments = parser.parse_args()
    # A shell starts what runs in the background with SIGINT ignored, which commands would inherit.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    with tempfile.TemporaryDirectory(prefix="faults-") as folder:
        bench = Bench(arguments.program, Path(folder) / "base", Path(folder))
        bench.base.mkdir()
        (bench.base / "data").symlink_to(arguments.data)
        setup = next(command for command in COMMANDS if command.name == "import")
        if bench.run(setup.arguments, bench.base)[0] != 0:
            print("the measurement that commands read cannot be made", file=sys.stderr)
            return 1
        (bench.base / "bench").rename(bench.base / "imported")
        for command in COMMANDS:
            if arguments.only and command.name not in arguments.only:
                continue
            whole = undisturbed(bench, command)
            if whole is None:
                continue
            print(f"{command.name} ({whole.seconds:.2f} s): killed: "
                  f"{end_at(bench, command, whole, arguments.moments, signal.SIGKILL)}; interrupted: "
                  f"{end_at(bench, command, whole, arguments.moments, signal.SIGINT)}; full disk: "
                  f"{on_a_full_disk(bench, command, whole)}; closed output: "
                  f"{with_a_closed_output(bench, command, whole)}; without gnuplot: "
                  f"{without_gnuplot(bench, command, whole)}", flush=True)
        print(f"{len(bench.faults)} faults")
        return 1 if bench.faults else 0


if __name__ == "__main__":
    sys.exit(main())
