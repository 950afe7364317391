"""Which commands are answered for a scene, and by what."""

import numpy as np

from columns import columns, direction_of_beam, motion_over_times, strain
from motion import Motion
from pulses import pulses
from spectrum import lines
from timing import timing

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


def run(scene, numerics):
    table = columns(motion_over_times(scene, numerics))
    values = np.array([values for _, values in table]).T.tolist()
    return {"stdout": (",", [[name for name, _ in table], *values])}


def pulse_list(scene, numerics):
    return {"stdout": (",", pulses(motion_over_times(scene, numerics), second_beam=True))}


STRAIN_SAMPLES = 24


def strain_rate(scene):
    """Samples in a second of the strain files: a few in a turn."""
    return float(f"{Motion(scene, scene.start, scene.start).turning / 1.7:.3g}")


def timing_files(scene, numerics, name, with_rate, rate):
    turn = 2 * np.pi / Motion(scene, scene.start, scene.start).turning
    motion = Motion(scene, min(scene.start, scene.end) - 10 * turn, max(scene.start, scene.end) + 10 * turn, numerics)
    files, _ = timing(motion, scene.times - scene.start, with_rate, 2.5, rate, STRAIN_SAMPLES)
    return {f"{name}.{ending}": ("," if ending == "csv" else " ", rows) for ending, rows in files.items()}


SPECTRAL = {
    "m.n": ("1", lambda motion, t: direction_of_beam(motion, t) @ motion.scene.observer.direction),
    "cos_lambda": ("1", lambda motion, t: motion.axes(t)[:, 2] @ motion.scene.observer.direction),
    "h_plus": ("1", lambda motion, t: strain(motion, t)[0]),
    "h_cross": ("1", lambda motion, t: strain(motion, t)[1]),
    "beta": ("rad", lambda motion, t: np.arccos(motion.axes(t)[:, 2, 2])),
    "L_X": ("g cm^2/s", lambda motion, t: motion.momentum(t)[:, 0] * motion.scene.cgs),
}


def spectrum(scene, numerics, column, span, least):
    unit, values = SPECTRAL[column]
    header = [f"frequency [rad/{scene.unit}]", f"amplitude [{unit}]", "phase [rad]", f"uncertainty [rad/{scene.unit}]", "combination"]
    return {"stdout": (",", [header, *lines(values, scene, span, least, numerics)])}
