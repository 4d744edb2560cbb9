"""Campaigns: files, bytes of the results, deaths of workers and of the scheduler, Ctrl-C."""

import contextlib
import dataclasses
import json
import multiprocessing
import os
import pathlib
import signal
import subprocess
import sys
import threading
import unittest
from unittest import mock

import dask

import flexarm
from flexarm.campaign import (
    cluster, file_digests, open_results, program, runner, task_files, work,
)

from campaign_case import WAITS_S, CampaignCase

SWEEP = """
kind = "sweep"
[sweep]
poles = 2
zeros = { tip_acceleration = 1 }
formulations = ["exact_tf", "fem"]
[[sweep.parameter]]
key = "payload.mass"
from = 0.0
to = 0.1
count = 3
[[sweep.parameter]]
key = "effects.root_compliance.stiffness"
values = [100, 200.0]
"""


class File(CampaignCase):
    def test_a_fault_is_one_line_with_key_value_and_what_is_allowed(self):
        count = 'key = "payload.mass"\nfrom = 0.0\nto = 0.1\ncount = 3'
        for old, new, line in (
            ('kind = "sweep"', 'kind = "swep"', 'kind = "swep": must be one of'),
            ('kind = "sweep"', 'kind = "no_such.swep"', 'kind = "no_such.swep": must be one of'),
            ('kind = "sweep"', "kind = 3", "kind = 3: must be a text"),
            ('kind = "sweep"', "", "kind: missing; must be a text"),
            ('kind = "sweep"', 'kind = "sweep"\nnaem = "x"', "unknown key (did you mean name?)"),
            ("poles = 2", "poels = 2", "sweep.poels = 2: unknown key (did you mean poles?)"),
            ("poles = 2", "poles = -1", "sweep.poles = -1: must be a whole number from 0 to"),
            ("poles = 2", "poles = true", "sweep.poles = true: must be a whole number"),
            ("poles = 2", "poles = 2 2", "not TOML: "),
            ("payload.mass", "payload.mas", "must be a number of the arm file (did you mean pay"),
            ("to = 0.1", "to = nan", "sweep.parameter[1].to = nan: must be a finite number"),
            ("to = 0.1", 'to = 0.1\nspacing = "logarithmic"', "sweep.parameter[1].from = 0.0: must"),
            (count, 'key = "payload.mass"\nvalues = []', "[1].values = []: must be a list of"),
            ("values =", "from = 1.0\nvalues =", "[2].from = 1.0: must not stand beside values"),
            ("effects.root_compliance.stiffness", "payload.mass", "[2].key = \"payload.mass\": is"),
            ("tip_acceleration", "tip_acc", "sweep.zeros = { tip_acc = 1 }: sensor tip_acc: unk"),
            ('"fem"', '"fme"', "assumed_modes (did you mean fem?)"),
            ("[sweep]", '[sweep]\narm = "absent.toml"', "absent.toml: "),
        ):
            with self.subTest(new):
                self.assertIn(old, SWEEP)
                self.assertIn(line, self.refused(SWEEP.replace(old, new, 1)))

    def test_a_key_of_control_characters_reaches_no_terminal(self):
        self.assertNotIn("\x1b", self.refused(SWEEP + '"\\u001b[2J" = 1\n'))

    def test_options_are_checked(self):
        self.assertIn("--workers: 0: must be", self.refused(SWEEP, "--workers", "0"))
        self.assertIn("--wrokers", self.refused(SWEEP, "--wrokers", "1"))
        line = self.refused(SWEEP, "--scheduler", "tcp://127.0.0.1:9", "--workers", "1")
        self.assertIn("--workers: ", line)

    def test_a_foreign_folder_and_a_second_writer_are_refused(self):
        path = self.write(SWEEP)
        foreign = self.folder / "foreign"
        foreign.mkdir()
        (foreign / "thesis.txt").touch()
        status, _, errors = self.run_command(path, "--out", foreign)
        self.assertEqual(status, 2)
        self.assertIn("no campaign wrote", errors)
        from flexarm.campaign.task_files import output_folder

        with output_folder(self.folder / "taken"):
            status, _, errors = self.run_command(path, "--out", self.folder / "taken")
        self.assertEqual(status, 2)
        self.assertIn("another campaign writes here", errors)

    def test_without_dask_flexarm_is_imported_and_one_line_says_what_to_install(self):
        script = (
            "import sys; sys.modules['distributed'] = None; sys.modules['dask'] = None\n"
            "import flexarm, runpy\n"
            "runpy.run_module('flexarm.campaign', run_name='__main__')"
        )
        ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
        self.assertEqual(ended.returncode, 2)
        self.assertEqual(ended.stderr.count("\n"), 1, ended.stderr)
        self.assertIn("apt-get install python3-distributed", ended.stderr)


