"""Largest errors, in ulp, of A_0, A_1, A_3, C as printed by the example `spheroid_samples`. Needs mpmath.

The values here come from the closed forms of Eq. (74) in 60 digits, which lose at most 27 of them at e = 1e-13.
"""

import math
import sys

from mpmath import asin, asinh, mp, mpf, pi, sqrt

mp.dps = 90


def coefficients(name, parameter):
    if name == "e":
        e2 = parameter**2
        q2 = 1 - e2
    else:
        q2 = parameter**2
        e2 = 1 - q2
    q = sqrt(q2)
    e = sqrt(abs(e2))
    if e == 0:
        return [mpf(2), mpf(2) / 3, mpf(2) / 3, mpf(0)]
    ratio = asin(e) / e if e2 > 0 else asinh(e) / e
    a0 = 2 * q * ratio
    a1 = q / e2 * (ratio - q)
    a3 = 2 / e2 * (1 - q * ratio)
    return [a0, a1, a3, 4 * pi**2 / 15 * q * (a1 - q2 * a3)]


worst = [(0.0, "")] * 4
for line in sys.stdin:
    name, parameter, *values = line.split()
    exact = coefficients(name, mpf(float(parameter)))
    for i, (value, true) in enumerate(zip(values, exact)):
        error = abs(mpf(float(value)) - true) / math.ulp(float(true))
        if error > worst[i][0]:
            worst[i] = (float(error), f"{name} = {parameter}")
for symbol, (error, place) in zip(["A_0", "A_1", "A_3", "C"], worst):
    print(f"{symbol}: {error:.2f} ulp at {place}")
