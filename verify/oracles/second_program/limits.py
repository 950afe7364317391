"""The output of `twofold limits`: fits to arrival times and widths over decades, limits on a wobble by its period, the limit on s.

A star in free precession under a torque along L: its magnetic axis as a vector, the torque by the mean and the harmonics of sin^2 of that axis'
angle to L, sampled over a precession; phases in 80 bits; derivatives by differences; the posterior of a wobble summed over its phase and amplitude.
What friction changes slowly is a polynomial of time.
"""

import csv
import dataclasses
import math
import tomllib
from fractions import Fraction

import numpy as np
from numpy.polynomial import chebyshev
from scipy.optimize import brentq

import bounds
from inference import OFFSETS, WEIGHTS
from torque import SHARES

DAY = 86400
LONG = np.longdouble
TURN = 2 * LONG("3.14159265358979323846264338327950288")
UNITS = {
    "phase": "1", "f0": "Hz", "f1": "Hz/s", "f2": "Hz/s^2", "wobble": "rad", "damping": "1/s", "chi": "rad", "precession_phase": "rad",
    "precession_rate": "rad/s", "torque_share": "1", "inclination": "rad", "inclination_rate": "rad/s", "rho": "rad",
}  # fmt: skip
# Change per difference step of the datum that changes most: of a turn, of a width, of the error of a prior.
MOVES = (1e-3, 6e-4)
SAMPLES = 8
# Polynomials of time through this many of Chebyshev's points, over 7.6 years from the epoch either way: beyond all data.
POINTS, REACH = 12, LONG(2.4e8)
POINTS_AT = REACH * np.cos(TURN * (2 * np.arange(POINTS) + 1) / (4 * POINTS))
TO_COEFFICIENTS = 2 * chebyshev.chebvander(POINTS_AT / REACH, POINTS - 1).T / POINTS
TO_COEFFICIENTS[0] /= 2
CONFIDENCE = 0.95
NODES, NODE_WEIGHTS = np.polynomial.legendre.leggauss(40)


@dataclasses.dataclass
class Data:
    """Times since the epoch (s), numbers and errors of arrivals; times, durations and errors of widths; priors by parameter."""

    times: np.ndarray
    numbers: np.ndarray
    sigmas: np.ndarray
    width_times: np.ndarray
    widths: np.ndarray
    width_sigmas: np.ndarray
    priors: dict


def read_scene(path):
    """The parameters of a scene in which L is constant, and its epoch."""
    with open(path, "rb") as file:
        document = tomllib.load(file)
    star, initial, observer, pulsar = (document[key] for key in ("star", "initial", "observer", "pulsar"))
    spin_down = document.get("spin_down", {})
    values = dict.fromkeys(UNITS, 0.0)
    values |= {"f0": star["frequency"], "f1": spin_down.get("f1", 0.0), "torque_share": SHARES[spin_down.get("torque", "constant")]}
    values |= {"damping": 1 / (spin_down["damping_time"] * DAY) if "damping_time" in spin_down else 0.0}
    values |= {"wobble": initial["wobble"], "precession_phase": initial["precession_phase"]}
    values |= {"precession_rate": 2 * np.pi / (star["precession_period"] * DAY)}
    values |= {"chi": pulsar["chi"], "rho": pulsar["rho"], "inclination": observer["inclination"]}
    values = {key: LONG(repr(value)) if value else LONG(0) for key, value in values.items()}
    values["f2"] = 3 * values["f1"] ** 2 / values["f0"]
    # The azimuth of the magnetic axis about L from the line of sight, at the epoch.
    ahead = _azimuth(_magnetic_axis(values, values["precession_phase"], values["wobble"]))
    turn = (initial["azimuth"] - observer["azimuth"] + float(ahead)) / (2 * np.pi)
    mean = (ahead - TURN / 2 + values["precession_phase"]) / TURN
    values["phase"] = LONG(turn - round(turn)) - (mean - np.round(mean))
    return values, Fraction(str(document["time"]["epoch"]))


