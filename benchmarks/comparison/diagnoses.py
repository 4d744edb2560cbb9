#!/usr/bin/python3
"""Runs a fixed sample of the blind trials (tests/trials) one after the other, each on all cores, and
measures the diagnoses: processor seconds of all threads, elapsed seconds, how many are right.

Usage: diagnoses.py TRIALS FLEXARM ROWS
"""
import csv
import os
import statistics
import subprocess
import sys
import tempfile
from typing import NamedTuple

import measured_rows

# One noise and one strength of the standing trials. The seed was used in development: how many are
# right is no measure of the program, only that it still works.
COMMON = ["--noise", "0.005", "--strength", "middle", "--seed", "16", "--jobs", "1"]

# Outcomes of a trial that are as wanted (tests/trials/score.hpp).
RIGHT = ("exact", "in_class", "recognised")


class Sample(NamedTuple):
    work: str
    options: list
    figure_s: float  # of the project: processor time of each diagnosis


SAMPLES = [
    Sample("one cause, `time`", ["--kind", "time", "--effects", "one", "--trials", "10"], 3.0),
    Sample("two causes, `time`", ["--kind", "time", "--effects", "pairs", "--trials", "8"], 10.0),
    Sample("three causes, `time`", ["--kind", "time", "--effects", "triples", "--trials", "6"], 20.0),
    Sample("outside the library, `time`",
           ["--kind", "time", "--effects", "random_disturbance,backlash,tapered_beam,cross_talk"],
           20.0),
    Sample("one cause, `frf`", ["--kind", "frf", "--effects", "one", "--trials", "10"], 1.0),
    Sample("one cause, `modal`", ["--kind", "modal", "--effects", "one", "--trials", "10"], 0.3),
]


def measured(trials, program, sample):
    with tempfile.TemporaryDirectory() as folder:
        results = os.path.join(folder, "trials.csv")
        subprocess.run([trials, "--program", program, "--results", results, *COMMON,
                        *sample.options], check=True, stdout=subprocess.DEVNULL)
        with open(results, encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
    processor_s = [float(row["processor [s]"]) for row in rows]
    return {"work": sample.work, "processor_s": statistics.median(processor_s),
            "most_processor_s": max(processor_s),
            "most_elapsed_s": max(float(row["time [s]"]) for row in rows),
            "cores": sum(processor_s) / sum(float(row["time [s]"]) for row in rows),
            "count": len(rows), "right": sum(row["outcome"] in RIGHT for row in rows),
            "figure_s": sample.figure_s}


def main():
    if len(sys.argv) != 4:
        raise SystemExit("usage: diagnoses.py TRIALS FLEXARM ROWS")
    trials, program, path = (os.path.abspath(argument) for argument in sys.argv[1:])
    rows = []
    for sample in SAMPLES:
        row = measured(trials, program, sample)
        rows.append(row)
        print(f"{row['work']:<32} {row['count']:>3} median {row['processor_s']:>7.2f} s  largest "
              f"{row['most_processor_s']:>7.2f} s  {row['right']} right", flush=True)
    measured_rows.write_rows(path, "flexarm", rows)


if __name__ == "__main__":
    main()
