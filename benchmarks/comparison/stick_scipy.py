#!/usr/bin/python3
"""The second of friction_scipy.py with true stick: solve_ivp with events, by DOP853, since events with
LSODA end in an error of its root finder. The hub slips in the direction sigma until its velocity is
0, or sticks until the torque that holds it exceeds the friction:

    slip:  x' = A x + B (tau - sigma torque)
    stick: x' = A x + B (tau - F),  F = tau + C_v A x/(C_v B), so that C_v x' = 0

Usage: stick_scipy.py FOLDER ROWS
"""
from functools import partial

from simulation_runs import HUB_VELOCITY, measure_friction, stretches

import numpy as np
from scipy.integrate import solve_ivp

# Of the relative one.
ABSOLUTE_TOLERANCE = 1e-3
TOLERANCES = [1e-6, 1e-10]


class Arm:
    def __init__(self, case):
        self.a, b, self.c, self.d = (np.array(case[name]) for name in "abcd")
        self.b = b[:, 0]
        self.velocity = self.c[HUB_VELOCITY]
        self.coulomb_N_m = case["coulomb_torque_N_m"]

    def holding_torque(self, state, torque):
        return torque + self.velocity @ (self.a @ state) / (self.velocity @ self.b)

    def direction_from_rest(self, state, torque):
        """Of slip; 0 where friction holds the hub."""
        holding = self.holding_torque(state, torque)
        return 0.0 if abs(holding) <= self.coulomb_N_m else np.sign(holding)

    def phase(self, direction, torque):
        """Friction as a function of the state, and the event that ends the phase."""
        if direction == 0.0:
            def ends(_, state):
                return abs(self.holding_torque(state, torque)) - self.coulomb_N_m
            ends.direction = 1.0

            def friction(state):
                return self.holding_torque(state, torque)
        else:
            def ends(_, state):
                return self.velocity @ state
            ends.direction = -direction

            def friction(_):
                return direction * self.coulomb_N_m
        ends.terminal = True
        return friction, ends


def simulated(case, tolerance):
    arm = Arm(case)
    torque = np.array(case["torque_N_m"])
    step_s = case["sample_time_s"]
    state = np.zeros(len(arm.a))
    direction = arm.direction_from_rest(state, torque[0])
    readings = np.empty((len(arm.c), len(torque)))
    for begin, end in stretches(torque):
        held = torque[begin]
        times = step_s * np.arange(end - begin + 1)
        if direction == 0.0:
            direction = arm.direction_from_rest(state, held)
        now_s, sample = 0.0, 0
        while now_s < times[-1]:
            friction, event = arm.phase(direction, held)
            solution = solve_ivp(lambda _, x: arm.a @ x + arm.b * (held - friction(x)),
                                 (now_s, times[-1]), state, method="DOP853",
                                 t_eval=times[sample:], events=event, rtol=tolerance,
                                 atol=ABSOLUTE_TOLERANCE * tolerance)
            # Empty where the event comes before the next sample.
            states = np.reshape(solution.y, (len(state), -1)).T
            for x in states[:end - begin - sample]:
                readings[:, begin + sample] = arm.c @ x + arm.d[:, 0] * (held - friction(x))
                sample += 1
            if solution.status == 0:
                state, now_s = states[-1], times[-1]
            else:
                state, now_s = solution.y_events[0][0], solution.t_events[0][0]
                direction = (np.sign(arm.holding_torque(state, held)) if direction == 0.0
                             else arm.direction_from_rest(state, held))
    return readings


def main():
    measure_friction([(f"events tolerance:{tolerance:g}", partial(simulated, tolerance=tolerance))
                      for tolerance in TOLERANCES])


if __name__ == "__main__":
    main()
