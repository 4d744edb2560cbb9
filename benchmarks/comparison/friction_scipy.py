#!/usr/bin/python3
"""A second with Coulomb friction at the hub by solve_ivp. Its right-hand side must be smooth:
friction is torque tanh(v/width), with v the hub velocity. Each step of torque is integrated by
itself. Errors are the largest differences of hub angle and hub velocity to a converged simulation
with true stick, relative to their peaks.

Usage: friction_scipy.py FOLDER ROWS
"""
from functools import partial

from simulation_runs import HUB_VELOCITY, measure_friction, stretches

import numpy as np
from scipy.integrate import solve_ivp

# Of the relative one.
ABSOLUTE_TOLERANCE = 1e-3
# Method, width [rad/s] and relative tolerance.
SETTINGS = [("LSODA", 1e-3, 1e-6), ("Radau", 1e-3, 1e-6), ("LSODA", 1e-5, 1e-6),
            ("LSODA", 1e-7, 1e-8), ("LSODA", 1e-8, 1e-10)]


class Arm:
    """x' = A x + B (tau - friction(C_v x)), y = C x + D (tau - friction)."""

    def __init__(self, case, width_rad_per_s):
        self.a, self.b, self.c, self.d = (np.array(case[name]) for name in "abcd")
        self.velocity = self.c[HUB_VELOCITY]
        self.coulomb_N_m = case["coulomb_torque_N_m"]
        self.width_rad_per_s = width_rad_per_s

    def friction(self, state):
        return self.coulomb_N_m * np.tanh(self.velocity @ state / self.width_rad_per_s)

    def rate(self, state, torque):
        return self.a @ state + self.b[:, 0] * (torque - self.friction(state))

    def jacobian(self, state):
        slope = (self.coulomb_N_m / self.width_rad_per_s
                 * (1.0 - np.tanh(self.velocity @ state / self.width_rad_per_s)**2))
        return self.a - slope * np.outer(self.b[:, 0], self.velocity)

    def readings(self, states, torque):
        return self.c @ states + self.d * (torque - self.friction(states))


def simulated(case, method, width_rad_per_s, tolerance):
    arm = Arm(case, width_rad_per_s)
    torque = np.array(case["torque_N_m"])
    step_s = case["sample_time_s"]
    state = np.zeros(len(arm.a))
    channels = []
    for begin, end in stretches(torque):
        held = torque[begin]
        times = step_s * np.arange(end - begin + 1)
        options = {} if method == "LSODA" else {"jac": lambda _, x: arm.jacobian(x)}
        solution = solve_ivp(lambda _, x: arm.rate(x, held), (0.0, times[-1]), state, method=method,
                             t_eval=times, rtol=tolerance, atol=ABSOLUTE_TOLERANCE * tolerance,
                             **options)
        state = solution.y[:, -1]
        channels.append(arm.readings(solution.y[:, :-1], held))
    return np.concatenate(channels, axis=1)


def main():
    measure_friction([(f"{method} width:{width:g} tolerance:{tolerance:g}",
                       partial(simulated, method=method, width_rad_per_s=width,
                               tolerance=tolerance))
                      for method, width, tolerance in SETTINGS])


if __name__ == "__main__":
    main()
