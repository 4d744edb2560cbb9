#!/usr/bin/python3
"""Runs the commands of command_cases.py and measures each as a whole: processor seconds of all its
threads, elapsed seconds, largest resident memory.

Usage: commands.py PROGRAM ROWS
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time

import measured_rows
from command_cases import ARMS, CASES

# A command may also say that something is not as it should be.
EXPECTED_STATUS = (0, 1)


def write_arms(folder):
    with open(os.path.join(measured_rows.ROOT, "data/paper/arm.toml"), encoding="utf-8") as file:
        paper = file.read()
    for name, more in ARMS.items():
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(paper + more)


def measured(program, case, work):
    """The numbers of one command; of a diagnosis also its verdict."""
    data = os.path.join(measured_rows.ROOT, "data")
    arguments = case.arguments.format(data=data, work=work).split()
    result = os.path.join(work, "result.json")
    if arguments[0] == "diagnose":
        arguments += ["--json", result]
    begin_s = time.monotonic()
    process = subprocess.Popen([program, *arguments], stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    elapsed_s = time.monotonic() - begin_s
    if process.returncode not in EXPECTED_STATUS:
        raise SystemExit(f"flexarm {' '.join(arguments)}: exit status {process.returncode}")
    row = {"work": f"{arguments[0]}: {case.what}", "command": arguments[0], "what": case.what,
           "processor_s": usage.ru_utime + usage.ru_stime, "elapsed_s": elapsed_s,
           "memory_MB": usage.ru_maxrss * 1024 / 1e6,
           "most_processor_s": case.most_processor_s, "most_memory_MB": case.most_memory_MB}
    if arguments[0] == "diagnose":
        with open(result, encoding="utf-8") as file:
            row["verdict"] = json.load(file)["verdict"]
    return row


def main():
    if len(sys.argv) != 3:
        raise SystemExit("usage: commands.py PROGRAM ROWS")
    program, path = os.path.abspath(sys.argv[1]), sys.argv[2]
    work = tempfile.mkdtemp()
    rows = []
    try:
        write_arms(work)
        for case in CASES:
            row = measured(program, case, work)
            rows.append(row)
            print(f"{row['work']:<90} {row['processor_s']:>8.2f} s "
                  f"{row['memory_MB']:>6.0f} MB  {row.get('verdict', '')}".rstrip(), flush=True)
    finally:
        shutil.rmtree(work)
    measured_rows.write_rows(path, "flexarm", rows)


if __name__ == "__main__":
    main()
