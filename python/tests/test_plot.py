"""Figures: the data of the lines drawn."""

import subprocess
import sys

import numpy as np
import pytest

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")

import matplotlib.pyplot as plt

import twofold
from twofold import plot


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")


def test_names_that_are_offered():
    assert all(hasattr(twofold.plot, name) for name in twofold.plot.__all__)


def drawn(axes, label):
    """The data of the line with this label."""
    found = [line for line in axes.lines if line.get_label() == label]
    assert len(found) == 1, f"{label}: {[line.get_label() for line in axes.lines]}"
    return found[0].get_data()


def test_angles_are_those_of_the_motion_and_of_the_printed_solution():
    scene = twofold.Scene("tp-2")
    alpha, beta = plot.angles(scene, until=30.0, samples=301)
    t, shown = drawn(beta, "motion")
    assert (t[0], t[-1], t.size) == (0.0, 30.0, 301)
    np.testing.assert_allclose(shown, scene.motion().angles(t)[:, 1], atol=1e-11)
    _, printed = drawn(beta, "perturbation, printed")
    assert 0.5 < np.abs(printed - shown).max() < 1.0
    assert drawn(alpha, "motion")[1][-1] == pytest.approx(scene.motion().angles(30.0)[0], abs=1e-11)
    assert beta.get_xlabel() == r"$t$ / $t_\mathrm{c}$"


def test_angles_without_a_printed_solution_have_one_line():
    scene = twofold.Scene("free")
    (gamma,) = plot.angles(scene, names=["gamma"], perturbation=False)
    assert len(gamma.lines) == 1 and gamma.get_legend() is None
    with pytest.raises(twofold.Error, match="names: `delta` must be one of alpha, beta, gamma"):
        plot.angles(scene, names=["delta"])
    with pytest.raises(twofold.Error, match="axes: expected 2, found 1"):
        plot.angles(scene, axes=[gamma])


def test_paths_on_the_sphere_are_seen_from_the_eye():
    motion = twofold.Scene("tp-2").motion()
    axes = plot.sphere(motion, until=50.0, samples=501, view=(0.0, 90.0))
    # Seen from above: right is Y, up is -X, and everything north of the equator is in front.
    x, y = drawn(axes, "n")
    n, momentum, _ = motion.state(np.linspace(0.0, 50.0, 501))
    assert (n[:, 2] > 0.0).all()
    np.testing.assert_allclose(np.column_stack([x, y]), np.column_stack([n[:, 1], -n[:, 0]]), atol=1e-12)
    x, y = drawn(axes, "L")
    assert x[0] == pytest.approx(momentum[0, 1] / np.linalg.norm(momentum[0]))
    # From the equator both sides are visible, each piece separately.
    x, _ = drawn(plot.sphere(motion, until=50.0, samples=501, view=(0.0, 0.0)), "n")
    front = np.isfinite(x)
    assert 0 < front.sum() < 501
    assert (n[front & np.append(front[1:], True), 0] > -0.2).all()


def test_pulses_are_drawn_where_they_are_and_gaps_break_the_line():
    scene = twofold.Scene("tp-2")
    table = scene.pulses()
    period, length = plot.pulses(scene)
    whole = np.array([cut == "" for cut in table["cut"]])
    t, durations = drawn(length, "beam 1")
    np.testing.assert_array_equal(t, table["midpoint"][whole])
    np.testing.assert_array_equal(durations, table["duration"][whole])
    turns = np.diff(table["turn"][whole])
    assert (turns > 1).any()
    # The joining line has a gap for each dark turn, and a period for each consecutive pair.
    joined = length.lines[0].get_ydata()
    assert np.isnan(joined).sum() == (turns != 1).sum()
    shown = drawn(period, "beam 1")[1]
    assert np.isfinite(shown).sum() == (turns == 1).sum()
    assert 3.0 < np.nanmin(shown) and np.nanmax(shown) < 7.0


def test_back_in_time_pulses_follow_one_another_too():
    scene = twofold.Scene("tp-1", time={"span": -60.0})
    table = scene.pulses()
    whole = np.array([cut == "" for cut in table["cut"]])
    period, length = plot.pulses(scene)
    assert np.isfinite(length.lines[0].get_ydata()).all() and np.isfinite(drawn(period, "beam 1")[1]).sum() == whole.sum() - 1
    first, mean, count = plot._turns(scene)
    mesh = plot.waterfall(scene, rows=5, samples=101).collections[0]
    corners = mesh.get_coordinates()
    np.testing.assert_allclose((corners[1:, 0, 1] + corners[:-1, 0, 1]) / 2.0, -np.arange(5.0), atol=1e-12)
    assert mean > 0.0 and first + count * mean >= -60.0 > first + (count - 1) * mean
    # Every turn has its pulse, with a tenth of the brightness at the edge of the beam.
    light = np.asarray(mesh.get_array()).reshape(5, 101)
    step = (corners[0, -1, 0] - corners[0, 0, 0]) / 101
    np.testing.assert_allclose((light > 0.1).sum(axis=1) * step, table["duration"][whole][:5], atol=2.0 * step)


