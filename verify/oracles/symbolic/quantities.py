"""The compared quantities: each name stands for the same components on the Rust side (verify/src/symbolic/kernels.rs)."""

from dataclasses import dataclass

from sympy import Integer, Matrix, cos, diff, series, sin, solve, sqrt, symbols

import bulge
import mean_motion as mean
import observables as seen
import perturbation
import self_energy as star
import spin_down
import torque
import wave_source as wave
from coordinates import (
    E_X,
    E_Z,
    OMEGA,
    R,
    S_PRINCIPAL,
    alpha,
    beta,
    c,
    gamma,
    i_xx,
    i_zz,
    rotation,
    s_x,
    s_y,
    s_z,
    spin,
    time_derivative,
)
from lagrangian import (
    ACCELERATIONS_25,
    ENERGY,
    EQUATIONS_25,
    GRADIENT,
    KINETIC,
    L,
    LAGRANGIAN,
    MOMENTUM,
    N,
    POTENTIAL,
    SPIN_OF_RATES,
    THIRD_INTEGRAL,
    free_rates,
    state,
    state_rates,
    steady_rates,
)
from torque import S, U


@dataclass
class Quantity:
    """Components by name. `scale` is None for each component's own size, "vector" for the length of all, or an expression."""

    name: str
    components: list
    exact: bool = True
    scale: object = None


def flat(matrix):
    """Row by row."""
    return list(Matrix(matrix))


def solution(name, equations, kind, corrected=False):
    """The numbers and functions of a first-order solution."""
    found = perturbation.Solution(equations, kind)
    frequency = found.rate if corrected and kind == "twofold" else found.nu
    forced = found.shift if kind == "single" else -found.shift
    numbers = [perturbation.omega, found.rate, perturbation.KINDS[kind] + Integer(0), forced, perturbation.c_tilde]
    numbers += [found.eta_alpha, found.eta_beta, frequency, found.ratio]
    interval = symbols("x_1")
    changes = [(found.rate + found.rates()[0]) * interval, found.rates()[1] * interval]
    components = numbers + found.angles(frequency) + found.rates() + changes
    return Quantity(name, components)


def exact_quantities():
    """Rational functions of sines, cosines and numbers."""
    w_x = Matrix(symbols("x_1:4"))
    alpha_2 = symbols("x_4")
    at_state = dict(zip(list(N) + list(L), list(E_Z) + list(MOMENTUM)))
    direct = wave.spheroid_in_angles()
    out = [
        Quantity("rotation-matrix", flat(R)),
        Quantity("symmetry-axis", flat(E_Z)),
        Quantity("tensor-in-body-frame", flat(R * S * R.T)),
        Quantity("tensor-in-inertial-frame", flat(R.T * S * R)),
        Quantity("rotation-rate", flat(time_derivative(R))),
        Quantity("body-rates", flat(OMEGA)),
        Quantity("kinetic-energy", [KINETIC]),
        Quantity("kinetic-energy-of-body", [(wave.W.T * wave.J * wave.W)[0] / 2]),
        Quantity("potential-in-angles", [POTENTIAL]),
        Quantity("potential-of-axis", [c * (E_Z.T * S * E_Z)[0]]),
        Quantity("potential-of-body", [star.energy_of_body(S, U)]),
        # C = T / 2 and s = -alpha_2 w w.
        Quantity("nordtvedt-potential", [spin / 2 * -alpha_2 * w_x.dot(E_Z) ** 2]),
        Quantity("potential-gradient", GRADIENT),
        Quantity("lagrangian", [LAGRANGIAN]),
        Quantity("euler-angle-residuals", EQUATIONS_25),
        Quantity("euler-angle-accelerations", ACCELERATIONS_25),
        Quantity("state-from-angles", state()),
        Quantity("state-rates", state_rates()),
        Quantity("energy", [ENERGY, ENERGY]),
        Quantity("spin", [SPIN_OF_RATES, SPIN_OF_RATES]),
        Quantity("third-integral", [THIRD_INTEGRAL.subs(at_state, simultaneous=True)]),
        Quantity("torque-from-gradient", torque.from_gradient()),
        Quantity("torque-on-body", torque.on_body()),
        Quantity("torque-on-axis", [e.subs(dict(zip(N, E_Z))) for e in torque.on_axis(S, N, c)]),
        Quantity("angular-acceleration", wave.angular_acceleration()),
        Quantity("wave-tensor", flat(wave.wave_tensor())),
        Quantity("inertia-acceleration", flat(direct) * 2),
        Quantity("free-inertia-acceleration", flat(wave.free_precession())),
        Quantity("cos-lambda", [seen.COS_LAMBDA, seen.COS_LAMBDA, seen.COS_LAMBDA_CHANGE, seen.COS_LAMBDA_RATE]),
        Quantity("observer", flat(seen.OBSERVER) + flat(seen.THETA_HAT) + flat(seen.PHI_HAT)),
        Quantity("axis-along-line-of-sight", [seen.ALONG_LINE_OF_SIGHT]),
        Quantity("magnetic-axis-direction", [seen.AXIS[2], *seen.OFFSET_POINT]),
        Quantity("azimuth-rate", [seen.AZIMUTH_RATE, seen.OFFSET_RATE]),
        Quantity("margin-rates", seen.margin_rates()),
        Quantity("axis-in-azimuth", [seen.IN_AZIMUTH]),
        Quantity("cosine-of-half-width", [seen.COSINE_OF_HALF_WIDTH]),
        Quantity("cos-opening-angle", [seen.COS_OPENING]),
        Quantity("width-changes", [seen.ZETA_BY_WIDTH, seen.LAMBDA_BY_WIDTH]),
        Quantity("polarizations", seen.polarizations(S)),
        Quantity("bulge", bulge_components()),
        Quantity("torque-harmonics", [spin_down.A_0, spin_down.A_1, spin_down.A_2]),
    ]
    for kind in perturbation.KINDS:
        out.append(Quantity(f"first-order-equations-{kind}", perturbation.first_order(kind)))
        out.append(Quantity(f"printed-first-order-equations-{kind}", perturbation.as_printed(kind)))
        out.append(solution(f"printed-solution-{kind}", perturbation.as_printed(kind), kind))
        out.append(solution(f"corrected-solution-{kind}", perturbation.first_order(kind), kind, corrected=True))
    return out


