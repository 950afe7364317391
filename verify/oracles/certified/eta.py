"""The factor eta of Eq. (41) for a star at a known inclination: quantiles, and root mean squares along the motion.

The spin axis l moves as dl/dt = 2 (s l) x l, speeds in units of C |2 s^ZZ - s^XX - s^YY| / (I^zz Omega^z), so that with the squares
p = (lX^2, lY^2, lZ^2) and s = (r, -r, 1)/2

    v^2 = 4 (|s l|^2 - h^2) = 4 sum over pairs of (s_i - s_j)^2 p_i p_j,      h = l.(s l).

A direction to the observer sees a component that is uniform in [-v, v]: P(eta > x) is the mean of 1 / max(1, v x), and eta for the
root mean square is sqrt(3 / <v^2>). By symmetry the azimuths of a quarter turn suffice.

Along the motion h is conserved. With s_1 >= s_2 >= s_3, or the reverse order where h > s_2,
l_2 = sqrt((h - s_3) / (s_2 - s_3)) sn, and from p_1 + p_2 + p_3 = 1 and h

    v^2 = 4 (h - s_3) [(s_1 - h) - (s_1 - s_2) sn^2],     1 - m = (s_1 - s_3)(s_2 - h) / ((s_2 - s_3)(s_1 - h)),

with the mean of sn^2 being (1 - E / K) / m. At azimuths with h = s_2 (the separatrix) the singularity is one over a
logarithm; there the azimuth is at the distance e^-u, and the mean is smooth in u. Beyond u = 40 it lies between 0 and
(s_max - s_min)^2, as v^2 always does (four times the variance of the s_i with the weights p_i).
"""

from flint import acb, arb, ctx, fmpq
from sympy import cos, simplify, sin, symbols, tan

from examples import SOLUTIONS, fraction
from formulas import least
from quantiles import average, quantile

import perturbation  # noqa: E402  (verify/oracles/symbolic, on the path by examples)

PAPER = fmpq(-1, 11)
U = 40


def squared_speed(r, x2, y2, z2):
    """v^2 from the squares of the components."""
    return 4 * r**2 * x2 * y2 + (1 - r) ** 2 * x2 * z2 + (1 + r) ** 2 * y2 * z2


def at_angles(r, alpha, beta):
    """v^2 at an azimuth and an inclination."""
    across = beta.sin() ** 2
    x2 = alpha.sin() ** 2 * across
    return squared_speed(r, x2, across - x2, 1 - across)


def seen(squared, x, analytic):
    """1 / max(1, v x)."""
    return 1 / (squared * x**2).real_max(acb(1), analytic).sqrt(analytic)


def quarter(u):
    """An azimuth from its fraction of a quarter turn."""
    return u * arb.pi() / 2


def above_at_inclination(r, beta, tolerance):
    """P(eta > x) at an inclination."""
    r = arb(r)
    return lambda x: average(lambda u, analytic: seen(at_angles(r, quarter(u), beta), x, analytic), tolerance)


def start(r, alpha_0, beta_0):
    """Azimuth and inclination by Eq. (34) with A = 0, for single precession as printed."""
    double = (2 * alpha_0).sin(), (2 * alpha_0).cos()
    return alpha_0 + r / 2 * double[0], beta_0 - r / 2 * beta_0.tan() * double[1]


def check_start():
    """Compares `start` with the solution of the equations."""
    y, beta = perturbation.y, symbols("beta")
    alpha_1, beta_1 = (e.subs(perturbation.amplitude, 0) for e in SOLUTIONS["single"].angles())
    s = symbols("s_x s_y s_z")
    half = (s[0] - s[1]) / (2 * s[2] - s[0] - s[1]) / 2
    assert simplify(alpha_1 - half * sin(2 * y)) == 0 and simplify(beta_1 + half * tan(beta) * cos(2 * y)) == 0


def of_constant(r, beta_0):
    """v^2 for a random constant alpha_0, as a function of its fraction of a quarter turn."""
    r, beta_0 = arb(r), acb(beta_0)
    return lambda u: at_angles(r, *start(r, quarter(u), beta_0))


def mean_sn2(k, analytic=False):
    """<sn^2> = (1 - E / K) / m from the complementary modulus k, 1 - m = k^2, with a real part above zero.

    By the arithmetic-geometric mean a, b of 1 and k, E / K = 1 - sum of 2^(n-1) c_n^2 with c_0^2 = m, c_1 = (1 - k)/2 and
    c_(n+1) = (a_n - b_n)/2 = c_n^2 / (4 a_(n+1)). All a, b stay in the cone between 1 and k, so that their roots have one branch. The
    remainder: a^2 - b^2 = c^2, so that for |c| < |a|/16 the next a has a relative change below 1/500, each later term is below 1/1000 of
    the one before, and their sum is below the last term included.
    """
    if not k.real > 0:
        return acb("nan")
    a, b = (1 + k) / 2, k.sqrt(analytic)
    c, weight = (1 - k) / 2, 1
    # A factor cancels in c_1^2 / m.
    ratio = (1 - k) / (4 * (1 + k))
    total = arb(1) / 2 + ratio
    for _ in range(40):
        if abs(ratio) * weight < arb(10) ** -25 and abs(c) * 16 < abs(a):
            break
        a, b = (a + b) / 2, a.sqrt(analytic) * b.sqrt(analytic)
        factor = c / (4 * a)
        c, ratio, weight = c * factor, ratio * factor**2, 2 * weight
        total += weight * ratio
    else:
        return acb("nan")
    left = abs(ratio) * weight
    return total + acb(arb(0, left.upper()), arb(0, left.upper()))


