#!/usr/bin/python3
"""Tests of the program that checks the pages of the manual: what it must find."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from output import first_difference, is_rounded_from

HERE = Path(__file__).parent


class Output(unittest.TestCase):
    def test_agrees_to_one_in_a_thousand(self):
        self.assertIsNone(first_difference(["pole 11.86 Hz"], ["pole   11.8618 Hz"]))
        self.assertIsNotNone(first_difference(["pole 11.86 Hz"], ["pole 11.89 Hz"]))

    def test_agrees_to_one_of_the_last_of_three_digits(self):
        self.assertIsNone(first_difference(["0.675 of it"], ["0.674 of it"]))
        self.assertIsNone(first_difference(["2.94e-06"], ["2.93e-06"]))
        self.assertIsNotNone(first_difference(["0.675 of it"], ["0.673 of it"]))
        self.assertIsNotNone(first_difference(["12 runs"], ["13 runs"]))

    def test_words_must_be_the_same(self):
        self.assertIsNotNone(first_difference(["explained by coulomb_friction"], ["explained by backlash"]))
        self.assertIsNotNone(first_difference(["a", "b"], ["a"]))
        self.assertIsNotNone(first_difference(["a"], ["a", "b"]))

    def test_left_out_lines_and_text(self):
        self.assertIsNone(first_difference(["a", "...", "c 2"], ["a", "b", "b", "c 2"]))
        self.assertIsNone(first_difference(["a", "..."], ["a", "b"]))
        self.assertIsNotNone(first_difference(["a", "...", "d"], ["a", "b", "c"]))
        self.assertIsNone(first_difference(["took … s in all"], ["took 3.217 s in all"]))
        self.assertIsNotNone(first_difference(["took … s in all"], ["took 3.217 min in all"]))

    def test_a_number_of_prose_is_rounded_from_a_printed_one(self):
        self.assertTrue(is_rounded_from("11.86", [11.8618]))
        self.assertTrue(is_rounded_from("12", [11.8618]))
        self.assertFalse(is_rounded_from("11.87", [11.8618]))


class Pages(unittest.TestCase):
    def check(self, text: str) -> subprocess.CompletedProcess:
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "data").mkdir()
            page = Path(folder) / "page.md"
            page.write_text(text, encoding="utf-8")
            return subprocess.run(
                [sys.executable, HERE / "check_pages.py", "--program", "/bin/true", "--source", folder, page],
                capture_output=True, text=True, check=False)

    def test_a_page_that_is_right(self):
        ended = self.check("Write `a.txt`:\n\n<!-- file: a.txt -->\n```\n3.52\n```\nIt is 3.5.\n```console\n$ cat a.txt\n3.52\n```\n")
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))

    def test_a_wrong_output(self):
        ended = self.check("```console\n$ echo 3\n4\n```\n")
        self.assertEqual(ended.returncode, 1)
        self.assertIn("page.md:2: echo 3: page: '4'; printed: '3'", ended.stderr)

    def test_a_wrong_status(self):
        self.assertEqual(self.check("```console\n$ false\n```\n").returncode, 1)
        self.assertEqual(self.check("```console\n$ false\n[status 1]\n```\n").returncode, 0)

    def test_a_number_that_nothing_prints(self):
        ended = self.check("The pole is at 11.9 Hz.\n```console\n$ echo 11.8\n11.8\n```\n")
        self.assertEqual(ended.returncode, 1)
        self.assertIn("page.md:1: 11.9", ended.stderr)
        self.assertEqual(self.check("<!-- numbers: 11.9 -->\nThe pole is at 11.9 Hz.\n").returncode, 0)

    def test_a_command_that_a_reader_does_not_see(self):
        for hidden in ["run: touch a", "flexarm modes", "$ touch a"]:
            ended = self.check(f"<!-- {hidden} -->\n```console\n$ true\n```\n")
            self.assertNotEqual(ended.returncode, 0)
            self.assertIn("page.md:1: a command that a reader does not see", ended.stderr)

    def test_a_file_whose_name_a_reader_does_not_see(self):
        ended = self.check("Write this:\n\n<!-- file: a.txt -->\n```\n3\n```\n")
        self.assertNotEqual(ended.returncode, 0)
        self.assertIn("page.md:4: no text above the file names `a.txt`", ended.stderr)

    def test_a_block_without_an_end(self):
        self.assertNotEqual(self.check("```console\n$ true\n").returncode, 0)


class CommandsOfTheText(unittest.TestCase):
    """Of a program that knows `compare` and its --measured."""

    def check(self, text: str) -> str:
        with tempfile.TemporaryDirectory() as folder:
            for name, content in [("data/a.toml", ""), ("scripts/run", "# Usage: scripts/run [--fast]")]:
                (Path(folder) / name).parent.mkdir(exist_ok=True)
                (Path(folder) / name).write_text(content, encoding="utf-8")
            program = Path(folder) / "program"
            program.write_text('#!/bin/sh\n[ "$1" = --help ] && exit\n'
                               '[ "$1" = compare ] && echo "--measured FILE"\n', encoding="utf-8")
            program.chmod(0o755)
            page = Path(folder) / "page.md"
            page.write_text(text, encoding="utf-8")
            return subprocess.run(
                [sys.executable, HERE / "check_commands.py", "--program", program, "--source", folder, page],
                capture_output=True, text=True, check=False).stdout

    def test_what_there_is(self):
        page = "`flexarm compare data/NAME.toml --measured=m.csv`, `scripts/run --fast`, `flexarm compare --help`"
        self.assertEqual(self.check(page), "3 commands of 1 pages\n")

    def test_what_there_is_not(self):
        for code, fault in [("flexarm compute", "flexarm has no command compute"),
                            ("flexarm compare --out", "flexarm compare has no option --out"),
                            ("flexarm compare data/b.toml", "no data/b.toml in the repository"),
                            ("scripts/walk", "no scripts/walk in the repository"),
                            ("scripts/run --slow", "scripts/run has no option --slow")]:
            self.assertIn(f"page.md:1: {fault}: {code}\n", self.check(f"Use `{code}`."))


if __name__ == "__main__":
    unittest.main()
