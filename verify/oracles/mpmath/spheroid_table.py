"""Computes the table of potential coefficients of uniform spheroids, `verify/data/spheroid.csv`.

Closed forms of Eqs. (74), (75) and their first and second derivatives with respect to x = e^2, evaluated with mpmath at
200 digits (the closed forms cancel like x^-3, with derivatives x^-5, and x goes down to 1e-24) and written with 34.
The sphere itself is a limit: its row comes from the Taylor coefficients of the same closed forms.

The parameter of a row is the binary64 number nearest to the decimal string `parameter`: an eccentricity e for `oblate`
rows, an axis ratio a3/a1 for `prolate` ones. Units: a1 = rho = 1, so that A_0 stands for A_0 / a1^2.

Usage: python3 spheroid_table.py > spheroid.csv
"""

from mpmath import asin, asinh, mp, mpf, nstr, pi, sqrt

mp.dps = 200

E = ["1e-12", "1e-10", "1e-8", "1e-7", "1e-6", "1e-5", "1e-4", "1e-3", "3e-3", "0.01", "0.02", "0.03", "0.05", "0.07",
     "0.1", "0.11", "0.12", "0.125", "0.13", "0.15", "0.17", "0.2", "0.22", "0.25", "0.27", "0.3", "0.32", "0.35", "0.37",
     "0.4", "0.42", "0.45", "0.47", "0.5", "0.52", "0.55", "0.57", "0.6", "0.62", "0.64", "0.66", "0.68", "0.7", "0.72",
     "0.74", "0.76", "0.78", "0.8", "0.81", "0.82", "0.83", "0.84", "0.85", "0.86", "0.87", "0.88", "0.89", "0.9", "0.91",
     "0.92", "0.93", "0.94", "0.95", "0.96", "0.97", "0.98", "0.985", "0.99", "0.993", "0.995", "0.997", "0.998", "0.999"]
Q = ["1.000000000001", "1.0000000001", "1.00000001", "1.000001", "1.00001", "1.0001", "1.001", "1.003", "1.0078", "1.01",
     "1.03", "1.05", "1.1", "1.15", "1.2", "1.3", "1.4", "1.5", "1.6", "1.8", "2", "2.2", "2.5", "2.8", "3", "3.3", "3.7",
     "4", "4.5", "5", "5.5", "6", "6.5", "7", "7.5", "8", "8.5", "9", "9.5", "10"]


def arc(x):
    return asin(sqrt(x)) / sqrt(x) if x > 0 else asinh(sqrt(-x)) / sqrt(-x)


FUNCTIONS = [
    lambda x: 2 * sqrt(1 - x) * arc(x),
    lambda x: sqrt(1 - x) / x * (arc(x) - sqrt(1 - x)),
    lambda x: 2 / x * (1 - sqrt(1 - x) * arc(x)),
    # C of Eq. (75): the bracket and its factor together.
    lambda x: 4 * pi**2 / 15 * sqrt(1 - x) * ((3 - 2 * x) * arc(x) - 3 * sqrt(1 - x)) * sqrt(1 - x) / x,
]


def jet(x):
    """Value, first and second derivative of the four functions with respect to x.

    The function f = arc(x) obeys 2 x f' = 1 / sqrt(1 - x) - f, which gives its derivatives by algebra; truncated power
    series about x carry them through the closed forms.
    """
    order = 3
    q = sqrt(1 - x)
    # series of sqrt(1 - x - h)
    r = [q, -1 / (2 * q), -1 / (8 * q**3)]
    f0 = arc(x)
    f1 = (1 / q - f0) / (2 * x)
    # derivative of (q^-1 - f) / (2 x)
    f2 = ((1 / (2 * q**3)) - f1) / (2 * x) - f1 / x
    f = [f0, f1, f2 / 2]
    inv = [1 / x, -1 / x**2, 1 / x**3]
    X = [x, mpf(1), mpf(0)]
    mul = lambda a, b: [sum(a[i] * b[n - i] for i in range(n + 1)) for n in range(order)]
    lin = lambda *terms: [sum(c * t[n] for c, t in terms) for n in range(order)]
    one = [mpf(1), mpf(0), mpf(0)]
    qf = mul(r, f)
    a0 = lin((2, qf))
    a1 = mul(mul(r, inv), lin((1, f), (-1, r)))
    a3 = mul(inv, lin((2, one), (-2, qf)))
    bracket = mul(mul(inv, r), lin((1, mul(lin((3, one), (-2, X)), f)), (-3, r)))
    c = lin((4 * pi**2 / 15, mul(r, bracket)))
    out = []
    for s, g in zip((a0, a1, a3, c), FUNCTIONS):
        assert abs(s[0] - g(x)) < mpf(10) ** -60 * abs(s[0])
        out += [s[0], s[1], 2 * s[2]]
    return out


def sphere():
    """Limits at x = 0 from series with exact rational coefficients: 2F1 of Eq. (74) expanded to second order."""
    # f = 1 + x/6 + 3 x^2/40 + 5 x^3/112 + 35 x^4/1152, q = 1 - x/2 - x^2/8 - x^3/16 - 5 x^4/128
    n = 6
    f = [mpf(1), mpf(1) / 6, mpf(3) / 40, mpf(5) / 112, mpf(35) / 1152, mpf(63) / 2816]
    q = [mpf(1), -mpf(1) / 2, -mpf(1) / 8, -mpf(1) / 16, -mpf(5) / 128, -mpf(7) / 256]
    mul = lambda a, b: [sum(a[i] * b[k - i] for i in range(k + 1)) for k in range(n)]
    qf = mul(q, f)
    a0 = [2 * t for t in qf]
    a1 = mul(q, [f[k] - q[k] for k in range(n)])[1:]
    a3 = [-2 * t for t in qf[1:]]
    inner = [3 * f[k] - (2 * f[k - 1] if k else 0) - 3 * q[k] for k in range(n)]
    c = [4 * pi**2 / 15 * t for t in mul(mul(q, q), inner)[1:]]
    out = []
    for s in (a0, a1, a3, c):
        out += [s[0], s[1], 2 * s[2]]
    return out


print("# Potential coefficients of uniform spheroids, Eqs. (74), (75), with derivatives in x = e^2; a1 = rho = 1.")
print("# Made by verify/oracles/mpmath/spheroid_table.py with mpmath 1.3.0 at 200 digits.")
names = ["A0", "A1", "A3", "C"]
print("kind,parameter," + ",".join(f"{n},{n}_x,{n}_xx" for n in names))
row = lambda kind, s, values: print(f"{kind},{s}," + ",".join(nstr(v, 34, strip_zeros=False) for v in values))
row("oblate", "0", sphere())
for s in E:
    row("oblate", s, jet(mpf(float(s)) ** 2))
for s in Q:
    row("prolate", s, jet(1 - mpf(float(s)) ** 2))
