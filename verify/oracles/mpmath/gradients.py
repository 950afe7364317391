"""Derivatives of motions by the parameters of their scenes, by Taylor series of order 32 in 45 digits (mpmath 1.3; quick with gmpy2).

    python3 verify/oracles/mpmath/gradients.py

writes verify/data/reference_gradients.csv: for each scene, parameter and time the derivatives of n, L and e_x, as central
differences of two motions whose parameter differs by 2e-14: their error is about 1e-24. Parameters are exact doubles. The
equations are

    dn/dt = L x n / I^xx,   dL/dt = -2 C n x (s n),   d e_x/dt = Omega x e_x,   Omega = [L - (I^zz - I^xx) Omega^z n] / I^xx
"""

import os

import mpmath as mp

mp.mp.dps = 45
DATA = os.path.join(os.path.dirname(__file__), "..", "..", "data")
ORDER, TOLERANCE, H = 32, mp.mpf(10) ** -40, mp.mpf(10) ** -14
TIMES = [5, 20]
NAMES = ["i_xx", "i_zz", "c", "s_xx", "s_yy", "s_zz", "s_xy", "s_xz", "s_yz"]
NAMES += ["alpha", "beta", "gamma", "alpha_rate", "beta_rate", "gamma_rate"]
SCENES = {
    # Close to tp-II of the paper, without its symmetries.
    "twofold": [1.0, 1.1, 1.0, 0.02, 0.01, -0.04, 0.003, -0.002, 0.004, 1.5, 1.06, 0.3, 0.9, 0.05, 0.55],
    # A prolate body under strong violation.
    "strong": [1.25, 0.75, 1.5, 0.2, -0.1, 0.05, 0.0, 0.0625, 0.0, -0.4, 0.9, 1.0, 0.7, -0.3, 0.8],
}


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def initial_state(p):
    a, b, g, ra, rb, rg = p[9:]
    sa, ca, sb, cb, sg, cg = mp.sin(a), mp.cos(a), mp.sin(b), mp.cos(b), mp.sin(g), mp.cos(g)
    ex = [ca * cg - sa * cb * sg, sa * cg + ca * cb * sg, sb * sg]
    ey = [-ca * sg - sa * cb * cg, ca * cb * cg - sa * sg, sb * cg]
    ez = [sa * sb, -ca * sb, cb]
    omega = [ra * sb * sg + rb * cg, ra * sb * cg - rb * sg, ra * cb + rg]
    body = [p[0] * omega[0], p[0] * omega[1], p[1] * omega[2]]
    momentum = [sum(body[k] * axis[i] for k, axis in enumerate((ex, ey, ez))) for i in range(3)]
    return ez, momentum, ex


def series(p, state):
    i_xx, i_zz, c = p[:3]
    s = [[p[3], p[6], p[7]], [p[6], p[4], p[8]], [p[7], p[8], p[5]]]
    n, l, e = ([x] for x in state)
    spin = mp.fdot(state[0], state[1]) / i_zz
    pull, omega = [], []
    for k in range(ORDER):
        pull.append([mp.fdot(row, n[k]) for row in s])
        omega.append([(l[k][i] - (i_zz - i_xx) * spin * n[k][i]) / i_xx for i in range(3)])
        sums = [[mp.mpf(0)] * 3 for _ in range(3)]
        for j in range(k + 1):
            for which, (a, b) in enumerate(((l[j], n[k - j]), (pull[j], n[k - j]), (omega[j], e[k - j]))):
                x = cross(a, b)
                for i in range(3):
                    sums[which][i] += x[i]
        n.append([x / i_xx / (k + 1) for x in sums[0]])
        l.append([x * 2 * c / (k + 1) for x in sums[1]])
        e.append([x / (k + 1) for x in sums[2]])
    return n, l, e


def motion(p):
    state, t, states = initial_state(p), mp.mpf(0), []
    for end in TIMES:
        while t < end:
            coefficients = series(p, state)
            size = max(abs(x) for part in coefficients for x in part[ORDER] + part[ORDER - 1])
            h = min((TOLERANCE / size) ** (mp.mpf(1) / ORDER), end - t)
            state = [[mp.polyval([part[k][i] for k in range(ORDER, -1, -1)], h) for i in range(3)] for part in coefficients]
            t += h
        states.append([x for vector in state for x in vector])
    return states


def main():
    with open(os.path.join(DATA, "reference_gradients.csv"), "w") as out:
        out.write("# Derivatives of n, L and e_x by the parameter of an index, whose value is that of the scene (verify/oracles/mpmath/gradients.py).\n")
        columns = [f"{v}_{x}" for v in ("n", "l", "ex") for x in "xyz"]
        out.write("scene,index,value,t," + ",".join(columns) + "\n")
        for scene, values in SCENES.items():
            p = [mp.mpf(x) for x in values]
            for index in range(len(NAMES)):
                plus, minus = list(p), list(p)
                plus[index] += H
                minus[index] -= H
                for t, a, b in zip(TIMES, motion(plus), motion(minus)):
                    digits = [mp.nstr((x - y) / (2 * H), 20, min_fixed=0, max_fixed=0) for x, y in zip(a, b)]
                    out.write(f"{scene},{index},{values[index]!r},{t}," + ",".join(digits) + "\n")
                out.flush()


main()
