"""Figures with matplotlib, in the style of the command's figures.

Every function takes a scene, a motion or arrival times and returns the `Axes` it drew on, for further changes: `angles(scene)`, `sphere(motion)`, `pulses(scene)`,
`waterfall(scene)`, `spectrum(scene, "m.n")`, `arrivals(timing)`. It draws on `axes` if these are given; otherwise it makes a figure of the width of a journal's column or page.

>>> import matplotlib.pyplot as plt
>>> from twofold import Scene, plot
>>> plt.rcParams.update(plot.style())
>>> alpha, beta = plot.angles(Scene("tp-2"), until=30.0)

The functions set sizes, colours and lines, but not fonts: `plot.style()` has the fonts of the command's figures.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

try:
    import matplotlib.pyplot as plt
    from matplotlib import font_manager, ticker
    from matplotlib.axes import Axes
    from matplotlib.colors import LinearSegmentedColormap
    from matplotlib.patches import Circle
    from matplotlib.patheffects import withStroke
except ImportError as error:
    raise ImportError(f"twofold.plot needs matplotlib ({error}): pip install 'twofold[plot]'") from error

from twofold._twofold import Error, Motion, Scene, Timing

__all__ = ["COLUMN", "PAGE", "angles", "arrivals", "frame", "pulses", "spectrum", "sphere", "style", "waterfall"]

Numbers = NDArray[np.float64]

#: Width of a column of a journal and of both (inches).
COLUMN, PAGE = 8.6 / 2.54, 17.8 / 2.54

# Colours of Okabe and Ito, distinguishable without red-green vision. Line styles carry the same information.
BLACK, GREY, LIGHT = "#000000", "#8c8c8c", "#c8c8c8"
GREEN, BLUE = "#009e73", "#0072b2"
VERMILION, PURPLE = "#d55e00", "#cc79a7"

_LABEL, _SMALL = 9.0, 8.0
_DASHED: Any = (0, (5, 2.5))
_DOTTED: Any = (0, (1.2, 1.8))
_FONTS = ["Arimo", "Liberation Sans", "Arial", "Helvetica", "DejaVu Sans"]
_SHADES = LinearSegmentedColormap.from_list("twofold", ["#ffffff", "#9ecae8", BLUE, "#00263d"])


def style() -> dict[str, Any]:
    """Fonts of the command's figures, for `matplotlib.rcParams.update` or `matplotlib.rc_context`: the first of its fonts that is installed, for words and formulas."""
    installed = set(font_manager.get_font_names())
    family = next((name for name in _FONTS if name in installed), "sans-serif")
    return {
        "font.family": "sans-serif",
        "font.sans-serif": [family, "DejaVu Sans"],
        "font.size": _LABEL,
        "mathtext.fontset": "custom",
        "mathtext.rm": family,
        "mathtext.it": f"{family}:italic",
        "mathtext.bf": f"{family}:bold",
        **dict.fromkeys(("mathtext.cal", "mathtext.sf", "mathtext.tt"), family),
        "mathtext.bfit": f"{family}:bold",
        "savefig.dpi": 300,
    }


def angles(
    scene: Scene,
    *,
    names: Sequence[str] = ("alpha", "beta"),
    until: float | None = None,
    samples: int = 1001,
    perturbation: bool | None = None,
    axes: Sequence[Axes] | None = None,
) -> list[Axes]:
    """The Euler angles of a scene against time, one panel each.

    With `perturbation` the paper's solution, Eq. (33) as printed, is drawn too; by default it is drawn if the scene gives the constants of that solution. `until` is the last time, that
    of the scene if none is given.
    """
    allowed = ("alpha", "beta", "gamma")
    for name in names:
        if name not in allowed:
            raise Error(f"names: `{name}` must be one of {', '.join(allowed)}")
    shown = _sampled(scene, until, samples)
    if perturbation is None:
        try:
            table = shown.table(["angles", "perturbation"])
        except Error:
            table = shown.table(["angles"])
    else:
        table = shown.table(["angles", "perturbation"] if perturbation else ["angles"])
    panels = _panels(axes, len(names), COLUMN, 1.25)
    t = table["t"]
    for panel, name in zip(panels, names, strict=True):
        panel.plot(t, table[name], color=BLACK, lw=0.9, label="motion", zorder=2)
        if f"{name}_printed" in table:
            printed = table[f"{name}_printed"]
            panel.plot(t, printed, color=VERMILION, lw=1.1, ls=_DASHED, label="perturbation, printed", zorder=3)
        panel.set_ylabel(rf"$\{name}$ [rad]", fontsize=_LABEL)
    _time_axis(panels, scene.time_unit, (t[0], t[-1]))
    if len(panels[0].lines) > 1:
        _legend(panels[0])
    return panels


