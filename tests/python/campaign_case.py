"""What tests of campaigns share."""

import contextlib
import csv
import io
import pathlib
import tempfile
import time
import unittest

from flexarm.campaign import command

WAITS_S = 20.0
RESULTS = ("results.csv", "results.json", "failures.json")


class CampaignCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, text, name="c.toml"):
        path = self.folder / name
        path.write_text(text)
        return path

    def run_command(self, *arguments):
        """Exit status, standard output, standard error."""
        output, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors):
            status = command.main([str(one) for one in arguments])
        return status, output.getvalue(), errors.getvalue()

    def refused(self, text, *arguments):
        """The one line of a campaign that is refused, and leaves nothing."""
        path = self.write(text)
        status, output, errors = self.run_command(path, *arguments)
        self.assertEqual((status, output), (2, ""))
        self.assertEqual(errors.count("\n"), 1, errors)
        self.assertFalse((self.folder / "c-results").exists())
        return errors.removeprefix("flexarm-campaign: ").removeprefix(f"{path}: ").rstrip("\n")

    def wait_for(self, condition):
        begun = time.monotonic()
        while not condition():
            self.assertLess(time.monotonic() - begun, WAITS_S)
            time.sleep(0.02)

    def results(self, out):
        return [(out / name).read_bytes() for name in RESULTS]

    def rows(self, out):
        with open(out / "results.csv", newline="") as stream:
            return list(csv.DictReader(stream))

    def begun(self):
        """How often each task of a probe began."""
        lines = (self.folder / "begun").read_text().split()
        return {number: lines.count(number) for number in lines}
