"""Answers for the commands of many scenes and of data: `sweep`, `fisher`, `fit`, `forecast`, `bounds` and `limits`.

Here each row of a table has its own tolerances, since the rows are of different unknowns. Files are named from `{here}`, this folder.
"""

import functools
import json
import pathlib

import numpy as np

import bounds
import inference
import limits
import sweep
from answers import FACTOR, MOVE, _plain, _tolerances, moved, state_error
from motion import FINE, OTHER
from scene import Scene

HERE = pathlib.Path(__file__).parent
MEASUREMENTS = json.loads((HERE / "measurements.json").read_text())
LIMITS = json.loads((HERE / "limits.json").read_text())
ROUNDING = 2.2e-16
# Error that the command states for its integrals over directions and over the angle to the line of sight.
QUADRATURE = 1e-9
# Accuracy of a fit in standard deviations, and the digits of a forecast.
FIT_ENDS, FORECAST_DIGITS = 0.01, 0.5e-6
# Stated error of the derivatives of the timing model.
TIMING_DERIVATIVES = 1e-13
DRAWS = 16


def _table(rows, tolerances):
    """A table of comma-separated values with the tolerances of its cells."""
    return {"separator": ",", "rows": _plain(rows), "tolerances": [[_rounded(t) for t in row] for row in tolerances]}


def _rounded(tolerance):
    return float(f"{tolerance:.2e}")


def noisy(slopes, other, stated):
    """Derivatives with errors: the differences with other numerics, and the errors that the command states, relative to the largest of each column.

    A difference can be small by chance: errors are drawn with the largest of each column as their standard deviation.
    """
    random = np.random.Generator(np.random.PCG64(1))
    size = np.abs(other - slopes).max(axis=0) + stated * np.abs(slopes).max(axis=0)
    return [slopes + size * random.standard_normal(slopes.shape) for _ in range(DRAWS)]


def _cells(rows, others, one=1.0, roundings=50):
    """Tolerances of cells: `FACTOR` times the root mean square of the changes in `others`, and rounding in units of the number or, for a value, of
    `one`."""
    found = []
    for line, row in enumerate(rows):
        tolerances = []
        for k, cell in enumerate(row):
            if isinstance(cell, float):
                spread = np.sqrt(np.mean([(other[line][k] - cell) ** 2 for other in others]))
                tolerances.append(FACTOR * spread + roundings * ROUNDING * max(one if k == 1 else 0.0, abs(cell)))
            elif any(other[line][k] != cell for other in others):
                raise ValueError(f"a text or an empty field changes: {cell!r}")
            else:
                tolerances.append(0.0)
        found.append(tolerances)
    return found


def stated(scene):
    """Error that the command states for derivatives of a motion: twenty times the error of a state."""
    return 20 * state_error(scene)


def _ended_off(tolerances, rows, ended):
    """Tolerances plus the change between the places at which a fit may end."""
    return [
        [t + abs(y - x) if isinstance(x, float) else t for t, x, y in zip(line, row, row_2, strict=True)]
        for line, row, row_2 in zip(tolerances, rows, ended, strict=True)
    ]


