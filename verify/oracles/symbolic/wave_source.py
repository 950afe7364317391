"""Second time derivative of the moment-of-inertia tensor. Eqs. (60)-(68)."""

from sympy import Matrix, solve, symbols

from coordinates import R, RATES, cross_matrix, i_xx, i_zz, s_x, s_y, s_z, time_derivative
from lagrangian import SPIN_OF_RATES, along_motion
from torque import GRADIENT

J = Matrix.diag(*symbols("j_1:4", positive=True))
# Angular velocity of a body with three moments of inertia, and any torque, body components.
W = Matrix(symbols("w_1:4"))
TORQUE = Matrix(GRADIENT)


def angular_acceleration():
    """d/dt (R^T J W) = R^T Gamma with dR^T/dt = R^T [W x]: J W' = Gamma - W x J W."""
    rate = Matrix(symbols("wr_1:4"))
    equations = list(J * rate + cross_matrix(W) * J * W - TORQUE)
    found = solve(equations, list(rate), dict=True)[0]
    return [found[r] for r in rate]


def wave_tensor():
    """A with d^2/dt^2 (R^T J R) = R^T A R: twice the rule d/dt (R^T B R) = R^T (dB/dt + [W x] B - B [W x]) R."""
    w = cross_matrix(W)
    w_rate = cross_matrix(angular_acceleration())
    first = w * J - J * w
    return w_rate * J - J * w_rate + w * first - first * w


def spheroid_in_angles():
    """d^2 I^{IJ} / dt^2 of the spheroid directly from the Euler angles, with the equations of motion."""
    tensor = R.T * Matrix.diag(i_xx, i_xx, i_zz) * R
    return along_motion(time_derivative(time_derivative(tensor)))


def free_precession():
    """The same without s at constant beta, where I^zz Omega^z = I^xx alpha' cos beta, Eq. (68)."""
    no_violation = {s_x: 0, s_y: 0, s_z: 0}
    tensor = spheroid_in_angles().subs(no_violation)
    gamma_rate = solve(
        SPIN_OF_RATES.expand() * i_zz - i_xx * RATES[0] * R[2, 2], RATES[2]
    )[0]
    return tensor.subs(RATES[2], gamma_rate).subs(RATES[1], 0)
