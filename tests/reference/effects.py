#!/usr/bin/env python3
"""Poles, zeros, hub slopes and responses of arms with linear effects, to 25 digits: effects.json.

The arm of arm/linear_arm.hpp in the frequency domain, with y, psi (rotation of the section),
M = EI (1 + kv s) psi' and the transverse force Q = kGA (y' - psi) + g P y':

    (kGA + g P) y' = Q + kGA psi        (without shear y' = psi)
    EI (1 + kv s) psi' = M
    M' = rho I s^2 psi - (Q - g P y')
    Q' = (m s^2 + ca s) y,              P = Mp + m (l - x) + masses on the beam beyond x

    y(0) = a theta,  kr (1 + tr s) (psi(0) - theta) = M(0),  [psi] = M/kc at the crack
    [Q] = mk s^2 (y + u),  [M] = g mk u,  (mk s^2 + ck s + kk) u = -mk (s^2 y + g psi) at a mass
    Q(l) = -s^2 (Mp y + Sp psi),  M(l) = -s^2 (Sp y + Jp psi) - g Sp psi
    taud = ((Ih - Jr) s^2 + g P(0) a) theta - a Q(0) - M(0) = kd (1 + td s) (theta_m - theta)
    tau = (Jr s^2 + c s + ks) theta_m + taud,   theta_m the hub angle that sensors show

One power series in x from end to end (one more for a crack and for each mass), in as many digits as
it cancels: no segments, no scaling, no discretisation. Run it to write effects.json beside itself; it needs mpmath
and takes some minutes.
"""
import json
import pathlib

from mpmath import mp, mpc, mpf

mp.dps = 70
SHOWN = 25
DAMPING_STEPS = 60

BEAM = dict(length="0.96", width="0.019008", thickness="0.0032004", density="2710",
            youngs_modulus="7.11e10", shear_modulus="2.67e10")
THICK = dict(length="0.5", width="0.02", thickness="0.04", density="2710",
             youngs_modulus="7.11e10", shear_modulus="2.67e10")
HUB = dict(inertia="5.86e-4", viscous_friction="0.002")
PAYLOAD = dict(mass="0.05", inertia="0.0001")
DAMPING = dict(kelvin_voigt="0.00012")

EFFECTS = {
    "root_compliance": dict(stiffness="25"),
    "local_stiffness_loss": dict(position="0.35", stiffness="18"),
    "hub_spring": dict(stiffness="0.8"),
    "hub_radius": dict(radius="0.06"),
    "payload_offset": dict(offset="0.03"),
    "air_damping": dict(coefficient="0.02"),
    "gravity": dict(acceleration="9.81"),
    "attached_mass": dict(mass="0.04", position="0.5236"),
    "tuned_mass": dict(mass="0.02", frequency="14", damping_ratio="0.05", position="0.6982"),
    "root_damping": dict(stiffness="25", time="0.002"),
    "drive_compliance": dict(stiffness="40", rotor_share="0.6", time="0.001"),
    "shear_and_rotary_inertia": dict(),
}


def case(name, effects, beam=BEAM, hub=HUB, payload=PAYLOAD, damping=DAMPING):
    return dict(name=name, beam=beam, hub=hub, payload=payload, damping=damping,
                effects={e: EFFECTS[e] if isinstance(effects, (list, tuple)) else effects[e]
                         for e in effects})


