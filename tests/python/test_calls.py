"""Long calls: the interpreter's lock, Ctrl-C, progress; and what arrays keep alive."""

import gc
import io
import os
import pty
import resource
import signal
import subprocess
import sys
import threading
import time
import unittest
from unittest import mock

import numpy as np

import flexarm
from flexarm import _progress

# A call of some seconds: friction that varies with the speed is stepped with small steps.
LONG = """
import flexarm, numpy
arm = flexarm.Arm.paper().with_effect("stribeck_friction", torque=0.01, static_torque=0.02, velocity=0.1)
torque = 0.05 * numpy.sin(numpy.arange(2_000_000) * 0.02)
"""
LONG_CALL = "flexarm.simulate(arm, torque, sample_time_s=1e-3)"
STOPS_WITHIN_S = 0.5


class Lock(unittest.TestCase):
    def count_while(self, call):
        """How often another thread gets its turn while the call goes on."""
        counted, ended = 0, threading.Event()

        def count():
            nonlocal counted
            while not ended.is_set():
                counted += 1
                time.sleep(1e-3)

        other = threading.Thread(target=count)
        begun = time.monotonic()
        other.start()
        call()
        elapsed_s = time.monotonic() - begun
        ended.set()
        other.join()
        return counted, elapsed_s

    def test_other_threads_go_on_meanwhile(self):
        exact = flexarm.ExactTransferFunction(flexarm.Arm.paper())
        torque = flexarm.sampled_torque("multisine:to=60", duration_s=200.0, sample_time_s=1e-3)
        for call in (
            lambda: exact.transfer_function("hub_angle", 1j * np.linspace(1.0, 900.0, 100000)),
            lambda: exact.poles(20000),
            lambda: flexarm.simulate(flexarm.Arm.paper(), torque, sample_time_s=1e-3, modes=20),
        ):
            counted, elapsed_s = self.count_while(call)
            self.assertGreater(elapsed_s, 0.05)
            self.assertGreater(counted, 10)

    def test_one_formulation_serves_several_threads(self):
        exact = flexarm.ExactTransferFunction(flexarm.Arm.paper())
        s = 1j * np.linspace(1.0, 900.0, 2000)
        found = [None] * 4

        def work(i):
            found[i] = exact.transfer_function("hub_angle", s)

        threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for values in found:
            np.testing.assert_array_equal(values, found[0])


class Interrupt(unittest.TestCase):
    def test_ctrl_c_stops_within_half_a_second(self):
        script = LONG + f"""
import sys, time
print("ready", flush=True)
try:
    {LONG_CALL}
except KeyboardInterrupt:
    print("stopped", time.monotonic(), flush=True)
"""
        process = subprocess.Popen(
            [sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        self.assertEqual(process.stdout.readline(), "ready\n")
        time.sleep(0.7)
        sent = time.monotonic()
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=60)
        word, stopped = output.split()
        self.assertEqual(word, "stopped", errors)
        self.assertLess(float(stopped) - sent, STOPS_WITHIN_S)
        self.assertEqual(process.returncode, 0)


class Progress(unittest.TestCase):
    def simulate(self, **arguments):
        torque = np.sin(np.linspace(0.0, 600.0, 300_000)) * 0.05
        return flexarm.simulate(
            flexarm.Arm.paper(), torque, sample_time_s=1e-3, modes=20, **arguments
        )

    def test_a_callback_hears_the_fraction_in_the_calling_thread(self):
        heard = []
        self.simulate(progress=lambda f: heard.append((f, threading.get_ident())))
        self.assertEqual(heard[-1][0], 1.0)
        self.assertEqual(heard, sorted(heard))
        self.assertEqual({thread for _, thread in heard}, {threading.get_ident()})

    def test_a_callback_that_raises_stops_the_call(self):
        class Enough(Exception):
            pass

        def stop(fraction):
            raise Enough

        with self.assertRaises(Enough):
            self.simulate(progress=stop)

    def test_nothing_is_written_where_nobody_looks(self):
        with mock.patch.object(sys, "stderr", io.StringIO()) as stream:
            self.simulate()
        self.assertEqual(stream.getvalue(), "")

    def test_a_line_is_written_and_wiped(self):
        stream = io.StringIO()
        stream.isatty = lambda: True
        with mock.patch.object(sys, "stderr", stream), mock.patch.dict(os.environ, TERM="xterm"):
            line = _progress.line_of("diagnosis")
            line(0.1, "")
            self.assertEqual(stream.getvalue(), "")
            line._next = 0.0
            line(0.5, "8 s left")
            line.close()
        self.assertRegex(stream.getvalue(), r"^\rdiagnosis  50 %, 8 s left\r +\r$")

    def test_a_terminal_that_cannot_rewrite_a_line_gets_none(self):
        stream = io.StringIO()
        stream.isatty = lambda: True
        with mock.patch.object(sys, "stderr", stream), mock.patch.dict(os.environ):
            for kind in ("dumb", ""):
                os.environ["TERM"] = kind
                self.assertIsNone(_progress.line_of("diagnosis"))
            del os.environ["TERM"]
            self.assertIsNone(_progress.line_of("diagnosis"))

    def test_a_terminal_shows_it(self):
        leader, follower = pty.openpty()
        script = LONG + "import _thread, threading\nthreading.Timer(2.0, _thread.interrupt_main).start()\n"
        script += f"try:\n    {LONG_CALL}\nexcept KeyboardInterrupt:\n    pass\n"
        with mock.patch.dict(os.environ, TERM="xterm"):
            subprocess.run([sys.executable, "-c", script], stderr=follower, timeout=60, check=True)
        os.close(follower)
        shown = os.read(leader, 1 << 16).decode()
        os.close(leader)
        self.assertRegex(shown, r"simulation  \d+ %")


class Arrays(unittest.TestCase):
    def test_a_view_keeps_its_owner_alive(self):
        omega = flexarm.ExactTransferFunction(flexarm.Arm.paper()).poles(50).omega_rad_per_s
        before = omega.copy()
        gc.collect()
        np.ones(100_000)
        np.testing.assert_array_equal(omega, before)
        with self.assertRaises(ValueError):
            omega[0] = 1.0

    def test_a_view_copies_nothing(self):
        poles = flexarm.ExactTransferFunction(flexarm.Arm.paper()).poles(5)
        first, second = poles.omega_rad_per_s, poles.omega_rad_per_s
        self.assertTrue(np.shares_memory(first, second))
        system = flexarm.ExactTransferFunction(flexarm.Arm.paper()).state_space()
        self.assertTrue(np.shares_memory(system.A, system.A))
        self.assertFalse(system.A.flags.owndata)

    def test_arrays_are_given_back(self):
        exact = flexarm.ExactTransferFunction(flexarm.Arm.paper())
        s = 1j * np.linspace(1.0, 2.0, 2000)
        torque = np.zeros(20_000)

        def once():
            exact.transfer_function("hub_angle", s)
            exact.poles(20).omega_rad_per_s.sum()
            exact.modes(5, "hub_angle", [0.1]).displacement_m.sum()
            flexarm.simulate(flexarm.Arm.paper(), torque, sample_time_s=1e-3, modes=1)["hub_angle"]

        for _ in range(5):
            once()
        before_kB = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        for _ in range(40):
            once()
        grown_kB = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before_kB
        # Each turn makes 20,000 samples of 5 arrays: 40 that are kept would be 32,000 kB.
        self.assertLess(grown_kB, 8_000)


if __name__ == "__main__":
    unittest.main()
