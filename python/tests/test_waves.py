"""Harmonics compared with the complete wave, counted turns, series."""

import sys
import types

import numpy as np
import pytest
import twofold
from twofold.waves import Waveform, seconds_since_epoch, strain


def source(eigenvalues=(0.0, 0.0, 0.0), momentum=(0.5, 0.3, 0.8), spin=100.0, **observer):
    return twofold.Scene(
        "wave-source",
        time={"epoch": "58000.0"},
        star={"spin_frequency": spin},
        pulsar={"chi": 1.0, "rho": 0.3},
        lorentz_violation={"eigenvalues": list(eigenvalues)},
        initial={"momentum": list(momentum)},
        observer=observer,
    ).pulsar()


def test_names_that_are_offered():
    assert all(hasattr(twofold.waves, name) for name in twofold.waves.__all__)


def added(pulsar, reference, dt, hands, knot_distance=None):
    """Both harmonics together along north and east."""
    total = np.zeros((2, *np.shape(dt)))
    for harmonic in ("once", "twice"):
        for hand in hands:
            waveform = Waveform(pulsar, harmonic, reference=reference, hand=hand, knot_distance=knot_distance)
            phase, a_plus, a_cross = waveform(dt)
            plus, cross = a_plus * np.cos(phase), a_cross * np.sin(phase)
            # The axis of lalpulsar at psi is at the position angle psi - pi/2.
            cos, sin = np.cos(2 * waveform.psi - np.pi), np.sin(2 * waveform.psi - np.pi)
            total += [plus * cos - cross * sin, plus * sin + cross * cos]
    return total


def size(pulsar, t):
    once, twice, *_ = pulsar.wave_harmonics(t)
    return np.max(once + twice)


@pytest.mark.parametrize("hands", [(None,), ("right", "left")])
@pytest.mark.parametrize("inclination", ["20 deg", "90 deg", "130 deg"])
def test_harmonics_add_up_to_the_wave(hands, inclination):
    pulsar = source(inclination=inclination, azimuth="40 deg")
    dt = np.linspace(-300.0, 300.0, 2001)
    reference = 12345.678
    whole = np.array(pulsar.wave(reference + dt))
    # 3e4 turns on each side: their phase is rounded to 5e-11 rad.
    assert abs(added(pulsar, reference, dt, hands) - whole).max() <= 1e-10 * size(pulsar, reference + dt)


def test_hands_follow_an_angular_momentum_that_turns():
    # s is so small that it affects the wave only through the motion of L; after 30 years L has turned.
    pulsar = source(eigenvalues=(2e-10, 1e-10, -3e-10))
    reference, dt = 1e9, np.linspace(0.0, 200.0, 1001)
    begin = pulsar.wave_harmonics(np.array([0.0, reference]))[4]
    assert abs(begin[1] - begin[0]) > 1e-3
    whole = np.array(pulsar.wave(reference + dt))
    assert abs(added(pulsar, reference, dt, ("right", "left")) - whole).max() <= 1e-10 * size(pulsar, reference)
    whole = np.array(pulsar.wave(dt))
    assert abs(added(pulsar, 0.0, dt, ("right", "left")) - whole).max() <= 1e-10 * size(pulsar, 0.0)
    # Towards larger and towards smaller position angles.
    for dt in (1e9, -1e9):
        with pytest.raises(twofold.Error, match="^psi: L turns by .* hand='right'"):
            Waveform(pulsar, "twice")(dt)


@pytest.mark.parametrize("s", [2e-2, 2e-4])
@pytest.mark.parametrize("spin", [20.0, 200.0])
def test_harmonics_lack_what_the_torque_does_within_a_turn(s, spin):
    """The number in docs/waves-in-python.md: proportional to s and to the inverse square of the spin."""
    pulsar = source(eigenvalues=(s, s / 2, -1.5 * s), spin=spin)
    dt = np.linspace(0.0, 50.0 / spin, 2001)
    whole = np.array(pulsar.wave(dt))
    off = abs(added(pulsar, 0.0, dt, ("right", "left"), knot_distance=1.0 / spin) - whole).max() / abs(whole[0]).max()
    assert off == pytest.approx(0.0306 * s * (20.0 / spin) ** 2, rel=0.01)


