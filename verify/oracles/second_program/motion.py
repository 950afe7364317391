"""Euler's equations of a rigid body with the anisotropic torque, by Picard's iteration on Chebyshev polynomials.

The unknowns are the three body axes and the angular velocity in the body,

    d e_i/dt = Omega x e_i,    I dOmega/dt = Gamma - Omega x (I Omega),    Gamma = 2 C (s^yz, -s^xz, 0)

with s^ij = e_i . s e_j: the torque of dU = C s^zz. A star that slows down has a torque along I Omega as well, and friction turns it (torque.py).
A bulge of the energy b L.(s L) depends on L alone: by the brackets of L with itself and with the axes, its slope T = 2 b s L, s without its trace, is
an angular velocity of L and of the axes. The components of L in the body, and with them I Omega = L, do not see it; the axes turn with Omega + T.
A segment is a polynomial at Chebyshev's points of the integral equation, iterated until it
no longer changes; the motion is dense by construction.
"""

import functools

import numpy as np


class Grid:
    """Chebyshev's points on [-1, 1] with the matrices to coefficients and to the integral from -1."""

    def __init__(self, points):
        k = np.arange(points)
        self.x = -np.cos(np.pi * (k + 0.5) / points)
        values = np.cos(np.outer(np.arccos(self.x), k))
        self.to_coefficients = np.linalg.inv(values)
        polynomials = np.polynomial.chebyshev
        integrals = [polynomials.chebint(row, lbnd=-1) for row in np.eye(points)]
        self.integral = np.array([polynomials.chebval(self.x, c) for c in integrals]).T @ self.to_coefficients
        self.integral_to_end = np.array([polynomials.chebval(1.0, c) for c in integrals]) @ self.to_coefficients


class Numerics:
    """Resolution of the program: the rotation (rad) of a segment and its points."""

    def __init__(self, rotation, points):
        self.rotation, self.grid = rotation, Grid(points)


FINE, OTHER = Numerics(1.0, 26), Numerics(0.7, 22)


