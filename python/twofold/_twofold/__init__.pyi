"""
The compiled part of the package.
"""

from . import kernels as kernels
from _typeshed import Incomplete, SupportsGetItem
from collections.abc import Iterator
from numpy import float64
from numpy.typing import ArrayLike, NDArray
from os import PathLike
from types import MappingProxyType
from typing import Any, Final, SupportsFloat, SupportsIndex, final
from typing_extensions import disjoint_base

__version__: Final[str]
"""
Version of the package.
"""

@final
class Fit:
    """
    Estimates of unknown parameters: values, standard deviations, correlations. The result of `Scene.fisher` and, with residuals, of fits.
    """
    def __getitem__(self, name: str, /) -> tuple[float, float]:
        """
        The value of an unknown and its standard deviation.
        """
    def __repr__(self, /) -> str: ...
    @property
    def chi_squared(self, /) -> float | None:
        """
        The sum of the squares of the residuals in standard deviations. None for a Fisher matrix.
        """
    @property
    def covariance(self, /) -> NDArray[float64]:
        """
        The covariance of the unknowns.
        """
    @property
    def degrees(self, /) -> int | None:
        """
        Degrees of freedom: the number of data less that of unknowns.
        """
    @property
    def judged(self, /) -> str | None:
        """
        Whether the residuals are `"as stated"` by their errors, `"larger"` or `"smaller"`, at six standard deviations of chi^2.
        """
    @property
    def model(self, /) -> TimingModel | None:
        """
        The fitted model: a `TimingModel`. None for a fit of a scene's motion, which has only its values.
        """
    @property
    def nonlinearity(self, /) -> float | None:
        """
        Deviation of chi^2 from its parabola at one standard deviation: error bars are rough from 0.3 on.
        """
    @property
    def residuals(self, /) -> NDArray[float64] | None:
        """
        Residuals, measured less fitted, in standard deviations.
        """
    @property
    def sigmas(self, /) -> NDArray[float64]:
        """
        The standard deviations of the unknowns.
        """
    @property
    def undetermined(self, /) -> list[str]:
        """
        The combinations that the data do not determine, in words.
        """
    @property
    def units(self, /) -> dict:
        """
        The unit of each unknown, for its value and its standard deviation; `1` for a number without a unit.
        """
    @property
    def unknowns(self, /) -> list[str]:
        """
        The names of the unknowns.
        """
    @property
    def values(self, /) -> NDArray[float64]:
        """
        The values of the unknowns.
        """

@final
class Motion:
    """
    The motion of a scene's star: its state at any time of the span, by a call. Times are in the `time_unit` of the scene.
    """
    def __reduce__(self, /) -> tuple[Any, tuple]: ...
    def __repr__(self, /) -> str: ...
    def angles(self, /, t: ArrayLike) -> NDArray[float64]:
        """
        The Euler angles alpha, beta and gamma (rad), continuous (unwrapped) from the start: an array of shape (..., 3). NaN where the symmetry axis is on a pole.
        """
    def axis(self, /, t: ArrayLike) -> NDArray[float64]:
        """
        The symmetry axis `n` in the inertial frame: an array of shape (..., 3) for times of shape (...).
        """
    def error(self, /, t: ArrayLike) -> Any:
        """
        Estimated error of the components of `n`, `e_x` and of `L` in units of its size, for the initial state in doubles. The rounding of that state is not in it
        (docs/scenes.md): a last digit of its rates turns the star by 2.2e-16 of the angle of its rotation, 2e-6 rad after 1e10 rad, where the error can be 1e-11.
        """
    @property
    def method(self, /) -> str:
        """
        The method by which it is computed.
        """
    @property
    def scene(self, /) -> Scene:
        """
        The scene of the motion.
        """
    @property
    def span(self, /) -> tuple[float, float]:
        """
        First and last time.
        """
    def state(self, /, t: ArrayLike) -> tuple[NDArray[float64], NDArray[float64], NDArray[float64]]:
        """
        The symmetry axis `n`, the angular momentum `L` and the axis `e_x` of the body: three arrays of shape (..., 3). `L` is in I_xx/t_c in the paper's units, in g cm^2/s for a physical star.
        """

