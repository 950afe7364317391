"""The files of `twofold timing`, from the motion integrated over all epochs: slow stars, whose turns over years can be followed."""

import copy
from fractions import Fraction

import numpy as np

from columns import G_OVER_C4, direction_of_beam, position_angle, position_angle_and_rate, strain
from motion import Motion
from pulses import Beam, stretches

HEADER = (
    "pulse,arrival_day [MJD],arrival_fraction [d],residual [s],duration [s],psi [rad],psi_rate [rad/s],swing [rad],inclination [rad],"
    "orientation [rad],wobble [rad],wave_phase [rad],h_once [1],h_twice [1],h_plus [1],h_cross [1]"
).split(",")
DELAYS = ["geometry [s]", "torque [s]", "violation [s]"]


def timed_pulses(motion, epochs):
    """Rows (number, start, end) of the pulses of the turns nearest to epochs, in s since the start of the motion; zero is the turn at its start."""
    scene = motion.scene
    number_at, pulses = _numbered(motion, min([scene.start, *scene.start + epochs]), max([scene.start, *scene.start + epochs]))
    zero = number_at(scene.start)
    rows, seen = [], set()
    for epoch in epochs:
        number = number_at(scene.start + epoch)
        if number in pulses and number not in seen:
            seen.add(number)
            rows.append((number - zero, *pulses[number]))
    return rows


def _numbered(motion, first, last):
    """The number of the turn at a time, as a function; and of the pulses between two times start and end, by their numbers."""
    beam = Beam(motion, 1)
    period = 2 * np.pi / motion.turning
    number_at, rate = _phase(beam, first - 3 * period, last + 3 * period)
    pulses = {}
    for start, end, *cut in stretches(beam, first - 3 * period, last + 3 * period):
        # Longer ones are not timed (docs/pulsars.md).
        if not any(cut) and (end - start) * rate < 3 * 2 * np.pi:
            pulses[number_at((start + end) / 2)] = (start, end)
    return number_at, pulses


def causes(motion, rows):
    """Of each pulse the turns by which it is late by geometry, torque and violation, and the rate of the frequency (docs/pulsars.md).

    The time tau of a clock that slows down with the star, d tau/dt = a, is from the torque along the motion. In it the star with neither violation nor
    braking has the pulse N at N P + geometry, where that of the scene is at N P + geometry + violation; torque is how much the clock of a steady
    torque is ahead.
    """
    scene, braking = motion.scene, motion.braking
    free, friction = copy.copy(scene), copy.copy(braking)
    free.tensor = free.traceless = np.zeros((3, 3))
    free.bulge = friction.kappa = 0.0
    inertia = np.array([scene.inertia_xx, scene.inertia_xx, scene.inertia_zz])

    def slowing(times):
        return braking.rate(motion.states(times)[:, 9:] * inertia)[0]

    lost = motion.integral(slowing)

    def clock_rate(times):
        return braking.start() * np.exp(-lost(times))

    clock = motion.integral(clock_rate)
    numbers, starts, ends = (np.array(column) for column in zip(*rows))
    edges = [starts, ends]
    first, last = clock(starts).min() + scene.start, clock(ends).max() + scene.start
    turn = 2 * np.pi / motion.turning
    alone = Motion(free, min(first, scene.start) - 10 * turn, max(last, scene.start) + 10 * turn, motion.numerics, friction)
    number_at, pulses = _numbered(alone, min(first, scene.start), max(last, scene.start))
    zero = number_at(scene.start)
    middle = np.array([sum(pulses[number + zero]) / 2 - scene.start for number in numbers])
    geometry = middle - numbers / braking.frequency
    torque = sum(braking.steady_clock(edge - scene.start) - clock(edge) for edge in edges) / 2
    violation = sum(clock(edge) for edge in edges) / 2 - middle
    arrivals = (starts + ends) / 2
    rate = -slowing(arrivals) * clock_rate(arrivals) * braking.frequency
    return [delay * braking.frequency for delay in (geometry, torque, violation)], rate


def described(motion, rows):
    """The entries of the .csv for each pulse without its residual: duration, position angle, its rate and swing, L, the wave."""
    scene = motion.scene
    middle = np.array([(start + end) / 2 for _, start, end in rows])
    psi, psi_rate = position_angle_and_rate(motion, middle)
    wave = _harmonics(motion, middle)
    h = np.array(strain(motion, middle)) if scene.observer.distance is not None else None
    described = []
    for k, (_, start, end) in enumerate(rows):
        edges = np.linspace(start, end, 2 + int((end - start) * motion.turning * 40))
        swing = np.unwrap(position_angle(scene.observer, direction_of_beam(motion, edges)))
        values = [end - start, psi[k], psi_rate[k], swing[-1] - swing[0], *wave[k]]
        described.append([*values, *h[:, k]] if h is not None else [*values[:-2], None, None, None, None])
    return described