def sphere(
    motion: Motion,
    *,
    until: float | None = None,
    samples: int = 4001,
    equatorial: float | None = None,
    view: tuple[float, float] = (35.0, 25.0),
    axes: Axes | None = None,
) -> Axes:
    """The paths of the symmetry axis n and of the direction of the angular momentum L on the unit sphere, with arrows where they start.

    The eye is far away at azimuth and elevation `view` (degrees); paths are pale on the far side. `equatorial` also draws the axis e_x of the body, for that length of time.
    """
    if samples < 2:
        raise Error(f"samples = {samples}: must be a whole number of at least 2")
    start, end = motion.span
    end = end if until is None else until
    n, momentum, _ = motion.state(np.linspace(start, end, samples))
    length = np.linalg.norm(momentum, axis=1, keepdims=True)
    if not (length > 0.0).all():
        raise Error("motion: the star must rotate; at rest its angular momentum has no direction")
    if axes is None:
        _, axes = plt.subplots(figsize=(COLUMN, COLUMN), layout="constrained")
    azimuth, elevation = np.radians(view)
    (sa, ca), (se, ce) = ((np.sin(x), np.cos(x)) for x in (azimuth, elevation))
    page = np.array([[-sa, ca, 0.0], [-se * ca, -se * sa, ce]])
    towards = np.array([ce * ca, ce * sa, se])

    def path(points: Numbers, front: dict[str, Any], back: dict[str, Any]) -> None:
        at, seen = points @ page.T, points @ towards >= 0.0
        for side, line in ((~seen, back), (seen, front)):
            # Each piece includes the first point of the next one, so that there is no gap.
            side = side | np.append(False, side[:-1])
            axes.plot(*np.where(side[:, None], at, np.nan).T, solid_capstyle="round", **line)

    axes.add_patch(Circle((0.0, 0.0), 1.0, facecolor="#fafafa", edgecolor=GREY, lw=0.6, zorder=0))
    turn = np.linspace(0.0, 2.0 * np.pi, 241)
    for u, v in ((0, 1), (0, 2), (1, 2)):
        circle = np.zeros((turn.size, 3))
        circle[:, u], circle[:, v] = np.cos(turn), np.sin(turn)
        path(circle, {"color": LIGHT, "lw": 0.5}, {"color": LIGHT, "lw": 0.4, "ls": _DASHED})
    for k, name in enumerate("XYZ"):
        tip = page[:, k]
        axes.plot([0.0, tip[0]], [0.0, tip[1]], color=GREY, lw=0.6, ls=_DASHED)
        _arrow(axes, tip, 1.22 * tip, "#404040", 0.7)
        size = float(np.hypot(*tip))
        beyond = 7.0 * tip / size if size > 0.05 else np.array([6.0, 6.0])
        _name(axes, 1.22 * tip, f"${name}$", "#404040", (beyond[0], beyond[1]))

    drawn: list[tuple[Numbers, str, str, tuple[float, float]]] = []
    if equatorial is not None:
        e_x = motion.state(np.linspace(start, start + equatorial, samples))[2]
        path(e_x, {"color": GREEN, "lw": 0.6}, {"color": "#9fd4c4", "lw": 0.6})
        drawn.append((e_x[0], GREEN, r"$\mathbf{e}_x$", (-4.0, -11.0)))
    path(n, {"color": BLUE, "lw": 1.1, "label": "n"}, {"color": "#94bcd9", "lw": 1.1})
    drawn.append((n[0], BLUE, r"$\mathbf{n}$", (-9.0, -7.0)))
    spin = momentum / length
    path(spin, {"color": VERMILION, "lw": 1.6, "label": "L"}, {"color": "#eeb48c", "lw": 1.6})
    drawn.append((spin[0], VERMILION, r"$\mathbf{L}$", (10.0, 2.0)))
    for head, colour, name, offset in drawn:
        tip = page @ head
        _arrow(axes, np.zeros(2), tip, colour, 1.4)
        _name(axes, tip, name, colour, offset)
    axes.set_aspect("equal")
    tips = 1.22 * page
    axes.set_xlim(min(-1.03, tips[0].min() - 0.12), max(1.03, tips[0].max() + 0.12))
    axes.set_ylim(min(-1.03, tips[1].min() - 0.12), max(1.03, tips[1].max() + 0.12))
    axes.set_axis_off()
    return axes