CASES = [case("none", [])] + [case(e, [e]) for e in EFFECTS] + [
    case("factors", {"hub_inertia": dict(factor="1.3"), "flexural_rigidity": dict(factor="0.9"),
                     "linear_density": dict(factor="1.1"), "payload_mass": dict(mass="0.02"),
                     "payload_inertia": dict(inertia="0.0002"),
                     "hub_viscous_friction": dict(coefficient="0.005"),
                     "structural_damping": dict(time="0.0002")}),
    case("standing", {"gravity": dict(acceleration="-3")}),
    case("thick_with_shear", {"shear_and_rotary_inertia": dict(shear_coefficient="0.85")}, beam=THICK,
         payload=dict(mass="0.3", inertia="0.0005")),
    case("crack_and_root", ["local_stiffness_loss", "root_compliance"]),
    case("gravity_and_shear", ["gravity", "shear_and_rotary_inertia"]),
    case("radius_and_offset", ["hub_radius", "payload_offset"]),
    case("spring_and_air", ["hub_spring", "air_damping"]),
    case("bare_with_crack", ["local_stiffness_loss"], hub=dict(inertia="5.86e-4"),
         payload=dict(mass="0", inertia="0"), damping=dict(kelvin_voigt="0")),
    case("all", [e for e in EFFECTS if e not in ("root_damping", "attached_mass", "tuned_mass",
                                                 "drive_compliance")]),
    case("drive_and_root", ["drive_compliance", "root_compliance", "hub_spring", "hub_radius", "gravity"]),
]


