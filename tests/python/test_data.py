"""Measurements of arrays, dicts and DataFrames, and imported logs: as those of files."""

import os
import pathlib
import subprocess
import tempfile
import unittest
import warnings

import numpy as np
import pandas

import flexarm

PROGRAM = os.environ["FLEXARM_PROGRAM"]
SAMPLE_TIME_S = 4e-3


def refusal(case, call, error=flexarm.InputError):
    with case.assertRaises(error) as caught:
        call()
    text = str(caught.exception)
    case.assertNotIn("\n", text)
    return text


def simulated(**arguments):
    """A run of an arm that turns late, with noise."""
    arm = flexarm.Arm.paper().with_(damping_kelvin_voigt_s=1e-4)
    run = flexarm.simulate(
        arm.with_effect("time_delay", delay=0.01), "multisine:rms=0.05,from=0.5,to=40",
        duration_s=2.0, sample_time_s=SAMPLE_TIME_S, noise=0.005,
        sensors=["hub_angle", "hub_velocity"], **arguments)
    return arm, run


class Runs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.arm, cls.simulated = simulated()
        cls.columns = {
            "time_s": cls.simulated.time_s,
            "torque_N_m": cls.simulated.torque_N_m,
            "hub_angle_rad": cls.simulated["hub_angle"],
            "hub_velocity_rad_per_s": cls.simulated["hub_velocity"],
        }

    def assertIsTheSame(self, run):
        np.testing.assert_array_equal(run.time_s, self.simulated.time_s)
        np.testing.assert_array_equal(run.torque_N_m, self.simulated.torque_N_m)
        self.assertEqual(run.sensors, ("hub_angle", "hub_velocity"))
        for sensor in run.sensors:
            np.testing.assert_array_equal(run[sensor], self.simulated[sensor])

    def test_arrays_dicts_and_frames_make_one_run(self):
        frame = pandas.DataFrame(self.columns)
        headers = {"time_s": "time [s]", "torque_N_m": "torque [N m]", "hub_angle_rad": "hub_angle [rad]",
                   "hub_velocity_rad_per_s": "hub_velocity [rad/s]"}
        for run in (
            flexarm.TimeRun(**self.columns),
            flexarm.TimeRun(self.columns),
            flexarm.TimeRun({name: list(values) for name, values in self.columns.items()}),
            flexarm.TimeRun(frame),
            flexarm.TimeRun(frame.set_index("time_s")),
            flexarm.TimeRun(frame.astype("Float64")),
            flexarm.TimeRun(frame.rename(columns=headers)),
            flexarm.TimeRun(frame.drop(columns="torque_N_m"), torque_N_m=frame.torque_N_m),
            flexarm.TimeRun(self.simulated.to_pandas()),
        ):
            self.assertIsTheSame(run)

    def test_units_are_those_of_the_names(self):
        degrees = np.rad2deg(self.columns["hub_angle_rad"])
        run = flexarm.TimeRun(
            time_ms=1e3 * self.columns["time_s"], torque_N_mm=1e3 * self.columns["torque_N_m"],
            hub_angle_deg=degrees, hub_velocity_rpm=np.full(len(degrees), 60.0),
            tip_acceleration_g=np.ones(len(degrees)), **{"strain@0.05": np.zeros(len(degrees))})
        ROUNDING = 1e-12  # of one product and one quotient
        np.testing.assert_allclose(run["hub_angle"], self.columns["hub_angle_rad"], ROUNDING)
        np.testing.assert_allclose(run.time_s, self.columns["time_s"], ROUNDING)
        np.testing.assert_allclose(run.torque_N_m, self.columns["torque_N_m"], ROUNDING)
        np.testing.assert_allclose(run["hub_velocity"], 2 * np.pi, ROUNDING)
        np.testing.assert_allclose(run["tip_acceleration"], 9.80665, ROUNDING)
        self.assertEqual(run.sensors[-1], "strain@0.05")

    def test_a_sampling_period_is_in_place_of_times(self):
        columns = {**self.columns}
        del columns["time_s"]
        run = flexarm.TimeRun(columns, sample_time_s=SAMPLE_TIME_S)
        np.testing.assert_allclose(run.time_s, self.simulated.time_s, atol=1e-12)

    def test_facts_of_a_run_are_kept(self):
        loop = flexarm.Controller.pid(kp=1.0, kd=0.2)
        run = flexarm.TimeRun(
            self.columns, id="first", purpose="validation", payload_mass_kg=0.1,
            torque_hold="first", initial="free", controller=loop,
            reference_deg=np.full(len(self.simulated), 90.0))
        self.assertEqual(
            (run.id, run.purpose, run.payload_mass_kg, run.torque_hold, run.initial),
            ("first", "validation", 0.1, "first", "free"))
        self.assertEqual(run.controller, loop)
        np.testing.assert_allclose(run.reference, np.pi / 2, 1e-15)
        self.assertEqual(run.reference_unit, "rad")
        self.assertIn("reference_rad", run.to_pandas().columns)

    def test_what_cannot_be_is_named(self):
        n = len(self.simulated)

        def run(**columns):
            return lambda: flexarm.TimeRun({**self.columns, **columns})

        with_nan = np.where(np.arange(n) == 7, np.nan, 1.0)
        backwards = self.columns["time_s"][::-1]
        for call, part in (
            (run(hub_angel_rad=np.zeros(n)), "hub_angel_rad: sensor hub_angel: unknown (did you mean hub_angle?)"),
            (run(tip_displacement=np.zeros(n)),
             "tip_displacement: no unit in the name; must be tip_displacement_m, "),
            (run(tip_displacement_rad=np.zeros(n)), "tip_displacement_rad: rad is not its unit; must be"),
            (run(tip_displacement_m=np.zeros(n - 1)), f"tip_displacement: {n - 1} values; must be {n}"),
            (run(tip_displacement_m=np.zeros((n, 2))), "tip_displacement_m: an array of 2 dimensions"),
            (run(tip_displacement_m=with_nan), "tip_displacement_m = nan at index 7: must be finite"),
            (run(tip_displacement_m=["a"] * n), "tip_displacement_m: values of type <U1; must be an array"),
            (run(tip_displacement_m=np.ones(n) * 1j), "tip_displacement_m: values of type complex128"),
            (run(tip_displacement_m=pandas.date_range("2026", periods=n)), "of type datetime64"),
            (run(hub_angle_deg=np.zeros(n)), "hub_angle: given twice"),
            (run(time_ms=np.zeros(n)), "time_ms: time given twice"),
            (run(time_s=backwards), "time"),
            (run(reference_rad=np.zeros(n)), "reference: needs the controller"),
            (lambda: flexarm.TimeRun(np.zeros((n, 3))), "data: ndarray; must be a dict or a DataFrame"),
            (lambda: flexarm.TimeRun({1: np.zeros(n)}), "data: column 1: its name must be text"),
            (lambda: flexarm.TimeRun(time_s=[0.0, 1.0], torque_N_m=[0.0, 1.0]), "no sensor; needs one"),
            (lambda: flexarm.TimeRun(time_s=[0.0, 1.0], hub_angle_rad=[0.0, 1.0]), "torque_N_m: missing"),
            (lambda: flexarm.TimeRun(torque_N_m=[0.0, 1.0], hub_angle_rad=[0.0, 1.0]), "time_s: missing"),
            (lambda: flexarm.TimeRun(self.columns, sample_time_s=1.0), "sample_time_s: not together"),
            (lambda: flexarm.TimeRun(self.columns, payload_mass_kg=-1.0), "payload_mass_kg = -1 kg: must be"),
            (lambda: flexarm.TimeRun(self.columns, initial="still"), "initial still: must be rest or free"),
            (lambda: flexarm.TimeRun(self.columns, purpose="fit"), "fit"),
            (lambda: flexarm.TimeRun(self.columns, id="a/b"), "a/b"),
        ):
            self.assertIn(part, refusal(self, call))

    def test_frequency_responses_of_arrays(self):
        model = flexarm.ExactTransferFunction(self.arm)
        response = model.frequency_response(["hub_angle", "tip_acceleration"], np.linspace(1.0, 40.0, 50))
        run = flexarm.FrequencyRun(
            frequency_Hz=response.frequency_Hz, hub_angle_rad_per_N_m=response["hub_angle"],
            tip_acceleration_g_per_N_m=response["tip_acceleration"] / 9.80665,
            hub_angle_coherence=np.full(50, 0.9))
        np.testing.assert_array_equal(run["hub_angle"], response["hub_angle"])
        np.testing.assert_allclose(run["tip_acceleration"], response["tip_acceleration"], 1e-12)
        self.assertTrue(np.isnan(run.coherence("tip_acceleration")).all())
        again = flexarm.FrequencyRun(run.to_pandas().drop(columns="tip_acceleration_coherence"))
        self.assertEqual(again, run)
        self.assertEqual(flexarm.FrequencyRun(response.to_pandas()).sensors, run.sensors)
        for columns, part in (
            ({"hub_angle_rad": response["hub_angle"]}, "hub_angle_rad: must be frequency_Hz, a response"),
            ({"hub_angle_m_per_N_m": response["hub_angle"]}, "hub_angle_m_per_N_m: m is not its unit"),
            ({"hub_angle_rad_per_N_m": response["hub_angle"][1:]}, "hub_angle"),
            ({"hub_angle_rad_per_N_m": response["hub_angle"], "hub_angle_coherence": np.full(50, 2.0)},
             "coherence = 2 of hub_angle"),
        ):
            call = lambda: flexarm.FrequencyRun(frequency_Hz=response.frequency_Hz, **columns)
            self.assertIn(part, refusal(self, call))

    def test_frequency_responses_from_the_motion_of_the_hub(self):
        responses = {"tip_displacement_m_per_rad": [1.0 + 0j, 2.0], "frequency_Hz": [1.0, 2.0]}
        run = flexarm.FrequencyRun(responses, input="hub_angle")
        self.assertEqual(run.input, "hub_angle")
        frame = run.to_pandas().drop(columns="tip_displacement_coherence")
        self.assertEqual(flexarm.FrequencyRun(frame, input="hub_angle"), run)
        for given, part in (("tip_deflection", "input = tip_deflection: must be torque"),
                            ("torque", "tip_displacement_m_per_rad: must be frequency_Hz")):
            call = lambda: flexarm.FrequencyRun(responses, input=given)
            self.assertIn(part, refusal(self, call))

    def test_modal_tables_of_dicts_and_frames(self):
        rows = [
            {"feature": "pole", "order": 1, "frequency_Hz": 11.9, "damping_ratio": 0.01},
            {"feature": "zero", "sensor": "hub_angle", "frequency_Hz": 2.9},
        ]
        run = flexarm.ModalRun(rows)
        self.assertEqual(flexarm.ModalRun([flexarm.ModalEntry(**row) for row in rows]), run)
        self.assertEqual(flexarm.ModalRun(pandas.DataFrame(rows)), run)
        self.assertEqual(flexarm.ModalRun(run.to_pandas()), run)
        self.assertEqual(run.entries[0].order, 1)
        self.assertIsNone(run.entries[1].damping_ratio)
        for row, part in (
            ({"feature": "polle", "frequency_Hz": 1.0}, "feature polle: must be pole or zero"),
            ({"feature": "pole", "frequency_Hz": -1.0}, "frequency"),
            ({"feature": "zero", "frequency_Hz": 1.0}, "entry 1: sensor: missing"),
            ({"feature": "pole", "frequncy_Hz": 1.0}, "entries: frequncy_Hz: unknown; must be feature, "),
        ):
            self.assertIn(part, refusal(self, lambda: flexarm.ModalRun([row])))


