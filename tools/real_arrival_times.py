"""Arrival times of PSR B1855+09 (NANOGrav, 9 years) without what PINT models beside the rotation, as a .tim and a scene for `twofold limits`."""

import pathlib
import sys
import warnings

import numpy as np

warnings.filterwarnings("ignore")
OUT = pathlib.Path(sys.argv[1])


def without_network():
    """Earth rotation and ephemeris from PyPI's packages, no clock files: these change the times by microseconds that a fit takes up."""
    import astropy.utils.iers
    import pint.logging
    import pint.solar_system_ephemerides as ephemerides
    import skyfield_data
    from astropy.utils.data import import_file_to_cache
    from pint.observatory import Observatory, get_observatory, global_clock_corrections

    pint.logging.setup("ERROR")
    astropy.utils.iers.conf.auto_download = False
    astropy.utils.iers.conf.auto_max_age = None
    empty = OUT / "index.txt"
    empty.write_text("")
    import_file_to_cache(global_clock_corrections.global_clock_correction_url_base + "index.txt", str(empty))
    empty.unlink()
    for name in Observatory.names():
        site = get_observatory(name)
        for attribute, value in (("clock_files", []), ("apply_gps2utc", False)):
            if hasattr(site, attribute):
                setattr(site, attribute, value)
    ephemerides.load_kernel("de421", path=str(pathlib.Path(skyfield_data.get_skyfield_data_path()) / "de421.bsp"))


def fitted():
    """The timing model of NANOGrav, fitted anew by generalised least squares, and the arrival times."""
    import io

    from pint.config import examplefile
    from pint.fitter import GLSFitter
    from pint.models import get_model
    from pint.toa import get_TOAs

    with open(examplefile("B1855+09_NANOGrav_9yv1.gls.par")) as file:
        lines = [line for line in file if not line.startswith(("CLK", "CLOCK", "EPHEM"))]
    model = get_model(io.StringIO("".join(lines) + "CLK UTC(NIST)\nEPHEM DE421\n"))
    toas = get_TOAs(examplefile("B1855+09_NANOGrav_9yv1.tim"), model=model, include_bipm=False, usepickle=False)
    fitter = GLSFitter(toas, model)
    fitter.fit_toas()
    return fitter.model, toas


def epochs(model, toas, sigmas):
    """Numbers, phases since PEPOCH and errors (s) of the means of each epoch, with the error that its times share."""
    phases, since = model.phase(toas, abs_phase=True), model.phase(toas, abs_phase=False)
    basis, weights = model.components["EcorrNoise"].ecorr_basis_weight_pair(toas)
    groups = [(np.flatnonzero(column), weight) for column, weight in zip(np.asarray(basis).T, weights)]
    grouped = np.concatenate([places for places, _ in groups])
    groups += [(np.array([place]), 0.0) for place in np.setdiff1d(np.arange(len(sigmas)), grouped)]
    for places, shared in groups:
        weight = 1 / sigmas[places] ** 2
        numbers = phases.int[places].astype(float).astype(int)
        offsets = np.asarray(phases.frac[places], float)
        first = places[0]
        phase = np.longdouble(since.int[first]) + np.longdouble(since.frac[first])
        yield numbers[0], phase + (np.average(offsets, weights=weight) - offsets[0]), np.sqrt(1 / weight.sum() + shared)


def main():
    without_network()
    model, toas = fitted()
    sigmas = model.scaled_toa_uncertainty(toas).to_value("s")
    f0, f1 = model.F0.quantity.to_value("Hz"), model.F1.quantity.to_value("Hz/s")
    f0 = np.longdouble(f0)
    lines = []
    for number, phase, sigma in epochs(model, toas, sigmas):
        # When a star that only rotates has the phase that was seen.
        time = phase / f0
        for _ in range(4):
            time -= (f0 * time + f1 * time**2 / 2 - phase) / (f0 + f1 * time)
        day = np.floor(time / 86400)
        epoch = int(model.PEPOCH.value)
        fraction = np.format_float_positional(time / 86400 - day, precision=19, trim="k")
        lines.append((time, f"b1855+09 0.0 {epoch + int(day)}{fraction[1:]} {sigma * 1e6:.6f} @ -pn {number}\n"))
    (OUT / "b1855+09.tim").write_text("FORMAT 1\n" + "".join(line for _, line in sorted(lines)))
    (OUT / "b1855+09.toml").write_text(SCENE.format(f0=f"{f0:.16f}", f1=f1, epoch=f"{epoch}.0"))
    print(f"{len(toas)} arrival times, {len(lines)} epochs", file=sys.stderr)


SCENE = """about = "PSR B1855+09 without a wobble"

[star]
mass = 1.4             # chosen; no limit on the wobble depends on it
density = 1e15         # chosen
oblateness = 1e-3      # chosen
spin_frequency = {f0}

[spin_down]
f1 = {f1:.12e}

[lorentz_violation]
eigenvalues = [0.0, 0.0, 0.0]

[initial]
wobble = 0.0

[observer]
inclination = "45 deg" # chosen; arrival times do not depend on it

[pulsar]
chi = "45 deg"         # chosen: the limit goes with tan(chi)
rho = "20 deg"         # chosen

[time]
epoch = "{epoch}"
years = 1.0
samples = 2
"""

if __name__ == "__main__":
    main()