def pulses(scene: Scene, *, axes: Sequence[Axes] | None = None) -> list[Axes]:
    """The periods of the pulses of a scene, from midpoint to midpoint, and their lengths, against time.

    Lines join pulses of consecutive turns, and break at a turn without a pulse, where there is no period. Pulses of a second beam are
    rings. Pulsars over years, of which not every pulse can be listed, are drawn by `arrivals`.
    """
    table = scene.pulses()
    panels = _panels(axes, 2, COLUMN, 1.25)
    whole = np.array([cut == "" for cut in table["cut"]])
    if not whole.any():
        raise Error(f"scene {scene.name}: it has no whole pulse in its span")
    for beam in (1, 2):
        of = whole & (table["beam"] == beam)
        if not of.any():
            continue
        t, turn = table["midpoint"][of], table["turn"][of]
        # In reverse order if the span is backwards.
        follows = np.abs(np.diff(turn)) == 1.0
        period = np.where(np.append(False, follows), table["period"][of], np.nan)
        filled: dict[str, Any] = {"color": BLACK, "markersize": 3.0, "markeredgewidth": 0.8, "ls": "none", "marker": "o"}
        if beam == 2:
            filled |= {"markerfacecolor": "#ffffff"}
        for panel, values in zip(panels, (period, table["duration"][of]), strict=True):
            joined_t, joined = _broken(t, values, ~follows)
            panel.plot(joined_t, joined, color=GREY, lw=0.5, zorder=2)
            panel.plot(t, values, zorder=3, label=f"beam {beam}", **filled)
    unit = _unit(scene.time_unit)
    for panel, name in zip(panels, ("period", "length"), strict=True):
        panel.set_ylabel(f"{name} {unit}", fontsize=_LABEL)
    _time_axis(panels, scene.time_unit, scene.span)
    if (table["beam"] == 2).any():
        _legend(panels[0])
    return panels


