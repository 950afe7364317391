"""The output of `twofold bounds --json`: Eqs. (41) to (43) of the paper, linear errors, and limits at 95 % over directions.

Directions: `eta = 1 / (v sin(lambda) |cos psi|)`, where `psi` is uniform and `v = sin b |cos b|` for a tensor symmetric about an axis at the
angle `b` to the spin axis: given as `beta_0`, or isotropic.
"""

import math
import tomllib
from decimal import Decimal

import mpmath
import numpy as np
from scipy.optimize import brentq
from scipy.special import ndtr

GRAVITATION = 6.67430e-11  # m^3 kg^-1 s^-2, CODATA 2018
LIGHT = 299792.458  # km/s
YEAR = 365.25 * 86400  # Julian year [s]
CONFIDENCE = 0.95
CONSERVATIVE_ETA = 10.0
ROUND_INERTIA_OVER_C = 1e-5  # s^2


class _Number(str):
    """A number as written in the file, with its digits."""


def _with_uncertainty(written) -> tuple[float, float, bool]:
    """Value, standard uncertainty, and whether it is given: otherwise it is half of the last digit over sqrt(3)."""
    if isinstance(written, list):
        return float(written[0]), float(written[1]), True
    exponent = Decimal(str(written)).as_tuple().exponent
    return float(written), 0.5 * 10.0**exponent / math.sqrt(3), False


def read(path: str, move: float = 0.0) -> list[dict]:
    """The pulses of a table: texts, and for each number its value, standard uncertainty and whether that is given.

    Values are changed by the fraction `move`, alternately up and down.
    """
    with open(path, "rb") as file:
        table = tomllib.load(file, parse_float=_Number)
    pulses = []
    for section in table["pulsar"]:
        texts = {key: section.get(key) for key in ("name", "source")}
        numbers = {key: _with_uncertainty(value) for key, value in section.items() if key not in texts}
        if "zeta" in numbers:
            value, *rest = numbers.pop("zeta")
            numbers["lambda"] = (180.0 - value, *rest)
        for k, (key, (value, *rest)) in enumerate(numbers.items()):
            numbers[key] = (value * (1 + move * (-1) ** k), *rest)
        pulses.append({"texts": texts, "numbers": numbers})
    return pulses


def figures(x: dict) -> dict:
    """The quantities that follow from the numbers of one pulse, by their keys in the output, bounds with the sign of the change; for any number
    type."""
    degree = mpmath.pi / 180
    width, lambda_, chi = (x[key] * degree for key in ("width", "lambda", "chi"))
    spin = 2 * mpmath.pi * x["spin_frequency"] if "spin_frequency" in x else 2 * mpmath.pi / x["spin_period"]
    # Eq. (42), in degrees.
    change = mpmath.sin(width / 2) / (mpmath.cot(lambda_) * mpmath.cos(width / 2) + mpmath.cot(chi)) * x["width_change"] / 2
    drift = spin * mpmath.sin(lambda_) * change * degree / (x["years"] * YEAR)
    found = {"lambda_change": change * 1000}
    if "density" in x:  # g/cm^3; Eq. (43)
        stated = 15 / (4 * mpmath.pi * mpmath.mpf(GRAVITATION) * 1000 * x["density"] * x["oblateness"])
        found["inertia_over_c_stated"] = stated
        found["bound_over_eta_stated"] = stated * drift
    own = x["inertia_over_c"] if "inertia_over_c" in x else 4 / spin**2
    found["inertia_over_c_own"] = own
    found["bound_over_eta_own"] = own * drift
    if "w" in x:
        found["alpha_2_over_eta_own"] = own * drift / (2 * (x["w"] / mpmath.mpf(LIGHT)) ** 2)
    return found