def timing_files(scene, epochs, rows, described, strain_rate, h, causes, terms, uncertainty):
    """Tables of the .csv (with causes if they are given), .par, .tim and of both strain files `h` (none without a distance), by a fit of F0 and as many
    derivatives as make `terms`. The date of the start of the motion is `time.epoch`.

    A row of a file of words is a list of its words.
    """
    date = Fraction(str(scene.epoch))
    numbers = np.array([row[0] for row in rows])
    middle = np.array([(row[1] + row[2]) / 2 for row in rows])

    # PEPOCH: a whole day in the middle of the epochs.
    pepoch = round(float(np.mean([int(date + Fraction(epoch) / 86400) for epoch in epochs])))
    t = middle - scene.start - float((pepoch - date) * 86400)
    centre = t.mean()
    fit = np.polynomial.Polynomial.fit(t - centre, numbers, terms)
    # Divided by the rate of the fit at each time.
    late = (fit(t - centre) - numbers) / fit.deriv()(t - centre)
    phase, *rates = (fit.deriv(d)(-centre) if d else fit(-centre) for d in range(terms + 1))

    table = [[*HEADER, *([*DELAYS, "spin_down_rate [Hz/s]"] if causes else [])]]
    parts = []
    if causes:
        # What such a fit leaves of the turns of each.
        left = [turns - np.polynomial.Polynomial.fit(t - centre, turns, terms)(t - centre) for turns in causes[0]]
        parts = [*(turns / fit.deriv()(t - centre) for turns in left), causes[1]]
    for k, (number, *_) in enumerate(rows):
        mjd = date + Fraction(middle[k] - scene.start) / 86400
        table.append([int(number), int(mjd), float(mjd - int(mjd)), late[k], *described[k], *(part[k] for part in parts)])

    reference = round(phase)
    # The time at which the fit has this phase.
    at = 0.0
    for _ in range(8):
        at -= (fit(at - centre) - reference) / fit.deriv()(at - centre)
    pulsar = scene.pulsar
    par = [["#", *source.split()] for source in scene.document.get("sources", [])]
    par.append(["PSR", pulsar.get("name", "PULSAR")])
    if "right_ascension" in pulsar:
        par += [["RAJ", pulsar["right_ascension"]], ["DECJ", pulsar["declination"]], ["POSEPOCH", float(pepoch)]]
    par += [[f"F{k}", rate] for k, rate in enumerate(rates)]
    par += [["PEPOCH", float(pepoch)], ["TZRMJD", float(pepoch + Fraction(at) / 86400)]]
    par += [["TZRSITE", "@"], ["TZRFRQ", 0.0], ["UNITS", "TDB"], ["TRACK", -2]]
    tim = [["FORMAT", 1]]
    for row in table[1:]:
        tim.append(["twofold", 0.0, row[1] + row[2], float(uncertainty), "@", "-pn", row[0] - reference])
    files = {"csv": table, "par": par, "tim": tim}
    if h is not None:
        mjd = float(date + Fraction(epochs[0]) / 86400)
        for name, values in zip(("h_plus", "h_cross"), h, strict=True):
            header = f"# {name} [1] against time [s] from MJD".split()
            series = [[float(k / strain_rate), float(value)] for k, value in enumerate(values)]
            files[f"{name}.txt"] = [[*header, mjd, "(TDB,", "barycentre)"], *series]
    return files


def _phase(beam, first, last):
    """The number of the turn of m about L that is nearest at a time, counted from the line of sight and increasing with time."""
    dense = np.linspace(first, last, int((last - first) * beam.motion.turning * 12) + 2)
    phase = np.unwrap(beam.azimuth(dense))
    sign = np.sign(phase[-1] - phase[0])
    phase = sign * phase

    def number(time):
        here = sign * beam.azimuth([time])[0] / (2 * np.pi)
        near = np.interp(time, dense, phase) / (2 * np.pi)
        return int(np.round(here + np.round(near - here)))

    return number, (phase[-1] - phase[0]) / (last - first)


def _harmonics(motion, times):
    """Rows of inclination and orientation of L, wobble, azimuth of n about L from the observer's, and the two amplitudes of the wave."""
    scene, observer = motion.scene, motion.scene.observer
    momentum, n = motion.momentum(times), motion.axes(times)[:, 2]
    size = np.linalg.norm(momentum, axis=1)
    l, o = momentum / size[:, None], observer.direction
    inclination = np.arccos(np.clip(l @ o, -1, 1))
    wobble = np.arctan2(np.linalg.norm(np.cross(l, n), axis=1), (l * n).sum(axis=1))
    along, beside = o - l * (l @ o)[:, None], np.cross(l, o)
    phase = np.arctan2((n * beside).sum(axis=1), (n * along).sum(axis=1))
    scale = G_OVER_C4 / (observer.distance or np.nan)
    scale = scale * 2 * scene.difference * (size / scene.inertia_xx) ** 2
    once, twice = scale * np.sin(wobble) * np.cos(wobble), 2 * scale * np.sin(wobble) ** 2
    return np.column_stack([inclination, position_angle(observer, l), wobble, phase, once, twice]).tolist()
