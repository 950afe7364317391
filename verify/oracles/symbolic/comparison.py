"""Kernel values written by the Rust side, compared with the derivation at the same points."""

import json
import math
from fractions import Fraction

import exchange
import mpmath as mp

# In units of 2.2e-16 times the scale; verify/src/checks/symbolic.rs gives the reasons.
BOUNDS = {"rational": 2.0, "closed": 16.0}
EPSILON = 2.0**-52


def error(value, expected, scale):
    """The error in units of EPSILON times the scale, exact to the last step; NaN and infinities fail."""
    if not all(isinstance(x, (int, float)) and math.isfinite(x) for x in (value, scale)):
        return math.inf
    difference = abs((Fraction if isinstance(expected, Fraction) else mp.mpf)(value) - expected)
    if difference == 0:
        return 0.0
    return float(difference) / (EPSILON * scale) if scale > 0 else math.inf


def report(quantities, path):
    """Prints the worst error of each quantity; returns the number of quantities that fail."""
    with open(path) as file:
        kernels = json.load(file)
    points = [{name: Fraction(text) for name, text in point.items()} for point in kernels["points"]]
    assert points, "no points"
    failures = 0
    derived = exchange.evaluators(quantities)
    for kind in ("rational", "closed"):
        names = {name for name, e in derived.items() if e.quantity.exact == (kind == "rational")}
        for name in sorted(names ^ set(kernels[kind])):
            print(f"{name}: on one side only")
            failures += 1
        for name in sorted(names & set(kernels[kind])):
            worst, where = worst_of(derived[name], points, kernels[kind][name], kind)
            bad = not worst <= BOUNDS[kind]
            failures += bad
            print(f"{'FAIL' if bad else 'ok':4}  {name:44} {worst:8.3f}  {where}")
    print(f"{len(derived)} quantities at {len(points)} points, seed {kernels['seed']}: {failures} fail")
    return failures


def worst_of(evaluator, points, rows, kind):
    """The largest error and its place."""
    worst, where = -1.0, "nothing compared"
    if len(rows) != len(points):
        return math.inf, f"{len(rows)} rows for {len(points)} points"
    for index, (point, row) in enumerate(zip(points, rows)):
        expected, scales = evaluator.at(point)
        if not isinstance(row, list) or len(row) != len(expected):
            return math.inf, f"point {index}: {str(row)[:80]}"
        for component, (ours, exact, scale) in enumerate(zip(row, expected, scales)):
            value, scale = ours if kind == "rational" else (ours, float(scale))
            exact = Fraction(exact) if kind == "rational" else exact
            figure = error(value, exact, scale)
            if figure > worst:
                worst, where = figure, f"component {component} at point {index}"
    return (worst if worst >= 0 else math.inf), where
