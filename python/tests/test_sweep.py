"""Sweeps by executors: the same bytes for any way of computation, and after a worker was killed."""

import multiprocessing
import os
import pickle
import signal
import struct
import sys
import threading
import time
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool

import pytest
import twofold
from twofold._twofold import SweepFile

GRID = """
scene = "tp-2"
seed = 1
draws = 4
[[vary]]
parameter = "star.inertia_ratio"
grid = { from = 1.01, to = 2.02, points = 25 }
[[vary]]
parameter = "lorentz_violation.eigenvalues[2]"
random = { distribution = "normal", mean = -0.04, deviation = 0.01 }
[time]
times = [10.0, 30.0]
[output]
columns = ["e_z", "errors"]
summaries = ["lambda"]
"""


@pytest.fixture(scope="module")
def sweep():
    return twofold.Sweep(toml=GRID)


@pytest.fixture(scope="module")
def one_core(sweep):
    """The table of one call in one thread: header and rows."""
    assert len(sweep) == 100
    rows, _, _ = sweep.rows(0, 100)
    return sweep.header + rows


class Slowed(twofold.Sweep):
    """A sweep with slow parts, so that it can be killed."""

    def rows(self, start, stop):
        time.sleep(0.05)
        return super().rows(start, stop)


class Cut(twofold.Sweep):
    """Its worker is killed while it transfers a part: with half of a message in the pipe, and holding the lock."""

    first = 40

    def end(self):
        os.kill(os.getpid(), signal.SIGKILL)

    def rows(self, start, stop):
        if start >= self.first:
            frame = sys._getframe()
            while "result_queue" not in frame.f_locals:
                frame = frame.f_back
            results = frame.f_locals["result_queue"]
            with results._wlock:
                os.write(results._writer.fileno(), struct.pack("!i", 1000) + b"half")
                self.end()
        return super().rows(start, stop)


class CutAtTheEnd(Cut):
    """Its worker exits when all remaining parts have been handed out."""

    first = 92

    def end(self):
        os._exit(1)


class Recorded(Executor):
    """Passes parts to another executor, and records them."""

    def __init__(self, executor):
        self.executor, self.parts = executor, []

    def submit(self, function, *arguments):
        if arguments:
            self.parts.append(arguments[-2:])
        return self.executor.submit(function, *arguments)


def processes(method, workers=2):
    return ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context(method))


@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
@pytest.mark.parametrize("method", ["spawn", "fork"])
def test_processes_give_the_bytes_of_one_core(sweep, one_core, method, tmp_path):
    with processes(method) as executor:
        assert sweep.map(executor, scenes_at_once=7, parts_at_once=3).csv == one_core
        sweep.write(tmp_path / "table.csv", executor, scenes_at_once=9)
    assert (tmp_path / "table.csv").read_bytes() == one_core
    # One file, as by the command: only the journal of a complete table remains of the temporary files.
    assert not (tmp_path / "table.csv.partial").exists()


def test_threads_and_any_size_of_parts(sweep, one_core):
    for scenes_at_once in (1, 8, 33, 100, 1000, None):
        with ThreadPoolExecutor(2) as executor:
            done = []
            assert sweep.map(executor, scenes_at_once=scenes_at_once, parts_at_once=5, progress=done.append).csv == one_core
            assert done == sorted(done) and done[-1] == 1.0


def test_shards_are_the_whole(sweep, one_core):
    parts = [sweep.rows(start, stop)[0] for start, stop in ((0, 33), (33, 34), (34, 100))]
    assert sweep.header + b"".join(parts) == one_core
    assert sweep.run().csv == one_core
    assert pickle.loads(pickle.dumps(sweep)).run(0, 5).csv == sweep.run(0, 5).csv


def test_more_scenes_than_are_computed_at_once():
    """Some of 601 fail: rows and their number are those of the parts."""
    sweep = twofold.Sweep(toml=GRID.replace("draws = 4", "draws = 1").replace("from = 1.01, to = 2.02, points = 25", "from = -0.5, to = 2.0, points = 601"))
    rows, errors, failed = sweep.rows(0, 601)
    assert len(sweep) == 601 and rows.count(b"\n") == 601 and rows.count(b",failed,") == errors.count(b"\n") == failed > 120
    parts = [sweep.rows(start, min(start + 100, 601)) for start in range(0, 601, 100)]
    assert rows == b"".join(part[0] for part in parts) and errors == b"".join(part[1] for part in parts)
    assert failed == sum(part[2] for part in parts)
    assert sweep.rows(601, 601) == sweep.rows(7, 7) == (b"", b"", 0)


