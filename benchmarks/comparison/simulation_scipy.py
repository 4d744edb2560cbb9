#!/usr/bin/python3
"""The linear simulation of simulation_benchmark in SciPy. Differences to flexarm's sensors, relative
to their peaks.

Usage: simulation_scipy.py FOLDER ROWS
"""
import measured_rows
from simulation_runs import relative_difference

import numpy as np
import scipy
from scipy import signal


def main():
    folder, path = measured_rows.arguments()
    case = measured_rows.document(folder, "simulation.json")
    system = tuple(np.array(case[name]) for name in "abcd")
    step_s = case["sample_time_s"]
    torque = np.array(case["torque_N_m"])
    times = step_s * np.arange(len(torque))
    sampled = signal.cont2discrete(system, step_s, method="zoh")
    flexarm = np.array(case["channels"])
    rows = measured_rows.Rows(f"SciPy {scipy.__version__}")
    runs = {"dlsim": lambda: signal.dlsim(sampled, torque)[1],
            "lsim": lambda: signal.lsim(system, torque, times, interp=False)[1]}
    for name, run in runs.items():
        spent_s, channels = measured_rows.timed(run)
        rows.add(f"{name} modes:{case['modes']}", spent_s,
                 relative_difference(channels.T, flexarm),
                 samples_per_s=len(torque) / spent_s)
    rows.write(path)


if __name__ == "__main__":
    main()
