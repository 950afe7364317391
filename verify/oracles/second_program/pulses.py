"""The rows of `twofold pulses`: intervals of time with m.n above cos(rho), by root finding on the dense motion."""

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from columns import direction_of_beam


class Beam:
    """One of the two beams: sign 1 about m, -1 about -m."""

    def __init__(self, motion, sign):
        self.motion, self.sign, self.rho = motion, sign, motion.scene.pulsar["rho"]
        self.line_of_sight = motion.scene.observer.direction

    def direction(self, times):
        return self.sign * direction_of_beam(self.motion, times)

    def margin(self, times):
        """m.n - cos(rho)."""
        return self.direction(times) @ self.line_of_sight - np.cos(self.rho)

    def azimuth(self, times):
        """The azimuth of m about L from that of the line of sight, in (-pi, pi], increasing with the rotation."""
        l = self.motion.momentum(times)
        l /= np.linalg.norm(l, axis=1)[:, None]
        m, o = self.direction(times), self.line_of_sight
        return np.arctan2(np.einsum("ti,ti->t", l, np.cross(o, m)), m @ o - (m * l).sum(axis=1) * (l @ o))


def stretches(beam, first, last):
    """(start, end, cut at start, cut at end) of each interval inside the beam between two times, first < last."""
    motion = beam.motion
    dense = np.linspace(first, last, int((last - first) * motion.turning * 30) + 3)
    margin = beam.margin(dense)

    def at(t):
        return beam.margin([t])[0]

    # Extrema between neighbours may cross the edge twice.
    extra = []
    for k in range(1, len(dense) - 1):
        a, b, c = margin[k - 1 : k + 2]
        if (b - a) * (c - b) <= 0 and (a > 0) == (b > 0) == (c > 0) and abs(b) < 4 * (abs(b - a) + abs(c - b)):
            side = -1 if b < 0 else 1
            found = minimize_scalar(lambda t: side * at(t), bounds=(dense[k - 1], dense[k + 1]), method="bounded",
                                    options={"xatol": 1e-9 / motion.turning})
            if found.fun < 0:
                extra.append(found.x)
    if extra:
        dense = np.sort(np.concatenate([dense, extra]))
        margin = beam.margin(dense)
    inside = margin > 0
    edges = [brentq(at, dense[k], dense[k + 1], xtol=1e-15 / motion.turning, rtol=1e-15)
             for k in np.flatnonzero(inside[1:] != inside[:-1])]
    if inside[0]:
        edges.insert(0, first)
    if inside[-1]:
        edges.append(last)
    pairs = list(zip(edges[::2], edges[1::2], strict=True))
    return [(a, b, a == first and inside[0], b == last and inside[-1]) for a, b in pairs]


def turns(beam, times):
    """Nearest turn of the magnetic axis about L at each time, increasing with time; from the phase followed since the start of the motion."""
    scene = beam.motion.scene
    first, last = min([scene.start, *times]), max([scene.start, *times])
    dense = np.unique(np.concatenate([np.linspace(first, last, int((last - first) * beam.motion.turning * 10) + 2), times]))
    phase = np.unwrap(beam.azimuth(dense))
    if phase[-1] < phase[0]:
        phase = -phase
    return np.round(phase[np.searchsorted(dense, times)] / (2 * np.pi)).astype(int)


def closest_approach(beam, start, end):
    """Time in a pulse at which m.n is largest: the root of its derivative between the edges."""
    motion = beam.motion
    times = np.linspace(start, end, 41)
    k = int(np.clip(beam.margin(times).argmax(), 1, 39))

    def rate(t):
        return motion.derivative(beam.margin, [t], 1)[0]

    return brentq(rate, times[k - 1], times[k + 1], xtol=1e-14 / motion.turning, rtol=1e-14)


def width_56(rho, theta, theta_o):
    """The width in azimuth by Eq. (56), or None if the formula gives none."""
    cosine = (np.cos(rho) - np.cos(theta) * np.cos(theta_o)) / (np.sin(theta) * np.sin(theta_o))
    return 2 * np.arccos(cosine) if abs(cosine) <= 1 else None


def pulses(motion, second_beam=False):
    """The table, header first, in the order in which pulses end on the way from the start of the motion."""
    scene = motion.scene
    first, last, forward = min(scene.start, scene.end), max(scene.start, scene.end), scene.end > scene.start
    rows = []
    for number, sign in [(1, 1), (2, -1)][: 1 + (second_beam or scene.pulsar.get("second_beam", False))]:
        beam = Beam(motion, sign)
        found = stretches(beam, first, last)[:: 1 if forward else -1]
        whole = [k for k, pulse in enumerate(found) if not (pulse[2] or pulse[3])]
        approaches = {k: closest_approach(beam, *found[k][:2]) for k in whole}
        turn = dict(zip(whole, turns(beam, np.array([approaches[k] for k in whole])) if whole else [], strict=True))
        for k, (start, end, cut_start, cut_end) in enumerate(found):
            middle = (start + end) / 2
            row = [number, k + 1, start, end, middle, end - start]
            row.append({(0, 0): "", (1, 0): "start", (0, 1): "end", (1, 1): "both"}[cut_start, cut_end])
            if k in approaches:
                before = k - 1 in approaches
                row.append(abs(middle - sum(found[k - 1][:2]) / 2) if before else None)
                m = beam.direction([middle])[0]
                row += [int(turn[k] - turn[whole[0]]), approaches[k]]
                row.append(width_56(beam.rho, np.arctan2(np.hypot(m[0], m[1]), m[2]), scene.observer.theta_o))
            else:
                row += [None, None, None, None]
            rows.append((end if forward else -start, number, row))
    unit = scene.unit
    header = ["beam", "pulse", *(f"{name} [{unit}]" for name in ("start", "end", "midpoint", "duration")), "cut"]
    header += [f"period [{unit}]", "turn", f"closest_approach [{unit}]", "W_56 [rad]"]
    return [header, *(row for _, _, row in sorted(rows, key=lambda row: row[:2]))]
