"""The recordings of scripts/case-recordings: what is known of each rig, how its log is
imported and diagnosed, and the figures that are asked for. In a command DATA/ is the folder of the
logs."""
import math
from collections.abc import Callable
from dataclasses import dataclass, field

from document import number


@dataclass
class Case:
    """One diagnosis."""
    name: str
    heading: str
    prepare: list  # commands that make the measurement
    options: list  # of flexarm diagnose
    validation: tuple  # ids of the validation runs
    measurement: str = ""  # folder of the measurement; empty: of the name of the case


@dataclass
class Known:
    """A quantity that is known: a value, or a range of values."""
    quantity: str
    value: tuple  # lowest and highest
    source: str
    found: Callable  # of the outcomes: value, standard error, unit; None where it is not named
    within: float | None = None  # relative, where a figure is asked for


@dataclass
class Goal:
    """A figure that is asked for; `judge` returns what was found and whether that reaches it."""
    text: str
    judge: Callable


@dataclass
class Recording:
    name: str
    logs: list
    files: dict  # that a user writes: name and text
    cases: list
    known: list
    goals: list = field(default_factory=list)


def named(case, *parameters):
    """The parameter of the first cause of `parameters`, (effect, parameter, factor, summand) each,
    that the diagnosis names: value * factor + summand in `unit`, the fifth entry."""
    def of(outcomes):
        for cause in outcomes[case].result["causes"]:
            for effect, parameter, factor, summand, unit in parameters:
                if cause["effect"] == effect:
                    one = cause["parameters"][parameter]
                    error = one["std_error"] * abs(factor)
                    return one["value"] * factor + summand, error, unit
        return None
    return of


def plain(case, effect, parameter, unit):
    return named(case, (effect, parameter, 1.0, 0.0, unit))


def refitted(case, key, factor, unit):
    """An uncertain number of the arm file, times `factor` in `unit`."""
    def of(outcomes):
        for one in outcomes[case].result["uncertain_numbers"]:
            if one["key"] == key:
                return one["value"] * factor, one["std_error"] * factor, unit
        return None
    return of


def validation_error(case, runs, sensor, most):
    """Whether the NRMSE of the sensor is at most `most` on each of the validation runs."""
    def judge(outcomes):
        errors = [channel["after"] for channel in outcomes[case].result["residual"]["channels"]
                  if channel["run"] in runs and channel["sensor"] == sensor]
        if not errors:
            return "no such channel", False
        return f"{number(100 * max(errors), 3)} %", max(errors) <= most
    return judge


def names_one_of(cases, effects):
    def judge(outcomes):
        found = [cause["effect"] for case in cases for cause in outcomes[case].result["causes"]]
        good = [effect for effect in found if effect in effects]
        return ", ".join(f"`{effect}`" for effect in found) or "no effect", bool(good)
    return judge


def no_other_cause(cases, effects):
    """No cause outside `effects` has a probability above 0.5."""
    def judge(outcomes):
        wrong = [f"`{cause['effect']}` {number(cause['confidence'], 2)}" for case in cases
                 for cause in outcomes[case].result["causes"]
                 if cause["effect"] not in effects and cause["confidence"] > 0.5]
        return ", ".join(wrong) or "none", not wrong
    return judge


# EMPS: kv kp and kv of the data set's controller in N/m and N s/m, by the drive's 35.1507 N/V.
EMPS_KP = 243.45 * 160.18 * 35.1507
EMPS_KD = 243.45 * 35.1507
EMPS_OFFSET = "published inverse least squares, -3.16 N beside the friction"
EMPS_IMPORT = ["--column", "torque=force:N:1", "--column", "hub_angle=position:m:1",
               "--reference", "reference", "--controller",
               f"kp={EMPS_KP:.3f},kd={EMPS_KD:.6f},derivative=measurement",
               # Split where the axis turns: a controller has no rate at its first sample.
               "--run", "first=:12.468", "--run", "second=12.469:", "--validation", "second",
               "--arm", "emps.toml"]
