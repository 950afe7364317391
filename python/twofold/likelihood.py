"""The likelihood of arrival times, for samplers.

`TimingLikelihood` can be given to bilby directly, and so to dynesty and all its other samplers; without bilby it is a plain class with `log_likelihood(parameters)`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from twofold._twofold import Error, TimingData, TimingModel

try:
    from bilby import Likelihood as _Likelihood
except ImportError:
    _Likelihood = object

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["TimingLikelihood"]

#: Parameters on which only the widths of pulses depend.
_OF_WIDTHS = ("inclination", "inclination_rate", "rho")


class TimingLikelihood(_Likelihood):  # type: ignore[misc, valid-type]
    """The Gaussian likelihood of arrival times with independent errors.

    `parameters` of a call are values of a model's parameters (`TimingModel.names`) that replace those of `model`. F0 is the exception: `f0_offset` (Hz) is what is added to the model's, since a double of F0 itself is too coarse for decades of data.
    Widths of pulses in the data are not used.

    The pulses have the numbers of the data (`TimingData(numbers=...)`, `-pn` of a `.tim`) or `numbers`, and where these are not known those of the nearest turns of `model`; the numbers then stay fixed. So the model must be right to half a turn
    at the first pulse with a number, and at each without.

    `marginalised` names parameters on which the phase depends linearly to sufficient accuracy (`"phase"`, `"f0"`, `"f1"`, `"f2"`): they are integrated over exactly, with flat priors, and do not appear among the parameters. The sampler then has less work, with the same result. The width of the prior is left out, so that evidences can be compared only if the same parameters are marginalised.

    A parameter outside its range gives a log-likelihood of `-inf`.
    """

    def __init__(
        self,
        model: TimingModel,
        data: TimingData,
        *,
        numbers: ArrayLike | None = None,
        marginalised: Sequence[str] = (),
    ) -> None:
        super().__init__()
        for name in marginalised:
            if name not in ("phase", "f0", "f1", "f2"):
                raise Error(f'marginalised: {name!r} must be one of "phase", "f0", "f1" and "f2"')
        times, self._sigmas = data.times, data.sigmas
        if not len(times):
            raise Error("data: must have at least one arrival time")
        self.model, self.marginalised = model, tuple(marginalised)
        self._t, self._rest = np.ascontiguousarray(times[:, 0]), np.ascontiguousarray(times[:, 1])
        whole, fraction, derivatives = model.phase_and_derivatives(self._t, self._rest)
        given = np.array(data.numbers if numbers is None else numbers, dtype=float)
        known = ~np.isnan(given)
        if given.shape != self._t.shape or not np.array_equal(given[known], np.rint(given[known])):
            raise Error(f"numbers has the shape {given.shape}: must be {len(self._t)} whole numbers, NaN where one is not known")
        self.numbers = whole + np.rint(fraction)
        if known.any():
            # The numbers may start anywhere: the first known one belongs to the nearest turn.
            first = int(np.argmax(known))
            self.numbers[known] = given[known] + (self.numbers[first] - given[first])
        # The residuals are times.
        self._scale = 1.0 / (self._sigmas * model.phase_rate(self._t, self._rest))
        self._norm = -np.log(self._sigmas).sum() - len(self._t) / 2 * np.log(2 * np.pi)
        self._basis = np.zeros((len(self._t), 0))
        if self.marginalised:
            columns = derivatives[:, [TimingModel.names.index(name) for name in self.marginalised]] * self._scale[:, None]
            sizes = np.linalg.norm(columns, axis=0)
            self._basis, values, _ = np.linalg.svd(columns / sizes, full_matrices=False)
            if len(values) < len(sizes) or not values.min() > 1e-10 * values.max():
                raise Error(f"marginalised: {', '.join(self.marginalised)}: must be parameters that the arrival times determine")
            # The integral of exp(-chi^2/2) over the parameters.
            self._norm += len(sizes) / 2 * np.log(2 * np.pi) - np.log(values).sum() - np.log(sizes).sum()

    def __repr__(self) -> str:
        return f"<TimingLikelihood: {len(self._t)} arrivals, {self.model!r}>"

    def _moved(self, parameters: Mapping[str, float]) -> TimingModel:
        changes = {}
        for name, value in parameters.items():
            if name == "f0_offset":
                changes["f0"] = float(value)
            elif name == "f0":
                raise Error(f"f0 = {value!r}: use f0_offset (Hz) instead, which is added to F0 of the model")
            elif name in _OF_WIDTHS:
                raise Error(f"{name} = {value!r}: arrival times do not depend on it; expected one of {', '.join(self._allowed())}")
            elif name in TimingModel.names:
                changes[name] = float(value) - self.model[name]
            else:
                raise Error(f"{name} = {value!r}: the name must be one of {', '.join(self._allowed())}")
            if name.removesuffix("_offset") in self.marginalised:
                raise Error(f"{name} = {value!r}: it is marginalised; give only other parameters")
        return self.model.moved(**changes)

    def _allowed(self) -> list[str]:
        names = ["f0_offset" if name == "f0" else name for name in TimingModel.names if name not in _OF_WIDTHS]
        return [name for name in names if name.removesuffix("_offset") not in self.marginalised]

    def residuals(self, parameters: Mapping[str, float]) -> NDArray[np.float64]:
        """Residuals, measured less expected arrival times, in standard deviations, with nothing marginalised."""
        whole, fraction = self._moved(parameters).phase(self._t, self._rest)
        return ((whole - self.numbers) + fraction) * self._scale

    def log_likelihood(self, parameters: Mapping[str, float] | None = None) -> float:
        """The logarithm of the probability density of the data."""
        if parameters is None:
            parameters = getattr(self, "parameters", None) or {}
        try:
            residuals = self.residuals(parameters)
        except Error:
            # An invalid parameter name stays an error; a value outside its range has zero probability.
            self._check(parameters)
            return -np.inf
        if not np.isfinite(residuals).all():
            return -np.inf
        left = residuals - self._basis @ (self._basis.T @ residuals)
        return float(self._norm - left @ left / 2)

    def _check(self, parameters: Mapping[str, float]) -> None:
        for name in parameters:
            if name not in self._allowed():
                self._moved({name: parameters[name]})

    def noise_log_likelihood(self) -> float:
        """NaN: there is no model without a pulsar."""
        return np.nan

    def log_likelihood_ratio(self, parameters: Mapping[str, float] | None = None) -> Any:
        return self.log_likelihood(parameters)
