"""Torques as generalised forces. Eqs. (6), (66)."""

from sympy import Matrix, diff, symbols

from coordinates import OMEGA, RATES, cross_matrix, symmetric
from self_energy import energy_of_body

GRADIENT = symbols("g_1:4")
S, U = symmetric("S"), symmetric("u")


def from_gradient():
    """Body components of the torque that does the work -dU under a change of one Euler angle: J^T Gamma = -grad U."""
    jacobian = OMEGA.jacobian(RATES)
    return list(jacobian.T.LUsolve(-Matrix(GRADIENT)))


def on_body():
    """-d/d(turn) of -(1/2) s^ij U^ij, with the body rotated about each of its axes, that is s rotated in the opposite sense; six components each."""
    out = []
    for i in range(3):
        turning = cross_matrix([int(j == i) for j in range(3)])
        s_rate = -(turning * S + S * turning.T)
        out.append(-energy_of_body(s_rate, U))
    return out


def on_axis(s, axis, c):
    """Torque on a spheroid from its energy c n.(s n): -d/d(turn) with n' = turn x n."""
    energy = c * (axis.T * s * axis)[0]
    slope = [diff(energy, n) for n in axis]
    return list(-axis.cross(Matrix(slope)))