def test_what_a_sweep_is(sweep, tmp_path):
    assert repr(sweep) == f"<Sweep of 100 scenes, {sweep.header.count(b',') + 1} columns>" and sweep.toml == GRID
    (tmp_path / "star.toml").write_text(twofold.Scene("tp-2").toml)
    (tmp_path / "grid.toml").write_text(GRID.replace('"tp-2"', '"star.toml"'))
    of_file = twofold.Sweep(tmp_path / "grid.toml")
    again = pickle.loads(pickle.dumps(of_file))
    assert again == of_file and again.run(0, 3).csv == of_file.run(0, 3).csv
    assert of_file.run(2, 5).csv == sweep.run(2, 5).csv and len(of_file.run(2, 5)) == 3
    assert sweep == twofold.Sweep(toml=GRID) and sweep != twofold.Sweep(toml=GRID.replace("seed = 1", "seed = 2"))
    before = again
    (tmp_path / "star.toml").write_text(twofold.Scene("tp-2", star={"spin": 1.1}).toml)
    assert twofold.Sweep(tmp_path / "grid.toml") != before
    for make in (twofold.Sweep, lambda: twofold.Sweep("grid.toml", toml=GRID)):
        with pytest.raises(twofold.Error, match="one source"):
            make()


@pytest.mark.parametrize(("scenes", "expected"), [(1, 8), (2047, 8), (2560, 10), (65_536, 256), (10**6, 256)])
def test_sizes_of_parts(scenes, expected):
    """A 256th of the sweep, from 8 to 256."""

    class Long(twofold.Sweep):
        def __len__(self):
            return scenes

    parts = []

    class Asked(Executor):
        def submit(self, function, *arguments):
            parts.append(arguments[-2:])
            raise StopIteration

    with pytest.raises((StopIteration, RuntimeError)):
        Long(toml=GRID).map(Asked())
    assert parts == [(0, min(expected, scenes))]


def test_a_file_that_is_replaced_or_not(sweep, tmp_path):
    """Rows transferred one part at a time; the errors of failed scenes are in a separate file."""
    path, failing = tmp_path / "table.csv", twofold.Sweep(toml=GRID.replace("from = 1.01", "from = -0.5"))
    file = twofold._twofold.SweepFile(failing, path)
    assert file.next == 0
    for start in (0, 40):
        file.append(min(start + 40, 100), *failing.rows(start, start + 40))
        assert file.next == start + 40
    file.append(100, *failing.rows(80, 100))
    file.complete()
    del file
    assert path.read_bytes() == failing.header + failing.rows(0, 100)[0] and (tmp_path / "table.csv.errors.csv").exists()
    for taken in (path, tmp_path / "table.csv.errors.csv"):
        if taken.name == "table.csv.errors.csv":
            path.unlink()
        with pytest.raises(twofold.Error, match=f"{taken.name} exists; use replace=True"):
            twofold._twofold.SweepFile(sweep, path)
    assert twofold._twofold.SweepFile(sweep, path, replace=True).next == 0


def test_never_more_parts_at_once_than_allowed(sweep, one_core):
    class Lazy(Executor):
        most = pending = 0

        def submit(self, function, *arguments):
            self.pending += 1
            self.most = max(self.most, self.pending)
            owner = self

            class Later(Future):
                def result(self, timeout=None):
                    owner.pending -= 1
                    return function(*arguments)

            return Later()

    lazy = Lazy()
    assert sweep.map(lazy, scenes_at_once=5, parts_at_once=4).csv == one_core
    assert lazy.most == 4 and lazy.pending == 0


class Waits(Executor):
    """Parts that are done when they are awaited; records cancelled ones."""

    def __init__(self):
        self.cancelled, self.pending, self.most = [], 0, 0

    def submit(self, function, *arguments):
        owner = self
        self.pending += 1
        self.most = max(self.most, self.pending)

        class Later(Future):
            def result(self, timeout=None):
                owner.pending -= 1
                return function(*arguments)

            def cancel(self):
                owner.cancelled.append(arguments[-2:])

        return Later()


def test_sixty_four_parts_at_once(sweep, tmp_path):
    for run in (sweep.map, lambda executor, **options: sweep.write(tmp_path / "table.csv", executor, **options)):
        executor, told = Waits(), []
        run(executor, scenes_at_once=1, progress=told.append)
        # The file's executor was woken up in addition.
        assert executor.most == 64 + (run != sweep.map) and executor.cancelled == []
        assert told == [k / 100 for k in range(1, 101)]


def test_what_waits_is_cancelled_after_an_error(sweep):
    executor = Waits()

    def stop(done):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sweep.map(executor, scenes_at_once=10, parts_at_once=3, progress=stop)
    assert executor.cancelled == [(10, 20), (20, 30)]


class Late(twofold.Sweep):
    def rows(self, start, stop):
        raise TimeoutError("by the worker")