class Arm:
    def __init__(self, c):
        def number(table, key, otherwise="0"):
            return mpf(c[table].get(key, otherwise))

        def effect(name, key, otherwise="0"):
            return mpf(c["effects"].get(name, {}).get(key, otherwise))

        width, thickness = number("beam", "width"), number("beam", "thickness")
        self.l = number("beam", "length")
        self.thickness = thickness
        self.EI = (number("beam", "youngs_modulus") * width * thickness**3 / 12 *
                   effect("flexural_rigidity", "factor", "1"))
        self.m = number("beam", "density") * width * thickness * effect("linear_density", "factor", "1")
        self.kv = number("damping", "kelvin_voigt") + effect("structural_damping", "time")
        self.ca = effect("air_damping", "coefficient")
        self.kGA = self.rotary = None
        if "shear_and_rotary_inertia" in c["effects"]:
            k = (effect("shear_and_rotary_inertia", "shear_coefficient")
                 if "shear_coefficient" in c["effects"]["shear_and_rotary_inertia"] else mpf(5) / 6)
            self.kGA = k * number("beam", "shear_modulus") * width * thickness
            self.rotary = self.m * thickness**2 / 12
        self.Ih = number("hub", "inertia") * effect("hub_inertia", "factor", "1")
        self.a = effect("hub_radius", "radius")
        self.c = number("hub", "viscous_friction") + effect("hub_viscous_friction", "coefficient")
        self.ks = effect("hub_spring", "stiffness")
        self.kr = effect("root_compliance", "stiffness") + effect("root_damping", "stiffness") or None
        self.tr = effect("root_damping", "time")
        self.drive = effect("drive_compliance", "stiffness") or None
        self.Jr = self.Ih * effect("drive_compliance", "rotor_share")
        self.td = effect("drive_compliance", "time")
        self.crack = None
        if "local_stiffness_loss" in c["effects"]:
            self.crack = (effect("local_stiffness_loss", "position"),
                          effect("local_stiffness_loss", "stiffness"))
        # Position, mass, stiffness and damping; a mass without stiffness is fixed.
        self.masses = []
        if "attached_mass" in c["effects"]:
            self.masses.append((effect("attached_mass", "position"), effect("attached_mass", "mass"),
                                mpf(0), mpf(0)))
        if "tuned_mass" in c["effects"]:
            mass = effect("tuned_mass", "mass")
            natural = 2 * mp.pi * effect("tuned_mass", "frequency")
            self.masses.append((effect("tuned_mass", "position"), mass, mass * natural**2,
                                2 * effect("tuned_mass", "damping_ratio") * natural * mass))
        self.suspended = 1  # how much of the suspensions' damping is on
        self.Mp = number("payload", "mass") + effect("payload_mass", "mass")
        offset = effect("payload_offset", "offset")
        self.Sp = self.Mp * offset
        self.Jp = number("payload", "inertia") + effect("payload_inertia", "inertia") + self.Mp * offset**2
        self.g = effect("gravity", "acceleration")
        self.total = (self.Ih + self.m * ((self.a + self.l)**3 - self.a**3) / 3 +
                      (self.rotary or 0) * self.l + self.Mp * (self.a + self.l)**2 +
                      2 * self.Sp * (self.a + self.l) + self.Jp +
                      sum(m * (self.a + X)**2 for X, m, k, c in self.masses))

    def tension(self, x):
        beyond = sum(m for X, m, k, c in self.masses if X > x)
        return self.g * (self.Mp + self.m * (self.l - x) + beyond)

    def resonance(self, s, damped):
        """What vanishes where suspended masses do by themselves."""
        product = mpf(1)
        for X, m, k, c in self.masses:
            if k:
                product *= 1 + (self.suspended * c * s if damped else 0) / k + m * s**2 / k
        return product

    def advance(self, state, x, h, s, damped):
        """The state (y, psi, M, Q) at x + h from that at x, by power series."""
        rigidity = self.EI * (1 + self.kv * s) if damped else self.EI
        inertia = self.m * s**2 + (self.ca * s if damped else 0)
        rotary = (self.rotary or 0) * s**2
        P0, P1 = self.tension(x), -self.g * self.m
        y, psi, M, Q = ([value] for value in state)
        slope = []  # series of y'
        total = list(state)
        power = mpf(1)
        quiet = n = 0
        while quiet < 8:
            if self.kGA is None:
                slope.append(psi[n])
            else:
                known = Q[n] + self.kGA * psi[n] - (P1 * slope[n - 1] if n else 0)
                slope.append(known / (self.kGA + P0))
            axial = P0 * slope[n] + (P1 * slope[n - 1] if n else 0)
            y.append(slope[n] / (n + 1))
            psi.append(M[n] / rigidity / (n + 1))
            M.append((rotary * psi[n] - Q[n] + axial) / (n + 1))
            Q.append(inertia * y[n] / (n + 1))
            n += 1
            power *= h
            small = True
            for i, series in enumerate((y, psi, M, Q)):
                term = series[n] * power
                total[i] += term
                small = small and abs(term) <= mp.eps * (abs(total[i]) + mp.eps)
            quiet = quiet + 1 if small else 0
        return total

    def field(self, state, s, damped, x_end):
        """The state at x_end from that at the root, through what lies between."""
        places = [(X, 1, m, k, c) for X, m, k, c in self.masses]
        if self.crack:
            places.append((self.crack[0], 0))
        x = mpf(0)
        for place in sorted(places):
            X = place[0]
            if X > x_end:
                break
            state = self.advance(state, x, X - x, s, damped) if X > x else state
            x = X
            if place[1] == 0:
                state[1] += state[2] / self.crack[1]
                continue
            m, k, c = place[2:]
            u = mpf(0)
            if k:
                dashpot = self.suspended * c * s if damped else 0
                u = -m * (s**2 * state[0] + self.g * state[1]) / (m * s**2 + dashpot + k)
            state[3] += m * s**2 * (state[0] + u)
            state[2] += self.g * m * u
        return self.advance(state, x, x_end - x, s, damped) if x_end > x else state

    def solve(self, s, damped):
        """Determinant of the hub held, and root states (unit theta; unit M0; unit Q0) with tips."""
        loss = 1 + self.tr * s if damped else 1
        compliance = 1 / (self.kr * loss) if self.kr else mpf(0)
        roots = [[self.a, mpf(1), mpf(0), mpf(0)], [mpf(0), compliance, mpf(1), mpf(0)],
                 [mpf(0), mpf(0), mpf(0), mpf(1)]]
        tips = [self.field(list(r), s, damped, self.l) for r in roots]
        gaps = [(M + s**2 * (self.Sp * y + self.Jp * psi) + self.g * self.Sp * psi,
                 Q + s**2 * (self.Mp * y + self.Sp * psi)) for y, psi, M, Q in tips]
        held = gaps[1][0] * gaps[2][1] - gaps[2][0] * gaps[1][1]
        M0 = -(gaps[0][0] * gaps[2][1] - gaps[2][0] * gaps[0][1])  # times 1/held, for unit theta
        Q0 = -(gaps[1][0] * gaps[0][1] - gaps[0][0] * gaps[1][1])
        # Each is linear in what a suspended mass does, and has its poles.
        resonance = self.resonance(s, damped)
        return held * resonance, M0 * resonance, Q0 * resonance, roots, tips

    def values(self, s, damped, sensors=()):
        """Functions of s: torque D and the sensors N for theta = held, so that sensor/tau = N/D."""
        held, M0, Q0, roots, tips = self.solve(s, damped)
        friction = self.c * s if damped else 0
        passed_on = ((self.Ih - self.Jr) * s**2 + self.tension(0) * self.a) * held - self.a * Q0 - M0
        motor = held
        if self.drive:
            motor += passed_on / (self.drive * (1 + self.td * s if damped else 1))
        D = (self.Jr * s**2 + friction + self.ks) * motor + passed_on

        def combined(states, i):
            return held * states[0][i] + M0 * states[1][i] + Q0 * states[2][i]

        shown = {"hub_angle": motor}
        tip = combined(tips, 0)
        shown["tip_displacement"] = tip
        shown["tip_deflection"] = tip - (self.a + self.l) * held
        for X in sensors:
            inside = [self.field(list(r), s, damped, X) for r in roots]
            rigidity = self.EI * (1 + self.kv * s) if damped else self.EI
            shown[f"strain@{mp.nstr(X, 6)}"] = self.thickness / 2 * combined(inside, 2) / rigidity
        return D, shown