def test_a_strong_violation_by_hands():
    # L circulates in seconds. The harmonics are those of a torque-free star, so that their error is the effect of s on a turn; the hands add nothing
    # to it.
    pulsar = source(eigenvalues=(1e-2, 0.5e-2, -1.5e-2), spin=2.0)
    dt = np.linspace(-10.0, 10.0, 1001)
    once, twice, phase, i, angle, _ = pulsar.wave_harmonics(dt)
    assert np.ptp(angle) > 0.05
    plus = -once * np.sin(2 * i) / 2 * np.cos(phase) + twice * (1 + np.cos(i) ** 2) / 2 * np.cos(2 * phase)
    cross = -once * np.sin(i) * np.sin(phase) + twice * np.cos(i) * np.sin(2 * phase)
    cos, sin = np.cos(2 * angle), np.sin(2 * angle)
    formula = np.array([plus * cos - cross * sin, plus * sin + cross * cos])
    found = added(pulsar, 0.0, dt, ("right", "left"), knot_distance=0.5)
    assert abs(found - formula).max() <= 1e-11 * size(pulsar, dt)


def test_phases_are_counted_alike_one_by_one_and_at_once():
    pulsar = source()
    waveform = Waveform(pulsar, "once", reference=50.0)
    dt = np.linspace(-2000.0, 2000.0, 401)
    phase, plus, cross = waveform(dt)
    # The frequency of a free star does not change: |L| / I^xx.
    rate = np.diff(phase) / np.diff(dt)
    assert np.ptp(rate) <= 1e-9 * rate[0]
    other = Waveform(pulsar, "once", reference=50.0)
    for k in (400, 3, 200, 0, 201):
        one = other(float(dt[k]))
        assert all(isinstance(value, float) for value in one)
        assert one == (phase[k], plus[k], cross[k])
    assert phase[200] == pulsar.wave_harmonics(50.0)[2]
    twice, *_ = Waveform(pulsar, "twice", reference=50.0)(dt.reshape(1, -1))
    assert twice.shape == (1, 401)
    assert abs(twice[0] - 2 * phase).max() <= 1e-9


def test_turns_between_knots_far_apart():
    """A star that slows down: between knots 1e5 s apart the phase deviates by 8 rad from a straight line, but not from the cubic."""
    sections = {"time": {"epoch": "58000.0"}, "pulsar": {"chi": 1.0, "rho": 0.3}, "spin_down": {"f1": -1e-9, "torque": "constant"}}
    pulsar = twofold.Scene("wave-source", **sections).pulsar()
    dt = np.linspace(-2e6, 2e6, 2001)
    near, far = (Waveform(pulsar, "once", reference=1e5, knot_distance=distance)(dt)[0] for distance in (None, 1e5))
    assert abs(near - far).max() <= 2e-7


def test_knots_are_added_as_they_are_needed():
    """One time after another, farther and farther on both sides, or all at once."""
    pulsar = source()
    times = np.array([10.0, -10.0, 1e3, -2e3, 3e4, -5e4, 2e5, -1e5])
    whole, _, _ = Waveform(pulsar, "once", reference=50.0)(times)
    grown = Waveform(pulsar, "once", reference=50.0)
    assert [grown(t)[0] for t in times] == list(whole)


def test_how_far_a_phase_may_be_beside_the_smooth_one():
    waveform = Waveform(source(), "once")
    assert np.array_equal(waveform._missed(np.array([0.499, 2 * np.pi - 0.499])).round(9), [0.499, -0.499])
    for off in (0.501, 1.4, -0.501, np.nan):
        with pytest.raises(twofold.Error, match="use a smaller distance"):
            waveform._missed(np.array([0.0, off]))
    with pytest.raises(twofold.Error, match=r"dt = 2.000e\+03 s in size: must be at most a million knots, 1.000e\+03 s; use a nearer reference"):
        Waveform(source(), "once", reference=500.0, knot_distance=1e-3)(2000.0)


