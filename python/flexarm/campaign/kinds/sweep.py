"""Poles and zeros over any number of parameters: each point of the grid is a task."""

import itertools
import math

import flexarm

from ..arms import attributes, read_arm
from ..tables import suggestion

_FORMULATIONS = {
    "exact_tf": flexarm.ExactTransferFunction,
    "fem": flexarm.FiniteElements,
    "assumed_modes": flexarm.AssumedModes,
}
_MOST_ROOTS = 1000
_MOST_POINTS = 10_000_000


def _parameters():
    """Keys of the arm file that may be swept."""
    keys = list(attributes())
    for effect in flexarm.effects():
        keys += [f"effects.{effect.name}.{one.name}" for one in effect.parameters]
    return keys


def _values_of(axis):
    if axis.has("values"):
        for key in ("from", "to", "count", "spacing"):
            if axis.has(key):
                axis.fail(key, "must not stand beside values")
        return [float(one) for one in axis.numbers("values")]
    first, last = float(axis.number("from")), float(axis.number("to"))
    count = axis.whole("count", 2, _MOST_POINTS)
    if axis.choice("spacing", ["linear", "logarithmic"], "linear") == "linear":
        return [first + (last - first) * i / (count - 1) for i in range(count - 1)] + [last]
    if first <= 0.0 or last <= 0.0:
        axis.fail("from" if first <= 0.0 else "to", "must be above 0 with logarithmic spacing")
    growth = math.log(last / first)
    return [first * math.exp(growth * i / (count - 1)) for i in range(count - 1)] + [last]


class Grid:
    """The points of a sweep: the last parameter changes fastest, then the formulation."""

    def __init__(self, common, axes, formulations):
        self.common = common
        self.axes = axes
        self.formulations = formulations

    def __len__(self):
        return math.prod(len(values) for _, values in self.axes) * len(self.formulations)

    def __iter__(self):
        keys = [key for key, _ in self.axes]
        for point in itertools.product(*(values for _, values in self.axes)):
            for formulation in self.formulations:
                yield {
                    **self.common,
                    "formulation": formulation,
                    "parameters": dict(zip(keys, point)),
                }


def expand(table, folder):
    allowed = _parameters()
    if table.has("arm"):
        arm = read_arm(folder / table.text("arm"))
    else:
        table.text("arm", "of the paper")
        arm = flexarm.Arm.paper()
    axes = []
    for axis in table.tables("parameter"):
        key = axis.text("key")
        if key not in allowed:
            axis.fail("key", f"must be a number of the arm file{suggestion(key, allowed)}")
        if key in dict(axes):
            axis.fail("key", "is swept already")
        axes.append((key, _values_of(axis)))
        axis.end()
    formulations = table.texts("formulations", ["exact_tf"])
    for one in formulations:
        if one not in _FORMULATIONS:
            table.fail(
                "formulations",
                f"must be of {', '.join(_FORMULATIONS)}{suggestion(one, list(_FORMULATIONS))}",
            )
    common = {
        "arm": arm.to_toml(),
        "poles": table.whole("poles", 0, _MOST_ROOTS, 5),
        "zeros": table.counts("zeros", _MOST_ROOTS, {}),
        "damping": table.flag("damping", False),
    }
    exact = flexarm.ExactTransferFunction(flexarm.Arm.paper())
    for sensor in common["zeros"]:
        try:
            exact.zeros(sensor, 1)
        except flexarm.InputError as error:
            table.fail("zeros", str(error))
    grid = Grid(common, axes, formulations)
    if len(grid) > _MOST_POINTS:
        table.fail("parameter", f"{len(grid)} points: must be {_MOST_POINTS} or less")
    return grid


def _arm_of(task):
    arm = flexarm.Arm.from_toml(task["arm"])
    numbers, effects = {}, {}
    for key, value in task["parameters"].items():
        if key in attributes():
            numbers[attributes()[key]] = value
        else:
            _, effect, parameter = key.split(".")
            effects.setdefault(effect, {})[parameter] = value
    if numbers:
        arm = arm.with_(**numbers)
    for name, parameters in effects.items():
        stated = arm.effects.get(name)
        sensor = stated.sensor if stated else ""
        known = stated.parameters if stated else {}
        arm = arm.with_effect(name, sensor=sensor, **{**known, **parameters})
    return arm


def run(task, folder):
    roots = max([task["poles"], *task["zeros"].values(), 1])
    kind = _FORMULATIONS[task["formulation"]]
    # The exact transfer function needs no settings for a number of roots.
    settings = {} if task["formulation"] == "exact_tf" else {"roots": roots}
    model = kind(_arm_of(task), **settings)
    result = {"poles_Hz": model.poles(task["poles"]).frequency_Hz.tolist() if task["poles"] else []}
    if task["damping"] and task["poles"]:
        damped = model.damped_poles(task["poles"])
        result["damped_poles_Hz"] = damped.frequency_Hz.tolist()
        result["damping_ratios"] = damped.damping_ratio.tolist()
    result["zeros_rad_per_s"] = {
        sensor: [[one.real, one.imag] for one in model.zeros(sensor, count).s_rad_per_s.tolist()]
        for sensor, count in task["zeros"].items()
    }
    return result


def columns(tasks):
    names = [key for key, _ in tasks.axes] + ["formulation"]
    poles = range(1, tasks.common["poles"] + 1)
    names += [f"pole_{k}_Hz" for k in poles]
    if tasks.common["damping"]:
        names += [f"damped_pole_{k}_Hz" for k in poles] + [f"damping_ratio_{k}" for k in poles]
    for sensor, count in tasks.common["zeros"].items():
        for k in range(1, count + 1):
            names += [f"zero_{k}_{sensor}_real_rad_per_s", f"zero_{k}_{sensor}_imag_rad_per_s"]
    return names


def row(task, result):
    cells = {**task["parameters"], "formulation": task["formulation"]}
    if result is None:
        return cells
    for name, key in (
        ("pole_{}_Hz", "poles_Hz"),
        ("damped_pole_{}_Hz", "damped_poles_Hz"),
        ("damping_ratio_{}", "damping_ratios"),
    ):
        for k, value in enumerate(result.get(key, []), 1):
            cells[name.format(k)] = value
    for sensor, zeros in result["zeros_rad_per_s"].items():
        for k, (real, imag) in enumerate(zeros, 1):
            cells[f"zero_{k}_{sensor}_real_rad_per_s"] = real
            cells[f"zero_{k}_{sensor}_imag_rad_per_s"] = imag
    return cells
