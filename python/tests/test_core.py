"""The package's arrays compared with each other and with formulas in numpy, and its interface to Python."""

import functools
import pickle
import signal
import subprocess
import sys
import threading
import time
import types

import numpy as np
import pytest

import twofold
from twofold import kernels


def test_names_that_are_offered():
    offered = {name: getattr(twofold, name) for name in twofold.__all__}
    assert offered["Scene"] is twofold.Scene and offered["Sweep"] is twofold.Sweep
    # A module of the package, such as sweep.py, is a public name, too.
    assert [name for name, value in offered.items() if isinstance(value, types.ModuleType)] == ["kernels"]


@pytest.fixture(scope="module")
def scene():
    return twofold.Scene("tp-2")


@pytest.fixture(scope="module")
def motion(scene):
    return scene.motion()


def columns(table, *names):
    return np.stack([table[name] for name in names], axis=-1)


class TestScene:
    def test_every_built_in_scene_is_read(self):
        for name in twofold.Scene.names():
            assert twofold.Scene(name).name == name
        assert len(twofold.Scene.names()) == 17

    def test_sections_change_numbers_and_go_away(self):
        changed = twofold.Scene("tp-1", star={"inertia_ratio": np.float64(1.3)}, pulsar=None)
        assert "inertia_ratio = 1.3" in changed.toml and "[pulsar]" not in changed.toml
        again = twofold.Scene(toml=changed.toml)
        assert again == changed and hash(again) == hash(changed)
        assert changed != twofold.Scene("tp-1")

    @pytest.mark.parametrize("spin", [1.0, 20.0])
    def test_a_scene_of_sections_alone(self, spin):
        free = twofold.Scene(
            star={"inertia_ratio": 1.1, "spin": spin},
            lorentz_violation={"eigenvalues": [0.0, 0.0, 0.0]},
            initial={"alpha": 0.0, "beta": 0.4, "alpha_rate": 1.1 * spin / np.cos(0.4), "beta_rate": 0.0},
            time={"span": 10.0, "samples": 11},
        )
        # Free precession about Z, Eq. (48).
        angles = free.motion().angles(np.arange(11.0))
        assert np.allclose(angles[:, 0], 1.1 * spin / np.cos(0.4) * np.arange(11.0), atol=1e-12 * spin)
        assert np.allclose(angles[:, 1], 0.4, atol=1e-13)

    def test_a_span_that_only_arrival_times_are_of(self):
        """A motion of 1e11 turns has no table of angles that count them, but it has a pulsar."""
        years = {"epoch": "55000.0", "years": 10.0, "samples": 10}
        scene = twofold.Scene("b1828-11", star={"bulge": None}, lorentz_violation={"alpha_2": None, "w": None, "eigenvalues": [0.0, 0.0, 0.0]}, time=years)
        assert len(scene.pulsar().arrivals().table) == 10
        with pytest.raises(twofold.Error, match="rotation"):
            scene.table(["angles"])

    def test_what_a_scene_has(self, scene):
        assert scene.epoch is None and scene.beam is not None and scene.beam[2] == 0.6
        assert twofold.Scene("wave-source").beam is None and twofold.Scene("b1828-11").epoch == "49621.0"

    def test_what_it_says_of_itself(self, scene):
        written = twofold.Scene("tp-2", about="A star")
        assert written.about == "A star" and repr(written) == "<Scene tp-2: A star>" and written.cautions == []
        (caution,) = twofold.Scene("b1828-11", time={"epoch": "2449621.0"}).cautions
        assert "2449621" in caution and "Julian date" in caution
        assert (scene.time_unit, scene.span) == ("t_c", (0.0, 400.0))
        assert twofold.Scene("b1828-11").span == (0.0, 10 * 365.25 * 86400.0)

    def test_sections_that_are_there_are_taken_away(self):
        assert "[pulsar]" in twofold.Scene("tp-1").toml
        assert twofold.Scene("tp-1", nothing=None, star={"nothing": None}).toml == twofold.Scene("tp-1", star={}).toml
        lists = twofold.Scene("tp-1", lorentz_violation={"eigenvalues": [np.float64(0.02), np.float64(0.01), -0.03]})
        assert "eigenvalues = [\n    0.02,\n    0.01,\n    -0.03,\n]" in lists.toml
        assert twofold.Scene("tp-1", lorentz_violation={"eigenvalues": np.array([0.02, 0.01, -0.03])}) == lists

    def test_a_plan_names_the_method_and_the_stretch(self, scene):
        assert "method       torus" in scene.plan(method="torus", tolerance=1e-9)
        text = scene.plan(["angles"])
        assert "state        n, L, e_x" in text and "0.0 to 400.0 t_c" in text and "predicted error is at most 1e-13" in text
        assert "predicted error is at most 1e-10" in scene.plan(tolerance=1e-10)

    @pytest.mark.parametrize("allowed", [1e-14, 1e-2])
    def test_ends_of_what_is_allowed(self, scene, allowed):
        assert len(scene.table(["e_z"], tolerance=allowed)) == 4001

    def test_lines_are_the_strongest(self):
        """Eq. (48) of free precession: m.n has the rotation, the precession, and their sums."""
        scene = twofold.Scene("free")
        table = scene.lines("m.n", least=1e-3)
        assert np.all(np.diff(table["amplitude"]) <= 0) and table["amplitude"].min() >= 1e-3 * table["amplitude"][0]
        assert len(scene.lines("m.n", least=1e-12, most=2)) == 2
        series = scene.table(["m.n"])
        total = sum(a * np.cos(f * series["t"] + phase) for f, a, phase in zip(table["frequency"], table["amplitude"], table["phase"], strict=True))
        # The remainder is constant.
        assert np.ptp(series["m.n"] - total) < 10 * 1e-3 * table["amplitude"][0]
        with pytest.raises(twofold.Error, match="least = 1.1"):
            scene.lines("m.n", least=1.1)
        assert len(scene.lines("m.n", least=1.0)) == len(scene.lines("m.n", most=1)) == 1
        assert len(twofold.Scene("tp-2").lines("m.n")) == 50
        assert twofold.Scene("tp-2").lines("m.n", most=200)["amplitude"][-1] >= 1e-6 * twofold.Scene("tp-2").lines("m.n")["amplitude"][0]

    def test_a_file(self, tmp_path, scene):
        path = tmp_path / "star.toml"
        path.write_text(scene.toml)
        assert twofold.Scene(path) == scene

    @pytest.mark.parametrize(
        ("make", "words"),
        [
            (lambda: twofold.Scene("nope"), ["nope", "tp-1"]),
            (lambda: twofold.Scene("tp-1", star={"inertia_ratio": -1.0}), ["inertia_ratio", "-1", "must be"]),
            (lambda: twofold.Scene("tp-1", star={"spn": 1.0}), ["star.spn", "Did you mean `spin`"]),
            (lambda: twofold.Scene(), ["no scene"]),
            (lambda: twofold.Scene("tp-1", toml="x = 1"), ["one source"]),
            (lambda: twofold.Scene("tp-1").table(["foo"]), ["foo", "angles"]),
            (lambda: twofold.Scene("tp-1").table(tolerance=1.0), ["tolerance", "1", "1e-14"]),
            (lambda: twofold.Scene("tp-1").lines("alpha"), ["alpha", "without bound"]),
            (lambda: twofold.Scene("tp-1").pulsar(), ["physical"]),
            (lambda: twofold.Scene("tp-1").motion(method="euler"), ["euler", "taylor"]),
            (lambda: twofold.Scene("tp-1").fisher({"arrival": 1.0}), ["observe: `arrival`", "arrivals"]),
            (lambda: twofold.Scene("tp-1").fisher({"arrivals:1e-4,widths": 1e-3}, ["eps"]), ["observe: `arrivals:1e-4,widths`", "single name"]),
            (lambda: twofold.Scene("tp-1").fisher({}), ["observe: must be a list of at least one name"]),
            (lambda: twofold.Scene("tp-1").fisher({"arrivals": 1e-4}, ["eps,spin"]), ["parameters: `eps,spin`", "single name"]),
            (lambda: twofold.Scene("tp-1").fisher({"arrivals": 1e-4}, ["epss"]), ["parameters: `epss`", "`eps`"]),
            (lambda: twofold.Scene("free", observer=None).fisher({"h_plus": 1e-4}), ["observe h_plus: the scene lacks"]),
            (lambda: twofold.Scene("tp-2").lines("m.n", most=0), ["most = 0", "at least 1"]),
            (lambda: twofold.Table(b"a [s],b,a [d]\n1,2,3\n"), ["two columns", "`a`"]),
        ],
    )
    def test_bad_input_is_named(self, make, words):
        with pytest.raises(twofold.Error) as caught:
            make()
        for word in words:
            assert word in str(caught.value)
        assert isinstance(caught.value, ValueError) and "--" not in str(caught.value)

    @pytest.mark.parametrize("bare", [{}, {"method": "averaged"}])
    def test_a_scene_whose_columns_cannot_be_written(self, bare):
        """As with the command, only a table with the columns of the file needs what these columns need."""
        scene = twofold.Scene("b1828-11", observer={"distance": None}, output=bare)
        assert "\"h\"" in scene.toml and pickle.loads(pickle.dumps(scene)) == scene
        whole = twofold.Scene("b1828-11")
        assert scene.pulsar().arrivals([49621.0, 50000.0], derivatives=0).table["pulse"][0] == 0.0
        assert np.allclose(scene.motion(end=1.0).axis(1.0), whole.motion(end=1.0).axis(1.0), atol=1e-12)
        assert "method" in scene.plan(["e_z"]) and scene.epoch == whole.epoch and scene.pulsar().period == whole.pulsar().period
        for refused in (scene.table, scene.plan):
            with pytest.raises(twofold.Error, match=r'"h": the scene lacks `observer.distance` \[kpc\]'):
                refused()
        # Other errors are still refused at once.
        with pytest.raises(twofold.Error, match="star.spn"):
            twofold.Scene("b1828-11", observer={"distance": None}, star={"spn": 1.0})

    @pytest.mark.parametrize(
        ("call", "words"),
        [
            (lambda: twofold.TimingModel(True), "real number"),
            (lambda: twofold.TimingModel("3"), "real number"),
            (lambda: twofold.TimingModel(2.0, np.True_), "real number"),
            (lambda: twofold.TimingModel(2.0, f1="3"), "f1: must be a real number"),
            (lambda: twofold.TimingModel(2.0, chi=True), "chi: must be a real number"),
            (lambda: twofold.TimingModel([2.0]), "real number"),
            (lambda: twofold.TimingModel(2.0).moved(f1=None), "f1: must be a real number"),
            (lambda: twofold.TimingData.read([], None), "epoch: must be a modified Julian date"),
            (lambda: twofold.TimingData.read([], True), "epoch: must be a modified Julian date"),
            (lambda: twofold.Scene("tp-2").motion(True), "real number"),
            (lambda: twofold.Scene("tp-2").table(["e_z"], tolerance="1"), "real number"),
            (lambda: twofold.Scene("tp-2").lines("m.n", least=True), "real number"),
            (lambda: twofold.Scene("tp-2").fisher({"arrivals": True}), "real number"),
            (lambda: twofold.Scene("tp-2").table("h"), "must be a list of names, not the text 'h'"),
            (lambda: twofold.Scene("tp-2").fisher({"arrivals": 1.0}, "eps"), "the text 'eps'"),
            (lambda: twofold.fit_timing(twofold.TimingModel(1.0), twofold.TimingData([1.0], 1.0), "phase"), "the text 'phase'"),
        ],
    )
    def test_an_argument_of_another_type(self, call, words):
        with pytest.raises(TypeError) as caught:
            call()
        assert words in str(caught.value)

    def test_numbers_of_all_types(self):
        models = [twofold.TimingModel(number, f1=number) for number in (2, 2.0, np.float64(2), np.float32(2), np.int8(2), np.array(2))]
        assert all(model == models[0] for model in models)

    def test_a_name_in_bytes(self, tmp_path):
        assert twofold.Scene(b"tp-2") == twofold.Scene("tp-2")


