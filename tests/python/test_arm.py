"""Arms, effects and the errors of bad input."""

import copy
import os
import pathlib
import pickle
import subprocess
import tempfile
import unittest

import flexarm

SOURCE = pathlib.Path(os.environ["FLEXARM_SOURCE_DIR"])
PROGRAM = os.environ["FLEXARM_PROGRAM"]


def refusal(*arguments, cwd=None):
    """The line that the program shows of bad input."""
    ended = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, cwd=cwd)
    assert ended.returncode == 2, ended
    return ended.stderr.rstrip("\n")


class Arms(unittest.TestCase):
    def test_numbers_have_their_units_in_their_names(self):
        arm = flexarm.Arm.paper()
        self.assertEqual(arm.beam_length_m, 0.96)
        self.assertEqual(arm.payload_mass_kg, 0.0)
        self.assertIsNone(arm.beam_shear_modulus_Pa)
        self.assertAlmostEqual(arm.flexural_rigidity_N_m2, 3.6918, places=4)
        for number in flexarm.arm_numbers():
            self.assertTrue(hasattr(arm, number.attribute), number)

    def test_another_number_makes_another_arm(self):
        arm = flexarm.Arm.paper()
        loaded = arm.with_(payload_mass_kg=0.05, name="loaded")
        self.assertEqual((arm.payload_mass_kg, loaded.payload_mass_kg), (0.0, 0.05))
        self.assertEqual(loaded.name, "loaded")
        self.assertNotEqual(arm, loaded)
        self.assertEqual(len({arm, loaded, flexarm.Arm.paper()}), 2)

    def test_is_made_of_numbers(self):
        arm = flexarm.Arm(
            beam_length_m=0.5,
            beam_flexural_rigidity_N_m2=2.0,
            beam_linear_density_kg_per_m=0.2,
            hub_inertia_kg_m2=0.01,
        )
        self.assertAlmostEqual(arm.total_inertia_kg_m2, 0.01 + 0.2 * 0.5**3 / 3, places=12)

    def test_the_text_of_a_file_comes_back_bit_for_bit(self):
        arm = flexarm.Arm.paper().with_(payload_mass_kg=0.1 / 3).with_effect("time_delay", delay=1e-3)
        self.assertEqual(flexarm.Arm.from_toml(arm.to_toml()), arm)
        self.assertEqual(pickle.loads(pickle.dumps(arm)), arm)
        self.assertEqual(copy.deepcopy(arm), arm)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "arm.toml"
            arm.write(path)
            self.assertEqual(flexarm.read_arm(path), arm)

    def test_effects_are_put_on_and_taken_off(self):
        arm = flexarm.Arm.paper().with_effect("root_compliance", stiffness=30.0)
        effect = arm.effects["root_compliance"]
        self.assertEqual(effect.parameters, {"stiffness": 30.0})
        self.assertEqual(effect.units, {"stiffness": "N m/rad"})
        self.assertEqual(arm.without_effect("root_compliance"), flexarm.Arm.paper())
        lag = flexarm.Arm.paper().with_effect("sensor_lag", "hub_angle", time_constant=1e-3)
        self.assertEqual(lag.effects["sensor_lag"].sensor, "hub_angle")

    def test_every_effect_of_the_library_can_be_listed(self):
        names = {effect.name for effect in flexarm.effects()}
        self.assertIn("coulomb_friction", names)
        for effect in flexarm.effects():
            self.assertTrue(effect.meaning and effect.evidence and effect.ports)

    def test_uncertainties_are_those_of_the_file(self):
        arm = flexarm.Arm.paper().with_uncertainties({"hub.inertia": 0.05})
        self.assertEqual(arm.uncertainties, {"hub.inertia": 0.05})
        self.assertIn("inertia_uncertainty", arm.to_toml())

    def test_shows_itself_as_a_table(self):
        html = flexarm.Arm.paper().with_(name="<b>").with_effect("gravity", acceleration=9.81)._repr_html_()
        self.assertIn("beam.length (l)", html)
        self.assertIn("&lt;b&gt;", html)
        self.assertIn("gravity", html)


class Errors(unittest.TestCase):
    def test_a_file_gives_the_line_of_the_program(self):
        files = {
            "no.toml": None,
            "typo.toml": "[beam]\nlenght = 0.7\n",
            "negative.toml": (SOURCE / "data/paper/arm.toml").read_text() + "\n[payload]\nmass = -1\n",
            "broken.toml": "[beam\n",
            "huge.toml": (SOURCE / "data/paper/arm.toml").read_text() + "\n[payload]\nmass = 1e12\n",
        }
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = os.path.join(folder, name)
                if text is not None:
                    pathlib.Path(path).write_text(text)
                with self.assertRaises(flexarm.InputError) as caught:
                    flexarm.read_arm(path)
                self.assertEqual(str(caught.exception), refusal("modes", path))

    def test_are_value_errors(self):
        self.assertTrue(issubclass(flexarm.InputError, ValueError))
        self.assertEqual(flexarm.InputError.__module__, "flexarm")

    def test_a_number_out_of_range_states_what_is_allowed(self):
        with self.assertRaisesRegex(flexarm.InputError, r"payload.mass = -1 kg: must be"):
            flexarm.Arm.paper().with_(payload_mass_kg=-1.0)

    def test_a_name_that_is_none_states_what_was_meant(self):
        with self.assertRaisesRegex(flexarm.InputError, r"did you mean payload_mass_kg\?"):
            flexarm.Arm.paper().with_(payload_mas_kg=1.0)
        with self.assertRaisesRegex(flexarm.InputError, r"did you mean gravity\?"):
            flexarm.Arm.paper().with_effect("gravty")
        with self.assertRaisesRegex(flexarm.InputError, "not an effect of the arm"):
            flexarm.Arm.paper().without_effect("gravity")


if __name__ == "__main__":
    unittest.main()