def waterfall(
    scene: Scene,
    *,
    rows: int = 200,
    window: tuple[float, float] | None = None,
    samples: int = 301,
    intensity: Callable[[Numbers], Numbers] | None = None,
    axes: Axes | None = None,
) -> Axes:
    """The shapes of pulses as shades, later turns above earlier ones.

    A pulsar with a `time.epoch` is shown over the years of the scene, at `rows` of its epochs, against the time from the pulse that the fit of its frequency predicts; one with
    `spin_down.damping_time` is not, since its shapes change with the wobble. Other scenes are shown turn by turn, folded with their mean period. `window` is the first and last time shown of a turn, in the unit of the scene; if it is not given the pulses fill two thirds of it, or
    it is a turn.

    `intensity` is the intensity of the beam as a function of the angle from its axis, in units of `pulsar.rho`; by default a Gaussian that falls to a tenth at the edge, so that the pulse is as
    wide as `duration` at a tenth of the brightest. The model defines only the edge of the beam, not its profile.
    """
    for name, value, least in (("rows", rows, 2), ("samples", samples, 2)):
        if value < least:
            raise Error(f"{name} = {value}: must be a whole number of at least {least}")
    if window is not None and not window[0] < window[1]:
        raise Error(f"window = {window}: must be the earlier time, then the later one")
    pulsar = scene.pulsar() if "epoch" in tomllib.loads(scene.toml)["time"] else None
    if pulsar is None:
        first, period, count = _turns(scene)
        earliest, latest = window or (-period / 2.0, period / 2.0)
        x = np.linspace(earliest, latest, samples)
        lines = np.sign(count) * np.arange(min(abs(count), rows), dtype=float)
        times = first + period * lines[:, None] + x
        heights = lines
    else:
        if "damping_time" in tomllib.loads(scene.toml).get("spin_down", {}):
            raise Error(f"scene {scene.name}: spin_down.damping_time cannot be used here; the star must be without friction, so that its wobble stays as it is")
        timing = pulsar.arrivals()
        chosen = np.unique(np.linspace(0, len(timing.table) - 1, rows).round().astype(int))
        residual, number = timing.table["residual"][chosen], timing.table["pulse"][chosen]
        heights = (timing.table["arrival_day"] + timing.table["arrival_fraction"])[chosen]
        half = 1.5 * (np.abs(residual).max() + timing.table["duration"].max() / 2.0)
        earliest, latest = window or (-half, half)
        x = np.linspace(earliest, latest, samples)
        # A torque along L only stretches time: the pulses of the star that does not slow down have the same shapes.
        unbraked = Scene(toml=scene.toml, spin_down=None)
        steady = unbraked.pulsar()
        found = steady.arrivals(float(steady.epoch) + number * (steady.period / 86400.0)).table
        if len(found) == len(number):
            # Whether the date of a whole phase is nearer to the pulse of its number or to the next one depends on the phase of the first one.
            dates = found["arrival_day"] + found["arrival_fraction"] + (number - found["pulse"]) * (steady.period / 86400.0)
            found = steady.arrivals(dates).table
        if not np.array_equal(found["pulse"], number):
            raise Error(f"scene {scene.name}: pulses of the same numbers are not found without spin-down")
        since = (found["arrival_day"] - float(steady.epoch)) * 86400.0 + found["arrival_fraction"] * 86400.0
        times = since[:, None] + scene.span[0] + x - residual[:, None]
        scene = unbraked
    edge = _beam_edge(scene)
    shape = times.shape
    flat = times.ravel()
    order = np.argsort(flat, kind="stable")
    values = np.empty(flat.size)
    values[order] = _along_line_of_sight(scene, flat[order])
    angle = np.arccos(np.clip(values.reshape(shape), -1.0, 1.0)) / edge
    light = np.asarray(10.0 ** -(angle**2) if intensity is None else intensity(angle), dtype=float)
    if light.shape != shape:
        raise Error(f"intensity has the shape {light.shape}: must have the shape {shape}")

    if axes is None:
        _, axes = plt.subplots(figsize=(COLUMN, 1.1 * COLUMN), layout="constrained")
    factor, unit = (1.0, _unit(scene.time_unit)) if pulsar is None else _scaled(np.abs(x).max())
    mesh = axes.pcolormesh(x * factor, heights, light, cmap=_SHADES, vmin=0.0, shading="nearest", rasterized=True)
    bar = axes.figure.colorbar(mesh, ax=axes, pad=0.02, aspect=30)
    bar.set_label("intensity", fontsize=_LABEL)
    bar.ax.tick_params(labelsize=_SMALL, width=0.6, length=3.0)
    bar.outline.set_linewidth(0.6)
    if pulsar is None:
        axes.set_xlabel(rf"$t$ from the mean turn {unit}", fontsize=_LABEL)
        axes.set_ylabel("turn", fontsize=_LABEL)
    else:
        axes.set_xlabel(f"time from the predicted pulse {unit}", fontsize=_LABEL)
        axes.set_ylabel("date [MJD]", fontsize=_LABEL)
    frame(axes, minor=False)
    axes.tick_params(which="both", top=False, right=False, direction="out")
    return axes


