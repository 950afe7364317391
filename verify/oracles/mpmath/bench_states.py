"""Reference motions for the work-precision tables: seven scenes, Taylor series of order 44 in 50 digits (mpmath 1.3, gmpy2).

    python3 verify/oracles/mpmath/bench_states.py

writes tools/bench/data/scenes.csv, the exact initial values, and tools/bench/data/states.csv, n, L and e_x at t = 10, 100
and 1000 t_c in 30 digits. Every number of a scene is a double with all its digits, so that a program that reads it has the
same scene to the last bit. The equations are (I^xx = C = 1)

    dn/dt = L x n,   dL/dt = -2 n x (s n),   d e_x/dt = Omega x e_x,   Omega = L - (1 - 1/I^zz) (L.n) n

n and e_x are doubles, so that |n| = 1 and n.e_x = 0 hold only to 1e-16; the equations are integrated with this |n|.
Scenes:

    tp-I, tp-II, sp-I, sp-II   the initial states of the paper's examples, rounded to doubles
    nearly-free                tp-II with s times 2.5e-5: s ~ 1e-6
    nearly-separatrix          tp-II rotated so that L is 1e-4 rad from the middle eigenvector (Y) of s, equally towards X and Z:
                               the averaged motion of L/|L| starts at that distance from the saddle of l.(s l)
    strongly-violated          s = (0.3, 0.1, -0.4), otherwise the initial state of tp-II

It refuses to write unless the integrals (energy, L.n, K, n.n, e_x.e_x, n.e_x) are constant to 1e-40, and unless a second run with
another order (40) and smaller steps agrees to 1e-36.
"""

import os
import sys
from multiprocessing import Pool

import gmpy2
from gmpy2 import mpfr

gmpy2.get_context().precision = 180
DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "data")
OUT = os.path.join(DATA, "..", "..", "tools", "bench", "data")
TIMES = [10, 100, 1000]


def dot(a, b):
    return sum((x * y for x, y in zip(a, b)), mpfr(0))


def convolved_cross(a, b, k):
    """Order k of the cross product of two series, each a list of three lists of coefficients."""

    def product(i, j):
        return dot(a[i][: k + 1], b[j][k::-1])

    return [product(1, 2) - product(2, 1), product(2, 0) - product(0, 2), product(0, 1) - product(1, 0)]


def series(inertia, s, n, l, e, order):
    """Coefficients of n, L, e_x up to `order` about a state."""
    body_turn = (inertia - 1) * dot(l, n) / inertia
    n, l, e = [[x] for x in n], [[x] for x in l], [[x] for x in e]
    strained, omega = [[], [], []], [[], [], []]
    for k in range(order):
        for i in range(3):
            strained[i].append(s[i] * n[i][k])
            omega[i].append(l[i][k] - body_turn * n[i][k])
        for vector, change, factor in (
            (n, convolved_cross(l, n, k), 1),
            (l, convolved_cross(strained, n, k), 2),
            (e, convolved_cross(omega, e, k), 1),
        ):
            for i in range(3):
                vector[i].append(change[i] * factor / (k + 1))
    return n, l, e


def at(vectors, h):
    def value(coefficients):
        sum_ = mpfr(0)
        for c in reversed(coefficients):
            sum_ = sum_ * h + c
        return sum_

    return [[value(c) for c in v] for v in vectors]


def integrals(inertia, s, n, l, e):
    adjugate = [s[1] * s[2], s[2] * s[0], s[0] * s[1]]
    energy = dot(l, l) / 2 + (1 / inertia - 1) * dot(l, n) ** 2 / 2 + dot(s, [x * x for x in n])
    clebsch = dot(s, [x * x for x in l]) - 2 * dot(adjugate, [x * x for x in n])
    return [energy, dot(l, n), clebsch, dot(n, n), dot(e, e), dot(n, e)]


def motion(inertia, s, n, l, e, order, tolerance):
    """States at TIMES, and the largest change of an integral."""
    state, t, states = (n, l, e), mpfr(0), []
    start, drift = integrals(inertia, s, *state), mpfr(0)
    for target in TIMES:
        while t < target:
            expansion = series(inertia, s, *state, order)
            sizes = [max(abs(v[i][k]) for v in expansion for i in range(3)) for k in (order - 1, order)]
            step = min((tolerance / size) ** (mpfr(1) / k) for size, k in zip(sizes, (order - 1, order)))
            step = min(step, target - t)
            state, t = at(expansion, step), t + step
        drift = max([drift, *(abs(a - b) for a, b in zip(integrals(inertia, s, *state), start))])
        states.append(state)
    return states, drift


