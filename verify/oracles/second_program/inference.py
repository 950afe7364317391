"""The output of `twofold fisher`, `fit` and `forecast`: derivatives of the data by differences, sigma and correlations from their singular values."""

import csv
import dataclasses

import numpy as np

from columns import motion_over_times
from models import ANGLES, RATES, UNKNOWNS, Model, Signals
from motion import FINE
from pulses import pulses
from scene import Scene

OF_PULSES = "eps spin s_axial s_asymmetry alpha beta gamma alpha_rate beta_rate chi rho theta_o phi_o".split()
OF_STRAIN = "eps spin s_axial s_asymmetry alpha beta alpha_rate beta_rate theta_o phi_o".split()
TIMES = ("arrivals", "closest_approaches", "widths", "periods")
KINDS = ("arrivals", "closest_approaches", "widths", "periods", "h_plus", "h_cross")

# Sixth order: central differences over one, two and three steps, extrapolated.
OFFSETS = np.array([-3, -2, -1, 1, 2, 3])
WEIGHTS = np.array([-1, 9, -45, 45, -9, 1]) / 60
# Change of a datum in one step, relative to its scale.
MOVE = 1e-3
# Singular values of columns of unit length below this are zero: differences are good to about 1e-10.
LEAST = 1e-7


@dataclasses.dataclass
class Pulse:
    """A complete pulse, in t_c from the start: approximate times of beginning, end and closest approach, and its turn."""

    turn: int
    start: float
    end: float
    closest: float


@dataclasses.dataclass
class Measurement:
    """A measurement: pairs of a kind and its standard deviation (times in t_c), pulses, and times of samples."""

    noise: list
    pulses: list
    samples: np.ndarray

    def data(self, signals):
        """All data in units of their errors, one row per model."""
        start = signals.edges([pulse.start for pulse in self.pulses])
        end = signals.edges([pulse.end for pulse in self.pulses])
        middle = (start + end) / 2
        turns = np.array([pulse.turn for pulse in self.pulses], int)
        next_turn = np.flatnonzero(np.diff(turns) == 1) + 1
        found = {"arrivals": middle, "widths": end - start, "periods": middle[:, next_turn] - middle[:, next_turn - 1]}
        if "closest_approaches" in dict(self.noise):
            found["closest_approaches"] = signals.closest_approaches([pulse.closest for pulse in self.pulses])
        found["h_plus"], found["h_cross"] = signals.strain(self.samples)
        return np.concatenate([found[kind] / sigma for kind, sigma in self.noise], axis=1)

    def scales(self, model, numerics):
        """The scale of each datum: a radian of rotation, or the largest strain; in units of the errors."""
        signals = Signals([model], numerics)
        largest = np.abs(signals.strain(self.samples)).max() if len(self.samples) else 1.0
        scales = {kind: signals.turn / (2 * np.pi) if kind in TIMES else largest for kind in KINDS}
        counts = self.counts()
        return np.concatenate([np.full(counts[kind], scales[kind] / sigma) for kind, sigma in self.noise])

    def counts(self):
        """Number of data of each kind."""
        turns = [pulse.turn for pulse in self.pulses]
        periods = sum(b == a + 1 for a, b in zip(turns, turns[1:]))
        return {kind: periods if kind == "periods" else len(turns) if kind in TIMES else len(self.samples) for kind in KINDS}


def noise(observe, time_unit):
    """Kinds and standard deviations of `--observe`, times in t_c."""
    found = []
    for part in observe.split(","):
        name, sigma = part.split(":")
        kinds = ["h_plus", "h_cross"] if name == "strain" else [name]
        found += [(kind, float(sigma) / (time_unit if kind in TIMES else 1.0)) for kind in kinds]
    return found


def whole_pulses(scene, numerics):
    """Every complete pulse of the first beam in the span of the scene, in t_c from the start."""
    found = []
    for row in pulses(motion_over_times(scene, numerics))[1:]:
        if row[0] == 1 and row[6] == "":
            start, end, closest = ((row[k] - scene.start) / scene.time_unit for k in (2, 3, 9))
            found.append(Pulse(row[8], start, end, closest))
    return found


