"""pip install makes a wheel with the program inside, without a network. The built folder is taken: to
build anew takes minutes."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["FLEXARM_SOURCE_DIR"])
BUILD = os.environ["FLEXARM_BUILD_DIR"]


class Pip(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.bin = pathlib.Path(cls.folder.name) / "environment" / "bin"
        cls.environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        cls.environment["PATH"] = f"{cls.bin}:/usr/bin:/bin"
        # No network, and no proxy of one.
        cls.environment.update(PIP_NO_INDEX="1", PIP_DISABLE_PIP_VERSION_CHECK="1")
        cls.call(sys.executable, "-m", "venv", "--system-site-packages", str(cls.bin.parent))
        cls.call(cls.bin / "pip", "install", "-q", f"--config-settings=build-folder={BUILD}", str(SOURCE))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def call(cls, *command, cwd="/"):
        ended = subprocess.run(command, env=cls.environment, cwd=cwd, capture_output=True, text=True)
        if ended.returncode != 0:
            raise AssertionError(f"{command}: {ended.stdout}{ended.stderr}")
        return ended.stdout

    def test_the_program_is_on_path(self):
        said = self.call("flexarm", "--version")
        self.assertEqual(said, self.call(self.bin / "python", "-m", "flexarm", "--version"))
        self.assertTrue((self.bin / "flexarm").exists())
        self.assertIn("flexarm-campaign", self.call("flexarm-campaign", "--help"))

    def test_the_module_is_that_of_the_environment(self):
        script = ("import flexarm; print(flexarm.__file__); "
                  "print(flexarm.ExactTransferFunction(flexarm.Arm.paper()).poles(1).frequency_Hz)")
        file, poles = self.call(self.bin / "python", "-c", script).splitlines()
        self.assertTrue(file.startswith(str(self.bin.parent)), file)
        self.assertIn("11.86", poles)

    def test_the_program_runs_as_a_module_with_its_arguments_and_status(self):
        ended = subprocess.run([self.bin / "python", "-m", "flexarm", "modes", "none.toml"],
                               env=self.environment, capture_output=True, text=True)
        self.assertEqual(ended.returncode, 2)
        self.assertIn("none.toml", ended.stderr)

    def test_pip_knows_all_of_its_files(self):
        shown = self.call(self.bin / "pip", "show", "-f", "flexarm")
        for part in ("Requires: numpy", "bin/flexarm", "flexarm/_flexarm.pyi", "share/man/man1/flexarm.1"):
            self.assertIn(part, shown)
        # Packages of the system may lack others.
        checked = subprocess.run([self.bin / "pip", "check"], env=self.environment, capture_output=True, text=True)
        self.assertNotIn("flexarm", checked.stdout)


if __name__ == "__main__":
    unittest.main()
