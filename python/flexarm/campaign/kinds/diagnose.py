"""Diagnosis of a folder or of a list of measurements, a task each."""

import json
import os

import flexarm

from ..effect_names import effects_in
from ..named_files import named_files

# Of the summary page.
WORST = "estimation_nrmse_after"
FLAGGED = ("verdict", ["unexplained", "partly_explained"])
TALLY = "verdict"

_PREDICTORS = [
    "auto", "output_error", "closed_loop", "grey_box", "torque_balance", "driven_by_motion",
    "frequency_response",
]


class Measurements:
    """The measurements, in order of their names or as they are listed."""

    def __init__(self, names, options):
        self.names = names
        self.options = options

    def __len__(self):
        return len(self.names)

    def __iter__(self):
        for name in self.names:
            yield {"measurement": name, **self.options}


def _names(table, folder):
    names, place = table.texts("measurements", None), table.text("folder", None)
    if (names is None) == (place is None):
        table.fail("folder", "give either folder or measurements")
    if names is not None:
        for name in names:
            if not (folder / name).is_file():
                table.fail("measurements", f"{name}: no such file beside the campaign file")
        return names
    where = folder / place
    if not where.is_dir():
        table.fail("folder", "must be a folder beside the campaign file")
    names = sorted(os.path.relpath(one, folder) for one in where.rglob("measurement.toml"))
    if not names:
        table.fail("folder", "has no measurement.toml, in any of its folders")
    return names


def expand(table, folder):
    options = {
        "effects": effects_in(table, "effects", []),
        "exclude": effects_in(table, "exclude", []),
        "accept": table.texts("accept", []),
        "max_causes": table.whole("max_causes", 1, 100, 4),
        "predictor": table.choice("predictor", _PREDICTORS, "auto"),
    }
    limit_s = table.number("time_limit_s", None, above=0.0)
    if limit_s is not None:
        options["time_limit_s"] = float(limit_s)
    return Measurements(_names(table, folder), options)


def files(task, folder):
    return named_files(folder / task["measurement"])


def run(task, folder):
    options = {key: value for key, value in task.items() if key != "measurement"}
    diagnosis = flexarm.diagnose(folder / task["measurement"], progress=False, **options)
    return json.loads(diagnosis.to_json())


def columns(tasks):
    names = ["measurement", "verdict", "search_complete", "something_else"]
    for k in range(1, next(iter(tasks))["max_causes"] + 1):
        names += [f"cause_{k}{part}" for part in ("", "_sensor", "_probability", "_parameters")]
    for part in ("estimation", "validation"):
        names += [f"{part}_nrmse_before", f"{part}_nrmse_after", f"{part}_noise_floor"]
    return names


def _parameters(cause):
    return "; ".join(
        f"{name} = {one['value']!r} {one['unit']} (std_error {one['std_error']!r})"
        for name, one in cause["parameters"].items()
    )


def row(task, result):
    cells = {"measurement": task["measurement"]}
    if result is None:
        return cells
    cells["verdict"] = result["verdict"]
    cells["search_complete"] = str(result["search"]["complete"]).lower()
    cells["something_else"] = result["something_else"]
    for k, cause in enumerate(result["causes"], 1):
        cells[f"cause_{k}"] = cause["effect"]
        cells[f"cause_{k}_sensor"] = cause.get("sensor")
        cells[f"cause_{k}_probability"] = cause["confidence"]
        cells[f"cause_{k}_parameters"] = _parameters(cause)
    for part, gain in result["gain"].items():
        if gain is not None:
            cells[f"{part}_nrmse_before"] = gain["before"]
            cells[f"{part}_nrmse_after"] = gain["after"]
            cells[f"{part}_noise_floor"] = gain["noise_floor"]
    return cells
