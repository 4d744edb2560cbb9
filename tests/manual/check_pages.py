#!/usr/bin/python3
"""Runs the commands of pages of the manual and compares what they print with the pages.

Each page runs in an empty folder that has `data` of the repository, and nothing but what the page
shows is run. Every number of its prose must
be in a command, an output or a file of the page, or be declared (page.py says how).

Usage: check_pages.py --program PATH --source ROOT [--update] PAGE ...
With --update the output of each command replaces that of the page, unless that has "..." or "…".
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from output import first_difference, is_rounded_from, numbers_in
from page import Command, File, Page, read_page

# A number of prose is one with a decimal point or a unit; "two runs" and "step 3" are words.
_PROSE_NUMBER = re.compile(r"(?<![\w.])(\d+\.\d+|\d+(?=\s*(?:%|Hz|mm|kg|s|N)\b))(?![\w.])")
_CODE = re.compile(r"`[^`]*`|\]\([^)]*\)")


def run(command: str, folder: Path, program: Path) -> tuple[list[str], int]:
    environment = os.environ | {
        "PATH": f"{program.parent}:/usr/bin:/bin", "NO_COLOR": "1", "COLUMNS": "100", "LC_ALL": "C.UTF-8"}
    ended = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, text=True,
                           stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                           check=False)
    return ended.stdout.splitlines(), ended.returncode


def undeclared_numbers(page: Page, values: list[float]) -> list[str]:
    values = values + [float(number) for number in page.numbers]
    wrong = []
    for line, text in page.prose:
        for number in _PROSE_NUMBER.findall(_CODE.sub(" ", text)):
            if not is_rounded_from(number, values):
                wrong.append(f"{page.path}:{line}: {number} is in no command, output or file of the page")
    return wrong


def update(page: Page, printed: dict[int, list[str]]) -> None:
    """`printed` by the line of its command."""
    lines = page.path.read_text(encoding="utf-8").splitlines()
    for command in sorted((step for step in page.steps if isinstance(step, Command)),
                          key=lambda step: -step.line):
        if any("…" in line or line == "..." for line in command.output):
            continue
        begin = command.line + command.text.count("\n")
        new = list(printed[command.line])
        while new and not new[-1].strip():
            new.pop()
        lines[begin:begin + len(command.output)] = [line.rstrip() for line in new]
    page.path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def check(page: Page, source: Path, program: Path, renew: bool) -> list[str]:
    wrong: list[str] = []
    values: list[float] = []
    printed: dict[int, list[str]] = {}
    with tempfile.TemporaryDirectory(prefix="flexarm-page-") as name:
        folder = Path(name)
        (folder / "data").symlink_to(source / "data")
        for step in page.steps:
            if isinstance(step, File):
                (folder / step.name).write_text(step.content, encoding="utf-8")
                values += numbers_in(step.content)
                continue
            lines, status = run(step.text, folder, program)
            values += numbers_in(step.text + "\n" + "\n".join(lines))
            printed[step.line] = lines
            place = f"{page.path}:{step.line}: {step.text}"
            if status != step.status:
                wrong.append(f"{place}: status {status}, page: {step.status}\n  " + "\n  ".join(lines[-5:]))
            if difference := first_difference(step.output, lines):
                wrong.append(f"{place}: {difference}")
    if renew:
        update(page, printed)
    return wrong + undeclared_numbers(page, values)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--program", type=Path, required=True)
    parser.add_argument("--source", type=Path, required=True)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("pages", type=Path, nargs="+")
    arguments = parser.parse_args()
    wrong = []
    for path in arguments.pages:
        wrong += check(read_page(path), arguments.source.resolve(), arguments.program.resolve(),
                       arguments.update)
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
