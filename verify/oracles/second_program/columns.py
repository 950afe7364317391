"""The columns of `twofold run`, in the order and the units of docs/scenes.md."""

import numpy as np

from motion import FINE, Motion
from scene import magnetic_axis

G_OVER_C4 = 6.67430e-11 / 299792458.0**4


def motion_over_times(scene, numerics=FINE):
    """The motion over all times of the output, with a margin for derivatives."""
    first, last = min(scene.times.min(), scene.start), max(scene.times.max(), scene.start)
    margin = 2.0 / Motion(scene, scene.start, scene.start, numerics).turning
    return Motion(scene, first - margin, last + margin, numerics)


def euler_angles(motion, times):
    """alpha, beta, gamma at times, alpha and gamma continued from the start."""
    scene = motion.scene
    first, last = min(times.min(), scene.start), max(times.max(), scene.start)
    count = int((last - first) * motion.turning * 8) + 2
    dense = np.unique(np.concatenate([np.linspace(first, last, count), times, [scene.start]]))
    axes = motion.axes(dense)
    x, y, z = axes[:, 0], axes[:, 1], axes[:, 2]
    start = np.searchsorted(dense, scene.start)
    turned = []
    for angle, given in zip(
        (np.arctan2(z[:, 0], -z[:, 1]), np.arctan2(x[:, 2], y[:, 2])), scene.angles, strict=True
    ):
        angle = np.unwrap(angle)
        turned.append(angle + 2 * np.pi * np.round((given - angle[start]) / (2 * np.pi)))
    at = np.searchsorted(dense, times)
    return turned[0][at], np.arctan2(np.hypot(z[:, 0], z[:, 1]), z[:, 2])[at], turned[1][at]


def euler_rates(motion, times):
    """Rates of the angles from Eq. (22)."""
    y = motion.states(times)
    axes, (p, q, r) = y[:, :9].reshape(-1, 3, 3), motion.angular_velocity_in_body(y, motion.scene.bulge).T
    sin = np.hypot(axes[:, 2, 0], axes[:, 2, 1])
    sin_g, cos_g = axes[:, 0, 2] / sin, axes[:, 1, 2] / sin
    alpha = (p * sin_g + q * cos_g) / sin
    return alpha, p * cos_g - q * sin_g, r - alpha * axes[:, 2, 2]


def integrals(motion, times):
    """E = T + C n.(s n) + b L.(s L), the last without the trace of s, Omega^z, and K = L.(s L) - 2 C I^xx n.(adj(s) n)."""
    scene = motion.scene
    y, momentum = motion.states(times), motion.momentum(times)
    n, omega, s = y[:, 6:9], y[:, 9:], scene.tensor
    inertia = np.array([scene.inertia_xx, scene.inertia_xx, scene.inertia_zz])
    energy = 0.5 * omega**2 @ inertia + scene.c * np.einsum("ti,ij,tj->t", n, s, n)
    energy = energy + scene.bulge * np.einsum("ti,ij,tj->t", momentum, scene.traceless, momentum)
    adjugate = np.array([np.cross(s[1], s[2]), np.cross(s[2], s[0]), np.cross(s[0], s[1])])
    k = np.einsum("ti,ij,tj->t", momentum, s, momentum)
    k = k - 2 * scene.c * scene.inertia_xx * np.einsum("ti,ij,tj->t", n, adjugate, n)
    return energy * scene.cgs, omega[:, 2], k * scene.cgs**2


def direction_of_beam(motion, times):
    """m in inertial components."""
    return np.einsum("i,tij->tj", magnetic_axis(motion.scene.pulsar), motion.axes(times))


def position_angle(observer, vectors):
    """Angle on the sky from north (-theta) through east (-phi)."""
    return np.arctan2(-vectors @ observer.phi, -vectors @ observer.theta)


def strain(motion, times):
    """h_+ and h_x, Eq. (71), from the second derivative of I^IJ(t) by differences; G/c^4 and the distance for a physical star."""
    scene, observer = motion.scene, motion.scene.observer

    def quadrupole(t):
        n = motion.axes(t)[:, 2]
        a, b = n @ observer.theta, n @ observer.phi
        return np.column_stack([a * a - b * b, 2 * a * b])

    # I^IJ = I^xx delta^IJ + (I^zz - I^xx) n^I n^J, and h^IJ = -(2/r) d2 I^IJ/dt2.
    alone = motion.braking is None and not scene.bulge
    second = motion.derivative(quadrupole, times, 2) if alone else _of_rotation(motion, times)
    second = second * scene.difference
    scale = G_OVER_C4 / observer.distance if scene.physical else 1.0
    return -scale * second[:, 0], -scale * second[:, 1]


