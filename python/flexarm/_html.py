"""What notebooks show of arms, roots and diagnoses."""

from html import escape

from ._flexarm import (
    Arm,
    DampedPoles,
    Diagnosis,
    Identification,
    InputError,
    Modes,
    Poles,
    Zeros,
    arm_numbers,
)
from ._methods import method

_STYLE = "border-collapse:collapse"


def _cell(value, tag="td"):
    align = "left" if isinstance(value, str) else "right"
    text = value if isinstance(value, str) else f"{value:.6g}"
    return f'<{tag} style="text-align:{align}">{escape(text)}</{tag}>'


def _table(caption, header, rows):
    lines = [f'<table style="{_STYLE}"><caption>{escape(caption)}</caption><thead><tr>']
    lines += [_cell(title, "th") for title in header]
    lines.append("</tr></thead><tbody>")
    for row in rows:
        lines.append("<tr>" + "".join(_cell(value) for value in row) + "</tr>")
    lines.append("</tbody></table>")
    return "".join(lines)


def _effect_rows(name, effect):
    rows = []
    for parameter, value in effect.parameters.items():
        unit = effect.units.get(parameter, "")
        on = f" on {effect.sensor}" if effect.sensor else ""
        rows.append((f"{name}{on}: {parameter}", value, "" if unit == "1" else unit))
    return rows or [(name, "", "")]


@method("_repr_html_", Arm)
def arm_html(self):
    rows = []
    for number in arm_numbers():
        value = getattr(self, number.attribute)
        if value is not None and (value != 0.0 or number.required):
            rows.append((f"{number.key} ({number.symbol})", value, number.unit))
    rows.append(("total inertia (I_T)", self.total_inertia_kg_m2, "kg m^2"))
    for name, effect in self.effects.items():
        rows += _effect_rows(name, effect)
    return _table(self.name or "arm", ("number", "value", "unit"), rows)


@method("_repr_html_", Poles)
def poles_html(self):
    rows = [
        (float(i + 1), float(f), float(w))
        for i, (f, w) in enumerate(zip(self.frequency_Hz, self.omega_rad_per_s))
    ]
    return _table("Undamped poles", ("mode", "frequency [Hz]", "omega [rad/s]"), rows)


def _complex(s):
    return f"{s.real:.6g} {'-' if s.imag < 0 else '+'} {abs(s.imag):.6g}i"


@method("_repr_html_", DampedPoles)
def damped_poles_html(self):
    rows = [
        (float(i + 1), float(f), float(zeta), _complex(pair[0]), _complex(pair[1]))
        for i, (f, zeta, pair) in enumerate(
            zip(self.frequency_Hz, self.damping_ratio, self.s_rad_per_s)
        )
    ]
    header = ("mode", "frequency [Hz]", "damping ratio", "s [rad/s]", "s [rad/s]")
    return _table("Damped poles", header, rows)


@method("_repr_html_", Zeros)
def zeros_html(self):
    rows = [
        (float(i + 1), float(f), _complex(s), "yes" if right else "no")
        for i, (f, s, right) in enumerate(
            zip(self.frequency_Hz, self.s_rad_per_s, self.is_non_minimum_phase)
        )
    ]
    header = ("no.", "|s|/2 pi [Hz]", "s [rad/s]", "non-minimum phase")
    return _table(f"Undamped zeros of torque to {self.sensor}", header, rows)


@method("_repr_html_", Modes)
def modes_html(self):
    rows = [
        (float(i), *(float(value) for value in row))
        for i, row in enumerate(zip(self.frequency_Hz, self.hub_slope, self.damping_ratio))
    ]
    header = ("mode", "frequency [Hz]", "hub slope", "damping ratio")
    return _table("Modes; mode 0 is the rigid-body mode", header, rows)


def _with_error(value, error):
    return "" if value is None else f"{value:.6g}" + ("" if error is None else f" ± {error:.2g}")


@method("_repr_html_", Identification)
def identification_html(self):
    rows = [
        (
            f"{root.feature} {root.order or ''} {root.sensor or ''}".strip(),
            _with_error(root.frequency_Hz, root.frequency_std_Hz),
            _with_error(root.analytical_Hz, None),
            _with_error(root.damping_ratio, root.damping_ratio_std),
        )
        for root in [*self.poles, *self.zeros]
    ]
    header = ("root", "frequency [Hz]", "of the arm file [Hz]", "damping ratio")
    return _table(self.name, header, rows)


def _cause_rows(cause):
    on = f" on {cause.sensor}" if cause.sensor else ""
    for estimate in cause.parameters.values():
        unit = "" if estimate.unit == "1" else estimate.unit
        number = f"{_with_error(estimate.value, estimate.std_error)} {unit}".strip()
        yield (cause.effect + on, estimate.name, number, cause.probability)
    if not cause.parameters:
        yield (cause.effect + on, "", "", cause.probability)


def _overlay_figure(diagnosis):
    """The first overlay as SVG; where gnuplot is missing, why there is none."""
    try:
        figures = diagnosis.figures()
    except InputError as error:
        return f"<p>{escape(str(error))}</p>"
    for name, svg in figures.items():
        if name.startswith(("overlay-", "frf-")):
            return svg[svg.index("<svg") :]
    return ""


@method("_repr_html_", Diagnosis)
def diagnosis_html(self):
    rows = [row for cause in self.causes for row in _cause_rows(cause)]
    text = f"<p>{escape(self.verdict_text)}</p>"
    if rows:
        text += _table("Causes", ("effect", "parameter", "value", "probability"), rows)
    return text + _overlay_figure(self)
