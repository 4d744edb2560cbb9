"""Kinds of campaigns beside the sweep, which test_campaign.py has."""

import csv
import json
import os
import pathlib
import re
import statistics
import unittest

import flexarm
from flexarm.campaign.kinds import trials

from campaign_case import CampaignCase

EFFECTS = ["time_delay", "coulomb_friction"]
DIAGNOSE = """
kind = "diagnose"
[diagnose]
folder = "recordings"
effects = ["time_delay", "coulomb_friction"]
"""


class Manual(CampaignCase):
    def test_the_first_campaign_prints_what_it_says(self):
        text = (pathlib.Path(os.environ["FLEXARM_SOURCE_DIR"]) / "docs" / "campaign.md").read_text()
        campaign = re.search(r"^```toml\n(.*?)^```$", text, re.MULTILINE | re.DOTALL).group(1)
        shown = re.search(r"^```text\n\$ .*?\n(.*?)^```$", text, re.MULTILINE | re.DOTALL).group(1)
        path = self.write(campaign, "campaign.toml")
        status, output, _ = self.run_command(path, "--workers", 1)
        self.assertEqual((status, output.replace(f"{self.folder}/", "")), (0, shown))


class Recordings(CampaignCase):
    def record(self, name, delay_s):
        experiment = flexarm.simulate_experiment(
            flexarm.Arm.paper().with_effect("time_delay", delay=delay_s),
            ["multisine:rms=0.05,from=0.5,to=40"], duration_s=2.0, sample_time_s=0.004, noise=0.005,
            sensors=["hub_angle", "hub_velocity"],
        )
        experiment.write(self.folder / "recordings" / name, hide_effects=["all"])


class Diagnose(Recordings):
    def test_a_folder_of_measurements(self):
        for name, delay_s in (("b", 0.01), ("a", 0.02), ("c", 0.03)):
            self.record(name, delay_s)
        (self.folder / "recordings" / "c" / "multisine.csv").unlink()
        path = self.write(DIAGNOSE)
        out = self.folder / "c-results"
        report = self.folder / "report.html"
        status, output, _ = self.run_command(path, "--workers", 1, "--report", report)
        self.assertEqual(status, 1)
        self.page_is_whole(report.read_text())
        rows = self.rows(out)
        self.assertEqual(
            [row["measurement"] for row in rows],
            [f"recordings/{name}/measurement.toml" for name in "abc"],
        )
        self.assertEqual([row["state"] for row in rows], ["done", "done", "failed"], output)
        self.assertIn("multisine.csv", rows[2]["message"])
        self.assertEqual([row["cause_1"] for row in rows], ["time_delay", "time_delay", ""])
        self.assertIn("cause_4", rows[0], "as many as max_causes allows")
        self.assertNotIn("cause_5", rows[0])
        # The file of the task is the document of `flexarm diagnose --json`.
        name = rows[0]["task"]
        task = json.loads((out / "tasks" / name[:2] / f"{name}.json").read_text())
        direct = flexarm.diagnose(
            self.folder / "recordings/a/measurement.toml", effects=EFFECTS, progress=False
        )
        self.assertEqual(task["result"], direct.to_dict())
        # Bytes of a file that it reads are part of a task: a changed record is a new one.
        record = self.folder / "recordings/b/multisine.csv"
        record.write_text(record.read_text().replace("\n0,0,", "\n0,0.0,", 1) + "\n")
        status, output, _ = self.run_command(path, "--workers", 1, "--report", report)
        self.assertIn("1 of them from before", output)
        page = report.read_text()
        slowest = page[page.index("<h2>Slowest"):page.index("<h2>All tasks")]
        self.assertEqual(slowest.count("<tr>"), 1 + 3, "without the task of the former record")
        again = self.rows(out)
        self.assertEqual(again[0], rows[0])
        self.assertNotEqual(again[1]["task"], rows[1]["task"])

    def page_is_whole(self, page):
        self.assertIn("<strong>2</strong> of 3 tasks have a result", page)
        headings = re.findall(r"<h2>(.*?)</h2>", page)
        self.assertEqual(headings, [
            "Without a result", "Worst: largest estimation_nrmse_after", "Count of verdict",
            "Slowest", "All tasks",
        ])
        self.assertLess(page.index("recordings/c/"), page.index("recordings/a/"))
        failed = page[page.index("Without a result"):page.index("Worst:")]
        self.assertEqual(re.findall(r'<th scope="col">(.*?)</th>', failed),
                         ["index", "state", "message", "measurement"])
        # It opens without a network, and marks are closed.
        self.assertNotIn("http", page)
        for mark in ("table", "section", "tr", "td"):
            self.assertEqual(len(re.findall(f"<{mark}[ >]", page)), page.count(f"</{mark}>"), mark)

    def test_a_report_that_cannot_be_written_is_refused_first(self):
        self.record("a", 0.01)
        for report, line in (("absent/x.html", "no such folder"), ("c.toml", "must end in .html")):
            self.assertIn(line, self.refused(DIAGNOSE, "--report", self.folder / report))

    def test_what_is_to_be_diagnosed_is_checked_first(self):
        (self.folder / "recordings").mkdir()
        for old, new, line in (
            ('"recordings"', '"recordings"', "has no measurement.toml"),
            ('"recordings"', '"absent"', "must be a folder"),
            ('folder = "recordings"', "", "give either folder or measurements"),
            ('folder = "recordings"', 'measurements = ["x.toml"]', "x.toml: no such file"),
            ("coulomb_friction", "coulomb_frictoin", "(did you mean coulomb_friction?)"),
            ('"recordings"', '"recordings"\npredictor = "best"', "must be one of auto, output_"),
        ):
            with self.subTest(new):
                self.assertIn(line, self.refused(DIAGNOSE.replace(old, new, 1)))


