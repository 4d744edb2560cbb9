"""What the scripts that simulate share. Readings are arrays of a row a channel, a column a sample."""
import measured_rows

import numpy as np
import scipy

HUB_ANGLE, HUB_VELOCITY = 0, 1


def relative_difference(found, exact):
    """The largest of the channels, each relative to its peak."""
    return np.max(np.max(np.abs(found - exact), axis=1) / np.max(np.abs(exact), axis=1))


def stretches(torque):
    """Begin and end, in samples, of each step of torque."""
    begins = np.flatnonzero(np.diff(torque, prepend=np.nan) != 0.0)
    return zip(begins, np.append(begins[1:], len(torque)))


def measure_friction(runs):
    """Writes the rows of a script on friction.json: of each of `runs`, a name and a function of the
    case that returns readings. Errors are those of hub angle and hub velocity."""
    folder, path = measured_rows.arguments()
    case = measured_rows.document(folder, "friction.json")
    hub = [HUB_ANGLE, HUB_VELOCITY]
    exact = np.array(case["channels"])[hub]
    rows = measured_rows.Rows(f"SciPy {scipy.__version__}")
    for name, run in runs:
        spent_s, readings = measured_rows.timed(lambda: run(case))
        rows.add(name, spent_s, relative_difference(readings[hub], exact))
    rows.write(path)
