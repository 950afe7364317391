"""The paper's printed statements, judged by the derivation alone (docs/discrepancies.md has the numbers)."""

import mpmath as mp
from sympy import Matrix, Rational, Symbol, cos, diff, expand, expand_trig, lambdify, pi, simplify, sin, sqrt, symbols, tan

import mean_motion as mean
import observables as seen
import perturbation
import self_energy as star
import wave_source as wave
from coordinates import RATES, beta, c, i_xx, i_zz, s_x, s_y, s_z, spin
from lagrangian import L_RATE, L, N, N_RATE, POTENTIAL, S_PRINCIPAL, THIRD_INTEGRAL, steady_rates
from mean_motion import BY_H


def zero(expression):
    """Whether the expression vanishes identically."""
    return simplify(expand_trig(expand(expression))) == 0


def missing_term():
    """1. What Eq. (29) lacks, in the second equation alone, is a^2 sin^2(b0) beta1, twofold, and C (2 s_z - s_x - s_y) sin^2(b0) beta1 / I^xx, single."""
    a = perturbation.omega / cos(beta)
    lacks = {
        kind: [u - v for u, v in zip(perturbation.first_order(kind), perturbation.as_printed(kind))]
        for kind in perturbation.KINDS
    }
    stiffness = {"twofold": a**2, "single": c * (2 * s_z - s_x - s_y) / i_xx}
    return all(
        zero(lacks[kind][0]) and zero(lacks[kind][1] - stiffness[kind] * sin(beta) ** 2 * perturbation.beta1)
        for kind in perturbation.KINDS
    )


def printed_solution_solves_printed_equations():
    """1. Eq. (31) solves Eq. (29) as printed."""
    ok = True
    b = cos(beta)
    etas = {
        "twofold": (b * (2 + b**2) / (4 - b**2), 3 * sin(beta) * b**2 / (4 - b**2)),
        "single": (b, sin(beta)),
    }
    for kind, (eta_alpha, eta_beta) in etas.items():
        found = perturbation.Solution(perturbation.as_printed(kind), kind)
        shift = c * (2 * s_z - s_x - s_y) * b / (i_zz * spin)
        sign = 1 if kind == "twofold" else -1
        ok = ok and all(
            map(
                zero,
                (
                    found.eta_alpha - eta_alpha,
                    found.eta_beta - eta_beta,
                    found.shift + sign * shift,
                    found.nu - perturbation.omega,
                    found.ratio - sign / sin(beta),
                ),
            )
        )
    return ok


def full_solution_differs():
    """1. The full equations give eta_alpha = cos b0 (1 + cos^2 b0) / 2, eta_beta = sin b0 cos^2 b0 and the frequency a for twofold precession,
    eta_alpha = (1 + cos^2 b0) / (2 cos b0) for single precession; the rest is as printed."""
    found = perturbation.Solution(perturbation.first_order("twofold"), "twofold")
    single = perturbation.Solution(perturbation.first_order("single"), "single")
    b = cos(beta)
    return all(
        map(
            zero,
            (
                found.eta_alpha - b * (1 + b**2) / 2,
                found.eta_beta - sin(beta) * b**2,
                found.nu - perturbation.omega / b,
                found.shift + c * (2 * s_z - s_x - s_y) * b / (i_zz * spin),
                single.eta_alpha - (1 + b**2) / (2 * b),
                single.eta_beta - sin(beta),
                single.nu - perturbation.omega,
                single.ratio + 1 / sin(beta),
                single.shift - c * (2 * s_z - s_x - s_y) * b / (i_zz * spin),
            ),
        )
    )


def direction_of_momentum():
    """2. Averaged, dl/dt = (2 C P2(c) / G) (s l) x l: its sign is that of P2 for both kinds; c = 1 is single precession."""
    rate = BY_H.subs(mean.theta, symbols("t"))
    t = symbols("t")
    return zero(rate - (3 * cos(t) ** 2 - 1) / 2) and rate.subs(t, 0) == 1 and rate.subs(t, pi / 2) < 0