def of_sweep(name):
    """A sweep: tolerances of columns as for a single scene, for the worst of its scenes."""
    path = HERE / "sweeps" / f"{name}.toml"
    scenes = [scene for _, scene in sweep.scenes(path)]
    error = max(map(state_error, scenes))
    rows = sweep.table(path, FINE)
    tolerances = _tolerances(rows, sweep.table(path, OTHER), sweep.table(path, FINE, moved), error)
    momentum = max(np.linalg.norm(s.omega) * max(s.inertia_xx, s.inertia_zz) for s in scenes)
    inertia, tensor = min(s.inertia_xx for s in scenes), max(np.abs(s.tensor).max() for s in scenes)
    cgs, spin = scenes[0].cgs, max(abs(s.spin) for s in scenes)
    # Quantities that vanish in an exact motion: the error of the state in their units.
    sizes = {
        "error_estimate": 1.0, "e_z_length_error": 1.0, "E_error": momentum**2 / inertia * cgs, "Omega_z_error": spin,
        "K_error": momentum**2 * tensor * cgs**2,
    }  # fmt: skip
    status = rows[0].index("status")
    for k, title in enumerate(rows[0]):
        largest = max(abs(row[k]) for row in rows[1:]) if title != "status" else 0.0
        start = title.split("@")[0]
        if start in sizes:
            tolerances[k] = _rounded(FACTOR * error * sizes[start])
        elif title == "lambda_mean [rad]":
            tolerances[k] += QUADRATURE
        elif 0 < k < status:
            # Edges of the ziggurat are sums in doubles.
            tolerances[k] = _rounded(1e-14 * largest)
    arguments = ["sweep", f"{{here}}/sweeps/{name}.toml", "--out", "{out}/table.csv"]
    outputs = {"table.csv": {"separator": ",", "rows": _plain(rows), "tolerances": [tolerances] * len(rows)}}
    return [{"arguments": arguments, "outputs": outputs}]


def _arguments(case, path):
    named = ["--parameters", case["parameters"]] if "parameters" in case else []
    return [case["command"], path, "--observe", case["observe"], *named, "--out", "{out}/table.csv"]


def of_measurement(number):
    """`fisher`, `fit` or `forecast` of one scene."""
    case = MEASUREMENTS[number]
    scene = Scene.read(HERE / "measurements" / f"{case['scene']}.toml")
    observe, names = case["observe"], case.get("parameters")
    arguments = _arguments(case, f"{{here}}/measurements/{case['scene']}.toml")
    if case["command"] == "fit":
        return [_fit(case, scene, arguments)]
    if case["command"] == "fisher":
        model, unknowns, slopes = inference.fisher(scene, FINE, observe, names)
        other = inference.fisher(scene, OTHER, observe, names)[-1]
        rows, *others = (
            inference.table(model, scene, unknowns, inference.covariance(j)) for j in (slopes, *noisy(slopes, other, stated(scene)))
        )
        return [{"arguments": arguments, "outputs": {"table.csv": _table(rows, _cells(rows, others))}}]
    target, spans, counts = case["of"], case["spans"], case["epochs"]
    arguments += ["--of", target, "--spans", ",".join(map(repr, spans)), "--epochs", ",".join(map(str, counts))]
    unknowns = inference.parameters(names, inference.noise(observe, scene.time_unit))
    header, rows, parts = inference.forecast(scene, FINE, observe, target, names, spans, counts)
    _, _, others = inference.forecast(scene, OTHER, observe, target, names, spans, counts)
    tolerances = [[0.0] * 4]
    for row, slopes, other in zip(rows, parts, others, strict=True):
        sigma, *noise = (inference.sigma_of(scene, j, unknowns, target) for j in (slopes, *noisy(slopes, other, stated(scene))))
        row.append(sigma)
        spread = 0.0 if sigma is None else FACTOR * np.sqrt(np.mean((np.array(noise) - sigma) ** 2)) + FORECAST_DIGITS * sigma
        tolerances.append([0.0, 0.0, 0.0, spread])
    return [{"arguments": arguments, "outputs": {"table.csv": _table([header, *rows], tolerances)}}]


def _fit(case, scene, arguments):
    observe, names = case["observe"], case.get("parameters")
    files = sorted(HERE.glob(f"measurements/{case['scene']}-*.csv"))
    best, measured, unknowns, slopes, chi_2, count = inference.fit(scene, FINE, observe, names, files)
    sigma = np.sqrt(np.diag(inference.covariance(slopes)))
    off = best.moved({u: FIT_ENDS * s * (-1) ** k for k, (u, s) in enumerate(zip(unknowns, sigma))})
    other, slopes_off = (inference.jacobian(best, unknowns, measured, OTHER)[0], inference.jacobian(off, unknowns, measured, FINE)[0])
    rows, *others, ended = (
        inference.table(model, scene, unknowns, inference.covariance(j))
        for model, j in [(best, slopes), *((best, j) for j in noisy(slopes, other, stated(scene))), (off, slopes_off)]
    )
    tolerances = _ended_off(_cells(rows, others), rows, ended)
    told = [f"{count} data, {len(unknowns)} unknowns, ", f"chi^2 = {chi_2:.4g} of {count - len(unknowns)} degrees of freedom"]
    data = [f"{{here}}/measurements/{path.name}" for path in files]
    outputs = {"table.csv": _table(rows, tolerances), "stderr": told}
    return {"arguments": [*arguments[:2], *data, *arguments[2:]], "outputs": outputs}


