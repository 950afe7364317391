"""From the Lagrangian: equations of motion, first integrals, rates of axis and angular momentum. Eqs. (21)-(26), (48)."""

from sympy import Matrix, cos, diff, expand, linear_eq_to_matrix, solve, symbols, trigsimp

from coordinates import (
    ACCELERATIONS,
    ANGLES,
    E_X,
    E_Z,
    OMEGA,
    R,
    RATES,
    S_PRINCIPAL,
    beta,
    c,
    i_xx,
    i_zz,
    s_x,
    s_y,
    s_z,
    spin,
    time_derivative,
)
from self_energy import energy_of_spheroid_in_angles

KINETIC = trigsimp(expand(i_xx * (OMEGA[0] ** 2 + OMEGA[1] ** 2) / 2)) + i_zz * OMEGA[2] ** 2 / 2
POTENTIAL = energy_of_spheroid_in_angles()
LAGRANGIAN = KINETIC - POTENTIAL
GRADIENT = [diff(POTENTIAL, angle) for angle in ANGLES[:2]]

# d/dt dL/dq' - dL/dq for the three angles.
EQUATIONS = [time_derivative(diff(LAGRANGIAN, v)) - diff(LAGRANGIAN, q) for q, v in zip(ANGLES, RATES)]


def accelerations():
    """The three angular accelerations, linear in the equations."""
    matrix, right = linear_eq_to_matrix(EQUATIONS, ACCELERATIONS)
    return list(matrix.LUsolve(right))


ACCELERATION = accelerations()


def along_motion(expression):
    """With the equations of motion inserted."""
    pairs = dict(zip(ACCELERATIONS, ACCELERATION))
    return expression.subs(pairs)


# The rate of gamma and its derivative, from the conjugate momentum of gamma, which is conserved since the Lagrangian does not depend on gamma.
GAMMA_RATE = spin - RATES[0] * cos(beta)
SPIN_OF_RATES = diff(LAGRANGIAN, RATES[2]) / i_zz


def without_gamma(expression):
    """gamma' and gamma'' eliminated by the constant spin."""
    second = time_derivative(GAMMA_RATE)
    return expression.subs(ACCELERATIONS[2], second).subs(RATES[2], GAMMA_RATE)


# The equations in the form of Eq. (25): left side minus right side.
EQUATIONS_25 = [without_gamma(EQUATIONS[k]) / i_xx for k in (0, 1)]
ACCELERATIONS_25 = [without_gamma(ACCELERATION[k]) for k in (0, 1)]

# Noether's energy and the angular momentum, inertial components.
ENERGY = sum(v * diff(LAGRANGIAN, v) for v in RATES) - LAGRANGIAN
MOMENTUM = R.T * Matrix([i_xx * OMEGA[0], i_xx * OMEGA[1], i_zz * OMEGA[2]])


def state():
    """n, L, e_x."""
    return [*E_Z, *MOMENTUM, *E_X]


def state_rates():
    """Their time derivatives along the motion."""
    return [along_motion(time_derivative(component)) for component in state()]


# Vectors n and L as independent variables.
N = Matrix(symbols("n_1:4"))
L = Matrix(symbols("l_1:4"))
N_RATE = L.cross(N) / i_xx
L_RATE = -2 * c * N.cross(S_PRINCIPAL * N)


def third_integral():
    """Every integral L.(M L) + n.(P n) with diagonal M, P: undetermined coefficients; dK/dt must vanish identically.

    The freedom is H, a multiple of L.L and n.n. It is fixed by M = s and P^ZZ = -2 C I^xx s^XX s^YY; the other two of P follow.
    """
    p_x, p_y, p_z = symbols("p_1:4")
    k = (L.T * S_PRINCIPAL * L)[0] + p_x * N[0] ** 2 + p_y * N[1] ** 2 + p_z * N[2] ** 2
    rate = sum(diff(k, N[i]) * N_RATE[i] + diff(k, L[i]) * L_RATE[i] for i in range(3)).expand()
    monomials = {}
    for term in rate.as_ordered_terms():
        factor, rest = term.as_independent(*N, *L)
        monomials[rest] = monomials.get(rest, 0) + factor
    found = solve(list(monomials.values()), [p_x, p_y], dict=True)
    assert len(found) == 1, found
    return k.subs(found[0]).subs(p_z, -2 * c * i_xx * s_x * s_y)


THIRD_INTEGRAL = third_integral()


def steady_rates():
    """alpha' of motion at constant beta for s^XX = s^YY: the second equation of (25), a quadratic."""
    quadratic = EQUATIONS_25[1].subs({ACCELERATIONS[1]: 0, RATES[1]: 0}).subs(s_y, s_x)
    return solve(quadratic, RATES[0])


def free_rates():
    """alpha', gamma' at constant beta without s, for the nonzero root."""
    alpha_rate = next(root for root in (r.subs({s_x: 0, s_z: 0}).simplify() for r in steady_rates()) if root != 0)
    return [alpha_rate, GAMMA_RATE.subs(RATES[0], alpha_rate)]
