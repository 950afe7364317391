"""How often the limit of a wobble, at 95 %, is above the wobble of simulated arrival times with noise.

    python tools/wobble_limit_coverage.py [NUMBER] [SEED]

Needs the Python package. The wobble is drawn evenly from zero to 30 standard deviations, its phase evenly over a turn, its period evenly in ratios from 50 to 1000 d. A limit at 95 % holds for a wobble
far from zero in 95 % of all data, for one below 1.9 standard deviations in more, since it is never below that: in 95.34 % of this draw, by the integral of this coverage where the posterior is round.
"""

import sys

import numpy as np

import twofold

DAY = 86400.0
UNKNOWNS = ["phase", "f0", "f1"]
EPOCHS, SIGMA, CHI = 300, 1e-6, np.pi / 4


def main() -> None:
    number, seed = (int(given) for given in (sys.argv[1:] + ["1000", "1"][len(sys.argv) - 1 :]))
    random = np.random.default_rng(seed)
    below, limits = 0, []
    for _ in range(number):
        f0, f1 = random.uniform(100.0, 600.0), -(10 ** random.uniform(-16.0, -14.0))
        period = 50.0 * 20.0 ** random.uniform()
        # One standard deviation of the wobble, by geometry alone, and the draw.
        one = SIGMA * 2 * np.pi * f0 * np.tan(CHI) / np.sqrt(EPOCHS / 2)
        wobble = random.uniform(0.0, 30 * one)
        share = random.uniform()
        held = {"chi": CHI, "torque_share": share}
        star = twofold.TimingModel(
            f0, f1=f1, f2=3 * f1**2 / f0, wobble=wobble, precession_phase=random.uniform(0.0, 2 * np.pi),
            precession_rate=2 * np.pi / (period * DAY), **held,
        )  # fmt: skip
        epochs = np.sort(random.uniform(-5.0, 5.0, EPOCHS)) * 365.25 * DAY
        whole, _ = star.phase(epochs)
        times, rest = star.arrival(whole)
        data = twofold.TimingData(times, SIGMA, rest=rest + SIGMA * random.standard_normal(EPOCHS), numbers=whole)
        start = twofold.TimingModel(f0, f1=f1, f2=3 * f1**2 / f0, **held)
        found = twofold.fit_timing(start, data, UNKNOWNS)
        limit = twofold.wobble_limits(found.model, data, UNKNOWNS, [period * DAY])["limit"][0]
        below += wobble < limit
        limits.append(limit / one)
    expected = 0.9534
    error = np.sqrt(expected * (1.0 - expected) / number)
    part = below / number
    print(f"{number} data sets, seed {seed}: the wobble is below its limit in {100 * part:.2f} %, {abs(part - expected) / error:.1f} standard errors from {100 * expected} %")
    print(f"limits from {min(limits):.1f} to {max(limits):.1f} standard deviations of the wobble")


main()
