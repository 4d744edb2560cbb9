#!/usr/bin/python3
"""Ten poles of the paper's arm from assembled matrices: all of a dense pair by eigh, ten of a sparse
pair by eigsh in shift-invert. The time is that of the solver; assembly is not in it. Errors are
those of the ten frequencies against 30 digits, and that of the first.

Usage: matrices_scipy.py FOLDER ROWS
"""
import os

import measured_rows

import numpy as np
import scipy
from scipy.linalg import eigh
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import eigsh

POLES = 10
# Dense solvers take time with the third power, and memory with the second.
LARGEST_DENSE = 300
# A shift below all eigenvalues: the stiffness alone is singular, the arm turns freely. [rad^2/s^2]
SHIFT = -1.0


def matrix(folder, name, size):
    rows, columns, values = np.fromfile(os.path.join(folder, name)).reshape(3, -1)
    return csc_matrix((values, (rows.astype(int), columns.astype(int))), shape=(size, size))


def errors(omega_squared):
    found_Hz = np.sqrt(np.sort(np.abs(omega_squared))[1:POLES + 1]) / (2.0 * np.pi)
    relative = np.abs(found_Hz / np.array(measured_rows.reference_Hz("pole_hz")) - 1.0)
    return {"error": np.max(relative), "error_of_first": relative[0]}


def main():
    folder, path = measured_rows.arguments()
    case = measured_rows.document(folder, "matrices.json")
    rows = measured_rows.Rows(f"SciPy {scipy.__version__}")
    for one in case["elements"]:
        count, size = one["elements"], one["size"]
        stiffness = matrix(folder, f"elements-{count}-stiffness.f64", size)
        mass = matrix(folder, f"elements-{count}-mass.f64", size)
        if count <= LARGEST_DENSE:
            dense = stiffness.toarray(), mass.toarray()
            spent_s, found = measured_rows.timed(
                lambda: eigh(*dense, eigvals_only=True, subset_by_index=[0, POLES]))
            rows.add(f"eigh elements:{count}", spent_s, **errors(found))
        spent_s, found = measured_rows.timed(
            lambda: eigsh(stiffness, POLES + 1, mass, sigma=SHIFT, return_eigenvectors=False))
        rows.add(f"eigsh elements:{count}", spent_s, **errors(found))
    functions = (np.array(case["functions_stiffness_N_m"]), np.array(case["functions_mass_kg_m2"]))
    spent_s, found = measured_rows.timed(lambda: eigh(*functions, eigvals_only=True,
                                                      subset_by_index=[0, POLES]))
    rows.add(f"eigh functions:{case['functions']}", spent_s, **errors(found))
    rows.write(path)


if __name__ == "__main__":
    main()
