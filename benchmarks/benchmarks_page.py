#!/usr/bin/python3
"""Writes docs/benchmarks.md from what scripts/bench measured.

Usage: benchmarks_page.py RESULTS PAGE

RESULTS/google: a file of Google Benchmark in JSON a subject; RESULTS/rows: a file a script, in the
form of comparison/measured_rows.py.
"""
import datetime
import json
import math
import os
import re
import subprocess
import sys
import textwrap

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path[:0] = [os.path.join(ROOT, "scripts"), os.path.join(ROOT, "benchmarks/comparison")]

import document
import page_tables
from page_tables import Ours

SECONDS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}
# Relative spacing of doubles: an error of so many ulp is at most that many times this.
ULP = 2.0**-52


class Results:
    def __init__(self, folder):
        self.google = {}
        self.rows = {}
        self.tools = {}
        for name, path in files_of(os.path.join(folder, "google")):
            self.google[name] = least_times(read(path))
        for name, path in files_of(os.path.join(folder, "rows")):
            made = read(path)
            self.rows[name] = {row["work"]: row for row in made["rows"]}
            self.tools[name] = made["tool"]

    def find(self, what):
        """processor_s and error of a measurement; None where it was not made."""
        if isinstance(what, Ours):
            run = self.google[what.subject][what.name]
            error = run[what.error] if what.error else None
            return {"processor_s": run["processor_s"],
                    "error": error * ULP if what.error == "ulp" else error}
        if what.file not in self.rows:
            return None
        return self.rows[what.file][what.work]


