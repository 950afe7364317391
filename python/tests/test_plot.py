"""Figures: the data of the lines that are drawn."""

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


def drawn(axes, label):
    """The data of the line with a label."""
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
    with pytest.raises(twofold.Error, match="names: `delta`: allowed are alpha, beta, gamma"):
        plot.angles(scene, names=["delta"])
    with pytest.raises(twofold.Error, match="axes: 1 are given: allowed are 2"):
        plot.angles(scene, axes=[gamma])


def test_paths_on_the_sphere_are_seen_from_the_eye():
    motion = twofold.Scene("tp-2").motion()
    axes = plot.sphere(motion, until=50.0, samples=501, view=(0.0, 90.0))
    # From above: right is Y, up is -X, and everything north of the equator is in front.
    x, y = drawn(axes, "n")
    n, momentum, _ = motion.state(np.linspace(0.0, 50.0, 501))
    assert (n[:, 2] > 0.0).all()
    np.testing.assert_allclose(np.column_stack([x, y]), np.column_stack([n[:, 1], -n[:, 0]]), atol=1e-12)
    x, y = drawn(axes, "L")
    assert x[0] == pytest.approx(momentum[0, 1] / np.linalg.norm(momentum[0]))
    # From the equator both sides are seen, each piece on its own.
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
    # A gap in the joining line for each dark turn, and a period for each pair that follows.
    joined = length.lines[0].get_ydata()
    assert np.isnan(joined).sum() == (turns != 1).sum()
    shown = drawn(period, "beam 1")[1]
    assert np.isfinite(shown).sum() == (turns == 1).sum()
    assert 3.0 < np.nanmin(shown) and np.nanmax(shown) < 7.0


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
    # A tenth at the edge of the beam: as much of the time is brighter as there are pulses.
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
    with pytest.raises(twofold.Error, match="rows = 1: allowed"):
        plot.waterfall(scene, rows=1)


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