EMPS = Recording(
    name="emps",
    logs=["emps/estimation.csv"],
    files={"emps.toml": 'name = "EMPS"\n\n[hub]\ninertia = 95.1   # kg\n'},
    cases=[Case(
        "emps", "whole library",
        [["import", "DATA/emps/estimation.csv", *EMPS_IMPORT, "--out", "emps"]],
        [], ("second",)),
        Case("constant", "the same, without friction_asymmetry",
             [["import", "DATA/emps/estimation.csv", *EMPS_IMPORT, "--out", "constant"]],
             ["--exclude", "friction_asymmetry"], ("second",))],
    known=[
        Known("Coulomb friction [N]", (20.4, 20.4), "published inverse least squares",
              plain("emps", "coulomb_friction", "torque", "N"), 0.05),
        Known("viscous friction [N s/m]", (203.5, 203.5), "published inverse least squares",
              plain("emps", "hub_viscous_friction", "coefficient", "N s/m"), 0.05),
        # A force on the slide has the sign opposite to that of the offset of the friction.
        Known("force offset [N]", (3.16, 3.16), EMPS_OFFSET,
              plain("emps", "torque_bias", "torque", "N"), 0.05),
        Known("force offset [N], without friction_asymmetry", (3.16, 3.16), EMPS_OFFSET,
              plain("constant", "torque_bias", "torque", "N"), 0.05),
    ],
    goals=[
        Goal("force error on the validation run at most 5 %, closed loop",
             validation_error("emps", ("second",), "torque", 0.05)),
        Goal("the same, without friction_asymmetry",
             validation_error("constant", ("second",), "torque", 0.05)),
    ])

# rotary-arm: Kg Km/R and Kg Km of the course.
ROTARY_GAIN, ROTARY_BACK_EMF = 0.1574, 0.0815
ROTARY_ARM = """name = "rotary arm"

[beam]
length = 0.45
flexural_rigidity = 0.2455
linear_density = 0.1333

[hub]
inertia = 0.002

[payload]
mass = 0.05
"""
ROTARY_TIP = -999 * ROTARY_GAIN  # -K2 - K4 per ms
# voltage = K1 (reference - angle) - K2 tip - K3 velocity - K4 (rate of tip), K = 10, -1, 1, 1; the
# state is the tip at the sample before, and the rate its backward difference over 1 ms.
ROTARY_LAW = f"""sensor = ["hub_angle", "hub_velocity", "tip_deflection"]
A = [[0.0]]
B = [[0.0, 0.0, 0.0, 1.0]]
C = [[{ROTARY_GAIN * 1000:.6g}]]
D = [[{10 * ROTARY_GAIN:.6g}, {-10 * ROTARY_GAIN:.6g}, {-ROTARY_GAIN:.6g}, {ROTARY_TIP:.8g}]]
"""
ROTARY_RUNS = ["--time-unit", "ms", "--run", "up=344.9:349.8", "--run", "down=349.9:",
               "--validation", "down", "--torque", f"{ROTARY_GAIN}*[Output Voltage]",
               "--arm", "rotary.toml"]
ROTARY = Recording(
    name="rotary-arm",
    logs=["rotary-arm/log.csv"],
    files={"rotary.toml": ROTARY_ARM, "law.toml": ROTARY_LAW},
    cases=[
        Case("loop", "closed loop",
             [["import", "DATA/rotary-arm/log.csv", *ROTARY_RUNS, "--reference",
               "Position Reference", "--controller", "law.toml", "--out", "loop"]],
             ["--time-limit", "120"], ("down",)),
        Case("open", "open loop, 100 Hz",
             [["import", "DATA/rotary-arm/log.csv", *ROTARY_RUNS, "--decimate", "10", "--out",
               "open"]],
             ["--time-limit", "90"], ("down",)),
        Case("balance", "open loop, torque balance", [], ["--predictor", "torque_balance"],
             ("down",), "open"),
    ],
    known=[
        Known("viscous friction, back-EMF included [N m s/rad]", (0.095, 0.095),
              "fit of a sister log (README of the log)",
              named("loop", ("back_emf", "constant", 1.0, 0.0, "N m s/rad"),
                    ("hub_viscous_friction", "coefficient", 1.0, 0.0, "N m s/rad")), 0.15),
        Known("Coulomb friction [N m]", (0.03, 0.03), "fit of a sister log (README of the log)",
              named("loop", ("coulomb_friction", "torque", 1.0, 0.0, "N m"),
                    ("stribeck_friction", "torque", 1.0, 0.0, "N m")), 0.15),
        Known("delay of the tip channel [s]", (0.057, 0.057),
              "fit of a sister log (README of the log)",
              plain("loop", "sensor_delay", "delay", "s"), 0.15),
        Known("back-EMF alone [N m s/rad]", (ROTARY_BACK_EMF, ROTARY_BACK_EMF),
              "course (README of the log)",
              plain("loop", "back_emf", "constant", "N m s/rad")),
        Known("flexural rigidity, factor on 0.2455 N m²", ((1.95 / 1.8) ** 2, (1.95 / 1.8) ** 2),
              "clamped 1.95 Hz fitted, 1.8 Hz of the course (README of the log)",
              plain("loop", "flexural_rigidity", "factor", "1")),
    ],
    goals=[
        Goal("back-EMF or viscous friction named",
             names_one_of(["loop"], ["back_emf", "hub_viscous_friction"])),
        Goal("dry friction named", names_one_of(["loop"], ["coulomb_friction",
                                                           "stribeck_friction"])),
        Goal("late tip channel named", names_one_of(["loop"], ["sensor_delay"])),
        Goal("no cause above 0.5 that is not there", no_other_cause(
            ["loop", "open"], ["back_emf", "hub_viscous_friction", "coulomb_friction",
                               "stribeck_friction", "sensor_delay", "flexural_rigidity"])),
    ])