# The rows of the paper's table that follow from the others: Delta lambda, the bound over eta, and that with eta = 10.
PRINTED = [("-19", "~1e-14", "~1e-13"), ("-5.2", "~1e-15", "~1e-14"), ("1.6", "~1e-16", "~1e-15")]
OVER_ETA = ("bound_over_eta_stated", "bound_over_eta_round", "bound_over_eta_own", "limit_over_eta_by_change")
WITH_ETA = ("bound_eta_ten_stated", "bound_eta_ten_own", "limit_eta_ten_by_change", "limit_without_error", "limit")


def _printed(pulse, key):
    change, over_eta, with_eta = PRINTED[pulse]
    return {"lambda_change": change, **dict.fromkeys(OVER_ETA, over_eta), **dict.fromkeys(WITH_ETA, with_eta)}.get(key)


def of_bounds(name):
    """`twofold bounds --json`: rows with a place in the object and its content."""
    paper = name == "paper"
    path = HERE.parents[2] / "scene" / "pulsars" / "paper.toml" if paper else HERE / "bounds" / f"{name}.toml"
    table, shifted = bounds.table(path, paper), bounds.table(path, paper, MOVE)
    rows, tolerances = [], []

    def add(place, value, off=0.0):
        rows.append([place, value])
        tolerances.append([0.0, _rounded(off)])

    for p, (pulse, pulse_2) in enumerate(zip(table["pulses"], shifted["pulses"], strict=True)):
        at = f"/pulses/{p}"
        add(f"{at}/name", pulse["name"])
        add(f"{at}/source", pulse["source"])
        add(f"{at}/change_is", "measured" if pulse["measured"] else "a limit")
        for f, (figure, figure_2) in enumerate(zip(pulse["figures"], pulse_2["figures"], strict=True)):
            key, where = figure[0], f"{at}/figures/{f}"
            add(f"{where}/figure", key)
            integral = "limit" in key or key == "eta"
            for word, x, x_2 in zip(("value", "uncertainty_by_change", "uncertainty_by_inputs"), figure[1:], figure_2[1:]):
                off = 0.0
                if x is not None:
                    off = FACTOR * ROUNDING * abs(x_2 - x) / MOVE + (4 * ROUNDING + QUADRATURE * integral) * abs(x)
                add(f"{where}/{word}", x, off)
                if word == "value":
                    value, value_off = x, off
            printed = _printed(p, key) if paper else None
            add(f"{where}/printed", printed)
            over = None if printed is None else float(printed.strip("~"))
            add(f"{where}/over_printed", over and value / over, value_off / abs(over or 1.0) + 4 * ROUNDING * abs(value / (over or 1.0)))
    chosen = table["recommended"]
    limits = {key: value for key, value, *_ in chosen["figures"]}
    add("/confidence", bounds.CONFIDENCE)
    add("/recommended/confidence", bounds.CONFIDENCE)
    add("/recommended/pulse", chosen["name"])
    add("/recommended/source", chosen["source"])
    for word, key in (("limit", "limit"), ("limit_without_error", "limit_without_error"), ("alpha_2", "alpha_2_limit")):
        value = limits.get(key)
        add(f"/recommended/{word}", value, 0.0 if value is None else 2 * QUADRATURE * abs(value))
    arguments = ["bounds", *([] if paper else [f"{{here}}/bounds/{name}.toml"]), "--json"]
    return [{"arguments": arguments, "outputs": {"stdout": {"separator": "json", "rows": _plain(rows), "tolerances": tolerances}}}]


