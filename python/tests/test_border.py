"""Any Python input gives an answer of the right shape or a documented exception. No panic reaches Python, and nothing leaks."""

import pathlib
import pickle
import resource
import threading
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest

import twofold
from twofold import kernels

hypothesis = pytest.importorskip("hypothesis")
from hypothesis import given, settings  # noqa: E402
from hypothesis import strategies as st  # noqa: E402
from hypothesis.extra import numpy as hnp  # noqa: E402

MODEL = twofold.TimingModel(
    300.0, f1=-1e-14, wobble=0.05, chi=1.2, precession_rate=1e-6, torque_share=0.5, inclination=1.0, rho=0.5
)
MOTION = twofold.Scene("tp-2").motion()

numbers = st.one_of(
    st.floats(allow_nan=True, allow_infinity=True),
    st.integers(-(10**30), 10**30),
    st.sampled_from([0.0, -0.0, 5e-324, 1.8e308, 2.0**53, 1e16, -1e300]),
)
types = st.one_of(
    hnp.floating_dtypes(),
    hnp.integer_dtypes(),
    hnp.unsigned_integer_dtypes(),
    hnp.boolean_dtypes(),
    hnp.complex_number_dtypes(),
    hnp.byte_string_dtypes(),
    hnp.unicode_string_dtypes(),
    hnp.datetime64_dtypes(),
)
arrays = types.flatmap(lambda kind: hnp.arrays(kind, hnp.array_shapes(min_dims=0, min_side=0, max_side=4)))
objects = st.one_of(
    numbers,
    arrays,
    st.lists(numbers, max_size=3),
    st.text(max_size=3),
    st.none(),
    st.booleans(),
    st.dictionaries(st.text(max_size=2), numbers, max_size=1),
)

#: Functions of one argument, with the axes that their results have after those of the argument.
FUNCTIONS = [
    (MOTION.axis, (3,)),
    (lambda t: MOTION.state(t)[1], (3,)),
    (MOTION.angles, (3,)),
    (MOTION.error, ()),
    (lambda t: MODEL.phase(t)[1], ()),
    (lambda t: MODEL.phase_and_derivatives(t)[2], (13,)),
    (MODEL.phase_rate, ()),
    (lambda t: MODEL.arrival(t)[0], ()),
    (MODEL.width, ()),
    (kernels.fluid_inertia_over_c, ()),
    (lambda x: kernels.pulse_width(x, 0.5, 0.8), ()),
    (lambda x: kernels.constant_c(1e30, x, 1e-3), ()),
]


@pytest.mark.parametrize("place", range(len(FUNCTIONS)))
@settings(max_examples=150, deadline=None)
@given(argument=objects)
def test_functions_of_arrays(place, argument):
    function, behind = FUNCTIONS[place]
    try:
        found = function(argument)
    except (TypeError, twofold.Error, OverflowError):
        return
    assert np.shape(found) == (*np.shape(argument), *behind)
    assert np.asarray(found).dtype == np.float64


@settings(max_examples=150, deadline=None)
@given(array=hnp.arrays(np.float64, (4, 6), elements=st.floats(0, 400)), steps=st.tuples(st.sampled_from([1, -1, 2, -3]), st.sampled_from([1, -1, 2])))
def test_views_are_read_as_they_look(array, steps):
    for view in (array[:: steps[0], :: steps[1]], array.T, array.T[:: steps[0]], np.broadcast_to(array[0], (3, 6))):
        assert np.array_equal(MOTION.axis(view), MOTION.axis(np.ascontiguousarray(view)))


@settings(max_examples=200, deadline=None)
@given(
    f0=numbers,
    values=st.dictionaries(st.sampled_from([name for name in twofold.TimingModel.names if name != "f0"]), numbers, max_size=4),
)
def test_timing_models(f0, values):
    try:
        model = twofold.TimingModel(f0, **values)
    except (TypeError, twofold.Error, OverflowError):
        return
    assert pickle.loads(pickle.dumps(model)) == model
    assert all(model[name] == float(value) for name, value in values.items())


@settings(max_examples=100, deadline=None)
@given(text=st.text(max_size=40), csv=st.one_of(st.binary(max_size=40), st.text("a [é]\n1,\"", max_size=12).map(str.encode)))
def test_texts(text, csv):
    for make in (lambda: twofold.Scene(toml=text), lambda: twofold.Sweep(toml=text), lambda: twofold.Table(csv)):
        try:
            made = make()
        except (twofold.Error, TypeError):
            continue
        assert isinstance(made, twofold.Table)


class Raises:
    def __array__(self, dtype=None, copy=None):
        raise RuntimeError("an array that raises")

    def __float__(self):
        raise RuntimeError("a float that raises")


def test_objects_that_raise():
    for call in (lambda: MOTION.axis(Raises()), lambda: MODEL.phase(Raises()), lambda: twofold.TimingModel(Raises())):
        with pytest.raises((TypeError, twofold.Error, RuntimeError)):
            call()


def test_pickles_of_what_is_none():
    with pytest.raises(twofold.Error):
        twofold.Scene._of_text("old", "[star]\nmass = 'heavy'")


def test_many_threads_have_one_answer():
    times = np.linspace(0.0, 400.0, 20_000)
    expected = MOTION.axis(times)
    answers = []
    threads = [threading.Thread(target=lambda: answers.append(MOTION.axis(times))) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(answers) == 4 and all(np.array_equal(answer, expected) for answer in answers)


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_processes_have_one_answer(method):
    times = np.linspace(0.0, 400.0, 101)
    with ProcessPoolExecutor(1, mp_context=get_context(method)) as executor:
        assert np.array_equal(executor.submit(MOTION.axis, times).result(), MOTION.axis(times))


@pytest.mark.skipif(not pathlib.Path("/proc/self/statm").exists(), reason="the memory of a process is read from /proc")
def test_nothing_leaks():
    """If a call leaked an object of 64 bytes, this loop would take 19 MB."""
    times = np.linspace(0.0, 10.0, 8)

    def calls(count):
        for _ in range(count):
            MOTION.state(times)
            MODEL.phase_and_derivatives(1e6)
            try:
                MOTION.axis(-1.0)
            except twofold.Error:
                pass

    def kilobytes():
        pages = int(pathlib.Path("/proc/self/statm").read_text().split()[1])
        return pages * resource.getpagesize() // 1024

    calls(2_000)
    before = kilobytes()
    calls(100_000)
    assert kilobytes() - before < 4_000


@pytest.mark.parametrize("flag", [True, False, np.True_, np.array([True])])
def test_a_boolean_is_no_number(flag):
    with pytest.raises((TypeError, twofold.Error)):
        MOTION.axis(flag)
