"""Quantiles in balls: a decreasing probability on both sides of the required one."""

from flint import acb, arb


def average(function, tolerance):
    """Mean over [0, 1] of a real function that `acb.integral` accepts."""
    value = acb.integral(function, 0, 1, rel_tol=tolerance, abs_tol=tolerance)
    assert value.imag.contains(0)
    return value.real


def quantile(above, probability, start, width):
    """Ball that contains the x at which `above(x)`, which falls at most as 1/x, equals one minus the probability: it is larger at one end, smaller at
    the other."""
    rest = 1 - arb(probability)
    x = arb(start)
    for _ in range(200):
        step = (above(x) / rest).log()
        if step.contains(0) or abs(step) < width / 4:
            break
        # d log above / d log x is from -1 to 0, so that a full step never overshoots.
        x = (x * step.exp()).mid()
    low, high = x * (1 - arb(width)), x * (1 + arb(width))
    assert above(low) > rest and above(high) < rest, f"undecided near {x.str(10)}"
    return low.union(high)