@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
def test_a_time_out_of_a_worker_is_its_own():
    with processes("fork") as executor, pytest.raises(TimeoutError, match="by the worker"):
        Late(toml=GRID).map(executor)


@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
@pytest.mark.parametrize("method", ["spawn", "fork"])
def test_a_killed_worker(one_core, method, tmp_path):
    path = tmp_path / "table.csv"
    slowed = Slowed(toml=GRID)
    with pytest.raises(BrokenProcessPool) as error, processes(method) as executor:
        victims = []

        def kill(done):
            if done >= 0.2 and not victims:
                victims.append(next(iter(executor._processes)))
                os.kill(victims[0], signal.SIGKILL)

        slowed.write(path, executor, scenes_at_once=4, parts_at_once=4, progress=kill)
    assert not path.exists()
    # The error and its traceback are still held, and another executor continues.
    assert error.value is not None
    with processes(method) as executor:
        recorded = Recorded(executor)
        twofold.Sweep(toml=GRID).write(path, recorded, scenes_at_once=4)
    first = recorded.parts[0][0]
    # At least 20 scenes were reported as done, and are not computed again.
    assert 20 <= first < 100
    assert recorded.parts == [(start, start + 4) for start in range(first, 100, 4)]
    assert path.read_bytes() == one_core


def killed_while_named(sweep, path, one_core):
    """A complete table at the moment before it gets its name."""
    file = SweepFile(sweep, path)
    rows, errors, failed = sweep.rows(0, 100)
    file.append(100, rows, errors, failed)
    in_the_way = path.parent / "table.csv.errors.csv"
    in_the_way.mkdir()
    with pytest.raises(twofold.Error, match="exists"):
        file.complete()
    in_the_way.rmdir()
    assert (path.parent / "table.csv.partial").read_bytes() == one_core


def test_a_table_whose_naming_was_cut_off_is_finished(sweep, one_core, tmp_path):
    path, partial, errors = (tmp_path / name for name in ("table.csv", "table.csv.partial", "table.csv.errors.csv"))
    with ThreadPoolExecutor(1) as executor:
        killed_while_named(sweep, path, one_core)
        path.write_text("of another")
        with pytest.raises(twofold.Error, match="exists; use replace=True"):
            sweep.write(path, executor)
        assert path.read_text() == "of another"
        path.unlink()
        sweep.write(path, executor)
        assert path.read_bytes() == one_core and sorted(os.listdir(tmp_path)) == ["table.csv", "table.csv.errors.csv"]
        path.unlink()
        errors.unlink()
        killed_while_named(sweep, path, one_core)
        # Killed after the naming, before the journal was removed: nothing is recomputed.
        partial.rename(path)
        recorded = Recorded(executor)
        sweep.write(path, recorded)
        assert recorded.parts == [] and path.read_bytes() == one_core and os.listdir(tmp_path) == ["table.csv"]


def test_a_link_is_followed(sweep, one_core, tmp_path):
    path, link = tmp_path / "table.csv", tmp_path / "link"
    path.write_text("old")
    link.symlink_to(path)
    with ThreadPoolExecutor(1) as executor:
        sweep.write(link, executor, replace=True)
    assert link.is_symlink() and path.read_bytes() == one_core


@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
@pytest.mark.skipif(sys.platform == "win32", reason="no SIGKILL")
@pytest.mark.parametrize(("method", "cut"), [("spawn", Cut), ("fork", Cut), ("fork", CutAtTheEnd)])
def test_a_worker_killed_while_it_hands_over_a_part(sweep, one_core, method, cut, tmp_path):
    path = tmp_path / "table.csv"
    with pytest.raises(BrokenProcessPool), processes(method) as executor:
        cut(toml=GRID).write(path, executor, scenes_at_once=4, parts_at_once=4)
    assert not path.exists()
    with processes(method) as executor:
        sweep.write(path, executor)
    assert path.read_bytes() == one_core


@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
@pytest.mark.parametrize("method", ["spawn", "fork"])
def test_an_error_in_the_middle_with_workers_that_live_on(sweep, one_core, method, tmp_path):
    path = tmp_path / "table.csv"

    def stop(done):
        if done >= 0.5:
            raise KeyboardInterrupt

    with processes(method) as executor:
        with pytest.raises(KeyboardInterrupt) as error:
            sweep.write(path, executor, scenes_at_once=5, parts_at_once=3, progress=stop)
        assert error.value is not None
        recorded = Recorded(executor)
        sweep.write(path, recorded, scenes_at_once=5)
    assert recorded.parts[0] == (50, 55)
    assert path.read_bytes() == one_core


