"""Limits at 95 % for the two pulsars: from the error of the change of width, from unknown directions, and from both with the rounding
of the other numbers.

The bound over eta, b = |4 sin(lambda) (d lambda / d W) Delta W / (Omega Delta t)|, is taken as normal, with the error of Delta W and that of each
other number to first order (a printed number is uniform within its last digit: this digit over sqrt(12)). The limit L on |b| eta at 95 % has
P(1 / eta < |b| / L) = 5 %, where 1 / eta = sin(lambda) (1 - mu^2) sin(t) / 2, with mu in [0, 1] and t in [0, pi/2] uniform (unknown_axes). This
probability is an elliptic integral, and the mean over b remains.
"""

from flint import acb, arb, ctx
from sympy import Rational, cos, diff, pi, sin, symbols

from examples import enclose, fraction
from quantiles import quantile
from unknown_axes import DEGREE, above_seen_at, below_rate

import observables as seen  # noqa: E402  (verify/oracles/symbolic, on the path by examples)

CONFIDENCE = "0.95"
# As printed: period (s), width, chi, lambda (deg), years, change of width and its error (deg).
PULSARS = {
    "PSR B1937+21, main pulse": ("1.6e-3", "8.3", "75", "100", "15", "-0.048", "0.051"),
    "PSR B1937+21, interpulse": ("1.6e-3", "10", "105", "100", "15", "0.053", "0.099"),
    "PSR J1744-1134": ("4.1e-3", "13", "51", "95", "15", "0.020", "0.108"),
}


def deviation(text):
    """Standard deviation of a number that is rounded to its last digit."""
    mantissa, _, exponent = text.partition("e")
    decimals = len(mantissa.partition(".")[2])
    return arb(10) ** (int(exponent or 0) - decimals) / arb(12).sqrt()


def bound(texts):
    """b with its deviations by the change of width and by the other numbers, in 1e-16."""
    names = symbols("period width chi lambda_ years change")
    period, width, chi, lambda_, years, change = names
    degree = pi / 180
    slope = seen.LAMBDA_BY_WIDTH.subs(
        {seen.half_width: width * degree / 2, seen.chi: chi * degree, seen.zeta: lambda_ * degree}, simultaneous=True
    )
    year = Rational(31557600)
    b = 4 * sin(lambda_ * degree) * slope * change * degree * period / (2 * pi) / (years * year) * 10**16
    values = {name.name: arb(fraction(text)) for name, text in zip(names, texts)}
    value, *slopes = enclose([b, *(diff(b, name) for name in names)], values)
    inputs = sum((slope * deviation(text)) ** 2 for slope, text in zip(slopes[:-1], texts)).sqrt()
    return abs(value), abs(slopes[-1]) * arb(fraction(texts[-1])), inputs


def beyond(mean, spread, size):
    """P(|b| > size) of a normal b."""
    root = spread * arb(2).sqrt()
    return (((size - mean) / root).erfc() + ((size + mean) / root).erfc()) / 2


def above_all(mean, spread, sine):
    """P(|b| eta > L): the mean over the sizes of b of P(1 / eta < |b| / L), which increases with b. Sizes below `low`, where it has a
    logarithm, add at most their own probability times its value at `low`, those above `high` at most their own probability."""
    low, high = (spread / 1000).mid(), (mean + 8 * spread).mid()
    scale = spread * (2 * arb.pi()).sqrt()

    def density(size):
        return sum((-(((size + sign * mean) / spread) ** 2) / 2).exp() for sign in (-1, 1)) / scale

    def above(limit):
        rate = lambda size: size / (limit * sine)

        def integrand(size, analytic):
            w = rate(size)
            wide = (w.real.rad() + w.imag.rad()) * 3 > abs(w.real.mid())
            if wide or not w.real > 0:
                # It is a probability for real arguments.
                return acb("nan") if analytic else density(size) * arb(0).union(arb(1))
            return density(size) * below_rate(w)

        value = acb.integral(integrand, acb(low), acb(high), rel_tol=arb("1e-8"), abs_tol=arb("1e-9")).real
        ends = (1 - beyond(mean, spread, low)) * below_rate(rate(low)).real + beyond(mean, spread, high)
        return value + ends.union(arb(0))

    return above


def limits():
    """The lines of the table of pulsars at 95 %."""
    ctx.dps = 30
    probability = fraction(CONFIDENCE)
    for name, texts in PULSARS.items():
        mean, by_change, by_inputs = bound(texts)
        sine = DEGREE(int(texts[3])).sin()
        normal = lambda size: beyond(mean, by_change, size)
        table = "pulsar_bounds"
        found = normal_quantile(normal, probability, mean, by_change)
        yield table, f"{name}: (c) as (b), with the error of Delta W, limit / eta (1e-16), 95 %", found
        found = quantile(above_seen_at(int(texts[3])), probability, 80, arb("1e-9"))
        yield table, f"{name}: eta, 95 %, at the known angle lambda", found
        spread = (by_change**2 + by_inputs**2).sqrt()
        above = above_all(mean, spread, sine)
        yield table, f"{name}: limit (1e-16), 95 %, all together", quantile(above, probability, mean * 60, arb("1e-5"))


def normal_quantile(above, probability, mean, spread):
    """The size that is exceeded with one minus the probability, by bisection."""
    rest = 1 - arb(probability)
    low, high = arb(mean.mid()), (mean + 4 * spread).mid()
    for _ in range(60):
        middle = ((low + high) / 2).mid()
        low, high = (middle, high) if above(middle) > rest else (low, middle)
    low, high = low - spread.mid() / 10**12, high + spread.mid() / 10**12
    assert above(low) > rest and above(high) < rest
    return low.union(high)
