"""Golden numbers from motions: the examples to 500 t_c, and errors of perturbation solutions."""

from flint import arb, ctx, fmpq

from examples import BODY, COEFFICIENTS, Example, enclose, examples, fraction
from formulas import largest, least
from motion import Motion, cross, dot, length

import observables as seen  # noqa: E402  (verify/oracles/symbolic, on the path by examples)

# theta_o, phi_o of the observer, chi and delta of the beam.
VIEW = {"theta_o": "0.8", "phi_o": "0", "chi": "0.5", "delta": "0"}


def digits_for(s, span):
    """Digits needed for the growth of errors over the span, plus 26."""
    half_spread = float((max(s) - min(s)).p) / float((max(s) - min(s)).q) / 2
    return int((4 * half_spread) ** 0.5 * float(span) / 2.302) + 26


def times(end, count):
    """count + 1 times from zero."""
    return [fmpq(end) * i / count for i in range(count + 1)]


class Angles:
    """alpha and beta of an axis along a motion, alpha without jumps.

    The rate of alpha is at most |L| / (I sin b), with |L| / I < 2 in all of these motions, and sin b changes by less than 2 per unit of time: between
    two samples, `gap` apart, alpha moves by less than 2 gap / (sin b - 2 gap), checked to be below 3, so that the branch is unique.
    """

    def __init__(self, alpha, gap):
        self.last, self.gap = alpha, arb(gap)

    def at(self, n):
        room = (n[0] * n[0] + n[1] * n[1]).sqrt() - 2 * self.gap
        assert room > 0 and 2 * self.gap / room < 3, "near a pole"
        alpha = arb.atan2(n[0], -n[1])
        turns = ((self.last - alpha) / (2 * arb.pi())).mid()
        alpha = alpha + 2 * arb.pi() * (turns + arb("0.5")).floor()
        assert abs(alpha - self.last) < 3
        self.last = alpha
        return alpha, arb.atan2((n[0] * n[0] + n[1] * n[1]).sqrt(), n[2])


def inertia_acceleration(n, momentum, s):
    """d^2 I^{IJ} / dt^2 by the product rule on (I^zz - I^xx) n n."""
    torque = [-2 * BODY[2] * x for x in cross(n, [arb(s[i]) * n[i] for i in range(3)])]
    rate = cross(momentum, n)
    second = [a + b for a, b in zip(cross(torque, n), cross(momentum, rate))]
    factor = arb(BODY[1] - BODY[0])
    return [[factor * (second[i] * n[j] + 2 * rate[i] * rate[j] + n[i] * second[j]) for j in range(3)] for i in range(3)]


def view():
    """Direction to the observer and the two polarization tensors."""
    values = {name: arb(fraction(text)) for name, text in VIEW.items()}
    balls = enclose([*seen.OBSERVER, *seen.THETA_HAT, *seen.PHI_HAT.applyfunc(lambda e: e.simplify())], values)
    observer, theta, phi = balls[0:3], balls[3:6], balls[6:9]
    plus = [[theta[i] * theta[j] - phi[i] * phi[j] for j in range(3)] for i in range(3)]
    cross_ = [[theta[i] * phi[j] + phi[i] * theta[j] for j in range(3)] for i in range(3)]
    return observer, plus, cross_, values["chi"]