def spectrum(
    scene: Scene,
    column: str,
    *,
    least: float = 1e-5,
    most: int = 200,
    named: int = 8,
    around: float = 0.0,
    span: tuple[float, float] | None = None,
    axes: Axes | None = None,
) -> Axes:
    """The spectral lines of a column (`"m.n"`, `"h_plus"`) as vertical lines, the `named` strongest labelled with their combination of the fundamental frequencies.

    Lines down to an amplitude of `least` of the largest one are drawn, at most `most`. Frequencies are angular, per `time_unit`, less `around`; `span` are the first and last shown.
    A label that has no room beside those of stronger lines is left out.
    """
    table = scene.lines(column, least=least, most=most)
    if len(table) == 0:
        raise Error(f"column = {column!r}: it is constant in scene {scene.name} and has no lines")
    x, height = table["frequency"] - around, table["amplitude"]
    if span is not None and not span[0] < span[1]:
        raise Error(f"span = {span}: must be the lower frequency, then the higher one")
    low, high = span or ((-0.02 * x.max(), 1.06 * x.max()) if around == 0.0 else _with_room(x))
    shown = (x >= low) & (x <= high)
    if not shown.any():
        raise Error(f"span = {span}: no line lies in it; the lines are from {x.min():.6g} to {x.max():.6g}")
    if axes is None:
        _, axes = plt.subplots(figsize=(PAGE, 2.3), layout="constrained")
    foot = 10.0 ** np.floor(np.log10(least * height.max()))
    axes.set_yscale("log")
    axes.vlines(x[shown], foot, height[shown], color=BLACK, lw=0.9)
    axes.set_xlim(low, high)
    # Room for names: half of the height of the lines.
    axes.set_ylim(foot, height.max() * (height.max() / foot) ** 0.45)
    where = [(place, k) for k, place in enumerate(x) if shown[k]][: max(named, 0)]
    # A name needs 8 points of width.
    apart = 0.11 * (high - low) * axes.figure.dpi / axes.bbox.width
    taken: list[float] = []
    for place, k in where:
        room = all(abs(place - other) > apart for other in taken)
        taken.append(place)
        if room:
            axes.annotate(
                _combination(table["combination"][k]), (place, height[k]), xytext=(0, 3),
                textcoords="offset points", rotation=90, ha="center", va="bottom", fontsize=_SMALL,
            )  # fmt: skip
    axes.set_ylabel(f"amplitude of {_COLUMNS.get(column, column)}", fontsize=_LABEL)
    less = "" if around == 0.0 else f" less {around:.10g}"
    in_tc = scene.time_unit == "t_c"
    axes.set_xlabel(
        rf"angular frequency{less} $\times$ $t_\mathrm{{c}}$" if in_tc else f"angular frequency{less} [rad/s]",
        fontsize=_LABEL,
    )
    frame(axes)
    axes.yaxis.set_major_locator(ticker.LogLocator(numticks=8))
    axes.yaxis.set_minor_locator(ticker.NullLocator())
    return axes


