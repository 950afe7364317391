"""The numbers of a scene file, as described in docs/scenes.md.

The units of time are those of the file: t_c with I^xx = C = 1, or the second with I in kg m^2 and C in J.
"""

import copy
import re
import tomllib

import numpy as np

from star import JULIAN_YEAR, PARSEC, SOLAR_MASS, uniform_spheroid

PATH = re.compile(r"^(?:(\w+)\.)?(\w+)((?:\[\d+\])*)$")


class Scene:
    """The content of a scene file. `document` is the TOML; everything else follows from it."""

    def __init__(self, document):
        self.document = document
        self._star(document["star"])
        self._coefficients(document["lorentz_violation"])
        self.traceless = self.tensor - np.trace(self.tensor) / 3 * np.eye(3)
        self._times(document["time"])
        self._initial(document["initial"])
        self.pulsar = document.get("pulsar")
        self.observer = self._observer(document["observer"]) if "observer" in document else None
        self.tolerance = document.get("output", {}).get("tolerance", 1e-13)

    @staticmethod
    def read(path):
        with open(path, "rb") as file:
            return Scene(tomllib.load(file))

    def changed(self, keys):
        """The scene with other values at dotted keys, as {"star.spin": 1.2, "lorentz_violation.w[1]": 0.1}."""
        document = copy.deepcopy(self.document)
        for key, value in keys.items():
            section, name, indices = PATH.match(key).groups()
            place, last = document[section] if section else document, name
            for index in re.findall(r"\d+", indices):
                place, last = place[last], int(index)
            place[last] = value
        return Scene(document)

    def _star(self, star):
        self.physical = "mass" in star
        if self.physical:
            given = {"radius": star["radius"] * 1e3} if "radius" in star else {"density": star["density"] * 1e3}
            oblateness, spin = self._oblateness_and_spin(star)
            self.inertia_xx, self.inertia_zz, self.difference, self.c = uniform_spheroid(star["mass"] * SOLAR_MASS, oblateness, **given)
            self.spin = spin
        else:
            self.inertia_xx, self.inertia_zz, self.c = 1.0, float(star["inertia_ratio"]), 1.0
            self.spin, self.difference = float(star["spin"]), self.inertia_zz - self.inertia_xx
        # The factor b in the energy b L.(s L) of a centrifugal bulge: a multiple of that of a fluid, half of the energy of rotation over L.L.
        bulge = star.get("bulge", 0.0)
        self.bulge = (1.0 if bulge == "fluid" else bulge) / (4 * self.inertia_xx)
        self.time_unit = (self.inertia_xx / self.c) ** 0.5
        # Units of the output: 1 kg m^2 = 1e7 g cm^2, 1 J = 1e7 erg.
        self.cgs = 1e7 if self.physical else 1.0
        self.unit = "s" if self.physical else "t_c"

    def _oblateness_and_spin(self, star):
        """(I^zz - I^xx) / I^xx and Omega^z, which can be given by the period of the precession [d] and the frequency of the pulses [Hz]."""
        oblateness, spin = star.get("oblateness"), 2 * np.pi * star.get("spin_frequency", 0.0)
        precession = 2 * np.pi / (star["precession_period"] * 86400) if oblateness is None else None
        if "frequency" in star:
            pulses, theta, chi = 2 * np.pi * star["frequency"], self.document["initial"]["wobble"], self.document["pulsar"]["chi"]
            # From the rate of the axis about L, (1 + eps) Omega^z / cos theta, the precession eps Omega^z is subtracted if the magnetic axis circles
            # the symmetry axis.
            back = 1.0 if theta < chi < np.pi - theta else 0.0
            if precession is None:
                spin = pulses / ((1 + oblateness) / np.cos(theta) - back * oblateness)
            else:
                signed = np.sign(pulses) * precession
                spin = (pulses + back * signed) * np.cos(theta) - signed
        return (precession / abs(spin) if oblateness is None else oblateness), spin

    def _coefficients(self, given):
        """`tensor`, s^IJ in the frame of the file, and `principal`, whose rows are the axes X, Y, Z in that frame."""
        self.principal = np.eye(3)
        if "eigenvalues" in given:
            self.eigenvalues = np.array(given["eigenvalues"], float)
            self.tensor = np.diag(self.eigenvalues)
        elif "tensor" in given:
            self.tensor = np.array(given["tensor"], float)
            values, vectors = np.linalg.eigh(self.tensor)
            x, y = (axis * np.sign(axis[np.abs(axis).argmax()]) for axis in (vectors[:, 2], vectors[:, 1]))
            self.eigenvalues, self.principal = values[::-1], np.array([x, y, np.cross(x, y)])
        else:
            w = np.array(given["w"], float)
            self.tensor = -given["alpha_2"] * np.outer(w, w)
            self.eigenvalues = np.array([0.0, 0.0, -given["alpha_2"] * w @ w])
            z = w / np.linalg.norm(w)
            x = np.cross(z, np.eye(3)[np.abs(z).argmin()])
            x /= np.linalg.norm(x)
            self.principal = np.array([x, np.cross(z, x), z])

    def _times(self, time):
        self.start = float(time.get("start", 0.0))
        if "times" in time:
            self.times = np.array(time["times"], float)
        else:
            span = time.get("span")
            if "years" in time:
                span = time["years"] * JULIAN_YEAR
            end = float(time["end"]) if "end" in time else self.start + span
            self.times = np.linspace(self.start, end, time["samples"])
        self.end = self.times[-1]
        self.epoch = time.get("epoch")

    def _initial(self, given):
        self.constants = None
        if "wobble" in given:
            self._of_wobble(given)
            return
        gamma = float(given.get("gamma", 0.0))
        if "kind" in given:
            self.constants = Constants(self, given)
            alpha, beta, alpha_rate, beta_rate = self.constants.initial_values()
        else:
            alpha, beta = float(given["alpha"]), float(given["beta"])
            alpha_rate, beta_rate = float(given["alpha_rate"]), float(given["beta_rate"])
        gamma_rate = self.spin - alpha_rate * np.cos(beta)
        axes = body_axes(alpha, beta, gamma)
        # Eq. (22).
        omega = np.array(
            [
                alpha_rate * np.sin(beta) * np.sin(gamma) + beta_rate * np.cos(gamma),
                alpha_rate * np.sin(beta) * np.cos(gamma) - beta_rate * np.sin(gamma),
                alpha_rate * np.cos(beta) + gamma_rate,
            ]
        )
        self.angles = (alpha, gamma)
        if self.constants is not None and not np.array_equal(self.principal, np.eye(3)):
            # The constants refer to the principal frame; the motion is rotated into the frame of the file.
            axes = axes @ self.principal
            self.angles = (np.arctan2(axes[2, 0], -axes[2, 1]), np.arctan2(axes[0, 2], axes[1, 2]))
        self.axes, self.omega = axes, omega


    def _observer(self, given):
        distance = float(given["distance"] * 1000 * PARSEC) if "distance" in given else None
        if "inclination" in given:
            # At that angle to L, in the plane of L and the normal direction at the azimuth.
            inertia = np.array([self.inertia_xx, self.inertia_xx, self.inertia_zz])
            momentum = (self.omega * inertia) @ self.axes
            l = momentum / np.linalg.norm(momentum)
            nearest = np.eye(3)[1 if abs(l[0]) > 0.99 else 0]
            across = nearest - l * (l @ nearest)
            outwards = turned(across / np.linalg.norm(across), l, given.get("azimuth", 0.0))
            direction = l * np.cos(given["inclination"]) + outwards * np.sin(given["inclination"])
            return Observer(np.arctan2(np.hypot(*direction[:2]), direction[2]), np.arctan2(direction[1], direction[0]), distance)
        if given.get("frame") == "equatorial":
            hours, degrees = ([float(x) for x in self.pulsar[key].lstrip("+-").split(":")] for key in ("right_ascension", "declination"))
            ascension, declination = (np.radians(x[0] + x[1] / 60 + x[2] / 3600) for x in (hours, degrees))
            declination *= -1 if self.pulsar["declination"].startswith("-") else 1
            return Observer(np.pi / 2 + declination, 15 * ascension + np.pi, distance)
        return Observer(float(given["theta_o"]), float(given["phi_o"]), distance)

    def _of_wobble(self, given):
        """L along `momentum`, the axis n at the wobble angle to it (to -L for a negative spin), the magnetic axis by its angle about n."""

        momentum = np.array(given.get("momentum", [0.0, 0.0, 1.0]), float)
        l = np.sign(self.spin) * momentum / np.linalg.norm(momentum)
        nearest = np.eye(3)[1 if abs(l[0]) > 0.99 else 0]
        across = nearest - l * (l @ nearest)
        outwards = turned(across / np.linalg.norm(across), l, given.get("azimuth", 0.0))
        theta = given["wobble"]
        n = turned(l, np.cross(l, outwards), theta)
        towards_l = turned(-outwards, np.cross(l, outwards), theta)
        delta = (self.document.get("pulsar") or {}).get("delta", 0.0)
        x = turned(towards_l, n, -given.get("precession_phase", 0.0) - delta)
        axes = np.array([x, np.cross(n, x), n])
        size = self.inertia_zz * self.spin / np.cos(theta)
        inertia = np.array([self.inertia_xx, self.inertia_xx, self.inertia_zz])
        self.axes, self.omega = axes, axes @ (size * l) / inertia
        self.angles = (np.arctan2(axes[2, 0], -axes[2, 1]), np.arctan2(axes[0, 2], axes[1, 2]))


