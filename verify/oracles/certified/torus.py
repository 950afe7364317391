"""The invariant torus of a motion from closed paths, which give mean rates over infinite time.

H and K = L.(s L) - 2 C I n.(adj(s) n) commute, so that n and L lie on a torus on which the flows of H and K are translations. A function
F = t H + k K has the flow

    n' = (p L) x n,    L' = (p L) x L + (q n) x n,    u' = (p L) x u,    p = t / I + 2 k s,    q = 2 C t s - 4 C I k adj(s)

(p, q diagonal), u any vector carried along. A pair (t, k) whose flow returns after the time one is a closed path. With two of them, and
(1, 0) = tau_1 (t_1, k_1) + tau_2 (t_2, k_2), an angle of the state that changes by A_i along the path i has the mean rate
tau_1 A_1 + tau_2 A_2 for ever: the remainder is a bounded function on the torus. The star turns about n by Omega^z - L.n / I more than u.

The result is rigorous:

- the flow is a Taylor series as in `motion`, with the majorant y' = c y^2: |n|, |u| are one, |L| <= mu as H is conserved, so that
  c >= |p| mu for n, u and c >= P mu + Q / mu for L / mu; |p| is the largest, P and Q half the spread of p and q (a multiple of the identity
  in either has no effect on L);
- two motions differ by a = |dn|, b = |dL| with a' <= |p| b and b' <= 2 P mu b + 2 Q a, so that max(a, b / w) grows at most as e^(g t),
  g = max(|p| w, 2 P mu + 2 Q / w); |du|' <= |p| b;
- a path closes: its end y is in a small box D about the start x, and has the same n.n, L.n, H, K. For (dt, dk) from Newton's operator on
  two components of (n, L), whose rates by H and K have no vanishing determinant in D, the flow leads from y to a point with the
  components of x, within D. The two components and the four integrals have no vanishing Jacobian in D, so that they are one to one
  there, and that point is x;
- angles are followed without jumps: alpha and gamma change at no more than 2 |p L| / sin^2 b.
"""

import operator

from flint import arb, arb_mat, arb_poly, ctx

from motion import CYCLIC, SLACK, cross, dot, length, upper

# Places per step at which angles are followed.
LOOKS = 16


class Star:
    """Moments of inertia, C, s, and the bound mu of |L| on the torus of a state (n, L, e)."""

    def __init__(self, body, s, state):
        self.i_xx, self.i_zz, self.c = (arb(x) for x in body)
        self.s = [arb(x) for x in s]
        self.adjugate = [self.s[i] * self.s[j] for i, j in ((1, 2), (2, 0), (0, 1))]
        n, momentum, _ = state
        spread = max(self.s, key=lambda x: x.mid()) - min(self.s, key=lambda x: x.mid())
        self.mu = upper((dot(momentum, momentum) + 2 * self.i_xx * self.c * spread).sqrt()) * SLACK

    def tensors(self, t, k):
        """p and q of t H + k K."""
        p = [t / self.i_xx + 2 * k * s for s in self.s]
        q = [2 * self.c * t * s - 4 * self.c * self.i_xx * k * a for s, a in zip(self.s, self.adjugate)]
        return p, q

    def rates(self, t, k, n, momentum):
        """n' and L' of t H + k K."""
        p, q = self.tensors(t, k)
        turning = [a * b for a, b in zip(p, momentum)]
        torque = cross([a * b for a, b in zip(q, n)], n)
        return [*cross(turning, n), *(a + b for a, b in zip(cross(turning, momentum), torque))]

    def integrals(self, n, momentum):
        """Gradients of n.n, L.n, H, K by n and L, halves of the squares."""
        zero = [arb(0)] * 3
        by_h = [2 * self.c * s * x for s, x in zip(self.s, n)], [x / self.i_xx for x in momentum]
        by_k = [-4 * self.c * self.i_xx * a * x for a, x in zip(self.adjugate, n)], [2 * s * x for s, x in zip(self.s, momentum)]
        return [[*a, *b] for a, b in ((n, zero), (momentum, n), by_h, by_k)]