@final
class Pulsar:
    """
    The pulsar of a scene, computed by its phases, whose error grows only by the rounding of the rates: arrival times drift by at most 1.1e-15 of the time since the epoch (docs/pulsars.md). Times `t` are in seconds since the epoch of the scene (TDB at the barycentre).
    """
    def __reduce__(self, /) -> tuple[Any, tuple]: ...
    def __repr__(self, /) -> str: ...
    def arrivals(self, /, epochs: ArrayLike | None = None, *, derivatives: SupportsIndex | None = None, causes: bool = False) -> Timing:
        """
        The pulses nearest to `epochs` (MJD), or to the times of the scene, and a fit of F0 and the given number of `derivatives` to them: two for a scene with `[spin_down]`, which needs four
        different epochs or more, and none for others. With `causes` the table has the causes of the residuals.
        """
    @property
    def epoch(self, /) -> str:
        """
        Modified Julian date of the start (TDB), as a text.
        """
    @property
    def period(self, /) -> float:
        """
        Mean period of the pulses (s) at the epoch.
        """
    @property
    def precession_rates(self, /) -> list[float]:
        """
        Rates (rad/s) of the precession of the body about its axis and of its angular momentum. The first is that of `e_x` about `n` relative to the plane of `n` and `L`, positive in the right-handed sense; `precession_rate` of
        `timing_model()` is minus this, since its angle goes from the magnetic axis, which the body carries, to `L`; for a star of negative spin the timing model is that of `-n`, and its rate equals this. The second is positive where the angular momentum goes in the right-handed sense round the principal axis of `s^IJ` that it circles, directed so that its largest component is positive.
        """
    @property
    def scene(self, /) -> Scene:
        """
        The scene of the pulsar.
        """
    def timing_model(self, /) -> TimingModel:
        """
        The phase of the pulses in closed form, with derivatives by its parameters: for a star without Lorentz violation or with the motion of `L` that follows from it as a rate of the inclination.
        """
    def wave(self, /, t: ArrayLike) -> tuple[Any, Any]:
        """
        Strain `h_+` and `h_x` at times: two arrays. The scene needs `observer.distance`.
        """
    def wave_harmonics(self, /, t: ArrayLike) -> tuple:
        """
        The two harmonics of the wave at times, those of a star without a torque with the `L` and the wobble of each time: amplitudes `h_1` (once a turn) and `h_2` (twice), the phase `Phi` of the symmetry axis about `L` from the line of sight, from -pi to pi, and the inclination, position angle
        and wobble (rad): six arrays. With them `h_+' = -h_1 sin(2i)/2 cos(Phi) + h_2 (1 + cos^2 i)/2 cos(2 Phi)` and `h_x' = -h_1 sin i sin(Phi) + h_2 cos i sin(2 Phi)` along the projection of `L` on the sky. They are the whole `wave` without Lorentz violation. With it, they differ from it by about the ratio
        of the torque to the rotation, `C s / (I_xx Omega^2)`: for the scene `wave-source` at 20 Hz by `0.03 s` of the largest strain, at 200 Hz by `3e-4 s`.
        """

