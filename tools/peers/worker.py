"""heyoka and SciPy on the scenes of `twofold bench`, by the protocol of README.md beside this file.

heyoka's integrators are compiled once for each tolerance, with s as parameters of the compiled function, and set back to the start
for every run; compiling is reported and not part of the time of a run.
"""

import math
import sys
import time

import heyoka as hy
import numpy as np
from scipy.integrate import solve_ivp

from scenes import LONG, read_scenes

DURATION = 1000.0
SAMPLES = 10_000
TOLERANCES = "1e-4 1e-5 1e-6 1e-7 1e-8 1e-9 1e-10 1e-11 1e-12 1e-13 1e-14 1e-15 2.3e-16"
SETTINGS = {
    "SciPy DOP853": "1e-3 1e-4 1e-5 1e-6 1e-7 1e-8 1e-9 1e-10 1e-11 1e-12 1e-13",
    ("heyoka", "long"): "1e-11 1e-12 1e-13 1e-14 1e-15 2.3e-16",
    "heyoka, 80 bits": "1e-15 1e-16 1e-17",
}
CHI, RHO, THETA_O = 0.5, 0.6, 0.8


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def equations(with_e_x):
    """dn/dt = L x n, dL/dt = -2 n x (s n), d e_x/dt = Omega x e_x; par[0..2] = 2 s, par[3] = 1 - 1/I^zz."""
    n, l, e = ([hy.make_vars(f"{v}_{i}") for i in "xyz"] for v in "nle")
    turned, pulled = cross(l, n), cross([hy.par[i] * n[i] for i in range(3)], n)
    system = [*zip(n, turned), *zip(l, pulled)]
    if with_e_x:
        turn = hy.par[3] * hy.sum([l[i] * n[i] for i in range(3)])
        system += zip(e, cross([l[i] - turn * n[i] for i in range(3)], e))
    return system, n, e


def heyoka(tolerance, task, high_accuracy):
    system, n, e = equations(task in ("n L e_x", "pulses"))
    events, times = [], []
    if task == "pulses":
        observer = [math.sin(THETA_O), 0.0, math.cos(THETA_O)]
        m_n = hy.sum([observer[i] * (math.sin(CHI) * e[i] + math.cos(CHI) * n[i]) for i in (0, 2)])
        events = [hy.nt_event(m_n - math.cos(RHO), lambda ta, t, sign: times.append(t))]
    options = {"tol": tolerance, "high_accuracy": high_accuracy, "compact_mode": False}
    size = len(system)
    ta = hy.taylor_adaptive(system, [0.0] * size, pars=[0.0] * (3 if size == 6 else 4), nt_events=events, **options)

    def run(scene):
        times.clear()
        ta.time = 0.0
        ta.state[:] = scene.start[:size]
        ta.pars[:] = [*(2 * s for s in scene.s), 1 - 1 / scene.inertia][: len(ta.pars)]
        start = time.thread_time_ns()
        steps = ta.propagate_until(DURATION)[3]
        return time.thread_time_ns() - start, steps, steps * ta.order, ta.state

    return run


def heyoka_sampled(tolerance, number):
    """Of numbers of 64 or 80 bits."""
    system, *_ = equations(False)
    zeros = np.zeros(6, dtype=number)
    options = {"tol": number(tolerance), "compact_mode": False, "fp_type": number}
    ta = hy.taylor_adaptive(system, zeros, pars=zeros[:3], **options)
    times = (np.arange(SAMPLES + 1) * (LONG / SAMPLES)).astype(number)

    def run(scene):
        ta.time = number(0.0)
        ta.state[:] = scene.start[:6]
        ta.pars[:] = [2 * s for s in scene.s]
        start = time.thread_time_ns()
        # Faster than continuous output, which keeps every step.
        *_, steps, _, states = ta.propagate_grid(times)
        return time.thread_time_ns() - start, steps, steps * ta.order, states[-1]

    return run


