"""The rows of docs/benchmarks.md: which measurement of flexarm stands beside which of another tool.

Ours: subject of the Google Benchmark program, name, and the counter that is its error; or, for what
no Google Benchmark program measures, file of rows and `work`. Theirs: file of rows and `work`.
"""
from typing import NamedTuple, Optional


class Ours(NamedTuple):
    subject: str
    name: str
    error: Optional[str] = None  # a counter


class Measured(NamedTuple):
    file: str
    work: str


class Row(NamedTuple):
    work: str
    ours: object
    theirs: Measured
    by: str  # the other tool, its function and settings


class Table(NamedTuple):
    title: str
    text: str  # what the errors are; what is in the times
    rows: list


class Growth(NamedTuple):
    work: str
    over: str
    subject: str
    name: str  # of the series, without the size
    size: str  # name of the argument


ROOTS = Table(
    "Poles and zeros",
    "The paper's arm. Errors of ten roots are the largest relative error of a frequency against 30 "
    "digits. Of 1000 roots, that of flexarm is the certified bound of lambda, that of SciPy the "
    "largest difference to flexarm. The script in SciPy finds brackets by a scan that NumPy does at "
    "once.",
    [Row("10 poles and 10 hub zeros, exact", Ours("exact_tf", "poles_and_hub_zeros", "error"),
         Measured("roots_scipy", "brentq poles and hub zeros:10"), "SciPy `brentq`"),
     Row("1000 poles, exact", Ours("exact_tf", "poles/roots:1000", "ulp"),
         Measured("roots_scipy", "brentq poles:1000"), "SciPy `brentq`"),
     Row("1000 hub zeros, exact", Ours("exact_tf", "hub_zeros/roots:1000", "ulp"),
         Measured("roots_scipy", "brentq hub zeros:1000"), "SciPy `brentq`"),
     Row("10 poles and 10 hub zeros, 29 cubic elements",
         Ours("fem", "poles_and_hub_zeros/degree:3/elements:29", "error"),
         Measured("control_octave", "pole and zero elements:29"), "Octave `pole`, `zero`")])


def elements_row(count, ours, solver):
    return Row(f"10 poles, {count:,} cubic elements", Ours("fem", ours, "error"),
               Measured("matrices_scipy", f"{solver} elements:{count}"), f"SciPy `{solver}`")


MATRICES = Table(
    "Finite elements and assumed modes",
    "Ten poles of the paper's arm. Errors are the largest relative error of a frequency against the "
    "exact value. Times of flexarm include assembly. SciPy gets the assembled stiffness and mass: "
    "`eigh` as dense matrices, `eigsh` as sparse ones in shift-invert. The last two rows have the "
    "default models of flexarm.",
    [elements_row(29, "ten_poles/cubic_elements_29", "eigh"),
     elements_row(100, "poles_of_cubic_elements/elements:100", "eigh"),
     elements_row(300, "ten_poles/cubic_elements_300", "eigh"),
     elements_row(29, "ten_poles/cubic_elements_29", "eigsh"),
     *[elements_row(count, f"poles_of_cubic_elements/elements:{count}", "eigsh")
       for count in (100, 1000, 10000, 100000)],
     Row("10 poles, 4 elements of degree 15", Ours("fem", "ten_poles/default_mesh", "error"),
         Measured("matrices_scipy", "eigsh elements:100"), "SciPy `eigsh`, 100 cubic elements"),
     Row("10 poles, 36 Legendre functions", Ours("assumed_modes", "ten_poles", "error"),
         Measured("matrices_scipy", "eigh functions:36"), "SciPy `eigh`")])


def response_row(file, work, by, modes):
    return Row("64 frequencies, exact", Ours("exact_tf", "response/hub_angle", "error"),
               Measured(file, f"{work} modes:{modes}"), f"{by}, {modes} modes")


RESPONSES = Table(
    "Frequency responses",
    "Hub angle of the damped arm from 0.1 to 200 Hz. Errors are the largest relative error of a value: "
    "of flexarm against 25 digits, of the others against flexarm. They evaluate a modal state space. "
    "Its error is that of the omitted modes, unless the method loses more. `freqresp` of SciPy goes "
    "through the polynomials of the transfer function. A linear solve per frequency and partial "
    "fractions are what a user of NumPy would write in its place. The time of partial fractions "
    "includes the eigenvalues.",
    [response_row(file, work, by, modes)
     for file, work, by in (("responses_scipy", "freqresp", "SciPy `freqresp`"),
                            ("responses_scipy", "solve", "NumPy `linalg.solve`"),
                            ("responses_scipy", "partial fractions", "NumPy `linalg.eig`"),
                            ("control_octave", "freqresp", "Octave `freqresp`"))
     for modes in (10, 40, 160)])

SIMULATE = "`response::simulate`"
READINGS = "`ArmSimulator::readings`"
LINEAR_ARM = Ours("simulation", "simulation/linear/modes:10", "difference")
LINEAR_FIT = Ours("simulation", "readings_of_fit/linear/modes:10", "difference")
DLSIM = (Measured("simulation_scipy", "dlsim modes:10"), "SciPy `dlsim`")
LSIM = (Measured("simulation_scipy", "lsim modes:10"), "SciPy `lsim`")
OCTAVE_LSIM = (Measured("control_octave", "lsim modes:10"), "Octave `lsim`")

