"""The pulsar of docs/worked-pulsar.md: the package compared with the printed output of the command, which an independent program has checked."""

import re
from pathlib import Path

import numpy as np
import pytest

import twofold

PAGE = (Path(__file__).parents[2] / "docs" / "worked-pulsar.md").read_text()
DAY = 86400.0


def printed(command):
    """The printed output of a command on the page, without notes."""
    after = PAGE.split(f"$ {command}\n")[1]
    return [line for line in re.split(r"\n(?:\$ |```)", after)[0].splitlines() if not line.startswith("note: ")]


def numbers(lines):
    """Columns of a printed table, by their names without units."""
    names = [re.sub(r" \[.*?\]$", "", name) for name in lines[0].split(",")]
    rows = [[float(word) if word and word != "start" else np.nan for word in line.split(",")] for line in lines[1:]]
    return dict(zip(names, np.array(rows).T, strict=True))


@pytest.fixture(scope="module")
def scene():
    return twofold.Scene(toml=PAGE.split("```toml\n")[1].split("```")[0])


@pytest.fixture(scope="module")
def pulsar(scene):
    return scene.pulsar()


@pytest.fixture(scope="module")
def timing(pulsar):
    return pulsar.arrivals(np.linspace(55321.1234567890123, 57000.0, 4))


def same(found, expected, rel=1e-9, **tolerance):
    assert found == pytest.approx(expected, rel=rel, nan_ok=True, **tolerance)


@pytest.mark.parametrize("columns", ["angles,rates", "e_x,e_z", "L,integrals", "lambda,m.n,magnetic_axis", "position_angle,h"])
def test_tables(scene, columns):
    lines = printed(f"twofold run pulsar.toml --columns {columns}")
    table = scene.table(columns.split(","))
    assert table.csv.decode().splitlines()[0] == lines[0] and len(table) == 3
    for name, expected in numbers(lines).items():
        same(table[name], expected)


def test_the_motion_at_these_times(scene):
    motion = scene.motion()
    angles, axes, momentum = (numbers(printed(f"twofold run pulsar.toml --columns {of}")) for of in ("angles,rates", "e_x,e_z", "L,integrals"))
    t = angles["t"]
    assert motion.span == (12.0, 12.3) == scene.span
    same(motion.angles(t), np.stack([angles[name] for name in ("alpha", "beta", "gamma")], axis=-1))
    for found, of, name in zip(motion.state(t), (axes, momentum, axes), ("e_z", "L", "e_x"), strict=True):
        same(found, np.stack([of[f"{name}_{axis}"] for axis in "XYZ"], axis=-1))
    # The note on the page is 7.2e-13 for these columns at the end of the span; any method is below ten times that.
    assert 0.0 < motion.error(12.3) < 7e-12


def test_pulses(scene):
    lines = printed("twofold pulses pulsar.toml | sed -n 1,6p")
    table = scene.pulses()
    assert table.csv.decode().splitlines()[0] == lines[0]
    for name, expected in numbers(lines).items():
        if name != "cut":
            same(table[name][:5], expected)
    assert table["cut"][:2] == ["start", ""]


def test_arrival_times(timing):
    for command in ("1-6", "1,7-10", "1,11-16"):
        for name, expected in numbers(printed(f"cut -d, -f{command} timing/pulsar.csv")).items():
            # Arrivals are rounded to 1e-16 d, and so are residuals.
            same(timing.table[name], expected, abs=1e-11 if name == "residual" else 1e-13)
    text = "\n".join(printed("twofold timing pulsar.toml --to 57000 --epochs 4 --out timing"))
    frequency, epoch, rms = re.search(r"F0 = (\S+) Hz at MJD (\S+);.*rms (\S+) s", text).groups()
    assert timing.epoch == epoch and timing.derivatives == [] and timing.dark == 0
    assert timing.frequency[0] == float(frequency) and abs(timing.frequency[1]) < 2e-15
    same(sum(np.longdouble(part) for part in timing.frequency), np.longdouble(frequency), rel=1e-16)
    assert repr(timing) == f"<Timing: 4 pulses, residuals of {float(rms):.3e} s (root mean square)>".replace("e-05", "e-5")


def test_files_of_timing_programs(timing):
    for made, command in ((timing.par, "cat timing/pulsar.par"), (timing.tim(), "cat timing/pulsar.tim")):
        for line, expected in zip(made.splitlines(), printed(command), strict=True):
            words, wanted = line.split(), expected.split()
            assert len(words) == len(wanted)
            for word, of_page in zip(words, wanted, strict=True):
                if re.fullmatch(r"[\d.]+", of_page):
                    same(float(word), float(of_page), rel=1e-15)
                else:
                    assert word == of_page
    assert timing.tim(2.5e-6).splitlines()[1].split()[3] == "2.5"