def test_a_second_beam_is_told_apart():
    scene = twofold.Scene("tp-1", pulsar={"second_beam": True, "rho": 1.2})
    _, length = plot.pulses(scene)
    beams = np.asarray(scene.pulses()["beam"])
    assert drawn(length, "beam 2")[0].size > 0
    assert drawn(length, "beam 1")[0].size + drawn(length, "beam 2")[0].size <= beams.size
    ring = next(line for line in length.lines if line.get_label() == "beam 2")
    assert ring.get_markerfacecolor() == "#ffffff"


def test_shades_are_bright_where_the_pulses_are():
    scene = twofold.Scene("tp-1")
    axes = plot.waterfall(scene, samples=201)
    mesh = axes.collections[0]
    light = mesh.get_array().reshape(-1, 201)
    pulses = scene.pulses()
    # The brightness is a tenth at the edge of the beam: it is exceeded for the duration of the pulses.
    turns = light.shape[0]
    good = np.isfinite(pulses["turn"]) & (pulses["turn"] < turns)
    corners = mesh.get_coordinates()
    window = corners[0, -1, 0] - corners[0, 0, 0]
    assert (light > 0.1).mean() * window * turns == pytest.approx(pulses["duration"][good].sum(), rel=0.02)
    assert light.max() <= 1.0


def test_shapes_over_years_are_as_late_and_as_wide_as_the_table_says():
    scene = twofold.Scene("b1828-11")
    axes = plot.waterfall(scene, rows=40, samples=801)
    mesh = axes.collections[0]
    light = mesh.get_array().reshape(40, 801)
    corners = mesh.get_coordinates()[0, :, 0]
    x = (corners[1:] + corners[:-1]) / 2.0
    table = scene.pulsar().arrivals().table
    chosen = np.linspace(0, 999, 40).round().astype(int)
    for row, k in zip(light, chosen, strict=True):
        bright = x[row > 0.1]
        middle, width = (bright[0] + bright[-1]) / 2.0, bright[-1] - bright[0]
        assert middle == pytest.approx(1e3 * table["residual"][k], abs=0.15)
        assert width == pytest.approx(1e3 * table["duration"][k], abs=0.2)
    with pytest.raises(twofold.Error, match="rows = 1: must be"):
        plot.waterfall(scene, rows=1)
    damped = twofold.Scene("b1828-11", spin_down={"f1": -3.65e-13, "damping_time": 1e5})
    with pytest.raises(twofold.Error, match="spin_down.damping_time cannot be used here; the star must be without friction"):
        plot.waterfall(damped)


def test_a_pulsar_whose_pulses_come_half_a_turn_after_whole_phases():
    """The date of a whole phase is then equally near to one pulse and to the next."""
    scene = twofold.Scene("isolated-pulsar")
    mesh = plot.waterfall(scene, rows=10, samples=801).collections[0]
    light, corners = mesh.get_array().reshape(10, 801), mesh.get_coordinates()[0, :, 0]
    x = (corners[1:] + corners[:-1]) / 2.0
    table = scene.pulsar().arrivals().table
    widths = [np.ptp(x[row > 0.1]) for row in light]
    durations = table["duration"][np.linspace(0, len(table) - 1, 10).round().astype(int)]
    np.testing.assert_allclose(np.array(widths) / widths[0], durations / durations[0], rtol=0.02)


def test_uprights_stand_at_the_lines_and_bear_their_names():
    scene = twofold.Scene("tp-1")
    axes = plot.spectrum(scene, "m.n", least=1e-3, named=3)
    lines = scene.lines("m.n", least=1e-3, most=200)
    feet_and_tops = np.array(axes.collections[0].get_segments())
    np.testing.assert_array_equal(feet_and_tops[:, 1, 0], lines["frequency"])
    np.testing.assert_array_equal(feet_and_tops[:, 1, 1], lines["amplitude"])
    names = [text.get_text() for text in axes.texts]
    assert names == [r"$\alpha$", r"$\alpha + \gamma$", r"$-\gamma$"]
    with pytest.raises(twofold.Error, match="no line lies in it"):
        plot.spectrum(scene, "m.n", span=(50.0, 60.0))


def test_causes_add_up_and_small_ones_are_enlarged():
    timing = twofold.Scene("b1828-11").pulsar().arrivals(causes=True)
    residuals, lengths = plot.arrivals(timing)
    date, residual = drawn(residuals, "residual")
    torque, geometry = drawn(residuals, "torque")[1], drawn(residuals, r"geometry $\times$ 50")[1]
    np.testing.assert_allclose(residual, torque + geometry / 50.0, atol=1e-3)
    np.testing.assert_array_equal(residual, 1e3 * timing.table["residual"])
    assert date[0] == pytest.approx(49621.0) and residuals.get_ylabel() == "residual [ms]"
    assert not any("violation" in line.get_label() for line in residuals.lines)
    np.testing.assert_array_equal(lengths.lines[0].get_ydata(), 1e3 * timing.table["duration"])


