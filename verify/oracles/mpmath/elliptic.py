"""Tables of elliptic integrals and functions with derivatives, by mpmath at 60 digits or more (mpmath 1.3).

    python3 verify/oracles/mpmath/elliptic.py

writes verify/data/carlson.csv and verify/data/jacobi.csv. The arguments are exact doubles. `re`, `im` stand for a
conjugate pair of arguments; the derivatives are the first three by the named variable.
"""

import os
import random

import mpmath as mp

mp.mp.dps = 60
DATA = os.path.join(os.path.dirname(__file__), "..", "..", "data")
random.seed(20)


def log_uniform(low, high):
    return 10.0 ** random.uniform(low, high)


def digits(x):
    return mp.nstr(mp.re(x), 25, min_fixed=0, max_fixed=0)


def derivatives(f, args, index):
    """f and its first three derivatives by the argument `index`, relative step 1e-15 in 60 digits."""
    def g(v):
        return mp.re(f(*[mp.mpf(a) if i != index else v for i, a in enumerate(args)]))
    x = mp.mpf(args[index])
    h = abs(x) * mp.mpf(10) ** -8 if x != 0 else mp.mpf(10) ** -8
    # Central differences with errors of relative order h^6 and rounding 1e-60 / h^3.
    f3, f2, f1, f0, g1, g2, g3 = [g(x + k * h) for k in (-3, -2, -1, 0, 1, 2, 3)]
    first = ((g1 - f1) * 45 - (g2 - f2) * 9 + (g3 - f3)) / (60 * h)
    second = ((g1 + f1) * 270 - (g2 + f2) * 27 + (g3 + f3) * 2 - 490 * f0) / (180 * h**2)
    third = (-13 * (g1 - f1) + 8 * (g2 - f2) - (g3 - f3)) / (8 * h**3)
    return f0, first, second, third


def rf_pair(x, re, im):
    return mp.elliprf(x, mp.mpc(re, im), mp.mpc(re, -im))


def rj_pair(x, re, im, p):
    return mp.elliprj(x, mp.mpc(re, im), mp.mpc(re, -im), p)


FUNCTIONS = {
    "rf": (mp.elliprf, ["x", "y", "z"]),
    "rc": (mp.elliprc, ["x", "y"]),
    "rd": (mp.elliprd, ["x", "y", "z"]),
    "rj": (mp.elliprj, ["x", "y", "z", "p"]),
    "rf_pair": (rf_pair, ["x", "re", "im"]),
    "rj_pair": (rj_pair, ["x", "re", "im", "p"]),
}


def carlson_rows():
    for name, (f, variables) in FUNCTIONS.items():
        for case in range(24):
            spread = [0.0, 1.0, 4.0, 8.0][case % 4]
            args = [log_uniform(-spread, spread) * random.uniform(0.5, 1.5) for _ in variables]
            if name.endswith("pair"):
                # The angle of the pair is up to 2.6 rad, well off the negative axis, where the integrals are singular.
                size, angle = abs(args[1]), random.uniform(0.0, 2.6)
                args[1], args[2] = float(size * mp.cos(angle)), float(size * mp.sin(angle))
            index = case % len(variables)
            yield name, variables[index], args, derivatives(f, args, index)
    # Complete integrals and the ends of the domain: values only.
    for name, args in [
        ("rf", [0.0, 1.0, 2.0]), ("rf", [0.0, 1e-12, 1.0]), ("rf", [1.0, 1.0, 1.0]), ("rf", [1e-30, 1e30, 1.0]),
        ("rd", [0.0, 2.0, 1.0]), ("rd", [1.0, 0.0, 1e-9]), ("rd", [3.0, 3.0, 3.0]),
        ("rj", [0.0, 1.0, 2.0, 3.0]), ("rj", [0.0, 1.0, 2.0, 1e-12]), ("rj", [2.0, 2.0, 2.0, 2.0]),
        ("rj", [1.0, 2.0, 3.0, 1e12]), ("rc", [0.0, 0.25]), ("rc", [1.0, 1.0]), ("rc", [1.0, 1.0 + 2.0**-40]),
        ("rf_pair", [0.0, -0.25, 1.0]), ("rf_pair", [2.0, 0.0, 1.0]), ("rf_pair", [1.0, 1.0, 2.0**-40]),
        ("rj_pair", [0.0, -0.25, 1.0, 1e-12]), ("rj_pair", [1.0, -1.0, 1.0, 2.0]), ("rj_pair", [0.0, 1.0, 1.0, 1e9]),
    ]:
        f, _ = FUNCTIONS[name]
        yield name, "", args, (f(*[mp.mpf(a) for a in args]),)


def jacobi(kind):
    return lambda u, m1: mp.ellipfun(kind, u, m=1 - m1)


def jacobi_rows():
    mp.mp.dps = 120  # 1 - m1 loses 30 of them
    complements = [1.0, 1.0 - 2.0**-53, 1.0 - 2.0**-20, 0.75, 0.5, 0.1, 1e-3, 1e-6, 1e-12, 1e-30, 1.5, 10.0, 1e4]
    for m1 in complements:
        quarter = float(mp.ellipk(1 - mp.mpf(m1)))
        for fraction in [1e-9, 0.1, 0.3, 0.5, 0.7, 0.95, 1.6, 2.9, -0.4, -3.3]:
            u = fraction * quarter
            yield u, m1, mp.ellipk(1 - mp.mpf(m1)), [derivatives(jacobi(kind), [u, m1], 1) for kind in ("sn", "cn", "dn")]


with open(os.path.join(DATA, "carlson.csv"), "w") as out:
    out.write("# Carlson's integrals by mpmath, see verify/oracles/mpmath/elliptic.py\n")
    out.write("function,variable,a,b,c,d,value,first,second,third\n")
    for name, variable, args, values in carlson_rows():
        cells = [repr(a) for a in args] + [""] * (4 - len(args))
        numbers = [digits(v) for v in values] + [""] * (4 - len(values))
        out.write(",".join([name, variable] + cells + numbers) + "\n")

with open(os.path.join(DATA, "jacobi.csv"), "w") as out:
    out.write("# Jacobi's functions and their derivatives by m1, by mpmath, see verify/oracles/mpmath/elliptic.py\n")
    out.write("u,m1,k,sn,sn_1,sn_2,cn,cn_1,cn_2,dn,dn_1,dn_2\n")
    for u, m1, quarter, functions in jacobi_rows():
        numbers = [digits(v) for f in functions for v in f[:3]]
        out.write(",".join([repr(u), repr(m1), digits(quarter)] + numbers) + "\n")
