"""The corrected solution with the initial values of an example: its constants from Eq. (34).

All examples have alpha_0 = phi = pi/2, so that they start with alpha = pi/2 and beta' = 0. For the constants of the corrected solution
write p = A cos phi, q = A sin phi. Its beta' = 0 gives p, and with it alpha = pi/2 becomes an equation for alpha_0 alone,

    f(alpha_0) = alpha_0 - pi/2 + K(beta_0) sin 2 alpha_0 = 0,      |2 K| < 1 for every beta_0 (shown over (0, pi) in balls),

which increases, so that alpha_0 = pi/2, p = 0 is its only solution. alpha' gives q, and beta gives one equation F(beta_0) = 0. Its root is
enclosed by Newton's operator in balls, m - F(m) / F'(B): if that lies within B, B contains exactly one root. Over (0, pi) no other root
has a smaller |A|, by which the solution is chosen: each piece has no root, or a larger |A|, or is within B.
"""

from fractions import Fraction

from flint import arb, fmpq
from sympy import Symbol, cancel, cos, diff, expand_trig, lambdify, pi, simplify, sin, tan, together

from examples import FUNCTIONS, SOLUTIONS, Example, ExactPrinter, examples

import perturbation  # noqa: E402  (verify/oracles/symbolic, on the path by examples)

BETA = Symbol("beta")
START = Symbol("start_beta"), Symbol("start_alpha_rate")


def equations():
    """q cos^2 b0, which has no pole at pi/2; F; dF/db0; 2 K."""
    solution = SOLUTIONS["corrected"]
    at_start = lambda e: e.subs({perturbation.x: pi / 2, perturbation.y: pi / 2})
    nu = solution.rate
    q = (at_start(solution.rate + solution.rates()[0].subs(perturbation.amplitude, 0)) - START[1]) / solution.ratio
    assert simplify(solution.rates()[0].coeff(perturbation.amplitude) + solution.ratio * sin(perturbation.x)) == 0
    f = BETA + at_start(solution.angles(nu)[1]).subs(perturbation.amplitude, q) - START[0]
    two_k = solution.r_alpha / nu - 2 * solution.ratio * solution.r_beta / nu
    # Without tan: expressions regular at pi/2 divide by no cosine.
    plain = lambda e: expand_trig(together(e)).replace(tan, lambda a: sin(a) / cos(a))
    return [*(cancel(plain(e)) for e in (q * cos(BETA) ** 2, f)), plain(diff(f, BETA)), cancel(plain(two_k))]


class Root:
    """The constants for one example."""

    def __init__(self, example):
        alpha, beta, alpha_rate, beta_rate = example.perturbed(arb(0))
        assert (alpha - arb.pi() / 2).contains(0) and beta_rate.contains(0)
        values = example.values | {"start_beta": beta, "start_alpha_rate": alpha_rate}
        found = equations()
        names = sorted({s.name for e in found for s in e.free_symbols} - {"beta"})
        printer = ExactPrinter({"fully_qualified_modules": False, "inline": True})
        symbols = {s.name: s for e in found for s in e.free_symbols}
        function = lambdify([BETA, *(symbols[n] for n in names)], found, modules=[FUNCTIONS], printer=printer, cse=True)
        self.at = lambda b: function(b, *(values[n] for n in names))
        self.box, self.beta = self._newton(beta)
        self.q = self.at(self.beta)[0] / self.beta.cos() ** 2

    def _newton(self, start):
        """A ball with exactly one root, and the root."""
        middle = start.mid()
        for _ in range(60):
            _, f, slope, _ = self.at(middle)
            middle = (middle - f / slope).mid()
        box = ball = arb(middle, arb("1e-3"))
        for _ in range(60):
            step = middle - self.at(middle)[1] / self.at(ball)[2]
            assert ball.contains_interior(step) or ball is not box, "Newton's operator leaves the ball"
            ball, middle = step.intersection(ball), step.mid()
        return box, ball

    def is_least(self, low=Fraction(0), high=Fraction(4)):
        """Whether [low, high] has no root outside the ball with an |A| as small."""
        ends = [arb(fmpq(x.numerator, x.denominator)) for x in (low, high)]
        piece = ends[0].union(ends[1])
        if self.box.contains(piece):
            return True
        size, f, _, two_k = self.at(piece)
        if abs(two_k) < 1 and (abs(f) > 0 or abs(size) > abs(self.q) * piece.cos() ** 2):
            return True
        middle = (low + high) / 2
        assert high - low > Fraction(1, 10**6), f"undecided at {float(middle)}"
        return self.is_least(low, middle) and self.is_least(middle, high)


def corrected():
    """The golden numbers of the corrected solutions of tp-I and tp-II."""
    for name, figure in (("tp-I", "figure_motion_tp_1"), ("tp-II", "figure_motion_tp_2")):
        start = examples()[name]
        root = Root(start)
        assert root.is_least()
        same = Example("corrected", root.beta, root.q)
        assert all((a - b).contains(0) for a, b in zip(start.perturbed(arb(0)), same.perturbed(arb(0))))
        for t in (15, 30):
            alpha, beta, _, _ = same.perturbed(arb(t))
            if t == 30:
                yield figure, f"angles: alpha by perturbation corrected [rad] at t = {t}.000", alpha
            yield figure, f"angles: beta by perturbation corrected [rad] at t = {t}.000", beta