class TestMotion:
    def test_arrays_are_the_columns_of_the_table(self, scene):
        table = scene.table(["angles", "e_x", "e_z", "L"], method="taylor")
        motion = scene.motion(method="taylor")
        n, momentum, e_x = motion.state(table["t"])
        assert np.array_equal(n, columns(table, "e_z_X", "e_z_Y", "e_z_Z"))
        assert np.array_equal(momentum, columns(table, "L_X", "L_Y", "L_Z"))
        assert np.array_equal(e_x, columns(table, "e_x_X", "e_x_Y", "e_x_Z"))
        assert np.array_equal(motion.angles(table["t"]), columns(table, "alpha", "beta", "gamma"))
        assert np.array_equal(motion.axis(table["t"]), n)

    def test_two_methods_agree_within_their_errors(self, scene, motion):
        torus = scene.motion(method="torus", tolerance=1e-12)
        times = np.linspace(0.0, 400.0, 57)
        off = np.abs(torus.axis(times) - motion.axis(times)).max()
        assert 0 < off < (torus.error(times) + motion.error(times)).max()
        assert (torus.method, motion.method) == ("torus", "taylor")

    def test_the_error_is_that_of_its_time(self, scene):
        """Compared with a motion a million times as accurate. Errors of steps add up or grow: after a hundredth of the span they are at most a
        tenth."""
        coarse, fine = (scene.motion(method="taylor", tolerance=tolerance) for tolerance in (1e-7, 1e-13))
        times = np.array([4.0, 40.0, 400.0])
        off = np.max(np.abs(np.array(coarse.state(times)) - fine.state(times)), axis=(0, 2))
        error = coarse.error(times)
        assert (0.0 < off).all() and (off < error).all() and error[0] < 0.1 * error[2]

    def test_shapes(self, motion):
        for shape in [(), (0,), (1,), (5,), (2, 3)]:
            times = np.full(shape, 7.0)
            assert motion.axis(times).shape == (*shape, 3)
            assert all(part.shape == (*shape, 3) for part in motion.state(times))
            assert np.shape(motion.error(times)) == shape
        assert isinstance(motion.error(7.0), float)

    @pytest.mark.parametrize("given", [7, 7.0, np.float32(7), np.int8(7), np.array(7)])
    def test_any_real_number(self, motion, given):
        assert np.array_equal(motion.axis(given), motion.axis(7.0))

    def test_masks_are_refused(self, motion):
        with pytest.raises(TypeError, match="mask"):
            motion.axis(np.ma.array([1.0, 2.0], mask=[False, True]))

    @pytest.mark.parametrize("given", [np.nan, -1.0, 401.0])
    def test_errors_outside_the_span_are_refused(self, motion, given):
        with pytest.raises(twofold.Error, match="span"):
            motion.error(given)

    def test_strides_and_types(self, motion):
        times = np.arange(40.0)
        assert np.array_equal(motion.axis(times[::-3]), motion.axis(times[::-3].copy()))
        assert np.array_equal(motion.axis(np.asfortranarray(times.reshape(4, 10))), motion.axis(times.reshape(4, 10)))
        assert np.array_equal(motion.axis(list(range(5))), motion.axis(times[:5]))
        assert np.array_equal(motion.axis(times.astype(">f8")), motion.axis(times))

    @pytest.mark.parametrize("given", ["7", 1j, None, [True], np.array(["7"]), object(), {"t": 1.0}, [[1.0], [1.0, 2.0]]])
    def test_what_is_no_number_is_refused(self, motion, given):
        with pytest.raises(TypeError, match="real number"):
            motion.axis(given)

    @pytest.mark.parametrize("given", [np.nan, np.inf, -1.0, 401.0, [0.0, 1e300]])
    def test_times_outside_the_span_are_refused(self, motion, given):
        with pytest.raises(twofold.Error, match="span"):
            motion.state(given)

    def test_until_a_time(self, scene):
        short = scene.motion(end=50.0, method="torus", tolerance=1e-9)
        assert short.span == (0.0, 50.0) and short.scene == scene and short.method == "torus"
        assert repr(short) == f"<Motion of {scene!r} from 0.0 to 50.0 by torus>"
        again = pickle.loads(pickle.dumps(short))
        assert (again.span, again.method, again.error(40.0)) == (short.span, short.method, short.error(40.0))
        with pytest.raises(twofold.Error, match="span"):
            short.axis(50.1)

    def test_angles_on_a_pole_are_no_numbers(self):
        upright = twofold.Scene(
            star={"inertia_ratio": 1.1, "spin": 1.0},
            lorentz_violation={"eigenvalues": [0.0, 0.0, 0.0]},
            initial={"alpha": 0.0, "beta": 0.0, "alpha_rate": 0.0, "beta_rate": 0.0},
            time={"span": 10.0, "samples": 11},
        ).motion()
        assert np.isnan(upright.angles([0.0, 5.0])).all() and np.array_equal(upright.axis(5.0), [0.0, 0.0, 1.0])

    def test_times_are_counted_from_the_start(self):
        """The same motion, started at another time of the clock."""
        later = twofold.Scene("tp-2", time={"start": 100.0}).motion()
        times = np.array([0.0, 7.5, 300.0])
        motion = twofold.Scene("tp-2").motion()
        assert later.span == (100.0, 500.0)
        for name in ("axis", "angles", "error"):
            assert np.allclose(getattr(later, name)(100.0 + times), getattr(motion, name)(times), rtol=1e-9, atol=1e-12)
        assert np.allclose(later.state(100.0 + times), motion.state(times), rtol=1e-9, atol=1e-12)

    @pytest.mark.parametrize("call", ["axis", "state", "angles", "error"])
    @pytest.mark.parametrize(("given", "first", "last"), [(50.0, 100.0, 150.0), (-50.0, 50.0, 100.0)])
    def test_the_time_that_is_refused_is_the_one_given(self, call, given, first, last):
        motion = twofold.Scene("tp-2", time={"start": 100.0, "span": given}).motion()
        for t in (first - 40.0, last + 1.0):
            with pytest.raises(twofold.Error) as caught:
                getattr(motion, call)([first, t])
            assert str(caught.value) == f"t = {t} t_c: must be within the span of the motion, from {first} to {last} t_c"
        getattr(motion, call)([first, last])

    def test_pickled(self, motion):
        again = pickle.loads(pickle.dumps(motion))
        assert np.array_equal(again.axis([1.0, 399.0]), motion.axis([1.0, 399.0]))