def alone(found):
    """The pulses that are alone in their turn."""
    turns = [pulse.turn for pulse in found]
    return [pulse for pulse in found if turns.count(pulse.turn) == 1]


def measurement(scene, observe, numerics):
    """The data that `--observe` selects for a scene: all pulses, and the strain at its samples."""
    kinds = noise(observe, scene.time_unit)
    sees_pulses = any(kind in TIMES for kind, _ in kinds)
    sees_strain = any(kind not in TIMES for kind, _ in kinds)
    samples = (scene.times - scene.start) / scene.time_unit if sees_strain else np.array([])
    return Measurement(kinds, alone(whole_pulses(scene, numerics)) if sees_pulses else [], samples)


def parameters(names, kinds):
    """The requested unknowns, or those that such data determine."""
    if names == "all":
        return UNKNOWNS
    if names:
        return names.split(",")
    return OF_PULSES if any(kind in TIMES for kind, _ in kinds) else OF_STRAIN


def jacobian(model, unknowns, measured, numerics):
    """Derivatives of the data in units of their errors, by differences of recomputed signals; also the data themselves."""
    scales = measured.scales(model, numerics)
    tiny = 1e-6
    data = measured.data(Signals([model, *(model.moved({u: tiny}) for u in unknowns)], numerics))
    steps, seen = [], []
    for unknown, moved in zip(unknowns, data[1:]):
        slope = np.abs((moved - data[0]) / scales).max() / tiny
        seen.append(slope > 1e-6)
        largest = 5e-4 if unknown in ANGLES else 0.02
        steps.append(min(MOVE * numerics.rotation / max(slope, 1e-30), largest))
    neighbours = [model.moved({u: k * step}) for u, step in zip(unknowns, steps) for k in OFFSETS]
    data = measured.data(Signals([model, *neighbours], numerics))
    moved = data[1:].reshape(len(unknowns), len(OFFSETS), -1)
    # An unknown without effect gets a column of zeros, not of rounding.
    weight = np.array(seen) / np.array(steps)
    return (np.einsum("k,uki->ui", WEIGHTS, moved) * weight[:, None]).T, data[0]


def covariance(jacobian):
    """(J^T J)^-1 with NaN for undetermined unknowns, from the singular values of columns of unit length."""
    lengths = np.linalg.norm(jacobian, axis=0)
    lengths[lengths == 0] = 1.0
    _, values, rows = np.linalg.svd(jacobian / lengths, full_matrices=True)
    values = np.concatenate([values, np.zeros(len(lengths) - len(values))])
    lost = values < LEAST
    free = (np.abs(rows[lost]) > 1e-5).any(axis=0)
    half = rows[~lost].T / values[~lost] / lengths[:, None]
    found = half @ half.T
    found[free], found[:, free] = np.nan, np.nan
    return found


def table(model, scene, unknowns, covariance):
    """The rows of `--out`: value, sigma, unit and correlations of each unknown."""
    sigma = np.sqrt(np.diag(covariance))
    correlation = covariance / np.outer(sigma, sigma)
    rows = [["parameter", "value", "sigma", "unit", *(f"correlation_{u}" for u in unknowns)]]
    for k, unknown in enumerate(unknowns):
        rate = unknown in RATES
        unit = f"rad/{scene.unit}" if rate else "rad" if unknown in ANGLES else "1"
        factor = 1 / scene.time_unit if rate else 1.0
        numbers = [model.value(unknown) * factor, sigma[k] * factor, *correlation[k]]
        value, sigma_k, *others = [None if np.isnan(x) else float(x) for x in numbers]
        rows.append([unknown, value, sigma_k, unit, *others])
    return rows


def fisher(scene, numerics, observe, names=None):
    """The model of a scene, its unknowns, and the derivatives of the observables of `twofold fisher`."""
    measured, model = measurement(scene, observe, numerics), Model.of(scene)
    unknowns = parameters(names, measured.noise)
    return model, unknowns, jacobian(model, unknowns, measured, numerics)[0]