def bulge_components():
    """Energy, angular velocity, rates of n and L, `I Omega`; `n` from the angles of a point, `L` is its `w`."""
    at = dict(zip(list(N) + list(L), list(E_Z) + list(symbols("w_1:4"))))
    components = [bulge.ENERGY, *bulge.TURNING, *bulge.rates(bulge.ENERGY), *bulge.KINEMATIC_MOMENTUM]
    return [component.subs(at, simultaneous=True) for component in components]


def spin_down_quantities():
    """Rotation of a braked star, and a wobble damped by friction."""
    late, time = spin_down.delay()
    # The delay is a difference of periodic functions of this size.
    size = spin_down.braking * spin_down.MODULATION * (abs(spin_down.A_1) + abs(spin_down.A_2) / 4) / spin_down.rate**2
    return [
        Quantity("braked-rotation", [1 / spin_down.slowness(), time], exact=False),
        Quantity("delay-by-torque", [late], exact=False, scale=size),
        Quantity("damped-wobble", spin_down.damped(), exact=False),
    ]


def spheroid_quantities():
    """Uniform spheroids from the integral over directions."""
    inertia_ratio = star.I_ZZ / star.C_OF_SPHEROID
    # T_rot = I^zz Omega^2 / 2 from the virial relation K^xx = U^xx - U^zz, K^xx = Omega^2 int rho x^2.
    rotation_rate_squared = (star.U_XX - star.U_ZZ) / star.SECOND_XX
    coefficients = [star.A_0, star.A_1, star.A_3, star.A_1 - star.q**2 * star.A_3]
    body = [star.MASS, star.I_XX, star.I_ZZ, star.U_XX, star.U_ZZ, star.C_OF_SPHEROID]
    oblateness = (star.I_ZZ - star.I_XX) / star.I_XX
    body += [oblateness, inertia_ratio, rotation_rate_squared, star.I_ZZ * rotation_rate_squared / 2]
    estimate = estimated_inertia_over_c()
    return [
        Quantity("potential-coefficients", coefficients, exact=False),
        Quantity("uniform-spheroid", body, exact=False),
        Quantity("inertia-over-c", [estimate, fluid_inertia_over_c()], exact=False),
    ]


def estimated_inertia_over_c():
    """First term of I^zz / C in the oblateness x_1, at the density rho."""
    k = symbols("k", positive=True)
    # q from the oblateness of a uniform spheroid, (1 - q^2) / (1 + q^2).
    ratio = (star.C_OF_SPHEROID / star.I_ZZ).subs(star.q, sqrt((1 - k) / (1 + k)))
    slope = series(ratio, k, 0, 2).removeO().coeff(k, 1)
    return (1 / slope / symbols("x_1")).simplify()


def fluid_inertia_over_c():
    """I^zz / C of a star with the flattening due to its spin: T_rot = I^zz spin^2 / 2 = 2 C."""
    return 4 / spin**2


