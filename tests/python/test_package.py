"""The package as a whole: names, docstrings, type stubs."""

import ast
import inspect
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import flexarm
from flexarm import _flexarm

PACKAGE = pathlib.Path(flexarm.__file__).parent
# Of mypy, for all its calls: nothing is left in the source tree.
CACHE = tempfile.TemporaryDirectory()
WITH_CACHE = {**os.environ, "MYPY_CACHE_DIR": CACHE.name}
STUBS = ast.parse((PACKAGE / "_flexarm.pyi").read_text())
# Of units, as names end in them.
UNITS = ("_m", "_m2", "_m3", "_kg", "_s", "_Hz", "_Pa", "_rad", "_J", "_percent")


def public(names):
    return {name for name in names if not name.startswith("_")}


def stub_classes():
    return {node.name: node for node in STUBS.body if isinstance(node, ast.ClassDef)}


def stub_functions():
    return {node.name: node for node in STUBS.body if isinstance(node, ast.FunctionDef)}


def own_members(kind):
    return public(kind.__dict__)


class Names(unittest.TestCase):
    def test_all_of_the_extension_is_in_the_package(self):
        self.assertEqual(public(vars(_flexarm)), public(flexarm.__all__))
        for name in public(flexarm.__all__):
            self.assertEqual(getattr(flexarm, name).__module__, "flexarm")

    def test_is_typed(self):
        self.assertTrue((PACKAGE / "py.typed").exists())

    def test_its_version_is_the_programs(self):
        output = subprocess.run(
            [os.environ["FLEXARM_PROGRAM"], "--version"], capture_output=True, text=True
        ).stdout
        self.assertIn(flexarm.__version__, output)


class Docstrings(unittest.TestCase):
    def test_everything_public_has_one(self):
        for name in public(flexarm.__all__):
            one = getattr(flexarm, name)
            self.assertTrue(one.__doc__, name)
            if not inspect.isclass(one) or name == "InputError":
                continue
            for member in own_members(one):
                self.assertTrue(getattr(one, member).__doc__, f"{name}.{member}")

    def test_numbers_with_a_unit_in_their_name_have_it_in_their_text(self):
        for kind in (flexarm.Arm, flexarm.Poles, flexarm.Modes, flexarm.FrequencyResponse):
            for member in own_members(kind):
                if member.endswith(UNITS):
                    self.assertRegex(getattr(kind, member).__doc__, r"\[.+\]", member)


class Stubs(unittest.TestCase):
    def test_have_the_modules_classes_and_functions(self):
        stubs = public(stub_classes()) | public(stub_functions())
        self.assertEqual(stubs, public(vars(_flexarm)))

    def test_have_the_members_of_every_class(self):
        for name, node in stub_classes().items():
            members = {one.name for one in node.body if isinstance(one, ast.FunctionDef)}
            self.assertEqual(public(members), own_members(getattr(flexarm, name)), name)

    def test_stubtest_finds_no_fault(self):
        stubtest = shutil.which("stubtest", path="/usr/bin")
        if stubtest is None:
            self.skipTest("mypy is not installed")
        with tempfile.NamedTemporaryFile("w", suffix=".ini") as settings:
            # h5py and others have no stubs, or are not installed. To read all of Dask takes most of
            # the time.
            settings.write("[mypy]\nignore_missing_imports = True\n"
                           "[mypy-dask.*,distributed.*]\nfollow_imports = skip\n")
            settings.flush()
            ended = subprocess.run(
                [stubtest, "flexarm", "--concise", "--ignore-missing-stub",
                 "--mypy-config-file", settings.name],
                capture_output=True, text=True, env=WITH_CACHE,
            )
        # What pybind11 makes of every class: its metaclass, and a constructor of any arguments.
        of_pybind11 = ("is inconsistent, metaclass differs",
                       '.__init__ is inconsistent, stub does not have *args argument "args"')
        lines = (ended.stdout + ended.stderr).splitlines()
        self.assertTrue(any("metaclass differs" in line for line in lines), lines)
        # Campaigns have no stub: their annotations are what mypy infers.
        faults = [line for line in lines if not line.startswith("flexarm.campaign.")]
        self.assertEqual([line for line in faults if not line.endswith(of_pybind11)], [])

    def test_mypy_accepts_a_users_program(self):
        mypy = shutil.which("mypy", path="/usr/bin")
        if mypy is None:
            self.skipTest("mypy is not installed")
        program = (
            "import flexarm\n"
            "arm: flexarm.Arm = flexarm.Arm.paper().with_(payload_mass_kg=0.05)\n"
            "poles = flexarm.ExactTransferFunction(arm).poles(3)\n"
            "first: float = float(poles.frequency_Hz[0])\n"
        )
        with_mistake = program + "poles.frequency\n"
        for text, status in ((program, 0), (with_mistake, 1)):
            ended = subprocess.run(
                [mypy, "-c", text], capture_output=True, text=True, env=WITH_CACHE
            )
            self.assertEqual(ended.returncode, status, ended.stdout)


class Interpreter(unittest.TestCase):
    def test_is_the_systems(self):
        self.assertTrue(sys.executable.startswith("/usr/bin/python3"))


if __name__ == "__main__":
    unittest.main()