@final
class Scene:
    """
    A star, its initial motion, the coefficients for Lorentz violation, and what is observed: as in a scene file (docs/scenes.md).

    `Scene("tp-1")` is a built-in scene and `Scene("my-star.toml")` that of a file; `Scene(toml=text)` that of a text. Sections are keyword
    arguments: `Scene("tp-1", star={"spin": 1.2})` changes one number, `Scene("tp-1", pulsar=None)` removes a section, and a scene can be made of sections alone. Scenes are frozen, compare by their text and can be pickled.
    """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self, /) -> int: ...
    def __new__(cls, source: Any | None = None, /, *, toml: str | None = None, **sections: "object") -> Scene: ...
    def __reduce__(self, /) -> tuple[Any, tuple]: ...
    def __repr__(self, /) -> str: ...
    @staticmethod
    def _of_text(name: str, toml: str) -> Scene:
        """
        A scene from the name and text of another, for pickle.
        """
    @property
    def about(self, /) -> str:
        """
        A description of the scene, in one line.
        """
    @property
    def beam(self, /) -> tuple[float, float, float] | None:
        """
        The beam: the angle `chi` of the magnetic axis to the symmetry axis, its azimuth `delta` and the semi-open angle `rho` (rad); None for a scene without one.
        """
    @property
    def cautions(self, /) -> list[str]:
        """
        Warnings about input that is allowed but looks like a mistake.
        """
    @property
    def epoch(self, /) -> str | None:
        """
        Modified Julian date (TDB) of the start, as a text; None for a scene without one.
        """
    def fisher(self, /, observe: dict[str, SupportsFloat | SupportsIndex], parameters: SupportsGetItem[int, str] | None = None) -> Fit:
        """
        How well measurements of the scene would determine its parameters. `observe` has the standard deviation of each kind of data in the units of the scene, as
        `{"arrivals": 1e-4, "widths": 1e-4}`; kinds are arrivals, closest_approaches, widths, periods, h_plus, h_cross and strain. `parameters` are names (docs/inference.md); if none are given, those that such data can determine.
        """
    def fit(self, /, data: SupportsGetItem[int, Any], observe: dict[str, SupportsFloat | SupportsIndex], parameters: SupportsGetItem[int, str] | None = None) -> Fit:
        """
        Fits parameters of the scene to data: tables of `pulses()` and of `table(["h"])`, or paths of such files. `observe` and `parameters` are as for `fisher`; the fit starts from the values of the scene.
        """
    def lines(self, /, column: str, *, least: "SupportsFloat | SupportsIndex" = 1e-6, most: SupportsIndex = 50) -> Table:
        """
        The spectral lines of a column (`"m.n"`, `"h_plus"`), strongest first, down to the fraction `least` of the largest amplitude. Frequencies are in rad per
        `time_unit`, phases those at the start.
        """
    def motion(self, /, end: SupportsFloat | SupportsIndex | None = None, *, method: str | None = None, tolerance: SupportsFloat | SupportsIndex | None = None) -> Motion:
        """
        The motion from the start of the scene to the time `end`, its last one if none is given.
        """
    @property
    def name(self, /) -> str:
        """
        Where the scene comes from: a built-in name or a path.
        """
    @staticmethod
    def names() -> list[str]:
        """
        The names of the built-in scenes.
        """
    def plan(self, /, columns: SupportsGetItem[int, str] | None = None, *, method: str | None = None, tolerance: SupportsFloat | SupportsIndex | None = None) -> str:
        """
        The plan for groups of columns, or for those of the scene, in words: the method, its cost and error, and what is left out.
        """
    def pulsar(self, /) -> Pulsar:
        """
        The pulsar over decades: arrival times, its timing model, its wave. The scene needs `time.epoch`, `[observer]` and `[pulsar]`.
        """
    def pulses(self, /, *, method: str | None = None, tolerance: SupportsFloat | SupportsIndex | None = None, progress: Any | None = None) -> Table:
        """
        The pulses in the span of the scene, as `twofold pulses` writes them.
        """
    @property
    def span(self, /) -> tuple[float, float]:
        """
        First and last time, in `time_unit`.
        """
    def table(self, /, columns: SupportsGetItem[int, str] | None = None, *, method: str | None = None, tolerance: SupportsFloat | SupportsIndex | None = None, progress: Any | None = None) -> Table:
        """
        The table that `twofold run` writes, for groups of columns (`["angles", "e_z", "h"]`) or those of the scene.
        """
    @property
    def time_unit(self, /) -> str:
        """
        The unit of time: `t_c` in the paper's units, `s` for a physical star.
        """
    @property
    def toml(self, /) -> str:
        """
        The text of the scene file.
        """

@disjoint_base
class Sweep:
    """
    Many scenes: grids, lists and random draws over the parameters of one (docs/sweep.md). `Sweep("grid.toml")` reads a file, `Sweep(toml=text)` a text.

    A row depends only on its scene: any part can be computed anywhere, in one thread, and the parts together are the table to the byte.
    """
    def __eq__(self, other: object, /) -> bool: ...
    def __len__(self, /) -> int: ...
    def __new__(cls, path: Any | None = None, /, *, toml: str | None = None, _texts: tuple[str, str, tuple[str, str] | None] | None = None) -> Sweep: ...
    def __reduce__(self, /) -> tuple[Any, tuple]: ...
    def __repr__(self, /) -> str: ...
    @property
    def header(self, /) -> bytes:
        """
        The line of names at the head of the table, as CSV.
        """
    def rows(self, /, start: SupportsIndex, stop: SupportsIndex) -> tuple[bytes, bytes, int]:
        """
        The rows of the scenes from `start` to before `stop` as CSV, without the header, those of the table of errors, and the number of failed scenes; one thread is used.
        """
    def run(self, /, start: SupportsIndex = 0, stop: SupportsIndex | None = None) -> Table:
        """
        The table of the scenes from `start` to before `stop`, by one thread; of all if neither is given.
        """
    @property
    def toml(self, /) -> str:
        """
        The text of the sweep file.
        """

