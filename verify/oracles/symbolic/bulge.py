"""The centrifugal bulge beside the rigid deformation (docs/two-deformations.md): H = T + b L.(s L), s traceless.

The angular velocity of the axes is dH/dL at the body's place, and the rates of n and L are the brackets of mean_motion with H.
"""

from sympy import Matrix, diff, expand, eye, symbols

from coordinates import i_xx, i_zz
from lagrangian import L, N
from mean_motion import S, bracket

bulge = symbols("x_1")
ENERGY = bulge * (L.T * (S - S.trace() / 3 * eye(3)) * L)[0]
KINETIC = (L.dot(L) - N.dot(L) ** 2) / (2 * i_xx) + N.dot(L) ** 2 / (2 * i_zz)


def slopes(function):
    return Matrix([diff(function, component) for component in L])


def rates(function):
    """Rates of n and L from the energy alone."""
    return [bracket(component, function) for component in [*N, *L]]


TURNING = slopes(ENERGY)
ANGULAR_VELOCITY = slopes(KINETIC) + TURNING
# I Omega, with the moments i_xx across n and i_zz along it.
KINEMATIC_MOMENTUM = i_xx * ANGULAR_VELOCITY + (i_zz - i_xx) * N.dot(ANGULAR_VELOCITY) * N

assert (Matrix(rates(ENERGY + KINETIC)[:3]) - ANGULAR_VELOCITY.cross(N)).applyfunc(expand).is_zero_matrix
assert (Matrix(rates(ENERGY)[3:]) - TURNING.cross(L)).applyfunc(expand).is_zero_matrix