def of_limits(name):
    """`twofold limits` of one scene and its data."""
    case, path = LIMITS[name], HERE / "limits" / name
    start, data = limits.read(path, case)
    unknowns = case["parameters"].split(",")
    best, data, residuals = limits.fit(start, data, unknowns)
    slopes, other = (limits.jacobian(best, data, unknowns, move) for move in limits.MOVES)
    spread = inference.covariance(slopes)
    sigma = np.sqrt(np.diag(spread))
    off = limits.moved(best, {u: FIT_ENDS * s * (-1) ** k for k, (u, s) in enumerate(zip(unknowns, sigma))})
    files = [f"{{here}}/limits/{name}.{kind}" for kind, key in (("tim", "arrivals"), ("csv", "widths")) if key in case]
    arguments = ["limits", f"{{here}}/limits/{name}.toml", *files, "--parameters", case["parameters"], "--out", "{out}/table.csv"]
    arguments += ["--observe", f"widths:{case['widths']!r}"] if "widths" in case else []
    for key, (mean, deviation) in case.get("priors", {}).items():
        arguments += ["--prior", f"{key}:{mean!r}:{deviation!r}"]
    chi_2, degrees = residuals @ residuals, len(residuals) - len(unknowns)
    outputs = {"stderr": [f"chi^2 = {chi_2:#.4g} of {degrees} degrees of freedom"]}
    if "periods" in case:
        first, last, count = case["periods"]
        arguments += ["--periods", f"{first!r}:{last!r}:{count}"]
        periods = np.geomspace(first, last, count)
        rows, *others = (
            limits.wobble_limits(model, data, unknowns, periods, move)
            for model, move in ((best, limits.MOVES[0]), (best, limits.MOVES[1]), (off, limits.MOVES[0]))
        )
        # The table of the fit is not written in this case.
        return [{"arguments": arguments, "outputs": outputs | {"table.csv": _table(rows, _cells(rows, others, 0.0, 4))}}]
    ended = limits.table(off, unknowns, inference.covariance(limits.jacobian(off, data, unknowns, limits.MOVES[0])))
    rows, *others = (
        limits.table(best, unknowns, inference.covariance(j)) for j in (slopes, *noisy(slopes, other, TIMING_DERIVATIVES))
    )
    # Values range from 1e-25 to 2: they have no common unit.
    tolerances = _ended_off(_cells(rows, others, 0.0, 4), rows, ended)
    outputs["table.csv"] = _table(rows, tolerances)
    if "inclination_rate" in unknowns:
        outputs["stdout"] = [f"|2 s^ZZ - s^XX - s^YY| is at most {limits.limit_on_s(best, spread, unknowns):.3e} at 95 %"]
    return [{"arguments": arguments, "outputs": outputs}]


def tasks():
    """The functions that compute the answers, by file name."""
    found = {f"sweep-{path.stem}": functools.partial(of_sweep, path.stem) for path in sorted(HERE.glob("sweeps/*.toml"))}
    for number, case in enumerate(MEASUREMENTS):
        found[f"{case['command']}-{case['scene']}"] = functools.partial(of_measurement, number)
    found.update({f"limits-{name}": functools.partial(of_limits, name) for name in LIMITS})
    tables = ["paper", *(path.stem for path in sorted(HERE.glob("bounds/*.toml")))]
    found.update({f"bounds-{name}": functools.partial(of_bounds, name) for name in tables})
    return found


def write_data():
    """The data of the fits: simulated with errors of a fixed seed."""
    for case in MEASUREMENTS:
        if case["command"] == "fit":
            scene = Scene.read(HERE / "measurements" / f"{case['scene']}.toml")
            tables = inference.simulated(scene, case["observe"], case.get("parameters"), case["seed"])
            for kind, rows in tables.items():
                text = "".join(",".join(row) + "\n" for row in rows)
                (HERE / "measurements" / f"{case['scene']}-{kind}.csv").write_text(text)
    for name, case in LIMITS.items():
        limits.write_data(HERE / "limits" / name, case)