def arrivals(timing: Timing, *, axes: Sequence[Axes] | None = None) -> list[Axes]:
    """Residuals of arrival times against the date, and the lengths of the pulses.

    With `Pulsar.arrivals(causes=True)` the causes of the residuals are drawn too. Small causes are enlarged by the factor in their label; one below a thousandth of the residuals is
    left out.
    """
    table = timing.table
    panels = _panels(axes, 2, PAGE, 1.6)
    date = table["arrival_day"] + table["arrival_fraction"]
    residual = table["residual"]
    factor, unit = _scaled(np.abs(residual).max())
    panels[0].axhline(0.0, color=LIGHT, lw=0.5, zorder=1)
    looks: dict[str, dict[str, Any]] = {
        "torque": {"color": "#f2b48c", "lw": 3.0},
        "geometry": {"color": BLUE, "lw": 1.1, "ls": _DASHED},
        "violation": {"color": PURPLE, "lw": 1.1, "ls": _DOTTED},
    }
    for name, look in looks.items():
        if name not in table:
            continue
        part = np.abs(table[name]).max() / np.abs(residual).max()
        if not part >= 1e-3:
            continue
        enlarged = 1.0 if part > 0.1 else _round_factor(0.3 / part)
        label = name if enlarged == 1.0 else rf"{name} $\times$ {enlarged:g}"
        panels[0].plot(date, enlarged * factor * table[name], label=label, zorder=2, **look)
    panels[0].plot(date, factor * residual, color=BLACK, lw=0.8, label="residual", zorder=3)
    panels[0].set_ylabel(f"residual {unit}", fontsize=_LABEL)
    if len(panels[0].lines) > 2:
        _legend(panels[0])
    factor, unit = _scaled(np.nanmax(table["duration"]))
    panels[1].plot(date, factor * table["duration"], color=BLACK, lw=1.1)
    panels[1].set_ylabel(f"pulse length {unit}", fontsize=_LABEL)
    for panel in panels:
        frame(panel)
        panel.set_xlim(date.min(), date.max())
        panel.tick_params(labelbottom=panel is panels[-1])
    panels[-1].set_xlabel("date [MJD]", fontsize=_LABEL)
    panels[-1].ticklabel_format(axis="x", useOffset=False)
    return panels


_COLUMNS = {
    "m.n": r"$\mathbf{m} \cdot \mathbf{n}$", "h_plus": "$h_+$", "h_cross": r"$h_\times$", "beta": r"$\beta$",
    "cos_lambda": r"$\cos\lambda$", "Theta": r"$\Theta$",
}  # fmt: skip


def _combination(text: str) -> str:
    """`alpha' - 2 l'` as a formula, without the primes of rates."""
    return "$" + re.sub(r"\b(alpha|gamma|nu|psi)\b", r"\\\1", text.replace("'", "")) + "$"


def _sampled(scene: Scene, until: float | None, samples: int) -> Scene:
    """The scene with other times."""
    if samples < 2:
        raise Error(f"samples = {samples}: must be a whole number of at least 2")
    start, end = scene.span
    until = end if until is None else until
    if until == start:
        raise Error(f"until = {until}: must be another time than the start of the scene")
    times = {"span": until - start, "samples": samples, "end": None, "years": None, "times": None}
    return Scene(toml=scene.toml, time=times)


def _turns(scene: Scene) -> tuple[float, float, int]:
    """The mean of turn zero, the mean period (below zero for a backward span) and the number of turns in the span, from a straight line through the
    pulses."""
    table = scene.pulses()
    turn, t = table["turn"], table["closest_approach"]
    good = np.isfinite(turn) & np.isfinite(t) & (table["beam"] == 1)
    if good.sum() < 2:
        raise Error(f"scene {scene.name}: the number of whole pulses in its span is {good.sum()}: must be at least 2")
    period, first = np.polyfit(turn[good], t[good], 1)
    return float(first), float(period), int((scene.span[1] - first) / period)


def _beam_edge(scene: Scene) -> float:
    rho = tomllib.loads(scene.toml)["pulsar"]["rho"]
    return float(np.radians(float(rho.removesuffix("deg")))) if isinstance(rho, str) else float(rho)


def _along_line_of_sight(scene: Scene, times: Numbers) -> Numbers:
    """m.n at non-decreasing times."""
    different, back = np.unique(times, return_inverse=True)
    start = scene.span[0]
    parts = []
    # The times of a scene lead away from its start.
    for side in (different[different < start][::-1], different[different >= start]):
        if side.size == 0:
            parts.append(side)
            continue
        asked = {"times": side.tolist(), "span": None, "end": None, "years": None, "samples": None, "start": start}
        parts.append(Scene(toml=scene.toml, time=asked, output={"columns": ["m.n"]}).table()["m.n"])
    return np.concatenate([parts[0][::-1], parts[1]])[back]