def test_pulses_of_the_second_beam_alone():
    """The second beam: the magnetic axis is nearer to the opposite of the line of sight."""
    scene = twofold.Scene("tp-1", pulsar={"second_beam": True, "chi": np.pi - 0.5})
    table, mine = scene.pulses(), plt.subplots(2, 1)[1]
    period, length = plot.pulses(scene, axes=mine)
    assert [period, length] == list(mine)
    (line,) = [line for line in period.lines if line.get_label() == "beam 2"]
    assert (line.get_linestyle(), line.get_marker(), line.get_markerfacecolor()) == ("None", "o", "#ffffff")
    whole = np.array(table["cut"]) == ""
    np.testing.assert_array_equal(drawn(length, "beam 2"), (table["midpoint"][whole], table["duration"][whole]))
    shown = drawn(period, "beam 2")[1]
    assert np.isnan(shown[0])
    np.testing.assert_allclose(shown[1:], np.diff(table["midpoint"][whole]), rtol=1e-12)
    np.testing.assert_array_equal(length.lines[0].get_data(), drawn(length, "beam 2"))
    assert period.get_ylabel() == r"period / $t_\mathrm{c}$" and length.get_ylabel() == r"length / $t_\mathrm{c}$"
    assert length.get_xlabel() == r"$t$ / $t_\mathrm{c}$" and period.get_xlim() == (0.0, 400.0)
    assert period.get_legend() is not None and length.get_legend() is None


def test_one_beam_needs_no_legend_and_no_pulse_is_refused():
    period, _ = plot.pulses(twofold.Scene("tp-1"))
    assert period.get_legend() is None
    with pytest.raises(twofold.Error, match="scene tp-1: it has no whole pulse in its span"):
        plot.pulses(twofold.Scene("tp-1", pulsar={"chi": 0.0, "rho": 0.01}))


def test_turns_are_those_of_the_first_beam():
    scene = twofold.Scene("tp-1", pulsar={"second_beam": True, "rho": 1.2}, time={"start": 50.0})
    table = scene.pulses()
    ours = (table["beam"] == 1) & np.isfinite(table["turn"])
    first, period, count = plot._turns(scene)
    design = np.stack([np.ones(ours.sum()), table["turn"][ours]], axis=1)
    assert (first, period) == pytest.approx(np.linalg.lstsq(design, table["closest_approach"][ours], rcond=None)[0], rel=1e-12)
    assert first + count * period <= scene.span[1] < first + (count + 1) * period
    two = twofold.Scene("tp-1", time={"span": 12.5})
    assert np.isfinite(two.pulses()["turn"]).sum() == 2
    assert plot._turns(two)[1] == pytest.approx(two.pulses()["closest_approach"][2] - two.pulses()["closest_approach"][1])
    with pytest.raises(twofold.Error, match="scene tp-1: the number of whole pulses in its span is 1: must be at least 2"):
        plot._turns(twofold.Scene("tp-1", time={"span": 8.0}))


def test_shades_are_of_the_angle_to_the_line_of_sight():
    """Row by row and column by column, with the angle itself as intensity."""
    scene = twofold.Scene("tp-2", time={"start": 10.0})
    mine = plt.subplots()[1]
    axes = plot.waterfall(scene, rows=5, window=(-1.0, 2.0), samples=7, intensity=lambda angle: angle, axes=mine)
    assert axes is mine
    mesh = axes.collections[0]
    light = np.asarray(mesh.get_array()).reshape(5, 7)
    first, period, _ = plot._turns(scene)
    times = first + period * np.arange(5.0)[:, None] + np.linspace(-1.0, 2.0, 7)
    along = twofold.Scene(toml=scene.toml, time={"start": 10.0, "span": None, "samples": None, "times": times[times >= 10.0].tolist()}).table(["m.n"])["m.n"]
    np.testing.assert_allclose(light[times >= 10.0], np.arccos(along) / 0.6, rtol=1e-9)
    corners = mesh.get_coordinates()
    np.testing.assert_allclose((corners[0, 1:, 0] + corners[0, :-1, 0]) / 2.0, np.linspace(-1.0, 2.0, 7), atol=1e-12)
    np.testing.assert_allclose((corners[1:, 0, 1] + corners[:-1, 0, 1]) / 2.0, np.arange(5.0), atol=1e-12)
    assert axes.get_xlabel() == r"$t$ from the mean turn / $t_\mathrm{c}$" and axes.get_ylabel() == "turn"
    assert axes.figure.axes[-1].get_ylabel() == "intensity"


def test_a_turn_is_the_window_of_a_short_scene():
    scene = twofold.Scene("tp-1")
    mesh = plot.waterfall(scene).collections[0]
    corners = mesh.get_coordinates()
    middles = (corners[0, 1:, 0] + corners[0, :-1, 0]) / 2.0
    _, period, count = plot._turns(scene)
    assert (middles[0], middles[-1]) == pytest.approx((-period / 2.0, period / 2.0)) and len(corners) - 1 == count
    # The maximum is at the axis of the beam, and a tenth of it at the edge.
    light = np.asarray(mesh.get_array())
    assert 0.99 < light.max() <= 1.0 and mesh.get_clim()[0] == 0.0