def test_hands_are_circular_and_the_right_one_is_seen_from_the_pole():
    """With `h_+ = a cos(dphi)` and `h_x = a sin(dphi)`. Seen along L the wave at twice the rotation has only one hand, and seen against L only the
    other."""
    dt = np.arange(6.0).reshape(2, 3)
    for inclination, strong, weak in (("1e-6 deg", "right", "left"), ("179.999999 deg", "left", "right")):
        pulsar = source(inclination=inclination, azimuth="40 deg")
        sizes = {}
        for hand, sign in (("right", 1.0), ("left", -1.0)):
            phase, plus, cross = Waveform(pulsar, "twice", hand=hand)(dt)
            assert phase.shape == plus.shape == cross.shape == (2, 3)
            assert np.array_equal(cross, sign * plus)
            sizes[hand] = abs(plus).max()
        assert sizes[weak] < 1e-12 * sizes[strong]
        assert sizes[strong] == pytest.approx(pulsar.wave_harmonics(0.0)[1], rel=1e-9)


def test_a_star_that_slows_down():
    sections = {"time": {"epoch": "58000.0"}, "pulsar": {"chi": 1.0, "rho": 0.3}, "spin_down": {"f1": -1e-9, "torque": "constant"}}
    pulsar = twofold.Scene("wave-source", **sections).pulsar()
    dt = np.linspace(0.0, 1e7, 11)
    turns = Waveform(pulsar, "once")(dt)[0] / (2 * np.pi)
    fit = np.polyfit(dt / 1e7, turns, 3)
    # F1 / 2 t^2 is 5e4 turns. F2 = n F1^2 / F0, with n up to 3, contributes at most 5 turns, and the next term 1e-3.
    assert abs(2 * fit[1] / 1e14 / -1e-9 - 1) < 1e-3
    assert abs(fit[0]) < 3e-20 * 1e21 / 6
    assert abs(turns - np.polyval(fit, dt / 1e7)).max() < 1e-3


def test_what_is_refused():
    pulsar = source()
    with pytest.raises(twofold.Error, match='harmonic = "?\'?thrice.*must be "once" or "twice"'):
        Waveform(pulsar, "thrice")
    with pytest.raises(twofold.Error, match="hand = 'both'"):
        Waveform(pulsar, "once", hand="both")
    with pytest.raises(twofold.Error, match="reference = nan"):
        Waveform(pulsar, "once", reference=np.nan)
    with pytest.raises(twofold.Error, match="knot_distance = 0"):
        Waveform(pulsar, "once", knot_distance=0.0)
    with pytest.raises(twofold.Error, match="knot_distance = inf"):
        Waveform(pulsar, "once", knot_distance=np.inf)
    upright = twofold.Scene("wave-source", time={"epoch": "58000.0"}, pulsar={"chi": 1.0, "rho": 0.3}, initial={"wobble": 0.0}).pulsar()
    with pytest.raises(twofold.Error, match="the wobble is zero; the star emits no wave"):
        Waveform(upright, "once")
    assert Waveform(pulsar, "once").knot_distance == 16384 * pulsar.period
    with pytest.raises(twofold.Error, match="dt: must be finite numbers"):
        Waveform(pulsar, "once")(np.inf)
    with pytest.raises(twofold.Error, match="a million knots"):
        Waveform(pulsar, "once", knot_distance=1e-3)(2000.0)
    nowhere = twofold.Scene("wave-source", time={"epoch": "58000.0"}, pulsar={"chi": 1.0, "rho": 0.3}, observer={"distance": None}, output=None).pulsar()
    with pytest.raises(twofold.Error, match="^the scene lacks `observer.distance`"):
        Waveform(nowhere, "once")
    strong = source(eigenvalues=(1e-2, 0.5e-2, -1.5e-2), spin=2.0)
    with pytest.raises(twofold.Error, match="knot_distance = .* smaller distance"):
        Waveform(strong, "once", hand="right")(np.linspace(0.0, 1e4, 101))


def test_seconds_of_gps():
    pulsar = source()
    # MJD 58000.0 TDB is 51.184 s before 1188432000 s after 1980 January 6 in days of 86400 s.
    assert seconds_since_epoch(pulsar, (58000 - 44244) * 86400 - 51.184) == pytest.approx(0.0, abs=2e-7)
    assert seconds_since_epoch(pulsar, 1188518400) == 1188518400 - (58000 - 44244) * 86400 + 51.184