@final
class SweepFile:
    """
    The table of a sweep in a file that grows in order, with a journal beside it, as `twofold sweep` writes it; either can continue what the other has begun.
    """
    def __new__(cls, /, sweep: Sweep, out: str | PathLike[str], *, replace: bool = False) -> SweepFile:
        """
        Begins a table at `out`, or continues an existing part of it. A file that exists is refused unless it may be replaced.
        """
    def append(self, /, stop: SupportsIndex, rows: bytes, errors: bytes, failed: SupportsIndex) -> None:
        """
        Appends the rows that `Sweep.rows` gives for the scenes from `next` to before `stop`, so that they outlive the process.
        """
    def complete(self, /) -> None:
        """
        Gives the complete table its name, and that of errors if there are any.
        """
    @property
    def next(self, /) -> int:
        """
        The first scene that is not in the table.
        """

@final
class Table:
    """
    A table of numbers, a column for each name. A missing number is NaN.

    `table["beta"]` is an array, `table.units["beta"]` its unit, `table.csv` the bytes that the command would write; `dict(table)` has all columns. polars and pyarrow
    read it by the Arrow PyCapsule interface, as `polars.DataFrame(table)`, and so does pandas where pyarrow is installed, as `pandas.DataFrame.from_arrow(table)`.
    """
    def __arrow_c_stream__(self, /, requested_schema: Any | None = None) -> Any:
        """
        The table as an Arrow stream. A `requested_schema` is not followed: consumers cast.
        """
    def __contains__(self, name: str, /) -> bool: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __getitem__(self, name: str, /) -> Any:
        """
        A column: an array of float64, or a list of words.
        """
    def __iter__(self, /) -> Iterator: ...
    def __len__(self, /) -> int: ...
    def __new__(cls, /, csv: bytes) -> Table:
        """
        A table from the bytes of `csv`.
        """
    def __reduce__(self, /) -> tuple[Any, tuple[bytes]]: ...
    def __repr__(self, /) -> str: ...
    @property
    def csv(self, /) -> bytes:
        """
        Comma-separated values, as the command writes them.
        """
    def keys(self, /) -> list[str]:
        """
        The names of the columns.
        """
    @property
    def units(self, /) -> dict:
        """
        The unit of each column.
        """

@final
class Timing:
    """
    Arrival times and their residuals from a fitted frequency.
    """
    def __repr__(self, /) -> str: ...
    @property
    def dark(self, /) -> int:
        """
        Epochs without a pulse.
        """
    @property
    def derivatives(self, /) -> list[float]:
        """
        F1 (Hz/s) and F2 (Hz/s^2), as many as were fitted.
        """
    @property
    def epoch(self, /) -> str:
        """
        PEPOCH (MJD), as a text.
        """
    @property
    def frequency(self, /) -> list[float]:
        """
        F0 (Hz) at `epoch`, the sum of two doubles.
        """
    @property
    def par(self, /) -> str:
        """
        The `.par` of the fit.
        """
    @property
    def table(self, /) -> Table:
        """
        Number, arrival time, residual, width, position angle and wave of each pulse.
        """
    def tim(self, /, uncertainty: "SupportsFloat | SupportsIndex" = 1e-6) -> str:
        """
        The `.tim` (FORMAT 1, barycentre), with an uncertainty (s) for all.
        """

@final
class TimingData:
    """
    Arrival times and pulse widths with independent errors. Times and standard deviations are in seconds, times since the epoch of the model.

    `TimingData(times, sigmas)` are arrivals; `rest` is the small part of times that need two doubles, `numbers` has the numbers of the pulses, NaN where one is not known.
    `TimingData(width_times=..., widths=..., width_sigmas=...)` are widths.
    """
    def __eq__(self, other: object, /) -> bool: ...
    def __new__(cls, /, times: ArrayLike | None = None, sigmas: ArrayLike | None = None, *, rest: ArrayLike | None = None, numbers: ArrayLike | None = None, width_times: ArrayLike | None = None, widths: ArrayLike | None = None, width_sigmas: ArrayLike | None = None) -> TimingData: ...
    def __reduce__(self, /) -> tuple[Any, tuple]: ...
    def __repr__(self, /) -> str: ...
    @property
    def numbers(self, /) -> NDArray[float64]:
        """
        Numbers of the pulses, NaN where they are not known.
        """
    @staticmethod
    def read(paths: SupportsGetItem[int, str | PathLike[str]], epoch: Any, *, model: TimingModel | None = None, observe: str | None = None) -> TimingData:
        """
        The data of files: a `.tim` (FORMAT 1, barycentred), or tables as `Pulsar.arrivals` gives them, with the standard deviations in `observe`, as `"arrivals:1e-6,widths:1e-5"` (s). Times
        are counted from the epoch of a model (MJD, TDB). Each file numbers its pulses from its own first: where more than one has numbers, `model` is the
        timing model by which they are matched.
        """
    @property
    def sigmas(self, /) -> NDArray[float64]:
        """
        Standard deviations of the arrivals (s).
        """
    @property
    def times(self, /) -> NDArray[float64]:
        """
        Times of the arrivals (s): an array of shape (n, 2), two parts each.
        """
    @property
    def widths(self, /) -> NDArray[float64]:
        """
        Widths: an array of shape (n, 3) of their times, the widths and their standard deviations (s).
        """