class Measurements(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.here = pathlib.Path(cls.folder.name)
        cls.arm, run = simulated()
        cls.log = flexarm.TimeRun(run.to_pandas(), id="log")
        cls.measurement = flexarm.Measurement(cls.arm, cls.log, "rig")
        cls.measurement.write(cls.here / "rig")
        cls.file = cls.here / "rig" / "measurement.toml"

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_what_is_written_is_read_back(self):
        read = flexarm.read_measurement(self.file)
        self.assertEqual((read.name, read.arm), ("rig", self.arm))
        np.testing.assert_array_equal(read.runs[0]["hub_angle"], self.log["hub_angle"])
        self.assertIn("rig", refusal(self, lambda: self.measurement.write(self.here / "rig")))

    def test_an_identification_is_that_of_the_file(self):
        ours, theirs = flexarm.identify(self.measurement), flexarm.identify(self.file)
        self.assertEqual(ours.to_json(), theirs.to_json())
        self.assertIn("no such run in the measurement",
                      refusal(self, lambda: flexarm.identify(self.measurement, runs=["other"])))

    def test_an_identification_needs_no_arm(self):
        poles = [root.frequency_Hz for root in flexarm.identify(self.measurement).roots(feature="pole", method="fit")]
        without = flexarm.identify(flexarm.Measurement(None, self.log))
        self.assertTrue(poles)
        self.assertEqual([root.frequency_Hz for root in without.roots(feature="pole", method="fit")], poles)

    def test_a_diagnosis_is_that_of_the_file(self):
        ours, theirs = flexarm.diagnose(self.measurement), flexarm.diagnose(self.file)
        self.assertEqual([cause.effect for cause in ours.causes], ["time_delay"])
        self.assertEqual(ours.to_json(), theirs.to_json())

    def test_what_cannot_be_is_named(self):
        again = flexarm.TimeRun(self.log.to_pandas(), id="log")
        without = flexarm.Measurement(None, self.log)
        for call, error, part in (
            (lambda: flexarm.Measurement(self.arm, []), flexarm.InputError, "runs: none; needs one or more"),
            (lambda: flexarm.Measurement(self.arm, [self.log, again]), flexarm.InputError,
             "runs: two have the id log"),
            (lambda: flexarm.TimeRun(self.log.to_pandas(), id=3), TypeError, "id = 3: must be text"),
            (lambda: flexarm.TimeRun(self.log.to_pandas(), payload_mass_kg="x"), TypeError,
             "payload_mass_kg = 'x': must be a number [kg] or None"),
            (lambda: flexarm.ModalRun(3), TypeError, "entries: must be a list of ModalEntry"),
            (lambda: flexarm.Measurement(self.arm, [1]), TypeError, "runs: must be a TimeRun"),
            (lambda: flexarm.Measurement(self.arm, self.log.to_pandas()), TypeError, "runs: must be a TimeRun"),
            (lambda: flexarm.Measurement(self.arm, {"time_s": [0.0, 1.0]}), TypeError, "runs: must be a TimeRun"),
            (lambda: flexarm.Measurement(1, self.log), TypeError, "arm: int; must be an Arm or the path"),
            (lambda: flexarm.diagnose(without), flexarm.InputError, "measurement: has no arm"),
            (lambda: flexarm.diagnose(self.log), TypeError,
             "measurement: TimeRun; must be the path of a measurement.toml, or Measurement(arm, runs)"),
            (lambda: flexarm.identify(self.log.to_pandas()), TypeError, "measurement: DataFrame; must be"),
        ):
            self.assertIn(part, refusal(self, call, error))


class Imports(unittest.TestCase):
    """flexarm.import_log reads what `flexarm import` reads."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.here = pathlib.Path(cls.folder.name)
        time_s = np.arange(400) * 0.005
        torque = 0.1 * np.sin(6.0 * time_s)
        pandas.DataFrame({
            "Time (ms)": 1e3 * time_s, "u": torque / 0.2, "theta (deg)": 30.0 * np.cos(3.0 * time_s),
            "note": 0.0,
        }).to_csv(cls.here / "log.csv", index=False)
        cls.log = cls.here / "log.csv"

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_it_is_that_of_the_command(self):
        arguments = ["--column", "torque=u:N m:0.2", "--run", "a=0:0.995", "--run", "b=1:1.995",
                     "--validation", "b", "--payload-mass", "0.1", "--out", "measured"]
        ended = subprocess.run([PROGRAM, "import", str(self.log), *arguments], cwd=self.here,
                               capture_output=True, text=True)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        theirs = flexarm.read_measurement(self.here / "measured" / "measurement.toml")
        ours = flexarm.import_log(
            self.log, column={"torque": "u:N m:0.2"}, runs=["a=0:0.995", "b=1:1.995"], validation="b",
            payload_mass_kg=0.1)
        self.assertEqual([run.id for run in ours.runs], ["a", "b"])
        for our, their in zip(ours.runs, theirs.runs):
            self.assertEqual((our.purpose, our.payload_mass_kg, our.initial),
                             (their.purpose, their.payload_mass_kg, their.initial))
            pandas.testing.assert_frame_equal(our.to_pandas(), their.to_pandas())
        self.assertTrue(any("not used: note" in sentence for sentence in ours.notes))

    def test_an_imported_log_with_an_arm_is_a_measurement(self):
        measurement = flexarm.import_log(str(self.log), column="torque=u:N m:0.2",
                                         arm=flexarm.Arm.paper())
        self.assertEqual(measurement.name, "log")
        self.assertEqual(measurement.arm, flexarm.Arm.paper())
        measurement.write(self.here / "from-python")
        self.assertEqual(len(flexarm.read_measurement(self.here / "from-python/measurement.toml").runs), 1)

    def test_warnings_are_pythons(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            measurement = flexarm.import_log(
                self.log, column="torque=u:N m:0.2", reference="note:rad/s",
                controller="kp=1,sensor=hub_velocity")
        said = [str(one.message) for one in caught]
        self.assertTrue(any("hub_velocity" in text for text in said), said)
        self.assertTrue(set(said) <= set(measurement.notes))

    def test_errors_are_the_commands_with_arguments_for_options(self):
        for arguments, options in (
            ({}, []),
            ({"column": "torque=w"}, ["--column", "torque=w"]),
            ({"sample_time_s": -1.0}, ["--period", "-1"]),
            ({"kind": "wave"}, ["--kind", "wave"]),
            ({"decimate": 1}, ["--decimate", "1"]),
            ({"join_grid": "first"}, ["--join-grid", "first"]),
            ({"column": "torque=u", "times": "5:6"}, ["--column", "torque=u", "--times", "5:6"]),
        ):
            ended = subprocess.run([PROGRAM, "import", str(self.log), *options],
                                   capture_output=True, text=True)
            self.assertEqual(ended.returncode, 2)
            theirs = ended.stderr.strip().replace("--period", "sample_time_s")
            ours = refusal(self, lambda: flexarm.import_log(self.log, **arguments))
            self.assertEqual(ours, theirs.replace("--join-grid", "join_grid").replace("--", ""))
        missing = self.here / "none.csv"
        self.assertIn("none.csv", refusal(self, lambda: flexarm.import_log(missing)))


if __name__ == "__main__":
    unittest.main()