@pytest.fixture(scope="module")
def pulsar():
    return twofold.Scene("b1828-11").pulsar()


class TestTable:
    def test_bytes_and_columns(self, scene):
        table = scene.pulses()
        assert table == twofold.Table(table.csv) == pickle.loads(pickle.dumps(table))
        assert table.csv.startswith(b"beam,pulse,start [t_c]")
        assert table.units["start"] == "t_c" and len(table) == len(table["start"])
        assert set(table["cut"]) == {"start", ""} and np.isnan(table["period"][0])
        assert np.all(table["end"] > table["start"])
        assert "start" in table and "stop" not in table and "star" not in table
        assert list(dict(table)) == list(table) == table.keys()
        with pytest.raises(KeyError, match="stop.*closest_approach"):
            table["stop"]

    @pytest.mark.parametrize(("header", "name", "unit"), [("a [", "a [", ""), ("a [é", "a [é", ""), ("a [rad", "a [rad", ""), ("a []", "a", "")])
    def test_odd_headers(self, header, name, unit):
        assert twofold.Table(f"{header}\n1\n".encode()).units == {name: unit}

    def test_tables_that_differ_in_one_number(self):
        assert twofold.Table(b"a [s]\n1\n2\n") == twofold.Table(b"a [s]\n1\n2\n") != twofold.Table(b"a [s]\n1\n3\n")

    def test_words_are_words_in_every_table(self):
        assert twofold.Scene("retrograde").pulses()["cut"].count("") > 0
        assert list(twofold.Table(b"status,x\n")["status"]) == [] and isinstance(twofold.Table(b"status,x\n")["status"], list)

    def test_arrow(self, scene):
        pyarrow = pytest.importorskip("pyarrow")
        table = scene.table(["h"])
        arrow = pyarrow.table(table)
        assert arrow.column_names == table.keys()
        assert np.array_equal(arrow["h_plus"].to_numpy(), table["h_plus"])
        assert arrow.schema.field("t").metadata == {b"unit": b"t_c"} and not arrow.schema.field("t").nullable
        assert pyarrow.table(scene.pulses())["cut"].to_pylist() == scene.pulses()["cut"]

    def test_progress(self, scene):
        parts = []
        scene.table(progress=parts.append)
        assert parts == sorted(parts) and parts[-1] == 1.0
        # At most one call per hundredth, and one at the end.
        assert parts[0] == 0.0 and 50 < len(parts) <= 102 and np.diff(parts[:-1]).min() > 0.0099

    def test_the_whole_is_told_once(self):
        parts = []
        twofold.Scene("tp-2", time={"samples": 2}).table(["e_z"], progress=parts.append)
        assert parts.count(1.0) == 1 and parts[-1] == 1.0

    def test_an_error_of_progress_comes_out(self, scene):
        calls = []

        def fail(part):
            calls.append(part)
            raise RuntimeError("no more")

        with pytest.raises(RuntimeError, match="no more"):
            scene.table(progress=fail)
        assert len(calls) == 1

    def test_interrupt(self):
        program = (
            "import signal, twofold\n"
            # Python keeps the signal ignored if it was: in the background of a script.
            "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
            "scene = twofold.Scene('tp-2', time={'span': 4e6, 'samples': 4000001}, output={'tolerance': 1e-6})\n"
            "scene.table(['angles'], progress=lambda part: print(part, flush=True))"
        )
        with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as run:
            assert run.stdout is not None and run.stdout.readline()
            run.send_signal(signal.SIGINT)
            _, errors = run.communicate()
        assert run.returncode != 0 and b"KeyboardInterrupt" in errors


class TestInterrupts:
    def test_arrays_of_numpy_are_known_from_the_import_on(self):
        """A pending Ctrl-C must not interrupt the import of numpy's functions in the first result."""
        program = (
            "import sys, numpy, twofold\n"
            "motion = twofold.Scene('tp-2').motion()\n"
            "for name in ('numpy.core.multiarray', 'numpy._core.multiarray'):\n"
            "    sys.modules[name] = None\n"
            "print(motion.axis(1.0).shape)"
        )
        assert subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False).stdout == "(3,)\n"

    def test_signals_are_handled_between_costly_values(self, scene, interrupted):
        # Turns are followed from the start: about a second.
        motion = scene.motion(end=2e5)
        interrupted(lambda: motion.angles(np.linspace(0.0, 2e5, 8000)))

    def test_costly_values_are_computed_one_by_one(self, scene):
        """Turns are followed for longer from one to the next than what is computed between two looks at the clock."""
        motion = scene.motion(end=9e4)
        times = [3e4, 6e4, 9e4]
        assert np.allclose(np.cos(motion.angles(times)[:, 1]), motion.axis(times)[:, 2], atol=1e-9)

    def test_signals_are_handled_in_tables_of_few_rows(self, interrupted):
        """Pulses of a beam that never meets the line of sight."""
        dark = twofold.Scene("tp-2", time={"span": 2e5}, pulsar={"rho": 1e-3}, output={"method": "taylor"})
        interrupted(dark.pulses)

    @pytest.mark.parametrize(
        "call",
        [
            lambda scene: lambda: scene.motion(end=3e4, method="taylor"),
            lambda scene: functools.partial(scene.motion(end=1e5).angles, 1e5),
            lambda scene: functools.partial(scene.motion(end=3e4, method="taylor").error, 3e4),
        ],
    )
    def test_other_threads_go_on_while_a_value_is_computed(self, scene, call):
        call = call(scene)
        begun, over, times = threading.Event(), threading.Event(), []

        def go_on():
            begun.set()
            while not over.is_set():
                times.append(time.perf_counter())

        thread = threading.Thread(target=go_on)
        thread.start()
        begun.wait()
        first = time.perf_counter()
        call()
        last = time.perf_counter()
        over.set()
        thread.join()
        assert any(0.25 < (t - first) / (last - first) < 0.75 for t in times)