LINEAR = Table(
    "Linear time simulation",
    "100,000 samples at 10 kHz, 10 flexible modes, 4 sensors, zero-order hold of the torque. "
    "`response::simulate` is what `flexarm simulate` calls. `ArmSimulator::readings` is what fits "
    "call: it returns readings alone and takes samples in blocks. The error of flexarm is the "
    "difference to inner steps ten times smaller. Errors of the others are differences to flexarm. "
    "Each is the largest of the four sensors, relative to their peaks. The target of the project is a "
    "ratio of 50 to `dlsim`.",
    [*[Row(SIMULATE, LINEAR_ARM, *other) for other in (DLSIM, LSIM, OCTAVE_LSIM)],
     *[Row(READINGS, LINEAR_FIT, *other) for other in (DLSIM, LSIM, OCTAVE_LSIM)]])

SECOND = Ours("simulation", "second_with_friction/modes:10", "difference")
SECOND_OF_FIT = Ours("simulation", "readings_of_fit/coulomb/modes:10", "difference")


def tanh_row(method, width, tolerance, work=SIMULATE, ours=SECOND):
    return Row(work, ours,
               Measured("friction_scipy", f"{method} width:{width} tolerance:{tolerance}"),
               f"SciPy `solve_ivp`, {method}, width {width} rad/s, tolerance {tolerance}")


def events_row(tolerance, work=SIMULATE, ours=SECOND):
    return Row(work, ours, Measured("stick_scipy", f"events tolerance:{tolerance}"),
               f"SciPy `solve_ivp`, DOP853, events, tolerance {tolerance}")


def chain_row(links, steps, kind):
    return Row(SIMULATE, Measured("friction_mujoco", "flexarm modes:10"),
               Measured("friction_mujoco", f"links:{links} steps:{steps} {kind}"),
               f"MuJoCo `mj_step`, {links} links, step {100 / steps:g} us, {kind} friction")


FRICTION = Table(
    "Dry friction with stick",
    "The first second of the same simulation, 10,000 samples and 10 modes, with Coulomb friction of "
    "0.012 N m at the hub. `solve_ivp` needs a smooth friction, unless it has events: a tanh of the "
    "hub velocity over the stated width. With events it sticks as flexarm does: the script finds stops "
    "and breakaways. The absolute tolerance is a thousandth of the relative one. Radau has the "
    "Jacobian. MuJoCo simulates a chain of rigid links with springs. Its friction is soft with "
    "MuJoCo's own constants. It is stiff with a time constant of two steps and an impedance of 0.9999. "
    "Errors of the other tools are those of hub angle and hub velocity, relative to their peaks: of "
    "`solve_ivp` against flexarm with ten inner steps per sample, of MuJoCo against the same with 40 "
    "modes. The error of flexarm beside `solve_ivp` is the difference of all four sensors to inner "
    "steps ten times smaller. Beside MuJoCo it is that of hub angle and hub velocity against 40 modes: "
    "that of the omitted modes. The target of the project is a ratio of 1000 to `solve_ivp` at "
    "comparable error.",
    [tanh_row("LSODA", "0.001", "1e-06"), tanh_row("Radau", "0.001", "1e-06"),
     tanh_row("LSODA", "1e-05", "1e-06"), tanh_row("LSODA", "1e-07", "1e-08"),
     tanh_row("LSODA", "1e-08", "1e-10"),
     tanh_row("LSODA", "1e-08", "1e-10", READINGS, SECOND_OF_FIT),
     events_row("1e-06"), events_row("1e-10"),
     events_row("1e-10", READINGS, SECOND_OF_FIT),
     chain_row(20, 1, "soft"), chain_row(10, 1, "stiff"), chain_row(20, 1, "stiff"),
     chain_row(40, 2, "stiff"), chain_row(80, 8, "stiff")])

SPECTRA = Table(
    "Spectra",
    "An hour at 1 kHz of torque and five sensors: power and cross spectra in half-overlapped segments "
    "of 8192 samples with a Hann window. The error of SciPy is the largest difference to flexarm, "
    "relative to the largest line.",
    [Row("6 power spectra, 5 cross spectra", Ours("spectra", "cross_spectra"),
         Measured("spectra_scipy", "welch and csd"), "SciPy `welch`, `csd`")])

COMPARISONS = [ROOTS, MATRICES, RESPONSES, LINEAR, FRICTION, SPECTRA]

GROWTH = [
    Growth("poles of `exact_tf`", "roots", "exact_tf", "poles", "roots"),
    Growth("hub zeros of `exact_tf`", "roots", "exact_tf", "hub_zeros", "roots"),
    Growth("10 poles of cubic elements", "elements", "fem", "poles_of_cubic_elements", "elements"),
    Growth("linear simulation, 100,000 samples", "modes", "simulation", "growth_with_modes/linear",
           "modes"),
    Growth("simulation with Coulomb friction, 100,000 samples", "modes", "simulation",
           "growth_with_modes/coulomb", "modes"),
    Growth("linear simulation, 10 modes", "samples", "simulation", "growth_with_samples/linear",
           "samples"),
    Growth("simulation with Coulomb friction, 10 modes", "samples", "simulation",
           "growth_with_samples/coulomb", "samples")]

# What Debian has each tool in.
PACKAGES = {"scipy": "python3-scipy", "octave": "octave-control", "mujoco": "libmujoco-dev"}
TOOLS = {"scipy": "SciPy", "octave": "Octave", "mujoco": "MuJoCo"}