def test_series_in_equal_steps():
    pulsar = source()
    plus, cross = strain(pulsar, 3.0, 0.5, 1024.0, gwpy=False)
    assert plus.shape == cross.shape == (512,)
    whole = pulsar.wave(3.0 + np.arange(512) / 1024)
    assert np.array_equal(plus, whole[0]) and np.array_equal(cross, whole[1])
    assert strain(pulsar, 3.0, 1.0, 1.0, gwpy=False)[0] == pulsar.wave(3.0)[0]


def test_a_series_has_its_last_sample():
    """In doubles, 0.29 times 100 is 28.999999999999996."""
    plus, cross = strain(source(), 3.0, 0.29, 100.0, gwpy=False)
    assert plus.shape == cross.shape == (29,)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((np.nan, 1.0, 16.0), "start = nan s: must be a finite number"),
        ((0.0, -1.0, 16.0), "duration = -1.0 s: must be a finite number above zero"),
        ((0.0, 0.0, 16.0), "duration = 0.0 s: must be"),
        ((0.0, np.inf, 16.0), "duration = inf s: must be"),
        ((0.0, 1.0, 0.0), "rate = 0.0 Hz: must be a finite number above zero"),
        ((0.0, 0.4, 1.0), "duration = 0.4 s at rate = 1.0 Hz: must be from 1 to 1e9 samples"),
        ((0.0, 1e9 + 1, 1.0), "duration = 1000000001.0 s at rate = 1.0 Hz: must be from 1 to 1e9 samples"),
    ],
)
def test_series_that_cannot_be(arguments, words):
    with pytest.raises(twofold.Error, match=words):
        strain(source(), *arguments)


def test_the_largest_series_is_allowed(monkeypatch):
    """A thousand million samples: detected on request, before they are made."""
    monkeypatch.setattr(np, "arange", lambda count: pytest.fail("made") if count > 10**9 else np.float64(count))
    plus, _ = strain(source(), -1e9, 1e9, 1.0, gwpy=False)
    assert plus == source().wave(0.0)[0]


def test_what_is_handed_to_gwpy(monkeypatch):
    """GPS times: MJD 58000 TDB is 51.184 s before 1188518400 s of GPS counted in days of 86400 s from 1980 January 6."""
    module = types.ModuleType("gwpy.timeseries")
    module.TimeSeries = lambda values, **options: (values, options)
    monkeypatch.setitem(sys.modules, "gwpy", types.ModuleType("gwpy"))
    monkeypatch.setitem(sys.modules, "gwpy.timeseries", module)
    pulsar = source()
    whole = strain(pulsar, 3.0, 0.5, 16.0, gwpy=False)
    begin = (58000 - 44244) * 86400 - 51.184 + 3.0
    for given in (None, True):
        for (values, options), expected, name in zip(strain(pulsar, 3.0, 0.5, 16.0, gwpy=given), whole, ("h_plus", "h_cross"), strict=True):
            assert np.array_equal(values, expected)
            assert options == {"t0": pytest.approx(begin, abs=1e-6), "sample_rate": 16.0, "unit": "strain", "name": name}


def test_without_gwpy_arrays_are_given(monkeypatch):
    monkeypatch.setitem(sys.modules, "gwpy", None)
    pulsar = source()
    assert np.array_equal(strain(pulsar, 3.0, 0.5, 16.0), strain(pulsar, 3.0, 0.5, 16.0, gwpy=False))
    with pytest.raises(ImportError):
        strain(pulsar, 3.0, 0.5, 16.0, gwpy=True)


def test_what_a_waveform_says_of_itself():
    pulsar = source()
    assert repr(Waveform(pulsar, "once", reference=2)) == f"Waveform({pulsar!r}, 'once', reference=2.0)"
    assert repr(Waveform(pulsar, "twice", hand="left")) == f"Waveform({pulsar!r}, 'twice', reference=0.0, hand='left')"


def test_series_of_gwpy():
    pytest.importorskip("gwpy")
    pulsar = source()
    plus, cross = strain(pulsar, 3.0, 0.5, 1024.0)
    assert (plus.name, cross.name) == ("h_plus", "h_cross")
    assert abs(seconds_since_epoch(pulsar, float(plus.t0.value)) - 3.0) < 2e-7
    assert plus.sample_rate.value == cross.sample_rate.value == 1024.0
    assert np.array_equal(plus.value, strain(pulsar, 3.0, 0.5, 1024.0, gwpy=False)[0])