def of_example(name, to=200):
    """The golden numbers of one example within its first 200 t_c; with `to` = 500 only those that need longer."""
    digits = digits_for(COEFFICIENTS, to)
    ctx.dps = digits + 15
    example = examples()[name]
    motion = Motion(BODY, COEFFICIENTS, example.initial_state(), digits)
    observer, plus, crossed, chi = view()
    span = {"tp-I": 30, "tp-II": 30, "sp-I": 200, "sp-II": 500}[name]
    twofold = name.startswith("tp")
    beam, waves = (set(times(200, 4000)), set(times(100, 2000))) if twofold else (set(), set())
    angles_at, sphere = set(times(span, 2000)), set(times(500, 5000))
    if to == 500:
        beam, waves, angles_at = set(), set(), angles_at if span == 500 else set()
    else:
        sphere = set()
        angles_at = {t for t in angles_at if t <= to}
    picked = {"angles": set(), "paths": set()}
    if twofold:
        picked = {"angles": {fmpq(0), fmpq(15), fmpq(30)}, "paths": {fmpq(15)}}
    else:
        picked = {"angles": {fmpq(0), fmpq(100), fmpq(span)}, "paths": {fmpq(40), fmpq(100)}}
    if to == 500:
        picked = {"angles": {fmpq(500)}, "paths": set()}
    figure = "figure_motion_" + name.lower().replace("-ii", "_2").replace("-i", "_1")
    alignment, wave_values, l_third, h_values, found = {}, {}, [], [], {}
    angles = Angles(example.perturbed(arb(0))[0], fmpq(span, 2000))
    for t in sorted(beam | waves | angles_at | picked["paths"] | sphere):
        n, momentum, e = motion.at(t)
        if t in angles_at:
            alpha, beta = angles.at(n)
            if t in picked["angles"]:
                printed = example.perturbed(arb(t))
                at = f"at t = {float(t.p) / float(t.q):.3f}"
                if not (twofold and 0 < t < span):
                    found[figure, f"angles: alpha [rad] {at}"] = alpha
                found[figure, f"angles: beta [rad] {at}"] = beta
                # Those in the golden table.
                by_solution = {"alpha": printed[0], "beta": printed[1]} if t > 0 else {}
                if twofold and t < span:
                    by_solution.pop("alpha", None)
                for angle, ball in by_solution.items():
                    found[figure, f"angles: {angle} by perturbation printed [rad] {at}"] = ball
        if t in picked["paths"]:
            at = f"at t = {float(t.p) / float(t.q):.3f}"
            if twofold or t == 40:
                found[figure, f"paths: e_x_X [1] {at}"] = e[0]
            if twofold or t == 100:
                found[figure, f"paths: e_z_X [1] {at}"] = n[0]
        if t in beam:
            alignment[t] = dot([chi.sin() * x + chi.cos() * z for x, z in zip(e, n)], observer)
        if t in waves:
            tensor = inertia_acceleration(n, momentum, COEFFICIENTS)
            wave_values[t] = [
                -sum(basis[i][j] * tensor[i][j] for i in range(3) for j in range(3)) for basis in (plus, crossed)
            ]
        if t in sphere:
            size = length(momentum)
            l = [x / size for x in momentum]
            l_third.append(l[2])
            h_values.append(sum(arb(COEFFICIENTS[i]) * l[i] * l[i] for i in range(3)))
    if alignment:
        for t in (0, 50, 100, 200):
            found["figure_beam_alignment", f"{name}: m.n [1] at t = {t}.000"] = alignment[fmpq(t)]
        found["figure_beam_alignment", f"{name}: m.n [1] least"] = least(alignment.values())
        found["figure_beam_alignment", f"{name}: m.n [1] largest"] = largest(alignment.values())
        for k, polarization in enumerate(("h_+", "h_x")):
            label = f"{name}: {polarization} [G I^xx / (c^4 t_c^2 r)]"
            # At the start h_x vanishes and is not in the table.
            for t in (0, 50, 100)[k:]:
                found["figure_waves", f"{label} at t = {t}.000"] = wave_values[fmpq(t)][k]
            found["figure_waves", f"{label} largest"] = largest(v[k] for v in wave_values.values())
    if to == 500:
        found |= sphere_numbers(f"l_Z of {name} [1]", name, l_third, h_values)
    return [(*key, ball) for key, ball in found.items()]


def sphere_numbers(first, name, components, values):
    """Numbers of the figure of the sphere."""
    table = "figure_momentum_sphere"
    return {
        (table, f"{first} least"): least(components),
        (table, f"l.(s l) of {name} [1] least"): least(values),
        (table, f"l.(s l) of {name} [1] largest"): largest(values),
    }