class Motion:
    """The motion of `scene` from its start over all times from `first` to `last`, dense.

    A state is a row of twelve numbers: e_x, e_y, e_z (inertial components) and the angular velocity (body components).
    """

    def __init__(self, scene, first, last, numerics=FINE, braking=None):
        self.scene, self.numerics, self.braking = scene, numerics, braking
        ratio = scene.inertia_zz / scene.inertia_xx
        torque = 2 * scene.c / scene.inertia_xx
        s = scene.tensor

        def rates(y, braking=braking, bulge=scene.bulge):
            axes, (p, q, r) = y[:, :9].reshape(-1, 3, 3), y[:, 9:].T
            x, e_y, z = axes[:, 0], axes[:, 1], axes[:, 2]
            of_z = z @ s
            turning = self.angular_velocity_in_body(y, bulge)
            p_rate = torque * np.sum(of_z * e_y, axis=1) + (1 - ratio) * q * r
            q_rate = -torque * np.sum(of_z * x, axis=1) - (1 - ratio) * p * r
            spin = np.column_stack([p_rate, q_rate, np.zeros_like(p)])
            if braking is not None:
                body = y[:, 9:] * inertia
                slowing, friction = braking.rate(body)
                spin -= slowing[:, None] * y[:, 9:] + np.cross(friction, body) / inertia
                turning = turning + friction
            # Omega x e_i with Omega = p e_x + q e_y + r e_z.
            p1, q1, r1 = turning.T[:, :, None]
            return np.hstack([r1 * e_y - q1 * z, p1 * z - r1 * x, q1 * x - p1 * e_y, spin])

        # Without what slows the star down; and, for the wave, without the bulge.
        self.rates, self.unbraked_rates, self.free_rates = rates, functools.partial(rates, braking=None), functools.partial(rates, braking=None, bulge=0.0)
        inertia = np.array([scene.inertia_xx, scene.inertia_xx, scene.inertia_zz])
        start = np.concatenate([scene.axes.ravel(), scene.omega * (braking.start() if braking else 1.0)])
        momentum = np.linalg.norm(np.array([1, 1, ratio]) * scene.omega)
        # Above the rotation rate of any of the axes: |L| / I^xx, the rotation about z, and what the torque and the bulge may add.
        self.turning = momentum + abs(1 - ratio) * abs(scene.spin) + np.sqrt(torque * np.abs(s).max())
        self.turning += 2 * scene.bulge * scene.inertia_xx * momentum * np.linalg.norm(scene.traceless)
        self.step = numerics.rotation / self.turning
        self.ends, self.pieces = [], []
        backward = self._follow(start, min(first, scene.start))
        forward = self._follow(start, max(last, scene.start))
        # Pieces lie on [start + k step, start + (k + 1) step].
        self.origin = scene.start - len(backward) * self.step
        self.coefficients = np.array(backward[::-1] + forward)

    def _follow(self, state, until):
        grid, pieces = self.numerics.grid, []
        span = until - self.scene.start
        half = np.sign(span) * self.step / 2
        for _ in range(int(np.ceil(abs(span) / self.step))):
            y = np.tile(state, (len(grid.x), 1))
            change = np.inf
            for _ in range(200):
                new = state + half * (grid.integral @ self.rates(y))
                last, change = change, np.abs(new - y).max() / max(1.0, np.abs(state).max())
                y = new
                if change < 1e-13 and change >= last / 4:
                    break
            else:
                raise ArithmeticError("Picard's iteration does not converge")
            rate = self.rates(y)
            coefficients = grid.to_coefficients @ y
            if half < 0:
                coefficients[1::2] *= -1
            pieces.append(coefficients)
            state = state + half * (grid.integral_to_end @ rate)
        return pieces

    def states(self, times):
        """States at times, one row each."""
        times = np.atleast_1d(np.asarray(times, float))
        place = (times - self.origin) / self.step
        piece = np.clip(np.floor(place).astype(int), 0, len(self.coefficients) - 1)
        x = 2 * (place - piece) - 1
        if np.abs(x).max() > 1 + 1e-6:
            raise ValueError("a time outside of the motion")
        # Clenshaw's recurrence, all times at once.
        c = self.coefficients
        b1 = b2 = np.zeros((len(times), 12))
        for k in range(c.shape[1] - 1, 0, -1):
            b1, b2 = 2 * x[:, None] * b1 - b2 + c[piece, k], b1
        return x[:, None] * b1 - b2 + c[piece, 0]

    def axes(self, times):
        """e_x, e_y, e_z at times: an array of shape (times, 3, 3)."""
        return self.states(times)[:, :9].reshape(-1, 3, 3)

    def momentum(self, times):
        """L in inertial components."""
        y = self.states(times)
        scene = self.scene
        body = y[:, 9:] * np.array([scene.inertia_xx, scene.inertia_xx, scene.inertia_zz])
        return np.einsum("ti,tij->tj", body, y[:, :9].reshape(-1, 3, 3))

    def angular_velocity_in_body(self, y, bulge):
        """Omega + 2 b s L of rows of states, in the body."""
        if not bulge:
            return y[:, 9:]
        scene, axes = self.scene, y[:, :9].reshape(-1, 3, 3)
        body = y[:, 9:] * np.array([scene.inertia_xx, scene.inertia_xx, scene.inertia_zz])
        return y[:, 9:] + 2 * bulge * np.einsum("tij,jk,tlk,tl->ti", axes, scene.traceless, axes, body)

    def integral(self, f):
        """The integral of f(times) from the start on, as a function of times: a polynomial on each segment."""
        grid, half = self.numerics.grid, self.step / 2
        ends = self.origin + self.step * np.arange(len(self.coefficients) + 1)
        values = f((ends[:-1, None] + half * (1 + grid.x)).ravel()).reshape(-1, len(grid.x))
        at_ends = np.concatenate([[0.0], np.cumsum(half * values @ grid.integral_to_end)])
        at_ends -= at_ends[int(round((self.scene.start - self.origin) / self.step))]
        coefficients = (at_ends[:-1, None] + half * values @ grid.integral.T) @ grid.to_coefficients.T

        def at(times):
            place = (np.asarray(times) - self.origin) / self.step
            piece = np.clip(np.floor(place).astype(int), 0, len(coefficients) - 1)
            return np.polynomial.chebyshev.chebval(2 * (place - piece) - 1, coefficients[piece].T, tensor=False)

        return at

    def derivative(self, f, times, order):
        """The derivative of f(times), an array with one row per time, by a polynomial through Chebyshev's points about each time."""
        points, width = 22, 0.8 * self.numerics.rotation / self.turning
        grid = Grid(points)
        polynomials = np.polynomial.chebyshev
        weights = [polynomials.chebval(0.0, polynomials.chebder(row, order)) for row in np.eye(points)]
        weights = np.array(weights) @ grid.to_coefficients / width**order
        values = np.asarray(f((np.asarray(times)[:, None] + width * grid.x).ravel()))
        values = values.reshape(len(times), points, *values.shape[1:])
        # The mean is subtracted: only variations contribute to a derivative.
        return np.tensordot(values - values.mean(axis=1, keepdims=True), weights, axes=(1, 0))