def _panels(axes: Sequence[Axes] | None, count: int, width: float, height: float) -> list[Axes]:
    """Panels one below the other, created if none are given."""
    if axes is None:
        figure, made = plt.subplots(
            count, 1, figsize=(width, 0.45 + height * count), squeeze=False, layout="constrained"
        )
        figure.align_ylabels()
        return list(made[:, 0])
    given = list(axes)
    if len(given) != count:
        raise Error(f"axes: expected {count}, found {len(given)}")
    return given


def _time_axis(panels: list[Axes], unit: str, span: tuple[float, float]) -> None:
    for panel in panels:
        frame(panel)
        panel.set_xlim(min(span), max(span))
        panel.tick_params(labelbottom=panel is panels[-1])
    panels[-1].set_xlabel(f"$t$ {_unit(unit)}", fontsize=_LABEL)


def _unit(unit: str) -> str:
    return r"/ $t_\mathrm{c}$" if unit == "t_c" else f"[{unit}]"


def frame(axes: Axes, *, minor: bool = True) -> None:
    """Gives `axes` the style of these figures: thin lines, ticks inwards on all sides, no minor ones if `minor` is false."""
    for spine in axes.spines.values():
        spine.set_linewidth(0.6)
    axes.tick_params(which="both", direction="in", width=0.6, labelsize=_SMALL, top=True, right=True)
    axes.tick_params(which="major", length=4.0)
    axes.tick_params(which="minor", length=2.0)
    if minor:
        for axis in (axes.xaxis, axes.yaxis):
            if axis.get_scale() == "linear":
                axis.set_minor_locator(ticker.AutoMinorLocator())


def _legend(axes: Axes) -> None:
    """A legend in a row above the frame."""
    axes.legend(
        loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=4, frameon=False, fontsize=_SMALL, borderaxespad=0.2,
        borderpad=0.1, handlelength=2.2, columnspacing=1.2,
    )  # fmt: skip


def _arrow(axes: Axes, tail: Numbers, head: Numbers, colour: str, width: float) -> None:
    look = {"arrowstyle": "-|>,head_width=0.18,head_length=0.4", "color": colour, "lw": width, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", xy=(head[0], head[1]), xytext=(tail[0], tail[1]), arrowprops=look, zorder=4)


def _name(axes: Axes, at: Numbers, text: str, colour: str, offset: tuple[float, float]) -> None:
    """A name beside the head of a vector, displaced by `offset` points, with a white edge."""
    axes.annotate(
        text, (at[0], at[1]), xytext=offset, textcoords="offset points", ha="center", va="center", color=colour,
        fontsize=_LABEL, path_effects=[withStroke(linewidth=2.0, foreground="#ffffff")], zorder=5,
    )  # fmt: skip


def _broken(x: Numbers, y: Numbers, breaks: NDArray[np.bool_]) -> tuple[Numbers, Numbers]:
    """A line with gaps after some of its points."""
    at = np.flatnonzero(breaks) + 1
    return np.insert(x, at, np.nan), np.insert(y, at, np.nan)


def _with_room(x: Numbers) -> tuple[float, float]:
    room = 0.06 * (x.max() - x.min()) or 1.0
    return float(x.min() - room), float(x.max() + room)


def _scaled(size: float) -> tuple[float, str]:
    """The factor to the unit of time in which a size in seconds is a convenient number."""
    for factor, unit in ((1.0, "s"), (1e3, "ms"), (1e6, "\N{GREEK SMALL LETTER MU}s"), (1e9, "ns")):
        if size * factor >= 0.5:
            return factor, f"[{unit}]"
    return 1e12, "[ps]"


def _round_factor(factor: float) -> float:
    """Largest 1, 2 or 5 times a power of ten up to a factor."""
    power = 10.0 ** np.floor(np.log10(factor))
    return float(max(step * power for step in (1, 2, 5) if step * power <= factor))
