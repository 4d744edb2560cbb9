"""docs/python.md and the notebooks: all of their code runs."""

import contextlib
import io
import os
import pathlib
import re
import tempfile
import unittest

import nbclient
import nbformat

SOURCE = pathlib.Path(os.environ["FLEXARM_SOURCE_DIR"])
NOTEBOOKS = SOURCE / "python" / "notebooks"


class Manual(unittest.TestCase):
    def test_every_block_runs_and_prints_what_it_says(self):
        """Blocks go on where the last one ended; a block of text is what the one before prints."""
        text = (SOURCE / "docs" / "python.md").read_text()
        blocks = re.findall(r"^```(python|text)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
        self.assertGreater(len(blocks), 8)
        names, printed = {}, ""
        with tempfile.TemporaryDirectory() as folder:
            before = os.getcwd()
            os.chdir(folder)
            try:
                for kind, block in blocks:
                    if kind == "text":
                        self.assertEqual(printed, block)
                        continue
                    output = io.StringIO()
                    with contextlib.redirect_stdout(output):
                        exec(compile(block, "docs/python.md", "exec"), names)
                    printed = output.getvalue()
            finally:
                os.chdir(before)


class Notebooks(unittest.TestCase):
    def run_notebook(self, name):
        notebook = nbformat.read(NOTEBOOKS / name, as_version=4)
        self.assertTrue(
            all(not cell.get("outputs") for cell in notebook.cells), "committed with outputs"
        )
        with tempfile.TemporaryDirectory() as folder:
            client = nbclient.NotebookClient(
                notebook, timeout=120, resources={"metadata": {"path": folder}}
            )
            client.execute()
        return notebook

    def outputs(self, notebook):
        text = ""
        for cell in notebook.cells:
            for output in cell.get("outputs", []):
                text += output.get("text", "") + output.get("data", {}).get("text/html", "")
                text += output.get("data", {}).get("text/plain", "")
        return text

    def test_from_an_arm_to_a_state_space(self):
        shown = self.outputs(self.run_notebook("arm-to-state-space.ipynb"))
        self.assertIn("/usr/bin/python3", shown)
        self.assertIn("non-minimum phase", shown)

    def test_from_a_measurement_to_a_cause(self):
        shown = self.outputs(self.run_notebook("measurement-to-cause.ipynb"))
        self.assertIn("coulomb_friction", shown)
        self.assertIn("<svg", shown)


if __name__ == "__main__":
    unittest.main()