class TestPulsar:
    def test_arrivals_have_whole_phases(self, pulsar):
        timing = pulsar.arrivals()
        table, model = timing.table, pulsar.timing_model()
        since = (table["arrival_day"] - 49621) * 86400.0
        whole, rest = model.phase(since, table["arrival_fraction"] * 86400.0)
        # The model includes the geometry and the torque, not the motion of L due to Lorentz violation.
        off = whole - table["pulse"]
        assert np.ptp(off) == 0 and np.ptp(rest) < 1e-6
        assert len(timing.derivatives) == 2 and timing.tim(2e-6).count("\n") == len(table) + 1

    def test_a_position_without_a_name(self):
        par = twofold.Scene("b1828-11", pulsar={"name": None}).pulsar().arrivals().par
        assert "PSR       PULSAR\n" in par and "RAJ       18:30" in par

    def test_epochs(self, pulsar):
        timing = pulsar.arrivals([49621.0, 50000.0, 50001.5], derivatives=0)
        assert list(timing.table["arrival_day"]) == [49621.0, 50000.0, 50001.0]
        with pytest.raises(twofold.Error, match="epoch"):
            pulsar.arrivals([-1.0])

    def test_harmonics_sum_to_the_wave(self):
        source = twofold.Scene("b1828-11", observer={"distance": 3.6}).pulsar()
        times = np.linspace(0.0, 3.0e7, 101)
        once, twice, phase, inclination, orientation, _ = source.wave_harmonics(times)
        sin_i, cos_i = np.sin(inclination), np.cos(inclination)
        plus = twice * (1 + cos_i**2) / 2 * np.cos(2 * phase) - once * sin_i * cos_i * np.cos(phase)
        cross = twice * cos_i * np.sin(2 * phase) - once * sin_i * np.sin(phase)
        turned = (plus + 1j * cross) * np.exp(2j * orientation)
        found = np.array(source.wave(times))
        size = np.hypot(*found).max()
        # To first order in s the wave has terms besides the two harmonics.
        assert np.abs(turned.real - found[0]).max() < 1e-6 * size
        assert np.abs(turned.imag - found[1]).max() < 1e-6 * size


    def test_what_a_pulsar_has(self):
        scene = twofold.Scene("b1937+21")
        pulsar = scene.pulsar()
        # F0 of the scene file, 641.9282 Hz.
        assert pulsar.scene == scene and pulsar.epoch == scene.epoch and 1 / pulsar.period == pytest.approx(641.928, rel=1e-6)
        assert repr(pulsar) == f"<Pulsar of {scene!r}, period {pulsar.period!r} s>"
        assert pickle.loads(pickle.dumps(pulsar)).period == pulsar.period

    def test_dates_with_fractions(self, pulsar):
        table = pulsar.arrivals([49621.25, 50000.75, 51000.5], derivatives=0).table
        found = table["arrival_day"] + table["arrival_fraction"]
        # The nearest pulse is less than a period away.
        assert np.abs(found - [49621.25, 50000.75, 51000.5]).max() < 0.41 / 86400
        with pytest.raises(twofold.Error, match="epoch"):
            pulsar.arrivals([1e7 + 1.0])

    def test_times_of_the_scene_are_counted_from_its_start(self, pulsar):
        later = twofold.Scene("b1828-11", time={"start": 12.0}).pulsar()
        assert later.epoch == pulsar.epoch
        found, expected = later.arrivals().table, pulsar.arrivals().table
        assert np.array_equal(found["pulse"], expected["pulse"]) and np.array_equal(found["arrival_day"], expected["arrival_day"])
        # The first is the pulse nearest to the epoch.
        assert expected["arrival_day"][0] == 49621.0 and abs(expected["arrival_fraction"][0]) < pulsar.period / 2 / 86400

    def test_derivatives_that_are_fitted(self, pulsar):
        dates = [49621.0, 50000.0, 50500.0, 51000.0, 52000.0]
        assert len(pulsar.arrivals(dates).derivatives) == 2 and len(pulsar.arrivals(dates, derivatives=1).derivatives) == 1
        steady = twofold.Scene("b1828-11", spin_down=None).pulsar().arrivals(dates)
        assert steady.derivatives == [] and "causes" not in steady.table and "torque" not in steady.table
        assert "torque" in pulsar.arrivals(dates, causes=True).table

    def test_epochs_without_a_pulse(self):
        # The beam of 0.1 rad meets the line of sight only at some phases of a wobble of 20 deg.
        timing = twofold.Scene("b1828-11", initial={"wobble": "20 deg"}).pulsar().arrivals(np.arange(49621.0, 50121.0, 10.0))
        assert 0 < timing.dark < 50 and len(timing.table) == 50 - timing.dark

    def test_a_wave_needs_a_distance(self):
        nowhere = twofold.Scene("b1828-11", observer={"distance": None}, output=None).pulsar()
        with pytest.raises(twofold.Error, match="observer.distance"):
            nowhere.wave(0.0)
        once, twice, *others = nowhere.wave_harmonics(0.0)
        assert np.isnan([once, twice]).all() and others[-1] == pytest.approx(np.radians(3.0))


