"""The likelihood of arrival times compared with sums in numpy and with fits."""

import itertools
import pickle

import numpy as np
import pytest
import twofold
from twofold.likelihood import TimingLikelihood

UNKNOWNS = ["phase", "f0", "f1", "wobble", "precession_phase", "precession_rate"]
SIGMA = 1e-4


@pytest.fixture(scope="module")
def model():
    return twofold.TimingModel(
        2.4688717147, f1=-3.6568e-13, wobble=0.0523, chi=1.4, precession_phase=1.0, precession_rate=1.4544410383e-7
    )


@pytest.fixture(scope="module")
def arrivals(model):
    """300 pulses over 10 years and their arrival times, as sums of two doubles."""
    numbers = np.sort(np.random.default_rng(20).integers(0, 777_000_000, 300)).astype(float)
    return numbers, *model.arrival(numbers)


@pytest.fixture(scope="module")
def noise():
    return SIGMA * np.random.default_rng(21).standard_normal(300)


@pytest.fixture(scope="module")
def data(arrivals, noise):
    _, times, rest = arrivals
    return twofold.TimingData(times, np.full(300, SIGMA), rest=rest + noise)


@pytest.fixture(scope="module")
def fit(model, data):
    return twofold.fit_timing(model, data, UNKNOWNS)


def test_names_that_are_offered():
    assert all(hasattr(twofold.likelihood, name) for name in twofold.likelihood.__all__)


def of_fit(fit, model):
    """The parameters of a fit in the form for a sampler."""
    offset = sum(a - b for a, b in zip(fit.model.frequency, model.frequency, strict=True))
    return {"f0_offset": offset} | {name: fit.model[name] for name in UNKNOWNS if name != "f0"}


def test_the_density_of_known_errors(model, data, noise):
    likelihood = TimingLikelihood(model, data)
    # Arrival times are rounded to 1e-16 of a day or less, far below 1e-6 of their errors.
    assert abs(likelihood.residuals({}) - noise / SIGMA).max() < 1e-6
    expected = -np.sum((noise / SIGMA) ** 2) / 2 - 300 * np.log(SIGMA * np.sqrt(2 * np.pi))
    assert likelihood.log_likelihood({}) == pytest.approx(expected, abs=1e-4)
    same = {name: model[name] for name in UNKNOWNS if name != "f0"} | {"f0_offset": 0.0}
    assert likelihood.log_likelihood(same) == likelihood.log_likelihood({})


def test_errors_of_each_arrival(model, arrivals, noise):
    _, times, rest = arrivals
    sigmas = SIGMA * (1 + np.arange(300) % 3)
    likelihood = TimingLikelihood(model, twofold.TimingData(times, sigmas, rest=rest + noise))
    expected = -np.sum((noise / sigmas) ** 2) / 2 - np.log(sigmas * np.sqrt(2 * np.pi)).sum()
    assert likelihood.log_likelihood({}) == pytest.approx(expected, abs=1e-4)


def test_it_is_largest_at_the_fit(model, data, fit):
    likelihood = TimingLikelihood(model, data)
    best = of_fit(fit, model)
    top = likelihood.log_likelihood(best)
    assert abs(np.sum(likelihood.residuals(best) ** 2) / fit.chi_squared - 1) < 1e-8
    for name, sigma in zip(best, [fit.sigmas[UNKNOWNS.index(key.removesuffix("_offset"))] for key in best], strict=True):
        for sign in (-0.1, 0.1):
            assert likelihood.log_likelihood(best | {name: best[name] + sign * sigma}) < top


def test_residuals_change_as_the_fit_says(model, data, fit):
    likelihood = TimingLikelihood(model, data)
    best, step = of_fit(fit, model), 0.1
    keys = ["f0_offset" if name == "f0" else name for name in UNKNOWNS]
    # Along an axis of the covariance, a tenth of a standard deviation changes the squared residuals by 0.01. Nonlinear terms are a thousandth of
    # that: the differences are central.
    axes = np.linalg.cholesky(fit.covariance / np.outer(fit.sigmas, fit.sigmas))
    for axis in axes.T:
        ends = [
            likelihood.residuals({key: best[key] + sign * axis[k] * fit.sigmas[k] for k, key in enumerate(keys)})
            for sign in (-step, step)
        ]
        assert np.sum((ends[1] - ends[0]) ** 2) / 4 == pytest.approx(step**2, rel=1e-3)


