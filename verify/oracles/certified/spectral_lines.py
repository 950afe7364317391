"""Frequencies and amplitudes of the lines of m.n, h_+ and h_x of tp-I and tp-II, as functions of the angles of the torus.

With theta_i = 2 pi tau_i t and the closed paths of `torus`, n and L have the period 2 pi in both angles. A vector u carried by the flows
has turned about n by psi_i after the path i, and

    V = (u + i n x u) exp(i (theta_1 psi_1 + theta_2 psi_2) / (2 pi)),      e_x = Re V exp(-i gamma' t),

has the same periods if psi_i are the changes of gamma, which differ from these angles by full turns. So with coefficients f_jk over the
torus the line of n has the amplitude 2 |f_jk| and the frequency j w_1 + k w_2, that of e_x |V_jk| and j w_1 + k w_2 - gamma'.

Coefficients are sums over a grid. Such a sum also contains the coefficients whose indices differ by multiples of the numbers of points.
They are small: the flow of (t, k) from any state of the torus converges at complex times as long as its majorant c is below one, and then n
and u are at most 1 / (1 - c) and L at most mu / (1 - c). With (t, k) = (eta_1 P_1 + eta_2 P_2) / (2 pi), time i, the functions of the
angles are bounded in this way for all |Im theta_i| <= a_i (c is convex in eta: the corners suffice), and
|f_jk| <= M exp(-a_1 |j| - a_2 |k|).

alpha' circulates once with theta_1 (`Way.turns`). l' is the azimuth of L averaged over theta_1: it circulates with theta_2 in the sense of
that coefficient of L_X + i L_Y that is larger than the sum of all others.
"""

from flint import acb, arb, ctx

from examples import BODY, COEFFICIENTS, examples
from motion import cross, dot
from motions import inertia_acceleration, view
from torus import Flow, Torus, upper

# Digits for the closed paths, and for the states of the grid.
DIGITS, OF_GRID = 40, 22
# Starting values of Newton's method for the closed paths (t, k), found in doubles: the nutation, and one turn of the slow precession.
WAYS = {
    "tp-I": [("4.1000062", "-0.7085652"), ("2.94743", "38.3096")],
    "tp-II": [("4.4282708", "-1.1832550"), ("3.02197", "46.5329")],
}
# Number of lines in the tables, the strongest first: for m.n, and for each polarization.
SHOWN = {"tp-I": {"m.n": 5, "h_+": 4, "h_x": 4}, "tp-II": {"m.n": 9, "h_+": 8, "h_x": 8}}
# Figures of spectra: table, names of columns, and the lines of each example.
FREQUENCY, AMPLITUDE = "frequency [rad/t_c]", "amplitude [1]"
STRAIN = "amplitude [G I^xx / (c^4 t_c^2 r)]"
FIGURES = [
    ("figure_beam_alignment_spectra", "tp-I", "m.n", "", (FREQUENCY, AMPLITUDE), (1, 2, 3, 4)),
    ("figure_beam_alignment_spectra", "tp-II", "m.n", "", (FREQUENCY,), (1, 2, 3, 4, 5)),
    ("figure_beam_alignment_spectra", "tp-II", "m.n", "", (AMPLITUDE,), (1, 2, 3)),
    ("figure_wave_spectra", "tp-I", "h_+", "plus-", (FREQUENCY, STRAIN), (1, 2, 3)),
    ("figure_wave_spectra", "tp-I", "h_x", "cross-", (STRAIN,), (1, 2, 3)),
    ("figure_wave_spectra", "tp-II", "h_+", "plus-", (FREQUENCY, STRAIN), (1, 2, 8)),
]
# Widths of the strip, and smallest numbers of grid points, in the two angles.
STRIP = arb("0.4"), arb("0.4")
POINTS = 88, 88


def name_of(multiples):
    """A combination as written in the golden table."""
    out = ""
    for k, symbol in zip(multiples, ("alpha'", "gamma'", "l'")):
        if k:
            sign = ("-" if k < 0 else "") if not out else (" - " if k < 0 else " + ")
            out += sign + (f"{abs(k)} " if abs(k) > 1 else "") + symbol
    return out


