"""A star's wave as SFTs of lalpulsar, found by PyFstat: both harmonics at the right frequency with the right power, and not off it. Needs lalsuite
and pyfstat, no network."""

import logging
import os
import sys
import tempfile

import lal
import lalpulsar
import numpy as np
import twofold
from lalpulsar.simulateCW import CWSimulator
from twofold.waves import Waveform, seconds_since_epoch

os.environ["PYFSTAT_LOGLEVEL"] = "ERROR"
import pyfstat  # noqa: E402

logging.disable(logging.INFO)

DETECTOR, START, DURATION, SFT = "H1", 1_188_000_000, 86400, 1800
# Square roots of the one-sided density of noise (1/sqrt(Hz)): signals to noise of about 70.
NOISES = {"once": 2e-28, "twice": 4e-29}
# 04:57:56.2 and +22:55:06.0, as in the scene.
RIGHT_ASCENSION = np.pi / 12 * (4 + 57 / 60 + 56.2 / 3600)
DECLINATION = np.pi / 180 * (22 + 55 / 60 + 6.0 / 3600)

scene = twofold.Scene(
    "wave-source",
    time={"epoch": "58000.0"},
    star={"spin_frequency": 20.0},
    # L is not along Z, so that psi matters.
    initial={"momentum": [0.3, 0.2, 0.9], "precession_phase": "70 deg"},
    observer={"frame": "equatorial", "inclination": None, "distance": 1.0},
    pulsar={"chi": 1.0, "rho": 0.3, "name": "source", "right_ascension": "04:57:56.2", "declination": "+22:55:06.0"},
)
pulsar = scene.pulsar()
REFERENCE = START + DURATION // 2
since = seconds_since_epoch(pulsar, REFERENCE)


def must(what: str, value: float, bound: float) -> None:
    if not value <= bound:
        sys.exit(f"{what}: {value:.3g}, must be at most {bound:.3g}")


def simulator(harmonic: str) -> CWSimulator:
    waveform = Waveform(pulsar, harmonic, reference=since)
    return CWSimulator(REFERENCE, START, DURATION, waveform, 5, 0.0, waveform.psi, RIGHT_ASCENSION, DECLINATION, DETECTOR)


def response(gps: np.ndarray, psi: float) -> np.ndarray:
    """F_+ and F_x of the detector, by LAL alone."""
    site = lal.CachedDetectors[lal.LHO_4K_DETECTOR]
    sidereal = [lal.GreenwichMeanSiderealTime(lal.LIGOTimeGPS(t)) for t in gps]
    return np.array([lal.ComputeDetAMResponse(site.response, RIGHT_ASCENSION, DECLINATION, psi, t) for t in sidereal])


def at_barycentre(gps: np.ndarray) -> np.ndarray:
    """Delay of a wave at the barycentre (s)."""
    ephemerides = lalpulsar.InitBarycenter("earth00-40-DE405.dat.gz", "sun00-40-DE405.dat.gz")
    earth, place, found = lalpulsar.EarthState(), lalpulsar.BarycenterInput(), lalpulsar.EmissionTime()
    place.site = lal.CachedDetectors[lal.LHO_4K_DETECTOR]
    for axis in range(3):
        place.site.location[axis] /= lal.C_SI
    place.alpha, place.delta, place.dInv = RIGHT_ASCENSION, DECLINATION, 0.0
    delays = []
    for t in gps:
        place.tgps = lal.LIGOTimeGPS(t)
        lalpulsar.BarycenterEarth(earth, place.tgps, ephemerides)
        lalpulsar.Barycenter(found, place, earth)
        delays.append(found.deltaT)
    return np.array(delays)


# The strain in the detector: the sum of both simulators compared with the wave of the pulsar, whose axes are north and east (psi = pi/2).
simulators = {harmonic: simulator(harmonic) for harmonic in ("once", "twice")}
rate, seconds = 256, 16
both = sum(np.array(one.get_strain(rate, tmin=40000, tmax=40000 + seconds)[1], dtype=float) for one in simulators.values())
gps = START + 40000 + np.arange(rate * seconds) / rate
plus, cross = pulsar.wave(since + (gps - REFERENCE) + at_barycentre(gps))
direct = response(gps, np.pi / 2)
expected = direct[:, 0] * plus + direct[:, 1] * cross
strain_error = abs(both - expected).max() / abs(expected).max()
# LAL interpolates between tables some hundred seconds apart: antenna patterns, at twice the rate of the Earth, are accurate to (2 x 7.3e-5 x 864)^2 /
# 8 = 2e-3.
must("strain in the detector beside LAL's response", strain_error, 3e-3)
figures = [f"strain as by LAL's response to {strain_error:.1e}"]

for harmonic, turns in (("once", 1), ("twice", 2)):
    waveform, noise = Waveform(pulsar, harmonic, reference=since), NOISES[harmonic]
    phases, plus, cross = waveform(np.array([-DURATION / 2, 0.0, DURATION / 2]))
    frequency = (phases[2] - phases[0]) / (2 * np.pi * DURATION)
    # Signal to noise from the antenna patterns: rho^2 = (2 / S) int (F_+^2 a_+^2 + F_x^2 a_x^2) / 2 dt over the turns.
    patterns = response(START + np.arange(0, DURATION, 300) + 150.0, waveform.psi)
    rho2 = DURATION / noise**2 * np.mean((patterns[:, 0] * plus[1]) ** 2 + (patterns[:, 1] * cross[1]) ** 2)
    with tempfile.TemporaryDirectory() as folder:
        for _ in simulators[harmonic].write_sft_files(fmax=64, Tsft=SFT, out_dir=folder, noise_sqrt_Sh=noise, noise_seed=1234 + turns):
            pass
        search = pyfstat.ComputeFstat(
            tref=REFERENCE,
            sftfilepattern=os.path.join(folder, "*.sft"),
            minCoverFreq=frequency - 0.5,
            maxCoverFreq=frequency + 0.5,
            assumeSqrtSX=noise,
        )

        def power(offset: float) -> float:
            return float(search.get_fullycoherent_twoF(F0=frequency + offset, F1=0.0, F2=0.0, Alpha=RIGHT_ASCENSION, Delta=DECLINATION))

        found = power(0.0)
        # The peak of 2F, from a parabola through three points a quarter of a bin apart.
        step = 0.25 / DURATION
        below, above = power(-step), power(step)
        peak = step / 2 * (below - above) / (below - 2 * found + above)
        beside = [power(offset) for offset in np.linspace(0.01, 0.4, 40)]
    # 2F is chi^2 of four degrees about rho^2; the frequency of its peak has the error sqrt(6) / (pi T rho). Four standard deviations of each; 35 is exceeded by noise once in 2e6.
    must(f"{harmonic}: 2F beside 4 + rho^2, in standard deviations", abs(found - 4 - rho2) / np.sqrt(8 + 4 * rho2), 4.0)
    must(f"{harmonic}: the peak beside the frequency of the star, in standard deviations", abs(peak) * np.pi * DURATION * np.sqrt(rho2 / 6), 4.0)
    must(f"{harmonic}: 2F a hundredth of a hertz and more beside the signal", max(beside), 35.0)
    figures.append(
        f"{harmonic} a turn, {frequency:.4f} Hz: 2F = {found:.0f}, expected {4 + rho2:.0f} +- {np.sqrt(8 + 4 * rho2):.0f}, at most {max(beside):.0f} beside it"
    )
print("PyFstat: " + "; ".join(figures))
