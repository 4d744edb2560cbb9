"""Time responses, against SciPy's and against the program's."""

import csv
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np
import scipy.signal

import flexarm

PROGRAM = os.environ["FLEXARM_PROGRAM"]
# Both step the linear arm exactly; what is left is the rounding of a few thousand steps of a double
# integrator.
STEPPING_ERROR = 1e-9


def damped():
    return flexarm.Arm.paper().with_(damping_kelvin_voigt_s=1e-4, payload_mass_kg=0.05)


def run_program(*arguments, cwd=None):
    subprocess.run([PROGRAM, *arguments], check=True, capture_output=True, cwd=cwd)


class AgainstSciPy(unittest.TestCase):
    def response(self, hold):
        torque = flexarm.sampled_torque(
            "multisine:rms=0.03,to=40", duration_s=2.0, sample_time_s=1e-3
        )
        sensors = ["hub_angle", "hub_velocity", "tip_acceleration"]
        run = flexarm.simulate(damped(), torque, sample_time_s=1e-3, sensors=sensors, hold=hold, modes=5)
        system = flexarm.ExactTransferFunction(damped()).state_space(
            sensors, modes=5, static_correction=False
        )
        return run, torque, system

    def test_zero_order_hold_is_a_discrete_system(self):
        run, torque, system = self.response("zero")
        a, b, c, d, step = scipy.signal.cont2discrete(
            (system.A, system.B, system.C, system.D), 1e-3, "zoh"
        )
        _, y, _ = scipy.signal.dlsim((a, b, c, d, step), torque)
        for i, sensor in enumerate(run.sensors):
            scale = np.abs(y[:, i]).max()
            np.testing.assert_allclose(run[sensor], y[:, i], rtol=0, atol=STEPPING_ERROR * scale)

    def test_first_order_hold_is_what_lsim_does(self):
        run, torque, system = self.response("first")
        _, y, _ = scipy.signal.lsim(system.to_scipy(), torque, run.time_s)
        for i, sensor in enumerate(run.sensors):
            scale = np.abs(y[:, i]).max()
            np.testing.assert_allclose(run[sensor], y[:, i], rtol=0, atol=STEPPING_ERROR * scale)


class Truncation(unittest.TestCase):
    TOLERANCE = 1e-4

    def test_the_modes_of_a_simulation_are_chosen_and_its_errors_stated(self):
        excitation = "multisine:rms=0.03,to=40"
        chosen = flexarm.simulate(damped(), excitation, duration_s=1.0, sample_time_s=1e-3)
        self.assertEqual(len(chosen.truncation_errors), len(chosen.sensors))
        self.assertLessEqual(max(chosen.truncation_errors), self.TOLERANCE)
        few = flexarm.simulate(damped(), excitation, duration_s=1.0, sample_time_s=1e-3, modes=2)
        self.assertEqual(few.modes, 2)
        self.assertGreater(max(few.truncation_errors), self.TOLERANCE)

    def test_the_modes_of_a_state_space_are_chosen_and_its_errors_stated(self):
        model = flexarm.ExactTransferFunction(damped())
        self.assertLessEqual(max(model.state_space().truncation_errors), self.TOLERANCE)
        self.assertGreater(max(model.state_space(modes=2).truncation_errors), self.TOLERANCE)


