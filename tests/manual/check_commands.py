#!/usr/bin/python3
"""Looks up the commands that pages name in their text, as `flexarm compare --measured`.

A command and each option must be in the program's help. A script must be in the repository and name
its options, unless it hands them on (OPTION in its usage). A path under data/ must exist; capitals
in it (NAME) stand for any name. Commands in blocks are run instead (check_pages.py).

Usage: check_commands.py --program PATH --source ROOT PAGE ...
"""

import argparse
import re
import subprocess
import sys
from functools import cache
from pathlib import Path

_CODE = re.compile(r"`([^`\n]+)`")
_OPTION = re.compile(r"--[A-Za-z][\w-]*")
_PLACEHOLDER = re.compile(r"\b[A-Z]{2,}\b")


@cache
def help_of(*command: str) -> str | None:
    """None: there is no such command."""
    ended = subprocess.run([*command, "--help"], text=True, capture_output=True, check=False)
    return ended.stdout if ended.returncode == 0 else None


def missing_options(words: list[str], known: str) -> list[str]:
    allowed = set(_OPTION.findall(known)) | {"--help"}
    asked = [_OPTION.match(word) for word in words]
    return [found.group() for found in asked if found and found.group() not in allowed]


def faults(code: str, program: Path, source: Path) -> list[str]:
    words = code.split()
    if words[0].startswith("scripts/"):
        script = source / words[0]
        if not script.exists():
            return [f"no {words[0]} in the repository"]
        text = script.read_text(encoding="utf-8")
        return [] if "OPTION" in text else [
            f"{words[0]} has no option {option}" for option in missing_options(words, text)]
    command = [str(program)]
    if len(words) > 1 and re.fullmatch(r"[a-z]+", words[1]):
        command.append(words[1])
    known = help_of(*command)
    if known is None:
        return [f"flexarm has no command {words[1]}"]
    made = [f"{' '.join(['flexarm', *command[1:]])} has no option {option}"
            for option in missing_options(words, known)]
    made += [f"no {word} in the repository" for word in words
             if word.startswith("data/") and not list(source.glob(_PLACEHOLDER.sub("*", word)))]
    return made


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", type=Path, required=True)
    parser.add_argument("--source", type=Path, required=True)
    parser.add_argument("pages", type=Path, nargs="+")
    arguments = parser.parse_args()
    wrong, looked_up = [], 0
    for page in arguments.pages:
        for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), start=1):
            for code in _CODE.findall(line):
                if not re.match(r"(flexarm|scripts/[\w-]+)( |$)", code):
                    continue
                looked_up += 1
                wrong += [f"{page}:{number}: {fault}: {code}"
                          for fault in faults(code, arguments.program, arguments.source)]
    print("\n".join(wrong) if wrong else f"{looked_up} commands of {len(arguments.pages)} pages")
    return 1 if wrong or not looked_up else 0


if __name__ == "__main__":
    sys.exit(main())
