"""Tables and records as DataFrames of pandas, which is imported when they are asked for. Columns of
records have the names that TimeRun and FrequencyRun take."""

from ._flexarm import (
    DampedPoles,
    Diagnosis,
    FrequencyResponse,
    FrequencyRun,
    Identification,
    ModalRun,
    Modes,
    Plan,
    Poles,
    SimulatedRun,
    SteppedSineRun,
    TimeRun,
    Zeros,
)
from ._methods import imported, method


def _frame(rows, index=None):
    pandas = imported("pandas", "to_pandas", "pandas")
    frame = pandas.DataFrame(rows)
    return frame if index is None else frame.set_index(index)


def _column(quantity, unit):
    """'hub_velocity_rad_per_s'; a strain, which has no unit, by its name alone."""
    in_name = unit.replace("/", "_per_").replace(" ", "_").replace("^", "")
    return quantity if unit == "1" else f"{quantity}_{in_name}"


@method("to_pandas", TimeRun, SimulatedRun)
def record_to_pandas(self):
    """pandas.DataFrame over time_s with torque_N_m and a column for each sensor, named with its
    unit, hub_angle_rad; of a closed loop also reference_UNIT. Raises ImportError where pandas is
    not installed."""
    columns = {"time_s": self.time_s, "torque_N_m": self.torque_N_m}
    for sensor, unit in zip(self.sensors, self.units):
        columns[_column(sensor, unit)] = self[sensor]
    if self.reference is not None:
        columns[_column("reference", self.reference_unit)] = self.reference
    return _frame(columns, "time_s")


@method("to_pandas", FrequencyResponse, SteppedSineRun)
def response_to_pandas(self):
    """pandas.DataFrame over frequency_Hz with a complex column for each sensor, named with its unit
    per N m, hub_angle_rad_per_N_m. Raises ImportError where pandas is not installed."""
    columns = {"frequency_Hz": self.frequency_Hz}
    for sensor, unit in zip(self.sensors, self.units):
        columns[_column(sensor, unit) + "_per_N_m"] = self[sensor]
    return _frame(columns, "frequency_Hz")


@method("to_pandas", FrequencyRun)
def frequency_run_to_pandas(self):
    """pandas.DataFrame over frequency_Hz with a complex column for each sensor, named with its unit
    per that of the input, hub_angle_rad_per_N_m, and its coherence, hub_angle_coherence; NaN where
    a sensor has no such frequency. Raises ImportError where pandas is not installed."""
    pandas = imported("pandas", "to_pandas", "pandas")
    per = {"torque": "_per_N_m", "hub_angle": "_per_rad", "hub_velocity": "_per_rad_per_s"}
    parts = [
        _frame(
            {
                "frequency_Hz": self.frequency_Hz(sensor),
                _column(sensor, unit) + per[self.input]: self[sensor],
                f"{sensor}_coherence": self.coherence(sensor),
            },
            "frequency_Hz",
        )
        for sensor, unit in zip(self.sensors, self.units)
    ]
    return pandas.concat(parts, axis=1).sort_index()


def _rows(objects, attributes):
    return [{name: getattr(one, name) for name in attributes} for one in objects]


@method("to_pandas", ModalRun)
def modal_run_to_pandas(self):
    """pandas.DataFrame with a row for each entry, its columns the arguments of ModalEntry. Raises
    ImportError where pandas is not installed."""
    names = ["feature", "frequency_Hz", "sensor", "order", "frequency_std_Hz", "damping_ratio",
             "damping_ratio_std"]
    return _frame(_rows(self.entries, names))


@method("to_pandas", Poles)
def poles_to_pandas(self):
    """pandas.DataFrame with a row for each pole: frequency_Hz, omega_rad_per_s. Raises ImportError
    where pandas is not installed."""
    return _frame({"frequency_Hz": self.frequency_Hz, "omega_rad_per_s": self.omega_rad_per_s})


@method("to_pandas", DampedPoles)
def damped_poles_to_pandas(self):
    """pandas.DataFrame with a row for each pair of poles: frequency_Hz, damping_ratio,
    s_rad_per_s, the first of the pair. Raises ImportError where pandas is not installed."""
    return _frame({
        "frequency_Hz": self.frequency_Hz,
        "damping_ratio": self.damping_ratio,
        "s_rad_per_s": self.s_rad_per_s[:, 0],
    })


@method("to_pandas", Zeros)
def zeros_to_pandas(self):
    """pandas.DataFrame with a row for each zero: s_rad_per_s, frequency_Hz, is_non_minimum_phase.
    Raises ImportError where pandas is not installed."""
    return _frame({
        "s_rad_per_s": self.s_rad_per_s,
        "frequency_Hz": self.frequency_Hz,
        "is_non_minimum_phase": self.is_non_minimum_phase,
    })


@method("to_pandas", Modes)
def modes_to_pandas(self):
    """pandas.DataFrame with a row for each mode, from the lowest: frequency_Hz, hub_slope,
    damping_ratio, and the values at the sensors by their names. Raises ImportError where pandas is
    not installed."""
    columns = {
        "frequency_Hz": self.frequency_Hz,
        "hub_slope": self.hub_slope,
        "damping_ratio": self.damping_ratio,
    }
    for place, sensor in enumerate(self.sensors):
        columns[sensor] = self.sensor_values[:, place]
    return _frame(columns)


@method("to_pandas", Identification)
def identification_to_pandas(self):
    """pandas.DataFrame with a row for each estimated root of every method; its columns are
    attributes of IdentifiedRoot. Raises ImportError where pandas is not installed."""
    names = ["feature", "order", "sensor", "method", "frequency_Hz", "frequency_std_Hz",
             "damping_ratio", "damping_ratio_std", "analytical_Hz", "error_percent",
             "payload_mass_kg", "hub_held"]
    return _frame(_rows(self.roots(), names))


@method("to_pandas", Diagnosis)
def diagnosis_to_pandas(self):
    """pandas.DataFrame with a row for each parameter of each cause: effect, sensor, parameter,
    value, std_error, unit, probability, explained_share. Raises ImportError where pandas is not
    installed."""
    names = ["effect", "sensor", "parameter", "value", "std_error", "unit", "probability",
             "explained_share"]
    rows = [
        (cause.effect, cause.sensor, one.name, one.value, one.std_error, one.unit,
         cause.probability, cause.explained_share)
        for cause in self.causes
        for one in cause.parameters.values()
    ]
    return _frame({name: list(column) for name, column in zip(names, zip(*rows))}
                  if rows else {name: [] for name in names})


@method("to_pandas", Plan)
def plan_to_pandas(self):
    """pandas.DataFrame with a row for each effect: effect, is_detectable, and
    minimum_detectable_value, a dict by parameter. Raises ImportError where pandas is not
    installed."""
    return _frame(_rows(self.effects, ["effect", "is_detectable", "minimum_detectable_value"]))
