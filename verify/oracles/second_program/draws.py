"""The random draws of a sweep: ChaCha with 8 rounds, started at the position of a scene, and three distributions.

The keystream is that of RFC 8439, section 2.3, with 8 rounds instead of 20, and a counter and a nonce of 64 bits each, as in
Bernstein's own ChaCha. The normal distribution is drawn by the ziggurat of Marsaglia and Tsang (J. Stat. Software 5, 8, 2000)
with 256 layers. docs/sweep.md describes how `twofold sweep` uses both.
"""

import functools
import math
import struct
from collections.abc import Iterator

import mpmath

LAYERS = 256
TAIL = "3.6541528853610088"
AREA = "0.00492867323399"
WORDS_PER_DRAW = 64
MASK = 0xFFFFFFFF


def _quarter_round(x: list[int], a: int, b: int, c: int, d: int) -> None:
    for first, second, third, turn in ((a, b, d, 16), (c, d, b, 12), (a, b, d, 8), (c, d, b, 7)):
        x[first] = (x[first] + x[second]) & MASK
        y = x[third] ^ x[first]
        x[third] = ((y << turn) | (y >> (32 - turn))) & MASK


def chacha_block(key: bytes, counter: int, nonce: int, rounds: int = 8) -> list[int]:
    """The 16 words of one block; `key` has 32 bytes, counter and nonce 64 bits."""
    start = list(struct.unpack("<16I", b"expand 32-byte k" + key + struct.pack("<QQ", counter, nonce)))
    x = start.copy()
    for _ in range(rounds // 2):
        for column in range(4):
            _quarter_round(x, column, column + 4, column + 8, column + 12)
        for i in range(4):
            _quarter_round(x, i, 4 + (i + 1) % 4, 8 + (i + 2) % 4, 12 + (i + 3) % 4)
    return [(a + b) & MASK for a, b in zip(x, start)]


def words(seed: int, place: int, scene: int) -> Iterator[int]:
    """Numbers of 64 bits from the position of a draw on: two words of the keystream each, the lower one first."""
    key = struct.pack("<Q24x", seed)
    block = scene * WORDS_PER_DRAW // 16
    while True:
        keystream = chacha_block(key, block, place)
        for low, high in zip(keystream[::2], keystream[1::2]):
            yield low | high << 32
        block += 1


def _unit(bits: int) -> float:
    """A number in [0, 1) from the upper 53 bits."""
    return (bits >> 11) * 2.0**-53


def _open_unit(bits: int) -> float:
    """A number in (0, 1) from the upper 52 bits plus a half."""
    return ((bits >> 12) + 0.5) * 2.0**-52


@functools.cache
def ziggurat() -> tuple[list[float], list[float]]:
    """Edges of the layers from the base to the top, and the density `exp(-x^2/2)` at each.

    All layers have the same area, the base with the tail beyond `TAIL`; its edge is that of a rectangle of the same area. The
    two constants are the published ones: the last digits of the edges follow from those of the area.
    """
    with mpmath.workdps(40):
        def density(x):
            return mpmath.exp(-x * x / 2)

        area, edges = mpmath.mpf(AREA), [mpmath.mpf(TAIL)]
        while len(edges) < LAYERS - 1:
            edges.append(mpmath.sqrt(-2 * mpmath.log(density(edges[-1]) + area / edges[-1])))
        edges = [area / density(edges[0]), *edges, mpmath.mpf(0)]
        return [float(x) for x in edges], [float(density(x)) for x in edges]


def _standard_normal(bits: Iterator[int]) -> float:
    edges, heights = ziggurat()
    while True:
        first = next(bits)
        layer = first & 0xFF
        part = (first >> 12) * 2.0**-51 - 1.0  # from -1 to 1
        x = part * edges[layer]
        if abs(x) < edges[layer + 1]:
            return x
        if layer == 0:
            tail = float(TAIL)
            while True:
                beyond = -math.log(_open_unit(next(bits))) / tail
                if -2.0 * math.log(_open_unit(next(bits))) >= beyond * beyond:
                    return math.copysign(tail + beyond, part)
        if heights[layer + 1] + (heights[layer] - heights[layer + 1]) * _unit(next(bits)) < math.exp(-x * x / 2):
            return x


def draw(law: dict, seed: int, place: int, scene: int) -> float:
    """The number of a scene for the `random` of a sweep file; `place` counts the random parameters of the file from 0."""
    bits = words(seed, place, scene)
    if law["distribution"] == "normal":
        return law["mean"] + law["deviation"] * _standard_normal(bits)
    part = _unit(next(bits))
    if law["distribution"] == "log-uniform":
        return law["from"] * (law["to"] / law["from"]) ** part
    return law["from"] * (1.0 - part) + law["to"] * part
