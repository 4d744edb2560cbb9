"""Whole commands of flexarm that commands.py times: the list to extend.

In arguments {data} is the folder data/ of the repository, {work} one that the cases share: a case
may read what one before it wrote. To add a case, add a Case to CASES; to add an arm, what it has
beyond the paper's arm to ARMS. A diagnosis is a Case whose first argument is `diagnose`.
"""
from typing import NamedTuple, Optional


class Case(NamedTuple):
    what: str                             # what it works on, for the page
    arguments: str                        # of flexarm, separated by blanks
    most_processor_s: Optional[float] = None  # the project's figures, where it has one
    most_memory_MB: Optional[float] = None


DAMPING = "\n[damping]\nkelvin_voigt = 1e-4\n"
FRICTION = "\n[effects.coulomb_friction]\ntorque = 0.008\n"

# Files of {work}: the paper's arm with these lines behind it.
ARMS = {"damped.toml": DAMPING, "friction.toml": DAMPING + FRICTION}

SENSORS = "--sensor hub_angle,hub_velocity,tip_acceleration"

CASES = [
    Case("the paper's arm", "modes {data}/paper/arm.toml"),
    Case("the paper's arm, three formulations, convergence, measured roots",
         "compare {data}/paper/arm.toml --measured {data}/paper/modal.csv --verbose"),
    Case("the paper's Figure 18", "sweep --figure 18 --out {work}/swept"),
    Case("the paper's experiment: 60 s of random torque and a stepped sine, 4 sensors",
         "simulate {work}/damped.toml --out {work}/experiment --payload-mass 0.06 --duration 60 "
         "--period 0.005 --noise 0.005 --excitation random:rms=0.1,from=0.2,to=50,id=random "
         "--excitation stepped-sine:amplitude=0.1,bands=1.5:2.5/8:10/13:15/26:30,step=0.01,id=sine "
         + SENSORS + ",strain@0.05"),
    Case("the paper's experiment", "identify {work}/experiment/measurement.toml "
                                   "--out {work}/identified"),
    Case("three planned runs", "plan {data}/plans/arm.toml {data}/plans/three-runs.toml"),
    Case("Coulomb friction: three runs of 6 s at 500 Hz, 3 sensors",
         "simulate {work}/friction.toml --hide-effects all --out {work}/friction --modes 12 "
         "--duration 6 --period 0.002 --noise 0.005 --excitation random:rms=0.04,to=60,id=low "
         "--excitation random:rms=0.12,to=60,id=high "
         "--excitation multisine:rms=0.06,from=0.5,to=60,id=multisine " + SENSORS),
    Case("a million samples at 1 kHz with Coulomb friction, 4 sensors",
         "simulate {work}/friction.toml --hide-effects all --out {work}/long --modes 12 "
         "--duration 1000 --period 0.001 --noise 0.005 --excitation random:rms=0.1,to=60,id=long "
         + SENSORS + ",strain@0.05"),
    Case("the paper's measured tables", "diagnose {data}/paper/diagnosis/measurement.toml"),
    Case("the runs with Coulomb friction", "diagnose {work}/friction/measurement.toml"),
    Case("the million samples", "diagnose {work}/long/measurement.toml",
         most_processor_s=60.0, most_memory_MB=1000.0),
    # Further cases of `flexarm diagnose` go here.
]
