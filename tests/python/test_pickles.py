"""Results go through pickle unchanged, and compare by their numbers."""

import copy
import pickle
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import flexarm

ARM = flexarm.Arm.paper().with_(damping_kelvin_voigt_s=1e-4)


def through_pickle(result):
    return pickle.loads(pickle.dumps(result))


class Results(unittest.TestCase):
    def assertKept(self, result):
        again = through_pickle(result)
        self.assertIs(type(again), type(result))
        self.assertEqual(again, result)
        self.assertEqual(hash(again), hash(result))
        self.assertEqual(copy.deepcopy(result), result)
        return again

    def test_of_a_formulation(self):
        model = flexarm.ExactTransferFunction(ARM)
        late = flexarm.ExactTransferFunction(ARM.with_effect("time_delay", delay=0.01))
        zeros = model.zeros("tip_acceleration", 2)
        for result in (
            model.poles(3), model.poles(3).count, model.poles(3).summary, model.damped_poles(3), zeros,
            model.modes(2, ["hub_angle", "strain@0.05"], [0.1]),
            model.frequency_response(["hub_angle"], np.linspace(1.0, 20.0, 30)),
            late.state_space(["hub_angle", "tip_acceleration"], modes=3),
            flexarm.Controller.pid(kp=1.0, limit_N_m=0.5),
            flexarm.Controller.state_space([[0.5]], [[0.1, 0.2]], [[1.0]], [[0.0, 1.0]]),
        ):
            self.assertKept(result)
        self.assertNotEqual(model.poles(3), model.poles(2))
        self.assertNotEqual(model.poles(3), "poles")
        elements = flexarm.FiniteElements(ARM, elements=10).zeros("tip_acceleration", 2)
        for rejected in self.assertKept(elements).rejected:
            self.assertKept(rejected)
        np.testing.assert_array_equal(through_pickle(zeros).s_rad_per_s, zeros.s_rad_per_s)

    def test_of_a_simulation(self):
        experiment = flexarm.simulate_experiment(
            ARM.with_effect("coulomb_friction", torque=0.005),
            ["multisine:rms=0.05,to=40", "stepped-sine:amplitude=0.05,from=10,to=11,points=2"],
            duration_s=1.0, sample_time_s=2e-3, modes=3)
        again = self.assertKept(experiment)
        self.assertEqual(again.to_json(), experiment.to_json())
        (run,) = experiment.runs
        for result in (run, run.energy, run.summary, *experiment.stepped_runs):
            self.assertKept(result)
        np.testing.assert_array_equal(through_pickle(run)["hub_angle"], run["hub_angle"])

    def test_of_a_measurement_its_identification_and_diagnosis(self):
        run = flexarm.simulate(
            ARM.with_effect("time_delay", delay=0.01), "multisine:rms=0.05,from=0.5,to=40",
            duration_s=2.0, sample_time_s=4e-3, noise=0.005, sensors=["hub_angle", "hub_velocity"])
        measurement = flexarm.Measurement(ARM, flexarm.TimeRun(run.to_pandas()))
        self.assertKept(self.assertKept(measurement).runs[0])
        identification = flexarm.identify(measurement)
        self.assertEqual(self.assertKept(identification).to_json(), identification.to_json())
        self.assertKept(identification.poles[0])
        diagnosis = flexarm.diagnose(measurement)
        again = self.assertKept(diagnosis)
        self.assertEqual(again.to_json(), diagnosis.to_json())
        self.assertEqual(again.extended_arm, diagnosis.extended_arm)
        self.assertEqual(again.figures(), diagnosis.figures())
        cause = diagnosis.causes[0]
        for result in (cause, cause.parameters["delay"], diagnosis.estimation, diagnosis.symptoms[0],
                       diagnosis.overlays[0]):
            self.assertKept(result)

    def test_of_a_plan_and_of_tables(self):
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
            file.write('[[run]]\nid = "modal"\nkind = "modal"\npoles = 3\nzeros = { hub_angle = 2 }\n')
            file.flush()
            plan = flexarm.plan(ARM, file.name, effects=["hub_inertia", "payload_mass"])
        self.assertEqual(self.assertKept(plan).to_json(), plan.to_json())
        self.assertKept(plan.effects[0])
        table = flexarm.ModalRun([{"feature": "pole", "frequency_Hz": 11.9}])
        self.assertKept(table.entries[0])
        self.assertKept(table)
        self.assertKept(flexarm.FrequencyRun(frequency_Hz=[1.0], hub_angle_rad_per_N_m=[1j]))

    def test_another_process_reads_it(self):
        poles = flexarm.ExactTransferFunction(ARM).poles(3)
        script = "import pickle, sys; print(pickle.load(sys.stdin.buffer))"
        ended = subprocess.run([sys.executable, "-c", script], input=pickle.dumps(poles),
                               capture_output=True)
        self.assertEqual(ended.stdout.decode().strip(), repr(poles))

    def test_another_version_and_a_cut_state_are_refused(self):
        poles = flexarm.ExactTransferFunction(ARM).poles(1)
        state = poles.__getstate__()
        version = flexarm.__version__.encode()
        for changed, part in (
            (state.replace(version, b"0.0.1", 1), "a pickle of flexarm 0.0.1"),
            (state[:-1], "ends too early"),
        ):
            made = type(poles).__new__(type(poles))
            with self.assertRaises(flexarm.InputError) as caught:
                made.__setstate__(changed)
            self.assertIn(part, str(caught.exception))


if __name__ == "__main__":
    unittest.main()