def _magnetic_axis(values, psi, theta):
    """The magnetic axis where L is along Z and n in the plane X, Z at the angle `theta` to it: `psi` is its angle about n to the projection of L."""
    (sin, cos), (sin_chi, cos_chi) = ((np.sin(angle), np.cos(angle)) for angle in (theta, values["chi"]))
    # In the body, X away from L: half a turn from the projection of L.
    x, y, z = -sin_chi * np.cos(psi), sin_chi * np.sin(psi), cos_chi
    return np.array(np.broadcast_arrays(cos * x + sin * z, y, cos * z - sin * x))


def _azimuth(axis):
    return np.arctan2(axis[1], axis[0])


def _polynomial(values, integrals=0):
    """Coefficients of the polynomial with these values at the points, or of its integral from the epoch on."""
    return chebyshev.chebint(TO_COEFFICIENTS @ values, integrals, scl=REACH)


def _at(coefficients, tau):
    return chebyshev.chebval(tau / REACH, coefficients)


class Star:
    """A star with these parameters."""

    def __init__(self, values):
        self.values = values
        psi = TURN * np.arange(SAMPLES) / SAMPLES
        theta = self.theta(POINTS_AT)
        # The factor of the torque at the points, even in psi: a mean and cosines.
        torque = 1 - values["torque_share"] * _magnetic_axis(values, psi, np.append(theta, values["wobble"])[:, None])[2] ** 2
        torque /= torque[-1].mean()
        k = self.k = np.arange(1, SAMPLES // 2)
        mean, harmonics = torque[:-1].mean(axis=1), 2 * torque[:-1] @ np.cos(k * psi[:, None]) / SAMPLES
        # By friction the wobble falls and psi gains.
        turning = values["precession_rate"] * np.cos(theta) / np.cos(values["wobble"])
        self.gained = _polynomial(turning - values["precession_rate"], 1)
        self.means = [_polynomial(mean - 1, order) for order in (1, 2)]
        # The integrals of harmonics times exp(i k psi), by parts: a times exp(i k psi), with a' + i k psi' a = harmonics.
        self.varying = []
        for _ in range(2):
            harmonics = self._integral(harmonics, 1j * k * turning[:, None])
            self.varying.append(_polynomial(harmonics))
        self.braking = -values["f1"] / values["f0"]

    @staticmethod
    def _integral(harmonics, frequencies):
        found = harmonics / frequencies
        for _ in range(4):
            slope = chebyshev.chebval(POINTS_AT / REACH, chebyshev.chebder(_polynomial(found), scl=1 / REACH)).T
            found = (harmonics - slope) / frequencies
        return found

    def theta(self, tau):
        return np.arctan(np.tan(self.values["wobble"]) * np.exp(-self.values["damping"] * tau))

    def psi(self, tau):
        return self.values["precession_phase"] + self.values["precession_rate"] * tau + _at(self.gained, tau)

    def _torque(self, tau):
        """What the varying part of the torque, and the change of its mean, add to dt/dtau, and its integral."""
        wave = np.exp(1j * self.k[:, None] * self.psi(tau))
        first, second = ((_at(varying, tau) * wave).real.sum(axis=0) for varying in self.varying)
        once, twice = (_at(mean, tau) for mean in self.means)
        return self.braking * (first + once), self.braking * (second + twice)

    def stretched(self, t):
        """tau and d tau / d t, for the index 3: dt/dtau = 1 + braking tau + torque."""
        start = self._torque(np.zeros(1, LONG))[1][0]
        tau = t.copy()
        for _ in range(30):
            rate, delay = self._torque(tau)
            step = (t - (tau + self.braking * tau * tau / 2 + delay - start)) / (1 + self.braking * tau + rate)
            tau = tau + step
            if np.abs(step).max() <= 1e-17 * max(np.abs(tau).max(), 1):
                break
        return tau, 1 / (1 + self.braking * tau + self._torque(tau)[0])

    def phase(self, t):
        """Turns at times since the epoch."""
        v = self.values
        tau, _ = self.stretched(t)
        ahead = (_azimuth(_magnetic_axis(v, self.psi(tau), self.theta(tau))) - TURN / 2 + self.psi(tau)) / TURN
        other = (v["f2"] - 3 * v["f1"] ** 2 / v["f0"]) * t**3 / 6
        # The axis turns about L as before, so that the magnetic axis loses what psi gains.
        return v["phase"] + v["f0"] * tau - _at(self.gained, tau) / TURN + (ahead - np.round(ahead)) + other

    def phase_rate(self, t, step=LONG(100)):
        """Turns per second, by differences."""
        return sum(weight * self.phase(t + k * step) for k, weight in zip(OFFSETS, WEIGHTS)) / step

    def width(self, t):
        """Time in which the line of sight is in the beam."""
        v = self.values
        tau, slowing = self.stretched(t)
        axis = _magnetic_axis(v, self.psi(tau), self.theta(tau))
        inclination = v["inclination"] + v["inclination_rate"] * t
        half = np.arccos((np.cos(v["rho"]) - axis[2] * np.cos(inclination)) / (np.hypot(axis[0], axis[1]) * np.sin(inclination)))
        return 2 * half / (TURN * v["f0"] * slowing)


def moved(values, changes):
    return {key: value + changes.get(key, 0) for key, value in values.items()}


def _predicted(values, data, rate):
    """The measured quantities in units of their errors; an arrival by its turns, at `rate` turns per second."""
    star, parts = Star(values), []
    if len(data.times):
        parts.append(-(star.phase(data.times) - data.numbers) / rate / data.sigmas)
    if len(data.widths):
        parts.append(star.width(data.width_times) / data.width_sigmas)
    parts.append(np.array([values[key] / sigma for key, (_, sigma) in data.priors.items()], LONG))
    return np.concatenate(parts)


def _rate(values, data):
    return Star(values).phase_rate(data.times) if len(data.times) else data.times


def differences(values, data):
    """Model minus data, in units of their errors."""
    measured = [np.zeros(len(data.times)), data.widths / data.width_sigmas, [mean / sigma for mean, sigma in data.priors.values()]]
    return (_predicted(values, data, _rate(values, data)) - np.concatenate(measured)).astype(float)


def jacobian(values, data, unknowns, move):
    """Derivatives of the differences, by differences of sixth order. The rate that converts turns into times is kept."""
    rate = _rate(values, data)

    def at(changes):
        return _predicted(moved(values, changes), data, rate)

    # In a step an arrival changes by a fraction of a turn, a width by a fraction of itself.
    size = np.concatenate([1 / rate / data.sigmas, data.widths / data.width_sigmas, [1 / sigma for _, sigma in data.priors.values()]])
    columns = []
    for unknown in unknowns:
        scale = {"rad": LONG(1), "1": LONG(1)}.get(UNITS[unknown], abs(values[unknown]) or LONG(1e-7))
        tiny = scale * LONG(1e-6)
        slope = np.abs((at({unknown: tiny}) - at({unknown: -tiny})) / (2 * tiny) / size).max()
        step = LONG(move) / slope
        columns.append(sum(weight * at({unknown: k * step}) for k, weight in zip(OFFSETS, WEIGHTS)) / step)
    return np.array(columns, dtype=float).T


def numbered(values, data):
    """Numbers of the pulses as counted from the start: the first of the data is the nearest."""
    if not len(data.times):
        return data
    nearest = int(np.round(Star(values).phase(data.times[:1])[0]))
    return dataclasses.replace(data, numbers=data.numbers - data.numbers[0] + nearest)


def fit(values, data, unknowns):
    """The parameters of least chi^2, and the residuals there."""
    data = numbered(values, data)
    for _ in range(50):
        residuals = differences(values, data)
        slopes = jacobian(values, data, unknowns, MOVES[0])
        scale = np.linalg.norm(slopes, axis=0)
        step = np.linalg.lstsq(slopes / scale, -residuals, rcond=None)[0] / scale
        values = moved(values, dict(zip(unknowns, step.astype(LONG))))
        if np.linalg.norm(slopes @ step) < 1e-5:
            return values, data, differences(values, data)
    raise ArithmeticError("the fit does not converge")


def table(values, unknowns, spread):
    sigma = np.sqrt(np.diag(spread))
    rows = [["parameter", "value", "sigma", "unit", *(f"correlation_{unknown}" for unknown in unknowns)]]
    for k, unknown in enumerate(unknowns):
        correlations = [float(x) for x in spread[k] / sigma[k] / sigma]
        rows.append([unknown, float(values[unknown]), float(sigma[k]), UNITS[unknown], *correlations])
    return rows


def wobble_limits(values, data, unknowns, periods, move):
    """For each period the best wobble, the gain of chi^2 and the limit, for a wobble in which the residuals are linear."""
    residuals = differences(values, data)
    slopes = jacobian(values, data, unknowns, move)
    basis, _ = np.linalg.qr(slopes / np.linalg.norm(slopes, axis=0))

    def free(column):
        return column - basis @ (basis.T @ column)

    rows = [["period [d]", "best wobble [rad]", "gain of chi^2", "limit of the wobble [rad]"]]
    for period in periods:
        columns = []
        for psi in (LONG(0), TURN / 4):
            at = {**values, "precession_phase": psi, "precession_rate": TURN / LONG(period * DAY)}
            columns.append(free(jacobian(at, data, ["wobble"], move)[:, 0]))
        columns, rest = np.array(columns).T, free(residuals)
        best = np.linalg.lstsq(columns, -rest, rcond=None)[0]
        gain = rest @ rest - np.sum((rest + columns @ best) ** 2)
        rows.append([float(period), float(np.hypot(*best)), float(gain), _limit(columns, best)])
    return rows


def _limit(columns, best):
    """The quantile of the wobble, with a flat prior in amplitude and phase, for a posterior of given curvature about `best`."""
    curvature = columns.T @ columns
    phases = 2 * np.pi * np.arange(4000) / 4000
    directions = np.array([np.cos(phases), np.sin(phases)])
    a = np.einsum("ik,ij,jk->k", directions, curvature, directions)
    b = directions.T @ curvature @ best
    reach = np.hypot(*best) + 9 / math.sqrt(np.linalg.eigvalsh(curvature)[0])

    def below(largest):
        edges = np.linspace(0, largest, 81)
        middle, half = (edges[1:] + edges[:-1]) / 2, (edges[1:] - edges[:-1]) / 2
        theta = (middle[:, None] + half[:, None] * NODES).ravel()
        weight = (half[:, None] * NODE_WEIGHTS).ravel()
        exponent = -(a * theta[:, None] ** 2 - 2 * b * theta[:, None] + best @ curvature @ best) / 2
        return float(weight @ np.exp(exponent).mean(axis=1))

    all_of_it = below(reach)
    return float(brentq(lambda limit: below(limit) / all_of_it - CONFIDENCE, 1e-6 * reach, reach, xtol=1e-12 * reach, rtol=1e-13))


def limit_on_s(values, spread, unknowns):
    """The limit on |2 s^ZZ - s^XX - s^YY| from the rate of the inclination: 4 sin(lambda) lambda' / Omega times eta."""
    place = unknowns.index("inclination_rate")
    sine = math.sin(values["inclination"])
    factor = 4 * sine / float(TURN * values["f0"])
    mean, deviation = (factor * float(x) for x in (values["inclination_rate"], math.sqrt(spread[place, place])))
    return bounds._limit(mean, deviation, bounds._slow_part, sine, 0.5)


def draw(values, data, random):
    """The data of such a star at these times, with errors."""
    star = Star(values)
    if len(data.times):
        numbers = np.round(star.phase(data.times))
        times = data.times
        for _ in range(50):
            times = times - (star.phase(times) - numbers) / star.phase_rate(times)
        late = data.sigmas * random.standard_normal(len(times))
        data = dataclasses.replace(data, times=times + late, numbers=numbers)
    if len(data.width_times):
        errors = data.width_sigmas * random.standard_normal(len(data.widths))
        data = dataclasses.replace(data, widths=star.width(data.width_times) + errors)
    return data


def read_tim(path, epoch):
    """Times since the epoch, numbers and errors (s) from a .tim with pulse numbers."""
    rows = [line.split() for line in open(path) if not line.startswith(("FORMAT", "C ", "#"))]
    times = np.array([_seconds(Fraction(row[2]) - epoch) for row in rows], LONG)
    numbers = np.array([int(row[row.index("-pn") + 1]) for row in rows], LONG)
    return times, numbers, np.array([float(row[3]) * 1e-6 for row in rows])


def read_widths(path, epoch):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    times = [Fraction(row["arrival_day [MJD]"]) + Fraction(row["arrival_fraction [d]"]) - epoch for row in rows]
    return np.array([_seconds(time) for time in times], LONG), np.array([float(row["duration [s]"]) for row in rows])


def _seconds(days):
    seconds = days * DAY
    whole = math.floor(seconds)
    return LONG(whole) + LONG(float(seconds - whole))


def read(path, case):
    """The start and the data of a case."""
    values, epoch = read_scene(path.with_suffix(".toml"))
    none = np.array([], LONG)
    tim = read_tim(path.with_suffix(".tim"), epoch) if "arrivals" in case else (none, none, none)
    widths = read_widths(path.with_suffix(".csv"), epoch) if "widths" in case else (none, none)
    sigmas = np.full(len(widths[1]), case.get("widths", 1.0))
    return values, Data(*tim, *widths, sigmas, {key: tuple(prior) for key, prior in case.get("priors", {}).items()})


def write_data(path, case):
    """Data of a star that differs from the scene by `moved`."""
    start, epoch = read_scene(path.with_suffix(".toml"))
    values = moved(start, {key: LONG(repr(change)) for key, change in case["moved"].items()})
    random = np.random.Generator(np.random.PCG64(case["seed"]))
    times = np.sort(random.uniform(-0.4, 0.6, case["epochs"])).astype(LONG) * LONG(case["years"] * 365.25 * DAY)
    none = np.array([], LONG)
    arrivals, widths = (times if key in case else none for key in ("arrivals", "widths"))
    sizes = [np.full(len(part), case.get(key, 1.0)) for key, part in (("arrivals", arrivals), ("widths", widths))]
    data = draw(values, Data(arrivals, none, sizes[0], widths, np.zeros(len(widths)), sizes[1], {}), random)

    def date(seconds):
        return epoch + (Fraction(int(seconds)) + Fraction(float(seconds - int(seconds)))) / DAY

    if len(arrivals):
        rows = [f"twofold 0.0 {_decimal(date(t))} {sigma * 1e6!r} @ -pn {int(number)}\n" for t, number, sigma in zip(data.times, data.numbers, sizes[0].tolist())]
        path.with_suffix(".tim").write_text("FORMAT 1\n" + "".join(rows))
    if len(widths):
        days = [date(t) for t in data.width_times]
        rows = [f"{int(day)},{float(day - int(day))!r},{float(width)!r}\n" for day, width in zip(days, data.widths)]
        path.with_suffix(".csv").write_text("arrival_day [MJD],arrival_fraction [d],duration [s]\n" + "".join(rows))


def _decimal(number):
    """The number with 20 decimals."""
    digits = round(number * 10**20)
    return f"{digits // 10**20}.{digits % 10**20:020d}"