class Flow:
    """The flow of t H + k K (numbers without radius) from a state of balls, over the time one."""

    def __init__(self, star, t, k, state, digits):
        self.star = star
        p, q = star.tensors(t, k)
        self.p, self.q = p, q
        half = lambda values: upper(max(abs(a - b) for a in values for b in values) / 2)
        self.turning = upper(max(abs(x) for x in p))
        of_p, of_q = half(p), half(q)
        mu = star.mu
        self.majorant = upper((self.turning * mu).max(of_p * mu + of_q / mu) * SLACK**2)
        self.weight = (2 * of_q / self.turning).sqrt().mid().max(arb("0.01"))
        self.growth = upper((self.turning * self.weight).max(2 * of_p * mu + 2 * of_q / self.weight) * SLACK**2)
        self.order = int(digits / 0.903) + 2
        self.state = state

    def series(self, point):
        """Taylor coefficients of n, L, u from a point."""
        x = [[value] for value in point]
        n, momentum, u = x[0:3], x[3:6], x[6:9]
        turning = [[a * m[0]] for a, m in zip(self.p, momentum)]
        gaps_p = [self.p[i] - self.p[j] for i, j in CYCLIC]
        gaps_q = [self.q[i] - self.q[j] for i, j in CYCLIC]
        product = lambda a, b: sum(map(operator.mul, a, b))
        for j in range(self.order):
            back_n, back_u, back_m = ([v[::-1] for v in w] for w in (n, u, momentum))
            new = [product(turning[a], back_n[b]) - product(turning[b], back_n[a]) for a, b in CYCLIC]
            new += [
                g * product(momentum[a], back_m[b]) + f * product(n[a], back_n[b])
                for g, f, (a, b) in zip(gaps_p, gaps_q, CYCLIC)
            ]
            new += [product(turning[a], back_u[b]) - product(turning[b], back_u[a]) for a, b in CYCLIC]
            for values, value in zip(x, new):
                values.append(value / (j + 1))
            for i in range(3):
                turning[i].append(self.p[i] * momentum[i][-1])
        self.verify([arb_poly(values) for values in x])
        return x

    def verify(self, x):
        """The polynomials satisfy the equations below their degree: a check of the recurrence by other products."""
        n, momentum, u = x[0:3], x[3:6], x[6:9]
        turning = [a * b for a, b in zip(momentum, self.p)]
        torque = cross([a * b for a, b in zip(n, self.q)], n)
        right = cross(turning, n) + [a + b for a, b in zip(cross(turning, momentum), torque)] + cross(turning, u)
        for a, b in zip(x, right):
            left = (a.derivative() - b).coeffs()[: self.order]
            assert all(value.contains(0) for value in left), "the series does not solve the equations"

    def steps(self, looks=1, at_least=1):
        """States at equal parts of the time one, and their number: steps required by the majorant, each with some samples."""
        number = max(int(float(upper(8 * self.majorant * SLACK).mid())) + 1, at_least)
        h = arb(1) / number
        balls = [x for vector in self.state for x in vector]
        distance, off_u = arb(0), arb(0)
        for step in range(number):
            point = [x.mid() for x in balls]
            a, b, e = (upper(length([upper(abs(x - y)) for x, y in zip(balls[i : i + 3], point[i : i + 3])])) for i in (0, 3, 6))
            distance, off_u = upper(distance + a + b / self.weight), upper(off_u + e)
            for i in (0, 6):
                assert abs(length(point[i : i + 3]) - 1) < arb("1e-9")
            assert length(point[3:6]) < self.star.mu
            coefficients = self.series(point)
            r = upper(self.majorant * SLACK * h)
            left = upper(SLACK * r ** (self.order + 1) / (1 - r))
            for i in range(1, looks + 1):
                look, balls = h * i / looks, []
                for place, values in enumerate(coefficients):
                    value = values[-1]
                    for coefficient in values[-2::-1]:
                        value = value * look + coefficient
                    balls.append(value + arb(0, upper(left * self.star.mu) if 3 <= place < 6 else left))
                d = upper(distance * (self.growth * look).exp())
                u = upper(off_u + self.turning * self.weight * d * look * SLACK)
                radii = [d] * 3 + [upper(d * self.weight)] * 3 + [u] * 3
                full = [x + arb(0, y) for x, y in zip(balls, radii)]
                yield number * looks, (full[0:3], full[3:6], full[6:9])
            distance, off_u = d, u


def euler(n, u):
    """alpha, gamma of the axes n and u = e_x."""
    across = cross(n, u)
    return arb.atan2(n[0], -n[1]), arb.atan2(u[2], across[2])


