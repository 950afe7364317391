"""One sweep by processes, MPI ranks and Dask: the same bytes, and the speed of two processes relative to one. Needs dask, distributed, mpi4py and mpich, no network.

    executors.py              everything
    executors.py --ratio      the ratio alone
"""

import multiprocessing
import os
import resource
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import twofold

GRID = """
scene = "tp-2"
seed = 1
draws = {draws}
[[vary]]
parameter = "star.inertia_ratio"
grid = {{ from = 1.01, to = 1.9, points = 40 }}
[[vary]]
parameter = "lorentz_violation.eigenvalues[2]"
random = {{ distribution = "normal", mean = -0.04, deviation = 0.01 }}
[time]
times = [100.0, 300.0]
[output]
columns = ["e_z", "L", "errors"]
summaries = ["lambda"]
"""


def main() -> None:
    sweep = twofold.Sweep(toml=GRID.format(draws=25))
    rows, _, _ = sweep.rows(0, len(sweep))
    one_core = sweep.header + rows
    if "--ratio" not in sys.argv:
        same_bytes(sweep, one_core)
    ratio()


def must_be(what: str, found: bytes, expected: bytes) -> None:
    if found != expected:
        sys.exit(f"executors: {what}: {len(found)} bytes that are not those of one core, {len(expected)}")


def same_bytes(sweep: twofold.Sweep, one_core: bytes) -> None:
    for method in ("spawn", "fork"):
        with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context(method)) as executor:
            must_be(method, sweep.map(executor, scenes_at_once=32).csv, one_core)
    with tempfile.TemporaryDirectory() as folder:
        text, program, out = Path(folder, "grid.toml"), Path(folder, "ranks.py"), Path(folder, "table.csv")
        text.write_text(sweep.toml)
        program.write_text(
            "import sys, twofold\n"
            "from mpi4py.futures import MPIPoolExecutor\n"
            "if __name__ == '__main__':\n"
            "    with MPIPoolExecutor() as executor:\n"
            "        print(executor.num_workers)\n"
            "        twofold.Sweep(sys.argv[1]).write(sys.argv[2], executor, scenes_at_once=32)\n"
        )
        mpiexec = Path(sys.prefix, "bin", "mpiexec")
        # One rank distributes the parts, two compute.
        ranks = [str(mpiexec), "-n", "3", sys.executable, "-m", "mpi4py.futures", str(program), str(text), str(out)]
        workers = subprocess.run(ranks, check=True, timeout=300, capture_output=True, text=True).stdout.split()[-1]
        must_be("MPI", out.read_bytes(), one_core)

        if "TWOFOLD" in os.environ:
            whole = Path(folder, "whole.csv")
            subprocess.run([os.environ["TWOFOLD"], "sweep", str(text), "--out", str(whole)], check=True, capture_output=True)
            must_be("the command", whole.read_bytes(), one_core)

        from dask.distributed import Client, LocalCluster

        with (
            LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, local_directory=folder) as cluster,
            Client(cluster) as client,
        ):
            out.unlink()
            executor = client.get_executor()
            must_be("Dask", sweep.map(executor, scenes_at_once=32).csv, one_core)
            sweep.write(Path(folder, "dask.csv"), executor, scenes_at_once=32)
            must_be("Dask, in a file", Path(folder, "dask.csv").read_bytes(), one_core)
    command = ", the command" if "TWOFOLD" in os.environ else ""
    print(
        f"executors: {len(sweep)} scenes, {len(one_core)} bytes: the same by one core{command}, processes (spawn, fork), {workers} MPI workers and Dask"
    )


def times(sweep: twofold.Sweep, workers: int) -> tuple[float, float]:
    """Wall-clock seconds, and processor seconds of all processes together."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    with ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("spawn")) as executor:
        # Workers import before the clock starts.
        list(executor.map(time.sleep, [0.5] * workers))
        began = time.perf_counter()
        sweep.map(executor)
        clock = time.perf_counter() - began
    now = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return clock, sum(b.ru_utime + b.ru_stime - a.ru_utime - a.ru_stime for a, b in zip(used, now, strict=True))


def ratio() -> None:
    """Two processes compared with one, alternately, so that other load affects both."""
    sweep = twofold.Sweep(toml=GRID.format(draws=int(os.environ.get("TWOFOLD_DRAWS", "200"))))
    rounds = int(os.environ.get("TWOFOLD_ROUNDS", "3"))
    taken = [(times(sweep, 1), times(sweep, 2)) for _ in range(rounds)]
    best = min(one for (one, _), _ in taken) / min(two for _, (two, _) in taken)
    each = ", ".join(f"{one:.1f} s / {two:.1f} s = {one / two:.2f}" for (one, _), (two, _) in taken)
    work = ", ".join(f"{one:.1f} s and {two:.1f} s" for (_, one), (_, two) in taken)
    load = os.getloadavg()[0]
    print(
        f"executors: {len(sweep)} scenes by one process / by two: {each}; the quickest of each: {best:.2f}; seconds of processors: {work}; load {load:.1f} on {os.cpu_count()} cores"
    )
    least = float(os.environ.get("TWOFOLD_LEAST_RATIO", "0"))
    if best < least:
        sys.exit(f"executors: two processes are {best:.2f} times one, must be at least {least}")


if __name__ == "__main__":
    main()
