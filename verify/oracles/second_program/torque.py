"""The torque along L and the friction of a star with [spin_down], as in the equation of motion (docs/spin-down.md), without stretched time."""

import numpy as np
from scipy.integrate import solve_ivp

from scene import magnetic_axis

SHARES = {"vacuum": 1.0, "plasma": 0.5, "constant": 0.0}


class Torque:
    """d ln |L| / dt = -kappa a^(n - 1) (1 - q cos^2 theta_m) / (its mean over a precession at the epoch), a = |L| / |L| of the scene."""

    def __init__(self, scene):
        given = scene.document["spin_down"]
        inertia = np.array([scene.inertia_xx, scene.inertia_xx, scene.inertia_zz])
        body = inertia * scene.omega
        self.momentum = np.linalg.norm(body)
        self.axis = magnetic_axis(scene.pulsar)
        l = body / self.momentum
        precession = (scene.inertia_zz / scene.inertia_xx - 1) * scene.omega[2]
        # Turns of the magnetic axis about L: those of n, minus those about n if it circles n.
        wobble = np.arccos(abs(l[2]))
        goes_round = wobble < scene.pulsar["chi"] < np.pi - wobble
        turns = abs(np.sign(l[2]) * self.momentum / scene.inertia_xx - goes_round * precession)
        self.frequency = (turns + self._turns_of_bulge(scene, l @ scene.axes)) / (2 * np.pi)
        self.kappa = -given["f1"] / self.frequency
        self.index = given["f2"] * self.frequency / given["f1"] ** 2 if "f2" in given else given.get("index", 3.0)
        share = given.get("torque", "constant")
        self.share = SHARES.get(share, share)
        self.damping = 1 / (given["damping_time"] * 86400) if "damping_time" in given else 0.0

        # L circles n in the body at the rate W; its azimuth counts from the magnetic axis.
        self.chi, self.side, self.wobble = scene.pulsar["chi"], np.sign(l[2]), wobble
        self.precession = precession
        azimuth = np.arctan2(l[1], l[0]) - scene.pulsar.get("delta", 0.0)
        self.mean = self._harmonics(0.0)[0]
        # The integral of the varying part, which has no mean, over the azimuth x, by parts: for B cos k x it is B sin k x / k + B' cos k x / k^2 -
        # ...
        reach = 0.3 / (self.damping or 1.0)
        time = [-reach, reach]
        order = 14 if self.damping else 0
        rate = np.polynomial.Chebyshev.interpolate(np.vectorize(self._turning), order, time)
        self.ahead, self.swing = 0.0, 0.0
        for k in (1, 2):
            size = np.polynomial.Chebyshev.interpolate(np.vectorize(lambda t, k=k: self._harmonics(t)[k] / self._turning(t)), order, time)
            for part in range(4):
                wave = (np.sin, np.cos)[part % 2](k * azimuth) * (1, 1, -1, -1)[part]
                self.ahead += size(0.0) / self.mean * wave / k ** (part + 1)
                slope = size.deriv()
                size = np.polynomial.Chebyshev.interpolate(lambda t, slope=slope: slope(t) / rate(t), order, time)
            self.swing += abs(self._harmonics(0.0)[k]) / self.mean / (k * precession) ** 2

    def _turns_of_bulge(self, scene, start):
        """The mean rate at which T = 2 b s L turns the star about L from the line of sight, over many precessions of L by the bulge alone, of which L is `start`."""
        if not scene.bulge:
            return 0.0
        turning, o = 2 * scene.bulge * self.momentum * scene.traceless, scene.observer.direction
        times = np.linspace(0, 600 / np.linalg.norm(turning @ start), 20001)
        l = solve_ivp(lambda _, l: np.cross(turning @ l, l), times[[0, -1]], start, method="DOP853", t_eval=times, rtol=1e-12, atol=1e-12).y.T
        t = l @ turning
        # Of T the line of sight sees the part along L; it is itself passed by L, as seen about L.
        rate = ((t * l).sum(axis=1) - (l @ o) * (t @ o)) / (1 - (l @ o) ** 2)
        return np.average(rate, weights=(1 - np.cos(2 * np.pi * times / times[-1])) ** 2)

    def _theta(self, t):
        return np.arctan(np.tan(self.wobble) * np.exp(-self.damping * t))

    def _turning(self, t):
        """The rate at which L circles n, at a time at which |L| is that at the epoch."""
        return self.precession * np.cos(self._theta(t)) / np.cos(self.wobble)

    def _harmonics(self, t):
        """Mean and amplitudes of cos x and cos 2 x of the factor for the wobble at a time."""
        theta, x = self._theta(t), 2 * np.pi * np.arange(8) / 8
        cosine = np.sin(theta) * np.sin(self.chi) * np.cos(x) + self.side * np.cos(theta) * np.cos(self.chi)
        factor = 1 - self.share * cosine**2
        return factor.mean(), 2 * (factor * np.cos(x)).mean(), 2 * (factor * np.cos(2 * x)).mean()

    def start(self):
        """a at the epoch: the scene states the mean rotation, not the instantaneous one."""
        x, n = self.kappa * self.ahead, self.index
        return np.exp(-x) if n == 2 else (1 + (n - 2) * x) ** (-1 / (n - 2))

    def steady_clock(self, t):
        """The integral of a since the epoch for a torque that is always its mean at the epoch: d ln a/dt = -kappa a^(n - 1)."""
        kappa, n = self.kappa, self.index
        # a = grown^(-1 / (n - 1)).
        grown = 1 + (n - 1) * kappa * t
        return (grown ** ((n - 2) / (n - 1)) - 1) / ((n - 2) * kappa)

    def rate(self, body):
        """-d ln |L| / dt for rows of L in the body, and the angular velocity in the body due to friction."""
        size = np.linalg.norm(body, axis=1)
        l, a = body / size[:, None], size / self.momentum
        turning = np.zeros_like(l)
        # (n x l) (n.l): n approaches L or -L.
        turning[:, 0], turning[:, 1] = -l[:, 1] * l[:, 2], l[:, 0] * l[:, 2]
        return self.kappa * a ** (self.index - 1) * (1 - self.share * (l @ self.axis) ** 2) / self.mean, self.damping * a[:, None] * turning

    def left_out(self, scene, span, sigma):
        """The angle (rad) that docs/spin-down.md neglects: the precession of L by C / a^2, the change of the harmonics by violation, third orders."""
        kappa, w = abs(self.kappa), abs(self.precession)
        delay = kappa * self.swing * 2 * np.pi * self.frequency
        # Coefficients of the third order in the damping are up to 6.
        third = (self.index != 3) * (kappa / w) ** 2 + 6 * (self.damping / w) ** 3
        return kappa * span**2 * sigma * self.momentum / scene.inertia_xx + delay * (sigma * (1 + w * span) + third)
