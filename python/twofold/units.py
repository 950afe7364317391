"""Input and output with quantities of astropy.

>>> from astropy import units as u
>>> from twofold import units
>>> star = units.scene("b1828-11", pulsar={"rho": 7 * u.deg}, time={"years": 2 * u.yr})
>>> table = units.arrivals(star.pulsar())
>>> table["residual"].max().to("ms")
<Quantity ... ms>

`scene` takes quantities for the keys of scene files, `table` gives a table of twofold as a `QTable`, `axis`, `state` and `angles` take and give quantities of a motion, `arrivals`
takes and gives `Time`.

Scenes in the paper's units have the units `t_c` of time and `I_xx` of inertia; `C`, the unit of energy, is `I_xx / t_c^2`. They convert into one another and into no other units.
"""

from __future__ import annotations

import re
from typing import Any

import numpy as np
from numpy.typing import NDArray

try:
    from astropy import constants
    from astropy import units as u
    from astropy.coordinates import Angle
    from astropy.table import QTable
    from astropy.time import Time
except ImportError as error:
    raise ImportError(f"twofold.units needs astropy ({error}): pip install 'twofold[units]'") from error

from twofold._twofold import Error, Motion, Pulsar, Scene, Table

__all__ = ["C", "I_xx", "angles", "arrivals", "axis", "scene", "state", "t_c", "table", "times", "unit"]

t_c = u.def_unit("t_c", doc="the unit of time of the paper, sqrt(I^xx / C)")
I_xx = u.def_unit("I_xx", doc="the moment of inertia about an axis in the equator")
C = u.def_unit("C", I_xx / t_c**2, doc="the constant of the anisotropic self-energy")

_NAMED = {
    "t_c": t_c, "I_xx": I_xx, "C": C, "rad": u.rad, "deg": u.deg, "s": u.s, "d": u.d, "yr": u.yr, "Hz": u.Hz, "g": u.g, "cm": u.cm, "km": u.km, "kpc": u.kpc,
    "erg": u.erg, "MJD": u.d,
}  # fmt: skip

_ANGLE, _ONE = u.rad, u.dimensionless_unscaled
# The unit of each key of a scene file; a pair, in the paper's units and for a physical star, if it depends on the scene's unit of time.
_KEYS: dict[tuple[str, str], Any] = {
    **{("star", key): _ONE for key in ("inertia_ratio", "oblateness", "bulge")},
    ("star", "spin"): u.rad / t_c,
    ("star", "mass"): u.M_sun,
    ("star", "radius"): u.km,
    ("star", "density"): u.g / u.cm**3,
    ("star", "precession_period"): u.d,
    ("star", "spin_frequency"): u.Hz,
    ("star", "frequency"): u.Hz,
    ("spin_down", "f1"): u.Hz / u.s,
    ("spin_down", "f2"): u.Hz / u.s**2,
    ("spin_down", "index"): _ONE,
    ("spin_down", "damping_time"): u.d,
    **{("lorentz_violation", key): _ONE for key in ("eigenvalues", "tensor", "alpha_2")},
    ("lorentz_violation", "w"): constants.c,
    **{("initial", k): _ANGLE for k in ["alpha", "beta", "gamma", "alpha_0", "beta_0", "phase", "wobble", "azimuth", "precession_phase"]},
    **{("initial", key): (u.rad / t_c, u.rad / u.s) for key in ("alpha_rate", "beta_rate", "amplitude")},
    **{("observer", key): _ANGLE for key in ("theta_o", "phi_o", "inclination", "azimuth")},
    ("observer", "distance"): u.kpc,
    **{("pulsar", key): _ANGLE for key in ("chi", "delta", "rho")},
    **{("time", key): (t_c, u.s) for key in ("start", "span", "end", "times")},
    ("time", "years"): u.yr,
}
# One hertz is a turn per second, not a radian.
_TURNS = [(u.Hz, u.cycle / u.s), (u.Hz / u.s, u.cycle / u.s**2), (u.Hz / u.s**2, u.cycle / u.s**3)]


def scene(source: Any = None, /, *, toml: str | None = None, **sections: Any) -> Scene:
    """A scene as `twofold.Scene` makes it, from sections that may have quantities.

    `units.scene("tp-1", star={"spin": 1.2 * u.rad / units.t_c})`. Each is converted to the unit of its key in scene files: a radius to km, a frequency in rad/s to Hz, a velocity `w` to
    parts of c. `time.epoch` takes a `Time`, right ascension and declination an `Angle`.
    """
    in_tc: list[str] = []
    in_seconds: list[str] = []
    plain: dict[str, Any] = {}
    for name, section in sections.items():
        plain[name] = section
        if isinstance(section, dict):
            plain[name] = {k: _plain(name, k, value, in_tc, in_seconds) for k, value in section.items()}
    made = Scene(toml=toml, **plain) if source is None else Scene(source, **plain)
    wrong = in_seconds if made.time_unit == "t_c" else in_tc
    if wrong:
        raise Error(f"{wrong[0]}: must be a quantity in {made.time_unit}, the unit of time of this scene")
    return made