def test_shapes_over_years_are_centred_on_what_is_foretold():
    scene = twofold.Scene("b1828-11", pulsar={"rho": "6 deg"})
    table = scene.pulsar().arrivals().table
    axes = plot.waterfall(scene, rows=2, samples=2)
    corners = axes.collections[0].get_coordinates()
    date = table["arrival_day"] + table["arrival_fraction"]
    np.testing.assert_allclose((corners[1:, 0, 1] + corners[:-1, 0, 1]) / 2.0, date[[0, -1]], rtol=1e-14)
    middles = (corners[0, 1:, 0] + corners[0, :-1, 0]) / 2.0
    half = 1.5 * (np.abs(table["residual"][[0, -1]]).max() + table["duration"].max() / 2.0)
    assert tuple(middles) == pytest.approx((-1e3 * half, 1e3 * half))
    assert axes.get_xlabel() == "time from the predicted pulse [ms]" and axes.get_ylabel() == "date [MJD]"
    axes = plot.waterfall(scene, rows=2, samples=3, window=(-0.01, 0.02))
    corners = axes.collections[0].get_coordinates()
    assert (corners[0, 1, 0] + corners[0, 0, 0]) / 2.0 == pytest.approx(-10.0)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"samples": 1}, "samples = 1: must be a whole number of at least 2"),
        ({"rows": 1}, "rows = 1: must be a whole number of at least 2"),
        ({"window": (1.0, 1.0)}, r"window = \(1.0, 1.0\): must be the earlier time, then the later one"),
        ({"window": (2.0, 1.0)}, "window = .*: must be"),
        ({"intensity": lambda angle: angle[:1]}, r"intensity has the shape \(1, 301\): must have the shape \(95, 301\)"),
    ],
)
def test_shades_that_cannot_be(options, words):
    with pytest.raises(twofold.Error, match=words):
        plot.waterfall(twofold.Scene("tp-1"), **options)


def test_the_edge_of_the_beam_in_degrees_and_in_rad():
    assert plot._beam_edge(twofold.Scene("tp-1")) == 0.6
    assert plot._beam_edge(twofold.Scene("tp-1", pulsar={"rho": "9 deg"})) == pytest.approx(np.pi / 20)


def test_the_line_of_sight_before_and_after_the_start():
    scene = twofold.Scene("tp-2", time={"start": 5.0})
    times = np.array([1.0, 4.0, 5.0, 5.0, 9.0, 30.0])
    found = plot._along_line_of_sight(scene, times)
    later = twofold.Scene("tp-2", time={"times": [0.0, 4.0, 25.0], "span": None, "samples": None}).table(["m.n"])["m.n"]
    earlier = twofold.Scene("tp-2", time={"times": [0.0, -1.0, -4.0], "span": None, "samples": None}).table(["m.n"])["m.n"]
    np.testing.assert_allclose(found, [earlier[2], earlier[1], later[0], later[0], later[1], later[2]], rtol=1e-9)
    np.testing.assert_allclose(plot._along_line_of_sight(scene, times[2:]), found[2:], rtol=1e-12)


def test_angles_over_any_span():
    scene = twofold.Scene("tp-2", time={"start": 5.0})
    mine = plt.subplots(3, 1)[1]
    panels = plot.angles(scene, names=("alpha", "beta", "gamma"), axes=mine)
    assert list(panels) == list(mine)
    angles = scene.motion().angles(np.linspace(5.0, 405.0, 1001))
    for k, (panel, name) in enumerate(zip(panels, ("alpha", "beta", "gamma"), strict=True)):
        t, shown = drawn(panel, "motion")
        np.testing.assert_allclose(t, np.linspace(5.0, 405.0, 1001), rtol=1e-12)
        np.testing.assert_allclose(shown, angles[:, k], atol=1e-9)
        assert panel.get_ylabel() == rf"$\{name}$ [rad]" and panel.get_xlim() == (5.0, 405.0)
        assert panel.get_xlabel() == (r"$t$ / $t_\mathrm{c}$" if k == 2 else "")
        assert panel.xaxis.get_tick_params().get("labelbottom", True) == (k == 2)
    assert panels[0].get_legend() is not None and panels[1].get_legend() is None
    alone = plot.angles(scene, perturbation=False)
    assert [len(panel.lines) for panel in alone] == [1, 1]
    both = plot.angles(scene, perturbation=True, samples=2)
    assert [len(panel.lines) for panel in both] == [2, 2] and drawn(both[0], "motion")[0].size == 2
    backwards = plot.angles(scene, until=-5.0)[0]
    assert backwards.get_xlim() == (-5.0, 5.0)
    with pytest.raises(twofold.Error):
        plot.angles(twofold.Scene("free"), perturbation=True)
    with pytest.raises(twofold.Error, match="samples = 1: must be a whole number of at least 2"):
        plot.angles(scene, samples=1)
    with pytest.raises(twofold.Error, match="until = 5.0: must be another time than the start of the scene"):
        plot.angles(scene, until=5.0)


