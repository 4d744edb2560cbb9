"""A page of the manual as what it runs: commands with their output, files, and prose.

A block ```console has commands, each after "$ ", and below each the output that a reader sees
(standard output and standard error). A line "..." stands for any lines, "…" in a line for any text.
A last line "[status 1]" is the exit status where it is not 0.

An HTML comment before a block, alone in its line, says more:
  <!-- file: rig.toml -->       the block is the content of this file; the text above it names it
  <!-- not run: REASON -->      the block is not run
  <!-- numbers: 0.3 0.025 -->   numbers of the prose that no command prints, such as readings

Nothing else that such a comment holds is run: what a reader does not see, he cannot repeat.
"""

import re
from dataclasses import dataclass, field
from pathlib import Path


@dataclass
class Command:
    line: int  # of the page, from 1
    text: str
    output: list[str]
    status: int = 0


@dataclass
class File:
    name: str
    content: str


@dataclass
class Page:
    path: Path
    steps: list[Command | File] = field(default_factory=list)
    prose: list[tuple[int, str]] = field(default_factory=list)  # line, text
    numbers: list[str] = field(default_factory=list)  # allowed in the prose


_COMMENT = re.compile(r"^<!-- (file|not run|numbers): (.*) -->$")
_HIDDEN = re.compile(r"^<!--.*(run:|flexarm |\$ )")
_LINES_ABOVE_A_FILE = 4
_FENCE = re.compile(r"^(```+)\s*(\S*)")
_STATUS = re.compile(r"^\[status (\d+)\]$")


def _commands(first_line: int, lines: list[str], path: Path) -> list[Command]:
    commands: list[Command] = []
    for number, line in enumerate(lines, first_line):
        if line.startswith("$ "):
            commands.append(Command(number, line[2:], []))
        elif not commands:
            raise ValueError(f"{path}:{number}: output before the first command")
        elif commands[-1].text.endswith("\\") and not commands[-1].output:
            commands[-1].text += "\n" + line
        elif status := _STATUS.match(line):
            commands[-1].status = int(status[1])
        else:
            commands[-1].output.append(line)
    return commands


def read_page(path: Path) -> Page:
    page = Page(path)
    lines = path.read_text(encoding="utf-8").splitlines()
    said: dict[str, str] = {}
    at = 0
    while at < len(lines):
        line = lines[at]
        at += 1
        if comment := _COMMENT.match(line):
            key, value = comment.groups()
            if key == "numbers":
                page.numbers += value.split()
            else:
                said[key] = value
            continue
        if _HIDDEN.match(line):
            raise ValueError(f"{path}:{at}: a command that a reader does not see")
        fence = _FENCE.match(line)
        if not fence:
            page.prose.append((at, line))
            continue
        first = at
        while at < len(lines) and lines[at].rstrip() != fence[1]:
            at += 1
        if at == len(lines):
            raise ValueError(f"{path}:{first}: block without an end")
        block = lines[first:at]
        at += 1
        if "file" in said:
            above = [text for number, text in page.prose if number >= first - 1 - _LINES_ABOVE_A_FILE]
            if not any(f"`{said['file']}`" in text for text in above):
                raise ValueError(f"{path}:{first}: no text above the file names `{said['file']}`")
            page.steps.append(File(said["file"], "\n".join(block) + "\n"))
        elif fence[2] == "console" and "not run" not in said:
            page.steps += _commands(first + 1, block, path)
        said = {}
    return page