def unit(text: str) -> u.UnitBase | None:
    """The unit that a table writes as `text`, such as `"rad/t_c"` or `"g cm^2/s"`. None for a column without one, for counts and for words."""
    if text == "":
        return None
    square = re.fullmatch(r"\((.*)\)\^(\d)", text)
    if square:
        return (unit(square[1]) or _ONE) ** int(square[2])
    found = _ONE
    for k, part in enumerate(text.split("/")):
        for word in part.split():
            match = re.fullmatch(r"(\w+?)(?:\^(\d))?", word)
            if match is None or (match[1] not in _NAMED and match[1] != "1"):
                raise Error(f"unit {text!r}: `{word}` is not known; expected one of {', '.join(_NAMED)}")
            factor = (_ONE if match[1] == "1" else _NAMED[match[1]]) ** int(match[2] or 1)
            found = found * factor if k == 0 else found / factor
    return found


def table(of: Table) -> QTable:
    """A table as a `QTable`: quantities, and plain columns where there is no unit. The two columns of an arrival time are one column `arrival` of `Time` (TDB)."""
    made = QTable()
    for name, written in of.units.items():
        if name == "arrival_day":
            made["arrival"] = Time(of["arrival_day"], of["arrival_fraction"], format="mjd", scale="tdb")
        elif name != "arrival_fraction":
            column, its = of[name], unit(written)
            made[name] = column if its is None or isinstance(column, list) else column * its
    return made


def times(of: Scene, t: u.Quantity | Time) -> float | NDArray[np.float64]:
    """Times as numbers in a scene's own count: from quantities in its unit of time, or from dates (`Time`) if it has a `time.epoch`."""
    if isinstance(t, Time):
        epoch = Time(of.pulsar().epoch, format="mjd", scale="tdb")
        return (t.tdb - epoch).to_value(u.s) + of.span[0]
    return _value("t", t, unit(of.time_unit))


def axis(of: Motion, t: u.Quantity | Time) -> NDArray[np.float64]:
    """The symmetry axis n at times: an array of shape (..., 3)."""
    return of.axis(times(of.scene, t))


def state(of: Motion, t: u.Quantity | Time) -> tuple[NDArray[np.float64], u.Quantity, NDArray[np.float64]]:
    """The symmetry axis n, the angular momentum L as a quantity, and the axis e_x at times."""
    n, momentum, e_x = of.state(times(of.scene, t))
    its = unit("I_xx/t_c" if of.scene.time_unit == "t_c" else "g cm^2/s")
    return n, momentum * its, e_x


def angles(of: Motion, t: u.Quantity | Time) -> u.Quantity:
    """The Euler angles alpha, beta and gamma at times: shape (..., 3)."""
    return of.angles(times(of.scene, t)) * u.rad


def arrivals(of: Pulsar, epochs: Time | None = None, *, derivatives: int | None = None, causes: bool = False) -> QTable:
    """The pulses nearest to dates, as `Pulsar.arrivals` finds them. The fit is in `meta`: `F0` with the remainder of a double in `F0_REST`, `F1` and `F2` if they were fitted, and `PEPOCH`."""
    dates = None if epochs is None else np.atleast_1d(epochs.tdb.mjd)
    timing = of.arrivals(dates, derivatives=derivatives, causes=causes)
    made = table(timing.table)
    made.meta["F0"], made.meta["F0_REST"] = (part * u.Hz for part in timing.frequency)
    for k, derivative in enumerate(timing.derivatives, 1):
        made.meta[f"F{k}"] = derivative * u.Hz / u.s**k
    made.meta["PEPOCH"] = Time(timing.epoch, format="mjd", scale="tdb")
    return made


def _plain(section: str, key: str, value: Any, in_tc: list[str], in_seconds: list[str]) -> Any:
    """A value of a scene file; values that depend on the unit of time are recorded with their unit."""
    name = f"{section}.{key}"
    if isinstance(value, Time):
        if name != "time.epoch":
            raise Error(f"{name} = {value}: a date can only be used for time.epoch")
        return str(value.tdb.to_value("mjd", subfmt="str"))
    if isinstance(value, Angle) and key in ("right_ascension", "declination"):
        if key == "right_ascension":
            return value.to_string(unit=u.hourangle, sep=":", precision=8, pad=True)
        return value.to_string(unit=u.deg, sep=":", precision=7, pad=True, alwayssign=True)
    if not isinstance(value, u.Quantity):
        return value
    if (section, key) not in _KEYS:
        raise Error(f"{name} = {value}: must be a value without a unit, as docs/scenes.md describes")
    wanted = _KEYS[section, key]
    if isinstance(wanted, tuple):
        paper, physical = wanted
        by_paper = value.unit.is_equivalent(paper)
        (in_tc if by_paper else in_seconds).append(f"{name} = {value}")
        wanted = paper if by_paper else physical
    elif name == "lorentz_violation.w" and value.unit.is_equivalent(_ONE):
        wanted = _ONE
    if isinstance(wanted, u.Quantity):
        value, wanted = value / wanted, _ONE
    found = _value(name, value, wanted)
    return np.asarray(found).tolist()


def _value(name: str, value: Any, wanted: Any) -> Any:
    if not isinstance(value, u.Quantity):
        raise Error(f"{name} = {value}: must be a quantity in {wanted}")
    try:
        return value.to_value(wanted, equivalencies=_TURNS)
    except u.UnitConversionError:
        raise Error(f"{name} = {value}: must be a quantity in {wanted or 'no unit'}") from None
