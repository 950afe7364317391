"""The rotation of a wobbling star that is braked (docs/spin-down.md).

The frequency f obeys df/dt = -kappa f_0 (f / f_0)^n (1 + g (a_1 cos psi + a_2 cos 2 psi)), where 1 - q + q sin^2 theta_m over its mean is the last factor. In the
stretched time tau with dtau / dt = f / f_0 = 1 / u this is d(u^(n - 2)) / dtau = (n - 2) kappa (1 + ...), which can be integrated. The frequency is the mean one at
tau = 0: the oscillating part of the integral has no constant.
"""

from sympy import Matrix, asinh, atan2, cos, diff, exp, integrate, pi, sin, sqrt, symbols, tan

from coordinates import rotation

theta, chi, phase = symbols("colatitude chi azimuth")
psi = symbols("psi")
# kappa, w, n, q, gamma and tau from the numbers of a point.
braking = symbols("x_1") / 1024
rate = symbols("size")
less_two = symbols("x_4")
share = symbols("x_3")
damping = symbols("x_5") / 16
tau = 16 * symbols("x_2")
s = symbols("s")


def torque():
    """sin^2 of the angle of the magnetic axis to L, which is at the wobble angle from the axis of the body: mean, and coefficients of cos psi and cos 2 psi."""
    magnetic = Matrix([sin(chi), 0, cos(chi)])
    along_l = rotation(psi, theta, 0).T * Matrix([0, 0, 1])
    # psi counts from the component of the magnetic axis normal to n.
    along_l = along_l.subs(psi, psi + pi / 2)
    assert (along_l.subs({psi: 0, theta: pi / 2}) - Matrix([1, 0, 0])).norm() == 0
    square = 1 - magnetic.dot(along_l) ** 2
    mean = lambda weight: integrate((square * weight).expand(), (psi, 0, 2 * pi))
    found = [mean(1) / (2 * pi), mean(cos(psi)) / pi, mean(cos(2 * psi)) / pi]
    left = square - found[0] - found[1] * cos(psi) - found[2] * cos(2 * psi)
    assert left.expand(trig=True).simplify() == 0
    return [coefficient.simplify() for coefficient in found]


A_0, A_1, A_2 = torque()
MODULATION = share / (1 - share + share * A_0)


def periodic_integral(terms):
    """Integral with respect to tau of sums of sines and cosines of psi = phase + rate tau, without a constant."""
    return integrate(terms, psi) / rate


OSCILLATING = periodic_integral(MODULATION * (A_1 * cos(psi) + A_2 * cos(2 * psi)))
AT_TAU = {psi: phase + rate * tau}


def slowness():
    """u at the stretched time, at the braking index 2 + x_4."""
    return (1 + less_two * braking * (tau + OSCILLATING.subs(AT_TAU))) ** (1 / less_two)


def delay():
    """t - tau at the braking index 3, from the oscillating torque and in total."""
    twice = periodic_integral(OSCILLATING)
    late = braking * (twice.subs(AT_TAU) - twice.subs(psi, phase))
    return late, tau + braking * tau**2 / 2 + late


def damped():
    """The wobble damped by friction, d theta / dtau = -gamma sin theta cos theta, and the lead of psi, with the rate w cos theta / cos theta_0, over
    w tau."""
    wobble = atan2(sin(theta) * exp(-damping * s), cos(theta))
    assert (diff(wobble, s) + damping * sin(wobble) * cos(wobble)).simplify() == 0
    swept = rate / (cos(theta) * damping) * (asinh(exp(damping * s) / tan(theta)) - asinh(1 / tan(theta)))
    speed = rate * cos(wobble) / cos(theta)
    for colatitude in (0.7, 2.2):
        point = {theta: colatitude, symbols("size"): 1.3, symbols("x_5"): 0.6, s: 2.1}
        assert abs((diff(swept, s) - speed).subs(point).evalf(30)) < 1e-13
    assert swept.subs(s, 0) == 0
    return wobble.subs(s, tau), (swept - rate * s).subs(s, tau)