def third_integral():
    """3. K is constant along the motion and no function of E and Omega^z (its gradient is not in theirs)."""
    rate = sum(diff(THIRD_INTEGRAL, N[i]) * N_RATE[i] + diff(THIRD_INTEGRAL, L[i]) * L_RATE[i] for i in range(3))
    energy = L.dot(L) / (2 * i_xx) + c * (N.T * S_PRINCIPAL * N)[0]
    functions = Matrix([THIRD_INTEGRAL, energy, L.dot(N), N.dot(N)])
    point = dict(zip(list(N) + list(L), (1, 2, 2, 3, -1, 1))) | {i_xx: 1, c: 1, s_x: 2, s_y: 1, s_z: -4}
    return zero(rate) and functions.jacobian(list(N) + list(L)).subs(point).rank() == 4


def single_size():
    """4. The forced angles of single precession do not fall with s: a common factor of s drops out."""
    k = Symbol("k", positive=True)
    found = perturbation.Solution(perturbation.first_order("single"), "single")
    size = found.r_beta / (2 * found.rate)
    return zero(size.subs({s_x: k * s_x, s_y: k * s_y, s_z: k * s_z}, simultaneous=True) - size)


def remainders():
    """5. The first-order expansions of A_1, A_3 have remainders of order e^4: there is no term in e^3, and one in e^4."""
    ok = True
    for expression, slope in ((star.A_1, Rational(-1, 5)), (star.A_3, Rational(2, 5))):
        expanded = star.expansion(star.in_eccentricity(expression), 6)
        ok = ok and expanded.coeff(star.e, 2) == Rational(2, 3) * slope and expanded.coeff(star.e, 3) == 0
        ok = ok and expanded.coeff(star.e, 4) != 0 and expanded.coeff(star.e, 0) == Rational(2, 3)
    return ok


def appendix():
    """(74), (75), (77)-(79) as printed: closed forms, C, T_rot = 2 C, epsilon = e^2 / (2 - e^2)."""
    e = star.e
    rotation = (star.U_XX - star.U_ZZ) / star.SECOND_XX
    pairs = [
        (star.A_0, star.PRINTED_A_0),
        (star.A_1, star.PRINTED_A_1),
        (star.A_3, star.PRINTED_A_3),
        (star.C_OF_SPHEROID, 4 * pi**2 / 15 * star.rho**2 * star.a_1**5 * star.q * (star.A_1 - star.q**2 * star.A_3)),
        (rotation, 2 * pi * star.rho * (star.A_1 - star.q**2 * star.A_3)),
        (star.I_ZZ * rotation / 2, 2 * star.C_OF_SPHEROID),
        ((star.I_ZZ - star.I_XX) / star.I_XX, e**2 / (2 - e**2)),
    ]
    at = lambda expression, value: star.in_eccentricity(expression + 0 * e).subs({e: value, star.a_1: 2, star.rho: 3}).evalf(40)
    eccentricities = (Rational(1, 50), Rational(3, 7), Rational(99, 100))
    return all(abs(at(u, x) - at(v, x)) < 1e-35 * abs(at(u, x)) for u, v in pairs for x in eccentricities)


def deformation():
    """6. Eq. (20) at 1.6 ms is 0.08, not 1e-3."""
    solar_mass_parameter = mp.mpf("1.32712440018e20")
    omega = 2 * mp.pi / mp.mpf("1.6e-3")
    value = omega**2 * mp.mpf(10) ** 12 / (mp.mpf("1.4") * solar_mass_parameter)
    return 0.08 < value < 0.09


