"""Roots, modes, responses and state spaces, against SciPy and against each other."""

import sys
import types
import unittest
from unittest import mock

import numpy as np
import scipy.linalg
import scipy.signal

import flexarm

# An undamped arm's poles are eigenvalues of A with an error of some eps |A|, |A| = omega^2.
EIGENVALUE_ERROR = 1e-9
# Formulations agree to the accuracy that their settings are made for.
AGREEMENT = 1e-9


def damped():
    return flexarm.Arm.paper().with_(damping_kelvin_voigt_s=1e-4, payload_mass_kg=0.05)


class Roots(unittest.TestCase):
    def test_the_papers_arm_has_the_known_poles_and_zeros(self):
        exact = flexarm.ExactTransferFunction(flexarm.Arm.paper())
        np.testing.assert_allclose(
            exact.poles(3).frequency_Hz, [11.8618, 32.2606, 58.5327], rtol=1e-5
        )
        np.testing.assert_allclose(
            exact.zeros("hub_angle", 2).frequency_Hz, [2.87337, 18.0071], rtol=1e-5
        )
        tip = exact.zeros("tip_acceleration", 2)
        np.testing.assert_allclose(tip.s_rad_per_s, [57.4409, 310.406], rtol=1e-5)
        self.assertTrue(tip.is_non_minimum_phase.all())

    def test_formulations_agree(self):
        arm = damped().with_effect("root_compliance", stiffness=200.0)
        exact = flexarm.ExactTransferFunction(arm)
        for model in (flexarm.FiniteElements(arm), flexarm.AssumedModes(arm)):
            np.testing.assert_allclose(
                model.poles(5).omega_rad_per_s, exact.poles(5).omega_rad_per_s, rtol=AGREEMENT
            )
            np.testing.assert_allclose(
                model.damped_poles(3).s_rad_per_s, exact.damped_poles(3).s_rad_per_s, rtol=1e-7
            )
            self.assertGreater(model.degrees_of_freedom, 10)

    def test_settings_are_taken(self):
        model = flexarm.FiniteElements(flexarm.Arm.paper(), elements=3, degree=5)
        self.assertEqual(model.settings, "3 elements of degree 5")
        self.assertEqual(model.degrees_of_freedom, 1 + 3 * 4)
        with self.assertRaisesRegex(flexarm.InputError, "needs 1000 roots"):
            flexarm.FiniteElements(flexarm.Arm.paper(), roots=1000)
        with self.assertRaises(flexarm.InputError):
            flexarm.AssumedModes(flexarm.Arm.paper(), basis="fourier")

    def test_modes_have_shapes_and_sensor_values(self):
        modes = flexarm.ExactTransferFunction(flexarm.Arm.paper()).modes(
            3, ["hub_angle", "strain@0.05"], np.linspace(0.0, 0.7, 8)
        )
        self.assertEqual(modes.displacement_m.shape, (4, 8))
        self.assertEqual(modes.sensor_values.shape, (4, 2))
        self.assertEqual(modes.damping_rad_per_s.shape, (4, 4))
        np.testing.assert_allclose(modes.sensor_values[:, 0], modes.hub_slope)
        np.testing.assert_allclose(modes.displacement_m[0], np.linspace(0.0, 0.7, 8), atol=1e-12)

    def test_a_rigid_hub_has_no_flexible_poles(self):
        arm = flexarm.Arm(hub_inertia_kg_m2=0.01, hub_viscous_friction_N_m_s_per_rad=0.02)
        hub = flexarm.RigidHub(arm)
        self.assertEqual(len(hub.poles(3)), 0)
        self.assertAlmostEqual(
            hub.transfer_function("hub_velocity", 2j), 1 / (0.01 * 2j + 0.02), places=12
        )
        with self.assertRaises(flexarm.InputError):
            flexarm.ExactTransferFunction(arm)

    def test_bad_input_is_refused(self):
        exact = flexarm.ExactTransferFunction(flexarm.Arm.paper())
        for call in (
            lambda: exact.poles(0),
            lambda: exact.zeros("hub_angel"),
            lambda: exact.modes(1, "strain@2.0"),
            lambda: exact.modes(1, [], [[0.0]]),
            lambda: exact.frequency_response("hub_angle", [2.0, 1.0]),
        ):
            with self.assertRaises(flexarm.InputError):
                call()
        with self.assertRaises(ValueError):
            exact.transfer_function("hub_angle", 0.0)


