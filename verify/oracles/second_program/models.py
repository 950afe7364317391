"""A scene as a function of its unknowns, and the signals of many neighbouring scenes at once.

Units are t_c and I^xx = C = 1 of the scene; times count from its start. The state is n = e_z, e_x and L in inertial components,

    dn/dt = L x n,    dL/dt = -2 C n x (s n),    de_x/dt = Omega x e_x,    Omega = L - eps Omega^z n,

a form of the equations other than that of `motion.py`, solved by the same iteration on Chebyshev polynomials.
"""

import dataclasses

import numpy as np

from columns import G_OVER_C4
from scene import Observer, body_axes


def _symmetric(*places):
    pattern = np.zeros((3, 3))
    for i, j, value in places:
        pattern[i, j] = pattern[j, i] = value
    return pattern


# Change of s^IJ for a unit change of one of these; the other five combinations stay constant.
OF_TENSOR = {
    "s_axial": _symmetric((0, 0, -1 / 6), (1, 1, -1 / 6), (2, 2, 1 / 3)),
    "s_asymmetry": _symmetric((0, 0, 1 / 2), (1, 1, -1 / 2)),
    "s_trace": np.eye(3) / 3,
    "s_xy": _symmetric((0, 1, 1.0)),
    "s_xz": _symmetric((0, 2, 1.0)),
    "s_yz": _symmetric((1, 2, 1.0)),
}
NUMBERS = (
    "eps c s_scale alpha beta gamma alpha_rate beta_rate spin chi delta rho theta_o phi_o strain_scale".split()
)
RATES = ("spin", "alpha_rate", "beta_rate")
ANGLES = ("alpha", "beta", "gamma", "chi", "delta", "rho", "theta_o", "phi_o")
UNKNOWNS = [
    "eps", "spin", "c", "s_scale", "s_axial", "s_asymmetry", "s_trace", "s_xy", "s_xz", "s_yz", "alpha", "beta", "gamma",
    "alpha_rate", "beta_rate", "chi", "delta", "rho", "theta_o", "phi_o", "strain_scale",
]  # fmt: skip


@dataclasses.dataclass
class Model:
    """A scene: its numbers by name, the tensor s^IJ, its span, and the strain of h = 1 at r = 1 and I^xx = C = 1."""

    numbers: dict
    tensor: np.ndarray
    end: float
    strain_unit: float

    @staticmethod
    def of(scene):
        """The model of a scene; angles and rates of its start in the frame of the file."""
        unit, pulsar, strain = scene.time_unit, scene.pulsar or {}, 1.0
        observer = scene.document.get("observer", {})
        if "distance" in observer:
            strain = G_OVER_C4 / scene.observer.distance * scene.inertia_xx / unit**2
        alpha, gamma = scene.angles
        z, (p, q, _) = scene.axes[2], scene.omega * unit
        sin = np.hypot(z[0], z[1])
        numbers = {
            "eps": scene.document["star"].get("oblateness", scene.inertia_zz / scene.inertia_xx - 1),
            "c": 1.0, "s_scale": 1.0, "alpha": alpha, "beta": np.arctan2(sin, z[2]), "gamma": gamma,
            "alpha_rate": (p * np.sin(gamma) + q * np.cos(gamma)) / sin,
            "beta_rate": p * np.cos(gamma) - q * np.sin(gamma), "spin": scene.spin * unit,
            "chi": pulsar.get("chi", 0.5), "delta": pulsar.get("delta", 0.0), "rho": pulsar.get("rho", 0.5),
            "theta_o": observer.get("theta_o", 0.5), "phi_o": observer.get("phi_o", 0.0), "strain_scale": 1.0,
        }  # fmt: skip
        end = (scene.end - scene.start) / unit
        return Model({key: float(value) for key, value in numbers.items()}, scene.tensor, end, strain)

    def value(self, unknown):
        """The value of an unknown."""
        if unknown not in OF_TENSOR:
            return self.numbers[unknown]
        s = self.tensor * self.numbers["s_scale"]
        if unknown in ("s_xy", "s_xz", "s_yz"):
            return s["xyz".index(unknown[2]), "xyz".index(unknown[3])]
        x, y, z = np.diag(s)
        return {"s_axial": 2 * z - x - y, "s_asymmetry": x - y, "s_trace": x + y + z}[unknown]

    def moved(self, changes):
        """The model with unknowns changed by the numbers of `changes`."""
        numbers, tensor = dict(self.numbers), self.tensor
        for unknown, change in changes.items():
            if unknown in OF_TENSOR:
                tensor = tensor + change / self.numbers["s_scale"] * OF_TENSOR[unknown]
            else:
                numbers[unknown] += change
        return dataclasses.replace(self, numbers=numbers, tensor=tensor)


def _cross(a, b, into):
    """a x b of vectors whose components come first."""
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        into[i] = a[j] * b[k] - a[k] * b[j]