RULER_ARM = """name = "steel ruler"

[beam]
length = 0.30
linear_density = 0.03383
flexural_rigidity = 0.00732

[hub]
inertia = 5.4e-6
viscous_friction = 2.1e-4   # back-EMF
"""
RULER_RUNS = ["import", "DATA/ruler-rig/log.csv", "--torque", "0.005*[Voltage]", "--run",
              "first=:25.5", "--run", "second=25.505:", "--validation", "second", "--arm",
              "ruler.toml", "--out", "time"]


RULER_CAUSES = ["torque_gain", "flexural_rigidity", "time_delay"]


def ruler_gain(case):
    """Under a torque of +-0.06 N m a limit and a dead zone are a gain."""
    return named(case, ("torque_gain", "factor", 1.0, 0.0, "1"),
                 ("torque_saturation", "limit", 1.0 / 0.06, 0.0, "1"),
                 ("torque_dead_zone", "width", -1.0 / 0.06, 1.0, "1"))


def ruler_rigidity(case):
    return plain(case, "flexural_rigidity", "factor", "1")


def ruler_delay(case):
    return plain(case, "time_delay", "delay", "s")


def ruler_known(case, heading):
    return [
        Known(f"torque gain, {heading}", (0.37, 0.49), "fits of this log (README of the log)",
              ruler_gain(case), 0.15),
        Known(f"flexural rigidity, factor, {heading}", (1.96, 1.96),
              "fits of this log (README of the log)",
              ruler_rigidity(case), 0.15),
        Known(f"delay [s], {heading}", (0.0014, 0.0016), "fits of this log (README of the log)",
              ruler_delay(case), 0.15),
    ]


RULER = Recording(
    name="ruler-rig",
    logs=["ruler-rig/log.csv"],
    files={"ruler.toml": RULER_ARM},
    cases=[
        Case("time", "hub angle in time", [RULER_RUNS], ["--time-limit", "120"], ("second",)),
        Case("responses", "frequency responses",
             [["identify", "time/measurement.toml", "--no-fit", "--out", "identified"],
              ["import", "identified/frf-first.csv", "identified/frf-second.csv", "--validation",
               "frf-second", "--arm", "ruler.toml", "--out", "responses"]],
             ["--time-limit", "60"], ("frf-second",)),
        Case("grey", "in time, gain, rigidity and delay alone", [],
             ["--effects", ",".join(RULER_CAUSES), "--predictor", "grey_box"], ("second",), "time"),
        Case("known", "responses, gain, rigidity and delay alone", [],
             ["--effects", ",".join(RULER_CAUSES)], ("frf-second",), "responses"),
    ],
    known=(ruler_known("time", "in time") + ruler_known("responses", "from responses") +
           ruler_known("grey", "in time, these effects alone")),
    goals=[
        Goal("rigidity and gain (or saturation) named in one diagnosis", lambda outcomes: (
            "; ".join(" + ".join(f"`{cause['effect']}`" for cause in outcome.result["causes"])
                      or "no effect" for outcome in outcomes.values()),
            any(ruler_gain(case)(outcomes) and ruler_rigidity(case)(outcomes)
                for case in outcomes))),
        Goal("no cause above 0.5 that is not there", no_other_cause(
            ["time", "responses"], ["torque_gain", "torque_saturation", "torque_dead_zone",
                                    "flexural_rigidity", "beam_thickness", "time_delay",
                                    "actuator_lag", "coulomb_friction"])),
    ])