PLAN = """
kind = "plan"
[plan]
arm = "arm.toml"
plan = "plan.toml"
effects = ["hub_inertia", "payload_mass"]
draws = 3
"""


class Plan(CampaignCase):
    def test_monte_carlo_of_the_uncertain_numbers(self):
        arm = flexarm.Arm.paper().with_uncertainties({"beam.flexural_rigidity": 0.05})
        arm.write(self.folder / "arm.toml")
        self.write('[[run]]\nid = "modal"\nkind = "modal"\npoles = 3\n', "plan.toml")
        self.assertEqual(self.run_command(self.write(PLAN), "--workers", 1)[0], 0)
        rows = self.rows(self.folder / "c-results")
        self.assertEqual([row["draw"] for row in rows], ["0", "1", "2", "3"])
        rigidity = [float(row["beam.flexural_rigidity"]) for row in rows]
        self.assertEqual(rigidity[0], arm.beam_flexural_rigidity_N_m2)
        self.assertEqual(len(set(rigidity)), 4)
        for drawn in rigidity[1:]:
            self.assertLess(abs(drawn / rigidity[0] - 1.0), 0.25)  # five standard deviations
        changed = arm.with_(
            beam_flexural_rigidity_N_m2=rigidity[2],
            beam_youngs_modulus_Pa=arm.beam_youngs_modulus_Pa * (rigidity[2] / rigidity[0]),
        )
        direct = flexarm.plan(
            changed, self.folder / "plan.toml",
            effects=["hub_inertia", "payload_mass"], progress=False,
        )
        for effect in direct.effects:
            self.assertEqual(rows[2][f"{effect.effect}.detectable"], "yes")
            (parameter, value), = effect.minimum_detectable_value.items()
            self.assertEqual(float(rows[2][f"{effect.effect}.{parameter}"]), value)

    def test_an_arm_without_uncertain_numbers_is_refused(self):
        flexarm.Arm.paper().write(self.folder / "arm.toml")
        self.assertIn('plan.arm = "arm.toml": has no uncertain number', self.refused(PLAN))