def test_spans_that_are_written_in_other_ways():
    """`end` and `times` of a scene in the paper's units, and `years` of a physical star: `until` replaces them."""
    for time in ({"span": None, "end": 20.0}, {"span": None, "samples": None, "times": [0.0, 1.0, 20.0]}):
        scene = twofold.Scene("tp-2", time=time)
        t, shown = drawn(plot.angles(scene, until=10.0, samples=11, perturbation=False)[1], "motion")
        np.testing.assert_allclose(t, np.arange(11.0), atol=1e-12)
        np.testing.assert_allclose(shown, twofold.Scene("tp-2").motion().angles(t)[:, 1], atol=1e-11)
        values = plot._along_line_of_sight(scene, np.array([2.0, 3.0]))
        np.testing.assert_allclose(values, twofold.Scene("tp-2", time={"span": None, "samples": None, "times": [2.0, 3.0], "start": 0.0}).table(["m.n"])["m.n"], rtol=1e-9)
    years = twofold.Scene("b1828-11", star={"bulge": None}, lorentz_violation={"alpha_2": None, "w": None, "eigenvalues": [0.0, 0.0, 0.0]}, spin_down=None)
    assert plot._sampled(years, 10.0, 3).span == (0.0, 10.0)
    assert len(plot.angles(scene, until=10.0)[0].figure.axes) == 2
    printed = drawn(plot.angles(twofold.Scene("tp-2"), until=10.0)[1], "perturbation, printed")
    np.testing.assert_allclose(printed[0], np.linspace(0.0, 10.0, 1001), atol=1e-12)
    assert len(plot.angles(twofold.Scene("free", output={"columns": ["m.n"]}), until=10.0)[0].lines) == 1


def test_a_beam_is_a_gaussian_that_falls_to_a_tenth():
    scene = twofold.Scene("tp-1")
    light, angle = (np.asarray(plot.waterfall(scene, rows=3, samples=41, intensity=given).collections[0].get_array()) for given in (None, lambda angle: angle))
    np.testing.assert_allclose(light, 0.1 ** (angle * angle), rtol=1e-12)


def test_shapes_over_years_of_a_scene_that_starts_later():
    first, later = (
        np.asarray(plot.waterfall(twofold.Scene("b1828-11", time=time), rows=5, samples=21).collections[0].get_array()) for time in ({}, {"start": 12.0})
    )
    np.testing.assert_allclose(later, first, atol=1e-6)


def test_frames_have_ticks_on_all_sides():
    for minor in (True, False):
        _, axes = plt.subplots()
        plot.frame(axes, minor=minor)
        assert isinstance(axes.xaxis.get_minor_locator(), matplotlib.ticker.AutoMinorLocator) == minor
        axes.figure.canvas.draw()
        for axis, sides in ((axes.xaxis, ("tick1line", "tick2line")), (axes.yaxis, ("tick1line", "tick2line"))):
            assert all(getattr(tick, side).get_visible() for tick in axis.get_major_ticks() for side in sides)
    _, axes = plt.subplots()
    axes.set_yscale("log")
    plot.frame(axes)
    assert not isinstance(axes.yaxis.get_minor_locator(), matplotlib.ticker.AutoMinorLocator)


def seen(points, view):
    """Points seen from far away: rotated about Z by the azimuth of the eye, then by its elevation. Right and up on the page, and towards the eye."""
    a, e = np.radians(view)
    about_z = np.array([[np.cos(a), np.sin(a), 0.0], [-np.sin(a), np.cos(a), 0.0], [0.0, 0.0, 1.0]])
    raised = np.array([[np.cos(e), 0.0, np.sin(e)], [0.0, 1.0, 0.0], [-np.sin(e), 0.0, np.cos(e)]])
    towards, right, up = raised @ about_z @ np.asarray(points).T
    return np.stack([right, up], axis=-1), towards


def test_everything_on_the_sphere_is_seen_from_the_same_place():
    motion, view = twofold.Scene("tp-2").motion(), (130.0, -35.0)
    axes = plot.sphere(motion, until=20.0, samples=201, equatorial=5.0, view=view)
    n, momentum, _ = motion.state(np.linspace(0.0, 20.0, 201))
    paths = [motion.state(np.linspace(0.0, 5.0, 201))[2], n, momentum / np.linalg.norm(momentum, axis=1, keepdims=True)]
    lines = [line.get_xydata() for line in axes.lines]
    assert len(lines) == 3 * 2 + 3 + 3 * 2
    turn = np.linspace(0.0, 2.0 * np.pi, len(lines[0]))
    zero = np.zeros_like(turn)
    circles = [np.stack(plane, axis=-1) for plane in ((np.cos(turn), np.sin(turn), zero), (np.cos(turn), zero, np.sin(turn)), (zero, np.cos(turn), np.sin(turn)))]
    for points, back, front in zip([*circles, *paths], [*lines[0:6:2], *lines[9::2]], [*lines[1:6:2], *lines[10::2]], strict=True):
        expected, towards = seen(points, view)
        for line, here in ((front, towards >= 0.0), (back, towards < 0.0)):
            # Each piece includes the first point of the next one.
            drawn_here = here | np.append(False, here[:-1])
            assert (np.isfinite(line).all(axis=1) == drawn_here)[np.abs(towards) > 1e-12].all()
            np.testing.assert_allclose(line[drawn_here & np.isfinite(line[:, 0])], expected[drawn_here & np.isfinite(line[:, 0])], atol=1e-12)
    disc = axes.patches[0]
    assert (disc.center, disc.radius) == ((0.0, 0.0), 1.0)
    tips, _ = seen(np.eye(3), view)
    arrows = [text for text in axes.texts if text.get_text() == ""]
    names = {text.get_text(): text for text in axes.texts}
    for k, name in enumerate("XYZ"):
        np.testing.assert_allclose(lines[6 + k], [[0.0, 0.0], tips[k]], atol=1e-12)
        np.testing.assert_allclose([arrows[k].get_position(), arrows[k].xy], [tips[k], 1.22 * tips[k]], atol=1e-12)
        np.testing.assert_allclose(names[f"${name}$"].xy, 1.22 * tips[k], atol=1e-12)
        # The name is beyond the head.
        np.testing.assert_allclose(names[f"${name}$"].get_position(), 7.0 * tips[k] / np.linalg.norm(tips[k]), atol=1e-12)
    heads = [seen(path[0], view)[0] for path in paths]
    for arrow, head, name in zip(arrows[3:], heads, (r"$\mathbf{e}_x$", r"$\mathbf{n}$", r"$\mathbf{L}$"), strict=True):
        np.testing.assert_allclose([arrow.get_position(), arrow.xy, names[name].xy], [(0.0, 0.0), head, head], atol=1e-12)
    # Everything is within the limits, and the sphere fills most of them.
    for limits, part in ((axes.get_xlim(), tips[:, 0]), (axes.get_ylim(), tips[:, 1])):
        assert -1.5 < limits[0] < min(-1.0, 1.22 * part.min()) and max(1.0, 1.22 * part.max()) < limits[1] < 1.5
    assert axes.get_aspect() == 1.0 and not axes.axison


