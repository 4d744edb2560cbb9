"""Results as objects of SciPy, python-control and xarray, each imported when it is asked for."""

from ._flexarm import FrequencyResponse, SimulatedRun, StateSpace, TimeRun
from ._methods import imported, method


def _require_no_delays(system, kind):
    delays = [
        f"{delay_s:g} s of {name}"
        for name, delay_s in [
            ("the torque", system.delay_s),
            *zip(system.sensors, system.output_delay_s),
        ]
        if delay_s != 0.0
    ]
    if delays:
        raise ValueError(
            f"{kind} has no delays; the arm has {', '.join(delays)}. With ignore_delays=True "
            "they are left out"
        )


@method("to_scipy", StateSpace)
def state_space_to_scipy(self, *, ignore_delays=False):
    """scipy.signal.StateSpace of A, B, C, D. It has no delays: raises ValueError where there are
    some. Raises ImportError where SciPy is not installed.

    Arguments:
      ignore_delays: leave delays out instead
    """
    signal = imported("scipy.signal", "to_scipy", "SciPy")
    if not ignore_delays:
        _require_no_delays(self, "scipy.signal.StateSpace")
    return signal.StateSpace(self.A, self.B, self.C, self.D)


@method("to_control", StateSpace)
def state_space_to_control(self, *, ignore_delays=False):
    """control.StateSpace (python-control) of A, B, C, D, with names of input, outputs and states.
    Delays as in to_scipy. Raises ImportError where python-control is not installed.

    Arguments:
      ignore_delays: leave delays out instead of raising ValueError
    """
    control = imported("control", "to_control", "python-control")
    if not ignore_delays:
        _require_no_delays(self, "control.StateSpace")
    return control.ss(
        self.A,
        self.B,
        self.C,
        self.D,
        inputs=["torque"],
        outputs=list(self.sensors),
        states=list(self.states),
    )


def _dataset(names, units, arrays, dimension, coordinate, unit):
    """A dataset with a variable for each name over one coordinate, units as attributes."""
    xarray = imported("xarray", "to_xarray", "xarray")
    return xarray.Dataset(
        {
            name: (dimension, array, {"units": of})
            for name, of, array in zip(names, units, arrays)
        },
        coords={dimension: (dimension, coordinate, {"units": unit})},
    )


@method("to_xarray", FrequencyResponse)
def frequency_response_to_xarray(self):
    """xarray.Dataset with a complex variable for each sensor over frequency [Hz], units as
    attributes. Raises ImportError where xarray is not installed."""
    units = [f"{unit}/(N m)" for unit in self.units]
    return _dataset(self.sensors, units, self.values, "frequency", self.frequency_Hz, "Hz")


@method("to_xarray", SimulatedRun, TimeRun)
def record_to_xarray(self):
    """xarray.Dataset with torque and sensors over time [s], units as attributes. Raises ImportError
    where xarray is not installed."""
    return _dataset(
        ["torque", *self.sensors],
        ["N m", *self.units],
        [self.torque_N_m, *(self[sensor] for sensor in self.sensors)],
        "time",
        self.time_s,
        "s",
    )
