"""The scenes of `twofold bench` and their reference states."""

import csv
import os
from dataclasses import dataclass
from fractions import Fraction

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "bench", "data")
LONG = 1e6


@dataclass
class Scene:
    """I^zz, s and n, L, e_x at the start, in units I^xx = C = 1; the states at 1,000 and, of tp-II, at 1e6 t_c in 30 digits."""

    name: str
    inertia: float
    s: list
    start: list
    end: list
    late: list


def rows(file):
    with open(os.path.join(DATA, file)) as lines:
        yield from list(csv.reader(line for line in lines if not line.startswith("#")))[1:]


def read_scenes(duration=1000):
    ends = {row[0]: [Fraction(x) for x in row[2:]] for row in rows("states.csv") if float(row[1]) == duration}
    parts = {row[0]: [Fraction(x) for x in row[2:]] for row in rows("long.csv") if float(row[1]) == LONG}
    late = {name: [high + low for high, low in zip(v[::2], v[1::2])] for name, v in parts.items()}
    numbers = ((row[0], [float(x) for x in row[1:]]) for row in rows("scenes.csv"))
    return [Scene(name, v[0], v[1:4], v[4:], ends[name], late.get(name)) for name, v in numbers]


def error(end, state):
    """Largest error of a component of n, L / |L| and e_x, where the state has it."""
    size = sum(float(x) ** 2 for x in end[3:6]) ** 0.5
    units = [1.0] * 3 + [size] * 3 + [1.0] * 3
    return max(abs(float(Fraction(x) - y)) / unit for x, y, unit in zip(state, end, units))
