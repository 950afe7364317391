"""Golden numbers that are formulas of given numbers: captions, constants, pulsars, stars, expansions, geometry, closed forms of eta."""

from flint import arb, fmpq
from sympy import cos, series, sin, sqrt, symbols

from examples import SOLUTIONS, enclose, examples, fraction

import observables as seen  # noqa: E402  (verify/oracles/symbolic, on the path by examples)
import perturbation  # noqa: E402
import self_energy as star  # noqa: E402
from coordinates import R  # noqa: E402


def captions():
    """Eq. (34)."""
    for name, example in examples().items():
        labels = ("alpha [rad]", "beta [rad]", "alpha rate [1/t_c]", "beta rate [1/t_c]")
        for label, value in zip(labels, example.perturbed(arb(0))):
            yield "caption_initial_values", f"{name} {label} at t = 0", value


def constants():
    """Eqs. (31), (32), (48), (57)."""
    table = "perturbation_constants"
    chosen = examples()
    twofold = chosen["tp-I"]
    free = enclose([perturbation.omega / cos(symbols("beta"))], twofold.values)[0]
    gamma = 1 - free * arb(fraction("0.7")).cos()
    yield table, "free precession, alpha rate [1/t_c], Eq. (48)", free
    yield table, "twice that, the second wave line", 2 * free
    yield table, "free precession, |gamma rate| [1/t_c], Eq. (48)", abs(gamma)
    for name, example in (("twofold", twofold), ("sp-I", chosen["sp-I"]), ("sp-II", chosen["sp-II"])):
        found = example.solution
        forced = found.shift if example.kind == "single" else -found.shift
        pairs = {
            "a^(1), Eq. (31)": forced,
            "a, Eq. (32)": found.rate,
            "C~, Eq. (31)": perturbation.c_tilde,
            "eta_alpha, Eq. (31)": found.eta_alpha,
            "eta_beta, Eq. (31)": found.eta_beta,
        }
        corrected = SOLUTIONS["corrected-single" if example.kind == "single" else "corrected"]
        pairs["eta_alpha, corrected"] = corrected.eta_alpha
        pairs["eta_beta, corrected"] = corrected.eta_beta
        for label, value in zip(pairs, enclose(list(pairs.values()), example.values)):
            yield table, f"{name} {label}", value
    yield table, "twofold, shifted alpha rate [1/t_c], Eq. (57)", twofold.rate
    yield table, "twofold, shifted gamma rate [1/t_c], Eq. (57)", 1 - twofold.rate * arb(fraction("0.7")).cos()


def density():
    """1e15 g/cm^3 in 1/s^2, with G of CODATA."""
    return arb(fraction("6.67430e-11")) * arb(10) ** 18


def inertia_over_c(oblateness):
    """Eq. (43)."""
    return 15 / (4 * arb.pi() * density() * arb(fraction(oblateness)))


def pulsars():
    """Eqs. (41), (42) with the numbers of the table."""
    rows = {
        "PSR B1937+21, main pulse": ("1.6e-3", "8.3", "-0.048", 100, 75),
        "PSR B1937+21, interpulse": ("1.6e-3", "10", "0.053", 100, 105),
        "PSR J1744-1134": ("4.1e-3", "13", "0.020", 95, 51),
    }
    degree = arb.pi() / 180
    for name, (period, width, width_change, angle, chi) in rows.items():
        values = {"zeta": angle * degree, "chi": chi * degree, "half_width": arb(fraction(width)) / 2 * degree}
        change = enclose([seen.LAMBDA_BY_WIDTH], values)[0] * arb(fraction(width_change))
        cosine = values["zeta"].sin() * change * degree
        spin = 2 * arb.pi() / arb(fraction(period))
        drift = abs(spin * cosine / (15 * arb(31557600))) * arb(10) ** 16
        estimate, rounded = inertia_over_c("1e-3"), arb(fraction("1e-5"))
        yield "pulsar_bounds", f"{name}: Delta lambda (1e-3 deg)", change * 1000
        yield "pulsar_bounds", f"{name}: (a) bound / eta (1e-16), I^zz/C by Eq. (43)", drift * estimate
        yield "pulsar_bounds", f"{name}: (a) bound / eta (1e-16), I^zz/C = 1e-5 s^2", drift * rounded
        yield "pulsar_bounds", f"{name}: (a) bound (1e-16), I^zz/C by Eq. (43), eta = 10", drift * estimate * 10
        own = 4 / spin**2
        yield "pulsar_bounds", f"{name}: (b) bound / eta (1e-16), I^zz/C = 4/Omega^2", drift * own
        yield "pulsar_bounds", f"{name}: (b) bound (1e-16), I^zz/C = 4/Omega^2, eta = 10", drift * own * 10