def normalised(v):
    v = [mpfr(x) for x in v]
    return [x / gmpy2.sqrt(dot(v, v)) for x in v]


def turn(a, b, v):
    """`v` under the shortest rotation that takes the unit vector `a` to the unit vector `b`."""
    middle = [x + y for x, y in zip(a, b)]
    along = dot(middle, v) / (1 + dot(a, b))
    return [x - m * along + 2 * y * dot(a, v) for x, m, y in zip(v, middle, b)]


def scenes():
    """Name, I^zz / I^xx, s and n, L, e_x in doubles."""
    paper = {"tp-I": "tp-1", "tp-II": "tp-2", "sp-I": "sp-1", "sp-II": "sp-2"}
    with open(os.path.join(DATA, "reference_states.csv")) as file:
        rows = [line.strip().split(",") for line in file if not line.startswith("#")]
    first = {row[0]: [float(x) for x in row[2:]] for row in rows[1:] if float(row[1]) == 0}
    s = [0.02, 0.01, -0.04]
    found = [(name, 1.1, s, *(first[key][i : i + 3] for i in (0, 3, 6))) for name, key in paper.items()]
    n, l, e = (first["tp-2"][i : i + 3] for i in (0, 3, 6))
    found.append(("nearly-free", 1.1, [x * 2.5e-5 for x in s], n, l, e))
    # The eigenvalues -0.04, 0.01, 0.02 belong to Z, Y, X: the middle one to Y.
    target = normalised([mpfr(1e-4) / gmpy2.sqrt(mpfr(2)), mpfr(1), mpfr(1e-4) / gmpy2.sqrt(mpfr(2))])
    turned = [turn(normalised(l), target, v) for v in (n, l, e)]
    found.append(("nearly-separatrix", 1.1, s, *([float(x) for x in v] for v in turned)))
    found.append(("strongly-violated", 1.1, [0.3, 0.1, -0.4], n, l, e))
    return found


def reference(scene):
    name, inertia, s, *vectors = scene
    exact = mpfr(inertia), [mpfr(x) for x in s], *([mpfr(x) for x in v] for v in vectors)
    states, drift = motion(*exact, 44, mpfr(10) ** -46)
    again, _ = motion(*exact, 40, mpfr(10) ** -47)
    pairs = zip((x for state in states for v in state for x in v), (x for state in again for v in state for x in v))
    difference = max(abs(a - b) for a, b in pairs)
    print(f"{name}: drift {float(drift):.1e}, difference of the two runs {float(difference):.1e}", flush=True)
    if not (drift < mpfr(10) ** -40 and difference < mpfr(10) ** -36):
        sys.exit(f"{name}: not accurate enough")
    return name, states


def main():
    found = scenes()
    with Pool(os.cpu_count()) as pool:
        references = pool.map(reference, found, chunksize=1)
    components = [f"{v}_{i}" for v in ("n", "l", "ex") for i in "xyz"]
    with open(os.path.join(OUT, "scenes.csv"), "w") as file:
        file.write("# Initial values of the reference motions in states.csv, doubles written out in full; I^xx = C = 1, L in I^xx/t_c.\n")
        file.write("scene,inertia_ratio,s_xx,s_yy,s_zz," + ",".join(components) + "\n")
        for name, inertia, s, n, l, e in found:
            file.write(",".join([name, *(repr(float(x)) for x in [inertia, *s, *n, *l, *e])]) + "\n")
    with open(os.path.join(OUT, "states.csv"), "w") as file:
        file.write("# Motions of scenes.csv by Taylor series of order 44 in 54 digits (verify/oracles/mpmath/bench_states.py), 30 digits; t in t_c.\n")
        file.write("scene,t," + ",".join(components) + "\n")
        for name, states in references:
            for t, state in zip(TIMES, states):
                file.write(",".join([name, str(t), *(format(x, ".29e") for v in state for x in v)]) + "\n")


if __name__ == "__main__":
    main()