def _with_errors(numbers: dict) -> dict:
    """For each figure its value and its standard uncertainties: from the change of width, and from all other numbers."""
    with mpmath.workdps(50):
        centre = {key: mpmath.mpf(value) for key, (value, *_) in numbers.items()}
        values = figures(centre)
        variances = {key: [0.0, 0.0] for key in values}
        for moved, (value, uncertainty, _) in numbers.items():
            if moved in ("eta", "beta_0") or uncertainty == 0:
                continue
            step = mpmath.mpf(10) ** -18 * (abs(centre[moved]) + uncertainty)
            up, down = (figures({**centre, moved: centre[moved] + sign * step}) for sign in (1, -1))
            for key in values:
                part = (up[key] - down[key]) / (2 * step) * uncertainty
                variances[key][0 if moved == "width_change" and numbers[moved][2] else 1] += float(part * part)
        bounds = [key for key in values if "over_eta" in key]
        values.update({key: abs(values[key]) for key in bounds})
        return {key: (float(value), *map(math.sqrt, variances[key])) for key, value in values.items()}


def _size_quantile(mean: float, deviation: float) -> float:
    """The size that a normal number does not exceed with the probability `CONFIDENCE`."""
    if deviation == 0:
        return abs(mean)
    m = abs(mean) / deviation
    return deviation * brentq(lambda y: ndtr(y - m) - ndtr(-y - m) - CONFIDENCE, 0, m + 10, xtol=1e-15, rtol=1e-14)


NODES, WEIGHTS = np.polynomial.legendre.leggauss(80)


def _slow_part(a: np.ndarray) -> np.ndarray:
    """Probability of `v |cos psi| < a` for an isotropic axis: the mean of `(2/pi) asin min(1, a/v)` over `v = sin(2b)/2`."""
    first = np.arcsin(np.clip(2 * a, 1e-300, 1.0))[..., None]  # of 2b; below it v < a
    last = np.arccosh(np.pi / 2 / first)
    t = last / 2 * (1 + NODES)  # 2b = first cosh t has no corner at the first
    double = first * np.cosh(t)
    weight = (np.sin(double / 2) + np.cos(double / 2)) / 2  # of b and of pi/2 - b
    part = weight * (2 / np.pi) * np.arcsin(np.minimum(1.0, np.sin(first) / np.sin(double))) * first * np.sinh(t)
    below = 1 - np.cos(first / 2) + np.sin(first / 2)
    return below[..., 0] + np.sum(part * WEIGHTS * last / 2, axis=-1)


def _slow_part_at(inclination: float, a: np.ndarray) -> np.ndarray:
    """The same for an axis at the inclination (rad)."""
    return 2 / np.pi * np.arcsin(np.minimum(1.0, a / abs(math.sin(inclination) * math.cos(inclination))))


def _limit(mean: float, deviation: float, slow, sine: float, corner: float) -> float:
    """The size that `|x| eta` does not exceed with the probability `CONFIDENCE`: `x` normal, `P(v |cos psi| < a) = slow(a)`, which is one from
    `corner` on."""
    if mean == 0 and deviation == 0:
        return 0.0

    def beyond(y: float) -> float:
        if deviation == 0:
            return float(slow(np.array(abs(mean) / (y * sine))))
        end = y * sine * corner / deviation  # from there on in size eta is always large enough; in standard deviations
        m = abs(mean) / deviation
        first, last = max(0.0, m - 10), min(end, m + 10)
        if last <= first:
            return 1.0
        points = np.array([first, *sorted(x for x in (m - 4, m, m + 4, last / 8) if first < x < last), last])
        # At both ends of every piece the variable starts quadratically: a logarithm and a root are smooth in it.
        u, size = (1 + NODES) / 2, np.diff(points)[:, None]
        x = points[:-1, None] + size * u * u * (3 - 2 * u)
        density = (np.exp(-0.5 * (x - m) ** 2) + np.exp(-0.5 * (x + m) ** 2)) / math.sqrt(2 * math.pi)
        inner = np.sum(density * slow(x * deviation / (y * sine)) * 3 * u * (1 - u) * size * WEIGHTS)
        return float(inner + ndtr(m - end) + ndtr(-m - end))

    low, high = (abs(mean) + 1e-3 * deviation) / sine, (abs(mean) + 10 * deviation) * 1e4 / (sine * corner)
    found = brentq(lambda y: beyond(math.exp(y)) - (1 - CONFIDENCE), math.log(low), math.log(high), xtol=1e-13)
    return math.exp(found)