def stars():
    """Eqs. (20), (43), (58), and the expansions of the appendix from the integral over directions."""
    table = "star_estimates"
    oblateness = lambda frequency: (2 * arb.pi() * frequency) ** 2 * arb(10) ** 12 / (arb(fraction("1.4")) * arb(fraction("1.3271244e20")))
    yield table, "eps_f at 100 Hz, Eq. (20)", oblateness(arb(100))
    yield table, "eps_f at 1.6 ms (PSR B1937+21), Eq. (20)", oblateness(1 / arb(fraction("1.6e-3")))
    yield table, "eps_f at 4.1 ms (PSR J1744-1134), Eq. (20)", oblateness(1 / arb(fraction("4.1e-3")))
    yield table, "I^zz/C at eps_f = 1e-3 (s^2), Eq. (43)", inertia_over_c("1e-3")
    yield table, "t_c at eps_r = 1e-8 (s), Eq. (58)", inertia_over_c("1e-8").sqrt()
    yield table, "t_c at eps_r = 0.1 (s), Eq. (58)", inertia_over_c("0.1").sqrt()
    table = "appendix_expansions"
    expanded = {
        "A_0 / (2 a1^2)": star.A_0 / 2,
        "A_1 / (2/3)": star.A_1 * 3 / 2,
        "A_3 / (2/3)": star.A_3 * 3 / 2,
    }
    seconds = ("-1/3", "-1/5", "2/5")
    for (label, expression), second in zip(expanded.items(), seconds):
        terms = series(star.in_eccentricity(expression), star.e, 0, 4).removeO()
        first, slope = enclose([terms.coeff(star.e, 0), terms.coeff(star.e, 2)], {})
        yield table, f"{label} at e = 0", first
        yield table, f"its coefficient of e^2, {second}", slope
    c = star.in_eccentricity(star.C_OF_SPHEROID.subs({star.a_1: 1, star.rho: 1}))
    slope = enclose([series(c, star.e, 0, 4).removeO().coeff(star.e, 2)], {})[0]
    yield table, "C / (16 pi^2 rho^2 a1^4 a3 / 225), coefficient of e^2", slope * 225 / (16 * arb.pi() ** 2)


def geometry():
    """Axes in the figures of the Euler angles and of the cone."""
    values = {"alpha": arb(1), "beta": arb(fraction("0.8")), "gamma": arb(fraction("0.9"))}
    for table, along in (("figure_euler_angles", "X Y Z"), ("figure_euler_angles_yzx", "Y Z X")):
        for i, axis in enumerate("xyz"):
            first, last = enclose([R[i, 0], R[i, 2]], values)
            yield table, f"e_{axis} along {along} [1] first", first
            yield table, f"e_{axis} along {along} [1] last", last
    for name, theta, phi in (("m", "0.72", "0.8"), ("n", "1.05", "1.75")):
        values = {"theta_o": arb(fraction(theta)), "phi_o": arb(fraction(phi))}
        first, last = enclose([seen.OBSERVER[0], seen.OBSERVER[2]], values)
        yield "figure_beam_cone", f"{name} along X Y Z [1] first", first
        yield "figure_beam_cone", f"{name} along X Y Z [1] last", last


def eta():
    """Closed forms of eta: 1 / cos b, the root mean square at an inclination, and everything for s^XX = s^YY."""
    b, r = symbols("b r")
    # Root mean square over directions (1/3) and azimuths of 2 (s l) x l, with 2 s^ZZ - s^XX - s^YY = 1, s^XX - s^YY = r.
    at_inclination = sqrt(3 / (sin(b) ** 2 * ((1 + r**2) * cos(b) ** 2 + r**2 / 2 * sin(b) ** 2)))
    value = lambda expression, beta, ratio=fmpq(-1, 11): enclose([expression], {"b": arb(beta), "r": arb(ratio)})[0]
    for text in ("0.2", "0.7", "1.1", "1.4", "1.5"):
        beta = fraction(text)
        at = f"r = -1/11, beta_0 = {text}"
        yield "eta", f"{at}: 1/cos beta_0", value(1 / cos(b), beta)
        yield "eta", f"{at}: at this inclination", value(at_inclination, beta)
        yield "eta", f"r = 0, beta_0 = {text}: eta", value(at_inclination, beta, fmpq(0))
    table = "figure_bound_factor"
    inclinations = [fraction("0.05") + (fraction("1.565") - fraction("0.05")) * i / 120 for i in range(121)]
    for near in ("0.2", "1.1", "1.4"):
        beta = min(inclinations, key=lambda x: abs(x - fraction(near)))
        yield table, f"1/cos beta_0 [1] at {float(beta.p) / float(beta.q):.4f}", value(1 / cos(b), beta)
    beta = min(inclinations, key=lambda x: abs(x - fraction("0.7")))
    column = "eta for s^XX = s^YY [1]"
    yield table, f"{column} at {float(beta.p) / float(beta.q):.4f}", value(at_inclination, beta, fmpq(0))
    yield table, f"{column} least", least(value(at_inclination, x, fmpq(0)) for x in inclinations)


def least(balls):
    """Enclosure of the least of some numbers."""
    balls = list(balls)
    # The min of arb is rigorous.
    result = balls[0]
    for ball in balls[1:]:
        result = result.min(ball)
    return result


def largest(balls):
    """Enclosure of the largest of some numbers."""
    return -least(-ball for ball in balls)


def all_formulas():
    """Table, label, ball."""
    for part in (captions, constants, pulsars, stars, geometry, eta):
        yield from part()
