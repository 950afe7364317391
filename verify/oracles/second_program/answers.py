"""The answers of the second program as data: tables with a tolerance for each column.

Every table is computed three times: from the scene; from the scene with other numerics (segments, points, spans of spectra); and from the
scene with every number changed by a relative 1e-7, up or down. A column's tolerance is ten times

    the difference by numerics  +  the change of the column / 1e-7  x  the error that the command states for its motion:
                                   the requested tolerance and 2.2e-16 for each radian of rotation

so that it is what an error of that size in the scene's numbers does to the column, and nothing is chosen by hand. Four roundings of the
column's largest number come on top. The delay by a cause of residuals is a difference of times: ten times that error over the rate of rotation too.
"""

import json
import random
import re

import numpy as np

from motion import FINE, OTHER, Motion
from timing import DELAYS
from torque import Torque

MOVE = 1e-7
FACTOR = 10.0


def moved(scene):
    """The scene with every number that determines the motion and its observer changed by a relative 1e-7, up or down."""
    signs = random.Random(1)

    def nudge(value):
        return value * (1 + MOVE * signs.choice([-1, 1]))

    keys = {}
    for section in ("star", "lorentz_violation", "initial", "observer", "pulsar"):
        for key, value in scene.document.get(section, {}).items():
            if key == "tensor":
                new = [[nudge(x) for x in row] for row in value]
                keys[f"{section}.{key}"] = [[new[min(i, j)][max(i, j)] for j in range(3)] for i in range(3)]
            elif isinstance(value, list):
                keys[f"{section}.{key}"] = [nudge(x) for x in value]
            elif isinstance(value, (int, float)) and not isinstance(value, bool):
                keys[f"{section}.{key}"] = nudge(value)
    return scene.changed(keys)


def state_error(scene):
    """The error that the command states for its motion: the requested tolerance and the rounding of the rotation over the span."""
    motion = Motion(scene, scene.start, scene.start)
    return scene.tolerance + 2.2e-16 * motion.turning * abs(scene.end - scene.start)


def timing_error(scene):
    """The same for `twofold timing`, whose motion is averaged to second order in sigma = 2 C |s| I^xx / |L|^2, the torque over the rotation.

    Three times the square of sigma for what a transformation of first order leaves out of the state, its cube for each radian of rotation; and
    what is left out of a star that slows down. The motion by a bulge alone is exact: with one each sigma but the first is sigma + 2 b |s| I^xx.
    """
    ratio = scene.inertia_zz / scene.inertia_xx
    momentum = np.linalg.norm(np.array([1, 1, ratio]) * scene.omega)
    s = np.abs(np.linalg.eigvalsh(scene.tensor)).max()
    sigma = 2 * scene.c / scene.inertia_xx * s / momentum**2
    both = sigma + 2 * scene.bulge * scene.inertia_xx * s
    span = abs(scene.end - scene.start)
    braked = Torque(scene).left_out(scene, span, sigma) if "spin_down" in scene.document else 0.0
    return state_error(scene) + 3 * sigma * both + sigma * both**2 * momentum * span + braked


def tables(compute, scene, error=None):
    """`compute(scene, numerics)` gives {output: (separator, rows)}; this adds the tolerances of the columns."""
    error = state_error(scene) if error is None else error
    nominal, other, shifted = compute(scene, FINE), compute(scene, OTHER), compute(moved(scene), FINE)
    outputs = {}
    for name, (separator, rows) in nominal.items():
        tolerances = _tolerances(rows, other[name][1], shifted[name][1], error)
        if name.endswith(".par"):
            # Its lines have nothing in common: each has its own tolerances.
            lines = zip(rows, other[name][1], shifted[name][1], strict=True)
            tolerances = [_tolerances([row], [row_2], [row_3], error) for row, row_2, row_3 in lines]
        for k, title in enumerate(rows[0]):
            if title in DELAYS:
                tolerances[k] += float(f"{FACTOR * error / Motion(scene, scene.start, scene.start).turning:.2e}")
        outputs[name] = {"separator": separator, "rows": _plain(rows), "tolerances": tolerances}
    return outputs


def _tolerances(rows, other, shifted, error):
    if [len(row) for row in rows] != [len(row) for row in other] or len(rows) != len(shifted):
        raise ValueError("a table changes its shape with the numerics, or with numbers moved by 1e-7")
    width = max(map(len, rows))
    numerics, change, size = np.zeros(width), np.zeros(width), np.zeros(width)
    for row, row_2, row_3 in zip(rows, other, shifted, strict=True):
        for k, cell in enumerate(row):
            if isinstance(cell, (float, np.floating)):
                numerics[k] = max(numerics[k], abs(row_2[k] - cell))
                change[k] = max(change[k], abs(row_3[k] - cell))
                size[k] = max(size[k], abs(cell))
            elif cell != row_2[k] or cell != row_3[k]:
                raise ValueError(f"a text or a number that is counted changes: {cell!r} {row_2[k]!r} {row_3[k]!r}")
    return [float(f"{t:.2e}") for t in FACTOR * (numerics + change / MOVE * error) + 4 * 2.2e-16 * size]


def _plain(rows):
    """Plain numbers, texts and doubles; an empty text for None."""
    plain = {str: str, int: int, float: float, np.float64: float, np.int64: int, type(None): lambda _: ""}
    return [[plain[type(cell)](cell) for cell in row] for row in rows]


def write(path, answer):
    """One file of answers: a scene, its changed keys, commands with their outputs."""
    text = json.dumps(answer, indent=1)
    # A row of a table or a list of numbers is put on one line.
    text = re.sub(r"\[\s+([^\[\]{}]*?)\s+\]", lambda found: "[" + re.sub(r"\s*\n\s*", " ", found[1]) + "]", text)
    path.write_text(text + "\n")


def differences(kept, anew):
    """Sentences about differences of `anew` from `kept` above the tolerances; both as read from files."""
    if [c["arguments"] for c in kept["commands"]] != [c["arguments"] for c in anew["commands"]]:
        return ["other commands"]
    found = []
    for old, new in zip(kept["commands"], anew["commands"], strict=True):
        for name, table in old["outputs"].items():
            where = f"{' '.join(old['arguments'])}: {name}"
            other = new["outputs"][name]
            if isinstance(table, list):
                found += [] if table == other else [f"{where}: {table} is kept, {other} found"]
                continue
            if [len(row) for row in table["rows"]] != [len(row) for row in other["rows"]]:
                found.append(f"{where}: a table of another shape")
                continue
            for line, (row, row_2) in enumerate(zip(table["rows"], other["rows"], strict=True)):
                tolerances = table["tolerances"]
                tolerances = tolerances[line] if isinstance(tolerances[0], list) else tolerances
                for k, (a, b) in enumerate(zip(row, row_2, strict=True)):
                    same = abs(a - b) <= tolerances[k] if isinstance(a, float) and isinstance(b, float) else a == b
                    if not same:
                        found.append(f"{where}: row {line}, column {k}: {a!r} is kept, {b!r} found")
    return found