class Sweep(CampaignCase):
    def test_bytes_are_the_same_for_one_and_two_workers_and_a_resume(self):
        path = self.write(SWEEP)
        one, two = self.folder / "one", self.folder / "two"
        self.assertEqual(self.run_command(path, "--out", one, "--workers", 1)[0], 0)
        self.assertEqual(self.run_command(path, "--out", two, "--workers", 2)[0], 0)
        self.assertEqual(self.results(one), self.results(two))
        # What has a result is not run again; what has none is.
        tasks = sorted(two.glob("tasks/*/*.json"))
        self.assertEqual(len(tasks), 12)
        tasks[5].unlink()
        before = {one: one.stat().st_mtime_ns for one in tasks if one != tasks[5]}
        status, output, _ = self.run_command(path, "--out", two)
        self.assertEqual(status, 0)
        self.assertIn("11 of them from before", output)
        self.assertEqual(before, {one: one.stat().st_mtime_ns for one in before})
        self.assertEqual(self.results(one), self.results(two))
        self.numbers_are_those_of_the_module(self.rows(one))
        # What a resume writes again is read back lazily.
        for out in (one, two):
            self.assertEqual(self.run_command(path, "--out", out, "--hdf5")[0], 0)
        self.assertEqual((one / "results.h5").read_bytes(), (two / "results.h5").read_bytes())
        with open_results(one) as data:
            self.assertEqual(data.sizes, {"row": 12})
            poles = data["pole_2_Hz"]
            self.assertTrue(dask.is_dask_collection(poles.data))
            self.assertEqual(
                poles.values.tolist(), [float(row["pole_2_Hz"]) for row in self.rows(one)]
            )
            self.assertEqual(data["formulation"][1:3].values.tolist(), ["fem", "exact_tf"])

    def numbers_are_those_of_the_module(self, rows):
        self.assertEqual([int(row["index"]) for row in rows], list(range(12)))
        row = rows[11]
        self.assertEqual((row["formulation"], row["state"], row["message"]), ("fem", "done", ""))
        arm = flexarm.Arm.paper().with_(payload_mass_kg=0.1)
        arm = arm.with_effect("root_compliance", stiffness=200.0)
        model = flexarm.FiniteElements(arm, roots=2)
        self.assertEqual(float(row["pole_2_Hz"]), model.poles(2).frequency_Hz[1])
        zero = model.zeros("tip_acceleration", 1).s_rad_per_s[0]
        self.assertEqual(float(row["zero_1_tip_acceleration_real_rad_per_s"]), zero.real)

    def test_an_arm_that_is_not_allowed_is_a_failed_task(self):
        # Equal points are one task, and fail as one.
        text = SWEEP.replace("from = 0.0", "from = -0.1").replace("[100, 200.0]", "[100, 100.0]")
        path = self.write(text)
        status, output, _ = self.run_command(path, "--workers", 2)
        self.assertEqual(status, 1)
        self.assertTrue(output.startswith("task 0 failed: payload.mass = -0.1 kg: must"), output)
        failures = json.loads((self.folder / "c-results" / "failures.json").read_text())
        self.assertEqual([one["index"] for one in failures["failures"]], [0, 1, 2, 3])
        self.assertEqual(len({one["message"] for one in failures["failures"]}), 1)
        self.assertEqual(failures["failures"][0]["input"]["parameters"]["payload.mass"], -0.1)


def probe(count, rest=""):
    return f'kind = "campaign_kinds.probe"\n[probe]\ncount = {count}\n{rest}'


class KeptHashes(CampaignCase):
    def setUp(self):
        super().setUp()
        self.file = self.folder / "a.csv"
        self.file.write_text("1,2\n")
        self.kept = self.folder / "file-digests.sqlite"
        self.read = []
        digest = task_files.file_digest

        def counted(path):
            self.read.append(path)
            return digest(path)

        self.enterContext(mock.patch.object(file_digests, "file_digest", counted))
        self.enterContext(mock.patch.object(file_digests, "_SETTLED_NS", 0))

    def digest(self, path=None):
        """As a start of a campaign finds it."""
        with contextlib.closing(file_digests.FileDigests(self.kept)) as digests:
            return digests(path or self.file)

    def test_a_file_is_read_again_only_where_it_changed(self):
        first = self.digest()
        self.assertEqual(first, task_files.file_digest(self.file))
        self.assertEqual(self.digest(), first)
        self.assertEqual(len(self.read), 1)
        # Of the same size, and with the old time of modification.
        status = self.file.stat()
        self.file.write_text("1,3\n")
        os.utime(self.file, ns=(status.st_atime_ns, status.st_mtime_ns))
        self.assertNotEqual(self.digest(), first)
        self.assertEqual(len(self.read), 2)
        other = self.folder / "b.csv"
        other.write_text("1,2\n")
        other.replace(self.file)
        self.assertEqual(self.digest(), first)
        self.assertEqual(len(self.read), 3)

    def test_what_has_just_changed_or_is_missing_is_not_kept(self):
        with mock.patch.object(file_digests, "_SETTLED_NS", 10**12):
            self.digest()
            self.digest()
        self.assertEqual(len(self.read), 2)
        missing = self.folder / "none.csv"
        self.assertEqual(self.digest(missing), "cannot be read: No such file or directory")
        missing.write_text("")
        self.assertEqual(self.digest(missing), task_files.file_digest(missing))

    def test_a_file_of_kept_hashes_that_is_damaged_is_made_anew(self):
        first = self.digest()
        self.kept.write_bytes(b"no database" * 1000)
        self.assertEqual(self.digest(), first)
        self.assertEqual(self.digest(), first)
        self.assertEqual(len(self.read), 2)