class TestTimingModel:
    def test_without_a_wobble_it_is_a_taylor_series(self):
        f0, f1 = 641.9, -4.3e-14
        model = twofold.TimingModel(f0, f1=f1, f2=3 * f1**2 / f0)
        times = np.array([-3e8, -1.0, 0.0, 2e8])
        whole, rest = model.phase(times)
        exact = np.longdouble(f0) * times + np.longdouble(f1) * times**2 / 2 + np.longdouble(3 * f1**2 / f0) * times**3 / 6
        # Extended doubles have 2e11 turns to 1e-8; the next term of a dipole is 15 F1^3 / F0^2 t^4 / 24, 1e-12.
        assert np.abs(np.asarray(whole - exact + rest, float)).max() < 2e-8

    def test_arrivals_invert_the_phase(self):
        model = twofold.TimingModel(642.0, f1=-1e-14, wobble=0.01, chi=1.0, precession_rate=1e-7, torque_share=1.0)
        numbers = np.array([0.0, 1e6, -1e11])
        whole, rest = model.phase(*model.arrival(numbers))
        assert np.abs(whole - numbers + rest).max() < 1e-13

    def test_derivatives_are_those_of_the_phase(self):
        options = {
            "f1": -3e-13, "f2": 2e-25, "wobble": 0.05, "chi": 1.3, "precession_phase": 0.4, "precession_rate": 1.5e-7,
            "torque_share": 0.7, "inclination": 1.2, "rho": 0.3,
        }  # fmt: skip
        model = twofold.TimingModel(2.5, **options)
        times = np.array([1e7, 2e8])
        found = model.phase_and_derivatives(times)[2]
        assert found.shape == (2, len(twofold.TimingModel.names))
        steps = {"phase": 1e-3, "f0": 1e-10, "f1": 1e-16, "f2": 1e-24, "wobble": 1e-5, "chi": 1e-5,
                 "precession_phase": 1e-4, "precession_rate": 1e-13, "torque_share": 1e-3}  # fmt: skip
        for name, step in steps.items():
            up, down = (model.moved(**{name: sign * step}).phase(times) for sign in (1, -1))
            difference = (up[0] - down[0] + up[1] - down[1]) / (2 * step)
            column = found[:, twofold.TimingModel.names.index(name)]
            # Rounding of 1e-13 turn over the step, and the third derivative.
            assert np.allclose(column, difference, rtol=1e-5, atol=1e-12 / step), name

    def test_times_off_by_three_standard_deviations(self):
        """Residuals and error bars of a star that loses a twentieth of its rotation, from the rate of its phase at each arrival."""
        model = twofold.TimingModel(30.0, f1=-3e-10, f2=9e-21)
        numbers = np.round(np.linspace(2e9, 1.4e11, 40))
        t, rest = model.arrival(numbers)
        rates = model.phase_rate(t, rest)
        after = model.phase(t, rest + 0.5 / rates)
        assert np.abs((after[0] - numbers) + after[1] - 0.5).max() < 1e-9
        late = np.where(np.arange(40) % 2, 3.0, -3.0)
        data = twofold.TimingData(t, 1e-4, rest=rest + 1e-4 * late, numbers=numbers)
        found = twofold.fit_timing(model, data, ["phase"])
        assert found.sigmas[0] == pytest.approx(1e-4 / np.sqrt(np.sum(rates**-2.0)), rel=1e-9)
        assert np.allclose(np.abs(found.residuals), 3.0, atol=0.02) and found.chi_squared == pytest.approx(360.0, rel=1e-3)

    def test_widths_without_a_wobble_are_those_of_a_cone(self):
        model = twofold.TimingModel(2.5, chi=1.2, inclination=1.0, rho=0.4)
        expected = kernels.pulse_width(0.4, 1.2, 1.0) / (2 * np.pi * 2.5)
        assert model.width([[0.0, 3e7]]) == pytest.approx(np.full((1, 2), expected), rel=1e-12)
        assert model.width(1.0) == pytest.approx(expected, rel=1e-12)

    def test_rests_of_times_beyond_a_block(self):
        """More numbers than one block of the computation, each with its own rest."""
        model = twofold.TimingModel(300.0, f1=-1e-12)
        times, rest = np.arange(40_000.0), np.arange(40_000.0) * 1e-9
        whole, fraction = model.phase(times, rest)
        derivatives = model.phase_and_derivatives(times, rest)
        for k in (0, 1, 16_383, 16_384, 39_999):
            assert (whole[k], fraction[k]) == model.phase(times[k], rest[k])
            assert np.array_equal(derivatives[2][k], model.phase_and_derivatives(times[k], rest[k])[2])
        assert np.array_equal(derivatives[0], whole) and np.array_equal(derivatives[1], fraction)
        # One rest for all times.
        assert np.array_equal(model.phase(times[:3], 1e-9), model.phase(times[:3], np.full(3, 1e-9)))

    def test_models_that_differ_in_one_number(self):
        given = {"f1": -1e-15, "chi": 1.0, "precession_rate": 1e-7, "damping": 1e-12}
        model = twofold.TimingModel(300.0, **given)
        assert model == twofold.TimingModel(300.0, **given) != twofold.TimingModel(300.0, 1e-16, **given)
        assert model != model.moved(damping=1e-13) and model != model.moved(f1=1e-16)
        assert repr(twofold.TimingModel(300.0)) == "TimingModel(300.0, 0.0)"
        assert repr(model) == "TimingModel(300.0, 0.0, f1=-1e-15, chi=1.0, precession_rate=1e-7, damping=1e-12)"

    def test_units_are_those_of_derivatives_of_turns(self):
        units = twofold.TimingModel.units
        with pytest.raises(TypeError):
            units["f0"] = "mHz"
        assert tuple(units) == twofold.TimingModel.names
        assert [units[name] for name in ("phase", "f0", "f1", "f2", "chi", "precession_rate", "damping")] == ["1", "Hz", "Hz/s", "Hz/s^2", "rad", "rad/s", "1/s"]

    @pytest.mark.parametrize("inclination", [0.0, 1.0, np.pi / 2])
    def test_pickled_and_printed(self, inclination):
        model = twofold.TimingModel(300.0, 1e-15, f1=-1e-15, wobble=0.1, chi=1.0, inclination=inclination)
        assert pickle.loads(pickle.dumps(model)) == model == eval(repr(model), {"TimingModel": twofold.TimingModel})
        assert model["wobble"] == 0.1 and model.frequency == [300.0, 1e-15]
        assert model.moved(f0=1e-16).frequency[1] == pytest.approx(1.1e-15)

    @pytest.mark.parametrize(
        ("make", "words"),
        [
            (lambda: twofold.TimingModel(-1.0), ["f0", "-1", "above zero"]),
            (lambda: twofold.TimingModel(1.0, wobbel=0.1), ["wobbel", "wobble"]),
            (lambda: twofold.TimingModel(1.0, wobble=2.0), ["wobble", "2"]),
            (lambda: twofold.TimingModel(1.0).phase([1.0, 2.0], [1.0]), ["rest", "shape"]),
            (lambda: twofold.TimingModel(1.0).arrival(0.5), ["number", "whole"]),
            (lambda: twofold.TimingModel(1.0).arrival(1e300), ["number = 1e300", "2^53"]),
            (lambda: twofold.TimingModel(1.0, rho=0.3, inclination=1.5).width([1.0, np.nan]), ["t (s) = NaN", "finite"]),
            (lambda: twofold.Scene("wave-source", time={"epoch": "58000.0"}, pulsar={"chi": 1.0, "rho": 0.3}).pulsar().wave(np.nan), ["t (s) = NaN", "finite"]),
            (lambda: twofold.Scene("b1828-11").pulsar().wave_harmonics([0.0, np.inf]), ["t (s) = inf", "finite"]),
            (lambda: twofold.TimingData([np.nan], 1.0), ["times (s) = NaN", "finite"]),
            (lambda: twofold.TimingData([1.0], 1.0, rest=np.inf), ["rest (s) = inf", "finite"]),
            (lambda: twofold.TimingData([1.0], 1.0, numbers=[1e300]), ["numbers = 1e300", "2^53"]),
            (lambda: twofold.TimingData([1.0], 1.0, numbers=[-np.inf]), ["numbers = -inf", "whole"]),
            (lambda: twofold.TimingData(width_times=[np.inf], widths=[1.0], width_sigmas=[1.0]), ["width_times (s) = inf", "finite"]),
            (lambda: twofold.TimingData(width_times=[1.0], widths=[0.0], width_sigmas=[1.0]), ["widths (s) = 0", "above zero"]),
            (lambda: twofold.TimingData(width_times=[1.0], widths=[np.nan], width_sigmas=[1.0]), ["widths (s) = NaN", "finite"]),
            (lambda: twofold.TimingData(width_times=[1.0], widths=[1.0], width_sigmas=[0.0]), ["width_sigmas (s) = 0", "above zero"]),
            (lambda: twofold.TimingData([1.0, 2.0, 1.0], 1.0, rest=[1e-9, 0.0, 1e-9]), ["t = 1.0 s", "twice", "given only once"]),
            (lambda: twofold.TimingData(width_times=[3.0, 3.0], widths=[0.5, 0.5], width_sigmas=[1.0, 2.0]), ["t = 3.0 s", "twice"]),
            (lambda: twofold.fit_timing(twofold.TimingModel(1.0), twofold.TimingData([1.0], 1.0), ["phase,f0"]), ["unknowns", "`phase,f0`", "single name"]),
            (lambda: twofold.fit_timing(twofold.TimingModel(1.0), twofold.TimingData([1.0], 1.0), []), ["unknowns", "at least one name"]),
            (lambda: twofold.wobble_limits(twofold.TimingModel(1.0), twofold.TimingData([1.0], 1.0), ["phse"], [1.0]), ["unknowns: `phse`", "`phase`"]),
            (lambda: twofold.TimingData([1.0, 2.0], [1.0]), ["sigmas", "1", "2"]),
            (lambda: twofold.TimingData([1.0]), ["sigmas"]),
            (lambda: twofold.TimingData([1.0], [np.inf]), ["sigmas", "inf", "finite number above zero"]),
            (lambda: twofold.TimingData([[1.0]], 1.0), ["times", "one dimension"]),
            (lambda: twofold.TimingData(1.0, 1.0), ["times", "one dimension"]),
            (lambda: twofold.TimingData([1.0], 1.0, numbers=[0.5]), ["number", "0.5", "whole"]),
            (lambda: twofold.TimingData(width_times=[1.0], widths=[1.0, 2.0], width_sigmas=[1.0]), ["have the lengths 1, 2 and 1: must be equal"]),
            (lambda: twofold.TimingData(width_times=[1.0], widths=[1.0], width_sigmas=[]), ["have the lengths 1, 1 and 0: must be equal"]),
            (lambda: twofold.TimingData(width_times=[1.0], widths=[1.0], width_sigmas=[1.0, 2.0]), ["have the lengths 1, 1 and 2: must be equal"]),
            (lambda: twofold.TimingData.read([], -1.0), ["epoch", "-1", "0 to 1e7"]),
            (lambda: twofold.TimingData.read([], 1e7 + 1.0), ["epoch", "10000001", "0 to 1e7"]),
            (lambda: twofold.Scene("b1828-11").pulsar().arrivals().tim(0.0), ["uncertainty", "0", "above zero"]),
            (lambda: twofold.Scene("b1828-11").pulsar().arrivals().tim(np.inf), ["uncertainty", "inf"]),
            (lambda: twofold.TimingModel(1.0).phase([0.0], [np.nan]), ["rest (s)", "finite"]),
            (lambda: twofold.wobble_limits(twofold.TimingModel(2.5, chi=1.4), twofold.TimingData([1.0], 1.0), ["phase"], [np.inf]), ["period", "inf"]),
            (lambda: twofold.wobble_posterior([1.0, 2.0], [1.0], [1.0, 2.0]), ["across", "length 1", "2"]),
            (lambda: twofold.fit_timing(twofold.TimingModel(1.0), twofold.TimingData([1.0], 1.0), ["phase"], priors={"phase": 1.0}), ["priors", "phase", "pair"]),
            (lambda: twofold.fit_timing(twofold.TimingModel(1.0), twofold.TimingData([1.0], 1.0), ["phase"], priors={"phase": (np.nan, 1.0)}), ["mean of a prior"]),
            (lambda: twofold.TimingData([1.0], [-1.0]), ["sigmas", "-1"]),
            (lambda: twofold.TimingModel(1.0).phase(1e19), ["phase", "9e15"]),
            (lambda: twofold.TimingModel(1.0).phase([0.0, np.nan]), ["t (s)", "finite"]),
            (lambda: twofold.wobble_limits(twofold.TimingModel(2.5, chi=1.4), twofold.TimingData(), ["phase"], [4e7]), ["number of data is 0", "at least 2"]),
            (lambda: twofold.wobble_posterior([1.0], [1.0, 2.0], [1.0, 2.0]), ["along", "length 1", "2"]),
            (lambda: twofold.wobble_posterior([1.0], [np.nan], [1.0]), ["derivative", "NaN"]),
            (lambda: twofold.Scene("b1828-11").pulsar().arrivals([]), ["epochs", "at least one"]),
            (lambda: twofold.TimingModel(2.5, all=1.0), ["`all`", "one parameter"]),
            (lambda: twofold.Scene("tp-1", about={"a": 1}), ["about", "section"]),
            (lambda: twofold.fit_timing(twofold.TimingModel(1.0), twofold.TimingData([1.0], 0.0), ["phase"]), ["sigmas", "0"]),
        ],
    )
    def test_bad_input_is_named(self, make, words):
        with pytest.raises(twofold.Error) as caught:
            make()
        for word in words:
            assert word in str(caught.value)