def read(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def files_of(folder):
    return [(name.removesuffix(".json"), os.path.join(folder, name))
            for name in sorted(os.listdir(folder)) if name.endswith(".json")]


def least_times(made):
    """By name, the repetition of a Google Benchmark file with the least processor time."""
    least = {}
    for run in made["benchmarks"]:
        if run["run_type"] != "iteration" or run.get("error_occurred"):
            continue
        name = re.sub(r"/(min_time|repeats|iterations):[^/]*", "", run["run_name"])
        run = {**run, "processor_s": run["cpu_time"] * SECONDS[run["time_unit"]]}
        if name not in least or run["processor_s"] < least[name]["processor_s"]:
            least[name] = run
    return least


def paragraph(text):
    return textwrap.fill(" ".join(text.split()), 120, break_long_words=False,
                         break_on_hyphens=False)


def time_text(time_s):
    for unit, name in ((1.0, "s"), (1e-3, "ms"), (1e-6, "us")):
        if time_s >= unit:
            return f"{document.number(time_s / unit, 3)} {name}"
    return f"{1e9 * time_s:.0f} ns"


def error_text(error):
    if error is None:
        return "-"
    return f"{error:.1e}" if math.isfinite(error) else "no digits"


def tool_of(file):
    return file.rsplit("_", 1)[-1]


def two_digits(ratio):
    return document.number(float(f"{ratio:.2g}"), 2)


def comparison_row(results, row):
    ours = results.find(row.ours)
    theirs = results.find(row.theirs)
    missing = f"not measured: package {page_tables.PACKAGES[tool_of(row.theirs.file)]}"
    head = ["-", "-"]
    if ours is not None:
        head = [time_text(ours["processor_s"]), error_text(ours["error"])]
    if theirs is None:
        return [row.work, *head, row.by, missing, "-", "-"]
    if "failure" in theirs:
        return [row.work, *head, row.by, f"fails: {theirs['failure']}", "-", "-"]
    return [row.work, *head, row.by, time_text(theirs["processor_s"]), error_text(theirs["error"]),
            two_digits(theirs["processor_s"] / ours["processor_s"])]


def comparison(results, table):
    header = ["work", "flexarm", "error", "other tool", "its time", "its error", "ratio of times"]
    return f"## {table.title}\n\n{paragraph(table.text)}\n\n" + document.table(
        header, [comparison_row(results, row) for row in table.rows])


def slope(x, y):
    """Of log y over log x, by least squares."""
    u, v = [math.log(a) for a in x], [math.log(b) for b in y]
    mean_u, mean_v = sum(u) / len(u), sum(v) / len(v)
    return (sum((a - mean_u) * (b - mean_v) for a, b in zip(u, v))
            / sum((a - mean_u)**2 for a in u))


def growth_cells(work, over, sizes, times_s):
    return [work, over, f"{sizes[0]:,} to {sizes[-1]:,}", time_text(times_s[0]),
            time_text(times_s[-1]), f"{slope(sizes, times_s):.2f}",
            f"{slope(sizes[-2:], times_s[-2:]):.2f}"]


def growth(results):
    rows = []
    for series in page_tables.GROWTH:
        prefix = f"{series.name}/{series.size}:"
        runs = {int(name.removeprefix(prefix)): run["processor_s"]
                for name, run in results.google[series.subject].items() if name.startswith(prefix)}
        sizes = sorted(runs)
        rows.append(growth_cells(series.work, series.over, sizes, [runs[n] for n in sizes]))

    def sweep(payloads, threads):
        return results.rows[f"sweep_{payloads}"][f"sweep payloads:{payloads} threads:{threads}"]

    payloads = sorted(int(file.removeprefix("sweep_"))
                      for file in results.rows if file.startswith("sweep_"))
    rows.append(growth_cells("sweep, three formulations, one thread", "payloads", payloads,
                             [sweep(n, 1)["processor_s"] for n in payloads]))
    one, two = sweep(payloads[-1], 1), sweep(payloads[-1], 2)
    text = paragraph("""Processor time over size. The slope is that of the logarithms, by least squares
        over all sizes measured, and over the two largest: 1 is linear growth.""")
    threads = paragraph(f"""A sweep of {payloads[-1]:,} payloads takes {time_text(one["elapsed_s"])} of
        elapsed time on one thread and {time_text(two["elapsed_s"])} on two, a factor of
        {document.number(one["elapsed_s"] / two["elapsed_s"], 3)}. On two threads it had
        {document.number(two["processor_s"] / two["elapsed_s"], 3)} cores; other programs on the
        machine had the rest. Its processor time on two is
        {document.number(two["processor_s"] / one["processor_s"], 3)} times that on one.""")
    header = ["work", "over", "sizes", "smallest", "largest", "slope", "last slope"]
    return f"## Growth\n\n{text}\n\n{document.table(header, rows)}\n\n{threads}"


def target_text(row):
    parts = []
    if row["most_processor_s"] is not None:
        parts.append(f"{row['most_processor_s']:.0f} s")
    if row["most_memory_MB"] is not None:
        parts.append(f"{row['most_memory_MB']:.0f} MB")
    return ", ".join(parts) or "-"


def commands(results):
    rows = [[f"`flexarm {row['command']}`", row["what"], time_text(row["processor_s"]),
             time_text(row["elapsed_s"]), f"{row['memory_MB']:.0f} MB",
             row.get("verdict", "-").replace("_", " "), target_text(row)]
            for row in results.rows["commands"].values()]
    text = paragraph("""Each command runs once, on all cores. Processor time is that of all its
        threads, memory the largest resident set.""")
    header = ["command", "data", "processor time", "elapsed", "memory", "verdict", "target"]
    return f"## Whole commands\n\n{text}\n\n{document.table(header, rows)}"


def diagnoses(results):
    rows = [[row["work"], f"{row['count']}", f"{row['right']}", time_text(row["processor_s"]),
             time_text(row["most_processor_s"]), time_text(row["most_elapsed_s"]),
             document.number(row["cores"], 3), f"{row['figure_s']:g} s"]
            for row in results.rows["diagnoses"].values()]
    text = paragraph("""A fixed sample of the blind trials, one after the other, each on all cores
        with the whole library. `time` cases have four runs for estimation and two for validation, of
        4,000 samples and four sensors; `frf` cases three runs of 500 lines and four sensors; `modal`
        cases tables of poles and zeros. Predictors are chosen by the program. A trial is right where
        its causes are named, or a cause outside the library is recognised as one. Processor time is
        that of all threads; cores are processor time over elapsed time. The target of the project is
        for each diagnosis.""")
    header = ["data", "trials", "right", "median", "largest", "largest elapsed", "cores", "target"]
    return f"## Diagnoses\n\n{text}\n\n{document.table(header, rows)}"


def output_of(*command):
    done = subprocess.run(command, check=True, capture_output=True, text=True, cwd=ROOT)
    return done.stdout.strip()


def machine():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        models = [line.split(":", 1)[1].strip() for line in file if line.startswith("model name")]
    return f"{len(models)} cores, {models[0]}" if models else f"{os.cpu_count()} cores"


def facts(results):
    changed = output_of("git", "status", "--porcelain", "--untracked-files=no", "--", ".",
                        ":!docs/benchmarks.md")
    commit = output_of("git", "rev-parse", "--short=10", "HEAD")
    others = sorted({tool for tool in results.tools.values() if tool != "flexarm"})
    absent = [f"{page_tables.TOOLS[tool]} (package {package})"
              for tool, package in page_tables.PACKAGES.items()
              if not any(tool_of(name) == tool for name in results.rows)]
    rows = [["commit", commit + (" with changes" if changed else "")],
            ["date", datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC")],
            ["machine", machine()],
            ["compiler", output_of("g++", "--version").splitlines()[0]],
            ["other tools", ", ".join(others) or "none"]]
    library = os.path.realpath("/usr/lib/x86_64-linux-gnu/libblas.so.3")
    if os.path.exists(library):
        rows.append(["BLAS of the tools", f"`{library}`"])
    if absent:
        rows.append(["not measured", ", ".join(absent)])
    rows.append(["command", "`scripts/bench`; `scripts/bench --install-tools` installs the tools"])
    return document.table(["what", "value"], rows)


def page(results):
    text = paragraph("""`scripts/bench` writes this page. Each figure of flexarm stands beside what a
        user would take in its place, measured in the same run on the same work. Times are processor
        times on one thread, the least of several repetitions. A ratio above 1 means that flexarm
        takes less time than the other tool, one below 1 that it takes more. Errors belong to the
        ratio: the tools often differ more in error than in time. Ratios carry over to other machines
        better than times do.""")
    parts = [f"# Benchmarks\n\n{text}\n\n{facts(results)}"]
    parts += [comparison(results, table) for table in page_tables.COMPARISONS]
    parts += [growth(results), commands(results), diagnoses(results)]
    return "\n\n".join(parts) + "\n"


def main():
    if len(sys.argv) != 3:
        raise SystemExit("usage: benchmarks_page.py RESULTS PAGE")
    document.write(sys.argv[2], page(Results(sys.argv[1])))


if __name__ == "__main__":
    main()
