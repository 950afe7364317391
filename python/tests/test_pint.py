"""The wobble component of PINT. Skipped as a whole if and only if pint-pulsar is not installed."""

import copy
import io
import pickle
import warnings
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import twofold

pytest.importorskip("pint.models", reason="pint-pulsar is not installed")

import astropy.units as u  # noqa: E402
import pint.logging  # noqa: E402
from astropy.utils import iers  # noqa: E402
from pint.exceptions import InvalidModelParameters, MissingParameter  # noqa: E402
from pint.fitter import DownhillGLSFitter, DownhillWLSFitter, Fitter, GLSFitter, WLSFitter  # noqa: E402
from pint.gridutils import grid_chisq  # noqa: E402
from pint.models import get_model  # noqa: E402
from pint.models.tcb_conversion import IFTE_K  # noqa: E402
from pint.residuals import Residuals  # noqa: E402
from pint.toa import get_TOAs  # noqa: E402

import twofold.pint  # noqa: E402
from twofold.pint import _Beyond, _Projected, _Star, add_wobble, wobble_limits  # noqa: E402

pint.logging.setup("ERROR")
iers.conf.auto_download = False
iers.conf.auto_max_age = None

DAY = 86400.0
EPOCH = 51447
SPIN = f"""PSR J0000+0000
RAJ 00:00:00
DECJ 00:00:00
PEPOCH {EPOCH}
EPHEM builtin
CLK TT(TAI)
UNITS TDB
"""
WOBBLE = {"WOBBLE": 2.0, "WOBCHI": 70.0, "WOBPERIOD": 400.0, "WOBPHASE": 30.0, "WOBTORQUE": 0.7}


def model_of(lines: str):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return get_model(io.StringIO(SPIN + lines))


def wobbling(f0=2.5, f1=-3.7e-13, **changes):
    values = {**WOBBLE, **changes}
    return model_of(f"F0 {f0!r} 1\nF1 {f1!r} 1\n" + "".join(f"{name} {value!r} 1\n" for name, value in values.items()))


def toas_of(tmp_path, days, fractions, sigma, model, numbers=None, flags=""):
    """Barycentred arrival times: no clock files are needed."""
    lines = ["FORMAT 1\n"]
    for k, (day, fraction) in enumerate(zip(days, fractions)):
        whole = int(day) + int(np.floor(fraction))
        number = "" if numbers is None else f" -pn {int(numbers[k])}"
        lines.append(f"pulsar 0 {whole}.{fraction % 1.0:.17f} {sigma * 1e6} @{number}{flags}\n".replace(".0.", "."))
    path = tmp_path / "arrivals.tim"
    path.write_text("".join(lines))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return get_TOAs(str(path), model=model)


