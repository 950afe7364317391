"""The rotation of spheroidal neutron stars under Lorentz violation.

>>> import twofold
>>> motion = twofold.Scene("tp-2").motion()
>>> motion.axis([0.0, 10.0]).shape
(2, 3)

Scenes, motions, pulsars, timing models, fits and sweeps, by the verified equations of the Rust library of the same name. Times are in the unit of the
scene (`t_c`, or seconds for a physical star); angles are in rad, arrays are of float64.

`twofold.units` accepts and returns quantities of astropy, `twofold.plot` draws with matplotlib, `twofold.pint` is a component of PINT's timing models,
`twofold.waves` provides waveforms for lalpulsar, `twofold.likelihood` likelihoods for samplers. Each needs the package that it works with.
"""

from twofold._twofold import (
    Error,
    Fit,
    Motion,
    Pulsar,
    Scene,
    Table,
    Timing,
    TimingData,
    TimingModel,
    __version__,
    fit_timing,
    kernels,
    wobble_limits,
    wobble_posterior,
)
from twofold.sweep import Sweep

__all__ = [
    "Error",
    "Fit",
    "Motion",
    "Pulsar",
    "Scene",
    "Sweep",
    "Table",
    "Timing",
    "TimingData",
    "TimingModel",
    "__version__",
    "fit_timing",
    "kernels",
    "wobble_limits",
    "wobble_posterior",
]
