"""Quantiles in balls: a decreasing probability on both sides of what is asked for."""

from flint import acb, arb


def average(function, tolerance):
    """Mean over [0, 1] of a real function that `acb.integral` can take."""
    value = acb.integral(function, 0, 1, rel_tol=tolerance, abs_tol=tolerance)
    assert value.imag.contains(0)
    return value.real


def quantile(above, probability, start, width):
    """Ball with the x where `above(x)`, which falls at most as 1/x does, is one minus the probability: above it on one side, below on the other."""
    rest = 1 - arb(probability)
    x = arb(start)
    for _ in range(200):
        step = (above(x) / rest).log()
        if step.contains(0) or abs(step) < width / 4:
            break
        # d log above / d log x is from -1 to 0, so that whole steps of it never go too far.
        x = (x * step.exp()).mid()
    low, high = x * (1 - arb(width)), x * (1 + arb(width))
    assert above(low) > rest and above(high) < rest, f"undecided near {x.str(10)}"
    return low.union(high)