class Responses(unittest.TestCase):
    def test_a_state_space_has_the_poles_of_the_arm(self):
        model = flexarm.ExactTransferFunction(flexarm.Arm.paper())
        system = model.state_space(modes=4, static_correction=False)
        found = np.sort(np.abs(np.linalg.eigvals(system.A).imag))[2::2]
        np.testing.assert_allclose(found, model.poles(4).omega_rad_per_s, rtol=EIGENVALUE_ERROR)

    def test_a_state_space_responds_as_scipy_says(self):
        model = flexarm.ExactTransferFunction(damped())
        system = model.state_space(["hub_angle", "tip_acceleration"], modes=6)
        frequency_Hz = np.array([0.5, 3.0, 20.0])
        omega = 2 * np.pi * frequency_Hz
        ours = system.frequency_response(frequency_Hz)
        for row, sensor in enumerate(system.sensors):
            one = scipy.signal.StateSpace(system.A, system.B, system.C[[row]], system.D[[row]])
            by_solving = [
                (system.C @ np.linalg.solve(1j * w * np.eye(len(system.A)) - system.A, system.B)
                 + system.D)[row, 0]
                for w in omega
            ]
            np.testing.assert_allclose(ours[sensor], by_solving, rtol=1e-9)
            # SciPy forms polynomials, which cost it digits.
            np.testing.assert_allclose(scipy.signal.freqresp(one, omega)[1], by_solving, rtol=1e-3)
        exact = model.frequency_response(system.sensors, frequency_Hz)
        np.testing.assert_allclose(ours["hub_angle"], exact["hub_angle"], rtol=1e-3)

    def test_a_transfer_function_is_the_frequency_response_without_a_path(self):
        model = flexarm.FiniteElements(damped())
        frequency_Hz = np.geomspace(0.3, 40.0, 7)
        response = model.frequency_response("tip_displacement", frequency_Hz)
        direct = model.transfer_function("tip_displacement", 2j * np.pi * frequency_Hz)
        np.testing.assert_allclose(response["tip_displacement"], direct, rtol=1e-12)
        self.assertEqual(
            model.transfer_function("hub_angle", np.ones((2, 3), complex)).shape, (2, 3)
        )

    def test_the_path_of_the_torque_acts(self):
        delayed = damped().with_effect("time_delay", delay=0.01)
        plain = flexarm.ExactTransferFunction(damped()).frequency_response("hub_angle", [1.0, 5.0])
        late = flexarm.ExactTransferFunction(delayed).frequency_response("hub_angle", [1.0, 5.0])
        ratio = late["hub_angle"] / plain["hub_angle"]
        np.testing.assert_allclose(ratio, np.exp(-2j * np.pi * 0.01 * np.array([1.0, 5.0])))

    def test_without_frequencies_there_is_a_grid(self):
        response = flexarm.ExactTransferFunction(damped()).frequency_response(points=50)
        self.assertEqual(response.sensors, ("hub_angle", "tip_acceleration"))
        self.assertGreater(len(response), 50)
        self.assertEqual(response.values.shape, (2, len(response)))

    def test_xarray_has_units(self):
        data = flexarm.ExactTransferFunction(damped()).frequency_response(
            ["hub_angle", "strain@0.05"], [1.0, 2.0]
        ).to_xarray()
        self.assertEqual(data["hub_angle"].attrs["units"], "rad/(N m)")
        self.assertEqual(data["frequency"].attrs["units"], "Hz")
        self.assertEqual(data["strain@0.05"].dtype, complex)


class Conversions(unittest.TestCase):
    def test_to_scipy(self):
        system = flexarm.ExactTransferFunction(damped()).state_space(modes=2)
        converted = system.to_scipy()
        self.assertIsInstance(converted, scipy.signal.StateSpace)
        np.testing.assert_array_equal(converted.A, system.A)

    def test_delays_are_not_lost_without_a_word(self):
        system = flexarm.ExactTransferFunction(
            damped().with_effect("time_delay", delay=0.01)
        ).state_space(modes=2)
        self.assertEqual(system.delay_s, 0.01)
        with self.assertRaisesRegex(ValueError, "0.01 s of the torque"):
            system.to_scipy()
        self.assertEqual(len(system.to_scipy(ignore_delays=True).A), len(system.A))

    def test_to_control(self):
        """With a stand-in that takes what control.ss of python-control 0.9 and later takes."""
        made = {}

        def ss(a, b, c, d, *, inputs=None, outputs=None, states=None):
            made.update(a=a, d=d, inputs=inputs, outputs=outputs, states=states)
            return "system"

        system = flexarm.ExactTransferFunction(damped()).state_space("hub_angle", modes=1)
        stand_in = types.ModuleType("control")
        stand_in.ss = ss
        with mock.patch.dict(sys.modules, control=stand_in):
            self.assertEqual(system.to_control(), "system")
        np.testing.assert_array_equal(made["a"], system.A)
        self.assertEqual(made["inputs"], ["torque"])
        self.assertEqual(made["outputs"], ["hub_angle"])
        self.assertEqual(len(made["states"]), len(system.A))

    def test_a_package_that_is_missing_is_named(self):
        system = flexarm.ExactTransferFunction(damped()).state_space(modes=1)
        with mock.patch.dict(sys.modules, control=None):
            with self.assertRaisesRegex(ImportError, "to_control needs python-control"):
                system.to_control()


if __name__ == "__main__":
    unittest.main()
