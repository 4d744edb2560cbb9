"""What the scripts that write documents of docs/ share: numbers, tables, templates, the program."""
import argparse
import json
import math
import os
import subprocess

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def number(value, digits=4):
    """With so many significant digits; "-" for what is missing."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return "-"
    if value == 0:
        return "0"
    decimals = max(0, digits - 1 - math.floor(math.log10(abs(value))))
    return f"{value:.{decimals}f}"


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "| " + " | ".join("---" for _ in header) + " |"]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines)


def filled(template, parts):
    """The template of scripts/ with each @key@ replaced, and @@ by @; every key must stand in it."""
    with open(os.path.join(ROOT, "scripts", template), encoding="utf-8") as file:
        text = file.read()
    for key, part in parts.items():
        assert f"@{key}@" in text, f"{template}: no @{key}@"
        text = text.replace(f"@{key}@", str(part))
    return text.replace("@@", "@")


def write(path, text):
    """Whole or not at all."""
    with open(path + ".tmp", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".tmp", path)


def arguments_of(usage, *more, options=None):
    """Command line: the arguments `more`, each a name and its help, then `program` (default: that
    of build/release); `options`: each a list of words out of its choices, empty if not given.
    Ends the script with status 2 if the program cannot be used."""
    parser = argparse.ArgumentParser(description=usage)
    for name, meaning in more:
        parser.add_argument(name, help=meaning)
    parser.add_argument("program", nargs="?", metavar="PROGRAM",
                        default=os.path.join(ROOT, "build/release/app/flexarm"),
                        help="default: build/release/app/flexarm")
    for name, choices in (options or {}).items():
        parser.add_argument(name, action="append", choices=choices, default=[],
                            help="can be repeated; default: all")
    arguments = parser.parse_args()
    arguments.program = os.path.abspath(arguments.program)
    if not os.access(arguments.program, os.X_OK):
        parser.error(f"no program {arguments.program}; build it first")
    return arguments


def result_of(program, command, folder):
    """What `flexarm COMMAND --json` writes."""
    path = os.path.join(folder, "result.json")
    subprocess.run([program, *command, "--json", path], check=True, stdout=subprocess.DEVNULL)
    with open(path, encoding="utf-8") as file:
        return json.load(file)
