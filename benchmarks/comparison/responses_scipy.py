#!/usr/bin/python3
"""Frequency responses of the hub angle at 64 frequencies from modal state spaces: by
scipy.signal.freqresp, by a linear solve a frequency, and by partial fractions over the eigenvalues
of A. Errors relative to the exact value at each frequency.

Usage: responses_scipy.py FOLDER ROWS
"""
import warnings

import measured_rows

import numpy as np
import scipy
from scipy import signal


def by_solve(system, omega):
    a, b, c, d = system
    pencils = 1j * omega[:, None, None] * np.eye(len(a)) - a
    return (c @ np.linalg.solve(pencils, np.broadcast_to(b, (len(omega), *b.shape)))
            + d)[:, 0, 0]


def by_partial_fractions(system, omega):
    a, b, c, d = system
    poles, vectors = np.linalg.eig(a)
    residues = (c @ vectors)[0] * np.linalg.solve(vectors, b)[:, 0]
    return (residues / (1j * omega[:, None] - poles)).sum(axis=1) + d[0, 0]


def main():
    folder, path = measured_rows.arguments()
    case = measured_rows.document(folder, "responses.json")
    omega = np.array(case["omega_rad_per_s"])
    exact = np.array(case["real_rad_per_N_m"]) + 1j * np.array(case["imaginary_rad_per_N_m"])
    rows = measured_rows.Rows(f"SciPy {scipy.__version__}")
    # freqresp goes through the polynomials of the transfer function and says that they are bad.
    warnings.simplefilter("ignore")
    for one in case["systems"]:
        system = tuple(np.array(one[name]) for name in "abcd")
        runs = {"freqresp": lambda: signal.freqresp(system, omega)[1],
                "solve": lambda: by_solve(system, omega),
                "partial fractions": lambda: by_partial_fractions(system, omega)}
        for name, run in runs.items():
            work = f"{name} modes:{one['modes']}"
            try:
                spent_s, found = measured_rows.timed(run)
            except np.linalg.LinAlgError as error:
                rows.add_failure(work, error)
                continue
            rows.add(work, spent_s, np.max(np.abs(found - exact) / np.abs(exact)))
    rows.write(path)


if __name__ == "__main__":
    main()