def test_marginalised_is_the_integral(model, data, fit):
    # phase and F0 on a grid of 8 standard deviations in each direction, compared with the closed form.
    best = of_fit(fit, model)
    whole = TimingLikelihood(model, data)
    short = TimingLikelihood(model, data, marginalised=["phase", "f0"])
    others = {key: value for key, value in best.items() if key not in ("phase", "f0_offset")}
    grid = twofold.fit_timing(model, data, ["phase", "f0"])
    steps = np.linspace(-8.0, 8.0, 65)
    # The grid is along the axes of the covariance.
    across = np.linalg.cholesky(grid.covariance)
    values = [
        whole.log_likelihood(others | {"phase": best["phase"] + x, "f0_offset": best["f0_offset"] + y})
        for x, y in (across @ np.array(uv) for uv in itertools.product(steps, steps))
    ]
    top = max(values)
    cell = (steps[1] - steps[0]) ** 2 * abs(np.linalg.det(across))
    integral = top + np.log(np.sum(np.exp(np.array(values) - top)) * cell)
    assert short.log_likelihood(others) == pytest.approx(integral, abs=1e-3)
    with pytest.raises(twofold.Error, match="f0_offset = .*marginalised"):
        short.log_likelihood(best)


def test_f0_by_small_offsets(model, data):
    # 1e-16 Hz is below the resolution of a double F0. Over 10 years it is 3e-8 of a turn, 1e-4 standard deviations.
    likelihood = TimingLikelihood(model, data)
    base, moved = likelihood.residuals({}), likelihood.residuals({"f0_offset": 1e-16})
    t = data.times[:, 0]
    assert model.frequency[0] + 1e-16 == model.frequency[0]
    assert abs((moved - base) - 1e-16 * t / model.frequency[0] / SIGMA).max() < 1e-8


def test_numbers_of_pulses(model, arrivals, noise):
    numbers, times, rest = arrivals
    data = twofold.TimingData(times, np.full(300, SIGMA), rest=rest + noise)
    free, counted = TimingLikelihood(model, data), TimingLikelihood(model, data, numbers=numbers + 1000)
    assert np.array_equal(free.numbers, numbers) and np.array_equal(counted.numbers, numbers)
    # With a start that is wrong by more than half a turn at the end, the numbers must be given.
    wrong = model.moved(f0=5e-9)
    assert not np.array_equal(TimingLikelihood(wrong, data).numbers, numbers)
    assert TimingLikelihood(wrong, data, numbers=numbers).log_likelihood({"f0_offset": -5e-9}) == pytest.approx(
        free.log_likelihood({}), abs=1e-3
    )
    with pytest.raises(twofold.Error, match="numbers .* must be 300 whole numbers"):
        TimingLikelihood(model, data, numbers=[1, 2])
    with pytest.raises(twofold.Error, match="numbers"):
        TimingLikelihood(model, data, numbers=numbers + 0.5)


def test_numbers_that_are_known_in_part(model, arrivals, noise):
    """Known numbers may start anywhere; unknown ones are the nearest turns."""
    numbers, times, rest = arrivals
    data = twofold.TimingData(times, np.full(300, SIGMA), rest=rest + noise)
    given = np.where(np.arange(300) % 3 == 1, numbers - 777, np.nan)
    likelihood = TimingLikelihood(model, data, numbers=given)
    assert np.array_equal(likelihood.numbers, numbers)
    # The model is wrong by 1.6 turns at the end, but right to half a turn at the first pulse with a number.
    off = model.moved(f0=1.6 / times[-1])
    found = TimingLikelihood(off, data, numbers=given).numbers
    assert np.array_equal(found[1::3], numbers[1::3]) and found[-1] == numbers[-1] + 2
    with pytest.raises(twofold.Error, match=r"numbers has the shape \(300, 1\): must be 300 whole numbers, NaN"):
        TimingLikelihood(model, data, numbers=numbers[:, None])


def test_times_in_two_parts_of_any_size(model, arrivals, noise):
    """Only the sum matters: a third of a second, most of a turn, is moved from one part to the other."""
    _, times, rest = arrivals
    whole = TimingLikelihood(model, twofold.TimingData(times, SIGMA, rest=rest + noise))
    cut = np.floor(times * 8.0) / 8.0 - 0.375
    split = TimingLikelihood(model, twofold.TimingData(cut, SIGMA, rest=(times - cut) + (rest + noise)))
    assert np.array_equal(split.numbers, whole.numbers)
    assert split.log_likelihood({}) == pytest.approx(whole.log_likelihood({}), abs=1e-4)


def test_residuals_that_are_no_numbers_are_not_probable(model, data, monkeypatch):
    likelihood = TimingLikelihood(model, data)
    monkeypatch.setattr(likelihood, "residuals", lambda parameters: np.array([1.0, np.nan]))
    assert likelihood.log_likelihood({}) == -np.inf


def test_parameters_of_a_sampler(model, data):
    likelihood = TimingLikelihood(model, data)
    assert likelihood.log_likelihood() == likelihood.log_likelihood({}) == likelihood.log_likelihood_ratio({})
    assert likelihood.log_likelihood_ratio({"wobble": 0.0525}) == likelihood.log_likelihood({"wobble": 0.0525})
    likelihood.parameters = {"wobble": 0.0524}
    assert likelihood.log_likelihood() == likelihood.log_likelihood_ratio() == likelihood.log_likelihood({"wobble": 0.0524}) != likelihood.log_likelihood({})
    assert repr(likelihood) == f"<TimingLikelihood: 300 arrivals, {model!r}>"