class Bootstrap(Recordings):
    CAMPAIGN = """
kind = "bootstrap"
[bootstrap]
measurement = "recordings/a/measurement.toml"
diagnosis = "a.json"
effects = ["time_delay", "coulomb_friction"]
draws = 3
"""

    def test_estimates_scatter_as_their_standard_errors_say(self):
        self.record("a", 0.013)
        diagnosis = flexarm.diagnose(
            self.folder / "recordings/a/measurement.toml", effects=EFFECTS, progress=False
        )
        diagnosis.write_json(self.folder / "a.json")
        status, output, errors = self.run_command(self.write(self.CAMPAIGN), "--workers", 2)
        self.assertEqual(status, 0, output + errors)
        rows = self.rows(self.folder / "c-results")
        self.assertEqual([row["time_delay.named"] for row in rows], ["yes"] * 4)
        delays_s = [float(row["time_delay.delay"]) for row in rows]
        estimate = diagnosis.causes[0].parameters["delay"]
        self.assertEqual(delays_s[0], estimate.value)
        self.assertEqual(len(set(delays_s)), 4)
        for delay_s in delays_s:
            self.assertLess(abs(delay_s - estimate.value), 6.0 * estimate.std_error)
        # The noise is as large as that of the measurement, within what 500 samples leave open.
        for row in rows[1:]:
            ratio = float(row["estimation_nrmse_after"]) / float(rows[0]["estimation_nrmse_after"])
            self.assertLess(abs(ratio - 1.0), 0.2)
        with open(self.folder / "c-results" / "bootstrap.csv", newline="") as stream:
            row = next(one for one in csv.DictReader(stream) if one["cause"] == "time_delay")
        self.assertEqual((row["parameter"], row["unit"]), ("delay", "s"))
        self.assertEqual((row["draws"], row["named"]), ("3", "3"))
        self.assertEqual(float(row["measurement"]), delays_s[0])
        self.assertAlmostEqual(float(row["mean"]), statistics.mean(delays_s[1:]), delta=1e-15)
        spread = statistics.stdev(delays_s[1:])
        self.assertAlmostEqual(float(row["standard deviation"]), spread, delta=1e-9 * spread)
        self.assertEqual(float(row["50.0 %"]), statistics.median(delays_s[1:]))
        low, high = sorted(delays_s[1:])[:: 2]
        self.assertTrue(low < float(row["2.5 %"]) < float(row["97.5 %"]) < high)

    def test_what_cannot_be_simulated_is_refused(self):
        self.record("a", 0.01)
        self.assertIn(
            'bootstrap.diagnosis = "a.json": must be a file of flexarm diagnose',
            self.refused(self.CAMPAIGN),
        )
        measurement = self.folder / "recordings/a/measurement.toml"
        measurement.write_text(measurement.read_text() + 'initial = "free"\n')
        self.assertIn(
            "run multisine: must be an open-loop time run from rest", self.refused(self.CAMPAIGN)
        )


# Takes the options of the program `trials`; "slow 2" cannot be made.
TRIALS = """#!/usr/bin/python3
import pathlib, sys
options = dict(zip(sys.argv[1::2], sys.argv[2::2]))
if sys.argv[1] != "--trials" or not options["--trials"].isdecimal():
    sys.exit("--trials: needs a number")
names = [f"slow {k}" for k in range(int(options["--trials"]))]
if "--list" in sys.argv:
    print("\\n".join(f"{one} folder" for one in names))
    sys.exit()
if options["--only"] not in names or options["--only"] == "slow 2":
    sys.exit(options["--only"] + ": could not be made")
results = pathlib.Path(options["--results"])
columns = "COLUMNS".split(",")
if not results.exists():
    line = [options["--only"] if one == "id" else one.upper() for one in columns]
    results.write_text(",".join(columns) + "\\n" + ",".join(line) + "\\n")
if "--scorecard" in options:
    pathlib.Path(options["--scorecard"]).write_text(results.read_text())
"""


class Trials(CampaignCase):
    CAMPAIGN = """
kind = "trials"
[trials]
program = "trials"
flexarm = "trials"
built_from = "v1"
[[trials.set]]
options = "--trials 2"
[[trials.set]]
options = "--trials 3"
"""

    def program(self):
        columns = ",".join([*trials.columns(None), "time [s]"])
        self.write(TRIALS.replace("COLUMNS", columns), "trials").chmod(0o755)

    def test_each_trial_is_a_task_and_the_program_makes_the_scorecard(self):
        self.program()
        status, output, _ = self.run_command(self.write(self.CAMPAIGN), "--workers", 1)
        self.assertEqual(status, 1)
        self.assertTrue(output.startswith("task 2 failed: slow 2: could not be made\n"), output)
        out = self.folder / "c-results"
        self.assertEqual([row["id"] for row in self.rows(out)], ["slow 0", "slow 1", "slow 2"])
        self.assertEqual(self.rows(out)[0]["verdict"], "VERDICT")
        self.assertNotIn("time [s]", self.rows(out)[0])
        card = (out / "scorecard.md").read_text()
        self.assertEqual(card, (out / "trials.csv").read_text())
        self.assertEqual([line.split(",")[0] for line in card.splitlines()],
                         ["id", "slow 0", "slow 1"])

    def test_options_that_the_program_refuses_are_refused(self):
        self.program()
        text = self.CAMPAIGN.replace("--trials 3", "--trials x")
        self.assertIn("--trials: needs a number", self.refused(text))


if __name__ == "__main__":
    unittest.main()
