#!/usr/bin/python3
"""Runs flexarm on inputs that users reported, and holds its answers against the right values.

The folder REPORTED_INPUTS has one folder an input, with a README that states the commands and the
right values; without it the tests are skipped. FLEXARM_PROGRAM is the program.

Usage: reported_inputs.py [CLASS[.TEST] ...]
"""

import csv
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

_PROGRAM = os.environ.get("FLEXARM_PROGRAM", "flexarm")
_INPUTS = Path(os.environ.get("REPORTED_INPUTS", "."))


class ReportedInput(unittest.TestCase):
    def setUp(self) -> None:
        if not _INPUTS.is_dir():
            self.skipTest(f"no folder {_INPUTS}")
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.place = Path(place.name)

    def take(self, number: int) -> None:
        """Copies the files of an input to the folder that the program runs in."""
        (folder,) = _INPUTS.glob(f"{number:02d}-*")
        for file in folder.iterdir():
            shutil.copyfile(file, self.place / file.name)

    def run_program(self, *arguments: str, status: int = 0) -> str:
        """Runs a command in that folder; returns what it prints on both streams."""
        ended = subprocess.run([_PROGRAM, *arguments], cwd=self.place, stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        self.assertEqual(ended.returncode, status, f"{' '.join(arguments)}\n{ended.stdout}")
        return ended.stdout

    def columns(self, file: str) -> dict[str, list[float]]:
        """Reads a record; the name of a column is that before its unit."""
        with open(self.place / file, encoding="utf-8", newline="") as stream:
            rows = [row for row in csv.reader(stream) if row and not row[0].startswith("#")]
        names = [name.split(" [")[0] for name in rows[0]]
        return {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(names)
                if name not in ("sensor", "coherence")}

    def json(self, file: str) -> dict:
        return json.loads((self.place / file).read_text(encoding="utf-8"))

    def imported(self, *arguments: str, out: str = "o") -> dict[str, list[float]]:
        """Imports to a new folder; returns the columns of its only record."""
        shutil.rmtree(self.place / out, ignore_errors=True)
        self.run_program("import", *arguments, "--out", out)
        (record,) = (self.place / out).glob("*.csv")
        return self.columns(f"{out}/{record.name}")


class WrongUnit(ReportedInput):
    """03: a unit is not wrong where the arm file lacks a spring."""

    def check(self, true: str, filed: str, *simulation: str) -> None:
        self.take(3)
        self.run_program("simulate", true, "--modes", "25", "--period", "0.002", "--sensor",
                         "hub_angle,tip_acceleration", "--out", "run", *simulation)
        (self.place / "run/arm.toml").write_text(filed, encoding="utf-8")
        out = self.run_program("identify", "run/measurement.toml")
        for claim in ("wrong unit", "wrong scale"):
            self.assertNotIn(claim, out)

    def test_without_the_spring(self) -> None:
        self.take(3)
        filed = (self.place / "without-spring.toml").read_text(encoding="utf-8")
        self.check("true.toml", filed, "--excitation", "random:rms=0.02,from=0.1,to=40,id=a,seed=3",
                   "--duration", "40", "--noise", "0.01")

    def test_of_another_rigidity(self) -> None:
        self.take(3)
        filed = (self.place / "stiff.toml").read_text(encoding="utf-8").replace("= 2.3", "= 1.36")
        self.check("stiff.toml", filed, "--excitation", "random:rms=0.02,from=0.5,to=240,id=a,seed=3",
                   "--duration", "20", "--noise", "0.05")


class EmptyCells(ReportedInput):
    """04: cells without a number are missing samples."""

    def setUp(self) -> None:
        super().setUp()
        self.take(4)

    def test_a_gap_is_filled(self) -> None:
        for file in ("empty.csv", "nan.csv"):
            record = self.imported(file)
            self.assertTrue(all(map(math.isfinite, record["hub_angle"])))
            self.assertEqual(record, self.imported(file, "--fill-gaps", "10"))

    def test_rows_beyond_those_asked_for_do_not_matter(self) -> None:
        for choice in (("--rows", "103:"), ("--times", "0.52:"), ("--rows", ":99"),
                       ("--run", "a=rows:1:99")):
            self.imported("nan.csv", *choice)


class Signals(ReportedInput):
    """05, 06, 14, 16: signals in MATLAB files and in text."""

    def check(self, *arguments: str, samples: int = 301) -> None:
        with self.subTest(arguments[0]):
            record = self.imported(*arguments)
            self.assertEqual(len(record["time"]), samples)
            self.assertGreater(max(map(abs, record["torque"])), 0.0)
            self.assertLess(record["hub_angle"][0], 0.0)

    def test_structures_and_cells_are_read(self) -> None:
        self.take(5)
        for file in ("scope-two-signals.mat", "recorder.mat", "threeD.mat"):
            self.check(file)
        # The cells have no names: they are listed, to be assigned.
        self.assertIn("log{2}", self.run_program("import", "cell.mat", "--out", "o2", status=2))
        self.check("cell.mat", "--column", "time=log{1}", "--column", "torque=log{2}", "--column",
                   "hub_angle=log{3}")

    def test_rows_of_a_matrix_are_read(self) -> None:
        self.take(6)
        columns = ("time=#1", "torque=#2", "hub_angle=#3")
        self.check("tofile.mat", *(word for column in columns for word in ("--column", column)))
        self.assertAlmostEqual(self.columns("o/tofile.csv")["hub_angle"][0], -0.01477601, places=8)

    def test_matlab_7_3_and_4_are_read(self) -> None:
        self.take(14)
        for file in ("v73.mat", "v4.mat"):
            self.check(file)

    def test_exponents_of_fortran_are_read(self) -> None:
        self.take(16)
        columns = ("time=#1", "torque=#2", "hub_angle=#3")
        self.check("fortran.txt", *(word for column in columns for word in ("--column", column)),
                   samples=600)


class Responses(ReportedInput):
    """07, 09: frequency responses in columns, and their units."""

    FIRST = complex(-9.19997, -2.92844)  # 1/(0.01 (j w)^2 + 0.01 j w) at 0.5 Hz, to its digits

    def check(self, first: complex, *arguments: str) -> None:
        with self.subTest(arguments[0]):
            record = self.imported(*arguments)
            self.assertAlmostEqual(record["re"][0], first.real, delta=1e-4 * abs(first))
            self.assertAlmostEqual(record["im"][0], first.imag, delta=1e-4 * abs(first))

    def test_columns_are_read(self) -> None:
        self.take(7)
        for file in ("bode.csv", "bode2.csv", "reim.csv", "frf2.mat"):
            self.check(self.FIRST, file)

    def test_units_of_a_response_are_taken_apart(self) -> None:
        self.take(9)
        rad = self.imported("r_rad.uff")
        first = complex(rad["re"][0], rad["im"][0])
        self.check(first, "r_radNm.uff")
        self.check(first * math.pi / 180.0, "r_deg.uff")
        self.assertIn("N m", self.run_program("import", "r_acc.uff", "--out", "o2", status=2))


class Instruments(ReportedInput):
    """08, 13: files of LabVIEW and of oscilloscopes, times of the clock."""

    def test_labview(self) -> None:
        self.take(8)
        for file in sorted(self.place.glob("*.lvm")):
            with self.subTest(file.name):
                record = self.imported(file.name)
                self.assertEqual(len(record["time"]), 200)
                self.assertAlmostEqual(record["time"][199], 199 * 0.005, places=9)
                self.assertEqual(record["torque"][0], 0.0)
                self.assertAlmostEqual(record["hub_angle"][0], -0.014776, places=6)

    def test_oscilloscopes_and_clocks(self) -> None:
        self.take(13)
        for arguments in (("rigol.csv", "--period", "0.002", "--column", "torque=CH1:V:0.5",
                           "--column", "hub_angle=CH2:V:1"),
                          ("tek.csv", "--column", "time=#4", "--column", "torque=#5", "--compute",
                           "hub_angle=[#5]"), ("clock.csv",), ("iso.csv",)):
            with self.subTest(arguments[0]):
                record = self.imported(*arguments)
                self.assertEqual(len(record["time"]), 600)
                self.assertAlmostEqual(record["time"][599] - record["time"][0], 599 * 0.002, places=9)


class Units(ReportedInput):
    """10: SCALE is in the unit before it."""

    def test_a_scale_counts_once(self) -> None:
        self.take(10)
        common = ("deg.csv", "--column", "time=t:ms", "--column", "torque=tau")
        for column, right in (("hub_angle=th:deg", math.pi / 2.0), ("hub_angle=th:mrad", 0.09),
                              ("hub_velocity=th:rpm", 90.0 * 2.0 * math.pi / 60.0),
                              ("hub_velocity=th:deg/s", math.pi / 2.0)):
            quantity = column.split("=")[0]
            factor = {"deg": "pi/180", "mrad": "0.001", "rpm": "2*pi/60", "deg/s": "pi/180"}
            for scale in ("", ":" + factor[column.split(":")[1]]):
                with self.subTest(column + scale):
                    record = self.imported(*common, "--column", column + scale)
                    self.assertAlmostEqual(max(record[quantity]), right, places=9)
            with self.subTest(column + ":2"):
                record = self.imported(*common, "--column", column + ":2")
                self.assertAlmostEqual(max(record[quantity]), 2.0 * right, places=9)


class Poles(ReportedInput):
    """11: an alias is no pole, and a peak has one order."""

    TRUE_HZ = {1: 18.134, 2: 59.9815, 3: 161.9332}

    def test_aliases_and_orders(self) -> None:
        self.take(11)
        self.run_program("simulate", "true.toml", "--modes", "25", "--excitation",
                         "random:rms=0.02,from=0.5,to=240,id=a,seed=3", "--duration", "20",
                         "--period", "0.002", "--sensor", "hub_angle,tip_acceleration", "--noise",
                         "0.05", "--out", "run")
        for rigidity in ("1.36", "3.6", "2.3"):
            with self.subTest(rigidity):
                arm = (self.place / "true.toml").read_text(encoding="utf-8")
                (self.place / "run/arm.toml").write_text(arm.replace("= 2.3", f"= {rigidity}"),
                                                         encoding="utf-8")
                self.run_program("identify", "run/measurement.toml", "--json", "found.json")
                fitted = set()
                for reading in self.json("found.json")["readings"]:
                    # Circles and peaks are coarser than the rational fit.
                    within = 2e-3 if reading["method"] == "fit" else 0.07
                    poles = {root["order"]: root["frequency_Hz"] for root in reading["roots"]
                             if root["feature"] == "pole" and root["order"] is not None}
                    self.assertLessEqual(set(poles), set(self.TRUE_HZ), "an alias is no pole")
                    for order, found_Hz in poles.items():
                        true_Hz = self.TRUE_HZ[order]
                        self.assertAlmostEqual(found_Hz, true_Hz, delta=within * true_Hz)
                    if reading["method"] == "fit":
                        fitted |= set(poles)
                self.assertEqual(fitted, set(self.TRUE_HZ))


class LateTorque(ReportedInput):
    """12: a torque that is logged one sample late is a negative time delay."""

    def test_is_named(self) -> None:
        self.take(12)
        self.run_program("simulate", "arm.toml", "--torque", "a_tq.csv", "--torque", "b_tq.csv",
                         "--modes", "25", "--sensor", "hub_angle,tip_acceleration", "--noise",
                         "0.01", "--out", "run")
        subprocess.run(["/usr/bin/python3", "late.py", "run/a_tq.csv", "run/b_tq.csv"],
                       cwd=self.place, check=True)
        self.run_program("diagnose", "run/measurement.toml", "--effects",
                         "time_delay,payload_mass,coulomb_friction", "--json", "d.json")
        (cause,) = self.json("d.json")["causes"]
        self.assertEqual(cause["effect"], "time_delay")
        self.assertAlmostEqual(cause["parameters"]["delay"]["value"], -0.002, delta=2e-5)


class FreeDecay(ReportedInput):
    """15: a free decay is identified and diagnosed."""

    def test_poles(self) -> None:
        self.take(15)
        self.run_program("import", "free.csv", "--initial", "free", "--arm", "arm.toml", "--out", "run")
        self.run_program("identify", "run/measurement.toml", "--json", "found.json")
        (reading,) = self.json("found.json")["readings"]
        poles = sorted(reading["roots"], key=lambda root: root["frequency_Hz"])
        for pole, (frequency_Hz, damping) in zip(poles, ((2.9, 0.010), (18.0, 0.012)), strict=True):
            self.assertAlmostEqual(pole["frequency_Hz"], frequency_Hz, delta=5e-3 * frequency_Hz)
            self.assertAlmostEqual(pole["damping_ratio"], damping, delta=1e-3)
        self.run_program("diagnose", "run/measurement.toml", "--time-limit", "20")


class Lists(ReportedInput):
    """17: --torque takes as many files as its help says."""

    def test_torque_of_two_files(self) -> None:
        self.take(17)
        if "--torque FILE,..." in self.run_program("simulate", "--help"):
            self.run_program("simulate", "plain.toml", "--torque", "a_tq.csv,b_tq.csv", "--out", "o")
        else:
            self.run_program("simulate", "plain.toml", "--torque", "a_tq.csv", "--torque", "b_tq.csv",
                             "--out", "o")
        self.assertEqual({"a_tq.csv", "b_tq.csv"}, {file.name for file in self.place.glob("o/*.csv")})


class Gaps(ReportedInput):
    """18: a filled gap leaves the run at rest."""

    def test_starts_at_rest(self) -> None:
        self.take(18)
        record = self.imported("gap.csv")
        self.assertEqual(record["time"][0], 0.0)
        self.assertEqual(len(record["time"]), 400)
        self.assertNotIn('"free"', (self.place / "o/measurement.toml").read_text(encoding="utf-8"))


class DampedZeros(ReportedInput):
    """19: the damping of a hub zero is that of the arm with its hub held."""

    def test_kelvin_voigt_alone(self) -> None:
        self.take(19)
        self.run_program("import", "modes.csv", "--kind", "modal", "--arm", "arm.toml", "--out", "m")
        self.run_program("diagnose", "m/measurement.toml", "--effects", "payload_mass", "--json", "d.json")
        roots = self.json("d.json")["residual"]["roots"]
        (zero,) = [root for root in roots if root["feature"] == "zero" and root["order"] == 2]
        self.assertAlmostEqual(zero["damping_ratio"]["before"], 0.0288, places=4)


if __name__ == "__main__":
    unittest.main(verbosity=2)
