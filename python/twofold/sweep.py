"""Sweeps over many scenes, by any executor of `concurrent.futures`."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Generator
from concurrent.futures import ProcessPoolExecutor
from contextlib import closing
from typing import TYPE_CHECKING

from twofold import _twofold
from twofold._twofold import SweepFile, Table

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future

#: One part: the scene after its last one, rows, rows of errors, number of failed scenes.
_Part = tuple[int, bytes, bytes, int]


#: Rows, rows of errors, number of failed scenes.
_Rows = tuple[bytes, bytes, int]

#: Interval of checks on processes while a part is awaited (s).
_LOOKED_AFTER = 1.0


def _rows(sweep: Sweep, version: str, start: int, stop: int) -> _Rows:
    """Computes a part in a worker. Last digits can differ between versions, so that workers must have that of the caller."""
    if _version() != version:
        raise _twofold.Error(f"a worker has twofold {_version()}: must be {version}, as where the sweep was begun")
    return sweep.rows(start, stop)


def _version() -> str:
    return _twofold.__version__


def _result(executor: Executor, future: Future[_Rows]) -> _Rows:
    """Waits for a part.

    A worker that is killed while it transfers rows leaves half of a message, and a `ProcessPoolExecutor` waits for its end for ever: it still has the
    pipe open for writing itself.
    """
    if not isinstance(executor, ProcessPoolExecutor):
        return future.result()
    while True:
        try:
            return future.result(timeout=_LOOKED_AFTER)
        except TimeoutError:
            if future.done():
                # The worker has raised it.
                return future.result()
            _end_if_broken(executor)


def _end_if_broken(executor: ProcessPoolExecutor) -> None:
    """If a worker has died, ends the others, as the executor does when it notices, and lets it see the end of their results, so that it raises
    `BrokenProcessPool`."""
    workers = list((getattr(executor, "_processes", None) or {}).values())
    if all(worker.exitcode in (None, 0) for worker in workers):
        return
    for worker in workers:
        worker.kill()
    writer = getattr(getattr(executor, "_result_queue", None), "_writer", None)
    if writer is not None:
        writer.close()


class Sweep(_twofold.Sweep):
    """Many scenes: grids, lists and random draws over the parameters of one (docs/sweep.md).

    `Sweep("grid.toml")` reads a file, `Sweep(toml=text)` a text. A row depends only on its scene: any part can be computed anywhere, in one thread, and the parts
    together are the table to the byte. Sweeps can be pickled.
    """

    def map(
        self,
        executor: Executor,
        *,
        scenes_at_once: int | None = None,
        parts_at_once: int = 64,
        progress: Callable[[float], object] | None = None,
    ) -> Table:
        """The whole table in memory, by the workers of an executor: processes, threads, MPI ranks, Dask.

        The executor has at most `parts_at_once` parts of `scenes_at_once` scenes at a time: if not given, a 256th of the sweep, from 8 to 256. Take fewer where a scene takes seconds, and
        twice as many parts as there are workers, or more. `progress` is called with the fraction that is done, from 0 to 1.
        """
        rows = [self.header]
        with closing(self._parts(executor, 0, scenes_at_once, parts_at_once)) as parts:
            for stop, more, _, _ in parts:
                rows.append(more)
                if progress is not None:
                    progress(stop / len(self))
        return Table(b"".join(rows))

    def write(
        self,
        path: str | bytes | os.PathLike[str],
        executor: Executor,
        *,
        scenes_at_once: int | None = None,
        parts_at_once: int = 64,
        replace: bool = False,
        progress: Callable[[float], object] | None = None,
    ) -> None:
        """Writes the table to a CSV file, by the workers of an executor; memory does not grow with the number of scenes.

        The file grows as `path.partial` with a journal beside it. After an interruption, a dead worker or a loss of power the same call, or `twofold sweep`, continues
        where it ended. Scenes that failed are in `path.errors.csv`, with the reason.
        """
        path = os.fsdecode(path)
        if not path or os.path.isdir(path) or path.endswith(".parquet"):
            raise _twofold.Error(f"path = {path!r}: must be the name of a CSV file; use the command `twofold sweep` to write Parquet")
        self._sizes(scenes_at_once, parts_at_once)
        # Workers start before the file is open: forked ones would inherit its lock and keep it.
        executor.submit(_version)
        file = SweepFile(self, path, replace=replace)
        try:
            with closing(self._parts(executor, file.next, scenes_at_once, parts_at_once)) as parts:
                for stop, rows, errors, failed in parts:
                    file.append(stop, rows, errors, failed)
                    if progress is not None:
                        progress(stop / len(self))
            file.complete()
        finally:
            # The traceback of an error keeps this frame: without this the file would stay locked for a continuation.
            del file

    def _sizes(self, scenes_at_once: int | None, parts_at_once: int) -> int:
        """The number of scenes per part."""
        if scenes_at_once is None:
            scenes_at_once = max(8, min(256, len(self) // 256))
        for name, value in (("scenes_at_once", scenes_at_once), ("parts_at_once", parts_at_once)):
            if value < 1:
                raise _twofold.Error(f"{name} = {value}: must be a whole number above zero")
        return scenes_at_once

    def _parts(self, executor: Executor, first: int, scenes_at_once: int | None, parts_at_once: int) -> Generator[_Part, None, None]:
        """The parts from the scene `first` on, in order."""
        scenes_at_once = self._sizes(scenes_at_once, parts_at_once)
        waiting: deque[tuple[int, Future[_Rows]]] = deque()
        version = _version()
        try:
            for start in range(first, len(self), scenes_at_once):
                stop = min(start + scenes_at_once, len(self))
                waiting.append((stop, executor.submit(_rows, self, version, start, stop)))
                if len(waiting) == parts_at_once:
                    stop, future = waiting.popleft()
                    yield stop, *_result(executor, future)
            while waiting:
                stop, future = waiting.popleft()
                yield stop, *_result(executor, future)
        finally:
            for _, future in waiting:
                future.cancel()
