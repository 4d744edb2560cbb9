"""Results as objects of SciPy, python-control and xarray, each imported when it is asked for."""


def _imported(module, what, package):
    import importlib

    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError(
            f"{what} needs {package}, which is not installed"
        ) from error


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


def to_scipy(system, ignore_delays):
    signal = _imported("scipy.signal", "to_scipy", "SciPy")
    if not ignore_delays:
        _require_no_delays(system, "scipy.signal.StateSpace")
    return signal.StateSpace(system.A, system.B, system.C, system.D)


def to_control(system, ignore_delays):
    control = _imported("control", "to_control", "python-control")
    if not ignore_delays:
        _require_no_delays(system, "control.StateSpace")
    return control.ss(
        system.A,
        system.B,
        system.C,
        system.D,
        inputs=["torque"],
        outputs=list(system.sensors),
        states=list(system.states),
    )


def _variables(xarray, names, units, arrays, dimension, coordinate, unit):
    """A dataset with a variable for each name over one coordinate, units as attributes."""
    return xarray.Dataset(
        {
            name: (dimension, array, {"units": of})
            for name, of, array in zip(names, units, arrays)
        },
        coords={dimension: (dimension, coordinate, {"units": unit})},
    )


def response_to_xarray(response):
    xarray = _imported("xarray", "to_xarray", "xarray")
    return _variables(
        xarray,
        response.sensors,
        [f"{unit}/(N m)" for unit in response.units],
        response.values,
        "frequency",
        response.frequency_Hz,
        "Hz",
    )


def record_to_xarray(record):
    """Of anything with time_s, torque_N_m, sensors, units and a row for each sensor."""
    xarray = _imported("xarray", "to_xarray", "xarray")
    return _variables(
        xarray,
        ["torque", *record.sensors],
        ["N m", *record.units],
        [record.torque_N_m, *(record[sensor] for sensor in record.sensors)],
        "time",
        record.time_s,
        "s",
    )
