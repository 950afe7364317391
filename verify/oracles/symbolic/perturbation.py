"""First order about free precession and about a stationary spin: equations and their solutions. Eqs. (27)-(34), (57).

Twofold: alpha = alpha_0 + a t + k alpha1, beta = beta_0 + k beta1, and s of order k. Single: s and the rates are of order k,
s_x - s_y of order k r and beta1 of order r; the orders k and k r are kept. The phases are x = nu t + phi of the homogeneous and y = a t +
alpha_0 of the forced part. As in the paper, rates are those of the zeroth-order a; angles are their integrals with the shift absorbed in
a, so that a forced angle is its rate over 2 a.
"""

from sympy import Symbol, cos, diff, expand, expand_trig, sin, solve, symbols

from coordinates import ACCELERATIONS, RATES, alpha, beta, c, i_xx, i_zz, s_x, s_y, s_z, spin
from lagrangian import EQUATIONS_25, GRADIENT

k = Symbol("k")
beta1, *FIRST_RATES = symbols("x_1:6")
x, y = symbols("x y")
amplitude = Symbol("amplitude")
omega = i_zz * spin / i_xx
c_tilde = c * (s_x - s_y) / (i_zz * spin)
KINDS = {"twofold": omega / cos(beta), "single": 0}


def first_order(kind):
    """The terms of first order of Eq. (25), divided as in Eq. (29); `alpha`, `beta` stand for alpha_0 + a t and beta_0."""
    return about_free_precession() if kind == "twofold" else about_stationary_spin()


def divided(equations):
    return [equation / divisor for equation, divisor in zip(equations, (sin(beta) ** 2, 1))]


def about_free_precession():
    """The terms of order k."""
    alpha1 = Symbol("alpha1")
    alpha_rate1, beta_rate1, alpha_second1, beta_second1 = FIRST_RATES
    replaced = {
        alpha: alpha + k * alpha1,
        beta: beta + k * beta1,
        RATES[0]: KINDS["twofold"] + k * alpha_rate1,
        RATES[1]: k * beta_rate1,
        ACCELERATIONS[0]: k * alpha_second1,
        ACCELERATIONS[1]: k * beta_second1,
        s_x: k * s_x,
        s_y: k * s_y,
        s_z: k * s_z,
    }
    moved = [equation.subs(replaced, simultaneous=True) for equation in EQUATIONS_25]
    assert all(m.subs(k, 0).simplify() == 0 for m in moved), "zeroth order"
    return divided([diff(m, k).subs(k, 0) for m in moved])


def about_stationary_spin():
    """The terms of the orders k and k r. The rate of alpha at order k is that of the slow precession with s_x = s_y; accelerations, those
    of the homogeneous motion, count as k r."""
    alpha_rate1, beta_rate1, alpha_second1, beta_second1 = FIRST_RATES
    r, slow = symbols("r slow")
    mean, half = (s_x + s_y) / 2, (s_x - s_y) / 2
    replaced = {
        beta: beta + r * beta1,
        RATES[0]: k * (slow + r * (alpha_rate1 - slow)),
        RATES[1]: k * r * beta_rate1,
        ACCELERATIONS[0]: k * r * alpha_second1,
        ACCELERATIONS[1]: k * r * beta_second1,
        s_x: k * (mean + r * half),
        s_y: k * (mean - r * half),
        s_z: k * s_z,
    }
    moved = [diff(e.subs(replaced, simultaneous=True), k).subs(k, 0) for e in EQUATIONS_25]
    at_order_k = [m.subs(r, 0) for m in moved]
    rate = solve(at_order_k[1], slow)[0]
    assert at_order_k[0].simplify() == 0
    return divided([(m0 + diff(m, r).subs(r, 0)).subs(slow, rate) for m0, m in zip(at_order_k, moved)])


def as_printed(kind):
    """Eq. (29), typed from the paper: left side minus right side."""
    sign = {"twofold": 1, "single": -1}[kind]
    alpha_rate1, beta_rate1, alpha_second1, beta_second1 = FIRST_RATES
    return [
        alpha_second1 + sign * omega / sin(beta) * beta_rate1 + GRADIENT[0] / (i_xx * sin(beta) ** 2),
        beta_second1 - sign * omega * sin(beta) * alpha_rate1 + GRADIENT[1] / i_xx,
    ]


