"""Weights of the force-gradient splitting schemes of src/propagation/splitting/schemes.rs to 25 digits (mpmath 1.3).

    python3 verify/oracles/mpmath/splitting_schemes.py

Near-integrable order conditions of H = T + s V after a symmetric step of length one, kicks of weight b_i and gradient c_i at times
tau_i about the middle of the step. With A_m = ad_T^m V / m! the exact flow in the interaction picture is the time-ordered exponential
of sum_m tau^m A_m, so that

    one factor s:    sum_i b_i tau_i^2k = 1 / ((2k+1) 4^k),                                               order 2k+2
    two factors s:   [A_m, A_n]:  sum_(i<j) b_i b_j (tau_i^m tau_j^n - tau_i^n tau_j^m) + 2 (n-m) sum_i c_i tau_i^(m+n-1)
                                  = the same integral over -1/2 < tau_1 < tau_2 < 1/2,   m + n = 1, 3, 5, order m+n+3
    three factors:   one condition in degree five, since {V,{V,{T,V}}} = 0. If the others hold, that of the harmonic oscillator
                     suffices, whose half trace is cos sqrt(z): coefficient of z^3 equal to -1/720.

The solutions come from least squares with random starts and are refined here by Newton's method in 60 digits.
"""

import mpmath as mp

mp.mp.dps = 60
HALF = mp.mpf(1) / 2


def power_integral(k):
    return (HALF ** (k + 1) - (-HALF) ** (k + 1)) / (k + 1)


def ordered_integral(m, n):
    """Integral of t1^m t2^n over -1/2 < t1 < t2 < 1/2."""
    return (power_integral(n + m + 1) - (-HALF) ** (m + 1) * power_integral(n)) / (m + 1)


def conditions(rotations, kicks, gradients, kicks_first, one, two, three):
    """Residuals: `one` conditions with one factor s, the pairs (m, n) of `two`, and the condition with three factors if requested."""
    times, now = [], -HALF
    for index in range(len(kicks)):
        if not (kicks_first and index == 0):
            now += rotations[index - 1 if kicks_first else index]
        times.append(now)
    residuals = [
        mp.fsum(b * t ** (2 * k) for b, t in zip(kicks, times)) - mp.mpf(1) / ((2 * k + 1) * 4**k) for k in range(1, one + 1)
    ]
    for m, n in two:
        total, sum_m, sum_n = mp.mpf(0), mp.mpf(0), mp.mpf(0)
        for b, c, t in zip(kicks, gradients, times):
            total += b * t**n * sum_m - b * t**m * sum_n + 2 * (n - m) * c * t ** (m + n - 1)
            sum_m += b * t**m
            sum_n += b * t**n
        residuals.append(total - ordered_integral(m, n) + ordered_integral(n, m))
    if three:
        residuals.append(half_trace(rotations, kicks, gradients, kicks_first)[3] + mp.mpf(1) / 720)
    return residuals


def half_trace(rotations, kicks, gradients, kicks_first):
    """Coefficients of 1, z, z^2, z^3 in the half trace of the step for T = p^2/2, V = z q^2/2."""
    zero, unit = [mp.mpf(0)] * 4, [mp.mpf(1)] + [mp.mpf(0)] * 3
    q, p = [unit, zero], [zero, unit]

    def turn(weight):
        for k in range(2):
            q[k] = [x + weight * y for x, y in zip(q[k], p[k])]

    def kick(b, c):
        for k in range(2):
            shifted = [mp.mpf(0)] + q[k][:-1]
            twice = [mp.mpf(0)] * 2 + q[k][:-2]
            p[k] = [x - b * y + 2 * c * z for x, y, z in zip(p[k], shifted, twice)]

    for index, (b, c) in enumerate(zip(kicks, gradients)):
        if not (kicks_first and index == 0):
            turn(rotations[index - 1 if kicks_first else index])
        kick(b, c)
    if not kicks_first:
        turn(rotations[-1])
    return [(x + y) / 2 for x, y in zip(q[0], p[1])]


def mirrored(half, odd):
    return half + half[::-1][1 if odd else 0 :]


def eight_six_four(a1, a2, b1, b2, c2, c3):
    """Five rotations, kicks at both ends, the outer ones without gradient."""
    return (
        mirrored([a1, a2, 1 - 2 * (a1 + a2)], True),
        mirrored([b1, b2, HALF - b1 - b2], False),
        mirrored([mp.mpf(0), c2, c3], False),
        True,
    )


def eight_six_six(a1, b1, b2, b3, c2, c3, c4):
    """Six rotations, kicks at both ends, the outer ones without gradient; a2 = 0.403 nearly minimises the next error."""
    a2 = mp.mpf("0.403")
    return (
        mirrored([a1, a2, HALF - a1 - a2], False),
        mirrored([b1, b2, b3, 1 - 2 * (b1 + b2 + b3)], True),
        mirrored([mp.mpf(0), c2, c3, c4], True),
        True,
    )


def eight_eight_six(a1, a2, a3, a4, b1, b2, b3, c2, c3, c4):
    """Eight kicks, rotations at both ends, the outer kicks without gradient."""
    return (
        mirrored([a1, a2, a3, a4, 1 - 2 * (a1 + a2 + a3 + a4)], True),
        mirrored([b1, b2, b3, HALF - b1 - b2 - b3], False),
        mirrored([mp.mpf(0), c2, c3, c4], False),
        False,
    )


PAIRS = [(0, 1), (0, 3), (1, 2), (0, 5), (1, 4), (2, 3)]
TASKS = [
    ("(8,6,4)", eight_six_four, PAIRS[:3], False, "0.1687 0.3779 0.0491 0.2642 0.00079 0.00212"),
    ("(8,6,6)", eight_six_six, PAIRS[:3], True, "0.16905 0.04918 0.26463 0.07475 0.00094 -0.00133 0.00659"),
    (
        "(8,8,6)",
        eight_eight_six,
        PAIRS,
        True,
        "0.0684136 0.2582257 0.4536249 -0.007132 0.1697363 0.3504179 0.2590725 0.0022 0.0104 -0.011",
    ),
]

if __name__ == "__main__":
    for name, build, two, three, start in TASKS:
        guess = [mp.mpf(x) for x in start.split()]
        solution = mp.findroot(lambda *x: conditions(*build(*x), 3, two, three), guess, tol=1e-90, maxsteps=60)
        residual = max(abs(r) for r in conditions(*build(*solution), 3, two, three))
        print(name, "residual", mp.nstr(residual, 3))
        rotations, kicks, gradients, _ = build(*solution)
        for label, weights in [("rotations", rotations), ("kicks", kicks), ("gradients", gradients)]:
            print(" ", label, ", ".join(mp.nstr(w, 25) for w in weights[: (len(weights) + 1) // 2]))