def test_a_sphere_does_not_depend_on_the_reading_of_the_clock():
    """The same motion, started at another time, and e_x for the same length of time."""
    early, late = (
        plot.sphere(twofold.Scene("tp-2", time={"start": start}).motion(), until=start + 20.0, samples=201, equatorial=5.0)
        for start in (0.0, 3.0)
    )
    for line, same in zip(late.lines, early.lines, strict=True):
        np.testing.assert_allclose(line.get_xydata(), same.get_xydata(), atol=1e-9)


@pytest.mark.parametrize("view", [(0.0, 90.0), (90.0, 0.0), (-45.0, 10.0), (200.0, 60.0)])
def test_limits_of_the_sphere_hold_every_view(view):
    axes = plot.sphere(twofold.Scene("tp-2").motion(), until=5.0, samples=2, view=view)
    tips, _ = seen(1.22 * np.eye(3), view)
    for limits, part in ((axes.get_xlim(), tips[:, 0]), (axes.get_ylim(), tips[:, 1])):
        np.testing.assert_allclose(limits, [min(-1.03, part.min() - 0.12), max(1.03, part.max() + 0.12)], atol=1e-12)
    # The name of an axis that points to the eye is beside it.
    assert all(np.hypot(*text.get_position()) > 5.0 for text in axes.texts if text.get_text() in ("$X$", "$Y$", "$Z$"))


def test_a_whole_motion_on_axes_that_are_given():
    motion = twofold.Scene("tp-1", time={"span": 30.0}).motion()
    _, mine = plt.subplots()
    axes = plot.sphere(motion, axes=mine)
    assert axes is mine
    x, y = (line.get_xydata() for line in axes.lines[-4:-2])
    whole = np.where(np.isnan(x), y, x)
    np.testing.assert_allclose(whole, seen(motion.axis(np.linspace(0.0, 30.0, len(whole))), (35.0, 25.0))[0], atol=1e-12)
    with pytest.raises(twofold.Error, match="samples = 1: must be a whole number of at least 2"):
        plot.sphere(motion, samples=1)
    slow = twofold.Scene("free", star={"spin": 0.1}, initial={"alpha_rate": 0.05, "beta_rate": 0.0}).motion()
    assert np.linalg.norm(slow.state(0.0)[1]) < 1.0 and np.isfinite(np.hypot(*drawn(plot.sphere(slow), "L"))[0])
    still = twofold.Scene("free", star={"spin": 0.0}, initial={"alpha_rate": 0.0, "beta_rate": 0.0})
    with pytest.raises(twofold.Error, match="motion: the star must rotate; at rest"):
        plot.sphere(still.motion())


def test_lines_around_a_frequency_and_within_a_span():
    scene = twofold.Scene("tp-1")
    lines = scene.lines("m.n", least=1e-3, most=200)
    around = lines["frequency"][1]
    axes = plot.spectrum(scene, "m.n", least=1e-3, around=around, named=0)
    segments = np.array(axes.collections[0].get_segments())
    np.testing.assert_allclose(segments[:, 0, 0], lines["frequency"] - around, atol=1e-15)
    np.testing.assert_array_equal(segments[:, :, 0], segments[:, ::-1, 0])
    assert axes.get_xlabel() == rf"angular frequency less {around:.10g} $\times$ $t_\mathrm{{c}}$" and len(axes.texts) == 0
    x = segments[:, 0, 0]
    room = 0.06 * np.ptp(x)
    assert axes.get_xlim() == pytest.approx((x.min() - room, x.max() + room))
    # The base is a power of ten not above the smallest height; a third of the height is room for names.
    foot, least = segments[0, 0, 1], 1e-3 * lines["amplitude"][0]
    assert foot <= least < 10 * foot and np.log10(foot) == pytest.approx(round(np.log10(foot)))
    bottom, top = axes.get_ylim()
    assert bottom == foot and np.log(top / foot) == pytest.approx(1.45 * np.log(lines["amplitude"][0] / foot))
    # Both ends of a span are included.
    low, high = np.sort(lines["frequency"])[[1, 3]]
    axes = plot.spectrum(scene, "m.n", least=1e-3, span=(low, high))
    assert axes.get_xlim() == (low, high) and len(axes.collections[0].get_segments()) == 3
    with pytest.raises(twofold.Error, match="span = .*: must be the lower frequency, then the higher one"):
        plot.spectrum(scene, "m.n", span=(1.0, 1.0))


