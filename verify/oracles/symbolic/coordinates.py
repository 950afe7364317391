"""Angles, their rates, and the results of three elementary rotations: the rotation matrix and the angular velocity. Eqs. (8), (9), (22)."""

from sympy import Matrix, cos, diff, expand, sin, symbols, trigsimp, zeros

ANGLES = alpha, beta, gamma = symbols("alpha beta gamma")
RATES = symbols("alpha_1 beta_1 gamma_1")
ACCELERATIONS = symbols("alpha_2 beta_2 gamma_2")

# The spheroid, its constant C, the eigenvalues of s and a general symmetric s.
i_xx, i_zz, c = symbols("i_xx i_zz c", positive=True)
s_x, s_y, s_z = symbols("s_x s_y s_z")
S_PRINCIPAL = Matrix.diag(s_x, s_y, s_z)
spin = symbols("spin", positive=True)


def symmetric(name):
    """A symmetric matrix of six symbols."""
    xx, yy, zz, xy, xz, yz = symbols(" ".join(f"{name}_{k}" for k in ("xx", "yy", "zz", "xy", "xz", "yz")))
    return Matrix([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def time_derivative(expression):
    """Time derivative along a motion: the chain rule through angles and rates."""
    if isinstance(expression, Matrix):
        return expression.applyfunc(time_derivative)
    slots = list(zip(ANGLES, RATES)) + list(zip(RATES, ACCELERATIONS))
    return sum((diff(expression, place) * rate for place, rate in slots), start=0 * alpha)


def turn_about_third(angle):
    """Components in axes rotated about their third one by the angle."""
    return Matrix([[cos(angle), sin(angle), 0], [-sin(angle), cos(angle), 0], [0, 0, 1]])


def turn_about_first(angle):
    """Components in axes rotated about their first one by the angle."""
    return Matrix([[1, 0, 0], [0, cos(angle), sin(angle)], [0, -sin(angle), cos(angle)]])


def rotation(a, b, g):
    """Body components from inertial ones: rotations about Z, about the line of nodes, and about the symmetry axis."""
    return (turn_about_third(g) * turn_about_first(b) * turn_about_third(a)).applyfunc(expand)


R = rotation(*ANGLES)


def cross_matrix(v):
    """The matrix of the product v x w as a function of w."""
    return Matrix([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def angular_velocity():
    """Body components: d e_i/dt = Omega x e_i makes dR/dt R^T = -[Omega x]."""
    turning = (time_derivative(R) * R.T).applyfunc(lambda e: trigsimp(expand(e)))
    assert (turning + turning.T).applyfunc(lambda e: trigsimp(expand(e))) == zeros(3)
    return Matrix([turning[1, 2], turning[2, 0], turning[0, 1]])


OMEGA = angular_velocity()
# Symmetry axis and first equatorial axis, inertial components.
E_X, E_Z = R.row(0).T, R.row(2).T