class Way:
    """A closed path from a state, near (t, k)."""

    def __init__(self, star, state, t, k, digits):
        self.star, self.digits = star, digits
        self.start = [*state[0], *state[1]]
        t, k = arb(t), arb(k)
        for attempt in range(12):
            end = self._end(state, t, k)
            dt, dk, radius = self._closing(end)
            t, k = (t + dt).mid(), (k + dk).mid()
            if radius is not None and abs(dt) < arb(10) ** (-digits // 2) and abs(dk) < arb(10) ** (-digits // 2):
                break
        end = self._end(state, t, k, follow=True)
        dt, dk, radius = self._closing(end)
        assert radius is not None, "not closed"
        self.t, self.k = t + dt, k + dk
        self.exact = t, k
        # Over the remaining part of the path, angles change by no more than this.
        turning = self.star.tensors(abs(dt), abs(dk))[0]
        sine2 = state[0][0] ** 2 + state[0][1] ** 2
        rest = upper(2 * self.star.mu * sum(abs(x) for x in turning) / sine2 * 2)
        self.alpha = self.alpha + arb(0, rest)
        self.gamma = self.gamma + arb(0, rest)
        turns = self.alpha / (2 * arb.pi())
        self.turns = int(turns.unique_fmpz() if turns.rad() > 0 else turns.mid().floor().unique_fmpz())

    def _end(self, state, t, k, follow=False):
        flow = Flow(self.star, t, k, state, self.digits)
        if follow:
            alpha, gamma = euler(state[0], state[2])
            first, speed = (alpha, gamma), flow.turning * self.star.mu
        for number, (n, momentum, u) in flow.steps(LOOKS if follow else 1):
            if follow:
                gap = speed / number
                room = (n[0] * n[0] + n[1] * n[1]).sqrt() - gap
                assert room > 0 and 2 * gap / room**2 < 3, "near a pole"
                found = []
                for last, angle in zip((alpha, gamma), euler(n, u)):
                    whole = (((last - angle) / (2 * arb.pi())).mid() + arb("0.5")).floor()
                    angle = angle + 2 * arb.pi() * whole
                    assert abs(angle - last) < 3
                    found.append(angle)
                alpha, gamma = found
        if follow:
            self.alpha, self.gamma = alpha - first[0], gamma - first[1]
        return [*n, *momentum]

    def _closing(self, end):
        """Newton's (dt, dk) from the end to the start, and the size of the box in which it is proved (None if it is not)."""
        off = [a - b for a, b in zip(self.start, end)]
        size = upper(length(off))
        rates = [self.star.rates(arb(a), arb(b), self.start[:3], self.start[3:]) for a, b in ((1, 0), (0, 1))]
        # The two components whose rates are most independent.
        pairs = [(i, j) for i in range(6) for j in range(i)]
        determinant = lambda v, i, j: v[0][i] * v[1][j] - v[0][j] * v[1][i]
        i, j = max(pairs, key=lambda pair: abs(determinant(rates, *pair)).mid())
        box = upper(size * 1000)
        inside = [x + arb(0, box) for x in self.start]
        rates = [self.star.rates(arb(a), arb(b), inside[:3], inside[3:]) for a, b in ((1, 0), (0, 1))]
        d = determinant(rates, i, j)
        if d.contains(0) or not box < arb("1e-3"):
            # If the end is not near enough: a step of least squares.
            rates = [self.star.rates(arb(a), arb(b), end[:3], end[3:]) for a, b in ((1, 0), (0, 1))]
            hh, hk, kk = dot(rates[0], rates[0]), dot(rates[0], rates[1]), dot(rates[1], rates[1])
            right = dot(rates[0], off), dot(rates[1], off)
            d = hh * kk - hk * hk
            return (right[0] * kk - right[1] * hk) / d, (right[1] * hh - right[0] * hk) / d, None
        dt = (off[i] * rates[1][j] - off[j] * rates[1][i]) / d
        dk = (off[j] * rates[0][i] - off[i] * rates[0][j]) / d
        # The flow from the end over (dt, dk) stays in the box.
        moved = size + abs(dt) * length(rates[0]) + abs(dk) * length(rates[1])
        unit = lambda place: [arb(int(x == place)) for x in range(6)]
        jacobian = arb_mat([unit(i), unit(j), *self.star.integrals(inside[:3], inside[3:])])
        proved = moved < box and not jacobian.det().contains(0)
        return dt, dk, box if proved else None


class Torus:
    """Two closed paths and the angles that circulate with them."""

    def __init__(self, body, s, state, guesses, digits):
        ctx.dps = digits + 15
        self.star, self.state = Star(body, s, state), state
        self.ways = [Way(self.star, state, t, k, digits) for t, k in guesses]
        (t_1, k_1), (t_2, k_2) = ((way.t, way.k) for way in self.ways)
        d = t_1 * k_2 - k_1 * t_2
        assert not d.contains(0)
        # Turns of the two angles per unit of time.
        self.tau = k_2 / d, -k_1 / d
        self.spin_rest = dot(state[1], state[0]) * (1 / self.star.i_zz - 1 / self.star.i_xx)

    def rate(self, changes):
        """Mean rate of an angle from its changes along the paths."""
        return sum((tau * change for tau, change in zip(self.tau, changes)), arb(0))

    def alpha_rate(self):
        return self.rate([2 * arb.pi() * way.turns for way in self.ways])

    def gamma_rate(self):
        return self.rate([way.gamma for way in self.ways]) + self.spin_rest

    def second_rate(self):
        """Rate of the second angle of the torus."""
        return 2 * arb.pi() * self.tau[1]
