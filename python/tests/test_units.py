"""Quantities of astropy as input and output."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

u = pytest.importorskip("astropy.units")

from astropy.coordinates import Angle
from astropy.time import Time

import twofold
from twofold import units


def test_names_that_are_offered():
    assert all(hasattr(twofold.units, name) for name in twofold.units.__all__)


def test_units_of_every_group_of_columns_are_read():
    paper = units.table(twofold.Scene("tp-2").table(["rates", "L", "integrals", "m.n"]))
    assert paper["t"].unit == units.t_c
    assert paper["alpha_rate"].unit == u.rad / units.t_c
    assert paper["E"].to_value(units.I_xx / units.t_c**2) == pytest.approx(paper["E"].value)
    size = np.sqrt(sum(paper[f"L_{axis}"] ** 2 for axis in "XYZ"))
    assert size.unit == units.I_xx / units.t_c
    # The third integral is quadratic in L.
    assert (paper["K"] / size**2).unit == u.dimensionless_unscaled
    assert paper["m.n"].unit == u.dimensionless_unscaled


def test_units_of_a_physical_star_are_read():
    star = units.table(twofold.Scene("b1828-11", time={"years": None, "span": 10.0, "samples": 5}).table(["L", "integrals", "h"]))
    assert star["t"].unit == u.s
    momentum, spin = star["L_Z"][0], star["Omega_z"][0]
    inertia = (momentum / spin).to(u.g * u.cm**2, u.dimensionless_angles())
    assert 1e45 < inertia.value < 3e45
    assert star["E"].unit == u.erg


def test_words_and_counts_stay_plain():
    pulses = units.table(twofold.Scene("tp-1").pulses())
    assert pulses["cut"][0] == "start"
    assert not hasattr(pulses["turn"], "unit") or pulses["turn"].unit is None
    assert pulses["period"].unit == units.t_c
    with pytest.raises(twofold.Error, match="furlong"):
        units.unit("rad/furlong")


def test_the_unit_of_energy_is_that_of_inertia_over_time_squared():
    assert (1.0 * units.C * units.t_c**2).to_value(units.I_xx) == 1.0
    with pytest.raises(u.UnitConversionError):
        (1.0 * units.t_c).to(u.s)


def test_keys_take_quantities_of_any_unit():
    made = units.scene(
        "b1828-11",
        star={"radius": 1.1e4 * u.m, "mass": 1.5 * u.M_sun, "precession_period": (500 * u.d).to(u.s), "frequency": 2.4688717147 * 2 * np.pi * u.rad / u.s},
        pulsar={"rho": 6 * u.deg, "chi": 89 * u.deg},
        observer={"distance": 3160 * u.pc},
        lorentz_violation={"w": [369.0, 0.0, 0.0] * u.km / u.s},
        time={"years": 3652.5 * u.d, "epoch": Time(49621.25, format="mjd", scale="tdb")},
    )  # fmt: skip
    by_hand = twofold.Scene(
        "b1828-11",
        star={"radius": 11.0, "mass": 1.5, "precession_period": 500.0, "frequency": 2.4688717147},
        pulsar={"rho": np.radians(6.0), "chi": np.radians(89.0)},
        observer={"distance": 3.16},
        lorentz_violation={"w": [369.0 / 299792.458, 0.0, 0.0]},
        time={"years": 10.0, "epoch": "49621.25"},
    )
    assert made.pulsar().period == pytest.approx(by_hand.pulsar().period, rel=1e-14)
    assert made.span == pytest.approx(by_hand.span, rel=1e-15)
    assert made.pulsar().epoch == by_hand.pulsar().epoch
    columns = ["L", "m.n", "h"]
    short = {"years": None, "span": 1.0, "samples": 7}
    rows = [twofold.Scene(toml=one.toml, time=short).table(columns) for one in (made, by_hand)]
    for name in rows[0].keys():
        np.testing.assert_allclose(rows[0][name], rows[1][name], rtol=1e-9, atol=1e-12 * np.abs(rows[1][name]).max())


def test_a_place_in_the_sky_is_written_in_its_own_units():
    place = {"right_ascension": Angle("18h30m47.567s"), "declination": Angle("-10d59m27.92s")}
    made = units.scene("b1828-11", pulsar=place)
    assert "18:30:47.56700000" in made.toml
    assert "-10:59:27.9200000" in made.toml


def test_quantities_of_the_other_kind_of_scene_are_refused():
    assert units.scene("tp-1", time={"span": 30 * units.t_c}).span == (0.0, 30.0)
    with pytest.raises(twofold.Error, match=r"time.span = 3.0 s: must be a quantity in t_c"):
        units.scene("tp-1", time={"span": 3 * u.s})
    with pytest.raises(twofold.Error, match=r"star.mass = 1.0 km: must be a quantity in solMass"):
        units.scene("b1828-11", star={"mass": 1 * u.km})
    with pytest.raises(twofold.Error, match="pulsar.name"):
        units.scene("b1828-11", pulsar={"name": 3 * u.s})


def test_a_motion_takes_times_and_dates():
    motion = twofold.Scene("tp-2").motion()
    t = np.array([1.0, 20.0]) * units.t_c
    np.testing.assert_array_equal(units.axis(motion, t), motion.axis(t.value))
    n, momentum, _ = units.state(motion, t)
    assert momentum.unit == units.I_xx / units.t_c and n.shape == (2, 3)
    assert units.angles(motion, t).to_value(u.deg) == pytest.approx(np.degrees(motion.angles(t.value)))
    with pytest.raises(twofold.Error, match="t = 1.0 s: must be a quantity in t_c"):
        units.axis(motion, 1 * u.s)
    with pytest.raises(twofold.Error, match="t = 2.0: must be a quantity in t_c"):
        units.axis(motion, 2.0)

    star = twofold.Scene("b1828-11")
    assert units.times(star, Time(49621.5, format="mjd", scale="tdb")) == pytest.approx(43200.0, abs=1e-6)
    assert units.times(star, 2 * u.min) == 120.0


def test_arrival_times_keep_both_of_their_parts():
    pulsar = twofold.Scene("b1828-11").pulsar()
    dates = [50000.0, 50300.0, 50700.0, 51000.0, 52000.0]
    found = units.arrivals(pulsar, Time(dates, format="mjd", scale="tdb"), causes=True)
    plain = pulsar.arrivals(dates, causes=True)
    day, fraction = plain.table["arrival_day"], plain.table["arrival_fraction"]
    difference = found["arrival"] - Time(day, fraction, format="mjd", scale="tdb")
    assert np.abs(difference.to_value(u.s)).max() < 1e-11
    assert found["residual"].unit == u.s and found["spin_down_rate"].unit == u.Hz / u.s
    assert found.meta["F0"].to_value(u.Hz) == plain.frequency[0]
    assert found.meta["F1"].unit == u.Hz / u.s
    assert found.meta["PEPOCH"].mjd == float(plain.epoch)


#: Keys of docs/scenes.md, with a quantity in another unit and the number for a scene file.
KEYS = [
    ("star", "inertia_ratio", 110 * u.percent, 1.1),
    ("star", "oblateness", 0.1 * u.percent, 1e-3),
    ("star", "bulge", 2 * u.percent, 0.02),
    ("star", "spin", 90 * u.deg / units.t_c, np.pi / 2),
    ("star", "mass", 1.98840987e30 * u.kg, 1.0),
    ("star", "radius", 1.2e6 * u.cm, 12.0),
    ("star", "density", 4e17 * u.kg / u.m**3, 4e14),
    ("star", "precession_period", 12 * u.h, 0.5),
    ("star", "spin_frequency", -2 * np.pi * u.rad / u.s, -1.0),
    ("star", "frequency", 2 * u.kHz, 2000.0),
    ("spin_down", "f1", -2e-13 * np.pi * u.rad / u.s**2, -1e-13),
    ("spin_down", "f2", 2e-25 * np.pi * u.rad / u.s**3, 1e-25),
    ("spin_down", "index", 300 * u.percent, 3.0),
    ("spin_down", "damping_time", 100 * u.yr, 36525.0),
    ("lorentz_violation", "eigenvalues", [2, 1, -3] * u.percent, [0.02, 0.01, -0.03]),
    ("lorentz_violation", "tensor", np.diag([2, 1, -3]) * u.percent, [[0.02, 0.0, 0.0], [0.0, 0.01, 0.0], [0.0, 0.0, -0.03]]),
    ("lorentz_violation", "alpha_2", 1e-7 * u.percent, 1e-9),
    ("lorentz_violation", "w", [299.792458, 0.0, -2997.92458] * u.km / u.s, [1e-3, 0.0, -1e-2]),
    ("lorentz_violation", "w", [0.1, 0.0, -1.0] * u.percent, [1e-3, 0.0, -1e-2]),
    *(("initial", key, 90 * u.deg, np.pi / 2) for key in "alpha beta gamma alpha_0 beta_0 phase wobble azimuth precession_phase".split()),
    *(("initial", key, 90 * u.deg / units.t_c, np.pi / 2) for key in ("alpha_rate", "beta_rate", "amplitude")),
    *(("initial", key, 90 * u.deg / u.ms, 500 * np.pi) for key in ("alpha_rate", "beta_rate", "amplitude")),
    *(("observer", key, 90 * u.deg, np.pi / 2) for key in ("theta_o", "phi_o", "inclination", "azimuth")),
    ("observer", "distance", 2 * u.Mpc, 2000.0),
    *(("pulsar", key, 90 * u.deg, np.pi / 2) for key in ("chi", "delta", "rho")),
    *(("time", key, 2 * u.min, 120.0) for key in ("start", "span", "end")),
    *(("time", key, 2 * units.t_c, 2.0) for key in ("start", "span", "end")),
    ("time", "times", [1, 2] * u.h, [3600.0, 7200.0]),
    ("time", "years", 730.5 * u.d, 2.0),
]


@pytest.mark.parametrize(("section", "key", "quantity", "number"), KEYS)
def test_every_key_has_its_unit(section, key, quantity, number):
    found = units._plain(section, key, quantity, [], [])
    assert np.ravel(found) == pytest.approx(np.ravel(number), rel=1e-9)
    assert np.shape(found) == np.shape(number) and isinstance(found, type(number))
    with pytest.raises(twofold.Error, match=f"^{section}.{key} = .*: must be a quantity in "):
        units._plain(section, key, 1 * u.ampere, [], [])


def test_every_key_is_in_the_list():
    listed = {(section, key) for section, key, _, _ in KEYS}
    assert listed == set(units._KEYS)
    page = (Path(__file__).parents[2] / "docs" / "scenes.md").read_text()
    documented = set()
    for section, text in re.findall(r"^### `\[(\w+)\]`(.*?)(?=^##)", page, re.M | re.S):
        for table in text.split("\n| key | meaning | unit | allowed |\n|---|---|---|---|\n")[1:]:
            for row in table.split("\n\n")[0].splitlines():
                _, names, _, unit, *_ = row.replace("\\|", "").split("|")
                documented |= {(section, name) for name in re.findall(r"`(\w+)`", names) if unit.strip()}
    assert len(documented) > 25 and documented - listed == set()


def test_sections_and_texts_without_quantities():
    assert units.scene("tp-1", about="A star", pulsar=None) == twofold.Scene("tp-1", about="A star", pulsar=None)
    text = twofold.Scene("tp-2").toml
    assert units.scene(toml=text, time={"span": 30 * units.t_c}) == twofold.Scene(toml=text, time={"span": 30.0})
    with pytest.raises(twofold.Error, match=r"time.span = 3.0 t_c: must be a quantity in s"):
        units.scene("b1828-11", time={"span": 3 * units.t_c, "years": None})
    with pytest.raises(twofold.Error, match="time.span = .*: a date can only be used for time.epoch"):
        units.scene("b1828-11", time={"span": Time(50000.0, format="mjd", scale="tdb")})


def test_rates_of_a_physical_star():
    pulsar = {"mass": 1.35, "radius": 11.5, "oblateness": 1.2e-3, "spin_frequency": -23.4}
    start = {"alpha": 0.4, "beta": 0.9, "alpha_rate": 8.0, "beta_rate": 3.0}
    others = {"star": pulsar, "lorentz_violation": {"eigenvalues": [0.0, 0.0, 0.0]}, "time": {"span": 1.0, "samples": 2}}
    by_hand = twofold.Scene(initial=start, **others)
    made = units.scene(initial={**start, "alpha_rate": np.degrees(8.0) * u.deg / u.s}, **others)
    np.testing.assert_allclose(made.motion().axis(1.0), by_hand.motion().axis(1.0), atol=1e-9)
    momentum = units.state(made.motion(), 0 * u.s)[1]
    # A sphere of 1.42e45 g cm^2 to a part in a thousand, at slightly more than 147 rad/s.
    assert np.linalg.norm(momentum.to_value(u.kg * u.m**2 / u.s)) == pytest.approx(1.42e38 * 147.3, rel=5e-3)
    assert momentum.unit == u.g * u.cm**2 / u.s


def test_an_epoch_keeps_its_digits():
    made = units.scene("b1828-11", time={"epoch": Time(55321.0, 0.1234567890123, format="mjd", scale="tdb")})
    assert made.epoch == "55321.1234567890123"
    terrestrial = Time(55321.0, 0.5, format="mjd", scale="tai")
    assert float(units.scene("b1828-11", time={"epoch": terrestrial}).epoch) == pytest.approx(55321.5 + 32.184 / 86400, abs=1e-7)


def test_angles_of_any_unit_and_words():
    turned = units.scene("b1828-11", pulsar={"right_ascension": Angle(277.5 * u.deg), "declination": Angle(np.radians(10.5) * u.rad)})
    assert '"18:30:00.00000000"' in turned.toml and '"+10:30:00.0000000"' in turned.toml
    words = {"right_ascension": "18:30:47.567", "declination": "-10:59:27.92"}
    assert units.scene("b1828-11", pulsar=words) == twofold.Scene("b1828-11", pulsar=words)
    assert units.scene("b1828-11", pulsar={"rho": Angle(6 * u.deg)}) == twofold.Scene("b1828-11", pulsar={"rho": (6 * u.deg).to_value(u.rad)})


def test_dates_are_counted_from_the_start():
    """The epoch is at another time than zero."""
    star = twofold.Scene("b1828-11", time={"start": 12.0})
    assert units.times(star, Time(49621.5, format="mjd", scale="tdb")) == pytest.approx(43212.0, abs=1e-6)


def test_arrivals_are_sought_at_dates_of_any_scale():
    """For each date the nearest pulse, within half a period; UTC differs from TDB by a minute."""
    dates = Time([50000.0, 50300.0, 50700.0, 51000.0, 52000.0], format="mjd", scale="utc")
    found = units.arrivals(twofold.Scene("b1828-11").pulsar(), dates)
    assert np.abs((found["arrival"] - dates).to_value(u.s)).max() < 0.51 / 2.4688717147


def test_what_a_fit_to_arrivals_leaves_in_the_table():
    pulsar = twofold.Scene("b1828-11").pulsar()
    dates = Time([50000.0, 50300.0, 50700.0, 51000.0, 52000.0], format="mjd", scale="tdb")
    whole, first = units.arrivals(pulsar, dates), units.arrivals(pulsar, dates, derivatives=1)
    assert whole.meta["F2"].unit == u.Hz / u.s**2 and "F2" not in first.meta and first.meta["F1"].unit == u.Hz / u.s
    assert whole.meta["F0_REST"].to_value(u.Hz) == pulsar.arrivals(dates.mjd).frequency[1]
    assert whole.meta["PEPOCH"].scale == whole["arrival"].scale == "tdb"
    assert "arrival_fraction" not in whole.colnames and "torque" not in whole.colnames
    assert len(units.arrivals(pulsar)) == len(pulsar.arrivals().table) == 1000


def test_units_of_numbers_and_powers():
    assert units.unit("") is None and units.unit("1") == u.dimensionless_unscaled
    assert units.unit("1/s") == u.Hz and units.unit("(g cm^2/s)^2") == (u.g * u.cm**2 / u.s) ** 2
    assert [units.unit(text) for text in ("d", "MJD", "yr", "kpc", "km", "erg", "Hz/s", "deg")] == [u.d, u.d, u.yr, u.kpc, u.km, u.erg, u.Hz / u.s, u.deg]


def test_a_missing_package_is_named():
    code = "import sys; sys.modules['astropy'] = None; import twofold.units"
    done = subprocess.run([sys.executable, "-c", code], check=False, capture_output=True, text=True)
    assert "ImportError: twofold.units needs astropy" in done.stderr
    assert "pip install 'twofold[units]'" in done.stderr


def test_units_of_the_paper_have_names():
    assert [str(unit) for unit in (units.t_c, units.I_xx, units.C)] == ["t_c", "I_xx", "C"]
    assert [unit.__doc__ for unit in (units.t_c, units.I_xx, units.C)] == [
        "the unit of time of the paper, sqrt(I^xx / C)",
        "the moment of inertia about an axis in the equator",
        "the constant of the anisotropic self-energy",
    ]
