"""Points, exact evaluation, and the exchange file.

Angles are points of the circle: t = tan(angle / 2), sin = 2 t / (1 + t^2), cos = (1 - t^2) / (1 + t^2), with t rational.
"""

import random
from fractions import Fraction

import mpmath as mp
from sympy import cos, cot, expand_trig, lambdify, sin, symbols, tan
from sympy.printing.pycode import MpmathPrinter, PythonCodePrinter

mp.mp.dps = 60

# Names of angles and numbers, each with the range of its numerator and its denominator: dyadic, so that doubles represent them exactly.
ANY = (-24, 24, 8)
LAYOUT = {
    "angles": {name: ANY for name in "alpha gamma frame_alpha frame_gamma phi_o delta azimuth x y".split()}
    | {name: (2, 20, 8) for name in ("beta", "frame_beta", "theta_o", "half_width", "zeta", "colatitude", "chi")}
    | {"half_opening": (2, 7, 8)},
    "numbers": {name: (4, 16, 8) for name in "i_xx i_zz c j_1 j_2 j_3 spin size distance rho".split()}
    | {name: (-16, 16, 8) for name in "alpha_1 beta_1 gamma_1 alpha_2 beta_2 gamma_2 w_1 w_2 w_3 g_1 g_2 g_3".split()}
    | {name: (1, 15, 16) for name in "x_1 x_2 x_3 x_4 x_5 amplitude".split()}
    | {name: (-6, 6, 64) for name in "S_xx S_yy S_zz S_xy S_xz S_yz u_xx u_yy u_zz u_xy u_xz u_yz".split()}
    # Distinct, in this order: s_x > s_y > s_z.
    | {"s_x": (5, 8, 128), "s_y": (1, 3, 128), "s_z": (-8, -1, 128)}
    | {"a_1": (4, 16, 8), "q": (1, 15, 16)},
}


def draw(generator):
    """A point: numbers by name, an angle by its t. Zeros and right angles are excluded: they would hide a term."""
    point = {}
    for kind, ranges in LAYOUT.items():
        for name, (low, high, denominator) in ranges.items():
            numerator = 0
            while numerator == 0 or (kind == "angles" and abs(numerator) == denominator):
                numerator = generator.randint(low, high)
            point[name] = Fraction(numerator, denominator)
    return point


def points(count, seed):
    """The points of a file."""
    generator = random.Random(seed)
    return [draw(generator) for _ in range(count)]


class ExactPrinter(PythonCodePrinter):
    """Constants as exact fractions."""

    def _print_Rational(self, expr):
        return f"Fraction({expr.p}, {expr.q})"

    _print_Half = _print_Rational


class Evaluator:
    """The components of a quantity at a point, in fractions or with 60 digits."""

    def __init__(self, quantity):
        self.quantity = quantity
        extra = quantity.scale if quantity.scale not in (None, "vector") else 1
        expressions = [expand_trig(self._plain(e)) for e in [*quantity.components, extra + 0 * symbols("c")]]
        replaced = {}
        for name in LAYOUT["angles"]:
            replaced[sin(symbols(name))] = symbols(f"sin_{name}")
            replaced[cos(symbols(name))] = symbols(f"cos_{name}")
        if quantity.exact:
            expressions = [e.subs(replaced) for e in expressions]
            assert not any(e.has(sin, cos) for e in expressions), quantity.name
        names = {s.name: s for e in expressions for s in e.free_symbols}
        self.names = sorted(names)
        printer = (ExactPrinter if quantity.exact else MpmathPrinter)({"fully_qualified_modules": False, "inline": True})
        modules = [{"Fraction": Fraction}] if quantity.exact else "mpmath"
        self.function = lambdify([names[n] for n in self.names], expressions, modules=modules, printer=printer, cse=True)

    @staticmethod
    def _plain(expression):
        expression = expression + 0 * symbols("c")
        expression = expression.replace(tan, lambda a: sin(a) / cos(a)).replace(cot, lambda a: cos(a) / sin(a))
        return expression

    def _input(self, name, point):
        if self.quantity.exact:
            if name[:4] in ("sin_", "cos_"):
                t = point[name[4:]]
                return (2 * t if name.startswith("sin_") else 1 - t * t) / (1 + t * t)
            return point[name]
        value = mp.mpf(point[name].numerator) / point[name].denominator
        return 2 * mp.atan(value) if name in LAYOUT["angles"] else value

    def at(self, point):
        """Values and scales."""
        *values, extra = self.function(*(self._input(name, point) for name in self.names))
        if not self.quantity.exact:
            # What is left of 60 digits where terms cancel, as for the waves of a sphere.
            values = [v if abs(v) > mp.mpf(10) ** -50 else mp.mpf(0) for v in values]
        scale = self.quantity.scale
        if scale is None:
            return values, [abs(v) for v in values]
        length = mp.sqrt(sum(v * v for v in values)) if scale == "vector" else extra
        return values, [length] * len(values)


def evaluators(quantities):
    """Quantities by name; each name must be unique."""
    out = {}
    for quantity in quantities:
        assert quantity.name not in out, quantity.name
        out[quantity.name] = Evaluator(quantity)
    return out


def document(quantities, count, seed):
    """The content of the file: points, and each quantity at each of them."""
    drawn = points(count, seed)
    exact, rounded = {}, {}
    for name, evaluator in evaluators(quantities).items():
        if evaluator.quantity.exact:
            values = [evaluator.at(point)[0] for point in drawn]
            exact[name] = [[[str(Fraction(v)), float(Fraction(v))] for v in row] for row in values]
        else:
            rows = [evaluator.at(point) for point in drawn]
            rounded[name] = [[[mp.nstr(v, 40), float(s)] for v, s in zip(*row)] for row in rows]
    return {
        "origin": f"python3 verify/oracles/symbolic write --points {count} --seed {seed}; see docs/reliability/symbolic.md",
        "layout": LAYOUT,
        "points": [{name: str(value) for name, value in point.items()} for point in drawn],
        "exact": exact,
        "rounded": rounded,
    }