class Solution:
    """alpha1' = shift - A h sin x + r_alpha cos 2y, beta1' = A cos x + r_beta sin 2y, by undetermined coefficients.

    Shift and forced rates come from the parts without and with 2y, h and nu from the homogeneous part. If a is zero at zeroth order
    the phase y is constant, so that the forced accelerations vanish; the forced angles are divided by the shift, and the homogeneous
    beta1 is of the order k.
    """

    def __init__(self, equations, kind):
        rate = KINDS[kind]
        shift, ratio, r_alpha, r_beta, nu = symbols("shift ratio r_alpha r_beta nu")
        # Integrals with respect to time.
        if rate != 0:
            values = {beta1: amplitude / nu * sin(x) - r_beta / (2 * rate) * cos(2 * y)}
        else:
            # The shift comes first, from the part without x, y and beta1.
            still = {beta1: 0, FIRST_RATES[1]: 0, FIRST_RATES[2]: 0, FIRST_RATES[3]: 0, s_x: (s_x + s_y) / 2, s_y: (s_x + s_y) / 2}
            absorbed = solve(equations[1].subs(still, simultaneous=True), FIRST_RATES[0])[0]
            values = {beta1: -r_beta / (2 * absorbed) * cos(2 * y)}
        values |= {
            FIRST_RATES[0]: shift - amplitude * ratio * sin(x) + r_alpha * cos(2 * y),
            FIRST_RATES[1]: amplitude * cos(x) + r_beta * sin(2 * y),
            FIRST_RATES[2]: -amplitude * ratio * nu * cos(x) - 2 * rate * r_alpha * sin(2 * y),
            FIRST_RATES[3]: -amplitude * nu * sin(x) + 2 * rate * r_beta * cos(2 * y),
            alpha: y,
        }
        inserted = [expand(expand_trig(e.subs(values))) for e in equations]
        unknown = self._coefficients(inserted)
        homogeneous = [u for u in unknown if u.has(amplitude)]
        forced = [u for u in unknown if not u.has(amplitude)]
        solutions = solve(homogeneous, [ratio, nu], dict=True)
        positive = [s for s in solutions if s[nu].subs({beta: 0.7, i_xx: 1, i_zz: 1.1, spin: 1}) > 0]
        assert len(positive) == 1, solutions
        found = solve(forced, [shift, r_alpha, r_beta], dict=True)
        assert len(found) == 1, found
        self.nu, self.ratio = positive[0][nu].simplify(), positive[0][ratio].simplify()
        self.shift, self.r_alpha, self.r_beta = (found[0][u].simplify() for u in (shift, r_alpha, r_beta))
        # Eq. (32) with the shift absorbed.
        self.rate = rate + self.shift
        self.eta_alpha, self.eta_beta = ((u / c_tilde).simplify() for u in (self.r_alpha, self.r_beta))

    @staticmethod
    def _coefficients(equations):
        """The residuals of each equation, polynomials in the sines and cosines of x and y that must vanish identically."""
        sx, cx, sy, cy = symbols("sx cx sy cy")
        out = []
        for equation in equations:
            polynomial = equation.subs({sin(x): sx, cos(x): cx, sin(y): sy, cos(y): cy})
            polynomial = expand(expand(polynomial).subs(sy**2, 1 - cy**2)).as_poly(sx, cx, sy, cy)
            out += [coefficient for _, coefficient in polynomial.terms()]
        return out

    def rates(self):
        """Eq. (30) without the shift."""
        return [
            -amplitude * self.ratio * sin(x) + self.r_alpha * cos(2 * y),
            amplitude * cos(x) + self.r_beta * sin(2 * y),
        ]

    def angles(self, frequency=None):
        """Eq. (33): the integrals of the rates, with the absorbed a (also for the frequency nu, if it is that)."""
        nu = frequency or self.nu
        return [
            amplitude * self.ratio / nu * cos(x) + self.r_alpha / (2 * self.rate) * sin(2 * y),
            amplitude / nu * sin(x) - self.r_beta / (2 * self.rate) * cos(2 * y),
        ]
