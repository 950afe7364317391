"""Every key of a scene file, changed once: the output of the commands for the changed scene.

A change must show: some number of some output differs by a thousand times its tolerance, or a text changes. Keys that leave the numbers unchanged
are listed in `SILENT`.
"""

import json

CASES = {
    "keys-angles": {
        "star.inertia_ratio": 1.27,
        "star.spin": 0.93,
        "lorentz_violation.eigenvalues[0]": 0.041,
        "lorentz_violation.eigenvalues[1]": -0.032,
        "lorentz_violation.eigenvalues[2]": 0.057,
        "initial.alpha": 9.1,
        "initial.beta": 1.13,
        "initial.gamma": -0.77,
        "initial.alpha_rate": -0.81,
        "initial.beta_rate": 0.29,
        "observer.theta_o": 1.21,
        "observer.phi_o": 2.44,
        "pulsar.chi": 1.07,
        "pulsar.delta": -1.9,
        "pulsar.rho": 0.83,
        "pulsar.second_beam": False,
        "time.start": 3.25,
        "time.span": -21.0,
        "time.samples": 4,
        "output.columns": ["h", "rates", "lambda"],
        "output.tolerance": 1e-9,
        "output.method": "splitting",
    },
    "keys-constants": {
        "lorentz_violation.tensor[1][1]": -0.061,
        "lorentz_violation.tensor": [[0.031, -0.017, 0.023], [-0.017, -0.042, 0.011], [0.023, 0.011, 0.005]],
        "initial.kind": "single",
        "initial.alpha_0": 1.9,
        "initial.beta_0": 0.97,
        "initial.amplitude": 0.043,
        "initial.phase": -2.2,
        "initial.gamma": 5.3,
        "time.times": [4.0, 5.5, 13.0],
    },
    "keys-star": {
        "star.mass": 1.71,
        "star.radius": 10.4,
        "star.oblateness": 0.131,
        "star.spin_frequency": -391.0,
        "lorentz_violation.alpha_2": -0.21,
        "lorentz_violation.w[0]": 0.29,
        "lorentz_violation.w[1]": -0.33,
        "lorentz_violation.w[2]": 0.38,
        "observer.distance": 1.9,
        "time.end": 0.017,
    },
    "keys-observed": {
        "star.precession_period": 7.1e-7,
        "star.frequency": -287.0,
        "initial.wobble": 0.41,
        "initial.momentum": [0.3, -0.7, 0.4],
        "initial.azimuth": -2.7,
        "initial.precession_phase": 1.9,
        "observer.inclination": 1.417,
        "observer.azimuth": 0.61,
    },
    "keys-density": {"star.density": 7.7e14},
    "bulge-number": {"star.bulge": "fluid"},
    "keys-dates": {
        "sources": ["another source"],
        "pulsar.name": "J6543+21",
        "pulsar.right_ascension": "17:12:03.4",
        "pulsar.declination": "+31:06:07.8",
        "time.epoch": "51234.000123456",
        "time.years": -0.41,
    },
}

# They give the same numbers by another method, or with another error.
SILENT = {"output.tolerance", "output.method"}


def shows(folder, file, scene):
    """Whether the answers for a changed scene differ from those for the scene."""

    def outputs(name):
        commands = json.loads((folder / f"{name}.json").read_text())["commands"]
        return [table for command in commands for table in command["outputs"].values()]

    def far(a, b, tolerance):
        return abs(a - b) > 1000 * tolerance if isinstance(a, float) and isinstance(b, float) else a != b

    for old, new in zip(outputs(scene), outputs(file), strict=True):
        if len(old["rows"]) != len(new["rows"]) or len(old["tolerances"]) != len(new["tolerances"]):
            return True
        for row, row_2 in zip(old["rows"], new["rows"], strict=True):
            if any(far(a, b, t) for a, b, t in zip(row, row_2, old["tolerances"], strict=False)):
                return True
    return False
