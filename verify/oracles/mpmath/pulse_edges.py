"""Pulse edges of tp-I and tp-II by Taylor series of order 40 in 50 digits (mpmath 1.3; quick with gmpy2).

    python3 verify/oracles/mpmath/pulse_edges.py

writes verify/data/pulse_edges.csv: for each of the two scenes the first 160 whole pulses of the beam chi = 0.5, delta = 0,
rho = 0.6, seen from theta_o = 0.8, phi_o = 0, with the time at which m.n is largest in each. The initial values are those of Eq. (34) as printed; the equations are

    dn/dt = L x n,   dL/dt = -2 n x (s n),   d e_x/dt = Omega x e_x,   Omega = L - epsilon Omega^z n      (I^xx = C = 1)

An edge is a root of m.n - cos rho of the series, by Newton's method; the largest m.n is a root of its rate. Within each step the sign of
m.n - cos rho is taken at 40 times and at each extremum between two of them, so that no short pulse is missed. The script refuses to write unless
energy, spin and the third integral are constant and n, e_x orthonormal to 1e-32, and unless the states agree with
verify/data/reference_states.csv, which another program computed, to its 22 digits.
"""

import csv
import os

import mpmath as mp

mp.mp.dps = 50
DATA = os.path.join(os.path.dirname(__file__), "..", "..", "data")
ORDER, TOLERANCE, SAMPLES, PULSES = 40, mp.mpf(10) ** -40, 40, 160
INERTIA, SPIN = mp.mpf("1.1"), mp.mpf(1)
S = [mp.mpf("0.02"), mp.mpf("0.01"), mp.mpf("-0.04")]
CHI, RHO, THETA_O = mp.mpf("0.5"), mp.mpf("0.6"), mp.mpf("0.8")
OBSERVER = [mp.sin(THETA_O), mp.mpf(0), mp.cos(THETA_O)]


def dot(a, b):
    return mp.fdot(a, b)


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def initial_state(amplitude):
    """n, L, e_x by Eq. (34) with alpha_0 = phi = pi/2, beta_0 = 0.7, and by Eqs. (9), (22)."""
    b0, omega = mp.mpf("0.7"), INERTIA * SPIN
    sin, cos = mp.sin(b0), mp.cos(b0)
    shift = (2 * S[2] - S[0] - S[1]) * cos / (INERTIA * SPIN)
    rate = omega / cos - shift
    c = (S[0] - S[1]) / (INERTIA * SPIN)
    eta_alpha = cos * (2 + cos**2) / (4 - cos**2)
    eta_beta = 3 * sin * cos**2 / (4 - cos**2)
    # sin 2 alpha_0 = cos phi = 0, cos 2 alpha_0 = -1, sin phi = 1: alpha = pi/2, gamma = 0, beta' = 0.
    beta = b0 + amplitude / omega + eta_beta * c / (2 * rate)
    alpha_rate = rate - amplitude / sin - eta_alpha * c
    sb, cb = mp.sin(beta), mp.cos(beta)
    n, e_y, e_x = [sb, 0, cb], [-cb, 0, sb], [mp.mpf(0), mp.mpf(1), mp.mpf(0)]
    across = alpha_rate * sb
    return n, [across * y + INERTIA * SPIN * z for y, z in zip(e_y, n)], e_x


def convolved_cross(a, b, k):
    """Order k of the cross product of two series, each a list of three lists of coefficients."""
    product = lambda i, j: mp.fdot(a[i][: k + 1], b[j][k::-1])
    return [product(1, 2) - product(2, 1), product(2, 0) - product(0, 2), product(0, 1) - product(1, 0)]


def series(n, l, e):
    """Coefficients of n, L, e_x up to ORDER about a state."""
    body_turn = (INERTIA - 1) * dot(l, n) / INERTIA
    n, l, e = [[x] for x in n], [[x] for x in l], [[x] for x in e]
    strained, omega = [[], [], []], [[], [], []]
    for k in range(ORDER):
        for i in range(3):
            strained[i].append(S[i] * n[i][k])
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
    return [[mp.polyval(c[::-1], h) for c in v] for v in vectors]


def integrals(n, l, e):
    adjugate = [S[1] * S[2], S[2] * S[0], S[0] * S[1]]
    energy = dot(l, l) / 2 + (1 / INERTIA - 1) * dot(l, n) ** 2 / 2 + dot(S, [x * x for x in n])
    clebsch = dot(S, [x * x for x in l]) - 2 * dot(adjugate, [x * x for x in n])
    return [energy, dot(l, n), clebsch, dot(n, n), dot(e, e), dot(n, e)]


def margin_series(n, e):
    """Coefficients of m.n - cos rho, with m = sin chi e_x + cos chi e_z."""
    c = [dot(OBSERVER, [mp.sin(CHI) * e[i][k] + mp.cos(CHI) * n[i][k] for i in range(3)]) for k in range(ORDER + 1)]
    c[0] -= mp.cos(RHO)
    return c