def test_a_table_that_exists(sweep, one_core, tmp_path):
    path = tmp_path / "table.csv"
    path.write_text("mine\n")
    with ThreadPoolExecutor(2) as executor:
        with pytest.raises(twofold.Error, match="table.csv exists; use replace=True"):
            sweep.write(path, executor)
        assert path.read_text() == "mine\n"
        sweep.write(path, executor, replace=True)
    assert path.read_bytes() == one_core


def test_two_writers_of_one_table(sweep, tmp_path):
    path, begun, go = tmp_path / "table.csv", threading.Event(), threading.Event()

    def wait(_):
        begun.set()
        go.wait(20)

    with ThreadPoolExecutor(2) as executor, ThreadPoolExecutor(1) as writer:
        first = writer.submit(sweep.write, path, executor, progress=wait)
        assert begun.wait(20)
        try:
            with pytest.raises(twofold.Error):
                sweep.write(path, executor)
        finally:
            go.set()
        first.result()
    assert path.exists()


def test_scenes_that_fail_are_rows_and_have_reasons(tmp_path):
    text = GRID.replace("from = 1.01", "from = -0.5")
    failing = twofold.Sweep(toml=text)
    with ThreadPoolExecutor(2) as executor:
        failing.write(tmp_path / "table.csv", executor, scenes_at_once=6)
    rows, errors, failed = failing.rows(0, 100)
    assert 0 < failed < 100
    assert (tmp_path / "table.csv").read_bytes() == failing.header + rows
    assert (tmp_path / "table.csv.errors.csv").read_bytes().endswith(errors)
    assert rows.count(b",failed,") == failed


def test_a_worker_of_another_version_is_refused(sweep, monkeypatch):
    class Elsewhere(Executor):
        def submit(self, function, *arguments):
            monkeypatch.setattr(twofold._twofold, "__version__", "0.0.1")
            future = Future()
            try:
                future.set_result(function(*arguments))
            except twofold.Error as error:
                future.set_exception(error)
            return future

    with pytest.raises(twofold.Error, match="a worker has twofold 0.0.1: must be "):
        sweep.map(Elsewhere())


def test_what_is_refused(sweep):
    with ThreadPoolExecutor(1) as executor:
        for options in ({"scenes_at_once": 0}, {"parts_at_once": -1}):
            name, value = next(iter(options.items()))
            with pytest.raises(twofold.Error, match=f"{name} = {value}: must be a whole number above zero"):
                sweep.map(executor, **options)
    with pytest.raises(twofold.Error, match="scenes 90 to 101: must be within 0 to 100"):
        sweep.rows(90, 101)


@pytest.mark.parametrize("path", ["", ".", "table.parquet"])
def test_a_path_that_is_no_table_is_refused_before_the_work(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    sweep = twofold.Sweep(toml='scene = "tp-1"\n[[vary]]\nparameter = "star.spin"\nvalues = [1.0]\n[time]\ntimes = [1.0]\n')
    with ThreadPoolExecutor(1) as executor, pytest.raises(twofold.Error, match="path"):
        sweep.write(path, executor)
    with ThreadPoolExecutor(1) as executor, pytest.raises(twofold.Error, match="scenes_at_once = 0"):
        sweep.write("table.csv", executor, scenes_at_once=0)
    assert not list(tmp_path.iterdir())


def test_names_of_files_in_bytes(tmp_path):
    (tmp_path / "grid.toml").write_text(GRID)
    sweep = twofold.Sweep(os.fsencode(tmp_path / "grid.toml"))
    with ThreadPoolExecutor(1) as executor:
        sweep.write(os.fsencode(tmp_path / "table.csv"), executor)
    assert (tmp_path / "table.csv").read_bytes() == sweep.run().csv


def test_signals_are_handled_between_costly_scenes(interrupted):
    # A quarter of a minute, so that the thread that sends the signals has its turn on a busy machine; the fourth ends it.
    costly = 'scene = "tp-2"\n[[vary]]\nparameter = "star.inertia_ratio"\ngrid = { from = 1.1, to = 1.2, points = 20000 }\n[time]\ntimes = [1000.0]\n[output]\nmethod = "taylor"\ncolumns = ["e_z"]\n'
    interrupted(twofold.Sweep(toml=costly).run)


def test_any_built_in_scene_is_a_base():
    """A template can be varied; one with spin-down or a bulge is refused for that reason, not as unknown."""
    text = """
scene = "{}"
[[vary]]
parameter = "star.mass"
values = [1.2, 1.4]
[time]
times = [0.01]
"""
    assert len(twofold.Sweep(toml=text.format("wave-source")).run()) == 2
    with pytest.raises(twofold.Error, match="spin_down"):
        twofold.Sweep(toml=text.format("b1828-11"))
