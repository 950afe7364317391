"""Observables of a motion: spin axis, bounds, pulses, waves. Eqs. (37)-(56), (59), (68)-(71)."""

from sympy import Matrix, cos, diff, expand, integrate, pi, sin, solve, symbols

from coordinates import (
    E_Z,
    OMEGA,
    R,
    RATES,
    alpha,
    beta,
    gamma,
    i_xx,
    i_zz,
    time_derivative,
    turn_about_third,
)
from lagrangian import along_motion

theta_o, phi_o, chi, delta = symbols("theta_o phi_o chi delta")
half_width, half_opening, zeta = symbols("half_width half_opening zeta")
colatitude, azimuth = symbols("colatitude azimuth")
distance = symbols("distance")

# Direction to the observer, and the basis normal to it as unit vectors along its slopes.
OBSERVER = Matrix([sin(theta_o) * cos(phi_o), sin(theta_o) * sin(phi_o), cos(theta_o)])
THETA_HAT = diff(OBSERVER, theta_o)
PHI_HAT = diff(OBSERVER, phi_o) / sin(theta_o)

# Spin axis, Eqs. (37), (38).
COS_LAMBDA = OBSERVER.dot(E_Z)
ALPHA_CHANGE, BETA_CHANGE = symbols("x_1 x_2")
COS_LAMBDA_CHANGE = diff(COS_LAMBDA, alpha) * ALPHA_CHANGE + diff(COS_LAMBDA, beta) * BETA_CHANGE
COS_LAMBDA_RATE = time_derivative(COS_LAMBDA)

# Magnetic axis, Eqs. (45), (47), (49)-(52).
AXIS_IN_BODY = Matrix([sin(chi) * cos(delta), sin(chi) * sin(delta), cos(chi)])
AXIS = R.T * AXIS_IN_BODY
ALONG_LINE_OF_SIGHT = AXIS.dot(OBSERVER)
# In axes rotated about Z by alpha: Phi - alpha is the azimuth there.
OFFSET_POINT = (turn_about_third(alpha) * AXIS)[:2]


def rate_of_azimuth(x, y, derivative):
    """Rate of the azimuth of a moving point."""
    return (x * derivative(y) - y * derivative(x)) / (x**2 + y**2)


AZIMUTH_RATE = rate_of_azimuth(AXIS[0], AXIS[1], time_derivative)
OFFSET_RATE = rate_of_azimuth(*OFFSET_POINT, lambda e: diff(e, gamma) * RATES[2])
OMEGA_INERTIAL = R.T * OMEGA


def margin_rates():
    """m.n - cos(rho) and three time derivatives along the motion."""
    out = [ALONG_LINE_OF_SIGHT - cos(half_opening)]
    for _ in range(3):
        out.append(along_motion(time_derivative(out[-1])))
    return out


def direction(theta, phi):
    """Unit vector at a colatitude and an azimuth."""
    return Matrix([sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta)])


# Pulse width, Eqs. (54), (56), and the opening angle of the cone behind Eq. (42).
IN_AZIMUTH = direction(colatitude, azimuth).dot(OBSERVER)
SEPARATION = symbols("separation")
COSINE_OF_HALF_WIDTH = solve(
    direction(colatitude, azimuth).dot(direction(theta_o, 0)).subs(cos(azimuth), SEPARATION) - cos(half_opening), SEPARATION
)[0]
COS_OPENING = expand(direction(chi, 0).dot(direction(zeta, half_width)))
# Half of the width is `half_width`: d rho = 0 between zeta and the width.
ZETA_BY_WIDTH = -diff(COS_OPENING, half_width) / 2 / diff(COS_OPENING, zeta)
LAMBDA_BY_WIDTH = (-ZETA_BY_WIDTH).subs(zeta, pi - zeta)


def polarizations(inertia_acceleration):
    """h_+, h_x of h = -(2 / r) ddot I, the components of its transverse and trace-free part along e_+ and e_x."""
    h = -2 / distance * inertia_acceleration
    plus = THETA_HAT * THETA_HAT.T - PHI_HAT * PHI_HAT.T
    cross = THETA_HAT * PHI_HAT.T + PHI_HAT * THETA_HAT.T
    component = lambda basis: sum(basis[k] * h[k] for k in range(9)) / 2
    return [component(plus), component(cross)]


def harmonics():
    """h_+', h_x' of free precession about l at the distance one, the observer at inclination i, e_+' along l on the sky.

    Also the amplitudes h_1, h_2 from h_x', whose harmonics are -h_1 sin i sin p + h_2 cos i sin 2p.
    """
    p, i, wobble, g = symbols("p i wobble size")
    n = direction(wobble, p)
    rate = g / i_xx
    acceleration = (i_zz - i_xx) * rate**2 * (n * n.T).applyfunc(lambda e: diff(e, p, 2))
    observer = direction(i, 0)
    # North on the sky is towards l: minus the direction of increasing colatitude; the two axes have the order of theta, phi.
    north, east = -diff(observer, i), -Matrix([0, 1, 0])
    h = -2 * acceleration
    plus = sum((north * north.T - east * east.T)[k] * h[k] for k in range(9)) / 2
    cross = sum((north * east.T + east * north.T)[k] * h[k] for k in range(9)) / 2
    along = lambda function: integrate(expand(cross * function), (p, 0, 2 * pi)) / pi
    return [plus, cross, -along(sin(p)) / sin(i), along(sin(2 * p)) / cos(i)]
