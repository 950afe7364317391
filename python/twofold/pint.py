"""A wobble in PINT's timing models (docs/pint.md).

>>> import twofold.pint                                     # registers the component, so that get_model reads its parameters
>>> twofold.pint.add_wobble(model, toas, period=500 * u.day, chi=89 * u.deg, torque=1.0)

`Wobble` is a phase component beside PINT's `Spindown`. `wobble_limits` gives upper limits on the wobble from arrival times, by its period.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import astropy.units as u
import numpy as np
from pint.exceptions import InvalidModelParameters, MissingParameter
from pint.models.parameter import floatParameter
from pint.models.timing_model import PhaseComponent, TimingModel
from pint.residuals import Residuals
from pint.toa import TOAs

import twofold

__all__ = ["Wobble", "add_wobble", "wobble_limits"]

DAY = 86400.0


#: Fraction of its rotation that a star may lose between the epoch and an arrival.
MOST_LOST = 0.1


@dataclass(frozen=True)
class _Star:
    """A wobbling star in Hz, s and rad, with the symbols of docs/timing-model.md and docs/spin-down.md."""

    f0: float
    f1: float
    wobble: float
    chi: float
    rate: float
    phase: float
    torque: float

    def check(self, t: np.ndarray | None = None) -> None:
        """Raises InvalidModelParameters for a star outside the domain of the timing model."""
        degrees = [f"{angle:.12g} deg" for angle in np.degrees([self.wobble, self.chi])]
        least = min(self.chi, np.pi - self.chi)
        if not 0.0 < least:
            raise InvalidModelParameters(f"WOBCHI = {degrees[1]}: must be above 0 and below 180 deg")
        if not abs(self.wobble) < least:
            raise InvalidModelParameters(
                f"WOBBLE = {degrees[0]}: must be below {np.degrees(least):.12g} deg, which is how far"
                f" WOBCHI = {degrees[1]} is from 0 or from 180 deg"
            )
        if not (self.rate > 0.0 and np.isfinite(self.rate)):
            raise InvalidModelParameters(f"WOBPERIOD = {self._days():.12g} d: must be above 0 and finite")
        if not 0.0 <= self.torque <= 1.0:
            raise InvalidModelParameters(f"WOBTORQUE = {self.torque:.12g}: must be from 0 to 1")
        try:
            twofold.TimingModel(
                self.f0,
                f1=self.f1,
                wobble=abs(self.wobble),
                chi=self.chi,
                precession_rate=self.rate,
                precession_phase=self.phase,
                torque_share=self.torque,
            )
        except twofold.Error as error:
            raise InvalidModelParameters(f"WOBPERIOD = {self._days():.12g} d: {error}") from error
        if t is not None and t.size:
            lost = self.f1 / self.f0 * t[np.argmax(np.abs(t))]
            if not abs(lost) <= MOST_LOST:
                raise InvalidModelParameters(
                    f"F1 t / F0 = {lost:.3g} at an arrival time: must be at most {MOST_LOST} in size; use a nearer PEPOCH"
                )

    def _days(self) -> float:
        return 2.0 * np.pi / self.rate / DAY if self.rate else np.inf


class _Beyond:
    """The difference in turns between a wobbling star and the same star without a wobble, at times (s) since the epoch.

    `F0 (tau - tau_0) + B(psi) / 2 pi`: the stretched times with the varying torque and without it obey `t = tau + kappa tau^2 / 2 + Q(tau) - Q(0)` and `t = tau_0 + kappa tau_0^2 / 2`. Their difference
    `delta` is found from `delta (1 + kappa (tau_0 + delta / 2)) = Q(0) - Q(tau)`, where nothing large is subtracted.
    """

    def __init__(self, star: _Star, t: np.ndarray):
        self.star, self.t = star, t
        wobble, chi, share = star.wobble, star.chi, star.torque
        (sin, cos), (sin_chi, cos_chi) = (np.sin(wobble), np.cos(wobble)), (np.sin(chi), np.cos(chi))
        self.kappa = kappa = -star.f1 / star.f0
        # sin^2 theta_m = a_0 + a_1 cos psi + a_2 cos 2 psi, and Q = -kappa (q_1 cos psi + q_2 cos 2 psi).
        a = 1.0 - (cos * cos_chi) ** 2 - (sin * sin_chi) ** 2 / 2.0
        self.a = np.array([a, -2.0 * sin * cos * sin_chi * cos_chi, -((sin * sin_chi) ** 2) / 2.0])
        self.mean = 1.0 - share + share * a
        self.per_rate = np.array([1.0, 0.25]) / star.rate**2
        self.q = share / self.mean * self.a[1:] * self.per_rate
        self.plain = 2.0 * t / (1.0 + np.sqrt(1.0 + 2.0 * kappa * t))
        self.delta = np.zeros_like(t)
        self._follow()
        # The torque varies the rotation by a hundredth at most: each iteration gains this factor.
        for _ in range(12 if kappa != 0.0 and self.q.any() else 0):
            last = self.delta
            self.delta = -kappa * self.late / (1.0 + kappa * (self.plain + last / 2.0))
            self._follow()
            if star.f0 * np.max(np.abs(self.delta - last), initial=0.0) < 1e-17:
                break
        tilt, dip = np.sin(wobble) * cos_chi, 2.0 * np.sin(wobble / 2.0) ** 2
        self.along = sin_chi * (1.0 - dip * self.cos**2) - tilt * self.cos
        self.across = -self.sin * (tilt + sin_chi * dip * self.cos)
        self.turns = star.f0 * self.delta + np.arctan2(self.across, self.along) / (2.0 * np.pi)

    def _follow(self) -> None:
        """The angle psi at the present `delta`, and `(Q(tau) - Q(0)) / kappa`."""
        star = self.star
        self.tau = self.plain + self.delta
        psi = star.phase + star.rate * self.tau
        self.sin, self.cos = np.sin(psi), np.cos(psi)
        self.sin_2, self.cos_2 = 2.0 * self.sin * self.cos, 1.0 - 2.0 * self.sin**2
        self.late = self._late(self.q)

    def _late(self, q: np.ndarray) -> np.ndarray:
        """`(Q(tau) - Q(0)) / kappa` with coefficients `q`."""
        phase = self.star.phase
        return q[0] * (np.cos(phase) - self.cos) + q[1] * (np.cos(2.0 * phase) - self.cos_2)

    @cached_property
    def derivatives(self) -> dict[str, np.ndarray]:
        """Derivatives of the turns with respect to the fields of the star, in their units, and to time (`t`)."""
        return self._derivatives()

    # A separate function: mutmut (scripts/mutation-python) makes no mutants of decorated ones.
    def _derivatives(self) -> dict[str, np.ndarray]:
        star, kappa, tau = self.star, self.kappa, self.tau
        wobble, chi = star.wobble, star.chi
        (sin_w, cos_w), (sin_chi, cos_chi) = (np.sin(wobble), np.cos(wobble)), (np.sin(chi), np.cos(chi))
        sin, cos, dip = self.sin, self.cos, 2.0 * np.sin(wobble / 2.0) ** 2
        norm = self.along**2 + self.across**2
        # The geometry B at a fixed psi.
        b_wobble = (
            -sin * (cos_w * cos_chi + sin_chi * sin_w * cos) * self.along
            + (sin_chi * sin_w * cos + cos_w * cos_chi) * cos * self.across
        ) / norm
        b_chi = (
            -sin * (cos_chi * dip * cos - sin_w * sin_chi) * self.along
            - (cos_chi * (1.0 - dip * cos**2) + sin_w * sin_chi * cos) * self.across
        ) / norm
        b_psi = (
            (sin_chi * dip * sin**2 - cos * (sin_w * cos_chi + sin_chi * dip * cos)) * self.along
            - (2.0 * sin_chi * dip * cos + sin_w * cos_chi) * sin * self.across
        ) / norm
        # The delay at a fixed tau, divided by kappa.
        by_psi = self.q[0] * sin + 2.0 * self.q[1] * self.sin_2
        by_psi_0 = self.q[0] * np.sin(star.phase) + 2.0 * self.q[1] * np.sin(2.0 * star.phase)
        a_wobble = np.array(
            [
                2.0 * sin_w * cos_w * (cos_chi**2 - sin_chi**2 / 2.0),
                -2.0 * (cos_w**2 - sin_w**2) * sin_chi * cos_chi,
                -sin_w * cos_w * sin_chi**2,
            ]
        )
        a_chi = np.array(
            [
                2.0 * sin_chi * cos_chi * (cos_w**2 - sin_w**2 / 2.0),
                -2.0 * sin_w * cos_w * (cos_chi**2 - sin_chi**2),
                -(sin_w**2) * sin_chi * cos_chi,
            ]
        )
        share = star.torque / self.mean
        late = {
            "wobble": self._late(share * self.per_rate * (a_wobble[1:] - share * a_wobble[0] * self.a[1:])),
            "chi": self._late(share * self.per_rate * (a_chi[1:] - share * a_chi[0] * self.a[1:])),
            "phase": by_psi - by_psi_0,
            "rate": by_psi * tau - 2.0 / star.rate * self.late,
            "torque": self._late(self.per_rate * self.a[1:]) / self.mean**2,
        }
        # dt/dtau with the varying torque, without it, and the difference.
        varying = -kappa * (self.delta + star.rate * by_psi)
        plainly = 1.0 + kappa * self.plain
        slowing = plainly - varying
        turning = b_psi / (2.0 * np.pi)
        speed = star.f0 + star.rate * turning
        found = {name: -kappa * speed / slowing * by for name, by in late.items()}
        found["wobble"] += b_wobble / (2.0 * np.pi)
        found["chi"] += b_chi / (2.0 * np.pi)
        found["phase"] += turning
        found["rate"] += turning * tau
        by_kappa = (
            -star.f0
            * (
                self.late / slowing
                + (tau**2 / 2.0 * varying + slowing * self.delta * (self.plain + self.delta / 2.0))
                / (slowing * plainly)
            )
            - star.rate * turning * (tau**2 / 2.0 + self.late) / slowing
        )
        found["f0"] = self.delta - kappa / star.f0 * by_kappa
        found["f1"] = -by_kappa / star.f0
        found["t"] = star.f0 * varying / (slowing * plainly) + star.rate * turning / slowing
        return found


class Wobble(PhaseComponent):
    """The phase that a wobble adds to a plain spin-down: free precession with the period WOBPERIOD, seen by its geometry and by the torque that varies with it.

    PINT's `Spindown` keeps F0, F1 and higher derivatives; the precession phase is that at PEPOCH. See docs/pint.md.

    Parameters supported:

    .. paramtable::
        :class: twofold.pint.Wobble
    """

    register = True
    category = "wobble"

    def __init__(self) -> None:
        super().__init__()
        one = u.Quantity(1)
        for name, units, value, description in (
            ("WOBBLE", "deg", 0.0, "Wobble angle of the symmetry axis to the angular momentum"),
            ("WOBCHI", "deg", None, "Angle of the magnetic axis to the symmetry axis"),
            ("WOBPERIOD", "day", None, "Period of the free precession at PEPOCH"),
            ("WOBPHASE", "deg", 0.0, "Precession phase psi at PEPOCH"),
            ("WOBTORQUE", "", 0.0, "Share of the braking torque that goes with sin^2 of the magnetic axis' angle to L"),
        ):
            self.add_param(
                floatParameter(name=name, units=units, value=value, description=description, tcb2tdb_scale_factor=one)
            )
        self.phase_funcs_component += [self.wobble_phase]
        self.phase_derivs_wrt_delay += [self.d_wobble_phase_d_delay]
        self._last: tuple[_Star, np.ndarray, _Beyond] | None = None

    def setup(self) -> None:
        super().setup()
        for name in self.params:
            self.register_deriv_funcs(self.d_wobble_phase_d_param, name)
        # The effect of the varying torque depends on F0 and F1, which are parameters of Spindown.
        for name in ("F0", "F1"):
            self.deriv_funcs[name] = [self.d_wobble_phase_d_param]

    def validate(self) -> None:
        super().validate()
        for name in self.params:
            if getattr(self, name).value is None:
                unit = self._unit(name)
                number = "a number without a unit" if unit == "1" else f"a number, in {unit}"
                raise MissingParameter("Wobble", name, f"{name} has no value: must be {number}")
        if "Spindown" not in self._parent.components or self._parent.PEPOCH.value is None:
            raise MissingParameter("Wobble", "PEPOCH", "PEPOCH has no value; WOBPHASE is the phase at this epoch")
        if not self.WOBPERIOD.value > 0.0:
            raise InvalidModelParameters(f"WOBPERIOD = {self.WOBPERIOD.value} d: must be above 0")
        if self.WOBBLE.value < 0.0:
            raise InvalidModelParameters(
                f"WOBBLE = {self.WOBBLE.value} deg: must be 0 or more; the same star has"
                f" WOBBLE = {-self.WOBBLE.value} deg and WOBPHASE = {(self.WOBPHASE.value + 180.0) % 360.0} deg"
            )
        self._star().check()

    def _unit(self, name: str) -> str:
        return str(getattr(self, name).units) or "1"

    def positive(self) -> None:
        """Normalises the star to a positive WOBBLE and WOBPHASE from 0 to 360 deg: a fit may end with a negative WOBBLE, which is one of the opposite
        phase."""
        if self.WOBBLE.value < 0.0:
            self.WOBBLE.value = -self.WOBBLE.value
            self.WOBPHASE.value = self.WOBPHASE.value + 180.0
        self.WOBPHASE.value = self.WOBPHASE.value % 360.0

    def _star(self) -> _Star:
        spin = self._parent.components["Spindown"]
        f1 = spin.F1.value if "F1" in spin.params and spin.F1.value is not None else 0.0
        period = float(self.WOBPERIOD.value) * DAY
        return _Star(
            f0=float(spin.F0.value),
            f1=float(f1),
            wobble=np.radians(float(self.WOBBLE.value)),
            chi=np.radians(float(self.WOBCHI.value)),
            rate=2.0 * np.pi / period if period else np.inf,
            phase=np.radians(float(self.WOBPHASE.value)),
            torque=float(self.WOBTORQUE.value),
        )

    def _beyond(self, toas: TOAs, delay: u.Quantity) -> _Beyond:
        """The previous result if neither the star nor the times have changed: PINT requests each derivative separately."""
        star, t = self._star(), _times(self._parent, toas, delay)
        if self._last is None or self._last[0] != star or not np.array_equal(self._last[1], t):
            star.check(t)
            self._last = star, t, _Beyond(star, t)
        return self._last[2]

    def wobble_phase(self, toas: TOAs, delay: u.Quantity) -> u.Quantity:
        """Turns in addition to those of Spindown."""
        return u.Quantity(self._beyond(toas, delay).turns, copy=False)

    def d_wobble_phase_d_param(self, toas: TOAs, param: str, delay: u.Quantity) -> u.Quantity:
        """Derivative of the phase by a parameter of this component, or by F0 or F1, for which Spindown contributes the other part."""
        of = self._beyond(toas, delay).derivatives
        if param == "WOBPERIOD":
            period = float(self.WOBPERIOD.value)
            return of["rate"] * (-2.0 * np.pi / DAY / period**2) << 1 / u.day
        angle = np.radians(1.0)
        match param:
            case "WOBBLE":
                return of["wobble"] * angle << 1 / u.deg
            case "WOBCHI":
                return of["chi"] * angle << 1 / u.deg
            case "WOBPHASE":
                return of["phase"] * angle << 1 / u.deg
            case "WOBTORQUE":
                return u.Quantity(of["torque"], copy=False)
            case "F0":
                return of["f0"] << u.s
            case "F1":
                return of["f1"] << u.s**2
        raise ValueError(f"{param}: must be one of {', '.join([*self.params, 'F0', 'F1'])}")

    def d_wobble_phase_d_delay(self, toas: TOAs, delay: u.Quantity) -> u.Quantity:
        """Derivative of the phase by the delay."""
        return -self._beyond(toas, delay).derivatives["t"] << 1 / u.s

    def __getstate__(self) -> dict:
        return {**self.__dict__, "_last": None}


def _times(model: TimingModel, toas: TOAs, delay: u.Quantity) -> np.ndarray:
    """Times (s) of emission since PEPOCH. A double resolves 1e-8 s, in which a wobble changes by 1e-16 of a turn."""
    epoch = model.PEPOCH.quantity.tdb.mjd_long
    since = (np.asarray(toas.table["tdbld"]) - epoch) * np.longdouble(DAY) - delay.to_value(u.s)
    return since.astype(float)


class _Projected:
    """Residuals and columns in standard deviations, with the free parameters of a model and its noise projected out.

    The noise that PINT represents by a basis with weights (ECORR, red noise) adds one unknown with a normal prior for each column: rows below those of the arrivals.
    """

    def __init__(self, model: TimingModel, toas: TOAs):
        if not np.all(toas.get_errors() > 0 * u.us):
            raise ValueError("toas: must be arrival times with errors above zero")
        self.sigma = model.scaled_toa_uncertainty(toas).to_value(u.s)
        matrix = np.asarray(model.designmatrix(toas)[0], float) / self.sigma[:, None]
        basis, weights = model.noise_model_designmatrix(toas), model.noise_model_basis_weight(toas)
        if basis is not None:
            if np.ndim(weights) != 1:
                raise ValueError(
                    "model: has noise with correlated amplitudes; the noise must have a weight for each column"
                )
            prior = np.diag(1.0 / np.sqrt(weights))
            below = np.hstack([np.zeros((len(weights), matrix.shape[1])), prior])
            matrix = np.vstack([np.hstack([matrix, basis / self.sigma[:, None]]), below])
        self.rows = matrix.shape[0]
        lengths = np.linalg.norm(matrix, axis=0)
        left, sizes, _ = np.linalg.svd(matrix / np.where(lengths > 0.0, lengths, 1.0), full_matrices=False)
        self.basis = left[:, sizes > 1e-13]
        self.delay = model.delay(toas)
        self.t = _times(model, toas, self.delay)
        self.f0 = float(model.F0.value)
        f1 = getattr(model, "F1", None)
        self.f1 = float(f1.value) if f1 is not None and f1.value is not None else 0.0
        self.residuals = self.project(Residuals(toas, model).time_resids.to_value(u.s))

    def project(self, seconds: np.ndarray) -> np.ndarray:
        column = np.zeros(self.rows)
        column[: len(self.sigma)] = np.asarray(seconds, float) / self.sigma
        # The projection is repeated to remove its rounding.
        for _ in range(2):
            column = column - self.basis @ (self.basis.T @ column)
        return column

    def star(self, period: float, chi: float, torque: float, wobble: float = 0.0, phase: float = 0.0) -> _Star:
        """A star with a period in days and angles in rad."""
        star = _Star(self.f0, self.f1, wobble, chi, 2.0 * np.pi / (period * DAY), phase, torque)
        star.check(self.t)
        return star

    def small(self, period: float, chi: float, torque: float) -> np.ndarray:
        """Two rows: the derivatives of the residuals by a small wobble `x = theta (cos psi_0, sin psi_0)`."""
        columns = []
        for phase in (0.0, np.pi / 2.0):
            star = self.star(period, chi, torque, phase=phase)
            columns.append(self.project(_Beyond(star, self.t).derivatives["wobble"] / self.f0))
        return np.array(columns)

    def chi_squared(self, stars: list[_Star]) -> np.ndarray:
        """Chi^2 with the full wobbles of some stars."""
        shifts = np.array([_Beyond(star, self.t).turns / self.f0 / self.sigma for star in stars])
        count = len(self.sigma)
        taken_up = shifts @ self.basis[:count]
        mixed = self.residuals @ self.residuals + 2.0 * shifts @ self.residuals[:count]
        return mixed + np.sum(shifts**2, axis=1) - np.sum(taken_up**2, axis=1)


def add_wobble(
    model: TimingModel,
    toas: TOAs | None = None,
    *,
    period: u.Quantity,
    chi: u.Quantity,
    torque: float = 0.0,
    wobble: u.Quantity | None = None,
    phase: u.Quantity | None = None,
    free: Iterable[str] = ("WOBBLE", "WOBPERIOD", "WOBPHASE"),
) -> Wobble:
    """Adds a wobble to a timing model and returns the component; the parameters `free` are fitted, the others are held fixed.

    Start values of `wobble` and `phase` that are not given are those which agree best with `toas`: of a small wobble by linear least squares beside all free parameters and the noise of the model, and of
    a grid of larger ones. The model must be phase-connected without the wobble.
    """
    days, angle = period.to_value(u.day), chi.to_value(u.rad)
    if "Wobble" in model.components:
        raise ValueError("model: must not have a Wobble component")
    if toas is None and (wobble is None or phase is None):
        raise ValueError("toas = None: give arrival times, or both wobble and phase")
    start = [None if given is None else given.to_value(u.rad) for given in (wobble, phase)]
    component = Wobble()
    component.WOBCHI.quantity, component.WOBPERIOD.quantity, component.WOBTORQUE.value = chi, period, torque
    free = list(free)
    for name in free:
        if name not in component.params:
            raise ValueError(f"free = {name}: must be one of {', '.join(component.params)}")
        getattr(component, name).frozen = False
    if None in start:
        if not days > 0.0:
            raise InvalidModelParameters(f"WOBPERIOD = {days} d: must be above 0")
        start = _start(_Projected(model, toas), days, angle, torque, *start)
    component.WOBBLE.quantity, component.WOBPHASE.quantity = (value * u.rad for value in start)
    model.add_component(component, validate=False)
    try:
        model.validate()
    except ValueError:
        model.remove_component("Wobble")
        raise
    return component


def _start(
    data: _Projected, days: float, chi: float, torque: float, wobble: float | None, phase: float | None
) -> tuple[float, float]:
    """The wobble and its phase (rad) that fit the data best."""
    most = min(chi, np.pi - chi)
    x = np.linalg.lstsq(data.small(days, chi, torque).T, -data.residuals, rcond=None)[0]
    linear = (float(np.hypot(*x)), float(np.arctan2(x[1], x[0]) % (2.0 * np.pi)))
    wobbles = np.geomspace(0.01, 0.9, 14) * most if wobble is None else [wobble]
    phases = np.arange(32) * np.pi / 16.0 if phase is None else [phase]
    candidates = [(a, b) for a in wobbles for b in phases]
    if wobble is None and phase is None and linear[0] < most:
        candidates.append(linear)
    found = data.chi_squared([data.star(days, chi, torque, *one) for one in candidates])
    return candidates[int(np.argmin(found))]


def wobble_limits(
    model: TimingModel,
    toas: TOAs,
    periods: u.Quantity,
    *,
    chi: u.Quantity = 45 * u.deg,
    torque: float = 0.0,
    probability: float = 0.95,
) -> dict[str, u.Quantity]:
    """Upper limits on the wobble from arrival times at some periods of precession: arrays `period`, `best` and `phase` (the wobble of least chi^2), `gain` (the decrease of chi^2 by it) and `limit`.

    The likelihood is that of PINT's generalised least squares, linearised: all free parameters of the model and its correlated noise are projected out, the noise with the amplitudes of the model. The limit
    is the quantile of the posterior of the wobble angle with a flat prior for it and for the phase; it is infinite where it or the wider standard deviation of the wobble is above 0.1 rad. `chi` and the share of the torque are held fixed.
    """
    if "Wobble" in model.components:
        raise ValueError("model: must not have a Wobble component")
    if not 0.0 < probability < 1.0:
        raise ValueError(f"probability = {probability}: must be above 0 and below 1")
    days = np.atleast_1d(periods.to_value(u.day))
    if not np.all(days > 0.0):
        raise ValueError(f"periods: {np.min(days)} d: must be above 0")
    data = _Projected(model, toas)
    rows = []
    for period in days:
        along, across = data.small(float(period), chi.to_value(u.rad), torque)
        found = twofold.wobble_posterior(along, across, data.residuals, confidence=probability)
        x, y = found["best"]
        rows.append((np.hypot(x, y), np.arctan2(y, x) % (2.0 * np.pi), found["gain"], found["limit"]))
    best, phase, gain, limit = np.array(rows).T
    return {
        "period": days * u.day,
        "best": best * u.rad,
        "phase": phase * u.rad,
        "gain": gain * u.one,
        "limit": limit * u.rad,
    }
