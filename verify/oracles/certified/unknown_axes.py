"""The factor eta for unknown axes: every direction of the spin axis l is equally likely, and that of the observer, too, or the
observer is at a known angle lambda to l, at any azimuth.

For r = 0, v = |lZ| sqrt(1 - lZ^2). Isotropic observers: with z_1, z_2 the roots of v x = 1, and artanh sqrt(1 - z^2) an integral of
1 / (z sqrt(1 - z^2)),

    P(eta > x) = z_1 + 1 - z_2 + (artanh z_2 - artanh z_1) / x,      z_1^2 + z_2^2 = 1.

At the angle lambda: 1 / eta is sin(lambda) times the product of the components of Z along l and across it, which is
(1 - mu^2) |sin t| / 2 for an isotropic Z. The mean over mu leaves an integral over t that is put into the form of a pendulum,
sin(tau / 2) = k sin(phi), t = pi/2 - tau, cos(tau) - 2 w = 2 k^2 cos^2 phi, k^2 = (1 - 2 w) / 2, w = 1 / (x sin(lambda)):

    P(eta > x) = 1 - (4 sqrt(2) k^2 / pi) * integral from 0 to pi/2 of cos^2 phi / sqrt((1 - 2 k^2 sin^2 phi)(1 - k^2 sin^2 phi)).

For r != 0 and an azimuth alpha of l, with lZ = sin(theta), a = r^2 sin^2 2 alpha, b = 1 + r^2 + 2 r cos 2 alpha,

    q = (v x)^2 = x^2 cos^2 theta (a cos^2 theta + b sin^2 theta),      q - 1 = x^2 (b - a) (sin^2 theta - Z_1) (Z_2 - sin^2 theta),

the share of directions is one below theta_1, if Z_1 > 0, and above theta_2. Between them it is 1 / sqrt(q) or, at the angle lambda
with x sin(lambda) for x, 1 - (2 / pi) atan sqrt(q - 1). The integral over theta is an analytic function of alpha except at Z_1 = 0,
that is x |r| sin 2 alpha = 1: the range of azimuths is divided there.
"""

from flint import acb, arb, ctx, fmpq

from examples import fraction
from quantiles import quantile

DEGREE = lambda degrees: arb(degrees) * arb.pi() / 180


def above_symmetric(x):
    """P(eta > x), r = 0, all directions."""
    root = (1 - 4 / x**2).sqrt()
    low, high = ((1 - root) / 2).sqrt(), ((1 + root) / 2).sqrt()
    return low + 1 - high + (high.atanh() - low.atanh()) / x


def below_rate(w):
    """P(1 / eta < w sin(lambda)), r = 0, at the angle lambda; w below 1/2, a real or complex ball."""
    k2 = (1 - 2 * acb(w)) / 2

    def integrand(u, analytic):
        s2 = (u * arb.pi() / 2).sin() ** 2
        return (1 - s2) / ((1 - 2 * k2 * s2).sqrt(analytic) * (1 - k2 * s2).sqrt(analytic))

    value = acb.integral(integrand, 0, 1, rel_tol=arb("1e-12"), abs_tol=arb("1e-12"), eval_limit=4000)
    return 1 - 2 * arb(2).sqrt() * k2 * value


def above_seen_at(angle):
    """P(eta > x), r = 0, at an angle lambda in degrees."""
    return lambda x: below_rate(1 / (x * DEGREE(angle).sin())).real


def sinc(y):
    """sin(y) / y."""
    return (y / arb.pi()).sinc_pi()