class Constants:
    """The paper's perturbation solutions, Eqs. (27)-(34) as printed; upper signs for twofold precession."""

    def __init__(self, scene, given):
        twofold = given["kind"] == "twofold"
        self.sign = 1.0 if twofold else -1.0
        self.alpha_0, self.beta_0 = float(given["alpha_0"]), float(given["beta_0"])
        self.amplitude, self.phase = float(given["amplitude"]), float(given["phase"])
        x, y, z = scene.eigenvalues
        momentum, c = scene.inertia_zz * scene.spin, scene.c
        cos, sin = np.cos(self.beta_0), np.sin(self.beta_0)
        self.omega = momentum / scene.inertia_xx
        forced = c * (2 * z - x - y) * cos / momentum
        self.c_tilde = c * (x - y) / momentum
        self.rate = self.omega / cos - forced if twofold else forced
        if twofold:
            self.eta_alpha = cos * (2 + cos**2) / (4 - cos**2)
            self.eta_beta = 3 * sin * cos**2 / (4 - cos**2)
        else:
            self.eta_alpha, self.eta_beta = cos, sin

    def angles(self, t):
        """alpha and beta at the time t from the start, Eqs. (27), (33)."""
        free, forced = self.omega * t + self.phase, 2 * (self.rate * t + self.alpha_0)
        sin = np.sin(self.beta_0)
        size = self.c_tilde / (2 * self.rate)
        alpha = self.alpha_0 + self.rate * t + self.sign * self.amplitude / (self.omega * sin) * np.cos(free)
        beta = self.beta_0 + self.amplitude / self.omega * np.sin(free)
        return alpha + self.eta_alpha * size * np.sin(forced), beta - self.eta_beta * size * np.cos(forced)

    def initial_values(self):
        """alpha, beta and their rates at the start, Eq. (34)."""
        alpha, beta = self.angles(0.0)
        twice = 2 * self.alpha_0
        alpha_rate = (
            self.rate
            - self.sign * self.amplitude / np.sin(self.beta_0) * np.sin(self.phase)
            + self.eta_alpha * self.c_tilde * np.cos(twice)
        )
        beta_rate = self.amplitude * np.cos(self.phase) + self.eta_beta * self.c_tilde * np.sin(twice)
        return alpha, beta, alpha_rate, beta_rate