def test_all_that_can_be_marginalised_is_a_normal_integral(model, data, fit):
    """Compared with the covariance of a fit of the four, with the other parameters fixed."""
    names = ["phase", "f0", "f1", "f2"]
    others = {name: fit.model[name] for name in UNKNOWNS if name not in names}
    held = model.moved(**{name: value - model[name] for name, value in others.items()})
    four = twofold.fit_timing(held, data, names)
    best = {"f0_offset": sum(a - b for a, b in zip(four.model.frequency, model.frequency, strict=True))} | {name: four.model[name] for name in ("phase", "f1", "f2")}
    top = TimingLikelihood(model, data).log_likelihood(others | best)
    scales = np.outer(four.sigmas, four.sigmas)
    integral = top + 2 * np.log(2 * np.pi) + np.log(np.linalg.det(four.covariance / scales)) / 2 + np.log(four.sigmas).sum()
    # Turns and times of pulses differ by a relative 5e-5.
    assert TimingLikelihood(model, data, marginalised=names).log_likelihood(others) == pytest.approx(integral, abs=2e-3)


@pytest.mark.parametrize("times", [[1e6], [1e6, 1e6]])
def test_too_few_times_to_marginalise(model, times):
    """The integral over phase and F0 is infinite with one time, or with two times a picosecond apart."""
    data = twofold.TimingData(times, 1e-4, rest=1e-12 * np.arange(len(times)))
    with pytest.raises(twofold.Error, match="marginalised: phase, f0: must be parameters that the arrival times determine"):
        TimingLikelihood(model, data, marginalised=["phase", "f0"])
    assert np.isfinite(TimingLikelihood(model, data, marginalised=["phase"]).log_likelihood({}))


def test_what_is_marginalised_is_no_parameter(model, data):
    likelihood = TimingLikelihood(model, data, marginalised=("phase", "f1"))
    assert likelihood.marginalised == ("phase", "f1") and likelihood.model == model
    for name in ("phase", "f1"):
        with pytest.raises(twofold.Error, match=f"^{name} = 0.0: it is marginalised; give only other parameters"):
            likelihood.log_likelihood({name: 0.0})
    allowed = [name for name in twofold.TimingModel.names if name not in ("phase", "f1", "inclination", "inclination_rate", "rho")]
    allowed[allowed.index("f0")] = "f0_offset"
    for name, reason in (("nothing", "the name must be one of "), ("rho", "arrival times do not depend on it; expected one of ")):
        with pytest.raises(twofold.Error) as error:
            likelihood.log_likelihood({name: 1.0})
        assert str(error.value) == f"{name} = 1.0: {reason}{', '.join(allowed)}"


def test_it_goes_to_other_processes(model, data):
    likelihood = TimingLikelihood(model, data, marginalised=["phase"])
    again = pickle.loads(pickle.dumps(likelihood))
    assert again.log_likelihood({"wobble": 0.05}) == likelihood.log_likelihood({"wobble": 0.05})


def test_what_is_refused(model, data):
    likelihood = TimingLikelihood(model, data)
    for name, reason in {
        "f0": "use f0_offset",
        "rho": "arrival times do not depend on it",
        "wobbel": "the name must be one of phase, f0_offset",
    }.items():
        with pytest.raises(twofold.Error, match=f"^{name} = 1.0: {reason}"):
            likelihood.log_likelihood({name: 1.0})
    # A value outside the range has zero probability. chi is farther from 0 than the wobble.
    assert likelihood.log_likelihood({"wobble": 2.0}) == -np.inf
    assert likelihood.log_likelihood({"chi": 0.01}) == -np.inf
    assert np.isnan(likelihood.noise_log_likelihood())
    with pytest.raises(twofold.Error, match="marginalised: 'wobble'"):
        TimingLikelihood(model, data, marginalised=["wobble"])
    with pytest.raises(twofold.Error, match="data: must have at least one arrival time"):
        TimingLikelihood(model, twofold.TimingData(width_times=[0.0], widths=[1e-3], width_sigmas=[1e-6]))


def test_numbers_of_the_data_are_kept():
    """A model whose F0 is wrong by five turns over the data; a fit by the pulse numbers corrects it."""
    truth = twofold.TimingModel(2.5, f1=-3.7e-13)
    numbers = np.arange(300) * 2e6
    times, rest = truth.arrival(numbers)
    data = twofold.TimingData(times, 1e-4, rest=rest, numbers=numbers)
    off = truth.moved(f0=5 / times[-1])
    assert TimingLikelihood(off, data).log_likelihood({"f0_offset": -5 / times[-1]}) == pytest.approx(300 * (-np.log(1e-4) - np.log(2 * np.pi) / 2), rel=1e-6)