def epochs(end, count, turn, found):
    """The epochs of a forecast over the time `end`, and the indices in `found`, all complete pulses, of the corresponding pulses."""
    times = np.arange(count) * max(end - 2.2 * turn, 0.0) / max(count - 1, 1)
    chosen = []
    for time in times:
        until = min(time + 2.2 * turn, end)
        after = [k for k, pulse in enumerate(found) if pulse.start > time and pulse.end < until]
        if after and not (chosen and abs(found[after[0]].closest - found[chosen[-1]].closest) < 0.25 * turn):
            chosen.append(after[0])
    return times, chosen


def _spanning(scene, span):
    """The scene with another span."""
    return Scene({**scene.document, "time": {"start": scene.start, "span": span, "samples": 2}})


def forecast(scene, numerics, observe, target, names, spans, counts):
    """The header of `twofold forecast --out`; for each row span, epochs and number of different data; and the derivatives behind its sigma."""
    scene = _spanning(scene, max(spans))
    kinds, model, unit = noise(observe, scene.time_unit), Model.of(scene), scene.time_unit
    unknowns = parameters(names, kinds)
    found = whole_pulses(scene, numerics) if any(kind in TIMES for kind, _ in kinds) else []
    turn = Signals([dataclasses.replace(model, end=0.0)], numerics).turn
    asked = {(span, count): epochs(span / unit, count, turn, found) for span in spans for count in counts}
    # One Jacobian for all pulses and all epochs; each forecast takes its rows.
    sees_strain = any(kind not in TIMES for kind, _ in kinds)
    samples = np.concatenate([times for times, _ in asked.values()]) if sees_strain else np.array([])
    slopes, _ = jacobian(model, unknowns, Measurement(kinds, found, samples), numerics)
    blocks = np.split(slopes, np.cumsum([len(found) if kind in TIMES else len(samples) for kind, _ in kinds])[:-1])
    name = f"rad/{scene.unit}" if target in RATES else "rad" if target in ANGLES else "1"
    header, rows, parts, before = [f"span [{scene.unit}]", "epochs", "data of each", f"sigma_{target} [{name}]"], [], [], 0
    for (span, count), (_, chosen) in asked.items():
        of_epochs = list(range(before, before + count))
        before += count
        rows.append([float(span), count, len(chosen) if found else count])
        parts.append(np.concatenate([block[chosen if kind in TIMES else of_epochs] for (kind, _), block in zip(kinds, blocks)]))
    return header, rows, parts


def sigma_of(scene, slopes, unknowns, target):
    """The standard deviation of an unknown in the unit of the output; None if there are fewer data than unknowns."""
    if len(slopes) < len(unknowns):
        return None
    place = unknowns.index(target)
    return float(np.sqrt(covariance(slopes)[place, place]) / (scene.time_unit if target in RATES else 1.0))


def read_data(path, scene):
    """From a table of pulses or of strains: times of samples, pulses, and the values of each kind, times in t_c. Periods are not read."""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    unit = scene.unit

    def time(row, name):
        return (float(row[f"{name} [{unit}]"]) - scene.start) / scene.time_unit

    if "turn" not in rows[0]:
        samples = np.array([time(row, "t") for row in rows])
        values = {kind: np.array([float(row[f"{kind} [1]"]) for row in rows]) for kind in ("h_plus", "h_cross")}
        return samples, [], values
    rows = [row for row in rows if row["beam"] == "1" and row["turn"]]
    turns = [int(row["turn"]) for row in rows]
    turn = Signals([dataclasses.replace(Model.of(scene), end=0.0)], FINE).turn
    # Pulses of the first turn may be cut in another model.
    rows = [row for row, t in zip(rows, turns) if turns.count(t) == 1 and time(row, "midpoint") >= turn]
    found = []
    for row in rows:
        half = float(row[f"duration [{unit}]"]) / scene.time_unit / 2
        middle = time(row, "midpoint")
        found.append(Pulse(int(row["turn"]), middle - half, middle + half, time(row, "closest_approach")))
    middles = np.array([(pulse.start + pulse.end) / 2 for pulse in found])
    values = {
        "arrivals": middles,
        "widths": np.array([pulse.end - pulse.start for pulse in found]),
        "closest_approaches": np.array([pulse.closest for pulse in found]),
    }
    return np.array([]), found, values