class Runs(unittest.TestCase):
    def test_a_run_has_arrays_with_units(self):
        run = flexarm.simulate(damped(), "step:amplitude=0.05", duration_s=0.1)
        self.assertEqual(run.sensors, ("hub_angle", "hub_velocity", "tip_acceleration"))
        self.assertEqual(run.units, ("rad", "rad/s", "m/s^2"))
        self.assertEqual(len(run), 200)
        self.assertFalse(run["hub_angle"].flags.writeable)
        self.assertFalse(run["hub_angle"].flags.owndata)
        self.assertEqual(run.to_xarray()["torque"].attrs["units"], "N m")
        self.assertAlmostEqual(run.energy.residual_J, 0.0, places=12)

    def test_friction_sticks(self):
        arm = damped().with_effect("coulomb_friction", torque=0.02)
        run = flexarm.simulate(arm, "bang-bang:amplitude=0.1,pulse=0.2", duration_s=2.0)
        self.assertGreater(run.summary.stick_time_s, 0.1)
        self.assertGreater(run.energy.dry_friction_J, 0.0)

    def test_noise_has_its_seed(self):
        def noisy(seed):
            return flexarm.simulate(damped(), "step", duration_s=0.1, noise=0.01, seed=seed)

        np.testing.assert_array_equal(noisy(1)["hub_angle"], noisy(1)["hub_angle"])
        self.assertTrue((noisy(1)["hub_angle"] != noisy(2)["hub_angle"]).any())
        self.assertTrue((noisy(1)["hub_angle"] != noisy(1).noise_free("hub_angle")).any())

    def test_a_closed_loop_follows_its_reference(self):
        controller = flexarm.Controller.pid(kp=0.2, kd=0.06, sample_time_s=0.004)
        reference = np.full(3000, 0.3)
        run = flexarm.simulate(
            damped(), reference=reference, controller=controller, sample_time_s=0.002
        )
        np.testing.assert_array_equal(run.reference, reference)
        self.assertAlmostEqual(run["hub_angle"][-1], 0.3, delta=0.03)
        typed = flexarm.simulate(
            damped(), reference=reference, controller="kp=0.2,kd=0.06,sample_time=0.004",
            sample_time_s=0.002,
        )
        np.testing.assert_array_equal(run["hub_angle"], typed["hub_angle"])

    def test_a_state_space_controller(self):
        run = flexarm.simulate(
            damped(),
            reference=np.full(500, 0.1),
            controller=flexarm.Controller.state_space(
                np.zeros((0, 0)), np.zeros((0, 3)), np.zeros((1, 0)), [[0.2, -0.2, -0.06]],
                sensors=["hub_angle", "hub_velocity"],
            ),
            sample_time_s=0.002,
        )
        self.assertAlmostEqual(run.torque_N_m[0], 0.02, places=12)

    def test_bad_input_names_the_argument(self):
        for message, call in {
            "duration_s = -1 s: must be": lambda: flexarm.simulate(damped(), duration_s=-1.0),
            "hold third: must be": lambda: flexarm.simulate(damped(), hold="third"),
            "excitation: an array of 2": lambda: flexarm.simulate(damped(), [[1.0]]),
            "excitation stairs": lambda: flexarm.simulate(damped(), "stairs"),
            "reference: needs controller": lambda: flexarm.simulate(damped(), reference=[0, 1]),
            "formulation femm": lambda: flexarm.simulate(damped(), formulation="femm"),
            "controller: reads strain@0.05": lambda: flexarm.simulate(
                damped(), reference=[0.0, 1.0], controller="kp=1,sensor=strain@0.05"
            ),
        }.items():
            with self.assertRaises(flexarm.InputError) as caught:
                call()
            self.assertTrue(str(caught.exception).startswith(message), caught.exception)
        with self.assertRaisesRegex(TypeError, "unexpected keyword argument 'durations'"):
            flexarm.simulate(damped(), durations=1.0)


class AgainstTheProgram(unittest.TestCase):
    def test_an_experiment_is_the_programs_byte_for_byte(self):
        arm = damped().with_effect("coulomb_friction", torque=0.01)
        excitations = [
            "random:rms=0.05,to=60,id=low",
            "multisine:rms=0.03,to=60,payload=0.06,purpose=validation",
            "stepped-sine:amplitude=0.05,from=2,to=3,step=0.5",
        ]
        with tempfile.TemporaryDirectory() as folder:
            here = pathlib.Path(folder)
            arm.write(here / "rig.toml")
            arguments = ["simulate", "rig.toml", "--out", "theirs", "--json", "theirs.json"]
            for excitation in excitations:
                arguments += ["--excitation", excitation]
            arguments += ["--duration", "0.5", "--period", "0.001", "--noise", "0.005"]
            run_program(*arguments, "--sensor", "hub_angle,strain@0.05", cwd=folder)
            experiment = flexarm.simulate_experiment(
                arm,
                excitations,
                duration_s=0.5,
                sample_time_s=1e-3,
                noise=0.005,
                sensors=["hub_angle", "strain@0.05"],
            )
            experiment.write(here / "ours")
            names = sorted(path.name for path in (here / "theirs").iterdir())
            self.assertEqual(names, sorted(path.name for path in (here / "ours").iterdir()))
            for name in names:
                self.assertEqual(
                    (here / "ours" / name).read_bytes(), (here / "theirs" / name).read_bytes(), name
                )
            self.assertEqual(experiment.to_json(), (here / "theirs.json").read_text())
            with (here / "ours" / "low.csv").open() as file:
                rows = list(csv.reader(file))
            recorded = [float(row[2]) for row in rows[1:]]
            np.testing.assert_array_equal(experiment.runs[0]["hub_angle"], recorded)
            with self.assertRaises(flexarm.InputError):
                experiment.write(here / "ours")
        self.assertEqual(json.loads(experiment.to_json())["schema"], "flexarm.simulate/1")


if __name__ == "__main__":
    unittest.main()