def test_a_spectrum_from_zero_and_its_words():
    axes = plot.spectrum(twofold.Scene("tp-2"), "m.n")
    assert len(axes.collections[0].get_segments()) == len(twofold.Scene("tp-2").lines("m.n", least=1e-5, most=200)) > 50
    low, high = axes.get_xlim()
    last = max(segment[0][0] for segment in axes.collections[0].get_segments())
    assert (low, high) == pytest.approx((-0.02 * last, 1.06 * last))
    assert axes.get_xlabel() == r"angular frequency $\times$ $t_\mathrm{c}$" and axes.get_ylabel() == r"amplitude of $\mathbf{m} \cdot \mathbf{n}$"
    assert axes.get_yscale() == "log"
    _, mine = plt.subplots()
    physical = twofold.Scene("b1828-11", star={"bulge": None}, lorentz_violation={"alpha_2": None, "w": None, "eigenvalues": [0.0, 0.0, 0.0]}, spin_down=None)
    axes = plot.spectrum(physical, "cos_lambda_rate", axes=mine)
    assert axes is mine and axes.get_xlabel() == "angular frequency [rad/s]" and axes.get_ylabel() == "amplitude of cos_lambda_rate"
    assert len(plot.spectrum(twofold.Scene("tp-2"), "m.n", least=1e-12).collections[0].get_segments()) == 200
    with pytest.raises(twofold.Error, match="column = 'cos_lambda': it is constant in scene"):
        plot.spectrum(twofold.Scene("free", initial={"beta": 0.0, "alpha_rate": 0.0, "beta_rate": 0.0}), "cos_lambda")


@pytest.mark.parametrize(("span", "inches_wide"), [(None, 4.0), ((1.0, 3.0), 4.0), (None, 100.0)])
def test_names_have_room_beside_stronger_ones(span, inches_wide):
    figure = plt.figure(figsize=(inches_wide, 2.0), dpi=100)
    axes = plot.spectrum(twofold.Scene("tp-2"), "m.n", span=span, axes=figure.add_axes((0.1, 0.1, 0.8, 0.8)))
    table = twofold.Scene("tp-2").lines("m.n", least=1e-5, most=200)
    low, high = axes.get_xlim()
    shown = np.flatnonzero((table["frequency"] >= low) & (table["frequency"] <= high))[:8]
    inches = (table["frequency"] - low) / (high - low) * 0.8 * inches_wide
    # Eight points are 0.11 inches.
    roomy = [k for j, k in enumerate(shown) if all(abs(inches[k] - inches[other]) > 0.11 for other in shown[:j])]
    assert 1 < len(roomy) < 8 or len(roomy) == 8 and inches_wide == 100.0
    np.testing.assert_array_equal([text.xy for text in axes.texts], [(table["frequency"][k], table["amplitude"][k]) for k in roomy])
    assert [text.get_text() for text in axes.texts] == [plot._combination(table["combination"][k]) for k in roomy]
    assert all(text.get_rotation() == 90.0 for text in axes.texts)


@pytest.mark.parametrize(
    ("torque", "alpha_2", "names"),
    [("vacuum", 1e-3, {"torque", "geometry"}), ("constant", 1e-3, {"geometry", "violation"}), ("constant", 1e-9, {"geometry"})],
)
def test_causes_of_residuals_are_enlarged_as_they_say(torque, alpha_2, names):
    scene = twofold.Scene("b1828-11", lorentz_violation={"alpha_2": alpha_2}, spin_down={"torque": torque})
    timing = scene.pulsar().arrivals(np.linspace(49621.0, 53271.0, 80), causes=True)
    table, size = timing.table, np.abs(timing.table["residual"]).max()
    mine = plt.subplots(2, 1)[1]
    panels = plot.arrivals(timing, axes=mine)
    assert list(panels) == list(mine)
    date = table["arrival_day"] + table["arrival_fraction"]
    for line in panels[0].lines[1:]:
        name, _, by = line.get_label().partition(r" $\times$ ")
        enlarged = float(by or 1.0)
        np.testing.assert_array_equal(line.get_xdata(), date)
        scale = {"[ms]": 1e3, "[\u03bcs]": 1e6}[panels[0].get_ylabel().split()[1]]
        np.testing.assert_allclose(line.get_ydata(), enlarged * scale * table[name], rtol=1e-12)
        part = np.abs(table[name]).max() / size
        assert part >= 1e-3 and (enlarged == 1.0 if part > 0.1 else enlarged * part <= 0.3 < 2.51 * enlarged * part)
    shown = {line.get_label().split()[0] for line in panels[0].lines[1:]}
    assert shown == {"residual"} | names == {"residual"} | {name for name in ("torque", "geometry", "violation") if np.abs(table[name]).max() >= 1e-3 * size}
    assert panels[0].get_legend() is not None and panels[1].get_legend() is None
    np.testing.assert_array_equal(panels[0].lines[0].get_ydata(), [0.0, 0.0])
    np.testing.assert_array_equal(panels[1].lines[0].get_xdata(), date)
    assert [panel.get_xlim() for panel in panels] == [(date.min(), date.max())] * 2
    assert [panel.get_xlabel() for panel in panels] == ["", "date [MJD]"] and panels[1].get_ylabel() == "pulse length [ms]"
    assert [panel.xaxis.get_tick_params().get("labelbottom", True) for panel in panels] == [False, True]
    # Dates are written in full, without an offset at the end of the axis.
    assert not panels[1].xaxis.get_major_formatter().get_useOffset() and panels[1].yaxis.get_major_formatter().get_useOffset()