def simulated(scene, observe, names, seed):
    """Tables of a measurement of a star close to the scene: pulses and strains with normal errors, as `twofold fit` reads them.

    The star differs by a draw of twice the standard deviations with their correlations.
    """
    random = np.random.Generator(np.random.PCG64(seed))
    measured, start = measurement(scene, observe, FINE), Model.of(scene)
    unknowns = parameters(names, measured.noise)
    spread = covariance(jacobian(start, unknowns, measured, FINE)[0])
    scale = np.sqrt(np.diag(spread))
    values, axes = np.linalg.eigh(spread / np.outer(scale, scale))
    change = 2 * scale * (axes @ (np.sqrt(values) * random.standard_normal(len(scale))))
    signals = Signals([start.moved(dict(zip(unknowns, change)))], FINE)
    errors = {kind: sigma * random.standard_normal(measured.counts()[kind]) for kind, sigma in measured.noise}
    tables = {}
    unit, factor = scene.unit, scene.time_unit

    def time(value):
        return repr(float(value * factor + scene.start))

    if measured.pulses:
        first, last = (signals.edges([getattr(p, edge) for p in measured.pulses])[0] for edge in ("start", "end"))
        closest = signals.closest_approaches([p.closest for p in measured.pulses])[0]
        rows = [["beam", "turn", *(f"{n} [{unit}]" for n in ("midpoint", "duration", "closest_approach", "period"))]]
        middle = (first + last) / 2 + errors.get("arrivals", 0.0)
        width, closest = last - first + errors.get("widths", 0.0), closest + errors.get("closest_approaches", 0.0)
        for pulse, *numbers in zip(measured.pulses, middle, width, closest):
            m, w, c = numbers
            rows.append(["1", str(pulse.turn), time(m), repr(float(w * factor)), time(c), ""])
        tables["pulses"] = rows
    if len(measured.samples):
        plus, cross = (h[0] + errors.get(kind, 0.0) for h, kind in zip(signals.strain(measured.samples), ("h_plus", "h_cross")))
        rows = [[f"t [{unit}]", "h_plus [1]", "h_cross [1]"]]
        rows += [[repr(float(t)), repr(float(p)), repr(float(c))] for t, p, c in zip(scene.times, plus, cross)]
        tables["strain"] = rows
    return tables


def fit(scene, numerics, observe, names, files):
    """The model at the least chi^2, the measurement, the unknowns, the derivatives, chi^2 and the number of data."""
    kinds = noise(observe, scene.time_unit)
    samples, found, values = np.array([]), [], {}
    for path in files:
        more_samples, more, more_values = read_data(path, scene)
        samples, found, values = np.concatenate([samples, more_samples]), found + more, {**values, **more_values}
    measured = Measurement(kinds, found, samples)
    unknowns = parameters(names, kinds)
    data = np.concatenate([values[kind] / sigma for kind, sigma in kinds])
    best, slopes = Model.of(scene), None
    # Gauss-Newton steps, with the derivatives at the start and then at the improved point.
    for _ in range(2):
        slopes, _ = jacobian(best, unknowns, measured, numerics)
        for _ in range(20):
            residuals = measured.data(Signals([best], numerics))[0] - data
            scale = np.linalg.norm(slopes, axis=0)
            step = np.linalg.lstsq(slopes / scale, -residuals)[0] / scale
            best = best.moved(dict(zip(unknowns, step)))
            if np.abs(slopes @ step).max() < 1e-7:
                break
        else:
            raise ArithmeticError("the fit does not converge")
    return best, measured, unknowns, slopes, float(residuals @ residuals), len(data)
