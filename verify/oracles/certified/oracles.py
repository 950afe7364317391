"""The digits of oracle tables in verify/data compared with balls: stars by closed forms of Eqs. (74), (75), reference motions by enclosures."""

import csv
from pathlib import Path

from flint import arb, ctx
from sympy import asin, asinh, diff, pi, sqrt, symbols

from examples import enclose, fraction
from motion import Motion
from motions import digits_for

import coordinates  # noqa: E402  (verify/oracles/symbolic, on the path by examples)
import lagrangian  # noqa: E402

DATA = Path(__file__).parent.parent.parent / "data"


def rows(name):
    """Rows of a table as dictionaries."""
    with open(DATA / f"{name}.csv") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def deviation(ball, text):
    """Largest possible distance of the enclosure from the decimal, in units of the decimal's last digit."""
    mantissa = text.lower().split("e")
    exponent = int(mantissa[1]) if len(mantissa) > 1 else 0
    decimals = len(mantissa[0].split(".")[1]) if "." in mantissa[0] else 0
    unit = arb(10) ** (exponent - decimals)
    return abs(ball - arb(fraction(text))).upper() / unit


def stars():
    """A_0, A_1, A_3, C with two derivatives in x = e^2, a1 = rho = 1; 300 extra digits for the cancellation near the sphere."""
    ctx.dps = 400
    x = symbols("x")
    q = sqrt(1 - x)
    # arcsin(e) / e for an oblate, arsinh(u) / u, u = sqrt(-x), for a prolate spheroid.
    angle = {"oblate": asin(sqrt(x)) / sqrt(x), "prolate": asinh(sqrt(-x)) / sqrt(-x)}
    worst, count = arb(0), 0
    for kind, f in angle.items():
        a_1 = q / x * (f - q)
        a_3 = 2 / x * (1 - q * f)
        functions = {"A0": 2 * q * f, "A1": a_1, "A3": a_3, "C": 4 * pi**2 / 15 * q * (a_1 - q**2 * a_3)}
        derivatives = {}
        for name, function in functions.items():
            derivatives |= {name: function, name + "_x": diff(function, x), name + "_xx": diff(function, x, 2)}
        for row in rows("spheroid"):
            parameter = fraction(row["parameter"])
            if row["kind"] != kind or parameter == 0 or parameter == 1 and kind == "prolate":
                continue
            value = parameter**2 if kind == "oblate" else 1 - parameter**2
            for name, ball in zip(derivatives, enclose(list(derivatives.values()), {"x": arb(value)})):
                off = deviation(ball, row[name])
                worst, count = worst.max(off), count + 1
    return count, worst


def motions():
    """Every state of the ten reference motions."""
    scenes = {row["scene"]: row for row in rows("reference_scenes")}
    states = {}
    for row in rows("reference_states"):
        states.setdefault(row["scene"], []).append(row)
    out = {}
    for name, listed in states.items():
        scene = scenes[name]
        s = [fraction(scene[k]) for k in ("s_xx", "s_yy", "s_zz")]
        digits = digits_for(s, max(float(row["t"]) for row in listed))
        ctx.dps = digits + 15
        body = (fraction("1"), fraction(scene["inertia_ratio"]), fraction("1"))
        values = {k: arb(fraction(scene[k])) for k in ("alpha", "beta", "gamma", "spin")}
        values |= {"alpha_1": arb(fraction(scene["alpha_rate"])), "beta_1": arb(fraction(scene["beta_rate"]))}
        values |= {"i_xx": arb(1), "i_zz": arb(body[1])}
        values["gamma_1"] = enclose([lagrangian.GAMMA_RATE], values)[0]
        balls = enclose([*coordinates.E_Z, *lagrangian.MOMENTUM, *coordinates.E_X], values)
        motion = Motion(body, s, (balls[0:3], balls[3:6], balls[6:9]), digits)
        worst = arb(0)
        names = [f"{v}_{i}" for v in ("n", "l", "ex") for i in "xyz"]
        for row in sorted(listed, key=lambda r: float(r["t"])):
            components = [x for vector in motion.at(fraction(row["t"])) for x in vector]
            for component, label in zip(components, names):
                worst = worst.max(abs(component - arb(fraction(row[label]))).upper())
        out[name] = len(listed) * 9, worst
        print(f"{name}: {len(listed) * 9} components to t = {listed[-1]['t']}, off by at most {worst.str(3, radius=False)}", flush=True)
    return out


def report():
    """Prints what was compared."""
    count, worst = stars()
    print(f"spheroid.csv: {count} numbers, off by at most {worst.str(3, radius=False)} of their last digit", flush=True)
    motions()


if __name__ == "__main__":
    report()
