"""The table of `twofold sweep`: the numbers of every scene of a sweep file, and its row."""

import itertools
import pathlib
import tomllib

import numpy as np
from scipy.optimize import minimize_scalar

from columns import columns, motion_over_times
from draws import draw
from pulses import pulses
from scene import Scene

BUILT_IN = pathlib.Path(__file__).parents[3] / "scene/scenes"


def read(path):
    """The sweep file, and its scene with the times of the sweep."""
    with open(path, "rb") as file:
        sweep = tomllib.load(file)
    scene = sweep["scene"]
    if isinstance(scene, str):
        near = pathlib.Path(path).parent / scene
        with open(near if near.exists() else BUILT_IN / f"{scene}.toml", "rb") as file:
            scene = tomllib.load(file)
    time = dict(sweep["time"])
    if "times" not in time and "samples" not in time:
        start = time.get("start", 0.0)
        time = {"start": start, "times": [time["end"] if "end" in time else start + time["span"]]}
    tolerance = sweep.get("output", {}).get("tolerance", scene.get("output", {}).get("tolerance", 1e-13))
    return sweep, Scene({**scene, "time": time, "output": {"tolerance": tolerance}})


def points(vary):
    """The numbers of a list or a grid."""
    if "values" in vary:
        return [float(value) for value in vary["values"]]
    grid = vary["grid"]
    first, last, count = grid["from"], grid["to"], grid["points"]
    if grid.get("scale") == "log":
        return np.geomspace(first, last, count).tolist()
    return np.linspace(first, last, count).tolist()


def numbers_of_scenes(sweep):
    """For each scene, from 0 on, a number for each varied key."""
    axes, places, randoms = [], [], 0
    named = {}
    for vary in sweep["vary"]:
        if "random" in vary:
            places.append(("random", randoms, vary["random"]))
            randoms += 1
            continue
        name = vary.get("together")
        axis = named.get(name, len(axes)) if name is not None else len(axes)
        if axis == len(axes):
            axes.append(range(len(points(vary))))
            if name is not None:
                named[name] = axis
        places.append(("axis", axis, points(vary)))
    if randoms:
        axes.append(range(sweep["draws"]))
    scenes = []
    for number, at in enumerate(itertools.product(*axes)):
        scenes.append([
            values[at[place]] if kind == "axis" else draw(values, sweep["seed"], place, number)
            for kind, place, values in places
        ])  # fmt: skip
    return scenes


def angle_to_observer(motion):
    """Least, largest and mean angle between the symmetry axis and the direction to the observer over the span."""
    scene = motion.scene
    first, last = min(scene.start, scene.end), max(scene.start, scene.end)
    direction = scene.observer.direction

    def angle(times):
        n = motion.axes(times)[:, 2]
        return np.arctan2(np.linalg.norm(np.cross(direction, n), axis=1), n @ direction)

    count = int((last - first) * motion.turning * 20) + 2
    times = np.linspace(first, last, count)
    at = angle(times)
    found = []
    for sign in (1, -1):
        best = sign * at
        near = [k for k in range(1, count - 1) if best[k] <= best[k - 1] and best[k] <= best[k + 1]]
        # Only candidates for the smallest of all.
        near = [k for k in near if best[k] < best.min() + 0.02]
        least = [best[0], best[-1]]
        for k in near:
            inside = minimize_scalar(lambda t, sign=sign: sign * angle([t])[0], bounds=(times[k - 1], times[k + 1]), method="bounded",
                                     options={"xatol": 1e-9 / motion.turning})  # fmt: skip
            least.append(inside.fun)
        found.append(sign * min(least))
    nodes, weights = np.polynomial.legendre.leggauss(16)
    panels = np.linspace(first, last, int((last - first) * motion.turning * 2) + 2)
    middle, half = (panels[1:] + panels[:-1]) / 2, np.diff(panels) / 2
    integral = 0.0
    for _ in range(20):
        times = middle[:, None] + half[:, None] * nodes
        inside = angle(times.ravel()).reshape(times.shape)
        # Near the line of sight the angle bends sharply: panels are halved there.
        near = np.minimum(inside, np.pi - inside).min(axis=1) < half * motion.turning
        integral += np.sum(inside[~near] * weights * half[~near, None])
        if not near.any():
            break
        quarter = half[near] / 2
        middle, half = np.concatenate([middle[near] - quarter, middle[near] + quarter]), np.tile(quarter, 2)
    else:
        integral += np.sum(angle(middle) * 2 * half)
    return [*found, integral / (last - first)]