def _of_rotation(motion, times):
    """The same derivative as if the torque along L and the bulge ended at each time: they are left out of the wave (docs/spin-down.md, two-deformations.md)."""
    observer, y = motion.scene.observer, motion.states(times)
    rate = motion.free_rates(y)
    step = 1e-3 / motion.turning
    # Along a line the equations are polynomials of third degree: the differences are exact.
    near = {k: motion.free_rates(y + k * step * rate) for k in (-2, -1, 1, 2)}
    second = (8 * (near[1] - near[-1]) - (near[2] - near[-2])) / (12 * step)
    n, n_1, n_2 = (values[:, 6:9] for values in (y, rate, second))

    def plus_and_cross(u, v):
        (u_1, u_2), (v_1, v_2) = ((x @ observer.theta, x @ observer.phi) for x in (u, v))
        return np.array([u_1 * v_1 - u_2 * v_2, u_1 * v_2 + u_2 * v_1])

    return (2 * plus_and_cross(n, n_2) + 2 * plus_and_cross(n_1, n_1)).T


def position_angle_and_rate(motion, times):
    """Position angle of the magnetic axis, and its rate."""
    observer = motion.scene.observer

    def on_sky(t):
        m = direction_of_beam(motion, t)
        return np.column_stack([-m @ observer.theta, -m @ observer.phi])

    here = on_sky(times)
    if motion.braking is None:
        rate = motion.derivative(on_sky, times, 1)
    else:
        # By the rotation alone, without what friction adds (docs/spin-down.md).
        axes = motion.unbraked_rates(motion.states(times))[:, :9].reshape(-1, 3, 3)
        m = np.einsum("i,tij->tj", magnetic_axis(motion.scene.pulsar), axes)
        rate = np.column_stack([-m @ observer.theta, -m @ observer.phi])
    turning = (here[:, 0] * rate[:, 1] - here[:, 1] * rate[:, 0]) / (here**2).sum(axis=1)
    return np.arctan2(here[:, 1], here[:, 0]), turning


def columns(motion, groups=None):
    """The table: a list of (name with unit, values)."""
    scene, times = motion.scene, motion.scene.times
    unit, observer = scene.unit, scene.observer
    momentum_unit, energy_unit = ("g cm^2/s", "erg") if scene.physical else ("I_xx/t_c", "C")
    table = [(f"t [{unit}]", times)]

    def add(group, names, values):
        if groups is None or group in groups:
            table.extend(zip(names, values(), strict=True))

    def vector(name, unit):
        return [f"{name}_{axis} [{unit}]" for axis in "XYZ"]

    def value_and_rate(f):
        return f(times), motion.derivative(f, times, 1)

    add("angles", ["alpha [rad]", "beta [rad]", "gamma [rad]"], lambda: euler_angles(motion, times))
    rates = [f"{name}_rate [rad/{unit}]" for name in ("alpha", "beta", "gamma")]
    add("rates", rates, lambda: euler_rates(motion, times))
    add("e_x", vector("e_x", "1"), lambda: motion.axes(times)[:, 0].T)
    add("e_z", vector("e_z", "1"), lambda: motion.axes(times)[:, 2].T)
    add("L", vector("L", momentum_unit), lambda: motion.momentum(times).T * scene.cgs)
    names = [f"E [{energy_unit}]", f"Omega_z [rad/{unit}]", f"K [({momentum_unit})^2]"]
    add("integrals", names, lambda: integrals(motion, times))
    if scene.constants is not None and np.array_equal(scene.principal, np.eye(3)):
        names = ["alpha_printed [rad]", "beta_printed [rad]"]
        add("perturbation", names, lambda: scene.constants.angles(times - scene.start))
    if observer is not None:
        names = ["cos_lambda [1]", f"cos_lambda_rate [1/{unit}]"]
        add("lambda", names, lambda: value_and_rate(lambda t: motion.axes(t)[:, 2] @ observer.direction))
    if observer is not None and scene.pulsar is not None:
        names = ["m.n [1]", f"m.n_rate [1/{unit}]"]
        add("m.n", names, lambda: value_and_rate(lambda t: direction_of_beam(motion, t) @ observer.direction))
    if scene.pulsar is not None:

        def magnetic():
            m = direction_of_beam(motion, times)
            return np.arctan2(np.hypot(m[:, 0], m[:, 1]), m[:, 2]), np.arctan2(m[:, 1], m[:, 0])

        add("magnetic_axis", ["Theta [rad]", "Phi [rad]"], magnetic)
    if observer is not None and scene.pulsar is not None:
        names = ["psi [rad]", f"psi_rate [rad/{unit}]"]
        add("position_angle", names, lambda: position_angle_and_rate(motion, times))
    if observer is not None and (observer.distance is not None or not scene.physical):
        add("h", ["h_plus [1]", "h_cross [1]"], lambda: strain(motion, times))
    return table
