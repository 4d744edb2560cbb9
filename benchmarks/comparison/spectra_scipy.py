#!/usr/bin/python3
"""The spectra of spectra_benchmark in SciPy, on one core, at the same settings: welch of each channel
and csd from the torque, then coherence, which forms the spectra anew. Time beside the largest
difference to flexarm's, relative to the largest line; exit status 1 where one is above 1e-12.

Usage: spectra_scipy.py FOLDER ROWS, with FOLDER as spectra_files filled it
"""
import os
import sys

import measured_rows

import numpy as np
import scipy
from scipy import signal

# Both sum some thousand segments of transforms of 8192 samples: 2e-16 times a few tens.
TOLERANCE = 1e-12


def main():
    folder, path = measured_rows.arguments()
    case = measured_rows.document(folder, "case.json")

    def read(name, kind=np.float64):
        return np.fromfile(os.path.join(folder, name), dtype=kind)

    segment = case["segment_samples"]
    settings = dict(fs=case["sampling_frequency_Hz"], window="hann", nperseg=segment,
                    noverlap=segment - case["shift_samples"], detrend="constant")
    channels = range(case["channels"])
    torque = read("torque.f64")
    values = [read(f"channel-{i}.f64") for i in channels]

    def powers():
        return [signal.welch(x, **settings)[1] for x in [torque] + values]

    def cross():
        return [signal.csd(torque, x, **settings)[1] for x in values]

    def coherence():
        return [signal.coherence(torque, x, **settings)[1] for x in values]

    runs = {
        "welch": (powers, [read("torque-power.f64")] + [read(f"channel-{i}-power.f64")
                                                        for i in channels]),
        "csd": (cross, [read(f"channel-{i}-cross.c128", np.complex128) for i in channels]),
        "coherence": (coherence, [read(f"channel-{i}-coherence.f64") for i in channels]),
    }
    # A transform rounds every line by what its largest needs: of a ratio of powers a share of
    # sqrt(largest/own) more.
    own = [np.sqrt(p / np.max(p[1:])) for p in (read(f"channel-{i}-power.f64") for i in channels)]
    rows = measured_rows.Rows(f"SciPy {scipy.__version__}")
    for name, (run, flexarm) in runs.items():
        spent_s, found = measured_rows.timed(run)
        weights = own if name == "coherence" else [1.0 / np.max(np.abs(b[1:])) for b in flexarm]
        # Line 0 holds what rounding leaves of the mean.
        rows.add(name, spent_s, max(np.max((np.abs(a - b) * w)[1:])
                                    for a, b, w in zip(found, flexarm, weights)))
    of = {row["work"]: row for row in rows.rows}
    rows.add("welch and csd", of["welch"]["processor_s"] + of["csd"]["processor_s"],
             max(of["welch"]["error"], of["csd"]["error"]))
    rows.write(path)
    agree = all(row["error"] < TOLERANCE for row in rows.rows)
    return 0 if agree else 1


if __name__ == "__main__":
    sys.exit(main())
