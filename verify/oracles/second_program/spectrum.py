"""The spectral lines of a column, as written by `twofold spectrum`: a joint fit of cosines to a long series under a window."""

import itertools

import numpy as np

from motion import FINE, Motion


def lines(column, scene, span, least, most, numerics=FINE):
    """Rows frequency, amplitude, phase, uncertainty (not recomputed), combination: the `most` strongest.

    All lines of at least `least` of the largest are fitted together.
    """
    # Other numerics use another span, which shows the effect of lines outside the fit.
    span = span if numerics is FINE else 0.87 * span
    margin = 3.0 / Motion(scene, scene.start, scene.start).turning
    motion = Motion(scene, min(scene.start, scene.start + span) - margin, max(scene.start, scene.start + span) + margin, numerics)
    count = int(abs(span) * motion.turning / 0.5)
    since = np.linspace(0, span, count)
    values = column(motion, scene.start + since)
    window = (1 - np.cos(2 * np.pi * (np.arange(count) + 0.5) / count)) ** 2
    found = fit(since, values, window, least)
    basis = fundamental_frequencies(motion, scene.start + since, window)
    rows = []
    for frequency, c, s in sorted(found, key=lambda line: -np.hypot(line[1], line[2])):
        # c cos + s sin of frequency times t.
        rows.append([frequency, np.hypot(c, s), np.arctan2(-s, c), "*", combination(frequency, basis, 1 / abs(span))])
    return rows[:most]


def fit(t, values, window, least):
    """Frequencies with their cosine and sine amplitudes (and a constant term), the strongest first, down to `least` of the strongest."""
    frequencies, step, span = [], abs(t[1] - t[0]), abs(t[-1] - t[0])
    left, size = values - np.average(values, weights=window), None
    solution = None
    while len(frequencies) < 150:
        pad = 4 * len(t)
        transform = np.abs(np.fft.rfft(left * window, pad))
        transform[: int(4 * 4)] = 0
        peak = int(transform.argmax())
        amplitude = 2 * transform[peak] / window.sum()
        size = size or amplitude
        if amplitude < least * size:
            break
        a, b, c = np.log(transform[peak - 1 : peak + 2] + 1e-300)
        shift = 0.5 * (a - c) / (a - 2 * b + c)
        frequency = 2 * np.pi * (peak + shift) / (pad * step)
        frequencies.append(frequency)
        if len(frequencies) % 4 == 0:
            solution, left, frequencies = _newton(t, values, window, frequencies, span)
        else:
            wave, design = _amplitudes(t, left, window, [frequency])
            left = left - wave @ design
    for _ in range(8):
        solution, left, frequencies = _newton(t, values, window, frequencies, span)
    return [(f, solution[2 * k + 1], solution[2 * k + 2]) for k, f in enumerate(frequencies)]


def _newton(t, values, window, frequencies, span):
    """Amplitudes by least squares under the window, then one Gauss-Newton step for all frequencies, and amplitudes again."""
    solution, design = _amplitudes(t, values, window, frequencies)
    slopes = [(solution[2 * k + 2] * design[2 * k + 1] - solution[2 * k + 1] * design[2 * k + 2]) * (t / span) for k in range(len(frequencies))]
    whole = np.vstack([design, slopes])
    step = _least_squares(whole, values - solution @ design, window)
    change = np.clip(step[len(design) :] / span, -1 / abs(span), 1 / abs(span))
    frequencies = [frequency + d for frequency, d in zip(frequencies, change, strict=True)]
    solution, design = _amplitudes(t, values, window, frequencies)
    return solution, values - solution @ design, frequencies


def _amplitudes(t, values, window, frequencies):
    design = np.array([np.ones_like(t), *(f(frequency * t) for frequency in frequencies for f in (np.cos, np.sin))])
    return _least_squares(design, values, window), design


def _least_squares(design, values, window):
    """Solution of the normal equations: separated lines under a window are nearly orthogonal."""
    weighted = design * window
    return np.linalg.solve(weighted @ design.T, weighted @ values)


def fundamental_frequencies(motion, times, window):
    """Mean rates of alpha, gamma and the azimuth of L, all about the principal axis of s that L circles, as {name: rate}."""
    scene = motion.scene

    def mean_rate(angle, part=slice(None)):
        # The slope of a fit under the window.
        angle, t, inside = np.unwrap(angle), times[part], window[part]
        x = t - np.average(t, weights=inside)
        weight = inside * x
        return float((weight * angle).sum() / (weight * x).sum())

    momentum = motion.momentum(times)
    # L without its fast motion: the average over about four turns.
    width = min(len(times) // 10, int(8 * np.pi / (motion.turning * abs(times[1] - times[0]))))
    kernel = np.hanning(width + 2)
    about = [np.convolve(component, kernel / kernel.sum(), "valid") for component in scene.principal @ momentum.T]
    axis = max((0, 2), key=lambda i: np.abs(about[i]).min())
    frame = scene.principal[[(axis + 1) % 3, (axis + 2) % 3, axis]]
    x, y, z = np.moveaxis(motion.axes(times) @ frame.T, 1, 0)
    rates = {
        "alpha'": mean_rate(np.arctan2(z[:, 0], -z[:, 1])),
        "gamma'": mean_rate(np.arctan2(x[:, 2], y[:, 2])),
    }
    first, second = about[(axis + 1) % 3], about[(axis + 2) % 3]
    trimmed = slice(width // 2 + 1, width // 2 + 1 + len(first))
    rates["l'"] = mean_rate(np.arctan2(second, first), trimmed)
    return rates


def combination(frequency, basis, tolerance):
    """The combination of the fundamental frequencies with small integers, as `2 alpha' - l'`."""
    names, best = list(basis), None
    for integers in sorted(itertools.product(range(-8, 9), repeat=len(names)), key=lambda n: sum(map(abs, n))):
        off = abs(sum(n * basis[name] for n, name in zip(integers, names, strict=True)) - frequency)
        if off < tolerance:
            best = integers
            break
    if best is None:
        return "unidentified"
    text = ""
    for n, name in zip(best, names, strict=True):
        if n:
            sign = ("- " if n < 0 else "+ ") if text else ("-" if n < 0 else "")
            text += (" " if text else "") + sign + (f"{abs(n)} " if abs(n) > 1 else "") + name
    return text