class Orders(unittest.TestCase):
    def test_are_as_large_as_the_scheduler_needs_and_all_workers_allow(self):
        self.assertEqual(runner.order_size(1.0, 1000, 2), 1)
        self.assertEqual(runner.order_size(0.001, 10**6, 2), 32)
        self.assertEqual(runner.order_size(0.005, 10**6, 2), 10)
        self.assertEqual(runner.order_size(0.001, 80, 2), 5)  # each worker gets some
        # Ten thousand workers and tasks of 2 s: 25 in an order, 50 s; at the end one by one.
        self.assertEqual(runner.order_size(2.0, 10**7, 10_000), 25)
        self.assertEqual(runner.order_size(2.0, 10**4, 10_000), 1)
        self.assertEqual(runner.order_size(1e-5, 10**9, 10_000), 1000)


class Deaths(CampaignCase):
    def test_workers_that_die_cost_their_task_another_run_and_a_third_ends_it(self):
        """Task 2 ends two workers, task 4 any number."""
        path = self.write(probe(8, "2.kills = 2\n4.kills = 3\n6.fails = true"))
        status, output, errors = self.run_command(path, "--workers", 2)
        self.assertEqual(status, 1, errors)
        rows = self.rows(self.folder / "c-results")
        states = [row["state"] for row in rows]
        self.assertEqual(states, ["done"] * 4 + ["gave up", "done", "failed", "done"])
        self.assertEqual([row["square"] for row in rows[:4]], ["0", "1", "4", "9"])
        self.assertEqual(rows[4]["message"], "3 workers died while they ran it")
        self.assertTrue(output.startswith("task 4 gave up: 3 workers died while"), output)
        begun = self.begun()
        self.assertEqual((begun["2"], begun["4"], begun["0"]), (3, 3, 1))
        # A resume gives a task its three attempts again, and leaves alone what has a result.
        status, output, _ = self.run_command(path, "--workers", 2)
        self.assertEqual(status, 1)
        self.assertEqual(self.rows(self.folder / "c-results")[4]["square"], "16")
        again = self.begun()
        self.assertEqual(again["4"], 4)
        self.assertGreater(again["6"], begun["6"])  # whose answer may have died with a worker
        self.assertEqual(again["0"], begun["0"])

    def test_another_scheduler_goes_on_where_one_died(self):
        path = self.write(probe(6, "each_s = 0.3"))

        def kill():
            self.wait_for(lambda: list((self.folder / "c-results").glob("tasks/*/*.json")))
            for process in multiprocessing.active_children():
                if process.name == "campaign-scheduler":
                    os.kill(process.pid, signal.SIGKILL)

        killer = threading.Thread(target=kill)
        killer.start()
        status, _, errors = self.run_command(path, "--workers", 2)
        killer.join()
        self.assertEqual(status, 0, errors)
        self.assertEqual(errors, "flexarm-campaign: the scheduler died; a new one goes on\n")
        rows = self.rows(self.folder / "c-results")
        self.assertEqual([int(row["square"]) for row in rows], [0, 1, 4, 9, 16, 25])


