"""Monte Carlo of a plan: which effects it detects, over arms drawn from the uncertain numbers.

Task 0 is the arm as its file has it. In the others each uncertain number is multiplied by exp(u z),
with its relative standard deviation u and a standard normal z of its own.
"""

import json
import math
import random
import tempfile
from pathlib import Path

import flexarm

from ..arms import attributes, read_arm
from ..effect_names import effect_of, effects_in

_MOST_DRAWS = 10_000_000
# Where both are given they are of one beam, and change together.
_SAME = {
    "beam.flexural_rigidity": "beam_youngs_modulus_Pa",
    "beam.linear_density": "beam_density_kg_per_m3",
}


class Draws:
    def __init__(self, arm, common, count, seed):
        self.arm = arm
        self.common = common
        self.count = count
        self.seed = seed

    def __len__(self):
        return self.count + 1

    def __iter__(self):
        uncertain = sorted(self.arm.uncertainties)
        nominal = {key: getattr(self.arm, attributes()[key]) for key in uncertain}
        for draw in range(self.count + 1):
            deviates = random.Random(f"{self.seed} {draw}")
            numbers = dict(nominal)
            if draw > 0:
                for key, value in nominal.items():
                    deviate = deviates.gauss(0.0, 1.0)
                    numbers[key] = value * math.exp(self.arm.uncertainties[key] * deviate)
            yield {**self.common, "draw": draw, "numbers": numbers}


def expand(table, folder):
    arm = read_arm(folder / table.text("arm"))
    if not arm.uncertainties:
        table.fail("arm", "has no uncertain number, such as youngs_modulus_uncertainty = 0.03")
    plan_file = folder / table.text("plan")
    if not plan_file.is_file():
        table.fail("plan", "no such file beside the campaign file")
    common = {
        "arm": arm.to_toml(),
        "plan": plan_file.read_text(encoding="utf-8"),
        "effects": effects_in(table, "effects"),
        "refit": table.texts("refit", []),
    }
    count = table.whole("draws", 1, _MOST_DRAWS)
    return Draws(arm, common, count, table.whole("seed", 0, 2**53, 1))


def _arm_of(task):
    arm = flexarm.Arm.from_toml(task["arm"])
    numbers = {}
    for key, value in task["numbers"].items():
        numbers[attributes()[key]] = value
        other = getattr(arm, _SAME.get(key, ""), None)
        if other is not None:
            numbers[_SAME[key]] = other * (value / getattr(arm, attributes()[key]))
    return arm.with_(**numbers)


def run(task, folder):
    arm = _arm_of(task)
    with tempfile.TemporaryDirectory() as place:
        plan_file = Path(place) / "plan.toml"
        plan_file.write_text(task["plan"], encoding="utf-8")
        plan = flexarm.plan(
            arm, plan_file, effects=task["effects"], refit=task["refit"], progress=False
        )
    return json.loads(plan.to_json())


def _value_columns(effect):
    return [f"{effect}.{one.name}" for one in effect_of(effect).parameters]


def columns(tasks):
    names = ["draw", *sorted(tasks.arm.uncertainties)]
    for effect in tasks.common["effects"]:
        names += [f"{effect}.detectable", *_value_columns(effect)]
    return names


def row(task, result):
    cells = {"draw": task["draw"], **task["numbers"]}
    for one in result["effects"] if result else []:
        cells[f"{one['effect']}.detectable"] = "yes" if one["detectable"] else "no"
        for value in one["minimum_detectable_value"]:
            cells[f"{one['effect']}.{value['parameter']}"] = value["value"]
    return cells
