"""A uniform spheroid in SI units: moments of inertia and the constant C of its anisotropic self-energy.

C = (U^xx - U^zz) / 2 with the potential-energy tensor of a uniform ellipsoid (Chandrasekhar),
U^ii = (4 pi^2 / 15) G rho^2 a1^2 a3 A_i a_i^2 and A_i = a1^2 a3 Int_0^oo du / ((a_i^2 + u) (a1^2 + u) sqrt(a3^2 + u)).
The two terms nearly cancel, so that the integral is that of their difference, with 40 digits.
"""

from mpmath import mp, mpf, quad, inf, pi, sqrt, cbrt

mp.dps = 40

GRAVITATION = mpf("6.67430e-11")  # m^3 kg^-1 s^-2, CODATA 2018 and 2022
LIGHT = mpf(299792458)  # m/s
SOLAR_MASS = mpf("1.3271244e20") / GRAVITATION  # kg, IAU 2015 B3
PARSEC = mpf(648000) / pi * mpf(149597870700)  # m
DAY = 86400.0  # s
JULIAN_YEAR = 365.25 * DAY  # s


def uniform_spheroid(mass, oblateness, radius=None, density=None):
    """(I^xx, I^zz, I^zz - I^xx) in kg m^2 and C in J of a spheroid of `mass` kg with (I^zz - I^xx) / I^xx = `oblateness`.

    `radius` is (a1^2 a3)^(1/3) in m; or `density` in kg/m^3.
    """
    mass, oblateness = mpf(mass), mpf(oblateness)
    if radius is None:
        radius = cbrt(3 * mass / (4 * pi * mpf(density)))
    radius = mpf(radius)
    # I^xx = m (a1^2 + a3^2) / 5 and I^zz = 2 m a1^2 / 5.
    axis_ratio = sqrt((1 - oblateness) / (1 + oblateness))
    a1 = radius / cbrt(axis_ratio)
    a3 = a1 * axis_ratio
    inertia_xx, inertia_zz = mass * (a1**2 + a3**2) / 5, mass * 2 * a1**2 / 5
    density = mass / (4 * pi / 3 * a1**2 * a3)
    # a1^2 A_1 - a3^2 A_3 in units of a1^2, with u in units of a1^2.
    flat = axis_ratio**2

    def difference(u):
        return u * (1 - flat) / ((1 + u) ** 2 * (flat + u) ** mpf("1.5"))

    coefficients = axis_ratio * quad(difference, [0, 1, 10, inf])
    c = 4 * pi**2 / 15 * GRAVITATION * density**2 * a1**2 * a3 * a1**2 * coefficients
    return float(inertia_xx), float(inertia_zz), float(inertia_zz - inertia_xx), float(c)