def mean_quantities():
    """Averaged motion in the principal frame, l from the angles of the frame, traceless s."""
    trace_free = {s_z: -s_x - s_y}
    diagonal = dict(zip(flat(S), flat(S_PRINCIPAL))) | {S[0, 1]: 0, S[0, 2]: 0, S[1, 2]: 0}
    direction = rotation(*symbols("frame_alpha frame_beta frame_gamma")).row(2).T
    at = dict(zip(list(N) + list(L), list(E_Z) + list(mean.size * direction)))
    place = lambda e: e.subs(diagonal).subs(trace_free).subs(at, simultaneous=True)
    cosine, h = mean.invariants(N, L)
    g2 = L.dot(L)
    pulled = S * L
    in_c = [e.subs(mean.theta, symbols("wobble")) for e in mean.SECOND]
    in_c = [cos_polynomial(e).subs(symbols("c_symbol"), cosine) for e in in_c]
    second = c**2 * i_xx / g2 * (in_c[0] * h**2 + in_c[1] * pulled.dot(pulled) / g2 + in_c[2] * (S * S).trace())
    first = mean.MEAN_1_OF_VECTORS - mean.MEAN_1_OF_VECTORS.subs({v: 0 for v in flat(S)})
    kinetic = g2 / (2 * i_xx)
    slope = lambda f, variables: [diff(f, v) for v in variables]
    energy_scale = c * (sum(abs(v) for v in (s_x, s_y)) * 2)
    return [
        Quantity("mean-potential", [place(first), place(first + second)], exact=False, scale=energy_scale),
        Quantity("mean-angular-velocity-first", [place(e) for e in slope(kinetic + first, L)], exact=False, scale="vector"),
        Quantity(
            "mean-angular-velocity-second", [place(e) for e in slope(kinetic + first + second, L)], exact=False, scale="vector"
        ),
        Quantity("generator", [place(mean.GENERATOR)], exact=False, scale=energy_scale * i_xx / mean.size),
        Quantity("generator-slopes", [place(e) for e in slope(mean.GENERATOR, list(N) + list(L))], exact=False, scale="vector"),
        growth(),
    ]


def cos_polynomial(expression):
    """An even polynomial of sines in powers of c = cos(wobble)."""
    wobble, c_symbol = symbols("wobble c_symbol")
    return expression.subs({sin(wobble): sqrt(1 - c_symbol**2), cos(wobble): c_symbol}).expand()


def growth():
    """Growth about the middle axis: dl/dt = <H>_L x l linearised, l = e_Y + small, s_x > s_y > s_z; as a function of G and c = x_1.

    The kernel is evaluated at the energy at which the first-order averaged motion has this G.
    """
    size, cosine = mean.size, symbols("x_1")
    p2 = (mean.BY_H).subs(sin(mean.theta) ** 2, 1 - cosine**2)
    # dl/dt = (2 C P2 / G) (s l) x l: its linear part about Y.
    l = Matrix(symbols("l_1:4"))
    rate = 2 * c * p2 / size * (S_PRINCIPAL * l).cross(l)
    jacobian = rate.jacobian(l).subs({l[0]: 0, l[1]: 1, l[2]: 0})
    across = jacobian.extract([0, 2], [0, 2])
    assert across.trace() == 0
    rate = sqrt(-across.det())
    # P2 loses digits near its zero, and G^2 / (2 I) those that it is smaller than the parts of the energy.
    scale = rate / abs(p2) * (abs(p2) + 3 * cosine**2) * (1 + cosine**2 * (1 + i_xx / i_zz))
    return Quantity("growth-at-middle-axis", [rate], exact=False, scale=scale)


def motion_quantities():
    """Closed motions: roots, and free motion after the time x_1."""
    frame = rotation(*symbols("frame_alpha frame_beta frame_gamma"))
    time = symbols("x_1")
    free = free_rates()
    later = {alpha: alpha + free[0] * time, gamma: gamma + free[1] * time}
    turned = [frame.T * axis.subs(later, simultaneous=True) for axis in (E_Z, E_X)]
    h = seen.harmonics()
    renamed = dict(zip(symbols("p i"), symbols("azimuth zeta"))) | {symbols("wobble"): symbols("colatitude")}
    drift = symbols("x_2")
    # Eq. (40): Delta cos lambda = a^(1) Delta t with the factors of the directions set to one, solved for the combination.
    combination = symbols("combination")
    bound = solve(c * combination * cos(beta) / (i_zz * spin) * time - drift, combination)[0]
    # Effect of an error of the angle beta on the rate omega / cos beta.
    rate_scale = i_zz * spin / (i_xx * cos(beta) ** 2)
    return [
        Quantity("steady-precession", steady_rates()[::-1], exact=False),
        Quantity("free-precession", free, exact=False, scale=rate_scale),
        Quantity("free-rotation", flat(turned[0]) + flat(turned[1]), exact=False, scale=1 + (rate_scale + spin) * time),
        Quantity("wave-harmonics", [e.subs(renamed, simultaneous=True) for e in h], exact=False, scale="vector"),
        Quantity("spin-axis-bound", [abs(bound)], exact=False),
    ]


def all_quantities():
    """In the order of the file."""
    return exact_quantities() + spheroid_quantities() + mean_quantities() + motion_quantities() + spin_down_quantities()