class Grid:
    """Values on the torus: n.o, V.o, h_+, h_x, L_X + i L_Y at equal steps of both angles."""

    def __init__(self, torus):
        self.torus = torus
        first, second = torus.ways
        self.observer, self.plus, self.crossed, self.chi = view()
        # Steps are those of the midpoints of the paths: state and u may be off by this rest.
        self.rest = arb(0)
        for way in torus.ways:
            dt, dk = (abs(a - b).upper() for a, b in ((way.t, way.exact[0]), (way.k, way.exact[1])))
            c = Flow(torus.star, dt, dk, torus.state, 1)
            self.rest += upper(2 * c.majorant * (1 + torus.star.mu))
        flow = lambda way, state, points: Flow(torus.star, *way.exact, state, OF_GRID).steps(at_least=points)
        self.rows = []
        for number, state in flow(second, torus.state, POINTS[1]):
            v = arb(len(self.rows) + 1) / number
            row = []
            for count, (n, momentum, u) in flow(first, state, POINTS[0]):
                turn = (arb(len(row) + 1) / count) * first.gamma + v * second.gamma
                row.append(self.signals(*([x + arb(0, self.rest) for x in w] for w in (n, momentum, u)), turn))
            self.rows.append(row)
        self.points = len(self.rows[0]), len(self.rows)

    def signals(self, n, momentum, u, turn):
        phase = acb(turn.cos(), turn.sin())
        tensor = inertia_acceleration(n, momentum, COEFFICIENTS)
        wave = lambda basis: acb(-sum(basis[i][j] * tensor[i][j] for i in range(3) for j in range(3)))
        return {
            "n": acb(dot(n, self.observer)),
            "V": acb(dot(u, self.observer), dot(cross(n, u), self.observer)) * phase,
            "h_+": wave(self.plus),
            "h_x": wave(self.crossed),
            "L": acb(momentum[0], momentum[1]),
        }

    def bounds(self):
        """M of each signal in the strip."""
        star, c = self.torus.star, arb(0)
        for sign in (-1, 1):
            (t_1, k_1), (t_2, k_2) = ((way.t, way.k) for way in self.torus.ways)
            eta = STRIP[0] / (2 * arb.pi()), sign * STRIP[1] / (2 * arb.pi())
            flow = Flow(star, eta[0] * t_1 + eta[1] * t_2, eta[0] * k_1 + eta[1] * k_2, self.torus.state, 1)
            c = c.max(flow.majorant)
        assert c < 1, c
        n = 1 / (1 - c)
        momentum = star.mu * n
        spread = max(abs(a - b) for a in star.s for b in star.s) / 2
        rate = momentum * n
        second = 2 * star.c * spread * n**3 + momentum * rate
        gammas = [abs(way.gamma) for way in self.torus.ways]
        growth = ((STRIP[0] * gammas[0] + STRIP[1] * gammas[1]) / (2 * arb.pi())).exp()
        # Both tensors have two products of unit vectors.
        wave = abs(star.i_zz - star.i_xx) * 2 * (2 * second * n + 2 * rate**2)
        return {"n": n, "V": (n + n**2) * growth, "h_+": wave, "h_x": wave, "L": 2 * momentum}

    def coefficients(self, signal, only=None):
        """Balls of f_jk by (j, k), for all |j|, |k| below half of the points, or for one j only."""
        n_1, n_2 = self.points
        bound = self.bounds()[signal]
        powers = lambda number: [acb(arb(-2 * i) / number).exp_pi_i() for i in range(number)]
        turns_1, turns_2 = powers(n_1), powers(n_2)
        half = self.half()
        indices = range(-half[0] + 1, half[0]) if only is None else [only]
        sums_1 = {j: self._sum(STRIP[0], j, n_1) for j in indices}
        sums_2 = {k: self._sum(STRIP[1], k, n_2) for k in range(-half[1] + 1, half[1])}
        found = {}
        for j in indices:
            phases = [turns_1[j * (i + 1) % n_1] for i in range(n_1)]
            by_row = [dot([point[signal] for point in row], phases) / n_1 for row in self.rows]
            for k in sums_2:
                value = dot(by_row, [turns_2[k * (i + 1) % n_2] for i in range(n_2)]) / n_2
                near = (-(STRIP[0] * abs(j) + STRIP[1] * abs(k))).exp()
                left = upper(bound * (sums_1[j] * sums_2[k] - near))
                found[j, k] = value + acb(arb(0, left), arb(0, left))
        return found

    def half(self):
        return [number // 2 for number in self.points]

    def beyond(self, signal):
        """An upper bound of all coefficients with |j| or |k| of half of the points or more."""
        return self.bounds()[signal] * max((-a * half).exp() for a, half in zip(STRIP, self.half()))

    @staticmethod
    def _sum(a, j, number):
        """An upper bound of the sum of exp(-a |j + p number|) over integers p, |j| <= number / 2."""
        own = (-a * abs(j)).exp()
        others = ((-a * (number - abs(j))).exp() + (-a * (number + abs(j))).exp()) / (1 - (-a * number).exp())
        return own + others

    def sense(self):
        """Number of turns of the azimuth of the averaged L with theta_2."""
        sizes = {k: abs(value) for (_, k), value in self.coefficients("L", only=0).items()}
        beyond = self.beyond("L") * 2 / (1 - (-STRIP[1]).exp())
        largest = max(sizes, key=lambda k: sizes[k].mid())
        assert sizes[largest] > beyond + sum(size for k, size in sizes.items() if k != largest)
        return largest


class Lines:
    """The lines of a motion by multiples of alpha', gamma' and l'."""

    def __init__(self, state, ways):
        ctx.dps = DIGITS + 15
        self.torus = Torus(BODY, COEFFICIENTS, state, ways, DIGITS)
        assert [way.turns for way in self.torus.ways] == [1, 0]
        ctx.dps = OF_GRID + 15
        self.grid = Grid(self.torus)
        self.sense = self.grid.sense()
        assert abs(self.sense) == 1
        self.rates = self.torus.alpha_rate(), self.torus.gamma_rate(), self.sense * self.torus.second_rate()

    def of(self, signal):
        """Amplitudes of all lines of m.n = cos(chi) n.o + sin(chi) e_x.o, or of h_+ or h_x, by their multiples, and an upper bound of all others."""
        chi = self.grid.chi
        parts = [("n", 2 * chi.cos(), 0), ("V", chi.sin(), -1)] if signal == "m.n" else [(signal, arb(2), 0)]
        found, beyond = {}, arb(0)
        for part, factor, gamma in parts:
            beyond = beyond.max(factor * self.grid.beyond(part))
            for (j, k), value in self.grid.coefficients(part).items():
                line = j, gamma, self.sense * k
                rate = dot(line, self.rates)
                assert not (any(line) and rate.contains(0)), "a resonance"
                if any(line) and (gamma or rate > 0):
                    found[line if rate > 0 else tuple(-x for x in line)] = abs(value) * factor
        return found, beyond

    def strongest(self, signal, count):
        """The strongest lines in order."""
        found, beyond = self.of(signal)
        order = sorted(found, key=lambda line: -found[line].mid())
        for a, b in zip(order, order[1 : count + 1]):
            assert found[a] > found[b], "two lines of one amplitude"
        assert all(found[order[count - 1]] > found[line] for line in order[count:]) and found[order[count - 1]] > beyond
        return [(line, found[line]) for line in order[:count]]


def spectral_lines(name):
    """The golden lines of an example."""
    ctx.dps = DIGITS + 15
    lines = Lines(examples()[name].initial_state(), WAYS[name])
    table = "spectral_lines"
    for symbol, rate in zip(("alpha'", "gamma'", "l'"), lines.rates):
        yield table, f"{name} {symbol} [1/t_c]", rate
    shown = {signal: lines.strongest(signal, count) for signal, count in SHOWN[name].items()}
    for signal, strongest in shown.items():
        for line, amplitude in strongest:
            what = f"{name} {signal}, {name_of(line)}"
            yield table, f"{what}: frequency [1/t_c]", dot(line, lines.rates)
            yield table, f"{what}: amplitude", amplitude
    for table, example, signal, part, columns, places in FIGURES:
        for place in places if example == name else ():
            line, amplitude = shown[signal][place - 1]
            for column in columns:
                value = dot(line, lines.rates) if column == FREQUENCY else amplitude
                yield table, f"{name}-{part}lines: {column} of line {place}", value