# flexible-link-rig, stage 1: E of the maker's link stiffness E b t^3/(4 L) = 39.96 N m/rad; the
# load's inertia about the tip is 0.1704 kg m^2 less M L^2 and the blade's; steel is assumed.
RIG_ARM = """name = "stage 1 of the rig"

[beam]
length = 0.202
width = 0.0762
thickness = 0.00127
density = 7850.0
youngs_modulus = 2.0686e11

[hub]
inertia = 0.0635
viscous_friction = 4.0
viscous_friction_uncertainty = 0.3

[payload]
mass = 1.578
inertia = 0.10392
"""
# Until the next move of stage 2; half a second more in front where a filter takes a quarter.
RIG_MOVES = ["--run", "up=2.3:5.3", "--run", "down=7.3:10.3", "--run", "up-again=12.3:15.3",
             "--run", "down-again=17.3:", "--validation", "up-again", "--validation",
             "down-again"]
RIG_TORQUE = ["--column", "torque=i1_meas_A:A:8.925", "--column", "hub_angle=hub1_deg"]
# Strain at the root of a beam with a force at its tip: 3 t/(2 L) per rad of tip deflection.
RIG_GAUGE = ["--column", "strain@0=tipdefl1_deg:deg:1.5*0.00127/0.202*pi/180"]
# What the gauge depends on: rigidity, load and damping of the link, with their uncertainties.
LINK_ARM = (RIG_ARM.replace("viscous_friction_uncertainty = 0.3\n", "")
            .replace("youngs_modulus = 2.0686e11",
                     "youngs_modulus = 2.0686e11\nyoungs_modulus_uncertainty = 0.2")
            .replace("mass = 1.578", "mass = 1.578\nmass_uncertainty = 0.1")
            .replace("inertia = 0.10392", "inertia = 0.10392\ninertia_uncertainty = 0.3")
            + "\n[damping]\nkelvin_voigt = 0.02\nkelvin_voigt_uncertainty = 0.5\n")
RIG_AGAIN = ("up-again", "down-again")
RIG = Recording(
    name="flexible-link-rig",
    logs=["flexible-link-rig/run-20s.csv"],
    files={"rig.toml": RIG_ARM, "link.toml": LINK_ARM},
    cases=[
        Case("hub", "torque to hub angle, 100 Hz",
             [["import", "DATA/flexible-link-rig/run-20s.csv", *RIG_TORQUE, *RIG_MOVES,
               "--decimate", "5", "--arm", "rig.toml", "--out", "hub"]],
             ["--time-limit", "120"], RIG_AGAIN),
        Case("motion", "the measured angle drives the link",
             [["import", "DATA/flexible-link-rig/run-20s.csv", *RIG_TORQUE, *RIG_GAUGE,
               *RIG_MOVES, "--arm", "link.toml", "--out", "motion"]],
             ["--predictor", "driven_by_motion", "--time-limit", "100"], RIG_AGAIN),
    ],
    known=[
        Known("hub viscous friction [N m s/rad]", (4.0, 4.0),
              "maker, adjusted from a step response (README of the log)",
              refitted("hub", "hub.viscous_friction", 1.0, "N m s/rad")),
        Known("Young's modulus of the link [GPa]", (206.86, 206.86),
              "maker's link stiffness of 39.96 N m/rad (README of the log)",
              refitted("motion", "beam.youngs_modulus", 1e-9, "GPa")),
    ],
    goals=[
        Goal("dry friction named", names_one_of(["hub", "motion"], ["coulomb_friction",
                                                                    "stribeck_friction",
                                                                    "hub_hysteresis"])),
        Goal("gauge from the motion of the hub within 15 % on validation runs",
             validation_error("motion", RIG_AGAIN, "strain@0", 0.15)),
    ])

# torque-steps: the torque changes after 10 s, to the value in the name of the file.
STEPS_LOGS = [f"idf_{step}.mat" for step in ("neg_0.045_1", "pos_0.065_1", "neg_0.04_2",
                                             "pos_0.06_2")]
