"""The paper's four examples: constants, initial states, perturbation solutions, in balls. Formulas are those of verify/oracles/symbolic."""

import sys
from fractions import Fraction
from pathlib import Path

from flint import arb, fmpq
from sympy import cos, lambdify, sin, symbols, tan

sys.path.insert(0, str(Path(__file__).parent.parent / "symbolic"))

import perturbation  # noqa: E402
from coordinates import E_X, E_Z  # noqa: E402
from exchange import ExactPrinter  # noqa: E402
from lagrangian import GAMMA_RATE, MOMENTUM  # noqa: E402

FUNCTIONS = {
    "Fraction": lambda p, q: arb(fmpq(p, q)),
    "sin": lambda x: arb(x).sin(),
    "cos": lambda x: arb(x).cos(),
    "sqrt": lambda x: arb(x).sqrt(),
    "atan": lambda x: arb(x).atan(),
    "asin": lambda x: arb(x).asin(),
    "asinh": lambda x: arb(x).asinh(),
    "pi": None,
}


def enclose(expressions, values):
    """Enclosures of SymPy expressions, from balls for the symbols by name."""
    expressions = [e.replace(tan, lambda a: sin(a) / cos(a)) for e in (x + 0 * symbols("c") for x in expressions)]
    names = sorted({s.name for e in expressions for s in e.free_symbols})
    by_name = {s.name: s for e in expressions for s in e.free_symbols}
    printer = ExactPrinter({"fully_qualified_modules": False, "inline": True})
    modules = [FUNCTIONS | {"pi": arb.pi()}]
    function = lambdify([by_name[n] for n in names], expressions, modules=modules, printer=printer, cse=True)
    return [arb(x) for x in function(*(values[n] for n in names))]


def fraction(text):
    """A decimal or a quotient, exactly."""
    value = Fraction(text)
    return fmpq(value.numerator, value.denominator)


BODY = (fmpq(1), fraction("1.1"), fmpq(1))
COEFFICIENTS = [fraction(x) for x in ("0.02", "0.01", "-0.04")]
SOLUTIONS = {
    "twofold": perturbation.Solution(perturbation.as_printed("twofold"), "twofold"),
    "single": perturbation.Solution(perturbation.as_printed("single"), "single"),
    "corrected": perturbation.Solution(perturbation.first_order("twofold"), "twofold"),
    "corrected-single": perturbation.Solution(perturbation.first_order("single"), "single"),
}


class Example:
    """An example from its constants of integration; alpha_0 = phi = pi/2."""

    def __init__(self, kind, beta_0, amplitude, s=COEFFICIENTS):
        self.kind, self.s = kind, s
        self.values = {
            "i_xx": arb(BODY[0]),
            "i_zz": arb(BODY[1]),
            "c": arb(BODY[2]),
            "s_x": arb(s[0]),
            "s_y": arb(s[1]),
            "s_z": arb(s[2]),
            "spin": arb(1),
            "beta": arb(beta_0),
            "amplitude": arb(amplitude),
        }
        self.solution = SOLUTIONS[kind]
        frequency = self.solution.rate if kind == "corrected" else self.solution.nu
        rate, nu = enclose([self.solution.rate, frequency], self.values)
        self.rate, self.nu = rate, nu
        self.function = None
        self.expressions = [*self.solution.angles(frequency), *self.solution.rates()]

    def perturbed(self, t):
        """alpha, beta and their rates at the time t, Eqs. (27), (30), (33)."""
        half_pi = arb.pi() / 2
        x, y = self.nu * t + half_pi, self.rate * t + half_pi
        if self.function is None:
            # The coefficients of the four sines and cosines are computed once.
            sx, cx, s2, c2 = symbols("sx cx s2 c2")
            big_x, big_y = perturbation.x, perturbation.y
            swap = {sin(big_x): sx, cos(big_x): cx, sin(2 * big_y): s2, cos(2 * big_y): c2}
            self.function = [e.subs(swap) for e in self.expressions]
            parts = [f.expand().coeff(v) for f in self.function for v in (sx, cx, s2, c2)]
            self.parts = enclose(parts, self.values)
        factors = (x.sin(), x.cos(), (2 * y).sin(), (2 * y).cos())
        sums = [sum(p * f for p, f in zip(self.parts[4 * i : 4 * i + 4], factors)) for i in range(4)]
        return y + sums[0], self.values["beta"] + sums[1], self.rate + sums[2], sums[3]

    def initial_state(self):
        """n, L, e_x with gamma = 0."""
        alpha, beta, alpha_rate, beta_rate = self.perturbed(arb(0))
        values = self.values | {"alpha": alpha, "beta": beta, "gamma": arb(0), "alpha_1": alpha_rate, "beta_1": beta_rate}
        values["gamma_1"] = enclose([GAMMA_RATE], values)[0]
        balls = enclose([*E_Z, *MOMENTUM, *E_X], values)
        return balls[0:3], balls[3:6], balls[6:9]


def examples():
    """tp-I, tp-II, sp-I, sp-II."""
    seven = fraction("0.7")
    return {
        "tp-I": Example("twofold", seven, fmpq(0)),
        "tp-II": Example("twofold", seven, fraction("0.4")),
        "sp-I": Example("single", seven, fraction("0.01")),
        "sp-II": Example("single", fraction("1.4"), fraction("0.01")),
    }