class Scheduler(CampaignCase):
    def test_one_that_runs_does_the_work_and_stays(self):
        path = self.write(probe(5, "3.kills = 1"))
        local = cluster.LocalCluster(1)
        self.addCleanup(local.close)
        address = local.client.scheduler.address
        kept_alive = threading.Event()

        def tend():
            while not kept_alive.wait(0.1):
                local.tend()

        owner = threading.Thread(target=tend)
        owner.start()
        try:
            status, output, errors = self.run_command(path, "--scheduler", address)
        finally:
            kept_alive.set()
            owner.join()
        self.assertEqual(status, 0, output + errors)
        self.assertEqual([row["square"] for row in self.rows(self.folder / "c-results")],
                         ["0", "1", "4", "9", "16"])
        self.assertFalse(local.is_lost())

    def foreign_worker(self, address, preparation):
        """A worker of `address` in a process of its own, which `preparation` makes another."""
        script = (
            f"{preparation}\n"
            "import asyncio, distributed\n"
            "async def serve():\n"
            f"    async with distributed.Worker({address!r}, nthreads=1, dashboard=False) as one:\n"
            "        await one.finished()\n"
            "asyncio.run(serve())"
        )
        process = subprocess.Popen(
            [sys.executable, "-c", script], cwd=self.folder,
            env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)

    def test_a_worker_that_cannot_run_the_tasks_takes_none(self):
        """It would fail tasks more quickly than the others do them."""
        path = self.write(probe(30, "each_s = 0.1"))
        local = cluster.LocalCluster(1)
        self.addCleanup(local.close)
        address = local.client.scheduler.address
        other_build = "from flexarm.campaign import work; work.program_digest = lambda kind: 64 * '0'"
        self.foreign_worker(address, other_build)
        self.foreign_worker(address, "import sys; sys.modules['flexarm'] = None")
        self.wait_for(lambda: len(local.client.scheduler_info()["workers"]) == 3)
        status, output, errors = self.run_command(path, "--scheduler", address)
        self.assertEqual(status, 0, output + errors)
        self.assertIn("another flexarm", errors)
        self.assertRegex(errors, "worker tcp://.*flexarm.*; gets no task")
        self.assertEqual(errors.count("\n"), 2, errors)
        # Without one that can, it waits, but not for ever.
        for process in multiprocessing.active_children():
            if process.name == "campaign-worker-0":
                process.kill()
        with mock.patch.object(runner, "_WITHOUT_FIT_WORKERS_S", 1.0):
            status, _, errors = self.run_command(
                path, "--scheduler", address, "--out", self.folder / "none"
            )
        self.assertEqual(status, 2)
        self.assertIn("no worker can run the tasks, 2 cannot", errors)

    def test_why_a_worker_cannot(self):
        out = self.folder / "out"
        shared = work.Shared(
            "campaign_kinds.probe", str(self.folder), str(out), "run", 0,
            program.program_digest(work._kind("campaign_kinds.probe")),
        )
        self.assertIn(f"{out}: no such folder", work.why_unfit(shared))
        (out / "tasks").mkdir(parents=True)
        self.assertIn(f"{out}: is another folder", work.why_unfit(shared))
        with task_files.marked(out, "run"):
            self.assertIsNone(work.why_unfit(shared))
            for key, value, why in (
                ("kind", "no_such.kind", "has no kind of campaign no_such.kind"),
                ("program", "0" * 64, "another flexarm"),
                ("folder", str(self.folder / "absent"), "no such folder"),
                ("run", "another", "is another folder"),
            ):
                changed = dataclasses.replace(shared, **{key: value})
                self.assertIn(why, work.why_unfit(changed))
        self.assertFalse((out / "run").exists())

    def test_an_address_where_nothing_answers_is_refused(self):
        path = self.write(probe(1))
        with mock.patch.object(cluster, "_CONNECT_S", 0.3):
            for address in ("tcp://127.0.0.1:9", "tcp://127.0.0.1:port"):
                status, _, errors = self.run_command(path, "--scheduler", address)
                self.assertEqual((status, errors.count("\n")), (2, 1), errors)
                self.assertIn(f"--scheduler {address}: no scheduler answers", errors)


class Interrupt(CampaignCase):
    def of_group(self, group):
        """Processes of a group that are no zombies."""
        found = []
        for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
            with contextlib.suppress(OSError):
                state, _, of = stat.read_text().rpartition(")")[2].split()[:3]
                if int(of) == group and state != "Z":
                    found.append(stat.parent.name)
        return found

    def test_ctrl_c_stops_with_one_line_and_the_same_command_goes_on(self):
        path = self.write(probe(40, "each_s = 0.1"))
        process = subprocess.Popen(
            [sys.executable, "-m", "flexarm.campaign", path, "--workers", "2"],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True,
        )
        out = self.folder / "c-results"
        self.wait_for(lambda: len(list(out.glob("tasks/*/*.json"))) > 2)
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does
        output, errors = process.communicate(timeout=WAITS_S)
        self.assertEqual((process.returncode, output), (130, ""), errors)
        self.assertRegex(
            errors, r"^flexarm-campaign: stopped with \d+ of 40 tasks done;"
            r" the same command goes on from there\n$"
        )
        self.assertFalse((out / "results.csv").exists())
        self.wait_for(lambda: not self.of_group(process.pid))

if __name__ == "__main__":
    unittest.main()