def bounds():
    """8. The table's bounds of 1e-14, 1e-15, 1e-16 times eta are 4.8e-14, 1.33e-14, 1.58e-15 with the stated star and 7.0e-16, 1.9e-16, 1.5e-16
    with each star's own deformation; its Delta lambda are right."""
    degree = mp.pi / 180
    rows = [
        (1.6, 8.3, -48, 100, 75, -19, 4.8e-14, 7.0e-16),
        (1.6, 10, 53, 100, 105, -5.2, 1.33e-14, 1.93e-16),
        (4.1, 13, 20, 95, 51, 1.6, 1.58e-15, 1.5e-16),
    ]
    density = mp.mpf(10) ** 18 * mp.mpf("6.6743e-11")
    inertia_over_c = 15 / (4 * mp.pi * density * mp.mpf("1e-3"))
    change = lambdify(symbols("zeta chi half_width"), seen.LAMBDA_BY_WIDTH, modules="mpmath")
    ok = True
    for period, width, width_change, angle, chi, printed, stated, own in rows:
        per_degree = change(angle * degree, chi * degree, width / 2 * degree)
        lambda_change = per_degree * width_change
        ok = ok and abs(lambda_change / printed - 1) < 0.03
        cosine = mp.sin(angle * degree) * lambda_change * mp.mpf("1e-3") * degree
        interval = 15 * mp.mpf("365.25") * 86400
        spin = 2 * mp.pi / mp.mpf(period * 1e-3)
        for over_c, expected in [(inertia_over_c, stated), (4 / spin**2, own)]:
            ok = ok and abs(abs(over_c * spin * cosine / interval) / expected - 1) < 0.01
    return ok


def axis_along_principal_axis_rests():
    """10. dl/dt vanishes for l along Z and has the factor sin b cos b, which Eq. (40) lacks."""
    b = Symbol("b")
    l = Matrix([0, -sin(b), cos(b)])
    rate = (S_PRINCIPAL * l).cross(l)
    return zero(rate[0] - (s_z - s_y) * sin(b) * cos(b)) and rate[1] == rate[2] == 0


def azimuth_matters():
    """11. With s^XX != s^YY a turn about Z changes the potential."""
    return simplify(diff(POTENTIAL, symbols("alpha"))) != 0 and zero(diff(POTENTIAL, symbols("alpha")).subs(s_y, s_x))


def free_wave():
    """(68) as printed."""
    a, rate = symbols("alpha"), RATES[0]
    printed = (i_zz - i_xx) * rate**2 * sin(2 * beta) / 2 * Matrix(
        [
            [2 * cos(2 * a) * tan(beta), 2 * sin(2 * a) * tan(beta), -sin(a)],
            [2 * sin(2 * a) * tan(beta), -2 * cos(2 * a) * tan(beta), cos(a)],
            [-sin(a), cos(a), 0],
        ]
    )
    return all(zero(u - v.subs(tan(beta), sin(beta) / cos(beta))) for u, v in zip(wave.free_precession(), printed))


def steady():
    """(26) as printed, with s^ZZ alone."""
    root = sqrt((i_zz * spin) ** 2 - 8 * s_z * c * i_xx * cos(beta) ** 2)
    printed = {(i_zz * spin + sign * root) / (2 * i_xx * cos(beta)) for sign in (1, -1)}
    found = [r.subs({s_x: 0}) for r in steady_rates()]
    return len(found) == 2 and all(any(zero(f - p) for p in printed) for f in found)


STATEMENTS = [
    missing_term,
    printed_solution_solves_printed_equations,
    full_solution_differs,
    direction_of_momentum,
    third_integral,
    single_size,
    remainders,
    appendix,
    deformation,
    bounds,
    axis_along_principal_axis_rests,
    azimuth_matters,
    free_wave,
    steady,
]


def judge():
    """Prints each statement with its verdict; returns the number of failures."""
    failures = 0
    for statement in STATEMENTS:
        holds = bool(statement())
        failures += not holds
        print(f"{'holds' if holds else 'FAILS'}  {statement.__doc__.strip()}")
    return failures
