"""Parametric bootstrap of a diagnosis: its extended arm is simulated with the recorded torques and
fresh noise, and diagnosed as the measurement was.

The noise of a channel is white and as large as the residual of the extended arm there. Task 0 is
the measurement itself.
"""

import csv
import json
import random
import tempfile
import tomllib
from pathlib import Path

import flexarm
import numpy

from ..effect_names import effects_in
from ..named_files import named_files
from ..task_files import whole_files
from . import diagnose

_MOST_DRAWS = 10_000_000
WORST = diagnose.WORST
FLAGGED = diagnose.FLAGGED
_PERCENT = (2.5, 50.0, 97.5)  # the interval of 95 %, and its median
TALLY = diagnose.TALLY


class Draws:
    def __init__(self, common, count, causes):
        self.common = common
        self.count = count
        self.causes = causes

    def __len__(self):
        return self.count + 1

    def __iter__(self):
        for draw in range(self.count + 1):
            yield {**self.common, "draw": draw}


def _name(cause):
    return f"{cause['effect']} on {cause['sensor']}" if cause.get("sensor") else cause["effect"]


def _diagnosis(table, folder):
    path = folder / table.text("diagnosis")
    try:
        result = json.loads(path.read_text(encoding="utf-8"))
        causes, arm = result["causes"], result["extended_arm"]
        if result["schema"] not in ("flexarm.diagnosis/2", "flexarm.diagnosis/3"):
            raise KeyError
    except (OSError, ValueError, KeyError, TypeError):
        table.fail("diagnosis", "must be a file of flexarm diagnose --json, schema 2 or 3")
    if not causes or not arm or not (path.parent / arm).is_file():
        table.fail("diagnosis", "names no cause, or its extended arm is not beside it")
    return causes


def _require_simulated(table, path):
    """Only open-loop time records that begin at rest are simulated from their torque."""
    try:
        runs = tomllib.loads(path.read_text(encoding="utf-8"))["run"]
        flexarm.read_measurement(path)
    except (OSError, ValueError, KeyError) as error:
        table.fail("measurement", str(error).split("\n")[0])
    for run in runs:
        if run["kind"] != "time" or "controller" in run or run.get("initial", "rest") != "rest":
            table.fail("measurement", f"run {run['id']}: must be an open-loop time run from rest")


def expand(table, folder):
    measurement = table.text("measurement")
    _require_simulated(table, folder / measurement)
    causes = _diagnosis(table, folder)
    common = {
        "measurement": measurement,
        "diagnosis": table.text("diagnosis"),
        "seed": table.whole("seed", 0, 2**53, 1),
        "effects": effects_in(table, "effects", []),
        "exclude": effects_in(table, "exclude", []),
        "max_causes": table.whole("max_causes", 1, 100, 4),
    }
    return Draws(common, table.whole("draws", 1, _MOST_DRAWS), causes)


def _extended_arm(task, folder):
    path = folder / task["diagnosis"]
    return path.parent / json.loads(path.read_text(encoding="utf-8"))["extended_arm"]


def files(task, folder):
    return [
        *named_files(folder / task["measurement"]), folder / task["diagnosis"],
        _extended_arm(task, folder),
    ]


def _simulated(task, arm, stated, recorded, noise):
    """One run of the extended arm with the torque of the record."""
    payload = stated.get("payload")
    if payload is not None:
        arm = arm.with_(
            payload_mass_kg=payload.get("mass", 0.0),
            payload_inertia_kg_m2=payload.get("inertia", 0.0),
        )
    seed = random.Random(f"{task['seed']} {task['draw']} {recorded.id}").getrandbits(31)
    count = len(recorded.time_s)
    return flexarm.simulate(
        arm, recorded.torque_N_m, sensors=recorded.sensors, seed=seed, noise_of=noise,
        sample_time_s=(recorded.time_s[-1] - recorded.time_s[0]) / (count - 1),
        hold=stated.get("torque_hold", "zero"), progress=False,
    )