class TestFits:
    def test_a_straight_line(self):
        """Phase and frequency of 50 arrivals: the standard deviations of a straight line."""
        truth = twofold.TimingModel(10.0)
        numbers = np.arange(50) * 1e6
        times, rest = truth.arrival(numbers)
        random = np.random.default_rng(5)
        data = twofold.TimingData(times, 1e-5, rest=rest + 1e-5 * random.standard_normal(50), numbers=numbers)
        found = twofold.fit_timing(twofold.TimingModel(10.0, 1e-14), data, ["phase", "f0"])
        design = np.stack([np.ones(50), times], axis=1) * (1 / (10.0 * 1e-5))
        covariance = np.linalg.inv(design.T @ design)
        assert np.allclose(found.covariance, covariance, rtol=1e-9)
        pulls = (found.values - [0.0, 10.0])[0] / found.sigmas[0], (sum(found.model.frequency) - 10.0) / found.sigmas[1]
        assert np.abs(pulls).max() < 3.5
        assert found.judged == "as stated" and found.degrees == 48
        assert found.units == {"phase": "1", "f0": "Hz"}
        assert found.chi_squared == pytest.approx((found.residuals**2).sum())

    def test_a_prior(self):
        truth = twofold.TimingModel(10.0)
        times, rest = truth.arrival(np.arange(3) * 1e6)
        data = twofold.TimingData(times, 1e-5, rest=rest)
        found = twofold.fit_timing(truth, data, ["phase"], priors={"phase": (0.0, 1e-4 / np.sqrt(3))})
        assert found.sigmas[0] == pytest.approx(1e-4 / np.sqrt(6)) and found["phase"] == (found.values[0], found.sigmas[0])
        with pytest.raises(KeyError, match="f0.*fitted are phase"):
            found["f0"]
        with pytest.raises(twofold.Error, match="f0"):
            twofold.fit_timing(truth, data, ["phase"], priors={"f0": (10.0, 1.0)})

    def test_an_error_that_leads_out_of_the_model_has_no_parabola(self):
        """A beam of 0.3 rad with an error above its radius: one standard deviation less is no beam."""
        model = twofold.TimingModel(10.0, chi=1.3, inclination=1.2, rho=0.3)
        times = [1e5, 1e6]
        data = twofold.TimingData(width_times=times, widths=model.width(times), width_sigmas=[0.02, 0.02])
        found = twofold.fit_timing(model, data, ["rho"])
        assert found.sigmas[0] > 0.3 and found.nonlinearity == np.inf

    def test_data_are_pickled(self):
        data = twofold.TimingData([1.0, 2.0], 1e-6, rest=[1e-9, 0.0], numbers=[7.0, np.nan], width_times=[1.0], widths=[0.1], width_sigmas=[0.01])
        again = pickle.loads(pickle.dumps(data))
        assert again == data and data != twofold.TimingData([1.0, 2.0], 1e-6)
        assert np.array_equal(again.numbers, [7.0, np.nan], equal_nan=True)
        assert np.array_equal(again.times, [[1.0, 1e-9], [2.0, 0.0]]) and np.array_equal(again.widths, [[1.0, 0.1, 0.01]])
        with pytest.raises(twofold.Error, match="numbers = 0.5"):
            twofold.TimingData([1.0], 1e-6, numbers=[0.5])

    def test_data_from_files(self, tmp_path):
        timing = twofold.Scene("b1828-11").pulsar().arrivals([49700.0, 50000.0, 52000.0, 52500.0], derivatives=1)
        (tmp_path / "a.tim").write_text(timing.tim(2e-6))
        (tmp_path / "a.csv").write_bytes(timing.table.csv)
        tim = twofold.TimingData.read([tmp_path / "a.tim"], "49621.0")
        csv = twofold.TimingData.read([tmp_path / "a.csv"], 49621.0, observe="arrivals:1e-6,widths:1e-5")
        table = timing.table
        expected = (table["arrival_day"] - 49621.0) * 86400.0 + table["arrival_fraction"] * 86400.0
        for data, sigma in ((tim, 2e-6), (csv, 1e-6)):
            assert np.allclose(data.times.sum(axis=1), expected, rtol=1e-15) and np.array_equal(data.sigmas, np.full(4, sigma))
            assert np.array_equal(np.diff(data.numbers), np.diff(table["pulse"]))
        assert tim.widths.shape == (0, 3) and repr(tim) == "<TimingData: 4 arrivals, 0 widths>"
        assert np.allclose(csv.widths, np.stack([expected, table["duration"], np.full(4, 1e-5)], axis=-1), rtol=1e-12)
        with pytest.raises(twofold.Error, match=r"a.csv: the datum of MJD .* also in an earlier file"):
            model = twofold.Scene("b1828-11").pulsar().timing_model()
            twofold.TimingData.read([tmp_path / "a.csv", tmp_path / "a.csv"], 49621.0, model=model, observe="arrivals:1e-6")
        assert repr(twofold.TimingData.read([], 0.5)) == "<TimingData: 0 arrivals, 0 widths>"
        # Half a day from midnight, in a double and in a text.
        assert twofold.TimingData.read([tmp_path / "a.tim"], 49620.5) == twofold.TimingData.read([tmp_path / "a.tim"], "49620.5")

    def test_every_file_counts_its_pulses_from_one_of_its_own(self, tmp_path):
        """A file that starts at another pulse, and one without numbers."""
        pulsar = twofold.Scene("b1828-11").pulsar()
        model = pulsar.timing_model()
        for name, dates in (("a", [49700.0, 50000.0, 52000.0]), ("b", [50100.0, 51000.0]), ("c", [50200.0, 50300.0])):
            (tmp_path / f"{name}.csv").write_bytes(pulsar.arrivals(dates, derivatives=0).table.csv)
        lines = (tmp_path / "b.csv").read_text().splitlines()
        column = lines[0].split(",").index("pulse")
        cells = [line.split(",") for line in lines]
        moved = [cells[0], *([*row[:column], str(int(row[column]) - 1234), *row[column + 1 :]] for row in cells[1:])]
        (tmp_path / "b.csv").write_text("".join(",".join(row) + "\n" for row in moved))
        cells = [line.split(",") for line in (tmp_path / "c.csv").read_text().splitlines()]
        (tmp_path / "c.csv").write_text("".join(",".join([*row[:column], *row[column + 1 :]]) + "\n" for row in cells))

        def read(names, model=None):
            return twofold.TimingData.read([tmp_path / f"{name}.csv" for name in names], pulsar.epoch, model=model, observe="arrivals:1e-6")

        data = read("abc", model)
        turns, fraction = model.phase(data.times[:, 0], data.times[:, 1])
        # The rates of the model are accurate to a few roundings of 5e8 turns.
        assert np.array_equal(data.numbers, turns) and np.abs(fraction).max() < 4 * 2.2e-16 * 5.1e8
        assert np.isnan(read("ac").numbers[3]) and np.array_equal(np.diff(read("ac").numbers[:3]), np.diff(data.numbers[:3]))
        with pytest.raises(twofold.Error, match=r"b.csv: it numbers its pulses, and so does an earlier file.*give a model"):
            read("acb")

    def test_one_number_for_all_arrivals(self):
        assert twofold.TimingData([1.0, 2.0], 1e-6, rest=1e-9, numbers=3.0) == twofold.TimingData([1.0, 2.0], [1e-6, 1e-6], rest=[1e-9, 1e-9], numbers=[3.0, 3.0])
        assert np.array_equal(twofold.TimingData([1.0, 2.0], 1e-6).times, [[1.0, 0.0], [2.0, 0.0]])
        assert np.isnan(twofold.TimingData([1.0, 2.0], 1e-6).numbers).all()

    @pytest.mark.parametrize(("part", "judged"), [(0.1, "smaller"), (1.0, "as stated"), (10.0, "larger")])
    def test_residuals_are_judged(self, part, judged):
        numbers = np.arange(100) * 1e6
        times, rest = twofold.TimingModel(10.0).arrival(numbers)
        noise = 1e-5 * np.random.default_rng(2).standard_normal(100)
        data = twofold.TimingData(times, 1e-5, rest=rest + part * noise, numbers=numbers)
        found = twofold.fit_timing(twofold.TimingModel(10.0), data, ["phase", "f0"])
        assert found.judged == judged and found.chi_squared == pytest.approx(part**2 * 98, rel=0.4)
        # The model is linear in both: chi^2 is parabolic.
        assert abs(found.nonlinearity) < 1e-6
        assert f"; chi^2 = {found.chi_squared:.1f} of 98>" in repr(found)

    def test_a_wobble_that_is_there(self):
        """Two quadratures at the period of a small wobble, compared with least squares in numpy."""
        wobble, period, chi = 2e-3, 7.1e6, 0.8
        truth = twofold.TimingModel(100.0, chi=chi, wobble=wobble, precession_rate=2 * np.pi / period, precession_phase=1.0)
        numbers = np.arange(2000) * 1e7
        times, rest = truth.arrival(numbers)
        data = twofold.TimingData(times, 1e-5, rest=rest, numbers=numbers)
        found = twofold.wobble_limits(twofold.TimingModel(100.0, chi=chi), data, ["phase", "f0"], [period, 1e9], confidence=0.5)
        assert list(found) == ["period", "best", "gain", "limit"] and np.array_equal(found["period"], [period, 1e9])
        assert found["best"][0] == pytest.approx(wobble, rel=1e-3)
        # Amplitude cot(chi) theta / (2 pi F0) of a sine over many turns, in standard deviations.
        size = wobble / np.tan(chi) / (2 * np.pi * 100.0) / 1e-5
        assert found["gain"][0] == pytest.approx(2000 * size**2 / 2, rel=0.02)
        # The median of the posterior is near the best value, which is ten standard deviations from zero.
        assert found["limit"][0] == pytest.approx(wobble, rel=0.02)
        assert twofold.wobble_limits(twofold.TimingModel(100.0, chi=chi), data, ["phase", "f0"], [period])["limit"][0] > found["limit"][0]
        # Any positive period is allowed.
        assert twofold.wobble_limits(twofold.TimingModel(100.0, chi=chi), data, ["phase", "f0"], [0.5])["limit"][0] > 0.0

    def test_the_limit_of_a_wobble(self):
        """For exact arrivals the posterior is half a normal distribution with its 95 % at 1.96 standard deviations, the same for both quadratures."""
        model = twofold.TimingModel(100.0, chi=0.8)
        times, rest = model.arrival(np.arange(2000) * 1e7)
        data = twofold.TimingData(times, 1e-5, rest=rest)
        period = 7.1e6
        limits = twofold.wobble_limits(model, data, ["phase", "f0"], [period])
        # cot(chi) sin(psi) / (2 pi F0) per radian; over ten or more turns the fit absorbs only a few percent.
        size = 1 / np.tan(0.8) / (2 * np.pi * 100.0)
        sigma = 1e-5 / (size * np.sqrt(2000 / 2))
        assert limits["limit"][0] == pytest.approx(1.96 * sigma, rel=0.05)
        assert limits["period"][0] == period
        with pytest.raises(twofold.Error, match="period"):
            twofold.wobble_limits(model, data, ["phase"], [-1.0])

    def test_numbers_of_pulses_are_whole_doubles(self):
        model = twofold.TimingModel(100.0)
        times, _ = model.arrival([-9e15, 9e15])
        assert np.allclose(times, [-9e13, 9e13], rtol=1e-15)
        for number in (-(2.0**53) - 2, 2.0**53 + 2, 0.5, np.nan):
            with pytest.raises(twofold.Error, match="a whole number, up to 2.53 in size"):
                model.arrival(number)

    def test_the_posterior_of_a_wobble(self):
        found = twofold.wobble_posterior([1e6, 0.0], [0.0, 1e6], [-1e3, -2e3])
        assert found["best"] == pytest.approx([1e-3, 2e-3]) and found["gain"] == pytest.approx(5e6)
        # The prior is flat in theta, not over the plane, which gives a factor theta^(-1/2).
        expected = np.sqrt(5) * 1e-3 + 1.644853627e-6 - 0.5e-12 / (np.sqrt(5) * 1e-3)
        assert found["limit"] == pytest.approx(expected, abs=1e-12)
        assert twofold.wobble_posterior([1.0], [1.0], [0.0])["limit"] == np.inf

    def test_a_scene_is_found_again_from_its_own_tables(self):
        scene = twofold.Scene("tp-1", time={"span": 60.0, "samples": 61})
        names = ["spin", "s_axial"]
        fisher = scene.fisher({"arrivals": 1e-5}, names)
        # Error bars are proportional to the stated error, with all its digits.
        larger = scene.fisher({"arrivals": 1.2345e-5}, names)
        assert np.array(larger.sigmas) == pytest.approx(1.2345 * np.array(fisher.sigmas), rel=1e-12)
        found = scene.fit([scene.pulses()], {"closest_approaches": 1e-5}, names)
        assert found.unknowns == names and fisher.unknowns == names
        assert found.units == fisher.units == {"spin": "rad/t_c", "s_axial": "1"}
        assert np.abs((found.values - fisher.values) / found.sigmas).max() < 0.01
        assert np.all(fisher.sigmas > 0) and np.allclose(fisher.covariance, fisher.covariance.T)