def at_azimuth(r, edge, size, u, x, on_cone, tolerance, limit, analytic):
    """The share of directions with eta > x at the azimuth edge + size u^2, where Z_1 = 0 at the edge, and Z_1 > 0 below it, or for no edge at size u."""
    alpha = size * u if edge is None else edge + size * u**2
    cut = edge is None or size < 0
    a, b = (r * (2 * alpha).sin()) ** 2, 1 + r**2 + 2 * r * (2 * alpha).cos()
    # W = 1 - Z is a root of (b - a) W^2 - b W + 1 / x^2.
    small = 2 / x**2 / (b + (b**2 - 4 * (b - a) / x**2).sqrt(analytic))
    if edge is None:
        rest = 1 / x**2 - a
    else:
        # sin^2 of twice the edge minus that of twice alpha, over u^2.
        rest = r**2 * -2 * size * sinc(2 * size * u**2) * (2 * (alpha + edge)).sin()
    z_1 = rest / ((b - a) * (1 - small))
    begin = z_1.sqrt(analytic) if cut else acb(0)
    if edge is not None:
        z_1, begin = z_1 * u**2, begin * u
    end = (1 - small).sqrt(analytic)
    tangents = begin / (1 - z_1).sqrt(analytic) if cut else acb(0), end / small.sqrt(analytic)
    # Away from the cuts of atan, which are imaginary.
    if not (tangents[1].real > 0 and abs(tangents[0].imag) < 1):
        return acb("nan")
    theta_1, theta_2 = (tangent.atan() for tangent in tangents)
    width = theta_2 - theta_1

    def isotropic(u, flag):
        theta = theta_1 + width * u
        return 1 / (x * (a + (b - a) * theta.sin() ** 2).sqrt(flag or analytic))

    def seen_at_angle(u, flag):
        flag = flag or analytic
        # The variable is a square at both ends, so that sqrt(q - 1) is smooth there.
        s, c = (u * arb.pi() / 2).sin(), (u * arb.pi() / 2).cos()
        theta = theta_1 + width * s**2
        from_end = c * (width * sinc(width * c**2) * (theta_2 + theta).sin()).sqrt(flag)
        if cut:
            from_begin = s * (width * sinc(width * s**2) * (theta_1 + theta).sin()).sqrt(flag)
        else:
            from_begin = (theta.sin() ** 2 - z_1).sqrt(flag)
        root = x * (b - a).sqrt(flag) * from_begin * from_end
        if flag and not (root.real > 0 or abs(root.imag) < 1):
            return acb("nan")
        return (1 - root.atan() * 2 / arb.pi()) * theta.cos() * s * c * arb.pi()

    inner = acb.integral(seen_at_angle if on_cone else isotropic, 0, 1, rel_tol=tolerance, abs_tol=tolerance, eval_limit=limit)
    return begin + 1 - end + width * inner


def above_asymmetric(r, on_cone=False, tolerance=arb("1e-8"), limit=3000):
    """P(eta > x) for r != 0, all directions or (x sin(lambda) for x) on a cone; `limit` of the evaluations of an inner integral."""
    r = arb(r)

    def above(x):
        def over(ratio, edge, size):
            """Integral over azimuths from the edge on, with a squared variable, or from zero."""

            def integrand(u, analytic):
                share = at_azimuth(ratio, edge, size, u, x, on_cone, tolerance, limit, analytic)
                return share * abs(size) * (1 if edge is None else 2 * u)

            return acb.integral(integrand, 0, 1, rel_tol=tolerance, abs_tol=tolerance).real

        # One half of the quarter turn; the other half is that of -r.
        half, total = arb.pi() / 4, arb(0)
        for ratio in (r, -r):
            if x * abs(r) < 1:
                total += over(ratio, None, half)
            else:
                edge = (1 / (x * abs(r))).asin() / 2
                total += over(ratio, edge, -edge) + over(ratio, edge, half - edge)
        return total / (2 * half)

    return above


def unknown_axes(ratio):
    """The lines of the table of eta for unknown axes, for r = 0, -1/11 or -1/3 (`ratio` as a text)."""
    probability = fraction("0.95")
    if ratio == "0":
        for angle in (95, 100):
            found = quantile(above_seen_at(angle), probability, 80, arb("1e-9"))
            yield "eta", f"r = 0, axes unknown, lambda = {angle} deg: 95 %", found
        for what, text in (("median", "0.5"), ("95 %", "0.95")):
            yield "eta", f"r = 0, axis unknown: {what}", quantile(above_symmetric, fraction(text), 10, arb("1e-12"))
        return
    r = fmpq(-1, int(ratio.split("-")[2]))
    # Starting values.
    median, high, seen_high = {11: (7.0439, 88.4042, 57.1534), 3: (5.7716, 64.96, 41.7977)}[int(r.q)]
    # The fourth digit of 88.404 changes at 88.405.
    yield "eta", f"r = {r}, axis unknown: median", quantile(above_asymmetric(r), fraction("0.5"), median, arb("1.5e-5"))
    above = above_asymmetric(r, False, arb("1e-9"), 20000)
    yield "eta", f"r = {r}, axis unknown: 95 %", quantile(above, probability, high, arb("4e-6"))
    # Quantile of eta sin(lambda).
    found = quantile(above_asymmetric(r, True), probability, seen_high, arb("2.5e-5"))
    for angle in (95, 100):
        sine = DEGREE(angle).sin()
        value = found / sine
        if r == fmpq(-1, 11) and angle == 100:
            # The fourth digit changes at 58.035.
            lower = arb(fraction("58.0351"))
            assert above_asymmetric(r, True, arb("1e-9"), 20000)(lower * sine) > 1 - arb(probability)
            value = lower.union(value.upper())
        yield "eta", f"r = {r}, axes unknown, lambda = {angle} deg: 95 %", value