STEPS_AGAIN = ("idf_neg_0.04_2", "idf_pos_0.06_2")
STEPS = Recording(
    name="torque-steps",
    logs=[f"torque-steps/{log}" for log in STEPS_LOGS],
    files={"motor.toml": 'name = "motor rig"\n\n[hub]\ninertia = 1.2e-4\n'
                         'viscous_friction = 7.03e-5\n'},
    cases=[Case(
        "steps", "whole library",
        [["import", *[f"DATA/torque-steps/{log}" for log in STEPS_LOGS],
          "--column", "time=data(:,1):s", "--column", "hub_angle=data(:,3):rad",
          "--column", "hub_velocity=data(:,4):rad/s", "--column", "torque=data(:,5):N m",
          "--initial", "free", "--validation", STEPS_AGAIN[0], "--validation", STEPS_AGAIN[1],
          "--arm", "motor.toml", "--out", "steps"]],
        ["--time-limit", "60"], STEPS_AGAIN)],
    known=[
        Known("Coulomb friction [N m]", (0.017, 0.024), "fits of these logs (README of the logs)",
              plain("steps", "coulomb_friction", "torque", "N m"), 0.05),
        Known("torque bias [N m]", (-0.011, -0.007), "fits of these logs (README of the logs)",
              plain("steps", "torque_bias", "torque", "N m"), 0.05),
    ],
    goals=[
        Goal("viscous friction named",
             names_one_of(["steps"], ["hub_viscous_friction", "back_emf"])),
        Goal("hub velocity of the validation runs below 20 %",
             validation_error("steps", STEPS_AGAIN, "hub_velocity", 0.2)),
    ])

# two-axis-robot: strokes of constant velocity, one behind the other; the first row of a stroke
# repeats the time of the last one before.
ROBOT_STROKES = [1, 652, 1303, 2204, 3105, 4306, 5507, 6908, 8309, 9690, 11071, 12772, 14473, 15874,
                 17275, 18676, 20077, 21258, 22439, 24290, 26141, 27492, 28843, 29844, 30845, 31496,
                 32147, 32678, 33209]
ROBOT_RUNS = {f"stroke-{k + 1}": f"rows:{first + 1}:{end - 1}" for k, (first, end) in
              enumerate(zip(ROBOT_STROKES, ROBOT_STROKES[1:]))}
# Every other pair, up and down.
ROBOT_AGAIN = tuple(f"stroke-{k + 1}" for k in range(len(ROBOT_RUNS)) if k % 4 > 1)


def torque_error(case, most):
    """Whether the torque balance leaves at most this part of the torque of the validation runs."""
    def judge(outcomes):
        gain = outcomes[case].result["prediction"]["torque"]
        if gain is None:
            return "another predictor", False
        return f"{number(100 * gain['after'], 3)} %", gain["after"] <= most
    return judge


ROBOT = Recording(
    name="two-axis-robot",
    logs=["two-axis-robot/constant-velocity-axis-1.mat"],
    files={"axis.toml": 'name = "axis 1 of a robot"\n\n[hub]\ninertia = 0.026\n'},
    cases=[Case(
        "strokes", "whole library",
        [["import", "DATA/two-axis-robot/constant-velocity-axis-1.mat", "--column", "time=t:s",
          "--column", "hub_angle=q1:rad", "--column", "hub_velocity=qpfil1:rad/s",
          "--torque", "20.25*0.0525*[ifil1]", "--initial", "free",
          *[part for run, rows in ROBOT_RUNS.items() for part in ("--run", f"{run}={rows}")],
          *[part for run in ROBOT_AGAIN for part in ("--validation", run)],
          "--arm", "axis.toml", "--out", "strokes"]],
        ["--time-limit", "90"], ROBOT_AGAIN)],
    known=[
        Known("gravity [N m]", (0.83, 0.9), "fits of this log (README of the log)",
              plain("strokes", "tilt", "amplitude", "N m"), 0.05),
        Known("Coulomb friction [N m]", (0.11, 0.17), "fits of this log (README of the log)",
              plain("strokes", "coulomb_friction", "torque", "N m"), 0.05),
    ],
    goals=[Goal("torque of the validation runs below 15 %, by torque balance",
                torque_error("strokes", 0.15))])

