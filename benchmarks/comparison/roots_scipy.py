#!/usr/bin/python3
"""Poles and hub zeros of the paper's arm by brentq, from brackets of a scan that NumPy does at once.

With u = exp(-lambda) the functions are divided by cosh(lambda), which overflows at 710:

    poles:      cos tanh - sin - epsilon lambda^3 (1/cosh + cos) = 0
    hub zeros:  1/cosh + cos = 0

Usage: roots_scipy.py FOLDER ROWS
"""
import measured_rows

import numpy as np
import scipy
from scipy.optimize import brentq

# Neighbouring roots are some pi apart.
SCAN_STEP = 0.1


def inverse_cosh(lam):
    u = np.exp(-lam)
    return 2.0 * u / (1.0 + u * u)


def hub_zero_function(lam):
    return inverse_cosh(lam) + np.cos(lam)


def pole_function(lam, epsilon):
    return (np.cos(lam) * np.tanh(lam) - np.sin(lam)
            - epsilon * lam**3 * (inverse_cosh(lam) + np.cos(lam)))


def roots(function, count, first):
    """The first `count` roots above `first`."""
    grid = np.arange(first, np.pi * (count + 1.5), SCAN_STEP)
    values = function(grid)
    left = np.flatnonzero(np.signbit(values[:-1]) != np.signbit(values[1:]))[:count]
    return np.array([brentq(function, grid[i], grid[i + 1], xtol=1e-15, rtol=1e-15)
                     for i in left])


def largest_error(found, known):
    return np.max(np.abs(found / np.array(known) - 1.0)) if len(found) == len(known) else np.nan


def main():
    folder, path = measured_rows.arguments()
    arm = measured_rows.document(folder, "roots.json")
    length_m = arm["length_m"]
    density_kg_per_m = arm["linear_density_kg_per_m"]
    epsilon = arm["hub_inertia_kg_m2"] / (density_kg_per_m * length_m**3)
    scale_Hz = (np.sqrt(arm["flexural_rigidity_N_m2"] / (density_kg_per_m * length_m**4))
                / (2.0 * np.pi))

    def poles(count):
        return roots(lambda lam: pole_function(lam, epsilon), count, 0.5)

    def hub_zeros(count):
        return roots(hub_zero_function, count, 0.5)

    rows = measured_rows.Rows(f"SciPy {scipy.__version__}")
    spent_s, (found_poles, found_zeros) = measured_rows.timed(lambda: (poles(10), hub_zeros(10)), 20)
    error = max(largest_error(scale_Hz * found_poles**2, measured_rows.reference_Hz("pole_hz")),
                largest_error(scale_Hz * found_zeros**2, measured_rows.reference_Hz("hub_zero_hz")))
    rows.add("brentq poles and hub zeros:10", spent_s, error)
    for name, find, known in (("poles", poles, arm["pole_lambda"]),
                              ("hub zeros", hub_zeros, arm["hub_zero_lambda"])):
        spent_s, found = measured_rows.timed(lambda: find(1000))
        rows.add(f"brentq {name}:1000", spent_s, largest_error(found, known))
    rows.write(path)


if __name__ == "__main__":
    main()
