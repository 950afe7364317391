"""Continuous gravitational waves for lalpulsar, PyFstat and GWpy.

The wave of a wobbling star has two harmonics, once and twice a turn of its symmetry axis about `L`. `Waveform` is one of them, as a function that
`lalpulsar.simulateCW.CWSimulator` takes; `strain` has both, as series in equal steps. Nothing here imports lalpulsar.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from twofold._twofold import Error, Pulsar

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["Waveform", "seconds_since_epoch", "strain"]

_TAU = 2.0 * np.pi

#: MJD (TT) of 1980 January 6, 0 h UTC, where seconds of GPS begin: 19 s of TAI - UTC, and 32.184 s of TT - TAI.
_GPS_BEGINS = 44244 + Fraction(51184, 86400 * 1000)


def seconds_since_epoch(pulsar: Pulsar, gps: float) -> float:
    """The time `t` of a pulsar (s since its epoch, TDB at the barycentre) at a barycentric time in seconds of GPS, as lalpulsar counts them: TDB less 51.184 s."""
    return float(Fraction(gps) - _gps_of_epoch(pulsar))


def _gps_of_epoch(pulsar: Pulsar) -> Fraction:
    return 86400 * (Fraction(pulsar.epoch) - _GPS_BEGINS)


def _nearest(angle: NDArray[np.float64]) -> NDArray[np.float64]:
    """An angle modulo 2 pi, in [-pi, pi]."""
    return angle - _TAU * np.rint(angle / _TAU)


class Waveform:
    """One harmonic of the wave of a pulsar: `waveform(dt) -> (dphi, a_plus, a_cross)`, with `h_+ = a_plus cos(dphi)` and `h_x = a_cross sin(dphi)` to the axes at the polarization angle `psi`.

    `harmonic` is `"once"` or `"twice"` a turn. `dt` (s) is a number or an array, counted from `reference` (s since the epoch of the scene). `dphi` counts turns
    from there on without jumps. Give `phi0=0.0` and `psi=waveform.psi` to `CWSimulator`: `dphi` begins with the phase at the reference.

    `psi` is that of lalpulsar, from the projection of `L` on the sky at the reference: it is an angle on the true sky if Z of the scene is the north pole (`observer.frame = "equatorial"`). `L` may turn: for a change of more than 1e-3 rad in
    position angle, a waveform with one `psi` is refused. Then take two, `hand="right"` and `hand="left"`: the circular parts of the harmonic, whose sum is the harmonic however `L` turns.

    The harmonics are those of `Pulsar.wave_harmonics`. Without Lorentz violation their sum is `Pulsar.wave`; with it they lack about `C s / (I_xx Omega^2)` of it, `0.03 s` for the scene `wave-source` at 20 Hz (docs/waves-in-python.md).

    Turns are counted from knots `knot_distance` apart (s; 16384 periods if not given), at most a million on a side, between which the rate of turns may change smoothly. A strong violation of Lorentz symmetry, by which `L`
    precesses in some 1e5 turns or less, needs a smaller distance. A phase of `n` turns is rounded to `1.4e-15 n` rad: choose a reference within the data.
    """

    def __init__(
        self,
        pulsar: Pulsar,
        harmonic: Literal["once", "twice"],
        *,
        reference: float = 0.0,
        hand: Literal["right", "left"] | None = None,
        knot_distance: float | None = None,
    ) -> None:
        if harmonic not in ("once", "twice"):
            raise Error(f'harmonic = {harmonic!r}: must be "once" or "twice"')
        if hand not in (None, "right", "left"):
            raise Error(f'hand = {hand!r}: must be "right", "left" or None')
        if not np.isfinite(reference):
            raise Error(f"reference = {reference!r} s: must be a finite number")
        if knot_distance is not None and not 0.0 < knot_distance < np.inf:
            raise Error(f"knot_distance = {knot_distance!r} s: must be a finite number above zero")
        self.pulsar = pulsar
        self.harmonic = harmonic
        self.reference = float(reference)
        self.hand = hand
        self.knot_distance = float(knot_distance or 16384 * pulsar.period)
        once, twice, phase, _, self._orientation, _ = pulsar.wave_harmonics(self.reference)
        if not np.isfinite(once + twice):
            raise Error("the scene lacks `observer.distance` [kpc], without which there is no strain")
        if once == 0.0 and twice == 0.0:
            raise Error("the wobble is zero; the star emits no wave")
        # Phase and rate at knots, forwards and backwards from the reference.
        self._sides = [(np.array([phase]), self._rates(np.array([self.reference])))] * 2

    def __repr__(self) -> str:
        hand = f", hand={self.hand!r}" if self.hand else ""
        return f"Waveform({self.pulsar!r}, {self.harmonic!r}, reference={self.reference!r}{hand})"

    @property
    def psi(self) -> float:
        """The polarization angle of lalpulsar, in [0, pi) (rad). At `psi = 0` its axes are west and north, so that an axis at the position angle `p`, from north through east, has `p + pi/2`."""
        return float((self._orientation + np.pi / 2) % np.pi)

    def __call__(self, dt: ArrayLike) -> tuple[Any, Any, Any]:
        dt = np.asarray(dt, dtype=float)
        if not np.isfinite(dt).all():
            raise Error("dt: must be finite numbers")
        t = self.reference + dt.reshape(-1)
        once, twice, phase, inclination, orientation, _ = self.pulsar.wave_harmonics(t)
        turned = _nearest(orientation - self._orientation)
        if self.hand is None and turned.size and abs(turned).max() > 1e-3:
            raise Error(
                f"psi: L turns by {abs(turned).max():.1e} rad of position angle since the reference: must be at most 1e-3 rad; use hand='right' and hand='left'"
            )
        phase, cos = self._counted(t, phase), np.cos(inclination)
        if self.harmonic == "once":
            sin = np.sin(inclination)
            plus, cross = -once * sin * cos, -once * sin
        else:
            phase, plus, cross = 2.0 * phase, twice * (1.0 + cos * cos) / 2.0, twice * cos
        if self.hand is not None:
            sign = 1.0 if self.hand == "right" else -1.0
            phase = phase + 2.0 * sign * turned
            plus = (plus + sign * cross) / 2.0
            cross = sign * plus
        if dt.ndim == 0:
            return float(phase[0]), float(plus[0]), float(cross[0])
        return phase.reshape(dt.shape), plus.reshape(dt.shape), cross.reshape(dt.shape)

    def _phase(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        return self.pulsar.wave_harmonics(t)[2]

    def _rates(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        """Rates of the phase (rad/s): from differences over a sixteenth of a turn, then over eight times as much, up to the distance of knots."""
        half, rates = self.pulsar.period / 32, np.zeros_like(t)
        while True:
            before, after = t - half, t + half
            gap = after - before
            rates = rates + _nearest(self._phase(after) - self._phase(before) - rates * gap) / gap
            if 16 * half > self.knot_distance:
                return rates
            half *= 8

    def _knots(self, side: int, count: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """At least `count` knots on a side of the reference."""
        phases, rates = self._sides[side]
        if len(phases) < count:
            step = self.knot_distance * (1 - 2 * side)
            first, count = len(phases), max(count, min(2 * len(phases), len(phases) + 4096))
            t = self.reference + step * np.arange(first, count)
            rates = np.concatenate([rates, self._rates(t)])
            gaps = np.diff(np.concatenate([[self.reference + step * (first - 1)], t]))
            expected = gaps * (rates[first - 1 : -1] + rates[first:]) / 2
            wrapped = self._phase(t)
            more = np.cumsum(expected + self._missed(np.diff(np.concatenate([phases[-1:], wrapped])) - expected))
            # Whole turns are added to the computed phase, so that errors do not accumulate.
            more = wrapped + _TAU * np.rint((phases[-1] + more - wrapped) / _TAU)
            self._sides[side] = phases, rates = np.concatenate([phases, more]), rates
        return phases, rates

    def _counted(self, t: NDArray[np.float64], wrapped: NDArray[np.float64]) -> NDArray[np.float64]:
        """Phases with the turns since the reference."""
        found = np.empty_like(wrapped)
        for side in (0, 1):
            step = self.knot_distance * (1 - 2 * side)
            here = (t < self.reference) == (side == 1)
            if not here.any():
                continue
            turns = np.floor((t[here] - self.reference) / step)
            if turns.max() >= 1_000_000:
                raise Error(
                    f"dt = {abs(t[here] - self.reference).max():.3e} s in size: must be at most a million knots, {1e6 * self.knot_distance:.3e} s; use a nearer reference"
                )
            k = turns.astype(np.int64)
            phases, rates = self._knots(side, int(k.max()) + 2)
            start = self.reference + step * k
            gap = (self.reference + step * (k + 1)) - start
            u = (t[here] - start) / gap
            # A cubic through the phases and rates of both knots.
            rise = phases[k + 1] - phases[k]
            left, right = gap * rates[k] - rise, rise - gap * rates[k + 1]
            expected = phases[k] + u * (rise + (1 - u) * (left * (1 - u) + right * u))
            found[here] = wrapped[here] + _TAU * np.rint((expected - wrapped[here]) / _TAU)
            self._missed(wrapped[here] - expected)
        return found

    def _missed(self, difference: NDArray[np.float64]) -> NDArray[np.float64]:
        """Deviations of phases from the expected ones, modulo a turn: from half a radian on, turns cannot be counted safely."""
        off = _nearest(difference)
        if off.size and not abs(off).max() < 0.5:
            raise Error(
                f"knot_distance = {self.knot_distance!r} s: the phase is {abs(off).max():.1g} rad from the smooth one between knots: must be at most 0.5 rad; use a smaller distance"
            )
        return off


def strain(pulsar: Pulsar, start: float, duration: float, rate: float, *, gwpy: bool | None = None) -> tuple[Any, Any]:
    """The strain `h_+` and `h_x` of a pulsar as series: `rate` samples a second (Hz) from `start` (s since the epoch) on, over `duration` (s).

    Two `gwpy.timeseries.TimeSeries` where GWpy can be imported, or two arrays; `gwpy=False` asks for arrays. Axes of the polarizations: north and east, as those of `Pulsar.wave`. Times are those at the barycentre, of the series in seconds of GPS as `seconds_since_epoch` takes them.
    """
    if not np.isfinite(start):
        raise Error(f"start = {start!r} s: must be a finite number")
    for name, value, unit in (("duration", duration, "s"), ("rate", rate, "Hz")):
        if not 0.0 < value < np.inf:
            raise Error(f"{name} = {value!r} {unit}: must be a finite number above zero")
    count = int(np.rint(duration * rate))
    if not 1 <= count <= 10**9:
        raise Error(f"duration = {duration!r} s at rate = {rate!r} Hz: must be from 1 to 1e9 samples")
    plus, cross = pulsar.wave(start + np.arange(count) / rate)
    if gwpy is False:
        return plus, cross
    try:
        from gwpy.timeseries import TimeSeries
    except ImportError:
        if gwpy:
            raise
        return plus, cross
    options = {"t0": float(_gps_of_epoch(pulsar) + Fraction(start)), "sample_rate": rate, "unit": "strain"}
    return TimeSeries(plus, name="h_plus", **options), TimeSeries(cross, name="h_cross", **options)