class Signals:
    """The motions of many models over one span, dense in time, and the observed signals."""

    def __init__(self, models, numerics):
        self.models = models
        self.strain_unit = models[0].strain_unit
        for name in NUMBERS:
            setattr(self, name, np.array([model.numbers[name] for model in models]))
        self.tensor = np.array([model.tensor * model.numbers["s_scale"] for model in models])
        self.direction = np.array([Observer(a, b, None).direction for a, b in zip(self.theta_o, self.phi_o)])
        axes = np.array([body_axes(a, b, g) for a, b, g in zip(self.alpha, self.beta, self.gamma)])
        sin, (sg, cg) = np.sin(self.beta), (np.sin(self.gamma), np.cos(self.gamma))
        # Eq. (22); L = Omega + eps Omega^z n.
        p = self.alpha_rate * sin * sg + self.beta_rate * cg
        q = self.alpha_rate * sin * cg - self.beta_rate * sg
        body = np.column_stack([p, q, self.spin * (1 + self.eps)])
        momentum = np.einsum("bi,bij->bj", body, axes)
        state = np.concatenate([axes[:, 2], axes[:, 0], momentum], axis=1)
        # The period of a rotation at the rate |L| / I^xx.
        self.turn = 2 * np.pi / np.linalg.norm(momentum[0])
        self.rate = np.linalg.norm(momentum[0]) + abs(self.eps[0] * self.spin[0]) + 2 * abs(self.tensor[0]).max()
        self._follow(state, models[0].end, numerics)

    def _rates(self, y):
        """Rates of states; the first axis has the nine numbers of n, e_x and L."""
        n, x, momentum = y[:3], y[3:6], y[6:]
        spin = self.eps / (1 + self.eps) * np.sum(momentum * n, axis=0)
        rates = np.empty_like(y)
        _cross(momentum, n, rates[:3])
        _cross(momentum - spin * n, x, rates[3:6])
        s = self.tensor.transpose(1, 2, 0)
        of_n = [-2 * self.c * (row[0] * n[0] + row[1] * n[1] + row[2] * n[2]) for row in s]
        _cross(n, of_n, rates[6:])
        return rates

    def _follow(self, state, end, numerics):
        grid, pieces = numerics.grid, int(np.ceil(end * self.rate / numerics.rotation)) + 1
        self.step, found = numerics.rotation / self.rate, []
        half = self.step / 2
        state = state.T[:, None, :]
        for _ in range(pieces):
            y = np.repeat(state, len(grid.x), axis=1)
            for _ in range(100):
                new = state + half * (grid.integral @ self._rates(y))
                change, y = np.abs(new - y).max(), new
                if change < 2e-15 + 1e-15 * np.abs(state).max():
                    break
            found.append((grid.to_coefficients @ y).T)
            state = state + half * (grid.integral_to_end[None, None, :] @ self._rates(y))
        # Piece, model, order, number.
        self.coefficients = np.array(found)

    def states(self, times):
        """States at `times`, a row of times for each model."""
        piece = np.clip(np.floor(times / self.step).astype(int), 0, len(self.coefficients) - 1)
        angle = np.arccos(np.clip(2 * (times / self.step - piece) - 1, -1, 1))
        order = self.coefficients.shape[2]
        powers = np.cos(angle[..., None] * np.arange(order))
        of_model = np.arange(len(self.models))[:, None]
        return np.einsum("bek,bekd->bed", powers, self.coefficients[piece, of_model])

    def beam(self, times):
        """m.n and its first two derivatives."""
        y = self.states(times)
        n, x, momentum = y[..., :3], y[..., 3:6], y[..., 6:]
        chi, delta, c = (number[:, None, None] for number in (self.chi, self.delta, self.c))
        m = np.sin(chi) * (np.cos(delta) * x + np.sin(delta) * np.cross(n, x)) + np.cos(chi) * n
        # eps Omega^z is constant.
        turn = (self.eps / (1 + self.eps))[:, None] * np.sum(momentum * n, axis=-1)
        omega = momentum - turn[..., None] * n
        torque = -2 * c * np.cross(n, np.einsum("bij,bej->bei", self.tensor, n))
        omega_rate = torque - turn[..., None] * np.cross(momentum, n)
        rate = np.cross(omega, m)
        second = np.cross(omega_rate, m) + np.cross(omega, rate)
        return [np.einsum("bei,bi->be", v, self.direction) for v in (m, rate, second)]

    def edges(self, near):
        """Times at which the line of sight is on the edge of the beam, for each model those closest to the times `near`."""

        def off(times):
            value, rate, _ = self.beam(times)
            return value - np.cos(self.rho)[:, None], rate

        return self._roots(near, off)

    def closest_approaches(self, near):
        """Times of the largest m.n."""
        return self._roots(near, lambda t: self.beam(t)[1:])

    def _roots(self, near, function):
        times = np.tile(np.asarray(near, float), (len(self.models), 1))
        if times.size == 0:
            return times
        for _ in range(12):
            f, rate = function(times)
            change = f / rate
            times = times - change
            if np.all(np.abs(change) < 1e-13 * self.turn + 1e-15 / np.abs(rate)):
                return times
        raise ArithmeticError("a pulse is not found in a neighbour of the scene")

    def strain(self, times):
        """h_+ and h_x at the same times for each model, Eq. (71): twice -d2 I^IJ/dt2 with I^IJ = delta^IJ + eps n^I n^J."""
        times = np.tile(np.asarray(times, float), (len(self.models), 1))
        y = self.states(times)
        n, momentum = y[..., :3], y[..., 6:]
        torque = -2 * self.c[:, None, None] * np.cross(n, np.einsum("bij,bej->bei", self.tensor, n))
        rate = np.cross(momentum, n)
        second = np.cross(torque, n) + np.cross(momentum, rate)
        sky = [(o.theta, o.phi) for o in (Observer(a, b, None) for a, b in zip(self.theta_o, self.phi_o))]
        a, b = ([np.einsum("bei,bi->be", v, np.array([s[k] for s in sky])) for v in (n, rate, second)] for k in (0, 1))
        plus = a[1] ** 2 + a[0] * a[2] - b[1] ** 2 - b[0] * b[2]
        cross = a[2] * b[0] + 2 * a[1] * b[1] + a[0] * b[2]
        scale = (-2 * self.eps * self.strain_scale * self.strain_unit)[:, None]
        return scale * plus, scale * cross