def near_middle_axis():
    """The star that starts near Y."""
    digits = digits_for(COEFFICIENTS, 500)
    ctx.dps = digits + 15
    tilt = arb(fraction("0.05"))
    axis = [arb(0), tilt.cos(), tilt.sin()]
    state = axis, [arb(BODY[1]) * x for x in axis], [arb(1), arb(0), arb(0)]
    motion = Motion(BODY, COEFFICIENTS, state, digits)
    second, h_values = [], []
    for t in times(500, 5000):
        _, momentum, _ = motion.at(t)
        size = length(momentum)
        l = [x / size for x in momentum]
        second.append(l[1])
        h_values.append(sum(arb(COEFFICIENTS[i]) * l[i] * l[i] for i in range(3)))
    return [(*key, ball) for key, ball in sphere_numbers("l_Y of near Y [1]", "near Y", second, h_values).items()]


def scaled(asymmetry, k):
    """Coefficients with the mean equatorial value and s^ZZ of the examples, times k."""
    half = fraction(asymmetry) / 2
    return [fraction(k) * x for x in (fraction("0.015") + half, fraction("0.015") - half, fraction("-0.04"))]


def error_of(kind, s, beta_0, amplitude, span, samples):
    """Largest errors of beta and of the axis of a perturbation solution over a span, at equal times."""
    example = Example(kind, fraction(beta_0), fraction(amplitude), s)
    end = span(example)
    digits = digits_for(s, float(end.mid()))
    ctx.dps = digits + 15
    example = Example(kind, fraction(beta_0), fraction(amplitude), s)
    end = span(example)
    motion = Motion(BODY, s, example.initial_state(), digits)
    betas, axes = [], []
    for i in range(samples + 1):
        t = end * i / samples
        n, _, _ = motion.at(t)
        alpha, beta, _, _ = example.perturbed(t)
        if "single" in kind:
            axis = [alpha.sin() * beta.sin(), -alpha.cos() * beta.sin(), beta.cos()]
            axes.append(length([x - y for x, y in zip(n, axis)]))
        else:
            betas.append(abs(arb.atan2((n[0] * n[0] + n[1] * n[1]).sqrt(), n[2]) - beta))
    return largest(axes if "single" in kind else betas)


def twofold_regimes(form):
    """Errors of beta over 10 t_c."""
    kind = {"printed": "twofold", "corrected": "corrected"}[form]
    cases = [("0.01", b, "0") for b in ("0.1", "0.3", "0.5", "0.7", "0.9", "1.1", "1.3", "1.4")]
    cases += [("0.01", "0.7", a) for a in ("0.0001", "0.001", "0.01", "0.1")]
    cases += [(asymmetry, "0.7", "0") for asymmetry in ("0", "0.001", "0.03", "0.1")]
    out = []
    for asymmetry, beta_0, amplitude in cases:
        error = error_of(kind, scaled(asymmetry, "1e-3"), beta_0, amplitude, lambda _: arb(10), 400)
        label = f"{form}, beta_0 = {beta_0}, A = {amplitude}, s^XX - s^YY = {asymmetry} k"
        out.append(("twofold_regimes", label, error))
    return out


SINGLE = [("0.01", "1", b, "0") for b in ("0.1", "0.3", "0.5", "0.7", "0.9", "1", "1.1", "1.2", "1.3", "1.4")]
SINGLE += [("0.01", "1", "0.7", a) for a in ("0.003", "0.01", "0.03", "0.1")]
SINGLE += [(asymmetry, "1", "0.7", "0") for asymmetry in ("0", "0.001", "0.003", "0.03")]
SINGLE += [("0.01", "0.1", "0.7", "0")]
SINGLE = [(form, *case) for form in ("printed", "corrected") for case in SINGLE]


def single_regime(case):
    """Distance of the axes over one forced period."""
    form, asymmetry, k, beta_0, amplitude = case
    kind = {"printed": "single", "corrected": "corrected-single"}[form]
    period = lambda example: 2 * arb.pi() / abs(example.rate)
    error = error_of(kind, scaled(asymmetry, k), beta_0, amplitude, period, 1000)
    label = f"{form}, beta_0 = {beta_0}, A = {amplitude}, k = {k}, s^XX - s^YY = {asymmetry} k"
    return [("single_regimes", label, error)]
