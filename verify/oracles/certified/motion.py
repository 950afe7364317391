"""Rigorous motion of a spheroid: enclosures of n, L, e_x at any time, in ball arithmetic with as many digits as the span needs.

Equations, in the principal frame of s (all of them quadratic):

    n' = L x n / I,    L' = -2 C n x (s n),    e' = (L - k n) x e / I,    k = (I^zz - I^xx) Omega^z, constant

A step starts from a point without error, at a distance d from the motion. Its Taylor coefficients come as balls. The remainder of the
polynomial of degree p is bounded by a majorant: the norms of all coefficients are below those of y' = c y^2, y(0) = y_0, which are
y_0 (c y_0)^j, with L in units of mu >= |L|, if c >= (mu + |k|) / I and c >= 2 C S / mu; S is half the spread of s (a multiple of the
identity in s has no effect). Thus the remainder after the time h is at most y_0 r^(p+1) / (1 - r), r = c y_0 h.

The distance to the motion grows by the logarithmic norm: two motions differ by a = |dn|, b = |dL| with

    a' <= b |n| / I,    b' <= 2 C S a (|n| + |n~|)

since the part of dn' along dn vanishes; hence d = max(a, b / (I g)) grows at most as e^(g t), g = sqrt(4 C S / I), and
|de|' <= (b + |k| a + |dk|) / I. Lengths |n|, |e| of the motion are one, those of the point within 1e-9 of it (checked).
"""

import operator

from flint import arb, arb_poly, ctx, fmpq

SLACK = arb("1.000000001")
CYCLIC = ((1, 2), (2, 0), (0, 1))


def cross(a, b):
    """Vector product."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    """Scalar product."""
    return sum(map(operator.mul, a, b))


def length(v):
    """Euclidean length; a sum of squares is not negative, even where its ball is."""
    return dot(v, v).nonnegative_part().sqrt()


def upper(x):
    """An upper bound without radius."""
    return x.upper()


class Motion:
    """Follows a motion from its initial balls through increasing times."""

    def __init__(self, body, s, state, digits):
        """`body` = (I^xx, I^zz, C) and `s` = eigenvalues, exact fractions; `state` = (n, L, e), balls."""
        ctx.dps = digits + 15
        self.digits = digits
        self.i_xx, self.i_zz, self.c = (arb(x) for x in body)
        self.s = s
        half_spread = arb((max(s) - min(s)) / 2)
        n, momentum, e = state
        k = (self.i_zz - self.i_xx) * dot(momentum, n) / self.i_zz
        self.k, self.k_error = k.mid(), upper(abs(k - k.mid()))
        # |L|^2 changes by at most 2 I C times the change of n.(s n).
        self.mu = upper((dot(momentum, momentum) + 4 * self.i_xx * self.c * half_spread).sqrt()) * SLACK
        self.growth = upper((4 * self.c * half_spread / self.i_xx * SLACK**2).sqrt())
        rate = (self.mu + abs(self.k)) / self.i_xx
        self.majorant = upper(rate.max(2 * self.c * half_spread / self.mu) * SLACK**2)
        # r = 1/8, with a remainder of the polynomial of about 10^-digits.
        self.exact_step = fmpq(int((2**20 / (8 * self.majorant)).lower().floor().unique_fmpz()), 2**20)
        self.step = arb(self.exact_step)
        self.order = int(digits / 0.903) + 2
        self.time = fmpq(0)
        self.distance, self.e_error = arb(0), arb(0)
        self._restart([*n, *momentum, *e])

    def _restart(self, balls):
        """The next point: midpoints; the radii are added to the distance."""
        point = [x.mid() for x in balls]
        off = [upper(abs(x - y)) for x, y in zip(balls, point)]
        a, b, e = (upper(length(off[i : i + 3])) for i in (0, 3, 6))
        self.distance = upper(self.distance + a + b / (self.i_xx * self.growth))
        self.e_error = upper(self.e_error + e)
        self.point = point
        for i in (0, 6):
            size = length(point[i : i + 3])
            assert abs(size - 1) < arb("1e-9"), "the point has left the unit sphere"
        assert length(point[3:6]) < self.mu
        self.coefficients = self._series()

    def _series(self):
        """Taylor coefficients of the nine components from the point."""
        x = [[value] for value in self.point]
        n, momentum, e = x[0:3], x[3:6], x[6:9]
        k = self.k
        over = 1 / self.i_xx
        gaps = [-2 * self.c * arb(self.s[j] - self.s[i]) for i, j in CYCLIC]
        turning = [[momentum[i][0] - k * n[i][0]] for i in range(3)]
        mul = operator.mul

        def product(a, reversed_b):
            return sum(map(mul, a, reversed_b))

        for j in range(self.order):
            back_n, back_e = [v[::-1] for v in n], [v[::-1] for v in e]
            new = [product(momentum[p], back_n[q]) - product(momentum[q], back_n[p]) for p, q in CYCLIC]
            new += [self.i_xx * gap * product(n[p], back_n[q]) for gap, (p, q) in zip(gaps, CYCLIC)]
            new += [product(turning[p], back_e[q]) - product(turning[q], back_e[p]) for p, q in CYCLIC]
            for series, value in zip(x, new):
                series.append(value * (over / (j + 1)))
            for i in range(3):
                turning[i].append(momentum[i][-1] - k * n[i][-1])
        self._verify([arb_poly(v) for v in x], gaps)
        return x

    def _verify(self, x, gaps):
        """The polynomials satisfy the equations below their degree: a check of the recurrence by other products."""
        n, momentum, e = x[0:3], x[3:6], x[6:9]
        turning = [a - self.k * b for a, b in zip(momentum, n)]
        left_over = [self.i_xx * v.derivative() for v in x]
        right = cross(momentum, n) + [self.i_xx * g * n[p] * n[q] for g, (p, q) in zip(gaps, CYCLIC)] + cross(turning, e)
        for a, b in zip(left_over, right):
            assert all(value.contains(0) for value in (a - b).coeffs()[: self.order]), "the series does not solve the equations"

    def _values(self, h):
        """Components of the motion through the point at the time h after it, as balls."""
        r = upper(self.majorant * SLACK * abs(h))
        left_out = SLACK * r ** (self.order + 1) / (1 - r)
        out = []
        for i, series in enumerate(self.coefficients):
            value = series[-1]
            for coefficient in series[-2::-1]:
                value = value * h + coefficient
            bound = upper(left_out * self.mu if 3 <= i < 6 else left_out)
            out.append(value + arb(0, bound))
        return out

    def _grown(self, h):
        """Distances at the time h after the point."""
        d = upper(self.distance * (self.growth * abs(h)).exp())
        rate = d * (self.growth + abs(self.k) / self.i_xx) + self.k_error / self.i_xx
        return d, upper(self.e_error + abs(h) * rate * SLACK)

    def at(self, t):
        """Enclosures of n, L, e_x at the time t (a fraction or a ball), not before the last requested one."""
        while True:
            h = t - arb(self.time)
            if h <= self.step:
                break
            moved = self._values(self.step)
            self.distance, self.e_error = self._grown(self.step)
            self.time += self.exact_step
            self._restart(moved)
        values = self._values(h)
        d, e = self._grown(h)
        radii = [d] * 3 + [upper(d * self.i_xx * self.growth)] * 3 + [e] * 3
        balls = [v + arb(0, r) for v, r in zip(values, radii)]
        return balls[0:3], balls[3:6], balls[6:9]