def heyoka_batch(tolerance, lanes, high_accuracy):
    system, *_ = equations(False)
    options = {"tol": tolerance, "high_accuracy": high_accuracy, "compact_mode": False}
    ta = hy.taylor_adaptive_batch(system, np.zeros((6, lanes)), pars=np.zeros((3, lanes)), **options)

    def run(scene):
        ta.set_time(0.0)
        for lane in range(lanes):
            ta.state[:, lane] = scene.start[:6]
            ta.pars[:3, lane] = [2 * s * (1 + 1e-4 * lane) for s in scene.s]
        start = time.thread_time_ns()
        ta.propagate_until(DURATION)
        elapsed = time.thread_time_ns() - start
        steps = max(result[3] for result in ta.propagate_res)
        return elapsed / lanes, steps, steps * ta.order, ta.state[:, 0]

    return run


def scipy(tolerance, task):
    def run(scene):
        sx, sy, sz = (2 * s for s in scene.s)
        oblateness = 1 - 1 / scene.inertia

        # Plain numbers: for six components they are faster than arrays.
        def axis(t, y):
            a, b, c, p, q, r = y.tolist()
            return (q * c - r * b, r * a - p * c, p * b - q * a, (sy - sz) * b * c, (sz - sx) * c * a, (sx - sy) * a * b)

        def orientation(t, y):
            a, b, c, p, q, r, x, y_, z = y.tolist()
            turn = oblateness * (a * p + b * q + c * r)
            u, v, w = p - turn * a, q - turn * b, r - turn * c
            return (
                q * c - r * b, r * a - p * c, p * b - q * a, (sy - sz) * b * c, (sz - sx) * c * a, (sx - sy) * a * b,
                v * z - w * y_, w * x - u * z, u * y_ - v * x,
            )  # fmt: skip

        rates, size = (axis, 6) if task == "n L" else (orientation, 9)
        start = time.thread_time_ns()
        found = solve_ivp(rates, (0, DURATION), scene.start[:size], method="DOP853", rtol=tolerance, atol=tolerance)
        return time.thread_time_ns() - start, len(found.t) - 1, found.nfev, found.y[:, -1]

    return run


def makers():
    """For each name and task: what makes a runner of a tolerance."""
    found = {}
    for high in (False, True):
        name = "heyoka, high accuracy" if high else "heyoka"
        for task in ("n L", "n L e_x", "pulses"):
            found[name, task] = lambda tol, task=task, high=high: heyoka(tol, task, high)
    for lanes in (4, 8):
        found[f"heyoka, batch of {lanes}", "many scenes"] = lambda tol, lanes=lanes: heyoka_batch(tol, lanes, False)
    found["heyoka", "long"] = lambda tol: heyoka_sampled(tol, float)
    found["heyoka, 80 bits", "long"] = lambda tol: heyoka_sampled(tol, np.longdouble)
    for task in ("n L", "n L e_x"):
        found["SciPy DOP853", task] = lambda tol, task=task: scipy(tol, task)
    return found


def main():
    scenes, methods, made = {scene.name: scene for scene in read_scenes()}, makers(), {}
    for line in sys.stdin:
        words = line.rstrip("\n").split("\t")
        if words == ["methods"]:
            for name, task in methods:
                print(name, task, SETTINGS.get((name, task)) or SETTINGS.get(name, TOLERANCES), sep="\t")
            print(flush=True)
            continue
        _, name, task, scene, setting, repeats = words
        key = name, task, setting
        if key not in made:
            start = time.perf_counter()
            run = methods[name, task](float(setting))
            made[key] = run, time.perf_counter() - start
        run, set_up = made[key]
        results = [run(scenes[scene]) for _ in range(int(repeats))]
        _, steps, evaluations, state = results[-1]
        times = " ".join(f"{result[0] * 1e-9:e}" for result in results)
        print(times, steps, evaluations, f"{set_up:e}", " ".join(float(x).hex() for x in state), sep="\t", flush=True)


if __name__ == "__main__":
    main()