def test_residuals_alone_need_no_legend():
    residuals, _ = plot.arrivals(twofold.Scene("b1828-11").pulsar().arrivals(np.linspace(49621.0, 53271.0, 20)))
    assert residuals.get_legend() is None and [line.get_label() for line in residuals.lines][1:] == ["residual"]


def test_sizes_of_figures():
    # One column of Physical Review and both, 8.6 cm and 17.8 cm.
    assert (plot.COLUMN * 2.54, plot.PAGE * 2.54) == pytest.approx((8.6, 17.8))
    axes = plot.spectrum(twofold.Scene("tp-2"), "m.n", most=3)
    assert axes.figure.get_size_inches()[0] == pytest.approx(plot.PAGE)
    assert (axes.yaxis.label.get_fontsize(), axes.yaxis.get_ticklabels()[0].get_fontsize()) == (9.0, 8.0)


@pytest.mark.parametrize(
    ("column", "symbol"),
    [("m.n", r"$\mathbf{m} \cdot \mathbf{n}$"), ("h_plus", "$h_+$"), ("h_cross", r"$h_\times$"), ("beta", r"$\beta$"), ("cos_lambda", r"$\cos\lambda$"), ("Theta", r"$\Theta$")],
)
def test_amplitudes_are_named_by_the_symbol_of_their_column(column, symbol):
    assert plot.spectrum(twofold.Scene("tp-2"), column, least=1e-2, most=1).get_ylabel().startswith(f"amplitude of {symbol}")


def test_shades_go_from_white_to_dark():
    shades = plot._SHADES(np.linspace(0.0, 1.0, 11))[:, :3]
    assert tuple(shades[0]) == (1.0, 1.0, 1.0) and np.all(np.diff(shades.sum(axis=1)) < 0.0) and shades[-1].max() < 0.3


def test_parts_of_figures():
    assert plot._with_room(np.array([1.0, 3.0])) == pytest.approx((0.88, 3.12)) and plot._with_room(np.array([2.0])) == (1.0, 3.0)
    assert [plot._scaled(size) for size in (0.5, 0.49, 5e-4, 4.9e-4, 5e-7, 4.9e-7, 5e-10, 4.9e-10)] == [
        (1.0, "[s]"), (1e3, "[ms]"), (1e3, "[ms]"), (1e6, "[\u03bcs]"), (1e6, "[\u03bcs]"), (1e9, "[ns]"), (1e9, "[ns]"), (1e12, "[ps]"),
    ]  # fmt: skip
    assert [plot._round_factor(factor) for factor in (1.0, 1.99, 2.0, 4.9, 5.0, 9.9, 10.0, 0.03, 300.0)] == pytest.approx([1, 1, 2, 2, 5, 5, 10, 0.02, 200])
    assert plot._combination("2 alpha' - 3 l' + gamma' - nu'") == r"$2 \alpha - 3 l + \gamma - \nu$"
    assert (plot._unit("t_c"), plot._unit("s")) == (r"/ $t_\mathrm{c}$", "[s]")
    x, y = plot._broken(np.array([1.0, 2.0, 3.0]), np.array([4.0, 5.0, 6.0]), np.array([False, True]))
    np.testing.assert_array_equal([x, y], [[1.0, 2.0, np.nan, 3.0], [4.0, 5.0, np.nan, 6.0]])


def test_fonts_come_from_one_family():
    fonts = plot.style()
    family = fonts["mathtext.rm"]
    assert fonts["font.sans-serif"][0] == family
    assert family == "sans-serif" or family in matplotlib.font_manager.get_font_names()
    with plt.rc_context(fonts):
        plot.angles(twofold.Scene("tp-1"), until=3.0)[0].figure.canvas.draw()


def test_a_missing_package_is_named():
    code = "import sys; sys.modules['matplotlib'] = None; import twofold.plot"
    done = subprocess.run([sys.executable, "-c", code], check=False, capture_output=True, text=True)
    assert "ImportError: twofold.plot needs matplotlib" in done.stderr
    assert "pip install 'twofold[plot]'" in done.stderr