@pytest.fixture
def spread(tmp_path):
    """Arrival times over ten years, at random phases."""
    random = np.random.default_rng(5)
    days = np.sort(random.uniform(EPOCH - 1800, EPOCH + 1800, 200))
    return toas_of(tmp_path, days // 1, days % 1, 2e-5, wobbling())


@pytest.fixture(scope="module")
def b1828(tmp_path_factory):
    """Arrival times of the scene b1828-11 from the pulse clock, which follows the motion independently of the component, with errors of 20 us; and
    the true parameters at PEPOCH."""
    random = np.random.default_rng(3)
    timing = twofold.Scene("b1828-11").pulsar().arrivals(np.sort(random.uniform(49621, 53271, 400)), derivatives=2)
    fractions = timing.table["arrival_fraction"] + random.normal(0.0, 2e-5, 400) / DAY
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        model = get_model(io.StringIO(timing.par + "EPHEM builtin\nCLK TT(TAI)\n"))
    path = tmp_path_factory.mktemp("b1828")
    toas = toas_of(path, timing.table["arrival_day"], fractions, 2e-5, model, timing.table["pulse"])
    for name in ("F0", "F1", "F2"):
        getattr(model, name).frozen = False
    since = (float(model.PEPOCH.value) - 49621.0) * DAY
    kappa = 3.6568e-13 / 2.4688717147
    tau = 2.0 * since / (1.0 + np.sqrt(1.0 + 2.0 * kappa * since))
    truth = {
        "WOBBLE": 3.0,
        "WOBPERIOD": 500.0 * (1 + kappa * tau),
        "WOBPHASE": (90.0 + tau / DAY / 500.0 * 360.0) % 360.0,
    }
    return model, toas, truth


def started(b1828):
    model, toas, truth = b1828
    model = copy.deepcopy(model)
    add_wobble(model, toas, period=495 * u.day, chi=89 * u.deg, torque=1.0)
    return model, toas, truth


def drawn(random):
    """Stars of all kinds, with their values from the Rust library."""
    while True:
        f0 = 10 ** random.uniform(-1, 2.85)
        f1 = -f0 * 10 ** random.uniform(-19, -12)
        chi = random.uniform(0.02, np.pi - 0.02)
        wobble = min(chi, np.pi - chi, 1.5) * 10 ** random.uniform(-5, -0.05)
        rate, phase = 2 * np.pi / (10 ** random.uniform(1, 3.3) * DAY), random.uniform(0, 2 * np.pi)
        torque = random.choice([0.0, random.uniform(0, 1), 1.0])
        given = dict(chi=chi, precession_rate=rate, precession_phase=phase, torque_share=torque)
        try:
            with_wobble = twofold.TimingModel(f0, f1=f1, wobble=wobble, **given)
        except twofold.Error:
            continue
        return _Star(f0, f1, wobble, chi, rate, phase, torque), with_wobble, with_wobble.moved(wobble=-wobble)


def test_names_that_are_offered():
    assert all(hasattr(twofold.pint, name) for name in twofold.pint.__all__)


def test_turns_and_derivatives_are_those_of_the_timing_model():
    """The Rust library has the phase in two doubles, so that its differences are accurate to 1e-16 of a turn; psi of thousands of rad is accurate to
    1e-12."""
    random = np.random.default_rng(1)
    t = np.linspace(-4e8, 4e8, 101)
    names = {
        "wobble": "wobble",
        "chi": "chi",
        "phase": "precession_phase",
        "rate": "precession_rate",
        "torque": "torque_share",
    }
    for _ in range(200):
        star, with_wobble, without = drawn(random)
        beyond = _Beyond(star, t)
        (whole, rest, by), (plain, plain_rest, plain_by) = (
            of.phase_and_derivatives(t) for of in (with_wobble, without)
        )
        expected = (whole - plain) + (rest - plain_rest)
        assert np.max(np.abs(beyond.turns - expected)) < 1e-12 * max(1.0, np.max(np.abs(expected))), star
        column = twofold.TimingModel.names.index
        for mine, theirs in names.items():
            expected = by[:, column(theirs)]
            off = np.max(np.abs(beyond.derivatives[mine] - expected))
            assert off <= 1e-11 * np.max(np.abs(expected)), (mine, star)
        for name in ("f0", "f1"):
            whole_of_it = plain_by[:, column(name)]
            expected = by[:, column(name)] - whole_of_it
            assert np.max(np.abs(beyond.derivatives[name] - expected)) < 1e-14 * np.max(np.abs(whole_of_it)), (
                name,
                star,
            )


def test_no_rounding_at_1e11_turns():
    t = np.linspace(-1.0, 1.0, 51) * 3.15e8 * 0.5
    star = _Star(642.0, -4.3e-14, 3e-5, 0.8, 2 * np.pi / (300 * DAY), 1.0, 0.5)
    with_wobble = twofold.TimingModel(
        642.0, f1=-4.3e-14, wobble=3e-5, chi=0.8, precession_rate=star.rate, precession_phase=1.0, torque_share=0.5
    )
    (whole, rest), (plain, plain_rest) = with_wobble.phase(t), with_wobble.moved(wobble=-3e-5).phase(t)
    assert np.max(np.abs(whole)) > 1e11
    assert np.max(np.abs(_Beyond(star, t).turns - ((whole - plain) + (rest - plain_rest)))) < 1e-15


@pytest.mark.parametrize("name", ["WOBBLE", "WOBCHI", "WOBPERIOD", "WOBPHASE", "WOBTORQUE", "F0", "F1"])
def test_derivatives_against_differences(spread, name):
    """Derivatives of the component compared with Richardson differences for steps of 1e-3 and 5e-4: their remainder is of order 1e-12, and phases of
    order 1 are rounded to 1e-16 over 1e-3."""
    model = wobbling(f1=-3.7e-12)
    component, delay = model.components["Wobble"], model.delay(spread)
    analytic = component.d_wobble_phase_d_param(spread, name, delay)
    parameter = getattr(model, name)
    value = parameter.value

    def difference(step):
        phases = []
        for sign in (1, -1):
            parameter.value = value * (1 + sign * step)
            phases.append(component.wobble_phase(spread, delay))
        parameter.value = value
        return (phases[0] - phases[1]) / (2 * step * float(value) * parameter.units)

    step = 1e-3 if name != "WOBPERIOD" else 1e-4
    numeric = (4 * difference(step / 2) - difference(step)) / 3
    assert np.max(np.abs(analytic)) > 0
    assert np.max(np.abs((analytic - numeric).to_value(1 / parameter.units))) < 1e-8 * np.max(np.abs(analytic)).value


def test_derivative_by_the_delay(spread):
    model = wobbling(f1=-3.7e-12)
    component, delay = model.components["Wobble"], model.delay(spread)
    step = 2e4 * u.s
    differences = [
        (component.wobble_phase(spread, delay + k * step) - component.wobble_phase(spread, delay - k * step))
        / (2 * k * step)
        for k in (1, 2)
    ]
    numeric = (4 * differences[0] - differences[1]) / 3
    analytic = component.d_wobble_phase_d_delay(spread, delay)
    assert np.max(np.abs(analytic - numeric)) < 1e-8 * np.max(np.abs(analytic))
    # PINT adds it to that of Spindown for every parameter of a delay.
    assert model.d_phase_d_delay_funcs[-1] == component.d_wobble_phase_d_delay


def test_pint_has_the_phase_and_the_derivatives(spread):
    model, plain = wobbling(), wobbling()
    plain.remove_component("Wobble")
    component, delay = model.components["Wobble"], model.delay(spread)
    added = model.phase(spread, abs_phase=False) - plain.phase(spread, abs_phase=False)
    turns = np.asarray(added.int.value + added.frac.value, float)
    # Extended doubles of 4e8 turns are accurate to 2e-11.
    assert np.max(np.abs(turns - component.wobble_phase(spread, delay).value)) < 1e-10
    matrix, names, _ = model.designmatrix(spread)
    for name in component.params:
        expected = -component.d_wobble_phase_d_param(spread, name, delay).value / float(model.F0.value)
        assert np.array_equal(matrix[:, names.index(name)].astype(float), expected.astype(float)), name
    total = model.d_phase_d_param(spread, delay, "F1") - plain.d_phase_d_param(spread, delay, "F1")
    expected = component.d_wobble_phase_d_param(spread, "F1", delay)
    assert np.max(np.abs(total - expected)) < 1e-9 * np.max(np.abs(expected))


@pytest.mark.parametrize("fitter", [WLSFitter, DownhillWLSFitter, GLSFitter, DownhillGLSFitter])
def test_fits_find_the_wobble_of_the_pulse_clock(b1828, fitter):
    model, toas, truth = started(b1828)
    fit = fitter(toas, model)
    fit.fit_toas(maxiter=10)
    fit.model.components["Wobble"].positive()
    for name, value in truth.items():
        parameter = getattr(fit.model, name)
        assert abs(parameter.value - value) < 3 * parameter.uncertainty_value, (name, parameter)
        assert parameter.uncertainty_value < 0.02 * abs(value), name
    assert 0.8 < fit.resids.reduced_chi2 < 1.2


def test_chi_and_the_torque_can_be_fitted(b1828):
    """The second harmonic separates chi from the wobble."""
    model, toas, truth = started(b1828)
    model.WOBCHI.frozen = False
    fit = Fitter.auto(toas, model)
    fit.fit_toas()
    assert abs(fit.model.WOBCHI.value - 89.0) < 3 * fit.model.WOBCHI.uncertainty_value
    assert fit.model.WOBCHI.uncertainty_value < 1.0
    assert abs(fit.model.WOBBLE.value - truth["WOBBLE"]) < 3 * fit.model.WOBBLE.uncertainty_value


def test_fits_with_red_noise_and_epoch_noise(b1828):
    model, toas, truth = started(b1828)
    lines = "EFAC -f a 1.1\nECORR -f a 3\nTNREDAMP -13.5\nTNREDGAM 3\nTNREDC 10\n"
    noisy = model_of_par(model.as_parfile() + lines)
    toas = copy.deepcopy(toas)
    for flags in toas.table["flags"]:
        flags["f"] = "a"
    fit = Fitter.auto(toas, noisy)
    assert isinstance(fit, DownhillGLSFitter)
    fit.fit_toas()
    for name, value in truth.items():
        parameter = getattr(fit.model, name)
        assert abs(parameter.value - value) < 3 * parameter.uncertainty_value, (name, parameter)
    white = Fitter.auto(toas, model)
    white.fit_toas()
    assert fit.model.WOBPERIOD.uncertainty_value > white.model.WOBPERIOD.uncertainty_value


def model_of_par(text):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return get_model(io.StringIO(text))


def test_the_grid_has_its_least_at_the_fit(b1828):
    model, toas, _ = started(b1828)
    fit = Fitter.auto(toas, model)
    fit.fit_toas()
    best = fit.model.WOBBLE
    wobbles = (best.value + np.array([-2, 0, 2]) * best.uncertainty_value) * u.deg
    found, _ = grid_chisq(fit, ("WOBBLE",), (wobbles,), ncpu=1, printprogress=False)
    # For a normal posterior chi^2 is larger by four at two standard deviations.
    assert found - found[1] == pytest.approx([4, 0, 4], abs=0.2)
    with ThreadPoolExecutor(2) as executor:
        again, _ = grid_chisq(fit, ("WOBBLE",), (wobbles,), executor=executor, printprogress=False)
    # PINT ends a fit when chi^2 falls by less than 1e-2.
    assert again == pytest.approx(found, abs=1e-2)


def test_a_par_file_keeps_the_model(spread):
    model = wobbling(WOBBLE=1.2345678901234567, WOBPHASE=123.45678901234567)
    model.WOBBLE.uncertainty_value = 0.0125
    again = model_of_par(model.as_parfile())
    for name in model.components["Wobble"].params:
        for what in ("value", "uncertainty_value", "frozen"):
            assert getattr(getattr(again, name), what) == getattr(getattr(model, name), what), (name, what)
    off = again.phase(spread, abs_phase=False) - model.phase(spread, abs_phase=False)
    # F0 and F1 are written with the digits of an extended double.
    assert np.max(np.abs((off.int + off.frac).value)) < 1e-10
    assert again.WOBPERIOD.quantity == 400 * u.day


def test_a_time_in_tcb_is_converted():
    lines = wobbling().as_parfile().replace("TDB", "TCB")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        model = get_model(io.StringIO(lines), allow_tcb=True)
    assert model.UNITS.value == "TDB"
    assert model.WOBPERIOD.value == pytest.approx(400.0 / float(IFTE_K), rel=1e-14)
    assert model.WOBCHI.value == 70.0


def test_copies_and_pickles(spread):
    model = wobbling()
    expected = Residuals(spread, model).time_resids
    for again in (copy.deepcopy(model), pickle.loads(pickle.dumps(model))):
        assert again.components["Wobble"]._last is None
        assert np.array_equal(Residuals(spread, again).time_resids, expected)
        again.WOBBLE.value = 1.0
        assert not np.array_equal(Residuals(spread, again).time_resids, expected)
    assert np.array_equal(Residuals(spread, model).time_resids, expected)


def test_a_changed_parameter_is_seen(spread):
    model = wobbling()
    component, delay = model.components["Wobble"], model.delay(spread)
    first = component.wobble_phase(spread, delay)
    assert np.array_equal(component.wobble_phase(spread, delay), first)
    model.F1.value *= 2
    assert not np.array_equal(component.wobble_phase(spread, delay), first)
    model.F1.value /= 2
    assert np.array_equal(component.wobble_phase(spread[:7], delay[:7]), first[:7])


REFUSED = [
    ({"WOBBLE": -0.5}, r"WOBBLE = -0.5 deg: must be 0 or more; .* WOBBLE = 0.5 deg and WOBPHASE = 210.0 deg"),
    ({"WOBBLE": -0.5, "WOBPHASE": 200.0}, r"has WOBBLE = 0.5 deg and WOBPHASE = 20.0 deg"),
    ({"WOBBLE": 70.0}, r"WOBBLE = 70 deg: must be below 70 deg, .*WOBCHI = 70 deg"),
    ({"WOBBLE": 75.0}, r"WOBBLE = 75 deg: must be below 70 deg, .*WOBCHI = 70 deg"),
    ({"WOBCHI": 179.0}, r"WOBBLE = 2 deg: must be below 1 deg"),
    ({"WOBCHI": 0.0}, r"WOBCHI = 0 deg: must be above 0 and below 180 deg"),
    ({"WOBCHI": 190.0}, r"WOBCHI = 190 deg: must be above 0 and below 180 deg"),
    ({"WOBPERIOD": 0.0}, r"WOBPERIOD = 0.0 d: must be above 0"),
    ({"WOBPERIOD": -3.0}, r"WOBPERIOD = -3.0 d: must be above 0"),
    ({"WOBPERIOD": float("nan")}, r"WOBPERIOD = nan d: must be above 0"),
    ({"WOBPERIOD": float("inf")}, r"WOBPERIOD = inf d: must be above 0 and finite"),
    ({"WOBPHASE": float("nan")}, r"precession_phase"),
    ({"WOBTORQUE": 1.5}, r"WOBTORQUE = 1.5: must be from 0 to 1"),
    ({"f1": -1e-6}, r"WOBPERIOD = 400 d: change of the rotation by the varying torque .* at most 0.01"),
]


@pytest.mark.parametrize(("changes", "error"), REFUSED)
def test_what_is_refused(changes, error):
    with pytest.raises(InvalidModelParameters, match=error):
        wobbling(**changes)


@pytest.mark.parametrize("name", ["WOBCHI", "WOBPERIOD"])
def test_what_must_be_given(name):
    given = "".join(f"{one} {value}\n" for one, value in WOBBLE.items() if one != name)
    with pytest.raises(MissingParameter, match=f"{name} has no value: must be a number, in (deg|d)"):
        model_of("F0 2.5\n" + given)


def test_an_epoch_must_be_given():
    lines = wobbling(f1=0.0).as_parfile().splitlines()
    with pytest.raises(MissingParameter, match="PEPOCH has no value; WOBPHASE is the phase at this epoch") as error:
        model_of_par("\n".join(line for line in lines if not line.startswith(("PEPOCH", "F1"))))
    assert (error.value.module, error.value.param) == ("Wobble", "PEPOCH")


def test_a_rotation_without_f1_does_not_slow_down():
    model = model_of("F0 2.5\n" + "".join(f"{name} {value}\n" for name, value in WOBBLE.items()))
    assert "F1" not in model.params and model.components["Wobble"]._star().f1 == 0.0


def test_derivatives_by_the_rotation_have_the_part_of_the_torque(spread):
    model = wobbling()
    delay, component, spin = model.delay(spread), model.components["Wobble"], model.components["Spindown"]
    for name in ("F0", "F1"):
        part = component.d_wobble_phase_d_param(spread, name, delay)
        found = model.d_phase_d_param(spread, delay, name) - spin.d_phase_d_F(spread, name, delay)
        largest = np.max(np.abs(part.value))
        assert largest > 0.0 and np.max(np.abs((found - part).to_value(part.unit))) < 1e-5 * largest


def test_a_star_without_a_wobble_is_one(spread):
    model = wobbling(WOBBLE=0.0)
    assert np.all(model.components["Wobble"].wobble_phase(spread, model.delay(spread)) == 0.0)


def test_a_step_of_a_fit_that_leaves_the_model_is_refused(spread):
    model = wobbling()
    model.WOBBLE.value = 71.0
    with pytest.raises(InvalidModelParameters, match="WOBBLE = 71 deg"):
        Residuals(spread, model)
    model = wobbling(f1=-2.5 * 0.2 / 1.5e8, WOBTORQUE=0.0)
    with pytest.raises(InvalidModelParameters, match="F1 t / F0 = .*: must be at most 0.1 in size"):
        Residuals(spread, model)


def test_a_negative_wobble_is_one_of_the_opposite_phase(spread):
    model = wobbling()
    delay = model.delay(spread)
    expected = model.components["Wobble"].wobble_phase(spread, delay)
    model.WOBBLE.value, model.WOBPHASE.value = -2.0, -150.0
    component = model.components["Wobble"]
    assert np.max(np.abs(component.wobble_phase(spread, delay) - expected)) < 1e-13
    component.positive()
    assert (model.WOBBLE.value, model.WOBPHASE.value) == (2.0, 30.0)
    model.validate()


def test_a_wobble_is_added_as_given(spread):
    model = wobbling()
    model.remove_component("Wobble")
    component = add_wobble(
        model, period=1e-3 * u.yr, chi=1 * u.rad, wobble=0.1 * u.rad, phase=1 * u.rad, free=["WOBBLE"]
    )
    assert model.WOBPERIOD.value == pytest.approx(0.36525) and model.WOBCHI.value == pytest.approx(np.degrees(1))
    assert component.free_params_component == ["WOBBLE"]
    assert (model.WOBBLE.quantity.to_value(u.rad), model.WOBPHASE.quantity.to_value(u.rad)) == pytest.approx((0.1, 1.0))
    with pytest.raises(ValueError, match="model: must not have a Wobble component"):
        add_wobble(model, spread, period=1 * u.yr, chi=1 * u.rad)


@pytest.mark.parametrize(
    ("given", "error"),
    [
        ({"wobble": 2 * u.rad}, "WOBBLE = 114.59.* deg: must be below"),
        ({"free": ["WOBBLE", "WAVE"]}, "free = WAVE: must be one of WOBBLE, WOBCHI"),
        ({"wobble": None}, "toas = None: give arrival times, or both"),
        ({"period": -1 * u.day}, "WOBPERIOD = -1.0 d: must be above 0"),
    ],
)
def test_a_wobble_that_cannot_be_is_not_added(given, error):
    model = wobbling()
    model.remove_component("Wobble")
    with pytest.raises(ValueError, match=error):
        add_wobble(model, **{"period": 1 * u.yr, "chi": 1 * u.rad, "wobble": 0.1 * u.rad, "phase": 0 * u.rad, **given})
    assert "Wobble" not in model.components
    model.validate()


def test_limits_with_white_noise_are_those_of_the_library(tmp_path):
    """One data set, two programs: PINT's design matrix and the Rust library."""
    random = np.random.default_rng(8)
    f0, f1, sigma = 186.5, -6.2e-16, 1e-6
    star = twofold.TimingModel(f0, f1=f1)
    t = np.sort(random.uniform(-1500, 1500, 150)) * DAY
    numbers = star.phase(t)[0]
    times, rest = star.arrival(numbers)
    noise = random.normal(0.0, sigma, 150)
    longer = (np.asarray(times, np.longdouble) + rest + noise) / np.longdouble(DAY)
    model = model_of(f"F0 {f0} 1\nF1 {f1} 1\n")
    toas = toas_of(tmp_path, EPOCH + np.floor(longer), longer - np.floor(longer), sigma, model, numbers)
    data = twofold.TimingData(times, np.full(150, sigma), rest=rest + noise, numbers=numbers)
    unknowns = ["phase", "f0", "f1"]
    periods = np.array([40.0, 180.0, 700.0, 3000.0])
    for share, confidence in ((0.0, 0.95), (1.0, 0.5)):
        start = twofold.TimingModel(f0, f1=f1, chi=np.pi / 4, torque_share=share)
        fit = twofold.fit_timing(start, data, unknowns)
        theirs = twofold.wobble_limits(fit.model, data, unknowns, periods * DAY, confidence=confidence)
        ours = wobble_limits(model, toas, periods * u.day, chi=45 * u.deg, torque=share, probability=confidence)
        # Times in PINT are rounded to 1e-9 s, a thousandth of an error.
        assert ours["limit"].to_value(u.rad) == pytest.approx(theirs["limit"], rel=5e-3)
        assert ours["best"].to_value(u.rad) == pytest.approx(theirs["best"], rel=5e-3)
        assert ours["gain"].value == pytest.approx(theirs["gain"], rel=2e-2, abs=1e-2)
    # The errors include the model's noise: if they are doubled, chi^2 and all gains are a quarter.
    noisier = model_of(f"F0 {f0} 1\nF1 {f1} 1\nEFAC MJD 40000 70000 2\n")
    gains = [wobble_limits(of, toas, periods * u.day, chi=45 * u.deg)["gain"].value for of in (model, noisier)]
    assert gains[1] == pytest.approx(gains[0] / 4, rel=1e-6)


def test_limits_find_the_period(b1828):
    model, toas, _ = b1828
    periods = np.linspace(300, 700, 41) * u.day
    found = wobble_limits(model, toas, periods, chi=89 * u.deg, torque=1.0)
    assert found["period"][np.argmax(found["gain"])] == 500 * u.day


def test_the_gain_is_what_a_fit_finds(tmp_path):
    """A small wobble with red noise and epoch noise: the decrease of chi^2 in a fit by PINT."""
    random = np.random.default_rng(11)
    f0, f1, sigma, wobble = 186.5, -6.2e-16, 1e-6, 1e-3
    given = dict(chi=np.pi / 4, precession_rate=2 * np.pi / (400 * DAY), precession_phase=2.0, torque_share=0.5)
    star = twofold.TimingModel(f0, f1=f1, wobble=wobble, **given)
    t = np.repeat(np.sort(random.uniform(-1500, 1500, 80)), 2) * DAY + np.tile([0.0, 0.1], 80)
    times, rest = star.arrival(star.phase(t)[0])
    noise = random.normal(0.0, sigma, 160) + np.repeat(random.normal(0.0, sigma, 80), 2)
    longer = (np.asarray(times, np.longdouble) + rest + noise) / np.longdouble(DAY)
    noises = "ECORR -f a 1.0\nTNREDAMP -13.5\nTNREDGAM 3\nTNREDC 10\n"
    model = model_of(f"F0 {f0} 1\nF1 {f1} 1\n{noises}")
    days = EPOCH + np.floor(longer)
    toas = toas_of(tmp_path, days, longer - np.floor(longer), sigma, model, star.phase(t)[0], " -f a")
    plain = DownhillGLSFitter(toas, model)
    plain.fit_toas()
    found = wobble_limits(plain.model, toas, [400.0] * u.day, torque=0.5)
    assert found["gain"].value[0] > 30
    wobbles = copy.deepcopy(plain.model)
    add_wobble(wobbles, toas, period=400 * u.day, chi=45 * u.deg, torque=0.5, free=["WOBBLE", "WOBPHASE"])
    # The start is the linear estimate itself.
    assert wobbles.WOBBLE.quantity.to_value(u.rad) == pytest.approx(found["best"].value[0], rel=1e-9)
    assert wobbles.WOBPHASE.quantity.to_value(u.rad) == pytest.approx(found["phase"].value[0], rel=1e-9)
    fit = DownhillGLSFitter(toas, wobbles)
    fit.fit_toas()
    # Terms of second order in the wobble are 1e-3 of the gain; PINT's fit ends at 1e-2 of chi^2.
    assert plain.resids.chi2 - fit.resids.chi2 == pytest.approx(found["gain"].value[0], rel=2e-3, abs=2e-2)
    assert abs(fit.model.WOBBLE.quantity.to_value(u.rad) - wobble) < 3 * fit.model.WOBBLE.uncertainty.to_value(u.rad)
    assert wobble < found["limit"].value[0]


@pytest.fixture(scope="module")
def exact(tmp_path_factory):
    """Arrival times without noise of a star with a large wobble, and a model without one."""
    random = np.random.default_rng(9)
    star = twofold.TimingModel(
        2.5, f1=-3.7e-13, wobble=0.2, chi=0.9, precession_rate=2 * np.pi / (400 * DAY), precession_phase=2.5, torque_share=0.3
    )
    times, rest = star.arrival(star.phase(np.sort(random.uniform(-1500, 1500, 120)) * DAY)[0])
    days = (np.asarray(times, np.longdouble) + rest) / np.longdouble(DAY)
    model = model_of("F0 2.5 1\nF1 -3.7e-13 1\n")
    toas = toas_of(tmp_path_factory.mktemp("exact"), EPOCH + np.floor(days), days - np.floor(days), 1e-4, model, star.phase(times, rest)[0])
    return model, toas


GIVEN = {"period": 400 * u.day, "chi": 0.9 * u.rad, "torque": 0.3}


def test_a_start_is_the_nearest_of_its_grid(exact):
    """For a wobble of 0.2 rad with the phase 2.5: phases a sixteenth of pi apart, 14 wobbles in geometric steps over a factor of 90."""
    model, toas = exact
    for given in ({}, {"wobble": 0.2 * u.rad}, {"phase": 2.5 * u.rad}):
        made = copy.deepcopy(model)
        component = add_wobble(made, toas, **GIVEN, **given)
        wobble, phase = component.WOBBLE.quantity.to_value(u.rad), component.WOBPHASE.quantity.to_value(u.rad)
        assert (wobble == pytest.approx(0.2, rel=1e-12)) if "wobble" in given else 0.2 / 1.19 < wobble < 0.2 * 1.19
        assert (phase == pytest.approx(2.5, rel=1e-12)) if "phase" in given else abs(phase - 2.5) < np.pi / 32
        assert component.free_params_component == ["WOBBLE", "WOBPERIOD", "WOBPHASE"]
        assert component.WOBTORQUE.value == 0.3 and component.WOBCHI.quantity == 0.9 * u.rad
        # A multiple of a sixteenth of pi, and a term of the geometric row up to nine tenths of chi.
        if "wobble" in given:
            assert phase / (np.pi / 16) == pytest.approx(round(phase / (np.pi / 16)), abs=1e-9)
        if "phase" in given:
            place = np.log(wobble / (0.01 * 0.9)) / np.log(90.0) * 13
            assert place == pytest.approx(round(place), abs=1e-9)


def test_chi_squared_of_stars_is_that_of_their_residuals(exact):
    model, toas = exact
    data = _Projected(model, toas)
    stars = [data.star(400.0, 0.9, 0.3, wobble, phase) for wobble, phase in ((0.1, 0.0), (0.2, 2.5), (0.01, 4.0))]
    expected = [np.sum((data.residuals + data.project(_Beyond(star, data.t).turns / data.f0)) ** 2) for star in stars]
    assert data.chi_squared(stars) == pytest.approx(expected, rel=1e-9, abs=1e-6)
    # The star itself leaves the change due to its frequency, 2e-5, of residuals of some hundreds.
    assert expected[1] < 0.2 < 1e4 < expected[2]
    # Components that the model can absorb are gone, also for arrivals with different errors.
    toas = copy.deepcopy(toas)
    toas.table["error"][:] = 100.0 * (1.0 + np.arange(len(toas)) % 3)
    data = _Projected(model, toas)
    columns = model.designmatrix(toas)[0]
    for k in range(columns.shape[1]):
        column = np.asarray(columns[:, k], float)
        assert np.linalg.norm(data.project(column)) < 1e-10 * np.linalg.norm(column / data.sigma)


def test_starts_of_any_star(exact):
    model, toas = exact
    data = _Projected(model, toas)
    # Small wobbles of any phase are found by linear least squares.
    for phase in (1.0, 4.0):
        data.residuals = -data.project(_Beyond(data.star(400.0, 0.9, 0.3, 1e-3, phase), data.t).turns / data.f0)
        assert twofold.pint._start(data, 400.0, 0.9, 0.3, None, None) == pytest.approx((1e-3, phase), rel=1e-2)
    # The magnetic axis is beyond the equator of the body.
    assert 0.0 < twofold.pint._start(data, 400.0, 2.2, 0.3, None, 1.0)[0] < np.pi - 2.2
    made = copy.deepcopy(model)
    component = add_wobble(made, toas, period=0.5 / 365.25 * u.yr, chi=0.9 * u.rad, wobble=np.degrees(0.2) * u.deg)
    assert component.WOBPERIOD.value == pytest.approx(0.5) and component.WOBTORQUE.value == 0.0
    assert component.WOBBLE.quantity.to_value(u.rad) == pytest.approx(0.2)
    days, years = (add_wobble(copy.deepcopy(model), toas, period=period, chi=0.9 * u.rad) for period in (400 * u.day, 400 / 365.25 * u.yr))
    assert years.WOBPHASE.value == pytest.approx(days.WOBPHASE.value, rel=1e-6)
    with pytest.raises(InvalidModelParameters, match="WOBPERIOD = 0.0 d: must be above 0"):
        add_wobble(copy.deepcopy(model), toas, period=0 * u.day, chi=0.9 * u.rad)
    falling = model_of(f"F0 2.5 1\nF1 {-2.5 * 0.2 / 1.29e8} 1\n")
    with pytest.raises(InvalidModelParameters, match="F1 t / F0"):
        wobble_limits(falling, toas, 100 * u.day)


def test_derivatives_of_a_small_wobble(exact):
    model, toas = exact
    data = _Projected(model, toas)
    for row, phase in zip(data.small(400.0, 0.9, 0.3), (0.0, np.pi / 2), strict=True):
        turns = _Beyond(data.star(400.0, 0.9, 0.3, 1e-6, phase), data.t).turns
        assert np.max(np.abs(row - data.project(turns / data.f0) / 1e-6)) < 1e-4 * np.max(np.abs(row))


def test_limits_as_they_are_by_default(exact):
    model, toas = exact
    periods = [100.0, 300.0] * u.day
    found, again = wobble_limits(model, toas, periods), wobble_limits(model, toas, periods, chi=np.pi / 4 * u.rad, torque=0.0, probability=0.95)
    assert {name: value.unit for name, value in found.items()} == {"period": u.day, "best": u.rad, "phase": u.rad, "gain": u.one, "limit": u.rad}
    for name, value in found.items():
        assert value.value == pytest.approx(again[name].value, rel=1e-12)
    assert np.array_equal(found["period"].value, periods.value)
    half = wobble_limits(model, toas, [300 / 365.25, 0.5 / 365.25] * u.yr, probability=0.5)
    assert half["best"][0].value == pytest.approx(found["best"][1].value, rel=1e-9)
    phases = wobble_limits(model, toas, [100.0, 150.0, 200.0, 300.0, 500.0, 900.0] * u.day)["phase"].value
    assert (phases >= 0.0).all() and np.pi < phases.max() < 2.0 * np.pi
    # One period as a number.
    assert wobble_limits(model, toas, 100 * u.day)["best"] == found["best"][:1]


def test_limits_without_f1(exact):
    _, toas = exact
    data = _Projected(model_of("F0 2.5 1\n"), toas)
    assert data.f1 == 0.0 and data.f0 == 2.5 and np.isfinite(data.residuals).all()


def test_errors_of_arrivals_must_be_above_zero(exact):
    model, toas = exact
    toas = copy.deepcopy(toas)
    toas.table["error"][3] = 0.0
    with pytest.raises(ValueError, match="toas: must be arrival times with errors above zero"):
        wobble_limits(model, toas, 100 * u.day)


@pytest.mark.parametrize(
    ("given", "expected"),
    [((-2.0, 10.0), (2.0, 190.0)), ((-2.0, 350.0), (2.0, 170.0)), ((2.0, 370.0), (2.0, 10.0)), ((2.0, -30.0), (2.0, 330.0)), ((0.0, 30.0), (0.0, 30.0))],
)
def test_phases_of_a_positive_wobble(given, expected):
    component = wobbling().components["Wobble"]
    component.WOBBLE.value, component.WOBPHASE.value = given
    component.positive()
    assert (component.WOBBLE.value, component.WOBPHASE.value) == expected


def test_stars_that_a_fit_may_try(spread):
    for name, value, words in (
        ("WOBPERIOD", 0.0, "WOBPERIOD = 0 d: must be above 0"),
        ("WOBPERIOD", -3.0, "WOBPERIOD = -3 d: must be above 0"),
        ("WOBTORQUE", -0.1, "WOBTORQUE = -0.1: must be from 0 to 1"),
        ("WOBBLE", -71.0, "WOBBLE = -71 deg: must be below 70 deg"),
    ):
        model = wobbling()
        getattr(model, name).value = value
        with pytest.raises(InvalidModelParameters, match=words):
            Residuals(spread, model)
    # The limit is a tenth of the rotation.
    star = _Star(2.0, -2e-9, 0.01, 1.0, 1e-7, 0.0, 0.0)
    star.check(np.array([1.0, -1e8, 5.0]))
    star.check(np.array([]))
    for times in ([1.0, -1.01e8], [-1.01e8, 1.0]):
        with pytest.raises(InvalidModelParameters, match=r"F1 t / F0 = 0.101 at an arrival time: must be at most 0.1 in size; use a nearer PEPOCH"):
            star.check(np.array(times))
    for torque in (0.0, 0.5):
        assert _Beyond(replace(star, torque=torque), np.array([])).turns.shape == (0,)


def test_parameters_that_are_no_numbers_or_unknown(spread):
    model = wobbling()
    component = model.components["Wobble"]
    with pytest.raises(ValueError, match="DM: must be one of WOBBLE, WOBCHI, WOBPERIOD, WOBPHASE, WOBTORQUE, F0, F1"):
        component.d_wobble_phase_d_param(spread, "DM", model.delay(spread))
    model.WOBTORQUE._quantity = None
    with pytest.raises(MissingParameter, match="WOBTORQUE has no value: must be a number without a unit") as error:
        model.validate()
    assert (error.value.module, error.value.param) == ("Wobble", "WOBTORQUE")
    fresh = twofold.pint.Wobble()
    assert {name: getattr(fresh, name).value for name in fresh.params} == {"WOBBLE": 0.0, "WOBCHI": None, "WOBPERIOD": None, "WOBPHASE": 0.0, "WOBTORQUE": 0.0}
    assert all(getattr(fresh, name).frozen for name in fresh.params) and fresh.category == "wobble"


@pytest.mark.parametrize(
    ("given", "error"),
    [
        ({"probability": 0.0}, "probability = 0.0: must be above 0 and below 1"),
        ({"periods": [1.0, 0.0] * u.day}, "periods: 0.0 d: must be above 0"),
        ({"probability": 1.0}, "probability = 1.0: must be"),
        ({"periods": [-1.0, 2.0] * u.day}, "periods: -1.0 d: must be"),
    ],
)
def test_limits_that_cannot_be(spread, given, error):
    model = wobbling()
    model.remove_component("Wobble")
    with pytest.raises(ValueError, match=error):
        wobble_limits(model, spread, **{"periods": [100.0] * u.day, **given})
    with pytest.raises(ValueError, match="model: must not have a Wobble component"):
        wobble_limits(wobbling(), spread, [100.0] * u.day)


def test_the_example_of_the_page_runs(tmp_path, monkeypatch):
    page = (Path(__file__).parents[2] / "docs" / "pint.md").read_text()
    example = page.split("```python\n")[1].split("```")[0]
    assert len([line for line in example.splitlines() if line.strip()]) <= 20
    monkeypatch.chdir(tmp_path)
    names = {}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        exec(example, names)
    model = names["fitter"].model
    assert model.WOBBLE.value == pytest.approx(3.0, abs=3e-4)
    assert model.WOBPERIOD.value == pytest.approx(500.0118, abs=4e-3)
    assert "WOBPHASE" in (tmp_path / "wobble.par").read_text()


def test_the_table_of_the_page_has_the_parameters():
    page = (Path(__file__).parents[2] / "docs" / "pint.md").read_text()
    component = twofold.pint.Wobble()
    for name in component.params:
        assert f"| `{name}` | {getattr(component, name).units.to_string() or '1'} |" in page