def _limits(numbers: dict, figure: tuple[float, float, float]) -> dict:
    """Limits over `eta` from the change of width and from other numbers; on `eta`; and in total with and without the error of the change."""
    value, by_change, by_inputs = figure
    sine = math.sin(math.radians(numbers["lambda"][0]))
    relative = 0.0
    if "eta" in numbers:
        eta, uncertainty, _ = numbers["eta"]
        relative = uncertainty / eta
    elif "beta_0" in numbers:  # eta goes as 1 / sin(2 b)
        inclination, uncertainty, _ = numbers["beta_0"]
        relative = abs(2 * math.radians(uncertainty) / math.tan(2 * math.radians(inclination)))
    others = math.hypot(by_inputs, value * relative)

    def together(mean: float, deviation: float) -> float:
        if "eta" in numbers:
            return numbers["eta"][0] * _size_quantile(mean, deviation)
        if "beta_0" in numbers:
            b = math.radians(numbers["beta_0"][0])
            return _limit(mean, deviation, lambda a: _slow_part_at(b, a), sine, abs(math.sin(b) * math.cos(b)))
        return _limit(mean, deviation, _slow_part, sine, 0.5)

    return {
        "by_change": _size_quantile(value, by_change),
        "by_inputs": _size_quantile(value, others),
        "eta": numbers["eta"][0] if "eta" in numbers else together(1.0, 0.0),
        "without_error": together(value, others),
        "all": together(value, math.hypot(by_change, others)),
        "sensitivity": together(0.0, by_change) if by_change > 0 else None,
    }


def rows_of_pulse(numbers: dict, paper: bool) -> tuple[list, dict]:
    """Rows (key, value, standard uncertainties from the change and from other numbers), and the limits on the combination."""
    measured = numbers["width_change"][2]
    found = _with_errors(numbers)
    rows = []
    for key, (value, by_change, by_inputs) in found.items():
        def row(name: str, factor: float = 1.0) -> None:
            rows.append((name, value * factor, by_change * factor if measured else None, by_inputs * factor))

        row(key)
        if paper and key == "bound_over_eta_stated":
            row("bound_eta_ten_stated", CONSERVATIVE_ETA)
            row("bound_over_eta_round", ROUND_INERTIA_OVER_C / found["inertia_over_c_stated"][0])
        if paper and key == "bound_over_eta_own":
            row("bound_eta_ten_own", CONSERVATIVE_ETA)
    limits = _limits(numbers, found["bound_over_eta_own"])

    def limit(key: str, value: float) -> None:
        rows.append((key, value, None, None))

    if measured:
        limit("limit_over_eta_by_change", limits["by_change"])
        if paper:
            limit("limit_eta_ten_by_change", limits["by_change"] * CONSERVATIVE_ETA)
    limit("limit_over_eta_by_inputs", limits["by_inputs"])
    limit("eta", limits["eta"])
    if measured:
        limit("limit_without_error", limits["without_error"])
    limit("limit", limits["all"])
    if "alpha_2_over_eta_own" in found:
        limit("alpha_2_limit", _limits(numbers, found["alpha_2_over_eta_own"])["all"])
    return rows, limits


def table(path: str, paper: bool, move: float = 0.0) -> dict:
    """Every number of the JSON output: a list of rows for each pulse, and the recommended limit."""
    pulses, best = [], None
    for pulse in read(path, move):
        rows, limits = rows_of_pulse(pulse["numbers"], paper)
        pulses.append({**pulse["texts"], "measured": pulse["numbers"]["width_change"][2], "figures": rows})
        strength = limits["sensitivity"] or limits["all"]
        if best is None or strength < best[0]:
            best = strength, pulses[-1]
    return {"pulses": pulses, "recommended": best[1]}
