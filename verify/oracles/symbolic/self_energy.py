"""The self-energy of a uniform spheroid from its definition, Eqs. (6), (11), (12), (15)-(17), (73)-(79).

From a point inside an ellipsoid the attraction of the cone of directions l is rho times the length of the chord. Of the two
ends of a chord the part with the square root is even in l and drops out, so that the attraction is linear, with

    A_i = (1 / 2 pi) int dOmega (l_i^2 / a_i^2) / sum_j (l_j^2 / a_j^2)

which is derived here. For a spheroid it is a rational function of mu = cos(theta).
"""

from sympy import (
    Matrix,
    Symbol,
    apart,
    asin,
    diff,
    expand,
    integrate,
    pi,
    series,
    simplify,
    solve,
    sqrt,
    symbols,
    trigsimp,
)

from coordinates import R, S_PRINCIPAL, c

a_1, rho, q, e, k = symbols("a_1 rho q e k", positive=True)
mu = Symbol("mu", real=True)


def chord_is_linear():
    """The chord through x along l, with (x + r l) on the surface. Its sum over both ends is linear in x, and so is the attraction."""
    x, l, a = (Matrix(symbols(f"{n}_1:4")) for n in "xla")
    r = Symbol("r")
    on_surface = sum((x[i] + r * l[i]) ** 2 / a[i] ** 2 for i in range(3)) - 1
    ends = solve(on_surface, r)
    # The forward chord of l and of -l: r_+(l) l + r_+(-l) (-l) = (sum of the two roots) l.
    sum_of_roots = simplify(ends[0] + ends[1])
    expected = -2 * sum(x[i] * l[i] / a[i] ** 2 for i in range(3)) / sum(l[i] ** 2 / a[i] ** 2 for i in range(3))
    return simplify(sum_of_roots - expected) == 0


def coefficient_by_directions(weight):
    """A_i = (1/2 pi) int dOmega (l_i^2 / a_i^2) / sum, with a1 = 1 and 1 / a3^2 = 1 + k^2; `weight` is the mean of l_i^2 / a_i^2 over azimuth."""
    integrand = weight / (1 + k**2 * mu**2)
    antiderivative = integrate(apart(integrand, mu), mu)
    assert simplify(diff(antiderivative, mu) - integrand) == 0
    return antiderivative.subs(mu, 1) - antiderivative.subs(mu, -1)


def coefficients():
    """A_1 and A_3 of the oblate spheroid with axis ratio q, from the directions. l_x^2 has the mean (1 - mu^2) / 2."""
    found = coefficient_by_directions((1 - mu**2) / 2), coefficient_by_directions(mu**2 * (1 + k**2))
    return [simplify(a.subs(k, sqrt(1 - q**2) / q)) for a in found]


A_1, A_3 = coefficients()
A_0 = 2 * A_1 + q**2 * A_3

# int rho x^2 d^3x over an ellipsoid is M a_i^2 / 5 (a scaled ball), M = (4 pi / 3) rho a1^2 a3.
MASS = 4 * pi / 3 * rho * a_1**3 * q
SECOND_XX, SECOND_ZZ = MASS * a_1**2 / 5, MASS * a_1**2 * q**2 / 5
I_XX, I_ZZ = SECOND_XX + SECOND_ZZ, 2 * SECOND_XX
# U^ij = int rho x^i d_j Phi d^3x with Phi = -pi rho (A_0 - A_1 (x^2 + y^2) - A_3 z^2).
U_XX, U_ZZ = 2 * pi * rho * A_1 * SECOND_XX, 2 * pi * rho * A_3 * SECOND_ZZ
C_OF_SPHEROID = (U_XX - U_ZZ) / 2


def double_integral_is_virial_tensor():
    """Eq. (17) from (15): x^i d_j Phi has the kernel x^i (x - x')^j / |x - x'|^3; both orders of x, x' added give the square."""
    x, y = symbols("x_1:4"), symbols("y_1:4")
    one = [[x[i] * (x[j] - y[j]) for j in range(3)] for i in range(3)]
    other = [[y[i] * (y[j] - x[j]) for j in range(3)] for i in range(3)]
    return all(
        expand(one[i][j] + other[i][j] - (x[i] - y[i]) * (x[j] - y[j])) == 0 for i in range(3) for j in range(3)
    )


def energy_of_body(s_body, u):
    """delta U = -(1/2) s^ij U^ij, Eq. (6) with (17): the pair sum of -(1/2) s^ij x^i x^j / |x|^3 over the mass."""
    return -sum(s_body[i, j] * u[i, j] for i in range(3) for j in range(3)) / 2


def energy_of_spheroid_in_angles():
    """Eq. (21): the body's energy with U = diag(U^xx, U^xx, U^zz), without the part that does not depend on the orientation."""
    u_xx, u_zz = symbols("u_xx u_zz")
    s_body = R * S_PRINCIPAL * R.T
    energy = energy_of_body(s_body, Matrix.diag(u_xx, u_xx, u_zz))
    isotropic = -u_xx * S_PRINCIPAL.trace() / 2
    return trigsimp(expand(simplify((energy - isotropic).subs(u_zz, u_xx - 2 * c))))


# Closed forms as printed, for comparison: Eqs. (74), (75), (77), (79) in e.
Q_OF_E = sqrt(1 - e**2)
PRINTED_A_0 = 2 * Q_OF_E * asin(e) / e
PRINTED_A_1 = Q_OF_E / e**2 * (asin(e) / e - Q_OF_E)
PRINTED_A_3 = 2 / e**2 * (1 - Q_OF_E * asin(e) / e)


def in_eccentricity(expression):
    """With q = sqrt(1 - e^2)."""
    return expression.subs(q, Q_OF_E)


def expansion(expression, order):
    """Series in e."""
    return series(expression, e, 0, order).removeO()
