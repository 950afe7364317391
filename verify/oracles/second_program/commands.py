"""The commands for a scene, and the functions that answer them."""

import functools
import json
from fractions import Fraction

import numpy as np

import timing
from columns import columns, direction_of_beam, motion_over_times, strain
from motion import Motion
from pulses import pulses
from scene import Scene
from spectrum import lines
from torque import Torque

GROUPS = "angles,rates,e_x,e_z,L,integrals".split(",")


def groups(scene):
    """All groups of columns that the scene has."""
    names = list(GROUPS)
    if scene.constants is not None and np.array_equal(scene.principal, np.eye(3)):
        names.append("perturbation")
    if scene.observer is not None:
        names.append("lambda")
        if scene.pulsar is not None:
            names += ["m.n", "position_angle"]
        if scene.observer.distance is not None or not scene.physical:
            names.append("h")
    if scene.pulsar is not None:
        names.append("magnetic_axis")
    return names


def run(scene, numerics, chosen):
    table = columns(motion_over_times(scene, numerics), chosen)
    values = np.array([values for _, values in table]).T.tolist()
    return {"stdout": (",", [[name for name, _ in table], *values])}


def pulse_list(scene, numerics, second_beam):
    return {"stdout": (",", pulses(motion_over_times(scene, numerics), second_beam))}


STRAIN_SAMPLES = 24


def strain_rate(scene):
    """Samples per second of the strain files: a few per turn."""
    return float(f"{Motion(scene, scene.start, scene.start).turning / 1.7:.3g}")


@functools.lru_cache(maxsize=4)
def _timed(document, numerics, rate, dates, causes):
    """What the files are made of, with F1 and without, and the causes if they are asked for; for epochs of given dates, or at the times of the scene."""
    scene = Scene(json.loads(document))
    turn = 2 * np.pi / Motion(scene, scene.start, scene.start).turning
    braking = Torque(scene) if "spin_down" in scene.document else None
    motion = Motion(scene, min(scene.start, scene.end) - 10 * turn, max(scene.start, scene.end) + 10 * turn, numerics, braking)
    epochs = scene.times - scene.start
    if dates is not None:
        epochs = np.array([float((Fraction(date) - Fraction(str(scene.epoch))) * 86400) for date in dates])
    rows = timing.timed_pulses(motion, epochs)
    series = scene.start + epochs[0] + np.arange(STRAIN_SAMPLES) / rate
    h = strain(motion, series) if scene.observer.distance is not None else None
    return scene, epochs, rows, timing.described(motion, rows), rate, h, timing.causes(motion, rows) if causes else None


def timing_files(scene, numerics, name, terms, rate, uncertainty, dates=None, causes=False):
    files = timing.timing_files(*_timed(json.dumps(scene.document), numerics, rate, dates, causes), terms, uncertainty)
    return {f"{name}.{ending}": ("," if ending == "csv" else " ", rows) for ending, rows in files.items()}


SPECTRAL = {
    "m.n": ("1", lambda motion, t: direction_of_beam(motion, t) @ motion.scene.observer.direction),
    "cos_lambda": ("1", lambda motion, t: motion.axes(t)[:, 2] @ motion.scene.observer.direction),
    "h_plus": ("1", lambda motion, t: strain(motion, t)[0]),
    "h_cross": ("1", lambda motion, t: strain(motion, t)[1]),
    "beta": ("rad", lambda motion, t: np.arccos(motion.axes(t)[:, 2, 2])),
    "L_X": ("g cm^2/s", lambda motion, t: motion.momentum(t)[:, 0] * motion.scene.cgs),
}


def spectrum(scene, numerics, column, span, least, most):
    unit, values = SPECTRAL[column]
    header = [f"frequency [rad/{scene.unit}]", f"amplitude [{unit}]", "phase [rad]", f"uncertainty [rad/{scene.unit}]", "combination"]
    return {"stdout": (",", [header, *lines(values, scene, span, least, most, numerics)])}
