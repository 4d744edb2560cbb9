"""Measurements, identification, diagnosis and planning are those of the program."""

import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

import flexarm

SOURCE = pathlib.Path(os.environ["FLEXARM_SOURCE_DIR"])
PROGRAM = os.environ["FLEXARM_PROGRAM"]


def run_program(*arguments, cwd):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, cwd=cwd)


def refusal(case, call):
    with case.assertRaises(flexarm.InputError) as caught:
        call()
    return str(caught.exception)


class OfSimulatedData(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.here = pathlib.Path(cls.folder.name)
        cls.file = cls.here / "rig" / "measurement.toml"
        arm = flexarm.Arm.paper().with_(damping_kelvin_voigt_s=1e-4)
        cls.truth = arm.with_effect("time_delay", delay=0.01)
        flexarm.simulate_experiment(
            cls.truth,
            [
                "multisine:rms=0.05,from=0.5,to=40,id=fit",
                "random:rms=0.05,to=40,id=check,purpose=validation",
            ],
            duration_s=2.0,
            sample_time_s=4e-3,
            noise=0.005,
            sensors=["hub_angle", "hub_velocity"],
            modes=8,
        ).write(cls.file.parent, hide_effects=["all"])

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_a_measurement_has_its_runs(self):
        measurement = flexarm.read_measurement(self.file)
        self.assertEqual([run.id for run in measurement.runs], ["fit", "check"])
        run = measurement.runs[0]
        self.assertEqual(len(run), 500)
        self.assertEqual(run["hub_velocity"].shape, (500,))
        self.assertEqual(measurement.runs[1].purpose, "validation")
        self.assertEqual(flexarm.read_arm(measurement.arm_file), self.truth.without_effect("time_delay"))
        self.assertEqual(run.to_xarray()["hub_angle"].attrs["units"], "rad")

    def test_a_diagnosis_is_the_programs_byte_for_byte(self):
        diagnosis = flexarm.diagnose(self.file)
        diagnosis.write_json(self.here / "ours.json")
        ended = run_program("diagnose", str(self.file), "--json", "theirs.json", cwd=self.here)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        ours = (self.here / "ours.json").read_text().replace("ours.extended", "theirs.extended")
        self.assertEqual(ours, (self.here / "theirs.json").read_text())
        self.assertEqual(
            (self.here / "ours.extended.toml").read_bytes(),
            (self.here / "theirs.extended.toml").read_bytes(),
        )
        self.assertEqual(diagnosis.to_json("theirs.extended.toml"), ours)

        self.assertEqual(diagnosis.verdict, "explained")
        (cause,) = diagnosis.causes
        self.assertEqual(cause.effect, "time_delay")
        delay = cause.parameters["delay"]
        self.assertLess(abs(delay.value - 0.01), 4 * delay.std_error)
        self.assertEqual(delay.unit, "s")
        self.assertGreater(cause.probability, 0.9)
        self.assertIn("time_delay", diagnosis.extended_arm.effects)
        self.assertLess(diagnosis.validation.after, diagnosis.validation.before)
        self.assertEqual({overlay.run for overlay in diagnosis.overlays}, {"fit", "check"})
        self.assertEqual(len(diagnosis.overlays[0].measured), len(diagnosis.overlays[0].after))
        self.assertEqual(diagnosis.to_dict()["verdict"], "explained")
        html = diagnosis._repr_html_()
        self.assertIn("time_delay", html)
        self.assertIn("<svg", html)

    def test_an_identification_is_the_programs(self):
        identification = flexarm.identify(self.file, runs=["fit"])
        run_program("identify", str(self.file), "--run", "fit", "--json", "theirs.json", cwd=self.here)
        self.assertEqual(identification.to_json(), (self.here / "theirs.json").read_text())
        pole = identification.poles[0]
        self.assertLess(abs(pole.frequency_Hz - 11.86), 0.5)
        self.assertGreater(pole.frequency_std_Hz, 0.0)
        self.assertTrue(all(root.feature == "zero" for root in identification.zeros))
        self.assertTrue(
            all(root.sensor == "hub_angle"
                for root in identification.roots(feature="zero", sensor="hub_angle"))
        )
        self.assertIn("Hz", identification._repr_html_())

    def test_errors_are_the_programs(self):
        missing = str(self.here / "none.toml")
        for ours, theirs in (
            (lambda: flexarm.diagnose(missing), ("diagnose", missing)),
            (lambda: flexarm.identify(missing), ("identify", missing)),
            (lambda: flexarm.diagnose(self.file, predictor="oracle"),
             ("diagnose", str(self.file), "--predictor", "oracle")),
            (lambda: flexarm.diagnose(self.file, policy={"beam": 2.5}),
             ("diagnose", str(self.file), "--policy", "beam=2.5")),
            (lambda: flexarm.diagnose(self.file, effects=["fricton"]),
             ("diagnose", str(self.file), "--effects", "fricton")),
            (lambda: flexarm.diagnose(self.file, exclude=["gravity on hub_angle"]),
             ("diagnose", str(self.file), "--exclude", "gravity on hub_angle")),
            (lambda: flexarm.identify(self.file, window="hanning"),
             ("identify", str(self.file), "--window", "hanning")),
            (lambda: flexarm.identify(self.file, detrend="cubic"),
             ("identify", str(self.file), "--detrend", "cubic")),
        ):
            line = run_program(*theirs, cwd=self.here).stderr.rstrip("\n")
            self.assertEqual(refusal(self, ours), line.removeprefix("--"))
        self.assertEqual(
            refusal(self, lambda: flexarm.diagnose(self.file, time_limit_s=0.0)),
            "time_limit_s = 0 s: must be a finite number above 0",
        )


class OfTables(unittest.TestCase):
    def test_modal_tables_are_read(self):
        measurement = flexarm.read_measurement(SOURCE / "data/paper/diagnosis/table-4.toml")
        entry = measurement.runs[0].entries[0]
        self.assertIn(entry.feature, ("pole", "zero"))
        self.assertGreater(entry.frequency_Hz, 0.0)

    def test_a_plan_is_the_programs(self):
        arm, plan_file = SOURCE / "data/plans/arm.toml", SOURCE / "data/plans/modal-table.toml"
        plan = flexarm.plan(flexarm.read_arm(arm), plan_file, effects=["payload_mass", "hub_inertia"])
        with tempfile.TemporaryDirectory() as folder:
            ended = run_program(
                "plan", str(arm), str(plan_file), "--effects", "payload_mass,hub_inertia",
                "--json", "theirs.json", "--write", "better.toml", cwd=folder,
            )
            self.assertEqual(ended.returncode, 0, ended.stderr)
            self.assertEqual(plan.to_json(), (pathlib.Path(folder) / "theirs.json").read_text())
            self.assertEqual(
                plan.improved_plan, (pathlib.Path(folder) / "better.toml").read_text()
            )
        self.assertEqual([one.effect for one in plan.effects], ["hub_inertia", "payload_mass"])
        self.assertGreater(plan.effects[0].minimum_detectable_value["factor"], 0.0)


if __name__ == "__main__":
    unittest.main()