def newton(c, h):
    """The root of the series c near h."""
    highest_first = c[::-1]
    for _ in range(30):
        value, slope = mp.polyval(highest_first, h, derivative=True)
        h -= value / slope
        if abs(value / slope) < mp.mpf(10) ** -42:
            return h
    raise SystemExit("Newton's method does not converge")


def maxima(c, step):
    """The maxima of the series c in (0, step], in order, with their values."""
    rate = [k * x for k, x in enumerate(c)][1:]
    grid = [step * k / SAMPLES for k in range(SAMPLES + 1)]
    rates = [mp.polyval(rate[::-1], h) for h in grid]
    tops = [newton(rate, grid[k]) for k in range(SAMPLES) if rates[k] > 0 >= rates[k + 1]]
    assert all(0 < h <= step for h in tops), "a maximum outside its bracket"
    return [(h, mp.polyval(c[::-1], h)) for h in tops]


def roots(c, step):
    """The roots of the series c in (0, step], in order."""
    highest_first = c[::-1]
    rate_series = [k * x for k, x in enumerate(c)][1:]
    grid = [step * k / SAMPLES for k in range(SAMPLES + 1)]
    values = [mp.polyval(highest_first, h, derivative=True) for h in grid]
    found = []
    for k in range(SAMPLES):
        (a, da), (b, db) = values[k], values[k + 1]
        nodes = [(grid[k], a), (grid[k + 1], b)]
        if (a > 0) == (b > 0) and (da > 0) != (db > 0):
            extremum = newton(rate_series, (grid[k] + grid[k + 1]) / 2)
            nodes.insert(1, (extremum, mp.polyval(highest_first, extremum)))
        for (low, first), (high, second) in zip(nodes, nodes[1:]):
            if (first > 0) != (second > 0):
                root = newton(c, low + (high - low) * first / (first - second))
                assert low <= root <= high, "a root outside its bracket"
                found.append(root)
    return found


def pulses(name, amplitude, reference):
    state = initial_state(amplitude)
    start = integrals(*state)
    t, edges, tops, worst, compared = mp.mpf(0), [], [], mp.mpf(0), mp.mpf(0)
    inside = margin_series([[x] + [0] * ORDER for x in state[0]], [[x] + [0] * ORDER for x in state[2]])[0] > 0
    while len(edges) < 2 * PULSES + inside:
        expansion = series(*state)
        sizes = [max(abs(v[i][k]) for v in expansion for i in range(3)) for k in (ORDER - 1, ORDER)]
        step = min((TOLERANCE / size) ** (mp.mpf(1) / k) for size, k in zip(sizes, (ORDER - 1, ORDER)))
        margin = margin_series(expansion[0], expansion[2])
        edges += [t + h for h in roots(margin, step)]
        tops += [(t + h, value) for h, value in maxima(margin, step)]
        for time, expected in reference:
            if t <= time < t + step:
                ours = [x for vector in at(expansion, time - t) for x in vector]
                compared = max(compared, max(abs(a - b) for a, b in zip(ours, expected)))
        state, t = at(expansion, step), t + step
        worst = max(worst, max(abs(a - b) for a, b in zip(integrals(*state), start)))
    print(f"{name}: to t = {mp.nstr(t, 6)}, drift {mp.nstr(worst, 3)}, against the reference states {mp.nstr(compared, 3)}")
    assert worst < mp.mpf(10) ** -32 and compared < mp.mpf(10) ** -21
    whole = edges[inside:]
    largest = lambda start, end: max((value, time) for time, value in tops if start < time < end)[1]
    return [(start, end, largest(start, end)) for start, end in zip(whole[0::2], whole[1::2])][:PULSES]


def reference_states(name):
    with open(os.path.join(DATA, "reference_states.csv")) as file:
        rows = csv.reader(line for line in file if not line.startswith("#"))
        return [(mp.mpf(row[1]), [mp.mpf(x) for x in row[2:]]) for row in rows if row[0] == name]


def main():
    scenes = [(name, pulses(name, mp.mpf(a), reference_states(name))) for name, a in (("tp-1", 0), ("tp-2", "0.4"))]
    with open(os.path.join(DATA, "pulse_edges.csv"), "w") as file:
        file.write("# Whole pulses of tp-I and tp-II, chi = 0.5, delta = 0, rho = 0.6, theta_o = 0.8, phi_o = 0: roots of m.n = cos rho, and the\n")
        file.write("# largest m.n between them, along Taylor series of order 40 in 50 digits (verify/oracles/mpmath/pulse_edges.py), rounded to 22\n")
        file.write("# digits; times in t_c.\n")
        file.write("scene,start,end,closest\n")
        for name, found in scenes:
            for times in found:
                file.write(",".join([name, *(mp.nstr(time, 22) for time in times)]) + "\n")


if __name__ == "__main__":
    main()
