"""n and L of tp-II after 1000 t_c by Taylor series of order 44 in 45 digits (mpmath 1.3).

    python3 verify/oracles/mpmath/axis_end_state.py

writes verify/data/axis_end_state.csv. The initial state is that of verify/data/reference_states.csv, 22 digits, taken as exact. The
script refuses to write unless n.n, L.n and the energy are constant to 1e-35 and the state at 400 t_c agrees with that table to 1e-18.
"""

import csv
import os

import mpmath as mp

mp.mp.dps = 45
DATA = os.path.join(os.path.dirname(__file__), "..", "..", "data")
ORDER, STEP, END = 44, mp.mpf("0.125"), 1000
S = [mp.mpf("0.02"), mp.mpf("0.01"), mp.mpf("-0.04")]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def convolved(a, b, k):
    """Sum of a_j x b_(k-j)."""
    total = [mp.mpf(0)] * 3
    for i in range(3):
        j, m = (i + 1) % 3, (i + 2) % 3
        total[i] = mp.fdot([a[q][j] for q in range(k + 1)], [b[k - q][m] for q in range(k + 1)]) - mp.fdot(
            [a[q][m] for q in range(k + 1)], [b[k - q][j] for q in range(k + 1)]
        )
    return total


def step(n, l, h):
    ns, ls, pulled = [n], [l], []
    for k in range(ORDER):
        pulled.append([s * x for s, x in zip(S, ns[k])])
        turn, torque = convolved(ls, ns, k), convolved(pulled, ns, k)
        ns.append([x / (k + 1) for x in turn])
        ls.append([2 * x / (k + 1) for x in torque])
    at = lambda series, i: mp.polyval([c[i] for c in reversed(series)], h)
    return [at(ns, i) for i in range(3)], [at(ls, i) for i in range(3)]


def invariants(n, l):
    return mp.fdot(n, n), mp.fdot(n, l), mp.fdot(l, l) / 2 + mp.fsum(s * x * x for s, x in zip(S, n))


if __name__ == "__main__":
    with open(os.path.join(DATA, "reference_states.csv")) as file:
        rows = [r for r in csv.reader(line for line in file if not line.startswith("#")) if r[0] == "tp-2"]
    table = {float(r[1]): [mp.mpf(x) for x in r[2:8]] for r in rows}
    n, l = table[0.0][:3], table[0.0][3:]
    before = invariants(n, l)
    for index in range(int(END / STEP)):
        n, l = step(n, l, STEP)
        if (index + 1) * STEP == 400:
            assert max(abs(x - y) for x, y in zip(n + l, table[400.0])) < mp.mpf(10) ** -18
    assert max(abs(x - y) for x, y in zip(before, invariants(n, l))) < mp.mpf(10) ** -35
    with open(os.path.join(DATA, "axis_end_state.csv"), "w") as file:
        file.write("# n and L of tp-II after 1000 t_c, by verify/oracles/mpmath/axis_end_state.py.\n")
        file.write("scene,t,n_x,n_y,n_z,l_x,l_y,l_z\n")
        file.write("tp-2,1000," + ",".join(mp.nstr(x, 32) for x in n + l) + "\n")
