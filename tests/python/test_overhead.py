"""What a call from Python costs over the same call in C++."""

import os
import subprocess
import time
import unittest

import flexarm

# Relative to the call in C++, so that the speed of the machine does not count.
MOST_OVERHEAD = 0.4
CALLS = 200
REPETITIONS = 40
# Another process on the machine makes a repetition slower, never faster.
ATTEMPTS = 5


def in_python_ns(call):
    least = float("inf")
    for _ in range(REPETITIONS):
        begun = time.perf_counter_ns()
        for _ in range(CALLS):
            call()
        least = min(least, (time.perf_counter_ns() - begun) / CALLS)
    return least


class Overhead(unittest.TestCase):
    def test_poles_cost_little_more_than_in_cpp(self):
        exact = flexarm.ExactTransferFunction(flexarm.Arm.paper())
        for _ in range(ATTEMPTS):
            in_cpp_ns = float(
                subprocess.run(
                    [os.environ["FLEXARM_POLES_TIMING"], str(CALLS), str(REPETITIONS)],
                    check=True, capture_output=True, text=True,
                ).stdout
            )
            of_call_ns = in_python_ns(lambda: exact.poles(1))
            of_array_ns = in_python_ns(lambda: exact.poles(1).omega_rad_per_s)
            print(
                f"poles(1): C++ {in_cpp_ns:.0f} ns, Python {of_call_ns:.0f} ns, with its array "
                f"{of_array_ns:.0f} ns: {of_array_ns - in_cpp_ns:.0f} ns more"
            )
            if of_array_ns - in_cpp_ns <= MOST_OVERHEAD * in_cpp_ns:
                break
        self.assertLessEqual(of_array_ns - in_cpp_ns, MOST_OVERHEAD * in_cpp_ns)


if __name__ == "__main__":
    unittest.main()