@final
class TimingModel:
    """
    A pulsar by its timing parameters (docs/timing-model.md). `TimingModel(f0, f1=..., wobble=..., chi=...)`: F0 in Hz, the others in SI units and rad. Those not given are zero, but chi and inclination are
    a right angle. F0 is the sum of two doubles, `f0 + f0_rest`.

    Times are in seconds since the epoch, the sum of two doubles `t + rest`; arrays of any shape are taken.
    """
    names: Final[tuple]
    """
    The names of the parameters, in the order of derivatives.
    """
    units: Final[MappingProxyType]
    """
    The unit of each parameter. It cannot be changed.
    """
    def __eq__(self, other: object, /) -> bool: ...
    def __getitem__(self, name: str, /) -> float:
        """
        The value of a parameter.
        """
    def __new__(cls, /, f0: SupportsFloat | SupportsIndex, f0_rest: "SupportsFloat | SupportsIndex" = 0.0, **parameters: "float") -> TimingModel: ...
    def __reduce__(self, /) -> tuple[Any, tuple]: ...
    def __repr__(self, /) -> str: ...
    def arrival(self, /, number: ArrayLike) -> tuple[Any, Any]:
        """
        The arrival times of the pulses with given numbers: two arrays whose sum is the time.
        """
    @property
    def frequency(self, /) -> list[float]:
        """
        F0 (Hz), the sum of two doubles.
        """
    def moved(self, /, **changes: "float") -> TimingModel:
        """
        The model with increments added to some parameters. F0 keeps 32 digits, so that small changes add up.
        """
    def phase(self, /, t: ArrayLike, rest: ArrayLike | None = None) -> tuple[Any, Any]:
        """
        The phase at times: whole turns and the fraction of a turn, two arrays. A pulse is where the fraction is zero.
        """
    def phase_and_derivatives(self, /, t: ArrayLike, rest: ArrayLike | None = None) -> tuple[Any, Any, Any]:
        """
        The phase as from `phase`, and its derivatives (turns per unit of each parameter): an array of shape (..., 13).
        """
    def phase_rate(self, /, t: ArrayLike, rest: ArrayLike | None = None) -> Any:
        """
        The rate of the phase at times (Hz): if the phase is off by `x` turns, the pulse is late by `x` over this rate.
        """
    def width(self, /, t: ArrayLike) -> Any:
        """
        The widths of pulses (s) near times.
        """

def fit_timing(model: TimingModel, data: TimingData, unknowns: SupportsGetItem[int, str], *, priors: dict | None = None) -> Fit:
    """
    Fits a timing model to data. `unknowns` are names from `TimingModel.names`; `priors` gives a mean and a standard deviation of some, as `{"chi": (1.2, 0.05)}`.
    """

def wobble_limits(model: TimingModel, data: TimingData, unknowns: SupportsGetItem[int, str], periods: ArrayLike, *, confidence: "SupportsFloat | SupportsIndex" = 0.95) -> dict:
    """
    Upper limits on the wobble at some precession periods (s), for a model that was fitted to the arrival times without a wobble by the `unknowns`. A dict of arrays: `period` (s), the `best` wobble (rad), the `gain` (the decrease of chi^2 by it), and the `limit` (rad) that is not exceeded with the probability `confidence`; infinite where the data do not limit it. chi and the torque share are those of the model.
    """

def wobble_posterior(along: ArrayLike, across: ArrayLike, residuals: ArrayLike, *, confidence: "SupportsFloat | SupportsIndex" = 0.95) -> dict:
    """
    The posterior of a small wobble `x = theta (cos psi_0, sin psi_0)` (rad) in which the residuals are linear: `residuals + along x[0] + across x[1]`, in standard deviations and with the other unknowns projected out. A dict: the `best` x, the `gain` (the decrease of chi^2 by it), and the `limit` on theta that is not exceeded with the probability `confidence`, with a flat prior for theta and psi_0; infinite where it or the wider standard deviation of the wobble is above 0.1 rad.
    """

def __getattr__(name: str) -> Incomplete: ...