class TestKernels:
    def test_pulse_width(self):
        theta = np.linspace(0.3, 1.3, 11)
        found = kernels.pulse_width(0.6, theta, 0.8)
        cosine = (np.cos(0.6) - np.cos(theta) * np.cos(0.8)) / (np.sin(theta) * np.sin(0.8))
        assert np.allclose(np.cos(found / 2), cosine, atol=1e-14)
        assert kernels.pulse_width(0.1, 0.3, 1.5) == 0.0 and kernels.pulse_width(1.5, 0.1, 0.1) == 2 * np.pi

    def test_broadcast(self):
        found = kernels.combination_bound(2.5e-7, 4e3, [[4e8], [8e8]], [1e-4, 2e-4, 3e-4], 1.0)
        expected = 2.5e-7 * 4e3 * np.array([1e-4, 2e-4, 3e-4]) / np.array([[4e8], [8e8]])
        assert found.shape == (2, 3) and np.allclose(found, expected, rtol=1e-15)
        with pytest.raises(twofold.Error, match="broadcast"):
            kernels.pulse_width([0.1, 0.2], [0.1, 0.2, 0.3], 0.1)

    @pytest.mark.parametrize(
        ("kernel", "inside", "outside"),
        [
            (kernels.pulse_width, (0.3, 1.0, 1.0), {"rho": (-0.3, 0.0, np.pi, 4.0), "theta": (-0.1, 3.2, 7.0), "theta_o": (-0.1, 3.2)}),
            (kernels.anisotropic_potential, (0.02, 0.01, -0.03, 0.1, 0.2), dict.fromkeys(["s_xx", "s_yy", "s_zz", "alpha", "beta"], (np.inf,))),
            (kernels.constant_c, (1e30, 1e4, 0.1), {"mass": (0.0, -1.0, np.inf), "radius": (0.0, -1.0), "oblateness": (-1.0, 1.0)}),
            (kernels.inertia_over_c, (1e18, 1e-3), {"density": (-1e18, 0.0, np.inf), "oblateness": (-1e-3, 0.0, 1.0)}),
            (kernels.fluid_inertia_over_c, (-2.0,), {"spin": (0.0, np.inf)}),
            (kernels.lambda_change, (0.5, 1.0, 0.3, -1e-3), {"lambda_": (-0.1, 3.2), "chi": (-0.1, 3.2), "width": (-0.1, 7.0), "width_change": (np.inf,)}),
            (
                kernels.combination_bound,
                (1e-7, -4e3, 4e8, -1e-4, 1.0),
                {"inertia_over_c": (-1.0, 0.0), "spin": (np.inf,), "interval": (-1.0, 0.0), "cos_lambda_change": (-3.0, 3.0), "eta": (-1.0, 0.0)},
            ),
            (kernels.root_mean_square_eta, (0.3, 0.7), {"asymmetry_ratio": (np.inf,), "beta": (-0.1, 3.2)}),
        ],
    )
    def test_arguments_outside_their_domains(self, kernel, inside, outside):
        assert np.isfinite(kernel(*inside))
        for place, (name, refused) in enumerate(outside.items()):
            for value in (*refused, np.nan):
                given = [*inside[:place], [inside[place], value], *inside[place + 1 :]]
                with pytest.raises(twofold.Error, match=rf"^{name}( .*)? = \S+: must be"):
                    kernel(*given)

    def test_results_are_finite(self):
        for call in (lambda: kernels.constant_c(1e300, 1e4, 0.1), lambda: kernels.fluid_inertia_over_c(1e-200), lambda: kernels.inertia_over_c(1e-300, 1e-15)):
            with pytest.raises(twofold.Error, match="C .* = inf: must be finite; use other arguments"):
                call()

    def test_potential(self):
        alpha, beta = 0.3, 0.7
        n = np.array([np.sin(alpha) * np.sin(beta), -np.cos(alpha) * np.sin(beta), np.cos(beta)])
        assert kernels.anisotropic_potential(0.02, 0.01, -0.04, alpha, beta) == pytest.approx(n**2 @ [0.02, 0.01, -0.04], rel=1e-15)

    def test_constant_c(self):
        # I^zz / C = 15 / (4 pi G rho epsilon) to first order, Eq. (43), with I^zz = 2 M R^2 / 5.
        found = kernels.constant_c(2.8e30, 1.2e4, 1e-6)
        assert found == pytest.approx(2 / 25 * 6.6743e-11 * 2.8e30**2 / 1.2e4 * 1e-6, rel=1e-5)
        assert kernels.constant_c(2.8e30, 1.2e4, 2e-6) == pytest.approx(2 * found, rel=1e-5)

    def test_the_angle_to_the_line_of_sight(self):
        """Eq. (42) with cotangents, as printed."""
        angle, chi, width = np.array([0.5, 1.9]), 1.0, 0.3
        expected = 0.5 * np.sin(width / 2) / (np.cos(width / 2) / np.tan(angle) + 1 / np.tan(chi)) * 1e-3
        assert kernels.lambda_change(angle, chi, width, 1e-3) == pytest.approx(expected, rel=1e-13)

    def test_eta_on_average(self):
        """An average over observer directions and azimuths of the axis, from the torque of the self-energy."""
        r, beta = 0.3, 0.7
        alpha = np.arange(360) * 2 * np.pi / 360
        n = np.stack([np.sin(beta) * np.sin(alpha), -np.sin(beta) * np.cos(alpha), np.full(360, np.cos(beta))], axis=-1)
        # s^XX, s^YY, s^ZZ with 2 s^ZZ - s^XX - s^YY = 1 and s^XX - s^YY = r, without a trace.
        s = np.array([-1 / 6 + r / 2, -1 / 6 - r / 2, 1 / 3])
        speed_squared = np.mean(np.sum(np.cross(n, s * n) ** 2, axis=1))
        # One of three components; eta = 1 is a rate of half the combination.
        assert kernels.root_mean_square_eta(r, beta) == pytest.approx(0.5 / np.sqrt(speed_squared / 3), rel=1e-12)

    def test_broadcast_beyond_a_block(self):
        theta = np.linspace(0.4, 1.2, 20_000)
        found = kernels.pulse_width(0.6, theta, 0.8)
        assert [found[k] for k in (0, 16_383, 16_384, 19_999)] == [kernels.pulse_width(0.6, theta[k], 0.8) for k in (0, 16_383, 16_384, 19_999)]
        assert np.array_equal(kernels.pulse_width([[0.6], [0.7]], theta[None, :3], 0.8), [kernels.pulse_width(rho, theta[:3], 0.8) for rho in (0.6, 0.7)])

    def test_fluid_star(self):
        assert kernels.fluid_inertia_over_c(2.0) == 1.0
        density, oblateness = 1e18, 1e-6
        expected = 15 / (4 * np.pi * 6.6743e-11 * density * oblateness)
        assert kernels.inertia_over_c(density, oblateness) == pytest.approx(expected, rel=1e-12)