def along(values, squares, from_middle, analytic):
    """<v^2> along a motion. `values`, `squares` in the order 1, 2, 3; `from_middle` = s_2 - h."""
    first, middle, last = values
    p_1, p_2, p_3 = squares
    from_first = (first - middle) * p_2 + (first - last) * p_3
    from_last = (first - last) * p_1 + (middle - last) * p_2
    complement = (first - last) * from_middle / ((middle - last) * from_first)
    return 4 * from_last * (from_first - (first - middle) * mean_sn2(complement.sqrt(True), analytic))


def along_motion(r, beta, right_angle=False):
    """eta for the root mean square over azimuths at the inclination and over all later times, for r < 0, that is s^ZZ > s^YY > s^XX."""
    r = arb(r)
    s_x, s_y, s_z = r / 2, -r / 2, arb(1) / 2
    across, up = (arb(1), arb(0)) if right_angle else (beta.sin() ** 2, beta.cos() ** 2)
    # s_2 - h = |r| across (sin^2 alpha - c): zero at the azimuth `edge`.
    c = (1 + r) * up / (-2 * r * across)

    def function(alpha, difference, beyond, analytic):
        """<v^2> for a given sin^2 alpha - c; `beyond` the edge h is below s_2."""
        x2 = alpha.sin() ** 2 * across
        squares = [x2, across - x2, acb(up)]
        from_middle = -r * across * difference
        if beyond:
            return along([s_z, s_y, s_x], squares[::-1], from_middle, analytic)
        return along([s_x, s_y, s_z], squares, from_middle, analytic)

    def part(begin, edge, beyond):
        """Integral over alpha from `begin` to the edge, approached as e^-u."""
        size = edge - begin

        def integrand(u, analytic):
            small = size * (-u).exp()
            alpha = edge - small
            # sin^2 alpha - sin^2 edge without cancellation.
            difference = (-small).sin() * (alpha + edge).sin()
            return function(alpha, difference, beyond, analytic) * small

        value = acb.integral(integrand, 0, U, rel_tol=arb(10) ** -15, abs_tol=arb(10) ** -15).real
        return abs(value) + abs(size) * (-arb(U)).exp() * arb(0).union((s_z - s_x) ** 2)

    half_turn = arb.pi() / 2
    if c > 1:
        flat = lambda alpha, analytic: function(alpha, alpha.sin() ** 2 - c, False, analytic)
        total = acb.integral(flat, 0, half_turn, rel_tol=arb(10) ** -15, abs_tol=arb(10) ** -15).real
    else:
        edge = arb(0) if right_angle else c.sqrt().asin()
        total = part(half_turn, edge, True) + (arb(0) if right_angle else part(arb(0), edge, False))
    return (3 * half_turn / total).sqrt()


def eta():
    """The lines of the table of eta for known inclinations."""
    ctx.dps = 30
    check_start()
    yield "eta", "r = -1/11, beta_0 = pi/2: eta", along_motion(PAPER, None, right_angle=True)
    for text in ("0.2", "0.7", "1.1", "1.4", "1.5"):
        beta = arb(fraction(text))
        at = f"r = -1/11, beta_0 = {text}"
        yield "eta", f"{at}: eta", along_motion(PAPER, beta)
        yield "eta", f"r = -1/3, beta_0 = {text}: eta", along_motion(fmpq(-1, 3), beta)
        above = above_at_inclination(PAPER, acb(beta), arb("1e-9"))
        for what, probability in (("median", "0.5"), ("84 %", "0.84"), ("97.5 %", "0.975")):
            found = quantile(above, fraction(probability), 10, arb("1e-6"))
            yield "eta", f"{at}: at this inclination, {what}", found
        constant = of_constant(PAPER, beta)
        mean = average(lambda u, _: constant(u), arb("1e-15"))
        yield "eta", f"{at} of Eq. (34)", (3 / mean).sqrt()
        above = lambda x: average(lambda u, analytic: seen(constant(u), x, analytic), arb("1e-9"))
        yield "eta", f"{at} of Eq. (34), median", quantile(above, fraction("0.5"), 10, arb("1e-6"))


def figure():
    """The lines of the figure, on its grid of inclinations."""
    ctx.dps = 30
    table = "figure_bound_factor"
    grid = [fraction("0.05") + (fraction("1.565") - fraction("0.05")) * i / 120 for i in range(121)]
    near = lambda text: min(grid, key=lambda x: abs(x - fraction(text)))
    at = lambda beta: f"at {float(beta.p) / float(beta.q):.4f}"
    for beta in (near("0.2"), near("1.1"), near("1.4"), grid[-1]):
        yield table, f"eta [1] {at(beta)}", along_motion(PAPER, arb(beta))
    r = arb(PAPER)
    for what, probability in (("median", "0.5"), ("97.5 %", "0.975")):
        column = f"eta at this inclination: {what} [1]"
        found, bounds = {}, []
        for beta in grid:
            b = arb(beta)
            slowness = average(lambda u, analytic: 1 / at_angles(r, quarter(u), acb(b)).sqrt(analytic), arb("1e-20"))
            x = slowness / (1 - arb(fraction(probability)))
            # v^2 is a concave function of sin^2 alpha, smallest at its ends: if v x >= 1 at both, the mean is that of 1 / (v x).
            if b.sin() * b.cos() * (1 - abs(r)) * x > 1:
                found[beta] = x
            else:
                # No eta is below the inverse of the largest speed.
                bounds.append(1 / (b.sin() * (r**2 * b.sin() ** 2 + (1 + abs(r)) ** 2 * b.cos() ** 2).sqrt()))
        smallest = least(found.values())
        assert all(bound > smallest for bound in bounds)
        yield table, f"{column} {at(near('0.7'))}", found[near("0.7")]
        yield table, f"{column} least", smallest
