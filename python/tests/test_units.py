"""Quantities of astropy in and out."""

import subprocess
import sys

import numpy as np
import pytest

u = pytest.importorskip("astropy.units")

from astropy.coordinates import Angle
from astropy.time import Time

import twofold
from twofold import units


def test_units_of_every_group_of_columns_are_read():
    paper = units.table(twofold.Scene("tp-2").table(["rates", "L", "integrals", "m.n"]))
    assert paper["t"].unit == units.t_c
    assert paper["alpha_rate"].unit == u.rad / units.t_c
    assert paper["E"].to_value(units.I_xx / units.t_c**2) == pytest.approx(paper["E"].value)
    size = np.sqrt(sum(paper[f"L_{axis}"] ** 2 for axis in "XYZ"))
    assert size.unit == units.I_xx / units.t_c
    # The third integral is of second order in L.
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
    with pytest.raises(twofold.Error, match=r"time.span = 3.0 s: allowed is a quantity in t_c"):
        units.scene("tp-1", time={"span": 3 * u.s})
    with pytest.raises(twofold.Error, match=r"star.mass = 1.0 km: allowed is a quantity in solMass"):
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
    with pytest.raises(twofold.Error, match="t = 1.0 s: allowed is a quantity in t_c"):
        units.axis(motion, 1 * u.s)
    with pytest.raises(twofold.Error, match="t = 2.0: allowed is a quantity in t_c"):
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


def test_a_missing_package_is_named():
    code = "import sys; sys.modules['astropy'] = None; import twofold.units"
    done = subprocess.run([sys.executable, "-c", code], check=False, capture_output=True, text=True)
    assert "ImportError: twofold.units needs astropy" in done.stderr
    assert "pip install 'twofold[units]'" in done.stderr