def turned(vector, axis, angle):
    """A vector turned about a unit vector."""
    return vector * np.cos(angle) + np.cross(axis, vector) * np.sin(angle) + axis * (axis @ vector) * (1 - np.cos(angle))


class Observer:
    """`direction` from the star to the observer, Eq. (46); `theta` and `phi` the basis normal to it, Eq. (70); distance in m."""

    def __init__(self, theta_o, phi_o, distance):
        (sin_t, cos_t), (sin_p, cos_p) = (np.sin(theta_o), np.cos(theta_o)), (np.sin(phi_o), np.cos(phi_o))
        self.theta_o = theta_o
        self.direction = np.array([sin_t * cos_p, sin_t * sin_p, cos_t])
        self.theta = np.array([cos_t * cos_p, cos_t * sin_p, -sin_t])
        self.phi = np.array([-sin_p, cos_p, 0.0])
        self.distance = distance


def body_axes(alpha, beta, gamma):
    """Rows e_x, e_y, e_z in inertial components, Eq. (9): Euler's z-x-z."""
    (sa, ca), (sb, cb), (sg, cg) = ((np.sin(x), np.cos(x)) for x in (alpha, beta, gamma))
    node, across = np.array([ca, sa, 0.0]), np.array([-sa * cb, ca * cb, sb])
    return np.array([cg * node + sg * across, -sg * node + cg * across, [sa * sb, -ca * sb, cb]])


def magnetic_axis(pulsar):
    """The magnetic axis in the body, Eq. (45)."""
    chi, delta = pulsar["chi"], pulsar.get("delta", 0.0)
    return np.array([np.sin(chi) * np.cos(delta), np.sin(chi) * np.sin(delta), np.cos(chi)])