def _write_record(path, run):
    head = ["time [s]", "torque [N m]"]
    head += [f"{sensor} [{unit}]" for sensor, unit in zip(run.sensors, run.units)]
    columns = [run.time_s, run.torque_N_m, *(run[sensor] for sensor in run.sensors)]
    with open(path, "w", newline="", encoding="utf-8") as stream:
        rows = csv.writer(stream, lineterminator="\n")
        rows.writerow(head)
        rows.writerows(zip(*(column.tolist() for column in columns)))


def _toml(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {_toml(one)}" for key, one in value.items()) + " }"
    return json.dumps(value, ensure_ascii=False)


def _write_measurement(task, folder, place):
    """The simulated measurement in the folder `place`; returns its file."""
    source = folder / task["measurement"]
    stated = tomllib.loads(source.read_text(encoding="utf-8"))
    channels = json.loads((folder / task["diagnosis"]).read_text())["residual"]["channels"]
    arm = flexarm.read_arm(_extended_arm(task, folder))
    flexarm.read_arm(source.parent / stated["arm"]).write(place / "arm.toml")
    lines = ['arm = "arm.toml"']
    for number, (of, run) in enumerate(
        zip(stated["run"], flexarm.read_measurement(source).runs, strict=True)
    ):
        noise = {
            one["sensor"]: one["after"] * float(run[one["sensor"]].std())  # of an NRMSE
            for one in channels
            if one["run"] == run.id and one["sensor"] in run.sensors
        }
        _write_record(place / f"{number}.csv", _simulated(task, arm, of, run, noise))
        lines += ["[[run]]", f'file = "{number}.csv"']
        kept = ("id", "kind", "purpose", "payload", "torque_hold")
        lines += [f"{key} = {_toml(of[key])}" for key in kept if key in of]
    (place / "measurement.toml").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return place / "measurement.toml"


def run(task, folder):
    options = {key: task[key] for key in ("effects", "exclude", "max_causes")}
    with tempfile.TemporaryDirectory() as place:
        path = folder / task["measurement"]
        if task["draw"] > 0:
            path = _write_measurement(task, folder, Path(place))
        return json.loads(flexarm.diagnose(path, progress=False, **options).to_json())


def columns(tasks):
    names = ["draw"]
    for cause in tasks.causes:
        names += [f"{_name(cause)}.named"]
        names += [f"{_name(cause)}.{parameter}" for parameter in cause["parameters"]]
    return names + diagnose.columns(tasks)[1:]


def row(task, result):
    cells = diagnose.row(task, result)
    cells["draw"] = task["draw"]
    for cause in result["causes"] if result else []:
        cells[f"{_name(cause)}.named"] = "yes"
        for parameter, estimate in cause["parameters"].items():
            cells[f"{_name(cause)}.{parameter}"] = estimate["value"]
    return cells


def _estimates(pairs):
    """(value of the measurement or None, [values of the draws], unit) by cause and parameter, and
    the number of draws that have a result."""
    found, draws = {}, 0
    for task, result in pairs:
        draws += result is not None and task["draw"] > 0
        for cause in result["causes"] if result else []:
            for parameter, estimate in cause["parameters"].items():
                one = found.setdefault((_name(cause), parameter), [None, [], estimate["unit"]])
                if task["draw"] == 0:
                    one[0] = estimate["value"]
                else:
                    one[1].append(estimate["value"])
    return found, draws


def finish(pairs, folder, out):
    """Writes `bootstrap.csv`: for each parameter of a cause its distribution over the draws in
    which the cause is named."""
    found, draws = _estimates(pairs)
    with whole_files(out / "bootstrap.csv") as (temporary,):
        with open(temporary, "x", newline="", encoding="utf-8") as stream:
            rows = csv.writer(stream, lineterminator="\n")
            rows.writerow(
                ["cause", "parameter", "unit", "draws", "named", "measurement", "mean",
                 "standard deviation", *(f"{one} %" for one in _PERCENT)]
            )
            for (cause, parameter), (measured, values, unit) in sorted(found.items()):
                cells = [None] * (2 + len(_PERCENT))
                if values:
                    spread = float(numpy.std(values, ddof=1)) if len(values) > 1 else None
                    percentiles = numpy.percentile(values, _PERCENT).tolist()
                    cells = [float(numpy.mean(values)), spread, *percentiles]
                rows.writerow([cause, parameter, unit, draws, len(values), measured, *cells])
