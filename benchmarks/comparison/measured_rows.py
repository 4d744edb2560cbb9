"""The form in which every program of this folder writes what it measured, for benchmarks_page.py:

    {"tool": "SciPy 1.10.1", "rows": [{"work": "...", "processor_s": 0.1, "error": 1e-9}, ...]}

`work` names the measurement. `processor_s` is the least of the repetitions. `error` is relative to
the largest value unless the script says otherwise. A row may have more numbers.
"""
import json
import os
import sys
import time

# Before NumPy is imported: one thread, as flexarm has.
for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
REPETITIONS = 3
# What takes this long once is not repeated.
LONG_s = 3.0


def timed(run, repetitions=REPETITIONS):
    """The least processor time of some runs, and what the last one returned."""
    least_s = None
    for _ in range(repetitions):
        begin_s = time.process_time()
        result = run()
        spent_s = time.process_time() - begin_s
        least_s = spent_s if least_s is None else min(least_s, spent_s)
        if spent_s > LONG_s:
            break
    return least_s, result


def write_rows(path, tool, rows):
    """Whole or not at all."""
    with open(path + ".tmp", "w", encoding="utf-8") as file:
        json.dump({"tool": tool, "rows": rows}, file, indent=1)
    os.replace(path + ".tmp", path)


class Rows:
    """Collects the rows of one tool and prints each as it comes."""

    def __init__(self, tool):
        self.tool = tool
        self.rows = []

    def add(self, work, processor_s, error=None, **numbers):
        row = {"work": work, "processor_s": processor_s, "error": error, **numbers}
        self.rows.append(row)
        more = "  ".join(f"{name} {value:.3g}" for name, value in row.items()
                         if name not in ("work", "processor_s") and value is not None)
        print(f"{work:<64} {1e3 * processor_s:>9.4g} ms  {more}", flush=True)

    def add_failure(self, work, error):
        """The tool gave no result: the name of its exception stands for the numbers."""
        self.rows.append({"work": work, "failure": type(error).__name__})
        print(f"{work:<64} {error}", flush=True)

    def write(self, path):
        write_rows(path, self.tool, self.rows)


def arguments():
    """FOLDER of comparison_inputs and the file for the rows."""
    if len(sys.argv) != 3:
        raise SystemExit(f"usage: {os.path.basename(sys.argv[0])} FOLDER ROWS")
    return sys.argv[1], sys.argv[2]


def document(folder, name):
    with open(os.path.join(folder, name), encoding="utf-8") as file:
        return json.load(file)


def reference_Hz(key):
    """Ten `pole_hz` or `hub_zero_hz` of the paper's arm, 30 digits rounded to double."""
    known = document(os.path.join(ROOT, "tests", "reference"), "exact.json")
    return [float(digits) for digits in known["paper"][key]]