def slow_precession(scene):
    """The principal axis that L circles, and the rate about its end on the side of L, from the averaged motion of first order at the start.

    With l = L/G and c = n.l the motion is dl/dt = (2 C P2(c) / G) (s l) x l; its period is an integral over the azimuth about the axis.
    """
    body = scene.omega * np.array([scene.inertia_xx, scene.inertia_xx, scene.inertia_zz])
    momentum = body @ scene.axes
    size = np.linalg.norm(momentum)
    values, vectors = np.linalg.eigh(scene.tensor)
    l = vectors.T @ momentum / size
    h = values @ (l * l)
    axis = 2 if h > values[1] else 0
    one, two = values[(axis + 1) % 3], values[(axis + 2) % 3]
    cosine = scene.axes[2] @ momentum / size
    kappa = scene.c * (3 * cosine**2 - 1) / size
    azimuth = np.arange(400) * (2 * np.pi / 400)
    off = values[axis] - one * np.cos(azimuth) ** 2 - two * np.sin(azimuth) ** 2
    along = np.sqrt(1 - (values[axis] - h) / off)
    period = np.mean(1 / (kappa * along * off)) * 2 * np.pi
    return [float(3 - axis), 2 * np.pi / period]


def row(scene, numerics, groups, summaries):
    """Names and values of the columns of one scene; at each time, then over the span."""
    motion = motion_over_times(scene, numerics)
    wanted = [group for group in groups if group != "errors"]
    table = columns(motion, wanted)[1:]
    unit = scene.unit
    momentum_unit, energy_unit = ("g cm^2/s", "erg") if scene.physical else ("I_xx/t_c", "C")
    found = []
    for k, time in enumerate(scene.times):
        found += [(_at(name, time), values[k]) for name, values in table]
        if "errors" in groups:
            # An exact motion has none.
            names = ["error_estimate [1]", "e_z_length_error [1]", f"E_error [{energy_unit}]", f"Omega_z_error [rad/{unit}]"]
            found += [(_at(name, time), 0.0) for name in [*names, f"K_error [({momentum_unit})^2]"]]
    for summary in summaries:
        if summary == "lambda":
            names = ["lambda_least [rad]", "lambda_largest [rad]", "lambda_mean [rad]"]
            found += zip(names, angle_to_observer(motion), strict=True)
        elif summary == "pulses":
            found.append(("pulses [1]", float(len(pulses(motion)) - 1)))
        else:
            names = ["slow_precession_axis [1]", f"slow_precession_rate [rad/{unit}]"]
            found += zip(names, slow_precession(scene), strict=True)
    return found


def _at(name, time):
    name, unit = name.split(" ", 1)
    return f"{name}@{float(time)!r} {unit}"


def scenes(path):
    """The numbers and the scene of each row."""
    sweep, base = read(path)
    keys = [vary["parameter"] for vary in sweep["vary"]]
    return [(numbers, base.changed(dict(zip(keys, numbers, strict=True)))) for numbers in numbers_of_scenes(sweep)]


def table(path, numerics, change=lambda scene: scene):
    """The table, header first; `change` is applied to each scene."""
    sweep, _ = read(path)
    output = sweep.get("output", {})
    groups, summaries = output.get("columns", ["e_z", "L", "errors"]), output.get("summaries", [])
    keys = [vary["parameter"] for vary in sweep["vary"]]
    rows = []
    for number, (numbers, scene) in enumerate(scenes(path)):
        found = row(change(scene), numerics, groups, summaries)
        if not rows:
            rows.append(["scene", *keys, "status", *(name for name, _ in found)])
        rows.append([number, *numbers, "ok", *(float(value) for _, value in found)])
    return rows