# geared-servo: kt/R/885 times duty and voltage; duty = kp 4096/(2 pi)/(256 885) (goal - angle).
SERVO_TORQUE = 0.387 / 4.02 / 885
SERVO_KP = 0.387 / 4.02 * 7.3 * 400 * 4096 / (2 * math.pi) / (256 * 885)
SERVO_LOGS = ["sin-sin-kp400", "up-and-down-kp400", "sin-time-square-kp400"]
SERVO = Recording(
    name="geared-servo",
    logs=[f"geared-servo/{log}.csv" for log in SERVO_LOGS],
    files={"servo.toml": """name = "geared servo with a pendulum"

[hub]
inertia = 0.00671
viscous_friction = 0.0409   # back-EMF included

[effects.tilt]   # the pendulum
amplitude = 0.4805
angle = 0.0
"""},
    cases=[Case(
        "servo", "closed loop, whole library",
        [["import", *[f"DATA/geared-servo/{log}.csv" for log in SERVO_LOGS],
          "--column", "time=time:s", "--column", "hub_angle=position:rad",
          "--column", "hub_velocity=speed:rad/s",
          "--torque", f"{SERVO_TORQUE:.6g}*[load]*[input_volts]", "--reference", "goal:rad",
          "--controller", f"kp={SERVO_KP:.6g}", "--initial", "free",
          "--validation", SERVO_LOGS[2], "--arm", "servo.toml", "--out", "servo"]],
        ["--time-limit", "90"], (SERVO_LOGS[2],))],
    known=[
        Known("friction over the torque of the load [1]", (0.2, 0.35),
              "fits of these logs (README of the logs)",
              plain("servo", "load_friction", "factor", "1"), 0.05),
    ],
    goals=[Goal("hub angle of the validation run below 13 %",
                validation_error("servo", (SERVO_LOGS[2],), "hub_angle", 0.13))])

# swept-ruler: theta in 1024 counts a turn, acceleration in 1.56 counts per m/s^2 by the makers'
# fit. The torque of the motor is not known: its reference takes its place, as instrument.
SWEPT_LOGS = ["amp25-1", "amp25-2", "amp75-1", "amp75-2"]
SWEPT_AGAIN = ("frf-amp25-2", "frf-amp75-2")
SWEPT_PAYLOAD_KG = 0.0077
SWEPT = Recording(
    name="swept-ruler",
    logs=[f"swept-ruler/{log}.txt" for log in SWEPT_LOGS],
    files={"swept.toml": f"""name = "swept ruler"

[beam]
length = 0.4318
width = 0.020638
thickness = 0.00079375
linear_density = 0.1319
youngs_modulus = 200e9

[hub]
inertia = 1e-4   # of no influence on responses to its motion

[payload]
mass = {SWEPT_PAYLOAD_KG}
"""},
    cases=[Case(
        "responses-to-hub", "from the hub angle to the acceleration of the tip",
        [["import", *[f"DATA/swept-ruler/{log}.txt" for log in SWEPT_LOGS],
          "--column", "time=t:s", "--column", "hub_angle=$\\theta$:rad:2*pi/1024",
          "--column", "tip_acceleration=a:m/s^2:1/1.56", "--column", "torque=u:N m:0.001",
          "--arm", "swept.toml", "--out", "swept"],
         ["identify", "swept/measurement.toml", "--input", "hub_angle", "--no-fit",
          "--out", "swept-identified"],
         ["import", *[f"swept-identified/frf-{log}.csv" for log in SWEPT_LOGS],
          *[part for run in SWEPT_AGAIN for part in ("--validation", run)],
          "--arm", "swept.toml", "--out", "responses-to-hub"]],
        [], SWEPT_AGAIN)],
    known=[
        Known("mass at the tip, 7.7 g filed [kg]", (0.0117, 0.0127),
              "fits of these logs (README of the logs)",
              named("responses-to-hub",
                    ("payload_mass", "mass", 1.0, SWEPT_PAYLOAD_KG, "kg"),
                    ("attached_mass", "mass", 1.0, SWEPT_PAYLOAD_KG, "kg")), 0.15),
        Known("gain of the accelerometer, over the makers'", (0.70, 0.76),
              "fits of these logs (README of the logs)",
              plain("responses-to-hub", "sensor_gain", "factor", "1"), 0.05),
    ],
    goals=[Goal("a mass at the tip named",
                names_one_of(["responses-to-hub"], ["payload_mass", "attached_mass"]))])

RECORDINGS = [EMPS, ROTARY, RULER, RIG, STEPS, ROBOT, SERVO, SWEPT]