def real_roots(f, start, stop, steps, wanted):
    """Sign changes of f on [start, stop], polished; at most `wanted`."""
    found = []
    at, value = start, f(start)
    for k in range(1, steps + 1):
        nxt = start + (stop - start) * k / steps
        new = f(nxt)
        if value * new < 0:
            found.append(mp.findroot(f, (at, nxt), solver="anderson", tol=mpf(10)**-100,
                                     verify=False))
            if len(found) == wanted:
                break
        at, value = nxt, new
    return found


def digits(x):
    if isinstance(x, mpc):
        return [mp.nstr(x.real, SHOWN), mp.nstr(x.imag, SHOWN)]
    return mp.nstr(x, SHOWN)


def toml(c):
    lines = [f'name = "{c["name"]}"']
    for table in ("beam", "hub", "payload", "damping"):
        lines += [f"[{table}]"] + [f"{k} = {v}" for k, v in c[table].items()]
    for name, parameters in c["effects"].items():
        lines += [f"[effects.{name}]"] + [f"{k} = {v}" for k, v in parameters.items()]
    return "\n".join(lines) + "\n"


def reference(c, poles=6, tip_zeros=4):
    arm = Arm(c)
    scale = mp.sqrt(arm.EI / arm.m) / arm.l**2
    X = mpf("0.3") * arm.l

    def on_axis(which, square_sign):
        def f(lam):
            mp.dps = 50  # up to 20 digits cancel
            s = lam**2 * scale * (mpc(0, 1) if square_sign < 0 else 1)
            D, N = arm.values(s, False, ())
            value = D if which == "D" else N[which]
            return value.real if isinstance(value, mpc) else value
        return f

    result = {"name": c["name"], "arm": toml(c)}
    lams = real_roots(on_axis("D", -1), mpf("0.05"), mpf(24), 480, poles + 1)
    held = not (arm.ks == 0 and arm.g == 0)
    falls = arm.g < 0
    lowest = mpf(0)
    if held and not falls:
        lowest = (lams[0]**2 * scale)**2
        lams = lams[1:]
    if falls:
        lowest = -(real_roots(on_axis("D", 1), mpf("0.05"), mpf(6), 300, 1)[0]**2 * scale)**2
    omegas = [lam**2 * scale for lam in lams[:poles]]
    result["total_inertia_kg_m2"] = digits(arm.total)
    result["lowest_omega_squared_rad2_per_s2"] = digits(lowest)
    result["pole_omega_rad_per_s"] = [digits(w) for w in omegas]
    zeros = [lam**2 * scale for lam in real_roots(on_axis("hub_angle", -1), mpf("0.05"), mpf(24), 480, poles)]
    result["hub_zero_omega_rad_per_s"] = [digits(w) for w in zeros]
    real_tip = [lam**2 * scale for lam in real_roots(on_axis("tip_displacement", 1), mpf("0.05"), mpf(20), 300, tip_zeros)]
    imaginary_tip = [lam**2 * scale for lam in real_roots(on_axis("tip_displacement", -1), mpf("0.05"), mpf(20), 400, tip_zeros)]
    result["tip_zero_real_rad_per_s"] = [digits(w) for w in real_tip]
    result["tip_zero_imaginary_rad_per_s"] = [digits(w) for w in imaginary_tip]

    mp.dps = 70
    modes = []
    for w in omegas[:4]:
        # hub_angle/tau = sum theta_i^2/(I_T (s^2 + omega_i^2)): 1/residue is d(D/N)/d(s^2).
        step = w * mpf(10)**-15
        def inverse(omega):
            D, N = arm.values(mpc(0, omega), False, ())
            return (D / N["hub_angle"]).real
        derivative = -(inverse(w + step) - inverse(w - step)) / (2 * step) / (2 * w)
        slope = mp.sqrt(arm.total / derivative)
        _, N = arm.values(mpc(0, w), False, (X,))
        values = {name: digits((value / N["hub_angle"]).real * slope) for name, value in N.items()}
        modes.append(values)
    result["mode_values"] = modes

    responses = []
    for s in (mpc(0, 5), mpc(0, 137), mpc("-3", 61), mpc(20, 0), mpc(1, 2000)):
        D, N = arm.values(s, True, (X,))
        responses.append({"s_rad_per_s": digits(s),
                          **{name: digits(mpc(value / D)) for name, value in N.items()}})
    result["responses"] = responses

    damped = []
    if arm.kv or arm.ca or arm.c or arm.tr or arm.td or any(c for X, m, k, c in arm.masses):
        for w in omegas[:4]:
            if arm.kv * w / 2 > mpf("0.9"):  # near or beyond critical: pairs meet and part
                break
            # Continuation in damping, each step from the line through the last two.
            kept = arm.kv, arm.ca, arm.c, arm.tr, arm.td, mpf(1)
            before, s = mpc(0, w), mpc(0, w)
            for k in range(1, DAMPING_STEPS + 1):
                (arm.kv, arm.ca, arm.c, arm.tr, arm.td,
                 arm.suspended) = (value * k / DAMPING_STEPS for value in kept)
                guess = 2 * s - before
                before = s
                # On the way fifteen digits do, beside those that cancel.
                mp.dps = 70 if k == DAMPING_STEPS else 45
                s = mp.findroot(lambda z: arm.values(z, True, ())[0],
                                (guess, guess * (1 + mpc(0, "1e-6"))), solver="secant",
                                tol=mpf(10)**(-45 if k == DAMPING_STEPS else -15), maxsteps=60,
                                verify=False)
            damped.append(digits(s))
    result["damped_pole_rad_per_s"] = damped
    return result


if __name__ == "__main__":
    from multiprocessing import Pool
    with Pool(2) as pool:
        results = pool.map(reference, CASES, chunksize=1)
    path = pathlib.Path(__file__).with_name("effects.json")
    path.write_text(json.dumps(results, indent=1) + "\n")