def test_both_precessions(pulsar):
    text = PAGE.split("precession period of the body about its axis: ")[1].splitlines()[0]
    periods = [float(word) for word in re.findall(r"(\S+) d", text)]
    same(2.0 * np.pi / np.abs(pulsar.precession_rates) / DAY, periods, rel=1e-6)
    # F0 of the page, for a star that does not slow down; L precesses meanwhile.
    same(pulsar.period, 1.0 / 23.426073396950399, rel=1e-8)


def test_the_wave(pulsar, scene):
    # Times of the pulsar count from its epoch, which is at 12 s of the scene.
    strain = [line.split() for line in printed("sed -n 1,3p timing/pulsar.h_cross.txt")[1:]]
    same(pulsar.wave([float(t) for t, _ in strain])[1], [float(h) for _, h in strain], rel=1e-6)
    rows = numbers(printed("twofold run pulsar.toml --columns position_angle,h"))
    plus, cross = pulsar.wave(rows["t"] - 12.0)
    # The phases have an error of first order in s.
    same(plus, rows["h_plus"], rel=1e-6)
    same(cross, rows["h_cross"], rel=1e-5)


def test_harmonics_of_the_wave(pulsar):
    first = numbers(printed("cut -d, -f1-6 timing/pulsar.csv"))
    columns = {k: v for command in ("1,7-10", "1,11-16") for k, v in numbers(printed(f"cut -d, -f{command} timing/pulsar.csv")).items()}
    t = (first["arrival_fraction"][0] - 0.1234567890123) * DAY
    found = pulsar.wave_harmonics(t)
    for value, name in zip(found, ("h_once", "h_twice", "wave_phase", "inclination", "orientation", "wobble"), strict=True):
        # The time of a row is rounded to 1e-12 s.
        same(value, columns[name][0], rel=1e-8)


def test_what_such_data_would_tell(scene):
    lines = printed("twofold fisher pulsar.toml --observe arrivals:1e-6,widths:1e-6 --parameters eps,spin,rho,chi")
    rows = [line.split() for line in lines[2:]]
    found = scene.fisher({"arrivals": 1e-6, "widths": 1e-6}, ["eps", "spin", "rho", "chi"])
    assert found.unknowns == ["eps", "spin", "rho", "chi"] and found.undetermined == []
    same(found.values, [float(row[1]) for row in rows])
    same(found.sigmas, [float(row[2]) for row in rows], rel=6e-3)
    same(np.sqrt(np.diag(found.covariance)), found.sigmas, rel=1e-12)
    correlations = found.covariance / np.outer(found.sigmas, found.sigmas)
    assert [correlations[a, b] for a, b in ((0, 1), (1, 0), (2, 3), (3, 2))] == pytest.approx([0.8191, 0.8191, -0.9916, -0.9916], abs=6e-5)
    assert (found.model, found.chi_squared, found.degrees, found.residuals, found.judged, found.nonlinearity) == (None,) * 6
    words = re.findall(r"(\w+) = (\S+) \+- ([^\s,>]+)", repr(found))
    assert [word[0] for word in words] == found.unknowns
    same([float(word[1]) for word in words], found.values)
    same([float(word[2]) for word in words], found.sigmas, rel=0.06)


def test_what_a_symmetry_hides(scene):
    found = scene.fisher({"arrivals": 1e-6, "widths": 1e-6}, ["spin", "chi", "delta", "gamma", "rho"])
    (hidden,) = found.undetermined
    assert "gamma against delta" in hidden
    same(found.sigmas[[0, 1, 4]], [8.86e-4, 4.49e-2, 5.05e-3], rel=6e-3)
    assert not np.isfinite(found.sigmas[[2, 3]]).any()


def test_a_fit_to_its_own_pulses(scene):
    """Without simulated errors the fit ends at the scene, with the predicted standard deviations."""
    observe, names = {"arrivals": 1e-6, "widths": 1e-6}, ["spin", "chi", "rho"]
    foretold = scene.fisher(observe, names)
    found = scene.fit([scene.pulses()], observe, names)
    assert found.degrees == 9 and found.chi_squared < 1e-3 and found.judged == "smaller"
    same(found.values, [-147.0265361880024, 1.35, 0.5])
    same(found.sigmas, foretold.sigmas, rel=1e-5)
    same(found["chi"], (found.values[1], found.sigmas[1]))
    # Error bars are rough as on the page, where with two arrivals less chi^2 deviates from its parabola by 1.8.
    assert 0.3 < found.nonlinearity < 1.8
