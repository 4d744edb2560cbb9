#!/usr/bin/python3
"""The linear simulation of simulation_benchmark in SciPy, on one core: samples a second beside the
largest difference to flexarm's sensors, relative to their peaks.

Usage: simulation_state_space | simulation_scipy.py
"""
import os

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import json
import sys
import time

import numpy as np
from scipy import signal

REPETITIONS = 3


def main():
    case = json.load(sys.stdin)
    system = tuple(np.array(case[name]) for name in "abcd")
    step = case["sample_time_s"]
    torque = np.array(case["torque_N_m"])
    times = step * np.arange(len(torque))
    sampled = signal.cont2discrete(system, step, method="zoh")
    runs = {
        "dlsim": lambda: signal.dlsim(sampled, torque)[1],
        "lsim": lambda: signal.lsim(system, torque, times, interp=False)[1],
    }
    flexarm = np.array(case["channels"]).T
    for name, run in runs.items():
        spent = []
        for _ in range(REPETITIONS):
            begin = time.process_time()
            channels = run()
            spent.append(time.process_time() - begin)
        difference = np.max(np.abs(channels - flexarm), axis=0) / np.max(np.abs(flexarm), axis=0)
        label = f"scipy.signal.{name}, linear modes:{case['modes']}"
        print(f"{label:<64} {1e3 * min(spent):>9.4g} ms  difference {np.max(difference):<9.3g}  "
              f"samples_per_s {len(torque) / min(spent):.3g}")


if __name__ == "__main__":
    main()
